/* SPDX-License-Identifier: MIT
 * check.c: an independent look at what a run did: crossed surfaces and overlaps, by its own grid and its own
 * geometry. */
#include "check.h"

#include "say.h"
#include "vec.h"

#include <stdlib.h>

/* A grid finer than this costs more memory than it saves time. */
#define MAX_CELLS 2000000.0
#define MIN_CELL 0.5 /* m, about the size of a character */

/* Items are triangles first, then round bodies. */
struct checker {
    const struct level *level;
    tahr_vec3 origin;
    double cell;
    int32_t size[3];
    uint32_t *first; /* per cell, into items */
    uint32_t *items;
    uint32_t *seen; /* per item: the last visit that met it */
    uint32_t visit;
    struct moving {
        tahr_pose before, now;
        tahr_vec3 corners[LEVEL_BOX_CORNERS]; /* now, world */
    } * moving;                               /* one per mover of the level */
};

struct range {
    int32_t low[3], high[3];
};

static double segment_distance(tahr_vec3 p, tahr_vec3 q, tahr_vec3 a, tahr_vec3 b)
{
    /* Nearest points of p + s d and a + t e with s, t in [0, 1]: the unconstrained minimum in s, its best t clamped,
     * and s again for that t (C. Ericson, Real-Time Collision Detection, 5.1.9). */
    tahr_vec3 d = vec_sub(q, p), e = vec_sub(b, a), r = vec_sub(p, a);
    double dd = vec_dot(d, d), ee = vec_dot(e, e), de = vec_dot(d, e), dr = vec_dot(d, r), er = vec_dot(e, r), s, t;
    if (dd <= 0) {
        s = 0;
        t = ee > 0 ? clamp(er / ee, 0, 1) : 0;
    } else if (ee <= 0) {
        t = 0;
        s = clamp(-dr / dd, 0, 1);
    } else {
        double determinant = dd * ee - de * de;
        s = determinant > 1e-14 * dd * ee ? clamp((de * er - dr * ee) / determinant, 0, 1) : 0;
        t = clamp((de * s + er) / ee, 0, 1);
        s = clamp((de * t - dr) / dd, 0, 1);
    }
    return vec_length(vec_sub(vec_add(r, vec_scale(d, s)), vec_scale(e, t)));
}

/* Whether segment pq meets triangle abc. Edges and corners belong to the triangle, with a tolerance, so that nothing
 * gets through between two neighbours; honest centres keep a radius away from every surface, so this can accuse
 * nobody. */
static int segment_crosses(tahr_vec3 p, tahr_vec3 q, const tahr_vec3 abc[3])
{
    tahr_vec3 a = vec_sub(abc[0], p), b = vec_sub(abc[1], p), c = vec_sub(abc[2], p), d = vec_sub(q, p);
    tahr_vec3 normal = vec_cross(vec_sub(b, a), vec_sub(c, a));
    double start = -vec_dot(normal, a), end = start + vec_dot(normal, d);
    if ((start > 0 && end > 0) || (start < 0 && end < 0) || start == end) {
        return 0; /* on one side, or along the plane: there the clearance speaks */
    }
    /* Volumes of the line with the three edges: all of one sign if it passes inside. */
    double u = vec_dot(d, vec_cross(b, a)), v = vec_dot(d, vec_cross(c, b)), w = vec_dot(d, vec_cross(a, c));
    double slack = 1e-12 * (fabs(u) + fabs(v) + fabs(w));
    return (u >= -slack && v >= -slack && w >= -slack) || (u <= slack && v <= slack && w <= slack);
}

