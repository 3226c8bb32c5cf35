/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kernel of two radii by its series about where they are equal, and about where one is 0; rows near a
 * place one by one, those far from it in the blocks of their table. Changes nothing but what it makes. */
#include "contact/ripple.h"

#include <float.h>

#include "number/quadrature.h"
#include "number/real.h"

/* ---- the kernel -------------------------------------------------------------------------------- */

/* ln of 8^k G(1+k/2)^2 G(1-k) / (G(1+k) G(1-k/2)^2), over k, by zeta of the odd numbers */
static fret_real log_ratio(fret_real k) {
    static const fret_real zeta[] = {1.202056903159594285399738L, 1.036927755143369926331366L,
                                     1.008349277381922826839798L, 1.002008392826082214417853L,
                                     1.000494188604119464558702L, 1.000122713347578489146752L,
                                     1.000030588236307020493552L, 1.000007637197637899762274L};
    const fret_real ln8 = 2.079441541679835928251696L;
    fret_real sum = 0, power = k * k;
    for (int j = 1; j <= (int)(sizeof zeta / sizeof *zeta); j++, power *= k * k)
        sum += 2 * zeta[j - 1] * power * (1 - ldexpl(1, -2 * j)) / (2 * j + 1);
    return ln8 + sum;
}

void fret_ripple_make(fret_ripple *p, fret_real k) {
    static const fret_real little = 0.05L;
    const fret_real m = (k + 1) / 2, b = 1 - k, half = tgammal(1 - k / 2);
    *p = (fret_ripple){.k = k, .m = m, .whole = FRET_PI / (2 * sinl(FRET_PI * fminl(m, 1 - m)))};
    const fret_real size = p->whole * fret_pow(2, -k) * half * half / (FRET_PI * tgammal(1 - k)),
                    L = k * log_ratio(k);
    p->bent[0] = -size;
    if (fabsl(k) <= little) {
        p->smooth[0] = size * (k != 0 ? expm1l(L) / k : log_ratio(k));
    } else {
        const fret_real other = tgammal(1 + k / 2);
        p->smooth[0] = (p->whole * fret_pow(4, k) * other * other / (FRET_PI * tgammal(1 + k)) - size) / k;
    }
    /* the equation y(1-y^2)Y'' + (1-(1+2b)y^2)Y' - b^2 y Y = 0 */
    for (int n = 0; n + 1 < FRET_RIPPLE; n++) {
        const fret_real s = n, e = n + k, before = n > 0 ? p->bent[n - 1] : 0;
        p->bent[n + 1] = -((3 * e * e + (4 * b - 1) * e + b * b) * p->bent[n] + s * s * before) /
                         (2 * (s + 1 + k) * (s + 1));
        p->smooth[n + 1] =
            -((3 * s * s + (4 * b - 1) * s + b * b) * p->smooth[n] +
              (n > 0 ? (s - 1 + b) * (s - 1 + b) * p->smooth[n - 1] : 0) + (6 * s + 3 - k) * p->bent[n] +
              (2 * s - 1 + b) * before + 4 * (s + 1) * p->bent[n + 1]) /
            (2 * (s + 1) * (s + 1 - k));
    }
    for (int n = 0; n < FRET_RIPPLE; n++) {
        p->one[n] = 1 / (fret_real)(n + 1);
        p->with[n] = 1 / (n + 1 + k);
        p->over[n] = p->one[n] / (fret_real)(n + 2);
    }
    p->centre[0] = 1;
    for (int n = 0; n + 1 < 3 * FRET_RIPPLE; n++)
        p->centre[n + 1] = p->centre[n] * ((1 - m + n) / (1 + n)) * ((1 - m + n) / (1 + n));
}

static const fret_real NEAR = 0.25L; /* of u */

/* So many powers of u count: 37 at most. */
static int terms_of(fret_real u) {
    int terms = 3;
    for (fret_real left = 1e20L * u * u * u; left > 1; left *= u)
        terms++;
    return terms;
}

static fret_real bend_of(const fret_ripple *p, fret_real u) {
    const fret_real l = logl(u);
    return p->k != 0 ? expm1l(p->k * l) / p->k : l;
}

