/* SPDX-License-Identifier: MIT
 * selftest_scene.c: the scenes and shapes of the conformance kit. */
#include <string.h>

#include "selftest.h"
#include "world_memory.h"

/* m: how far scenes reach along the third axis, and how thick planes are. */
static const double DEPTH = 20, THICK = 8;
static const double HALF_SQRT2 = 0.70710678118654752440;

/* Half axes of the shapes: a person of 1.8 m; what is not round is as wide as it is not deep. */
static const double RADIUS = 0.35, HALF_HEIGHT = 0.9, HALF_X = 0.35, HALF_Y = 0.25;

static const struct {
    uint32_t capability, type;
    const char *name;
} shapes[] = {{TAHR_CAP_CAPSULE, TAHR_SHAPE_CAPSULE, "capsule"},
              {TAHR_CAP_SPHERE, TAHR_SHAPE_SPHERE, "sphere"},
              {TAHR_CAP_BOX, TAHR_SHAPE_BOX, "box"},
              {TAHR_CAP_CYLINDER, TAHR_SHAPE_CYLINDER, "cylinder"},
              {TAHR_CAP_CONE, TAHR_SHAPE_CONE, "cone"},
              {TAHR_CAP_ELLIPSOID, TAHR_SHAPE_ELLIPSOID, "ellipsoid"},
              {TAHR_CAP_HULL, TAHR_SHAPE_HULL, "hull"}};
enum { SHAPES = sizeof shapes / sizeof shapes[0] };

void tahr__lab_clear(tahr__lab *lab)
{
    if (lab->world && lab->desc->open && lab->desc->close) {
        lab->desc->close(lab->desc->user, lab->world);
    } else {
        tahr_world_close(lab->world);
    }
    if (lab->cache) {
        tahr__malloc.free(NULL, lab->cache, lab->cache_size, 64);
    }
    lab->world = NULL;
    lab->cache = NULL;
    memset(&lab->context, 0, sizeof lab->context);
    lab->body_count = lab->vertex_count = lab->index_count = 0;
    lab->scale = 1;
    lab->origin = vec(0, 0, 0);
    lab->margin = 0.01;
}

static void hear(void *user, int32_t level, const char *message)
{
    tahr__lab *lab = user;
    size_t size = strlen(message);
    size = size < sizeof lab->message ? size : sizeof lab->message - 1;
    memcpy(lab->message, message, size);
    lab->message[size] = 0;
    if (lab->desc->log && lab->desc->log->write) {
        lab->desc->log->write(lab->desc->log->user, level, message);
    }
}

/* The six corners that a hull is swept with. */
static void add_template(tahr__lab *lab)
{
    tahr_body_desc *body = tahr__lab_body(lab, TAHR_BODY_HULL);
    body->flags = TAHR_BODY_TEMPLATE;
    lab->shape.hull = lab->body_count - 1;
    for (int i = 0; i < 6; i++) {
        double side = i % 2 ? 1 : -1;
        tahr__lab_corner(lab, body, i / 2 == 0 ? side * HALF_X : 0, i / 2 == 1 ? side * HALF_Y : 0,
                         i / 2 == 2 ? side * HALF_HEIGHT : 0);
    }
}

int tahr__lab_open(tahr__lab *lab)
{
    tahr_log log = {lab, hear};
    tahr_world_desc desc;
    if (lab->shape.type == TAHR_SHAPE_HULL) {
        add_template(lab);
    }
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = lab->bodies;
    desc.body_count = lab->body_count;
    desc.options = lab->desc->options;
    desc.log = &log;
    lab->message[0] = 0;
    tahr_status status = lab->desc->open ? lab->desc->open(lab->desc->user, &desc, &lab->world)
                                         : tahr_world_open(lab->backend, &desc, &lab->world);
    if (!tahr__lab_check(lab, status >= 0 && lab->world, "the world opens", "%s: %s", tahr_status_name(status),
                         lab->message)) {
        return 0;
    }
    const tahr_backend *backend = lab->world->backend;
    size_t size = backend->cache_size ? (backend->cache_size(lab->world->self) + 63) / 64 * 64 : 0;
    if (size > 0) {
        lab->cache = tahr__malloc.alloc(NULL, size, 64);
        lab->cache_size = size;
        if (!tahr__lab_check(lab, lab->cache != NULL, "memory for the cache", "%lu bytes are not there",
                             (unsigned long)size)) {
            return 0;
        }
        memset(lab->cache, 0, size);
    }
    return 1;
}

vec3 tahr__lab_toward(const tahr__lab *lab, double u, double v)
{
    return lab->planar ? vec(u, v, 0) : vec(u, 0, v);
}

vec3 tahr__lab_along(const tahr__lab *lab, double u, double v)
{
    return scale(tahr__lab_toward(lab, u, v), lab->scale);
}

vec3 tahr__lab_at(const tahr__lab *lab, double u, double v)
{
    return add(lab->origin, tahr__lab_along(lab, u, v));
}

