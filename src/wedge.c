/* SPDX-License-Identifier: MIT
 * wedge.c: held by several faces, each too steep to stand on. */
#include "floor.h"
#include "plane.h"
#include "query.h"
#include "report.h"

int tahr__is_wedged(tahr__step *step)
{
    enum { CONTACTS = TAHR__MAX_PLANES };
    tahr_contact contacts[CONTACTS];
    tahr__plane planes[TAHR__MAX_PLANES];
    uint32_t used = 0;
    vec3 way;
    /* Touched: at the skin, with a hundredth of it for what backends round. */
    uint32_t count = tahr__contacts(step, step->state.position, 1.01 * step->config->skin, contacts, CONTACTS);
    for (uint32_t i = 0; i < count; i++) {
        tahr__plane plane = {.normal = contacts[i].normal, .body = contacts[i].body, .feature = contacts[i].feature};
        if (!is_in_plane(step) || tahr__plane_surface(step, &plane.normal, &plane.offset)) {
            tahr__planes_add(planes, &used, &plane);
        }
    }
    tahr__project(planes, used, scale(step->state.up, -1), &way);
    double left = length(way);
    /* sin of 0.6 degrees: a gutter less inclined holds a character as a floor does. */
    return tahr__decide(step, TAHR_RULE_WEDGE, used > 1 && left < 0.01, NULL, left, 0.01,
                        "downward motion that the contacts leave");
}
