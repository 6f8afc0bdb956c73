/* SPDX-License-Identifier: MIT
 * Every kind of message, field by field, from the sink to a subscriber. */
#include "inbox.h"

#include <tahr/tahr.h>
#include <tahr/lcm.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

/* A number that no other field has, as an integer of four or eight bytes and as a double between 1 and 4. */
static void fill(void *memory, size_t size)
{
    static uint32_t number;
    for (size_t i = 0; i + 4 <= size; i += 4) {
        const uint32_t word = 0x3FF00000u + ++number * 0x0101u;
        memcpy((unsigned char *)memory + i, &word, 4);
    }
}

/* The same bits, and as many. */
#define SAME(a, b)                                  \
    do {                                            \
        assert_true(sizeof(a) == sizeof(b));        \
        assert_memory_equal(&(a), &(b), sizeof(a)); \
    } while (0)

typedef struct rig {
    lcm_t *lcm;
    tahr_lcm *opened;
    const tahr_sink *sink;
    inbox box;
} rig;

static void open_rig(rig *r, const char *prefix, uint32_t flags)
{
    tahr_lcm_desc desc;

    r->lcm = lcm_create("memq://");
    assert_non_null(r->lcm);
    assert_int_equal(tahr_lcm_desc_init(&desc, sizeof desc), TAHR_OK);
    desc.lcm = r->lcm;
    desc.prefix = prefix;
    desc.flags = flags;
    assert_int_equal(tahr_lcm_open(&desc, &r->opened), TAHR_OK);
    r->sink = tahr_lcm_sink(r->opened);
    inbox_open(&r->box, r->lcm, prefix ? prefix : "", flags & TAHR_LCM_ID_SUFFIX ? "_.*" : "");
}

static void close_rig(rig *r)
{
    tahr_lcm_close(r->opened);
    inbox_close(&r->box);
    lcm_destroy(r->lcm);
}

static void check_stamp(const tahr_stamp *stamp, int32_t character, int64_t step, int64_t sequence, int64_t time_ns,
                        int64_t wall_ns)
{
    SAME(stamp->character, character);
    SAME(stamp->step, step);
    SAME(stamp->sequence, sequence);
    SAME(stamp->time_ns, time_ns);
    SAME(stamp->wall_ns, wall_ns);
}
#define CHECK_STAMP(stamp, m) check_stamp(&(stamp), (m).character, (m).step, (m).sequence, (m).time_ns, (m).wall_ns)

static void a_state_arrives_whole(void **unused)
{
    rig r;
    tahr_stamp stamp;
    tahr_state state;
    const tahr_state_t *m = &r.box.state;
    (void)unused;
    open_rig(&r, NULL, 0);
    fill(&stamp, sizeof stamp);
    fill(&state, sizeof state);
    assert_int_equal(r.sink->state(r.sink->user, &stamp, &state), TAHR_OK);
    assert_true(inbox_wait(&r.box, TAHR_MESSAGE_STATE, 1));
    assert_string_equal(r.box.channel, "TAHR_STATE");
    CHECK_STAMP(stamp, *m);
    SAME(m->mode, state.mode);
    SAME(m->position, state.position);
    SAME(m->velocity, state.velocity);
    SAME(m->orientation, state.orientation);
    SAME(m->up, state.up);
    SAME(m->radius, state.radius);
    SAME(m->half_height, state.half_height);
    SAME(m->flags, state.flags);
    SAME(m->base_body, state.base.body);
    SAME(m->floor_flags, state.floor.flags);
    SAME(m->floor_body, state.floor.body);
    SAME(m->floor_feature, state.floor.feature);
    SAME(m->floor_surface, state.floor.surface);
    SAME(m->floor_distance, state.floor.distance);
    SAME(m->floor_normal, state.floor.normal);
    SAME(m->floor_surface_normal, state.floor.surface_normal);
    SAME(m->floor_point, state.floor.point);
    close_rig(&r);
}

