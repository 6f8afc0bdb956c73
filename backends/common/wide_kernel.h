/* SPDX-License-Identifier: MIT
 * wide_kernel.h: the look at a node in vectors, for a file that has said how wide they are: lane_4.h or lane_8.h, and
 * steps. The bits of tahr__wide_test_1: distances are taken in steps of the node and multiplied by the
 * step, a power of two, which rounds nothing. */
typedef int32_t four __attribute__((vector_size(16)));
typedef float four_floats __attribute__((vector_size(16)));

static inline four load_four(const void *p)
{
    four v;
    memcpy(&v, p, sizeof v);
    return v;
}

static inline lane square_gap(lane low, lane high, float from, float to, float step)
{
    lane gap = larger(larger(low - splat(to), splat(from) - high), splat(0)) * splat(step);
    return gap * gap;
}

static inline uint32_t wide_test(const tahr__wide_node *n, const tahr__wide_box *box, const int32_t point[4],
                                 float away[TAHR__WIDE])
{
    uint32_t near = 0;
    four head = load_four(n->base), low = head & 0xFFFFFF, shift = (head >> 24 & 31) << 23;
    four_floats step = (four_floats)((127 << 23) + shift), per = (four_floats)((127 << 23) - shift);
    four_floats from = __builtin_convertvector(load_four(box->lo) - low, four_floats) * per;
    four_floats to = __builtin_convertvector(load_four(box->hi) - low, four_floats) * per;
    for (uint32_t i = 0; i < TAHR__WIDE; i += WIDTH) {
        lane x0 = steps(&n->lo[0][i]), y0 = steps(&n->lo[1][i]), z0 = steps(&n->lo[2][i]);
        lane x1 = steps(&n->hi[0][i]), y1 = steps(&n->hi[1][i]), z1 = steps(&n->hi[2][i]);
        lane x = square_gap(x0, x1, from[0], to[0], step[0]), y = square_gap(y0, y1, from[1], to[1], step[1]);
        near |= bits((x + y) + square_gap(z0, z1, from[2], to[2], step[2]) <= splat(box->limit)) << i;
        if (!away) continue;
        four_floats at = __builtin_convertvector(load_four(point) - low, four_floats) * per;
        x = square_gap(x0, x1, at[0], at[0], step[0]);
        y = square_gap(y0, y1, at[1], at[1], step[1]);
        x = (x + y) + square_gap(z0, z1, at[2], at[2], step[2]);
        memcpy(away + i, &x, sizeof x);
    }
    return near & (0xFFu >> (7 - (n->base[0] >> 29)));
}
