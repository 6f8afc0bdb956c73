/* SPDX-License-Identifier: MIT
 * fuzz_log.c: logs of LCM. A recording is told again, with what the bytes say done to it: messages are lost, come twice
 * or in another order, or are not what was sent; then the file is damaged too. Whatever it is, all of it can be read,
 * and `tahr replay --verify` proves no more than there is. */
#include "../bindings/cli/lcm/judge.h"
#include "../bindings/cli/log_file.h"
#include "bytes.h"
#include "recorded.h"
#include "scratch.h"
#include "target.h"

#include <string.h>

enum { MOST = 2048, HEAD = 28, MOST_CHANGES = 40, ROOM = 1 << 21 };

/* What is told: messages by their number in the recording, each with up to a few bytes of its own. */
typedef struct told {
    uint32_t of[MOST];
    uint8_t *data[MOST]; /* NULL: as recorded */
    size_t size[MOST];
    size_t count;
    int only_lost; /* nothing but messages other than snapshots went */
    size_t inputs_lost;
} told;

static int is_of(const recorded_message *m, const char *kind)
{
    return strstr(m->channel, kind) != NULL;
}

static void tell_all(told *t, const recorded *r)
{
    memset(t, 0, sizeof *t);
    FUZZ_CHECK(r->count <= MOST / 2, "%u messages", (unsigned)r->count);
    t->only_lost = 1;
    for (t->count = 0; t->count < r->count; t->count++) {
        t->of[t->count] = (uint32_t)t->count;
        t->size[t->count] = r->messages[t->count].size;
    }
}

static void lose(told *t, const recorded *r, size_t at)
{
    const recorded_message *m = &r->messages[t->of[at]];
    t->only_lost &= !is_of(m, "SNAPSHOT");
    t->inputs_lost += (size_t)is_of(m, "INPUT");
    free(t->data[at]);
    t->count--;
    memmove(&t->of[at], &t->of[at + 1], (t->count - at) * sizeof t->of[0]);
    memmove(&t->data[at], &t->data[at + 1], (t->count - at) * sizeof t->data[0]);
    memmove(&t->size[at], &t->size[at + 1], (t->count - at) * sizeof t->size[0]);
    t->data[t->count] = NULL;
}

static void repeat(told *t, size_t at)
{
    if (t->count == MOST) return;
    t->of[t->count] = t->of[at];
    t->size[t->count] = t->size[at];
    t->data[t->count] = NULL;
    if (t->data[at]) {
        t->data[t->count] = malloc(t->size[at] + 1);
        FUZZ_CHECK(t->data[t->count] != NULL, "no memory");
        memcpy(t->data[t->count], t->data[at], t->size[at]);
    }
    t->count++;
}

static void swap(told *t, size_t a, size_t b)
{
    const uint32_t of = t->of[a];
    uint8_t *data = t->data[a];
    const size_t size = t->size[a];
    t->of[a] = t->of[b], t->data[a] = t->data[b], t->size[a] = t->size[b];
    t->of[b] = of, t->data[b] = data, t->size[b] = size;
}

/* Its own bytes, so that they can be changed. */
static uint8_t *own(told *t, const recorded *r, size_t at)
{
    if (!t->data[at]) {
        t->data[at] = malloc(t->size[at] + 1);
        FUZZ_CHECK(t->data[at] != NULL, "no memory");
        memcpy(t->data[at], r->messages[t->of[at]].data, t->size[at]);
    }
    return t->data[at];
}

/* Numbers that readers stumble over, highest byte first: NaN, infinity, huge, tiny, all bits, the lowest one. */
static const uint64_t odd_numbers[] = {0x7FF8000000000000u, 0x7FF0000000000000u, 0x7FEFFFFFFFFFFFFFu,
                                       0x0000000000000001u, 0xFFFFFFFFFFFFFFFFu, 0x8000000000000000u,
                                       0x416312D000000000u, 0x7FFFFFFF7FFFFFFFu};

static void spoil(told *t, const recorded *r, size_t at, bytes *b)
{
    const size_t word = bytes_u8(b), size = t->size[at];
    const uint32_t how = bytes_u8(b);
    uint8_t *data = own(t, r, at);
    if (how == 255) {
        t->size[at] = size < word ? 0 : size - word;
    } else if (8 * word + 8 <= size && how < 64) {
        for (int i = 0; i < 8; i++)
            data[8 * word + (size_t)i] = (uint8_t)(odd_numbers[how % 8] >> (56 - 8 * i));
    } else if (size > 0) {
        data[(8 * word + how % 8) % size] ^= (uint8_t)(1u << (how >> 3) % 8);
    }
}

/* Below count. */
static size_t some(bytes *b, int size, size_t count)
{
    size_t number = 0;
    for (int i = 0; i < size; i++)
        number = number << 8 | bytes_u8(b);
    return number % count;
}

