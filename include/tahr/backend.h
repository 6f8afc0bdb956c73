/* SPDX-License-Identifier: MIT
 * backend.h: for authors of backends: the one seam between the movement and a collision engine. A backend never links
 * libtahr; everything it may call comes in tahr_host. */
#ifndef TAHR_BACKEND_H
#define TAHR_BACKEND_H

#include <tahr/types.h>
#include <tahr/world.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What a backend can do. What it does not claim is refused before it is asked: bodies and flags of a scene by
 * tahr_world_open, shapes by tahr_mover_create and direct queries. PLANAR: a world of two dimensions, x and y:
 * positions' z is handed back as it came, normals have none; motion or up out of the plane is TAHR_E_UNSUPPORTED (the
 * library refuses what asks for it, or leaves the z out, before a backend hears of it).
 * CONTACTS and RAY: the slots are always there; this says that they answer as the selftest asks (those of a backend
 * have to; a world over callbacks may leave them to be derived). */
enum {
    TAHR_CAP_MARGIN = 1 << 0, /* honours tahr_sweep.margin; without it shapes come inflated by the core */
    TAHR_CAP_CONTACTS = 1 << 1,
    TAHR_CAP_RAY = 1 << 2,
    TAHR_CAP_SPHERE = 1 << 3, /* TAHR_SHAPE_SPHERE may be swept, and so on */
    TAHR_CAP_CAPSULE = 1 << 4,
    TAHR_CAP_BOX = 1 << 5,
    TAHR_CAP_MESH = 1 << 6,          /* bodies: TAHR_BODY_MESH */
    TAHR_CAP_BIT_IDENTICAL = 1 << 7, /* same bits on every machine and compiler */
    TAHR_CAP_PLANAR = 1 << 8,        /* two dimensions */
    TAHR_CAP_CYLINDER = 1 << 9,      /* more shapes that may be swept */
    TAHR_CAP_CONE = 1 << 10,
    TAHR_CAP_ELLIPSOID = 1 << 11,
    TAHR_CAP_HULL = 1 << 12,         /* and TAHR_BODY_TEMPLATE, which lends it its vertices */
    TAHR_CAP_SOLIDS = 1 << 13,       /* bodies: boxes, spheres and capsules */
    TAHR_CAP_ROUND_SOLIDS = 1 << 14, /* bodies: cylinders, cones and ellipsoids */
    TAHR_CAP_HULLS = 1 << 15,        /* bodies: TAHR_BODY_HULL */
    TAHR_CAP_HEIGHTS = 1 << 16,      /* bodies: TAHR_BODY_HEIGHTS */
    TAHR_CAP_CHAINS = 1 << 17,       /* bodies: TAHR_BODY_CHAIN */
    TAHR_CAP_ONE_WAY = 1 << 18,      /* honours TAHR_BODY_ONE_WAY and the flags of sweeps and contacts about it */
    TAHR_CAP_SENSORS = 1 << 19       /* honours TAHR_BODY_SENSOR and TAHR_SWEEP_SENSORS */
};

/* Services a backend receives at open. Both members are always set; valid until close returns. */
typedef struct tahr_host {
    uint32_t struct_size;
    uint32_t abi; /* TAHR_ABI of the library */
    tahr_allocator allocator;
    tahr_log log; /* write is never NULL; the library puts the name of its function in front of every message */
} tahr_host;

/* Travels with every query. cache: this character's memory of cache_size() bytes, zeroed once, 64-byte aligned, or
 * NULL. It may make an answer faster and may never change one bit of it, whatever was announced, gathered and asked
 * before. Only the place last announced with it (tahr_prepare: position and up) may count like a part of the query: a
 * backend may compute relative to it. Without a cache, or before an announcement, a query is its own: as if its own
 * position and up (of a ray +z) had been announced. So whoever wants the same bits gives the same queries a cache or
 * gives them none, as the core does. The counters are added to by the backend. */
typedef struct tahr_query_context {
    void *cache;
    uint64_t narrow_tests;      /* pairs of shape and feature that reached the narrow phase */
    uint64_t narrow_iterations; /* iterations inside it */
    uint64_t gathers;           /* times local geometry was gathered */
    uint64_t escapes;           /* queries whose box left the gathered one */
    uint64_t spared;            /* sweeps answered from what was known of the place, without a look at the scene */
    uint64_t cached;            /* queries answered from what was gathered, without a search of the scene */
    uint64_t ends;              /* distances of a capsule measured from one end of it alone */
} tahr_query_context;

/* What a walk slot knows: it is not known, or not so, what *hit holds then means nothing; nothing blocks the motion,
 * and *hit (of a foot) is the blocking one that sweep answers for it, bit for bit; the former, but it may be the latter
 * after an announcement from here. */
