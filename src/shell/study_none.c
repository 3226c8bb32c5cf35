/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where GSL is left out, in place of study_commands.c and data_commands.c. */
#include "shell/study_commands.h"

const char study_library[] = "without GSL: no solve, maximize, minimize, fit, uncertainty";

static bool without(lexer *lx, const command *self) {
    return calc_fail(lx->error, 0, 0, "%s needs GSL, which this program was built without", self->name);
}

bool do_solve(shell *sh, lexer *lx, const command *self) {
    (void)sh;
    return without(lx, self);
}

bool do_maximize(shell *sh, lexer *lx, const command *self) {
    (void)sh;
    return without(lx, self);
}

bool do_minimize(shell *sh, lexer *lx, const command *self) {
    (void)sh;
    return without(lx, self);
}

bool do_fit(shell *sh, lexer *lx, const command *self) {
    (void)sh;
    return without(lx, self);
}

bool do_uncertainty(shell *sh, lexer *lx, const command *self) {
    (void)sh;
    return without(lx, self);
}
