/* SPDX-License-Identifier: MIT
 * fuzz_liar.c: a backend that answers whatever the bytes say: not numbers, fractions of -1 and 2, counts above the
 * capacity, something else each time. A step ends with a status, an untouched state on an error, and finite numbers. */
#include "tape.h"
#include "target.h"

#include <math.h>
#include <string.h>
#include <tahr/backend.h>

enum { MOST_STEPS = 40, EVENTS = 16 };

/* Where the lies come from. One at a time: a fuzzer runs one input after the other. */
typedef struct liar {
    bytes *b;
    uint32_t asked;
} liar;

static double number(bytes *b)
{
    static const double some[] = {0,    1,    -1,    0.5,    2,     1e-300, -1e-9, 1e300, 1e9,
                                  0.25, 1e-3, -1e-3, 0.0625, 1e-12, 0.999,  1e5,   -2,    0.75};
    uint32_t how = bytes_u8(b);
    if (how == 255) return NAN;
    if (how == 254) return INFINITY;
    if (how == 253) return -INFINITY;
    return some[how % 18];
}

static tahr_vec3 vector(bytes *b)
{
    static const tahr_vec3 units[] = {{0, 0, 1}, {0, 0, -1},    {1, 0, 0},      {-1, 0, 0},
                                      {0, 1, 0}, {0, 0.6, 0.8}, {0.6, 0, -0.8}, {0, 0, 0}};
    uint32_t how = bytes_u8(b);
    if (how < 224) return units[how % 8];
    tahr_vec3 v;
    v.x = number(b);
    v.y = number(b);
    v.z = number(b);
    return v;
}

static tahr_status status_of(bytes *b)
{
    static const tahr_status some[] = {TAHR_TRUNCATED, TAHR_UNKNOWN, TAHR_E_MEMORY,  TAHR_E_ARGUMENT,
                                       -999,           77,           TAHR_E_BACKEND, TAHR_CRUSHED};
    uint32_t how = bytes_u8(b);
    return how < 248 ? TAHR_OK : some[how - 248];
}

static void fill_hit(bytes *b, tahr_hit *h)
{
    uint32_t how = bytes_u8(b);
    memset(h, how == 255 ? 0xFF : 0, sizeof *h);
    if (how == 255) return;
    h->blocking = how % 2;
    h->start_overlap = how / 2 % 8 == 7;
    h->unknown = how / 16 % 16 == 15;
    h->sensor = how / 16 % 8 == 6;
    h->fraction = number(b);
    h->distance = number(b);
    h->depth = number(b);
    h->normal = vector(b);
    h->surface_normal = how % 4 ? h->normal : vector(b);
    h->point = vector(b);
    h->body = how % 32 == 9 ? TAHR_NO_BODY : how % 4;
    h->feature = how % 3;
    h->walkable_rule = how % 64 == 5 ? 9 : how / 64;
    h->walkable_angle = how == 77 ? NAN : 0.2;
}

static tahr_status open_liar(const tahr_host *host, const tahr_world_desc *desc, void **self)
{
    (void)host;
    *self = (void *)desc->options;
    return TAHR_OK;
}

static void close_liar(void *self)
{
    (void)self;
}

/* Never more than fits is written: lies are in what is said. */
static tahr_status sweep(void *self, tahr_query_context *context, const tahr_sweep *query, tahr_hit *hits,
                         uint32_t capacity, uint32_t *count)
{
    liar *l = self;
    (void)context, (void)query;
    uint32_t how = bytes_u8(l->b), n = how % 3;
    l->asked++;
    for (uint32_t i = 0; i < n && i < capacity; i++)
        fill_hit(l->b, &hits[i]);
    *count = how == 255 ? capacity + 7 : (n < capacity || how > 250 ? n : capacity);
    return status_of(l->b);
}

static tahr_status contacts(void *self, tahr_query_context *context, const tahr_contact_query *query, tahr_contact *out,
                            uint32_t capacity, uint32_t *count)
{
    liar *l = self;
    (void)context, (void)query;
    uint32_t how = bytes_u8(l->b), n = how % 5;
    l->asked++;
    for (uint32_t i = 0; i < n && i < capacity; i++) {
        memset(&out[i], 0, sizeof out[i]);
        out[i].distance = number(l->b);
        out[i].normal = vector(l->b);
        out[i].surface_normal = vector(l->b);
        out[i].point = vector(l->b);
        out[i].body = how % 4;
        out[i].sensor = how % 16 == 3;
    }
    *count = how == 255 ? capacity + 7 : (n < capacity ? n : capacity);
    return status_of(l->b);
}

