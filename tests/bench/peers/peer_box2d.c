/* SPDX-License-Identifier: MIT
 * peer_box2d.c: the geometric mover of Box2D 3: collide, solve planes, cast, until nothing moves any more, then clip the
 * velocity. The loop is that of Box2D's own sample but for the spring ("pogo stick") on which that rides above the
 * ground: it would hold the course's capsule off the ground and under no ceiling. */
#include <box2d/box2d.h>

#include <float.h>
#include <stdio.h>
#include <stdlib.h>

#include "method_outline.h"
#include "peer.h"

enum { MAX_PLANES = 8, MAX_ROUNDS = 5 }; /* as in the sample */

static const float STILL = 0.01f; /* m: a round that moved less was the last; the sample's tolerance */

typedef struct character {
    b2Vec2 position, velocity;
    int grounded;
    uint32_t queries;
} character;

typedef struct crowd {
    b2WorldId world;
    b2Capsule capsule;
    character *characters;
    float dt, gravity, jump_speed, ground_normal; /* ground_normal: the least y of one that carries */
} crowd;

typedef struct planes {
    b2CollisionPlane list[MAX_PLANES];
    int count;
} planes;

static void set_chain(b2BodyId body, const method_outline *outline, const method_line *line, b2Vec2 *room)
{
    b2ChainDef def = b2DefaultChainDef();
    uint32_t n = line->count, count = 0;
    const double *p = outline->points + 2 * (size_t)line->first;
    if (!line->loop) { /* an open chain begins and ends with a point that only guides */
        room[count++] = (b2Vec2){(float)(2 * p[0] - p[2]), (float)(2 * p[1] - p[3])};
    }
    for (uint32_t i = 0; i < n; i++) {
        room[count++] = (b2Vec2){(float)p[2 * i], (float)p[2 * i + 1]};
    }
    if (!line->loop) {
        room[count++] = (b2Vec2){(float)(2 * p[2 * n - 2] - p[2 * n - 4]), (float)(2 * p[2 * n - 1] - p[2 * n - 3])};
    }
    def.points = room;
    def.count = (int)count;
    def.isLoop = line->loop;
    b2CreateChain(body, &def);
}

static int build(crowd *c, const method_level *level)
{
    method_outline outline;
    int made = method_outline_make(&outline, level);
    b2Vec2 *room = malloc(sizeof *room * (outline.point_count + 2));
    b2WorldDef def = b2DefaultWorldDef();
    def.gravity = (b2Vec2){0, -c->gravity};
    c->world = b2CreateWorld(&def);
    if (made && room) {
        b2BodyDef ground = b2DefaultBodyDef();
        b2BodyId body = b2CreateBody(c->world, &ground);
        for (uint32_t i = 0; i < outline.line_count; i++) {
            set_chain(body, &outline, &outline.lines[i], room);
        }
    }
    free(room);
    method_outline_free(&outline);
    return made && room != NULL;
}

static void close_crowd(void *self)
{
    crowd *c = self;
    if (b2World_IsValid(c->world)) {
        b2DestroyWorld(c->world);
    }
    free(c->characters);
    free(c);
}

static void *open_crowd(const method *m, const method_level *level, const method_character *who, uint32_t count,
                        char *error)
{
    (void)m;
    if (!level->planar) {
        snprintf(error, METHOD_ERROR, "two dimensions only");
        return NULL;
    }
    crowd *c = calloc(1, sizeof *c);
    if (c) {
        float core = (float)(who->half_height - who->radius);
        c->capsule = (b2Capsule){{0, -core}, {0, core}, (float)who->radius};
        c->dt = (float)who->dt;
        c->gravity = (float)who->gravity;
        c->jump_speed = (float)who->jump_speed;
        c->ground_normal = b2ComputeCosSin((float)who->walkable_angle).cosine;
        c->characters = calloc(count, sizeof *c->characters);
    }
    if (!c || !build(c, level) || !c->characters) {
        snprintf(error, METHOD_ERROR, "out of memory");
        if (c) {
            close_crowd(c);
        }
        return NULL;
    }
    return c;
}

