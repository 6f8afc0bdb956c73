/* SPDX-License-Identifier: MIT
 * test_query.c: backends that lie, that know no margin, that answer at random; and the three questions asked directly. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fake_world.h"

enum {
    LIE_NONE,
    LIE_NORMAL_NAN,
    LIE_NORMAL_LONG,
    LIE_NORMAL_ZERO,
    LIE_SURFACE_NAN,
    LIE_FRACTION_LOW,
    LIE_FRACTION_HIGH,
    LIE_FRACTION_NAN,
    LIE_COUNT,
    LIE_STATUS,
    LIE_DISTANCE,
    LIE_DEPTH,
    LIE_POINT,
    LIE_RULE,
    LIE_ANGLE,
    LIES
};

static const char *const lie_fields[LIES] = {"",         "normal",   "normal",   "normal",        "surface_normal",
                                             "fraction", "fraction", "fraction", "count",         "status",
                                             "distance", "depth",    "point",    "walkable_rule", "walkable_rule"};

typedef struct liar {
    fake_world fake;
    int lie, contact_lie, random;
    int unknown; /* this body is answered as "unknown" instead of "blocking"; 0: none */
    uint64_t seed;
    uint32_t asked;
} liar;

static double real(liar *l, double low, double high)
{
    l->seed = l->seed * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(l->seed >> 33) / 2147483648.0;
}

static void spoil(int lie, tahr_hit *h, uint32_t *count)
{
    double *bad[LIES] = {NULL,         &h->normal.y, &h->normal.x, NULL, &h->surface_normal.z,
                         &h->fraction, &h->fraction, &h->fraction, NULL, NULL,
                         &h->distance, &h->depth,    &h->point.y,  NULL, &h->walkable_angle};
    const double value[LIES] = {0, NAN, 1.5, 0, NAN, -1, 2, NAN, 0, 0, NAN, -1, INFINITY, 0, NAN};
    if (bad[lie]) {
        *bad[lie] = value[lie];
    }
    if (lie == LIE_NORMAL_ZERO) {
        h->normal = fake_vec(0, 0, 0);
    } else if (lie == LIE_COUNT) {
        *count = 4000000;
    } else if (lie == LIE_DEPTH) {
        h->start_overlap = 1;
    } else if (lie == LIE_RULE) {
        h->walkable_rule = 77;
    }
}

static tahr_vec3 direction(liar *l)
{
    for (;;) {
        tahr_vec3 v = {real(l, -1, 1), real(l, -1, 1), real(l, -1, 1)};
        double s = sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
        if (s > 0.1 && s < 1) {
            return fake_vec(v.x / s, v.y / s, v.z / s);
        }
    }
}

static void random_hit(liar *l, tahr_hit *h)
{
    memset(h, 0, sizeof *h);
    h->blocking = real(l, 0, 1) < 0.8;
    h->fraction = real(l, 0, 1) < 0.3 ? 0 : real(l, 0, 1);
    h->normal = direction(l);
    h->surface_normal = real(l, 0, 1) < 0.5 ? h->normal : direction(l);
    h->point = fake_vec(real(l, -1e3, 1e3), real(l, -1, 1), real(l, -2, 2));
    h->distance = real(l, -0.1, 0.1);
    h->unknown = real(l, 0, 1) < 0.05;
    if (real(l, 0, 1) < 0.2) {
        h->start_overlap = 1;
        h->depth = real(l, 0, 3);
    }
    h->body = (uint32_t)real(l, 0, 5);
    h->feature = (uint32_t)real(l, 0, 50);
    h->walkable_rule = (uint32_t)real(l, 0, 3.99);
    h->walkable_angle = real(l, -4, 4);
}

