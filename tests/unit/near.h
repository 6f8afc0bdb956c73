/* SPDX-License-Identifier: MIT
 * near.h: two numbers that must agree. */
#ifndef NEAR_H
#define NEAR_H

/* |a - b| <= tolerance, with both numbers in the message. */
#define assert_near(a, b, tolerance) near_assert((a), (b), (tolerance), #a " ~ " #b, __FILE__, __LINE__)
void near_assert(double a, double b, double tolerance, const char *what, const char *file, int line);

#endif
