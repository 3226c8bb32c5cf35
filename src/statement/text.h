/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Output of long texts: help, explanations, figures in the terminal. */
#ifndef STATEMENT_TEXT_H
#define STATEMENT_TEXT_H

#include <stdio.h>

#include "statement/shell.h"

/* WORDS: characters that do not print are escaped. ANSWERS: the same; in JSON the text already consists of
 * objects. PICTURE: with the terminal's colours. MOTION: an animation, which no pager can show. */
typedef enum text_kind { TEXT_WORDS, TEXT_ANSWERS, TEXT_PICTURE, TEXT_MOTION } text_kind;

/* A text being written: kept until text_end, if it may go to the pager or into one JSON object. */
typedef struct text_out {
    const settings *set;
    FILE *out, *to; /* the session's output; the stream to write the text to */
    text_kind kind;
    file_text kept; /* open only if `to` is not `out` */
    calc_error *error;
} text_out;
/* Begins a text on the session's output. False with the error: out of memory. */
bool text_begin(text_out *t, const shell *sh, text_kind kind, calc_error *error);
/* Shows what has been kept, if `keep`; else drops it. False with the error: out of memory. */
bool text_end(text_out *t, bool keep);

#endif
