/* SPDX-License-Identifier: MIT
 * plot.c: a picture of a run: the level from above with the paths on it, and the heights below. */
#include "plot.h"

#include "axes.h"
#include "relief.h"
#include "say.h"
#include "vec.h"

#include <cairo-svg.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Points of the picture. */
#define MAP_WIDTH 1120.0
#define MAP_HEIGHT 860.0
#define MARGIN_LEFT 78.0
#define MARGIN_TOP 76.0
#define LEGEND_WIDTH 200.0
#define PROFILE_HEIGHT 190.0
#define PROFILE_GAP 62.0
#define MARGIN_BOTTOM 52.0
#define MIN_MAP_WIDTH 620.0

#define RELIEF_PIXELS 2.0 /* per point */
#define PNG_PIXELS 2.0    /* per point */
#define MAX_PATHS 256     /* more are a carpet */
#define MAX_MARKS_DRAWN 20000

struct picture {
    const struct plot *plot;
    cairo_t *cairo;
    struct axes map, profile;
    double width, height;
    uint32_t path_count; /* drawn */
};

/* One colour per mode; they stay apart on the light ground of the map, also for most colour-blind people. */
static const struct mode_style {
    double colour[3];
    int dashed;
} styles[TAHR_MODE_CUSTOM + 1] = {
    [TAHR_MODE_NONE] = {{0.45, 0.45, 0.45}, 0},    [TAHR_MODE_WALKING] = {{0.12, 0.37, 0.75}, 0},
    [TAHR_MODE_FALLING] = {{0.84, 0.33, 0.00}, 1}, [TAHR_MODE_SWIMMING] = {{0.00, 0.58, 0.55}, 0},
    [TAHR_MODE_FLYING] = {{0.60, 0.22, 0.58}, 0},  [TAHR_MODE_HANGING] = {{0.75, 0.08, 0.24}, 0},
    [TAHR_MODE_CUSTOM] = {{0.42, 0.35, 0.04}, 0},
};

enum { SHAPE_UP, SHAPE_DOWN, SHAPE_DOT, SHAPE_SQUARE, SHAPE_CROSS, SHAPE_RING };

/* Later kinds are drawn over earlier ones. */
static const struct kind {
    uint32_t type;
    int shape;
    double size; /* points */
    double colour[3];
    const char *name;
} kinds[] = {
    {TAHR_EVENT_STEPPED_UP, SHAPE_DOT, 1.7, {0.10, 0.12, 0.16}, "step up"},
    {TAHR_EVENT_LANDED, SHAPE_DOWN, 3.4, {1, 1, 1}, "landing"},
    {TAHR_EVENT_JUMPED, SHAPE_UP, 3.9, {1, 0.85, 0.2}, "jump"},
    {TAHR_EVENT_WALL_JUMPED, SHAPE_UP, 4.4, {0.95, 0.45, 0.1}, "wall jump"},
    {TAHR_EVENT_GRABBED, SHAPE_SQUARE, 3.6, {0.75, 0.08, 0.24}, "hangs on an edge"},
    {TAHR_EVENT_BASE, SHAPE_SQUARE, 3.0, {0.35, 0.75, 0.35}, "another base"},
    {TAHR_EVENT_SHAPE, SHAPE_DOT, 2.6, {0.62, 0.62, 0.70}, "another height"},
    {TAHR_EVENT_LAUNCHED, SHAPE_UP, 4.6, {0.60, 0.22, 0.58}, "launched"},
    {TAHR_EVENT_CRUSHED, SHAPE_CROSS, 4, {0.4, 0.0, 0.4}, "crushed"},
    {TRACK_FELL_OUT, SHAPE_CROSS, 5, {0.8, 0.05, 0.1}, "fell out"},
    {TRACK_STUCK, SHAPE_RING, 6, {0.8, 0.05, 0.1}, "stuck for good"},
    {TRACK_TUNNEL, SHAPE_RING, 9, {0.9, 0, 0.6}, "tunnelled"},
};

#define KIND_COUNT (sizeof kinds / sizeof *kinds)

