/* SPDX-License-Identifier: MIT
 * floor.c: walkable test, find floor, height adjustment. Beside it: floor_distance.c (edge tolerance, floor sweep test,
 * floor distance), perch.c, wedge.c, foot.c.
 *
 * Two ways to look, config.floor_probe. WHOLE sweeps the shape with its skin: one sweep tells all there is to know of a
 * shape that is kept a skin away from everything. SHRUNK sweeps a shorter shape without a skin, and then doubts. */
#include "floor.h"

#include "elementary.h"
#include "floor_distance.h"
#include "foot.h"
#include "perch.h"
#include "plane.h"
#include "report.h"
#include "rim.h"
#include "shape.h"

/* Faces this close to vertical are never a floor, whatever an override says. */
static const double VERTICAL = 1e-4;

static double cosine(double angle)
{
    double s, c;
    tahr__sincos(clamp(angle, 0, 1.5707963267948966), &s, &c);
    return c;
}

double tahr__walkable_limit(const tahr__step *step, const tahr_hit *hit, int was_walkable)
{
    double limit = was_walkable ? step->limits->walkable_hysteresis : step->limits->walkable;
    if (hit->walkable_rule == TAHR_WALKABLE_INCREASE) {
        limit = min_of(limit, cosine(hit->walkable_angle));
    } else if (hit->walkable_rule == TAHR_WALKABLE_DECREASE) {
        limit = max_of(limit, cosine(hit->walkable_angle));
    }
    return max_of(limit, VERTICAL);
}

int tahr__is_walkable(tahr__step *step, const tahr_hit *hit, int was_walkable)
{
    double limit = tahr__walkable_limit(step, hit, was_walkable);
    double up = dot(hit->surface_normal, step->state.up);
    int walkable = hit->blocking && !hit->start_overlap && hit->walkable_rule != TAHR_WALKABLE_NEVER;
    return tahr__decide(step, TAHR_RULE_WALKABLE, walkable && up >= limit, hit, up, limit,
                        "cosine of the face's slope");
}

int tahr__was_walkable(const tahr__step *step, const tahr_hit *hit)
{
    const tahr_floor *old = &step->state.floor;
    return step->state.mode == TAHR_MODE_WALKING && floor_is_walkable(old) && (old->flags & TAHR_FLOOR_FACE) &&
           floor_is_same_face(old, hit);
}

static void fill(tahr_floor *floor, const tahr_hit *hit, double distance, uint32_t flags)
{
    floor->normal = hit->normal;
    floor->surface_normal = hit->surface_normal;
    floor->point = hit->point;
    floor->distance = distance;
    floor->perch_distance = 0;
    floor->flags = flags;
    floor->body = hit->body;
    floor->feature = hit->feature;
    floor->surface = hit->surface;
}

static int wedge(tahr__step *step, tahr_floor *floor)
{
    double band = step->config->floor_max * step->config->skin;
    if (floor->distance > band || !tahr__is_wedged(step)) {
        return 0;
    }
    floor->flags |= TAHR_FLOOR_WEDGED;
    return 1;
}

/* May an edge of something walkable, at the rim of the foot, be a side of a wedge, as in a gap that is too narrow to
 * fall through? To who falls into it, and for as long as it holds him; who walks over an edge walks off it. */
static int comes_to_rest(const tahr__step *step)
{
    return step->state.mode == TAHR_MODE_FALLING || (step->state.floor.flags & TAHR_FLOOR_WEDGED);
}