/* Distance of a point above the inside of a triangle, or a large number beside it. */
static double face_distance(tahr_vec3 p, const tahr_vec3 abc[3])
{
    tahr_vec3 ab = vec_sub(abc[1], abc[0]), ac = vec_sub(abc[2], abc[0]), ap = vec_sub(p, abc[0]);
    tahr_vec3 normal = vec_cross(ab, ac);
    double nn = vec_dot(normal, normal);
    if (nn <= 0) {
        return HUGE_VAL;
    }
    double v = vec_dot(vec_cross(ap, ac), normal), w = vec_dot(vec_cross(ab, ap), normal);
    return v >= 0 && w >= 0 && v + w <= nn ? fabs(vec_dot(normal, ap)) / sqrt(nn) : HUGE_VAL;
}

static double triangle_distance(tahr_vec3 p, tahr_vec3 q, const tahr_vec3 abc[3])
{
    if (segment_crosses(p, q, abc)) {
        return 0;
    }
    double best = least(face_distance(p, abc), face_distance(q, abc));
    for (int k = 0; k < 3; k++) {
        best = least(best, segment_distance(p, q, abc[k], abc[(k + 1) % 3]));
    }
    return best;
}

static struct range range_of(const struct checker *checker, tahr_vec3 low, tahr_vec3 high)
{
    const double lows[3] = {low.x - checker->origin.x, low.y - checker->origin.y, low.z - checker->origin.z};
    const double highs[3] = {high.x - checker->origin.x, high.y - checker->origin.y, high.z - checker->origin.z};
    struct range range;
    for (int k = 0; k < 3; k++) {
        double top = checker->size[k] - 1;
        range.low[k] = (int32_t)clamp(floor(lows[k] / checker->cell), 0, top);
        range.high[k] = (int32_t)clamp(floor(highs[k] / checker->cell), 0, top);
    }
    return range;
}

static size_t cell_index(const struct checker *checker, int32_t x, int32_t y, int32_t z)
{
    return ((size_t)z * (size_t)checker->size[1] + (size_t)y) * (size_t)checker->size[0] + (size_t)x;
}

static void item_bounds(const struct level *level, size_t item, tahr_vec3 *low, tahr_vec3 *high)
{
    tahr_vec3 p[3];
    double reach = 0;
    if (item < level->triangle_count) {
        for (int k = 0; k < 3; k++) {
            p[k] = level->corners[3 * item + (size_t)k];
        }
    } else {
        const struct level_round *round = &level->rounds[item - level->triangle_count];
        p[0] = round->a;
        p[1] = p[2] = round->b;
        reach = round->radius;
    }
    *low = (tahr_vec3){least(least(p[0].x, p[1].x), p[2].x) - reach, least(least(p[0].y, p[1].y), p[2].y) - reach,
                       least(least(p[0].z, p[1].z), p[2].z) - reach};
    *high = (tahr_vec3){most(most(p[0].x, p[1].x), p[2].x) + reach, most(most(p[0].y, p[1].y), p[2].y) + reach,
                        most(most(p[0].z, p[1].z), p[2].z) + reach};
}

/* Whether the plane of a triangle passes through a cell. Without this a large slope would fill its whole bounding
 * box. */
static int plane_meets_cell(const struct checker *checker, const tahr_vec3 abc[3], int32_t x, int32_t y, int32_t z)
{
    tahr_vec3 normal = vec_cross(vec_sub(abc[1], abc[0]), vec_sub(abc[2], abc[0]));
    double half = checker->cell * 0.5;
    tahr_vec3 middle =
        vec_add(checker->origin, (tahr_vec3){(2 * x + 1) * half, (2 * y + 1) * half, (2 * z + 1) * half});
    double reach = (fabs(normal.x) + fabs(normal.y) + fabs(normal.z)) * half;
    return fabs(vec_dot(normal, vec_sub(middle, abc[0]))) <= reach * 1.001;
}

