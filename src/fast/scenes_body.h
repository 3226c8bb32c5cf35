/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes for each width: included by number/lanes.h alone. The formulas are those of contact/material.c,
 * normal.c and cycle.c, in pairs of doubles wherever digits would be lost. */

/* high + low, |low| <= ulp(high)/2 */
typedef struct NAMED(pair) {
    V hi, lo;
} NAMED(pair);
#define PAIR NAMED(pair)
#define ALL(x) ((V){0} + (x))

FRET_INLINE void NAMED(pair_quick)(const V *a, const V *b, PAIR *out) { /* |a| >= |b| */
    V s = *a + *b;
    out->lo = *b - (s - *a);
    out->hi = s;
}

FRET_INLINE void NAMED(pair_sum)(const V *a, const V *b, PAIR *out) {
    V x = *a, y = *b, s = x + y, v = s - x;
    out->lo = (x - (s - v)) + (y - v);
    out->hi = s;
}

FRET_INLINE void NAMED(pair_add)(const PAIR *a, const PAIR *b, PAIR *out) {
    PAIR s;
    NAMED(pair_sum)(&a->hi, &b->hi, &s);
    s.lo += a->lo + b->lo;
    NAMED(pair_quick)(&s.hi, &s.lo, out);
}

FRET_INLINE void NAMED(pair_add_one)(const PAIR *a, double b, PAIR *out) {
    PAIR s;
    V y = ALL(b);
    NAMED(pair_sum)(&a->hi, &y, &s);
    s.lo += a->lo;
    NAMED(pair_quick)(&s.hi, &s.lo, out);
}

FRET_INLINE void NAMED(pair_minus)(const PAIR *a, const PAIR *b, PAIR *out) {
    PAIR negative = {-b->hi, -b->lo};
    NAMED(pair_add)(a, &negative, out);
}

FRET_INLINE void NAMED(pair_times)(const PAIR *a, const PAIR *b, PAIR *out) {
    V h, l;
    NAMED(product)(&a->hi, &b->hi, &h, &l);
    l += a->hi * b->lo + a->lo * b->hi;
    NAMED(pair_quick)(&h, &l, out);
}

FRET_INLINE void NAMED(pair_scaled)(const PAIR *a, const V *b, PAIR *out) {
    V h, l;
    NAMED(product)(&a->hi, b, &h, &l);
    l += a->lo * *b;
    NAMED(pair_quick)(&h, &l, out);
}

FRET_INLINE void NAMED(pair_over)(const PAIR *a, const PAIR *b, PAIR *out) {
    V q = a->hi / b->hi, h, l;
    NAMED(product)(&b->hi, &q, &h, &l);
    V rest = ((((a->hi - h) - l) + a->lo) - b->lo * q) / b->hi;
    NAMED(pair_quick)(&q, &rest, out);
}

/* x > 0. 1/sqrt x from half of its exponent, by Newton's method. */
FRET_INLINE void NAMED(pair_root)(const PAIR *x, PAIR *out) {
    V half = 0.5 * x->hi, y = VALUE(0x5fe6eb50c7b537a9u - (BITS(x->hi) >> 1)), r, h, l;
    for (int i = 0; i < 4; i++)
        y = y * (1.5 - half * y * y);
    r = x->hi * y;
    NAMED(product)(&r, &r, &h, &l);
    V rest = (((x->hi - h) - l) + x->lo) * (0.5 * y);
    NAMED(pair_quick)(&r, &rest, out);
}

/* ln x, x > 0 and normal */
FRET_INLINE void NAMED(pair_log)(const PAIR *x, PAIR *out) {
    V m, e, factor;
    NAMED(reduce)(&x->hi, &m, &e, &factor);
    V f = m - 1.0, low = x->lo * factor;
    NAMED(log_pair)(&f, &low, &e, &out->hi, &out->lo);
}

/* exp x */
FRET_INLINE void NAMED(pair_exp)(const PAIR *x, V *out) {
    V one = ALL(1.0);
    NAMED(exp_times)(&one, &x->hi, &x->lo, out);
}

