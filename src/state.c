/* SPDX-License-Identifier: MIT
 * state.c: making and hashing the plain data that is a character. */
#include <string.h>

#include "sized.h"
#include "core.h"
#include <tahr/tahr.h>

_Static_assert(sizeof(tahr_state) == 512, "tahr_state is 512 bytes for a whole ABI range");

const tahr_state tahr__blank = TAHR__BLANK;

/* What belongs to the place that a character is at. */
static void forget_places(tahr_state *state)
{
    state->base = tahr__blank.base;
    memcpy(state->touched, tahr__blank.touched, sizeof state->touched);
    state->touched_count = 0;
    state->coyote_left = state->lift_left = state->wall_left = 0;
    state->wall_normal = vec(0, 0, 0);
    state->wall_body = state->drop_body = TAHR_NO_BODY;
    state->wall_feature = state->drop_feature = 0;
}

tahr_status tahr_state_init(tahr_state *state, const tahr_config *config, const tahr_vec3 *position)
{
    if (!state || !position) {
        return TAHR_E_NULL;
    }
    tahr_status status = tahr_config_check(config, NULL);
    if (status < 0) {
        return status;
    }
    if (!vec_is_finite(*position) || length(*position) > 1e7) {
        return TAHR_E_ARGUMENT;
    }
    double g = length(config->gravity);
    vec3 up = g > 1e-6 ? scale(config->gravity, -1.0 / g) : vec(0, 0, 1);
    memset(state, 0, sizeof *state);
    state->position = add(*position, vec(0, 0, 0));
    state->up = add(up, vec(0, 0, 0)); /* -0.0 + 0.0 is 0.0 */
    const tahr_quat q = quat_between(vec(0, 0, 1), state->up);
    state->orientation = (tahr_quat){q.x + 0.0, q.y + 0.0, q.z + 0.0, q.w + 0.0};
    state->mode = TAHR_MODE_FALLING;
    state->floor.body = TAHR_NO_BODY;
    state->radius = config->shape.radius;
    state->half_height = config->shape.half_height;
    forget_places(state);
    return TAHR_OK;
}

tahr_status tahr_state_teleport(tahr_state *state, const tahr_vec3 *position)
{
    if (!state || !position) {
        return TAHR_E_NULL;
    }
    if (!vec_is_finite(*position) || length(*position) > 1e7) {
        return TAHR_E_ARGUMENT;
    }
    forget_places(state);
    state->position = add(*position, vec(0, 0, 0)); /* -0.0 + 0.0 is 0.0 */
    state->floor = (tahr_floor){.body = TAHR_NO_BODY};
    state->floor_position = vec(0, 0, 0);
    state->floor_revision = 0;
    state->flags &=
        ~(uint32_t)(TAHR_STATE_FLOOR_MOVED | TAHR_STATE_WALL_TOUCHED | TAHR_STATE_WALL_SPENT | TAHR_STATE_EDGE_SPENT);
    return TAHR_OK;
}

/* FNV-1a over 64-bit words: the state is 64 of them. */
uint64_t tahr_state_hash(const tahr_state *state)
{
    const uint64_t minus_zero = (uint64_t)1 << 63;
    uint64_t hash = 0xCBF29CE484222325u;
    if (!state) {
        return 0;
    }
    for (size_t i = 0; i < sizeof *state; i += 8) {
        uint64_t word;
        memcpy(&word, (const char *)state + i, 8);
        word = word == minus_zero ? 0 : word;
        for (int byte = 0; byte < 8; byte++) {
            hash = (hash ^ (word & 0xFF)) * 0x100000001B3u;
            word >>= 8;
        }
    }
    return hash;
}
