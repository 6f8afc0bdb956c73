/* SPDX-License-Identifier: MIT
 * test_lcm_program.c: `tahr replay LOG --verify` of what a program recorded that does more than `tahr run`: it writes
 * to states, changes settings, sets, teleports and touches what is in the world, and has a mode of its own. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#ifdef TAHR_HAVE_LCM

#include "captured.h"
#include "lcm_log.h"
#include "lcm/message.h"
#include "replay.h"
#include "say.h"
#include "scene.h"

#include <stdlib.h>
#include <string.h>
#include <tahr/lcm.h>
#include <tahr/telemetry.h>
#include <unistd.h>

#include <cmocka.h>

enum {
    STEPS = 300, /* of both characters, at 60 Hz; snapshots once a second */
    SECOND = 60,
    WRITTEN = 50,  /* the step before which the first one is put elsewhere, */
    JUMPED = 70,   /* the one for which a body jumps, */
    OTHER = 80,    /* before which the second one has other settings, */
    TOUCHED = 100, /* before which the world is touched, */
    CUSTOM = 130   /* and that the first one takes in the program's own mode */
};

#define DT (1.0 / 60)

struct program {
    struct level level;
    tahr_world *world;
    tahr_config configs[2];
    tahr_mover *movers[2][2]; /* by character and settings */
    tahr_state states[2];
    tahr_body_pose poses[16];
    tahr_lcm *lcm;
    tahr_telemetry *telemetry;
};

static char folder[] = "/tmp/tahr-program.XXXXXX";
static char path[64], url[80];

static void place_bodies(struct program *p, double time, uint32_t jumping)
{
    for (uint32_t i = 0; i < p->level.mover_count; i++) {
        p->poses[i] = (tahr_body_pose){.body = p->level.movers[i].body,
                                       .flags = i == jumping ? TAHR_POSE_TELEPORT : 0u,
                                       .pose = level_mover_pose(&p->level.movers[i], time)};
    }
}

static void tell_change(struct program *p, uint32_t kind, double dt)
{
    const uint32_t count = kind == TAHR_CHANGE_TOUCH ? 0 : (uint32_t)p->level.mover_count;
    assert_int_equal(tahr_telemetry_change(p->telemetry, kind, p->poses, count, dt, tahr_world_revision(p->world)),
                     TAHR_OK);
}

static void open_program(struct program *p)
{
    const struct options options = {.up = 'y', .backend = backend_choice_at(0)};
    tahr_telemetry_desc desc;
    tahr_lcm_desc to;
    assert_int_equal(scene_load(&p->level, &options), 0);
    assert_int_equal(scene_open(&p->level, &options, &p->world), 0);
    assert_true(p->level.mover_count > 1 && p->level.mover_count <= 16);
    tahr_config_init(&p->configs[0], sizeof p->configs[0], TAHR_PRESET_PRECISE);
    tahr_config_init(&p->configs[1], sizeof p->configs[1], TAHR_PRESET_UNREAL);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(tahr_mover_create(p->world, &p->configs[i % 2], &p->movers[i / 2][i % 2]), TAHR_OK);
    }
    tahr_state_init(&p->states[0], &p->configs[0], &(tahr_vec3){-17, 31, 2});
    tahr_state_init(&p->states[1], &p->configs[0], &(tahr_vec3){-13, 25, 2});
    place_bodies(p, 1, UINT32_MAX);
    assert_int_equal(tahr_world_move(p->world, p->poses, (uint32_t)p->level.mover_count, 1), TAHR_OK);
    tahr_lcm_desc_init(&to, sizeof to);
    to.url = url;
    assert_int_equal(tahr_lcm_open(&to, &p->lcm), TAHR_OK);
    tahr_telemetry_desc_init(&desc, sizeof desc);
    desc.sink = tahr_lcm_sink(p->lcm);
    desc.characters = 2;
    desc.bodies = 16;
    desc.configs = p->configs;
    desc.config_count = 2;
    desc.snapshot_period = 1;
    desc.level = "playground";
    desc.level_hash = scene_hash(&p->level);
    desc.backend = "native";
    desc.revision = tahr_world_revision(p->world);
    assert_int_equal(tahr_telemetry_create(&desc, &p->telemetry), TAHR_OK);
}

static void step(struct program *p, uint32_t character, uint32_t index)
{
    const uint32_t settings = character == 1 && index >= OTHER;
    tahr_state *state = &p->states[character];
    tahr_event events[16];
    tahr_report report = {.struct_size = sizeof report, .events = events, .event_capacity = 16};
    const tahr_input input = {.struct_size = sizeof input,
                              .move = {index / 40 % 2 ? 1 : -0.5, character ? 0.25 : 0.75, 0},
                              .jump = index % 90 > 80};
    assert_int_equal(tahr_telemetry_begin(p->telemetry, 0, character, settings, state), TAHR_OK);
    const tahr_status status = tahr_mover_step(p->movers[character][settings], &input, DT, state, &report);
    assert_true(status >= 0);
    const uint32_t custom = character == 0 && index == CUSTOM;
    const tahr_telemetry_step told = {.character = character,
                                      .status = status,
                                      .input = &input,
                                      .state = state,
                                      .report = &report,
                                      .dt = DT,
                                      .flags = custom ? TAHR_STEP_CUSTOM : 0u};
    assert_int_equal(tahr_telemetry_push(p->telemetry, 0, &told), TAHR_OK);
}

