#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""rim.csv: pressure next to a flat end."""

from mpmath import mp, mpf

import oracle
import shape
from flat import Flat

mp.dps = 40
BODIES = (210e9, 0.3, 0, 70e9, 0.35, 0)
C0 = 1e-3

rows = []
for kind in (shape.CONE, shape.PARABOLOID, shape.ROUNDED):
    for k in (-0.99, -0.4, 0.0, 0.5, 0.99):
        cN0 = oracle.foundation(*BODIES, k)[0]
        b, R, slope, a = 2.0**-10, 0.01, 0.05, 1.6e-3
        flat, e1 = Flat((kind, b, R, slope, 1, 0, 1, 0, 1, 0), k), mpf(a) - mpf(b)
        for r in (b * (1 - 2.0**-12), b * (1 - 2.0**-45), b * (1 + 2.0**-45), b * (1 + 2.0**-12)):
            if r in (b * (1 - 2.0**-12), b * (1 + 2.0**-12)) and k == 0.0:
                assert abs(flat.pressure(e1, mpf(r)) / flat.pressure_at_rim(e1, mpf(r)) - 1) < mpf(10)**-15, (kind, k, r)
            rows.append(((kind, b, R, slope, k, a, r), [cN0 * mpf(C0)**-flat.k / mp.pi * flat.pressure_at_rim(e1, mpf(r))]))
oracle.write("rim.csv", "rim.py", "pressure next to a flat end", ["kind", "b", "R", "slope", "k", "a", "r"], ["p"], rows)
