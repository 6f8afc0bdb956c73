/* SPDX-License-Identifier: MIT
 * test_moves.c: moving the shape in the unreal preset, row by row in centimetres: walkable test (W), pull-back
 * (B), MoveUpdatedComponent (M), penetration adjustment (R), ResolvePenetration (Z), SafeMoveUpdatedComponent (V). */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "floor.h"
#include "move.h"
#include "parity.h"

static const double DEGREE = 0.017453292519943295;

static void walkable_rows(void **unused)
{
    static const struct {
        const char *id;
        double z;
        uint32_t rule;
        double angle;
        int overlap, walkable;
    } rows[] = {{"W1", 1.0, TAHR_WALKABLE_DEFAULT, 0, 0, 1},    {"W2", 0.71, TAHR_WALKABLE_DEFAULT, 0, 0, 1},
                {"W3", 0.7099, TAHR_WALKABLE_DEFAULT, 0, 0, 0}, {"W4", 0, TAHR_WALKABLE_DEFAULT, 0, 0, 0},
                {"W5", -0.5, TAHR_WALKABLE_DEFAULT, 0, 0, 0},   {"W6", 1.0, TAHR_WALKABLE_DEFAULT, 0, 1, 0},
                {"W7", 0.5, TAHR_WALKABLE_INCREASE, 75, 0, 1},  {"W7", 0.866025, TAHR_WALKABLE_DECREASE, 25, 0, 0},
                {"W7", 1.0, TAHR_WALKABLE_NEVER, 0, 0, 0},      {"W8", 0.5, TAHR_WALKABLE_INCREASE, 30, 0, 0},
                {"W8", 0.8, TAHR_WALKABLE_DECREASE, 60, 0, 1}};
    parity_scene empty = {.count = 0};
    parity_table t;
    parity p;
    (void)unused;
    parity_begin(&t, "IsWalkable");
    parity_open(&p, &empty, PARITY_FAKE, NULL, 0, 0, 0);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        tahr_hit hit = {.blocking = 1, .start_overlap = (uint32_t)rows[i].overlap, .depth = rows[i].overlap ? 0.01 : 0};
        hit.surface_normal = vec(sqrt(1 - rows[i].z * rows[i].z), 0, rows[i].z);
        hit.normal = vec(0, 0, 1); /* of the contact: it does not count */
        hit.walkable_rule = rows[i].rule;
        hit.walkable_angle = rows[i].angle * DEGREE;
        parity_row(&t, rows[i].id, NULL);
        parity_count(&t, "walkable", (uint32_t)tahr__is_walkable(&p.step, &hit, 0), (uint32_t)rows[i].walkable);
        parity_count(&t, "queries", p.step.queries, 0);
    }
    parity_row(&t, "W2", "nothing in the way");
    tahr_hit none = {.surface_normal = {0, 0, 1}};
    parity_count(&t, "walkable", (uint32_t)tahr__is_walkable(&p.step, &none, 0), 0);
    parity_close(&p);
    parity_end(&t);
}

static void pull_back_rows(void **unused)
{
    static const struct {
        double length, part, back;
    } b1[] = {{0.05, 2.001, 0.10005}, {0.1, 1.001, 0.1001}, {0.5, 0.201, 0.1005}, {1, 0.101, 0.101}, {5, 0.101, 0.505},
              {10, 0.101, 1.01},      {50, 0.021, 1.05},    {500, 0.003, 1.5},    {1000, 0.002, 2.0}};
    static const struct {
        double t, length, left;
    } b2[] = {{0.5, 0.5, 0.299}, {0.5, 5, 0.399}, {0.5, 50, 0.479}, {0.05, 5, 0}};
    tahr_config c = parity_config();
    parity_table t;
    (void)unused;
    parity_begin(&t, "PullBack");
    parity_row(&t, "B1", NULL);
    for (size_t i = 0; i < sizeof b1 / sizeof b1[0]; i++) {
        double part = tahr__pull_back_part(&c, parity_cm(b1[i].length));
        parity_number(&t, "time", part, b1[i].part, 1e-9);
        parity_length(&t, "distance", part * parity_cm(b1[i].length), b1[i].back, 1e-9);
    }
    parity_row(&t, "B2", NULL);
    for (size_t i = 0; i < sizeof b2 / sizeof b2[0]; i++) {
        parity_number(&t, "time left", tahr__pull_back(&c, b2[i].t, parity_cm(b2[i].length)), b2[i].left, 1e-9);
    }
    /* A character half as large moves alike: the table in units of half a centimetre. */
    parity_row(&t, "B1", "scaled");
    assert_int_equal(tahr_config_scale(&c, 0.5), TAHR_OK);
    for (size_t i = 0; i < sizeof b1 / sizeof b1[0]; i++) {
        parity_number(&t, "time", tahr__pull_back_part(&c, parity_cm(b1[i].length) / 2), b1[i].part, 1e-9);
    }
    parity_end(&t);
}

