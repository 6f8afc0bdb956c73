/* SPDX-License-Identifier: MIT
 * parity.h: rows of numbers in centimetres, run on scenes of planes and boxes on every backend, and counted. */
#ifndef PARITY_H
#define PARITY_H

#include "core.h"
#include "fake_world.h"

/* Metres of centimetres. */
double parity_cm(double x);
tahr_vec3 parity_vec(double x, double y, double z);

/* FAKE: callbacks with closed forms. CCD: only where it was built. */
enum { PARITY_FAKE, PARITY_NATIVE, PARITY_CCD, PARITY_BACKENDS };
const char *parity_backend_name(int backend);
int parity_has(int backend);
/* cm: 1e-4 of closed forms and the native backend, 1e-2 of ccd. */
double parity_tolerance(int backend);

/* Lengths in cm. A plane is solid where normal . x < offset: a half-space, or a square 12 m wide around its point
 * nearest to the origin. */
enum { PARITY_SOLIDS = 8 };
typedef struct parity_solid {
    int kind; /* FAKE_HALF_SPACE or FAKE_BOX */
    tahr_vec3 normal;
    double offset;
    tahr_vec3 min, max;
    uint32_t flags; /* TAHR_BODY_*; not on FAKE */
    uint32_t walkable_rule;
    double walkable_angle; /* rad */
} parity_solid;

/* A solid's index is its body. */
typedef struct parity_scene {
    parity_solid solids[PARITY_SOLIDS];
    uint32_t count;
} parity_scene;

parity_solid *parity_plane(parity_scene *scene, double nx, double ny, double nz, double offset);
parity_solid *parity_box(parity_scene *scene, tahr_vec3 min, tahr_vec3 max);

/* A step in progress over a scene, for calling the rules one by one. */
enum { PARITY_EVENTS = 32 };
typedef struct parity {
    tahr_world *world;
    tahr_config config;
    tahr__limits limits;
    tahr_input input;
    tahr__step step;
    fake_world fake;
    tahr_event events[PARITY_EVENTS];
    int backend;
} parity;

/* TAHR_PRESET_UNREAL. */
tahr_config parity_config(void);

/* config NULL: parity_config. The character is at `at` (cm), flying, at rest, without a floor. Fails the test if it
 * fails. */
void parity_open(parity *p, const parity_scene *scene, int backend, const tahr_config *config, double x, double y,
                 double z);
/* The same over callbacks of one's own, instead of a scene. */
void parity_open_callbacks(parity *p, const tahr_callbacks *callbacks, const tahr_config *config);
void parity_close(parity *p);
/* Holds the character to a plane with this normal from now on; zero: to none. */
void parity_hold_to(parity *p, vec3 plane);
/* Puts the character at a place (cm) and forgets queries, events and flags so far. */
void parity_put(parity *p, double x, double y, double z);
/* A floor at this distance (cm) with this normal; flags TAHR_FLOOR_*. */
void parity_floor(parity *p, double distance, tahr_vec3 normal, uint32_t flags);

/* A table of rows; one id is one row, however often and on how many backends it runs. A number that is wrong is printed
 * with its row, and the end fails. */
enum { PARITY_ROWS = 64 };
typedef struct parity_table {
    const char *name, *where;
    const char *ids[PARITY_ROWS];
    uint8_t is_red[PARITY_ROWS];
    uint32_t rows, now; /* now: the row that runs */
} parity_table;

void parity_begin(parity_table *table, const char *name);
/* where: the backend, or NULL. */
void parity_row(parity_table *table, const char *id, const char *where);
void parity_number(parity_table *table, const char *what, double got, double expected, double tolerance);
/* got in m, expected and tolerance in cm. */
void parity_length(parity_table *table, const char *what, double got, double expected, double tolerance);
void parity_vector(parity_table *table, const char *what, tahr_vec3 got, double x, double y, double z,
                   double tolerance);
void parity_count(parity_table *table, const char *what, uint32_t got, uint32_t expected);
void parity_true(parity_table *table, const char *what, int got);
/* Prints the rows that are green, and fails if one is red. */
void parity_end(parity_table *table);

#endif
