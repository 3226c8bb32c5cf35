/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What those that parse, evaluate and look through expressions share. */
#ifndef LANGUAGE_TREE_H
#define LANGUAGE_TREE_H

#include "language/trial.h"

typedef enum node_kind {
    N_NUMBER,
    N_QUANTITY,
    N_CALL,  /* of a quantity: its arguments as those of N_APPLY */
    N_NAME,  /* of the user */
    N_APPLY, /* of the user's function */
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
    char op;            /* + - * / ^, U: a number and its unit, ?: one that may belong to the divisor alone */
    unsigned len;
    size_t at;          /* its place in the statement */
    size_t left, right; /* N_CALL, N_APPLY: first of the arguments, and how many */
    size_t index; /* of a name, parameter or builtin; number: has it a unit? operator: where it stands */
    union {
        const quantity *q;
        expr_at *changed; /* N_AT, N_OVER */
    };
    value v;
};

/* EXPR at NAME = EXPR, ...; EXPR for NAME = LO .. HI, as two changes of one name, or along a load, as none.
 */
struct expr_at {
    expr_at *next; /* of the expression that it is a part of */
    expr body;
    bool along;
    along_what what;
    size_t count;
    struct {
        size_t at; /* of its name */
        knob p;
        expr value;
    } change[CHANGES];
};

/* A step more of a way of definitions, or, for want of room, the last with dots. Returns the room it took. */
size_t way_step(char *way, size_t size, const char *name, const char *text);

/* An elementary function: of one argument, or of two. */
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
    } d; /* the last: over a range */
    const char *summary;
} builtin;

const builtin *builtin_row(size_t i); /* NULL: pi, or beyond the last */
bool builtin_find(const char *name, size_t len, size_t *i);

#endif
