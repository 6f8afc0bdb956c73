/* SPDX-License-Identifier: MIT
 * test_attach.c: Tahr in a Box2D world of the user's, of both versions: filters, sensors, geometry without Box2D's
 * skin, seams, bodies that Box2D moves, and what is refused. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <tahr/tahr.h>

#include "yard.h"

/* One world of Box2D with Tahr in it. */
typedef struct scene {
    const yard *yard;
    void *place;
    tahr_box2d_desc options;
    tahr_world *world;
    char message[256];
} scene;

static void keep_message(void *user, int32_t level, const char *message)
{
    scene *s = user;
    (void)level;
    snprintf(s->message, sizeof s->message, "%s", message);
}

static scene begin(const yard *y)
{
    scene s = {.yard = y, .place = y->open(), .options = {.struct_size = sizeof s.options}};
    y->attach(s.place, &s.options);
    return s;
}

static tahr_status try_attach(scene *s, uint32_t body_count, const tahr_body_desc *bodies)
{
    tahr_world_desc desc;
    tahr_log log = {s, keep_message};
    tahr_world_desc_init(&desc, sizeof desc);
    desc.options = &s->options;
    desc.log = &log;
    desc.body_count = body_count;
    desc.bodies = bodies;
    return tahr_world_open(tahr_backend_v1_box2d(), &desc, &s->world);
}

static void attach(scene *s)
{
    if (try_attach(s, 0, NULL) != TAHR_OK) {
        fail_msg("%s", s->message);
    }
}

static void end(scene *s)
{
    tahr_world_close(s->world);
    s->yard->close(s->place);
}

static uint32_t add_box(scene *s, double x, double y, double a, double b)
{
    yard_body body = {.shape = YARD_BOX, .x = x, .y = y, .a = a, .b = b};
    return s->yard->add(s->place, &body);
}

static tahr_shape circle(double radius)
{
    return (tahr_shape){TAHR_SHAPE_SPHERE, 0, radius, radius, 0, 0};
}

static tahr_sweep sweep_of(tahr_shape shape, double x, double y, double dx, double dy, double margin)
{
    const double h = sqrt(0.5);
    return (tahr_sweep){.shape = shape,
                        .position = {x, y, 0},
                        .up = {0, 1, 0},
                        .orientation = {-h, 0, 0, h},
                        .motion = {dx, dy, 0},
                        .margin = margin,
                        .mask = 0xFFFFFFFFu,
                        .ignore_body = TAHR_NO_BODY};
}

/* How many hits, of at most two. */
static uint32_t ask(scene *s, const tahr_sweep *q, tahr_hit hits[2])
{
    uint32_t count = 0;
    assert_int_equal(tahr_world_sweep(s->world, q, hits, 2, &count), TAHR_OK);
    return count;
}

static void close_to(double a, double b, double tolerance)
{
    if (!(fabs(a - b) <= tolerance)) {
        fail_msg("%.12g is not %.12g within %g", a, b, tolerance);
    }
}

static const yard *yards[2];
static int yard_count;

/* (category of the one) & (mask of the other), both ways; a common group overrules them. */
static void a_character_meets_what_a_fixture_with_its_filter_would(void **unused)
{
    const struct {
        uint64_t own_category, own_mask, category, mask;
        int own_group, group, meets;
    } rows[] = {
        {0, 0, 0, 0, 0, 0, 1},   {0, 0, 2, 0, 0, 0, 1}, {0, 1, 2, 0, 0, 0, 0}, {0, 2, 2, 0, 0, 0, 1},
        {0, 0, 1, 2, 0, 0, 0},   {2, 0, 1, 2, 0, 0, 1}, {4, 0, 1, 2, 0, 0, 0}, {0, 0, 1, 0, -3, -3, 0},
        {0, 0, 1, 0, -3, -4, 1}, {0, 1, 2, 0, 5, 5, 1}, {0, 1, 2, 0, 5, 6, 0}, {0x8000, 0, 1, 0x8000, 0, 0, 1},
    };
    (void)unused;
    for (int k = 0; k < yard_count * 12; k++) {
        scene s = begin(yards[k / 12]);
        yard_body body = {.shape = YARD_BOX, .x = 3, .a = 1, .b = 1};
        tahr_hit hits[2];
        body.category = rows[k % 12].category;
        body.mask = rows[k % 12].mask;
        body.group = rows[k % 12].group;
        s.yard->add(s.place, &body);
        s.options.category_bits = rows[k % 12].own_category;
        s.options.mask_bits = rows[k % 12].own_mask;
        s.options.group_index = rows[k % 12].own_group;
        attach(&s);
        tahr_sweep q = sweep_of(circle(0.5), 0, 0, 4, 0, 0);
        if ((int)ask(&s, &q, hits) != rows[k % 12].meets) {
            fail_msg("Box2D %s, row %d", s.yard->name, k % 12);
        }
        end(&s);
    }
}

