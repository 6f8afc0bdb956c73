/* SPDX-License-Identifier: MIT
 * judge.c: a recorded run, taken again step by step. A telemetry tells of a change of the world before the steps in
 * it, and of one step its input, its events, its state, its report. */
#include "judge.h"

#include "actor.h"
#include "crowd.h"
#include "difference.h"
#include "../say.h"

#include <stdlib.h>
#include <string.h>

struct judge {
    tahr_world *world;
    struct bodies bodies;
    tahr_config *configs;
    uint32_t config_count;
    struct actor **actors; /* by character; NULL: not heard of */
    uint32_t actor_count;
    struct crowd *crowd; /* NULL: nobody stepped in one */
    struct verdict verdict;
};

struct judge *judge_open(tahr_world *world, const tahr_config *configs, uint32_t config_count, uint32_t characters)
{
    struct judge *j = memory_new(1, sizeof *j);
    j->world = world;
    bodies_open(&j->bodies, world);
    j->configs = memory_new(config_count, sizeof *j->configs);
    memcpy(j->configs, configs, config_count * sizeof *configs);
    j->config_count = config_count;
    j->actors = memory_new(characters, sizeof(struct actor *));
    j->actor_count = characters;
    return j;
}

void judge_close(struct judge *j)
{
    if (j == NULL) {
        return;
    }
    crowd_close(j->crowd);
    for (uint32_t i = 0; i < j->actor_count; i++) {
        actor_free(j->actors[i]);
    }
    bodies_close(&j->bodies);
    free(j->actors);
    free(j->configs);
    free(j);
}

void judge_end(struct judge *j)
{
    crowd_pass(j->crowd, j->actors, &j->verdict, -1);
    for (uint32_t i = 0; i < j->actor_count; i++) {
        if (j->actors[i] != NULL) {
            actor_end(j->actors[i], &j->verdict);
            j->verdict.characters++;
        }
    }
}

const struct verdict *judge_verdict(const struct judge *j)
{
    return &j->verdict;
}

static struct actor *actor_of(struct judge *j, int32_t character)
{
    if (character < 0 || (uint32_t)character >= j->actor_count) {
        return NULL;
    }
    if (j->actors[character] == NULL) {
        j->actors[character] = actor_new(character);
    }
    return j->actors[character];
}

/* What differed before a snapshot: if another one is missing before that, the state may have been written to. */
static void look_back(struct judge *j, struct actor *a, int64_t missing, const tahr_state *state, int64_t step)
{
    if (a->differs && missing > 0) {
        j->verdict.desync_count--;
        a->gap_why = "a snapshot was lost, which may have told of a state that was written to";
        if (a->desync != NULL) {
            a->desync->excused = 1;
        }
    } else if (a->desync != NULL && a->desync->step == step - 1) {
        difference_of_states(&a->desync->state, state, a->desync->how, sizeof a->desync->how);
    }
    a->desync = NULL;
    a->differs = 0;
}

/* Known already, it says where the character is once more, or that the program wrote to its state. */
static void hear_snapshot_again(struct judge *j, struct actor *a, const tahr_snapshot_t *m)
{
    const uint64_t recorded = (uint64_t)m->state_hash;
    if (a->next < m->step) {
        actor_lose(a, &j->verdict, a->next, "an input was lost");
    } else if (recorded == a->hash) {
        actor_compare(a, &j->verdict, recorded);
    } else if (a->unsettled > 0) {
        actor_give_up(a, &j->verdict);
    } else {
        j->verdict.edits++;
    }
}

