/* SPDX-License-Identifier: MIT
 * run.c: characters walk through a level and are watched. */
#include "run.h"

#include "check.h"
#include "csv.h"
#include "outputs.h"
#include "plot.h"
#include "progress.h"
#include "route.h"
#include "say.h"
#include "spawn.h"
#include "summary.h"
#include "vec.h"
#include "wander.h"

#include <stdlib.h>
#include <tahr/trace.h>
#include <unistd.h>

#define WANDER_SPEED 5.0    /* m/s, by the definition of wandering */
#define FALL_OUT_DEPTH 10.0 /* m below the lowest vertex */
#define STRAIGHT_DT 0.21  /* s; the way of a longer step bends round corners that a line between its ends would cross */
#define SAMPLE_PERIOD 16  /* steps, of --check sampled */
#define EVENT_CAPACITY 64 /* per step; more are counted as lost by the library */

struct character {
    tahr_state state;
    tahr_mover *mover;
    tahr_vec3 spawn;
    struct wander wander;
    struct progress progress;
};

struct run {
    const struct options *options;
    struct level level;
    tahr_world *world;
    tahr_config config;
    struct character *characters;
    tahr_body_pose *poses; /* of the level's movers */
    struct route route;
    struct checker *checker; /* NULL: off */
    struct track track;
    FILE *csv;         /* or NULL */
    tahr_trace *trace; /* or NULL */
    uint64_t step_count;
    double dt;
    struct result result;
};

/* One step of one character, for everything that looks at it. */
struct moment {
    uint64_t step;
    uint32_t index;
    double time; /* s, at the start of the step */
    tahr_vec3 before;
    tahr_input input;
    int heading_is_new;
    tahr_report report;
    tahr_event events[EVENT_CAPACITY];
};

static void place_character(struct run *run, struct character *character, double time)
{
    tahr_state_init(&character->state, &run->config, &character->spawn);
    progress_start(&character->progress, &character->state, time);
}

static int open_world(struct run *run)
{
    const struct options *o = run->options;
    const tahr_log log = say_log();
    tahr_world_desc desc;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = run->level.bodies;
    desc.body_count = (uint32_t)run->level.body_count;
    desc.log = &log;
    desc.options = o->backend->options;
    uint64_t before = clock_ns();
    tahr_status status = tahr_world_open(backend_table(o->backend), &desc, &run->world);
    run->result.open_seconds = (double)(clock_ns() - before) * 1e-9;
    if (status < 0) {
        say_error("level '%s' does not open on backend '%s': %s", run->level.name, o->backend->name,
                  tahr_status_message(status));
        return -1;
    }
    return 0;
}

static int create_characters(struct run *run)
{
    const struct options *o = run->options;
    tahr_vec3 *places = memory_new(o->characters, sizeof *places);
    int failed = 0;
    run->characters = memory_new(o->characters, sizeof *run->characters);
    if (run->route.has_start) {
        places[0] = run->route.start;
    } else {
        failed = spawn_find(run->world, &run->level, &run->config, o->seed, places, o->characters);
    }
    for (uint32_t i = 0; i < o->characters && !failed; i++) {
        struct character *character = &run->characters[i];
        character->spawn = places[i];
        wander_start(&character->wander, o->seed, i);
        character->wander.crouches = o->level == NULL;
        place_character(run, character, 0);
        tahr_status status = tahr_mover_create(run->world, &run->config, &character->mover);
        if (status < 0) {
            say_error("cannot create character %u on backend '%s': %s", i, o->backend->name,
                      tahr_status_message(status));
            failed = -1;
        }
    }
    free(places);
    return failed;
}

/* Spawning is over: from here on the file tells everything. */
static int open_trace(struct run *run)
{
    const tahr_log log = say_log();
    const tahr_trace_desc desc = {
        .struct_size = sizeof desc, .flags = TAHR_TRACE_STEPS_ONLY, .path = run->options->trace, .log = &log};
    if (run->options->trace == NULL) {
        return 0;
    }
    tahr_status status = tahr_trace_open(&desc, &run->trace);
    if (status >= 0) {
        status = tahr_world_record(run->world, tahr_trace_recorder(run->trace));
    }
    if (status < 0) {
        say_error("--trace '%s': %s", run->options->trace, tahr_status_message(status));
        return -1;
    }
    return 0;
}

