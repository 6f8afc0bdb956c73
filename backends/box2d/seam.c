/* SPDX-License-Identifier: MIT
 * seam.c: corners that are none: where segments of a line, flush tiles or bodies meet, the surface goes on. Box2D's own
 * casts and distances know nothing of this. */
#include "scene.h"

/* Surfaces this close (m) to a corner hold it: Box2D's floats are 1.5e-5 m apart at 128 m. Far below every skin, and
 * for very small characters this part of their size. */
#define WELD 2e-5
#define WELD_PART 1e-3
/* Slope at which a neighbour leads toward the shape: a float's rounding. */
#define NEARER 1e-7

typedef struct seam {
    const tahr__b2_probe *probe;
    const tahr__b2_piece *piece;
    double overlap; /* m, < 0: the shape at the start is in the piece, but their cores are apart */
    tahr__vec2 point, normal, direction;
    tahr__vec2 face;
    double weld;
    int nearer;
} seam;

/* Does it lead from the point along way toward the shape? */
static void look(seam *s, tahr__vec2 way)
{
    double size = f_length(way);
    if (size > 0 && f_dot(way, s->normal) > NEARER * size) s->nearer = 1;
}

int tahr__b2_in_front(const tahr__b2_piece *piece, const tahr__flat_near *near)
{
    return !piece->flat.one_sided || f_dot(near->normal, tahr__flat_normal(&piece->flat, 0)) >= TAHR__B2_BEHIND;
}

static void at_segment(seam *s, const tahr__b2_piece *other)
{
    const tahr__flat *f = &other->flat;
    tahr__vec2 to_first = f_sub(f->corner[0], s->point), to_last = f_sub(f->corner[1], s->point);
    tahr__vec2 front = tahr__flat_normal(f, 0);

    if (f->one_sided && f_dot(front, s->normal) < TAHR__B2_BEHIND) return;
    if (f_length(to_first) > s->weld) look(s, to_first);
    if (f_length(to_last) > s->weld) look(s, to_last);
    if (!f->one_sided && f_dot(front, s->normal) < 0) front = f_make(-front.x, -front.y);
    if (f_dot(front, s->direction) > f_dot(s->face, s->direction) && f_dot(front, s->normal) > TAHR__B2_BEHIND) {
        s->face = front;
    }
}

/* Inside of all faces but those through the point, the body fills a wedge between them. */
static void at_polygon(seam *s, const tahr__b2_piece *other)
{
    const tahr__flat *f = &other->flat;
    int active[2] = {0, 0}, count = 0;

    for (int i = 0; i < f->count; i++) {
        tahr__vec2 n = tahr__flat_normal(f, i);
        double height = f_dot(n, f_sub(s->point, f->corner[i])) - f->radius;
        if (height > s->weld) return;
        if (height < -s->weld) continue;
        if (count < 2) active[count] = i;
        count++;
    }
    if (count > 2) return; /* a body no larger than rounding */
    if (count == 0) s->nearer = 1;
    for (int k = 0; k < count; k++) {
        tahr__vec2 n = tahr__flat_normal(f, active[k]), along = f_make(-n.y, n.x), inward = f_make(-n.x, -n.y);
        tahr__vec2 other_face = tahr__flat_normal(f, active[count - 1 - k]);
        if (count == 1) {
            look(s, along);
            look(s, f_make(-along.x, -along.y));
            look(s, inward);
        } else { /* the way along this face that stays behind the other one */
            look(s, f_dot(along, other_face) < 0 ? along : f_make(-along.x, -along.y));
        }
    }
}

/* Of a round body: half of everything, unless the contact is its own. */
static void at_round(seam *s, const tahr__b2_piece *other)
{
    tahr__flat_shape dot = {1, 0, {{0, 0}}};
    tahr__flat_near near;

    tahr__flat_measure(&dot, s->point, &other->flat, 0, &near);
    if (near.distance > s->weld) return;
    if (near.distance < -s->weld || f_dot(near.normal, s->normal) < 1 - 1e-4) s->nearer = 1;
}

/* Only what blocks, or a fellow one-way body, takes the place of a corner. */
static int may_hide(const tahr__surface *p, const tahr__surface *q)
{
    return !(q->flags & TAHR_BODY_SENSOR) && (!(q->flags & TAHR_BODY_ONE_WAY) || p->flags & TAHR_BODY_ONE_WAY);
}

static int is_same(const tahr__b2_piece *a, const tahr__b2_piece *b)
{
    return a->owner.id == b->owner.id && a->feature == b->feature && a->flat.count == b->flat.count &&
           a->flat.corner[0].x == b->flat.corner[0].x && a->flat.corner[0].y == b->flat.corner[0].y;
}

/* What is overlapped is hidden only by what is overlapped as deep: the way out of a large round body may end in another
 * one that is not even touched. Two that are as deep would hide each other: the lower name stays. */
