/* SPDX-License-Identifier: MIT
 * count_steps.c: fixed walks over fixed scenes on native, who sleeps, and who falls, for a tool that counts the
 * instructions of tahr_mover_step or tahr_crowd_step (count_steps.sh). Usage: count_steps SCENE; prints the number of
 * steps that it made. */
#include <stdio.h>
#include <string.h>

#include <tahr/crowd.h>
#include <tahr/native.h>
#include <tahr/tahr.h>

#include "scene_mesh.h"

static const double DT = 1.0 / 60;

/* QUIET: so many that those until a sleeper sleeps (some 20, of thousands of instructions) are less than 1 in a mean. */
enum { STEPS = 600, QUIET = 100000, CROWD = 256 };

/* A walk there and back: the wish turns round every so many steps. 0: it stands. */
typedef struct walk {
    const char *name;
    void (*make)(scene_mesh *mesh);
    tahr_vec3 start, wish; /* start: of the foot, m */
    int leg;               /* steps */
    int steps;
} walk;

static void make_flat(scene_mesh *mesh)
{
    scene_mesh_field(mesh, 16, 16, 4, NULL);
}

static void make_hills(scene_mesh *mesh)
{
    scene_mesh_field(mesh, 120, 120, 0.5, scene_hills);
}

static void make_wall(scene_mesh *mesh)
{
    const double plan[2][2] = {{30, 2}, {-30, 2}};
    make_flat(mesh);
    scene_mesh_plan(mesh, plan, 2, -1, 4);
}

static void make_stairs(scene_mesh *mesh)
{
    const scene_stairs stairs = {.n = 12, .rise = 0.2, .run = 0.3, .width = 6, .lead = 6};
    scene_mesh_stairs(mesh, &stairs);
}

static const walk WALKS[] = {
    {"flat", make_flat, {-8, 1, 0}, {0.8, 0.5, 0}, 120, STEPS},
    {"hills", make_hills, {0, 0, 4}, {0.7, 0.7, 0}, 150, STEPS},
    {"wall", make_wall, {-8, 0, 0}, {0.7, 0.7, 0}, 150, STEPS},
    {"stairs", make_stairs, {-4, 0, 0}, {0.6, 0.1, 0}, 100, STEPS},
    {"asleep", make_flat, {0, 0, 0}, {0, 0, 0}, QUIET, QUIET},
    {"free_fall", make_flat, {0, 0, 3000}, {0, 0, 0}, STEPS, STEPS},
};

static int go(const walk *w, tahr_mover *mover, const tahr_config *config)
{
    tahr_state state;
    tahr_input input = {.struct_size = sizeof input};
    tahr_vec3 at = {w->start.x, w->start.y, w->start.z + config->shape.half_height + 0.02};
    if (tahr_state_init(&state, config, &at) < 0) {
        return 0;
    }
    for (int i = 0; i < w->steps; i++) {
        double sign = i / w->leg % 2 ? -1 : 1;
        tahr_report report = {.struct_size = sizeof report};
        input.move = (tahr_vec3){sign * w->wish.x, w->wish.y, 0};
        if (tahr_mover_step(mover, &input, DT, &state, &report) < 0) {
            return 0;
        }
    }
    return 1;
}

static tahr_world *open_world(const scene_mesh *mesh)
{
    tahr_world *world = NULL;
    tahr_body_desc body;
    tahr_world_desc desc;
    tahr_body_desc_init(&body, sizeof body, TAHR_BODY_MESH);
    body.vertices = mesh->vertices, body.vertex_count = mesh->vertex_count;
    body.indices = mesh->indices, body.triangle_count = mesh->triangle_count;
    body.flags = TAHR_BODY_TWO_SIDED;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = &body, desc.body_count = 1;
    return !mesh->failed && tahr_world_open(tahr_backend_v1_native(), &desc, &world) == TAHR_OK ? world : NULL;
}

static int run(const walk *w)
{
    scene_mesh mesh = {0};
    tahr_mover *mover = NULL;
    tahr_config config;
    w->make(&mesh);
    tahr_world *world = open_world(&mesh);
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
    int ok = world && tahr_mover_create(world, &config, &mover) == TAHR_OK && go(w, mover, &config);
    tahr_mover_destroy(mover);
    tahr_world_close(world);
    scene_mesh_free(&mesh);
    return ok;
}

/* Characters 3 m apart on flat ground, of which each second, or none, walks. */
static int run_crowd(int walks, int ticks)
{
    static tahr_state states[CROWD];
    static tahr_input inputs[CROWD];
    scene_mesh mesh = {0};
    tahr_crowd *crowd = NULL;
    tahr_crowd_desc desc;
    tahr_crowd_tick tick;
    tahr_config config;
    make_flat(&mesh);
    tahr_world *world = open_world(&mesh);
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
    tahr_crowd_desc_init(&desc, sizeof desc);
    desc.capacity = CROWD, desc.configs = &config, desc.config_count = 1;
    int ok = world && tahr_crowd_create(world, &desc, &crowd) == TAHR_OK;
    for (int i = 0; i < CROWD && ok; i++) {
        const tahr_vec3 at = {3.0 * (i % 16 - 8), 3.0 * (i / 16 - 8), config.shape.half_height + 0.02};
        ok = tahr_state_init(&states[i], &config, &at) == TAHR_OK;
        inputs[i] = (tahr_input){.struct_size = sizeof inputs[i], .move = {walks && i % 2 ? 1 : 0, 0, 0}};
    }
    tahr_crowd_tick_init(&tick, sizeof tick);
    tick.count = CROWD, tick.dt = DT, tick.inputs = inputs, tick.states = states;
    for (int k = 0; k < ticks && ok; k++) {
        for (int i = 1; walks && i < CROWD && k % 10 == 5; i += 2) {
            inputs[i].move.x = -inputs[i].move.x;
        }
        ok = tahr_crowd_step(crowd, &tick) >= 0;
    }
    tahr_crowd_destroy(crowd);
    tahr_world_close(world);
    scene_mesh_free(&mesh);
    return ok;
}

int main(int argc, char **argv)
{
    for (size_t i = 0; i < sizeof WALKS / sizeof WALKS[0]; i++) {
        if (argc == 2 && strcmp(argv[1], WALKS[i].name) == 0) {
            int ok = run(&WALKS[i]);
            printf("%d\n", ok ? WALKS[i].steps : 0);
            return !ok;
        }
    }
    const int asleep = argc == 2 && strcmp(argv[1], "crowd_asleep") == 0;
    if (asleep || (argc == 2 && strcmp(argv[1], "crowd") == 0)) {
        const int ticks = asleep ? 4000 : 60, ok = run_crowd(!asleep, ticks);
        printf("%d\n", ok ? ticks * CROWD : 0);
        return !ok;
    }
    fprintf(stderr, "count_steps: no such scene\n");
    return 2;
}
