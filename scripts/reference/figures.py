#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""figures.csv: points on every curve of the paper's figures, from the definitions: foundation moduli and
equivalent profile, Masing's rule for each spring, integrals over springs term by term."""

from mpmath import mp, mpf

import oracle

mp.dps = 60
E0, NU, MU, FN = mpf("210e9"), mpf("0.3"), mpf("0.4"), mpf(100)
SHAPES = {"cone": (1, mpf("0.05")), "paraboloid": (2, mpf(50))}  # f = A r^n
LOOP_LEVEL = mpf("0.9")
TINY = mpf(10)**-32


def same(x, y):
    assert abs(x - y) <= TINY * max(abs(x), abs(y)), (mp.nstr(x, 35), mp.nstr(y, 35))


class Material:
    """One curve: a shape, k and c0/a0."""

    def __init__(self, shape, k="0", ratio="1"):
        n, A = SHAPES[shape]
        self.flat = oracle.equal_bodies(E0, NU, 0, 1, n, A, MU)
        self.a0 = self.flat.radius_of_force(FN)
        self.s = oracle.equal_bodies(E0, NU, k, mpf(ratio) * self.a0, n, A, MU)
        self.hT = oracle.half_space(mpf(k), NU)[1]
        self.a = self.s.radius_of_force(FN)
        self.dz = self.s.g(self.a)
        self.dxmax = MU * self.s.eta * self.dz
        self.dx0max = MU * self.flat.eta * self.flat.g(self.a0)
        self.loss_unit = MU**2 * FN**2 / (E0 * self.a0)
        assert abs(self.s.weighted(lambda x: 2 * (self.dz - self.s.g(x)), mpf(0), self.a) / FN - 1) < TINY

    def stick(self, Fx):
        """c of first loading by (18)."""
        return self.s.radius_of_force(FN - Fx / MU)

    def first(self, Fx):
        """delta_x of first loading (17)."""
        return MU * self.s.eta * (self.dz - self.s.g(self.stick(Fx)))

    def bound(self, x):
        return MU * self.s.eta * (self.dz - self.s.g(x))

    def states(self, FA, turn):
        """F_x = FA sin(2 pi turn), and the branches up to now: (weight, c of the branch)."""
        Fx = FA * mp.sinpi(2 * turn)
        if turn <= mpf("0.25"):
            return Fx, [(1, self.stick(Fx))]
        if turn <= mpf("0.75"):
            return Fx, [(1, self.stick(FA)), (-2, self.stick((FA - Fx) / 2))]
        return Fx, [(-1, self.stick(FA)), (2, self.stick((FA + Fx) / 2))]

    def spring(self, branches, x):
        """u(x): Masing's rule holds for each spring."""
        return sum(sign * min(self.bound(c), self.bound(x)) for sign, c in branches)

    def force(self, u, knots):
        """2 int c_T u dx (16)"""
        return self.integral([u], knots, 2 * self.s.cT0)

    def integral(self, factors, knots, scale):
        """scale int (x/c0)^k times the product of factors, each linear in x^n between the knots."""
        k, n, total = self.s.k, self.s.n, mpf(0)
        knots = sorted(set([mpf(0), self.a] + knots))
        for lo, hi in zip(knots, knots[1:]):
            product = [mpf(1)]
            for f in factors:
                x0, x1 = lo + (hi - lo) / 4, hi - (hi - lo) / 4
                f0, f1 = f(x0), f(x1)
                m = (f1 - f0) / (x1**n - x0**n)
                b = f0 - m * x0**n
                product = [(product[i] if i < len(product) else 0) * b + (product[i - 1] * m if i else 0)
                           for i in range(len(product) + 1)]
            for i, coefficient in enumerate(product):
                e = k + 1 + i * n
                total += coefficient * (hi**e - lo**e) / e
        return scale * self.s.c0**-k * total

    def loop(self, level, turn):
        """F_x, delta_x."""
        Fx, branches = self.states(level * MU * FN, turn)
        dx = sum(sign * self.bound(c) for sign, c in branches)
        u = lambda x: self.spring(branches, x)
        same(self.force(u, [c for _, c in branches]) + MU * FN, Fx + MU * FN)
        return Fx, dx

    def paper_W(self, level, turn, check=False):
        """(22): -h_T E0 int (x/c0)^k |u| |dx - u| dx, signed as printed."""
        Fx, branches = self.states(level * MU * FN, turn)
        dx = sum(sign * self.bound(c) for sign, c in branches)
        knots = [c for _, c in branches]
        u = lambda x: self.spring(branches, x)
        edges, zeros = sorted(set([mpf(0), self.a] + knots)), []
        n = self.s.n
        for lo, hi in zip(edges, edges[1:]):  # where u or dx-u changes sign, u linear in x^n
            x0, x1 = lo + (hi - lo) / 4, hi - (hi - lo) / 4
            m = (u(x1) - u(x0)) / (x1**n - x0**n)
            for level in (0, dx) if abs(m) > TINY * self.dxmax / hi**n else ():
                z = x0**n + (level - u(x0)) / m
                if lo**n < z < hi**n:
                    zeros.append(z**(1 / n))
        size = lambda x: abs(u(x))
        slip = lambda x: abs(dx - u(x))
        knots += zeros
        W = self.integral([size, slip], knots, -self.hT * E0)
        if check:
            e = self.s.k + 1
            pieces = sorted(set([mpf(0), self.a] + knots))
            again = -self.hT * E0 * self.s.c0**-self.s.k * mp.quad(
                lambda v: size(v**(1 / e)) * slip(v**(1 / e)) / self.bound(mpf(0))**2,
                [x**e for x in pieces]) / e * self.bound(mpf(0))**2
            assert abs(again - W) < mpf(10)**-25 * max(abs(W), mpf(10)**-9), (again, W)
        return W

    def loss(self, level):
        """dW by (27) and by the area of the loop (21), where int F_x d delta_x of first loading = -int
        delta_x dF_x + end term, and Masing makes the loop 8 times (work - F delta/2)."""
        s, t = self.s, mpf(level)
        q = s.n / (s.n + s.k + 1)
        closed = (8 * MU**2 * (1 + s.k) * (s.n + s.k + 1)**2 * s.c0**s.k * FN**2 * oracle.bracket(q, t) /
                  (s.n * (2 * s.n + s.k + 1) * self.hT * E0 * self.a**(s.k + 1)))
        if t == 0:
            return closed
        FA = t * MU * FN
        with mp.workdps(45):  # both branches of the loop in turn
            d = self.first(FA)
            down = mp.quad(lambda F: -d + 2 * self.first((FA + F) / 2), [-FA, FA])  # delta_x, load rising
            up = mp.quad(lambda F: d - 2 * self.first((FA - F) / 2), [-FA, FA])  # delta_x, load falling
        area = up - down  # closed integral of F_x d delta_x
        assert abs(area / closed - 1) < mpf(10)**-30, (level, mp.nstr(area / closed - 1, 5))
        return closed


