/* SPDX-License-Identifier: MIT
 * test_around_truth.c: going around an edge, a ball, a pillar, against what is known of it: at a constant wish the
 * closed form of forms.h, at every rate; with inertia a pendulum's energy and a Runge-Kutta integration, to second order
 * in time and to the first in config.path_tolerance; who is too fast leaves along the free path. What is swept stays
 * within the tolerance, and costs nothing where nothing is round. */
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

#include "forms.h"

static const long double DEGREE = 0.017453292519943295769L;

enum { MAX_QUERIES = 64 };

/* What stands at the origin and is gone around about +z: seen from above a circle of this radius, whose wish is +x. */
typedef struct thing {
    const char *name;
    uint32_t type;
    double radius; /* m; 0: the upright edge of a block in x > 0, y < 0 */
} thing;

static const thing THINGS[] = {{"edge", TAHR_BODY_BOX, 0},
                               {"ball", TAHR_BODY_SPHERE, 1},
#ifdef TAHR_HAVE_CCD
                               {"pillar", TAHR_BODY_CYLINDER, 2}, /* native has none */
#endif
                               {"capsule", TAHR_BODY_CAPSULE, 0.25}};
enum { THING_COUNT = sizeof THINGS / sizeof THINGS[0] };

/* A character that touches the thing. */
typedef struct stage {
    tahr_world *world;
    tahr_mover *mover;
    tahr_config config;
    tahr_state state;
    tahr_input input;
    tahr_report report;
    tahr_query_record queries[MAX_QUERIES];
    double radius; /* m: of the circle that its place is on */
    uint32_t turned, sweeps;
    double farthest; /* m: of the ends of all sweeps from the circle */
} stage;

static const tahr_backend *backend_for(const thing *what)
{
#ifdef TAHR_HAVE_CCD
    if (what && what->type == TAHR_BODY_CYLINDER) {
        return tahr_backend_v1_ccd();
    }
#endif
    (void)what;
    return tahr_backend_v1_native();
}

static tahr_body_desc body_of(const thing *what)
{
    tahr_body_desc body;
    assert_int_equal(tahr_body_desc_init(&body, sizeof body, what->type), TAHR_OK);
    body.radius = what->radius;
    body.half_height = 8;
    if (what->radius == 0) {
        body.half_extents = (tahr_vec3){4, 4, 8};
        body.pose.position = (tahr_vec3){4, -4, 0};
    }
    return body;
}

/* what: NULL: nothing but the floor. mode: WALKING on a floor, or FLYING at the same height, that of a ball's centre. */
static void open_stage(stage *s, const thing *what, const tahr_config *config, uint32_t mode)
{
    tahr_body_desc bodies[2];
    tahr_world_desc desc;
    double foot = config->shape.half_height + config->floor_target * config->skin;

    memset(s, 0, sizeof *s);
    s->config = *config;
    assert_int_equal(tahr_world_desc_init(&desc, sizeof desc), TAHR_OK);
    assert_int_equal(tahr_body_desc_init(&bodies[0], sizeof bodies[0], TAHR_BODY_BOX), TAHR_OK);
    bodies[0].half_extents = (tahr_vec3){64, 64, 1};
    bodies[0].pose.position.z = -1 - (mode == TAHR_MODE_WALKING ? foot : 32);
    if (what) {
        bodies[1] = body_of(what);
    }
    desc.bodies = bodies;
    desc.body_count = what ? 2 : 1;
    assert_int_equal(tahr_world_open(backend_for(what), &desc, &s->world), TAHR_OK);
    assert_int_equal(tahr_mover_create(s->world, &s->config, &s->mover), TAHR_OK);
    s->radius = config->shape.radius + config->skin + (what ? what->radius : 0);
    s->input.struct_size = sizeof s->input;
    s->report.struct_size = sizeof s->report;
    s->report.queries = s->queries;
    s->report.query_capacity = MAX_QUERIES;
}

static void close_stage(stage *s)
{
    tahr_mover_destroy(s->mover);
    tahr_world_close(s->world);
}

/* On the circle, at an angle from the direction against +x. */
static void put(stage *s, long double angle, uint32_t mode)
{
    tahr_vec3 at = {(double)(-s->radius * cosl(angle)), (double)(s->radius * sinl(angle)), 0};
    assert_int_equal(tahr_state_init(&s->state, &s->config, &at), TAHR_OK);
    s->state.mode = mode;
}

