/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where GSL is left out, in place of study_commands.c, data_commands.c and smooth.c. */
#include "commands/study_commands.h"
#include "study/smooth.h"

const char study_library[] = " (without GSL: no solve, maximize, minimize, fit, uncertainty, smooth)";

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

bool smooth(const double *r, const double *f, size_t rows, smoothing how, file_stop stop, smooth_answer *out,
            calc_error *error) {
    (void)r, (void)f, (void)rows, (void)how, (void)stop;
    *out = (smooth_answer){.pieces = 0};
    return calc_fail(error, 0, 0, "smooth needs GSL, which this program was built without");
}

void smooth_free(smooth_answer *a) {
    (void)a;
}
