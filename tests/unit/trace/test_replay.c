/* SPDX-License-Identifier: MIT
 * test_replay.c: what is recorded of a world repeats without its backend, and what is not the same is found. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <tahr/native.h>
#ifdef TAHR_HAVE_CCD
#include <tahr/ccd.h>
#endif

#include "recording.h"
#include "room.h"

static void expect_repeated(recording *file, uint64_t steps, uint64_t hash)
{
    replay p = {0};
    replay_run(&p, file);
    if (p.opened < 0 || p.read < 0 || p.differs || !p.ended) {
        fail_msg("step %llu: %s; %s", (unsigned long long)p.steps, p.how, file->message);
    }
    assert_true(p.steps == steps);
    assert_true(tahr_state_hash(&p.state) == hash);
    recording_free(file);
}

enum { ROOM_STEPS = 900 };

/* Everything at once: a lift, a belt, water, sensors, crates, launches, crouching, modes; from `first` on it is
 * watched. Returns the hash of all states. */
static uint64_t play_room(uint32_t preset, int first, recording *file, uint64_t *last)
{
    rig r;
    tahr_trace *trace = NULL;
    oracle_random dice = {7};
    uint64_t hash = 0;
    room_open(&r, preset, 1);
    for (int n = 0; n < ROOM_STEPS; n++) {
        room_move(&r, n);
        room_carry(&r, n);
        if (n == first) {
            trace = recording_begin(file, r.world, 0);
            assert_non_null(trace);
        }
        r.input = room_input(&dice);
        room_step(&r);
        hash = hash * 31 + tahr_state_hash(&r.state);
    }
    *last = tahr_state_hash(&r.state);
    if (trace) {
        uint64_t steps, queries, bytes;
        tahr_trace_size(trace, &steps, &queries, &bytes);
        assert_true(steps == (uint64_t)(ROOM_STEPS - first));
        assert_true(queries > steps / 2);
        assert_int_equal(recording_end(trace, r.world), TAHR_OK);
        assert_true(file->size >= bytes && file->size < bytes + 64);
    }
    rig_close(&r);
    return hash;
}

static void a_run_with_everything_in_it_repeats_whenever_it_was_begun(void **unused)
{
    (void)unused;
    for (uint32_t preset = TAHR_PRESET_PRECISE; preset <= TAHR_PRESET_UNREAL; preset++) {
        for (int first = 0; first < 400; first += 57) {
            recording file = {0};
            uint64_t last;
            play_room(preset, first, &file, &last);
            expect_repeated(&file, (uint64_t)(ROOM_STEPS - first), last);
        }
    }
}

static void being_watched_changes_no_bit(void **unused)
{
    recording file = {0};
    uint64_t last;
    (void)unused;
    assert_true(play_room(TAHR_PRESET_PRECISE, 100, &file, &last) ==
                play_room(TAHR_PRESET_PRECISE, ROOM_STEPS, NULL, &last));
    recording_free(&file);
}

/* A user's own engine, with a floor that sinks: bodies and touches come from callbacks. */
static tahr_status sinking(void *user, uint32_t body, tahr_body_motion *motion)
{
    (void)user, (void)body;
    motion->velocity.z = -0.1;
    return TAHR_OK;
}

static tahr_status pool(void *user, const tahr_fluid_query *query, tahr_fluid *fluid)
{
    (void)user;
    fluid->immersion = query->position.x > 3 ? 1 : 0;
    fluid->body = 9;
    return TAHR_OK;
}

static tahr_status gate(void *user, const tahr_sweep *query, tahr_hit *hits, uint32_t capacity, uint32_t *count)
{
    const double x = query->position.x, to = x + query->motion.x;
    (void)user, (void)capacity;
    if (x < 2 && to >= 2) {
        hits[0].fraction = (2 - x) / query->motion.x;
        hits[0].body = 5;
        *count = 1;
    }
    return TAHR_OK;
}

static void a_run_over_own_callbacks_repeats(void **unused)
{
    fake_world w;
    rig r;
    recording file = {0};
    (void)unused;
    fake_world_flat(&w);
    fake_add_box(&w, fake_vec(1, -5, -1), fake_vec(40, 5, 0.3));
    tahr_callbacks c = fake_callbacks(&w);
    c.body = sinking, c.fluid = pool, c.sensors = gate;
    rig_open_callbacks(&r, &c, NULL, fake_vec(0, 0, 1));
    tahr_world_touch(r.world);
    tahr_trace *trace = recording_begin(&file, r.world, 0);
    r.input.move = fake_vec(1, 0.2, 0);
    for (int i = 0; i < 120; i++) {
        if (i % 16 == 3) {
            assert_int_equal(tahr_world_touch(r.world), TAHR_OK);
        }
        rig_step(&r, 1.0 / 60);
    }
    assert_int_equal(r.state.mode, TAHR_MODE_SWIMMING);
    assert_int_equal(recording_end(trace, r.world), TAHR_OK);
    expect_repeated(&file, 120, tahr_state_hash(&r.state));
    rig_close(&r);
}

