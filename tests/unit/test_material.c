/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "unit.h"

static const double nan_ = (double)NAN, inf_ = (double)INFINITY;

/* h_N, h_T and beta of one half-space: of a foundation beside a rigid one. */
static fret_status half_space(double k, double nu, fret_real *hN, fret_real *hT, fret_real *beta) {
    const fret_material m = {{{1, nu, false}, {.rigid = true}}, k, 1};
    fret_foundation f;
    const fret_status st = fret_foundation_make(&m, &f);
    if (!st.code) {
        *hN = f.hN[0];
        *hT = f.hT[0];
        *beta = f.beta[0];
    }
    return st;
}

static void half_space_reference(void) {
    unit_table t;
    if (!unit_open(&t, "material.csv"))
        return;
    while (unit_row(&t)) {
        double k = unit_input(&t, 0), nu = unit_input(&t, 1);
        fret_real hN = 0, hT = 0, beta = 0;
        CHECK_OK(half_space(k, nu, &hN, &hT, &beta));
        if (fabs(k) <= 0.95 && nu >= -0.95) {
            CHECK_REL(hN, unit_result(&t, 2), UNIT_TOL(3e-18L, 2e-15L));
            CHECK_REL(hT, unit_result(&t, 3), UNIT_TOL(3e-18L, 2e-15L));
            CHECK_REL(beta, unit_result(&t, 4), UNIT_TOL(3e-18L, 2e-15L));
        } else { /* the corners |k| -> 1, nu -> -1 */
            CHECK_REL(hN, unit_result(&t, 2), UNIT_TOL(5e-18L, 5e-15L));
            CHECK_REL(hT, unit_result(&t, 3), UNIT_TOL(5e-18L, 5e-15L));
            CHECK_REL(beta, unit_result(&t, 4), UNIT_TOL(5e-18L, 5e-15L));
        }
    }
}

static void half_space_identities(void) {
    for (double nu = -0.9; nu <= 0.5; nu += 0.1) {
        fret_real hN = 0, hT = 0, beta = 0;
        CHECK_OK(half_space(0, nu, &hN, &hT, &beta));
        CHECK_REL(hN, 1.0L, UNIT_TOL(2e-18L, 2e-15L));
        CHECK_REL(hT, 2 / ((1 + (fret_real)nu) * (2 - (fret_real)nu)), UNIT_TOL(2e-18L, 2e-15L));
        CHECK_REL(beta, sqrtl((1 - 0 * (fret_real)nu)), UNIT_TOL(2e-18L, 2e-15L));
    }
}

static void half_space_errors(void) {
    fret_real hN = 7, hT = 7, beta = 7;
    static const double bad_k[] = {1, -1, 1.5, -2, 1e300},
                        bad_nu[] = {-1, -1.5, 0.5000000000000001, 1, 1e300};
    for (int i = 0; i < 5; i++) {
        CHECK_ERROR(half_space(bad_k[i], 0.3, &hN, &hT, &beta), FRET_BAD_K, "k");
        CHECK_ERROR(half_space(0, bad_nu[i], &hN, &hT, &beta), FRET_BAD_NU, "nu");
    }
    const double wild[] = {nan_, inf_, -inf_};
    for (int i = 0; i < 3; i++) {
        CHECK_ERROR(half_space(wild[i], 0.3, &hN, &hT, &beta), FRET_NOT_FINITE, "k");
        CHECK_ERROR(half_space(0, wild[i], &hN, &hT, &beta), FRET_NOT_FINITE, "nu");
    }
    CHECK(hN == 7 && hT == 7 && beta == 7); /* untouched */
    fret_status st = half_space(1.5, 0.3, &hN, &hT, &beta);
    CHECK(st.value == 1.5 && st.limit == 1);
    st = half_space(0, 0.75, &hN, &hT, &beta);
    CHECK(st.value == 0.75 && st.limit == 0.5);
    /* the last doubles inside */
    const double edge_k[] = {nextafter(1, 0), nextafter(-1, 0)}, edge_nu[] = {0.5, nextafter(-1, 0)};
    for (int i = 0; i < 4; i++) {
        CHECK_OK(half_space(edge_k[i & 1], edge_nu[i >> 1], &hN, &hT, &beta));
        CHECK(hN > 0 && hT > 0 && beta >= 0 && isfinite(hN) && isfinite(hT) && isfinite(beta));
    }
}

