/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Characters of UTF-8, and which of them may be shown: what comes from statements, files and other programs
 * must not command the terminal, hide or turn round what is beside it. Touches nothing. */
#ifndef TEXT_CHARACTERS_H
#define TEXT_CHARACTERS_H

#include <stdbool.h>
#include <stddef.h>

/* The bytes of the character at text, of which `left` are there; 0: they are no UTF-8. code may be NULL. */
size_t character_at(const char *text, size_t left, unsigned *code);
/* Where the character begins that ends before `at`, or is cut off there. */
size_t character_before(const char *text, size_t at);

/* The character as UTF-8, and a NUL: its bytes. */
enum { CHARACTER_BYTES = 5, CHARACTER_LOST = 0xfffd /* stands for what was none */ };
size_t character_put(unsigned code, char to[CHARACTER_BYTES]);

/* No control character, and none that turns the direction of writing or takes no place. */
bool character_shows(unsigned code);

/* Characters that the bytes are; one that is no UTF-8 counts as one. */
size_t character_count(const char *text, size_t len);
/* Columns that they take: 2 for a wide one, as of Chinese, none for one that is put onto the one before it, 1
 * for what does not show. */
size_t text_columns(const char *text, size_t len);
/* Bytes of it that go into so many columns. */
size_t text_fit(const char *text, size_t len, size_t columns);
/* The next row of a text: its bytes, at least a character, broken between words where it can be. The text
 * goes on to the row after. */
size_t text_break(const char **text, size_t *left, size_t columns);

/* A character that does not show is written in this way, as \x1b or \u202e; a byte that is no UTF-8 too.
 * Returns the bytes taken from text; shown holds a text of at most 10 bytes. */
enum { CHARACTER_SHOWN = 12 };
size_t character_shown(const char *text, size_t left, char shown[CHARACTER_SHOWN]);
/* A whole text, as far as there is room for it. */
void characters_shown(const char *text, char *to, size_t size);

#endif
