/* SPDX-License-Identifier: MIT
 * info.c: `tahr info`: version, ABI, presets, collision engines and what they can do; what a level is made of. */
#include "info.h"

#include "json_values.h"
#include "options.h"
#include "run.h"
#include "say.h"

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <tahr/tahr.h>

static void print_capability(void *user, const char *name)
{
    (void)user;
    printf(" %s", name);
}

static void append_capability(void *user, const char *name)
{
    json_array_append_new(user, json_string(name));
}

static void info_words(void)
{
    printf("tahr %s, ABI %d.%d\n", tahr_version(), TAHR_ABI_MAJOR, TAHR_ABI_MINOR);
    printf("presets:");
    for (int32_t id = 1; strcmp(tahr_preset_name(id), "?") != 0; id++) {
        printf(" %s", tahr_preset_name(id));
    }
    puts("\nbackends:");
    for (size_t i = 0; backend_choice_at(i) != NULL; i++) {
        const struct backend_choice *choice = backend_choice_at(i);
        const tahr_backend *backend = backend_table(choice);
        printf("  %-14s %s %s, ABI %u.%u: %s\n                ", choice->name, backend->name, backend->version,
               (unsigned)backend->abi_major, (unsigned)backend->abi_minor, choice->about);
        backend_capabilities(backend, print_capability, NULL);
        putchar('\n');
    }
}

static void info_json(void)
{
    json_t *root = json_object(), *presets = json_array(), *backends = json_array();
    char abi[32];
    snprintf(abi, sizeof abi, "%d.%d", TAHR_ABI_MAJOR, TAHR_ABI_MINOR);
    for (int32_t id = 1; strcmp(tahr_preset_name(id), "?") != 0; id++) {
        json_array_append_new(presets, json_string(tahr_preset_name(id)));
    }
    for (size_t i = 0; backend_choice_at(i) != NULL; i++) {
        const struct backend_choice *choice = backend_choice_at(i);
        const tahr_backend *backend = backend_table(choice);
        json_t *entry = json_object(), *able = json_array();
        char backend_abi[32];
        snprintf(backend_abi, sizeof backend_abi, "%u.%u", (unsigned)backend->abi_major, (unsigned)backend->abi_minor);
        backend_capabilities(backend, append_capability, able);
        json_object_set_new(entry, "name", json_string(choice->name));
        json_object_set_new(entry, "engine", json_string(backend->name));
        json_object_set_new(entry, "version", json_string(backend->version));
        json_object_set_new(entry, "abi", json_string(backend_abi));
        json_object_set_new(entry, "capabilities", able);
        json_array_append_new(backends, entry);
    }
    json_object_set_new(root, "version", json_string(tahr_version()));
    json_object_set_new(root, "abi", json_string(abi));
    json_object_set_new(root, "presets", presets);
    json_object_set_new(root, "backends", backends);
    json_dumpf(root, stdout, JSON_INDENT(2));
    putchar('\n');
    json_decref(root);
}

static void print_line(void *user, int32_t level, const char *text)
{
    (void)user;
    (void)level;
    puts(text);
}

static void append_line(void *user, int32_t level, const char *text)
{
    (void)level;
    json_array_append_new(user, json_text(text));
}

static int describe_level(const struct options *options, int json)
{
    json_t *lines = json ? json_array() : NULL;
    tahr_log to = {lines, json ? append_line : print_line};
    int failed = run_describe(options, &to);
    if (json && !failed) {
        json_t *root = json_object();
        json_object_set(root, "scene", lines);
        json_dumpf(root, stdout, JSON_INDENT(2));
        putchar('\n');
        json_decref(root);
    }
    json_decref(lines);
    return failed ? EXIT_USAGE : EXIT_GOOD;
}

static int info_level(int argc, char **argv, int json)
{
    struct options options;
    int code = options_parse(&options, argc, argv) == 0 ? describe_level(&options, json) : EXIT_USAGE;
    options_close(&options);
    return code;
}

void info_help(void)
{
    puts(
        "usage: tahr info [--json]\n"
        "       tahr info [--json] [--level FILE] [--up y|z] [--2d [--pixels-per-metre P] [--tiles MODE]] "
        "[--backend NAME]\n"
        "\n"
        "Version, ABI, presets, and the collision engines that this shell was built with: what `--backend` and\n"
        "`tahr selftest` take, with their capabilities (TAHR_CAP_* of tahr/backend.h).\n"
        "\n"
        "With --level, or another option of a level (then the bundled playground; with --2d the bundled "
        "side-scroller):\n"
        "its hash, as logs of LCM tell it; what the scene is made of as the backend opens it, and which way queries\n"
        "go through it and why: triangles and how they meet, what was dropped, bytes per triangle, the densest place,\n"
        "fields of heights.");
}

int info_command(int argc, char **argv)
{
    if (argc == 2 && (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0)) {
        info_help();
        return EXIT_GOOD;
    }
    char **of_level = memory_new((size_t)argc + 1, sizeof *of_level);
    const int level = options_of_level(&argc, argv, of_level);
    const int json = argc > 1 && strcmp(argv[1], "--json") == 0;
    int code = EXIT_GOOD;
    if (argc > 1 + json) {
        say_error("info: unexpected argument '%s'; known are --json and, of a level, --level, --up, --backend and --2d "
                  "--pixels-per-metre --tiles",
                  argv[1 + json]);
        code = EXIT_USAGE;
    } else if (level > 1) {
        code = info_level(level, of_level, json);
    } else if (json) {
        info_json();
    } else {
        info_words();
    }
    free(of_level);
    return code;
}