enum { TAHR_WALK_UNKNOWN = 0, TAHR_WALK_KNOWN = 1, TAHR_WALK_UNANNOUNCED = 2 };

/* The announcement before a step: everything the step is expected to ask about lies in bounds. A hint only. World
 * frame. position: of the character at the start of the step; native's geometry is local to its 4 m cell, also for
 * queries of the step that begin in the next one. */
typedef struct tahr_prepare {
    tahr_bounds bounds;
    tahr_vec3 position;
    tahr_vec3 up;
    uint32_t mask;
    uint32_t reserved;
} tahr_prepare;

/* One step of prepare and its queries runs on one thread; different contexts may be used on different threads at once.
 * No slot allocates except open, close and place. No exception or signal leaves a slot. Iterations are capped and "gave
 * up" is the answer `unknown`. Negative statuses end the step with TAHR_E_BACKEND; TAHR_TRUNCATED does not. Optional
 * are only the slots that say so; a world with another slot missing is refused. */
typedef struct tahr_backend {
    uint32_t struct_size;
    uint16_t abi_major; /* TAHR_ABI_MAJOR and _MINOR of the header it was compiled with */
    uint16_t abi_minor;
    uint32_t capabilities; /* TAHR_CAP_* */
    uint32_t reserved;
    const char *name;    /* short, lower case */
    const char *version; /* of the engine behind it */

    /* Builds the scene; of tahr_world_desc read all but allocator and log, which come in host. desc and its options are
     * valid during the call only, host until close. On failure nothing is kept and *self is untouched. */
    tahr_status (*open)(const tahr_host *host, const tahr_world_desc *desc, void **self);
    void (*close)(void *self);

    /* Of all answers: normals are unit, numbers finite, points and distances within 1e8 m.
     * The sensors met before the first blocking hit, then that hit, ordered by (fraction, body, feature); capacity 1
     * means "the blocking one only". *count = 0: free. More than capacity: sensors are dropped last first, the blocking
     * hit never, and TAHR_TRUNCATED is returned. */
    tahr_status (*sweep)(void *self, tahr_query_context *context, const tahr_sweep *query, tahr_hit *hits,
                         uint32_t capacity, uint32_t *count);

    /* One record per feature within margin, ordered by (distance, body, feature). An edge or vertex shared by several
     * triangles is felt once, and not at all where a neighbour is closer. More than capacity: TAHR_TRUNCATED. */
    tahr_status (*contacts)(void *self, tahr_query_context *context, const tahr_contact_query *query,
                            tahr_contact *contacts, uint32_t capacity, uint32_t *count);

    /* The first blocking hit of a segment; *count is 0 or 1. */
    tahr_status (*ray)(void *self, tahr_query_context *context, const tahr_ray *query, tahr_hit *hit, uint32_t *count);

    /* Optional (NULL): bytes of cache per character; the announcement; placing bodies anew (count 0: tahr_world_touch,
     * what is not described may have changed). */
    size_t (*cache_size)(void *self);
    tahr_status (*prepare)(void *self, tahr_query_context *context, const tahr_prepare *announcement);
    tahr_status (*place)(void *self, const tahr_body_pose *poses, uint32_t count);

    /* Optional: how a body moves, for worlds whose bodies the core did not describe (TAHR_E_NOT_FOUND: it is gone); the
     * immersion of a shape, *fluid zeroed before the call but for its body, TAHR_NO_BODY. A world with a
     * TAHR_BODY_FLUID in it needs the slot. */
    tahr_status (*body_motion)(void *self, uint32_t body, tahr_body_motion *motion);
    tahr_status (*fluid)(void *self, tahr_query_context *context, const tahr_fluid_query *query, tahr_fluid *fluid);

    /* Optional: a walk in one look. *known: a TAHR_WALK_*; UNKNOWN before the call. Without a foot hit->distance, 0
     * before the call, may say how far (m) from its position such a shape meets nothing whichever way it goes, for as
     * long as no body is placed anew. */
    tahr_status (*walk)(void *self, tahr_query_context *context, const tahr_walk *walk, tahr_hit *hit, uint32_t *known);

    /* Optional: see tahr_world_describe. to is valid during the call, write never NULL. Nothing is allocated. */
    tahr_status (*describe)(void *self, const tahr_log *to);
} tahr_backend;

/* What a shared object exports as `tahr_backend_v1`, and a static build as `tahr_backend_v1_<name>`. Static memory. */
typedef const tahr_backend *(*tahr_backend_fn)(void);

#ifdef __cplusplus
}
#endif
#endif
