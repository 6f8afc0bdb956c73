/* SPDX-License-Identifier: MIT
 * box2d_rig.c: see box2d_rig.h. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "box2d_rig.h"

#ifdef TAHR_HAVE_BOX2D
#include <tahr/box2d.h>

static tahr_status try_open(uint32_t engine, const tahr_body_desc *bodies, uint32_t count, fake_log *log,
                            tahr_world **world)
{
    tahr_box2d_desc options = {.struct_size = sizeof options, .engine = engine};
    tahr_world_desc desc;
    tahr_log messages = fake_log_of(log);
    assert_int_equal(tahr_world_desc_init(&desc, sizeof desc), TAHR_OK);
    desc.bodies = bodies;
    desc.body_count = count;
    desc.options = &options;
    desc.log = &messages;
    return tahr_world_open(tahr_backend_v1_box2d(), &desc, world);
}

int box2d_engines(uint32_t engines[2])
{
    const uint32_t all[] = {TAHR_BOX2D_2, TAHR_BOX2D_3};
    int count = 0;
    for (int i = 0; i < 2; i++) {
        fake_log log = {0};
        tahr_world *world = NULL;
        if (try_open(all[i], NULL, 0, &log, &world) == TAHR_OK) {
            engines[count++] = all[i];
        }
        tahr_world_close(world);
    }
    return count;
}

tahr_world *box2d_open(uint32_t engine, const tahr_body_desc *bodies, uint32_t count, fake_log *log)
{
    tahr_world *world = NULL;
    tahr_status status = try_open(engine, bodies, count, log, &world);
    if (status != TAHR_OK) {
        fail_msg("open: %s: %s", tahr_status_name(status), log->text);
    }
    return world;
}

tahr_body_desc box2d_box(double x, double y, double half_width, double half_height)
{
    tahr_body_desc b;
    assert_int_equal(tahr_body_desc_init(&b, sizeof b, TAHR_BODY_BOX), TAHR_OK);
    b.pose.position = (tahr_vec3){x, y, 0};
    b.half_extents = (tahr_vec3){half_width, half_height, 1};
    return b;
}

tahr_body_desc box2d_chain(const double *corners, uint32_t count)
{
    tahr_body_desc b;
    assert_int_equal(tahr_body_desc_init(&b, sizeof b, TAHR_BODY_CHAIN), TAHR_OK);
    b.vertices = corners;
    b.vertex_count = count;
    return b;
}

tahr_config box2d_config(void)
{
    tahr_config c;
    assert_int_equal(tahr_config_init(&c, sizeof c, TAHR_PRESET_PRECISE), TAHR_OK);
    c.gravity = (tahr_vec3){0, -9.81, 0};
    c.plane = (tahr_vec3){0, 0, 1};
    return c;
}

void box2d_rig_open(box2d_rig *r, uint32_t engine, const tahr_body_desc *bodies, uint32_t count,
                    const tahr_config *config, double x, double y)
{
    tahr_vec3 at = {x, y, 0};
    memset(r, 0, sizeof *r);
    r->world = box2d_open(engine, bodies, count, &r->log);
    r->config = *config;
    if (tahr_mover_create(r->world, config, &r->mover) != TAHR_OK) {
        fail_msg("mover: %s", r->log.text);
    }
    assert_int_equal(tahr_state_init(&r->state, config, &at), TAHR_OK);
    r->input.struct_size = sizeof r->input;
}

void box2d_rig_close(box2d_rig *r)
{
    tahr_mover_destroy(r->mover);
    tahr_world_close(r->world);
}

void box2d_rig_steps(box2d_rig *r, int n, double dt)
{
    for (int i = 0; i < n; i++) {
        memset(&r->report, 0, sizeof r->report);
        r->report.struct_size = sizeof r->report;
        r->report.events = r->events;
        r->report.event_capacity = 64;
        tahr_status status = tahr_mover_step(r->mover, &r->input, dt, &r->state, &r->report);
        if (status < 0) {
            fail_msg("step: %s: %s", tahr_status_name(status), r->log.text);
        }
        for (uint32_t k = 0; k < r->report.event_count; k++) {
            r->hits += r->events[k].type == TAHR_EVENT_HIT;
        }
    }
}
#else
typedef int box2d_rig_is_empty;
#endif
