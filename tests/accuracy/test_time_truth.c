/* SPDX-License-Identifier: MIT
 * test_time_truth.c: movement in time against the closed forms of forms.h, after every step, at rates from 10 to
 * 10 000 Hz: the same second must be the same however it is cut. To 1e-9 of the way, of whatever backend. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>
#include <tahr/native.h>
#include <tahr/tahr.h>
#ifdef TAHR_HAVE_CCD
#include <tahr/ccd.h>
#endif
#ifdef TAHR_HAVE_FCL
#include <tahr/fcl.h>
#endif

#include "forms.h"
#include "score.h"

static const double RELATIVE = 1e-9;

/* m, m/s: rounding of positions of a few hundred metres. */
static const double ROUNDING = 1e-12;

typedef struct subject {
    const char *name;
    const tahr_backend *backend;
    const void *options;
    double landing; /* m: of the place where a fall ends, besides the chord's */
} subject;

/* A character on the floor z = 0 of a box, in the air above it, or in the water beside it. */
typedef struct stage {
    tahr_world *world;
    tahr_mover *mover;
    tahr_config config;
    tahr_state state;
    tahr_input input;
    tahr_report report;
    tahr_event events[16];
} stage;

static void open_stage(stage *s, const subject *who, uint32_t floor_flags)
{
    tahr_body_desc bodies[2];
    tahr_world_desc desc;

    memset(s, 0, sizeof *s);
    assert_int_equal(tahr_body_desc_init(&bodies[0], sizeof *bodies, TAHR_BODY_BOX), TAHR_OK);
    assert_int_equal(tahr_body_desc_init(&bodies[1], sizeof *bodies, TAHR_BODY_BOX), TAHR_OK);
    bodies[0].half_extents = (tahr_vec3){64, 64, 1};
    bodies[0].pose.position.z = -1;
    bodies[0].flags = floor_flags;
    bodies[1].half_extents = (tahr_vec3){64, 64, 64};
    bodies[1].pose.position = (tahr_vec3){256, 0, 0};
    bodies[1].flags = TAHR_BODY_FLUID | TAHR_BODY_SENSOR;
    assert_int_equal(tahr_world_desc_init(&desc, sizeof desc), TAHR_OK);
    desc.bodies = bodies;
    desc.body_count = 2;
    desc.options = who->options;
    assert_int_equal(tahr_world_open(who->backend, &desc, &s->world), TAHR_OK);
    assert_int_equal(tahr_config_init(&s->config, sizeof s->config, TAHR_PRESET_PRECISE), TAHR_OK);
    s->input.struct_size = sizeof s->input;
    s->report.struct_size = sizeof s->report;
    s->report.events = s->events;
    s->report.event_capacity = sizeof s->events / sizeof *s->events;
}

static void put(stage *s, tahr_vec3 at, tahr_vec3 velocity, uint32_t mode)
{
    assert_int_equal(tahr_mover_create(s->world, &s->config, &s->mover), TAHR_OK);
    assert_int_equal(tahr_state_init(&s->state, &s->config, &at), TAHR_OK);
    s->state.velocity = velocity;
    s->state.mode = mode;
}

static void step(stage *s, double dt)
{
    assert_int_equal(tahr_mover_step(s->mover, &s->input, dt, &s->state, &s->report), TAHR_OK);
}

/* On the floor, in the middle of the band in which nothing corrects the height. */
static void stand(stage *s)
{
    put(s, (tahr_vec3){0, 0, s->config.shape.half_height + s->config.skin * s->config.floor_target},
        (tahr_vec3){0, 0, 0}, TAHR_MODE_FALLING);
    for (int i = 0; i < 3; i++) {
        step(s, 1.0 / 64);
    }
    assert_int_equal(s->state.mode, TAHR_MODE_WALKING);
}

static void close_stage(stage *s)
{
    tahr_mover_destroy(s->mover);
    tahr_world_close(s->world);
}

