/* SPDX-License-Identifier: MIT
 * path.c: the path of one slice of walking: closed-form pieces, bent by walls, lifted onto ramps and steps. */
#include "path.h"

#include "drop.h"
#include "floor.h"
#include "launch.h"
#include "move.h"
#include "move_along_floor.h"
#include "nearby.h"
#include "onward.h"
#include "plane.h"
#include "query.h"
#include "scope.h"
#include "report.h"
#include "slide.h"
#include "step_up.h"
#include "stepped.h"

/* The velocity asked for, and how it is approached. Along walls what they leave of it is asked for: pushing slantwise
 * into a wall is walking along it at the wish's part along it, at every rate. */
static inline tahr__law law_along(const tahr__step *step, const tahr__plane *walls, uint32_t count)
{
    const tahr_config *c = step->config;
    if (c->integrator == TAHR_INTEGRATOR_STEPPED) { /* the slice began with its velocity */
        return tahr__constant_law();
    }
    vec3 wish = step_level(step, step->input->move);
    double size = length(wish);
    double asked = step->limits->speed * min_of(size, 1);
    double kept = 1; /* cosine to the wall: of the speed and of the acceleration */
    if (count > 0 && size > 0) {
        wish = tahr__bend(walls, count, wish);
        kept = length(wish) / size;
        size *= kept;
    }
    return tahr__law_of_wish(c, &step->limits->decay, wish, size, asked, kept);
}

/* Ramps are not merged as walls are: two faces that differ by a hair both carry, and the steeper one decides. */
static void carry(tahr__path *w, vec3 normal)
{
    w->ramps[w->ramp_count++] = normal;
}

void tahr__path_carry_floor(tahr__path *w, const tahr__step *step)
{
    const tahr_floor *floor = &step->state.floor;
    w->ramp_count = 0;
    if (floor_is_walkable(floor) && (floor->flags & TAHR_FLOOR_FACE)) {
        carry(w, floor->surface_normal);
        /* The edge of a one-way body (a crest, a platform's end) stops nothing that does not come down on it: the foot
         * rolls over it by itself. */
        if (dot(floor->normal, floor->surface_normal) < 1 - 1e-6 && tahr__is_one_way(step, floor->body)) {
            carry(w, floor->normal);
        }
    }
}

/* Begins a piece with the velocity that the walls leave. */
static inline void begin_piece(tahr__step *step, tahr__path *w, vec3 velocity, double duration)
{
    w->law = law_along(step, w->walls, w->wall_count);
    w->velocity = tahr__slide(w->walls, w->wall_count, velocity);
    w->duration = duration;
    w->rest = 0;
    tahr__motion m = tahr__law_advance(&w->law, w->velocity, duration);
    w->wish = m.displacement;
    w->left = w->left_before = 1;
    w->stop_time = m.stop_time >= 0 ? w->began + m.stop_time : -1;
    w->from = step->state.position;
    step->state.velocity = m.velocity;
    if (step->input->flags & TAHR_INPUT_DRIVE) {
        tahr__drive_piece(step, w);
    }
}

/* The plane arrays are left as they are: only what is counted is read. */
void tahr__path_begin(tahr__step *step, tahr__path *w, double duration)
{
    w->began = 0;
    w->wall_count = 0;
    w->turns = 0;
    w->careful = 0;
    w->lowered = 0;
    w->ease = 0;
    w->drifts = 0;
    w->start = step->state.position;
    w->chord = 0;
    w->chords = 0;
    w->knows_below = 0;
    tahr__around_begin(&w->around);
    tahr__path_carry_floor(w, step);
    w->slope = w->ramp_count ? w->ramps[0] : step->state.up;
    begin_piece(step, w, step_level(step, step->state.velocity), duration);
}

/* s of the piece at which a part of its displacement is covered. */
static double time_of_part(const tahr__path *w, double part)
{
    const double touched = 1e-5; /* m: a thousandth of the skin, above the sweep error of every exact backend */
    double size2 = length_squared(w->wish);
    if (part <= 0 || part >= 1 || size2 == 0) {
        return part <= 0 ? 0 : w->duration;
    }
    if (w->around.turns && w->around.reach > 0) {
        return tahr__around_time(&w->around, w->duration, part);
    }
    if (w->drifts) {
        return tahr__drift_time(&w->law, w->velocity, w->drift, w->duration, w->wish, part);
    }
    if (dot(w->velocity, w->wish) < 0 && part * part * size2 <= touched * touched) {
        return 0; /* turns round first, and passes here again later: what is met at once was touched at the begin */
    }
    return tahr__law_time(&w->law, w->velocity, w->duration, w->wish, part);
}

