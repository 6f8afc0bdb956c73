/* SPDX-License-Identifier: MIT
 * scene.c: taking in a description, or a world of the user's; placing bodies, letting them go. */
#include "scene.h"

#include "../common/options.h"
#include "../common/room.h"

/* Box2D's trees hold floats, and version 3 none beyond 1e5 m: boxes end here (m from the middle of the scene). Boxes
 * that are cut off still meet each other, only less is told apart by the tree. */
#define TREE_END 9e4
/* Boxes in the tree are larger by this (m): floats are 0.008 m apart at TREE_END. */
#define TREE_SLACK 0.02

static double clamp(double x)
{
    return x < -TREE_END ? -TREE_END : x > TREE_END ? TREE_END : x;
}

static tahr__b2_box tree_box(const tahr__b2_scene *scene, tahr__b2_box world)
{
    tahr__b2_box box;

    box.low.x = clamp(world.low.x - scene->origin.x) - TREE_SLACK;
    box.low.y = clamp(world.low.y - scene->origin.y) - TREE_SLACK;
    box.high.x = clamp(world.high.x - scene->origin.x) + TREE_SLACK;
    box.high.y = clamp(world.high.y - scene->origin.y) + TREE_SLACK;
    return box;
}

static tahr__b2_box bounds_of(const tahr__flat *flat, double reach)
{
    tahr__b2_box box = {flat->corner[0], flat->corner[0]};

    for (int i = 1; i < flat->count; i++) {
        box.low.x = d_min(box.low.x, flat->corner[i].x);
        box.low.y = d_min(box.low.y, flat->corner[i].y);
        box.high.x = d_max(box.high.x, flat->corner[i].x);
        box.high.y = d_max(box.high.y, flat->corner[i].y);
    }
    reach += flat->radius;
    box.low = f_sub(box.low, f_make(reach, reach));
    box.high = f_add(box.high, f_make(reach, reach));
    return box;
}

static tahr__b2_box item_box(const tahr__b2_scene *scene, const tahr__b2_item *item)
{
    tahr__b2_piece piece;

    tahr__b2_body_piece(&scene->bodies[item->body], item->segment, f_make(0, 0), &piece);
    return tree_box(scene, bounds_of(&piece.flat, 0));
}

/* The middle of the bodies' positions. */
static tahr__vec2 middle_of(const tahr_world_desc *desc)
{
    tahr_vec3 low = desc->bodies[0].pose.position, high = low;

    for (uint32_t i = 1; i < desc->body_count; i++) {
        low = v_min(low, desc->bodies[i].pose.position);
        high = v_max(high, desc->bodies[i].pose.position);
    }
    return f_make(0.5 * (low.x + high.x), 0.5 * (low.y + high.y));
}

static tahr_status add_items(tahr__b2_scene *scene, uint32_t body)
{
    tahr__b2_body *b = &scene->bodies[body];

    b->first = scene->item_count;
    b->count = tahr__b2_body_items(b);
    for (uint32_t i = 0; i < b->count; i++) {
        tahr__b2_item *item = &scene->items[scene->item_count];
        tahr__b2_box box;
        item->body = body;
        item->segment = i;
        box = item_box(scene, item);
        item->proxy = scene->engine->tree_add(scene->tree, &box, scene->item_count);
        if (item->proxy < 0) return TAHR_E_MEMORY;
        scene->item_count++;
    }
    return TAHR_OK;
}

static tahr_status open_items(tahr__b2_scene *scene)
{
    tahr_status status = TAHR_OK;

    for (uint32_t i = 0; i < scene->body_count; i++)
        scene->item_capacity += tahr__b2_body_items(&scene->bodies[i]);
    scene->items = tahr__room_get(scene->host, scene->item_capacity, sizeof *scene->items);
    scene->tree = scene->items ? scene->engine->tree_open() : NULL;
    if (!scene->tree) return TAHR_E_MEMORY;
    for (uint32_t i = 0; i < scene->body_count && status >= 0; i++)
        status = add_items(scene, i);
    return status;
}

/* Fluids are those of space: what a plane does not know of them is as far as they reach along z. */
static void flatten(tahr__fluids *fluids)
{
    for (uint32_t i = 0; i < fluids->count; i++) {
        fluids->bodies[i].position.z = 0;
        fluids->bodies[i].half_extents.z = 1;
    }
}

