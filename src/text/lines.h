/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines as users type, paste and read them. */
#ifndef TEXT_LINES_H
#define TEXT_LINES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* What follows the prompt that a pasted line begins with, `fret> ` or `....> `, and its length; without one
 * the line as it is. Blanks before the prompt go with it. */
const char *strip_prompt(const char *line, size_t *len);
bool begins_with_prompt(const char *line, size_t len);

/* Takes prompts off the lines of a paste; where some begin with one the others are answers, and left out,
 * unless they continue a line, the first one that before it. Returns how many are left out. */
size_t paste_lines(char *text, bool continued);

/* Where the mark is that lets the line go on, or its length where there is none. */
size_t shell_mark(const char *line, size_t len);
/* End of the statement that begins at i: a `;`, a comment or the end of the line. */
size_t shell_statement_end(const char *text, size_t i, size_t len);

/* A text and the end of its line, broken at blanks before column 80. at: the column where it begins; the
 * lines that follow begin at `indent`. */
void help_wrapped(FILE *to, const char *text, size_t at, size_t indent);

#endif
