/* SPDX-License-Identifier: MIT
 * wandering.c: wandering on the shared levels and on generated ones: no error, no NaN, no tunnelling, the skin
 * kept, nobody stuck for good, nobody hanging in the air. */
#include "wandering.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scene_backend.h"
#include "scene_level.h"
#include "scene_solid.h"
#include "scene_wander.h"

enum { CHARACTERS = 16, STUCK_CHANGES = 5, STUCK_DIRECTIONS = 16, SKIPPED = 77 };

/* The design's words: stuck for good is less than 0.2 m in 10 s over 5 headings, though 0.1 m are free somewhere; who
 * is 10 m below everything fell out. */
static const double DT = 1.0 / 60, STUCK_SECONDS = 10, STUCK_WAY = 0.2, FREE_STEP = 0.1, FELL = 10;

/* Half a second of a free fall are 0.3 m even around its apex, and half of that on a slope of 50 degrees. */
static const double HANG_SECONDS = 0.5, HANG_WAY = 0.01;

typedef struct character {
    tahr_state state;
    scene_wanderer wanderer;
    tahr_vec3 anchor; /* the last place it was 0.2 m away from */
    double waited;    /* s since then */
    uint32_t changes; /* its headings at that time */
    tahr_vec3 held;   /* the last place it had fallen 1 cm to, or stood at */
    double hung;      /* s since then */
} character;

typedef struct watch {
    const scene_backend *backend;
    const scene_solid *solid;
    tahr_config config;
    tahr_world *world;
    tahr_mover *mover;
    tahr_bounds bounds;
    uint64_t seed;
    long tunnels, deep, close, stuck, hung, fell, walking, steps, odd;
    double nearest; /* m, smallest distance of the true shape; negative: penetration */
    char failure[512];
} watch;

/* A line to reproduce the step with: the state before it and the input. */
static void accuse(watch *w, const char *what, double value, const character *c, const tahr_state *before, int id,
                   int step)
{
    const tahr_vec3 p = before->position, v = before->velocity, m = c->wanderer.input.move;
    if (!w->failure[0]) {
        snprintf(w->failure, sizeof w->failure,
                 "%s %.3g: character %d step %d mode %u jump %u before {%.17g, %.17g, %.17g} velocity {%.17g, %.17g, "
                 "%.17g} move "
                 "{%.17g, %.17g}",
                 what, value, id, step, before->mode, c->wanderer.input.jump, p.x, p.y, p.z, v.x, v.y, v.z, m.x, m.y);
    }
}

static double clearance(const watch *w, tahr_vec3 p)
{
    double reach = w->config.shape.half_height - w->config.shape.radius;
    tahr_vec3 low = {p.x, p.y, p.z - reach}, high = {p.x, p.y, p.z + reach};
    return scene_solid_distance(w->solid, low, high, w->config.shape.radius + w->config.skin, NULL) -
           w->config.shape.radius;
}

/* Whether 0.1 m are free in some direction, with the skin kept. */
static int could_move(const watch *w, tahr_vec3 p)
{
    for (int i = 0; i < STUCK_DIRECTIONS; i++) {
        double angle = 6.283185307179586 * i / STUCK_DIRECTIONS;
        int open = 1;
        for (int k = 1; open && k <= 4; k++) {
            double way = FREE_STEP * k / 4;
            open =
                clearance(w, (tahr_vec3){p.x + way * cos(angle), p.y + way * sin(angle), p.z}) >= w->config.skin - 1e-5;
        }
        if (open) {
            return 1;
        }
    }
    return 0;
}

static double apart(tahr_vec3 a, tahr_vec3 b)
{
    return sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
}

static void settle_anchor(character *c)
{
    c->anchor = c->state.position;
    c->waited = 0;
    c->changes = c->wanderer.changes;
}

static void look_for_stuck(watch *w, character *c, int id, int step)
{
    c->waited += DT;
    if (apart(c->state.position, c->anchor) >= STUCK_WAY) {
        settle_anchor(c);
    } else if (c->waited >= STUCK_SECONDS && c->wanderer.changes >= c->changes + STUCK_CHANGES) {
        if (could_move(w, c->state.position)) {
            w->stuck++;
            accuse(w, "stuck for s", c->waited, c, &c->state, id, step);
        }
        settle_anchor(c);
    }
}

static void look_for_hanging(watch *w, character *c, int id, int step)
{
    int held = c->state.mode == TAHR_MODE_FALLING && apart(c->state.position, c->held) < HANG_WAY;
    c->hung += DT;
    if (held && c->hung < HANG_SECONDS) {
        return;
    }
    if (held) {
        w->hung++;
        accuse(w, "hangs in the air for s", c->hung, c, &c->state, id, step);
    }
    c->held = c->state.position;
    c->hung = 0;
}

static int place(watch *w, character *c)
{
    if (!scene_wander_spawn(w->world, &w->config, &w->bounds, &w->seed, &c->state)) {
        snprintf(w->failure, sizeof w->failure, "no place to start at");
        return 0;
    }
    settle_anchor(c);
    return 1;
}

