/* SPDX-License-Identifier: MIT
 * main.c: `tahr`, the library's shell. */
#include "info.h"
#ifdef TAHR_HAVE_LCM
#include "lcm/listen.h"
#include "lcm/record.h"
#endif
#include "levels.h"
#include "options.h"
#include "replay.h"
#include "run.h"
#include "say.h"
#include "selftest.h"

#include <stdio.h>
#include <string.h>
#include <tahr/tahr.h>

static int help_command(int argc, char **argv);
static int version_command(int argc, char **argv);

#ifndef TAHR_HAVE_LCM
static int lcm_command(int argc, char **argv)
{
    (void)argc;
    say_error("%s: this tahr was built without LCM", argv[0]);
    return EXIT_USAGE;
}

static void lcm_help(void)
{
    puts("This tahr was built without LCM.");
}
#define listen_command lcm_command
#define record_command lcm_command
#define listen_help lcm_help
#define record_help lcm_help
#endif

static const struct {
    const char *name;
    int (*call)(int argc, char **argv);
    void (*help)(void);
} commands[] = {
    {"run", run_command, options_help},
    {"listen", listen_command, listen_help},
    {"record", record_command, record_help},
    {"replay", replay_command, replay_help},
    {"level", level_command, level_help},
    {"info", info_command, info_help},
    {"selftest", selftest_command, selftest_help},
    {"help", help_command, NULL},
    {"--help", help_command, NULL},
    {"-h", help_command, NULL},
    {"--version", version_command, NULL},
};
enum { COMMANDS = sizeof commands / sizeof *commands };

static int complain_unknown(const char *command)
{
    say_error("unknown command '%s'; known are run, listen, record, replay, level, info, selftest, help, --version",
              command);
    return EXIT_USAGE;
}

static void print_commands(void)
{
    puts("usage: tahr COMMAND [options]\n"
         "\n"
         "  run              characters walk through a level; see `tahr run --help`\n"
         "  listen           shows what characters do elsewhere, over LCM; see `tahr listen --help`\n"
         "  record FILE      keeps what is published over LCM as a log\n"
         "  replay FILE      repeats a run from the file that `tahr run --trace FILE` or a program left; plays a\n"
         "                   log of LCM, or proves it by taking every step again; see `tahr replay --help`\n"
         "  level [NAME]     writes a bundled level to standard output\n"
         "  info [--json]    version, ABI, collision engines and what they can do; --level FILE: what a scene is made "
         "of\n"
         "  selftest NAME    does a backend keep its promises? see `tahr selftest --help`\n"
         "  help [COMMAND]   this text, or that of one command\n"
         "  --version");
}

static int help_command(int argc, char **argv)
{
    if (argc < 2) {
        print_commands();
        return EXIT_GOOD;
    }
    for (size_t i = 0; i < COMMANDS; i++) {
        if (commands[i].help != NULL && strcmp(commands[i].name, argv[1]) == 0) {
            commands[i].help();
            return EXIT_GOOD;
        }
    }
    return complain_unknown(argv[1]);
}

static int version_command(int argc, char **argv)
{
    if (argc > 1) {
        say_error("--version: unexpected argument '%s'", argv[1]);
        return EXIT_USAGE;
    }
    printf("tahr %s\n", tahr_version());
    return EXIT_GOOD;
}

int main(int argc, char **argv)
{
    if (tahr_abi_check(TAHR_ABI) != TAHR_OK) {
        say_error("this shell needs ABI %d.%d, but the library is %s", TAHR_ABI_MAJOR, TAHR_ABI_MINOR, tahr_version());
        return EXIT_CHECK_FAILED;
    }
    if (argc < 2) {
        print_commands();
        return EXIT_USAGE;
    }
    for (size_t i = 0; i < COMMANDS; i++) {
        if (strcmp(commands[i].name, argv[1]) == 0) {
            int code = commands[i].call(argc - 1, argv + 1);
            if (fflush(stdout) != 0 || ferror(stdout)) {
                say_error("cannot write to standard output");
                return EXIT_CHECK_FAILED;
            }
            return code;
        }
    }
    return complain_unknown(argv[1]);
}
