/* SPDX-License-Identifier: MIT
 * figure.c: what a character may reach in a tick, and how a plane divides the room between two.
 *
 * Two shapes on different sides of a plane do not meet. Any plane between them does; where it lies decides how it
 * feels. In the middle, who follows another would keep two steps' distance, and who lands on a head would float over it
 * for some ticks. So each gets what its velocity asks for and half of the rest, or, where there is less, as large a
 * part of it as its wish is of both wishes. */
#include "figure.h"

#include "apart.h"
#include "body_motion.h"
#include "shape.h"

/* Of a length, m: room for rounding of what is foreseen. */
static const double FORESEEN = 1e-6;

static vec3 absolute(vec3 v)
{
    return vec(fabs(v.x), fabs(v.y), fabs(v.z));
}

/* No less than its length, for three additions. */
static double size_of(vec3 v)
{
    return fabs(v.x) + fabs(v.y) + fabs(v.z);
}

/* Is the state good enough to be seen by others? Comparisons with a NaN are false; of what is not finite here the box
 * is not. */
static int is_visible(const tahr_shape *shape, const tahr_state *s)
{
    const double up = length_squared(s->up) - 1;
    if (!(up < 1e-6 && up > -1e-6 && s->radius >= 0 && s->half_height > 0)) {
        return 0;
    }
    const tahr_quat q = s->orientation;
    const double turn = shape_is_round(shape) ? 0 : (q.x * q.x + q.y * q.y) + (q.z * q.z + q.w * q.w) - 1;
    return turn < 1e-6 && turn > -1e-6;
}

/* What it was asked for. */
static double asked_speed(const tahr_config *c, const tahr_input *input)
{
    double v = 0;
    if (input->flags & TAHR_INPUT_LAUNCH) {
        v += length(input->launch);
    }
    if (input->flags & TAHR_INPUT_IMPULSE) {
        v += length(input->impulse) / c->mass;
    }
    if (input->flags & TAHR_INPUT_DRIVE) {
        v += length(input->drive);
    }
    return v;
}

static double speed_of(const tahr_config *c, const tahr_input *input, const tahr_state *s)
{
    double v = max_of(c->max_speed, c->jump_speed);
    const double now2 = length_squared(s->velocity);
    if (!(now2 <= v * v)) { /* else its root is no more than v: rounding keeps the order, and roots of squares */
        v = sqrt(now2);
    }
    if (s->mode != TAHR_MODE_WALKING) {
        v = max_of(v, max_of(c->fly_speed, c->swim_speed));
    }
    if (input->flags) {
        v += asked_speed(c, input);
    }
    return s->base.body == TAHR_NO_BODY ? v : v + size_of(s->base.velocity); /* of a base that it may leave */
}

/* Where what it stands on will carry it (base_motion.c). */
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

static tahr_shape shape_of(const tahr_mover *mover, const tahr_state *s)
{
    tahr_shape shape = mover->config.shape;
    shape.radius = s->radius;
    shape.half_height = s->half_height;
    return shape;
}

/* The largest that it may be within the tick: grown, turned about its axis. m across its axis, along it (beyond the
 * former), how much farther its centre may go for that, and how much farther than now any point of it may lie from
 * there. */
typedef struct size {
    double around, along, grows, swell;
} size;

static size largest(const tahr_shape *shape, const tahr_input *input, const tahr_state *s)
{
    double r = max_of(s->radius, shape->radius), h = max_of(s->half_height, shape->half_height);
    if (input->flags & TAHR_INPUT_SHAPE) {
        r = max_of(r, input->radius);
        h = max_of(h, input->half_height);
    }
    size z = {.around = r, .along = h, .grows = h - s->half_height};
    z.swell = z.grows + (r - s->radius);
    if (shape->type == TAHR_SHAPE_CAPSULE || shape->type == TAHR_SHAPE_SPHERE) {
        z.along = h - r;
    } else if (r == 0) {
        z.around = sqrt(shape->half_x * shape->half_x + shape->half_y * shape->half_y);
        z.swell += z.around - min_of(shape->half_x, shape->half_y);
    }
    if (input->flags & TAHR_INPUT_GRAVITY) { /* it may turn any way, about its foot */
        z = (size){.around = z.around + h, .grows = z.grows + h, .swell = z.around + h};
    }
    return z;
}

static double half_skin_of(const tahr_config *c)
{
    return c->separation == TAHR_SEPARATION_MARGIN ? 0.5 * c->skin : 0;
}

/* m/s that gravity adds in dt. */
static double fall_of(const tahr_mover *mover, const tahr_state *s, double dt)
{
    return s->mode == TAHR_MODE_WALKING ? 0 : mover->limits.pull.size * dt;
}

void tahr__figure_of(tahr__figure *f, const tahr_mover *mover, const tahr_input *input, const tahr_state *s, double dt)
{
    const tahr_config *c = &mover->config;
    const tahr_world *world = mover->world;
    f->flags = f->range.bound = 0;
    f->range.extra = 0;
    if (!is_visible(&c->shape, s)) {
        return;
    }
    const size z = largest(&c->shape, input, s);
    const double level = speed_of(c, input, s) * dt + (4 * c->skin + FORESEEN), fall = fall_of(mover, s, dt);
    const double high =
        z.grows + (s->mode == TAHR_MODE_WALKING ? max_of(c->step_height, c->snap_distance) : 0.5 * fall * dt);
    f->swell = z.swell;
    const double wide = z.around + level + half_skin_of(c), tall = z.along + high;
    const double x = fabs(s->up.x), y = fabs(s->up.y), u = fabs(s->up.z);
    f->range.at = world->moved_count == 0 && s->base.body == TAHR_NO_BODY ? s->position : carried(world, s);
    f->range.reach = vec(level + x * high, level + y * high, level + u * high);
    f->box = vec(wide + x * tall, wide + y * tall, wide + u * tall);
    const vec3 at = f->range.at;
    const int there = f->mask != 0 && is_finite(wide + tall) && length_squared(at) <= 1e15; /* 2e7 m, and carried */
    f->range.bound = (uint32_t)there;
    f->flags = there ? (uint32_t)TAHR__FIGURE_THERE : 0u;
}

