/* SPDX-License-Identifier: MIT
 * scene_slide.c: the expectation "slide": an oracle for walls and corners that knows no sweeps.
 *
 * What a step would do without walls is asked from the same character on an endless floor; the walls then bend it by exact
 * projection, from event to event, in two dimensions. */
#include "scene_check.h"

#include <math.h>
#include <string.h>

enum { MAX_WALLS = 8 };

typedef struct wall {
    double nx, ny, c; /* free where nx x + ny y >= c, for the centre of the shape */
} wall;

typedef struct walls {
    wall item[MAX_WALLS];
    int count;
} walls;

static int read_walls(scene_case *c, walls *w)
{
    size_t i;
    json_t *item;
    const tahr_config *config = &c->scene->config;
    memset(w, 0, sizeof *w);
    json_array_foreach(json_object_get(c->item, "walls"), i, item)
    {
        tahr_vec3 point, normal;
        if (i == MAX_WALLS || !scene_vec3(c->scene, json_object_get(item, "point"), &point) ||
            !scene_vec3(c->scene, json_object_get(item, "normal"), &normal)) {
            return scene_violated(c, 0, "bad walls", (double)i, 0);
        }
        double size = sqrt(normal.x * normal.x + normal.y * normal.y);
        wall *a = &w->item[w->count++];
        a->nx = normal.x / size;
        a->ny = normal.y / size;
        a->c = a->nx * point.x + a->ny * point.y + config->shape.radius + config->skin;
    }
    return 1;
}

/* Projects u onto the cone of the active walls: itself, along one of them, or nothing. */
static void project(const wall *active, int count, const double u[2], double d[2])
{
    int free_way = 1;
    double best = 0;
    for (int i = 0; i < count; i++) {
        free_way = free_way && active[i].nx * u[0] + active[i].ny * u[1] >= 0;
    }
    d[0] = free_way ? u[0] : 0;
    d[1] = free_way ? u[1] : 0;
    for (int i = 0; !free_way && i < count; i++) {
        double along = active[i].nx * u[0] + active[i].ny * u[1];
        double x = u[0] - along * active[i].nx, y = u[1] - along * active[i].ny;
        int allowed = along < 0;
        for (int k = 0; k < count; k++) {
            allowed = allowed && (k == i || active[k].nx * x + active[k].ny * y >= -1e-12);
        }
        if (allowed && x * x + y * y > best) {
            best = x * x + y * y;
            d[0] = x;
            d[1] = y;
        }
    }
}

static void slide(const walls *w, const double start[2], const double u[2], double end[2])
{
    double left = 1;
    end[0] = start[0];
    end[1] = start[1];
    for (int event = 0; event < 2 * MAX_WALLS && left > 0; event++) {
        wall active[MAX_WALLS];
        int count = 0;
        for (int i = 0; i < w->count; i++) {
            double gap = w->item[i].nx * end[0] + w->item[i].ny * end[1] - fmin(w->item[i].c, w->item[i].nx * start[0] + w->item[i].ny * start[1]);
            if (gap <= 1e-10) {
                active[count++] = w->item[i];
            }
        }
        double rest[2] = {u[0] * left, u[1] * left}, d[2], part = 1;
        project(active, count, rest, d);
        for (int i = 0; i < w->count; i++) {
            const wall *a = &w->item[i];
            double toward = a->nx * d[0] + a->ny * d[1], gap = a->nx * end[0] + a->ny * end[1] - a->c;
            if (toward < -1e-15 && gap > 1e-10 && gap < -toward * part) {
                part = gap / -toward;
            }
        }
        end[0] += part * d[0];
        end[1] += part * d[1];
        left *= 1 - part;
    }
}

/* The step of a sample again, on a floor without walls. */
static int without_walls(scene_case *c, tahr_mover *mover, const scene_sample *s, double u[2])
{
    tahr_state state = s[-1].state;
    if (tahr_mover_step(mover, &s->input, s->dt, &state, NULL) < 0) {
        return scene_violated(c, s->time, "stepping without walls: status", -1, 0);
    }
    u[0] = state.position.x - s[-1].state.position.x;
    u[1] = state.position.y - s[-1].state.position.y;
    return 1;
}

static int compare_all(scene_case *c, tahr_mover *mover, const walls *w)
{
    double tolerance = scene_member(c, "tolerance", 1e-9);
    for (int i = 1; i < c->record->count; i++) {
        const scene_sample *s = &c->record->samples[i];
        double start[2] = {s[-1].state.position.x, s[-1].state.position.y}, u[2] = {0, 0}, end[2];
        if (!scene_in_window(c, s)) {
            continue;
        }
        if (!without_walls(c, mover, s, u)) {
            return 0;
        }
        slide(w, start, u, end);
        double dx = s->state.position.x - end[0], dy = s->state.position.y - end[1];
        if (!(sqrt(dx * dx + dy * dy) <= tolerance)) {
            return scene_violated(c, s->time, fabs(dx) > fabs(dy) ? "slide x" : "slide y",
                                  fabs(dx) > fabs(dy) ? s->state.position.x : s->state.position.y,
                                  fabs(dx) > fabs(dy) ? end[0] : end[1]);
        }
    }
    return 1;
}

int scene_check_slide(scene_case *c)
{
    walls w;
    tahr_body_desc floor;
    tahr_world *world = NULL;
    tahr_mover *mover = NULL;
    tahr_body_desc_init(&floor, sizeof floor, TAHR_BODY_BOX);
    floor.half_extents = (tahr_vec3){1000, 1000, 1};
    floor.pose.position.z = scene_member(c, "floor", 0) - 1;
    if (!read_walls(c, &w) || scene_backend_open(c->backend, &floor, 1, NULL, &world) < 0) {
        return 0;
    }
    int ok = tahr_mover_create(world, &c->scene->config, &mover) == TAHR_OK && compare_all(c, mover, &w);
    tahr_mover_destroy(mover);
    tahr_world_close(world);
    return ok;
}
