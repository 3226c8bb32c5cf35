#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Is a ramp straight in (F_N, F_x) one clip in the load coordinate? Compares it with m short steps
straight in (dz, dx) whose ends lie on the ramp; the difference must vanish as m grows."""

import copy

from mpmath import mp, mpf

import history
import polyline

mp.dps = 60


def short_steps(contact, FN, Fx, m):
    c = copy.deepcopy(contact)
    F0, X0 = c.FN(), c.Fx()
    slope = c.s.mu * c.s.eta
    for i in range(1, m + 1):
        F, X = F0 + (FN - F0) * i / m, X0 + (Fx - X0) * i / m
        dz = c.s.depth(F)

        def after(drive):
            line = polyline.moved(c.line, c.dz, slope, dz - c.dz, drive)
            return sum((b * c.s.force(y) for b, y in polyline.corners(line)), mpf(0)) / c.s.eta - X
        lo, hi = -2 * slope * max(dz, c.dz), 2 * slope * max(dz, c.dz)
        drive = mp.findroot(after, (lo, hi), solver="anderson", tol=mpf(10)**-50 * abs(X + F)**2,
                            verify=False)
        c.by_displacement(dz, c.dx + drive)
    return c


for i, (rnd, scene, d) in enumerate(history.contacts(7)):
    if i % 3:
        continue
    contact = polyline.Contact(scene)
    base, mu = scene.force(d), scene.mu
    for _ in range(6):
        FN = base * rnd.uniform(0.5, 1.5)
        contact.by_force(FN, mu * FN * rnd.uniform(-0.9, 0.9))
    F0, X0 = contact.FN(), contact.Fx()
    FN = F0 * rnd.uniform(0.3, 0.8)  # falling, the tangential rate well below the rate of the bound
    Fx = min(max(X0 + mu * (FN - F0) * rnd.uniform(-0.9, 0.9), -0.9 * mu * FN), 0.9 * mu * FN)
    exact = copy.deepcopy(contact)
    exact.by_force(FN, Fx)
    print("n %.3g k %.3g  |dFx/mu dFN| %.2f" % (scene.n, scene.k, abs((Fx - X0) / (mu * (FN - F0)))), end=" ")
    for m in (4, 16, 64, 256):
        c = short_steps(contact, FN, Fx, m)
        print(" m=%d: dx %.1e W %.1e" % (m, abs(c.dx - exact.dx) / (mu * scene.eta * exact.dz),
                                        abs(c.W - exact.W) / abs(exact.W - contact.W)), end="")
    print()
