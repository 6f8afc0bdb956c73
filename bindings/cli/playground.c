/* SPDX-License-Identifier: MIT
 * playground.c: the bundled level: 60 x 54 m of stairs, ramps, gaps, walls, creases, ledges, low ceilings, pillars and
 * rough ground, and of things that move, made of meshes, boxes, spheres and capsules, written by this project. */
#include "level.h"
#include "rides.h"
#include "say.h"
#include "sketch.h"
#include "vec.h"

#define HALF_X 30.0 /* m */
#define SOUTH (-20.0)
#define NORTH 34.0

/* The patch of rough ground, for which the flat floor leaves a hole. */
#define ROUGH_X0 2.0
#define ROUGH_X1 16.0
#define ROUGH_Y0 (-6.0)
#define ROUGH_Y1 6.0
#define ROUGH_CELL 0.25

/* Smooth bumps of up to 0.9 m with a fine ripple, zero along the border of the patch. Products of parabolas instead of
 * sines: the same bits everywhere. */
static double wave(double x)
{
    double t = x - floor(x);
    return t < 0.5 ? 16 * t * (0.5 - t) : -16 * (t - 0.5) * (1 - t);
}

static double rough_height(double x, double y)
{
    double u = (x - ROUGH_X0) / (ROUGH_X1 - ROUGH_X0), v = (y - ROUGH_Y0) / (ROUGH_Y1 - ROUGH_Y0);
    double fade = 16 * u * (1 - u) * v * (1 - v);
    double bumps = 0.45 * wave(x / 4.7) * wave(y / 3.9 + 0.3) + 0.25 * wave(x / 2.1 + 0.2) * wave(y / 2.6) + 0.25;
    return fade * (bumps + 0.05 * wave(x / 1.9 + y / 2.3));
}

static void add_ground(struct level *level)
{
    struct sketch flat = {0}, rough = {0};
    const double cell = 2;
    for (double x = -HALF_X; x < HALF_X; x += cell) {
        for (double y = SOUTH; y < NORTH; y += cell) {
            int rough_here = x >= ROUGH_X0 && x < ROUGH_X1 && y >= ROUGH_Y0 && y < ROUGH_Y1;
            int pool_here = x >= POOL_X0 && x < POOL_X1 && y >= POOL_Y0 && y < POOL_Y1;
            if (!rough_here && !pool_here) {
                sketch_quad(&flat, (tahr_vec3){x, y, 0}, (tahr_vec3){x + cell, y, 0},
                            (tahr_vec3){x + cell, y + cell, 0}, (tahr_vec3){x, y + cell, 0});
            }
        }
    }
    for (double x = ROUGH_X0; x < ROUGH_X1; x += ROUGH_CELL) {
        for (double y = ROUGH_Y0; y < ROUGH_Y1; y += ROUGH_CELL) {
            double e = ROUGH_CELL;
            sketch_quad(&rough, (tahr_vec3){x, y, rough_height(x, y)}, (tahr_vec3){x + e, y, rough_height(x + e, y)},
                        (tahr_vec3){x + e, y + e, rough_height(x + e, y + e)},
                        (tahr_vec3){x, y + e, rough_height(x, y + e)});
        }
    }
    sketch_finish(&flat, level);
    sketch_finish(&rough, level);
}

/* A wall of boxes along a line from (x, y) in the direction (c, s), which is the cosine and sine of its angle. */
static void add_wall(struct level *level, double x, double y, double c, double s, double length, double thickness)
{
    /* Half angle: cos(a/2) = sqrt((1 + c)/2), sin(a/2) takes the sign of s. */
    double w = sqrt((1 + c) / 2), z = (s < 0 ? -1 : 1) * sqrt((1 - c) / 2);
    level_add_box(level, (tahr_vec3){x + c * length / 2, y + s * length / 2, 1.25},
                  (tahr_vec3){length / 2, thickness / 2, 1.25}, (tahr_quat){0, 0, z, w});
}

/* Sheets without thickness, so that nobody begins on top of them; higher than what can be jumped from any platform. */
static void add_border(struct level *level)
{
    const tahr_vec3 corners[4] = {{-HALF_X, SOUTH, 0}, {HALF_X, SOUTH, 0}, {HALF_X, NORTH, 0}, {-HALF_X, NORTH, 0}};
    const tahr_vec3 up = {0, 0, 9};
    struct sketch sketch = {0};
    for (int i = 0; i < 4; i++) {
        tahr_vec3 a = corners[i], b = corners[(i + 1) % 4];
        sketch_quad(&sketch, a, b, vec_add(b, up), vec_add(a, up));
    }
    sketch_finish(&sketch, level);
}

