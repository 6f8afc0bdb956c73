/* SPDX-License-Identifier: MIT
 * method.h: one way to move characters over triangles: Tahr with some settings, or another engine's controller. What is
 * measured side by side goes through this, so that nobody gets another level, another input or another judge. */
#ifndef TAHR_BENCH_METHOD_H
#define TAHR_BENCH_METHOD_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { METHOD_ERROR = 256 };

/* Triangles, world frame, metres, z up (planar: y up, the outline drawn out along z from -1 to 1), counter-clockwise
 * in front. Both sides block. Valid while a method is open on it. */
typedef struct method_level {
    const char *name;
    const double *vertices;  /* 3 each */
    const uint32_t *indices; /* 3 each */
    uint32_t vertex_count, triangle_count;
    int planar;
    const double
        *box; /* low corner, high corner of a solid box with the same ground, for who likes that better; NULL */
} method_level;

/* What moves: an upright capsule. SI units, radians. */
typedef struct method_character {
    double radius, half_height; /* half_height: of the whole, with the caps */
    double max_speed, jump_speed, gravity, step_height, walkable_angle;
    double dt; /* s, of every step */
} method_character;

/* Where a character is after a step. */
typedef struct method_place {
    double position[3]; /* centre of the capsule */
    double velocity[3]; /* as the method itself says */
    int32_t grounded;   /* stands on something walkable, as the method itself says */
    uint32_t queries;   /* of the step: sweeps, overlaps and rays; 0 if it does not tell */
} method_place;

/* One method. Characters do not feel each other. open returns NULL and an explanation (capacity METHOD_ERROR) where it
 * cannot; one with "dimensions only" in it means that the level is not of its kind. step is what is timed: nothing but the controller's own work for one character; it allocates nothing of its
 * own accord and reads no clock. */
typedef struct method {
    const char *name;     /* "jolt" */
    const char *version;  /* of the engine */
    const char *settings; /* one line for the page: which of its settings were chosen, and who recommends them */
    void *(*open)(const struct method *method, const method_level *level, const method_character *character,
                  uint32_t count, char *error);
    void (*close)(void *self);
    /* Puts character i at rest with its centre there. */
    void (*place)(void *self, uint32_t i, const double position[3]);
    /* wish: level velocity wanted, m/s, at most max_speed; jump: 1 in the step in which a jump starts if it stands. */
    void (*step)(void *self, uint32_t i, const double wish[3], int jump);
    void (*look)(void *self, uint32_t i, method_place *place);
    const void *data; /* the method's own */
} method;

#ifdef __cplusplus
}
#endif
#endif
