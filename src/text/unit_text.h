/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Units as they are written: N/mm^2, MPa*m^0.5. */
#ifndef TEXT_UNIT_TEXT_H
#define TEXT_UNIT_TEXT_H

#include "text/lex.h"
#include "text/unit.h"

/* Is the cursor on a unit? */
bool unit_at(const lexer *lx);
/* Parses a unit expression at the cursor. */
bool unit_parse(lexer *lx, unit *out);
/* The unit of a column and nothing else, as its header has it: `in` is the inch, and a factor may stand
 * before it. */
bool unit_of_header(lexer *lx, unit *out);
/* The decimal number at the beginning of a text, in this unit: rounded once. Its length; 0: there is none. */
size_t unit_number(const char *text, size_t len, char point, const unit *u, double *out);

#endif
