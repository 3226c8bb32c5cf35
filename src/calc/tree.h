/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the parser and the evaluator of expressions share. */
#ifndef CALC_TREE_H
#define CALC_TREE_H

#include "calc/expr.h"

typedef enum node_kind {
    N_NUMBER,
    N_QUANTITY,
    N_CALL,
    N_VARIABLE,
    N_SWEEP,
    N_NEGATE,
    N_BINARY,
    N_BUILTIN
} node_kind;

struct expr_node {
    node_kind kind;
    char op;
    size_t at, len; /* place in the statement */
    size_t left, right;
    size_t index; /* of a variable, sweep name or builtin */
    bool varies;  /* with the first name of a sweep */
    const quantity *q;
    value v;
};

/* How many values a node takes from the nodes before it. */
size_t node_operands(const expr_node *n);

/* An elementary function: of one argument, or of two. */
typedef struct builtin {
    const char *name;
    long double (*f)(long double);
    long double (*f2)(long double, long double);
    const char *summary;
} builtin;

const builtin *builtin_row(size_t i); /* NULL: pi, or beyond the last */
bool builtin_find(const char *name, size_t len, size_t *i);

#endif
