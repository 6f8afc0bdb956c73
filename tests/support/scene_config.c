/* SPDX-License-Identifier: MIT
 * scene_config.c: reads the settings of a scene: a preset, and what differs from it. */
#include "scene_config.h"

#include <stdio.h>
#include <string.h>

#define FIELD(kind, name)                        \
    {                                            \
#name, offsetof(tahr_config, name), kind \
    }

enum { REAL, WORD };

static const struct {
    const char *name;
    size_t offset;
    int kind;
} FIELDS[] = {
    FIELD(REAL, skin),
    FIELD(REAL, pull_back),
    FIELD(REAL, max_depenetration),
    FIELD(REAL, max_depenetration_character),
    FIELD(REAL, mass),
    FIELD(REAL, push_force),
    FIELD(REAL, walkable_angle),
    FIELD(REAL, walkable_hysteresis),
    FIELD(REAL, floor_target),
    FIELD(REAL, floor_max),
    FIELD(REAL, step_height),
    FIELD(REAL, snap_distance),
    FIELD(REAL, perch_threshold),
    FIELD(REAL, perch_extra),
    FIELD(REAL, edge_tolerance),
    FIELD(REAL, max_speed),
    FIELD(REAL, acceleration),
    FIELD(REAL, turn_friction),
    FIELD(REAL, braking_deceleration),
    FIELD(REAL, braking_drag),
    FIELD(REAL, stop_speed),
    FIELD(REAL, jump_speed),
    FIELD(REAL, jump_hold_time),
    FIELD(REAL, terminal_speed),
    FIELD(REAL, air_control),
    FIELD(REAL, air_boost),
    FIELD(REAL, air_boost_speed),
    FIELD(REAL, air_turn_friction),
    FIELD(REAL, path_tolerance),
    FIELD(REAL, arc_tolerance),
    FIELD(REAL, imparted_half_life),
    FIELD(REAL, crouched_half_height),
    FIELD(REAL, crouched_speed),
    FIELD(REAL, swim_speed),
    FIELD(REAL, swim_immersion),
    FIELD(REAL, buoyancy),
    FIELD(REAL, fluid_friction),
    FIELD(REAL, water_exit_speed),
    FIELD(REAL, fly_speed),
    FIELD(REAL, fly_drag),
    FIELD(REAL, coyote_time),
    FIELD(REAL, jump_buffer),
    FIELD(REAL, jump_release_gravity),
    FIELD(REAL, fall_gravity),
    FIELD(REAL, wall_slide_speed),
    FIELD(REAL, wall_jump_speed),
    FIELD(REAL, wall_coyote_time),
    FIELD(REAL, ledge_grab),
    FIELD(REAL, corner_correction),
    FIELD(REAL, lift_momentum),
    FIELD(REAL, max_dt),
    FIELD(REAL, max_substep),
    FIELD(REAL, braking_substep),
    FIELD(REAL, turn_rate),
    FIELD(WORD, integrator),
    FIELD(WORD, slide_solver),
    FIELD(WORD, separation),
    FIELD(WORD, floor_probe),
    FIELD(WORD, depenetration),
    FIELD(WORD, step_rule),
    FIELD(WORD, flat_base),
    FIELD(WORD, keep_level_speed),
    FIELD(WORD, max_slides),
    FIELD(WORD, cached_floor),
    FIELD(WORD, walk_off_ledges),
    FIELD(WORD, walk_off_ledges_crouched),
    FIELD(WORD, jump_hold_gravity),
    FIELD(WORD, apex_substep),
    FIELD(WORD, impart),
    FIELD(WORD, turn_with_base),
    FIELD(WORD, air_jumps),
    FIELD(WORD, max_substeps),
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

/* "shape": "capsule", "box" (as wide and high as the preset's capsule) or "sphere" (of its radius); other fields may
 * change it afterwards. */
static int read_shape(scene *s, json_t *value)
{
    tahr_shape *shape = &s->config.shape;
    const double r = shape->radius, h = shape->half_height;
    const char *name = json_string_value(value);
    name = name ? name : "?";
    if (strcmp(name, "box") == 0) {
        *shape = (tahr_shape){.type = TAHR_SHAPE_BOX, .half_height = h, .half_x = r, .half_y = r};
    } else if (strcmp(name, "sphere") == 0) {
        *shape = (tahr_shape){.type = TAHR_SHAPE_SPHERE, .radius = r, .half_height = r};
    } else if (strcmp(name, "capsule") != 0) {
        return bad(s, "no such shape", name);
    }
    return 1;
}

static int read_field(scene *s, const char *name, json_t *value)
{
    size_t i = 0, count = sizeof FIELDS / sizeof FIELDS[0];
    double number;
    while (i < count && strcmp(FIELDS[i].name, name) != 0) {
        i++;
    }
    if (i == count) {
        return bad(s, "no such config field", name);
    }
    if (!scene_number(s, value, &number)) {
        return 0;
    }
    char *at = (char *)&s->config + FIELDS[i].offset;
    if (FIELDS[i].kind == REAL) {
        memcpy(at, &number, sizeof number);
    } else {
        uint32_t word = (uint32_t)number;
        memcpy(at, &word, sizeof word);
    }
    return 1;
}

int scene_config_read(scene *s)
{
    json_t *value, *config = json_object_get(s->root, "config");
    const char *name, *field = NULL, *preset = json_string_value(json_object_get(config, "preset"));
    int32_t id = TAHR_PRESET_PRECISE;
    while (preset && strcmp(tahr_preset_name(id), preset) != 0) {
        if (strcmp(tahr_preset_name(++id), "?") == 0) {
            return bad(s, "no such preset", preset);
        }
    }
    tahr_config_init(&s->config, sizeof s->config, id);
    json_object_foreach(config, name, value)
    {
        int known =
            strcmp(name, "preset") == 0 || (strcmp(name, "shape") == 0     ? read_shape(s, value)
                                            : strcmp(name, "plane") == 0   ? scene_vec3(s, value, &s->config.plane)
                                            : strcmp(name, "gravity") == 0 ? scene_vec3(s, value, &s->config.gravity)
                                                                           : read_field(s, name, value));
        if (!known) {
            return 0;
        }
    }
    return tahr_config_check(&s->config, &field) == TAHR_OK
               ? 1
               : bad(s, "rejected by tahr_config_check", field ? field : "?");
}
