/* SPDX-License-Identifier: MIT
 * calm.c: see calm.h. */
#include "calm.h"

#include "neighbours.h"
#include "short_way.h"
#include "sleep.h"

/* m: bodies that have gone this far in all are no longer followed: a sum like that is right within 0.02 m. */
static const double FARTHEST_DRIFT = 1e14;

/* m: more than all rounding of places within 2e7 m and of such sums. */
static const double SPARE = 0.5;

/* m: farther than anything is from anything in a world of 2e7 m. */
static const double FAR_AND_WIDE = 1e8;

/* As a state is allowed to be. */
static const double FARTHEST_PLACE = 2e7;

/* More than the rounding of a number to single precision, of itself. */
static const double ROUNDED = 1.3e-7;

/* Of tahr__calm.changed. */
enum { SEEN = 1, REVISION = 2 };

/* So many bodies may be looked at in each step, in the mean. */
enum { LOOKED_AT = 64 };

tahr_status tahr__specials_list(tahr_world *world)
{
    const tahr_allocator a = world->host.allocator;
    uint32_t count = 0;
    for (uint32_t i = 0; i < world->body_count; i++) {
        count += (uint32_t)note_is_special(&world->bodies[i]);
    }
    if (count == 0) {
        return TAHR_OK;
    }
    world->specials = a.alloc(a.user, count * sizeof *world->specials, 8);
    if (!world->specials) {
        return TAHR_E_MEMORY;
    }
    for (uint32_t i = 0; i < world->body_count; i++) {
        if (note_is_special(&world->bodies[i])) {
            world->specials[world->special_count++] = i;
        }
    }
    return TAHR_OK;
}

void tahr__specials_free(tahr_world *world)
{
    const tahr_allocator a = world->host.allocator;
    a.free(a.user, world->specials, world->special_count * sizeof *world->specials, 8);
}

/* Before any of them is placed: a body may be named twice, and what counts is where it was. */
void tahr__specials_go(tahr_world *world, const tahr_body_pose *poses, uint32_t count)
{
    double most2 = 0;
    for (uint32_t i = 0; i < count; i++) {
        const tahr__body_note *note = &world->bodies[poses[i].body];
        most2 = max_of(most2, length_squared(sub(poses[i].pose.position, note->pose.position)));
    }
    world->drift += sqrt(most2);
}

/* All that a step may ask about lies within so much of the character, but for its motion: its shape three times over
 * (what it perches on, steps up to or is pushed out of is beside it), and each of the ways that rules look beyond it.
 * */
static double extent_of(const tahr_config *c, const tahr__limits *l)
{
    const double shape = l->around + l->axis + l->shape.half_height + l->width;
    const double rules = c->step_height + c->snap_distance + c->perch_extra + c->max_depenetration + c->edge_tolerance +
                         c->ledge_grab + c->corner_correction;
    return 3 * shape + 2 * (rules + l->beside + l->below + (2 + c->floor_max) * c->skin) + SPARE;
}

void tahr__calm_prepare(tahr_mover *mover)
{
    const tahr_config *c = &mover->config;
    const tahr_world *world = mover->world;
    tahr__calm *calm = &mover->calm;
    const double speed = max_of(c->max_speed, mover->limits.speed) + c->jump_speed + c->wall_jump_speed;
    const double heavier = max_of(max_of(c->jump_release_gravity, c->fall_gravity), 1);
    calm->speed = (float)(speed * (1 + ROUNDED));
    calm->pull = (float)(mover->limits.pull.size * heavier * (1 + ROUNDED));
    calm->room = -1;
    calm->may_go_short_way = (uint8_t)tahr__may_go_short_way(world, c, &mover->limits);
    calm->may = world->specials_known && world->special_count > 0 && c->short_ways && !c->keep_level_speed &&
                !mover->limits.in_plane && mover->pace.upright && !world_is_planar(world);
}

static vec3 place_of(const tahr__calm *calm)
{
    return vec((double)calm->at[0], (double)calm->at[1], (double)calm->at[2]);
}

static void look_for_specials(tahr_mover *mover, vec3 p)
{
    const tahr_world *world = mover->world;
    tahr__calm *calm = &mover->calm;
    double room = FAR_AND_WIDE;
    calm->at[0] = (float)p.x;
    calm->at[1] = (float)p.y;
    calm->at[2] = (float)p.z;
    const vec3 at = place_of(calm);
    for (uint32_t i = 0; i < world->special_count; i++) {
        room = min_of(room, note_gap(world, &world->bodies[world->specials[i]], at));
    }
    room -= extent_of(&mover->config, &mover->limits);
    calm->room = (float)(room - ROUNDED * fabs(room));
    calm->drift = world->drift;
}

