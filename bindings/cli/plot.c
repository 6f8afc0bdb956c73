/* SPDX-License-Identifier: MIT
 * plot.c: a picture of a run: the level from above or from the side with the paths on it, and the heights below. */
#include "plot.h"

#include "axes.h"
#include "picture.h"
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
#define MAX_SIDE_SCALE 48.0 /* per m, of a level from the side */

#define RELIEF_PIXELS 2.0 /* per point */
#define PNG_PIXELS 2.0    /* per point */
#define MAX_PATHS 256     /* more are a carpet */

static void draw_relief(const struct picture *picture)
{
    const struct axes *map = &picture->maps[0];
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
    const struct axes *map = &picture->maps[0];
    static const double signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (int i = 0; i < 4; i++) {
        tahr_vec3 p = vec_turn(pose->orientation, (tahr_vec3){signs[i][0] * half.x, signs[i][1] * half.y, 0});
        double x = axes_x(map, pose->position.x + p.x), y = axes_y(map, pose->position.y + p.y);
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

static void draw_labels(const struct picture *picture, const struct axes *map)
{
    const struct level *level = picture->plot->level;
    for (size_t i = 0; i < level->label_count; i++) {
        const struct level_label *label = &level->labels[i];
        text_on_map(picture->cairo, axes_x(map, label->x), axes_y(map, label->y), 10, label->text);
    }
}

static void draw_map(const struct picture *picture, const struct axes *map)
{
    if (picture->plot->level->side != NULL) {
        picture_side(picture, map);
        picture_data(picture, map);
        picture_side_labels(picture, map);
    } else {
        draw_relief(picture);
        draw_rides(picture);
        axes_grid(map);
        picture_data(picture, map);
        draw_labels(picture, map);
    }
    axes_frame(map);
}

static void draw_profile(const struct picture *picture)
{
    axes_grid(&picture->profile);
    picture_data(picture, &picture->profile);
    axes_frame(&picture->profile);
}

static double legend_line(const struct picture *picture, double x, double y, uint32_t mode, const char *text)
{
    picture_style(picture, mode);
    cairo_set_line_width(picture->cairo, 1.6);
    cairo_move_to(picture->cairo, x, y - 4);
    cairo_rel_line_to(picture->cairo, 26, 0);
    cairo_stroke(picture->cairo);
    cairo_set_dash(picture->cairo, NULL, 0, 0);
    cairo_set_source_rgb(picture->cairo, 0.16, 0.18, 0.22);
    text_at(picture->cairo, x + 34, y, 12, 0, text);
    return y + 20;
}

double picture_patch(const struct picture *picture, double x, double y, const double colour[3], const char *text)
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

static double relief_legend(const struct picture *picture, double x, double y)
{
    static const double low[3] = {0.85, 0.89, 0.93}, high[3] = {0.99, 0.93, 0.80}, steep[3] = {0.50, 0.52, 0.55},
                        water[3] = {0.66, 0.81, 0.89}, moving[3] = {0.70, 0.86, 0.70};
    char text[80];
    y = picture_patch(picture, x, y, low, "walkable, low");
    y = picture_patch(picture, x, y, high, "walkable, high");
    snprintf(text, sizeof text, "steeper than %.0f\302\260", picture->plot->walkable_angle * 57.29577951308232);
    y = picture_patch(picture, x, y, steep, text);
    if (picture->plot->level->pool_count > 0) {
        y = picture_patch(picture, x, y, water, "water");
    }
    if (picture->plot->level->mover_count > 0) {
        y = picture_patch(picture, x, y, moving, "moving (dashed: to)");
    }
    return y;
}

static void draw_legend(const struct picture *picture)
{
    double x = picture->maps[0].left + picture->maps[0].width + 18, y = picture->maps[0].top + 12;
    char text[80];
    size_t index = 0;
    for (uint32_t mode = TAHR_MODE_WALKING; mode <= TAHR_MODE_CUSTOM; mode++) {
        if (mode <= TAHR_MODE_FALLING || has_mode(picture->plot->track, mode)) {
            y = legend_line(picture, x, y, mode, tahr_mode_name(mode));
        }
    }
    for (const struct kind *kind = picture_kind(0); kind != NULL; kind = picture_kind(++index)) {
        size_t count = count_marks(picture->plot->track, kind->type);
        if (count > 0) {
            picture_symbol(picture->cairo, kind, x + 13, y - 4, kind->size);
            snprintf(text, sizeof text, "%s (%zu)", kind->name, count);
            cairo_set_source_rgb(picture->cairo, 0.16, 0.18, 0.22);
            text_at(picture->cairo, x + 34, y, 12, 0, text);
            y += 20;
        }
    }
    y = picture->plot->level->side != NULL ? picture_side_legend(picture, x, y + 8) : relief_legend(picture, x, y + 8);
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
    text_at(cairo, MARGIN_LEFT, 32, 18, 0, picture->plot->caption);
    cairo_select_font_face(cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    text_at(
        cairo, MARGIN_LEFT, 54, 12, 0,
        picture->plot->level->side != NULL
            ? "The level from the side with the way of the feet of every character from its dot on, coloured by mode;"
              " below, their height over time."
            : "The level from above with the way of every character from its dot on, coloured by mode;"
              " below, the height of the feet over time.");
    for (size_t i = 0; i < picture->strip_count; i++) {
        draw_map(picture, &picture->maps[i]);
    }
    draw_profile(picture);
    draw_legend(picture);
}

/* Heights of the feet; what falls out of the level is cut off below it. */
static void profile_range(const struct plot *plot, double *low, double *high)
{
    double floor_z = level_height(plot->level, plot->level->bounds.min) - 1, bottom = HUGE_VAL, top = -HUGE_VAL;
    for (uint32_t c = 0; c < plot->track->character_count; c++) {
        for (size_t i = 0; i < plot->track->paths[c].count; i++) {
            const struct track_point *p = &plot->track->paths[c].points[i];
            double z = (double)(plot->level->side != NULL ? p->y : p->z);
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

/* The map from above, as large as it fits. Returns its scale. */
static void lay_out_relief(struct picture *picture)
{
    const tahr_bounds *b = &picture->plot->level->bounds;
    double pad = 0.02 * most(b->max.x - b->min.x, b->max.y - b->min.y) + 0.1;
    double span_x = b->max.x - b->min.x + 2 * pad, span_y = b->max.y - b->min.y + 2 * pad;
    double scale = least(MAP_WIDTH / span_x, MAP_HEIGHT / span_y);
    double width = most(span_x * scale, MIN_MAP_WIDTH), extra = (width / scale - span_x) / 2;
    picture->strip_count = 1;
    picture->maps[0] = (struct axes){.left = MARGIN_LEFT,
                                     .top = MARGIN_TOP,
                                     .width = width,
                                     .height = span_y * scale,
                                     .x0 = b->min.x - pad - extra,
                                     .x1 = b->max.x + pad + extra,
                                     .y0 = b->min.y - pad,
                                     .y1 = b->max.y + pad,
                                     .x_name = "x in m",
                                     .y_name = "y in m"};
}

/* The view from the side, in as many strips as make it largest. */
static void lay_out_side(struct picture *picture)
{
    const tahr_bounds *b = &picture->plot->level->bounds;
    const double pad = 1, span_x = b->max.x - b->min.x + 2 * pad, span_y = b->max.y - b->min.y + 2 * pad;
    double best = 0;
    for (size_t n = 1; n <= MAX_STRIPS; n++) {
        double room = MAP_HEIGHT - (double)(n - 1) * PROFILE_GAP;
        double scale = least(least(MAP_WIDTH * (double)n / span_x, room / ((double)n * span_y)), MAX_SIDE_SCALE);
        if (scale > best * 1.02) { /* strips that bring nothing only cut the level */
            best = scale;
            picture->strip_count = n;
        }
    }
    double part = most(span_x / (double)picture->strip_count, MIN_MAP_WIDTH / best);
    for (size_t i = 0; i < picture->strip_count; i++) {
        double x0 = b->min.x - pad + (double)i * part;
        picture->maps[i] = (struct axes){.left = MARGIN_LEFT,
                                         .top = MARGIN_TOP + (double)i * (span_y * best + PROFILE_GAP),
                                         .width = part * best,
                                         .height = span_y * best,
                                         .x0 = x0,
                                         .x1 = x0 + part,
                                         .y0 = b->min.y - pad,
                                         .y1 = b->max.y + pad,
                                         .x_name = "x in m",
                                         .y_name = "y in m"};
    }
}

static void lay_out(struct picture *picture)
{
    const struct plot *plot = picture->plot;
    if (plot->level->side != NULL) {
        lay_out_side(picture);
    } else {
        lay_out_relief(picture);
    }
    picture->profile = picture->maps[picture->strip_count - 1];
    picture->profile.top += picture->profile.height + PROFILE_GAP;
    picture->profile.height = PROFILE_HEIGHT;
    picture->profile.x0 = 0;
    picture->profile.x1 = plot->seconds;
    picture->profile.x_name = "time in s";
    picture->profile.y_name = "height in m";
    profile_range(plot, &picture->profile.y0, &picture->profile.y1);
    picture->width = MARGIN_LEFT + picture->profile.width + LEGEND_WIDTH;
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
    picture.profile.cairo = picture.cairo;
    for (size_t i = 0; i < picture.strip_count; i++) {
        picture.maps[i].cairo = picture.cairo;
    }
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
