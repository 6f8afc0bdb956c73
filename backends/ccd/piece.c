/* SPDX-License-Identifier: MIT
 * piece.c: the convex pieces that bodies are made of, around the start of a query and in its unit. */
#include "scene.h"

static tahr_vec3 to_start(const tahr__ccd_probe *probe, const tahr__ccd_body *body, tahr_vec3 local)
{
    return v_scale(v_add(v_sub(body->position, probe->origin), m_apply(&body->turn, local)), probe->unit);
}

void tahr__ccd_triangle(const tahr__ccd_probe *probe, const tahr__ccd_body *body, uint32_t triangle,
                        tahr__ccd_piece *piece)
{
    const tahr__triangle *t = &body->mesh.triangles[triangle];

    piece->body = body;
    piece->corner_count = 3;
    piece->triangle = triangle;
    piece->radius = 0;
    for (int i = 0; i < 3; i++)
        piece->corner[i] = to_start(probe, body, body->mesh.vertices[t->vertex[i]]);
}

void tahr__ccd_whole_body(const tahr__ccd_probe *probe, const tahr__ccd_body *body, tahr__ccd_piece *piece)
{
    tahr_vec3 h = body->half_extents;
    int round = body->type == TAHR_BODY_SPHERE || body->type == TAHR_BODY_CAPSULE;

    piece->body = body;
    piece->triangle = 0;
    piece->radius = round ? body->radius * probe->unit : 0;
    piece->corner_count = body->type == TAHR_BODY_BOX ? 8 : round ? 3 : 1;
    for (int i = 0; i < piece->corner_count; i++) {
        tahr_vec3 p = v_make(i & 1 ? h.x : -h.x, i & 2 ? h.y : -h.y, i & 4 ? h.z : -h.z);
        /* Round bodies are triangles that shrank to a segment or a point; of the others the centre is enough. */
        if (round) p = v_make(0, 0, i == 0 ? -body->reach : body->reach);
        if (piece->corner_count == 1) p = v_make(0, 0, 0);
        piece->corner[i] = to_start(probe, body, p);
    }
}

static tahr_vec3 half_axis(const tahr__ccd_probe *probe, const tahr__ccd_body *body, tahr_vec3 local)
{
    return v_scale(m_apply(&body->turn, local), probe->unit);
}

void tahr__ccd_convex(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, tahr__convex *c)
{
    const tahr__ccd_body *b = piece->body;
    const tahr_vec3 *corner = piece->corner;
    tahr_vec3 h = b->half_extents;

    *c = (tahr__convex){.centre = corner[0], .scale = 1};
    switch (b->type) {
    case TAHR_BODY_BOX:
        c->centre = v_scale(v_add(corner[0], corner[7]), 0.5);
        c->count = 3;
        for (int i = 0; i < 3; i++)
            c->axis[i] = v_scale(v_sub(corner[1 << i], corner[0]), 0.5);
        break;
    case TAHR_BODY_CAPSULE:
        c->centre = v_scale(v_add(corner[0], corner[1]), 0.5);
        c->count = b->reach > 0;
        c->axis[0] = v_scale(v_sub(corner[1], corner[0]), 0.5);
        break;
    case TAHR_BODY_CYLINDER:
    case TAHR_BODY_CONE:
        c->kind = b->type == TAHR_BODY_CONE ? TAHR__CONVEX_CONE : TAHR__CONVEX_CYLINDER;
        c->axis[0] = half_axis(probe, b, v_make(0, 0, b->reach));
        c->radius = b->radius * probe->unit;
        break;
    case TAHR_BODY_ELLIPSOID:
        c->kind = TAHR__CONVEX_ELLIPSOID;
        c->axis[0] = half_axis(probe, b, v_make(h.x, 0, 0));
        c->axis[1] = half_axis(probe, b, v_make(0, h.y, 0));
        c->axis[2] = half_axis(probe, b, v_make(0, 0, h.z));
        break;
    case TAHR_BODY_HULL:
        c->kind = TAHR__CONVEX_POINTS;
        c->points = b->hull.vertices;
        c->count = b->hull.count;
        c->turn = &b->turn;
        c->scale = probe->unit;
        break;
    case TAHR_BODY_MESH:
        c->kind = TAHR__CONVEX_POINTS;
        c->centre = v_make(0, 0, 0);
        c->points = corner;
        c->count = 3;
        break;
    default: break; /* a sphere: its centre */
    }
}

/* One without neighbours may be left past its edges. */
uint32_t tahr__ccd_ways_out(const tahr__ccd_piece *piece)
{
    const tahr__triangle *t = &piece->body->mesh.triangles[piece->triangle];
    int alone = t->ring[0] == piece->triangle && t->ring[1] == piece->triangle && t->ring[2] == piece->triangle;

    if (!(piece->body->surface.flags & TAHR_BODY_TWO_SIDED)) return 1;
    return alone ? 7 : 3;
}

void tahr__ccd_side(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, tahr__convex_side *side)
{
    tahr__ccd_convex(probe, piece, &side->convex);
    side->radius = piece->radius;
    side->planes = piece->body->type == TAHR_BODY_HULL ? &piece->body->hull.planes : NULL;
    side->ways_out = piece->body->type == TAHR_BODY_MESH ? tahr__ccd_ways_out(piece) : 0;
    side->reserved = 0;
}