static int is_as_deep(const seam *s, const tahr__b2_piece *other)
{
    tahr__flat_near near;
    int round = s->piece->flat.radius > 0 || other->flat.radius > 0;

    if (!(s->overlap < 0)) return 1;
    tahr__flat_measure(&s->probe->shape, f_make(0, 0), &other->flat, 0, &near);
    if (round && near.distance >= s->overlap - s->weld && s->piece->owner.id < other->owner.id) return 0;
    return near.distance <= s->overlap + s->weld;
}

static void take(void *user, tahr__b2_piece *other)
{
    seam *s = user;

    if (is_same(s->piece, other) || !may_hide(&s->piece->owner, &other->owner) || !is_as_deep(s, other)) return;
    if (other->flat.count > 2) {
        at_polygon(s, other);
    } else if (other->flat.radius > 0 || other->flat.count == 1) {
        at_round(s, other);
    } else {
        tahr__flat_shape dot = {1, 0, {{0, 0}}};
        tahr__flat_near near;
        tahr__flat_measure(&dot, s->point, &other->flat, 0, &near);
        if (fabs(near.distance) <= s->weld) at_segment(s, other);
    }
}

/* The line goes on past its last corner, though nothing is there (the ghost vertices of Box2D). */
static void look_at_ghosts(seam *s)
{
    const tahr__b2_piece *p = s->piece;

    if (p->ghosts & TAHR__B2_GHOST_BEFORE && f_length(f_sub(p->flat.corner[0], s->point)) <= s->weld) {
        look(s, f_sub(p->before, p->flat.corner[0]));
    }
    if (p->ghosts & TAHR__B2_GHOST_AFTER && f_length(f_sub(p->flat.corner[1], s->point)) <= s->weld) {
        look(s, f_sub(p->after, p->flat.corner[1]));
    }
}

/* In an attached world at least what Box2D's floats are apart there. */
static double weld_of(const tahr__b2_probe *probe)
{
    double size = probe->shape.radius + f_length(probe->shape.corner[0]);
    double floats = 2.4e-7 * (fabs(probe->origin.x) + fabs(probe->origin.y));
    return d_max(d_min(WELD, WELD_PART * size), probe->scene->attached ? floats : 0);
}

int tahr__b2_is_seam(const tahr__b2_probe *probe, const tahr__b2_piece *piece, const tahr__flat_near *near,
                     tahr__vec2 direction, tahr__vec2 *face)
{
    seam s = {.probe = probe, .piece = piece, .normal = near->normal, .direction = direction, .face = *face};

    s.point = near->point;
    s.weld = weld_of(probe);
    s.overlap = !near->crosses && near->distance < -s.weld ? near->distance : 0;
    if (near->part < TAHR__FLAT_CORNER && !near->crosses) return 0;
    look_at_ghosts(&s);
    if (!s.nearer) tahr__b2_each_at(probe, s.point, s.weld, take, &s);
    if (!s.nearer && piece->flat.count == 2 && piece->flat.radius == 0) *face = s.face;
    return s.nearer;
}

void tahr__b2_leave(const tahr__b2_probe *probe, const tahr__b2_piece *piece, tahr__flat_near *near)
{
    tahr__flat_near first = *near;
    unsigned closed = 0;
    tahr__vec2 face;

    if (!near->crosses || piece->flat.count < 3 || piece->owner.flags & TAHR_BODY_SENSOR) return;
    for (int i = 0; i < piece->flat.count && i < 32; i++) {
        face = near->normal;
        if (near->part >= 32 || !tahr__b2_is_seam(probe, piece, near, near->normal, &face)) return;
        closed |= 1u << near->part;
        tahr__flat_measure(&probe->shape, f_make(0, 0), &piece->flat, closed, near);
    }
    *near = first; /* walled in on every side */
}

tahr__vec2 tahr__b2_face(const tahr__b2_piece *piece, const tahr__flat_near *near, tahr__vec2 direction)
{
    const tahr__flat *f = &piece->flat;
    int corner = near->part - TAHR__FLAT_CORNER;
    tahr__vec2 a, b;

    if (f->count < 2 || (f->count == 2 && f->radius > 0)) return near->normal;
    if (near->part < TAHR__FLAT_CORNER) {
        return near->crosses && f->count == 2 ? near->normal : tahr__flat_normal(f, near->part);
    }
    if (f->count == 2) {
        a = tahr__flat_normal(f, 0);
        return f_dot(a, near->normal) >= 0 || f->one_sided ? a : f_make(-a.x, -a.y);
    }
    a = tahr__flat_normal(f, corner);
    b = tahr__flat_normal(f, corner > 0 ? corner - 1 : f->count - 1);
    if (f_dot(a, near->normal) <= 1e-9) return b;
    if (f_dot(b, near->normal) <= 1e-9) return a;
    return f_dot(b, direction) > f_dot(a, direction) ? b : a;
}

uint32_t tahr__b2_feature(const tahr__b2_piece *piece, const tahr__flat_near *near)
{
    static const uint32_t faces[4] = {2, 1, 3, 0}; /* of a box, from below to the left */
    uint32_t face;

    if (piece->flat.count < 3) return piece->feature;
    face = (uint32_t)tahr__flat_facing(&piece->flat, near->normal);
    return piece->feature + (piece->is_box ? faces[face & 3] : face);
}
