#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""field.csv: pressure and surface displacement of power laws, by hypergeometric functions."""

from mpmath import mp, mpf

import oracle

mp.dps = 60
BODIES = (210e9, 0.3, 0, 70e9, 0.35, 0)
C0, H, R0, MU, A = 1e-3, 1e-5, 1e-3, 0.4, 1e-3


def inside(scene, a, r):
    """p: the integral over x from r to a in 1-z s, z = 1-(r/a)^2, where x^2 = a^2 (1-z s)."""
    n, k, m = scene.n, scene.k, (scene.k + 1) / 2
    z = (a - r) * (a + r) / a**2
    return (scene.cN0 * scene.c0**-k / mp.pi * n * scene.g(a) * a**(k - 1) * z**m / (2 * m) *
            mp.hyp2f1(1 - n / 2, 1, m + 1, z))


def outside(scene, a, r):
    """w for r > a: both terms of delta_z-g(x), x^2 = a^2 s."""
    n, m, q = scene.n, (scene.k + 1) / 2, (a / r)**2
    both = mp.hyp2f1(m, m, m + 1, q) / (2 * m) - mp.hyp2f1(m, m + n / 2, m + n / 2 + 1, q) / (2 * m + n)
    return 2 * mp.cos(mp.pi * scene.k / 2) / mp.pi * scene.g(a) * q**m * both


def check(scene, a, r):
    """The definitions, by quadrature; mp.quad stops at an absolute error, hence the scales."""
    n, k, m, d = scene.n, scene.k, (scene.k + 1) / 2, scene.g(a)
    with mp.workdps(40):
        if 0 < r < a:
            def p(v):  # x^2 = r^2 + (a^2-r^2) v^(1/m)
                return mp.sqrt((r / a)**2 + (1 - (r / a)**2) * v**(1 / m))**(n - 2)
            want = (scene.cN0 * scene.c0**-k / mp.pi * n * d / a**2 * (a * a - r * r)**m / (2 * m) *
                    mp.quad(p, [0, mpf(1) / 8, mpf(1) / 2, 1]))
            assert abs(inside(scene, a, r) / want - 1) < mpf(10)**-15, (n, k, r)
        if r > a:
            def w(v):  # x = a v^(1/(2m))
                return (1 - v**(n / (2 * m))) * (1 - (a / r)**2 * v**(1 / m))**-m
            want = 2 * mp.cos(mp.pi * k / 2) / mp.pi * d * (a / r)**(2 * m) / (2 * m) * mp.quad(w, [0, 0.5, 1])
            assert abs(outside(scene, a, r) / want - 1) < mpf(10)**-15, (n, k, r)


rows = []
for n in (0.5, 1.0, 2.0, 4.0, 10.0):
    for k in (-0.9, -0.7, -0.3, 0.0, 0.3, 0.7, 0.9):
        scene = oracle.Scene(*BODIES, k, C0, n, H, R0, MU)
        for part in (0, 1e-6, 0.1, 0.5, 0.9, 1 - 1e-9, 1.0001, 2, 100):
            r, a = part * A, mpf(A)
            if part == 0 and n + k <= 1:
                continue  # infinite
            if part in (0.5, 0.9, 2, 100):
                check(scene, a, mpf(r))
            within = r < A
            rows.append(((n, k, A, r), [
                inside(scene, a, mpf(r)) if within else mpf(0),
                scene.g(a) - mpf(H) * (mpf(r) / mpf(R0))**n if within else outside(scene, a, mpf(r))]))
oracle.write("field.csv", "field.py", "fields of f = h (r/r0)^n", ["n", "k", "a", "r"], ["p", "w"], rows)
