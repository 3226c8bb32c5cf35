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
    double plot_timeout;
} settings;

struct shell;
struct said;

typedef struct setting {
    const char *name;
    const char *takes; /* what may follow, see grammar.h */
    const char *summary;
    const char *example; /* of `help`: a transcript, indented by four */
    size_t at;           /* an int of settings that holds the number, or which word */
    /* where it is neither */
    bool (*apply)(struct shell *sh, lexer *lx, const struct said *all);
    void (*show)(const calc *c, const settings *set, FILE *to);
    bool (*differs)(const calc *c, const settings *set); /* from how it begins; NULL: not to be written */
} setting;

typedef enum setting_id {
    SETTING_FORMAT,
    SETTING_DIGITS,
    SETTING_REPORT,
    SETTING_TIMING,
    SETTING_PAGER,
    SETTING_MODEL,
    SETTING_PLOT,
    SETTING_CORES,
    SETTINGS
} setting_id;

extern const settings settings_initial;

const setting *setting_row(size_t i); /* NULL after the last */
const char *setting_name(size_t i);
const struct grammar *setting_form(size_t i);
const char *terminal_name(size_t i);
/* As it has been said; on error nothing has changed. */
bool setting_apply(struct shell *sh, lexer *lx, const struct said *all);
/* By its word. */
bool setting_format(settings *set, const char *word);
/* The settings that are not as they begin, but for the model, which belongs to the scene. */
void settings_write(const calc *c, const settings *set, FILE *to);
void setting_show(size_t i, const calc *c, const settings *set, FILE *to);

#endif
