/* SPDX-License-Identifier: MIT
 * 256 characters at 60 Hz to another process on this machine, with buffers of the usual size, in a network of its own
 * (namespace.sh). load [SECONDS]: without an argument half a second, and whatever the machine had no time for must be
 * accounted for to the last message; with one nothing at all may be lost, unless the machine
 * is busy with other things. */
#include "../inbox.h"

#include <tahr/tahr.h>
#include <tahr/lcm.h>
#include <tahr/native.h>
#include <tahr/telemetry.h>

#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { CHARACTERS = 256, HZ = 60, MOST_EVENTS = 16, LATE = 10 };

#define URL "udpm://239.255.76.67:7667?ttl=0"
#define DT (1.0 / HZ)

/* What the listener has to say in the end: how many came, and how many of them did not follow the last. */
typedef struct heard {
    uint64_t count[TAHR_MESSAGE_COUNT];
    uint64_t disorder;
} heard;

static void fail(const char *what)
{
    fprintf(stderr, "load: %s\n", what);
    exit(1);
}

static int64_t next[TAHR_MESSAGE_COUNT][CHARACTERS];
static heard ear;

static void note(uint32_t kind, int32_t character, int64_t sequence)
{
    ear.count[kind]++;
    if (sequence < next[kind][character % CHARACTERS]) ear.disorder++;
    next[kind][character % CHARACTERS] = sequence + 1;
}

#define HEAR(kind, NAME)                                                                                             \
    static void hear_##kind(const lcm_recv_buf_t *buffer, const char *channel, const tahr_##kind##_t *m, void *user) \
    {                                                                                                                \
        (void)buffer, (void)channel, (void)user;                                                                     \
        note(TAHR_MESSAGE_##NAME, m->character, m->sequence);                                                        \
    }
HEAR(state, STATE)
HEAR(event, EVENT)
HEAR(input, INPUT)
HEAR(report, REPORT)
HEAR(snapshot, SNAPSHOT)

/* Hears everything until nothing comes any more and the other end says that it was all; writes what it heard. */
static void listen_until(int end, int out)
{
    lcm_t *lcm = lcm_create(URL);
    if (!lcm) fail("the listener has no network");
#define SUBSCRIBE(kind, NAME)                                                                                        \
    tahr_##kind##_t_subscription_set_queue_capacity(tahr_##kind##_t_subscribe(lcm, "TAHR_" NAME, hear_##kind, NULL), \
                                                    1 << 20)
    SUBSCRIBE(state, "STATE");
    SUBSCRIBE(event, "EVENT");
    SUBSCRIBE(input, "INPUT");
    SUBSCRIBE(report, "REPORT");
    SUBSCRIBE(snapshot, "SNAPSHOT");
    if (lcm_get_fileno(lcm) < 0 || write(out, "x", 1) != 1) fail("the listener cannot begin");
    struct pollfd over = {.fd = end, .events = POLLIN};
    while (lcm_handle_timeout(lcm, 100) > 0 || poll(&over, 1, 0) == 0) {
    }
    if (write(out, &ear, sizeof ear) != sizeof ear) fail("the listener cannot tell");
    lcm_destroy(lcm);
    _exit(0);
}

/* How many datagrams found no room in a socket of this network, so far. */
static uint64_t overflows(void)
{
    char line[512];
    unsigned long long lost = 0;
    int seen = 0;
    FILE *file = fopen("/proc/net/snmp", "r");
    if (!file) fail("/proc/net/snmp cannot be read");
    while (fgets(line, sizeof line, file))
        if (strncmp(line, "Udp: ", 5) == 0 && seen++) sscanf(line, "Udp: %*u %*u %*u %*u %llu", &lost);
    fclose(file);
    return lost;
}

static tahr_world *open_world(void)
{
    tahr_body_desc ground;
    tahr_world_desc desc;
    tahr_world *world;
    tahr_body_desc_init(&ground, sizeof ground, TAHR_BODY_BOX);
    ground.half_extents = (tahr_vec3){200, 200, 1};
    ground.pose.position = (tahr_vec3){0, 0, -1};
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = &ground;
    desc.body_count = 1;
    if (tahr_world_open(tahr_backend_v1_native(), &desc, &world) < 0) fail("no world");
    return world;
}

static void take_step(tahr_telemetry *telemetry, tahr_mover *mover, uint32_t character, int tick, tahr_state *state)
{
    tahr_event events[MOST_EVENTS];
    tahr_report report = {.struct_size = sizeof report, .events = events, .event_capacity = MOST_EVENTS};
    tahr_input input = {.struct_size = sizeof input, .move = {1, character % 3 - 1.0, 0}};
    input.jump = (tick + (int)character) / 40 % 2 == 0;
    tahr_telemetry_begin(telemetry, 0, character, 0, state);
    const tahr_status status = tahr_mover_step(mover, &input, DT, state, &report);
    if (status < 0) fail("a step failed");
    tahr_telemetry_push(
        telemetry, 0,
        &(tahr_telemetry_step){
            .character = character, .status = status, .input = &input, .state = state, .report = &report, .dt = DT});
}

