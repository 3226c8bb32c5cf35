/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Turning points, a table of the curve of each branch, and feet of perpendiculars. Depends on turning.h. */
#include "measured/branches.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NODES = 97 }; /* nodes of a branch */

/* ---- measured turning points ------------------------------------------------------------------- */

static double range_of(const double *v, size_t n) {
    double lo = v[0], hi = v[0];
    for (size_t i = 1; i < n; i++) {
        lo = fmin(lo, v[i]);
        hi = fmax(hi, v[i]);
    }
    return hi - lo;
}

/* Adds the first row if the contact was moved there from rest, and the last one of a cycle between turns. */
static void add_ends(branches *b, size_t *at, bool steady) {
    const double next = b->turns ? b->dx[at[0]] : b->dx[b->rows - 1];
    if (!steady && b->turns && fabs(b->dx[0]) > 6 * b->noise_dx && (b->dx[0] > 0) != (next > b->dx[0])) {
        memmove(at + 1, at, b->turns * sizeof *at);
        at[0] = 0;
        b->turns++;
    }
    if (steady && b->turns == 1)
        at[b->turns++] = b->rows - 1;
    b->passed = steady ? b->turns - b->turns % 2 : 0;
}

/* A branch ends at the crest of a curve fitted to the rows at its turning point. Whether crests are round or
 * sharp is decided for all turns together, from rows over a quarter of the range. */
static void find_levels(branches *b, const size_t *at) {
    const size_t last = b->rows - 1;
    double round_left = 0, sharp_left = 0;
    for (size_t i = 0; i < b->turns; i++) {
        const size_t from = i ? (at[i - 1] + at[i]) / 2 : at[i] / 2,
                     to = i + 1 < b->turns ? (at[i] + at[i + 1]) / 2 : (at[i] + last) / 2;
        b->about[i] = at[i] < last ? turning_about(b->dx, at[i], from, to, b->noise_dx)
                                   : (turning){.first = last}; /* it may turn behind the last row */
        b->force[i] = turning_level(b->Fx, at[i], from, at[i], b->noise_Fx, false);
        turning wide = turning_about(b->dx, at[i], from, to, fmax(b->noise_dx, b->range / 24));
        if (wide.n > 1) {
            round_left += turning_residual(b->dx, &wide);
            sharp_left += turning_sharpen(b->dx, &wide);
        }
    }
    for (size_t i = 0; i < b->turns; i++) {
        turning *t = &b->about[i];
        if (sharp_left < round_left && t->n > 1)
            turning_sharpen(b->dx, t);
        b->level[i] = turning_crest(b->dx, t);
        b->first[i + 1] = at[i] > 0 ? t->first + (size_t)round(t->top) + 1 : 0;
    }
    b->first[0] = 0;
    b->first[b->turns + 1] = b->rows;
    branches_begin(b);
}

static double contact_dx(const branches *b, double dx, double Fx) {
    return dx - b->d0 - b->compliance * (Fx - b->F0);
}

void branches_begin(branches *b) {
    for (size_t i = 0; i < b->turns; i++)
        b->turn[i] = contact_dx(b, b->level[i], b->force[i]);
}

/* ---- branches ---------------------------------------------------------------------------------- */

static double begin_of(const branches *b, size_t branch) {
    return branch ? b->turn[branch - 1] : b->passed ? b->turn[b->passed - 1] : 0;
}

static double end_of(const branches *b, size_t branch) {
    return branch < b->turns ? b->turn[branch] : contact_dx(b, b->end, b->end_force);
}

static bool goes_up(const branches *b, size_t branch) {
    return b->up == (branch % 2 == 0);
}

/* The last branch has no turning point at its end: it reaches 4 times the noise beyond its rows. */
static void find_ends(branches *b) {
    const size_t begin = b->first[b->turns], last = b->rows - 1;
    b->up = (b->turns ? b->turn[0] : b->dx[last]) > begin_of(b, 0);
    const bool up = goes_up(b, b->turns);
    size_t at = begin < b->rows ? begin : last;
    for (size_t i = begin; i < b->rows; i++)
        at = (up ? b->dx[i] > b->dx[at] : b->dx[i] < b->dx[at]) ? i : at;
    b->end = b->dx[at] + (up ? 4 : -4) * b->noise_dx;
    b->end_force = b->Fx[at];
}