static void foundation_reference(void) {
    unit_table t;
    if (!unit_open(&t, "foundation.csv"))
        return;
    const fret_real tol = UNIT_TOL(5e-18L, 4e-15L);
    while (unit_row(&t)) {
        fret_material m = {.k = unit_input(&t, 6), .c0 = unit_input(&t, 7)};
        for (int b = 0; b < 2; b++)
            m.body[b] =
                (fret_body){unit_input(&t, 3 * b), unit_input(&t, 3 * b + 1), unit_input(&t, 3 * b + 2) != 0};
        fret_foundation f, g;
        CHECK_OK(fret_foundation_make(&m, &f));
        CHECK_REL(f.cN0, unit_result(&t, 8), tol);
        CHECK_REL(f.cT0, unit_result(&t, 9), tol);
        CHECK_REL(f.eta, unit_result(&t, 10), tol);
        CHECK(f.k == m.k && f.c0 == m.c0);
        for (int b = 0; b < 2; b++) {
            fret_real hN = 0, hT = 0, beta = 0;
            if (!m.body[b].rigid)
                CHECK_OK(half_space(m.k, m.body[b].nu, &hN, &hT, &beta));
            CHECK(f.hN[b] == hN && f.hT[b] == hT && f.beta[b] == beta);
        }
        /* neither body is the first */
        fret_body first = m.body[0];
        m.body[0] = m.body[1];
        m.body[1] = first;
        CHECK_OK(fret_foundation_make(&m, &g));
        CHECK_REL(g.cN0, f.cN0, tol);
        CHECK_REL(g.eta, f.eta, tol);
        CHECK(g.similar == f.similar && f.mismatch >= 0);
        CHECK_ABS(g.mismatch, f.mismatch, 1.0L, tol);
    }
}

static fret_foundation make(double E1, double nu1, double E2, double nu2, double k) {
    fret_material m = {{{E1, nu1, false}, {E2, nu2, E2 <= 0}}, k, 1e-3};
    fret_foundation f = {0};
    CHECK_OK(fret_foundation_make(&m, &f));
    return f;
}

static void similarity(void) {
    CHECK(make(210e9, 0.3, 210e9, 0.3, 0.4).similar);
    CHECK(make(210e9, 0.3, 210e9, 0.3, 0.4).mismatch == 0);
    CHECK(!make(210e9, 0.3, 210e9, 0.2, 0.4).similar);
    CHECK(!make(210e9, 0.3, 70e9, 0.3, 0.4).similar);
    CHECK(!make(210e9, 0.3, 0, 0, 0.4).similar);
    CHECK(!make(210e9, 0.3, 0, 0, 0).similar);
    /* Holl's ratio, 1/2 at k = 0 */
    for (double k = 0; k < 0.95; k += 0.1) {
        CHECK(make(210e9, 1 / (2 + k), 70e9, 1 / (2 + k), k).similar);
        CHECK(make(210e9, 1 / (2 + k), 0, 0, k).similar);
    }
    CHECK(!make(210e9, 0.45, 70e9, 0.45, 0.5).similar);
    /* k = 0: (1-2nu)/G equal on both sides */
    double E2 = 210e9 * (1 - 0.5) * 1.25 / ((1 - 0.2) * 1.1);
    CHECK(make(E2, 0.25, 210e9, 0.1, 0).similar);
    CHECK(!make(E2, 0.25, 210e9, 0.1, 0.2).similar);
    CHECK(!make(E2 * (1 + 1e-6), 0.25, 210e9, 0.1, 0).similar);
    /* Dundurs' second constant of steel on aluminium */
    fret_real G1 = 210e9L / (2 * (1 + (fret_real)0.3)), G2 = 70e9L / (2 * (1 + (fret_real)0.33));
    fret_real n1 = 0.3, n2 = 0.33;
    fret_real dundurs = ((1 - 2 * n2) / G2 - (1 - 2 * n1) / G1) / ((1 - n2) / G2 + (1 - n1) / G1) / 2;
    CHECK_REL(make(210e9, 0.3, 70e9, 0.33, 0).mismatch, fabsl(dundurs), UNIT_TOL(1e-17L, 5e-15L));
}