/* sin(pi x/2), 0 <= x <= 1: sin y = 3 s - 4 s^3, s = sin(y/3), of which the first term alone is long. */
FRET_INLINE void NAMED(pair_sine)(const PAIR *x, PAIR *out) {
    const PAIR sixth = {ALL(0x1.0c152382d7366p-1), ALL(-0x1.ee6913347c2a6p-55)}; /* pi/6 */
    PAIR y, s, square, cube;
    NAMED(pair_times)(x, &sixth, &y);
    V w = y.hi * y.hi, w2 = w * w;
    V t = ((-1 / 6.0 + w * (1 / 120.0)) + w2 * (-1 / 5040.0 + w * (1 / 362880.0))) +
          (w2 * w2) * ((-1 / 39916800.0 + w * (1 / 6227020800.0)) + w2 * (-1 / 1307674368000.0));
    V rest = (y.hi * w) * t;
    NAMED(pair_quick)(&y.hi, &rest, &s);
    s.lo += y.lo * (1.0 - 0.5 * w);
    NAMED(pair_quick)(&s.hi, &s.lo, &s);
    NAMED(pair_times)(&s, &s, &square);
    NAMED(pair_times)(&square, &s, &cube);
    PAIR three, four = {-4.0 * cube.hi, -4.0 * cube.lo};
    V factor = ALL(3.0);
    NAMED(pair_scaled)(&s, &factor, &three);
    NAMED(pair_add)(&three, &four, out);
}

/* Gamma(x) = sqrt(2 pi) exp(log)/rising, x >= 1/2: as in number/dd.c. */
FRET_INLINE void NAMED(gamma_part)(const PAIR *x, PAIR *log, PAIR *rising) {
    PAIR far, w, part[8], z, l, half;
    M small = x->hi < 16.0;
    NAMED(pair_add_one)(x, 15, &w);
    NAMED(pair_times)(x, &w, &w);
    for (int j = 0; j < 8; j++)
        NAMED(pair_add_one)(&w, j * (15 - j), &part[j]);
    for (int n = 4; n > 0; n /= 2)
        for (int j = 0; j < n; j++)
            NAMED(pair_times)(&part[j], &part[j + n], &part[j]);
    NAMED(pair_add_one)(x, 16, &far);
    rising->hi = SELECT(small, part[0].hi, ALL(1.0));
    rising->lo = SELECT(small, part[0].lo, ALL(0.0));
    z.hi = SELECT(small, far.hi, x->hi);
    z.lo = SELECT(small, far.lo, x->lo);
    V i = 1.0 / z.hi, u = i * i; /* below 0.006 in all: no more than double */
    V series =
        i * (1 / 12.0 +
             u * (-1 / 360.0 +
                  u * (1 / 1260.0 +
                       u * (-1 / 1680.0 + u * (1 / 1188.0 + u * (-691 / 360360.0 + u * (1 / 156.0)))))));
    NAMED(pair_log)(&z, &l);
    NAMED(pair_add_one)(&z, -0.5, &half);
    NAMED(pair_times)(&half, &l, log);
    NAMED(pair_minus)(log, &z, log);
    log->lo += series;
    NAMED(pair_quick)(&log->hi, &log->lo, log);
}

/* What h_N and h_T of a body are made of. */
typedef struct NAMED(half_space) {
    PAIR one_k, one_nu, beta, Q, SP;
    PAIR normal, tangential; /* (1-nu^2)/h_N and 1/h_T without cos(pi k/2) */
} NAMED(half_space);

