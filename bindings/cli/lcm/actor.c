/* SPDX-License-Identifier: MIT
 * actor.c: one character of a recorded run that is taken again. */
#include "actor.h"

#include "difference.h"
#include "../say.h"

#include <stdlib.h>

struct actor *actor_new(int32_t character)
{
    struct actor *actor = memory_new(1, sizeof *actor);
    actor->character = character;
    actor->gap_from = actor->events_step = actor->taken_step = -1;
    for (int kind = 0; kind < TAHR_MESSAGE_COUNT; kind++) {
        actor->sequence[kind] = -1;
    }
    return actor;
}

void actor_free(struct actor *actor)
{
    if (actor != NULL) {
        tahr_mover_destroy(actor->mover);
        free(actor);
    }
}

void verdict_gap(struct verdict *verdict, const struct gap *gap)
{
    if (gap->to < gap->from) {
        return;
    }
    if (verdict->gap_count < FINDINGS_SAID) {
        verdict->gaps[verdict->gap_count] = *gap;
    }
    verdict->gap_count++;
    verdict->unproven += (uint64_t)(gap->to - gap->from) + 1;
}

void actor_give_up(struct actor *actor, struct verdict *verdict)
{
    const struct gap gap = {actor->character, actor->next - actor->unsettled, actor->next - 1,
                            "their reports were lost"};
    verdict_gap(verdict, &gap);
    actor->unsettled = 0;
}

void actor_lose(struct actor *actor, struct verdict *verdict, int64_t from, const char *why)
{
    if (actor->known) {
        actor_give_up(actor, verdict);
    }
    actor->known = 0;
    actor->has_report = 0;
    actor->is_wrong = 0;
    if (actor->gap_from < 0) {
        actor->gap_from = from;
        actor->gap_why = why;
        actor->last = from - 1;
    }
}

static void close_gap(struct actor *actor, struct verdict *verdict, int64_t to)
{
    if (actor->gap_from >= 0) {
        const struct gap gap = {actor->character, actor->gap_from, to, actor->gap_why};
        verdict_gap(verdict, &gap);
    }
    actor->gap_from = -1;
}

void actor_take(struct actor *actor, struct verdict *verdict, int64_t step, const tahr_state *state)
{
    close_gap(actor, verdict, step - 1);
    actor->state = *state;
    actor->hash = tahr_state_hash(state);
    actor->known = 1;
    actor->next = step;
    actor->has_report = 0;
}

void actor_stepped(struct actor *actor)
{
    actor->hash = tahr_state_hash(&actor->state);
    actor->next++;
    actor->unsettled++;
}

static void differ(struct actor *actor, struct verdict *verdict, uint64_t recorded)
{
    const int64_t step = actor->next - 1, since = actor->next - actor->unsettled;
    if (verdict->desyncs_told < FINDINGS_SAID) {
        struct desync *d = &verdict->desyncs[verdict->desyncs_told++];
        *d = (struct desync){.character = actor->character,
                             .step = step,
                             .since = since,
                             .hash = actor->hash,
                             .recorded = recorded,
                             .state = actor->state};
        if (actor->heard && actor->heard_state.step == step) {
            difference_of_message(&actor->state, &actor->heard_state, d->how, sizeof d->how);
        }
        actor->desync = d;
    }
    verdict->desync_count++;
    actor->differs = 1;
    actor->unsettled = 0;
    actor_lose(actor, verdict, since, "it differs");
    actor->last = step;
}

static void contradict(struct verdict *verdict, const struct contradiction *found)
{
    if (verdict->contradiction_count < FINDINGS_SAID) {
        verdict->contradictions[verdict->contradiction_count] = *found;
    }
    verdict->contradiction_count++;
}

/* The hash of the last step is the recorded one: is what the messages about it say? */
static void compare_messages(struct actor *actor, struct verdict *verdict)
{
    struct contradiction found = {actor->character, actor->next - 1, TAHR_MESSAGE_STATE, ""};
    if (actor->is_wrong) {
        contradict(verdict, &actor->wrong);
    }
    if (actor->heard && actor->heard_state.step == found.step &&
        difference_of_message(&actor->state, &actor->heard_state, found.how, sizeof found.how) > 0) {
        contradict(verdict, &found);
    }
}

void actor_compare_event(struct actor *actor, const tahr_event_t *recorded)
{
    struct contradiction found = {actor->character, recorded->step, TAHR_MESSAGE_EVENT, "it did not happen"};
    const int64_t at = actor->events - 1;
    if (actor->is_wrong || actor->taken_step != recorded->step || at >= EVENTS_KEPT) {
        return;
    }
    if (at >= actor->taken_count || difference_of_event(&actor->taken[at], recorded, found.how, sizeof found.how) > 0) {
        actor->is_wrong = 1;
        actor->wrong = found;
    }
}

void actor_compare(struct actor *actor, struct verdict *verdict, uint64_t recorded)
{
    if (recorded != actor->hash) {
        differ(actor, verdict, recorded);
        return;
    }
    verdict->proven += (uint64_t)actor->unsettled; /* equal now, so they were on the way */
    actor->unsettled = 0;
    compare_messages(actor, verdict);
    actor->is_wrong = 0;
}

void actor_end(struct actor *actor, struct verdict *verdict)
{
    if (actor->known) {
        actor_give_up(actor, verdict);
    }
    close_gap(actor, verdict, actor->last);
}

int64_t actor_missing(struct actor *actor, uint32_t kind, int64_t sequence)
{
    const int64_t expected = actor->sequence[kind];
    actor->sequence[kind] = sequence + 1;
    return expected >= 0 && sequence > expected ? sequence - expected : 0;
}
