/* SPDX-License-Identifier: MIT
 * lines.c: one message as a line: in words, or as a JSON object. */
#include "lines.h"

#include "../json_values.h"
#include "../say.h"

#include <inttypes.h>
#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <tahr/tahr.h>

enum field_type { WHOLE, LONG, HASH, REAL, TRUTH, TEXT, BYTES };

struct field {
    const char *name;
    size_t offset;
    enum field_type type;
    size_t count;
};

#define F(kind, name, type, count) #name, offsetof(tahr_##kind##_t, name), type, count

/* As in backends/lcm/types. */
static const struct field state_fields[] = {{F(state, character, WHOLE, 1)},
                                            {F(state, mode, WHOLE, 1)},
                                            {F(state, step, LONG, 1)},
                                            {F(state, sequence, LONG, 1)},
                                            {F(state, time_ns, LONG, 1)},
                                            {F(state, wall_ns, LONG, 1)},
                                            {F(state, position, REAL, 3)},
                                            {F(state, velocity, REAL, 3)},
                                            {F(state, orientation, REAL, 4)},
                                            {F(state, up, REAL, 3)},
                                            {F(state, radius, REAL, 1)},
                                            {F(state, half_height, REAL, 1)},
                                            {F(state, flags, WHOLE, 1)},
                                            {F(state, base_body, WHOLE, 1)},
                                            {F(state, floor_blocking, TRUTH, 1)},
                                            {F(state, floor_walkable, TRUTH, 1)},
                                            {F(state, floor_perching, TRUTH, 1)},
                                            {F(state, floor_flags, WHOLE, 1)},
                                            {F(state, floor_body, WHOLE, 1)},
                                            {F(state, floor_feature, WHOLE, 1)},
                                            {F(state, floor_surface, WHOLE, 1)},
                                            {F(state, floor_distance, REAL, 1)},
                                            {F(state, floor_normal, REAL, 3)},
                                            {F(state, floor_surface_normal, REAL, 3)},
                                            {F(state, floor_point, REAL, 3)}};

static const struct field event_fields[] = {
    {F(event, character, WHOLE, 1)}, {F(event, type, WHOLE, 1)},    {F(event, step, LONG, 1)},
    {F(event, sequence, LONG, 1)},   {F(event, time_ns, LONG, 1)},  {F(event, wall_ns, LONG, 1)},
    {F(event, body, WHOLE, 1)},      {F(event, feature, WHOLE, 1)}, {F(event, surface, WHOLE, 1)},
    {F(event, value, REAL, 1)},      {F(event, position, REAL, 3)}, {F(event, normal, REAL, 3)}};

static const struct field input_fields[] = {
    {F(input, character, WHOLE, 1)}, {F(input, config, WHOLE, 1)}, {F(input, step, LONG, 1)},
    {F(input, sequence, LONG, 1)},   {F(input, epoch, LONG, 1)},   {F(input, time_ns, LONG, 1)},
    {F(input, wall_ns, LONG, 1)},    {F(input, dt, REAL, 1)},      {F(input, step_flags, WHOLE, 1)},
    {F(input, flags, WHOLE, 1)},     {F(input, jump, WHOLE, 1)},   {F(input, crouch, WHOLE, 1)},
    {F(input, mode, WHOLE, 1)},      {F(input, move, REAL, 3)},    {F(input, facing, REAL, 3)},
    {F(input, gravity, REAL, 3)},    {F(input, radius, REAL, 1)},  {F(input, half_height, REAL, 1)},
    {F(input, launch, REAL, 3)},     {F(input, impulse, REAL, 3)}, {F(input, drive, REAL, 3)}};

static const struct field report_fields[] = {{F(report, character, WHOLE, 1)},
                                             {F(report, status, WHOLE, 1)},
                                             {F(report, step, LONG, 1)},
                                             {F(report, sequence, LONG, 1)},
                                             {F(report, time_ns, LONG, 1)},
                                             {F(report, wall_ns, LONG, 1)},
                                             {F(report, state_hash, HASH, 1)},
                                             {F(report, duration_ns, LONG, 1)},
                                             {F(report, flags, WHOLE, 1)},
                                             {F(report, event_count, WHOLE, 1)},
                                             {F(report, events_lost, WHOLE, 1)},
                                             {F(report, sweeps, WHOLE, 1)},
                                             {F(report, contact_queries, WHOLE, 1)},
                                             {F(report, rays, WHOLE, 1)},
                                             {F(report, fluid_queries, WHOLE, 1)},
                                             {F(report, slides, WHOLE, 1)},
                                             {F(report, slices, WHOLE, 1)},
                                             {F(report, arcs, WHOLE, 1)},
                                             {F(report, triangle_tests, LONG, 1)},
                                             {F(report, narrow_iterations, LONG, 1)},
                                             {F(report, gathers, LONG, 1)},
                                             {F(report, escapes, LONG, 1)},
                                             {F(report, saved, WHOLE, 9)},
                                             {F(report, step_offset, REAL, 1)},
                                             {F(report, residual, REAL, 1)},
                                             {F(report, time_lost, REAL, 1)}};

