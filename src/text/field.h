/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Splitting a line of a table into fields, and classifying them. Depends on unit.h. */
#ifndef TEXT_FIELD_H
#define TEXT_FIELD_H

#include <stdbool.h>
#include <stddef.h>

#include "text/unit.h"

typedef struct field {
    const char *text;
    size_t len;
} field;

bool field_is_blank(char c);
field field_trimmed(const char *text, size_t len);
/* Cuts out the field at *at, trimmed and unquoted, and moves *at to the next; false: there is none. Quotation
 * marks and brackets hide separators; the separator ' ' stands for blanks and tabs. */
bool field_next(char separator, const char *line, size_t len, size_t *at, field *out);
/* Is the whole field a number? `comma` allows a decimal comma too. *out: the value in SI, read in unit u. */
bool field_is_number(field f, bool comma, const unit *u, double *out);
/* Is it a number with thousands separators, as `1 234,5` or `-1'234'567`: a blank, ', point, comma or any
 * character outside ASCII before each three digits? */
bool field_has_thousands(field f);
/* Is it empty, or one of the words for no value, as `nan` or `#N/A`? */
bool field_is_missing(field f);

/* A field of a row. */
typedef struct cell {
    enum { NUMBER, MISSING, WORD, COMMENT } is;
    field f;
    double v;
    bool ends; /* a comment follows the number: it is the last of its row */
} cell;

/* Reads the cell at *at and moves *at to the next; false: there is none. A number is read in unit u. */
bool cell_next(char separator, const char *line, size_t len, size_t *at, const unit *u, cell *out);

#endif
