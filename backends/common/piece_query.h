/* SPDX-License-Identifier: MIT
 * piece_query.h: the slots of a backend whose bodies are convex pieces: what is met first, what is near. The engine
 * finds the pieces, nothing else. */
#ifndef TAHR_COMMON_PIECE_QUERY_H
#define TAHR_COMMON_PIECE_QUERY_H

#include "scene.h"

typedef struct tahr__piece_finder tahr__piece_finder;

/* One query: the shape, where it starts, where it goes, in the query's unit but for start and box. Begins whatever a
 * finder keeps for it. Not to be copied. */
typedef struct tahr__piece_query {
    const tahr__piece_finder *finder;
    const tahr__scene *scene;
    tahr_query_context *context;
    tahr__shape shape;
    tahr__start start;
    tahr_vec3 up, motion;
    double motion_length, margin;
    tahr__filter filter;
    uint32_t flags;                     /* TAHR_SWEEP_* or TAHR_CONTACTS_* */
    uint32_t begun;                     /* the finder was told */
    tahr_bounds box;                    /* m, relative to the start: what lies outside cannot matter */
    const tahr__scene_body *frame_body; /* whose frame it is, or NULL */
    tahr__placement frame;
} tahr__piece_query;

/* A piece by the name that its finder gave it. */
typedef struct tahr__piece_found {
    uint64_t name;
    const tahr__surface *surface;
    tahr__piece piece;
} tahr__piece_found;

/* Who finds the pieces. All but rewind, next and make may be NULL. */
struct tahr__piece_finder {
    /* The unit of a shape, see tahr__placement; 0: it cannot be asked about. NULL: metres. */
    double (*scale)(const tahr_shape *shape);
    /* Before and after all others; end is called whatever begin returns. */
    tahr_status (*begin)(tahr__piece_query *query);
    void (*end)(tahr__piece_query *query);
    /* The names of all pieces that may reach into the box, in a fixed order; again from the first after rewind. */
    void (*rewind)(tahr__piece_query *query);
    int (*next)(tahr__piece_query *query, uint64_t *name);
    /* Fills in the piece of a name, valid until the next one is made; 0: the query does not want to meet it. */
    int (*make)(tahr__piece_query *query, tahr__piece_found *found);
    /* Nearest points at the start. NULL: tahr__piece_measure_far. */
    void (*measure)(tahr__piece_query *query, const tahr__piece_found *found, tahr__near *near);
    /* Is a contact of a piece also one of the larger solid that it is a part of? NULL: it is. */
    int (*felt)(const tahr__piece_query *query, const tahr__piece_found *found, const tahr__near *near);
    uint32_t (*feature)(const tahr__piece_query *query, const tahr__piece_found *found, tahr_vec3 normal);
    /* As tahr__piece_advance. */
    tahr__verdict (*advance)(const tahr__piece_query *query, const tahr__piece *piece, double limit, double *fraction,
                             tahr__near *near);
};

/* A query of a slot, to be answered by one of the next three. self: the scene. */
static inline tahr__piece_query *tahr__piece_query_by(tahr__piece_query *query, const tahr__piece_finder *finder,
                                                      const void *self, tahr_query_context *context)
{
    query->finder = finder;
    query->scene = (const tahr__scene *)self;
    query->context = context;
    return query;
}

/* The slots; query comes with finder, scene and context. TAHR_E_UNSUPPORTED for what is no shape, TAHR_E_ARGUMENT for
 * numbers that are not finite or beyond 1e8 m. */
tahr_status tahr__piece_sweep(tahr__piece_query *query, const tahr_sweep *sweep, tahr_hit *hits, uint32_t capacity,
                              uint32_t *count);
tahr_status tahr__piece_contacts(tahr__piece_query *query, const tahr_contact_query *asked, tahr_contact *contacts,
                                 uint32_t capacity, uint32_t *count);
tahr_status tahr__piece_ray(tahr__piece_query *query, const tahr_ray *ray, tahr_hit *hit, uint32_t *count);

/* For finders: may the query meet the body? Goes to the frame of a body whose piece is to be made. Makes the piece of a
 * body, or of a mesh of one of its triangles. */
static inline int tahr__piece_wanted(const tahr__piece_query *query, const tahr__scene_body *body)
{
    return tahr__filter_passes(&query->filter, &body->surface);
}
void tahr__piece_enter(tahr__piece_query *query, const tahr__scene_body *body, tahr__piece_found *found);
void tahr__piece_of_body(tahr__piece_query *query, const tahr__scene_body *body, uint32_t triangle,
                         tahr__piece_found *found);

/* piece_query.c, for the slots: the query ready for its pieces; to be ended in any case. shape: NULL for a point. */
tahr_status tahr__piece_query_begin(tahr__piece_query *query, tahr_vec3 origin, const tahr__shape_source *shape);
void tahr__piece_query_end(tahr__piece_query *query);
/* The next piece that is wanted. */
int tahr__piece_query_next(tahr__piece_query *query, tahr__piece_found *found);
void tahr__piece_query_measure(tahr__piece_query *query, const tahr__piece_found *found, tahr__near *near);
/* Is there such a contact: from the front, of no internal edge? [out] the face along direction. */
int tahr__piece_query_felt(const tahr__piece_query *query, const tahr__piece_found *found, tahr_vec3 direction,
                           tahr__near *near, tahr_vec3 *face);
uint32_t tahr__piece_query_feature(const tahr__piece_query *query, const tahr__piece_found *found, tahr_vec3 normal);
tahr__verdict tahr__piece_query_advance(const tahr__piece_query *query, const tahr__piece *piece, double limit,
                                        double *fraction, tahr__near *near);
/* The query's motion, for piece.h. */
static inline tahr__motion tahr__piece_query_motion(const tahr__piece_query *query)
{
    tahr__motion m = {&query->shape, query->motion, query->margin, &query->context->narrow_iterations, 0, 0};
    return m;
}
/* The box in the world. */
static inline tahr_bounds tahr__piece_query_box(const tahr__piece_query *query)
{
    tahr_bounds b = {v_add(query->box.min, query->start.origin), v_add(query->box.max, query->start.origin)};
    return b;
}
/* A place of the query in the world. */
static inline tahr_vec3 tahr__piece_query_world(const tahr__piece_query *query, tahr_vec3 p)
{
    return v_add(query->start.origin, v_scale(p, 1 / query->start.scale));
}

#endif
