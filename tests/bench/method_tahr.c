/* SPDX-License-Identifier: MIT
 * method_tahr.c: Tahr as its users call it: a world of one body, a mover and a state for every character. */
#include "method_tahr.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "method_outline.h"

typedef struct crowd {
    tahr_world *world;
    tahr_config config;
    tahr_mover **movers;
    tahr_state *states;
    tahr_report report; /* of the last step */
    uint32_t *queries;
    uint32_t count;
    double dt;
    char *error; /* where the log goes while opening */
} crowd;

static void complain(void *user, int32_t level, const char *message)
{
    crowd *c = user;
    if (c->error && level == TAHR_LOG_ERROR) {
        snprintf(c->error, METHOD_ERROR, "%s", message);
    }
}

/* The wish becomes the velocity within a step: 1e6 m/s2 is the largest acceleration that a config takes. */
static void at_once(tahr_config *config)
{
    config->acceleration = config->braking_deceleration = 1e6;
    config->turn_friction = config->air_turn_friction = 1e4;
    config->air_control = 1;
}

static void configure(crowd *c, const method_tahr *knobs, const method_level *level, const method_character *who)
{
    tahr_config *config = &c->config;
    int32_t preset = knobs->preset ? knobs->preset : TAHR_PRESET_PRECISE;
    tahr_config_init(config, sizeof *config, preset);
    config->shape.radius = who->radius;
    config->shape.half_height = who->half_height;
    config->max_speed = who->max_speed;
    config->jump_speed = who->jump_speed;
    config->step_height = config->snap_distance = who->step_height;
    config->walkable_angle = who->walkable_angle;
    config->gravity = (tahr_vec3){0, 0, -who->gravity};
    if (level->planar) {
        config->gravity = (tahr_vec3){0, -who->gravity, 0};
        config->plane = (tahr_vec3){0, 0, 1};
    }
    if (!knobs->ramp_up) {
        at_once(config);
    }
    if (knobs->tune) {
        knobs->tune(config, knobs->tuning);
    }
}

static void describe_mesh(const method_level *level, tahr_body_desc *body)
{
    tahr_body_desc_init(body, sizeof *body, TAHR_BODY_MESH);
    body->vertices = level->vertices;
    body->indices = level->indices;
    body->vertex_count = level->vertex_count;
    body->triangle_count = level->triangle_count;
    body->flags = TAHR_BODY_TWO_SIDED;
}

static void describe_box(const double box[6], tahr_body_desc *body)
{
    tahr_body_desc_init(body, sizeof *body, TAHR_BODY_BOX);
    body->pose.position = (tahr_vec3){0.5 * (box[0] + box[3]), 0.5 * (box[1] + box[4]), 0.5 * (box[2] + box[5])};
    body->half_extents = (tahr_vec3){0.5 * (box[3] - box[0]), 0.5 * (box[4] - box[1]), 0.5 * (box[5] - box[2])};
}

static tahr_status open_bodies(crowd *c, const method_tahr *knobs, const tahr_body_desc *bodies, uint32_t count)
{
    tahr_log log = {c, complain};
    tahr_world_desc desc;
    tahr_world_desc_init(&desc, sizeof desc);
    desc.bodies = bodies;
    desc.body_count = count;
    desc.log = &log;
    return tahr_world_open(knobs->backend(), &desc, &c->world);
}

/* On a backend of the plane: the lines of the outline. */
static tahr_status open_outline(crowd *c, const method_tahr *knobs, const method_level *level)
{
    method_outline outline;
    tahr_status status = TAHR_E_MEMORY;
    int made = method_outline_make(&outline, level);
    double *vertices = calloc(3 * (size_t)outline.point_count + 1, sizeof *vertices);
    tahr_body_desc *bodies = calloc((size_t)outline.line_count + 1, sizeof *bodies);
    if (made && vertices && bodies) {
        for (uint32_t i = 0; i < outline.point_count; i++) {
            memcpy(vertices + 3 * (size_t)i, outline.points + 2 * (size_t)i, 2 * sizeof *vertices);
        }
        for (uint32_t i = 0; i < outline.line_count; i++) {
            const method_line *line = &outline.lines[i];
            tahr_body_desc_init(&bodies[i], sizeof bodies[i], TAHR_BODY_CHAIN);
            bodies[i].vertices = vertices + 3 * (size_t)line->first;
            bodies[i].vertex_count = line->count;
            bodies[i].flags = TAHR_BODY_TWO_SIDED | (line->loop ? (uint32_t)TAHR_BODY_LOOP : 0u);
        }
        status = open_bodies(c, knobs, bodies, outline.line_count);
    }
    free(vertices);
    free(bodies);
    method_outline_free(&outline);
    return status;
}

