/* SPDX-License-Identifier: MIT
 * scene_file.c: reads movement scenes from JSON. */
#include "scene_file.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scene_bodies.h"

#define FIELD(kind, name)                        \
    {                                            \
#name, offsetof(tahr_config, name), kind \
    }

enum { REAL, WORD };

static const struct {
    const char *name;
    size_t offset;
    int kind;
} CONFIG_FIELDS[] = {
    FIELD(WORD, max_slides),
    FIELD(REAL, skin),
    FIELD(REAL, max_depenetration),
    FIELD(REAL, walkable_angle),
    FIELD(REAL, walkable_hysteresis),
    FIELD(REAL, floor_target),
    FIELD(REAL, floor_max),
    FIELD(REAL, step_height),
    FIELD(REAL, snap_distance),
    FIELD(REAL, perch_threshold),
    FIELD(REAL, perch_extra),
    FIELD(REAL, edge_tolerance),
    FIELD(WORD, cached_floor),
    FIELD(WORD, walk_off_ledges),
    FIELD(REAL, max_speed),
    FIELD(REAL, acceleration),
    FIELD(REAL, turn_friction),
    FIELD(REAL, braking_deceleration),
    FIELD(REAL, braking_drag),
    FIELD(REAL, jump_speed),
    FIELD(REAL, jump_hold_time),
    FIELD(REAL, terminal_speed),
    FIELD(REAL, air_control),
    FIELD(REAL, air_turn_friction),
    FIELD(REAL, arc_tolerance),
    FIELD(REAL, max_dt),
    FIELD(REAL, turn_rate),
    FIELD(WORD, sleep),
    {"radius", offsetof(tahr_config, shape) + offsetof(tahr_shape, radius), REAL},
    {"half_height", offsetof(tahr_config, shape) + offsetof(tahr_shape, half_height), REAL},
    {"half_x", offsetof(tahr_config, shape) + offsetof(tahr_shape, half_x), REAL},
    {"half_y", offsetof(tahr_config, shape) + offsetof(tahr_shape, half_y), REAL},
};

static int bad(scene *s, const char *what, const char *where)
{
    if (!s->error[0]) {
        snprintf(s->error, sizeof s->error, "%.80s: %.160s", where, what);
    }
    return 0;
}

int scene_number(scene *s, json_t *value, double *number)
{
    char error[128];
    if (json_is_number(value)) {
        *number = json_number_value(value);
        return 1;
    }
    if (!json_is_string(value)) {
        return bad(s, "a number or a formula was expected", s->name);
    }
    if (!scene_expr(json_string_value(value), &s->names, number, error)) {
        return bad(s, error, s->name);
    }
    return 1;
}

int scene_vec3(scene *s, json_t *value, tahr_vec3 *v)
{
    if (json_array_size(value) != 3) {
        return bad(s, "an array of three numbers was expected", s->name);
    }
    return scene_number(s, json_array_get(value, 0), &v->x) && scene_number(s, json_array_get(value, 1), &v->y) &&
           scene_number(s, json_array_get(value, 2), &v->z);
}

static json_t *load(const char *path, char *error, size_t capacity)
{
    json_error_t problem;
    json_t *root = json_load_file(path, JSON_REJECT_DUPLICATES, &problem);
    if (!root) {
        snprintf(error, capacity, "%s:%d: %s", path, problem.line, problem.text);
    }
    return root;
}

int scene_count(const char *path, char *error)
{
    json_t *root = load(path, error, 256), *values;
    const char *name;
    size_t count = 1;
    if (!root) {
        return -1;
    }
    json_object_foreach(json_object_get(root, "vary"), name, values)
    {
        count *= json_array_size(values);
    }
    json_decref(root);
    return (int)count;
}

/* The last name in "vary" changes fastest. */
static int read_names(scene *s, int variant)
{
    json_t *vary = json_object_get(s->root, "vary"), *values;
    const char *name;
    size_t rest = 1, at = (size_t)variant;
    json_object_foreach(vary, name, values)
    {
        rest *= json_array_size(values);
    }
    json_object_foreach(vary, name, values)
    {
        double value = 0;
        rest /= json_array_size(values);
        size_t n = strlen(s->name);
        if (!scene_number(s, json_array_get(values, at / rest), &value) || !scene_names_set(&s->names, name, value)) {
            return bad(s, "bad value or too many names", name);
        }
        at %= rest;
        snprintf(s->name + n, sizeof s->name - n, " %s=%g", name, value);
    }
    json_object_foreach(json_object_get(s->root, "let"), name, values)
    {
        double value = 0;
        if (!scene_number(s, values, &value) || !scene_names_set(&s->names, name, value)) {
            return bad(s, "bad value or too many names", name);
        }
    }
    return 1;
}

/* "shape": "capsule", "box" (as wide and high as the preset's capsule) or "sphere" (of its radius); other fields may
 * change it afterwards. */
