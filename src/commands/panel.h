/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One figure at the cursor into one panel: expressions over a range, a figure of the table, or a map. */
#ifndef COMMANDS_PANEL_H
#define COMMANDS_PANEL_H

#include "commands/looks.h"
#include "commands/range.h"

/* Figures in motion. They are drawn once whole, which tells their units and the load that they follow, or the
 * input; then for each instant, states along the load up to it, and what is no state along a load as it
 * stands then. */
typedef struct motion {
    bool found;                     /* what to follow: */
    range over;                     /* a load, or an input over its range; it must stay where it is */
    trial *at;                      /* in the scene at an instant; NULL: the figures as a whole */
    double until;                   /* that instant */
    axis_unit unit[PLOT_PANELS][2]; /* the same in all frames */
} motion;

/* A figure as it has been said. */
typedef struct panel {
    const struct figure *figure; /* of the table; NULL: what has been said is all of it */
    said said;
    size_t at; /* in the statement */
} panel;

/* At the cursor, to the `|` or the end. */
bool panel_read(shell *sh, lexer *lx, const grammar *row, panel *out);
/* Does it say what it goes over? One of the table need not. */
bool panel_is_whole(panel *p);
/* A map: its values can be rows too, of which a share is run. */
bool panel_is_map(const lexer *lx, const panel *p);
bool panel_list(shell *sh, lexer *lx, panel *as);
/* Appends a panel; m: NULL where nothing moves. */
bool panel_draw(shell *sh, lexer *lx, panel *as, plot_figure *f, motion *m);

#endif
