/* SPDX-License-Identifier: MIT
 * test_slide_truth.c: whole movement against the stored slides (truth/slides.txt).
 *
 * The model of the reference: the character wants to go along one velocity all the time; the part of it that leads into
 * what it touches is lost, all touched surfaces taken together; nothing else acts. So Tahr flies, without gravity, drag
 * and steps, and every step begins with that velocity (TAHR_INPUT_DRIVE); where all walls are upright it walks the same
 * way on a floor. Its skin is the distance that the reference keeps. Around edges and corners it goes in closed form;
 * what a step does not see is where within it a face ends and the edge begins, so on curved parts the error falls with
 * dt. On polygons it does not depend on dt at all. With config.path_tolerance 0 a step goes around an edge along one
 * chord. */
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
#ifdef TAHR_HAVE_BOX2D
#include <tahr/box2d.h>
#endif

#include "forms.h"
#include "truth_file.h"

enum { MAX_COMPLAINTS = 12 };

typedef struct subject {
    const char *name;
    const tahr_backend *backend;
    const void *options;
    double gap;       /* m, of a sweep: what a path over a polygon may be off for each of its bends */
    double of_path;   /* end error, of the length of the path */
    double clearance; /* m below the skin */
    double fine;      /* s: the step at which the end error is asked for on curved parts too */
    int planar;       /* 1: a backend of two dimensions */
} subject;

typedef struct trial {
    const subject *subject;
    double dt;
    double away;             /* m: how far from the origin all of it is put */
    int chords;              /* 1: path_tolerance 0 */
    score_stat flat, curved; /* m: the largest error of each path */
    double worst_part;       /* of what a scheme of first order is off */
    double worst_end;        /* of the path */
    double least_clearance;  /* m, less the skin */
    double most_queries;
    int complaints, paths;
} trial;

