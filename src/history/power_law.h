/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A power law v ~ y^s, load of depth or depth of load, for numbers of type NUMBER, and its bending over
 * slices. FUNCTION(f) is libm's f for that type, POWER(x, s) a power. Included once for each type; pure. */
#include "number/bits.h"
#include "number/real.h"

/* Up to s = 4 powers with whole 2 s (sphere, cone at k = 0) are products of x and sqrt(x). */
enum { LAW_HALVES = 8 };

/* Three series; their later terms, in pairs, are so small that double suffices. */
typedef double law_pair __attribute__((vector_size(16)));
enum { CROSS, EVEN, ODD, LAW_SERIES, LAW_LEADING = 2, LAW_PAIRS = 14 };

typedef struct power_law {
    NUMBER s, sm1, bend; /* sm1 = s-1 without cancellation; bend = |s (s-1)| */
    int halves;          /* 2 s if powers are products of x and sqrt(x), else 0 */
    NUMBER per_y, v;     /* 1/y and v at a reference point near the present one */
    NUMBER per_reach;    /* the series are in (rho/reach)^2, and good up to 1/4 */
    NUMBER leading[LAW_LEADING][LAW_SERIES];
    law_pair later[LAW_PAIRS][LAW_SERIES];
} power_law;

/* With b = v'' over a slice from c (1-rho) to c (1+rho), u the distance from c in units of c, each of
 *   int (rho^2-u^2) b du,   int (rho^2+u^2) b du,   2 rho int u b du
 * is rho^3 s (s-1) v(c) times a series in rho^2, the last one also times rho, by the binomial series of
 * (1+u)^(s-2). v(c) follows from the values at the ends, whose mean is v(c) times the even part of (1+rho)^s:
 * the coefficients kept are those of the quotients, which converge up to rho = tan(pi/(2s)), at most 1. */
static inline void power_make(fret_real s, fret_real sm1, power_law *out) {
    enum { TERMS = LAW_LEADING + 2 * LAW_PAIRS };
    const fret_real reach = s > 2 ? tanl(FRET_PI / (2 * s)) : 1, twice = 2 * s;
    fret_real mean[TERMS], term[LAW_SERIES][TERMS], b = 1, e = 1;
    *out = (power_law){.s = (NUMBER)s,
                       .sm1 = (NUMBER)sm1,
                       .bend = (NUMBER)fabsl(s * sm1),
                       .halves = twice == floorl(twice) && twice <= (fret_real)LAW_HALVES ? (int)twice : 0,
                       .per_reach = (NUMBER)(1 / reach)};
    for (int j = 0; j < TERMS; j++) {
        const fret_real k = 2 * j, odd = b * (sm1 - 1 - k) / (k + 1) * reach;
        mean[j] = e;
        term[CROSS][j] = 2 * b / ((k + 1) * (k + 3));
        term[EVEN][j] = b * (k + 2) / ((k + 1) * (k + 3));
        term[ODD][j] = odd / (k + 3);
        b = odd * (sm1 - 2 - k) / (k + 2) * reach;
        e *= (s - k) / (k + 1) * reach * (s - k - 1) / (k + 2) * reach;
        for (int m = 0; m < LAW_SERIES; m++) {
            for (int i = 1; i <= j; i++)
                term[m][j] -= mean[i] * term[m][j - i];
            if (j < LAW_LEADING)
                out->leading[j][m] = (NUMBER)term[m][j];
            else
                out->later[(j - LAW_LEADING) / 2][m][(j - LAW_LEADING) % 2] = (double)term[m][j];
        }
    }
}

/* x^s, x > 0 */
static NUMBER power_of(const power_law *p, NUMBER x) {
    if (!p->halves)
        return POWER(x, p->s);
    NUMBER product = p->halves & 1 ? FUNCTION(sqrt)(x) : 1;
    for (int i = p->halves; i > 1; i -= 2)
        product *= x;
    return product;
}

