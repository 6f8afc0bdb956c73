/* SPDX-License-Identifier: MIT
 * families_walls.c: several surfaces at once: corners, gutters, wedges, ceilings, steps, rims, slopes. */
#include "family.h"

#include <math.h>

static const double DEGREE = 0.017453292519943295;

static tahr_vec3 at(double x, double y, double z)
{
    return (tahr_vec3){x, y, z};
}

static void level_floor(trial *t)
{
    trial_box(t, at(0, 0, -1), at(15, 15, 1), 0);
}

/* Two walls that meet ahead at 2 to 40 degrees, pushed into. */
void make_acute_corner(trial *t, oracle_random *dice)
{
    double half = draw(dice, 1, 20) * DEGREE, turn = draw(dice, -0.6, 0.6), far = trial_radius(t) / sin(half) + 1.5;
    double line[3][2];
    for (int i = 0; i < 3; i++) { /* from the apex outward; the front faces the mouth */
        double way = i == 0 ? turn - half : turn + half, out = i == 1 ? 0 : far + 3;
        line[i][0] = far * cos(turn) - out * cos(way);
        line[i][1] = far * sin(turn) - out * sin(way);
    }
    level_floor(t);
    scene_mesh_plan(&trial_mesh(t, TAHR_BODY_TWO_SIDED)->mesh, (const double(*)[2])line, 3, -0.5, 4);
    t->start = at(0, 0, trial_half(t) + t->config.skin * 1.25);
    trial_wander(t, dice, 100, turn, draw_one_in(dice, 2) ? 0.05 : 1, 0);
    trial_idle(t, 20);
    t->keeps &= ~(uint32_t)KEEPS_SAYING;
}

/* Two slopes that meet below, each walkable or not, along a crease that falls or not. */
void make_gutter(trial *t, oracle_random *dice)
{
    double left = tan(draw(dice, 20, 75) * DEGREE), right = tan(draw(dice, 20, 75) * DEGREE);
    if (t->world == IN_SPACE) {
        scene_mesh *m = &trial_mesh(t, 0)->mesh;
        double fall = draw_one_in(dice, 2) ? 0 : draw(dice, 0, 0.5);
        for (int i = 0; i < 2; i++) {
            double y = i ? 15 : -15;
            scene_mesh_vertex(m, -5, y, 5 * left - fall * y);
            scene_mesh_vertex(m, 0, y, -fall * y);
            scene_mesh_vertex(m, 5, y, 5 * right - fall * y);
        }
        for (uint32_t i = 0; i < 2; i++) {
            scene_mesh_triangle(m, i, i + 1, i + 4);
            scene_mesh_triangle(m, i, i + 4, i + 3);
        }
    } else {
        const double line[3][2] = {{-5, 5 * left}, {0, 0}, {5, 5 * right}};
        trial_profile(t, line, 3, 0);
    }
    trial_stand(t, draw(dice, -0.6, 0.6), draw(dice, -1, 1), 2.2 + 0.6 * fmax(left, right));
    t->velocity = at(draw(dice, -2, 2), draw(dice, -3, 3), draw(dice, -5, 0));
    trial_wander(t, dice, 80, draw(dice, -3.2, 3.2), draw_one_in(dice, 2) ? 0 : 1, 40);
    trial_idle(t, 50);
    t->keeps &= ~(uint32_t)KEEPS_SAYING;
}

/* A corner of two walls on a slope (8 and 12 degrees are where others stop to tell planes apart), or a slope that meets
 * a ceiling. */
void make_wedge(trial *t, oracle_random *dice)
{
    double slope = tan(draw(dice, -30, 30) * DEGREE), h = trial_half(t);
    const double line[2][2] = {{-12, -12 * slope}, {12, 12 * slope}};
    trial_profile(t, line, 2, 0);
    if (t->world == IN_SPACE && draw_one_in(dice, 2)) {
        double half = (draw_one_in(dice, 2) ? 5 : draw(dice, 3, 20)) * DEGREE * draw(dice, 0.7, 1.3);
        double far = trial_radius(t) / sin(half) + 0.8;
        const double walls[3][2] = {
            {far - 12 * cos(half), 12 * sin(half)}, {far, 0}, {far - 12 * cos(half), -12 * sin(half)}};
        scene_mesh_plan(&trial_mesh(t, TAHR_BODY_TWO_SIDED)->mesh, walls, 3, -12, 12);
    } else {
        double down = tan(draw(dice, 1, 60) * DEGREE), x = draw(dice, 1, 3);
        double over = x * slope + 2 * h; /* where the ceiling is as low as the character */
        const double ceiling[2][2] = {{x + 8, over - 8 * down}, {x - 10, over + 10 * down}};
        trial_profile(t, ceiling, 2, TAHR_BODY_TWO_SIDED);
    }
    trial_stand(t, 0, 0, t->config.skin * 1.3 + trial_radius(t) * (sqrt(1 + slope * slope) - 1));
    trial_wander(t, dice, 80, 0, draw_one_in(dice, 2) ? 0.1 : 1, 30);
    trial_idle(t, 30);
    t->keeps &= ~(uint32_t)(KEEPS_SAYING);
}

