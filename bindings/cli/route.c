/* SPDX-License-Identifier: MIT
 * route.c: timed inputs of one character, from a JSON file read with jansson. */
#include "route.h"

#include "say.h"
#include "vec.h"

#include <jansson.h>
#include <stdarg.h>
#include <stdlib.h>
#include <stdio.h>
#include <string.h>

/* Where in the file a value is, for messages. */
struct place {
    const char *path;
    size_t entry; /* or NO_ENTRY */
};

#define NO_ENTRY ((size_t)-1)

static int complain(const struct place *place, const char *key, const char *wanted)
{
    if (place->entry == NO_ENTRY) {
        say_error("%s: key '%s': %s", place->path, key, wanted);
    } else {
        say_error("%s: inputs[%zu], key '%s': %s", place->path, place->entry, key, wanted);
    }
    return -1;
}

static int read_vector(const struct place *place, const char *key, const json_t *value, tahr_vec3 *vector)
{
    double x[3];
    if (!json_is_array(value) || json_array_size(value) != 3) {
        return complain(place, key, "expected a list of three numbers");
    }
    for (size_t k = 0; k < 3; k++) {
        const json_t *item = json_array_get(value, k);
        x[k] = json_number_value(item);
        if (!json_is_number(item) || !isfinite(x[k]) || fabs(x[k]) > 1e7) {
            return complain(place, key, "expected three numbers of at most 1e7");
        }
    }
    *vector = (tahr_vec3){x[0], x[1], x[2]};
    return 0;
}

static int read_mode(const struct place *place, const json_t *value, struct route_entry *entry)
{
    const char *name = json_string_value(value);
    entry->has_mode = 1;
    while (name != NULL && strcmp(tahr_mode_name(entry->mode), name) != 0) {
        if (strcmp(tahr_mode_name(++entry->mode), "?") == 0) {
            name = NULL;
        }
    }
    return name != NULL ? 0 : complain(place, "mode", "expected the name of a mode, as \"flying\"");
}

static int read_key(const struct place *place, const char *key, const json_t *value, struct route_entry *entry)
{
    if (strcmp(key, "time") == 0) {
        entry->time = json_number_value(value);
        return json_is_number(value) && entry->time >= 0 ? 0
                                                         : complain(place, key, "expected a number of seconds >= 0");
    }
    if (strcmp(key, "move") == 0) {
        return read_vector(place, key, value, &entry->move);
    }
    if (strcmp(key, "facing") == 0) {
        entry->has_facing = 1;
        return read_vector(place, key, value, &entry->facing);
    }
    if (strcmp(key, "jump") == 0) {
        entry->jump = json_is_true(value);
        return json_is_boolean(value) ? 0 : complain(place, key, "expected true or false");
    }
    if (strcmp(key, "crouch") == 0) {
        entry->crouch = json_is_true(value);
        return json_is_boolean(value) ? 0 : complain(place, key, "expected true or false");
    }
    if (strcmp(key, "launch") == 0) {
        entry->has_launch = 1;
        return read_vector(place, key, value, &entry->launch);
    }
    if (strcmp(key, "mode") == 0) {
        return read_mode(place, value, entry);
    }
    return complain(place, key, "unknown; known are time, move, jump, crouch, facing, launch, mode");
}

static int read_entry(const struct place *place, json_t *object, struct route_entry *entry)
{
    const char *key;
    json_t *value;
    if (!json_is_object(object)) {
        say_error("%s: inputs[%zu]: expected an object", place->path, place->entry);
        return -1;
    }
    json_object_foreach(object, key, value)
    {
        if (read_key(place, key, value, entry) != 0) {
            return -1;
        }
    }
    return json_object_get(object, "time") != NULL ? 0 : complain(place, "time", "missing");
}

static int read_inputs(struct route *route, const char *path, const json_t *list)
{
    struct place place = {path, NO_ENTRY};
    if (!json_is_array(list) || json_array_size(list) == 0) {
        return complain(&place, "inputs", "expected a list with at least one entry");
    }
    route->count = json_array_size(list);
    route->entries = memory_new(route->count, sizeof *route->entries);
    for (size_t i = 0; i < route->count; i++) {
        place.entry = i;
        if (read_entry(&place, json_array_get(list, i), &route->entries[i]) != 0) {
            return -1;
        }
        if (i > 0 && route->entries[i].time < route->entries[i - 1].time) {
            return complain(&place, "time", "earlier than the entry before");
        }
    }
    return 0;
}

static int read_object(struct route *route, const char *path, json_t *object)
{
    const struct place place = {path, NO_ENTRY};
    const char *key;
    json_t *value;
    json_object_foreach(object, key, value)
    {
        if (strcmp(key, "start") == 0) {
            route->has_start = 1;
            if (read_vector(&place, key, value, &route->start) != 0) {
                return -1;
            }
        } else if (strcmp(key, "inputs") != 0) {
            return complain(&place, key, "unknown; known are start, inputs");
        }
    }
    return read_inputs(route, path, json_object_get(object, "inputs"));
}

int route_load(struct route *route, const char *path)
{
    json_error_t error;
    json_t *root = json_load_file(path, JSON_REJECT_DUPLICATES, &error);
    int failed;
    *route = (struct route){0};
    if (root == NULL) {
        if (error.line > 0) {
            say_error("route '%s', line %d: %s", path, error.line, error.text);
        } else {
            say_error("cannot read route '%s': %s", path, error.text);
        }
        return -1;
    }
    failed = json_is_object(root) ? read_object(route, path, root) : read_inputs(route, path, root);
    json_decref(root);
    if (failed) {
        route_close(route);
    }
    return failed;
}

int route_input(struct route *route, double time, tahr_input *input)
{
    int jump = 0;
    size_t before = route->next;
    const struct route_entry *once = NULL;
    while (route->next < route->count && route->entries[route->next].time <= time + 1e-9) {
        jump |= route->entries[route->next].jump;
        once = &route->entries[route->next];
        route->next++;
    }
    if (route->next == 0) {
        return 0;
    }
    const struct route_entry *entry = &route->entries[route->next - 1];
    input->move = entry->move;
    input->facing = entry->facing;
    input->flags = entry->has_facing ? TAHR_INPUT_FACING : 0;
    input->jump = (uint32_t)(jump || entry->jump);
    input->crouch = (uint32_t)entry->crouch;
    if (once != NULL && once->has_launch) {
        input->launch = once->launch;
        input->flags |= TAHR_INPUT_LAUNCH;
    }
    if (once != NULL && once->has_mode) {
        input->mode = once->mode;
        input->flags |= TAHR_INPUT_MODE;
    }
    return route->next != before;
}

void route_close(struct route *route)
{
    free(route->entries);
    *route = (struct route){0};
}
