/* SPDX-License-Identifier: MIT
 * mutant.c: see mutant.h. What is asked is changed before the native backend sees it, or its answer afterwards. */
#include "mutant.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <tahr/native.h>

enum { MOST_BODIES = 48 };

typedef struct mutant {
    const tahr_host *host;
    void *inner;
    uint32_t which, body_count, asked, prepared, placed;
    uint32_t flags[MOST_BODIES];
} mutant;

static const struct {
    const char *name, *caught_by;
} table[] = {
#define MUTANT_ROW(constant, name) {#constant, name},
    MUTANT_TABLE(MUTANT_ROW)
#undef MUTANT_ROW
};

const char *mutant_name(uint32_t which)
{
    return table[which].name;
}

const char *mutant_case(uint32_t which)
{
    return table[which].caught_by;
}

static double dot(tahr_vec3 a, tahr_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static double length(tahr_vec3 a)
{
    return sqrt(dot(a, a));
}

static tahr_vec3 scaled(tahr_vec3 a, double s)
{
    return (tahr_vec3){a.x * s, a.y * s, a.z * s};
}

static const tahr_backend *native(void)
{
    return tahr_backend_v1_native();
}

/* A body as the mutant sees it. */
static int change_body(uint32_t which, tahr_body_desc *b)
{
    int mesh = b->type == TAHR_BODY_MESH;
    switch (which) {
    case BACK_FACES_BLOCK: b->flags |= mesh ? (uint32_t)TAHR_BODY_TWO_SIDED : 0; break;
    case TWO_SIDED_IGNORED: b->flags &= ~(uint32_t)TAHR_BODY_TWO_SIDED; break;
    case SEAMS_BLOCK: b->flags |= mesh ? (uint32_t)TAHR_BODY_TWO_SIDED : 0; break;
    case BOXES_HALF_AS_HIGH: b->half_extents.z *= b->type == TAHR_BODY_BOX ? 0.5 : 1; break;
    case SPHERES_ARE_BOXES:
        if (b->type == TAHR_BODY_SPHERE) {
            b->type = TAHR_BODY_BOX;
            b->half_extents = (tahr_vec3){0.5 * b->radius, b->radius, b->radius};
        }
        break;
    case CAPSULES_WITHOUT_CAPS:
        if (b->type == TAHR_BODY_CAPSULE) b->half_height = b->radius + 0.5 * (b->half_height - b->radius);
        break;
    case MESHES_SHIFTED: b->pose.position.z += mesh ? 0.001 : 0; break;
    case HULLS_SHIFTED: b->pose.position.z -= b->type == TAHR_BODY_HULL ? 0.001 : 0; break;
    case HEIGHTS_SHIFTED: b->pose.position.z -= b->type == TAHR_BODY_HEIGHTS ? 0.001 : 0; break;
    case DEGENERATE_REFUSED:
        for (uint32_t i = 0; mesh && i < b->triangle_count; i++) {
            if (b->indices[3 * i] == b->indices[3 * i + 1]) return 0;
        }
        break;
    case DUPLICATES_CANCEL:
        if (mesh && b->triangle_count == 4 && b->indices[0] == b->indices[6]) {
            b->indices += 3;
            b->triangle_count = 1;
        }
        break;
    default: break;
    }
    return 1;
}

static tahr_status open(const tahr_host *host, const tahr_world_desc *desc, void **self)
{
    const mutant_desc *options = desc->options;
    tahr_body_desc bodies[MOST_BODIES];
    tahr_world_desc scene = *desc;
    if (desc->body_count > MOST_BODIES) return TAHR_E_MEMORY;
    mutant *m = host->allocator.alloc(host->allocator.user, sizeof *m, 64);
    if (!m) return TAHR_E_MEMORY;
    memset(m, 0, sizeof *m);
    m->host = host;
    m->which = options->which;
    m->body_count = desc->body_count;
    int good = 1;
    for (uint32_t i = 0; i < desc->body_count; i++) {
        bodies[i] = desc->bodies[i];
        m->flags[i] = bodies[i].flags;
        good = good && change_body(m->which, &bodies[i]);
    }
    scene.bodies = bodies;
    scene.options = NULL; /* those were the mutant's */
    tahr_status status = good ? native()->open(host, &scene, &m->inner) : TAHR_E_GEOMETRY;
    if (status < 0)
        host->allocator.free(host->allocator.user, m, sizeof *m, 64);
    else
        *self = m;
    return status;
}

static void close_mutant(void *self)
{
    mutant *m = self;
    tahr_allocator a = m->host->allocator;
    native()->close(m->inner);
    a.free(a.user, m, sizeof *m, 64);
}

static void change_shape(uint32_t which, tahr_shape *s, tahr_quat *orientation)
{
    switch (which) {
    case WIDER_BY_A_MILLIMETRE:
        s->radius += s->radius > 0 ? 0.001 : 0;
        if (s->type == TAHR_SHAPE_SPHERE) s->half_height = s->radius;
        break;
    case SPHERE_IS_A_CAPSULE:
        if (s->type == TAHR_SHAPE_SPHERE) {
            s->type = TAHR_SHAPE_CAPSULE;
            s->half_height = 1.2 * s->radius;
        }
        break;
    case CAPSULE_IS_A_BOX:
        if (s->type == TAHR_SHAPE_CAPSULE) {
            s->type = TAHR_SHAPE_BOX;
            s->half_x = s->half_y = s->radius;
            s->radius = 0;
        }
        break;
    case BOX_IS_A_CAPSULE:
        if (s->type == TAHR_SHAPE_BOX) {
            s->type = TAHR_SHAPE_CAPSULE;
            s->radius = s->half_x;
        }
        break;
    case YAW_IGNORED: *orientation = (tahr_quat){0, 0, 0, 1}; break;
    default: break;
    }
}

static tahr_vec3 in_steps(tahr_vec3 p, double step)
{
    return (tahr_vec3){floor(p.x / step + 0.5) * step, floor(p.y / step + 0.5) * step, floor(p.z / step + 0.5) * step};
}

static void change_sweep(const mutant *m, tahr_sweep *q)
{
    double way = length(q->motion);
    change_shape(m->which, &q->shape, &q->orientation);
    switch (m->which) {
    case MARGIN_IGNORED:
    case MARGIN_ALONG_THE_MOTION: q->margin = 0; break;
    case SEES_BEYOND_THE_MOTION: q->motion = scaled(q->motion, way > 0 ? (way + 0.001) / way : 1); break;
    case ABSOLUTE_MARGIN: q->margin = q->margin < 0.01 && q->margin > 0 ? 0.01 : q->margin; break;
    case MOTIONS_CLAMPED: q->motion = scaled(q->motion, way > 1000 ? 1000 / way : 1); break;
    case LEAVE_OVERLAP_IGNORED: q->flags &= ~(uint32_t)TAHR_SWEEP_LEAVE_OVERLAP; break;
    case MASK_IGNORED: q->mask = 0xFFFFFFFFu; break;
    case IGNORE_BODY_IGNORED: q->ignore_body = q->flags & TAHR_SWEEP_ONLY_BODY ? q->ignore_body : TAHR_NO_BODY; break;
    case ONLY_BODY_IGNORED:
        if (q->flags & TAHR_SWEEP_ONLY_BODY) q->ignore_body = TAHR_NO_BODY;
        q->flags &= ~(uint32_t)TAHR_SWEEP_ONLY_BODY;
        break;
    case SENSORS_FLAG_IGNORED: q->flags &= ~(uint32_t)TAHR_SWEEP_SENSORS; break;
    case SEVENTH_BODY_IS_MISSED: q->ignore_body = 6; break;
    case POSITIONS_IN_FLOAT:
        q->position = (tahr_vec3){(float)q->position.x, (float)q->position.y, (float)q->position.z};
        break;
    case GRID_OF_MILLIMETRES:
        if (length(q->position) > 1000) q->position = in_steps(q->position, 0.0037);
        break;
    case UP_IS_ALWAYS_Z:
        q->up = (tahr_vec3){0, 0, 1};
        q->orientation = (tahr_quat){0, 0, 0, 1};
        break;
    case PLACING_IGNORED: break;
    default: break;
    }
}

/* A hit where none should be: against the nearest surface within the margin and a little, at once. */
static void block_here(mutant *m, tahr_query_context *context, const tahr_sweep *q, tahr_hit *hit, uint32_t *count)
{
    tahr_contact c[1];
    uint32_t n = 0;
    tahr_contact_query near = {q->shape, q->position, q->up, q->orientation, 0.011, q->mask, q->ignore_body, 0, 0};
    native()->contacts(m->inner, context, &near, c, 1, &n);
    if (n == 0 || *count > 0) return;
    double way = length(q->motion), approach = dot(q->motion, c->normal);
    int level = fabs(approach) <= 1e-12 * way && way > 0, wall = fabs(c->normal.x) > 0.5;
    int in_slop = c->distance > 0.006 && c->distance < 0.009;
    int wrong = (m->which == BLOCKS_PARALLEL_MOTION && level && !wall) ||
                (m->which == BLOCKS_PARALLEL_MOTION_IN_ITS_SLOP && level && !wall && in_slop) ||
                (m->which == BLOCKS_MOTION_ALONG_WALLS && level && wall) ||
                (m->which == BLOCKS_SEPARATING_MOTION && approach > 0) ||
                (m->which == BLOCKS_WITHOUT_MOTION && way == 0);
    if (!wrong) return;
    memset(hit, 0, sizeof *hit);
    hit->blocking = 1;
    hit->distance = c->distance;
    hit->normal = hit->surface_normal = c->normal;
    hit->point = c->point;
    hit->body = c->body;
    *count = 1;
}

static void snap_normal(tahr_vec3 *n)
{
    tahr_vec3 a = {fabs(n->x), fabs(n->y), fabs(n->z)};
    if (a.x >= a.y && a.x >= a.z)
        *n = (tahr_vec3){n->x < 0 ? -1 : 1, 0, 0};
    else
        *n = a.y >= a.z ? (tahr_vec3){0, n->y < 0 ? -1 : 1, 0} : (tahr_vec3){0, 0, n->z < 0 ? -1 : 1};
}

/* How the first blocking hit is broken. Returns 0 if it is not there any more. */
static int change_hit(mutant *m, const tahr_query_context *context, const tahr_sweep *q, tahr_hit *h)
{
    const tahr_vec3 z = {0, 0, 1};
    double way = length(q->motion), approach = -dot(q->motion, h->normal);
    double millimetre = way > 0 ? 0.001 / way : 0;
    switch (m->which) {
    case LATE_BY_A_MILLIMETRE: h->fraction += h->start_overlap ? 0 : millimetre; break;
    case EARLY_BY_A_MILLIMETRE: h->fraction -= h->fraction > millimetre ? millimetre : 0; break;
    case ABSOLUTE_TOLERANCE: h->fraction -= h->fraction > 0.05 * millimetre ? 0.05 * millimetre : 0; break;
    case MARGIN_ALONG_THE_MOTION: h->fraction -= way > 0 ? q->margin / way : 0; break;
    case MARGIN_IGNORED: break;
    case NORMAL_FLIPPED: h->normal = scaled(h->normal, -1); break;
    case NORMAL_NOT_UNIT: h->normal = scaled(h->normal, 1.002); break;
    case NORMAL_OF_AN_AXIS: snap_normal(&h->normal); break;
    case NORMAL_ALWAYS_UP: h->normal = h->surface_normal = z; break;
    case SURFACE_NORMAL_IS_CONTACT_NORMAL: h->surface_normal = h->normal; break;
    case SURFACE_NORMAL_ALWAYS_UP: h->surface_normal = z; break;
    case FREE_AT_THE_MARGIN: return h->fraction > 0 || h->start_overlap;
    case FREE_JUST_OUTSIDE_THE_MARGIN: return h->fraction * approach > 2e-6 || h->fraction == 0;
    case FREE_A_MILLIMETRE_OUTSIDE: return h->fraction * approach > 0.002 || h->fraction == 0;
    case LEVEL_MOTIONS_ENTER_THE_MARGIN: return h->fraction > 0 || h->start_overlap || q->motion.z != 0;
    case LEVEL_MOTIONS_MISS_WHAT_IS_NEAR: return h->fraction == 0 || h->fraction >= 1e-3 || q->motion.z != 0;
    case FREE_WHEN_TOUCHING: return fabs(h->distance) > 1e-9;
    case GRAZES_MISSED: return approach > 0.01 * way;
    case SEES_BEYOND_THE_MOTION: h->fraction *= way > 0 ? (way + 0.001) / way : 1; break;
    case DISTANCE_NOT_SAID: h->distance = 0; break;
    case OVERLAP_NOT_REPORTED: return !h->start_overlap;
    case DEPTH_DOUBLED: h->depth *= 2; break;
    case WALLS_BEFORE_FLOORS: return !(h->normal.z > 0.5 && q->motion.x > 0.9 && q->motion.z < -0.9);
    case SEAMS_ARE_FELT:
        if (fabs(h->point.x - floor(h->point.x + 0.5)) < 0.05) h->normal = (tahr_vec3){-0.6, 0, 0.8};
        break;
    case SEAMS_BLOCK:
        if (fabs(h->point.x - floor(h->point.x + 0.5)) < 0.05) h->fraction = 0;
        break;
    case FAST_MOTIONS_TUNNEL: return way < 50;
    case MOTIONS_CLAMPED: h->fraction *= way > 1000 ? 1000 / way : 1; break;
    case ANSWERS_ALTERNATE: h->fraction *= m->asked % 7 == 0 ? 1 - 1e-15 : 1; break;
    case CACHE_CHANGES_BITS: h->fraction *= context->cache ? 1 - 1e-15 : 1; break;
    case PREPARE_CHANGES_BITS: h->fraction *= m->prepared ? 1 - 1e-15 : 1; break;
    case FRACTION_IS_NAN: h->fraction = strtod("nan", NULL); break;
    case FRACTION_IS_MINUS_ONE: h->fraction = -1; break;
    case ALWAYS_UNKNOWN: h->unknown = 1; break;
    case HIGHEST_FEATURE_OF_A_TIE: h->feature += h->feature % 2 == 0; break;
    case SURFACE_DATA_LOST: h->surface = h->walkable_rule = 0; break;
    default: break;
    }
    return 1;
}

/* The last of those that are as early. */
static void take_last_of_tie(mutant *m, tahr_query_context *context, const tahr_sweep *q, tahr_hit *hit)
{
    tahr_sweep again = *q;
    tahr_hit other;
    uint32_t n = 0;
    again.ignore_body = hit->body;
    native()->sweep(m->inner, context, &again, &other, 1, &n);
    if (n == 1 && other.fraction == hit->fraction && other.body > hit->body) *hit = other;
}

static void swap_sensors(tahr_hit *hits, uint32_t count)
{
    if (count > 2) {
        tahr_hit first = hits[0];
        hits[0] = hits[1];
        hits[1] = first;
    }
}

/* Whole answers that are broken. */
static tahr_status change_answer(mutant *m, const tahr_sweep *q, tahr_hit *hits, uint32_t capacity, uint32_t *count)
{
    uint32_t kept = 0;
    switch (m->which) {
    case SENSORS_IN_WRONG_ORDER: swap_sensors(hits, *count); break;
    case SENSORS_FORGOTTEN:
        for (uint32_t i = 0; i < *count; i++) {
            if (!hits[i].sensor) hits[kept++] = hits[i];
        }
        *count = kept;
        break;
    case SENSORS_BEHIND_THE_WALL:
        if (capacity > *count && *count > 1 && hits[*count - 1].blocking) {
            hits[*count] = hits[0];
            hits[(*count)++].fraction = 1;
        }
        break;
    case NAN_GIVES_NINE_ANSWERS:
        if (q->position.x != q->position.x) *count = 9;
        break;
    case EMPTY_WORLD_HAS_A_FLOOR:
        if (m->body_count == 0 && q->motion.z < 0) {
            memset(hits, 0, sizeof *hits);
            hits->blocking = 1;
            hits->fraction = 0.5;
            hits->normal = hits->surface_normal = (tahr_vec3){0, 0, 1};
            *count = 1;
        }
        break;
    default: break;
    }
    return TAHR_OK;
}

/* Sensors taken for walls: the first thing on the way blocks. */
static tahr_status sweep_all_solid(mutant *m, tahr_query_context *context, const tahr_sweep *q, tahr_hit *hits,
                                   uint32_t *count)
{
    tahr_hit all[8];
    tahr_status status = native()->sweep(m->inner, context, q, all, 8, count);
    if (*count > 1) *count = 1;
    if (*count) {
        hits[0] = all[0];
        hits->blocking = 1;
        hits->sensor = 0;
    }
    return status < 0 ? status : TAHR_OK;
}

static tahr_status sweep(void *self, tahr_query_context *context, const tahr_sweep *query, tahr_hit *hits,
                         uint32_t capacity, uint32_t *count)
{
    mutant *m = self;
    tahr_sweep q = *query;
    change_sweep(m, &q);
    if (m->which == SENSORS_BLOCK) return sweep_all_solid(m, context, &q, hits, count);
    tahr_status status = native()->sweep(m->inner, context, &q, hits, capacity, count);
    m->asked++;
    if (status >= 0 && *count > 0 && hits[*count - 1].blocking) {
        if (m->which == HIGHEST_BODY_OF_A_TIE) take_last_of_tie(m, context, &q, &hits[*count - 1]);
        *count -= !change_hit(m, context, query, &hits[*count - 1]);
        if (*count && hits[*count - 1].fraction > 1) hits[*count - 1].fraction = 1;
    }
    if (status >= 0) block_here(m, context, &q, hits, count);
    if (status >= 0) change_answer(m, &q, hits, capacity, count);
    return status;
}

static void change_contact(mutant *m, tahr_contact *c)
{
    switch (m->which) {
    case CONTACT_DISTANCE_UNSIGNED: c->distance = fabs(c->distance); break;
    case CONTACT_NORMAL_FLIPPED: c->normal = scaled(c->normal, -1); break;
    case CONTACTS_WITHOUT_FEATURES: c->feature = 0; break;
    case CONTACTS_NAME_ANOTHER_TRIANGLE: c->feature ^= 1; break;
    case CONTACTS_FORGET_WHO_IS_A_SENSOR: c->sensor = 0; break;
    default: break;
    }
}

static tahr_status contacts(void *self, tahr_query_context *context, const tahr_contact_query *query,
                            tahr_contact *contacts, uint32_t capacity, uint32_t *count)
{
    mutant *m = self;
    tahr_contact_query q = *query;
    change_shape(m->which, &q.shape, &q.orientation);
    q.margin *= m->which == CONTACT_MARGIN_DOUBLED ? 2 : 1;
    q.ignore_body = m->which == SEVENTH_BODY_HAS_NO_CONTACTS ? 6 : q.ignore_body;
    tahr_status status = native()->contacts(m->inner, context, &q, contacts, capacity, count);
    for (uint32_t i = 0; i < *count; i++)
        change_contact(m, &contacts[i]);
    if (m->which == CONTACTS_IN_WRONG_ORDER && *count > 1) {
        tahr_contact first = contacts[0];
        contacts[0] = contacts[*count - 1];
        contacts[*count - 1] = first;
    }
    if (m->which == CONTACTS_FORGET_THE_NEAREST && *count > 0) {
        memmove(contacts, contacts + 1, (*count - 1) * sizeof contacts[0]);
        --*count;
    }
    if (m->which == CONTACTS_LOSE_PLACED_BODIES && m->placed) *count = 0;
    if (m->which == NAN_GIVES_NINE_CONTACTS && isnan(q.position.x)) *count = 9;
    if (m->which == WRITES_BEYOND_CAPACITY && *count == 1 && capacity == 1) contacts[1] = contacts[0];
    return m->which == TRUNCATION_NOT_SAID && status == TAHR_TRUNCATED ? TAHR_OK : status;
}

static tahr_status ray(void *self, tahr_query_context *context, const tahr_ray *query, tahr_hit *hit, uint32_t *count)
{
    mutant *m = self;
    tahr_ray q = *query;
    q.mask = m->which == RAYS_IGNORE_MASKS ? 0xFFFFFFFFu : q.mask;
    tahr_status status = native()->ray(m->inner, context, &q, hit, count);
    if (m->which == RAYS_LOSE_PLACED_BODIES && m->placed) *count = 0;
    if (m->which == NAN_GIVES_NINE_RAYS && isnan(q.origin.x)) *count = 9;
    if (m->which == RAYS_WITHOUT_FEATURES) hit->feature = 0;
    if (m->which == RAYS_NAME_ANOTHER_TRIANGLE) hit->feature ^= 1;
    if (m->which == RAYS_A_MILLIMETRE_LATE && *count) hit->fraction += 0.001 / length(q.motion);
    return status;
}

static size_t cache_size(void *self)
{
    return native()->cache_size(((mutant *)self)->inner);
}

static tahr_status prepare(void *self, tahr_query_context *context, const tahr_prepare *announcement)
{
    mutant *m = self;
    m->prepared = 1;
    return native()->prepare(m->inner, context, announcement);
}

static tahr_status place(void *self, const tahr_body_pose *poses, uint32_t count)
{
    mutant *m = self;
    m->placed = 1;
    return m->which == PLACING_IGNORED ? TAHR_OK : native()->place(m->inner, poses, count);
}

static tahr_status fluid(void *self, tahr_query_context *context, const tahr_fluid_query *query, tahr_fluid *answer)
{
    mutant *m = self;
    tahr_status status = native()->fluid(m->inner, context, query, answer);
    answer->immersion *= m->which == IMMERSION_HALVED ? 0.5 : 1;
    return status;
}

/* The floor under the end of a walk, whatever is in its way. */
static uint32_t floor_behind(mutant *m, tahr_query_context *context, const tahr_walk *w, tahr_hit *hit)
{
    uint32_t count = 0;
    const tahr_sweep down = {.shape = *w->foot,
                             .position = w->foot_position,
                             .up = w->up,
                             .orientation = {0, 0, 0, 1},
                             .motion = w->foot_motion,
                             .margin = w->margin,
                             .mask = w->mask,
                             .ignore_body = TAHR_NO_BODY};
    native()->sweep(m->inner, context, &down, hit, 1, &count);
    return count == 1 && hit->blocking && !hit->start_overlap;
}

static tahr_status walk(void *self, tahr_query_context *context, const tahr_walk *walk, tahr_hit *hit, uint32_t *known)
{
    mutant *m = self;
    tahr_status status = native()->walk(m->inner, context, walk, hit, known);
    if (m->which == WALKS_OFF_BY_ROUNDING && *known && walk->foot) hit->distance += 1e-15;
    if (m->which == FALLS_THROUGH_FLOORS && !walk->foot) *known = 1;
    if (m->which == SEES_NOTHING_TOO_FAR && !walk->foot && *known) hit->distance += 2;
    if (m->which == WALKS_THROUGH_WALLS && !*known && walk->foot) *known = floor_behind(m, context, walk, hit);
    return status;
}

static const tahr_backend backend = {
    .struct_size = sizeof backend,
    .abi_major = TAHR_ABI_MAJOR,
    .abi_minor = TAHR_ABI_MINOR,
    .capabilities = TAHR_CAP_MARGIN | TAHR_CAP_CONTACTS | TAHR_CAP_RAY | TAHR_CAP_SPHERE | TAHR_CAP_CAPSULE |
                    TAHR_CAP_BOX | TAHR_CAP_MESH | TAHR_CAP_SOLIDS | TAHR_CAP_HULLS | TAHR_CAP_HEIGHTS |
                    TAHR_CAP_SENSORS,
    .name = "mutant",
    .version = "1",
    .open = open,
    .close = close_mutant,
    .sweep = sweep,
    .contacts = contacts,
    .ray = ray,
    .cache_size = cache_size,
    .prepare = prepare,
    .place = place,
    .fluid = fluid,
    .walk = walk,
};

const tahr_backend *mutant_backend(void)
{
    return &backend;
}
