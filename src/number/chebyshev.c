/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chebyshev interpolation: see chebyshev.h. Pure arithmetic. */
#include "number/chebyshev.h"

#include "number/real.h"

/* Coefficients of T_i by the recurrence T_i = 2 z T_(i-1) - T_(i-2), with z = 2y-1 for powers of y. */
static void make_powers(fret_chebyshev *c) {
    for (int i = 0; i < c->count; i++)
        for (int j = 0; j < c->count; j++) {
            const fret_real lower = i > 0 && j > 0 ? c->power[i - 1][j - 1] : 0,
                            same = i > 0 ? c->power[i - 1][j] : 0, z = c->from_nil ? 2 * lower - same : lower;
            c->power[i][j] = i == 0 ? (fret_real)(j == 0) : i == 1 ? z : 2 * z - c->power[i - 2][j];
        }
}

void fret_chebyshev_make(fret_chebyshev *c, int count, bool from_nil) {
    c->count = count;
    c->from_nil = from_nil;
    for (int i = 0; i < 4 * count; i++)
        c->wave[i] = cosl(FRET_PI * (fret_real)i / (fret_real)(2 * count));
    for (int j = 0; j < count; j++) {
        const fret_real z = c->wave[2 * j + 1];
        c->node[j] = from_nil ? (1 + z) / 2 : z;
        for (int i = 0; i < count; i++)
            c->at[i][j] = c->wave[i * (2 * j + 1) % (4 * count)];
    }
    make_powers(c);
}

void fret_chebyshev_terms(const fret_chebyshev *c, const fret_real *value, fret_real *term) {
    const int count = c->count, half = count / 2;
    fret_real fold[2][FRET_CHEBYSHEV / 2]; /* even and odd in z */
    for (int j = 0; j < half; j++) {
        fold[0][j] = value[j] + value[count - 1 - j];
        fold[1][j] = value[j] - value[count - 1 - j];
    }
    for (int i = 0; i < count; i += 2) { /* two sums at a time stay in registers */
        const fret_real *at = c->at[i], *next = c->at[i + 1];
        fret_real even = 0, odd = 0;
        for (int j = 0; j < half; j++) {
            even += at[j] * fold[0][j];
            odd += next[j] * fold[1][j];
        }
        term[i] = even * ((i ? 2 : 1) / (fret_real)count);
        term[i + 1] = odd * (2 / (fret_real)count);
    }
}

void fret_chebyshev_powers(const fret_chebyshev *c, const fret_real *term, int count, fret_real *power) {
    const int step = c->from_nil ? 1 : 2; /* T_i(z) has powers of the parity of i alone */
    for (int j = 0; j < FRET_CHEBYSHEV; j++) {
        fret_real sum = 0;
        for (int i = j; i < count; i += step)
            sum += term[i] * c->power[i][j];
        power[j] = sum;
    }
}
