/* SPDX-License-Identifier: MIT
 * scene.c: reading and checking the description of bodies. */
#include "scene.h"

#include <stdio.h>
#include <string.h>

#include "backend_check.h"
#include "message.h"
#include "sized.h"
#include "vec.h"

static const double FARTHEST = 1e7; /* m: double still resolves 2e-9 m there */

const char *tahr__bad_pose(const tahr_pose *pose, int zero_is_identity)
{
    tahr_quat q = pose->orientation;
    double q2 = (q.x * q.x + q.y * q.y) + (q.z * q.z + q.w * q.w);
    if (!vec_is_finite(pose->position) || length(pose->position) > FARTHEST) {
        return "pose.position";
    }
    return (zero_is_identity && q2 == 0) || (q2 > 1 - 1e-6 && q2 < 1 + 1e-6) ? NULL : "pose.orientation";
}

static int is_size(double x)
{
    return x >= 1e-6 && x <= 1e6;
}

static const char *bad_count(uint32_t count, uint32_t least, uint32_t most, const char *name)
{
    return count >= least && count <= most ? NULL : name;
}

static const char *bad_field(const tahr_body_desc *b)
{
    const char *bad = bad_count(b->columns, 2, 65536, "columns");
    if (!b->heights) {
        return "heights";
    }
    bad = bad ? bad : bad_count(b->rows, 2, 65536, "rows");
    bad = bad || is_size(b->half_extents.x) ? bad : "half_extents.x";
    bad = bad || is_size(b->half_extents.y) ? bad : "half_extents.y";
    for (size_t i = 0; !bad && i < (size_t)b->columns * b->rows; i++) {
        bad = fabs(b->heights[i]) > FARTHEST ? "heights" : NULL; /* of a hole, NaN, it is not */
    }
    return bad;
}

static const char *bad_size(const tahr_body_desc *b)
{
    const vec3 half = b->half_extents;
    switch (b->type) {
    case TAHR_BODY_MESH: return !b->vertices ? "vertices" : (!b->indices ? "indices" : NULL);
    case TAHR_BODY_BOX:
    case TAHR_BODY_ELLIPSOID:
        if (!is_size(half.x)) {
            return "half_extents.x";
        }
        return !is_size(half.y) ? "half_extents.y" : (!is_size(half.z) ? "half_extents.z" : NULL);
    case TAHR_BODY_SPHERE: return is_size(b->radius) ? NULL : "radius";
    case TAHR_BODY_CAPSULE:
    case TAHR_BODY_CYLINDER:
    case TAHR_BODY_CONE:
        if (!is_size(b->radius)) {
            return "radius";
        }
        return is_size(b->half_height) && (b->type != TAHR_BODY_CAPSULE || b->half_height >= b->radius) ? NULL
                                                                                                        : "half_height";
    case TAHR_BODY_HULL: return !b->vertices ? "vertices" : bad_count(b->vertex_count, 4, 256, "vertex_count");
    case TAHR_BODY_CHAIN: return !b->vertices ? "vertices" : bad_count(b->vertex_count, 2, 1u << 24, "vertex_count");
    case TAHR_BODY_HEIGHTS: return bad_field(b);
    default: return "type";
    }
}

/* Fluids are the solids whose immersion has a closed form. */
static int bad_flags(const tahr_body_desc *b)
{
    const uint32_t flags = (TAHR_BODY_TEMPLATE << 1) - 1;
    int can_be_fluid = b->type == TAHR_BODY_BOX || b->type == TAHR_BODY_SPHERE || b->type == TAHR_BODY_CAPSULE;
    return (b->flags & ~flags) != 0 || ((b->flags & TAHR_BODY_FLUID) && !can_be_fluid) ||
           ((b->flags & TAHR_BODY_LOOP) && b->type != TAHR_BODY_CHAIN) ||
           ((b->flags & TAHR_BODY_TEMPLATE) && b->type != TAHR_BODY_HULL) ||
           ((b->flags & TAHR_BODY_ONE_WAY) && (b->flags & TAHR_BODY_SENSOR));
}

