/* SPDX-License-Identifier: MIT
 * voxels.h: a level of voxels with an edge of 0.1 m: a room with a floor two cells thick, walls, steps, a ramp of steps
 * of one cell, pillars. Its points lie in the middle of the cells. */
#ifndef TAHR_TEST_VOXELS_H
#define TAHR_TEST_VOXELS_H

#include <vector>

/* Where things are, in metres; the floor's top is z = 0. */
static const double VOXEL = 0.1;
static const double ROOM = 6;                      /* half its width: the inside of the walls is at x, y = +-6 */
static const double RAMP_X = 1, RAMP_RUN = 0.3;    /* the ramp along y = -4..-2 rises 0.1 m every 0.3 m from x = 1 on */
static const double RAMP_TOP = 1;                  /* ends at x = 1 + 3, then level to the wall */
static const double STAIR_X = -2, STAIR_RUN = 0.4; /* stairs along y = 2..4 go down toward +x: 0.2 m every 0.4 m */
static const int STAIR_COUNT = 4;                  /* from 0.8 m at x < -2 */

/* Height of the solid (m) at the middle of a column. */
static inline double voxel_height(double x, double y)
{
    bool inside = x > -ROOM && x < ROOM && y > -ROOM && y < ROOM;
    if (!inside) return 2;
    if (y > -4 && y < -2 && x > RAMP_X) {
        double steps = static_cast<int>((x - RAMP_X) / RAMP_RUN) + 1;
        return steps * VOXEL < RAMP_TOP ? steps * VOXEL : RAMP_TOP;
    }
    if (y > 2 && y < 4 && x < STAIR_X) return 0.2 * STAIR_COUNT;
    if (y > 2 && y < 4 && x < STAIR_X + STAIR_RUN * (STAIR_COUNT - 1))
        return 0.2 * (STAIR_COUNT - 1 - static_cast<int>((x - STAIR_X) / STAIR_RUN));
    bool pillar = x > 3 && x < 3.5 && y > 3 && y < 3.5;
    return pillar ? 2 : 0;
}

/* Three coordinates per occupied cell. */
static inline std::vector<double> voxel_level(double low = -0.2)
{
    std::vector<double> points;
    for (int i = -61; i < 61; i++) {
        for (int j = -61; j < 61; j++) {
            double x = (i + 0.5) * VOXEL, y = (j + 0.5) * VOXEL, height = voxel_height(x, y);
            for (int k = static_cast<int>(low / VOXEL - 0.5); (k + 0.5) * VOXEL < height; k++) {
                points.push_back(x);
                points.push_back(y);
                points.push_back((k + 0.5) * VOXEL);
            }
        }
    }
    return points;
}

#endif
