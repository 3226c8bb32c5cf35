/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A page of text: where the frame of a panel, its tics, its texts and its key lie, and which cells its curves
 * touch. sheet.c draws it, dumb.c has it drawn. */
#ifndef PLOT_PAGE_H
#define PLOT_PAGE_H

#include "plot/script.h"

enum {
    PAGE_TICS = 24,
    PAGE_TIC = 24,
    PAGE_LEVELS = 9,
    PAGE_SIGN = 16,
    PAGE_ENTRIES = PLOT_CURVES + PAGE_LEVELS
};

/* Inks: the terminal's own is 0, then those of curves in turn. */
enum { PAGE_COLORS = 7, PAGE_GRAY };

/* An axis over the cells 0 .. cells of the frame, with its tics. */
typedef struct page_ruler {
    plot_axis axis;
    int cells, count;
    size_t width; /* of the widest tic text */
    double at[PAGE_TICS];
    char text[PAGE_TICS][PAGE_TIC];
} page_ruler;

/* In cells from the lower or left end, and back. */
double page_cell(const page_ruler *r, double v);
double page_value(const page_ruler *r, double cell);

/* Of the key. */
typedef struct page_entry {
    char sign[PAGE_SIGN];
    unsigned char ink;
    char *text;
    int column, text_column, row; /* row < 0: there is no room */
} page_entry;

/* Rows and columns count from the left top. */
typedef struct plot_page {
    const plot_panel *panel;
    plot_form form;
    bool braille;                 /* lines are of dots, else of characters */
    int columns, rows;            /* rows: no more than are used */
    int left, right, top, bottom; /* room around the frame */
    page_ruler x, y;
    char *head, *foot; /* the line above; the name of the axis below */
    int head_column;
    page_entry entry[PAGE_ENTRIES];
    size_t entries;
    bool key_right; /* else below */
    int key_rows;
    double level[PAGE_LEVELS];
    size_t levels;
} plot_page;

/* False with the error, and nothing is to be freed. */
bool page_make(plot_page *g, const plot_panel *panel, const plot_extents *extent, const plot_target *target,
               const plot_pages *pages, calc_error *error);
void page_free(plot_page *g);

/* Where a word within the frame begins. */
void page_word(const plot_page *g, size_t i, int *column, int *row);
/* What is drawn in the frame, on its cells, from below: the levels of a map, then the series. False: out of
 * memory. */
bool page_trace(const plot_page *g, const plot_cells *frame);

#endif
