/* SPDX-License-Identifier: MIT
 * soup.c: see soup.h. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "scene_level.h"
#include "soup.h"

#define CELL 4.0

static tahr_bounds bounds_of(const tahr_triangle *t)
{
    tahr_bounds b = {v_min(t->corners[0], v_min(t->corners[1], t->corners[2])),
                     v_max(t->corners[0], v_max(t->corners[1], t->corners[2]))};
    return b;
}

static uint32_t clamped(double x, uint32_t most)
{
    return x < 0 ? 0 : x >= most ? most - 1 : (uint32_t)x;
}

/* Cells [from, to] of a box; what lies beyond counts for the outermost. */
static void range_of(const soup *s, const tahr_bounds *b, uint32_t from[3], uint32_t to[3])
{
    for (int i = 0; i < 3; i++) {
        from[i] = clamped(floor((v_get(b->min, i) - v_get(s->low, i)) / CELL), s->cells[i]);
        to[i] = clamped(floor((v_get(b->max, i) - v_get(s->low, i)) / CELL), s->cells[i]);
    }
}

static uint32_t cell_of(const soup *s, uint32_t x, uint32_t y, uint32_t z)
{
    return (z * s->cells[1] + y) * s->cells[0] + x;
}

/* Counts (list NULL) or lists the triangles of every cell. */
static void sort_in(soup *s, uint32_t *next, uint32_t *list)
{
    for (uint32_t i = 0; i < s->count; i++) {
        uint32_t from[3], to[3];
        tahr_bounds b = bounds_of(&s->triangles[i]);
        range_of(s, &b, from, to);
        for (uint32_t z = from[2]; z <= to[2]; z++) {
            for (uint32_t y = from[1]; y <= to[1]; y++) {
                for (uint32_t x = from[0]; x <= to[0]; x++) {
                    uint32_t at = next[cell_of(s, x, y, z)]++;
                    if (list) list[at] = i;
                }
            }
        }
    }
}

void soup_make(soup *s, const tahr_body_desc *mesh, uint32_t body)
{
    memset(s, 0, sizeof *s);
    s->count = mesh->triangle_count;
    s->triangles = calloc(s->count, sizeof *s->triangles);
    assert_non_null(s->triangles);
    tahr_bounds all = {{1e9, 1e9, 1e9}, {-1e9, -1e9, -1e9}};
    for (uint32_t i = 0; i < s->count; i++) {
        tahr_triangle *t = &s->triangles[i];
        for (int k = 0; k < 3; k++) {
            const double *v = mesh->vertices + 3 * (size_t)mesh->indices[3 * i + (uint32_t)k];
            t->corners[k] = v_make(v[0], v[1], v[2]);
            all.min = v_min(all.min, t->corners[k]);
            all.max = v_max(all.max, t->corners[k]);
        }
        t->body = body;
        t->feature = i;
        t->surface = mesh->surface;
        t->mask = mesh->mask;
        t->flags = mesh->flags;
    }
    s->low = v_make(floor(all.min.x / CELL) * CELL, floor(all.min.y / CELL) * CELL, floor(all.min.z / CELL) * CELL);
    for (int i = 0; i < 3; i++)
        s->cells[i] = clamped((v_get(all.max, i) - v_get(s->low, i)) / CELL, 256) + 1;
    uint32_t cells = s->cells[0] * s->cells[1] * s->cells[2], sum = 0;
    uint32_t *next = calloc(cells + 1, sizeof *next);
    s->first = calloc(cells + 1, sizeof *s->first);
    assert_true(next && s->first);
    sort_in(s, next, NULL);
    for (uint32_t i = 0; i <= cells; i++) {
        uint32_t here = next[i];
        s->first[i] = next[i] = sum;
        sum += here;
    }
    s->list = calloc(sum + 1, sizeof *s->list);
    assert_non_null(s->list);
    sort_in(s, next, s->list);
    free(next);
}

void soup_free(soup *s)
{
    free(s->triangles);
    free(s->first);
    free(s->list);
}

tahr_status soup_gather(void *user, const tahr_bounds *box, uint32_t mask, tahr_gather *out)
{
    soup *s = user;
    uint32_t from[3], to[3];
    range_of(s, box, from, to);
    s->calls++;
    for (int i = 0; i < 3; i++) { /* whole cells */
        assert_true(v_get(box->min, i) == floor(v_get(box->min, i) / CELL) * CELL);
        assert_true(v_get(box->max, i) == floor(v_get(box->max, i) / CELL) * CELL);
    }
    for (uint32_t z = from[2]; z <= to[2]; z++) {
        for (uint32_t y = from[1]; y <= to[1]; y++) {
            for (uint32_t x = from[0]; x <= to[0]; x++) {
                uint32_t cell = cell_of(s, x, y, z), begin = s->first[cell], end = s->first[cell + 1];
                for (uint32_t k = begin; k < end; k++) {
                    const tahr_triangle *t = &s->triangles[s->list[s->reversed ? end - 1 - (k - begin) : k]];
                    if (t->mask && !(t->mask & mask)) continue;
                    if (!out->add(out, t)) return TAHR_OK;
                }
            }
        }
    }
    return TAHR_OK;
}

