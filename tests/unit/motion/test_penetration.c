/* SPDX-License-Identifier: MIT
 * test_penetration.c: what ResolvePenetration tries, and in which order: told by a world that answers as it is scripted
 * and remembers what it was asked. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "move.h"
#include "near.h"
#include "parity.h"

enum { SWEEPS = 8 };

typedef struct script {
    vec3 overlaps[SWEEPS]; /* normal of the overlap that each sweep starts in, 2 cm deep; zero: free */
    uint32_t contacts;     /* answered by the test whether it fits */
    uint32_t sweeps, tests;
    tahr_sweep asked[SWEEPS];
    tahr_contact_query tested;
} script;

static tahr_status answer_sweep(void *user, const tahr_sweep *query, tahr_hit *hit)
{
    script *s = user;
    assert_true(s->sweeps < SWEEPS);
    vec3 n = s->overlaps[s->sweeps];
    s->asked[s->sweeps++] = *query;
    if (length_squared(n) > 0) {
        hit->blocking = hit->start_overlap = 1;
        hit->depth = 0.02;
        hit->normal = n;
    }
    return TAHR_OK;
}

static tahr_status answer_contacts(void *user, const tahr_contact_query *query, tahr_contact *contacts,
                                   uint32_t capacity, uint32_t *count)
{
    script *s = user;
    (void)capacity;
    s->tests++;
    s->tested = *query;
    *count = s->contacts;
    contacts[0].distance = -0.01;
    contacts[0].normal = contacts[0].surface_normal = vec(0, 0, -1);
    return TAHR_OK;
}

static void open_script(parity *p, script *s)
{
    tahr_callbacks callbacks = {
        .struct_size = sizeof callbacks, .user = s, .sweep = answer_sweep, .contacts = answer_contacts};
    parity_open_callbacks(p, &callbacks, NULL);
}

static void assert_asked(const script *s, uint32_t i, uint32_t flags, double x, double y, double z)
{
    vec3 m = s->asked[i].motion;
    if (length(sub(scale(m, 100), vec(x, y, z))) > 1e-9 || s->asked[i].flags != flags) {
        fail_msg("sweep %u by (%g, %g, %g) cm with flags %u, expected (%g, %g, %g) with %u", i, 100 * m.x, 100 * m.y,
                 100 * m.z, s->asked[i].flags, x, y, z, flags);
    }
    assert_near(s->asked[i].margin, 0, 0);
}

static const uint32_t LEAVE = TAHR_SWEEP_LEAVE_OVERLAP;

/* 10 cm along x + y; out of the first surface along x, out of the second one along y, by 2.125 cm each. */
static int run(script *s, parity *p)
{
    tahr__swept swept;
    open_script(p, s);
    int moved = tahr__safe_move(&p->step, parity_vec(10, 5, 0), &swept);
    parity_close(p);
    return moved;
}

static void what_fits_is_moved_at_once_and_the_whole_motion_made_again(void **unused)
{
    script s = {.overlaps = {{1, 0, 0}}};
    parity p;
    (void)unused;
    assert_int_equal(run(&s, &p), 1);
    assert_int_equal(s.sweeps, 2);
    assert_int_equal(s.tests, 1);
    assert_asked(&s, 0, 0, 10, 5, 0);
    assert_asked(&s, 1, LEAVE, 10, 5, 0); /* not what is left of it */
    assert_near(s.asked[1].position.x, 0.02125, 1e-12);
    assert_near(s.tested.position.x, 0.02125, 1e-12); /* 0.1 cm larger all round, there */
    assert_near(s.tested.shape.radius, 0.341, 1e-12);
    assert_near(s.tested.shape.half_height, 0.881, 1e-12);
    assert_near(s.tested.margin, 0, 0);
    assert_near(p.step.state.position.x, 0.12125, 1e-12);
}

static void what_does_not_fit_is_swept_by_both_pushes_then_with_the_motion_then_by_the_motion(void **unused)
{
    static const double expected[4][3] = {{2.125, 0, 0}, {2.125, 2.125, 0}, {12.125, 5, 0}, {10, 5, 0}};
    (void)unused;
    for (uint32_t free = 1; free <= 5; free++) { /* the first of these sweeps that is; 5: none */
        script s = {.overlaps = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}}, .contacts = 1};
        parity p;
        for (uint32_t i = free; i < SWEEPS; i++) {
            s.overlaps[i] = vec(0, 0, 0);
        }
        int moved = run(&s, &p);
        assert_int_equal(moved, free < 5);
        assert_int_equal(s.tests, 1);
        assert_int_equal(s.sweeps, free < 5 ? free + 2 : 5);
        assert_true(p.step.queries <= TAHR__SAFE_MOVE_QUERIES);
        assert_asked(&s, 0, 0, 10, 5, 0);
        for (uint32_t i = 0; i < free && i < 4; i++) {
            assert_asked(&s, i + 1, LEAVE, expected[i][0], expected[i][1], expected[i][2]);
        }
        assert_int_equal(p.step.just_teleported, free < 5);
        assert_int_equal((p.step.report.flags & TAHR_REPORT_CRUSHED) != 0, free == 5);
        assert_int_equal(p.events[0].type, free < 5 ? TAHR_EVENT_DEPENETRATED : TAHR_EVENT_CRUSHED);
        assert_near(p.step.report.residual, free < 5 ? 0 : 0.02, 1e-15);
    }
}

/* The motion alone is only tried if it leads out; a second surface is only asked if the pushes differ and do not
 * cancel. */
static void attempts_that_cannot_help_are_not_made(void **unused)
{
    script back = {.overlaps = {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 1}}, .contacts = 1};
    script same = {.overlaps = {{1, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 0, 1}}, .contacts = 1};
    script opposite = {.overlaps = {{1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, 1}}, .contacts = 1};
    parity p;
    (void)unused;
    assert_int_equal(run(&back, &p), 0);
    assert_int_equal(back.sweeps, 4); /* -x is against the motion */
    assert_asked(&back, 3, LEAVE, 10 - 2.125, 5, 0);
    assert_int_equal(run(&same, &p), 0);
    assert_int_equal(same.sweeps, 4);
    assert_asked(&same, 2, LEAVE, 12.125, 5, 0);
    assert_int_equal(run(&opposite, &p), 0);
    assert_int_equal(opposite.sweeps, 4);
    assert_asked(&opposite, 2, LEAVE, 12.125, 5, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_fits_is_moved_at_once_and_the_whole_motion_made_again),
        cmocka_unit_test(what_does_not_fit_is_swept_by_both_pushes_then_with_the_motion_then_by_the_motion),
        cmocka_unit_test(attempts_that_cannot_help_are_not_made)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
