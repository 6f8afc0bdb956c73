/* SPDX-License-Identifier: MIT
 * frame.c: the local frame of a query and how bodies come into it. */
#include "scene.h"

#include <string.h>

tahr__frame tahr__frame_make(tahr_vec3 position, tahr_vec3 up)
{
    tahr__frame frame;
    /* + 0.0: never minus zero, so that the same cell is the same bits. */
    frame.origin =
        v_make(floor(position.x / TAHR__CELL) * TAHR__CELL + 0.0, floor(position.y / TAHR__CELL) * TAHR__CELL + 0.0,
               floor(position.z / TAHR__CELL) * TAHR__CELL + 0.0);
    frame.up = up;
    frame.turned = !(up.x == 0 && up.y == 0 && up.z == 1);
    /* Callers' axes are unit within 1e-9, which of a place 1e6 m away from its body's origin is a millimetre. */
    frame.turn = frame.turned ? m_upright(v_unit(up)) : m_identity();
    return frame;
}

int tahr__frame_holds(const tahr__frame *frame, tahr_vec3 position, tahr_vec3 up)
{
    const tahr_vec3 *o = &frame->origin;
    int x = (position.x >= o->x) & (position.x < o->x + TAHR__CELL),
        y = (position.y >= o->y) & (position.y < o->y + TAHR__CELL);
    return x & y & (position.z >= o->z) & (position.z < o->z + TAHR__CELL) & tahr__same_vec(&frame->up, &up);
}

tahr__map tahr__map_make(const tahr__frame *frame, const tahr__body *body)
{
    tahr__map map;
    map.offset = v_sub(body->position, frame->origin);
    map.turned = frame->turned || body->turned;
    if (frame->turned) {
        map.offset = m_apply(&frame->turn, map.offset);
        map.turn = body->turned ? m_mul(&frame->turn, &body->turn) : frame->turn;
    } else {
        map.turn = body->turn;
    }
    return map;
}

tahr__map tahr__map_fixed(const tahr__frame *frame)
{
    tahr__map map;
    map.offset = v_sub(v_make(0, 0, 0), frame->origin);
    map.turned = frame->turned;
    map.turn = frame->turn;
    if (frame->turned) map.offset = m_apply(&frame->turn, map.offset);
    return map;
}

/* Per vertex, so that triangles that share one still share it after rounding. */
tahr_vec3 tahr__map_point(const tahr__map *map, tahr_vec3 v)
{
    return v_add(map->offset, map->turned ? m_apply(&map->turn, v) : v);
}

void tahr__map_triangle(const tahr__map *map, const tahr__body *body, uint32_t triangle, tahr_vec3 v[3])
{
    const uint32_t *vertex = body->mesh.triangles[triangle].vertex;
    for (int i = 0; i < 3; i++)
        v[i] = tahr__map_point(map, body->mesh.vertices[vertex[i]]);
}

tahr_bounds tahr__frame_box_to_world(const tahr__frame *frame, const tahr_bounds *box, double grow)
{
    tahr_vec3 g = v_make(grow, grow, grow);
    tahr_bounds world = {v_sub(box->min, g), v_add(box->max, g)};
    if (frame->turned) {
        tahr_vec3 half = v_scale(v_sub(world.max, world.min), 0.5), middle = v_add(world.min, half);
        tahr__mat size = frame->turn;
        for (int i = 0; i < 3; i++)
            size.row[i] = v_abs(size.row[i]);
        half = m_unapply(&size, half);
        middle = m_unapply(&frame->turn, middle);
        world.min = v_sub(middle, half);
        world.max = v_add(middle, half);
    }
    world.min = v_add(world.min, frame->origin);
    world.max = v_add(world.max, frame->origin);
    return world;
}

tahr_bounds tahr__frame_box_to_local(const tahr__frame *frame, const tahr_bounds *box)
{
    tahr_bounds local = {v_sub(box->min, frame->origin), v_sub(box->max, frame->origin)};
    if (!frame->turned) return local;
    tahr_vec3 half = v_scale(v_sub(local.max, local.min), 0.5), middle = m_apply(&frame->turn, v_add(local.min, half));
    tahr__mat size = frame->turn;
    for (int i = 0; i < 3; i++)
        size.row[i] = v_abs(size.row[i]);
    half = m_apply(&size, half);
    local.min = v_sub(middle, half);
    local.max = v_add(middle, half);
    return local;
}