def mindlin(R, t):
    """(28): Mindlin and Deresiewicz, sphere on flat of the same material."""
    G = E0 / (2 * (1 + NU))
    E = E0 / (2 * (1 - NU**2))
    a = mp.cbrt(3 * FN * R / (4 * E))
    return 9 * (2 - NU) * MU**2 * FN**2 / (5 * G * a) * (
        1 - (1 - t)**(mpf(5) / 3) - 5 * t / 6 * (1 + (1 - t)**(mpf(2) / 3)))


def all_rows():
    every = ("-0.7", "-0.5", "0", "0.5", "0.7")
    three = ("-0.5", "0", "0.5")
    ratios = ("0.5", "1", "2")
    rows = []

    def loading(panel, shape, curves):
        for k, ratio in curves:
            m = Material(shape, k, ratio)
            for i in range(11):
                level = mpf(i) / 10
                rows.append((panel, k, ratio, None, m.first(level * MU * FN) / m.dx0max, level))

    def loops(panel, shape, curves):
        for k, ratio in curves:
            m = Material(shape, k, ratio)
            for i in range(21):
                Fx, dx = m.loop(LOOP_LEVEL, mpf(i) / 16)
                rows.append((panel, k, ratio, mpf(i) / 16, dx / m.dx0max, Fx / (MU * FN)))

    def losses(panel, shape, curves, top):
        for k, ratio in curves:
            m = Material(shape, k, ratio)
            for i in range(11):
                t = mpf(top) * i / 10
                value = m.loss(t)
                if panel == "12" and k == "0" and i:
                    same(value, mindlin(mpf("0.01"), t))
                rows.append((panel, k, ratio, None, t, value / m.loss_unit))

    loading("4", "cone", [(k, "1") for k in three])
    loading("5a", "cone", [("0.5", c) for c in ratios])
    loading("5b", "cone", [("-0.5", c) for c in ratios])
    for panel, shape in (("6a", "cone"), ("6b", "paraboloid")):
        m = Material(shape)
        W = [m.paper_W(LOOP_LEVEL, mpf(i) / 16, check=i % 3 == 0) for i in range(21)]
        same(-4 * W[4], m.loss(LOOP_LEVEL))
        assert max(-w for w in W) == -W[4] or abs(W[20] / W[4] - 1) < TINY
        rows += [(panel, "0", "1", mpf(i) / 16, mpf(i) / 16, w / m.loss_unit) for i, w in enumerate(W)]
        rows += [(panel + " J", "0", "1", mpf(i) / 16, mpf(i) / 16, w) for i, w in enumerate(W)]
    for first, shape in ((7, "cone"), (9, "paraboloid")):
        loops(f"{first}a", shape, [(k, "1") for k in every])
        losses(f"{first}b", shape, [(k, "1") for k in every], "0.99")
        for (a, b), k in ((("a", "b"), "-0.5"), (("c", "d"), "0.5")):
            loops(f"{first + 1}{a}", shape, [(k, c) for c in ratios])
            losses(f"{first + 1}{b}", shape, [(k, c) for c in ratios], "0.99")
    m = Material("paraboloid")
    x = m.a * 4 / 5
    for i in range(21):
        _, branches = m.states(LOOP_LEVEL * MU * FN, mpf(i) / 16)
        u = m.spring(branches, x)
        rows.append(("11", "0", "1", mpf(i) / 16, sum(sign * m.bound(c) for sign, c in branches) - u,
                     m.s.cT0 * u))
    losses("12", "paraboloid", [(k, "1") for k in three], "1")
    for k in every:
        depths = [mpf(i) / 5 for i in range(1 if k[0] == "-" else 0, 11)]
        rows += [("13", k, "1", None, z**mpf(k), z) for z in depths]
    return rows


if __name__ == "__main__":
    oracle.write_cells(
        "figures.csv", "figures.py",
        ["points of the paper's figures; two equal bodies E0 = 210 GPa, nu = 0.3, mu = 0.4, FN = 100 N;",
         "cone slope = 0.05; paraboloid R = 10 mm; c0 = c0/a0 times a0 of (23), a0 being the radius at k = 0.",
         "x, y as FIGURES names them: dx/dx0max and Fx/(mu FN); FA/(mu FN) and dW E0 a0/(mu FN)^2; t/T and",
         "W(t) E0 a0/(mu FN)^2 (panels '6a J', '6b J': the same W(t) in J); E(z)/E0 and z/c0, z > 0 for k < 0.",
         "Panel 11: the spring at x = 0.8 a of the paraboloid, slip s1D in m and line load qx1D in N/m.",
         "t: the instant t/T at which a point of a loop is taken, F_x = 0.9 mu FN sin(2 pi t/T), first loading",
         "up to 1/4; W(t) is (22), negative as printed."],
        ["panel", "k", "c0/a0", "t", "x", "y"], all_rows())
