/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Splits the rows into cycles at turning points and measures each. Depends on turning.h. */
#include "measured/loop.h"

#include <math.h>
#include <stdlib.h>

#include "measured/turning.h"

typedef struct measured {
    const double *x, *F;
    size_t rows;
    size_t *turn; /* rows of the turning points, and of the ends if d_x turns there too */
    size_t turns;
    double noise_x, noise_F;
} measured;

/* ---- cycles ------------------------------------------------------------------------------------ */

/* Is d_x in `row` that of the turning point `other`, to a part of the stroke from there to `between`? The
 * last row, whose level tells the amplitude, must be nearer than the first, but may be a row or noise off. */
static bool is_like(const measured *m, size_t row, size_t other, size_t between) {
    const double stroke = fabs(m->x[between] - m->x[other]),
                 off = row ? fmax(fabs(m->x[row] - m->x[row - 1]), 4 * m->noise_x) : 0.08 * stroke;
    return fabs(m->x[row] - m->x[other]) <= 0.02 * stroke + off;
}

/* Does a loop that begins between two turning points return to row 0, to a tenth of its width or two steps?
 * Leaves out rows behind it if F_x returns too: begun at rest it would not, and is no cycle. */
static bool closes(measured *m) {
    size_t at = m->rows - 1;
    for (size_t i = at; m->turns == 2 && i > m->turn[1]; i--)
        at = fabs(m->x[i] - m->x[0]) < fabs(m->x[at] - m->x[0]) ? i : at;
    if (m->turns == 2 && fabs(m->F[at] - m->F[0]) <= fmax(0.6 * fabs(m->F[1] - m->F[0]), 4 * m->noise_F))
        m->rows = at + 1;
    return m->turns == 2 &&
           fabs(m->x[m->rows - 1] - m->x[0]) <=
               fmax(0.1 * fabs(m->x[m->turn[1]] - m->x[m->turn[0]]), 2 * fabs(m->x[1] - m->x[0]));
}

/* Adds the first row and the farthest behind the last turning point to the turning points, if d_x is there as
 * at the turning point two on. The last row may lie behind the farthest: there F_x has fallen steeply. */
static void add_ends(measured *m) {
    const size_t n = m->turns;
    size_t *turn = m->turn, last = m->rows - 1;
    for (size_t i = last; i > turn[n - 1]; i--)
        if (fabs(m->x[i] - m->x[turn[n - 1]]) > fabs(m->x[last] - m->x[turn[n - 1]]))
            last = i;
    const bool both = n == 1 && is_like(m, last, 0, turn[0]),
               begins = n > 1 && is_like(m, 0, turn[1], turn[0]),
               ends = n > 1 && is_like(m, last, turn[n - 2], turn[n - 1]);
    if (both || begins) {
        for (size_t i = n; i > 0; i--)
            turn[i] = turn[i - 1];
        turn[0] = 0;
        m->turns++;
    }
    if (both || ends)
        turn[m->turns++] = last;
}

/* ---- one cycle --------------------------------------------------------------------------------- */

/* The area of the polygon of a cycle, relative to its first corner. A drift, linear in the row number, is
 * subtracted: the closing chord lies where the force is largest and would count the drift as slip. */
static double area(const measured *m, const loop_cycle *c, double drift_x, double drift_F) {
    const long double rows = (long double)(c->last - c->first);
    long double sum = 0, x0 = 0, F0 = 0;
    for (size_t i = c->first; i < c->last; i++) {
        const long double gone = (long double)(i + 1 - c->first) / rows,
                          x = m->x[i + 1] - (long double)m->x[c->first] - gone * drift_x,
                          F = m->F[i + 1] - (long double)m->F[c->first] - gone * drift_F;
        sum += (F + F0) / 2 * (x - x0);
        x0 = x;
        F0 = F;
    }
    return (double)(sum - F0 / 2 * x0);
}

/* Rows from `from` towards `to` in which v changes by at most `part` of v[to] - v[from], or one more if v has
 * not changed yet: a rig may rest where it turns. */