void fret_ripple_at(const fret_ripple *p, fret_real y, fret_real u, fret_real out[2]) {
    fret_real Y = 0, slope = 0;
    if (fabsl(u) <= NEAR) {
        const fret_real S = bend_of(p, fabsl(u)), power = 1 + p->k * S;
        for (int n = terms_of(fabsl(u)); n-- > 0;) {
            const fret_real c = p->smooth[n] + p->bent[n] * S;
            slope = slope * u + n * c + p->bent[n] * power;
            Y = Y * u + c;
        }
        out[0] = Y;
        out[1] = slope / u;
        return;
    }
    /* F(1-m,1-m;1;z), of which 0.8^2 takes 104 terms */
    const fret_real part = y < 1 ? y : 1 / y, z = part * part;
    fret_real power = 1;
    for (int n = 0; power > 1e-20L; n++, power *= z) {
        Y += p->centre[n] * power;
        slope += 2 * n * p->centre[n] * power;
    }
    const fret_real whole = y < 1 ? p->whole : p->whole * fret_pow(y, p->k - 1);
    out[0] = whole * Y;
    out[1] = y < 1 ? whole * slope / y : whole / y * ((p->k - 1) * Y - slope);
}

/* ---- rows -------------------------------------------------------------------------------------- */

/* h = c[0] + c[1] t + c[2] t^2, t = s - r, and r. */
typedef struct bow {
    fret_real c[3], r;
} bow;

/* Of h Y from t = 0 on; |t| <= NEAR r. */
static fret_real near_to(const fret_ripple *p, const bow *h, fret_real t) {
    if (t == 0)
        return 0;
    const fret_real u = t / h->r, S = bend_of(p, fabsl(u)), c0 = h->c[0], c1 = h->c[1] * h->r,
                    c2 = h->c[2] * h->r * h->r;
    fret_real sum = 0;
    for (int n = terms_of(fabsl(u)); n-- > 0;) {
        const fret_real smooth = c0 * p->smooth[n] + (n > 0 ? c1 * p->smooth[n - 1] : 0) +
                                 (n > 1 ? c2 * p->smooth[n - 2] : 0),
                        bent = c0 * p->bent[n] + (n > 0 ? c1 * p->bent[n - 1] : 0) +
                               (n > 1 ? c2 * p->bent[n - 2] : 0),
                        over = p->one[n], with = p->with[n];
        sum = sum * u + (smooth * over + bent * with * (S - over));
    }
    return sum * t;
}

static fret_real far_from(const fret_ripple *p, const bow *h, fret_real lo, fret_real hi) {
    fret_real sum = 0, Y[2];
    for (int j = 0; j < 8; j++) {
        const fret_real t = lo + (hi - lo) * fret_gauss_node[j], y = t / h->r + 1;
        fret_ripple_at(p, y, t / h->r, Y);
        sum += fret_gauss_weight[j] * (h->c[0] + t * (h->c[1] + t * h->c[2])) * Y[0];
    }
    return sum * (hi - lo);
}

/* From t = lo to hi. */
static fret_real between(const fret_ripple *p, const bow *h, fret_real lo, fret_real hi) {
    const fret_real near = NEAR * h->r;
    fret_real sum = 0;
    if (lo < near && hi > -near)
        sum = near_to(p, h, fminl(hi, near)) - near_to(p, h, fmaxl(lo, -near));
    for (fret_real at = fmaxl(lo, near), end; at < hi; at = end) {
        end = fminl(hi, at * 1.3L);
        sum += far_from(p, h, at, end);
    }
    for (fret_real at = fminl(hi, -near), end; at > lo; at = end) {
        end = fmaxl(lo, at * 1.3L);
        sum += far_from(p, h, end, at);
    }
    return sum;
}

static bow bow_of(const struct fret_table *t, size_t row, fret_real r) {
    const fret_real at = (fret_table_start(t) - r) + fret_table_distance(t, row); /* its beginning, from r */
    fret_real c[3];
    fret_table_slope(t, row, c);
    const fret_real d0 = c[0] - at * (c[1] - at * c[2]), d1 = c[1] - 2 * at * c[2], d2 = c[2];
    return (bow){{d0 + r * d1, 2 * (d1 + r * d2), 3 * d2}, r};
}

/* ---- blocks ------------------------------------------------------------------------------------ */

enum { LEADING = 7 }; /* terms in long double */

