/* SPDX-License-Identifier: MIT
 * scene_input.c: reads what the player of a scene wants, and when. */
#include "scene_input.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static int bad(scene *s, const char *what, const char *where)
{
    if (!s->error[0]) {
        snprintf(s->error, sizeof s->error, "%.80s: %.160s", where, what);
    }
    return 0;
}

/* Vectors that count with their flag. */
static int read_vectors(scene *s, json_t *item, tahr_input *input)
{
    const struct {
        const char *name;
        tahr_vec3 *vector;
        uint32_t flag;
    } vectors[] = {{"facing", &input->facing, TAHR_INPUT_FACING},
                   {"gravity", &input->gravity, TAHR_INPUT_GRAVITY},
                   {"launch", &input->launch, TAHR_INPUT_LAUNCH},
                   {"impulse", &input->impulse, TAHR_INPUT_IMPULSE},
                   {"drive", &input->drive, TAHR_INPUT_DRIVE}};
    for (size_t i = 0; i < sizeof vectors / sizeof vectors[0]; i++) {
        json_t *value = json_object_get(item, vectors[i].name);
        if (value && !scene_vec3(s, value, vectors[i].vector)) {
            return 0;
        }
        input->flags |= value ? vectors[i].flag : 0u;
    }
    return 1;
}

static void read_switches(json_t *item, tahr_input *input)
{
    const struct {
        const char *name;
        uint32_t flag;
    } switches[] = {{"launch_level", TAHR_INPUT_LAUNCH_LEVEL},
                    {"launch_up", TAHR_INPUT_LAUNCH_UP},
                    {"drop", TAHR_INPUT_DROP},
                    {"drive_add", TAHR_INPUT_DRIVE_ADD},
                    {"drive_level", TAHR_INPUT_DRIVE_LEVEL}};
    for (size_t i = 0; i < sizeof switches / sizeof switches[0]; i++) {
        input->flags |= json_is_true(json_object_get(item, switches[i].name)) ? switches[i].flag : 0u;
    }
    input->jump = json_is_true(json_object_get(item, "jump"));
    input->crouch = json_is_true(json_object_get(item, "crouch"));
}

/* "mode": its name; "half_height" with "radius". */
static int read_requests(scene *s, json_t *item, tahr_input *input)
{
    const char *mode = json_string_value(json_object_get(item, "mode"));
    json_t *height = json_object_get(item, "half_height"), *radius = json_object_get(item, "radius");
    while (mode && strcmp(tahr_mode_name(input->mode), mode) != 0) {
        if (strcmp(tahr_mode_name(++input->mode), "?") == 0) {
            return bad(s, "no such mode", mode);
        }
    }
    input->flags |= mode ? (uint32_t)TAHR_INPUT_MODE : 0u;
    input->flags |= height ? (uint32_t)TAHR_INPUT_SHAPE : 0u;
    input->radius = s->config.shape.radius;
    return (!height || scene_number(s, height, &input->half_height)) &&
           (!radius || scene_number(s, radius, &input->radius));
}

/* "move": [x, y, z], or "heading": degrees from +x toward +y with "size" (1). */
int scene_input_read(scene *s, json_t *item, scene_input *in)
{
    json_t *heading = json_object_get(item, "heading"), *move = json_object_get(item, "move");
    double angle = 0, size = 1;
    in->input.struct_size = sizeof in->input;
    read_switches(item, &in->input);
    if (!scene_number(s, json_object_get(item, "at"), &in->time) || !read_vectors(s, item, &in->input) ||
        !read_requests(s, item, &in->input)) {
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

tahr_input scene_input_at(const scene *s, double time)
{
    tahr_input input = {.struct_size = sizeof input};
    for (int i = 0; i < s->input_count && s->inputs[i].time <= time + 1e-9; i++) {
        input = s->inputs[i].input;
        if (time > s->inputs[i].time + 1e-9) {
            input.flags &= ~(uint32_t)(TAHR_INPUT_LAUNCH | TAHR_INPUT_IMPULSE | TAHR_INPUT_MODE);
        }
    }
    return input;
}
