/* SPDX-License-Identifier: MIT
 * selftest_answer.c: cases: the form of answers: capacities, order, ties, contacts against sweeps, rays, the same bits
 * again, and what is no question at all. */
#include <string.h>

#include "answer.h"
#include "selftest.h"

static const uint8_t CANARY = 0xA5;

/* A room: floor, a wall to the right, a block to the left, a ceiling. */
static int room(tahr__lab *lab)
{
    tahr__lab_block(lab, -6, -2, 4, 0);
    tahr__lab_block(lab, 4, -2, 6, 6);
    tahr__lab_block(lab, -6, 0, -4, 1);
    tahr__lab_block(lab, -6, 3, 4, 4);
    return tahr__lab_open(lab);
}

static double low_of(const tahr__lab *lab)
{
    return tahr__lab_reach(lab, tahr__lab_toward(lab, 0, -1));
}

static double wide_of(const tahr__lab *lab)
{
    return tahr__lab_reach(lab, tahr__lab_toward(lab, 1, 0));
}

/* Which number a face of a block has is its backend's business, but the top and the left side have two. */
static void contacts_name_faces(tahr__lab *lab)
{
    tahr_contact top[8], side[8];
    tahr_status status;
    tahr_sweep on = tahr__lab_sweep(lab, 0, low_of(lab) + 0.004, 0, 0);
    tahr_sweep beside = tahr__lab_sweep(lab, -6.004 - wide_of(lab), -1 - low_of(lab), 0, 0);
    uint32_t n = tahr__lab_touch(lab, &on, 0.01, 0, top, 8, &status);
    uint32_t m = tahr__lab_touch(lab, &beside, 0.01, 0, side, 8, &status);
    tahr__lab_check(
        lab, n >= 1 && m >= 1 && top->body == 0 && side->body == 0 && (!lab->backend || top->feature != side->feature),
        "contacts: the top and the left side of body 0, two features",
        "%s: %u contacts, feature %u, and %u, feature %u", lab->shape_name, n, n ? top->feature : 0, m,
        m ? side->feature : 0);
}

static void contact_distance(tahr__lab *lab)
{
    static const double gaps[] = {0.004, 0.0001, 0.01, -0.02, 0.3};
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        if (!room(lab)) {
            return;
        }
        for (int i = 0; i < 5 && lab_goes_on(lab); i++) {
            tahr_contact c[8];
            tahr_status status;
            tahr_sweep place = tahr__lab_sweep(lab, 0, low_of(lab) + gaps[i], 0, 0);
            uint32_t n = tahr__lab_touch(lab, &place, 0.35, 0, c, 8, &status);
            tahr__lab_check(lab,
                            n >= 1 && fabs(c[0].distance - gaps[i]) <= tahr__lab_slack(lab) && c[0].body == 0 &&
                                tahr__lab_same_direction(lab, c[0].normal, tahr__lab_up(lab)) &&
                                tahr__lab_same_direction(lab, c[0].surface_normal, tahr__lab_up(lab)) &&
                                fabs(dot(c[0].point, tahr__lab_up(lab))) <= tahr__lab_slack(lab),
                            "contacts: the floor, signed distance, both normals up, point on it",
                            "%s at %g: %u contacts, distance %.9g, body %u", lab->shape_name, gaps[i], n,
                            n ? c[0].distance : 0, n ? c[0].body : TAHR_NO_BODY);
        }
        contacts_name_faces(lab);
    }
}

static void contact_margin(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        tahr_contact c[8];
        tahr_status status;
        double slack = 2 * tahr__lab_slack(lab);
        if (!room(lab)) {
            return;
        }
        tahr_sweep place = tahr__lab_sweep(lab, 0, low_of(lab) + 0.05, 0, 0);
        uint32_t outside = tahr__lab_touch(lab, &place, 0.05 - slack, 0, c, 8, &status);
        uint32_t within = tahr__lab_touch(lab, &place, 0.05 + slack, 0, c, 8, &status);
        uint32_t none = tahr__lab_touch(lab, &place, 0, 0, c, 8, &status);
        tahr__lab_check(lab, outside == 0 && within >= 1 && none == 0,
                        "contacts 0.05 m above a floor: none, some and none within less, more and 0",
                        "%s: %u, %u and %u", lab->shape_name, outside, within, none);
    }
}

