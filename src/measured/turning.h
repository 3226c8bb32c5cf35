/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The noise of a measured column, and its turning points above that noise. Depends on text/error. */
#ifndef MEASURED_TURNING_H
#define MEASURED_TURNING_H

#include "text/error.h"

/* Estimates the standard deviation s of white noise in v: for noise alone the median size of the differences
 * of order k is 0.6745 s (2k over k)^(1/2). A signal can only raise it: *noise is the least of k = 2, 4 and
 * 6; 0 for fewer than 13 rows. False: out of memory. */
bool turning_noise(const double *v, size_t n, double *noise, calc_error *error);

/* Writes the rows where v turns to `at`, which has room for n, and returns their number. Each is the extreme
 * row before v comes back by more than both min(8 noise, range/4) and min(2.5 smallest step, range/10). The
 * first and the last row are never turning points. */
size_t turning_points(const double *v, size_t n, double noise, size_t *at);

/* The n rows from `first` on about a turning point, all within 6 times the noise of the turning row; just
 * that row if there are fewer than five. */
enum { TURNING_MOST = 400 };
typedef struct turning {
    size_t first, n;
    double here, top; /* index among these rows of the turning row, and of the crest of the fitted curve */
    bool sharp;       /* the curve is two lines that meet at the crest, else a parabola */
    double a, b, c;   /* weight of a row if sharp: a + b u for u < 0, else a + c u; u = i - top */
} turning;

/* Collects these rows between `from` and `to` and fits a parabola. */
turning turning_about(const double *v, size_t row, size_t from, size_t to, double noise);
/* The residual sum of squares of the parabola; INFINITY for one row. */
double turning_residual(const double *v, const turning *t);
/* Fits two lines instead, as a drive of constant speed gives; returns their residuals; INFINITY: failed. */
double turning_sharpen(const double *v, turning *t);
/* The value of the fitted curve at `top`, and the weight of row i in it. */
double turning_crest(const double *v, const turning *t);
double turning_weight(const turning *t, size_t i);
/* turning_about, then the value of the parabola at its crest or at the turning row. */
double turning_level(const double *v, size_t row, size_t from, size_t to, double noise, bool crest);

/* Fits y = c0 + c1 (x-x0) + c2 (x-x0)^2 to n points by least squares; c2 = 0 for fewer than four points or
 * with `line`. False: the points do not determine the coefficients. */
bool turning_parabola(const double *x, const double *y, size_t n, double x0, bool line, double c[3]);

#endif
