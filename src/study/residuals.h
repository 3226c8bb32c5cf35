/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Residuals of measured rows at trial values of the unknowns, and their derivatives. Unknowns are the names
 * of a fit, then turning points if a loop has noise in both columns. Depends on measured and points.h. */
#ifndef STUDY_RESIDUALS_H
#define STUDY_RESIDUALS_H

#include "measured/branches.h"
#include "study/points.h"

/* ---- the question of a fit: names, and rows as equations or as a loop ---- */

enum { FIT_NAMES = 8, FIT_COLUMNS = 64 }; /* FIT_COLUMNS: as many as a file may have */

/* A measured loop: F_x is compared at each row. */
typedef struct fit_loop {
    const double *dx, *Fx;
    bool rig;                  /* dx, Fx are readings of the rig: dx + Fx/K_rig + d0, Fx + F0 */
    const double *normal;      /* F_N or delta_z at each row; NULL: as pressed */
    load_by normal_by;         /* BY_FORCE, BY_DISPLACEMENT */
    double noise_dx, noise_Fx; /* standard deviations; 0: estimated */
    bool steady;               /* it begins within a steady cycle, not at rest */
} fit_loop;

/* The data for plotting a fit, in SI: both sides and the residual at each row, and the curve of a loop. */
typedef struct fit_points {
    double *left, *right, *residual; /* residual: in units of the noise if both columns have noise */
    size_t nodes;                    /* of the curve; 0: the rows themselves are the curve */
    double *x, *y;
} fit_points;

typedef struct fit_question {
    calc *c;
    knob name[FIT_NAMES];
    size_t count;
    const double *from; /* start values close to the answer; NULL: the present values */
    size_t rows;        /* must exceed `count` */
    /* left and right side of the equation that holds in each row; NULL: `loop` is fitted */
    const expr *sides;
    const column_knob *column; /* at most FIT_COLUMNS, borrowed */
    size_t columns;
    fit_loop loop;
    fit_points *points; /* to be filled, freed with fit_points_free; or NULL */
} fit_question;

/* ---- residuals ---- */

enum { FIT_TURNS = 64, UNKNOWNS = FIT_NAMES + FIT_TURNS };
#define NO_ROW ((size_t)-1)

typedef struct residuals {
    const fit_question *of;
    points p;
    size_t unknowns, count; /* count of residuals: of rows, then of turning points if these are unknowns */
    /* Unknowns are scaled to numbers q near 1: start exp(q-1) if `ratio`, else start + scale (q-1). */
    double q[UNKNOWNS], start[UNKNOWNS], scale[UNKNOWNS];
    bool ratio[UNKNOWNS];
    size_t held;    /* index of the unknown that keeps its q; `unknowns`: none does */
    double unit;    /* the solver sees residuals divided by this */
    double *slopes; /* Jacobian in that unit: a row of all unknowns for each residual */
    double largest; /* largest side of the equations computed so far */
    dim d;          /* of the residuals */
    size_t bad_row; /* the last row without a value; NO_ROW: the failure concerns no row */
    size_t stride;  /* coarse search: every stride-th row of part of the data alone; 0: all rows */
    branches loop;
    fit_points *kept; /* receives the sides of equations too; or NULL */
    unsigned evaluations;
    /* private */
    knob knobs[FIT_NAMES + FIT_COLUMNS]; /* names, then columns */
    double K_rig;                        /* of the rig that has read the loop, else 0 */
    bool known;                          /* `d` is known */
    long double x[FIT_NAMES];            /* present values of the names */
    double now[UNKNOWNS];                /* q of the latest residuals */
    double sloped[UNKNOWNS];             /* q of `slopes` if has_slopes */
    bool has_slopes;
    double *memory, *out, *above, *below;
    double *to; /* where residuals of equations are written */
} residuals;

/* Opens the points and, for a loop, finds its turning points. Call residuals_close also after a failure. */
bool residuals_open(residuals *r, const fit_question *of, calc_error *error);
void residuals_close(residuals *r);

/* The value of unknown i at r->q. */
double residuals_unknown(const residuals *r, size_t i);
/* Computes the residuals at r->q: left - right, or measured - computed F_x, in SI; for a loop with noise in
 * both columns distances in units of the noise. False: there is no value, or r->p.error is raised. */
bool residuals_at(residuals *r, double *out);
/* Computes r->slopes at r->q by central differences, 0 for the unknown held. False with the error. */
bool residuals_slopes(residuals *r);

#endif
