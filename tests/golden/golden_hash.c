/* SPDX-License-Identifier: MIT
 * golden_hash.c: characters of all shapes, presets and skills wander through a small playground whose bodies move;
 * prints one hash of every state and event.
 *
 * The same line must come from every compiler, optimisation level and machine, with SIMD or its scalar twin (--scalar),
 * and with or without the gather cache (--no-cache). Only public headers; the scene is made of + - * / and integers. */
#include <stdio.h>
#include <string.h>

#include <tahr/native.h>
#include <tahr/tahr.h>

enum {
    CHARACTERS = 16,
    WORLDS = 2, /* of the same bodies, with other ways through them */
    STEPS = 1400,
    CELLS = 24,
    MAX_VERTICES = 1024,
    MAX_TRIANGLES = 2048,
    MOVABLE = 2,
    LIFT = 7,
    TURNTABLE = 8,
    BODIES = 12,
    EVENTS = 16
};

typedef struct mesh {
    double vertices[3 * MAX_VERTICES];
    uint32_t indices[3 * MAX_TRIANGLES];
    uint32_t vertex_count, triangle_count;
} mesh;

/* A linear congruential generator (Knuth's constants for 64 bits); the upper half is used. */
static uint32_t draw(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(*seed >> 32);
}

/* Even in [0, 1), exact in double. */
static double fraction(uint64_t *seed)
{
    return (double)(draw(seed) >> 8) / 16777216.0;
}

static uint32_t vertex(mesh *m, double x, double y, double z)
{
    m->vertices[3 * m->vertex_count] = x;
    m->vertices[3 * m->vertex_count + 1] = y;
    m->vertices[3 * m->vertex_count + 2] = z;
    return m->vertex_count++;
}

static void quad(mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    uint32_t corners[6] = {a, b, c, a, c, d};
    memcpy(m->indices + 3 * m->triangle_count, corners, sizeof corners);
    m->triangle_count += 2;
}

/* Rough ground of 1 m cells with slopes up to about 60 degrees, the odd terrace, and a flat rim. */
static void add_ground(mesh *m)
{
    uint64_t seed = 7;
    uint32_t base = m->vertex_count;
    for (int j = 0; j <= CELLS; j++) {
        for (int i = 0; i <= CELLS; i++) {
            int rim = i < 2 || j < 2 || i > CELLS - 2 || j > CELLS - 2;
            double bump = fraction(&seed), terrace = (i / 4 + j / 6) % 2 ? 0.35 : 0;
            vertex(m, i - 0.5 * CELLS, j - 0.5 * CELLS, rim ? 0 : terrace + bump * bump * 0.9);
        }
    }
    for (uint32_t j = 0; j < CELLS; j++) {
        for (uint32_t i = 0; i < CELLS; i++) {
            uint32_t a = base + j * (CELLS + 1) + i;
            quad(m, a, a + 1, a + CELLS + 2, a + CELLS + 1);
        }
    }
}

/* Two vertices across the stairs; their numbers follow each other. */
static uint32_t edge(mesh *m, double x, double y, double z)
{
    uint32_t first = vertex(m, x, y - 1, z);
    vertex(m, x, y + 1, z);
    return first;
}

/* Steps of 0.3 x 0.3 m, 2 m wide, up to a platform that ends in a drop. */
static void add_stairs(mesh *m, double x, double y)
{
    uint32_t before = edge(m, x, y, 0);
    for (int i = 0; i < 8; i++) {
        double top = 0.3 * (i + 1), end = i == 7 ? 4.1 : 0.3 * (i + 1);
        uint32_t riser = edge(m, x + 0.3 * i, y, top), tread = edge(m, x + end, y, top);
        quad(m, before, riser, riser + 1, before + 1);
        quad(m, riser, tread, tread + 1, riser + 1);
        before = tread;
    }
}

/* Walls around everything but one side, so that some fall out. */
static void add_walls(mesh *m)
{
    double h = 0.5 * CELLS;
    double corners[4][2] = {{h, -h}, {h, h}, {-h, h}, {-h, -h}};
    for (int i = 0; i < 3; i++) {
        const double *from = corners[i], *to = corners[i + 1];
        uint32_t a = vertex(m, from[0], from[1], -1), b = vertex(m, to[0], to[1], -1);
        uint32_t c = vertex(m, to[0], to[1], 4), d = vertex(m, from[0], from[1], 4);
        quad(m, b, a, d, c);
        quad(m, a, b, c, d);
    }
}