static tahr_status ray(void *self, tahr_query_context *context, const tahr_ray *query, tahr_hit *hit, uint32_t *count)
{
    liar *l = self;
    (void)context, (void)query;
    l->asked++;
    fill_hit(l->b, hit);
    *count = bytes_u8(l->b) % 8 == 7 ? 5 : 1;
    return status_of(l->b);
}

static tahr_status prepare(void *self, tahr_query_context *context, const tahr_prepare *announcement)
{
    liar *l = self;
    (void)context, (void)announcement;
    return bytes_u8(l->b) == 255 ? TAHR_E_MEMORY : TAHR_OK;
}

static tahr_status body_motion(void *self, uint32_t body, tahr_body_motion *motion)
{
    liar *l = self;
    (void)body;
    motion->pose.position = vector(l->b);
    motion->velocity = vector(l->b);
    motion->angular_velocity = vector(l->b);
    motion->mass = number(l->b);
    motion->flags = bytes_u8(l->b);
    motion->teleported = bytes_u8(l->b) % 4 == 3;
    if (bytes_u8(l->b) % 16 == 15) motion->pose.orientation.w = number(l->b);
    return bytes_u8(l->b) % 16 == 15 ? TAHR_E_NOT_FOUND : status_of(l->b);
}

static tahr_status fluid(void *self, tahr_query_context *context, const tahr_fluid_query *query, tahr_fluid *answer)
{
    liar *l = self;
    (void)context, (void)query;
    uint32_t how = bytes_u8(l->b);
    answer->immersion = how < 128 ? 0 : number(l->b);
    answer->friction = how < 128 ? 0 : number(l->b);
    answer->body = how % 4;
    if (how > 200) answer->velocity = vector(l->b);
    return status_of(l->b);
}

static tahr_backend backend_of(uint32_t how)
{
    tahr_backend b = {
        .struct_size = sizeof b,
        .abi_major = TAHR_ABI_MAJOR,
        .abi_minor = TAHR_ABI_MINOR,
        .capabilities = TAHR_CAP_CONTACTS | TAHR_CAP_RAY | TAHR_CAP_SPHERE | TAHR_CAP_CAPSULE | TAHR_CAP_BOX |
                        TAHR_CAP_MESH | TAHR_CAP_SOLIDS | TAHR_CAP_SENSORS | (how & 1 ? (uint32_t)TAHR_CAP_MARGIN : 0u),
        .name = "liar",
        .version = "1",
        .open = open_liar,
        .close = close_liar,
        .sweep = sweep,
        .contacts = contacts,
        .ray = ray,
        .prepare = how & 2 ? prepare : NULL,
        .body_motion = how & 4 ? body_motion : NULL,
        .fluid = how & 8 ? fluid : NULL,
    };
    return b;
}

/* Sensors described, so that the step asks for them. */
static tahr_world *open_world(const tahr_backend *backend, liar *l, uint32_t how)
{
    tahr_world *world = NULL;
    tahr_world_desc desc;
    tahr_body_desc bodies[2];
    tahr_world_desc_init(&desc, sizeof desc);
    for (int i = 0; i < 2; i++) {
        tahr_body_desc_init(&bodies[i], sizeof bodies[i], TAHR_BODY_SPHERE);
        bodies[i].radius = 1;
        bodies[i].flags = i ? TAHR_BODY_MOVABLE : TAHR_BODY_SENSOR;
    }
    desc.options = l;
    desc.bodies = bodies;
    desc.body_count = how & 16 ? 2 : 0;
    return tahr_world_open(backend, &desc, &world) == TAHR_OK ? world : NULL;
}

