/* SPDX-License-Identifier: MIT
 * crowd_rest.h: who of a crowd sleeps, side by side in memory: a tick of a crowd asleep costs the lines that it reads,
 * and movers lie anywhere. Compiled twice: for any processor, and for those with 32-byte vectors. */
#ifndef TAHR_CROWD_REST_H
#define TAHR_CROWD_REST_H

#include "arguments.h"
#include "crowd.h"

/* A character whose mover has noted a step of a state that remembers nothing and knows its floor, with an input without
 * a flag, and no events: all that a tick compares but what is the same of all that rest: the length of the step, the
 * world, the begin of what is remembered, which is that of its config, and zeros. Four lines. */
enum { TAHR__REST_PART = offsetof(tahr_state, floor_position) };
struct tahr__rest {
    _Alignas(64) unsigned char state[TAHR__REST_PART];
    unsigned char head[offsetof(tahr_input, facing)]; /* of the input */
};

_Static_assert(sizeof(struct tahr__rest) == 256, "no hole: four lines");

/* crowd->resting of a character. */
enum { TAHR__RESTS = 1 << 0, TAHR__RESTS_PLAIN = 1 << 1 }; /* PLAIN: it is who a character without a member is */

/* Does the state know the floor where it is, in the world as it is, and is gravity not held back? */
static inline uint64_t other_floor(const tahr_state *s, const tahr_world *world)
{
    return (s->floor_revision ^ world->revision) | bits_of(s->jump_hold);
}

/* Are input and state those of the rest? */
static inline int rest_holds(const tahr__rest *rest, const tahr__bare *bare, const tahr_world *world,
                             const tahr_input *input, const tahr_state *state)
{
    const size_t z = offsetof(tahr_input, move.z);
    double move_z;
    memcpy(&move_z, rest->head + z, sizeof move_z);
    const uint64_t odd = (bits_of(input->move.z) ^ bits_of(move_z)) | input->reserved | other_floor(state, world);
    tahr__words other = words_or(other_words(input, rest->head, z), other_memory(state, bare));
    other = words_or(other, other_words(state, rest->state, sizeof rest->state));
    other = words_or(other, other_three(&state->floor_position, &state->position));
    return odd == 0 && words_are_zero(other);
}

/* Is it who it was in the last tick? */
static inline int rest_is_his(const tahr__tick *t, uint32_t i, const tahr_member *m)
{
    const tahr__figure *f = &t->crowd->figures[i];
    const uint32_t groups = m->groups ? m->groups : 1;
    const uint32_t mask = m->flags & TAHR_MEMBER_ALONE ? 0 : (m->mask ? m->mask : ~0u);
    tahr_status status;
    const char *why;
    return tahr__tick_check_one(t, i, &status, &why) == NULL && f->id == m->id && f->groups == groups &&
           f->mask == mask && m->budget == 0 && t->crowd->kind_of[i] == m->config;
}

/* tahr__rests. */
static inline uint32_t rests_among(const tahr__tick *t, uint32_t begin, uint32_t end)
{
    const tahr_crowd *c = t->crowd;
    const tahr_member *members = t->asked->members;
    const tahr__bare *bare = &c->kinds[0]->pace.bare;
    uint32_t count = 0;
    for (uint32_t i = begin; i < end; i++) {
        const tahr__rest *rest = &c->rests[i];
        int his = (c->resting[i] & TAHR__RESTS_PLAIN) != 0;
        if (members) {
            his = c->resting[i] && rest_is_his(t, i, &members[i]);
            bare = his ? &c->kinds[members[i].config]->pace.bare : bare;
        }
        const int still = his && rest_holds(rest, bare, c->world, &t->asked->inputs[i], &t->asked->states[i]);
        c->still[i] = (uint8_t)still;
        count += (uint32_t)still;
    }
    return count;
}

/* Looks who of some characters rests on: the step of this tick, which tells nobody, would be the last one's again.
 * [out] crowd->still of each. Returns how many. Inputs are of this version. */
uint32_t tahr__rests(const tahr__tick *tick, uint32_t begin, uint32_t end);
/* The same where the processor has 32-byte vectors. */
uint32_t tahr__rests_wide(const tahr__tick *tick, uint32_t begin, uint32_t end);

/* What a character's mover has noted, or has not. member: NULL: it has none. Returns its crowd->resting; 0: it does not
 * rest. */
uint8_t tahr__rest_note(tahr__rest *rest, const tahr_mover *mover, const tahr_member *member);

#endif