static void describe(const mesh *m, tahr_body_desc *bodies)
{
    tahr_body_desc_init(&bodies[0], sizeof bodies[0], TAHR_BODY_MESH);
    bodies[0].vertices = m->vertices;
    bodies[0].vertex_count = m->vertex_count;
    bodies[0].indices = m->indices;
    bodies[0].triangle_count = m->triangle_count;
    for (int i = 1; i <= 3; i++) { /* a turned box, a box that moves, a low ceiling */
        tahr_body_desc_init(&bodies[i], sizeof bodies[i], TAHR_BODY_BOX);
    }
    bodies[1].half_extents = (tahr_vec3){2, 0.5, 1.5};
    bodies[1].pose = (tahr_pose){{-5, 4, 1}, {0, 0, 0.6, 0.8}};
    bodies[2].half_extents = (tahr_vec3){1.5, 1.5, 0.25};
    bodies[2].pose = (tahr_pose){{0, -8, 0.5}, {0, 0, 0, 1}};
    bodies[2].flags = TAHR_BODY_MOVABLE;
    bodies[3].half_extents = (tahr_vec3){2, 2, 0.1};
    bodies[3].pose = (tahr_pose){{6, 6, 2.75}, {0.28, 0, 0, 0.96}};
    tahr_body_desc_init(&bodies[4], sizeof bodies[4], TAHR_BODY_SPHERE);
    bodies[4].radius = 1.25;
    bodies[4].pose.position = (tahr_vec3){5, -4, 0.75};
    tahr_body_desc_init(&bodies[5], sizeof bodies[5], TAHR_BODY_CAPSULE);
    bodies[5].radius = 0.4;
    bodies[5].half_height = 1.5;
    bodies[5].pose = (tahr_pose){{-4, -6, 0.75}, {0.6, 0, 0, 0.8}};
    bodies[5].walkable_rule = TAHR_WALKABLE_NEVER;
    tahr_body_desc_init(&bodies[6], sizeof bodies[6], TAHR_BODY_SPHERE);
    bodies[6].radius = 3;
    bodies[6].flags = TAHR_BODY_SENSOR;
    for (int i = 7; i < BODIES; i++) { /* a lift, a turntable, a conveyor, a crate, a pool */
        tahr_body_desc_init(&bodies[i], sizeof bodies[i], TAHR_BODY_BOX);
    }
    bodies[LIFT].half_extents = (tahr_vec3){1.5, 1.5, 0.2};
    bodies[LIFT].pose.position = (tahr_vec3){-8, 7, 0};
    bodies[LIFT].flags = TAHR_BODY_MOVABLE;
    bodies[TURNTABLE].half_extents = (tahr_vec3){2, 2, 0.2};
    bodies[TURNTABLE].pose.position = (tahr_vec3){7, 0, 0.6};
    bodies[TURNTABLE].flags = TAHR_BODY_MOVABLE;
    bodies[9].half_extents = (tahr_vec3){3, 1, 0.25};
    bodies[9].pose.position = (tahr_vec3){-2, 0, 0.6};
    bodies[9].surface_velocity = (tahr_vec3){1.5, 0.25, 0};
    bodies[10].half_extents = (tahr_vec3){1.5, 1.5, 1.1};
    bodies[10].pose.position = (tahr_vec3){2, 5, 1.2};
    bodies[10].mass = 60;
    bodies[11].half_extents = (tahr_vec3){4, 4, 1.5};
    bodies[11].pose.position = (tahr_vec3){-7, -7, 1};
    bodies[11].surface_velocity = (tahr_vec3){0.5, 0, 0};
    bodies[11].flags = TAHR_BODY_FLUID;
}

/* What is off by default. */
static void give_skills(tahr_config *config)
{
    config->coyote_time = 0.1;
    config->jump_buffer = 0.15;
    config->jump_release_gravity = 2;
    config->fall_gravity = 1.5;
    config->wall_slide_speed = 2;
    config->wall_jump_speed = 5;
    config->wall_coyote_time = 0.1;
    config->ledge_grab = 0.4;
    config->corner_correction = 0.2;
    config->lift_momentum = 0.2;
    config->air_jumps = 1;
    config->jump_speed = 5;
    config->jump_hold_time = 0.125;
    config->imparted_half_life = 0.5;
}

/* Every third character is a box, every third a sphere; one in eight is far-sighted about ledges. Every second moves
 * like Unreal's, half of them have skills, one stays in a plane, and one mixes the methods. */
static void configure(tahr_config *config, int id)
{
    tahr_config_init(config, sizeof *config, id % 2 ? TAHR_PRESET_UNREAL : TAHR_PRESET_PRECISE);
    if (id % 4 > 1) {
        give_skills(config);
    }
    if (id == 6) {
        config->plane = (tahr_vec3){0, 1, 0};
    }
    if (id == 8) { /* the methods mixed */
        config->integrator = TAHR_INTEGRATOR_STEPPED;
        config->floor_probe = TAHR_FLOOR_PROBE_SHRUNK;
        config->flat_base = 1;
    }
    config->max_speed = 3 + id % 4;
    config->walk_off_ledges = id % 8 != 3;
    if (id % 3 == 1) {
        config->shape = (tahr_shape){.type = TAHR_SHAPE_BOX, .half_height = 0.8, .half_x = 0.3, .half_y = 0.2};
    } else if (id % 3 == 2) {
        config->shape = (tahr_shape){.type = TAHR_SHAPE_SPHERE, .radius = 0.4, .half_height = 0.4};
    }
}