static tahr_status liar_sweep(void *self, tahr_query_context *context, const tahr_sweep *query, tahr_hit *hits,
                              uint32_t capacity, uint32_t *count)
{
    liar *l = self;
    (void)context, (void)capacity;
    l->asked++;
    memset(hits, 0, sizeof hits[0]);
    if (l->random) {
        random_hit(l, &hits[0]);
        *count = 1;
        return TAHR_OK;
    }
    fake_sweep(&l->fake, query, &hits[0]);
    *count = hits[0].blocking;
    if (*count && l->unknown && hits[0].body == (uint32_t)l->unknown) {
        tahr_hit gave_up = {.unknown = 1, .fraction = hits[0].fraction, .body = hits[0].body};
        hits[0] = gave_up; /* nothing is known of it but how far the way was free */
        return TAHR_OK;
    }
    if (*count && l->lie) {
        spoil(l->lie, &hits[0], count);
        return l->lie == LIE_STATUS ? TAHR_E_GEOMETRY : TAHR_OK;
    }
    return TAHR_OK;
}

static tahr_status liar_contacts(void *self, tahr_query_context *context, const tahr_contact_query *query,
                                 tahr_contact *contacts, uint32_t capacity, uint32_t *count)
{
    liar *l = self;
    (void)context;
    l->asked++;
    if (l->random) {
        *count = (uint32_t)real(l, 0, capacity + 0.99);
        for (uint32_t i = 0; i < *count; i++) {
            tahr_contact c = {
                .distance = real(l, -1, 0.02), .normal = direction(l), .surface_normal = direction(l), .feature = i};
            contacts[i] = c;
        }
        return TAHR_OK;
    }
    tahr_status status = fake_contacts(&l->fake, query, contacts, capacity, count);
    if (*count > 0) {
        contacts[0].normal.x = l->contact_lie == 1 ? NAN : contacts[0].normal.x;
        contacts[0].distance = l->contact_lie == 2 ? INFINITY : contacts[0].distance;
        *count = l->contact_lie == 3 ? capacity + 1 : *count;
        status = l->contact_lie == 4 ? TAHR_E_MEMORY : status;
        contacts[0].surface_normal.z = l->contact_lie == 5 ? 9 : contacts[0].surface_normal.z;
        contacts[0].point.z = l->contact_lie == 6 ? NAN : contacts[0].point.z;
        contacts[0].walkable_rule = l->contact_lie == 7 ? 9 : contacts[0].walkable_rule;
    }
    return status;
}

static tahr_status liar_ray(void *self, tahr_query_context *context, const tahr_ray *query, tahr_hit *hit, uint32_t *count)
{
    liar *l = self;
    (void)context;
    l->asked++;
    memset(hit, 0, sizeof *hit);
    if (l->random) {
        random_hit(l, hit);
        *count = hit->blocking;
        return TAHR_OK;
    }
    if (query->origin.z > 0 && query->origin.z + query->motion.z <= 0) { /* the plane z = 0 */
        hit->blocking = 1;
        hit->fraction = -query->origin.z / query->motion.z;
        hit->normal = hit->surface_normal = fake_vec(0, 0, 1);
        *count = 1;
        if (l->lie) {
            spoil(l->lie, hit, count);
        }
        return l->lie == LIE_STATUS ? TAHR_E_BACKEND : TAHR_OK;
    }
    return TAHR_OK;
}

static tahr_status liar_open(const tahr_host *host, const tahr_world_desc *desc, void **self)
{
    (void)host;
    *self = (void *)(uintptr_t)desc->options;
    return TAHR_OK;
}

static void liar_close(void *self)
{
    (void)self;
}

static tahr_backend liar_backend(uint32_t capabilities)
{
    tahr_backend b = {.struct_size = sizeof b,
                      .abi_major = TAHR_ABI_MAJOR,
                      .abi_minor = TAHR_ABI_MINOR,
                      .capabilities = capabilities,
                      .name = "liar",
                      .version = "1",
                      .open = liar_open,
                      .close = liar_close,
                      .sweep = liar_sweep,
                      .contacts = liar_contacts,
                      .ray = liar_ray};
    return b;
}

enum { ALL = TAHR_CAP_MARGIN | TAHR_CAP_CONTACTS | TAHR_CAP_RAY | TAHR_CAP_CAPSULE | TAHR_CAP_SPHERE | TAHR_CAP_BOX };

