/* SPDX-License-Identifier: MIT
 * crowd_delay.c: one step for several ticks, with a bound on how far off its way is shown.
 *
 * The step is computed at the begin of the ticks that it stands for, with the input of the first. If it met nothing, no
 * event and no other face of the floor, it is the exact result of that input for that time, whatever it is cut into:
 * the laws of movement are closed forms. In between the character is shown on the straight line from its begin to its
 * end. If the input changes earlier, the step is taken once more from its begin to now, which is exact again, so that
 * errors do not add up.
 *
 * The bound. Let x(t) be the exact way, v(t) its velocity, h the length of the step, d(t) = x(t) - line(t). d(0) = d(h)
 * = 0, and d'(t) = v(t) - u with u the mean of v. Under a constant input each component of v, along the wish, across it
 * and along up, goes from its value at the begin to that at the end without turning back, so v(t), and u with it, lies
 * in the box between v(0) and v(h), and |d'| is at most its diagonal, D = |v(h) - v(0)|. So |d(t)| is at most D min(t,
 * h - t) <= D h / 2, which is kept below the budget; with a constant acceleration it is a quarter of that. (On a slope
 * v is the level speed for some settings, and the way longer by up to 1.56, at 50 degrees; but then a half of the bound
 * is to spare: where v only goes one way, |d| <= D h / 4.)
 *
 * Neither way leads through anything: the exact one was swept by the step, the straight one is swept besides; and where
 * the exact place takes over from the shown one the way between them is swept too. */
#include "crowd_delay.h"

#include <string.h>

#include "answer.h"

_Static_assert(sizeof(tahr_delay) == 1280 && sizeof(tahr_member) == 32, "frozen");

/* Ticks that one step stands for, at most: at 60 Hz 0.13 s, in which a walker goes as far as he is wide. */
enum { MOST_TICKS = 8 };

/* Ticks without a try after one that met something, and after a step that was broken off: a try costs a step, breaking
 * off another one; so who never gets anywhere takes 6 steps in 5 ticks, and who is always broken off 5 in 4. */
enum { PAUSE = 4, BROKEN = 2 };

/* Of a length of time: rounding of sums of dt. */
static const double ROUNDING = 1e-9;

tahr_status tahr__turn_step(const tahr__turn *t)
{
    t->mover->company = t->company;
    tahr_status status = tahr_mover_step(t->mover, t->input, t->dt, t->state, t->report);
    t->mover->company = NULL;
    return status;
}

static void show(const tahr_delay *d, double elapsed, tahr_state *shown)
{
    const double part = elapsed / d->length;
    *shown = d->from;
    shown->position = add(add_scaled(d->from.position, sub(d->to.position, d->from.position), part), vec(0, 0, 0));
    shown->velocity = add(add_scaled(d->from.velocity, sub(d->to.velocity, d->from.velocity), part), vec(0, 0, 0));
}

static int is_shown(const tahr_delay *d, const tahr_state *state)
{
    tahr_state shown;
    show(d, d->elapsed, &shown);
    return memcmp(&shown, state, sizeof shown) == 0;
}

static int same_input(const tahr_delay *d, const tahr_input *in)
{
    return d->flags == in->flags && d->jump == in->jump && d->crouch == in->crouch && vec_equal(d->move, in->move) &&
           (!(in->flags & TAHR_INPUT_GRAVITY) || vec_equal(d->gravity, in->gravity));
}

/* May a body that moves come near a character within `around` of a place? Any way from where it is now, as far as it
 * has come last: it may turn before it is asked for again. */
static int moves_near(const tahr_mover *mover, vec3 at, double around)
{
    const tahr_world *world = mover->world;
    const tahr_config *c = &mover->config;
    const double size = mover->limits.around + mover->limits.shape.half_height + c->snap_distance + c->step_height;
    for (uint32_t i = 0; i < world->moved_count; i++) {
        const tahr__body_note *note = &world->bodies[world->moved[i]];
        const double way = length(sub(note->pose.position, note->before.position));
        vec3 off = sub(at, note->pose.position);
        off.z = world_is_planar(world) ? 0 : off.z;
        if (length(off) <= note->reach + way + size + around) {
            return 1;
        }
    }
    return 0;
}

