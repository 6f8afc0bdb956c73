/* SPDX-License-Identifier: MIT
 * setting.c: the table of settings. What is not named in a row is the default of the level's preset. */
#include "setting.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "row.h"

enum { MAX_SETTINGS = 160, MAX_VALUES = 9 };
enum { A_DOUBLE, AN_INTEGER };

static chart_setting settings[MAX_SETTINGS];
static uint32_t setting_count;

/* All of them divide 0.1 s, at whose multiples paths are compared. */
static const double RATES[] = {10, 20, 30, 60, 120, 240, 480, 1000};
enum { RATE_COUNT = sizeof RATES / sizeof RATES[0] };

/* Hz, of references. STEPPED is of the first order: 7680 Hz leave 0.4 mm (of 6 m/s reached at 20 m/s2). */
static const double EXACT_RATE = 1920, STEPPED_RATE = 7680;

/* A number of the configuration and what it is set to. */
typedef struct knob {
    const char *curve, *format, *role;
    size_t offset;
    int kind;
    double unit, rate;
    uint32_t integrator;
    double values[MAX_VALUES]; /* up to the first 0 */
} knob;

#define FIELD(name) offsetof(tahr_config, name)
static const knob KNOBS[] = {
    {"skin",
     "skin %g mm",
     CHART_DEFINITION,
     FIELD(skin),
     A_DOUBLE,
     1e-3,
     60,
     TAHR_INTEGRATOR_EXACT,
     {0.1, 0.2, 0.5, 1, 2, 5, 10, 20}},
    {"max_slides",
     "max_slides %g",
     CHART_KNOB,
     FIELD(max_slides),
     AN_INTEGER,
     1,
     60,
     TAHR_INTEGRATOR_EXACT,
     {1, 2, 3, 4, 6, 8}},
    {"path_tolerance",
     "path_tolerance %g mm",
     CHART_KNOB,
     FIELD(path_tolerance),
     A_DOUBLE,
     1e-3,
     60,
     TAHR_INTEGRATOR_EXACT,
     {0.01, 0.1, 0.5, 2, 8}},
    {"arc_tolerance; 20 Hz",
     "arc_tolerance %g mm; 20 Hz",
     CHART_KNOB,
     FIELD(arc_tolerance),
     A_DOUBLE,
     1e-3,
     20,
     TAHR_INTEGRATOR_EXACT,
     {0.01, 0.1, 1, 10, 100}},
    {"max_substep; stepped; 10 Hz",
     "max_substep %g ms; stepped; 10 Hz",
     CHART_PARITY,
     FIELD(max_substep),
     A_DOUBLE,
     1e-3,
     10,
     TAHR_INTEGRATOR_STEPPED,
     {2, 5, 10, 20, 50, 100}},
    {"max_substeps; stepped; 10 Hz",
     "max_substeps %g; stepped; 10 Hz",
     CHART_PARITY,
     FIELD(max_substeps),
     AN_INTEGER,
     1,
     10,
     TAHR_INTEGRATOR_STEPPED,
     {1, 2, 4, 8, 16, 32, 64}},
};

static chart_setting *add(const chart_setting *base, const char *curve, const char *name, const char *role)
{
    chart_setting *s = &settings[setting_count++];
    *s = *base;
    snprintf(s->curve, sizeof s->curve, "%s", curve);
    snprintf(s->name, sizeof s->name, "%s", name);
    s->role = role;
    s->value = NAN;
    return s;
}

static void set_options(chart_setting *s, const void *options, size_t size)
{
    memset(&s->options, 0, sizeof s->options);
    memcpy(&s->options, options, size);
}

static void add_rates(const chart_setting *base, const char *curve, const char *role)
{
    for (int i = 0; i < RATE_COUNT; i++) {
        chart_setting *s = add(base, curve, "", role);
        snprintf(s->name, sizeof s->name, "%s; %g Hz", curve, RATES[i]);
        s->value = s->rate = RATES[i];
    }
}

static void add_knob(const chart_setting *base, const knob *k)
{
    for (int i = 0; i < MAX_VALUES && k->values[i] > 0; i++) {
        chart_setting *s = add(base, k->curve, "", k->role);
        char *field = (char *)&s->config + k->offset;
        double value = k->values[i] * k->unit;
        uint32_t whole = (uint32_t)value;
        snprintf(s->name, sizeof s->name, k->format, k->values[i]);
        s->rate = k->rate;
        s->value = k->values[i];
        s->config.integrator = k->integrator;
        if (k->integrator == TAHR_INTEGRATOR_STEPPED) { /* neither limits the other */
            s->config.max_substeps = 64;
            s->config.max_substep = 1.0 / 640;
        }
        if (k->kind == A_DOUBLE) {
            memcpy(field, &value, sizeof value);
        } else {
            memcpy(field, &whole, sizeof whole);
        }
    }
}

/* One method at a time changed to that of another library. */
static void add_methods(const chart_setting *base)
{
    chart_setting s = *base;
    s.config.integrator = TAHR_INTEGRATOR_STEPPED;
    add_rates(&s, "stepped", CHART_PARITY);
    s = *base;
    s.config.slide_solver = TAHR_SLIDE_TWO_WALLS;
    add_rates(&s, "two walls", CHART_PARITY);
    s = *base;
    tahr_config_init(&s.config, sizeof s.config, TAHR_PRESET_UNREAL);
    add_rates(&s, "unreal", CHART_PARITY);
    add(base, "methods", "separation: pull back", CHART_PARITY)->config.separation = TAHR_SEPARATION_PULL_BACK;
    add(base, "methods", "depenetration: single", CHART_PARITY)->config.depenetration = TAHR_DEPENETRATION_SINGLE;
    add(base, "methods", "step rule: contact", CHART_PARITY)->config.step_rule = TAHR_STEP_BY_CONTACT;
    chart_setting *shrunk = add(base, "methods", "floor probe: shrunk; pull back", CHART_PARITY);
    shrunk->config.floor_probe = TAHR_FLOOR_PROBE_SHRUNK;
    shrunk->config.separation = TAHR_SEPARATION_PULL_BACK;
}

