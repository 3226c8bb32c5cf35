/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of named figures. Most are a plot statement that a user could type, with a title and looks. */
#ifndef COMMANDS_FIGURES_H
#define COMMANDS_FIGURES_H

#include "commands/looks.h"
#include "statement/reader.h"

typedef struct figure {
    const char *name;
    const char *title;
    const char *summary;
    const char *statement; /* EXPR, ... [against EXPR] RANGE [looks]; NULL: `build` draws it */
    const char *instead;   /* the statement if when() is true; or NULL */
    bool (*when)(const inputs *in, bool compared); /* compared: `with NAME = ...` draws several curves */
    const char *marks; /* one-letter names of lengths marked on the abscissa ("ca"); or NULL */
    /* A letter for each expression: c curve; t thin line; b edge of a band (two of them); s curve in parts of
     * stick and of slip, where it reaches its bound, the next expression. */
    const char *roles;
    const char *takes; /* grammar behind its name, see grammar.h; NULL: a range and looks */
    bool (*build)(shell *sh, lexer *lx, parsed *all, plot_panel *p, const looks *l);
    bool (*below)(shell *sh, lexer *lx, parsed *all, plot_panel *p,
                  const looks *l); /* draws a second panel; or NULL */
} figure;

const figure *figure_row(size_t i); /* NULL after the last */
const char *figure_name(size_t i);
const grammar *figure_form(size_t i); /* NULL: its grammar is that of plot */
const char *figure_word(size_t i);    /* first words of figures: the names, then "map" */
const figure *figure_find(const char *name, size_t len);

/* Figures that are no sweep: in accuracy_command.c and fit_command.c (without GSL study_none.c) */
bool figure_accuracy(shell *sh, lexer *lx, parsed *all, plot_panel *p, const looks *l);
bool figure_fit(shell *sh, lexer *lx, parsed *all, plot_panel *p, const looks *l);
bool figure_fit_residuals(shell *sh, lexer *lx, parsed *all, plot_panel *p, const looks *l);
/* Frees the last fit. */
void fit_forget(shell *sh);

/* What --version adds if the program was built without GSL; else empty. */
extern const char study_library[];

#endif