static const char *what_is_wrong(const char *field)
{
    return strcmp(field, "flags") == 0 ? "has a bit that is unknown or does not go with the type or another bit"
                                       : "is missing, out of range or not finite";
}

static const char *bad_body(const tahr_body_desc *b)
{
    const char *pose = tahr__bad_pose(&b->pose, 1);
    if (pose) {
        return pose;
    }
    if (bad_flags(b)) {
        return "flags";
    }
    if (!(length_squared(b->surface_velocity) <= 1e8)) {
        return "surface_velocity";
    }
    if (!(b->mass >= 0 && b->mass <= 1e12)) {
        return "mass";
    }
    if (!(b->fluid_friction >= 0 && b->fluid_friction <= 1e4)) {
        return "fluid_friction";
    }
    if (b->walkable_rule > TAHR_WALKABLE_NEVER) {
        return "walkable_rule";
    }
    return is_finite(b->walkable_angle) ? bad_size(b) : "walkable_angle";
}

static tahr_status check_body(const tahr_log *log, const tahr_body_desc *b, uint32_t i)
{
    char name[64];
    const char *bad = bad_body(b);
    if (bad) {
        snprintf(name, sizeof name, "bodies[%u].%s", i, bad);
        return tahr__complain(log, TAHR_E_ARGUMENT, "tahr_world_open", name, what_is_wrong(bad));
    }
    if (b->type == TAHR_BODY_MESH && b->triangle_count == 0) {
        snprintf(name, sizeof name, "bodies[%u]", i);
        return tahr__complain(log, TAHR_E_GEOMETRY, "tahr_world_open", name, "is a mesh without triangles");
    }
    return TAHR_OK;
}

static tahr_status check_size(const tahr_log *log, const void *body, uint32_t stride, uint32_t i)
{
    char name[64];
    uint32_t size;
    memcpy(&size, body, sizeof size);
    tahr_status status = size == stride ? tahr__sized_check(body, sizeof(tahr_body_desc)) : TAHR_E_STRUCT_SIZE;
    if (status < 0) {
        snprintf(name, sizeof name, "bodies[%u]:", i);
        return tahr__complain(log, status, "tahr_world_open", name, tahr_status_message(status));
    }
    return TAHR_OK;
}

static int holds_fluid(const tahr_world_desc *scene, uint32_t stride)
{
    for (uint32_t i = 0; i < scene->body_count; i++) {
        uint32_t flags;
        memcpy(&flags, (const char *)scene->bodies + (size_t)i * stride + offsetof(tahr_body_desc, flags),
               sizeof flags);
        if (flags & TAHR_BODY_FLUID) {
            return 1;
        }
    }
    return 0;
}

tahr_status tahr__bodies_read(const tahr_host *host, const tahr_log *log, tahr_world_desc *scene, tahr_body_desc **own)
{
    tahr_status status = TAHR_OK;
    uint32_t stride = sizeof(tahr_body_desc);
    if (scene->body_count > 0 && !scene->bodies) {
        return tahr__complain(log, TAHR_E_NULL, "tahr_world_open", "desc.bodies", "is NULL, but body_count is not 0");
    }
    if (scene->body_count > 0) {
        stride = scene->bodies[0].struct_size;
    }
    for (uint32_t i = 0; i < scene->body_count && status >= 0; i++) {
        status = check_size(log, (const char *)scene->bodies + (size_t)i * stride, stride, i);
    }
    if (status >= 0 && (stride != sizeof(tahr_body_desc) || holds_fluid(scene, stride))) {
        *own = host->allocator.alloc(host->allocator.user, scene->body_count * sizeof(tahr_body_desc), 8);
        if (!*own) {
            return tahr__complain(log, TAHR_E_MEMORY, "tahr_world_open", "allocator", "returned NULL");
        }
        for (uint32_t i = 0; i < scene->body_count; i++) {
            memcpy(*own + i, (const char *)scene->bodies + (size_t)i * stride, sizeof(tahr_body_desc));
            (*own)[i].struct_size = sizeof(tahr_body_desc);
            (*own)[i].flags |= (*own)[i].flags & TAHR_BODY_FLUID ? (uint32_t)TAHR_BODY_SENSOR : 0u;
        }
        scene->bodies = *own;
    }
    for (uint32_t i = 0; i < scene->body_count && status >= 0; i++) {
        status = check_body(log, &scene->bodies[i], i);
    }
    return status;
}