static void the_flags_of_a_floor_are_told_apart(void **unused)
{
    rig r;
    tahr_stamp stamp = {0};
    tahr_state state;
    (void)unused;
    open_rig(&r, NULL, 0);
    memset(&state, 0, sizeof state);
    for (uint32_t i = 0; i < 8; i++) {
        state.floor.flags = 1u << i;
        assert_int_equal(r.sink->state(r.sink->user, &stamp, &state), TAHR_OK);
        assert_true(inbox_wait(&r.box, TAHR_MESSAGE_STATE, i + 1));
        assert_int_equal(r.box.state.floor_blocking, state.floor.flags == TAHR_FLOOR_BLOCKING);
        assert_int_equal(r.box.state.floor_walkable, state.floor.flags == TAHR_FLOOR_WALKABLE);
        assert_int_equal(r.box.state.floor_perching, state.floor.flags == TAHR_FLOOR_PERCHING);
    }
    close_rig(&r);
}

static void an_event_arrives_whole(void **unused)
{
    rig r;
    tahr_stamp stamp;
    tahr_event event;
    const tahr_event_t *m = &r.box.event;
    (void)unused;
    open_rig(&r, NULL, 0);
    fill(&stamp, sizeof stamp);
    fill(&event, sizeof event);
    event.surface = TAHR_NO_BODY;
    assert_int_equal(r.sink->event(r.sink->user, &stamp, &event), TAHR_OK);
    assert_true(inbox_wait(&r.box, TAHR_MESSAGE_EVENT, 1));
    assert_string_equal(r.box.channel, "TAHR_EVENT");
    CHECK_STAMP(stamp, *m);
    SAME(m->type, event.type);
    SAME(m->body, event.body);
    SAME(m->feature, event.feature);
    assert_int_equal(m->surface, -1);
    SAME(m->value, event.value);
    SAME(m->position, event.position);
    SAME(m->normal, event.normal);
    close_rig(&r);
}

static void an_input_arrives_whole(void **unused)
{
    rig r;
    tahr_stamp stamp;
    tahr_input input;
    tahr_sink_input given;
    const tahr_input_t *m = &r.box.input;
    (void)unused;
    open_rig(&r, NULL, 0);
    fill(&stamp, sizeof stamp);
    fill(&input, sizeof input);
    fill(&given, sizeof given);
    given.input = &input;
    assert_int_equal(r.sink->input(r.sink->user, &stamp, &given), TAHR_OK);
    assert_true(inbox_wait(&r.box, TAHR_MESSAGE_INPUT, 1));
    assert_string_equal(r.box.channel, "TAHR_INPUT");
    CHECK_STAMP(stamp, *m);
    SAME(m->config, stamp.config);
    SAME(m->epoch, stamp.epoch);
    SAME(m->dt, given.dt);
    SAME(m->step_flags, given.flags);
    SAME(m->flags, input.flags);
    SAME(m->jump, input.jump);
    SAME(m->crouch, input.crouch);
    SAME(m->mode, input.mode);
    SAME(m->move, input.move);
    SAME(m->facing, input.facing);
    SAME(m->gravity, input.gravity);
    SAME(m->radius, input.radius);
    SAME(m->half_height, input.half_height);
    SAME(m->launch, input.launch);
    SAME(m->impulse, input.impulse);
    SAME(m->drive, input.drive);
    close_rig(&r);
}

