/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a statement takes, as its row of a table writes it in one line, which is its usage too. Parses that
 * line; knows no statement, touches nothing.
 *
 *     [Fx+=20 N | dx+=0.5 um] [steps N:1000]    maximize:  EXPR over NAME = LO .. HI, ...
 *
 * A word in lower case begins a clause, as does an = that stands apart behind no hole; capitals are a hole.
 * NAME= is an argument, whose dimension and range are those of the quantity; := where it may be live, +=
 * where it may be an increment, an example behind it. [ ] may be left out, and stand in any order; with a *
 * it may come again, as may a word with ... behind it; | parts ways, of which one is gone; a comma and ...
 * let the hole, or of several holes the clause from its first on, come again. N:1000 is the most that a
 * number may be. A hole may stand for clauses that several rows have in common. */
#ifndef STATEMENT_GRAMMAR_H
#define STATEMENT_GRAMMAR_H

#include "scene/scene.h"

typedef enum hole_kind {
    HOLE_EXPR,    /* an expression, or a list of them */
    HOLE_MAYBE,   /* an expression, or nothing */
    HOLE_SPAN,    /* LO .. HI */
    HOLE_NAME,    /* a name that is changed, known to what stands before it too */
    HOLE_INPUT,   /* a name that has a value, or a list of them */
    HOLE_VALUE,   /* an expression of the dimension of a quantity, whose name may stand before: mu=0.3 */
    HOLE_COUNT,   /* a whole number from 1 on */
    HOLE_SECONDS, /* a positive number */
    HOLE_TEXT,    /* "..." */
    HOLE_FILE,    /* all up to a blank, or "..." */
    HOLE_COLUMN,  /* of a file: a name, "...", or a number; a unit may follow */
    HOLE_CHOICE,  /* one of some words */
    HOLE_WORD,    /* any word: the command judges it */
    HOLE_LOAD,    /* a statement of the load, which begins with one of some words */
    HOLE_CLAUSES  /* none, but clauses: a table of them */
} hole_kind;

typedef struct hole_row {
    const char *name;
    hole_kind kind;
    const char *noun;                        /* of a choice: what is chosen; of a value: the quantity */
    const char *(*words)(size_t i);          /* of a choice or a word; of clauses, their lines */
    const struct grammar *(*form)(size_t i); /* of a choice that stands first: what follows that word */
} hole_row;

typedef struct hole {
    const hole_row *row;
    unsigned most;
    char before; /* '=', or '+' of +-: what parts it from the hole before; 0: nothing */
} hole;

typedef enum value_must { ANY, POSITIVE, CURVED } value_must; /* curved: a radius, not 0, or inf */

enum { CLAUSE_NAME = 16, CLAUSE_HOLES = 2 };
typedef struct clause {
    char name[CLAUSE_NAME]; /* of an argument, or the word of a clause; empty: of holes that stand first */
    const char *text;       /* of the line, from there on */
    size_t len;             /* of this clause */
    bool argument, live, increment;
    bool optional, again;
    bool list; /* comes again behind a comma */
    int in;    /* of an argument, 1 + the input whose range it has; 0: none */
    dim d;     /* of an argument or a value */
    value_must must;
    unsigned group, way; /* one way of a group is gone; 0: in no group */
    hole hole[CLAUSE_HOLES];
    unsigned holes;
} clause;

enum { CLAUSES = 32 };
typedef struct grammar {
    const char *command, *shape; /* "geometry", "sphere"; shape may be NULL */
    const char *takes, *summary;
    unsigned count;
    clause clause[CLAUSES];
} grammar;

/* False: the line is malformed; `at` gets where. holes: ended by a row without a name. */
bool grammar_parse(grammar *out, const hole_row *holes, const char **at);
/* The clause of this name, or NULL. */
const clause *grammar_clause(const grammar *f, const char *name);
/* Does what stands first begin with such a hole? */
const hole_row *grammar_first(const grammar *f, hole_kind kind);

/* "geometry sphere R=10 mm": the line without its marks. */
enum { GRAMMAR_USAGE = 400 };
void grammar_usage(const grammar *f, char buf[GRAMMAR_USAGE]);
/* The same behind the words of the error; false. */
bool add_usage(calc_error *error, const grammar *f);
/* The same of a hole that stands for clauses. */
void grammar_clauses(const hole_row *row, char buf[GRAMMAR_USAGE]);

#endif
