/* SPDX-License-Identifier: MIT
 * overlap.c: the sensors that a character is inside of, enters, leaves and passes.
 *
 * A leg swept backward tells which sensors it touches, when each was left, and which the character is still inside of.
 * Where it touches one that the character was not inside of, the leg is swept forward too, which tells when it was
 * entered. Of a sensor with bays in it a leg knows the first way in and the last way out. */
#include "overlap.h"

#include "query.h"
#include "report.h"
#include "shape.h"

/* Sensors that one leg may touch; native tells of no more in one answer. */
enum { SENSORS = 32 };

/* Sweeps for sensors in one step; then only where it ends is looked at. */
enum { MOST = TAHR_MAX_SENSOR_QUERIES_PER_STEP - 1 };

typedef struct answer {
    tahr_hit hits[SENSORS];
    uint32_t count;
} answer;

/* Sensors by ascending id, as in the state. */
typedef struct crowd {
    uint32_t bodies[TAHR_MAX_TOUCHED];
    uint32_t count;
} crowd;

static void ask(tahr__step *step, const tahr__leg *leg, int backward, answer *a)
{
    vec3 from = backward ? leg->to : leg->from, to = backward ? leg->from : leg->to;
    step->trail->asked++;
    a->count = tahr__sensors(step, from, sub(to, from), leg->ignore_body, a->hits, SENSORS);
}

static const tahr_hit *find(const answer *a, uint32_t body)
{
    for (uint32_t i = 0; i < a->count; i++) {
        if (a->hits[i].body == body) {
            return &a->hits[i];
        }
    }
    return NULL;
}

static int has(const uint32_t *bodies, uint32_t count, uint32_t body)
{
    for (uint32_t i = 0; i < count; i++) {
        if (bodies[i] == body) {
            return 1;
        }
    }
    return 0;
}

/* Those that an answer starts inside of; the lowest ids, if there are too many. */
static crowd insiders(tahr__step *step, const answer *a)
{
    crowd c = {.count = 0};
    for (uint32_t i = 0; i < a->count; i++) {
        uint32_t body = a->hits[i].body, at = c.count;
        if (!a->hits[i].start_overlap || has(c.bodies, c.count, body)) {
            continue;
        }
        if (c.count == TAHR_MAX_TOUCHED) {
            step->report.flags |= TAHR_REPORT_TOUCHED_LOST;
            if (body > c.bodies[--at]) {
                continue;
            }
            c.count--;
        }
        for (; at > 0 && c.bodies[at - 1] > body; at--) {
            c.bodies[at] = c.bodies[at - 1];
        }
        c.bodies[at] = body;
        c.count++;
    }
    return c;
}

/* hit may be NULL; its fraction does not count. */
static void tell(tahr__step *step, uint32_t type, uint32_t body, const tahr_hit *hit, double time, vec3 position)
{
    tahr_event event = {.type = type, .body = body, .time = time, .position = position};
    if (hit) {
        event.feature = hit->feature;
        event.surface = hit->surface;
        event.normal = hit->normal;
    }
    tahr__event_at(step, &event);
}

/* One end of being inside of a sensor on a leg; fraction from the begin of the leg. Returns its time. */
static double tell_on(tahr__step *step, uint32_t type, const tahr__leg *leg, const tahr_hit *hit, double fraction)
{
    double time = tahr__leg_time(leg, fraction, hit->normal);
    tell(step, type, hit->body, hit, time, add_scaled(leg->from, sub(leg->to, leg->from), fraction));
    return time;
}

static void take(tahr__step *step, const crowd *now)
{
    step->state.touched_count = now->count;
    for (uint32_t i = 0; i < TAHR_MAX_TOUCHED; i++) {
        step->state.touched[i] = i < now->count ? now->bodies[i] : TAHR_NO_BODY;
    }
}

static int is_touched(const tahr__step *step, uint32_t body)
{
    return has(step->state.touched, step->state.touched_count, body);
}

/* Sensors that it was inside of and is no more. */
static void tell_left(tahr__step *step, const tahr__leg *leg, const answer *back, const crowd *now)
{
    for (uint32_t i = 0; i < step->state.touched_count; i++) {
        uint32_t body = step->state.touched[i];
        const tahr_hit *exit = find(back, body);
        if (has(now->bodies, now->count, body)) {
            continue;
        }
        if (!exit) { /* it went away, or is not for this character any more */
            tell(step, TAHR_EVENT_OVERLAP_END, body, NULL, leg->begin, leg->from);
        } else { /* inside still, but no longer among the lowest ids: as if it were left at the end */
            tell_on(step, TAHR_EVENT_OVERLAP_END, leg, exit, exit->start_overlap ? 1 : 1 - exit->fraction);
        }
    }
}

