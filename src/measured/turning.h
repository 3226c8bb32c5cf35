/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where a measured column turns, above its noise. Knows numbers alone. */
#ifndef MEASURED_TURNING_H
#define MEASURED_TURNING_H

#include "text/error.h"

/* The standard deviation of white noise in v: of the differences of orders 2, 4 and 6 the median size is
 * 0.6745 s (2k over k)^(1/2) where there is but noise, and what else is in v shows least in one of them. */
bool turning_noise(const double *v, size_t n, double *noise, calc_error *error);

/* The rows where v turns: each the farthest before v has come back by more than 8 times its noise, or a
 * quarter of its range, and some of its smallest steps, or a tenth of that. The first row and the last are
 * none. `at` has room for n. Returns how many. */
size_t turning_points(const double *v, size_t n, double noise, size_t *at);

/* The rows from..to about a turning row within 6 times the noise of it, where they are five or more: else
 * that row. here: its place among them; top: where a parabola through them has its crest, or the end next to
 * that. */
enum { TURNING_MOST = 400 };
typedef struct turning {
    size_t first, n;
    double here, top;
    bool sharp; /* the crest is where two lines meet, in which a value has the weight a + b u, right of it a +
                   c u, */
    double a, b, c; /* u = i - top */
} turning;

turning turning_about(const double *v, size_t row, size_t from, size_t to, double noise);
/* The sum of squares that the parabola leaves over; INFINITY of one row. */
double turning_left(const double *v, const turning *t);
/* Makes the crest one of two lines, as a drive of constant speed has; what they leave over, likewise. */
double turning_sharpen(const double *v, turning *t);
/* The value of the parabola or the lines at their crest, and the weight of a value in it. */
double turning_crest(const double *v, const turning *t);
double turning_weight(const turning *t, size_t i);
/* v at the crest of these, or at the row. */
double turning_level(const double *v, size_t row, size_t from, size_t to, double noise, bool crest);

/* y = c0 + c1 (x-x0) + c2 (x-x0)^2 nearest to n points, c2 = 0 of fewer than four or where a line is wanted;
 * false: they do not tell. */
bool turning_parabola(const double *x, const double *y, size_t n, double x0, bool line, double c[3]);

#endif
