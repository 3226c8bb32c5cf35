#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""damper.csv: secant and first-harmonic stiffness, loss stiffness and loss factor, by quadrature over the cycle."""

from mpmath import mp, mpf

import oracle

mp.dps = 60
MU, FN = mpf("0.4"), mpf(100)
SHAPES = (("geometry cone slope=0.05", 1, "0.05"), ("geometry paraboloid R=10 mm", 2, "50"),
          ("geometry power n=4 A=1e6 m^-3", 4, "1e6"))
AMPLITUDES = ("0.01", "0.03", "0.1", "0.3", "0.5", "0.7", "0.9", "0.99", "1", "1.25", "2", "3")


def first(q, d):
    """F_x/(mu F_N) of first loading at delta_x = d dxmax."""
    return 1 - (1 - min(d, 1))**(1 / q)


def harmonics(q, d):
    """K', K'' over mu F_N/dxmax. On the branch downwards, delta_x = d cos(theta): Masing."""
    FA = first(q, d)

    def force(theta):
        return FA - 2 * first(q, d * mp.sin(theta / 2)**2)
    cuts = [mpf(0), mp.pi / 2, mp.pi]
    if d > 1:
        cuts.append(2 * mp.asin(mp.sqrt(1 / d)))  # where gross slip begins
    cuts = sorted(set(cuts))
    Kp = 2 / (mp.pi * d) * mp.quad(lambda th: force(th) * mp.cos(th), cuts)
    Kpp = 2 / (mp.pi * d) * mp.quad(lambda th: -force(th) * mp.sin(th), cuts)
    # the same Kpp from dW (27) and the flats
    loss = oracle.share(q, FA) + 4 * max(d - 1, 0)
    assert abs(loss / (mp.pi * d**2) / Kpp - 1) < mpf(10)**-32, (q, d)
    return Kp, Kpp, FA


def series(q, d):
    """K' over mu F_N/dxmax for d < 1: (1-z)^(1/q) term by term, means of sin^2j times cos (check)."""
    e, total, term, j = 1 / q, mpf(0), mpf(1), 0
    while True:
        # int_0^pi sin(th/2)^(2j) cos(th) dth = mean of x^j (1-2x), x = sin^2
        wallis = mp.beta(j + mpf(1) / 2, mpf(1) / 2)
        piece = term * wallis * (1 - 2 * (j + mpf(1) / 2) / (j + 1))
        total += piece
        if j > 5 and abs(piece) < mpf(10)**-45:
            break
        term *= (j - e) / (j + 1) * d
        j += 1
        if term == 0:
            break
    return 4 / (mp.pi * d) * total


rows = []
for geometry, n, A in SHAPES:
    for k in ("-0.5", "0", "0.5"):
        s = oracle.equal_bodies("210e9", "0.3", k, "1e-3", n, A, MU)
        q = 1 / s.p
        dxmax = MU * s.eta * s.depth(FN)
        for d in AMPLITUDES:
            Kp, Kpp, FA = harmonics(q, mpf(d))
            if mpf(d) < mpf("0.8"):
                assert abs(series(q, mpf(d)) / Kp - 1) < mpf(10)**-32, (n, k, d)
            unit = MU * FN / dxmax
            rows.append((f"{oracle.material(k)}; {geometry}; friction 0.4; press FN=100 N", d, mpf(d) * dxmax,
                         FA * MU * FN if mpf(d) < 1 else None, FA / mpf(d) * unit, Kp * unit, Kpp * unit, Kpp / Kp))
oracle.write_cells("damper.csv", "damper.py",
                   ["damper outputs at the displacement amplitude dxA, delta_x = dxA cos(theta), SI units; FA is the",
                    "amplitude of F_x, empty from gross slip on; Ksec = amplitude of F_x over dxA"],
                   ["setup", "dxA/dxmax", "dxA", "FA", "Ksec", "Kp", "Kpp", "loss_factor"], rows)
