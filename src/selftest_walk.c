/* SPDX-License-Identifier: MIT
 * selftest_walk.c: a case: what the slot walk says of a motion, of the floor under its end, and of the space around
 * it is what sweeps say. */
#include "selftest.h"

#include <string.h>

enum { STEPS = 240, FALLS = 120 };

/* A floor with something to climb, to pass and to walk off. */
static int build(tahr__lab *lab)
{
    tahr__lab_clear(lab);
    lab->material = lab->claims & TAHR_CAP_MESH ? TAHR__OF_MESHES : TAHR__OF_BOXES;
    tahr__lab_block(lab, -8, -1, 8, 0);
    tahr__lab_block(lab, 4, 0, 5, 0.3);
    tahr__lab_block(lab, -6, 0, -5.5, 2);
    return tahr__lab_open(lab);
}

static int same_bits(const tahr_hit *a, const tahr_hit *b)
{
    return a->fraction == b->fraction && a->distance == b->distance && vec_equal(a->normal, b->normal) &&
           vec_equal(a->surface_normal, b->surface_normal) && vec_equal(a->point, b->point) && a->body == b->body &&
           a->feature == b->feature && a->surface == b->surface && a->walkable_rule == b->walkable_rule;
}

/* Asks the slot. */
static int knows(tahr__lab *lab, const tahr_walk *walk, tahr_hit *said)
{
    uint32_t known = TAHR_WALK_UNKNOWN;
    memset(said, 0, sizeof *said);
    tahr_status status = lab->world->backend->walk(lab->world->self, &lab->context, walk, said, &known);
    return tahr__lab_check(lab, status >= 0 && known <= TAHR_WALK_UNANNOUNCED, "walk: ok, and known a TAHR_WALK_*",
                           "%s, known %u", tahr_status_name(status), known) &&
           known == TAHR_WALK_KNOWN;
}

/* The same, and if it knows, the sweeps. */
static void compare(tahr__lab *lab, const tahr_sweep *way, const tahr_sweep *down)
{
    const tahr_walk walk = {.shape = &way->shape,
                            .foot = &down->shape,
                            .position = way->position,
                            .motion = way->motion,
                            .foot_position = down->position,
                            .foot_motion = down->motion,
                            .up = way->up,
                            .margin = way->margin,
                            .mask = way->mask};
    tahr_hit said, met;
    if (!knows(lab, &walk, &said)) {
        return;
    }
    tahr__lab_free(lab, way, "a walk that is known to be free");
    if (tahr__lab_ask(lab, down, &met)) {
        tahr__lab_check(lab, met.blocking && !met.start_overlap && same_bits(&said, &met),
                        "the floor under a known walk is what the sweep of the foot says, bit for bit",
                        "%s at (%.6g, %.6g, %.6g): fraction %.17g and %.17g, body %u and %u", lab->shape_name,
                        way->position.x, way->position.y, way->position.z, said.fraction, met.fraction, said.body,
                        met.body);
    }
}

static void stride(tahr__lab *lab, int i)
{
    const double u = 6.0 * (i < STEPS / 2 ? 4.0 * i / STEPS - 1 : 3 - 4.0 * i / STEPS);
    const double over = lab->shape.half_height / lab->scale + 0.01 + (i % 3 == 2 ? 0.002 : 0);
    tahr_sweep way = tahr__lab_sweep(lab, u, over, i < STEPS / 2 ? 0.1 : -0.1, 0), down = way;
    tahr_hit hit;
    way.margin = down.margin = 0.01 * lab->scale;
    down.position = add(way.position, way.motion);
    down.motion = scale(way.up, -0.4 * lab->scale);
    if (lab->shape.type == TAHR_SHAPE_CAPSULE && (lab->claims & TAHR_CAP_SPHERE)) {
        down.shape.type = TAHR_SHAPE_SPHERE;
        down.shape.half_height = down.shape.radius;
        down.position = add_scaled(down.position, way.up, down.shape.radius - way.shape.half_height);
    }
    if (lab->world->backend->prepare) {
        const vec3 far = vec(1.5 * lab->scale, 1.5 * lab->scale, 1.5 * lab->scale);
        const tahr_prepare here = {.bounds = {sub(way.position, far), add(way.position, far)},
                                   .position = way.position,
                                   .up = way.up,
                                   .mask = way.mask};
        tahr_status status = lab->world->backend->prepare(lab->world->self, &lab->context, &here);
        tahr__lab_check(lab, status >= 0, "prepare: ok", "%s", tahr_status_name(status));
    }
    compare(lab, &way, &down);
    if (tahr__lab_ask(lab, &way, &hit)) { /* what a backend may learn from */
        tahr__lab_ask(lab, &down, &hit);
    }
}

/* A motion without a foot, and how far there is said to be nothing, whichever way it goes. */
static void fall(tahr__lab *lab, int i)
{
    const double heights[] = {1.2, 3, 8, 20}, over = heights[i % 4] + lab->shape.half_height / lab->scale;
    tahr_sweep way = tahr__lab_sweep(lab, 12.0 * i / FALLS - 6, over, 0.1 * (i % 3) - 0.1, i % 5 ? -0.3 : -1.4);
    const tahr_walk walk = {.shape = &way.shape,
                            .position = way.position,
                            .motion = way.motion,
                            .up = way.up,
                            .margin = way.margin,
                            .mask = way.mask};
    tahr_hit said;
    if (!knows(lab, &walk, &said)) {
        return;
    }
    tahr__lab_free(lab, &way, "a fall that is known to be free");
    for (int k = 0; k < 4 && said.distance > 0; k++) {
        const double far = 0.999 * said.distance / lab->scale;
        tahr_sweep out = tahr__lab_sweep(lab, 12.0 * i / FALLS - 6, over,
                                         k == 1   ? far
                                         : k == 2 ? -far
                                                  : 0,
                                         k == 0   ? -far
                                         : k == 3 ? far
                                                  : 0);
        tahr__lab_free(lab, &out, "as far as nothing is said to be");
    }
}

static void walks(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_ROUND);) {
        if (!build(lab)) {
            return;
        }
        if (!lab->world->backend->walk) {
            tahr__lab_clear(lab);
            lab->checks = 0;
            tahr__lab_lacks(lab, "the slot walk");
            return;
        }
        lab->context.cache = lab->cache;
        for (int i = 0; i < STEPS && lab_goes_on(lab); i++) {
            stride(lab, i);
        }
        for (int i = 0; i < FALLS && lab_goes_on(lab); i++) {
            fall(lab, i);
        }
        lab->context.cache = NULL;
    }
}

static const tahr__lab_case cases[] = {
    {"a_walk_in_one_look_is_its_sweeps", 0, walks},
};

const tahr__lab_theme tahr__lab_walks = {cases, sizeof cases / sizeof cases[0]};
