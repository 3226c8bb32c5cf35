/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The scan for brackets, and the root in each. Depends on points.h and number. */
#include "study/solve.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "number/array.h"
#include "number/least.h"
#include "number/root.h"

/* Intervals of the scan and of the finer one; halvings towards the limit of the scene; most evaluations for a
 * root (one of high order would take many more), brackets, and roots listed in a message. */
enum { SCAN = 24, FINE = 8 * SCAN, EDGE = 60, METHOD = 100, ROOTS = 48, LISTED = 12 };

typedef struct place {
    double x, f; /* f: NaN where there is no value */
} place;

typedef struct search {
    const solve_question *of;
    points p;
    dim d;
    bool known, ratios;
    double lo, hi; /* the range searched */
    unsigned places;
    place at[FINE + 1];
    place root[ROOTS], other[ROOTS]; /* brackets: a change of sign between them */
    unsigned roots;
    bool edged;     /* the scan has met the limit of what the scene allows */
    place edge;     /* the last place with a value there */
    calc_error why; /* the error beyond it */
    place nearest;  /* smallest |f| found between places of the scan without a crossing; f NaN: none */
    place dip;      /* smallest |f| found in the present search */
    double side;    /* sign of f in the present search */
    bool touches;
    bool pole;       /* a place without a value lies between two that have one */
    bool swings;     /* f has several extrema over the scan */
    double jump;     /* a place where f jumps through 0 */
    bool level;      /* f is 0 all the way between two places, as c is in gross slip */
    double from, to; /* the last two such places */
} search;

/* f = left - right, 0 if both are the same double: mu FN at 0.3 and 100 N is short of 30 N by rounding.
 * NaN: p.error is raised. */
static double apart(search *s, const value v[2]) {
    if (!points_keep_sides(&s->p, v, &s->d, &s->known))
        return (double)NAN;
    return (double)v[0].v == (double)v[1].v ? 0 : (double)(v[0].v - v[1].v);
}

/* f at a place; NaN: no value, or p.error is raised. */
static double difference(search *s, double at) {
    const long double x = at;
    value v[2];
    return points_at(&s->p, &x, v) ? apart(s, v) : (double)NAN;
}

static double middle(const search *s, double a, double b) {
    return s->ratios ? sqrt(a) * sqrt(b) : a + (b - a) / 2;
}

static bool opposite(double a, double b) {
    return (a < 0 && b > 0) || (a > 0 && b < 0);
}

static void add_bracket(search *s, place a, place b) {
    if (s->roots < ROOTS) {
        s->root[s->roots] = a;
        s->other[s->roots++] = b;
    }
}

/* ---- where to look ----------------------------------------------------------------------------- */

static bool choose_range(search *s, calc_error *error) {
    const knob *k = &s->of->name;
    double lo = -(double)INFINITY, hi = (double)INFINITY, now;
    s->lo = s->of->lo;
    s->hi = s->of->hi;
    if (!s->of->given) {
        if (k->is_input)
            input_range(k->in, &lo, &hi);
        if (k->is_input && k->in == IN_PHASE) {
            s->lo = 0;
            s->hi = 6.283185307179586;
        } else if (isfinite(lo) && isfinite(hi)) {
            const double margin = 1e-3 * (hi - lo);
            s->lo = lo + margin;
            s->hi = hi - margin;
        } else {
            char advice[LEX_NAME + 60];
            snprintf(advice, sizeof advice, ": solve %s for ... from LO to HI", k->text);
            if (!knob_present(s->of->c, k, &now))
                return knob_lacks(s->of->c, k, " to search around", advice, error);
            if (now == 0 && k->is_input && k->in == IN_NW)
                now = 1e4; /* the scan then covers 10 to 1e7 */
            if (now == 0)
                return calc_fail(error, 0, 0, "%s is 0, which gives no range to search%s", k->text, advice);
            s->lo = now / 1e3;
            s->hi = now * 1e3;
        }
    }
    s->ratios = points_ratios(s->lo, s->hi) || points_ratios(-s->lo, -s->hi);
    return true;
}

static void give_place(void *context, size_t i, long double x[]) {
    search *s = context;
    s->at[i].x = (double)points_place(s->lo, s->hi, s->ratios, (long double)i / s->places);
    *x = s->at[i].x;
}

static bool take_place(void *context, size_t i, const value v[], const calc_error *why) {
    search *s = context;
    s->at[i].f = why ? (double)NAN : apart(s, v);
    return true;
}

/* Is f 0 at both, and not only there? */
static bool are_level(search *s, place a, place b) {
    return a.f == 0 && b.f == 0 && difference(s, middle(s, a.x, b.x)) == 0;
}