static void add_switches(const chart_setting *base)
{
    tahr_native_desc native = {.struct_size = sizeof native, .no_cache = 1};
    add(base, "switches", "cached_floor 0", CHART_OFF)->config.cached_floor = 0;
    add(base, "switches", "sleep 0", CHART_OFF)->config.sleep = 0;
    add(base, "path_tolerance", "path_tolerance 0", CHART_OFF)->config.path_tolerance = 0;
    set_options(add(base, "switches", "no_cache", CHART_OFF), &native, sizeof native);
    native = (tahr_native_desc){.struct_size = sizeof native, .no_simd = 1};
    set_options(add(base, "switches", "no_simd", CHART_OFF), &native, sizeof native);
}

/* Each switches off that the margin is chosen by the scene. */
static void add_cache_margins(const chart_setting *base)
{
    static const double margins[] = {0.0625, 0.125, 0.25, 0.5, 1, 2}; /* 0 is the default, which is 1 */
    for (size_t i = 0; i < sizeof margins / sizeof margins[0]; i++) {
        tahr_native_desc native = {.struct_size = sizeof native, .cache_margin = margins[i]};
        chart_setting *s = add(base, "cache_margin", "", CHART_OFF);
        snprintf(s->name, sizeof s->name, "cache_margin %g m", margins[i]);
        s->value = margins[i];
        set_options(s, &native, sizeof native);
    }
}

/* Each backend once, at 60 Hz: those of subject.c whose answers are not what the default of one already shows. */
static void add_backends(const chart_setting *base, int planar)
{
    const chart_subject *subject;
    for (uint32_t i = 0; (subject = chart_subject_at(i)) != NULL; i++) {
        if (strcmp(subject->role, CHART_OFF) == 0 || (subject->planar && !planar)) continue;
        chart_setting *s = add(base, subject->curve, subject->setting, subject->role);
        s->value = subject->value;
        s->get = subject->get;
        s->options = subject->options;
        s->slow = subject->slow;
    }
}

void chart_setting_default(const bench_world *level, chart_setting *s)
{
    *s = (chart_setting){.role = CHART_DEFAULT, .value = NAN, .rate = 60, .get = tahr_backend_v1_native};
    snprintf(s->curve, sizeof s->curve, "default");
    snprintf(s->name, sizeof s->name, "default");
    bench_world_config(level, &s->config);
}

uint32_t chart_settings_make(const bench_world *level, const chart_setting **all)
{
    chart_setting base;
    setting_count = 0;
    chart_setting_default(level, &base);
    add_rates(&base, level->planar ? "platformer" : "precise", CHART_DEFAULT);
    if (!level->planar) {
        add_methods(&base);
        for (size_t i = 0; i < sizeof KNOBS / sizeof KNOBS[0]; i++) {
            add_knob(&base, &KNOBS[i]);
        }
        add_switches(&base);
        add_cache_margins(&base);
    }
    add_backends(&base, level->planar);
    *all = settings;
    return setting_count;
}

void chart_setting_reference(const chart_setting *setting, chart_setting *reference)
{
    tahr_native_desc native = {.struct_size = sizeof native};
    tahr_config *c = &reference->config;
    *reference = *setting;
    c->slide_solver = TAHR_SLIDE_JOINT;
    c->separation = TAHR_SEPARATION_MARGIN;
    c->floor_probe = TAHR_FLOOR_PROBE_WHOLE;
    c->depenetration = TAHR_DEPENETRATION_JOINT;
    c->step_rule = TAHR_STEP_BY_TREAD;
    c->flat_base = 0;
    c->max_slides = 16;
    c->path_tolerance = c->arc_tolerance = 1e-6 * c->shape.half_height; /* the least */
    c->max_substeps = 8; /* what follows cannot matter to these methods: one reference */
    c->max_substep = 0.05;
    c->cached_floor = 1;
    c->sleep = 1;
    reference->get = tahr_backend_v1_native;
    reference->rate = c->integrator == TAHR_INTEGRATOR_STEPPED ? STEPPED_RATE : EXACT_RATE;
    set_options(reference, &native, sizeof native);
}

void chart_level_make(bench_world *level, const char *name)
{
    for (int i = 0; i < BENCH_WORLDS; i++) {
        if (strcmp(bench_world_name(i), name) == 0) bench_world_make(level, i);
    }
}

static void complain(void *user, int32_t level, const char *message)
{
    (void)user;
    if (level == TAHR_LOG_ERROR) fprintf(stderr, "%s\n", message);
}

tahr_status chart_setting_open(const chart_setting *s, const bench_world *level, tahr_world **world)
{
    tahr_log log = {NULL, complain};
    scene_backend backend = {.name = s->name, .get = s->get};
    tahr_world_desc desc;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = bench_world_bodies(level, &backend);
    desc.body_count = level->body_count;
    desc.log = &log;
    desc.options = s->options.words[0] ? &s->options : NULL;
    return tahr_world_open(s->get(), &desc, world);
}
