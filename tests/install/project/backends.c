/* SPDX-License-Identifier: MIT
 * backends.c: opens a small world on both backends and names them. */
#include <stdio.h>

#include <tahr/ccd.h>
#include <tahr/native.h>
#include <tahr/tahr.h>

static const char *open_on(const tahr_backend *backend)
{
    static const double vertices[] = {-5, -5, 0, 5, -5, 0, 0, 5, 0};
    static const uint32_t indices[] = {0, 1, 2};
    tahr_body_desc floor;
    tahr_world_desc desc;
    tahr_world *world = NULL;
    if (tahr_body_desc_init(&floor, sizeof floor, TAHR_BODY_MESH) < 0) return "?";
    floor.vertices = vertices;
    floor.vertex_count = 3;
    floor.indices = indices;
    floor.triangle_count = 1;
    if (tahr_world_desc_init(&desc, sizeof desc) < 0) return "?";
    desc.bodies = &floor;
    desc.body_count = 1;
    if (tahr_world_open(backend, &desc, &world) < 0) return "?";
    const char *name = tahr_world_backend_name(world);
    tahr_world_close(world);
    return name;
}

int main(void)
{
    printf("%s", open_on(tahr_backend_v1_native()));
    printf(" %s\n", open_on(tahr_backend_v1_ccd()));
    return 0;
}
