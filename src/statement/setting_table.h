/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The one table of settings: `set`, `show settings`, completion and help derive from it. */
#ifndef STATEMENT_SETTING_TABLE_H
#define STATEMENT_SETTING_TABLE_H

#include "statement/command.h"

typedef struct setting {
    const char *name;
    const char *takes; /* what may follow, see grammar.h */
    const char *summary;
    const char *example; /* of `help`: a transcript, indented by four */
    size_t at;           /* an int of the shell that holds the number, or which word */
    int initial;         /* of it */
    /* where it is neither */
    bool (*apply)(shell *sh, lexer *lx, const said *all);
    void (*show)(const shell *sh, FILE *to);
    bool (*differs)(const shell *sh); /* from how it begins; NULL: not to be written */
} setting;

extern const settings settings_initial;

const setting *setting_row(size_t i); /* NULL after the last */
const char *setting_name(size_t i);
size_t setting_find(const char *name); /* there is such a row */
const grammar *setting_form(size_t i);
const char *terminal_name(size_t i);
const char *switch_name(size_t i);
/* As it has been said; on error nothing has changed. */
bool setting_apply(shell *sh, lexer *lx, const said *all);
/* By its word. */
bool setting_format(settings *set, const char *word);
/* The settings that are not as they begin, but for the model, which belongs to the scene. */
void settings_write(const shell *sh, FILE *to);
void setting_show(size_t i, const shell *sh, FILE *to);

#endif
