/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of figures, and those that no sweep can draw. */
#include "commands/figures.h"

#include <stdlib.h>
#include <string.h>

#include "commands/accuracy_command.h"
#include "statement/command.h"

static const figure figures[] = {
    {.name = "loop",
     .title = "hysteresis loop",
     .summary = "Fx against dx along the load program",
     .statement = "Fx against dx along program"},
    {.name = "pressure",
     .title = "contact pressure",
     .summary = "p(r)",
     .statement = "p(r) for r = 0 m .. 1.25*a"},
    {.name = "traction",
     .title = "tangential traction between its bounds",
     .summary = "qx(r) between mu p(r) and its negative",
     .statement = "qx(r), mu*p(r), -mu*p(r) for r = 0 m .. 1.25*a",
     .roles = "cbb"},
    {.name = "springs",
     .title = "springs between their bounds",
     .summary = "u1D(x) between its bounds, stick and slip told apart",
     .statement = "u1D(x), mu*eta*w1D(x), -mu*eta*w1D(x) for x = -1.25*a .. 1.25*a",
     .roles = "sbb"},
    {.name = "dissipation",
     .title = "energy dissipated per cycle",
     .summary = "dW against the amplitude, up to gross slip",
     .statement = "dW(F_A) for F_A = 0 N .. mu*FN"},
    {.name = "load",
     .title = "load path",
     .summary = "Fx against FN between the limits of friction",
     .statement = "Fx, mu*FN, -mu*FN against FN along program",
     .roles = "ctt"},
    {.name = "gap",
     .title = "gap f and equivalent profile g",
     .summary = "f(r) and g(r)",
     .statement = "f(r), g(r) for r = 0 m .. 1.25*a"},
    {.name = "E",
     .title = "modulus over depth",
     .summary = "E(z)/E0, the depth downward",
     .statement = "z/c0 against E(z)/E0 for z = 0 m .. 2*c0 flip y xrange 0 .. 2.5",
     .without_c0 = "z against E(z)/E0 for z = 0 mm .. 1 mm flip y xrange 0 .. 2.5"},
    {.name = "accuracy",
     .title = "error against time",
     .summary = "of every model, for this scene",
     .takes = "[FA=20 N | dxA=0.5 um] [within SECONDS:3600] LOOK [frames N:1000] [to FILE]",
     .build = figure_accuracy},
};
enum { FIGURES = sizeof figures / sizeof *figures };

const figure *figure_row(size_t i) {
    return i < FIGURES ? &figures[i] : NULL;
}

const char *figure_name(size_t i) {
    return i < FIGURES ? figures[i].name : NULL;
}

const char *figure_word(size_t i) {
    return i == FIGURES ? "map" : figure_name(i);
}

const figure *figure_find(const char *name, size_t len) {
    size_t i;
    return word_among(figure_name, name, len, &i) ? &figures[i] : NULL;
}

const grammar *figure_form(size_t i) {
    static grammar forms[FIGURES];
    return grammar_made(&forms[i], "plot", figures[i].name,
                        figures[i].takes ? figures[i].takes : "RANGE LOOK [to FILE]");
}

/* Error against time, one curve a model. */
bool figure_accuracy(shell *sh, lexer *lx, said *all, plot_panel *p, const looks *l) {
    static const axis_of time = {.name = "time of a cycle [s]"}, loss = {.name = "relative error"};
    static const axis_unit plain = {.scale = 1};
    accuracy_study study;
    char text[400], load[360];
    plot_series *series = NULL;
    if (!accuracy_study_run(sh, all, &study, lx->error))
        return false;
    for (size_t i = 0; i < study.count; i++) {
        const accuracy_row *row = &study.row[i];
        if (i == 0 || row->family != row[-1].family)
            series = plot_series_add(p, PLOT_CURVE, families[row->family].name, lx->error);
        if (!series)
            return false;
        if (!plot_point(series, row->seconds, (double)row->error))
            return calc_no_memory(lx->error);
    }
    accuracy_load_text(sh, &study, load, sizeof load);
    snprintf(text, sizeof text, PLOT_EXPR "dW, %s" PLOT_END, load);
    p->title = p->title ? p->title : strdup(text);
    p->xlabel = p->xlabel ? p->xlabel : strdup(time.name);
    p->ylabel = p->ylabel ? p->ylabel : strdup(loss.name);
    if (!p->title || !p->xlabel || !p->ylabel)
        return calc_no_memory(lx->error);
    p->logx = p->logy = p->points = p->airy = true;
    return looks_lay_over(lx, l, p, &time, &loss) && looks_axis(lx, l, p, true, &time, &plain) &&
           looks_axis(lx, l, p, false, &loss, &plain);
}
