/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Expressions with dimensions: parsed once, evaluated often. */
#ifndef LANGUAGE_EXPR_H
#define LANGUAGE_EXPR_H

#include "scene/quantity.h"
#include "text/lex.h"

struct calc;

/* A parsed expression: a tree in an array, children before parents; the root is last. */
typedef struct expr_node expr_node;
typedef struct expr_at expr_at;
typedef struct expr {
    expr_node *nodes;
    size_t count, room;
    size_t *arguments; /* roots of the arguments of the user's functions */
    size_t argument_count, argument_room;
    expr_at *ats;     /* its parts `... at NAME = EXPR`, a list */
    const char *text; /* the statement it was parsed from: borrowed */
    size_t at, len;   /* its place there */
    bool unclear;     /* there may be a unit in it that has two readings */
} expr;

enum { PARAMETERS = 4 };

/* NAME := EXPR, or NAME(X, ...) := EXPR. */
typedef struct definition {
    counted base;
    char *label; /* NAME */
    char *text;  /* of the body, its own */
    expr body;
    unsigned parameters;
    char parameter[PARAMETERS][LEX_NAME];
} definition;

/* Parses at the cursor, as far as an expression goes, with `at` where it is within parentheses. Reuses e's
 * storage.
 */
bool expr_parse(struct calc *c, lexer *lx, expr *e);
/* The same with `at NAME = EXPR, ...` behind it. A comma ends it that no NAME = follows. */
bool expr_parse_at(struct calc *c, lexer *lx, expr *e);
/* `at ...` at the cursor, for an expression that has been parsed. */
bool expr_read_at(struct calc *c, lexer *lx, expr *e);
bool expr_eval(struct calc *c, const expr *e, value *out, calc_error *error);
/* The same where that dimension is wanted, which tells 1/2 mm from 1/(2 mm); NULL: any. */
bool expr_eval_as(struct calc *c, const expr *e, const dim *want, value *out, calc_error *error);
/* The dimension alone, also where a value is missing. */
bool expr_dim(struct calc *c, const expr *e, dim *d);
void expr_free(expr *e);

/* Right behind a number, a word that is neither a unit nor a quantity nor a keyword: an error, and true.
 * NULL: any word may come there. */
bool expr_stray_unit(lexer *lx, bool (*keyword)(const lexer *lx));

/* Parse and evaluate in one go. */
bool expr_value(struct calc *c, lexer *lx, value *out);
bool expr_value_as(struct calc *c, lexer *lx, const dim *want, value *out);

/* Does the expression depend on this quantity or own name, directly or by live definitions? */
bool expr_mentions(const struct calc *c, const expr *e, const quantity *q, const char *name);
/* Does it depend on this name? way: the live definitions that lead there, as "b -> c -> ". */
bool expr_way(const struct calc *c, const expr *e, const char *name, char *way, size_t size);
/* The quantities of an expression in the order of their appearance, and each call of one: i = 0, 1, ... call:
 * as a function; at: where, first. NULL after the last. */
const quantity *expr_quantity(const expr *e, size_t i, bool *call, size_t *at);
/* The unit of its row, if it is one quantity and nothing else, perhaps `at` something; or NULL. */
const char *expr_unit(const expr *e);
/* The live definitions and functions that it names, likewise. */
const definition *expr_definition(const struct calc *c, const expr *e, size_t i);
/* What it stands for, if it is the name of a live definition and nothing else: down to the last of them. */
const expr *expr_meant(const struct calc *c, const expr *e);

/* A definition of the text at the cursor to the end of its expression; takes its errors there. NULL on error.
 */
definition *definition_parse(struct calc *c, lexer *lx, const char *label, size_t len,
                             char (*parameter)[LEX_NAME], unsigned parameters);
/* The value of a definition without parameters in the scene c->now; a circle is an error that names it. */
bool definition_value(struct calc *c, definition *d, value *out, calc_error *error);

/* Words with a meaning of their own in expressions: pi and the elementary functions. */
const char *builtin_name(size_t i);
const char *builtin_summary(size_t i);
/* Why a word cannot be a variable, or NULL: a unit, a quantity, a function. */
const char *name_taken(const char *name, size_t len);

#endif
