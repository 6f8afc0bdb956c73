/* SPDX-License-Identifier: MIT
 * test_custom_mode.c: a mode behind the caller's own function: what it sees and does, and what happens when it lies. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "pool.h"

/* One function for all tests: what it answers and does is in what user points to. */
typedef struct script {
    tahr_custom_next answer; /* time_left: of the time given */
    tahr_status status;
    tahr_vec3 motion;
    tahr_step_moved moved;
    int calls;
    double time; /* s given, in all */
    void (*looks)(struct script *s, tahr_step *step, double time);
    rig *r;
} script;

static tahr_status follow(void *user, tahr_step *step, double time, tahr_custom_next *next)
{
    script *s = user;
    s->calls++;
    s->time += time;
    assert_true(next->mode == TAHR_MODE_CUSTOM && next->time_left == 0 && next->reserved == 0);
    if (s->looks) {
        s->looks(s, step, time);
    }
    assert_int_equal(tahr_step_slide(step, &s->motion, &s->moved), TAHR_OK);
    *next = s->answer;
    next->time_left = s->answer.time_left * time;
    return s->status;
}

static void open_scripted(rig *r, script *s, fake_world *w, tahr_vec3 at)
{
    rig_open(r, w, NULL, at);
    memset(s, 0, sizeof *s);
    s->answer.mode = TAHR_MODE_CUSTOM;
    s->r = r;
    assert_int_equal(tahr_mover_set_custom_mode(r->mover, follow, s), TAHR_OK);
    r->state.mode = TAHR_MODE_CUSTOM;
}

static void see(script *s, tahr_step *step, double time)
{
    const tahr_vec3 down = {0, 0, -50}, *gravity = tahr_step_gravity(step);
    tahr_hit hit, ray;
    tahr_fluid fluid;
    assert_memory_equal(tahr_step_state(step), &s->r->state, offsetof(tahr_state, reserved));
    assert_ptr_equal(tahr_step_input(step), &s->r->input);
    assert_true(tahr_step_config(step)->max_speed == 6 && gravity->z == -9.81);
    assert_int_equal(tahr_step_sweep(step, &down, &hit), TAHR_OK);
    assert_near(hit.fraction, (7 - 0.9 - 0.01) / 50, 1e-12);
    assert_int_equal(tahr_step_ray(step, &tahr_step_state(step)->position, &down, &ray), TAHR_OK);
    assert_near(ray.fraction, (7 - 0.001) / 50, 1e-12); /* callbacks without rays: a sphere of a millimetre */
    assert_int_equal(tahr_step_fluid(step, &fluid), TAHR_OK);
    assert_true(fluid.immersion == 0 && fluid.body == TAHR_NO_BODY);
    assert_int_equal(tahr_step_event(step, 0.25 * time, 42), TAHR_OK);
    assert_true(tahr_step_state(step)->position.z == 7); /* looking moves nothing */
}

static void the_function_sees_the_step_and_uses_its_time(void **unused)
{
    fake_world w;
    rig r;
    script s;
    (void)unused;
    fake_world_flat(&w);
    open_scripted(&r, &s, &w, fake_vec(1, 2, 7));
    s.looks = see;
    s.motion = fake_vec(0.5, 0, 0);
    rig_step(&r, 0.125);
    const tahr_event *e = rig_event(&r, TAHR_EVENT_CUSTOM);
    assert_true(s.calls == 1 && s.time == 0.125);
    assert_true(e && e->value == 42 && e->time == 0.03125);
    assert_true(r.state.position.x == 1.5 && r.state.mode == TAHR_MODE_CUSTOM && s.moved.motion.x == 0.5);
    assert_string_equal(tahr_event_name(TAHR_EVENT_CUSTOM), "custom");
    rig_close(&r);
}

static void the_time_that_it_leaves_goes_to_the_next_mode(void **unused)
{
    fake_world w;
    rig r;
    script s;
    (void)unused;
    fake_world_flat(&w);
    open_scripted(&r, &s, &w, fake_vec(0, 0, 7));
    s.answer.mode = TAHR_MODE_FALLING;
    s.answer.time_left = 0.75;
    rig_step(&r, 0.2);
    const tahr_event *e = rig_event(&r, TAHR_EVENT_MODE);
    assert_true(e && e->value == TAHR_MODE_FALLING);
    assert_near(e->time, 0.05, 1e-15);
    assert_near(r.state.position.z, 7 - 0.5 * 9.81 * 0.15 * 0.15, 1e-12);
    rig_close(&r);
}

