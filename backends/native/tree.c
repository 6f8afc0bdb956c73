/* SPDX-License-Identifier: MIT
 * tree.c: searching bodies through their trees, nearest first. */
#include "scene.h"

/* The search box in the coordinates of a mesh. */
static tahr_bounds to_mesh(const tahr__map *map, const tahr_bounds *box)
{
    tahr_vec3 slack = v_make(TAHR__SLACK, TAHR__SLACK, TAHR__SLACK);
    tahr_bounds b = {v_sub(v_sub(box->min, map->offset), slack), v_add(v_sub(box->max, map->offset), slack)};
    if (!map->turned) return b;
    tahr_vec3 half = v_scale(v_sub(b.max, b.min), 0.5), middle = m_unapply(&map->turn, v_add(b.min, half));
    tahr__mat size = map->turn;
    for (int i = 0; i < 3; i++)
        size.row[i] = v_abs(size.row[i]);
    half = m_unapply(&size, half);
    b.min = v_sub(middle, half);
    b.max = v_add(middle, half);
    return b;
}

static double gap(double low, double high, double box_low, double box_high)
{
    return d_max(0, d_max(low - box_high, box_low - high));
}

static int within(const tahr_bounds *b, double reach, tahr_vec3 v0, tahr_vec3 v1, tahr_vec3 v2)
{
    tahr_vec3 low = v_min(v0, v_min(v1, v2)), high = v_max(v0, v_max(v1, v2));
    double x = gap(low.x, high.x, b->min.x, b->max.x);
    double y = gap(low.y, high.y, b->min.y, b->max.y);
    double z = gap(low.z, high.z, b->min.z, b->max.z);
    return x * x + y * y + z * z <= reach * reach;
}

/* All of a mesh at once. */
static void take_mesh(tahr__search *s, uint32_t id, const tahr__map *map)
{
    uint32_t items[TAHR__CACHE_MOST + TAHR__WIDE];
    tahr_bounds box = to_mesh(map, &s->box);
    s->take(s, id, items,
            tahr__wide_collect(&s->query->world->bodies[id].mesh.tree, &box, s->reach + TAHR__SLACK, items, s->room));
}

static void search_mesh(tahr__search *s, uint32_t id, const tahr__map *map)
{
    const tahr__body *body = &s->query->world->bodies[id];
    tahr__wide_walk walk;
    tahr_bounds box = to_mesh(map, &s->box);
    tahr_vec3 near = v_sub(s->query->start, map->offset);
    if (map->turned) near = m_unapply(&map->turn, near);
    tahr__wide_walk_begin(&walk, &body->mesh.tree, &box, s->reach + TAHR__SLACK,
                          s->order == TAHR__NEAREST_FIRST ? &near : NULL);
    tahr__prim prim;
    tahr__prim_begin(body, id, &prim);
    uint32_t i;
    while (tahr__wide_walk_next(&walk, &i)) {
        const uint32_t *vertex = body->mesh.triangles[i].vertex;
        const tahr_vec3 *v = body->mesh.vertices;
        if (!within(&box, s->reach + TAHR__SLACK, v[vertex[0]], v[vertex[1]], v[vertex[2]])) continue;
        tahr__prim_triangle(map, body, i, &prim);
        s->narrowed = 0;
        s->visit(s, &prim);
        if (!s->narrowed) continue;
        box = to_mesh(map, &s->box);
        tahr__wide_walk_narrow(&walk, &box);
    }
}

static uint32_t clamp(uint32_t x, uint32_t low, uint32_t high)
{
    return x < low ? low : x > high ? high : x;
}

typedef struct field_search {
    tahr__search *search;
    const tahr__body *body;
    const tahr__map *map;
    tahr_bounds box, around; /* what is searched for, in the field's coordinates; grown by the reach */
    tahr__heights_range range;
    double reach;
    tahr__prim prim;
} field_search;

/* Cells that the box only comes near, for all that rounding may do, are left out. */
static void trim(const tahr__heights *h, const tahr_bounds *around, tahr__heights_range *r)
{
    while (r->column < r->column_end && h->x[r->column + 1] < around->min.x)
        r->column++;
    while (r->column < r->column_end && h->x[r->column_end - 1] > around->max.x)
        r->column_end--;
    while (r->row < r->row_end && h->y[r->row + 1] < around->min.y)
        r->row++;
    while (r->row < r->row_end && h->y[r->row_end - 1] > around->max.y)
        r->row_end--;
}

