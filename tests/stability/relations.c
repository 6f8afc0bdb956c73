/* SPDX-License-Identifier: MIT
 * relations.c: what must go the same way: the same trial somewhere else, turned, mirrored, larger, cut up, shuffled, or
 * without its shortcuts. */
#include "relations.h"

#include <math.h>
#include <string.h>
#include <tahr/native.h>

static void related(trial *t)
{
    t->keeps = KEEPS_SANE | KEEPS_RELATION;
}

/* Any of those that stand still. */
void relate_any(trial *t, oracle_random *dice)
{
    make_any(t, dice);
    related(t);
}

/* Scenes of corners anywhere: nothing is decided by a hair. */
void relate_generic(trial *t, oracle_random *dice)
{
    if (draw_one_in(dice, 2))
        make_terrain(t, dice);
    else
        make_blocks(t, dice);
    related(t);
}

/* Of triangles alone, ties and all. */
void relate_triangles(trial *t, oracle_random *dice)
{
    static void (*const some[])(trial *, oracle_random *) = {make_terrain, make_slivers, make_degenerate, make_soup,
                                                             make_t_junctions};
    some[oracle_below(dice, 5)](t, dice);
    related(t);
}

/* Of triangles that block on both sides. */
void relate_two_sided(trial *t, oracle_random *dice)
{
    relate_triangles(t, dice);
    for (uint32_t i = 0; i < t->body_count; i++) {
        if (t->bodies[i].desc.type == TAHR_BODY_MESH) t->bodies[i].desc.flags |= TAHR_BODY_TWO_SIDED;
    }
}

/* All of it on multiples of 1/64 m, between 0.5 and 3.5 m above and beside the origin. */
void relate_lattice(trial *t, oracle_random *dice)
{
    t->config.shape.radius = 0.375;
    t->config.shape.half_height = t->config.shape.type == TAHR_SHAPE_SPHERE ? 0.375 : 0.875;
    t->config.skin = 0.015625;
    t->config.floor_target = 1.25;
    trial_box(t, (tahr_vec3){2, 2, 0.25}, (tahr_vec3){1.75, 1.75, 0.25}, 0);
    for (int i = 0; i < 6; i++) {
        tahr_vec3 half = {(1 + oracle_below(dice, 24)) / 64.0, (1 + oracle_below(dice, 24)) / 64.0,
                          (1 + oracle_below(dice, 48)) / 64.0};
        trial_box(t, (tahr_vec3){(40 + oracle_below(dice, 160)) / 64.0, (40 + oracle_below(dice, 160)) / 64.0, 0.5},
                  half, 0);
    }
    t->start = (tahr_vec3){2, 2, 2.25};
    trial_wander(t, dice, 50, draw(dice, 0, 6.3), 2, 20);
    trial_idle(t, 10);
    for (int i = 0; i < t->step_count; i++) {
        tahr_vec3 *m = &t->steps[i].input.move;
        *m = (tahr_vec3){floor(m->x * 32) / 32, floor(m->y * 32) / 32, 0};
    }
    related(t);
}

/* A jump, a fall, a launch: nothing near. */
void relate_flight(trial *t, oracle_random *dice)
{
    trial_box(t, (tahr_vec3){0, 0, -900}, (tahr_vec3){100, 100, 1}, 0);
    trial_stand(t, 0, 0, 5);
    t->velocity = (tahr_vec3){draw(dice, -8, 8), draw(dice, -8, 8), draw(dice, -5, 9)};
    trial_wander(t, dice, 60, draw(dice, 0, 6.3), 2, 0);
    related(t);
}

static int on_native(const subject *s)
{
    return strcmp(s->name, "native") == 0 || s->judged;
}

static int on_double(const subject *s)
{
    return s->gap <= 1e-9;
}

/* The same without its sensors, which are its last bodies: they change no way. Its bodies are fewer, so that the
 * revision of its world is another one, and floors are looked for at other times. */
