/* SPDX-License-Identifier: MIT
 * truth_slides.c: reads the stored slides. */
#include "truth_file.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_KNOTS = 8192 };

static truth_body bodies[TRUTH_MAX_BODIES];
static score_body judged[TRUTH_MAX_BODIES];
static tahr_body_desc descs[TRUTH_MAX_BODIES];
static score_knot knots[MAX_KNOTS];

static void refuse(const char *what, const char *line)
{
    fprintf(stderr, "truth: slides.txt: %s: \"%.60s\"\n", what, line);
    abort();
}

static void read_body_of(truth_slide *slide, char *line)
{
    uint32_t count = slide->scene.body_count;

    if (count == TRUTH_MAX_BODIES) {
        refuse("too many bodies", line);
    }
    truth_read_body(line[0], line + 1, &bodies[count]);
    judged[count] = bodies[count].judged;
    descs[count] = bodies[count].desc;
    slide->scene.body_count = count + 1;
}

static void read_path(truth_slide *slide, char *text)
{
    slide->shape.type = (uint32_t)truth_number(&text);
    slide->shape.radius = truth_number(&text);
    slide->shape.half_height = truth_number(&text);
    slide->shape.half_x = truth_number(&text);
    slide->shape.half_y = truth_number(&text);
    slide->up = truth_vec(&text);
    slide->wish = truth_vec(&text);
    slide->margin = truth_number(&text);
    slide->duration = truth_number(&text);
    slide->curved = (int)truth_number(&text);
    truth_number(&text); /* by how much the two methods differ: for readers of the file */
    slide->first_order = truth_number(&text);
    slide->path.count = 0;
}

static void read_knot(truth_slide *slide, char *text)
{
    score_knot *k = &knots[slide->path.count];

    if (slide->path.count == MAX_KNOTS) {
        refuse("too many knots", text);
    }
    k->time = truth_number(&text);
    k->position = truth_vec(&text);
    k->velocity = truth_vec(&text);
    slide->path.count++;
}

static int finish(truth_slide *slide, truth_slide_fn each, void *user)
{
    if (slide->path.count == 0) {
        return 0;
    }
    slide->position = knots[0].position;
    each(user, slide);
    slide->path.count = 0;
    return 1;
}

int truth_each_slide(truth_slide_fn each, void *user)
{
    static char line[65536];
    truth_slide slide = {.descs = descs, .scene = {judged, 0}, .path = {knots, 0}};
    FILE *file = truth_open("slides");
    int slides = 0;

    while (fgets(line, sizeof line, file)) {
        char kind = line[0];
        if (kind == 'w' || kind == 'p') {
            slides += finish(&slide, each, user);
        }
        if (kind == 'w') {
            slide.scene.body_count = 0;
            line[strcspn(line, "\n")] = 0;
            snprintf(slide.name, sizeof slide.name, "%.31s", line + 2);
        } else if (kind == 'm' || kind == 's' || kind == 'b') {
            read_body_of(&slide, line);
        } else if (kind == 'p') {
            read_path(&slide, line + 1);
        } else if (kind == 'k') {
            read_knot(&slide, line + 1);
        } else if (kind != '#') {
            refuse("a line that begins with none of w, m, s, b, p, k and #", line);
        }
    }
    fclose(file);
    return slides + finish(&slide, each, user);
}
