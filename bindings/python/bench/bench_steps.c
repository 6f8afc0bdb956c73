/* SPDX-License-Identifier: MIT
 * bench_steps.c: the C side of bench_steps.py: the same world, characters and inputs, stepped when a line on stdin asks
 * for it, so that the two take turns on the same machine. Usage: bench_steps FOLDER CHARACTERS THREADS
 * FOLDER holds vertices.bin (double), triangles.bin (uint32), states.bin, inputs.bin as Python's arrays wrote them.
 * Each line "crowd N" or "mover N" is answered by "NANOSECONDS HASH": CPU time of N steps from the states of the file, all of
 * them or the middle one, and of all states after that. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <tahr/native.h>
#include <tahr/tahr.h>
#include <tahr/threads.h>
#include <time.h>

static const double DT = 1.0 / 60;

typedef struct bench {
    uint32_t count;
    tahr_state *begin, *states;
    tahr_input *inputs;
    tahr_world *world;
    tahr_mover *mover;
    tahr_crowd *crowd;
    tahr_threads *threads;
} bench;

static void *read_all(const char *folder, const char *name, size_t *size)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "rb");
    if (file == NULL || fseek(file, 0, SEEK_END) != 0) {
        fprintf(stderr, "bench_steps: cannot read %s\n", path);
        exit(1);
    }
    *size = (size_t)ftell(file);
    rewind(file);
    void *bytes = malloc(*size);
    if (bytes == NULL || fread(bytes, 1, *size, file) != *size) exit(1);
    fclose(file);
    return bytes;
}

static void open_world(bench *b, const char *folder)
{
    size_t vertices, triangles;
    tahr_body_desc ground;
    tahr_world_desc scene;
    tahr_body_desc_init(&ground, sizeof ground, TAHR_BODY_MESH);
    ground.vertices = read_all(folder, "vertices.bin", &vertices);
    ground.indices = read_all(folder, "triangles.bin", &triangles);
    ground.vertex_count = (uint32_t)(vertices / (3 * sizeof(double)));
    ground.triangle_count = (uint32_t)(triangles / (3 * sizeof(uint32_t)));
    tahr_world_desc_init(&scene, sizeof scene);
    scene.bodies = &ground;
    scene.body_count = 1;
    if (tahr_world_open(tahr_backend_v1_native(), &scene, &b->world) < 0) exit(1);
}

static void open_steppers(bench *b, uint32_t threads)
{
    tahr_config config;
    tahr_crowd_desc desc;
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
    tahr_crowd_desc_init(&desc, sizeof desc);
    desc.capacity = b->count;
    desc.configs = &config;
    desc.config_count = 1;
    if (threads > 1) {
        if (tahr_threads_create(NULL, threads, &b->threads) < 0) exit(1);
        desc.run_tasks = tahr_threads_run;
        desc.run_user = b->threads;
    }
    if (tahr_crowd_create(b->world, &desc, &b->crowd) < 0) exit(1);
    if (tahr_mover_create(b->world, &config, &b->mover) < 0) exit(1);
}

static long long now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return t.tv_sec * 1000000000LL + t.tv_nsec;
}

static void step(bench *b, const char *what, int steps)
{
    const uint32_t middle = b->count / 2;
    tahr_crowd_tick tick;
    memcpy(b->states, b->begin, b->count * sizeof *b->states);
    tahr_crowd_tick_init(&tick, sizeof tick);
    tick.count = b->count;
    tick.dt = DT;
    tick.inputs = b->inputs;
    tick.states = b->states;
    long long begin = now();
    for (int i = 0; i < steps; i++) {
        int failed = strcmp(what, "crowd") == 0
                         ? tahr_crowd_step(b->crowd, &tick) < 0
                         : tahr_mover_step(b->mover, &b->inputs[middle], DT, &b->states[middle], NULL) < 0;
        if (failed) exit(1);
    }
    long long end = now();
    uint64_t hash = 0;
    for (uint32_t i = 0; i < b->count; i++) {
        hash ^= tahr_state_hash(&b->states[i]);
    }
    printf("%lld %llu\n", end - begin, (unsigned long long)hash);
    fflush(stdout);
}

int main(int argc, char **argv)
{
    bench b = {0};
    size_t size;
    char what[16];
    int steps;
    if (argc != 4) return 2;
    b.count = (uint32_t)atoi(argv[2]);
    b.begin = read_all(argv[1], "states.bin", &size);
    b.states = read_all(argv[1], "states.bin", &size);
    b.inputs = read_all(argv[1], "inputs.bin", &size);
    open_world(&b, argv[1]);
    open_steppers(&b, (uint32_t)atoi(argv[3]));
    while (scanf("%15s %d", what, &steps) == 2) {
        step(&b, what, steps);
    }
    tahr_mover_destroy(b.mover);
    tahr_crowd_destroy(b.crowd);
    tahr_threads_destroy(b.threads);
    tahr_world_close(b.world);
    return 0;
}
