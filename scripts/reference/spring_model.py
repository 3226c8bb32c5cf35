#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""line.csv: the springs of the one-dimensional model after several load programs. --check compares all with
independent springs moved in small steps."""

import sys

from mpmath import mp, mpf

import oracle
import polyline

mp.dps = 60
MU = mpf("0.4")
SHAPES = (("geometry cone slope=0.05", 1, mpf("0.05")), ("geometry paraboloid R=10 mm", 2, mpf(50)))
PLACES = ("0.1", "0.35", "0.6", "0.85", "0.97")
# Ramps: (FN, Fx), each straight from the one before; the first is the press.
PROGRAMS = [
    [(100, 0), (100, 20)],
    [(100, 0), (100, 20), (100, -5)],
    [(100, 0), (100, 20), (100, -10), (100, 12)],
    [(100, 0), (100, 20), (100, -10), (100, 12), (100, -15)],  # wipes out the turn at 12 N
    [(100, 0), (130, 6)],  # sticks
    [(100, 0), (100, 20), (130, 26)],  # sticks on top of slip
    [(100, 0), (100, 20), (110, 35)],  # the front moves in
    [(100, 0), (100, 20), (80, 15)],
    [(100, 0), (100, 20), (70, -10)],
    [(100, 0), (140, 20), (90, 25), (120, -20)],
]


def lines(program):
    """As statements of the language; a force that stays is not named."""
    text, (FN, Fx) = ["press FN=%d N" % program[0][0]], program[0]
    for F, X in program[1:]:
        text.append("step Fx=%d N" % X if F == FN else "step FN=%d N Fx=%d N" % (F, X))
        FN, Fx = F, X
    return "; ".join(text)


def masing(scene, program):
    """u at constant F_N from the turning points that still count, outermost first: each spring follows
    u = u_turn -+ 2 min(half the way, bound)."""
    turns = [mpf(X) for _, X in program]
    i = 1
    while i + 3 < len(turns):  # a load beyond an older turn wipes out the inner pair
        a, b, c, d = turns[i:i + 4]
        if abs(c - b) <= min(abs(b - a), abs(d - c)):
            del turns[i + 1:i + 3]
            i = 1
        else:
            i += 1
    FN = mpf(program[0][0])
    dz = scene.depth(FN)

    def u(x):
        bound = MU * scene.eta * (dz - scene.g(x))

        def first(X):
            return min(MU * scene.eta * (dz - scene.depth(FN - X / MU)), bound)
        value, now = first(abs(turns[1])) * mp.sign(turns[1]), turns[1]
        for X in turns[2:]:
            value += 2 * mp.sign(X - now) * first(abs(X - now) / 2)
            now = X
        return value
    return u


def signed_work(scene, contact):
    """(22): -2 int_0^a c_T |u| |dx-u| dx, by quadrature over pieces on which both keep their sign."""
    cuts, top = [mpf(0)], contact.dx
    for (y0, u0), (y1, u1) in zip(contact.line, contact.line[1:]):
        for level in (0, top):
            if (u0 - level) * (u1 - level) < 0:
                cuts.append(y0 + (y1 - y0) * (level - u0) / (u1 - u0))
        cuts.append(y1)
    radii, scale = [(y / scene.gA)**(1 / scene.n) for y in sorted(cuts)], MU * scene.eta * contact.dz
    total = mpf(0)
    for lo, hi in zip(radii, radii[1:]):
        def rate(x):
            u = polyline.at(contact.line, scene.g(x))
            return abs(u * (top - u)) / scale**2
        total += scene.weighted(rate, lo, hi)
    return -2 * scale**2 * total / scene.eta


def small_steps(scene, program):
    """The same springs, in double."""
    import brute
    springs = brute.Springs(scene, float(scene.radius_of_force(mpf(max(F for F, _ in program)))) * 1.0001)
    F, X = program[0]
    springs.move(F, X)
    for FN, Fx in program[1:]:
        for i in range(1, 1001):
            springs.move(F + (FN - F) * i / 1000, X + (Fx - X) * i / 1000)
        F, X = FN, Fx
    return springs


rows = []
for geometry, n, A in SHAPES:
    for k in ("-0.5", "0", "0.5"):
        scene = oracle.equal_bodies("210e9", "0.3", k, "1e-3", n, A, MU)
        for program in PROGRAMS:
            contact = polyline.Contact(scene)
            for FN, Fx in program:
                contact.by_force(FN, Fx)
            a = scene.radius_of_force(mpf(program[-1][0]))
            constant = all(FN == program[0][0] for FN, _ in program)
            W1D = signed_work(scene, contact) if constant else None
            if constant and len(program) == 2:
                assert abs(-W1D / contact.W - 1) < mpf(10)**-30
            rough = small_steps(scene, program) if "--check" in sys.argv else None
            for place in PLACES:
                x = mpf(place) * a
                cN, cT = (c * (x / scene.c0)**scene.k for c in (scene.cN0, scene.cT0))
                w, u = contact.dz - scene.g(x), polyline.at(contact.line, scene.g(x))
                slip = contact.dx - u
                if abs(slip) < mpf(10)**-45 * contact.dz:  # it never slipped
                    slip = mpf(0)
                assert abs(u) <= MU * scene.eta * w * (1 + mpf(10)**-40)
                if constant:
                    assert abs(u - masing(scene, program)(x)) < mpf(10)**-35 * contact.dz
                if rough:
                    near = rough.u_at(float(scene.g(x)))
                    assert abs(near - u) < 2e-3 * abs(u) + 1e-4 * abs(contact.dx), (n, k, program, place)
                    assert abs(rough.dx / contact.dx - 1) < 2e-3
                    assert abs(rough.W - contact.W) < 2e-3 * contact.W + 1e-4 * contact.U()
                setup = f"{oracle.material(k)}; {geometry}; friction 0.4; {lines(program)}"
                rows.append((setup, place, x, w, u, slip,
                             cN * w, cT * u, cN, cT, W1D, contact.dz, contact.dx))
oracle.write_cells("line.csv", "spring_model.py",
                   ["springs of the one-dimensional model at x = (x/a) a, SI units; s1D = dx - u1D;",
                    "W1D is (22) as printed, negative, only where F_N is constant"],
                   ["setup", "x/a", "x", "w1D", "u1D", "s1D", "qz1D", "qx1D", "cN", "cT", "W1D", "dz", "dx"], rows)
