/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The layout of a panel as a page of text: the places of frame, tics, texts and key, and the cells that
 * curves touch. sheet.c draws a page, dumb.c writes a script by which gnuplot draws it. Depends on script.h.
 */
#ifndef PLOT_PAGE_H
#define PLOT_PAGE_H

#include "plot/script.h"

enum {
    PAGE_TICS = 24,  /* most tics of an axis */
    PAGE_TIC = 24,   /* bytes of a tic's text */
    PAGE_LEVELS = 9, /* most contours */
    PAGE_SIGN = 16,  /* bytes of a sign in the key */
    PAGE_ENTRIES = PLOT_CURVES + PAGE_LEVELS
};

/* Inks: 0 is the terminal's own, 1 to PAGE_COLORS those of curves. */
enum { PAGE_COLORS = 7, PAGE_GRAY };

/* An axis along cells 0 .. cells of the frame, and its tics. */
typedef struct page_ruler {
    plot_axis axis;
    int cells, count;
    size_t width; /* columns of the widest tic text */
    double at[PAGE_TICS];
    char text[PAGE_TICS][PAGE_TIC];
} page_ruler;

/* From a value to cells from the lower or left end, and back. */
double page_cell(const page_ruler *r, double v);
double page_value(const page_ruler *r, double cell);

/* An entry of the key. */
typedef struct page_entry {
    char sign[PAGE_SIGN];
    unsigned char ink;
    char *text;
    int column, text_column, row; /* row < 0: not shown for want of room */
} page_entry;

/* A page. Rows and columns count from the top left. */
typedef struct plot_page {
    const plot_panel *panel;
    plot_form form;
    bool braille;                 /* lines consist of braille dots, else of characters */
    int columns, rows;            /* size; rows: those used */
    int left, right, top, bottom; /* margins of the frame */
    page_ruler x, y;
    char *head, *foot; /* the line above the frame (label of y, title); the label of x */
    int head_column;
    page_entry entry[PAGE_ENTRIES];
    size_t entries;
    bool key_right;            /* the key is at the right, else below */
    int key_rows;              /* of a key below */
    double level[PAGE_LEVELS]; /* contours */
    size_t levels;
} plot_page;

/* Lays out a panel. False with the error; then there is nothing to free. */
bool page_make(plot_page *g, const plot_panel *panel, const plot_extents *extent, const plot_target *target,
               const plot_pages *pages, calc_error *error);
void page_free(plot_page *g);

/* The column and row where annotation i begins. */
void page_word(const plot_page *g, size_t i, int *column, int *row);
/* Draws contours and then the series on the cells of the frame, lower layers first. False: out of memory. */
bool page_trace(const plot_page *g, const plot_cells *frame);

#endif
