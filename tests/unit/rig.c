/* SPDX-License-Identifier: MIT
 * rig.c: a character in a fake world, an allocator that counts and fails, a log that remembers. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fake_world.h"

tahr_config fake_config(void)
{
    tahr_config c;
    assert_int_equal(tahr_config_init(&c, sizeof c, TAHR_PRESET_PRECISE), TAHR_OK);
    return c;
}

void rig_open(rig *r, fake_world *world, const tahr_config *config, tahr_vec3 at)
{
    tahr_callbacks callbacks = {
        .struct_size = sizeof callbacks, .user = world, .sweep = fake_sweep, .contacts = fake_contacts};
    memset(r, 0, sizeof *r);
    r->config = config ? *config : fake_config();
    assert_int_equal(tahr_world_open_callbacks(&callbacks, NULL, &r->world), TAHR_OK);
    assert_int_equal(tahr_mover_create(r->world, &r->config, &r->mover), TAHR_OK);
    assert_int_equal(tahr_state_init(&r->state, &r->config, &at), TAHR_OK);
    r->input.struct_size = sizeof r->input;
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
        fail_msg("step failed: %s", tahr_status_name(r->status));
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

/* In front of every block: what was asked for, and where malloc's memory begins. */
typedef struct block {
    void *start;
    size_t size, alignment;
} block;

static void *memory_alloc(void *user, size_t size, size_t alignment)
{
    fake_memory *m = user;
    m->requests++;
    if (m->fail_at && m->requests >= m->fail_at) {
        return NULL;
    }
    char *start = malloc(size + alignment + sizeof(block));
    assert_non_null(start);
    size_t at = ((size_t)(uintptr_t)start + sizeof(block) + alignment - 1) & ~(alignment - 1);
    char *memory = start + (at - (size_t)(uintptr_t)start);
    block b = {start, size, alignment};
    memcpy(memory - sizeof b, &b, sizeof b);
    memset(memory, 0xA5, size);
    m->live_blocks++;
    m->live_bytes += size;
    return memory;
}

static void memory_free(void *user, void *memory, size_t size, size_t alignment)
{
    fake_memory *m = user;
    block b;
    if (!memory) {
        m->mismatches++;
        return;
    }
    memcpy(&b, (char *)memory - sizeof b, sizeof b);
    m->mismatches += b.size != size || b.alignment != alignment;
    m->live_blocks--;
    m->live_bytes -= b.size;
    free(b.start);
}

tahr_allocator fake_allocator(fake_memory *memory)
{
    tahr_allocator a = {memory, memory_alloc, memory_free};
    return a;
}

static void keep_message(void *user, int32_t level, const char *message)
{
    fake_log *log = user;
    (void)level;
    log->count++;
    snprintf(log->text, sizeof log->text, "%s", message);
}

tahr_log fake_log_of(fake_log *log)
{
    tahr_log l = {log, keep_message};
    memset(log, 0, sizeof *log);
    return l;
}

void fake_assert_near(double a, double b, double tolerance, const char *what, const char *file, int line)
{
    if (!(fabs(a - b) <= tolerance)) {
        print_error("%s: %.17g and %.17g differ by %.3g, more than %.3g\n", what, a, b, a - b, tolerance);
        _fail(file, line);
    }
}
