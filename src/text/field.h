/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fields of a line of a table, and what stands in them. */
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
/* The field at *at and the place of the next; false: there is none. Quotation marks and brackets hold
 * separators; ' ' stands for blanks and tabs. */
bool field_next(char separator, const char *line, size_t len, size_t *at, field *out);
/* All of a field, with a point or, where it cannot be a separator, with a comma. */
bool field_is_number(field f, bool comma, const unit *u, double *out);
/* `1 234,5`, `-1'234'567`: three digits behind each mark, which may be any but a letter. */
bool field_has_thousands(field f);
/* What stands where there is no value. */
bool field_is_missing(field f);

/* A field of a row. A comment, with or without a number before it, is the last. */
typedef struct cell {
    enum { NUMBER, MISSING, WORD, COMMENT } is;
    field f;
    double v;
    bool ends;
} cell;

bool cell_next(char separator, const char *line, size_t len, size_t *at, const unit *u, cell *out);

#endif