/* The part 0..1 of a branch at which a node lies: nodes are closer at its beginning, where it bends most. */
static double part_of(size_t node) {
    const double s = (double)node / (NODES - 1);
    return s * s;
}

static double node_at(double part) {
    return sqrt(fmax(part, 0)) * (NODES - 1);
}

/* Normal loads at the nodes: the mean of all rows if constant but for noise, else of the rows near a node. */
static bool find_loads(branches *b, calc_error *error) {
    double noise, mean = 0, square = 0;
    if (!turning_noise(b->normal, b->rows, &noise, error))
        return false;
    for (size_t i = 0; i < b->rows; i++)
        mean += b->normal[i] / (double)b->rows;
    for (size_t i = 0; i < b->rows; i++)
        square += (b->normal[i] - mean) * (b->normal[i] - mean) / (double)b->rows;
    const bool constant = sqrt(square) <= 1.5 * noise;
    for (size_t k = 0; k <= b->turns; k++) {
        double *load = b->load + k * NODES, sum[NODES] = {0}, count[NODES] = {0}, before = b->normal[0];
        const double from = begin_of(b, k), width = end_of(b, k) - from;
        for (size_t i = b->first[k]; i < b->first[k + 1] && !constant; i++) {
            const double at = fmin(node_at((contact_dx(b, b->dx[i], b->Fx[i]) - from) / width), NODES - 1);
            const size_t node = (size_t)(at >= 0 ? round(at) : 0);
            sum[node] += b->normal[i];
            count[node]++;
        }
        if (b->first[k] < b->rows)
            before = b->normal[b->first[k]];
        for (size_t j = 0; j < NODES; j++)
            load[j] = before = constant ? mean : count[j] > 0 ? sum[j] / count[j] : before;
    }
    return true;
}

bool branches_find(branches *b, double noise_dx, double noise_Fx, bool steady, calc_error *error) {
    const size_t n = b->rows;
    size_t *at = malloc((n + 2) * sizeof *at);
    b->range = range_of(b->dx, n);
    b->first = malloc((n + 3) * sizeof *b->first);
    b->about = malloc((n + 2) * sizeof *b->about);
    if (!at || !b->first || !b->about)
        return free(at), calc_no_memory(error);
    if (!turning_noise(b->dx, n, &b->noise_dx, error) || !turning_noise(b->Fx, n, &b->noise_Fx, error))
        return free(at), false;
    b->noise_dx = noise_dx > 0 ? noise_dx : b->noise_dx;
    b->turns = turning_points(b->dx, n, b->noise_dx, at);
    if (noise_dx == 0 && n < 16 * (b->turns + 1)) /* too few rows to tell noise from curvature */
        b->noise_dx = b->noise_Fx = 0;
    b->noise_Fx = noise_Fx > 0 ? noise_Fx : b->noise_Fx;
    add_ends(b, at, steady);
    const double height = range_of(b->Fx, n);
    b->noise_Fx = fmax(b->noise_Fx, 1e-6 * height);
    b->noisy = noise_dx > 0 ||
               (b->noise_dx > 1e-4 * b->range && b->noise_dx / b->range > 0.02 * b->noise_Fx / height);
    b->memory = malloc((6 * b->turns + 2 * n + (b->turns + 1) * NODES) * sizeof *b->memory);
    if (!b->memory)
        return free(at), calc_no_memory(error);
    b->level = b->memory;
    b->force = b->level + b->turns;
    b->turn = b->force + b->turns;
    b->sums = b->turn + b->turns;
    b->across = b->sums + 2 * b->turns;
    b->foot = b->across + n + b->turns;
    b->load = b->foot + n;
    find_levels(b, at);
    free(at);
    find_ends(b);
    return !b->normal || find_loads(b, error);
}

void branches_free(branches *b) {
    free(b->first);
    free(b->about);
    b->about = NULL;
    free(b->memory);
    b->first = NULL;
    b->memory = NULL;
}

/* ---- the curve of a branch --------------------------------------------------------------------- */