/* Where a stretch with f 0 ends, between one of its places and a place beyond: that is a root, too. */
static double end_of_level(search *s, double level, double beyond) {
    for (unsigned i = 0; i < EDGE && !s->p.error->raised; i++) {
        const double mid = middle(s, level, beyond);
        *(difference(s, mid) == 0 ? &level : &beyond) = mid;
    }
    add_bracket(s, (place){level, 0}, (place){level, 0});
    return level;
}

/* Adds the brackets at place i, of which those inside a stretch with f 0 are none. */
static void look_at(search *s, unsigned i) {
    const place *p = &s->at[i];
    const bool first = i == 0, last = i == s->places, before = !first && are_level(s, p[-1], *p),
               after = !last && are_level(s, *p, p[1]);
    s->level = s->level || after;
    if (after && !before)
        s->from = first ? p->x : end_of_level(s, p->x, p[-1].x);
    if (before && !after)
        s->to = last ? p->x : end_of_level(s, p->x, p[1].x);
    if (before || after)
        return;
    if (p->f == 0 && (first || last || !opposite(p[-1].f, -p[1].f))) /* else search_dips does it */
        add_bracket(s, *p, *p);
    else if (!first && opposite(p->f, p[-1].f))
        add_bracket(s, p[-1], *p);
}

static bool scan(search *s) {
    enum { TURNS = 3 }; /* a cubic has 2 extrema */
    unsigned turns = 0;
    if (!points_go(&s->p, &(points_run){
                              .count = s->places + 1, .give = give_place, .take = take_place, .context = s}))
        return false;
    for (unsigned i = 0; i <= s->places; i++) {
        const place *p = &s->at[i];
        look_at(s, i);
        turns += i > 1 && opposite(p->f - p[-1].f, p[-1].f - p[-2].f);
        s->pole = s->pole || (i > 1 && isnan(p[-1].f) && !isnan(p[-2].f) && !isnan(p->f));
    }
    s->swings = turns >= TURNS;
    return !s->p.error->raised;
}

/* Halves the interval between a place without a value and one with: a root may hide there. */
static bool approach_edge(search *s, place bad, place good) {
    for (unsigned i = 0; i < EDGE; i++) {
        place mid = {.x = middle(s, bad.x, good.x)};
        if (mid.x == bad.x || mid.x == good.x)
            break;
        mid.f = difference(s, mid.x);
        if (s->p.error->raised)
            return false;
        if (isnan(mid.f)) {
            bad = mid;
            s->why = s->p.none;
        } else if (opposite(mid.f, good.f) || mid.f == 0) {
            add_bracket(s, mid, mid.f == 0 ? mid : good);
            return true;
        } else {
            good = mid;
        }
    }
    if (!s->why.raised) {
        difference(s, bad.x);
        s->why = s->p.none;
    }
    s->edged = true;
    s->edge = good;
    return true;
}

/* Costs many evaluations: once there are roots, only the fine scan does it, which follows poles, swings. */
static bool search_edges(search *s) {
    for (unsigned i = 0; i < s->places && (!s->roots || s->places == FINE); i++) {
        const place a = s->at[i], b = s->at[i + 1];
        if (isnan(a.f) != isnan(b.f) && !(isnan(a.f) ? approach_edge(s, a, b) : approach_edge(s, b, a)))
            return false;
    }
    return true;
}

/* ---- between the places of the scan ------------------------------------------------------------ */

/* |f| for the minimiser; 0 once the sides have crossed, which ends the search. */
static fret_real side_distance(fret_real x, fret_real *slope, void *context) {
    search *s = context;
    place p = {.x = (double)x};
    (void)slope;
    if (s->dip.f * s->side < 0)
        return 0;
    p.f = difference(s, p.x);
    if (p.f * s->side < s->dip.f * s->side)
        s->dip = p;
    return p.f * s->side;
}

/* No change of sign and |f| at a larger than at b, by more than rounding. */
static bool further(place a, place b) {
    return !opposite(a.f, b.f) && fabs(a.f) - fabs(b.f) > 1e-9 * fabs(b.f);
}

static bool as_far(place a, place b) {
    return fabs(a.f - b.f) <= 1e-9 * fabs(b.f);
}

