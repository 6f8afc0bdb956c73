/* SPDX-License-Identifier: MIT
 * make_slide.c: makes the stored truth of slides, in quad precision.
 *
 *   gcc -std=gnu11 -O2 -ffp-contract=off tests/accuracy/make_slide.c -lm -o make_slide
 *   ./make_slide tests/accuracy/truth
 *
 * Two methods that share only vector arithmetic: slide_exact.h goes from event to event in closed forms; slide_catch.h
 * takes many small steps, each to the nearest free place, extrapolated to none. The second starts every piece where the
 * first did, so that no step straddles an event, and must end where the first did; all pieces together may differ by
 * 1e-9 m, or the program fails and names the scene. Inputs are doubles and are taken as exact. Deterministic. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "slide_exact.h"
#include "slide_scene.h"

/* m: what is stored may be off the exact path between two knots. */
static const double KNOT_ERROR = 1e-10;

/* s: pieces that only find out which of two features holds are not stored; nothing moves 1e-8 m in them. */
static const double TOO_SHORT = 1e-9;

typedef struct {
    real time;
    vec position, velocity;
} knot;

enum { MAX_KNOTS = 8192 };

static knot knots[MAX_KNOTS];
static int knot_count;
static obstacle things;
static piece pieces[MAX_PIECES];
static int piece_count;

static void grow_scene(const slide_scene *s)
{
    core k = core_of(&s->character);

    things.count = 0;
    things.rho = (real)s->character.radius + s->character.margin;
    for (int b = 0; b < s->body_count; b++) {
        for (int i = 0; i < s->bodies[b].triangle_count; i++) {
            patch patches[MAX_PATCHES];
            triangle t = triangle_of(&s->bodies[b], i);
            int count = grow_triangle(patches, &k, &t);
            for (int j = 0; j < count; j++)
                add_patch(&things, &patches[j]);
        }
    }
}

static void add_knot(real time, vec position, vec velocity)
{
    if (knot_count == MAX_KNOTS) {
        fprintf(stderr, "make_slide: too many knots\n");
        exit(1);
    }
    knots[knot_count++] = (knot){time, position, velocity};
}

/* The cubic in the middle of two knots. */
static vec middle_of(vec p, vec q, vec v, vec w, real h)
{
    return vadd(vmul(vadd(p, q), (real)0.5), vmul(vsub(v, w), h / 8));
}

static void add_round(const piece *p, real from, real began, real end)
{
    real h = end - began;
    vec a = piece_at(p, began), b = piece_at(p, end);
    vec cubic = middle_of(a, b, piece_velocity(p, began), piece_velocity(p, end), h);
    vec off = vsub(cubic, piece_at(p, began + h / 2));

    if (vdot(off, off) > (real)KNOT_ERROR * KNOT_ERROR) {
        add_round(p, from, began, began + h / 2);
        add_round(p, from, began + h / 2, end);
        return;
    }
    add_knot(from + end, b, piece_velocity(p, end));
}

static void make_knots(void)
{
    real time = 0;
    int straight = 0;

    knot_count = 0;
    for (int i = 0; i < piece_count; i++) {
        const piece *p = &pieces[i];
        if (p->duration < TOO_SHORT) {
            time += p->duration;
            continue;
        }
        knot *last = knot_count > 0 ? &knots[knot_count - 1] : NULL;
        vec v = piece_velocity(p, 0), bend = last ? vsub(v, last->velocity) : v;
        int goes_on = last && vdot(bend, bend) < (real)1e-26;
        if (goes_on && p->kind == STRAIGHT && straight && knot_count > 1)
            knot_count--; /* over a seam, or an event that was none */
        else if (!goes_on)
            add_knot(time, p->start, v);
        if (p->kind == STRAIGHT)
            add_knot(time + p->duration, piece_at(p, p->duration), p->velocity);
        else
            add_round(p, time, 0, p->duration);
        straight = p->kind == STRAIGHT;
        time += p->duration;
    }
}

/* The second method, piece by piece. Returns the sum of what they differ by, m. */
static real verify(const slide_scene *s)
{
    catch_scene c = {s->bodies, s->body_count, core_of(&s->character), things.rho};
    real sum = 0;

    c.shape.centre = (vec){0, 0, 0};
    for (int i = 0; i < piece_count; i++) {
        const piece *p = &pieces[i];
        real doubt;
        vec there = catch_to(&c, p->start, wide(s->u), p->duration, 8, &doubt);
        if (doubt > (real)1e-12) there = catch_to(&c, p->start, wide(s->u), p->duration, 32, &doubt);
        vec off = vsub(there, piece_at(p, p->duration));
        sum += root(vdot(off, off)) + doubt;
    }
    return sum;
}

static vec exactly_at(real time)
{
    int i = 0;

    while (i + 1 < piece_count && time > pieces[i].duration)
        time -= pieces[i++].duration;
    return piece_at(&pieces[i], time);
}

/* What the catching-up scheme itself is off, at most, with steps of 1/64 s from the start on: the yardstick for whoever
 * steps as coarsely. */
static double catch_error(const slide_scene *s)
{
    catch_scene c = {s->bodies, s->body_count, core_of(&s->character), things.rho};
    vec x = wide(s->character.position);
    real worst = 0;

    c.shape.centre = (vec){0, 0, 0};
    for (int i = 1; i <= (int)(s->duration * 64 + 0.5); i++) {
        x = catch_up(&c, x, vmul(wide(s->u), (real)1 / 64));
        vec off = vsub(x, exactly_at((real)i / 64));
        if (vdot(off, off) > worst) worst = vdot(off, off);
    }
    return (double)root(worst);
}

static void put(FILE *out, vec v)
{
    fprintf(out, " %a %a %a", (double)v.x, (double)v.y, (double)v.z);
}