static void change(told *t, const recorded *r, bytes *b)
{
    for (int i = 0; i < MOST_CHANGES && bytes_left(b) > 0 && t->count > 0; i++) {
        const uint32_t kind = bytes_below(b, 8);
        const size_t at = some(b, 2, t->count);
        t->only_lost &= kind <= 2 || kind == 7;
        if (kind <= 2)
            lose(t, r, at);
        else if (kind == 3)
            repeat(t, at);
        else if (kind == 4)
            swap(t, at, (at + 1) % t->count);
        else if (kind <= 6)
            spoil(t, r, at, b);
        else
            return; /* and the rest damages the file */
    }
}

static void put_number(uint8_t *to, uint64_t number, int size)
{
    for (int i = 0; i < size; i++)
        to[i] = (uint8_t)(number >> 8 * (size - 1 - i));
}

/* As liblcm writes it (log_file.c says how). */
static size_t write_log(const told *t, const recorded *r, uint8_t *file)
{
    size_t size = 0;
    for (size_t i = 0; i < t->count; i++) {
        const recorded_message *m = &r->messages[t->of[i]];
        const size_t letters = strlen(m->channel);
        if (size + HEAD + letters + t->size[i] > ROOM) break;
        put_number(file + size, 0xEDA1DA01u, 4);
        put_number(file + size + 4, i, 8);
        put_number(file + size + 12, i, 8);
        put_number(file + size + 20, letters, 4);
        put_number(file + size + 24, t->size[i], 4);
        memcpy(file + size + HEAD, m->channel, letters);
        memcpy(file + size + HEAD + letters, t->data[i] ? t->data[i] : m->data, t->size[i]);
        size += HEAD + letters + t->size[i];
    }
    return size;
}

static size_t damage(uint8_t *file, size_t size, bytes *b)
{
    while (bytes_left(b) > 0 && size > 0) {
        const size_t at = some(b, 3, size);
        const uint8_t what = bytes_u8(b);
        if (what == 0)
            size = at;
        else
            file[at] ^= what;
    }
    return size;
}

static void hear(struct judge *judge, const struct log_event *event)
{
    struct message m;
    if (message_read(&m, event->channel, event->data, event->size) != MESSAGE_OURS) return;
    if (m.kind != TAHR_MESSAGE_WORLD) judge_hear(judge, &m);
    message_free(&m);
}

/* Returns how many events could be read. */
static size_t read_log(struct judge *judge, const char *path)
{
    struct log_file *log = log_file_open(path);
    struct log_event event = {0};
    size_t events = 0;
    for (uint64_t end = 0; log && log_file_next(log, &event); events++) {
        FUZZ_CHECK(event.at >= end && event.at + HEAD + event.size <= log_file_size(log), "an event at byte %u",
                   (unsigned)event.at);
        end = event.at + HEAD + strlen(event.channel) + event.size;
        hear(judge, &event);
    }
    log_file_close(log);
    return events;
}

static void check(const struct verdict *d, const told *t, const recorded *r)
{
    FUZZ_CHECK(d->gap_count == 0 || d->unproven > 0 || d->broken > 0 || !t->only_lost, "a gap of nothing");
    if (!t->only_lost) return;
    FUZZ_CHECK(d->desync_count == 0, "what was lost is no difference: character %d, step %d",
               (int)d->desyncs[0].character, (int)d->desyncs[0].step);
    FUZZ_CHECK(d->contradiction_count == 0, "character %d, step %d: %s", (int)d->contradictions[0].character,
               (int)d->contradictions[0].step, d->contradictions[0].how);
    FUZZ_CHECK(d->broken == 0, "nothing is broken");
    FUZZ_CHECK(d->proven + t->inputs_lost <= RECORDED_CHARACTERS * RECORDED_STEPS, "%u steps are proven",
               (unsigned)d->proven);
    FUZZ_CHECK(t->count < r->count || d->proven == RECORDED_CHARACTERS * RECORDED_STEPS, "%u steps are proven",
               (unsigned)d->proven);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static uint8_t file[ROOM];
    static told t;
    const recorded *r = recorded_run();
    bytes b = {data, data + size};
    tell_all(&t, r);
    change(&t, r, &b);
    t.only_lost &= bytes_left(&b) == 0;
    size_t length = write_log(&t, r, file);
    length = damage(file, length, &b);
    const char *path = scratch_file(file, length, "lcmlog");
    tahr_world *world = recorded_world();
    struct judge *judge = judge_open(world, &r->config, 1, RECORDED_CHARACTERS);
    scratch_quiet();
    const size_t events = read_log(judge, path);
    judge_end(judge);
    scratch_loud();
    FUZZ_CHECK(!t.only_lost || events == t.count, "%u of %u events", (unsigned)events, (unsigned)t.count);
    check(judge_verdict(judge), &t, r);
    judge_close(judge);
    tahr_world_close(world);
    for (size_t i = 0; i < t.count; i++)
        free(t.data[i]);
    return 0;
}
