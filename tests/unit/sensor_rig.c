/* SPDX-License-Identifier: MIT
 * sensor_rig.c: see sensor_rig.h. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sensor_rig.h"

#include "native_fixture.h"
#include <tahr/native.h>
#ifdef TAHR_HAVE_CCD
#include <tahr/ccd.h>
#endif

int sensor_backends(void)
{
#ifdef TAHR_HAVE_CCD
    return SENSOR_BACKENDS;
#else
    return ON_CCD;
#endif
}

void sensor_begin(sensor_rig *s, int backend)
{
    memset(s, 0, sizeof *s);
    s->backend = backend;
    s->bodies[0] = fixture_body(TAHR_BODY_BOX);
    s->bodies[0].half_extents = fake_vec(64, 64, 0.5);
    s->bodies[0].pose.position = fake_vec(0, 0, -0.5);
    s->count = 1;
    fake_world_init(&s->solid);
    fake_add_box(&s->solid, fake_vec(-64, -64, -1), fake_vec(64, 64, 0));
    fake_world_init(&s->sensors);
}

uint32_t sensor_box(sensor_rig *s, tahr_vec3 min, tahr_vec3 max)
{
    assert_true(s->count < SENSOR_BODIES);
    tahr_body_desc *b = &s->bodies[s->count];
    *b = fixture_body(TAHR_BODY_BOX);
    b->flags = TAHR_BODY_SENSOR | TAHR_BODY_MOVABLE;
    b->surface = 40 + s->count;
    b->half_extents = fake_vec(0.5 * (max.x - min.x), 0.5 * (max.y - min.y), 0.5 * (max.z - min.z));
    b->pose.position = fake_vec(0.5 * (min.x + max.x), 0.5 * (min.y + max.y), 0.5 * (min.z + max.z));
    fake_add_box(&s->sensors, min, max)->surface = b->surface;
    return s->count++;
}

static tahr_status callback_sweep(void *user, const tahr_sweep *query, tahr_hit *hit)
{
    return fake_sweep(&((sensor_rig *)user)->solid, query, hit);
}

static tahr_status callback_contacts(void *user, const tahr_contact_query *query, tahr_contact *contacts,
                                     uint32_t capacity, uint32_t *count)
{
    return fake_contacts(&((sensor_rig *)user)->solid, query, contacts, capacity, count);
}

/* Each sensor by itself, as the only thing in the world. */
static tahr_status callback_sensors(void *user, const tahr_sweep *query, tahr_hit *hits, uint32_t capacity,
                                    uint32_t *count)
{
    sensor_rig *s = user;
    uint32_t n = 0;
    for (uint32_t i = 0; i < s->sensors.count; i++) {
        fake_world one;
        tahr_hit hit;
        tahr_sweep q = *query;
        memset(&hit, 0, sizeof hit);
        q.flags = 0;
        fake_world_init(&one);
        one.solids[one.count++] = s->sensors.solids[i];
        fake_sweep(&one, &q, &hit);
        if (!hit.blocking) {
            continue;
        }
        hit.body = i + 1;
        if (n == capacity) {
            return TAHR_TRUNCATED;
        }
        uint32_t at = n++;
        for (; at > 0 && hits[at - 1].fraction > hit.fraction; at--) {
            hits[at] = hits[at - 1];
        }
        memset(&hits[at], 0, sizeof hits[at]);
        hits[at].body = hit.body;
        hits[at].normal = hit.normal;
        hits[at].surface = hit.surface;
        hits[at].fraction = hit.fraction;
        hits[at].start_overlap = hit.start_overlap;
        *count = n;
    }
    return TAHR_OK;
}

uint32_t sensor_gate(sensor_rig *s, double from, double to)
{
    return sensor_box(s, fake_vec(from, -16, -2), fake_vec(to, 16, 8));
}

void sensor_open(sensor_rig *s, const tahr_config *config, tahr_vec3 at)
{
    if (s->backend == ON_CALLBACKS) {
        tahr_callbacks c = {.struct_size = sizeof c,
                            .user = s,
                            .sweep = callback_sweep,
                            .contacts = callback_contacts,
                            .sensors = callback_sensors};
        rig_open_callbacks(&s->r, &c, config, at);
        return;
    }
    const tahr_backend *backend = tahr_backend_v1_native();
#ifdef TAHR_HAVE_CCD
    backend = s->backend == ON_CCD ? tahr_backend_v1_ccd() : backend;
#endif
    rig_open_bodies_on(&s->r, backend, s->bodies, s->count, config, at);
}

void sensor_close(sensor_rig *s)
{
    rig_close(&s->r);
}

void sensor_put(sensor_rig *s, uint32_t body, tahr_vec3 centre)
{
    tahr_vec3 h = s->bodies[body].half_extents;
    if (s->backend == ON_CALLBACKS) {
        fake_solid *solid = &s->sensors.solids[body - 1];
        solid->min = fake_vec(centre.x - h.x, centre.y - h.y, centre.z - h.z);
        solid->max = fake_vec(centre.x + h.x, centre.y + h.y, centre.z + h.z);
        assert_int_equal(tahr_world_touch(s->r.world), TAHR_OK);
        return;
    }
    tahr_body_pose pose = {body, 0, {centre, {0, 0, 0, 1}}};
    assert_int_equal(tahr_world_set(s->r.world, &pose, 1), TAHR_OK);
}

const tahr_event *sensor_event(const rig *r, uint32_t type, uint32_t body)
{
    for (uint32_t i = 0; i < r->report.event_count; i++) {
        if (r->events[i].type == type && r->events[i].body == body) {
            return &r->events[i];
        }
    }
    return NULL;
}

int sensor_events(const rig *r, uint32_t type)
{
    int n = 0;
    for (uint32_t i = 0; i < r->report.event_count; i++) {
        n += r->events[i].type == type;
    }
    return n;
}