#define STEP 0.3 /* m, rise and run */
#define STEPS 8

/* Up by sharp steps, over a landing, down by steps with bevelled edges; and a flight of low ones beside it. */
static void add_stairs(struct level *level)
{
    struct sketch sketch = {0};
    struct corner up[5 * STEPS + 8];
    const double x0 = -28, landing = 3, bevel = 0.06, top = STEP * STEPS;
    size_t n = 0;
    up[n++] = (struct corner){x0, 0};
    for (int i = 1; i <= STEPS; i++) {
        up[n++] = (struct corner){x0 + STEP * (i - 1), STEP * i};
        up[n++] = (struct corner){x0 + STEP * i, STEP * i};
    }
    double x = x0 + STEP * STEPS + landing;
    for (int i = 0; i < STEPS; i++) {
        up[n++] = (struct corner){x + STEP * (i + 1) - bevel, top - STEP * i};
        up[n++] = (struct corner){x + STEP * (i + 1), top - STEP * i - bevel};
        up[n++] = (struct corner){x + STEP * (i + 1), top - STEP * (i + 1)};
    }
    sketch_profile(&sketch, up, n, 13, 16.5, 0);
    n = 0;
    up[n++] = (struct corner){x0, 0};
    for (int i = 1; i <= STEPS; i++) {
        up[n++] = (struct corner){x0 + 0.4 * (i - 1), 0.15 * i};
        up[n++] = (struct corner){x0 + 0.4 * i, 0.15 * i};
    }
    up[n++] = (struct corner){x0 + 0.4 * STEPS + 3.5, 0};
    sketch_profile(&sketch, up, n, 8, 11, 0);
    sketch_finish(&sketch, level);
}

/* Up and down at 20, 35, 45 and 60 degrees; the last is too steep to walk. Runs are height over tangent. */
static void add_ramps(struct level *level)
{
    static const double tangent[4] = {0.36397023426620234, 0.7002075382097097, 1, 1.7320508075688772};
    struct sketch sketch = {0};
    const double middle = -8, height = 2;
    for (int i = 0; i < 4; i++) {
        double run = height / tangent[i], y = 6.5 + 3.3 * i;
        SKETCH_PROFILE(&sketch, y, y + 2.5, 0, {middle - 1 - run, 0}, {middle - 1, height}, {middle + 1, height},
                       {middle + 1 + run, 0});
    }
    sketch_finish(&sketch, level);
}

/* A walkway 1 m above the ground with gaps of 0.5, 1 and 2 m, and a ramp at each end. */
static void add_gaps(struct level *level)
{
    struct sketch sketch = {0};
    SKETCH_PROFILE(&sketch, 13.5, 16.5, 0, {2, 0}, {4.5, 1}, {8, 1}, {8, 0});
    SKETCH_PROFILE(&sketch, 13.5, 16.5, 0, {8.5, 0}, {8.5, 1}, {12, 1}, {12, 0});
    SKETCH_PROFILE(&sketch, 13.5, 16.5, 0, {13, 0}, {13, 1}, {17, 1}, {17, 0});
    SKETCH_PROFILE(&sketch, 13.5, 16.5, 0, {19, 0}, {19, 1}, {22, 1}, {24.5, 0});
    sketch_finish(&sketch, level);
    /* Narrow beams, 0.3 and 0.1 m wide. */
    sketch_block(level, 4, 10, 9.85, 10.15, 0, 0.35);
    sketch_block(level, 12, 18, 9.95, 10.05, 0, 0.35);
    sketch_block(level, 20, 26, 9, 11, 0, 0.1);
    sketch_block(level, 21, 25, 9.4, 10.6, 0.1, 0.2);
}

/* Inner and outer corners, and wedges of 30 and 12 degrees that end in a point. */
static void add_walls(struct level *level)
{
    const double c15 = 0.9659258262890683, s15 = 0.25881904510252074, c6 = 0.9945218953682733, s6 = 0.10452846326765347;
    sketch_block(level, -28, -22, 4, 4.3, 0, 2.5);
    sketch_block(level, -28, -27.7, 0, 4, 0, 2.5);
    sketch_block(level, -22.3, -22, 1.5, 4, 0, 2.5);
    sketch_block(level, -25.5, -24.5, -0.5, 1.5, 0, 2.5);
    add_wall(level, -20, 2.5, c15, s15, 4.5, 0.2);
    add_wall(level, -20, 2.5, c15, -s15, 4.5, 0.2);
    add_wall(level, -20, -2, c6, s6, 4.5, 0.2);
    add_wall(level, -20, -2, c6, -s6, 4.5, 0.2);
    add_wall(level, -28, -5.5, c15, s15, 6, 0.3);
    add_wall(level, -28 + 6 * c15, -5.5 + 6 * s15, c15, -s15, 6, 0.3);
}

