/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a fit is asked: names, and rows as equations or as a loop. */
#ifndef STUDY_FIT_QUESTION_H
#define STUDY_FIT_QUESTION_H

#include "study/ask.h"
#include "study/points.h"

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
    /* each row an equation; left NULL: a loop */
    const expr *left, *right;
    const column_knob *column; /* no more than FIT_COLUMNS, borrowed */
    size_t columns;
    fit_loop loop;
    fit_points *points; /* wanted, to be freed; or NULL */
} fit_question;

#endif
