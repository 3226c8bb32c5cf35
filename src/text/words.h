/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Looking words up in tables of names, suggestions, and appending to texts. Depends on libc alone. */
#ifndef TEXT_WORDS_H
#define TEXT_WORDS_H

#include <stdbool.h>
#include <stddef.h>

/* The compiler checks the arguments from number `first` on against the format, argument number `text`. */
#if defined(__GNUC__)
#define LIKE_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define LIKE_PRINTF(text, first)
#endif

/* A hash index over a table of names: name(0), name(1), ... until NULL; start it as {.name = name}. */
enum { WORDS = 128 }; /* most names of a table */
typedef struct word_index {
    const char *(*name)(size_t i);
    bool made;
    unsigned char first[64], next[WORDS]; /* chains of row numbers + 1, ended by 0 */
} word_index;
/* Finds the row whose name is the word of `len` bytes; false: there is none. */
bool word_find(word_index *x, const char *word, size_t len, size_t *row);

/* The same by a linear search, for a table of few names. */
bool word_among(const char *(*name)(size_t i), const char *word, size_t len, size_t *row);

/* Copies a word with Greek letters replaced by their names in the language: `mu`, and `d` for a delta. */
enum { PLAIN_WORD = 64 };
void plain_letters(const char *word, size_t len, char plain[PLAIN_WORD]);

/* The nearest name, or NULL: at most two edits off, one for up to five letters, only case for up to two. */
const char *suggest(const char *typed, const char *(*name)(size_t i));

/* The arguments of a command as users see them: without the marks of := and += and the limits of numbers. */
void takes_text(const char *takes, char *buf, size_t size);

/* Appends to the text in buf as far as there is room. False: it was cut off. */
LIKE_PRINTF(3, 4)
bool text_add(char *buf, size_t size, const char *format, ...);
/* Appends a word to a list, with the separator `between` unless buf is empty. */
void list_word(char *buf, size_t size, const char *between, const char *word);

/* Are the words equal but for the case of ASCII letters? */
bool same_but_case(const char *a, const char *b);
/* Is one letter changed, missing or added, or two neighbours swapped? */
bool one_letter_apart(const char *a, const char *b);

#endif
