/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Halving of intervals where the middle one of three points lies off the line between its neighbours. */
#include "study/refine.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "number/array.h"

enum { ROUNDS = 12, POINTS = 3000 };
static const double off_line = 1.0 / 2000, narrow = 1e-5;

/* The bulk of a curve: what its even points span without the outermost twentieth at either end. */
typedef struct bulk {
    double middle, height; /* 0: a constant */
} bulk;

typedef struct picture {
    const refinement *r;
    size_t n;
    long double *part, *value; /* n rows */
    bool *halve;               /* the interval behind a point */
    bulk *of;
} picture;

static bulk bulk_of(const picture *p, size_t column, double *sorted) {
    size_t n = 0;
    for (size_t i = 0; i < p->n; i++) {
        const double v = (double)p->value[i * p->r->count + column];
        if (isfinite(v))
            sorted[n++] = v;
    }
    if (!n)
        return (bulk){0, 0};
    qsort(sorted, n, sizeof *sorted, fret_ascending);
    double lo = sorted[n / 20], hi = sorted[n - 1 - n / 20];
    if (!(hi > lo)) {
        lo = sorted[0];
        hi = sorted[n - 1];
    }
    /* what differs by less is rounding */
    const double noise = 1e-9 * fmax(fabs(lo), fabs(hi));
    return (bulk){(lo + hi) / 2, hi - lo > noise ? hi - lo : 0};
}

static double value_at(const picture *p, size_t i, size_t column) {
    return (double)p->value[i * p->r->count + column];
}

/* Off the picture, as near a pole? */
static bool is_far(const bulk *b, double v) {
    return fabs(v - b->middle) > 2 * b->height;
}

static void mark(picture *p, size_t i) {
    if (p->part[i + 1] - p->part[i] > narrow)
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
        const double t = (double)((p->part[i] - p->part[i - 1]) / (p->part[i + 1] - p->part[i - 1]));
        if (!isfinite(last) || !(fabs(here - (last + (next - last) * t)) > off_line * b->height))
            continue;
        if (!is_far(b, last) || !is_far(b, here))
            mark(p, i - 1);
        if (!is_far(b, here) || !is_far(b, next))
            mark(p, i);
    }
}

/* The middles of marked intervals come between their ends, from the back so that nothing is overwritten. */
static void merge(picture *p, size_t more, const long double *part, const long double *value) {
    const size_t count = p->r->count, row = count * sizeof *value;
    for (size_t i = p->n, to = p->n + more, k = more; i-- > 0;) {
        if (i + 1 < p->n && p->halve[i]) {
            k--, to--;
            p->part[to] = part[k];
            memcpy(p->value + to * count, value + k * count, row);
        }
        to--;
        p->part[to] = p->part[i];
        memmove(p->value + to * count, p->value + i * count, row);
    }
    p->n += more;
}

/* One round: more gets how many points have been added. */
static bool halve(picture *p, long double *part, long double *value, size_t *more) {
    memset(p->halve, 0, p->n * sizeof *p->halve);
    for (size_t j = 0; j < p->r->count; j++)
        mark_column(p, j);
    *more = 0;
    for (size_t i = 0; i + 1 < p->n && p->n + *more < POINTS; i++)
        if (p->halve[i])
            part[(*more)++] = (p->part[i] + p->part[i + 1]) / 2;
    if (p->n + *more >= POINTS) /* a curve that bends everywhere is drawn as it is */
        *more = 0;
    if (!p->r->evaluate(p->r->context, part, *more, value))
        return false;
    if (*more)
        merge(p, *more, part, value);
    return true;
}

static bool run_rounds(picture *p, double *sorted, long double *part, long double *value) {
    for (size_t i = 0; i < p->n; i++)
        p->part[i] = (long double)i / (long double)(p->n - 1);
    if (!p->r->evaluate(p->r->context, p->part, p->n, p->value))
        return false;
    for (size_t j = 0; j < p->r->count; j++)
        p->of[j] = bulk_of(p, j, sorted);
    size_t more = 1;
    for (int round = 0; round < ROUNDS && more; round++)
        if (!halve(p, part, value, &more))
            return false;
    for (size_t i = 0; i < p->n; i++)
        if (!p->r->give(p->r->context, p->part[i], p->value + i * p->r->count))
            return false;
    return true;
}

bool refine(const refinement *r, calc_error *error) {
    const size_t room = r->steps + 1 > POINTS ? r->steps + 1 : POINTS;
    picture p = {.r = r, .n = r->steps + 1};
    p.part = malloc(room * sizeof *p.part);
    p.value = malloc(room * r->count * sizeof *p.value);
    p.halve = malloc(room * sizeof *p.halve);
    p.of = malloc(r->count * sizeof *p.of);
    double *sorted = malloc(room * sizeof *sorted);
    long double *part = malloc(room * sizeof *part), *value = malloc(room * r->count * sizeof *value);
    bool ok = p.part && p.value && p.halve && p.of && sorted && part && value;
    ok = ok ? run_rounds(&p, sorted, part, value) : calc_no_memory(error);
    free(p.part);
    free(p.value);
    free(p.halve);
    free(p.of);
    free(sorted);
    free(part);
    free(value);
    return ok;
}
