/* SPDX-License-Identifier: MIT
 * tmj_json.c: strict access to a JSON file; every message names the file and the place in it. */
#include "say.h"
#include "tmj.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Whether a file begins like XML, which is what people hand over by mistake. */
static int looks_like_xml(const char *path)
{
    FILE *file = fopen(path, "rb");
    int first = file != NULL ? fgetc(file) : EOF;
    if (file != NULL) {
        fclose(file);
    }
    return first == '<';
}

json_t *tmj_file(const char *path, const char *what)
{
    json_error_t error;
    struct stat info;
    if (stat(path, &info) == 0 && S_ISDIR(info.st_mode)) { /* it can be opened, and is empty */
        say_error("%s '%s' is a folder; expected a file", what, path);
        return NULL;
    }
    json_t *root = json_load_file(path, JSON_REJECT_DUPLICATES, &error);
    if (root != NULL) {
        return root;
    }
    if (error.line <= 0) {
        say_error("cannot read %s '%s': %s", what, path, error.text);
    } else if (looks_like_xml(path)) {
        say_error("%s '%s' is XML; expected JSON: save it in Tiled as .tmj, its tilesets as .tsj", what, path);
    } else {
        say_error("%s '%s', line %d, column %d: %s", what, path, error.line, error.column, error.text);
    }
    return NULL;
}

int tmj_complain(const struct tmj *tmj, const char *format, ...)
{
    char text[400];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    say_error("level '%s': %s%s%s", tmj->path, tmj->where, tmj->depth > 0 ? ": " : "", text);
    return -1;
}

size_t tmj_enter(struct tmj *tmj, const char *format, ...)
{
    size_t before = tmj->depth;
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(tmj->where + before, sizeof tmj->where - before, format, arguments);
    va_end(arguments);
    size_t room = sizeof tmj->where - before - 1;
    tmj->depth += length < 0 ? 0 : (size_t)length < room ? (size_t)length : room;
    return before;
}

void tmj_leave(struct tmj *tmj, size_t before)
{
    tmj->depth = before;
    tmj->where[before] = '\0';
}

static int read_number(struct tmj *tmj, const json_t *item, const char *key, const double range[2], double *value)
{
    size_t before = tmj_enter(tmj, tmj->depth > 0 ? ".%s" : "%s", key);
    double x = json_number_value(item);
    int good = json_is_number(item) && x >= range[0] && x <= range[1];
    if (!good) {
        tmj_complain(tmj, "%sexpected a number from %g to %g", item == NULL ? "missing: " : "", range[0], range[1]);
    }
    tmj_leave(tmj, before);
    *value = good ? x : *value;
    return good ? 0 : -1;
}

int tmj_number(struct tmj *tmj, const json_t *object, const char *key, const double range[2], double *value)
{
    return read_number(tmj, json_object_get(object, key), key, range, value);
}

int tmj_whole(struct tmj *tmj, const json_t *object, const char *key, const double range[2], uint32_t *value)
{
    double x = 0;
    if (tmj_number(tmj, object, key, range, &x) != 0) {
        return -1;
    }
    if (x != floor(x)) {
        return tmj_complain(tmj, "%s %g: expected a whole number", key, x);
    }
    *value = (uint32_t)x;
    return 0;
}

const json_t *tmj_list(struct tmj *tmj, const json_t *object, const char *key)
{
    const json_t *list = json_object_get(object, key);
    if (!json_is_array(list)) {
        size_t before = tmj_enter(tmj, tmj->depth > 0 ? ".%s" : "%s", key);
        tmj_complain(tmj, "%sexpected a list", list == NULL ? "missing: " : "");
        tmj_leave(tmj, before);
        return NULL;
    }
    return list;
}

static const struct {
    const char *name;
    enum tmj_kind kind;
} kinds[] = {{"solid", TMJ_SOLID},   {"one_way", TMJ_ONE_WAY}, {"water", TMJ_WATER},
             {"sensor", TMJ_SENSOR}, {"goal", TMJ_GOAL},       {"start", TMJ_START},
             {"mover", TMJ_PLAIN},   {"belt", TMJ_PLAIN},      {"decoration", TMJ_DECORATION}};

