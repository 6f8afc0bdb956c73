/* SPDX-License-Identifier: MIT
 * scene_motion.c: bodies of a scene that move. */
#include "scene_motion.h"

#include <math.h>
#include <stdio.h>

#include "scene_run.h"

int scene_motion_read(scene *s, json_t *item, uint32_t body)
{
    static const char *const KEYS[SCENE_PATH] = {"x", "y", "z", "yaw", "tilt"};
    json_t *path = json_object_get(item, "path");
    if (!path) {
        return 1;
    }
    s->paths[body].moves = 1;
    s->bodies[body].flags |= TAHR_BODY_MOVABLE;
    for (int i = 0; i < SCENE_PATH; i++) {
        s->paths[body].along[i] = json_object_get(path, KEYS[i]);
    }
    s->paths[body].teleport = -1;
    json_t *teleport = json_object_get(path, "teleport");
    return scene_names_set(&s->names, "t", 0) && (!teleport || scene_number(s, teleport, &s->paths[body].teleport));
}

static double along(scene *s, uint32_t body, int i)
{
    double value = 0;
    if (s->paths[body].along[i]) {
        scene_number(s, s->paths[body].along[i], &value);
    }
    return value;
}

static tahr_quat times(tahr_quat a, tahr_quat b)
{
    return (tahr_quat){a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
                       a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

tahr_pose scene_motion_pose(scene *s, uint32_t body, double time)
{
    tahr_pose pose = s->bodies[body].pose;
    if (!s->paths[body].moves) {
        return pose;
    }
    scene_names_set(&s->names, "t", time);
    pose.position.x += along(s, body, 0);
    pose.position.y += along(s, body, 1);
    pose.position.z += along(s, body, 2);
    double half_yaw = along(s, body, 3) * 0.008726646259971648, half_tilt = along(s, body, 4) * 0.008726646259971648;
    tahr_quat yaw = {0, 0, sin(half_yaw), cos(half_yaw)}, tilt = {0, sin(half_tilt), 0, cos(half_tilt)};
    pose.orientation = times(yaw, times(tilt, pose.orientation));
    return pose;
}

tahr_pose scene_motion_pose_in(scene *s, uint32_t body, double time, const tahr_pose *frame)
{
    tahr_pose pose = scene_motion_pose(s, body, time);
    tahr_vec3 p = scene_turn(frame->orientation, pose.position);
    pose.position = (tahr_vec3){p.x + frame->position.x, p.y + frame->position.y, p.z + frame->position.z};
    pose.orientation = times(frame->orientation, pose.orientation);
    return pose;
}

tahr_status scene_motion_move(scene *s, tahr_world *world, const tahr_pose *frame, double from, double to)
{
    tahr_body_pose poses[SCENE_MAX_BODIES];
    uint32_t count = 0;
    for (uint32_t i = 0; i < s->body_count; i++) {
        if (s->paths[i].moves) {
            int jumps = s->paths[i].teleport > from + 1e-9 && s->paths[i].teleport <= to + 1e-9;
            poses[count].body = i;
            poses[count].flags = jumps ? (uint32_t)TAHR_POSE_TELEPORT : 0u;
            poses[count++].pose = scene_motion_pose_in(s, i, to, frame);
        }
    }
    return count ? tahr_world_move(world, poses, count, to - from) : TAHR_OK;
}