static void draw_symbol(cairo_t *cairo, const struct kind *kind, double x, double y, double size)
{
    double up = kind->shape == SHAPE_UP ? -1 : 1;
    cairo_set_line_width(cairo, kind->shape == SHAPE_CROSS || kind->shape == SHAPE_RING ? 1.8 : 0.8);
    cairo_new_path(cairo);
    if (kind->shape == SHAPE_CROSS) {
        cairo_move_to(cairo, x - size, y - size);
        cairo_line_to(cairo, x + size, y + size);
        cairo_move_to(cairo, x + size, y - size);
        cairo_line_to(cairo, x - size, y + size);
    } else if (kind->shape == SHAPE_UP || kind->shape == SHAPE_DOWN) {
        cairo_move_to(cairo, x, y + up * size);
        cairo_line_to(cairo, x - size, y - up * size * 0.7);
        cairo_line_to(cairo, x + size, y - up * size * 0.7);
        cairo_close_path(cairo);
    } else if (kind->shape == SHAPE_SQUARE) {
        cairo_rectangle(cairo, x - size * 0.85, y - size * 0.85, size * 1.7, size * 1.7);
    } else {
        cairo_arc(cairo, x, y, size, 0, 6.283185307179586);
    }
    cairo_set_source_rgb(cairo, kind->colour[0], kind->colour[1], kind->colour[2]);
    if (kind->shape == SHAPE_CROSS || kind->shape == SHAPE_RING) {
        cairo_stroke(cairo);
        return;
    }
    cairo_fill_preserve(cairo);
    cairo_set_source_rgb(cairo, 0.1, 0.12, 0.16);
    cairo_stroke(cairo);
}

static void set_path_style(const struct picture *picture, uint32_t mode)
{
    static const double dashes[2] = {3.5, 2.5};
    int crowded = picture->path_count > 40;
    const struct mode_style *style = &styles[mode <= TAHR_MODE_CUSTOM ? mode : TAHR_MODE_NONE];
    cairo_set_source_rgba(picture->cairo, style->colour[0], style->colour[1], style->colour[2], crowded ? 0.6 : 0.9);
    cairo_set_line_width(picture->cairo, crowded ? 0.8 : 1.4);
    cairo_set_dash(picture->cairo, dashes, style->dashed ? 2 : 0, 0);
}

/* One path in one of the two diagrams. Points closer than half a point of the picture are left out. */
static void draw_path(const struct picture *picture, const struct axes *axes, uint32_t character)
{
    const struct track_path *path = &picture->plot->track->paths[character];
    double last_x = 0, last_y = 0;
    uint32_t mode = TAHR_MODE_NONE;
    for (size_t i = 0; i < path->count; i++) {
        const struct track_point *p = &path->points[i];
        int map = axes == &picture->map;
        double x = axes_x(axes, (double)(map ? p->x : p->time));
        double y = axes_y(axes, map ? (double)p->y : (double)p->z);
        uint32_t own = p->mode == TAHR_MODE_NONE ? mode : p->mode;
        if (mode == TAHR_MODE_NONE) {
            cairo_move_to(picture->cairo, x, y);
            last_x = x;
            last_y = y;
        } else if (own != mode || p->mode == TAHR_MODE_NONE || i + 1 == path->count ||
                   fabs(x - last_x) + fabs(y - last_y) > 0.5) {
            cairo_line_to(picture->cairo, x, y);
            last_x = x;
            last_y = y;
        }
        if ((own != mode && mode != TAHR_MODE_NONE) || p->mode == TAHR_MODE_NONE || i + 1 == path->count) {
            set_path_style(picture, mode == TAHR_MODE_NONE ? own : mode);
            cairo_stroke(picture->cairo);
            cairo_move_to(picture->cairo, x, y);
        }
        mode = p->mode;
    }
    cairo_new_path(picture->cairo);
    cairo_set_dash(picture->cairo, NULL, 0, 0);
}

static void draw_marks(const struct picture *picture, const struct axes *axes)
{
    const struct track *track = picture->plot->track;
    double factor = picture->path_count > 24 ? 0.6 : 1;
    size_t drawn = 0;
    for (size_t k = 0; k < KIND_COUNT; k++) {
        for (size_t i = 0; i < track->mark_count && drawn < MAX_MARKS_DRAWN; i++) {
            const struct track_mark *mark = &track->marks[i];
            if (mark->type != kinds[k].type || mark->character >= picture->path_count) {
                continue;
            }
            int map = axes == &picture->map;
            draw_symbol(picture->cairo, &kinds[k], axes_x(axes, (double)(map ? mark->x : mark->time)),
                        axes_y(axes, map ? (double)mark->y : (double)mark->z), kinds[k].size * factor);
            drawn++;
        }
    }
}