/* In the corner of floor and wall both are felt, the nearer one first, each once. */
static void contact_order(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        tahr_contact c[8];
        tahr_status status, cut, nothing;
        if (!room(lab)) {
            return;
        }
        tahr_sweep place = tahr__lab_sweep(lab, 4 - wide_of(lab) - 0.004, low_of(lab) + 0.008, 0, 0);
        uint32_t n = tahr__lab_touch(lab, &place, 0.01, 0, c, 8, &status);
        int ordered = n >= 2 && status == TAHR_OK && c[0].body == 1 && c[n - 1].body == 0;
        for (uint32_t i = 1; i < n; i++) {
            ordered = ordered && c[i - 1].distance <= c[i].distance;
        }
        tahr__lab_check(lab, ordered,
                        "contacts in a corner: the wall (body 1) at 0.004, then the floor (body 0) at 0.008",
                        "%s: %u contacts, bodies %u to %u, %s", lab->shape_name, n, n > 0 ? c[0].body : 0,
                        n > 0 ? c[n - 1].body : 0, tahr_status_name(status));
        memset(c, CANARY, sizeof c);
        uint32_t one = tahr__lab_touch(lab, &place, 0.01, 0, c, 1, &cut);
        const uint8_t *beyond = (const uint8_t *)&c[1];
        tahr__lab_check(lab, one == 1 && cut == TAHR_TRUNCATED && c[0].body == 1 && beyond[0] == CANARY,
                        "with room for one: the nearest, TAHR_TRUNCATED, nothing written behind it",
                        "%s: %u contacts, body %u, %s", lab->shape_name, one, c[0].body, tahr_status_name(cut));
        memset(c, CANARY, sizeof c);
        uint32_t zero = tahr__lab_touch(lab, &place, 0.01, 0, c, 0, &nothing);
        beyond = (const uint8_t *)c;
        tahr__lab_check(lab, zero == 0 && beyond[0] == CANARY, "with room for none: none, and nothing written",
                        "%s: %u contacts", lab->shape_name, zero);
    }
}

/* Where a sweep stopped, contacts find the surface at the margin, and facing the same way. */
static void contacts_agree(tahr__lab *lab)
{
    static const double motions[][2] = {{0, -4}, {6, 0}, {-6, -1}, {0.5, 4}, {5, -3}, {-7, 2}};
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        if (!room(lab)) {
            return;
        }
        for (int i = 0; i < 6 && lab_goes_on(lab); i++) {
            tahr_hit hit;
            tahr_contact c[8];
            tahr_status status;
            tahr_sweep q = tahr__lab_sweep(lab, 0, 1.5, motions[i][0], motions[i][1]);
            if (!tahr__lab_ask(lab, &q, &hit)) {
                return;
            }
            tahr_sweep there = q;
            there.position = add_scaled(q.position, q.motion, hit.fraction);
            uint32_t n = tahr__lab_touch(lab, &there, lab->margin + 2 * tahr__lab_slack(lab), 0, c, 8, &status);
            tahr__lab_check(lab,
                            hit.blocking && n >= 1 && fabs(c[0].distance - lab->margin) <= tahr__lab_slack(lab) &&
                                tahr__lab_same_direction(lab, c[0].normal, hit.normal),
                            "contacts where a sweep stopped: at the margin, with the same normal",
                            "%s, motion %d: blocking %u, %u contacts, the first at %.9g", lab->shape_name, i,
                            hit.blocking, n, n ? c[0].distance : 0);
        }
    }
}

/* Two blocks at the same place: whoever has the lower id. */
static void tie_by_body(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        tahr_hit hit;
        tahr_contact c[8];
        tahr_status status;
        tahr__lab_block(lab, -9, -8, -8, -7); /* far away: ids must not be places in a list */
        for (int i = 0; i < 3; i++) {
            tahr__lab_block(lab, -4, -2, 4, 0);
        }
        if (!tahr__lab_open(lab)) {
            return;
        }
        tahr_sweep q = tahr__lab_sweep(lab, 0.3, low_of(lab) + 0.5, 0.1, -1), on = q;
        on.position = sub(q.position, tahr__lab_along(lab, 0, 0.495));
        if (!tahr__lab_ask(lab, &q, &hit)) {
            return;
        }
        tahr__lab_check(lab, hit.blocking && hit.body == 1, "three bodies at the same place: the lowest id, 1",
                        "%s: body %u", lab->shape_name, hit.body);
        uint32_t n = lab->claims & TAHR_CAP_CONTACTS ? tahr__lab_touch(lab, &on, 0.01, 0, c, 8, &status) : 0;
        for (uint32_t i = 1; i < n; i++) {
            tahr__lab_check(lab, c[i - 1].distance < c[i].distance || c[i - 1].body <= c[i].body,
                            "contacts at the same distance: by body", "%s: body %u before %u", lab->shape_name,
                            c[i - 1].body, c[i].body);
        }
    }
}

