#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""loss.csv: w(t), the energy dissipated per cycle over mu F_N delta_x,max."""

import random

from mpmath import mp, mpf

import oracle

mp.dps = 280  # b ~ t^3, t >= 1e-60, and r = 1-q may be 1e-18


def w(n, k, t):
    q = mpf(n) / (mpf(n) + mpf(k) + 1)
    return oracle.share(q, mpf(t))


def check(n, k, t):
    """w = 8 int_c^1 x^k (1-x^n)(x^n-c^n) dx over (int_0^1 2 x^k (1-x^n) dx), F_N = cN0 = eta = 1."""
    n, k, t = mpf(n), mpf(k), mpf(t)
    with mp.workdps(40):
        e, c = k + 1, (1 - t)**(1 / (n + k + 1))
        top = mp.quad(lambda v: (1 - v**(n / e)) * (v**(n / e) - c**n), mp.linspace(c**e, 1, 3))
        got = 8 * top / (2 * mp.quad(lambda v: 1 - v**(n / e), [0, 1]))
    want = w(n, k, t)
    assert abs(got / want - 1) < mpf(10)**-20, (n, k, t, mp.nstr(got / want - 1, 5))


rnd = random.Random(20224)
ts = [1e-60, 1e-30, 1e-15, 1e-8, 1e-5, 1e-3, 0.1, 0.3, 0.5, 0.7, 0.9, 0.969802616577681,
      0.9698026165776816, 0.999,
      1 - 1e-6, 1 - 1e-9, 1 - 1e-12, 1 - 1e-15]
rows = [(n, k, t) for n, k in ((2.0, 0.0), (1e-6, 0.3), (1e6, -0.3), (1e3, -0.9), (1e-3, 0.9), (1.0, 0.0),
                               (0.5, -0.5))
        for t in ts]
# q = 1/2 and its neighbours, k -> -1
rows += [(n, k, t) for n, k in ((1.25, 0.25), (1.2499999999999998, 0.25), (1.2500000000000002, 0.25),
                                (1.0, -0.999999999999), (2.0, 0.999999999999)) for t in ts[::2]]
rows += [(10**rnd.uniform(-3, 3), rnd.uniform(-0.95, 0.95), rnd.choice([10**rnd.uniform(-8, 0), rnd.random(),
                                                                     1 - 10**rnd.uniform(-15, -1)]))
         for _ in range(150)]
for i in range(126 + 45, len(rows), 6):
    if 0.01 < rows[i][0] < 100 and 1e-6 < rows[i][2]:
        check(*rows[i])
oracle.write("loss.csv", "loss.py", "w(t) = 8 b(t)/(1+q), q = n/(n+k+1) (27)", ["n", "k", "t"], ["w"],
             [(row, [w(*row)]) for row in rows])
