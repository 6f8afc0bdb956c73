/* SPDX-License-Identifier: MIT
 * crowd_check.c: what is wrong with a tick, before anything is stepped. */
#include <stdio.h>
#include <string.h>

#include "crowd.h"
#include "message.h"
#include "sized.h"
#include "sleep.h"

static tahr_status refuse(const tahr_crowd *crowd, tahr_status status, const char *field, const char *what)
{
    return tahr__complain(&crowd->world->log, status, "tahr_crowd_step", field, what);
}

static tahr_status check_arrays(const tahr_crowd *crowd, const tahr_crowd_tick *t)
{
    char text[96];
    if (t->count > crowd->capacity) {
        snprintf(text, sizeof text, "is %u, above the capacity of %u", t->count, crowd->capacity);
        return refuse(crowd, TAHR_E_ARGUMENT, "tick.count", text);
    }
    if (!(t->dt >= 0) || !is_finite(t->dt)) {
        return refuse(crowd, TAHR_E_ARGUMENT, "tick.dt", "is negative or not finite");
    }
    if (t->count > 0 && (!t->inputs || !t->states)) {
        return refuse(crowd, TAHR_E_NULL, t->inputs ? "tick.states" : "tick.inputs", "is NULL");
    }
    return TAHR_OK;
}

tahr_status tahr__tick_check(tahr_crowd *crowd, const tahr_crowd_tick *asked, tahr__tick *tick)
{
    if (crowd->busy) {
        return refuse(crowd, TAHR_E_REENTRANT, "crowd", "is being stepped already");
    }
    tahr_status status = tahr__sized_check(asked, sizeof *asked);
    if (status < 0) {
        return refuse(crowd, status, "tick:", tahr_status_message(status));
    }
    if (crowd->world->recording) {
        return refuse(crowd, TAHR_E_UNSUPPORTED, "world", "is being recorded, and a record knows no neighbours");
    }
    status = check_arrays(crowd, asked);
    if (status < 0) {
        return status;
    }
    *tick = (tahr__tick){.crowd = crowd,
                         .asked = asked,
                         .revision = world_revision(crowd->world),
                         .rules = world_is_planar(crowd->world) ? (uint32_t)TAHR__PAIR_FLAT : 0u};
    tick->rules |= crowd->walkable_rule == TAHR_WALKABLE_NEVER ? 0u : (uint32_t)TAHR__PAIR_LEVEL_HEADS;
    tick->input_stride = asked->count > 0 ? asked->inputs[0].struct_size : sizeof(tahr_input);
    tick->report_stride = asked->count > 0 && asked->reports ? asked->reports[0].struct_size : sizeof(tahr_report);
    if (tick->input_stride < sizeof(tahr_input) || tick->input_stride > sizeof(tahr_input) + TAHR__MOST_UNKNOWN ||
        tick->input_stride % 8 != 0) {
        return refuse(crowd, TAHR_E_STRUCT_SIZE, "inputs[0].struct_size", "is not that of a tahr_input");
    }
    if (tick->report_stride < sizeof(tahr_report) || tick->report_stride > sizeof(tahr_report) + TAHR__MOST_UNKNOWN ||
        tick->report_stride % 8 != 0) {
        return refuse(crowd, TAHR_E_STRUCT_SIZE, "reports[0].struct_size", "is not that of a tahr_report");
    }
    return TAHR_OK;
}

const char *tahr__tick_check_member(const tahr__tick *t, const tahr_member *m, tahr_status *status, const char **why)
{
    *status = TAHR_E_ARGUMENT;
    *why = "is out of range";
    if (m->id >= TAHR_NO_BODY - TAHR_CHARACTER_BODY) {
        return "members.id";
    }
    if (m->config >= t->crowd->kind_count) {
        return "members.config";
    }
    if (m->flags & ~(uint32_t)TAHR_MEMBER_ALONE || m->reserved) {
        *why = "has unknown bits";
        return m->reserved ? "members.reserved" : "members.flags";
    }
    if (!(m->budget >= 0 && m->budget <= 10)) {
        return "members.budget";
    }
    *why = "is set, but tick.delays is NULL";
    return m->budget > 0 && !t->asked->delays ? "members.budget" : NULL;
}

/* Open addressing; 0 is empty. The table has four times as many places as the crowd. */
tahr_status tahr__tick_check_ids(const tahr__tick *t)
{
    const tahr_crowd *crowd = t->crowd;
    if (!t->asked->members) {
        return TAHR_OK;
    }
    memset(crowd->keys, 0, (crowd->key_mask + (size_t)1) * sizeof *crowd->keys);
    for (uint32_t i = 0; i < t->asked->count; i++) {
        const uint32_t key = t->asked->members[i].id + 1;
        uint32_t at = (key * 2654435769u) >> 7 & crowd->key_mask;
        while (crowd->keys[at] != 0) {
            if (crowd->keys[at] == key) {
                char text[64];
                snprintf(text, sizeof text, "%u is there twice, again at index %u", key - 1, i);
                return refuse(crowd, TAHR_E_ARGUMENT, "members.id", text);
            }
            at = (at + 1) & crowd->key_mask;
        }
        crowd->keys[at] = key;
    }
    return TAHR_OK;
}