static long double angle_of(const stage *s)
{
    return atan2l(s->state.position.y, -s->state.position.x);
}

static double off_circle(const stage *s, tahr_vec3 at)
{
    return fabs(sqrt(at.x * at.x + at.y * at.y) - s->radius);
}

static void step(stage *s, double dt)
{
    assert_int_equal(tahr_mover_step(s->mover, &s->input, dt, &s->state, &s->report), TAHR_OK);
    s->turned += s->report.arcs;
    s->sweeps += s->report.sweeps;
    for (uint32_t i = 0; i < s->report.query_count; i++) {
        const tahr_query_record *q = &s->queries[i];
        tahr_vec3 end = {q->position.x + q->fraction * q->motion.x, q->position.y + q->fraction * q->motion.y, 0};
        int level = q->motion.x != 0 || q->motion.y != 0; /* the floor is looked for straight down */
        if (q->type == TAHR_QUERY_SWEEP && level) {
            s->farthest = fmax(s->farthest, off_circle(s, end));
        }
    }
}

static tahr_config config_of(void)
{
    tahr_config c;
    assert_int_equal(tahr_config_init(&c, sizeof c, TAHR_PRESET_PRECISE), TAHR_OK);
    c.step_height = 0;
    return c;
}

/* Driven from 10 to some 80 degrees. Every step ends where the closed form does, and on the circle. */
static void go_driven(const thing *what, uint32_t mode, double rate)
{
    const long double first = 10 * DEGREE, last = 80 * DEGREE, speed = 2;
    /* m: what a sweep is off (ccd: 1e-4) grows as sin(angle) does, here by 5.7. A slide keeps off by a ten-billionth of
     * its way. */
    const double allowed = 5.7 * (what->type == TAHR_BODY_CYLINDER ? 1e-4 : 1e-9) + 2e-9;
    tahr_config c = config_of();
    stage s;
    open_stage(&s, what, &c, mode);
    put(&s, first, mode);
    s.input.flags = TAHR_INPUT_DRIVE;
    s.input.drive = (tahr_vec3){(double)speed, 0, 0};
    long double whole = s.radius / speed * logl(tanl(last / 2) / tanl(first / 2));
    int steps = (int)(whole * rate);
    for (int i = 1; i <= steps; i++) {
        step(&s, 1 / rate);
        long double due = form_round_angle(first, speed, s.radius, i / (long double)rate);
        double off = (double)fabsl(angle_of(&s) - due) * s.radius + off_circle(&s, s.state.position);
        if (!(off <= allowed)) {
            print_message("    %s, %s, %g Hz: step %d of %d: %.3g m off\n", what->name, tahr_mode_name(mode), rate, i,
                          steps, off);
        }
        assert_true(off <= allowed);
    }
    assert_true(steps > 0 && s.turned >= (uint32_t)steps);
    close_stage(&s);
}

static void a_constant_wish_goes_around_by_the_closed_form_at_every_rate(void **unused)
{
    const double rates[] = {5, 10, 30, 60, 64, 120};
    (void)unused;
    for (int i = 0; i < THING_COUNT; i++) {
        for (size_t r = 0; r < sizeof rates / sizeof rates[0]; r++) {
            go_driven(&THINGS[i], TAHR_MODE_FLYING, rates[r]);
            go_driven(&THINGS[i], TAHR_MODE_WALKING, rates[r]);
        }
    }
}

/* With nothing but an acceleration a toward +x it is a pendulum: v^2 / 2 = a R (cos first - cos angle). By Runge-Kutta
 * from rest, checked by that. */
static long double pendulum(long double first, long double a, long double radius, long double time)
{
    const int steps = 20000;
    long double h = time / steps, angle = first, v = 0;
    for (int i = 0; i < steps; i++) {
        long double k1 = v / radius, l1 = a * sinl(angle), k2 = (v + h / 2 * l1) / radius,
                    l2 = a * sinl(angle + h / 2 * k1), k3 = (v + h / 2 * l2) / radius,
                    l3 = a * sinl(angle + h / 2 * k2), k4 = (v + h * l3) / radius, l4 = a * sinl(angle + h * k3);
        angle += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        v += h / 6 * (l1 + 2 * l2 + 2 * l3 + l4);
    }
    assert_true(fabsl(v * v / 2 - a * radius * (cosl(first) - cosl(angle))) < 1e-12L);
    return angle;
}

