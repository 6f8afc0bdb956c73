/* SPDX-License-Identifier: MIT
 * selftest.c: `tahr selftest`: the conformance kit on a backend of this shell, or on a shared object. */
#include "selftest.h"

#include "backends.h"
#include "say.h"

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <tahr/plugin.h>
#include <tahr/selftest.h>
#include <tahr/tahr.h>

static const char *const verdicts[] = {"pass", "FAIL", "not supported"};

/* What was asked for, and what came of it so far. */
struct selftest {
    const char *target, *only;
    int json;
    double gap_tolerance; /* m, or 0 */
    json_t *cases;        /* with json */
    unsigned counts[3];   /* by verdict */
};

void selftest_help(void)
{
    puts("usage: tahr selftest NAME|PATH.so [options]\n"
         "\n"
         "Runs the conformance kit on a backend: small scenes whose answers are known, one promise each.\n"
         "NAME is one that `tahr info` lists; whatever has a slash or ends in .so is loaded as a plugin.\n"
         "\n"
         "  --only PREFIX     the cases whose name begins so\n"
         "  --gap METRES      what distances may be off by (default 9e-5, for a character 1.8 m high)\n"
         "  --json            one JSON object instead of a table\n"
         "\n"
         "Exit code: 0 all that is claimed is kept, 1 a case failed or the plugin cannot be loaded, 2 wrong usage.");
}

static void print_case(void *user, const tahr_selftest_result *result)
{
    struct selftest *test = user;
    uint32_t verdict = result->verdict < 3 ? result->verdict : TAHR_SELFTEST_FAIL;
    test->counts[verdict]++;
    if (test->json) {
        static const char *const words[] = {"pass", "fail", "not_supported"};
        json_t *entry = json_object();
        json_object_set_new(entry, "case", json_string(result->name));
        json_object_set_new(entry, "verdict", json_string(words[verdict]));
        json_object_set_new(entry, "expected", json_string(result->expected));
        json_object_set_new(entry, "actual", json_string(result->actual));
        json_array_append_new(test->cases, entry);
    } else if (verdict == TAHR_SELFTEST_NOT_SUPPORTED) {
        printf("%-34s %-14s lacks %s\n", result->name, verdicts[verdict], result->actual);
    } else {
        printf("%-34s %-14s expected %s\n%-34s %-14s actual   %s\n", result->name, verdicts[verdict], result->expected,
               "", "", result->actual);
    }
}

/* 0, or an exit code after a message. */
static int read_options(struct selftest *test, int argc, char **argv)
{
    for (int i = 1; i < argc; i++) {
        const char *word = argv[i];
        if (strcmp(word, "--json") == 0) {
            test->json = 1;
        } else if (strcmp(word, "--only") == 0 || strcmp(word, "--gap") == 0) {
            if (++i == argc) {
                say_error("selftest: %s needs a value", word);
                return EXIT_USAGE;
            }
            if (strcmp(word, "--only") == 0) {
                test->only = argv[i];
                continue;
            }
            char *end;
            test->gap_tolerance = strtod(argv[i], &end);
            if (end == argv[i] || *end || !(test->gap_tolerance > 0 && test->gap_tolerance <= 0.1)) {
                say_error("selftest: --gap '%s' is not a number of metres up to 0.1", argv[i]);
                return EXIT_USAGE;
            }
        } else if (word[0] == '-' || test->target) {
            say_error("selftest: unexpected argument '%s'; see `tahr selftest --help`", word);
            return EXIT_USAGE;
        } else {
            test->target = word;
        }
    }
    if (!test->target) {
        say_error("selftest: which backend? `tahr info` lists those of this shell; or the path of a shared object");
        return EXIT_USAGE;
    }
    return 0;
}

static void print_json(struct selftest *test, const tahr_backend *backend)
{
    json_t *root = json_object();
    json_object_set_new(root, "backend", json_string(backend->name));
    json_object_set_new(root, "version", json_string(backend->version));
    json_object_set_new(root, "passed", json_integer(test->counts[TAHR_SELFTEST_PASS]));
    json_object_set_new(root, "failed", json_integer(test->counts[TAHR_SELFTEST_FAIL]));
    json_object_set_new(root, "not_supported", json_integer(test->counts[TAHR_SELFTEST_NOT_SUPPORTED]));
    json_object_set(root, "cases", test->cases);
    json_dumpf(root, stdout, JSON_INDENT(2));
    putchar('\n');
    json_decref(root);
}

static int run(struct selftest *test, const tahr_backend *backend, const void *options)
{
    const tahr_log log = say_log();
    tahr_selftest_desc desc = {.struct_size = sizeof desc,
                               .options = options,
                               .gap_tolerance = test->gap_tolerance,
                               .only = test->only,
                               .report = print_case,
                               .user = test};
    desc.log = NULL; /* what the worlds of failed cases say is in the texts of the cases */
    tahr_status status = tahr_backend_selftest(backend, &desc, NULL);
    if (status < 0) {
        desc.log = &log;
        tahr_backend_selftest(backend, &desc, NULL); /* refused again, aloud: nothing has run */
        return test->only && status == TAHR_E_ARGUMENT ? EXIT_USAGE : EXIT_CHECK_FAILED;
    }
    if (test->json) {
        print_json(test, backend);
    } else {
        printf("%s %s: %u passed, %u failed, %u not supported\n", backend->name, backend->version,
               test->counts[TAHR_SELFTEST_PASS], test->counts[TAHR_SELFTEST_FAIL],
               test->counts[TAHR_SELFTEST_NOT_SUPPORTED]);
    }
    if (!test->only && test->counts[TAHR_SELFTEST_PASS] == 0 && test->counts[TAHR_SELFTEST_FAIL] == 0) {
        say_error("tahr selftest: %s opens none of the worlds that the cases are about: nothing was tested",
                  backend->name);
        return EXIT_CHECK_FAILED;
    }
    return test->counts[TAHR_SELFTEST_FAIL] ? EXIT_CHECK_FAILED : EXIT_GOOD;
}

static int run_plugin(struct selftest *test)
{
    const tahr_log log = say_log();
    tahr_plugin *plugin = NULL;
    tahr_status status = tahr_plugin_load(test->target, &log, &plugin);
    if (status < 0) {
        say_error("selftest: cannot load '%s': %s", test->target, tahr_status_message(status));
        return EXIT_CHECK_FAILED;
    }
    int code = run(test, tahr_plugin_backend(plugin), NULL);
    tahr_plugin_unload(plugin);
    return code;
}

static int run_named(struct selftest *test)
{
    const struct backend_choice *choice = backend_choice_find(test->target);
    if (!choice) {
        say_error("selftest: no backend '%s' in this shell; `tahr info` lists them, a plugin is given by its path",
                  test->target);
        return EXIT_USAGE;
    }
    return run(test, choice->get(), choice->options);
}

int selftest_command(int argc, char **argv)
{
    struct selftest test = {0};
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0) {
            selftest_help();
            return EXIT_GOOD;
        }
    }
    int code = read_options(&test, argc, argv);
    if (code) {
        return code;
    }
    test.cases = test.json ? json_array() : NULL;
    code = backend_is_path(test.target) ? run_plugin(&test) : run_named(&test);
    json_decref(test.cases);
    return code;
}
