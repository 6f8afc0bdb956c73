/* SPDX-License-Identifier: MIT
 * stage.c: see stage.h. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "stage.h"

tahr_body_desc stage_box(tahr_vec3 at, tahr_vec3 half_extents)
{
    tahr_body_desc d;
    assert_int_equal(tahr_body_desc_init(&d, sizeof d, TAHR_BODY_BOX), TAHR_OK);
    d.pose.position = at;
    d.half_extents = half_extents;
    d.flags = TAHR_BODY_MOVABLE;
    return d;
}

tahr_body_desc stage_ground(void)
{
    tahr_body_desc d = stage_box(fake_vec(0, 0, -1), fake_vec(2e4, 2e4, 1));
    d.flags = 0;
    return d;
}

tahr_quat stage_yaw(double angle)
{
    tahr_quat q = {0, 0, sin(angle / 2), cos(angle / 2)};
    return q;
}

const tahr_quat STAGE_LEVEL = {0, 0, 0, 1};

void stage_stand_on_slab(rig *r, const tahr_config *config, double x, double y)
{
    tahr_body_desc slab = stage_box(fake_vec(0, 0, -0.25), fake_vec(5, 5, 0.25));
    rig_open_bodies(r, &slab, 1, config, fake_vec(x, y, 1));
    rig_settle(r);
}

tahr_vec3 stage_foot(const rig *r)
{
    return fake_vec(r->state.position.x, r->state.position.y, r->state.position.z - r->state.half_height);
}

void stage_step(rig *r, uint32_t body, tahr_pose pose, double dt)
{
    tahr_body_pose p = {body, 0, pose};
    assert_int_equal(tahr_world_move(r->world, &p, 1, dt), TAHR_OK);
    rig_step(r, dt);
}

typedef struct longs {
    long double x, y, z;
} longs;

/* v turned by q, by the matrix of q: another formula than the library's. */
static longs turned(tahr_quat q, longs v)
{
    long double x = q.x, y = q.y, z = q.z, w = q.w, n = x * x + y * y + z * z + w * w;
    longs r = {((w * w + x * x - y * y - z * z) * v.x + 2 * (x * y - w * z) * v.y + 2 * (x * z + w * y) * v.z) / n,
               (2 * (x * y + w * z) * v.x + (w * w - x * x + y * y - z * z) * v.y + 2 * (y * z - w * x) * v.z) / n,
               (2 * (x * z - w * y) * v.x + 2 * (y * z + w * x) * v.y + (w * w - x * x - y * y + z * z) * v.z) / n};
    return r;
}

tahr_vec3 stage_carried(const tahr_pose *from, const tahr_pose *to, tahr_vec3 at)
{
    tahr_quat back = {-from->orientation.x, -from->orientation.y, -from->orientation.z, from->orientation.w};
    longs local = {(long double)at.x - from->position.x, (long double)at.y - from->position.y,
                   (long double)at.z - from->position.z};
    local = turned(to->orientation, turned(back, local));
    return fake_vec((double)(local.x + to->position.x), (double)(local.y + to->position.y),
                    (double)(local.z + to->position.z));
}

double stage_distance(tahr_vec3 a, tahr_vec3 b)
{
    double x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
    return sqrt(x * x + y * y + z * z);
}
