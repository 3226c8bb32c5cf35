/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows of the table of commands, as it has been handed down: who runs, completes or explains statements asks
 * here, and knows no handler. */
#include "shell/command.h"

#include "shell/looks.h"

/* There is one program, and one table of it. */
static const command *all;
static size_t count;

void command_use(const command *rows) {
    all = rows;
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

bool argument_word(const lexer *lx) {
    static const char *const others[] = {"to",   "for",   "in",      "at",     "with",    "from",
                                         "over", "along", "against", "frames", "samples", "seed"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (lex_is(lx, others[i]))
            return true;
    for (size_t i = 0; looks_word(i); i++)
        if (lex_is(lx, looks_word(i)))
            return true;
    const command *c;
    for (size_t i = 0; (c = command_row(i)); i++)
        for (const arg *a = c->args; a && a->kind; a++)
            if (a->kind != ARG_VALUE && lex_is(lx, a->name))
                return true;
    return false;
}
