/* SPDX-License-Identifier: MIT
 * asked.c: see asked.h. */
#include "asked.h"

#include <string.h>

const tahr__asked_sweep *tahr__asked_find(const tahr__asked *asked, uint64_t placed, const tahr_sweep *sweep)
{
    if (asked->placed != placed) return NULL;
    for (uint32_t i = 0; i < asked->count; i++) {
        const tahr__asked_sweep *s = &asked->sweeps[i];
        /* Most others differ here already; the last word is that of the bits. */
        if (s->sweep.position.x != sweep->position.x || s->sweep.motion.z != sweep->motion.z) continue;
        if (memcmp(&s->sweep, sweep, sizeof *sweep) == 0) return s;
    }
    return NULL;
}

void tahr__asked_keep(tahr__asked *asked, uint64_t placed, const tahr_sweep *sweep, const tahr_hit *hit, uint32_t count)
{
    if (asked->placed != placed || asked->count == 0) asked->count = asked->next = 0;
    tahr__asked_sweep *s = &asked->sweeps[asked->next];
    asked->placed = placed;
    asked->next = (asked->next + 1) % TAHR__ASKED;
    asked->count += asked->count < TAHR__ASKED;
    s->sweep = *sweep;
    s->count = count;
    if (count > 0) s->hit = *hit;
}