/* The curve between two nodes. */
typedef struct piece {
    double x, by;      /* where it begins; 1/length */
    double F[4];       /* coefficients of a cubic in s = 0..1 */
    double bend, more; /* second derivative smoothed over nodes: bend + s more */
} piece;

typedef struct table {
    double x[NODES], F[NODES], slope[NODES], length; /* length: of the branch in x, with sign */
    piece piece[NODES - 1];
} table;

/* The slope at b of the parabola through three successive points. */
static double slope_at(const double *x, const double *F, size_t a, size_t b, size_t c) {
    const double left = (F[b] - F[a]) / (x[b] - x[a]), right = (F[c] - F[b]) / (x[c] - x[b]),
                 part = (x[b] - x[a]) / (x[c] - x[a]);
    return left + part * (right - left);
}

static double bend_at(const table *t, size_t i) {
    const size_t at = i < 1 ? 1 : i > NODES - 2 ? NODES - 2 : i;
    return (t->slope[at + 1] - t->slope[at - 1]) / (t->x[at + 1] - t->x[at - 1]);
}

static void fill_pieces(table *t) {
    const size_t last = NODES - 1;
    for (size_t i = 1; i < last; i++)
        t->slope[i] = slope_at(t->x, t->F, i - 1, i, i + 1);
    t->slope[0] = 2 * (t->F[1] - t->F[0]) / (t->x[1] - t->x[0]) - t->slope[1];
    t->slope[last] = 2 * (t->F[last] - t->F[last - 1]) / (t->x[last] - t->x[last - 1]) - t->slope[last - 1];
    t->length = t->x[last] - t->x[0];
    for (size_t i = 0; i < last; i++) {
        const double h = t->x[i + 1] - t->x[i], rise = t->F[i + 1] - t->F[i], a = h * t->slope[i] - rise,
                     c = h * t->slope[i + 1] - rise, from = bend_at(t, i);
        t->piece[i] =
            (piece){t->x[i], 1 / h, {t->F[i], rise + a, -2 * a - c, a + c}, from, bend_at(t, i + 1) - from};
    }
}

static bool run_branch(const branches *b, size_t branch, table *t, branches_step *step, void *context) {
    const double from = begin_of(b, branch), to = end_of(b, branch);
    for (size_t i = 0; i < NODES; i++)
        if (!step(context, from + part_of(i) * (to - from), b->normal ? b->load[branch * NODES + i] : 0,
                  &t->x[i], &t->F[i]))
            return false;
    for (size_t i = 0; i < NODES && b->x; i++) {
        b->x[branch * NODES + i] = t->x[i];
        b->F[branch * NODES + i] = t->F[i];
    }
    fill_pieces(t);
    return true;
}

/* second: derivative of the slope, which jumps at nodes; bend: the same, smoothed to be continuous. */
typedef struct point {
    double F, slope, second, bend;
} point;

/* Beyond its ends the curve continues as a parabola for a tenth of its length, then straight. */
static point beyond(const table *t, double x, size_t end) {
    const double little = 0.1 * fabs(t->length), by = fmax(fmin(x - t->x[end], little), -little),
                 second = bend_at(t, end), slope = t->slope[end] + by * second,
                 F = t->F[end] + by * (t->slope[end] + by * second / 2);
    return (point){F + slope * (x - t->x[end] - by), slope, second, second};
}

static point curve(const table *t, double x) {
    const size_t last = NODES - 1;
    const double part = (x - t->x[0]) / t->length;
    if (!(part > 0 && part < 1))
        return beyond(t, x, part > 0 ? last : 0);
    size_t at = (size_t)node_at(part);
    at = at < last ? at : last - 1;
    while (at > 0 && (t->piece[at].x - x) * t->length > 0)
        at--;
    while (at + 1 < last && (t->piece[at + 1].x - x) * t->length <= 0)
        at++;
    const piece *p = &t->piece[at];
    const double s = (x - p->x) * p->by;
    return (point){p->F[0] + s * (p->F[1] + s * (p->F[2] + s * p->F[3])),
                   (p->F[1] + s * (2 * p->F[2] + s * 3 * p->F[3])) * p->by,
                   (2 * p->F[2] + s * 6 * p->F[3]) * p->by * p->by, p->bend + s * p->more};
}

