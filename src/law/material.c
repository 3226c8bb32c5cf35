/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Coefficients of the equivalent foundations, (A1)-(A3), (4), (5), in double-doubles: quotients lose digits
 * at the ends of the ranges of k and nu. */
#include "law/material.h"

#include <float.h>

#include "law/check.h"

/* The factors of h_N, h_T and eta: see fret_foundation. ck is the only one that vanishes as |k| -> 1. */
typedef struct parts {
    dd beta, Q, SP, ck;
    dd one_nu; /* 1-nu */
} parts;

static parts parts_of(double k, double nu) {
    parts r;
    dd k1 = dd_sum(1, k), two = dd_of(2);
    r.one_nu = dd_sum(1, -nu);
    if (nu <= 0.25)
        r.Q = dd_add_d(dd_neg(dd_mul_d(k1, nu)), 1);
    else
        r.Q = dd_add(dd_sum(1, -2 * nu), dd_mul_d(dd_sum(1, -k), nu));
    r.beta = dd_sqrt(dd_div(dd_mul(k1, r.Q), r.one_nu));
    dd S = fret_dd_sin_quarter(r.beta.hi > 1 ? dd_sub(two, r.beta) : r.beta);
    dd half_beta = {r.beta.hi / 2, r.beta.lo / 2}, x = dd_add_d((dd){k1.hi / 2, k1.lo / 2}, 1);
    const dd over[] = {dd_add(x, half_beta), dd_sub(x, half_beta)}, w = dd_add_d(x, -0.5), under[] = {w, w};
    dd_scaled P = fret_dd_gamma_quotient(over, 2, under, 2);
    r.SP = dd_mul(dd_div(S, r.beta), dd_mul(P.factor, fret_dd_exp(P.log)));
    r.ck = fret_dd_sin_quarter(dd_sum(1, -fabs(k))); /* cos(pi k/2) */
    return r;
}

/* (1-nu^2)/h_N and 1/h_T times cos(pi k/2), which is common to both bodies. */
static dd normal_part(const parts *r, double k, double nu) {
    return dd_div(dd_mul(dd_mul(dd_sum(1, nu), r->Q), r->SP), dd_sum(1, k));
}
static dd tangential_part(const parts *r, double nu) {
    dd t = dd_mul(dd_sum(1, nu), dd_add_d(dd_mul(r->one_nu, r->SP), 1));
    return (dd){t.hi / 2, t.lo / 2};
}

static fret_real hN_of(const parts *r, double k) {
    return dd_value(dd_div(dd_mul(dd_mul(dd_sum(1, k), r->one_nu), r->ck), dd_mul(r->Q, r->SP)));
}
static fret_real hT_of(const parts *r, double nu) {
    return dd_value(dd_div(r->ck, tangential_part(r, nu)));
}

static fret_status check_nu(const char *name, double nu) {
    if (!isfinite(nu))
        return fret_fail(FRET_NOT_FINITE, name, nu, 0);
    if (nu <= -1 || nu > 0.5)
        return fret_fail(FRET_BAD_NU, name, nu, nu < 0 ? -1 : 0.5);
    return fret_ok();
}

static const char *const E_name[2] = {"E0", "E0_2"}, *const nu_name[2] = {"nu", "nu_2"};

fret_status fret_foundation_make(const fret_material *material, fret_foundation *out) {
    fret_wide_foundation wide;
    return fret_foundation_make_wide(material, out, &wide);
}

/* Checks the material; E0 and nu of elastic bodies alone. */
static fret_status check_bodies(const fret_material *m) {
    fret_status st = fret_check_k(m->k);
    for (int i = 0; i < 2 && !st.code; i++) {
        if (m->body[i].rigid)
            continue;
        st = fret_check_positive(E_name[i], m->body[i].E0);
        if (!st.code)
            st = check_nu(nu_name[i], m->body[i].nu);
    }
    if (!st.code)
        st = fret_check_positive("c0", m->c0);
    if (!st.code && m->body[0].rigid && m->body[1].rigid)
        st = fret_fail(FRET_BOTH_RIGID, NULL, 0, 0);
    return st;
}

fret_status fret_foundation_make_wide(const fret_material *m, fret_foundation *out,
                                      fret_wide_foundation *wide) {
    fret_status st = check_bodies(m);
    if (st.code)
        return st;
    fret_foundation f = {.k = m->k, .c0 = m->c0};
    dd normal = dd_of(0), tangential = dd_of(0), ck = dd_of(1);
    fret_real drive = 0, holl = 0;
    const fret_body *last = NULL;
    parts r;
    int scale; /* moduli in units of 2^scale, so that their squares stay in range */
    (void)frexp(m->body[m->body[0].rigid].E0, &scale);
    for (int i = 0; i < 2; i++) {
        const fret_body *b = &m->body[i];
        if (b->rigid)
            continue;
        if (!last || last->nu != b->nu)
            r = parts_of(m->k, b->nu);
        last = b;
        ck = r.ck; /* the same for both */
        const dd E = dd_of(ldexp(b->E0, -scale));
        normal = dd_add(normal, dd_div(normal_part(&r, m->k, b->nu), E));
        tangential = dd_add(tangential, dd_div(tangential_part(&r, b->nu), E));
        fret_real away = dd_value(dd_sub(dd_of(1), dd_mul_d(dd_sum(2, m->k), b->nu))); /* 1 - nu/nu_Holl */
        drive += (i ? -1 : 1) * away * (1 + (fret_real)b->nu) / E.hi;
        holl = fmaxl(holl, fabsl(away));
        f.hN[i] = hN_of(&r, m->k);
        f.hT[i] = hT_of(&r, b->nu);
        f.beta[i] = dd_value(r.beta);
    }
    wide->cN0 = dd_div(ck, normal);
    wide->scale = scale;
    wide->eta = dd_div(tangential, normal);
    f.cN0 = ldexpl(dd_value(wide->cN0), scale);
    f.cT0 = ldexpl(dd_value(dd_div(ck, tangential)), scale);
    f.eta = dd_value(wide->eta);
    if (!isfinite(f.cN0 + f.cT0 + f.eta)) /* moduli too different */
        return fret_fail(FRET_OVERFLOW, E_name[m->body[0].rigid], m->body[m->body[0].rigid].E0, DBL_MAX);
    bool equal = !m->body[0].rigid && !m->body[1].rigid && m->body[0].E0 == m->body[1].E0 &&
                 m->body[0].nu == m->body[1].nu;
    f.mismatch = fabsl(drive) * dd_value(wide->cN0) / 2;
    /* 1e-12: nu = 1/(2+k) cannot be typed exactly */
    f.similar = equal || holl < 1e-12L || (m->k == 0 && f.mismatch < 1e-12L);
    *out = f;
    return fret_ok();
}
