/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What `export` writes for a dynamics code: a row a model. */
#ifndef COMMANDS_EXPORT_COMMAND_H
#define COMMANDS_EXPORT_COMMAND_H

#include "statement/command.h"

typedef struct export_model {
    const char *name;
    const char *takes; /* behind the name, see grammar.h */
    const char *summary;
    bool (*write)(shell *sh, lexer *lx, said *all);
} export_model;

const export_model *export_row(size_t i); /* NULL after the last */
const char *export_name(size_t i);
const grammar *export_form(size_t i);

#endif
