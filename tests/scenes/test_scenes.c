/* SPDX-License-Identifier: MIT
 * test_scenes.c: every scene on every backend at every rate, as a table; of each the first violated expectation.
 *
 * Arguments narrow it down: test_scenes [scene [backend [rate]]], for example "test_scenes wall native 60". */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene_check.h"
#include "scene_list.h"

typedef struct filter {
    const char *scene, *backend;
    double rate;
} filter;

typedef struct tally {
    int runs, failures;
} tally;

/* Above 100 Hz only native runs every variant of a file, unless the rate is asked for by name. */
static int left_out(const scene_backend *backend, double rate, int variant, const filter *only)
{
    return variant > 0 && only->rate <= 0 && !backend->native && rate > 100;
}

static void run_scene(scene *s, int variant, const filter *only, tally *total)
{
    char failures[64][300];
    int failed = 0;
    printf("%-28s", s->name);
    int spatial = SCENE_BACKEND_COUNT, all = spatial + (s->planar ? SCENE_PLANAR_BACKEND_COUNT : 0);
    for (int b = 0; b < all; b++) {
        const scene_backend *backend = b < spatial ? &SCENE_BACKENDS[b] : &SCENE_PLANAR_BACKENDS[b - spatial];
        if (only->backend && strcmp(only->backend, backend->name) != 0) {
            continue;
        }
        printf("  %s", backend->name);
        for (int i = 0; i < s->rate_count; i++) {
            char failure[256];
            if (only->rate > 0 && only->rate != s->rates[i]) {
                continue;
            }
            if (left_out(backend, s->rates[i], variant, only)) {
                printf(" -");
                continue;
            }
            total->runs++;
            if (scene_check(s, backend, s->rates[i], failure)) {
                printf(" ok");
                continue;
            }
            printf(" %g!", s->rates[i]);
            if (failed < 64) {
                snprintf(failures[failed++], sizeof failures[0], "%s %g Hz: %.255s", backend->name, s->rates[i],
                         failure);
            }
            total->failures++;
        }
    }
    printf("\n");
    for (int i = 0; i < failed; i++) {
        printf("    %s\n", failures[i]);
    }
    fflush(stdout);
}

static void run_file(const char *path, const filter *only, tally *total)
{
    static scene s; /* large: 32 bodies and 64 inputs */
    char error[256] = "";
    int count = scene_count(path, error);
    if (count < 0) {
        printf("%s\n", error);
        total->failures++;
    }
    for (int variant = 0; variant < count; variant++) {
        if (scene_read(&s, path, variant)) {
            run_scene(&s, variant, only, total);
        } else {
            printf("%-28s  unreadable: %s\n", s.name, s.error);
            total->failures++;
        }
        scene_free(&s);
    }
}

int main(int argc, char **argv)
{
    char *files[SCENE_MAX_FILES];
    filter only = {argc > 1 ? argv[1] : NULL, argc > 2 ? argv[2] : NULL, argc > 3 ? atof(argv[3]) : 0};
    tally total = {0, 0};
    int count = scene_list(files);
    for (int i = 0; i < count; i++) {
        if (!only.scene || scene_list_is(files[i], only.scene)) {
            run_file(files[i], &only, &total);
        }
        free(files[i]);
    }
    printf("%d runs, %d failures\n", total.runs, total.failures);
    return total.failures > 0 || total.runs == 0;
}
