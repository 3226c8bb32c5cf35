/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What readers of statements ask of the cursor: what it is on, whether anything follows. Touches nothing
 * else. */
#ifndef STATEMENT_CURSOR_H
#define STATEMENT_CURSOR_H

#include "language/calc.h"

/* Is the cursor on NAME =, NAME += or NAME :=? */
bool at_argument(const lexer *lx);
/* Nothing may follow. */
bool at_end(lexer *lx);
/* A name right after a number was meant as a unit: an error; else false. */
bool stray_unit(lexer *lx);
/* Is it a word that may follow a number: one that the table of commands names, or of a range? In command.c.
 */
bool argument_word(const lexer *lx);

#endif
