/* SPDX-License-Identifier: MIT
 * test_shape_movement.c: characters that are cylinders, cones, ellipsoids and hulls walk, fall, land, step up and slide
 * on the libccd backend. Where they come to rest their extents tell, which have closed forms. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>
#include <tahr/tahr.h>

#ifndef TAHR_HAVE_CCD
int main(void)
{
    puts("SKIP: unit_motion_shape_movement: built without libccd");
    return 77;
}
#else
#include <tahr/ccd.h>

#include "dice.h"

enum { KINDS = 4, RIM = 8, HULL_VERTICES = 2 * RIM, PRESETS = 2 };

#define RADIUS 0.35
#define HALF 0.9
#define SLOPE 0.4 /* rad */
/* m: what rounding and the backend's 1e-6 in directions leave of a height */
#define CLOSE 1e-5
/* cos and sin of an eighth of a turn */
#define DIAGONAL 0.70710678118654752

static double hull_vertices[HULL_VERTICES * 3];

typedef struct walker {
    tahr_world *world;
    tahr_mover *mover;
    tahr_config config;
    tahr_state state;
    tahr_input input;
    int landed, left, stepped;
} walker;

/* An upright prism with a corner of its base toward +x and +y. */
static void make_hull(void)
{
    for (int i = 0; i < HULL_VERTICES; i++) {
        double angle = 2 * 3.141592653589793 * (i % RIM) / RIM;
        hull_vertices[3 * i] = RADIUS * cos(angle);
        hull_vertices[3 * i + 1] = RADIUS * sin(angle);
        hull_vertices[3 * i + 2] = i < RIM ? -HALF : HALF;
    }
}

static tahr_shape shape_of(int kind)
{
    const tahr_shape shapes[KINDS] = {{TAHR_SHAPE_CYLINDER, 0, RADIUS, HALF, 0, 0},
                                      {TAHR_SHAPE_CONE, 0, RADIUS, HALF, 0, 0},
                                      {TAHR_SHAPE_ELLIPSOID, 0, 0, HALF, RADIUS, RADIUS},
                                      {TAHR_SHAPE_HULL, 1, 0, HALF, RADIUS, RADIUS}};
    return shapes[kind];
}

/* How far the shape reaches down along a unit normal that leans by an angle toward -x. */
static double extent(int kind, double angle)
{
    double s = sin(angle), c = cos(angle);
    if (kind == 2) return sqrt(RADIUS * RADIUS * s * s + HALF * HALF * c * c);
    return RADIUS * s + HALF * c; /* the foot of all others has a point at -x */
}

static tahr_body_desc box(double x, double y, double z, double hx, double hy, double hz)
{
    tahr_body_desc b;
    tahr_body_desc_init(&b, sizeof b, TAHR_BODY_BOX);
    b.pose.position = (tahr_vec3){x, y, z};
    b.half_extents = (tahr_vec3){hx, hy, hz};
    return b;
}

static void begin(walker *w, int kind, int preset, const tahr_body_desc *obstacle, tahr_vec3 at)
{
    tahr_world_desc desc;
    tahr_body_desc bodies[2] = {*obstacle, {0}};
    memset(w, 0, sizeof *w);
    tahr_body_desc_init(&bodies[1], sizeof bodies[1], TAHR_BODY_HULL);
    bodies[1].flags = TAHR_BODY_TEMPLATE;
    bodies[1].vertices = hull_vertices;
    bodies[1].vertex_count = HULL_VERTICES;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = bodies;
    desc.body_count = 2;
    assert_int_equal(tahr_world_open(tahr_backend_v1_ccd(), &desc, &w->world), TAHR_OK);
    assert_int_equal(tahr_config_init(&w->config, sizeof w->config, preset), TAHR_OK);
    w->config.shape = shape_of(kind);
    assert_int_equal(tahr_mover_create(w->world, &w->config, &w->mover), TAHR_OK);
    assert_int_equal(tahr_state_init(&w->state, &w->config, &at), TAHR_OK);
    w->input.struct_size = sizeof w->input;
}

static void end(walker *w)
{
    tahr_mover_destroy(w->mover);
    tahr_world_close(w->world);
}

