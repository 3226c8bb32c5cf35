/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A session of the calculator: the user's scene, the user's names, and the way back. */
#ifndef LANGUAGE_CALC_H
#define LANGUAGE_CALC_H

#include "language/expr.h"
#include "language/names.h"

/* One change that undo takes back: of the scene, or of a name. */
typedef struct undo_entry {
    unsigned long group; /* changes of one statement go together */
    scene_mark *before;  /* of the scene; NULL: of a name */
    size_t steps;        /* after it: those that come then are taken off one by one */
    size_t name;
    own_name old; /* text is not its own */
} undo_entry;

typedef struct undo {
    undo_entry *entry;
    size_t count, room;
    size_t promised; /* entries that statements under way will need */
    unsigned long group;
    unsigned long outermost; /* the group of the statement that holds the others */
    int nesting;             /* of statements that hold others */
    size_t base_steps;       /* of the oldest state that can come back */
} undo;

enum { CHAIN = 100, CALC_NOTE = 200 };

typedef struct calc {
    scene scene;
    scene *now; /* what expressions see: the user's scene, or a trial's */
    own_names names;
    undo undo;
    value ans; /* the last value printed */
    bool has_ans;
    int cores;                      /* that studies may keep busy; 0: all there are */
    char note[CALC_NOTE];           /* something to be told that is no error; empty: nothing */
    expr scratch;                   /* storage of expr_value */
    const definition *chain[CHAIN]; /* being evaluated */
    size_t chain_length;
    unsigned over_depth;              /* ranges that are gone over, one within the other */
    double over_error;                /* the largest of integrals since somebody cleared it, relative */
    bool (*keyword)(const lexer *lx); /* a word that may follow a number; NULL: any may */
} calc;

void calc_init(calc *c, const volatile sig_atomic_t *stop);
void calc_free(calc *c);

/* What is changed by name: an input or one of the user's names. */
typedef struct knob {
    bool is_input;
    input in;
    size_t name;
    dim d;
    char text[LEX_NAME];
} knob;

/* What `at` makes of it, and how many of them it takes. */
enum { CHANGES = 8 };
typedef struct knob_value {
    knob p;
    long double v;
} knob_value;

/* A scene shown twice, with two values of a name. */
enum { COMPARED = 2 };
typedef struct side_by_side {
    bool on;
    knob by;
    long double with[COMPARED];
} side_by_side;

/* `NAME = EXPR, ...`, `NAME := EXPR` and `NAME(X, ...) := EXPR`. Is the cursor on an assignment? */
bool assign_at(const lexer *lx);
bool calc_assign(calc *c, lexer *lx);
/* Binds an input to the expression at the cursor, as `NAME := EXPR` does; for the arguments of commands. */
bool calc_bind(calc *c, lexer *lx, input in, counted **out);
/* Is the input of use in the scene? Else an error that says so. */
bool calc_takes(const calc *c, input in, calc_error *error);

/* The value must have this dimension; a bare 0 always has. */
bool value_dim(lexer *lx, const char *name, size_t at, size_t len, value v, dim d);

/* Around every statement that may change the scene: begin, then end, then keep if it did. Statements within
 * a statement join it when it ends. */
void undo_begin(calc *c);
void undo_end(calc *c);
/* Before a change of the scene: keeps it as it is. NULL: out of memory, and nothing may be changed that could
 * not be taken back.  Ends with undo_scene, which makes it an entry, or undo_unmark, which takes back what
 * was done since. */
scene_mark *undo_mark(calc *c);
void undo_scene(calc *c, scene_mark *m);
void undo_unmark(calc *c, scene_mark *m);
/* Before a change of a name. False: out of memory. */
bool undo_name(calc *c, size_t name);
/* Forgets the last entry; back: its name gets its old value. */
void undo_pop(calc *c, bool back);
/* Takes back all that has been done since the group was c->undo.group, within one statement. */
void undo_since(calc *c, unsigned long group);
/* Takes back the last change; false: there is none. */
bool calc_undo(calc *c);

/* That is `ans` now. */
void calc_answered(calc *c, value v);

/* Words that mean something elsewhere in the field, and what leads on from them here, as "p(r) tells it". Row
 * i of them, for help; of a word, NULL where there is none. */
const char *lead_name(size_t i); /* NULL after the last */
const char *lead_text(size_t i);
const char *lead_from(const char *word);

/* "3 um", in the unit that fits. */
void calc_amount(dim d, long double v, int digits, char *text, size_t size);
/* The same with no more digits than a message bears. */
enum { CALC_VALUE_TEXT = 160 };
void calc_value_text(dim d, double v, char text[CALC_VALUE_TEXT]);
/* Puts an error into words, once. */
void calc_word(const calc *c, calc_error *error);
/* Adds to the words. */
LIKE_PRINTF(3, 4)
void calc_append(const calc *c, calc_error *error, const char *format, ...);

#endif
