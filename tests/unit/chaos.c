/* SPDX-License-Identifier: MIT
 * chaos.c: see chaos.h. */
#include "chaos.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* What a number is drawn from: [low, high] usually, [least, most] is what config.h allows. */
typedef struct knob {
    size_t offset;
    double low, high, least, most;
} knob;

#define FIELD(name) offsetof(tahr_config, name)

static int one_in(oracle_random *dice, uint32_t n)
{
    return oracle_below(dice, n) == 0;
}

static tahr_shape draw_shape(oracle_random *dice)
{
    double size = one_in(dice, 4) ? oracle_uniform(dice, 0.05, 2) : 0.9, part = oracle_uniform(dice, 0.1, 1);
    switch (oracle_below(dice, 4)) {
    case 0: return (tahr_shape){.type = TAHR_SHAPE_SPHERE, .radius = size / 2, .half_height = size / 2};
    case 1:
        return (tahr_shape){.type = TAHR_SHAPE_BOX, .half_height = size, .half_x = part * size, .half_y = 0.4 * size};
    default: return (tahr_shape){.type = TAHR_SHAPE_CAPSULE, .radius = part * size, .half_height = size};
    }
}

static void draw_methods(tahr_config *c, oracle_random *dice)
{
    uint32_t *methods[] = {&c->integrator,  &c->slide_solver,  &c->separation,
                           &c->floor_probe, &c->depenetration, &c->step_rule};
    uint32_t *switches[] = {
        &c->flat_base,    &c->keep_level_speed,  &c->cached_floor,  &c->walk_off_ledges, &c->walk_off_ledges_crouched,
        &c->apex_substep, &c->jump_hold_gravity, &c->turn_with_base};
    for (size_t i = 0; i < sizeof methods / sizeof methods[0]; i++) {
        *methods[i] = one_in(dice, 2) ? *methods[i] : 1 + oracle_below(dice, 2);
    }
    for (size_t i = 0; i < sizeof switches / sizeof switches[0]; i++) {
        *switches[i] = one_in(dice, 2) ? *switches[i] : oracle_below(dice, 2);
    }
    c->impart = oracle_below(dice, 8);
    c->max_slides = one_in(dice, 4) ? 1 + oracle_below(dice, 16) : c->max_slides;
    c->max_substeps = one_in(dice, 4) ? 1 + oracle_below(dice, 64) : c->max_substeps;
    c->air_jumps = one_in(dice, 2) ? oracle_below(dice, 3) : 0;
    if (one_in(dice, 5)) {
        tahr_vec3 planes[] = {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}, dice_direction(dice)};
        c->plane = planes[oracle_below(dice, 4)];
    }
}

