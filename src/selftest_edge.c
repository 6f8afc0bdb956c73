/* SPDX-License-Identifier: MIT
 * selftest_edge.c: cases: edges and corners with both normals, seams that are no edges, thin and degenerate things. */
#include "selftest.h"

/* Is a point on the edge (or corner) at (0, 0), as the side view shows it? */
static int is_on_edge(const tahr__lab *lab, vec3 point)
{
    vec3 off = sub(point, tahr__lab_at(lab, 0, 0));
    return fabs(dot(off, tahr__lab_toward(lab, 1, 0))) <= 2 * tahr__lab_slack(lab) &&
           fabs(dot(off, tahr__lab_up(lab))) <= 2 * tahr__lab_slack(lab);
}

/* The contact where a sweep ended on the edge. facing: of the faces there the one that faces the contact normal
 * most. */
static void edge_contact(tahr__lab *lab, const tahr_sweep *q, double fraction, vec3 contact, vec3 facing)
{
    tahr_contact c[8];
    tahr_status status;
    tahr_sweep there = *q;
    there.position = add_scaled(q->position, q->motion, fraction);
    uint32_t n = tahr__lab_touch(lab, &there, 2 * lab->margin, 0, c, 8, &status);
    tahr__lab_check(lab,
                    n >= 1 && fabs(c[0].distance - lab->margin) <= tahr__lab_slack(lab) &&
                        tahr__lab_same_direction(lab, c[0].normal, contact) &&
                        tahr__lab_same_direction(lab, c[0].surface_normal, facing) && is_on_edge(lab, c[0].point),
                    "a contact with an edge: distance, point, its normal and that of the face that faces it most",
                    "%s at %g: %u contacts, distance %.9g, normal (%.4f, %.4f, %.4f), surface (%.4f, %.4f, %.4f)",
                    lab->shape_name, lab->number, n, n ? c[0].distance : 0, n ? c[0].normal.x : 0,
                    n ? c[0].normal.y : 0, n ? c[0].normal.z : 0, n ? c[0].surface_normal.x : 0,
                    n ? c[0].surface_normal.y : 0, n ? c[0].surface_normal.z : 0);
}

/* Both normals of a hit on a convex edge or corner. */
static void edge_normals_of(tahr__lab *lab, const tahr_sweep *q, double fraction, vec3 contact, vec3 surface)
{
    tahr_hit hit;
    tahr__lab_stops(lab, q, fraction, contact, "onto an edge, beside it by");
    if (lab_goes_on(lab) && tahr__lab_ask(lab, q, &hit)) {
        tahr__lab_check(lab, tahr__lab_same_direction(lab, hit.surface_normal, surface),
                        "surface normal on an edge: of the face that opposes the motion most",
                        "%s: (%.4f, %.4f, %.4f) instead of (%.4f, %.4f, %.4f)", lab->shape_name, hit.surface_normal.x,
                        hit.surface_normal.y, hit.surface_normal.z, surface.x, surface.y, surface.z);
        tahr__lab_check(lab, is_on_edge(lab, hit.point), "the point of a hit on an edge: on it",
                        "%s: (%.9g, %.9g, %.9g)", lab->shape_name, hit.point.x, hit.point.y, hit.point.z);
    }
}

/* A round shape comes down beside the top edge of a block: the lowest ball of it stops on a circle around the edge. */
static void edge_normals(tahr__lab *lab)
{
    static const double beside[] = {0.1, 0.2, 0.3};
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_ROUND);) {
        tahr__lab_block(lab, -4, -3, 0, 0);
        for (int i = 0; i < 3 && (lab->world || tahr__lab_open(lab)); i++) {
            double a = beside[i], r = lab->shape.radius + lab->margin, h = sqrt(r * r - a * a);
            double above = lab->shape.half_height - lab->shape.radius; /* of the centre over that ball's */
            tahr_sweep q = tahr__lab_sweep(lab, a, above + h + 0.4, 0, -1);
            lab->number = a;
            edge_normals_of(lab, &q, 0.4, tahr__lab_toward(lab, a / r, h / r), tahr__lab_up(lab));
            if (lab_goes_on(lab) && lab->claims & TAHR_CAP_CONTACTS) {
                edge_contact(lab, &q, 0.4, tahr__lab_toward(lab, a / r, h / r),
                             a > h ? tahr__lab_toward(lab, 1, 0) : tahr__lab_up(lab));
            }
        }
    }
}

