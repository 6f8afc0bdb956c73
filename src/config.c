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
    c->integrator = TAHR_INTEGRATOR_EXACT;
    c->slide_solver = TAHR_SLIDE_JOINT;
    c->separation = TAHR_SEPARATION_MARGIN;
    c->floor_probe = TAHR_FLOOR_PROBE_WHOLE;
    c->depenetration = TAHR_DEPENETRATION_JOINT;
    c->step_rule = TAHR_STEP_BY_TREAD;
    c->mask = 0xFFFFFFFFu;
    c->max_slides = 8;
    c->skin = 0.01;
    c->pull_back = 0.001;
    c->max_depenetration = 1.0;
    c->max_depenetration_character = 1.0;
    c->mass = 80;
    c->push_force = 500;
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
    c->barred_steps = 1;
    c->walk_off_ledges = 1;
    c->walk_off_ledges_crouched = 1;
    c->max_speed = 6;
    c->acceleration = 20.48;
    c->turn_friction = 8;
    c->braking_deceleration = 20.48;
    c->braking_drag = 16;
    c->gravity = vec(0, 0, -9.81);
    c->jump_speed = 4.2;
    c->terminal_speed = 40;
    c->air_control = 0.25;
    c->air_boost = 1;
    c->arc_tolerance = 0.001;
    c->path_tolerance = 0.002;
    c->apex_substep = 1;
    c->impart = TAHR_IMPART_LEVEL | TAHR_IMPART_UP | TAHR_IMPART_TURN;
    c->turn_with_base = 1;
    c->crouched_half_height = 0.55;
    c->crouched_speed = 3;
    c->swim_speed = 3;
    c->swim_immersion = 0.65;
    c->buoyancy = 1;
    c->fluid_friction = 0.3;
    c->water_exit_speed = 5.5;
    c->fly_speed = 6;
    c->fly_drag = 0.15;
    c->jump_release_gravity = 1;
    c->fall_gravity = 1;
    c->max_dt = 1;
    c->max_substep = 0.05;
    c->braking_substep = 1.0 / 33;
    c->max_substeps = 8;
    c->sleep = 1;
    c->short_ways = 1;
    c->turn_rate = 12.5;
}

/* Where it differs. Lengths and speeds in SI; the field's own numbers are in centimetres. */
static void unreal(tahr_config *c)
{
    c->shape.radius = 0.34;
    c->shape.half_height = 0.88;
    c->integrator = TAHR_INTEGRATOR_STEPPED;
    c->slide_solver = TAHR_SLIDE_TWO_WALLS;
    c->separation = TAHR_SEPARATION_PULL_BACK;
    c->floor_probe = TAHR_FLOOR_PROBE_SHRUNK;
    c->depenetration = TAHR_DEPENETRATION_SINGLE;
    c->step_rule = TAHR_STEP_BY_CONTACT;
    c->keep_level_speed = 1;
    c->skin = 0.019; /* MIN_FLOOR_DIST 1.9 cm, MAX_FLOOR_DIST 2.4, and their mean */
    c->floor_target = 2.15 / 1.9;
    c->floor_max = 2.4 / 1.9;
    c->max_depenetration = 5.0;
    c->mass = 100;
    c->walkable_angle = 0.781298117448725; /* acos(0.71) = 44.765 degrees, rounded up: 0.71 itself is walkable */
    c->walkable_hysteresis = 0;
    c->step_height = 0.45;
    c->snap_distance = 0.45;
    c->perch_threshold = 0;
    c->edge_tolerance = 0.0015; /* SWEEP_EDGE_REJECT_DISTANCE */
    c->cached_floor = 0;
    c->walk_off_ledges_crouched = 0;
    c->stop_speed = 0.1; /* BRAKE_TO_STOP_VELOCITY */
    c->gravity = vec(0, 0, -9.8);
    c->water_exit_speed = 4.2;
    c->air_control = 0.05;
    c->air_boost = 2;
    c->air_boost_speed = 0.25;
    c->jump_hold_gravity = 1;
    c->crouched_half_height = 0.4;
    c->turn_rate = 6.283185307179586;
}

/* PRECISE in a plane of constant z, for a character of 1.8 m among tiles of 1 m. A jump is 2.06 m high, two tiles, and
 * rises for 0.46 s: v^2 / 2g and v / g; published platformers lie between 0.3 and 0.5 s. Coyote times in use are 0.08
 * to 0.15 s, buffers 0.1 to 0.2 s. Crouched it fits under one tile. */
