/* SPDX-License-Identifier: MIT
 * test_modes_wander.c: random buttons among water, walls and shores, in every mode: no way from one mode to another but
 * those of the table, nothing entered, nothing forgotten by a rollback, no more queries than promised. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dice.h"
#include "modes.h"
#include "rig.h"

#include <tahr/native.h>
#ifdef TAHR_HAVE_CCD
#include <tahr/ccd.h>
#endif

enum { BODIES = 10 };

static tahr_body_desc body(uint32_t type, tahr_vec3 at, tahr_vec3 half, uint32_t flags)
{
    tahr_body_desc b;
    assert_int_equal(tahr_body_desc_init(&b, sizeof b, type), TAHR_OK);
    b.pose.position = at;
    b.half_extents = half;
    b.radius = half.x;
    b.half_height = half.z;
    b.flags = flags;
    return b;
}

/* A closed hall of 24 m x 24 m x 9 m: a pool with steps and a shore, a leaning column of water, a ball of it. */
static void build(tahr_body_desc b[BODIES])
{
    b[0] = body(TAHR_BODY_BOX, fake_vec(0, 0, -4.5), fake_vec(13, 13, 0.5), 0);   /* bottom at -4 */
    b[1] = body(TAHR_BODY_BOX, fake_vec(-8, 0, -2), fake_vec(5, 13, 2), 0);       /* land, top at 0 */
    b[2] = body(TAHR_BODY_BOX, fake_vec(-2.5, 0, -2.4), fake_vec(0.5, 13, 2), 0); /* a step under water, top at -0.4 */
    b[3] = body(TAHR_BODY_BOX, fake_vec(4, 6, -3.2), fake_vec(6, 5, 0.5), 0);     /* a shore */
    b[3].pose.orientation = (tahr_quat){0, -sin(0.15), 0, cos(0.15)};
    b[4] = body(TAHR_BODY_BOX, fake_vec(5, 0, -2.1), fake_vec(8, 12, 2), TAHR_BODY_FLUID); /* surface at -0.1 */
    b[4].surface_velocity = fake_vec(0.2, -0.1, 0);
    b[5] = body(TAHR_BODY_CAPSULE, fake_vec(-8, -6, 2), fake_vec(2, 0, 4), TAHR_BODY_FLUID);
    b[5].pose.orientation = (tahr_quat){sin(0.3), 0, 0, cos(0.3)};
    b[5].fluid_friction = 2;
    b[6] = body(TAHR_BODY_SPHERE, fake_vec(-8, 7, 2.5), fake_vec(2.5, 0, 2.5), TAHR_BODY_FLUID);
    b[7] = body(TAHR_BODY_BOX, fake_vec(0, 12.5, 0), fake_vec(13, 0.5, 6), 0);
    b[8] = body(TAHR_BODY_SPHERE, fake_vec(6, -6, -1), fake_vec(1.5, 0, 1.5), 0);
    b[9] = body(TAHR_BODY_BOX, fake_vec(0, 0, 5.5), fake_vec(13, 13, 0.5), 0); /* ceiling at 5 */
}

typedef struct wander {
    tahr_world *world;
    tahr_mover *mover;
    tahr_config config;
    tahr_state state;
    tahr_input input;
    uint32_t seen[TAHR_MODE_CUSTOM + 1][TAHR_MODE_CUSTOM + 1];
    uint32_t most;  /* queries of a step */
    double deepest; /* m */
} wander;

static void open_wander(wander *w, const tahr_backend *backend, const tahr_config *config)
{
    tahr_body_desc bodies[BODIES];
    tahr_world_desc desc;
    const tahr_vec3 at = {-6, 0, 2};
    memset(w, 0, sizeof *w);
    build(bodies);
    assert_int_equal(tahr_world_desc_init(&desc, sizeof desc), TAHR_OK);
    desc.bodies = bodies;
    desc.body_count = BODIES;
    assert_int_equal(tahr_world_open(backend, &desc, &w->world), TAHR_OK);
    w->config = *config;
    assert_int_equal(tahr_mover_create(w->world, &w->config, &w->mover), TAHR_OK);
    assert_int_equal(tahr_state_init(&w->state, &w->config, &at), TAHR_OK);
    w->input.struct_size = sizeof w->input;
}

