/* SPDX-License-Identifier: GPL-3.0-or-later */
/* x^s for many x and one s, 0 < s <= 6: a table of C^s in the middles C of cells, 128 in each of 1/2..1 and
 * 1..2, a series in between, and 2^(es) for the other octaves. Half the latency of a logarithm and an
 * exponential. Not installed. */
#ifndef FRET_NUMBER_POWERS_H
#define FRET_NUMBER_POWERS_H

#include "number/double.h"
#include "number/real.h"

/* Octaves from 2^-30 to 4. */
enum {
    FRET_CELLS = 128,
    FRET_LOWEST_OCTAVE = 30,
    FRET_OCTAVES = 32,
    FRET_POWERS = 8,
    FRET_DOUBLE_POWERS = 6
};

/* For x of any size, to 4e-19; beyond the octaves as an exponential of a logarithm. */
typedef struct fret_powers {
    fret_real s, power[2 * FRET_CELLS], per_middle[FRET_CELLS]; /* C^s; 1/C in 1..2 */
    fret_real octave[FRET_OCTAVES], series[FRET_POWERS];        /* of ((1+f)^s - 1)/f */
} fret_powers;

void fret_powers_make(fret_real s, fret_powers *out);

/* Where the cell of x is: in which octave, and in which part of it. */
typedef struct fret_cell {
    uint64_t octave, part; /* octave: FRET_OCTAVES or more where there is none */
    size_t at;             /* of C^s */
} fret_cell;

FRET_INLINE fret_cell fret_cell_of(uint64_t bits) {
    const uint64_t octave = (bits >> 52) - (1023 - FRET_LOWEST_OCTAVE), part = bits >> 45 & (FRET_CELLS - 1);
    return (fret_cell){octave, part, part + (octave == FRET_LOWEST_OCTAVE - 1 ? 0 : FRET_CELLS)};
}

/* x > 0 */
static inline fret_real fret_power_of(const fret_powers *p, fret_real x) {
    const uint64_t bits = fret_bits((double)x);
    const fret_cell in = fret_cell_of(bits);
    if (in.octave >= FRET_OCTAVES)
        return fret_exp(p->s * fret_log(x));
    const double middle = fret_from_bits((bits & 0xffffe00000000000) | 0x0000100000000000),
                 per_octave = fret_from_bits(0x7fe0000000000000 - (bits & 0x7ff0000000000000));
    const fret_real f = (x - middle) * per_octave * p->per_middle[in.part], f2 = f * f, *b = p->series;
    const fret_real base = p->power[in.at] * p->octave[in.octave];
    const fret_real rise =
        ((b[0] + b[1] * f) + f2 * (b[2] + b[3] * f)) + f2 * f2 * ((b[4] + b[5] * f) + f2 * (b[6] + b[7] * f));
    return base + base * (f * rise);
}

/* In double: to 0.6 ulp in 1/2..2, to 2 in the other octaves, beyond as fret_double_power. */
typedef struct fret_double_powers {
    double s;
    struct {
        double power, tail; /* C^s = power (1 + tail) */
    } cell[2 * FRET_CELLS];
    double per_middle[FRET_CELLS], octave[FRET_OCTAVES], series[FRET_DOUBLE_POWERS];
} fret_double_powers;

void fret_double_powers_make(double s, fret_double_powers *out);

/* x > 0, normal */
static inline double fret_double_power_of(const fret_double_powers *p, double x) {
    const uint64_t bits = fret_bits(x);
    const fret_cell in = fret_cell_of(bits);
    if (in.octave >= FRET_OCTAVES)
        return fret_double_power(x, p->s);
    const double m = fret_from_bits((bits & 0x000fffffffffffff) | 0x3ff0000000000000),
                 middle = fret_from_bits(in.part << 45 | 0x3ff0100000000000);
    const double f = (m - middle) * p->per_middle[in.part], f2 = f * f, *b = p->series;
    const double base = p->cell[in.at].power * p->octave[in.octave];
    const double rise = f * ((b[0] + b[1] * f) + f2 * ((b[2] + b[3] * f) + f2 * (b[4] + b[5] * f)));
    return base + base * (rise + p->cell[in.at].tail);
}

#endif
