/* SPDX-License-Identifier: MIT
 * verify.c: a log of LCM, proven by taking every recorded step again. */
#include "verify.h"

#include "findings.h"
#include "../json_values.h"
#include "../log_file.h"
#include "../say.h"
#include "../scene.h"
#include "../stats.h"

#include <fnmatch.h>
#include <inttypes.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define SHOW_NS 100000000u

enum { MOST_CHARACTERS = 1 << 20, MOST_CONFIGS = 65536, MOST_RUNS = 256 };

struct verify {
    const char *path, *glob;
    struct options *options;
    struct level level;
    tahr_world *world;
    struct judge *judge;     /* of the run under way; NULL: none yet */
    int64_t runs[MOST_RUNS]; /* the last one is under way */
    size_t run_count;
    char prefix[64];
    int has_prefix;
    uint64_t inputs, early; /* all; before anything was known of their run */
    uint64_t foreign;
    int worst;                /* exit code so far */
    json_t *json, *json_runs; /* what is told at the end; NULL: in words, as it is found */
};

static int unusable(struct verify *v)
{
    v->worst = EXIT_USAGE;
    return -1;
}

/* The backend of the recording: other engines give other bits. */
static int choose_backend(struct verify *v, const char *name)
{
    struct options *o = v->options;
    if (o->backend_given && strcmp(o->backend->name, name) != 0) {
        say_error("'%s' was recorded on backend '%s', which --backend %s cannot repeat", v->path, name,
                  o->backend->name);
        return unusable(v);
    }
    if (!o->backend_given) {
        o->backend = backend_choice_find(name);
    }
    if (o->backend == NULL) {
        say_error(
            "'%s' was recorded on backend '%s', which this tahr does not know; expected --backend with its shared "
            "object",
            v->path, name);
        return unusable(v);
    }
    if ((backend_table(o->backend)->capabilities & TAHR_CAP_PLANAR) && !o->side) {
        say_error("'%s' was recorded on backend '%s', which has two dimensions; expected --2d", v->path, name);
        return unusable(v);
    }
    return 0;
}

static int open_level(struct verify *v, const tahr_world_t *w)
{
    if (v->run_count > 1) {
        level_close(&v->level);
    }
    if (choose_backend(v, w->backend) != 0 || scene_load(&v->level, v->options) != 0) {
        return unusable(v);
    }
    if (scene_hash(&v->level) != (uint64_t)w->level_hash) {
        say_error("'%s' was recorded in level '%s' with hash %016" PRIx64 ", but '%s' has %016" PRIx64
                  "; expected --level, --up, --2d, --tiles of that run",
                  v->path, w->level, (uint64_t)w->level_hash, v->level.name, scene_hash(&v->level));
        return unusable(v);
    }
    return scene_open(&v->level, v->options, &v->world) == 0 ? 0 : unusable(v);
}

static int check_world(struct verify *v, const tahr_world_t *w)
{
    const char *wrong = NULL;
    if (w->abi != TAHR_ABI) {
        wrong = "another version of the library";
    } else if (w->config_size != (int32_t)sizeof(tahr_config) || w->config_count < 1 ||
               w->config_count > MOST_CONFIGS || w->size != w->config_count * w->config_size) {
        wrong = "settings of another size";
    } else if (w->characters < 1 || w->characters > MOST_CHARACTERS) {
        wrong = "a number of characters that cannot be";
    }
    if (wrong != NULL) {
        say_error("'%s': recorded by tahr %s, ABI %d, %d settings of %d bytes, %d characters: %s (expected ABI %d, %zu "
                  "bytes)",
                  v->path, w->version, w->abi, w->config_count, w->config_size, w->characters, wrong, TAHR_ABI,
                  sizeof(tahr_config));
        return unusable(v);
    }
    return 0;
}

static void end_run(struct verify *v)
{
    if (v->judge == NULL) {
        return;
    }
    judge_end(v->judge);
    const struct verdict *d = judge_verdict(v->judge);
    if (v->json != NULL) {
        findings_put(json_array_get(v->json_runs, json_array_size(v->json_runs) - 1), d);
    } else {
        findings_print(d);
    }
    const int whole = d->gap_count == 0 && d->desync_count == 0 && d->contradiction_count == 0 && d->broken == 0 &&
                      d->lost[TAHR_MESSAGE_EVENT] == 0;
    v->worst = !whole && v->worst == EXIT_GOOD ? EXIT_CHECK_FAILED : v->worst;
    judge_close(v->judge);
    v->judge = NULL;
    tahr_world_close(v->world);
    v->world = NULL;
}

static void tell_run(struct verify *v, const tahr_world_t *w)
{
    if (v->json != NULL) {
        json_array_append_new(v->json_runs, json_pack("{s:o, s:o, s:o, s:i}", "level", json_text(w->level), "backend",
                                                      json_text(w->backend), "version", json_text(w->version),
                                                      "characters", (int)w->characters));
        return;
    }
    printf("%s: recorded in level '%s' on backend %s by tahr %s, %" PRId32 " character%s\n", v->path, w->level,
           w->backend, w->version, w->characters, w->characters == 1 ? "" : "s");
}