FRET_INLINE void NAMED(half_space_of)(const V *k, const V *nu, NAMED(half_space) * r) {
    const V one = ALL(1.0), minus_nu = -*nu, minus_k = -*k;
    PAIR a, b, x, log[3], rising[3];
    NAMED(pair_sum)(&one, k, &r->one_k);
    NAMED(pair_sum)(&one, &minus_nu, &r->one_nu);
    /* Q = 1-(1+k) nu = (1-2 nu)+(1-k) nu */
    NAMED(pair_scaled)(&r->one_k, &minus_nu, &a);
    NAMED(pair_add_one)(&a, 1, &a);
    V twice = -2.0 * *nu;
    PAIR first, second;
    NAMED(pair_sum)(&one, &twice, &first);
    NAMED(pair_sum)(&one, &minus_k, &second);
    NAMED(pair_scaled)(&second, nu, &second);
    NAMED(pair_add)(&first, &second, &b);
    M low_nu = *nu <= 0.25;
    r->Q.hi = SELECT(low_nu, a.hi, b.hi);
    r->Q.lo = SELECT(low_nu, a.lo, b.lo);
    NAMED(pair_times)(&r->one_k, &r->Q, &a);
    NAMED(pair_over)(&a, &r->one_nu, &a);
    NAMED(pair_root)(&a, &r->beta);
    /* S = sin(pi beta/2)/beta */
    PAIR two = {ALL(2.0), ALL(0.0)}, angle;
    NAMED(pair_minus)(&two, &r->beta, &b);
    M beyond = r->beta.hi > 1.0;
    angle.hi = SELECT(beyond, b.hi, r->beta.hi);
    angle.lo = SELECT(beyond, b.lo, r->beta.lo);
    NAMED(pair_sine)(&angle, &a);
    NAMED(pair_over)(&a, &r->beta, &r->SP);
    /* P = Gamma((3+k+beta)/2) Gamma((3+k-beta)/2)/Gamma(1+k/2)^2 */
    PAIR half = {0.5 * r->beta.hi, 0.5 * r->beta.lo}, of[3];
    x = (PAIR){0.5 * r->one_k.hi, 0.5 * r->one_k.lo};
    NAMED(pair_add_one)(&x, 0.5, &of[2]);
    NAMED(pair_add_one)(&x, 1, &x);
    NAMED(pair_add)(&x, &half, &of[0]);
    NAMED(pair_minus)(&x, &half, &of[1]);
    for (int i = 0; i < 3; i++) /* not unrolled: it is long */
        NAMED(gamma_part)(&of[i], &log[i], &rising[i]);
    PAIR sum, top, bottom;
    V P;
    NAMED(pair_add)(&log[0], &log[1], &sum);
    NAMED(pair_minus)(&sum, &log[2], &sum);
    NAMED(pair_minus)(&sum, &log[2], &sum);
    NAMED(pair_times)(&rising[2], &rising[2], &top);
    NAMED(pair_times)(&rising[0], &rising[1], &bottom);
    NAMED(pair_over)(&top, &bottom, &top);
    NAMED(pair_exp)(&sum, &P);
    NAMED(pair_times)(&r->SP, &top, &r->SP);
    NAMED(pair_scaled)(&r->SP, &P, &r->SP);
    PAIR one_and_nu;
    NAMED(pair_sum)(&one, nu, &one_and_nu);
    NAMED(pair_times)(&r->Q, &r->SP, &a);
    NAMED(pair_times)(&a, &one_and_nu, &a);
    NAMED(pair_over)(&a, &r->one_k, &r->normal);
    NAMED(pair_times)(&r->one_nu, &r->SP, &a);
    NAMED(pair_add_one)(&a, 1, &a);
    NAMED(pair_times)(&a, &one_and_nu, &a);
    r->tangential = (PAIR){0.5 * a.hi, 0.5 * a.lo};
}

/* kappa = Gamma(1+(k+1)/2) Gamma(1+n/2)/Gamma(1+(n+k+1)/2) (n+k+1)/(k+1) = factor exp(log) */
FRET_INLINE void NAMED(kappa_of)(const PAIR *one_k, const V *n, const PAIR *s, PAIR *factor, PAIR *log) {
    const V half_n = 0.5 * *n, one = ALL(1.0);
    PAIR half = {0.5 * one_k->hi, 0.5 * one_k->lo}, of[3], part[3], rising[3];
    NAMED(pair_add_one)(&half, 1, &of[0]);
    NAMED(pair_sum)(&half_n, &one, &of[1]);
    NAMED(pair_add)(&of[1], &half, &of[2]);
    for (int i = 0; i < 3; i++)
        NAMED(gamma_part)(&of[i], &part[i], &rising[i]);
    const PAIR root = {ALL(half_log_2pi.hi), ALL(half_log_2pi.lo)};
    NAMED(pair_add)(&part[0], &part[1], log);
    NAMED(pair_minus)(log, &part[2], log);
    NAMED(pair_add)(log, &root, log);
    PAIR bottom;
    NAMED(pair_over)(s, one_k, factor);
    NAMED(pair_times)(factor, &rising[2], factor);
    NAMED(pair_times)(&rising[0], &rising[1], &bottom);
    NAMED(pair_over)(factor, &bottom, factor);
}