static void walk(walker *w, double seconds)
{
    tahr_event events[32];
    tahr_report report = {.struct_size = sizeof report, .events = events, .event_capacity = 32};
    for (int i = 0; i < (int)(seconds * 60 + 0.5); i++) {
        assert_int_equal(tahr_mover_step(w->mover, &w->input, 1.0 / 60, &w->state, &report), TAHR_OK);
        for (uint32_t k = 0; k < report.event_count; k++) {
            w->landed += events[k].type == TAHR_EVENT_LANDED;
            w->left += events[k].type == TAHR_EVENT_LEFT_GROUND;
            w->stepped += events[k].type == TAHR_EVENT_STEPPED_UP;
        }
    }
}

/* Above its floor it stays between a skin and the height of the band. */
static void assert_in_band(const walker *w, double gap)
{
    assert_true(gap > w->config.skin * (1 - 1e-3) - CLOSE);
    assert_true(gap < w->config.floor_max * w->config.skin + CLOSE);
}

static void falls_and_lands_a_skin_above_a_level_floor(void **state)
{
    tahr_body_desc floor = box(0, 0, -1, 10, 10, 1);
    walker w;
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        for (int preset = TAHR_PRESET_PRECISE; preset <= TAHR_PRESET_UNREAL; preset++) {
            begin(&w, kind, preset, &floor, (tahr_vec3){0, 0, HALF + 1});
            walk(&w, 1.5);
            assert_int_equal(w.landed, 1);
            assert_int_equal(w.state.mode, TAHR_MODE_WALKING);
            assert_true(w.state.position.x == 0 && w.state.position.y == 0);
            assert_in_band(&w, w.state.position.z - HALF);
            end(&w);
        }
    }
}

static void walks_level_ground_straight_and_at_full_speed(void **state)
{
    tahr_body_desc floor = box(0, 0, -1, 60, 60, 1);
    walker w;
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        for (int preset = TAHR_PRESET_PRECISE; preset <= TAHR_PRESET_UNREAL; preset++) {
            begin(&w, kind, preset, &floor, (tahr_vec3){0, 0, HALF + 0.02});
            w.input.move.x = 1;
            walk(&w, 1);
            double x = w.state.position.x;
            walk(&w, 2);
            assert_true(fabs(w.state.position.x - x - 2 * w.config.max_speed) < 1e-3);
            assert_true(fabs(w.state.position.y) < 1e-6);
            assert_int_equal(w.left, 0);
            assert_in_band(&w, w.state.position.z - HALF);
            end(&w);
        }
    }
}

static void stands_on_a_slope_as_high_as_its_extent_says(void **state)
{
    tahr_body_desc ramp = box(0, 0, 0, 20, 20, 1);
    const double c = cos(SLOPE), s = sin(SLOPE);
    walker w;
    (void)state;
    ramp.pose.orientation = (tahr_quat){0, -sin(SLOPE / 2), 0, cos(SLOPE / 2)}; /* it rises toward +x */
    for (int kind = 0; kind < KINDS; kind++) {
        begin(&w, kind, TAHR_PRESET_PRECISE, &ramp, (tahr_vec3){0, 0, 2.5});
        walk(&w, 2);
        assert_int_equal(w.state.mode, TAHR_MODE_WALKING);
        tahr_vec3 p = w.state.position;
        assert_in_band(&w, -s * p.x + c * p.z - 1 - extent(kind, SLOPE));
        w.input.move.x = 1;
        walk(&w, 1);
        assert_int_equal(w.state.mode, TAHR_MODE_WALKING);
        assert_true(w.state.position.x > p.x + 1 && w.state.position.z - p.z > 0.9 * tan(SLOPE));
        end(&w);
    }
}

