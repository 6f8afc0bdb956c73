/* SPDX-License-Identifier: MIT
 * bullet_course.h: the walk that bullet_playground.cpp takes, and whether it went as it should. Nothing of Bullet's but
 * its opinion of how deep the character was in something. */
#ifndef BULLET_COURSE_H
#define BULLET_COURSE_H

#include <cmath>
#include <cstdio>
#include <functional>

#include <tahr/tahr.h>

struct waypoint {
    double x, y, height, seconds; /* height: of the ground there */
    const char *name;
};

/* Over the stairs and the ramp, round to the wall, and against it: its face is at y = -9.99, the radius 0.35 m, the
 * skin 1 cm, and what lies behind it is never reached. */
const waypoint COURSE[] = {{-24, 14.75, 2.4, 4, "top of the stairs"}, {-19, 14.75, 0, 4, "foot of the stairs"},
                           {-13.5, 11.05, 0, 4, "before the ramp"},   {-8, 11.05, 2, 4, "top of the ramp"},
                           {-2, 11.05, 0, 4, "behind the ramp"},      {0.5, 7.5, 0, 3, "beside the rough ground"},
                           {0.5, -7.5, 0, 5, "south of it"},          {13, -8, 0, 5, "before the wall"},
                           {13, -12, 0, 2, "against the wall"}};
const waypoint &WALL = COURSE[8];
const double STOPPED = -9.99 + 0.35 + 0.01;

/* Walks to each in turn and says where it came to. depth: m, of a character's shape at a place. */
inline bool walk_course(const char *name, tahr_world *world,
                        const std::function<double(const tahr_shape &, const tahr_vec3 &)> &depth)
{
    tahr_config config;
    tahr_state state;
    tahr_mover *mover = nullptr;
    tahr_input input{};
    tahr_report report{};
    double deepest = 0, queries = 0;
    int steps = 0;
    input.struct_size = sizeof input;
    report.struct_size = sizeof report;
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
    const double foot = config.shape.half_height + 0.0125; /* over the ground: a clearance of 1 to 1.5 cm */
    tahr_vec3 start = {-29.2, 14.75, foot};
    tahr_state_init(&state, &config, &start);
    bool good = tahr_mover_create(world, &config, &mover) >= 0;
    std::printf("%s\n", name);
    for (const waypoint &to : COURSE) {
        for (int i = 0; i < to.seconds * 60 && good; i++) {
            double x = to.x - state.position.x, y = to.y - state.position.y, away = std::sqrt(x * x + y * y);
            if (away < 0.1) break;
            input.move = {x / away, y / away, 0};
            good = tahr_mover_step(mover, &input, 1.0 / 60, &state, &report) >= 0;
            queries += report.sweeps + report.contact_queries + report.rays;
            deepest = std::fmax(deepest, depth(config.shape, state.position));
            steps++;
        }
        bool last = &to == &WALL;
        bool here = std::fabs(state.position.x - to.x) < 0.12 &&
                    std::fabs(state.position.y - (last ? STOPPED : to.y)) < (last ? 0.005 : 0.12) &&
                    std::fabs(state.position.z - foot - to.height) < 0.01;
        std::printf("  %-26s %8.3f %8.3f %7.3f%s\n", to.name, state.position.x, state.position.y, state.position.z,
                    here ? "" : "   WRONG");
        good = good && here;
    }
    std::printf("  %d steps, %.2f queries each, at most %.2f mm inside anything\n", steps, queries / steps,
                1000 * deepest);
    tahr_mover_destroy(mover);
    return good && deepest < 0.005;
}

#endif
