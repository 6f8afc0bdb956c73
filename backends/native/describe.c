/* SPDX-License-Identifier: MIT
 * describe.c: what a world is made of, which way queries go through it and why, in words. All of it is found out
 * when it is asked for; nothing is allocated. */
#include "form.h"

#include <stdio.h>
#include <string.h>

/* Neighbours whose normals differ by less than this (rad) count as flat: a centimetre over ten metres. */
#define FLAT 1e-3
/* Where it is densest is looked for at so many triangles of a mesh, in a box as a step of a walker announces it. */
enum { PLACES = 512 };
#define HALF_WIDTH 0.5
#define HALF_HEIGHT 1.3
/* Corners off a grid by less than this part of a cell lie on it. */
#define ON_GRID 1e-6

static void say(const tahr_log *to, const char *text)
{
    to->write(to->user, TAHR_LOG_INFO, text);
}

typedef struct edges {
    uint64_t open, two, more,
        flat; /* sides of triangles: without a neighbour, with one, with several; one, in its plane */
} edges;

static int is_flat(const tahr__mesh *m, uint32_t a, uint32_t b)
{
    tahr_vec3 n = v_cross(tahr__mesh_normal(m, a), tahr__mesh_normal(m, b));
    return v_dot(n, n) < FLAT * FLAT && v_dot(tahr__mesh_normal(m, a), tahr__mesh_normal(m, b)) > 0;
}

static edges count_edges(const tahr__mesh *m)
{
    edges e = {0, 0, 0, 0};
    for (uint32_t i = 0; i < m->triangle_count; i++) {
        for (int k = 0; k < 3; k++) {
            uint32_t next = m->triangles[i].ring[k];
            const tahr__triangle *o = &m->triangles[next];
            int back = o->ring[0] == i || o->ring[1] == i || o->ring[2] == i;
            e.open += next == i;
            e.two += next != i && back;
            e.more += next != i && !back;
            e.flat += next != i && back && is_flat(m, i, next);
        }
    }
    return e;
}

static double percent(uint64_t part, uint64_t whole)
{
    return whole ? 100.0 * (double)part / (double)whole : 0;
}

/* Whether the corners of a triangle are three of a cell of a grid from low on, and how that cell is cut: 1 from its
 * lowest corner to its highest, 2 the other way; 0: no. */
static int is_half_cell(const tahr_vec3 v[3], tahr_vec3 low, double dx, double dy)
{
    double x[3], y[3], column = 1e300, row = 1e300;
    uint32_t corners = 0;
    for (int i = 0; i < 3; i++) {
        x[i] = (v[i].x - low.x) / dx;
        y[i] = (v[i].y - low.y) / dy;
        if (!(fabs(x[i] - floor(x[i] + 0.5)) < ON_GRID && fabs(y[i] - floor(y[i] + 0.5)) < ON_GRID)) return 0;
        column = d_min(column, floor(x[i] + 0.5));
        row = d_min(row, floor(y[i] + 0.5));
    }
    for (int i = 0; i < 3; i++) {
        double c = floor(x[i] + 0.5) - column, r = floor(y[i] + 0.5) - row;
        if (c > 1 || r > 1) return 0;
        corners |= 1u << (int)(c + 2 * r);
    }
    return corners == 0xB || corners == 0xD ? 1 : corners == 0x7 || corners == 0xE ? 2 : 0;
}

typedef struct grid {
    uint32_t columns, rows;
    int cut; /* of all cells alike; 0: it is none */
} grid;

/* Is a mesh a field of heights over a regular grid, without holes? */
static grid find_grid(const tahr__mesh *m)
{
    grid g = {0, 0, 0};
    double dx = 0, dy = 0;
    tahr_vec3 low = m->bounds.min, high = m->bounds.max;
    for (uint32_t i = 0; i < m->triangle_count; i++) {
        tahr_vec3 v[3];
        for (int k = 0; k < 3; k++)
            v[k] = m->vertices[m->triangles[i].vertex[k]];
        if (i == 0) {
            dx = d_max(fabs(v[1].x - v[0].x), fabs(v[2].x - v[0].x));
            dy = d_max(fabs(v[1].y - v[0].y), fabs(v[2].y - v[0].y));
            if (!(dx > 0 && dy > 0)) return g;
        }
        int cut = is_half_cell(v, low, dx, dy);
        if (cut == 0 || (i > 0 && cut != g.cut)) return (grid){0, 0, 0};
        g.cut = cut;
    }
    double columns = floor((high.x - low.x) / dx + 0.5), rows = floor((high.y - low.y) / dy + 0.5);
    g.columns = (uint32_t)columns + 1;
    g.rows = (uint32_t)rows + 1;
    /* As many triangles as a whole one has, no two in one place: duplicates are gone. One above another would have
     * corners of its own. */
    int whole =
        2 * columns * rows == (double)m->triangle_count && (columns + 1) * (rows + 1) == (double)m->vertex_count;
    return whole ? g : (grid){0, 0, 0};
}

