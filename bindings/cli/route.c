/* SPDX-License-Identifier: MIT
 * route.c: timed inputs of one character, from a JSON file read with jansson. */
#include "route.h"

#include "levels.h"
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
    int planar;   /* two numbers make a vector too */
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
    double x[3] = {0, 0, 0};
    size_t count = json_array_size(value);
    if (count != 3 && !(place->planar && count == 2)) {
        return complain(place, key,
                        place->planar ? "expected a list of two numbers" : "expected a list of three numbers");
    }
    for (size_t k = 0; k < count; k++) {
        const json_t *item = json_array_get(value, k);
        x[k] = json_number_value(item);
        if (!json_is_number(item) || !isfinite(x[k]) || fabs(x[k]) > 1e7) {
            return complain(place, key, "expected numbers of at most 1e7");
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

/* The keys of which every entry has one: what it waits for. 1: it is none of them. */
static int read_wait(const struct place *place, const char *key, const json_t *value, struct route_entry *entry)
{
    static const char *const names[] = {
        [ROUTE_TIME] = "time", [ROUTE_AFTER] = "after", [ROUTE_AT_X] = "at_x", [ROUTE_AT_Y] = "at_y"};
    for (int wait = ROUTE_TIME; wait <= ROUTE_AT_Y; wait++) {
        if (strcmp(key, names[wait]) != 0) {
            continue;
        }
        entry->wait = (enum route_wait)wait;
        entry->time = json_number_value(value);
        if (wait >= ROUTE_AT_X) {
            return json_is_number(value) && fabs(entry->time) <= 1e7
                       ? 0
                       : complain(place, key, "expected a number of at most 1e7");
        }
        return json_is_number(value) && entry->time >= 0 ? 0
                                                         : complain(place, key, "expected a number of seconds >= 0");
    }
    return 1;
}

static int read_key(const struct place *place, const char *key, const json_t *value, struct route_entry *entry)
{
    int wait = read_wait(place, key, value, entry);
    if (wait <= 0) {
        return wait;
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
    if (strcmp(key, "drop") == 0) {
        entry->drop = json_is_true(value);
        return json_is_boolean(value) ? 0 : complain(place, key, "expected true or false");
    }
    if (strcmp(key, "launch") == 0) {
        entry->has_launch = 1;
        return read_vector(place, key, value, &entry->launch);
    }
    if (strcmp(key, "mode") == 0) {
        return read_mode(place, value, entry);
    }
    return complain(place, key,
                    "unknown; known are time, after, at_x, at_y, move, jump, crouch, drop, facing, launch, mode");
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
    int waits = (json_object_get(object, "time") != NULL) + (json_object_get(object, "after") != NULL) +
                (json_object_get(object, "at_x") != NULL) + (json_object_get(object, "at_y") != NULL);
    if (waits == 0) {
        return complain(place, "time", "missing");
    }
    return waits == 1 ? 0 : complain(place, "time", "expected one of time, after, at_x, at_y");
}

static int read_inputs(struct route *route, struct place place, const json_t *list)
{
    double latest = 0; /* of the entries with a time */
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
        if (route->entries[i].wait == ROUTE_TIME && route->entries[i].time < latest) {
            return complain(&place, "time", "earlier than the entry before");
        }
        latest = route->entries[i].wait == ROUTE_TIME ? route->entries[i].time : latest;
    }
    return 0;
}

static int read_object(struct route *route, struct place place, json_t *object)
{
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
    return read_inputs(route, place, json_object_get(object, "inputs"));
}

static int read_route(struct route *route, struct place place, json_t *root)
{
    return json_is_object(root) ? read_object(route, place, root) : read_inputs(route, place, root);
}

void route_tour(struct route *route)
{
    json_t *root = json_loads(level_text(LEVEL_TOUR), 0, NULL);
    *route = (struct route){0};
    read_route(route, (struct place){"tour.json", NO_ENTRY, 1}, root);
    json_decref(root);
}

int route_load(struct route *route, const char *path, int planar)
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
    failed = read_route(route, (struct place){path, NO_ENTRY, planar}, root);
    json_decref(root);
    if (failed) {
        route_close(route);
    }
    return failed;
}

/* Whether a coordinate passed a place since it was last looked at. */
static int passes(double before, double now, double place)
{
    return (before - place) * (now - place) <= 0;
}

/* Whether the next entry begins with the step that begins at time; *begin: when it did. */
static int begins(const struct route *route, double time, tahr_vec3 at, double *begin)
{
    const struct route_entry *entry = &route->entries[route->next];
    *begin = time;
    switch (entry->wait) {
    case ROUTE_AT_X: return passes(route->before.x, at.x, entry->time);
    case ROUTE_AT_Y: return passes(route->before.y, at.y, entry->time);
    case ROUTE_AFTER: *begin = route->begun + entry->time; break;
    default: *begin = entry->time; break;
    }
    return *begin <= time + 1e-9;
}

int route_input(struct route *route, double time, tahr_vec3 at, tahr_input *input)
{
    int jump = 0, drop = 0;
    double begin;
    size_t before = route->next;
    const struct route_entry *once = NULL;
    route->before = time > 0 ? route->before : at;
    while (route->next < route->count && begins(route, time, at, &begin)) {
        once = &route->entries[route->next++];
        jump |= once->jump;
        drop |= once->drop;
        route->begun = begin;
        route->before = at;
    }
    route->before = at;
    if (route->next == 0) {
        return 0;
    }
    const struct route_entry *entry = &route->entries[route->next - 1];
    input->move = entry->move;
    input->facing = entry->facing;
    input->flags = entry->has_facing ? TAHR_INPUT_FACING : 0;
    input->flags |= drop || entry->drop ? (uint32_t)TAHR_INPUT_DROP : 0u;
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