/* The same against the side: moving to the left, the ball stops above the edge. The side opposes that motion. */
static void edge_from_the_side(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_ROUND);) {
        double b = 0.2, r = lab->shape.radius + lab->margin, away = sqrt(r * r - b * b);
        double above = lab->shape.half_height - lab->shape.radius;
        tahr__lab_block(lab, -4, -3, 0, 0);
        if (!tahr__lab_open(lab)) {
            return;
        }
        tahr_sweep q = tahr__lab_sweep(lab, away + 0.4, above + b, -1, 0);
        lab->number = b;
        edge_normals_of(lab, &q, 0.4, tahr__lab_toward(lab, away / r, b / r), tahr__lab_toward(lab, 1, 0));
    }
}

static void vertex_normals(tahr__lab *lab)
{
    if (lab->planar) {
        tahr__lab_lacks(lab, "a third dimension");
        return;
    }
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_ROUND);) {
        double r = lab->shape.radius + lab->margin, a = 0.15, b = 0.2, h = sqrt(r * r - a * a - b * b);
        tahr__lab_block3(lab, vec(-4, -4, -3), vec(0, 0, 0));
        if (!tahr__lab_open(lab)) {
            return;
        }
        tahr_sweep q = tahr__lab_sweep(lab, a, lab->shape.half_height - lab->shape.radius + h + 0.4, 0, -1);
        q.position.y = b;
        lab->number = a;
        edge_normals_of(lab, &q, 0.4, vec(a / r, b / r, h / r), vec(0, 0, 1));
    }
}

/* Beside the edge by more than the shape is wide. */
static void passes_an_edge(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        double wide = tahr__lab_reach(lab, tahr__lab_toward(lab, -1, 0)) + lab->margin;
        tahr__lab_block(lab, -4, -3, 0, 0);
        if (!tahr__lab_open(lab)) {
            return;
        }
        tahr_sweep past = tahr__lab_sweep(lab, wide + 2 * tahr__lab_slack(lab), 1.5, 0, -3);
        tahr__lab_free(lab, &past, "down past an edge, outside the margin");
    }
}

/* An inner corner: what comes first blocks. */
static void inner_corner(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        double low = tahr__lab_reach(lab, tahr__lab_toward(lab, 0, -1)),
               wide = tahr__lab_reach(lab, tahr__lab_toward(lab, 1, 0));
        tahr__lab_block(lab, -6, -2, 2, 0);
        tahr__lab_block(lab, 2, -2, 4, 6);
        if (!tahr__lab_open(lab)) {
            return;
        }
        tahr_sweep wall = tahr__lab_sweep(lab, 1.5 - wide, low + 0.6, 1, -0.5);
        tahr_sweep floor_first = tahr__lab_sweep(lab, 1.5 - wide, low + 0.2, 1, -1);
        tahr__lab_stops(lab, &wall, 0.49, tahr__lab_toward(lab, -1, 0), "into a corner, the wall first");
        tahr__lab_stops(lab, &floor_first, 0.19, tahr__lab_up(lab), "into a corner, the floor first");
    }
}

/* Along and down a floor of pieces: what is flush is one floor. */
static void over_seams(tahr__lab *lab, double from, double to)
{
    static const double gaps[] = {0.01 + 1e-6, 0.011, 0.02};
    double low = tahr__lab_reach(lab, tahr__lab_toward(lab, 0, -1)), way = to - from;
    for (int i = 0; i < 3 && lab_goes_on(lab); i++) {
        tahr_sweep along = tahr__lab_sweep(lab, from, low + gaps[i], way, 0);
        lab->number = gaps[i];
        tahr__lab_free(lab, &along, "along over seams at");
        for (int k = 0; k < 24 && lab_goes_on(lab); k++) { /* coming down at, before and after the seams */
            double at = from + way * k / 24;
            tahr_sweep down = tahr__lab_sweep(lab, at, low + gaps[i] + 0.02, 0.5, -0.1);
            tahr__lab_stops(lab, &down, (gaps[i] + 0.01) / 0.1, tahr__lab_up(lab), "down onto seams from");
        }
    }
}

