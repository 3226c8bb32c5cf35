/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tokens of a statement. */
#ifndef TEXT_LEX_H
#define TEXT_LEX_H

#include "text/error.h"

typedef enum token_kind {
    T_END,
    T_NUMBER,
    T_NAME,
    T_STRING,    /* "..." */
    T_ASSIGN,    /* = */
    T_DEFINE,    /* := */
    T_INCREMENT, /* += */
    T_RANGE,     /* .. */
    T_PLUS = '+',
    T_MINUS = '-',
    T_TIMES = '*',
    T_DIVIDE = '/',
    T_POWER = '^',
    T_OPEN = '(',
    T_CLOSE = ')',
    T_COMMA = ',',
    T_COLON = ':',
    T_BAR = '|',
    T_PERCENT = '%'
} token_kind;

typedef struct lexer {
    const char *text; /* the statement */
    size_t end;       /* its length */
    token_kind kind;  /* of the token under the cursor */
    size_t at, len;   /* its place */
    size_t last;      /* end of the token before it */
    double number;
    bool list;   /* the value that is read may be one of several, parted by commas */
    bool header; /* the text is a unit of a header, where `in` is the inch */
    bool part;   /* of a statement that goes on: what is missing at its end has a place */
    bool cut;    /* the text ends where someone is typing: it is read as far as it goes */
    calc_error *error;
} lexer;

void lex_start(lexer *lx, const char *text, size_t len, calc_error *error);
void lex_next(lexer *lx);
/* Moves the cursor to byte `at` and reads the token there. */
void lex_seek(lexer *lx, size_t at);
bool lex_is(const lexer *lx, const char *word);
/* Can the byte stand within a name? */
bool lex_in_name(char c);
/* If the cursor stands on the word, steps over it. */
bool lex_accept(lexer *lx, const char *word);
/* For "%.*s": the token under the cursor, as much of it as a message bears. */
#define LEX_SHOWN(length) (int)((length) < 60 ? (length) : 60)
#define LEX_WORD(lx) LEX_SHOWN((lx)->len), (lx)->text + (lx)->at
/* The same as a string of its own. */
enum { LEX_NAME = 64 };
void lex_word(const lexer *lx, char word[LEX_NAME]);
/* All of it; an error, which says what it is, where that is longer. */
bool lex_whole(lexer *lx, const char *what, char word[LEX_NAME]);
/* The kind of the token after the cursor. */
token_kind lex_peek(const lexer *lx);
/* Is the cursor on NAME =, NAME += or NAME :=? */
bool lex_assigns(const lexer *lx);
/* A file name: a string, or all up to white space. False: none there. */
bool lex_filename(lexer *lx, char *buf, size_t size);

/* A comma at byte `at` straight between two digits, as of a decimal number: which of the text that number
 * would be. False: it is none. */
bool lex_decimal_comma(const lexer *lx, size_t at, size_t *from, size_t *len);
/* The same as an error, where one value is wanted and the cursor stands on the comma behind it. */
bool lex_one_value(lexer *lx);

/* The decimal number at the beginning of `len` bytes times 10^shift, rounded once to double: infinite or 0
 * where it does not fit, NaN where memory is out. Returns its length, 0 where there is none: digits with or
 * without a point, of which two stand for a range, and an exponent. */
size_t lex_decimal(const char *text, size_t len, char point, int shift, double *out);

/* Records an error at the cursor, which is so wide; false. */
#define lex_fail(lx, ...) calc_fail((lx)->error, (lx)->at, lex_width(lx), __VA_ARGS__)
size_t lex_width(const lexer *lx);

#endif
