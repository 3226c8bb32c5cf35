/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reading a statement by what its row takes: which clauses have been said, and what stands in their holes.
 * Numbers, words and arguments are read at once; expressions, spans and names of files are found, as parts of
 * the statement for their command to read. Changes nothing but which names are known. */
#ifndef STATEMENT_READER_H
#define STATEMENT_READER_H

#include "language/calc.h"
#include "statement/grammar.h"
#include "statement/shell.h"

/* ---- at the cursor ---- */

/* Nothing may follow. */
bool at_end(lexer *lx);
/* Is it a word that may follow a number: one that the table of commands names, or of a range? In command.c.
 */
bool argument_word(const lexer *lx);

/* ---- what has been said ---- */

/* A part of the statement. */
typedef struct span {
    size_t at, len;
} span;

/* What has been said for one clause of the row. */
typedef struct heard {
    const clause *of;
    size_t at, len; /* of the word, or the name */
    span hole[CLAUSE_HOLES];
    bool increment;
    value v;       /* of an argument, a value or a number of seconds */
    counted *live; /* of an argument, to be taken over or dropped */
    unsigned count;
    size_t choice;
} heard;

/* How what stands in a hole ends: what follows. */
typedef enum part_end {
    PART_EMPTY,  /* all of it */
    PART_VALUE,  /* a value, as behind + */
    PART_NAME,   /* a name, behind `at` */
    PART_UNIT,   /* a unit, behind `in` */
    PART_NUMBER, /* nothing, or the unit of a number */
    PART_WHOLE   /* nothing */
} part_end;

enum { HEARD = 40, FILE_NAME = 4096 };
typedef struct said {
    const grammar *by; /* of the row, or of the word that stands first, where that has its own */
    size_t row;        /* the place of that word in its table */
    bool wakes;   /* names of its own, unknown before, stand behind what uses them: known until said_drop */
    size_t names; /* of the session, before */
    unsigned count;
    heard list[HEARD]; /* in their order */
    const heard *open; /* the last of them, where it has a hole: that hole, and how it ends */
    unsigned hole;
    part_end end;
    span changed; /* the NAME of `NAME =` whose value it ends with; len 0: none */
} said;

/* Nothing has been said of the row so far. */
static inline void said_begin(said *s, const grammar *f) {
    s->by = f;
    s->wakes = false;
    s->count = 0;
    s->open = NULL;
}
/* All to the end of the statement, the cursor behind the command word. */
bool said_read(shell *sh, lexer *lx, const grammar *f, said *out);
/* The same as far as the row goes, and the end behind it: no comma, no word misspelt. Of a statement that is
 * cut nothing is evaluated, and `out` tells where it ends if said_cut(lx), whatever comes back. */
bool said_read_some(shell *sh, lexer *lx, const grammar *f, said *out);
bool said_cut(const lexer *lx);
/* May the clause come, or come again, behind those that have been said? Else an error says why not. */
bool said_may_come(const lexer *lx, const said *s, const clause *a);
bool said_end(lexer *lx, const said *s);
/* What is live goes, unless it has been taken over, and what became known. */
void said_drop(shell *sh, said *s);
/* The names alone, where another statement comes between; and known again. */
void said_sleep(shell *sh, said *s);
bool said_wake(shell *sh, const lexer *lx, said *s);

/* Is the word of a clause within an expression instead, where something is missing before it? Then an error
 * says so. */
bool said_hides(const lexer *lx, const said *s, const char *word);

/* The name at the cursor becomes known, until said_drop of what wakes; before: how many names there were. */
bool names_wake(shell *sh, const lexer *lx, size_t before);

/* The i-th time that the clause of this name has been said, or NULL; "" is what stands first. */
heard *said_of(said *s, const char *name, size_t i);
/* A lexer over the hole alone, at its beginning. */
lexer hole_lexer(const lexer *lx, const span *part);
/* The word that stands first there; empty where it is longer than any name. */
void hole_word(const lexer *lx, const heard *h, char word[LEX_NAME]);
/* The name of a file that stands there: of FILE. */
void hole_file(const lexer *lx, const span *part, char name[FILE_NAME]);
/* Points the error, where it has no place, at the first hole. */
#define heard_place(error, h) calc_place(error, (h)->hole[0].at, (h)->hole[0].len)

#endif
