/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of elementary functions. Uses `number`. */
#include <math.h>
#include <string.h>

#include "language/tree.h"
#include "number/real.h"

static long double real_beta(long double x, long double y) {
    long double b = x > 0 && y > 0 ? fret_beta(x, y) : 0;
    return (double)b > 0 ? b : (long double)NAN;
}

static const builtin builtins[] = {
    {"sqrt", sqrtl, NULL, DIM_HALVED, "square root; halves the dimension"},
    {"exp", expl, NULL, DIM_NUMBER, "exponential"},
    {"log", logl, NULL, DIM_NUMBER, "natural logarithm"},
    {"ln", logl, NULL, DIM_NUMBER, "natural logarithm"},
    {"log10", log10l, NULL, DIM_NUMBER, "decimal logarithm"},
    {"sin", sinl, NULL, DIM_NUMBER, "sine of an angle"},
    {"cos", cosl, NULL, DIM_NUMBER, "cosine of an angle"},
    {"tan", tanl, NULL, DIM_NUMBER, "tangent of an angle"},
    {"asin", asinl, NULL, DIM_TO_ANGLE, "arc sine"},
    {"acos", acosl, NULL, DIM_TO_ANGLE, "arc cosine"},
    {"atan", atanl, NULL, DIM_TO_ANGLE, "arc tangent"},
    {"abs", fabsl, NULL, DIM_KEPT, "magnitude; keeps the dimension"},
    {"gamma", tgammal, NULL, DIM_NUMBER, "gamma function"},
    {"min", NULL, fminl, DIM_SHARED, "the smallest of two or more"},
    {"max", NULL, fmaxl, DIM_SHARED, "the largest of two or more"},
    {"beta", NULL, real_beta, DIM_NUMBER, "beta function B(x,y), x, y > 0"},
    {"integral", NULL, NULL, DIM_RANGE, "(integral EXPR for x = LO .. HI)"},
    {"maximum", NULL, NULL, DIM_RANGE, "(maximum EXPR along cycle), (maximum EXPR for x = LO .. HI)"},
    {"minimum", NULL, NULL, DIM_RANGE, "(minimum EXPR along program), (minimum EXPR for x = LO .. HI)"},
};
enum { BUILTINS = sizeof builtins / sizeof *builtins };

const char *builtin_name(size_t i) {
    return i < BUILTINS ? builtins[i].name : i == BUILTINS ? "pi" : NULL;
}

const builtin *builtin_row(size_t i) {
    return i < BUILTINS ? &builtins[i] : NULL;
}

bool builtin_find(const char *name, size_t len, size_t *i) {
    static word_index words = {.name = builtin_name};
    return word_find(&words, name, len, i);
}

const char *builtin_summary(size_t i) {
    return i < BUILTINS ? builtins[i].summary : "3.14159...";
}

const char *name_taken(const char *name, size_t len) {
    unit u;
    size_t i;
    if (quantity_find(name, len))
        return "a quantity";
    if (unit_lookup(name, len, &u) && !dim_equal(u.d, DIM_TIME))
        return "a unit";
    if (len == 3 && !memcmp(name, "ans", 3))
        return "the last value printed";
    return !builtin_find(name, len, &i) ? NULL : builtin_row(i) ? "a function" : "a constant";
}
