/* SPDX-License-Identifier: MIT
 * config.c: the presets, scaling, and the check of every field. */
#include <string.h>
#include <tahr/config.h>

#include "shape.h"
#include "sized.h"
#include "vec.h"

static const double DEGREE = 0.017453292519943295;

static void precise(tahr_config *c)
{
    c->shape.type = TAHR_SHAPE_CAPSULE;
    c->shape.radius = 0.35;
    c->shape.half_height = 0.9;
    c->mask = 0xFFFFFFFFu;
    c->max_slides = 8;
    c->skin = 0.01;
    c->max_depenetration = 1.0;
    c->walkable_angle = 50 * DEGREE;
    c->walkable_hysteresis = 1 * DEGREE;
    c->floor_target = 1.25;
    c->floor_max = 1.5;
    c->step_height = 0.4;
    c->snap_distance = 0.4;
    c->perch_threshold = 0.15;
    c->perch_extra = 0.4;
    c->edge_tolerance = 1e-4;
    c->cached_floor = 1;
    c->walk_off_ledges = 1;
    c->max_speed = 6;
    c->acceleration = 20.48;
    c->turn_friction = 8;
    c->braking_deceleration = 20.48;
    c->braking_drag = 16;
    c->gravity = vec(0, 0, -9.81);
    c->jump_speed = 4.2;
    c->jump_hold_time = 0;
    c->terminal_speed = 40;
    c->air_control = 0.25;
    c->air_turn_friction = 0;
    c->arc_tolerance = 0.001;
    c->max_dt = 1;
    c->turn_rate = 12.5;
    c->sleep = 1;
}

tahr_status tahr_config_init(tahr_config *config, size_t size, int32_t preset)
{
    tahr_config c;
    if (!config) {
        return TAHR_E_NULL;
    }
    if (size < sizeof c) {
        return TAHR_E_STRUCT_SIZE;
    }
    if (preset != TAHR_PRESET_PRECISE) {
        return TAHR_E_ARGUMENT;
    }
    memset(config, 0, size);
    memset(&c, 0, sizeof c);
    precise(&c);
    c.struct_size = (uint32_t)size;
    c.preset = (uint32_t)preset;
    memcpy(config, &c, sizeof c);
    return TAHR_OK;
}

const char *tahr_preset_name(int32_t preset)
{
    return preset == TAHR_PRESET_PRECISE ? "precise" : "?";
}

tahr_status tahr_config_scale(tahr_config *config, double factor)
{
    tahr_status status = tahr_config_check(config, NULL);
    if (status < 0) {
        return status;
    }
    if (!is_finite(factor) || factor <= 0) {
        return TAHR_E_ARGUMENT;
    }
    tahr_config c;
    memcpy(&c, config, sizeof c);
    double *lengths[] = {
        &c.shape.radius,      &c.shape.half_height, &c.shape.half_x,  &c.shape.half_y,    &c.skin,
        &c.max_depenetration, &c.step_height,       &c.snap_distance, &c.perch_threshold, &c.perch_extra,
        &c.edge_tolerance,    &c.arc_tolerance,     &c.max_speed,     &c.acceleration,    &c.braking_deceleration,
        &c.jump_speed,        &c.terminal_speed,    &c.gravity.x,     &c.gravity.y,       &c.gravity.z};
    for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; i++) {
        *lengths[i] *= factor;
    }
    c.struct_size = sizeof c;
    status = tahr_config_check(&c, NULL);
    if (status < 0) {
        return status;
    }
    c.struct_size = config->struct_size;
    memcpy(config, &c, sizeof c);
    return TAHR_OK;
}

typedef struct range {
    const char *name;
    double value, low, high;
} range;

static const char *bad_range(const range *ranges, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (!(ranges[i].value >= ranges[i].low && ranges[i].value <= ranges[i].high)) { /* NaN fails too */
            return ranges[i].name;
        }
    }
    return NULL;
}

