/* SPDX-License-Identifier: MIT
 * relief.c: a level from straight above, as pixels: the topmost surface, shaded, with walls and drops drawn as
 * lines. */
#include "relief.h"

#include "say.h"
#include "vec.h"

#include <stdlib.h>

/* Steeper than about 84 degrees: has no area from above and is drawn as lines. */
#define WALL_COSINE 0.1

/* Light from the north-west, at 45 degrees, as on printed maps. */
static const tahr_vec3 light = {-0.5, 0.5, 0.7071067811865476};

struct sample {
    float z;
    float normal_z; /* of the unit normal, >= 0 */
    float shade;
    float ink;  /* height of a wall edge drawn here */
    int closed; /* an earlier pass has drawn here */
};

struct canvas {
    const struct relief *relief;
    struct sample *samples;
};

#define NOTHING (-HUGE_VALF)

static tahr_vec3 to_pixels(const struct relief *relief, tahr_vec3 p)
{
    return (tahr_vec3){(p.x - relief->left) * relief->scale, (relief->top - p.y) * relief->scale, p.z};
}

static void put_surface(const struct canvas *canvas, int x, int y, double z, tahr_vec3 normal)
{
    struct sample *sample = &canvas->samples[(size_t)y * (size_t)canvas->relief->width + (size_t)x];
    if (z > (double)sample->z && !sample->closed) {
        sample->z = (float)z;
        sample->normal_z = (float)normal.z;
        sample->shade = (float)vec_dot(normal, light);
    }
}

static void fill_triangle(const struct canvas *canvas, const tahr_vec3 p[3], tahr_vec3 normal)
{
    double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
    if (area == 0) {
        return;
    }
    int x0 = (int)most(0, floor(least(least(p[0].x, p[1].x), p[2].x)));
    int x1 = (int)least(canvas->relief->width - 1, ceil(most(most(p[0].x, p[1].x), p[2].x)));
    int y0 = (int)most(0, floor(least(least(p[0].y, p[1].y), p[2].y)));
    int y1 = (int)least(canvas->relief->height - 1, ceil(most(most(p[0].y, p[1].y), p[2].y)));
    for (int y = y0; y <= y1; y++) {
        for (int x = x0; x <= x1; x++) {
            double cx = x + 0.5, cy = y + 0.5;
            double u = ((p[1].x - cx) * (p[2].y - cy) - (p[1].y - cy) * (p[2].x - cx)) / area;
            double v = ((p[2].x - cx) * (p[0].y - cy) - (p[2].y - cy) * (p[0].x - cx)) / area;
            double w = 1 - u - v;
            if (u >= -1e-9 && v >= -1e-9 && w >= -1e-9) {
                put_surface(canvas, x, y, u * p[0].z + v * p[1].z + w * p[2].z, normal);
            }
        }
    }
}

static void draw_edge(const struct canvas *canvas, tahr_vec3 a, tahr_vec3 b)
{
    double length = most(fabs(b.x - a.x), fabs(b.y - a.y));
    int steps = (int)clamp(ceil(length), 1, 100000);
    for (int i = 0; i <= steps; i++) {
        tahr_vec3 p = vec_add(a, vec_scale(vec_sub(b, a), (double)i / steps));
        int x = (int)floor(p.x), y = (int)floor(p.y);
        if (x >= 0 && y >= 0 && x < canvas->relief->width && y < canvas->relief->height) {
            struct sample *sample = &canvas->samples[(size_t)y * (size_t)canvas->relief->width + (size_t)x];
            sample->ink = (float)most((double)sample->ink, p.z);
        }
    }
}

/* One pass draws the faces that look up by their winding, as rooms are modelled whose ceilings should not hide their
 * floors; the other pass, into what is still empty, those that do not. */
static void draw_triangle(const struct canvas *canvas, const tahr_vec3 corners[3], int looks_up)
{
    tahr_vec3 normal = vec_cross(vec_sub(corners[1], corners[0]), vec_sub(corners[2], corners[0])), p[3];
    double length = vec_length(normal);
    if (length == 0 || (fabs(normal.z) >= WALL_COSINE * length && (normal.z > 0) != looks_up)) {
        return;
    }
    normal = vec_scale(normal, (normal.z < 0 ? -1 : 1) / length);
    for (int k = 0; k < 3; k++) {
        p[k] = to_pixels(canvas->relief, corners[k]);
    }
    if (normal.z >= WALL_COSINE) {
        fill_triangle(canvas, p, normal);
        return;
    }
    for (int k = 0; k < 3; k++) {
        draw_edge(canvas, p[k], p[(k + 1) % 3]);
    }
}