/* The distance of (x, F) from the curve, both in units of the noise, less its bias. Finds the foot of the
 * perpendicular by Newton's method from *foot; *stretch is the arc length per x there. */
static double across(const branches *b, const table *t, double x, double F, double *foot, double *stretch) {
    enum { STEPS = 8 };
    const double sx = b->noisy ? b->noise_dx : 0, sF = b->noise_Fx, unit = sx / sF;
    point at = curve(t, *foot);
    for (int i = 0; i < STEPS && sx > 0; i++) {
        const double steep = at.slope * unit, flat = 1 + steep * steep,
                     by = ((x - *foot) + steep * (F - at.F) * unit) /
                          fmax(flat - at.second * (F - at.F) * unit * unit, 0.5 * flat);
        *foot += by;
        at = curve(t, *foot);
        if (fabs(by) < 1e-6 * sx)
            break;
    }
    const double steep = at.slope * unit, along = *stretch = sqrt(1 + steep * steep),
                 bent = at.bend * sx * unit / (along * along * along);
    return ((F - at.F) - at.slope * (x - *foot)) / sF / along + fmax(-0.5, fmin(0.5, bent / 2));
}

/* Adds a row to the measured level of a turning point, the weighted mean of feet near it. The noise of a foot
 * along the curve is independent of that across, and 1/stretch of the noise of dx. */
static void add_to_level(branches *b, size_t turn, size_t row, double foot, double stretch) {
    const turning *t = &b->about[turn];
    if (row < t->first || row >= t->first + t->n)
        return;
    const double weight = turning_weight(t, row - t->first), part = weight / stretch;
    b->sums[2 * turn] += weight * foot;
    b->sums[2 * turn + 1] += part * part;
}

/* Measured less trial level of each turning point, in standard errors; 0 if rows were left out. */
static void finish_levels(branches *b, bool whole) {
    for (size_t i = 0; i < b->turns; i++) {
        double *level = &b->across[b->rows + i];
        const double var = b->sums[2 * i + 1];
        *level = whole && b->noisy && var > 0 ? (b->sums[2 * i] + *level) / (b->noise_dx * sqrt(var)) : 0;
    }
}

/* Moves the contact through the turning points of the cycles before the first row. */
static bool run_before(const branches *b, branches_step *step, void *context) {
    double x, F;
    for (size_t i = 0; i < b->passed; i++)
        if (!step(context, b->turn[i], b->normal ? b->load[i * NODES + NODES - 1] : 0, &x, &F))
            return false;
    return true;
}

size_t branches_nodes(const branches *b) {
    return (b->turns + 1) * NODES;
}

enum { GLANCE = 6 };

size_t branches_glance(const branches *b) {
    return b->first[b->turns + 1 < GLANCE ? b->turns + 1 : GLANCE];
}

bool branches_across(branches *b, size_t n, branches_step *step, void *context) {
    table t;
    memset(b->sums, 0, 2 * b->turns * sizeof *b->sums);
    memset(b->across, 0, (b->rows + b->turns) * sizeof *b->across);
    if (!run_before(b, step, context))
        return false;
    for (size_t k = 0; k <= b->turns && !(n > 1 && k == GLANCE); k++) {
        if (b->first[k] == b->rows) /* no rows behind the last turning point */
            break;
        if (!run_branch(b, k, &t, step, context))
            return false;
        if (k < b->turns)
            b->across[b->rows + k] = -t.x[NODES - 1];
        for (size_t i = (b->first[k] + n - 1) / n * n; i < b->first[k + 1]; i += n) {
            double foot = b->warm ? b->foot[i] : b->dx[i], stretch;
            b->across[i] = across(b, &t, b->dx[i], b->Fx[i], &foot, &stretch);
            b->foot[i] = b->warm ? b->foot[i] : foot;
            if (k > 0)
                add_to_level(b, k - 1, i, foot, stretch);
            if (k < b->turns)
                add_to_level(b, k, i, foot, stretch);
        }
    }
    finish_levels(b, n == 1);
    return true;
}
