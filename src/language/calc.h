/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A session of the calculator: the user's scene, the user's names, and undo. */
#ifndef LANGUAGE_CALC_H
#define LANGUAGE_CALC_H

#include "language/expr.h"
#include "language/names.h"

/* One change that undo reverts: of the scene, or of a name. */
typedef struct undo_entry {
    unsigned long group; /* changes of one statement have one group */
    scene_mark *before;  /* the scene before; NULL: a change of a name */
    size_t steps;        /* length of the load program after it: later steps have no entries */
    size_t name;
    own_name old; /* the name before; its text is borrowed */
} undo_entry;

typedef struct undo {
    undo_entry *entry;
    size_t count, room;
    size_t promised; /* entries reserved by open undo_mark calls */
    unsigned long group;
    unsigned long outermost; /* group of the outermost open statement */
    int nesting;             /* depth of open statements */
    size_t base_steps;       /* length of the load program in the oldest state */
} undo;

enum { CHAIN = 100, CALC_NOTE = 300 };

typedef struct calc {
    scene scene;
    scene *now; /* the scene of expressions: the user's, or a trial's */
    own_names names;
    undo undo;
    value ans; /* the last value printed */
    bool has_ans;
    int cores;                      /* cores that studies may use; 0: all */
    char note[CALC_NOTE];           /* a note that is no error; empty: none */
    expr scratch;                   /* buffer of expr_value */
    const definition *chain[CHAIN]; /* definitions being evaluated */
    size_t chain_length;
    unsigned over_depth;              /* depth of nested ranges */
    double over_error;                /* largest relative error of integrals; the caller clears it */
    bool (*keyword)(const lexer *lx); /* is it a word that may follow a number? NULL: all may */
} calc;

void calc_init(calc *c, const volatile sig_atomic_t *stop);
void calc_free(calc *c);

/* A knob: an input or a user's name that is varied. */
typedef struct knob {
    bool is_input;
    input in;
    size_t name;
    dim d;
    char text[LEX_NAME];
} knob;

/* A knob with its value; the most that one `at` takes. */
enum { CHANGES = 8 };
typedef struct knob_value {
    knob p;
    long double v;
} knob_value;

/* A comparison of one scene with two values of a name. */
enum { COMPARED = 2 };
typedef struct side_by_side {
    bool on;
    knob by;
    long double with[COMPARED];
} side_by_side;

/* Is the cursor on `NAME = EXPR, ...`, `NAME := EXPR` or `NAME(X, ...) := EXPR`? calc_assign runs it. */
bool assign_at(const lexer *lx);
bool calc_assign(calc *c, lexer *lx);
/* Parses the expression at the cursor as a definition of an input; the caller owns *out. */
bool calc_bind(calc *c, lexer *lx, input in, counted **out);
/* Does the scene use the input now? Else sets an error. */
bool calc_takes(const calc *c, input in, calc_error *error);

/* Can the two inputs be set together? Not if one replaces the other; the error is at the place given. */
bool calc_apart(input one, input other, size_t at, size_t len, calc_error *error);

/* Checks the dimension of a value; a bare 0 has any. */
bool value_dim(lexer *lx, const char *name, size_t at, size_t len, value v, dim d);

/* undo_begin and undo_end enclose statements that may change the scene; nested ones join the outer. */
void undo_begin(calc *c);
void undo_end(calc *c);
/* Saves the scene before a change. NULL: out of memory, and nothing may be changed. End with undo_scene,
 * which makes it an entry, or undo_unmark, which restores the scene. */
scene_mark *undo_mark(calc *c);
void undo_scene(calc *c, scene_mark *m);
void undo_unmark(calc *c, scene_mark *m);
/* Saves a name before a change, as an entry. False: out of memory. */
bool undo_name(calc *c, size_t name);
/* Removes the last entry; back: and reverts its change. */
void undo_pop(calc *c, bool back);
/* Reverts all changes since c->undo.group was `group`, within one statement. */
void undo_since(calc *c, unsigned long group);
/* Reverts the last change; false: there is none. */
bool calc_undo(calc *c);

/* Sets `ans`. */
void calc_answered(calc *c, value v);

/* Words from elsewhere in the field, each with a hint to what serves here: row i, or the hint of a word. */
const char *hint_name(size_t i); /* NULL after the last */
const char *hint_text(size_t i);
const char *hint_from(const char *word);

/* Writes "3 um", in a unit that fits. */
void calc_amount(dim d, long double v, int digits, char *text, size_t size);
/* The same with 6 digits, for messages. */
enum { CALC_VALUE_TEXT = 160 };
void calc_value_text(dim d, double v, char text[CALC_VALUE_TEXT]);
/* Writes the text of an error, once. */
void calc_word(const calc *c, calc_error *error);
/* Appends to the text of an error. */
LIKE_PRINTF(3, 4)
void calc_append(const calc *c, calc_error *error, const char *format, ...);

#endif
