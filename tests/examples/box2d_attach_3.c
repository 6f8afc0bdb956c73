/* SPDX-License-Identifier: MIT
 * box2d_attach_3.c: a character in your own Box2D 3 world: chain ground, crates that Box2D moves, a lift, a one-way
 * platform, a gate that only feels. The twin of box2d_attach.cpp.
 *
 * By hand, with Tahr installed, PKG_CONFIG_PATH pointing to its lib/pkgconfig and BOX2D to the sources of Box2D 3 that
 * it was built with: program and backend share one Box2D, so the archives are linked (-lbox2d -lstdc++: if 2.4 was
 * there):
 *     cc -std=c11 -I$BOX2D/include box2d_attach_3.c $(pkg-config --cflags --libs-only-L tahr_box2d) \
 *         -Wl,-Bstatic -ltahr_box2d -ltahr -ltahr_box2d_3 -Wl,-Bdynamic -lbox2d -lstdc++ -lm -o box2d_attach_3 */
#include <math.h>
#include <stdio.h>

#include <box2d/box2d.h>
#include <tahr/box2d.h>
#include <tahr/tahr.h>

/* What shapes carry as their material, and what Tahr hands back as the surface of a hit. */
enum { PLAIN = 0, ONE_WAY = 7 };

typedef struct game {
    b2WorldId box2d;
    b2BodyId lift, crate;
    tahr_world *world;
    tahr_mover *mover;
    tahr_config config;
    tahr_state state;
    tahr_input input;
    tahr_event events[32];
    int gates, pushes;
} game;

/* How Tahr names a body of Box2D 3: see tahr/box2d.h. */
static uint32_t id_of(b2BodyId body)
{
    return (uint32_t)(body.index1 - 1) | (uint32_t)(body.generation & 0xFFF) << 20;
}

static b2BodyId add_box(game *g, b2BodyType type, b2Vec2 at, b2Vec2 half, b2ShapeDef shape)
{
    b2BodyDef def = b2DefaultBodyDef();
    def.type = type;
    def.position.x = at.x;
    def.position.y = at.y;
    b2BodyId body = b2CreateBody(g->box2d, &def);
    b2Polygon box = b2MakeBox(half.x, half.y);
    shape.density = 20;
    b2CreatePolygonShape(body, &shape, &box);
    return body;
}

/* Flat from -20 to 20; solid from above, which is on the right of who goes to the left. */
static void add_ground(game *g)
{
    b2Vec2 corners[83];
    b2BodyDef body = b2DefaultBodyDef();
    b2ChainDef chain = b2DefaultChainDef();
    for (int i = 0; i < 83; i++) {
        corners[i] = (b2Vec2){20.5f - 0.5f * (float)i, 0};
    }
    chain.points = corners; /* the first and the last only say how the line goes on */
    chain.count = 83;
    b2CreateChain(b2CreateBody(g->box2d, &body), &chain);
}

static void build(game *g)
{
    b2WorldDef def = b2DefaultWorldDef();
    b2ShapeDef plain = b2DefaultShapeDef(), gate = plain, one_way = plain;
    def.gravity = (b2Vec2){0, -9.81f};
    g->box2d = b2CreateWorld(&def);
    add_ground(g);
    gate.isSensor = true;
    one_way.material.userMaterialId = ONE_WAY;
    g->lift = add_box(g, b2_kinematicBody, (b2Vec2){12, -0.2f}, (b2Vec2){1.5f, 0.25f}, plain);
    add_box(g, b2_staticBody, (b2Vec2){4, 1}, (b2Vec2){0.2f, 1}, gate);
    add_box(g, b2_staticBody, (b2Vec2){0, 1.9f}, (b2Vec2){1, 0.1f}, one_way);
    g->crate = add_box(g, b2_dynamicBody, (b2Vec2){-6, 0.5f}, (b2Vec2){0.5f, 0.5f}, plain);
    add_box(g, b2_dynamicBody, (b2Vec2){-6, 1.5f}, (b2Vec2){0.4f, 0.4f}, plain);
}

/* What Box2D does not know of its shapes. */
static void describe(void *user, tahr_box2d_shape *shape)
{
    (void)user;
    shape->flags |= shape->surface == ONE_WAY ? (uint32_t)TAHR_BODY_ONE_WAY : 0u;
}

static void log_message(void *user, int32_t level, const char *message)
{
    (void)user, (void)level;
    printf("tahr: %s\n", message);
}

