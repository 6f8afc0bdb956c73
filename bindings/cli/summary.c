/* SPDX-License-Identifier: MIT
 * summary.c: what a run found, in words or as JSON. */
#include "summary.h"

#include "check.h"
#include "json_values.h"
#include "side.h"

#include <inttypes.h>
#include <jansson.h>
#include <stdio.h>

static double per_step(const struct result *r, uint64_t count)
{
    return r->steps ? (double)count / (double)r->steps : 0;
}

/* By every shortcut that was of use, per step. */
static void words_saved(const struct result *r)
{
    const char *between = "  saved      ";
    for (uint32_t i = 0; i < TAHR_SHORTCUT_COUNT; i++) {
        if (r->saved[i] > 0) {
            printf("%s%s %.3g", between, tahr_shortcut_name(i), per_step(r, r->saved[i]));
            between = ", ";
        }
    }
    puts(*between == ',' ? " per step" : "  saved      nothing");
}

static void words_check(const struct options *o, const struct result *r)
{
    if (o->check == CHECK_OFF) {
        puts("  check      off");
        return;
    }
    printf("  check      %" PRIu64 " steps looked at: ", r->checked);
    if (r->tunnels) {
        printf("TUNNELLED %" PRIu64 " times, ", r->tunnels);
    } else {
        printf("no tunnelling, ");
    }
    if (r->deepest > 0) {
        printf("deepest penetration %.3g mm (%.3g mm allowed)\n", r->deepest * 1e3,
               o->backend->penetration_allowed * 1e3);
    } else if (r->least_clearance < CHECK_REACH) {
        printf("no penetration (closest to anything %.4g mm)\n", r->least_clearance * 1e3);
    } else {
        puts("no penetration");
    }
}

static void words_oddities(const struct result *r)
{
    if (r->bad_states) {
        printf("  BAD        %" PRIu64 " steps ended in a state that is not finite\n", r->bad_states);
    }
    if (r->unknown || r->events[TAHR_EVENT_CRUSHED] || r->query_caps || r->events[TAHR_EVENT_DEPENETRATED]) {
        printf("  odd        %" PRIu64 " pushed out of overlaps, %" PRIu64 " crushed, %" PRIu64 " undecided\n",
               r->events[TAHR_EVENT_DEPENETRATED], r->events[TAHR_EVENT_CRUSHED], r->unknown);
        printf("             %" PRIu64 " stopped at the query cap, %.3g s not simulated\n", r->query_caps,
               r->time_lost);
    }
}

static void words_findings(const struct result *r)
{
    for (size_t i = 0; i < r->finding_count; i++) {
        const struct finding *f = &r->findings[i];
        printf("  at         %s: character %u, step %" PRIu64 ", %.4g s, (%.6g, %.6g, %.6g)\n", f->what, f->character,
               f->step, f->time, f->position.x, f->position.y, f->position.z);
    }
}

/* Watched places, in the order in which they were come to. */
static void words_places(const struct level *level)
{
    size_t known = 0, reached = 0;
    for (size_t i = 0; i < level->side->count; i++) {
        const struct side_piece *piece = &level->side->pieces[i];
        if (side_is_place(piece)) {
            known++;
            reached += piece->reached >= 0;
            if (piece->kind == SIDE_GOAL && piece->reached >= 0) {
                printf("  goal       reached after %.3g s\n", piece->reached);
            }
        }
    }
    if (known > 0) {
        printf("  places     %zu of %zu come to%s", reached, known, reached < known ? "; never:" : "");
        for (size_t i = 0; i < level->side->count; i++) {
            const struct side_piece *piece = &level->side->pieces[i];
            if (side_is_place(piece) && piece->reached < 0) {
                printf(" %s", piece->name != NULL && *piece->name ? piece->name : "?");
            }
        }
        putchar('\n');
    }
}

