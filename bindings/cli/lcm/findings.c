/* SPDX-License-Identifier: MIT
 * findings.c: what a judge found, in words or as JSON. */
#include "findings.h"

#include "../json_values.h"

#include <inttypes.h>
#include <stdio.h>
#include <tahr/telemetry.h>

static void print_lost(const struct verdict *d)
{
    uint64_t all = 0;
    for (int kind = 0; kind < TAHR_MESSAGE_COUNT; kind++) {
        all += d->lost[kind];
    }
    if (all > 0) {
        const char *between = "  lost       ";
        for (uint32_t kind = 0; kind < TAHR_MESSAGE_COUNT; kind++) {
            if (d->lost[kind] > 0) {
                printf("%s%" PRIu64 " of kind %s", between, d->lost[kind], tahr_message_name(kind));
                between = ", ";
            }
        }
        putchar('\n');
    }
    if (d->broken > 0) {
        printf("  broken     %" PRIu64 " messages that no telemetry sends\n", d->broken);
    }
}

static void print_gaps(const struct verdict *d)
{
    if (d->gap_count > 0) {
        printf("  not proven %" PRIu64 " steps, in %" PRIu64 " gap%s\n", d->unproven, d->gap_count,
               d->gap_count == 1 ? "" : "s");
    }
    for (uint64_t i = 0; i < d->gap_count && i < FINDINGS_SAID; i++) {
        const struct gap *gap = &d->gaps[i];
        printf("             character %" PRId32 ", from step %" PRId64 " to %" PRId64 ": %s\n", gap->character,
               gap->from, gap->to, gap->why);
    }
    if (d->gap_count > FINDINGS_SAID) {
        printf("             and %" PRIu64 " more\n", d->gap_count - FINDINGS_SAID);
    }
}

static void print_desyncs(const struct verdict *d)
{
    for (size_t i = 0; i < d->desyncs_told; i++) {
        const struct desync *one = &d->desyncs[i];
        if (one->excused) {
            continue;
        }
        printf("  DIFFERS    character %" PRId32 ", step %" PRId64 ": state %016" PRIx64 ", recorded %016" PRIx64 "\n",
               one->character, one->step, one->hash, one->recorded);
        if (one->since < one->step) {
            printf("             or before: the reports from step %" PRId64 " on are missing\n", one->since);
        }
        if (one->how[0] != '\0') {
            printf("             %s\n", one->how);
        }
    }
    if (d->desync_count > FINDINGS_SAID) {
        printf("  DIFFERS    %" PRIu64 " times in all\n", d->desync_count);
    }
}

static void print_contradictions(const struct verdict *d)
{
    for (uint64_t i = 0; i < d->contradiction_count && i < FINDINGS_SAID; i++) {
        const struct contradiction *one = &d->contradictions[i];
        printf("  WRONG      character %" PRId32 ", step %" PRId64
               ": its message of kind %s is not what happened: %s\n",
               one->character, one->step, tahr_message_name(one->kind), one->how);
    }
    if (d->contradiction_count > FINDINGS_SAID) {
        printf("  WRONG      %" PRIu64 " messages in all\n", d->contradiction_count);
    }
}

void findings_print(const struct verdict *d)
{
    printf("  proven     %" PRIu64 " steps of %" PRIu32 " character%s: taken again, each state has the recorded hash\n",
           d->proven, d->characters, d->characters == 1 ? "" : "s");
    if (d->edits > 0) {
        printf("  written    %" PRIu64 " times the program wrote to a state between steps\n", d->edits);
    }
    print_desyncs(d);
    print_contradictions(d);
    print_gaps(d);
    print_lost(d);
}

static json_t *json_of_hash(uint64_t hash)
{
    char text[20];
    snprintf(text, sizeof text, "%016" PRIx64, hash);
    return json_string(text);
}

static json_t *json_of_desyncs(const struct verdict *d)
{
    json_t *all = json_array();
    for (size_t i = 0; i < d->desyncs_told; i++) {
        const struct desync *one = &d->desyncs[i];
        if (!one->excused) {
            json_array_append_new(all, json_pack("{s:i, s:I, s:I, s:o, s:o, s:s}", "character", (int)one->character,
                                                 "step", (json_int_t)one->step, "since", (json_int_t)one->since, "hash",
                                                 json_of_hash(one->hash), "recorded", json_of_hash(one->recorded),
                                                 "how", one->how));
        }
    }
    return all;
}

static json_t *json_of_contradictions(const struct verdict *d)
{
    json_t *all = json_array();
    for (uint64_t i = 0; i < d->contradiction_count && i < FINDINGS_SAID; i++) {
        const struct contradiction *one = &d->contradictions[i];
        json_array_append_new(all,
                              json_pack("{s:i, s:I, s:s, s:s}", "character", (int)one->character, "step",
                                        (json_int_t)one->step, "kind", tahr_message_name(one->kind), "how", one->how));
    }
    return all;
}

static json_t *json_of_gaps(const struct verdict *d)
{
    json_t *all = json_array();
    for (uint64_t i = 0; i < d->gap_count && i < FINDINGS_SAID; i++) {
        const struct gap *one = &d->gaps[i];
        json_array_append_new(all, json_pack("{s:i, s:I, s:I, s:s}", "character", (int)one->character, "from",
                                             (json_int_t)one->from, "to", (json_int_t)one->to, "why", one->why));
    }
    return all;
}

void findings_put(json_t *run, const struct verdict *d)
{
    json_t *lost = json_object();
    for (uint32_t kind = 0; kind < TAHR_MESSAGE_COUNT; kind++) {
        json_put_count(lost, tahr_message_name(kind), d->lost[kind]);
    }
    json_put_count(run, "heard", d->characters);
    json_put_count(run, "proven", d->proven);
    json_put_count(run, "unproven", d->unproven);
    json_put_count(run, "written", d->edits);
    json_put_count(run, "differing", d->desync_count);
    json_object_set_new(run, "differs", json_of_desyncs(d));
    json_put_count(run, "contradicting", d->contradiction_count);
    json_object_set_new(run, "wrong", json_of_contradictions(d));
    json_put_count(run, "gap_count", d->gap_count);
    json_object_set_new(run, "gaps", json_of_gaps(d));
    json_object_set_new(run, "lost", lost);
    json_put_count(run, "broken", d->broken);
}
