/* SPDX-License-Identifier: MIT
 * native_fixture.h: a native world opened without the library, with counted memory and a captured log. */
#ifndef TAHR_TEST_NATIVE_FIXTURE_H
#define TAHR_TEST_NATIVE_FIXTURE_H

#include <tahr/native.h>

typedef struct fixture {
    tahr_host host;
    void *self;
    void *memory;               /* of a cache */
    size_t bytes, most, blocks; /* held now, at most; */
    size_t fail_at;             /* the allocation that fails, counted from 1; 0: none */
    size_t asked;
    char message[256];
    tahr_query_context context;
} fixture;

void fixture_init(fixture *f);
/* Opens; the cache is created if with_cache. */
tahr_status fixture_open(fixture *f, const tahr_body_desc *bodies, uint32_t count, const tahr_native_desc *options,
                         int with_cache);
void fixture_close(fixture *f);

tahr_body_desc fixture_body(uint32_t type);
tahr_body_desc fixture_mesh(const double *vertices, uint32_t vertex_count, const uint32_t *indices,
                            uint32_t triangle_count);
tahr_native_desc fixture_options(void);
tahr_shape fixture_shape(uint32_t type, double radius, double half_height);
tahr_sweep fixture_sweep(tahr_shape shape, tahr_vec3 position, tahr_vec3 motion, double margin);
tahr_contact_query fixture_contacts(tahr_shape shape, tahr_vec3 position, double margin);
void fixture_announce(fixture *f, tahr_vec3 position, double half);

/* One blocking hit, zeroed when free. */
tahr_hit fixture_hit(fixture *f, const tahr_sweep *sweep);

/* A grid of n x n cells of side cell, heights from a function (NULL: flat), corners at whole multiples; indices 6 n
 * n. */
void fixture_grid(uint32_t n, double cell, double (*height)(double x, double y), double *vertices, uint32_t *indices);

#endif