static void hear_snapshot(struct judge *j, struct actor *a, const tahr_snapshot_t *m)
{
    tahr_state state;
    if (m->size != (int32_t)sizeof state || m->config < 0 || (uint32_t)m->config >= j->config_count) {
        j->verdict.broken++;
        return;
    }
    memcpy(&state, m->state, sizeof state);
    if (tahr_state_hash(&state) != (uint64_t)m->state_hash) {
        j->verdict.broken++;
        return;
    }
    const int64_t missing = actor_missing(a, TAHR_MESSAGE_SNAPSHOT, m->sequence);
    j->verdict.lost[TAHR_MESSAGE_SNAPSHOT] += (uint64_t)missing;
    if (a->known && m->step < a->next) {
        return; /* from before */
    }
    look_back(j, a, missing, &state, m->step);
    if (a->known) {
        hear_snapshot_again(j, a, m);
    }
    if (a->mover != NULL && a->config != (uint32_t)m->config) {
        tahr_mover_destroy(a->mover);
        a->mover = NULL;
    }
    a->config = (uint32_t)m->config;
    actor_take(a, &j->verdict, m->step, &state);
}

static tahr_vec3 vec_of(const double v[3])
{
    return (tahr_vec3){v[0], v[1], v[2]};
}

static tahr_input input_of(const tahr_input_t *m)
{
    return (tahr_input){.struct_size = sizeof(tahr_input),
                        .flags = (uint32_t)m->flags,
                        .jump = (uint32_t)m->jump,
                        .crouch = (uint32_t)m->crouch,
                        .move = vec_of(m->move),
                        .facing = vec_of(m->facing),
                        .gravity = vec_of(m->gravity),
                        .radius = m->radius,
                        .half_height = m->half_height,
                        .launch = vec_of(m->launch),
                        .impulse = vec_of(m->impulse),
                        .drive = vec_of(m->drive),
                        .mode = (uint32_t)m->mode};
}

/* Why a step cannot be taken again; NULL: it can. */
static const char *obstacle(const struct judge *j, const struct actor *a, const tahr_input_t *m)
{
    if (!a->known) {
        return "the recording has no snapshot before it";
    }
    if (a->next != m->step) {
        return "an input was lost";
    }
    if (j->bodies.lost != NULL) {
        return j->bodies.lost;
    }
    if (j->bodies.epoch != m->epoch) {
        return "a body of a change of the world was lost";
    }
    if (a->config != (uint32_t)m->config) {
        return "its settings changed, and the snapshot that tells of it was lost";
    }
    return m->step_flags & TAHR_INPUT_T_STEP_CUSTOM ? "it ran the caller's own mode" : NULL;
}

static void step_alone(struct judge *j, struct actor *a, const tahr_input_t *m)
{
    const tahr_input input = input_of(m);
    tahr_report report = {.struct_size = sizeof report, .events = a->taken, .event_capacity = EVENTS_KEPT};
    tahr_status status = TAHR_OK;
    if (a->mover == NULL) {
        status = tahr_mover_create(j->world, &j->configs[a->config], &a->mover);
    }
    status = status < 0 ? status : tahr_mover_step(a->mover, &input, m->dt, &a->state, &report);
    if (status < 0) {
        actor_lose(a, &j->verdict, m->step, "the library refuses the step");
        return;
    }
    a->taken_step = m->step;
    a->taken_count = report.event_count;
    actor_stepped(a);
}

static void step_crowd(struct judge *j, struct actor *a, const tahr_input_t *m)
{
    const tahr_input input = input_of(m);
    if (j->crowd == NULL) {
        j->crowd = crowd_open(j->world, j->configs, j->config_count, j->actor_count);
    }
    crowd_step(j->crowd, j->actors, &(struct crowd_input){a, &input, m->step, m->dt}, &j->verdict);
}

static void hear_input(struct judge *j, struct actor *a, const tahr_input_t *m)
{
    j->verdict.lost[TAHR_MESSAGE_INPUT] += (uint64_t)actor_missing(a, TAHR_MESSAGE_INPUT, m->sequence);
    if (a->known && m->step < a->next) {
        return;
    }
    crowd_pass(j->crowd, j->actors, &j->verdict, m->step);
    const char *why = obstacle(j, a, m);
    if (why != NULL) {
        actor_lose(a, &j->verdict, a->known ? a->next : m->step, why);
        a->last = m->step > a->last ? m->step : a->last;
    } else if (m->step_flags & TAHR_INPUT_T_STEP_CROWD) {
        step_crowd(j, a, m);
    } else {
        step_alone(j, a, m);
    }
}

