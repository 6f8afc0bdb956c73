/* SPDX-License-Identifier: MIT
 * selftest_body.c: cases: each kind of body that is claimed, fluids, and the motion of bodies. */
#include <string.h>

#include "selftest.h"

static double low_of(const tahr__lab *lab)
{
    return tahr__lab_reach(lab, tahr__lab_toward(lab, 0, -1));
}

/* A body with its top at height top above its middle, and its side at wide beside it; both are met head-on. */
static void met(tahr__lab *lab, double top, double wide)
{
    double across = tahr__lab_reach(lab, tahr__lab_toward(lab, -1, 0));
    if (lab->world || tahr__lab_open(lab)) {
        tahr_sweep down = tahr__lab_sweep(lab, 0, top + low_of(lab) + 1, 0, -3),
                   side = tahr__lab_sweep(lab, wide + across + 1, 0, -3, 0);
        lab->number = top;
        tahr__lab_stops(lab, &down, 0.99 / 3, tahr__lab_up(lab), "onto the top at");
        lab->number = wide;
        if (wide > 0) {
            tahr__lab_stops(lab, &side, 0.99 / 3, tahr__lab_toward(lab, 1, 0), "against the side at");
        }
        tahr_sweep past = tahr__lab_sweep(lab, -(wide + across + 0.02), top + low_of(lab) + 1, 0, -3);
        if (wide > 0) {
            tahr__lab_free(lab, &past, "down past it");
        }
    }
}

static void body_box(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        lab->material = TAHR__OF_BOXES;
        tahr__lab_block(lab, -2, -1, 2, 1);
        met(lab, 1, 2);
    }
}

static void body_mesh(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        lab->material = TAHR__OF_MESHES;
        tahr__lab_block(lab, -2, -1, 2, 1);
        met(lab, 1, 2);
    }
}

/* Round ones are of full symmetry about the lab's up: local z is turned there. */
static void round_body(tahr__lab *lab, uint32_t type)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        tahr_body_desc *body = tahr__lab_body(lab, type);
        double height = type == TAHR_BODY_SPHERE ? 1 : 1.5;
        body->radius = type == TAHR_BODY_ELLIPSOID ? 0 : 1;
        body->half_height = height;
        body->pose.orientation = tahr__lab_upright(lab);
        if (type == TAHR_BODY_ELLIPSOID) {
            body->half_extents = vec(1, 1, height);
        }
        met(lab, height, type == TAHR_BODY_CONE ? 0 : 1);
        if (type == TAHR_BODY_CONE && lab->world) {
            /* The side of a cone: its normal leans by the slope; a plane touches along a whole line. */
            double slant = sqrt(1 + 4 * height * height), nu = 2 * height / slant, nv = 1 / slant;
            double away = tahr__lab_reach(lab, tahr__lab_toward(lab, -nu, -nv)) + 0.5;
            tahr_sweep q = tahr__lab_sweep(lab, 0.5 + nu * away, nv * away, -2 * nu, -2 * nv);
            if (lab->shape.type == TAHR_SHAPE_SPHERE) {
                tahr__lab_stops(lab, &q, 0.49 / 2, tahr__lab_toward(lab, nu, nv), "against the slope of a cone");
            }
        }
    }
}

static void body_sphere(tahr__lab *lab)
{
    round_body(lab, TAHR_BODY_SPHERE);
}

static void body_capsule(tahr__lab *lab)
{
    round_body(lab, TAHR_BODY_CAPSULE);
}

static void body_cylinder(tahr__lab *lab)
{
    round_body(lab, TAHR_BODY_CYLINDER);
}

static void body_cone(tahr__lab *lab)
{
    round_body(lab, TAHR_BODY_CONE);
}

static void body_ellipsoid(tahr__lab *lab)
{
    round_body(lab, TAHR_BODY_ELLIPSOID);
}

/* A block as a hull: its corners in no order around it. */
static void body_hull(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        tahr_body_desc *body = tahr__lab_body(lab, TAHR_BODY_HULL);
        for (int i = 0; i < (lab->planar ? 4 : 8); i++) {
            double u = i & 1 ? 2 : -2, v = i & 2 ? 1 : -1, w = i & 4 ? 5 : -5;
            tahr__lab_corner(lab, body, u, lab->planar ? v : w, lab->planar ? 0 : v);
        }
        met(lab, 1, 2);
    }
}