/* Of r^(1-k) K in powers of x = (s-c)/d, against the moments of h; the terms fall at least by 4. */
static fret_real sum_block(const fret_ripple *p, const fret_table_stretch *b, fret_real r, int terms) {
    const fret_real y = b->c / r, u = (b->c - r) / r, d = b->d / r, e = 1 - p->k, e2 = 1 + 2 * e;
    fret_real first[2];
    fret_ripple_at(p, y, u, first);
    const fret_real per = 1 / (y * u * (1 + y)), P1 = d * (1 - 3 * y * y) * per, P2 = -3 * d * d * y * per,
                    P3 = -d * d * d * per, Q0 = d * (1 - e2 * y * y) * per, Q1 = -2 * e2 * y * d * d * per,
                    Q2 = -e2 * d * d * d * per, R0 = -e * e * y * d * d * per, R1 = -e * e * d * d * d * per;
    fret_real last = 0, now = first[0], next = first[1] * d;
    fret_real sum = now * (b->slope[0] + b->rf2[0]);
    const int leading = terms < LEADING ? terms : LEADING;
    for (int n = 0; n + 1 < leading; n++) {
        sum += next * (b->slope[n + 1] + b->rf2[n + 1]);
        const fret_real s = n;
        const fret_real then = ((s + 1) * (P1 * s + Q0) * next + (s * (P2 * (s - 1) + Q1) + R0) * now +
                                ((s - 1) * (P3 * (s - 2) + Q2) + R1) * last) *
                               p->over[n];
        last = now;
        now = next;
        next = then;
    }
    if (leading == terms)
        return sum;
    /* of the rest a double keeps all digits that count */
    const double p1 = (double)P1, p2 = (double)P2, p3 = (double)P3, q0 = (double)Q0, q1 = (double)Q1,
                 q2 = (double)Q2, r0 = (double)R0, r1 = (double)R1;
    double y0 = (double)last, y1 = (double)now, y2 = (double)next, rest = 0;
    for (int n = LEADING - 1; n + 1 < terms; n++) {
        rest += y2 * (double)(b->slope[n + 1] + b->rf2[n + 1]);
        const double s = n, over = (double)p->over[n];
        const double then =
            over * ((s + 1) * (p1 * s + q0)) * y2 +
            over * ((s * (p2 * (s - 1) + q1) + r0) * y1 + ((s - 1) * (p3 * (s - 2) + q2) + r1) * y0);
        y0 = y1;
        y1 = y2;
        y2 = then;
    }
    return sum + rest;
}

/* One row by the cuts from `now` on. */
static fret_real sum_row(const fret_ripple *p, const struct fret_table *t, size_t row, const fret_cut *cut,
                         size_t count, size_t now, fret_real r) {
    const bow h = bow_of(t, row, r);
    const fret_real off = fret_table_start(t) - r, end = off + fret_table_distance(t, row + 1);
    fret_real sum = 0;
    for (fret_real lo = off + fret_table_distance(t, row), hi; now < count && lo < end; lo = hi) {
        hi = fminl(end, cut[now].a - r);
        sum += cut[now].weight * between(p, &h, lo, hi);
        now += hi < end;
    }
    return sum;
}

/* In the centre, the first row, over r^(k-1). */
static fret_real sum_centre(const fret_ripple *p, const struct fret_table *t, const fret_cut *cut,
                            size_t count, fret_real r) {
    const bow h = bow_of(t, 0, 0);
    const fret_real end = fret_table_start(t) + fret_table_distance(t, 1);
    fret_real sum = 0;
    for (size_t i = 0; i < count; i++) {
        const fret_real last = i > 0 ? fminl(cut[i - 1].a, end) : 0, s = fminl(cut[i].a, end);
        for (int j = 0; j < 3 && last < s; j++) {
            const fret_real by = j + p->k;
            if (h.c[j] != 0 && cut[i].weight != 0)
                sum += cut[i].weight * h.c[j] * (fret_pow(s, by) - (last > 0 ? fret_pow(last, by) : 0)) / by;
        }
    }
    return p->whole * sum / fret_pow(r, p->k - 1);
}

fret_real fret_ripple_sum(const fret_ripple *p, const struct fret_table *t, const fret_cut *cut, size_t count,
                          fret_real place) {
    static const fret_real little = 1e-12L; /* of the first row: its square counts, where others ask */
    const bool centre = place <= 0;
    const fret_real r = centre ? little * (fret_table_start(t) + fret_table_distance(t, 1)) : place;
    fret_table_stretch b;
    fret_real sum = centre ? sum_centre(p, t, cut, count, r) : 0;
    size_t now = 0; /* the cut that ends the part which holds the start of a block */
    for (size_t i = 0; fret_table_block(t, i, &b);) {
        const fret_real lo = b.c - b.d, hi = b.c + b.d;
        while (now < count && cut[now].a <= lo)
            now++;
        if (now == count)
            break;
        const int terms = hi <= cut[now].a ? fret_table_terms(b.d, fabsl(b.c - r)) : 0;
        if (terms > 0)
            sum += cut[now].weight * sum_block(p, &b, r, terms);
        else if (b.next == i + 1)
            for (size_t row = b.first + (centre && b.first == 0); row < b.last; row++) {
                size_t from = now;
                while (from < count && cut[from].a <= fret_table_start(t) + fret_table_distance(t, row))
                    from++;
                sum += sum_row(p, t, row, cut, count, from, r);
            }
        i = terms > 0 ? b.next : i + 1;
    }
    return sum * fret_pow(r, p->k - 1);
}