FRET_INLINE void NAMED(log_of_one)(const V *x, PAIR *out) {
    PAIR p = {*x, ALL(0.0)};
    NAMED(pair_log)(&p, out);
}

/* exp(base + log power) */
FRET_INLINE void NAMED(raised)(const PAIR *base, const PAIR *log, const PAIR *power, V *out) {
    PAIR x;
    NAMED(pair_times)(log, power, &x);
    NAMED(pair_add)(base, &x, &x);
    NAMED(pair_exp)(&x, out);
}

/* The tangential law, as batch_body.h has it for one contact. */
typedef struct NAMED(push) {
    V q, mu, slip, limit; /* limit = mu F_N */
    PAIR inverse_s;       /* 1/(n+k+1) */
    V a, r;               /* r = 1-q */
    V Fx;
} NAMED(push);

FRET_INLINE void NAMED(push_of)(const NAMED(push) * p, const PAIR *limit, V *c, V *dx, V *loss) {
    /* t = F_x/(mu F_N) and s = 1-t, each in full */
    PAIR F = {p->Fx, ALL(0.0)}, t, s, log;
    NAMED(pair_over)(&F, limit, &t);
    NAMED(pair_minus)(limit, &F, &s);
    NAMED(pair_over)(&s, limit, &s);
    V m, e, factor, zero = ALL(0.0);
    V positive = SELECT(s.hi > DBL_EPSILON, s.hi, ALL(1.0));
    NAMED(reduce)(&positive, &m, &e, &factor);
    V f = SELECT(e == 0.0, -t.hi, m - 1.0), low = SELECT(e == 0.0, -t.lo, s.lo * factor);
    NAMED(log_pair)(&f, &low, &e, &log.hi, &log.lo);
    const M gross = s.hi <= DBL_EPSILON;
    V L = -log.hi, y, x;
    PAIR power;
    NAMED(pair_times)(&log, &p->inverse_s, &power);
    NAMED(exp_times)(&p->a, &power.hi, &power.lo, c);
    x = p->q * log.hi;
    NAMED(expm1)(&x, &y);
    *dx = -p->slip * y;
    /* loss */
    V q = p->q, alpha = 0.5 * (1.0 + q), sigma = 2.0 * q / (1.0 + q), rho = p->r / (1.0 + q),
      rho2 = rho * rho;
    const V scale = 4.0 * (p->limit * p->slip);
    M blunt = q < 1 / 3.0, shallow = L < 3.5;
    V series[FRET_SWEEP_TERMS], sum = zero;
    for (int j = 0; j < FRET_SWEEP_TERMS; j++) {
        sum = 1.0 + rho2 * sum;
        series[j] = sum * fret_loss_factorial[j];
    }
    V b = alpha * L, w = b * b, w2 = w * w, w4 = w2 * w2, w8 = w4 * w4, k, g, h;
    const V *u = series;
    sum = (((u[0] + w * u[1]) + w2 * (u[2] + w * u[3])) + w4 * ((u[4] + w * u[5]) + w2 * (u[6] + w * u[7]))) +
          w8 * (((u[8] + w * u[9]) + w2 * (u[10] + w * u[11])) + w4 * ((u[12] + w * u[13]) + w2 * u[14]));
    x = SELECT(blunt, -alpha, 0.5 * p->r) * L;
    NAMED(exp_of)(&x, &zero, &k, &g);
    NAMED(two_to)(&k, &h);
    g = (1.0 + g) * h;
    g = SELECT(blunt, g, g * s.hi);
    V small = ((((scale * (q * p->r)) * L) * L) * L) * (g * sum);
    x = SELECT(blunt, -q, p->r) * L;
    NAMED(expm1)(&x, &y);
    V slope = 1.0 + rho * s.hi;
    V deep = SELECT(blunt, -slope * y - sigma * t.hi, rho * (t.hi + t.hi * s.hi) - slope * (s.hi * y));
    V inside = SELECT(shallow, small, scale * deep), nan = ALL((double)NAN);
    *loss = SELECT(gross, scale * rho, inside);
    *c = SELECT(gross, zero, *c);
    *dx = SELECT(gross, p->slip, *dx);
    M allowed = s.hi >= -DBL_EPSILON;
    allowed &= t.hi >= 1e-20;
    *loss = SELECT(allowed, *loss, nan);
    *c = SELECT(allowed, *c, nan);
    *dx = SELECT(allowed, *dx, nan);
}