/* Sensors that it was not inside of: those it ends in, and those it passed. */
static void tell_entered(tahr__step *step, const tahr__leg *leg, const answer *back, const answer *on, const crowd *now)
{
    for (uint32_t i = 0; i < back->count; i++) {
        const tahr_hit *exit = &back->hits[i], *entry = find(on, exit->body);
        int stays = has(now->bodies, now->count, exit->body);
        if (is_touched(step, exit->body) || (exit->start_overlap && !stays)) {
            continue;
        }
        if (!stays && !entry) { /* grazed at one end by rounding */
            continue;
        }
        double begin = tell_on(step, TAHR_EVENT_OVERLAP_BEGIN, leg, entry ? entry : exit, entry ? entry->fraction : 1);
        if (!stays) {
            double end = tahr__leg_time(leg, 1 - exit->fraction, exit->normal);
            tell(step, TAHR_EVENT_OVERLAP_END, exit->body, exit, max_of(begin, end),
                 add_scaled(leg->from, sub(leg->to, leg->from), 1 - exit->fraction));
        }
    }
}

/* Sensors that have gone away since the last step, and are met again on the first leg of this one. */
static void drop_moved(tahr__step *step, const tahr__leg *leg, const answer *on)
{
    crowd still = {.count = 0};
    for (uint32_t i = 0; i < step->state.touched_count; i++) {
        uint32_t body = step->state.touched[i];
        const tahr_hit *entry = find(on, body);
        if (entry && !entry->start_overlap) {
            tell(step, TAHR_EVENT_OVERLAP_END, body, NULL, leg->begin, leg->from);
        } else {
            still.bodies[still.count++] = body;
        }
    }
    take(step, &still);
}

static int is_news(const tahr__step *step, const answer *back)
{
    for (uint32_t i = 0; i < back->count; i++) {
        if (!is_touched(step, back->hits[i].body)) {
            return 1;
        }
    }
    return 0;
}

static void resolve(tahr__step *step, const tahr__leg *leg)
{
    answer back, on;
    tahr__trail *trail = step->trail;
    int first = trail->resolved++ == 0;
    if ((leg->clear && step->state.touched_count == 0) || trail->asked + 2 > MOST) {
        return;
    }
    ask(step, leg, 1, &back);
    int moved =
        first && step->state.touched_count > 0 && (step->world->has & TAHR__HAS_MOVING_SENSORS) && !trail->current;
    on.count = 0;
    if (moved || is_news(step, &back)) {
        ask(step, leg, 0, &on);
    }
    if (step->error < 0) {
        return;
    }
    if (moved) {
        drop_moved(step, leg, &on);
    }
    crowd now = insiders(step, &back);
    tell_left(step, leg, &back, &now);
    tell_entered(step, leg, &back, &on, &now);
    take(step, &now);
}

void tahr__sense(tahr__step *step)
{
    tahr__trail *trail = step->trail;
    for (uint32_t i = 0; i < trail->count && step->error >= 0; i++) {
        resolve(step, &trail->legs[i]);
    }
    trail->count = trail->timed = 0;
}

void tahr__end_slice(tahr__step *step)
{
    tahr__trail *trail = step->trail;
    trail->held = trail->spans;
    tahr__trail_stamp(step, trail->slice, step->time);
    trail->slice = step->time;
    if (trail->count > TAHR__LEGS / 2 && !trail->held) {
        tahr__sense(step);
    }
}

/* What it is inside of where it is, whatever way it came. */
static void look_here(tahr__step *step, double time)
{
    answer here;
    vec3 at = step->state.position;
    tahr__leg leg = {.from = at, .to = at, .begin = time, .end = time, .ignore_body = step->ignore_body};
    ask(step, &leg, 1, &here);
    if (step->error < 0) {
        return;
    }
    crowd now = insiders(step, &here);
    tell_left(step, &leg, &here, &now);
    tell_entered(step, &leg, &here, &here, &now);
    take(step, &now);
}

static int changed_shape(const tahr__step *step)
{
    const tahr__trail *t = step->trail;
    const tahr_state *s = &step->state;
    tahr_quat a = t->orientation, b = s->orientation;
    int turned = a.x != b.x || a.y != b.y || a.z != b.z || a.w != b.w;
    return t->radius != s->radius || t->half_height != s->half_height || !vec_equal(t->up, s->up) ||
           (turned && !shape_is_round(&step->limits->shape));
}

void tahr__find_overlaps(tahr__step *step)
{
    tahr__trail *trail = step->trail;
    trail->held = 0;
    tahr__trail_stamp(step, step->time, step->time);
    tahr__sense(step);
    if (step->error < 0) {
        return;
    }
    if (trail->resolved == 0) {
        if (step->state.touched_count > 0 || !trail->current || changed_shape(step)) {
            look_here(step, 0);
        }
    } else if (changed_shape(step) || trail->asked + 2 > MOST) {
        look_here(step, step->time);
    }
}