/* A floor and a wall across x = 2, handed over triangle by triangle. */
static tahr_status corner_of_a_room(void *user, const tahr_bounds *box, uint32_t mask, tahr_gather *out)
{
    static const tahr_vec3 p[] = {{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}, {2, -9, -1}, {2, 9, -1}, {2, 9, 5}};
    static const int corners[3][3] = {{0, 1, 2}, {0, 2, 3}, {4, 6, 5}};
    (void)user, (void)box, (void)mask;
    for (int i = 0; i < 3; i++) {
        tahr_triangle t = {.body = 7, .feature = (uint32_t)i};
        for (int k = 0; k < 3; k++) {
            t.corners[k] = p[corners[i][k]];
        }
        out->add(out, &t);
    }
    return TAHR_OK;
}

static void walk_and_jump(rig *r)
{
    for (int i = 0; i < 180; i++) {
        r->input.move = fake_vec(i < 120 ? 0.7 : -0.3, i % 50 < 25 ? 0.2 : -0.2, 0);
        r->input.jump = i % 45 == 20;
        rig_step(r, 1.0 / 60);
    }
}

static void a_run_over_gathered_triangles_repeats_without_them(void **unused)
{
    rig r = {0};
    recording file = {0};
    tahr_native_desc native = {.struct_size = sizeof native, .gather = corner_of_a_room};
    const tahr_vec3 at = {0, 0, 0.95};
    tahr_world_desc desc;
    (void)unused;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.options = &native;
    r.config = rig_config();
    r.input.struct_size = sizeof r.input;
    assert_int_equal(tahr_world_open(tahr_backend_v1_native(), &desc, &r.world), TAHR_OK);
    assert_int_equal(tahr_mover_create(r.world, &r.config, &r.mover), TAHR_OK);
    assert_int_equal(tahr_state_init(&r.state, &r.config, &at), TAHR_OK);
    tahr_trace *trace = recording_begin(&file, r.world, 0);
    walk_and_jump(&r);
    assert_true(r.state.position.x < 2 - 0.35 && r.state.jump_count == 0);
    assert_int_equal(recording_end(trace, r.world), TAHR_OK);
    expect_repeated(&file, 180, tahr_state_hash(&r.state));
    rig_close(&r);
}

#ifdef TAHR_HAVE_CCD
/* The hull of the last one is lent by a body, of which a replay knows no corner. */
static void characters_of_every_shape_repeat(void **unused)
{
    static const double corners[] = {-0.3, -0.4, -0.8, 0.3, -0.4, -0.8, 0, 0.4, -0.8,
                                     -0.2, -0.2, 0.8,  0.2, -0.2, 0.8,  0, 0.3, 0.8};
    const tahr_shape shapes[] = {
        {.type = TAHR_SHAPE_CYLINDER, .radius = 0.3, .half_height = 0.9},
        {.type = TAHR_SHAPE_CONE, .radius = 0.4, .half_height = 0.9},
        {.type = TAHR_SHAPE_ELLIPSOID, .half_x = 0.3, .half_y = 0.4, .half_height = 0.9},
        {.type = TAHR_SHAPE_HULL, .hull = 1, .half_x = 0.3, .half_y = 0.4, .half_height = 0.8},
    };
    tahr_body_desc bodies[3];
    (void)unused;
    tahr_body_desc_init(&bodies[0], sizeof bodies[0], TAHR_BODY_BOX);
    bodies[0].half_extents = fake_vec(20, 20, 1);
    bodies[0].pose.position.z = -1;
    tahr_body_desc_init(&bodies[1], sizeof bodies[1], TAHR_BODY_HULL);
    bodies[1].vertices = corners;
    bodies[1].vertex_count = 6;
    bodies[1].flags = TAHR_BODY_TEMPLATE;
    tahr_body_desc_init(&bodies[2], sizeof bodies[2], TAHR_BODY_BOX);
    bodies[2].half_extents = fake_vec(1, 2, 0.15);
    bodies[2].pose.position = fake_vec(3, 0, 0.15);
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        rig r;
        recording file = {0};
        tahr_config config = rig_config();
        config.shape = shapes[i];
        config.crouched_half_height = shapes[i].half_height;
        rig_open_bodies_on(&r, tahr_backend_v1_ccd(), bodies, 3, &config, fake_vec(0, 0, 0.95));
        tahr_trace *trace = recording_begin(&file, r.world, 0);
        walk_and_jump(&r);
        assert_true(r.state.position.x > 2);
        assert_int_equal(recording_end(trace, r.world), TAHR_OK);
        expect_repeated(&file, 180, tahr_state_hash(&r.state));
        rig_close(&r);
    }
}
#endif