void tahr__prim_begin(const tahr__body *body, uint32_t id, tahr__prim *prim)
{
    prim->radius = 0;
    prim->body = id;
    prim->feature = 0;
    prim->kind = (body->flags & TAHR_BODY_TWO_SIDED ? TAHR__TWO_SIDED : 0u) |
                 (body->flags & TAHR_BODY_SENSOR ? TAHR__SENSOR : 0u) |
                 ((body->flags & (TAHR_BODY_ONE_WAY | TAHR_BODY_SENSOR)) == TAHR_BODY_ONE_WAY ? TAHR__ONE_WAY : 0u) |
                 (body->type == TAHR_BODY_BOX || body->type == TAHR_BODY_HULL ? TAHR__OF_BOX : 0u);
    prim->mask = body->mask;
    prim->surface = body->surface;
    prim->walkable_rule = body->walkable_rule;
    prim->walkable_angle = body->walkable_angle;
    memset(prim->reserved, 0, sizeof prim->reserved);
}

void tahr__prim_triangle(const tahr__map *map, const tahr__body *body, uint32_t triangle, tahr__prim *prim)
{
    const tahr__mesh *mesh = &body->mesh;
    const tahr__triangle *t = &mesh->triangles[triangle];
    for (int i = 0; i < 3; i++)
        prim->facet.v[i] = tahr__map_point(map, mesh->vertices[t->vertex[i]]);
    tahr__facet_finish(&prim->facet);
    tahr_vec3 normal = tahr__mesh_normal(mesh, triangle);
    prim->face = map->turned ? m_apply(&map->turn, normal) : normal;
    prim->item = triangle;
    prim->feature = tahr__triangle_source(t);
    prim->kind = (prim->kind & ~(uint32_t)TAHR__PLANELESS) | (t->source & TAHR__MESH_THIN ? TAHR__PLANELESS : 0u);
}

void tahr__prim_round(const tahr__map *map, const tahr__body *body, tahr__prim *prim)
{
    prim->facet.v[0] = tahr__map_point(map, v_make(0, 0, -body->reach));
    prim->facet.v[1] = prim->facet.v[2] = tahr__map_point(map, v_make(0, 0, body->reach));
    tahr__facet_finish(&prim->facet);
    prim->face = v_make(0, 0, 0);
    prim->radius = body->radius;
    prim->item = TAHR__ITEM_ROUND;
    prim->kind |= TAHR__PLANELESS;
}

void tahr__prim_heights(const tahr__map *map, const tahr__body *body, uint32_t triangle, const tahr_vec3 v[3],
                        tahr__prim *prim)
{
    uint32_t thin = body->heights.may_be_thin && tahr__slimness(v[0], v[1], v[2]) < TAHR__THIN;
    for (int i = 0; i < 3; i++)
        prim->facet.v[i] = tahr__map_point(map, v[i]);
    tahr__facet_finish(&prim->facet);
    prim->face = v_make(0, 0, 0);
    prim->item = prim->feature = triangle;
    prim->kind = (prim->kind & ~(uint32_t)TAHR__PLANELESS) | TAHR__FACELESS | (thin ? TAHR__PLANELESS : 0u);
}

void tahr__prim_solid(const tahr__map *map, const tahr__body *body, tahr__prim *prim)
{
    tahr_vec3 middle = map->offset;
    if (body->type == TAHR_BODY_HULL) {
        middle = tahr__map_point(map, v_scale(v_add(body->mesh.bounds.min, body->mesh.bounds.max), 0.5));
    }
    prim->facet.v[0] = prim->facet.v[1] = prim->facet.v[2] = middle;
    tahr__facet_finish(&prim->facet);
    prim->face = v_make(0, 0, 0);
    prim->item = TAHR__ITEM_SOLID;
    prim->kind |= TAHR__PLANELESS;
}

tahr_bounds tahr__prim_bounds(const tahr__query *query, const tahr__prim *prim)
{
    const tahr_vec3 *v = prim->facet.v;
    tahr_bounds b = {v_min(v[0], v_min(v[1], v[2])), v_max(v[0], v_max(v[1], v[2]))};
    if (!(prim->item & (TAHR__ITEM_SOLID | TAHR__ITEM_ROUND))) return b;
    tahr_vec3 grow = v_make(prim->radius, prim->radius, prim->radius);
    if (prim->item & TAHR__ITEM_SOLID) {
        const tahr__body *body = &query->world->bodies[prim->body];
        tahr__map map = tahr__map_make(query->frame, body);
        tahr_vec3 half = body->half_extents;
        if (map.turned) {
            half = v_make(v_dot(v_abs(map.turn.row[0]), body->half_extents),
                          v_dot(v_abs(map.turn.row[1]), body->half_extents),
                          v_dot(v_abs(map.turn.row[2]), body->half_extents));
        }
        grow = v_add(half, v_make(TAHR__SLACK, TAHR__SLACK, TAHR__SLACK));
    }
    b.min = v_sub(b.min, grow);
    b.max = v_add(b.max, grow);
    return b;
}
