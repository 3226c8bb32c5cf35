/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values, places and slices of one cell. Pure arithmetic. */
#include "law/cell.h"

#include <float.h>

#include "number/integral.h"
#include "number/real.h"
#include "number/root.h"

fret_stretch fret_stretch_join(const fret_stretch *o, const fret_stretch *i) {
    return (fret_stretch){o->h + i->h, o->K + i->K, o->G + i->G + o->h * i->K,
                          o->L + i->L + i->h * o->G + o->h * (i->h * i->K - i->G)};
}

fret_stretch fret_stretch_less(const fret_stretch *whole, const fret_stretch *inner) {
    fret_stretch o = {.h = whole->h - inner->h, .K = whole->K - inner->K};
    o.G = whole->G - inner->G - o.h * inner->K;
    o.L = whole->L - inner->L - inner->h * o.G - o.h * (inner->h * inner->K - inner->G);
    return o;
}

/* ---- polynomials ------------------------------------------------------------------------------- */

static fret_real at(const fret_cell *c, int i, fret_real s) {
    const fret_real *of = c->of[i], square = s * s;
    fret_real even = 0, odd = 0; /* two sums take half the time of one */
    int j = c->count[i];
    if (j & 1)
        even = of[--j];
    for (; j > 0; j -= 2) {
        odd = odd * square + of[j - 1];
        even = even * square + of[j - 2];
    }
    return even + s * odd;
}

/* The same in double, without and with the derivative. */
static double about(const fret_cell *c, int i, double s) {
    double sum = 0;
    for (int j = c->count[i]; j-- > 0;)
        sum = sum * s + (double)c->of[i][j];
    return sum;
}

static double about_with_rate(const fret_cell *c, int i, double s, double *rate) {
    double sum = 0;
    *rate = 0;
    for (int j = c->count[i]; j-- > 0;) {
        *rate = *rate * s + sum;
        sum = sum * s + (double)c->of[i][j];
    }
    return sum;
}

/* s^e */
static fret_real raised(fret_real s, fret_real e) {
    return e == 1 ? s : e == 0.5L ? sqrtl(s) : s > 0 ? fret_pow(s, e) : 0;
}

/* A step inwards from s: s^q, its length `back`, and ln(1 - back/s) where that is needed. */
typedef struct descent {
    fret_real s, to_q, back, log;
} descent;

static descent descent_from(const fret_cell *c, fret_real s) {
    return (descent){s, c->count[RISE_Q] ? raised(s, c->q) : 0, 0, 0};
}

static fret_real log_left(fret_real s, fret_real back) {
    return back < s ? log1pl(-back / s) : -(fret_real)INFINITY;
}

static void descend(const fret_cell *c, descent *w, fret_real back) {
    w->back = back;
    w->log = c->count[RISE_Q] || c->mu != 1 ? log_left(w->s, back) : 0;
}

/* The fall of s^e p(s) from s to s1 = s - back, by the quotient (p(s)-p(s1))/(s-s1), without cancellation.
 * power: s^e; less: the fall of s^e. */
static fret_real fall_of(const fret_cell *c, int i, const descent *w, fret_real power, fret_real less) {
    const fret_real inner = w->s - w->back;
    fret_real sum = 0, quotient = 0;
    for (int j = c->count[i]; j-- > 0;) {
        quotient = quotient * inner + sum;
        sum = sum * w->s + c->of[i][j];
    }
    return less * sum + (power - less) * w->back * quotient;
}

static fret_real depth_fall(const fret_cell *c, const descent *w) {
    const fret_real smooth = fall_of(c, RISE, w, w->s, w->back);
    return c->count[RISE_Q] ? smooth + fall_of(c, RISE_Q, w, w->to_q, -w->to_q * expm1l(c->q * w->log))
                            : smooth;
}

static fret_real stiffness_fall(const fret_cell *c, const descent *w) {
    const fret_real to_mu = raised(w->s, c->mu);
    return fall_of(c, STIFFNESS, w, to_mu, c->mu == 1 ? w->back : -to_mu * expm1l(c->mu * w->log));
}

