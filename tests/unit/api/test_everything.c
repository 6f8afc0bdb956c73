/* SPDX-License-Identifier: MIT
 * test_everything.c: random characters with random input among random bodies, every feature at once: no step fails,
 * every state is one that a step accepts, reports say nothing that cannot be, and nothing but the arguments of a step
 * decides it. Arguments: a factor of the number of rounds and a first seed, to look longer. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "chaos.h"

#include <tahr/box2d.h>
#include <tahr/custom_mode.h>
#include <tahr/native.h>
#ifdef TAHR_HAVE_CCD
#include <tahr/ccd.h>
#endif
#ifdef TAHR_HAVE_FCL
#include <tahr/fcl.h>
#endif

enum { TICKS = 90, REPLAYED = 12, EVENTS = 128, DECISIONS = 1024, QUERIES = 512, FEW = 3 };

static int factor = 1;
static uint64_t first_seed = 1;

/* What a world is opened on. BARE: callbacks with a sweep alone. */
enum { ON_NATIVE, ON_CCD, ON_FCL, ON_CALLBACKS, ON_BARE, ON_BOX2D, ON_BOX2D_2 };

static int is_planar(int kind)
{
    return kind == ON_BOX2D || kind == ON_BOX2D_2;
}

/* A world, and behind callbacks the one that answers. */
typedef struct place {
    tahr_world *world, *behind;
    tahr_mover *mover;
} place;

static tahr_status ask_sweep(void *user, const tahr_sweep *q, tahr_hit *hit)
{
    tahr_hit first;
    uint32_t count = 0;
    tahr_status status = tahr_world_sweep(user, q, &first, 1, &count);
    if (count > 0) {
        *hit = first;
    }
    return status < 0 ? status : TAHR_OK;
}

static tahr_status ask_contacts(void *user, const tahr_contact_query *q, tahr_contact *all, uint32_t capacity,
                                uint32_t *count)
{
    return tahr_world_contacts(user, q, all, capacity, count);
}

static tahr_status ask_ray(void *user, const tahr_ray *q, tahr_hit *hit)
{
    uint32_t count = 0;
    return tahr_world_ray(user, q, hit, &count);
}

static tahr_status ask_sensors(void *user, const tahr_sweep *q, tahr_hit *hits, uint32_t capacity, uint32_t *count)
{
    return tahr_world_sweep(user, q, hits, capacity, count);
}

static tahr_status ask_body(void *user, uint32_t body, tahr_body_motion *motion)
{
    return tahr_world_body(user, body, motion);
}

static tahr_status ask_fluid(void *user, const tahr_fluid_query *q, tahr_fluid *fluid)
{
    return tahr_world_fluid(user, q, fluid);
}

/* A mode that depends on the step alone: moves on, sometimes hands the rest to another mode. user: NULL in space. */
static tahr_status own_mode(void *user, tahr_step *step, double time, tahr_custom_next *next)
{
    const tahr_state *s = tahr_step_state(step);
    const tahr_vec3 move = tahr_step_input(step)->move;
    tahr_vec3 v = {3 * sin(move.x), 3 * sin(move.y), 3 * sin(move.z)};
    v.z = user ? 0 : v.z;
    tahr_vec3 way = {v.x * time / 2, v.y * time / 2, v.z * time / 2};
    tahr_step_moved moved;
    tahr_hit hit;
    tahr_fluid fluid;
    tahr_status status = tahr_step_set_velocity(step, &v);
    status = status < 0 ? status : tahr_step_slide(step, &way, &moved);
    status = status < 0 ? status : tahr_step_sweep(step, &way, &hit);
    status = status < 0 ? status : tahr_step_ray(step, &s->position, &way, &hit);
    status = status < 0 ? status : tahr_step_fluid(step, &fluid);
    status = status < 0 ? status : tahr_step_event(step, time / 4, time);
    if (move.x > 0.8) {
        static const uint32_t modes[] = {TAHR_MODE_WALKING, TAHR_MODE_FALLING, TAHR_MODE_SWIMMING, TAHR_MODE_FLYING};
        next->mode = modes[(int)(fabs(move.y) * 1e3) % 4];
        next->time_left = time / 2;
    }
    return status;
}

static void say(void *user, int32_t level, const char *message)
{
    (void)user;
    if (level == TAHR_LOG_ERROR) {
        print_message("log: %s\n", message);
    }
}

