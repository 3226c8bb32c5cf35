/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The closed forms for arrays of loads, each loop once for each instruction set; what these cannot do goes to
 * the functions of cycle.h and normal.h. Pure. */
#include "fast/batch.h"

#include <float.h>

#include "contact/check.h"
#include "contact/normal.h"
#include "fret/cycle.h"
#include "number/processor.h"

#define LANES_ALSO "fast/batch_body.h"
#define LANES 2
#include "number/lanes.h"
#ifdef __x86_64__
#define LANES 4
#include "number/lanes.h"
#define LANES 8
#include "number/lanes.h"
#endif

static void split(dd x, double out[2]) {
    out[0] = x.hi;
    out[1] = x.lo;
}

static bool tame(double x) {
    return x > 0x1p-900 && x < 0x1p900;
}

/* (1 + rho^2 + ... + rho^2j)/(2j+3)!, the coefficients of (sinh(x)/x - sinh(rho x)/(rho x))/((1-rho^2) x^2)
 * in x^2. */
static void make_series(double rho, double out[FRET_SWEEP_TERMS]) {
    double sum = 0, factorial = 1; /* (2j+1)! */
    for (int j = 0; j < FRET_SWEEP_TERMS; j++) {
        sum = 1 + rho * rho * sum;
        factorial *= (2 * j + 2) * (2 * j + 3);
        out[j] = sum / factorial;
    }
}

fret_status fret_sweep_make(const fret_contact *contact, fret_sweep *out) {
    fret_status st = fret_contact_check(contact);
    if (st.code)
        return st;
    fret_sweep w = {.fast = false};
    const fret_normal *normal = contact->normal;
    const fret_press *press = &contact->press;
    const double mu = contact->mu;
    dd limit = dd_mul_d(dd_from2(press->F, press->F_rest), mu);
    dd slip = dd_mul(dd_mul_d(normal->wide_foundation.eta, mu), dd_from2(press->dz, press->dz_rest));
    dd scale = dd_mul(limit, slip);
    w.fast = fret_normal_closed(normal) && tame(limit.hi) && tame(slip.hi) && tame(scale.hi);
    if (w.fast) {
        dd q = normal->wide.q, r = dd_div(dd_sum(1, (double)normal->foundation.k), normal->wide.s);
        split(dd_div(dd_of(1), limit), w.inverse);
        w.q = q.hi;
        w.alpha = (1 + w.q) / 2;
        w.sigma = 2 * w.q / (1 + w.q);
        w.rho = r.hi / (1 + w.q);
        w.shallow = w.q < 1.0 / 3 ? -w.alpha : r.hi / 2;
        w.deep = w.q < 1.0 / 3 ? -w.q : r.hi;
        w.scale = 4 * scale.hi;
        w.gross = w.scale * w.rho;
        w.cubic = 4 * dd_mul(scale, dd_mul(q, r)).hi;
        make_series(w.rho, w.series);
        w.slip = slip.hi;
        w.a = (double)press->a;
        split(dd_div(dd_of(1), normal->wide.s), w.radius);
    }
    *out = w;
    return fret_ok();
}

/* Force and depth at a = r0; infinite or 0 where a double does not hold them. */
static dd law_force(const fret_normal *normal) {
    return fret_dd_exp(normal->wide.ln_force);
}

static double law_depth(const fret_normal *normal) {
    return fret_dd_exp(normal->wide.ln_depth).hi;
}

void fret_press_law_make(const fret_normal *normal, fret_press_law *out) {
    dd ref = law_force(normal);
    int e;
    const double m = frexp(ref.hi, &e);
    out->exponent = e;
    split(dd_div(dd_of(1), (dd){m, ldexp(ref.lo, -e)}), out->inverse);
    split(dd_div(dd_of(1), normal->wide.s), out->radius);
    split(normal->wide.q, out->depth);
    out->r0 = normal->gap.power[0].r0;
    out->dref = law_depth(normal);
}

