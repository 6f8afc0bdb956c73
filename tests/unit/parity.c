/* SPDX-License-Identifier: MIT
 * parity.c: see parity.h. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <tahr/native.h>
#ifdef TAHR_HAVE_CCD
#include <tahr/ccd.h>
#endif

#include "limits.h"
#include "parity.h"
#include "query.h"

double parity_cm(double x)
{
    return x / 100;
}

tahr_vec3 parity_vec(double x, double y, double z)
{
    return vec(x / 100, y / 100, z / 100);
}

const char *parity_backend_name(int backend)
{
    static const char *const names[PARITY_BACKENDS] = {"closed forms", "native", "ccd"};
    return names[backend];
}

int parity_has(int backend)
{
#ifdef TAHR_HAVE_CCD
    return backend < PARITY_BACKENDS;
#else
    return backend != PARITY_CCD;
#endif
}

double parity_tolerance(int backend)
{
    return backend == PARITY_CCD ? 1e-2 : 1e-4;
}

static parity_solid *add_solid(parity_scene *scene, int kind)
{
    assert_true(scene->count < PARITY_SOLIDS);
    parity_solid *s = &scene->solids[scene->count++];
    memset(s, 0, sizeof *s);
    s->kind = kind;
    return s;
}

parity_solid *parity_plane(parity_scene *scene, double nx, double ny, double nz, double offset)
{
    parity_solid *s = add_solid(scene, FAKE_HALF_SPACE);
    s->normal = unit(vec(nx, ny, nz));
    s->offset = offset;
    return s;
}

parity_solid *parity_box(parity_scene *scene, tahr_vec3 min, tahr_vec3 max)
{
    parity_solid *s = add_solid(scene, FAKE_BOX);
    s->min = min;
    s->max = max;
    return s;
}

tahr_config parity_config(void)
{
    tahr_config c;
    assert_int_equal(tahr_config_init(&c, sizeof c, TAHR_PRESET_UNREAL), TAHR_OK);
    return c;
}

static void open_fake(parity *p, const parity_scene *scene)
{
    fake_world_init(&p->fake);
    for (uint32_t i = 0; i < scene->count; i++) {
        const parity_solid *s = &scene->solids[i];
        fake_solid *f = s->kind == FAKE_BOX ? fake_add_box(&p->fake, scale(s->min, 0.01), scale(s->max, 0.01))
                                            : fake_add_plane(&p->fake, s->normal, s->offset / 100);
        f->walkable_rule = s->walkable_rule;
        f->walkable_angle = s->walkable_angle;
    }
    tahr_callbacks callbacks = fake_callbacks(&p->fake);
    assert_int_equal(tahr_world_open_callbacks(&callbacks, NULL, &p->world), TAHR_OK);
}

/* The square of a plane. Neither its middle nor its diagonal lies under a character at the origin: that would be a test
 * of edges. */
static void make_square(const parity_solid *s, double vertices[12])
{
    static const double corner[4][2] = {{-5.3, -6.1}, {6.7, -6.1}, {6.7, 5.9}, {-5.3, 5.9}};
    vec3 n = s->normal, x = unit(cross(fabs(n.z) < 0.9 ? vec(0, 0, 1) : vec(0, 1, 0), n)), y = cross(n, x);
    for (int i = 0; i < 4; i++) {
        vec3 v = add_scaled(add_scaled(scale(n, s->offset / 100), x, corner[i][0]), y, corner[i][1]);
        memcpy(vertices + 3 * i, &v, sizeof v);
    }
}

static void open_bodies(parity *p, const parity_scene *scene)
{
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    double vertices[PARITY_SOLIDS][12];
    tahr_body_desc bodies[PARITY_SOLIDS];
    tahr_world_desc desc;
    const tahr_backend *backend = tahr_backend_v1_native();
    assert_int_equal(tahr_world_desc_init(&desc, sizeof desc), TAHR_OK);
#ifdef TAHR_HAVE_CCD
    if (p->backend == PARITY_CCD) {
        backend = tahr_backend_v1_ccd();
    }
#endif
    for (uint32_t i = 0; i < scene->count; i++) {
        const parity_solid *s = &scene->solids[i];
        tahr_body_desc *b = &bodies[i];
        int box = s->kind == FAKE_BOX;
        assert_int_equal(tahr_body_desc_init(b, sizeof *b, box ? TAHR_BODY_BOX : TAHR_BODY_MESH), TAHR_OK);
        b->flags = s->flags;
        b->walkable_rule = s->walkable_rule;
        b->walkable_angle = s->walkable_angle;
        if (box) {
            b->half_extents = scale(sub(s->max, s->min), 0.005);
            b->pose.position = scale(add(s->max, s->min), 0.005);
            continue;
        }
        make_square(s, vertices[i]);
        b->vertices = vertices[i];
        b->indices = indices;
        b->vertex_count = 4;
        b->triangle_count = 2;
    }
    desc.bodies = bodies;
    desc.body_count = scene->count;
    assert_int_equal(tahr_world_open(backend, &desc, &p->world), TAHR_OK);
}

