/* SPDX-License-Identifier: MIT
 * scene_backend.c: the backends of this build, with the accuracy that each promises. */
#include "scene_backend.h"

#include <stdio.h>

#ifdef TAHR_HAVE_CCD
#include <tahr/ccd.h>
#endif
#ifdef TAHR_HAVE_FCL
#include <tahr/fcl.h>
#endif

/* Native keeps the skin but for 1e-6 m (a base that tilts carries along a chord), the others but for 1e-5 m; all rest to
 * the bit. Sweeps of native are within 1e-9 m; those of ccd and fcl are within 1e-4 m, exact onto a level floor, and they
 * may enter 5 mm where native may enter 1 mm. Their slides are judged at 1e-2 of their way (2 mm for the 0.2 m or so into
 * a gutter), who pushes into a corner at 1e-6 m. */
const scene_backend SCENE_BACKENDS[] = {
    {"native", tahr_backend_v1_native, 1, 0, 1.0, 1e-6, 1e-9, 1e-3, 0, 0, 0},
#ifdef TAHR_HAVE_CCD
    {"ccd", tahr_backend_v1_ccd, 0, 0, 1.0, 1e-5, 1e-4, 5e-3, 2e-3, 1e-6, 0},
#endif
#ifdef TAHR_HAVE_FCL
    {"fcl", tahr_backend_v1_fcl, 0, 0, 1.0, 1e-5, 1e-4, 5e-3, 2e-3, 1e-6, 0},
#endif
};
const int SCENE_BACKEND_COUNT = (int)(sizeof SCENE_BACKENDS / sizeof SCENE_BACKENDS[0]);

/* Gaps of box2d are within 1e-9 m, on either engine. */
const scene_backend SCENE_PLANAR_BACKENDS[] = {
#ifdef TAHR_HAVE_BOX2D
    {"box2d", tahr_backend_v1_box2d, 0, TAHR_BOX2D_NEWEST, 1.0, 1e-5, 1e-9, 1e-3, 0, 0, 1},
#ifdef TAHR_HAVE_BOX2D_2
    {"box2d-2", tahr_backend_v1_box2d, 0, TAHR_BOX2D_2, 1.0, 1e-5, 1e-9, 1e-3, 0, 0, 1},
#endif
#endif
    {.name = NULL},
};
const int SCENE_PLANAR_BACKEND_COUNT = (int)(sizeof SCENE_PLANAR_BACKENDS / sizeof SCENE_PLANAR_BACKENDS[0]) - 1;

static void complain(void *user, int32_t level, const char *message)
{
    (void)user;
    if (level == TAHR_LOG_ERROR) {
        fprintf(stderr, "%s\n", message);
    }
}

const void *scene_backend_options(const scene_backend *backend, scene_options *room)
{
    if (backend->planar) {
        room->box2d = (tahr_box2d_desc){.struct_size = sizeof room->box2d, .engine = backend->engine};
    } else if (backend->native) {
        room->native = (tahr_native_desc){.struct_size = sizeof room->native};
    }
    return backend->planar || backend->native ? room : NULL;
}

tahr_status scene_backend_open(const scene_backend *backend, const tahr_body_desc *bodies, uint32_t count,
                               const tahr_native_desc *options, tahr_world **world)
{
    tahr_log log = {NULL, complain};
    scene_options own;
    tahr_world_desc desc;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = bodies;
    desc.body_count = count;
    desc.log = &log;
    desc.options = scene_backend_options(backend, &own);
    if (options && backend->native) {
        own.native = *options;
        own.native.struct_size = sizeof own.native;
    }
    return tahr_world_open(backend->get(), &desc, world);
}