/* A ceiling as high as the character and one or two skins, within a hair: from the open into it, and jumping. */
void make_floor_ceiling(trial *t, oracle_random *dice)
{
    double skin = t->config.skin, h = 2 * trial_half(t);
    const double extra[] = {0, skin, 2 * skin, skin * (1 + t->config.floor_target), skin * (1 + t->config.floor_max)};
    double height = h + draw_around(dice, extra[oracle_below(dice, 5)], 1), x = draw(dice, 0.8, 1.5);
    level_floor(t);
    trial_box(t, at(x + 3, 0, height + 1), at(3, 5, 1), 0);
    trial_stand(t, 0, 0, skin * 1.25);
    trial_wander(t, dice, 80, 0, draw_one_in(dice, 2) ? 0.1 : 1, draw_one_in(dice, 2) ? 10 : 0);
    trial_idle(t, 20);
    t->keeps &= ~(uint32_t)KEEPS_SAYING;
}

/* Steps as high as the limits of the rules, within a hair; narrow treads; bevels; walls and ceilings behind. */
void make_step_traps(trial *t, oracle_random *dice)
{
    double r = trial_radius(t), limit = t->config.step_height, cap = r * (1 - cos(t->config.walkable_angle));
    const double heights[] = {limit, limit + t->config.skin, cap, r, 2 * t->config.skin, 0.25};
    double line[TRIAL_OUTLINE][2], x = 1, z = 0;
    int count = 1;
    line[0][0] = -10, line[0][1] = 0;
    for (int i = 0; i < 6; i++) {
        double rise = draw_around(dice, heights[oracle_below(dice, 6)], 0.3), bevel = draw_one_in(dice, 3) ? 0.03 : 0;
        line[count][0] = x, line[count++][1] = z;
        line[count][0] = x, line[count++][1] = z + rise - bevel;
        if (bevel > 0) line[count][0] = x + bevel, line[count++][1] = z + rise;
        z += rise;
        x += bevel + (draw_one_in(dice, 2) ? draw(dice, 0.02, 0.3) : draw(dice, 0.3, 1.2));
    }
    line[count][0] = x, line[count++][1] = z;
    line[count][0] = x + 10, line[count++][1] = z + (draw_one_in(dice, 2) ? 0 : draw(dice, -3, 8));
    trial_profile(t, (const double(*)[2])line, count, 0);
    if (draw_one_in(dice, 3)) trial_box(t, at(3, 0, 2 * trial_half(t) + draw(dice, 0.02, 1) + 1), at(2, 4, 1), 0);
    if (draw_one_in(dice, 3)) trial_box(t, at(0, 1.2, 1), at(10, 0.5, 4), 0);
    trial_stand(t, 0, 0, t->config.skin * 1.25);
    trial_wander(t, dice, 90, 0, draw_one_in(dice, 2) ? 0.05 : 1.2, draw_one_in(dice, 2) ? 30 : 0);
    trial_idle(t, 50);
    t->keeps &= ~(uint32_t)KEEPS_SAYING;
}

/* Half over a rim, as far as the rules just allow, within a hair; then a creep outward. */
void make_perch(trial *t, oracle_random *dice)
{
    double r = trial_radius(t), angle = t->config.walkable_angle;
    const double limits[] = {r * sin(angle),
                             r - t->config.perch_threshold,
                             r - t->config.edge_tolerance,
                             r,
                             0,
                             r * sin(angle + t->config.walkable_hysteresis)};
    double over = draw_around(dice, limits[oracle_below(dice, 6)], 0.3), deep = draw_one_in(dice, 2) ? 0.3 : 6;
    double skin = t->config.skin * 1.25, round = over < r ? r - sqrt((r + skin) * (r + skin) - over * over) + skin : 0;
    trial_box(t, at(-5, 0, -3), at(5, 6, 3), 0);
    trial_box(t, at(4, 0, -deep - 1), at(4, 6, 1), 0);
    trial_stand(t, over, 0, over > 0 ? fmax(skin - fmax(round, 0), 0.2 * skin) : skin);
    t->start.z += over > 0 && over < r ? 0.02 : 0;
    if (draw_one_in(dice, 2)) trial_walk(t, 60, at(draw_power(dice, -4, -1) * (draw_one_in(dice, 3) ? -1 : 1), 0, 0));
    t->first_rest = t->step_count;
    trial_idle(t, 60);
}