static void the_mask_of_a_query_chooses_among_categories(void **unused)
{
    (void)unused;
    for (int k = 0; k < yard_count; k++) {
        scene s = begin(yards[k]);
        yard_body body = {.shape = YARD_BOX, .x = 3, .a = 1, .b = 1, .category = 4};
        tahr_hit hits[2];
        s.yard->add(s.place, &body);
        attach(&s);
        tahr_sweep q = sweep_of(circle(0.5), 0, 0, 4, 0, 0);
        q.mask = 4;
        assert_int_equal(ask(&s, &q, hits), 1);
        q.mask = 3;
        assert_int_equal(ask(&s, &q, hits), 0);
        end(&s);
    }
}

static void sensors_are_felt_on_the_way_and_never_block(void **unused)
{
    (void)unused;
    for (int k = 0; k < yard_count; k++) {
        scene s = begin(yards[k]);
        yard_body gate = {.shape = YARD_BOX, .sensor = 1, .x = 2, .a = 0.25, .b = 1};
        tahr_hit hits[2];
        tahr_contact contacts[4];
        uint32_t id = s.yard->add(s.place, &gate), wall = add_box(&s, 4, 0, 0.5, 1), count = 0;
        attach(&s);
        tahr_sweep q = sweep_of(circle(0.5), 0, 0, 4, 0, 0);
        assert_int_equal(ask(&s, &q, hits), 2);
        assert_true(hits[0].sensor && !hits[0].blocking && hits[0].body == id);
        close_to(hits[0].fraction * 4, 1.25, 1e-9);
        assert_true(hits[1].blocking && hits[1].body == wall);
        close_to(hits[1].fraction * 4, 3, 1e-9);
        tahr_contact_query near = {.shape = circle(0.5),
                                   .position = {2, 0, 0},
                                   .up = {0, 1, 0},
                                   .orientation = {0, 0, 0, 1},
                                   .mask = 0xFFFFFFFFu,
                                   .ignore_body = TAHR_NO_BODY};
        assert_int_equal(tahr_world_contacts(s.world, &near, contacts, 4, &count), TAHR_OK);
        assert_true(count == 1 && contacts[0].sensor);
        near.flags = TAHR_CONTACTS_SOLID;
        assert_int_equal(tahr_world_contacts(s.world, &near, contacts, 4, &count), TAHR_OK);
        assert_int_equal(count, 0);
        end(&s);
    }
}

/* Numbers that floats hold: then distances are exact, here and 4096 m away, and nothing is 1 cm larger than it is. */
static void geometry_has_no_skin_near_or_far(void **unused)
{
    const double far[] = {0, 4096};
    (void)unused;
    for (int k = 0; k < yard_count * 2 * 4; k++) {
        scene s = begin(yards[k / 8]);
        double x = far[k / 4 % 2], expected[] = {1, 1.25, 1.375, 1};
        const int shapes[] = {YARD_BOX, YARD_CIRCLE, YARD_CAPSULE, YARD_EDGE};
        yard_body body = {.shape = shapes[k % 4], .x = x, .y = -x, .a = 0.5, .b = 0.125};
        tahr_hit hits[2];
        if (body.shape == YARD_CIRCLE) {
            body.a = 0.25;
        }
        if (body.shape == YARD_CAPSULE && !s.yard->has_capsule) {
            end(&s);
            continue;
        }
        s.yard->add(s.place, &body);
        attach(&s);
        tahr_sweep q = sweep_of(circle(0.5), x - 2, -x, 4, 0, 0);
        assert_int_equal(ask(&s, &q, hits), 1);
        close_to(hits[0].fraction * 4, expected[k % 4], 2e-9);
        close_to(hits[0].normal.x, -1, 1e-9);
        q.margin = 0.25;
        assert_int_equal(ask(&s, &q, hits), 1);
        close_to(hits[0].fraction * 4, expected[k % 4] - 0.25, 2e-9);
        end(&s);
    }
}

