/* SPDX-License-Identifier: MIT
 * core_box.c: nearest points between a box and a point or a segment: in the frame of the box the squared distance is a
 * sum of one-dimensional ones, and along a segment it is convex and quadratic between at most six places. */
#include "core_box.h"

/* Slope (m per metre) below which the distance along a segment is level: as in core_distance.c. */
#define LEVEL 1e-13

static double outside(double x, double half)
{
    return x > half ? x - half : x < -half ? x + half : 0;
}

/* Half the derivative of the squared distance at a + t d. */
static double slope_at(const double a[3], const double d[3], const double h[3], double t)
{
    double sum = 0;
    for (int i = 0; i < 3; i++)
        sum += d[i] * outside(a[i] + t * d[i], h[i]);
    return sum;
}

static double distance_at(const double a[3], const double d[3], const double h[3], double t)
{
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        double o = outside(a[i] + t * d[i], h[i]);
        sum += o * o;
    }
    return sqrt(sum);
}

/* The places within (-1, 1) where the segment passes a plane of a face, in order. */
static int find_knots(const double a[3], const double d[3], const double h[3], double knot[8])
{
    int count = 0;
    knot[count++] = -1;
    for (int i = 0; i < 6; i++) {
        double along = d[i / 2], t = ((i & 1 ? h[i / 2] : -h[i / 2]) - a[i / 2]);
        int at = count;
        if (!(fabs(t) < fabs(along))) continue;
        t /= along;
        for (; at > 1 && knot[at - 1] > t; at--)
            knot[at] = knot[at - 1];
        knot[at] = t;
        count++;
    }
    knot[count++] = 1;
    return count;
}

/* The first place of the segment a + t d, t in [-1, 1], that is nearest to the box. */
static double nearest_on_segment(const double a[3], const double d[3], const double h[3])
{
    double knot[8], length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]), low, slope;
    int count = find_knots(a, d, h, knot);

    low = knot[0];
    slope = slope_at(a, d, h, low);
    for (int i = 1; i < count; i++) {
        if (slope >= -LEVEL * length * distance_at(a, d, h, low)) return low;
        double high = knot[i], next = slope_at(a, d, h, high);
        if (next >= 0) {
            /* Linear between the two: from the end that is nearer to the zero, so that its rounding is small. */
            double t = -slope <= next ? low + (high - low) * (-slope / (next - slope))
                                      : high - (high - low) * (next / (next - slope));
            return d_min(high, d_max(low, t));
        }
        low = high;
        slope = next;
    }
    return 1;
}

void tahr__core_box(const tahr__core *core, tahr_vec3 centre, const tahr__box *box, tahr__witness *out)
{
    tahr_vec3 from = v_sub(centre, box->middle), along = v_make(0, 0, 0), apart;
    double t = 0;

    if (core->axis_count == 1) along = core->axis[0];
    if (box->turn) {
        from = m_unapply(box->turn, from);
        along = m_unapply(box->turn, along);
    }
    double a[3] = {from.x, from.y, from.z}, d[3] = {along.x, along.y, along.z};
    double h[3] = {box->half.x, box->half.y, box->half.z};
    if (core->axis_count == 1) t = nearest_on_segment(a, d, h);
    tahr_vec3 q = v_mad(from, along, t);
    apart = v_make(outside(q.x, h[0]), outside(q.y, h[1]), outside(q.z, h[2]));
    out->point = v_sub(q, apart);
    if (box->turn) {
        apart = m_apply(box->turn, apart);
        out->point = m_apply(box->turn, out->point);
    }
    out->point = v_add(box->middle, out->point);
    out->feature = TAHR__FACE;
    out->beside = 0;
    out->distance = v_length(apart);
    out->normal = v_make(0, 0, 0);
    if (out->distance > 0) { /* divided, not scaled: straight in front of a face the normal is the face's to the bit */
        out->normal = v_make(apart.x / out->distance, apart.y / out->distance, apart.z / out->distance);
    }
}