/* The place of a body where most primitives meet what a step announces. */
typedef struct dense {
    uint32_t most;
    double margin;
    int fits;
} dense;

/* A search that counts. */
typedef struct counting {
    tahr__search search;
    uint32_t count;
    uint32_t reserved;
} counting;

static void count_one(tahr__search *search, const tahr__prim *prim)
{
    (void)prim;
    ((counting *)search)->count++;
}

static void count_many(tahr__search *search, uint32_t body, const uint32_t *items, uint32_t count)
{
    (void)body;
    (void)items;
    ((counting *)search)->count += count;
}

/* How many a box (world) concerns, about; more than a cache may hold: at least so many. */
static uint32_t count_in(const tahr__query *query, const tahr_bounds *box)
{
    counting c = {.search = {.query = query, .order = TAHR__IN_BULK, .room = TAHR__CACHE_MOST}};
    c.search.box = tahr__frame_box_to_local(query->frame, box);
    c.search.visit = count_one;
    c.search.take = count_many;
    tahr__tree_search(&c.search, &query->world->fixed);
    return c.count;
}

/* How far around a gather would go there. */
static void find_margin(const tahr__query *query, const tahr_bounds *box, dense *d)
{
    const tahr__native *world = query->world;
    double next = world->cache_margin;
    uint32_t count;
    do {
        d->margin = next;
        const tahr_vec3 m = {next, next, next};
        count = count_in(query, &(tahr_bounds){v_sub(box->min, m), v_add(box->max, m)});
    } while (tahr__margin_choose(world, box->max.x - box->min.x, count, &next));
    d->fits = count <= world->capacity;
    if (d->fits) d->margin = next;
}

static dense find_densest(const tahr__native *world, uint32_t id)
{
    const tahr__body *body = &world->bodies[id];
    const tahr__mesh *m = &body->mesh;
    uint32_t step = m->triangle_count / PLACES + 1;
    dense d = {0, 0, 1};
    for (uint32_t i = 0; i < m->triangle_count; i += step) {
        const uint32_t *v = m->triangles[i].vertex;
        tahr_vec3 at = v_scale(v_add(v_add(m->vertices[v[0]], m->vertices[v[1]]), m->vertices[v[2]]), 1.0 / 3);
        tahr_vec3 half = {HALF_WIDTH, HALF_WIDTH, HALF_HEIGHT};
        at = v_add(body->position, body->turned ? m_apply(&body->turn, at) : at);
        tahr_bounds box = {v_sub(at, half), v_add(at, half)};
        tahr__query query;
        memset(&query, 0, sizeof query);
        query.world = world;
        query.own_frame = tahr__frame_make(at, v_make(0, 0, 1));
        query.frame = &query.own_frame;
        query.mask = 0xFFFFFFFFu;
        query.ignore_body = TAHR_NO_BODY;
        query.sensors = TAHR__SENSORS_TOO;
        uint32_t count = count_in(&query, &box);
        if (count <= d.most) continue;
        d.most = count;
        find_margin(&query, &box, &d);
    }
    return d;
}

static void describe_density(const tahr__native *world, uint32_t id, const tahr_log *to)
{
    char text[256];
    const char *more = "";
    dense d = find_densest(world, id);
    if (d.most > TAHR__CACHE_MOST) {
        d.most = TAHR__CACHE_MOST;
        more = "more than ";
    }
    int n = snprintf(text, sizeof text, "body %u: densest around a step: %s%u primitives; ", (unsigned)id, more,
                     (unsigned)d.most);
    if (world->no_cache)
        snprintf(text + n, sizeof text - (size_t)n, "nothing is gathered: no_cache");
    else if (d.fits)
        snprintf(text + n, sizeof text - (size_t)n, "gathered there within %.3g m of it: %s", d.margin,
                 world->fixed_margin ? "cache_margin says so" : "the cheapest by their number");
    else
        snprintf(text + n, sizeof text - (size_t)n, "too many for a cache of %u: queries walk the tree there%s",
                 (unsigned)world->capacity,
                 world->bodies[id].type == TAHR_BODY_HEIGHTS ? ", but walks where it is level" : "");
    say(to, text);
}