/* Puts an item in its cells: counts first (items NULL), then writes. */
static void place_item(struct checker *checker, size_t item, uint32_t *cursor)
{
    const struct level *level = checker->level;
    const tahr_vec3 *abc = item < level->triangle_count ? &level->corners[3 * item] : NULL;
    tahr_vec3 low, high;
    item_bounds(level, item, &low, &high);
    struct range r = range_of(checker, low, high);
    for (int32_t z = r.low[2]; z <= r.high[2]; z++) {
        for (int32_t y = r.low[1]; y <= r.high[1]; y++) {
            for (int32_t x = r.low[0]; x <= r.high[0]; x++) {
                if (abc != NULL && !plane_meets_cell(checker, abc, x, y, z)) {
                    continue;
                }
                size_t cell = cell_index(checker, x, y, z);
                if (checker->items != NULL) {
                    checker->items[cursor[cell]] = (uint32_t)item;
                }
                cursor[cell]++;
            }
        }
    }
}

static void size_grid(struct checker *checker)
{
    const tahr_bounds *bounds = &checker->level->bounds;
    tahr_vec3 extent = vec_sub(bounds->max, bounds->min);
    checker->origin = bounds->min;
    for (checker->cell = MIN_CELL;; checker->cell *= 1.25) {
        double cells[3] = {extent.x / checker->cell + 1, extent.y / checker->cell + 1, extent.z / checker->cell + 1};
        if (cells[0] * cells[1] * cells[2] <= MAX_CELLS) {
            for (int k = 0; k < 3; k++) {
                checker->size[k] = (int32_t)cells[k];
            }
            return;
        }
    }
}

struct checker *checker_open(const struct level *level)
{
    struct checker *checker = memory_new(1, sizeof *checker);
    size_t item_count = level->triangle_count + level->round_count;
    checker->level = level;
    size_grid(checker);
    size_t cell_count = (size_t)checker->size[0] * (size_t)checker->size[1] * (size_t)checker->size[2];
    uint32_t *cursor = memory_new(cell_count, sizeof *cursor);
    checker->first = memory_new(cell_count + 1, sizeof *checker->first);
    checker->seen = memory_new(item_count, sizeof *checker->seen);
    for (size_t i = 0; i < item_count; i++) {
        place_item(checker, i, cursor);
    }
    for (size_t c = 0; c < cell_count; c++) {
        checker->first[c + 1] = checker->first[c] + cursor[c];
        cursor[c] = checker->first[c];
    }
    checker->items = memory_new(checker->first[cell_count], sizeof *checker->items);
    for (size_t i = 0; i < item_count; i++) {
        place_item(checker, i, cursor);
    }
    free(cursor);
    checker->moving = memory_new(level->mover_count, sizeof *checker->moving);
    checker_time(checker, 0, 0);
    return checker;
}

void checker_time(struct checker *checker, double before, double now)
{
    for (size_t i = 0; i < checker->level->mover_count; i++) {
        const struct level_mover *mover = &checker->level->movers[i];
        struct moving *moving = &checker->moving[i];
        moving->before = level_mover_pose(mover, before);
        moving->now = level_mover_pose(mover, now);
        level_box_corners(&moving->now, mover->half_extents, moving->corners);
    }
}

void checker_close(struct checker *checker)
{
    if (checker != NULL) {
        free(checker->first);
        free(checker->items);
        free(checker->seen);
        free(checker->moving);
        free(checker);
    }
}

/* The distance from segment pq to everything whose cells meet [low, high]; at most `limit`. */
static double nearest(struct checker *checker, tahr_vec3 p, tahr_vec3 q, double reach, double limit, double radius)
{
    const struct level *level = checker->level;
    tahr_vec3 low = {least(p.x, q.x) - reach, least(p.y, q.y) - reach, least(p.z, q.z) - reach};
    tahr_vec3 high = {most(p.x, q.x) + reach, most(p.y, q.y) + reach, most(p.z, q.z) + reach};
    struct range r = range_of(checker, low, high);
    double best = limit;
    checker->visit++;
    for (int32_t z = r.low[2]; z <= r.high[2]; z++) {
        for (int32_t y = r.low[1]; y <= r.high[1]; y++) {
            size_t begin = checker->first[cell_index(checker, r.low[0], y, z)];
            size_t end = checker->first[cell_index(checker, r.high[0], y, z) + 1];
            for (size_t i = begin; i < end; i++) {
                uint32_t item = checker->items[i];
                if (checker->seen[item] == checker->visit) {
                    continue;
                }
                checker->seen[item] = checker->visit;
                if (item < level->triangle_count) {
                    best = least(best, triangle_distance(p, q, &level->corners[3 * (size_t)item]) - radius);
                } else {
                    const struct level_round *round = &level->rounds[item - level->triangle_count];
                    best = least(best, segment_distance(p, q, round->a, round->b) - round->radius - radius);
                }
            }
        }
    }
    return best;
}