/* The step is a box on the ground, and the ground is its own lower part: one body, a mesh of two treads. */
static void steps_up_what_is_not_higher_than_a_step(void **state)
{
    static const double vertices[] = {-9, -9, 0,   2, -9, 0,   2, 9, 0,   -9, 9, 0,
                                      2,  -9, 0.2, 9, -9, 0.2, 9, 9, 0.2, 2,  9, 0.2};
    static const uint32_t indices[] = {0, 1, 2, 0, 2, 3, 1, 4, 7, 1, 7, 2, 4, 5, 6, 4, 6, 7};
    tahr_body_desc stair;
    walker w;
    (void)state;
    tahr_body_desc_init(&stair, sizeof stair, TAHR_BODY_MESH);
    stair.vertices = vertices;
    stair.indices = indices;
    stair.vertex_count = 8;
    stair.triangle_count = 6;
    for (int kind = 0; kind < KINDS; kind++) {
        for (int preset = TAHR_PRESET_PRECISE; preset <= TAHR_PRESET_UNREAL; preset++) {
            begin(&w, kind, preset, &stair, (tahr_vec3){0, 0, HALF + 0.02});
            w.input.move.x = 1;
            walk(&w, 1.2);
            assert_true(w.state.position.x > 2 + RADIUS);
            assert_int_equal(w.state.mode, TAHR_MODE_WALKING);
            assert_in_band(&w, w.state.position.z - HALF - 0.2);
            assert_true(w.left == 0);
            end(&w);
        }
    }
}

/* A floor and a wall in one mesh; the wall is the plane y = 2. The wide side of every shape is RADIUS from its axis. */
static void slides_along_a_wall_a_skin_away_from_it(void **state)
{
    static const double vertices[] = {-9, -9, 0, 60, -9, 0, 60, 2, 0, -9, 2, 0, 60, 2, 9, -9, 2, 9};
    static const uint32_t indices[] = {0, 1, 2, 0, 2, 3, 3, 2, 4, 3, 4, 5};
    tahr_body_desc room;
    walker w;
    (void)state;
    tahr_body_desc_init(&room, sizeof room, TAHR_BODY_MESH);
    room.vertices = vertices;
    room.indices = indices;
    room.vertex_count = 6;
    room.triangle_count = 4;
    for (int kind = 0; kind < KINDS; kind++) {
        begin(&w, kind, TAHR_PRESET_PRECISE, &room, (tahr_vec3){0, 0, HALF + 0.02});
        w.input.move = (tahr_vec3){DIAGONAL, DIAGONAL, 0};
        walk(&w, 3);
        double x = w.state.position.x, gap = 2 - RADIUS - w.state.position.y;
        walk(&w, 1);
        assert_in_band(&w, gap);
        assert_true(w.state.position.x - x > 0.6 * w.config.max_speed);
        assert_true(fabs(2 - RADIUS - w.state.position.y - gap) < CLOSE);
        assert_in_band(&w, w.state.position.z - HALF);
        end(&w);
    }
}

/* With 5 cm of its base on the platform, and with none. */
static void a_flat_base_stands_on_an_edge_until_it_leaves_it(void **state)
{
    tahr_body_desc platform = box(-5, 0, -1, 5, 10, 1);
    walker w;
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        if (kind == 2) continue; /* an ellipsoid's is round */
        begin(&w, kind, TAHR_PRESET_PRECISE, &platform, (tahr_vec3){RADIUS - 0.05, 0, HALF + 0.015});
        walk(&w, 1);
        assert_int_equal(w.state.mode, TAHR_MODE_WALKING);
        assert_in_band(&w, w.state.position.z - HALF);
        assert_true(fabs(w.state.position.x - (RADIUS - 0.05)) < 1e-9);
        end(&w);
        begin(&w, kind, TAHR_PRESET_PRECISE, &platform, (tahr_vec3){RADIUS + 0.02, 0, HALF + 0.015});
        walk(&w, 0.5);
        assert_int_equal(w.state.mode, TAHR_MODE_FALLING);
        end(&w);
    }
}

static void an_ellipsoid_slides_off_an_edge_that_it_touches_with_its_side(void **state)
{
    tahr_body_desc platform = box(-5, 0, -1, 5, 10, 1);
    walker w;
    (void)state;
    begin(&w, 2, TAHR_PRESET_PRECISE, &platform, (tahr_vec3){RADIUS - 0.02, 0, HALF + 0.1});
    walk(&w, 2);
    assert_true(w.state.position.z < 0);
    end(&w);
}

