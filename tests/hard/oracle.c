/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "oracle.h"

#include <math.h>
#include <stdlib.h>

/* Cancellation costs at most: cos(pi k/2), 1-k nu/(1-nu) 53 bits each; powers 1/n and n 20; 1-(1-t)^q above
 * the switch to its series 24 + 20. b(t) ~ q r t^3/12 loses 3*24 bits of t, 20 of q, 70 of r = 1-q. */
enum { BITS = 256, LOSS_BITS = 448 };
#define SERIES_BELOW 0x1p-24

#define X(name, text) text,
const char *const oracle_names[ORACLE_COUNT] = {ORACLE_SCALARS(X)};
#undef X

#define RN MPFR_RNDN

enum { SCRATCH = 8, LOSS_SCRATCH = 7 };

struct oracle {
    oracle_contact now;
    bool known;         /* `now` holds a contact */
    double F, mu;       /* pressed with */
    mpfr_t k1, s, q, p; /* 1+k, n+k+1, n/s, s/n */
    mpfr_t gamma_half;  /* Gamma((1+k)/2) */
    mpfr_t gamma_one;   /* Gamma(1+k/2) */
    mpfr_t gamma_two;   /* Gamma(2+k) */
    mpfr_t gA, fA, kA;  /* g = gA x^n, F_N = fA a^s, kn = kA a^(1+k) */
    mpfr_t t, x;        /* fractions of gross slip */
    mpfr_t u[SCRATCH];
    mpfr_t v[LOSS_SCRATCH]; /* LOSS_BITS each */
    mpfr_t value[ORACLE_COUNT];
};

/* Every number of the struct that has BITS bits. */
static void each(oracle *o, void (*f)(mpfr_ptr)) {
    mpfr_ptr one[] = {o->k1,        o->s,  o->q,  o->p,  o->gamma_half, o->gamma_one,
                      o->gamma_two, o->gA, o->fA, o->kA, o->t,          o->x};
    for (size_t i = 0; i < sizeof one / sizeof *one; i++)
        f(one[i]);
    for (int i = 0; i < SCRATCH; i++)
        f(o->u[i]);
    for (int i = 0; i < ORACLE_COUNT; i++)
        f(o->value[i]);
}

static void make_number(mpfr_ptr x) {
    mpfr_init2(x, BITS);
    mpfr_set_zero(x, 1);
}

static void free_number(mpfr_ptr x) {
    mpfr_clear(x);
}

oracle *oracle_new(void) {
    oracle *o = calloc(1, sizeof *o);
    if (!o)
        abort();
    each(o, make_number);
    for (int i = 0; i < LOSS_SCRATCH; i++)
        mpfr_init2(o->v[i], LOSS_BITS);
    return o;
}

void oracle_free(oracle *o) {
    each(o, free_number);
    for (int i = 0; i < LOSS_SCRATCH; i++)
        mpfr_clear(o->v[i]);
    free(o);
    mpfr_free_cache();
}

mpfr_srcptr oracle_value(const oracle *o, oracle_scalar which) {
    return o->value[which];
}

double oracle_t(const oracle *o) {
    return mpfr_get_d(o->t, RN);
}

double oracle_x(const oracle *o) {
    return mpfr_get_d(o->x, RN);
}

/* Gamma functions of k alone. */
static void gammas(oracle *o) {
    mpfr_ptr u = o->u[0];
    mpfr_div_2ui(u, o->k1, 1, RN);
    mpfr_gamma(o->gamma_half, u, RN);
    mpfr_set_d(u, o->now.k, RN);
    mpfr_div_2ui(u, u, 1, RN);
    mpfr_add_ui(u, u, 1, RN);
    mpfr_gamma(o->gamma_one, u, RN);
    mpfr_add_ui(u, o->k1, 1, RN);
    mpfr_gamma(o->gamma_two, u, RN);
}

/* (A1)-(A3):
 *   beta = sqrt((1+k)(1-k nu/(1-nu)))
 *   C  = 2^(1+k) Gamma((3+k+beta)/2) Gamma((3+k-beta)/2)/(pi Gamma(2+k))
 *   hN = 2 (1+k) cos(pi k/2) Gamma(1+k/2)/(sqrt(pi) C beta sin(pi beta/2) Gamma((1+k)/2))
 *   hT = 2 beta cos(pi k/2) Gamma(1+k/2)/((1-nu^2) sqrt(pi) C sin(pi beta/2) Gamma((3+k)/2)
 *                                          + (1+nu) beta Gamma(1+k/2)) */
