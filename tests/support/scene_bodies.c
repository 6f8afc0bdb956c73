/* SPDX-License-Identifier: MIT
 * scene_bodies.c: reads the bodies of a scene: boxes, spheres, capsules, and meshes given or made by rule. */
#include "scene_bodies.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene_level.h"
#include "scene_motion.h"

static int bad(scene *s, const char *what, const char *where)
{
    if (!s->error[0]) {
        snprintf(s->error, sizeof s->error, "body %u, %s: %s", s->body_count, where, what);
    }
    return 0;
}

/* A required number, or an optional one if fallback is not NAN. */
static double number(scene *s, json_t *item, const char *key, double fallback)
{
    json_t *value = json_object_get(item, key);
    double x = fallback;
    if (!value && isnan(fallback)) {
        bad(s, "missing", key);
        return 0;
    }
    if (value) {
        scene_number(s, value, &x);
    }
    return x;
}

/* Points of two numbers; the caller frees them. */
static double (*pairs(scene *s, json_t *list, int *count))[2]
{
    size_t i;
    json_t *item;
    double(*points)[2] = calloc(json_array_size(list) + 1, sizeof *points);
    *count = 0;
    json_array_foreach(list, i, item)
    {
        if (points && scene_number(s, json_array_get(item, 0), &points[i][0]) &&
            scene_number(s, json_array_get(item, 1), &points[i][1])) {
            ++*count;
        }
    }
    if (*count < 2) {
        bad(s, "two points or more were expected", "points");
    }
    return points;
}

static void given_mesh(scene *s, json_t *item, scene_mesh *mesh)
{
    size_t i;
    json_t *entry;
    tahr_vec3 v;
    json_array_foreach(json_object_get(item, "vertices"), i, entry)
    {
        if (scene_vec3(s, entry, &v)) {
            scene_mesh_vertex(mesh, v.x, v.y, v.z);
        }
    }
    json_array_foreach(json_object_get(item, "triangles"), i, entry)
    {
        if (scene_vec3(s, entry, &v)) {
            scene_mesh_triangle(mesh, (uint32_t)v.x, (uint32_t)v.y, (uint32_t)v.z);
        }
    }
}

static int make_mesh(scene *s, json_t *item, const char *kind, scene_mesh *mesh)
{
    if (strcmp(kind, "mesh") == 0) {
        given_mesh(s, item, mesh);
    } else if (strcmp(kind, "profile") == 0 || strcmp(kind, "plan") == 0) {
        int count;
        double(*points)[2] = pairs(s, json_object_get(item, "points"), &count);
        if (kind[1] == 'r') {
            scene_mesh_profile(mesh, (const double(*)[2])points, count, number(s, item, "width", NAN));
        } else {
            scene_mesh_plan(mesh, (const double(*)[2])points, count, number(s, item, "low", NAN),
                            number(s, item, "high", NAN));
        }
        free(points);
    } else if (strcmp(kind, "stairs") == 0) {
        scene_stairs stairs = {.n = (int)number(s, item, "n", NAN),
                               .rise = number(s, item, "rise", NAN),
                               .run = number(s, item, "run", NAN),
                               .width = number(s, item, "width", NAN),
                               .bevel = number(s, item, "bevel", 0),
                               .lead = number(s, item, "lead", 5)};
        scene_mesh_stairs(mesh, &stairs);
    } else if (strcmp(kind, "field") == 0) {
        double (*height)(double, double) = json_is_true(json_object_get(item, "hills")) ? scene_hills : NULL;
        scene_mesh_field(mesh, (int)number(s, item, "nx", NAN), (int)number(s, item, "ny", NAN),
                         number(s, item, "cell", NAN), height);
    } else {
        return 0;
    }
    return 1;
}

/* m, half the width that a chain gets where worlds have three dimensions. */
static const double HALF_WIDTH = 5;

/* "chain": the line through "points" [x, y], its front on the right hand; "loop": back to the first. A chain for planar
 * backends, and a ribbon that faces the same way for the others. */
static int read_chain(scene *s, json_t *item, tahr_body_desc *body)
{
    int count, loop = json_is_true(json_object_get(item, "loop"));
    double(*points)[2] = pairs(s, json_object_get(item, "points"), &count);
    scene_mesh *ribbon = &s->meshes[s->body_count], *line = &s->lines[s->body_count];
    tahr_body_desc *flat = &s->flat[s->body_count];
    for (int i = 0; i < count; i++) {
        scene_mesh_vertex(line, points[i][0], points[i][1], 0);
        scene_mesh_vertex(ribbon, points[i][0], points[i][1], -HALF_WIDTH);
        scene_mesh_vertex(ribbon, points[i][0], points[i][1], HALF_WIDTH);
    }
    for (int i = 0; i + 1 - loop < count; i++) {
        uint32_t a = 2 * (uint32_t)i, b = 2 * (uint32_t)((i + 1) % count);
        scene_mesh_triangle(ribbon, a, b, b + 1);
        scene_mesh_triangle(ribbon, a, b + 1, a + 1);
    }
    free(points);
    scene_level_body(ribbon, body);
    tahr_body_desc_init(flat, sizeof *flat, TAHR_BODY_CHAIN);
    flat->vertices = line->vertices;
    flat->vertex_count = line->vertex_count;
    flat->flags = loop ? (uint32_t)TAHR_BODY_LOOP : 0u;
    return !s->error[0] && !ribbon->failed && !line->failed;
}

