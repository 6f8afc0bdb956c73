/* SPDX-License-Identifier: MIT
 * corner.c: a jump that grazes the corner of a ceiling goes past it.
 *
 * What overlaps the corner by no more than config.corner_correction has met its side, not its bottom: so it goes on as
 * beside a wall, with all of its rise and nothing of its speed toward it. The other rule of the field, never aside
 * against the own motion, loses the jump to everybody who pushes toward the corner or has just turned away from it, and
 * a round head its speed as well, which the corner throws back.
 *
 * How far aside is not searched for: from a place that is past the corner the shape is swept back toward the column
 * that it rose in, and stops a skin beside what was in the way. The answer does not depend on how fast it rises, and
 * so not on the frame rate. */
#include "corner.h"

#include "launch.h"
#include "plane.h"
#include "query.h"
#include "report.h"
#include "shape.h"

/* Less downward than this is a wall, beside which a rise goes on. */
static const double CEILING = 1e-3;

/* A contact with less of a level part lies on the ceiling's face: no side of it is nearer. */
static const double FLAT = 1e-6;

/* Of skin: so far below the ceiling and beside the corner, against the rounding of an engine in single precision (2e-6
 * m at 1 m). */
static const double CLEAR = 4e-4;

/* How far up the widest part of the head lies above its top, so that it passes what the top has hit. A cone's is its
 * base. */
static double head_height(const tahr__step *step)
{
    const tahr_shape *s = &step->limits->shape;
    return (s->type == TAHR_SHAPE_CONE ? 2 * s->half_height : shape_cap(s)) + 2 * step->config->skin;
}

/* m aside, along a level direction, at which the head passes; or more than corner_correction. */
static double way_aside(tahr__step *step, const tahr_hit *met, vec3 direction)
{
    const tahr_shape *shape = &step->limits->shape;
    double skin = step->config->skin, most = step->config->corner_correction, none = 2 * most;
    double height = head_height(step), clear = CLEAR * skin;
    vec3 at = add_scaled(step->state.position, step->state.up, -clear);
    tahr_hit hit;
    tahr__sweep(step, shape, at, scale(direction, most), skin, 0, &hit);
    double aside = hit.start_overlap ? 0 : hit.fraction * most;
    at = add_scaled(at, direction, aside);
    tahr__sweep(step, shape, at, scale(step->state.up, height), skin, 0, &hit);
    if (aside <= 0 || hit.blocking) {
        return none;
    }
    at = add_scaled(at, step->state.up, height);
    tahr__sweep(step, shape, at, scale(direction, -aside), skin, 0, &hit);
    /* Nothing beside the widest part of a round head that is under the corner by more than rounding: what it met is
     * not as high as the head, and has no side to go past. */
    double under = shape_is_round(shape) ? shape->radius * (1 - length(step_level(step, met->normal))) : 0;
    if (hit.start_overlap || hit.unknown || (!hit.blocking && under > clear)) {
        return none;
    }
    return min_of(aside * (1 - hit.fraction) + clear, aside);
}

/* The sides of a box, both ways, as far as they lie in the plane that the character stays in. */
static uint32_t sides_of(const tahr__step *step, vec3 *directions)
{
    const vec3 sides[2] = {rotate(step->state.orientation, vec(1, 0, 0)),
                           rotate(step->state.orientation, vec(0, 1, 0))};
    uint32_t count = 0;
    for (int i = 0; i < 2; i++) {
        vec3 side = along_plane(step->limits, sides[i]);
        if (length(side) > FLAT) { /* else it points out of the plane */
            directions[count++] = is_in_plane(step) ? unit(side) : side;
        }
    }
    for (uint32_t i = 0; i < count; i++) {
        directions[count + i] = scale(directions[i], -1);
    }
    return 2 * count;
}

/* Directions worth a look: away from an edge that was hit; of boxes, along their sides. */
static uint32_t directions_of(const tahr__step *step, const tahr_hit *hit, vec3 *directions)
{
    vec3 level = step_level(step, hit->normal);
    vec3 motion = step_level(step, step->state.velocity);
    if (shape_is_square(&step->limits->shape)) {
        return sides_of(step, directions);
    }
    if (length(level) <= FLAT) {
        level = motion;
    }
    directions[0] = unit(level);
    return length_squared(level) > 0;
}

int tahr__clear_corner(tahr__step *step, const tahr_hit *hit, vec3 *aside)
{
    tahr_state *s = &step->state;
    vec3 directions[4];
    double most = step->config->corner_correction, least = 2 * most;
    uint32_t best = 0;
    if (dot(s->velocity, s->up) <= 0 || dot(hit->normal, s->up) > -CEILING || hit->start_overlap) {
        return 0;
    }
    uint32_t count = directions_of(step, hit, directions);
    for (uint32_t i = 0; i < count; i++) {
        double way = way_aside(step, hit, directions[i]);
        if (way < least) {
            least = way;
            best = i;
        }
    }
    if (least > most || step->error < 0) {
        return tahr__decide(step, TAHR_RULE_CORNER, 0, hit, least, most, "no way past the corner");
    }
    *aside = directions[best];
    s->position = add_scaled(s->position, *aside, least);
    return tahr__decide(step, TAHR_RULE_CORNER, 1, hit, least, most, "aside, past the corner");
}

int tahr__returns_to_corner(const tahr__step *step, vec3 aside)
{
    return dot(step->state.velocity, aside) < 0 || dot(step->input->move, aside) < 0 ||
           (is_drifting(step) && dot(drive_of(step), aside) < 0);
}