/* |f| is least at b, between a and c: the sides may cross twice there, or touch. */
static bool go_nearer(search *s, place a, place b, place c) {
    static const double touching = 1e-13; /* |f| relative to that at a and c: what rounding leaves */
    const bool first = as_far(a, b);
    if (b.f == 0 && !opposite(a.f, -c.f)) /* the scan has it: they cross at b, or are equal at c too */
        return true;
    if (first || as_far(c, b)) { /* two equal places: the minimum lies between them, or f is constant */
        const place other = first ? a : c;
        place mid = {.x = middle(s, b.x, other.x)};
        mid.f = difference(s, mid.x);
        if (s->p.error->raised)
            return false;
        if (opposite(mid.f, b.f)) {
            add_bracket(s, b, mid);
            add_bracket(s, mid, other);
            return true;
        }
        if (fabs(mid.f) < fabs(b.f)) {
            a = b;
            b = mid;
            c = other;
        }
    }
    s->side = a.f > 0 ? 1 : -1;
    s->dip = b;
    const double lo = fmin(a.x, c.x), hi = fmax(a.x, c.x), part = 1e-5, apart = part * (hi - lo),
                 far = fmin(fabs(a.f), fabs(c.f));
    fret_least(side_distance, s, lo, hi, b.x, part);
    b = s->dip;
    if (b.f * s->side <= 1e-8 * far) { /* may be a tangency: a minimum is located to half of the digits */
        fret_least(side_distance, s, fmax(b.x - apart, lo), fmin(b.x + apart, hi), b.x, 1e-4L);
        b = s->dip;
    }
    if (s->p.error->raised)
        return false;
    const double least = b.f * s->side; /* not NaN: a comparison has chosen it */
    if (least < 0) {
        add_bracket(s, a, b);
        add_bracket(s, b, c);
    } else if (least <= touching * far) {
        s->touches = true;
        add_bracket(s, b, b);
    }
    if (!(fabs(s->nearest.f) <= least))
        s->nearest = b;
    return true;
}

/* At an end of the range: is there a minimum of |f| just inside? */
static bool search_end(search *s, place end, place next) {
    if (!further(next, end))
        return true;
    place p = {.x = end.x + 1e-3 * (next.x - end.x)};
    p.f = difference(s, p.x);
    if (s->p.error->raised)
        return false;
    if (are_level(s, end, p)) { /* so that the end is no root of its own, as the scan took it */
        for (unsigned i = 0; i < s->roots; i++)
            if (s->root[i].x == end.x)
                s->root[i] = s->other[i] = s->root[--s->roots];
        s->level = true;
        s->from = end.x;
        s->to = end_of_level(s, p.x, next.x);
        return true;
    }
    if (opposite(p.f, next.f)) {
        if (end.f != 0)
            add_bracket(s, end, p);
        add_bracket(s, p, next);
        return true;
    }
    return !(fabs(p.f) < fabs(end.f)) || go_nearer(s, end, p, next);
}

/* Searches the minima of |f| where no two places of the scan show a crossing. */
static bool search_dips(search *s) {
    const place *at = s->at;
    const unsigned last = s->places;
    bool level = false;
    for (unsigned i = 1; i < last; i++) {
        const place *a = &at[i - 1], *b = &at[i], *c = &at[i + 1];
        const bool before = further(*a, *b), after = further(*c, *b);
        if (((before && (after || as_far(*b, *c))) || (after && as_far(*b, *a) && !level)) &&
            !go_nearer(s, *a, *b, *c))
            return false;
        level = before && as_far(*b, *c);
    }
    return search_end(s, at[0], at[1]) && search_end(s, at[last], at[last - 1]);
}

static bool look_for_roots(search *s, unsigned places) {
    s->places = places;
    s->roots = 0;
    s->level = false;
    return scan(s) && search_edges(s) && search_dips(s);
}

/* ---- no root ----------------------------------------------------------------------------------- */

static bool no_root(search *s, calc_error *error) {
    const expr *left = s->of->sides;
    const knob *k = &s->of->name;
    place best = {.f = (double)NAN};
    char from[CALC_VALUE_TEXT], to[CALC_VALUE_TEXT], off[CALC_VALUE_TEXT], there[KNOB_TEXT];
    bool alike = true, below = false, above = false;
    for (unsigned i = 0; i <= s->places; i++) {
        if (!isnan(s->at[i].f) && !(fabs(s->at[i].f) >= fabs(best.f)))
            best = s->at[i];
        alike = alike && s->at[i].f == s->at[0].f;
        below = below || s->at[i].f < 0;
        above = above || s->at[i].f > 0;
    }
    calc_value_text(k->d, fmin(s->lo, s->hi), from);
    calc_value_text(k->d, fmax(s->lo, s->hi), to);
    if (isnan(best.f)) {
        const calc_error last = s->p.none;
        value v[2];
        points_at(&s->p, &(long double){s->lo}, v);
        if (!strcmp(last.text, s->p.none.text)) /* it is not for the value of the knob */
            return calc_fail(error, left->at, left->len, "%s", last.text);
        return calc_fail(error, left->at, left->len, "no value at any place tried from %s = %s to %s: %s",
                         k->text, from, to, last.text);
    }
    if (alike)
        return calc_fail(error, left->at, left->len, "the two sides %s for every %s from %s to %s",
                         best.f == 0 ? "are equal" : "differ by the same amount", k->text, from, to);
    if (below && above)
        return calc_fail(error, left->at, left->len,
                         "no root from %s = %s to %s: the sides pass each other where they have no value: %s",
                         k->text, from, to, s->why.text);
    if (fabs(s->nearest.f) <= fabs(best.f))
        best = s->nearest;
    if (s->edged && fabs(s->edge.f) <= fabs(best.f))
        best = s->edge;
    calc_value_text(s->d, best.f, off);
    knob_text(k, best.x, there);
    calc_fail(error, left->at, left->len,
              "no root from %s = %s to %s: the left side stays %s the right, nearest by %s at %s", k->text,
              from, to, best.f < 0 ? "below" : "above", off + (best.f < 0), there);
    if (s->edged) {
        knob_text(k, s->edge.x, there);
        calc_append(s->of->c, error, ", and there is no value beyond %s: %s", there, s->why.text);
    }
    return false;
}

