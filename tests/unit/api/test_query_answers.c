/* SPDX-License-Identifier: MIT
 * test_query_answers.c: steps on backends that lie, that give up, that know no margin, that answer at random. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "fake_backend.h"
#include "rig.h"

static void lies_of_a_sweep_end_the_step_and_are_named(void **unused)
{
    fake_backend b;
    rig r;
    (void)unused;
    rig_open_backend(&r, &b, FAKE_BACKEND_ALL);
    for (int lie = 1; lie < LIES; lie++) {
        for (int mode = TAHR_MODE_WALKING; mode <= TAHR_MODE_FALLING; mode++) {
            tahr_report report, kept;
            r.state.mode = (uint32_t)mode;
            tahr_state before = r.state;
            memset(&report, 0x11, sizeof report);
            report.struct_size = sizeof report;
            report.events = NULL;
            report.decisions = NULL;
            report.queries = NULL;
            kept = report;
            b.lie = lie;
            r.log.count = 0;
            r.log.text[0] = 0;
            tahr_status status = tahr_mover_step(r.mover, &r.input, 0.2, &r.state, &report);
            if (status != TAHR_E_BACKEND) {
                fail_msg("lie %d (%s): %s", lie, lie_fields[lie], tahr_status_name(status));
            }
            assert_memory_equal(&before, &r.state, sizeof before);
            assert_memory_equal(&report, &kept, sizeof report);
            assert_non_null(strstr(r.log.text, lie_fields[lie]));
            assert_non_null(strstr(r.log.text, "sweep"));
            assert_int_equal(r.log.count, 1);
        }
    }
    b.lie = 0;
    assert_int_equal(tahr_mover_step(r.mover, &r.input, 0.2, &r.state, NULL), TAHR_OK);
    rig_close(&r);
}

static void lies_of_contacts_end_the_step_and_are_named(void **unused)
{
    fake_backend b;
    rig r;
    (void)unused;
    rig_open_backend(&r, &b, FAKE_BACKEND_ALL);
    r.state.position.z = 0.85; /* overlapped, so that contacts are asked for */
    for (int lie = 1; lie < CONTACT_LIES; lie++) {
        tahr_state before = r.state;
        b.contact_lie = lie;
        r.log.text[0] = 0;
        assert_int_equal(tahr_mover_step(r.mover, &r.input, 0.1, &r.state, NULL), TAHR_E_BACKEND);
        assert_memory_equal(&before, &r.state, sizeof before);
        assert_non_null(strstr(r.log.text, contact_lie_fields[lie]));
        assert_non_null(strstr(r.log.text, "contacts"));
    }
    rig_close(&r);
}

/* A floor at z = 0, from an engine of single precision or worse. */
static tahr_status meet_floor(void *user, const tahr_ray *query, tahr_hit *hit)
{
    (void)user;
    hit->blocking = 1;
    hit->fraction = -query->origin.z / query->motion.z;
    hit->normal = hit->surface_normal = fake_vec(0, 0, 1 - 9e-4);
    return TAHR_OK;
}

static tahr_status meet_nothing(void *user, const tahr_sweep *query, tahr_hit *hit)
{
    (void)user, (void)query, (void)hit;
    return TAHR_OK;
}

/* A state that held a normal of another length would be refused by the next step. */
static void normals_of_rays_are_made_exact(void **unused)
{
    const tahr_callbacks callbacks = {.struct_size = sizeof callbacks, .sweep = meet_nothing, .ray = meet_floor};
    const tahr_ray down = {.origin = {0, 0, 2}, .motion = {0, 0, -4}, .mask = 1, .ignore_body = TAHR_NO_BODY};
    tahr_world *world = NULL;
    tahr_hit hit;
    uint32_t count = 0;
    (void)unused;
    assert_int_equal(tahr_world_open_callbacks(&callbacks, NULL, &world), TAHR_OK);
    assert_int_equal(tahr_world_ray(world, &down, &hit, &count), TAHR_OK);
    assert_int_equal(count, 1);
    assert_true(fabs(hit.normal.z - 1) < 1e-15 && fabs(hit.surface_normal.z - 1) < 1e-15);
    tahr_world_close(world);
}

