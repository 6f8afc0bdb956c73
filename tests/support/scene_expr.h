/* SPDX-License-Identifier: MIT
 * scene_expr.h: numbers of a scene written as formulas: "sqrt(2 * 0.5 / 9.81)", "4 * cos(angle)". */
#ifndef TAHR_TEST_SCENE_EXPR_H
#define TAHR_TEST_SCENE_EXPR_H

#define SCENE_MAX_NAMES 24

typedef struct scene_name {
    char name[24];
    double value;
} scene_name;

typedef struct scene_names {
    scene_name item[SCENE_MAX_NAMES];
    int count;
} scene_names;

/* Adds a name or changes its value. Returns 0 if there are too many. */
int scene_names_set(scene_names *names, const char *name, double value);

/* Evaluates a formula of + - * / ( ) numbers, names, pi, g (9.81), and sqrt sin cos tan asin acos log abs, angles in
 * degrees. Returns 0 and an explanation in error (capacity 128) if it is none. */
int scene_expr(const char *text, const scene_names *names, double *value, char *error);

#endif