/* [in,out] hit: of the whole foot; a thinner one may have to look again. */
static void judge_whole(tahr__step *step, double reach, tahr_hit *hit, tahr_floor *floor)
{
    const tahr_config *c = step->config;
    double range = foot_range(c, reach);
    uint32_t flags = TAHR_FLOOR_BLOCKING;
    double inside = hit->blocking ? inside_rim(step, step->state.position, hit->point) : 0;
    if (hit->blocking && !hit->start_overlap && inside < c->edge_tolerance) {
        tahr__decide(step, TAHR_RULE_EDGE_TOLERANCE, 0, hit, inside, c->edge_tolerance, "touches the rim");
        tahr__foot inner = tahr__thinner_foot(step, 2 * c->edge_tolerance);
        foot_sweep(step, &inner, range, hit);
        inside = hit->blocking ? inside_rim(step, step->state.position, hit->point) : 0;
        flags |= TAHR_FLOOR_RIM;
    }
    if (!hit->blocking || step->error < 0) {
        *floor = (tahr_floor){.distance = range + c->skin, .body = TAHR_NO_BODY};
        tahr__decide(step, TAHR_RULE_FLOOR, 0, NULL, floor->distance, range, "nothing below");
        return;
    }
    /* Out of no floor by more than its own height: what says deeper is wrong, or a push is called for. */
    double deep = max_of(-hit->depth, -2 * step->limits->shape.half_height);
    fill(floor, hit, hit->start_overlap ? deep : foot_clearance(step, hit, range),
         flags | floor_still_slope(&step->state.floor, hit));
    int surface = tahr__is_walkable(step, hit, tahr__was_walkable(step, hit));
    floor->flags |= surface ? TAHR_FLOOR_FACE : 0u;
    /* On the inside of a face the contact is the foot's own, however far out a slope puts it: no perching there. */
    int on_face = dot(hit->normal, hit->surface_normal) > TAHR__ON_FACE;
    int rim = inside < c->perch_threshold + c->skin;
    int ok = surface && (on_face || !rim);
    if (!ok && rim && !hit->start_overlap) {
        ok = tahr__perches(step, reach, hit, floor);
    }
    if (!ok && !surface && !rim) {
        ok = tahr__holds_on_lip(step, hit);
    }
    if (!ok && (!surface || comes_to_rest(step))) {
        ok = wedge(step, floor);
    }
    floor->flags |= ok ? TAHR_FLOOR_WALKABLE : 0u;
    tahr__decide(step, TAHR_RULE_FLOOR, ok, hit, floor->distance, range, "floor distance");
}

static void find_whole(tahr__step *step, double reach, const tahr_hit *supplied, tahr_floor *floor)
{
    tahr_hit hit;
    if (supplied) {
        hit = *supplied;
        hit.fraction = 0; /* it ended here */
    } else {
        foot_sweep(step, &step->limits->foot, foot_range(step->config, reach), &hit);
    }
    judge_whole(step, reach, &hit, floor);
}

void tahr__find_floor_met(tahr__step *step, double reach, const tahr_hit *met, tahr_floor *floor)
{
    tahr_hit hit = *met;
    judge_whole(step, reach, &hit, floor);
}

/* The field's dynamic base. Of a body that the core was not told of it is enough that bodies of its world move. */
static int may_move(const tahr_world *world, uint32_t body)
{
    if (world->bodies && body < world->body_count) {
        return (world->bodies[body].flags & TAHR_BODY_MOVABLE) != 0;
    }
    return body == TAHR_NO_BODY || (world->has & TAHR__HAS_BASES) != 0;
}

/* bAlwaysCheckFloor and bForceNextFloorCheck: nothing moved since the floor was looked for, nor was the height put
 * right. What a look answers depends on the place, the world and what the floor was alone; so it would find the same
 * floor again, which as one that was walkable has only become easier to stay on. */
static int takes_cached_floor(tahr__step *step)
{
    const tahr_state *s = &step->state;
    if (!step->config->cached_floor || s->mode != TAHR_MODE_WALKING || step->just_teleported ||
        (s->flags & TAHR_STATE_FLOOR_MOVED) || !floor_is_walkable(&s->floor) || !floor_is_current(step) ||
        may_move(step->world, s->floor.body)) {
        return 0;
    }
    step->report.flags |= TAHR_REPORT_CACHED_FLOOR;
    step->report.saved[TAHR_SHORTCUT_CACHED_FLOOR]++;
    return tahr__decide(step, TAHR_RULE_CACHED_FLOOR, 1, NULL, 0, 0, "neither the character nor the world moved");
}

