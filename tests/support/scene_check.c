/* SPDX-License-Identifier: MIT
 * scene_check.c: every kind of expectation but "slide". */
#include "scene_check.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scene_measure.h"
#include "scene_motion.h"

int scene_violated(scene_case *c, double time, const char *what, double value, double limit)
{
    if (!c->failure[0]) {
        snprintf(c->failure, sizeof c->failure, "t=%.6g: %s is %.12g, expected %.12g (off by %.3g)", time, what, value,
                 limit, value - limit);
    }
    return 0;
}

double scene_member(scene_case *c, const char *key, double fallback)
{
    json_t *value = json_object_get(c->item, key);
    if (value && !scene_number(c->scene, value, &fallback)) {
        snprintf(c->failure, sizeof c->failure, "%.250s", c->scene->error);
    }
    return fallback;
}

static const char *text(const scene_case *c, const char *key)
{
    const char *value = json_string_value(json_object_get(c->item, key));
    return value ? value : "?";
}

int scene_in_window(scene_case *c, const scene_sample *sample)
{
    double from = scene_member(c, "from", 0), to = scene_member(c, "to", 1e9);
    return sample->time >= from - 1e-9 && sample->time <= to + 1e-9;
}

static double axis_of(tahr_vec3 v, char axis)
{
    return axis == 'x' ? v.x : axis == 'y' ? v.y : v.z;
}

static int compare(scene_case *c, double time, const char *what, tahr_vec3 value, tahr_vec3 wanted)
{
    double tolerance = scene_member(c, "tolerance", 1e-9);
    const char *axes = json_object_get(c->item, "axes") ? text(c, "axes") : "xyz";
    for (; *axes; axes++) {
        char name[64];
        snprintf(name, sizeof name, "%s %c", what, *axes);
        if (!(fabs(axis_of(value, *axes) - axis_of(wanted, *axes)) <= tolerance)) {
            return scene_violated(c, time, name, axis_of(value, *axes), axis_of(wanted, *axes));
        }
    }
    return 1;
}

/* "position", "velocity": at a time. */
static int check_vector(scene_case *c)
{
    double at = scene_member(c, "at", c->scene->duration);
    int velocity = text(c, "kind")[0] == 'v';
    tahr_vec3 wanted;
    if (!scene_vec3(c->scene, json_object_get(c->item, "is"), &wanted)) {
        snprintf(c->failure, sizeof c->failure, "%.250s", c->scene->error);
        return 0;
    }
    for (int i = 0; i < c->record->count; i++) {
        const scene_sample *s = &c->record->samples[i];
        if (fabs(s->time - at) < 1e-9) {
            return compare(c, at, text(c, "kind"), velocity ? scene_velocity(c, s) : s->state.position, wanted);
        }
    }
    return scene_violated(c, at, "no step ends there; time", c->scene->duration, at);
}

static int check_mode(scene_case *c)
{
    for (int i = 1; i < c->record->count; i++) {
        const scene_sample *s = &c->record->samples[i];
        if (scene_in_window(c, s) && strcmp(tahr_mode_name(s->state.mode), text(c, "is")) != 0) {
            return scene_violated(c, s->time, "mode", s->state.mode, TAHR_MODE_WALKING);
        }
    }
    return 1;
}

static int check_step_speed(scene_case *c)
{
    double speed = scene_member(c, "speed", 0);
    for (int i = 1; i < c->record->count; i++) {
        const scene_sample *s = &c->record->samples[i];
        double dx = s->state.position.x - s[-1].state.position.x, dy = s->state.position.y - s[-1].state.position.y;
        /* 1e-12 m: the coordinates themselves are rounded */
        if (scene_in_window(c, s) && sqrt(dx * dx + dy * dy) > speed * s->dt * (1 + 1e-9) + 1e-12) {
            return scene_violated(c, s->time, "horizontal speed of a step", sqrt(dx * dx + dy * dy) / s->dt, speed);
        }
    }
    return 1;
}

