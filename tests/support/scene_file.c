/* SPDX-License-Identifier: MIT
 * scene_file.c: reads movement scenes from JSON. */
#include "scene_file.h"

#include <stdio.h>
#include <string.h>

#include "scene_bodies.h"
#include "scene_config.h"
#include "scene_input.h"

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

static int read_inputs(scene *s)
{
    size_t i;
    json_t *item;
    json_array_foreach(json_object_get(s->root, "inputs"), i, item)
    {
        if (s->input_count == SCENE_MAX_INPUTS) {
            return bad(s, "too many", "inputs");
        }
        if (!scene_input_read(s, item, &s->inputs[s->input_count++])) {
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
    s->planar = json_is_true(json_object_get(s->root, "planar"));
    s->may_be_crushed = json_string_value(json_object_get(s->root, "allow")) != NULL &&
                        strcmp(json_string_value(json_object_get(s->root, "allow")), "crushed") == 0;
    return scene_vec3(s, json_object_get(start, "position"), &s->position) &&
           (!velocity || scene_vec3(s, velocity, &s->velocity)) &&
           scene_number(s, json_object_get(s->root, "duration"), &s->duration);
}

static int known_keys(scene *s)
{
    static const char *const KEYS = " about vary let config bodies start inputs duration rates expect allow planar ";
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
    return s->root && known_keys(s) && read_names(s, variant) && scene_config_read(s) && scene_bodies_read(s) &&
           read_start(s) && read_inputs(s) && read_rates(s);
}

void scene_free(scene *s)
{
    for (uint32_t i = 0; i < s->body_count; i++) {
        scene_mesh_free(&s->meshes[i]);
        scene_mesh_free(&s->lines[i]);
    }
    json_decref(s->root);
    memset(s, 0, sizeof *s);
}
