/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads a figure and draws it in a panel: expressions over a range, a named figure, or a map. */
#ifndef COMMANDS_PANEL_H
#define COMMANDS_PANEL_H

#include "commands/looks.h"
#include "commands/range.h"

/* An animation. All figures are drawn once as a whole, which finds their units and the load or input that
 * they follow, then for each frame: a curve along a load up to then, others in the scene at that time. */
typedef struct motion {
    bool found;                     /* `over` has been found: */
    range over;                     /* a load, or the range of an input; take_frames sets its context */
    trial *trial;                   /* the scene of the frame; NULL: the figures are drawn as a whole */
    double until;                   /* the time of that frame */
    axis_unit unit[PLOT_PANELS][2]; /* of the ordinate and abscissa of each panel, in all frames */
} motion;

/* A figure as the statement gives it. */
typedef struct panel {
    const struct figure *figure; /* the named figure; NULL: `parsed` has expressions */
    parsed parsed;
    size_t at; /* its place in the statement */
} panel;

/* Reads a figure from the cursor to the `|` or the end. */
bool panel_read(shell *sh, lexer *lx, const grammar *row, panel *out);
/* Has it a range? A named figure need not give one. */
bool panel_is_whole(panel *p);
/* Is it a map? panel_list writes its values as a table, of which a share can be run. */
bool panel_is_map(const lexer *lx, const panel *p);
bool panel_list(shell *sh, lexer *lx, panel *as);
/* Appends the figure to f as a panel; m: of an animation, else NULL. */
bool panel_draw(shell *sh, lexer *lx, panel *as, plot_figure *f, motion *m);

#endif