static void foundation_errors(void) {
    const fret_material good = {{{210e9, 0.3, false}, {70e9, 0.33, false}}, 0.2, 1e-3};
    static const char *const E_name[2] = {"E0", "E0_2"}, *const nu_name[2] = {"nu", "nu_2"};
    const double wild[] = {nan_, inf_, -inf_};
    fret_foundation f = {.cN0 = 7};
    fret_material m;
    for (int b = 0; b < 2; b++) {
        for (int i = 0; i < 3; i++) {
            m = good;
            m.body[b].E0 = wild[i];
            CHECK_ERROR(fret_foundation_make(&m, &f), FRET_NOT_FINITE, E_name[b]);
            m = good;
            m.body[b].nu = wild[i];
            CHECK_ERROR(fret_foundation_make(&m, &f), FRET_NOT_FINITE, nu_name[b]);
        }
        for (double E = 0; E >= -1; E--) {
            m = good;
            m.body[b].E0 = E;
            CHECK_ERROR(fret_foundation_make(&m, &f), FRET_NOT_POSITIVE, E_name[b]);
        }
        m = good;
        m.body[b].nu = 0.6;
        CHECK_ERROR(fret_foundation_make(&m, &f), FRET_BAD_NU, nu_name[b]);
        m.body[b].nu = -1;
        CHECK_ERROR(fret_foundation_make(&m, &f), FRET_BAD_NU, nu_name[b]);
    }
    for (int i = 0; i < 3; i++) {
        m = good;
        m.k = wild[i];
        CHECK_ERROR(fret_foundation_make(&m, &f), FRET_NOT_FINITE, "k");
        m = good;
        m.c0 = wild[i];
        CHECK_ERROR(fret_foundation_make(&m, &f), FRET_NOT_FINITE, "c0");
    }
    m = good;
    m.k = -1;
    CHECK_ERROR(fret_foundation_make(&m, &f), FRET_BAD_K, "k");
    m = good;
    m.c0 = 0;
    CHECK_ERROR(fret_foundation_make(&m, &f), FRET_NOT_POSITIVE, "c0");
    m.c0 = -1e-3;
    CHECK_ERROR(fret_foundation_make(&m, &f), FRET_NOT_POSITIVE, "c0");
    m = good;
    m.body[0].rigid = m.body[1].rigid = true;
    CHECK_CODE(fret_foundation_make(&m, &f), FRET_BOTH_RIGID);
    CHECK(f.cN0 == 7); /* untouched */
    /* the values of a rigid body are not read */
    m = good;
    m.body[1] = (fret_body){nan_, nan_, true};
    CHECK_OK(fret_foundation_make(&m, &f));
    CHECK(f.hN[1] == 0 && f.hT[1] == 0 && f.beta[1] == 0 && f.hN[0] > 0 && f.cN0 > 0 && f.eta > 0);
}

int main(int argc, char **argv) {
    unit_start("material", argc, argv);
    CASE(half_space_reference());
    CASE(half_space_identities());
    CASE(half_space_errors());
    CASE(foundation_reference());
    CASE(similarity());
    CASE(foundation_errors());
    return unit_finish();
}