/* Ends the recording, if there is one. */
static int close_trace(struct run *run)
{
    tahr_trace *trace = run->trace;
    run->trace = NULL;
    if (trace == NULL) {
        return 0;
    }
    tahr_world_record(run->world, NULL);
    tahr_trace_size(trace, NULL, NULL, &run->result.trace_bytes);
    if (tahr_trace_close(trace) < 0) {
        say_error("--trace '%s': cannot write", run->options->trace);
        return -1;
    }
    return 0;
}

static int open_run(struct run *run)
{
    const struct options *o = run->options;
    uint64_t before = clock_ns();
    if (output_probe("csv", o->csv) != 0 || output_probe("plot", o->plot) != 0 ||
        output_probe("trace", o->trace) != 0) {
        return -1;
    }
    if (o->route != NULL && route_load(&run->route, o->route) != 0) {
        return -1;
    }
    if (o->level == NULL) {
        level_playground(&run->level);
    } else if (level_load(&run->level, o->level, o->up) != 0) {
        return -1;
    }
    run->result.load_seconds = (double)(clock_ns() - before) * 1e-9;
    tahr_config_init(&run->config, sizeof run->config, o->preset);
    run->config.max_speed = WANDER_SPEED;
    if (o->level == NULL) {
        playground_feel(&run->config);
    }
    run->poses = memory_new(run->level.mover_count, sizeof *run->poses);
    if (open_world(run) != 0 || create_characters(run) != 0 || open_trace(run) != 0) {
        return -1;
    }
    run->checker = o->check != CHECK_OFF ? checker_open(&run->level) : NULL;
    track_open(&run->track, o->characters, run->step_count);
    run->csv = o->csv != NULL ? output_open("csv", o->csv) : NULL;
    if (o->csv != NULL && run->csv == NULL) {
        return -1;
    }
    if (run->csv != NULL) {
        csv_header(run->csv);
    }
    times_open(&run->result.times);
    run->result.clock_cost = clock_cost();
    run->result.least_clearance = CHECK_REACH;
    return 0;
}

static void close_run(struct run *run)
{
    close_trace(run);
    for (uint32_t i = 0; run->characters != NULL && i < run->options->characters; i++) {
        tahr_mover_destroy(run->characters[i].mover);
    }
    free(run->characters);
    free(run->poses);
    if (run->csv != NULL) {
        fclose(run->csv); /* of a run that ended early */
    }
    tahr_world_close(run->world);
    checker_close(run->checker);
    track_close(&run->track);
    times_close(&run->result.times);
    route_close(&run->route);
    level_close(&run->level);
}

static void add_finding(struct run *run, const struct moment *m, const char *what, tahr_vec3 position)
{
    struct result *r = &run->result;
    if (r->finding_count < MAX_FINDINGS) {
        r->findings[r->finding_count++] = (struct finding){what, m->index, m->step, m->time, position};
    }
}

/* Where the foot is of a character whose centre is there. */
static tahr_vec3 foot_of(tahr_vec3 centre, const tahr_state *state)
{
    centre.z -= state->half_height;
    return centre;
}

static void count_events(struct run *run, const struct moment *m, const tahr_state *state)
{
    struct result *r = &run->result;
    for (uint32_t i = 0; i < m->report.event_count; i++) {
        const tahr_event *event = &m->events[i];
        r->events[event->type < EVENT_TYPES ? event->type : 0]++;
        if (run->options->plot != NULL) {
            track_mark(&run->track, m->index, event->type, m->time + event->time, foot_of(event->position, state));
        }
    }
}

static void count_report(struct run *run, const struct moment *m, const tahr_state *state)
{
    struct result *r = &run->result;
    const tahr_report *report = &m->report;
    uint32_t queries = report->sweeps + report->contact_queries + report->rays + report->fluid_queries;
    r->steps++;
    r->sweeps += report->sweeps;
    r->contact_queries += report->contact_queries;
    r->rays += report->rays;
    r->triangle_tests += report->triangle_tests;
    r->gathers += report->gathers;
    r->escapes += report->escapes;
    r->most_queries = queries > r->most_queries ? queries : r->most_queries;
    r->modes[state->mode < MODES ? state->mode : TAHR_MODE_NONE]++;
    r->unknown += (report->flags & TAHR_REPORT_UNKNOWN) != 0;
    if (report->flags & TAHR_REPORT_QUERY_CAP) {
        r->query_caps++;
        add_finding(run, m, "query cap", m->before);
    }
    r->time_lost += report->time_lost;
    count_events(run, m, state);
}

