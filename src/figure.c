/* SPDX-License-Identifier: MIT
 * figure.c: what a character may reach in a tick, and how a plane divides the room between two.
 *
 * Two shapes on different sides of a plane do not meet. Any plane between them does; where it lies decides how it feels.
 * In the middle, who follows another would keep two steps' distance, and who lands on a head would float over it for
 * some ticks. So each gets what its velocity asks for and half of the rest, or, where there is less, as large a part of
 * it as its wish is of both wishes. */
#include "figure.h"

#include "apart.h"
#include "body_motion.h"

/* Of a length, m: room for rounding of what is foreseen. */
static const double FORESEEN = 1e-6;

static double speed_of(const tahr_config *c, const tahr_input *input, const tahr_state *s)
{
    double v = max_of(length(s->velocity), max_of(c->max_speed, c->jump_speed));
    v = max_of(v, s->mode == TAHR_MODE_FLYING ? c->fly_speed : (s->mode == TAHR_MODE_SWIMMING ? c->swim_speed : 0));
    if (input->flags & TAHR_INPUT_LAUNCH) {
        v += length(input->launch);
    }
    if (input->flags & TAHR_INPUT_IMPULSE) {
        v += length(input->impulse) / c->mass;
    }
    if (input->flags & TAHR_INPUT_DRIVE) {
        v += length(input->drive);
    }
    return v + length(s->base.velocity); /* of a base that it may leave */
}

/* Where what it stands on has carried it, as base_motion.c will. */
static vec3 carried(const tahr_world *world, const tahr_state *s)
{
    const tahr_floor *floor = &s->floor;
    const vec3 foot = add_scaled(s->position, s->up, -s->half_height);
    tahr_body_motion motion;
    tahr_pose from = s->base.pose;
    uint32_t body = s->base.body;
    if (body == TAHR_NO_BODY) { /* what it stands on may have begun to move */
        if (s->mode != TAHR_MODE_WALKING || floor->body >= world->body_count || world->bodies[floor->body].dt == 0 ||
            (world->bodies[floor->body].flags & TAHR_BODY_NO_BASE)) {
            return s->position;
        }
        body = floor->body;
        from = world->bodies[body].before;
    }
    if (tahr__body_motion(world, body, &motion) < 0 || motion.teleported) {
        return s->position;
    }
    return add(s->position, sub(tahr__carried(world, &from, &motion.pose, foot), foot));
}

static vec3 absolute(vec3 v)
{
    return vec(fabs(v.x), fabs(v.y), fabs(v.z));
}

static vec3 extents(const tahr__figure *f)
{
    const tahr__solid solid = {&f->shape, f->up, f->orientation};
    const vec3 x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1};
    if (f->shape.type == TAHR_SHAPE_CAPSULE || f->shape.type == TAHR_SHAPE_SPHERE) {
        const double r = f->shape.radius, half = f->shape.half_height - r;
        vec3 axis = scale(absolute(f->up), half);
        return add(axis, vec(r, r, r));
    }
    double ex = max_of(tahr__support(&solid, x), tahr__support(&solid, scale(x, -1)));
    double ey = max_of(tahr__support(&solid, y), tahr__support(&solid, scale(y, -1)));
    double ez = max_of(tahr__support(&solid, z), tahr__support(&solid, scale(z, -1)));
    return vec(ex, ey, ez);
}

void tahr__figure_of(tahr__figure *f, const tahr_mover *mover, const tahr_member *member, const tahr_input *input,
                     const tahr_state *s, double dt)
{
    const tahr_config *c = &mover->config;
    const int walks = s->mode == TAHR_MODE_WALKING;
    const double fall = walks ? 0 : mover->limits.pull.size * dt;
    double level = speed_of(c, input, s) * dt + (4 * c->skin + FORESEEN);
    double high = 0.5 * fall * dt + (walks ? max_of(c->step_height, c->snap_distance) : 0);
    f->at = s->base.body == TAHR_NO_BODY && mover->world->moved_count == 0 ? s->position : carried(mover->world, s);
    f->up = s->up;
    f->orientation = s->orientation;
    f->shape = c->shape;
    f->shape.radius = s->radius;
    f->shape.half_height = s->half_height;
    f->reach = add_scaled(vec(level, level, level), absolute(s->up), high);
    f->half_skin = c->separation == TAHR_SEPARATION_MARGIN ? 0.5 * c->skin : 0;
    f->box = add_scaled(add(extents(f), f->reach), vec(1, 1, 1), f->half_skin);
    f->way = add_scaled(scale(s->velocity, dt), walks ? vec(0, 0, 0) : s->up, -0.5 * fall * dt);
    f->mass = c->mass;
    f->id = member->id;
    f->groups = member->groups ? member->groups : 1;
    f->mask = member->flags & TAHR_MEMBER_ALONE ? 0 : (member->mask ? member->mask : ~0u);
    f->escaped = 0;
    f->extra = 0;
}

/* m of the gap that are a's. n points from b to a. */
static double share(const tahr__figure *a, const tahr__figure *b, vec3 n, double gap)
{
    const double skins = a->half_skin + b->half_skin, room = gap - skins;
    if (gap < 0) { /* each leaves by its part of the depth */
        return gap * b->mass / (a->mass + b->mass);
    }
    if (room <= 0) {
        return skins > 0 ? gap * a->half_skin / skins : 0.5 * gap;
    }
    const double wish_a = max_of(-dot(a->way, n), 0), wish_b = max_of(dot(b->way, n), 0);
    const double left = room - wish_a - wish_b;
    return a->half_skin + (left >= 0 ? wish_a + 0.5 * left : room * wish_a / (wish_a + wish_b));
}

/* How far it may go along n. */
static double reach_along(const tahr__figure *f, vec3 n)
{
    return dot(f->reach, absolute(n));
}

int tahr__figure_plane(const tahr__figure *self, const tahr__figure *other, int again, int flat,
                       tahr__neighbour *plane)
{
    /* Both compute the same: the one with the smaller id comes first. */
    const int first = self->id < other->id;
    const tahr__figure *a = first ? self : other, *b = first ? other : self;
    const tahr__solid sa = {&a->shape, a->up, a->orientation}, sb = {&b->shape, b->up, b->orientation};
    const tahr__apart apart = tahr__apart_of(&sa, &sb, sub(a->at, b->at), a->id * 31 + b->id, flat);
    const vec3 n = apart.normal;
    const double reach_a = reach_along(a, n), reach_b = reach_along(b, n);
    const int foreseen = apart.gap <= reach_a + reach_b + (a->half_skin + b->half_skin);
    double mine = share(a, b, n, apart.gap);
    if (!foreseen && !again) {
        return 0;
    }
    if (!foreseen && !(a->escaped && b->escaped)) { /* the other does not know: it may be anywhere within its reach */
        mine = a->escaped ? apart.gap - reach_b - b->half_skin : reach_a + a->half_skin;
    } else if (!foreseen) {
        mine = 0.5 * apart.gap;
    }
    /* From here on seen from b's centre, along n: a begins at apart.extent + apart.gap. What self keeps its whole skin
     * from lies half a skin behind the plane; where they overlap it is the plane itself. */
    const double at = apart.extent + apart.gap - mine, behind = apart.gap < 0 ? 0 : self->half_skin;
    plane->normal = first ? n : scale(n, -1);
    plane->offset = (first ? at - dot(n, sub(a->at, b->at)) : -at) - behind;
    plane->body = TAHR_CHARACTER_BODY + other->id;
    plane->reserved = 0;
    return 1;
}