typedef struct bench {
    liar liar;
    fake_log log;
    tahr_backend backend;
    tahr_world *world;
    tahr_mover *mover;
    tahr_config config;
    tahr_state state;
    tahr_input input;
} bench;

static void open_bench(bench *b, uint32_t capabilities)
{
    tahr_world_desc desc;
    tahr_vec3 at = {0, 0, 0.95};
    memset(b, 0, sizeof *b);
    tahr_log log = fake_log_of(&b->log);
    b->backend = liar_backend(capabilities);
    fake_world_init(&b->liar.fake);
    fake_add_plane(&b->liar.fake, fake_vec(0, 0, 1), 0);
    tahr_world_desc_init(&desc, sizeof desc);
    desc.log = &log;
    desc.options = &b->liar;
    assert_int_equal(tahr_world_open(&b->backend, &desc, &b->world), TAHR_OK);
    b->config = fake_config();
    assert_int_equal(tahr_mover_create(b->world, &b->config, &b->mover), TAHR_OK);
    tahr_state_init(&b->state, &b->config, &at);
    b->input.struct_size = sizeof b->input;
}

static void close_bench(bench *b)
{
    tahr_mover_destroy(b->mover);
    tahr_world_close(b->world);
}

static void lies_of_a_sweep_end_the_step_and_are_named(void **unused)
{
    bench b;
    (void)unused;
    open_bench(&b, ALL);
    for (int lie = 1; lie < LIES; lie++) {
        for (int mode = TAHR_MODE_WALKING; mode <= TAHR_MODE_FALLING; mode++) {
            tahr_report report, kept;
            b.state.mode = (uint32_t)mode;
            tahr_state before = b.state;
            memset(&report, 0x11, sizeof report);
            report.struct_size = sizeof report;
            report.events = NULL;
            report.decisions = NULL;
            kept = report;
            b.liar.lie = lie;
            b.log.count = 0;
            tahr_status status = tahr_mover_step(b.mover, &b.input, 0.2, &b.state, &report);
            if (status != TAHR_E_BACKEND) {
                fail_msg("lie %d (%s): %s", lie, lie_fields[lie], tahr_status_name(status));
            }
            assert_memory_equal(&before, &b.state, sizeof before);
            assert_memory_equal(&report, &kept, sizeof report);
            assert_non_null(strstr(b.log.text, lie_fields[lie]));
            assert_non_null(strstr(b.log.text, "sweep"));
            assert_int_equal(b.log.count, 1);
        }
    }
    b.liar.lie = 0;
    assert_int_equal(tahr_mover_step(b.mover, &b.input, 0.2, &b.state, NULL), TAHR_OK);
    close_bench(&b);
}

static void lies_of_contacts_end_the_step_and_are_named(void **unused)
{
    const char *fields[] = {"", "normal", "distance", "count", "status", "surface_normal", "point", "walkable_rule"};
    bench b;
    (void)unused;
    open_bench(&b, ALL);
    b.state.position.z = 0.85; /* overlapped, so that contacts are asked for */
    for (int lie = 1; lie <= 7; lie++) {
        tahr_state before = b.state;
        b.liar.contact_lie = lie;
        assert_int_equal(tahr_mover_step(b.mover, &b.input, 0.1, &b.state, NULL), TAHR_E_BACKEND);
        assert_memory_equal(&before, &b.state, sizeof before);
        assert_non_null(strstr(b.log.text, fields[lie]));
        assert_non_null(strstr(b.log.text, "contacts"));
    }
    close_bench(&b);
}

static void unknown_blocks_at_the_last_free_fraction_with_a_flag(void **unused)
{
    bench b;
    (void)unused;
    open_bench(&b, ALL);
    b.liar.random = 1;
    for (int i = 0; i < 3000; i++) {
        tahr_report report = {.struct_size = sizeof report};
        tahr_status status = tahr_mover_step(b.mover, &b.input, 0.05, &b.state, &report);
        if (status == TAHR_UNKNOWN) {
            assert_true(report.flags & TAHR_REPORT_UNKNOWN);
            close_bench(&b);
            return;
        }
    }
    fail_msg("never");
}