static double length_of(tahr_vec3 v)
{
    return sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

static void config_of(const subject *who, const truth_slide *slide, tahr_config *config)
{
    assert_int_equal(tahr_config_init(config, sizeof *config, TAHR_PRESET_PRECISE), TAHR_OK);
    config->shape = slide->shape;
    config->skin = slide->margin;
    config->step_height = 0;
    config->acceleration = config->turn_friction = config->fly_drag = 0;
    config->crouched_half_height = slide->shape.half_height;
    if (who->planar) {
        config->plane = (tahr_vec3){0, 0, 1};
        config->gravity = (tahr_vec3){0, -9.81, 0};
    }
}

/* An upright wall seen from above: a line. Its first two corners are those of its foot. */
static void make_line(tahr_body_desc *wall)
{
    wall->type = TAHR_BODY_CHAIN;
    wall->vertex_count = 2;
    wall->indices = NULL;
    wall->triangle_count = 0;
}

static tahr_vec3 moved(tahr_vec3 p, double away)
{
    return (tahr_vec3){p.x + away, p.y - away, p.z + away / 2};
}

/* floor: one more body, or NULL. */
static tahr_world *open_world(const trial *t, const truth_slide *slide, const tahr_body_desc *floor)
{
    tahr_body_desc bodies[TRUTH_MAX_BODIES + 1];
    tahr_world_desc desc;
    tahr_world *world = NULL;

    for (uint32_t i = 0; i < slide->scene.body_count; i++) {
        bodies[i] = slide->descs[i];
    }
    assert_int_equal(tahr_world_desc_init(&desc, sizeof desc), TAHR_OK);
    desc.bodies = bodies;
    desc.body_count = slide->scene.body_count;
    if (floor) {
        bodies[desc.body_count++] = *floor;
    }
    for (uint32_t i = 0; i < desc.body_count; i++) {
        bodies[i].pose.position = moved(bodies[i].pose.position, t->away);
        if (t->subject->planar) {
            make_line(&bodies[i]);
        }
    }
    desc.options = t->subject->options;
    assert_int_equal(tahr_world_open(t->subject->backend, &desc, &world), TAHR_OK);
    return world;
}

/* A character at the start of a slide. */
typedef struct runner {
    tahr_world *world;
    tahr_mover *mover;
    tahr_config config;
    tahr_state state;
    tahr_input input;
    tahr_report report;
} runner;

static void start(runner *r, const trial *t, const truth_slide *slide, const tahr_body_desc *floor)
{
    tahr_vec3 from = moved(slide->position, t->away);

    *r = (runner){.input = {.struct_size = sizeof r->input, .flags = TAHR_INPUT_DRIVE, .drive = slide->wish},
                  .report = {.struct_size = sizeof r->report}};
    config_of(t->subject, slide, &r->config);
    r->config.path_tolerance = t->chords ? 0 : r->config.path_tolerance;
    r->world = open_world(t, slide, floor);
    assert_int_equal(tahr_mover_create(r->world, &r->config, &r->mover), TAHR_OK);
    assert_int_equal(tahr_state_init(&r->state, &r->config, &from), TAHR_OK);
    r->state.mode = floor ? TAHR_MODE_WALKING : TAHR_MODE_FLYING;
    r->state.velocity = slide->wish;
}

/* From start to end. */
static void run(runner *r, const trial *t, const truth_slide *slide, score_path *path)
{
    const score_path_desc desc = {.reference = &slide->path, .scene = &slide->scene, .reach = 0.1};
    double full = 0.5 * length_of(slide->wish) * length_of(slide->wish);
    double dt = t->dt;
    long steps = lround(slide->duration / dt);
    score_step s = score_step_of(&r->state, &r->config.shape, 0, TAHR_OK, NULL);

    s.place.position = slide->position;
    score_path_start(path, &desc, &s);
    for (long i = 1; i <= steps; i++) {
        double before = 0.5 * length_of(r->state.velocity) * length_of(r->state.velocity);
        tahr_status status = tahr_mover_step(r->mover, &r->input, dt, &r->state, &r->report);
        s = score_step_of(&r->state, &r->config.shape, (double)i * dt, status, &r->report);
        s.place.position = moved(s.place.position, -t->away);
        s.work = full - before; /* the drive begins every step with the whole velocity */
        score_path_add(path, &s);
    }
    tahr_mover_destroy(r->mover);
    tahr_world_close(r->world);
}

static void complain(trial *t, const truth_slide *slide, const char *what, double got, double limit)
{
    if (!(got <= limit) && t->complaints++ < MAX_COMPLAINTS) {
        print_message("    %s, dt %.3g: %s: %s: %.3g, allowed %.3g\n", t->subject->name, t->dt, slide->name, what, got,
                      limit);
    }
}

/* m: how far a path over a polygon may be off: a sweep's error for each of its bends, at both ends of it, over the sine
 * of the flattest angle at which it meets something, which is above 1/2 but in the wedges. */
static double flat_limit(const trial *t, const truth_slide *slide)
{
    return t->subject->gap * 4 * (1 + slide->path.count / 2);
}

/* On curved parts: as one chord a step, within twice of what the catching-up scheme is off at 64 Hz, and in proportion
 * to dt. */
static double round_limit(const trial *t, const truth_slide *slide)
{
    return slide->curved ? 2 * slide->first_order * t->dt * 64 : 0;
}

/* What the table of acceptance asks for (README.md): a part of the path and a skin. */
static double end_limit(const trial *t, const truth_slide *slide)
{
    return t->subject->of_path * length_of(slide->wish) * slide->duration + slide->margin;
}

static void judge(trial *t, const truth_slide *slide, const score_path *path)
{
    double length = length_of(slide->wish) * slide->duration;
    double rounding = length_of(slide->wish) * length_of(slide->wish) * path->steps * 0x1p-50;
    double of_place = 2 * path->steps * t->away * 0x1p-52; /* of its coordinates, once a step */

    score_stat_add(slide->curved ? &t->curved : &t->flat, path->error.max);
    if (slide->curved) {
        t->worst_part = fmax(t->worst_part, path->error.max / (slide->first_order * t->dt * 64));
    }
    t->worst_end = fmax(t->worst_end, path->end_error / length);
    t->least_clearance = fmin(t->least_clearance, path->clearance - slide->margin);
    t->most_queries = fmax(t->most_queries, path->queries.max);
    t->paths++;
    complain(t, slide, "failed steps", path->failed_steps, 0);
    complain(t, slide, "off the path", path->error.max, round_limit(t, slide) + flat_limit(t, slide) + of_place);
    complain(t, slide, "below the skin by", slide->margin - path->clearance, t->subject->clearance);
    complain(t, slide, "energy out of nothing", path->energy_excess, rounding);
    complain(t, slide, "longer than the wish", path->length - length, 1e-9 + of_place);
    complain(t, slide, "queries in a step", path->queries.max, TAHR_MAX_QUERIES_PER_STEP);
    if (!t->chords || t->dt == t->subject->fine || !slide->curved) {
        complain(t, slide, "end error", path->end_error, end_limit(t, slide));
    }
}

/* Between upright walls, and not up or down along them. */
static int is_level(const truth_slide *slide)
{
    return slide->wish.z == 0 && (!strncmp(slide->name, "wedge", 5) || !strncmp(slide->name, "acute", 5));
}

/* In a gutter whose walls lean to each other so steeply that one pushes away from the other, flying without a
 * path_tolerance bends what the first wall left instead of the drive itself: it swings from wall to wall, by up to a
 * step of its way. */
static int swings(const trial *t, const truth_slide *slide)
{
    return t->chords && !strncmp(slide->name, "gutter", 6);
}

static void slide_along(void *user, const truth_slide *slide)
{
    trial *t = user;
    score_path path = {0};
    runner r;

    if (slide->margin <= 0 || swings(t, slide)) {
        return; /* who touches has no normals: those are for charts of smaller and smaller skins */
    }
    if (t->subject->planar && (!is_level(slide) || slide->shape.type != TAHR_SHAPE_SPHERE)) {
        return; /* what happens in the plane of x and y, to circles */
    }
    start(&r, t, slide, NULL);
    run(&r, t, slide, &path);
    judge(t, slide, &path);
    score_path_free(&path);
}

/* Upright walls, walked into on a floor that is as far below as a character stands. */
static void walk_along(void *user, const truth_slide *slide)
{
    trial *t = user;
    score_path path = {0};
    tahr_body_desc floor;
    runner r;

    if (slide->margin <= 0 || !is_level(slide) || slide->shape.type == TAHR_SHAPE_BOX) {
        return;
    }
    assert_int_equal(tahr_body_desc_init(&floor, sizeof floor, TAHR_BODY_BOX), TAHR_OK);
    config_of(t->subject, slide, &r.config);
    floor.half_extents = (tahr_vec3){64, 64, 1};
    floor.pose.position.z =
        slide->position.z - slide->shape.half_height - r.config.floor_target * slide->margin - floor.half_extents.z;
    start(&r, t, slide, &floor);
    run(&r, t, slide, &path);
    judge(t, slide, &path);
    complain(t, slide, "not walking any more", r.state.mode != TAHR_MODE_WALKING, 0);
    score_path_free(&path);
}

/* Grazing a floor at 11 degrees, to and fro, half a kilometre in all directions: a skin that is taken off along the
 * motion loses four fifths of itself in 20 000 steps. */
static void who_grazes_keeps_the_skin(void **state)
{
    const subject *who = *state;
    truth_slide slide = {.shape = {.type = TAHR_SHAPE_SPHERE, .radius = 0.5, .half_height = 0.5}, .margin = 0.01};
    const double dt = 1.0 / 64, top = 2;
    const long steps = who->gap < 1e-5 ? 100000 : 20000;
    double least = INFINITY;
    tahr_body_desc floor;
    runner r;

    assert_int_equal(tahr_body_desc_init(&floor, sizeof floor, TAHR_BODY_BOX), TAHR_OK);
    floor.half_extents = (tahr_vec3){512, 512, top};
    slide.position = (tahr_vec3){0, 0, top + slide.shape.radius + 1.5 * slide.margin};
    start(&r, &(trial){.subject = who}, &slide, &floor);
    r.state.mode = TAHR_MODE_FLYING;
    for (long i = 0; i < steps; i++) {
        double way = i / 8000 % 2 ? -3.25 : 3.25;
        r.input.drive = (tahr_vec3){way, 0.3 * way, -0.65};
        assert_int_equal(tahr_mover_step(r.mover, &r.input, dt, &r.state, &r.report), TAHR_OK);
        least = fmin(least, r.state.position.z - slide.shape.radius - top);
    }
    tahr_mover_destroy(r.mover);
    tahr_world_close(r.world);
    print_message("%-14s %ld steps: least clearance %.3g m of %g m\n", who->name, steps, least, slide.margin);
    assert_true(least >= slide.margin - who->clearance);
}

/* At 64 Hz, finely, and at 64 Hz a thousand kilometres from the origin, where a double holds 2e-10 m; and as chords. */
static int try_all(const subject *who, const char *what, truth_slide_fn one)
{
    const trial trials[] = {{.dt = 1.0 / 64},
                            {.dt = who->fine},
                            {.dt = 1.0 / 64, .away = 0x1p20},
                            {.dt = 1.0 / 64, .chords = 1},
                            {.dt = who->fine, .chords = 1}};
    int complaints = 0;

    print_message("%-14s %-4s %8s %7s %5s %10s %10s %10s %8s %10s %10s %7s\n", "backend", "", "dt s", "away m", "paths",
                  "flat max m", "round p50", "round max", "of limit", "end/path", "clearance", "queries");
    for (size_t i = 0; i < sizeof trials / sizeof *trials; i++) {
        trial t = trials[i];
        t.subject = who;
        assert_true(truth_each_slide(one, &t) > 0 && t.paths > 0);
        print_message("%-14s %-4s %8.2e %7.0e %5d %10.1e %10.1e %10.1e %8.3f %10.1e %10.1e %7.0f\n", who->name, what,
                      t.dt, t.away, t.paths, t.flat.max, score_stat_quantile(&t.curved, 0.5), t.curved.max,
                      t.worst_part / 2, t.worst_end, t.least_clearance, t.most_queries);
        complaints += t.complaints;
        score_stat_free(&t.flat);
        score_stat_free(&t.curved);
    }
    return complaints;
}

static void slides_are_those_of_the_reference(void **state)
{
    assert_int_equal(try_all(*state, "fly", slide_along), 0);
}

static void walls_are_walked_along_as_they_are_slid_along(void **state)
{
    assert_int_equal(try_all(*state, "walk", walk_along), 0);
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

/* A third witness of the paths over a step: once on the floor, the foot goes as high as the closed form says. */
static void climb_by_the_form(void *user, const truth_slide *slide)
{
    static const double rise = 0.1875;
    double r = slide->shape.radius + slide->margin, foot = slide->shape.half_height - slide->shape.radius;
    int *paths = user, touched = 0;

    if (strncmp(slide->name, "step_", 5)) {
        return;
    }
    for (int i = 0; i <= 1000; i++) {
        tahr_vec3 p = score_reference_at(&slide->path, slide->duration * i / 1000);
        double over = p.z - foot - (double)form_step_height(r, rise, p.x);
        assert_true(over > -1e-9);
        touched |= over < 1e-9;
        assert_true(!touched || over < 1e-9);
    }
    assert_true(touched && score_reference_at(&slide->path, slide->duration).x > 0);
    ++*paths;
}

static void stored_steps_are_climbed_along_the_closed_form(void **state)
{
    int paths = 0;
    (void)state;

    truth_each_slide(climb_by_the_form, &paths);
    assert_int_equal(paths, 4); /* sphere and capsule, touching and with a skin */
}

int main(void)
{
    subject native = {"native", tahr_backend_v1_native(), NULL, 1e-9, 1e-3, 1e-8, 1.0 / 1024, 0};
#define OF(name, subject)                                                                                       \
    {"slides_of_" name "_are_those_of_the_reference", slides_are_those_of_the_reference, NULL, NULL, &subject}, \
        {"who_grazes_keeps_the_skin_on_" name, who_grazes_keeps_the_skin, NULL, NULL, &subject},                \
        {"walls_are_walked_along_on_" name, walls_are_walked_along_as_they_are_slid_along, NULL, NULL, &subject}
#ifdef TAHR_HAVE_CCD
    subject ccd = {"ccd", tahr_backend_v1_ccd(), NULL, 1e-4, 1e-2, 0x1p-8, 1.0 / 128, 0};
#endif
#ifdef TAHR_HAVE_FCL
    subject fcl = {"fcl", tahr_backend_v1_fcl(), NULL, 1e-4, 1e-2, 0x1p-8, 1.0 / 128, 0};
#endif
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stored_paths_touch_and_keep_their_distance),
        cmocka_unit_test(stored_steps_are_climbed_along_the_closed_form),
        OF("native", native),
#ifdef TAHR_HAVE_CCD
        OF("ccd", ccd),
#endif
#ifdef TAHR_HAVE_FCL
        OF("fcl", fcl),
#endif
#ifdef TAHR_HAVE_BOX2D
        {"slides_of_box2d_are_those_of_the_reference", slides_are_those_of_the_reference, NULL, NULL,
         &(subject){"box2d", tahr_backend_v1_box2d(), NULL, 1e-4, 1e-2, 0x1p-8, 1.0 / 128, 1}},
#endif
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
