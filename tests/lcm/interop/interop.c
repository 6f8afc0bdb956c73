/* SPDX-License-Identifier: MIT
 * The C side of interop.py: `say URL` publishes one message of each kind through the sink; `hear URL` waits for a state
 * that Python has published, and prints it. */
#include "../inbox.h"

#include <tahr/tahr.h>
#include <tahr/lcm.h>

#include <stdio.h>
#include <string.h>

static int say(const char *url)
{
    const tahr_log silent = {0};
    const tahr_lcm_desc desc = {.struct_size = sizeof desc, .url = url, .log = &silent};
    const tahr_stamp stamp = {
        .character = 7, .config = 0, .step = 1ull << 40, .sequence = 11, .epoch = 12, .time_ns = -13, .wall_ns = 14};
    const tahr_state state = {.position = {0.1, -2, 1e300},
                              .mode = TAHR_MODE_WALKING,
                              .base = {.body = TAHR_NO_BODY},
                              .floor = {.flags = TAHR_FLOOR_BLOCKING | TAHR_FLOOR_WALKABLE, .distance = 0.0125}};
    const tahr_event event = {.type = TAHR_EVENT_LANDED, .value = -4.5};
    const tahr_input input = {.struct_size = sizeof input, .drive = {1, 2, 3}};
    const tahr_report report = {.struct_size = sizeof report, .saved = {1, 2, 3, 4, 5, 6, 7, 8, 9}};
    const tahr_sink_input given = {.input = &input, .dt = 0.25};
    const tahr_sink_report said = {.report = &report, .hash = 0xFEDCBA9876543210u};
    const tahr_body_pose pose = {.body = 3, .flags = TAHR_POSE_TELEPORT, .pose = {{1, 2, 3}, {0, 0, 0, 1}}};
    const tahr_sink_change change = {.kind = TAHR_CHANGE_MOVE, .count = 1, .poses = &pose, .dt = 0.5, .epoch = 2};
    tahr_config config;
    tahr_lcm *lcm;
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
    const tahr_sink_world world = {.level = "B\xc3\xbchne", .backend = "native", .configs = &config, .config_count = 1};
    if (tahr_lcm_open(&desc, &lcm) < 0) return 1;
    const tahr_sink *sink = tahr_lcm_sink(lcm);
    const int failed = sink->world(sink->user, &world) < 0 || sink->snapshot(sink->user, &stamp, &state) < 0 ||
                       sink->input(sink->user, &stamp, &given) < 0 || sink->event(sink->user, &stamp, &event) < 0 ||
                       sink->state(sink->user, &stamp, &state) < 0 || sink->report(sink->user, &stamp, &said) < 0 ||
                       sink->change(sink->user, &change) < 0;
    tahr_lcm_close(lcm);
    printf("%016llx\n", (unsigned long long)tahr_state_hash(&state));
    return failed;
}

static int hear(const char *url)
{
    inbox box;
    lcm_t *lcm = lcm_create(url);
    if (!lcm) return 1;
    inbox_open(&box, lcm, "", "");
    if (lcm_get_fileno(lcm) < 0) return 1;
    puts("ready");
    fflush(stdout);
    if (!inbox_wait(&box, TAHR_MESSAGE_STATE, 100)) return 1;
    const tahr_state_t *s = &box.state;
    printf("%d %lld %.17g %.17g %.17g %d %d %d\n", (int)s->character, (long long)s->step, s->position[0],
           s->position[1], s->position[2], (int)s->mode, (int)s->floor_walkable, (int)s->base_body);
    inbox_close(&box);
    lcm_destroy(lcm);
    return 0;
}

int main(int argc, char **argv)
{
    if (argc == 3 && strcmp(argv[1], "say") == 0) return say(argv[2]);
    if (argc == 3 && strcmp(argv[1], "hear") == 0) return hear(argv[2]);
    fprintf(stderr, "interop: usage: interop say|hear URL\n");
    return 2;
}
