/* SPDX-License-Identifier: MIT
 * machine.c: what was measured on. */
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <tahr/tahr.h>

#include "run.h"

#ifndef TAHR_CHART_FLAGS
#define TAHR_CHART_FLAGS "?"
#endif

enum { ADDITIONS = 8, ROUNDS = 10, TURNS = 2000000 };

/* MHz, by additions that depend on each other: one cycle each on every processor that this runs on. */
static double megahertz(void)
{
    double best = 0;
#if defined(__GNUC__)
    for (int round = 0; round < ROUNDS; round++) {
        uint64_t x = 1;
        double before = chart_monotonic();
        for (int i = 0; i < TURNS; i++) {
            for (int k = 0; k < ADDITIONS; k++) {
                x += x;
                __asm__ volatile("" : "+r"(x));
            }
        }
        double rate = 1e-6 * ADDITIONS * TURNS / (chart_monotonic() - before);
        best = rate > best ? rate : best;
    }
#endif
    return best;
}

/* The value of a line "key : value" of a file of Linux. */
static void look_up(const char *path, const char *key, char *value, size_t capacity)
{
    char line[512];
    FILE *file = fopen(path, "r");
    snprintf(value, capacity, "?");
    while (file && fgets(line, sizeof line, file)) {
        char *colon = strchr(line, ':');
        if (strncmp(line, key, strlen(key)) == 0 && colon) {
            snprintf(value, capacity, "%s", colon + 1 + strspn(colon + 1, " \t"));
            value[strcspn(value, "\n")] = '\0';
            break;
        }
    }
    if (file) fclose(file);
}

/* Fields are quoted: flags have commas in them. */
static void put(FILE *csv, const char *key, const char *value)
{
    fprintf(csv, "%s,\"", key);
    for (; *value; value++) {
        fprintf(csv, *value == '"' ? "\"\"" : "%c", *value);
    }
    fprintf(csv, "\"\n");
}

void chart_machine(FILE *csv)
{
    char text[256];
    fprintf(csv, "key,value\n");
    look_up("/proc/cpuinfo", "model name", text, sizeof text);
    put(csv, "processor", text);
    snprintf(text, sizeof text, "%.0f MHz, by dependent additions", megahertz());
    put(csv, "clock", text);
    snprintf(text, sizeof text, "%ld", sysconf(_SC_NPROCESSORS_ONLN));
    put(csv, "processors", text);
    look_up("/proc/meminfo", "MemTotal", text, sizeof text);
    put(csv, "memory", text);
#if defined(__clang__)
    snprintf(text, sizeof text, "clang %s", __clang_version__);
#elif defined(__GNUC__)
    snprintf(text, sizeof text, "gcc %s", __VERSION__);
#else
    snprintf(text, sizeof text, "?");
#endif
    put(csv, "compiler", text);
    put(csv, "flags", TAHR_CHART_FLAGS);
    snprintf(text, sizeof text, "%d.%d", TAHR_ABI_MAJOR, TAHR_ABI_MINOR);
    put(csv, "ABI of Tahr", text);
    snprintf(text, sizeof text, "%.0f ns, subtracted", chart_clock_cost());
    put(csv, "reading the clock twice", text);
}
