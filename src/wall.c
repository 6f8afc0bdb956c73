/* SPDX-License-Identifier: MIT
 * wall.c: walls met in the air: what counts as one, how long it is touched, and the memory of the one jumped off. */
#include "wall.h"

#include <string.h>

#include "query.h"
#include "report.h"

/* sin 15 degrees: a wall leans no more than this, either way. */
static const double LEAN = 0.25881904510252074;

/* cos 30 degrees: walls that face alike. A round pillar that is slid around stays one. */
static const double ALIKE = 0.8660254037844386;

/* Of skin: up to here a wall is touched. What walks beside it keeps no less than 1 and stays within it without a
 * push. */
static const double TOUCHED = 1.5;

int tahr__is_wall(const tahr__step *step, vec3 normal)
{
    double up = dot(normal, step->state.up);
    return up >= -LEAN && up <= LEAN;
}

vec3 tahr__facing_of(const tahr__step *step, vec3 normal)
{
    return add(unit(step_level(step, normal)), vec(0, 0, 0)); /* -0.0 + 0.0 is 0.0 */
}

static int faces_alike(const tahr__step *step, vec3 facing)
{
    return dot(step->state.wall_normal, facing) > ALIKE;
}

static int is_spent(const tahr__step *step, vec3 facing)
{
    return step->state.flags & TAHR_STATE_WALL_SPENT && faces_alike(step, facing);
}

static void remember(tahr__step *step, vec3 facing, uint32_t body, uint32_t feature)
{
    step->state.wall_normal = facing;
    step->state.wall_body = body;
    step->state.wall_feature = feature;
}

void tahr__touch_wall(tahr__step *step, const tahr_hit *hit)
{
    tahr_state *s = &step->state;
    vec3 facing = tahr__facing_of(step, hit->normal);
    s->flags |= TAHR_STATE_WALL_TOUCHED;
    s->wall_left = 0;
    if (!is_spent(step, facing)) {
        s->flags &= ~(uint32_t)TAHR_STATE_WALL_SPENT;
    }
    remember(step, facing, hit->body, hit->feature);
}

/* The next wall among contacts from `i` on; count if there is none. */
static uint32_t next_wall(const tahr__step *step, const tahr_contact *contacts, uint32_t count, uint32_t i)
{
    while (i < count && !tahr__is_wall(step, contacts[i].normal)) {
        i++;
    }
    return i;
}

static uint32_t contacts_at(tahr__step *step, vec3 position, tahr_contact *contacts)
{
    return tahr__contacts(step, position, TOUCHED * step->config->skin, contacts, TAHR__MAX_PLANES);
}

int tahr__is_at_wall(tahr__step *step, vec3 position)
{
    tahr_contact contacts[TAHR__MAX_PLANES];
    uint32_t count = contacts_at(step, position, contacts);
    return next_wall(step, contacts, count, 0) < count;
}

void tahr__leave_wall(tahr__step *step, double when)
{
    tahr_state *s = &step->state;
    s->flags &= ~(uint32_t)TAHR_STATE_WALL_TOUCHED;
    s->wall_left = step->config->wall_coyote_time > 0 ? step->config->wall_coyote_time + when : 0;
}

int tahr__wall_to_jump_off(tahr__step *step, int remembers, tahr_hit *wall)
{
    tahr_contact contacts[TAHR__MAX_PLANES];
    const tahr_state *s = &step->state;
    uint32_t count = contacts_at(step, s->position, contacts);
    int refused = 0;
    memset(wall, 0, sizeof *wall);
    for (uint32_t i = next_wall(step, contacts, count, 0); i < count; i = next_wall(step, contacts, count, i + 1)) {
        wall->normal = tahr__facing_of(step, contacts[i].normal);
        wall->body = contacts[i].body;
        wall->feature = contacts[i].feature;
        wall->surface = contacts[i].surface;
        wall->point = contacts[i].point;
        if (!is_spent(step, wall->normal)) {
            return 1;
        }
        refused = 1;
    }
    if (remembers && !(s->flags & TAHR_STATE_WALL_SPENT)) {
        wall->normal = s->wall_normal;
        wall->body = s->wall_body;
        wall->feature = s->wall_feature;
        return 1;
    }
    if (refused) {
        tahr__decide(step, TAHR_RULE_WALL_JUMP, 0, wall, dot(s->wall_normal, wall->normal), ALIKE,
                     "jumped off this wall already");
    }
    return 0;
}

void tahr__hold_wall(tahr__step *step, vec3 facing, uint32_t body, uint32_t feature)
{
    tahr__forget_walls(step);
    remember(step, facing, body, feature);
}

void tahr__spend_wall(tahr__step *step, const tahr_hit *wall)
{
    tahr_state *s = &step->state;
    remember(step, wall->normal, wall->body, wall->feature);
    s->flags = (s->flags | TAHR_STATE_WALL_SPENT) & ~(uint32_t)TAHR_STATE_WALL_TOUCHED;
    s->wall_left = 0;
}

void tahr__forget_walls(tahr__step *step)
{
    step->state.flags &= ~(uint32_t)(TAHR_STATE_WALL_TOUCHED | TAHR_STATE_WALL_SPENT);
    step->state.wall_left = 0;
    remember(step, vec(0, 0, 0), TAHR_NO_BODY, 0);
}