static tahr_status open_bodies(tahr__b2_scene *scene, const tahr_world_desc *desc)
{
    tahr_status status = TAHR_OK;

    if (desc->body_count == 0) return TAHR_OK;
    scene->bodies = tahr__room_get(scene->host, desc->body_count, sizeof *scene->bodies);
    if (!scene->bodies) return TAHR_E_MEMORY;
    scene->body_count = desc->body_count;
    for (uint32_t i = 0; i < desc->body_count && status >= 0; i++)
        status = tahr__b2_body_open(scene->host, &desc->bodies[i], i, &scene->bodies[i]);
    if (status < 0) return status;
    scene->origin = middle_of(desc);
    status = open_items(scene);
    if (status >= 0) status = tahr__fluids_open(&scene->fluids, scene->host, desc);
    flatten(&scene->fluids);
    return status;
}

static tahr_status attach(tahr__b2_scene *scene, const tahr_world_desc *desc)
{
    const char *problem;

    if (desc->body_count > 0) {
        tahr__log_error(scene->host, "desc.bodies must be empty where options names a world to attach to");
        return TAHR_E_ARGUMENT;
    }
    problem = scene->engine->world_check(&scene->desc);
    if (problem) {
        tahr__log_error(scene->host, problem);
        return TAHR_E_ARGUMENT;
    }
    scene->attached = 1;
    return TAHR_OK;
}

/* The engine asked for, or that of the world to attach to. */
static tahr_status choose(tahr__b2_scene *scene)
{
    const tahr_box2d_desc *d = &scene->desc;
    uint32_t engine = d->engine;

    if ((d->world2 && d->world3) || (d->world2 && engine == TAHR_BOX2D_3) || (d->world3 && engine == TAHR_BOX2D_2) ||
        (engine != TAHR_BOX2D_NEWEST && engine != TAHR_BOX2D_2 && engine != TAHR_BOX2D_3)) {
        tahr__log_error(scene->host, "options.engine is neither 0, 2 nor 3, or does not fit options.world2 or world3");
        return TAHR_E_ARGUMENT;
    }
    engine = d->world2 ? (uint32_t)TAHR_BOX2D_2 : d->world3 ? (uint32_t)TAHR_BOX2D_3 : engine;
#ifdef TAHR_BOX2D_HAS_2
    if (engine != TAHR_BOX2D_3) scene->engine = &tahr__b2_engine_2;
#endif
#ifdef TAHR_BOX2D_HAS_3
    if (engine != TAHR_BOX2D_2) scene->engine = &tahr__b2_engine_3;
#endif
    if (scene->engine) return TAHR_OK;
    tahr__log_error(scene->host, "options.engine is a Box2D that this library was built without");
    return TAHR_E_UNSUPPORTED;
}

tahr_status tahr__b2_open(const tahr_host *host, const tahr_world_desc *desc, void **self)
{
    tahr__b2_scene *scene = tahr__room_get(host, 1, sizeof *scene);

    if (!scene) return TAHR_E_MEMORY;
    scene->host = host;
    tahr_status status = tahr__options_read(host, desc->options, &scene->desc, sizeof scene->desc);
    if (status >= 0) status = choose(scene);
    if (status >= 0) status = scene->desc.world2 || scene->desc.world3 ? attach(scene, desc) : open_bodies(scene, desc);
    if (status < 0)
        tahr__b2_close(scene);
    else
        *self = scene;
    return status;
}

void tahr__b2_close(void *self)
{
    tahr__b2_scene *scene = self;

    if (!scene) return;
    for (uint32_t i = 0; i < scene->body_count; i++)
        tahr__b2_body_close(scene->host, &scene->bodies[i]);
    if (scene->tree) scene->engine->tree_close(scene->tree);
    tahr__room_put(scene->host, scene->items, scene->item_capacity, sizeof *scene->items);
    tahr__room_put(scene->host, scene->bodies, scene->body_count, sizeof *scene->bodies);
    tahr__fluids_close(&scene->fluids, scene->host);
    tahr__room_put(scene->host, scene, 1, sizeof *scene);
}

static const char *bad_pose(const tahr__b2_scene *scene, const tahr_body_pose *p)
{
    const tahr__b2_body *b = &scene->bodies[p->body];
    tahr_quat q = p->pose.orientation;
    tahr__vec2 turn;

    if (!(b->owner.flags & TAHR_BODY_MOVABLE)) return "flags: is not movable (TAHR_BODY_MOVABLE)";
    if (p->pose.position.x * 0 + p->pose.position.y * 0 + (q.x + q.y + q.z + q.w) * 0 != 0) return "pose: not finite";
    return tahr__b2_body_turn(b->type, b->vertex_count == 1, q, &turn);
}

