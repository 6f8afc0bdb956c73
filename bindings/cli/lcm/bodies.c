/* SPDX-License-Identifier: MIT
 * bodies.c: the bodies of a recorded world, placed again as the recording tells. */
#include "bodies.h"

#include "../say.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_BODIES = 1 << 20 }; /* telemetry.h */

static const char lost_body[] = "a body of a change of the world was lost";
static const char lost_change[] = "a change of the world was lost";
static const char other_world[] = "the world came to another revision than was recorded";
static const char not_placed[] = "the bodies cannot be placed as they were";

void bodies_open(struct bodies *b, tahr_world *world)
{
    *b = (struct bodies){.world = world, .of_epoch = -1};
}

void bodies_close(struct bodies *b)
{
    free(b->now);
    free(b->before);
    free(b->has);
    *b = (struct bodies){0};
}

static void lose(struct bodies *b, const char *why)
{
    b->lost = b->lost != NULL ? b->lost : why;
}

static int is_complete(const struct bodies *b)
{
    return b->got >= (b->count > 0 ? b->count : 1);
}

/* The messages before these are all that will come of theirs. */
static void begin(struct bodies *b, const tahr_body_t *body)
{
    if (b->of_epoch >= 0 && !is_complete(b) && b->kind != TAHR_BODY_T_SNAPSHOT) {
        lose(b, lost_body);
    }
    b->of_epoch = body->epoch;
    b->revision = body->revision;
    b->kind = body->kind;
    b->count = body->count;
    b->dt = body->dt;
    b->got = 0;
    const size_t count = (size_t)b->count;
    b->now = memory_grow(b->now, &b->now_capacity, count + 1, sizeof *b->now);
    b->before = memory_grow(b->before, &b->before_capacity, count + 1, sizeof *b->before);
    b->has = memory_grow(b->has, &b->has_capacity, count + 1, sizeof *b->has);
    memset(b->has, 0, count + 1);
}

static tahr_pose pose_of(const double position[3], const double orientation[4])
{
    return (tahr_pose){{position[0], position[1], position[2]},
                       {orientation[0], orientation[1], orientation[2], orientation[3]}};
}

static tahr_status place(struct bodies *b)
{
    const uint32_t count = (uint32_t)b->count;
    tahr_status status = TAHR_OK;
    switch (b->kind) {
    case TAHR_BODY_T_SET: return tahr_world_set(b->world, b->now, count);
    case TAHR_BODY_T_MOVE: return tahr_world_move(b->world, b->now, count, b->dt);
    case TAHR_BODY_T_TOUCH: return tahr_world_touch(b->world);
    default:
        status = tahr_world_set(b->world, b->before, count);
        return status >= 0 && b->dt > 0 ? tahr_world_move(b->world, b->now, count, b->dt) : status;
    }
}

/* The revision is a hash of all poses and motions: where it is the one that was recorded, so is the world, whatever was
 * lost before. In a world whose bodies are all named in each change that is after two of them. */
static void apply(struct bodies *b)
{
    const int follows = b->of_epoch == b->epoch + 1, is_snapshot = b->kind == TAHR_BODY_T_SNAPSHOT;
    const int again = is_snapshot && b->lost == NULL && b->epoch == b->of_epoch; /* says what is known */
    const tahr_status status = again ? TAHR_OK : place(b);
    b->epoch = b->of_epoch;
    if (status < 0) {
        lose(b, not_placed);
    } else if (tahr_world_revision(b->world) == (uint64_t)b->revision) {
        b->lost = NULL;
    } else {
        lose(b, follows || is_snapshot ? other_world : lost_change);
    }
}

void bodies_hear(struct bodies *b, const tahr_body_t *body)
{
    const int is_new = body->epoch != b->of_epoch || body->kind != b->kind;
    if (body->count < 0 || body->count > MOST_BODIES || body->epoch < 0 || body->epoch < b->of_epoch ||
        body->epoch == INT64_MAX) {
        return; /* nothing that a telemetry sends, or from before */
    }
    if (is_new) {
        begin(b, body);
    }
    const int32_t at = body->count > 0 ? body->index : 0;
    if (body->count != b->count || at < 0 || at >= (b->count > 0 ? b->count : 1) || b->has[at] || is_complete(b)) {
        return;
    }
    b->has[at] = 1;
    b->now[at] = (tahr_body_pose){.body = (uint32_t)body->body,
                                  .flags = body->teleport && b->kind != TAHR_BODY_T_SET ? TAHR_POSE_TELEPORT : 0u,
                                  .pose = pose_of(body->position, body->orientation)};
    b->before[at] = (tahr_body_pose){.body = (uint32_t)body->body,
                                     .pose = pose_of(body->before_position, body->before_orientation)};
    b->got++;
    if (is_complete(b)) {
        apply(b);
    }
}
