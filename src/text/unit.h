/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Dimensions and units, and parsing them. Force, length and time are basic. Depends on text/lex. */
#ifndef TEXT_UNIT_H
#define TEXT_UNIT_H

#include "text/lex.h"
#include "text/words.h"

/* Exponents of newton, metre, radian and second; a kilogram is N s^2/m. They are real, since the coefficient
 * A of a gap A r^n has the unit m^(1-n). Expressions treat an angle as a number, but rad is kept: where an
 * angle is expected, a plain 90 is not 90 deg. */
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

/* Are the dimensions equal, rad not compared? */
bool dim_equal(dim a, dim b);
/* "a force", "a length", ... "a quantity in N/m^3". */
void dim_describe(dim d, char *buf, size_t size);
/* The SI unit in the notation of the language, as "Pa" or "N*s/m"; empty for a number. */
void dim_unit(dim d, char *buf, size_t size);

/* value in SI = number * 10^exp10 * factor: exp10 apart, so that a literal such as 0.1 um is rounded once. */
typedef struct unit {
    dim d;
    int exp10;
    long double factor;
} unit;

/* Looks up the word of `len` bytes as a unit with or without prefix; false: it is none. */
bool unit_lookup(const char *word, size_t len, unit *out);
/* The unit name nearest to a word, or NULL. */
const char *unit_suggest(const char *word);

/* 10^exp10 * factor. */
long double unit_scale(const unit *u);

/* Chooses the prefix for which |value|/scale lies in [1, 1000) after rounding to `digits`; writes the unit
 * to buf and returns the scale. An angle is in degrees. */
long double unit_choose(dim d, long double value, int digits, char *buf, size_t size);

/* The rows of the table for completion and `show units`: name(i) for i = 0, 1, ... until NULL. */
const char *unit_name(size_t i);
const char *unit_meaning(size_t i);
bool unit_prefixed(size_t i);
const char *unit_prefix(size_t i); /* the first: none; NULL after the last */

/* ---- parsing unit expressions: N/mm^2, MPa*m^0.5 ---- */

/* Is the cursor on a unit? */
bool unit_at(const lexer *lx);
/* Parses a unit expression at the cursor; false with an error. */
bool unit_parse(lexer *lx, unit *out);
/* Parses the whole text as the unit of a column: `in` is the inch, and a factor may stand before. */
bool unit_of_header(lexer *lx, unit *out);
/* Reads the decimal number in unit u at the beginning of a text; *out in SI, rounded once if u->factor is 1.
 * Returns the length; 0: there is no number. */
size_t unit_number(const char *text, size_t len, char point, const unit *u, double *out);

#endif