static const struct field snapshot_fields[] = {{F(snapshot, character, WHOLE, 1)}, {F(snapshot, config, WHOLE, 1)},
                                               {F(snapshot, step, LONG, 1)},       {F(snapshot, sequence, LONG, 1)},
                                               {F(snapshot, epoch, LONG, 1)},      {F(snapshot, time_ns, LONG, 1)},
                                               {F(snapshot, wall_ns, LONG, 1)},    {F(snapshot, state_hash, HASH, 1)},
                                               {F(snapshot, size, WHOLE, 1)},      {F(snapshot, state, BYTES, 1)}};

static const struct field body_fields[] = {{F(body, epoch, LONG, 1)},
                                           {F(body, revision, HASH, 1)},
                                           {F(body, wall_ns, LONG, 1)},
                                           {F(body, kind, WHOLE, 1)},
                                           {F(body, count, WHOLE, 1)},
                                           {F(body, index, WHOLE, 1)},
                                           {F(body, body, WHOLE, 1)},
                                           {F(body, teleport, TRUTH, 1)},
                                           {F(body, dt, REAL, 1)},
                                           {F(body, position, REAL, 3)},
                                           {F(body, orientation, REAL, 4)},
                                           {F(body, before_position, REAL, 3)},
                                           {F(body, before_orientation, REAL, 4)}};

static const struct field world_fields[] = {
    {F(world, run, LONG, 1)},          {F(world, wall_ns, LONG, 1)},    {F(world, sequence, LONG, 1)},
    {F(world, level, TEXT, 1)},        {F(world, level_hash, HASH, 1)}, {F(world, backend, TEXT, 1)},
    {F(world, version, TEXT, 1)},      {F(world, abi, WHOLE, 1)},       {F(world, characters, WHOLE, 1)},
    {F(world, epoch, LONG, 1)},        {F(world, revision, HASH, 1)},   {F(world, dropped, LONG, 1)},
    {F(world, failed, LONG, 1)},       {F(world, state_rate, REAL, 1)}, {F(world, config_count, WHOLE, 1)},
    {F(world, config_size, WHOLE, 1)}, {F(world, size, WHOLE, 1)},      {F(world, configs, BYTES, 1)}};

#define FIELDS(kind) kind##_fields, sizeof kind##_fields / sizeof *kind##_fields
static const struct {
    const struct field *fields;
    size_t count;
} kinds[TAHR_MESSAGE_COUNT] = {[TAHR_MESSAGE_STATE] = {FIELDS(state)},       [TAHR_MESSAGE_EVENT] = {FIELDS(event)},
                               [TAHR_MESSAGE_INPUT] = {FIELDS(input)},       [TAHR_MESSAGE_REPORT] = {FIELDS(report)},
                               [TAHR_MESSAGE_SNAPSHOT] = {FIELDS(snapshot)}, [TAHR_MESSAGE_BODY] = {FIELDS(body)},
                               [TAHR_MESSAGE_WORLD] = {FIELDS(world)}};

static json_t *bytes_value(const uint8_t *bytes, int32_t count)
{
    char *digits = memory_new((size_t)count * 2 + 1, 1);
    for (int32_t i = 0; i < count; i++) {
        snprintf(digits + 2 * (size_t)i, 3, "%02x", bytes[i]);
    }
    json_t *value = json_string(digits);
    free(digits);
    return value;
}

/* size: of the bytes of a message that has some. */
static json_t *value_at(const uint8_t *at, enum field_type type, int32_t size)
{
    union {
        int32_t whole;
        int64_t integer;
        double real;
        const char *text;
        const uint8_t *bytes;
    } is;
    char hash[17];
    static const size_t sizes[] = {4, 8, 8, 8, 0, sizeof is.text, sizeof is.bytes};
    memcpy(&is, at, sizes[type]);
    switch (type) {
    case WHOLE: return json_integer(is.whole);
    case LONG: return json_integer(is.integer);
    case HASH: snprintf(hash, sizeof hash, "%016" PRIx64, (uint64_t)is.integer); return json_string(hash);
    case REAL: return isfinite(is.real) ? json_real(is.real) : json_null();
    case TRUTH: return json_boolean(*at != 0);
    case TEXT: return json_text(is.text);
    default: return bytes_value(is.bytes, size);
    }
}

