/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fret/material.h"

#include "special.h"

/* What h_N, h_T and eta are made of; ck is the only factor that vanishes as |k| -> 1. */
typedef struct parts {
    fret_real beta, Q, SP, ck;
} parts;

static parts parts_of(double k_, double nu_) {
    fret_real k = k_, nu = nu_, hk = (1 + k) / 2;
    parts r;
    r.Q = nu <= 0.25L ? 1 - (1 + k) * nu : (1 - 2 * nu) + (1 - k) * nu;
    r.beta = sqrtl((1 + k) * r.Q / (1 - nu));
    fret_real S;
    if (r.beta > 1)
        S = sinl(PI_L * (2 - r.beta) / 2) / r.beta;
    else if (r.beta > 1e-10L)
        S = sinl(PI_L * r.beta / 2) / r.beta;
    else
        S = PI_L / 2;
    fret_real g = tgammal(0.5L + hk); /* Gamma(1 + k/2) */
    r.SP = S * tgammal(1 + hk + r.beta / 2) * tgammal(1 + hk - r.beta / 2) / (g * g);
    r.ck = fabsl(k) <= 0.5L ? cosl(PI_L * k / 2) : sinl(PI_L * (1 - fabsl(k)) / 2);
    return r;
}

static fret_status check_k(double k) {
    if (!isfinite(k))
        return fret_fail(FRET_NOT_FINITE, "k", k, 0);
    if (k <= -1 || k >= 1)
        return fret_fail(FRET_BAD_K, "k", k, k < 0 ? -1 : 1);
    return fret_ok();
}

static fret_status check_nu(const char *name, double nu) {
    if (!isfinite(nu))
        return fret_fail(FRET_NOT_FINITE, name, nu, 0);
    if (nu <= -1 || nu > 0.5)
        return fret_fail(FRET_BAD_NU, name, nu, nu < 0 ? -1 : 0.5);
    return fret_ok();
}

fret_status fret_half_space(double k, double nu, fret_real *hN, fret_real *hT, fret_real *beta) {
    fret_status st = check_k(k);
    if (!st.code)
        st = check_nu("nu", nu);
    if (st.code)
        return st;
    parts r = parts_of(k, nu);
    *hN = (1 + (fret_real)k) * (1 - (fret_real)nu) * r.ck / (r.Q * r.SP);
    *hT = 2 * r.ck / ((1 + (fret_real)nu) * (1 + (1 - (fret_real)nu) * r.SP));
    *beta = r.beta;
    return fret_ok();
}

fret_status fret_foundation_make(const fret_material *m, fret_foundation *out) {
    static const char *const E_name[2] = {"E0", "E0_2"}, *const nu_name[2] = {"nu", "nu_2"};
    fret_status st = check_k(m->k);
    for (int i = 0; i < 2 && !st.code; i++) {
        if (m->body[i].rigid)
            continue;
        st = fret_check_positive(E_name[i], m->body[i].E0);
        if (!st.code)
            st = check_nu(nu_name[i], m->body[i].nu);
    }
    if (!st.code)
        st = fret_check_positive("c0", m->c0);
    if (st.code)
        return st;
    if (m->body[0].rigid && m->body[1].rigid)
        return fret_fail(FRET_BOTH_RIGID, NULL, 0, 0);

    fret_foundation f = {.k = m->k, .c0 = m->c0};
    fret_real normal = 0, tangential = 0, drive = 0, holl = 0;
    fret_real ck = 1, k = m->k;
    for (int i = 0; i < 2; i++) {
        const fret_body *b = &m->body[i];
        if (b->rigid)
            continue;
        parts r = parts_of(m->k, b->nu);
        fret_real nu = b->nu, per_E = (1 + nu) / b->E0;
        /* cos(pi k/2), common to both sums, is kept out of eta */
        normal += per_E * r.Q * r.SP / (1 + k);
        tangential += per_E * (1 + (1 - nu) * r.SP) / 2;
        fret_real away = 1 - (2 + k) * nu; /* from Holl's ratio */
        drive += (i ? -1 : 1) * away * per_E;
        holl = fmaxl(holl, fabsl(away));
        ck = r.ck;
        f.hN[i] = (1 + k) * (1 - nu) * ck / (r.Q * r.SP);
        f.hT[i] = 2 * ck / ((1 + nu) * (1 + (1 - nu) * r.SP));
        f.beta[i] = r.beta;
    }
    f.cN0 = ck / normal;
    f.cT0 = ck / tangential;
    f.eta = tangential / normal;
    bool equal = !m->body[0].rigid && !m->body[1].rigid && m->body[0].E0 == m->body[1].E0 &&
                 m->body[0].nu == m->body[1].nu;
    f.mismatch = fabsl(drive) * f.cN0 / 2;
    /* 1e-12: nu = 1/(2+k) cannot be typed exactly */
    f.similar = equal || holl < 1e-12L || (m->k == 0 && f.mismatch < 1e-12L);
    *out = f;
    return fret_ok();
}