/* Where a character began. */
static void draw_start(const struct picture *picture, const struct axes *axes, uint32_t character)
{
    const struct track_path *path = &picture->plot->track->paths[character];
    if (path->count > 0 && axes == &picture->map) {
        set_path_style(picture, TAHR_MODE_WALKING);
        cairo_arc(picture->cairo, axes_x(axes, (double)path->points[0].x), axes_y(axes, (double)path->points[0].y),
                  picture->path_count > 40 ? 2 : 4, 0, 6.283185307179586);
        cairo_fill_preserve(picture->cairo);
        cairo_set_source_rgb(picture->cairo, 1, 1, 1);
        cairo_set_line_width(picture->cairo, 1);
        cairo_stroke(picture->cairo);
    }
}

static void draw_data(const struct picture *picture, const struct axes *axes)
{
    cairo_save(picture->cairo);
    cairo_rectangle(picture->cairo, axes->left, axes->top, axes->width, axes->height);
    cairo_clip(picture->cairo);
    cairo_set_line_join(picture->cairo, CAIRO_LINE_JOIN_ROUND);
    for (uint32_t i = 0; i < picture->path_count; i++) {
        draw_path(picture, axes, i);
    }
    draw_marks(picture, axes);
    for (uint32_t i = 0; i < picture->path_count; i++) {
        draw_start(picture, axes, i);
    }
    cairo_restore(picture->cairo);
}

static void draw_relief(const struct picture *picture)
{
    const struct axes *map = &picture->map;
    struct relief relief = {.width = (int)ceil(map->width * RELIEF_PIXELS),
                            .height = (int)ceil(map->height * RELIEF_PIXELS),
                            .scale = map->width * RELIEF_PIXELS / (map->x1 - map->x0),
                            .left = map->x0,
                            .top = map->y1,
                            .walkable_cosine = cos(picture->plot->walkable_angle)};
    relief_draw(&relief, picture->plot->level);
    cairo_surface_t *image = cairo_image_surface_create_for_data((unsigned char *)relief.pixels, CAIRO_FORMAT_RGB24,
                                                                 relief.width, relief.height, relief.width * 4);
    cairo_save(picture->cairo);
    cairo_translate(picture->cairo, map->left, map->top);
    cairo_scale(picture->cairo, 1 / RELIEF_PIXELS, 1 / RELIEF_PIXELS);
    cairo_set_source_surface(picture->cairo, image, 0, 0);
    cairo_paint(picture->cairo);
    cairo_restore(picture->cairo);
    cairo_surface_finish(image);
    cairo_surface_destroy(image);
    free(relief.pixels);
}

/* A box from above; where it is drawn twice, the second time is the other end of its way. */
static void trace_box(const struct picture *picture, const tahr_pose *pose, tahr_vec3 half)
{
    static const double signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (int i = 0; i < 4; i++) {
        tahr_vec3 p = vec_turn(pose->orientation, (tahr_vec3){signs[i][0] * half.x, signs[i][1] * half.y, 0});
        double x = axes_x(&picture->map, pose->position.x + p.x), y = axes_y(&picture->map, pose->position.y + p.y);
        i == 0 ? cairo_move_to(picture->cairo, x, y) : cairo_line_to(picture->cairo, x, y);
    }
    cairo_close_path(picture->cairo);
}

/* Water, and what moves: where it begins, and dashed where it goes to. */
static void draw_rides(const struct picture *picture)
{
    static const double dashes[2] = {4, 3};
    const struct level *level = picture->plot->level;
    cairo_t *cairo = picture->cairo;
    cairo_set_line_width(cairo, 1.2);
    for (size_t i = 0; i < level->pool_count; i++) {
        const tahr_pose pose = {level->pools[i].center, {0, 0, 0, 1}};
        trace_box(picture, &pose, level->pools[i].half_extents);
        cairo_set_source_rgba(cairo, 0.25, 0.60, 0.80, 0.35);
        cairo_fill(cairo);
    }
    for (size_t i = 0; i < level->mover_count; i++) {
        const struct level_mover *mover = &level->movers[i];
        tahr_pose pose = level_mover_pose(mover, 0);
        trace_box(picture, &pose, mover->half_extents);
        cairo_set_source_rgba(cairo, 0.35, 0.75, 0.35, 0.35);
        cairo_fill_preserve(cairo);
        cairo_set_source_rgb(cairo, 0.15, 0.40, 0.15);
        cairo_stroke(cairo);
        cairo_set_dash(cairo, dashes, 2, 0);
        pose.position = vec_add(pose.position, mover->swing);
        trace_box(picture, &pose, mover->half_extents);
        cairo_stroke(cairo);
        cairo_set_dash(cairo, NULL, 0, 0);
    }
}