/* Of the whole field nothing is nearer in height than its bounds are: what is left of the reach lies sideways. Without
 * it a shape that stands would look at all that its foot hides, not at what it touches. */
static double sideways(const field_search *f)
{
    const tahr_bounds *all = &f->body->mesh.bounds;
    double up = gap(all->min.z, all->max.z, f->box.min.z, f->box.max.z), left = f->reach * f->reach - up * up;
    return left > 0 ? sqrt(left) * (1 + 1e-9) + TAHR__SLACK : 0;
}

static void set_field_box(field_search *f)
{
    f->box = to_mesh(f->map, &f->search->box);
    double side = sideways(f);
    const tahr_vec3 grow = {side, side, f->reach};
    f->around.min = v_sub(f->box.min, grow);
    f->around.max = v_add(f->box.max, grow);
    f->range = tahr__heights_cells(&f->body->heights, &f->around);
    trim(&f->body->heights, &f->around, &f->range);
}

/* m2: what a row of cells leaves of the reach. */
static double rest2_of_row(const field_search *f, uint32_t row)
{
    const double *y = f->body->heights.y, side = gap(y[row], y[row + 1], f->box.min.y, f->box.max.y);
    return f->reach * f->reach - side * side;
}

/* Is a cell of it farther off? With a hole at a corner the triangles themselves are asked. */
static int is_cell_off(const field_search *f, uint32_t row, uint32_t column, double rest2)
{
    const tahr__heights *h = &f->body->heights;
    const double *low = h->z + (size_t)row * h->columns + column, *high = low + h->columns;
    const double least = d_min(d_min(low[0], high[0]), d_min(low[1], high[1]));
    const double most = d_max(d_max(low[0], high[0]), d_max(low[1], high[1]));
    const double z = gap(least, most, f->box.min.z, f->box.max.z);
    const double x = gap(h->x[column], h->x[column + 1], f->box.min.x, f->box.max.x);
    const double sum = (low[0] + high[0]) + (low[1] + high[1]);
    return (x * x + z * z > rest2) & (sum == sum);
}

static void search_cell(field_search *f, uint32_t column, uint32_t row)
{
    const tahr__heights *h = &f->body->heights;
    tahr_vec3 corners[4], v[3];
    tahr__heights_cell(h, column, row, corners);
    for (uint32_t k = 0; k < 2; k++) {
        v[0] = corners[0];
        v[1] = corners[1 + k];
        v[2] = corners[2 + k];
        if (!within(&f->box, f->reach, v[0], v[1], v[2])) continue;
        if ((h->has_holes | h->may_be_thin) && !tahr__heights_half(h, corners, k, v)) continue;
        tahr__prim_heights(f->map, f->body, 2 * (row * (h->columns - 1) + column) + k, v, &f->prim);
        f->search->narrowed = 0;
        f->search->visit(f->search, &f->prim);
        if (f->search->narrowed) set_field_box(f);
    }
}

static tahr_vec3 to_field(const tahr__map *map, tahr_vec3 v)
{
    return map->turned ? m_unapply(&map->turn, v) : v;
}

/* The cell where the motion is likely to be stopped: where its lower end touches the slope under it, and once more with
 * the slope there. */
static void find_cell(const field_search *f, uint32_t *column, uint32_t *row)
{
    const tahr__query *query = f->search->query;
    const tahr__heights_range *r = &f->range;
    const tahr_vec3 low = v_sub(query->start, v_make(0, 0, query->half));
    const tahr_vec3 start = to_field(f->map, v_sub(low, f->map->offset)), motion = to_field(f->map, query->motion);
    tahr_vec3 place = start, c[4];
    for (int i = 0; i < 3; i++) {
        tahr__heights_at(&f->body->heights, place.x, place.y, column, row);
        *column = clamp(*column, r->column, r->column_end - 1);
        *row = clamp(*row, r->row, r->row_end - 1);
        if (i == 2) return;
        tahr__heights_cell(&f->body->heights, *column, *row, c);
        const tahr_vec3 n = v_unit(v_cross(v_sub(c[2], c[0]), v_sub(c[3], c[1])));
        const double height = v_dot(n, v_sub(start, c[0])), rate = -v_dot(n, motion);
        const double t = rate > 0 ? d_max(0, d_min(height - f->search->reach, rate)) / rate : 0;
        place = v_sub(v_mad(start, motion, t), v_scale(n, height - t * rate));
        if (!(place.x == place.x && place.y == place.y)) return; /* a hole */
    }
}

