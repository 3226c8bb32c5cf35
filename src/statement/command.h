/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of commands, from which dispatch, arguments, usage, help, completion and man page derive.
 * Declares all handlers; may use the other headers of this room. */
#ifndef STATEMENT_COMMAND_H
#define STATEMENT_COMMAND_H

#include "statement/reader.h"

/* Executes a statement. all: its clauses, the cursor behind them; the caller drops them. */
typedef bool command_run(shell *sh, lexer *lx, parsed *all);

typedef struct command {
    const char *name;
    command_run *run;
    bool reads;          /* it reads the statement itself: the cursor is behind the command word */
    const char *takes;   /* grammar behind the command word, see grammar.h; also its usage */
    const char *summary; /* one line */
    const char *help;    /* what it does; ends with an example as a transcript, indented by four */
    const char *keywords;
    const char *group;       /* heading of `help` above this row; NULL: the same as the row before */
    bool changes;            /* it changes the scene */
    bool keeps;              /* what it has changed is kept even if it fails */
    bool returns;            /* it goes back to an earlier scene: warnings are checked again */
    void (*print)(FILE *to); /* prints more help, from a table; or NULL */
} command;

/* The tables of commands and of holes (prompt/commands.c); a row without a name ends each. */
extern const command commands[];
extern const hole_row holes[];
/* Sets the tables that the functions below look up; called once, before any statement. */
void command_use(const command *rows, const hole_row *of);
const command *command_find(const char *name, size_t len); /* or NULL */
/* Row i, its name, and row i of the holes; NULL after the last. */
const command *command_row(size_t i);
const char *command_name(size_t i);
const hole_row *hole_at(size_t i);
/* The grammar of a command, and of `geometry` with the i-th shape. */
const grammar *command_form(const command *c);
const grammar *geometry_form(size_t i);
/* The grammar of such a row, parsed at the first call and cached. */
const grammar *grammar_made(const char *name, const char *shape, const char *takes, const char *summary);

/* Reports what a load command did: an event with the values of these quantities; `names` ends with NULL. */
void report_event(shell *sh, const char *event, const char *const *names);
/* Reads the `step` or `cycle` statement at the cursor, for `along`; does not run it. */
bool read_load(shell *sh, lexer *lx, load_step *step, cycle_extra *extra, counted *bound[INPUTS]);

/* The handlers, by file. */
/* scene_commands.c, load_commands.c */
command_run do_material, do_second, do_geometry, do_friction, do_rig, do_bulk, do_wear;
command_run do_press, do_step, do_cycle, do_follow, do_reset, do_undo;
/* view_commands.c, plot_commands.c, explain.c, accuracy_command.c */
command_run do_history, do_table, do_plot, do_animate, do_explain, do_accuracy, do_compare;
/* study_commands.c; fit_command.c, or without GSL study_none.c; loop_command.c, export_command.c */
command_run do_solve, do_maximize, do_minimize, do_uncertainty, do_fit, do_loop, do_export;
const char *export_name(size_t i);
const grammar *export_form(size_t i);
/* show.c, help.c, session_commands.c, demo.c, exercise.c, live_command.c */
command_run do_show, do_set, do_help, do_apropos, do_cite;
command_run do_save, do_record, do_replay;
command_run do_source, do_quit, do_demo, do_ask, do_live;

/* Runs the full-screen mode; script: a file to step through, or NULL. */
bool shell_live(shell *sh, const char *script, calc_error *error);

#endif