/* ---- roots in brackets ------------------------------------------------------------------------- */

typedef struct sought {
    search *s;
    unsigned end; /* after this many evaluations return 0, which ends the method */
    bool lost;    /* there is no value at the place evaluated last */
} sought;

static double difference_there(double x, void *context) {
    sought *t = context;
    const double f = t->s->p.evaluations < t->end ? difference(t->s, x) : 0;
    t->lost = isnan(f);
    return t->lost ? 0 : f;
}

/* The root in bracket i, to the last digit. False: it holds a jump or a gap instead. */
static bool find_root(search *s, unsigned i, double *x) {
    const place a = s->root[i], b = s->other[i];
    sought t = {.s = s, .end = s->p.evaluations + METHOD};
    *x = a.x;
    if (a.x == b.x)
        return true;
    *x = fret_root_double(difference_there, &t, fmin(a.x, b.x), fmax(a.x, b.x));
    return !t.lost && !(fabs(difference(s, *x)) > 1e-3 * fmin(fabs(a.f), fabs(b.f)));
}

static bool only_jumps(search *s, double x, calc_error *error) {
    char there[KNOB_TEXT];
    knob_text(&s->of->name, x, there);
    return calc_fail(error, s->of->sides->at, s->of->sides->len,
                     "no root: the difference of the two sides jumps through 0 at %s", there);
}

/* Keeps the brackets that hold a root, not a jump, and replaces s->root by the sorted roots. */
static bool sift(search *s, solve_answer *out, calc_error *error) {
    place found[ROOTS];
    unsigned roots = 0, last = 0;
    for (unsigned i = 0; i < s->roots; i++) {
        double x;
        const bool is = find_root(s, i, &x);
        if (error->raised)
            return false;
        if (is) {
            found[roots++].x = out->x = x;
            last = i;
        } else {
            out->jumps = true;
            s->jump = x;
        }
    }
    out->lo = fmin(s->root[last].x, s->other[last].x);
    out->hi = fmax(s->root[last].x, s->other[last].x);
    s->roots = roots;
    qsort(found, roots, sizeof *found, fret_ascending);
    memcpy(s->root, found, roots * sizeof *found);
    return true;
}

static bool several(search *s, calc_error *error) {
    char list[CALC_ERROR_TEXT / 2] = "", text[CALC_VALUE_TEXT];
    for (unsigned i = 0; i < s->roots && i <= LISTED; i++) {
        calc_value_text(s->of->name.d, s->root[i].x, text);
        list_word(list, sizeof list, ", ", i == LISTED ? "..." : text);
    }
    return calc_fail(error, s->of->sides->at, s->of->sides->len,
                     "several roots, %s = %s: choose one with from LO to HI", s->of->name.text, list);
}

static bool answer_root(search *s, solve_answer *out, calc_error *error) {
    if (!choose_range(s, error))
        return false;
    for (unsigned places = SCAN;
         places <= FINE && (places == SCAN || !s->roots || out->jumps || s->pole || s->swings || s->touches);
         places += FINE - SCAN)
        if (!look_for_roots(s, places) || !sift(s, out, error))
            return false;
    if (!s->roots)
        return out->jumps ? only_jumps(s, s->jump, error) : no_root(s, error);
    if (s->roots > 1)
        return several(s, error);
    out->evaluations = s->p.evaluations;
    out->touches = s->touches;
    out->level = s->level;
    out->from = fmin(s->from, s->to);
    out->to = fmax(s->from, s->to);
    return true;
}

bool solve(const solve_question *question, solve_answer *out, calc_error *error) {
    search s = {.of = question, .nearest = {.f = (double)NAN}};
    *out = (solve_answer){.jumps = false};
    const bool ok = points_open(&s.p, question->c, &question->name, 1, question->sides, 2, error) &&
                    answer_root(&s, out, error);
    points_close(&s.p);
    return ok;
}
