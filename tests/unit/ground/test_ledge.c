/* SPDX-License-Identifier: MIT
 * test_ledge.c: what happens at the end of a floor that never began. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "floor.h"
#include "ledge.h"
#include "rig.h"
#include "step_in_progress.h"

/* A step in progress of the rig's mover, as mover.c would make it, without a time. */
static tahr__step begin(rig *r)
{
    tahr__step step = step_in_progress(r);
    step.report.decisions = r->decisions;
    step.report.decision_capacity = RIG_DECISIONS;
    return step;
}

/* Stands at x = 0 on a platform that ends at x = 2. */
static void stand_on_platform(rig *r, fake_world *w)
{
    fake_world_init(w);
    fake_add_box(w, fake_vec(-5, -5, -1), fake_vec(2, 5, 0));
    rig_stand(r, w, NULL, fake_vec(0, 0, 1));
}

static void a_whole_way_without_floor_ends_where_it_began(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    stand_on_platform(&r, &w);
    tahr__step step = begin(&r);
    tahr__path path;
    memset(&path, 0, sizeof path);
    path.from = fake_vec(10, 0, 0.9125);
    step.state.position = fake_vec(11, 0, 0.9125);
    step.state.velocity = fake_vec(6, 0, 0);
    tahr_floor beyond;
    tahr__find_floor(&step, step.config->snap_distance, NULL, &beyond);
    tahr__stay_on_ledge(&step, &path, &beyond);
    tahr_vec3 p = step.state.position, v = step.state.velocity;
    assert_true(p.x == 10 && p.y == 0 && p.z == 0.9125 && v.x == 0 && v.y == 0 && v.z == 0);
    const tahr_decision *d = &r.decisions[step.report.decision_count - 1];
    assert_int_equal(d->rule, TAHR_RULE_LEDGE);
    assert_int_equal(d->accepted, 0);
    assert_string_equal(d->reason, "no floor on the way here");
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_whole_way_without_floor_ends_where_it_began)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