/* Walks, or falls sideways, into a wall at x = 3 that the backend cannot decide. */
static void meet_the_unknown(int how, int mode)
{
    fake_backend b;
    rig r;
    uint32_t unknown_steps = 0;
    rig_open_backend(&r, &b, FAKE_BACKEND_ALL);
    fake_add_plane(&b.world, fake_vec(-1, 0, 0), -3);
    b.unknown = how;
    b.unknown_body = 1;
    if (mode == TAHR_MODE_FALLING) {
        r.state.position.z = 30;
        r.state.velocity = fake_vec(6, 0, 0);
    }
    r.input.move = fake_vec(1, 0, 0);
    for (int i = 0; i < 60; i++) {
        double before = r.state.position.x;
        rig_step(&r, 1.0 / 60);
        int unknown = (r.report.flags & TAHR_REPORT_UNKNOWN) != 0;
        assert_int_equal(r.status == TAHR_UNKNOWN || r.status == TAHR_STUCK, unknown);
        assert_true(r.state.position.x <= 3 - 0.35 - 0.01 + 1e-12);
        if (unknown) {
            unknown_steps++;
            assert_near(r.state.position.x, 3 - 0.35 - 0.01, 1e-9);
            assert_true(r.report.time_lost > 0);
        } else {
            assert_true(r.state.position.x > before || i == 0);
        }
    }
    assert_true(unknown_steps > 1);
    rig_close(&r);
}

static void unknown_blocks_at_the_last_free_fraction_with_a_flag(void **unused)
{
    (void)unused;
    meet_the_unknown(UNKNOWN_BLOCKING, TAHR_MODE_WALKING);
    meet_the_unknown(UNKNOWN_BLOCKING, TAHR_MODE_FALLING);
}

static void unknown_that_does_not_say_blocking_blocks_all_the_same(void **unused)
{
    (void)unused;
    meet_the_unknown(UNKNOWN_ALONE, TAHR_MODE_WALKING);
    meet_the_unknown(UNKNOWN_ALONE, TAHR_MODE_FALLING);
}

static void unknown_with_garbage_beside_it_blocks_all_the_same(void **unused)
{
    (void)unused;
    meet_the_unknown(UNKNOWN_GARBAGE, TAHR_MODE_WALKING);
    meet_the_unknown(UNKNOWN_GARBAGE, TAHR_MODE_FALLING);
}

static int is_finite_state(const tahr_state *s)
{
    const tahr_floor *f = &s->floor;
    const tahr_vec3 v[] = {s->position, s->velocity, s->up, f->normal, f->point, f->surface_normal, s->floor_position};
    double sum = s->orientation.x + s->orientation.y + s->orientation.z + s->orientation.w;
    for (size_t i = 0; i < sizeof v / sizeof v[0]; i++) {
        sum += v[i].x + v[i].y + v[i].z;
    }
    return isfinite(sum + f->distance + f->perch_distance + s->jump_hold);
}

/* The plane below, or the wall beside, walking into it, falling onto it, standing there. */
static void garbage_beside_unknown_leaves_a_finite_state(void **unused)
{
    (void)unused;
    for (int how = UNKNOWN_ALONE; how < UNKNOWN_KINDS; how++) {
        for (int scene = 0; scene < 8; scene++) {
            fake_backend b;
            rig r;
            uint32_t unknown = 0;
            rig_open_backend(&r, &b, scene & 4 ? FAKE_BACKEND_ALL & ~(uint32_t)TAHR_CAP_MARGIN : FAKE_BACKEND_ALL);
            fake_add_plane(&b.world, fake_vec(-1, 0, 0), -3);
            b.unknown = how;
            b.unknown_body = (uint32_t)(scene & 1);
            if (scene & 2) {
                r.state.mode = TAHR_MODE_WALKING;
            }
            for (int i = 0; i < 90; i++) {
                r.input.move = fake_vec(i < 60, 0, 0);
                r.input.jump = i == 70;
                rig_step(&r, 1.0 / 30);
                assert_true(is_finite_state(&r.state));
                assert_true(r.state.position.x <= 3 - 0.36 + 1e-6 && r.state.position.z >= 0.91 - 1e-6);
                for (uint32_t k = 0; k < r.report.event_count; k++) {
                    const tahr_event *e = &r.events[k];
                    assert_true(isfinite(e->value + e->time + e->normal.x + e->normal.y + e->normal.z));
                }
                unknown += (r.report.flags & TAHR_REPORT_UNKNOWN) != 0;
            }
            assert_true(unknown > 0);
            rig_close(&r);
        }
    }
}

