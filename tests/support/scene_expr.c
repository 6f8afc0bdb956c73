/* SPDX-License-Identifier: MIT
 * scene_expr.c: a recursive-descent reader of formulas. */
#include "scene_expr.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct reader {
    const char *at;
    const scene_names *names;
    const char *wrong; /* NULL while all is well */
} reader;

static const double DEGREE = 0.017453292519943295;

int scene_names_set(scene_names *names, const char *name, double value)
{
    int i = 0;
    while (i < names->count && strcmp(names->item[i].name, name) != 0) {
        i++;
    }
    if (i == SCENE_MAX_NAMES || strlen(name) >= sizeof names->item[i].name) {
        return 0;
    }
    snprintf(names->item[i].name, sizeof names->item[i].name, "%s", name);
    names->item[i].value = value;
    names->count = i == names->count ? i + 1 : names->count;
    return 1;
}

static double sum(reader *r);

static int take(reader *r, char c)
{
    while (isspace((unsigned char)*r->at)) {
        r->at++;
    }
    if (*r->at != c) {
        return 0;
    }
    r->at++;
    return 1;
}

static double apply(reader *r, const char *name, double x)
{
    if (strcmp(name, "sqrt") == 0) return sqrt(x);
    if (strcmp(name, "sin") == 0) return sin(x * DEGREE);
    if (strcmp(name, "cos") == 0) return cos(x * DEGREE);
    if (strcmp(name, "tan") == 0) return tan(x * DEGREE);
    if (strcmp(name, "asin") == 0) return asin(x) / DEGREE;
    if (strcmp(name, "acos") == 0) return acos(x) / DEGREE;
    if (strcmp(name, "log") == 0) return log(x);
    if (strcmp(name, "exp") == 0) return exp(x);
    if (strcmp(name, "abs") == 0) return fabs(x);
    if (strcmp(name, "floor") == 0) return floor(x);
    if (strcmp(name, "ramp") == 0) return fmax(x, 0);
    if (strcmp(name, "step") == 0) return x >= -1e-9 ? 1 : 0; /* also of times that are sums */
    r->wrong = "unknown function";
    return 0;
}

static double named(reader *r)
{
    char name[24];
    size_t n = 0;
    while ((isalnum((unsigned char)*r->at) || *r->at == '_') && n + 1 < sizeof name) {
        name[n++] = *r->at++;
    }
    name[n] = 0;
    if (take(r, '(')) {
        double x = sum(r);
        if (!take(r, ')')) {
            r->wrong = "missing )";
        }
        return apply(r, name, x);
    }
    for (int i = 0; i < r->names->count; i++) {
        if (strcmp(r->names->item[i].name, name) == 0) {
            return r->names->item[i].value;
        }
    }
    if (strcmp(name, "pi") == 0) return 180 * DEGREE;
    if (strcmp(name, "g") == 0) return 9.81;
    r->wrong = "unknown name";
    return 0;
}

static double factor(reader *r)
{
    if (take(r, '-')) {
        return -factor(r);
    }
    if (take(r, '(')) {
        double x = sum(r);
        if (!take(r, ')')) {
            r->wrong = "missing )";
        }
        return x;
    }
    if (isalpha((unsigned char)*r->at)) {
        return named(r);
    }
    char *end;
    double x = strtod(r->at, &end);
    if (end == r->at) {
        r->wrong = "a number was expected";
    }
    r->at = end;
    return x;
}

static double product(reader *r)
{
    double x = factor(r);
    while (!r->wrong) {
        if (take(r, '*')) {
            x *= factor(r);
        } else if (take(r, '/')) {
            x /= factor(r);
        } else {
            break;
        }
    }
    return x;
}

static double sum(reader *r)
{
    double x = product(r);
    while (!r->wrong) {
        if (take(r, '+')) {
            x += product(r);
        } else if (take(r, '-')) {
            x -= product(r);
        } else {
            break;
        }
    }
    return x;
}

int scene_expr(const char *text, const scene_names *names, double *value, char *error)
{
    reader r = {text, names, NULL};
    double x = sum(&r);
    take(&r, ' ');
    if (!r.wrong && *r.at) {
        r.wrong = "trailing text";
    }
    if (!r.wrong && !isfinite(x)) {
        r.wrong = "not finite";
    }
    if (r.wrong) {
        snprintf(error, 128, "formula \"%.60s\": %s", text, r.wrong);
        return 0;
    }
    *value = x;
    return 1;
}