/* Away from the seam the triangle itself is named by all three: 10 to the right, 11 to the left.
 * Callbacks name features only if they have them. */
static void triangles_are_named(tahr__lab *lab)
{
    for (uint32_t side = 0; side < 2 && lab->backend; side++) {
        tahr_contact c[8];
        tahr_hit hit, seen = {0};
        tahr_status status;
        tahr_sweep q = tahr__lab_sweep(lab, side ? -1.5 : 1.5, low_of(lab) + 0.5, 0, -1), on = q;
        on.position = sub(q.position, tahr__lab_along(lab, 0, 0.495));
        if (!tahr__lab_ask(lab, &q, &hit)) {
            return;
        }
        uint32_t n = lab->claims & TAHR_CAP_CONTACTS ? tahr__lab_touch(lab, &on, 0.01, 0, c, 8, &status) : 0;
        int ray = lab->claims & TAHR_CAP_RAY && tahr__lab_ray(lab, q.position, tahr__lab_along(lab, 0, -3), &seen);
        uint32_t felt = n ? c[0].feature : 10 + side, met = ray ? seen.feature : 10 + side;
        lab->number = side;
        tahr__lab_check(lab, hit.feature == 10 + side && felt == 10 + side && met == 10 + side,
                        "beside the seam of triangles 10 and 11: that triangle, by sweep, contacts and ray",
                        "%s, triangle %u: sweep %u, contacts %u, ray %u", lab->shape_name, 10 + side, hit.feature, felt,
                        met);
    }
}

static void tie_by_feature(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        tahr_hit hit;
        lab->material = TAHR__OF_MESHES;
        tahr__lab_block(lab, -4, -2, 4, 0); /* the top is triangles 10 and 11 */
        if (!tahr__lab_open(lab)) {
            return;
        }
        tahr_sweep q = tahr__lab_sweep(lab, 0, low_of(lab) + 0.5, 0, -1);
        if (!tahr__lab_ask(lab, &q, &hit)) {
            return;
        }
        tahr__lab_check(lab, hit.blocking && hit.feature == 10, "on the seam of triangles 10 and 11: feature 10",
                        "%s: feature %u", lab->shape_name, hit.feature);
        triangles_are_named(lab);
    }
}

static void rays_name_faces(tahr__lab *lab)
{
    tahr_hit top, side;
    int on = tahr__lab_ray(lab, tahr__lab_at(lab, 0.3, 2), tahr__lab_along(lab, 0.2, -4), &top);
    int beside = tahr__lab_ray(lab, tahr__lab_at(lab, -8, -1), tahr__lab_along(lab, 4, 0.1), &side);
    tahr__lab_check(lab,
                    on && beside && top.body == 0 && side.body == 0 && (!lab->backend || top.feature != side.feature),
                    "rays: the top and the left side of body 0, two features", "met %d and %d, features %u and %u", on,
                    beside, on ? top.feature : 0, beside ? side.feature : 0);
}

