/* SPDX-License-Identifier: MIT
 * scene.h: what the parts of the ccd backend share: its scene, and how a query walks through it. */
#ifndef TAHR_CCD_SCENE_H
#define TAHR_CCD_SCENE_H

#include "../common/body_tree.h"
#include "../common/piece_query.h"

#include <tahr/ccd.h>

typedef struct tahr__ccd_scene {
    tahr__scene scene;
    uint32_t sweep, boolean, max_iterations, reserved; /* tahr_ccd_desc */
    tahr__body_tree tree;
} tahr__ccd_scene;

/* scene.c: slots. */
tahr_status tahr__ccd_open(const tahr_host *host, const tahr_world_desc *desc, void **self);
void tahr__ccd_close(void *self);
tahr_status tahr__ccd_place(void *self, const tahr_body_pose *poses, uint32_t count);

/* walk.c: every piece that may be within reach of a query, in a fixed order. */
typedef struct tahr__ccd_walk {
    tahr__piece_query query;
    tahr__body_walk bodies;
    tahr__wide_walk tree; /* of a mesh */
    uint32_t body, inside;
} tahr__ccd_walk;

extern const tahr__piece_finder tahr__ccd_finder;

/* impact.c: see tahr__piece_finder, as the setting of the scene has it. */
tahr__verdict tahr__ccd_advance(const tahr__piece_query *query, const tahr__piece *piece, double limit,
                                double *fraction, tahr__near *near);

/* gjk.c: libccd's boolean. 1: swept shape and piece overlap, 0: they do not, -1: libccd used up its iterations. */
int tahr__ccd_swept_overlap(const tahr__piece_query *query, const tahr__piece *piece, double fraction);

static inline const tahr__ccd_scene *tahr__ccd_scene_of(const tahr__piece_query *query)
{
    return (const tahr__ccd_scene *)query->scene;
}

#endif
