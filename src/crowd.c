/* SPDX-License-Identifier: MIT
 * crowd.c: one tick of many characters.
 *
 * First every character is copied as the others see it, then each takes its step against those copies: no step reads
 * what another one writes, so that neither order nor threads change a bit. A step that went farther than was foreseen,
 * which a push out of a deep overlap may, did not look far enough around: it is taken again, against everybody. */
#include "crowd.h"
#include "crowd_delay.h"
#include "crowd_rest.h"

#include <stdio.h>
#include <string.h>

#include "message.h"
#include "sleep.h"

/* Below this many characters a part is not worth a task. */
enum { LEAST_PART = 16 };

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

/* Whose config a character has: a mover that nobody steps. */
static const tahr_mover *kind_of(const tahr__tick *t, uint32_t i)
{
    return t->crowd->kinds[t->asked->members ? t->asked->members[i].config : 0];
}

/* The mover that takes a character's step, with its config. */
static tahr_mover *mover_of(const tahr__tick *t, uint32_t i, const tahr__part *part)
{
    const tahr_crowd *c = t->crowd;
    const uint32_t kind = t->asked->members ? t->asked->members[i].config : 0;
    const uint32_t at = c->is_lean ? (uint32_t)(part - c->parts) : i;
    tahr_mover *m = c->movers[at];
    if (c->kind_of[at] != kind) {
        m->config = c->kinds[kind]->config;
        m->limits = c->kinds[kind]->limits;
        m->plain = c->kinds[kind]->plain;
        m->pace = c->kinds[kind]->pace;
        m->dive = c->kinds[kind]->dive;
        m->may_go_short_way = c->kinds[kind]->may_go_short_way;
        m->not_quick = c->kinds[kind]->not_quick;
        m->calm = c->kinds[kind]->calm;
        m->calm.may = m->calm.may && !c->is_lean;
        mover_wake(m);
        c->kind_of[at] = kind;
    }
    return m;
}

/* Of a large crowd every eighth tells enough of how large characters are and how they are spread: no result depends on
 * the grid, only how soon it is found. Not a regular eighth: arrays often have a period. */
static int is_sample(const tahr__tick *t, uint32_t i)
{
    return t->asked->count < 256 || i * 2654435769u < 0x20000000u;
}

/* Who a character without a member is. */
static const tahr_member PLAIN = {.groups = 1, .mask = ~0u};

/* Puts into a figure who it is, unless it is that already, in which case it returns 1. */
static int identify(tahr__figure *f, const tahr_member *m, uint32_t id)
{
    const uint32_t groups = m->groups ? m->groups : 1;
    const uint32_t mask = m->flags & TAHR_MEMBER_ALONE ? 0 : (m->mask ? m->mask : ~0u);
    const int same = f->id == id && f->groups == groups && f->mask == mask;
    f->id = id;
    f->groups = groups;
    f->mask = mask;
    return same;
}

/* Would its step be the one that its mover has noted? */
static int is_still(const tahr__tick *t, uint32_t i, const tahr_input *input, const tahr_state *state)
{
    const tahr_crowd *c = t->crowd;
    return t->looked && c->resting[i] ? c->still[i]
                                      : sleeps_on(&c->movers[i]->sleep, t->revision, input, t->asked->dt, state);
}

/* Of a character: its figure, unless that and its step are those of the last tick. */
static void look_at(const tahr__tick *t, uint32_t i, const tahr_member *m, tahr__part *part)
{
    const tahr_crowd *c = t->crowd;
    const tahr_input *input = tick_input(t, i);
    const tahr_state *state = &t->asked->states[i];
    tahr__figure *f = &c->figures[i];
    const int same = identify(f, m, m == &PLAIN ? i : m->id);
    if (same && f->flags & TAHR__FIGURE_NOTED && c->kind_of[i] == m->config && m->budget == 0 &&
        t->input_stride == sizeof *input && is_still(t, i, input, state)) {
        f->flags = (f->flags & ~(uint32_t)TAHR__FIGURE_STRAYED) | TAHR__FIGURE_STILL;
        f->range.extra = 0;
        part->still++;
    } else {
        tahr__figure_of(f, c->kinds[m->config], input, state, t->asked->dt);
    }
    if (is_sample(t, i)) {
        tahr__spread_add(&part->spread, f);
    }
}