static void half_space(oracle *o, double k, double nu_, mpfr_ptr hN, mpfr_ptr hT, mpfr_ptr beta) {
    mpfr_ptr nu = o->u[0], C = o->u[1], pi = o->u[2], w = o->u[3], top = o->u[4], root = o->u[5];
    mpfr_const_pi(pi, RN);
    mpfr_set_d(nu, nu_, RN);
    mpfr_ui_sub(w, 1, nu, RN);
    mpfr_div(w, nu, w, RN);
    mpfr_mul_d(w, w, k, RN);
    mpfr_ui_sub(w, 1, w, RN);
    mpfr_mul(w, w, o->k1, RN);
    mpfr_sqrt(beta, w, RN);

    mpfr_ui_pow(C, 2, o->k1, RN);
    mpfr_add_ui(w, o->k1, 2, RN);
    mpfr_add(w, w, beta, RN);
    mpfr_div_2ui(w, w, 1, RN);
    mpfr_gamma(w, w, RN);
    mpfr_mul(C, C, w, RN);
    mpfr_add_ui(w, o->k1, 2, RN);
    mpfr_sub(w, w, beta, RN);
    mpfr_div_2ui(w, w, 1, RN);
    mpfr_gamma(w, w, RN);
    mpfr_mul(C, C, w, RN);
    mpfr_div(C, C, pi, RN);
    mpfr_div(C, C, o->gamma_two, RN);

    /* C becomes sqrt(pi) C sin(pi beta/2), which both have */
    mpfr_sqrt(root, pi, RN);
    mpfr_mul(C, C, root, RN);
    mpfr_mul(w, pi, beta, RN);
    mpfr_div_2ui(w, w, 1, RN);
    mpfr_sin(w, w, RN);
    mpfr_mul(C, C, w, RN);

    mpfr_mul_d(top, pi, k, RN);
    mpfr_div_2ui(top, top, 1, RN);
    mpfr_cos(top, top, RN);
    mpfr_mul_2ui(top, top, 1, RN);
    mpfr_mul(top, top, o->gamma_one, RN);

    mpfr_mul(hN, top, o->k1, RN);
    mpfr_div(hN, hN, C, RN);
    mpfr_div(hN, hN, beta, RN);
    mpfr_div(hN, hN, o->gamma_half, RN);

    mpfr_sqr(w, nu, RN);
    mpfr_ui_sub(w, 1, w, RN);
    mpfr_mul(C, C, w, RN);
    mpfr_mul(C, C, o->gamma_half, RN); /* Gamma((3+k)/2) = (1+k)/2 Gamma((1+k)/2) */
    mpfr_mul(C, C, o->k1, RN);
    mpfr_div_2ui(C, C, 1, RN);
    mpfr_add_ui(w, nu, 1, RN);
    mpfr_mul(w, w, beta, RN);
    mpfr_mul(w, w, o->gamma_one, RN);
    mpfr_add(C, C, w, RN);
    mpfr_mul(hT, top, beta, RN);
    mpfr_div(hT, hT, C, RN);
}

/* 1/cN0 = sum (1-nu^2)/(hN E0), 1/cT0 = sum 1/(hT E0) (4),(5). */
static void foundation(oracle *o) {
    mpfr_ptr cN = o->value[ORACLE_CN0], cT = o->value[ORACLE_CT0], w = o->u[0];
    mpfr_set_zero(cN, 1);
    mpfr_set_zero(cT, 1);
    for (int i = 0; i < 2; i++) {
        if (o->now.rigid[i])
            continue;
        mpfr_set_d(w, o->now.nu[i], RN);
        mpfr_sqr(w, w, RN);
        mpfr_ui_sub(w, 1, w, RN);
        mpfr_div(w, w, o->value[i ? ORACLE_HN_2 : ORACLE_HN_1], RN);
        mpfr_div_d(w, w, o->now.E0[i], RN);
        mpfr_add(cN, cN, w, RN);
        mpfr_ui_div(w, 1, o->value[i ? ORACLE_HT_2 : ORACLE_HT_1], RN);
        mpfr_div_d(w, w, o->now.E0[i], RN);
        mpfr_add(cT, cT, w, RN);
    }
    mpfr_div(o->value[ORACLE_ETA], cT, cN, RN); /* both are still inverse */
    mpfr_ui_div(cN, 1, cN, RN);
    mpfr_ui_div(cT, 1, cT, RN);
}

