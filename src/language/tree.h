/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The nodes of expression trees, for the parser, the evaluator and searches. Private to the room. */
#ifndef LANGUAGE_TREE_H
#define LANGUAGE_TREE_H

#include "language/trial.h"

typedef enum node_kind {
    N_NUMBER,
    N_QUANTITY,
    N_CALL,  /* call of a quantity */
    N_NAME,  /* a user's name */
    N_APPLY, /* call of a user's function */
    N_PARAMETER,
    N_ANS,
    N_NEGATE,
    N_BINARY,
    N_BUILTIN,
    N_AT,
    N_OVER /* integral, maximum, minimum */
} node_kind;

struct expr_node {
    unsigned char kind; /* node_kind */
    char op;            /* + - * / ^; U: number and unit; ?: unit that may belong to the divisor only */
    unsigned len;
    size_t at;          /* its place in the statement */
    size_t left, right; /* children; N_CALL, N_APPLY: first argument, and how many */
    size_t index; /* index of a name, parameter or builtin; number: has it a unit? operator: its place */
    union {
        const quantity *q;
        expr_at *changed; /* N_AT, N_OVER */
    };
    value v;
};

/* EXPR at NAME = EXPR, ...; EXPR for NAME = LO .. HI as two changes of NAME; EXPR along a load without. */
struct expr_at {
    expr_at *next; /* list of expr.ats */
    expr body;
    bool along;
    along_what what;
    size_t count;
    struct {
        size_t at; /* place of its name */
        knob p;
        expr value;
    } change[CHANGES];
};

/* Appends "name -> " or "name := text -> " to a chain of definitions; if there is no room, dots, as the last
 * step. Returns the number of characters used. */
size_t chain_step(char *chain, size_t size, const char *name, const char *text);

/* An elementary function of one argument (f) or two (f2). */
typedef struct builtin {
    const char *name;
    long double (*f)(long double);
    long double (*f2)(long double, long double);
    enum {
        DIM_NUMBER,
        DIM_TO_ANGLE,
        DIM_KEPT,
        DIM_HALVED,
        DIM_SHARED,
        DIM_RANGE
    } d; /* its dimension; DIM_RANGE: over a range */
    const char *summary;
} builtin;

const builtin *builtin_row(size_t i); /* NULL: pi, or beyond the last */
bool builtin_find(const char *name, size_t len, size_t *i);

#endif
