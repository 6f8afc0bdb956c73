/* SPDX-License-Identifier: MIT
 * test_energy.c: whatever the methods, nothing that stands still makes a character faster: its speed never passes the
 * larger of what was asked for and what it was, but for what gravity adds. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "parity.h"
#include "rig.h"

enum { BLOCKS = 24, METHODS = 128 };

/* Each bit another method. */
static tahr_config config_of(uint32_t bits)
{
    tahr_config c = bits & 1 ? parity_config() : rig_config();
    c.integrator = bits & 2 ? TAHR_INTEGRATOR_STEPPED : TAHR_INTEGRATOR_EXACT;
    c.slide_solver = bits & 4 ? TAHR_SLIDE_TWO_WALLS : TAHR_SLIDE_JOINT;
    c.step_rule = bits & 8 ? TAHR_STEP_BY_CONTACT : TAHR_STEP_BY_TREAD;
    c.floor_probe = bits & 16 ? TAHR_FLOOR_PROBE_SHRUNK : TAHR_FLOOR_PROBE_WHOLE;
    c.separation = bits & 32 ? TAHR_SEPARATION_PULL_BACK : TAHR_SEPARATION_MARGIN;
    c.depenetration = bits & 64 ? TAHR_DEPENETRATION_SINGLE : TAHR_DEPENETRATION_JOINT;
    c.air_control = 0;
    return c;
}

static void make_yard(tahr_body_desc *bodies, oracle_random *random)
{
    for (int i = 0; i < BLOCKS; i++) {
        double a = oracle_uniform(random, 0, 3), tilt = i % 4 == 3 ? oracle_uniform(random, 0, 1.2) : 0;
        assert_int_equal(tahr_body_desc_init(&bodies[i], sizeof bodies[i], TAHR_BODY_BOX), TAHR_OK);
        bodies[i].half_extents = dice_vec(random, 0.3, 1.5);
        bodies[i].pose.position = dice_vec(random, -4, 4);
        bodies[i].pose.position.z = bodies[i].half_extents.z * (i % 2 ? -0.8 : 1) + (i % 2 ? 0.2 : -0.1);
        bodies[i].pose.orientation = (tahr_quat){sin(tilt / 2) * cos(a / 2), sin(tilt / 2) * sin(a / 2),
                                                 cos(tilt / 2) * sin(a / 2), cos(tilt / 2) * cos(a / 2)};
    }
    if (getenv("OVER")) for (int i = 1; i < BLOCKS; i += 2) { bodies[i].walkable_rule = TAHR_WALKABLE_INCREASE; bodies[i].walkable_angle=1.3; }
    bodies[0].half_extents = fake_vec(2000, 2000, 1);
    bodies[0].pose.position = fake_vec(0, 0, -1);
    bodies[0].pose.orientation = (tahr_quat){0, 0, 0, 1};
}

static void sliding_and_stepping_make_nobody_faster(void **unused)
{
    static const double rates[] = {10, 30, 60, 300};
    const char *only = getenv("ONLY");
    (void)unused;
    for (uint32_t i = 0; i < 4 * METHODS * (getenv("SEEDS") ? (uint32_t)atoi(getenv("SEEDS")) : 2); i++) {
        tahr_body_desc bodies[BLOCKS];
        oracle_random random = {i + 5};
        uint32_t bits = i / 4 % METHODS;
        double rate = rates[i % 4], next = 0, worst = 0;
        tahr_config c = config_of(bits);
        rig r;
        int caps = 0;
        if (only && (uint32_t)atoi(only) != i) continue;
        make_yard(bodies, &random);
        rig_open_bodies(&r, bodies, BLOCKS, &c, fake_vec(0, 0, 4));
        for (int k = 0; k < (int)(10 * rate); k++) {
            const tahr_state before = r.state;
            if (r.time >= next) {
                double a = oracle_uniform(&random, -3.2, 3.2);
                int home = fabs(before.position.x) > 5 || fabs(before.position.y) > 5;
                r.input.move = home ? fake_vec(-before.position.x, -before.position.y, 0) : fake_vec(cos(a), sin(a), 0);
                next += 0.5;
            }
            rig_step(&r, 1 / rate);
            double was = length(before.velocity), is = length(r.state.velocity);
            double gain = is - (fmax(was, c.max_speed) - c.gravity.z / rate);
            if (gain > worst) worst = gain;
            caps += (r.report.flags & TAHR_REPORT_QUERY_CAP) != 0;
            if (only && gain > 1e-6) print_message("t %g mode %u->%u v (%g %g %g)->(%g %g %g) at %.4f %.4f %.4f\n", r.time, before.mode, r.state.mode, before.velocity.x, before.velocity.y, before.velocity.z, r.state.velocity.x, r.state.velocity.y, r.state.velocity.z, r.state.position.x, r.state.position.y, r.state.position.z);
        }
        if (worst > 1e-6 || caps) print_message("%u: bits %u%s%s%s%s%s%s rate %g: gain %g caps %d\n", i, bits, bits&1?" unreal":"", bits&2?" STEPPED":"", bits&4?" TWO":"", bits&8?" CONTACT":"", bits&16?" SHRUNK":"", bits&64?bits&32?" PULL SINGLE":" SINGLE":bits&32?" PULL":"", rate, worst, caps);
        rig_close(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(sliding_and_stepping_make_nobody_faster)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