/* What touches the shape at its rim counts only with a floor further in. A floor deep under a perch keeps its distance,
 * rather than lose the perch by rising; a face too steep gives way to the floor that was found. */
static void doubt_rim(tahr__step *step, double deepest, tahr_floor *floor)
{
    const tahr_config *c = step->config;
    double target = c->floor_target * c->skin;
    tahr_floor inner;
    tahr__perch_look look = {.radius = tahr__valid_perch_radius(step),
                             .point = floor->point,
                             .location = add_scaled(step->state.position, step->state.up, -floor->distance),
                             .deepest = deepest};
    if (!tahr__should_compute_perch(step, floor, look.location, 1)) {
        return;
    }
    if (!tahr__compute_perch(step, &look, &inner)) {
        floor->flags &= ~(uint32_t)TAHR_FLOOR_WALKABLE;
        return;
    }
    double below = inner.distance + floor->distance; /* from here, not from the contact */
    if (target - floor->distance + inner.distance >= deepest) {
        floor->distance = target;
    }
    if (floor_is_walkable(floor)) {
        floor->flags |= TAHR_FLOOR_PERCHING;
        floor->perch_distance = below;
        return;
    }
    double distance = floor->distance;
    uint32_t rim = floor->flags & TAHR_FLOOR_RIM;
    *floor = inner;
    floor->flags = TAHR_FLOOR_BLOCKING | TAHR_FLOOR_WALKABLE | TAHR_FLOOR_LINE | rim;
    floor->distance = distance;
    floor->perch_distance = max_of(distance, c->skin);
}

static void find_shrunk(tahr__step *step, double reach, const tahr__supplied *supplied, tahr_floor *floor)
{
    const tahr_config *c = step->config;
    if (takes_cached_floor(step)) {
        *floor = step->state.floor;
        return;
    }
    int walking = step->state.mode == TAHR_MODE_WALKING;
    double highest = c->floor_max * c->skin;
    double distance = max_of(highest, reach + (walking ? highest + tiny_length(c) : -highest));
    tahr__floor_look look = {.from = step->state.position,
                             .line_distance = distance,
                             .sweep_distance = distance,
                             .radius = step->limits->width,
                             .supplied = supplied};
    tahr__compute_floor_distance(step, &look, floor);
    doubt_rim(step, distance + (walking ? c->perch_extra : 0), floor); /* what a ray found lies under the axis: no
                                                                        * doubt */
    int steep = (floor->flags & TAHR_FLOOR_BLOCKING) && !(floor->flags & TAHR_FLOOR_FACE);
    if (steep && !floor_is_walkable(floor) && c->slide_solver == TAHR_SLIDE_JOINT && wedge(step, floor)) {
        floor->flags |= TAHR_FLOOR_WALKABLE; /* for a solver that comes to rest between walls */
    }
    tahr__decide(step, TAHR_RULE_FLOOR, floor_is_walkable(floor), NULL, floor->distance, distance,
                 floor->flags & TAHR_FLOOR_BLOCKING ? "floor distance" : "nothing below");
}

void tahr__find_floor(tahr__step *step, double reach, const tahr__supplied *supplied, tahr_floor *floor)
{
    if (step->config->floor_probe == TAHR_FLOOR_PROBE_SHRUNK) {
        find_shrunk(step, reach, supplied, floor);
    } else {
        find_whole(step, reach, supplied ? supplied->hit : NULL, floor);
    }
}

/* The floor goes with the character, so that the next move starts from it; a character that stands looks again. */
static void shift_floor(tahr__step *step, double height)
{
    step->state.floor.distance += height;
    step->state.floor.perch_distance += step->state.floor.flags & (TAHR_FLOOR_PERCHING | TAHR_FLOOR_LINE) ? height : 0;
    step->state.floor_position = step->state.position;
    step->state.flags |= TAHR_STATE_FLOOR_MOVED;
}