vec3 tahr__lab_up(const tahr__lab *lab)
{
    return tahr__lab_toward(lab, 0, 1);
}

tahr_quat tahr__lab_upright(const tahr__lab *lab)
{
    tahr_quat to_y = {-HALF_SQRT2, 0, 0, HALF_SQRT2}, as_it_is = {0, 0, 0, 1};
    return lab->planar ? to_y : as_it_is;
}

tahr_body_desc *tahr__lab_body(tahr__lab *lab, uint32_t type)
{
    tahr_body_desc *body = &lab->bodies[lab->body_count++];
    tahr_body_desc_init(body, sizeof *body, type);
    body->vertices = type == TAHR_BODY_MESH || type == TAHR_BODY_HULL || type == TAHR_BODY_CHAIN
                         ? lab->vertices + 3 * lab->vertex_count
                         : NULL;
    body->indices = type == TAHR_BODY_MESH ? lab->indices + lab->index_count : NULL;
    body->pose.position = lab->origin;
    return body;
}

void tahr__lab_corner(tahr__lab *lab, tahr_body_desc *body, double x, double y, double z)
{
    double *to = lab->vertices + 3 * lab->vertex_count++;
    to[0] = x * lab->scale;
    to[1] = y * lab->scale;
    to[2] = z * lab->scale;
    body->vertex_count++;
}

void tahr__lab_triangle(tahr__lab *lab, tahr_body_desc *mesh, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t *to = lab->indices + lab->index_count;
    to[0] = a;
    to[1] = b;
    to[2] = c;
    lab->index_count += 3;
    mesh->triangle_count++;
}

