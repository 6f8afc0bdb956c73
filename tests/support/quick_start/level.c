/* SPDX-License-Identifier: MIT
 * level.c: what the README's level geometry leaves to the reader: a square of two triangles, and the proof that it can
 * be walked on. README_LEVEL is the file with the README's lines. */
#include <stdio.h>
#include <tahr/native.h>
#include <tahr/tahr.h>

static const double vertices[] = {-9, -9, 0, 9, -9, 0, 9, 9, 0, -9, 9, 0};
static const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
static const uint32_t vertex_count = 4, triangle_count = 2;

/* Lands on it and walks; 0 if so. */
static int check(tahr_world *world)
{
    tahr_config config;
    tahr_state state;
    tahr_mover *mover = NULL;
    tahr_input input = {.struct_size = sizeof input, .move = {1, 0, 0}};
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
    tahr_state_init(&state, &config, &(tahr_vec3){0, 0, 1});
    if (tahr_mover_create(world, &config, &mover) < 0) {
        return 1;
    }
    for (int i = 0; i < 60; i++) {
        if (tahr_mover_step(mover, &input, 1.0 / 60.0, &state, NULL) != TAHR_OK) {
            return 1;
        }
    }
    tahr_mover_destroy(mover);
    tahr_world_close(world);
    printf("level geometry: %s at %.3f m\n", tahr_mode_name(state.mode), state.position.x);
    return state.mode != TAHR_MODE_WALKING;
}

int main(void)
{
    tahr_world *world = NULL;
#include README_LEVEL
    return check(world);
}
