#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""pressure.csv: the radial part of the pressure of a power, by the hypergeometric function; checked by quadrature
of the definition. peak.csv: where that is largest, and how large, of the mean pressure."""

from mpmath import mp, mpf

import oracle

mp.dps = 60


def shape(n, k, r):
    """int_r^1 x^(n-1) (x^2-r^2)^((k-1)/2) dx"""
    m, w = (k + 1) / 2, (1 - r) * (1 + r)
    return w**m / (2 * m) * mp.hyp2f1(1 - n / 2, 1, m + 1, w)


rows = []
for n in (0.01, 0.5, 1.0, 1.7, 2.0, 3.0, 4.0, 8.5, 19.9):
    for k in (-0.99, -0.5, 0.0, 0.3, 0.99):
        for r in (1e-9, 1e-4, 0.01, 0.1, 0.3, 0.5, 0.547, 0.548, 0.6, 0.8, 0.95, 0.999, 1 - 1e-9):
            value = shape(mpf(n), mpf(k), mpf(r))
            if k == 0.3 and 0.1 <= r <= 0.95:
                direct = mp.quad(lambda x: x**(mpf(n) - 1) * (x * x - mpf(r)**2)**((mpf(k) - 1) / 2),
                                 [mpf(r), (mpf(r) * 3 + 1) / 4, 1])
                assert abs(direct / value - 1) < mpf(10)**-20, (n, k, r)
            rows.append(((n, k, r), [value]))
oracle.write("pressure.csv", "pressure.py",
             "int_r^1 x^(n-1) (x^2-r^2)^((k-1)/2) dx", ["n", "k", "r"], ["integral"], rows)


def peak(n, k):
    """r/a and p_0/p_mean; 2 int_0^1 r shape dr = 2/((k+1) (n+k+1))"""
    grid = [mpf(i) / 64 for i in range(64)] + [1 - mpf(2)**-i for i in range(7, 24)]
    values = [shape(n, k, r) for r in grid]
    i = values.index(max(values))
    r = mpf(0)
    if i > 0:
        lo, hi = grid[i - 1], grid[min(i + 1, len(grid) - 1)]
        for _ in range(120):  # thirds
            a, b = lo + (hi - lo) / 3, hi - (hi - lo) / 3
            lo, hi = (a, hi) if shape(n, k, a) < shape(n, k, b) else (lo, b)
        r = (lo + hi) / 2
    return r, shape(n, k, r) * (k + 1) * (n + k + 1) / 2


rows = []
for n, k in ((1.0, 0.3), (1.5, 0.0), (2.0, -0.5), (2.0, 0.0), (2.0, 0.5), (3.0, -0.5), (3.0, 0.3), (4.0, 0.0), (8.5, -0.7),
             (19.9, 0.0), (60.0, 0.3)):
    rows.append(((n, k), list(peak(mpf(n), mpf(k)))))
oracle.write("peak.csv", "pressure.py", "where the pressure of r^n is largest, and that over the mean pressure",
             ["n", "k"], ["r/a", "p0/pmean"], rows)