static void ray_hits(tahr__lab *lab)
{
    tahr_hit hit;
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        static const struct {
            double u, v, mu, mv, fraction, nu, nv;
            uint32_t body;
        } rays[] = {{0.3, 2, 0.2, -4, 0.5, 0, 1, 0},
                    {0.3, 2, 0, 4, 0.25, 0, -1, 3},
                    {0, 1, 8, 0.5, 0.5, -1, 0, 1},
                    {0, 0.5, -8, 0, 0.5, 1, 0, 2}};
        if (!room(lab)) {
            return;
        }
        for (size_t i = 0; i < sizeof rays / sizeof rays[0]; i++) {
            vec3 from = tahr__lab_at(lab, rays[i].u, rays[i].v), way = tahr__lab_along(lab, rays[i].mu, rays[i].mv);
            vec3 normal = tahr__lab_toward(lab, rays[i].nu, rays[i].nv), end = add_scaled(from, way, rays[i].fraction);
            int met = tahr__lab_ray(lab, from, way, &hit);
            tahr__lab_check(lab,
                            met && fabs(hit.fraction - rays[i].fraction) * length(way) <= tahr__lab_slack(lab) &&
                                tahr__lab_same_direction(lab, hit.normal, normal) &&
                                tahr__lab_same_direction(lab, hit.surface_normal, normal) && hit.body == rays[i].body &&
                                length(sub(hit.point, end)) <= 2 * tahr__lab_slack(lab),
                            "a ray meets a face: fraction, both normals, body and point",
                            "ray %u: met %d, fraction %.9g instead of %.9g, body %u", (unsigned)i, met, hit.fraction,
                            rays[i].fraction, hit.body);
        }
        int short_of = tahr__lab_ray(lab, tahr__lab_at(lab, 0, 2), tahr__lab_along(lab, 0, -1.99), &hit);
        int away = tahr__lab_ray(lab, tahr__lab_at(lab, -5, 2), tahr__lab_along(lab, -8, 0), &hit);
        tahr__lab_check(lab, !short_of && !away, "rays that end before a face, or go away: nothing", "%d and %d",
                        short_of, away);
        rays_name_faces(lab);
    }
}

static void empty_world(tahr__lab *lab)
{
    tahr_hit hit;
    tahr_contact c[4];
    tahr_status status;
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        if (!tahr__lab_open(lab)) {
            return;
        }
        tahr_sweep q = tahr__lab_sweep(lab, 0, 0, 100, -100);
        tahr__lab_free(lab, &q, "nothing is there");
        uint32_t n = tahr__lab_touch(lab, &q, 10, 0, c, 4, &status);
        int met = tahr__lab_ray(lab, q.position, q.motion, &hit);
        tahr__lab_check(lab, n == 0 && !met, "an empty world: no contacts, no ray", "%u contacts, ray %d", n, met);
    }
}

/* Bodies, not what is never written between them: structs have no holes here, so bytes compare. */
static void all_answers(tahr__lab *lab, tahr_hit hits[12], tahr_contact contacts[8])
{
    tahr_status status;
    memset(contacts, 0, 8 * sizeof contacts[0]);
    for (int i = 0; i < 12; i++) {
        tahr_sweep q = tahr__lab_sweep(lab, 0.1 * i, 1.2 + 0.03 * i, i % 3 - 1.3, 0.4 - 0.3 * i);
        tahr__lab_ask(lab, &q, &hits[i]);
    }
    tahr_sweep corner = tahr__lab_sweep(lab, 4 - wide_of(lab) - 0.004, low_of(lab) + 0.008, 0, 0);
    tahr__lab_touch(lab, &corner, 0.05, 0, contacts, 8, &status);
}

/* variant 0: the same once more; 1: with a cache; 2: with a cache and an announcement. */
static void same_bits(tahr__lab *lab, int variant)
{
    tahr_hit first[12], second[12];
    tahr_contact near[8], again[8];
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        if (!room(lab)) {
            return;
        }
        const tahr_backend *backend = lab->world->backend;
        if ((variant > 0 && !lab->cache) || (variant > 1 && !backend->prepare)) {
            tahr__lab_clear(lab);
            lab->checks = 0;
            tahr__lab_lacks(lab, variant > 1 ? "the slot prepare" : "the slot cache_size");
            return;
        }
        all_answers(lab, first, near);
        lab->context.cache = variant > 0 ? lab->cache : NULL;
        if (variant > 1) {
            tahr_prepare announcement = {
                .position = tahr__lab_at(lab, 0, 1), .up = tahr__lab_up(lab), .mask = 0xFFFFFFFFu};
            announcement.bounds.min = vec(-3, -3, -3);
            announcement.bounds.max = vec(3, 3, 3);
            tahr_status status = backend->prepare(lab->world->self, &lab->context, &announcement);
            tahr__lab_check(lab, status >= 0, "prepare: ok", "%s", tahr_status_name(status));
        }
        for (int i = 0; i < 2; i++) { /* what a cache remembers counts from the second time */
            all_answers(lab, second, again);
        }
        lab->context.cache = NULL;
        int hits_differ = memcmp(first, second, sizeof first) != 0,
            contacts_differ = memcmp(near, again, sizeof near) != 0;
        tahr__lab_check(lab, !hits_differ && !contacts_differ,
                        "the same questions again, with other questions between: the same bits",
                        "%s: hits differ %d, contacts differ %d", lab->shape_name, hits_differ, contacts_differ);
    }
}