/* A floor found by a ray lies deeper than what the sweep met; above that the character rises off what it met only. No
 * rounding of a backend moves a character. Returns 1 and the clearance to put right. */
static int is_off_height(const tahr__step *step, double *gap)
{
    const tahr_floor *floor = &step->state.floor;
    double lowest = step->config->skin, highest = step->config->floor_max * lowest, tiny = tiny_length(step->config);
    *gap = floor->distance;
    if (floor->flags & TAHR_FLOOR_LINE) {
        if (*gap < lowest && floor->perch_distance >= lowest) {
            return 0; /* else it would climb the wall that it met */
        }
        *gap = floor->perch_distance;
    }
    return floor_is_walkable(floor) && (*gap < lowest - tiny || *gap > highest + tiny);
}

/* Out of the floor by this motion alone: a push out first would be added to it, and make the character hop. */
static void rise_out(tahr__step *step, vec3 motion, tahr__swept *swept)
{
    tahr__move_updated(step, motion, TAHR_SWEEP_LEAVE_OVERLAP, swept);
    if (!swept->hit.start_overlap) {
        return;
    }
    int joint = step->config->depenetration == TAHR_DEPENETRATION_JOINT;
    if (joint ? tahr__depenetrate(step)
              : tahr__resolve_penetration(step, tahr__penetration_adjustment(step, &swept->hit), swept)) {
        tahr__move_updated(step, motion, TAHR_SWEEP_LEAVE_OVERLAP, swept);
    }
}

static double adjust_shrunk(tahr__step *step)
{
    const tahr_config *c = step->config;
    vec3 up = step->state.up, before = step->state.position;
    tahr__swept swept;
    double gap;
    if (!is_off_height(step, &gap)) {
        return 0;
    }
    double asked = c->floor_target * c->skin - gap;
    vec3 motion = scale(up, asked);
    if (gap < 0) {
        rise_out(step, motion, &swept);
    } else {
        tahr__safe_move(step, motion, &swept);
    }
    const tahr_hit *hit = &swept.hit;
    double height = dot(sub(step->state.position, before), up);
    shift_floor(step, height);
    if (asked < 0 && is_blocked(hit)) {
        double distance = dot(sub(step->state.position, swept.location), up);
        if (tahr__is_walkable(step, hit, tahr__was_walkable(step, hit))) {
            fill(&step->state.floor, hit, distance, TAHR_FLOOR_BLOCKING | TAHR_FLOOR_WALKABLE | TAHR_FLOOR_FACE);
        }
        step->state.floor.distance = distance;
    }
    step->just_teleported |= !c->keep_level_speed || gap < 0;
    tahr__decide(step, TAHR_RULE_FLOOR_HEIGHT, 1, NULL, gap, c->floor_max * c->skin, "clearance outside the band");
    return height;
}

static double adjust_whole(tahr__step *step)
{
    const tahr_config *c = step->config;
    const tahr_floor *floor = &step->state.floor;
    double target = c->floor_target * c->skin;
    double gap = floor->distance;
    if (!floor_is_walkable(floor) || floor_is_in_band(step) || !may_rise(step)) {
        return 0;
    }
    vec3 before = step->state.position;
    tahr_hit hit;
    vec3 motion = scale(step->state.up, target - gap);
    int proven = !(step->state.flags & TAHR_STATE_FLOOR_MOVED) && !(floor->flags & TAHR_FLOOR_RIM);
    if (gap > target && proven) {
        step->state.position = add(step->state.position, motion); /* the floor sweep went farther */
    } else {
        tahr__move(step, motion, &hit);
    }
    double height = dot(sub(step->state.position, before), step->state.up);
    tahr__decide(step, TAHR_RULE_FLOOR_HEIGHT, 1, NULL, gap, c->floor_max * c->skin, "clearance outside the band");
    shift_floor(step, height);
    return height;
}

double tahr__adjust_height(tahr__step *step)
{
    return step->config->floor_probe == TAHR_FLOOR_PROBE_SHRUNK ? adjust_shrunk(step) : adjust_whole(step);
}
