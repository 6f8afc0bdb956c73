/* SPDX-License-Identifier: MIT
 * telemetry_lcm.c: a character walks and jumps for two seconds, and who listens to LCM can watch. Give a URL to be
 * heard by others (udpm://239.255.76.67:7667?ttl=0) or to write a log (file:///tmp/walk.lcmlog). Without one the
 * program listens to itself.
 * By hand, with Tahr installed and PKG_CONFIG_PATH pointing to its lib/pkgconfig:
 *     cc -std=c11 telemetry_lcm.c $(pkg-config --cflags --libs tahr_lcm) -o telemetry */
#include <tahr/tahr.h>
#include <tahr/lcm.h>
#include <tahr/native.h>
#include <tahr/telemetry.h>

#include <tahr_lcm/tahr_event_t.h>
#include <tahr_lcm/tahr_state_t.h>

#include <stdio.h>

static void say(void *user, int32_t level, const char *message)
{
    (void)user, (void)level;
    fprintf(stderr, "%s\n", message);
}

/* A listener: it knows LCM and the types of the messages, and need not know Tahr. */
typedef struct listener {
    tahr_state_t_subscription_t *states;
    tahr_event_t_subscription_t *events;
    tahr_state_t state; /* the last one */
} listener;

static void hear_state(const lcm_recv_buf_t *buffer, const char *channel, const tahr_state_t *state, void *user)
{
    listener *l = user;
    (void)buffer, (void)channel;
    l->state = *state;
}

static void hear_event(const lcm_recv_buf_t *buffer, const char *channel, const tahr_event_t *event, void *user)
{
    (void)buffer, (void)channel, (void)user;
    if (event->type == TAHR_EVENT_T_JUMPED || event->type == TAHR_EVENT_T_LANDED)
        printf("%.3f s: %s\n", (double)event->time_ns * 1e-9, event->type == TAHR_EVENT_T_JUMPED ? "jumped" : "landed");
}

static void subscribe(listener *l, lcm_t *lcm)
{
    enum { ROOM = 1000 }; /* a subscription holds 30 messages, unless it is told to hold more */
    l->states = tahr_state_t_subscribe(lcm, "TAHR_STATE", hear_state, l);
    l->events = tahr_event_t_subscribe(lcm, "TAHR_EVENT", hear_event, l);
    tahr_state_t_subscription_set_queue_capacity(l->states, ROOM);
    tahr_event_t_subscription_set_queue_capacity(l->events, ROOM);
}

/* What a game does, and beside each step what tells of it. */
static int play(tahr_telemetry *telemetry, tahr_mover *mover, tahr_state *state)
{
    const double dt = 1.0 / 60;
    for (int i = 0; i < 120; i++) {
        tahr_event events[8];
        tahr_report report = {.struct_size = sizeof report, .events = events, .event_capacity = 8};
        const tahr_input input = {.struct_size = sizeof input, .move = {1, 0, 0}, .jump = i >= 30 && i < 50};
        tahr_telemetry_begin(telemetry, 0, 0, 0, state);
        const tahr_status status = tahr_mover_step(mover, &input, dt, state, &report);
        if (status < 0) return -1;
        const tahr_telemetry_step step = {
            .status = status, .input = &input, .state = state, .report = &report, .dt = dt};
        tahr_telemetry_push(telemetry, 0, &step);
    }
    return 0;
}

/* Steps, told to a sink, until all is sent. */
static int tell(const tahr_sink *sink, tahr_world *world, const tahr_config *config, tahr_state *state)
{
    const tahr_telemetry_desc desc = {.struct_size = sizeof desc,
                                      .sink = sink,
                                      .characters = 1,
                                      .configs = config,
                                      .config_count = 1,
                                      .backend = tahr_world_backend_name(world),
                                      .revision = tahr_world_revision(world)};
    tahr_telemetry *telemetry;
    tahr_mover *mover;
    if (tahr_mover_create(world, config, &mover) < 0) return -1;
    if (tahr_telemetry_create(&desc, &telemetry) < 0) return -1;
    const int result = play(telemetry, mover, state);
    tahr_telemetry_destroy(telemetry);
    tahr_mover_destroy(mover);
    return result;
}

static tahr_world *open_world(void)
{
    tahr_body_desc ground;
    tahr_world_desc scene;
    tahr_world *world = NULL;
    tahr_body_desc_init(&ground, sizeof ground, TAHR_BODY_BOX);
    ground.half_extents = (tahr_vec3){100, 100, 1};
    ground.pose.position = (tahr_vec3){0, 0, -1};
    tahr_world_desc_init(&scene, sizeof scene);
    scene.bodies = &ground;
    scene.body_count = 1;
    return tahr_world_open(tahr_backend_v1_native(), &scene, &world) < 0 ? NULL : world;
}

int main(int argc, char **argv)
{
    const char *url = argc > 1 ? argv[1] : NULL;
    lcm_t *own = url ? NULL : lcm_create("memq://"); /* messages that stay in this program */
    const tahr_log log = {NULL, say};
    const tahr_lcm_desc desc = {.struct_size = sizeof desc, .url = url, .lcm = own, .log = &log};
    tahr_world *world = open_world();
    listener heard = {.state.step = -1};
    tahr_config config;
    tahr_state state;
    tahr_lcm *lcm;

    if (own) subscribe(&heard, own);
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
    tahr_state_init(&state, &config, &(tahr_vec3){0, 0, 0.9});
    if (!world || tahr_lcm_open(&desc, &lcm) < 0) return 1;
    if (tell(tahr_lcm_sink(lcm), world, &config, &state) < 0) return 1;
    tahr_lcm_close(lcm);
    tahr_world_close(world);
    if (!own) return 0;

    while (lcm_handle_timeout(own, 0) > 0) {
    }
    tahr_state_t_unsubscribe(own, heard.states);
    tahr_event_t_unsubscribe(own, heard.events);
    lcm_destroy(own);
    printf("heard of step %d: at %.3f m\n", (int)heard.state.step, heard.state.position[0]);
    return heard.state.position[0] == state.position.x ? 0 : 1;
}