/* An array in blocks that stay in the nearest cache; a part of a block goes by way of a copy. */
enum { BLOCK = 64 };
#define SWEEP(set, lanes, target, name, law, first, second)                                                  \
    target static bool set##_##name(const law *w, const double *in, double *out, size_t count) {             \
        enum { LANES = sizeof(lanes##_numbers) / sizeof(double) };                                           \
        lanes##_mask nan = {0};                                                                              \
        for (size_t i = 0; i < count; i += BLOCK) {                                                          \
            size_t n = count - i < BLOCK ? count - i : BLOCK;                                                \
            double copy[BLOCK], *to = n < BLOCK ? copy : out + i;                                            \
            const double *from = in + i;                                                                     \
            if (n < BLOCK) {                                                                                 \
                memset(copy, 0, sizeof copy);                                                                \
                from = memcpy(copy, from, n * sizeof *in);                                                   \
            }                                                                                                \
            lanes##_part part[BLOCK / LANES];                                                                \
            lanes##_numbers x;                                                                               \
            for (size_t j = 0; j < n; j += LANES) {                                                          \
                memcpy(&x, from + j, sizeof x);                                                              \
                lanes##_##first(w, &x, &part[j / LANES]);                                                    \
            }                                                                                                \
            for (size_t j = 0; j < n; j += LANES) {                                                          \
                lanes##_##second(w, &part[j / LANES], &x);                                                   \
                nan |= x != x;                                                                               \
                memcpy(to + j, &x, sizeof x);                                                                \
            }                                                                                                \
            if (n < BLOCK)                                                                                   \
                memcpy(out + i, copy, n * sizeof *out);                                                      \
        }                                                                                                    \
        return fret_any(&nan, LANES);                                                                        \
    }

#define VARIANT(set, lanes, target)                                                                          \
    SWEEP(set, lanes, target, loss, fret_sweep, depth, loss)                                                 \
    SWEEP(set, lanes, target, displacement, fret_sweep, depth, displacement)                                 \
    SWEEP(set, lanes, target, radius, fret_sweep, depth_pair, radius)                                        \
    SWEEP(set, lanes, target, press_radius, fret_press_law, load, press_radius)                              \
    SWEEP(set, lanes, target, press_depth, fret_press_law, load, press_depth)
#define ROW(set)                                                                                             \
    {                                                                                                        \
#set, fret_runs_##set, set##_loss, set##_displacement, set##_radius, set##_press_radius,             \
            set##_press_depth                                                                                \
    }

#ifdef __x86_64__
VARIANT(avx512, lanes8, FRET_AVX512) /* unreached: not every processor has it */
VARIANT(avx2, lanes4, FRET_AVX2)
#endif

VARIANT(plain, lanes2, )
const fret_variant fret_variants[] = {
#ifdef __x86_64__
    ROW(avx512),
    ROW(avx2),
#endif
    ROW(plain),
};
const size_t fret_variant_count = sizeof fret_variants / sizeof *fret_variants;

static const fret_variant *best(void) {
    return &fret_variants[fret_best_variant()];
}

fret_status fret_batch_loss(const fret_contact *contact, const double FA[], double loss[], size_t count) {
    fret_sweep w;
    fret_status st = fret_sweep_make(contact, &w);
    if (st.code || (w.fast && !best()->loss(&w, FA, loss, count)))
        return st;
    for (size_t i = 0; i < count; i++)
        if (!w.fast || isnan(loss[i])) {
            fret_real exact;
            st = fret_cycle_loss_by_force(contact, FA[i], &exact);
            if (st.code)
                return st;
            loss[i] = (double)exact;
        }
    return st;
}

fret_status fret_batch_loading(const fret_contact *contact, const double Fx[], double c[], double dx[],
                               size_t count) {
    fret_sweep w;
    fret_status st = fret_sweep_make(contact, &w);
    if (st.code)
        return st;
    bool missing = !w.fast;
    if (w.fast && c)
        missing |= best()->radius(&w, Fx, c, count);
    if (w.fast && dx)
        missing |= best()->displacement(&w, Fx, dx, count);
    for (size_t i = 0; missing && i < count; i++)
        if (!w.fast || (c && isnan(c[i])) || (dx && isnan(dx[i]))) {
            fret_loading f;
            st = fret_loading_by_force(contact, Fx[i], &f);
            if (st.code)
                return st;
            if (c)
                c[i] = (double)f.c;
            if (dx)
                dx[i] = (double)f.dx;
        }
    return st;
}

fret_status fret_batch_press(const fret_normal *normal, const double F[], double a[], double dz[],
                             size_t count) {
    bool fast = fret_normal_closed(normal) && tame(law_force(normal).hi) && tame(law_depth(normal)),
         missing = !fast;
    fret_status st = fret_ok();
    if (fast) {
        fret_press_law w;
        fret_press_law_make(normal, &w);
        if (a)
            missing |= best()->press_radius(&w, F, a, count);
        if (dz)
            missing |= best()->press_depth(&w, F, dz, count);
    }
    for (size_t i = 0; missing && i < count; i++)
        if (!fast || (a && isnan(a[i])) || (dz && isnan(dz[i]))) {
            fret_press p;
            st = fret_press_by_force(normal, F[i], &p);
            if (st.code)
                return st;
            if (a)
                a[i] = (double)p.a;
            if (dz)
                dz[i] = (double)p.dz;
        }
    return st;
}