/* When a coordinate first passes a value, between two steps as if moving evenly. */
static double passes(const scene_case *c, char axis, double value)
{
    for (int i = 1; i < c->record->count; i++) {
        const scene_sample *s = &c->record->samples[i];
        double a = axis_of(s[-1].state.position, axis) - value, b = axis_of(s->state.position, axis) - value;
        if ((a <= 0 && b > 0) || (a >= 0 && b < 0)) {
            return s->time - s->dt * b / (b - a);
        }
    }
    return -1;
}

static int check_crossing(scene_case *c)
{
    char axis = text(c, "axis")[0];
    double start = passes(c, axis, scene_member(c, "begin", 0)), end = passes(c, axis, scene_member(c, "end", 0));
    double seconds = scene_member(c, "seconds", 0), relative = scene_member(c, "relative", 0.02);
    if (start < 0 || end < 0) {
        double reached = axis_of(c->record->samples[c->record->count - 1].state.position, axis);
        return scene_violated(c, c->scene->duration, "never got there: coordinate", reached, scene_member(c, "end", 0));
    }
    if (!(fabs(end - start - seconds) <= relative * seconds)) {
        return scene_violated(c, end, "duration of the crossing", end - start, seconds);
    }
    return 1;
}

/* A fall onto a level floor is the closed form itself: 1e-9 of the time, whatever a scene with other floors allows. */
static int lands_level(const tahr_event *e)
{
    return e->type == TAHR_EVENT_LANDED && e->normal.z > 1 - 1e-12;
}

/* "event": the n-th of a type, its time, place and value as far as given. Times are relative, to 1 s or more. */
static int check_event(scene_case *c)
{
    int skip = (int)scene_member(c, "n", 0);
    double tolerance = scene_member(c, "tolerance", 1e-9);
    for (int i = 0; i < c->record->event_count; i++) {
        const tahr_event *e = &c->record->events[i];
        if (strcmp(tahr_event_name(e->type), text(c, "type")) != 0 || skip-- > 0) {
            continue;
        }
        double time = scene_member(c, "time", e->time), value = scene_member(c, "value", e->value);
        double time_tolerance = scene_member(c, "time_tolerance", tolerance * fmax(1, time));
        if (lands_level(e) && c->scene->config.separation == TAHR_SEPARATION_MARGIN) {
            time_tolerance = fmin(time_tolerance, 1e-9 * time);
            tolerance = fmin(tolerance, 1e-9);
        }
        tahr_vec3 place = e->position;
        json_t *wanted = json_object_get(c->item, "place");
        if (!(fabs(e->time - time) <= time_tolerance)) {
            return scene_violated(c, e->time, "time of the event", e->time, time);
        }
        if (!(fabs(e->value - value) <= tolerance * fmax(1, fabs(value)))) {
            return scene_violated(c, e->time, "value of the event", e->value, value);
        }
        if (json_object_get(c->item, "body") && (double)e->body != scene_member(c, "body", 0)) {
            return scene_violated(c, e->time, "body of the event", e->body, scene_member(c, "body", 0));
        }
        return !wanted || (scene_vec3(c->scene, wanted, &place) && compare(c, e->time, "place", e->position, place));
    }
    snprintf(c->failure, sizeof c->failure, "no event of type %.40s", text(c, "type"));
    return 0;
}

static int check_events(scene_case *c)
{
    double count = 0, wanted = scene_member(c, "count", 0), last = 0;
    double from = scene_member(c, "from", -1), to = scene_member(c, "to", 1e9);
    for (int i = 0; i < c->record->event_count; i++) {
        const tahr_event *e = &c->record->events[i];
        if (strcmp(tahr_event_name(e->type), text(c, "type")) == 0 && e->time >= from && e->time <= to) {
            count++;
            last = e->time;
        }
    }
    return count == wanted ? 1 : scene_violated(c, last, text(c, "type"), count, wanted);
}

static int check_range(scene_case *c)
{
    const char *of = text(c, "of");
    for (int i = 1; i < c->record->count; i++) {
        const scene_sample *s = &c->record->samples[i];
        scene_names_set(&c->scene->names, "t", s->time);
        double low = scene_member(c, "min", -INFINITY), high = scene_member(c, "max", INFINITY);
        double value = scene_measure(c, s, of);
        if (scene_in_window(c, s) && !(value >= low && value <= high)) {
            return scene_violated(c, s->time, of, value, value < low ? low : high);
        }
    }
    return 1;
}

