/* SPDX-License-Identifier: MIT
 * scene_run.c: the loop of a scene: settle, step, look how close everything is. */
#include "scene_run.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene_input.h"
#include "scene_motion.h"

enum { EVENTS_PER_STEP = 64, SETTLE_STEPS = 30 };

typedef struct runner {
    scene *scene;
    tahr_world *world;
    tahr_mover *mover;
    tahr_state state;
    tahr_event events[EVENTS_PER_STEP];
    scene_record *record;
    const tahr_pose *frame;
    tahr_config config; /* in the frame */
} runner;

tahr_vec3 scene_turn(tahr_quat q, tahr_vec3 v)
{
    /* v + 2 w (q x v) + 2 q x (q x v) */
    tahr_vec3 a = {q.y * v.z - q.z * v.y, q.z * v.x - q.x * v.z, q.x * v.y - q.y * v.x};
    tahr_vec3 b = {q.y * a.z - q.z * a.y, q.z * a.x - q.x * a.z, q.x * a.y - q.y * a.x};
    return (tahr_vec3){v.x + 2 * (q.w * a.x + b.x), v.y + 2 * (q.w * a.y + b.y), v.z + 2 * (q.w * a.z + b.z)};
}

tahr_vec3 scene_turn_back(tahr_quat q, tahr_vec3 v)
{
    return scene_turn((tahr_quat){-q.x, -q.y, -q.z, q.w}, v);
}

void scene_record_cut(scene_record *r, double time)
{
    int i = r->cut_count;
    if (i == (int)(sizeof r->cuts / sizeof r->cuts[0])) {
        return;
    }
    for (; i > 0 && r->cuts[i - 1] > time; i--) {
        r->cuts[i] = r->cuts[i - 1];
    }
    r->cuts[i] = time;
    r->cut_count++;
}

void scene_record_free(scene_record *r)
{
    free(r->samples);
    free(r->events);
    memset(r, 0, sizeof *r);
}

static int fail(scene_record *r, double time, const char *what, const char *detail)
{
    snprintf(r->error, sizeof r->error, "t=%.6g: %s: %s", time, what, detail);
    return 0;
}

static void *room(void *items, size_t size, int count, int *capacity)
{
    if (count < *capacity) {
        return items;
    }
    *capacity = *capacity ? 2 * *capacity : 256;
    void *more = realloc(items, size * (size_t)*capacity);
    if (!more) {
        abort();
    }
    return more;
}

static double clearance(runner *run)
{
    enum { CONTACTS = 64 };
    tahr_contact contacts[CONTACTS];
    const tahr_config *c = &run->scene->config;
    tahr_shape shape = c->shape;
    uint32_t count = 0;
    shape.radius = run->state.radius;
    shape.half_height = run->state.half_height;
    double nearest = 2 * c->skin;
    /* In the air one-way bodies are passed at any distance. */
    uint32_t flags = run->state.mode == TAHR_MODE_WALKING ? 0 : TAHR_CONTACTS_DROP;
    tahr_contact_query query = {.shape = shape,
                                .position = run->state.position,
                                .up = run->state.up,
                                .orientation = run->state.orientation,
                                .margin = 2 * c->skin,
                                .mask = c->mask,
                                .ignore_body = TAHR_NO_BODY,
                                .flags = flags};
    if (tahr_world_contacts(run->world, &query, contacts, CONTACTS, &count) < 0) {
        return -1e9;
    }
    for (uint32_t i = 0; i < count && i < CONTACTS; i++) {
        if (!contacts[i].sensor && contacts[i].distance < nearest) {
            nearest = contacts[i].distance;
        }
    }
    return nearest;
}

static double immersion(runner *run)
{
    const tahr_state *s = &run->state;
    tahr_fluid_query query = {.position = s->position,
                              .up = s->up,
                              .radius = s->radius,
                              .half_height = s->half_height,
                              .mask = run->config.mask};
    tahr_fluid fluid;
    return tahr_world_fluid(run->world, &query, &fluid) < 0 ? -1e9 : fluid.immersion;
}

static void keep(runner *run, double time, double dt, const tahr_report *report, const tahr_input *input)
{
    scene_record *r = run->record;
    r->samples = room(r->samples, sizeof *r->samples, r->count, &r->capacity);
    scene_sample *sample = &r->samples[r->count++];
    memset(sample, 0, sizeof *sample);
    sample->time = time;
    sample->dt = dt;
    sample->state = run->state;
    sample->clearance = clearance(run);
    sample->immersion = immersion(run);
    if (!report) {
        return;
    }
    sample->input = *input;
    sample->sweeps = report->sweeps;
    sample->queries = report->sweeps + report->contact_queries + report->rays + report->fluid_queries;
    sample->flags = report->flags;
    sample->step_offset = report->step_offset;
    for (uint32_t i = 0; i < report->event_count; i++) {
        r->events = room(r->events, sizeof *r->events, r->event_count, &r->event_capacity);
        r->events[r->event_count] = run->events[i];
        r->events[r->event_count++].time += time - dt;
    }
}

