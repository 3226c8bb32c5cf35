/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tokens of a statement, and the error that every room of the language reports. */
#ifndef CALC_LEX_H
#define CALC_LEX_H

#include <stdbool.h>
#include <stddef.h>

enum { CALC_ERROR_TEXT = 512 };

/* What went wrong, and where in the statement: bytes at .. at+len. */
typedef struct calc_error {
    bool raised, stop; /* stop: interrupted */
    size_t at, len;
    char text[CALC_ERROR_TEXT];
} calc_error;

typedef enum token_kind {
    T_END,
    T_NUMBER,
    T_NAME,
    T_STRING,    /* "..." */
    T_ASSIGN,    /* = */
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
    T_PERCENT = '%'
} token_kind;

typedef struct lexer {
    const char *text; /* the statement */
    size_t end;       /* its length */
    token_kind kind;  /* of the token under the cursor */
    size_t at, len;   /* its place */
    size_t last;      /* end of the token before it */
    double number;
    calc_error *error;
} lexer;

void lex_start(lexer *lx, const char *text, size_t len, calc_error *error);
void lex_next(lexer *lx);
/* Moves the cursor to byte `at` and reads the token there. */
void lex_seek(lexer *lx, size_t at);
bool lex_is(const lexer *lx, const char *word);
/* If the cursor stands on the word, steps over it. */
bool lex_accept(lexer *lx, const char *word);
/* The kind of the token after the cursor. */
token_kind lex_peek(const lexer *lx);
/* A file name: a string, or all up to white space. False: none there. */
bool lex_filename(lexer *lx, char *buf, size_t size);

/* The decimal literal of `len` bytes times 10^shift, rounded once to double: infinite or 0 where it does not
 * fit. */
double lex_decimal(const char *text, size_t len, int shift);

/* Records the first error; always returns false. */
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
bool calc_fail(calc_error *error, size_t at, size_t len, const char *format, ...);
/* The same at the cursor. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
bool lex_fail(lexer *lx, const char *format, ...);

#endif