/* Two faces of 70 degrees that meet in a sloping crease, and a spike of faces of 55 degrees: steep ground to slide
 * off. */
static void add_creases(struct level *level)
{
    struct sketch sketch = {0};
    const tahr_vec3 left = {-10, 0.7, 0}, foot = {-6, 3.7, 0}, right = {-2, 0.7, 0};
    const tahr_vec3 top_left = {-10, 1.9, 2.6}, top = {-6, 4.9, 2.6}, top_right = {-2, 1.9, 2.6};
    const tahr_vec3 back_left = {-10, 5.6, 2.6}, back_right = {-2, 5.6, 2.6};
    const tahr_vec3 heel_left = {-10, 5.6, 0}, heel_right = {-2, 5.6, 0};
    sketch_quad(&sketch, left, foot, top, top_left);
    sketch_quad(&sketch, foot, right, top_right, top);
    sketch_triangle(&sketch, top_left, top, back_left);
    sketch_triangle(&sketch, back_left, top, back_right);
    sketch_triangle(&sketch, top, top_right, back_right);
    sketch_quad(&sketch, left, top_left, back_left, heel_left);
    sketch_quad(&sketch, right, heel_right, back_right, top_right);
    sketch_quad(&sketch, heel_left, back_left, back_right, heel_right);
    const tahr_vec3 peak = {-6, -3.5, 2},
                    base[4] = {{-7.4, -4.9, 0}, {-4.6, -4.9, 0}, {-4.6, -2.1, 0}, {-7.4, -2.1, 0}};
    for (int i = 0; i < 4; i++) {
        sketch_triangle(&sketch, base[i], base[(i + 1) % 4], peak);
    }
    sketch_finish(&sketch, level);
}

static void add_pillars(struct level *level)
{
    const double c45 = 0.9238795325112867, s45 = 0.3826834323650898; /* half of 45 degrees */
    for (int i = 0; i < 3; i++) {
        double y = -4.5 + 4.5 * i;
        level_add_capsule(level, (tahr_vec3){19, y, 1}, 0.3 + 0.1 * i, 1.5);
        level_add_box(level, (tahr_vec3){22.5, y, 1.25}, (tahr_vec3){0.5, 0.5, 1.25}, (tahr_quat){0, 0, s45, c45});
        level_add_sphere(level, (tahr_vec3){26, y, -0.3}, 0.55 + 0.25 * i);
    }
}

/* Slabs at 1.9 m, which can be walked under, and at 1.7 m, which cannot; and a ceiling that comes down to the floor. */
static void add_ceilings(struct level *level)
{
    struct sketch sketch = {0};
    const double clear[2] = {1.9, 1.7};
    for (int i = 0; i < 2; i++) {
        double x = -28 + 5.5 * i;
        sketch_block(level, x, x + 4, -14, -9, clear[i], clear[i] + 0.25);
        sketch_block(level, x, x + 0.25, -14, -13.75, 0, clear[i]);
        sketch_block(level, x, x + 0.25, -9.25, -9, 0, clear[i]);
        sketch_block(level, x + 3.75, x + 4, -14, -13.75, 0, clear[i]);
        sketch_block(level, x + 3.75, x + 4, -9.25, -9, 0, clear[i]);
    }
    sketch_quad(&sketch, (tahr_vec3){-27, -19, 0}, (tahr_vec3){-21, -19, 2.6}, (tahr_vec3){-21, -16, 2.6},
                (tahr_vec3){-27, -16, 0});
    sketch_finish(&sketch, level);
}

/* A channel between faces of 60 degrees that can only be stood in by touching both. Open at both ends, with
 * ramps up to its rims. */
static void add_gutter(struct level *level)
{
    struct sketch sketch = {0};
    const double y0 = -18, y1 = -10, depth = 1.2, half = 0.6928203230275509; /* depth / tan 60 */
    const double x = -12, z = 1.4;
    for (int side = -1; side <= 1; side += 2) {
        tahr_vec3 low0 = {x, y0, z - depth}, low1 = {x, y1, z - depth}, rim0 = {x + side * half, y0, z},
                  rim1 = {x + side * half, y1, z};
        tahr_vec3 out0 = {x + side * 2.2, y0, z}, out1 = {x + side * 2.2, y1, z};
        tahr_vec3 foot0 = {x + side * 4.6, y0, 0}, foot1 = {x + side * 4.6, y1, 0};
        sketch_quad(&sketch, low0, low1, rim1, rim0);
        sketch_quad(&sketch, rim0, rim1, out1, out0);
        sketch_quad(&sketch, out0, out1, foot1, foot0);
        for (int end = 0; end < 2; end++) {
            double y = end ? y1 : y0;
            tahr_vec3 bed = {x, y, 0}, low = end ? low1 : low0, rim = end ? rim1 : rim0, out = end ? out1 : out0;
            tahr_vec3 foot = end ? foot1 : foot0;
            sketch_quad(&sketch, bed, foot, out, rim);
            sketch_triangle(&sketch, bed, rim, low);
        }
    }
    sketch_finish(&sketch, level);
}

