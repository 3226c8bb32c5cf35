/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What `export` writes for a dynamics code: a row a model. */
#ifndef COMMANDS_EXPORT_COMMAND_H
#define COMMANDS_EXPORT_COMMAND_H

#include "statement/command.h"

const char *export_name(size_t i);
const grammar *export_form(size_t i);

#endif
