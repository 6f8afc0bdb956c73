/* SPDX-License-Identifier: MIT
 * judge.h: a recorded run, taken again step by step: is every state the one that was recorded? */
#ifndef TAHR_CLI_LCM_JUDGE_H
#define TAHR_CLI_LCM_JUDGE_H

#include "bodies.h"
#include "message.h"

enum { FINDINGS_SAID = 12 };

/* Steps from..to of a character that are not proven. */
struct gap {
    int32_t character;
    int64_t from, to;
    const char *why; /* static text */
};

/* A step whose state is another one. If reports before it are missing, one of those may have been the first. */
struct desync {
    int32_t character;
    int64_t step, since;
    uint64_t hash, recorded;
    tahr_state state; /* that it came to */
    int excused;      /* 1: a snapshot is missing that may have told that the state was written to */
    char how[640];    /* in which fields, as far as is known */
};

/* A message that says something else than what the recorded hash stands for. */
struct contradiction {
    int32_t character;
    int64_t step;
    uint32_t kind; /* TAHR_MESSAGE_STATE, _EVENT */
    char how[640]; /* in which fields */
};

/* What was found. */
struct verdict {
    uint64_t proven, unproven; /* steps */
    uint64_t gap_count, desync_count;
    uint64_t edits;                       /* states that the program wrote to between steps, as snapshots tell */
    struct gap gaps[FINDINGS_SAID];       /* the first ones */
    struct desync desyncs[FINDINGS_SAID]; /* likewise, the excused ones too */
    size_t desyncs_told;
    uint64_t contradiction_count;
    struct contradiction contradictions[FINDINGS_SAID];
    uint64_t lost[TAHR_MESSAGE_COUNT]; /* numbers missing in the sequences */
    uint64_t broken;                   /* snapshots that are not what their hash says, ids that cannot be */
    uint32_t characters;               /* heard */
};

struct judge;

/* Of one run: its level, opened, and its settings, of which the judge takes a copy. */
struct judge *judge_open(tahr_world *world, const tahr_config *configs, uint32_t config_count, uint32_t characters);
/* Everything was heard. */
void judge_end(struct judge *judge);
void judge_close(struct judge *judge);

void judge_hear(struct judge *judge, const struct message *message);

/* Valid until judge_close; whole after judge_end. */
const struct verdict *judge_verdict(const struct judge *judge);

#endif