double tahr__path_used(const tahr__path *w)
{
    return time_of_part(w, 1 - w->left);
}

/* Ends the piece after `used` seconds, with the velocity then, and begins the next. */
static void end_piece(tahr__step *step, tahr__path *w, double used, vec3 velocity)
{
    w->began += used;
    begin_piece(step, w, velocity, w->duration + w->rest - used);
}

/* The piece, just begun, is only the first of the slice: so many seconds of it. */
static void cut_piece(tahr__step *step, tahr__path *w, double time)
{
    tahr__motion m = tahr__law_advance(&w->law, w->velocity, time);
    w->rest += w->duration - time;
    w->duration = time;
    w->wish = m.displacement;
    step->state.velocity = m.velocity;
    w->stop_time = m.stop_time >= 0 ? w->began + m.stop_time : -1;
}

/* Who is too fast to be held by what it pushes with leaves an edge along the curve of its law, and the curve leaves the
 * edge, but not its chord, which would meet it again. The two tangents at its ends do: half of the way along the plane,
 * then to where the curve ends; no further off it than path_tolerance. */
static void fly_off(tahr__step *step, tahr__path *w, const tahr__law *open)
{
    tahr__around *a = &w->around;
    vec3 d = tahr__law_advance(open, w->velocity, w->duration).displacement;
    double off = -dot(a->normal, d), sagitta = 0.25 * off / step->config->path_tolerance;
    if (w->wall_count != 1 || off <= 0) {
        return;
    }
    double time = w->duration / (1 + (int)sqrt(min_of(sagitta, 1e4)));
    d = tahr__law_advance(open, w->velocity, time).displacement;
    vec3 along = scale(tahr__slide(w->walls, 1, d), 0.5);
    w->wall_count = 0;
    w->law = *open;
    cut_piece(step, w, 0.5 * time);
    w->wish = along;
    a->aside = sub(d, along);
    a->leaves = a->is_over = 1;
    a->done++;
    step->report.arcs++;
}

/* Around something that was met the piece, just begun, ends where the wall is turned. */
static void go_around(tahr__step *step, tahr__path *w)
{
    tahr__around *a = &w->around;
    double time = w->duration;
    int held = a->is_round || a->turns;
    if (w->drifts || !held) {
        tahr__around_leave(a);
    } else if (is_driven(step)) {
        tahr__around_drive(step, a, step_level(step, step->input->drive), w->velocity, time);
        w->duration = tahr__around_piece(a, time);
        w->rest = time - w->duration;
        w->wish = tahr__around_way(a, w->velocity, w->duration);
    } else {
        const tahr__law open = law_along(step, NULL, 0);
        vec3 freely = tahr__law_advance(&open, w->velocity, TAHR__GLIMPSE * time).displacement;
        double longest = tahr__around_longest(&open, length(w->velocity), time);
        if (tahr__around_start(step, a, &(tahr__ahead){w->velocity, w->wish, freely, longest, time})) {
            w->velocity = tahr__around_hold(a, unit(step_level(step, a->normal)), w->velocity);
            cut_piece(step, w, tahr__around_piece(a, time));
        } else {
            fly_off(step, w, &open);
        }
    }
}

/* The piece is gone along; another one follows. */
static void turn(tahr__step *step, tahr__path *w)
{
    tahr__plane wall;
    tahr__around *a = &w->around;
    vec3 velocity = step->state.velocity;
    if (a->leaves) {
        double time = w->duration;
        end_piece(step, w, time, velocity);
        cut_piece(step, w, min_of(time, w->duration));
        w->wish = a->aside;
        tahr__around_leave(a);
        return;
    }
    if (w->chord > 0) {
        end_piece(step, w, w->duration, velocity);
        cut_piece(step, w, min_of(w->chord, w->duration));
        return;
    }
    if (tahr__around_use(a, w->duration) && tahr__around_turn(step, a, &wall, &velocity)) {
        wall.normal = unit(step_level(step, wall.normal));
        velocity = scale(unit(step_level(step, velocity)), length(step->state.velocity));
        tahr__planes_add(w->walls, &w->wall_count, &wall);
    }
    end_piece(step, w, w->duration, velocity);
    go_around(step, w);
}

void tahr__path_bend(tahr__step *step, tahr__path *w)
{
    double used = tahr__path_used(w);
    tahr__around_leave(&w->around);
    end_piece(step, w, used, tahr__law_advance(&w->law, w->velocity, used).velocity);
}

