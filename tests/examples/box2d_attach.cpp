/* SPDX-License-Identifier: MIT
 * box2d_attach.cpp: a character in your own Box2D 2.4 world. Box2D moves the crates and the lift; Tahr moves the
 * character, who walks on the chain, pushes a crate, passes a gate that only feels, rides the lift and jumps.
 *
 * By hand, with Tahr installed and PKG_CONFIG_PATH pointing to its lib/pkgconfig:
 *     c++ -std=c++17 box2d_attach.cpp $(pkg-config --cflags --libs tahr_box2d) -lbox2d -o box2d_attach */
#include <cmath>
#include <cstdio>

#include <box2d/box2d.h>
#include <tahr/box2d.h>
#include <tahr/tahr.h>

namespace
{

/* Tahr names bodies by numbers: here what each carries as user data. */
enum : uint32_t { GROUND = 0, LIFT = 1, GATE = 2, CRATES = 3 };

/* What characters never meet has this category. */
constexpr uint16 DECORATION = 0x0002;

b2Body *add_body(b2World &world, b2BodyType type, float x, float y, uint32_t number)
{
    b2BodyDef def;
    def.type = type;
    def.position.Set(x, y);
    def.userData.pointer = number;
    return world.CreateBody(&def);
}

b2Body *add_box(b2World &world, b2BodyType type, b2Vec2 at, b2Vec2 half, uint32_t number)
{
    b2Body *body = add_body(world, type, at.x, at.y, number);
    b2PolygonShape shape;
    shape.SetAsBox(half.x, half.y);
    b2FixtureDef def;
    def.shape = &shape;
    def.density = 20;
    def.friction = 0.4f;
    def.isSensor = number == GATE;
    body->CreateFixture(&def);
    return body;
}

/* Flat from -20 to 20 in segments of half a metre; solid from above, which is on the right of who goes to the left. */
void add_ground(b2World &world)
{
    b2Vec2 corners[81];
    for (int i = 0; i <= 80; i++)
        corners[i].Set(20 - 0.5f * static_cast<float>(i), 0);
    b2ChainShape chain;
    chain.CreateChain(corners, 81, b2Vec2(21, 0), b2Vec2(-21, 0));
    add_body(world, b2_staticBody, 0, 0, GROUND)->CreateFixture(&chain, 0);
}

/* Nothing of Tahr's concern: in the way of the character, in a category that it does not meet. */
void add_curtain(b2World &world)
{
    b2PolygonShape shape;
    shape.SetAsBox(0.1f, 2);
    b2FixtureDef def;
    def.shape = &shape;
    def.filter.categoryBits = DECORATION;
    add_body(world, b2_staticBody, 2, 2, CRATES + 100)->CreateFixture(&def);
}

struct game {
    b2World box2d{b2Vec2(0, -9.81f)};
    b2Body *lift = nullptr, *crate = nullptr;
    tahr_world *world = nullptr;
    tahr_mover *mover = nullptr;
    tahr_config config;
    tahr_state state;
    tahr_input input = {};
    tahr_event events[32];
    int gates = 0, pushes = 0, jumps = 0;
};

void log_message(void *, int32_t, const char *message)
{
    std::printf("tahr: %s\n", message);
}

bool open(game &g)
{
    add_ground(g.box2d);
    add_curtain(g.box2d);
    g.lift = add_box(g.box2d, b2_kinematicBody, b2Vec2(12, -0.2f), b2Vec2(1.5f, 0.25f), LIFT);
    add_box(g.box2d, b2_staticBody, b2Vec2(4, 1), b2Vec2(0.2f, 1), GATE);
    g.crate = add_box(g.box2d, b2_dynamicBody, b2Vec2(-6, 0.5f), b2Vec2(0.5f, 0.5f), CRATES);
    add_box(g.box2d, b2_dynamicBody, b2Vec2(-6, 1.5f), b2Vec2(0.4f, 0.4f), CRATES + 1);

    tahr_log log = {nullptr, log_message};
    tahr_box2d_desc options = {};
    options.struct_size = sizeof options;
    options.world2 = &g.box2d;
    options.mask_bits = static_cast<uint64_t>(0xFFFF & ~DECORATION);
    tahr_world_desc desc;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.options = &options;
    desc.log = &log;
    if (tahr_world_open(tahr_backend_v1_box2d(), &desc, &g.world) < 0) return false;

    tahr_config_init(&g.config, sizeof g.config, TAHR_PRESET_PRECISE);
    g.config.gravity = {0, -9.81, 0};
    g.config.plane = {0, 0, 1};
    const tahr_vec3 start = {0, 1, 0};
    g.input.struct_size = sizeof g.input;
    return tahr_mover_create(g.world, &g.config, &g.mover) >= 0 && tahr_state_init(&g.state, &g.config, &start) >= 0;
}

/* What the step says that Box2D should know. */
void react(game &g, const tahr_report &report)
{
    for (uint32_t i = 0; i < report.event_count; i++) {
        const tahr_event &e = g.events[i];
        g.gates += e.type == TAHR_EVENT_OVERLAP_BEGIN && e.body == GATE;
        g.jumps += e.type == TAHR_EVENT_JUMPED;
        if (e.type != TAHR_EVENT_PUSHED || e.body != CRATES) continue;
        const b2Vec2 impulse(static_cast<float>(-e.value * e.normal.x), static_cast<float>(-e.value * e.normal.y));
        const b2Vec2 at(static_cast<float>(e.position.x), static_cast<float>(e.position.y));
        g.crate->ApplyLinearImpulse(impulse, at, true);
        g.pushes++;
    }
}

/* One tick: first Box2D, then whoever walks in its world. */
bool tick(game &g)
{
    const float dt = 1.0f / 60;
    tahr_report report = {};
    report.struct_size = sizeof report;
    report.events = g.events;
    report.event_capacity = 32;
    g.box2d.Step(dt, 8, 3);
    tahr_world_touch(g.world);
    if (tahr_mover_step(g.mover, &g.input, dt, &g.state, &report) < 0) return false;
    react(g, report);
    return true;
}

bool play(game &g, double move, int ticks)
{
    g.input.move = {move, 0, 0};
    for (int i = 0; i < ticks; i++) {
        if (!tick(g)) return false;
        g.input.jump = 0;
    }
    std::printf("%-8s x %6.3f  y %6.3f  crate at %6.3f, lift at %5.2f\n", tahr_mode_name(g.state.mode),
                g.state.position.x, g.state.position.y, static_cast<double>(g.crate->GetPosition().x),
                static_cast<double>(g.lift->GetPosition().y));
    return true;
}

/* To where x is, and then a moment of rest. */
bool walk_to(game &g, double x)
{
    const double way = x > g.state.position.x ? 1 : -1;
    g.input.move = {way, 0, 0};
    for (int i = 0; i < 1000 && (x - g.state.position.x) * way > 0; i++) {
        if (!tick(g)) return false;
    }
    return play(g, 0, 30);
}

/* How far the character is from the middle of the lift. */
double place_on_lift(const game &g)
{
    return g.state.position.x - static_cast<double>(g.lift->GetPosition().x);
}

} // namespace

int main()
{
    game g;
    if (!open(g)) return 1;

    bool good = play(g, -1, 90); /* to the crates, and against them */
    const double crate = static_cast<double>(g.crate->GetPosition().x);
    good = good && g.pushes > 0 && crate < -6.05 && g.state.position.x > crate + 0.8;

    good = good && walk_to(g, 5); /* through the curtain and the gate */
    good = good && g.gates == 1;

    g.input.jump = 1;
    good = good && play(g, 0, 80);
    good = good && g.jumps == 1 && g.state.mode == TAHR_MODE_WALKING;

    good = good && walk_to(g, 12); /* onto the lift, a step up */
    const double place = place_on_lift(g);
    g.lift->SetLinearVelocity(b2Vec2(0.5f, 1));
    good = good && play(g, 0, 120);
    good = good && g.state.base.body == LIFT && g.state.position.y > 2.5 && std::fabs(place_on_lift(g) - place) < 1e-4;

    tahr_mover_destroy(g.mover);
    tahr_world_close(g.world); /* Tahr first, then the world it looks at */
    return good ? 0 : 1;
}