static tahr_status open_world(crowd *c, const method_tahr *knobs, const method_level *level)
{
    tahr_body_desc body;
    if (level->planar && (knobs->backend()->capabilities & TAHR_CAP_PLANAR)) {
        return open_outline(c, knobs, level);
    }
    if (knobs->box && level->box) {
        describe_box(level->box, &body);
    } else {
        describe_mesh(level, &body);
    }
    return open_bodies(c, knobs, &body, 1);
}

static void close_crowd(void *self)
{
    crowd *c = self;
    for (uint32_t i = 0; c->movers && i < c->count; i++) {
        tahr_mover_destroy(c->movers[i]);
    }
    tahr_world_close(c->world);
    free(c->movers);
    free(c->states);
    free(c->queries);
    free(c);
}

static tahr_status fill(crowd *c, const method_tahr *knobs, const method_level *level)
{
    c->movers = calloc(c->count, sizeof *c->movers);
    c->states = calloc(c->count, sizeof *c->states);
    c->queries = calloc(c->count, sizeof *c->queries);
    if (!c->movers || !c->states || !c->queries) {
        return TAHR_E_MEMORY;
    }
    tahr_status status = open_world(c, knobs, level);
    for (uint32_t i = 0; status >= 0 && i < c->count; i++) {
        status = tahr_mover_create(c->world, &c->config, &c->movers[i]);
    }
    return status;
}

static void *open_crowd(const method *m, const method_level *level, const method_character *who, uint32_t count,
                        char *error)
{
    const method_tahr *knobs = m->data;
    if ((knobs->backend()->capabilities & TAHR_CAP_PLANAR) && !level->planar) {
        snprintf(error, METHOD_ERROR, "two dimensions only");
        return NULL;
    }
    crowd *c = calloc(1, sizeof *c);
    if (!c) {
        snprintf(error, METHOD_ERROR, "out of memory");
        return NULL;
    }
    error[0] = 0;
    c->error = error;
    c->count = count;
    c->dt = who->dt;
    configure(c, knobs, level, who);
    tahr_status status = fill(c, knobs, level);
    if (status < 0) {
        if (!error[0]) {
            snprintf(error, METHOD_ERROR, "%s", tahr_status_name(status));
        }
        close_crowd(c);
        return NULL;
    }
    c->error = NULL;
    return c;
}

static void place(void *self, uint32_t i, const double position[3])
{
    crowd *c = self;
    tahr_vec3 at = {position[0], position[1], position[2]};
    tahr_state_init(&c->states[i], &c->config, &at);
    c->queries[i] = 0;
}

static void step(void *self, uint32_t i, const double wish[3], int jump)
{
    crowd *c = self;
    double scale = 1 / c->config.max_speed;
    tahr_input input = {
        .struct_size = sizeof input, .move = {scale * wish[0], scale * wish[1], 0}, .jump = jump ? 1u : 0u};
    c->report = (tahr_report){.struct_size = sizeof c->report};
    if (tahr_mover_step(c->movers[i], &input, c->dt, &c->states[i], &c->report) < 0) {
        c->states[i].position.x = NAN; /* the judge counts it; a step that refuses says so in no other way here */
    }
    c->queries[i] = c->report.sweeps + c->report.contact_queries + c->report.rays;
}

static void look(void *self, uint32_t i, method_place *out)
{
    const crowd *c = self;
    const tahr_state *s = &c->states[i];
    *out = (method_place){.position = {s->position.x, s->position.y, s->position.z},
                          .velocity = {s->velocity.x, s->velocity.y, s->velocity.z},
                          .grounded = s->mode == TAHR_MODE_WALKING,
                          .queries = c->queries[i]};
}

method method_of_tahr(const char *name, const char *settings, const method_tahr *knobs)
{
    return (method){.name = name,
                    .version = tahr_version(),
                    .settings = settings,
                    .open = open_crowd,
                    .close = close_crowd,
                    .place = place,
                    .step = step,
                    .look = look,
                    .data = knobs};
}

const tahr_report *method_tahr_report(const void *self)
{
    const crowd *c = self;
    return &c->report;
}

tahr_world *method_tahr_world(const void *self)
{
    const crowd *c = self;
    return c->world;
}