/* kappa = (n/2) B(n/2,(k+1)/2) (6)-(8). */
static void kappa(oracle *o) {
    mpfr_ptr w = o->u[0], y = o->value[ORACLE_KAPPA];
    mpfr_set_d(y, o->now.n, RN);
    mpfr_div_2ui(y, y, 1, RN);
    mpfr_gamma(w, y, RN);
    mpfr_mul(y, y, w, RN);
    mpfr_mul(y, y, o->gamma_half, RN);
    mpfr_div_2ui(w, o->s, 1, RN);
    mpfr_gamma(w, w, RN);
    mpfr_div(y, y, w, RN);
}

void oracle_set_contact(oracle *o, const oracle_contact *c) {
    bool same_k = o->known && o->now.k == c->k, same_n = same_k && o->now.n == c->n, same_nu[2];
    for (int i = 0; i < 2; i++)
        same_nu[i] = same_k && o->now.rigid[i] == c->rigid[i] && (c->rigid[i] || o->now.nu[i] == c->nu[i]);
    o->now = *c;
    o->known = true;
    mpfr_set_d(o->k1, c->k, RN);
    mpfr_add_ui(o->k1, o->k1, 1, RN);
    mpfr_add_d(o->s, o->k1, c->n, RN);
    mpfr_d_div(o->q, c->n, o->s, RN);
    mpfr_div_d(o->p, o->s, c->n, RN);
    if (!same_k)
        gammas(o);
    for (int i = 0; i < 2; i++) {
        mpfr_ptr hN = o->value[i ? ORACLE_HN_2 : ORACLE_HN_1], hT = o->value[i ? ORACLE_HT_2 : ORACLE_HT_1],
                 beta = o->value[i ? ORACLE_BETA_2 : ORACLE_BETA_1];
        if (same_nu[i])
            continue;
        if (c->rigid[i]) {
            mpfr_set_zero(hN, 1);
            mpfr_set_zero(hT, 1);
            mpfr_set_zero(beta, 1);
        } else {
            half_space(o, c->k, c->nu[i], hN, hT, beta);
        }
    }
    foundation(o);
    if (!same_n)
        kappa(o);

    /* A = h/r0^n, gA = kappa A; kA = 2 cN0 c0^-k/(k+1); fA = kA gA n/(n+k+1) (13) */
    mpfr_ptr w = o->u[0];
    mpfr_set_d(w, c->r0, RN);
    mpfr_set_d(o->gA, c->n, RN);
    mpfr_pow(o->gA, w, o->gA, RN);
    mpfr_d_div(o->gA, c->h, o->gA, RN);
    mpfr_mul(o->gA, o->gA, o->value[ORACLE_KAPPA], RN);
    mpfr_set_d(w, c->c0, RN);
    mpfr_set_d(o->kA, -c->k, RN);
    mpfr_pow(o->kA, w, o->kA, RN);
    mpfr_mul(o->kA, o->kA, o->value[ORACLE_CN0], RN);
    mpfr_mul_2ui(o->kA, o->kA, 1, RN);
    mpfr_div(o->kA, o->kA, o->k1, RN);
    mpfr_mul(o->fA, o->kA, o->gA, RN);
    mpfr_mul_d(o->fA, o->fA, c->n, RN);
    mpfr_div(o->fA, o->fA, o->s, RN);
}

static void depth_of_radius(oracle *o, mpfr_ptr dz, mpfr_srcptr a) {
    mpfr_set_d(o->u[0], o->now.n, RN);
    mpfr_pow(o->u[0], a, o->u[0], RN);
    mpfr_mul(dz, o->u[0], o->gA, RN);
}

static void force_of_radius(oracle *o, mpfr_ptr F, mpfr_srcptr a) {
    mpfr_pow(o->u[0], a, o->s, RN);
    mpfr_mul(F, o->u[0], o->fA, RN);
}

void oracle_press_force(oracle *o, double F) {
    mpfr_ptr a = o->value[ORACLE_A_OF_F], kn = o->value[ORACLE_KN], w = o->u[0];
    o->F = F;
    mpfr_d_div(a, F, o->fA, RN);
    mpfr_ui_div(w, 1, o->s, RN);
    mpfr_pow(a, a, w, RN);
    depth_of_radius(o, o->value[ORACLE_DZ_OF_F], a);
    mpfr_pow(w, a, o->k1, RN);
    mpfr_mul(kn, w, o->kA, RN);
}