/* Nothing has changed since the last tick but bodies far away. */
static int world_is_same(const tahr__turn *t, const tahr_delay *d)
{
    const tahr_world *world = t->mover->world;
    if (d->revision == world->revision) {
        return world->moved_count == 0 || !moves_near(t->mover, t->state->position, 0);
    }
    return d->revision == world->last_revision && world->last_revision != 0 &&
           !moves_near(t->mover, t->state->position, length(sub(d->to.position, d->from.position)));
}

void tahr__turn_report(tahr_report *report, uint32_t flags)
{
    if (report) {
        tahr_report r = {.struct_size = report->struct_size,
                         .flags = flags,
                         .events = report->events,
                         .decisions = report->decisions,
                         .event_capacity = report->event_capacity,
                         .decision_capacity = report->decision_capacity,
                         .queries = report->queries,
                         .query_capacity = report->query_capacity};
        *report = r;
    }
}

/* Shows the character a tick farther on its way. Returns 0 if that is not possible any more. */
static int go_on(const tahr__turn *t, const tahr_member *member, tahr_delay *d)
{
    const double elapsed = d->elapsed + t->dt;
    tahr_state next;
    if (t->company->neighbours || d->config != member->config || !same_input(d, t->input) || !world_is_same(t, d) ||
        elapsed > d->length * (1 + ROUNDING)) {
        return 0;
    }
    const int ends = elapsed >= d->length * (1 - ROUNDING);
    if (ends) {
        next = d->to;
    } else {
        show(d, elapsed, &next);
    }
    if (company_strays(t->company, next.position)) {
        return 0;
    }
    *t->state = next;
    d->elapsed = ends ? 0 : elapsed;
    d->length = ends ? 0 : d->length;
    d->revision = t->mover->world->revision;
    tahr__turn_report(t->report, TAHR_REPORT_DEFERRED);
    if (t->report) {
        t->report->saved[TAHR_SHORTCUT_DEFERRED] = 1;
    }
    t->counts->deferred++;
    return 1;
}

/* One sweep of the character, with less than its skin: what it walks on is that far away. Returns the part of the way
 * that is free. */
static double free_part(const tahr__turn *t, const tahr_state *s, vec3 motion)
{
    const tahr_config *c = &t->mover->config;
    tahr_query_context context = {.cache = NULL};
    tahr_hit hit;
    uint32_t count = 0;
    tahr_sweep q = {.shape = c->shape,
                    .position = s->position,
                    .up = s->up,
                    .orientation = s->orientation,
                    .motion = motion,
                    .margin = c->separation == TAHR_SEPARATION_MARGIN ? 0.5 * c->skin : 0,
                    .mask = c->mask,
                    .ignore_body = TAHR_NO_BODY,
                    .flags = TAHR_SWEEP_LEAVE_OVERLAP};
    q.shape.radius = s->radius;
    q.shape.half_height = s->half_height;
    if (length_squared(motion) == 0) {
        return 1;
    }
    tahr_status status = answer_sweep(t->mover->world, &context, &q, &hit, 1, &count);
    if (status >= 0 && t->company->neighbours) {
        tahr__neighbours_sweep(t->company->neighbours, &q, &hit, &count);
    }
    return status < 0 ? 0 : (count > 0 && (hit.blocking || hit.start_overlap || hit.unknown) ? hit.fraction : 1);
}

static tahr_input input_of(const tahr_delay *d)
{
    tahr_input in = {.struct_size = sizeof in,
                     .flags = d->flags,
                     .jump = d->jump,
                     .crouch = d->crouch,
                     .move = d->move,
                     .gravity = d->gravity};
    return in;
}

/* From the place that is shown to where the exact step leads until now. [out] s. */
static void catch_up(const tahr__turn *t, const tahr_delay *d, tahr_state *s)
{
    const tahr_input in = input_of(d);
    const vec3 shown = t->state->position;
    tahr_state exact = d->from;
    if (tahr_mover_step(t->mover, &in, d->elapsed, &exact, NULL) < 0) {
        return; /* what is shown is all that is known */
    }
    const vec3 way = sub(exact.position, shown);
    const double part = free_part(t, s, way);
    *s = exact;
    if (part < 1) {
        s->position = add(add_scaled(shown, way, part), vec(0, 0, 0));
    }
}

