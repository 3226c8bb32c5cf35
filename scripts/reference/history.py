#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""history.csv and history_force.csv: random oblique histories of 24 contacts."""

import random
import sys

from mpmath import mp, mpf

import oracle
import polyline

mp.dps = 80
CHECKS = "--check" in sys.argv  # quadrature of every step: slow
STEPS = 25


def contacts(seed):
    rnd = random.Random(seed)
    pairs = [(n, k) for n in (0.5, 1.0, 2.0, 3.0) for k in (-0.9, -0.5, 0.0, 0.5, 0.9)]
    pairs += [(rnd.uniform(0.4, 6), rnd.uniform(-0.95, 0.95)) for _ in range(4)]
    for i, (n, k) in enumerate(pairs):
        E, nu = 10**rnd.uniform(6, 12), rnd.uniform(-0.3, 0.5)
        other = [(E, nu, 0), (10**rnd.uniform(6, 12), rnd.uniform(-0.3, 0.5), 0), (1.0, 0.0, 1)][i % 3]
        r0 = 10**rnd.uniform(-5, -2)
        scene = oracle.Scene(E, nu, 0, *other, k, 10**rnd.uniform(-5, -2), n,
                             r0 * 10**rnd.uniform(-3, -1), r0,
                             rnd.uniform(0.1, 1.0))
        yield rnd, scene, scene.g(mpf(r0))


def quick(i, j):
    """Steps whose work integral is checked in every run."""
    return CHECKS or (i * 7 + j) % 25 == 0


def displacement():
    rows = []
    for i, (rnd, scene, d) in enumerate(contacts(20226)):
        contact = polyline.Contact(scene)
        me = float(scene.mu * scene.eta)
        dz, dx = 0.0, 0.0
        for j in range(STEPS):
            kind = rnd.choice(["x", "x", "x", "z", "both", "both", "both", "steep", "flat", "open", "gross"])
            if j == 0:
                kind = rnd.choice(["z", "both"])
            if dz <= 0 and kind not in ("open", "both"):
                kind = "both"
            bound = me * max(dz, 0.0)
            if kind in ("z", "both", "steep"):
                dz = float(d) * rnd.uniform(0.2, 1.5)
            if kind == "flat":
                dz *= rnd.uniform(0.9, 1.1)
            if kind == "open":
                dz = -float(d) * rnd.choice([0.0, rnd.uniform(0, 0.5)])
            if kind in ("x", "both", "flat", "open"):
                dx += max(bound, me * float(d) * 0.3) * rnd.uniform(-1.2, 1.2)
            if kind == "steep":
                dx += me * (dz - float(contact.dz)) * rnd.uniform(-0.9, 0.9)
            if kind == "gross":
                dx += bound * rnd.choice([-1, 1]) * rnd.uniform(2, 3)
            contact.by_displacement(dz, dx, check=quick(i, j))
            rows.append(((i,) + scene.given + (dz, dx), [contact.FN(), contact.Fx(), contact.W, contact.U()]))
    oracle.write("history.csv", "history.py", "histories of steps straight in (dz, dx), from the open state",
                 ["history"] + oracle.Scene.names + ["dz", "dx"], ["FN", "Fx", "W", "U"], rows)


def force():
    rows = []
    for i, (rnd, scene, d) in enumerate(contacts(20227)):
        contact = polyline.Contact(scene)
        base, mu = float(scene.force(d)), float(scene.mu)
        FN = 0.0
        for j in range(STEPS):
            kind = rnd.choice(["x", "x", "both", "both", "both", "hold", "part", "open"])
            if FN == 0.0 or kind in ("both", "part") or j == 0:
                FN = base * rnd.uniform(0.2, 1.5)
            Fx = float(contact.Fx())
            if kind == "open" and j > 0:
                FN, Fx = 0.0, 0.0
            elif kind == "part" and j > 0:  # a shallow ramp: may stick all along
                Fx += mu * (FN - float(contact.FN())) * rnd.uniform(-1.0, 1.0)
            elif kind != "hold" or abs(Fx) > 0.95 * mu * FN:
                Fx = mu * FN * rnd.uniform(-0.95, 0.95)
            if abs(Fx) > 0.97 * mu * FN:
                Fx = 0.5 * mu * FN
            contact.by_force(FN, Fx, check=quick(i, j))
            rows.append(((i,) + scene.given + (FN, Fx), [contact.dz, contact.dx, contact.W, contact.U()]))
    oracle.write("history_force.csv", "history.py",
                 "histories of ramps straight in (FN, Fx), from the open state",
                 ["history"] + oracle.Scene.names + ["FN", "Fx"], ["dz", "dx", "W", "U"], rows)


if __name__ == "__main__":
    displacement()
    force()
