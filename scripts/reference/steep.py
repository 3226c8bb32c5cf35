#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""steep.csv: fields of power laws of large exponent, where only the last part a/n of the contact counts. By
quadrature of the definitions over the radius, in pieces that grow away from the edge."""

from mpmath import mp, mpf

import oracle

mp.dps = 60
BODIES = (210e9, 0.3, 0, 70e9, 0.35, 0)
C0, H, R0, MU, A, FN, FX = 1e-3, 1e-5, 1e-3, 0.4, 1e-3, 100.0, 12.0
NEAR = [mpf(4)**j for j in range(-3, 5)]  # distances from the edge, in units of its scales


def pieces(lo, scales, to_v):
    """0 .. 1 cut at radii near the edge, in the variable of the integral."""
    places = {1 - scale * near for scale in scales for near in NEAR}
    return [0, *sorted(to_v(x) for x in places if lo < x < 1), 1]


def pressure(scene, a, r):
    """x^2 = r^2 + (a^2-r^2) v^(1/m), radii in units of a."""
    n, k, m, s = scene.n, scene.k, (scene.k + 1) / 2, r / a
    z = (1 - s) * (1 + s)
    scale = scene.cN0 * scene.c0**-k / mp.pi * n * scene.g(a) * a**(k - 1)
    if r == 0:
        return scale / (n + k - 1)
    cuts = pieces(s, [1 / n, 1 - s], lambda x: ((x - s) * (x + s) / z)**m)
    return scale * z**m / (2 * m) * mp.quad(lambda v: mp.exp((n / 2 - 1) * mp.log1p(-z * (1 - v**(1 / m)))), cuts)


def surface(scene, a, r):
    """x = a v^(1/(2m))."""
    n, m, d = scene.n, (scene.k + 1) / 2, scene.g(a)
    if r <= a:
        return d - mpf(H) * (r / mpf(R0))**n
    q = (a / r)**2
    cuts = pieces(0, [1 / n, r / a - 1], lambda x: x**(2 * m))
    return (2 * mp.cos(mp.pi * scene.k / 2) / mp.pi * d * q**m / (2 * m) *
            mp.quad(lambda v: (1 - v**(n / (2 * m))) * (1 - q * v**(1 / m))**-m, cuts))


def check(scene, a, r, p, w):
    """Another way to the same: hypergeometric functions."""
    n, k, m = scene.n, scene.k, (scene.k + 1) / 2
    if 0 < r < a:
        z = (a - r) * (a + r) / a**2
        want = (scene.cN0 * scene.c0**-k / mp.pi * n * scene.g(a) * a**(k - 1) * z**m / (2 * m) *
                mp.hyp2f1(m, m + n / 2, m + 1, z) * (1 - z)**(n / 2 - 1 + m))  # by Euler's transformation
        assert abs(p / want - 1) < mpf(10)**-25, (n, k, r, p / want - 1)
    if r > a:
        q = (a / r)**2
        both = mp.hyp2f1(m, m, m + 1, q) / (2 * m) - mp.hyp2f1(m, m + n / 2, m + n / 2 + 1, q) / (2 * m + n)
        want = 2 * mp.cos(mp.pi * k / 2) / mp.pi * scene.g(a) * q**m * both
        assert abs(w / want - 1) < mpf(10)**-25, (n, k, r, w / want - 1)


rows = []
for n in (19.0, 21.0, 100.0, 1e3, 3e3, 1e4, 1e5, 1e6):
    for k in (-0.7, 0.0, 0.5):
        scene, a = oracle.Scene(*BODIES, k, C0, n, H, R0, MU), mpf(A)
        for part in (0, 1e-3, 0.2, 0.7, 0.72, 0.9, 0.99, 1 - 10 / n, 1 - 1 / n, 1 - 0.01 / n, 1 - 1e-9,
                     1 + 1e-6, 1 + 1 / n, 1.01, 2, 100):
            r = part * A
            p = pressure(scene, a, mpf(r)) if r < A else mpf(0)
            w = surface(scene, a, mpf(r))
            if n <= 1e4:
                check(scene, a, mpf(r), p, w)
            rows.append(((0, n, k, A, 0.0, r), [p, w]))
        a = scene.radius_of_force(mpf(FN))
        c = scene.radius_of_force(mpf(FN) - mpf(FX) / scene.mu)
        for part in (0, 0.3, 0.9, 0.999, 1.01, 3):
            r = mpf(float(part * a))
            inner = pressure(scene, c, r) if r < c else 0
            rows.append(((1, n, k, FN, FX, float(r)), [
                scene.mu * ((pressure(scene, a, r) if r < a else 0) - inner),
                scene.mu * scene.eta * (surface(scene, a, r) - surface(scene, c, r))]))
oracle.write("steep.csv", "steep.py",
             "fields of f = h (r/r0)^n; kind 0: p, w at contact radius `load`; 1: q, u at FN = `load` and Fx",
             ["kind", "n", "k", "load", "Fx", "r"], ["p", "w"], rows)
