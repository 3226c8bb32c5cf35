/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Expressions over a range of a name or along a load: rows, curves. Depends on points.h; prints nothing. */
#ifndef STUDY_SWEEP_H
#define STUDY_SWEEP_H

#include "study/points.h"

enum { SWEEP_VALUES = 20, SWEEP_LISTED = 100 };

/* The range of one curve, evaluated for that curve, or its load. */
typedef struct sweep_range {
    long double lo, hi;
    size_t listed; /* number of values in `list`, which replaces lo .. hi; 0: none */
    long double list[SWEEP_LISTED];
    dim d;
    load_step step; /* for ALONG_LOAD, like extra and bound */
    cycle_extra extra;
    counted *bound[INPUTS]; /* live definitions of the amplitudes */
} sweep_range;

/* Values of several names at once, given by the columns of a table. */
enum { SWEEP_NAMES = 12 };
typedef struct sweep_rows {
    size_t names;
    const column_knob *column; /* at most SWEEP_NAMES, borrowed */
} sweep_rows;

typedef struct sweep sweep;
struct sweep {
    bool along; /* along a load, else over a range or over rows */
    knob var;   /* the name of the x axis: of the range; the time if along; with `at` the name or the row */
    const sweep_rows *at; /* steps + 1 rows in place of a range; or NULL */
    bool log;             /* the range in equal ratios */
    size_t steps;
    bool refine;     /* range: more points where a plot of it bends */
    bool turns;      /* along: rows at turning points too */
    along_what what; /* along: which load */
    /* Callback: evaluates the range or the load of the present curve in its scratch scene. */
    bool (*range)(const sweep *s, sweep_range *out, calc_error *error);
    void *context;
    /* The second name: with NAME = v1, v2, ..., or for NAME = LO .. HI a second time. */
    knob with;
    size_t curves; /* at least 1; 0: there is no second name */
    long double value[SWEEP_VALUES];
    size_t value_at[SWEEP_VALUES], value_len[SWEEP_VALUES]; /* places of the values in the statement */
    const sweep *across; /* a grid: the range of the second name, in place of the values; or NULL */
    sweep_range ends;    /* of `across` */
};

/* Callback: receives a row. x: value of the name, or time; a missing value is NaN. False ends the sweep. */
typedef bool sweep_row(void *context, const sweep *s, size_t curve, long double x, const long double *values);

typedef struct sweep_job {
    calc *c;
    const expr *expressions;
    size_t count; /* of expressions; 0: the callback `row` reads p.t->scene itself */
    dim *d;       /* dimensions of the expressions, required where known[i], else found */
    bool *known;
    const char *const *units; /* units for messages; NULL as array or item: SI */
    size_t from, to;          /* the rows wanted, from .. to-1 of all curves; to = 0: all */
    sweep_row *row;
    void *context;
    calc_error *error;
    calc_error missing; /* raised: why the first missing value is missing */
    char where[320];    /* and at which point */
    size_t values;      /* number of values that are not missing */
    points p;
    knob knobs[1 + SWEEP_NAMES]; /* `with` if there is one, then the names of the range or of the rows */
    size_t before;               /* rows of the curves before */
} sweep_job;

/* The number of rows of all curves; along a load that lasts no time there are fewer. */
size_t sweep_length(const sweep *s);
/* Runs the sweep. Missing values are reported in job->missing and are no error. False: an error, an
 * interrupt, or all rows are wanted and not one value exists. */
bool sweep_run(const sweep *s, sweep_job *job);

/* The value of the second name on a curve. */
long double sweep_with(const sweep *s, size_t curve);

/* The values of a grid, the first name running faster. */
typedef struct grid_values {
    size_t rows, across;    /* numbers of values of the first and of the second name */
    size_t count;           /* of expressions */
    size_t at;              /* points stored so far */
    long double *a, *b, *v; /* values of the first name, of the second, of the expressions */
} grid_values;

/* sweep_run that stores the values; free with grid_values_free, also after a failure. */
bool grid_keep(const sweep *s, sweep_job *job, grid_values *out);
void grid_values_free(grid_values *values);

#endif