static void a_slide_never_enters_anything(void **unused)
{
    oracle_random seed = {77};
    fake_world w;
    rig r;
    script s;
    double least = INFINITY;
    (void)unused;
    fake_world_flat(&w);
    fake_add_plane(&w, fake_vec(-0.6, 0, -0.8), -4);
    fake_add_plane(&w, fake_vec(0, -1, 0), -3);
    fake_add_plane(&w, fake_vec(0.8, 0.6, 0), -3);
    fake_add_box(&w, fake_vec(-1, -1, 0), fake_vec(0, 0, 1.3));
    open_scripted(&r, &s, &w, fake_vec(1.2, 1, 1.2));
    for (int i = 0; i < 3000; i++) {
        s.motion = dice_vec(&seed, -3, 3);
        r.state.velocity = dice_vec(&seed, -5, 5);
        rig_step(&r, 1.0 / 60);
        double gap = fake_clearance(&w, &r.config.shape, r.state.position);
        least = fmin(least, gap);
        assert_true(gap > 0.01 - 1e-9);
        if (s.moved.hits) { /* and takes off the velocity what points into what it met last */
            tahr_vec3 v = r.state.velocity, n = s.moved.last.normal;
            assert_true(v.x * n.x + v.y * n.y + v.z * n.z > -1e-6);
        }
    }
    assert_true(least < 0.011); /* it was tried */
    rig_close(&r);
}

static void an_answer_that_is_none_ends_the_step_and_leaves_the_state(void **unused)
{
    static const struct {
        tahr_custom_next answer;
        tahr_status status;
        const char *field;
    } lies[] = {{{TAHR_MODE_CUSTOM, 0, 1.001}, 0, "time_left"},
                {{TAHR_MODE_CUSTOM, 0, -0.1}, 0, "time_left"},
                {{TAHR_MODE_CUSTOM, 0, NAN}, 0, "time_left"},
                {{TAHR_MODE_CUSTOM, 0, INFINITY}, 0, "time_left"},
                {{TAHR_MODE_HANGING, 0, 0}, 0, "mode"},
                {{99, 0, 0}, 0, "mode"},
                {{TAHR_MODE_FALLING, 3, 0}, 0, "reserved"},
                {{TAHR_MODE_FALLING, 0, 0}, TAHR_E_MEMORY, "status"},
                {{TAHR_MODE_FALLING, 0, 0}, TAHR_E_NULL, "status"}};
    (void)unused;
    for (size_t i = 0; i < sizeof lies / sizeof lies[0]; i++) {
        fake_world w;
        rig r;
        script s;
        fake_world_flat(&w);
        open_scripted(&r, &s, &w, fake_vec(0, 0, 7));
        s.motion = fake_vec(1, 1, 0);
        s.answer = lies[i].answer;
        s.status = lies[i].status;
        tahr_state before = r.state;
        assert_int_equal(tahr_mover_step(r.mover, &r.input, 0.1, &r.state, NULL), TAHR_E_BACKEND);
        assert_memory_equal(&before, &r.state, sizeof before);
        assert_non_null(strstr(r.log.text, lies[i].field));
        rig_close(&r);
    }
}

static void look_back(script *s, tahr_step *step, double time)
{
    tahr_state other = s->r->state;
    (void)step;
    assert_int_equal(tahr_mover_step(s->r->mover, &s->r->input, time, &other, NULL), TAHR_E_REENTRANT);
    assert_int_equal(tahr_mover_set_custom_mode(s->r->mover, NULL, NULL), TAHR_E_REENTRANT);
}

static void the_mover_refuses_to_be_called_from_inside(void **unused)
{
    fake_world w;
    rig r;
    script s;
    (void)unused;
    fake_world_flat(&w);
    open_scripted(&r, &s, &w, fake_vec(0, 0, 7));
    s.looks = look_back;
    rig_step(&r, 0.1);
    assert_int_equal(s.calls, 1);
    rig_close(&r);
}