static void seams_of_blocks(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        for (int i = 0; i < 8; i++) {
            tahr__lab_block(lab, i - 4, -1, i - 3, 0);
        }
        if (!tahr__lab_open(lab)) {
            return;
        }
        over_seams(lab, -3.2, 2.6);
    }
}

/* A floor of narrow triangles and one of squares cut both ways; one mesh, so inside it nothing is an edge. */
static void seams_of_triangles(tahr__lab *lab)
{
    if (!tahr__lab_first_shape(lab, TAHR__LAB_USUAL)) {
        return;
    }
    for (int kind = 0; kind < 3 && lab_goes_on(lab); kind++) {
        static const uint32_t usual[] = {TAHR_CAP_CAPSULE, TAHR_CAP_SPHERE, TAHR_CAP_BOX};
        tahr__lab_clear(lab);
        if (!tahr__lab_take(lab, usual[kind])) {
            continue;
        }
        lab->material = TAHR__OF_MESHES;
        tahr_body_desc *mesh = tahr__lab_body(lab, TAHR_BODY_MESH);
        for (int i = 0; i < 18; i++) {
            tahr__lab_corner(lab, mesh, -4 + i / 2, i % 2 ? 3 : -3, 0);
        }
        for (uint32_t i = 0; i + 1 < 9; i++) {
            uint32_t a = 2 * i, flip = i % 2;
            tahr__lab_triangle(lab, mesh, a, a + 2, flip ? a + 1 : a + 3);
            tahr__lab_triangle(lab, mesh, flip ? a + 2 : a, a + 3, a + 1);
        }
        if (!tahr__lab_open(lab)) {
            return;
        }
        over_seams(lab, -3.2, 2.6);
    }
}

static void seams_of_a_chain(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        lab->material = TAHR__OF_CHAINS;
        tahr_body_desc *chain = tahr__lab_body(lab, TAHR_BODY_CHAIN);
        for (int i = 0; i < 9; i++) {
            tahr__lab_corner(lab, chain, 4 - i, 0, 0); /* its front is up: on the right hand of who goes to the left */
        }
        if (!tahr__lab_open(lab)) {
            return;
        }
        over_seams(lab, -3.2, 2.6);
    }
}

/* A wall of a millimetre, and a motion a hundred thousand times that. */
static void thin_wall(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        double wide = tahr__lab_reach(lab, tahr__lab_toward(lab, 1, 0));
        tahr__lab_block(lab, 0, -4, 0.001, 4);
        if (!tahr__lab_open(lab)) {
            return;
        }
        tahr_sweep right = tahr__lab_sweep(lab, -40 - wide, 0.3, 100, 0);
        tahr_sweep left = tahr__lab_sweep(lab, 40.001 + wide, 0.3, -100, 0.01);
        lab->number = 0.001;
        tahr__lab_stops(lab, &right, 0.3999, tahr__lab_toward(lab, -1, 0), "100 m at a wall as thick as");
        tahr__lab_stops(lab, &left, 0.3999, tahr__lab_toward(lab, 1, 0), "100 m at its other side");
    }
}

/* A sheet without thickness blocks from its front; from its back only with TWO_SIDED. */
static void sheet(tahr__lab *lab, uint32_t flags)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        double wide = tahr__lab_reach(lab, tahr__lab_toward(lab, 1, 0));
        lab->material = lab->planar ? TAHR__OF_CHAINS : TAHR__OF_MESHES;
        tahr__lab_plane(lab, 1, 0)->flags = flags;
        if (!tahr__lab_open(lab)) {
            return;
        }
        tahr_sweep front = tahr__lab_sweep(lab, 3 + wide, 0.3, -10, 0),
                   back = tahr__lab_sweep(lab, -3 - wide, 0.3, 10, 0);
        tahr__lab_stops(lab, &front, 0.299, tahr__lab_toward(lab, 1, 0), "at the front of a sheet");
        if (flags) {
            tahr__lab_stops(lab, &back, 0.299, tahr__lab_toward(lab, -1, 0), "at the back of a two-sided sheet");
        } else {
            tahr__lab_free(lab, &back, "through the back of a one-sided sheet");
        }
    }
}

