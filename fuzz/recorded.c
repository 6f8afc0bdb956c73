/* SPDX-License-Identifier: MIT
 * recorded.c: see recorded.h. All goes the way that it goes in a game: telemetry, its thread, the sink on LCM. */
#ifdef TAHR_HAVE_LCM

#include "recorded.h"

#include "target.h"

#include <lcm/lcm.h>
#include <string.h>
#include <tahr/lcm.h>
#include <tahr/native.h>
#include <tahr/telemetry.h>

enum { LIFT = 1, EVENTS = 8 };

static const double DT = 1.0 / 60;

tahr_world *recorded_world(void)
{
    tahr_body_desc bodies[2];
    tahr_world_desc desc;
    tahr_world *world = NULL;
    for (int i = 0; i < 2; i++)
        tahr_body_desc_init(&bodies[i], sizeof bodies[i], TAHR_BODY_BOX);
    bodies[0].half_extents = (tahr_vec3){20, 20, 1};
    bodies[0].pose.position = (tahr_vec3){0, 0, -1};
    bodies[LIFT].flags |= TAHR_BODY_MOVABLE;
    bodies[LIFT].half_extents = (tahr_vec3){1, 1, 0.1};
    bodies[LIFT].pose.position = (tahr_vec3){5, 0, 0.1};
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = bodies;
    desc.body_count = 2;
    FUZZ_CHECK(tahr_world_open(tahr_backend_v1_native(), &desc, &world) == TAHR_OK, "no world");
    return world;
}

static void keep(const lcm_recv_buf_t *buffer, const char *channel, void *user)
{
    recorded *r = user;
    if (r->count == r->capacity) {
        r->capacity = r->capacity ? 2 * r->capacity : 256;
        r->messages = realloc(r->messages, r->capacity * sizeof *r->messages);
        FUZZ_CHECK(r->messages != NULL, "no memory");
    }
    recorded_message *m = &r->messages[r->count++];
    m->size = buffer->data_size;
    m->data = malloc(m->size);
    FUZZ_CHECK(m->data != NULL, "no memory");
    memcpy(m->data, buffer->data, m->size);
    snprintf(m->channel, sizeof m->channel, "%s", channel);
}

static void move_lift(tahr_world *world, tahr_telemetry *telemetry, int tick)
{
    const tahr_body_pose pose = {.body = LIFT, .pose = {{5, 0, 0.1 + 0.02 * tick}, {0, 0, 0, 1}}};
    FUZZ_CHECK(tahr_world_move(world, &pose, 1, DT) == TAHR_OK, "the lift does not move");
    tahr_telemetry_change(telemetry, TAHR_CHANGE_MOVE, &pose, 1, DT, tahr_world_revision(world));
}

static void step(tahr_telemetry *telemetry, tahr_mover *mover, tahr_state *state, uint32_t id, int tick)
{
    tahr_event events[EVENTS];
    tahr_report report = {.struct_size = sizeof report, .events = events, .event_capacity = EVENTS};
    const tahr_input input = {
        .struct_size = sizeof input, .move = {id == 0 ? 1 : 0.1, 0.2, 0}, .jump = id == 0 && tick > 5 && tick < 12};
    tahr_telemetry_begin(telemetry, 0, id, 0, state);
    const tahr_status status = tahr_mover_step(mover, &input, DT, state, &report);
    FUZZ_CHECK(status >= 0, "%s", tahr_status_name(status));
    tahr_telemetry_push(telemetry, 0,
                        &(tahr_telemetry_step){.character = id,
                                               .status = status,
                                               .input = &input,
                                               .state = state,
                                               .report = &report,
                                               .dt = DT,
                                               .wall_ns = 1 + tick});
}

static void play(tahr_world *world, tahr_telemetry *telemetry, const tahr_config *config)
{
    tahr_mover *movers[RECORDED_CHARACTERS];
    tahr_state states[RECORDED_CHARACTERS];
    for (uint32_t i = 0; i < RECORDED_CHARACTERS; i++) {
        FUZZ_CHECK(tahr_mover_create(world, config, &movers[i]) == TAHR_OK, "no mover");
        tahr_state_init(&states[i], config, &(tahr_vec3){5.0 * i, 0, 1.2});
    }
    for (int tick = 0; tick < RECORDED_STEPS; tick++) {
        if (tick % 4 == 0) move_lift(world, telemetry, tick);
        if (tick == 25) states[0].velocity.z = 3;
        for (uint32_t i = 0; i < RECORDED_CHARACTERS; i++)
            step(telemetry, movers[i], &states[i], i, tick);
    }
    for (uint32_t i = 0; i < RECORDED_CHARACTERS; i++)
        tahr_mover_destroy(movers[i]);
}

static void record(recorded *r, lcm_t *bus)
{
    const tahr_lcm_desc to = {.struct_size = sizeof to, .lcm = bus, .rate = UINT32_MAX};
    tahr_telemetry_desc desc = {.struct_size = sizeof desc,
                                .characters = RECORDED_CHARACTERS,
                                .bodies = 2,
                                .configs = &r->config,
                                .config_count = 1,
                                .snapshot_period = 0.25};
    tahr_world *world = recorded_world();
    tahr_telemetry *telemetry;
    tahr_lcm *lcm;
    tahr_config_init(&r->config, sizeof r->config, TAHR_PRESET_PRECISE);
    FUZZ_CHECK(tahr_lcm_open(&to, &lcm) == TAHR_OK, "no LCM");
    desc.sink = tahr_lcm_sink(lcm);
    desc.backend = tahr_world_backend_name(world);
    FUZZ_CHECK(tahr_telemetry_create(&desc, &telemetry) == TAHR_OK, "no telemetry");
    play(world, telemetry, &r->config);
    FUZZ_CHECK(tahr_telemetry_stop(telemetry, TAHR_STOP_DRAIN, 60) == TAHR_OK, "not drained");
    tahr_telemetry_destroy(telemetry);
    tahr_lcm_close(lcm);
    tahr_world_close(world);
}

const recorded *recorded_run(void)
{
    static recorded run;
    if (run.count == 0) {
        lcm_t *bus = lcm_create("memq://");
        FUZZ_CHECK(bus != NULL, "no memq");
        lcm_subscription_t *all = lcm_subscribe(bus, ".*", keep, &run);
        lcm_subscription_set_queue_capacity(all, 1 << 16);
        record(&run, bus);
        while (lcm_handle_timeout(bus, 0) > 0) {
        }
        lcm_destroy(bus);
    }
    return &run;
}

#else

typedef int recorded_is_empty;

#endif
