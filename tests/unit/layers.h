/* SPDX-License-Identifier: MIT
 * layers.h: worlds of one-way platforms, with z up or in a plane with y up, on every backend that has them. */
#ifndef LAYERS_H
#define LAYERS_H

#include "player.h"

/* Boxes are 0.2 m thick below their top; sheets are two triangles without a thickness; tiles are sheets side by side,
 * 1 m wide, each a body of its own; blocks are boxes of 1 m, each a body of its own. */
enum { LAYER_BOX, LAYER_SHEET, LAYER_TILES, LAYER_BLOCKS, LAYER_KINDS };

enum { LAYERS_MOST = 160 };
typedef struct layers {
    int up; /* 1: y, 2: z */
    const tahr_backend *backend;
    tahr_body_desc bodies[LAYERS_MOST];
    double corners[LAYERS_MOST][12];
    uint32_t count;
    int gathered; /* sheets that stay where they are come from tahr_native_desc.gather, as bodies LAYERS_MOST + index */
} layers;

/* The worlds that all of this is asked of: native and, where they are built, ccd and fcl; each with z up
 * and with y up. After them native with sheets that it gathers, for what needs no more of a body than its surface. */
enum { LAYERS_WORLDS = 6, LAYERS_GATHERED = 8 };
/* Returns 0 where there is no such world in this build. */
int layers_begin(layers *l, int world);

/* (x, height) in a world's frame. */
tahr_vec3 layers_at(const layers *l, double x, double height);
double layers_x(const layers *l, tahr_vec3 v);
double layers_height(const layers *l, tahr_vec3 v);

/* A layer from `from` to `to` with its top at `height`, as `kind`; flags of its bodies. */
void layers_add(layers *l, int kind, double from, double to, double height, uint32_t flags);
/* A sheet from (x0, h0) to (x1, h1), left to right. */
void layers_slope(layers *l, tahr_vec3 begin, tahr_vec3 end, uint32_t flags);

/* A character with its foot at (x, foot), in the air at rest; config NULL: PRECISE turned into the world's frame. */
void layers_open(layers *l, rig *r, const tahr_config *config, double x, double foot);
tahr_config layers_config(const layers *l, uint32_t preset);
/* Height of the foot. */
double layers_foot(const layers *l, const rig *r);

#endif
