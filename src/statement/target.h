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
} target;

/* As `to FILE` has been said, or not. */
bool target_open(shell *sh, const lexer *lx, said *all, target *t);
/* The file of this name, whatever its ending. */
bool target_file(const lexer *lx, const span *part, target *t);
/* Keeps the file where ok; false: something was wrong before, or a byte was lost. */
bool target_close(shell *sh, lexer *lx, target *t, bool ok);
/* "wrote F (12 kB)", on standard error. */
void target_report(shell *sh, const char *name, const file_report *r);

#endif