void tahr__look_of(tahr__look *look, const tahr_mover *mover, const tahr_state *s, double dt)
{
    look->up = s->up;
    look->orientation = s->orientation;
    look->shape = shape_of(mover, s);
    look->way = add_scaled(scale(s->velocity, dt), s->up, -0.5 * fall_of(mover, s, dt) * dt);
    look->half_skin = half_skin_of(&mover->config);
    look->mass = mover->config.mass;
}

/* m of the gap that are a's. n points from b to a. */
static double share(const tahr__look *a, const tahr__look *b, vec3 n, double gap)
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

/* How far any part of it may come along n. */
static double reach_along(const tahr__figure *f, vec3 n)
{
    return dot(f->range.reach, absolute(n)) + f->swell;
}

/* m; who overlaps by less is not pushed out: twice what neighbours.c takes for a touch. */
static const double TOUCHING = 2e-7;

/* Of their skins: nobody comes as near as this to another one by himself. */
static const double TIGHT = 0.95;

/* Steeper than this, cosine, is beside and not over: 50 degrees, what can be walked on. */
static const double OVER = 0.64;

static tahr__apart between(tahr__party a, tahr__party b, vec3 c, uint32_t rules)
{
    const tahr__solid sa = {&a.look->shape, a.look->up, a.look->orientation};
    const tahr__solid sb = {&b.look->shape, b.look->up, b.look->orientation};
    tahr__apart apart = tahr__apart_of(&sa, &sb, c, (rules & TAHR__PAIR_FLAT) != 0);
    const double over = dot(apart.normal, a.look->up);
    if (rules & TAHR__PAIR_LEVEL_HEADS && fabs(over) > OVER) {
        tahr__apart level = tahr__apart_along(&sa, &sb, c, over < 0 ? scale(a.look->up, -1) : a.look->up);
        apart = level.gap >= 0 ? level : apart;
    }
    return apart;
}

int tahr__figure_plane(tahr__party self, tahr__party other, uint32_t rules, tahr__neighbour *plane)
{
    /* Both compute the same: the one with the smaller id comes first. */
    const int first = self.figure->id < other.figure->id;
    const tahr__party a = first ? self : other, b = first ? other : self;
    const vec3 c = sub(a.figure->range.at, b.figure->range.at);
    const tahr__apart apart = between(a, b, c, rules);
    const vec3 n = apart.normal;
    const double reach_a = reach_along(a.figure, n), reach_b = reach_along(b.figure, n);
    const double skin_a = a.look->half_skin, skin_b = b.look->half_skin;
    const int foreseen = apart.gap <= reach_a + reach_b + (skin_a + skin_b);
    double mine = share(a.look, b.look, n, apart.gap); /* a's */
    if (!foreseen && !(rules & TAHR__PAIR_AGAIN)) {
        return 0;
    }
    if (!foreseen && !(a.figure->flags & b.figure->flags & TAHR__FIGURE_STRAYED)) {
        /* The other does not know: it may be anywhere within its reach. */
        mine = a.figure->flags & TAHR__FIGURE_STRAYED ? apart.gap - reach_b - skin_b : reach_a + skin_a;
    } else if (!foreseen) {
        mine = 0.5 * apart.gap;
    }
    /* From here on seen from b's centre, along n: a begins at apart.extent + apart.gap. What self keeps its whole skin
     * from lies half a skin behind the plane; where they overlap it is the plane itself. */
    const double at = apart.extent + apart.gap - mine, behind = apart.gap < 0 ? 0 : self.look->half_skin;
    plane->normal = first ? n : scale(n, -1);
    plane->offset = (first ? at - dot(n, c) : -at) - behind;
    plane->behind = behind;
    plane->give = 0;
    if (apart.gap > -TOUCHING && apart.gap < TIGHT * (skin_a + skin_b)) {
        const double other_mass = other.look->mass;
        plane->give = (2 * (skin_a + skin_b) - apart.gap) * other_mass / (self.look->mass + other_mass);
    }
    plane->body = TAHR_CHARACTER_BODY + other.figure->id;
    plane->reserved = 0;
    return 1;
}

void tahr__figure_wall(tahr__party self, const tahr__figure *other, uint32_t rules, tahr__neighbour *plane)
{
    const tahr_shape box = {
        .type = TAHR_SHAPE_BOX, .half_x = other->box.x, .half_y = other->box.y, .half_height = other->box.z};
    const tahr__solid mine = {&self.look->shape, self.look->up, self.look->orientation};
    const tahr__solid its = {&box, vec(0, 0, 1), (tahr_quat){0, 0, 0, 1}};
    const vec3 c = sub(self.figure->range.at, other->range.at);
    const tahr__apart apart = tahr__apart_of(&mine, &its, c, (rules & TAHR__PAIR_FLAT) != 0);
    plane->normal = apart.normal;
    plane->offset = apart.extent - dot(apart.normal, c) - self.look->half_skin;
    plane->behind = self.look->half_skin;
    plane->give = 0;
    plane->body = TAHR_CHARACTER_BODY + other->id;
    plane->reserved = 0;
}

double tahr__figure_away(const tahr__look *look, const tahr__neighbour *plane)
{
    const tahr__solid solid = {&look->shape, look->up, look->orientation};
    return -tahr__support(&solid, scale(plane->normal, -1)) - plane->offset;
}
