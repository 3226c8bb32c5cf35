/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pages of `explain`. */
#ifndef HELP_EXPLAIN_PAGE_H
#define HELP_EXPLAIN_PAGE_H

#include "statement/answer.h"
#include "statement/shell.h"
#include "study/influence.h"

/* Who explains where to. */
typedef struct page {
    shell *sh;
    answer *out;
    bool conditioning; /* it is wanted */
    calc_error *error; /* raised: the page is not to be shown */
} page;

/* One quantity of an expression, as it stands there. */
typedef struct part {
    const quantity *q;
    bool call;
    const char *text; /* "dW(20 N)" */
    size_t len;
    size_t argument, argument_len; /* in text, of a call */
    const definition *in;          /* whose body it stands in, or NULL */
    bool whole;                    /* it is all that has been asked for */
    bool told;
} part;

/* What may be missing, unless it is because memory is out or the user has stopped it. */
bool explain_had(const page *p, bool ok, const calc_error *why);

/* ---- of a page that is begun ---- */

/* An expression and its value, in the scene as it stands; row: the unit that readers are shown it in, or
 * NULL. */
void explain_value(const page *p, const char *name, size_t len, value v, const char *row);
void explain_title(const page *p, const quantity *q);
/* What the value is good to, as a part of what. */
void explain_error(const page *p, double good, const char *of);
/* name: what is moved. */
void explain_conditioning(const page *p, const char *name, const influence_study *study);

/* ---- whole pages ---- */

/* Of a number that no formula made. */
void explain_input(const page *p, const quantity *q);
/* Of a function without an argument: no value. */
void explain_function(const page *p, const quantity *q);
/* e: the part by itself, of value v; NULL: it has none here. */
void explain_quantity(const page *p, const part *of, const expr *e, value v, const influence_study *study,
                      bool conditioning);

#endif