static void same_bits_again(tahr__lab *lab)
{
    same_bits(lab, 0);
}

static void cache_changes_nothing(tahr__lab *lab)
{
    same_bits(lab, 1);
}

static void prepare_changes_nothing(tahr__lab *lab)
{
    same_bits(lab, 2);
}

/* The same of contacts and rays. */
static void nan_contacts_and_rays(tahr__lab *lab)
{
    const tahr_backend *backend = lab->world->backend;
    for (int i = 0; i < 4 && lab_goes_on(lab); i++) {
        tahr_contact contact[2];
        tahr_hit hit[2];
        uint32_t contacts = 77, rays = 77;
        tahr_contact_query place = {.shape = lab->shape,
                                    .position = tahr__lab_at(lab, 0, 1.5),
                                    .up = tahr__lab_up(lab),
                                    .orientation = tahr__lab_upright(lab),
                                    .margin = 1,
                                    .mask = 0xFFFFFFFFu,
                                    .ignore_body = TAHR_NO_BODY};
        tahr_ray ray = {tahr__lab_at(lab, 0, 1.5), tahr__lab_along(lab, 0, -3), 0xFFFFFFFFu, TAHR_NO_BODY};
        tahr_query_context context = {0};
        double *in_place[] = {&place.position.x, &place.margin, &place.shape.half_height, &place.position.y};
        double *in_ray[] = {&ray.origin.x, &ray.motion.x, &ray.motion.y, &ray.origin.y};
        *in_place[i] = *in_ray[i] = i == 3 ? INFINITY : NAN;
        tahr_status felt = tahr_world_contacts(lab->world, &place, contact, 1, &contacts);
        tahr_status seen = tahr_world_ray(lab->world, &ray, hit, &rays);
        tahr__lab_check(lab, felt == TAHR_E_ARGUMENT && seen == TAHR_E_ARGUMENT && contacts == 77 && rays == 77,
                        "contacts and a ray that are no numbers: argument", "%s, field %d: %s and %s", lab->shape_name,
                        i, tahr_status_name(felt), tahr_status_name(seen));
        contacts = rays = 0;
        memset(contact, CANARY, sizeof contact);
        memset(hit, CANARY, sizeof hit);
        felt = backend->contacts(lab->world->self, &context, &place, contact, 1, &contacts);
        seen = backend->ray(lab->world->self, &context, &ray, hit, &rays);
        const uint8_t *beyond = (const uint8_t *)&contact[1], *behind = (const uint8_t *)&hit[1];
        tahr__lab_check(
            lab, (felt < 0 || contacts <= 1) && (seen < 0 || rays <= 1) && beyond[0] == CANARY && behind[0] == CANARY,
            "the slots contacts and ray come back: refused, or at most one answer",
            "%s, field %d: %s with %u, %s with %u", lab->shape_name, i, tahr_status_name(felt), contacts,
            tahr_status_name(seen), rays);
    }
}

/* The library refuses such questions before a backend sees them; one that is asked all the same comes back. */
static void nan_input(tahr__lab *lab)
{
    const double nan = NAN, infinite = INFINITY;
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        if (!room(lab)) {
            return;
        }
        for (int i = 0; i < 5 && lab_goes_on(lab); i++) {
            tahr_hit hit[2];
            uint32_t count = 77;
            tahr_sweep q = tahr__lab_sweep(lab, 0, 1.5, 0, -3);
            tahr_query_context context = {0};
            double *fields[] = {&q.position.x, &q.motion.y, &q.margin, &q.motion.x, &q.shape.half_height};
            *fields[i] = i == 3 ? infinite : nan;
            tahr_status status = tahr_world_sweep(lab->world, &q, hit, 1, &count);
            tahr__lab_check(lab, status == TAHR_E_ARGUMENT && count == 77, "a question that is no number: argument",
                            "%s, field %d: %s", lab->shape_name, i, tahr_status_name(status));
            count = 0;
            memset(hit, CANARY, sizeof hit);
            status = lab->world->backend->sweep(lab->world->self, &context, &q, hit, 1, &count);
            const uint8_t *beyond = (const uint8_t *)&hit[1];
            tahr__lab_check(lab, (status < 0 || count <= 1) && beyond[0] == CANARY,
                            "the slot itself comes back: refused, or at most one answer",
                            "%s, field %d: %s, %u answers", lab->shape_name, i, tahr_status_name(status), count);
        }
        nan_contacts_and_rays(lab);
    }
}

