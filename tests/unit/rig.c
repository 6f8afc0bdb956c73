/* SPDX-License-Identifier: MIT
 * rig.c: see rig.h. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "rig.h"

#include <tahr/native.h>

const double rig_rates[RIG_RATES] = {10, 30, 60, 144, 1000};

tahr_config rig_config(void)
{
    tahr_config c;
    assert_int_equal(tahr_config_init(&c, sizeof c, TAHR_PRESET_PRECISE), TAHR_OK);
    return c;
}

static void describe(rig *r, tahr_world_desc *desc, tahr_log *log)
{
    memset(r, 0, sizeof *r);
    *log = fake_log_of(&r->log);
    assert_int_equal(tahr_world_desc_init(desc, sizeof *desc), TAHR_OK);
    desc->log = log;
}

static void put_mover(rig *r, const tahr_config *config, tahr_vec3 at)
{
    r->config = config ? *config : rig_config();
    assert_int_equal(tahr_mover_create(r->world, &r->config, &r->mover), TAHR_OK);
    assert_int_equal(tahr_state_init(&r->state, &r->config, &at), TAHR_OK);
    r->input.struct_size = sizeof r->input;
}

void rig_open_callbacks(rig *r, const tahr_callbacks *callbacks, const tahr_config *config, tahr_vec3 at)
{
    tahr_world_desc desc;
    tahr_log log;
    describe(r, &desc, &log);
    assert_int_equal(tahr_world_open_callbacks(callbacks, &desc, &r->world), TAHR_OK);
    put_mover(r, config, at);
}

void rig_open_bodies(rig *r, const tahr_body_desc *bodies, uint32_t count, const tahr_config *config, tahr_vec3 at)
{
    rig_open_bodies_on(r, tahr_backend_v1_native(), bodies, count, config, at);
}

void rig_open_bodies_on(rig *r, const tahr_backend *backend, const tahr_body_desc *bodies, uint32_t count,
                        const tahr_config *config, tahr_vec3 at)
{
    tahr_world_desc desc;
    tahr_log log;
    describe(r, &desc, &log);
    desc.bodies = bodies;
    desc.body_count = count;
    assert_int_equal(tahr_world_open(backend, &desc, &r->world), TAHR_OK);
    put_mover(r, config, at);
}

void rig_open_native(rig *r, const tahr_native_desc *native, const tahr_body_desc *bodies, uint32_t count,
                     const tahr_config *config, tahr_vec3 at)
{
    tahr_world_desc desc;
    tahr_log log;
    describe(r, &desc, &log);
    desc.bodies = bodies;
    desc.body_count = count;
    desc.options = native;
    assert_int_equal(tahr_world_open(tahr_backend_v1_native(), &desc, &r->world), TAHR_OK);
    put_mover(r, config, at);
}

void rig_open_backend(rig *r, fake_backend *backend, uint32_t capabilities)
{
    tahr_world_desc desc;
    tahr_log log;
    fake_backend_init(backend, capabilities);
    describe(r, &desc, &log);
    desc.options = backend;
    assert_int_equal(tahr_world_open(&backend->table, &desc, &r->world), TAHR_OK);
    put_mover(r, NULL, fake_vec(0, 0, 0.95));
}

void rig_open(rig *r, fake_world *world, const tahr_config *config, tahr_vec3 at)
{
    tahr_callbacks callbacks = fake_callbacks(world);
    rig_open_callbacks(r, &callbacks, config, at);
}

void rig_stand(rig *r, fake_world *world, const tahr_config *config, tahr_vec3 at)
{
    rig_open(r, world, config, at);
    rig_settle(r);
}

void rig_close(rig *r)
{
    tahr_mover_destroy(r->mover);
    tahr_world_close(r->world);
}

tahr_status rig_step(rig *r, double dt)
{
    memset(&r->report, 0, sizeof r->report);
    r->report.struct_size = sizeof r->report;
    r->report.events = r->events;
    r->report.event_capacity = RIG_EVENTS;
    r->report.decisions = r->decisions;
    r->report.decision_capacity = RIG_DECISIONS;
    r->status = tahr_mover_step(r->mover, &r->input, dt, &r->state, &r->report);
    if (r->status < 0) {
        fail_msg("step at %g s failed: %s: %s", r->time, tahr_status_name(r->status), r->log.text);
    }
    r->time += dt;
    return r->status;
}

void rig_steps(rig *r, int n, double dt)
{
    for (int i = 0; i < n; i++) {
        rig_step(r, dt);
    }
}

void rig_settle(rig *r)
{
    tahr_input input = r->input;
    memset(&r->input.move, 0, sizeof r->input.move);
    r->input.jump = 0;
    for (int i = 0; i < 600; i++) {
        tahr_state before = r->state;
        rig_step(r, 1.0 / 60);
        if (r->state.mode == TAHR_MODE_WALKING && memcmp(&before, &r->state, sizeof before) == 0) {
            r->input = input;
            return;
        }
    }
    fail_msg("did not come to rest: mode %u at %g %g %g, velocity %g %g %g", r->state.mode, r->state.position.x,
             r->state.position.y, r->state.position.z, r->state.velocity.x, r->state.velocity.y, r->state.velocity.z);
}

const tahr_event *rig_event(const rig *r, uint32_t type)
{
    for (uint32_t i = 0; i < r->report.event_count; i++) {
        if (r->events[i].type == type) {
            return &r->events[i];
        }
    }
    return NULL;
}

const tahr_decision *rig_decision(const rig *r, uint32_t rule)
{
    for (uint32_t i = r->report.decision_count; i > 0; i--) {
        if (r->decisions[i - 1].rule == rule) {
            return &r->decisions[i - 1];
        }
    }
    return NULL;
}

void rig_assert_in_order(const rig *r, double dt)
{
    double before = 0;
    for (uint32_t i = 0; i < r->report.event_count; i++) {
        const tahr_event *e = &r->events[i];
        if (!(e->time >= before && e->time <= dt * (1 + 1e-12))) {
            fail_msg("event %u of %u, %s at %.17g: the one before was at %.17g, dt is %g", i, r->report.event_count,
                     tahr_event_name(e->type), e->time, before, dt);
        }
        before = e->time;
    }
}
