/* SPDX-License-Identifier: MIT
 * float_mode.h: is the floating-point environment the one that the promised bits need? */
#ifndef TAHR_FLOAT_MODE_H
#define TAHR_FLOAT_MODE_H

/* NULL if all is well, else what is wrong ("multiplications and additions are contracted"). */
const char *tahr__float_mode_problem(void);

#endif