static void begin_step(parity *p, const tahr_config *config)
{
    tahr__step *s = &p->step;
    p->config = config ? *config : parity_config();
    p->limits = tahr__limits_of(&p->config, &p->config.shape, p->world->backend->capabilities);
    p->input.struct_size = sizeof p->input;
    s->config = &p->config;
    s->limits = &p->limits;
    s->pull = &p->limits.pull;
    s->world = p->world;
    s->input = &p->input;
    s->ignore_body = TAHR_NO_BODY;
    s->dt = 1.0 / 60;
}

void parity_hold_to(parity *p, vec3 plane)
{
    p->config.plane = plane;
    p->limits = tahr__limits_of(&p->config, &p->config.shape, p->world->backend->capabilities);
}

void parity_put(parity *p, double x, double y, double z)
{
    vec3 at = parity_vec(x, y, z);
    tahr__step *s = &p->step;
    assert_int_equal(tahr_state_init(&s->state, &p->config, &at), TAHR_OK);
    s->state.mode = TAHR_MODE_FLYING;
    memset(&s->report, 0, sizeof s->report);
    s->report.struct_size = sizeof s->report;
    s->report.events = p->events;
    s->report.event_capacity = PARITY_EVENTS;
    s->queries = 0;
    s->just_teleported = 0;
    s->error = TAHR_OK;
    s->push_left = p->config.max_depenetration;
    s->time = s->ahead = 0;
}

void parity_open(parity *p, const parity_scene *scene, int backend, const tahr_config *config, double x, double y,
                 double z)
{
    memset(p, 0, sizeof *p);
    p->backend = backend;
    if (backend == PARITY_FAKE) {
        open_fake(p, scene);
    } else {
        open_bodies(p, scene);
    }
    begin_step(p, config);
    parity_put(p, x, y, z);
}

void parity_open_callbacks(parity *p, const tahr_callbacks *callbacks, const tahr_config *config)
{
    memset(p, 0, sizeof *p);
    assert_int_equal(tahr_world_open_callbacks(callbacks, NULL, &p->world), TAHR_OK);
    begin_step(p, config);
    parity_put(p, 0, 0, 0);
}

void parity_close(parity *p)
{
    tahr_world_close(p->world);
}

void parity_floor(parity *p, double distance, tahr_vec3 normal, uint32_t flags)
{
    tahr_floor *f = &p->step.state.floor;
    f->flags = flags;
    f->normal = f->surface_normal = normal;
    f->distance = distance / 100;
    f->body = 0;
}

void parity_begin(parity_table *table, const char *name)
{
    memset(table, 0, sizeof *table);
    table->name = name;
}

void parity_row(parity_table *table, const char *id, const char *where)
{
    uint32_t i = 0;
    while (i < table->rows && strcmp(table->ids[i], id) != 0) {
        i++;
    }
    assert_true(i < PARITY_ROWS);
    table->ids[i] = id;
    table->rows += i == table->rows;
    table->now = i;
    table->where = where ? where : "by itself";
}

/* The row that runs, which is wrong. */
static const char *red_row(parity_table *table)
{
    table->is_red[table->now] = 1;
    return table->ids[table->now];
}

void parity_number(parity_table *table, const char *what, double got, double expected, double tolerance)
{
    if (!(fabs(got - expected) <= tolerance)) {
        print_error("row %s, %s: %s is %.9g, expected %.9g within %g\n", red_row(table), table->where, what, got,
                    expected, tolerance);
    }
}

void parity_length(parity_table *table, const char *what, double got, double expected, double tolerance)
{
    parity_number(table, what, got * 100, expected, tolerance);
}

void parity_vector(parity_table *table, const char *what, tahr_vec3 got, double x, double y, double z, double tolerance)
{
    vec3 off = sub(scale(got, 100), vec(x, y, z));
    if (!(fabs(off.x) <= tolerance && fabs(off.y) <= tolerance && fabs(off.z) <= tolerance)) {
        print_error("row %s, %s: %s is (%.9g, %.9g, %.9g), expected (%.9g, %.9g, %.9g) within %g\n", red_row(table),
                    table->where, what, got.x * 100, got.y * 100, got.z * 100, x, y, z, tolerance);
    }
}

void parity_count(parity_table *table, const char *what, uint32_t got, uint32_t expected)
{
    if (got != expected) {
        print_error("row %s, %s: %s is %u, expected %u\n", red_row(table), table->where, what, got, expected);
    }
}

void parity_true(parity_table *table, const char *what, int got)
{
    if (!got) {
        print_error("row %s, %s: not so: %s\n", red_row(table), table->where, what);
    }
}

void parity_end(parity_table *table)
{
    uint32_t red = 0;
    printf("parity (%s):", table->name); /* read by parity_count.sh */
    for (uint32_t i = 0; i < table->rows; i++) {
        red += table->is_red[i];
        if (!table->is_red[i]) {
            printf(" %s", table->ids[i]);
        }
    }
    printf("\n");
    fflush(stdout);
    if (red > 0) {
        fail_msg("parity: %u of %u rows red (%s)", red, table->rows, table->name);
    }
    assert_true(table->rows > 0);
}
