/* SPDX-License-Identifier: MIT
 * limits.c: what follows from a config, a shape and a gravity. */
#include "limits.h"

#include "elementary.h"
#include "foot.h"
#include "plane.h"
#include "shape.h"

tahr__pull tahr__pull_of(vec3 gravity)
{
    double size = length(gravity);
    tahr__pull pull = {gravity, size, size > 0 ? scale(gravity, -1.0 / size) : vec(0, 0, 0)};
    return pull;
}

static uint32_t feel_of(const tahr_config *c)
{
    int walls = c->wall_slide_speed > 0 || c->wall_jump_speed > 0;
    int jumps = c->coyote_time > 0 || c->jump_buffer > 0 || c->air_jumps > 0 || c->jump_release_gravity != 1;
    uint32_t feel = jumps || walls || c->ledge_grab > 0 ? TAHR__FEEL_JUMPS : 0;
    feel |= c->jump_release_gravity != 1 || c->fall_gravity != 1 ? TAHR__FEEL_GRAVITY : 0;
    feel |= walls || c->ledge_grab > 0 ? TAHR__FEEL_WALLS : 0;
    feel |= c->ledge_grab > 0 ? TAHR__FEEL_EDGES : 0;
    return feel | (c->corner_correction > 0 ? TAHR__FEEL_CORNERS : 0);
}

tahr__limits tahr__limits_of(const tahr_config *c, const tahr_shape *s, uint32_t capabilities)
{
    tahr__limits limits;
    double sine;
    limits.shape = *s;
    limits.beside = 4 * c->skin;
    limits.below = c->snap_distance + c->perch_extra;
    limits.usual = c->integrator == TAHR_INTEGRATOR_EXACT && c->slide_solver == TAHR_SLIDE_JOINT &&
                   c->separation == TAHR_SEPARATION_MARGIN && c->depenetration == TAHR_DEPENETRATION_JOINT;
    tahr__sincos(c->walkable_angle, &sine, &limits.walkable);
    tahr__sincos(c->walkable_angle + c->walkable_hysteresis, &sine, &limits.walkable_hysteresis);
    limits.width = shape_width(s);
    limits.around = shape_is_square(s) ? sqrt(s->half_x * s->half_x + s->half_y * s->half_y) : limits.width;
    limits.speed = s->half_height < c->shape.half_height ? c->crouched_speed : c->max_speed;
    limits.axis = s->half_height - (s->type <= TAHR_SHAPE_CAPSULE ? s->radius : 0);
    limits.plane = unit(c->plane);
    limits.in_plane = length_squared(c->plane) > 0;
    limits.pull = tahr__pull_of(along_plane(&limits, c->gravity));
    limits.foot = tahr__foot_of(s, capabilities);
    limits.feel = feel_of(c);
    limits.decay = (tahr__decay){0, 0};
    return limits;
}
