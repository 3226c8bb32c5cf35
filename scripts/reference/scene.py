#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""scene.csv: whole contacts at constant F_N, power-law gaps."""

import random

from mpmath import mp, mpf

import oracle

mp.dps = 120


def solve(scene, FN, FA):
    FN, FA, mu, eta, p, Kf = mpf(FN), mpf(FA), scene.mu, scene.eta, scene.p, scene.Kf
    a = scene.radius_of_force(FN)
    dz = scene.g(a)
    c = scene.radius_of_force(FN - FA / mu)
    yc = scene.g(c)
    dx, dxmax = mu * eta * (dz - yc), mu * eta * dz
    kn = scene.slope(a)
    q = 1 / p
    dW = oracle.share(q, FA / (mu * FN)) * mu * FN * dxmax
    # U = 1/(2 eta) int u^2 dK, u = mu eta (dz - max(y,yc)), dK = p (p-1) Kf y^(p-2) dy

    def moment(m, y):  # int_0^y y^m dK
        return p * (p - 1) * Kf * y**(m + p - 1) / (m + p - 1)

    def between(m):
        return moment(m, dz) - moment(m, yc)

    U = mu**2 * eta / 2 * ((dz - yc)**2 * moment(0, yc) + dz**2 * between(0) - 2 * dz * between(1) +
                           between(2))
    work = mu**2 * eta * ((dz - yc) * FN - (dz * FN - yc * scene.force(yc)) / (p + 1))
    return [a, dz, c, dx, dxmax, dW, eta, kn, U, work - U]


def check(scene, FN, FA):
    """The definitions as integrals over x, by quadrature."""
    a, dz, c, dx, _, dW, eta, _, U, W = solve(scene, FN, FA)
    mu, g = scene.mu, scene.g
    with mp.workdps(60):
        ga, gc = g(a), g(c)
        F = 2 * scene.weighted(lambda x: ga - g(x), mpf(0), a)
        loss = 8 * mu**2 * eta * scene.weighted(lambda x: (ga - g(x)) * (g(x) - gc), c, a)
        stored = (mu**2 * eta * (ga - gc)**2 * scene.weighted(lambda x: mpf(1), mpf(0), c) +
                  mu**2 * eta * scene.weighted(lambda x: (ga - g(x))**2, c, a))
        for name, got, want in (("F", F, mpf(FN)), ("dW", loss, dW), ("U", stored, U), ("W", 4 * W, dW)):
            assert abs(got / want - 1) < mpf(10)**-20, (name, scene.given, mp.nstr(got / want - 1, 5))


rnd = random.Random(20225)
rows = []


def add(scene, FN, FA):
    rows.append((scene, float(FN), float(FA)))


# Two equal spheres of 10 mm, and one such sphere on a flat (graded too)
add(oracle.Scene(210e9, 0.3, 0, 210e9, 0.3, 0, 0.0, 1e-3, 2.0, 100.0, 1.0, 0.3), 100, 15)
for k in (0.0, 0.5):
    add(oracle.Scene(210e9, 0.3, 0, 210e9, 0.3, 0, k, 1e-3, 2.0, 50.0, 1.0, 0.4), 100, 20)
for i in range(280):
    k = rnd.uniform(-0.95, 0.95)
    n = rnd.choice([1.0, 2.0, 3.0, 4.0, rnd.uniform(0.4, 6), rnd.uniform(0.4, 6)])
    E, nu = 10**rnd.uniform(5, 12), rnd.uniform(-0.3, 0.5)
    other = [(E, nu, 0), (10**rnd.uniform(5, 12), rnd.uniform(-0.3, 0.5), 0), (1.0, 0.0, 1)][i % 3]
    r0 = 10**rnd.uniform(-6, -2)
    h = r0 * 10**rnd.uniform(-4, 0)
    scene = oracle.Scene(E, nu, 0, *other, k, 10**rnd.uniform(-6, -2), n, h, r0, rnd.uniform(0.05, 1.2))
    FN = float(scene.fA * mpf(r0 * 10**rnd.uniform(-2, 0.7))**scene.s)
    t = rnd.choice([10**rnd.uniform(-6, 0), rnd.random(), 1 - 10**rnd.uniform(-9, -1)])
    FA = float(t * scene.mu * mpf(FN))
    if not 0 < FA < scene.mu * mpf(FN):
        FA = 0.5 * float(scene.mu) * FN
    add(scene, FN, FA)
for scene, FN, FA in rows[:3] + rows[3::9]:
    check(scene, FN, FA)
oracle.write("scene.csv", "scene.py",
             "contacts with gap h (r/r0)^n at constant F_N; U, W: first loading to FA",
             oracle.Scene.names + ["FN", "FA"],
             ["a", "dz", "c", "dx", "dxmax", "dW", "eta", "kn", "U", "W"],
             [(scene.given + (FN, FA), solve(scene, FN, FA)) for scene, FN, FA in rows])
