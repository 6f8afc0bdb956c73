/* SPDX-License-Identifier: MIT
 * families_mesh.c: what triangles and their seams do to methods. */
#include "family.h"

#include <math.h>

static const double TURN = 6.283185307179586;

static tahr_vec3 at(double x, double y, double z)
{
    return (tahr_vec3){x, y, z};
}

static void quad(scene_mesh *m, oracle_random *dice, const double low[2], const double high[2])
{
    uint32_t a = scene_mesh_vertex(m, low[0], low[1], 0), b = scene_mesh_vertex(m, high[0], low[1], 0);
    uint32_t c = scene_mesh_vertex(m, high[0], high[1], 0), d = scene_mesh_vertex(m, low[0], high[1], 0);
    if (draw_one_in(dice, 2)) {
        scene_mesh_triangle(m, a, b, c);
        scene_mesh_triangle(m, a, c, d);
    } else {
        scene_mesh_triangle(m, a, b, d);
        scene_mesh_triangle(m, b, c, d);
    }
}

/* A level floor: nothing of it may be felt. */
static void walk_level(trial *t, oracle_random *dice)
{
    trial_stand(t, draw(dice, -1, 1), draw(dice, -0.5, 0.5), draw_around(dice, t->config.skin * 1.25, 0.1));
    trial_wander(t, dice, 50, draw(dice, 0, TURN), 3.2, 0);
    trial_idle(t, 30);
    t->keeps |= KEEPS_SPEED | KEEPS_GROUND;
}

/* A level floor of needles: strips down to 10 micrometres wide, or spokes around one corner. */
void make_slivers(trial *t, oracle_random *dice)
{
    scene_mesh *m = &trial_mesh(t, 0)->mesh;
    if (draw_one_in(dice, 2)) {
        uint32_t spokes = 8 + oracle_below(dice, 40), hub = scene_mesh_vertex(m, draw(dice, -0.5, 0.5), 0, 0);
        for (uint32_t i = 0; i < spokes; i++)
            scene_mesh_vertex(m, 12 * cos(TURN * i / spokes), 12 * sin(TURN * i / spokes), 0);
        for (uint32_t i = 0; i < spokes; i++)
            scene_mesh_triangle(m, hub, 1 + i, 1 + (i + 1) % spokes);
    } else {
        double wide = draw_power(dice, -5, -1), from = draw(dice, -0.5, 0.5);
        int strips = 24;
        double corners[27];
        corners[0] = -12;
        for (int i = 0; i <= strips; i++)
            corners[i + 1] = from + wide * i;
        corners[strips + 2] = 12;
        for (int i = 0; i < strips + 3; i++) {
            scene_mesh_vertex(m, corners[i], -12, 0);
            scene_mesh_vertex(m, corners[i], 12, 0);
        }
        for (uint32_t i = 0; i < (uint32_t)strips + 2; i++) {
            scene_mesh_triangle(m, 2 * i, 2 * i + 2, 2 * i + 3);
            scene_mesh_triangle(m, 2 * i, 2 * i + 3, 2 * i + 1);
        }
    }
    walk_level(t, dice);
}

/* Triangles without area, twice the same, twice with opposite winding, 10 km long: over a level floor. */
void make_degenerate(trial *t, oracle_random *dice)
{
    trial_body *b = trial_mesh(t, draw_one_in(dice, 2) ? (uint32_t)TAHR_BODY_TWO_SIDED : 0u);
    scene_mesh *m = &b->mesh;
    double size = draw_one_in(dice, 2) ? 1e4 : 12;
    uint32_t a = scene_mesh_vertex(m, -size, -size, 0), c = scene_mesh_vertex(m, size, -size, 0);
    uint32_t d = scene_mesh_vertex(m, size, size, 0), e = scene_mesh_vertex(m, -size, size, 0);
    scene_mesh_triangle(m, a, c, d);
    scene_mesh_triangle(m, a, d, e);
    for (int i = 0; i < 12; i++) {
        uint32_t p = scene_mesh_vertex(m, draw(dice, -2, 2), draw(dice, -2, 2), 0);
        uint32_t q = scene_mesh_vertex(m, draw(dice, -2, 2), draw(dice, -2, 2), 0);
        const double *u = m->vertices + 3 * (size_t)p, *v = m->vertices + 3 * (size_t)q;
        double off = draw_one_in(dice, 2) ? 0 : draw_power(dice, -13, -7);
        uint32_t r = scene_mesh_vertex(m, (u[0] + v[0]) / 2 + off, (u[1] + v[1]) / 2, 0);
        switch (oracle_below(dice, 5)) {
        case 0: scene_mesh_triangle(m, p, p, q); break;
        case 1: scene_mesh_triangle(m, p, p, p); break;
        case 2: scene_mesh_triangle(m, a, c, d); break;
        case 3: (b->desc.flags & TAHR_BODY_TWO_SIDED) ? scene_mesh_triangle(m, a, d, c) : (void)0; break;
        default: scene_mesh_triangle(m, p, q, r); break;
        }
    }
    walk_level(t, dice);
}