/* How far a value is off, of what is allowed; the worst of a run is printed. */
static void hold(double *worst, double got, long double due)
{
    double part = (double)(fabsl(got - due) / (RELATIVE * fabsl(due) + ROUNDING));
    *worst = fmax(*worst, isnan(part) ? INFINITY : part);
}

typedef form_motion (*form_fn)(const stage *s, long double time);

/* One law: how it begins, which way it goes, what is due after a time. */
typedef struct law {
    const char *name;
    void (*begin)(stage *s);
    form_fn due;
    double duration;
    int vertical;
} law;

static void begin_running(stage *s)
{
    stand(s);
    s->input.move.x = 1;
}

static form_motion running(const stage *s, long double t)
{
    return form_capped(0, s->config.acceleration, s->config.max_speed, t);
}

static void begin_braking(stage *s)
{
    stand(s);
    s->state.velocity.x = s->config.max_speed;
}

static form_motion braking(const stage *s, long double t)
{
    return form_brake(s->config.max_speed, s->config.braking_deceleration, s->config.braking_drag, t);
}

static void begin_braking_evenly(stage *s)
{
    s->config.braking_drag = 0;
    begin_braking(s);
}

static void begin_jump(stage *s)
{
    stand(s);
    s->input.jump = 1;
}

static form_motion thrown(const stage *s, long double t)
{
    return form_thrown(s->config.jump_speed, -s->config.gravity.z, t);
}

static void begin_fall(stage *s)
{
    put(s, (tahr_vec3){0, 0, 400}, (tahr_vec3){0, 0, 0}, TAHR_MODE_FALLING);
}

static form_motion falling(const stage *s, long double t)
{
    form_motion m = form_capped(0, -s->config.gravity.z, s->config.terminal_speed, t);
    return (form_motion){-m.way, -m.speed};
}

static void begin_swimming(stage *s)
{
    put(s, (tahr_vec3){256, 0, 0}, (tahr_vec3){0, 0, 0}, TAHR_MODE_SWIMMING);
    s->input.move.x = 1;
}

static form_motion swimming(const stage *s, long double t)
{
    long double a = s->config.acceleration;
    return form_drag(0, a, a / s->config.swim_speed, t);
}

static void begin_drifting(stage *s)
{
    put(s, (tahr_vec3){256, 0, 0}, (tahr_vec3){3, 0, 0}, TAHR_MODE_SWIMMING);
}

static form_motion drifting(const stage *s, long double t)
{
    return form_drag(3, 0, s->config.fluid_friction, t);
}

static void begin_flying(stage *s)
{
    put(s, (tahr_vec3){0, 0, 50}, (tahr_vec3){0, 0, 0}, TAHR_MODE_FLYING);
    s->input.move.x = 1;
}

static form_motion flying(const stage *s, long double t)
{
    return form_capped(0, s->config.acceleration, s->config.fly_speed, t);
}

static void begin_gliding(stage *s)
{
    put(s, (tahr_vec3){0, 0, 50}, (tahr_vec3){5, 0, 0}, TAHR_MODE_FLYING);
}

/* Its drag ends as the drag at 1 mm/s would. */
static form_motion gliding(const stage *s, long double t)
{
    return form_brake(5, s->config.fly_drag * 1e-3, s->config.fly_drag, t);
}

static const law laws[] = {
    {"acceleration to the speed cap", begin_running, running, 1, 0},
    {"braking with drag", begin_braking, braking, 0.5, 0},
    {"braking evenly", begin_braking_evenly, braking, 0.5, 0},
    {"jump", begin_jump, thrown, 0.8, 1},
    {"fall to the terminal speed", begin_fall, falling, 5, 1},
    {"swimming", begin_swimming, swimming, 1, 0},
    {"drifting", begin_drifting, drifting, 1, 0},
    {"flying", begin_flying, flying, 1, 0},
    {"gliding", begin_gliding, gliding, 1, 0},
};

static const double rates[] = {10, 30, 60, 1000, 10000};