/* Movers lie anywhere in memory, so that no processor foresees where the next one is. Its first lines are enough: what
 * follows them is in order. */
static void fetch_sleep(const tahr_mover *mover)
{
#ifdef __GNUC__
    __builtin_prefetch(&mover->sleep);
    __builtin_prefetch(&mover->sleep.state);
    __builtin_prefetch(&mover->sleep.state.orientation);
#else
    (void)mover;
#endif
}

static void find_rests(void *argument, uint32_t index)
{
    const tahr__tick *t = argument;
    tahr__part *part = &t->crowd->parts[index];
    const uint32_t begin = part_begin(t, index), end = part_begin(t, index + 1);
    part->rests = t->crowd->kinds[0]->wide ? tahr__rests_wide(t, begin, end) : tahr__rests(t, begin, end);
}

static void look_at_part(void *argument, uint32_t index)
{
    const tahr__tick *t = argument;
    tahr_crowd *c = t->crowd;
    tahr__part *part = &c->parts[index];
    part->counts = (tahr_crowd_counts){.struct_size = 0};
    part->still = part->strays = 0;
    part->bad = ~0u;
    tahr__spread_begin(&part->spread, c->grid.cells.axis);
    const uint32_t begin = part_begin(t, index), end = part_begin(t, index + 1);
    const tahr_member *members = t->asked->members;
    for (uint32_t i = begin; i < end; i++) {
        if (!t->looked && i + 3 < end && c->figures[i + 3].flags & TAHR__FIGURE_NOTED) {
            fetch_sleep(c->movers[i + 3]);
        }
        part->field = tahr__tick_check_one(t, i, &part->status, &part->why);
        if (part->field) {
            part->bad = i;
            return;
        }
        look_at(t, i, members ? &members[i] : &PLAIN, part);
    }
}

static void place_part(void *argument, uint32_t index)
{
    const tahr__tick *t = argument;
    const uint32_t kept = t->same_cells ? (uint32_t)TAHR__FIGURE_STILL : 0u;
    tahr__grid_place(&t->crowd->grid, part_begin(t, index), part_begin(t, index + 1), kept);
}

static int meets_in(const tahr_crowd *c, const tahr__figure *f, uint32_t begin, uint32_t end)
{
    for (uint32_t at = begin; at < end; at++) {
        const tahr__figure *o = &c->figures[c->grid.order[at]];
        if (o != f && figures_near(f, o, 0) && figures_meet(f, o)) {
            return 1;
        }
    }
    return 0;
}

/* Is anybody near? Whoever is found twice is found. */
static int has_company(const tahr_crowd *c, uint32_t i)
{
    const tahr__grid *g = &c->grid;
    const tahr__figure *f = &c->figures[i];
    if (g->wide_count > 0 && meets_in(c, f, 0, g->bucket[i] == 0 ? g->start[g->mask + 2] : g->wide_count)) {
        return 1;
    }
    for (int k = 0; k < 4 && g->bucket[i] != 0; k++) {
        const uint64_t cell = g->corner[i] + (k & 1 ? TAHR__ALONG : 0) + (k & 2 ? TAHR__ACROSS : 0);
        const uint32_t *start = &g->start[grid_bucket(g, cell)];
        if (start[0] < start[1] && meets_in(c, f, start[0], start[1])) {
            return 1;
        }
    }
    return 0;
}

