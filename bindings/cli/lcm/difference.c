/* SPDX-License-Identifier: MIT
 * difference.c: in which fields a state or an event differs from a recorded one. */
#include "difference.h"

#include <inttypes.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

enum { FIELDS_SAID = 6 }; /* the first ones say what went wrong; later ones follow from them */

enum field_type { REAL, WHOLE, LONG };

static const struct {
    const char *name;
    size_t offset;
    enum field_type type;
    size_t count;
} fields[] = {
#define FIELD(name, type, count) #name, offsetof(tahr_state, name), type, count
    {FIELD(position, REAL, 3)},
    {FIELD(velocity, REAL, 3)},
    {FIELD(orientation, REAL, 4)},
    {FIELD(up, REAL, 3)},
    {FIELD(mode, WHOLE, 1)},
    {FIELD(flags, WHOLE, 1)},
    {FIELD(floor.normal, REAL, 3)},
    {FIELD(floor.surface_normal, REAL, 3)},
    {FIELD(floor.point, REAL, 3)},
    {FIELD(floor.distance, REAL, 1)},
    {FIELD(floor.perch_distance, REAL, 1)},
    {FIELD(floor.flags, WHOLE, 1)},
    {FIELD(floor.body, WHOLE, 1)},
    {FIELD(floor.feature, WHOLE, 1)},
    {FIELD(floor.surface, WHOLE, 1)},
    {FIELD(floor_position, REAL, 3)},
    {FIELD(floor_revision, LONG, 1)},
    {FIELD(jump_hold, REAL, 1)},
    {FIELD(radius, REAL, 1)},
    {FIELD(half_height, REAL, 1)},
    {FIELD(base.body, WHOLE, 1)},
    {FIELD(base.seen, WHOLE, 1)},
    {FIELD(base.pose, REAL, 7)},
    {FIELD(base.velocity, REAL, 3)},
    {FIELD(touched, WHOLE, TAHR_MAX_TOUCHED)},
    {FIELD(touched_count, WHOLE, 1)},
    {FIELD(jump_count, WHOLE, 1)},
    {FIELD(coyote_left, REAL, 1)},
    {FIELD(buffer_left, REAL, 1)},
    {FIELD(lift_left, REAL, 1)},
    {FIELD(wall_left, REAL, 1)},
    {FIELD(wall_normal, REAL, 3)},
    {FIELD(wall_body, WHOLE, 1)},
    {FIELD(wall_feature, WHOLE, 1)},
    {FIELD(drop_body, WHOLE, 1)},
    {FIELD(drop_feature, WHOLE, 1)},
#undef FIELD
};

/* What is said so far. */
struct saying {
    char *text;
    size_t size;
    int count;
};

static void say_field(struct saying *s, const char *name, size_t index, size_t of, const char *ours, const char *theirs)
{
    const size_t used = strlen(s->text);
    char which[24] = "";
    if (of == 3) {
        snprintf(which, sizeof which, ".%c", "xyz"[index]);
    } else if (of > 1) {
        snprintf(which, sizeof which, "[%zu]", index);
    }
    if (s->count++ < FIELDS_SAID) {
        snprintf(s->text + used, s->size - used, "%s%s%s is %s, recorded %s", used > 0 ? "; " : "", name, which, ours,
                 theirs);
    } else if (s->count == FIELDS_SAID + 1) {
        snprintf(s->text + used, s->size - used, "; ...");
    }
}

static void compare_reals(struct saying *s, const char *name, const double *ours, const double *theirs, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        char a[32], b[32];
        if (ours[i] == theirs[i]) {
            continue; /* -0 and 0 have one hash */
        }
        snprintf(a, sizeof a, "%.17g", ours[i]);
        snprintf(b, sizeof b, "%.17g", theirs[i]);
        say_field(s, name, i, count, a, b);
    }
}

static void compare_whole(struct saying *s, const char *name, size_t index, size_t of, const uint64_t pair[2])
{
    char a[32], b[32];
    if (pair[0] != pair[1]) {
        snprintf(a, sizeof a, "%" PRIu64, pair[0]);
        snprintf(b, sizeof b, "%" PRIu64, pair[1]);
        say_field(s, name, index, of, a, b);
    }
}

