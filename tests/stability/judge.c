/* SPDX-License-Identifier: MIT
 * judge.c: see judge.h. Bodies are looked at in their own frames, so that what moves costs no more. */
#include "judge.h"

#include "scene_solid.h"

#include <math.h>
#include <stdlib.h>

struct judge {
    const trial *trial;
    scene_solid *near[TRIAL_BODIES];    /* for distances: of a box both sides of its faces */
    scene_solid *through[TRIAL_BODIES]; /* for ways: of a box the way in alone */
};

judge *judge_open(const trial *t)
{
    judge *j = calloc(1, sizeof *j);
    int good = j != NULL;
    if (j) j->trial = t;
    for (uint32_t i = 0; good && i < t->body_count; i++) {
        const trial_body *b = &t->bodies[i];
        int both = (b->desc.flags & TAHR_BODY_TWO_SIDED) != 0;
        j->near[i] = scene_solid_open(&b->mesh, both || b->desc.type == TAHR_BODY_BOX);
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

double judge_gap(const judge *j, const tahr_pose *poses, const tahr_state *state, double limit, uint32_t *body)
{
    double best = limit;
    for (uint32_t i = 0; i < j->trial->body_count; i++) {
        tahr_vec3 ends[2];
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
    axis_of(&poses[body], state, ends);
    oracle_core core = {
        .axis_count = 1,
        .centre = {(ends[0].x + ends[1].x) / 2, (ends[0].y + ends[1].y) / 2, (ends[0].z + ends[1].z) / 2},
        .axis = {{(ends[1].x - ends[0].x) / 2, (ends[1].y - ends[0].y) / 2, (ends[1].z - ends[0].z) / 2}}};
    if (swallowed(b, (const tahr_vec3 *)ends)) return -state->radius;
    long double best = 1e30L;
    int both = (b->desc.flags & TAHR_BODY_TWO_SIDED) != 0 || b->desc.type == TAHR_BODY_BOX;
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
    return scene_solid_crossed(j->through[body], local(before, from), local(now, to), NULL);
}
