#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""slice.csv: integrals of a power law F = y^p over the slice of depths [1-x, 1]."""

import random

from mpmath import mp, mpf

import oracle

mp.dps = 160  # L ~ x^3, x >= 1e-30


def moments(n, k, x):
    p, x = (mpf(n) + mpf(k) + 1) / mpf(n), mpf(x)
    y = 1 - x
    w = 1 - y**p
    J = w - p * (1 - y**(p + 1)) / (p + 1)  # int t K dt, t = 1-y
    G = w - x * p * y**(p - 1)
    # int_0^x [w(t) - t K(1-t)] dt
    L = x - (1 - y**(p + 1)) / (p + 1) - J
    return [w, J, G, L]


def check(n, k, x):
    p, x = (mpf(n) + mpf(k) + 1) / mpf(n), mpf(x)

    def K(t):
        return p * (1 - t)**(p - 1)

    def G(t):
        return 1 - (1 - t)**p - t * K(t)
    want = moments(n, k, x)
    with mp.workdps(40):
        got = [mp.quad(K, [0, x]), mp.quad(lambda t: t * K(t), [0, x]), G(x), mp.quad(G, [0, x])]
    for a, b in zip(got, want):
        assert abs(a / b - 1) < mpf(10)**-20, (n, k, x, a, b)


rnd = random.Random(20228)
xs = [1e-30, 1e-12, 1e-6, 1e-3, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1 - 1e-9]
rows = [(n, k, x) for n, k in ((2.0, 0.0), (1.0, 0.0), (0.5, 0.0), (3.0, -0.9), (0.4, 0.95), (50.0, -0.95),
                               (1.0, 0.5),
                               (0.01, 0.9), (0.001, 0.0), (1e3, 0.0)) for x in xs]
rows += [(10**rnd.uniform(-0.4, 0.8), rnd.uniform(-0.95, 0.95),
          rnd.choice([10**rnd.uniform(-9, 0), rnd.random(),
                      1 - 10**rnd.uniform(-9, -1)])) for _ in range(180)]
for row in rows[120::9]:
    check(*row)
rows += [(n, 0.0, x) for n in (0.25, 0.2, 0.125) for x in xs + [0.005, 0.02, 0.03]]  # whole p: series that end
oracle.write("slice.csv", "slice.py", "integrals over a slice of F = y^p, p = (n+k+1)/n, from y = 1 to 1-x",
             ["n", "k", "x"], ["w", "J", "G", "L"], [(row, moments(*row)) for row in rows])