static int attach(game *g)
{
    tahr_log log = {NULL, log_message};
    tahr_box2d_desc options = {.struct_size = sizeof options, .world3 = b2StoreWorldId(g->box2d), .shape = describe};
    tahr_world_desc desc;
    const tahr_vec3 start = {-3, 1, 0};
    tahr_world_desc_init(&desc, sizeof desc);
    desc.options = &options;
    desc.log = &log;
    if (tahr_world_open(tahr_backend_v1_box2d(), &desc, &g->world) < 0) {
        return 0;
    }
    tahr_config_init(&g->config, sizeof g->config, TAHR_PRESET_PRECISE);
    g->config.gravity = (tahr_vec3){0, -9.81, 0};
    g->config.plane = (tahr_vec3){0, 0, 1};
    g->config.jump_speed = 7;
    g->input.struct_size = sizeof g->input;
    return tahr_mover_create(g->world, &g->config, &g->mover) >= 0 &&
           tahr_state_init(&g->state, &g->config, &start) >= 0;
}

/* What the step says that Box2D should know. */
static void react(game *g, const tahr_report *report)
{
    for (uint32_t i = 0; i < report->event_count; i++) {
        const tahr_event *e = &report->events[i];
        g->gates += e->type == TAHR_EVENT_OVERLAP_BEGIN;
        if (e->type == TAHR_EVENT_PUSHED && e->body == id_of(g->crate)) {
            b2Vec2 impulse = {(float)(-e->value * e->normal.x), (float)(-e->value * e->normal.y)};
            b2Pos at = {(float)e->position.x, (float)e->position.y};
            b2Body_ApplyLinearImpulse(g->crate, impulse, at, true);
            g->pushes++;
        }
    }
}

/* First Box2D, then whoever walks in its world. */
static int tick(game *g)
{
    const float dt = 1.0f / 60;
    tahr_report report = {.struct_size = sizeof report, .events = g->events, .event_capacity = 32};
    b2World_Step(g->box2d, dt, 4);
    tahr_world_touch(g->world);
    if (tahr_mover_step(g->mover, &g->input, dt, &g->state, &report) < 0) {
        return 0;
    }
    react(g, &report);
    g->input.jump = 0;
    return 1;
}

static int play(game *g, double move, int ticks)
{
    g->input.move = (tahr_vec3){move, 0, 0};
    for (int i = 0; i < ticks; i++) {
        if (!tick(g)) {
            return 0;
        }
    }
    printf("%-8s x %6.3f  y %6.3f  crate at %6.3f\n", tahr_mode_name(g->state.mode), g->state.position.x,
           g->state.position.y, (double)b2Body_GetPosition(g->crate).x);
    return 1;
}

/* To where x is, and then a moment of rest. */
static int walk_to(game *g, double x)
{
    double way = x > g->state.position.x ? 1 : -1;
    g->input.move = (tahr_vec3){way, 0, 0};
    for (int i = 0; i < 1000 && (x - g->state.position.x) * way > 0; i++) {
        if (!tick(g)) {
            return 0;
        }
    }
    return play(g, 0, 30);
}

/* How far the character is from the middle of the lift. */
static double place_on_lift(const game *g)
{
    return g->state.position.x - (double)b2Body_GetPosition(g->lift).x;
}

static int tour(game *g)
{
    int good = play(g, -1, 90); /* to the crates, and against them */
    const double crate = (double)b2Body_GetPosition(g->crate).x;
    good = good && g->pushes > 0 && crate < -6.05 && g->state.position.x > crate + 0.8;

    good = good && walk_to(g, 0);
    g->input.jump = 1;
    good = good && play(g, 0, 90); /* through the platform, and onto it */
    good = good && g->state.mode == TAHR_MODE_WALKING && g->state.position.y > 2.8;

    good = good && walk_to(g, 12); /* off the platform, through the gate, onto the lift */
    good = good && g->gates == 1;

    const double place = place_on_lift(g);
    b2Body_SetLinearVelocity(g->lift, (b2Vec2){0.5f, 1});
    good = good && play(g, 0, 120);
    good = good && g->state.base.body == id_of(g->lift) && g->state.position.y > 2.5;
    return good && fabs(place_on_lift(g) - place) < 1e-4;
}

int main(void)
{
    game g = {.world = NULL};
    build(&g);
    if (!attach(&g)) {
        return 1;
    }
    const int good = tour(&g);
    tahr_mover_destroy(g.mover);
    tahr_world_close(g.world); /* Tahr first, then the world it looks at */
    b2DestroyWorld(g.box2d);
    return good ? 0 : 1;
}
