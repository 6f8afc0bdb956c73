/* SPDX-License-Identifier: MIT
 * telemetry.c: what the README's telemetry leaves to the reader: a world, a character, a place for what comes back.
 * README_TELEMETRY is the file with the README's lines; LCM's default URL is one within the program. */
#include <stdio.h>
#include <tahr/lcm.h>
#include <tahr/native.h>
#include <tahr/tahr.h>
#include <tahr/telemetry.h>

enum { id = 0, lane = 0, config_index = 0 };

static tahr_world *open_box(void)
{
    tahr_body_desc box;
    tahr_world_desc scene;
    tahr_world *world = NULL;
    tahr_body_desc_init(&box, sizeof box, TAHR_BODY_BOX);
    box.half_extents = (tahr_vec3){9, 9, 1};
    tahr_world_desc_init(&scene, sizeof scene);
    scene.bodies = &box;
    scene.body_count = 1;
    return tahr_world_open(tahr_backend_v1_native(), &scene, &world) < 0 ? NULL : world;
}

/* Ends all, and tells whether a state was published; 0 if so. */
static int check(tahr_telemetry *telemetry, tahr_lcm *lcm)
{
    tahr_telemetry_counts counts = {.struct_size = sizeof counts};
    const tahr_status stopped = tahr_telemetry_stop(telemetry, TAHR_STOP_DRAIN, 10);
    tahr_telemetry_get_counts(telemetry, &counts);
    tahr_telemetry_destroy(telemetry);
    tahr_lcm_close(lcm);
    printf("telemetry: %u state published\n", (unsigned)counts.delivered[TAHR_MESSAGE_STATE]);
    return stopped != TAHR_OK || counts.delivered[TAHR_MESSAGE_STATE] != 1;
}

int main(void)
{
    const double dt = 1.0 / 60;
    const tahr_input input = {.struct_size = sizeof input, .move = {1, 0, 0}};
    tahr_world *world = open_box();
    tahr_telemetry *telemetry = NULL;
    tahr_lcm *lcm = NULL;
    tahr_mover *mover = NULL;
    tahr_report report = {.struct_size = sizeof report};
    tahr_telemetry_desc desc;
    tahr_config config;
    tahr_state state;
    tahr_status status;
    tahr_config_init(&config, sizeof config, TAHR_PRESET_PRECISE);
    tahr_state_init(&state, &config, &(tahr_vec3){0, 0, 2});
    tahr_telemetry_desc_init(&desc, sizeof desc);
    desc.characters = 1;
    desc.configs = &config;
    desc.config_count = 1;
    if (!world || tahr_mover_create(world, &config, &mover) < 0) {
        return 1;
    }
#include README_TELEMETRY
    tahr_mover_destroy(mover);
    tahr_world_close(world);
    return status < 0 || check(telemetry, lcm);
}
