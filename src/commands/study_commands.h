/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Commands that ask backwards, and the rows of their arguments in the table of commands. */
#ifndef COMMANDS_STUDY_COMMANDS_H
#define COMMANDS_STUDY_COMMANDS_H

#include "statement/command.h"

/* study_commands.c; fit_command.c, or without GSL study_none.c */
command_run do_solve, do_maximize, do_minimize, do_fit, do_uncertainty;
/* What `plot fit` shows. */
void fit_forget(shell *sh);
/* export_command.c, loop_command.c */
command_run do_export, do_loop;

/* What --version says of it, behind its own; empty: nothing. */
extern const char study_library[];

#endif