/* plain: without what makes native faster. */
static void open_place(place *p, int kind, const chaos_scene *scene, const tahr_config *config, int plain)
{
    static const tahr_log log = {NULL, say};
#ifdef TAHR_HAVE_FCL
    const tahr_fcl_desc fcl = {.struct_size = sizeof fcl, .no_cache = (uint32_t)plain};
#endif
    const tahr_native_desc options = {
        .struct_size = sizeof options, .no_cache = (uint32_t)plain, .no_simd = (uint32_t)plain};
    tahr_world_desc desc;
    const tahr_backend *backend = tahr_backend_v1_native();
    memset(p, 0, sizeof *p);
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = scene->bodies;
    desc.body_count = CHAOS_BODIES;
    desc.log = &log;
    desc.options = &options;
#ifdef TAHR_HAVE_CCD
    if (kind == ON_CCD) {
        backend = tahr_backend_v1_ccd();
        desc.options = NULL;
    }
#endif
#ifdef TAHR_HAVE_FCL
    if (kind == ON_FCL) {
        backend = tahr_backend_v1_fcl();
        desc.options = &fcl;
    }
#endif
#ifdef TAHR_HAVE_BOX2D
    const tahr_box2d_desc box2d = {.struct_size = sizeof box2d,
                                   .engine = kind == ON_BOX2D ? TAHR_BOX2D_NEWEST : TAHR_BOX2D_2};
    if (is_planar(kind)) {
        backend = tahr_backend_v1_box2d();
        desc.options = &box2d;
    }
#endif
    assert_int_equal(tahr_world_open(backend, &desc, &p->world), TAHR_OK);
    if (kind == ON_CALLBACKS || kind == ON_BARE) {
        tahr_callbacks all = {.struct_size = sizeof all, .user = p->world, .sweep = ask_sweep};
        if (kind == ON_CALLBACKS) {
            all.contacts = ask_contacts;
            all.ray = ask_ray;
            all.sensors = ask_sensors;
            all.body = ask_body;
            all.fluid = ask_fluid;
        }
        p->behind = p->world;
        desc.body_count = 0;
        assert_int_equal(tahr_world_open_callbacks(&all, &desc, &p->world), TAHR_OK);
    }
    assert_int_equal(tahr_mover_create(p->world, config, &p->mover), TAHR_OK);
    assert_int_equal(tahr_mover_set_custom_mode(p->mover, own_mode, is_planar(kind) ? p : NULL), TAHR_OK);
}

static void close_place(place *p)
{
    tahr_mover_destroy(p->mover);
    tahr_world_close(p->world);
    tahr_world_close(p->behind);
}

/* What is done to a world before a step. */
typedef struct push {
    tahr_body_pose moves[CHAOS_MOVABLES];
    uint32_t count;
    int how; /* 0: nothing, 1: moved, 2: set */
    double dt;
} push;

static void apply(place *p, const push *c)
{
    tahr_world *world = p->behind ? p->behind : p->world;
    if (c->how == 1) {
        assert_int_equal(tahr_world_move(world, c->moves, c->count, c->dt), TAHR_OK);
    } else if (c->how == 2) {
        assert_int_equal(tahr_world_set(world, c->moves, c->count), TAHR_OK);
    }
    if (p->behind && c->how) {
        assert_int_equal(tahr_world_touch(p->world), TAHR_OK);
    }
}

/* A step as it was taken. */
typedef struct tick {
    push push;
    tahr_body_pose before[CHAOS_MOVABLES]; /* every pose before push */
    tahr_input input;
    double dt;
    tahr_state from, to;
} tick;

typedef struct chaos {
    oracle_random dice;
    tahr_config config;
    chaos_scene scene;
    place place, twin;
    int kind;
    uint64_t seed;
    tick ticks[TICKS];
    long flags[32]; /* how often each flag of a report was seen */
    long modes[TAHR_MODE_CUSTOM + 1], events[TAHR_EVENT_CUSTOM + 1];
} chaos;