/* Seen from a mover, one step goes from where the start was on it to where the end is. */
static int crosses_mover(const struct moving *moving, tahr_vec3 from, tahr_vec3 to)
{
    tahr_vec3 there = vec_turn_back(moving->before.orientation, vec_sub(from, moving->before.position));
    tahr_vec3 start = vec_add(moving->now.position, vec_turn(moving->now.orientation, there));
    for (int i = 0; i < LEVEL_BOX_CORNERS; i += 3) {
        if (segment_crosses(start, to, &moving->corners[i])) {
            return 1;
        }
    }
    return 0;
}

int checker_crosses(struct checker *checker, tahr_vec3 from, tahr_vec3 to)
{
    int crosses = nearest(checker, from, to, 0, HUGE_VAL, 0) <= 0;
    for (size_t i = 0; i < checker->level->mover_count && !crosses; i++) {
        crosses = !checker->level->movers[i].one_way && crosses_mover(&checker->moving[i], from, to);
    }
    return crosses;
}

/* The capsule that stands for a shape: the ends of its axis. Returns its radius. */
static double axis_of(const tahr_shape *shape, tahr_vec3 position, tahr_vec3 up, tahr_vec3 ends[2])
{
    double radius = shape->type == TAHR_SHAPE_BOX ? least(shape->half_x, shape->half_y) : shape->radius;
    radius = least(radius, shape->half_height);
    tahr_vec3 axis = vec_scale(up, shape->half_height - radius);
    ends[0] = vec_sub(position, axis);
    ends[1] = vec_add(position, axis);
    return radius;
}

