/* SPDX-License-Identifier: MIT
 * judge.c: see judge.h. Bodies are looked at in their own frames, so that what moves costs no more. */
#include "judge.h"

#include "scene_solid.h"

#include <math.h>
#include <stdlib.h>

/* Bodies that never block, or not from everywhere, have neither: their families look at them. */
struct judge {
    const trial *trial;
    scene_solid *near[TRIAL_BODIES];    /* for distances: of a solid both sides of its faces */
    scene_solid *through[TRIAL_BODIES]; /* for ways: of a solid the way in alone */
};

static int blocks(const trial_body *b)
{
    return !(b->desc.flags & (TAHR_BODY_SENSOR | TAHR_BODY_FLUID | TAHR_BODY_ONE_WAY));
}

static int is_solid(const trial_body *b)
{
    return b->desc.type == TAHR_BODY_BOX || b->desc.type == TAHR_BODY_HULL;
}

judge *judge_open(const trial *t)
{
    judge *j = calloc(1, sizeof *j);
    int good = j != NULL;
    if (j) j->trial = t;
    for (uint32_t i = 0; good && i < t->body_count; i++) {
        const trial_body *b = &t->bodies[i];
        int both = (b->desc.flags & TAHR_BODY_TWO_SIDED) != 0;
        if (!blocks(b)) continue;
        j->near[i] = scene_solid_open(&b->mesh, both || is_solid(b));
        j->through[i] = scene_solid_open(&b->mesh, both);
        good = j->near[i] && j->through[i];
    }
    if (!good) {
        judge_close(j);
        return NULL;
    }
    return j;
}

void judge_close(judge *j)
{
    for (uint32_t i = 0; j && i < TRIAL_BODIES; i++) {
        scene_solid_close(j->near[i]);
        scene_solid_close(j->through[i]);
    }
    free(j);
}

/* Turned by the inverse of q. */
static tahr_vec3 unturned(tahr_quat q, tahr_vec3 v)
{
    double x = -q.x, y = -q.y, z = -q.z;
    double tx = 2 * (y * v.z - z * v.y), ty = 2 * (z * v.x - x * v.z), tz = 2 * (x * v.y - y * v.x);
    return (tahr_vec3){v.x + q.w * tx + y * tz - z * ty, v.y + q.w * ty + z * tx - x * tz,
                       v.z + q.w * tz + x * ty - y * tx};
}

static tahr_vec3 local(const tahr_pose *pose, tahr_vec3 p)
{
    tahr_vec3 d = {p.x - pose->position.x, p.y - pose->position.y, p.z - pose->position.z};
    return unturned(pose->orientation, d);
}

/* The axis of a state's capsule, from its lower end to its upper one, as body `pose` sees it. */
static void axis_of(const tahr_pose *pose, const tahr_state *s, tahr_vec3 ends[2])
{
    tahr_vec3 middle = local(pose, s->position), up = unturned(pose->orientation, s->up);
    double reach = s->half_height - s->radius;
    ends[0] = (tahr_vec3){middle.x - reach * up.x, middle.y - reach * up.y, middle.z - reach * up.z};
    ends[1] = (tahr_vec3){middle.x + reach * up.x, middle.y + reach * up.y, middle.z + reach * up.z};
}

/* A box holds all of the axis: it is as deep as can be told. */
static int swallowed(const trial_body *b, const tahr_vec3 ends[2])
{
    tahr_vec3 h = b->desc.half_extents;
    int in = b->desc.type == TAHR_BODY_BOX;
    for (int i = 0; i < 2; i++)
        in = in && fabs(ends[i].x) < h.x && fabs(ends[i].y) < h.y && fabs(ends[i].z) < h.z;
    return in;
}

/* Who is a box, along the axes like all bodies of its trials: to one of them. m; below 0 as deep as it would have to be
 * moved. */
