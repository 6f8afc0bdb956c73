/* SPDX-License-Identifier: MIT
 * test_slide_truth.c: whole movement against the stored slides (truth/slides.txt).
 *
 * The model of the reference: the character wants to go along one velocity all the time; the part of it that leads into
 * what it touches is lost, all touched surfaces taken together; nothing else acts. So Tahr flies, without gravity, drag
 * and steps, and every step begins with that velocity (TAHR_INPUT_DRIVE). Its skin is the distance that the reference
 * keeps. What a step cannot know is where within it an edge bends the way: a chord of length h along a circle of radius
 * R is off by h^2 / 2 R, so on curved parts the error falls with dt, and is asked for at the rates at which it can be
 * met; on polygons it does not depend on dt at all. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>
#include <tahr/native.h>
#include <tahr/tahr.h>
#ifdef TAHR_HAVE_CCD
#include <tahr/ccd.h>
#endif
#ifdef TAHR_HAVE_FCL
#include <tahr/fcl.h>
#endif

#include "truth_file.h"

enum { MAX_COMPLAINTS = 12 };

typedef struct subject {
    const char *name;
    const tahr_backend *backend;
    const void *options;
    double gap;       /* m, of a sweep: what a path over a polygon may be off for each of its bends */
    double of_path;   /* end error, of the length of the path */
    double clearance; /* m below the skin */
} subject;

typedef struct trial {
    const subject *subject;
    double dt;
    score_stat flat, curved; /* m: the largest error of each path */
    double worst_end;        /* of the path */
    double least_clearance;  /* m, less the skin */
    double worst_energy, most_queries;
    int complaints, paths;
} trial;

static double length_of(tahr_vec3 v)
{
    return sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

static void config_of(const truth_slide *slide, tahr_config *config)
{
    assert_int_equal(tahr_config_init(config, sizeof *config, TAHR_PRESET_PRECISE), TAHR_OK);
    config->shape = slide->shape;
    config->skin = slide->margin;
    config->step_height = 0;
    config->acceleration = config->turn_friction = config->fly_drag = 0;
    config->crouched_half_height = slide->shape.half_height;
}

static tahr_world *open_world(const subject *who, const truth_slide *slide)
{
    tahr_world_desc desc;
    tahr_world *world = NULL;

    assert_int_equal(tahr_world_desc_init(&desc, sizeof desc), TAHR_OK);
    desc.bodies = slide->descs;
    desc.body_count = slide->scene.body_count;
    desc.options = who->options;
    assert_int_equal(tahr_world_open(who->backend, &desc, &world), TAHR_OK);
    return world;
}

/* One path from start to end. */
static void run(const trial *t, const truth_slide *slide, score_path *path)
{
    const score_path_desc desc = {.reference = &slide->path, .scene = &slide->scene, .reach = 0.1};
    tahr_world *world = open_world(t->subject, slide);
    tahr_mover *mover = NULL;
    tahr_config config;
    tahr_state state;
    tahr_input input = {.struct_size = sizeof input, .flags = TAHR_INPUT_DRIVE, .drive = slide->wish};
    tahr_report report = {.struct_size = sizeof report};
    double full = 0.5 * length_of(slide->wish) * length_of(slide->wish);
    long steps = lround(slide->duration / t->dt);

    config_of(slide, &config);
    assert_int_equal(tahr_mover_create(world, &config, &mover), TAHR_OK);
    assert_int_equal(tahr_state_init(&state, &config, &slide->position), TAHR_OK);
    state.mode = TAHR_MODE_FLYING;
    state.velocity = slide->wish;
    score_step s = score_step_of(&state, &config.shape, 0, TAHR_OK, NULL);
    score_path_start(path, &desc, &s);
    for (long i = 1; i <= steps; i++) {
        double before = 0.5 * length_of(state.velocity) * length_of(state.velocity);
        tahr_status status = tahr_mover_step(mover, &input, t->dt, &state, &report);
        s = score_step_of(&state, &config.shape, (double)i * t->dt, status, &report);
        s.work = full - before; /* the drive begins every step with the whole velocity */
        score_path_add(path, &s);
    }
    tahr_mover_destroy(mover);
    tahr_world_close(world);
}

static void complain(trial *t, const truth_slide *slide, const char *what, double got, double limit)
{
    if (!(got <= limit) && t->complaints++ < MAX_COMPLAINTS) {
        print_message("    %s, dt %.3g: %s: %s: %.3g, allowed %.3g\n", t->subject->name, t->dt, slide->name, what, got,
                      limit);
    }
}

static uint32_t bends(const truth_slide *slide)
{
    return slide->path.count / 2;
}

/* A chord h of a circle of radius R leaves it by h^2 / 2 R and falls back in the next step; along the way R times an
 * angle of at most a quarter turn that adds up to no more than a few h / 2 R of the quarter. */
static double allowed_by_chords(const truth_slide *slide, double dt)
{
    double radius = slide->shape.radius + slide->margin, h = length_of(slide->wish) * dt;
    return slide->curved ? 2 * h * (1 + h / radius) : 0;
}

static void slide_along(void *user, const truth_slide *slide)
{
    trial *t = user;
    const subject *who = t->subject;
    score_path path = {0};

    if (slide->margin <= 0) {
        return; /* who touches has no normals: for charts of smaller and smaller skins */
    }
    run(t, slide, &path);
    double length = length_of(slide->wish) * slide->duration;
    double flat_limit = who->gap * (1 + bends(slide)) * 4;
    score_stat_add(slide->curved ? &t->curved : &t->flat, path.error.max);
    t->worst_end = fmax(t->worst_end, path.end_error / length);
    t->least_clearance = fmin(t->least_clearance, path.clearance - slide->margin);
    t->worst_energy = fmax(t->worst_energy, path.energy_excess);
    t->most_queries = fmax(t->most_queries, path.queries.max);
    t->paths++;
    complain(t, slide, "failed steps", path.failed_steps, 0);
    complain(t, slide, "off the path", path.error.max,
             slide->curved ? allowed_by_chords(slide, t->dt) + flat_limit : flat_limit);
    complain(t, slide, "below the skin by", slide->margin - path.clearance, who->clearance);
    complain(t, slide, "energy out of nothing", path.energy_excess, 1e-12);
    complain(t, slide, "longer than the wish", path.length - length, 1e-9);
    complain(t, slide, "queries in a step", path.queries.max, TAHR_MAX_QUERIES_PER_STEP);
    if (t->dt < 2e-3 || !slide->curved) {
        complain(t, slide, "end error over path", path.end_error / length, who->of_path);
    }
    score_path_free(&path);
}

static void slides_are_those_of_the_reference(void **state)
{
    static const double steps[] = {1.0 / 64, 1.0 / 1024};
    const subject *who = *state;
    int complaints = 0;

    print_message("%-14s %9s %5s %10s %10s %10s %10s %10s %8s\n", "backend", "dt s", "paths", "flat max m", "round p50",
                  "round max", "end/path", "clearance", "queries");
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
        trial t = {.subject = who, .dt = steps[i]};
        assert_true(truth_each_slide(slide_along, &t) > 0 && t.paths > 0);
        print_message("%-14s %9.2e %5d %10.1e %10.1e %10.1e %10.1e %10.1e %8.0f\n", who->name, t.dt, t.paths,
                      t.flat.max, score_stat_quantile(&t.curved, 0.5), t.curved.max, t.worst_end, t.least_clearance,
                      t.most_queries);
        complaints += t.complaints;
        score_stat_free(&t.flat);
        score_stat_free(&t.curved);
    }
    assert_int_equal(complaints, 0);
}

