/* SPDX-License-Identifier: MIT
 * test_matrix.c: a thin slice of the stability matrix; and whether the matrix can fail: broken backends turn it red. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "judge.h"
#include "matrix.h"
#include "mutant.h"
#include "table.h"

enum { SLICE = 1, TRIES = 6 };

static void native_keeps_every_promise_and_everybody_stays_sane(void **unused)
{
    const matrix_request request = {.seeds = SLICE, .first_seed = 3, .jobs = 2, .quiet = 1};
    matrix m;
    char why[256] = "";
    int broken = 0, done = 0;
    (void)unused;
    assert_true(matrix_run(&m, &request, NULL, why));
    for (uint32_t i = 0; i < m.count; i++) {
        const cell *c = &m.cells[i];
        int native = strcmp(c->subject->name, "native") == 0;
        int bad = !cell_sane(c) || (native && !cell_clean(c));
        done += c->what == CELL_DONE;
        broken += bad;
        if (bad)
            print_error("%s, %s, %s: seed %u: %s\n", c->family->name, c->subject->name,
                        tahr_preset_name((int32_t)c->preset), (unsigned)c->first_seed, c->first.text);
    }
    matrix_free(&m);
    assert_true(done >= family_count() * 2); /* native and two presets at the least */
    assert_int_equal(broken, 0);
}

/* Variations that lost time, a floor or their last bits once, each for a cause of its own. */
static void what_was_broken_once_stays_whole(void **unused)
{
    static const struct {
        const char *family, *subject;
        uint32_t preset, seed;
    } once[] = {
        {"turned", "native", TAHR_PRESET_PRECISE, 446},    /* a fall between two faces that face each other */
        {"wedge", "native", TAHR_PRESET_PRECISE, 556},     /* a jump between a slope and a sheet */
        {"blocks", "native", TAHR_PRESET_PRECISE, 547},    /* a gap as wide as the foot */
        {"soup", "native", TAHR_PRESET_PRECISE, 268},      /* on and off an edge, again and again in one step */
        {"blocks", "native", TAHR_PRESET_PLATFORMER, 872}, /* a head beside something lower than itself */
        {"shortcuts", "native", TAHR_PRESET_PRECISE, 11},  /* at rest just over the border of a cell */
        {"water", "native", TAHR_PRESET_UNREAL, 136},      /* stood on a floor that was only its foot */
    };
    (void)unused;
    for (size_t i = 0; i < sizeof once / sizeof once[0]; i++) {
        run_request q = {family_named(once[i].family), subject_named(once[i].subject), once[i].preset, once[i].seed, 0};
        outcome out;
        run(&q, &out);
        if (out.first.kept) print_error("%s %u: %s\n", once[i].family, (unsigned)once[i].seed, out.first.text);
        assert_int_equal(out.first.kept, 0);
    }
}

/* How many of some runs break what. */
static uint32_t broken_by(const family *f, const subject *s, uint32_t preset, uint32_t *runs)
{
    uint32_t kept = 0;
    const char *why;
    *runs = 0;
    for (uint64_t seed = 1; run_possible(f, s, preset, &why) && seed <= TRIES; seed++) {
        run_request q = {f, s, preset, seed, 0};
        outcome out;
        run(&q, &out);
        kept |= out.first.kept;
        *runs += out.first.kept != 0;
    }
    return kept;
}

/* Which mutants the matrix must see, and in which family. Those that are left out break what no trial uses: masks,
 * the names of surfaces, rays, round bodies, orders and capacities of answers. */