static void platformer(tahr_config *c)
{
    c->plane = vec(0, 0, 1);
    c->gravity = vec(0, -19.62, 0);
    c->jump_speed = 9;
    c->acceleration = 40;
    c->braking_deceleration = 40;
    c->air_control = 1;
    c->terminal_speed = 25;
    c->coyote_time = 0.1;
    c->jump_buffer = 0.12;
    c->jump_release_gravity = 3;
    c->fall_gravity = 1.5;
    c->wall_slide_speed = 3;
    c->wall_jump_speed = 6;
    c->wall_coyote_time = 0.1;
    c->corner_correction = 0.25;
    c->lift_momentum = 0.1;
    c->crouched_half_height = 0.45;
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
    if (preset < TAHR_PRESET_PRECISE || preset > TAHR_PRESET_PLATFORMER) {
        return TAHR_E_ARGUMENT;
    }
    memset(config, 0, size);
    memset(&c, 0, sizeof c);
    precise(&c);
    if (preset == TAHR_PRESET_UNREAL) {
        unreal(&c);
    }
    if (preset == TAHR_PRESET_PLATFORMER) {
        platformer(&c);
    }
    c.struct_size = (uint32_t)size;
    c.preset = (uint32_t)preset;
    memcpy(config, &c, sizeof c);
    return TAHR_OK;
}

const char *tahr_preset_name(int32_t preset)
{
    static const char *const names[] = {"?", "precise", "unreal", "platformer"};
    return preset >= TAHR_PRESET_PRECISE && preset <= TAHR_PRESET_PLATFORMER ? names[preset] : "?";
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
    double *lengths[] = {&c.shape.radius,
                         &c.shape.half_height,
                         &c.shape.half_x,
                         &c.shape.half_y,
                         &c.skin,
                         &c.pull_back,
                         &c.max_depenetration,
                         &c.max_depenetration_character,
                         &c.step_height,
                         &c.snap_distance,
                         &c.perch_threshold,
                         &c.perch_extra,
                         &c.edge_tolerance,
                         &c.path_tolerance,
                         &c.arc_tolerance,
                         &c.max_speed,
                         &c.acceleration,
                         &c.braking_deceleration,
                         &c.stop_speed,
                         &c.jump_speed,
                         &c.terminal_speed,
                         &c.air_boost_speed,
                         &c.gravity.x,
                         &c.gravity.y,
                         &c.gravity.z,
                         &c.crouched_half_height,
                         &c.crouched_speed,
                         &c.swim_speed,
                         &c.water_exit_speed,
                         &c.fly_speed,
                         &c.wall_slide_speed,
                         &c.wall_jump_speed,
                         &c.ledge_grab,
                         &c.corner_correction};
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
    const double tiny = TAHR__THINNEST, huge = 1e4;
    if (s->hull != 0 && s->type != TAHR_SHAPE_HULL) {
        return "shape.hull";
    }
    if (s->type < TAHR_SHAPE_SPHERE || s->type > TAHR_SHAPE_HULL) {
        return "shape.type";
    }
    if (s->type == TAHR_SHAPE_BOX || s->type == TAHR_SHAPE_ELLIPSOID || s->type == TAHR_SHAPE_HULL) {
        const range ranges[] = {{"shape.half_x", s->half_x, tiny, huge},
                                {"shape.half_y", s->half_y, tiny, huge},
                                {"shape.half_height", s->half_height, tiny, huge},
                                {"shape.radius", s->radius, 0, 0}};
        return bad_range(ranges, sizeof ranges / sizeof ranges[0]);
    }
    const int round = s->type == TAHR_SHAPE_SPHERE || s->type == TAHR_SHAPE_CAPSULE;
    const range ranges[] = {{"shape.radius", s->radius, tiny, huge},
                            {"shape.half_height", s->half_height, round ? s->radius : tiny,
                             s->type == TAHR_SHAPE_SPHERE ? s->radius : huge}};
    return bad_range(ranges, sizeof ranges / sizeof ranges[0]);
}

static const char *bad_method(const tahr_config *c)
{
    const range ranges[] = {{"preset", c->preset, TAHR_PRESET_PRECISE, TAHR_PRESET_PLATFORMER},
                            {"integrator", c->integrator, 1, TAHR_INTEGRATOR_STEPPED},
                            {"slide_solver", c->slide_solver, 1, TAHR_SLIDE_TWO_WALLS},
                            {"separation", c->separation, 1, TAHR_SEPARATION_PULL_BACK},
                            {"floor_probe", c->floor_probe, 1, TAHR_FLOOR_PROBE_SHRUNK},
                            {"depenetration", c->depenetration, 1, TAHR_DEPENETRATION_SINGLE},
                            {"step_rule", c->step_rule, 1, TAHR_STEP_BY_CONTACT},
                            {"flat_base", c->flat_base, 0, 1},
                            {"keep_level_speed", c->keep_level_speed, 0, 1}};
    return bad_range(ranges, sizeof ranges / sizeof ranges[0]);
}