/* The independent look at one step. */
static void check_step(struct run *run, const struct moment *m, const tahr_state *state)
{
    struct result *r = &run->result;
    if (run->checker == NULL || (run->options->check == CHECK_SAMPLED && (m->step + m->index) % SAMPLE_PERIOD != 0)) {
        return;
    }
    r->checked++;
    if (run->dt <= STRAIGHT_DT && checker_crosses(run->checker, m->before, state->position)) {
        r->tunnels++;
        add_finding(run, m, "tunnelled", m->before);
        track_mark(&run->track, m->index, TRACK_TUNNEL, m->time, foot_of(state->position, state));
    }
    const tahr_shape shape = shape_now(&run->config, state);
    double clearance = checker_clearance(run->checker, &shape, state->position, state->up);
    if (m->report.flags & TAHR_REPORT_CRUSHED) { /* there was no room, which only a mover can bring about */
        r->crushed++;
        if (checker_mover_clearance(run->checker, &shape, state->position, state->up) >= CHECK_REACH) {
            r->crushed_alone++;
            add_finding(run, m, "crushed by nothing that moves", state->position);
        }
        return;
    }
    r->least_clearance = least(r->least_clearance, clearance);
    if (-clearance > run->options->backend->penetration_allowed) {
        add_finding(run, m, "penetration", state->position);
    }
    r->deepest = most(r->deepest, -clearance);
}

/* Puts characters that left the level, or whose state is no state any more, back to where they started. */
static void bring_back(struct run *run, const struct moment *m, struct character *character)
{
    const tahr_state *state = &character->state;
    int bad = !vec_finite(state->position) || !vec_finite(state->velocity);
    int fell = !bad && state->position.z < run->level.bounds.min.z - FALL_OUT_DEPTH;
    if (bad) {
        add_finding(run, m, "bad state", m->before);
    }
    if (bad || fell) {
        run->result.bad_states += (uint64_t)bad;
        run->result.fell_out += (uint64_t)fell;
        track_mark(&run->track, m->index, TRACK_FELL_OUT, m->time, foot_of(m->before, state));
        track_break(&run->track, m->index);
        place_character(run, character, m->time + run->dt);
    }
}

static void watch_step(struct run *run, const struct moment *m, struct character *character)
{
    const tahr_state *state = &character->state;
    const double end = (double)(m->step + 1) * run->dt;
    count_report(run, m, state);
    check_step(run, m, state);
    if (run->options->plot != NULL) {
        track_point(&run->track, m->index, m->step, end, state);
    }
    if (run->csv != NULL) {
        csv_write(run->csv, &(struct csv_row){m->step, end, m->index, state, &m->report});
    }
    if (progress_watch(&character->progress, run->world, &run->config, state, &m->input, m->heading_is_new, end)) {
        run->result.stuck++;
        add_finding(run, m, "stuck", state->position);
        track_mark(&run->track, m->index, TRACK_STUCK, end, foot_of(state->position, state));
    }
    bring_back(run, m, character);
}

/* Everything that moves by itself goes first: characters see it where it is at the end of the step. */
static int move_bodies(struct run *run, double begin)
{
    const struct level *level = &run->level;
    tahr_body_pose pose = {0};
    for (size_t i = 0; i < level->mover_count; i++) {
        run->poses[i] = pose;
        run->poses[i].body = level->movers[i].body;
        run->poses[i].pose = level_mover_pose(&level->movers[i], begin + run->dt);
    }
    tahr_status status = tahr_world_move(run->world, run->poses, (uint32_t)level->mover_count, run->dt);
    if (status < 0) {
        say_error("cannot move the bodies of '%s': %s", level->name, tahr_status_message(status));
        return -1;
    }
    if (run->checker != NULL) {
        checker_time(run->checker, begin, begin + run->dt);
    }
    return 0;
}

static int step_character(struct run *run, struct moment *m)
{
    struct character *character = &run->characters[m->index];
    m->input = (tahr_input){.struct_size = sizeof m->input};
    m->report = (tahr_report){.struct_size = sizeof m->report, .events = m->events, .event_capacity = EVENT_CAPACITY};
    m->heading_is_new = run->route.count > 0 ? route_input(&run->route, m->time, &m->input)
                                             : wander_input(&character->wander, m->time, &m->input);
    if (run->route.count == 0 && character->state.mode == TAHR_MODE_HANGING && m->heading_is_new) {
        m->input.jump = 1; /* who hangs on an edge and wants to go elsewhere climbs, or jumps off */
    }
    m->before = character->state.position;
    uint64_t before = clock_ns();
    tahr_status status = tahr_mover_step(character->mover, &m->input, run->dt, &character->state, &m->report);
    uint64_t ns = clock_ns() - before, clock = (uint64_t)run->result.clock_cost;
    times_add(&run->result.times, ns > clock ? ns - clock : 0);
    if (status < 0) {
        say_error("character %u, step %llu at (%g, %g, %g): %s", m->index, (unsigned long long)m->step, m->before.x,
                  m->before.y, m->before.z, tahr_status_message(status));
        return -1;
    }
    watch_step(run, m, character);
    return 0;
}