/* Eight corners, twelve triangles, outward. Bit i of a corner's number says which end of axis i it is at. */
static tahr_body_desc *mesh_block(tahr__lab *lab, vec3 low, vec3 high)
{
    static const uint8_t faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                        {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    tahr_body_desc *body = tahr__lab_body(lab, TAHR_BODY_MESH);
    for (int i = 0; i < 8; i++) {
        tahr__lab_corner(lab, body, i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    }
    for (int i = 0; i < 6; i++) {
        tahr__lab_triangle(lab, body, faces[i][0], faces[i][1], faces[i][2]);
        tahr__lab_triangle(lab, body, faces[i][0], faces[i][2], faces[i][3]);
    }
    return body;
}

tahr_body_desc *tahr__lab_block3(tahr__lab *lab, vec3 low, vec3 high)
{
    if (lab->material == TAHR__OF_MESHES) {
        return mesh_block(lab, low, high);
    }
    tahr_body_desc *body = tahr__lab_body(lab, TAHR_BODY_BOX);
    body->half_extents = scale(sub(high, low), 0.5 * lab->scale);
    body->pose.position = add_scaled(lab->origin, add(low, high), 0.5 * lab->scale);
    return body;
}

tahr_body_desc *tahr__lab_block(tahr__lab *lab, double u0, double v0, double u1, double v1)
{
    if (lab->material == TAHR__OF_CHAINS) {
        tahr_body_desc *body = tahr__lab_body(lab, TAHR_BODY_CHAIN);
        body->flags = TAHR_BODY_LOOP;
        tahr__lab_corner(lab, body, u0, v0, 0);
        tahr__lab_corner(lab, body, u1, v0, 0);
        tahr__lab_corner(lab, body, u1, v1, 0);
        tahr__lab_corner(lab, body, u0, v1, 0);
        return body;
    }
    return lab->planar ? tahr__lab_block3(lab, vec(u0, v0, -1), vec(u1, v1, 1))
                       : tahr__lab_block3(lab, vec(u0, -DEPTH, v0), vec(u1, DEPTH, v1));
}

tahr_body_desc *tahr__lab_plane(tahr__lab *lab, double normal_u, double normal_v)
{
    const double half = 10, u = normal_v, v = -normal_u; /* along the face, to the right of its normal */
    if (lab->material == TAHR__OF_CHAINS) {
        tahr_body_desc *body = tahr__lab_body(lab, TAHR_BODY_CHAIN);
        tahr__lab_corner(lab, body, half * u, half * v, 0); /* its front on the right hand of who goes back */
        tahr__lab_corner(lab, body, -half * u, -half * v, 0);
        return body;
    }
    if (lab->material == TAHR__OF_MESHES) {
        tahr_body_desc *body = tahr__lab_body(lab, TAHR_BODY_MESH);
        for (int i = 0; i < 4; i++) {
            double end = i == 0 || i == 3 ? -half : half;
            tahr__lab_corner(lab, body, end * u, i < 2 ? -DEPTH : DEPTH, end * v);
        }
        tahr__lab_triangle(lab, body, 0, 1, 2);
        tahr__lab_triangle(lab, body, 0, 2, 3);
        return body;
    }
    tahr_body_desc *body = tahr__lab_body(lab, TAHR_BODY_BOX);
    body->half_extents = scale(lab->planar ? vec(half, THICK, 1) : vec(half, DEPTH, THICK), lab->scale);
    body->pose.position = tahr__lab_at(lab, -THICK * normal_u, -THICK * normal_v);
    /* Straight faces exactly so: a quarter turn would leave 1e-16 of slope in them. */
    if (normal_u == 0 || normal_v == 0) {
        double along = normal_u == 0 ? half : THICK, across = normal_u == 0 ? THICK : half;
        body->half_extents = scale(lab->planar ? vec(along, across, 1) : vec(along, DEPTH, across), lab->scale);
    } else {
        body->pose.orientation = quat_between(tahr__lab_up(lab), tahr__lab_toward(lab, normal_u, normal_v));
    }
    return body;
}

static void set_shape(tahr__lab *lab, uint32_t i)
{
    const uint32_t type = shapes[i].type;
    int angular = type == TAHR_SHAPE_BOX || type == TAHR_SHAPE_ELLIPSOID || type == TAHR_SHAPE_HULL;
    memset(&lab->shape, 0, sizeof lab->shape);
    lab->shape.type = type;
    lab->shape.radius = angular ? 0 : RADIUS * lab->scale;
    lab->shape.half_height = (type == TAHR_SHAPE_SPHERE ? RADIUS : HALF_HEIGHT) * lab->scale;
    lab->shape.half_x = angular ? HALF_X * lab->scale : 0;
    lab->shape.half_y = angular ? HALF_Y * lab->scale : 0;
    lab->shape_name = shapes[i].name;
}

void tahr__lab_resize(tahr__lab *lab, double factor, vec3 origin)
{
    uint32_t type = lab->shape.type;
    lab->scale = factor;
    lab->origin = origin;
    lab->margin = 0.01 * factor;
    for (uint32_t i = 0; i < SHAPES; i++) {
        if (shapes[i].type == type) {
            set_shape(lab, i);
        }
    }
}

static int has_material(const tahr__lab *lab, uint32_t material)
{
    static const uint32_t needed[TAHR__MATERIALS] = {TAHR_CAP_SOLIDS, TAHR_CAP_MESH, TAHR_CAP_CHAINS};
    return (lab->claims & needed[material]) != 0 && (material != TAHR__OF_MESHES || !lab->planar) &&
           (material != TAHR__OF_CHAINS || lab->planar);
}

int tahr__lab_next(tahr__lab *lab, uint32_t *at, uint32_t wanted)
{
    for (; *at < SHAPES * TAHR__MATERIALS && lab_goes_on(lab); ++*at) {
        uint32_t shape = *at / TAHR__MATERIALS, material = *at % TAHR__MATERIALS;
        if ((lab->claims & wanted & shapes[shape].capability) && has_material(lab, material)) {
            tahr__lab_clear(lab);
            lab->material = material;
            set_shape(lab, shape);
            ++*at;
            return 1;
        }
    }
    if (lab->checks == 0 && lab_goes_on(lab)) {
        tahr__lab_lacks(lab, "such a shape, or solids, meshes or chains");
    }
    return 0;
}

int tahr__lab_take(tahr__lab *lab, uint32_t capability)
{
    for (uint32_t i = 0; i < SHAPES; i++) {
        if (lab->claims & capability & shapes[i].capability) {
            set_shape(lab, i);
            return 1;
        }
    }
    return 0;
}

int tahr__lab_first_shape(tahr__lab *lab, uint32_t wanted)
{
    uint32_t at = 0;
    return tahr__lab_next(lab, &at, wanted);
}

double tahr__lab_reach(const tahr__lab *lab, vec3 toward)
{
    const tahr_shape *s = &lab->shape;
    const tahr_quat q = tahr__lab_upright(lab);
    double x = dot(toward, rotate(q, vec(1, 0, 0))), y = dot(toward, rotate(q, vec(0, 1, 0)));
    double z = dot(toward, tahr__lab_up(lab)), level = sqrt(x * x + y * y), h = s->half_height;
    switch (s->type) {
    case TAHR_SHAPE_SPHERE: return s->radius;
    case TAHR_SHAPE_CAPSULE: return s->radius + (h - s->radius) * fabs(z);
    case TAHR_SHAPE_BOX: return s->half_x * fabs(x) + s->half_y * fabs(y) + h * fabs(z);
    case TAHR_SHAPE_CYLINDER: return s->radius * level + h * fabs(z);
    case TAHR_SHAPE_CONE: return max_of(h * z, s->radius * level - h * z);
    case TAHR_SHAPE_ELLIPSOID:
        return sqrt(s->half_x * x * s->half_x * x + s->half_y * y * s->half_y * y + h * z * h * z);
    default: return max_of(max_of(s->half_x * fabs(x), s->half_y * fabs(y)), h * fabs(z));
    }
}

double tahr__lab_slack(const tahr__lab *lab)
{
    /* An engine whose geometry is in float, local to some metres, is off by 2.4e-7 m whatever the size of the
     * character. */
    return (lab->desc->gap_tolerance > 0 ? lab->desc->gap_tolerance : 9e-5) * max_of(lab->scale, 0.01);
}