/* What a backend must be able to do to hold a body. */
static uint32_t needed_by(const tahr_body_desc *b)
{
    static const uint32_t kinds[] = {0,
                                     TAHR_CAP_MESH,
                                     TAHR_CAP_SOLIDS,
                                     TAHR_CAP_SOLIDS,
                                     TAHR_CAP_SOLIDS,
                                     TAHR_CAP_ROUND_SOLIDS,
                                     TAHR_CAP_ROUND_SOLIDS,
                                     TAHR_CAP_ROUND_SOLIDS,
                                     TAHR_CAP_HULLS,
                                     TAHR_CAP_HEIGHTS,
                                     TAHR_CAP_CHAINS};
    uint32_t kind = b->flags & TAHR_BODY_TEMPLATE ? (uint32_t)TAHR_CAP_HULL : kinds[b->type];
    return kind | (b->flags & TAHR_BODY_ONE_WAY ? (uint32_t)TAHR_CAP_ONE_WAY : 0u) |
           (b->flags & TAHR_BODY_SENSOR ? (uint32_t)TAHR_CAP_SENSORS : 0u);
}

/* What of a body needs these capabilities. */
static const char *what_needs(const tahr_body_desc *b, uint32_t lacking)
{
    static const char *const types[] = {"?",
                                        "TAHR_BODY_MESH",
                                        "TAHR_BODY_BOX",
                                        "TAHR_BODY_SPHERE",
                                        "TAHR_BODY_CAPSULE",
                                        "TAHR_BODY_CYLINDER",
                                        "TAHR_BODY_CONE",
                                        "TAHR_BODY_ELLIPSOID",
                                        "TAHR_BODY_HULL",
                                        "TAHR_BODY_HEIGHTS",
                                        "TAHR_BODY_CHAIN"};
    if (lacking & TAHR_CAP_ONE_WAY) {
        return "TAHR_BODY_ONE_WAY";
    }
    if (lacking & TAHR_CAP_SENSORS) {
        return b->flags & TAHR_BODY_FLUID ? "TAHR_BODY_FLUID" : "TAHR_BODY_SENSOR";
    }
    return b->flags & TAHR_BODY_TEMPLATE ? "TAHR_BODY_TEMPLATE" : types[b->type];
}

tahr_status tahr__bodies_fit(const tahr_backend *backend, const tahr_log *log, const tahr_world_desc *scene)
{
    for (uint32_t i = 0; i < scene->body_count; i++) {
        uint32_t lacking = needed_by(&scene->bodies[i]) & ~backend->capabilities;
        if (lacking) {
            char name[64], text[160];
            const char *what = what_needs(&scene->bodies[i], lacking);
            snprintf(name, sizeof name, "bodies[%u]", i);
            snprintf(text, sizeof text, "is %s, which backend %.40s does not hold: it lacks %s", what, backend->name,
                     tahr__capability_name(lacking));
            return tahr__complain(log, TAHR_E_UNSUPPORTED, "tahr_world_open", name, text);
        }
    }
    return TAHR_OK;
}

void tahr__bodies_free(const tahr_host *host, tahr_body_desc *own, uint32_t count)
{
    if (own) {
        host->allocator.free(host->allocator.user, own, count * sizeof *own, 8);
    }
}
