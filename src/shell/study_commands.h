/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Commands that ask backwards, and the rows of their arguments in the table of commands. */
#ifndef SHELL_STUDY_COMMANDS_H
#define SHELL_STUDY_COMMANDS_H

#include "shell/command.h"

#ifndef FRET_WITHOUT_GSL
command_run do_solve, do_maximize, do_minimize, do_fit, do_uncertainty;
#endif
/* jenkins_command.c */
command_run do_export;

#endif
