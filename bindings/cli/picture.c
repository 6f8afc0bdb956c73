/* SPDX-License-Identifier: MIT
 * picture.c: what was done in a picture: paths coloured by mode, and marks where something happened. */
#include "picture.h"

#include <math.h>

#define MAX_MARKS_DRAWN 20000

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

static const struct kind kinds[] = {
    {TAHR_EVENT_STEPPED_UP, SHAPE_DOT, 1.7, {0.10, 0.12, 0.16}, "step up"},
    {TAHR_EVENT_LANDED, SHAPE_DOWN, 3.4, {1, 1, 1}, "landing"},
    {TAHR_EVENT_JUMPED, SHAPE_UP, 3.9, {1, 0.85, 0.2}, "jump"},
    {TAHR_EVENT_WALL_JUMPED, SHAPE_UP, 4.4, {0.95, 0.45, 0.1}, "wall jump"},
    {TRACK_DROPPED, SHAPE_DOWN, 4.4, {0.55, 0.33, 0.10}, "drop through"},
    {TAHR_EVENT_GRABBED, SHAPE_SQUARE, 3.6, {0.75, 0.08, 0.24}, "hangs on an edge"},
    {TAHR_EVENT_BASE, SHAPE_SQUARE, 3.0, {0.35, 0.75, 0.35}, "another base"},
    {TAHR_EVENT_SHAPE, SHAPE_DOT, 2.6, {0.62, 0.62, 0.70}, "another height"},
    {TAHR_EVENT_LAUNCHED, SHAPE_UP, 4.6, {0.60, 0.22, 0.58}, "launched"},
    {TAHR_EVENT_CRUSHED, SHAPE_CROSS, 4, {0.4, 0.0, 0.4}, "crushed"},
    {TRACK_FELL_OUT, SHAPE_CROSS, 5, {0.8, 0.05, 0.1}, "fell out"},
    {TRACK_STUCK, SHAPE_RING, 6, {0.8, 0.05, 0.1}, "stuck, or hung in the air"},
    {TRACK_TUNNEL, SHAPE_RING, 9, {0.9, 0, 0.6}, "tunnelled"},
};

#define KIND_COUNT (sizeof kinds / sizeof *kinds)

const struct kind *picture_kind(size_t index)
{
    return index < KIND_COUNT ? &kinds[index] : NULL;
}

void picture_symbol(cairo_t *cairo, const struct kind *kind, double x, double y, double size)
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

void picture_style(const struct picture *picture, uint32_t mode)
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
    const int side = picture->plot->level->side != NULL;
    uint32_t mode = TAHR_MODE_NONE;
    for (size_t i = 0; i < path->count; i++) {
        const struct track_point *p = &path->points[i];
        int map = axes != &picture->profile;
        double x = axes_x(axes, (double)(map ? p->x : p->time));
        double y = axes_y(axes, (double)(map || side ? p->y : p->z));
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
            picture_style(picture, mode == TAHR_MODE_NONE ? own : mode);
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
    const int side = picture->plot->level->side != NULL;
    for (size_t k = 0; k < KIND_COUNT; k++) {
        for (size_t i = 0; i < track->mark_count && drawn < MAX_MARKS_DRAWN; i++) {
            const struct track_mark *mark = &track->marks[i];
            if (mark->type != kinds[k].type || mark->character >= picture->path_count) {
                continue;
            }
            int map = axes != &picture->profile;
            picture_symbol(picture->cairo, &kinds[k], axes_x(axes, (double)(map ? mark->x : mark->time)),
                           axes_y(axes, (double)(map || side ? mark->y : mark->z)), kinds[k].size * factor);
            drawn++;
        }
    }
}

/* Where a character began. */
static void draw_start(const struct picture *picture, const struct axes *axes, uint32_t character)
{
    const struct track_path *path = &picture->plot->track->paths[character];
    if (path->count > 0 && axes != &picture->profile) {
        picture_style(picture, TAHR_MODE_WALKING);
        cairo_arc(picture->cairo, axes_x(axes, (double)path->points[0].x), axes_y(axes, (double)path->points[0].y),
                  picture->path_count > 40 ? 2 : 4, 0, 6.283185307179586);
        cairo_fill_preserve(picture->cairo);
        cairo_set_source_rgb(picture->cairo, 1, 1, 1);
        cairo_set_line_width(picture->cairo, 1);
        cairo_stroke(picture->cairo);
    }
}

void picture_data(const struct picture *picture, const struct axes *axes)
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
