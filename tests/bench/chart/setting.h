/* SPDX-License-Identifier: MIT
 * setting.h: everything that a user may set about whole movement: a configuration, a backend with its options, a rate.
 */
#ifndef TAHR_CHART_SETTING_H
#define TAHR_CHART_SETTING_H

#include <tahr/tahr.h>

#include "bench_world.h"
#include "subject.h"

typedef struct chart_setting {
    char curve[48], name[64];
    const char *role;
    double value; /* of the knob */
    double rate;  /* Hz */
    tahr_config config;
    const tahr_backend *(*get)(void);
    chart_options options; /* words[0] 0: none */
    int slow;              /* a step takes tens of microseconds */
} chart_setting;

/* The settings of a level, along the curves; those of planes for planar levels. Returns how many; settings are valid
 * until the next call. */
uint32_t chart_settings_make(const bench_world *level, const chart_setting **settings);

/* The default of a level: its preset on native, 60 Hz. */
void chart_setting_default(const bench_world *level, chart_setting *setting);

/* The same numbers by the exact methods on native, at a high rate: what the methods are judged by. The
 * integrator stays: who pushes along a wall ends at another speed with STEPPED than with EXACT, however short a step is;
 * that is a definition and no error. */
void chart_setting_reference(const chart_setting *setting, chart_setting *reference);

/* Makes one of bench_world.h's by its name. */
void chart_level_make(bench_world *level, const char *name);

/* Opens a level on a setting's backend. */
tahr_status chart_setting_open(const chart_setting *setting, const bench_world *level, tahr_world **world);

#endif
