/* SPDX-License-Identifier: MIT
 * trial.c: building trials. */
#include "trial.h"

#include <math.h>
#include <string.h>

static const double WIDE = 50; /* m, half the depth of an outline drawn out: nobody gets around its ends */

double draw(oracle_random *dice, double low, double high)
{
    return oracle_uniform(dice, low, high);
}

double draw_power(oracle_random *dice, double low, double high)
{
    return pow(10, oracle_uniform(dice, low, high));
}

int draw_one_in(oracle_random *dice, uint32_t n)
{
    return oracle_below(dice, n) == 0;
}

double draw_around(oracle_random *dice, double value, double size)
{
    uint32_t how = oracle_below(dice, 4);
    double off = size * draw_power(dice, -14, -2);
    return how == 0 ? value : how % 2 ? value + off : value - off;
}

void trial_begin(trial *t, uint32_t world, uint32_t preset)
{
    memset(t, 0, sizeof *t);
    t->world = world;
    t->preset = preset;
    t->keeps = KEEPS_ALWAYS;
    t->scale = 1;
    t->grow = 1;
    tahr_config_init(&t->config, sizeof t->config, (int32_t)preset);
    if (world == IN_PLANE) {
        t->config.plane = (tahr_vec3){0, 0, 1};
        t->config.gravity = (tahr_vec3){0, -fabs(t->config.gravity.y + t->config.gravity.z), 0};
    }
}

void trial_free(trial *t)
{
    for (uint32_t i = 0; i < t->body_count; i++)
        scene_mesh_free(&t->bodies[i].mesh);
    t->body_count = 0;
}

static trial_body *add(trial *t, uint32_t type, uint32_t flags)
{
    trial_body *b = &t->bodies[t->body_count < TRIAL_BODIES - 1 ? t->body_count++ : TRIAL_BODIES - 1];
    tahr_body_desc_init(&b->desc, sizeof b->desc, type);
    b->desc.flags = flags;
    b->motion.lasts = HUGE_VAL;
    return b;
}

trial_body *trial_box(trial *t, tahr_vec3 centre, tahr_vec3 half, uint32_t flags)
{
    trial_body *b = add(t, TAHR_BODY_BOX, flags);
    const double low[3] = {-half.x, -half.y, -half.z}, high[3] = {half.x, half.y, half.z};
    b->desc.pose.position = centre;
    b->desc.half_extents = half;
    scene_mesh_box(&b->mesh, low, high);
    return b;
}

trial_body *trial_mesh(trial *t, uint32_t flags)
{
    return add(t, TAHR_BODY_MESH, flags);
}

trial_body *trial_profile(trial *t, const double (*points)[2], int count, uint32_t flags)
{
    trial_body *b = add(t, TAHR_BODY_MESH, flags);
    scene_mesh_profile(&b->mesh, points, count, 2 * WIDE);
    for (int i = 0; i < count && i < TRIAL_OUTLINE; i++, b->outline_count++)
        memcpy(b->outline[i], points[i], sizeof b->outline[i]);
    return b;
}

void trial_room(trial *t, tahr_vec3 low, tahr_vec3 high)
{
    const double c[3] = {(low.x + high.x) / 2, (low.y + high.y) / 2, (low.z + high.z) / 2};
    const double h[3] = {(high.x - low.x) / 2, (high.y - low.y) / 2, (high.z - low.z) / 2};
    for (int k = 0; k < 6; k++) {
        int axis = k / 2;
        double sign = k % 2 ? 1 : -1;
        if (axis == 1 && t->world == IN_PLANE) continue;
        tahr_vec3 centre = {c[0] + sign * (axis == 0 ? h[0] + 0.5 : 0), c[1] + sign * (axis == 1 ? h[1] + 0.5 : 0),
                            c[2] + sign * (axis == 2 ? h[2] + 0.5 : 0)};
        tahr_vec3 half = {axis == 0 ? 0.5 : h[0] + 1, axis == 1 ? 0.5 : h[1] + 1, axis == 2 ? 0.5 : h[2] + 1};
        trial_box(t, centre, half, 0);
    }
    t->room = (tahr_bounds){low, high};
    t->keeps |= KEEPS_INSIDE;
}