/* The same straight from the grid of a field of heights: a likely cell, and then the others, of which what was met
 * there leaves few. */
static void search_heights(tahr__search *s, uint32_t id, const tahr__map *map)
{
    field_search f;
    uint32_t first_column, first_row;
    f.search = s;
    f.body = &s->query->world->bodies[id];
    f.map = map;
    f.reach = s->reach + TAHR__SLACK;
    set_field_box(&f);
    const tahr__heights_range *r = &f.range;
    if (r->column >= r->column_end || r->row >= r->row_end) return;
    find_cell(&f, &first_column, &first_row);
    tahr__prim_begin(f.body, id, &f.prim);
    search_cell(&f, first_column, first_row);
    for (uint32_t row = r->row; row < r->row_end; row++) {
        const double rest2 = rest2_of_row(&f, row);
        for (uint32_t column = r->column; column < r->column_end && rest2 >= 0; column++) {
            if (is_cell_off(&f, row, column, rest2) || (row == first_row && column == first_column)) continue;
            search_cell(&f, column, row);
        }
    }
}

/* All of a field at once: both triangles of every cell that meets the box. */
static void take_heights(tahr__search *s, uint32_t id, const tahr__map *map)
{
    uint32_t items[TAHR__CACHE_MOST], count = 0;
    field_search f;
    f.search = s;
    f.body = &s->query->world->bodies[id];
    f.map = map;
    f.reach = s->reach + TAHR__SLACK;
    set_field_box(&f);
    const tahr__heights *h = &f.body->heights;
    const uint64_t wide = f.range.column_end - f.range.column;
    if (2 * wide * (f.range.row_end - f.range.row) > s->room) {
        s->take(s, id, items, s->room + 1);
        return;
    }
    for (uint32_t row = f.range.row; row < f.range.row_end; row++) {
        const double rest2 = rest2_of_row(&f, row);
        for (uint32_t column = f.range.column; column < f.range.column_end; column++) {
            const uint32_t first = 2 * (row * (h->columns - 1) + column);
            if (is_cell_off(&f, row, column, rest2)) continue;
            for (uint32_t k = 0; k < 2; k++) {
                tahr_vec3 v[3];
                if ((h->has_holes || h->may_be_thin) && !tahr__heights_triangle(h, first + k, v)) continue;
                items[count++] = first + k;
            }
        }
    }
    s->take(s, id, items, count);
}

void tahr__tree_search_body(tahr__search *s, uint32_t id)
{
    const tahr__body *body = &s->query->world->bodies[id];
    if (!(body->mask & s->query->mask)) return;
    if (s->query->sensors == (body->flags & TAHR_BODY_SENSOR ? TAHR__SENSORS_NONE : TAHR__SENSORS_ONLY)) return;
    tahr__map map = tahr__map_make(s->query->frame, body);
    tahr__prim prim;
    tahr__prim_begin(body, id, &prim);
    if (body->type == TAHR_BODY_SPHERE || body->type == TAHR_BODY_CAPSULE) {
        tahr__prim_round(&map, body, &prim);
        s->visit(s, &prim);
        return;
    }
    if (body->type == TAHR_BODY_HEIGHTS) {
        if (s->order == TAHR__IN_BULK)
            take_heights(s, id, &map);
        else
            search_heights(s, id, &map);
        return;
    }
    if (body->type == TAHR_BODY_BOX || body->type == TAHR_BODY_HULL) {
        tahr__prim_solid(&map, body, &prim);
        s->visit(s, &prim);
    }
    if (s->order == TAHR__IN_BULK)
        take_mesh(s, id, &map);
    else
        search_mesh(s, id, &map);
}

