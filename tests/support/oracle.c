/* SPDX-License-Identifier: MIT
 * oracle.c: brute-force distances in long double. */
#include "oracle.h"

#include <math.h>

typedef long double real;

typedef struct problem {
    real offset[3], column[5][3];
    int lower[5]; /* lower bound of an unknown: -1 (a half axis) or 0 (a barycentric coordinate) */
    int count;
} problem;

static real dot(const real a[3], const real b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Least squares of |offset + sum x_i column_i| by normal equations; 0 if singular. */
static int solve(const problem *p, real x[5])
{
    real m[5][6];
    int n = p->count;
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++)
            m[i][j] = dot(p->column[i], p->column[j]);
        m[i][n] = -dot(p->column[i], p->offset);
    }
    for (int c = 0; c < n; c++) {
        int pivot = c;
        for (int r = c + 1; r < n; r++) {
            if (fabsl(m[r][c]) > fabsl(m[pivot][c])) pivot = r;
        }
        if (!(fabsl(m[pivot][c]) > 1e-17L)) return 0;
        for (int k = 0; k <= n; k++) {
            real swap = m[c][k];
            m[c][k] = m[pivot][k];
            m[pivot][k] = swap;
        }
        for (int r = 0; r < n; r++) {
            if (r == c) continue;
            real f = m[r][c] / m[c][c];
            for (int k = c; k <= n; k++)
                m[r][k] -= f * m[c][k];
        }
    }
    for (int i = 0; i < n; i++)
        x[i] = m[i][n] / m[i][i];
    return 1;
}

/* Distance of one combination if its solution is inside its own limits, else a huge number. */
static real try_faces(const problem *p, int barycentric_from)
{
    real x[5], d[3], sum = 0;
    if (p->count > 0 && !solve(p, x)) return 1e30L;
    for (int k = 0; k < 3; k++)
        d[k] = p->offset[k];
    for (int i = 0; i < p->count; i++) {
        if (x[i] < p->lower[i] || x[i] > 1) return 1e30L;
        if (i >= barycentric_from) sum += x[i];
        for (int k = 0; k < 3; k++)
            d[k] += x[i] * p->column[i][k];
    }
    return sum > 1 ? 1e30L : sqrtl(dot(d, d));
}

real oracle_distance(const oracle_core *core, const double motion[3], real t, double tri[3][3])
{
    static const int faces[7][3] = {{0, 1, 2},   {0, 1, -1},  {1, 2, -1}, {2, 0, -1},
                                    {0, -1, -1}, {1, -1, -1}, {2, -1, -1}};
    int combinations = core->axis_count == 0 ? 1 : core->axis_count == 1 ? 3 : 27;
    real best = 1e30L;
    for (int c = 0; c < combinations; c++) {
        for (int f = 0; f < 7; f++) {
            problem p;
            p.count = 0;
            int code = c;
            for (int k = 0; k < 3; k++)
                p.offset[k] = (real)core->centre[k] + t * motion[k] - tri[faces[f][0]][k];
            for (int i = 0; i < core->axis_count; i++, code /= 3) {
                for (int k = 0; k < 3; k++) {
                    if (code % 3 == 2)
                        p.column[p.count][k] = core->axis[i][k];
                    else
                        p.offset[k] += (code % 3 ? 1 : -1) * (real)core->axis[i][k];
                }
                if (code % 3 == 2) p.lower[p.count++] = -1;
            }
            int from = p.count;
            for (int i = 1; i < 3 && faces[f][i] >= 0; i++) {
                for (int k = 0; k < 3; k++)
                    p.column[p.count][k] = (real)tri[faces[f][0]][k] - tri[faces[f][i]][k];
                p.lower[p.count++] = 0;
            }
            real d = try_faces(&p, from);
            if (d < best) best = d;
        }
    }
    return best;
}

real oracle_smallest(const oracle_core *core, const double motion[3], double tri[3][3])
{
    real low = 0, high = 1;
    for (int i = 0; i < 90; i++) {
        real a = low + (high - low) / 3, b = high - (high - low) / 3;
        if (oracle_distance(core, motion, a, tri) < oracle_distance(core, motion, b, tri))
            high = b;
        else
            low = a;
    }
    real best = oracle_distance(core, motion, (low + high) / 2, tri);
    for (int i = 0; i < 2; i++) {
        real end = oracle_distance(core, motion, i, tri);
        if (end < best) best = end;
    }
    return best;
}

static uint64_t next(oracle_random *random)
{
    uint64_t z = random->state += 0x9e3779b97f4a7c15ULL;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
}

double oracle_uniform(oracle_random *random, double low, double high)
{
    return low + (high - low) * ((double)(next(random) >> 11) / 9007199254740992.0);
}

uint32_t oracle_below(oracle_random *random, uint32_t bound)
{
    return (uint32_t)((next(random) >> 32) % bound);
}
