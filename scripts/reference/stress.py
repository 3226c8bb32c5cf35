#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""stress.csv: stresses inside by point loads (Boussinesq, Cerruti) summed over pressure and traction."""

from mpmath import mp, mpf

import oracle

mp.dps = 25
BODIES = (210e9, 0.3, 0, 70e9, 0.35, 0)
C0, H, R0, MU = 1e-3, 1e-5, 1e-3, 0.4
TURNS = 100  # even steps of the angle, which converge exponentially


def pressed(n, a, r):
    """p(r) of f = H (r/R0)^n, n = 1 or 2, per c_N/pi."""
    if r >= a:
        return mpf(0)
    return 4 * mpf(H) / mpf(R0)**2 * mp.sqrt((a - r) * (a + r)) if n == 2 else \
        mp.pi / 2 * mpf(H) / R0 * mp.acosh(a / r)


def points(x, y, z, nu):
    """Stresses of a unit force along z, and of one along x, at the origin (Johnson, Contact Mechanics, 3.19, 3.75)."""
    R, r2, m = mp.sqrt(x * x + y * y + z * z), x * x + y * y, 1 - 2 * nu
    t, u, v = 1 - z / R, R + z, 1 / (2 * mp.pi)
    down = (m / r2 * (t * (x * x - y * y) / r2 + z * y * y / R**3) - 3 * z * x * x / R**5,
            m / r2 * (t * (y * y - x * x) / r2 + z * x * x / R**3) - 3 * z * y * y / R**5, -3 * z**3 / R**5,
            m / r2 * (2 * t * x * y / r2 - x * y * z / R**3) - 3 * x * y * z / R**5, -3 * x * z * z / R**5,
            -3 * y * z * z / R**5)
    side = (-3 * x**3 / R**5 + m * (x / R**3 - 3 * x / (R * u**2) + x**3 / (R**3 * u**2) + 2 * x**3 / (R**2 * u**3)),
            -3 * x * y * y / R**5 + m * (x / R**3 - x / (R * u**2) + x * y * y / (R**3 * u**2) +
                                         2 * x * y * y / (R**2 * u**3)), -3 * x * z * z / R**5,
            -3 * x * x * y / R**5 + m * (-y / (R * u**2) + x * x * y / (R**3 * u**2) + 2 * x * x * y / (R**2 * u**3)),
            -3 * x * x * z / R**5, -3 * x * y * z / R**5)
    return [v * s for s in down], [v * s for s in side]


def stresses(n, FN, F1, F2, nu, at):
    cN0 = oracle.foundation(*BODIES, 0.0)[0]
    kappa = mpf(n) / 2 * mp.beta(mpf(n) / 2, mpf(1) / 2)
    unit = 2 * cN0 * kappa * mpf(H) / mpf(R0)**n * n / (n + 1)
    radius = lambda F: mp.root(F / unit, n + 1)
    a, c1, c2 = radius(mpf(FN)), radius(FN - mpf(F1) / MU), radius(FN - (mpf(F1) - mpf(F2)) / (2 * mpf(MU)))
    x, y, z = map(mpf, at)
    total = [mpf(0)] * 6

    def ring(r):
        p = pressed(n, a, r) * cN0 / mp.pi
        q = mpf(MU) * cN0 / mp.pi * (-pressed(n, a, r) + 2 * pressed(n, c2, r) - pressed(n, c1, r))
        sums = [mpf(0)] * 6
        for i in range(TURNS):
            angle = 2 * mp.pi * (i + mpf(1) / 3) / TURNS
            down, side = points(x - r * mp.cos(angle), y - r * mp.sin(angle), z, mpf(nu))
            sums = [s + p * d + q * e for s, d, e in zip(sums, down, side)]
        return [s * 2 * mp.pi / TURNS * r for s in sums]

    half = mp.pi / 2
    for lo, hi in ((0, c1), (c1, c2), (c2, a)):  # tanh-sinh by hand: six sums at once
        for i in range(-78, 79):
            u = mpf(i) / 24
            e = mp.exp(-2 * half * mp.sinh(abs(u)))
            near = (hi - lo) * e / (1 + e)
            r = lo + near if i < 0 else hi - near
            weight = (hi - lo) * half * mp.cosh(u) * 2 * e / (1 + e)**2 / 24
            if lo < r < hi:
                total = [t + weight * s for t, s in zip(total, ring(r))]
    return total


rows = []
for n, nu, at in ((2, 0.3, (0.0, 0.0, 2e-4)), (2, 0.3, (1.5e-4, 4e-5, 1e-4)), (2, 0.0, (-3e-4, 1e-4, 1.2e-4)),
                  (1, 0.35, (5e-5, -8e-5, 1.5e-4)), (1, 0.5, (2e-4, 2e-4, 1e-4))):
    rows.append(((float(n), 100.0, 25.0, -5.0, nu) + at, stresses(n, 100.0, 25.0, -5.0, nu, at)))
oracle.write("stress.csv", "stress.py", "stress by point loads; F_x from 0 to F1, then to F2",
             ["n", "FN", "F1", "F2", "nu", "x", "y", "z"], ["xx", "yy", "zz", "xy", "xz", "yz"], rows)