static void unknown_that_does_not_say_blocking_blocks_all_the_same(void **unused)
{
    (void)unused;
    for (int mode = TAHR_MODE_WALKING; mode <= TAHR_MODE_FALLING; mode++) {
        bench b;
        uint32_t unknown_steps = 0;
        open_bench(&b, ALL);
        fake_add_plane(&b.liar.fake, fake_vec(-1, 0, 0), -3); /* a wall at x = 3 that the backend cannot decide */
        b.liar.unknown = 1;
        if (mode == TAHR_MODE_FALLING) {
            b.state.position.z = 30;
            b.state.velocity = fake_vec(6, 0, 0);
        }
        for (int i = 0; i < 60; i++) {
            tahr_report report = {.struct_size = sizeof report};
            double before = b.state.position.x;
            b.input.move = fake_vec(1, 0, 0);
            tahr_status status = tahr_mover_step(b.mover, &b.input, 1.0 / 60, &b.state, &report);
            int unknown = (report.flags & TAHR_REPORT_UNKNOWN) != 0;
            assert_int_equal(status == TAHR_UNKNOWN || status == TAHR_STUCK, unknown);
            assert_true(b.state.position.x <= 3 - 0.35 - 0.01 + 1e-12);
            if (unknown) {
                unknown_steps++;
                assert_near(b.state.position.x, 3 - 0.35 - 0.01, 1e-9);
                assert_true(report.time_lost > 0);
            } else {
                assert_true(b.state.position.x > before || i == 0);
            }
        }
        assert_true(unknown_steps > 1);
        close_bench(&b);
    }
}

/* house.md 4.11: wrong but well-formed: finite, within the cap, no farther than asked. */
static void random_answers_never_break_the_promises(void **unused)
{
    const double dts[] = {1.0 / 60, 0.1, 1, 1e-3};
    bench b;
    uint32_t most = 0;
    (void)unused;
    open_bench(&b, ALL);
    b.liar.random = 1;
    for (int i = 0; i < 20000; i++) {
        tahr_report report = {.struct_size = sizeof report};
        double dt = dts[i % 4];
        if (i % 20 == 0) {
            b.input.move = direction(&b.liar);
            b.input.jump = i % 40 == 0;
            b.state.velocity = fake_vec(0, 0, 0);
            b.state.position = fake_vec(0, 0, 1);
        }
        if (i % 50 == 0) {
            b.input.flags = TAHR_INPUT_GRAVITY * (uint32_t)(i % 100 == 0);
            b.input.gravity = direction(&b.liar);
        }
        tahr_state before = b.state;
        b.liar.asked = 0;
        tahr_status status = tahr_mover_step(b.mover, &b.input, dt, &b.state, &report);
        if (status < 0) {
            fail_msg("step %d: %s: %s", i, tahr_status_name(status), b.log.text);
        }
        most = b.liar.asked > most ? b.liar.asked : most;
        assert_true(b.liar.asked <= TAHR_MAX_QUERIES_PER_STEP);
        assert_int_equal(b.liar.asked, report.sweeps + report.contact_queries + report.rays);
        tahr_vec3 p = b.state.position, v = b.state.velocity, q = before.position, u = before.velocity;
        assert_true(isfinite(p.x + p.y + p.z + v.x + v.y + v.z) && isfinite(b.state.floor.distance));
        double travel = sqrt((p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y) + (p.z - q.z) * (p.z - q.z));
        double speed = fmax(sqrt(u.x * u.x + u.y * u.y + u.z * u.z), 6) + 9.81 * dt + 4.2;
        /* asked for, and in every slice a push of max_depenetration, a step, a snap; turning about the foot */
        double allowed = speed * dt + (1 + 0.4 + 0.8 + 0.015) * report.slices + 2 * 0.9;
        if (travel > allowed) {
            fail_msg("step %d: travelled %g, asked %g in %u slices", i, travel, speed * dt, report.slices);
        }
        for (int k = 0; k < 256; k++) {
            assert_int_equal(b.state.reserved[k], 0);
        }
    }
    assert_true(most > 20);
    close_bench(&b);
}