static void check_state(const chaos *c, int n, const tahr_state *s)
{
    const tahr_vec3 p = s->position, v = s->velocity;
    if (!isfinite(p.x + p.y + p.z + v.x + v.y + v.z)) {
        fail_msg("seed %llu tick %d: not finite", (unsigned long long)c->seed, n);
    }
    if (is_planar(c->kind) && (p.z != 0 || s->up.z != 0)) {
        fail_msg("seed %llu tick %d: out of the plane by %g, up by %g", (unsigned long long)c->seed, n, p.z, s->up.z);
    }
    for (size_t at = 0; at < sizeof *s; at += 8) {
        uint64_t word;
        memcpy(&word, (const char *)s + at, 8);
        if (word == (uint64_t)1 << 63) {
            fail_msg("seed %llu tick %d: -0.0 at byte %zu", (unsigned long long)c->seed, n, at);
        }
    }
    for (uint32_t i = 0; i < TAHR_MAX_TOUCHED; i++) {
        assert_true(i < s->touched_count ? i == 0 || s->touched[i - 1] < s->touched[i] : s->touched[i] == TAHR_NO_BODY);
    }
}

static void check_report(chaos *c, int n, const tahr_report *r, tahr_status status)
{
    const double dt = c->ticks[n].dt;
    double last = 0;
    if (r->event_count > r->event_capacity || r->decision_count > r->decision_capacity ||
        r->query_count > r->query_capacity) {
        fail_msg("seed %llu tick %d: more than there was room for", (unsigned long long)c->seed, n);
    }
    for (uint32_t i = 0; i < r->event_count; i++) {
        const tahr_event *e = &r->events[i];
        if (!(e->time >= last && e->time <= dt && isfinite(e->value) && isfinite(e->position.x + e->normal.x))) {
            fail_msg("seed %llu tick %d: event %s at %.17g after %.17g of %.17g, value %g", (unsigned long long)c->seed,
                     n, tahr_event_name(e->type), e->time, last, dt, e->value);
        }
        assert_true(e->type >= 1 && e->type <= TAHR_EVENT_CUSTOM);
        c->events[e->type]++;
        last = e->time;
    }
    uint32_t asked = r->contact_queries + r->rays + r->fluid_queries + r->sweeps;
    if (asked > TAHR_MAX_QUERIES_PER_STEP + TAHR_MAX_SENSOR_QUERIES_PER_STEP) {
        fail_msg("seed %llu tick %d: %u queries", (unsigned long long)c->seed, n, asked);
    }
    int lost = r->events_lost || r->decisions_lost || r->queries_lost;
    assert_true(!lost == !(r->flags & TAHR_REPORT_TRUNCATED));
    if (!(r->residual >= 0 && isfinite(r->residual + r->step_offset) && r->time_lost >= 0 &&
          r->time_lost <= dt * 1.0001)) {
        fail_msg("seed %llu tick %d: residual %g, offset %g, lost %g of %g", (unsigned long long)c->seed, n,
                 r->residual, r->step_offset, r->time_lost, dt);
    }
    assert_true(status >= 0);
    for (int b = 0; b < 32; b++) {
        c->flags[b] += r->flags >> b & 1;
    }
}

static tahr_status step_fully(chaos *c, int n, tahr_state *s, tahr_report *r, int recorded)
{
    static tahr_event events[EVENTS];
    static tahr_decision decisions[DECISIONS];
    static tahr_query_record queries[QUERIES];
    const tick *t = &c->ticks[n];
    *r = (tahr_report){.struct_size = sizeof *r, .events = events, .event_capacity = EVENTS};
    if (recorded) {
        r->decisions = decisions;
        r->decision_capacity = DECISIONS;
        r->queries = queries;
        r->query_capacity = QUERIES;
    }
    tahr_status status = tahr_mover_step(c->place.mover, &t->input, t->dt, s, r);
    if (status < 0) {
        fail_msg("seed %llu tick %d: %s", (unsigned long long)c->seed, n, tahr_status_name(status));
    }
    return status;
}