static void crouches_under_a_ceiling_and_rises_where_there_is_room(void **state)
{
    tahr_body_desc floor = box(0, 0, -1, 10, 10, 1);
    walker w;
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        begin(&w, kind, TAHR_PRESET_PRECISE, &floor, (tahr_vec3){0, 0, HALF + 0.015});
        walk(&w, 0.2);
        w.input.crouch = 1;
        walk(&w, 0.2);
        double half = kind == 3 ? HALF : w.config.crouched_half_height; /* a hull cannot */
        assert_true(w.state.half_height == half);
        assert_in_band(&w, w.state.position.z - half);
        w.input.crouch = 0;
        walk(&w, 0.2);
        assert_true(w.state.half_height == HALF);
        assert_in_band(&w, w.state.position.z - HALF);
        end(&w);
    }
}

static void a_hull_must_be_a_template_of_the_scene_and_as_large(void **state)
{
    tahr_body_desc floor = box(0, 0, -1, 10, 10, 1);
    tahr_mover *mover = NULL;
    walker w;
    (void)state;
    begin(&w, 3, TAHR_PRESET_PRECISE, &floor, (tahr_vec3){0, 0, HALF + 0.02});
    w.config.shape.hull = 0; /* a box */
    assert_int_equal(tahr_mover_create(w.world, &w.config, &mover), TAHR_E_ARGUMENT);
    w.config.shape.hull = 2; /* nobody */
    assert_int_equal(tahr_mover_create(w.world, &w.config, &mover), TAHR_E_ARGUMENT);
    w.config.shape = shape_of(3);
    w.config.shape.half_y *= 1.001;
    assert_int_equal(tahr_mover_create(w.world, &w.config, &mover), TAHR_E_ARGUMENT);
    w.config.shape = shape_of(3);
    w.input.flags = TAHR_INPUT_SHAPE;
    w.input.half_height = 0.5;
    assert_int_equal(tahr_mover_step(w.mover, &w.input, 0.01, &w.state, NULL), TAHR_E_ARGUMENT);
    assert_null(mover);
    end(&w);
}

/* A floor of hills with a rim around it and solids of every kind on it, and a way by dice: nobody falls through, nobody
 * gets deeper into anything than a backend may let them (5 mm), every step is answered. */
enum { CELLS = 24, SOLIDS = 40, STEPS = 1500 };

static double hills[(CELLS + 1) * (CELLS + 1) * 3];
static uint32_t hill_triangles[CELLS * CELLS * 6];

static tahr_body_desc hilly_floor(void)
{
    tahr_body_desc floor;
    uint32_t *index = hill_triangles;
    for (uint32_t i = 0; i < (CELLS + 1) * (CELLS + 1); i++) {
        double x = (double)(i % (CELLS + 1)) - CELLS / 2, y = (double)(i / (CELLS + 1)) - CELLS / 2;
        int rim = fabs(x) == CELLS / 2 || fabs(y) == CELLS / 2;
        hills[3 * i] = x;
        hills[3 * i + 1] = y;
        hills[3 * i + 2] = rim ? 8 : 0.3 * sin(x) + 0.3 * cos(1.3 * y);
    }
    for (uint32_t i = 0; i < CELLS * CELLS; i++) {
        uint32_t a = i / CELLS * (CELLS + 1) + i % CELLS;
        const uint32_t cell[6] = {a, a + 1, a + CELLS + 2, a, a + CELLS + 2, a + CELLS + 1};
        for (int k = 0; k < 6; k++)
            *index++ = cell[k];
    }
    tahr_body_desc_init(&floor, sizeof floor, TAHR_BODY_MESH);
    floor.vertices = hills;
    floor.indices = hill_triangles;
    floor.vertex_count = (CELLS + 1) * (CELLS + 1);
    floor.triangle_count = CELLS * CELLS * 2;
    return floor;
}