static int take_step(runner *run, const tahr_input *input, double dt, double time, int settling)
{
    tahr_report report = {.struct_size = sizeof report, .events = run->events, .event_capacity = EVENTS_PER_STEP};
    tahr_input turned = *input;
    tahr_vec3 *vectors[] = {&turned.move,   &turned.facing,  &turned.gravity,
                            &turned.launch, &turned.impulse, &turned.drive};
    for (size_t i = 0; i < sizeof vectors / sizeof vectors[0]; i++) {
        *vectors[i] = scene_turn(run->frame->orientation, *vectors[i]);
    }
    if (!settling && scene_motion_move(run->scene, run->world, run->frame, time, time + dt) < 0) {
        return fail(run->record, time, "moving bodies", "refused");
    }
    tahr_status status = tahr_mover_step(run->mover, &turned, dt, &run->state, &report);
    if (status < 0) {
        return fail(run->record, time, "step", tahr_status_name(status));
    }
    if (report.flags & (TAHR_REPORT_UNKNOWN | TAHR_REPORT_QUERY_CAP | TAHR_REPORT_TRUNCATED)) {
        return fail(run->record, time, "flag", tahr_status_name(status));
    }
    if (!settling) {
        keep(run, time + dt, dt, &report, input);
    }
    return 1;
}

static int settle(runner *run)
{
    tahr_input none = {.struct_size = sizeof none};
    for (int i = 0; run->scene->settle && i < SETTLE_STEPS; i++) {
        if (!take_step(run, &none, 1.0 / 60, 0, 1)) {
            return 0;
        }
    }
    if (run->scene->settle && run->state.mode != TAHR_MODE_WALKING) {
        return fail(run->record, 0, "settling", "the start is not on a floor");
    }
    run->state.velocity = scene_turn(run->frame->orientation, run->scene->velocity);
    keep(run, 0, 0, NULL, NULL);
    return 1;
}

static int walk(runner *run, double rate)
{
    const scene_record *r = run->record;
    double time = 0;
    long tick = 0;
    int cut = 0;
    while (time < run->scene->duration - 1e-9) {
        double next = (double)(tick + 1) / rate;
        while (cut < r->cut_count && r->cuts[cut] <= time + 1e-9) {
            cut++;
        }
        if (cut < r->cut_count && r->cuts[cut] < next - 1e-9) {
            next = r->cuts[cut];
        } else {
            tick++;
        }
        tahr_input input = scene_input_at(run->scene, time);
        if (!take_step(run, &input, next - time, time, 0)) {
            return 0;
        }
        time = next;
    }
    return 1;
}

static tahr_vec3 into(const tahr_pose *frame, tahr_vec3 v)
{
    tahr_vec3 t = scene_turn(frame->orientation, v);
    return (tahr_vec3){t.x + frame->position.x, t.y + frame->position.y, t.z + frame->position.z};
}

static tahr_status open_scene(runner *run, const scene_backend *backend)
{
    const scene *s = run->scene;
    tahr_body_desc bodies[SCENE_MAX_BODIES];
    for (uint32_t i = 0; i < s->body_count; i++) {
        bodies[i] = s->bodies[i];
        if (backend->planar && s->flat[i].type) { /* what both say alike comes from the one that was read */
            const tahr_body_desc *line = &s->flat[i];
            bodies[i].type = line->type;
            bodies[i].flags |= line->flags;
            bodies[i].vertices = line->vertices;
            bodies[i].vertex_count = line->vertex_count;
            bodies[i].indices = NULL;
            bodies[i].triangle_count = 0;
        }
        bodies[i].pose = scene_motion_pose_in(run->scene, i, 0, run->frame);
    }
    return scene_backend_open(backend, bodies, s->body_count, NULL, &run->world);
}

int scene_run(scene *s, const scene_backend *backend, double rate, const tahr_pose *frame, scene_record *r)
{
    runner run = {.scene = s, .record = r, .frame = frame, .config = s->config};
    tahr_vec3 start = into(frame, s->position);
    run.config.gravity = scene_turn(frame->orientation, s->config.gravity);
    for (int i = 0; i < s->input_count; i++) {
        scene_record_cut(r, s->inputs[i].time);
    }
    scene_record_cut(r, s->duration);
    tahr_status status = open_scene(&run, backend);
    if (status < 0) {
        return fail(r, 0, "opening the world", tahr_status_name(status));
    }
    status = tahr_mover_create(run.world, &run.config, &run.mover);
    tahr_state_init(&run.state, &run.config, &start);
    int ok = status < 0 ? fail(r, 0, "creating the mover", tahr_status_name(status)) : settle(&run) && walk(&run, rate);
    tahr_mover_destroy(run.mover);
    tahr_world_close(run.world);
    return ok;
}