/* The bevelled edge of a step is no slope to slow down on. On a slope the contact lies up to 0.25 m off the axis: if
 * the ground half-way between them is not in the plane of the contact, the face is smaller than that. Below 15 degrees
 * a bevel costs 3 % of its own width and is not looked at. One ray, until the face has been found to be a slope: as
 * long as it holds the character it stays one. */
void tahr__path_find_slope(tahr__path *w, tahr__step *step)
{
    tahr_floor *floor = &step->state.floor;
    vec3 up = step->state.up;
    tahr_hit hit;
    if (dot(w->slope, up) > TAHR__GENTLE || (floor->flags & TAHR_FLOOR_SLOPE)) {
        return;
    }
    vec3 half_way = add_scaled(step->state.position, step_level(step, sub(floor->point, step->state.position)), 0.5);
    tahr__ray(step, half_way, scale(up, -(step->limits->shape.half_height + step->config->snap_distance)), &hit);
    double off = dot(w->slope, sub(hit.point, floor->point));
    int same = hit.blocking && dot(w->slope, hit.surface_normal) > 0.99 && off < step->config->skin &&
               off > -step->config->skin;
    if (tahr__decide(step, TAHR_RULE_SLOPE, same, &hit, off, step->config->skin, "ground half-way to the contact")) {
        floor->flags |= TAHR_FLOOR_SLOPE;
    } else {
        w->slope = up;
    }
}

/* Lifts a level displacement onto all faces that carry, with its length along the slope that sets the speed. */
static vec3 along_floor(const tahr__path *w, const tahr__step *step, vec3 level)
{
    double rise = -INFINITY;
    if (w->ramp_count == 0) {
        return level;
    }
    for (uint32_t i = 0; i < w->ramp_count; i++) {
        double r = -dot(w->ramps[i], level) / dot(w->ramps[i], step->state.up);
        rise = max_of(rise, r);
    }
    double climb = dot(w->slope, level) / dot(w->slope, step->state.up);
    if (rise == 0 && w->ease == 0 && climb == 0) {
        return level;
    }
    double size = length(level), whole = rise + w->ease * size;
    if (rise * rise > 1.5 * size * size) { /* steeper than 51 degrees is only walkable by an override, and never a
                                            * bevel */
        climb = rise;
    }
    return step->config->keep_level_speed ? tahr__cap_rise(step, add_scaled(level, step->state.up, whole), rise, size)
                                          : tahr__lift(level, step->state.up, whole, climb);
}

/* m: heights that are rounding of the backends, and nothing to step up on. */
static const double SEAM = 1e-9;

/* An edge as high as the floor, as between bodies that lie flush, of which a face is told that is no floor. Of one that
 * is higher, the round of the foot and its skin would meet the top beside their lowest point, where the normal leans by
 * this height over their radius from up. */
static int is_seam(const tahr__step *step, const tahr_hit *hit, double up)
{
    return (1 - up) * (step->limits->shape.radius + step->config->skin) < SEAM &&
           dot(hit->surface_normal, step->state.up) < 0.5 && hit->walkable_rule != TAHR_WALKABLE_NEVER;
}

/* A walkable face in the way: go on along it. Its contact normal must be walkable too; the lip of a step is not a
 * ramp. */
static int take_ramp(tahr__step *step, tahr__path *w, const tahr_hit *hit)
{
    double up = dot(hit->normal, step->state.up), limit = tahr__walkable_limit(step, hit, 0);
    int seam = up >= limit && is_seam(step, hit, up);
    if (seam && w->ease == 0) { /* once; where that is not enough, it is gone along like a ramp */
        w->ease = 1e-9;
        step->state.position = add_scaled(step->state.position, step->state.up, SEAM);
        return tahr__decide(step, TAHR_RULE_RAMP, 1, hit, up, limit, "an edge as high as the floor");
    }
    if (up < limit || (!seam && !tahr__is_walkable(step, hit, 0))) {
        return tahr__decide(step, TAHR_RULE_RAMP, 0, hit, up, limit, "too steep to go on along");
    }
    for (uint32_t i = 0; i < w->ramp_count; i++) {
        if (dot(w->ramps[i], hit->normal) > 1 - 1e-14) { /* rounding touched it again: keep off a little more each
                                                          * time */
            w->ease = w->ease > 0 ? 10 * w->ease : 1e-9;
            return tahr__decide(step, TAHR_RULE_RAMP, 1, hit, up, w->ease, "going along it already");
        }
    }
    if (w->ramp_count < TAHR__MAX_PLANES) {
        carry(w, hit->normal);
    }
    return tahr__decide(step, TAHR_RULE_RAMP, 1, hit, up, limit, "a walkable face");
}

