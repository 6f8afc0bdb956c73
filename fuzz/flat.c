/* SPDX-License-Identifier: MIT
 * flat.c: see flat.h. */
#include "flat.h"

#include <math.h>
#include <string.h>

enum { SOLIDS = 8, CHAINS = 4, CORNERS = 8 };

/* m, to both sides along z: much farther than the reach of any query of a character. */
static const double DEPTH = 50;

/* The square root of a half. */
static const double H = 0.70710678118654757;

static void add_both(flat *f, const tahr_body_desc *body)
{
    f->plane.bodies[f->plane.body_count++] = *body;
    f->space.bodies[f->space.body_count++] = *body;
}

static void read_solid(flat *f, bytes *b)
{
    static const double sizes[] = {0.5, 1, 2, 4, 0.25, 0.05, 1e-3, 8};
    static const tahr_quat turns[] = {{0, 0, 0, 1},
                                      {0, 0, 0.70710678118654757, 0.70710678118654757},
                                      {0, 0, 0.38268343236508977, 0.92387953251128676},
                                      {0, 0, 0.17364817766693033, 0.98480775301220802}};
    static const uint32_t types[] = {TAHR_BODY_BOX, TAHR_BODY_BOX, TAHR_BODY_SPHERE, TAHR_BODY_CAPSULE};
    tahr_body_desc body;
    uint32_t type = types[bytes_below(b, 4)];
    tahr_body_desc_init(&body, sizeof body, type);
    body.pose.position = scene_point(&f->plane, b);
    body.pose.position.z = 0;
    double x = sizes[bytes_below(b, 8)], y = sizes[bytes_below(b, 8)];
    tahr_quat turn = turns[bytes_below(b, 4)];
    body.half_extents = (tahr_vec3){x, y, DEPTH};
    body.radius = x;
    body.half_height = x + y;
    /* The axis of a capsule, z, is laid along x first. */
    body.pose.orientation =
        type == TAHR_BODY_CAPSULE ? (tahr_quat){-turn.z * H, turn.w * H, turn.z * H, turn.w * H} : turn;
    add_both(f, &body);
}

/* Two triangles for each piece of the chain. */
static void add_ribbon(scene *space, const tahr_body_desc *chain, double *vertices, uint32_t *indices)
{
    tahr_body_desc *body = &space->bodies[space->body_count++];
    uint32_t n = chain->vertex_count, pieces = chain->flags & TAHR_BODY_LOOP ? n : n - 1;
    tahr_body_desc_init(body, sizeof *body, TAHR_BODY_MESH);
    for (uint32_t i = 0; i < n; i++) {
        const double *p = chain->vertices + 3 * i;
        const double pair[6] = {p[0], p[1], -DEPTH, p[0], p[1], DEPTH};
        memcpy(vertices + 6 * i, pair, sizeof pair);
    }
    for (uint32_t i = 0; i < pieces; i++) {
        uint32_t at = 2 * i, to = 2 * ((i + 1) % n);
        const uint32_t two[6] = {at, to, to + 1, at, to + 1, at + 1};
        memcpy(indices + 6 * i, two, sizeof two);
    }
    body->flags = TAHR_BODY_TWO_SIDED;
    body->vertices = vertices;
    body->indices = indices;
    body->vertex_count = 2 * n;
    body->triangle_count = 2 * pieces;
}

static void read_chain(flat *f, bytes *b, uint32_t number)
{
    tahr_body_desc *body = &f->plane.bodies[f->plane.body_count++];
    double *corners = f->plane.vertices + (size_t)3 * CORNERS * number;
    uint32_t how = bytes_u8(b), n = 2 + how % (CORNERS - 1);
    tahr_body_desc_init(body, sizeof *body, TAHR_BODY_CHAIN);
    for (uint32_t i = 0; i < n; i++) {
        tahr_vec3 p = scene_point(&f->plane, b);
        corners[3 * i] = p.x;
        corners[3 * i + 1] = p.y;
        corners[3 * i + 2] = 0;
    }
    body->flags = TAHR_BODY_TWO_SIDED;
    if (how >= 128 && n > 2) body->flags |= TAHR_BODY_LOOP;
    body->vertices = corners;
    body->vertex_count = n;
    add_ribbon(&f->space, body, f->space.vertices + (size_t)6 * CORNERS * number,
               f->space.indices + (size_t)6 * CORNERS * number);
}

void flat_read(flat *f, bytes *b)
{
    memset(f, 0, sizeof *f);
    f->plane.scale = f->space.scale = 1;
    uint32_t how = bytes_u8(b), solids = bytes_below(b, SOLIDS + 1), chains = bytes_below(b, CHAINS + 1);
    if (how % 4) { /* most scenes have a floor */
        tahr_body_desc floor;
        tahr_body_desc_init(&floor, sizeof floor, TAHR_BODY_BOX);
        floor.half_extents = (tahr_vec3){8, 1, DEPTH};
        floor.pose.position.y = -1;
        add_both(f, &floor);
    }
    for (uint32_t i = 0; i < solids; i++)
        read_solid(f, b);
    for (uint32_t i = 0; i < chains; i++)
        read_chain(f, b, i);
}

tahr_sweep flat_sweep(const tahr_sweep *query)
{
    tahr_sweep q = *query;
    q.position = (tahr_vec3){q.position.x, q.position.z, 0};
    q.motion = (tahr_vec3){q.motion.x, q.motion.z, 0};
    q.up = (tahr_vec3){0, 1, 0};
    q.orientation = (tahr_quat){-H, 0, 0, H};
    return q;
}