/* A direction on the unit circle without trigonometry. */
static tahr_vec3 heading(uint64_t *seed)
{
    double t = 2 * fraction(seed) - 1, sign = draw(seed) & 0x80000000u ? 1 : -1, d = 1 + t * t;
    return (tahr_vec3){sign * (1 - t * t) / d, sign * 2 * t / d, 0};
}

static tahr_vec3 home(int id)
{
    return (tahr_vec3){(id % 4 - 1.5) * 5, (id / 4 - 1.5) * 5, 4};
}

/* What counts in one step only. */
static void choose_request(tahr_input *input, uint32_t r, uint64_t *seed)
{
    input->flags &= TAHR_INPUT_FACING;
    if (r % 149 == 2) {
        input->flags |= TAHR_INPUT_LAUNCH;
        input->launch = heading(seed);
        input->launch.z = 6;
    } else if (r % 151 == 3) {
        input->flags |= TAHR_INPUT_IMPULSE;
        input->impulse = (tahr_vec3){150, -50, 200};
    } else if (r % 157 == 4) {
        input->flags |= TAHR_INPUT_DRIVE;
        input->drive = heading(seed);
    } else if (r % 101 == 5) {
        static const uint32_t modes[] = {TAHR_MODE_FLYING, TAHR_MODE_FALLING, TAHR_MODE_WALKING, TAHR_MODE_FALLING};
        input->flags |= TAHR_INPUT_MODE;
        input->mode = modes[draw(seed) >> 30];
    } else if (r % 163 == 6) {
        input->flags |= TAHR_INPUT_GRAVITY;
        input->gravity = (tahr_vec3){2, 0, 8};
    }
    if (r % 31 == 7) {
        input->crouch = !input->crouch;
    }
}

static void choose_input(tahr_input *input, uint64_t *seed)
{
    uint32_t r = draw(seed) >> 16;
    choose_request(input, r, seed);
    if (r % 47 == 0) {
        input->move = heading(seed);
        input->facing = input->move;
        input->flags = r % 2 ? (uint32_t)TAHR_INPUT_FACING : 0u;
    } else if (r % 211 == 1) {
        input->move = (tahr_vec3){0, 0, 0};
    }
    input->jump = r % 61 < 2;
}

/* To and fro between 0 and 1. */
static double swing(int step, int period)
{
    int at = step % period;
    return 2.0 * (at < period - at ? at : period - at) / period;
}

/* 1/60 s of the lift and of the turntable, which turns by the angle whose half has the tangent 1/128 (about 54
 * degrees/s). */
static int move_bodies(tahr_world *world, int step, tahr_quat *turn)
{
    const double d = 128.0 * 128 + 1, sine = 2 * 128.0 / d, cosine = (128.0 * 128 - 1) / d;
    tahr_quat next = {0, 0, turn->z * cosine + turn->w * sine, turn->w * cosine - turn->z * sine};
    double norm = next.z * next.z + next.w * next.w; /* one step of Newton's keeps it 1 */
    next.z *= 1.5 - 0.5 * norm;
    next.w *= 1.5 - 0.5 * norm;
    *turn = next;
    const tahr_body_pose poses[2] = {{LIFT, 0, {{-8, 7, 3 * swing(step, 240)}, {0, 0, 0, 1}}},
                                     {TURNTABLE, 0, {{7, 0, 0.6}, next}}};
    return tahr_world_move(world, poses, 2, 1.0 / 60) >= 0;
}

static void mix(uint64_t *hash, uint64_t word)
{
    *hash = (*hash ^ word) * 1099511628211u;
}

static void mix_events(uint64_t *hash, const tahr_report *report)
{
    for (uint32_t i = 0; i < report->event_count; i++) {
        const tahr_event *e = &report->events[i];
        const double numbers[2] = {e->time + 0.0, e->value + 0.0};
        uint64_t words[2];
        memcpy(words, numbers, sizeof words);
        mix(hash, (uint64_t)e->type << 32 | e->body);
        mix(hash, words[0]);
        mix(hash, words[1]);
    }
}

/* Modes and events that were seen, as bits: a hash of what did not happen guards nothing. */
static uint32_t seen_modes, seen_events;
static const uint32_t MODES = (1u << TAHR_MODE_WALKING) | (1u << TAHR_MODE_FALLING) | (1u << TAHR_MODE_SWIMMING) |
                              (1u << TAHR_MODE_FLYING) | (1u << TAHR_MODE_HANGING);
