/* SPDX-License-Identifier: MIT
 * crowd.c: recorded steps of a crowd, taken again. */
#include "crowd.h"

#include "../say.h"

#include <stdlib.h>
#include <string.h>
#include <tahr/crowd.h>

struct crowd {
    tahr_world *world;
    const tahr_config *configs;
    uint32_t config_count;
    tahr_crowd *crowd; /* NULL: not needed yet: the recording may be wrong about how many there are */
    uint32_t count, got;
    int64_t step; /* of the tick that inputs come in for */
    double dt;
    uint8_t *has; /* by character */
    tahr_member *members;
    tahr_input *inputs;
    tahr_state *states;
};

static const char not_all[] = "not all of its crowd is known in that step";

struct crowd *crowd_open(tahr_world *world, const tahr_config *configs, uint32_t config_count, uint32_t characters)
{
    struct crowd *c = memory_new(1, sizeof *c);
    c->world = world;
    c->configs = configs;
    c->config_count = config_count;
    c->count = characters;
    c->has = memory_new(characters, sizeof *c->has);
    c->members = memory_new(characters, sizeof *c->members);
    c->inputs = memory_new(characters, sizeof *c->inputs);
    c->states = memory_new(characters, sizeof *c->states);
    return c;
}

void crowd_close(struct crowd *c)
{
    if (c != NULL) {
        tahr_crowd_destroy(c->crowd);
        free(c->has);
        free(c->members);
        free(c->inputs);
        free(c->states);
        free(c);
    }
}

static void begin(struct crowd *c, int64_t step)
{
    memset(c->has, 0, c->count);
    c->got = 0;
    c->step = step;
}

static void fail(struct crowd *c, struct actor **actors, struct verdict *verdict, const char *why)
{
    for (uint32_t i = 0; i < c->count; i++) {
        if (c->has[i]) {
            actor_lose(actors[i], verdict, c->step, why);
            actors[i]->last = c->step;
        }
    }
    begin(c, c->step);
}

void crowd_pass(struct crowd *c, struct actor **actors, struct verdict *verdict, int64_t step)
{
    if (c != NULL && c->got > 0 && c->step != step) {
        fail(c, actors, verdict, not_all);
    }
}

static tahr_status make(struct crowd *c)
{
    tahr_crowd_desc desc;
    tahr_crowd_desc_init(&desc, sizeof desc);
    desc.capacity = c->count;
    desc.configs = c->configs;
    desc.config_count = c->config_count;
    return c->crowd != NULL ? TAHR_OK : tahr_crowd_create(c->world, &desc, &c->crowd);
}

static void take_tick(struct crowd *c, struct actor **actors, struct verdict *verdict)
{
    tahr_crowd_tick tick;
    tahr_crowd_tick_init(&tick, sizeof tick);
    for (uint32_t i = 0; i < c->count; i++) {
        c->states[i] = actors[i]->state;
        c->members[i] = (tahr_member){.id = i, .config = actors[i]->config};
    }
    tick.count = c->count;
    tick.dt = c->dt;
    tick.members = c->members;
    tick.inputs = c->inputs;
    tick.states = c->states;
    if (make(c) < 0 || tahr_crowd_step(c->crowd, &tick) < 0) {
        fail(c, actors, verdict, "the library refuses the step");
        return;
    }
    for (uint32_t i = 0; i < c->count; i++) {
        struct actor *a = actors[i];
        a->state = c->states[i];
        actor_stepped(a);
        if (a->has_report) {
            a->has_report = 0;
            actor_compare(a, verdict, (uint64_t)a->report.state_hash);
        }
    }
    begin(c, c->step + 1);
}

void crowd_step(struct crowd *c, struct actor **actors, const struct crowd_input *input, struct verdict *verdict)
{
    const int32_t id = input->actor->character;
    if (c->got == 0) {
        begin(c, input->step);
        c->dt = input->dt;
    }
    c->has[id] = 1;
    c->inputs[id] = *input->input;
    c->got++;
    if (c->got == c->count) {
        take_tick(c, actors, verdict);
    }
}

int crowd_awaits(const struct crowd *c, const struct actor *actor, int64_t step)
{
    return c != NULL && c->got > 0 && c->step == step && c->has[actor->character];
}