/* "rides": its place in the frame of a body that moves stays the same. */
static int check_rides(scene_case *c)
{
    uint32_t body = (uint32_t)scene_member(c, "body", 0);
    const scene_sample *first = NULL;
    tahr_vec3 place = {0, 0, 0};
    for (int i = 0; i < c->record->count; i++) {
        const scene_sample *s = &c->record->samples[i];
        if (!scene_in_window(c, s)) {
            continue;
        }
        tahr_pose pose = scene_motion_pose(c->scene, body, s->time);
        tahr_vec3 p = s->state.position, o = pose.position;
        tahr_vec3 here = scene_turn_back(pose.orientation, (tahr_vec3){p.x - o.x, p.y - o.y, p.z - o.z});
        place = first ? place : here;
        first = first ? first : s;
        if (!compare(c, s->time, "place on the body", here, place)) {
            return 0;
        }
    }
    return first ? 1 : scene_violated(c, 0, "no step in the window; steps", 0, 1);
}

static int pushes(const scene_sample *s)
{
    return s->input.move.x != 0 || s->input.move.y != 0 || s->input.move.z != 0;
}

/* Every state in the window has the bits of the first one; of one that pushes, on a backend that promises less, its
 * place. */
static int check_idle(scene_case *c)
{
    const scene_sample *first = NULL;
    for (int i = 1; i < c->record->count; i++) {
        const scene_sample *s = &c->record->samples[i];
        if (!scene_in_window(c, s)) {
            continue;
        }
        if (first && pushes(s) && c->backend->push > 0) {
            if (!(scene_way(first, s) <= c->backend->push)) {
                return scene_violated(c, s->time, "way moved by pushing", scene_way(first, s), c->backend->push);
            }
        } else if (first && memcmp(&first->state, &s->state, sizeof s->state) != 0) {
            return scene_violated(c, s->time, "state changed by one bit or more; z", s->state.position.z,
                                  first->state.position.z);
        }
        first = first ? first : s;
    }
    return 1;
}

/* The run again in another frame, and the paths compared in this one. */
static int compare_paths(scene_case *c, const tahr_pose *frame)
{
    scene_record other = {0};
    double tolerance = scene_member(c, "tolerance", 1e-6);
    memcpy(other.cuts, c->record->cuts, sizeof other.cuts);
    other.cut_count = c->record->cut_count;
    int ok = scene_run(c->scene, c->backend, c->rate, frame, &other);
    if (!ok) {
        snprintf(c->failure, sizeof c->failure, "in the other frame: %.200s", other.error);
    }
    for (int i = 0; ok && i < c->record->count; i++) {
        scene_sample *there = &other.samples[i];
        tahr_vec3 p = there->state.position, o = frame->position;
        there->state.position = scene_turn_back(frame->orientation, (tahr_vec3){p.x - o.x, p.y - o.y, p.z - o.z});
        double way = scene_way(&c->record->samples[i], there);
        if (!(way <= tolerance)) {
            ok = scene_violated(c, c->record->samples[i].time, "distance to the path in the other frame", way, 0);
        }
    }
    scene_record_free(&other);
    return ok;
}

static int check_same_path(scene_case *c)
{
    tahr_pose frame = {{0, 0, 0}, {0, 0, 0, 1}};
    return scene_vec3(c->scene, json_object_get(c->item, "offset"), &frame.position) && compare_paths(c, &frame);
}

/* The shortest turn that takes z to "up" (which must not point straight down). */
static int check_turned_path(scene_case *c)
{
    tahr_pose frame = {{0, 0, 0}, {0, 0, 0, 1}};
    tahr_vec3 up;
    if (!scene_vec3(c->scene, json_object_get(c->item, "up"), &up)) {
        return 0;
    }
    double length = sqrt(up.x * up.x + up.y * up.y + up.z * up.z), w = 1 + up.z / length, size;
    frame.orientation = (tahr_quat){-up.y / length, up.x / length, 0, w};
    size = sqrt(up.x * up.x / (length * length) + up.y * up.y / (length * length) + w * w);
    frame.orientation = (tahr_quat){frame.orientation.x / size, frame.orientation.y / size, 0, w / size};
    return compare_paths(c, &frame);
}