static void draw_map(const struct picture *picture)
{
    const struct level *level = picture->plot->level;
    draw_relief(picture);
    draw_rides(picture);
    axes_grid(&picture->map);
    draw_data(picture, &picture->map);
    for (size_t i = 0; i < level->label_count; i++) {
        const struct level_label *label = &level->labels[i];
        text_on_map(picture->cairo, axes_x(&picture->map, label->x), axes_y(&picture->map, label->y), 10, label->text);
    }
    axes_frame(&picture->map);
}

static void draw_profile(const struct picture *picture)
{
    axes_grid(&picture->profile);
    draw_data(picture, &picture->profile);
    axes_frame(&picture->profile);
}

static double legend_line(const struct picture *picture, double x, double y, uint32_t mode, const char *text)
{
    set_path_style(picture, mode);
    cairo_set_line_width(picture->cairo, 1.6);
    cairo_move_to(picture->cairo, x, y - 4);
    cairo_rel_line_to(picture->cairo, 26, 0);
    cairo_stroke(picture->cairo);
    cairo_set_dash(picture->cairo, NULL, 0, 0);
    cairo_set_source_rgb(picture->cairo, 0.16, 0.18, 0.22);
    text_at(picture->cairo, x + 34, y, 12, 0, text);
    return y + 20;
}

static double legend_patch(const struct picture *picture, double x, double y, const double colour[3], const char *text)
{
    cairo_rectangle(picture->cairo, x + 4, y - 11, 18, 12);
    cairo_set_source_rgb(picture->cairo, colour[0], colour[1], colour[2]);
    cairo_fill_preserve(picture->cairo);
    cairo_set_source_rgb(picture->cairo, 0.4, 0.42, 0.47);
    cairo_set_line_width(picture->cairo, 0.6);
    cairo_stroke(picture->cairo);
    cairo_set_source_rgb(picture->cairo, 0.16, 0.18, 0.22);
    text_at(picture->cairo, x + 34, y, 12, 0, text);
    return y + 20;
}

static size_t count_marks(const struct track *track, uint32_t type)
{
    size_t count = 0;
    for (size_t i = 0; i < track->mark_count; i++) {
        count += track->marks[i].type == type;
    }
    return count;
}

static int has_mode(const struct track *track, uint32_t mode)
{
    for (uint32_t c = 0; c < track->character_count; c++) {
        for (size_t i = 0; i < track->paths[c].count; i++) {
            if (track->paths[c].points[i].mode == mode) {
                return 1;
            }
        }
    }
    return 0;
}

static void draw_legend(const struct picture *picture)
{
    static const double low[3] = {0.85, 0.89, 0.93}, high[3] = {0.99, 0.93, 0.80}, steep[3] = {0.50, 0.52, 0.55},
                        water[3] = {0.66, 0.81, 0.89}, moving[3] = {0.70, 0.86, 0.70};
    double x = picture->map.left + picture->map.width + 18, y = picture->map.top + 12;
    char text[80];
    for (uint32_t mode = TAHR_MODE_WALKING; mode <= TAHR_MODE_CUSTOM; mode++) {
        if (mode <= TAHR_MODE_FALLING || has_mode(picture->plot->track, mode)) {
            y = legend_line(picture, x, y, mode, tahr_mode_name(mode));
        }
    }
    for (size_t k = 0; k < KIND_COUNT; k++) {
        size_t count = count_marks(picture->plot->track, kinds[k].type);
        if (count > 0) {
            draw_symbol(picture->cairo, &kinds[k], x + 13, y - 4, kinds[k].size);
            snprintf(text, sizeof text, "%s (%zu)", kinds[k].name, count);
            cairo_set_source_rgb(picture->cairo, 0.16, 0.18, 0.22);
            text_at(picture->cairo, x + 34, y, 12, 0, text);
            y += 20;
        }
    }
    y = legend_patch(picture, x, y + 8, low, "walkable, low");
    y = legend_patch(picture, x, y, high, "walkable, high");
    snprintf(text, sizeof text, "steeper than %.0f\302\260", picture->plot->walkable_angle * 57.29577951308232);
    y = legend_patch(picture, x, y, steep, text);
    if (picture->plot->level->pool_count > 0) {
        y = legend_patch(picture, x, y, water, "water");
    }
    if (picture->plot->level->mover_count > 0) {
        y = legend_patch(picture, x, y, moving, "moving (dashed: to)");
    }
    if (picture->path_count < picture->plot->track->character_count) {
        snprintf(text, sizeof text, "first %u of %u drawn", picture->path_count, picture->plot->track->character_count);
        text_at(picture->cairo, x, y + 8, 11, 0, text);
    }
}