static fret_real load_fall(const fret_cell *c, const descent *w) {
    const fret_real to_mu = raised(w->s, c->mu), power = to_mu * w->s, bent = to_mu * w->to_q,
                    less =
                        c->mu == 1 ? w->back * (2 * w->s - w->back) : -power * expm1l((c->mu + 1) * w->log),
                    load = c->K * depth_fall(c, w) + fall_of(c, PART_G, w, power, less);
    return bent > 0 ? load + fall_of(c, PART_GQ, w, bent, -bent * expm1l((c->mu + c->q) * w->log)) : load;
}

/* ---- powers ------------------------------------------------------------------------------------ */

static int terms_of(const fret_cell *c) {
    return c->count[RISE];
}

/* G_i s^n_i */
static void powers_at(const fret_cell *c, fret_real s, fret_real *g) {
    const fret_real log = s > 0 ? logl(s) : -(fret_real)INFINITY;
    for (int i = 0; i < terms_of(c); i++)
        g[i] = c->of[RISE][i] * expl(c->of[RISE_Q][i] * log);
}

static fret_real stiffness_of_powers(const fret_cell *c, fret_real s) {
    return c->K_at_1 * raised(s, 2 * c->m);
}

/* The load carried by one power, as a fraction of its depth times K. */
static fret_real carried(const fret_cell *c, int i) {
    const fret_real n = c->of[RISE_Q][i];
    return n / (n + 2 * c->m);
}

/* For a thin slice: by Gauss's rule over ln s. */
static fret_stretch thin_part_of_powers(const fret_cell *c, fret_real s, fret_real log) {
    fret_stretch out = {0, 0, 0, 0};
    fret_real g[FRET_CELL_TERMS];
    const fret_real K = stiffness_of_powers(c, s);
    powers_at(c, s, g);
    for (int i = 0; i < terms_of(c); i++)
        out.h -= g[i] * expm1l(c->of[RISE_Q][i] * log);
    for (int j = 0; j < 8; j++) {
        const fret_real u = fret_gauss_node[j] * log,
                        dK = -2 * c->m * K * expl(2 * c->m * u) * fret_gauss_weight[j] * log;
        fret_real t = 0;
        for (int i = 0; i < terms_of(c); i++)
            t -= g[i] * expm1l(c->of[RISE_Q][i] * u);
        out.K += dK;
        out.G += t * dK;
        out.L += t * (out.h - t) * dK;
    }
    return out;
}

/* int s^(e-1) ds over -log in ln s, with `inner` and `outer` the values of s^e at its ends. A difference
 * above 1e-3 of its terms keeps 16 digits. */
static fret_real area_of_power(fret_real e, fret_real outer, fret_real inner, fret_real log) {
    return fabsl(e) > 1e-3L ? (outer - inner) / e : outer * (e != 0 ? -expm1l(e * log) / e : -log);
}

/* For any slice: a thicker one in halves, a very thick one by differences of depth, load and the area
 * below. */
static fret_stretch part_of_powers(const fret_cell *c, fret_real s, fret_real log) {
    static const fret_real THIN = 0.5L, THICK = 4;
    const fret_real inner = s * expl(log), m = c->m, K = stiffness_of_powers(c, s),
                    K_inner = inner > 0 ? stiffness_of_powers(c, inner) : 0;
    fret_real g[FRET_CELL_TERMS], g_inner[FRET_CELL_TERMS], most = 2 * m;
    for (int i = 0; i < terms_of(c); i++)
        most = fmaxl(most, fabsl(c->of[RISE_Q][i]));
    if (most * -log <= THIN)
        return thin_part_of_powers(c, s, log);
    if (most * -log <= THICK) {
        const fret_stretch outer = part_of_powers(c, s, log / 2),
                           rest = part_of_powers(c, s * expl(log / 2), log / 2);
        return fret_stretch_join(&outer, &rest);
    }
    powers_at(c, s, g);
    if (inner > 0)
        powers_at(c, inner, g_inner);
    fret_stretch out = {.K = K - K_inner};
    fret_real load[2] = {0, 0}, area = 0;
    for (int i = 0; i < terms_of(c); i++) {
        const fret_real less = inner > 0 ? g_inner[i] : 0;
        out.h += g[i] - less;
        load[0] += carried(c, i) * K * g[i];
        load[1] += carried(c, i) * K_inner * less;
        for (int j = 0; j < terms_of(c); j++) {
            const fret_real n = c->of[RISE_Q][j], e = c->of[RISE_Q][i] + n + 2 * m, outer = K * g[i] * g[j],
                            less_both = inner > 0 ? K_inner * less * g_inner[j] : 0;
            if (n != 0)
                area += carried(c, i) * n * area_of_power(e, outer, less_both, log);
        }
    }
    out.G = load[0] - load[1] - out.h * K_inner;
    out.L = out.h * (load[0] + load[1]) - 2 * area;
    return out;
}

