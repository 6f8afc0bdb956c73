/* SPDX-License-Identifier: MIT
 * trial.h: one variation of a hard case: a scene, a character in it and what it does, all of it data. Families write it
 * in metres with z up; tests of two dimensions are the same seen from the side, y up. */
#ifndef STABILITY_TRIAL_H
#define STABILITY_TRIAL_H

#include <tahr/tahr.h>

#include "oracle.h"
#include "scene_mesh.h"

enum { TRIAL_BODIES = 40, TRIAL_STEPS = 160, TRIAL_OUTLINE = 64 };

/* Where it takes place. PLANE: side view; a mesh there is an outline drawn out along the third axis. */
enum { IN_SPACE = 1, IN_PLANE = 2 };

/* What a step must keep. The first ones hold whatever a backend answers, lies too. */
enum {
    KEEPS_NUMBERS = 1 << 0, /* the state is finite, units are units, what is reserved is zero */
    KEEPS_STATUS = 1 << 1,  /* no error, and on an error nothing changed */
    KEEPS_CAP = 1 << 2,     /* queries */
    KEEPS_REPORT = 1 << 3,  /* its numbers are finite, its events in order and inside the step */
    KEEPS_REACH = 1 << 4,   /* goes no farther than its speed, steps, snaps, pushes and bases take it */
    KEEPS_SANE = (1 << 5) - 1,
    KEEPS_SOLID = 1 << 5,     /* goes through nothing that blocks */
    KEEPS_SKIN = 1 << 6,      /* comes no nearer than the skin, or than it was */
    KEEPS_ENERGY = 1 << 7,    /* gets no faster than acceleration, gravity and jumps make it */
    KEEPS_REST = 1 << 8,      /* at rest without input, no bit changes */
    KEEPS_SAYING = 1 << 9,    /* neither unknown, nor stuck, crushed or at the cap */
    KEEPS_SPEED = 1 << 10,    /* does not slow down while it wants the same and nothing is in the way */
    KEEPS_GROUND = 1 << 11,   /* once it has landed it stays on the ground */
    KEEPS_INSIDE = 1 << 12,   /* the middle stays in a room without a way out */
    KEEPS_PROMISE = 1 << 13,  /* what the family alone says */
    KEEPS_RELATION = 1 << 14, /* the changed twin goes the changed way */
    KEEPS_FLOOR = 1 << 15,    /* stands on what is walkable, within the reach of a floor */
    KEEPS_TIME = 1 << 16,     /* no part of a step is lost unsaid */
    KEEPS_WORD = 1 << 17,     /* an overlap that is left is said */
    KEEPS_COUNT = 18,
    KEEPS_ALWAYS = KEEPS_SANE | KEEPS_SOLID | KEEPS_SKIN | KEEPS_ENERGY | KEEPS_REST | KEEPS_SAYING | KEEPS_FLOOR |
                   KEEPS_TIME | KEEPS_WORD
};

/* Where a body is at a time t: home + drift * t + swing * sin(rate * t + phase), turned by spin * t about axis. */
typedef struct trial_motion {
    tahr_vec3 drift, swing; /* m/s, m */
    double rate, phase;     /* rad/s, rad */
    tahr_vec3 axis;         /* unit */
    double spin;            /* rad/s */
    double lasts;           /* s; it stays where it was then */
    int teleports;          /* every so many steps it jumps by hop; 0: never */
    tahr_vec3 hop;
} trial_motion;

typedef struct trial_body {
    tahr_body_desc desc; /* all but what points somewhere */
    scene_mesh mesh;     /* local, of a box its faces: what the judge looks at */
    double outline[TRIAL_OUTLINE][2];
    int outline_count; /* 0: no outline */
    trial_motion motion;
} trial_body;

typedef struct trial_step {
    tahr_input input;
    double dt;
    int refused; /* it must be */
} trial_step;

typedef struct trial trial;
struct trial {
    uint32_t world; /* IN_* */
    uint32_t preset;
    uint32_t keeps; /* KEEPS_* */
    trial_body bodies[TRIAL_BODIES];
    uint32_t body_count;
    tahr_config config;
    tahr_vec3 start, velocity; /* of the character; its middle */
    trial_step steps[TRIAL_STEPS];
    int step_count;
    double scale;     /* the lengths of the character, 1: as the preset has them */
    double rounding;  /* m, of coordinates as far away as these */
    tahr_bounds room; /* KEEPS_INSIDE */
    int first_rest;   /* from this step on without input */
    double grow;      /* trial_finish makes everything so much larger, and moves it by `shift` after that */
    tahr_vec3 shift;  /* m */
    /* KEEPS_PROMISE: called after every step; returns how much of the bound is used up (> 1 fails), *what a text. */
    double (*promise)(const trial *t, int step, const tahr_state *before, const tahr_state *now,
                      const tahr_report *report, const char **what);
    double numbers[4]; /* the family's own */
};

/* Empties t for a preset in a world. The config is the preset's, in the plane with up = +y. */
void trial_begin(trial *t, uint32_t world, uint32_t preset);
/* From here on everything is as the world wants it; call it once, when the family is done. */
void trial_finish(trial *t);
void trial_free(trial *t);
/* Of a finished one: every length times s; everything moved. */
void trial_grow(trial *t, double s);
void trial_shift(trial *t, tahr_vec3 by);
/* Returns 0 if out of memory. to is freed by the caller all the same. */
int trial_copy(const trial *from, trial *to);

/* A height that is none: of a mesh that stands for TAHR_BODY_HEIGHTS. */
#define TRIAL_HOLE 1e6

/* Bodies, z up; all block on one side as boxes do, but for flags. */
trial_body *trial_box(trial *t, tahr_vec3 centre, tahr_vec3 half, uint32_t flags);
trial_body *trial_mesh(trial *t, uint32_t flags); /* an empty mesh; IN_SPACE only */
/* A line of (x, z) points, drawn out along y: a floor from left to right. */
trial_body *trial_profile(trial *t, const double (*points)[2], int count, uint32_t flags);
/* A closed room of boxes 1 m thick around [low, high]: nobody gets out. Sets room and KEEPS_INSIDE. */
void trial_room(trial *t, tahr_vec3 low, tahr_vec3 high);

/* Puts the character above z = 0 so that its lowest point is gap higher. */
void trial_stand(trial *t, double x, double y, double gap);

/* Tape. A step more like the last one; walk: count steps of this move; idle: count steps without input, the end. */
void trial_walk(trial *t, int count, tahr_vec3 move);
/* A heading of the given angle, now and then another one within spread, and jumps of one in jumps (0: none). */
void trial_wander(trial *t, oracle_random *dice, int count, double angle, double spread, uint32_t jumps);
void trial_idle(trial *t, int count);
void trial_every(trial *t, double dt);

/* Of the character. */
double trial_radius(const trial *t);
double trial_half(const trial *t);

/* Where a body is at a time (s). steps: how many steps have begun. */
tahr_pose trial_pose(const trial_body *body, double time, int steps);

/* Draws. around: exactly value, one time in four; else beside it by 1e-14 to 1e-2 of size, either way. */
double draw(oracle_random *dice, double low, double high);
double draw_power(oracle_random *dice, double low, double high); /* 10^low .. 10^high, evenly in the exponent */
double draw_around(oracle_random *dice, double value, double size);
int draw_one_in(oracle_random *dice, uint32_t n);

#endif