static void a_report_arrives_whole(void **unused)
{
    rig r;
    tahr_stamp stamp;
    tahr_report report;
    tahr_sink_report given;
    const tahr_report_t *m = &r.box.report;
    (void)unused;
    open_rig(&r, NULL, 0);
    fill(&stamp, sizeof stamp);
    fill(&report, sizeof report);
    fill(&given, sizeof given);
    report.events = NULL;
    report.decisions = NULL;
    report.queries = NULL;
    given.report = &report;
    given.hash |= 1ull << 63;
    assert_int_equal(r.sink->report(r.sink->user, &stamp, &given), TAHR_OK);
    assert_true(inbox_wait(&r.box, TAHR_MESSAGE_REPORT, 1));
    assert_string_equal(r.box.channel, "TAHR_REPORT");
    CHECK_STAMP(stamp, *m);
    SAME(m->status, given.status);
    SAME(m->state_hash, given.hash);
    SAME(m->duration_ns, given.ns);
    SAME(m->flags, report.flags);
    SAME(m->event_count, report.event_count);
    SAME(m->events_lost, report.events_lost);
    SAME(m->sweeps, report.sweeps);
    SAME(m->contact_queries, report.contact_queries);
    SAME(m->rays, report.rays);
    SAME(m->fluid_queries, report.fluid_queries);
    SAME(m->slides, report.slides);
    SAME(m->slices, report.slices);
    SAME(m->arcs, report.arcs);
    SAME(m->triangle_tests, report.triangle_tests);
    SAME(m->narrow_iterations, report.narrow_iterations);
    SAME(m->gathers, report.gathers);
    SAME(m->escapes, report.escapes);
    SAME(m->saved, report.saved);
    SAME(m->step_offset, report.step_offset);
    SAME(m->residual, report.residual);
    SAME(m->time_lost, report.time_lost);
    close_rig(&r);
}

static void a_snapshot_arrives_with_all_bytes_of_the_state_and_their_hash(void **unused)
{
    rig r;
    tahr_stamp stamp;
    tahr_state state;
    const tahr_snapshot_t *m = &r.box.snapshot;
    (void)unused;
    open_rig(&r, NULL, 0);
    fill(&stamp, sizeof stamp);
    fill(&state, sizeof state);
    const uint64_t hash = tahr_state_hash(&state);
    assert_int_equal(r.sink->snapshot(r.sink->user, &stamp, &state), TAHR_OK);
    assert_true(inbox_wait(&r.box, TAHR_MESSAGE_SNAPSHOT, 1));
    assert_string_equal(r.box.channel, "TAHR_SNAPSHOT");
    CHECK_STAMP(stamp, *m);
    SAME(m->config, stamp.config);
    SAME(m->epoch, stamp.epoch);
    SAME(m->state_hash, hash);
    assert_int_equal(m->size, sizeof state);
    assert_memory_equal(m->state, &state, sizeof state);
    close_rig(&r);
}

static void check_body(const tahr_body_t *m, const tahr_sink_change *change, uint32_t index)
{
    const tahr_body_pose *now = &change->poses[index], *before = change->before ? &change->before[index] : now;
    SAME(m->epoch, change->epoch);
    SAME(m->revision, change->revision);
    SAME(m->wall_ns, change->wall_ns);
    SAME(m->kind, change->kind);
    SAME(m->count, change->count);
    SAME(m->index, index);
    SAME(m->dt, change->dt);
    SAME(m->body, now->body);
    assert_int_equal(m->teleport, now->flags == TAHR_POSE_TELEPORT);
    SAME(m->position, now->pose.position);
    SAME(m->orientation, now->pose.orientation);
    SAME(m->before_position, before->pose.position);
    SAME(m->before_orientation, before->pose.orientation);
}

static void every_body_of_a_change_arrives(void **unused)
{
    enum { COUNT = 3 };
    rig r;
    tahr_body_pose poses[COUNT], before[COUNT];
    tahr_sink_change change;
    (void)unused;
    open_rig(&r, NULL, 0);
    fill(poses, sizeof poses);
    fill(before, sizeof before);
    fill(&change, sizeof change);
    for (uint32_t i = 0; i < COUNT; i++)
        poses[i].flags = i == 1 ? TAHR_POSE_TELEPORT : 0;
    change.poses = poses;
    change.before = before;
    change.count = COUNT;
    assert_int_equal(r.sink->change(r.sink->user, &change), TAHR_OK);
    change.before = NULL;
    assert_int_equal(r.sink->change(r.sink->user, &change), TAHR_OK);
    assert_true(inbox_wait(&r.box, TAHR_MESSAGE_BODY, 2 * COUNT));
    assert_string_equal(r.box.channel, "TAHR_BODY");
    for (uint32_t i = 0; i < COUNT; i++) {
        change.before = before;
        check_body(&r.box.bodies[i], &change, i);
        change.before = NULL;
        check_body(&r.box.bodies[COUNT + i], &change, i);
    }
    close_rig(&r);
}