static void mutants_turn_their_families_red(void **unused)
{
    static const struct {
        uint32_t mutant;
        const char *family;
    } must[] = {
        {LATE_BY_A_MILLIMETRE, "slivers"},
        {EARLY_BY_A_MILLIMETRE, "scaled"},
        {NORMAL_FLIPPED, "touching"},
        {NORMAL_NOT_UNIT, "seams"},
        {NORMAL_OF_AN_AXIS, "terrain"},
        {NORMAL_ALWAYS_UP, "sheets"},
        {BLOCKS_SEPARATING_MOTION, "touching"},
        {FREE_AT_THE_MARGIN, "touching"},
        {FREE_JUST_OUTSIDE_THE_MARGIN, "edges"},
        {FREE_A_MILLIMETRE_OUTSIDE, "dead_band"},
        {LEVEL_MOTIONS_ENTER_THE_MARGIN, "deep_start"},
        {LEVEL_MOTIONS_MISS_WHAT_IS_NEAR, "acute_corner"},
        {FREE_WHEN_TOUCHING, "touching"},
        {MARGIN_IGNORED, "narrow"},
        {MARGIN_ALONG_THE_MOTION, "tug_of_war"},
        {GRAZES_MISSED, "edges"},
        {DISTANCE_NOT_SAID, "moved"},
        {OVERLAP_NOT_REPORTED, "tug_of_war"},
        {SURFACE_NORMAL_ALWAYS_UP, "turned"},
        {WIDER_BY_A_MILLIMETRE, "scaled"},
        {SEAMS_ARE_FELT, "step_traps"},
        {SEAMS_BLOCK, "sheets"},
        {BACK_FACES_BLOCK, "sheets"},
        {TWO_SIDED_IGNORED, "acute_corner"},
        {DEGENERATE_REFUSED, "degenerate"},
        {POSITIONS_IN_FLOAT, "moved"},
        {GRID_OF_MILLIMETRES, "far_origin"},
        {ABSOLUTE_TOLERANCE, "scaled"},
        {ABSOLUTE_MARGIN, "tiny_scale"},
        {CAPSULE_IS_A_BOX, "terrain"},
        {UP_IS_ALWAYS_Z, "turned"},
        {BOXES_HALF_AS_HIGH, "narrow"},
        {MESHES_SHIFTED, "soup"},
        {CONTACT_NORMAL_FLIPPED, "energy"},
        {CONTACTS_FORGET_THE_NEAREST, "tug_of_war"},
        {FRACTION_IS_NAN, "perch"},
        {FRACTION_IS_MINUS_ONE, "lift"},
        {ALWAYS_UNKNOWN, "edges"},
        {PLACING_IGNORED, "shuttle"},
        {HULLS_SHIFTED, "hulls"},
        {HEIGHTS_SHIFTED, "heights"},
        {SENSORS_BLOCK, "sensors"},
        {SENSORS_FORGOTTEN, "sensors"},
        {IMMERSION_HALVED, "water"},
        {PLACING_IGNORED, "pushed"},
        {BOX_IS_A_CAPSULE, "box_character"},
    };
    int alive = 0;
    (void)unused;
    for (size_t i = 0; i < sizeof must / sizeof must[0]; i++) {
        const subject s = subject_mutant(must[i].mutant);
        const family *f = family_named(must[i].family);
        uint32_t precise, unreal;
        assert_non_null(f);
        broken_by(f, &s, TAHR_PRESET_PRECISE, &precise);
        broken_by(f, &s, TAHR_PRESET_UNREAL, &unreal);
        if (precise + unreal == 0) print_error("%s is not seen in %s\n", s.name, f->name);
        alive += precise + unreal == 0;
    }
    assert_int_equal(alive, 0);
}

static void the_truth_about_native_is_that_nothing_is_broken(void **unused)
{
    const subject honest = subject_mutant(MUTANT_NONE);
    (void)unused;
    for (const family *f = FAMILIES; f->name; f++) {
        uint32_t runs;
        if (broken_by(f, &honest, TAHR_PRESET_PRECISE, &runs)) print_error("%s\n", f->name);
        assert_int_equal(runs, 0);
    }
}

/* A platform 0.1 m thick with its top at 1 m, and somebody whose foot goes from one height to another, or who meets it
 * with this normal. Returns how much of the promise is used up. */
static double one_way_used(const trial *t, double from, double to, const tahr_vec3 *normal)
{
    const char *what = "";
    tahr_state a = {.half_height = 0.9, .radius = 0.35}, b = a;
    tahr_event hit = {.type = TAHR_EVENT_HIT, .body = 1};
    tahr_report r = {.struct_size = sizeof r, .events = &hit, .event_count = normal != NULL};
    a.position.z = from + a.half_height;
    b.position.z = to + b.half_height;
    if (normal) hit.normal = *normal;
    return t->promise(t, 0, &a, &b, &r, &what);
}

/* The mutant has no one-way bodies, which would have to be broken one by one for the conformance kit too. */
static void who_falls_through_a_platform_or_bumps_against_it_is_seen(void **unused)
{
    trial t;
    const tahr_vec3 up = {0, 0, 1}, side = {1, 0, 0}, down = {0, 0, -1};
    (void)unused;
    family_make(family_named("one_way"), IN_SPACE, TAHR_PRESET_PRECISE, 1, &t);
    const uint32_t all = t.body_count;
    assert_true(all > 1 && t.bodies[1].desc.flags & TAHR_BODY_ONE_WAY);
    t.body_count = 2;
    t.bodies[1].desc.pose.position = (tahr_vec3){0, 0, 0.95};
    t.bodies[1].desc.half_extents = (tahr_vec3){2, 2, 0.05};
    assert_true(one_way_used(&t, 1.2, 1.01, NULL) == 0);
    assert_true(one_way_used(&t, 1.2, 0.99, NULL) > 1);
    assert_true(one_way_used(&t, 0.5, 0.4, NULL) == 0);
    assert_true(one_way_used(&t, 0.5, 1.3, NULL) == 0);
    assert_true(one_way_used(&t, 1.2, 1.01, &up) == 0);
    assert_true(one_way_used(&t, 0.5, 0.6, &side) > 1 && one_way_used(&t, -1, -0.9, &down) > 1);
    t.bodies[1].desc.pose.position.x = 10;
    assert_true(one_way_used(&t, 1.2, 0.5, NULL) == 0);
    t.body_count = all;
    trial_free(&t);
}

