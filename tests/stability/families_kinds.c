/* SPDX-License-Identifier: MIT
 * families_kinds.c: kinds of bodies and of characters that others do not have: hulls, fields of heights, platforms that
 * are there from above only, sensors, water, what pushes, and who is a box. What is promised of each is measured here
 * in closed form: all that is not a hull or a field is a box along the axes, and the character is upright. */
#include "family.h"

#include <math.h>
#include <string.h>

static const double TURN = 6.283185307179586;

static tahr_vec3 at(double x, double y, double z)
{
    return (tahr_vec3){x, y, z};
}

/* Which of the coordinates is height. */
static double height_of(const trial *t, tahr_vec3 v)
{
    return t->world == IN_PLANE ? v.y : v.z;
}

/* m between the intervals [a, b] and [c, d]; below 0 they overlap by that much. */
static double between(double a, double b, double c, double d)
{
    return fmax(c - b, a - d);
}

/* m between the upright capsule of a state and a box along the axes; 0 where they overlap. */
static double gap_to_box(const trial *t, const tahr_state *s, const trial_body *b)
{
    const double core = s->half_height - s->radius;
    const tahr_vec3 p = s->position, c = b->desc.pose.position, h = b->desc.half_extents;
    const int flat = t->world == IN_PLANE;
    const double y = flat ? core : 0, z = flat ? 0 : core;
    double dx = fmax(0, between(p.x, p.x, c.x - h.x, c.x + h.x));
    double dy = fmax(0, between(p.y - y, p.y + y, c.y - h.y, c.y + h.y));
    double dz = fmax(0, between(p.z - z, p.z + z, c.z - h.z, c.z + h.z));
    return fmax(0, sqrt(dx * dx + dy * dy + dz * dz) - s->radius);
}

