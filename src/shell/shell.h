/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The program around the language: statements in, answers and errors out. */
#ifndef SHELL_SHELL_H
#define SHELL_SHELL_H

#include <signal.h>
#include <stdio.h>

#include "calc/expr.h"

typedef enum format { FORMAT_TEXT, FORMAT_CSV, FORMAT_JSON } format;
typedef enum report { REPORT_AUTO, REPORT_OFF, REPORT_ON } report;

enum { EXIT_OK = 0, EXIT_ERROR = 1, EXIT_USAGE = 2, EXIT_INTERRUPTED = 130 };

typedef struct settings {
    format format;
    int digits;
    report report; /* auto: at the prompt only */
    bool timing;
    bool color;
    int plot_width, plot_height; /* 0: the terminal's, or the picture's default */
    double plot_timeout;
} settings;

typedef struct column column; /* output.h */

/* Where statements come from. */
typedef struct source {
    const char *name; /* for messages; NULL at the prompt and in a replay: messages have no place then */
    bool keep_going;
} source;

typedef struct shell {
    calc calc;
    settings set;
    FILE *out, *err;
    FILE *record;
    bool interactive, quit, failed;
    bool warned_dissimilar;
    int nesting;   /* of `source` */
    expr list[64]; /* expressions of a print, table or plot statement, reused */
} shell;

/* Set by the SIGINT handler. */
extern volatile sig_atomic_t shell_stop;

void shell_init(shell *sh, FILE *out, FILE *err);
void shell_free(shell *sh);

/* Runs one statement; the error is filled in on failure. */
bool shell_statement(shell *sh, const char *text, size_t len, calc_error *error);

/* Runs a logical line of several statements, reporting errors; false if one failed. `line` is the number
 * of its first physical line. */
bool shell_line(shell *sh, const source *from, const char *text, size_t len, size_t line);

/* Runs a stream to its end, or to the first error. Returns an exit status. */
int shell_stream(shell *sh, FILE *in, const char *name, bool keep_going);
/* fopen for reading that refuses a directory. */
FILE *shell_open(const char *path);
int shell_file(shell *sh, const char *path, bool keep_going);
/* Does the line end in a continuation mark? */
bool shell_continues(const char *text, size_t len);

/* prompt.c: the interactive session. */
int shell_prompt(shell *sh, bool quiet, bool read_rc);
/* replay.c: runs a transcript and compares; returns an exit status. */
int shell_replay(const char *path, double tolerance, FILE *out, FILE *err);

#endif