static double gap_of_boxes(const trial *t, const tahr_pose *pose, const tahr_state *s, uint32_t body)
{
    const tahr_shape *shape = &t->config.shape;
    const tahr_vec3 h = t->bodies[body].desc.half_extents, p = s->position;
    const double y = t->world == IN_PLANE ? s->half_height : shape->half_y;
    const double z = t->world == IN_PLANE ? 0 : s->half_height;
    const double d[3] = {fabs(p.x - pose->position.x) - h.x - shape->half_x, fabs(p.y - pose->position.y) - h.y - y,
                         fabs(p.z - pose->position.z) - h.z - z};
    const double most = fmax(d[0], fmax(d[1], d[2]));
    return most < 0 ? most : sqrt(pow(fmax(d[0], 0), 2) + pow(fmax(d[1], 0), 2) + pow(fmax(d[2], 0), 2));
}

double judge_gap(const judge *j, const tahr_pose *poses, const tahr_state *state, double limit, uint32_t *body)
{
    double best = limit;
    for (uint32_t i = 0; i < j->trial->body_count; i++) {
        tahr_vec3 ends[2];
        if (!j->near[i]) continue;
        if (j->trial->config.shape.type == TAHR_SHAPE_BOX) {
            const double d = gap_of_boxes(j->trial, &poses[i], state, i);
            if (d < best && body) *body = i;
            best = fmin(best, d);
            continue;
        }
        axis_of(&poses[i], state, ends);
        double gap = scene_solid_distance(j->near[i], ends[0], ends[1], best + state->radius, NULL) - state->radius;
        if (swallowed(&j->trial->bodies[i], (const tahr_vec3 *)ends)) gap = -state->radius;
        if (gap < best) {
            best = gap;
            if (body) *body = i;
        }
    }
    return best;
}

double judge_gap_again(const judge *j, const tahr_pose *poses, const tahr_state *state, uint32_t body)
{
    const trial_body *b = &j->trial->bodies[body];
    const double still[3] = {0, 0, 0};
    tahr_vec3 ends[2];
    if (j->trial->config.shape.type == TAHR_SHAPE_BOX) return gap_of_boxes(j->trial, &poses[body], state, body);
    axis_of(&poses[body], state, ends);
    oracle_core core = {
        .axis_count = 1,
        .centre = {(ends[0].x + ends[1].x) / 2, (ends[0].y + ends[1].y) / 2, (ends[0].z + ends[1].z) / 2},
        .axis = {{(ends[1].x - ends[0].x) / 2, (ends[1].y - ends[0].y) / 2, (ends[1].z - ends[0].z) / 2}}};
    if (swallowed(b, (const tahr_vec3 *)ends)) return -state->radius;
    long double best = 1e30L;
    int both = (b->desc.flags & TAHR_BODY_TWO_SIDED) != 0 || is_solid(b);
    for (uint32_t i = 0; i < b->mesh.triangle_count; i++) {
        double corner[3][3], normal[3], side = 0;
        for (int k = 0; k < 3; k++) {
            for (int c = 0; c < 3; c++)
                corner[k][c] = b->mesh.vertices[3 * (size_t)b->mesh.indices[3 * i + (uint32_t)k] + (size_t)c];
        }
        for (int c = 0; c < 3; c++) {
            int p = (c + 1) % 3, q = (c + 2) % 3;
            normal[c] = (corner[1][p] - corner[0][p]) * (corner[2][q] - corner[0][q]) -
                        (corner[1][q] - corner[0][q]) * (corner[2][p] - corner[0][p]);
        }
        for (int c = 0; c < 3; c++)
            side += normal[c] * (core.centre[c] - corner[0][c]);
        if (!both && !(side > 0)) continue;
        long double d = oracle_distance(&core, still, 0, corner);
        best = d < best ? d : best;
    }
    return (double)(best - (long double)state->radius);
}

int judge_crossed(const judge *j, uint32_t body, const tahr_pose *before, const tahr_pose *now, tahr_vec3 from,
                  tahr_vec3 to)
{
    if (!j->through[body]) return 0;
    return scene_solid_crossed(j->through[body], local(before, from), local(now, to), NULL);
}