/* A corner alone, met by a circle as any corner. */
static void an_edge_without_length_is_a_point(void **unused)
{
    (void)unused;
    scene s = begin(yards[0]);
    yard_body body = {.shape = YARD_EDGE, .a = 0};
    tahr_hit hits[2];
    if (strcmp(s.yard->name, "2.4") == 0) { /* 3 makes none */
        s.yard->add(s.place, &body);
        attach(&s);
        tahr_sweep q = sweep_of(circle(0.5), -2, 0.3, 4, 0, 0);
        assert_int_equal(ask(&s, &q, hits), 1);
        close_to(hits[0].fraction * 4, 2 - 0.4, 2e-9);
    }
    end(&s);
}

static tahr_shape character(uint32_t type)
{
    tahr_shape s = {type, 0, type == TAHR_SHAPE_BOX ? 0 : 0.35, type == TAHR_SHAPE_SPHERE ? 0.35 : 0.9, 0, 0};
    s.half_x = s.half_y = type == TAHR_SHAPE_BOX ? 0.35 : 0;
    return s;
}

static tahr_config config_of(uint32_t type)
{
    tahr_config c;
    assert_int_equal(tahr_config_init(&c, sizeof c, TAHR_PRESET_PRECISE), TAHR_OK);
    c.gravity = (tahr_vec3){0, -9.81, 0};
    c.plane = (tahr_vec3){0, 0, 1};
    c.shape = character(type);
    return c;
}

/* Tiles of 0.3 m at 100 m and beyond, where Box2D's floats put them up to 8 micrometres from where they should be. */
static void a_thousand_seams_of_a_users_world_are_none(void **unused)
{
    const uint32_t types[] = {TAHR_SHAPE_CAPSULE, TAHR_SHAPE_SPHERE, TAHR_SHAPE_BOX};
    (void)unused;
    for (int k = 0; k < yard_count; k++) {
        scene s = begin(yards[k]);
        for (int i = 0; i < 240; i++) {
            add_box(&s, 100.1 + 0.3 * i, -0.55, 0.15, 0.5);
        }
        attach(&s);
        for (int i = 0; i < 3 * 5; i++) {
            tahr_config c = config_of(types[i % 3]);
            tahr_mover *mover;
            tahr_state state;
            tahr_event events[16];
            tahr_report report = {.struct_size = sizeof report, .events = events, .event_capacity = 16};
            tahr_input input = {.struct_size = sizeof input};
            const tahr_vec3 at = {102 + 0.07 * i, c.shape.half_height - 0.0375, 0};
            assert_int_equal(tahr_mover_create(s.world, &c, &mover), TAHR_OK);
            assert_int_equal(tahr_state_init(&state, &c, &at), TAHR_OK);
            int hits = 0;
            double lost = c.max_speed * c.max_speed / (2 * c.acceleration);
            double start = at.x;
            for (int n = -30; n < 600; n++) { /* lands first */
                input.move.x = n >= 0;
                start = n == 0 ? state.position.x : start;
                assert_true(tahr_mover_step(mover, &input, 1.0 / 60, &state, &report) >= 0);
                for (uint32_t e = 0; e < report.event_count; e++) {
                    hits += events[e].type == TAHR_EVENT_HIT;
                }
            }
            assert_int_equal(hits, 0);
            assert_true(state.position.x - start > 0.999 * (10 * c.max_speed - lost));
            tahr_mover_destroy(mover);
        }
        end(&s);
    }
}

/* Along the seams below the margin, and off the end of the chain, where its ghost says that it goes on. */
static void chains_are_smooth_and_solid_from_one_side(void **unused)
{
    double corners[2 * 40];
    (void)unused;
    for (int i = 0; i < 40; i++) {
        corners[2 * i] = 10 - 0.3 * i;
        corners[2 * i + 1] = 0;
    }
    for (int k = 0; k < yard_count * 3; k++) {
        scene s = begin(yards[k / 3]);
        yard_body chain = {.shape = YARD_CHAIN, .corners = corners, .corner_count = 40};
        tahr_shape shape = character(TAHR_SHAPE_SPHERE + (uint32_t)k % 3);
        tahr_hit hits[2];
        s.yard->add(s.place, &chain);
        attach(&s);
        tahr_sweep q = sweep_of(shape, 0, shape.half_height + 0.005, 12, 0, 0.01);
        assert_int_equal(ask(&s, &q, hits), 0);
        q = sweep_of(shape, 5, 3, 0, -3, 0.01);
        assert_int_equal(ask(&s, &q, hits), 1);
        close_to(hits[0].fraction * 3, 3 - shape.half_height - 0.01, 2e-9);
        close_to(hits[0].normal.y, 1, 0);
        q = sweep_of(shape, 5, -3, 0, 6, 0.01);
        assert_int_equal(ask(&s, &q, hits), 0);
        end(&s);
    }
}

