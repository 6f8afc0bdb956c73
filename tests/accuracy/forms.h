/* SPDX-License-Identifier: MIT
 * forms.h: closed forms of movement, in long double: what paths, heights and times are when nothing but the law itself
 * acts. SI units, radians. test_forms.c holds each against a numerical integration that shares nothing with it. */
#ifndef TAHR_ACCURACY_FORMS_H
#define TAHR_ACCURACY_FORMS_H

#ifdef __cplusplus
extern "C" {
#endif

typedef struct form_vec {
    long double x, y, z;
} form_vec;

/* Where something is and how fast, along one line. */
typedef struct form_motion {
    long double way, speed;
} form_motion;

/* ---- Along surfaces ---- */

/* A displacement u from a plane with unit normal n: u - n min(0, n . u). */
form_vec form_along_plane(form_vec u, form_vec n);
/* Between two planes that both block it: (u . c) c along their line c. */
form_vec form_along_crease(form_vec u, form_vec n1, form_vec n2);
/* Height of the centre of a sphere of radius r above the floor that leads to a step of height h < r with its front at
 * way x = 0, while the sphere touches floor, edge or tread: r, then r's arc about the edge, then h + r. */
long double form_step_height(long double r, long double h, long double x);
/* Where it meets the edge: -sqrt(r^2 - (r - h)^2). */
long double form_step_contact(long double r, long double h);
/* The highest step that a round foot of radius r climbs as a slope of at most this angle: r (1 - cos angle); and how
 * far its axis then is off the edge: r sin angle. */
long double form_highest_slope_step(long double r, long double angle);
long double form_overhang(long double r, long double angle);
/* Going the way of a wish of speed u straight at a sphere or cylinder of radius R: the angle between the normal and the
 * direction against the wish after time t, which was angle then: tan(a / 2) grows as exp(u t / R). */
long double form_round_angle(long double angle, long double u, long double radius, long double time);

/* ---- In time ---- */

/* Thrown up at speed v against gravity g > 0. */
form_motion form_thrown(long double v, long double g, long double time);
long double form_apex_time(long double v, long double g);
long double form_apex_height(long double v, long double g);
/* When it comes back to a height h above where it was thrown (h at most the apex); negative h: below. */
long double form_landing_time(long double v, long double g, long double h);
/* Driven by an acceleration a and slowed by a drag k (1/s, > 0), from speed v. */
form_motion form_drag(long double v, long double a, long double k, long double time);
/* Braked by a constant deceleration b and a drag k (either may be 0, not both), until it stands. */
form_motion form_brake(long double v, long double b, long double k, long double time);
long double form_brake_time(long double v, long double b, long double k);
long double form_brake_way(long double v, long double b, long double k);
/* Accelerated by a up to the speed cap. v at most cap. */
form_motion form_capped(long double v, long double a, long double cap, long double time);
/* On a disc that turns by w (rad/s) about z through the origin. */
form_vec form_turntable(form_vec start, long double w, long double time);

#ifdef __cplusplus
}
#endif
#endif
