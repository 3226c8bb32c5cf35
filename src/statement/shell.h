/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The program around the language: statements in, answers and errors out. */
#ifndef STATEMENT_SHELL_H
#define STATEMENT_SHELL_H

#include <signal.h>
#include <stdio.h>

#include "language/calc.h"
#include "statement/settings.h"
#include "text/file.h"

enum { EXIT_OK = 0, EXIT_ERROR = 1, EXIT_USAGE = 2, EXIT_INTERRUPTED = 130 };

/* Where statements come from. */
typedef struct source {
    const char *name; /* for messages; NULL at the prompt and in a replay: messages have no place then */
    bool keep_going;
} source;

/* Share `number` of the rows of a run, of so many; 0: it is no share. What is said before the rows comes in
 * the first share, and after them in the last, so that all of them in their order are what the whole run
 * writes. */
typedef struct run_share {
    unsigned number, of;
    bool met; /* what has rows to share */
    FILE *out;
} run_share;

enum { EXPRESSIONS = 40 };

typedef struct shell {
    calc calc;
    settings set;
    bool keep_going; /* after an error in a script */
    FILE *out, *err;
    run_share share; /* --part */
    bool interactive, quit;
    bool waits;              /* a lesson that waits for who plays it: it asks */
    bool lost;               /* a recording could not be written */
    bool stopped, refused;   /* there was an error of that kind */
    bool replaying;          /* a transcript: see shell_aside */
    struct recorder *record; /* or NULL */
    file_text typed;         /* at the prompt, for `save history`; else closed */
    unsigned warned;         /* of what holds still, see warnings.c */
    bool widest_known;       /* the press from which on it is too wide: */
    fret_press widest;
    /* The scene as statements, handed down by who can write it: see show.h. */
    bool (*write_scene)(struct shell *sh, FILE *to, bool whole);
    side_by_side compared;  /* by live */
    int nesting;            /* of `source` and `replay` */
    struct fitted *fitted;  /* the last fit, for its figure; or NULL */
    expr list[EXPRESSIONS]; /* of a print, table or plot statement, reused */
} shell;

/* ---- say.c: what is said beside answers ---- */

/* Set by the SIGINT handler. */
extern volatile sig_atomic_t shell_stop;

/* Reports an error that has no place in a statement. */
void shell_error(shell *sh, const char *text);
/* `error: ...`, behind a place or not. */
void shell_print_error(const shell *sh, const char *text);
/* The stream that keeps nothing, which stays open; NULL with the error. */
FILE *shell_nowhere(calc_error *error);
/* Has whoever read standard output gone, as `head` does? That is no error to be told of. */
bool shell_unread(void);
/* Things to be told that are no errors, on standard error, `before` it what they are; a program that reads
 * answers finds them among them, as `kind`. */
LIKE_PRINTF(4, 5)
void shell_tell(shell *sh, const char *kind, const char *before, const char *format, ...);
#define shell_say(sh, ...) shell_tell(sh, "note", "", __VA_ARGS__)
#define shell_note(sh, ...) shell_tell(sh, "note", "note: ", __VA_ARGS__)
#define shell_warning(sh, ...) shell_tell(sh, "warning", "warning: ", __VA_ARGS__)

/* Is a line to be written that is for who types, and has no place in a script's output? In a replay it is,
 * after a mark: a transcript may have it or not. */
bool shell_aside(const shell *sh, FILE *to);
/* Marks of replays, first bytes of a line: an aside, and a drawing, which depends on the terminal. */
enum { MARK_ASIDE = 1, MARK_DRAWING };
/* A note on what was pasted begins so. */
#define PASTED "pasted: "
/* Is standard output a terminal that shows what the session writes? */
bool shell_on_terminal(const shell *sh);
/* Does the terminal obey escapes, as those of colours? Not a dumb one, nor one that nobody names. */
bool shell_escapes(void);

/* ---- warnings.c ---- */

/* After a change of the scene: warns of what has not been warned of yet. */
void shell_warn(shell *sh);
/* The same of bodies that are dissimilar alone: something tangential has been asked for. */
void shell_warn_dissimilar(shell *sh);
/* A step has been taken: says what no press has said, of bodies that are dissimilar, of a contact too wide.
 */
void shell_pressed(shell *sh, const load_step *step);

/* ---- run.c: statements, lines and streams ---- */

void shell_init(shell *sh, FILE *out, FILE *err);
void shell_free(shell *sh);

/* Runs one statement; the error is filled in on failure. */
bool shell_statement(shell *sh, const char *text, size_t len, calc_error *error);

/* Runs a logical line of several statements, reporting errors; false if one failed. `line` is the number
 * of its first physical line. */
bool shell_line(shell *sh, const source *from, const char *text, size_t len, size_t line);

/* Tells an error at its place in a line, as shell_line does. */
void shell_report(shell *sh, const source *from, const char *text, size_t len, size_t line, size_t at,
                  const calc_error *error);

/* Runs what can be read to its end, or to the first error, says so if it was interrupted, and closes it.
 * Returns an exit status. */
int shell_stream(shell *sh, file_in *in);
/* The file, `-` is standard input; or a text by that name. */
int shell_run(shell *sh, const char *path, const char *text);

/* ---- prompt.c, replay.c ---- */

/* The interactive session. */
int shell_prompt(shell *sh, bool quiet, bool read_rc);
/* Runs a transcript in a session of its own and compares, reports on the output of this one; returns an exit
 * status. error: why the transcript could not be run; empty: it has been. */
int shell_replay(const shell *sh, const char *path, double tolerance, calc_error *error);
/* `?WORD` and `!COMMAND` as a line that a statement stands for; true: it was one of them, and has
 * been run. */
bool shell_special(shell *sh, const source *from, const char *text);

#endif