double trial_radius(const trial *t)
{
    return t->config.shape.radius;
}

double trial_half(const trial *t)
{
    return t->config.shape.half_height;
}

void trial_stand(trial *t, double x, double y, double gap)
{
    t->start = (tahr_vec3){x, y, trial_half(t) + gap};
}

static trial_step *next(trial *t)
{
    trial_step *s = &t->steps[t->step_count < TRIAL_STEPS - 1 ? t->step_count++ : TRIAL_STEPS - 1];
    memset(s, 0, sizeof *s);
    s->input.struct_size = sizeof s->input;
    s->dt = 1.0 / 60;
    return s;
}

void trial_walk(trial *t, int count, tahr_vec3 move)
{
    for (int i = 0; i < count; i++)
        next(t)->input.move = move;
    t->first_rest = t->step_count;
}

void trial_wander(trial *t, oracle_random *dice, int count, double angle, double spread, uint32_t jumps)
{
    double way = angle, speed = 1;
    for (int i = 0; i < count; i++) {
        if (draw_one_in(dice, 12)) {
            way = angle + draw(dice, -spread, spread);
            speed = draw_one_in(dice, 3) ? draw(dice, 0, 1) : 1;
        }
        trial_step *s = next(t);
        s->input.move = (tahr_vec3){speed * cos(way), speed * sin(way), 0};
        s->input.jump = jumps > 0 && draw_one_in(dice, jumps);
    }
    t->first_rest = t->step_count;
}

void trial_idle(trial *t, int count)
{
    for (int i = 0; i < count; i++)
        next(t);
}

void trial_every(trial *t, double dt)
{
    for (int i = 0; i < t->step_count; i++)
        t->steps[i].dt = dt;
}

static tahr_vec3 turned(tahr_vec3 v)
{
    return (tahr_vec3){v.x, v.z, -v.y};
}

int trial_copy(const trial *from, trial *to)
{
    int good = 1;
    *to = *from;
    for (uint32_t i = 0; i < from->body_count; i++) {
        const scene_mesh *mesh = &from->bodies[i].mesh;
        scene_mesh *copy = &to->bodies[i].mesh;
        memset(copy, 0, sizeof *copy);
        for (uint32_t k = 0; k < mesh->vertex_count; k++) {
            const double *v = mesh->vertices + 3 * (size_t)k;
            scene_mesh_vertex(copy, v[0], v[1], v[2]);
        }
        for (uint32_t k = 0; k < mesh->triangle_count; k++) {
            const uint32_t *corner = mesh->indices + 3 * (size_t)k;
            scene_mesh_triangle(copy, corner[0], corner[1], corner[2]);
        }
        good = good && !copy->failed;
    }
    return good;
}

/* What lies beside the plane altogether is not in it. */
static void leave_out(trial *t)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < t->body_count; i++) {
        trial_body *b = &t->bodies[i];
        int beside = b->desc.type == TAHR_BODY_BOX && fabs(b->desc.pose.position.y) >= b->desc.half_extents.y;
        if (beside)
            scene_mesh_free(&b->mesh);
        else
            t->bodies[kept++] = *b;
    }
    t->body_count = kept;
}

/* z up to y up: a quarter turn about x. What a tape wants out of the plane it does not get. */
static void lay_down(trial *t)
{
    leave_out(t);
    for (uint32_t i = 0; i < t->body_count; i++) {
        trial_body *b = &t->bodies[i];
        tahr_vec3 h = b->desc.half_extents;
        tahr_quat q = b->desc.pose.orientation;
        b->desc.pose.position = turned(b->desc.pose.position);
        b->desc.pose.position.z = 0;
        b->desc.pose.orientation = (tahr_quat){q.x, q.z, -q.y, q.w};
        b->desc.half_extents = (tahr_vec3){h.x, h.z, WIDE};
        for (uint32_t k = 0; k < b->mesh.vertex_count; k++) {
            double *v = b->mesh.vertices + 3 * (size_t)k;
            tahr_vec3 to = turned((tahr_vec3){v[0], v[1], v[2]});
            v[0] = to.x, v[1] = to.y;
            v[2] = to.z > 0 ? WIDE : -WIDE;
        }
        b->motion.drift = turned(b->motion.drift);
        b->motion.swing = turned(b->motion.swing);
        b->motion.axis = turned(b->motion.axis);
        b->motion.hop = turned(b->motion.hop);
        b->motion.drift.z = b->motion.swing.z = b->motion.hop.z = 0;
    }
    t->start = turned(t->start);
    t->velocity = turned(t->velocity);
    t->start.z = t->velocity.z = 0;
    t->room.min = turned(t->room.min);
    t->room.max = turned(t->room.max);
    t->room.min.z = -1;
    t->room.max.z = 1;
    for (int i = 0; i < t->step_count; i++) {
        t->steps[i].input.move = turned(t->steps[i].input.move);
        t->steps[i].input.move.z = 0;
    }
}

