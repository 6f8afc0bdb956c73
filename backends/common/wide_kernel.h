/* SPDX-License-Identifier: MIT
 * wide_kernel.h: the look at a node in vectors, for a file that has said how wide they are: WIDTH, lane, splat, larger,
 * bits_within, steps. The operations of tahr__wide_test_1 in their order. */
static inline lane square_gap(lane low, lane high, float from, float to)
{
    lane gap = larger(larger(low - splat(to), splat(from) - high), splat(0));
    return gap * gap;
}

static inline uint32_t wide_test(const tahr__wide_node *n, const tahr__wide_box *box, const int32_t point[3],
                                 float away[TAHR__WIDE])
{
    float step[3], from[3], to[3], at[3];
    uint32_t near = 0;
    for (int a = 0; a < 3; a++) {
        int32_t base = (int32_t)(n->base[a] & 0xFFFFFF);
        step[a] = (float)(1 << (n->base[a] >> 24 & 31));
        from[a] = (float)(box->lo[a] - base);
        to[a] = (float)(box->hi[a] - base);
        at[a] = (float)(point[a] - base);
    }
    for (uint32_t i = 0; i < TAHR__WIDE; i += WIDTH) {
        lane low[3], high[3];
        for (int a = 0; a < 3; a++) {
            low[a] = steps(&n->lo[a][i]) * splat(step[a]);
            high[a] = steps(&n->hi[a][i]) * splat(step[a]);
        }
        lane x = square_gap(low[0], high[0], from[0], to[0]), y = square_gap(low[1], high[1], from[1], to[1]);
        near |= bits_within((x + y) + square_gap(low[2], high[2], from[2], to[2]), box->limit) << i;
        if (!away) continue;
        x = square_gap(low[0], high[0], at[0], at[0]);
        y = square_gap(low[1], high[1], at[1], at[1]);
        x = (x + y) + square_gap(low[2], high[2], at[2], at[2]);
        memcpy(away + i, &x, sizeof x);
    }
    return near & (0xFFu >> (7 - (n->base[0] >> 29)));
}
