/* SPDX-License-Identifier: MIT
 * tape.c: see tape.h. */
#include "tape.h"

#include <string.h>

static const tahr_vec3 ways[] = {{0, 0, 0},  {1, 0, 0},     {-1, 0, 0},  {0, 1, 0},         {0, -1, 0}, {0.7, 0.7, 0},
                                 {0, 0, 1},  {0, 0, -1},    {0.3, 0, 0}, {-0.6, 0.8, 0},    {5, 5, 5},  {1e-9, 0, 0},
                                 {1, 0, -1}, {-1, 1e-7, 0}, {1e6, 0, 0}, {0.01, -0.01, 0.5}};

/* Seldom: launches, impulses, drives, another gravity or shape. */
static void read_requests(bytes *b, double scale, const tahr_config *config, tahr_input *in)
{
    static const double speeds[] = {0.1, 1, 5, 20, 100, 1000};
    uint32_t how = bytes_u8(b);
    tahr_vec3 way = ways[bytes_below(b, 14)];
    double speed = speeds[bytes_below(b, 6)] * scale;
    tahr_vec3 fast = {way.x * speed, way.y * speed, way.z * speed};
    switch (how % 8) {
    case 0:
        in->flags |= TAHR_INPUT_LAUNCH | (how & 64 ? (uint32_t)TAHR_INPUT_LAUNCH_UP : 0u);
        in->launch = fast;
        break;
    case 1:
        in->flags |= TAHR_INPUT_IMPULSE;
        in->impulse = fast;
        break;
    case 2:
        in->flags |= TAHR_INPUT_DRIVE | (how & 64 ? (uint32_t)TAHR_INPUT_DRIVE_ADD : 0u) |
                     (how & 128 ? (uint32_t)TAHR_INPUT_DRIVE_LEVEL : 0u);
        in->drive = fast;
        break;
    case 3:
        in->flags |= TAHR_INPUT_GRAVITY;
        in->gravity = (tahr_vec3){way.x * 9.81 * scale, way.y * 9.81 * scale, way.z * 9.81 * scale};
        break;
    case 4:
        in->flags |= TAHR_INPUT_MODE;
        in->mode = how / 8 % 7;
        break;
    case 5:
        if (config->shape.type == TAHR_SHAPE_CAPSULE) {
            in->flags |= TAHR_INPUT_SHAPE;
            in->radius = config->shape.radius * (how & 64 ? 0.5 : 1);
            in->half_height = config->shape.half_height * (how & 128 ? 0.6 : 1.2);
        }
        break;
    case 6:
        in->flags |= TAHR_INPUT_FACING;
        in->facing = way;
        break;
    default: in->flags |= TAHR_INPUT_DROP; break;
    }
}

void tape_read(bytes *b, double scale, const tahr_config *config, tahr_input *input, double *dt)
{
    static const double times[] = {1.0 / 60, 1.0 / 60, 1.0 / 30, 0.1, 1.0 / 240, 0, 1e-6, 1, 1e-10};
    uint32_t how = bytes_u8(b), length = bytes_u8(b);
    memset(input, 0, sizeof *input);
    input->struct_size = sizeof *input;
    input->move = ways[how % 16];
    input->jump = how / 16 % 2;
    input->crouch = how / 32 % 4 == 3;
    *dt = times[length % 32 < 9 ? length % 32 : 0];
    if (how >= 224) read_requests(b, scale, config, input);
}