/* v(y), y >= 0. Hertz's s = 3/2 is inline: a call takes as long as the root. */
FRET_INLINE NUMBER power_value(const power_law *p, NUMBER y) {
    const NUMBER x = y * p->per_y;
    if (!(x > 0))
        return 0;
    return p->v * (p->halves == 3 ? FUNCTION(sqrt)(x) * x : power_of(p, x));
}

/* ---- what a slice bends ------------------------------------------------------------------------ */

/* A place: a coordinate, the other one and, if found (not all zeros), its SPOT in the law. */
typedef struct place {
    NUMBER y, v;
    SPOT at;
} place;

/* The bending of a slice of thickness w, with t the distance from its outer end and dm = |v''| dy:
 *   inner = int t^2 dm/w^2,   middle = 2 int t (w-t) dm/w^2,   outer = int (w-t)^2 dm/w^2. */
typedef struct bow {
    NUMBER inner, middle, outer;
} bow;

/* The same for a slice of most of the contact, in closed form, with x = inner/outer. A straight line does not
 * bend, so (y/outer)^s = 1 + a (y/outer - 1) + e is replaced by e: a = 0 for flat laws, else 1. */
static bow power_thick_bow(const power_law *p, const place *outer, const place *inner, NUMBER w) {
    const bool flat = p->s < (NUMBER)0.5, straight = p->bend < (NUMBER)0.2;
    const NUMBER x = inner->y / outer->y, h = w / outer->y, s = p->s;
    NUMBER e = (inner->v - outer->v) / outer->v + (flat ? 0 : h);
    if (straight && x > 0)
        e = flat ? FUNCTION(expm1)(s * FUNCTION(log)(x)) : x * FUNCTION(expm1)(p->sm1 * FUNCTION(log)(x));
    const NUMBER steep[2] = {flat ? s : p->sm1, /* de/dx at both ends */
                             !(x > 0)            ? -1
                             : straight && !flat ? p->sm1 + s * (e / x)
                                                 : s * (inner->v / outer->v) / x - (flat ? 0 : 1)};
    const NUMBER area = (h * (flat ? -s : -p->sm1 * (1 - h / 2)) - x * e) / (s + 1); /* int e dx */
    const NUMBER cross = h * e - 2 * area, scale = (p->sm1 < 0 ? -1 : 1) * outer->v / outer->y / (h * h);
    return (bow){scale * (h * (-e - h * steep[1]) - cross), scale * 2 * cross,
                 scale * (h * (h * steep[0] + e) - cross)};
}

FRET_INLINE NUMBER series_sum(const power_law *p, int which, NUMBER x, law_pair later) {
    const double x1 = (double)x;
    return p->leading[0][which] + x * (p->leading[1][which] + x * (later[0] + x1 * later[1]));
}

FRET_INLINE bow power_bow(const power_law *p, const place *outer, const place *inner, NUMBER w) {
    const NUMBER per = 1 / (outer->y + inner->y), rho = w * per, part = rho * p->per_reach, x = part * part;
    if (!(x < (NUMBER)0.25))
        return power_thick_bow(p, outer, inner, w);
    /* x^(2 + 2 pairs) is 2^-60 or less */
    const int pairs = x < (NUMBER)0x1p-11 ? 2 : x < (NUMBER)0x1p-5 ? 5 : x < (NUMBER)0x1p-3 ? 9 : LAW_PAIRS;
    const double square = (double)(x * x);
    const law_pair *c = p->later[pairs - 1];
    law_pair cross = c[CROSS], even = c[EVEN], odd = c[ODD];
    while (c > p->later[0]) {
        c -= LAW_SERIES;
        cross = cross * square + c[CROSS];
        even = even * square + c[EVEN];
        odd = odd * square + c[ODD];
    }
    const NUMBER scale = p->bend * (outer->v + inner->v) * rho * per, both = series_sum(p, EVEN, x, even),
                 aside = part * series_sum(p, ODD, x, odd);
    return (bow){scale * (both - aside), scale * series_sum(p, CROSS, x, cross), scale * (both + aside)};
}
