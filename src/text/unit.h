/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Dimensions and units, and reading them. Force, length and time are the base dimensions of this field. */
#ifndef TEXT_UNIT_H
#define TEXT_UNIT_H

#include "text/lex.h"
#include "text/words.h"

/* Powers of newton, metre and second, of which a kilogram is N s^2/m; exponents are real, since A of a gap A
 * r^n is in m^(1-n). An angle is a number, but one that remembers its unit: where an angle is wanted, 90 is
 * not 90 deg. */
typedef struct dim {
    double N, m, rad, s;
} dim;

#define DIM_NONE ((dim){0, 0, 0, 0})
#define DIM_FORCE ((dim){1, 0, 0, 0})
#define DIM_LENGTH ((dim){0, 1, 0, 0})
#define DIM_ENERGY ((dim){1, 1, 0, 0})
#define DIM_STIFFNESS ((dim){1, -1, 0, 0})
#define DIM_ANGLE ((dim){0, 0, 1, 0})
#define DIM_TIME ((dim){0, 0, 0, 1})

static inline dim dim_product(dim a, dim b) {
    return (dim){a.N + b.N, a.m + b.m, a.rad + b.rad, a.s + b.s};
}
static inline dim dim_power(dim a, double n) {
    return (dim){a.N * n, a.m * n, a.rad * n, a.s * n};
}

/* Whether or not they are angles. */
bool dim_equal(dim a, dim b);
/* "a force", "a length", ... "a quantity in N/m^3". */
void dim_describe(dim d, char *buf, size_t size);
/* The SI unit in the notation of the language: "N/m^2" as "Pa". Empty for a number. */
void dim_unit(dim d, char *buf, size_t size);

/* A unit: value in SI = number * 10^exp10 * factor. Decimal scale is kept apart so that a literal
 * such as 0.1 um is rounded once. */
typedef struct unit {
    dim d;
    int exp10;
    long double factor;
} unit;

/* Is the word of `len` bytes a unit with or without prefix? */
bool unit_lookup(const char *word, size_t len, unit *out);
/* The unit name nearest to a word, or NULL. */
const char *unit_suggest(const char *word);

long double unit_scale(const unit *u);

/* Chooses a prefix so that |value|/scale lies in [1, 1000) after rounding to `digits`; writes the unit
 * to buf and returns the scale. */
long double unit_choose(dim d, long double value, int digits, char *buf, size_t size);

/* Names of the table, for completion and `show units`: i = 0, 1, ... until NULL. */
const char *unit_name(size_t i);
const char *unit_meaning(size_t i);
bool unit_prefixed(size_t i);

/* ---- as they are written: N/mm^2, MPa*m^0.5 ---- */

/* Is the cursor on a unit? */
bool unit_at(const lexer *lx);
/* Parses a unit expression at the cursor. */
bool unit_parse(lexer *lx, unit *out);
/* The unit of a column and nothing else, as its header has it: `in` is the inch, and a factor may stand
 * before it. */
bool unit_of_header(lexer *lx, unit *out);
/* The decimal number at the beginning of a text, in this unit: rounded once. Its length; 0: there is none. */
size_t unit_number(const char *text, size_t len, char point, const unit *u, double *out);

#endif