static void draw_numbers(tahr_config *c, oracle_random *dice)
{
    const double h = c->shape.half_height;
    const knob knobs[] = {
        {FIELD(skin), 0.005 * h, 0.03 * h, 1e-5 * h, 0.5 * h},
        {FIELD(pull_back), 1e-4 * h, 5e-3 * h, 1e-6 * h, 0.1 * h},
        {FIELD(max_depenetration), 0, 5, 0, 1e4},
        {FIELD(max_depenetration_character), 0, 2, 0, 1e4},
        {FIELD(mass), 10, 200, 1e-3, 1e6},
        {FIELD(push_force), 0, 2000, 0, 1e9},
        {FIELD(walkable_angle), 0.3, 1.2, 0, 1.5707963267948966},
        {FIELD(floor_max), 1.3, 2, 1, 10},
        {FIELD(step_height), 0.1 * h, h, 0, 2 * h},
        {FIELD(snap_distance), 0, h, 0, 1e3},
        {FIELD(perch_threshold), 0, 0.3 * h, 0, 1e4},
        {FIELD(perch_extra), 0, h, 0, 1e3},
        {FIELD(edge_tolerance), 0, 0.01 * h, 0, 0.5 * h},
        {FIELD(max_speed), 0.5, 12, 0, 1e4},
        {FIELD(acceleration), 1, 60, 0, 1e6},
        {FIELD(turn_friction), 0, 20, 0, 1e4},
        {FIELD(braking_deceleration), 0, 40, 0, 1e6},
        {FIELD(braking_drag), 0, 30, 0, 1e4},
        {FIELD(stop_speed), 0, 0.2, 0, 1e4},
        {FIELD(jump_speed), 0, 10, 0, 1e4},
        {FIELD(jump_hold_time), 0, 0.4, 0, 1e3},
        {FIELD(terminal_speed), 1, 60, 1e-3, 1e4},
        {FIELD(air_control), 0, 1, 0, 100},
        {FIELD(air_boost), 0, 3, 0, 100},
        {FIELD(air_boost_speed), 0, 1, 0, 1e4},
        {FIELD(air_turn_friction), 0, 8, 0, 1e4},
        {FIELD(path_tolerance), 0, 0.1 * h, 0, h},
        {FIELD(arc_tolerance), 1e-4 * h, 0.1 * h, 1e-6 * h, h},
        {FIELD(imparted_half_life), 0, 2, 0, 1e3},
        {FIELD(crouched_half_height), 0.3 * h, h, 1e-6, 1e4},
        {FIELD(crouched_speed), 0, 4, 0, 1e4},
        {FIELD(swim_speed), 0, 6, 0, 1e4},
        {FIELD(swim_immersion), 0.2, 0.9, 0.01, 1},
        {FIELD(buoyancy), 0, 2, 0, 10},
        {FIELD(fluid_friction), 0, 2, 0, 1e4},
        {FIELD(water_exit_speed), 0, 8, 0, 1e4},
        {FIELD(fly_speed), 0, 12, 0, 1e4},
        {FIELD(fly_drag), 0, 2, 0, 1e4},
        {FIELD(coyote_time), 0, 0.3, 0, 1e3},
        {FIELD(jump_buffer), 0, 0.3, 0, 1e3},
        {FIELD(jump_release_gravity), 0.5, 4, 0.1, 100},
        {FIELD(fall_gravity), 0.5, 3, 0.1, 100},
        {FIELD(wall_slide_speed), 0, 3, 0, 1e4},
        {FIELD(wall_jump_speed), 0, 8, 0, 1e4},
        {FIELD(wall_coyote_time), 0, 0.3, 0, 1e3},
        {FIELD(ledge_grab), 0, h, 0, 2 * h},
        {FIELD(corner_correction), 0, h, 0, 2 * h},
        {FIELD(lift_momentum), 0, 0.3, 0, 1e3},
        {FIELD(max_substep), 0.01, 0.1, 1e-3, 10},
        {FIELD(braking_substep), 0.01, 0.1, 1e-3, 10},
        {FIELD(turn_rate), 0, 20, 0, 1e4},
    };
    for (size_t i = 0; i < sizeof knobs / sizeof knobs[0]; i++) {
        double *value = (double *)((char *)c + knobs[i].offset);
        uint32_t way = oracle_below(dice, 64);
        if (way < 24) {
            *value = oracle_uniform(dice, knobs[i].low, knobs[i].high);
        } else if (way < 25) {
            *value = one_in(dice, 2) ? knobs[i].least : knobs[i].most;
        }
    }
    c->floor_target = oracle_uniform(dice, 1, c->floor_max);
    c->walkable_hysteresis = oracle_uniform(dice, 0, fmin(0.05, 1.5707963267948966 - c->walkable_angle));
}

tahr_config chaos_config(oracle_random *dice)
{
    tahr_config c;
    tahr_config_init(&c, sizeof c, one_in(dice, 2) ? TAHR_PRESET_PRECISE : TAHR_PRESET_UNREAL);
    if (!one_in(dice, 3)) {
        tahr_shape own = c.shape;
        c.shape = draw_shape(dice);
        double scale = c.shape.half_height / own.half_height;
        c.skin *= scale, c.pull_back *= scale, c.step_height *= scale, c.edge_tolerance *= scale;
        c.path_tolerance *= scale;
        c.arc_tolerance *= scale;
    }
    draw_methods(&c, dice);
    draw_numbers(&c, dice);
    c.gravity = one_in(dice, 4) ? dice_vec(dice, -12, 12) : c.gravity;
    return c;
}