void summary_words(const struct options *o, const struct level *level, const struct result *r)
{
    printf("%s: %u character%s, %g s at %g Hz, backend %s, preset %s\n", level->name, o->characters,
           o->characters == 1 ? "" : "s", o->seconds, o->rate, o->backend->name, tahr_preset_name(o->preset));
    const tahr_bounds *b = &level->bounds;
    if (level->side != NULL) {
        printf("  level      %zu bodies, %.1f x %.1f m; %.2f MB in the world, opened in %.3g s\n", level->body_count,
               b->max.x - b->min.x, b->max.y - b->min.y, (double)r->world_bytes / 1e6, r->open_seconds);
    } else {
        printf("  level      %zu bodies, %zu triangles, %.1f x %.1f x %.1f m; %.2f MB in the world, opened in %.3g s\n",
               level->body_count, level->triangle_count, b->max.x - b->min.x, b->max.y - b->min.y, b->max.z - b->min.z,
               (double)r->world_bytes / 1e6, r->open_seconds);
    }
    printf("  time       %" PRIu64
           " steps, %.3g us median, %.3g us p99, %.3g us worst (net of the clock's own %.0f ns)\n",
           r->steps, times_quantile(&r->times, 0.5) / 1e3, times_quantile(&r->times, 0.99) / 1e3,
           (double)r->times.greatest / 1e3, r->clock_cost);
    printf("  queries    %.2f sweeps, %.2f contact queries, %.1f triangle tests per step; at most %u queries in one\n",
           per_step(r, r->sweeps), per_step(r, r->contact_queries), per_step(r, r->triangle_tests), r->most_queries);
    words_saved(r);
    printf("  movement   %.1f %% on the ground, %" PRIu64 " steps climbed, %" PRIu64 " descended, %" PRIu64
           " jumps, %" PRIu64 " landings\n",
           100 * per_step(r, r->modes[TAHR_MODE_WALKING]), r->events[TAHR_EVENT_STEPPED_UP],
           r->events[TAHR_EVENT_STEPPED_DOWN], r->events[TAHR_EVENT_JUMPED], r->events[TAHR_EVENT_LANDED]);
    printf("  trouble    %" PRIu64 " fell out of the level, %" PRIu64 " stuck for good, %" PRIu64 " hung in the air\n",
           r->fell_out, r->stuck, r->hung);
    if (level->side != NULL) {
        words_places(level);
    }
    words_oddities(r);
    words_check(o, r);
    if (o->crowd && o->check != CHECK_OFF && r->least_apart < CHECK_REACH) {
        printf("  crowd      closest to each other %.4g mm%s\n", r->least_apart * 1e3,
               r->least_apart < 0 ? ": they overlap" : "");
    }
    words_findings(r);
    printf("  state      hash %016" PRIx64 "\n", r->state_hash);
    if (o->csv != NULL) {
        printf("  wrote      %s\n", o->csv);
    }
    if (o->plot != NULL) {
        printf("  wrote      %s\n", o->plot);
    }
    if (o->trace != NULL) {
        printf("  wrote      %s: %.2f MB, %.0f bytes per step\n", o->trace, (double)r->trace_bytes / 1e6,
               per_step(r, r->trace_bytes));
    }
    if (r->lcm.open) {
        printf("  lcm        %" PRIu64 " messages to %s; %" PRIu64 " dropped, %" PRIu64 " failed\n", r->lcm.sent,
               o->lcm, r->lcm.dropped, r->lcm.failed);
    } else if (o->lcm != NULL) {
        printf("  lcm        NOT THERE: nothing went to %s\n", o->lcm);
    }
    if (r->ended > 0) {
        printf("  ended      by a signal after %.4g s\n", r->ended);
    }
    printf("%s\n", r->failed ? "FAILED" : "ok");
}

static void put_real(json_t *object, const char *key, double value)
{
    json_object_set_new(object, key, json_real(value));
}

static void put_text(json_t *object, const char *key, const char *value)
{
    json_object_set_new(object, key, json_text(value));
}

static void put_run(json_t *object, const struct options *o, const struct level *level)
{
    static const char *const checks[] = {[CHECK_OFF] = "off", [CHECK_SAMPLED] = "sampled", [CHECK_ALL] = "all"};
    put_text(object, "level", level->name);
    put_text(object, "backend", o->backend->name);
    put_text(object, "preset", tahr_preset_name(o->preset));
    json_put_count(object, "characters", o->characters);
    json_put_count(object, "threads", o->threads);
    json_object_set_new(object, "crowd", json_boolean(o->crowd));
    put_real(object, "seconds", o->seconds);
    put_real(object, "rate", o->rate);
    json_put_count(object, "seed", o->seed);
    put_text(object, "check", checks[o->check]);
    json_put_count(object, "bodies", level->body_count);
    json_put_count(object, "triangles", level->triangle_count);
}

static void put_cost(json_t *object, const struct result *r)
{
    json_put_count(object, "steps", r->steps);
    put_real(object, "ns_median", times_quantile(&r->times, 0.5));
    put_real(object, "ns_p99", times_quantile(&r->times, 0.99));
    put_real(object, "ns_mean", times_mean(&r->times));
    json_put_count(object, "ns_max", r->times.greatest);
    put_real(object, "ns_clock", r->clock_cost);
    put_real(object, "sweeps_per_step", per_step(r, r->sweeps));
    put_real(object, "contact_queries_per_step", per_step(r, r->contact_queries));
    put_real(object, "rays_per_step", per_step(r, r->rays));
    put_real(object, "triangle_tests_per_step", per_step(r, r->triangle_tests));
    put_real(object, "gathers_per_step", per_step(r, r->gathers));
    put_real(object, "escapes_per_step", per_step(r, r->escapes));
    json_t *saved = json_object();
    for (uint32_t i = 0; i < TAHR_SHORTCUT_COUNT; i++) {
        put_real(saved, tahr_shortcut_name(i), per_step(r, r->saved[i]));
    }
    json_object_set_new(object, "saved_per_step", saved);
    json_put_count(object, "most_queries", r->most_queries);
    json_put_count(object, "world_bytes", r->world_bytes);
    put_real(object, "load_seconds", r->load_seconds);
    put_real(object, "open_seconds", r->open_seconds);
    put_real(object, "wall_seconds", r->wall_seconds);
}

