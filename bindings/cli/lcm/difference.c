/* SPDX-License-Identifier: MIT
 * difference.c: in which fields a state differs from a recorded one. */
#include "difference.h"

#include <inttypes.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

enum { FIELDS_SAID = 6 }; /* the first ones say what went wrong; later ones follow from them */

enum field_type { REAL, WHOLE, LONG };

static const struct {
    const char *name;
    size_t offset;
    enum field_type type;
    size_t count;
} fields[] = {
#define FIELD(name, type, count) #name, offsetof(tahr_state, name), type, count
    {FIELD(position, REAL, 3)},
    {FIELD(velocity, REAL, 3)},
    {FIELD(orientation, REAL, 4)},
    {FIELD(up, REAL, 3)},
    {FIELD(mode, WHOLE, 1)},
    {FIELD(flags, WHOLE, 1)},
    {FIELD(floor.normal, REAL, 3)},
    {FIELD(floor.surface_normal, REAL, 3)},
    {FIELD(floor.point, REAL, 3)},
    {FIELD(floor.distance, REAL, 1)},
    {FIELD(floor.perch_distance, REAL, 1)},
    {FIELD(floor.flags, WHOLE, 1)},
    {FIELD(floor.body, WHOLE, 1)},
    {FIELD(floor.feature, WHOLE, 1)},
    {FIELD(floor.surface, WHOLE, 1)},
    {FIELD(floor_position, REAL, 3)},
    {FIELD(floor_revision, LONG, 1)},
    {FIELD(jump_hold, REAL, 1)},
    {FIELD(radius, REAL, 1)},
    {FIELD(half_height, REAL, 1)},
    {FIELD(base.body, WHOLE, 1)},
    {FIELD(base.seen, WHOLE, 1)},
    {FIELD(base.pose, REAL, 7)},
    {FIELD(base.velocity, REAL, 3)},
    {FIELD(touched, WHOLE, TAHR_MAX_TOUCHED)},
    {FIELD(touched_count, WHOLE, 1)},
    {FIELD(jump_count, WHOLE, 1)},
    {FIELD(coyote_left, REAL, 1)},
    {FIELD(buffer_left, REAL, 1)},
    {FIELD(lift_left, REAL, 1)},
    {FIELD(wall_left, REAL, 1)},
    {FIELD(wall_normal, REAL, 3)},
    {FIELD(wall_body, WHOLE, 1)},
    {FIELD(wall_feature, WHOLE, 1)},
    {FIELD(drop_body, WHOLE, 1)},
    {FIELD(drop_feature, WHOLE, 1)},
#undef FIELD
};

/* What is said so far. */
struct saying {
    char *text;
    size_t size;
    int count;
};

static void say_field(struct saying *s, const char *name, size_t index, size_t of, const char *ours, const char *theirs)
{
    const size_t used = strlen(s->text);
    char which[24] = "";
    if (of == 3) {
        snprintf(which, sizeof which, ".%c", "xyz"[index]);
    } else if (of > 1) {
        snprintf(which, sizeof which, "[%zu]", index);
    }
    if (s->count++ < FIELDS_SAID) {
        snprintf(s->text + used, s->size - used, "%s%s%s is %s, recorded %s", used > 0 ? "; " : "", name, which, ours,
                 theirs);
    } else if (s->count == FIELDS_SAID + 1) {
        snprintf(s->text + used, s->size - used, "; ...");
    }
}

static void compare_reals(struct saying *s, const char *name, const double *ours, const double *theirs, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        char a[32], b[32];
        if (ours[i] == theirs[i]) {
            continue; /* -0 and 0 have one hash */
        }
        snprintf(a, sizeof a, "%.17g", ours[i]);
        snprintf(b, sizeof b, "%.17g", theirs[i]);
        say_field(s, name, i, count, a, b);
    }
}

static void compare_whole(struct saying *s, const char *name, size_t index, size_t of, const uint64_t pair[2])
{
    char a[32], b[32];
    if (pair[0] != pair[1]) {
        snprintf(a, sizeof a, "%" PRIu64, pair[0]);
        snprintf(b, sizeof b, "%" PRIu64, pair[1]);
        say_field(s, name, index, of, a, b);
    }
}

int difference_of_states(const tahr_state *state, const tahr_state *recorded, char *text, size_t size)
{
    struct saying saying = {text, size, 0};
    text[0] = 0;
    for (size_t f = 0; f < sizeof fields / sizeof *fields; f++) {
        const uint8_t *ours = (const uint8_t *)state + fields[f].offset;
        const uint8_t *theirs = (const uint8_t *)recorded + fields[f].offset;
        for (size_t i = 0; i < fields[f].count && fields[f].type == WHOLE; i++) {
            uint32_t a = 0, b = 0;
            memcpy(&a, ours + i * sizeof a, sizeof a);
            memcpy(&b, theirs + i * sizeof b, sizeof b);
            compare_whole(&saying, fields[f].name, i, fields[f].count, (uint64_t[2]){a, b});
        }
        if (fields[f].type == LONG) {
            uint64_t pair[2];
            memcpy(&pair[0], ours, sizeof pair[0]);
            memcpy(&pair[1], theirs, sizeof pair[1]);
            compare_whole(&saying, fields[f].name, 0, 1, pair);
        }
        if (fields[f].type == REAL) {
            double a[8], b[8];
            memcpy(a, ours, fields[f].count * sizeof *a);
            memcpy(b, theirs, fields[f].count * sizeof *b);
            compare_reals(&saying, fields[f].name, a, b, fields[f].count);
        }
    }
    return saying.count;
}

/* Of a state what its message holds, so that there is one comparison. */
static tahr_state state_of(const tahr_state *state, const tahr_state_t *m)
{
    tahr_state s = *state;
    s.position = (tahr_vec3){m->position[0], m->position[1], m->position[2]};
    s.velocity = (tahr_vec3){m->velocity[0], m->velocity[1], m->velocity[2]};
    s.orientation = (tahr_quat){m->orientation[0], m->orientation[1], m->orientation[2], m->orientation[3]};
    s.up = (tahr_vec3){m->up[0], m->up[1], m->up[2]};
    s.mode = (uint32_t)m->mode;
    s.flags = (uint32_t)m->flags;
    s.radius = m->radius;
    s.half_height = m->half_height;
    s.base.body = (uint32_t)m->base_body;
    s.floor.flags = (uint32_t)m->floor_flags;
    s.floor.body = (uint32_t)m->floor_body;
    s.floor.feature = (uint32_t)m->floor_feature;
    s.floor.surface = (uint32_t)m->floor_surface;
    s.floor.distance = m->floor_distance;
    s.floor.normal = (tahr_vec3){m->floor_normal[0], m->floor_normal[1], m->floor_normal[2]};
    s.floor.surface_normal =
        (tahr_vec3){m->floor_surface_normal[0], m->floor_surface_normal[1], m->floor_surface_normal[2]};
    s.floor.point = (tahr_vec3){m->floor_point[0], m->floor_point[1], m->floor_point[2]};
    return s;
}

int difference_of_message(const tahr_state *state, const tahr_state_t *recorded, char *text, size_t size)
{
    const tahr_state theirs = state_of(state, recorded);
    return difference_of_states(state, &theirs, text, size);
}
