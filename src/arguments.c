/* SPDX-License-Identifier: MIT
 * arguments.c: the checks of what a step is given. */
#include "arguments.h"

#include <string.h>

#include "message.h"
#include "modes.h"
#include "shape.h"
#include "sized.h"

/* False too for what is not finite: its square is not either. */
static int is_within(vec3 v, double most)
{
    return length_squared(v) <= most * most;
}

/* The fields that only count with their flags. */
static const char *bad_request(const tahr_input *in, const tahr_shape *shape)
{
    tahr_shape asked = *shape;
    asked.radius = in->radius;
    asked.half_height = in->half_height;
    const uint32_t known = (TAHR_INPUT_DROP << 1) - 1;
    if (in->flags & ~known) {
        return "input.flags";
    }
    if ((in->flags & TAHR_INPUT_MODE) && !tahr__is_mode(in->mode)) {
        return "input.mode";
    }
    if ((in->flags & TAHR_INPUT_SHAPE) && !(in->half_height >= 1e-6 && in->half_height <= 1e4)) {
        return "input.half_height";
    }
    if ((in->flags & TAHR_INPUT_SHAPE) && shape->type == TAHR_SHAPE_HULL && asked.half_height != shape->half_height) {
        return "input.half_height"; /* its vertices do not change */
    }
    if ((in->flags & TAHR_INPUT_SHAPE) && tahr__shape_check(&asked)) { /* of boxes 0, of spheres the half height */
        return "input.radius";
    }
    if ((in->flags & TAHR_INPUT_LAUNCH) && !is_within(in->launch, 1e5)) {
        return "input.launch";
    }
    if ((in->flags & TAHR_INPUT_IMPULSE) && !is_within(in->impulse, 1e9)) {
        return "input.impulse";
    }
    return (in->flags & TAHR_INPUT_DRIVE) && !is_within(in->drive, 1e5) ? "input.drive" : NULL;
}

static const char *bad_input(const tahr_input *in, const tahr_shape *shape)
{
    if (!is_within(in->move, 1e6)) {
        return "input.move";
    }
    if ((in->flags & TAHR_INPUT_FACING) && !is_within(in->facing, 1e6)) {
        return "input.facing";
    }
    if ((in->flags & TAHR_INPUT_GRAVITY) && !is_within(in->gravity, 1e4)) {
        return "input.gravity";
    }
    if (in->reserved) {
        return "input.reserved";
    }
    return in->flags & ~(uint32_t)(TAHR_INPUT_GRAVITY | TAHR_INPUT_FACING) ? bad_request(in, shape) : NULL;
}

static int all_zero(const uint8_t tail[sizeof((tahr_state *)0)->reserved])
{
    uint64_t any = 0, word;
    for (size_t at = 0; at < sizeof((tahr_state *)0)->reserved; at += sizeof word) {
        memcpy(&word, tail + at, sizeof word);
        any |= word;
    }
    return any == 0;
}

/* Normals are unit, or zero where there is no floor; the rest lies within the world, and a little beyond. A sum of
 * squares hides nothing. */
static const char *bad_floor(const tahr_state *s)
{
    const double unit2 = 1 + 1e-6, far2 = 1e16; /* m2: five times the farthest position */
    const tahr_floor *f = &s->floor;
    double normals = length_squared(f->normal) + length_squared(f->surface_normal);
    double places = length_squared(f->point) + length_squared(s->floor_position);
    places += f->distance * f->distance + f->perch_distance * f->perch_distance;
    const double least2 = f->flags & TAHR_FLOOR_WALKABLE ? 1 - 1e-6 : 0;
    if (normals <= 2 * unit2 && normals >= 2 * least2 && places <= far2 && s->jump_hold >= 0 && s->jump_hold <= 1e6) {
        return NULL;
    }
    if (!(length_squared(f->normal) <= unit2 && length_squared(f->normal) >= least2)) {
        return "state.floor.normal";
    }
    if (!(length_squared(f->surface_normal) <= unit2 && length_squared(f->surface_normal) >= least2)) {
        return "state.floor.surface_normal";
    }
    if (!is_within(f->point, 1e8)) {
        return "state.floor.point";
    }
    if (!is_within(s->floor_position, 1e8)) {
        return "state.floor_position";
    }
    if (!(s->jump_hold >= 0 && s->jump_hold <= 1e6)) {
        return "state.jump_hold";
    }
    if (!(f->perch_distance * f->perch_distance <= far2)) {
        return "state.floor.perch_distance";
    }
    return f->distance * f->distance <= far2 ? NULL : "state.floor.distance";
}

static const char *bad_shape(const tahr_state *s, const tahr_shape *shape)
{
    tahr_shape own = *shape;
    if (s->radius == shape->radius && s->half_height == shape->half_height) {
        return NULL;
    }
    own.radius = s->radius;
    own.half_height = s->half_height;
    if (!tahr__shape_check(&own) && shape->type != TAHR_SHAPE_HULL) {
        return NULL;
    }
    return s->radius == shape->radius ? "state.half_height" : "state.radius";
}

