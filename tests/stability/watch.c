/* SPDX-License-Identifier: MIT
 * watch.c: see watch.h. */
#include "watch.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Design: rest means bit-equal states from the third idle step on; a fall of half a second around its apex leads 0.3 m
 * down, so who is where it was after that hangs. */
enum { REST_FROM = 3, HANGS_AFTER = 30, STILL_AFTER = 45 };

const char *watch_name(uint32_t kept)
{
    static const char *const names[KEEPS_COUNT] = {"numbers", "status",  "cap",      "report", "reach", "solid",
                                                   "skin",    "energy",  "rest",     "saying", "speed", "ground",
                                                   "inside",  "promise", "relation", "floor",  "time",  "word"};
    for (int i = 0; i < KEEPS_COUNT; i++) {
        if (kept == 1u << i) return names[i];
    }
    return "?";
}

void watch_begin(watch *w, const trial *t, const judge *j, uint32_t keeps, int honest, double gap)
{
    memset(w, 0, sizeof *w);
    w->trial = t;
    w->judge = j;
    w->keeps = keeps;
    w->honest = honest;
    w->exact = gap;
    for (uint32_t i = 0; i < t->body_count; i++) {
        w->poses[0][i] = w->poses[1][i] = t->bodies[i].desc.pose;
        w->moves = w->moves || (t->bodies[i].desc.flags & TAHR_BODY_MOVABLE);
    }
}

void watch_accuse(watch *w, uint32_t kept, int step, double value, double bound, const char *what)
{
    if (!(w->keeps & kept) || w->first.kept) return;
    w->first = (accusation){.kept = kept, .step = step, .value = value, .bound = bound};
    snprintf(w->first.text, sizeof w->first.text, "%s", what);
}

/* value may be at most bound. */
static void at_most(watch *w, uint32_t kept, int step, double value, double bound, const char *what)
{
    if (!(w->keeps & kept)) return;
    if (bound > 0 && value / bound > w->worst.used) w->worst.used = value / bound;
    if (!(value <= bound)) watch_accuse(w, kept, step, value, bound, what);
}

