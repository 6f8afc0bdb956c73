/* SPDX-License-Identifier: MIT
 * lanes_which.h: which lanes, as vectors of all bits or none, for a file that then includes lanes_kernel.h: after
 * lane_4.h or lane_8.h. */

typedef mask which;

/* a <= b */
static inline which no_more(lane a, lane b)
{
    return a <= b;
}

/* a > b */
static inline which more(lane a, lane b)
{
    return a > b;
}

static inline int any(which m)
{
    return bits(m) != 0;
}

/* m ? a : b */
static inline lane choose(which m, lane a, lane b)
{
    return (lane)(((which)a & m) | ((which)b & ~m));
}

/* m ? a : 0 */
static inline lane only(which m, lane a)
{
    return (lane)((which)a & m);
}

static inline uint32_t keep(which near, lane value, uint32_t first, tahr__lanes_found *found)
{
    uint32_t kept = 0;
    for (unsigned left = bits(near); left; left &= left - 1) {
        unsigned k = (unsigned)__builtin_ctz(left);
        found[kept++] = (tahr__lanes_found){value[k], first + k};
    }
    return kept;
}
