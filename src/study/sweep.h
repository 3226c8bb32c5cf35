/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Expressions over a range of an input or a free name, or along a load: rows for tables and curves for plots.
 * Reads and prints nothing. */
#ifndef STUDY_SWEEP_H
#define STUDY_SWEEP_H

#include "study/points.h"

enum { SWEEP_VALUES = 20, SWEEP_LISTED = 100 };

/* One of the curves of a sweep in its own circumstances: the ends of its range, or its load. */
typedef struct sweep_range {
    long double lo, hi;
    size_t listed; /* values in place of an interval; 0: none */
    long double list[SWEEP_LISTED];
    dim d;
    load_step step; /* ALONG_LOAD */
    cycle_extra extra;
    counted *bound[INPUTS]; /* of its amplitudes, live */
} sweep_range;

/* Values of several names at once, as the columns of a table have them. */
enum { SWEEP_NAMES = 12 };
typedef struct sweep_rows {
    size_t names;
    const column_knob *column; /* no more than SWEEP_NAMES, borrowed */
} sweep_rows;

typedef struct sweep sweep;
struct sweep {
    bool along;
    knob var; /* for NAME = LO .. HI; along: called the time; at: of one name that, else the row */
    const sweep_rows *at; /* in place of a range, steps + 1 of them; or NULL */
    bool log;
    size_t steps;
    bool refine;     /* for: more points where a picture of it bends */
    bool turns;      /* along: at turning points too */
    along_what what; /* along */
    /* Evaluates the range where expressions see what this curve sees. */
    bool (*range)(const sweep *s, sweep_range *out, calc_error *error);
    void *context;
    /* with NAME = v1, v2, ..., or for NAME = LO .. HI a second time */
    knob with;
    size_t curves; /* at least 1; 0: no such name */
    long double value[SWEEP_VALUES];
    size_t value_at[SWEEP_VALUES], value_len[SWEEP_VALUES]; /* their places in the statement */
    const sweep *across;                                    /* of a grid, in place of these; or NULL */
    sweep_range ends;                                       /* of that one */
};

/* One row: x is the value of the name, or the time; a value that cannot be had is NaN. False ends the sweep.
 */
typedef bool sweep_row(void *context, const sweep *s, size_t curve, long double x, const long double *values);

typedef struct sweep_job {
    calc *c;
    const expr *expressions;
    size_t count; /* 0: whoever takes the rows looks at p.t->scene */
    dim *d;       /* of the expressions; those with known[i] must come out so */
    bool *known;
    const char *const *units; /* how those are called; NULL, or NULL each: in SI */
    size_t from, to;          /* the rows that are wanted of all; to = 0: all of them */
    sweep_row *row;
    void *context;
    calc_error *error;
    calc_error missing; /* the first value that could not be had: raised */
    char where[320];    /* of it */
    size_t values;      /* that could be had */
    points p;
    knob knobs[1 + SWEEP_NAMES]; /* that of `with`, if there is one, and those of the range */
    size_t before;               /* rows of the curves before */
} sweep_job;

/* Rows of all curves; along a load that lasts no time there are fewer. */
size_t sweep_length(const sweep *s);
/* False: an error; job->missing tells of gaps, which are none. An interrupt is an error, and so is a sweep
 * without any value, of which all rows are wanted. */
bool sweep_run(const sweep *s, sweep_job *job);

/* The value of the name of the curves. */
long double sweep_with(const sweep *s, size_t curve);

/* The values of a grid as they come, the first name running faster. */
typedef struct grid_values {
    size_t rows, across; /* of the first name, of the second */
    size_t count;        /* expressions */
    size_t at;           /* values of them so far */
    long double *a, *b, *v;
} grid_values;

/* As sweep_run, kept; to be freed whatever comes. */
bool grid_keep(const sweep *s, sweep_job *job, grid_values *out);
void grid_values_free(grid_values *values);

#endif
