/* SPDX-License-Identifier: MIT
 * test_lcm_listen.c: `tahr listen` and `tahr record`: what they show and keep of a log that is played to them, what
 * they count as lost, and what they ignore. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#ifdef TAHR_HAVE_LCM

#include "captured.h"
#include "lcm/listen.h"
#include "lcm_log.h"
#include "lcm/record.h"
#include "lcm/roster.h"
#include "lcm/table.h"
#include "run.h"
#include "say.h"

#include <inttypes.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static char folder[] = "/tmp/tahr-listen.XXXXXX";
static char path[64], url[100], copy[64];
static struct log_copy whole; /* two seconds of 20 characters, and two strange messages */

static void check_state(json_t *object, const struct message *m)
{
    const tahr_state_t *s = &m->is.state;
    assert_int_equal(json_integer_value(json_object_get(object, "character")), s->character);
    assert_int_equal(json_integer_value(json_object_get(object, "step")), s->step);
    assert_int_equal(json_integer_value(json_object_get(object, "wall_ns")), s->wall_ns);
    assert_int_equal(json_is_true(json_object_get(object, "floor_walkable")), s->floor_walkable != 0);
    for (size_t i = 0; i < 3; i++) {
        const double x = json_real_value(json_array_get(json_object_get(object, "position"), i));
        assert_memory_equal(&x, &s->position[i], sizeof x); /* every bit of it comes through */
    }
    assert_string_equal(json_string_value(json_object_get(object, "mode_name")), tahr_mode_name((uint32_t)s->mode));
}

static void check_object(json_t *object, const struct log_entry *entry)
{
    struct message m;
    char hash[17];
    assert_string_equal(json_string_value(json_object_get(object, "channel")), entry->channel);
    assert_int_equal(message_read(&m, entry->channel, entry->data, entry->size), MESSAGE_OURS);
    if (m.kind == TAHR_MESSAGE_STATE) {
        check_state(object, &m);
    } else if (m.kind == TAHR_MESSAGE_REPORT) {
        snprintf(hash, sizeof hash, "%016" PRIx64, (uint64_t)m.is.report.state_hash);
        assert_string_equal(json_string_value(json_object_get(object, "state_hash")), hash);
        assert_int_equal(json_array_size(json_object_get(object, "saved")), TAHR_SHORTCUT_COUNT);
    } else if (m.kind == TAHR_MESSAGE_SNAPSHOT) {
        assert_int_equal(strlen(json_string_value(json_object_get(object, "state"))), 2 * sizeof(tahr_state));
    } else if (m.kind == TAHR_MESSAGE_WORLD) {
        assert_string_equal(json_string_value(json_object_get(object, "level")), "playground");
    }
    message_free(&m);
}

static void each_message_is_one_json_object_with_all_that_it_holds(void **state)
{
    (void)state;
    assert_int_equal(captured(listen_command, (const char *const[]){"listen", "--lcm", url, "--json", NULL}),
                     EXIT_GOOD);
    char *text = captured_text(), *rest = text;
    for (size_t i = 0; i < whole.count; i++) {
        json_error_t error;
        char *end = strchr(rest, '\n');
        if (whole.entries[i].gone) {
            continue; /* strange */
        }
        assert_non_null(end);
        *end = 0;
        json_t *object = json_loads(rest, JSON_REJECT_DUPLICATES, &error);
        if (object == NULL) {
            fail_msg("line %zu: %s: %s", i, error.text, rest);
        }
        check_object(object, &whole.entries[i]);
        json_decref(object);
        rest = end + 1;
    }
    assert_non_null(strstr(rest, "tahr: heard "));
    assert_non_null(strstr(rest, "; 0 lost on the way"));
    assert_non_null(strstr(rest, "ignored 2 messages of another package or version"));
    free(text);
}

static size_t lines_of(const char *text, const char *with)
{
    size_t count = 0;
    for (const char *at = text; (at = strstr(at, with)) != NULL; at++) {
        count++;
    }
    return count;
}

static void a_glob_and_a_count_choose(void **state)
{
    (void)state;
    assert_int_equal(captured(listen_command, (const char *const[]){"listen", "--lcm", url, "--channel", "*STATE",
                                                                    "--count", "50", NULL}),
                     EXIT_GOOD);
    char *text = captured_text();
    assert_int_equal(lines_of(text, "TAHR_STATE "), 50);
    assert_int_equal(lines_of(text, "\n"), 51); /* with the summary */
    free(text);
    assert_int_equal(captured(listen_command, (const char *const[]){"listen", "--lcm", url, "--channel", "TAHR_WORLD",
                                                                    "--count", "1000000", NULL}),
                     EXIT_CHECK_FAILED);
    assert_said("--count 1000000: only ");
}

static void a_record_of_a_log_is_the_log(void **state)
{
    struct log_copy again = {0};
    (void)state;
    assert_int_equal(captured(record_command, (const char *const[]){"record", "--lcm", url, copy, NULL}), EXIT_GOOD);
    assert_said(" of another package or version 2\n");
    log_copy_read(&again, copy);
    assert_int_equal(again.count, whole.count);
    for (size_t i = 0; i < again.count; i++) {
        assert_string_equal(again.entries[i].channel, whole.entries[i].channel);
        assert_int_equal(again.entries[i].size, whole.entries[i].size);
        assert_memory_equal(again.entries[i].data, whole.entries[i].data, again.entries[i].size);
    }
    log_copy_free(&again);
    assert_int_equal(
        captured(record_command, (const char *const[]){"record", "--lcm", url, "--channel", "POSE", copy, NULL}),
        EXIT_GOOD);
    assert_said(": 0 messages, ");
}