void oracle_press_depth(oracle *o, double dz) {
    mpfr_ptr a = o->value[ORACLE_A_OF_DZ], w = o->u[0];
    mpfr_d_div(a, dz, o->gA, RN);
    mpfr_set_d(w, o->now.n, RN);
    mpfr_ui_div(w, 1, w, RN);
    mpfr_pow(a, a, w, RN);
    force_of_radius(o, o->value[ORACLE_F_OF_DZ], a);
}

void oracle_press_radius(oracle *o, double a) {
    mpfr_ptr w = o->u[1];
    mpfr_set_d(w, a, RN);
    depth_of_radius(o, o->value[ORACLE_DZ_OF_A], w);
    force_of_radius(o, o->value[ORACLE_F_OF_A], w);
}

/* y = 1-(1-t)^m for 0 <= t <= 1; where that would lose too much, -sum_(j>0) C(m,j) (-t)^j. */
static void lost(oracle *o, mpfr_ptr y, mpfr_srcptr t, mpfr_srcptr m) {
    mpfr_ptr term = o->u[0], factor = o->u[1];
    mpfr_mul(term, t, m, RN);
    if (mpfr_cmp_d(t, SERIES_BELOW) >= 0 || mpfr_cmp_d(term, SERIES_BELOW) >= 0) {
        mpfr_ui_sub(factor, 1, t, RN);
        mpfr_pow(factor, factor, m, RN);
        mpfr_ui_sub(y, 1, factor, RN);
        return;
    }
    mpfr_set(y, term, RN); /* j = 1 */
    for (unsigned long j = 2; j <= BITS / 24 + 2; j++) {
        mpfr_ui_sub(factor, j - 1, m, RN);
        mpfr_mul(factor, factor, t, RN);
        mpfr_div_ui(factor, factor, j, RN);
        mpfr_mul(term, term, factor, RN);
        mpfr_add(y, y, term, RN);
    }
}

/* dW = 8 b/(1+q) mu F_N dxmax (27), b = 1 - (1-t)^(1+q) - (1+q)/2 t (1 + (1-t)^q), where s = 1-t = rest^m: q
 * may be so small that s^q is felt where t = 1 to any number of digits. For tiny t by the series (1+q)
 * sum_(j>2) (-1)^j C(q,j-1) (1/2 - 1/j) t^j, all terms positive. */
static void loss(oracle *o, mpfr_ptr dW, mpfr_srcptr tiny, mpfr_srcptr rest, mpfr_srcptr m) {
    mpfr_ptr q = o->v[0], q1 = o->v[1], s = o->v[2], sq = o->v[3], b = o->v[4], w = o->v[5], t = o->v[6];
    mpfr_set_d(q, o->now.k, RN);
    mpfr_add_ui(q, q, 1, RN);
    mpfr_add_d(q, q, o->now.n, RN);
    mpfr_d_div(q, o->now.n, q, RN);
    mpfr_add_ui(q1, q, 1, RN);
    if (mpfr_cmp_d(tiny, SERIES_BELOW) >= 0) {
        mpfr_pow(s, rest, m, RN);
        mpfr_ui_sub(t, 1, s, RN);
        mpfr_pow(sq, s, q, RN);
        mpfr_add_ui(w, sq, 1, RN);
        mpfr_mul(w, w, t, RN);
        mpfr_mul(w, w, q1, RN);
        mpfr_div_2ui(w, w, 1, RN);
        mpfr_mul(b, sq, s, RN);
        mpfr_ui_sub(b, 1, b, RN);
        mpfr_sub(b, b, w, RN);
    } else {
        mpfr_ptr binomial = s; /* (-1)^j C(q,j-1) t^j */
        mpfr_set(t, tiny, RN);
        mpfr_mul(binomial, q, t, RN);
        mpfr_mul(binomial, binomial, t, RN);
        mpfr_set_zero(b, 1);
        for (unsigned long j = 3; j <= BITS / 24 + 5; j++) {
            mpfr_ui_sub(w, j - 2, q, RN);
            mpfr_mul(w, w, t, RN);
            mpfr_div_ui(w, w, j - 1, RN);
            mpfr_mul(binomial, binomial, w, RN);
            mpfr_mul_ui(w, binomial, j - 2, RN); /* 1/2 - 1/j = (j-2)/(2j) */
            mpfr_div_ui(w, w, 2 * j, RN);
            mpfr_add(b, b, w, RN);
        }
        mpfr_mul(b, b, q1, RN);
    }
    mpfr_mul_2ui(b, b, 3, RN);
    mpfr_div(b, b, q1, RN);
    mpfr_mul_d(b, b, o->F, RN);
    mpfr_mul_d(b, b, o->mu, RN);
    mpfr_mul(dW, b, o->value[ORACLE_DX_MAX], RN);
}