static int read_shape(scene *s, json_t *value)
{
    tahr_shape *shape = &s->config.shape;
    const char *name = json_string_value(value);
    name = name ? name : "?";
    if (strcmp(name, "box") == 0) {
        *shape = (tahr_shape){.type = TAHR_SHAPE_BOX, .half_height = 0.9, .half_x = 0.35, .half_y = 0.35};
    } else if (strcmp(name, "sphere") == 0) {
        *shape = (tahr_shape){.type = TAHR_SHAPE_SPHERE, .radius = 0.35, .half_height = 0.35};
    } else if (strcmp(name, "capsule") != 0) {
        return bad(s, "no such shape", name);
    }
    return 1;
}

static int read_config(scene *s)
{
    json_t *value;
    const char *name, *field = NULL;
    tahr_config_init(&s->config, sizeof s->config, TAHR_PRESET_PRECISE);
    json_object_foreach(json_object_get(s->root, "config"), name, value)
    {
        size_t i = 0, count = sizeof CONFIG_FIELDS / sizeof CONFIG_FIELDS[0];
        double number;
        if (strcmp(name, "shape") == 0) {
            if (!read_shape(s, value)) {
                return 0;
            }
            continue;
        }
        while (i < count && strcmp(CONFIG_FIELDS[i].name, name) != 0) {
            i++;
        }
        if (i == count) {
            return bad(s, "no such config field", name);
        }
        if (!scene_number(s, value, &number)) {
            return 0;
        }
        char *at = (char *)&s->config + CONFIG_FIELDS[i].offset;
        if (CONFIG_FIELDS[i].kind == REAL) {
            memcpy(at, &number, sizeof number);
        } else {
            uint32_t word = (uint32_t)number;
            memcpy(at, &word, sizeof word);
        }
    }
    return tahr_config_check(&s->config, &field) == TAHR_OK
               ? 1
               : bad(s, "rejected by tahr_config_check", field ? field : "?");
}

/* "move": [x, y, z], or "heading": degrees from +x toward +y with "size" (1). */
static int read_input(scene *s, json_t *item, scene_input *in)
{
    json_t *heading = json_object_get(item, "heading"), *move = json_object_get(item, "move");
    double angle = 0, size = 1;
    in->input.struct_size = sizeof in->input;
    in->input.jump = json_is_true(json_object_get(item, "jump"));
    if (!scene_number(s, json_object_get(item, "at"), &in->time)) {
        return 0;
    }
    if (json_object_get(item, "size") && !scene_number(s, json_object_get(item, "size"), &size)) {
        return 0;
    }
    if (heading && scene_number(s, heading, &angle)) {
        in->input.move.x = size * cos(angle * 0.017453292519943295);
        in->input.move.y = size * sin(angle * 0.017453292519943295);
    }
    return move ? scene_vec3(s, move, &in->input.move) : 1;
}

static int read_inputs(scene *s)
{
    size_t i;
    json_t *item;
    json_array_foreach(json_object_get(s->root, "inputs"), i, item)
    {
        if (s->input_count == SCENE_MAX_INPUTS) {
            return bad(s, "too many", "inputs");
        }
        if (!read_input(s, item, &s->inputs[s->input_count++])) {
            return 0;
        }
    }
    return 1;
}

static int read_rates(scene *s)
{
    static const double ALL[] = {10, 30, 60, 144, 1000};
    json_t *item, *rates = json_object_get(s->root, "rates");
    size_t i;
    if (!rates) {
        memcpy(s->rates, ALL, sizeof ALL);
        s->rate_count = 5;
        return 1;
    }
    json_array_foreach(rates, i, item)
    {
        if (s->rate_count == SCENE_MAX_RATES || !scene_number(s, item, &s->rates[s->rate_count++])) {
            return bad(s, "bad or too many", "rates");
        }
    }
    return 1;
}

static int read_start(scene *s)
{
    json_t *start = json_object_get(s->root, "start"), *settle = json_object_get(start, "settle");
    json_t *velocity = json_object_get(start, "velocity");
    s->settle = !json_is_false(settle);
    return scene_vec3(s, json_object_get(start, "position"), &s->position) &&
           (!velocity || scene_vec3(s, velocity, &s->velocity)) &&
           scene_number(s, json_object_get(s->root, "duration"), &s->duration);
}

static int known_keys(scene *s)
{
    static const char *const KEYS = " about vary let config bodies start inputs duration rates expect ";
    const char *name;
    json_t *value;
    json_object_foreach(s->root, name, value)
    {
        char key[64];
        snprintf(key, sizeof key, " %.60s ", name);
        if (!strstr(KEYS, key)) {
            return bad(s, "no such key of a scene", name);
        }
    }
    return 1;
}

int scene_read(scene *s, const char *path, int variant)
{
    const char *file = strrchr(path, '/');
    memset(s, 0, sizeof *s);
    file = file ? file + 1 : path;
    snprintf(s->name, sizeof s->name, "%.*s", (int)strcspn(file, "."), file);
    s->root = load(path, s->error, sizeof s->error);
    s->expect = json_object_get(s->root, "expect");
    return s->root && known_keys(s) && read_names(s, variant) && read_config(s) && scene_bodies_read(s) &&
           read_start(s) && read_inputs(s) && read_rates(s);
}

void scene_free(scene *s)
{
    for (uint32_t i = 0; i < s->body_count; i++) {
        scene_mesh_free(&s->meshes[i]);
    }
    json_decref(s->root);
    memset(s, 0, sizeof *s);
}
