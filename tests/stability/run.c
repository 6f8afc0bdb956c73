/* SPDX-License-Identifier: MIT
 * run.c: see run.h. */
#include "run.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

/* All that a run needs; large, and one at a time. */
typedef struct runner {
    const run_request *request;
    trial trial;
    twin twin;
    judge *judge;
    watch watch;
    opened opened, opened_twin;
    tahr_state state, state_twin;
    tahr_event events[WATCH_EVENTS];
    tahr_report report, report_twin;
    double time;
    int crossed; /* the last step that moved the character ended in another cell than it began in */
} runner;

static double now_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

int run_possible(const family *f, const subject *s, uint32_t preset, const char **why)
{
    uint32_t world = preset == TAHR_PRESET_PLATFORMER || !(s->worlds & IN_SPACE) ? IN_PLANE : IN_SPACE;
    *why = NULL;
    if (!(s->worlds & world)) {
        *why = s->not_here;
    } else if (!(f->worlds & world)) {
        *why = f->why_not;
    } else if (f->moves && strcmp(s->name, "sweep-only") == 0) {
        *why = "no callback says how bodies move";
    } else if (f->needs & ~subject_capabilities(s)) {
        *why = f->needs_why;
    } else if (f->twin && s->lie && !s->judged) {
        *why = "lies are related to nothing";
    }
    return *why == NULL;
}

static uint32_t world_of(const run_request *r)
{
    return r->preset == TAHR_PRESET_PLATFORMER || !(r->subject->worlds & IN_SPACE) ? IN_PLANE : IN_SPACE;
}

void twin_begin(twin *w, const trial *t)
{
    memset(w, 0, sizeof *w);
    trial_copy(t, &w->other);
    w->pieces = 1;
    w->scale = 1;
    w->turn.w = 1;
    w->rows[0] = (tahr_vec3){1, 0, 0};
    w->rows[1] = (tahr_vec3){0, 1, 0};
    w->rows[2] = (tahr_vec3){0, 0, 1};
}

