/* SPDX-License-Identifier: MIT
 * families_contact.c: touching, almost touching, overlapping; edges and corners; no room. */
#include "family.h"

#include <math.h>

static const tahr_vec3 FLOOR = {0, 0, -1}, FLOOR_HALF = {10, 10, 1};

static tahr_vec3 at(double x, double y, double z)
{
    return (tahr_vec3){x, y, z};
}

/* A character whose radius and half height are sums of few powers of two: it touches exactly. */
static void make_dyadic(trial *t)
{
    t->config.shape.radius = 0.375;
    t->config.shape.half_height = t->config.shape.type == TAHR_SHAPE_SPHERE ? 0.375 : 0.875;
    t->config.skin = 0.015625;
}

/* Boxes that it touches at gap 0, at the skin, or by a hair beside them; then along, into and away from them. */
void make_touching(trial *t, oracle_random *dice)
{
    make_dyadic(t);
    const double gaps[] = {0, t->config.skin, t->config.skin * t->config.floor_target,
                           t->config.skin * t->config.floor_max};
    double r = trial_radius(t), foot = draw_around(dice, gaps[oracle_below(dice, 4)], 1);
    double side = draw_around(dice, gaps[oracle_below(dice, 2)], 1);
    trial_box(t, FLOOR, FLOOR_HALF, 0);
    trial_box(t, at(r + side + 0.5, 0, 1), at(0.5, draw_one_in(dice, 2) ? 4 : 0.25, 1), 0);
    if (draw_one_in(dice, 2)) trial_box(t, at(0, r + side + 0.5, 1), at(4, 0.5, 1), 0);
    trial_stand(t, 0, 0, foot);
    trial_wander(t, dice, 40, draw(dice, -3.2, 3.2), 0.4, draw_one_in(dice, 2) ? 20 : 0);
    trial_idle(t, 12);
}

/* Within 1e-9 to 1e-3 m of contact with triangles, on either side of it: where booleans are wrong. */
void make_dead_band(trial *t, oracle_random *dice)
{
    double sign = draw_one_in(dice, 2) ? 1 : -1, gap = sign * draw_power(dice, -9, -3), r = trial_radius(t);
    if (t->world == IN_SPACE) {
        trial_body *b = trial_mesh(t, 0);
        uint32_t o = scene_mesh_vertex(&b->mesh, -4, -4, 0), x = scene_mesh_vertex(&b->mesh, 12, -4, 0);
        uint32_t y = scene_mesh_vertex(&b->mesh, -4, 12, 0);
        scene_mesh_triangle(&b->mesh, o, x, y);
        const double wall[2][2] = {{r + gap, -3}, {r + gap, 3}};
        scene_mesh_plan(&trial_mesh(t, 0)->mesh, wall, 2, -1, 3);
    } else {
        const double line[3][2] = {{-8, 0}, {r + gap, 0}, {r + gap, 4}};
        trial_profile(t, line, 3, 0);
    }
    trial_stand(t, 0, draw(dice, -0.5, 0.5), gap);
    trial_wander(t, dice, 30, draw(dice, -3.2, 3.2), 0.3, 0);
    trial_idle(t, 12);
}

/* Ridges, spikes and rims: the nearest feature is an edge or a corner. */
void make_edges(trial *t, oracle_random *dice)
{
    double steep = tan(draw(dice, 0.05, 1.3)), x = draw(dice, -0.4, 0.4);
    if (t->world == IN_SPACE && draw_one_in(dice, 2)) {
        scene_mesh *m = &trial_mesh(t, 0)->mesh;
        uint32_t sides = 3 + oracle_below(dice, 6), tip = scene_mesh_vertex(m, 0, 0, 0);
        for (uint32_t i = 0; i < sides; i++) {
            double a = 6.283185307179586 * i / sides;
            scene_mesh_vertex(m, 6 * cos(a), 6 * sin(a), -6 * steep);
        }
        for (uint32_t i = 0; i < sides; i++)
            scene_mesh_triangle(m, tip, 1 + i, 1 + (i + 1) % sides);
    } else {
        const double line[3][2] = {{-8, -8 * steep}, {0, 0}, {8, -8 * tan(draw(dice, 0.05, 1.3))}};
        trial_profile(t, line, 3, 0);
    }
    trial_box(t, at(0, 0, -20), at(30, 30, 1), 0);
    trial_stand(t, x, draw(dice, -0.4, 0.4), 0.3 + trial_half(t) * fabs(x) * steep);
    trial_wander(t, dice, 50, draw(dice, -3.2, 3.2), 1, 25);
    trial_idle(t, 30);
}