/* Events that a report counts, but that did not come. */
static int64_t missing_events(struct judge *j, struct actor *a, const tahr_report_t *m)
{
    const int64_t heard = a->events_step == m->step ? a->events : 0;
    const int64_t missing = m->event_count - heard;
    if (missing > 0) {
        j->verdict.lost[TAHR_MESSAGE_EVENT] += (uint64_t)missing;
        a->sequence[TAHR_MESSAGE_EVENT] += a->sequence[TAHR_MESSAGE_EVENT] >= 0 ? missing : 0;
    }
    return missing;
}

static void hear_report(struct judge *j, struct actor *a, const tahr_report_t *m)
{
    j->verdict.lost[TAHR_MESSAGE_REPORT] += (uint64_t)actor_missing(a, TAHR_MESSAGE_REPORT, m->sequence);
    const int64_t missing = missing_events(j, a, m);
    if (!a->known) {
        a->last = a->gap_from >= 0 && m->step > a->last ? m->step : a->last;
    } else if (m->step == a->next - 1) {
        if (a->unsettled > 0) {
            actor_compare(a, &j->verdict, (uint64_t)m->state_hash);
        }
        if (a->known && missing > 0) { /* where it led is, but not all that happened in it */
            const struct gap gap = {a->character, m->step, m->step, "events of it were lost"};
            verdict_gap(&j->verdict, &gap);
            j->verdict.proven--;
        }
    } else if (crowd_awaits(j->crowd, a, m->step)) {
        a->has_report = 1;
        a->report = *m;
    } else if (m->step >= a->next) {
        actor_lose(a, &j->verdict, a->next, "an input was lost");
        a->last = m->step;
    }
}

static void hear_event(struct judge *j, struct actor *a, const tahr_event_t *m)
{
    const int64_t expected = a->sequence[TAHR_MESSAGE_EVENT];
    j->verdict.lost[TAHR_MESSAGE_EVENT] += (uint64_t)actor_missing(a, TAHR_MESSAGE_EVENT, m->sequence);
    a->events = a->events_step == m->step ? a->events + 1 : 1;
    a->events_step = m->step;
    if (m->sequence != (expected >= 0 ? expected : 0)) {
        a->taken_step = -1; /* which one of its step it is is not known then */
    }
    actor_compare_event(a, m);
}

static void hear_state(struct judge *j, struct actor *a, const tahr_state_t *m)
{
    j->verdict.lost[TAHR_MESSAGE_STATE] += (uint64_t)actor_missing(a, TAHR_MESSAGE_STATE, m->sequence);
    a->heard = 1;
    a->heard_state = *m;
}

void judge_hear(struct judge *j, const struct message *m)
{
    if (m->kind == TAHR_MESSAGE_BODY) {
        bodies_hear(&j->bodies, &m->is.body);
        return;
    }
    const int64_t most = INT64_MAX / 4; /* so that no sum of two overflows */
    const int is_sane = m->step >= 0 && m->step < most && m->sequence >= 0 && m->sequence < most;
    struct actor *a = is_sane ? actor_of(j, m->character) : NULL;
    if (a == NULL) {
        j->verdict.broken++;
        return;
    }
    switch (m->kind) {
    case TAHR_MESSAGE_SNAPSHOT: hear_snapshot(j, a, &m->is.snapshot); break;
    case TAHR_MESSAGE_INPUT: hear_input(j, a, &m->is.input); break;
    case TAHR_MESSAGE_REPORT: hear_report(j, a, &m->is.report); break;
    case TAHR_MESSAGE_EVENT: hear_event(j, a, &m->is.event); break;
    case TAHR_MESSAGE_STATE: hear_state(j, a, &m->is.state); break;
    default: break;
    }
}
