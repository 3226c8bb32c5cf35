/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers, values and columns of tables as text. Uses `scene` for dimensions and `text` for units. */
#ifndef STATEMENT_OUTPUT_H
#define STATEMENT_OUTPUT_H

#include <stdio.h>

#include "scene/scene.h"
#include "statement/settings.h"
#include "text/file.h"

enum { COLUMNS = 42, COLUMN_UNIT = 100, NUMBER_TEXT = 32 };

typedef struct column {
    char *name;             /* owned */
    char unit[COLUMN_UNIT]; /* the unit that the user asked for, else SI */
    long double scale;      /* of that unit, in SI */
    bool chosen;            /* the user asked for the unit */
    const char *row; /* else the unit for text, from the table of quantities; NULL: with a prefix that fits */
    dim d;
} column;

/* A copy of `text` on one line, as the name of a column; to be freed. NULL: out of memory. */
char *column_name(const char *text, size_t len);
/* Sets up a column in SI units. False: out of memory. */
bool column_si(column *c, const char *name, dim d);
/* Sets a unit that suits `count` values, `stride` apart; a unit that the user asked for stays. */
void column_suit(column *c, const long double *v, size_t count, size_t stride, int digits);
/* Numbers names that occur more than once: `x` and `x (2)`. False: out of memory. */
bool columns_distinct(column *c, size_t count);
void columns_free(column *c, size_t count); /* the names alone */

/* Writes v as printf's %.*g does, but faster, and -0 as 0. Returns the length. */
size_t number_text(char text[NUMBER_TEXT], int digits, double v);
/* The same to a stream, right-aligned in a field of `width`. */
void print_number(FILE *to, int width, int digits, double v);
/* A positive number rounded up to one significant digit, for error bounds. */
double round_up(double v);
/* The unit of a column in text, and its scale (returned); if no unit is given, one that suits the value v. */
long double column_unit(const column *c, long double v, int digits, char unit_text[COLUMN_UNIT]);
/* A value with a unit that suits it. */
void format_value(const settings *set, value v, char *buf, size_t size);
enum { COLUMN_TEXT = NUMBER_TEXT + COLUMN_UNIT };
/* A value (in SI) with the unit of the column. */
void format_column(const column *c, int digits, long double si, char *buf, size_t size);
/* A value with its standard error, or, if uneven, with an interval from v - below to v + above. */
typedef struct estimate {
    long double v, deviation;
    bool uneven;
    long double below, above; /* may be infinite */
} estimate;

/* `0.62 GPa +- 0.01 GPa`, or `0.62 GPa (-0.01 GPa, +inf)`: all in the unit of the value. */
enum { ESTIMATE_TEXT = 3 * (NUMBER_TEXT + COLUMN_UNIT) };
void format_estimate(const column *c, int digits, const estimate *e, char text[ESTIMATE_TEXT]);
/* A value with a unit, and as many digits as make the language read the same double back. */
void format_exact(value v, char *buf, size_t size);
/* Writes text on one line: line ends become blanks, what does not print is escaped (text/characters.h). */
void print_safe(FILE *to, const char *text, size_t len);

#endif