static int is_number(tahr_vec3 v)
{
    return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

static void check(const tahr_state *before, const tahr_state *s, const tahr_report *r, tahr_status status, double dt)
{
    if (status < 0) {
        FUZZ_CHECK(status == TAHR_E_BACKEND || status == TAHR_E_ARGUMENT, "%s", tahr_status_name(status));
        FUZZ_CHECK(memcmp(before, s, sizeof *s) == 0, "state after %s", tahr_status_name(status));
        return;
    }
    FUZZ_CHECK(is_number(s->position) && is_number(s->velocity) && is_number(s->up) && is_number(s->floor.normal),
               "state is not finite");
    FUZZ_CHECK(isfinite(s->floor.distance) && isfinite(r->residual) && isfinite(r->step_offset), "numbers");
    FUZZ_CHECK(s->touched_count <= TAHR_MAX_TOUCHED, "touched %u", s->touched_count);
    uint32_t asked = r->sweeps + r->contact_queries + r->rays + r->fluid_queries;
    FUZZ_CHECK(asked <= TAHR_MAX_QUERIES_PER_STEP + TAHR_MAX_SENSOR_QUERIES_PER_STEP, "%u queries", asked);
    for (uint32_t i = 0; i < r->event_count; i++) {
        const tahr_event *e = &r->events[i];
        FUZZ_CHECK(e->time >= 0 && e->time <= dt, "event %u at %g", i, e->time);
        FUZZ_CHECK(is_number(e->position) && is_number(e->normal) && isfinite(e->value), "event %u", i);
    }
}

static void ask_directly(tahr_world *world, const tahr_config *config)
{
    tahr_hit hits[3];
    tahr_contact found[3];
    uint32_t count = 0;
    tahr_fluid wet;
    tahr_sweep q = {.shape = config->shape,
                    .up = {0, 0, 1},
                    .orientation = {0, 0, 0, 1},
                    .motion = {1, 0, -1},
                    .margin = 0.01,
                    .mask = 1,
                    .ignore_body = TAHR_NO_BODY};
    tahr_contact_query near = {.shape = config->shape,
                               .up = {0, 0, 1},
                               .orientation = {0, 0, 0, 1},
                               .margin = 0.01,
                               .mask = 1,
                               .ignore_body = TAHR_NO_BODY};
    tahr_ray line = {.motion = {1, 0, 0}, .mask = 1, .ignore_body = TAHR_NO_BODY};
    tahr_fluid_query deep = {.up = {0, 0, 1}, .radius = 0.3, .half_height = 0.9, .mask = 1};
    tahr_status status = tahr_world_sweep(world, &q, hits, 3, &count);
    FUZZ_CHECK(status < 0 || count <= 3, "%u", count);
    for (uint32_t i = 0; status >= 0 && i < count; i++) {
        int free_one = !hits[i].blocking && !hits[i].sensor && !hits[i].start_overlap;
        FUZZ_CHECK(hits[i].fraction >= 0 && hits[i].fraction <= 1 && (free_one || is_number(hits[i].normal)), "hit %u",
                   i);
    }
    count = 0;
    status = tahr_world_contacts(world, &near, found, 3, &count);
    FUZZ_CHECK(status < 0 || count <= 3, "%u", count);
    status = tahr_world_ray(world, &line, hits, &count);
    FUZZ_CHECK(status < 0 || count <= 1, "%u", count);
    FUZZ_CHECK(status < 0 || !count || !hits[0].blocking || (is_number(hits[0].normal) && is_number(hits[0].point)),
               "ray");
    status = tahr_world_fluid(world, &deep, &wet);
    FUZZ_CHECK(status < 0 || (wet.immersion >= 0 && wet.immersion <= 1), "fluid");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    bytes b = {data, data + size};
    const scene unit = {.scale = 1};
    liar l = {.b = &b};
    tahr_config config;
    tahr_mover *mover = NULL;
    tahr_state state;
    uint32_t how = bytes_u8(&b);
    const tahr_backend backend = backend_of(how);
    if (!scene_config(&unit, &b, &config)) return 0;
    tahr_world *world = open_world(&backend, &l, how);
    if (world && tahr_mover_create(world, &config, &mover) == TAHR_OK &&
        tahr_state_init(&state, &config, &(tahr_vec3){0, 0, 1}) == TAHR_OK) {
        for (int i = 0; i < MOST_STEPS && bytes_left(&b) > 0; i++) {
            tahr_event events[EVENTS];
            tahr_report report = {.struct_size = sizeof report, .events = events, .event_capacity = EVENTS};
            tahr_state before = state;
            tahr_input input;
            double dt;
            tape_read(&b, 1, &config, &input, &dt);
            tahr_status status = tahr_mover_step(mover, &input, dt, &state, &report);
            check(&before, &state, &report, status, dt);
            if (i % 8 == 7) ask_directly(world, &config);
        }
    }
    tahr_mover_destroy(mover);
    tahr_world_close(world);
    return 0;
}
