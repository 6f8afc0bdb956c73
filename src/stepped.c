/* SPDX-License-Identifier: MIT
 * stepped.c: velocity and time in steps: explicit Euler, whose error depends on the frame rate (that is the parity).
 * What the numbers are in centimetres: 2048 cm/s2 of acceleration and of braking, drag 16/s = friction 8 * factor 2. */
#include "stepped.h"

/* Above this part of the square of the asked speed a velocity is braked. */
static const double OVER_SPEED = 1.01;

/* Of stop_speed: standing, also where nothing but drag brakes (0.01 cm/s of 10 cm/s). */
static const double STANDS = 1e-3;

/* All that is left, or no more than the longest piece and than half of it: a piece and a scrap become two halves. */
static double piece_of(double left, double longest)
{
    return left > longest ? min_of(longest, 0.5 * left) : left;
}

double tahr__time_step(const tahr_config *config, double left, uint32_t iteration)
{
    int cuts = config->integrator == TAHR_INTEGRATOR_STEPPED && iteration < config->max_substeps;
    return max_of(cuts ? piece_of(left, config->max_substep) : left, TAHR__LEAST_TIME);
}

double tahr__begin_iteration(tahr__step *step, double left)
{
    if (step->iterations >= step->config->max_substeps || (step->report.flags & TAHR_REPORT_QUERY_CAP)) {
        step->report.time_lost += left;
        step->time += left;
        return 0;
    }
    step->iterations++;
    return tahr__time_step(step->config, left, step->iterations);
}

vec3 tahr__velocity_braking(const tahr_config *config, const tahr__law *law, vec3 velocity, double t)
{
    const vec3 direction = unit(velocity), standing = {0, 0, 0};
    vec3 v = velocity;
    if (law->drag == 0 && law->braking == 0) {
        return v;
    }
    for (double left = t; left >= TAHR__LEAST_TIME;) {
        double h = law->drag > 0 ? piece_of(left, config->braking_substep) : left;
        left -= h;
        v = add_scaled(scale(v, 1 - law->drag * h), direction, -law->braking * h);
        if (dot(v, velocity) <= 0) {
            return standing;
        }
    }
    double stop = law->braking > 0 ? config->stop_speed : STANDS * config->stop_speed;
    return length_squared(v) <= stop * stop ? standing : v;
}

static int is_over(vec3 v, double speed)
{
    return length_squared(v) > OVER_SPEED * speed * speed;
}

vec3 tahr__calc_velocity(const tahr_config *config, const tahr__law *law, double fluid, vec3 velocity, double t)
{
    vec3 v = velocity;
    int pushes = law->acceleration > 0 && length_squared(law->wish) > 0;
    int over = is_over(v, law->speed);
    if (!pushes || over) {
        v = tahr__velocity_braking(config, law, v, t);
        int forward = pushes && dot(law->wish, velocity) > 0;
        if (over && forward && length_squared(v) < law->speed * law->speed) {
            v = scale(unit(velocity), law->speed);
        }
    } else {
        vec3 turned = scale(law->wish, length(v));
        v = add_scaled(v, sub(turned, v), min_of(law->turn_friction * t, 1));
    }
    if (fluid > 0) {
        v = scale(v, 1 - min_of(fluid * t, 1));
    }
    if (pushes) {
        double most = is_over(v, law->speed) ? length(v) : law->speed;
        v = add_scaled(v, law->wish, law->acceleration * t);
        double speed = length(v);
        v = speed > most ? scale(v, most / speed) : v;
    }
    return v;
}

vec3 tahr__new_fall_velocity(const tahr__pull *pull, double terminal, vec3 velocity, double t)
{
    vec3 v = add_scaled(velocity, pull->gravity, t);
    double down = -dot(v, pull->up);
    return down > terminal ? add_scaled(v, pull->up, down - terminal) : v;
}

tahr__law tahr__constant_law(void)
{
    tahr__law law = {.wish = {0, 0, 0}};
    return law;
}

/* Of a stepped velocity half a stick is half the acceleration too; the closed form approaches half the speed with all
 * of it. */
static tahr__law law_of(const tahr__step *step, double speed, double acceleration)
{
    vec3 wish = step_level(step, step->input->move);
    double size = length(wish), stick = min_of(size, 1);
    int stepped = step->config->integrator == TAHR_INTEGRATOR_STEPPED;
    tahr__law law = {.wish = size > 0 ? scale(wish, 1.0 / size) : vec(0, 0, 0),
                     .speed = speed * stick,
                     .acceleration = stepped ? acceleration * stick : acceleration};
    return law;
}

tahr__law tahr__walking_law(const tahr__step *step)
{
    const tahr_config *c = step->config;
    tahr__law law = law_of(step, step->limits->speed, c->acceleration);
    law.turn_friction = c->turn_friction;
    law.braking = c->braking_deceleration;
    law.drag = c->braking_drag;
    return law;
}

tahr__law tahr__falling_law(const tahr__step *step)
{
    const tahr_config *c = step->config;
    double control = c->air_control, slow = c->air_boost_speed;
    if (control > 0 && length_squared(step_level(step, step->state.velocity)) < slow * slow) {
        control = min_of(control * c->air_boost, 1);
    }
    tahr__law law = law_of(step, c->max_speed, c->acceleration * control);
    law.turn_friction = c->air_turn_friction;
    return law;
}

vec3 tahr__level_velocity(const tahr__step *step, vec3 velocity)
{
    vec3 level = step_level(step, velocity);
    return step->config->keep_level_speed ? level : scale(unit(level), length(velocity));
}