static void meet_part(void *argument, uint32_t index)
{
    const tahr__tick *t = argument;
    tahr_crowd *c = t->crowd;
    for (uint32_t i = part_begin(t, index); i < part_begin(t, index + 1); i++) {
        tahr__figure *f = &c->figures[i];
        f->flags &= ~(uint32_t)TAHR__FIGURE_BESIDE;
        if (f->flags & TAHR__FIGURE_THERE && has_company(c, i)) {
            f->flags |= TAHR__FIGURE_BESIDE;
            tahr__look_of(&c->looks[i], kind_of(t, i), &t->asked->states[i], t->asked->dt);
        }
    }
}

/* Sorted by body; of more than there is room for those that are farthest are left out. */
typedef struct gathering {
    tahr__neighbours found;
    tahr__neighbour planes[TAHR__NEIGHBOURS];
    int truncated;
} gathering;

static void leave_out_farthest(gathering *g, const tahr__look *look)
{
    uint32_t farthest = 0;
    for (uint32_t i = 1; i < g->found.count; i++) {
        int more = tahr__figure_away(look, &g->planes[i]) > tahr__figure_away(look, &g->planes[farthest]);
        farthest = more ? i : farthest;
    }
    g->found.count--;
    memmove(&g->planes[farthest], &g->planes[farthest + 1], (g->found.count - farthest) * sizeof g->planes[0]);
    g->truncated = 1;
}

static void add_neighbour(gathering *g, const tahr__look *look, const tahr__neighbour *plane)
{
    uint32_t at = g->found.count++;
    for (; at > 0 && g->planes[at - 1].body > plane->body; at--) {
        g->planes[at] = g->planes[at - 1];
    }
    g->planes[at] = *plane;
    if (g->found.count == TAHR__NEIGHBOURS) {
        leave_out_farthest(g, look);
    }
}

/* Returns 0 if they cannot meet. */
static int plane_between(const tahr__tick *t, uint32_t i, uint32_t j, tahr__neighbour *plane)
{
    const tahr_crowd *c = t->crowd;
    const tahr__party self = {&c->figures[i], &c->looks[i]}, other = {&c->figures[j], &c->looks[j]};
    const uint32_t again = self.figure->flags & TAHR__FIGURE_STRAYED ? (uint32_t)TAHR__PAIR_AGAIN : 0u;
    if (again && !(other.figure->flags & TAHR__FIGURE_STRAYED) && !figures_near(self.figure, other.figure, 0)) {
        tahr__figure_wall(self, other.figure, t->rules, plane);
        return 1;
    }
    return tahr__figure_plane(self, other, t->rules | again, plane);
}

static void gather(const tahr__tick *t, uint32_t i, gathering *g)
{
    const tahr_crowd *c = t->crowd;
    const tahr__figure *f = &c->figures[i];
    uint32_t begin[5], end[5];
    g->found = (tahr__neighbours){.anchor = f->range.at, .walkable_rule = c->walkable_rule, .planes = g->planes};
    g->truncated = 0;
    const int runs = grid_around(&c->grid, i, begin, end);
    for (int k = 0; k < runs; k++) {
        for (uint32_t at = begin[k]; at < end[k]; at++) {
            const uint32_t j = c->grid.order[at];
            const tahr__figure *o = &c->figures[j];
            tahr__neighbour plane;
            if (figures_near(f, o, f->range.extra + o->range.extra) && o != f && figures_meet(f, o) &&
                plane_between(t, i, j, &plane)) {
                add_neighbour(g, &c->looks[i], &plane);
            }
        }
    }
}