static const uint32_t HAPPENINGS = (1u << (TAHR_EVENT_GRABBED + 1)) - 2;

static int wander(tahr_world *world, int first, uint64_t *hash)
{
    static const double DT[7] = {1.0 / 60, 1.0 / 60, 1.0 / 30, 1.0 / 144, 1.0 / 1000, 0.1, 1.0 / 60};
    tahr_mover *movers[CHARACTERS];
    tahr_state states[CHARACTERS];
    tahr_config configs[CHARACTERS];
    tahr_input inputs[CHARACTERS];
    uint64_t seeds[CHARACTERS];
    tahr_quat turn = {0, 0, 0, 1};
    for (int i = 0; i < CHARACTERS; i++) {
        tahr_vec3 place = home(i);
        configure(&configs[i], i);
        seeds[i] = 1000003u * (uint64_t)(first + i + 1);
        inputs[i] = (tahr_input){.struct_size = sizeof inputs[i], .move = heading(&seeds[i])};
        if (tahr_mover_create(world, &configs[i], &movers[i]) < 0 ||
            tahr_state_init(&states[i], &configs[i], &place) < 0) {
            return 0;
        }
    }
    for (int s = 0; s < STEPS; s++) {
        if (s % 100 == 50) {
            tahr_body_pose pose = {MOVABLE, 0, {{0.25 * (s / 100 % 8), -8, 0.5}, {0, 0, 0, 1}}};
            if (tahr_world_set(world, &pose, 1) < 0) {
                return 0;
            }
        }
        if (s % 400 < 350 && !move_bodies(world, s, &turn)) { /* now and then they rest */
            return 0;
        }
        for (int i = 0; i < CHARACTERS; i++) {
            tahr_event events[EVENTS];
            tahr_report report = {.struct_size = sizeof report, .events = events, .event_capacity = EVENTS};
            choose_input(&inputs[i], &seeds[i]);
            if (i % 4 > 1 && (s + 10 * i) % 150 == 100) { /* in the air before the edge of the crate */
                const tahr_vec3 place = {0, 5, 1.75};
                tahr_state_teleport(&states[i], &place);
                inputs[i].move = (tahr_vec3){1, 0, 0};
            }
            tahr_status status = tahr_mover_step(movers[i], &inputs[i], DT[(s + i) % 7], &states[i], &report);
            if (status < 0) {
                fprintf(stderr, "character %d, step %d: %s\n", first + i, s, tahr_status_name(status));
                return 0;
            }
            mix(hash, tahr_state_hash(&states[i]));
            mix_events(hash, &report);
            seen_modes |= 1u << states[i].mode;
            for (uint32_t e = 0; e < report.event_count; e++) {
                seen_events |= 1u << events[e].type;
            }
            if (states[i].position.z < -10 || states[i].position.z > 20) {
                tahr_vec3 place = home(i);
                tahr_state_init(&states[i], &configs[i], &place);
            }
        }
    }
    for (int i = 0; i < CHARACTERS; i++) {
        tahr_mover_destroy(movers[i]);
    }
    return 1;
}

int main(int argc, char **argv)
{
    static mesh playground; /* large */
    tahr_body_desc bodies[BODIES];
    tahr_native_desc native = {.struct_size = sizeof native};
    uint64_t hash = 14695981039346656037u;
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--scalar") == 0) {
            native.no_simd = 1;
        } else if (strcmp(argv[i], "--no-cache") == 0) {
            native.no_cache = 1;
        } else {
            fprintf(stderr, "golden_hash: unknown option '%s'; --scalar, --no-cache\n", argv[i]);
            return 2;
        }
    }
    add_ground(&playground);
    add_stairs(&playground, -9, 0);
    add_walls(&playground);
    describe(&playground, bodies);
    for (int w = 0; w < WORLDS; w++) {
        tahr_world_desc desc;
        tahr_world *world = NULL;
        tahr_world_desc_init(&desc, sizeof desc);
        desc.bodies = bodies;
        desc.body_count = BODIES;
        desc.options = &native;
        tahr_status status = tahr_world_open(tahr_backend_v1_native(), &desc, &world);
        if (status < 0) {
            fprintf(stderr, "opening the world: %s\n", tahr_status_message(status));
            return 1;
        }
        if (!wander(world, w * CHARACTERS, &hash)) {
            return 1;
        }
        tahr_world_close(world);
    }
    if ((seen_modes & MODES) != MODES || (seen_events & HAPPENINGS) != HAPPENINGS) {
        fprintf(stderr, "golden_hash: modes %x and events %x do not cover what the hash is to guard\n",
                (unsigned)seen_modes, (unsigned)seen_events);
        return 1;
    }
    printf("%08lx%08lx\n", (unsigned long)(hash >> 32), (unsigned long)(hash & 0xffffffffu));
    return 0;
}