static tahr_config inert(void)
{
    tahr_config c = config_of();
    c.acceleration = 1.5;
    c.turn_friction = c.fly_drag = c.braking_drag = 0;
    return c;
}

/* m off the pendulum, from 30 degrees. */
static double swing(const thing *what, uint32_t mode, double tolerance, double rate, stage *s)
{
    const long double first = 30 * DEGREE;
    const double seconds = 0.5;
    tahr_config c = inert();
    c.path_tolerance = tolerance;
    open_stage(s, what, &c, mode);
    put(s, first, mode);
    s->input.move = (tahr_vec3){1, 0, 0};
    for (int i = 0; i < (int)(seconds * rate + 0.5); i++) {
        step(s, 1 / rate);
    }
    long double due = pendulum(first, c.acceleration, s->radius, seconds);
    assert_true(cosl(due) > 0.7L * cosl(first)); /* pressed all the way: a ball leaves at two thirds */
    close_stage(s);
    return (double)(fabsl(angle_of(s) - due) * s->radius);
}

static void with_inertia_the_error_falls_with_the_square_of_the_step(void **unused)
{
    const uint32_t modes[] = {TAHR_MODE_FLYING, TAHR_MODE_WALKING};
    stage s;
    (void)unused;
    for (int m = 0; m < 2; m++) {
        double before = 0;
        for (double rate = 8; rate <= 64; rate *= 2) {
            double off = swing(&THINGS[0], modes[m], 0.5, rate, &s);
            print_message("    %s, %g Hz: %.3g m off\n", tahr_mode_name(modes[m]), rate, off);
            assert_true(before == 0 || off < before / 3); /* second order: a quarter */
            before = off;
        }
        assert_true(before < 1e-4);
    }
}

static void with_inertia_the_error_falls_with_the_tolerance(void **unused)
{
    stage s;
    (void)unused;
    for (int i = 0; i < THING_COUNT; i++) {
        double first = 0, last = 0;
        for (double tolerance = 8e-3; tolerance > 1e-4; tolerance /= 4) {
            double off = swing(&THINGS[i], TAHR_MODE_WALKING, tolerance, 2, &s);
            print_message("    %s, 2 Hz, tolerance %g: %.3g m off, sweeps at most %.3g m off the circle\n",
                          THINGS[i].name, tolerance, off, s.farthest);
            assert_true(s.farthest <= tolerance);
            first = first == 0 ? off : first;
            last = off;
        }
        assert_true(last < first / 8); /* in whole pieces: a 64th of the tolerance is a 64th of the error in the end */
    }
}

static void off_it_goes_straight_on(void **unused)
{
    stage s;
    (void)unused;
    double off = swing(&THINGS[0], TAHR_MODE_WALKING, 0, 16, &s);
    assert_int_equal(s.turned, 0);
    double on = swing(&THINGS[0], TAHR_MODE_WALKING, 2e-3, 16, &s);
    assert_true(s.turned > 0);
    assert_true(off > 10 * on);
}

/* Too fast to be held: from the edge on it goes as if nothing were there. */
static void who_is_too_fast_leaves_along_the_free_path(void **unused)
{
    const long double angle = 60 * DEGREE;
    const double rates[] = {30, 60, 240};
    tahr_config c = config_of();
    (void)unused;
    for (size_t i = 0; i < sizeof rates / sizeof rates[0]; i++) {
        tahr_vec3 ends[3];
        for (int k = 0; k < 3; k++) { /* the edge; nothing; the edge, switched off */
            stage s;
            c.path_tolerance = k == 2 ? 0 : 2e-3;
            open_stage(&s, k == 1 ? NULL : &THINGS[0], &c, TAHR_MODE_WALKING);
            s.radius = c.shape.radius + c.skin;
            put(&s, angle, TAHR_MODE_WALKING);
            s.state.velocity = (tahr_vec3){5 * (double)sinl(angle), 5 * (double)cosl(angle), 0};
            s.input.move = (tahr_vec3){1, 0, 0};
            step(&s, 1 / rates[i]);
            ends[k] = s.state.position;
            close_stage(&s);
        }
        double off = hypot(ends[0].x - ends[1].x, ends[0].y - ends[1].y);
        double chord = hypot(ends[2].x - ends[1].x, ends[2].y - ends[1].y);
        print_message("    %g Hz: %.3g m off the free path, %.3g m without\n", rates[i], off, chord);
        assert_true(off < 1e-8);
        assert_true(chord > 20 * off + 1e-4);
    }
}

