/* SPDX-License-Identifier: MIT
 * crowd.c: one tick of many characters.
 *
 * First every character is copied as the others see it, then each takes its step against those copies: no step reads
 * what another one writes, so that neither order nor threads change a bit. A step that went farther than was foreseen,
 * which a push out of a deep overlap may, did not look far enough around: it is taken again, against everybody. */
#include "crowd.h"

#include <stdio.h>
#include <string.h>

#include "arguments.h"
#include "message.h"
#include "support.h"

/* Below this many characters a part is not worth a task. */
enum { LEAST_PART = 16 };

/* Stands for a step that must be taken again. */
enum { AGAIN = 1000 };

static void run(const tahr__tick *t, tahr_task_fn task)
{
    const tahr_crowd *c = t->crowd;
    if (c->run_tasks && t->tasks > 1) {
        c->run_tasks(c->run_user, task, (void *)(uintptr_t)t, t->tasks);
        return;
    }
    for (uint32_t i = 0; i < t->tasks; i++) {
        task((void *)(uintptr_t)t, i);
    }
}

static uint32_t part_begin(const tahr__tick *t, uint32_t part)
{
    return (uint32_t)((uint64_t)t->asked->count * part / t->tasks);
}

/* Is the state good enough to be seen by others? Comparisons with a NaN are false. */
static int is_visible(const tahr_state *s)
{
    const tahr_quat q = s->orientation;
    const double up = length_squared(s->up) - 1, turn = (q.x * q.x + q.y * q.y) + (q.z * q.z + q.w * q.w) - 1;
    return length_squared(s->position) <= 4e14 && length_squared(s->velocity) <= 1e10 && up * up < 1e-12 &&
           turn * turn < 1e-12 && s->radius >= 0 && s->radius <= 1e4 && s->half_height > 0 && s->half_height <= 1e4 &&
           length_squared(s->base.velocity) <= 1e12;
}

static void use_kind(tahr_crowd *c, uint32_t i, uint32_t kind)
{
    if (c->kind_of[i] != kind) {
        tahr_mover *m = c->movers[i];
        m->config = c->kinds[kind]->config;
        m->limits = c->kinds[kind]->limits;
        m->plain = c->kinds[kind]->plain;
        m->sleep.noted = 0;
        c->kind_of[i] = kind;
    }
}

static void look_at_part(void *argument, uint32_t index)
{
    const tahr__tick *t = argument;
    tahr_crowd *c = t->crowd;
    tahr__part *part = &c->parts[index];
    memset(part, 0, sizeof *part);
    part->bad = ~0u;
    tahr__spread_begin(&part->spread);
    for (uint32_t i = part_begin(t, index); i < part_begin(t, index + 1); i++) {
        part->field = tahr__tick_check_one(t, i, &part->status, &part->why);
        if (part->field) {
            part->bad = i;
            return;
        }
        const tahr_member member = tick_member(t, i);
        const tahr_state *state = &t->asked->states[i];
        tahr__figure *f = &c->figures[i];
        use_kind(c, i, member.config);
        if (is_visible(state)) {
            tahr__figure_of(f, c->movers[i], &member, tick_input(t, i), state, t->asked->dt);
        }
        if (!is_visible(state) || !vec_is_finite(f->at) || !vec_is_finite(f->box)) {
            f->id = member.id;
            f->box.x = -1;
        }
        tahr__spread_add(&part->spread, f);
    }
}

static void place_part(void *argument, uint32_t index)
{
    const tahr__tick *t = argument;
    for (uint32_t i = part_begin(t, index); i < part_begin(t, index + 1); i++) {
        tahr__grid_place(&t->crowd->grid, i);
    }
}

/* Sorted by body; more than there is room for: those that are farthest are left out. */
typedef struct gathering {
    tahr__neighbours found;
    tahr__neighbour planes[TAHR__NEIGHBOURS];
    int truncated;
} gathering;

/* m, from the character to a plane. */
static double away(const tahr__figure *f, const tahr__neighbour *plane)
{
    const tahr__solid solid = {&f->shape, f->up, f->orientation};
    return -tahr__support(&solid, scale(plane->normal, -1)) - plane->offset;
}

