/* SPDX-License-Identifier: MIT
 * pool.c: see pool.h. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "pool.h"

const char *const pool_fields[POOL_LIES] = {"",         "immersion", "immersion", "immersion",
                                            "friction", "velocity",  "status"};

/* A number from 0 to 1 that only the place decides, and that no neighbour shares. */
static double noise(tahr_vec3 at)
{
    double x = sin(12.9898 * at.x + 78.233 * at.y + 37.719 * at.z) * 43758.5453;
    return x - floor(x);
}

static tahr_status water(void *user, const tahr_fluid_query *q, tahr_fluid *fluid)
{
    pool *p = user;
    double m = (q->half_height - q->position.z) / (2 * q->half_height);
    p->asked++;
    m = p->lie == POOL_NOISE ? 1.5 * noise(q->position) - 0.25 : m;
    if (m <= 0) {
        return TAHR_OK;
    }
    *fluid = p->water;
    fluid->immersion = m < 1 ? m : 1;
    switch (p->lie) {
    case POOL_NAN: fluid->immersion = NAN; break;
    case POOL_NEGATIVE: fluid->immersion = -0.5; break;
    case POOL_DEEP: fluid->immersion = 1.5; break;
    case POOL_FRICTION: fluid->friction = INFINITY; break;
    case POOL_CURRENT: fluid->velocity.y = NAN; break;
    case POOL_STATUS: return TAHR_E_BACKEND;
    default: break;
    }
    return TAHR_OK;
}

void pool_init(pool *p)
{
    fake_world_init(&p->world);
    p->water = (tahr_fluid){.body = 7};
    p->lie = POOL_TRUE;
    p->asked = 0;
}

void pool_open(rig *r, pool *p, const tahr_config *config, tahr_vec3 at)
{
    tahr_callbacks callbacks = fake_callbacks(&p->world);
    callbacks.fluid = water;
    rig_open_callbacks(r, &callbacks, config, at);
}

double pool_immersion(double z)
{
    double m = (0.9 - z) / 1.8;
    return m < 0 ? 0 : (m > 1 ? 1 : m);
}

int pool_run(rig *r, double seconds, double dt)
{
    int changes = 0;
    for (int n = (int)(seconds / dt + 0.5); n > 0; n--) {
        rig_step(r, dt);
        for (uint32_t i = 0; i < r->report.event_count; i++) {
            changes += r->events[i].type == TAHR_EVENT_MODE;
        }
        rig_assert_in_order(r, dt);
        assert_true(isfinite(r->state.position.x + r->state.position.y + r->state.position.z));
        assert_int_equal(r->report.flags & TAHR_REPORT_QUERY_CAP, 0);
    }
    return changes;
}