typedef struct move_row {
    const char *id;
    double wall; /* x of a wall that faces -x */
    vec3 delta, plane;
    uint32_t flags;
    double fraction, x, location; /* expected */
    uint32_t queries, moved, overlap;
} move_row;

static void move_rows(void **unused)
{
    static const move_row rows[] = {
        {"M1", 60, {50, 0, 0}, {0, 0, 0}, 0, 0.499, 24.95, 26, 1, 1, 0},
        {"M2", 34.3, {0.5, 0, 0}, {0, 0, 0}, 0, 0.399, 0.1995, 0.3, 1, 1, 0},
        {"M3", 34.4, {5, 0, 0}, {0, 0, 0}, 0, 0, 0, 0.4, 1, 0, 0},
        {"M3", 34.50505, {5, 0, 0}, {0, 0, 0}, 0, 0, 0, 0.50505, 1, 0, 0}, /* 0.00005 would be left */
        {"M4", 60, {0.0003, 0, 0}, {0, 0, 0}, 0, 1, 0, 0, 0, 1, 0},
        {"M4", 60, {0.0005, 0, 0}, {0, 0, 0}, 0, 1, 0.0005, 0.0005, 1, 1, 0},
        {"M5", 60, {3, 4, 0}, {0, 1, 0}, 0, 1, 3, 3, 1, 1, 0},
        {"M6", 32, {-10, 0, 0}, {0, 0, 0}, TAHR_SWEEP_LEAVE_OVERLAP, 1, -10, -10, 1, 1, 0},
        {"M6", 32, {-10, 0, 0}, {0, 0, 0}, 0, 0, 0, 0, 1, 0, 1}};
    parity_table t;
    (void)unused;
    parity_begin(&t, "MoveUpdatedComponent");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const move_row *r = &rows[i];
        parity_scene scene = {.count = 0};
        tahr_config c = parity_config();
        parity_plane(&scene, -1, 0, 0, -r->wall);
        c.plane = r->plane;
        for (int backend = 0; backend < PARITY_BACKENDS; backend++) {
            double near = parity_tolerance(backend);
            tahr__swept swept;
            parity p;
            if (!parity_has(backend)) {
                continue;
            }
            parity_open(&p, &scene, backend, &c, 0, 0, 0);
            int moved = tahr__move_updated(&p.step, scale(r->delta, 0.01), r->flags, &swept);
            parity_row(&t, r->id, parity_backend_name(backend));
            parity_count(&t, "moved", moved != 0, r->moved);
            parity_count(&t, "queries", p.step.queries, r->queries);
            parity_count(&t, "overlap", swept.hit.start_overlap, r->overlap);
            parity_number(&t, "time", swept.hit.fraction, r->fraction, near / length(r->delta));
            parity_vector(&t, "position", p.step.state.position, r->x, 0, 0, near);
            parity_vector(&t, "Location", swept.location, r->location, 0, 0, near);
            if (strcmp(r->id, "M1") == 0) {
                parity_number(&t, "gap", 60 - 34 - 100 * p.step.state.position.x, 1.05, near);
            }
            parity_close(&p);
        }
    }
    parity_end(&t);
}