/* Within lo .. hi? One by one: some compilers take a conjunction of masks apart, number by number. */
FRET_INLINE void NAMED(bounded)(const V *x, double lo, double hi, M *ok) {
    *ok &= *x >= lo;
    *ok &= *x <= hi;
}

FRET_INLINE void NAMED(store)(fret_scene_block *b, fret_scene_output which, size_t at, const V *x,
                              const M *ok) {
    V v = SELECT(*ok, *x, ALL((double)NAN));
    memcpy(&b->out[which][at], &v, sizeof v);
}

FRET_INLINE void NAMED(scene)(fret_scene_block *b, size_t at) {
    static const double lo = 1e-60, hi = 1e60;
    V in[SCENE_INPUTS];
    for (int i = 0; i < SCENE_INPUTS; i++)
        memcpy(&in[i], &b->in[i][at], sizeof in[i]);
    V k = in[SCENE_K], n = in[SCENE_N];
    M ok = k > -1.0;
    ok &= k < 1.0;
    M nu_ok = in[SCENE_NU] > -1.0;
    nu_ok &= in[SCENE_NU] <= 0.5;
    nu_ok &= in[SCENE_NU_2] > -1.0;
    nu_ok &= in[SCENE_NU_2] <= 0.5;
    ok &= nu_ok;
    NAMED(bounded)(&n, 0.05, 1000, &ok);
    const fret_scene_input positive[] = {SCENE_E0, SCENE_E0_2, SCENE_C0, SCENE_H,
                                         SCENE_R0, SCENE_F,    SCENE_MU};
    for (size_t i = 0; i < sizeof positive / sizeof *positive; i++)
        NAMED(bounded)(&in[positive[i]], lo, hi, &ok);

    /* the foundation */
    const PAIR none = {ALL(0.0), ALL(0.0)};
    NAMED(half_space) body;
    PAIR ck, normal = none, tangential = none, x, y;
    V v, size = VALUE(BITS(k) & 0x7fffffffffffffffu), from_end = 1.0 - size;
    ck = (PAIR){from_end, (1.0 - from_end) - size};
    NAMED(pair_sine)(&ck, &ck);
    const int bodies = b->alike || b->rigid ? 1 : 2;
    int i = bodies;
    do { /* the first one last: it is shown */
        i--;
        const PAIR E = {in[i ? SCENE_E0_2 : SCENE_E0], ALL(0.0)};
        NAMED(half_space_of)(&k, &in[i ? SCENE_NU_2 : SCENE_NU], &body);
        NAMED(pair_over)(&body.normal, &E, &x);
        NAMED(pair_over)(&body.tangential, &E, &y);
        NAMED(pair_add)(&x, &normal, &normal);
        NAMED(pair_add)(&y, &tangential, &tangential);
    } while (i > 0);
    if (b->alike) {
        normal = (PAIR){2.0 * normal.hi, 2.0 * normal.lo};
        tangential = (PAIR){2.0 * tangential.hi, 2.0 * tangential.lo};
    }
    PAIR cN0, eta;
    NAMED(pair_over)(&ck, &normal, &cN0);
    NAMED(pair_over)(&tangential, &normal, &eta);
    NAMED(pair_times)(&body.one_k, &body.one_nu, &x);
    NAMED(pair_times)(&x, &ck, &x);
    NAMED(pair_times)(&body.Q, &body.SP, &y);
    NAMED(pair_over)(&x, &y, &x);
    NAMED(store)(b, SCENE_HN, at, &x.hi, &ok);
    NAMED(pair_over)(&ck, &body.tangential, &x);
    NAMED(store)(b, SCENE_HT, at, &x.hi, &ok);
    NAMED(store)(b, SCENE_BETA, at, &body.beta.hi, &ok);
    NAMED(pair_over)(&ck, &tangential, &x);
    NAMED(bounded)(&x.hi, lo, hi, &ok);
    NAMED(bounded)(&cN0.hi, lo, hi, &ok);
    NAMED(store)(b, SCENE_CT0, at, &x.hi, &ok);
    NAMED(store)(b, SCENE_CN0, at, &cN0.hi, &ok);
    NAMED(store)(b, SCENE_ETA, at, &eta.hi, &ok);

    /* the normal contact: depth and force at a = r0, in logarithms */
    PAIR s, q, factor, log, ln_r0, ln_c0, ln_depth, ln_force, ln_F;
    PAIR n_pair = {n, ALL(0.0)}, h_pair;
    NAMED(pair_sum)(&body.one_k.hi, &n, &s);
    s.lo += body.one_k.lo;
    NAMED(pair_quick)(&s.hi, &s.lo, &s);
    NAMED(bounded)(&s.hi, 0.25, 2000, &ok); /* small powers magnify errors */
    NAMED(pair_over)(&n_pair, &s, &q);
    NAMED(kappa_of)(&body.one_k, &n, &s, &factor, &log);
    NAMED(pair_exp)(&log, &v);
    V kappa = factor.hi * v;
    NAMED(bounded)(&kappa, lo, hi, &ok);
    NAMED(store)(b, SCENE_KAPPA, at, &kappa, &ok);
    NAMED(log_of_one)(&in[SCENE_R0], &ln_r0);
    NAMED(log_of_one)(&in[SCENE_C0], &ln_c0);
    NAMED(log_of_one)(&in[SCENE_F], &ln_F);
    NAMED(pair_scaled)(&factor, &in[SCENE_H], &h_pair);
    NAMED(pair_log)(&h_pair, &ln_depth);
    NAMED(pair_add)(&ln_depth, &log, &ln_depth);
    /* 2 c_N0 n/((k+1) s) (r0/c0)^k r0 */
    V twice = 2.0 * n;
    NAMED(pair_scaled)(&cN0, &twice, &x);
    NAMED(pair_times)(&body.one_k, &s, &y);
    NAMED(pair_over)(&x, &y, &x);
    NAMED(pair_log)(&x, &ln_force);
    NAMED(pair_minus)(&ln_r0, &ln_c0, &x);
    NAMED(pair_scaled)(&x, &k, &x);
    NAMED(pair_add)(&ln_force, &x, &ln_force);
    NAMED(pair_add)(&ln_force, &ln_r0, &ln_force);
    NAMED(pair_add)(&ln_force, &ln_depth, &ln_force);
    NAMED(pair_minus)(&ln_F, &ln_force, &log);
    PAIR one = {ALL(1.0), ALL(0.0)}, inverse_s;
    V a, dz;
    NAMED(pair_over)(&one, &s, &inverse_s);
    NAMED(raised)(&ln_r0, &log, &inverse_s, &a);
    NAMED(raised)(&ln_depth, &log, &q, &dz);
    NAMED(bounded)(&a, lo, hi, &ok);
    NAMED(bounded)(&dz, lo, hi, &ok);
    NAMED(store)(b, SCENE_A, at, &a, &ok);
    NAMED(store)(b, SCENE_DZ, at, &dz, &ok);
    V kn = in[SCENE_F] / (q.hi * dz), slip = (in[SCENE_MU] * eta.hi) * dz;
    NAMED(store)(b, SCENE_KN, at, &kn, &ok);
    NAMED(store)(b, SCENE_SLIP, at, &slip, &ok);
    if (!b->pushed)
        return;

    PAIR F = {in[SCENE_F], ALL(0.0)}, limit;
    NAMED(pair_scaled)(&F, &in[SCENE_MU], &limit);
    NAMED(pair_over)(&body.one_k, &s, &x); /* 1-q */
    const NAMED(push) push = {q.hi, in[SCENE_MU], slip, limit.hi, inverse_s, a, x.hi, in[SCENE_FX]};
    V c, dx, loss;
    NAMED(push_of)(&push, &limit, &c, &dx, &loss);
    NAMED(store)(b, SCENE_C, at, &c, &ok);
    NAMED(store)(b, SCENE_DX, at, &dx, &ok);
    NAMED(store)(b, SCENE_LOSS, at, &loss, &ok);
}

#undef PAIR
#undef ALL