static void a_change_without_bodies_is_one_message(void **unused)
{
    rig r;
    const tahr_sink_change change = {.kind = TAHR_CHANGE_TOUCH, .epoch = 7, .revision = 9};
    (void)unused;
    open_rig(&r, NULL, 0);
    assert_int_equal(r.sink->change(r.sink->user, &change), TAHR_OK);
    assert_true(inbox_wait(&r.box, TAHR_MESSAGE_BODY, 1));
    assert_int_equal(lcm_handle_timeout(r.lcm, 0), 0);
    assert_int_equal(r.box.bodies[0].kind, TAHR_BODY_T_TOUCH);
    assert_int_equal(r.box.bodies[0].count, 0);
    assert_int_equal(r.box.bodies[0].index, 0);
    assert_int_equal(r.box.bodies[0].body, -1);
    assert_int_equal(r.box.bodies[0].epoch, 7);
    assert_int_equal(r.box.bodies[0].revision, 9);
    close_rig(&r);
}

static void check_world(const tahr_world_t *m, const tahr_sink_world *world)
{
    SAME(m->run, world->run);
    SAME(m->wall_ns, world->wall_ns);
    SAME(m->sequence, world->sequence);
    assert_string_equal(m->level, world->level);
    SAME(m->level_hash, world->level_hash);
    assert_string_equal(m->backend, world->backend);
    assert_string_equal(m->version, tahr_version());
    assert_int_equal(m->abi, TAHR_ABI);
    SAME(m->characters, world->characters);
    SAME(m->epoch, world->epoch);
    SAME(m->revision, world->revision);
    SAME(m->dropped, world->dropped);
    SAME(m->failed, world->failed);
    SAME(m->state_rate, world->state_rate);
    SAME(m->config_count, world->config_count);
    assert_int_equal(m->config_size, sizeof(tahr_config));
    assert_int_equal(m->size, world->config_count * sizeof(tahr_config));
    assert_memory_equal(m->configs, world->configs, world->config_count * sizeof(tahr_config));
}

/* Also one that is longer than the last, and one that is shorter. */
static void a_world_arrives_with_the_settings_of_all(void **unused)
{
    enum { MOST = 8 };
    static const uint32_t counts[] = {2, MOST, 1};
    rig r;
    tahr_config configs[MOST];
    tahr_sink_world world;
    (void)unused;
    open_rig(&r, NULL, 0);
    fill(configs, sizeof configs);
    for (uint32_t i = 0; i < MOST; i++)
        configs[i].struct_size = sizeof configs[i];
    for (uint32_t i = 0; i < sizeof counts / sizeof counts[0]; i++) {
        fill(&world, sizeof world);
        world.level = "playground of a name that is not short";
        world.backend = "native";
        world.configs = configs;
        world.config_count = counts[i];
        assert_int_equal(r.sink->world(r.sink->user, &world), TAHR_OK);
        assert_true(inbox_wait(&r.box, TAHR_MESSAGE_WORLD, i + 1));
        assert_string_equal(r.box.channel, "TAHR_WORLD");
        check_world(&r.box.world, &world);
    }
    close_rig(&r);
}

static void a_world_longer_than_a_message_may_be_is_refused(void **unused)
{
    rig r;
    tahr_config config = {.struct_size = sizeof config};
    const tahr_sink_world world = {.configs = &config, .config_count = 1u << 31};
    (void)unused;
    open_rig(&r, NULL, 0);
    assert_int_equal(r.sink->world(r.sink->user, &world), TAHR_E_UNSUPPORTED);
    close_rig(&r);
}