static void draw_requests(oracle_random *dice, const tahr_config *c, const tahr_state *s, tahr_input *in)
{
    if (one_in(dice, 25) || (s->mode == TAHR_MODE_NONE && one_in(dice, 3))) {
        in->flags |= TAHR_INPUT_MODE;
        in->mode = oracle_below(dice, TAHR_MODE_CUSTOM + 1);
    }
    if (one_in(dice, 20)) {
        in->flags |= TAHR_INPUT_SHAPE;
        in->half_height = c->shape.half_height * oracle_uniform(dice, 0.5, 1.5);
        in->radius = c->shape.type == TAHR_SHAPE_BOX ? 0 : in->half_height * oracle_uniform(dice, 0.1, 1);
        in->radius = c->shape.type == TAHR_SHAPE_SPHERE ? in->half_height : in->radius;
    }
    if (one_in(dice, 20)) {
        double most = one_in(dice, 20) ? 5e4 : 12;
        in->flags |= TAHR_INPUT_LAUNCH;
        in->flags |= one_in(dice, 2) ? (uint32_t)TAHR_INPUT_LAUNCH_LEVEL : 0u;
        in->flags |= one_in(dice, 2) ? (uint32_t)TAHR_INPUT_LAUNCH_UP : 0u;
        in->launch = dice_vec(dice, -most, most);
    }
    if (one_in(dice, 20)) {
        double most = one_in(dice, 20) ? 5e8 : 500;
        in->flags |= TAHR_INPUT_IMPULSE;
        in->impulse = dice_vec(dice, -most, most);
    }
    if (one_in(dice, 12)) {
        double most = one_in(dice, 20) ? 5e4 : 10;
        in->flags |= TAHR_INPUT_DRIVE;
        in->flags |= one_in(dice, 2) ? (uint32_t)TAHR_INPUT_DRIVE_ADD : 0u;
        in->flags |= one_in(dice, 2) ? (uint32_t)TAHR_INPUT_DRIVE_LEVEL : 0u;
        in->drive = dice_vec(dice, -most, most);
    }
}

tahr_input chaos_input(oracle_random *dice, int calm, const tahr_config *config, const tahr_state *state)
{
    tahr_input in = {.struct_size = sizeof in};
    if (!one_in(dice, 6)) {
        in.move = !calm && one_in(dice, 8) ? dice_vec(dice, -1e5, 1e5) : dice_vec(dice, -1, 1);
    }
    in.jump = oracle_below(dice, 4) == 0;
    in.crouch = oracle_below(dice, 6) == 0;
    if (one_in(dice, 3)) {
        in.flags |= TAHR_INPUT_FACING;
        in.facing = one_in(dice, 8) ? (tahr_vec3){0, 0, 0} : dice_vec(dice, -1, 1);
    }
    if (calm && !one_in(dice, 12)) {
        return in;
    }
    if (one_in(dice, 8)) {
        tahr_vec3 up = state->up;
        tahr_vec3 pulls[] = {{0, 0, 0},
                             {0, 0, 9.81},
                             {9.81 * up.x, 9.81 * up.y, 9.81 * up.z},
                             dice_vec(dice, -15, 15),
                             dice_vec(dice, -1e-9, 1e-9),
                             dice_vec(dice, -5e3, 5e3)};
        in.flags |= TAHR_INPUT_GRAVITY;
        in.gravity = pulls[oracle_below(dice, 6)];
    }
    draw_requests(dice, config, state, &in);
    return in;
}

double chaos_dt(oracle_random *dice, const tahr_config *config)
{
    static const double usual[] = {1.0 / 60, 1.0 / 60, 1.0 / 30, 1.0 / 144, 1.0 / 1000, 0.1};
    uint32_t way = oracle_below(dice, 100);
    if (way < 4) {
        const double odd[] = {0, 1e-10, 1e-9, config->max_dt};
        return odd[way];
    }
    return way < 60 ? usual[oracle_below(dice, 6)] : pow(10, oracle_uniform(dice, -4, log10(0.2)));
}

static tahr_body_desc *put(chaos_scene *s, uint32_t at, uint32_t type, tahr_vec3 place, tahr_vec3 half)
{
    tahr_body_desc *b = &s->bodies[at];
    tahr_body_desc_init(b, sizeof *b, type);
    b->pose.position = place;
    b->half_extents = half;
    b->radius = half.x;
    b->half_height = half.z;
    return b;
}

static void put_hills(chaos_scene *s, oracle_random *dice)
{
    for (uint32_t i = 0; i < 13 * 13; i++) {
        s->vertices[3 * i] = i % 13 - 6.0;
        s->vertices[3 * i + 1] = i / 13 - 6.0;
        s->vertices[3 * i + 2] = oracle_uniform(dice, -0.3, 0.3);
    }
    for (uint32_t i = 0; i < 12 * 12; i++) {
        uint32_t a = i / 12 * 13 + i % 12;
        const uint32_t quad[6] = {a, a + 1, a + 14, a, a + 14, a + 13};
        memcpy(s->indices + 6 * i, quad, sizeof quad);
    }
    tahr_body_desc *b = put(s, CHAOS_MOVABLES, TAHR_BODY_MESH, (tahr_vec3){0, 0, -3.8}, (tahr_vec3){0, 0, 0});
    b->vertices = s->vertices;
    b->vertex_count = 13 * 13;
    b->indices = s->indices;
    b->triangle_count = 12 * 12 * 2;
    b->flags = one_in(dice, 2) ? (uint32_t)TAHR_BODY_TWO_SIDED : 0u;
}

