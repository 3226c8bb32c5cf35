/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Closed forms of power laws for blocks of loads, in loops that compilers vectorise; other loads go to the
 * functions of cycle.h and normal.h. Pure. */
#include "arrays/arrays.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "arrays/power.h"
#include "fret/cycle.h"
#include "number/dd.h"

enum { BLOCK = 64, SERIES = 15 };

/* What does not depend on the load, for a power law. Pairs are high and low parts. */
typedef struct law {
    double inverse[2], exponent;             /* 1/(mu F_N), or 1/m for presses, F_N(r0) = m 2^exponent */
    double radius, depth;                    /* a and delta_x,max [m], or for presses r0 and its depth [m] */
    double radius_power[2], q[2];            /* 1/(n+k+1), n/(n+k+1) */
    double alpha, sigma, rho, shallow, deep; /* (1+q)/2, 2q/(1+q), r/(1+q), r = 1-q; see loss */
    double scale, cubic;                     /* 4 mu F_N delta_x,max; that times q r */
    double series[SERIES];                   /* in alpha^2 L^2, L = -log(1-t) */
    bool soft;                               /* q < 1/3 */
} law;

/* ---- what does not depend on the load ---------------------------------------------------------- */

static void split(dd x, double out[2]) {
    out[0] = x.hi;
    out[1] = x.lo;
}

static bool tame(double x) {
    return x > 0x1p-900 && x < 0x1p900;
}

/* (1 + rho^2 + ... + rho^2j)/(2j+3)!, the coefficients of x^2j in
 *   (sinh(x)/x - sinh(rho x)/(rho x))/((1-rho^2) x^2). */
static void make_series(double rho, double out[SERIES]) {
    double sum = 0, factorial = 1; /* (2j+1)! */
    for (int j = 0; j < SERIES; j++) {
        sum = 1 + rho * rho * sum;
        factorial *= (2 * j + 2) * (2 * j + 3);
        out[j] = sum / factorial;
    }
}

/* Sets the exponents of radius and depth as powers of the load. Returns n/(n+k+1). */
static dd set_powers(const fret_normal *normal, law *w) {
    const double n = fret_normal_gap(normal)->power[0].n;
    const dd s = dd_add_d(dd_add_d(dd_from(fret_normal_foundation(normal)->k), 1), n),
             q = dd_div(dd_of(n), s);
    split(dd_div(dd_of(1), s), w->radius_power);
    split(q, w->q);
    return q;
}

static bool law_of_contact(const fret_pressed *contact, law *w) {
    const fret_normal *normal = contact->normal;
    const fret_press *press = &contact->press;
    if (!fret_normal_is_power(normal))
        return false;
    const dd limit = dd_mul_d(dd_from2(press->F, press->F_rest), contact->mu),
             slip = dd_from(contact->mu * fret_normal_foundation(normal)->eta * press->dz),
             scale = dd_mul(limit, slip), q = set_powers(normal, w), r = dd_add_d(dd_neg(q), 1);
    split(dd_div(dd_of(1), limit), w->inverse);
    w->radius = (double)press->a;
    w->depth = slip.hi;
    w->alpha = (1 + q.hi) / 2;
    w->sigma = 2 * q.hi / (1 + q.hi);
    w->rho = r.hi / (1 + q.hi);
    w->soft = q.hi < 1.0 / 3;
    w->shallow = w->soft ? -w->alpha : r.hi / 2;
    w->deep = w->soft ? -q.hi : r.hi;
    w->scale = 4 * scale.hi;
    w->cubic = 4 * dd_mul(scale, dd_mul(q, r)).hi;
    make_series(w->rho, w->series);
    return tame(limit.hi) && tame(slip.hi) && tame(scale.hi);
}

static bool law_of_press(const fret_normal *normal, law *w) {
    fret_press at;
    int exponent;
    w->radius = fret_normal_gap(normal)->power[0].r0;
    if (!fret_normal_is_power(normal) || fret_press_by_radius(normal, w->radius, &at).code ||
        !tame((double)at.F) || !tame((double)at.dz))
        return false;
    split(dd_div(dd_of(1), dd_from(frexpl(at.F, &exponent))), w->inverse);
    w->exponent = exponent;
    w->depth = (double)at.dz;
    set_powers(normal, w);
    return true;
}

/* ---- a load ------------------------------------------------------------------------------------ */

/* For each load a logarithm in two parts, log(1-t) or log(F/F(r0)), and t = |F|/(mu F_N), s = 1-t. In a loop
 * of its own: a processor overlaps the iterations of a short loop better. */
typedef struct block {
    double high[BLOCK], low[BLOCK], t[BLOCK], s[BLOCK];
} block;

