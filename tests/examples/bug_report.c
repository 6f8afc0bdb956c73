/* SPDX-License-Identifier: MIT
 * bug_report.c: an engine of one's own behind a callback, and a run over it that is kept in one file, so that somebody
 * who has neither the engine nor the level can repeat it: `tahr replay FILE`.
 * Usage: bug_report [FILE]; without one it goes to a temporary file and is looked through.
 *
 * By hand, with Tahr installed and PKG_CONFIG_PATH pointing to its lib/pkgconfig:
 *     cc -std=c11 bug_report.c $(pkg-config --cflags --libs tahr_trace) -o bug_report */
#include <stdio.h>

#include <tahr/tahr.h>
#include <tahr/trace.h>

/* The engine: what is on the front of all planes is free. */
typedef struct plane {
    tahr_vec3 normal;
    double offset; /* m */
} plane;

static const plane level[] = {{{0, 0, 1}, 0}, {{-1, 0, 0}, -4}, {{-0.3, 0, 0.953939}, -0.6}};

static double dot(const tahr_vec3 *a, const tahr_vec3 *b)
{
    return a->x * b->x + a->y * b->y + a->z * b->z;
}

/* Of a capsule: the first plane whose distance falls to the margin. */
static tahr_status sweep(void *user, const tahr_sweep *q, tahr_hit *hit)
{
    (void)user;
    hit->fraction = 1;
    for (uint32_t i = 0; i < sizeof level / sizeof level[0]; i++) {
        const plane *p = &level[i];
        const double along = dot(&p->normal, &q->up);
        const double reach = q->shape.radius + (along < 0 ? -along : along) * (q->shape.half_height - q->shape.radius);
        const double gap = dot(&p->normal, &q->position) - p->offset - reach;
        const double speed = -dot(&p->normal, &q->motion);
        const uint32_t overlaps = gap < 0 && (!(q->flags & TAHR_SWEEP_LEAVE_OVERLAP) || speed > 0);
        const int meets = speed > 0 && gap - q->margin <= speed * hit->fraction;
        if (hit->start_overlap ? overlaps && -gap > hit->depth : overlaps || (gap >= 0 && meets)) {
            const double fraction = gap > q->margin ? (gap - q->margin) / speed : 0;
            *hit = (tahr_hit){.blocking = 1, .fraction = fraction, .normal = p->normal, .body = i};
            hit->start_overlap = overlaps;
            hit->depth = overlaps ? -gap : 0;
            hit->distance = gap < q->margin ? gap : q->margin;
        }
    }
    return TAHR_OK;
}

static size_t write_file(void *user, const void *bytes, size_t size)
{
    return fwrite(bytes, 1, size, user);
}

static size_t read_file(void *user, void *bytes, size_t size)
{
    return fread(bytes, 1, size, user);
}

/* Walks into the slope, jumps on it, and is watched for the last two of three seconds. */
static int play(tahr_world *world, tahr_trace *trace, tahr_state *state)
{
    tahr_config config;
    tahr_mover *mover = NULL;
    const tahr_vec3 start = {0, 0, 1};
    tahr_status status = TAHR_OK;
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
    tahr_state_init(state, &config, &start);
    if (tahr_mover_create(world, &config, &mover) < 0) {
        return 0;
    }
    for (int i = 0; i < 180 && status >= 0; i++) {
        const tahr_input input = {.struct_size = sizeof input, .jump = i == 90, .move = {1, 0.1, 0}};
        if (i == 60) { /* something looks odd: from here on it is kept */
            status = tahr_world_record(world, tahr_trace_recorder(trace));
        }
        status = status < 0 ? status : tahr_mover_step(mover, &input, 1.0 / 60, state, NULL);
    }
    tahr_world_record(world, NULL);
    tahr_mover_destroy(mover);
    return status >= 0;
}

/* What is in a trace, without repeating it. */
static uint64_t count_steps(FILE *file, uint64_t *hash)
{
    const tahr_trace_desc desc = {.struct_size = sizeof desc, .read = read_file, .user = file};
    tahr_trace_reader *reader = NULL;
    tahr_trace_event event = {.kind = TAHR_TRACE_MOVE};
    uint64_t steps = 0;
    rewind(file);
    if (tahr_trace_read(&desc, &reader) < 0) {
        return 0;
    }
    while (event.kind != TAHR_TRACE_END && tahr_trace_next(reader, &event) >= 0) {
        steps += event.kind == TAHR_TRACE_DONE;
        *hash = event.kind == TAHR_TRACE_DONE ? event.done.hash : *hash;
    }
    tahr_trace_reader_close(reader);
    return event.kind == TAHR_TRACE_END ? steps : 0;
}

int main(int argc, char **argv)
{
    const tahr_callbacks engine = {.struct_size = sizeof engine, .sweep = sweep};
    FILE *file = argc > 1 ? NULL : tmpfile();
    const tahr_trace_desc desc = {
        .struct_size = sizeof desc, .path = argc > 1 ? argv[1] : NULL, .write = write_file, .user = file};
    tahr_trace *trace = NULL;
    tahr_world *world = NULL;
    tahr_state state;
    uint64_t bytes = 0, hash = 0;
    if ((argc < 2 && !file) || tahr_world_open_callbacks(&engine, NULL, &world) < 0 ||
        tahr_trace_open(&desc, &trace) < 0) {
        return 1;
    }
    int played = play(world, trace, &state);
    tahr_world_close(world);
    tahr_trace_size(trace, NULL, NULL, &bytes);
    int written = tahr_trace_close(trace) == TAHR_OK;
    printf("%s at x %.2f, z %.2f; %lu bytes kept\n", tahr_mode_name(state.mode), state.position.x, state.position.z,
           (unsigned long)bytes);
    int same = !file || (count_steps(file, &hash) == 120 && hash == tahr_state_hash(&state));
    if (file) {
        fclose(file);
    }
    return played && written && same && state.position.z > 1.2 ? 0 : 1;
}