static tahr_vec3 times(tahr_vec3 v, double s)
{
    return (tahr_vec3){v.x * s, v.y * s, v.z * s};
}

static tahr_vec3 plus(tahr_vec3 a, tahr_vec3 b)
{
    return (tahr_vec3){a.x + b.x, a.y + b.y, a.z + b.z};
}

void trial_grow(trial *t, double s)
{
    if (tahr_config_scale(&t->config, s) < 0) return;
    for (uint32_t i = 0; i < t->body_count; i++) {
        trial_body *b = &t->bodies[i];
        b->desc.pose.position = times(b->desc.pose.position, s);
        b->desc.half_extents = times(b->desc.half_extents, s);
        for (uint32_t k = 0; k < 3 * b->mesh.vertex_count; k++)
            b->mesh.vertices[k] *= s;
        for (int k = 0; k < b->outline_count; k++)
            b->outline[k][0] *= s, b->outline[k][1] *= s;
        b->motion.drift = times(b->motion.drift, s);
        b->motion.swing = times(b->motion.swing, s);
        b->motion.hop = times(b->motion.hop, s);
    }
    t->start = times(t->start, s);
    t->velocity = times(t->velocity, s);
    t->room.min = times(t->room.min, s);
    t->room.max = times(t->room.max, s);
    t->scale *= s;
}

void trial_shift(trial *t, tahr_vec3 by)
{
    for (uint32_t i = 0; i < t->body_count; i++)
        t->bodies[i].desc.pose.position = plus(t->bodies[i].desc.pose.position, by);
    t->start = plus(t->start, by);
    t->room.min = plus(t->room.min, by);
    t->room.max = plus(t->room.max, by);
    double far = fabs(by.x) + fabs(by.y) + fabs(by.z);
    t->rounding += 8 * 2.220446049250313e-16 * far; /* a step adds a handful of times to what is as large as that */
}

void trial_finish(trial *t)
{
    if (t->world == IN_PLANE) lay_down(t);
    if (t->grow != 1) trial_grow(t, t->grow);
    tahr_vec3 by = t->world == IN_PLANE ? (tahr_vec3){t->shift.x, t->shift.z, 0} : t->shift;
    if (by.x != 0 || by.y != 0 || by.z != 0) trial_shift(t, by);
}

tahr_pose trial_pose(const trial_body *body, double time, int steps)
{
    const trial_motion *m = &body->motion;
    tahr_pose pose = body->desc.pose;
    double now = time < m->lasts ? time : m->lasts, wave = sin(m->rate * now + m->phase) - sin(m->phase);
    int hops = m->teleports > 0 ? steps / m->teleports % 2 : 0;
    pose.position.x += m->drift.x * now + m->swing.x * wave + hops * m->hop.x;
    pose.position.y += m->drift.y * now + m->swing.y * wave + hops * m->hop.y;
    pose.position.z += m->drift.z * now + m->swing.z * wave + hops * m->hop.z;
    if (m->spin != 0) {
        tahr_quat p = pose.orientation;
        double s = sin(m->spin * now / 2), w = cos(m->spin * now / 2);
        double x = m->axis.x * s, y = m->axis.y * s, z = m->axis.z * s;
        pose.orientation = (tahr_quat){w * p.x + x * p.w + y * p.z - z * p.y, w * p.y - x * p.z + y * p.w + z * p.x,
                                       w * p.z + x * p.y - y * p.x + z * p.w, w * p.w - x * p.x - y * p.y - z * p.z};
    }
    return pose;
}