static void draw_picture(const struct picture *picture)
{
    cairo_t *cairo = picture->cairo;
    cairo_set_source_rgb(cairo, 1, 1, 1);
    cairo_paint(cairo);
    cairo_set_source_rgb(cairo, 0.1, 0.12, 0.16);
    cairo_select_font_face(cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_BOLD);
    text_at(cairo, picture->map.left, 32, 18, 0, picture->plot->caption);
    cairo_select_font_face(cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    text_at(cairo, picture->map.left, 54, 12, 0,
            "The level from above with the way of every character from its dot on, coloured by mode;"
            " below, the height of the feet over time.");
    draw_map(picture);
    draw_profile(picture);
    draw_legend(picture);
}

/* Heights of the feet; what falls out of the level is cut off below it. */
static void profile_range(const struct plot *plot, double *low, double *high)
{
    double floor_z = plot->level->bounds.min.z - 1, bottom = HUGE_VAL, top = -HUGE_VAL;
    for (uint32_t c = 0; c < plot->track->character_count; c++) {
        for (size_t i = 0; i < plot->track->paths[c].count; i++) {
            double z = (double)plot->track->paths[c].points[i].z;
            bottom = least(bottom, most(z, floor_z));
            top = most(top, z);
        }
    }
    if (!(top >= bottom)) {
        bottom = top = 0;
    }
    double middle = (bottom + top) / 2, half = most((top - bottom) / 2 * 1.08, 0.75);
    *low = middle - half;
    *high = middle + half;
}

static void lay_out(struct picture *picture)
{
    const struct plot *plot = picture->plot;
    const tahr_bounds *b = &plot->level->bounds;
    double pad = 0.02 * most(b->max.x - b->min.x, b->max.y - b->min.y) + 0.1;
    double span_x = b->max.x - b->min.x + 2 * pad, span_y = b->max.y - b->min.y + 2 * pad;
    double scale = least(MAP_WIDTH / span_x, MAP_HEIGHT / span_y);
    double width = most(span_x * scale, MIN_MAP_WIDTH), extra = (width / scale - span_x) / 2;
    picture->map = (struct axes){.left = MARGIN_LEFT,
                                 .top = MARGIN_TOP,
                                 .width = width,
                                 .height = span_y * scale,
                                 .x0 = b->min.x - pad - extra,
                                 .x1 = b->max.x + pad + extra,
                                 .y0 = b->min.y - pad,
                                 .y1 = b->max.y + pad,
                                 .x_name = "x in m",
                                 .y_name = "y in m"};
    picture->profile = picture->map;
    picture->profile.top += picture->map.height + PROFILE_GAP;
    picture->profile.height = PROFILE_HEIGHT;
    picture->profile.x0 = 0;
    picture->profile.x1 = plot->seconds;
    picture->profile.x_name = "time in s";
    picture->profile.y_name = "height in m";
    profile_range(plot, &picture->profile.y0, &picture->profile.y1);
    picture->width = MARGIN_LEFT + width + LEGEND_WIDTH;
    picture->height = picture->profile.top + PROFILE_HEIGHT + MARGIN_BOTTOM;
    picture->path_count = plot->track->character_count < MAX_PATHS ? plot->track->character_count : MAX_PATHS;
}

int plot_write(const struct plot *plot)
{
    struct picture picture = {.plot = plot};
    int svg = strcmp(plot->path + strlen(plot->path) - 4, ".svg") == 0;
    lay_out(&picture);
    cairo_surface_t *surface = svg ? cairo_svg_surface_create(plot->path, picture.width, picture.height)
                                   : cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)(picture.width * PNG_PIXELS),
                                                                (int)(picture.height * PNG_PIXELS));
    picture.cairo = cairo_create(surface);
    picture.map.cairo = picture.profile.cairo = picture.cairo;
    if (!svg) {
        cairo_scale(picture.cairo, PNG_PIXELS, PNG_PIXELS);
    }
    draw_picture(&picture);
    cairo_status_t status = cairo_status(picture.cairo);
    cairo_destroy(picture.cairo);
    if (status == CAIRO_STATUS_SUCCESS && !svg) {
        status = cairo_surface_write_to_png(surface, plot->path);
    }
    cairo_surface_finish(surface); /* an SVG is written here */
    status = status == CAIRO_STATUS_SUCCESS ? cairo_surface_status(surface) : status;
    cairo_surface_destroy(surface);
    if (status != CAIRO_STATUS_SUCCESS) {
        say_error("--plot '%s': %s", plot->path, cairo_status_to_string(status));
        return -1;
    }
    return 0;
}
