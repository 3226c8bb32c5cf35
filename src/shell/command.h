/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The one table of commands: dispatch, usage, help, apropos, completion and README's list derive from it. */
#ifndef SHELL_COMMAND_H
#define SHELL_COMMAND_H

#include "shell/shell.h"

typedef enum completion {
    COMPLETE_NONE,
    COMPLETE_QUANTITY,
    COMPLETE_GEOMETRY,
    COMPLETE_FILE,
    COMPLETE_TOPIC,
    COMPLETE_SETTING
} completion;

typedef struct command {
    const char *name;
    bool (*run)(shell *sh, lexer *lx); /* the cursor after the command word */
    const char *usage;                 /* lines, without the command word repeated */
    const char *summary;               /* one line */
    const char *help; /* what it does; ends with an example as a transcript, indented by four */
    completion complete;
} command;

const command *command_find(const char *name, size_t len);
const command *command_row(size_t i); /* NULL after the last */
const char *command_name(size_t i);

/* An argument NAME = EXPR or NAME += EXPR. */
typedef struct argument {
    const char *name; /* in the statement */
    size_t len, at, value_at, value_len;
    bool increment;
    value v;
} argument;

/* Is the cursor on an argument? */
bool at_argument(const lexer *lx);
bool read_argument(shell *sh, lexer *lx, argument *out);
bool argument_is(const argument *a, const char *name);
/* The argument's value must have this dimension; a bare 0 always has. */
bool argument_dim(lexer *lx, const argument *a, dim d);
bool value_dim(lexer *lx, const char *name, size_t at, size_t len, value v, dim d);
bool unknown_argument(lexer *lx, const argument *a, const command *c);
/* Nothing may follow. */
bool at_end(lexer *lx);
/* A positive whole number, such as after `steps`. */
bool read_count(shell *sh, lexer *lx, const char *what, unsigned limit, unsigned *out);

/* EXPR [in UNIT], ... into sh->list and columns; at most limit. */
bool read_expressions(shell *sh, lexer *lx, column *columns, size_t limit, size_t *count);

/* Rooms of handlers. */
bool do_material(shell *sh, lexer *lx);
bool do_second(shell *sh, lexer *lx);
bool do_geometry(shell *sh, lexer *lx);
bool do_friction(shell *sh, lexer *lx);
bool do_press(shell *sh, lexer *lx);
bool do_step(shell *sh, lexer *lx);
bool do_cycle(shell *sh, lexer *lx);
bool do_follow(shell *sh, lexer *lx);
bool do_reset(shell *sh, lexer *lx);

bool do_history(shell *sh, lexer *lx);
bool do_table(shell *sh, lexer *lx);
bool do_plot(shell *sh, lexer *lx);
bool do_explain(shell *sh, lexer *lx);
bool do_accuracy(shell *sh, lexer *lx);

bool do_show(shell *sh, lexer *lx);
bool do_set(shell *sh, lexer *lx);
bool do_help(shell *sh, lexer *lx);
bool do_apropos(shell *sh, lexer *lx);
bool do_source(shell *sh, lexer *lx);
bool do_demo(shell *sh, lexer *lx);
bool do_quit(shell *sh, lexer *lx);

/* The demo session, one statement a line. */
extern const char demo_text[];

#endif