static int is_time(double t)
{
    return t >= 0 && t <= 1e6;
}

/* What a state remembers beyond where it is. */
static const char *bad_memory(const tahr_state *s)
{
    const tahr_base *b = &s->base;
    const vec3 p = b->pose.position, v = b->velocity, n = s->wall_normal;
    const tahr_quat q = b->pose.orientation;
    double q2 = (q.x * q.x + q.y * q.y) + (q.z * q.z + q.w * q.w);
    if (!is_within(p, 2e7) || !(q2 > 1 - 1e-6 && q2 < 1 + 1e-6)) {
        return "state.base.pose";
    }
    if (!is_within(v, 1e6)) {
        return "state.base.velocity";
    }
    if (!(length_squared(n) <= 1 + 1e-6)) {
        return "state.wall_normal";
    }
    if (s->touched_count > TAHR_MAX_TOUCHED) {
        return "state.touched_count";
    }
    if (!is_time(s->coyote_left) || !is_time(s->buffer_left)) {
        return is_time(s->coyote_left) ? "state.buffer_left" : "state.coyote_left";
    }
    if (!is_time(s->lift_left) || !is_time(s->wall_left)) {
        return is_time(s->lift_left) ? "state.wall_left" : "state.lift_left";
    }
    return NULL;
}

static const char *bad_state(const tahr_state *s, const tahr_shape *shape)
{
    tahr_quat q = s->orientation;
    double q2 = (q.x * q.x + q.y * q.y) + (q.z * q.z + q.w * q.w);
    double up2 = length_squared(s->up);
    if (!is_within(s->position, 2e7)) {
        return "state.position";
    }
    if (!is_within(s->velocity, 1e5)) {
        return "state.velocity";
    }
    if (!(q2 > 1 - 1e-6 && q2 < 1 + 1e-6)) {
        return "state.orientation";
    }
    if (!(up2 > 1 - 1e-9 && up2 < 1 + 1e-9)) {
        return "state.up";
    }
    if (!shape_is_round(shape) && !(dot(rotate(s->orientation, vec(0, 0, 1)), s->up) > 1 - 1e-6)) {
        return "state.orientation";
    }
    if (!tahr__is_mode(s->mode)) {
        return "state.mode";
    }
    const uint32_t flags = (TAHR_STATE_DROP_HELD << 1) - 1;
    if (s->flags & ~flags) {
        return "state.flags";
    }
    return bad_floor(s);
}

static const char *bad_rest(const tahr_state *s, const tahr_mover *mover)
{
    if (!all_zero(s->reserved)) {
        return "state.reserved";
    }
    const char *bad = bad_shape(s, &mover->config.shape);
    return bad ? bad : bad_memory(s);
}

/* In a world of two dimensions: what a state brings with it that a step would have to leave the plane for. */
static const char *out_of_plane(const tahr_state *s)
{
    if (s->up.z != 0) {
        return "state.up";
    }
    if (s->floor.normal.z != 0 || s->floor.surface_normal.z != 0) {
        return s->floor.normal.z != 0 ? "state.floor.normal" : "state.floor.surface_normal";
    }
    if (s->wall_normal.z != 0) {
        return "state.wall_normal";
    }
    return s->base.velocity.z != 0 ? "state.base.velocity" : NULL;
}

tahr_status tahr__check_arguments(const tahr_mover *mover, const tahr_input *input, double dt, const tahr_state *state,
                                  const tahr_report *report)
{
    const tahr_log *log = &mover->world->log;
    tahr_status status = tahr__sized_check(input, sizeof *input);
    if (status < 0) {
        return tahr__complain(log, status, "tahr_mover_step", "input:", tahr_status_message(status));
    }
    if (report) {
        uint32_t size;
        memcpy(&size, report, sizeof size);
        if (size < sizeof *report || size > sizeof *report + TAHR__MOST_UNKNOWN) {
            return tahr__complain(log, TAHR_E_STRUCT_SIZE, "tahr_mover_step",
                                  "report:", tahr_status_message(TAHR_E_STRUCT_SIZE));
        }
    }
    if (!(dt >= 0 && dt <= mover->config.max_dt)) {
        return tahr__complain_value(log, TAHR_E_ARGUMENT, "tahr_mover_step", "dt", dt,
                                    "must be within 0 and config.max_dt");
    }
    const char *bad = bad_input(input, &mover->config.shape);
    bad = bad ? bad : bad_state(state, &mover->config.shape);
    bad = bad ? bad : bad_rest(state, mover);
    if (bad) {
        return tahr__complain(log, TAHR_E_ARGUMENT, "tahr_mover_step", bad, "is out of range or not finite");
    }
    bad = world_is_planar(mover->world) ? out_of_plane(state) : NULL;
    return bad ? tahr__complain(log, TAHR_E_ARGUMENT, "tahr_mover_step", bad, TAHR__NO_Z) : TAHR_OK;
}