static double worst_of(const subject *who, const law *l, double rate)
{
    stage s;
    double worst = 0;

    open_stage(&s, who, 0);
    l->begin(&s);
    tahr_vec3 from = s.state.position;
    long steps = (long)(l->duration * rate + 0.5);
    for (long i = 1; i <= steps; i++) {
        step(&s, 1 / rate);
        form_motion due = l->due(&s, (long double)i * (1 / rate));
        hold(&worst, l->vertical ? s.state.position.z - from.z : s.state.position.x - from.x, due.way);
        hold(&worst, l->vertical ? s.state.velocity.z : s.state.velocity.x, due.speed);
        hold(&worst, s.state.position.y, 0);
    }
    close_stage(&s);
    return worst;
}

static void laws_hold_at_every_rate(void **state)
{
    const subject *who = *state;
    int failed = 0;

    print_message("of the way, at 10, 30, 60, 1000, 10000 Hz:\n");
    for (size_t i = 0; i < sizeof laws / sizeof *laws; i++) {
        print_message("%-14s %-30s", who->name, laws[i].name);
        for (size_t j = 0; j < sizeof rates / sizeof *rates; j++) {
            double worst = worst_of(who, &laws[i], rates[j]);
            print_message(" %8.1e", worst * RELATIVE);
            failed += !(worst <= 1);
        }
        print_message("\n");
    }
    assert_int_equal(failed, 0);
}

/* The highest point is told as an event, whose time and place do not depend on the rate. */
static void apex_is_told_where_it_is(void **state)
{
    const subject *who = *state;
    double worst = 0;
    int told = 0;

    for (size_t j = 0; j < sizeof rates / sizeof *rates; j++) {
        stage s;
        open_stage(&s, who, 0);
        begin_jump(&s);
        tahr_vec3 from = s.state.position;
        long double g = -s.config.gravity.z, v = s.config.jump_speed;
        for (long i = 0; i < (long)(0.5 * rates[j]); i++) {
            step(&s, 1 / rates[j]);
            for (uint32_t k = 0; k < s.report.event_count; k++) {
                if (s.events[k].type == TAHR_EVENT_APEX) {
                    hold(&worst, s.events[k].position.z - from.z, form_apex_height(v, g));
                    hold(&worst, (double)i / rates[j] + s.events[k].time, form_apex_time(v, g));
                    told++;
                }
            }
        }
        close_stage(&s);
    }
    assert_int_equal(told, sizeof rates / sizeof *rates);
    assert_true(worst <= 1);
}

/* It lands where its skin meets the floor; the chords that are swept may lie off the arc by config.arc_tolerance. */
static void jumps_land_in_time(void **state)
{
    const subject *who = *state;

    for (size_t j = 0; j < sizeof rates / sizeof *rates; j++) {
        stage s;
        double landed = -1;
        open_stage(&s, who, 0);
        begin_jump(&s);
        tahr_vec3 from = s.state.position;
        for (long i = 0; i < (long)(rates[j]) && landed < 0; i++) {
            step(&s, 1 / rates[j]);
            for (uint32_t k = 0; k < s.report.event_count; k++) {
                if (s.events[k].type == TAHR_EVENT_LANDED) {
                    landed = (double)i / rates[j] + s.events[k].time;
                }
            }
        }
        long double g = -s.config.gravity.z, v = s.config.jump_speed;
        long double down = s.config.shape.half_height + s.config.skin - from.z;
        long double due = form_landing_time(v, g, down), speed = -form_thrown(v, g, due).speed;
        double limit = (double)((s.config.arc_tolerance + who->landing) / speed);
        if (!(fabsl(landed - due) <= limit)) {
            fail_msg("%s at %g Hz: landed at %.17g, due at %.17Lg, allowed %g", who->name, rates[j], landed, due,
                     limit);
        }
        close_stage(&s);
    }
}

