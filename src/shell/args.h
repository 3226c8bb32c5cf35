/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Arguments of commands: what a row of the table of commands takes, and reading it. Usage errors and
 * completion by position derive from the same rows. */
#ifndef SHELL_ARGS_H
#define SHELL_ARGS_H

#include "shell/cursor.h"
#include "shell/shell.h"

typedef enum arg_kind {
    ARG_END,
    ARG_VALUE,  /* NAME = EXPR of the dimension d, or of the input's */
    ARG_COUNT,  /* NAME and a whole number from 1 to `most` */
    ARG_NUMBER, /* NAME and a number of seconds up to `most` */
    ARG_WORD,   /* NAME alone */
    ARG_CHOICE, /* first: one of the words of a table */
    ARG_EXPR,   /* first: an expression of the dimension d */
    ARG_FILE,   /* first: a file to read */
    ARG_TO,     /* NAME and a file to write */
    ARG_NAME,   /* first: one of the words, any other too: the command reads it itself */
    ARG_LIST,   /* first: expressions; the command reads them itself */
    ARG_KNOB    /* first: names that are changed; so it does these */
} arg_kind;

/* Flags of a row. */
enum {
    ARG_INCREMENT = 1, /* NAME += EXPR too */
    ARG_LIVE = 2,      /* NAME := EXPR too */
    ARG_POSITIVE = 4,
    ARG_OPTIONAL = 8,
    ARG_OWN_DIM = 16, /* of the input, but with the dimension d */
    ARG_NONZERO = 32
};

typedef struct arg {
    arg_kind kind;
    const char *name; /* of ARG_CHOICE and ARG_NAME: what is chosen, for messages */
    dim d;
    int in; /* 1 + the input whose dimension and range it has; 0: none */
    unsigned flags;
    int group; /* one of a group, 0: no group */
    unsigned most;
    const char *beside;             /* the argument without which it does nothing; NULL: none */
    const char *(*words)(size_t i); /* of ARG_CHOICE (ten and more) and ARG_NAME, for completion too */
} arg;

enum { ARGS = 16, ARG_FILE_NAME = 4096 };

/* What has been read for one row. */
typedef struct arg_value {
    bool given, increment;
    value v;
    counted *live; /* to be taken over or dropped */
    unsigned count;
    size_t at, len;             /* of the name */
    size_t value_at, value_len; /* of what it was given */
    size_t choice;
} arg_value;

/* Who asks: for messages. */
typedef struct arg_list {
    const arg *args;
    const char *who;     /* "cycle", "sphere" */
    const char *command; /* "cycle", "geometry" */
    const char *usage;   /* "FA=20 N ...", without the command */
    const char *noun;    /* "argument", "parameter" */
} arg_list;

/* Reads all that the rows allow to the end of the statement. file: of ARG_FILE, the size of
 * ARG_FILE_NAME, or NULL where there are none. */
bool args_read(shell *sh, lexer *lx, const arg_list *list, arg_value out[ARGS], char *file);
/* The same as far as the arguments go, and the end behind them: no comma, no keyword misspelt. */
bool args_read_some(shell *sh, lexer *lx, const arg_list *list, arg_value out[ARGS], char *file);
bool args_end(lexer *lx, const arg_list *list);
/* Says which of them do nothing. */
void args_note_idle(shell *sh, const arg_list *list, const arg_value v[ARGS]);
void args_drop(const arg_list *list, arg_value v[ARGS]);
/* Points the error, where it has no place, at the value of the argument. */
#define arg_place(error, v) calc_place(error, (v)->value_at, (v)->value_len)

#endif
