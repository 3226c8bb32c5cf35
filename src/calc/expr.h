/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Expressions with dimensions, and the variables they see. */
#ifndef CALC_EXPR_H
#define CALC_EXPR_H

#include "calc/quantity.h"

typedef struct variable {
    char *name;
    value v;
} variable;

/* A parsed expression: a tree in an array, children before parents; the root is last. */
typedef struct expr_node expr_node;
typedef struct expr {
    expr_node *nodes;
    size_t count, room;
    const char *text; /* the statement it was parsed from: borrowed */
    size_t at, len;   /* its place there */
} expr;

/* What an expression can refer to. */
typedef struct calc {
    scene scene;
    variable *variables;
    size_t variable_count, variable_room;
    size_t *slots; /* hashed by name: 1 + index, or 0 */
    /* free names of a sweep, seen before everything else */
    const char *sweep_name[2];
    value sweep_value[2];
    expr scratch; /* storage of expr_value */
} calc;

void calc_free(calc *c);
bool calc_set_variable(calc *c, const char *name, size_t len, value v);
bool calc_find_variable(const calc *c, const char *name, size_t len, size_t *index);
/* i-th user variable's name, or NULL. */
const char *calc_variable_name(const calc *c, size_t i);

/* Parses at the cursor, as far as an expression goes. Reuses e's storage. */
bool expr_parse(const calc *c, lexer *lx, expr *e);
bool expr_eval(calc *c, const expr *e, value *out, calc_error *error);
/* The same at `rows` values x of the first name of a sweep, 1 to EXPR_BLOCK: one dimension for all. False
 * where a row fails, or may: expr_eval, row by row, finds out. */
enum { EXPR_BLOCK = 256 };
bool expr_eval_block(calc *c, const expr *e, const long double x[], size_t rows, long double out[], dim *d);
void expr_free(expr *e);

/* Parses a unit expression, such as N/mm^2, at the cursor. */
bool unit_parse(lexer *lx, unit *out);

/* Parse and evaluate in one go. */
bool expr_value(calc *c, lexer *lx, value *out);

/* Words with a meaning of their own in expressions: pi and the elementary functions. */
const char *builtin_name(size_t i);
const char *builtin_summary(size_t i);
/* Why a word cannot be a variable, or NULL: unit, quantity, function. */
const char *name_taken(const char *name, size_t len);

#endif