static fret_real rise_of_powers(const fret_cell *c, int by, fret_real s) {
    fret_real g[FRET_CELL_TERMS], sum = 0;
    const fret_real K = by == BY_LOAD ? stiffness_of_powers(c, s) : 1;
    powers_at(c, s, g);
    for (int i = 0; i < terms_of(c); i++) {
        const fret_real share = by == BY_LOAD ? carried(c, i) : 1;
        sum += share * (K * g[i] - (c->begin > 0 ? (by == BY_LOAD ? c->K_at_1 : 1) * c->of[RISE][i] : 0));
    }
    return sum;
}

static fret_real rate_of_powers(const fret_cell *c, int by, fret_real s) {
    fret_real g[FRET_CELL_TERMS], sum = 0;
    powers_at(c, s, g);
    for (int i = 0; i < terms_of(c); i++)
        sum += c->of[RISE_Q][i] * g[i] / s;
    return by == BY_LOAD ? stiffness_of_powers(c, s) * sum : sum;
}

/* ---- values ------------------------------------------------------------------------------------ */

fret_real fret_cell_stiffness(const fret_cell *c, fret_real s) {
    if (c->powers)
        return s > 0 ? stiffness_of_powers(c, s) : 0;
    return c->K + raised(s, c->mu) * at(c, STIFFNESS, s);
}

/* G of the slice from s to the inner end */
static fret_real load_beyond(const fret_cell *c, fret_real s, fret_real to_q, fret_real to_mu) {
    return to_mu * (s * at(c, PART_G, s) + to_q * at(c, PART_GQ, s));
}

fret_real fret_cell_rise(const fret_cell *c, int by, fret_real s) {
    if (c->powers)
        return s > c->begin ? rise_of_powers(c, by, s) : 0;
    const fret_real to_q = c->count[RISE_Q] ? raised(s, c->q) : 0,
                    depth = s * at(c, RISE, s) + to_q * at(c, RISE_Q, s);
    return by == BY_DEPTH ? depth : c->K * depth + load_beyond(c, s, to_q, raised(s, c->mu));
}

/* A rise and its derivative, in double. */
static double rise_about(const fret_cell *c, int by, double s, double *rate) {
    double P1, Q1;
    const double P = about_with_rate(c, RISE, s, &P1), Q = about_with_rate(c, RISE_Q, s, &Q1),
                 q = (double)c->q, to_q = c->count[RISE_Q] ? q == 0.5 ? sqrt(s) : pow(s, q) : 0;
    const double depth = s * P + to_q * Q;
    *rate = P + s * P1 + to_q / s * (q * Q + s * Q1);
    if (by == BY_DEPTH)
        return depth;
    const double to_mu = c->mu == 1 ? s : pow(s, (double)c->mu);
    *rate *= (double)c->K + to_mu * about(c, STIFFNESS, s);
    return (double)c->K * depth + to_mu * (s * about(c, PART_G, s) + to_q * about(c, PART_GQ, s));
}

/* The derivative of s^e p, over s^(e-1). */
static fret_real rate_at(const fret_cell *c, int i, fret_real e, fret_real s) {
    fret_real sum = 0;
    for (int j = c->count[i]; j-- > 0;)
        sum = sum * s + ((fret_real)j + e) * c->of[i][j];
    return sum;
}

