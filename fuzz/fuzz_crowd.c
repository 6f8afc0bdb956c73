/* SPDX-License-Identifier: MIT
 * fuzz_crowd.c: any scene, any crowd in it, who comes, goes, is put elsewhere or is not in order: whatever the order of
 * arrays and tasks, whether movers are shared, whoever sleeps, the bits are the same; what is wrong changes nothing. */
#include "scene.h"
#include "tape.h"
#include "target.h"

#include <math.h>
#include <string.h>
#include <tahr/crowd.h>
#include <tahr/native.h>

/* MOST: enough for two parts of a tick, which have 16 characters at least. */
enum { MOST = 40, TICKS = 20, CONFIGS = 2, EVENTS = 4 };

/* What no step returns: nobody has written here. */
enum { UNTOUCHED = 12345 };

static const tahr_native_desc fast = {.struct_size = sizeof fast, .cache_triangles = 64};
static const tahr_native_desc plain = {.struct_size = sizeof plain, .no_cache = 1, .no_simd = 1};

/* Arrays of a tick. */
typedef struct arrays {
    tahr_member members[MOST];
    tahr_input inputs[MOST];
    tahr_state states[MOST];
    tahr_delay delays[MOST];
    tahr_report reports[MOST];
    tahr_status statuses[MOST];
    tahr_event events[MOST][EVENTS];
} arrays;

/* The same crowd twice: in order, and in every way otherwise. */
typedef struct twin {
    scene scene;
    tahr_config configs[2][CONFIGS];
    tahr_world *world[2];
    tahr_crowd *crowd[2];
    arrays given, before, other;
    uint32_t place[MOST]; /* in other, of each */
    uint32_t count, capacity, next_id;
} twin;

static void backwards(void *user, tahr_task_fn task, void *argument, uint32_t count)
{
    (void)user;
    while (count-- > 0)
        task(argument, count);
}

static int open_one(twin *t, int which, uint32_t flags, uint32_t tasks)
{
    tahr_crowd_desc desc;
    tahr_crowd_desc_init(&desc, sizeof desc);
    desc.capacity = t->capacity;
    desc.configs = t->configs[which];
    desc.config_count = CONFIGS;
    desc.flags = flags;
    desc.tasks = tasks;
    desc.run_tasks = which ? backwards : NULL;
    t->world[which] = scene_open(&t->scene, tahr_backend_v1_native(), which ? &plain : &fast);
    return t->world[which] && tahr_crowd_create(t->world[which], &desc, &t->crowd[which]) == TAHR_OK;
}

static int open_twin(twin *t, bytes *b)
{
    scene_read(&t->scene, b, SCENE_SENSORS | SCENE_MOVERS | SCENE_FLUIDS);
    for (int i = 0; i < CONFIGS; i++) {
        if (!scene_config(&t->scene, b, &t->configs[0][i])) return 0;
        t->configs[1][i] = t->configs[0][i];
        t->configs[1][i].sleep = 0;
    }
    const uint32_t how = bytes_u8(b);
    const uint32_t heads = how & 1 ? (uint32_t)TAHR_CROWD_STAND_ON_HEADS : 0u;
    t->capacity = 1 + bytes_below(b, MOST);
    return open_one(t, 0, heads, 0) &&
           open_one(t, 1, heads | (how & 2 ? (uint32_t)TAHR_CROWD_LEAN : 0u), 1 + how / 4 % 5);
}

static void close_twin(twin *t)
{
    for (int i = 0; i < 2; i++) {
        tahr_crowd_destroy(t->crowd[i]);
        tahr_world_close(t->world[i]);
    }
}

static tahr_vec3 place_of(const twin *t, bytes *b)
{
    tahr_vec3 p = scene_point(&t->scene, b);
    p.z += 1.5 * t->scene.scale;
    return p;
}

static void add(twin *t, bytes *b)
{
    const uint32_t i = t->count;
    if (i == t->capacity) return;
    arrays *a = &t->given;
    const tahr_vec3 at = place_of(t, b);
    memset(&a->members[i], 0, sizeof a->members[i]);
    memset(&a->delays[i], 0, sizeof a->delays[i]);
    memset(&a->inputs[i], 0, sizeof a->inputs[i]);
    a->members[i].id = t->next_id++;
    a->members[i].config = bytes_below(b, CONFIGS);
    a->inputs[i].struct_size = sizeof a->inputs[i];
    if (tahr_state_init(&a->states[i], &t->configs[0][a->members[i].config], &at) == TAHR_OK) t->count++;
}

