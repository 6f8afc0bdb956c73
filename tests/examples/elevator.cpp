/* SPDX-License-Identifier: MIT
 * elevator.cpp: a level of triangles with a shaft, in C++: somebody walks in, rides the elevator to the upper floor,
 * and flies back over the shaft by a jet pack, a mode of his own; the flight is rolled back and flown again.
 * By hand, with Tahr installed and PKG_CONFIG_PATH pointing to its lib/pkgconfig:
 *     c++ -std=c++17 elevator.cpp $(pkg-config --cflags --libs tahr) -o elevator */
#include <cstdio>
#include <vector>

#include <tahr/native.h>
#include <tahr/tahr.hpp>

namespace
{

enum : uint32_t { LEVEL = 0, CABIN = 1 };
constexpr double DT = 1.0 / 60, CABIN_X = 6, STOREY = 3;

/* Triangles as a level editor would hand them over. */
struct level {
    std::vector<tahr_vec3> vertices;
    std::vector<uint32_t> indices;

    void add_quad(tahr_vec3 a, tahr_vec3 b, tahr_vec3 c, tahr_vec3 d)
    {
        const auto first = static_cast<uint32_t>(vertices.size());
        vertices.insert(vertices.end(), {a, b, c, d});
        indices.insert(indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
    }
};

level make_level()
{
    level l;
    l.add_quad({-5, -3, 0}, {7, -3, 0}, {7, 3, 0}, {-5, 3, 0});                     /* ground */
    l.add_quad({7, 3, 0}, {7, -3, 0}, {7, -3, STOREY}, {7, 3, STOREY});             /* back of the shaft */
    l.add_quad({7, -3, STOREY}, {15, -3, STOREY}, {15, 3, STOREY}, {7, 3, STOREY}); /* upper floor */
    return l;
}

/* The game: the elevator goes up while somebody is on it, and stays there. */
struct game {
    tahr::world world;
    tahr::mover mover;
    tahr_state player;
    double cabin = 0.1; /* m, height of its floor */

    tahr::status tick(const tahr_input &input)
    {
        if (player.floor.body == CABIN && cabin < STOREY) cabin += 1.5 * DT;
        const tahr_body_pose pose[] = {{CABIN, 0, tahr::make_pose({CABIN_X, 0, cabin - 0.1})}};
        if (tahr::status s = world.move(pose, DT); !s) return s;
        return mover.step(input, DT, player);
    }
};

game open_game()
{
    const level stone = make_level(); /* read while the world is opened, then no longer needed */
    tahr_body_desc cabin = tahr::box_body({1, 1, 0.1}, {CABIN_X, 0, 0});
    cabin.flags = TAHR_BODY_MOVABLE;
    const tahr_body_desc bodies[] = {tahr::mesh_body(stone.vertices, stone.indices).value(), cabin};
    const tahr_config config = tahr::make_config().value();
    game g;
    g.world = tahr::world::open(tahr_backend_v1_native(), bodies).value();
    g.mover = tahr::mover::create(g.world, config).value();
    g.player = tahr::make_state(config, {0, 0, 0.92}).value();
    /* The jet pack: up and where the player wishes, until the button is let go. */
    const double thrust = 4; /* m/s */
    g.mover
        .set_custom_mode([thrust](tahr::custom_step &step, double time, tahr_custom_next &next) -> tahr::status {
            const tahr_input &wish = step.input();
            const tahr_vec3 velocity = {wish.move.x * thrust, wish.move.y * thrust, wish.jump ? thrust : 0};
            if (!wish.jump) next.mode = TAHR_MODE_FALLING, next.time_left = time;
            if (tahr::status s = step.set_velocity(velocity); !s || !wish.jump) return s;
            return step.slide({velocity.x * time, velocity.y * time, velocity.z * time});
        })
        .value();
    return g;
}

/* Plays so many ticks of one input. */
void play(game &g, tahr_input input, int ticks)
{
    for (int i = 0; i < ticks; i++) {
        g.tick(input).value();
        input.flags = 0; /* the mode is asked for once */
    }
    std::printf("%s at (%.2f, %.2f)\n", tahr_mode_name(g.player.mode), g.player.position.x, g.player.position.z);
}

} // namespace

int main()
{
    game g = open_game();
    tahr_input east = tahr::make_input(), still = tahr::make_input(), fly = tahr::make_input();
    east.move = {0.5, 0, 0};
    fly.move = {-1, 0, 0};
    fly.jump = 1;
    fly.mode = TAHR_MODE_CUSTOM;
    fly.flags = TAHR_INPUT_MODE;
    play(g, east, 115);
    play(g, still, 150);
    bool up = g.player.floor.body == CABIN && g.player.position.z > STOREY;
    play(g, east, 90);
    bool arrived = g.player.floor.body == LEVEL && g.player.position.z > STOREY && g.player.position.x > 7;

    const tahr_state before = g.player; /* all that a rollback has to keep */
    play(g, fly, 90);
    const uint64_t first = tahr::hash(g.player);
    g.player = before;
    play(g, fly, 90);
    bool same = tahr::hash(g.player) == first;
    play(g, still, 240);
    bool down = g.player.mode == TAHR_MODE_WALKING && g.player.position.z < 1;
    std::printf("up %d, arrived %d, the same again %d, back on the ground %d\n", up, arrived, same, down);
    return up && arrived && same && down ? 0 : 1;
}