/* A level floor of tiles: of triangles cut either way, of boxes side by side, of a line's points. */
void make_seams(trial *t, oracle_random *dice)
{
    double cell = draw(dice, 0.2, 1.5), from = -8 + draw(dice, 0, cell);
    if (t->world == IN_PLANE && draw_one_in(dice, 2)) {
        double line[TRIAL_OUTLINE][2];
        for (int i = 0; i < 40; i++) {
            line[i][0] = -10 + 0.5 * i + (i % 39 ? draw(dice, -0.2, 0.2) : 0);
            line[i][1] = 0;
        }
        trial_profile(t, (const double(*)[2])line, 40, 0);
    } else if (draw_one_in(dice, 2)) {
        for (int i = 0; i < 32; i++)
            trial_box(t, at(-8 + 0.5 * i, 0, -1), at(0.25, 12, 1), 0);
    } else {
        scene_mesh *m = t->world == IN_SPACE ? &trial_mesh(t, 0)->mesh : NULL;
        double low[2], high[2];
        for (int i = 0; i < 16 && m; i++) {
            for (int k = 0; k < 16; k++) {
                low[0] = from + cell * i, high[0] = from + cell * (i + 1);
                low[1] = from + cell * k, high[1] = from + cell * (k + 1);
                quad(m, dice, low, high);
            }
        }
        trial_box(t, at(0, 0, -1), at(12, 12, 1), 0); /* around it, and flush below it */
    }
    walk_level(t, dice);
}

/* Rows of tiles of another length each: corners of one row lie within edges of the next. */
void make_t_junctions(trial *t, oracle_random *dice)
{
    scene_mesh *m = &trial_mesh(t, 0)->mesh;
    for (int row = 0; row < 16; row++) {
        int cells = 4 + (int)oracle_below(dice, 12);
        for (int i = 0; i < cells; i++) {
            const double low[2] = {-12 + 24.0 * i / cells, -8.0 + row};
            const double high[2] = {-12 + 24.0 * (i + 1) / cells, -7.0 + row};
            quad(m, dice, low, high);
        }
    }
    walk_level(t, dice);
}

static double sheet_promise(const trial *t, int step, const tahr_state *before, const tahr_state *now,
                            const tahr_report *report, const char **what)
{
    (void)before, (void)report;
    *what = "was stopped by the back of a one-sided sheet";
    if (step != t->first_rest - 1) return 0;
    return now->position.x > t->numbers[0] ? 0 : 2;
}

/* A sheet that blocks on one side or on both. Comes from the front: stopped. From behind: passes. */
void make_sheets(trial *t, oracle_random *dice)
{
    int behind = draw_one_in(dice, 2), both = !behind && draw_one_in(dice, 2);
    uint32_t flags = both ? (uint32_t)TAHR_BODY_TWO_SIDED : 0u;
    double x = draw(dice, 0.6, 1.2), lean = draw(dice, -0.3, 0.3);
    trial_box(t, at(0, 0, -1), at(12, 12, 1), 0);
    if (t->world == IN_SPACE) {
        const double wall[2][2] = {{x - lean, behind ? 8 : -8}, {x + lean, behind ? -8 : 8}};
        trial_body *b = trial_mesh(t, flags);
        scene_mesh_plan(&b->mesh, wall, 2, -0.5, 4);
        if (!behind && !both && draw_one_in(dice, 3)) { /* and its back as well, as triangles of their own */
            const double back[2][2] = {{x + lean, 8}, {x - lean, -8}};
            scene_mesh_plan(&b->mesh, back, 2, -0.5, 4);
        }
    } else {
        double top[2] = {x + lean, 4}, foot[2] = {x - lean, -0.5};
        const double wall[2][2] = {{behind ? top[0] : foot[0], behind ? top[1] : foot[1]},
                                   {behind ? foot[0] : top[0], behind ? foot[1] : top[1]}};
        trial_profile(t, wall, 2, flags);
    }
    trial_stand(t, 0, 0, t->config.skin * 1.25);
    if (behind)
        trial_walk(t, 60, at(1, 0, 0)); /* 3 m at least, from rest */
    else
        trial_wander(t, dice, 60, 0, 0.8, 0);
    trial_idle(t, 20);
    if (behind) {
        t->keeps &= ~(uint32_t)(KEEPS_SKIN | KEEPS_WORD | KEEPS_SAYING | KEEPS_REST | KEEPS_FLOOR);
        t->keeps |= KEEPS_PROMISE;
        t->promise = sheet_promise;
        t->numbers[0] = x + fabs(lean);
    }
}