static int take_step(watch *w, character *c, int id, int step)
{
    tahr_state before = c->state;
    tahr_report report = {.struct_size = sizeof report};
    tahr_status status = tahr_mover_step(w->mover, scene_wander_next(&c->wanderer, DT), DT, &c->state, &report);
    tahr_vec3 p = c->state.position, v = c->state.velocity;
    w->steps++;
    if (status < 0 || !isfinite(p.x + p.y + p.z + v.x + v.y + v.z)) {
        accuse(w, status < 0 ? tahr_status_name(status) : "not finite", status, c, &before, id, step);
        return 0;
    }
    if (report.flags & (TAHR_REPORT_UNKNOWN | TAHR_REPORT_QUERY_CAP | TAHR_REPORT_CRUSHED)) {
        w->odd++;
        accuse(w, tahr_status_name(status), report.residual, c, &before, id, step);
    }
    if (scene_solid_crossed(w->solid, before.position, p, NULL)) {
        w->tunnels++;
        accuse(w, "tunnelled m", apart(p, before.position), c, &before, id, step);
    }
    double distance = clearance(w, p);
    w->nearest = distance < w->nearest ? distance : w->nearest;
    if (distance < w->backend->clearance * w->config.skin - w->backend->slack) {
        w->close++;
        accuse(w, "clearance m", distance, c, &before, id, step);
    }
    if (distance < -w->backend->penetration) {
        w->deep++;
        accuse(w, "penetration m", -distance, c, &before, id, step);
    }
    w->walking += c->state.mode == TAHR_MODE_WALKING;
    look_for_stuck(w, c, id, step);
    look_for_hanging(w, c, id, step);
    if (p.z < w->bounds.min.z - FELL) {
        w->fell++;
        return place(w, c);
    }
    return 1;
}

static void wander(watch *w, int steps)
{
    static character crowd[CHARACTERS];
    for (int i = 0; i < CHARACTERS; i++) {
        scene_wander_start(&crowd[i].wanderer, 1, (uint32_t)i);
        if (!place(w, &crowd[i])) {
            return;
        }
    }
    for (int s = 0; s < steps; s++) {
        for (int i = 0; i < CHARACTERS; i++) {
            if (!take_step(w, &crowd[i], i, s)) {
                return;
            }
        }
    }
}

static int run_level(const char *name, const scene_mesh *mesh, const scene_solid *solid, const scene_backend *backend,
                     int steps)
{
    watch w = {.backend = backend, .solid = solid, .bounds = scene_mesh_bounds(mesh), .seed = 5, .nearest = HUGE_VAL};
    tahr_body_desc body;
    scene_level_body(mesh, &body);
    body.flags = TAHR_BODY_TWO_SIDED;
    tahr_config_init(&w.config, sizeof w.config, TAHR_PRESET_PRECISE);
    tahr_status status = scene_backend_open(backend, &body, 1, NULL, &w.world);
    if (status == TAHR_OK) {
        status = tahr_mover_create(w.world, &w.config, &w.mover);
    }
    if (status == TAHR_OK) {
        wander(&w, steps);
    } else {
        snprintf(w.failure, sizeof w.failure, "%s", tahr_status_message(status));
    }
    tahr_mover_destroy(w.mover);
    tahr_world_close(w.world);
    printf("%-11s %-14s %8ld steps, %3.0f%% walking, fell out %ld, nearest %9.6f m, tunnels %ld, deep %ld, close %ld, "
           "stuck %ld, hung %ld, odd %ld\n",
           name, backend->name, w.steps, 100.0 * (double)w.walking / (double)(w.steps + !w.steps), w.fell, w.nearest,
           w.tunnels, w.deep, w.close, w.stuck, w.hung, w.odd);
    if (w.failure[0]) {
        printf("    %s\n", w.failure);
    }
    fflush(stdout);
    return w.failure[0] == 0;
}

int wandering_run(int native_steps, int other_steps, int argc, char **argv)
{
    int runs = 0, failures = 0;
    for (int i = 0; i < SCENE_LEVELS; i++) {
        scene_mesh mesh = {0};
        char why[256] = "";
        if (argc > 1 && strcmp(argv[1], SCENE_LEVEL_NAMES[i]) != 0) {
            continue;
        }
        if (!scene_level_make(SCENE_LEVEL_NAMES[i], &mesh, why)) {
            printf("SKIP: scenes_wandering: %s %s\n", SCENE_LEVEL_NAMES[i], why);
            scene_mesh_free(&mesh);
            continue;
        }
        scene_solid *solid = scene_solid_open(&mesh, 1);
        for (int b = 0; solid && b < SCENE_BACKEND_COUNT; b++) {
            const scene_backend *backend = &SCENE_BACKENDS[b];
            if (argc <= 2 || strcmp(argv[2], backend->name) == 0) {
                runs++;
                failures += !run_level(SCENE_LEVEL_NAMES[i], &mesh, solid, backend,
                                       backend->native ? native_steps : other_steps);
            }
        }
        scene_solid_close(solid);
        scene_mesh_free(&mesh);
    }
    printf("%d runs, %d failures\n", runs, failures);
    return failures > 0 ? 1 : runs > 0 ? 0 : SKIPPED;
}