static void put_bodies(FILE *out, const slide_scene *s)
{
    for (int b = 0; b < s->body_count; b++) {
        const mesh *m = &s->bodies[b];
        fprintf(out, "%s %d %d", m->solid ? "s" : "m", m->vertex_count, m->triangle_count);
        for (int i = 0; i < m->vertex_count; i++)
            put(out, wide(m->vertices[i]));
        for (int i = 0; i < m->triangle_count; i++)
            fprintf(out, " %d %d %d", m->triangles[i][0], m->triangles[i][1], m->triangles[i][2]);
        fputc('\n', out);
    }
}

static void put_path(FILE *out, const slide_scene *s, double differ)
{
    const query *q = &s->character;
    int curved = 0;

    for (int i = 0; i < piece_count; i++)
        curved |= pieces[i].kind == ROUND && pieces[i].duration >= TOO_SHORT;
    fprintf(out, "p %d %a %a %a %a", q->type, q->radius, q->half_height, q->half_x, q->half_y);
    put(out, wide(q->up));
    put(out, wide(s->u));
    fprintf(out, " %a %a %d %.1e %.3e\n", q->margin, s->duration, curved, differ, catch_error(s));
    for (int i = 0; i < knot_count; i++) {
        fprintf(out, "k %a", (double)knots[i].time);
        put(out, knots[i].position);
        put(out, knots[i].velocity);
        fputc('\n', out);
    }
}

static int starts_free(const slide_scene *s)
{
    vec x = wide(s->character.position);
    real rho = things.rho + (real)0.01;

    for (int i = 0; i < things.count; i++)
        if (patch_distance_squared(x, &things.patches[i]) < rho * rho) return 0;
    return 1;
}

static void solve(slide_scene *s, FILE *out, double margin)
{
    const char *why = "starts in something";

    s->character.margin = margin;
    grow_scene(s);
    piece_count =
        starts_free(s) ? slide_exactly(pieces, &things, wide(s->character.position), wide(s->u), s->duration, &why) : 0;
    if (piece_count == 0) {
        fprintf(stderr, "make_slide: %s, margin %g: %s\n", s->name, margin, why);
        exit(1);
    }
    make_knots();
    double differ = (double)verify(s);
    printf("%-20s margin %-5g %3d pieces %5d knots, methods differ by %.1e m\n", s->name, margin, piece_count,
           knot_count, differ);
    fflush(stdout);
    if (!(differ < 1e-9)) {
        fprintf(stderr, "make_slide: %s, margin %g: the two methods differ by %g m\n", s->name, margin, differ);
        exit(1);
    }
    put_path(out, s, differ);
}

static FILE *open_file(const char *folder)
{
    char path[1024];
    FILE *out;

    snprintf(path, sizeof path, "%s/slides.txt", folder);
    out = fopen(path, "w");
    if (!out) {
        perror(path);
        exit(1);
    }
    fputs("# Slides in quad precision. Made by tests/accuracy/make_slide.c:\n"
          "#   gcc -std=gnu11 -O2 -ffp-contract=off tests/accuracy/make_slide.c -lm -o make_slide; ./make_slide "
          "tests/accuracy/truth\n"
          "# w: a scene and its name; m, s: its bodies, as in the files of sweeps\n"
          "# p: a path in it: shape radius half_height half_x half_y, up, the velocity wanted, the distance kept from\n"
          "#    everything, duration, 1 if a part of it is curved, m by which the two methods differ, m by which the\n"
          "#    catching-up scheme with steps of 1/64 s is off at most\n"
          "# k: time, position, velocity: knots of it, a cubic between two of them; two of one time where it bends\n",
          out);
    return out;
}

static void make(FILE *out, slide_scene *s)
{
    fprintf(out, "w %s\n", s->name);
    put_bodies(out, s);
    if (s->character.type != 3) solve(s, out, 0); /* a bare box has corners without normals */
    solve(s, out, 0x1p-7);
}

/* Only what is met at all is worth keeping. */
static void make_random(FILE *out)
{
    static slide_scene s;
    int made = 0;

    seed = 77;
    while (made < 16) {
        uint64_t began = seed;
        polyhedra(&s, made % 2 ? CAPSULE : SPHERE, made);
        s.character.margin = 0x1p-7;
        grow_scene(&s);
        if (!starts_free(&s)) continue;
        const char *why;
        int count = slide_exactly(pieces, &things, wide(s.character.position), wide(s.u), s.duration, &why);
        s.character.margin = 0;
        grow_scene(&s);
        if (count < 6 || slide_exactly(pieces, &things, wide(s.character.position), wide(s.u), s.duration, &why) < 6)
            continue;
        printf("seed %llu: ", (unsigned long long)began);
        make(out, &s);
        made++;
    }
}

int main(int count, char **arguments)
{
    static slide_scene s;
    static void (*const scenes[])(slide_scene *, int) = {plane, crease, gutter, three_planes, acute,
                                                         seams, edge,   step,   corner_point, stair};
    static const double angles[] = {8, 12, 30, 90};
    FILE *out = open_file(count > 1 ? arguments[1] : ".");

    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        for (int kind = SPHERE; kind <= BOX; kind++) {
            if (kind == CAPSULE_TILTED || (kind == BOX && i > 4)) continue;
            scenes[i](&s, kind);
            make(out, &s);
        }
    }
    for (size_t i = 0; i < sizeof angles / sizeof *angles; i++) {
        for (int along = 0; along < 2; along++) {
            wedge(&s, SPHERE, angles[i], along ? -2 : 0);
            make(out, &s);
            wedge(&s, CAPSULE, angles[i], along ? -2 : 0);
            make(out, &s);
        }
    }
    make_random(out);
    fclose(out);
    return 0;
}