static int read_shape(scene *s, json_t *item, tahr_body_desc *body)
{
    const char *kind = json_string_value(json_object_get(item, "is"));
    scene_mesh *mesh = &s->meshes[s->body_count];
    kind = kind ? kind : "?";
    if (strcmp(kind, "box") == 0) {
        tahr_body_desc_init(body, sizeof *body, TAHR_BODY_BOX);
        return scene_vec3(s, json_object_get(item, "half"), &body->half_extents);
    }
    if (strcmp(kind, "sphere") == 0 || strcmp(kind, "capsule") == 0) {
        tahr_body_desc_init(body, sizeof *body, kind[0] == 's' ? TAHR_BODY_SPHERE : TAHR_BODY_CAPSULE);
        body->radius = number(s, item, "radius", NAN);
        body->half_height = kind[0] == 'c' ? number(s, item, "half_height", NAN) : 0;
        return !s->error[0];
    }
    if (strcmp(kind, "chain") == 0) {
        return read_chain(s, item, body);
    }
    if (!make_mesh(s, item, kind, mesh)) {
        return bad(s, "no such kind of body", kind);
    }
    scene_level_body(mesh, body);
    return !s->error[0] && !mesh->failed;
}

/* "turn": degrees about z, then "tilt": degrees about the world's y (positive lifts +x down). */
static void read_pose(scene *s, json_t *item, tahr_pose *pose)
{
    double turn = number(s, item, "turn", 0) * 0.008726646259971648,
           tilt = number(s, item, "tilt", 0) * 0.008726646259971648;
    json_t *at = json_object_get(item, "at");
    if (at) {
        scene_vec3(s, at, &pose->position);
    }
    pose->orientation =
        (tahr_quat){sin(tilt) * sin(turn), sin(tilt) * cos(turn), cos(tilt) * sin(turn), cos(tilt) * cos(turn)};
}

/* "walkable": "increase", "decrease" (with "walkable_angle", degrees) or "never". */
static int read_walkable(scene *s, json_t *item, tahr_body_desc *body)
{
    static const char *const RULES[] = {"default", "increase", "decrease", "never"};
    const char *rule = json_string_value(json_object_get(item, "walkable"));
    for (uint32_t i = 0; rule && i < sizeof RULES / sizeof RULES[0]; i++) {
        if (strcmp(rule, RULES[i]) == 0) {
            body->walkable_rule = i;
            rule = NULL;
        }
    }
    body->walkable_angle = 0.017453292519943295 * number(s, item, "walkable_angle", 0);
    return rule ? bad(s, "no such rule", rule) : 1;
}

static void read_flags(json_t *item, tahr_body_desc *body)
{
    body->flags |= json_is_true(json_object_get(item, "sensor")) ? (uint32_t)TAHR_BODY_SENSOR : 0u;
    body->flags |= json_is_true(json_object_get(item, "two_sided")) ? (uint32_t)TAHR_BODY_TWO_SIDED : 0u;
    body->flags |= json_is_true(json_object_get(item, "fluid")) ? (uint32_t)TAHR_BODY_FLUID : 0u;
    body->flags |= json_is_true(json_object_get(item, "no_base")) ? (uint32_t)TAHR_BODY_NO_BASE : 0u;
    body->flags |= json_is_true(json_object_get(item, "no_step")) ? (uint32_t)TAHR_BODY_NO_STEP : 0u;
    body->flags |= json_is_true(json_object_get(item, "one_way")) ? (uint32_t)TAHR_BODY_ONE_WAY : 0u;
    body->flags |= json_is_true(json_object_get(item, "character")) ? (uint32_t)TAHR_BODY_CHARACTER : 0u;
}

/* "flow": surface velocity, m/s; "mass", kg; "friction" of a fluid, 1/s. */
static int read_matter(scene *s, json_t *item, tahr_body_desc *body)
{
    json_t *flow = json_object_get(item, "flow");
    body->mass = number(s, item, "mass", 0);
    body->fluid_friction = number(s, item, "friction", 0);
    return !flow || scene_vec3(s, flow, &body->surface_velocity);
}

int scene_bodies_read(scene *s)
{
    size_t i;
    json_t *item;
    json_array_foreach(json_object_get(s->root, "bodies"), i, item)
    {
        if (s->body_count == SCENE_MAX_BODIES) {
            return bad(s, "too many bodies", "bodies");
        }
        tahr_body_desc *body = &s->bodies[s->body_count];
        int ok = read_shape(s, item, body);
        s->body_count++;
        if (!ok) {
            return 0;
        }
        read_pose(s, item, &body->pose);
        read_flags(item, body);
        if (!read_walkable(s, item, body) || !read_matter(s, item, body) ||
            !scene_motion_read(s, item, s->body_count - 1)) {
            return 0;
        }
    }
    return !s->error[0];
}
