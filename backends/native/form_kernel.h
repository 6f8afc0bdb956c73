/* SPDX-License-Identifier: MIT
 * form_kernel.h: boxes and planes of WIDTH triangles in vectors of doubles, for a file that has said how wide they
 * are: WIDTH, lane, mask, vec, one_over_root (tahr__lanes_scale), lower (a < b ? a : b), higher (a > b ? a : b), put,
 * load. The operations of tahr__map_point, tahr__facet_finish and tahr__lanes_put in their order. */

static inline lane size(lane a)
{
    return (lane)((mask)a & 0x7FFFFFFFFFFFFFFF);
}

static inline vec sub(vec a, vec b)
{
    return (vec){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline vec times(vec a, lane s)
{
    return (vec){a.x * s, a.y * s, a.z * s};
}

static inline lane dot(vec a, vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline vec cross(vec a, vec b)
{
    return (vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline lane row(tahr_vec3 r, vec v)
{
    return r.x * v.x + r.y * v.y + r.z * v.z;
}

static inline mask near(vec p)
{
    return (mask)(size(p.x) <= 32.0) & (mask)(size(p.y) <= 32.0) & (mask)(size(p.z) <= 32.0);
}

static inline vec corner(const tahr__map *map, const tahr_vec3 *const at[TAHR__FORMED])
{
    vec v = load(at);
    if (map->turned) v = (vec){row(map->turn.row[0], v), row(map->turn.row[1], v), row(map->turn.row[2], v)};
    return (vec){map->offset.x + v.x, map->offset.y + v.y, map->offset.z + v.z};
}

static inline void put_down(float *to, lane a, lane b, lane c)
{
    lane x = lower(a, lower(b, c));
    put(to, x - (size(x) * 2.4e-7 + 1e-30));
}

static inline void put_up(float *to, lane a, lane b, lane c)
{
    lane x = higher(a, higher(b, c));
    put(to, x + (size(x) * 2.4e-7 + 1e-30));
}

static inline void put_if(float *to, mask m, lane x)
{
    put(to, (lane)((mask)x & m));
}

/* A plane: direction, and how far along it. */
static inline void put_plane(float *to, mask m, vec n, vec at)
{
    put_if(to, m, n.x);
    put_if(to + TAHR__LANES, m, n.y);
    put_if(to + 2 * TAHR__LANES, m, n.z);
    put_if(to + 3 * TAHR__LANES, m, dot(n, at));
}

static inline mask has_plane(const vec v[3], lane length2)
{
    return (mask)(length2 > TAHR__LANE_AREA2) & near(v[0]) & near(v[1]) & near(v[2]);
}

static inline void form(const tahr__map *map, const tahr__raw *raw, float *lanes)
{
    vec v[3];
    float *low = lanes + TAHR__LANE_LOW * TAHR__LANES, *high = lanes + TAHR__LANE_HIGH * TAHR__LANES;
    for (int k = 0; k < 3; k++)
        v[k] = corner(map, raw->corner[k]);
    put_down(low, v[0].x, v[1].x, v[2].x);
    put_down(low + TAHR__LANES, v[0].y, v[1].y, v[2].y);
    put_down(low + 2 * TAHR__LANES, v[0].z, v[1].z, v[2].z);
    put_up(high, v[0].x, v[1].x, v[2].x);
    put_up(high + TAHR__LANES, v[0].y, v[1].y, v[2].y);
    put_up(high + 2 * TAHR__LANES, v[0].z, v[1].z, v[2].z);
    vec n = cross(sub(v[1], v[0]), sub(v[2], v[0]));
    lane length2 = dot(n, n);
    mask m = has_plane(v, length2);
    n = times(n, one_over_root(length2));
    put_plane(lanes + TAHR__LANE_NORMAL * TAHR__LANES, m, n, v[0]);
    for (int k = 0; k < 3; k++) {
        vec e = sub(v[k < 2 ? k + 1 : 0], v[k]), out = times(cross(e, n), one_over_root(dot(e, e)));
        put_plane(lanes + (TAHR__LANE_EDGE + 4 * k) * TAHR__LANES, m, out, v[k]);
    }
}