/* Blocks that can just be stepped on, and just not; and a pyramid of ledges. */
static void add_ledges(struct level *level)
{
    static const double heights[5] = {0.2, 0.39, 0.41, 0.6, 1.2};
    for (int i = 0; i < 5; i++) {
        double x = -5 + 2.6 * i;
        sketch_block(level, x, x + 1.8, -11, -9, 0, heights[i]);
    }
    for (int i = 0; i < 4; i++) {
        double inset = 0.7 * i;
        sketch_block(level, -4 + inset, 3 - inset, -18.5 + inset, -13 - inset, 0, 0.35 * (i + 1));
    }
}

/* Walls of 2 cm and of no thickness at all, and a passage just wide enough. */
static void add_thin_walls(struct level *level)
{
    struct sketch sketch = {0};
    sketch_block(level, 11, 15, -10.01, -9.99, 0, 2.5);
    sketch_quad(&sketch, (tahr_vec3){11, -13, 0}, (tahr_vec3){15, -13, 0}, (tahr_vec3){15, -13, 2.5},
                (tahr_vec3){11, -13, 2.5});
    sketch_quad(&sketch, (tahr_vec3){11, -17, 0}, (tahr_vec3){15, -14.5, 0}, (tahr_vec3){15, -14.5, 2.5},
                (tahr_vec3){11, -17, 2.5});
    sketch_finish(&sketch, level);
    sketch_block(level, 18, 24, -12, -11, 0, 2.5);
    sketch_block(level, 18, 24, -13.8, -12.8, 0, 2.5);
    sketch_block(level, 18, 24, -15.45, -14.52, 0, 2.5);
    sketch_block(level, 26, 28, -19, -9, 0, 0.3);
}

static const struct level_label labels[] = {
    {"stairs 0.3 m, sharp and bevelled", -24.1, 17.2},
    {"stairs 0.15 m, slope", -25, 11.7},
    {"20\302\260", -8, 9.3},
    {"35\302\260", -8, 12.6},
    {"45\302\260", -8, 15.9},
    {"60\302\260", -8, 19.2},
    {"gaps 0.5, 1, 2 m", 13, 17.2},
    {"beams", 11, 10.9},
    {"kerbs", 23, 11.5},
    {"corners", -25, 4.9},
    {"wedges 30\302\260, 12\302\260", -17.6, 4.4},
    {"crease", -6, 6.0},
    {"spike", -6, -5.6},
    {"rough ground", 9, 6.5},
    {"pillars", 22.5, 6.2},
    {"ceilings 1.9 and 1.7 m", -23.2, -8.5},
    {"sloping ceiling", -24, -15.5},
    {"gutter 60\302\260", -12, -9.4},
    {"ledges 0.2, 0.39, 0.41, 0.6, 1.2 m", 1, -8.5},
    {"pyramid", -0.5, -12.6},
    {"thin walls", 13, -9.2},
    {"passages 0.8 and 0.72 m", 21, -10.5},
    {"kerb 0.3 m", 27, -8.5},
    {"lift, tower 3 m", -24.5, 27.2},
    {"turntable", -13, 21.6},
    {"shuttle", -12.5, 32.8},
    {"press", -3, 21.8},
    {"pool, beach", 7, 23.2},
    {"conveyor", 17, 25.6},
    {"crawl space 1.3 m", 16.5, 31.4},
    {"wall-jump shaft", 23.8, 30.6},
};

void level_playground(struct level *level)
{
    *level = (struct level){
        .name = memory_text("playground"), .labels = labels, .label_count = sizeof labels / sizeof *labels};
    add_ground(level);
    add_border(level);
    add_stairs(level);
    add_ramps(level);
    add_gaps(level);
    add_walls(level);
    add_creases(level);
    add_pillars(level);
    add_ceilings(level);
    add_gutter(level);
    add_ledges(level);
    add_thin_walls(level);
    rides_add(level);
}
