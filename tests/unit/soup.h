/* SPDX-License-Identifier: MIT
 * soup.h: a user's triangles for tahr_native_desc.gather, and worlds that must answer alike. */
#ifndef SOUP_H
#define SOUP_H

#include <tahr/native.h>

#include "native_world.h"

/* Triangles in a grid of 4 m cells. reversed: each cell from its last triangle to its first. calls: how often it was
 * asked. A triangle in several cells is handed over several times. */
typedef struct soup {
    tahr_triangle *triangles;
    uint32_t count, cells[3], reversed;
    uint32_t *first, *list; /* of a cell: list[first[cell]] .. list[first[cell + 1]] */
    tahr_vec3 low;
    uint64_t calls;
} soup;

/* Of a mesh body, as body `body`; exits the test if memory is short. */
void soup_make(soup *s, const tahr_body_desc *mesh, uint32_t body);
void soup_free(soup *s);
/* A tahr_gather_fn; user: a soup. */
tahr_status soup_gather(void *user, const tahr_bounds *box, uint32_t mask, tahr_gather *out);

/* Everything that one question has for an answer. */
typedef struct soup_answer {
    tahr_hit hits[4], ray;
    tahr_contact contacts[16];
    uint32_t hit_count, contact_count, ray_count, reserved;
    tahr_status status[3];
} soup_answer;

void soup_ask(fixture *f, const tahr_sweep *sweep, soup_answer *answer);
/* Announces a step that reaches so far. */
void soup_announce(fixture *f, tahr_vec3 at, tahr_vec3 up, double reach);
/* A random query near the triangles: any shape, up and motion. */
tahr_sweep soup_query(const soup *s, oracle_random *random, uint32_t n);

/* Asks worlds, to which different things were announced, the same questions and fails the test where a bit differs.
 * Returns how many blocking hits there were. */
uint32_t soup_compare(fixture *worlds, uint32_t count, const soup *s, uint32_t queries);

/* A mesh (world 0) and the same triangles, handed over in two orders, with caches and lanes on and off. */
enum { SOUP_WORLDS = 6 };
void soup_open_all(fixture worlds[SOUP_WORLDS], const tahr_body_desc *mesh, soup soups[2]);
/* Compares them on a level (scene_level.h); says so if it is not there. */
void soup_compare_level(const char *name, uint32_t queries);

#endif
