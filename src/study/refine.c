/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Halves intervals where the middle of three points is off the line between the others. Depends on number. */
#include "study/refine.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "number/array.h"

enum { ROUNDS = 12, POINTS = 3000 };
static const double off_line = 1.0 / 2000, narrow = 1e-5;

/* The bulk of a curve: the range of its even points without the lowest and the highest twentieth. */
typedef struct bulk {
    double middle, height; /* height 0: a constant */
} bulk;

typedef struct picture {
    const refinement *r;
    size_t n, width;  /* number of rows; numbers in a row: the part, then the values */
    long double *row; /* in ascending order of the part */
    bool *halve;      /* the interval behind each row is to be halved */
    double *sorted;   /* scratch */
    bulk *of;         /* of each column */
} picture;

static long double part_at(const picture *p, size_t i) {
    return p->row[i * p->width];
}

static double value_at(const picture *p, size_t i, size_t column) {
    return (double)p->row[i * p->width + 1 + column];
}

static bulk bulk_of(const picture *p, size_t column) {
    double *sorted = p->sorted;
    size_t n = 0;
    for (size_t i = 0; i < p->n; i++)
        if (isfinite(value_at(p, i, column)))
            sorted[n++] = value_at(p, i, column);
    if (!n)
        return (bulk){0, 0};
    qsort(sorted, n, sizeof *sorted, fret_ascending);
    double lo = sorted[n / 20], hi = sorted[n - 1 - n / 20];
    if (!(hi > lo)) {
        lo = sorted[0];
        hi = sorted[n - 1];
    }
    /* smaller differences are rounding */
    const double noise = 1e-9 * fmax(fabs(lo), fabs(hi));
    return (bulk){(lo + hi) / 2, hi - lo > noise ? hi - lo : 0};
}

/* Is the value outside the plot, as near a pole? */
static bool is_far(const bulk *b, double v) {
    return fabs(v - b->middle) > 2 * b->height;
}

/* Marks the interval behind row i unless it is too narrow. */
static void mark(picture *p, size_t i) {
    if (part_at(p, i + 1) - part_at(p, i) > narrow)
        p->halve[i] = true;
}

static void mark_column(picture *p, size_t column) {
    const bulk *b = &p->of[column];
    if (!(b->height > 0))
        return;
    for (size_t i = 0; i + 1 < p->n; i++) {
        const double here = value_at(p, i, column), next = value_at(p, i + 1, column);
        if (isfinite(here) != isfinite(next) && !is_far(b, isfinite(here) ? here : next))
            mark(p, i);
        if (i == 0 || !isfinite(here) || !isfinite(next))
            continue;
        const double last = value_at(p, i - 1, column);
        const long double width = part_at(p, i + 1) - part_at(p, i - 1);
        const double t = (double)((part_at(p, i) - part_at(p, i - 1)) / width);
        if (!isfinite(last) || !(fabs(here - (last + (next - last) * t)) > off_line * b->height))
            continue;
        if (!is_far(b, last) || !is_far(b, here))
            mark(p, i - 1);
        if (!is_far(b, here) || !is_far(b, next))
            mark(p, i);
    }
}

static int by_part(const void *a, const void *b) {
    const long double x = *(const long double *)a, y = *(const long double *)b;
    return (x > y) - (x < y);
}

/* Computes the `more` new rows behind the others and sorts all. */
static bool take_rows(picture *p, size_t more) {
    const bool ok = p->r->evaluate(p->r->context, p->row + p->n * p->width, more);
    p->n += more;
    qsort(p->row, p->n, p->width * sizeof *p->row, by_part);
    return ok;
}

/* One round: adds the middles of marked intervals; *more: their number. */
static bool halve(picture *p, size_t *more) {
    memset(p->halve, 0, p->n * sizeof *p->halve);
    for (size_t j = 0; j < p->r->count; j++)
        mark_column(p, j);
    *more = 0;
    for (size_t i = 0; i + 1 < p->n && p->n + *more < POINTS; i++)
        if (p->halve[i])
            p->row[(p->n + (*more)++) * p->width] = (part_at(p, i) + part_at(p, i + 1)) / 2;
    if (p->n + *more >= POINTS) /* a curve that bends everywhere is left as it is */
        *more = 0;
    return take_rows(p, *more);
}

static bool run_rounds(picture *p) {
    const size_t even = p->r->steps + 1;
    for (size_t i = 0; i < even; i++)
        p->row[i * p->width] = (long double)i / (long double)p->r->steps;
    if (!take_rows(p, even))
        return false;
    for (size_t j = 0; j < p->r->count; j++)
        p->of[j] = bulk_of(p, j);
    size_t more = 1;
    for (int round = 0; round < ROUNDS && more; round++)
        if (!halve(p, &more))
            return false;
    for (size_t i = 0; i < p->n; i++)
        if (!p->r->give(p->r->context, part_at(p, i), p->row + i * p->width + 1))
            return false;
    return true;
}

bool refine(const refinement *r, calc_error *error) {
    const size_t room = r->steps + 1 > POINTS ? r->steps + 1 : POINTS, width = 1 + r->count;
    picture p = {.r = r,
                 .width = width,
                 .row = malloc(room * width * sizeof *p.row),
                 .halve = malloc(room * sizeof *p.halve),
                 .sorted = malloc(room * sizeof *p.sorted),
                 .of = malloc(r->count * sizeof *p.of)};
    const bool ok = p.row && p.halve && p.sorted && p.of ? run_rounds(&p) : calc_no_memory(error);
    free(p.row);
    free(p.halve);
    free(p.sorted);
    free(p.of);
    return ok;
}