static void publish_all(const tahr_sink *sink, uint32_t character)
{
    const tahr_stamp stamp = {.character = character};
    const tahr_state state = {.radius = 1};
    const tahr_event event = {.type = TAHR_EVENT_HIT};
    const tahr_input input = {.struct_size = sizeof input};
    const tahr_report report = {.struct_size = sizeof report};
    const tahr_sink_input given = {.input = &input};
    const tahr_sink_report said = {.report = &report};
    const tahr_sink_change change = {.kind = TAHR_CHANGE_TOUCH};
    const tahr_sink_world world = {.characters = 1};
    assert_int_equal(sink->state(sink->user, &stamp, &state), TAHR_OK);
    assert_int_equal(sink->event(sink->user, &stamp, &event), TAHR_OK);
    assert_int_equal(sink->input(sink->user, &stamp, &given), TAHR_OK);
    assert_int_equal(sink->report(sink->user, &stamp, &said), TAHR_OK);
    assert_int_equal(sink->snapshot(sink->user, &stamp, &state), TAHR_OK);
    assert_int_equal(sink->change(sink->user, &change), TAHR_OK);
    assert_int_equal(sink->world(sink->user, &world), TAHR_OK);
}

/* Channels in the order in which publish_all speaks. */
static void check_channels(rig *r, const char *const channels[TAHR_MESSAGE_COUNT])
{
    for (uint32_t i = 0; i < TAHR_MESSAGE_COUNT; i++) {
        assert_int_equal(lcm_handle_timeout(r->lcm, 5000), 1);
        assert_string_equal(r->box.channel, channels[i]);
    }
}

static void prefix_and_id_are_part_of_the_names(void **unused)
{
    static const char *const both[] = {"red/TAHR_STATE_1048575",  "red/TAHR_EVENT_1048575",    "red/TAHR_INPUT_1048575",
                                       "red/TAHR_REPORT_1048575", "red/TAHR_SNAPSHOT_1048575", "red/TAHR_BODY",
                                       "red/TAHR_WORLD"};
    rig r;
    (void)unused;
    open_rig(&r, "red/", TAHR_LCM_ID_SUFFIX);
    publish_all(r.sink, (1u << 20) - 1);
    check_channels(&r, both);
    close_rig(&r);
}

static void the_longest_names_fit(void **unused)
{
#define LONG "0123456789abcdef0123456789ABCDEF"
    static const char *const longest[] = {LONG "TAHR_STATE_4294967295",
                                          LONG "TAHR_EVENT_4294967295",
                                          LONG "TAHR_INPUT_4294967295",
                                          LONG "TAHR_REPORT_4294967295",
                                          LONG "TAHR_SNAPSHOT_4294967295",
                                          LONG "TAHR_BODY",
                                          LONG "TAHR_WORLD"};
    rig r;
    (void)unused;
    open_rig(&r, LONG, TAHR_LCM_ID_SUFFIX);
    publish_all(r.sink, UINT32_MAX);
    check_channels(&r, longest);
    close_rig(&r);
#undef LONG
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_state_arrives_whole),
        cmocka_unit_test(the_flags_of_a_floor_are_told_apart),
        cmocka_unit_test(an_event_arrives_whole),
        cmocka_unit_test(an_input_arrives_whole),
        cmocka_unit_test(a_report_arrives_whole),
        cmocka_unit_test(a_snapshot_arrives_with_all_bytes_of_the_state_and_their_hash),
        cmocka_unit_test(every_body_of_a_change_arrives),
        cmocka_unit_test(a_change_without_bodies_is_one_message),
        cmocka_unit_test(a_world_arrives_with_the_settings_of_all),
        cmocka_unit_test(a_world_longer_than_a_message_may_be_is_refused),
        cmocka_unit_test(prefix_and_id_are_part_of_the_names),
        cmocka_unit_test(the_longest_names_fit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
