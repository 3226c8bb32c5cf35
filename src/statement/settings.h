/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The values of `set`; setting_table.h has the table. Declares a type and uses nothing else. */
#ifndef STATEMENT_SETTINGS_H
#define STATEMENT_SETTINGS_H

#include <stdbool.h>

typedef enum output_format { FORMAT_TEXT, FORMAT_CSV, FORMAT_JSON } output_format;
typedef enum pager_when { PAGER_AUTO, PAGER_OFF, PAGER_ON } pager_when;
typedef enum report_when { REPORT_AUTO, REPORT_OFF, REPORT_ON } report_when;

typedef enum plot_paper_size { PAPER_USUAL, PAPER_SLIDE, PAPER_COLUMN } plot_paper_size;

typedef struct settings {
    int format; /* output_format */
    int digits;
    int report; /* report_when; auto: at the prompt only */
    int timing;
    bool color, color_out;       /* colours in errors; in figures in the terminal */
    int plot_terminal;           /* plot_terminal of plot.h */
    int pager;                   /* pager_when */
    bool pages;                  /* there is a terminal to page on */
    int plot_width, plot_height; /* in characters; 0: the terminal's */
    int plot_paper;              /* plot_paper_size: of pictures */
    int plot_caption;            /* scene and load are written below figures */
} settings;

#endif