static void describe_mesh(const tahr__native *world, uint32_t id, const tahr_log *to)
{
    const tahr__mesh *m = &world->bodies[id].mesh;
    char text[256];
    edges e = count_edges(m);
    uint64_t sides = 3 * (uint64_t)m->triangle_count;
    uint64_t bytes = (uint64_t)m->triangle_capacity * sizeof *m->triangles + m->vertex_capacity * sizeof *m->vertices +
                     (uint64_t)m->tree.node_capacity * sizeof *m->tree.nodes;
    snprintf(text, sizeof text,
             "body %u: mesh, %u triangles (%u more dropped: no area, or there twice), %u vertices; path: its tree, %u "
             "nodes of eight; %.1f bytes per triangle",
             (unsigned)id, (unsigned)m->triangle_count, (unsigned)m->dropped, (unsigned)m->vertex_count,
             (unsigned)m->tree.node_count, (double)bytes / m->triangle_count);
    say(to, text);
    snprintf(text, sizeof text,
             "body %u: sides of triangles: %.1f %% with one neighbour (%.1f %% flat), %.1f %% open, %.1f %% with "
             "several",
             (unsigned)id, percent(e.two, sides), percent(e.flat, e.two), percent(e.open, sides),
             percent(e.more, sides));
    say(to, text);
    if (!(world->bodies[id].flags & TAHR_BODY_MOVABLE)) describe_density(world, id, to);
    grid g = find_grid(m);
    if (g.cut == 0) return;
    snprintf(text, sizeof text,
             "body %u: is a field of %u x %u heights: as TAHR_BODY_HEIGHTS %.1f bytes per triangle, and %s",
             (unsigned)id, (unsigned)g.columns, (unsigned)g.rows, 8.0 * g.columns * g.rows / m->triangle_count,
             g.cut == 1 ? "the same surface" : "with its cells cut the other way");
    say(to, text);
}

static void describe_heights(uint32_t id, const tahr__heights *h, const tahr_log *to)
{
    char text[256];
    double triangles = 2.0 * (h->columns - 1) * (h->rows - 1);
    snprintf(
        text, sizeof text,
        "body %u: field of %u x %u heights, %.0f triangles less its holes; path: straight from the grid; %.1f bytes "
        "per triangle",
        (unsigned)id, (unsigned)h->columns, (unsigned)h->rows, triangles, 8.0 * h->columns * h->rows / triangles);
    say(to, text);
}

/* What is no mesh and no field has nothing to choose from. */
static void describe_solids(const tahr__native *world, uint32_t pieces, uint32_t round, const tahr_log *to)
{
    char text[256];
    snprintf(text, sizeof text,
             "boxes and hulls: %u, met as their triangles and, by who is in them, as solids; spheres and capsules: %u, "
             "met in one piece; path: the tree of static bodies, %u nodes, and that of movable ones",
             (unsigned)pieces, (unsigned)round, (unsigned)world->fixed.tree.node_count);
    say(to, text);
}

tahr_status tahr__native_describe(void *self, const tahr_log *to)
{
    static const char *const names[] = {"meshes", "boxes", "spheres", "capsules", "hulls", "fields of heights"};
    static const uint32_t types[] = {TAHR_BODY_MESH,    TAHR_BODY_BOX,  TAHR_BODY_SPHERE,
                                     TAHR_BODY_CAPSULE, TAHR_BODY_HULL, TAHR_BODY_HEIGHTS};
    enum { TYPES = sizeof types / sizeof types[0] };
    const tahr__native *world = self;
    char text[256];
    uint32_t counts[TYPES] = {0};
    int n = snprintf(text, sizeof text, "native, 3D, %s: %u movable and %u static bodies,", world->lanes->name,
                     (unsigned)world->movable.count, (unsigned)world->fixed.count);
    for (int t = 0; t < TYPES; t++) {
        for (uint32_t i = 0; i < world->body_count; i++)
            counts[t] += world->bodies[i].type == types[t];
        if (counts[t]) n += snprintf(text + n, sizeof text - (size_t)n, " %u %s,", (unsigned)counts[t], names[t]);
    }
    text[n - 1] = 0;
    say(to, text);
    if (counts[1] + counts[2] + counts[3] + counts[4] > 0)
        describe_solids(world, counts[1] + counts[4], counts[2] + counts[3], to);
    if (world->gather) say(to, "triangles of the user: gathered around each character, nothing kept");
    for (uint32_t i = 0; i < world->body_count; i++) {
        if (world->bodies[i].type == TAHR_BODY_MESH) describe_mesh(world, i, to);
        if (world->bodies[i].type == TAHR_BODY_HEIGHTS) describe_heights(i, &world->bodies[i].heights, to);
    }
    return TAHR_OK;
}