const char *tahr__shape_check(const tahr_shape *s)
{
    const double tiny = 1e-6, huge = 1e4;
    if (s->reserved != 0) {
        return "shape.reserved";
    }
    if (s->type == TAHR_SHAPE_BOX) {
        const range ranges[] = {{"shape.half_x", s->half_x, tiny, huge},
                                {"shape.half_y", s->half_y, tiny, huge},
                                {"shape.half_height", s->half_height, tiny, huge},
                                {"shape.radius", s->radius, 0, 0}};
        return bad_range(ranges, sizeof ranges / sizeof ranges[0]);
    }
    if (s->type != TAHR_SHAPE_SPHERE && s->type != TAHR_SHAPE_CAPSULE) {
        return "shape.type";
    }
    const range ranges[] = {
        {"shape.radius", s->radius, tiny, huge},
        {"shape.half_height", s->half_height, s->radius, s->type == TAHR_SHAPE_SPHERE ? s->radius : huge}};
    return bad_range(ranges, sizeof ranges / sizeof ranges[0]);
}

static const char *bad_field(const tahr_config *c)
{
    const double size = c->shape.half_height;
    const double quarter = 1.5707963267948966;
    const range ranges[] = {{"preset", c->preset, TAHR_PRESET_PRECISE, TAHR_PRESET_PRECISE},
                            {"max_slides", c->max_slides, 1, 16},
                            {"skin", c->skin, 1e-5 * size, 0.5 * size},
                            {"max_depenetration", c->max_depenetration, 0, 1e4},
                            {"walkable_angle", c->walkable_angle, 0, quarter},
                            {"walkable_hysteresis", c->walkable_hysteresis, 0, quarter - c->walkable_angle},
                            {"floor_target", c->floor_target, 1, c->floor_max},
                            {"floor_max", c->floor_max, 1, 10},
                            {"step_height", c->step_height, 0, 2 * size},
                            {"snap_distance", c->snap_distance, 0, 1e3},
                            {"perch_threshold", c->perch_threshold, 0, 1e4},
                            {"perch_extra", c->perch_extra, 0, 1e3},
                            {"edge_tolerance", c->edge_tolerance, 0, 0.5 * size},
                            {"cached_floor", c->cached_floor, 0, 1},
                            {"walk_off_ledges", c->walk_off_ledges, 0, 1},
                            {"max_speed", c->max_speed, 0, 1e4},
                            {"acceleration", c->acceleration, 0, 1e6},
                            {"turn_friction", c->turn_friction, 0, 1e4},
                            {"braking_deceleration", c->braking_deceleration, 0, 1e6},
                            {"braking_drag", c->braking_drag, 0, 1e4},
                            {"gravity.x", c->gravity.x, -1e4, 1e4},
                            {"gravity.y", c->gravity.y, -1e4, 1e4},
                            {"gravity.z", c->gravity.z, -1e4, 1e4},
                            {"jump_speed", c->jump_speed, 0, 1e4},
                            {"jump_hold_time", c->jump_hold_time, 0, 1e3},
                            {"terminal_speed", c->terminal_speed, 1e-3, 1e4},
                            {"air_control", c->air_control, 0, 100},
                            {"air_turn_friction", c->air_turn_friction, 0, 1e4},
                            {"arc_tolerance", c->arc_tolerance, 1e-6 * size, size},
                            {"max_dt", c->max_dt, 1e-6, 10},
                            {"turn_rate", c->turn_rate, 0, 1e4},
                            {"sleep", c->sleep, 0, 1},
                            {"reserved", c->reserved, 0, 0}};
    const char *bad = tahr__shape_check(&c->shape);
    return bad ? bad : bad_range(ranges, sizeof ranges / sizeof ranges[0]);
}

tahr_status tahr_config_check(const tahr_config *config, const char **field)
{
    tahr_status status = tahr__sized_check(config, sizeof *config);
    if (status < 0) {
        return status;
    }
    const char *bad = bad_field(config);
    if (field) {
        *field = bad;
    }
    return bad ? TAHR_E_ARGUMENT : TAHR_OK;
}
