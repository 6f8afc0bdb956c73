/* SPDX-License-Identifier: MIT
 * body.c: a described body in the plane: its corners in double, as they were given. */
#include "scene.h"

#include "../common/room.h"

#include <stdio.h>

/* A pose this far out of the plane (sine of the angle) is meant to be out of it. */
#define OUT_OF_PLANE 1e-6

void tahr__b2_log(const tahr_host *host, uint32_t body, const char *text)
{
    char line[128];

    snprintf(line, sizeof line, "bodies[%u].%s", body, text);
    host->log.write(host->log.user, TAHR_LOG_ERROR, line);
}

static tahr__vec2 turned(const tahr__b2_body *b, tahr__vec2 v)
{
    return f_make(b->turn.x * v.x - b->turn.y * v.y, b->turn.y * v.x + b->turn.x * v.y);
}

/* Left turn of a, b, c: positive. */
static double turn_of(tahr__vec2 a, tahr__vec2 b, tahr__vec2 c)
{
    tahr__vec2 u = f_sub(b, a), w = f_sub(c, b);
    return u.x * w.y - u.y * w.x;
}

static int is_before(tahr__vec2 a, tahr__vec2 b)
{
    return a.x != b.x ? a.x < b.x : a.y < b.y;
}

/* Andrew's chain: the lower and the upper side of the sorted corners. in has room for all, out for one more. */
static uint32_t convex_ring(tahr__vec2 *in, uint32_t count, tahr__vec2 *out)
{
    uint32_t n = 0;

    for (uint32_t i = 1; i < count; i++) {
        tahr__vec2 v = in[i];
        uint32_t at = i;
        for (; at > 0 && is_before(v, in[at - 1]); at--)
            in[at] = in[at - 1];
        in[at] = v;
    }
    for (int side = 0; side < 2; side++) {
        uint32_t base = n;
        for (uint32_t k = 0; k < count; k++) {
            tahr__vec2 v = side == 0 ? in[k] : in[count - 1 - k];
            while (n >= base + 2 && turn_of(out[n - 2], out[n - 1], v) <= 0)
                n--;
            out[n++] = v;
        }
        n--; /* the end of this side begins the other */
    }
    return n;
}

static tahr_status open_hull(const tahr_host *host, const tahr_body_desc *d, uint32_t id, tahr__b2_body *b)
{
    tahr__vec2 in[TAHR__FLAT_CORNERS], out[2 * TAHR__FLAT_CORNERS + 2];
    double area = 0, size = 0;
    uint32_t n;

    if (d->vertex_count > TAHR__FLAT_CORNERS) return TAHR_E_ARGUMENT;
    for (uint32_t i = 0; i < d->vertex_count; i++) {
        in[i] = f_make(d->vertices[3 * i], d->vertices[3 * i + 1]);
        if (in[i].x * 0 + in[i].y * 0 != 0) {
            tahr__b2_log(host, id, "vertices: not finite");
            return TAHR_E_GEOMETRY;
        }
    }
    n = convex_ring(in, d->vertex_count, out);
    for (uint32_t i = 1; i + 1 < n; i++)
        area += turn_of(out[0], out[i], out[i + 1]);
    for (uint32_t i = 0; i < n; i++)
        size = d_max(size, f_length(f_sub(out[i], out[0])));
    if (n < 3 || !(area > 1e-10 * size * size)) {
        tahr__b2_log(host, id, "vertices: seen along z their hull has no area");
        return TAHR_E_GEOMETRY;
    }
    for (uint32_t i = 0; i < n; i++)
        b->vertices[i] = out[i];
    b->vertex_count = n;
    return TAHR_OK;
}

/* Corners that repeat the one before are none. */
static tahr_status open_chain(const tahr_host *host, const tahr_body_desc *d, uint32_t id, tahr__b2_body *b)
{
    uint32_t n = 0;

    for (uint32_t i = 0; i < d->vertex_count; i++) {
        tahr__vec2 v = f_make(d->vertices[3 * (size_t)i], d->vertices[3 * (size_t)i + 1]);
        if (!(fabs(v.x) <= 1e7 && fabs(v.y) <= 1e7)) {
            tahr__b2_log(host, id, "vertices: not finite, or beyond 1e7 m");
            return TAHR_E_GEOMETRY;
        }
        if (n > 0 && f_length(f_sub(v, b->vertices[n - 1])) <= 1e-9) continue;
        b->vertices[n++] = v;
    }
    if (d->flags & TAHR_BODY_LOOP && n > 1 && f_length(f_sub(b->vertices[0], b->vertices[n - 1])) <= 1e-9) n--;
    if (n < 2 || (d->flags & TAHR_BODY_LOOP && n < 3)) {
        tahr__b2_log(host, id, "vertices: a chain needs two that differ, a loop three");
        return TAHR_E_GEOMETRY;
    }
    b->vertex_count = n;
    return TAHR_OK;
}

static uint32_t capacity_of(const tahr_body_desc *d)
{
    if (d->type == TAHR_BODY_HULL || d->type == TAHR_BODY_CHAIN) return d->vertex_count > 0 ? d->vertex_count : 1;
    return d->type == TAHR_BODY_BOX ? 4 : d->type == TAHR_BODY_CAPSULE ? 2 : 1;
}