fret_real fret_cell_rate(const fret_cell *c, int by, fret_real s) {
    if (c->powers)
        return rate_of_powers(c, by, s);
    const fret_real rate =
        rate_at(c, RISE, 1, s) + (c->count[RISE_Q] ? raised(s, c->q) / s * rate_at(c, RISE_Q, c->q, s) : 0);
    return by == BY_LOAD ? fret_cell_stiffness(c, s) * rate : rate;
}

fret_real fret_cell_fall(const fret_cell *c, int by, fret_real s, fret_real back) {
    if (c->powers) {
        const fret_stretch p = part_of_powers(c, s, log_left(s, back));
        return by == BY_DEPTH ? p.h : p.G + p.h * (back < s ? stiffness_of_powers(c, s - back) : 0);
    }
    descent w = descent_from(c, s);
    descend(c, &w, back);
    return by == BY_DEPTH ? depth_fall(c, &w) : load_fall(c, &w);
}

/* ---- places ------------------------------------------------------------------------------------ */

fret_real fret_cell_radius(const fret_cell *c, fret_real s) {
    if (c->powers)
        return s > 0 ? c->x * s : 0;
    if (!(s > 0))
        return c->x;
    return c->x + c->width * s / (c->x + sqrtl(c->x * c->x + c->width * s));
}

fret_real fret_cell_place(const fret_cell *c, fret_real x) {
    return c->powers ? x / c->x : fminl((x - c->x) * (x + c->x) / c->width, 1);
}

/* The s of a rise, found in double, and the rate there; false if not found to 1e-6. */
static bool place_about(const fret_cell *c, int by, fret_real rise, fret_real *place, double *rate) {
    static const double LEAST_DOUBLE = 1e-280;
    const double target = (double)rise, share = (double)(rise / c->rise[by]);
    double s = pow(share, 1 / c->steep[by]);
    *place = s;
    if (!(s > LEAST_DOUBLE && target > LEAST_DOUBLE)) {
        *place = fret_pow(rise / c->rise[by], 1 / (fret_real)c->steep[by]);
        return false;
    }
    for (int i = 0; i < 8; i++) {
        const double value = rise_about(c, by, s, rate), step = (target - value) / *rate;
        const double next =
            fabs(step) < 1e-3 * s ? s + step : s * exp(log(target / value) * value / (s * *rate));
        if (!(next > LEAST_DOUBLE && next <= 1))
            return false;
        *place = s = next;
        if (fabs(step) < 1e-6 * s)
            return true;
    }
    return false;
}

/* A root problem: where the rise, or the fall from s on, is `wanted`. */
typedef struct search {
    const fret_cell *cell;
    int by;
    fret_real wanted, s;
} search;

/* In logarithms, since rises are nearly powers of s; the last step goes in s, which has more digits. */
static fret_real miss_at(fret_real log, fret_real *slope, void *context) {
    const search *f = context;
    const fret_real s = expl(log), value = fret_cell_rise(f->cell, f->by, s);
    *slope = value > 0 ? fret_cell_rate(f->cell, f->by, s) * s / value : 0;
    return value > 0 ? logl(value / f->wanted) : -(fret_real)LDBL_MAX;
}

/* Closer to the centre, or to a flat end, s would underflow. */
static const fret_real LEAST = 1e-4900L;

fret_real fret_cell_find(const fret_cell *c, int by, fret_real rise) {
    if (!(rise > 0) || !(c->width > 0))
        return c->begin;
    if (!c->powers && rise >= c->rise[by])
        return 1;
    fret_real lo = fmaxl(c->begin, LEAST), hi = c->powers ? fminl(c->begin + 1, c->width) : 1, s = hi;
    double about;
    if (!c->powers && place_about(c, by, rise, &s, &about)) { /* one more Newton step */
        const fret_real step = (rise - fret_cell_rise(c, by, s)) / about;
        if (fabsl(step) <= 1e-9L * s)
            return fminl(s + step, 1);
    }
    if (fret_cell_rise(c, by, lo) >= rise)
        return c->begin;
    for (; c->powers && hi < c->width && fret_cell_rise(c, by, hi) < rise; hi = fminl(16 * hi, c->width))
        lo = hi;
    if (!(fret_cell_rise(c, by, hi) > rise)) /* `rise` lies at or beyond the end */
        return hi;
    search f = {c, by, rise, 0};
    s = expl(fret_root(miss_at, &f, logl(lo), logl(hi), logl(s)));
    s += (rise - fret_cell_rise(c, by, s)) / fret_cell_rate(c, by, s);
    return fminl(fmaxl(s, c->begin), hi);
}