static void a_backend_without_margin_walks_the_same_path(void **unused)
{
    bench with, without;
    (void)unused;
    open_bench(&with, ALL);
    open_bench(&without, ALL & ~(uint32_t)TAHR_CAP_MARGIN);
    fake_add_plane(&with.liar.fake, fake_vec(-1, 0, 0), -3);
    fake_add_plane(&without.liar.fake, fake_vec(-1, 0, 0), -3);
    for (int i = 0; i < 200; i++) {
        with.input.move = without.input.move = fake_vec(0.8, 0.6, 0);
        with.input.jump = without.input.jump = i == 30;
        assert_int_equal(tahr_mover_step(with.mover, &with.input, 1.0 / 60, &with.state, NULL), TAHR_OK);
        assert_int_equal(tahr_mover_step(without.mover, &without.input, 1.0 / 60, &without.state, NULL), TAHR_OK);
        assert_int_equal(with.state.mode, without.state.mode);
        assert_near(with.state.position.x, without.state.position.x, 1e-6);
        assert_near(with.state.position.y, without.state.position.y, 1e-6);
        assert_near(with.state.position.z, without.state.position.z, 1e-6);
        assert_true(fake_clearance(&without.liar.fake, &without.config.shape, without.state.position) > 0.01 - 1e-6);
    }
    close_bench(&with);
    close_bench(&without);
}

static tahr_sweep good_sweep(void)
{
    tahr_sweep q = {.shape = {TAHR_SHAPE_CAPSULE, 0, 0.35, 0.9, 0, 0},
                    .position = {0, 0, 2},
                    .up = {0, 0, 1},
                    .orientation = {0, 0, 0, 1},
                    .motion = {0, 0, -4},
                    .margin = 0.01,
                    .mask = 0xFFFFFFFFu,
                    .ignore_body = TAHR_NO_BODY};
    return q;
}

static void direct_sweep_answers_and_checks(void **unused)
{
    bench b;
    tahr_hit hits[2], kept[2];
    uint32_t count = 99;
    tahr_sweep q = good_sweep();
    (void)unused;
    open_bench(&b, ALL);
    assert_int_equal(tahr_world_sweep(b.world, &q, hits, 2, &count), TAHR_OK);
    assert_int_equal(count, 1);
    assert_near(hits[0].fraction, (2 - 0.91) / 4, 1e-15);
    assert_near(hits[0].distance, 0.01, 1e-15);
    memset(hits, 0x55, sizeof hits);
    memcpy(kept, hits, sizeof hits);
    count = 99;
    assert_int_equal(tahr_world_sweep(NULL, &q, hits, 2, &count), TAHR_E_NULL);
    assert_int_equal(tahr_world_sweep(b.world, NULL, hits, 2, &count), TAHR_E_NULL);
    assert_int_equal(tahr_world_sweep(b.world, &q, NULL, 2, &count), TAHR_E_NULL);
    assert_int_equal(tahr_world_sweep(b.world, &q, hits, 2, NULL), TAHR_E_NULL);
    assert_int_equal(tahr_world_sweep(b.world, &q, hits, 0, &count), TAHR_E_ARGUMENT);
    const struct {
        const char *name;
        size_t offset;
        double value;
    } bad[] = {{"position", offsetof(tahr_sweep, position.y), NAN},
               {"up", offsetof(tahr_sweep, up.z), 1.1},
               {"orientation", offsetof(tahr_sweep, orientation.w), INFINITY},
               {"motion", offsetof(tahr_sweep, motion.x), NAN},
               {"margin", offsetof(tahr_sweep, margin), -1e-9},
               {"margin", offsetof(tahr_sweep, margin), NAN},
               {"shape.radius", offsetof(tahr_sweep, shape.radius), -1},
               {"shape.half_height", offsetof(tahr_sweep, shape.half_height), 0.1},
               {"motion", offsetof(tahr_sweep, motion.z), INFINITY},
               {"position", offsetof(tahr_sweep, position.x), 1e9}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        q = good_sweep();
        memcpy((char *)&q + bad[i].offset, &bad[i].value, sizeof(double));
        assert_int_equal(tahr_world_sweep(b.world, &q, hits, 2, &count), TAHR_E_ARGUMENT);
        assert_non_null(strstr(b.log.text, bad[i].name));
    }
    q = good_sweep();
    q.flags = 1u << 30;
    assert_int_equal(tahr_world_sweep(b.world, &q, hits, 2, &count), TAHR_E_ARGUMENT);
    assert_non_null(strstr(b.log.text, "flags"));
    q = good_sweep();
    q.reserved = 3;
    assert_int_equal(tahr_world_sweep(b.world, &q, hits, 2, &count), TAHR_E_ARGUMENT);
    assert_non_null(strstr(b.log.text, "reserved"));
    q = good_sweep();
    q.shape.reserved = 3;
    assert_int_equal(tahr_world_sweep(b.world, &q, hits, 2, &count), TAHR_E_ARGUMENT);
    assert_non_null(strstr(b.log.text, "reserved"));
    assert_memory_equal(hits, kept, sizeof hits);
    assert_int_equal(count, 99);
    close_bench(&b);
}

