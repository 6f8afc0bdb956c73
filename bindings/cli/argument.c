/* SPDX-License-Identifier: MIT
 * argument.c: the values of options, read strictly. */
#include "argument.h"

#include "say.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>

int argument_refuse(const char *option, const char *value, const char *wanted)
{
    say_error("--%s '%s': %s", option, value, wanted);
    return -1;
}

int argument_number(const char *option, const char *text, double low, double high, double *value)
{
    char *end = NULL;
    errno = 0;
    double x = strtod(text, &end);
    if (end == text || *end != '\0' || errno != 0 || !(x >= low && x <= high)) {
        char wanted[80];
        snprintf(wanted, sizeof wanted, "expected a number from %g to %g", low, high);
        return argument_refuse(option, text, wanted);
    }
    *value = x;
    return 0;
}

int argument_whole(const char *option, const char *text, uint64_t low, uint64_t high, uint64_t *value)
{
    char *end = NULL;
    errno = 0;
    unsigned long long x = text[0] >= '0' && text[0] <= '9' ? strtoull(text, &end, 10) : 0;
    if (end == NULL || *end != '\0' || errno != 0 || x < low || x > high) {
        char wanted[80];
        snprintf(wanted, sizeof wanted, "expected a whole number from %llu to %llu", (unsigned long long)low,
                 (unsigned long long)high);
        return argument_refuse(option, text, wanted);
    }
    *value = x;
    return 0;
}

int argument_next(int argc, char **argv, const struct option *known)
{
    opterr = 0;
    int option = getopt_long(argc, argv, ":", known, NULL);
    if (option == ':') {
        say_error("option '%s' needs a value", argv[optind - 1]);
        return '?';
    }
    if (option == '?') {
        fprintf(stderr, "tahr: unknown option '%s'; known are:", argv[optind - 1]);
        for (size_t i = 0; known[i].name != NULL; i++) {
            fprintf(stderr, " --%s", known[i].name);
        }
        fputc('\n', stderr);
    }
    return option;
}
