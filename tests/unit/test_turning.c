/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Crests of a measured column, round and sharp: exact where the data are, and the weights of rows in them
 * those of normal equations. */
#include "measured/turning.h"

#include "unit.h"

enum { ROWS = 60 };

/* By the parabola that turning_parabola finds by normal equations, of unit values. */
static double weight(size_t n, double at, size_t i) {
    double x[ROWS], y[ROWS] = {0}, c[3];
    for (size_t k = 0; k < n; k++)
        x[k] = (double)k;
    y[i] = 1;
    CHECK(turning_parabola(x, y, n, at, false, c));
    return c[0];
}

/* Turning points from the second row on, up and down, and none at the ends. */
static void first_turns(void) {
    size_t at[4];
    for (int sign = -1; sign <= 1; sign += 2) {
        const double v[] = {0, 9.0 * sign, 1.0 * sign, 8.0 * sign};
        CHECK(turning_points(v, 4, 0, at) == 2 && at[0] == 1 && at[1] == 2);
        CHECK(turning_points(v, 2, 0, at) == 0);
    }
}

static void round_crests(void) {
    double v[ROWS];
    for (size_t i = 0; i < ROWS; i++)
        v[i] = 3 - 0.02 * ((double)i - 27.3) * ((double)i - 27.3);
    const turning t = turning_about(v, 27, 0, ROWS - 1, 0.1);
    CHECK(t.n == 11 && t.first == 22 && !t.sharp);
    CHECK_REL(t.top, 5.3, 1e-12);
    CHECK_REL(turning_crest(v, &t), 3, 1e-14);
    CHECK_ABS(turning_residual(v, &t), 0, 1, 1e-24);
    for (size_t i = 0; i < t.n; i++)
        CHECK_ABS(turning_weight(&t, i), weight(t.n, t.top, i), 1, 1e-13);
    CHECK_REL(turning_level(v, 30, 0, ROWS - 1, 0.1, false), v[30], 1e-13);
    const turning few = turning_about(v, 2, 0, ROWS - 1, 1e-3);
    CHECK(few.n == 1 && few.first == 2 && turning_crest(v, &few) == v[2]);
}

static void sharp_crests(void) {
    double v[ROWS];
    for (size_t i = 0; i < ROWS; i++)
        v[i] = 3 - 0.1 * fabs((double)i - 27.25);
    turning t = turning_about(v, 27, 0, ROWS - 1, 0.1);
    const double round_left = turning_residual(v, &t);
    CHECK(turning_crest(v, &t) < 2.95);
    CHECK_ABS(turning_sharpen(v, &t), 0, 1, 1e-24);
    CHECK(t.sharp && round_left > 0.01);
    CHECK_REL((double)t.first + t.top, 27.25, 1e-14);
    CHECK_REL(turning_crest(v, &t), 3, 1e-14);
    double sum = 0, left = 0, right = 0;
    for (size_t i = 0; i < t.n; i++) {
        const double u = (double)i - t.top, w = turning_weight(&t, i);
        sum += w;
        left += w * fmin(u, 0);
        right += w * fmax(u, 0);
    }
    CHECK_REL(sum, 1, 1e-13);
    CHECK_ABS(left, 0, 1, 1e-13);
    CHECK_ABS(right, 0, 1, 1e-13);
}

/* A drive that goes back faster. */
static void uneven_crests(void) {
    double v[ROWS];
    for (size_t i = 0; i < ROWS; i++)
        v[i] = 3 + (i < 28 ? 0.05 : -0.15) * ((double)i - 27.5);
    turning t = turning_about(v, 27, 0, ROWS - 1, 0.1);
    CHECK_ABS(turning_sharpen(v, &t), 0, 1, 1e-24);
    CHECK_REL((double)t.first + t.top, 27.5, 1e-14);
    CHECK_REL(turning_crest(v, &t), 3, 1e-14);
}

int main(int argc, char **argv) {
    unit_start("turning", argc, argv);
    CASE(first_turns());
    CASE(round_crests());
    CASE(sharp_crests());
    CASE(uneven_crests());
    return unit_finish();
}
