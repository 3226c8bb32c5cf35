#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""material.csv and foundation.csv: elastic coefficients of graded half-spaces."""

import random

from mpmath import mp

import oracle

mp.dps = 120

EDGE_K = [s * (1 - e) for e in (1e-3, 1e-6, 1e-9, 1e-12, 1e-15) for s in (1, -1)]
EDGE_K += [0.0, 1e-300, -1e-17, 0.5, -0.5]
EDGE_NU = [0.5, 0.25, 0.0, -1 + 1e-12, -0.999999, 0.3, -0.3, 0.49999999999999994, 0.25000000000000006, 1e-300]


def material():
    rnd = random.Random(20221)
    pairs = [(k, nu) for k in EDGE_K for nu in EDGE_NU]
    pairs += [(rnd.uniform(-0.95, 0.95), nu) for nu in EDGE_NU for _ in range(4)]
    # Holl's ratio, beta = 1 for every k
    pairs += [(k, 1 / (2 + k)) for k in (rnd.uniform(0, 0.95) for _ in range(20))]
    pairs += [(rnd.uniform(-0.95, 0.95), rnd.uniform(-0.95, 0.5)) for _ in range(180)]
    oracle.write("material.csv", "material.py", "coefficients of one graded half-space (A1)-(A3)",
                 ["k", "nu"],
                 ["hN", "hT", "beta"], [((k, nu), oracle.half_space(k, nu)) for k, nu in pairs])


def foundation():
    rnd = random.Random(20222)
    rows = []

    def add(E1, nu1, rigid1, E2, nu2, rigid2, k, c0):
        args = (E1, nu1, rigid1, E2, nu2, rigid2, k)
        rows.append((args + (c0,), oracle.foundation(*args)))

    def any_k():
        return rnd.uniform(-0.95, 0.95)

    def any_nu():
        return rnd.uniform(-0.3, 0.5)

    def any_E():
        return 10**rnd.uniform(5, 12)

    def any_c0():
        return 10**rnd.uniform(-6, -1)

    for _ in range(60):  # equal
        E, nu = any_E(), any_nu()
        add(E, nu, 0, E, nu, 0, any_k(), any_c0())
    for _ in range(60):  # different
        add(any_E(), any_nu(), 0, any_E(), any_nu(), 0, any_k(), any_c0())
    for i in range(60):  # one rigid; its values must not be read
        bodies = [(any_E(), any_nu(), 0), (0.0, 9.0, 1)]
        add(*bodies[i % 2], *bodies[1 - i % 2], any_k(), any_c0())
    for i in range(49):  # modulus ratios 1e-12 .. 1e12
        add(1e6, any_nu(), 0, 1e6 * 10**((i - 24) / 2), any_nu(), 0, any_k(), any_c0())
    for k in (0.0, 1 - 1e-9, -(1 - 1e-9), 1 - 1e-15, -(1 - 1e-15)):
        for nu1, nu2 in ((0.5, 0.5), (0.5, -0.999999), (0.25, 0.0), (-1 + 1e-12, 0.3)):
            add(210e9, nu1, 0, 70e9, nu2, 0, k, 1e-3)
    oracle.write("foundation.csv", "material.py", "foundation moduli of two bodies (4),(5)",
                 ["E1", "nu1", "rigid1", "E2", "nu2", "rigid2", "k", "c0"], ["cN0", "cT0", "eta"], rows)


material()
foundation()