/* A step is taken half a foot at a time, so that a long slice climbs one tread after the other. Not so along the end of
 * a ceiling, which lets the head rise only as it goes on, while the foot goes on only as it rises: by ever smaller
 * parts, without end. */
static int take_step(tahr__step *step, tahr__path *w, vec3 level, const tahr_hit *hit)
{
    double stride = min_of(1, 0.5 * step->limits->width / length(level));
    w->lowered = w->lowered && length_squared(sub(step->state.position, w->from)) < SEAM * SEAM;
    double covered = tahr__step_up(step, scale(level, stride), hit, &w->lowered);
    if (covered <= 0) {
        return 0;
    }
    w->left *= 1 - covered * stride;
    tahr__around_leave(&w->around);
    w->around.is_over = 1;
    w->wall_count = 0; /* what stood beside the foot below need not stand here */
    tahr__path_carry_floor(w, step);
    w->from = step->state.position;
    w->left_before = w->left;
    return 1;
}

/* The walls that one wall is to something that stays on the ramps. One that leans over is in the way of the ramp that
 * rises most, whichever that is for a direction: it is a wall for each of them. Returns 0 if one of them leaves no way
 * at all. */
static int add_wall(tahr__step *step, tahr__path *w, const tahr_hit *hit)
{
    uint32_t count = dot(hit->normal, step->state.up) < 0 && w->ramp_count > 1 ? w->ramp_count : 1;
    for (uint32_t i = 0; i < count; i++) {
        tahr__plane wall = tahr__plane_of(step, hit);
        if (!tahr__level_wall(step, w->ramp_count ? w->ramps[i] : step->state.up, &wall) ||
            (is_in_plane(step) && !tahr__plane_surface(step, &wall.normal, &wall.offset))) {
            return 0;
        }
        wall.body ^= i << 24; /* a key of its own for every ramp */
        tahr__planes_add(w->walls, &w->wall_count, &wall);
    }
    return 1;
}

/* used: s of the piece at which it was met. */
static int take_wall(tahr__step *step, tahr__path *w, const tahr_hit *hit, double used)
{
    vec3 velocity = tahr__law_advance(&w->law, w->velocity, used).velocity;
    step->ahead = w->began + used;
    vec3 whole = w->drifts ? add(velocity, w->drift) : velocity;
    tahr__event(step, TAHR_EVENT_HIT, hit, max_of(-dot(whole, hit->normal), 0));
    step->report.slides++;
    w->chord = 0;
    tahr__around_hit(&w->around, w->walls, &w->wall_count);
    if (!add_wall(step, w, hit)) {
        return tahr__decide(step, TAHR_RULE_SLIDE, 0, hit, 0, 0, "squeezed between floor and ceiling");
    }
    tahr__around_meet(step, hit, 1, &w->around);
    end_piece(step, w, used, velocity);
    if (w->around.is_round) {
        go_around(step, w);
    }
    return tahr__decide(step, TAHR_RULE_SLIDE, 1, hit, dot(hit->normal, step->state.up), 0, "slides along");
}

double tahr__path_look_ahead(tahr__step *step, const tahr__path *w)
{
    if (!step->report.events) { /* nobody asks */
        return -1;
    }
    double used = tahr__path_used(w);
    step->ahead = w->began + used;
    return used;
}

void tahr__path_cut(tahr__step *step, tahr__path *w, double part)
{
    w->left = w->left_before - (w->left_before - w->left) * part;
    if (step->trail) {
        tahr__trail_cut(step, w->from, 1 - w->left);
    }
}

/* The motion that was made covers the piece from left_before to left. */
static void leave_trail(tahr__step *step, const tahr__path *w)
{
    tahr__stretch s = {.law = w->law,
                       .velocity = w->velocity,
                       .whole = w->wish,
                       .start = step->time + w->began,
                       .duration = w->duration,
                       .first = 1 - w->left_before,
                       .last = 1 - w->left};
    tahr__trail_stamp_walk(step, &s);
}

static int stands_here(tahr__step *step)
{
    tahr_floor floor;
    tahr__find_floor(step, step->config->snap_distance, NULL, &floor);
    return floor_is_walkable(&floor);
}

/* As if it had been opened at the begin of the slice. */
static void open_late(tahr__step *step, tahr__path *w)
{
    tahr__scope_open(step, w->scope);
    w->scope->position = w->from;
    w->scope->velocity = w->given;
}

/* Cosine of a floor's slope. */
static const double LEVEL = 1 - 1e-9;

