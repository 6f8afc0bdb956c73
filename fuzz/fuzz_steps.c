/* SPDX-License-Identifier: MIT
 * fuzz_steps.c: any scene, any settings, any input, on the native backend: the invariants of a step hold, and no
 * shortcut changes a bit. */
#include "scene.h"
#include "tape.h"
#include "target.h"
#include "truth.h"

#include <math.h>
#include <string.h>
#include <tahr/native.h>

enum { MOST_STEPS = 200, EVENTS = 64, RECORDS = TAHR_MAX_QUERIES_PER_STEP + TAHR_MAX_SENSOR_QUERIES_PER_STEP + 64 };

/* Every so many steps the sweeps are measured by brute force: so many of them, at so many places on their ways. */
enum { JUDGED_STEPS = 8, JUDGED_SWEEPS = 8, PLACES = 3 };

static const tahr_native_desc fast = {.struct_size = sizeof fast};
static const tahr_native_desc plain = {.struct_size = sizeof plain, .no_cache = 1, .no_simd = 1, .no_capsule_ends = 1};

/* The same step, in a world with and one without shortcuts. */
typedef struct twin {
    const scene *scene;
    const tahr_config *config;
    tahr_world *world[2];
    tahr_mover *mover[2];
    tahr_state state[2];
} twin;

