/* SPDX-License-Identifier: MIT
 * test_same_everywhere.c: every scene takes the same path on every backend that holds its bodies: each path is compared
 * with that of the native backend, step by step.
 *
 * Arguments narrow it down and show more: test_same_everywhere [scene [backend]]. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene_list.h"
#include "scene_run.h"

static const double RATE = 60;

/* Of the length of the path so far: what slides may differ by; and what a sweep's own error may add to it, times the
 * number of things met, which no scene has more than a hundred of. */
static const double SLIDE = 1e-2, MEETINGS = 100;

typedef struct tally {
    int runs, failures, left_out;
    double worst; /* of what is allowed */
    char worst_name[256];
} tally;

static double distance(tahr_vec3 a, tahr_vec3 b)
{
    double x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
    return sqrt(x * x + y * y + z * z);
}

/* The largest deviation as a part of what is allowed there; [out] where. */
static double deviation(const scene_record *r, const scene_record *reference, const scene_backend *backend, int *where)
{
    double length = 0, worst = 0;
    *where = 0;
    for (int i = 0; i < r->count && i < reference->count; i++) {
        const tahr_vec3 *at = &reference->samples[i].state.position;
        length += i > 0 ? distance(*at, reference->samples[i - 1].state.position) : 0;
        double allowed = SLIDE * length + MEETINGS * backend->gap_error;
        double part = distance(*at, r->samples[i].state.position) / allowed;
        if (!(part <= worst)) {
            worst = part;
            *where = i;
        }
    }
    return r->count == reference->count ? worst : HUGE_VAL;
}

static void compare(scene *s, const scene_backend *backend, const scene_record *reference, tally *total)
{
    static const tahr_pose here = {{0, 0, 0}, {0, 0, 0, 1}};
    scene_record r = {0};
    int where;
    if (!scene_run(s, backend, RATE, &here, &r)) {
        int lacks = strstr(r.error, "opening the world: unsupported") != NULL;
        total->left_out += lacks;
        total->failures += !lacks;
        if (!lacks) {
            printf("%s on %s: %s\n", s->name, backend->name, r.error);
        }
        scene_record_free(&r);
        return;
    }
    double part = deviation(&r, reference, backend, &where);
    total->runs++;
    if (part > total->worst) {
        total->worst = part;
        snprintf(total->worst_name, sizeof total->worst_name, "%.120s on %s", s->name, backend->name);
    }
    if (!(part <= 1)) {
        const tahr_vec3 *a = &reference->samples[where].state.position, *b = &r.samples[where].state.position;
        printf("%s on %s: %.3g times what may differ at t=%.4g: (%.9g, %.9g, %.9g) instead of (%.9g, %.9g, %.9g)\n",
               s->name, backend->name, part, r.samples[where].time, b->x, b->y, b->z, a->x, a->y, a->z);
        total->failures++;
    }
    scene_record_free(&r);
}

static const scene_backend *reference_backend(void)
{
    for (int i = 0; i < SCENE_BACKEND_COUNT; i++) {
        if (SCENE_BACKENDS[i].native) {
            return &SCENE_BACKENDS[i];
        }
    }
    return NULL;
}

static void run_scene(scene *s, const char *only, tally *total)
{
    static const tahr_pose here = {{0, 0, 0}, {0, 0, 0, 1}};
    scene_record reference = {0};
    if (!scene_run(s, reference_backend(), RATE, &here, &reference)) {
        printf("%s: %s\n", s->name, reference.error);
        total->failures++;
    }
    int spatial = SCENE_BACKEND_COUNT, all = spatial + (s->planar ? SCENE_PLANAR_BACKEND_COUNT : 0);
    for (int i = 0; i < all && reference.error[0] == 0; i++) {
        const scene_backend *b = i < spatial ? &SCENE_BACKENDS[i] : &SCENE_PLANAR_BACKENDS[i - spatial];
        if (b != reference_backend() && (!only || strcmp(only, b->name) == 0)) {
            compare(s, b, &reference, total);
        }
    }
    scene_record_free(&reference);
}

static void run_file(const char *path, const char *only, tally *total)
{
    static scene s; /* large: 32 bodies and 64 inputs */
    char error[256] = "";
    int count = scene_count(path, error);
    for (int variant = 0; variant < count; variant++) {
        if (scene_read(&s, path, variant)) {
            run_scene(&s, only, total);
        } else {
            printf("%s: unreadable: %s\n", s.name, s.error);
            total->failures++;
        }
        scene_free(&s);
    }
    total->failures += count < 0;
}

int main(int argc, char **argv)
{
    char *files[SCENE_MAX_FILES];
    tally total = {0};
    int count = scene_list(files);
    for (int i = 0; i < count; i++) {
        if (argc < 2 || scene_list_is(files[i], argv[1])) {
            run_file(files[i], argc > 2 ? argv[2] : NULL, &total);
        }
        free(files[i]);
    }
    printf("%d runs, %d failures, %d left out because the backend does not hold the bodies; largest deviation: %.3g of "
           "what may differ (%s)\n",
           total.runs, total.failures, total.left_out, total.worst, total.worst_name);
    return total.failures > 0 || total.runs == 0;
}