static fret_real short_of(fret_real back, fret_real *slope, void *context) {
    const search *f = context;
    *slope = fret_cell_rate(f->cell, f->by, f->s - back);
    return fret_cell_fall(f->cell, f->by, f->s, back) - f->wanted;
}

/* By secant steps, the first with the rate at s; the error is about the product of the last two steps. */
fret_real fret_cell_find_back(const fret_cell *c, int by, fret_real s, fret_real drop, fret_real guess) {
    enum { STEPS = 6 };
    static const fret_real ENOUGH = 1e-18L;
    const fret_real most = s - c->begin;
    fret_real back = guess > 0 ? guess : drop / fret_cell_rate(c, by, s), before = 0, fallen = 0;
    if (!(drop > 0))
        return 0;
    for (int i = 0; i < STEPS && back > 0 && back < most; i++) {
        const fret_real fall = fret_cell_fall(c, by, s, back), last = back - before,
                        step = (drop - fall) * last / (fall - fallen);
        if (fabsl(step * last) <= ENOUGH * s * back)
            return fminl(back + step, most);
        before = back;
        fallen = fall;
        back += step;
    }
    if (drop >= fret_cell_rise(c, by, s))
        return most;
    search f = {c, by, drop, s};
    return fret_root(short_of, &f, 0, most, drop / fret_cell_rate(c, by, s));
}

/* ---- slices ------------------------------------------------------------------------------------ */

fret_stretch fret_cell_below(const fret_cell *c, fret_real s) {
    if (c->powers)
        return s > c->begin ? part_of_powers(c, s, log_left(s, s - c->begin)) : (fret_stretch){0, 0, 0, 0};
    const bool bent = c->count[RISE_Q];
    const fret_real to_q = bent ? raised(s, c->q) : 0, to_mu = raised(s, c->mu);
    return (fret_stretch){.h = s * at(c, RISE, s) + (bent ? to_q * at(c, RISE_Q, s) : 0),
                          .K = to_mu * at(c, STIFFNESS, s),
                          .G = load_beyond(c, s, to_q, to_mu),
                          .L = to_mu *
                               (s * s * at(c, PART_L, s) +
                                (bent ? to_q * (s * at(c, PART_LQ, s) + to_q * at(c, PART_LQQ, s)) : 0))};
}

/* All nodes of Gauss's rule in one vector. */
enum { NODES = 8 };
typedef double lanes __attribute__((vector_size(NODES * sizeof(double))));

/* For a slice of thickness h: G/(h K) and L/(h^2 K), the means of t/h and t/h (1-t/h), which never underflow
 * and for which the digits of a double suffice. */
static void means_of_part(const fret_cell *c, const descent *w, fret_real h, double *G, double *L) {
    const fret_real edge = c->x * c->x + c->width * w->s;
    const double s = (double)w->s, part = (double)(w->back / w->s), q = (double)c->q,
                 power = (double)c->m - 1, share = (double)(w->s / h), share_q = (double)(w->to_q / h),
                 fall = (double)(c->width * w->back / edge);
    double P = 0, Q = 0, sum = 0;
    lanes back, node, less, quotient = {0}, quotient_q = {0};
    for (int i = 0; i < NODES; i++)
        node[i] = (double)fret_gauss_node[i];
    back = part * node;
    const lanes inner = s - s * back;
    for (int j = c->count[RISE]; j-- > 0;) {
        quotient = quotient * inner + P;
        P = P * s + (double)c->of[RISE][j];
    }
    lanes t = share * back * (P + inner * quotient);
    if (c->count[RISE_Q]) {
        for (int j = c->count[RISE_Q]; j-- > 0;) {
            quotient_q = quotient_q * inner + Q;
            Q = Q * s + (double)c->of[RISE_Q][j];
        }
        for (int i = 0; i < NODES; i++)
            less[i] = -expm1(q * log1p(-back[i]));
        t += share_q * (less * Q + (1 - less) * back * s * quotient_q);
    }
    *G = *L = 0;
    for (int i = 0; i < NODES; i++) {
        const double dK = (double)fret_gauss_weight[i] * pow(1 - fall * node[i], power);
        sum += dK;
        *G += t[i] * dK;
        *L += t[i] * (1 - t[i]) * dK;
    }
    *G /= sum;
    *L /= sum;
}

