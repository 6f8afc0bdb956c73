/* SPDX-License-Identifier: MIT
 * engine_v3.c: what Box2D 3 does for the backend. TAHR_BOX2D_3_ORIGIN: its world queries take an origin (since 3.2);
 * asked of the headers when the build is configured, for b2GetVersion does not tell. */
#include "engine.h"

#include <stdlib.h>

#include <box2d/box2d.h>

/* Bits of an id that are the body's index; the others are the low ones of its generation. */
enum { INDEX_BITS = 20, GENERATION_BITS = 12 };

static b2AABB aabb_of(const tahr__b2_box *box)
{
    b2AABB aabb;
    aabb.lowerBound.x = tahr__b2_down(box->low.x);
    aabb.lowerBound.y = tahr__b2_down(box->low.y);
    aabb.upperBound.x = tahr__b2_up(box->high.x);
    aabb.upperBound.y = tahr__b2_up(box->high.y);
    return aabb;
}

static void *tree_open(void)
{
    b2DynamicTree *tree = malloc(sizeof *tree);
    if (tree) *tree = b2DynamicTree_Create(16);
    return tree;
}

static void tree_close(void *tree)
{
    b2DynamicTree_Destroy(tree);
    free(tree);
}

static int32_t tree_add(void *tree, const tahr__b2_box *box, uint32_t item)
{
    return b2DynamicTree_CreateProxy(tree, aabb_of(box), 1, item);
}

static int32_t tree_move(void *tree, int32_t proxy, const tahr__b2_box *box, uint32_t item)
{
    (void)item;
    b2DynamicTree_MoveProxy(tree, proxy, aabb_of(box));
    return proxy;
}

typedef struct tree_question {
    tahr__b2_found_fn found;
    void *user;
} tree_question;

static bool take_proxy(int proxy, uint64_t item, void *context)
{
    const tree_question *q = context;
    (void)proxy;
    q->found(q->user, (uint32_t)item);
    return true;
}

static void tree_ask(const void *tree, const tahr__b2_box *box, tahr__b2_found_fn found, void *user)
{
    tree_question q = {found, user};
    b2DynamicTree_Query(tree, aabb_of(box), ~(uint64_t)0, take_proxy, &q);
}

static b2WorldId world_of(const tahr_box2d_desc *desc)
{
    return b2LoadWorldId(desc->world3);
}

/* Box2D takes its first world for valid before anybody created it, and crashes on what is asked of it; so it is, too,
 * in a second copy of Box2D, whose worlds are elsewhere. A world that was created has a limit of speed. */
static int is_there(b2WorldId world)
{
    return b2World_IsValid(world) && b2World_GetMaximumLinearSpeed(world) > 0;
}

static const char *world_check(const tahr_box2d_desc *desc)
{
    if (!is_there(world_of(desc))) {
        return "options.world3 (b2StoreWorldId) is no world of this Box2D; a program with Box2D 3 as a static library "
               "links libtahr_box2d.a";
    }
    if (desc->body_id) return "options.body_id is for Box2D 2.4: ids of 3 are its own";
    return b2World_GetCounters(world_of(desc)).bodyCount >= 1 << INDEX_BITS ? "options.world3 holds too many bodies"
                                                                            : NULL;
}

static uint32_t id_of(b2BodyId body)
{
    return ((uint32_t)(body.index1 - 1) & ((1u << INDEX_BITS) - 1)) | (uint32_t)body.generation << INDEX_BITS;
}

/* An id has 12 of 16 bits of the generation: of the bodies that it may mean one lives, or none. */
static int find_body(const tahr_box2d_desc *desc, uint32_t id, b2BodyId *body)
{
    body->index1 = (int32_t)(id & ((1u << INDEX_BITS) - 1)) + 1;
    body->world0 = (uint16_t)(world_of(desc).index1 - 1);
    for (uint32_t high = 0; high < 1u << (16 - GENERATION_BITS); high++) {
        body->generation = (uint16_t)(high << GENERATION_BITS | id >> INDEX_BITS);
        if (b2Body_IsValid(*body)) return 1;
    }
    return 0;
}

typedef struct world_question {
    const tahr_box2d_desc *desc;
    const tahr__b2_search *search;
} world_question;

static tahr__vec2 place(const world_question *q, b2WorldTransform xf, b2Vec2 v)
{
    double c = xf.q.c, s = xf.q.s, x = v.x, y = v.y;
    double px = (double)xf.p.x - q->search->origin.x, py = (double)xf.p.y - q->search->origin.y;
    return f_make(px + (c * x - s * y), py + (s * x + c * y));
}

static void set_segment(const world_question *q, b2WorldTransform xf, b2Segment segment, tahr__b2_piece *piece)
{
    piece->flat.count = 2;
    piece->flat.corner[0] = place(q, xf, segment.point1);
    piece->flat.corner[1] = place(q, xf, segment.point2);
}

static void set_chain(const world_question *q, b2WorldTransform xf, b2ChainSegment chain, tahr__b2_piece *piece)
{
    set_segment(q, xf, chain.segment, piece);
    piece->flat.one_sided = !(piece->owner.flags & TAHR_BODY_TWO_SIDED);
    piece->flat.lone = 0;
    piece->ghosts = TAHR__B2_GHOST_BEFORE | TAHR__B2_GHOST_AFTER;
    piece->before = place(q, xf, chain.ghost1);
    piece->after = place(q, xf, chain.ghost2);
}