tahr_status tahr__b2_place(void *self, const tahr_body_pose *poses, uint32_t count)
{
    tahr__b2_scene *scene = self;

    for (uint32_t i = 0; i < count; i++) {
        const char *problem;
        if (poses[i].body >= scene->body_count) return TAHR_E_NOT_FOUND;
        problem = bad_pose(scene, &poses[i]);
        if (!problem) continue;
        tahr__b2_log(scene->host, poses[i].body, problem);
        return TAHR_E_ARGUMENT;
    }
    for (uint32_t i = 0; i < count; i++) {
        tahr__b2_body *b = &scene->bodies[poses[i].body];
        tahr__b2_body_place(b, &poses[i].pose);
        for (uint32_t k = b->first; k < b->first + b->count; k++) {
            tahr__b2_box box = item_box(scene, &scene->items[k]);
            scene->items[k].proxy = scene->engine->tree_move(scene->tree, scene->items[k].proxy, &box, k);
        }
    }
    tahr__fluids_place(&scene->fluids, poses, count);
    flatten(&scene->fluids);
    return TAHR_OK;
}

/* One question to the engine. */
typedef struct question {
    const tahr__b2_probe *probe;
    tahr__vec2 origin;
    tahr__b2_box box; /* relative to the origin */
    tahr__b2_take_fn take;
    void *user;
} question;

/* Boxes in Box2D's trees are fat. */
static int is_near(const question *q, const tahr__flat *flat)
{
    tahr__b2_box box = bounds_of(flat, 0);
    return box.low.x <= q->box.high.x && q->box.low.x <= box.high.x && box.low.y <= q->box.high.y &&
           q->box.low.y <= box.high.y;
}

static void found_piece(void *user, tahr__b2_piece *piece)
{
    const question *q = user;
    tahr__flat *f = &piece->flat;

    if (!tahr__filter_passes(&q->probe->filter, &piece->owner) || !is_near(q, f)) return;
    if (f->count == 2 && f->corner[0].x == f->corner[1].x && f->corner[0].y == f->corner[1].y) {
        f->count = 1; /* an edge from a point to itself has no sides */
        f->one_sided = 0;
        piece->ghosts = TAHR__B2_NO_GHOST;
    }
    q->take(q->user, piece);
}

static void found_item(void *user, uint32_t index)
{
    const question *q = user;
    const tahr__b2_item *item = &q->probe->scene->items[index];
    const tahr__b2_body *body = &q->probe->scene->bodies[item->body];
    tahr__b2_piece piece;

    if (!tahr__filter_passes(&q->probe->filter, &body->owner)) return;
    tahr__b2_body_piece(body, item->segment, q->origin, &piece);
    if (is_near(q, &piece.flat)) q->take(q->user, &piece);
}

static void ask(question *q)
{
    const tahr__b2_scene *scene = q->probe->scene;
    tahr__b2_box world = {f_add(q->box.low, q->origin), f_add(q->box.high, q->origin)};

    if (scene->attached) {
        tahr__b2_search search = {world, q->origin, found_piece, q};
        scene->engine->world_ask(&scene->desc, &search);
    } else if (scene->tree) {
        world = tree_box(scene, world);
        scene->engine->tree_ask(scene->tree, &world, found_item, q);
    }
}

/* Boxes grow by this (m): far more than the rounding of coordinates at 1e7 m. */
#define SLACK 1e-5

void tahr__b2_each(const tahr__b2_probe *probe, tahr__b2_take_fn take, void *user)
{
    double reach = probe->shape.radius + probe->margin + SLACK;
    tahr__b2_box box = {{0, 0}, {0, 0}};

    for (int i = 0; i < probe->shape.count; i++) {
        tahr__vec2 from = probe->shape.corner[i], to = f_add(from, probe->motion);
        box.low = i == 0 ? from : f_make(d_min(box.low.x, from.x), d_min(box.low.y, from.y));
        box.high = i == 0 ? from : f_make(d_max(box.high.x, from.x), d_max(box.high.y, from.y));
        box.low = f_make(d_min(box.low.x, to.x), d_min(box.low.y, to.y));
        box.high = f_make(d_max(box.high.x, to.x), d_max(box.high.y, to.y));
    }
    box.low = f_sub(box.low, f_make(reach, reach));
    box.high = f_add(box.high, f_make(reach, reach));
    ask(&(question){probe, f_make(probe->origin.x, probe->origin.y), box, take, user});
}

void tahr__b2_each_at(const tahr__b2_probe *probe, tahr__vec2 point, double reach, tahr__b2_take_fn take, void *user)
{
    tahr__b2_box box = {f_sub(point, f_make(reach, reach)), f_add(point, f_make(reach, reach))};
    ask(&(question){probe, f_make(probe->origin.x, probe->origin.y), box, take, user});
}
