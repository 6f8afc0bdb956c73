/* SPDX-License-Identifier: MIT
 * impact.c: the first fraction of the motion at which the shape comes within its margin of a convex piece: by tangents
 * of the distance, which is convex along the motion; where the setting says so, libccd's boolean brackets it by
 * bisection before. */
#include "../common/graze.h"
#include "scene.h"

/* Arrived (m). libccd's own answer scatters by 1e-8 to 1e-5 m around contact. */
#define ARRIVED 1e-9
/* The bracket that bisection leaves (m); inside libccd's dead band a narrower one would be noise. */
#define BRACKET 1e-6
/* Growth of the steps that look for the far end of the bracket. */
#define STRIDE 16
enum { MAX_APPROACHES = 4, MAX_BISECTIONS = 40, MAX_TANGENTS = 64 };

/* Does the shape only pass what it has come within the margin of? */
static int passes(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, const tahr__descent *here)
{
    tahr__descent there = *here;
    tahr__ccd_near near;

    if (here->speed > TAHR__GRAZING * probe->motion_length) return 0;
    there.fraction = tahr__beyond(here, probe->radius + piece->radius + probe->margin, probe->motion_length);
    probe->context->narrow_iterations++;
    tahr__ccd_measure_far(probe, piece, v_scale(probe->motion, there.fraction), &near);
    there.gap = near.distance - probe->margin;
    there.speed = -v_dot(probe->motion, near.normal);
    return tahr__grazes(here, &there, probe->motion_length, ARRIVED);
}

/* A tangent of a convex function lies below it: a step to its root never overshoots, and one that starts late goes back
 * to the early side. came_by_tangent: *fraction is such a root, of the tangent at *near. */
static tahr__ccd_verdict advance(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, double limit,
                                 int came_by_tangent, double *fraction, tahr__ccd_near *near)
{
    double t = *fraction, last_speed = -v_dot(probe->motion, near->normal);

    for (int i = 0; i < MAX_TANGENTS; i++) {
        tahr__ccd_measure_far(probe, piece, v_scale(probe->motion, t), near);
        probe->context->narrow_iterations++;
        double gap = near->distance - probe->margin, speed = -v_dot(probe->motion, near->normal);
        *fraction = t;
        if (gap <= ARRIVED && gap >= -ARRIVED)
            return passes(probe, piece, &(tahr__descent){gap, speed, t}) ? TAHR__CCD_FREE : TAHR__CCD_HIT;
        if (came_by_tangent && gap < 0) {
            /* They touch, no more. What is deeper is the way back to the front of a triangle that is crossed there: the
             * contact itself is seen from a micrometre before. */
            double back = d_max(0, t - BRACKET / last_speed);
            if (gap < -BRACKET) tahr__ccd_measure(probe, piece, v_scale(probe->motion, back), near);
            near->distance = probe->margin;
            return TAHR__CCD_HIT;
        }
        if (!(speed > 0)) return gap > 0 ? TAHR__CCD_FREE : TAHR__CCD_UNKNOWN;
        came_by_tangent = gap > 0;
        last_speed = speed;
        t += gap / speed;
        if (t > limit) return TAHR__CCD_FREE;
        if (t < 0) t = 0;
        if (t == *fraction) return TAHR__CCD_HIT;
    }
    return TAHR__CCD_UNKNOWN;
}

tahr__ccd_verdict tahr__ccd_advance(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, double limit,
                                    double *fraction, tahr__ccd_near *near)
{
    return advance(probe, piece, limit, *fraction > 0, fraction, near);
}

/* Brackets the first overlap in [safe, limit]: ever longer steps from the safe end, then bisection. Returns the free
 * end of the bracket, or a negative number if all of it is free. */
static double bracket(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, double safe, double limit)
{
    double low = safe, high = limit, step = BRACKET / probe->motion_length;

    if (tahr__ccd_swept_overlap(probe, piece, limit) == 0) return -1;
    for (double t = safe + step; t < limit; t += step) {
        if (tahr__ccd_swept_overlap(probe, piece, t) != 0) {
            high = t;
            break;
        }
        low = t;
        step *= STRIDE;
    }
    for (int i = 0; i < MAX_BISECTIONS && (high - low) * probe->motion_length > BRACKET; i++) {
        double middle = 0.5 * (low + high);
        if (tahr__ccd_swept_overlap(probe, piece, middle) == 0)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* A few tangents from a safe fraction: most pieces are cleared by them, and the others need a short bracket only.
 * Returns the new safe fraction, the root of the tangent at *near; beyond limit if the piece is free up to there. */
static double approach(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, double safe, double limit,
                       tahr__ccd_near *near)
{
    for (int i = 0; i < MAX_APPROACHES && safe <= limit; i++) {
        tahr__ccd_near here;
        tahr__ccd_measure_far(probe, piece, v_scale(probe->motion, safe), &here);
        probe->context->narrow_iterations++;
        double gap = here.distance - probe->margin, speed = -v_dot(probe->motion, here.normal);
        if (gap <= BRACKET) break;
        if (!(speed > 0)) return 2;
        *near = here;
        safe += gap / speed;
    }
    return safe;
}

static tahr__ccd_verdict bisect(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, double limit,
                                double *fraction, tahr__ccd_near *near)
{
    double safe = approach(probe, piece, *fraction, limit, near), low;
    tahr__ccd_near last = *near;
    tahr__ccd_verdict verdict;

    if (safe > limit) return TAHR__CCD_FREE;
    low = bracket(probe, piece, safe, limit);
    if (low < 0) return TAHR__CCD_FREE;
    *fraction = low;
    verdict = advance(probe, piece, limit, 0, fraction, near);
    if (verdict != TAHR__CCD_UNKNOWN) return verdict;
    /* libccd was wrong about the free end: again from where no boolean was needed. */
    *fraction = safe;
    *near = last;
    return advance(probe, piece, limit, 1, fraction, near);
}

tahr__ccd_verdict tahr__ccd_impact(const tahr__ccd_probe *probe, const tahr__ccd_piece *piece, double limit,
                                   double *fraction, tahr__ccd_near *near)
{
    if (probe->scene->sweep == TAHR_CCD_SWEEP_BISECTION) return bisect(probe, piece, limit, fraction, near);
    return tahr__ccd_advance(probe, piece, limit, fraction, near);
}
