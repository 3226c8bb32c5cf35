#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""pressure.csv: the radial part of the pressure of a power, by the hypergeometric function; checked by quadrature
of the definition."""

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