static void open_park(walker *w, int kind, oracle_random *dice)
{
    static const uint32_t types[] = {TAHR_BODY_BOX,  TAHR_BODY_SPHERE,    TAHR_BODY_CAPSULE, TAHR_BODY_CYLINDER,
                                     TAHR_BODY_CONE, TAHR_BODY_ELLIPSOID, TAHR_BODY_HULL};
    tahr_body_desc bodies[SOLIDS + 2] = {hilly_floor()};
    tahr_vec3 at = {0, 0, 3.5};
    tahr_world_desc desc;
    for (uint32_t i = 1; i < SOLIDS + 2; i++) {
        tahr_body_desc *b = &bodies[i];
        tahr_body_desc_init(b, sizeof *b, types[i % 7]);
        b->pose.position = (tahr_vec3){oracle_uniform(dice, -10, 10), oracle_uniform(dice, -10, 10), 0};
        b->pose.orientation = (tahr_quat){0, sin(0.1 * i), 0, cos(0.1 * i)};
        b->radius = oracle_uniform(dice, 0.2, 0.6);
        b->half_height = b->radius + oracle_uniform(dice, 0, 0.6);
        b->half_extents = dice_vec(dice, 0.2, 0.9);
        b->vertices = hull_vertices;
        b->vertex_count = HULL_VERTICES;
    }
    tahr_body_desc_init(&bodies[1], sizeof bodies[1], TAHR_BODY_HULL);
    bodies[1].vertices = hull_vertices;
    bodies[1].vertex_count = HULL_VERTICES;
    bodies[1].flags = TAHR_BODY_TEMPLATE;
    memset(w, 0, sizeof *w);
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = bodies;
    desc.body_count = SOLIDS + 2;
    assert_int_equal(tahr_world_open(tahr_backend_v1_ccd(), &desc, &w->world), TAHR_OK);
    tahr_config_init(&w->config, sizeof w->config, TAHR_PRESET_PRECISE);
    w->config.shape = shape_of(kind);
    assert_int_equal(tahr_mover_create(w->world, &w->config, &w->mover), TAHR_OK);
    assert_int_equal(tahr_state_init(&w->state, &w->config, &at), TAHR_OK);
    w->input.struct_size = sizeof w->input;
}

static double deepest(const walker *w)
{
    tahr_contact contacts[16];
    tahr_contact_query q = {.shape = w->config.shape,
                            .position = w->state.position,
                            .up = w->state.up,
                            .orientation = w->state.orientation,
                            .mask = 0xFFFFFFFFu,
                            .ignore_body = TAHR_NO_BODY};
    uint32_t count = 0;
    assert_true(tahr_world_contacts(w->world, &q, contacts, 16, &count) >= 0);
    return count ? -contacts[0].distance : 0;
}

static void wanders_among_solids_of_every_kind(void **state)
{
    oracle_random dice = {77};
    walker w;
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        double worst = 0, way = 0;
        int unlucky = 0;
        open_park(&w, kind, &dice);
        for (int i = 0; i < STEPS; i++) {
            tahr_vec3 before = w.state.position;
            if (i % 40 == 0) w.input.move = dice_vec(&dice, -1, 1);
            w.input.move.z = 0;
            w.input.jump = i % 90 < 10;
            tahr_status status = tahr_mover_step(w.mover, &w.input, 1.0 / 60, &w.state, NULL);
            assert_true(status >= 0);
            unlucky += status != TAHR_OK && status != TAHR_STUCK;
            worst = fmax(worst, deepest(&w));
            way += hypot(w.state.position.x - before.x, w.state.position.y - before.y);
            assert_true(w.state.position.z > -1);
        }
        print_message("    shape %u: %.0f m on the way, %.2g m deep at most, %d steps with a complaint\n",
                      w.config.shape.type, way, worst, unlucky);
        assert_true(worst <= 5e-3);
        assert_true(way > 15);
        assert_true(unlucky * 100 <= STEPS);
        end(&w);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(falls_and_lands_a_skin_above_a_level_floor),
        cmocka_unit_test(walks_level_ground_straight_and_at_full_speed),
        cmocka_unit_test(stands_on_a_slope_as_high_as_its_extent_says),
        cmocka_unit_test(steps_up_what_is_not_higher_than_a_step),
        cmocka_unit_test(slides_along_a_wall_a_skin_away_from_it),
        cmocka_unit_test(a_flat_base_stands_on_an_edge_until_it_leaves_it),
        cmocka_unit_test(an_ellipsoid_slides_off_an_edge_that_it_touches_with_its_side),
        cmocka_unit_test(crouches_under_a_ceiling_and_rises_where_there_is_room),
        cmocka_unit_test(wanders_among_solids_of_every_kind),
        cmocka_unit_test(a_hull_must_be_a_template_of_the_scene_and_as_large),
    };
    make_hull();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
#endif