static int is_number(tahr_vec3 v)
{
    return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

static double length(tahr_vec3 v)
{
    return sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

static tahr_vec3 minus(tahr_vec3 a, tahr_vec3 b)
{
    return (tahr_vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}

/* Everything that is a number is one, units are units, counts are in range. */
static void check_state(const tahr_state *s)
{
    FUZZ_CHECK(is_number(s->position) && is_number(s->velocity) && is_number(s->up), "position %g %g %g", s->position.x,
               s->position.y, s->position.z);
    FUZZ_CHECK(fabs(length(s->up) - 1) < 1e-9, "%.17g", length(s->up));
    tahr_quat q = s->orientation;
    FUZZ_CHECK(fabs(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1) < 1e-6, "orientation");
    FUZZ_CHECK(s->mode <= TAHR_MODE_CUSTOM && s->touched_count <= TAHR_MAX_TOUCHED, "mode %u, touched %u", s->mode,
               s->touched_count);
    if (s->floor.flags & TAHR_FLOOR_WALKABLE) {
        FUZZ_CHECK(fabs(length(s->floor.normal) - 1) < 1e-6, "floor normal of length %.17g", length(s->floor.normal));
    }
    for (size_t i = 0; i < sizeof s->reserved; i++)
        FUZZ_CHECK(s->reserved[i] == 0, "reserved[%u]", (unsigned)i);
}

/* Counts within their caps, events in order and inside the step. */
static void check_report(const tahr_report *r, double dt)
{
    uint32_t asked = r->sweeps + r->contact_queries + r->rays + r->fluid_queries;
    FUZZ_CHECK(asked <= TAHR_MAX_QUERIES_PER_STEP + TAHR_MAX_SENSOR_QUERIES_PER_STEP, "%u queries", asked);
    double before = 0;
    for (uint32_t i = 0; i < r->event_count; i++) {
        const tahr_event *e = &r->events[i];
        FUZZ_CHECK(e->time >= before && e->time <= dt, "event %u (%s) at %.17g after %.17g, of %.17g", i,
                   tahr_event_name(e->type), e->time, before, dt);
        FUZZ_CHECK(is_number(e->position) && is_number(e->normal) && isfinite(e->value), "event %u", i);
        before = e->time;
    }
    FUZZ_CHECK(isfinite(r->residual) && isfinite(r->step_offset) && r->time_lost >= 0 && r->time_lost <= dt, "report");
}

/* How far a step may go at most: its speeds, and what steps, snaps, pushes and corrections add. Bodies that move carry
 * and push on top of that. */
static void check_travel(const tahr_config *c, const tahr_input *in, const tahr_state *a, const tahr_state *b,
                         double dt)
{
    double speed = fmax(length(a->velocity), length(b->velocity)) + length(a->base.velocity) + length(b->base.velocity);
    double own = c->max_speed + c->swim_speed + c->fly_speed + c->jump_speed + c->wall_jump_speed + c->water_exit_speed;
    if (in->flags & TAHR_INPUT_LAUNCH) own += length(in->launch);
    if (in->flags & TAHR_INPUT_IMPULSE) own += length(in->impulse) / c->mass;
    if (in->flags & TAHR_INPUT_DRIVE) own += length(in->drive);
    double gravity = in->flags & TAHR_INPUT_GRAVITY ? length(in->gravity) : length(c->gravity);
    own += (gravity * 2 + c->acceleration) * dt;
    double jumps = c->step_height + c->snap_distance + fmax(c->max_depenetration, c->max_depenetration_character);
    jumps += 2 * c->ledge_grab + c->corner_correction + 10 * c->skin + 4 * fmax(c->shape.half_height, b->half_height);
    double most = (speed + own) * dt * (1 + 1e-9) + 4 * jumps + c->max_substeps * c->max_depenetration;
    double went = length(minus(b->position, a->position));
    FUZZ_CHECK(went <= most, "went %g m in %g s, at most %g", went, dt, most);
}

static int open_twin(twin *t, const scene *s, const tahr_config *config, const tahr_vec3 *position)
{
    memset(t, 0, sizeof *t);
    t->scene = s;
    t->config = config;
    for (int i = 0; i < 2; i++) {
        tahr_config c = *config;
        c.sleep = i == 0 ? config->sleep : 0;
        c.short_ways = c.barred_steps = i == 0;
        t->world[i] = scene_open(s, tahr_backend_v1_native(), i ? &plain : &fast);
        if (!t->world[i] || tahr_mover_create(t->world[i], &c, &t->mover[i]) < 0 ||
            tahr_state_init(&t->state[i], &c, position) < 0)
            return 0;
    }
    return 1;
}

static void close_twin(twin *t)
{
    for (int i = 0; i < 2; i++) {
        tahr_mover_destroy(t->mover[i]);
        tahr_world_close(t->world[i]);
    }
}

/* Moves what can be moved, the same in both worlds. */
static void move_bodies(twin *t, bytes *b, double dt)
{
    const scene *s = t->scene;
    tahr_body_pose poses[SCENE_BODIES];
    uint32_t count = 0, how = bytes_u8(b);
    if (s->movers == 0 || !(dt > 0) || how % 4 == 0) return;
    for (uint32_t i = 0; i < s->body_count; i++) {
        if (!(s->bodies[i].flags & TAHR_BODY_MOVABLE)) continue;
        tahr_body_motion motion;
        tahr_world_body(t->world[0], i, &motion);
        tahr_body_pose pose = {i, how == 255 ? (uint32_t)TAHR_POSE_TELEPORT : 0u, motion.pose};
        pose.pose.position.x += s->scale * 0.01 * ((double)(how % 16) - 8);
        pose.pose.position.z += s->scale * 0.005 * ((double)(how / 16) - 8);
        poses[count++] = pose;
    }
    for (int i = 0; i < 2; i++)
        tahr_world_move(t->world[i], poses, count, dt);
}

/* A step that must be refused leaves everything as it was. */
static void refuse(twin *t, const tahr_input *input, uint32_t how)
{
    tahr_input bad = *input;
    tahr_state before = t->state[0], broken = t->state[0];
    double dt = 1.0 / 60;
    if (how % 3 == 0) bad.move.y = NAN;
    if (how % 3 == 1) dt = how & 8 ? -1 : INFINITY;
    if (how % 3 == 2) broken.position.x = broken.velocity.z = NAN;
    tahr_state *state = how % 3 == 2 ? &broken : &t->state[0];
    tahr_state given = *state;
    tahr_status status = tahr_mover_step(t->mover[0], &bad, dt, state, NULL);
    FUZZ_CHECK(status == TAHR_E_ARGUMENT, "%s", tahr_status_name(status));
    FUZZ_CHECK(memcmp(state, &given, sizeof given) == 0, "state of a refused step");
    FUZZ_CHECK(memcmp(&t->state[0], &before, sizeof before) == 0, "state");
}

/* m that a sweep may be off: 1e-4 of the size of the scene, as in fuzz_engines; the rounding of its coordinates; and
 * that of corners to floats, from the corner of their cell of 4 m (backends/native/README.md): half of 2^-21 m in each
 * of three directions. */
static double slack_of(const scene *s)
{
    return 1e-4 * s->scale + 8 * 2.3e-16 * (fabs(s->origin.x) + fabs(s->origin.y)) + 5e-7;
}

/* A sweep that began farther away than its margin keeps it all the way that it calls free: what a step does is put
 * together of such ways, so that it neither tunnels nor comes nearer than its skin. */
static void judge_sweep(const scene *s, const tahr_query_record *q, tahr_vec3 up)
{
    double slack = slack_of(s), reach = q->margin + 2 * slack;
    if (truth_gap(s, &q->shape, q->position, up, reach) < q->margin) return;
    for (int i = 1; i <= PLACES; i++) {
        double at = q->fraction * i / PLACES;
        tahr_vec3 p = {q->position.x + q->motion.x * at, q->position.y + q->motion.y * at,
                       q->position.z + q->motion.z * at};
        double gap = truth_gap(s, &q->shape, p, up, reach);
        FUZZ_CHECK(gap >= q->margin - slack, "a sweep of %g m passes %.9g m from something (margin %g), at %g",
                   length(q->motion), gap, q->margin, at);
    }
}

static void judge(const scene *s, const tahr_report *r, const tahr_state *a, const tahr_state *b)
{
    int judged = 0;
    if (memcmp(&a->up, &b->up, sizeof a->up) != 0) return; /* a record does not tell which one it was asked with */
    for (uint32_t i = 0; i < r->query_count && judged < JUDGED_SWEEPS; i++) {
        const tahr_query_record *q = &r->queries[i];
        if (q->type != TAHR_QUERY_SWEEP || !(q->margin > 0) || !truth_knows(s, &q->shape)) continue;
        judge_sweep(s, q, b->up);
        judged++;
    }
}

/* Of the capsule or sphere that a state has. */
static double gap_of(const twin *t, const tahr_state *state)
{
    tahr_shape shape = t->config->shape;
    shape.radius = state->radius;
    shape.half_height = state->half_height;
    return truth_gap(t->scene, &shape, state->position, state->up, t->config->skin);
}

/* Who was farther from everything than the skin, and was not crushed, is so after the step where sweeps keep a margin,
 * and outside of everything where they are pulled back along the motion. Who is turned needs only room to be there. */
static void judge_end(const twin *t, const tahr_state *a, const tahr_state *b)
{
    const tahr_config *c = t->config;
    if (memcmp(&a->up, &b->up, sizeof a->up) != 0 || !truth_knows(t->scene, &c->shape)) return;
    if (a->half_height != b->half_height || a->radius != b->radius) return;
    double before = gap_of(t, a), after = gap_of(t, b), slack = slack_of(t->scene);
    double keeps = c->separation == TAHR_SEPARATION_MARGIN ? c->skin : 0;
    if (before < c->skin - slack) return;
    FUZZ_CHECK(after >= keeps - 2 * slack, "%.9g m from something, before the step %.9g (skin %g)", after, before,
               c->skin);
}

static int step(twin *t, const tahr_input *input, double dt, int is_judged)
{
    static tahr_query_record records[RECORDS];
    tahr_event events[2][EVENTS];
    tahr_report report[2];
    tahr_status status[2];
    tahr_state before = t->state[0];
    for (int i = 0; i < 2; i++) {
        memset(&report[i], 0, sizeof report[i]);
        report[i].struct_size = sizeof report[i];
        report[i].events = events[i];
        report[i].event_capacity = EVENTS;
        report[i].queries = i && is_judged ? records : NULL;
        report[i].query_capacity = RECORDS;
        status[i] = tahr_mover_step(t->mover[i], input, dt, &t->state[i], &report[i]);
    }
    FUZZ_CHECK(status[0] == status[1], "%s and %s", tahr_status_name(status[0]), tahr_status_name(status[1]));
    FUZZ_CHECK(memcmp(&t->state[0], &t->state[1], sizeof before) == 0, "cache, lanes or sleep changed the state");
    if (status[0] < 0) {
        FUZZ_CHECK(status[0] != TAHR_E_BACKEND, "native gave an invalid answer");
        FUZZ_CHECK(memcmp(&t->state[0], &before, sizeof before) == 0, "state after an error");
        return 0;
    }
    check_state(&t->state[0]);
    check_report(&report[1], dt);
    if (t->scene->movers == 0) check_travel(t->config, input, &before, &t->state[0], dt);
    if (dt == 0) FUZZ_CHECK(memcmp(&t->state[0], &before, sizeof before) == 0, "dt = 0 changed the state");
    if (is_judged) judge(t->scene, &report[1], &before, &t->state[1]);
    if (is_judged && status[1] == TAHR_OK) judge_end(t, &before, &t->state[1]);
    return 1;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    bytes b = {data, data + size};
    scene s;
    twin t;
    tahr_config config;
    scene_read(&s, &b, SCENE_SENSORS | SCENE_MOVERS | SCENE_FLUIDS);
    if (!scene_config(&s, &b, &config)) return 0;
    tahr_vec3 position = scene_point(&s, &b);
    position.z += 1.5 * s.scale;
    if (open_twin(&t, &s, &config, &position)) {
        for (int i = 0; i < MOST_STEPS && bytes_left(&b) > 0; i++) {
            tahr_input input;
            double dt;
            tape_read(&b, s.scale, &config, &input, &dt);
            if (i % 32 == 31) refuse(&t, &input, (uint32_t)i / 32);
            if (s.movers) move_bodies(&t, &b, dt);
            if (!step(&t, &input, dt, i % JUDGED_STEPS == 0)) break;
        }
    }
    close_twin(&t);
    return 0;
}