void soup_ask(fixture *f, const tahr_sweep *sweep, soup_answer *a)
{
    const tahr_backend *b = tahr_backend_v1_native();
    tahr_contact_query c = fixture_contacts(sweep->shape, sweep->position, 0.05);
    tahr_ray ray = {sweep->position, sweep->motion, sweep->mask, sweep->ignore_body};
    memset(a, 0, sizeof *a);
    c.up = sweep->up;
    c.mask = sweep->mask;
    a->status[0] = b->sweep(f->self, &f->context, sweep, a->hits, 4, &a->hit_count);
    a->status[1] = b->contacts(f->self, &f->context, &c, a->contacts, 16, &a->contact_count);
    a->status[2] = b->ray(f->self, &f->context, &ray, &a->ray, &a->ray_count);
}

void soup_announce(fixture *f, tahr_vec3 at, tahr_vec3 up, double far)
{
    const tahr_vec3 reach = {far, far, far};
    tahr_prepare a;
    memset(&a, 0, sizeof a);
    a.position = at;
    a.up = up;
    a.mask = 0xFFFFFFFFu;
    a.bounds.min = v_sub(at, reach);
    a.bounds.max = v_add(at, reach);
    assert_int_equal(tahr_backend_v1_native()->prepare(f->self, &f->context, &a), TAHR_OK);
}

tahr_sweep soup_query(const soup *s, oracle_random *r, uint32_t n)
{
    const tahr_triangle *t = &s->triangles[oracle_below(r, s->count)];
    double a = oracle_uniform(r, 0, 1), b = oracle_uniform(r, 0, 1 - a);
    tahr_vec3 at = v_scale(t->corners[0], 1 - a - b);
    at = v_mad(v_mad(at, t->corners[1], a), t->corners[2], b);
    at = v_add(at, v_scale(dice_direction(r), oracle_uniform(r, 0, 1.2)));
    tahr_sweep q = fixture_sweep(native_shape((int)(n % 3)), at, dice_vec(r, -0.8, 0.8), 0.01);
    if (n % 4 == 0) q.motion = v_make(0, 0, -0.5);
    if (n % 4 == 1) q.motion.z = 0;
    if (n % 40 == 7) q.motion = v_scale(q.motion, 12); /* far beyond what was announced */
    if (n % 5 == 0) q.up = dice_direction(r);
    q.flags = n % 2 ? TAHR_SWEEP_LEAVE_OVERLAP : 0;
    return q;
}

uint32_t soup_compare(fixture *worlds, uint32_t count, const soup *s, uint32_t queries)
{
    oracle_random r = {11};
    uint32_t hits = 0;
    for (uint32_t n = 0; n < queries; n++) {
        tahr_sweep q = soup_query(s, &r, n);
        soup_answer first, other;
        for (uint32_t i = 0; i < count; i++) {
            const double reach[] = {1.6, 0.2, 1.6, 0.7, 5};
            soup_announce(&worlds[i], q.position, q.up, reach[(n / 7 + i) % 5]);
            soup_ask(&worlds[i], &q, i == 0 ? &first : &other);
            if (i > 0 && memcmp(&first, &other, sizeof first) != 0)
                fail_msg("query %u: world %u answers otherwise than world 0 (%u and %u hits, features %u and %u)", n, i,
                         other.hit_count, first.hit_count, other.hits[0].feature, first.hits[0].feature);
        }
        assert_int_equal(first.status[0], TAHR_OK);
        hits += first.hit_count > 0 && first.hits[first.hit_count - 1].blocking;
    }
    return hits;
}

void soup_open_all(fixture worlds[SOUP_WORLDS], const tahr_body_desc *mesh, soup soups[2])
{
    for (uint32_t i = 0; i < SOUP_WORLDS; i++) {
        tahr_native_desc o = fixture_options();
        o.no_cache = i < 2;
        o.no_simd = i == 3;
        o.cache_triangles = i == 4 ? 16 : 600;
        o.cache_margin = i == 5 ? 3 : 0.5;
        if (i > 0) {
            o.gather = soup_gather;
            o.gather_user = &soups[i % 2];
        }
        fixture_init(&worlds[i]);
        assert_int_equal(fixture_open(&worlds[i], mesh, i == 0, &o, 1), TAHR_OK);
    }
}

void soup_compare_level(const char *name, uint32_t queries)
{
    scene_mesh mesh = {0};
    char why[256];
    if (!scene_level_make(name, &mesh, why)) {
        print_message("SKIP: unit_native_gather: %s %s\n", name, why);
        scene_mesh_free(&mesh);
        return;
    }
    tahr_body_desc body;
    soup soups[2];
    scene_level_body(&mesh, &body);
    for (uint32_t i = 0; i < 2; i++) {
        soup_make(&soups[i], &body, 0);
        soups[i].reversed = i;
    }
    fixture worlds[SOUP_WORLDS];
    soup_open_all(worlds, &body, soups);
    uint32_t hits = soup_compare(worlds, SOUP_WORLDS, &soups[0], queries);
    print_message("    %s: %u queries, %u stopped\n", name, queries, hits);
    assert_true(hits > queries / 4);
    assert_true(worlds[2].context.gathers > queries / 4);
    for (uint32_t i = 0; i < SOUP_WORLDS; i++)
        native_close(&worlds[i]);
    soup_free(&soups[0]);
    soup_free(&soups[1]);
    scene_mesh_free(&mesh);
}