static void one_way(void *user, tahr_box2d_shape *shape)
{
    const uint32_t *ids = user;
    shape->flags |= shape->body == ids[0] ? (uint32_t)TAHR_BODY_ONE_WAY : 0u;
    shape->hidden = shape->body == ids[1];
    shape->surface = shape->body == ids[0] ? 42 : 0;
}

static void a_function_may_say_more_of_shapes(void **unused)
{
    (void)unused;
    for (int k = 0; k < yard_count; k++) {
        scene s = begin(yards[k]);
        uint32_t ids[2];
        tahr_hit hits[2];
        ids[0] = add_box(&s, 0, 0, 2, 0.25);
        ids[1] = add_box(&s, 0, 1, 2, 0.25);
        s.options.shape = one_way;
        s.options.user = ids;
        attach(&s);
        tahr_sweep up = sweep_of(circle(0.5), 0, -2, 0, 4, 0.01), down = sweep_of(circle(0.5), 0, 2, 0, -4, 0.01);
        assert_int_equal(ask(&s, &up, hits), 0);
        assert_int_equal(ask(&s, &down, hits), 1);
        assert_int_equal(hits[0].surface, 42);
        close_to(hits[0].fraction * 4, 2 - 0.75 - 0.01, 2e-9);
        end(&s);
    }
}

/* On a turntable a metre from its axis, for two seconds: no slip against the platform as Box2D has it. */
static void who_stands_on_a_kinematic_body_goes_with_it(void **unused)
{
    (void)unused;
    for (int k = 0; k < yard_count; k++) {
        scene s = begin(yards[k]);
        yard_body seesaw = {.type = YARD_KINEMATIC, .shape = YARD_BOX, .a = 3, .b = 0.25};
        uint32_t id = s.yard->add(s.place, &seesaw);
        tahr_config c = config_of(TAHR_SHAPE_CAPSULE);
        tahr_mover *mover;
        tahr_state state;
        tahr_body_motion motion;
        tahr_input input = {.struct_size = sizeof input};
        const tahr_vec3 at = {1, 0.25 + 0.9 + 0.0125, 0};
        attach(&s);
        assert_int_equal(tahr_mover_create(s.world, &c, &mover), TAHR_OK);
        assert_int_equal(tahr_state_init(&state, &c, &at), TAHR_OK);
        double before[3], after[3], along[2];
        for (int n = 0; n < 180; n++) {
            if (n == 60) {
                s.yard->drive(s.place, id, 1.5, 0.75, 0.125);
            }
            s.yard->step(s.place, 1.0 / 60);
            assert_int_equal(tahr_world_touch(s.world), TAHR_OK);
            assert_true(tahr_mover_step(mover, &input, 1.0 / 60, &state, NULL) >= 0);
            if (n == 59) {
                s.yard->where(s.place, id, before);
                along[0] = state.position.x - before[0];
            }
        }
        s.yard->where(s.place, id, after);
        assert_int_equal(tahr_world_body(s.world, id, &motion), TAHR_OK);
        close_to(motion.velocity.x, 1.5, 1e-6);
        close_to(motion.velocity.y, 0.75, 1e-6);
        close_to(motion.angular_velocity.z, 0.125, 1e-6);
        close_to(motion.pose.position.x, after[0], 0);
        close_to(2 * asin(motion.pose.orientation.z), after[2], 1e-6);
        assert_int_equal(state.base.body, id);
        close_to(after[2], 0.25, 1e-4);
        /* its foot, in the frame of the platform, where it was */
        double fx = state.position.x - after[0], fy = state.position.y - 0.9 - after[1];
        along[1] = cos(after[2]) * fx + sin(after[2]) * fy;
        /* Upright, a round foot lifts off a slope by (r + g) / cos 0.25 - r - g = 11 mm, 3 mm of it along the slope. */
        close_to(along[1], along[0], 0.004);
        assert_true(state.position.x > 3.5);
        tahr_mover_destroy(mover);
        end(&s);
    }
}

static void a_body_that_is_gone_is_not_found(void **unused)
{
    (void)unused;
    for (int k = 0; k < yard_count; k++) {
        scene s = begin(yards[k]);
        tahr_body_motion motion;
        uint32_t stays = add_box(&s, 0, 0, 1, 1), goes = add_box(&s, 5, 0, 1, 1);
        attach(&s);
        assert_int_equal(tahr_world_body(s.world, goes, &motion), TAHR_OK);
        assert_int_equal(motion.flags, TAHR_BODY_NO_BASE);
        s.yard->remove(s.place, goes);
        assert_int_equal(tahr_world_body(s.world, goes, &motion), TAHR_E_NOT_FOUND);
        assert_true(add_box(&s, 5, 0, 1, 1) != goes); /* a new one has a new number */
        assert_int_equal(tahr_world_body(s.world, goes, &motion), TAHR_E_NOT_FOUND);
        assert_int_equal(tahr_world_body(s.world, stays, &motion), TAHR_OK);
        end(&s);
    }
}