static int has_sheets(tahr__lab *lab)
{
    if (!(lab->claims & (lab->planar ? TAHR_CAP_CHAINS : TAHR_CAP_MESH))) {
        tahr__lab_lacks(lab, lab->planar ? "TAHR_CAP_CHAINS" : "TAHR_CAP_MESH");
        return 0;
    }
    return 1;
}

static void one_sided_sheet(tahr__lab *lab)
{
    if (has_sheets(lab)) {
        sheet(lab, 0);
    }
}

static void two_sided_sheet(tahr__lab *lab)
{
    if (has_sheets(lab)) {
        sheet(lab, TAHR_BODY_TWO_SIDED);
    }
}

/* A square floor from the origin to (6, 6), and things that are none. */
static tahr_body_desc *square_floor(tahr__lab *lab)
{
    lab->material = TAHR__OF_MESHES;
    tahr_body_desc *mesh = tahr__lab_body(lab, TAHR_BODY_MESH);
    tahr__lab_corner(lab, mesh, -3, -3, 0);
    tahr__lab_corner(lab, mesh, 3, -3, 0);
    tahr__lab_corner(lab, mesh, 3, 3, 0);
    tahr__lab_corner(lab, mesh, -3, 3, 0);
    tahr__lab_triangle(lab, mesh, 0, 1, 2);
    tahr__lab_triangle(lab, mesh, 0, 2, 3);
    return mesh;
}

static void answers_like_a_floor(tahr__lab *lab)
{
    double low = tahr__lab_reach(lab, tahr__lab_toward(lab, 0, -1));
    if (!tahr__lab_open(lab)) {
        return;
    }
    for (int i = 0; i < 12; i++) {
        tahr_sweep down = tahr__lab_sweep(lab, -1.2 + 0.2 * i, low + 0.3, 0.1, -1);
        down.position.y = 0.1 * i - 0.5;
        lab->number = -1.2 + 0.2 * i;
        tahr__lab_stops(lab, &down, 0.29, tahr__lab_up(lab), "onto a floor with bad triangles at");
    }
    tahr_sweep along = tahr__lab_sweep(lab, -2, low + 0.011, 4, 0);
    tahr__lab_free(lab, &along, "along a floor with bad triangles");
}

static void degenerate_triangles(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        tahr_body_desc *mesh = square_floor(lab);
        tahr__lab_corner(lab, mesh, 0, 0, 0);
        tahr__lab_corner(lab, mesh, 1, 0, 0);
        tahr__lab_corner(lab, mesh, 1, 1e-12, 0);
        tahr__lab_triangle(lab, mesh, 4, 4, 4); /* a point */
        tahr__lab_triangle(lab, mesh, 4, 5, 4); /* a line, twice the same corner */
        tahr__lab_triangle(lab, mesh, 4, 5, 5);
        tahr__lab_triangle(lab, mesh, 4, 5, 6); /* a sliver of 1e12 to 1 */
        answers_like_a_floor(lab);
    }
}

static void duplicate_triangles(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        tahr_body_desc *mesh = square_floor(lab);
        tahr__lab_triangle(lab, mesh, 0, 1, 2);
        tahr__lab_triangle(lab, mesh, 1, 2, 0);
        answers_like_a_floor(lab);
    }
}

static const tahr__lab_case cases[] = {
    {"edge_normals", 0, edge_normals},
    {"edge_from_the_side", 0, edge_from_the_side},
    {"vertex_normals", 0, vertex_normals},
    {"passes_an_edge", 0, passes_an_edge},
    {"inner_corner", 0, inner_corner},
    {"seams_of_blocks", 0, seams_of_blocks},
    {"seams_of_triangles", TAHR_CAP_MESH, seams_of_triangles},
    {"seams_of_a_chain", TAHR_CAP_PLANAR | TAHR_CAP_CHAINS, seams_of_a_chain},
    {"thin_wall_at_high_speed", 0, thin_wall},
    {"one_sided_sheet", 0, one_sided_sheet},
    {"two_sided_sheet", 0, two_sided_sheet},
    {"degenerate_triangles", TAHR_CAP_MESH, degenerate_triangles},
    {"duplicate_triangles", TAHR_CAP_MESH, duplicate_triangles},
};

const tahr__lab_theme tahr__lab_edges = {cases, sizeof cases / sizeof cases[0]};
