/* SPDX-License-Identifier: MIT
 * crowd.h: recorded steps of characters that are obstacles of each other, taken again as `tahr run --crowd` takes
 * them: all characters in one tick, everybody meets everybody, ids are their numbers. */
#ifndef TAHR_CLI_LCM_CROWD_H
#define TAHR_CLI_LCM_CROWD_H

#include "actor.h"

struct crowd;

struct crowd_input {
    struct actor *actor;
    const tahr_input *input;
    int64_t step;
    double dt; /* s */
};

/* configs stay the caller's. */
struct crowd *crowd_open(tahr_world *world, const tahr_config *configs, uint32_t config_count, uint32_t characters);
void crowd_close(struct crowd *crowd);

/* Steps before this one cannot be completed any more. A crowd may be NULL here and below. */
void crowd_pass(struct crowd *crowd, struct actor **actors, struct verdict *verdict, int64_t step);

/* One input of a tick; with that of the last character the tick is taken. */
void crowd_step(struct crowd *crowd, struct actor **actors, const struct crowd_input *input, struct verdict *verdict);

/* Does this step of this character wait for the others? */
int crowd_awaits(const struct crowd *crowd, const struct actor *actor, int64_t step);

#endif