static void hear_state(struct roster *roster, const char *channel, int32_t character, int64_t sequence)
{
    struct message m = {.kind = TAHR_MESSAGE_STATE,
                        .character = character,
                        .step = sequence,
                        .sequence = sequence,
                        .prefix = strlen(channel) - strlen("TAHR_STATE"),
                        .is.state = {.character = character, .step = sequence, .mode = TAHR_MODE_WALKING}};
    roster_hear(roster, &m, channel);
}

static void a_number_left_out_is_a_message_lost(void **state)
{
    struct roster roster = {0};
    (void)state;
    hear_state(&roster, "TAHR_STATE", 7, 100); /* who comes late has lost nothing */
    hear_state(&roster, "TAHR_STATE", 7, 101);
    hear_state(&roster, "TAHR_STATE", 7, 105);
    hear_state(&roster, "TAHR_STATE", 8, 3);
    hear_state(&roster, "B_TAHR_STATE", 7, 200); /* somebody else's */
    hear_state(&roster, "TAHR_STATE", 7, 0);     /* begins anew */
    hear_state(&roster, "TAHR_STATE", 7, 2);
    assert_int_equal(roster.lost, 4);
    assert_int_equal(roster.publisher_count, 2);
    assert_int_equal(roster.publishers[0].rows[7]->lost, 4);
    assert_int_equal(roster.publishers[1].rows[7]->lost, 0);
    assert_int_equal(roster.messages, 7);
    hear_state(&roster, "TAHR_STATE", -1, 0);
    hear_state(&roster, "TAHR_STATE", 1 << 20, 0);
    assert_int_equal(roster.strange, 2);
    hear_state(&roster, "TAHR_STATE", 3, INT64_MAX);
    hear_state(&roster, "TAHR_STATE", 3, 0);
    assert_int_equal(roster.lost, 4);
    roster_close(&roster);
}

static void a_body_left_out_of_a_change_is_a_message_lost(void **state)
{
    struct roster roster = {0};
    static const int64_t heard[][2] = {{4, 0}, {4, 1}, {5, 0}, {5, 2}, {6, 0}, {6, 1}, {6, 2}, {9, 0}};
    (void)state;
    for (size_t i = 0; i < sizeof heard / sizeof *heard; i++) {
        struct message m = {
            .kind = TAHR_MESSAGE_BODY,
            .character = -1,
            .is.body = {.epoch = heard[i][0], .index = (int32_t)heard[i][1], .count = 3, .kind = TAHR_BODY_T_MOVE}};
        roster_hear(&roster, &m, "TAHR_BODY");
    }
    assert_int_equal(roster.lost, 1 + 1 + 2); /* of 4 and 5 one each; 7 and 8 */
    roster_close(&roster);
}

static struct roster shown;

static int draw_command(int argc, char **argv)
{
    struct table table = {0};
    (void)argc;
    table_draw(&table, &shown, argv[0], 1);
    table_draw(&table, &shown, argv[0], 1);
    return table.drawn;
}

static void a_table_is_drawn_over_itself_and_says_what_does_not_fit(void **state)
{
    (void)state;
    for (int32_t i = 0; i < 40; i++) {
        hear_state(&shown, "TAHR_STATE", i, 0);
    }
    /* No terminal: 80 x 24, of which one line stays free. */
    assert_int_equal(captured(draw_command, (const char *const[]){"a title", NULL}), 23);
    char *text = captured_text();
    assert_int_equal(lines_of(text, "\n"), 2 * 23);
    assert_int_equal(lines_of(text, "\033[23A\r"), 1);
    assert_int_equal(lines_of(text, "walking"), 2 * 18);
    assert_int_equal(lines_of(text, " ... and 22 more"), 2);
    for (char *line = text; line != NULL; line = strchr(line + 1, '\n')) {
        assert_true(strcspn(line + 1, "\033\n") <= 79);
    }
    free(text);
    roster_close(&shown);
}

static void write_log(void)
{
    char to[80];
    snprintf(to, sizeof to, "file://%s", path);
    assert_int_equal(captured(run_command, (const char *const[]){"run", "--characters", "20", "--seconds", "2",
                                                                 "--check", "off", "--lcm", to, NULL}),
                     EXIT_GOOD);
    log_copy_read(&whole, path);
    log_copy_add(&whole, "TAHR_STATE", "12345678 of another package", 27);
    log_copy_add(&whole, "TAHR_WORLD", "", 0);
    log_copy_write(&whole, path);
    whole.entries[whole.count - 1].gone = whole.entries[whole.count - 2].gone = 1;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_message_is_one_json_object_with_all_that_it_holds),
        cmocka_unit_test(a_glob_and_a_count_choose),
        cmocka_unit_test(a_record_of_a_log_is_the_log),
        cmocka_unit_test(a_number_left_out_is_a_message_lost),
        cmocka_unit_test(a_body_left_out_of_a_change_is_a_message_lost),
        cmocka_unit_test(a_table_is_drawn_over_itself_and_says_what_does_not_fit),
    };
    if (mkdtemp(folder) == NULL) {
        return 1;
    }
    snprintf(path, sizeof path, "%s/a.lcmlog", folder);
    snprintf(copy, sizeof copy, "%s/b.lcmlog", folder);
    snprintf(url, sizeof url, "file://%s?speed=0", path);
    write_log();
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    log_copy_free(&whole);
    remove(path);
    remove(copy);
    rmdir(folder);
    return failed;
}

#else

int main(void)
{
    puts("SKIP: cli_lcm_listen: this tahr was built without LCM");
    return 77;
}

#endif