static int begin_run(struct verify *v, const tahr_world_t *w)
{
    for (size_t i = 0; i + 1 < v->run_count; i++) {
        if (v->runs[i] == w->run) {
            say_error(
                "'%s': two runs at once on the same channels cannot be told apart; expected one, or a --lcm-prefix "
                "for each",
                v->path);
            return unusable(v);
        }
    }
    end_run(v);
    if (v->run_count == MOST_RUNS) {
        say_error("'%s': more than %d runs", v->path, MOST_RUNS);
        return unusable(v);
    }
    v->runs[v->run_count++] = w->run;
    if (check_world(v, w) != 0 || open_level(v, w) != 0) {
        return -1;
    }
    tahr_config *configs = memory_new((size_t)w->config_count, sizeof *configs);
    memcpy(configs, w->configs, (size_t)w->size);
    v->judge = judge_open(v->world, configs, (uint32_t)w->config_count, (uint32_t)w->characters);
    free(configs);
    tell_run(v, w);
    return 0;
}

static int check_prefix(struct verify *v, const char *channel, size_t prefix)
{
    if (!v->has_prefix) {
        snprintf(v->prefix, sizeof v->prefix, "%.*s", (int)prefix, channel);
        v->has_prefix = 1;
    }
    if (strlen(v->prefix) == prefix && memcmp(v->prefix, channel, prefix) == 0) {
        return 0;
    }
    say_error("'%s' holds channels of more than one publisher, %s... and %s; expected --channel '%sTAHR_*', or another "
              "one",
              v->path, v->prefix, channel, v->prefix);
    return unusable(v);
}

static int hear(struct verify *v, const struct log_event *event)
{
    struct message m;
    int failed = 0;
    if (v->glob != NULL && fnmatch(v->glob, event->channel, 0) != 0) {
        return 0;
    }
    const enum message_verdict kind = message_read(&m, event->channel, event->data, event->size);
    v->foreign += kind == MESSAGE_FOREIGN;
    if (kind != MESSAGE_OURS) {
        return 0;
    }
    v->inputs += m.kind == TAHR_MESSAGE_INPUT;
    if (check_prefix(v, event->channel, m.prefix) != 0) {
        failed = -1;
    } else if (m.kind == TAHR_MESSAGE_WORLD) {
        const int is_new = v->run_count == 0 || v->runs[v->run_count - 1] != m.is.world.run;
        failed = is_new ? begin_run(v, &m.is.world) : 0;
    } else if (v->judge != NULL) {
        judge_hear(v->judge, &m);
    } else {
        v->early += m.kind == TAHR_MESSAGE_INPUT;
    }
    message_free(&m);
    return failed;
}

static void read_all(struct verify *v, struct log_file *log)
{
    struct log_event event;
    const int shown = isatty(STDERR_FILENO);
    uint64_t next = clock_ns(), count = 0;
    while (log_file_next(log, &event) && hear(v, &event) == 0) {
        if (shown && ++count % 256 == 0 && clock_ns() >= next) {
            next = clock_ns() + SHOW_NS;
            fprintf(stderr, "\r%3.0f %%  %" PRIu64 " steps proven ",
                    100.0 * (double)log_file_position(log) / (double)log_file_size(log),
                    v->judge != NULL ? judge_verdict(v->judge)->proven : 0);
        }
    }
    if (shown) {
        fprintf(stderr, "\r%60s\r", "");
    }
}

/* What is not about one run. */
static void print_rest(const struct verify *v, uint64_t damages)
{
    if (v->foreign > 0) {
        printf("  ignored    %" PRIu64 " messages of another package or version on channels of ours\n", v->foreign);
    }
    if (v->early > 0) {
        printf("  not proven %" PRIu64 " steps recorded before anything was known of their level\n", v->early);
    }
    if (damages > 0) {
        printf("  damaged    the file, in %" PRIu64 " place%s\n", damages, damages == 1 ? "" : "s");
    }
    puts(v->worst == EXIT_GOOD ? "ok" : v->worst == EXIT_USAGE ? "FAILED" : "NOT PROVEN");
}

static void put_rest(const struct verify *v, uint64_t damages)
{
    const char *verdict = v->worst == EXIT_GOOD ? "ok" : v->worst == EXIT_USAGE ? "failed" : "not proven";
    json_put_count(v->json, "ignored", v->foreign);
    json_put_count(v->json, "early", v->early);
    json_put_count(v->json, "damages", damages);
    json_object_set_new(v->json, "verdict", json_string(verdict));
    json_dumpf(v->json, stdout, JSON_INDENT(2));
    putchar('\n');
}

static void end_all(struct verify *v, uint64_t damages)
{
    if (v->inputs == 0 || v->run_count == 0) {
        say_error("'%s': nothing to prove: expected %s of `tahr run --lcm`, or of a program that calls "
                  "tahr_telemetry_begin",
                  v->path, v->inputs == 0 ? "inputs (channel TAHR_INPUT)" : "a world (channel TAHR_WORLD)");
        unusable(v);
    }
    if ((v->early > 0 || damages > 0) && v->worst == EXIT_GOOD) {
        v->worst = EXIT_CHECK_FAILED;
    }
    if (v->json != NULL) {
        put_rest(v, damages);
    } else {
        print_rest(v, damages);
    }
}

int verify_log(const char *path, const char *glob, struct options *options)
{
    struct verify v = {.path = path, .glob = glob, .options = options};
    struct log_file *log = log_file_open(path);
    if (log == NULL) {
        return EXIT_USAGE;
    }
    if (options->json) {
        v.json_runs = json_array();
        v.json = json_pack("{s:o, s:o}", "file", json_text(path), "runs", v.json_runs);
    }
    read_all(&v, log);
    if (v.worst != EXIT_USAGE) {
        end_run(&v);
        end_all(&v, log_file_damages(log));
    }
    json_decref(v.json);
    judge_close(v.judge);
    tahr_world_close(v.world);
    level_close(&v.level);
    log_file_close(log);
    return v.worst;
}