static void ask_wrongly(script *s, tahr_step *step, double time)
{
    const tahr_vec3 nan = {0, NAN, 0}, fast = {2e5, 0, 0}, none = {0, 0, 0}, far = {0, 0, 3e7};
    tahr_hit hit;
    (void)s;
    const tahr_state before = *tahr_step_state(step);
    assert_int_equal(tahr_step_set_velocity(step, &nan), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_step_set_velocity(step, &fast), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_step_set_velocity(step, NULL), TAHR_E_NULL);
    assert_int_equal(tahr_step_slide(step, &nan, NULL), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_step_slide(step, &far, NULL), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_step_slide(step, NULL, NULL), TAHR_E_NULL);
    assert_int_equal(tahr_step_slide(step, &none, NULL), TAHR_OK);
    assert_int_equal(tahr_step_sweep(step, &nan, &hit), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_step_sweep(step, &none, NULL), TAHR_E_NULL);
    assert_int_equal(tahr_step_ray(step, &far, &none, &hit), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_step_ray(step, &none, &nan, &hit), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_step_fluid(step, NULL), TAHR_E_NULL);
    assert_int_equal(tahr_step_event(step, -1, 0), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_step_event(step, 2 * time, 0), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_step_event(step, 0, NAN), TAHR_E_ARGUMENT);
    assert_memory_equal(tahr_step_state(step), &before, offsetof(tahr_state, reserved));
}

static void wrong_arguments_are_refused_and_change_nothing(void **unused)
{
    fake_world w;
    rig r;
    script s;
    (void)unused;
    fake_world_flat(&w);
    open_scripted(&r, &s, &w, fake_vec(0, 0, 7));
    s.looks = ask_wrongly;
    rig_step(&r, 0.1);
    assert_int_equal(s.calls, 1);
    assert_int_equal(tahr_mover_set_custom_mode(NULL, follow, &s), TAHR_E_NULL);
    assert_null(tahr_step_state(NULL));
    assert_null(tahr_step_input(NULL));
    assert_null(tahr_step_config(NULL));
    assert_null(tahr_step_gravity(NULL));
    rig_close(&r);
}

static void without_a_function_the_mode_is_refused(void **unused)
{
    fake_world w;
    rig r;
    (void)unused;
    fake_world_flat(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 7));
    r.input.flags = TAHR_INPUT_MODE;
    r.input.mode = TAHR_MODE_CUSTOM;
    rig_step(&r, 0.1);
    assert_true(r.state.mode == TAHR_MODE_FALLING && (r.report.flags & TAHR_REPORT_MODE_REFUSED));
    r.state.mode = TAHR_MODE_CUSTOM;
    tahr_state before = r.state;
    rig_step(&r, 0.1);
    assert_true(r.report.flags & TAHR_REPORT_MODE_REFUSED);
    assert_memory_equal(&before, &r.state, sizeof before);
    rig_close(&r);
}

static void a_mode_of_ones_own_never_sleeps(void **unused)
{
    fake_world w;
    rig r;
    script s;
    (void)unused;
    fake_world_flat(&w);
    open_scripted(&r, &s, &w, fake_vec(0, 0, 7));
    for (int i = 0; i < 5; i++) { /* without a trace of decisions, which would keep any step awake */
        assert_int_equal(tahr_mover_step(r.mover, &r.input, 0.1, &r.state, NULL), TAHR_OK);
    }
    assert_int_equal(s.calls, 5);
    rig_close(&r);
}

static void a_function_that_uses_no_time_is_asked_a_few_times_and_no_more(void **unused)
{
    fake_world w;
    rig r;
    script s;
    (void)unused;
    fake_world_flat(&w);
    open_scripted(&r, &s, &w, fake_vec(0, 0, 7));
    s.answer.time_left = 1;
    rig_step(&r, 0.1);
    assert_int_equal(s.calls, 6);
    assert_near(r.report.time_lost, 0.1, 1e-15);
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_function_sees_the_step_and_uses_its_time),
        cmocka_unit_test(the_time_that_it_leaves_goes_to_the_next_mode),
        cmocka_unit_test(a_slide_never_enters_anything),
        cmocka_unit_test(an_answer_that_is_none_ends_the_step_and_leaves_the_state),
        cmocka_unit_test(the_mover_refuses_to_be_called_from_inside),
        cmocka_unit_test(wrong_arguments_are_refused_and_change_nothing),
        cmocka_unit_test(without_a_function_the_mode_is_refused),
        cmocka_unit_test(a_mode_of_ones_own_never_sleeps),
        cmocka_unit_test(a_function_that_uses_no_time_is_asked_a_few_times_and_no_more),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
