/* SPDX-License-Identifier: MIT
 * elementary.h: the four elementary functions that the closed forms need, about 1 ulp, the same bits on every machine
 * (libm differs in the last bit from one C library to the next). */
#ifndef TAHR_ELEMENTARY_H
#define TAHR_ELEMENTARY_H

/* e^x - 1, |x| <= 700; without cancellation near 0. */
double tahr__expm1(double x);

/* ln(1 + x), x > -1; without cancellation near 0. */
double tahr__log1p(double x);

/* Sine and cosine for |x| <= 4. */
void tahr__sincos(double x, double *sine, double *cosine);

#endif
