/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The tables of powers.h. Pure arithmetic. */
#include "number/powers.h"

#include "number/sum.h"

/* So many terms of (1+f)^s do for |f| < 1/64. */
enum { BINOMIALS = 12 };

static fret_real binomial_sum(const fret_real c[BINOMIALS], fret_real f) {
    fret_real sum = 0;
    for (int j = BINOMIALS; j-- > 0;)
        sum = sum * f + c[j];
    return sum;
}

void fret_powers_make(fret_real s, fret_powers *out) {
    const fret_real two = fret_pow(2, s);
    fret_real last = 1, term = 1, binomial[BINOMIALS]; /* of ((1+f)^s - 1)/f */
    fret_sum sum = {1, 0};
    out->s = s;
    for (int j = 0; j < BINOMIALS; j++) {
        term *= (s - j) / (j + 1);
        binomial[j] = term;
    }
    for (int j = 0; j < FRET_POWERS; j++)
        out->series[j] = binomial[j];
    for (int i = 0; i < FRET_CELLS; i++) {
        const fret_real middle = 1 + (i + 0.5L) / (fret_real)FRET_CELLS;
        const fret_real f = (middle - last) / last;
        fret_sum_add(&sum, fret_sum_value(&sum) * (f * binomial_sum(binomial, f)));
        const fret_real power = fret_sum_value(&sum);
        last = middle;
        out->power[i] = power / two;
        out->power[FRET_CELLS + i] = power;
        out->per_middle[i] = 1 / middle;
    }
    for (int e = 0; e < FRET_LOWEST_OCTAVE - 1; e++)
        out->octave[e] = fret_pow(fret_from_bits((uint64_t)(e + 1023 - FRET_LOWEST_OCTAVE) << 52), s);
    out->octave[FRET_LOWEST_OCTAVE - 1] = out->octave[FRET_LOWEST_OCTAVE] = 1; /* both are in the table */
    out->octave[FRET_LOWEST_OCTAVE + 1] = two;
}

void fret_double_powers_make(double s, fret_double_powers *out) {
    fret_powers p;
    fret_powers_make(s, &p);
    out->s = s;
    for (int i = 0; i < 2 * FRET_CELLS; i++) {
        const double main = (double)p.power[i];
        out->cell[i].power = main;
        out->cell[i].tail = (double)((p.power[i] - main) / p.power[i]);
    }
    for (int i = 0; i < FRET_CELLS; i++)
        out->per_middle[i] = (double)p.per_middle[i];
    for (int i = 0; i < FRET_OCTAVES; i++)
        out->octave[i] = (double)p.octave[i];
    for (int i = 0; i < FRET_DOUBLE_POWERS; i++)
        out->series[i] = (double)p.series[i];
}