/* Which side of a line in the plane a place is on: above it is positive; how far, times its length. */
static double side_of(tahr_vec3 p, tahr_vec3 a, tahr_vec3 b)
{
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/* Seen from what may itself move by `shift`: the foot went through from above, and the shape did not overlap it. Who
 * walks off an end goes round it: only what is above and then below the inside counts. */
static int sinks_through(const tahr_shape *before, tahr_vec3 from, tahr_vec3 foot, const tahr_vec3 thin[2],
                         tahr_vec3 shift)
{
    const tahr_vec3 up = {0, 1, 0};
    tahr_vec3 ends[2], foot_before = vec_add(vec_sub(from, vec_scale(up, before->half_height)), shift);
    double left = least(foot_before.x, foot.x), right = most(foot_before.x, foot.x);
    double radius = axis_of(before, vec_add(from, shift), up, ends);
    return left >= thin[0].x && right <= thin[1].x && side_of(foot_before, thin[0], thin[1]) >= 0 &&
           side_of(foot, thin[0], thin[1]) < 0 && segment_distance(ends[0], ends[1], thin[0], thin[1]) >= radius;
}

int checker_sinks(struct checker *checker, const tahr_shape *before, tahr_vec3 from, const tahr_shape *now,
                  tahr_vec3 to)
{
    const struct level *level = checker->level;
    const tahr_vec3 foot = {to.x, to.y - now->half_height, to.z}, still = {0, 0, 0};
    for (size_t i = 0; i < level->thin_count; i++) {
        const tahr_vec3 thin[2] = {level->thins[i].a, level->thins[i].b};
        if (sinks_through(before, from, foot, thin, still)) {
            return 1;
        }
    }
    for (size_t i = 0; i < level->mover_count; i++) {
        tahr_vec3 half = level->movers[i].half_extents, middle = checker->moving[i].now.position;
        const tahr_vec3 top[2] = {{middle.x - half.x, middle.y + half.y, 0}, {middle.x + half.x, middle.y + half.y, 0}};
        tahr_vec3 shift = vec_sub(middle, checker->moving[i].before.position);
        if (level->movers[i].one_way && sinks_through(before, from, foot, top, shift)) {
            return 1;
        }
    }
    return 0;
}

static double nearest_mover(const struct checker *checker, tahr_vec3 p, tahr_vec3 q, double radius)
{
    double best = CHECK_REACH;
    for (size_t i = 0; i < checker->level->mover_count; i++) {
        const struct level_mover *mover = &checker->level->movers[i];
        if (mover->one_way) {
            continue;
        }
        double far = vec_length(mover->half_extents) + vec_length(vec_sub(q, p)) + radius + CHECK_REACH;
        if (vec_length(vec_sub(p, checker->moving[i].now.position)) > far) {
            continue;
        }
        for (int k = 0; k < LEVEL_BOX_CORNERS; k += 3) {
            best = least(best, triangle_distance(p, q, &checker->moving[i].corners[k]) - radius);
        }
    }
    return best;
}

/* Distance of the outline of an upright rectangle in the plane to everything, or to movers alone; 0 if something
 * crosses it. */
static double outline_clearance(struct checker *checker, tahr_vec3 middle, double half_x, double half_y, int movers)
{
    double best = CHECK_REACH;
    for (int i = 0; i < 4; i++) {
        double x = i == 0 || i == 3 ? -half_x : half_x, next_x = i < 2 ? half_x : -half_x;
        double y = i < 2 ? -half_y : half_y, next_y = i == 0 || i == 3 ? -half_y : half_y;
        tahr_vec3 p = {middle.x + x, middle.y + y, middle.z}, q = {middle.x + next_x, middle.y + next_y, middle.z};
        best = movers ? best : least(best, nearest(checker, p, q, CHECK_REACH, CHECK_REACH, 0));
        best = least(best, nearest_mover(checker, p, q, 0));
    }
    return best;
}

/* Of a box in two dimensions: how far its true outline is from everything, and if it is crossed, whether one smaller by
 * CHECK_BOX_DEPTH is crossed too. */
static double box_clearance(struct checker *checker, const tahr_shape *box, tahr_vec3 position)
{
    double clearance = outline_clearance(checker, position, box->half_x, box->half_height, 0);
    double inner_x = box->half_x - CHECK_BOX_DEPTH, inner_y = box->half_height - CHECK_BOX_DEPTH;
    if (clearance <= 0 && inner_x > 0 && inner_y > 0 &&
        outline_clearance(checker, position, inner_x, inner_y, 0) <= 0) {
        return -CHECK_BOX_DEPTH;
    }
    return clearance;
}

double checker_mover_clearance(struct checker *checker, const tahr_shape *shape, tahr_vec3 position, tahr_vec3 up)
{
    tahr_vec3 ends[2];
    double radius = axis_of(shape, position, up, ends);
    double best = nearest_mover(checker, ends[0], ends[1], radius);
    int box = checker->level->side != NULL && shape->type == TAHR_SHAPE_BOX;
    return box ? least(best, outline_clearance(checker, position, shape->half_x, shape->half_height, 1)) : best;
}

double checker_clearance(struct checker *checker, const tahr_shape *shape, tahr_vec3 position, tahr_vec3 up)
{
    tahr_vec3 ends[2];
    double radius = axis_of(shape, position, up, ends);
    double still = nearest(checker, ends[0], ends[1], radius + CHECK_REACH, CHECK_REACH, radius);
    double best = least(still, nearest_mover(checker, ends[0], ends[1], radius));
    int box = checker->level->side != NULL && shape->type == TAHR_SHAPE_BOX;
    return box ? least(best, box_clearance(checker, shape, position)) : best;
}