/* Unit, but their z axis is not up: tilted, on its head, and upright under another up. */
static void a_box_whose_z_axis_is_not_up_is_refused(void **unused)
{
    const tahr_quat tilted[] = {{0.6, 0, 0, 0.8}, {1, 0, 0, 0}, {0, 0.01, 0, 0.99994999874993749}};
    bench b;
    tahr_hit hit;
    tahr_contact contact;
    uint32_t count;
    (void)unused;
    open_bench(&b, ALL);
    tahr_sweep q = good_sweep(), round = q;
    q.shape = (tahr_shape){.type = TAHR_SHAPE_BOX, .half_height = 0.9, .half_x = 0.3, .half_y = 0.2};
    tahr_contact_query near = {.shape = q.shape, .position = q.position, .up = q.up, .mask = q.mask};
    near.ignore_body = TAHR_NO_BODY;
    for (size_t i = 0; i < sizeof tilted / sizeof tilted[0]; i++) {
        q.orientation = near.orientation = tilted[i];
        b.log.text[0] = 0;
        assert_int_equal(tahr_world_sweep(b.world, &q, &hit, 1, &count), TAHR_E_ARGUMENT);
        assert_non_null(strstr(b.log.text, "orientation"));
        b.log.text[0] = 0;
        assert_int_equal(tahr_world_contacts(b.world, &near, &contact, 1, &count), TAHR_E_ARGUMENT);
        assert_non_null(strstr(b.log.text, "orientation"));
        round.orientation = tilted[i]; /* means nothing to a capsule */
        assert_int_equal(tahr_world_sweep(b.world, &round, &hit, 1, &count), TAHR_OK);
    }
    q.orientation = near.orientation = (tahr_quat){0, 0, 0.6, 0.8}; /* turned about up */
    assert_int_equal(tahr_world_sweep(b.world, &q, &hit, 1, &count), TAHR_OK);
    assert_int_equal(tahr_world_contacts(b.world, &near, &contact, 1, &count), TAHR_OK);
    q.up = near.up = fake_vec(1, 0, 0);
    assert_int_equal(tahr_world_sweep(b.world, &q, &hit, 1, &count), TAHR_E_ARGUMENT);
    assert_int_equal(tahr_world_contacts(b.world, &near, &contact, 1, &count), TAHR_E_ARGUMENT);
    close_bench(&b);
}

