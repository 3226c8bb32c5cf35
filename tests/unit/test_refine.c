/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Points of curves: where they bend, jump or break off, and nowhere else. */
#include "study/refine.h"

#include <math.h>
#include <stdlib.h>

#include "unit.h"

enum { ROOM = 4000, COLUMNS = 2 };

typedef struct curve {
    double (*f)(double x, int column);
    size_t count, calls, most, fail_at; /* fail_at: of the rows evaluated; 0: never */
    double x[ROOM], y[ROOM][COLUMNS];
} curve;

static bool evaluate(void *context, long double *row, size_t rows) {
    curve *c = context;
    c->calls += rows;
    c->most = rows > c->most ? rows : c->most;
    for (size_t i = 0; i < rows; i++, row += 1 + COLUMNS)
        for (int j = 0; j < COLUMNS; j++)
            row[1 + j] = c->f((double)row[0], j);
    return !c->fail_at || c->calls < c->fail_at;
}

static bool give(void *context, long double part, const long double *values) {
    curve *c = context;
    c->x[c->count] = (double)part;
    for (int j = 0; j < COLUMNS; j++)
        c->y[c->count][j] = (double)values[j];
    return ++c->count < ROOM;
}

static bool run_steps(curve *c, double (*f)(double, int), size_t fail_at, size_t steps) {
    calc_error error;
    const refinement r = {.count = COLUMNS, .steps = steps, .evaluate = evaluate, .give = give, .context = c};
    *c = (curve){.f = f, .fail_at = fail_at};
    error_clear(&error);
    return refine(&r, &error);
}

static bool run(curve *c, double (*f)(double, int), size_t fail_at) {
    return run_steps(c, f, fail_at, 100);
}

static double parabola(double x, int column) {
    return column ? 0 : x * x;
}

static double line(double x, int column) {
    return column ? 7 : 3 * x - 1;
}

/* A root at 0 and a bend, which differ between the columns. */
static double bends(double x, int column) {
    return column ? fabs(x - 0.3141) : sqrt(x);
}

static double jump(double x, int column) {
    return column ? 0 : x < 1 / 3.0 ? 0 : 1;
}

static double ends(double x, int column) {
    return column ? x : x > 0.777 ? (double)NAN : 1 - sqrt(0.777 - x);
}

static double pole(double x, int column) {
    return column ? 0 : 1 / x;
}

/* Bends everywhere: it is drawn as it is. */
static double rough(double x, int column) {
    return column ? 0 : sin(1e7 * x * x);
}

/* One column has no value. */
static double half(double x, int column) {
    return column ? (double)NAN : fabs(x - 0.3141);
}

static bool rising(const curve *c) {
    for (size_t i = 1; i < c->count; i++)
        if (!(c->x[i] > c->x[i - 1]))
            return false;
    return c->count > 1 && c->x[0] == 0 && c->x[c->count - 1] == 1;
}

/* Largest distance of the lines between points from the function. */
static double off(const curve *c, int column) {
    double worst = 0;
    for (size_t i = 1; i < c->count; i++)
        for (double t = 0.1; t < 0.95; t += 0.1) {
            const double x = c->x[i - 1] + (c->x[i] - c->x[i - 1]) * t;
            const double y = c->y[i - 1][column] + (c->y[i][column] - c->y[i - 1][column]) * t;
            worst = fmax(worst, fabs(y - c->f(x, column)));
        }
    return worst;
}

int main(int argc, char **argv) {
    unit_start("refine", argc, argv);
    curve *c = malloc(sizeof *c);
    if (!c)
        return 1;
    CHECK(run(c, line, 0) && c->count == 101 && rising(c));
    /* the middle of three points lies step^2 off the line, of 0.92 and 0.9 that the bulk spans: 0.43 and 0.69
     * thousandths */
    CHECK(run_steps(c, parabola, 0, 50) && c->count == 51 && rising(c));
    CHECK(run_steps(c, parabola, 0, 40) && c->count == 81 && rising(c));
    CHECK(run(c, bends, 0) && rising(c) && c->count < 400);
    CHECK(off(c, 0) < 2e-3 && off(c, 1) < 1e-3);
    CHECK(c->most <= 256 && c->calls == c->count);
    CHECK(run(c, jump, 0) && rising(c) && c->count < 200);
    size_t at = 0;
    while (at + 1 < c->count && !(c->y[at][0] == 0 && c->y[at + 1][0] == 1))
        at++;
    CHECK(at + 1 < c->count && c->x[at + 1] - c->x[at] < 2e-5);
    CHECK(run(c, ends, 0) && rising(c));
    at = 0;
    while (at < c->count && isfinite(c->y[at][0]))
        at++;
    CHECK(at > 0 && at < c->count && 0.777 - c->x[at - 1] < 2e-5 && 0.777 - c->x[at - 1] >= 0);
    CHECK(run(c, pole, 0) && rising(c) && c->count < 400 && c->y[1][0] > 50);
    CHECK(run_steps(c, rough, 0, 1000) && rising(c) && c->count < 3000 && c->count > 1000);
    CHECK(run(c, half, 0) && rising(c) && off(c, 0) < 1e-3);
    CHECK(!run(c, bends, 50) && c->count == 0);
    CHECK(!run(c, bends, 110) && c->count == 0);
    free(c);
    return unit_finish();
}