#define KIND_COUNT (sizeof kinds / sizeof *kinds)

static void read_class(const json_t *object, struct tmj_traits *traits)
{
    const char *name = json_string_value(json_object_get(object, "class"));
    if (name == NULL) {
        name = json_string_value(json_object_get(object, "type"));
    }
    if (name == NULL || *name == '\0') {
        return;
    }
    for (size_t i = 0; i < KIND_COUNT; i++) {
        if (strcmp(kinds[i].name, name) == 0) {
            traits->kind = kinds[i].kind != TMJ_PLAIN ? kinds[i].kind : traits->kind;
            traits->mover |= strcmp(name, "mover") == 0;
            return;
        }
    }
    traits->foreign = 1;
}

static int read_switch(struct tmj *tmj, const char *name, const json_t *value, struct tmj_traits *traits)
{
    for (size_t i = 0; i < KIND_COUNT; i++) {
        if (strcmp(kinds[i].name, name) != 0 || strcmp(name, "belt") == 0) {
            continue;
        }
        if (!json_is_boolean(value)) {
            return tmj_complain(tmj, "property '%s': expected true or false", name);
        }
        if (strcmp(name, "mover") == 0) {
            traits->mover = json_is_true(value);
        } else if (json_is_true(value)) {
            traits->kind = kinds[i].kind;
        } else if (traits->kind == kinds[i].kind) {
            traits->kind = TMJ_PLAIN;
        }
        return 0;
    }
    return 1;
}

static int read_property(struct tmj *tmj, const json_t *property, struct tmj_traits *traits)
{
    const struct {
        const char *name;
        double range[2];
        double *value;
    } numbers[] = {{"belt", {-1000, 1000}, &traits->belt},
                   {"swing_x", {-1e6, 1e6}, &traits->swing_x},
                   {"swing_y", {-1e6, 1e6}, &traits->swing_y},
                   {"period", {0.01, 1e6}, &traits->period},
                   {"pause", {0, 1e6}, &traits->pause}};
    const char *name = json_string_value(json_object_get(property, "name"));
    const json_t *value = json_object_get(property, "value");
    if (name == NULL) {
        return tmj_complain(tmj, "a property without a name");
    }
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        if (strcmp(numbers[i].name, name) == 0) {
            size_t before = tmj_enter(tmj, ".properties");
            int failed = read_number(tmj, value, name, numbers[i].range, numbers[i].value);
            tmj_leave(tmj, before);
            return failed;
        }
    }
    return read_switch(tmj, name, value, traits) < 0 ? -1 : 0;
}

int tmj_traits(struct tmj *tmj, const json_t *object, struct tmj_traits *traits)
{
    const json_t *properties = json_object_get(object, "properties");
    read_class(object, traits);
    if (properties == NULL) {
        return 0;
    }
    if (!json_is_array(properties)) {
        return tmj_complain(tmj, "properties: expected a list of objects with name and value");
    }
    for (size_t i = 0; i < json_array_size(properties); i++) {
        if (read_property(tmj, json_array_get(properties, i), traits) != 0) {
            return -1;
        }
    }
    return 0;
}

double tmj_map_property(struct tmj *tmj, const json_t *map, const char *name, int *failed)
{
    const json_t *properties = json_object_get(map, "properties");
    double value = 0;
    for (size_t i = 0; i < json_array_size(properties); i++) {
        const json_t *property = json_array_get(properties, i);
        const char *own = json_string_value(json_object_get(property, "name"));
        if (own != NULL && strcmp(own, name) == 0) {
            const double range[2] = {1e-3, 1e6};
            size_t before = tmj_enter(tmj, "properties");
            *failed |= read_number(tmj, json_object_get(property, "value"), name, range, &value);
            tmj_leave(tmj, before);
        }
    }
    return value;
}
