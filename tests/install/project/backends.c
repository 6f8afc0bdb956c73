/* SPDX-License-Identifier: MIT
 * backends.c: asks every backend that it is linked with, and every plugin whose path it is given, how far a ray goes,
 * and prints name and answer. HAVE_* says what is linked; the headers are there for all of them. */
#include <stdio.h>

#include <tahr/box2d.h>
#include <tahr/ccd.h>
#include <tahr/fcl.h>
#include <tahr/native.h>
#include <tahr/plugin.h>
#include <tahr/tahr.h>
#include <tahr/trace.h>

/* A cube of 2 m around the origin, which is a square to planar backends; a ray of 4 m from 3 m above it along -y. */
static int ask(const tahr_backend *backend)
{
    tahr_body_desc cube;
    tahr_world_desc desc;
    tahr_world *world = NULL;
    tahr_hit hit = {0};
    uint32_t count = 0;
    const tahr_ray ray = {.origin = {0, 3, 0}, .motion = {0, -4, 0}, .mask = 0xFFFFFFFFu, .ignore_body = TAHR_NO_BODY};
    if (tahr_body_desc_init(&cube, sizeof cube, TAHR_BODY_BOX) < 0) return 1;
    cube.half_extents.x = cube.half_extents.y = cube.half_extents.z = 1;
    if (tahr_world_desc_init(&desc, sizeof desc) < 0) return 1;
    desc.bodies = &cube;
    desc.body_count = 1;
    if (tahr_world_open(backend, &desc, &world) < 0) return 1;
    const tahr_status status = tahr_world_ray(world, &ray, &hit, &count);
    if (status >= 0) printf("%s %.3f\n", tahr_world_backend_name(world), count ? hit.fraction : 1.0);
    tahr_world_close(world);
    return status < 0;
}

/* A plugin that answers from a file has none here: it is enough that it gives its name. */
static int ask_plugin(const char *path)
{
    tahr_plugin *plugin = NULL;
    if (tahr_plugin_load(path, NULL, &plugin) < 0) return 1;
    const tahr_backend *backend = tahr_plugin_backend(plugin);
    const int failed =
        backend->name[0] == 't' && backend->name[1] == 'r' ? printf("%s\n", backend->name) < 0 : ask(backend);
    tahr_plugin_unload(plugin);
    return failed;
}

int main(int argc, char **argv)
{
    int failed = ask(tahr_backend_v1_native());
#ifdef HAVE_CCD
    failed |= ask(tahr_backend_v1_ccd());
#endif
#ifdef HAVE_FCL
    failed |= ask(tahr_backend_v1_fcl());
#endif
#ifdef HAVE_BOX2D
    failed |= ask(tahr_backend_v1_box2d());
#endif
#ifdef HAVE_TRACE
    tahr_trace *trace = NULL;
    failed |= tahr_trace_open(NULL, &trace) >= 0; /* refused, and linked */
    printf("%s\n", tahr_backend_v1_trace()->name);
#endif
#ifdef HAVE_TEMPLATE
    const tahr_backend *tahr_backend_v1_template(void); /* is there to be copied, and has no header */
    failed |= ask(tahr_backend_v1_template());
#endif
    for (int i = 1; i < argc; ++i) {
        if (!ask_plugin(argv[i])) continue;
        printf("%s fails\n", argv[i]);
        failed = 1;
    }
    return failed;
}