void oracle_friction(oracle *o, double mu) {
    mpfr_ptr max = o->value[ORACLE_DX_MAX];
    o->mu = mu;
    mpfr_mul_d(max, o->value[ORACLE_ETA], mu, RN);
    mpfr_mul(max, max, o->value[ORACLE_DZ_OF_F], RN);
}

/* t = Fx/(mu F_N); c = a (1-t)^(1/(n+k+1)), yc = g(c), dx = dxmax (1-(c/a)^n) (17),(18). */
void oracle_load_force(oracle *o, double Fx) {
    mpfr_ptr c = o->value[ORACLE_C_OF_FX], s = o->u[2], w = o->u[3];
    mpfr_set_d(w, o->F, RN);
    mpfr_mul_d(w, w, o->mu, RN);
    mpfr_d_div(o->t, Fx, w, RN);
    mpfr_ui_sub(s, 1, o->t, RN);
    if (mpfr_cmp_d(s, 0x1p-52) <= 0) {
        mpfr_set_ui(o->t, 1, RN);
        mpfr_set_zero(s, 1);
    }
    mpfr_ui_div(w, 1, o->s, RN);
    mpfr_pow(w, s, w, RN);
    mpfr_mul(c, w, o->value[ORACLE_A_OF_F], RN);
    depth_of_radius(o, o->value[ORACLE_YC_OF_FX], c);
    lost(o, w, o->t, o->q);
    mpfr_mul(o->value[ORACLE_DX_OF_FX], w, o->value[ORACLE_DX_MAX], RN);
    mpfr_set_ui(w, 1, RN);
    loss(o, o->value[ORACLE_DW_OF_FX], o->t, s, w);
}

/* x = dx/dxmax = 1-(c/a)^n, F_x = mu F_N (1-(1-x)^p); beyond dxmax gross slip adds 4 mu F_N (dx-dxmax) to the
 * cycle. */
void oracle_load_displacement(oracle *o, double dx) {
    mpfr_ptr c = o->value[ORACLE_C_OF_DX], Fx = o->value[ORACLE_FX_OF_DX], dW = o->value[ORACLE_DW_OF_DX];
    mpfr_ptr rest = o->u[2], w = o->u[3], beyond = o->u[4];
    mpfr_d_div(o->x, dx, o->value[ORACLE_DX_MAX], RN);
    mpfr_d_sub(beyond, dx, o->value[ORACLE_DX_MAX], RN);
    bool slides = mpfr_sgn(beyond) >= 0;
    if (slides) {
        mpfr_set_zero(rest, 1);
        mpfr_set_zero(c, 1);
        mpfr_set_zero(o->value[ORACLE_YC_OF_DX], 1);
        mpfr_set_ui(w, 1, RN);
    } else {
        mpfr_ui_sub(rest, 1, o->x, RN);
        mpfr_set_d(w, o->now.n, RN);
        mpfr_ui_div(w, 1, w, RN);
        mpfr_pow(w, rest, w, RN);
        mpfr_mul(c, w, o->value[ORACLE_A_OF_F], RN);
        depth_of_radius(o, o->value[ORACLE_YC_OF_DX], c);
        lost(o, w, o->x, o->p);
    }
    loss(o, dW, w, rest, o->p);
    mpfr_mul_d(Fx, w, o->mu, RN);
    mpfr_mul_d(Fx, Fx, o->F, RN);
    if (slides) {
        mpfr_mul_2ui(beyond, beyond, 2, RN);
        mpfr_mul(beyond, beyond, Fx, RN);
        mpfr_add(dW, dW, beyond, RN);
    }
}

double oracle_ulps(double got, mpfr_srcptr exact) {
    enum { LEAST = -1074 };
    mpfr_t error;
    mpfr_init2(error, BITS);
    mpfr_d_sub(error, got, exact, RN);
    long place = mpfr_zero_p(exact) ? LEAST : (long)mpfr_get_exp(exact) - 53;
    mpfr_mul_2si(error, error, place > LEAST ? -place : -LEAST, RN);
    double ulps = mpfr_get_d(error, RN);
    mpfr_clear(error);
    return fabs(ulps);
}
