/* SPDX-License-Identifier: MIT
 * glide.c: moving freely in three dimensions. */
#include "glide.h"

#include <string.h>

#include "floor.h"
#include "move.h"
#include "overlap.h"
#include "report.h"
#include "scope.h"
#include "step_up.h"

/* Of the time of a slice: no piece is shorter, however much the path bends. */
static const double SHORTEST_PIECE = 1.0 / 32;

/* A face as steep as this is the front of a step (Unreal's 0.2), and this much of a wish may point down or up while
 * stepping onto it (-0.2, 0.5). */
static const double FRONT = 0.2, SINKING = -0.2, RISING = 0.5;

void tahr__glide_begin(tahr__step *step, tahr__glide *g, double time)
{
    step->just_teleported = 0;
    g->lifted = vec(0, 0, 0);
    g->start = step->state.position;
    g->time = g->left = time;
    g->hits = g->pieces = g->plane_count = 0;
    tahr__around_begin(&g->around);
}

int tahr__glide_goes_on(const tahr__step *step, tahr__glide *g)
{
    if (g->left <= 0 || step->error < 0 || (step->report.flags & TAHR_REPORT_QUERY_CAP) ||
        g->hits >= step->config->max_slides || g->pieces >= TAHR__GLIDE_PIECES) {
        return 0;
    }
    g->pieces++;
    tahr__planes_forget(step, g->planes, &g->plane_count);
    return 1;
}

/* A chord lies off its arc by |a| t^2 / 8. */
double tahr__glide_piece(const tahr__step *step, const tahr__glide *g, double acceleration)
{
    if (step->config->integrator == TAHR_INTEGRATOR_STEPPED || acceleration <= 0) {
        return tahr__around_piece(&g->around, g->left);
    }
    double longest = max_of(sqrt(8 * step->config->skin / acceleration), g->time * SHORTEST_PIECE);
    double time = g->left <= longest ? g->left : g->left / (double)(int)(g->left / longest + 1);
    return tahr__around_piece(&g->around, time);
}

void tahr__glide_use(tahr__step *step, tahr__glide *g, double time)
{
    tahr__time_even(step, step->time, step->time + time);
    if (step->trail && step->trail->count > TAHR__LEGS / 2 && !step->trail->held) {
        tahr__sense(step);
    }
    step->time += time;
    g->left -= time;
    if (g->left < 1e-12) { /* rounding */
        step->time += g->left;
        g->left = 0;
    }
}

void tahr__glide_pass(tahr__step *step, tahr__glide *g, double time)
{
    tahr__plane plane;
    tahr__glide_use(step, g, time);
    if (tahr__around_use(&g->around, time) && g->left > 0 &&
        tahr__around_turn(step, &g->around, &plane, &step->state.velocity)) {
        tahr__planes_add(g->planes, &g->plane_count, &plane);
    }
}

void tahr__glide_forget_floor(tahr__step *step)
{
    tahr_floor none;
    memset(&none, 0, sizeof none);
    none.body = TAHR_NO_BODY;
    step->state.floor = none;
    step->state.floor_position = vec(0, 0, 0);
    step->state.floor_revision = 0;
    step->state.flags &= ~(uint32_t)TAHR_STATE_FLOOR_MOVED;
}

/* What carries a character here does so at its foot: steps are measured from there. */
static void stand_on_nothing(tahr__step *step)
{
    tahr_floor here;
    memset(&here, 0, sizeof here);
    here.body = TAHR_NO_BODY;
    here.normal = here.surface_normal = step->state.up;
    here.point = step_foot(step);
    here.flags = TAHR_FLOOR_BLOCKING | TAHR_FLOOR_WALKABLE | TAHR_FLOOR_FACE;
    tahr__keep_floor(step, &here);
}

static int is_front(const tahr__step *step, const tahr_hit *hit, vec3 level)
{
    vec3 wish = step->input->move, up = step->state.up;
    double steep = dot(hit->normal, up), size = length(wish), lean = dot(wish, up);
    return steep <= FRONT && steep >= -FRONT && lean >= SINKING * size && lean <= RISING * size &&
           length_squared(level) > 0 && dot(level, hit->normal) < 0;
}

double tahr__glide_step_up(tahr__step *step, tahr__glide *g, const tahr_hit *hit, vec3 rest, int (*keeps)(tahr__step *))
{
    const tahr__swept swept = {.hit = *hit, .location = step->state.position, .motion = rest};
    vec3 level = step_level(step, rest);
    const vec3 before = step->state.position, up = step->state.up;
    tahr__scope scope;
    int found;
    if (!is_front(step, hit, level)) {
        return 0;
    }
    tahr__scope_open(step, &scope);
    stand_on_nothing(step);
    double covered = tahr__step_up_at(step, level, &swept, &found);
    if (covered > 0 && !found) { /* Unreal's, which comes down as far where nothing is: nobody stands on the foot */
        tahr__glide_forget_floor(step);
    }
    if (covered > 0 && (!keeps || keeps(step))) {
        g->plane_count = 0; /* what stood beside the foot below need not stand here */
        g->hits++;
        g->lifted = add_scaled(g->lifted, up, dot(sub(step->state.position, before), up));
        return covered;
    }
    tahr__scope_revert(step, &scope);
    return 0;
}

int tahr__glide_meet(tahr__step *step, tahr__glide *g, const tahr_hit *hit)
{
    if (hit->unknown || hit->start_overlap) {
        return 0;
    }
    g->hits++;
    tahr__plane plane = tahr__plane_of(step, hit);
    tahr__event(step, TAHR_EVENT_HIT, hit, max_of(-dot(step->state.velocity, hit->normal), 0));
    tahr__around_hit(&g->around, g->planes, &g->plane_count);
    tahr__planes_add(g->planes, &g->plane_count, &plane);
    tahr__around_meet(step, hit, 0, &g->around);
    step->state.velocity = tahr__glide_bend(g, step->state.velocity);
    step->report.slides++;
    return tahr__decide(step, TAHR_RULE_SLIDE, 1, hit, dot(hit->normal, step->state.up), 0, "slides along");
}

int tahr__glide_two_walls(tahr__step *step, tahr__glide *g, const tahr__glide_motion *m, tahr_hit *hit)
{
    tahr__swept swept;
    vec3 from = sub(step->state.position, g->lifted);
    int up = 0;
    tahr__safe_move(step, m->way, &swept);
    *hit = swept.hit;
    if (is_met(hit)) {
        double rest = 1 - hit->fraction;
        step->ahead = m->time * hit->fraction;
        up = tahr__glide_step_up(step, g, hit, scale(m->way, rest), m->keeps) > 0;
        if (!up) {
            tahr__handle_impact(step, hit);
            tahr__slide_along_surface(step, m->way, rest, hit->normal, &swept);
            step->report.slides++;
        }
        step->ahead = 0;
    }
    if (hit->blocking && m->time > 0 && !step->just_teleported) {
        step->state.velocity = scale(sub(sub(step->state.position, g->lifted), from), 1 / m->time);
    }
    tahr__glide_use(step, g, m->time);
    return up;
}

void tahr__glide_end(tahr__step *step, tahr__glide *g)
{
    double used = g->time - g->left;
    if (step->config->integrator == TAHR_INTEGRATOR_STEPPED && used > 0 && !step->just_teleported) {
        step->state.velocity = scale(sub(sub(step->state.position, g->lifted), g->start), 1.0 / used);
    }
    step->time += g->left;
    step->report.time_lost += g->left;
    g->left = 0;
}