/* Triangles any way, above a floor. */
void make_soup(trial *t, oracle_random *dice)
{
    scene_mesh *m = &trial_mesh(t, TAHR_BODY_TWO_SIDED)->mesh;
    uint32_t count = 8 + oracle_below(dice, 40);
    for (uint32_t i = 0; i < count; i++) {
        double x = draw(dice, -4, 4), y = draw(dice, -4, 4), z = draw(dice, -0.5, 2.5);
        uint32_t v[3];
        for (int k = 0; k < 3; k++)
            v[k] = scene_mesh_vertex(m, x + draw(dice, -1, 1), y + draw(dice, -1, 1), z + draw(dice, -0.6, 0.6));
        scene_mesh_triangle(m, v[0], v[1], v[2]);
    }
    trial_room(t, at(-6, -6, 0), at(6, 6, 8));
    trial_stand(t, 0, 0, 3.5);
    trial_wander(t, dice, 90, draw(dice, 0, TURN), 3.2, 20);
    trial_idle(t, 40);
    t->keeps &= ~(uint32_t)KEEPS_SAYING;
}

/* Hills of triangles, up to 60 degrees steep; from the side a jagged line. */
void make_terrain(trial *t, oracle_random *dice)
{
    double rough = draw(dice, 0.05, 0.6);
    if (t->world == IN_SPACE) {
        scene_mesh *m = &trial_mesh(t, 0)->mesh;
        for (int j = 0; j <= 16; j++) {
            for (int i = 0; i <= 16; i++)
                scene_mesh_vertex(m, 0.75 * (i - 8), 0.75 * (j - 8), draw(dice, -rough, rough));
        }
        for (uint32_t j = 0; j < 16; j++) {
            for (uint32_t i = 0; i < 16; i++) {
                uint32_t a = j * 17 + i;
                scene_mesh_triangle(m, a, a + 1, a + 18);
                scene_mesh_triangle(m, a, a + 18, a + 17);
            }
        }
    } else {
        double line[TRIAL_OUTLINE][2];
        for (int i = 0; i < 33; i++) {
            line[i][0] = 0.5 * (i - 16);
            line[i][1] = draw(dice, -rough, rough);
        }
        trial_profile(t, (const double(*)[2])line, 33, 0);
    }
    trial_room(t, at(-6, -6, -2), at(6, 6, 9));
    trial_stand(t, draw(dice, -1, 1), draw(dice, -1, 1), rough + 0.5);
    trial_wander(t, dice, 90, draw(dice, 0, TURN), 2, 30);
    trial_idle(t, 40);
    t->keeps &= ~(uint32_t)KEEPS_SAYING;
}

/* Boxes any size, on and in a floor. */
void make_blocks(trial *t, oracle_random *dice)
{
    uint32_t count = 6 + oracle_below(dice, 18);
    trial_room(t, at(-6, -6, 0), at(6, 6, 8));
    for (uint32_t i = 0; i < count; i++) {
        tahr_vec3 half = at(draw(dice, 0.1, 1.2), draw(dice, 0.1, 1.2), draw(dice, 0.1, 1));
        trial_box(t, at(draw(dice, -4, 4), draw(dice, -4, 4), draw(dice, 0, 1.5)), half, 0);
    }
    trial_stand(t, 0, 0, 3);
    trial_wander(t, dice, 90, draw(dice, 0, TURN), 2, 25);
    trial_idle(t, 40);
    t->keeps &= ~(uint32_t)KEEPS_SAYING;
}