/* By Gauss's rule, in parts that stay away from the kink at s = 0: for a part of length `back` the 8-point
 * rule errs by (4 s/back)^-16. */
fret_stretch fret_cell_part(const fret_cell *c, fret_real s, fret_real back) {
    static const fret_real CLOSE = 0.17L;
    if (c->powers)
        return part_of_powers(c, s, log_left(s, back));
    if (back > 1.5L * CLOSE * s) {
        const fret_stretch outer = fret_cell_part(c, s, CLOSE * s),
                           rest = fret_cell_part(c, s - CLOSE * s, back - CLOSE * s);
        return fret_stretch_join(&outer, &rest);
    }
    double G, L;
    descent w = descent_from(c, s);
    descend(c, &w, back);
    const fret_real h = depth_fall(c, &w), K = stiffness_fall(c, &w);
    means_of_part(c, &w, h, &G, &L);
    return (fret_stretch){h, K, h * K * G, h * h * K * L};
}

/* ---- while it is made -------------------------------------------------------------------------- */

int fret_cell_fit(const fret_chebyshev *nodes, const fret_real *value, fret_real little, fret_real *c,
                  fret_real *tail) {
    fret_real term[FRET_CELL_TERMS];
    int count = nodes->count;
    fret_chebyshev_terms(nodes, value, term);
    *tail = fmaxl(fabsl(term[count - 2]), fabsl(term[count - 1]));
    while (count > 0 && fabsl(term[count - 1]) <= little)
        count--;
    fret_chebyshev_powers(nodes, term, count, c);
    return count;
}

/* Fits series i: s^power times it is the integral of s^(power-1) times the values; 0: it is the values. */
static bool integrate(fret_cell *c, int i, const fret_chebyshev *nodes, const fret_real *value,
                      fret_real power) {
    static const fret_real LITTLE = 2e-19L, ENOUGH = 1e-17L;
    fret_real most = 0, tail;
    for (int j = 0; j < nodes->count; j++)
        most = fmaxl(most, fabsl(value[j]));
    const int count = fret_cell_fit(nodes, value, LITTLE * most, c->of[i], &tail);
    for (int j = 0; j < count && power > 0; j++)
        c->of[i][j] /= (fret_real)j + power;
    c->count[i] = (unsigned char)count;
    return tail <= ENOUGH * most;
}

/* Adds the product of two series to series i, integrated likewise. */
static void multiply(fret_cell *c, int i, const fret_real *a, const fret_real *b, int count,
                     fret_real power) {
    for (int j = 0; j < FRET_CELL_TERMS; j++) {
        fret_real sum = 0;
        for (int l = 0; l <= j; l++)
            if (l < count && j - l < count)
                sum += a[l] * b[j - l];
        c->of[i][j] += sum / ((fret_real)j + power);
        if (sum != 0)
            c->count[i] = (unsigned char)(j + 1 > c->count[i] ? j + 1 : c->count[i]);
    }
}

/* The series of a cell from y' = dy/ds: with k = (K-K0)/s^mu and y' = P1 + s^(q-1) Q1,
 *   G = int (K-K0) dy,   M = int (y-y0) dK = (y-y0)(K-K0) - G,   L = int M dy,   MP, MQ: the series of M.
 * At the centre, where s is small and terms may differ by any factor, this goes term by term. */
