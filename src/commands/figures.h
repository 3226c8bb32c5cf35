/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The one table of figures: each is a plot that could be typed, and how it looks. */
#ifndef COMMANDS_FIGURES_H
#define COMMANDS_FIGURES_H

#include "commands/looks.h"
#include "statement/reader.h"

typedef struct figure {
    const char *name;
    const char *title;
    const char *summary;
    const char *statement; /* EXPR, ... [against EXPR] RANGE [looks]; NULL: build makes it */
    const char *instead;   /* of the statement, where `when` says so; or NULL */
    bool (*when)(const inputs *in, bool compared); /* with others: `with` has been said */
    const char *marks; /* quantities of one letter, lengths, that its abscissa bears; or NULL */
    /* of the expressions: c curve, t thin line, b edge of a band (two of them), s curve that slips where it
     * is at its bounds, which follow */
    const char *roles;
    const char *takes; /* behind its name; NULL: a range and looks */
    bool (*build)(shell *sh, lexer *lx, said *all, plot_panel *p, const looks *l);
    bool (*below)(shell *sh, lexer *lx, said *all, plot_panel *p,
                  const looks *l); /* a second panel, or NULL */
} figure;

const figure *figure_row(size_t i); /* NULL after the last */
const char *figure_name(size_t i);
const grammar *figure_form(size_t i); /* NULL: that of plot */
const char *figure_word(size_t i);    /* what a figure may begin with: these, and map */
const figure *figure_find(const char *name, size_t len);

/* figures that are no sweep: accuracy_command.c; fit_command.c, without GSL study_none.c */
bool figure_accuracy(shell *sh, lexer *lx, said *all, plot_panel *p, const looks *l);
bool figure_fit(shell *sh, lexer *lx, said *all, plot_panel *p, const looks *l);
bool figure_fit_residuals(shell *sh, lexer *lx, said *all, plot_panel *p, const looks *l);
void fit_forget(shell *sh);

/* What --version says of it, behind its own; empty: nothing. */
extern const char study_library[];

#endif