static void show_progress(const struct run *run, uint64_t step)
{
    const struct result *r = &run->result;
    fprintf(stderr, "\r%3.0f %%  %.1f of %.1f s, %llu steps climbed, %llu jumps, %llu fell out, %llu tunnelled ",
            100.0 * (double)step / (double)run->step_count, (double)step * run->dt, run->options->seconds,
            (unsigned long long)r->events[TAHR_EVENT_STEPPED_UP], (unsigned long long)r->events[TAHR_EVENT_JUMPED],
            (unsigned long long)r->fell_out, (unsigned long long)r->tunnels);
}

static int walk(struct run *run)
{
    struct moment moment;
    int shown = isatty(STDERR_FILENO) && !run->options->json;
    uint64_t began = clock_ns(), next = began;
    for (moment.step = 0; moment.step < run->step_count; moment.step++) {
        moment.time = (double)moment.step * run->dt;
        if (run->level.mover_count > 0 && move_bodies(run, moment.time) != 0) {
            return -1;
        }
        for (moment.index = 0; moment.index < run->options->characters; moment.index++) {
            if (step_character(run, &moment) != 0) {
                return -1;
            }
        }
        if (shown && clock_ns() >= next) {
            next = clock_ns() + 100000000u;
            show_progress(run, moment.step);
        }
    }
    if (shown) {
        fprintf(stderr, "\r%78s\r", "");
    }
    run->result.wall_seconds = (double)(clock_ns() - began) * 1e-9;
    return 0;
}

/* 64-bit FNV-1a over the hashes of all characters in order. */
static uint64_t hash_states(const struct run *run)
{
    uint64_t hash = 14695981039346656037u;
    for (uint32_t i = 0; i < run->options->characters; i++) {
        uint64_t one = tahr_state_hash(&run->characters[i].state);
        for (int byte = 0; byte < 8; byte++) {
            hash = (hash ^ ((one >> (8 * byte)) & 255)) * 1099511628211u;
        }
    }
    return hash;
}

static int write_plot(const struct run *run)
{
    const struct options *o = run->options;
    char caption[200];
    snprintf(caption, sizeof caption, "%s: %u character%s for %g s at %g Hz on %s", run->level.name, o->characters,
             o->characters == 1 ? "" : "s", o->seconds, o->rate, o->backend->name);
    return plot_write(&(struct plot){.path = o->plot,
                                     .level = &run->level,
                                     .track = &run->track,
                                     .seconds = o->seconds,
                                     .walkable_angle = run->config.walkable_angle,
                                     .caption = caption});
}

static int finish(struct run *run)
{
    const struct options *o = run->options;
    struct result *r = &run->result;
    r->state_hash = hash_states(run);
    r->world_bytes = tahr_world_memory(run->world);
    r->failed = r->tunnels > 0 || r->crushed_alone > 0 || r->bad_states > 0 || r->stuck > 0 ||
                r->deepest > o->backend->penetration_allowed;
    if (close_trace(run) != 0) {
        return -1;
    }
    FILE *csv = run->csv;
    run->csv = NULL;
    if (csv != NULL && output_close(csv, "csv", o->csv) != 0) {
        return -1;
    }
    if (o->plot != NULL && write_plot(run) != 0) {
        return -1;
    }
    if (o->json) {
        summary_json(o, &run->level, r);
    } else {
        summary_words(o, &run->level, r);
    }
    return 0;
}

int run_command(int argc, char **argv)
{
    struct options options;
    int parsed = options_parse(&options, argc, argv);
    if (parsed != 0) {
        options_close(&options);
        return parsed > 0 ? EXIT_GOOD : EXIT_USAGE;
    }
    struct run run = {
        .options = &options, .dt = 1 / options.rate, .step_count = (uint64_t)(options.seconds * options.rate + 0.5)};
    int code = EXIT_USAGE; /* whatever keeps a run from starting was asked for on the command line */
    if (open_run(&run) == 0) {
        code = walk(&run) == 0 && finish(&run) == 0 && !run.result.failed ? EXIT_GOOD : EXIT_CHECK_FAILED;
    }
    close_run(&run);
    options_close(&options);
    return code;
}
