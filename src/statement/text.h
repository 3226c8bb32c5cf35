/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text that is no table: help, explanations, figures. */
#ifndef STATEMENT_TEXT_H
#define STATEMENT_TEXT_H

#include <stdio.h>

#include "statement/shell.h"

/* Text of words, in which what does not show is escaped; answers, likewise, which are objects for programs
 * already; or a picture, with the colours of a terminal; or pictures that move, which no pager can show. */
typedef enum text_kind { TEXT_WORDS, TEXT_ANSWERS, TEXT_PICTURE, TEXT_MOTION } text_kind;

/* Text on its way out: as it is, as one object for programs, or at a terminal by the pager. */
typedef struct text_out {
    const settings *set;
    FILE *out, *to; /* write to `to` */
    text_kind kind;
    file_text kept; /* where it does not go out at once */
    calc_error *error;
} text_out;
/* On the session's output. False with the error: out of memory. */
bool text_begin(text_out *t, const shell *sh, text_kind kind, calc_error *error);
/* keep: else what has been written is dropped, where it is not out yet. False likewise. */
bool text_end(text_out *t, bool keep);

#endif
