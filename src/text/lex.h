/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The lexer: splits a statement into tokens. Depends on text/error and text/characters. */
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
    size_t at, len;   /* first byte and length of that token */
    size_t last;      /* end of the token before it */
    double number;    /* value of a T_NUMBER */
    bool list;        /* the value being read may be an item of a list, separated by commas */
    bool header;      /* the text is a unit in the header of a table, where `in` means inch */
    bool part;        /* the text is part of a longer statement: an error at its end is 1 byte wide */
    bool cut;         /* the user is still typing behind the text: it may end anywhere */
    calc_error *error;
} lexer;

void lex_start(lexer *lx, const char *text, size_t len, calc_error *error);
/* Moves the cursor to the next token. */
void lex_next(lexer *lx);
/* Moves the cursor to byte `at` and reads the token there. */
void lex_seek(lexer *lx, size_t at);
/* Is the token this name? */
bool lex_is(const lexer *lx, const char *word);
/* Can the byte be part of a name? */
bool lex_in_name(char c);
/* If the token is this name, moves to the next one and returns true. */
bool lex_accept(lexer *lx, const char *word);
/* Arguments of "%.*s": the token under the cursor, cut to 60 bytes for a message. */
#define LEX_SHOWN(length) (int)((length) < 60 ? (length) : 60)
#define LEX_WORD(lx) LEX_SHOWN((lx)->len), (lx)->text + (lx)->at
/* Copies the token, cut in the same way. */
enum { LEX_NAME = 64 };
void lex_word(const lexer *lx, char word[LEX_NAME]);
/* Copies the whole token; false with an error that calls it `what` if it is longer than a name may be. */
bool lex_whole(lexer *lx, const char *what, char word[LEX_NAME]);
/* The kind of the token after the cursor. */
token_kind lex_peek(const lexer *lx);
/* Is the cursor on NAME =, NAME += or NAME :=? */
bool lex_assigns(const lexer *lx);
/* Copies a file name, quoted or up to white space, and moves past it. False with an error. */
bool lex_filename(lexer *lx, char *buf, size_t size);

/* Is byte `at` a comma between two digits, as in a decimal number? *from, *len: that number. */
bool lex_decimal_comma(const lexer *lx, size_t at, size_t *from, size_t *len);
/* False with an error if the cursor stands on such a comma behind the one value that is wanted. */
bool lex_one_value(lexer *lx);

/* Reads the decimal number (digits with or without a point, and an exponent) at the beginning of `len` bytes.
 * *out is the number times 10^shift, rounded once: infinite or 0 if out of range, NaN if memory is out.
 * Returns the length, 0: there is no number. Two points are no part of it: they denote a range. */
size_t lex_decimal(const char *text, size_t len, char point, int shift, double *out);

/* Raises an error at the token under the cursor, lex_width bytes wide, and returns false. */
#define lex_fail(lx, ...) calc_fail((lx)->error, (lx)->at, lex_width(lx), __VA_ARGS__)
size_t lex_width(const lexer *lx);

#endif
