/* SPDX-License-Identifier: MIT
 * options.h: what the user asked `tahr run` for. */
#ifndef TAHR_CLI_OPTIONS_H
#define TAHR_CLI_OPTIONS_H

#include "backends.h"

enum check_mode { CHECK_OFF, CHECK_SAMPLED, CHECK_ALL };

struct options {
    const char *level; /* NULL: the bundled one */
    char up;           /* 'y' or 'z' */
    uint32_t characters;
    uint32_t threads; /* 0: not asked for */
    int crowd;        /* 1: they are obstacles of each other */
    double seconds;
    double rate; /* Hz */
    uint64_t seed;
    int32_t preset;
    const struct backend_choice *backend;
    int backend_given; /* 1: by the user */
    const char *route; /* NULL: wandering */
    const char *csv;
    const char *plot;
    const char *trace;
    const char *lcm;        /* URL, or NULL */
    const char *lcm_prefix; /* of channels, or NULL */
    double lcm_rate;        /* Hz of states; 0: all */
    int fast;               /* 1: not paced by the wall clock */
    enum check_mode check;
    int json;
    int side;                /* 1: two dimensions, seen from the side */
    int tour;                /* 1: the bundled route through the bundled level of two dimensions */
    double pixels_per_metre; /* 0: as the map says */
    int separate_tiles;
    uint32_t shape;               /* TAHR_SHAPE_*, or 0: that of the preset */
    struct backend_plugin loaded; /* where backend comes from a shared object */
};

/* 0: go on; 1: help was asked for and shown; -1: wrong usage, said so. */
int options_parse(struct options *options, int argc, char **argv);

/* Options that say which level is meant, and on what: takes those out of a command line, the rest of which stays in
 * argv. of_level: room for argc arguments and a NULL; it begins with argv[0]. Returns how many it got; *argc: what is
 * left. */
int options_of_level(int *argc, char **argv, char **of_level);

/* What parsing loaded. */
void options_close(struct options *options);

/* The help of `tahr run`. */
void options_help(void);

#endif