/* Late hits are lies of the mildest kind: well formed, and only a decimetre off. What no family sees of them it would
 * not see of a backend that is a little wrong. */
static void no_family_takes_late_hits_for_the_truth(void **unused)
{
    const subject late = subject_judged("liar-late");
    int blind = 0;
    (void)unused;
    for (const family *f = FAMILIES; f->name; f++) {
        uint32_t runs;
        uint32_t kept = broken_by(f, &late, TAHR_PRESET_PRECISE, &runs);
        int nothing_near = strcmp(f->name, "pieces") == 0;
        int by_its_own = !f->twin || (kept & KEEPS_RELATION);
        if (!nothing_near && (runs == 0 || !by_its_own)) print_error("%s does not see late hits\n", f->name);
        blind += !nothing_near && (runs == 0 || !by_its_own);
    }
    assert_int_equal(blind, 0);
}

/* A promise that UNREAL is let off, and would keep, it has to keep. */
static void what_unreal_is_let_off_it_really_loses(void **unused)
{
    const subject *native = subject_named("native");
    (void)unused;
    for (const family *f = FAMILIES; f->name; f++) {
        family strict = *f;
        uint32_t kept = 0;
        if (!f->unreal_loses) continue;
        strict.unreal_loses = 0;
        for (uint64_t seed = 1; seed <= 1000 && !(kept & f->unreal_loses); seed++) {
            run_request q = {&strict, native, TAHR_PRESET_UNREAL, seed, 0};
            outcome out;
            run(&q, &out);
            kept |= out.first.kept;
        }
        if (!(kept & f->unreal_loses)) print_error("%s\n", f->name);
        assert_true(kept & f->unreal_loses);
        assert_non_null(f->unreal_why);
    }
}

/* The judge by closed forms: a capsule of radius 0.35 beside the edge of a box, over its top, inside of it. */
static void the_judge_measures_what_is_known(void **unused)
{
    static trial t;
    tahr_state s;
    uint32_t body = 9;
    (void)unused;
    trial_begin(&t, IN_SPACE, TAHR_PRESET_PRECISE);
    trial_box(&t, (tahr_vec3){0, 0, -1}, (tahr_vec3){2, 2, 1}, 0);
    trial_finish(&t);
    judge *j = judge_open(&t);
    tahr_pose pose = t.bodies[0].desc.pose;
    tahr_vec3 over = {0, 0, 0.95}, beside = {2.3, 0, 0.95}, in = {0, 0, -1}, below = {0, 0, -0.5};
    assert_non_null(j);
    tahr_state_init(&s, &t.config, &over);
    assert_true(fabs(judge_gap(j, &pose, &s, 1, &body) - 0.05) < 1e-14 && body == 0);
    assert_true(fabs(judge_gap_again(j, &pose, &s, 0) - 0.05) < 1e-14);
    /* Its lower core point is at (2.3, 0, 0.4): from the edge at (2, *, 0) as far as (0.3, 0.4) is long. */
    s.position = beside;
    assert_true(fabs(judge_gap(j, &pose, &s, 1, NULL) - (0.5 - 0.35)) < 1e-14);
    s.position = in;
    s.half_height = 0.4;
    assert_true(judge_gap(j, &pose, &s, 1, NULL) == -0.35 && judge_gap_again(j, &pose, &s, 0) == -0.35);
    assert_true(judge_crossed(j, 0, &pose, &pose, over, below));
    assert_false(judge_crossed(j, 0, &pose, &pose, over, beside));
    /* The box comes up and passes one who stays. */
    tahr_pose higher = pose;
    higher.position.z += 3;
    assert_true(judge_crossed(j, 0, &pose, &higher, over, over));
    judge_close(j);
    trial_free(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_judge_measures_what_is_known),
        cmocka_unit_test(the_truth_about_native_is_that_nothing_is_broken),
        cmocka_unit_test(mutants_turn_their_families_red),
        cmocka_unit_test(who_falls_through_a_platform_or_bumps_against_it_is_seen),
        cmocka_unit_test(no_family_takes_late_hits_for_the_truth),
        cmocka_unit_test(what_unreal_is_let_off_it_really_loses),
        cmocka_unit_test(what_was_broken_once_stays_whole),
        cmocka_unit_test(native_keeps_every_promise_and_everybody_stays_sane),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
