/* SPDX-License-Identifier: GPL-3.0-or-later */
/* UTF-8: decoding, encoding, widths, and which characters may be shown. Text from statements, files and other
 * programs must not control the terminal, nor hide or reorder what is beside it. Depends on libc alone. */
#ifndef TEXT_CHARACTERS_H
#define TEXT_CHARACTERS_H

#include <stdbool.h>
#include <stddef.h>

/* Decodes a character of at most `left` bytes. Returns its bytes, 0: not valid UTF-8. code may be NULL. */
size_t character_at(const char *text, size_t left, unsigned *code);
/* The index where the last character before `at` begins; that character may be cut off at `at`. */
size_t character_before(const char *text, size_t at);

/* Encodes a character as UTF-8 with a NUL behind it; returns its bytes without the NUL. */
enum { CHARACTER_BYTES = 5, CHARACTER_LOST = 0xfffd /* replaces bytes that cannot be decoded */ };
size_t character_put(unsigned code, char to[CHARACTER_BYTES]);

/* False for control characters, and for those that change the direction of writing or are invisible. */
bool character_shows(unsigned code);

/* The number of characters in a text; each byte that is not valid UTF-8 counts as one. */
size_t character_count(const char *text, size_t len);
/* The terminal columns that a text takes: 2 for a wide character (Chinese), 0 for a combining one, 1 for a
 * character that may not be shown and for an invalid byte. */
size_t text_columns(const char *text, size_t len);
/* The bytes of the longest beginning of a text that fits into `columns`, cut between characters. */
size_t text_fit(const char *text, size_t len, size_t columns);
/* The bytes of the next row of a wrapped text, broken at a blank if possible and at least one character long.
 * Advances *text and *left past the row and the blanks behind it. */
size_t text_break(const char **text, size_t *left, size_t columns);

/* Writes the character at text to `shown`, at most 10 bytes and a NUL: hidden ones and invalid bytes as \x1b
 * or \u202e, a tab as a blank. Returns the bytes taken from text. */
enum { CHARACTER_SHOWN = 12 };
size_t character_shown(const char *text, size_t left, char shown[CHARACTER_SHOWN]);
/* Does the same for a whole text, which is cut off between characters when `to` is full. */
void characters_shown(const char *text, char *to, size_t size);

#endif
