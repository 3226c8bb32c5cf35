/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The one table of settings: `set`, `show settings`, completion and help derive from it. */
#ifndef STATEMENT_SETTINGS_H
#define STATEMENT_SETTINGS_H

#include <stdio.h>

#include "language/calc.h"

typedef enum output_format { FORMAT_TEXT, FORMAT_CSV, FORMAT_JSON } output_format;
typedef enum pager_when { PAGER_AUTO, PAGER_OFF, PAGER_ON } pager_when;
typedef enum report_when { REPORT_AUTO, REPORT_OFF, REPORT_ON } report_when;

typedef struct settings {
    int format;
    int digits;
    int report; /* auto: at the prompt only */
    int timing;
    bool color, color_out; /* of errors, of figures in the terminal */
    int plot_terminal;     /* plot_terminal of plot.h */
    int pager;
    bool pages;                  /* there is a terminal to page on */
    int plot_width, plot_height; /* 0: the terminal's, or the picture's default */
} settings;

typedef struct setting {
    const char *name;
    const char *usage; /* what may follow */
    const char *summary;
    const char *example;      /* of `help`: a transcript, indented by four */
    const char *const *words; /* a choice among these, ended by NULL; or NULL */
    int most;                 /* of a whole number from 1, where there are no words */
    size_t at;                /* an int of settings that holds either */
    /* where it is neither; the model belongs to the scene */
    bool (*parse)(calc *c, settings *set, lexer *lx);
    void (*show)(const calc *c, const settings *set, FILE *to);
    bool (*differs)(const calc *c, const settings *set); /* from how it begins; NULL: not to be written */
} setting;

extern const settings settings_initial;
/* By output_format, ended by NULL. */
extern const char *const format_names[];

const setting *setting_row(size_t i); /* NULL after the last */
const char *setting_name(size_t i);
/* `NAME VALUE` at the cursor; on error nothing has changed. */
bool setting_read(calc *c, settings *set, lexer *lx);
/* The settings that are not as they begin, but for the model, which belongs to the scene. */
void settings_write(const calc *c, const settings *set, FILE *to);
void setting_show(const setting *row, const calc *c, const settings *set, FILE *to);

#endif
