/* SPDX-License-Identifier: MIT
 * lane.c: what a thread that steps does: it compares the state with the one that it last wrote, and writes what is
 * different. A record that is left out leaves those words standing, so that the next one has them too. */
#include "lane.h"

#include "record.h"
#include "telemetry.h"
#include "words.h"

_Static_assert(sizeof(tahr_input) % 8 == 0 && sizeof(tahr_report) % 8 == 0, "they are packed by words");

/* What is rare lies apart, so that what every step runs through is short. */
#ifdef __GNUC__
#define RARE __attribute__((cold, noinline))
#else
#define RARE
#endif

/* Longest step that any config allows (config.h: max_dt). */
static const double LONGEST_DT = 10;

static uint32_t bit(uint32_t message)
{
    return 1u << message;
}

/* The character, if the lane may step it; else NULL. */
static tahr__character *claim(tahr_telemetry *t, uint32_t lane, uint32_t character)
{
    if (lane >= t->lane_count || character >= t->character_count) return NULL;
    tahr__character *c = &t->characters[character];
    const uint32_t owner = atomic_load_explicit(&c->lane, memory_order_relaxed);
    if (owner == 0) atomic_store_explicit(&c->lane, lane + 1, memory_order_relaxed);
    return owner == 0 || owner == lane + 1 ? c : NULL;
}

static tahr_stamp stamp_of(tahr_telemetry *t, const tahr__character *c)
{
    return (tahr_stamp){.config = c->config,
                        .step = c->step,
                        .sequence = c->sequence[TAHR_MESSAGE_STATE],
                        .epoch = atomic_load_explicit(&t->epoch, memory_order_relaxed),
                        .time_ns = c->time_ns};
}

static uint64_t *write_state(uint64_t *to, const tahr_state *state, tahr__character *c)
{
    *(tahr__motion *)(void *)to = tahr__motion_of(state);
    to = tahr__words_pack(to + sizeof(tahr__motion) / 8, state, c->standing);
    c->standing = 0;
    return to;
}

RARE static tahr_status push_snapshot(tahr_telemetry *t, tahr__lane *l, tahr__character *c, const tahr_state *state)
{
    const tahr_stamp stamp = stamp_of(t, c);
    const uint32_t fixed = sizeof(tahr__record_snapshot) / 8;
    const uint64_t sequence = c->sequence[TAHR_MESSAGE_SNAPSHOT]++;
    uint64_t *words = tahr__ring_reserve(&l->ring, fixed + TAHR__PACKED_STATE);
    tahr__tally_add(&l->offered, TAHR_MESSAGE_SNAPSHOT, 1);
    c->snapshot = words == NULL;
    if (!words) {
        tahr__tally_add(&l->dropped, TAHR_MESSAGE_SNAPSHOT, 1);
        return TAHR_TRUNCATED;
    }
    const uint64_t *end = write_state(words + fixed, state, c);
    *(tahr__record_snapshot *)(void *)words =
        (tahr__record_snapshot){.head = {(uint64_t)(end - words), stamp.epoch, TAHR__RECORD_SNAPSHOT, 0},
                                .character = (uint32_t)(c - t->characters),
                                .config = c->config,
                                .step = c->step,
                                .sequence = sequence,
                                .time_ns = c->time_ns};
    c->gap = 0;
    c->snapshot_ns = c->time_ns + t->snapshot_ns;
    tahr__ring_commit(&l->ring, (uint64_t)(end - words));
    return TAHR_OK;
}

static int has_room(tahr__lane *l)
{
    return tahr__ring_has_room(&l->ring, l->ring.size / 4);
}

/* After a gap it waits for room: what made the gap would make the next one. */
static int wants_snapshot(const tahr__character *c, tahr__lane *l)
{
    return c->snapshot || c->time_ns >= c->snapshot_ns || (c->gap && has_room(l));
}

/* Somebody wrote to the state, or it is the first one. */
RARE static void take_over(tahr_telemetry *t, tahr__character *c, uint32_t config, const tahr_state *state)
{
    const uint64_t edited = tahr__slot_compare(&c->slot, state, t->wide);
    c->config = config;
    c->standing |= edited;
    c->snapshot = 1;
    tahr__slot_write(&c->slot, state, edited, stamp_of(t, c));
}