/* From a velocity across the wish: q e^(-f t) across it and a t along it, while that is below the speed asked for. Where
 * it meets the wall is told by the event. */
static void a_walk_that_turns_meets_a_wall_where_its_curve_does(void **unused)
{
    static const thing wall = {"wall", TAHR_BODY_BOX, 0};
    const double tolerances[] = {0, 8e-3, 1e-3}, gap = 0.15, across = 3;
    double off[3];
    (void)unused;
    for (int i = 0; i < 3; i++) {
        stage s;
        tahr_event events[4];
        tahr_config c = config_of();
        c.path_tolerance = tolerances[i];
        open_stage(&s, &wall, &c, TAHR_MODE_WALKING);
        const tahr_vec3 at = {1, s.radius + gap, 0}; /* the block's face looks to +y */
        assert_int_equal(tahr_state_init(&s.state, &s.config, &at), TAHR_OK);
        s.state.mode = TAHR_MODE_WALKING;
        s.state.velocity.x = across;
        s.input.move.y = -1;
        s.report.events = events;
        s.report.event_capacity = 4;
        step(&s, 0.2);
        long double time = sqrtl(2 * (long double)gap / c.acceleration);
        long double due = at.x - across * expm1l(-c.turn_friction * time) / c.turn_friction;
        assert_true(c.acceleration * time < c.max_speed - across);
        assert_true(s.report.event_count > 0 && events[0].type == TAHR_EVENT_HIT);
        off[i] = fabs(events[0].position.x - (double)due);
        print_message("    tolerance %g: meets the wall %.3g m off, %u sweeps\n", tolerances[i], off[i], s.sweeps);
        assert_int_equal(s.report.arcs, tolerances[i] > 0);
        close_stage(&s);
    }
    /* Off the way by the tolerance at most, which a wall met at 65 degrees makes half as much along it. */
    assert_true(off[1] <= tolerances[1] && off[2] <= tolerances[2]);
    assert_true(off[0] > 0.05);
}

/* On the floor and along a wall that is longer than the way: the same bits, and not one query more. */
static void where_nothing_is_round_nothing_changes(void **unused)
{
    static const thing wall = {"wall", TAHR_BODY_BOX, 0};
    stage on, off;
    tahr_config c = config_of();
    (void)unused;
    open_stage(&on, &wall, &c, TAHR_MODE_WALKING);
    c.path_tolerance = 0;
    open_stage(&off, &wall, &c, TAHR_MODE_WALKING);
    for (int k = 0; k < 2; k++) {
        stage *s = k ? &off : &on;
        tahr_vec3 at = {2, 2, 0}; /* the block's face looks to +y */
        assert_int_equal(tahr_state_init(&s->state, &s->config, &at), TAHR_OK);
        s->state.mode = TAHR_MODE_WALKING;
        for (int i = 0; i < 240; i++) {
            double way = i / 60 % 2 ? -0.4 : 0.5;
            s->input.move = (tahr_vec3){way, i % 80 < 60 ? -0.8 : 0.3, 0};
            step(s, 1.0 / 60);
        }
    }
    assert_int_equal(on.turned, 0);
    assert_int_equal(on.sweeps, off.sweeps);
    assert_memory_equal(&on.state, &off.state, sizeof on.state);
    close_stage(&on);
    close_stage(&off);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_constant_wish_goes_around_by_the_closed_form_at_every_rate),
        cmocka_unit_test(with_inertia_the_error_falls_with_the_square_of_the_step),
        cmocka_unit_test(with_inertia_the_error_falls_with_the_tolerance),
        cmocka_unit_test(off_it_goes_straight_on),
        cmocka_unit_test(who_is_too_fast_leaves_along_the_free_path),
        cmocka_unit_test(a_walk_that_turns_meets_a_wall_where_its_curve_does),
        cmocka_unit_test(where_nothing_is_round_nothing_changes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
