/* SPDX-License-Identifier: MIT
 * nearby.h: announcing a part of a step of its own. */
#ifndef TAHR_NEARBY_H
#define TAHR_NEARBY_H

#include "core.h"

/* The whole step was announced when it began. Of a step that goes far that may be more than a backend keeps at hand;
 * then what is asked again and again along a short way, from `from` on, is announced by itself: its steps up, snaps and
 * perches. As every announcement a hint. No query. */
void tahr__announce_near(tahr__step *step, vec3 from, vec3 way);

/* May a step of this length go that far? */
static inline int step_goes_far(const tahr__step *step)
{
    const double widths = 4; /* of 0.35 m at 6 m/s: more than 0.23 s */
    return step->config->max_speed * step->dt > widths * step->limits->width;
}

#endif
