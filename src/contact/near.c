/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The binomial series of a power law about places that are kept. Touches nothing else. */
#include "contact/near.h"

static const double steepest = 8; /* the series would want more terms */

bool fret_near_fits(const fret_normal *n) {
    return fret_normal_closed(n) && n->p <= steepest;
}

/* Both are quotients of series, by the even part of the binomial one. */
static void make_way(fret_near_law *law) {
    double sag[FRET_NEAR_WAY + 2] = {0}, lean[FRET_NEAR_WAY + 2] = {(double)law->s};
    for (int i = 1; i <= FRET_NEAR_WAY + 1; i++) {
        const double even = law->binomial[2 * i];
        sag[i] = even * (2 * i) / (2 * i + 1);
        lean[i] = law->binomial[2 * i + 1] - even * lean[0];
        for (int j = 1; j < i; j++) {
            sag[i] -= law->binomial[2 * j] * sag[i - j];
            lean[i] -= law->binomial[2 * j] * lean[i - j];
        }
    }
    for (int i = 0; i < FRET_NEAR_WAY; i++) {
        law->sag[i] = sag[i + 2];
        law->lean[i] = lean[i + 2];
    }
    law->most_square = fmin(1 / 64.0, 0.025 / (double)(law->s * law->s)); /* both series have ended there */
    law->first_sag = law->leading[2] * 2 / 3;
    law->first_lean = law->leading[3] - law->leading[2] * law->s;
}

static void make_law(fret_real s, fret_real sm1, fret_near_law *out) {
    fret_real term = s;
    *out = (fret_near_law){.s = s, .sm1 = sm1, .leading = {1}, .binomial = {1}};
    for (int i = 1; i < FRET_NEAR_TERMS; i++) {
        if (i < FRET_NEAR_LEADING)
            out->leading[i] = term;
        out->binomial[i] = (double)term;
        out->rest[i] = i < FRET_NEAR_LEADING ? (double)(term - out->binomial[i]) : out->binomial[i];
        term *= (sm1 - (fret_real)(i - 1)) / (fret_real)(i + 1);
    }
    make_way(out);
}

void fret_near_make(const fret_normal *n, fret_near *out) {
    out->normal = n;
    out->made_of[0] = n->wide.p;
    out->made_of[1] = n->wide.ln_depth;
    out->made_of[2] = n->wide.ln_force;
    make_law(n->p, n->pm1, &out->law[DEPTH]);
    make_law(n->q, -n->pm1 * n->q, &out->law[LOAD]);
}

static bool same(dd a, dd b) {
    return a.hi == b.hi && a.lo == b.lo;
}

void fret_near_move(fret_near *near, const fret_normal *n) {
    near->normal = n;
    if (!same(near->made_of[0], n->wide.p) || !same(near->made_of[1], n->wide.ln_depth) ||
        !same(near->made_of[2], n->wide.ln_force))
        fret_near_make(n, near);
}

void fret_near_keep(fret_near *near, coordinate by, size_t i, double y) {
    const fret_real least = 1e-290L, most = 1e290L;
    fret_press p;
    const fret_status st =
        by == LOAD ? fret_press_by_force(near->normal, y, &p) : fret_press_by_depth(near->normal, y, &p);
    const fret_real v = by == LOAD ? p.dz : p.F;
    const bool inside = !st.code && v > least && v < most && p.a > least && p.a < most;
    fret_near_law *law = &near->law[by];
    law->place[i].at = y;
    law->place[i].per = 1 / (fret_real)y;
    law->place[i].v = inside ? v : (fret_real)NAN;
    law->place[i].rest = by == LOAD ? p.dz_rest : p.F_rest;
}