/* Slopes of every angle, up to and around the limit: walking up, down and across, standing, again and again. */
void make_hunting(trial *t, oracle_random *dice)
{
    double angle = draw_one_in(dice, 2) ? draw(dice, -1, 1) * t->config.walkable_angle
                                        : draw_around(dice, t->config.walkable_angle, 0.3);
    double s = sin(angle), c = cos(angle), r = trial_radius(t);
    const double line[2][2] = {{-20 * c, -20 * s}, {20 * c, 20 * s}};
    trial_profile(t, line, 2, 0);
    trial_stand(t, 0, 0, r * (1 / c - 1) + draw_around(dice, t->config.skin * 1.25, 0.2) / c);
    if (draw_one_in(dice, 2)) trial_wander(t, dice, 50, draw(dice, -3.2, 3.2), 3.2, 0);
    t->first_rest = t->step_count;
    trial_idle(t, 60);
}

/* Speed squared and twice what the height is worth do not grow while falling. numbers[0]: |gravity|. */
static double energy_promise(const trial *t, int step, const tahr_state *before, const tahr_state *now,
                             const tahr_report *report, const char **what)
{
    for (uint32_t i = 0; i < report->event_count; i++) {
        if (report->events[i].type == TAHR_EVENT_DEPENETRATED) return 0; /* put there, not flown there */
    }
    *what = "gains energy in a fall without input, part of it";
    if (step < t->first_rest || before->mode != TAHR_MODE_FALLING || now->mode != TAHR_MODE_FALLING) return 0;
    double g = t->numbers[0], rise = 0, was = 0, is = 0;
    const double up[3] = {now->up.x, now->up.y, now->up.z};
    const double a[3] = {before->position.x, before->position.y, before->position.z};
    const double b[3] = {now->position.x, now->position.y, now->position.z};
    const double u[3] = {before->velocity.x, before->velocity.y, before->velocity.z};
    const double v[3] = {now->velocity.x, now->velocity.y, now->velocity.z};
    for (int i = 0; i < 3; i++) {
        rise += (b[i] - a[i]) * up[i];
        was += u[i] * u[i];
        is += v[i] * v[i];
    }
    double most = was - 2 * g * rise;
    /* Stepped: v * dt with the new speed, off by g * dt of speed over the step; and a correction by a skin. */
    double dt = t->steps[step].dt, loose = 4 * g * t->config.skin + 1e-9 * was;
    if (t->config.integrator == TAHR_INTEGRATOR_STEPPED) loose += g * dt * (2 * sqrt(was) + g * dt);
    return is <= most + loose ? 0 : is / (most + loose);
}

/* Falls fast into funnels of steep faces, without input: bounces, hops and keeps no more than gravity gave. */
void make_energy(trial *t, oracle_random *dice)
{
    uint32_t sides = 3 + oracle_below(dice, 5);
    if (t->world == IN_SPACE) {
        scene_mesh *m = &trial_mesh(t, 0)->mesh;
        uint32_t tip = scene_mesh_vertex(m, draw(dice, -0.5, 0.5), draw(dice, -0.5, 0.5), 0);
        for (uint32_t i = 0; i < sides; i++) {
            double a = 6.283185307179586 * i / sides;
            scene_mesh_vertex(m, 6 * cos(a), 6 * sin(a), draw(dice, 7.5, 14));
        }
        for (uint32_t i = 0; i < sides; i++)
            scene_mesh_triangle(m, tip, 1 + i, 1 + (i + 1) % sides);
    } else {
        const double line[3][2] = {{-6, draw(dice, 7.5, 14)}, {0, 0}, {6, draw(dice, 7.5, 14)}};
        trial_profile(t, line, 3, 0);
    }
    trial_stand(t, draw(dice, -1, 1), draw(dice, -1, 1), 5);
    t->velocity = at(draw(dice, -6, 6), draw(dice, -6, 6), draw(dice, -20, 3));
    t->first_rest = 0;
    trial_idle(t, 110);
    t->keeps &= ~(uint32_t)KEEPS_SAYING;
    t->keeps |= KEEPS_PROMISE;
    t->promise = energy_promise;
    tahr_vec3 g = t->config.gravity;
    t->numbers[0] = sqrt(g.x * g.x + g.y * g.y + g.z * g.z) * t->config.fall_gravity;
}