/* Is more room left at a place than that? */
static int has_room(const tahr_mover *mover, vec3 p, double reach)
{
    const tahr__calm *calm = &mover->calm;
    return (double)calm->room - (mover->world->drift - calm->drift) - length(sub(p, place_of(calm))) > reach;
}

/* m: all that the motion of a step adds to what it may ask about. What it loses against a wall, turns along a slope or
 * gains by its wish and by gravity is no more than its speed and theirs, and they are taken twice. */
static double reach_of(const tahr_mover *mover, const tahr_state *s, double dt)
{
    return 2 * dt * (length(s->velocity) + (double)mover->calm.speed + (double)mover->calm.pull * dt);
}

/* Is nothing special within all that a step from this state may ask about? False for what is not finite. */
static int nothing_is_near(tahr_mover *mover, const tahr_state *s, double dt)
{
    const tahr_world *world = mover->world;
    tahr__calm *calm = &mover->calm;
    const double reach = reach_of(mover, s, dt);
    if (has_room(mover, s->position, reach)) {
        return 1;
    }
    const int may_be_told =
        world->drift < FARTHEST_DRIFT && length_squared(s->position) <= FARTHEST_PLACE * FARTHEST_PLACE;
    if (!may_be_told || !backoff_tries(&calm->looks)) {
        return 0;
    }
    look_for_specials(mover, s->position);
    const int found = backoff_note(&calm->looks, has_room(mover, s->position, reach));
    calm->looks.rest += world->special_count / LOOKED_AT;
    return found;
}

/* A floor that is said to be special is where the state says that it is, wherever the body may be now. */
static int stands_on_special(const tahr_world *world, const tahr_state *s)
{
    return s->floor.body < world->body_count && note_is_special(&world->bodies[s->floor.body]);
}

/* Nobody watches, and nobody is near whom it would meet. A step under way complains. */
static int may_be_calm(const tahr_mover *mover, double dt, const tahr_state *s, const tahr_report *report)
{
    const int watched = mover->world->recording || (report && (report->decisions || report->queries));
    return dt > 0 && !mover->busy && !watched && !(mover->company && mover->company->neighbours) &&
           (s->mode == TAHR_MODE_WALKING || s->mode == TAHR_MODE_FALLING) && !stands_on_special(mover->world, s);
}

/* Notes what tahr__ride (base_motion.c) notes where nothing carries and nothing comes near: that bodies moved, and that
 * the floor is still the one that it was. */
static void begin(tahr_mover *mover, tahr_state *s)
{
    const tahr_world *world = mover->world;
    tahr__calm *calm = &mover->calm;
    const uint32_t seen = world->moved_count > 0 ? (uint32_t)(world->revision + world->motion) : 0;
    const int moved = world->moved_count > 0 && s->base.seen != seen;
    calm->seen = s->base.seen;
    calm->changed = s->base.seen != seen ? SEEN : 0;
    s->base.seen = seen;
    if (moved && s->floor_revision == world->last_revision && world->last_revision != 0) {
        s->floor_revision = world->revision;
        calm->changed |= (uint8_t)REVISION;
    }
    calm->on = 1;
    mover->pace.bare.seen = seen;
    mover->plain = !mover->limits.feel;
    mover->may_go_short_way = calm->may_go_short_way;
    mover->not_quick = !calm->may_go_short_way;
}

static void end(tahr_mover *mover)
{
    mover->calm.on = mover->calm.changed = 0;
    mover->pace.bare.seen = 0;
    mover->plain = mover->may_go_short_way = 0;
    mover->not_quick = 1;
}

void tahr__calm_quit(tahr_mover *mover, tahr_state *state)
{
    state->base.seen = mover->calm.seen;
    if (mover->calm.changed & REVISION) {
        state->floor_revision = mover->world->last_revision;
    }
    end(mover);
}

tahr_status tahr__step_calmly(tahr_mover *mover, const tahr_input *input, double dt, tahr_state *state,
                              tahr_report *report)
{
    if (!may_be_calm(mover, dt, state, report) || !nothing_is_near(mover, state, dt)) {
        return tahr__step_awake(mover, input, dt, state, report);
    }
    begin(mover, state);
    const tahr_status status = !tahr__is_quick(mover) ? tahr__step_awake(mover, input, dt, state, report)
                               : mover->wide          ? tahr__quick_step_wide(mover, input, dt, state, report)
                                                      : tahr__quick_step(mover, input, dt, state, report);
    if (mover->calm.on && (status < 0 || status == TAHR__STRAYED)) {
        tahr__calm_quit(mover, state);
    } else if (mover->calm.on) {
        end(mover);
        if (report) {
            report->saved[TAHR_SHORTCUT_CALM] = 1;
        }
    }
    return status;
}