/* Wrong but well-formed answers: the result is finite, within the cap, and no farther than asked. */
static void random_answers_never_break_the_promises(void **unused)
{
    const double dts[] = {1.0 / 60, 0.1, 1, 1e-3};
    fake_backend b;
    rig r;
    uint32_t most = 0;
    (void)unused;
    rig_open_backend(&r, &b, FAKE_BACKEND_ALL);
    b.random = 1;
    for (int i = 0; i < 20000; i++) {
        double dt = dts[i % 4];
        if (i % 20 == 0) {
            r.input.move = dice_direction(&b.seed);
            r.input.jump = i % 40 == 0;
            r.state.velocity = fake_vec(0, 0, 0);
            r.state.position = fake_vec(0, 0, 1);
        }
        if (i % 50 == 0) {
            r.input.flags = TAHR_INPUT_GRAVITY * (uint32_t)(i % 100 == 0);
            r.input.gravity = dice_direction(&b.seed);
        }
        tahr_state before = r.state;
        b.asked = 0;
        rig_step(&r, dt);
        most = b.asked > most ? b.asked : most;
        assert_true(b.asked <= TAHR_MAX_QUERIES_PER_STEP);
        assert_int_equal(b.asked, r.report.sweeps + r.report.contact_queries + r.report.rays);
        tahr_vec3 p = r.state.position, v = r.state.velocity, q = before.position, u = before.velocity;
        assert_true(isfinite(p.x + p.y + p.z + v.x + v.y + v.z) && isfinite(r.state.floor.distance));
        double travel = sqrt((p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y) + (p.z - q.z) * (p.z - q.z));
        double speed = fmax(sqrt(u.x * u.x + u.y * u.y + u.z * u.z), 6) + 9.81 * dt + 4.2;
        /* asked for, and in every slice a push of max_depenetration, a step, a snap; turning about the foot */
        double allowed = speed * dt + (1 + 0.4 + 0.8 + 0.015) * r.report.slices + 2 * 0.9;
        if (travel > allowed) {
            fail_msg("step %d: travelled %g, asked %g in %u slices", i, travel, speed * dt, r.report.slices);
        }
        for (int k = 0; k < (int)sizeof r.state.reserved; k++) {
            assert_int_equal(r.state.reserved[k], 0);
        }
        rig_assert_in_order(&r, dt);
    }
    assert_true(most > 20);
    rig_close(&r);
}

static void a_backend_without_margin_walks_the_same_path(void **unused)
{
    fake_backend backends[2];
    rig with, without;
    (void)unused;
    rig_open_backend(&with, &backends[0], FAKE_BACKEND_ALL);
    rig_open_backend(&without, &backends[1], FAKE_BACKEND_ALL & ~(uint32_t)TAHR_CAP_MARGIN);
    fake_add_plane(&backends[0].world, fake_vec(-1, 0, 0), -3);
    fake_add_plane(&backends[1].world, fake_vec(-1, 0, 0), -3);
    for (int i = 0; i < 200; i++) {
        with.input.move = without.input.move = fake_vec(0.8, 0.6, 0);
        with.input.jump = without.input.jump = i == 30;
        assert_int_equal(rig_step(&with, 1.0 / 60), TAHR_OK);
        assert_int_equal(rig_step(&without, 1.0 / 60), TAHR_OK);
        assert_int_equal(with.state.mode, without.state.mode);
        assert_near(with.state.position.x, without.state.position.x, 1e-6);
        assert_near(with.state.position.y, without.state.position.y, 1e-6);
        assert_near(with.state.position.z, without.state.position.z, 1e-6);
        assert_true(fake_clearance(&backends[1].world, &without.config.shape, without.state.position) > 0.01 - 1e-6);
    }
    assert_near(without.state.position.x, 3 - 0.36, 1e-6); /* the wall was met */
    rig_close(&with);
    rig_close(&without);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(lies_of_a_sweep_end_the_step_and_are_named),
                                       cmocka_unit_test(lies_of_contacts_end_the_step_and_are_named),
                                       cmocka_unit_test(normals_of_rays_are_made_exact),
                                       cmocka_unit_test(unknown_blocks_at_the_last_free_fraction_with_a_flag),
                                       cmocka_unit_test(unknown_that_does_not_say_blocking_blocks_all_the_same),
                                       cmocka_unit_test(unknown_with_garbage_beside_it_blocks_all_the_same),
                                       cmocka_unit_test(garbage_beside_unknown_leaves_a_finite_state),
                                       cmocka_unit_test(random_answers_never_break_the_promises),
                                       cmocka_unit_test(a_backend_without_margin_walks_the_same_path)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
