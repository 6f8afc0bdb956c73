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
    const char *route; /* NULL: wandering */
    const char *csv;
    const char *plot;
    const char *trace;
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

/* What parsing loaded. */
void options_close(struct options *options);

/* The help of `tahr run`. */
void options_help(void);

#endif
