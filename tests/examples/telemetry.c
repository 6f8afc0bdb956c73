/* SPDX-License-Identifier: MIT
 * telemetry.c: a character runs and jumps; what happens to it is printed by another thread, which no step waits for.
 * By hand, with Tahr installed and PKG_CONFIG_PATH pointing to its lib/pkgconfig:
 *     cc -std=c11 telemetry.c $(pkg-config --cflags --libs tahr_threads tahr) -pthread -o telemetry */
#include <stdio.h>
#include <tahr/native.h>
#include <tahr/tahr.h>
#include <tahr/telemetry.h>

static tahr_status print_event(void *user, const tahr_stamp *stamp, const tahr_event *event)
{
    (void)user;
    printf("%6.3f s  character %u: %s at (%.2f, %.2f, %.2f)\n", 1e-9 * (double)stamp->time_ns, stamp->character,
           tahr_event_name(event->type), event->position.x, event->position.y, event->position.z);
    return TAHR_OK;
}

static int walk(tahr_mover *mover, tahr_state *state, tahr_telemetry *telemetry)
{
    const double dt = 1.0 / 60;
    for (int i = 0; i < 120; i++) {
        tahr_event events[8];
        tahr_report report = {.struct_size = sizeof report, .events = events, .event_capacity = 8};
        const tahr_input input = {.struct_size = sizeof input, .move = {1, 0, 0}, .jump = i == 30};
        if (tahr_telemetry_begin(telemetry, 0, 0, 0, state) < 0) return 0;
        const tahr_status status = tahr_mover_step(mover, &input, dt, state, &report);
        const tahr_telemetry_step step = {
            .character = 0, .status = status, .input = &input, .state = state, .report = &report, .dt = dt};
        if (status < 0 || tahr_telemetry_push(telemetry, 0, &step) < 0) return 0;
    }
    return 1;
}

int main(void)
{
    const tahr_sink printer = {.struct_size = sizeof printer,
                               .abi_major = TAHR_ABI_MAJOR,
                               .abi_minor = TAHR_ABI_MINOR,
                               .name = "printer",
                               .event = print_event}; /* nothing else is wanted */
    tahr_body_desc ground;
    tahr_world_desc scene;
    tahr_config config;
    tahr_state state;
    tahr_telemetry_desc desc;
    tahr_world *world = NULL;
    tahr_mover *mover = NULL;
    tahr_telemetry *telemetry = NULL;

    tahr_body_desc_init(&ground, sizeof ground, TAHR_BODY_BOX);
    ground.half_extents = (tahr_vec3){100, 100, 1};
    tahr_world_desc_init(&scene, sizeof scene);
    scene.bodies = &ground;
    scene.body_count = 1;
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
    tahr_state_init(&state, &config, &(tahr_vec3){0, 0, 2.5});
    if (tahr_world_open(tahr_backend_v1_native(), &scene, &world) < 0) return 1;
    if (tahr_mover_create(world, &config, &mover) < 0) return 1;

    tahr_telemetry_desc_init(&desc, sizeof desc);
    desc.sink = &printer;
    desc.characters = 1;
    desc.configs = &config;
    desc.config_count = 1;
    if (tahr_telemetry_create(&desc, &telemetry) < 0) return 1;
    const int walked = walk(mover, &state, telemetry);
    const tahr_status told = tahr_telemetry_stop(telemetry, TAHR_STOP_DRAIN, 5); /* seconds, at most */
    tahr_telemetry_destroy(telemetry);
    tahr_mover_destroy(mover);
    tahr_world_close(world);
    return walked && told == TAHR_OK ? 0 : 1;
}
