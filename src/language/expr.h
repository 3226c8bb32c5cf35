/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Expressions with dimensions, parsed once and evaluated often. */
#ifndef LANGUAGE_EXPR_H
#define LANGUAGE_EXPR_H

#include "scene/quantity.h"
#include "text/lex.h"

struct calc;

/* A parsed expression: a tree as an array, children before parents; the root is last. */
typedef struct expr_node expr_node;
typedef struct expr_at expr_at;
typedef struct expr {
    expr_node *nodes;
    size_t count, room;
    size_t *arguments; /* nodes that are arguments of functions, call by call */
    size_t argument_count, argument_room;
    expr_at *ats;     /* list of its `at` and range parts */
    const char *text; /* the statement it was parsed from: borrowed */
    size_t at, len;   /* its place there */
    bool unclear;     /* a unit in it may have two readings */
} expr;

enum { PARAMETERS = 4 };

/* NAME := EXPR, or NAME(X, ...) := EXPR. */
typedef struct definition {
    counted base;
    char *label; /* NAME */
    char *text;  /* text of the body, owned */
    expr body;
    unsigned parameters;
    char parameter[PARAMETERS][LEX_NAME];
} definition;

/* Parses the expression at the cursor; `at` only within parentheses. Reuses the buffers of e. */
bool expr_parse(struct calc *c, lexer *lx, expr *e);
/* The same with a trailing `at NAME = EXPR, ...`, which a comma ends unless NAME = follows. */
bool expr_parse_at(struct calc *c, lexer *lx, expr *e);
/* Parses a trailing `at ...` for an expression that has been parsed. */
bool expr_read_at(struct calc *c, lexer *lx, expr *e);
bool expr_eval(struct calc *c, const expr *e, value *out, calc_error *error);
/* The same for a wanted dimension, which decides between 1/2 mm and 1/(2 mm); NULL: any. */
bool expr_eval_as(struct calc *c, const expr *e, const dim *want, value *out, calc_error *error);
/* The dimension, also where a value is missing. */
bool expr_dim(struct calc *c, const expr *e, dim *d);
void expr_free(expr *e);

/* Is the token after a number no unit, quantity or keyword? Then sets an error. NULL: any word may follow. */
bool expr_stray_unit(lexer *lx, bool (*keyword)(const lexer *lx));

/* Parses and evaluates. */
bool expr_value(struct calc *c, lexer *lx, value *out);
bool expr_value_as(struct calc *c, lexer *lx, const dim *want, value *out);

/* Does the expression depend on a quantity or a user's name, directly or through live definitions? */
bool expr_mentions(const struct calc *c, const expr *e, const quantity *q, const char *name);
/* Does a live definition of an input mention the name? */
bool bindings_mention(const struct calc *c, const inputs *in, const char *name);
/* Does it depend on this name? chain: the chain of definitions to it, as "b -> c -> ". */
bool expr_chain(const struct calc *c, const expr *e, const char *name, char *chain, size_t size);
/* Iterates over the quantities of an expression in order, i = 0, 1, ...: each once, and each call. call: as a
 * function; at: first place. NULL after the last. */
const quantity *expr_quantity(const expr *e, size_t i, bool *call, size_t *at);
/* The unit of its row if the expression is one quantity, perhaps with `at`; else NULL. */
const char *expr_unit(const expr *e);
/* Iterates over the definitions and functions that it names. */
const definition *expr_definition(const struct calc *c, const expr *e, size_t i);
/* Follows an expression that is the name of a live definition alone to the last body. */
const expr *expr_meant(const struct calc *c, const expr *e);

/* Makes a definition of the expression at the cursor; its errors are placed there. NULL on error. */
definition *definition_parse(struct calc *c, lexer *lx, const char *label, size_t len,
                             char (*parameter)[LEX_NAME], unsigned parameters);
/* The value of a definition without parameters in c->now; a circle is an error that names it. */
bool definition_value(struct calc *c, definition *d, value *out, calc_error *error);

/* The names of pi and the elementary functions, and their help. */
const char *builtin_name(size_t i);
const char *builtin_summary(size_t i);
/* Why a word cannot be a variable ("a unit", "a quantity", ...), or NULL. */
const char *name_taken(const char *name, size_t len);

#endif