static void close_program(struct program *p)
{
    assert_int_equal(tahr_telemetry_stop(p->telemetry, TAHR_STOP_DRAIN, 60), TAHR_OK);
    tahr_telemetry_destroy(p->telemetry);
    tahr_lcm_close(p->lcm);
    for (int i = 0; i < 4; i++) {
        tahr_mover_destroy(p->movers[i / 2][i % 2]);
    }
    tahr_world_close(p->world);
    level_close(&p->level);
}

/* Bodies were moved before anybody was told: SET tells where they are. */
static void record_program(void)
{
    struct program p = {0};
    open_program(&p);
    place_bodies(&p, 2, UINT32_MAX);
    assert_int_equal(tahr_world_set(p.world, p.poses, (uint32_t)p.level.mover_count), TAHR_OK);
    tell_change(&p, TAHR_CHANGE_SET, 0);
    for (uint32_t i = 0; i < STEPS; i++) {
        place_bodies(&p, 2 + (i + 1) * DT, i == JUMPED ? 1 : UINT32_MAX);
        assert_int_equal(tahr_world_move(p.world, p.poses, (uint32_t)p.level.mover_count, DT), TAHR_OK);
        tell_change(&p, TAHR_CHANGE_MOVE, DT);
        if (i == TOUCHED) {
            assert_int_equal(tahr_world_touch(p.world), TAHR_OK);
            tell_change(&p, TAHR_CHANGE_TOUCH, 0);
        }
        if (i == WRITTEN) {
            assert_int_equal(tahr_state_teleport(&p.states[0], &(tahr_vec3){-16.5, 31, 1.5}), TAHR_OK);
        }
        step(&p, 0, i);
        step(&p, 1, i);
    }
    close_program(&p);
}

static int verify(const struct log_copy *log)
{
    log_copy_write(log, path);
    return captured(replay_command, (const char *const[]){"replay", path, "--verify", NULL});
}

/* Takes the snapshot before a step of a character out. */
static void lose_snapshot(struct log_copy *log, int32_t character, int64_t before)
{
    int found = 0;
    for (size_t i = 0; i < log->count; i++) {
        struct message m;
        struct log_entry *entry = &log->entries[i];
        if (strcmp(entry->channel, "TAHR_SNAPSHOT") == 0) {
            assert_int_equal(message_read(&m, entry->channel, entry->data, entry->size), MESSAGE_OURS);
            entry->gone = m.character == character && m.step == before;
            found += entry->gone;
            message_free(&m);
        }
    }
    assert_int_equal(found, 1);
}

static void all_that_a_program_does_is_proven_but_its_own_mode(void **state)
{
    struct log_copy log = {0};
    (void)state;
    record_program();
    log_copy_read(&log, path);
    assert_int_equal(verify(&log), EXIT_CHECK_FAILED);
    assert_said("proven     560 steps of 2 characters"); /* snapshots of the first: before 0, 50, 110, 170 */
    assert_said("written    1 times the program wrote to a state");
    assert_said("not proven 40 steps, in 1 gap\n");
    assert_said("character 0, from step 130 to 169: it ran the caller's own mode");
    assert_said("\nNOT PROVEN");
    log_copy_free(&log);
}

static void a_state_written_to_without_its_snapshot_is_a_gap_and_no_difference(void **state)
{
    struct log_copy log = {0};
    (void)state;
    record_program();
    log_copy_read(&log, path);
    lose_snapshot(&log, 0, WRITTEN);
    assert_int_equal(verify(&log), EXIT_CHECK_FAILED);
    /* The period counts from that snapshot: the next one is at 110. */
    assert_said("character 0, from step 50 to 109: a snapshot was lost, which may have told of a state");
    char *text = captured_text();
    assert_null(strstr(text, "DIFFERS"));
    free(text);
    log_copy_free(&log);
}

static void other_settings_without_their_snapshot_are_a_gap(void **state)
{
    struct log_copy log = {0};
    (void)state;
    record_program();
    log_copy_read(&log, path);
    lose_snapshot(&log, 1, OTHER);
    assert_int_equal(verify(&log), EXIT_CHECK_FAILED);
    assert_said("character 1, from step 80 to 139: its settings changed, and the snapshot that tells of it was lost");
    log_copy_free(&log);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_that_a_program_does_is_proven_but_its_own_mode),
        cmocka_unit_test(a_state_written_to_without_its_snapshot_is_a_gap_and_no_difference),
        cmocka_unit_test(other_settings_without_their_snapshot_are_a_gap),
    };
    if (mkdtemp(folder) == NULL) {
        return 1;
    }
    snprintf(path, sizeof path, "%s/a.lcmlog", folder);
    snprintf(url, sizeof url, "file://%s", path);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    remove(path);
    rmdir(folder);
    return failed;
}

#else

int main(void)
{
    puts("SKIP: cli_lcm_program: this tahr was built without LCM");
    return 77;
}

#endif
