/* SPDX-License-Identifier: MIT
 * main.c: `tahr`, the library's shell. */
#include "info.h"
#include "levels.h"
#include "options.h"
#include "replay.h"
#include "run.h"
#include "say.h"
#include "selftest.h"

#include <stdio.h>
#include <string.h>
#include <tahr/tahr.h>

static int help_command(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], "run") == 0) {
        options_help();
        return EXIT_GOOD;
    }
    if (argc > 1 && strcmp(argv[1], "selftest") == 0) {
        selftest_help();
        return EXIT_GOOD;
    }
    if (argc > 1 && strcmp(argv[1], "replay") == 0) {
        replay_help();
        return EXIT_GOOD;
    }
    puts("usage: tahr COMMAND [options]\n"
         "\n"
         "  run              characters walk through a level; see `tahr run --help`\n"
         "  replay FILE      repeats a run from the file that `tahr run --trace FILE` or a program left\n"
         "  level [NAME]     writes a bundled level to standard output\n"
         "  info [--json]    version, ABI, collision engines and what they can do\n"
         "  selftest NAME    does a backend keep its promises? see `tahr selftest --help`\n"
         "  help [COMMAND]   this text, or the options of run, replay or selftest\n"
         "  --version\n");
    return EXIT_GOOD;
}

static int version_command(int argc, char **argv)
{
    (void)argc;
    (void)argv;
    printf("tahr %s\n", tahr_version());
    return EXIT_GOOD;
}

static const struct {
    const char *name;
    int (*call)(int argc, char **argv);
} commands[] = {
    {"run", run_command},     {"replay", replay_command},     {"level", level_command},
    {"info", info_command},   {"selftest", selftest_command}, {"help", help_command},
    {"--help", help_command}, {"-h", help_command},           {"--version", version_command},
};

int main(int argc, char **argv)
{
    if (tahr_abi_check(TAHR_ABI) != TAHR_OK) {
        say_error("this shell needs ABI %d.%d, but the library is %s", TAHR_ABI_MAJOR, TAHR_ABI_MINOR, tahr_version());
        return EXIT_CHECK_FAILED;
    }
    if (argc < 2) {
        help_command(0, NULL);
        return EXIT_USAGE;
    }
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
        if (strcmp(commands[i].name, argv[1]) == 0) {
            int code = commands[i].call(argc - 1, argv + 1);
            if (fflush(stdout) != 0) {
                say_error("cannot write to standard output");
                return EXIT_CHECK_FAILED;
            }
            return code;
        }
    }
    say_error("unknown command '%s'; known are run, replay, level, info, selftest, help, --version", argv[1]);
    return EXIT_USAGE;
}
