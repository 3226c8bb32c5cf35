# SPDX-License-Identifier: GPL-3.0-or-later
"""Independent springs in double and small steps: slow, some four digits, no theory. For --check only."""

import numpy as np


class Springs:
    def __init__(self, scene, a_max, count=4000):
        s = scene
        edges = np.linspace(0, 1, count + 1) * a_max
        k, c0, n = float(s.k), float(s.c0), float(s.n)
        cell = (edges[1:]**(k + 1) - edges[:-1]**(k + 1)) / (k + 1) * c0**-k
        self.stiff = 2 * float(s.cT0) * cell
        x = (edges[1:] + edges[:-1]) / 2
        self.g = float(s.gA) * x**n
        self.u = np.zeros(count)
        self.dz = self.W = self.dx = 0.0
        self.mueta, self.scene = float(s.mu * s.eta), s

    def u_at(self, g):
        return np.interp(g, self.g, self.u)

    def move(self, FN, Fx):
        """One small step to these forces."""
        dz = float(self.scene.Kf**(-1 / self.scene.p)) * FN**(1 / float(self.scene.p)) if FN > 0 else 0.0
        bound = self.mueta * np.maximum(dz - self.g, 0)
        fresh = self.g >= self.dz
        share = np.ones_like(self.u)
        if dz > self.dz:
            share[fresh] = np.clip((dz - self.g[fresh]) / (dz - self.dz), 0, 1)
        D = 0.0
        for _ in range(200):  # Newton on a monotone sum of clips
            free = self.u + D * share
            held = np.abs(free) < bound
            rest = Fx - np.dot(self.stiff, np.clip(free, -bound, bound))
            if abs(rest) < 1e-12 * FN:
                break
            D += rest / max(np.dot(self.stiff[held], share[held]), 1e-30)
        else:
            raise ValueError("gross slip")
        new = np.clip(free, -bound, bound)
        slip = D * share - (new - self.u)
        self.W += np.dot(self.stiff, slip * (self.u + new) / 2)
        self.u, self.dz, self.dx = new, dz, self.dx + D


def swinging(scene, given, steps=4000):
    FN, FA, FNA, degrees = (float(x) for x in given[4:])
    phase = np.radians(degrees)
    springs = Springs(scene, float(scene.radius_of_force(FN + FNA)) * 1.0001)
    springs.move(FN, 0.0)
    for i in range(1, 501):
        springs.move(FN + FNA * np.cos(phase) * i / 500, FA * i / 500)
    for period in range(3):
        before = springs.W
        for i in range(1, steps + 1):
            s = 2 * np.pi * i / steps
            springs.move(FN + FNA * np.cos(s + phase), FA * np.cos(s))
    return springs.W, springs.W - before