/* What the tests above lean on: the stored paths themselves keep their distance, and touch. */
static void keep_distance(void *user, const truth_slide *slide)
{
    int *paths = user;
    double least = INFINITY;
    tahr_sweep place = {.shape = slide->shape, .up = slide->up, .orientation = {0, 0, 0, 1}};

    for (int i = 0; i <= 200; i++) {
        place.position = score_reference_at(&slide->path, slide->duration * i / 200);
        least = fmin(least, score_distance(&slide->scene, &place, 0, 1));
    }
    assert_true(least > slide->margin - 1e-9);
    assert_true(least < slide->margin + 1e-9);
    ++*paths;
}

static void stored_paths_touch_and_keep_their_distance(void **state)
{
    int paths = 0;
    (void)state;

    assert_true(truth_each_slide(keep_distance, &paths) == paths && paths > 50);
}

int main(void)
{
    static const tahr_native_desc in_float = {.struct_size = sizeof in_float, .precision = TAHR_NATIVE_FLOAT};
    static const tahr_native_desc in_double = {.struct_size = sizeof in_double, .precision = TAHR_NATIVE_DOUBLE};
    subject native_double = {"native double", tahr_backend_v1_native(), &in_double, 1e-9, 1e-3, 1e-5};
    subject native_float = {"native float", tahr_backend_v1_native(), &in_float, 2e-6, 1e-3, 1e-5};
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stored_paths_touch_and_keep_their_distance),
        {"slides_of_native_double_are_those_of_the_reference", slides_are_those_of_the_reference, NULL, NULL,
         &native_double},
        {"slides_of_native_float_are_those_of_the_reference", slides_are_those_of_the_reference, NULL, NULL,
         &native_float},
#ifdef TAHR_HAVE_CCD
        {"slides_of_ccd_are_those_of_the_reference", slides_are_those_of_the_reference, NULL, NULL,
         &(subject){"ccd", tahr_backend_v1_ccd(), NULL, 1e-4, 1e-2, 0x1p-8}},
#endif
#ifdef TAHR_HAVE_FCL
        {"slides_of_fcl_are_those_of_the_reference", slides_are_those_of_the_reference, NULL, NULL,
         &(subject){"fcl", tahr_backend_v1_fcl(), NULL, 1e-4, 1e-2, 0x1p-8}},
#endif
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