static void swap(twin *t, uint32_t i, uint32_t j)
{
    arrays *a = &t->given;
    const tahr_member m = a->members[i];
    const tahr_input in = a->inputs[i];
    const tahr_state s = a->states[i];
    const tahr_delay d = a->delays[i];
    a->members[i] = a->members[j], a->members[j] = m;
    a->inputs[i] = a->inputs[j], a->inputs[j] = in;
    a->states[i] = a->states[j], a->states[j] = s;
    a->delays[i] = a->delays[j], a->delays[j] = d;
}

/* Eight bytes of a state, or of a delay, are something else. */
static void spoil(void *object, size_t size, bytes *b)
{
    static const double bad[] = {NAN, INFINITY, -1, 1e300, 0, 5e-324, 1e7, 0.5};
    const size_t at = (size_t)bytes_u8(b) * 8 % size;
    const double what = bad[bytes_below(b, 8)];
    memcpy((char *)object + at, &what, sizeof what);
}

static void change_member(tahr_member *m, bytes *b)
{
    static const double budgets[] = {0, 0.01, 0.5, 10, 10.5, -1, NAN};
    switch (bytes_below(b, 7)) {
    case 0: m->mask = bytes_u8(b); break;
    case 1: m->groups = bytes_u8(b); break;
    case 2: m->flags ^= TAHR_MEMBER_ALONE; break;
    case 3: m->config = bytes_below(b, CONFIGS); break;
    case 4: m->budget = budgets[bytes_below(b, 7)]; break;
    case 5: m->budget = budgets[bytes_below(b, 3)]; break;
    default: m->flags ^= 1u << bytes_below(b, 4); break;
    }
}

/* Something happens to one of them. */
static void happen(twin *t, bytes *b, double *dt)
{
    arrays *a = &t->given;
    const uint32_t what = bytes_below(b, 16), i = t->count ? bytes_below(b, t->count) : 0;
    if (what < 3 || t->count == 0) {
        add(t, b);
        return;
    }
    switch (what) {
    case 3: swap(t, i, --t->count); break;
    case 4: swap(t, i, bytes_below(b, t->count)); break;
    case 5: {
        const tahr_vec3 at = place_of(t, b);
        tahr_state_teleport(&a->states[i], &at);
        break;
    }
    case 6: a->states[i] = a->states[bytes_below(b, t->count)]; break; /* into another one */
    case 7: spoil(&a->states[i], sizeof a->states[i], b); break;
    case 8: spoil(&a->delays[i], sizeof a->delays[i], b); break;
    case 9:
    case 10: change_member(&a->members[i], b); break;
    case 11: a->members[i].id = a->members[bytes_below(b, t->count)].id; break;
    case 12: memset(&a->delays[i], 0, sizeof a->delays[i]); break;
    default: tape_read(b, t->scene.scale, &t->configs[0][0], &a->inputs[i], dt); break;
    }
}

/* Moves what can be moved, the same in both worlds. */
static void move_bodies(twin *t, bytes *b, double dt)
{
    const scene *s = &t->scene;
    tahr_body_pose poses[SCENE_BODIES];
    uint32_t count = 0;
    const uint32_t how = bytes_u8(b);
    if (s->movers == 0 || !(dt > 0) || how % 4 == 0) return;
    for (uint32_t i = 0; i < s->body_count; i++) {
        if (!(s->bodies[i].flags & TAHR_BODY_MOVABLE)) continue;
        tahr_body_motion motion;
        tahr_world_body(t->world[0], i, &motion);
        tahr_body_pose pose = {i, how == 255 ? (uint32_t)TAHR_POSE_TELEPORT : 0u, motion.pose};
        pose.pose.position.x += (how % 5 - 2.0) * 0.1 * s->scale;
        pose.pose.position.z += (how / 8 % 3 - 1.0) * 0.1 * s->scale;
        poses[count++] = pose;
    }
    for (int i = 0; i < 2; i++)
        FUZZ_CHECK(tahr_world_move(t->world[i], poses, count, dt) == TAHR_OK, "%u bodies", count);
}

/* Who is where in the other arrays: a rotation, turned round. */
static void shuffle(twin *t, uint32_t turn)
{
    for (uint32_t i = 0; i < t->count; i++) {
        const uint32_t at = (i + turn) % t->count;
        t->place[i] = turn % 2 ? t->count - 1 - at : at;
        t->other.members[t->place[i]] = t->given.members[i];
        t->other.inputs[t->place[i]] = t->given.inputs[i];
        t->other.states[t->place[i]] = t->given.states[i];
        t->other.delays[t->place[i]] = t->given.delays[i];
    }
}