static const char *bad_contact_field(const tahr_config *c)
{
    const double size = c->shape.half_height;
    const double quarter = 1.5707963267948966;
    const double plane = length_squared(c->plane);
    const range ranges[] = {{"max_slides", c->max_slides, 1, 16},
                            {"skin", c->skin, 1e-5 * size, 0.5 * size},
                            {"pull_back", c->pull_back, 1e-6 * size, 0.1 * size},
                            {"path_tolerance", c->path_tolerance, 0, size},
                            {"max_depenetration", c->max_depenetration, 0, 1e4},
                            {"max_depenetration_character", c->max_depenetration_character, 0, 1e4},
                            {"plane", plane, plane == 0 ? 0 : 1 - 1e-9, 1 + 1e-9},
                            {"mass", c->mass, 1e-3, 1e6},
                            {"push_force", c->push_force, 0, 1e9},
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
                            {"walk_off_ledges_crouched", c->walk_off_ledges_crouched, 0, 1},
                            {"barred_steps", c->barred_steps, 0, 1}};
    return bad_range(ranges, sizeof ranges / sizeof ranges[0]);
}

static const char *bad_motion_field(const tahr_config *c)
{
    const double size = c->shape.half_height;
    const range ranges[] = {{"max_speed", c->max_speed, 0, 1e4},
                            {"acceleration", c->acceleration, 0, 1e6},
                            {"turn_friction", c->turn_friction, 0, 1e4},
                            {"braking_deceleration", c->braking_deceleration, 0, 1e6},
                            {"braking_drag", c->braking_drag, 0, 1e4},
                            {"stop_speed", c->stop_speed, 0, 1e4},
                            {"gravity.x", c->gravity.x, -1e4, 1e4},
                            {"gravity.y", c->gravity.y, -1e4, 1e4},
                            {"gravity.z", c->gravity.z, -1e4, 1e4},
                            {"jump_speed", c->jump_speed, 0, 1e4},
                            {"jump_hold_time", c->jump_hold_time, 0, 1e3},
                            {"terminal_speed", c->terminal_speed, 1e-3, 1e4},
                            {"air_control", c->air_control, 0, 100},
                            {"air_boost", c->air_boost, 0, 100},
                            {"air_boost_speed", c->air_boost_speed, 0, 1e4},
                            {"air_turn_friction", c->air_turn_friction, 0, 1e4},
                            {"arc_tolerance", c->arc_tolerance, 1e-6 * size, size},
                            {"jump_hold_gravity", c->jump_hold_gravity, 0, 1},
                            {"apex_substep", c->apex_substep, 0, 1},
                            {"max_dt", c->max_dt, 1e-6, 10},
                            {"max_substep", c->max_substep, 1e-3, 10},
                            {"braking_substep", c->braking_substep, 1e-3, 10},
                            {"max_substeps", c->max_substeps, 1, 64},
                            {"sleep", c->sleep, 0, 1},
                            {"short_ways", c->short_ways, 0, 1},
                            {"turn_rate", c->turn_rate, 0, 1e4}};
    return bad_range(ranges, sizeof ranges / sizeof ranges[0]);
}

static const char *bad_mode_field(const tahr_config *c)
{
    const double size = c->shape.half_height;
    const range ranges[] = {{"impart", c->impart, 0, TAHR_IMPART_LEVEL | TAHR_IMPART_UP | TAHR_IMPART_TURN},
                            {"turn_with_base", c->turn_with_base, 0, 1},
                            {"imparted_half_life", c->imparted_half_life, 0, 1e3},
                            {"crouched_half_height", c->crouched_half_height, 1e-6, 1e4},
                            {"crouched_speed", c->crouched_speed, 0, 1e4},
                            {"swim_speed", c->swim_speed, 0, 1e4},
                            {"swim_immersion", c->swim_immersion, 0.01, 1},
                            {"buoyancy", c->buoyancy, 0, 10},
                            {"fluid_friction", c->fluid_friction, 0, 1e4},
                            {"water_exit_speed", c->water_exit_speed, 0, 1e4},
                            {"fly_speed", c->fly_speed, 0, 1e4},
                            {"fly_drag", c->fly_drag, 0, 1e4},
                            {"coyote_time", c->coyote_time, 0, 1e3},
                            {"jump_buffer", c->jump_buffer, 0, 1e3},
                            {"jump_release_gravity", c->jump_release_gravity, 0.1, 100},
                            {"fall_gravity", c->fall_gravity, 0.1, 100},
                            {"wall_slide_speed", c->wall_slide_speed, 0, 1e4},
                            {"wall_jump_speed", c->wall_jump_speed, 0, 1e4},
                            {"wall_coyote_time", c->wall_coyote_time, 0, 1e3},
                            {"ledge_grab", c->ledge_grab, 0, 2 * size},
                            {"corner_correction", c->corner_correction, 0, 2 * size},
                            {"lift_momentum", c->lift_momentum, 0, 1e3},
                            {"air_jumps", c->air_jumps, 0, 1000},
                            {"reserved_feel", c->reserved_feel, 0, 0}};
    return bad_range(ranges, sizeof ranges / sizeof ranges[0]);
}

static const char *bad_field(const tahr_config *c)
{
    const char *bad = tahr__shape_check(&c->shape);
    bad = bad ? bad : bad_method(c);
    bad = bad ? bad : bad_contact_field(c);
    bad = bad ? bad : bad_motion_field(c);
    return bad ? bad : bad_mode_field(c);
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
