/* SPDX-License-Identifier: MIT
 * hull.c: taking in the hull of a body. */
#include "hull.h"

#include "mesh.h"
#include "room.h"

tahr_status tahr__hull_open(const tahr_host *host, const tahr_body_desc *d, uint32_t id, tahr__hull *hull)
{
    const char *reason;

    memset(hull, 0, sizeof *hull);
    if (d->vertex_count < 4 || d->vertex_count > TAHR__HULL_VERTICES || !d->vertices) {
        tahr__log_body(host, id, "vertex_count: a hull has 4 to 256 vertices");
        return TAHR_E_GEOMETRY;
    }
    hull->vertices = tahr__room_get(host, d->vertex_count, sizeof *hull->vertices);
    if (!hull->vertices) return TAHR_E_MEMORY;
    hull->count = d->vertex_count;
    for (uint32_t i = 0; i < hull->count; i++)
        hull->vertices[i] = v_make(d->vertices[3 * i], d->vertices[3 * i + 1], d->vertices[3 * i + 2]);
    tahr_status status = tahr__hull_planes_build(host, hull->vertices, hull->count, &hull->planes, &reason);
    if (status == TAHR_E_GEOMETRY) tahr__log_body(host, id, reason);
    if (status < 0) return status;
    tahr_vec3 low = hull->vertices[0], high = hull->vertices[0];
    for (uint32_t i = 1; i < hull->count; i++) {
        low = v_min(low, hull->vertices[i]);
        high = v_max(high, hull->vertices[i]);
    }
    hull->middle = v_scale(v_add(low, high), 0.5);
    hull->half = v_scale(v_sub(high, low), 0.5);
    return TAHR_OK;
}

void tahr__hull_close(const tahr_host *host, tahr__hull *hull)
{
    tahr__room_put(host, hull->vertices, hull->count, sizeof *hull->vertices);
    tahr__hull_planes_free(host, &hull->planes);
    memset(hull, 0, sizeof *hull);
}