static uint32_t same_for_all(void *user, const void *body)
{
    (void)user, (void)body;
    return 7;
}

static void refuse(scene *s, tahr_status status, uint32_t count, const tahr_body_desc *bodies, const char *word)
{
    assert_int_equal(try_attach(s, count, bodies), status);
    assert_null(s->world);
    if (!strstr(s->message, word)) {
        fail_msg("\"%s\" does not name %s", s->message, word);
    }
}

static void what_does_not_fit_is_refused_by_name(void **unused)
{
    tahr_body_desc body;
    (void)unused;
    tahr_body_desc_init(&body, sizeof body, TAHR_BODY_BOX);
    body.half_extents = (tahr_vec3){1, 1, 1};
    for (int k = 0; k < yard_count; k++) {
        scene s = begin(yards[k]);
        tahr_box2d_desc good = s.options;
        add_box(&s, 0, 0, 1, 1);
        add_box(&s, 3, 0, 1, 1);
        refuse(&s, TAHR_E_ARGUMENT, 1, &body, "desc.bodies");
        s.options.engine = 5;
        refuse(&s, TAHR_E_ARGUMENT, 0, NULL, "options.engine");
        s.options = good;
        s.options.engine = good.world2 ? TAHR_BOX2D_3 : TAHR_BOX2D_2;
        refuse(&s, TAHR_E_ARGUMENT, 0, NULL, "options.engine");
        s.options = good;
        s.options.body_id = same_for_all;
        refuse(&s, TAHR_E_ARGUMENT, 0, NULL, good.world2 ? "options.world2" : "options.body_id");
        s.options = good;
        if (good.world3) {
            s.options.world3 ^= 0xFFFF;
            refuse(&s, TAHR_E_ARGUMENT, 0, NULL, "options.world3");
        }
        s.options = good;
        s.options.struct_size = 4;
        refuse(&s, TAHR_E_STRUCT_SIZE, 0, NULL, "struct_size");
        end(&s);
    }
}

/* Also the id that the first world will have; and that of a world in another copy of Box2D 3 looks the same from here:
 * only in this one is there none. Runs before any yard is opened. */
static void a_world_that_was_never_created_is_refused(void **unused)
{
    scene s;
    (void)unused;
#ifdef TAHR_BOX2D_HAS_3
    memset(&s, 0, sizeof s);
    s.options.struct_size = sizeof s.options;
    for (uint32_t index = 1; index < 4; index++) {
        s.options.world3 = index << 16; /* as b2StoreWorldId has it */
        refuse(&s, TAHR_E_ARGUMENT, 0, NULL, "options.world3");
        assert_non_null(strstr(s.message, "libtahr_box2d.a"));
    }
#else
    (void)s;
    printf("SKIP: box2d_attach: a_world_that_was_never_created_is_refused needs Box2D 3\n");
    skip();
#endif
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_world_that_was_never_created_is_refused),
        cmocka_unit_test(a_character_meets_what_a_fixture_with_its_filter_would),
        cmocka_unit_test(the_mask_of_a_query_chooses_among_categories),
        cmocka_unit_test(sensors_are_felt_on_the_way_and_never_block),
        cmocka_unit_test(geometry_has_no_skin_near_or_far),
        cmocka_unit_test(an_edge_without_length_is_a_point),
        cmocka_unit_test(a_thousand_seams_of_a_users_world_are_none),
        cmocka_unit_test(chains_are_smooth_and_solid_from_one_side),
        cmocka_unit_test(a_function_may_say_more_of_shapes),
        cmocka_unit_test(who_stands_on_a_kinematic_body_goes_with_it),
        cmocka_unit_test(a_body_that_is_gone_is_not_found),
        cmocka_unit_test(what_does_not_fit_is_refused_by_name),
    };
#ifdef TAHR_BOX2D_HAS_2
    yards[yard_count++] = &yard_2;
#endif
#ifdef TAHR_BOX2D_HAS_3
    yards[yard_count++] = &yard_3;
#endif
    return cmocka_run_group_tests(tests, NULL, NULL);
}