static size_t rows_within(const double *v, size_t from, size_t to, double part) {
    const int step = to > from ? 1 : -1;
    const double far = part * fabs(v[to] - v[from]);
    size_t row = from, n = 1;
    while (row != to && (v[row] == v[from] || fabs(v[row + (size_t)step] - v[from]) <= far)) {
        row += (size_t)step;
        n++;
    }
    return n;
}

/* The slope dF_x/dd_x behind the turn at `from`, by a parabola for d_x(F_x), whose slope is finite there.
 * Skips the rows within 4 times the noise of the turn, and curvature below three standard errors. */
static double unloading(const measured *m, size_t from, size_t to) {
    double c[3];
    const size_t end = from + rows_within(m->F, from, to, 0.3);
    size_t first = from;
    while (first + 4 < end && (fabs(m->F[first] - m->F[from]) < 4 * m->noise_F ||
                               fabs(m->x[first] - m->x[from]) < 4 * m->noise_x))
        first++;
    const double *x = m->x + first, *F = m->F + first, n = (double)(end - first),
                 fall = fabs(m->F[end - 1] - m->F[first]);
    bool ok = turning_parabola(F, x, end - first, m->F[from], false, c);
    if (!ok || fabs(c[2]) * fall * fall < 3 * sqrt(180 / n) * hypot(m->noise_x, m->noise_F * c[1]))
        ok = turning_parabola(F, x, end - first, m->F[from], true, c);
    return ok && c[1] != 0 ? 1 / c[1] : NAN;
}

/* The slope before the turn at `to`, by the regression line, and its standard error. */
static double flank(const measured *m, size_t from, size_t to, double *error) {
    const size_t n = rows_within(m->x, to, from, 0.1);
    long double x = 0, F = 0, xx = 0, xF = 0;
    for (size_t i = to + 1 - n; i <= to; i++) {
        x += m->x[i] / (long double)n;
        F += m->F[i] / (long double)n;
    }
    for (size_t i = to + 1 - n; i <= to; i++) {
        xx += (m->x[i] - x) * (m->x[i] - x);
        xF += (m->x[i] - x) * (m->F[i] - F);
    }
    *error = m->noise_F / (double)sqrtl(xx);
    return (double)(xF / xx);
}

static loop_cycle measure(const measured *m, size_t a, size_t b, size_t c) {
    const double *x = m->x, *F = m->F;
    const size_t left = m->rows - 1 - c, after = (c - b) / 4 < left ? (c - b) / 4 : left;
    const double xb = turning_level(x, b, (a + 3 * b) / 4, (3 * b + c) / 4, m->noise_x, true),
                 xc = turning_level(x, c, (b + 3 * c) / 4, c + after, m->noise_x, true),
                 Fb = turning_level(F, b, (a + b) / 2, b, m->noise_F, false),
                 Fc = turning_level(F, c, (b + c) / 2, c, m->noise_F, false);
    double error[2];
    loop_cycle out = {.first = a,
                      .last = c,
                      .dxA = fabs(xc - xb) / 2,
                      .FA = fabs(Fc - Fb) / 2,
                      .dx0 = (xb + xc) / 2,
                      .Fx0 = (Fb + Fc) / 2};
    out.secant = out.FA / out.dxA;
    out.unloading = (unloading(m, a, b) + unloading(m, b, c)) / 2;
    out.flank = (flank(m, a, b, &error[0]) + flank(m, b, c, &error[1])) / 2 / out.unloading;
    out.slides = out.flank < 0.05 + hypot(error[0], error[1]) / out.unloading; /* 2 errors of their mean */
    return out;
}

/* ---- all cycles -------------------------------------------------------------------------------- */