/* A field with a ridge along y: heights 0, 1, 0 at x = -4, 0, 4; its slopes are planes. */
static void body_heights(tahr__lab *lab)
{
    static const double heights[] = {0, 1, 0, 0, 1, 0, 0, 1, 0};
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        tahr_body_desc *body = tahr__lab_body(lab, TAHR_BODY_HEIGHTS);
        body->heights = heights;
        body->columns = body->rows = 3;
        body->half_extents = vec(4, 6, 0);
        if (!tahr__lab_open(lab)) {
            return;
        }
        const double l = sqrt(17.0), nu = 1 / l, nv = 4 / l;
        for (int side = -1; side <= 1; side += 2) {
            double away = tahr__lab_reach(lab, tahr__lab_toward(lab, -side * nu, -nv)) + 0.5;
            tahr_sweep q = tahr__lab_sweep(lab, 2 * side + side * nu * away, 0.5 + nv * away, -side * nu, -nv);
            lab->number = side;
            tahr__lab_stops(lab, &q, 0.49, tahr__lab_toward(lab, side * nu, nv), "onto a slope of a field of heights");
        }
        if (lab->shape.type != TAHR_SHAPE_BOX) {
            tahr_sweep ridge = tahr__lab_sweep(lab, 0, 1 + low_of(lab) + 0.5, 0, -1);
            tahr__lab_stops(lab, &ridge, 0.49, tahr__lab_up(lab), "onto its ridge");
        }
    }
}

static void body_chain(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        lab->material = TAHR__OF_CHAINS;
        tahr__lab_block(lab, -2, -1, 2, 1);
        met(lab, 1, 2);
    }
}

/* A pool from v = -2 to 0; the part of the axis below 0 is the immersion. */
static void fluid(tahr__lab *lab)
{
    if (lab->backend && !lab->backend->fluid) {
        tahr__lab_lacks(lab, "the slot fluid");
        return;
    }
    tahr__lab_block(lab, -3, -2, 3, 0)->flags = TAHR_BODY_FLUID | TAHR_BODY_SENSOR;
    lab->bodies[0].fluid_friction = 0.7;
    const vec3 current = lab->bodies[0].surface_velocity = tahr__lab_toward(lab, 2, 0);
    if (!tahr__lab_open(lab)) {
        return;
    }
    if (!(lab->world->has & TAHR__HAS_FLUIDS)) { /* a user's callbacks need not know of fluids */
        lab->checks = 0;
        tahr__lab_lacks(lab, "the function fluid");
        return;
    }
    static const double heights[] = {-1, -0.5, 0, 0.25, 0.8, 1.5};
    for (int i = 0; i < 6; i++) {
        tahr_fluid found;
        tahr_fluid_query q = {.position = tahr__lab_at(lab, 0, heights[i]),
                              .up = tahr__lab_up(lab),
                              .radius = 0.35,
                              .half_height = 0.9,
                              .mask = 0xFFFFFFFFu};
        double part = (0.9 - heights[i]) / 1.8, immersion = part > 1 ? 1 : max_of(part, 0);
        memset(&found, 0, sizeof found);
        tahr_status status = tahr_world_fluid(lab->world, &q, &found);
        tahr__lab_check(lab,
                        status >= 0 && fabs(found.immersion - immersion) <= 1e-4 &&
                            found.body == (immersion > 0 ? 0 : TAHR_NO_BODY) &&
                            (immersion == 0 || (found.friction == 0.7 && length(sub(found.velocity, current)) <= 1e-9)),
                        "fluid: the part of the axis below the surface, friction 0.7, the current",
                        "at %g: %s, immersion %.9g instead of %.9g, body %u", heights[i], tahr_status_name(status),
                        found.immersion, immersion, found.body);
    }
}

static void body_motion(tahr__lab *lab)
{
    tahr_body_motion motion;
    const tahr_quat identity = {0, 0, 0, 1};
    if (!tahr__lab_first_shape(lab, TAHR__LAB_USUAL)) {
        return;
    }
    tahr__lab_block(lab, -3, -2, 3, 0);
    if (!tahr__lab_open(lab)) {
        return;
    }
    if (!lab->world->backend->body_motion) {
        lab->checks = 0;
        tahr__lab_lacks(lab, "the slot body_motion");
        return;
    }
    memset(&motion, 0, sizeof motion);
    motion.pose.orientation = identity;
    tahr_status gone = lab->world->backend->body_motion(lab->world->self, 54321, &motion);
    tahr__lab_check(lab, gone == TAHR_E_NOT_FOUND, "the motion of a body that there is not: not_found", "%s",
                    tahr_status_name(gone));
}

static const tahr__lab_case cases[] = {
    {"body_box", TAHR_CAP_SOLIDS, body_box},
    {"body_sphere", TAHR_CAP_SOLIDS, body_sphere},
    {"body_capsule", TAHR_CAP_SOLIDS, body_capsule},
    {"body_mesh", TAHR_CAP_MESH, body_mesh},
    {"body_cylinder", TAHR_CAP_ROUND_SOLIDS, body_cylinder},
    {"body_cone", TAHR_CAP_ROUND_SOLIDS, body_cone},
    {"body_ellipsoid", TAHR_CAP_ROUND_SOLIDS, body_ellipsoid},
    {"body_hull", TAHR_CAP_HULLS, body_hull},
    {"body_heights", TAHR_CAP_HEIGHTS, body_heights},
    {"body_chain_loop", TAHR_CAP_PLANAR | TAHR_CAP_CHAINS, body_chain},
    {"fluid_immersion", TAHR_CAP_SOLIDS | TAHR_CAP_SENSORS, fluid},
    {"body_motion", 0, body_motion},
};

const tahr__lab_theme tahr__lab_bodies = {cases, sizeof cases / sizeof cases[0]};
