/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The session: it reads statements and writes answers and errors. May use `language` and `text`. */
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
    const char *name; /* for error messages; NULL at the prompt and in a replay: they name no place */
    bool keep_going;  /* after an error */
} source;

/* The share `--part number/of` of a run computes only some rows of the one table or map, or some samples of
 * the one uncertainty; of == 0: no share. The first share also writes the output before those rows, the last
 * the output after them, so that all shares joined in order are the output of the whole run. */
typedef struct run_share {
    unsigned number, of;
    bool met;  /* that table, map or uncertainty has been reached */
    FILE *out; /* the session's output; shell.out discards everything outside the share */
} run_share;

enum { EXPRESSIONS = 40 };

struct shell;
/* What a learner wishes at a step of a lesson. STOP: the program, until it is continued. */
typedef enum wish { GO_ON, GO_BACK, LEAVE, STOP } wish;
typedef wish ask_wish(struct shell *sh, unsigned step);

typedef struct shell {
    calc calc;
    settings set;
    bool keep_going; /* after an error in a script */
    FILE *out, *err;
    run_share share; /* --part */
    bool interactive, quit;
    bool on_screen;          /* the full-screen mode shows results: `set report auto` reports nothing */
    bool waits;              /* a lesson is played step by step: `ask` waits for the user's guess */
    bool lost;               /* a recording could not be written */
    bool stopped, refused;   /* an error of that kind (calc_error) has occurred */
    bool replaying;          /* a transcript: see shell_aside */
    ask_wish *replayed;      /* finds in the transcript what was wished; or NULL */
    struct recorder *record; /* or NULL */
    file_text typed;         /* lines typed at the prompt, for `save history`; closed in other sessions */
    unsigned warned;         /* bits of the warnings given that still hold, see warnings.c */
    /* Writes the scene as statements (scene_write); a callback, since the function is in a room above. */
    bool (*write_scene)(struct shell *sh, FILE *to, bool whole);
    side_by_side compared;  /* what `compare` sets and `live` shows */
    int nesting;            /* depth of `source` */
    struct fitted *fitted;  /* the last fit, for its figure; or NULL */
    expr list[EXPRESSIONS]; /* storage of a statement's expressions, reused by the next statement */
} shell;

/* ---- say.c: notes, warnings and errors ---- */

/* Set by the SIGINT handler. */
extern volatile sig_atomic_t shell_stop;

/* Reports an error that has no place in a statement. */
void shell_error(shell *sh, const char *text);
/* Writes `error: TEXT` to sh->err; a caller that knows the place in a script writes it first. */
void shell_print_error(const shell *sh, const char *text);
/* A stream that discards what is written (/dev/null); it stays open. NULL with the error. */
FILE *shell_nowhere(calc_error *error);
/* Has the reader of standard output closed the pipe, as `head` does? Such a write error is not reported. */
bool output_closed(void);
/* Writes a message that is no error to standard error, after the prefix `before`; in JSON also among the
 * answers, as an object of this kind ("note", "warning"). */
LIKE_PRINTF(4, 5)
void shell_tell(shell *sh, const char *kind, const char *before, const char *format, ...);
#define shell_say(sh, ...) shell_tell(sh, "note", "", __VA_ARGS__)
#define shell_note(sh, ...) shell_tell(sh, "note", "note: ", __VA_ARGS__)
#define shell_warning(sh, ...) shell_tell(sh, "warning", "warning: ", __VA_ARGS__)

/* Should a line that only helps a user at the prompt be written? True at the prompt, and in a replay after
 * writing a mark to `to`: the transcript may have the line or not. */
bool shell_aside(const shell *sh, FILE *to);
/* First bytes of lines in a replay: MARK_ASIDE as above, MARK_DRAWING: depends on the terminal. */
enum { MARK_ASIDE = 1, MARK_DRAWING };
/* The beginning of a note on pasted text. */
#define PASTED "pasted: "
/* Is the session's output shown on a terminal (standard output)? */
bool shell_on_terminal(const shell *sh);
/* Does the terminal named by TERM obey escape sequences such as colours? Not "dumb", "unknown" or unset. */
bool shell_escapes(void);

/* ---- warnings.c ---- */

/* Called after a change of the scene: gives the warnings that hold and have not been given yet. */
void shell_warn(shell *sh);
/* The warning of elastically dissimilar bodies alone: for statements that ask for something tangential. */
void shell_warn_dissimilar(shell *sh);
/* Called after a load step: the warnings of dissimilar bodies, yield, and a contact too wide. */
void shell_warn_load(shell *sh, const load_step *step);

/* ---- prompt/run.c: statements, lines and streams ---- */

void shell_init(shell *sh, FILE *out, FILE *err);
void shell_free(shell *sh);

/* Runs one statement; the error is filled in on failure. */
bool shell_statement(shell *sh, const char *text, size_t len, calc_error *error);

/* Runs a logical line, which begins at line number `line`, and reports errors; false: a statement failed. */
bool shell_line(shell *sh, const source *from, const char *text, size_t len, size_t line);

/* Reports an error at byte `at` of a line, as shell_line does. */
void shell_report(shell *sh, const source *from, const char *text, size_t len, size_t line, size_t at,
                  const calc_error *error);

/* Runs `in` to its end, or to an error unless sh->keep_going, and closes it. Returns an exit status. */
int shell_stream(shell *sh, file_in *in);
/* Runs the file (`-`: standard input), or `text` if it is not NULL; `path` names it in messages. */
int shell_run(shell *sh, const char *path, const char *text);

/* ---- prompt/prompt.c, prompt/replay.c ---- */

/* The interactive session. Returns an exit status. */
int shell_prompt(shell *sh, bool quiet, bool read_rc);
/* Runs a transcript in a session of its own, compares the answers, and reports on the output of `sh`.
 * Returns an exit status; error: set if the transcript could not be run. */
int shell_replay(const shell *sh, const char *path, double tolerance, calc_error *error);
/* Runs a line as typed at the prompt: of statements, `?WORD` (help) or `!COMMAND` (system). */
void shell_typed(shell *sh, const char *text, size_t len, size_t line);

#endif
