/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is left over of measured rows at trial values of the unknowns, and its slopes. The unknowns are the
 * names of a fit and, of a loop with noise in both columns, its turning points behind them. */
#ifndef STUDY_RESIDUALS_H
#define STUDY_RESIDUALS_H

#include "measured/branches.h"
#include "study/points.h"

/* ---- what a fit is asked: names, and rows as equations or as a loop ---- */

enum { FIT_NAMES = 8, FIT_COLUMNS = 64 }; /* as many as a file has */

/* A measured loop: F_x compared at each row. */
typedef struct fit_loop {
    const double *dx, *Fx;
    bool rig;                  /* these are readings: dx + Fx/K_rig + d0, Fx + F0 */
    const double *normal;      /* F_N or delta_z at each row, or NULL: as pressed */
    load_by normal_by;         /* BY_FORCE, BY_DISPLACEMENT */
    double noise_dx, noise_Fx; /* standard deviations; 0: estimated */
    bool closed;               /* one cycle of many: it begins in its midst */
} fit_loop;

/* What a fit is drawn from, in SI: both sides at each row, what is left over, and the curve of a loop. */
typedef struct fit_points {
    double *left, *right, *residual; /* residual: in units of the noise, where both columns have it */
    size_t nodes;                    /* of the curve; 0: it goes through the rows */
    double *x, *y;
} fit_points;

typedef struct fit_question {
    calc *c;
    knob name[FIT_NAMES];
    size_t count;
    const double *from; /* values close to the answer, in place of the present ones; or NULL */
    size_t rows;        /* more than names */
    /* each row an equation, left and right; NULL: a loop */
    const expr *sides;
    const column_knob *column; /* no more than FIT_COLUMNS, borrowed */
    size_t columns;
    fit_loop loop;
    fit_points *points; /* wanted, to be freed; or NULL */
} fit_question;

/* ---- what is left over ---- */

enum { FIT_TURNS = 64, UNKNOWNS = FIT_NAMES + FIT_TURNS };
#define NO_ROW ((size_t)-1)

typedef struct residuals {
    const fit_question *of;
    points p;
    size_t unknowns, count; /* count: of rows, and behind them turning points as measured */
    /* The unknowns in numbers q near 1: start exp(q-1), or start + scale (q-1). */
    double q[UNKNOWNS], start[UNKNOWNS], scale[UNKNOWNS];
    bool ratio[UNKNOWNS];
    size_t held;    /* this one keeps its q; unknowns: none does */
    double unit;    /* of what is handed to a solver */
    double *slopes; /* in it, a row of all unknowns for each residual */
    double largest; /* side of the equations computed so far */
    dim d;
    size_t bad_row; /* the last one without a value; NO_ROW: it was not a row's fault */
    size_t stride;  /* a glance: every such row of some of the data, turning points as measured; 0: all */
    branches loop;
    fit_points *kept; /* NULL, or where the sides of equations go, too */
    unsigned evaluations;
    /* private */
    knob knobs[FIT_NAMES + FIT_COLUMNS]; /* names, and columns behind them */
    double K_rig, d0, F0;                /* of a loop that is read at the rig, else 0 */
    bool known, twice;
    long double x[FIT_NAMES]; /* of the names, present */
    double now[UNKNOWNS];     /* q of the latest residuals */
    double sloped[UNKNOWNS];  /* q of the slopes, where there are any */
    bool has_slopes;
    double *memory, *out, *above, *below;
    double *to; /* where equations go */
} residuals;

/* Columns, the loop and its turning points. Close whatever comes. */
bool residuals_open(residuals *r, const fit_question *of, calc_error *error);
void residuals_close(residuals *r);

double residuals_unknown(const residuals *r, size_t i);
/* At r->q: left - right, or measured - computed F_x, in SI; of a loop with noise in both columns in units of
 * these. False: there is no value, or r->p.error is raised, and all has ended. */
bool residuals_at(residuals *r, double *out);
/* At r->q, by differences of second order, 0 of the one that is held; false with the error. They stay until
 * the next. */
bool residuals_slopes(residuals *r);

#endif