/* A way that turns toward the wish was stopped on its chord, off where it is itself: once more, in chords that lie off
 * it by no more than path_tolerance. A chord that nothing stops ends where the way does, and is as good. Returns 0 if
 * it is near enough; and on slopes: between two of them a long slice needs all its slides to get along. */
static int cut_up(tahr__step *step, tahr__path *w)
{
    double tolerance = step->config->path_tolerance;
    int whole = w->wall_count == 0 && w->left_before == 1 && w->rest == 0 && w->chord == 0;
    int level = w->ramp_count == 0 || (w->ramp_count == 1 && dot(w->ramps[0], step->state.up) > LEVEL);
    if (!whole || !level || tolerance == 0 || step->input->flags & TAHR_INPUT_DRIVE) {
        return 0;
    }
    double sagitta = tahr__law_sagitta(&w->law, w->velocity, w->duration);
    if (sagitta <= tolerance) {
        return 0;
    }
    step->state.position = w->from;
    w->left = 1;
    if (step->trail) {
        tahr__trail_cut(step, w->from, 0);
    }
    w->chords = 1 + (uint32_t)min_of(sqrt(sagitta / tolerance), TAHR__MOST_TURNS - 1);
    w->chord = w->duration / w->chords;
    cut_piece(step, w, w->chord);
    step->report.arcs++;
    return 1;
}

/* Each turn goes along two more lines. */
static int is_under_way(const tahr__step *step, const tahr__path *w, uint32_t sweeps)
{
    return sweeps < step->config->max_slides + 2 * w->around.done + w->chords && (w->left > 0 || w->rest > 0) &&
           step->error >= 0;
}

/* Goes the rest of the slice with one look ahead and down. The first piece was asked for so before (stroll.c). */
static int go_onward(tahr__step *step, tahr__path *w, vec3 motion)
{
    if (w->turns == 0 || w->rest > 0 || !step->onward) {
        return 0;
    }
    w->knows_below = (uint32_t)tahr__go_onward(step, motion, &w->below);
    return (int)w->knows_below;
}

void tahr__path_walk(tahr__step *step, tahr__path *w)
{
    tahr_hit hit;
    w->lost = 0;
    for (uint32_t i = 0; is_under_way(step, w, i); i++) {
        if (w->left <= 0) {
            if (w->careful && !stands_here(step)) {
                return;
            }
            turn(step, w);
        }
        vec3 level = tahr__slide(w->walls, w->wall_count, scale(w->wish, w->left));
        if (length_squared(level) == 0) {
            return;
        }
        vec3 motion = along_floor(w, step, level);
        w->from = step->state.position;
        w->left_before = w->left;
        if (go_onward(step, w, motion)) {
            w->left = 0;
            return;
        }
        uint32_t pushed = (uint32_t)tahr__move(step, motion, &hit);
        w->careful |= pushed; /* out of an overlap: there is no way back */
        w->left *= hit.blocking ? 1 - hit.fraction : 0;
        if (step->trail) {
            leave_trail(step, w);
        }
        if (!hit.blocking && w->rest <= 0) {
            return;
        }
        if (!hit.blocking) {
            continue;
        }
        if (hit.unknown || hit.start_overlap) {
            break;
        }
        if (w->turns++ == 0 && !w->careful && w->scope) {
            open_late(step, w);
        }
        if (w->careful && !stands_here(step)) {
            return;
        }
        double used = tahr__path_look_ahead(step, w);
        if (step_goes_far(step)) { /* a step up, and a floor there */
            tahr__announce_near(step, step->state.position, scale(unit(level), step->limits->width));
        }
        tahr__planes_forget(step, w->walls, &w->wall_count);
        if (take_ramp(step, w, &hit) || (!pushed && cut_up(step, w))) {
            continue;
        }
        level = tahr__slide(w->walls, w->wall_count, scale(w->wish, w->left));
        if (length_squared(level) > 0 && take_step(step, w, level, &hit)) {
            continue;
        }
        if (!take_wall(step, w, &hit, used >= 0 ? used : tahr__path_used(w))) {
            step->state.velocity = vec(0, 0, 0);
            return;
        }
    }
    w->lost = w->duration + w->rest - tahr__path_used(w);
}

void tahr__path_look_below(tahr__step *step, tahr__path *w, tahr_floor *floor)
{
    if (w->knows_below) {
        tahr__find_floor_met(step, step->config->snap_distance, &w->below, floor);
        w->knows_below = 0;
    } else {
        tahr__find_floor(step, step->config->snap_distance, NULL, floor);
    }
}