void twin_senseless(const trial *t, oracle_random *dice, twin *w)
{
    (void)dice;
    twin_begin(w, t);
    trial *o = &w->other;
    while (o->body_count > 0 && o->bodies[o->body_count - 1].desc.flags & TAHR_BODY_SENSOR)
        scene_mesh_free(&o->bodies[--o->body_count].mesh);
    w->in_step = 1;
}

/* Whole cells of 4 m, on a lattice: velocities, floors and modes have the same bits, and positions those that are left
 * so far away. */
void twin_cells(const trial *t, oracle_random *dice, twin *w)
{
    double cells = 4.0 * (1 + oracle_below(dice, 4096));
    twin_begin(w, t);
    w->in_step = 1;
    w->snap = 1.0 / 1048576;
    w->shift = (tahr_vec3){draw_one_in(dice, 2) ? cells : -cells, draw_one_in(dice, 2) ? cells : 0, 0};
    trial_shift(&w->other, w->shift);
    w->tolerance = 2.220446049250313e-16 * 8 * cells; /* a few additions to a coordinate that large */
    w->ready = on_native;
}

void twin_anywhere(const trial *t, oracle_random *dice, twin *w)
{
    double far = draw_power(dice, 0, 4);
    twin_begin(w, t);
    w->in_step = 1;
    w->shift =
        (tahr_vec3){draw(dice, -far, far), draw(dice, -far, far), t->world == IN_PLANE ? 0 : draw(dice, -far, far)};
    trial_shift(&w->other, w->shift);
    w->tolerance = 1e-9 + w->other.rounding;
    w->exactness = 4;
}

static tahr_vec3 turned_by(const twin *w, tahr_vec3 v)
{
    tahr_vec3 r;
    double *to[] = {&r.x, &r.y, &r.z};
    for (int i = 0; i < 3; i++)
        *to[i] = w->rows[i].x * v.x + w->rows[i].y * v.y + w->rows[i].z * v.z;
    return r;
}

/* Applies rows, of which each has one +1 or -1, to the other trial. flip: it is a mirror, windings change. */
static void permute(twin *w, int flip)
{
    trial *o = &w->other;
    for (uint32_t i = 0; i < o->body_count; i++) {
        trial_body *b = &o->bodies[i];
        tahr_vec3 half = turned_by(w, b->desc.half_extents);
        b->desc.pose.position = turned_by(w, b->desc.pose.position);
        b->desc.half_extents = (tahr_vec3){fabs(half.x), fabs(half.y), fabs(half.z)};
        for (uint32_t k = 0; k < b->mesh.vertex_count; k++) {
            double *v = b->mesh.vertices + 3 * (size_t)k;
            tahr_vec3 to = turned_by(w, (tahr_vec3){v[0], v[1], v[2]});
            v[0] = to.x, v[1] = to.y, v[2] = to.z;
        }
        for (uint32_t k = 0; flip && k < b->mesh.triangle_count; k++) {
            uint32_t *c = b->mesh.indices + 3 * (size_t)k, second = c[1];
            c[1] = c[2];
            c[2] = second;
        }
        for (int k = 0; flip && k < b->outline_count / 2; k++) {
            double *p = b->outline[k], *q = b->outline[b->outline_count - 1 - k];
            double x = p[0], y = p[1];
            p[0] = q[0], p[1] = q[1];
            q[0] = x, q[1] = y;
        }
        for (int k = 0; flip && k < b->outline_count; k++)
            b->outline[k][0] = -b->outline[k][0];
    }
    o->start = turned_by(w, o->start);
    o->velocity = turned_by(w, o->velocity);
    for (int i = 0; i < o->step_count; i++)
        o->steps[i].input.move = turned_by(w, o->steps[i].input.move);
}