static void direct_sweep_says_unknown_where_the_backend_gave_up(void **unused)
{
    bench b;
    tahr_hit hit;
    uint32_t count = 0;
    tahr_sweep q = good_sweep();
    (void)unused;
    open_bench(&b, ALL);
    fake_add_plane(&b.liar.fake, fake_vec(-1, 0, 0), -3);
    b.liar.unknown = 1;
    q.motion = fake_vec(4, 0, 0);
    assert_int_equal(tahr_world_sweep(b.world, &q, &hit, 1, &count), TAHR_UNKNOWN);
    assert_int_equal(count, 1);
    assert_true(hit.unknown);
    assert_near(hit.fraction, (3 - 0.36) / 4, 1e-15);
    close_bench(&b);
}

static void direct_sweep_leaves_outputs_untouched_when_the_backend_lies(void **unused)
{
    bench b;
    tahr_hit hits[1], kept[1];
    uint32_t count = 99;
    tahr_sweep q = good_sweep();
    (void)unused;
    open_bench(&b, ALL);
    for (int lie = 1; lie < LIES; lie++) {
        b.liar.lie = lie;
        memset(hits, 0x55, sizeof hits);
        memcpy(kept, hits, sizeof hits);
        assert_int_equal(tahr_world_sweep(b.world, &q, hits, 1, &count), TAHR_E_BACKEND);
        assert_int_equal(count, 99);
        assert_memory_equal(hits, kept, sizeof hits);
    }
    close_bench(&b);
}

static void direct_contacts_answer_and_check(void **unused)
{
    bench b;
    tahr_contact out[4], kept[4];
    uint32_t count = 99;
    tahr_contact_query q = {.shape = {TAHR_SHAPE_CAPSULE, 0, 0.35, 0.9, 0, 0},
                            .position = {0, 0, 0.895},
                            .up = {0, 0, 1},
                            .orientation = {0, 0, 0, 1},
                            .margin = 0.01,
                            .mask = 0xFFFFFFFFu,
                            .ignore_body = TAHR_NO_BODY};
    (void)unused;
    open_bench(&b, ALL);
    fake_add_plane(&b.liar.fake, fake_vec(-1, 0, 0), -0.35);
    assert_int_equal(tahr_world_contacts(b.world, &q, out, 4, &count), TAHR_OK);
    assert_int_equal(count, 2);
    assert_near(out[0].distance, -0.005, 1e-15);
    assert_near(out[1].distance, 0, 1e-15);
    assert_int_equal(tahr_world_contacts(b.world, &q, out, 1, &count), TAHR_TRUNCATED);
    assert_int_equal(count, 1);
    memset(out, 0x55, sizeof out);
    memcpy(kept, out, sizeof out);
    count = 99;
    assert_int_equal(tahr_world_contacts(NULL, &q, out, 4, &count), TAHR_E_NULL);
    assert_int_equal(tahr_world_contacts(b.world, NULL, out, 4, &count), TAHR_E_NULL);
    assert_int_equal(tahr_world_contacts(b.world, &q, NULL, 4, &count), TAHR_E_NULL);
    assert_int_equal(tahr_world_contacts(b.world, &q, out, 4, NULL), TAHR_E_NULL);
    q.margin = NAN;
    assert_int_equal(tahr_world_contacts(b.world, &q, out, 4, &count), TAHR_E_ARGUMENT);
    q.margin = 0.01;
    q.shape.type = 0;
    assert_int_equal(tahr_world_contacts(b.world, &q, out, 4, &count), TAHR_E_ARGUMENT);
    q.shape.type = TAHR_SHAPE_CAPSULE;
    q.reserved = 1;
    assert_int_equal(tahr_world_contacts(b.world, &q, out, 4, &count), TAHR_E_ARGUMENT);
    assert_non_null(strstr(b.log.text, "reserved"));
    q.reserved = 0, q.flags = 1;
    assert_int_equal(tahr_world_contacts(b.world, &q, out, 4, &count), TAHR_E_ARGUMENT);
    assert_non_null(strstr(b.log.text, "flags"));
    q.flags = 0;
    b.liar.contact_lie = 1;
    assert_int_equal(tahr_world_contacts(b.world, &q, out, 4, &count), TAHR_E_BACKEND);
    assert_int_equal(count, 99);
    assert_memory_equal(out, kept, sizeof out);
    close_bench(&b);
}

