/* SPDX-License-Identifier: MIT
 * native_fixture.c: see native_fixture.h. */
#include "native_fixture.h"

#include <stdlib.h>
#include <string.h>

static void *counted_alloc(void *user, size_t size, size_t alignment)
{
    fixture *f = user;
    if (++f->asked == f->fail_at) return NULL;
    f->bytes += size;
    f->blocks++;
    if (f->bytes > f->most) f->most = f->bytes;
    return aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

static void counted_free(void *user, void *memory, size_t size, size_t alignment)
{
    fixture *f = user;
    (void)alignment;
    f->bytes -= size;
    f->blocks--;
    free(memory);
}

static void capture(void *user, int32_t level, const char *message)
{
    fixture *f = user;
    (void)level;
    strncpy(f->message, message, sizeof f->message - 1);
}

void fixture_init(fixture *f)
{
    memset(f, 0, sizeof *f);
    f->host.struct_size = sizeof f->host;
    f->host.abi = TAHR_ABI;
    f->host.allocator.user = f;
    f->host.allocator.alloc = counted_alloc;
    f->host.allocator.free = counted_free;
    f->host.log.user = f;
    f->host.log.write = capture;
}

tahr_status fixture_open(fixture *f, const tahr_body_desc *bodies, uint32_t count, const tahr_native_desc *options,
                         int with_cache)
{
    tahr_world_desc desc;
    memset(&desc, 0, sizeof desc);
    desc.struct_size = sizeof desc;
    desc.bodies = bodies;
    desc.body_count = count;
    desc.options = options;
    const tahr_backend *native = tahr_backend_v1_native();
    tahr_status status = native->open(&f->host, &desc, &f->self);
    if (status == TAHR_OK && with_cache) {
        size_t size = (native->cache_size(f->self) + 63) / 64 * 64;
        f->memory = aligned_alloc(64, size);
        memset(f->memory, 0, size);
        f->context.cache = f->memory;
    }
    return status;
}

void fixture_close(fixture *f)
{
    if (f->self) tahr_backend_v1_native()->close(f->self);
    free(f->memory);
    f->self = f->memory = NULL;
}

tahr_body_desc fixture_body(uint32_t type)
{
    tahr_body_desc d;
    memset(&d, 0, sizeof d);
    d.struct_size = sizeof d;
    d.type = type;
    return d;
}

tahr_body_desc fixture_mesh(const double *vertices, uint32_t vertex_count, const uint32_t *indices,
                            uint32_t triangle_count)
{
    tahr_body_desc d = fixture_body(TAHR_BODY_MESH);
    d.vertices = vertices;
    d.vertex_count = vertex_count;
    d.indices = indices;
    d.triangle_count = triangle_count;
    return d;
}

tahr_native_desc fixture_options(void)
{
    tahr_native_desc d;
    memset(&d, 0, sizeof d);
    d.struct_size = sizeof d;
    return d;
}

tahr_shape fixture_shape(uint32_t type, double radius, double half_height)
{
    tahr_shape s;
    memset(&s, 0, sizeof s);
    s.type = type;
    s.half_height = half_height;
    if (type == TAHR_SHAPE_BOX)
        s.half_x = s.half_y = radius;
    else
        s.radius = radius;
    return s;
}

tahr_sweep fixture_sweep(tahr_shape shape, tahr_vec3 position, tahr_vec3 motion, double margin)
{
    tahr_sweep q;
    memset(&q, 0, sizeof q);
    q.shape = shape;
    q.position = position;
    q.up.z = 1;
    q.orientation.w = 1;
    q.motion = motion;
    q.margin = margin;
    q.mask = 0xFFFFFFFFu;
    q.ignore_body = TAHR_NO_BODY;
    return q;
}

tahr_contact_query fixture_contacts(tahr_shape shape, tahr_vec3 position, double margin)
{
    tahr_contact_query q;
    memset(&q, 0, sizeof q);
    q.shape = shape;
    q.position = position;
    q.up.z = 1;
    q.orientation.w = 1;
    q.margin = margin;
    q.mask = 0xFFFFFFFFu;
    q.ignore_body = TAHR_NO_BODY;
    return q;
}

void fixture_announce(fixture *f, tahr_vec3 position, double half)
{
    tahr_prepare p;
    memset(&p, 0, sizeof p);
    p.position = position;
    p.up.z = 1;
    p.mask = 0xFFFFFFFFu;
    p.bounds.min = (tahr_vec3){position.x - half, position.y - half, position.z - half};
    p.bounds.max = (tahr_vec3){position.x + half, position.y + half, position.z + half};
    tahr_backend_v1_native()->prepare(f->self, &f->context, &p);
}

tahr_hit fixture_hit(fixture *f, const tahr_sweep *sweep)
{
    tahr_hit hit;
    uint32_t count = 0;
    memset(&hit, 0, sizeof hit);
    tahr_backend_v1_native()->sweep(f->self, &f->context, sweep, &hit, 1, &count);
    if (count == 0) memset(&hit, 0, sizeof hit);
    return hit;
}

void fixture_grid(uint32_t n, double cell, double (*height)(double x, double y), double *vertices, uint32_t *indices)
{
    for (uint32_t i = 0; i <= n; i++) {
        for (uint32_t j = 0; j <= n; j++) {
            double *v = vertices + 3 * (size_t)(i * (n + 1) + j);
            v[0] = cell * i;
            v[1] = cell * j;
            v[2] = height ? height(v[0], v[1]) : 0;
        }
    }
    for (uint32_t i = 0; i < n; i++) {
        for (uint32_t j = 0; j < n; j++) {
            uint32_t a = i * (n + 1) + j, b = a + n + 1, *t = indices + 6 * (size_t)(i * n + j);
            t[0] = a;
            t[1] = b;
            t[2] = b + 1;
            t[3] = a;
            t[4] = b + 1;
            t[5] = a + 1;
        }
    }
}
