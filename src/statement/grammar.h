/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The grammar of a statement, written in one line of its row of a table, which is also its usage message.
 * This module parses that line; it reads no statements and has no side effects.
 *
 *     [Fx+=20 N | dx+=0.5 um] [steps N:1000]    maximize:  EXPR over NAME = LO .. HI, ...
 *
 * A lower-case word begins a clause, and so does a separate = that follows no hole. A word in capitals is a
 * hole: a place for an expression, a file name, ... NAME= is an argument, with the dimension and range of the
 * quantity NAME, and an example behind it; with := it may be a live definition, with += an increment. Clauses
 * in [ ] are optional, in any order; [ ]* may repeat; | separates alternatives, one of which may be given. A
 * hole with ", ..." takes a list; where the clause has several holes, all of them repeat. A WORD with " ..."
 * may repeat, too. N:1000 is the largest number allowed, N:2..1000 gives the least. HOLE_CLAUSES: clauses
 * that several rows share. */
#ifndef STATEMENT_GRAMMAR_H
#define STATEMENT_GRAMMAR_H

#include "scene/scene.h"

typedef enum hole_kind {
    HOLE_EXPR,  /* an expression, or a list of them */
    HOLE_MAYBE, /* an expression, or nothing */
    HOLE_SPAN,  /* LO .. HI */
    HOLE_NAME,  /* a name that the statement sets; it may be new, and is known to what stands before it too */
    HOLE_INPUT, /* a name that has a value, or a list of such names */
    HOLE_VALUE, /* an expression of the dimension of a quantity; `mu=` may stand before it: mu=0.3 */
    HOLE_COUNT, /* a whole number from 1 on */
    HOLE_SECONDS, /* a positive number */
    HOLE_TEXT,    /* "..." */
    HOLE_FILE,    /* a file name: all up to a blank, or "..." */
    HOLE_COLUMN,  /* a column of a file: a name, "...", or a number; a unit may follow */
    HOLE_CHOICE,  /* a word out of a table */
    HOLE_WORD,    /* any word; the command checks it */
    HOLE_LOAD,    /* a load statement, which begins with a word out of a table */
    HOLE_CLAUSES  /* no hole, but the clauses of a table, which take its place */
} hole_kind;

typedef struct hole_row {
    const char *name; /* "EXPR" */
    hole_kind kind;
    const char *noun;                        /* HOLE_CHOICE: what is chosen; HOLE_VALUE: the quantity */
    const char *(*words)(size_t i);          /* table of a choice, word or load; of clauses, their lines */
    const struct grammar *(*form)(size_t i); /* where that word stands first: what follows it; or NULL */
} hole_row;

typedef struct hole {
    const hole_row *row;
    unsigned least, most; /* numbers allowed */
    char before;          /* what separates it from the hole before: '=', '+' for +-, 0 for nothing */
} hole;

typedef enum value_must { ANY, POSITIVE, CURVED } value_must; /* CURVED: a radius; not 0, inf for a plane */

enum { CLAUSE_NAME = 16, CLAUSE_HOLES = 2 };
typedef struct clause {
    char name[CLAUSE_NAME]; /* the argument's name, or the clause's word; empty: holes that stand first */
    const char *text;       /* the line of grammar, from this clause on */
    size_t len;             /* of this clause in `text` */
    bool argument, live, increment; /* NAME=, NAME:=, NAME+= */
    bool optional, again;           /* it may be left out; it may be given more than once */
    bool list;                      /* its holes repeat behind a comma */
    int in;                         /* of an argument, 1 + the input whose range it has; 0: none */
    dim d;                          /* of an argument or a HOLE_VALUE */
    value_must must;
    unsigned group, alternative; /* of a group one alternative may be given; group 0: it has none */
    hole hole[CLAUSE_HOLES];
    unsigned holes;
} clause;

enum { CLAUSES = 32 };
typedef struct grammar {
    const char *command, *shape; /* "geometry", "sphere"; shape may be NULL */
    const char *takes, *summary; /* the line of grammar; one line of help */
    unsigned count;
    clause clause[CLAUSES];
} grammar;

/* Parses out->takes. False: the line is malformed, at *at. holes: ends with a row without a name. */
bool grammar_parse(grammar *out, const hole_row *holes, const char **at);
/* The clause of this name, or NULL. */
const clause *grammar_clause(const grammar *f, const char *name);
/* The hole of this kind that a statement may begin with, or NULL. */
const hole_row *grammar_first(const grammar *f, hole_kind kind);

/* Usage: "geometry sphere R=10 mm", the line without := and :1000. */
enum { GRAMMAR_USAGE = 400 };
void grammar_usage(const grammar *f, char buf[GRAMMAR_USAGE]);
/* Appends "; usage: ..." to the error; false. */
bool add_usage(calc_error *error, const grammar *f);
/* Usage of all clauses that a HOLE_CLAUSES stands for. */
void grammar_clauses(const hole_row *row, char buf[GRAMMAR_USAGE]);

#endif
