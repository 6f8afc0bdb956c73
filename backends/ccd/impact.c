/* SPDX-License-Identifier: MIT
 * impact.c: the first fraction of the motion at which the shape comes within its margin of a piece: by tangents of the
 * distance; where the setting says so, libccd's boolean brackets it by bisection before. */
#include "scene.h"

/* The bracket that bisection leaves (m); libccd's own answer scatters by 1e-8 to 1e-5 m around contact: a narrower one
 * would be noise. */
#define BRACKET 1e-6
/* Growth of the steps that look for the far end of the bracket. */
#define STRIDE 16
enum { MAX_APPROACHES = 4, MAX_BISECTIONS = 40 };

/* Brackets the first overlap in [safe, limit]: ever longer steps from the safe end, then bisection. Returns the free
 * end of the bracket, or a negative number if all of it is free. */
static double bracket(const tahr__piece_query *q, const tahr__piece *piece, double safe, double limit)
{
    double low = safe, high = limit, step = BRACKET / q->motion_length;

    if (tahr__ccd_swept_overlap(q, piece, limit) == 0) return -1;
    for (double t = safe + step; t < limit; t += step) {
        if (tahr__ccd_swept_overlap(q, piece, t) != 0) {
            high = t;
            break;
        }
        low = t;
        step *= STRIDE;
    }
    for (int i = 0; i < MAX_BISECTIONS && (high - low) * q->motion_length > BRACKET; i++) {
        double middle = 0.5 * (low + high);
        if (tahr__ccd_swept_overlap(q, piece, middle) == 0)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* A few tangents from a safe fraction: most pieces are cleared by them, and the others need a short bracket only.
 * Returns the new safe fraction; beyond limit if the piece is free up to there. */
static double approach(const tahr__piece_query *q, const tahr__piece *piece, double safe, double limit)
{
    const tahr__motion motion = tahr__piece_query_motion(q);

    for (int i = 0; i < MAX_APPROACHES && safe <= limit; i++) {
        tahr__near here;
        tahr__piece_measure_far(&motion, piece, safe, &here);
        q->context->narrow_iterations++;
        double gap = here.distance - q->margin, speed = -v_dot(q->motion, here.normal);
        if (gap <= BRACKET) break;
        if (!(speed > 0)) return 2;
        safe += gap / speed;
    }
    return safe;
}

static tahr__verdict bisect(const tahr__piece_query *q, const tahr__piece *piece, double limit, double *fraction,
                            tahr__near *near)
{
    tahr__motion motion = tahr__piece_query_motion(q);
    double safe = approach(q, piece, *fraction, limit);

    if (safe > limit) return TAHR__FREE;
    *fraction = bracket(q, piece, safe, limit);
    if (*fraction < 0) return TAHR__FREE;
    motion.unsure = 1;
    tahr__verdict verdict = tahr__piece_advance(&motion, piece, limit, fraction, near);
    if (verdict != TAHR__UNKNOWN) return verdict;
    /* libccd was wrong about the free end: again from where no boolean was needed. */
    *fraction = safe;
    return tahr__piece_query_advance(q, piece, limit, fraction, near);
}

tahr__verdict tahr__ccd_advance(const tahr__piece_query *q, const tahr__piece *piece, double limit, double *fraction,
                                tahr__near *near)
{
    int bisects = tahr__ccd_scene_of(q)->sweep == TAHR_CCD_SWEEP_BISECTION;
    return (bisects ? bisect : tahr__piece_query_advance)(q, piece, limit, fraction, near);
}