static void press_something(wander *w, oracle_random *seed)
{
    tahr_input *in = &w->input;
    in->flags = 0;
    if (oracle_below(seed, 20) == 0) {
        in->move = dice_vec(seed, -1, 1);
        in->jump = oracle_below(seed, 3) == 0;
    }
    if (oracle_below(seed, 100) == 0) {
        in->flags = TAHR_INPUT_MODE;
        in->mode = oracle_below(seed, TAHR_MODE_CUSTOM + 1);
    } else if (w->state.mode == TAHR_MODE_NONE || (w->state.mode == TAHR_MODE_FLYING && oracle_below(seed, 40) == 0)) {
        in->flags = TAHR_INPUT_MODE;
        in->mode = TAHR_MODE_FALLING;
    }
    tahr_vec3 p = w->state.position;
    if (!(fabs(p.x) < 11.5 && p.y > -11.5)) { /* toward the middle, away from the sides that are open */
        in->move = fake_vec(-p.x / 12, -p.y / 12, 0);
    }
    if (fabs(p.x) > 12.5 || p.y < -12.5 || p.z < -20) {
        const tahr_vec3 back = {-6, 0, 2};
        assert_int_equal(tahr_state_teleport(&w->state, &back), TAHR_OK);
        w->state.velocity = fake_vec(0, 0, 0);
    }
}

/* Follows the changes of mode that a report tells: the first may have been asked for. */
static void check_changes(wander *w, uint32_t before, const tahr_report *r)
{
    uint32_t mode = before, asked = w->input.flags & TAHR_INPUT_MODE ? w->input.mode : TAHR_NO_BODY;
    for (uint32_t i = 0; i < r->event_count; i++) {
        if (r->events[i].type == TAHR_EVENT_MODE) {
            uint32_t to = (uint32_t)r->events[i].value;
            assert_true(to == asked || tahr__transition(mode, to) != NULL);
            w->seen[mode][to] += to != asked;
            asked = to == asked ? TAHR_NO_BODY : asked;
            mode = to;
        }
    }
    assert_int_equal(mode, w->state.mode);
    if (!(w->input.flags & TAHR_INPUT_MODE)) {
        assert_int_equal(r->flags & TAHR_REPORT_MODE_REFUSED, 0);
    }
}

static void check_place(wander *w)
{
    uint32_t count = 0;
    tahr_contact_query q = {.shape = w->config.shape,
                            .position = w->state.position,
                            .up = w->state.up,
                            .orientation = w->state.orientation,
                            .mask = 0xFFFFFFFFu,
                            .ignore_body = TAHR_NO_BODY};
    tahr_contact all[16];
    assert_true(tahr_world_contacts(w->world, &q, all, 16, &count) >= 0);
    for (uint32_t i = 0; i < count; i++) {
        w->deepest = all[i].sensor ? w->deepest : fmax(w->deepest, -all[i].distance);
    }
}

static void run(wander *w, double dt, int steps, uint64_t start)
{
    oracle_random seed = {start};
    tahr_event events[64];
    for (int i = 0; i < steps; i++) {
        tahr_report r = {.struct_size = sizeof r, .events = events, .event_capacity = 64};
        press_something(w, &seed);
        tahr_state before = w->state, again = w->state;
        assert_true(tahr_mover_step(w->mover, &w->input, dt, &w->state, &r) >= 0);
        assert_int_equal(r.flags & TAHR_REPORT_QUERY_CAP, 0);
        uint32_t queries = r.sweeps + r.contact_queries + r.rays + r.fluid_queries;
        w->most = queries > w->most ? queries : w->most;
        check_changes(w, before.mode, &r);
        tahr_vec3 p = w->state.position, v = w->state.velocity;
        assert_true(isfinite(p.x + p.y + p.z + v.x + v.y + v.z));
        if (i % 16 == 0) {
            assert_true(tahr_mover_step(w->mover, &w->input, dt, &again, NULL) >= 0);
            assert_memory_equal(&again, &w->state, sizeof again);
            check_place(w);
        }
    }
}