static tahr_status open_corners(const tahr_host *host, const tahr_body_desc *d, uint32_t id, tahr__b2_body *b)
{
    tahr_vec3 h = d->half_extents;

    switch (d->type) {
    case TAHR_BODY_HULL: return open_hull(host, d, id, b);
    case TAHR_BODY_CHAIN: return open_chain(host, d, id, b);
    case TAHR_BODY_BOX:
        for (int i = 0; i < 4; i++)
            b->vertices[i] = f_make(i == 1 || i == 2 ? h.x : -h.x, i < 2 ? -h.y : h.y);
        b->vertex_count = 4;
        return TAHR_OK;
    case TAHR_BODY_CAPSULE:
        b->vertices[0] = f_make(0, -(d->half_height - d->radius));
        b->vertices[1] = f_make(0, d->half_height - d->radius);
        b->vertex_count = d->half_height > d->radius ? 2 : 1;
        return TAHR_OK;
    case TAHR_BODY_SPHERE:
        b->vertices[0] = f_make(0, 0);
        b->vertex_count = 1;
        return TAHR_OK;
    default: tahr__b2_log(host, id, "type: no body of a plane"); return TAHR_E_UNSUPPORTED;
    }
}

tahr_status tahr__b2_body_open(const tahr_host *host, const tahr_body_desc *d, uint32_t id, tahr__b2_body *b)
{
    const char *problem;
    tahr_status status;

    *b = (tahr__b2_body){.type = d->type, .radius = d->type == TAHR_BODY_BOX ? 0 : d->radius};
    b->owner = tahr__surface_of(d, id);
    b->vertex_capacity = capacity_of(d);
    b->vertices = tahr__room_get(host, b->vertex_capacity, sizeof *b->vertices);
    if (!b->vertices) return TAHR_E_MEMORY;
    status = open_corners(host, d, id, b);
    problem = status < 0 ? NULL : tahr__b2_body_place(b, &d->pose);
    if (problem) {
        tahr__b2_log(host, id, problem);
        status = TAHR_E_UNSUPPORTED;
    }
    if (status < 0) tahr__b2_body_close(host, b);
    return status;
}

void tahr__b2_body_close(const tahr_host *host, tahr__b2_body *b)
{
    tahr__room_put(host, b->vertices, b->vertex_capacity, sizeof *b->vertices);
    b->vertices = NULL;
}

const char *tahr__b2_body_turn(uint32_t type, int is_point, tahr_quat orientation, tahr__vec2 *turn)
{
    tahr__mat m = m_from_quat(orientation);
    tahr_vec3 z = v_make(m.row[0].z, m.row[1].z, m.row[2].z);
    tahr__vec2 x = f_make(m.row[0].x, m.row[1].x);

    if (type == TAHR_BODY_SPHERE || (type == TAHR_BODY_CAPSULE && is_point)) {
        *turn = f_make(1, 0);
        return NULL;
    }
    if (type == TAHR_BODY_CAPSULE) { /* its axis, local z, is what has to lie in the plane; it is y of its corners */
        if (!(fabs(z.z) <= OUT_OF_PLANE)) return "pose.orientation: the axis of a capsule must lie in the plane";
        z = v_unit(v_make(z.x, z.y, 0));
        *turn = f_make(z.y, -z.x);
        return NULL;
    }
    if (!(z.z >= 1 - 0.5 * OUT_OF_PLANE * OUT_OF_PLANE)) return "pose.orientation: only turns about z are in the plane";
    *turn = z.z == 1 ? x : f_unit(x);
    return NULL;
}

const char *tahr__b2_body_place(tahr__b2_body *b, const tahr_pose *pose)
{
    const char *problem = tahr__b2_body_turn(b->type, b->vertex_count == 1, pose->orientation, &b->turn);

    if (!problem) b->position = pose->position;
    return problem;
}

uint32_t tahr__b2_body_items(const tahr__b2_body *b)
{
    if (b->type != TAHR_BODY_CHAIN) return 1;
    return b->vertex_count - (b->owner.flags & TAHR_BODY_LOOP ? 0 : 1);
}

void tahr__b2_body_piece(const tahr__b2_body *b, uint32_t segment, tahr__vec2 origin, tahr__b2_piece *piece)
{
    tahr__vec2 at = f_sub(f_make(b->position.x, b->position.y), origin);
    uint32_t count = b->type == TAHR_BODY_CHAIN ? 2 : b->vertex_count;

    piece->owner = b->owner;
    piece->feature = b->type == TAHR_BODY_CHAIN ? segment : 0;
    piece->is_box = b->type == TAHR_BODY_BOX;
    piece->ghosts = TAHR__B2_NO_GHOST;
    piece->flat.count = (int)count;
    piece->flat.one_sided = b->type == TAHR_BODY_CHAIN && !(b->owner.flags & TAHR_BODY_TWO_SIDED);
    piece->flat.lone = b->type != TAHR_BODY_CHAIN || b->vertex_count == 2;
    piece->flat.radius = b->radius;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t k = segment + i;
        piece->flat.corner[i] = f_add(at, turned(b, b->vertices[k < b->vertex_count ? k : k - b->vertex_count]));
    }
}