static void leave_out_farthest(gathering *g, const tahr__figure *f)
{
    uint32_t farthest = 0;
    for (uint32_t i = 1; i < g->found.count; i++) {
        farthest = away(f, &g->planes[i]) > away(f, &g->planes[farthest]) ? i : farthest;
    }
    g->found.count--;
    memmove(&g->planes[farthest], &g->planes[farthest + 1], (g->found.count - farthest) * sizeof g->planes[0]);
    g->truncated = 1;
}

static void add_neighbour(gathering *g, const tahr__figure *f, const tahr__neighbour *plane)
{
    uint32_t at = g->found.count++;
    for (; at > 0 && g->planes[at - 1].body > plane->body; at--) {
        g->planes[at] = g->planes[at - 1];
    }
    g->planes[at] = *plane;
    if (g->found.count == TAHR__NEIGHBOURS) {
        leave_out_farthest(g, f);
    }
}

static void gather(const tahr__tick *t, uint32_t i, gathering *g)
{
    const tahr_crowd *c = t->crowd;
    const tahr__figure *f = &c->figures[i];
    uint32_t begin[5], end[5];
    g->found = (tahr__neighbours){.anchor = f->at, .walkable_rule = c->walkable_rule, .planes = g->planes};
    g->truncated = 0;
    if (f->box.x < 0 || f->mask == 0) {
        return;
    }
    const int runs = tahr__grid_around(&c->grid, i, begin, end);
    for (int k = 0; k < runs; k++) {
        for (uint32_t at = begin[k]; at < end[k]; at++) {
            const tahr__figure *o = &c->figures[c->grid.order[at]];
            tahr__neighbour plane;
            if (figures_near(f, o, f->extra + o->extra) && o != f && figures_meet(f, o) &&
                tahr__figure_plane(f, o, f->escaped != 0, t->flat, &plane)) {
                add_neighbour(g, f, &plane);
            }
        }
    }
}

static double largest(vec3 v)
{
    return max_of(fabs(v.x), max_of(fabs(v.y), fabs(v.z)));
}

/* m that it went farther than was foreseen; 0 or less: it did not. */
static double beyond(const tahr__figure *f, const tahr_state *s)
{
    vec3 way = sub(s->position, f->at);
    double x = fabs(way.x) - f->reach.x, y = fabs(way.y) - f->reach.y, z = fabs(way.z) - f->reach.z;
    return max_of(x, max_of(y, z)) - f->extra;
}

static void note(tahr__part *part, const gathering *g)
{
    part->counts.steps++;
    part->counts.beside += g->found.count > 0;
    if (g->found.count > part->counts.most_neighbours) {
        part->counts.most_neighbours = g->found.count;
    }
}

/* The step itself, with who is near. Returns its status; AGAIN: it went too far, and nothing is written. */
static tahr_status take_step(const tahr__tick *t, uint32_t i, const gathering *g)
{
    tahr_crowd *c = t->crowd;
    const tahr__figure *f = &c->figures[i];
    tahr_mover *mover = c->movers[i];
    tahr_report *report = tick_report(t, i);
    tahr_state *state = &t->asked->states[i], s = *state;
    mover->neighbours = g->found.count > 0 ? &g->found : NULL;
    tahr_status status = tahr_mover_step(mover, tick_input(t, i), t->asked->dt, &s, report);
    mover->neighbours = NULL;
    if (status < 0) {
        return status;
    }
    if (f->box.x >= 0 && f->mask != 0 && beyond(f, &s) > 0 && t->asked->count > 1 && t->asked->dt > 0) {
        c->farther[i] = 2 * largest(sub(s.position, f->at));
        return AGAIN;
    }
    if (world_is_character(c->world, s.floor.body)) {
        s.floor_revision = 0; /* it may be elsewhere when it is looked at again */
    }
    *state = s;
    if (g->truncated) {
        if (report) {
            report->flags |= TAHR_REPORT_TRUNCATED;
        }
        status = status > TAHR_TRUNCATED ? status : TAHR_TRUNCATED;
    }
    return status;
}

static void step_part(void *argument, uint32_t index)
{
    const tahr__tick *t = argument;
    tahr_crowd *c = t->crowd;
    for (uint32_t i = part_begin(t, index); i < part_begin(t, index + 1); i++) {
        gathering g;
        gather(t, i, &g);
        note(&c->parts[index], &g);
        c->statuses[i] = take_step(t, i, &g);
    }
}