/* 2 m from the axis, a radian and a half a second, for two seconds. */
static void turntables_carry_on_the_exact_circle(void **state)
{
    const subject *who = *state;
    static const long double w = 1.5L;
    double worst = 0;

    for (size_t j = 0; j + 1 < sizeof rates / sizeof *rates; j++) {
        stage s;
        open_stage(&s, who, TAHR_BODY_MOVABLE);
        stand(&s);
        s.state.position.x = 2;
        s.state.floor_revision = 0;
        step(&s, 1.0 / 64);
        form_vec from = {s.state.position.x, s.state.position.y, s.state.position.z};
        for (long i = 1; i <= (long)(2 * rates[j]); i++) {
            long double half = w * (long double)i / rates[j] / 2;
            tahr_body_pose pose = {.body = 0, .pose = {{0, 0, -1}, {0, 0, (double)sinl(half), (double)cosl(half)}}};
            assert_int_equal(tahr_world_move(s.world, &pose, 1, 1 / rates[j]), TAHR_OK);
            step(&s, 1 / rates[j]);
            form_vec due = form_turntable(from, w, (long double)i / rates[j]);
            hold(&worst, s.state.position.x - (double)due.x + 2, 2); /* of the radius */
            hold(&worst, s.state.position.y - (double)due.y + 2, 2);
        }
        close_stage(&s);
    }
    if (!(worst <= 1)) {
        fail_msg("%s: %g times %g of the radius", who->name, worst, RELATIVE);
    }
}

/* From the third idle step on no bit of the state changes, and nothing jitters; sleeping is off, so all is computed. */
static void who_rests_rests_to_the_bit(void **state)
{
    static const double heights[] = {0.0025, 0.0125, 0.0137, 0.016, 0.3};
    const subject *who = *state;

    for (size_t i = 0; i < sizeof heights / sizeof *heights; i++) {
        stage s;
        score_path path;
        const score_path_desc desc = {.gravity = {0, 0, -9.81}};
        open_stage(&s, who, 0);
        s.config.sleep = 0;
        put(&s, (tahr_vec3){0.3, 0.7, s.config.shape.half_height + heights[i]}, (tahr_vec3){0, 0, 0},
            TAHR_MODE_FALLING);
        while (s.state.mode != TAHR_MODE_WALKING || s.state.velocity.z != 0) {
            step(&s, 1.0 / 60);
        }
        score_step at = score_step_of(&s.state, &s.config.shape, 0, TAHR_OK, NULL);
        score_path_start(&path, &desc, &at);
        tahr_state third = s.state;
        for (int k = 1; k <= 200; k++) {
            step(&s, 1.0 / 60);
            at = score_step_of(&s.state, &s.config.shape, k / 60.0, TAHR_OK, &s.report);
            at.idle = 1;
            score_path_add(&path, &at);
            if (k == 3) {
                third = s.state;
            }
            assert_true(k <= 3 || memcmp(&third, &s.state, sizeof third) == 0);
        }
        assert_int_equal(path.rest_changes, 0);
        assert_true(path.jitter == 0 && path.ground_flips == 0 && path.energy_excess == 0);
        score_path_free(&path);
        close_stage(&s);
    }
}

int main(void)
{
    subject native = {"native", tahr_backend_v1_native(), NULL, 1e-9};
#define OF(subject)                                                                                          \
    {"laws_hold_at_every_rate " #subject, laws_hold_at_every_rate, NULL, NULL, &subject},                    \
        {"apex_is_told_where_it_is " #subject, apex_is_told_where_it_is, NULL, NULL, &subject},              \
        {"jumps_land_in_time " #subject, jumps_land_in_time, NULL, NULL, &subject},                          \
        {"turntables_carry_on_the_exact_circle " #subject, turntables_carry_on_the_exact_circle, NULL, NULL, \
         &subject},                                                                                          \
        {"who_rests_rests_to_the_bit " #subject, who_rests_rests_to_the_bit, NULL, NULL, &subject}
#ifdef TAHR_HAVE_CCD
    subject ccd = {"ccd", tahr_backend_v1_ccd(), NULL, 1e-4};
#endif
#ifdef TAHR_HAVE_FCL
    subject fcl = {"fcl", tahr_backend_v1_fcl(), NULL, 1e-4};
#endif
    const struct CMUnitTest tests[] = {
        OF(native),
#ifdef TAHR_HAVE_CCD
        OF(ccd),
#endif
#ifdef TAHR_HAVE_FCL
        OF(fcl),
#endif
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
