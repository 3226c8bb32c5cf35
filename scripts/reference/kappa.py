#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""kappa.csv: the shape factor of a power-law gap."""

import random

from mpmath import mp, mpf

import oracle

mp.dps = 60


def check():
    """The definition (3), g(1) = int_0^1 f'(r) (1-r^2)^((k-1)/2) dr, with the end point taken out."""
    for n, k in ((1, 0), (2, 0.5), (0.5, -0.5), (3.25, 0.75), (2, -0.75)):
        n, k = mpf(n), mpf(k)
        e = (k + 1) / 2  # v = (1-r^2)^e, r dr = -v^(1/e-1) dv/(2e)
        got = mp.quad(lambda v: n * (1 - v**(1 / e))**((n - 2) / 2), [0, mpf(1) / 2, 1]) / (2 * e)
        assert abs(got / oracle.kappa(n, k) - 1) < mpf(10)**-15, (n, k, got)


rnd = random.Random(20223)
rows = [(n, k) for n in (1e-6, 1e-3, 0.4, 1.0, 2.0, 3.0, 4.0, 38.0, 39.999, 40.0, 41.0, 340.0, 341.5,
                         1e3, 2e3, 1e4, 1e6)
        for k in (0.0, 0.5, -0.5, 0.95, -0.95, 1 - 1e-9, -(1 - 1e-9), 1 - 1e-15, -(1 - 1e-15))]
rows += [(10**rnd.uniform(-6, 6), rnd.uniform(-0.95, 0.95)) for _ in range(120)]
rows += [(rnd.uniform(0.4, 50), rnd.uniform(-0.95, 0.95)) for _ in range(80)]
check()
oracle.write("kappa.csv", "kappa.py", "kappa = (n/2) B(n/2,(k+1)/2) (6)-(8)", ["n", "k"], ["kappa"],
             [(row, [oracle.kappa(*row)]) for row in rows])