/* The step itself. company: who is there. Returns its status, or TAHR__STRAYED. */
static inline tahr_status take_step(const tahr__tick *t, uint32_t i, tahr__company *company, tahr__part *part)
{
    tahr_crowd *c = t->crowd;
    const tahr_member *member = t->asked->members ? &t->asked->members[i] : NULL;
    tahr_state *state = &t->asked->states[i];
    tahr_mover *mover = mover_of(t, i, part);
    tahr_status status;
    int noted = 0;
    if (member && member->budget > 0) {
        const tahr__turn turn = {.mover = mover,
                                 .input = tick_input(t, i),
                                 .dt = t->asked->dt,
                                 .state = state,
                                 .report = tick_report(t, i),
                                 .company = company,
                                 .counts = &part->counts};
        status = tahr__turn_delayed(&turn, member, &t->asked->delays[i]);
    } else {
        mover->company = company;
        status = tahr_mover_step(mover, tick_input(t, i), t->asked->dt, state, tick_report(t, i));
        mover->company = NULL;
        if (mover->sleep.noted && status >= 0 && t->asked->dt > 0 && !c->is_lean) {
            c->figures[i].flags |= TAHR__FIGURE_NOTED;
            c->resting[i] = tahr__rest_note(&c->rests[i], mover, member);
            part->rests += c->resting[i] != 0;
            noted = 1;
        }
    }
    if (!noted) {
        c->resting[i] = 0;
    }
    if (status == TAHR__STRAYED) {
        c->strayed[i] = company->strayed;
    } else if (state->floor.body >= TAHR_CHARACTER_BODY && state->floor.body != TAHR_NO_BODY) {
        state->floor_revision = 0; /* it may be elsewhere when it is looked at again */
    }
    return status;
}

