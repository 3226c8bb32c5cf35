/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Looks up rows of the table of commands, which main hands down: the code that runs, completes or explains
 * statements needs no handler's name. */
#include "statement/command.h"

#include <assert.h>

/* Set once by command_use. */
static const command *all;
static const hole_row *all_holes;
static size_t count; /* of `all` */

void command_use(const command *rows, const hole_row *of) {
    all = rows;
    all_holes = of;
    for (count = 0; rows[count].name; count++)
        ;
}

const command *command_row(size_t i) {
    return i < count ? &all[i] : NULL;
}

const char *command_name(size_t i) {
    return i < count ? all[i].name : NULL;
}

const command *command_find(const char *name, size_t len) {
    static word_index words = {.name = command_name};
    size_t row;
    return word_find(&words, name, len, &row) ? &all[row] : NULL;
}

const hole_row *hole_at(size_t i) {
    return all_holes[i].name ? &all_holes[i] : NULL; /* callers ask for i in order */
}

/* ---- grammars ---------------------------------------------------------------------------------- */

enum { ROWS = 128, COMMANDS = 64 };

const grammar *grammar_made(const char *name, const char *shape, const char *takes, const char *summary) {
    static grammar made[ROWS];
    static size_t rows;
    const char *at;
    for (size_t i = 0; i < rows; i++)
        if (made[i].takes == takes && made[i].command == name && made[i].shape == shape)
            return &made[i];
    made[rows] = (grammar){.command = name, .shape = shape, .takes = takes, .summary = summary};
    const bool ok = grammar_parse(&made[rows], all_holes, &at) && rows + 1 < ROWS;
    assert(ok); /* unreached: a test parses every row */
    (void)ok;
    return &made[rows++];
}

const grammar *command_form(const command *c) {
    static const grammar *forms[COMMANDS]; /* faster than the search in grammar_made: every statement asks */
    const grammar **f = &forms[c - all];
    if (!*f)
        *f = grammar_made(c->name, NULL, c->takes, c->summary);
    return *f;
}

const grammar *geometry_form(size_t i) {
    const geometry *g = geometry_row(i);
    return g ? grammar_made("geometry", g->name, g->takes, g->meaning) : NULL;
}

bool argument_word(const lexer *lx) {
    const command *c;
    if (lex_is(lx, "in") || lex_is(lx, "at"))
        return true;
    for (size_t i = 0; (c = command_row(i)); i++) {
        const grammar *f = command_form(c);
        for (const clause *a = f->clause; a < f->clause + f->count; a++)
            if (!a->argument && lex_is(lx, a->name))
                return true;
    }
    return false;
}
