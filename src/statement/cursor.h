/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What readers of statements ask of the cursor: what it is on, whether anything follows. Touches nothing
 * else. */
#ifndef STATEMENT_CURSOR_H
#define STATEMENT_CURSOR_H

#include "language/calc.h"

/* The word of bytes up to a blank that the cursor begins: names with hyphens are several tokens to the lexer.
 */
size_t word_at(const lexer *lx);
/* The same up to a comma or an `=`: no word of a table has them. */
size_t choice_at(const lexer *lx);
/* Is the cursor on NAME =, NAME += or NAME :=? */
bool at_argument(const lexer *lx);
/* Nothing may follow. */
bool at_end(lexer *lx);
/* A name right after a number was meant as a unit: an error; else false. */
bool stray_unit(lexer *lx);
/* A whole number from 1 to limit. */
bool read_count(calc *c, lexer *lx, const char *what, unsigned limit, unsigned *out);

/* Is it a word that may follow a number: one that the table of commands names, or of a range? In command.c.
 */
bool argument_word(const lexer *lx);

#endif