/* The slot's own normals, before the library makes them exact. */
static void unit_normals(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        if (!room(lab)) {
            return;
        }
        for (int i = 0; i < 16 && lab_goes_on(lab); i++) {
            tahr_hit hit[1];
            uint32_t count = 0;
            tahr_sweep q = tahr__lab_sweep(lab, -3 + 0.4 * i, 1.5, 5 - 0.7 * i, i % 2 ? 3 : -3);
            q.margin = 0; /* who does not know margins is asked for none */
            memset(hit, 0, sizeof hit);
            tahr_status status = lab->world->backend->sweep(lab->world->self, &lab->context, &q, hit, 1, &count);
            double n = count ? length(hit->normal) : 1, s = count ? length(hit->surface_normal) : 1;
            tahr__lab_check(lab,
                            status >= 0 && fabs(n - 1) <= 1e-3 && fabs(s - 1) <= 1e-3 &&
                                (!count || (hit->fraction >= 0 && hit->fraction <= 1)) &&
                                (!count || hit->start_overlap || dot(hit->normal, q.motion) < 0),
                            "unit normals against the motion, fraction within 0 and 1",
                            "%s: lengths %.9g and %.9g, fraction %.9g", lab->shape_name, n, s, hit->fraction);
        }
    }
}

static void out_of_plane(tahr__lab *lab)
{
    for (uint32_t at = 0; tahr__lab_next(lab, &at, TAHR__LAB_USUAL);) {
        tahr_hit hit;
        tahr_query_context context = {0};
        uint32_t count = 0;
        if (!room(lab)) {
            return;
        }
        tahr_sweep q = tahr__lab_sweep(lab, 0, 1.5, 0, -3), deep = q, lying = q;
        deep.motion.z = 0.5;
        lying.up = vec(0, 0, 1);
        lying.orientation = (tahr_quat){0, 0, 0, 1};
        tahr_status motion = lab->world->backend->sweep(lab->world->self, &context, &deep, &hit, 1, &count);
        tahr_status up = lab->world->backend->sweep(lab->world->self, &context, &lying, &hit, 1, &count);
        tahr__lab_check(lab, motion == TAHR_E_UNSUPPORTED && up == TAHR_E_UNSUPPORTED,
                        "motion out of the plane, and up: unsupported", "%s: %s and %s", lab->shape_name,
                        tahr_status_name(motion), tahr_status_name(up));
        q.position.z = 3.5;
        if (tahr__lab_ask(lab, &q, &hit)) {
            tahr__lab_check(lab, hit.blocking && hit.normal.z == 0 && hit.surface_normal.z == 0 && hit.point.z == 3.5,
                            "z is handed back: normals without, point at 3.5", "%s: normal z %.9g, point z %.9g",
                            lab->shape_name, hit.normal.z, hit.point.z);
        }
    }
}

static const tahr__lab_case cases[] = {
    {"contact_distance", TAHR_CAP_CONTACTS, contact_distance},
    {"contact_margin", TAHR_CAP_CONTACTS, contact_margin},
    {"contact_order_and_capacity", TAHR_CAP_CONTACTS, contact_order},
    {"contacts_agree_with_sweeps", TAHR_CAP_CONTACTS, contacts_agree},
    {"tie_by_body", 0, tie_by_body},
    {"tie_by_feature", TAHR_CAP_MESH, tie_by_feature},
    {"ray", TAHR_CAP_RAY, ray_hits},
    {"unit_normals_against_the_motion", 0, unit_normals},
    {"empty_world", 0, empty_world},
    {"same_question_same_bits", 0, same_bits_again},
    {"cache_changes_no_bit", 0, cache_changes_nothing},
    {"prepare_changes_no_bit", 0, prepare_changes_nothing},
    {"nan_input", 0, nan_input},
    {"out_of_plane_is_refused", TAHR_CAP_PLANAR, out_of_plane},
};

const tahr__lab_theme tahr__lab_answers = {cases, sizeof cases / sizeof cases[0]};
