/* SPDX-License-Identifier: MIT
 * scene_measure.c: what can be measured at the end of a step of a scene. */
#include "scene_measure.h"

#include <math.h>
#include <string.h>

double scene_way(const scene_sample *a, const scene_sample *b)
{
    tahr_vec3 p = a->state.position, q = b->state.position;
    return sqrt((q.x - p.x) * (q.x - p.x) + (q.y - p.y) * (q.y - p.y) + (q.z - p.z) * (q.z - p.z));
}

tahr_vec3 scene_velocity(const scene_case *c, const scene_sample *s)
{
    tahr_vec3 v = s->state.velocity, b = s->state.base.velocity;
    if (!json_is_true(json_object_get(c->item, "world")) || s->state.base.body == TAHR_NO_BODY) {
        return v;
    }
    return (tahr_vec3){v.x + b.x, v.y + b.y, v.z + b.z};
}

/* Degrees about z, of a character that stands upright. */
static double yaw_of(tahr_quat q)
{
    return 2 * atan2(q.z, q.w) * 57.29577951308232;
}

static double speed_of(tahr_vec3 v)
{
    return sqrt(v.x * v.x + v.y * v.y);
}

double scene_measure(const scene_case *c, const scene_sample *s, const char *of)
{
    const tahr_state *t = &s->state;
    const struct {
        const char *name;
        double value;
    } measures[] = {{"x", t->position.x},
                    {"y", t->position.y},
                    {"z", t->position.z},
                    {"foot", t->position.z - t->half_height},
                    {"vx", scene_velocity(c, s).x},
                    {"vy", scene_velocity(c, s).y},
                    {"rise", scene_velocity(c, s).z},
                    {"speed", speed_of(scene_velocity(c, s))},
                    {"yaw", yaw_of(t->orientation)},
                    {"radius", t->radius},
                    {"half_height", t->half_height},
                    {"immersion", s->immersion},
                    {"touched", t->touched_count},
                    {"clearance", s->clearance},
                    {"sweeps", s->sweeps},
                    {"queries", s->queries},
                    {"step_offset", s->step_offset}};
    for (size_t i = 0; i < sizeof measures / sizeof measures[0]; i++) {
        if (strcmp(measures[i].name, of) == 0) {
            return measures[i].value;
        }
    }
    return strcmp(of, "path_speed") == 0 && s > c->record->samples ? scene_way(s - 1, s) / s->dt : NAN;
}