static void close_wander(wander *w)
{
    tahr_mover_destroy(w->mover);
    tahr_world_close(w->world);
}

static void wanderers_change_their_mode_only_as_the_table_says(void **unused)
{
    uint32_t seen[TAHR_MODE_CUSTOM + 1][TAHR_MODE_CUSTOM + 1] = {{0}};
    const tahr_config config = rig_config();
    (void)unused;
    for (int i = 0; i < RIG_RATES; i++) {
        wander w;
        open_wander(&w, tahr_backend_v1_native(), &config);
        run(&w, 1 / rig_rates[i], 20000, 1 + (uint64_t)i);
        print_message("%g Hz: at most %u queries a step\n", rig_rates[i], w.most);
        assert_true(w.most <= TAHR_MAX_QUERIES_PER_STEP);
        assert_true(w.deepest < 1e-5);
        for (int from = 0; from <= TAHR_MODE_CUSTOM; from++) {
            for (int to = 0; to <= TAHR_MODE_CUSTOM; to++) {
                seen[from][to] += w.seen[from][to];
            }
        }
        close_wander(&w);
    }
    for (uint32_t from = 0; from <= TAHR_MODE_CUSTOM; from++) {
        for (uint32_t to = 0; to <= TAHR_MODE_CUSTOM; to++) {
            if (seen[from][to]) {
                print_message("%s -> %s: %u times\n", tahr_mode_name(from), tahr_mode_name(to), seen[from][to]);
            }
        }
    }
    assert_true(seen[TAHR_MODE_WALKING][TAHR_MODE_FALLING] > 10 && seen[TAHR_MODE_FALLING][TAHR_MODE_WALKING] > 10);
    assert_true(seen[TAHR_MODE_WALKING][TAHR_MODE_SWIMMING] > 10 && seen[TAHR_MODE_FALLING][TAHR_MODE_SWIMMING] > 10);
    assert_true(seen[TAHR_MODE_SWIMMING][TAHR_MODE_FALLING] > 10 && seen[TAHR_MODE_SWIMMING][TAHR_MODE_WALKING] > 10);
}

static void so_do_those_with_every_integrator_and_every_slide(void **unused)
{
    (void)unused;
    for (int i = 0; i < 4; i++) {
        for (uint32_t method = 0; method < 6; method++) { /* 0 to 3 in the one preset, 4 and 5 in the other */
            wander w;
            tahr_config c;
            assert_int_equal(tahr_config_init(&c, sizeof c, method < 4 ? TAHR_PRESET_PRECISE : TAHR_PRESET_UNREAL),
                             TAHR_OK);
            c.integrator = method % 2 ? TAHR_INTEGRATOR_STEPPED : TAHR_INTEGRATOR_EXACT;
            c.slide_solver = method >= 2 ? TAHR_SLIDE_TWO_WALLS : TAHR_SLIDE_JOINT;
            open_wander(&w, tahr_backend_v1_native(), &c);
            run(&w, 1 / rig_rates[i], 4000, 11 + (uint64_t)i);
            assert_true(w.seen[TAHR_MODE_SWIMMING][TAHR_MODE_FALLING] + w.seen[TAHR_MODE_SWIMMING][TAHR_MODE_WALKING] >
                        0);
            assert_true(c.separation != TAHR_SEPARATION_MARGIN || w.deepest < 1e-5);
            close_wander(&w);
        }
    }
}

static void so_do_those_of_the_other_backend(void **unused)
{
    (void)unused;
#ifdef TAHR_HAVE_CCD
    wander w;
    const tahr_config config = rig_config();
    open_wander(&w, tahr_backend_v1_ccd(), &config);
    run(&w, 1.0 / 60, 1500, 21);
    assert_true(w.deepest < 1e-5 && w.seen[TAHR_MODE_FALLING][TAHR_MODE_SWIMMING] > 0);
    close_wander(&w);
#else
    print_message("SKIP: unit_modes_modes_wander: ccd was not built\n");
    skip();
#endif
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wanderers_change_their_mode_only_as_the_table_says),
        cmocka_unit_test(so_do_those_with_every_integrator_and_every_slide),
        cmocka_unit_test(so_do_those_of_the_other_backend),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
