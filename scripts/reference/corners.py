#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""corners.csv: whole contacts at the corners of the domain. Every pair of corner values of two inputs occurs in
at least PASSES scenes; random ones follow."""

import itertools
import random

from mpmath import mp, mpf

import oracle

mp.dps = 140  # 1-|k| and s are 1e-15, powers 1e6

PASSES, RANDOM = 4, 400
LEAST, MOST = 1e-300, 1e300  # inputs and what does not vanish with t

FRACTIONS = [1e-300, 1e-30, 1e-8, 1e-3, 0.5, 0.9, 1 - 1e-9, 1 - 1e-15]
NU = [-1 + 1e-15, -0.999999, 0.0, 0.25, 0.3, 0.5 - 1e-15, 0.5]
AXES = {
    "k": [s * (1 - e) for e in (1e-15, 1e-9, 1e-3, 0.5) for s in (1, -1)] + [0.0, 1e-300, -1e-17],
    "nu": NU,
    "nu2": NU,
    "E2": ["equal", "rigid", 1e12, 1e-12],  # over E0
    "n": [1e-6, 1e-3, 0.5, 1.0, 2.0, 50.0, 1e3, 1e6],
    "t": FRACTIONS,
    "x": FRACTIONS + [1 + 1e-15, 2.0, 1e6],
    "E0": [1.0, 1e9, 1e15],
    "r0": [1e-12, 1e-2, 1e6],
    "h": [1e-12, 1e-6, 1e6],
    "c0": [1e-12, 1e-3, 1e6],
    "a": [-1, 0, 1],  # smaller than r0, about r0, larger
}


def covering(rnd):
    """Scenes that have every pair of values of two axes; the best of some random ones first."""
    names = list(AXES)
    left = {((a, x), (b, y)) for a, b in itertools.combinations(names, 2) for x in AXES[a] for y in AXES[b]}
    while left:
        fixed = dict(rnd.choice(sorted(left, key=repr)))
        best, most = None, set()
        for _ in range(30):
            one = {name: fixed.get(name, rnd.choice(AXES[name])) for name in names}
            new = left.intersection(itertools.combinations(one.items(), 2))
            if best is None or len(new) > len(most):
                best, most = one, new
        left -= most
        yield best, rnd.uniform(0.05, 1.2)


def anywhere(rnd):
    def near(depth):
        return 10**rnd.uniform(-depth, 0)

    def fraction():
        return rnd.choice([near(300), near(8), rnd.random(), 1 - near(15)])

    def nu():
        return rnd.choice([rnd.uniform(-1, 0.5), -1 + near(15), 0.5 - 0.5 * near(15)])

    one = {
        "k": rnd.choice([rnd.uniform(-1, 1), rnd.choice([-1, 1]) * (1 - near(15))]),
        "nu": nu(), "nu2": nu(), "E2": rnd.choice(["equal", "rigid", 10**rnd.uniform(-12, 12)]),
        "n": 10**rnd.uniform(-6, 6), "t": fraction(), "x": rnd.choice([fraction(), fraction(), 1 + near(15)]),
        "E0": 10**rnd.uniform(0, 15), "a": rnd.uniform(-1, 1),
    }
    for size in ("r0", "h", "c0"):
        one[size] = 10**rnd.uniform(-12, 6)
    return one, rnd.uniform(0.05, 1.2)


def digits_for(fraction):
    """Working digits for 1-(1-t)^m and b(t) as printed: t^3 and 1-q are lost."""
    return mp.dps + 60 + int(-3 * min(0, mp.log10(fraction)))


def solve(one, mu):
    E0, k, n, r0 = one["E0"], one["k"], one["n"], one["r0"]
    second = {"equal": (E0, one["nu"], 0), "rigid": (1.0, 0.0, 1)}.get(one["E2"])
    if second is None:
        second = (E0 * one["E2"], one["nu2"], 0)
    scene = oracle.Scene(E0, one["nu"], 0, *second, k, one["c0"], n, one["h"], r0, mu)
    a = float(mpf(r0) * mpf(10)**(one["a"] * min(3, 30 / scene.s)))
    F = float(scene.fA * mpf(a)**scene.s)
    depth = float(scene.g(mpf(a)))
    Fx = max(LEAST, float(mpf(one["t"]) * mpf(mu) * mpf(F)))

    a_F = scene.radius_of_force(mpf(F))
    dz_F = scene.g(a_F)
    dxmax = mpf(mu) * scene.eta * dz_F
    dx = max(LEAST, float(one["x"] * dxmax))
    stiff = 2 * scene.cN0 * scene.c0**-scene.k / (scene.k + 1)
    a_dz = (mpf(depth) / scene.gA)**(1 / scene.n)
    results = [*oracle.half_space(k, one["nu"]),
               *([mpf(0)] * 3 if second[2] else oracle.half_space(k, second[1])),
               scene.cN0, scene.cT0, scene.eta, oracle.kappa(n, k),
               a_F, dz_F, stiff * a_F**(scene.k + 1),
               a_dz, scene.fA * a_dz**scene.s,
               scene.g(mpf(a)), scene.fA * mpf(a)**scene.s, dxmax]

    def loss(s):
        """(27) with s = 1-t given: s^q is felt at small q where 1-s is 1."""
        q, t = mpf(n) / (mpf(n) + mpf(k) + 1), 1 - s
        b = 1 - s**(1 + q) - (1 + q) / 2 * t * (1 + s**q)
        return 8 * b / (1 + q) * mpf(mu) * mpf(F) * dxmax

    with mp.workdps(digits_for(one["t"])):
        t = mpf(Fx) / (mpf(mu) * mpf(F))
        assert 1 - t > mpf(2)**-52  # else the library takes it as gross slip
        c = a_F * (1 - t)**(1 / scene.s)
        results += [dxmax * (1 - (c / a_F)**scene.n), c, scene.g(c), loss(1 - t)]
    with mp.workdps(digits_for(one["x"])):
        x = mpf(dx) / dxmax
        slides = max(mpf(dx) - dxmax, mpf(0))
        rest = max(1 - x, mpf(0))
        c = a_F * rest**(1 / scene.n)
        s = rest**scene.p
        results += [mpf(mu) * mpf(F) * (1 - s), c, dz_F * rest, loss(s) + 4 * mpf(mu) * mpf(F) * slides]

    for value in [F, depth, a, Fx, dx] + results[6:18]:
        assert LEAST <= value <= MOST, (one, mp.nstr(value, 5))
    return scene.given + (F, Fx, depth, a, dx), results


rnd = random.Random(20228)
scenes = [one for _ in range(PASSES) for one in covering(rnd)] + [anywhere(rnd) for _ in range(RANDOM)]
oracle.write("corners.csv", "corners.py", "contacts at the corners of the domain, gap h (r/r0)^n",
             oracle.Scene.names + ["FN", "Fx", "dz", "a", "dx"],
             ["hN_1", "hT_1", "beta_1", "hN_2", "hT_2", "beta_2", "cN0", "cT0", "eta", "kappa", "a(F)", "dz(F)", "kn(F)",
              "a(dz)", "F(dz)", "dz(a)", "F(a)", "dxmax", "dx(Fx)", "c(Fx)", "yc(Fx)", "dW(FA)", "Fx(dx)", "c(dx)",
              "yc(dx)", "dW(dxA)"], [solve(one, mu) for one, mu in scenes])