/* The same among others. */
static tahr_status take_step_among(const tahr__tick *t, uint32_t i, tahr__part *part)
{
    gathering g;
    tahr__company company = {.neighbours = &g.found, .range = &t->crowd->figures[i].range};
    gather(t, i, &g);
    company.neighbours = g.found.count > 0 ? &g.found : NULL;
    part->counts.beside += g.found.count > 0;
    if (g.found.count > part->counts.most_neighbours) {
        part->counts.most_neighbours = g.found.count;
    }
    tahr_status status = take_step(t, i, &company, part);
    if (g.truncated && status >= 0 && status != TAHR__STRAYED) {
        tahr_report *report = tick_report(t, i);
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
    tahr__part *part = &c->parts[index];
    const uint32_t begin = part_begin(t, index), end = part_begin(t, index + 1);
    const uint32_t untold = t->looked && !t->asked->reports;
    part->rests = part->woken = 0;
    for (uint32_t i = begin; i < end; i++) {
        const uint32_t flags = c->figures[i].flags & (TAHR__FIGURE_STILL | TAHR__FIGURE_BESIDE);
        if (untold && flags == TAHR__FIGURE_STILL && c->resting[i]) { /* its status is that of the last tick */
            part->rests++;
            continue;
        }
        part->woken++;
        if (flags == TAHR__FIGURE_STILL &&
            tahr__sleep_again(&c->movers[i]->sleep, tick_report(t, i), &c->statuses[i])) {
            part->rests += c->resting[i] != 0;
            continue;
        }
        tahr__company company = {.range = &c->figures[i].range};
        tahr_status status =
            flags & TAHR__FIGURE_BESIDE ? take_step_among(t, i, part) : take_step(t, i, &company, part);
        c->statuses[i] = status;
        part->strays += status == TAHR__STRAYED;
    }
    part->counts.steps += end - begin;
}

/* A second time too far: it stays where it is, which no plane forbids. */
static tahr_status hold(const tahr__tick *t, uint32_t i)
{
    tahr_report *report = tick_report(t, i);
    tahr__turn_report(report, TAHR_REPORT_QUERY_CAP | TAHR_REPORT_TIME_LOST);
    if (report) {
        report->time_lost = t->asked->dt;
    }
    return TAHR_QUERY_CAP;
}

static void step_again(const tahr__tick *t)
{
    tahr_crowd *c = t->crowd;
    uint32_t count = 0, strays = 0;
    for (uint32_t i = 0; i < t->tasks; i++) {
        strays += c->parts[i].strays;
    }
    for (uint32_t i = 0; i < t->asked->count && count < strays; i++) {
        if (c->statuses[i] == TAHR__STRAYED) {
            c->figures[i].flags |= TAHR__FIGURE_STRAYED;
            c->figures[i].range.extra = 2 * c->strayed[i];
            tahr__look_of(&c->looks[i], kind_of(t, i), &t->asked->states[i], t->asked->dt);
            count++;
        }
    }
    for (uint32_t i = 0; i < t->asked->count && count > 0; i++) {
        if (c->figures[i].flags & TAHR__FIGURE_STRAYED) {
            const uint64_t beside = c->parts[0].counts.beside; /* it was counted the first time */
            tahr_status status = take_step_among(t, i, &c->parts[0]);
            c->parts[0].counts.beside = beside;
            c->statuses[i] = status == TAHR__STRAYED ? hold(t, i) : status;
        }
    }
    c->counts.again += count;
}

/* Did everybody rest? Then as long as everybody does the next ticks come to the same. */
static void settle(const tahr__tick *t, tahr_status status)
{
    tahr_crowd *c = t->crowd;
    uint32_t rests = 0, woken = 0;
    for (uint32_t i = 0; i < t->tasks; i++) {
        rests += c->parts[i].rests;
        woken += c->parts[i].woken;
    }
    c->has_rests = rests > 0;
    c->settled = woken == 0;
    c->worst = status;
}

/* A tick of who all rest, and did in the last one, and tell nobody. Looks who does. Returns 0: it is not that. */
static int rests_on(tahr__tick *t)
{
    tahr_crowd *c = t->crowd;
    uint32_t rests = 0;
    if (bits_of(c->rest_dt) != bits_of(t->asked->dt) || c->rest_revision != t->revision) {
        memset(c->resting, 0, c->capacity * sizeof *c->resting);
        c->rest_dt = t->asked->dt;
        c->rest_revision = t->revision;
        c->has_rests = 0;
    }
    if (!c->has_rests || t->input_stride != sizeof(tahr_input)) {
        return 0;
    }
    run(t, find_rests);
    t->looked = 1;
    for (uint32_t i = 0; i < t->tasks; i++) {
        rests += c->parts[i].rests;
    }
    if (!c->settled || rests < t->asked->count || c->grid.count != t->asked->count || t->asked->reports) {
        return 0;
    }
    if (t->asked->statuses) {
        memcpy(t->asked->statuses, c->statuses, rests * sizeof c->statuses[0]);
    }
    c->counts.ticks++;
    c->counts.steps += rests;
    return 1;
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

/* Who is beside whom. Where nobody has changed nobody's company has. */
static void look_around(tahr__tick *t)
{
    tahr_crowd *c = t->crowd;
    tahr__spread *all = &c->parts[0].spread;
    uint32_t still = c->parts[0].still;
    for (uint32_t i = 1; i < t->tasks; i++) {
        tahr__spread_merge(all, &c->parts[i].spread);
        still += c->parts[i].still;
    }
    if (still == t->asked->count && still == c->grid.count) {
        return;
    }
    const tahr__cells before = c->grid.cells;
    const int same_count = c->grid.count == t->asked->count;
    c->grid.count = t->asked->count;
    tahr__grid_begin(&c->grid, all);
    t->same_cells = same_count && memcmp(&before, &c->grid.cells, sizeof before) == 0;
    run(t, place_part);
    tahr__grid_sort(&c->grid);
    run(t, meet_part);
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
    if (rests_on(&t)) {
        crowd->busy = 0;
        return crowd->worst;
    }
    crowd->settled = 0;
    run(&t, look_at_part);
    status = find_bad(&t);
    if (status >= 0) {
        look_around(&t);
        run(&t, step_part);
        step_again(&t);
        status = finish(&t);
        settle(&t, status);
    }
    crowd->busy = 0;
    return status;
}