/* Ticks that the system let begin more than four milliseconds after their time: it had others to run. */
static int late;

static int is_late(const struct timespec *due)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)(now.tv_sec - due->tv_sec) * 1000000000 + now.tv_nsec - due->tv_nsec > 4000000;
}

/* A tick each sixtieth of a second, as a game would. */
static void play(tahr_telemetry *telemetry, const tahr_config *config, int ticks)
{
    static tahr_state states[CHARACTERS];
    tahr_world *world = open_world();
    tahr_mover *mover;
    struct timespec due;
    if (tahr_mover_create(world, config, &mover) < 0) fail("no mover");
    for (uint32_t c = 0; c < CHARACTERS; c++)
        tahr_state_init(&states[c], config, &(tahr_vec3){c % 16, c / 16, 1});
    clock_gettime(CLOCK_MONOTONIC, &due);
    for (int tick = 0; tick < ticks; tick++) {
        for (uint32_t c = 0; c < CHARACTERS; c++)
            take_step(telemetry, mover, c, tick, &states[c]);
        due.tv_nsec += 1000000000 / HZ;
        due.tv_sec += due.tv_nsec / 1000000000;
        due.tv_nsec %= 1000000000;
        clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, NULL);
        late += is_late(&due);
    }
    tahr_mover_destroy(mover);
    tahr_world_close(world);
}

static tahr_telemetry_counts tell(int ticks)
{
    tahr_config config;
    tahr_lcm_desc desc;
    tahr_lcm *lcm;
    tahr_telemetry_desc how;
    tahr_telemetry *telemetry;
    tahr_telemetry_counts counts = {.struct_size = sizeof counts};
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
    tahr_lcm_desc_init(&desc, sizeof desc);
    desc.url = URL;
    if (tahr_lcm_open(&desc, &lcm) < 0) fail("the sink does not open");
    tahr_telemetry_desc_init(&how, sizeof how);
    how.sink = tahr_lcm_sink(lcm);
    how.characters = CHARACTERS;
    how.configs = &config;
    how.config_count = 1;
    if (tahr_telemetry_create(&how, &telemetry) < 0) fail("no telemetry");
    play(telemetry, &config, ticks);
    if (tahr_telemetry_stop(telemetry, TAHR_STOP_DRAIN, 60) < 0) fail("the telemetry does not end");
    tahr_telemetry_get_counts(telemetry, &counts);
    tahr_telemetry_destroy(telemetry);
    tahr_lcm_close(lcm);
    return counts;
}

static int judge(const tahr_telemetry_counts *counts, const heard *h, uint64_t overflown, int is_strict)
{
    uint64_t sent = 0, dropped = 0, received = 0, failed = 0;
    for (int i = 0; i < TAHR_MESSAGE_COUNT; i++) {
        if (i == TAHR_MESSAGE_BODY || i == TAHR_MESSAGE_WORLD) continue; /* not subscribed to */
        sent += counts->delivered[i];
        dropped += counts->dropped[i];
        failed += counts->failed[i];
        received += h->count[i];
    }
    printf("load: %llu sent, %llu received, %llu overflown, %llu dropped, %llu failed; a ring held %u kB at most\n",
           (unsigned long long)sent, (unsigned long long)received, (unsigned long long)overflown,
           (unsigned long long)dropped, (unsigned long long)failed, (unsigned)counts->most_filled / 1024);
    if (sent < CHARACTERS * 3) fail("too little was sent");
    if (failed > 0) fail("messages could not be sent");
    if (h->disorder > 0) fail("messages came twice or out of order");
    if (sent != received + overflown) fail("sent is not received and overflown");
    if (!is_strict || overflown + dropped == 0) return 0;
    if (late < LATE) fail("something was lost");
    printf("SKIP: lcm_load_full: this machine has no time for it now: %d ticks began late\n", late);
    return 77;
}

int main(int argc, char **argv)
{
    const int ticks = argc > 1 ? atoi(argv[1]) * HZ : HZ / 2;
    int out[2], end[2];
    char letter;
    heard h;

    if (!getenv("TAHR_OWN_NETWORK")) {
        puts("SKIP: lcm_load: to be run by namespace.sh, not where others hear it");
        return 77;
    }
    if (pipe(out) || pipe(end)) fail("no pipe");
    const pid_t pid = fork();
    if (pid == 0) listen_until(end[0], out[1]);
    if (pid < 0 || read(out[0], &letter, 1) != 1) fail("no listener");
    const uint64_t before = overflows();
    const tahr_telemetry_counts counts = tell(ticks);
    if (write(end[1], "x", 1) != 1 || read(out[0], &h, sizeof h) != sizeof h) fail("the listener is gone");
    waitpid(pid, NULL, 0);
    return judge(&counts, &h, overflows() - before, argc > 1);
}