/* The same step elsewhere, with hardly any room in the report, has the same outcome, and begins its report alike. */
static void step_twin(chaos *c, int n, const tahr_report *full)
{
    const tick *t = &c->ticks[n];
    tahr_event events[FEW];
    tahr_decision decisions[FEW];
    tahr_report r = {.struct_size = sizeof r, .events = events, .event_capacity = oracle_below(&c->dice, FEW + 1)};
    if (oracle_below(&c->dice, 2)) {
        r.decisions = decisions;
        r.decision_capacity = FEW;
    }
    tahr_state s = t->from;
    tahr_status status = tahr_mover_step(c->twin.mover, &t->input, t->dt, &s, &r);
    if (status < 0 || memcmp(&s, &t->to, sizeof s) != 0) {
        size_t at = 0;
        while (at < sizeof s && ((char *)&s)[at] == ((const char *)&t->to)[at]) {
            at++;
        }
        fail_msg("seed %llu tick %d: %s, other bits from byte %zu on", (unsigned long long)c->seed, n,
                 tahr_status_name(status), at);
    }
    if (full->flags & TAHR_REPORT_ASLEEP) {
        return; /* a step that was not computed counts no more than it must */
    }
    if (r.event_count + r.events_lost != full->event_count + full->events_lost) {
        fail_msg("seed %llu tick %d: %u events, elsewhere %u", (unsigned long long)c->seed, n, full->event_count,
                 r.event_count + r.events_lost);
    }
    assert_memory_equal(r.events, full->events, r.event_count * sizeof *r.events);
    if (r.decisions && full->decisions) {
        assert_int_equal(r.decision_count + r.decisions_lost, full->decision_count + full->decisions_lost);
    }
}

static push draw_push(chaos *c, double dt)
{
    push p = {.how = 0};
    uint32_t way = oracle_below(&c->dice, 20);
    if (way < 14) {
        p.how = 1;
        p.dt = oracle_below(&c->dice, 8) ? fmax(dt, 1e-4) : 1.0 / 30;
        p.count = chaos_drift(&c->scene, &c->dice, p.dt, p.moves);
        if (is_planar(c->kind)) {
            chaos_flatten_moves(&c->scene, p.moves, p.count);
        }
    } else if (way < 16) {
        p.how = 2;
        p.count = 1;
        tahr_body_pose *one = &c->scene.poses[oracle_below(&c->dice, CHAOS_MOVABLES)];
        one->pose.position = dice_vec(&c->dice, -4, 4);
        one->pose.position = is_planar(c->kind) ? chaos_flat(one->pose.position) : one->pose.position;
        p.moves[0] = *one;
    }
    return p;
}

static void hop(chaos *c, tahr_state *s)
{
    const double from = fmax(fabs(s->position.x), fmax(fabs(s->position.y), fabs(s->position.z)));
    if (from > 20 || oracle_below(&c->dice, 60) == 0) {
        tahr_vec3 at = dice_vec(&c->dice, -6, 6);
        at = is_planar(c->kind) ? chaos_flat(at) : at;
        assert_int_equal(tahr_state_teleport(s, &at), TAHR_OK);
        s->velocity = from > 20 ? (tahr_vec3){0, 0, 0} : s->velocity;
    }
}

/* From a tick whose bodies were moved on: put back, and once more; caches and notes are those of what came later. */
static void replay(chaos *c, int end)
{
    int start = end > REPLAYED ? end - (int)oracle_below(&c->dice, REPLAYED) : 0;
    while (start < end && c->ticks[start].push.how != 1) {
        start++;
    }
    if (c->place.behind || start == end) { /* callbacks: their scene has a revision of its own */
        return;
    }
    assert_int_equal(tahr_world_set(c->place.world, c->ticks[start].before, CHAOS_MOVABLES), TAHR_OK);
    for (int n = start; n < end; n++) {
        tahr_state s = c->ticks[n].from;
        apply(&c->place, &c->ticks[n].push);
        tahr_mover_step(c->place.mover, &c->ticks[n].input, c->ticks[n].dt, &s, NULL);
        if (memcmp(&s, &c->ticks[n].to, sizeof s) != 0) {
            fail_msg("seed %llu tick %d: a rollback from tick %d to %d has other bits", (unsigned long long)c->seed, n,
                     start, end);
        }
    }
}

