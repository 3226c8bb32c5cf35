/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The one table of settings: `set`, `show settings`, completion and help derive from it. */
#ifndef STATEMENT_SETTING_TABLE_H
#define STATEMENT_SETTING_TABLE_H

#include "statement/command.h"

typedef struct setting {
    const char *name;
    const char *takes; /* grammar behind the name, see grammar.h */
    const char *summary;
    const char *example; /* for `help`: a transcript, indented by four */
    size_t at;           /* offset in `shell` of an int: the number, or the index of the word */
    int initial;         /* its first value */
    /* for settings that are no int; apply sets it, show prints its value */
    bool (*apply)(shell *sh, lexer *lx, const parsed *all);
    void (*show)(const shell *sh, FILE *to);
    bool (*differs)(const shell *sh); /* from its first value; NULL: settings_write leaves it out */
} setting;

extern const settings settings_initial;

const setting *setting_row(size_t i); /* NULL after the last */
const char *setting_name(size_t i);
size_t setting_find(const char *name); /* its index; the name must be in the table */
const grammar *setting_form(size_t i);
const char *terminal_name(size_t i); /* words of TERMINAL in `set plot terminal` */
const char *switch_name(size_t i);   /* off, on */
/* Runs `set`; on error nothing has changed. */
bool setting_apply(shell *sh, lexer *lx, const parsed *all);
/* Sets the format named by the word; false: there is none. */
bool setting_format(settings *set, const char *word);
/* Writes a `set` statement for each setting that differs from its first value, but for the model. */
void settings_write(const shell *sh, FILE *to);
void setting_show(size_t i, const shell *sh, FILE *to);

#endif