void twin_quarter(const trial *t, oracle_random *dice, twin *w)
{
    int back = draw_one_in(dice, 2);
    twin_begin(w, t);
    w->in_step = 1;
    w->rows[0] = (tahr_vec3){0, back ? 1 : -1, 0};
    w->rows[1] = (tahr_vec3){back ? -1 : 1, 0, 0};
    permute(w, 0);
    w->tolerance = 1e-9;
    w->exactness = 4;
}

void twin_mirror(const trial *t, oracle_random *dice, twin *w)
{
    (void)dice;
    twin_begin(w, t);
    w->in_step = 1;
    w->rows[0] = (tahr_vec3){-1, 0, 0};
    permute(w, 1);
    w->tolerance = 1e-9;
    w->exactness = 4;
}

/* Any way up: gravity turns with the world. */
void twin_turned(const trial *t, oracle_random *dice, twin *w)
{
    double q[4], size = 0;
    for (int i = 0; i < 4; i++)
        q[i] = draw(dice, -1, 1);
    if (t->world == IN_PLANE) q[0] = q[1] = 0;
    for (int i = 0; i < 4; i++)
        size += q[i] * q[i];
    size = sqrt(size);
    if (size < 0.1) q[0] = q[1] = 0, q[2] = 0.6, q[3] = 0.8, size = 1;
    double x = q[0] / size, y = q[1] / size, z = q[2] / size, s = q[3] / size;
    twin_begin(w, t);
    trial *o = &w->other;
    w->in_step = 1;
    w->turn = (tahr_quat){x, y, z, s};
    w->rows[0] = (tahr_vec3){1 - 2 * (y * y + z * z), 2 * (x * y - s * z), 2 * (x * z + s * y)};
    w->rows[1] = (tahr_vec3){2 * (x * y + s * z), 1 - 2 * (x * x + z * z), 2 * (y * z - s * x)};
    w->rows[2] = (tahr_vec3){2 * (x * z - s * y), 2 * (y * z + s * x), 1 - 2 * (x * x + y * y)};
    for (uint32_t i = 0; i < o->body_count; i++) {
        o->bodies[i].desc.pose.position = turned_by(w, o->bodies[i].desc.pose.position);
        o->bodies[i].desc.pose.orientation = (tahr_quat){x, y, z, s};
    }
    o->start = turned_by(w, o->start);
    o->velocity = turned_by(w, o->velocity);
    o->config.gravity = turned_by(w, o->config.gravity);
    for (int i = 0; i < o->step_count; i++)
        o->steps[i].input.move = turned_by(w, o->steps[i].input.move);
    w->tolerance = 1e-6 * 10; /* 1e-6 of the size of the scene, 10 m */
    w->exactness = 4;
}

/* Half, a quarter as large, down to a sixteenth: no number is rounded in another way, but native's searches end where
 * they are within 1e-10 m of their target at any size, and 1e-9 m is what it promises. */
void twin_scaled(const trial *t, oracle_random *dice, twin *w)
{
    const double some[] = {0.5, 0.25, 0.125, 0.0625};
    twin_begin(w, t);
    w->scale = some[oracle_below(dice, 4)];
    trial_grow(&w->other, w->scale);
    w->in_step = 1;
    w->snap = 1.0 / 1048576;
    w->tolerance = 1e-9;
    w->exactness = 4;
    w->ready = on_double;
}