static const struct {
    const char *kind;
    int (*check)(scene_case *c);
} KINDS[] = {
    {"position", check_vector},       {"velocity", check_vector},   {"mode", check_mode},
    {"step_speed", check_step_speed}, {"crossing", check_crossing}, {"event", check_event},
    {"events", check_events},         {"range", check_range},       {"idle", check_idle},
    {"same_path", check_same_path},   {"slide", scene_check_slide}, {"turned_path", check_turned_path},
    {"rides", check_rides},
};

static int check_one(scene_case *c)
{
    if (scene_member(c, "if", 1) == 0) {
        return !c->failure[0];
    }
    for (size_t k = 0; k < sizeof KINDS / sizeof KINDS[0]; k++) {
        if (strcmp(KINDS[k].kind, text(c, "kind")) == 0) {
            return KINDS[k].check(c) && !c->failure[0];
        }
    }
    snprintf(c->failure, sizeof c->failure, "no such kind of expectation: %.60s", text(c, "kind"));
    return 0;
}

/* m, that stays free of everything that blocks. PULL_BACK keeps a part of each motion off, which along a wall is
 * nothing. */
static double kept_free(const scene_case *c)
{
    int skin = c->scene->config.separation == TAHR_SEPARATION_MARGIN;
    return skin ? c->backend->clearance * c->scene->config.skin : 0;
}

/* In every scene: once free, that much stays free after every move, nobody is crushed, and no step asks more than was
 * promised. */
static int check_always(scene_case *c)
{
    const double most = TAHR_MAX_QUERIES_PER_STEP + TAHR_MAX_SENSOR_QUERIES_PER_STEP;
    double needed = kept_free(c) - c->backend->slack;
    int was_free = 0;
    for (int i = 0; i < c->record->count; i++) {
        const scene_sample *s = &c->record->samples[i];
        if (was_free && !(s->clearance >= needed) && !c->scene->may_be_crushed) {
            return scene_violated(c, s->time, "clearance", s->clearance, kept_free(c));
        }
        if (s->queries > most) {
            return scene_violated(c, s->time, "queries of a step", s->queries, most);
        }
        if ((s->flags & TAHR_REPORT_CRUSHED) && !c->scene->may_be_crushed) {
            return scene_violated(c, s->time, "crushed", 1, 0);
        }
        was_free = was_free || s->clearance >= needed;
    }
    return 1;
}

static void find_cuts(scene *s, scene_record *r)
{
    size_t i;
    json_t *item;
    json_array_foreach(s->expect, i, item)
    {
        json_t *at = json_object_get(item, "at");
        double time;
        if (at && scene_number(s, at, &time)) {
            scene_record_cut(r, time);
        }
    }
}

int scene_check(scene *s, const scene_backend *backend, double rate, char *failure)
{
    scene_record record = {0};
    scene_case c = {.scene = s, .backend = backend, .rate = rate, .record = &record};
    json_t *item;
    size_t i;
    scene_names_set(&s->names, "gap", backend->gap_error);
    scene_names_set(&s->names, "drift", backend->drift);
    scene_names_set(&s->names, "dt", 1 / rate);
    find_cuts(s, &record);
    const tahr_pose here = {{0, 0, 0}, {0, 0, 0, 1}};
    int ok = scene_run(s, backend, rate, &here, &record);
    if (!ok) {
        snprintf(c.failure, sizeof c.failure, "%.250s", record.error);
    }
    if (ok) {
        scene_names_set(&s->names, "x0", record.samples[0].state.position.x);
        scene_names_set(&s->names, "y0", record.samples[0].state.position.y);
        scene_names_set(&s->names, "z0", record.samples[0].state.position.z);
    }
    ok = ok && check_always(&c);
    json_array_foreach(s->expect, i, item)
    {
        c.item = item;
        ok = ok && check_one(&c);
    }
    if (ok && json_array_size(s->expect) == 0) {
        snprintf(c.failure, sizeof c.failure, "the scene expects nothing");
        ok = 0;
    }
    memcpy(failure, c.failure, sizeof c.failure);
    scene_record_free(&record);
    return ok;
}
