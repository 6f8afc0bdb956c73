/* SPDX-License-Identifier: MIT
 * lip.c: the front of a step that is too steep to stand on: bevelled, rounded, or marked as never walkable.
 *
 * What is too steep and no higher than a step, between one floor and another, is a step, whatever its front looks like:
 * a vertical front is climbed, and no front is harder than that. Where a foot touches it depends on how far the foot
 * has come; the two floors do not. They are looked for where the face, if it went on, would leave the height of a step,
 * so that no lip is too wide to look over and a slope that goes on is none, wherever on it the foot is. */
#include "lip.h"

#include "floor.h"
#include "query.h"
#include "report.h"

/* A face as it is seen from the place where it is touched. */
typedef struct face {
    vec3 inward;   /* level, unit: behind it */
    double at;     /* m, height of the contact */
    double spread; /* m across for a metre of height */
} face;

/* Returns 0 if no direction is behind the face. */
static int face_of(const tahr__step *step, const tahr_hit *hit, face *f)
{
    vec3 up = step->state.up;
    vec3 level = step_level(step, hit->surface_normal);
    double steep = length(level), limit = step->limits->walkable;
    f->inward = scale(level, -1);
    if (steep < 1e-3) { /* level itself and never walkable: behind is away from the axis */
        f->inward = step_level(step, sub(hit->point, step->state.position));
        steep = 0;
    }
    f->inward = unit(f->inward);
    f->at = dot(hit->point, up);
    /* Less steep than the limit it is no floor by an override, and no wider lip for that. */
    steep = max_of(steep, sqrt(max_of(1 - limit * limit, 0)));
    f->spread = sqrt(max_of(1 - steep * steep, 0)) / max_of(steep, 1e-3);
    return length_squared(f->inward) > 0;
}

/* How far away a face would have changed its height by `height`; a skin is added against rounding, and a foot spans no
 * more than its width. */
static double reach_of(const tahr__step *step, const face *f, double height)
{
    return min_of(height * f->spread, 2 * step->limits->width) + step->config->skin;
}

/* What lies under the place `across` m behind (before, if negative) the contact, from height `top` down to `bottom`. */
static int look(tahr__step *step, const tahr_hit *hit, vec3 across, double top, double bottom, tahr_hit *found)
{
    vec3 up = step->state.up;
    vec3 from = add(hit->point, across);
    tahr__ray(step, add_scaled(from, up, top - dot(from, up)), scale(up, bottom - top), found);
    return found->blocking && tahr__is_walkable(step, found, 0);
}

/* Lower than the contact, the ray began inside the obstacle, or behind it. */
static int is_above(const tahr__step *step, const face *f, const tahr_hit *tread)
{
    return dot(tread->point, step->state.up) >= f->at - step->config->skin;
}

static int tread_of(tahr__step *step, const tahr_hit *hit, const face *f, double base)
{
    const tahr_config *c = step->config;
    double top = base + c->step_height + TAHR__HEIGHT_ROUNDING, bottom = min_of(base, f->at) - c->skin;
    double near = c->perch_threshold, far = max_of(reach_of(step, f, top - f->at), near);
    tahr_hit tread;
    if (top < f->at) {
        return 0;
    }
    int walkable = look(step, hit, scale(f->inward, far), top, bottom, &tread);
    int found = walkable && is_above(step, f, &tread);
    /* Behind a narrow obstacle, or on the front of the next step: nearer to the contact may be the tread. */
    if (!found && far > near && tread.blocking) {
        walkable = look(step, hit, scale(f->inward, near), top, bottom, &tread);
        found = walkable && is_above(step, f, &tread);
    }
    return found;
}

int tahr__tread_behind(tahr__step *step, const tahr_hit *hit, double base)
{
    face f;
    return face_of(step, hit, &f) && tread_of(step, hit, &f, base);
}

int tahr__is_lip(tahr__step *step, const tahr_hit *hit)
{
    const tahr_config *c = step->config;
    double near = c->perch_threshold; /* as narrow as it may be */
    tahr_hit floor;
    face f;
    if (!hit->blocking || hit->start_overlap || !face_of(step, hit, &f)) {
        return 0;
    }
    double top = f.at + c->skin, bottom = f.at - c->step_height - c->skin;
    double far = reach_of(step, &f, c->step_height);
    int found = look(step, hit, scale(f.inward, -near), top, bottom, &floor);
    if (!found && floor.blocking && far > near) { /* the face goes on that far */
        found = look(step, hit, scale(f.inward, -far), top, bottom, &floor);
    }
    return found && tread_of(step, hit, &f, dot(floor.point, step->state.up));
}
