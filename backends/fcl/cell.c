/* SPDX-License-Identifier: MIT
 * cell.c: occupied cells as one solid. A cell is a box, but what counts is the surface of the union: a contact is only
 * felt where no other cell is nearer, and out of many cells the way leads along a row to the first free one. */
#include "scene.h"

/* How far beside a face (m) the nearest point lies by rounding. */
#define ON_FACE 1e-9
/* A normal that leans into a neighbour by less is rounding. */
#define LEAN 1e-9
/* Cells of the finest level that a way out may lead through: a room's wall is thinner. */
enum { LONGEST_WAY = 1024 };

static int32_t cell_size(const tahr__fcl_part *cell)
{
    return 1 << (TAHR__FCL_LEVELS - cell->depth);
}

void tahr__fcl_cell_box(const tahr__scene_body *body, const tahr__fcl_part *cell, tahr_vec3 *middle, tahr_vec3 *half)
{
    double r = body->radius, h = 0.5 * cell_size(cell);

    *middle = v_make((cell->key[0] - TAHR__FCL_ORIGIN + h) * r, (cell->key[1] - TAHR__FCL_ORIGIN + h) * r,
                     (cell->key[2] - TAHR__FCL_ORIGIN + h) * r);
    *half = v_make(h * r, h * r, h * r);
}

/* A point relative to the query's start, from the middle of the cell along its own axes, in metres. */
static void to_cell(const tahr__piece *piece, tahr_vec3 point, double at[3])
{
    tahr_vec3 d = m_unapply(&piece->frame->turn, v_sub(point, piece->middle));
    for (int i = 0; i < 3; i++)
        at[i] = v_get(d, i);
}

/* The finest key along axis i at a place within the cell. */
static int32_t key_at(const tahr__fcl_part *cell, int i, double at, double half, double resolution)
{
    int32_t steps = (int32_t)((at + half) / resolution), last = cell_size(cell) - 1;
    return cell->key[i] + (steps < 0 ? 0 : steps > last ? last : steps);
}

/* Around the nearest point there are up to eight octants, in occupied cells or not. One is nearer if it leads from
 * there toward the shape: if the normal points into it along any axis. */
int tahr__fcl_cell_felt(const tahr__piece_query *q, const tahr__piece_found *found, const tahr__near *near)
{
    const tahr__fcl_part *cell = tahr__fcl_query_part(q, found->name);
    const tahr__piece *piece = &found->piece;
    double r = q->scene->bodies[cell->body].radius, half = piece->half.x, at[3];
    double beside = near->rough ? TAHR__SAME_PLACE : ON_FACE, lean = near->rough ? TAHR__SAME_DIRECTION : LEAN;
    tahr_vec3 normal = m_unapply(&piece->frame->turn, near->normal);
    int32_t key[3][2];

    to_cell(piece, near->point, at);
    for (int k = 0; k < 3; k++) {
        key[k][0] = key[k][1] = key_at(cell, k, at[k], half, r);
        if (at[k] <= -half + beside) key[k][0] = cell->key[k] - 1;
        if (at[k] >= half - beside) key[k][1] = cell->key[k] + cell_size(cell);
    }
    for (int octant = 0; octant < 8; octant++) {
        int32_t place[3];
        int leads = 0, own = 1;
        for (int k = 0; k < 3; k++) {
            int up = octant >> k & 1;
            place[k] = key[k][up];
            leads |= key[k][0] != key[k][1] && (up ? v_get(normal, k) > lean : v_get(normal, k) < -lean);
            own &= place[k] >= cell->key[k] && place[k] < cell->key[k] + cell_size(cell);
        }
        if (leads && !own && tahr__fcl_engine_occupied(tahr__fcl_scene_of(q)->engine, cell->body, place)) return 0;
    }
    return 1;
}

/* How far (m) the solid reaches beyond the cell along axis k, on the row through key. */
static double row_length(const tahr__piece_query *q, const tahr__fcl_part *cell, const int32_t key[3], int k, int up)
{
    int32_t at[3] = {key[0], key[1], key[2]};
    int steps = 0;

    at[k] = up ? cell->key[k] + cell_size(cell) : cell->key[k] - 1;
    while (steps < LONGEST_WAY && tahr__fcl_engine_occupied(tahr__fcl_scene_of(q)->engine, cell->body, at)) {
        at[k] += up ? 1 : -1;
        steps++;
    }
    return steps * q->scene->bodies[cell->body].radius;
}

void tahr__fcl_cell_way_out(const tahr__piece_query *q, const tahr__piece_found *found, tahr__near *near)
{
    const tahr__fcl_part *cell = tahr__fcl_query_part(q, found->name);
    const tahr__piece *piece = &found->piece;
    double r = q->scene->bodies[cell->body].radius, half = piece->half.x, at[3], least = 1e300;
    tahr_vec3 centre = v_make(0, 0, 0);
    int32_t key[3];

    to_cell(piece, centre, at);
    for (int k = 0; k < 3; k++)
        key[k] = key_at(cell, k, at[k], half, r);
    for (int k = 0; k < 6; k++) {
        tahr_vec3 out = v_scale(v_unit(piece->solid.axis[k / 2]), k & 1 ? 1 : -1);
        double depth = half - (k & 1 ? at[k / 2] : -at[k / 2]) + tahr__shape_extent(&q->shape, v_scale(out, -1));
        if (depth >= least) continue;
        depth += row_length(q, cell, key, k / 2, k & 1);
        if (depth >= least) continue;
        least = depth;
        near->normal = out;
    }
    near->distance = -least - q->shape.radius;
    near->part = TAHR__FACE;
    near->point = v_mad(centre, near->normal, least - tahr__shape_extent(&q->shape, v_scale(near->normal, -1)));
}