static void direct_ray_answers_and_checks(void **unused)
{
    bench b;
    tahr_hit hit, kept;
    uint32_t count = 99;
    tahr_ray q = {.origin = {0, 0, 3}, .motion = {0, 0, -4}, .mask = 0xFFFFFFFFu, .ignore_body = TAHR_NO_BODY};
    (void)unused;
    open_bench(&b, ALL);
    assert_int_equal(tahr_world_ray(b.world, &q, &hit, &count), TAHR_OK);
    assert_int_equal(count, 1);
    assert_near(hit.fraction, 0.75, 1e-15);
    memset(&hit, 0x55, sizeof hit);
    kept = hit;
    count = 99;
    assert_int_equal(tahr_world_ray(NULL, &q, &hit, &count), TAHR_E_NULL);
    assert_int_equal(tahr_world_ray(b.world, NULL, &hit, &count), TAHR_E_NULL);
    assert_int_equal(tahr_world_ray(b.world, &q, NULL, &count), TAHR_E_NULL);
    assert_int_equal(tahr_world_ray(b.world, &q, &hit, NULL), TAHR_E_NULL);
    q.motion.y = NAN;
    assert_int_equal(tahr_world_ray(b.world, &q, &hit, &count), TAHR_E_ARGUMENT);
    q.motion.y = 0;
    for (int lie = 1; lie < LIES; lie++) {
        b.liar.lie = lie;
        assert_int_equal(tahr_world_ray(b.world, &q, &hit, &count), TAHR_E_BACKEND);
    }
    assert_int_equal(count, 99);
    assert_memory_equal(&hit, &kept, sizeof hit);
    close_bench(&b);
}

static void shapes_that_the_backend_lacks_are_unsupported(void **unused)
{
    bench b;
    tahr_mover *mover = NULL;
    tahr_hit hit;
    uint32_t count;
    (void)unused;
    open_bench(&b, TAHR_CAP_MARGIN | TAHR_CAP_CONTACTS | TAHR_CAP_RAY | TAHR_CAP_CAPSULE);
    b.config.shape.type = TAHR_SHAPE_SPHERE;
    b.config.shape.half_height = 0.35;
    assert_int_equal(tahr_mover_create(b.world, &b.config, &mover), TAHR_E_UNSUPPORTED);
    assert_null(mover);
    tahr_sweep q = good_sweep();
    q.shape.type = TAHR_SHAPE_SPHERE;
    q.shape.half_height = 0.35;
    assert_int_equal(tahr_world_sweep(b.world, &q, &hit, 1, &count), TAHR_E_UNSUPPORTED);
    close_bench(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(lies_of_a_sweep_end_the_step_and_are_named),
                                       cmocka_unit_test(lies_of_contacts_end_the_step_and_are_named),
                                       cmocka_unit_test(unknown_blocks_at_the_last_free_fraction_with_a_flag),
                                       cmocka_unit_test(unknown_that_does_not_say_blocking_blocks_all_the_same),
                                       cmocka_unit_test(random_answers_never_break_the_promises),
                                       cmocka_unit_test(a_backend_without_margin_walks_the_same_path),
                                       cmocka_unit_test(direct_sweep_answers_and_checks),
                                       cmocka_unit_test(a_box_whose_z_axis_is_not_up_is_refused),
                                       cmocka_unit_test(direct_sweep_says_unknown_where_the_backend_gave_up),
                                       cmocka_unit_test(direct_sweep_leaves_outputs_untouched_when_the_backend_lies),
                                       cmocka_unit_test(direct_contacts_answer_and_check),
                                       cmocka_unit_test(direct_ray_answers_and_checks),
                                       cmocka_unit_test(shapes_that_the_backend_lacks_are_unsupported)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