/* Spheres along the axis; more than 8 per radius would not be told apart. */
static void draw_round(const struct canvas *canvas, const struct level_round *round)
{
    const struct relief *relief = canvas->relief;
    int count = 1 + (int)clamp(8 * vec_length(vec_sub(round->b, round->a)) / round->radius, 0, 1000);
    double reach = round->radius * relief->scale;
    for (int i = 0; i < count; i++) {
        double t = count > 1 ? (double)i / (count - 1) : 0;
        tahr_vec3 c = to_pixels(relief, vec_add(round->a, vec_scale(vec_sub(round->b, round->a), t)));
        for (int y = (int)most(0, c.y - reach); y < relief->height && y <= c.y + reach; y++) {
            for (int x = (int)most(0, c.x - reach); x < relief->width && x <= c.x + reach; x++) {
                double dx = (x + 0.5 - c.x) / reach, dy = (c.y - y - 0.5) / reach, rest = 1 - dx * dx - dy * dy;
                if (rest > 0) {
                    put_surface(canvas, x, y, c.z + round->radius * sqrt(rest), (tahr_vec3){dx, dy, sqrt(rest)});
                }
            }
        }
    }
}

static uint32_t mix(const double low[3], const double high[3], double t, double factor)
{
    uint32_t colour = 0;
    for (int k = 0; k < 3; k++) {
        double channel = clamp((low[k] + (high[k] - low[k]) * t) * factor, 0, 255);
        colour = colour << 8 | (uint32_t)(channel + 0.5);
    }
    return colour;
}

/* How much lower the lowest neighbour is: a drop is drawn as a line on its upper side. */
static double drop_at(const struct canvas *canvas, int x, int y)
{
    const struct relief *relief = canvas->relief;
    const struct sample *here = &canvas->samples[(size_t)y * (size_t)relief->width + (size_t)x];
    double drop = 0;
    for (int k = 0; k < 4; k++) {
        int nx = x + (k == 0) - (k == 1), ny = y + (k == 2) - (k == 3);
        if (nx >= 0 && ny >= 0 && nx < relief->width && ny < relief->height) {
            const struct sample *there = &canvas->samples[(size_t)ny * (size_t)relief->width + (size_t)nx];
            drop = most(drop, (double)here->z - (double)there->z);
        }
    }
    return drop;
}

static uint32_t colour_at(const struct canvas *canvas, int x, int y, double low, double high)
{
    static const double floor_low[3] = {216, 227, 237}, floor_high[3] = {253, 238, 205};
    static const double steep_low[3] = {112, 120, 134}, steep_high[3] = {150, 146, 138};
    const struct sample *sample = &canvas->samples[(size_t)y * (size_t)canvas->relief->width + (size_t)x];
    double t = high > low ? clamp(((double)sample->z - low) / (high - low), 0, 1) : 0;
    double shade = 0.72 + 0.4 * (double)sample->shade;
    if (sample->ink > NOTHING && sample->ink >= sample->z - 0.02f) {
        return 0x3a4252;
    }
    if (sample->z == NOTHING) {
        return 0xffffff;
    }
    double drop = drop_at(canvas, x, y) - 2 / canvas->relief->scale; /* a slope of 63 degrees is no drop */
    if (drop > 0.03) {
        shade *= clamp(0.8 - 0.4 * drop, 0.35, 1);
    }
    if ((double)sample->normal_z >= canvas->relief->walkable_cosine) {
        return mix(floor_low, floor_high, t, shade);
    }
    return mix(steep_low, steep_high, t, shade);
}

/* Heights that the tint runs over: those of the walkable ground that is seen. */
static void tint_range(const struct canvas *canvas, size_t count, double *low, double *high)
{
    *low = HUGE_VAL;
    *high = -HUGE_VAL;
    for (size_t i = 0; i < count; i++) {
        const struct sample *sample = &canvas->samples[i];
        if (sample->z > NOTHING && (double)sample->normal_z >= canvas->relief->walkable_cosine) {
            *low = least(*low, (double)sample->z);
            *high = most(*high, (double)sample->z);
        }
    }
}

void relief_draw(struct relief *relief, const struct level *level)
{
    size_t count = (size_t)relief->width * (size_t)relief->height;
    struct canvas canvas = {relief, memory_new(count, sizeof *canvas.samples)};
    for (size_t i = 0; i < count; i++) {
        canvas.samples[i] = (struct sample){NOTHING, 0, 0, NOTHING, 0};
    }
    for (size_t i = 0; i < level->round_count; i++) {
        draw_round(&canvas, &level->rounds[i]);
    }
    for (int looks_up = 1; looks_up >= 0; looks_up--) {
        for (size_t i = 0; i < level->triangle_count; i++) {
            draw_triangle(&canvas, &level->corners[3 * i], looks_up);
        }
        for (size_t i = 0; i < count; i++) {
            canvas.samples[i].closed = canvas.samples[i].z > NOTHING;
        }
    }
    double low, high;
    tint_range(&canvas, count, &low, &high);
    relief->pixels = memory_new(count, sizeof *relief->pixels);
    for (int y = 0; y < relief->height; y++) {
        for (int x = 0; x < relief->width; x++) {
            relief->pixels[(size_t)y * (size_t)relief->width + (size_t)x] = colour_at(&canvas, x, y, low, high);
        }
    }
    free(canvas.samples);
}
