#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""field.csv: pressure and surface displacement; of power laws by hypergeometric functions, of gaps with a flat
end by quadrature."""

from mpmath import mp, mpf

import oracle
import shape
from flat import Flat

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


def sphere(R, k, a, r):
    """p and w within the contact of an exact sphere; x^2 = r^2 + D e^-t, of which h(t) - h(inf) goes fast."""
    k, R, a, r = mpf(k), mpf(R), mpf(a), mpf(r)
    m, D = (k + 1) / 2, a**2 - r**2

    def g(x):
        return x**2 / (2 * R * m) * mp.hyp2f1(0.5, 1, m + 1, (x / R)**2)

    def rate(x):  # g'/x
        return (mp.hyp2f1(0.5, 1, m + 1, (x / R)**2) + (x / R)**2 / (2 * (m + 1)) * mp.hyp2f1(1.5, 2, m + 2, (x / R)**2)) / (R * m)
    rest = mp.quad(lambda t: mp.exp(-m * t) * (rate(mp.sqrt(r**2 + D * mp.exp(-t))) - rate(r)), [0, 1, 4, 10, 20, 45, 90])
    p = oracle.foundation(*BODIES, k)[0] * mpf(C0)**-k / mp.pi * D**m / 2 * (rate(r) / m + rest)
    return [p, g(a) - r**2 / (R + mp.sqrt(R**2 - r**2))]


rows = []
for k in (-0.99, -0.5, 0.6):
    for r in (0.0, 1e-9, 5e-3, 8.99e-3):
        with mp.workdps(40):
            rows.append(((shape.SPHERE, 0.0, 0.01, 0.0, 1.0, k, 9e-3, r), sphere(0.01, k, 9e-3, r)))
for kind in (shape.CONE, shape.PARABOLOID, shape.ROUNDED):
    for k in (-0.99, -0.9, -0.3, 0.7):
        cN0 = oracle.foundation(*BODIES, k)[0]
        b, R, slope, a = 1e-3, 0.01, 0.05, 1.6e-3
        flat, e1 = Flat((kind, b, R, slope, 1, 0, 1, 0, 1, 0), k), mpf(a) - mpf(b)
        rim = [b] if kind == shape.ROUNDED else []  # the others: sharp.csv
        for r in [0.0, 0.5e-3, 0.99e-3, *rim, 1.01e-3, 1.3e-3, 1.59e-3, 1.7e-3]:
            with mp.workdps(40):
                rows.append(((kind, b, R, slope, 1.0, k, a, r), [
                    cN0 * mpf(C0)**-flat.k / mp.pi * flat.pressure(e1, mpf(r)) if r < a else mpf(0),
                    flat.g(e1) - flat.f(mpf(r)) if r < a else flat.surface(e1, mpf(r))]))
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
            rows.append(((0, 0.0, 0.0, 0.0, n, k, A, r), [
                inside(scene, a, mpf(r)) if within else mpf(0),
                scene.g(a) - mpf(H) * (mpf(r) / mpf(R0))**n if within else outside(scene, a, mpf(r))]))
oracle.write("field.csv", "field.py", "fields of f = h (r/r0)^n, kind 0, and of flat ends",
             ["kind", "b", "R", "slope", "n", "k", "a", "r"], ["p", "w"], rows)


def ring(rate, inner, outer, power):
    """What a ring presses where each contact is singular: linear in the logarithm of the distance e from that. rate:
    g' times the kernel; inner 0: the whole contact, rate goes as e^(power-1) to 1e-40 of its width."""
    low = inner or outer * mpf(10)**-40
    ends, last = [mp.log(low)], mp.log(outer)
    while ends[-1] + 1 < last:
        ends.append(ends[-1] + 1)
    with mp.workdps(40):
        sums = mp.quad(lambda t: rate(mp.exp(t)) * mp.exp(t), ends + [last])
    return sums + (0 if inner else rate(low) * low / power)


rows = []
for kind in (shape.CONE, shape.PARABOLOID):
    for k in (-0.9, -0.3, 0.0, 0.02, 0.3, 0.9):
        for inner in (0.0, 1.000001e-3, 1.2e-3, 1.5999e-3):
            b, R, slope, a = 1e-3, 0.01, 0.05, 1.6e-3
            for r in (b, 0.999999999999e-3, 1.00000001e-3):
                if inner == 0 and (k <= 0 or r != b):
                    continue  # infinite, or not a case of this
                flat = Flat((kind, b, R, slope, 1, 0, 1, 0, 1, 0), k)
                off = mpf(b) - mpf(r)
                p = ring(lambda e: flat.steepness(e) * ((off + e) * (flat.b + e + mpf(r)))**(flat.m - 1),
                         mpf(inner) - mpf(b) if inner else 0, mpf(a) - mpf(b), flat.k)
                rows.append(((kind, b, R, slope, 1.0, k, inner, a, r), [
                    oracle.foundation(*BODIES, k)[0] * mpf(C0)**-flat.k / mp.pi * p]))
for n, k in ((0.5, 0.3), (0.5, 0.5), (1.0, 0.0), (1.0, -0.7), (1.0, -1e-9), (1.5, -0.9)):
    for inner in (1e-9, 3e-4, 0.9999e-3):
        scene = oracle.Scene(*BODIES, k, C0, n, H, R0, MU)
        p = ring(lambda x: scene.n * scene.g(x) * x**(scene.k - 2), mpf(inner), mpf(A), 0)
        rows.append(((0, 0.0, 0.0, 0.0, n, k, inner, A, 0.0), [scene.cN0 * scene.c0**-scene.k / mp.pi * p]))
oracle.write("sharp.csv", "field.py", "pressures at sharp edges, next to them and at tips, of contacts and of rings",
             ["kind", "b", "R", "slope", "n", "k", "inner", "a", "r"], ["p"], rows)