static void compare_states(struct saying *saying, const tahr_state *state, const tahr_state *recorded)
{
    for (size_t f = 0; f < sizeof fields / sizeof *fields; f++) {
        const uint8_t *ours = (const uint8_t *)state + fields[f].offset;
        const uint8_t *theirs = (const uint8_t *)recorded + fields[f].offset;
        for (size_t i = 0; i < fields[f].count && fields[f].type == WHOLE; i++) {
            uint32_t a = 0, b = 0;
            memcpy(&a, ours + i * sizeof a, sizeof a);
            memcpy(&b, theirs + i * sizeof b, sizeof b);
            compare_whole(saying, fields[f].name, i, fields[f].count, (uint64_t[2]){a, b});
        }
        if (fields[f].type == LONG) {
            uint64_t pair[2];
            memcpy(&pair[0], ours, sizeof pair[0]);
            memcpy(&pair[1], theirs, sizeof pair[1]);
            compare_whole(saying, fields[f].name, 0, 1, pair);
        }
        if (fields[f].type == REAL) {
            double a[8], b[8];
            memcpy(a, ours, fields[f].count * sizeof *a);
            memcpy(b, theirs, fields[f].count * sizeof *b);
            compare_reals(saying, fields[f].name, a, b, fields[f].count);
        }
    }
}

static struct saying begin(char *text, size_t size)
{
    text[0] = 0;
    return (struct saying){text, size, 0};
}

int difference_of_states(const tahr_state *state, const tahr_state *recorded, char *text, size_t size)
{
    struct saying saying = begin(text, size);
    compare_states(&saying, state, recorded);
    return saying.count;
}

/* Of a state what its message holds, so that there is one comparison. */
static tahr_state state_of(const tahr_state *state, const tahr_state_t *m)
{
    tahr_state s = *state;
    s.position = (tahr_vec3){m->position[0], m->position[1], m->position[2]};
    s.velocity = (tahr_vec3){m->velocity[0], m->velocity[1], m->velocity[2]};
    s.orientation = (tahr_quat){m->orientation[0], m->orientation[1], m->orientation[2], m->orientation[3]};
    s.up = (tahr_vec3){m->up[0], m->up[1], m->up[2]};
    s.mode = (uint32_t)m->mode;
    s.flags = (uint32_t)m->flags;
    s.radius = m->radius;
    s.half_height = m->half_height;
    s.base.body = (uint32_t)m->base_body;
    s.floor.flags = (uint32_t)m->floor_flags;
    s.floor.body = (uint32_t)m->floor_body;
    s.floor.feature = (uint32_t)m->floor_feature;
    s.floor.surface = (uint32_t)m->floor_surface;
    s.floor.distance = m->floor_distance;
    s.floor.normal = (tahr_vec3){m->floor_normal[0], m->floor_normal[1], m->floor_normal[2]};
    s.floor.surface_normal =
        (tahr_vec3){m->floor_surface_normal[0], m->floor_surface_normal[1], m->floor_surface_normal[2]};
    s.floor.point = (tahr_vec3){m->floor_point[0], m->floor_point[1], m->floor_point[2]};
    return s;
}

/* What the message says once more, so that who listens need not know the bits. */
static void compare_floor(struct saying *saying, uint32_t flags, const tahr_state_t *m)
{
    const struct {
        const char *name;
        uint32_t bit;
        int recorded;
    } said[] = {{"floor_blocking", TAHR_FLOOR_BLOCKING, m->floor_blocking},
                {"floor_walkable", TAHR_FLOOR_WALKABLE, m->floor_walkable},
                {"floor_perching", TAHR_FLOOR_PERCHING, m->floor_perching}};
    for (size_t i = 0; i < sizeof said / sizeof *said; i++) {
        compare_whole(saying, said[i].name, 0, 1, (uint64_t[2]){(flags & said[i].bit) != 0, said[i].recorded != 0});
    }
}

int difference_of_message(const tahr_state *state, const tahr_state_t *recorded, char *text, size_t size)
{
    struct saying saying = begin(text, size);
    const tahr_state theirs = state_of(state, recorded);
    compare_states(&saying, state, &theirs);
    compare_floor(&saying, state->floor.flags, recorded);
    return saying.count;
}

int difference_of_event(const tahr_event *event, const tahr_event_t *recorded, char *text, size_t size)
{
    struct saying saying = begin(text, size);
    const double position[3] = {event->position.x, event->position.y, event->position.z};
    const double normal[3] = {event->normal.x, event->normal.y, event->normal.z};
    compare_whole(&saying, "type", 0, 1, (uint64_t[2]){event->type, (uint32_t)recorded->type});
    compare_whole(&saying, "body", 0, 1, (uint64_t[2]){event->body, (uint32_t)recorded->body});
    compare_whole(&saying, "feature", 0, 1, (uint64_t[2]){event->feature, (uint32_t)recorded->feature});
    compare_whole(&saying, "surface", 0, 1, (uint64_t[2]){event->surface, (uint32_t)recorded->surface});
    compare_reals(&saying, "value", &event->value, &recorded->value, 1);
    compare_reals(&saying, "position", position, recorded->position, 3);
    compare_reals(&saying, "normal", normal, recorded->normal, 3);
    return saying.count;
}