void twin_split(const trial *t, oracle_random *dice, twin *w)
{
    twin_begin(w, t);
    for (uint32_t i = 0; i < w->other.body_count; i++) {
        scene_mesh *m = &w->other.bodies[i].mesh;
        uint32_t count = m->triangle_count;
        if (w->other.bodies[i].desc.type != TAHR_BODY_MESH) continue;
        for (uint32_t k = 0; k < count; k++) {
            uint32_t c[3];
            memcpy(c, m->indices + 3 * (size_t)k, sizeof c);
            const double *a = m->vertices + 3 * (size_t)c[0], *b = m->vertices + 3 * (size_t)c[1];
            const double *d = m->vertices + 3 * (size_t)c[2];
            double u = draw(dice, 0.2, 0.6), v = draw(dice, 0.1, 0.9 - u), p[3];
            for (int n = 0; n < 3; n++)
                p[n] = u * a[n] + v * b[n] + (1 - u - v) * d[n];
            uint32_t middle = scene_mesh_vertex(m, p[0], p[1], p[2]);
            m->indices[3 * (size_t)k + 2] = middle;
            scene_mesh_triangle(m, c[1], c[2], middle);
            scene_mesh_triangle(m, c[2], c[0], middle);
        }
    }
    w->in_step = 1;
    w->tolerance = 1e-9;
    w->exactness = 8; /* the pieces' planes are rounded each for itself */
}

/* Every triangle the other way round: what blocks on both sides has no front. */
void twin_rewound(const trial *t, oracle_random *dice, twin *w)
{
    (void)dice;
    twin_begin(w, t);
    for (uint32_t i = 0; i < w->other.body_count; i++) {
        scene_mesh *m = &w->other.bodies[i].mesh;
        for (uint32_t k = 0; k < m->triangle_count && w->other.bodies[i].desc.type == TAHR_BODY_MESH; k++) {
            uint32_t *c = m->indices + 3 * (size_t)k, second = c[1];
            c[1] = c[2];
            c[2] = second;
        }
    }
    w->in_step = 1;
    w->tolerance = 1e-9;
    w->exactness = 4;
}

void twin_duplicated(const trial *t, oracle_random *dice, twin *w)
{
    twin_begin(w, t);
    for (uint32_t i = 0; i < w->other.body_count; i++) {
        scene_mesh *m = &w->other.bodies[i].mesh;
        uint32_t count = m->triangle_count;
        for (uint32_t k = 0; k < count && w->other.bodies[i].desc.type == TAHR_BODY_MESH; k++) {
            uint32_t c[3], turn = oracle_below(dice, 3);
            memcpy(c, m->indices + 3 * (size_t)k, sizeof c);
            if (draw_one_in(dice, 2)) scene_mesh_triangle(m, c[turn], c[(turn + 1) % 3], c[(turn + 2) % 3]);
        }
    }
}

void twin_far_triangles(const trial *t, oracle_random *dice, twin *w)
{
    twin_begin(w, t);
    for (uint32_t i = 0; i < w->other.body_count; i++) {
        scene_mesh *m = &w->other.bodies[i].mesh;
        for (int k = 0; k < 20 && w->other.bodies[i].desc.type == TAHR_BODY_MESH; k++) {
            uint32_t v[3];
            double x = draw(dice, 60, 900), y = draw(dice, -900, 900), z = draw(dice, -50, 50);
            for (int n = 0; n < 3; n++)
                v[n] = scene_mesh_vertex(m, x + draw(dice, -9, 9), y + draw(dice, -9, 9), z + draw(dice, -9, 9));
            scene_mesh_triangle(m, v[0], v[1], v[2]);
        }
    }
}

/* Both from a gather callback, by the same names, in another order. */
void twin_shuffled(const trial *t, oracle_random *dice, twin *w)
{
    twin_begin(w, t);
    w->with = GATHERED;
    w->without = GATHERED | ORDERED_BY * (1 + oracle_below(dice, 1000));
    w->ready = on_native;
}

void twin_pieces(const trial *t, oracle_random *dice, twin *w)
{
    twin_begin(w, t);
    w->pieces = 2 + oracle_below(dice, 9);
    w->tolerance = 1e-12;
    w->in_step = 1;
}

void twin_shortcuts(const trial *t, oracle_random *dice, twin *w)
{
    twin_begin(w, t);
    w->without = 1 + oracle_below(dice, 31);
}

void twin_again(const trial *t, oracle_random *dice, twin *w)
{
    (void)dice;
    twin_begin(w, t);
}
