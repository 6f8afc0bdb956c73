/* SPDX-License-Identifier: MIT
 * ladder.c: a ladder as a mode of your own. The ladder is a body with a surface id; who walks into it climbs: forward
 * is up, back is down, a jump lets go, and over the top there is a platform.
 * By hand, with Tahr installed and PKG_CONFIG_PATH pointing to its lib/pkgconfig:
 *     cc -std=c11 ladder.c $(pkg-config --cflags --libs tahr) -o ladder */
#include <stdio.h>

#include <tahr/native.h>
#include <tahr/tahr.h>

enum { STONE = 0, LADDER = 42 };

/* All that the mode may depend on besides the step: constants. */
typedef struct ladder {
    uint32_t surface;
    tahr_vec3 into; /* unit, level: toward the rungs */
    double speed;   /* m/s */
    double reach;   /* m: no rung within it, and the ladder has ended */
} ladder;

static double dot(const tahr_vec3 *a, const tahr_vec3 *b)
{
    return a->x * b->x + a->y * b->y + a->z * b->z;
}

/* a * s + b * t */
static tahr_vec3 mix(const tahr_vec3 *a, double s, const tahr_vec3 *b, double t)
{
    tahr_vec3 v = {a->x * s + b->x * t, a->y * s + b->y * t, a->z * s + b->z * t};
    return v;
}

/* Goes on falling, with a velocity to begin with, in all of the time. */
static tahr_status let_go(tahr_step *step, tahr_vec3 velocity, double time, tahr_custom_next *next)
{
    next->mode = TAHR_MODE_FALLING;
    next->time_left = time;
    return tahr_step_set_velocity(step, &velocity);
}

static tahr_status climb(void *user, tahr_step *step, double time, tahr_custom_next *next)
{
    const ladder *l = user;
    const tahr_vec3 *up = &tahr_step_state(step)->up, reach = mix(&l->into, l->reach, up, 0);
    const tahr_input *input = tahr_step_input(step);
    tahr_hit rung;
    tahr_step_moved moved;
    tahr_status status = tahr_step_sweep(step, &reach, &rung);
    if (status < 0) {
        return status;
    }
    if (input->jump) {
        return let_go(step, mix(&l->into, -3, up, 3), time, next);
    }
    if (!rung.blocking || rung.surface != l->surface) { /* above the last rung: onto the platform */
        return let_go(step, mix(&l->into, 2, up, 0), time, next);
    }
    double rate = l->speed * dot(&input->move, &l->into);
    tahr_vec3 velocity = mix(up, rate, up, 0), motion = mix(up, rate * time, up, 0);
    status = tahr_step_set_velocity(step, &velocity);
    if (status >= 0) {
        status = tahr_step_slide(step, &motion, &moved);
    }
    if (status >= 0 && rate < 0 && moved.hits > 0) { /* back on the ground */
        next->mode = TAHR_MODE_WALKING;
    }
    return status;
}

/* Whoever runs into the ladder, and means it, takes hold of it in the next step. */
static int takes_hold(const tahr_report *report, const tahr_input *input)
{
    for (uint32_t i = 0; i < report->event_count; i++) {
        const tahr_event *e = &report->events[i];
        if (e->type == TAHR_EVENT_HIT && e->surface == LADDER && dot(&input->move, &e->normal) < -0.5) {
            return 1;
        }
    }
    return 0;
}

static tahr_world *open_tower(void)
{
    tahr_world *world = NULL;
    tahr_world_desc scene;
    tahr_body_desc bodies[3];
    const tahr_vec3 at[] = {{0, 0, -0.5}, {2.05, 0, 2}, {6.1, 0, 2}}, half[] = {{20, 20, 0.5}, {0.05, 1, 2}, {4, 5, 2}};
    for (int i = 0; i < 3; i++) {
        tahr_body_desc_init(&bodies[i], sizeof bodies[i], TAHR_BODY_BOX);
        bodies[i].pose.position = at[i];
        bodies[i].half_extents = half[i];
        bodies[i].surface = i == 1 ? LADDER : STONE;
    }
    tahr_world_desc_init(&scene, sizeof scene);
    scene.bodies = bodies;
    scene.body_count = 3;
    return tahr_world_open(tahr_backend_v1_native(), &scene, &world) < 0 ? NULL : world;
}

/* Walks toward the ladder for so many steps of 1/60 s, and jumps in one of them. Returns 0 if a step failed. */
static int play(tahr_mover *mover, int steps, int jump_at, tahr_state *state)
{
    tahr_event events[16];
    tahr_report report = {.struct_size = sizeof report, .events = events, .event_capacity = 16};
    tahr_input input = {.struct_size = sizeof input, .move = {1, 0, 0}, .mode = TAHR_MODE_CUSTOM};
    for (int i = 0; i < steps; i++) {
        input.flags = i > 0 && i <= jump_at && takes_hold(&report, &input) ? TAHR_INPUT_MODE : 0;
        input.jump = i == jump_at;
        if (tahr_mover_step(mover, &input, 1.0 / 60, state, &report) < 0) {
            return 0;
        }
        if (i > jump_at) {
            input.move.x = 0;
        }
    }
    return 1;
}

int main(void)
{
    ladder l = {.surface = LADDER, .into = {1, 0, 0}, .speed = 2, .reach = 0.1};
    tahr_world *world = open_tower();
    tahr_mover *mover = NULL;
    tahr_config config;
    tahr_state climber, jumper;
    const tahr_vec3 start = {0, 0, 1};
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
    tahr_state_init(&climber, &config, &start);
    tahr_state_init(&jumper, &config, &start);
    if (!world || tahr_mover_create(world, &config, &mover) < 0 || tahr_mover_set_custom_mode(mover, climb, &l) < 0) {
        return 1;
    }
    int ok = play(mover, 240, 1000, &climber) && play(mover, 240, 120, &jumper);
    printf("climber: %s at x %.2f, z %.2f\n", tahr_mode_name(climber.mode), climber.position.x, climber.position.z);
    printf("jumper: %s at x %.2f, z %.2f\n", tahr_mode_name(jumper.mode), jumper.position.x, jumper.position.z);
    tahr_mover_destroy(mover);
    tahr_world_close(world);
    int on_top = climber.mode == TAHR_MODE_WALKING && climber.position.x > 2.1 && climber.position.z > 4.9;
    int back_down = jumper.mode == TAHR_MODE_WALKING && jumper.position.x < 2 && jumper.position.z < 0.95;
    return ok && on_top && back_down ? 0 : 1;
}
