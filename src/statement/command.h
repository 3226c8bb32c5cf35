/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The one table of commands: dispatch, arguments, usage, help, apropos, completion and man page derive from
 * it. */
#ifndef STATEMENT_COMMAND_H
#define STATEMENT_COMMAND_H

#include "statement/reader.h"

/* all: what has been said, the cursor behind it; it is dropped by who calls. */
typedef bool command_run(shell *sh, lexer *lx, said *all);

typedef struct command {
    const char *name;
    command_run *run;
    bool reads;          /* by itself: the cursor is behind the command word */
    const char *takes;   /* behind the command word, see grammar.h: it is read by this, and its usage */
    const char *summary; /* one line */
    const char *help;    /* what it does; ends with an example as a transcript, indented by four */
    const char *keywords;
    const char *group;       /* of `help`, which begins with it; NULL: that of the row before */
    bool changes;            /* the scene */
    bool keeps;              /* what it has changed, where it fails too */
    bool returns;            /* to a scene as it was: what has been warned of may hold no more */
    void (*print)(FILE *to); /* more help, from a table */
} command;

/* The table, which knows all handlers, and the holes of its lines, ended by rows without a name. */
extern const command commands[];
extern const hole_row holes[];
/* Once, before any statement: what follows looks it up there. */
void command_use(const command *rows, const hole_row *of);
const command *command_find(const char *name, size_t len);
const command *command_row(size_t i); /* NULL after the last */
const char *command_name(size_t i);
const hole_row *hole_at(size_t i); /* likewise */
/* What it takes; what `geometry` takes behind the i-th shape. */
const grammar *command_form(const command *c);
const grammar *geometry_form(size_t i);
/* Parsed where it is wanted first. */
const grammar *grammar_made(const char *name, const char *shape, const char *takes, const char *summary);

/* What a command of the load reports: an event with these quantities, ended by NULL. */
void report_event(shell *sh, const char *event, const char *const *names);
/* The arguments of `step` or `cycle`, whose word the cursor is on: the load, not run; for `along`. */
bool read_load(shell *sh, lexer *lx, load_step *step, cycle_extra *extra, counted *bound[INPUTS]);

/* Rooms of handlers. */
/* scene_commands.c, load_commands.c */
command_run do_material, do_second, do_geometry, do_friction, do_rig, do_bulk, do_wear;
command_run do_press, do_step, do_cycle, do_follow, do_reset, do_undo;
/* view_commands.c, plot_commands.c, explain.c */
command_run do_history, do_table, do_plot, do_animate, do_explain, do_accuracy, do_compare;
/* study_commands.c; fit_command.c, or without GSL study_none.c; loop_command.c, export_command.c */
command_run do_solve, do_maximize, do_minimize, do_uncertainty, do_fit, do_loop, do_export;
const char *export_name(size_t i);
const grammar *export_form(size_t i);
/* show.c, help.c, session_commands.c, demo.c, exercise.c, live_command.c */
command_run do_show, do_set, do_help, do_apropos, do_cite;
command_run do_save, do_record, do_replay;
command_run do_source, do_quit, do_demo, do_ask, do_live;

/* The full-screen mode; script: a file to step through, or NULL. */
bool shell_live(shell *sh, const char *script, calc_error *error);

#endif