static void complete_centre(fret_cell *c) {
    enum { N = FRET_CELL_TERMS };
    const fret_real q = c->q, mu = c->mu, k[N] = {fret_pow(c->width, c->m)};
    fret_real P1[N], Q1[N], MP[N], MQ[N];
    c->of[STIFFNESS][0] = k[0];
    c->count[STIFFNESS] = 1;
    for (int j = 0; j < N; j++) {
        P1[j] = ((fret_real)j + 1) * c->of[RISE][j];
        Q1[j] = ((fret_real)j + q) * c->of[RISE_Q][j];
    }
    multiply(c, PART_G, k, P1, N, mu + 1);
    multiply(c, PART_GQ, k, Q1, N, mu + q);
    for (int j = 0; j < N; j++) {
        MP[j] = k[0] * c->of[RISE][j] - c->of[PART_G][j];
        MQ[j] = k[0] * c->of[RISE_Q][j] - c->of[PART_GQ][j];
    }
    multiply(c, PART_L, P1, MP, N, mu + 2);
    multiply(c, PART_LQ, P1, MQ, N, mu + q + 1);
    multiply(c, PART_LQ, Q1, MP, N, mu + q + 1);
    multiply(c, PART_LQQ, Q1, MQ, N, mu + 2 * q);
}

static bool complete_by_fits(fret_cell *c, const fret_chebyshev *nodes) {
    enum { N = FRET_CELL_TERMS };
    const int count = nodes->count;
    const fret_real q = c->q, mu = c->mu, x2 = c->x * c->x;
    fret_real k[N] = {0}, P1[N], Q1[N], MP[N], MQ[N], v[N];
    bool ok = true, bent = c->count[RISE_Q];
    for (int j = 0; j < count; j++) {
        const fret_real s = nodes->node[j];
        k[j] = c->K * expm1l(c->m * log1pl(c->width * s / x2)) / s;
        P1[j] = rate_at(c, RISE, 1, s);
        Q1[j] = rate_at(c, RISE_Q, q, s);
    }
    ok &= integrate(c, STIFFNESS, nodes, k, 0);
    for (int j = 0; j < count; j++)
        v[j] = k[j] * P1[j];
    ok &= integrate(c, PART_G, nodes, v, mu + 1);
    for (int j = 0; j < count; j++)
        v[j] = k[j] * Q1[j];
    ok &= !bent || integrate(c, PART_GQ, nodes, v, mu + q);
    for (int j = 0; j < count; j++) {
        const fret_real s = nodes->node[j];
        MP[j] = at(c, RISE, s) * k[j] - at(c, PART_G, s);
        MQ[j] = at(c, RISE_Q, s) * k[j] - at(c, PART_GQ, s);
        v[j] = P1[j] * MP[j];
    }
    ok &= integrate(c, PART_L, nodes, v, mu + 2);
    for (int j = 0; j < count; j++)
        v[j] = P1[j] * MQ[j] + Q1[j] * MP[j];
    ok &= !bent || integrate(c, PART_LQ, nodes, v, mu + q + 1);
    for (int j = 0; j < count; j++)
        v[j] = Q1[j] * MQ[j];
    ok &= !bent || integrate(c, PART_LQQ, nodes, v, mu + 2 * q);
    for (int j = 0; j < count; j++) {
        const fret_real s = nodes->node[j], dK = rate_at(c, STIFFNESS, 1, s);
        v[j] = (c->y + s * at(c, RISE, s)) * dK;
        Q1[j] = at(c, RISE_Q, s) * dK;
    }
    (void)integrate(c, AREA, nodes, v, 0); /* converges like the series above */
    if (bent)
        (void)integrate(c, AREA_Q, nodes, Q1, 0);
    return ok;
}

bool fret_cell_complete(fret_cell *c, const fret_chebyshev *nodes) {
    const bool ok = c->x > 0 ? complete_by_fits(c, nodes) : true;
    if (!(c->x > 0))
        complete_centre(c);
    for (int by = BY_DEPTH; by <= BY_LOAD; by++) {
        c->rise[by] = fret_cell_rise(c, by, 1);
        c->steep[by] = (double)(fret_cell_rate(c, by, 1) / c->rise[by]);
    }
    return ok;
}