static void set_polygon(const world_question *q, b2WorldTransform xf, const b2Polygon *polygon, tahr__b2_piece *piece)
{
    piece->flat.count = polygon->count;
    piece->flat.radius = polygon->radius;
    for (int i = 0; i < polygon->count; i++)
        piece->flat.corner[i] = place(q, xf, polygon->vertices[i]);
}

static void set_capsule(const world_question *q, b2WorldTransform xf, b2Capsule capsule, tahr__b2_piece *piece)
{
    set_segment(q, xf, (b2Segment){capsule.center1, capsule.center2}, piece);
    piece->flat.radius = capsule.radius;
}

static int set_shape(const world_question *q, b2WorldTransform xf, b2ShapeId shape, tahr__b2_piece *piece)
{
    b2Polygon polygon;
    b2Circle circle;

    piece->flat.radius = 0;
    piece->flat.one_sided = 0;
    piece->flat.lone = 1;
    switch (b2Shape_GetType(shape)) {
    case b2_circleShape:
        circle = b2Shape_GetCircle(shape);
        piece->flat.count = 1;
        piece->flat.radius = circle.radius;
        piece->flat.corner[0] = place(q, xf, circle.center);
        return 1;
    case b2_capsuleShape: set_capsule(q, xf, b2Shape_GetCapsule(shape), piece); return 1;
    case b2_segmentShape: set_segment(q, xf, b2Shape_GetSegment(shape), piece); return 1;
    case b2_polygonShape:
        polygon = b2Shape_GetPolygon(shape);
        set_polygon(q, xf, &polygon, piece);
        return 1;
    case b2_chainSegmentShape: set_chain(q, xf, b2Shape_GetChainSegment(shape), piece); return 1;
    default: return 0;
    }
}

static bool take_shape(b2ShapeId shape, void *context)
{
    const world_question *q = context;
    const b2Filter filter = b2Shape_GetFilter(shape);
    b2BodyId body = b2Shape_GetBody(shape);
    tahr_box2d_shape told = {.shape = &shape, .body = id_of(body)};
    tahr__b2_piece piece;

    if (!tahr__b2_filter(q->desc, filter.categoryBits, filter.maskBits, filter.groupIndex)) return true;
    told.flags = b2Shape_IsSensor(shape) ? (uint32_t)TAHR_BODY_SENSOR : 0u;
    told.surface = (uint32_t)b2Shape_GetUserMaterial(shape);
    if (q->desc->shape) q->desc->shape(q->desc->user, &told);
    if (told.hidden) return true;
    piece.owner = (tahr__surface){.id = id_of(body),
                                  .flags = told.flags,
                                  .surface = told.surface,
                                  .walkable_rule = told.walkable_rule,
                                  .walkable_angle = told.walkable_angle,
                                  .mask = (uint32_t)(filter.categoryBits | filter.categoryBits >> 32)};
    piece.feature = (uint32_t)(shape.index1 - 1)
                    << 3; /* room for the faces of a polygon, of which Box2D has at most 8 */
    piece.is_box = 0;
    piece.ghosts = TAHR__B2_NO_GHOST;
    if (set_shape(q, b2Body_GetTransform(body), shape, &piece)) q->search->take(q->search->user, &piece);
    return true;
}

/* The filter is ours: a group overrules the bits, which Box2D's queries do not know. */
static void world_ask(const tahr_box2d_desc *desc, const tahr__b2_search *search)
{
    world_question q = {desc, search};
    b2QueryFilter all = {~(uint64_t)0, ~(uint64_t)0};
#ifdef TAHR_BOX2D_3_ORIGIN
    b2Pos zero = {0, 0};
    b2World_OverlapAABB(world_of(desc), zero, aabb_of(&search->box), all, take_shape, &q);
#else
    b2World_OverlapAABB(world_of(desc), aabb_of(&search->box), all, take_shape, &q);
#endif
}

static tahr_status world_motion(const tahr_box2d_desc *desc, uint32_t id, tahr_body_motion *motion)
{
    const b2Vec2 middle = {0, 0};
    b2WorldTransform xf;
    b2BodyId body;
    b2Vec2 speed;

    if (!find_body(desc, id, &body) || !b2Body_IsEnabled(body)) return TAHR_E_NOT_FOUND;
    xf = b2Body_GetTransform(body);
    motion->pose.position = (tahr_vec3){(double)xf.p.x, (double)xf.p.y, 0};
    motion->pose.orientation = tahr__b2_quat(xf.q.c, xf.q.s);
    motion->flags = b2Body_GetType(body) == b2_staticBody ? (uint32_t)TAHR_BODY_NO_BASE : 0u;
    if (motion->flags) return TAHR_OK;
    speed = b2Body_GetLocalPointVelocity(body, middle);
    motion->velocity = (tahr_vec3){(double)speed.x, (double)speed.y, 0};
    motion->angular_velocity = (tahr_vec3){0, 0, (double)b2Body_GetAngularVelocity(body)};
    motion->mass = b2Body_GetType(body) == b2_dynamicBody ? (double)b2Body_GetMass(body) : 0;
    return TAHR_OK;
}

const tahr__b2_engine tahr__b2_engine_3 = {
    .version = "3",
    .tree_open = tree_open,
    .tree_close = tree_close,
    .tree_add = tree_add,
    .tree_move = tree_move,
    .tree_ask = tree_ask,
    .world_check = world_check,
    .world_ask = world_ask,
    .world_motion = world_motion,
};