static void a_state_that_was_written_between_steps_is_in_the_file(void **unused)
{
    fake_world w;
    rig r;
    recording file = {0};
    (void)unused;
    fake_world_flat(&w);
    rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
    tahr_trace *trace = recording_begin(&file, r.world, 0);
    r.input.move = fake_vec(1, 0, 0);
    for (int i = 0; i < 40; i++) {
        if (i == 20) {
            r.state.position = fake_vec(100, 50, 2);
        }
        rig_step(&r, 1.0 / 60);
    }
    recording_end(trace, r.world);
    expect_repeated(&file, 40, tahr_state_hash(&r.state));
    rig_close(&r);
}

/* The queries of the faster one are longer, from the first step on in which it wants to move. */
static void another_run_is_told_apart_by_step_query_and_field(void **unused)
{
    fake_world w;
    rig r;
    recording file = {0};
    replay p = {.speed_factor = 2};
    (void)unused;
    fake_world_flat(&w);
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
    tahr_trace *trace = recording_begin(&file, r.world, 0);
    for (int i = 0; i < 30; i++) {
        r.input.move = fake_vec(i >= 12, 0, 0);
        rig_step(&r, 1.0 / 60);
    }
    recording_end(trace, r.world);
    replay_run(&p, &file);
    assert_true(p.differs);
    assert_false(p.ended);
    assert_int_equal(p.status, TAHR_E_BACKEND);
    assert_non_null(strstr(p.how, "mover 0, query "));
    assert_non_null(strstr(p.how, "sweep."));
    assert_non_null(strstr(p.how, ", recorded is "));
    assert_true(p.steps >= 12 && p.steps < 30);
    char step[32];
    snprintf(step, sizeof step, "step %llu, ", (unsigned long long)p.steps);
    assert_ptr_equal(strstr(p.how, step), p.how);
    recording_free(&file);
    rig_close(&r);
}

static void what_a_backend_did_wrong_is_repeated_too(void **unused)
{
    (void)unused;
    for (int lie = LIE_NONE + 1; lie < LIES; lie++) {
        fake_backend b;
        rig r;
        recording file = {0};
        replay p = {0};
        rig_open_backend(&r, &b, FAKE_BACKEND_ALL);
        tahr_trace *trace = recording_begin(&file, r.world, 0);
        r.input.move = fake_vec(1, 0, 0);
        b.lie = lie;
        tahr_status status = TAHR_OK;
        for (int i = 0; i < 30 && status >= 0; i++) {
            status = tahr_mover_step(r.mover, &r.input, 1.0 / 60, &r.state, NULL);
        }
        assert_int_equal(status, TAHR_E_BACKEND);
        recording_end(trace, r.world);
        replay_run(&p, &file);
        assert_true(p.ended && !p.differs);
        assert_int_equal(p.status, TAHR_E_BACKEND);
        assert_true(tahr_state_hash(&p.state) == tahr_state_hash(&r.state));
        assert_non_null(strstr(file.complaint, lie_fields[lie])); /* the replay's world complains of the same field */
        recording_free(&file);
        rig_close(&r);
    }
}

static void a_backend_without_the_margin_repeats_with_what_it_was_asked(void **unused)
{
    fake_backend b;
    rig r;
    recording file = {0};
    (void)unused;
    rig_open_backend(&r, &b, FAKE_BACKEND_ALL & ~TAHR_CAP_MARGIN);
    tahr_trace *trace = recording_begin(&file, r.world, 0);
    r.input.move = fake_vec(1, 0, 0);
    rig_steps(&r, 60, 1.0 / 60);
    recording_end(trace, r.world);
    expect_repeated(&file, 60, tahr_state_hash(&r.state));
    rig_close(&r);
}

static void questions_outside_of_steps_are_recorded_unless_they_are_not_wanted(void **unused)
{
    uint64_t queries[2];
    size_t sizes[2];
    (void)unused;
    for (uint32_t only = 0; only < 2; only++) {
        fake_world w;
        rig r;
        recording file = {0};
        tahr_hit hit;
        uint32_t count;
        fake_world_flat(&w);
        rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
        tahr_trace *trace = recording_begin(&file, r.world, only ? TAHR_TRACE_STEPS_ONLY : 0);
        for (int i = 0; i < 30; i++) {
            rig_step(&r, 1.0 / 60);
            const tahr_ray down = {r.state.position, fake_vec(0, 0, -5), 0xFFFFFFFFu, TAHR_NO_BODY};
            assert_int_equal(tahr_world_ray(r.world, &down, &hit, &count), TAHR_OK);
            assert_int_equal(count, 1);
        }
        tahr_trace_size(trace, NULL, &queries[only], NULL);
        recording_end(trace, r.world);
        sizes[only] = file.size;
        expect_repeated(&file, 30, tahr_state_hash(&r.state));
        rig_close(&r);
    }
    assert_true(queries[0] == queries[1] + 30);
    assert_true(sizes[0] > sizes[1]);
}