/* Is the step from one state to the other without anything that a shorter one could have met otherwise? */
static int is_plain(const tahr_state *a, const tahr_state *b, const tahr_report *r)
{
    const int falls = a->mode == TAHR_MODE_FALLING || a->mode == TAHR_MODE_FLYING;
    const int walks = a->mode == TAHR_MODE_WALKING && a->floor.body == b->floor.body &&
                      a->floor.flags == b->floor.flags && vec_equal(a->floor.surface_normal, b->floor.surface_normal);
    return (falls || walks) && a->mode == b->mode && a->flags == b->flags && r->event_count + r->events_lost == 0 &&
           r->slides == 0 && r->step_offset == 0 && r->time_lost == 0 && a->base.body == TAHR_NO_BODY &&
           b->base.body == TAHR_NO_BODY && a->touched_count == b->touched_count && a->radius == b->radius &&
           a->half_height == b->half_height && vec_equal(a->up, b->up) &&
           memcmp(&a->orientation, &b->orientation, sizeof a->orientation) == 0;
}

/* Takes one step for several ticks, if it meets nothing, and shows its begin. s: where the character is now. Returns 1
 * if it did. */
static int go_ahead(const tahr__turn *t, const tahr_member *member, tahr_delay *d, const tahr_state *s)
{
    const uint32_t flags = t->input->flags & ~(uint32_t)TAHR_INPUT_GRAVITY;
    /* The first one ends when its id says: so that not all take theirs in the same tick. */
    const uint32_t ticks = d->rounds == 0 ? 2 + member->id % (MOST_TICKS - 1) : MOST_TICKS;
    const double time = ticks * t->dt;
    tahr_event event;
    tahr_report report = {.struct_size = sizeof report, .events = &event, .event_capacity = 1};
    tahr_state to = *s, next;
    if (t->company->neighbours || flags || t->dt <= 0 || time > t->mover->config.max_dt ||
        (t->report && (t->report->decisions || t->report->queries))) {
        return 0;
    }
    if (tahr_mover_step(t->mover, t->input, time, &to, &report) != TAHR_OK || !is_plain(s, &to, &report) ||
        0.5 * time * length(sub(to.velocity, s->velocity)) > member->budget ||
        moves_near(t->mover, s->position, length(sub(to.position, s->position))) ||
        free_part(t, s, sub(to.position, s->position)) < 1) {
        return 0;
    }
    tahr_delay begun = {.from = *s,
                        .to = to,
                        .length = time,
                        .elapsed = t->dt,
                        .revision = t->mover->world->revision,
                        .move = t->input->move,
                        .gravity = t->input->gravity,
                        .jump = t->input->jump,
                        .crouch = t->input->crouch,
                        .flags = t->input->flags,
                        .config = member->config,
                        .rounds = d->rounds + (d->rounds < UINT32_MAX)};
    show(&begun, t->dt, &next);
    if (company_strays(t->company, next.position)) {
        return 0;
    }
    *d = begun;
    *t->state = next;
    tahr__turn_report(t->report, report.flags);
    if (t->report) {
        t->report->sweeps = report.sweeps + 1;
        t->report->slices = report.slices;
        t->report->triangle_tests = report.triangle_tests;
        memcpy(t->report->saved, report.saved, sizeof report.saved);
    }
    t->counts->ahead++;
    return 1;
}

tahr_status tahr__turn_delayed(const tahr__turn *t, const tahr_member *member, tahr_delay *d)
{
    tahr_state s = *t->state;
    const int under_way = d->length > 0 && is_shown(d, t->state);
    if (under_way && go_on(t, member, d)) {
        return TAHR_OK;
    }
    if (under_way) {
        catch_up(t, d, &s);
    }
    if (!under_way && d->failures == 0 && go_ahead(t, member, d, &s)) {
        return TAHR_OK;
    }
    tahr__turn now = *t;
    now.state = &s;
    tahr_status status = tahr__turn_step(&now);
    if (status < 0 || status == TAHR__STRAYED) {
        return status;
    }
    *t->state = s;
    d->length = d->elapsed = 0;
    d->failures = under_way ? (uint32_t)BROKEN : (d->failures > 0 ? d->failures - 1 : (uint32_t)PAUSE);
    return status;
}