FRET_INLINE void take_fractions(const law *w, const double *restrict F, block *restrict b) {
    for (int i = 0; i < BLOCK; i++) {
        const double size = fabs(F[i]);
        const two h = product(size, w->inverse[0]);
        const double rest = h.low + size * w->inverse[1], t = h.high + rest, tl = (h.high - t) + rest,
                     s0 = 1.0 - h.high, s_rest = ((1.0 - s0) - h.high) - rest, s = s0 + s_rest,
                     sl = (s0 - s) + s_rest;
        const reduced r = reduce(s);
        const bool near = r.e == 0.0; /* near s = 1, s has lost digits of t */
        const two log = log_of(choose(near, -t, r.m - 1.0), choose(near, -tl, sl * r.factor), r.e);
        b->high[i] = log.high;
        b->low[i] = log.low;
        b->t[i] = t;
        b->s[i] = s;
    }
}

/* `before` below mu F_N, `at` at mu F_N up to rounding, NaN beyond. */
FRET_INLINE double within(double s, double before, double at) {
    return choose(s >= -DBL_EPSILON, choose(s > DBL_EPSILON, before, at), (double)NAN);
}

/* w(t) mu F_N delta_x,max. With alpha = (1+q)L/2 and b = (1-q)L/2, L = -log(1-t),
 *   w = 4 r L e^-alpha [sinh(alpha)/alpha - sinh(b)/b]:
 * for L < 3.5 as 4 q r L^3 e^-alpha times a series of positive terms in alpha^2; else
 *   w/4 = (1+rho s)(1-e^-qL) - sigma t          where q < 1/3,
 *       = rho t (1+s) - (1+rho s) s (e^rL-1)    else: the difference that cancels less. */
FRET_INLINE void loss(const law *w, const double *restrict F, double *restrict out,
                      double *restrict nothing) {
    const double *const c = w->series;
    uint64_t any = 0; /* loads are mostly sorted: few blocks come near gross slip */
    block b;
    take_fractions(w, F, &b);
    for (int i = 0; i < BLOCK; i++) {
        const double L = -b.high[i], alpha = w->alpha * L, x = alpha * alpha, x2 = x * x, x4 = x2 * x2,
                     x8 = x4 * x4;
        const double sum =
            (((c[0] + x * c[1]) + x2 * (c[2] + x * c[3])) +
             x4 * ((c[4] + x * c[5]) + x2 * (c[6] + x * c[7]))) +
            x8 * (((c[8] + x * c[9]) + x2 * (c[10] + x * c[11])) + x4 * ((c[12] + x * c[13]) + x2 * c[14]));
        const exponential e =
            exp_of(w->shallow * L, 0); /* e^-alpha = s e^b: the smaller exponent loses less */
        out[i] =
            (((w->cubic * L) * L) * L) * (((1.0 + e.p) * two_to(e.k)) * choose(w->soft, 1, b.s[i]) * sum);
        nothing[i] = 0;
        any |= -(uint64_t)(L >= 3.5);
    }
    for (int i = 0; any && i < BLOCK; i++) {
        const double t = b.t[i], s = b.s[i], slope = 1.0 + w->rho * s, y = exp_less_1(w->deep * -b.high[i]),
                     deep =
                         choose(w->soft, -slope * y - w->sigma * t, w->rho * (t + t * s) - slope * (s * y));
        out[i] = choose(b.high[i] > -3.5, out[i], w->scale * deep);
    }
    for (int i = 0; i < BLOCK; i++)
        out[i] = choose(F[i] >= 0.0, within(b.s[i], out[i], w->scale * w->rho), (double)NAN);
}

/* c = a s^(1/(n+k+1)), delta_x = delta_x,max (1 - e^-qL) */
FRET_INLINE void loading(const law *w, const double *restrict F, double *restrict c, double *restrict dx) {
    block b;
    take_fractions(w, F, &b);
    for (int i = 0; i < BLOCK; i++) {
        c[i] = within(b.s[i], power((two){b.high[i], b.low[i]}, w->radius_power, w->radius), 0);
        dx[i] = copysign(within(b.s[i], -w->depth * exp_less_1(w->q[0] * b.high[i]), w->depth), F[i]);
    }
}

/* x, or NaN where the exact function must decide. */
FRET_INLINE double pressed(double F, double x) {
    const bool known = (x >= DBL_MIN) & (x <= DBL_MAX) & (F >= DBL_MIN) & (F <= DBL_MAX);
    return choose(F == 0.0, 0, choose(known, x, (double)NAN));
}