static void place(void *self, uint32_t i, const double position[3])
{
    crowd *c = self;
    c->characters[i] = (character){.position = {(float)position[0], (float)position[1]}};
}

static bool take(b2ShapeId shape, const b2PlaneResult *plane, void *user)
{
    planes *p = user;
    (void)shape;
    if (plane->hit && p->count < MAX_PLANES) {
        p->list[p->count++] = (b2CollisionPlane){plane->plane, FLT_MAX, 0, true};
    }
    return true;
}

/* The way to a translation from where the character is: what collides there, and how far it goes. */
static void collide(const crowd *c, b2Vec2 at, planes *p)
{
    p->count = 0;
#ifdef PEER_BOX2D_ORIGIN
    b2World_CollideMover(c->world, b2ToPos(at), &c->capsule, b2DefaultQueryFilter(), take, p);
#else
    b2Capsule moved = {b2Add(c->capsule.center1, at), b2Add(c->capsule.center2, at), c->capsule.radius};
    b2World_CollideMover(c->world, &moved, b2DefaultQueryFilter(), take, p);
#endif
}

static float cast(const crowd *c, b2Vec2 at, b2Vec2 way)
{
#ifdef PEER_BOX2D_ORIGIN
    return b2World_CastMover(c->world, b2ToPos(at), &c->capsule, way, b2DefaultQueryFilter());
#else
    b2Capsule moved = {b2Add(c->capsule.center1, at), b2Add(c->capsule.center2, at), c->capsule.radius};
    return b2World_CastMover(c->world, &moved, way, b2DefaultQueryFilter());
#endif
}

static void step(void *self, uint32_t i, const double wish[3], int jump)
{
    crowd *c = self;
    character *one = &c->characters[i];
    planes p = {.count = 0};
    one->velocity.x = (float)wish[0];
    if (one->grounded) {
        one->velocity.y = jump ? c->jump_speed : 0;
    }
    one->velocity.y -= c->gravity * c->dt;
    b2Vec2 target = b2MulAdd(one->position, c->dt, one->velocity);
    one->queries = 0;
    for (int round = 0; round < MAX_ROUNDS; round++) {
        collide(c, one->position, &p);
        b2Vec2 way = b2SolvePlanes(b2Sub(target, one->position), p.list, p.count).translation;
        b2Vec2 delta = b2MulSV(cast(c, one->position, way), way);
        one->position = b2Add(one->position, delta);
        one->queries += 2;
        if (b2LengthSquared(delta) < STILL * STILL) {
            break;
        }
    }
    one->velocity = b2ClipVector(one->velocity, p.list, p.count);
    one->grounded = 0;
    for (int k = 0; k < p.count; k++) {
        one->grounded = one->grounded || (p.list[k].push > 0 && p.list[k].plane.normal.y > c->ground_normal);
    }
}

static void look(void *self, uint32_t i, method_place *out)
{
    const crowd *c = self;
    const character *one = &c->characters[i];
    *out = (method_place){.position = {one->position.x, one->position.y, 0},
                          .velocity = {one->velocity.x, one->velocity.y, 0},
                          .grounded = one->grounded,
                          .queries = one->queries};
}

PEER_EXPORT const method *method_box2d(void)
{
    static char version[32];
    b2Version v = b2GetVersion();
    snprintf(version, sizeof version, "%d.%d.%d", v.major, v.minor, v.revision);
    static method m = {.name = "box2d",
                       .version = version,
                       .settings = "the sample's loop (collide, solve planes, cast, at most 5 rounds, tolerance "
                                   "0.01) without its spring; outline as chains; steps up by roundness only",
                       .open = open_crowd,
                       .close = close_crowd,
                       .place = place,
                       .step = step,
                       .look = look};
    return &m;
}
