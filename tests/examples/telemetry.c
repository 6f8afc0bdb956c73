/* SPDX-License-Identifier: MIT
 * telemetry.c: a sink of one's own: a character climbs stairs, and another thread hears of it, without the step ever
 * waiting for it.
 * By hand, with Tahr installed and PKG_CONFIG_PATH pointing to its lib/pkgconfig:
 *     cc -std=c11 telemetry.c $(pkg-config --cflags --libs tahr_threads tahr) -pthread -o telemetry */
#include <stdio.h>
#include <tahr/native.h>
#include <tahr/tahr.h>
#include <tahr/telemetry.h>

enum { STEPS = 180, STAIRS = 5 };

/* What the sink counts; only the telemetry's thread touches it until the telemetry has stopped. */
typedef struct heard {
    uint32_t states, climbed;
    double highest; /* m */
} heard;

static tahr_status hear_state(void *user, const tahr_stamp *stamp, const tahr_state *state)
{
    heard *h = user;
    (void)stamp;
    h->states++;
    h->highest = state->position.z > h->highest ? state->position.z : h->highest;
    return TAHR_OK;
}

static tahr_status hear_event(void *user, const tahr_stamp *stamp, const tahr_event *event)
{
    heard *h = user;
    if (event->type == TAHR_EVENT_STEPPED_UP) {
        h->climbed++;
        printf("%.3f s: character %u climbs %.2f m\n", (double)stamp->time_ns * 1e-9, stamp->character, event->value);
    }
    return TAHR_OK;
}

static tahr_world *open_stairs(void)
{
    tahr_body_desc bodies[STAIRS + 1];
    tahr_world_desc scene;
    tahr_world *world = NULL;
    for (int i = 0; i <= STAIRS; i++) { /* the ground, and steps of 0.2 m */
        tahr_body_desc_init(&bodies[i], sizeof bodies[i], TAHR_BODY_BOX);
        bodies[i].half_extents = (tahr_vec3){10, 10, 1};
        bodies[i].pose.position = (tahr_vec3){i == 0 ? 0 : 10.6 + 0.4 * i, 0, -1 + 0.2 * i};
    }
    tahr_world_desc_init(&scene, sizeof scene);
    scene.bodies = bodies;
    scene.body_count = STAIRS + 1;
    return tahr_world_open(tahr_backend_v1_native(), &scene, &world) < 0 ? NULL : world;
}

static tahr_status climb(tahr_mover *mover, tahr_telemetry *telemetry, tahr_state *state)
{
    const tahr_input input = {.struct_size = sizeof input, .move = {1, 0, 0}};
    tahr_status status = TAHR_OK;
    for (int i = 0; i < STEPS && status >= 0; i++) {
        tahr_event events[8];
        tahr_report report = {.struct_size = sizeof report, .events = events, .event_capacity = 8};
        tahr_telemetry_begin(telemetry, 0, 0, 0, state);
        status = tahr_mover_step(mover, &input, 1.0 / 60, state, &report);
        tahr_telemetry_push(
            telemetry, 0,
            &(tahr_telemetry_step){
                .character = 0, .status = status, .input = &input, .state = state, .report = &report, .dt = 1.0 / 60});
    }
    return status;
}

int main(void)
{
    heard all = {0};
    const tahr_sink sink = {.struct_size = sizeof sink,
                            .abi_major = TAHR_ABI_MAJOR,
                            .abi_minor = TAHR_ABI_MINOR,
                            .name = "print",
                            .user = &all,
                            .state = hear_state,
                            .event = hear_event};
    tahr_telemetry_desc desc;
    tahr_telemetry *telemetry = NULL;
    tahr_mover *mover = NULL;
    tahr_config config;
    tahr_state state;
    tahr_world *world = open_stairs();
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
    tahr_state_init(&state, &config, &(tahr_vec3){-0.5, 0, config.shape.half_height + config.skin});
    tahr_telemetry_desc_init(&desc, sizeof desc);
    desc.sink = &sink;
    desc.characters = 1;
    desc.configs = &config;
    desc.config_count = 1;
    if (!world || tahr_mover_create(world, &config, &mover) < 0 || tahr_telemetry_create(&desc, &telemetry) < 0) {
        return 1;
    }
    tahr_status status = climb(mover, telemetry, &state);
    tahr_status stopped = tahr_telemetry_stop(telemetry, TAHR_STOP_DRAIN, 5);
    tahr_telemetry_destroy(telemetry);
    tahr_mover_destroy(mover);
    tahr_world_close(world);
    printf("%u of %d states heard, the highest at %.2f m\n", all.states, STEPS, all.highest);
    return status >= 0 && stopped == TAHR_OK && all.states == STEPS && all.climbed == STAIRS ? 0 : 1;
}
