/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers, values and columns of tables as text. */
#ifndef STATEMENT_OUTPUT_H
#define STATEMENT_OUTPUT_H

#include <stdio.h>

#include "scene/scene.h"
#include "statement/settings.h"
#include "text/file.h"

enum { COLUMNS = 42, COLUMN_UNIT = 100, NUMBER_TEXT = 32 };

typedef struct column {
    char *name;             /* its own */
    char unit[COLUMN_UNIT]; /* as the user asked, else SI */
    long double scale;      /* of that unit */
    bool chosen;            /* the user named the unit */
    const char *row;        /* else the unit that readers are shown it in; NULL: one that fits */
    dim d;
} column;

/* A copy of a text as the name of a column, on one line; NULL: out of memory. */
char *column_name(const char *text, size_t len);
/* In SI. False: out of memory. */
bool column_si(column *c, const char *name, dim d);
/* In text: a unit that suits `count` values, each `stride` after the last; the one asked for stays. */
void column_suit(column *c, const long double *v, size_t count, size_t stride, int digits);
/* Names that stand twice are told apart, as `x` and `x (2)`. False: out of memory. */
bool columns_distinct(column *c, size_t count);
void columns_free(column *c, size_t count);

/* %.*g, faster, and 0 for -0. */
size_t number_text(char text[NUMBER_TEXT], int digits, double v);
/* The same in a field of `width`, to the right. */
void print_number(FILE *to, int width, int digits, double v);
/* A positive number rounded up to one digit, as bounds are told. */
double round_up(double v);
/* The unit that readers are shown a column in: its scale. v: what it is to suit. */
long double column_unit(const column *c, long double v, int digits, char unit_text[COLUMN_UNIT]);
/* A value with a unit chosen for it, as text. */
void format_value(const settings *set, value v, char *buf, size_t size);
enum { COLUMN_TEXT = NUMBER_TEXT + COLUMN_UNIT };
void format_column(const column *c, int digits, long double si, char *buf, size_t size);
/* A value and its standard error; where the interval is another one, how far down and up that goes. */
typedef struct estimate {
    long double v, deviation;
    bool uneven;
    long double below, above; /* may be infinite */
} estimate;

/* `0.62 GPa +- 0.01 GPa`, or `0.62 GPa (-0.01 GPa, +inf)`: all in the unit of the value. */
enum { ESTIMATE_TEXT = 3 * (NUMBER_TEXT + COLUMN_UNIT) };
void format_estimate(const column *c, int digits, const estimate *e, char text[ESTIMATE_TEXT]);
/* The same with as many digits as reading it back takes. */
void format_exact(value v, char *buf, size_t size);
/* A text on one line, what does not show escaped: see text/characters.h. Line ends become blanks. */
void print_safe(FILE *to, const char *text, size_t len);

#endif