/* A second time too far: it stays where it is, which no plane forbids. */
static tahr_status hold(const tahr__tick *t, uint32_t i)
{
    tahr_report *report = tick_report(t, i);
    if (report) {
        report->flags |= TAHR_REPORT_QUERY_CAP;
        report->time_lost = t->asked->dt;
    }
    return TAHR_QUERY_CAP;
}

static void step_again(const tahr__tick *t)
{
    tahr_crowd *c = t->crowd;
    uint32_t count = 0;
    for (uint32_t i = 0; i < t->asked->count; i++) {
        if (c->statuses[i] == AGAIN) {
            c->figures[i].escaped = 1;
            c->figures[i].extra = c->farther[i];
            count++;
        }
    }
    for (uint32_t i = 0; i < t->asked->count && count > 0; i++) {
        if (c->figures[i].escaped) {
            gathering g;
            gather(t, i, &g);
            tahr_status status = take_step(t, i, &g);
            c->statuses[i] = status == AGAIN ? hold(t, i) : status;
        }
    }
    c->counts.again += count;
}

/* Returns what the tick came to. */
static tahr_status finish(const tahr__tick *t)
{
    tahr_crowd *c = t->crowd;
    tahr_status worst = TAHR_OK;
    uint32_t failed = ~0u;
    for (uint32_t i = 0; i < t->asked->count; i++) {
        tahr_status status = c->statuses[i];
        if (t->asked->statuses) {
            t->asked->statuses[i] = status;
        }
        if (status < 0 && (failed == ~0u || c->figures[i].id < c->figures[failed].id)) {
            failed = i;
        }
        worst = status > worst ? status : worst;
    }
    for (uint32_t i = 0; i < t->tasks; i++) {
        const tahr_crowd_counts *one = &c->parts[i].counts;
        c->counts.steps += one->steps;
        c->counts.beside += one->beside;
        c->counts.deferred += one->deferred;
        c->counts.ahead += one->ahead;
        if (one->most_neighbours > c->counts.most_neighbours) {
            c->counts.most_neighbours = one->most_neighbours;
        }
    }
    c->counts.ticks++;
    if (failed == ~0u) {
        return worst;
    }
    char text[128];
    snprintf(text, sizeof text, "character %u, at index %u, is left as it was: %s", c->figures[failed].id, failed,
             tahr_status_message(c->statuses[failed]));
    tahr__say(&c->world->log, TAHR_LOG_ERROR, "tahr_crowd_step", text);
    return c->statuses[failed];
}

/* The first character, by index, with something wrong that stops the tick. */
static tahr_status find_bad(const tahr__tick *t)
{
    const tahr_crowd *c = t->crowd;
    for (uint32_t i = 0; i < t->tasks; i++) {
        const tahr__part *part = &c->parts[i];
        if (part->bad != ~0u) {
            char field[64];
            const char *dot_at = strchr(part->field, '.');
            snprintf(field, sizeof field, "%.*s[%u]%s", (int)(dot_at - part->field), part->field, part->bad, dot_at);
            return tahr__complain(&c->world->log, part->status, "tahr_crowd_step", field, part->why);
        }
    }
    return tahr__tick_check_ids(t);
}

static void look_around(tahr__tick *t)
{
    tahr_crowd *c = t->crowd;
    tahr__spread *all = &c->parts[0].spread;
    for (uint32_t i = 1; i < t->tasks; i++) {
        tahr__spread_merge(all, &c->parts[i].spread);
    }
    c->grid.count = t->asked->count;
    tahr__grid_begin(&c->grid, all);
    run(t, place_part);
    tahr__grid_sort(&c->grid);
}

tahr_status tahr_crowd_step(tahr_crowd *crowd, const tahr_crowd_tick *asked)
{
    tahr__tick t;
    if (!crowd) {
        return TAHR_E_NULL;
    }
    tahr_status status = tahr__tick_check(crowd, asked, &t);
    if (status < 0 || asked->count == 0) {
        return status;
    }
    const uint32_t parts = asked->count / LEAST_PART;
    t.tasks = parts < 1 ? 1 : (parts < crowd->tasks ? parts : crowd->tasks);
    crowd->busy = 1;
    run(&t, look_at_part);
    status = find_bad(&t);
    if (status >= 0) {
        look_around(&t);
        run(&t, step_part);
        step_again(&t);
        status = finish(&t);
    }
    crowd->busy = 0;
    return status;
}