static tahr_status tick(const twin *t, int which, arrays *a, double dt)
{
    tahr_crowd_tick k;
    tahr_crowd_tick_init(&k, sizeof k);
    k.count = t->count;
    k.dt = dt;
    k.members = a->members;
    k.inputs = a->inputs;
    k.states = a->states;
    k.reports = a->reports;
    k.statuses = a->statuses;
    k.delays = a->delays;
    for (uint32_t i = 0; i < t->count; i++) {
        memset(&a->reports[i], 0, sizeof a->reports[i]);
        a->reports[i].struct_size = sizeof a->reports[i];
        a->reports[i].events = a->events[i];
        a->reports[i].event_capacity = a->members[i].id % 2 ? EVENTS : 0;
        a->statuses[i] = UNTOUCHED;
    }
    return tahr_crowd_step(t->crowd[which], &k);
}

static int is_number(tahr_vec3 v)
{
    return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

static void check_one(const arrays *a, uint32_t i, double dt)
{
    const tahr_state *s = &a->states[i];
    const tahr_report *r = &a->reports[i];
    FUZZ_CHECK(is_number(s->position) && is_number(s->velocity) && is_number(s->up), "position %g %g %g", s->position.x,
               s->position.y, s->position.z);
    FUZZ_CHECK(isfinite(r->residual) && isfinite(r->step_offset) && r->time_lost >= 0, "report");
    FUZZ_CHECK(r->sweeps + r->contact_queries + r->rays <=
                   9 * (TAHR_MAX_QUERIES_PER_STEP + TAHR_MAX_SENSOR_QUERIES_PER_STEP),
               "%u sweeps", r->sweeps);
    for (uint32_t k = 0; k < r->event_count; k++)
        FUZZ_CHECK(a->events[i][k].time >= 0 && a->events[i][k].time <= 9 * dt && is_number(a->events[i][k].position),
                   "event %u of %u", k, i);
}

/* After the tick: nothing of it where it was refused, and of each who failed. */
static void check_errors(const twin *t, tahr_status status)
{
    const arrays *now = &t->given, *was = &t->before;
    int refused = t->count > 0 && now->statuses[0] == UNTOUCHED;
    FUZZ_CHECK(!refused || status < 0, "%s, and nothing was done", tahr_status_name(status));
    FUZZ_CHECK(status != TAHR_E_BACKEND, "native gave an invalid answer");
    for (uint32_t i = 0; i < t->count; i++) {
        FUZZ_CHECK(refused == (now->statuses[i] == UNTOUCHED), "status of %u", i);
        if (!refused && now->statuses[i] >= 0) continue;
        FUZZ_CHECK(memcmp(&now->states[i], &was->states[i], sizeof now->states[i]) == 0, "state of %u after %s", i,
                   tahr_status_name(refused ? status : now->statuses[i]));
        FUZZ_CHECK(!refused || memcmp(&now->delays[i], &was->delays[i], sizeof now->delays[i]) == 0, "delay of %u", i);
    }
}

static void check_same(const twin *t)
{
    const arrays *a = &t->given, *b = &t->other;
    for (uint32_t i = 0; i < t->count; i++) {
        const uint32_t k = t->place[i];
        FUZZ_CHECK(a->statuses[i] == b->statuses[k], "%u: %s and %s", a->members[i].id,
                   tahr_status_name(a->statuses[i]), tahr_status_name(b->statuses[k]));
        FUZZ_CHECK(memcmp(&a->states[i], &b->states[k], sizeof a->states[i]) == 0, "state of %u", a->members[i].id);
        FUZZ_CHECK(memcmp(&a->delays[i], &b->delays[k], sizeof a->delays[i]) == 0, "delay of %u", a->members[i].id);
        FUZZ_CHECK((a->reports[i].flags & ~(uint32_t)TAHR_REPORT_ASLEEP) == b->reports[k].flags, "report of %u: %x, %x",
                   a->members[i].id, a->reports[i].flags, b->reports[k].flags);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static twin t;
    bytes b = {data, data + size};
    memset(&t, 0, sizeof t);
    if (open_twin(&t, &b)) {
        for (int n = 0; n < TICKS && bytes_left(&b) > 0; n++) {
            double dt = 1.0 / 60;
            for (uint32_t k = bytes_below(&b, 8); k > 0; k--)
                happen(&t, &b, &dt);
            if (t.count == 0) continue;
            move_bodies(&t, &b, dt);
            t.before = t.given;
            shuffle(&t, bytes_u8(&b));
            const tahr_status status = tick(&t, 0, &t.given, dt), other = tick(&t, 1, &t.other, dt);
            FUZZ_CHECK((status < 0) == (other < 0), "%s and %s", tahr_status_name(status), tahr_status_name(other));
            check_errors(&t, status);
            if (t.given.statuses[0] == UNTOUCHED) continue;
            FUZZ_CHECK(status == other, "%s and %s", tahr_status_name(status), tahr_status_name(other));
            check_same(&t);
            for (uint32_t i = 0; i < t.count; i++)
                if (t.given.statuses[i] >= 0) check_one(&t.given, i, dt);
        }
    }
    close_twin(&t);
    return 0;
}