static tahr_quat draw_turn(oracle_random *dice, double most)
{
    tahr_vec3 axis = dice_direction(dice);
    double sine = sin(oracle_uniform(dice, 0, most) / 2);
    return (tahr_quat){axis.x * sine, axis.y * sine, axis.z * sine, sqrt(1 - sine * sine)};
}

/* The first are movable: lifts, tumbling boxes, fluids, sensors, a character, a conveyor. */
static void put_movables(chaos_scene *s, oracle_random *dice, int fluids)
{
    for (uint32_t i = 0; i < CHAOS_MOVABLES; i++) {
        static const uint32_t types[] = {TAHR_BODY_BOX, TAHR_BODY_BOX, TAHR_BODY_SPHERE, TAHR_BODY_CAPSULE};
        tahr_vec3 half = dice_vec(dice, 0.2, 1.5);
        uint32_t type = i < 3 ? (uint32_t)TAHR_BODY_BOX : types[oracle_below(dice, 4)];
        half = i < 3 ? (tahr_vec3){1.5, 1.5, 0.2} : half;
        half.x = type == TAHR_BODY_CAPSULE && half.x > half.z ? half.z : half.x;
        s->homes[i] = dice_vec(dice, -6, 6);
        s->homes[i].z = 0.5 * s->homes[i].z;
        tahr_body_desc *b = put(s, i, type, s->homes[i], half);
        b->pose.orientation = i < 3 ? b->pose.orientation : draw_turn(dice, 3);
        b->flags = TAHR_BODY_MOVABLE;
        b->flags |= i >= 12 ? (i < 15 && fluids ? (uint32_t)TAHR_BODY_FLUID : (uint32_t)TAHR_BODY_SENSOR) : 0u;
        b->fluid_friction = i == 13 ? 3 : 0;
        b->mass = i >= 6 && i < 10 ? oracle_uniform(dice, 1, 500) : 0;
        b->surface_velocity = i == 3 || i == 12 ? dice_vec(dice, -3, 3) : (tahr_vec3){0, 0, 0};
        b->flags |= i == 4 ? (uint32_t)TAHR_BODY_NO_BASE : 0u;
        b->flags |= i == 5 ? (uint32_t)TAHR_BODY_NO_STEP : 0u;
        b->flags |= i == 10 ? (uint32_t)TAHR_BODY_CHARACTER : 0u;
        s->poses[i] = (tahr_body_pose){i, 0, b->pose};
    }
}

void chaos_build(chaos_scene *s, oracle_random *dice, int fluids)
{
    const double w = 8, h = 4, t = 0.5;
    const tahr_vec3 walls[6][2] = {{{0, 0, -h - t}, {w + 1, w + 1, t}}, {{0, 0, h + t}, {w + 1, w + 1, t}},
                                   {{w + t, 0, 0}, {t, w + 1, h + 1}},  {{-w - t, 0, 0}, {t, w + 1, h + 1}},
                                   {{0, w + t, 0}, {w + 1, t, h + 1}},  {{0, -w - t, 0}, {w + 1, t, h + 1}}};
    memset(s, 0, sizeof *s);
    put_movables(s, dice, fluids);
    put_hills(s, dice);
    uint32_t at = CHAOS_MOVABLES + 1;
    for (int i = 0; i < 6; i++) {
        put(s, at++, TAHR_BODY_BOX, walls[i][0], walls[i][1]);
    }
    while (at < CHAOS_BODIES) { /* what stands about; the last are sensors in a heap, more than a state remembers */
        static const uint32_t types[] = {TAHR_BODY_BOX, TAHR_BODY_SPHERE, TAHR_BODY_CAPSULE};
        tahr_vec3 half = dice_vec(dice, 0.3, 1.2), place = dice_vec(dice, -7, 7);
        int heap = at + 5 >= CHAOS_BODIES;
        half.z += half.x;
        place.z = place.z / 2 - 1;
        place = heap ? (tahr_vec3){3, 3, -2} : place;
        tahr_body_desc *b = put(s, at, types[oracle_below(dice, 3)], place, half);
        b->flags = heap ? TAHR_BODY_SENSOR : 0;
        b->pose.orientation = draw_turn(dice, one_in(dice, 2) ? 0.5 : 3);
        b->walkable_rule = oracle_below(dice, 4);
        b->walkable_angle = oracle_uniform(dice, 0, 1.5);
        b->surface_velocity = at % 3 == 0 ? dice_vec(dice, -2, 2) : (tahr_vec3){0, 0, 0};
        b->mass = at % 3 == 1 ? oracle_uniform(dice, 1, 100) : 0;
        b->surface = at++;
    }
}

