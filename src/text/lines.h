/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines as users type, paste and read them. Depends on text/characters. */
#ifndef TEXT_LINES_H
#define TEXT_LINES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Skips the prompt `fret> ` or `....> ` at the beginning of a pasted line, with the blanks before it, and
 * reduces *len; returns the line itself if it has none. */
const char *strip_prompt(const char *line, size_t *len);
bool begins_with_prompt(const char *line, size_t len);

/* Is a line of a script a remark, or empty, rather than statements? */
static inline bool line_is_remark(const char *line) {
    return *line == '#' || !*line;
}

/* Removes prompts from pasted lines. If one of several has a prompt, lines without are answers and removed
 * too, unless they continue a line; `continued`: the first one does. Returns how many lines were removed. */
size_t paste_lines(char *text, bool continued);

/* The index of the `\` by which the line is continued; its length if there is none. */
size_t shell_mark(const char *line, size_t len);
/* The end of the statement that begins at i: a `;`, a comment or the end of the text. */
size_t shell_statement_end(const char *text, size_t i, size_t len);

/* Writes a label, a text and a newline, wrapped at blanks to 79 columns; lines after the first are indented.
 */
void help_wrapped(FILE *to, const char *label, const char *text, size_t indent);

#endif