static void adjustment_rows(void **unused)
{
    static const struct {
        const char *id;
        uint32_t body; /* 0 geometry, 1 a character */
        vec3 normal;
        double depth;
        vec3 plane, expected;
    } rows[] = {{"R1", 0, {0, 0, 1}, 0, {0, 0, 0}, {0, 0, 0.25}},
                {"R1", 0, {0, 0, 1}, 2, {0, 0, 0}, {0, 0, 2.125}},
                {"R2", 0, {0.6, 0, 0.8}, 10, {0, 0, 0}, {6.075, 0, 8.1}},
                {"R3", 0, {1, 0, 0}, 600, {0, 0, 0}, {500, 0, 0}},
                {"R3", 1, {1, 0, 0}, 150, {0, 0, 0}, {100, 0, 0}},
                {"R4", 0, {0.48, 0.6, 0.64}, 4.875, {0, 1, 0}, {2.4, 0, 3.2}}};
    parity_scene scene = {.count = 0};
    parity_table t;
    parity p;
    (void)unused;
    parity_plane(&scene, 0, 0, 1, -100);
    parity_box(&scene, vec(500, 0, 0), vec(550, 50, 50))->flags = TAHR_BODY_CHARACTER | TAHR_BODY_MOVABLE;
    parity_begin(&t, "GetPenetrationAdjustment");
    parity_open(&p, &scene, PARITY_NATIVE, NULL, 0, 0, 0);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        tahr_hit hit = {.blocking = 1, .start_overlap = 1, .depth = rows[i].depth / 100, .normal = rows[i].normal};
        vec3 e = rows[i].expected;
        hit.body = rows[i].body;
        parity_hold_to(&p, rows[i].plane);
        parity_row(&t, rows[i].id, NULL);
        parity_vector(&t, "push", tahr__penetration_adjustment(&p.step, &hit), e.x, e.y, e.z, 1e-9);
    }
    /* A proxy of the field's: the same code with the proxy's limit. */
    tahr_hit hit = {.blocking = 1, .start_overlap = 1, .depth = 0.03, .normal = {1, 0, 0}, .body = 1};
    parity_hold_to(&p, vec(0, 0, 0));
    p.config.max_depenetration_character = 0.02;
    parity_row(&t, "R3", "proxy");
    parity_vector(&t, "push", tahr__penetration_adjustment(&p.step, &hit), 2, 0, 0, 1e-9);
    parity_row(&t, "R4", "free");
    hit.start_overlap = 0;
    parity_vector(&t, "push", tahr__penetration_adjustment(&p.step, &hit), 0, 0, 0, 0);
    parity_count(&t, "queries", p.step.queries, 0);
    parity_close(&p);
    parity_end(&t);
}

/* Floor at z = 0 and, at < INFINITY, a ceiling. */
static parity_scene between(double ceiling)
{
    parity_scene scene = {.count = 0};
    parity_plane(&scene, 0, 0, 1, 0);
    if (ceiling < INFINITY) {
        parity_plane(&scene, 0, 0, -1, -ceiling);
    }
    return scene;
}

/* Resolves what stops a motion of 10 cm along x from a start 2 cm in the floor. Returns what that returned. */
static int resolve(parity *p, uint32_t *queries)
{
    tahr__swept swept;
    tahr__move_updated(&p->step, parity_vec(10, 0, 0), 0, &swept);
    *queries = p->step.queries;
    int moved = tahr__resolve_penetration(&p->step, tahr__penetration_adjustment(&p->step, &swept.hit), &swept);
    *queries = p->step.queries - *queries;
    return moved;
}

static void resolve_rows(void **unused)
{
    static const struct {
        const char *id;
        double ceiling, height; /* expected: of the base */
        uint32_t queries;
    } rows[] = {{"Z2", INFINITY, 0.125, 1},
                {"Z3", 176.2, 0.125, 2}, /* 0.075 cm of air where it would fit: the sweep does not mind */
                {"Z3", 175.5, -2 + 1.5 - 0.101 * 2.125, 2}};
    parity_table t;
    uint32_t queries;
    parity p;
    (void)unused;
    parity_begin(&t, "ResolvePenetration");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        parity_scene scene = between(rows[i].ceiling);
        for (int backend = 0; backend < PARITY_BACKENDS; backend++) {
            if (!parity_has(backend)) {
                continue;
            }
            parity_open(&p, &scene, backend, NULL, 0, 0, 86);
            parity_row(&t, rows[i].id, parity_backend_name(backend));
            parity_true(&t, "resolved", resolve(&p, &queries));
            parity_count(&t, "queries", queries, rows[i].queries);
            parity_vector(&t, "position", p.step.state.position, 0, 0, 88 + rows[i].height, parity_tolerance(backend));
            parity_true(&t, "just teleported", p.step.just_teleported != 0);
            parity_close(&p);
        }
    }
    parity_scene scene = between(INFINITY);
    tahr__swept swept = {.hit = {.blocking = 1, .start_overlap = 1}};
    parity_open(&p, &scene, PARITY_FAKE, NULL, 0, 0, 86);
    parity_row(&t, "Z1", NULL);
    parity_true(&t, "not resolved", !tahr__resolve_penetration(&p.step, vec(0, 0, 0), &swept));
    parity_count(&t, "queries", p.step.queries, 0);
    parity_true(&t, "not teleported", !p.step.just_teleported);
    parity_close(&p);
    parity_end(&t);
}

static double depth_in(const parity_scene *scene, vec3 at)
{
    double deepest = 0; /* of the upright capsule 34 / 88 */
    for (uint32_t i = 0; i < scene->count; i++) {
        const parity_solid *s = &scene->solids[i];
        double gap = 100 * dot(s->normal, at) - s->offset - 34 - 54 * fabs(s->normal.z);
        deepest = fmax(deepest, -gap);
    }
    return deepest;
}

