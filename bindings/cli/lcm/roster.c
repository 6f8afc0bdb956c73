/* SPDX-License-Identifier: MIT
 * roster.c: who was heard, and what was lost. */
#include "roster.h"

#include "../say.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_CHARACTERS = 1 << 20, MOST_PUBLISHERS = 256 }; /* telemetry.h; and what a person can look at */

static struct roster_publisher *publisher_of(struct roster *roster, const char *channel, size_t prefix)
{
    for (size_t i = 0; i < roster->publisher_count; i++) {
        const char *known = roster->publishers[i].prefix;
        if (strlen(known) == prefix && memcmp(known, channel, prefix) == 0) {
            return &roster->publishers[i];
        }
    }
    if (roster->publisher_count == MOST_PUBLISHERS || prefix >= sizeof roster->publishers->prefix) {
        return NULL;
    }
    roster->publishers = memory_grow(roster->publishers, &roster->publisher_capacity, roster->publisher_count + 1,
                                     sizeof *roster->publishers);
    struct roster_publisher *publisher = &roster->publishers[roster->publisher_count++];
    *publisher = (struct roster_publisher){.epoch = -1, .next_world = -1};
    memcpy(publisher->prefix, channel, prefix);
    return publisher;
}

static struct roster_row *row_of(struct roster_publisher *publisher, int32_t character)
{
    const size_t id = (size_t)character;
    const size_t had = publisher->row_capacity;
    publisher->rows = memory_grow(publisher->rows, &publisher->row_capacity, id + 1, sizeof(struct roster_row *));
    for (size_t i = had; i < publisher->row_capacity; i++) {
        publisher->rows[i] = NULL;
    }
    if (publisher->rows[id] == NULL) {
        publisher->rows[id] = memory_new(1, sizeof(struct roster_row));
        for (int kind = 0; kind < TAHR_MESSAGE_COUNT; kind++) {
            publisher->rows[id]->next[kind] = -1;
        }
        publisher->row_count = publisher->row_count > id + 1 ? publisher->row_count : id + 1;
    }
    return publisher->rows[id];
}

static void free_rows(struct roster_publisher *publisher)
{
    for (size_t i = 0; i < publisher->row_count; i++) {
        free(publisher->rows[i]);
        publisher->rows[i] = NULL;
    }
    publisher->row_count = 0;
}

/* Numbers left out since the last one. Who comes in the middle has lost nothing; who goes back begins anew. */
static uint64_t gap(int64_t *next, int64_t sequence)
{
    const uint64_t missing = *next >= 0 && sequence > *next ? (uint64_t)(sequence - *next) : 0;
    *next = sequence < INT64_MAX ? sequence + 1 : -1;
    return missing;
}

/* Of a change of the world every body is a message of its own; a snapshot changes nothing and may be missed. */
static uint64_t gap_of_bodies(struct roster_publisher *publisher, const tahr_body_t *body)
{
    uint64_t missing = 0;
    if (body->kind == TAHR_BODY_T_SNAPSHOT) {
        return 0;
    }
    if (body->epoch != publisher->epoch) {
        if (publisher->epoch >= 0 && body->epoch > publisher->epoch) {
            missing = (uint64_t)publisher->bodies_left + (uint64_t)(body->epoch - publisher->epoch - 1);
        }
        publisher->epoch = body->epoch;
        publisher->bodies_left = body->count > 1 ? body->count : 1;
    }
    publisher->bodies_left -= publisher->bodies_left > 0;
    return missing;
}

static uint64_t hear_world(struct roster_publisher *publisher, const tahr_world_t *world)
{
    if (!publisher->has_world || publisher->run != world->run) {
        if (publisher->has_world) { /* what was heard before it said who it is may be its own */
            free_rows(publisher);
            publisher->epoch = -1;
        }
        publisher->next_world = -1;
        publisher->runs++;
    }
    publisher->has_world = 1;
    publisher->run = world->run;
    snprintf(publisher->level, sizeof publisher->level, "%s", world->level);
    snprintf(publisher->backend, sizeof publisher->backend, "%s", world->backend);
    publisher->characters = world->characters;
    publisher->dropped = world->dropped;
    publisher->failed = world->failed;
    return gap(&publisher->next_world, world->sequence);
}

static uint64_t hear_character(struct roster_row *row, const struct message *m)
{
    const uint64_t missing = gap(&row->next[m->kind], m->sequence);
    row->messages++;
    row->lost += missing;
    if (m->kind == TAHR_MESSAGE_STATE) {
        row->has_state = 1;
        row->state = m->is.state;
    } else if (m->kind == TAHR_MESSAGE_EVENT) {
        row->has_event = 1;
        row->event = m->is.event;
    }
    return missing;
}

int roster_hear(struct roster *roster, const struct message *m, const char *channel)
{
    const int of_character = m->kind != TAHR_MESSAGE_BODY && m->kind != TAHR_MESSAGE_WORLD;
    struct roster_publisher *publisher = publisher_of(roster, channel, m->prefix);
    if (publisher == NULL || (of_character && (m->character < 0 || m->character >= MOST_CHARACTERS))) {
        roster->strange++;
        return 0;
    }
    roster->messages++;
    roster->by_kind[m->kind]++;
    roster->lost += of_character                   ? hear_character(row_of(publisher, m->character), m)
                    : m->kind == TAHR_MESSAGE_BODY ? gap_of_bodies(publisher, &m->is.body)
                                                   : hear_world(publisher, &m->is.world);
    return 1;
}

void roster_take_rates(struct roster *roster, double seconds)
{
    for (size_t p = 0; p < roster->publisher_count; p++) {
        for (size_t i = 0; i < roster->publishers[p].row_count; i++) {
            struct roster_row *row = roster->publishers[p].rows[i];
            if (row != NULL && seconds > 0) {
                row->rate = (double)(row->messages - row->counted) / seconds;
                row->counted = row->messages;
            }
        }
    }
}

void roster_close(struct roster *roster)
{
    for (size_t p = 0; p < roster->publisher_count; p++) {
        free_rows(&roster->publishers[p]);
        free(roster->publishers[p].rows);
    }
    free(roster->publishers);
    *roster = (struct roster){0};
}
