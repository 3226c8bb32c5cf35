/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Replaces fit_command, optimise, uncertainty and smooth in a program without GSL: an error each. */
#include "commands/figures.h"
#include "statement/command.h"
#include "study/optimise.h"
#include "study/smooth.h"
#include "study/uncertainty.h"

const char study_library[] = " (without GSL: no maximize, minimize, fit, uncertainty, smooth)";

static bool without(const char *what, calc_error *error) {
    return calc_fail(error, 0, 0, "%s needs GSL, which this program was built without", what);
}

bool do_fit(shell *sh, lexer *lx, parsed *all) {
    (void)sh;
    return without(all->by->command, lx->error);
}

void fit_forget(shell *sh) {
    (void)sh;
}

bool figure_fit(shell *sh, lexer *lx, parsed *all, plot_panel *p, const looks *l) {
    (void)sh, (void)all, (void)p, (void)l;
    return without("fit", lx->error);
}

bool figure_fit_residuals(shell *sh, lexer *lx, parsed *all, plot_panel *p, const looks *l) {
    return figure_fit(sh, lx, all, p, l);
}

bool uncertainty(const uncertainty_question *question, uncertainty_answer *out, calc_error *error) {
    (void)question, (void)out;
    return without("uncertainty", error);
}

bool optimise(const optimise_question *question, optimise_answer *out, calc_error *error) {
    (void)out;
    return without(question->most ? "maximize" : "minimize", error);
}

bool smooth(const double *r, const double *f, size_t rows, smoothing how, file_stop stop, smooth_answer *out,
            calc_error *error) {
    (void)r, (void)f, (void)rows, (void)how, (void)stop;
    *out = (smooth_answer){.pieces = 0};
    return without("smooth", error);
}

void smooth_free(smooth_answer *a) {
    (void)a;
}