static void wedge_row(void **unused)
{
    static const vec3 deltas[] = {{0, 0, 1}, {-1, 0, 0}, {0, 3, 0}};
    parity_scene scene = {.count = 0};
    parity_table t;
    (void)unused;
    parity_plane(&scene, 0.5, sqrt(0.75), 0, 0);
    parity_plane(&scene, 0.5, -sqrt(0.75), 0, 0);
    parity_begin(&t, "ResolvePenetration in a wedge");
    for (int backend = 0; backend < PARITY_BACKENDS; backend++) {
        for (size_t i = 0; i < sizeof deltas / sizeof deltas[0] && parity_has(backend); i++) {
            tahr__swept swept;
            parity p;
            parity_open(&p, &scene, backend, NULL, 64, 0, 0); /* 2 cm in both */
            parity_row(&t, "Z4", parity_backend_name(backend));
            for (int tick = 0; tick < 10; tick++) {
                double before = depth_in(&scene, p.step.state.position);
                uint32_t queries = p.step.queries;
                tahr__safe_move(&p.step, scale(deltas[i], 0.01), &swept);
                double now = depth_in(&scene, p.step.state.position);
                parity_true(&t, "no deeper", now <= before + parity_tolerance(backend));
                parity_true(&t, "queries", p.step.queries - queries <= TAHR__SAFE_MOVE_QUERIES);
            }
            parity_number(&t, "depth after 10 ticks", depth_in(&scene, p.step.state.position), 0, 0.01);
            parity_close(&p);
        }
    }
    parity_end(&t);
}

static void safe_move_rows(void **unused)
{
    parity_table t;
    (void)unused;
    parity_begin(&t, "SafeMoveUpdatedComponent");
    for (int backend = 0; backend < PARITY_BACKENDS; backend++) {
        double near = parity_tolerance(backend);
        parity_scene flat = between(INFINITY), sealed = {.count = 0};
        tahr__swept swept;
        parity p;
        if (!parity_has(backend)) {
            continue;
        }
        parity_open(&p, &flat, backend, NULL, 0, 0, 120);
        parity_row(&t, "V1", parity_backend_name(backend));
        parity_true(&t, "moved", tahr__safe_move(&p.step, parity_vec(10, 0, 0), &swept));
        parity_count(&t, "queries", p.step.queries, 1);
        parity_vector(&t, "position", p.step.state.position, 10, 0, 120, near);

        parity_put(&p, 0, 0, 86);
        parity_row(&t, "V2", parity_backend_name(backend));
        parity_true(&t, "moved", tahr__safe_move(&p.step, parity_vec(10, 0, 0), &swept));
        parity_count(&t, "queries", p.step.queries, 3);
        parity_count(&t, "sweeps", p.step.report.sweeps, 2);
        parity_count(&t, "overlap tests", p.step.report.contact_queries, 1);
        parity_vector(&t, "position", p.step.state.position, 10, 0, 88.125, near);
        parity_count(&t, "events", p.step.report.event_count, 1);
        parity_count(&t, "event", p.events[0].type, TAHR_EVENT_DEPENETRATED);
        parity_close(&p);

        for (int i = 0; i < 6; i++) { /* 60 x 60 x 160 cm for a capsule of 68 x 68 x 176 */
            double side = i % 2 ? 1 : -1;
            parity_plane(&sealed, i < 2 ? side : 0, i / 2 == 1 ? side : 0, i > 3 ? side : 0, i > 3 ? -80 : -30);
        }
        parity_open(&p, &sealed, backend, NULL, 0, 0, 0);
        parity_row(&t, "V3", parity_backend_name(backend));
        parity_true(&t, "did not move", !tahr__safe_move(&p.step, parity_vec(10, 0, 0), &swept));
        parity_true(&t, "queries", p.step.queries <= TAHR__SAFE_MOVE_QUERIES);
        parity_true(&t, "finite", vec_is_finite(p.step.state.position));
        parity_true(&t, "crushed", (p.step.report.flags & TAHR_REPORT_CRUSHED) != 0);
        parity_close(&p);
    }
    parity_end(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(walkable_rows), cmocka_unit_test(pull_back_rows),
                                       cmocka_unit_test(move_rows),     cmocka_unit_test(adjustment_rows),
                                       cmocka_unit_test(resolve_rows),  cmocka_unit_test(wedge_row),
                                       cmocka_unit_test(safe_move_rows)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
