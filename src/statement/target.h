/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where a table goes: the screen, or a file whose ending names its form. */
#ifndef STATEMENT_TARGET_H
#define STATEMENT_TARGET_H

#include "statement/reader.h"
#include "text/file.h"

typedef struct target {
    FILE *to;
    int format;
    bool blocks; /* blank lines between curves */
    file_out file;
    span name; /* in the statement */
    bool shared;
} target;

/* As `to FILE` has been said, or not. */
bool target_open(shell *sh, const lexer *lx, said *all, target *t);
/* Before the first row of so many: those that are wanted, from the first on and before the other; all, unless
 * a share of them is run. */
bool target_share(shell *sh, target *t, size_t rows, size_t *from, size_t *to, calc_error *error);
/* Has the head of its columns been written by another share? */
static inline bool target_goes_on(const shell *sh, const target *t) {
    return t->shared && sh->share.number > 1;
}
/* The file of this name, whatever its ending. */
bool target_file(const lexer *lx, const span *part, target *t);
/* Keeps the file where ok; false: something was wrong before, or a byte was lost. */
bool target_close(shell *sh, lexer *lx, target *t, bool ok);
/* "wrote F (12 kB)", on standard error. */
void target_report(shell *sh, const char *name, const file_report *r);

#endif
