/* SPDX-License-Identifier: MIT
 * moment.c: one step of one character is counted, checked and written down. */
#include "moment.h"

#include "csv.h"
#include "side.h"
#include "vec.h"

#define FALL_OUT_DEPTH 10.0 /* m below the lowest vertex */
#define STRAIGHT_DT 0.21 /* s; the way of a longer step bends round corners that a line between its ends would cross */
#define COMPANY 3.0      /* m between centres: a body's height, and a step or two */
#define SAMPLE_PERIOD 16 /* steps, of --check sampled */

void moment_place(struct run *run, struct character *character, double time)
{
    tahr_state_init(&character->state, &run->config, &character->spawn);
    progress_start(&character->progress, &character->state, time);
}

static void add_finding(struct run *run, const struct moment *m, const char *what, tahr_vec3 position)
{
    struct result *r = &run->result;
    if (r->finding_count < MAX_FINDINGS) {
        r->findings[r->finding_count++] = (struct finding){what, m->index, m->step, m->time, position};
    }
}

/* Where the foot is of a character whose centre is there. */
static tahr_vec3 foot_of(tahr_vec3 centre, const tahr_state *state)
{
    return vec_sub(centre, vec_scale(state->up, state->half_height));
}

static void count_events(struct run *run, const struct moment *m, const tahr_state *state)
{
    struct result *r = &run->result;
    for (uint32_t i = 0; i < m->report.event_count; i++) {
        const tahr_event *event = &m->report.events[i];
        r->events[event->type < EVENT_TYPES ? event->type : 0]++;
        if (event->type == TAHR_EVENT_OVERLAP_BEGIN && run->level.side != NULL) {
            side_reach(run->level.side, event->body, m->time + event->time);
        }
        if (run->options->plot != NULL) {
            int dropped = event->type == TAHR_EVENT_LEFT_GROUND && (m->input.flags & TAHR_INPUT_DROP);
            track_mark(&run->track, m->index, dropped ? (uint32_t)TRACK_DROPPED : event->type, m->time + event->time,
                       foot_of(event->position, state));
        }
    }
}

static void count_report(struct run *run, const struct moment *m, const tahr_state *state)
{
    struct result *r = &run->result;
    const tahr_report *report = &m->report;
    uint32_t queries = report->sweeps + report->contact_queries + report->rays + report->fluid_queries;
    r->steps++;
    r->sweeps += report->sweeps;
    r->contact_queries += report->contact_queries;
    r->rays += report->rays;
    r->triangle_tests += report->triangle_tests;
    r->gathers += report->gathers;
    r->escapes += report->escapes;
    for (uint32_t i = 0; i < TAHR_SHORTCUT_COUNT; i++) {
        r->saved[i] += report->saved[i];
    }
    r->most_queries = queries > r->most_queries ? queries : r->most_queries;
    r->modes[state->mode < MODES ? state->mode : TAHR_MODE_NONE]++;
    r->unknown += (report->flags & TAHR_REPORT_UNKNOWN) != 0;
    if (report->flags & TAHR_REPORT_QUERY_CAP) {
        r->query_caps++;
        add_finding(run, m, "query cap", m->before);
    }
    r->time_lost += report->time_lost;
    count_events(run, m, state);
}

/* With --crowd: is another character within reach? Then that one may be what holds or presses it. */
static int has_company(const struct run *run, const struct moment *m, tahr_vec3 position)
{
    for (uint32_t i = 0; run->options->crowd && i < run->options->characters; i++) {
        tahr_vec3 off = vec_sub(run->characters[i].state.position, position);
        if (i != m->index && vec_dot(off, off) < COMPANY * COMPANY) {
            return 1;
        }
    }
    return 0;
}

/* The independent look at one step. */
static void check_step(struct run *run, const struct moment *m, const tahr_state *state)
{
    struct result *r = &run->result;
    if (run->checker == NULL || (run->options->check == CHECK_SAMPLED && (m->step + m->index) % SAMPLE_PERIOD != 0)) {
        return;
    }
    const tahr_shape shape = shape_now(&run->config, state);
    r->checked++;
    int dropped = ((state->flags | m->flags_before) & TAHR_STATE_DROPPING) || (m->input.flags & TAHR_INPUT_DROP);
    if (run->dt <= STRAIGHT_DT &&
        (checker_crosses(run->checker, m->before, state->position) ||
         (!dropped && checker_sinks(run->checker, &m->shape_before, m->before, &shape, state->position)))) {
        r->tunnels++;
        add_finding(run, m, "tunnelled", m->before);
        track_mark(&run->track, m->index, TRACK_TUNNEL, m->time, foot_of(state->position, state));
    }
    double clearance = checker_clearance(run->checker, &shape, state->position, state->up);
    if (m->report.flags & TAHR_REPORT_CRUSHED) { /* there was no room, which only a mover can bring about */
        r->crushed++;
        if (checker_mover_clearance(run->checker, &shape, state->position, state->up) >= CHECK_REACH &&
            !has_company(run, m, state->position)) {
            r->crushed_alone++;
            add_finding(run, m, "crushed by nothing that moves", state->position);
        }
        return;
    }
    r->least_clearance = least(r->least_clearance, clearance);
    if (-clearance > run->options->backend->penetration_allowed) {
        add_finding(run, m, "penetration", state->position);
    }
    r->deepest = most(r->deepest, -clearance);
}

/* Puts characters that left the level, or whose state is no state any more, back to where they started. */
static void bring_back(struct run *run, const struct moment *m, struct character *character)
{
    const tahr_state *state = &character->state;
    int bad = !vec_finite(state->position) || !vec_finite(state->velocity);
    int fell = !bad && level_height(&run->level, state->position) <
                           level_height(&run->level, run->level.bounds.min) - FALL_OUT_DEPTH;
    if (bad) {
        add_finding(run, m, "bad state", m->before);
    }
    if (bad || fell) {
        run->result.bad_states += (uint64_t)bad;
        run->result.fell_out += (uint64_t)fell;
        track_mark(&run->track, m->index, TRACK_FELL_OUT, m->time, foot_of(m->before, state));
        track_break(&run->track, m->index);
        moment_place(run, character, m->time + run->dt);
    }
}

void moment_watch(struct run *run, const struct moment *m, struct character *character)
{
    const tahr_state *state = &character->state;
    const double end = (double)(m->step + 1) * run->dt;
    count_report(run, m, state);
    check_step(run, m, state);
    if (run->options->plot != NULL) {
        track_point(&run->track, m->index, m->step, end, state);
    }
    if (run->csv != NULL) {
        csv_write(run->csv, &(struct csv_row){m->step, end, m->index, state, &m->report});
    }
    if (progress_watch(&character->progress, run->world, &run->config, state, &m->input, m->heading_is_new, end) &&
        !has_company(run, m, state->position)) {
        run->result.stuck++;
        add_finding(run, m, "stuck", state->position);
        track_mark(&run->track, m->index, TRACK_STUCK, end, foot_of(state->position, state));
    }
    if (progress_hangs(&character->progress, state, end) && !has_company(run, m, state->position)) {
        run->result.hung++;
        add_finding(run, m, "hangs in the air", state->position);
        track_mark(&run->track, m->index, TRACK_STUCK, end, foot_of(state->position, state));
    }
    bring_back(run, m, character);
}
