/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reading a statement by the grammar of its row: which clauses are given, and the text in their holes.
 * Numbers, words and arguments are evaluated at once; of expressions, spans and file names only the place is
 * found, and the command reads them. Changes nothing in the session but which names are known. */
#ifndef STATEMENT_READER_H
#define STATEMENT_READER_H

#include "language/calc.h"
#include "statement/grammar.h"
#include "statement/shell.h"

/* ---- at the cursor ---- */

/* Is the cursor at the end of the statement? Else an error. */
bool at_end(lexer *lx);
/* Is the cursor on a word that may follow a number: `in`, `at`, or a clause of any command? In command.c. */
bool argument_word(const lexer *lx);

/* ---- the clauses of a statement ---- */

/* A place in the text of the statement, in bytes. */
typedef struct span {
    size_t at, len;
} span;

/* One clause as a statement gives it. */
typedef struct given_clause {
    const clause *of;        /* its clause of the grammar */
    size_t at, len;          /* place of the clause's word, or of the argument's name */
    span hole[CLAUSE_HOLES]; /* place of the text in each hole */
    bool increment;          /* an argument given by += */
    value v;                 /* of an argument, HOLE_VALUE or HOLE_SECONDS */
    counted *live;           /* definition of an argument given by :=; parsed_drop releases it */
    unsigned count;          /* of HOLE_COUNT */
    size_t choice;           /* index of the word of HOLE_CHOICE */
} given_clause;

/* What is still missing, or may follow, where the text of a hole ends: for completion. */
typedef enum part_end {
    PART_EMPTY,  /* the hole is empty */
    PART_VALUE,  /* a value is missing, as behind + */
    PART_NAME,   /* a name is missing, behind `at` */
    PART_UNIT,   /* a unit is missing, behind `in` */
    PART_NUMBER, /* nothing is missing; the unit of a number may follow */
    PART_WHOLE   /* nothing is missing */
} part_end;

enum { GIVEN_CLAUSES = 40, FILE_NAME = 4096 };
/* A statement: all clauses that it gives. */
typedef struct parsed {
    const grammar *by; /* of the row, or of the word after the command (a shape), where that has its own */
    size_t row;        /* index of that word in its table */
    bool shows_names;  /* names of its own (`for NAME =`) have been made known: see parsed_show_names */
    size_t names;      /* how many names the session had before them */
    unsigned count;    /* of `list` */
    given_clause list[GIVEN_CLAUSES]; /* in the order of the statement */
    const given_clause
        *open;     /* the clause of the hole read last; NULL: none, or a clause without one came after */
    unsigned hole; /* index of that hole */
    part_end end;  /* how its text ends */
    span changed;  /* the NAME, where its text ends within the value of `NAME =`; len 0: it does not */
} parsed;

/* Begins an empty statement of this grammar. */
static inline void parsed_begin(parsed *s, const grammar *f) {
    s->by = f;
    s->shows_names = false;
    s->count = 0;
    s->open = NULL;
}
/* Reads the whole statement behind the command word (at the cursor). False with an error, after parsed_drop.
 */
bool parsed_read(shell *sh, lexer *lx, const grammar *f, parsed *out);
/* Reads clauses as far as they go, without a check of missing ones or of the rest. If lx->cut, nothing is
 * evaluated; if also parsed_at_cursor(lx) after it, out->open and below tell how the text ends, even on
 * false. */
bool parsed_read_some(shell *sh, lexer *lx, const grammar *f, parsed *out);
/* Is the cursor at the end of a text that is still being typed (lx->cut), behind all its tokens? */
bool parsed_at_cursor(const lexer *lx);
/* May the clause be given, or be given again, after those of `s`? Else an error. */
bool parsed_allows(const lexer *lx, const parsed *s, const clause *a);
/* Does the statement end at the cursor? Else an error: a misspelt word, an argument without its name, ... */
bool parsed_end(lexer *lx, const parsed *s);
/* Releases live definitions (a command that keeps one holds it), and forgets the statement's own names. */
void parsed_drop(shell *sh, parsed *s);
/* The statement's own names (`for NAME = ...`), which the session may not know: parsed_show_names makes them
 * known, so that its expressions can be parsed, parsed_hide_names forgets them. False: out of memory. */
void parsed_hide_names(shell *sh, parsed *s);
bool parsed_show_names(shell *sh, const lexer *lx, parsed *s);

/* Has an expression swallowed the word of a clause, as in `a*for FN = ..`? Then an error says so. */
bool parsed_swallowed(const lexer *lx, const parsed *s, const char *word);

/* Makes the name at the cursor known until parsed_hide_names of the statement whose `names` is `before`. */
bool names_show(shell *sh, const lexer *lx, size_t before);

/* The i-th clause of this name, or NULL; name "": the clause without a word, which stands first. */
given_clause *parsed_clause(parsed *s, const char *name, size_t i);
/* A lexer over the text of one hole. */
lexer hole_lexer(const lexer *lx, const span *part);
/* The text of the first hole; empty if it is longer than any name. */
void hole_word(const lexer *lx, const given_clause *h, char word[LEX_NAME]);
/* The text of a HOLE_TEXT without its quotation marks, to be freed. NULL with the error: out of memory. */
char *hole_text(const lexer *lx, const span *part);
/* The file name in a HOLE_FILE, without quotation marks. */
void hole_file(const lexer *lx, const span *part, char name[FILE_NAME]);
/* Points an error that has no place yet at the first hole; false. */
#define given_place(error, h) calc_place(error, (h)->hole[0].at, (h)->hole[0].len)

#endif