static tahr_status hover(void *user, tahr_step *step, double time, tahr_custom_next *next)
{
    const tahr_vec3 up = {0, 0, 0.5 * time};
    tahr_hit hit;
    const tahr_vec3 origin = tahr_step_state(step)->position, down = {0, 0, -9};
    (void)user, (void)next;
    tahr_step_ray(step, &origin, &down, &hit);
    return tahr_step_slide(step, &up, NULL);
}

static void steps_of_an_own_mode_are_left_out_and_the_rest_repeats(void **unused)
{
    fake_world w;
    rig r;
    recording file = {0};
    replay p = {0};
    (void)unused;
    fake_world_flat(&w);
    rig_stand(&r, &w, NULL, fake_vec(0, 0, 1));
    tahr_mover_set_custom_mode(r.mover, hover, NULL);
    tahr_trace *trace = recording_begin(&file, r.world, 0);
    for (int i = 0; i < 60; i++) {
        r.input.flags = i == 20 || i == 40 ? TAHR_INPUT_MODE : 0;
        r.input.mode = i == 20 ? TAHR_MODE_CUSTOM : TAHR_MODE_FALLING;
        rig_step(&r, 1.0 / 60);
    }
    recording_end(trace, r.world);
    replay_run(&p, &file);
    assert_true(p.ended && !p.differs);
    assert_int_equal(p.custom, 21);
    assert_int_equal(p.steps, 39);
    assert_true(tahr_state_hash(&p.state) == tahr_state_hash(&r.state));
    recording_free(&file);
    rig_close(&r);
}

static void many_movers_and_states_share_a_file(void **unused)
{
    enum { CROWD = 20 };
    fake_world w;
    rig r;
    recording file = {0};
    tahr_mover *movers[CROWD];
    tahr_state states[2 * CROWD]; /* every mover steps two characters */
    (void)unused;
    fake_world_flat(&w);
    fake_add_box(&w, fake_vec(3, -50, -1), fake_vec(4, 50, 0.3));
    rig_open(&r, &w, NULL, fake_vec(0, 0, 1));
    for (int i = 0; i < CROWD; i++) {
        assert_int_equal(tahr_mover_create(r.world, &r.config, &movers[i]), TAHR_OK);
    }
    for (int i = 0; i < 2 * CROWD; i++) {
        const tahr_vec3 at = fake_vec(i % 5, 2 * i, 1);
        tahr_state_init(&states[i], &r.config, &at);
    }
    tahr_trace *trace = recording_begin(&file, r.world, TAHR_TRACE_FLUSH);
    for (int n = 0; n < 30; n++) {
        for (int i = 0; i < 2 * CROWD; i++) {
            r.input.move = fake_vec(cos(i), sin(i), 0);
            assert_int_equal(tahr_mover_step(movers[i / 2], &r.input, 1.0 / 60, &states[i], NULL), TAHR_OK);
        }
    }
    recording_end(trace, r.world);
    for (int i = 0; i < CROWD; i++) {
        tahr_mover_destroy(movers[i]);
    }
    expect_repeated(&file, 30 * 2 * CROWD, tahr_state_hash(&states[2 * CROWD - 1]));
    rig_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_run_with_everything_in_it_repeats_whenever_it_was_begun),
        cmocka_unit_test(being_watched_changes_no_bit),
        cmocka_unit_test(a_run_over_own_callbacks_repeats),
        cmocka_unit_test(a_run_over_gathered_triangles_repeats_without_them),
#ifdef TAHR_HAVE_CCD
        cmocka_unit_test(characters_of_every_shape_repeat),
#endif
        cmocka_unit_test(a_state_that_was_written_between_steps_is_in_the_file),
        cmocka_unit_test(another_run_is_told_apart_by_step_query_and_field),
        cmocka_unit_test(what_a_backend_did_wrong_is_repeated_too),
        cmocka_unit_test(a_backend_without_the_margin_repeats_with_what_it_was_asked),
        cmocka_unit_test(questions_outside_of_steps_are_recorded_unless_they_are_not_wanted),
        cmocka_unit_test(steps_of_an_own_mode_are_left_out_and_the_rest_repeats),
        cmocka_unit_test(many_movers_and_states_share_a_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