static double dot(tahr_vec3 a, tahr_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static double apart(tahr_vec3 a, tahr_vec3 b)
{
    tahr_vec3 d = {a.x - b.x, a.y - b.y, a.z - b.z};
    return sqrt(dot(d, d));
}

static tahr_vec3 direction(const twin *w, tahr_vec3 v)
{
    return (tahr_vec3){dot(w->rows[0], v), dot(w->rows[1], v), dot(w->rows[2], v)};
}

static tahr_vec3 sized(const twin *w, tahr_vec3 v)
{
    tahr_vec3 d = direction(w, v);
    return (tahr_vec3){d.x * w->scale, d.y * w->scale, d.z * w->scale};
}

static tahr_vec3 place(const twin *w, tahr_vec3 v)
{
    tahr_vec3 d = sized(w, v);
    return (tahr_vec3){d.x + w->shift.x, d.y + w->shift.y, d.z + w->shift.z};
}

static tahr_quat product(tahr_quat a, tahr_quat b)
{
    return (tahr_quat){a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
                       a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

/* The state that the other one should be in. Its own orientation stays: round shapes do not ask for it. */
static void map(const twin *w, const tahr_state *from, tahr_state *to)
{
    tahr_quat own = to->orientation;
    tahr_vec3 up = to->up;
    *to = *from;
    to->orientation = own;
    to->up = up;
    to->position = place(w, from->position);
    to->velocity = sized(w, from->velocity);
    to->floor.normal = direction(w, from->floor.normal);
    to->floor.surface_normal = direction(w, from->floor.surface_normal);
    to->floor.point = place(w, from->floor.point);
    to->floor.distance *= w->scale;
    to->floor.perch_distance *= w->scale;
    to->floor_position = place(w, from->floor_position);
    to->wall_normal = direction(w, from->wall_normal);
    to->radius *= w->scale;
    to->half_height *= w->scale;
    to->base.velocity = sized(w, from->base.velocity);
    to->base.pose.position = place(w, from->base.pose.position);
    to->base.pose.orientation = product(w->turn, from->base.pose.orientation);
}

static double on_grid(double x, double grid)
{
    return floor(x / grid + 0.5) * grid;
}

/* Both begin the next step as one: on the grid, where the floor is looked for again. */
static void align(runner *r)
{
    tahr_state *s = &r->state;
    if (r->twin.snap > 0) {
        s->position = (tahr_vec3){on_grid(s->position.x, r->twin.snap), on_grid(s->position.y, r->twin.snap),
                                  on_grid(s->position.z, r->twin.snap)};
        s->velocity = (tahr_vec3){on_grid(s->velocity.x, r->twin.snap), on_grid(s->velocity.y, r->twin.snap),
                                  on_grid(s->velocity.z, r->twin.snap)};
    }
    s->floor_revision = 0;
    map(&r->twin, s, &r->state_twin);
}

/* m that two ways may be apart which touch the same surfaces `off` sooner or later: what is met at a graze, or while
 * hardly moving toward it, is met at another time, and the rest of the step goes the new way, at up to twice the speed
 * off the old one, by so much longer. The end of a floor is searched for to a part of the way. */
static double conditioned(const runner *r, const tahr_state *before, double dt, double off)
{
    const double fast = sqrt(dot(before->velocity, before->velocity)) + 20 * r->trial.scale * dt, part = 1e-6;
    /* Straight down onto an edge: at the rim of the shape, 1e-4 m wide, the way is up to 40 times as far off. */
    double steep = dot(r->state.floor.normal, r->state.up), more = 0;
    if (r->state.mode == TAHR_MODE_WALKING) more += off / fmax(steep, 0.02);
    for (uint32_t i = 0; i < r->report.event_count; i++) {
        const tahr_event *e = &r->events[i];
        double into = e->type == TAHR_EVENT_HIT ? e->value : fabs(dot(e->normal, before->velocity));
        int meets = e->type == TAHR_EVENT_LANDED || e->type == TAHR_EVENT_HIT;
        if (meets) more += 2 * fast * (into > 0 ? fmin(off / into, dt) : dt);
        if (e->type == TAHR_EVENT_LEFT_GROUND) more += part * fast * dt + r->twin.ends;
    }
    return more;
}

/* Pulled back by a distance of its own Unreal's way meets walls at exactly that distance again, and a rounding decides
 * whether it slides, steps up or stays. */
static int meets_its_own_thresholds(const runner *r)
{
    int meets = r->report.slides > 0 || r->report_twin.slides > 0;
    for (uint32_t i = 0; i < r->report.event_count; i++)
        meets = meets || r->events[i].type == TAHR_EVENT_HIT || r->events[i].type == TAHR_EVENT_LANDED;
    return meets && r->trial.config.separation == TAHR_SEPARATION_PULL_BACK;
}

/* Whether the character touches two floors at once, in a crease: which of them is its floor a rounding decides, and its
 * speed follows that one. */
static int in_crease(runner *r, const tahr_state *s)
{
    tahr_contact c[16];
    uint32_t count = 0;
    tahr_contact_query q = {.shape = r->trial.config.shape,
                            .position = s->position,
                            .up = s->up,
                            .orientation = s->orientation,
                            .margin = 1.6 * r->trial.config.skin,
                            .mask = 0xFFFFFFFFu,
                            .ignore_body = TAHR_NO_BODY};
    if (tahr_world_contacts(r->opened.bodies, &q, c, 16, &count) < 0) return 0;
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t k = 0; k < i; k++) {
            int floors = dot(c[i].normal, s->up) > 0.05 && dot(c[k].normal, s->up) > 0.05;
            if (floors && dot(c[i].normal, c[k].normal) < 1 - 1e-9) return 1;
        }
    }
    return 0;
}

/* Whether the first one goes another way itself when it begins a few rounding errors beside: then its answer lies on a
 * limit of a rule, and which side of it is rounding. */
static int on_the_edge(runner *r, int step, const tahr_state *before, double worst)
{
    double by = 4 * r->request->subject->gap;
    for (int i = 0; i < 6; i++) {
        const double off = i % 2 ? by : -by;
        tahr_state s = *before;
        double *coordinate = i < 2 ? &s.position.x : i < 4 ? &s.position.y : &s.position.z;
        if (i >= 4 && r->trial.world == IN_PLANE) break;
        *coordinate += off;
        if (tahr_mover_step(r->opened.mover, &r->trial.steps[step].input, r->trial.steps[step].dt, &s, NULL) < 0)
            continue;
        if (s.mode != r->state.mode || apart(s.position, r->state.position) > 0.5 * worst) return 1;
    }
    return 0;
}

static int same_cell(double a, double b)
{
    return floor(a / 4) == floor(b / 4);
}

/* Native's geometry is local to the 4 m cell in which a step begins. A floor that was kept over the border of one is
 * rounded in another cell than one that is looked for again: config.cached_floor says so. That much, and nothing else,
 * may differ where the character came to rest there; then both go on from the same floor. */
static void share_floor(runner *r, const tahr_state *before)
{
    const tahr_floor *one = &r->state.floor, *other = &r->state_twin.floor;
    const tahr_vec3 from = before->position, to = r->state.position;
    if (memcmp(&from, &to, sizeof from) != 0) {
        r->crossed = !same_cell(from.x, to.x) || !same_cell(from.y, to.y) || !same_cell(from.z, to.z);
    }
    int rounded = one->body == other->body && one->flags == other->flags &&
                  fabs(one->distance - other->distance) <= r->request->subject->gap;
    if ((r->twin.without & WITHOUT_CACHED_FLOOR) && r->crossed && rounded) r->state_twin.floor = r->state.floor;
}

static void compare(runner *r, int step, const tahr_state *before, tahr_status one, tahr_status other)
{
    const twin *w = &r->twin;
    tahr_state due = r->state_twin;
    double allowed = w->tolerance + w->exactness * r->request->subject->gap;
    if (w->in_step && w->pieces == 1) allowed += conditioned(r, before, r->trial.steps[step].dt, allowed);
    map(w, &r->state, &due);
    double off = apart(due.position, r->state_twin.position);
    double slower = apart(due.velocity, r->state_twin.velocity) / 60;
    double worst = fmax(off, slower);
    int differs = worst > allowed || r->state.mode != r->state_twin.mode;
    int undecided = w->in_step && w->pieces == 1 && differs &&
                    (meets_its_own_thresholds(r) || in_crease(r, before) || in_crease(r, &r->state) ||
                     on_the_edge(r, step, before, worst));
    if (undecided) return;
    r->watch.worst.apart = fmax(r->watch.worst.apart, worst);
    if (one != other) watch_accuse(&r->watch, KEEPS_RELATION, step, other, one, "another status");
    if (r->state.mode != r->state_twin.mode)
        watch_accuse(&r->watch, KEEPS_RELATION, step, r->state_twin.mode, r->state.mode, "another mode");
    if (allowed > 0 && worst / allowed > r->watch.worst.used) r->watch.worst.used = worst / allowed;
    if (!(worst <= allowed)) watch_accuse(&r->watch, KEEPS_RELATION, step, worst, allowed, "goes another way by, m");
    share_floor(r, before);
    if (w->tolerance == 0 && w->exactness == 0 && !w->in_step && memcmp(&r->state, &r->state_twin, sizeof due) != 0)
        watch_accuse(&r->watch, KEEPS_RELATION, step, worst, 0, "another state, bit for bit");
}

static void trace(const runner *r, int step, tahr_status status)
{
    const tahr_state *s = &r->state;
    const tahr_vec3 p = s->position, v = s->velocity, m = r->trial.steps[step].input.move;
    printf("%3d dt %-9.3g move %+.3f %+.3f %+.3f%s  %-8s at %+.12g %+.12g %+.12g  v %+.9g %+.9g %+.9g  floor %02x %.9g"
           "  gap %.9g  %s",
           step, r->trial.steps[step].dt, m.x, m.y, m.z, r->trial.steps[step].input.jump ? " jump" : "",
           tahr_mode_name(s->mode), p.x, p.y, p.z, v.x, v.y, v.z, s->floor.flags, s->floor.distance, r->watch.gap,
           tahr_status_name(status));
    const tahr_report *report = &r->report;
    printf("  %u queries, %u slides", report->sweeps + report->contact_queries + report->rays, report->slides);
    if (report->time_lost > 0) printf(", %.3g s lost", report->time_lost);
    for (uint32_t i = 0; i < report->event_count; i++)
        printf(" %s", tahr_event_name(r->events[i].type));
    if (r->watch.first.kept && r->watch.first.step == step) printf("  <-- %s", watch_name(r->watch.first.kept));
    printf("\n");
    if (r->opened_twin.mover) {
        const tahr_state *q = &r->state_twin;
        printf("    its twin %-8s at %+.12g %+.12g %+.12g  v %+.9g %+.9g %+.9g\n", tahr_mode_name(q->mode),
               q->position.x, q->position.y, q->position.z, q->velocity.x, q->velocity.y, q->velocity.z);
    }
}

/* Moves what moves; returns the bodies that jumped, as bits. */
static uint64_t move_bodies(const trial *t, opened *o, double time, int step, double dt, tahr_pose *poses)
{
    tahr_body_pose moved[TRIAL_BODIES];
    uint32_t count = 0;
    uint64_t jumped = 0;
    for (uint32_t i = 0; i < t->body_count; i++) {
        const trial_body *b = &t->bodies[i];
        poses[i] = trial_pose(b, time, step + 1);
        if (!(b->desc.flags & TAHR_BODY_MOVABLE)) continue;
        int hops = b->motion.teleports > 0 && (step + 1) / b->motion.teleports != step / b->motion.teleports;
        moved[count] = (tahr_body_pose){i, hops ? (uint32_t)TAHR_POSE_TELEPORT : 0u, poses[i]};
        count++;
        if (hops) jumped |= (uint64_t)1 << i;
    }
    if (count > 0 && dt > 0) subject_move(o, moved, count, dt);
    return jumped;
}

static tahr_status step_twin(runner *r, int step)
{
    const trial_step *s = &r->twin.other.steps[step];
    tahr_status status = TAHR_OK;
    r->report_twin = (tahr_report){.struct_size = sizeof r->report_twin};
    for (uint32_t i = 0; i < r->twin.pieces && status >= 0; i++)
        status =
            tahr_mover_step(r->opened_twin.mover, &s->input, s->dt / r->twin.pieces, &r->state_twin, &r->report_twin);
    return status;
}

static void take_step(runner *r, int step, outcome *out)
{
    const trial_step *s = &r->trial.steps[step];
    tahr_pose poses[TRIAL_BODIES];
    int related = r->opened_twin.mover != NULL;
    if (related && r->twin.in_step) align(r);
    tahr_state before = r->state;
    r->time += s->dt > 0 && !s->refused ? s->dt : 0;
    uint64_t jumped = s->refused ? 0 : move_bodies(&r->trial, &r->opened, r->time, step, s->dt, poses);
    if (!s->refused) watch_move(&r->watch, poses);
    r->report = (tahr_report){.struct_size = sizeof r->report, .events = r->events, .event_capacity = WATCH_EVENTS};
    double from = now_seconds();
    tahr_status status = tahr_mover_step(r->opened.mover, &s->input, s->dt, &r->state, &r->report);
    out->took[step] = now_seconds() - from;
    out->steps = step + 1;
    if (s->refused) {
        if (status != TAHR_E_ARGUMENT || memcmp(&before, &r->state, sizeof before) != 0)
            watch_accuse(&r->watch, KEEPS_STATUS, step, status, TAHR_E_ARGUMENT, "wrong input is not refused");
    } else {
        watch_step(&r->watch, step, status, &before, &r->state, &r->report, jumped);
    }
    if (related && !s->refused) {
        tahr_status other = step_twin(r, step);
        compare(r, step, &before, status, other);
    }
    out->hash = (out->hash ^ tahr_state_hash(&r->state)) * 0x100000001b3u;
    if (r->request->trace) trace(r, step, status);
}

/* Of twins each is told lies of its own. */
static int start(runner *r, const trial *t, opened *o, uint32_t without, tahr_state *state)
{
    uint64_t lies = r->request->seed + (o == &r->opened_twin ? 1000003u : 0u);
    const subject_request q = {r->request->subject, t, without, lies, r->request->trace};
    tahr_status status = subject_open(&q, o);
    if (status >= 0) status = tahr_state_init(state, &t->config, &t->start);
    if (status < 0) {
        watch_accuse(&r->watch, KEEPS_STATUS, -1, status, 0, tahr_status_message(status));
        return 0;
    }
    state->velocity = t->velocity;
    return 1;
}

static uint32_t expected(const run_request *q, const trial *t)
{
    uint32_t keeps = t->keeps & q->subject->keeps;
    if (q->preset == TAHR_PRESET_UNREAL) keeps &= ~q->family->unreal_loses;
    /* One surface at a time is left only by a motion that begins in it: who stands still overlaps, and does not know.
     * */
    if (t->config.depenetration == TAHR_DEPENETRATION_SINGLE) keeps &= ~(uint32_t)KEEPS_WORD;
    /* Behind callbacks the library does not know which bodies move: what moves in is left as an overlap is. */
    if (q->family->moves && strcmp(q->subject->name, "callbacks") == 0) {
        keeps &= ~(uint32_t)KEEPS_SKIN;
        if (t->promise) keeps &= ~(uint32_t)(KEEPS_PROMISE | KEEPS_SOLID); /* and is gone through in the end */
    }
    return keeps | KEEPS_SANE;
}

double outcome_slowest(const outcome *out, int *step)
{
    int at = 0;
    for (int i = 1; i < out->steps; i++)
        at = out->took[i] > out->took[at] ? i : at;
    if (step) *step = at;
    return out->took[at];
}

void run(const run_request *request, outcome *out)
{
    static runner r;
    memset(&r, 0, sizeof r);
    memset(out, 0, sizeof *out);
    r.request = request;
    family_make(request->family, world_of(request), request->preset, request->seed, &r.trial);
    r.judge = judge_open(&r.trial);
    watch_begin(&r.watch, &r.trial, r.judge, expected(request, &r.trial),
                request->subject->lie == 0 || request->subject->judged, request->subject->gap);
    int related = 0;
    if (request->family->twin) {
        oracle_random dice = {request->seed + 77};
        request->family->twin(&r.trial, &dice, &r.twin);
        related = !r.twin.ready || r.twin.ready(request->subject);
    }
    int good = r.judge && start(&r, &r.trial, &r.opened, related ? r.twin.with : 0, &r.state);
    if (good && related) good = start(&r, &r.twin.other, &r.opened_twin, r.twin.without, &r.state_twin);
    for (int i = 0; good && i < r.trial.step_count; i++)
        take_step(&r, i, out);
    out->first = r.watch.first;
    out->worst = r.watch.worst;
    subject_close(&r.opened);
    subject_close(&r.opened_twin);
    judge_close(r.judge);
    trial_free(&r.twin.other);
    trial_free(&r.trial);
}
