/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Figures in memory: panels, series, points, and their thinning. Depends on plot.h. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "plot/plot.h"

static void series_free(plot_series *s) {
    free(s->title);
    free(s->x);
    free(s->y);
    free(s->y2);
    free(s);
}

void plot_figure_free(plot_figure *f) {
    for (size_t i = 0; i < f->count; i++) {
        plot_panel *p = f->panel[i];
        for (size_t j = 0; j < p->count; j++)
            series_free(p->series[j]);
        free(p->title);
        free(p->xlabel);
        free(p->ylabel);
        free(p->map.x);
        free(p->map.y);
        free(p->map.z);
        free(p->map.label);
        free(p);
    }
    f->count = 0;
}

plot_panel *plot_panel_add(plot_figure *f, calc_error *error) {
    if (f->count == PLOT_PANELS) {
        calc_fail(error, 0, 0, "more than %d figures side by side", PLOT_PANELS);
        return NULL;
    }
    plot_panel *p = malloc(sizeof *p);
    if (!p) {
        calc_no_memory(error);
        return NULL;
    }
    *p = (plot_panel){.xlo = NAN, .xhi = NAN, .ylo = NAN, .yhi = NAN};
    return f->panel[f->count++] = p;
}

plot_series *plot_series_add(plot_panel *p, plot_role role, const char *title, calc_error *error) {
    if (p->count == PLOT_CURVES) {
        calc_fail(error, 0, 0, "more than %d curves in a figure", PLOT_CURVES);
        return NULL;
    }
    plot_series *s = malloc(sizeof *s);
    char *own = title ? strdup(title) : NULL;
    if (!s || (title && !own)) {
        free(s);
        free(own);
        calc_no_memory(error);
        return NULL;
    }
    *s = (plot_series){.role = role, .style = -1, .title = own};
    return p->series[p->count++] = s;
}

bool plot_map_make(plot_panel *p, size_t nx, size_t ny, calc_error *error) {
    plot_map *m = &p->map;
    if (nx < 2 || ny < 2 || nx > PLOT_GRID || ny > PLOT_GRID)
        return calc_fail(error, 0, 0, "a map takes 2 to %d points along each axis", PLOT_GRID);
    m->x = calloc(nx, sizeof *m->x);
    m->y = calloc(ny, sizeof *m->y);
    m->z = malloc(nx * ny * sizeof *m->z);
    if (!m->x || !m->y || !m->z)
        return calc_no_memory(error); /* freed with the figure */
    for (size_t i = 0; i < nx * ny; i++)
        m->z[i] = NAN;
    m->nx = nx;
    m->ny = ny;
    return true;
}

/* ---- thinning ----------------------------------------------------------------------------------- */

/* Most points kept of a stretch: the first, the last, both extremes of three coordinates, and a gap. */
enum { PICKS = 9 };

static bool is_gap(const plot_series *s, size_t i) {
    return !isfinite(s->x[i]) || !isfinite(s->y[i]) || (s->y2 && !isfinite(s->y2[i]));
}

static void move_point(plot_series *s, size_t to, size_t from) {
    s->x[to] = s->x[from];
    s->y[to] = s->y[from];
    if (s->y2)
        s->y2[to] = s->y2[from];
}

static int by_place(const void *a, const void *b) {
    const size_t *m = a, *n = b;
    return (*m > *n) - (*m < *n);
}

/* Picks the points to keep of `count` from `begin` on, ascending without repeats; returns how many. */
static size_t choose(const plot_series *s, size_t begin, size_t count, size_t pick[PICKS]) {
    const double *of[3] = {s->x, s->y, s->y2};
    size_t n = 0, end = begin + count, first = begin, gap = end;
    for (size_t i = begin; i < end && gap == end; i++)
        if (is_gap(s, i))
            gap = i;
    while (first < end && is_gap(s, first))
        first++;
    pick[n++] = begin;
    pick[n++] = end - 1;
    if (gap < end)
        pick[n++] = gap;
    for (int c = 0; c < 3 && first < end; c++) {
        size_t lo = first, hi = first;
        for (size_t i = first; of[c] && i < end; i++) {
            if (is_gap(s, i))
                continue;
            lo = of[c][i] < of[c][lo] ? i : lo;
            hi = of[c][i] > of[c][hi] ? i : hi;
        }
        pick[n++] = lo;
        pick[n++] = hi;
    }
    qsort(pick, n, sizeof *pick, by_place);
    size_t kept = 1;
    for (size_t i = 1; i < n; i++)
        if (pick[i] != pick[kept - 1])
            pick[kept++] = pick[i];
    return kept;
}

/* Moves about `goal` of the points from begin to end to index `to`; returns where they end. */
static size_t squeeze(plot_series *s, size_t begin, size_t end, size_t goal, size_t to) {
    const size_t count = end - begin, buckets = goal / 4 ? goal / 4 : 1; /* 4: kept of a zigzag */
    for (size_t i = 0; i < buckets && count; i++) {
        size_t pick[PICKS];
        const size_t from = begin + count / buckets * i + count % buckets * i / buckets,
                     until = begin + count / buckets * (i + 1) + count % buckets * (i + 1) / buckets;
        const size_t kept = choose(s, from, until - from, pick);
        for (size_t j = 0; j < kept; j++)
            move_point(s, to++, pick[j]);
    }
    return to;
}

/* Thins a full series. Points left from earlier thinning keep a share in proportion to those they stand for,
 * so that the series stays evenly spread. */
static void make_room(plot_series *s) {
    enum { GOAL = PLOT_KEPT / 4 }; /* buckets of 16 points, of which at most PICKS stay */
    const size_t fresh = s->count - s->thinned,
                 old = (size_t)((double)GOAL * (1 - (double)fresh / (double)s->came)),
                 to = squeeze(s, 0, s->thinned, old, 0);
    s->count = squeeze(s, s->thinned, s->count, GOAL - old, to);
    s->thinned = s->count;
}

void plot_thin(plot_series *s, size_t goal) {
    if (s->thinned)
        make_room(s);
    if (s->count > goal)
        s->count = squeeze(s, 0, s->count, goal, 0);
    s->thinned = 0;
}

static bool grow(plot_series *s, bool band) {
    size_t room = s->room ? 2 * s->room : 256;
    if (room > PLOT_KEPT)
        room = PLOT_KEPT;
    double **of[3] = {&s->x, &s->y, &s->y2};
    for (int c = 0; c < 2 + band; c++) {
        double *grown = realloc(*of[c], room * sizeof *grown);
        if (!grown)
            return false;
        *of[c] = grown;
    }
    s->room = room;
    return true;
}

static bool add(plot_series *s, double x, double y, const double *y2) {
    if (s->count == s->room && s->room < PLOT_KEPT && !grow(s, y2 != NULL))
        return false;
    if (s->count == PLOT_KEPT)
        make_room(s);
    s->x[s->count] = x;
    s->y[s->count] = y;
    if (y2)
        s->y2[s->count] = *y2;
    s->count++;
    s->came++;
    return true;
}

bool plot_point(plot_series *s, double x, double y) {
    return add(s, x, y, NULL);
}

bool plot_band(plot_series *s, double x, double y, double y2) {
    return add(s, x, y, &y2);
}