tahr_status tahr_telemetry_begin(tahr_telemetry *t, uint32_t lane, uint32_t character, uint32_t config,
                                 const tahr_state *state)
{
    if (!t || !state) return TAHR_E_NULL;
    if (config >= t->config_count) return TAHR_E_ARGUMENT;
    tahr__character *c = claim(t, lane, character);
    if (!c) return TAHR_E_ARGUMENT;
    if (config != c->config || !tahr__slot_holds(&c->slot, state, t->wide)) take_over(t, c, config, state);
    if (!(t->wants & bit(TAHR_MESSAGE_SNAPSHOT)) || !wants_snapshot(c, &t->lanes[lane])) return TAHR_OK;
    return push_snapshot(t, &t->lanes[lane], c, state);
}

/* Whether the state of this step is due, which ends at the character's time. */
static int is_due(const tahr_telemetry *t, tahr__character *c)
{
    if (t->every == 1 && t->state_period <= 0) return 1;
    const int by_step = c->state_step == 0;
    c->state_step = (by_step ? t->every : c->state_step) - 1;
    if (!by_step || (double)c->time_ns < c->state_ns) return 0;
    /* From the time at which it was due, so that the rate is kept on average; but what was missed is not made good. */
    c->state_ns += t->state_period;
    if (c->state_ns < (double)c->time_ns) c->state_ns = (double)c->time_ns;
    return 1;
}

/* A step on its way into the ring. */
typedef struct pushed {
    const tahr_telemetry_step *step;
    tahr__character *character;
    tahr_stamp stamp;
    uint32_t parts; /* 1 << TAHR_MESSAGE_* */
    uint32_t events;
} pushed;

static void count_parts(tahr__tally *tally, uint32_t parts, uint32_t events)
{
    if (parts & bit(TAHR_MESSAGE_STATE)) tahr__tally_add(tally, TAHR_MESSAGE_STATE, 1);
    if (parts & bit(TAHR_MESSAGE_EVENT)) tahr__tally_add(tally, TAHR_MESSAGE_EVENT, events);
    if (parts & bit(TAHR_MESSAGE_INPUT)) tahr__tally_add(tally, TAHR_MESSAGE_INPUT, 1);
    if (parts & bit(TAHR_MESSAGE_REPORT)) tahr__tally_add(tally, TAHR_MESSAGE_REPORT, 1);
}

static const uint32_t WITH_STATE = 1u << TAHR_MESSAGE_STATE | 1u << TAHR_MESSAGE_REPORT; /* its hash */

static uint64_t *copy(uint64_t *to, const void *from, uint64_t words)
{
    memcpy(to, from, words * 8);
    return to + words;
}

static uint64_t *write_input(uint64_t *to, const tahr_input *input)
{
    return input->flags ? copy(to, input, TAHR__INPUT_WORDS) : copy(to, input, TAHR__PLAIN_INPUT_WORDS);
}

/* Returns 0: there is no room for the parts. */
static int write_step(tahr__lane *l, const pushed *p)
{
    const tahr_telemetry_step *s = p->step;
    const uint32_t fixed = sizeof(tahr__record_step) / 8;
    uint64_t most = fixed + TAHR__INPUT_WORDS + (uint64_t)p->events * TAHR__EVENT_WORDS;
    if (p->parts & WITH_STATE) most += TAHR__PACKED_STATE + TAHR__REPORT_WORDS;
    uint64_t *words = tahr__ring_reserve(&l->ring, most);
    if (!words) return 0;
    uint64_t *end = words + fixed;
    if (p->parts & bit(TAHR_MESSAGE_INPUT)) end = write_input(end, s->input);
    if (p->parts & WITH_STATE) end = write_state(end, s->state, p->character);
    if (p->parts & bit(TAHR_MESSAGE_REPORT)) end = copy(end, s->report, TAHR__REPORT_WORDS);
    if (p->events > 0) end = copy(end, s->report->events, (uint64_t)p->events * TAHR__EVENT_WORDS);
    const uint64_t *sequence = p->character->sequence;
    *(tahr__record_step *)(void *)words =
        (tahr__record_step){.head = {(uint64_t)(end - words), p->stamp.epoch, TAHR__RECORD_STEP, p->parts},
                            .character = s->character,
                            .config = p->stamp.config,
                            .step = p->stamp.step,
                            .sequence = {sequence[0], sequence[1], sequence[2], sequence[3]},
                            .time_ns = p->stamp.time_ns,
                            .wall_ns = s->wall_ns,
                            .dt = s->dt,
                            .ns = s->ns,
                            .status = s->status,
                            .flags = s->flags,
                            .events = p->events};
    tahr__ring_commit(&l->ring, (uint64_t)(end - words));
    return 1;
}

/* Inputs and events outlive states and reports: those are left out where the ring is three quarters full. Returns what
 * found no room. */
