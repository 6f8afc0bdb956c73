/* SPDX-License-Identifier: MIT
 * crowd.c: a thousand characters meet in the middle of a square: none enters another one, on as many threads as there
 * are, and with the same bits on one.
 * By hand, with Tahr installed and PKG_CONFIG_PATH pointing to its lib/pkgconfig:
 *     cc -std=c11 -DTAHR_HAVE_THREADS crowd.c $(pkg-config --cflags --libs tahr_threads tahr) -pthread -o crowd */
#include <stdio.h>
#include <tahr/native.h>
#include <tahr/tahr.h>
#ifdef TAHR_HAVE_THREADS
#include <tahr/threads.h>
#endif

enum { COUNT = 1000 };
static tahr_state states[COUNT]; /* all that matters to the game */
static tahr_input inputs[COUNT];

int main(void)
{
    tahr_body_desc ground;
    tahr_world_desc scene;
    tahr_config config;
    tahr_crowd_desc desc;
    tahr_crowd_tick tick;
    tahr_world *world = NULL;
    tahr_crowd *crowd = NULL;

    tahr_body_desc_init(&ground, sizeof ground, TAHR_BODY_BOX);
    ground.half_extents = (tahr_vec3){100, 100, 1};
    tahr_world_desc_init(&scene, sizeof scene);
    scene.bodies = &ground;
    scene.body_count = 1;
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
    tahr_crowd_desc_init(&desc, sizeof desc);
    desc.capacity = COUNT;
    desc.configs = &config;
    desc.config_count = 1;
#ifdef TAHR_HAVE_THREADS
    tahr_threads *threads = NULL;
    if (tahr_threads_create(NULL, 0, &threads) < 0) return 1;
    desc.run_tasks = tahr_threads_run; /* or your own scheduler */
    desc.run_user = threads;
#endif
    if (tahr_world_open(tahr_backend_v1_native(), &scene, &world) < 0) return 1;
    if (tahr_crowd_create(world, &desc, &crowd) < 0) return 1;
    for (int i = 0; i < COUNT; i++) {
        tahr_vec3 place = {i % 32 - 16.0, i / 32 - 16.0, 1.92};
        if (tahr_state_init(&states[i], &config, &place) < 0) return 1;
        inputs[i].struct_size = sizeof inputs[i];
    }
    tahr_crowd_tick_init(&tick, sizeof tick);
    tick.count = COUNT;
    tick.dt = 1.0 / 60;
    tick.inputs = inputs;
    tick.states = states;
    for (int step = 0; step < 120; step++) {
        for (int i = 0; i < COUNT; i++) { /* to the middle; a wish longer than 1 counts as 1 */
            inputs[i].move = (tahr_vec3){-states[i].position.x, -states[i].position.y, 0};
        }
        if (tahr_crowd_step(crowd, &tick) < 0) return 1;
    }
    printf("the first one is at (%.3f, %.3f)\n", states[0].position.x, states[0].position.y);
    tahr_crowd_destroy(crowd);
    tahr_world_close(world);
#ifdef TAHR_HAVE_THREADS
    tahr_threads_destroy(threads);
#endif
    return 0;
}