static bool measure_all(measured *m, loop_answer *out, calc_error *error) {
    const size_t cycles = m->turns < 3 ? 0 : (m->turns - 1) / 2;
    if (cycles == 0)
        return calc_fail(error, 0, 0, "no cycle is closed: dx turns %zu time%s in %zu row%s", m->turns,
                         m->turns == 1 ? "" : "s", m->rows, m->rows == 1 ? "" : "s");
    out->cycle = malloc(cycles * sizeof *out->cycle);
    if (!out->cycle)
        return calc_no_memory(error);
    out->cycles = cycles;
    for (size_t i = 0; i < cycles; i++)
        out->cycle[i] = measure(m, m->turn[2 * i], m->turn[2 * i + 1], m->turn[2 * i + 2]);
    const loop_cycle *first = out->cycle, *last = first + cycles - 1;
    double drift[2] = {0}; /* subtracted from the area: only if above two standard errors */
    if (cycles > 1) {
        const double between = (double)(cycles - 1);
        out->drift_dx = (last->dx0 - first->dx0) / between;
        out->drift_Fx = (last->Fx0 - first->Fx0) / between;
        drift[0] = fabs(out->drift_dx) > 2 * m->noise_x / between ? out->drift_dx : 0;
        drift[1] = fabs(out->drift_Fx) > 2 * m->noise_F / between ? out->drift_Fx : 0;
    } else { /* not subtracted: whether it goes on is not known */
        out->drift_dx = m->x[last->last] - m->x[last->first];
        out->drift_Fx = m->F[last->last] - m->F[last->first];
    }
    for (loop_cycle *c = out->cycle; c <= last; c++) {
        c->dW = area(m, c, drift[0], drift[1]);
        c->ratio = c->dW / (4 * c->FA * c->dxA);
    }
    return true;
}

/* Measures one closed cycle that begins between turning points, on rows rotated to begin with the first. */
static bool measure_rotated(measured *m, double *rotated, loop_answer *out, calc_error *error) {
    const size_t n = m->rows, begin = m->turn[0];
    measured from = *m;
    for (size_t i = 0; i <= n; i++) {
        rotated[i] = m->x[(begin + i) % n];
        rotated[n + 1 + i] = m->F[(begin + i) % n];
    }
    from.x = rotated;
    from.F = rotated + n + 1;
    from.rows = n + 1;
    from.turn[1] -= begin;
    from.turn[0] = 0;
    from.turn[from.turns++] = n;
    const bool ok = measure_all(&from, out, error);
    if (ok) {
        out->cycle->first = begin;
        out->cycle->last = begin - 1;
    }
    out->drift_dx = m->x[n - 1] - m->x[0];
    out->drift_Fx = m->F[n - 1] - m->F[0];
    return ok;
}

bool loop_find(const double *dx, const double *Fx, size_t rows, loop_answer *out, calc_error *error) {
    measured m = {.x = dx, .F = Fx, .rows = rows, .turn = malloc((rows + 2) * sizeof *m.turn)};
    double *rotated = malloc(2 * (rows + 1) * sizeof *rotated);
    *out = (loop_answer){.cycle = NULL};
    bool ok = (m.turn && rotated) || calc_no_memory(error);
    if (ok && turning_noise(dx, rows, &m.noise_x, error) && turning_noise(Fx, rows, &m.noise_F, error)) {
        m.turns = turning_points(dx, rows, m.noise_x, m.turn);
        if (m.turns > 0)
            add_ends(&m);
        if (rows < 16 * (m.turns + 1)) /* too few rows to tell noise from curvature */
            m.noise_x = m.noise_F = 0;
        ok = closes(&m) ? measure_rotated(&m, rotated, out, error) : measure_all(&m, out, error);
    } else {
        ok = false;
    }
    out->noise_dx = m.noise_x;
    out->noise_Fx = m.noise_F;
    if (ok)
        out->at_rest = fabs(dx[0]) <= fmax(0.05 * out->cycle->dxA, 4 * m.noise_x) &&
                       fabs(Fx[0]) <= fmax(0.05 * out->cycle->FA, 4 * m.noise_F);
    free(rotated);
    free(m.turn);
    return ok;
}

void loop_free(loop_answer *a) {
    free(a->cycle);
    *a = (loop_answer){.cycle = NULL};
}