static void put_behaviour(json_t *object, const struct result *r)
{
    char hash[17];
    snprintf(hash, sizeof hash, "%016" PRIx64, r->state_hash);
    put_real(object, "grounded", per_step(r, r->modes[TAHR_MODE_WALKING]));
    json_put_count(object, "steps_climbed", r->events[TAHR_EVENT_STEPPED_UP]);
    json_put_count(object, "steps_descended", r->events[TAHR_EVENT_STEPPED_DOWN]);
    json_put_count(object, "jumps", r->events[TAHR_EVENT_JUMPED]);
    json_put_count(object, "landings", r->events[TAHR_EVENT_LANDED]);
    json_put_count(object, "fell_out", r->fell_out);
    json_put_count(object, "stuck", r->stuck);
    json_put_count(object, "hung", r->hung);
    json_put_count(object, "bad_states", r->bad_states);
    json_put_count(object, "depenetrated", r->events[TAHR_EVENT_DEPENETRATED]);
    json_put_count(object, "crushed", r->events[TAHR_EVENT_CRUSHED]);
    json_put_count(object, "unknown", r->unknown);
    json_put_count(object, "query_caps", r->query_caps);
    put_real(object, "time_lost", r->time_lost);
    json_put_count(object, "checked", r->checked);
    json_put_count(object, "tunnels", r->tunnels);
    put_real(object, "deepest_penetration", r->deepest);
    put_real(object, "least_clearance", r->least_clearance);
    put_real(object, "least_apart", r->least_apart);
    put_text(object, "state_hash", hash);
    json_object_set_new(object, "ok", json_boolean(!r->failed));
}

/* Every mode's part of the steps, and how often everything happened. */
static void put_counts(json_t *object, const struct result *r)
{
    json_t *modes = json_object(), *events = json_object();
    for (uint32_t i = 0; i < MODES; i++) {
        put_real(modes, tahr_mode_name(i), per_step(r, r->modes[i]));
    }
    for (uint32_t i = 1; i < EVENT_TYPES; i++) {
        json_put_count(events, tahr_event_name(i), r->events[i]);
    }
    json_object_set_new(object, "modes", modes);
    json_object_set_new(object, "events", events);
}

/* When every watched place was first come to, s; null: never. */
static void put_places(json_t *object, const struct level *level)
{
    json_t *places = json_object();
    for (size_t i = 0; i < level->side->count; i++) {
        const struct side_piece *piece = &level->side->pieces[i];
        if (side_is_place(piece)) {
            const char *name = piece->name != NULL && *piece->name ? piece->name : "?";
            json_object_set_new(places, name, piece->reached >= 0 ? json_real(piece->reached) : json_null());
        }
    }
    json_object_set_new(object, "places", places);
}

static void put_lcm(json_t *object, const struct options *o, const struct result *r)
{
    if (o->lcm != NULL) {
        put_text(object, "lcm", o->lcm);
        json_object_set_new(object, "lcm_open", json_boolean(r->lcm.open));
        json_put_count(object, "lcm_sent", r->lcm.sent);
        json_put_count(object, "lcm_thinned", r->lcm.thinned);
        json_put_count(object, "lcm_dropped", r->lcm.dropped);
        json_put_count(object, "lcm_failed", r->lcm.failed);
    }
    if (r->ended > 0) {
        put_real(object, "ended", r->ended);
    }
}

static void put_findings(json_t *object, const struct result *r)
{
    json_t *list = json_array();
    for (size_t i = 0; i < r->finding_count; i++) {
        const struct finding *f = &r->findings[i];
        json_t *entry = json_object();
        put_text(entry, "what", f->what);
        json_put_count(entry, "character", f->character);
        json_put_count(entry, "step", f->step);
        put_real(entry, "time", f->time);
        put_real(entry, "x", f->position.x);
        put_real(entry, "y", f->position.y);
        put_real(entry, "z", f->position.z);
        json_array_append_new(list, entry);
    }
    json_object_set_new(object, "findings", list);
}

void summary_json(const struct options *options, const struct level *level, const struct result *result)
{
    json_t *object = json_object();
    put_run(object, options, level);
    put_cost(object, result);
    put_behaviour(object, result);
    put_counts(object, result);
    if (level->side != NULL) {
        put_places(object, level);
    }
    put_lcm(object, options, result);
    put_findings(object, result);
    json_dumpf(object, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(12));
    putchar('\n');
    json_decref(object);
}
