/* SPDX-License-Identifier: MIT
 * run.c: characters walk through a level and are watched. */
#include "run.h"

#include "csv.h"
#include "feed.h"
#include "interrupt.h"
#include "moment.h"
#include "outputs.h"
#include "plot.h"
#include "say.h"
#include "scene.h"
#include "side.h"
#include "spawn.h"
#include "summary.h"
#include "throng.h"
#include "vec.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <tahr/trace.h>
#include <unistd.h>

#define EVENT_CAPACITY 64 /* per step; more are counted as lost by the library */
#define TOUCHING 1e-6 /* m by which two characters may overlap: the rounding of where they are, far from the origin */
#define WANDER_SPEED 5.0 /* m/s, by the definition of wandering */

static int create_characters(struct run *run)
{
    const struct options *o = run->options;
    tahr_vec3 *places = memory_new(o->characters, sizeof *places);
    int failed = 0;
    run->characters = memory_new(o->characters, sizeof *run->characters);
    if (run->route.has_start) {
        places[0] = run->route.start;
    } else if (o->characters == 1 && run->level.side != NULL && run->level.side->has_start) {
        places[0] = side_start(run->level.side, &run->config);
    } else {
        failed = spawn_find(run->world, &run->level, &run->config, o->seed, places, o->characters);
    }
    for (uint32_t i = 0; i < o->characters && !failed; i++) {
        struct character *character = &run->characters[i];
        character->spawn = places[i];
        wander_start(&character->wander, o->seed, i);
        character->wander.crouches = o->level == NULL;
        character->wander.side = o->side;
        moment_place(run, character, 0);
        const int alone = o->threads == 0 && !o->crowd; /* else they are the throng's */
        tahr_status status = alone ? tahr_mover_create(run->world, &run->config, &character->mover) : TAHR_OK;
        if (status < 0) {
            say_error("cannot create character %u on backend '%s': %s", i, o->backend->name,
                      tahr_status_message(status));
            failed = -1;
        }
    }
    free(places);
    return failed;
}

static void set_config(struct run *run)
{
    const struct options *o = run->options;
    tahr_config *config = &run->config;
    tahr_config_init(config, sizeof *config, o->preset);
    config->max_speed = WANDER_SPEED;
    if (o->side) {
        side_config(config);
    } else if (o->level == NULL) {
        playground_feel(config);
    }
    if (o->shape != 0) {
        config->shape = side_shape(o->shape, &config->shape);
    }
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
    if (o->route != NULL && route_load(&run->route, o->route, o->side) != 0) {
        return -1;
    }
    if (o->tour) {
        route_tour(&run->route);
    }
    if (scene_load(&run->level, o) != 0) {
        return -1;
    }
    run->result.load_seconds = (double)(clock_ns() - before) * 1e-9;
    set_config(run);
    run->poses = memory_new(run->level.mover_count, sizeof *run->poses);
    before = clock_ns();
    if (scene_open(&run->level, o, &run->world) != 0) {
        return -1;
    }
    run->result.open_seconds = (double)(clock_ns() - before) * 1e-9;
    if (create_characters(run) != 0 || open_trace(run) != 0) {
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
    run->result.least_clearance = run->result.least_apart = CHECK_REACH;
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
    feed_bodies(run->feed, run);
    if (run->checker != NULL) {
        checker_time(run->checker, begin, begin + run->dt);
    }
    return 0;
}

void throng_input(struct run *run, struct moment *m)
{
    struct character *character = &run->characters[m->index];
    m->input = (tahr_input){.struct_size = sizeof m->input};
    m->heading_is_new = run->route.count > 0 ? route_input(&run->route, m->time, character->state.position, &m->input)
                                             : wander_input(&character->wander, m->time, &m->input);
    if (run->route.count == 0 && character->state.mode == TAHR_MODE_HANGING && m->heading_is_new) {
        m->input.jump = 1; /* who hangs on an edge and wants to go elsewhere climbs, or jumps off */
    }
}

static int step_character(struct run *run, struct moment *m)
{
    struct character *character = &run->characters[m->index];
    tahr_event events[EVENT_CAPACITY];
    m->report = (tahr_report){.struct_size = sizeof m->report, .events = events, .event_capacity = EVENT_CAPACITY};
    throng_input(run, m);
    m->before = character->state.position;
    m->flags_before = character->state.flags;
    m->shape_before = shape_now(&run->config, &character->state);
    feed_begin(run->feed, m->index, &character->state);
    uint64_t before = clock_ns();
    tahr_status status = tahr_mover_step(character->mover, &m->input, run->dt, &character->state, &m->report);
    uint64_t ns = clock_ns() - before, clock = (uint64_t)run->result.clock_cost;
    times_add(&run->result.times, ns > clock ? ns - clock : 0);
    if (status < 0) {
        say_error("character %u, step %llu at (%g, %g, %g): %s", m->index, (unsigned long long)m->step, m->before.x,
                  m->before.y, m->before.z, tahr_status_message(status));
        return -1;
    }
    feed_step(run->feed, run, m, status, ns, 0);
    moment_watch(run, m, character);
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

static int walk(struct run *run, struct throng *throng)
{
    struct moment moment;
    int shown = isatty(STDERR_FILENO) && !run->options->json;
    uint64_t began = clock_ns(), next = began;
    for (moment.step = 0; moment.step < run->step_count; moment.step++) {
        moment.time = (double)moment.step * run->dt;
        feed_wait(run->feed, moment.time);
        if (interrupt_came()) {
            run->result.ended = moment.time;
            break;
        }
        if (run->level.mover_count > 0 && move_bodies(run, moment.time) != 0) {
            return -1;
        }
        if (throng != NULL && throng_step(run, throng, moment.step, moment.time) != 0) {
            return -1;
        }
        for (moment.index = 0; throng == NULL && moment.index < run->options->characters; moment.index++) {
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
    r->failed = r->tunnels > 0 || r->crushed_alone > 0 || r->bad_states > 0 || r->stuck > 0 || r->hung > 0 ||
                r->deepest > o->backend->penetration_allowed || r->least_apart < -TOUCHING;
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

/* Which level this is, as a telemetry's messages name it. */
static void describe_name(const struct level *level, const tahr_log *to)
{
    char line[400];
    snprintf(line, sizeof line, "level '%s', hash %016" PRIx64, level->name, scene_hash(level));
    to->write(to->user, TAHR_LOG_INFO, line);
}

int run_describe(const struct options *options, const tahr_log *to)
{
    struct run run = {.options = options};
    int opened = scene_load(&run.level, options) == 0 && scene_open(&run.level, options, &run.world) == 0;
    if (opened) {
        describe_name(&run.level, to);
    }
    if (opened && run.level.side) {
        side_describe(run.level.side, options->separate_tiles,
                      (backend_table(options->backend)->capabilities & TAHR_CAP_PLANAR) != 0, to);
    }
    int described = opened && tahr_world_describe(run.world, to) >= 0;
    if (opened && !described) {
        say_error("backend '%s' cannot describe its scene", options->backend->name);
    }
    close_run(&run);
    return described ? 0 : -1;
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
    struct throng *throng = NULL;
    if (open_run(&run) == 0 && throng_open(&run, &throng) == 0 && feed_open(&run, &run.feed) == 0) {
        const int walked = walk(&run, throng) == 0;
        feed_close(&run, run.feed);
        code = walked && finish(&run) == 0 && !run.result.failed ? EXIT_GOOD : EXIT_CHECK_FAILED;
    }
    throng_close(throng);
    close_run(&run);
    options_close(&options);
    return code;
}