/* The corners of a cube, of an octahedron and of a prism, and their faces, seen from outside counter-clockwise. */
static const double CUBE[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                  {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
static const uint32_t CUBE_FACES[12][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                           {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
static const double OCTAHEDRON[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
static const uint32_t OCTAHEDRON_FACES[8][3] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                                {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
static const double PRISM[6][3] = {{-1, -1, -1}, {1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}, {1, 1, -1}, {-1, 1, 1}};
static const uint32_t PRISM_FACES[8][3] = {{0, 1, 2}, {3, 5, 4}, {0, 3, 4}, {0, 4, 1},
                                           {1, 4, 5}, {1, 5, 2}, {2, 5, 3}, {2, 3, 0}};

/* A linear image of one of them: of convex it stays convex, and the windings stay where its determinant is positive. */
static void add_hull(trial *t, oracle_random *dice, tahr_vec3 centre)
{
    static const struct {
        const double (*corners)[3];
        const uint32_t (*faces)[3];
        uint32_t corner_count, face_count;
    } solids[] = {{CUBE, CUBE_FACES, 8, 12}, {OCTAHEDRON, OCTAHEDRON_FACES, 6, 8}, {PRISM, PRISM_FACES, 6, 8}};
    const uint32_t which = oracle_below(dice, 3);
    trial_body *b = trial_mesh(t, 0);
    const double x = draw(dice, 0.2, 1.5), y = draw(dice, 0.2, 1.5), z = draw(dice, 0.1, 1), lean = draw(dice, -1, 1);
    const double slant = draw(dice, -0.5, 0.5), turn = draw(dice, 0, TURN), c = cos(turn), s = sin(turn);
    b->desc.type = TAHR_BODY_HULL;
    b->desc.pose.position = centre;
    for (uint32_t i = 0; i < solids[which].corner_count; i++) {
        const double *v = solids[which].corners[i];
        const double u = x * v[0] + lean * z * v[2], w = y * v[1] + slant * z * v[2];
        scene_mesh_vertex(&b->mesh, c * u - s * w, s * u + c * w, z * v[2]);
    }
    for (uint32_t i = 0; i < solids[which].face_count; i++) {
        const uint32_t *f = solids[which].faces[i];
        scene_mesh_triangle(&b->mesh, f[0], f[1], f[2]);
    }
}

static void wander_and_rest(trial *t, oracle_random *dice, uint32_t jumps)
{
    trial_wander(t, dice, 90, draw(dice, 0, TURN), 2, jumps);
    trial_idle(t, 50);
}

void make_hulls(trial *t, oracle_random *dice)
{
    trial_room(t, at(-6, -6, 0), at(6, 6, 8));
    for (uint32_t i = 4 + oracle_below(dice, 10); i > 0; i--)
        add_hull(t, dice, at(draw(dice, -4, 4), draw(dice, -4, 4), draw(dice, 0, 1.5)));
    trial_stand(t, 0, 0, 4);
    wander_and_rest(t, dice, 25);
    t->keeps &= ~(uint32_t)KEEPS_SAYING;
}

/* Rough ground, from gentle to sharper than anything can be walked on, with holes in one of three, over a floor. The
 * mesh that the judge looks at is cut as TAHR_BODY_HEIGHTS says. */
void make_heights(trial *t, oracle_random *dice)
{
    const uint32_t n = 9 + oracle_below(dice, 8), holes = draw_one_in(dice, 3) ? 12 : 0;
    const double half = 5, rough = draw_power(dice, -3, 0.1), cell = 2 * half / (n - 1);
    int known[24][24];
    trial_box(t, at(0, 0, -9), at(40, 40, 1), 0);
    trial_body *b = trial_mesh(t, TAHR_BODY_TWO_SIDED); /* at a rim the judge cannot tell who is behind a face */
    b->desc.type = TAHR_BODY_HEIGHTS;
    b->desc.half_extents = at(half, half, 0);
    b->desc.columns = b->desc.rows = n;
    for (uint32_t r = 0; r < n; r++) {
        for (uint32_t c = 0; c < n; c++) {
            known[r][c] = !(holes && draw_one_in(dice, holes));
            scene_mesh_vertex(&b->mesh, -half + c * cell, -half + r * cell,
                              known[r][c] ? rough * draw(dice, -1, 1) : TRIAL_HOLE);
        }
    }
    for (uint32_t r = 0; r + 1 < n; r++) {
        for (uint32_t c = 0; c + 1 < n; c++) {
            const uint32_t i = r * n + c;
            const int diagonal = known[r][c] && known[r + 1][c + 1];
            if (diagonal && known[r][c + 1]) scene_mesh_triangle(&b->mesh, i, i + 1, i + n + 1);
            if (diagonal && known[r + 1][c]) scene_mesh_triangle(&b->mesh, i, i + n + 1, i + n);
        }
    }
    trial_stand(t, draw(dice, -1, 1), draw(dice, -1, 1), rough + 0.3);
    wander_and_rest(t, dice, 25);
    t->keeps &= ~(uint32_t)KEEPS_SAYING;
}

/* Nobody who is above a platform comes below it, and nobody feels one from below or from the side. */
static double keep_one_way(const trial *t, int step, const tahr_state *a, const tahr_state *b, const tahr_report *r,
                           const char **what)
{
    const double slack = t->config.skin / 10 + 1e-5;
    (void)step;
    for (uint32_t i = 0; i < t->body_count; i++) {
        const trial_body *body = &t->bodies[i];
        const tahr_vec3 c = body->desc.pose.position, h = body->desc.half_extents;
        const double top = height_of(t, c) + height_of(t, h);
        const double foot = height_of(t, a->position) - a->half_height,
                     now = height_of(t, b->position) - b->half_height;
        if (!(body->desc.flags & TAHR_BODY_ONE_WAY)) continue;
        int over = fabs(a->position.x - c.x) < h.x && fabs(b->position.x - c.x) < h.x;
        over = over && (t->world == IN_PLANE || (fabs(a->position.y - c.y) < h.y && fabs(b->position.y - c.y) < h.y));
        *what = "fell through what it was above, m";
        if (over && foot >= top && now < top - slack) return 1 + (top - now);
    }
    for (uint32_t i = 0; i < r->event_count; i++) {
        const tahr_event *e = &r->events[i];
        if (e->type != TAHR_EVENT_HIT || e->body >= t->body_count) continue;
        *what = "felt what is there from above only, normal";
        if (t->bodies[e->body].desc.flags & TAHR_BODY_ONE_WAY && height_of(t, e->normal) < 0.5 - 1e-9) return 2;
    }
    return 0;
}

/* Platforms over each other, as high as a jump within a hair, under somebody who falls, jumps and walks off them. */
void make_one_way(trial *t, oracle_random *dice)
{
    const double jump =
        0.5 * t->config.jump_speed * t->config.jump_speed / fabs(t->config.gravity.z + t->config.gravity.y);
    double top = 0;
    trial_box(t, at(0, 0, -0.5), at(12, 12, 0.5), 0);
    for (uint32_t i = 1 + oracle_below(dice, 4); i > 0; i--) {
        const double thin = draw_one_in(dice, 2) ? 0.01 : draw(dice, 0.02, 0.3);
        top += draw_one_in(dice, 2) ? draw_around(dice, jump, 1) : draw(dice, 0.3, 1.5);
        trial_box(t, at(draw(dice, -1, 1), 0, top - thin), at(draw(dice, 0.5, 3), 3, thin), TAHR_BODY_ONE_WAY);
    }
    trial_stand(t, draw(dice, -1, 1), 0, draw_one_in(dice, 2) ? t->config.skin * 1.25 : draw(dice, 0, top + 3));
    t->velocity = at(0, 0, draw_one_in(dice, 3) ? draw(dice, -30, 6) : 0);
    wander_and_rest(t, dice, 8);
    t->keeps |= KEEPS_PROMISE;
    t->keeps &= ~(uint32_t)KEEPS_FLOOR; /* the judge does not see platforms */
    t->promise = keep_one_way;
}

/* touched names those that it overlaps, and no others. */
static double keep_sensors(const trial *t, int step, const tahr_state *a, const tahr_state *b, const tahr_report *r,
                           const char **what)
{
    const double slack = 1e-5;
    (void)step, (void)a, (void)r;
    for (uint32_t i = 0; i < t->body_count; i++) {
        trial_body body = t->bodies[i], less = body;
        int touched = 0;
        if (!(body.desc.flags & TAHR_BODY_SENSOR)) continue;
        for (uint32_t k = 0; k < b->touched_count && k < TAHR_MAX_TOUCHED; k++)
            touched = touched || b->touched[k] == i;
        less.desc.half_extents.x -= slack, less.desc.half_extents.y -= slack, less.desc.half_extents.z -= slack;
        *what = "touches a sensor, and does not know, or the other way round";
        if (touched ? gap_to_box(t, b, &body) > slack : gap_to_box(t, b, &less) == 0) return 2;
    }
    return 0;
}

/* Any of the usual cases, full of sensors. */
void make_sensors(trial *t, oracle_random *dice)
{
    make_any(t, dice);
    for (uint32_t i = 1 + oracle_below(dice, 6); i > 0 && t->body_count < TRIAL_BODIES - 8; i--)
        trial_box(t, at(draw(dice, -4, 4), draw(dice, -0.05, 0.05), draw(dice, -1, 3)),
                  at(draw(dice, 0.1, 1.5), draw(dice, 0.1, 1.5), draw(dice, 0.1, 1.5)), TAHR_BODY_SENSOR);
    t->keeps = KEEPS_SANE | KEEPS_RELATION | KEEPS_PROMISE;
    t->promise = keep_sensors;
}

/* Deep in the water it swims, and where there is none it does not. numbers: of the water's surface. */
static double keep_water(const trial *t, int step, const tahr_state *a, const tahr_state *b, const tahr_report *r,
                         const char **what)
{
    const trial_body *water = &t->bodies[t->body_count - 1];
    const double deep = height_of(t, b->position) + b->half_height + 0.1;
    const int dry = gap_to_box(t, b, water) > 1e-5 && gap_to_box(t, a, water) > 1e-5;
    const int drowned = deep < t->numbers[0] && height_of(t, a->position) + a->half_height + 0.1 < t->numbers[0];
    (void)step, (void)r;
    *what = dry ? "swims where no water is" : "is deep in the water, and does not swim";
    if (dry) return b->mode == TAHR_MODE_SWIMMING ? 2 : 0;
    return drowned && b->mode != TAHR_MODE_SWIMMING ? 2 : 0;
}

/* A basin with blocks in it; it falls in, dives, comes up and gets out again or not. */
void make_water(trial *t, oracle_random *dice)
{
    const double surface = draw(dice, -0.2, 3);
    trial_room(t, at(-5, -5, -3), at(5, 5, 7));
    for (uint32_t i = 2 + oracle_below(dice, 5); i > 0; i--)
        trial_box(t, at(draw(dice, -4, 4), draw(dice, -4, 4), draw(dice, -3, surface)),
                  at(draw(dice, 0.3, 1.5), draw(dice, 0.3, 1.5), draw(dice, 0.2, 1.5)), 0);
    t->numbers[0] = surface;
    trial_stand(t, 0, 0, surface + draw(dice, 0.1, 2));
    wander_and_rest(t, dice, 12);
    for (int i = 0; i < t->step_count; i++)
        t->steps[i].input.move.z = i < 90 && i / 15 % 2 ? draw(dice, -1, 1) : 0;
    t->keeps &= ~(uint32_t)(KEEPS_SAYING | KEEPS_REST);
    t->keeps |= KEEPS_PROMISE;
    t->promise = keep_water;
    trial_box(t, at(0, 0, (surface - 4) / 2), at(6, 6, (surface + 4) / 2), TAHR_BODY_FLUID);
}

/* In front of the plough: numbers: its front at the begin, its speed, s that it goes on, its reach to either side. */
static double keep_pushed(const trial *t, int step, const tahr_state *a, const tahr_state *b, const tahr_report *r,
                          const char **what)
{
    const double front = t->numbers[0] + t->numbers[1] * fmin((step + 1) / 60.0, t->numbers[2]);
    const double slack = t->config.skin / 10 + 1e-5;
    (void)a, (void)r;
    *what = "is in what pushes it, with all the room there is before it, m";
    if (t->world == IN_SPACE && fabs(b->position.y) > t->numbers[3]) return 0;
    return (front + b->radius - b->position.x) / slack;
}

/* On an open floor, walking toward what comes, away from it, or not at all. */
void make_pushed(trial *t, oracle_random *dice)
{
    const double speed = draw_power(dice, -1, 0.8), r = trial_radius(t), gap = draw(dice, 0.05, 1);
    trial_box(t, at(0, 0, -0.5), at(20, 20, 0.5), 0);
    trial_body *plough = trial_box(t, at(-r - gap - 0.5, 0, 1.1), at(0.5, 4, 1), TAHR_BODY_MOVABLE);
    plough->motion.drift = at(speed, 0, 0);
    plough->motion.lasts = fmin(2, 6 / speed);
    t->numbers[0] = -r - gap;
    t->numbers[1] = speed;
    t->numbers[2] = plough->motion.lasts;
    t->numbers[3] = 4;
    trial_stand(t, 0, draw(dice, -2, 2), t->config.skin * 1.25);
    trial_wander(t, dice, 70, draw_one_in(dice, 2) ? TURN / 2 : draw(dice, 0, TURN), 0.5, 0);
    trial_idle(t, 60);
    t->keeps &= ~(uint32_t)KEEPS_REST;
    t->keeps |= KEEPS_PROMISE;
    t->promise = keep_pushed;
}

/* Boxes along the axes around a box: steps as high as the rules allow and gaps as wide as it is, within a hair. */
void make_box_character(trial *t, oracle_random *dice)
{
    const double w = 0.35, step = t->config.step_height;
    t->config.shape = (tahr_shape){.type = TAHR_SHAPE_BOX, .half_x = w, .half_y = w, .half_height = 0.9};
    trial_room(t, at(-6, -6, 0), at(6, 6, 8));
    for (uint32_t i = 3 + oracle_below(dice, 10); i > 0; i--) {
        const double high = draw_one_in(dice, 2) ? draw_around(dice, step, 1) : draw(dice, 0.05, 2);
        trial_box(t, at(draw(dice, -4, 4), draw(dice, -4, 4), high / 2),
                  at(draw(dice, 0.1, 1.2), draw(dice, 0.1, 1.2), high / 2), 0);
    }
    const double room = w + draw_around(dice, t->config.skin, 1);
    trial_box(t, at(2.5, room + 0.5, 1.5), at(1, 0.5, 1.5), 0);
    trial_box(t, at(2.5, -room - 0.5, 1.5), at(1, 0.5, 1.5), 0);
    trial_stand(t, 0, 0, 3);
    wander_and_rest(t, dice, 25);
    t->keeps &= ~(uint32_t)KEEPS_SAYING;
}