/* Begins in something: a floor, a wall, both, or deep inside of a block. */
void make_deep_start(trial *t, oracle_random *dice)
{
    double deep = draw_one_in(dice, 3) ? draw(dice, 0, 0.9) : draw_power(dice, -6, -0.5), r = trial_radius(t);
    trial_box(t, FLOOR, FLOOR_HALF, 0);
    trial_box(t, at(r + 1 - (draw_one_in(dice, 2) ? deep : -0.2), 0, 1), at(1, 3, draw(dice, 0.3, 2)), 0);
    if (draw_one_in(dice, 2)) trial_box(t, at(0, r + 1 - deep * draw(dice, 0, 1), 1), at(3, 1, 1), 0);
    trial_stand(t, 0, 0, draw_one_in(dice, 2) ? -deep : t->config.skin);
    trial_wander(t, dice, 30, draw(dice, -3.2, 3.2), 1, 0);
    trial_idle(t, 12);
    t->keeps &= ~(uint32_t)(KEEPS_SAYING | KEEPS_SOLID | KEEPS_REST | KEEPS_FLOOR);
}

/* Between two walls nearer than it is wide: no place is free, and one of them is the best. */
void make_tug_of_war(trial *t, oracle_random *dice)
{
    double r = trial_radius(t), tight = draw_one_in(dice, 2) ? draw_power(dice, -9, -2) : draw(dice, 0.01, 0.2);
    double half = r - tight, x = draw(dice, -1, 1) * tight;
    trial_box(t, FLOOR, FLOOR_HALF, 0);
    trial_box(t, at(half + 1, 0, 1.5), at(1, 6, 1.5), 0);
    trial_box(t, at(-half - 1, 0, 1.5), at(1, 6, 1.5), 0);
    if (draw_one_in(dice, 3)) trial_box(t, at(0, 0, 2 * trial_half(t) + 1 - tight), at(6, 6, 1), 0);
    trial_stand(t, x, 0, t->config.skin);
    trial_wander(t, dice, 20, draw(dice, -3.2, 3.2), 1, 0);
    trial_idle(t, 20);
    t->keeps &= ~(uint32_t)(KEEPS_SAYING | KEEPS_FLOOR);
}

/* A gap as wide as the character with its skin, within a hair: it goes in or it does not. */
void make_narrow(trial *t, oracle_random *dice)
{
    double r = trial_radius(t), fits = r + t->config.skin, half = draw_around(dice, fits, 0.5);
    double off = draw_one_in(dice, 2) ? 0 : draw_power(dice, -9, -1);
    trial_box(t, FLOOR, FLOOR_HALF, 0);
    if (t->world == IN_PLANE) { /* a shaft, from above */
        trial_box(t, at(half + 2, 0, 1), at(2, 2, 1), 0);
        trial_box(t, at(-half - 2, 0, 1), at(2, 2, 1), 0);
        trial_stand(t, off, 0, 2.5);
    } else {
        trial_box(t, at(2, half + 1.5, 1.5), at(1, 1.5, 1.5), 0);
        trial_box(t, at(2, -half - 1.5, 1.5), at(1, 1.5, 1.5), 0);
        trial_stand(t, -0.5, off, t->config.skin);
    }
    trial_wander(t, dice, 60, 0, draw_one_in(dice, 2) ? 0 : 0.2, 0);
    trial_idle(t, 20);
    t->keeps &= ~(uint32_t)KEEPS_SAYING;
}