static double length(tahr_vec3 v)
{
    return sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

static tahr_vec3 minus(tahr_vec3 a, tahr_vec3 b)
{
    return (tahr_vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}

static double dot(tahr_vec3 a, tahr_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static int is_number(tahr_vec3 v)
{
    return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

static void check_numbers(watch *w, int step, const tahr_state *s)
{
    static const uint8_t zero[sizeof s->reserved];
    int good = is_number(s->position) && is_number(s->velocity) && is_number(s->up) && is_number(s->floor.normal) &&
               is_number(s->floor.surface_normal) && is_number(s->floor.point) && isfinite(s->floor.distance) &&
               is_number(s->base.velocity) && isfinite(s->half_height);
    if (!good) watch_accuse(w, KEEPS_NUMBERS, step, s->position.x, 0, "a number of the state is not finite");
    at_most(w, KEEPS_NUMBERS, step, fabs(length(s->up) - 1), 1e-9, "up is no unit vector");
    tahr_quat q = s->orientation;
    at_most(w, KEEPS_NUMBERS, step, fabs(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1), 1e-6, "orientation");
    at_most(w, KEEPS_NUMBERS, step, s->mode, TAHR_MODE_CUSTOM, "no such mode");
    if (memcmp(s->reserved, zero, sizeof zero) != 0) watch_accuse(w, KEEPS_NUMBERS, step, 1, 0, "reserved is not zero");
    if (s->mode == TAHR_MODE_WALKING && (s->floor.flags & TAHR_FLOOR_WALKABLE)) {
        at_most(w, KEEPS_NUMBERS, step, fabs(length(s->floor.normal) - 1), 1e-6, "floor normal is no unit vector");
    }
    if (w->trial->world == IN_PLANE) {
        at_most(w, KEEPS_NUMBERS, step, fabs(s->velocity.z), 0, "a velocity out of the plane");
        at_most(w, KEEPS_NUMBERS, step, fabs(s->position.z - w->trial->start.z), 0, "left the plane");
    }
}

static void check_report(watch *w, int step, const tahr_report *r, double dt)
{
    uint32_t asked = r->sweeps + r->contact_queries + r->rays + r->fluid_queries;
    w->worst.queries = asked > w->worst.queries ? asked : w->worst.queries;
    at_most(w, KEEPS_CAP, step, asked, TAHR_MAX_QUERIES_PER_STEP + TAHR_MAX_SENSOR_QUERIES_PER_STEP, "queries");
    int good = isfinite(r->residual) && isfinite(r->step_offset) && r->time_lost >= 0 && r->time_lost <= dt;
    double time = 0;
    for (uint32_t i = 0; i < r->event_count; i++) {
        const tahr_event *e = &r->events[i];
        good = good && e->time >= time && e->time <= dt && is_number(e->position) && is_number(e->normal) &&
               isfinite(e->value);
        time = e->time;
    }
    good = good && (r->time_lost > 0) == ((r->flags & TAHR_REPORT_TIME_LOST) != 0);
    if (!good) watch_accuse(w, KEEPS_REPORT, step, 1, 0, "a number of the report, or the order of its events");
}

/* How fast bodies may take the character along, m/s: the fastest of them at the farthest that counts. */
static double carried(const watch *w, const tahr_state *s, double dt)
{
    double most = 0;
    for (uint32_t i = 0; w->moves && i < w->trial->body_count; i++) {
        const trial_motion *m = &w->trial->bodies[i].motion;
        tahr_vec3 to = minus(w->poses[1][i].position, w->poses[0][i].position);
        double arm = length(minus(s->position, w->poses[1][i].position)) + 2 * s->half_height;
        most = fmax(most, length(to) / dt + fabs(m->spin) * arm);
    }
    return most;
}

static int has_event(const tahr_report *r, uint32_t type)
{
    for (uint32_t i = 0; i < r->event_count; i++) {
        if (r->events[i].type == type) return 1;
    }
    return 0;
}

static double pull(const trial *t)
{
    return length(t->config.gravity) * fmax(1, fmax(t->config.fall_gravity, t->config.jump_release_gravity));
}

static void check_reach(watch *w, int step, const tahr_state *a, const tahr_state *b, double dt)
{
    const tahr_config *c = &w->trial->config;
    double speed = fmax(length(a->velocity), length(b->velocity)) + length(a->base.velocity) +
                   length(b->base.velocity) + c->max_speed + c->jump_speed + c->wall_jump_speed;
    double carry = dt > 0 ? carried(w, a, dt) : 0;
    double jumps = c->step_height + c->snap_distance + c->corner_correction + 10 * c->skin;
    double pushes = c->max_depenetration * (c->depenetration == TAHR_DEPENETRATION_JOINT ? 2 : 8);
    double most = (speed + carry + pull(w->trial) * dt + c->acceleration * dt) * dt + 2 * jumps + pushes;
    at_most(w, KEEPS_REACH, step, length(minus(b->position, a->position)), most, "went too far in one step, m");
    /* A velocity that a lie made may not grow without end either. */
    double fast = c->terminal_speed + c->max_speed + c->jump_speed + c->wall_jump_speed + pull(w->trial) * dt;
    at_most(w, KEEPS_REACH, step, length(b->velocity), 4 * (fast + carry + length(w->trial->velocity)) + 1e-9,
            "faster than anything in the trial, m/s");
}

static void check_energy(watch *w, int step, const tahr_state *a, const tahr_state *b, const tahr_report *r, double dt)
{
    const tahr_config *c = &w->trial->config;
    double base = 2 * carried(w, a, dt) + length(a->base.velocity) + length(b->base.velocity);
    double more = fmax(c->acceleration * fmax(1, c->air_control * c->air_boost), 0) * dt + pull(w->trial) * dt;
    if (has_event(r, TAHR_EVENT_JUMPED) || (a->flags & TAHR_STATE_JUMPING))
        more += a->mode == TAHR_MODE_SWIMMING ? fmax(c->jump_speed, c->water_exit_speed) : c->jump_speed;
    if (has_event(r, TAHR_EVENT_WALL_JUMPED)) more += c->jump_speed + c->wall_jump_speed;
    double bound = length(a->velocity) + base + more;
    at_most(w, KEEPS_ENERGY, step, length(b->velocity), bound * (1 + 1e-9) + 1e-12, "faster than it can be, m/s");
}

/* One surface at a time it may take many steps out of an overlap: that is no rest as long as each leaves less of it. */
static int comes_free(const watch *w, const tahr_state *a, const tahr_state *b, const tahr_report *r)
{
    if (w->trial->config.depenetration == TAHR_DEPENETRATION_JOINT || !has_event(r, TAHR_EVENT_DEPENETRATED)) return 0;
    double was = judge_gap(w->judge, w->poses[1], a, 0, NULL);
    return was < 0 && judge_gap(w->judge, w->poses[1], b, 0, NULL) > was;
}

static void check_rest(watch *w, int step, const tahr_state *a, const tahr_state *b, const tahr_report *r)
{
    const trial *t = w->trial;
    int is_idle = step >= t->first_rest;
    w->idle = is_idle ? w->idle + 1 : 0;
    if (w->moves || !is_idle) return;
    int rests = a->mode == TAHR_MODE_WALKING && b->mode == TAHR_MODE_WALKING && length(a->velocity) == 0 &&
                !comes_free(w, a, b, r);
    w->still = rests ? w->still + 1 : 0;
    if (w->still > REST_FROM && memcmp(a, b, sizeof *a) != 0) {
        watch_accuse(w, KEEPS_REST, step, length(minus(b->position, a->position)), 0, "at rest, and still changes, m");
    }
    if (w->idle > STILL_AFTER && w->landed > STILL_AFTER && b->mode == TAHR_MODE_WALKING) {
        at_most(w, KEEPS_REST, step, length(b->velocity), 1e-9 * t->scale, "without input it does not stop, m/s");
    }
    /* Falling and getting nowhere. */
    double small = 0.01 * t->scale;
    int hangs = b->mode == TAHR_MODE_FALLING && length(minus(b->position, w->held)) < small;
    w->hanging = hangs ? w->hanging + 1 : 0;
    if (!hangs) w->held = b->position;
    double seconds = w->hanging * t->steps[step].dt;
    if (w->hanging > HANGS_AFTER && seconds > 0.5)
        watch_accuse(w, KEEPS_REST, step, seconds, 0.5, "hangs in the air, s");
}

/* m: a skin is kept within 1e-5 m by a character of 1.8 m (design), and within what the backend's answers are off. */
static double slack(const watch *w)
{
    return 1e-5 * w->trial->scale + w->trial->rounding + w->exact;
}

/* Which clearance must be there after a step, given the one before it among the same bodies. */
static double owed(const watch *w, double before)
{
    const trial *t = w->trial;
    double skin = t->config.separation == TAHR_SEPARATION_MARGIN ? t->config.skin : 0;
    return fmin(before, skin);
}

static void check_skin(watch *w, int step, const tahr_state *a, const tahr_state *b)
{
    uint32_t body = 0;
    double limit = w->trial->config.skin + slack(w);
    if (w->moves || !w->gap_known) w->gap = judge_gap(w->judge, w->poses[1], a, limit, NULL);
    double gap = judge_gap(w->judge, w->poses[1], b, limit, &body), least = owed(w, w->gap);
    w->gap_known = 1;
    double below = least - gap;
    if (below > slack(w)) below = least - judge_gap_again(w->judge, w->poses[1], b, body);
    if (below > w->worst.deepest && (w->keeps & KEEPS_SKIN)) w->worst.deepest = below;
    at_most(w, KEEPS_SKIN, step, below, slack(w), "nearer than it may be, m");
    w->gap = gap;
}

/* What it could not be pushed out of is reported; steps of less than a nanosecond do nothing. */
static void check_word(watch *w, int step, const tahr_state *b, const tahr_report *r)
{
    if (r->flags & (TAHR_REPORT_CRUSHED | TAHR_REPORT_STUCK | TAHR_REPORT_BASE_LOST)) return;
    double gap = judge_gap(w->judge, w->poses[1], b, w->trial->config.skin, NULL);
    at_most(w, KEEPS_WORD, step, -gap, w->trial->config.skin / 10 + slack(w),
            "overlaps something, and nothing says so, m");
}

/* Those that pass over who says that he is crushed between them and what stands: that is no way of his. */
static uint64_t movable_of(const watch *w)
{
    uint64_t ids = 0;
    for (uint32_t i = 0; i < w->trial->body_count; i++) {
        if (w->trial->bodies[i].desc.flags & TAHR_BODY_MOVABLE) ids |= (uint64_t)1 << i;
    }
    return ids;
}

/* Between two places less than a radius apart the way cannot lead around anything. passing: bodies that may be
 * where he was, or is. */
static void check_solid(watch *w, int step, const tahr_state *a, const tahr_state *b, uint64_t passing)
{
    for (uint32_t i = 0; i < w->trial->body_count; i++) {
        if (passing >> i & 1) continue;
        if (!(length(minus(b->position, a->position)) < a->radius)) continue;
        if (judge_crossed(w->judge, i, &w->poses[0][i], &w->poses[1][i], a->position, b->position)) {
            watch_accuse(w, KEEPS_SOLID, step, i, 0, "went through body");
        }
    }
    const tahr_bounds *r = &w->trial->room;
    tahr_vec3 p = b->position;
    if ((w->keeps & KEEPS_INSIDE) && !(p.x >= r->min.x && p.x <= r->max.x && p.y >= r->min.y && p.y <= r->max.y &&
                                       p.z >= r->min.z && p.z <= r->max.z)) {
        watch_accuse(w, KEEPS_INSIDE, step, length(p), 0, "is outside of the closed room, at");
    }
}

/* On the ground: something walkable is there, no farther below than the clearance that a floor may have. */
static void check_floor(watch *w, int step, const tahr_state *b)
{
    const tahr_config *c = &w->trial->config;
    /* Unreal's ditch rule lands between two faces that are too steep each, without a floor. */
    int may_lack = c->slide_solver == TAHR_SLIDE_TWO_WALLS;
    if (b->mode == TAHR_MODE_WALKING && !(b->floor.flags & TAHR_FLOOR_WALKABLE) && !may_lack) {
        watch_accuse(w, KEEPS_FLOOR, step, b->floor.flags, TAHR_FLOOR_WALKABLE, "walks on no walkable floor, flags");
    }
    int by_ray =
        (b->floor.flags & TAHR_FLOOR_LINE) != 0; /* Unreal's: found under the axis, whatever the rim is above */
    if (w->landed > 2 && step >= w->trial->first_rest && w->idle > 2 && !w->moves && !by_ray) {
        double reach = c->floor_max * c->skin, far = 2 * reach + slack(w);
        double gap = judge_gap(w->judge, w->poses[1], b, far, NULL);
        at_most(w, KEEPS_FLOOR, step, gap, reach + slack(w), "stands above nothing, m");
    }
}

static void check_ground(watch *w, int step, const tahr_state *a, const tahr_state *b)
{
    if (a->mode == TAHR_MODE_WALKING && b->mode != TAHR_MODE_WALKING && !w->trial->steps[step].input.jump) {
        watch_accuse(w, KEEPS_GROUND, step, b->mode, TAHR_MODE_WALKING, "lost the ground, mode");
    }
}

/* The same wish as in the step before, on a level floor with nothing in the way: no slower than before. */
static void check_speed(watch *w, int step, const tahr_state *a, const tahr_state *b)
{
    const trial *t = w->trial;
    if (step == 0 || step >= t->first_rest) return;
    tahr_vec3 wish = t->steps[step].input.move;
    if (memcmp(&wish, &t->steps[step - 1].input.move, sizeof wish) != 0) return;
    if (a->mode != TAHR_MODE_WALKING || b->mode != TAHR_MODE_WALKING) return;
    double asked = length(wish) * t->config.max_speed, was = dot(a->velocity, wish), is = dot(b->velocity, wish);
    if (length(a->velocity) > asked || was < 0) return; /* it brakes, or turns around */
    at_most(w, KEEPS_SPEED, step, was - is, 1e-9 * t->config.max_speed * length(wish), "is slowed down by, m/s");
}

void watch_move(watch *w, const tahr_pose *poses)
{
    memcpy(w->poses[0], w->poses[1], sizeof w->poses[0]);
    memcpy(w->poses[1], poses, sizeof *poses * w->trial->body_count);
}

void watch_step(watch *w, int step, tahr_status status, const tahr_state *before, const tahr_state *now,
                const tahr_report *report, uint64_t teleported)
{
    double dt = w->trial->steps[step].dt;
    w->worst.steps++;
    if (status < 0) {
        w->worst.errors++;
        if (memcmp(before, now, sizeof *now) != 0)
            watch_accuse(w, KEEPS_STATUS, step, status, 0, "an error changed the state");
        if (w->honest || status != TAHR_E_BACKEND)
            watch_accuse(w, KEEPS_STATUS, step, status, 0, tahr_status_name(status));
        return;
    }
    w->worst.walking += now->mode == TAHR_MODE_WALKING;
    check_numbers(w, step, now);
    check_report(w, step, report, dt);
    check_reach(w, step, before, now, dt);
    if (dt == 0 && memcmp(before, now, sizeof *now) != 0)
        watch_accuse(w, KEEPS_STATUS, step, 0, 0, "dt = 0 changed it");
    uint64_t passing = teleported | (report->flags & TAHR_REPORT_CRUSHED ? movable_of(w) : 0);
    if (w->keeps & (KEEPS_SOLID | KEEPS_INSIDE)) check_solid(w, step, before, now, passing);
    if (w->keeps & KEEPS_SKIN) check_skin(w, step, before, now);
    if ((w->keeps & KEEPS_WORD) && dt >= 1e-9) check_word(w, step, now, report);
    if (w->keeps & KEEPS_ENERGY) check_energy(w, step, before, now, report, dt);
    w->landed = before->mode == TAHR_MODE_WALKING && now->mode == TAHR_MODE_WALKING ? w->landed + 1 : 0;
    check_rest(w, step, before, now, report);
    if (w->keeps & KEEPS_FLOOR) check_floor(w, step, now);
    if (w->keeps & KEEPS_GROUND) check_ground(w, step, before, now);
    if (w->keeps & KEEPS_SPEED) check_speed(w, step, before, now);
    uint32_t said = report->flags & (TAHR_REPORT_UNKNOWN | TAHR_REPORT_STUCK | TAHR_REPORT_CRUSHED |
                                     TAHR_REPORT_QUERY_CAP | TAHR_REPORT_BASE_LOST);
    /* Two walls drop what is left of a motion as their rule says. */
    if (!said && w->trial->config.slide_solver == TAHR_SLIDE_JOINT)
        at_most(w, KEEPS_TIME, step, report->time_lost, 0, "time is lost, and nothing says so, s");
    if (said) watch_accuse(w, KEEPS_SAYING, step, said, 0, tahr_status_name(status));
    if (w->keeps & KEEPS_PROMISE && w->trial->promise) {
        const char *what = "";
        double used = w->trial->promise(w->trial, step, before, now, report, &what);
        at_most(w, KEEPS_PROMISE, step, used, 1, what);
    }
}