/* a = r0 (F/F(r0))^(1/(n+k+1)), and delta_z likewise */
FRET_INLINE void press(const law *w, const double *restrict F, double *restrict a, double *restrict dz) {
    block b;
    for (int i = 0; i < BLOCK; i++) {
        const reduced f = reduce(F[i]);
        const two z = product(f.m, w->inverse[0]);
        const reduced r = reduce(z.high);
        const double low = (z.low + f.m * w->inverse[1]) * r.factor;
        const two log = log_of(r.m - 1.0, low, f.e + (r.e - w->exponent));
        b.high[i] = log.high;
        b.low[i] = log.low;
    }
    for (int i = 0; i < BLOCK; i++) {
        const two log = {b.high[i], b.low[i]};
        a[i] = pressed(F[i], power(log, w->radius_power, w->radius));
        dz[i] = pressed(F[i], power(log, w->q, w->depth));
    }
}

/* ---- arrays ------------------------------------------------------------------------------------ */

#define LOOP(set, target, name)                                                                              \
    target static bool set##_##name(const law *of, const double *restrict F, double *restrict first,         \
                                    double *restrict second) {                                               \
        const law w = *of;                                                                                   \
        uint64_t missing = 0;                                                                                \
        name(&w, F, first, second);                                                                          \
        for (int i = 0; i < BLOCK; i++)                                                                      \
            missing |= -(uint64_t)((first[i] != first[i]) | (second[i] != second[i]));                       \
        return missing != 0;                                                                                 \
    }
#define SET(set, target)                                                                                     \
    LOOP(set, target, loss)                                                                                  \
    LOOP(set, target, loading)                                                                               \
    LOOP(set, target, press)                                                                                 \
    static loop *const set[] = {set##_loss, set##_loading, set##_press};

/* Computes the results of a block, with 0 for a second result that does not exist and NaN where the exact
 * function must decide. True: there are such loads. */
typedef bool loop(const law *of, const double *F, double *first, double *second);

SET(plain, )
#ifdef __x86_64__
SET(avx2, __attribute__((target("avx2"))))
#endif

static loop *loop_for(fret_arrays_question question, bool anywhere) {
#ifdef __x86_64__
    if (!anywhere && __builtin_cpu_supports("avx2"))
        return avx2[question];
#endif
    (void)anywhere;
    return plain[question];
}

/* The results for one load, by the functions of cycle.h and normal.h. */
static fret_status exactly(fret_arrays_question question, const void *of, double F, fret_real out[2]) {
    fret_loading f = {0};
    fret_press p = {0};
    fret_status st;
    if (question == FRET_LOSSES)
        return fret_cycle_loss_by_force(of, F, &out[0]);
    st = question == FRET_LOADINGS ? fret_loading_by_force(of, F, &f) : fret_press_by_force(of, F, &p);
    out[0] = question == FRET_LOADINGS ? f.c : p.a;
    out[1] = question == FRET_LOADINGS ? f.dx : p.dz;
    return st;
}

/* Block by block, by the loop for a power law; other shapes, and loads that it leaves out, by `exactly`. */
fret_status fret_arrays_ask(fret_arrays_question question, const void *of, const double F[],
                            double *const to[2], size_t count, bool anywhere) {
    const bool presses = question == FRET_PRESSES;
    double in[BLOCK] = {0}, out[2][BLOCK] = {{0}};
    fret_real one[2] = {0, 0};
    law w;
    fret_status st = {FRET_OK, NULL, 0, 0};
    if (!presses) /* checks mu and F_N */
        st = exactly(FRET_LOADINGS, of, 0, one);
    const bool closed = !st.code && (presses ? law_of_press(of, &w) : law_of_contact(of, &w));
    for (size_t i = 0; i < count && !st.code; i += BLOCK) {
        size_t n = count - i < BLOCK ? count - i : BLOCK;
        memcpy(in, F + i, n * sizeof *in);
        const bool lacks = !closed || loop_for(question, anywhere)(&w, in, out[0], out[1]);
        for (size_t j = 0; lacks && j < n; j++)
            if (!closed || isnan(out[0][j]) || isnan(out[1][j])) {
                st = exactly(question, of, in[j], one);
                out[0][j] = (double)one[0];
                out[1][j] = (double)one[1];
                if (st.code)
                    n = j; /* results before it are valid */
            }
        for (int which = 0; which < 2; which++)
            if (to[which])
                memcpy(to[which] + i, out[which], n * sizeof *in);
    }
    return st;
}

fret_status fret_arrays_loss(const fret_pressed *contact, const double FA[], double loss[], size_t count) {
    return fret_arrays_ask(FRET_LOSSES, contact, FA, (double *[]){loss, NULL}, count, false);
}

fret_status fret_arrays_loading(const fret_pressed *contact, const double Fx[], double c[], double dx[],
                                size_t count) {
    return fret_arrays_ask(FRET_LOADINGS, contact, Fx, (double *[]){c, dx}, count, false);
}

fret_status fret_arrays_press(const fret_normal *normal, const double F[], double a[], double dz[],
                              size_t count) {
    return fret_arrays_ask(FRET_PRESSES, normal, F, (double *[]){a, dz}, count, false);
}