static void run(chaos *c)
{
    tahr_state s;
    tahr_vec3 at = dice_vec(&c->dice, -5, 5);
    at = is_planar(c->kind) ? chaos_flat(at) : at;
    assert_int_equal(tahr_state_init(&s, &c->config, &at), TAHR_OK);
    for (int n = 0; n < TICKS; n++) {
        tick *t = &c->ticks[n];
        tahr_report report;
        hop(c, &s);
        memcpy(t->before, c->scene.poses, sizeof t->before);
        t->dt = chaos_dt(&c->dice, &c->config);
        t->push = draw_push(c, t->dt);
        if (n == 0 || oracle_below(&c->dice, 4) == 0) {
            t->input = chaos_input(&c->dice, c->seed % 3 != 0, &c->config, &s);
            if (is_planar(c->kind)) {
                t->input.gravity = chaos_flat(t->input.gravity);
                t->input.flags |= oracle_below(&c->dice, 6) == 0 ? (uint32_t)TAHR_INPUT_DROP : 0u;
            }
        } else {
            t->input = c->ticks[n - 1].input;
            t->input.flags &= ~(uint32_t)(TAHR_INPUT_LAUNCH | TAHR_INPUT_IMPULSE | TAHR_INPUT_MODE);
        }
        t->from = s;
        apply(&c->place, &t->push);
        apply(&c->twin, &t->push);
        tahr_status status = step_fully(c, n, &s, &report, oracle_below(&c->dice, 2) == 0);
        t->to = s;
        check_state(c, n, &s);
        check_report(c, n, &report, status);
        c->modes[s.mode]++;
        step_twin(c, n, &report);
        if (n % 24 == 23) {
            replay(c, n + 1);
        }
    }
}

static void run_kind(int kind, int rounds)
{
    static chaos c;
    memset(&c, 0, sizeof c);
    for (int round = 0; round < rounds * factor; round++) {
        c.seed = first_seed + (uint64_t)round;
        c.dice.state = c.seed * 977 + (uint64_t)kind;
        c.kind = kind;
        const char *bad = NULL;
        do {
            c.config = chaos_config(&c.dice);
            if (is_planar(kind)) {
                c.config.gravity = chaos_flat(c.config.gravity);
                c.config.plane = (tahr_vec3){0, 0, 1};
            }
        } while (tahr_config_check(&c.config, &bad) < 0);
        tahr_config awake = c.config;
        awake.sleep = 0;
        chaos_build(&c.scene, &c.dice, kind != ON_BARE);
        if (is_planar(kind)) {
            chaos_flatten(&c.scene);
        }
        open_place(&c.place, kind, &c.scene, &c.config, 0);
        open_place(&c.twin, kind, &c.scene, &awake, 1);
        run(&c);
        close_place(&c.place);
        close_place(&c.twin);
    }
    print_message("modes:");
    for (uint32_t m = 0; m <= TAHR_MODE_CUSTOM; m++) {
        print_message(" %s %ld", tahr_mode_name(m), c.modes[m]);
    }
    print_message("\nflags:");
    for (int b = 0; b < 12; b++) {
        print_message(" %ld", c.flags[b]);
    }
    print_message("\nevents:");
    for (uint32_t e = 1; e <= TAHR_EVENT_CUSTOM; e++) {
        print_message(" %s %ld", tahr_event_name(e), c.events[e]);
    }
    print_message("\n");
}

static void native_keeps_every_promise(void **unused)
{
    (void)unused;
    run_kind(ON_NATIVE, 80);
}

static void ccd_keeps_every_promise(void **unused)
{
    (void)unused;
#ifdef TAHR_HAVE_CCD
    run_kind(ON_CCD, 3);
#else
    print_message("SKIP: unit_api_everything: ccd was not built\n");
    skip();
#endif
}

static void fcl_keeps_every_promise(void **unused)
{
    (void)unused;
#ifdef TAHR_HAVE_FCL
    run_kind(ON_FCL, 5);
#else
    print_message("SKIP: unit_api_everything: fcl was not built\n");
    skip();
#endif
}

static void box2d_keeps_every_promise(void **unused)
{
    (void)unused;
#ifdef TAHR_HAVE_BOX2D
    run_kind(ON_BOX2D, 30);
#ifdef TAHR_HAVE_BOX2D_2
    run_kind(ON_BOX2D_2, 30);
#endif
#else
    print_message("SKIP: unit_api_everything: box2d was not built\n");
    skip();
#endif
}

static void callbacks_keep_every_promise(void **unused)
{
    (void)unused;
    run_kind(ON_CALLBACKS, 15);
    run_kind(ON_BARE, 15);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(native_keeps_every_promise), cmocka_unit_test(ccd_keeps_every_promise),
        cmocka_unit_test(fcl_keeps_every_promise), cmocka_unit_test(box2d_keeps_every_promise),
        cmocka_unit_test(callbacks_keep_every_promise)};
    factor = argc > 1 ? atoi(argv[1]) : 1;
    first_seed = argc > 2 ? strtoull(argv[2], NULL, 10) : 1;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
