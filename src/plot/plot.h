/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Figures through gnuplot: to the terminal as text, or to a file. */
#ifndef PLOT_PLOT_H
#define PLOT_PLOT_H

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

typedef struct plot_series {
    char *title;
    double *x, *y;
    size_t count, room;
} plot_series;

enum { PLOT_SERIES = 24, PLOT_LABEL = 160 };

typedef struct plot_figure {
    char title[PLOT_LABEL], xlabel[PLOT_LABEL], ylabel[PLOT_LABEL];
    bool logx, logy;
    bool points; /* marked on the lines */
    size_t count;
    plot_series series[PLOT_SERIES];
} plot_figure;

/* Where a figure goes. */
typedef struct plot_target {
    const char *file; /* .png .svg .pdf or .gp; NULL: text to out */
    FILE *out;
    int width, height; /* of the terminal in characters, or of the picture in pixels (0: default) */
    double timeout;    /* seconds */
    const volatile sig_atomic_t *stop;
} plot_target;

/* False if out of memory. */
bool plot_point(plot_series *series, double x, double y);
bool plot_title(plot_series *series, const char *title);
void plot_free(plot_figure *figure);

/* Can a picture go to the file? To be asked before long work. */
bool plot_check(const char *file, char *error, size_t size);

/* Draws; on failure writes a message and leaves no file behind. */
bool plot_draw(plot_figure *figure, const plot_target *target, char *error, size_t size);

#endif