static tahr_quat product(tahr_quat a, tahr_quat b)
{
    tahr_quat q = {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
                   a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
    double size = sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    return (tahr_quat){q.x / size, q.y / size, q.z / size, q.w / size};
}

uint32_t chaos_drift(chaos_scene *s, oracle_random *dice, double dt, tahr_body_pose *moves)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < CHAOS_MOVABLES; i++) {
        tahr_body_pose *p = &s->poses[i];
        uint32_t way = oracle_below(dice, 40);
        double speed = one_in(dice, 10) ? 50 : 3;
        if (way >= 30) { /* rests */
            continue;
        }
        p->flags = 0;
        tahr_vec3 v = dice_vec(dice, -speed, speed), at = p->pose.position, home = s->homes[i];
        if (i < 3) { /* lifts */
            v.x = v.y = 0;
        }
        at = (tahr_vec3){at.x + (v.x + home.x - at.x) * dt, at.y + (v.y + home.y - at.y) * dt,
                         at.z + (v.z + home.z - at.z) * dt};
        p->pose.position = at;
        if (way < 1) {
            p->flags = TAHR_POSE_TELEPORT;
            p->pose.position = dice_vec(dice, -5, 5);
        }
        if (i >= 3 && way < 20) {
            p->pose.orientation = product(draw_turn(dice, fmin(6 * dt, 3)), p->pose.orientation);
        }
        moves[count++] = *p;
        p->flags = 0;
    }
    return count;
}

tahr_vec3 chaos_flat(tahr_vec3 v)
{
    return (tahr_vec3){v.x, v.z, 0};
}

/* The part of a turn that is about z; of capsules after the quarter turn about x that lays their axis into the
 * plane. */
static tahr_quat flat_turn(tahr_quat q, int capsule)
{
    static const double QUARTER = 0.70710678118654752440;
    const tahr_quat laid = {QUARTER, 0, 0, QUARTER}, raised = {-QUARTER, 0, 0, QUARTER};
    q = capsule ? product(q, raised) : q;
    double size = sqrt(q.z * q.z + q.w * q.w);
    q = size > 1e-6 ? (tahr_quat){0, 0, q.z / size, q.w / size} : (tahr_quat){0, 0, 0, 1};
    return capsule ? product(q, laid) : q;
}

/* Faces up: its front is on the right hand of who goes along it. */
static void flatten_hills(chaos_scene *s)
{
    tahr_body_desc *b = &s->bodies[CHAOS_MOVABLES];
    for (uint32_t i = 0; i < 13; i++) {
        s->vertices[3 * i] = 6.0 - i;
        s->vertices[3 * i + 1] = s->vertices[3 * i + 2];
        s->vertices[3 * i + 2] = 0;
    }
    b->type = TAHR_BODY_CHAIN;
    b->vertex_count = 13;
    b->triangle_count = 0;
    b->indices = NULL;
}

void chaos_flatten(chaos_scene *s)
{
    enum { FRONT = CHAOS_MOVABLES + 5, BEHIND = FRONT + 1 };
    flatten_hills(s);
    for (uint32_t i = 0; i < CHAOS_BODIES; i++) {
        tahr_body_desc *b = &s->bodies[i];
        int solid = (b->flags & (TAHR_BODY_SENSOR | TAHR_BODY_FLUID)) == 0;
        b->pose.position = chaos_flat(b->pose.position);
        b->pose.orientation = flat_turn(b->pose.orientation, b->type == TAHR_BODY_CAPSULE);
        b->half_extents = (tahr_vec3){b->half_extents.x, b->half_extents.z, b->half_extents.y};
        b->surface_velocity = chaos_flat(b->surface_velocity);
        b->pose.position.x += i == FRONT || i == BEHIND ? 100 : 0;
        b->flags |= solid && (i == 1 || i == 7 || (i > BEHIND && i % 3 == 0)) ? (uint32_t)TAHR_BODY_ONE_WAY : 0u;
        if (i < CHAOS_MOVABLES) {
            s->homes[i] = b->pose.position;
            s->poses[i].pose = b->pose;
        }
    }
}

void chaos_flatten_moves(chaos_scene *s, tahr_body_pose *moves, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        tahr_pose *p = &moves[i].pose;
        p->position = (tahr_vec3){p->position.x, p->position.y + p->position.z, 0}; /* lifts move along z */
        p->orientation = flat_turn(p->orientation, s->bodies[moves[i].body].type == TAHR_BODY_CAPSULE);
        s->poses[moves[i].body].pose = *p;
    }
}
