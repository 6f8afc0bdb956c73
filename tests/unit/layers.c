/* SPDX-License-Identifier: MIT
 * layers.c: worlds of one-way platforms. */
#include "layers.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <tahr/native.h>

#ifdef TAHR_HAVE_CCD
#include <tahr/ccd.h>
#endif
#ifdef TAHR_HAVE_FCL
#include <tahr/fcl.h>
#endif

/* m, half of the depth of everything: a character of 0.35 m stays in the middle. */
static const double DEPTH = 3;

int layers_begin(layers *l, int world)
{
    memset(l, 0, sizeof *l);
    l->up = world % 2 ? 1 : 2;
    l->backend = world < 2 ? tahr_backend_v1_native() : NULL;
#ifdef TAHR_HAVE_CCD
    if (world / 2 == 1) l->backend = tahr_backend_v1_ccd();
#endif
#ifdef TAHR_HAVE_FCL
    if (world / 2 == 2) l->backend = tahr_backend_v1_fcl();
#endif
    l->gathered = world / 2 == 3;
    if (l->gathered) l->backend = tahr_backend_v1_native();
    return l->backend != NULL;
}

/* In the plane of x and y the depth is z, else -y: both are right-handed. */
static tahr_vec3 place(const layers *l, double x, double height, double depth)
{
    return l->up == 1 ? (tahr_vec3){x, height, depth} : (tahr_vec3){x, -depth, height};
}

tahr_vec3 layers_at(const layers *l, double x, double height)
{
    return place(l, x, height, 0);
}

double layers_x(const layers *l, tahr_vec3 v)
{
    (void)l;
    return v.x;
}

double layers_height(const layers *l, tahr_vec3 v)
{
    return l->up == 1 ? v.y : v.z;
}

static tahr_body_desc *next(layers *l, uint32_t type, uint32_t flags)
{
    assert_true(l->count < LAYERS_MOST);
    tahr_body_desc *b = &l->bodies[l->count++];
    tahr_body_desc_init(b, sizeof *b, type);
    b->flags = flags;
    return b;
}

static void add_box(layers *l, double from, double to, double bottom, double height, uint32_t flags)
{
    tahr_body_desc *b = next(l, TAHR_BODY_BOX, flags);
    double across = 0.5 * (to - from), thick = 0.5 * (height - bottom);
    b->pose.position = layers_at(l, from + across, bottom + thick);
    b->half_extents = l->up == 1 ? (tahr_vec3){across, thick, DEPTH} : (tahr_vec3){across, DEPTH, thick};
}

void layers_slope(layers *l, tahr_vec3 begin, tahr_vec3 end, uint32_t flags)
{
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    double *c = l->corners[l->count];
    tahr_body_desc *b = next(l, TAHR_BODY_MESH, flags);
    tahr_vec3 v[4] = {place(l, begin.x, begin.y, DEPTH), place(l, end.x, end.y, DEPTH), place(l, end.x, end.y, -DEPTH),
                      place(l, begin.x, begin.y, -DEPTH)};
    for (int i = 0; i < 4; i++) {
        c[3 * i] = v[i].x;
        c[3 * i + 1] = v[i].y;
        c[3 * i + 2] = v[i].z;
    }
    b->vertices = c;
    b->indices = indices;
    b->vertex_count = 4;
    b->triangle_count = 2;
}

static void add_sheet(layers *l, double from, double to, double height, uint32_t flags)
{
    layers_slope(l, (tahr_vec3){from, height, 0}, (tahr_vec3){to, height, 0}, flags);
}

void layers_add(layers *l, int kind, double from, double to, double height, uint32_t flags)
{
    if (kind == LAYER_BOX) {
        add_box(l, from, to, height - 0.2, height, flags);
    } else if (kind == LAYER_SHEET) {
        add_sheet(l, from, to, height, flags);
    } else {
        for (double x = from; x < to - 1e-9; x += 1) {
            double end = x + 1 < to ? x + 1 : to;
            if (kind == LAYER_TILES) {
                add_sheet(l, x, end, height, flags);
            } else {
                add_box(l, x, end, height - 1, height, flags);
            }
        }
    }
}

tahr_config layers_config(const layers *l, uint32_t preset)
{
    tahr_config c;
    assert_int_equal(tahr_config_init(&c, sizeof c, (int32_t)preset), TAHR_OK);
    if (preset != TAHR_PRESET_PLATFORMER && l->up == 1) {
        c.gravity = (tahr_vec3){0, c.gravity.z, 0};
        c.plane = (tahr_vec3){0, 0, 1};
    }
    if (preset == TAHR_PRESET_PLATFORMER && l->up == 2) {
        c.gravity = (tahr_vec3){0, 0, c.gravity.y};
        c.plane = (tahr_vec3){0, 1, 0};
    }
    return c;
}

static int is_gathered(const layers *l, uint32_t body)
{
    return l->gathered && l->bodies[body].type == TAHR_BODY_MESH && !(l->bodies[body].flags & TAHR_BODY_MOVABLE);
}

static tahr_status gather_sheets(void *user, const tahr_bounds *box, uint32_t mask, tahr_gather *out)
{
    const layers *l = user;
    (void)box, (void)mask; /* more do not harm */
    for (uint32_t i = 0; i < l->count; i++) {
        const tahr_body_desc *b = &l->bodies[i];
        for (uint32_t k = 0; is_gathered(l, i) && k < b->triangle_count; k++) {
            tahr_triangle t = {.body = LAYERS_MOST + i, .feature = k, .flags = b->flags};
            for (int c = 0; c < 3; c++) {
                const double *v = b->vertices + 3 * (size_t)b->indices[3 * k + (uint32_t)c];
                t.corners[c] = (tahr_vec3){v[0], v[1], v[2]};
            }
            out->add(out, &t);
        }
    }
    return TAHR_OK;
}

/* So that the others keep their numbers something that nobody comes to stands in for a gathered sheet. */
static void open_gathered(layers *l, rig *r, const tahr_config *config, tahr_vec3 at)
{
    tahr_native_desc native = {.struct_size = sizeof native, .gather = gather_sheets, .gather_user = l};
    tahr_body_desc bodies[LAYERS_MOST];
    for (uint32_t i = 0; i < l->count; i++) {
        bodies[i] = l->bodies[i];
        if (is_gathered(l, i)) {
            tahr_body_desc_init(&bodies[i], sizeof bodies[i], TAHR_BODY_BOX);
            bodies[i].half_extents = (tahr_vec3){1, 1, 1};
            bodies[i].pose.position = layers_at(l, 0, -1e5);
        }
    }
    rig_open_native(r, &native, bodies, l->count, config, at);
}

void layers_open(layers *l, rig *r, const tahr_config *config, double x, double foot)
{
    tahr_config c = config ? *config : layers_config(l, TAHR_PRESET_PRECISE);
    tahr_vec3 at = layers_at(l, x, foot + c.shape.half_height);
    if (l->gathered) {
        open_gathered(l, r, &c, at);
    } else {
        rig_open_bodies_on(r, l->backend, l->bodies, l->count, &c, at);
    }
}

double layers_foot(const layers *l, const rig *r)
{
    return layers_height(l, r->state.position) - r->state.half_height;
}