void line_json(FILE *to, const char *channel, const struct message *m)
{
    json_t *object = json_object();
    const int32_t size = m->kind == TAHR_MESSAGE_SNAPSHOT ? m->is.snapshot.size
                         : m->kind == TAHR_MESSAGE_WORLD  ? m->is.world.size
                                                          : 0;
    json_object_set_new(object, "channel", json_text(channel));
    for (size_t i = 0; i < kinds[m->kind].count; i++) {
        const struct field *field = &kinds[m->kind].fields[i];
        const uint8_t *at = (const uint8_t *)&m->is + field->offset;
        json_t *value = NULL;
        if (field->count == 1) {
            value = value_at(at, field->type, size);
        } else {
            value = json_array();
            for (size_t k = 0; k < field->count; k++) {
                json_array_append_new(value, value_at(at + k * (field->type == WHOLE ? 4 : 8), field->type, size));
            }
        }
        json_object_set_new(object, field->name, value);
    }
    if (m->kind == TAHR_MESSAGE_STATE) {
        json_object_set_new(object, "mode_name", json_string(tahr_mode_name((uint32_t)m->is.state.mode)));
    } else if (m->kind == TAHR_MESSAGE_EVENT) {
        json_object_set_new(object, "type_name", json_string(tahr_event_name((uint32_t)m->is.event.type)));
    }
    json_dumpf(object, to, JSON_COMPACT | JSON_REAL_PRECISION(17));
    fputc('\n', to);
    json_decref(object);
}

static void words_state(FILE *to, const tahr_state_t *s)
{
    fprintf(to, "%s at (%.3f, %.3f, %.3f), %.2f m/s", tahr_mode_name((uint32_t)s->mode), s->position[0], s->position[1],
            s->position[2],
            sqrt(s->velocity[0] * s->velocity[0] + s->velocity[1] * s->velocity[1] + s->velocity[2] * s->velocity[2]));
    if (s->floor_blocking) {
        fprintf(to, ", %sfloor %.4f m below, body %" PRId32, s->floor_walkable ? "" : "steep ", s->floor_distance,
                s->floor_body);
    }
}

static void words_input(FILE *to, const tahr_input_t *i)
{
    fprintf(to, "move (%.3f, %.3f, %.3f)%s%s, flags %" PRIx32 ", dt %.6g s", i->move[0], i->move[1], i->move[2],
            i->jump ? ", jump" : "", i->crouch ? ", crouch" : "", (uint32_t)i->flags, i->dt);
}

static void words_body(FILE *to, const tahr_body_t *b)
{
    static const char *const names[] = {"?", "set", "move", "touch", "snapshot"};
    fprintf(to, "%s %" PRId32 "/%" PRId32 " of epoch %" PRId64 ": body %" PRId32 " at (%.3f, %.3f, %.3f)%s",
            names[b->kind >= 1 && b->kind <= 4 ? b->kind : 0], b->index + 1, b->count, b->epoch, b->body,
            b->position[0], b->position[1], b->position[2], b->teleport ? ", jumped there" : "");
}

static void words_world(FILE *to, const tahr_world_t *w)
{
    fprintf(to,
            "level '%s' (%016" PRIx64 ") on %s, tahr %s, %" PRId32 " characters, epoch %" PRId64 ", %" PRId64
            " dropped, %" PRId64 " failed",
            w->level, (uint64_t)w->level_hash, w->backend, w->version, w->characters, w->epoch, w->dropped, w->failed);
}

void line_words(FILE *to, const char *channel, const struct message *m)
{
    fputs(channel, to);
    if (m->character >= 0) {
        fprintf(to, " %" PRId32 ", step %" PRId64, m->character, m->step);
    }
    fputs(": ", to);
    switch (m->kind) {
    case TAHR_MESSAGE_STATE: words_state(to, &m->is.state); break;
    case TAHR_MESSAGE_EVENT:
        fprintf(to, "%s at (%.3f, %.3f, %.3f), value %.6g", tahr_event_name((uint32_t)m->is.event.type),
                m->is.event.position[0], m->is.event.position[1], m->is.event.position[2], m->is.event.value);
        break;
    case TAHR_MESSAGE_INPUT: words_input(to, &m->is.input); break;
    case TAHR_MESSAGE_REPORT:
        fprintf(to, "%s, %" PRId32 " sweeps, %" PRId32 " contact queries, state %016" PRIx64,
                tahr_status_name(m->is.report.status), m->is.report.sweeps, m->is.report.contact_queries,
                (uint64_t)m->is.report.state_hash);
        break;
    case TAHR_MESSAGE_SNAPSHOT:
        fprintf(to, "state %016" PRIx64 ", %" PRId32 " bytes", (uint64_t)m->is.snapshot.state_hash,
                m->is.snapshot.size);
        break;
    case TAHR_MESSAGE_BODY: words_body(to, &m->is.body); break;
    default: words_world(to, &m->is.world); break;
    }
    fputc('\n', to);
}