static uint32_t write_what_fits(tahr__lane *l, pushed *p)
{
    const uint32_t all = p->parts, thin = all & WITH_STATE;
    uint32_t dropped = thin && !has_room(l) ? thin : 0;
    for (;;) {
        p->parts = all & ~dropped;
        if (!p->parts || write_step(l, p)) return dropped;
        if (dropped == thin) return all;
        dropped = thin;
    }
}

/* Splits what the sink wants of a step into what is due and what is thinned out, and counts it. */
static void choose_parts(const tahr_telemetry *t, tahr__lane *l, pushed *p)
{
    const uint32_t thinnable =
        bit(TAHR_MESSAGE_STATE) |
        (t->flags & TAHR_TELEMETRY_THIN_ALL ? bit(TAHR_MESSAGE_INPUT) | bit(TAHR_MESSAGE_REPORT) : 0);
    uint32_t all = t->wants & (bit(TAHR_MESSAGE_STATE) | bit(TAHR_MESSAGE_INPUT));
    if (p->step->report) all |= t->wants & bit(TAHR_MESSAGE_REPORT);
    if (p->events > 0) all |= bit(TAHR_MESSAGE_EVENT);
    const uint32_t thinned = is_due(t, p->character) ? 0 : all & thinnable;
    count_parts(&l->offered, all, p->events);
    if (thinned) count_parts(&l->thinned, thinned, 0);
    p->parts = all & ~thinned;
}

static tahr_status check_step(const tahr_telemetry_step *s)
{
    if (!s->input || !s->state) return TAHR_E_NULL;
    if (!(s->dt >= 0 && s->dt <= LONGEST_DT)) return TAHR_E_ARGUMENT;
    if (s->reserved != 0) return TAHR_E_ARGUMENT;
    if (s->flags & ~(uint32_t)(TAHR_STEP_CUSTOM | TAHR_STEP_CROWD)) return TAHR_E_UNSUPPORTED;
    if (s->input->struct_size < sizeof *s->input) return TAHR_E_STRUCT_SIZE;
    if (!s->report) return TAHR_OK;
    if (s->report->struct_size < sizeof *s->report) return TAHR_E_STRUCT_SIZE;
    return s->report->events || s->report->event_count == 0 ? TAHR_OK : TAHR_E_NULL;
}

/* Who steps many takes them in order, as a rule: the lines of the one after the next are on their way for all of the
 * next one's step. */
static void expect(const tahr_telemetry *t, uint32_t character)
{
#ifdef __GNUC__
    if (character >= t->character_count) return;
    const char *at = (const char *)&t->characters[character];
    for (size_t line = 0; line < sizeof(tahr__character); line += 64)
        __builtin_prefetch(at + line);
#else
    (void)t, (void)character;
#endif
}

tahr_status tahr_telemetry_push(tahr_telemetry *t, uint32_t lane, const tahr_telemetry_step *step)
{
    if (!t || !step) return TAHR_E_NULL;
    const tahr_status wrong = check_step(step);
    if (wrong < 0) return wrong;
    tahr__character *c = claim(t, lane, step->character);
    if (!c) return TAHR_E_ARGUMENT;
    if (step->status < 0) return TAHR_OK;
    tahr__lane *l = &t->lanes[lane];
    c->time_ns += (int64_t)(step->dt * 1e9 + 0.5);
    pushed p = {.step = step, .character = c, .stamp = stamp_of(t, c)};
    if (step->report && t->wants & bit(TAHR_MESSAGE_EVENT)) p.events = step->report->event_count;
    const uint64_t changed = tahr__slot_compare(&c->slot, step->state, t->wide);
    c->standing |= changed;
    tahr__slot_write(&c->slot, step->state, changed, p.stamp);
    choose_parts(t, l, &p);
    const uint32_t due = p.parts;
    const uint32_t dropped = write_what_fits(l, &p);
    c->step++;
    c->sequence[TAHR_MESSAGE_STATE] += due >> TAHR_MESSAGE_STATE & 1;
    c->sequence[TAHR_MESSAGE_EVENT] += p.events;
    c->sequence[TAHR_MESSAGE_INPUT] += due >> TAHR_MESSAGE_INPUT & 1;
    c->sequence[TAHR_MESSAGE_REPORT] += due >> TAHR_MESSAGE_REPORT & 1;
    expect(t, step->character + 2);
    if (!dropped) return TAHR_OK;
    c->gap |= dropped >> TAHR_MESSAGE_INPUT & 1;
    count_parts(&l->dropped, dropped, p.events);
    return TAHR_TRUNCATED;
}
