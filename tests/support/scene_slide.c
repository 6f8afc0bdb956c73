/* SPDX-License-Identifier: MIT
 * scene_slide.c: the expectation "slide": an oracle for walls and corners that knows no sweeps.
 *
 * What a character would do without walls is asked from the same character on an endless floor, until a wall's gap
 * closes. From there a character goes on whose velocity and wish are the exact projections, in two dimensions, onto the
 * walls that it walked into: along a wall the wish is that much shorter, and the acceleration with it. */
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
    double touch; /* m: a gap up to this is none */
} walls;

static int read_walls(scene_case *c, walls *w)
{
    size_t i;
    json_t *item;
    const tahr_config *config = &c->scene->config;
    memset(w, 0, sizeof *w);
    /* A backend may stop that much before a wall. Turning into it from there takes sqrt(2 gap / acceleration), whose
     * error has no bound as the gap goes to zero: such a wall is touched. */
    w->touch = 1e-10 + 2 * c->backend->gap_error;
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

/* A character on the endless floor, and what bends its way. */
typedef struct walk {
    scene_case *scene;
    tahr_world *floor;
    const walls *walls;
    int active[MAX_WALLS]; /* walked into during this step */
    int failed;            /* the library refused a step or a mover */
    tahr_input input;      /* of the step */
    tahr_state state;
} walk;

static double gap_of(const wall *a, const tahr_state *s)
{
    return a->nx * s->position.x + a->ny * s->position.y - a->c;
}

/* Projects velocity and wish onto the active walls, and makes the character that walks on with them. */
static tahr_mover *begin(walk *k, tahr_input *input)
{
    wall active[MAX_WALLS];
    int count = 0;
    tahr_config config = k->scene->scene->config;
    tahr_mover *mover = NULL;
    double v[2] = {k->state.velocity.x, k->state.velocity.y}, u[2] = {k->input.move.x, k->input.move.y}, d[2];
    double size = sqrt(u[0] * u[0] + u[1] * u[1]);
    for (int i = 0; i < k->walls->count; i++) {
        if (k->active[i]) {
            active[count++] = k->walls->item[i];
        }
    }
    project(active, count, v, d);
    k->state.velocity.x = d[0];
    k->state.velocity.y = d[1];
    u[0] /= fmax(size, 1);
    u[1] /= fmax(size, 1);
    project(active, count, u, d);
    *input = k->input;
    input->move.x = d[0];
    input->move.y = d[1];
    if (size > 0) {
        config.acceleration *= sqrt(d[0] * d[0] + d[1] * d[1]) / fmin(size, 1);
    }
    k->failed = tahr_mover_create(k->floor, &config, &mover) < 0;
    return mover;
}

/* Where the character is after dt of the piece that begins now. */
static tahr_state ask(walk *k, tahr_mover *mover, const tahr_input *input, double dt)
{
    tahr_state to = k->state;
    k->failed = k->failed || tahr_mover_step(mover, input, dt, &to, NULL) < 0;
    return to;
}

/* Activates the walls that are touched and walked into. Returns how many. */
static int press(walk *k, const tahr_state *to)
{
    int pressed = 0;
    for (int i = 0; i < k->walls->count; i++) {
        double gap = gap_of(&k->walls->item[i], &k->state);
        if (!k->active[i] && gap <= k->walls->touch && gap_of(&k->walls->item[i], to) < gap - 1e-15) {
            k->active[i] = 1;
            pressed++;
        }
    }
    return pressed;
}

/* Activates the wall whose gap closes first within dt, if one does. Returns the moment, or dt. */
static double close_gap(walk *k, tahr_mover *mover, const tahr_input *input, double dt)
{
    int first = -1;
    for (int i = 0; i < k->walls->count && !k->failed; i++) {
        const wall *a = &k->walls->item[i];
        tahr_state at = ask(k, mover, input, dt);
        if (k->active[i] || gap_of(a, &k->state) <= k->walls->touch || gap_of(a, &at) >= 0) {
            continue;
        }
        double low = 0, high = dt;
        while (high - low > 1e-13) {
            double middle = 0.5 * (low + high);
            at = ask(k, mover, input, middle);
            *(gap_of(a, &at) < 0 ? &high : &low) = middle;
        }
        first = i;
        dt = low;
    }
    if (first >= 0) {
        k->active[first] = 1;
    }
    return dt;
}

/* Walks for dt, from wall to wall. Returns 0 if the library refused something. */
static int slide(walk *k, double dt)
{
    memset(k->active, 0, sizeof k->active);
    while (dt > 0) { /* every round but the last activates a wall */
        tahr_input input;
        tahr_mover *mover = begin(k, &input);
        tahr_state to = ask(k, mover, &input, dt);
        if (!k->failed && !press(k, &to)) {
            double part = close_gap(k, mover, &input, dt);
            k->state = ask(k, mover, &input, part);
            dt -= part;
        }
        tahr_mover_destroy(mover);
        if (k->failed) {
            return 0;
        }
    }
    return 1;
}

static int compare_all(walk *k)
{
    scene_case *c = k->scene;
    double tolerance = scene_member(c, "tolerance", 1e-9);
    for (int i = 1; i < c->record->count; i++) {
        const scene_sample *s = &c->record->samples[i];
        if (!scene_in_window(c, s)) {
            continue;
        }
        k->state = s[-1].state;
        k->state.floor_revision = 0; /* it was found in another world */
        k->input = s->input;
        if (!slide(k, s->dt)) {
            return scene_violated(c, s->time, "stepping without walls: status", -1, 0);
        }
        double x = s->state.position.x, y = s->state.position.y;
        double dx = x - k->state.position.x, dy = y - k->state.position.y;
        if (!(sqrt(dx * dx + dy * dy) <= tolerance)) {
            return fabs(dx) > fabs(dy) ? scene_violated(c, s->time, "slide x", x, k->state.position.x)
                                       : scene_violated(c, s->time, "slide y", y, k->state.position.y);
        }
    }
    return 1;
}

int scene_check_slide(scene_case *c)
{
    walls w;
    walk k;
    tahr_body_desc floor;
    tahr_world *world = NULL;
    tahr_body_desc_init(&floor, sizeof floor, TAHR_BODY_BOX);
    floor.half_extents = (tahr_vec3){1000, 1000, 1};
    floor.pose.position.z = scene_member(c, "floor", 0) - 1;
    if (!read_walls(c, &w)) {
        return 0;
    }
    if (scene_backend_open(c->backend, &floor, 1, NULL, &world) < 0) {
        return scene_violated(c, 0, "opening the endless floor: status", -1, 0);
    }
    memset(&k, 0, sizeof k);
    k.scene = c;
    k.floor = world;
    k.walls = &w;
    int ok = compare_all(&k);
    tahr_world_close(world);
    return ok;
}
