/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The destination of a table: the session's output, or a file whose name extension chooses the form. */
#ifndef STATEMENT_TARGET_H
#define STATEMENT_TARGET_H

#include "statement/reader.h"
#include "text/file.h"

typedef struct target {
    FILE *to;
    int format;    /* output_format */
    bool blocks;   /* blank lines between curves */
    file_out file; /* not open: the session's output */
    span name;     /* place of the file name in the statement */
    bool shared;   /* a share of its rows is run (--part) */
} target;

/* Opens the file of `to FILE`, or takes the session's output if the statement has no such clause. */
bool target_open(shell *sh, const lexer *lx, parsed *all, target *t);
/* Called before the first of `rows` rows: those with *from <= index < *to are to be written. That is all
 * rows, unless a share of them is run (--part). False with an error. */
bool target_share(shell *sh, target *t, size_t rows, size_t *from, size_t *to, calc_error *error);
/* Does another share of the run write the table's header? */
static inline bool target_is_continued(const shell *sh, const target *t) {
    return t->shared && sh->share.number > 1;
}
/* Opens the file named there, whatever its name extension; the format stays. */
bool target_file(const lexer *lx, const span *part, target *t);
/* Puts the file in its place, if ok; else removes it. False: not ok, or writing failed. */
bool target_close(shell *sh, lexer *lx, target *t, bool ok);
/* Says "wrote F (12 kB)" on standard error. */
void target_report(shell *sh, const char *name, const file_report *r);

#endif