/* Is a body out of a box? Without branches; bounds of bodies are TAHR__SLACK wider than they are. */
static int is_apart(const tahr_bounds *a, const tahr_bounds *b)
{
    int x = (a->min.x > b->max.x) | (b->min.x > a->max.x), y = (a->min.y > b->max.y) | (b->min.y > a->max.y);
    return x | y | (a->min.z > b->max.z) | (b->min.z > a->max.z);
}

void tahr__tree_search(tahr__search *s, const tahr__group *group)
{
    if (group->count == 0) return;
    tahr__bvh_walk walk;
    const tahr__frame *frame = s->query->frame;
    tahr_bounds box = tahr__frame_box_to_world(frame, &s->box, TAHR__SLACK);
    tahr_vec3 near = v_add(frame->origin, tahr__frame_to_world(frame, s->query->start));
    tahr__bvh_walk_begin(&walk, &group->tree, &box, s->reach + TAHR__SLACK, near);
    uint32_t first, count;
    while (tahr__bvh_walk_next(&walk, &first, &count)) {
        for (uint32_t i = first; i < first + count; i++) {
            uint32_t id = group->order[i];
            if (id == s->query->ignore_body) continue;
            /* Worth asking where all that is found is kept for many queries. */
            if (s->order == TAHR__IN_BULK && is_apart(&s->query->world->bodies[id].bounds, &box)) continue;
            tahr__tree_search_body(s, id);
        }
        box = tahr__frame_box_to_world(frame, &s->box, TAHR__SLACK);
        tahr__bvh_walk_narrow(&walk, &box);
    }
}

/* Relative to the centre of the tree, in double: the boxes of nodes are rounded outward. */
static int node_meets(const tahr__bvh_node *n, const tahr_bounds *b)
{
    int x = (n->lo[0] <= b->max.x) & (b->min.x <= n->hi[0]), y = (n->lo[1] <= b->max.y) & (b->min.y <= n->hi[1]);
    return x & y & (n->lo[2] <= b->max.z) & (b->min.z <= n->hi[2]);
}

static int leaf_meets(const tahr__native *world, const tahr__bvh_node *leaf, const tahr_bounds *box)
{
    for (uint32_t i = leaf->first; i < leaf->first + leaf->count; i++) {
        if (!is_apart(&world->bodies[world->movable.order[i]].bounds, box)) return 1;
    }
    return 0;
}

int tahr__movable_meets(const tahr__native *world, const tahr_bounds *box)
{
    const tahr__bvh *tree = &world->movable.tree;
    uint32_t stack[TAHR__BVH_STACK], top = 0;
    if (world->movable.count == 0) return 0;
    const tahr_bounds own = {v_sub(box->min, tree->centre), v_sub(box->max, tree->centre)};
    for (stack[top++] = 0; top > 0;) {
        const tahr__bvh_node *node = &tree->nodes[stack[--top]];
        if (!node_meets(node, &own)) continue;
        if (node->count > 0) {
            if (leaf_meets(world, node, box)) return 1;
            continue;
        }
        stack[top++] = node->first;
        stack[top++] = node->first + 1;
    }
    return 0;
}

/* m2 from a place, relative to the centre of the tree, to a node. */
static double gap2_to(const tahr__bvh_node *node, tahr_vec3 at)
{
    double x = gap(node->lo[0], node->hi[0], at.x, at.x), y = gap(node->lo[1], node->hi[1], at.y, at.y);
    double z = gap(node->lo[2], node->hi[2], at.z, at.z);
    return x * x + y * y + z * z;
}

double tahr__movable_gap(const tahr__native *world, tahr_vec3 position, double most)
{
    const tahr__bvh *tree = &world->movable.tree;
    uint32_t stack[TAHR__BVH_STACK], top = 0;
    if (world->movable.count == 0 || !(most > 0)) return most;
    const tahr_vec3 at = v_sub(position, tree->centre);
    double least2 = most * most;
    for (stack[top++] = 0; top > 0;) {
        const tahr__bvh_node *node = &tree->nodes[stack[--top]];
        const double gap2 = gap2_to(node, at);
        if (gap2 >= least2) continue;
        if (node->count > 0) {
            least2 = gap2;
            continue;
        }
        stack[top++] = node->first;
        stack[top++] = node->first + 1;
    }
    return sqrt(least2) * (1 - 1e-9);
}
