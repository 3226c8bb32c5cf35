#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""shape.csv: contacts of every gap with a formula at constant F_N, but for the single power."""

from multiprocessing import Pool

from mpmath import mp, mpf

import oracle

mp.dps = 60
BODIES = (210e9, 0.3, 0, 70e9, 0.35, 0)
C0, MU = 1e-3, 0.4
SUM, CONE, PARABOLOID, ROUNDED, SPHERE, TABLE = 1, 2, 3, 4, 5, 6  # fret_gap_kind
KS = (-0.99, -0.9, -0.7, -0.3, 0.0, 0.3, 0.7, 0.9, 0.99)
# kind, b, R, slope, three powers A r^n as n, A; radii. Tables: see sampled()
SHAPES = (
    ((SUM, 0.0, 0.0, 0.0, 2.0, 50.0, 4.0, -2e6, 1.0, 0.0), (1e-4, 7e-4, 2.4e-3)),
    ((SUM, 0.0, 0.0, 0.0, 1.0, 0.01, 2.0, 50.0, 3.5, -1e4), (1e-5, 3e-4, 2e-3)),
    ((CONE, 1e-3, 0.0, 0.05, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0), (1.001e-3, 1.3e-3, 6e-3)),
    ((PARABOLOID, 1e-3, 0.01, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0), (1.001e-3, 1.3e-3, 6e-3)),
    ((ROUNDED, 1e-3, 0.01, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0), (1.001e-3, 1.3e-3, 6e-3)),
    ((SPHERE, 0.0, 0.01, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0), (1e-5, 2e-3, 0.009)),
    ((TABLE, 4e-3, 0.0, 0.3, 5.0, 0.01, 1.0, 40.0, 1.0, -1e3), (1e-4, 1.7e-3, 3.9e-3)),
    ((TABLE, 3e-3, 1e-3, 0.0, 13.0, 0.0, 1.0, 50.0, 1.0, 1e4), (1.3e-3, 2.9e-3)),
)
LONG = ((TABLE, 3e-3, 0.0, 0.6, 40.0, 0.0, 1.0, 50.0, 1.0, 2e4), (2.2e-3,))  # slow: at some k only


def sampled(end, flat, bend, count, A):
    """The table at r = end t (1-bend+bend t), t = i/(count-1), of a cubic in r-flat; in doubles, as the test
    samples it."""
    count = int(count)
    rs, fs = [], []
    for i in range(count):
        t = i / (count - 1)
        r = end * t * (1 - bend + bend * t)
        x = r - flat if r > flat else 0.0
        rs.append(r)
        fs.append(x * (A[0] + x * (A[1] + x * A[2])))
    return [mpf(r) for r in rs], [mpf(f) for f in fs]


def pieces(r, f):
    """Coefficients of f' in powers of r on each piece: the cubic with Steffen's slopes."""
    n = len(r)
    h = [r[i + 1] - r[i] for i in range(n - 1)]
    s = [(f[i + 1] - f[i]) / h[i] for i in range(n - 1)]

    def end(i, j):
        p = s[i] + (s[i] - s[j]) * h[i] / (h[i] + h[j])
        return 0 if p * s[i] <= 0 else 2 * s[i] if abs(p) > 2 * abs(s[i]) else p
    d = [end(0, 1)]
    for i in range(1, n - 1):
        p = (s[i - 1] * h[i] + s[i] * h[i - 1]) / (h[i - 1] + h[i])
        d.append((mp.sign(s[i - 1]) + mp.sign(s[i])) * min(abs(s[i - 1]), abs(s[i]), abs(p) / 2))
    d.append(end(n - 2, n - 3))
    out = []
    for i in range(n - 1):
        d1 = 2 * (3 * s[i] - 2 * d[i] - d[i + 1]) / h[i]
        d2 = 3 * (d[i] + d[i + 1] - 2 * s[i]) / h[i]**2
        out.append((d[i] - d1 * r[i] + d2 * r[i]**2, d1 - 2 * d2 * r[i], d2))
    return out


class Shape:
    """g and int_0^a x^k (g(a)-g(x)) dx in closed form. Radii are given as their distance e from the flat
    end: as k -> -1 a flat end carries nearly all, and stick radii differ from b by far less than 1e-60 b."""

    def __init__(self, given, k):
        self.kind = given[0]
        self.b, self.R, self.slope = (mpf(x) for x in given[1:4])
        self.powers = [(mpf(given[i]), mpf(given[i + 1])) for i in (4, 6, 8)]
        self.k = mpf(k)
        self.m = (self.k + 1) / 2
        self.knots = []
        if self.kind == TABLE:
            r, f = sampled(*given[1:5], given[5::2])
            first = max(i for i in range(len(r)) if f[i] <= 0)  # may begin flat
            self.b, self.r, self.pieces = r[first], r[first:], pieces(r, f)[first:]
            self.knots = [x - self.b for x in self.r[1:-1]]

    def f1(self, r):
        if self.kind == TABLE:
            return sum(c * r**j for j, c in enumerate(self.pieces[max(0, sum(x <= r for x in self.r[:-1]) - 1)]))
        if self.kind == SUM:
            return sum(n * A * r**(n - 1) for n, A in self.powers)
        if r < self.b:
            return mpf(0)
        return {CONE: lambda: self.slope, PARABOLOID: lambda: r / self.R,
                ROUNDED: lambda: (r - self.b) / self.R,
                SPHERE: lambda: r / mp.sqrt(self.R**2 - r**2)}[self.kind]()

    def span(self, e):
        D = e * (2 * self.b + e)  # a^2-b^2
        return self.b + e, D, D / (self.b + e)**2

    def table(self, e, low, factor=(1, 1, 1)):
        """int f'(r) r^low (a^2-r^2)^((k-1)/2) dr, the powers of f' times a factor each: every knot adds what the
        polynomial changes by there."""
        m, a, total, old = self.m, self.b + e, mpf(0), (0, 0, 0)
        for r, now in zip(self.r, self.pieces):
            now = [c * x for c, x in zip(now, factor)]
            gap = e - (r - self.b)
            if gap <= 0:
                break
            D = gap * (a + r)
            Dm, z = D**m, D / a**2
            T = [a**(2 * m - 1) * z**m / (2 * m) * mp.hyp2f1(0.5, m, m + 1, z), Dm / (2 * m)]
            T.append((a**2 * T[0] + r * Dm) / (2 * m + 1))
            T.append(a**2 * T[1] - D * Dm / (2 * (m + 1)))
            T.append((3 * a**2 * T[2] + r**3 * Dm) / (2 * m + 3))
            total += sum((now[j] - old[j]) * T[j + low] for j in range(3))
            old = now
        return total

    def g(self, e):
        k, m, b, R = self.k, self.m, self.b, self.R
        a, D, z = self.span(e)
        if self.kind == TABLE:
            return a**(1 - k) * self.table(e, 0)
        if self.kind == SUM:
            return sum(oracle.kappa(n, k) * A * a**n for n, A in self.powers if A)
        if self.kind == CONE:
            return self.slope * a**-k * D**m / (2 * m) * mp.hyp2f1(0.5, m, m + 1, z)
        if self.kind == PARABOLOID:
            return a**(1 - k) * D**m / (2 * m * R)
        if self.kind == ROUNDED:
            return a**(1 - k) * D**m / (2 * m * R) * (1 - b / a * mp.hyp2f1(0.5, m, m + 1, z))
        rest = R**2 - a**2
        return a**2 / (2 * m * mp.sqrt(rest)) * mp.hyp2f1(0.5, m, m + 1, -a**2 / rest)

    def moment(self, e):
        k, m, b, R = self.k, self.m, self.b, self.R
        a, D, z = self.span(e)
        if self.kind == TABLE:
            return self.table(e, 2) / (k + 1)
        if self.kind == SUM:
            return sum(oracle.kappa(n, k) * A * a**(n + k + 1) * n / ((k + 1) * (n + k + 1))
                       for n, A in self.powers if A)
        if self.kind == SPHERE:
            rest = R**2 - a**2
            part = a**2 / mp.sqrt(rest) * mp.beta(m, 2) * mp.hyp2f1(0.5, m, m + 2, -a**2 / rest)
        else:
            round_ = (a**2 / m - D / (m + 1)) / R if self.kind != CONE else 0
            edge = a / m * mp.hyp2f1(-0.5, m, m + 1, z) if self.kind != PARABOLOID else 0
            part = self.slope * edge if self.kind == CONE else round_
            if self.kind == ROUNDED:
                part -= b / R * edge
        return D**m / (2 * (k + 1)) * part

    def integral(self, f, low, high):
        """int x^k f(e) dx for f of the order of 1: e = high v^(1/m), the power that makes a flat end regular.
        mp.quad stops at an absolute error, hence the scales."""
        m = self.m if self.b else 2 * self.m

        def density(v):
            e = high * v**(1 / m)
            return f(e) * ((self.b + e) / (self.b + high))**self.k * e / (high * v)
        breaks = [(x / high)**m for x in self.knots if low < x < high]
        breaks = [(low / high)**m, *breaks, 1] if breaks else mp.linspace((low / high)**m, 1, 3)
        return high * (self.b + high)**self.k / m * mp.quad(density, breaks)


def find(function, target, high):
    """e in 0..high with function(e) = target, rising: bisection in ln e, then secant steps."""
    hi, lo = mp.log(high), mp.log(high) - 1

    def miss(t):
        return mp.log(function(mp.exp(t)) / target)
    while miss(lo) > 0:
        hi, lo = lo, lo - 2 * (mp.log(high) - lo)
    return mp.exp(mp.findroot(miss, (lo, hi), solver="anderson", tol=mpf(10)**(10 - 2 * mp.dps), maxsteps=200))


def contact(job):
    given, k, a = job
    s = Shape(given, k)
    cN0, _, eta = oracle.foundation(*BODIES, k)
    mu, e = mpf(MU), mpf(a) - s.b
    scale = 2 * cN0 * mpf(C0)**-s.k
    ga, F = s.g(e), scale * s.moment(e)
    kn = scale * mpf(a)**(s.k + 1) / (s.k + 1)
    if s.kind == TABLE:  # int (r f')'; at a row a difference would not do
        slope = s.table(e, 0, (1, 2, 3)) / mpf(a)**k
    else:
        with mp.workdps(120):  # a difference loses half the digits
            h = e * mpf(10)**-40
            slope = (s.g(e + h) - s.g(e - h)) / (2 * h)
    rows = []
    for t in (1e-6, 0.3, 0.99) if given not in LONG else (0.3,):
        FA = float(t * mu * F)
        low = find(s.moment, (F - mpf(FA) / mu) / scale, e)
        gc = s.g(low)
        loss = []
        for digits in (60, 50) if t == 0.3 else (60,):
            with mp.workdps(digits):
                loss.append(4 * mu**2 * eta * scale * (ga - gc)**2 *
                            s.integral(lambda x: (ga - s.g(x)) * (s.g(x) - gc) / (ga - gc)**2, low, e))
        assert abs(loss[0] / loss[-1] - 1) < mpf(10)**-36, (job, t, mp.nstr(loss[0] / loss[-1] - 1, 5))
        rows.append((given + BODIES[:2] + BODIES[3:5] + (k, C0, MU, a, FA),
                     [ga, F, kn, slope, s.b + low, mu * eta * (ga - gc), loss[0]]))
    return rows


def check(job):
    """The closed forms against the definitions (3) and (10)-(13)."""
    given, k, a = job
    s, a = Shape(given, k), mpf(a)
    e, m = a - s.b, (mpf(k) + 1) / 2
    with mp.workdps(45):
        D = s.span(e)[1]  # a^2-r^2 = D u^(1/m)

        def inner(u):
            r = mp.sqrt(abs(a**2 - D * u**(1 / m)))
            return s.f1(r) / s.f1(a) * a / r  # (3) without its end point
        breaks = [((a**2 - (s.b + x)**2) / D)**m for x in reversed(s.knots) if x < e]
        breaks = [0, *breaks, 1] if s.knots else mp.linspace(0, 1, 5)
        g = a**-mpf(k) * s.f1(a) * D**m / (2 * m) * mp.quad(inner, breaks)
        I = s.g(e) * s.integral(lambda x: 1 - s.g(x) / s.g(e), mpf(0), e)
        if s.b:  # the flat end: g = 0
            I += s.g(e) * s.b**(2 * m) / (2 * m)
    assert abs(g / s.g(e) - 1) < mpf(10)**-15, (job, mp.nstr(g / s.g(e) - 1, 5))
    assert abs(I / s.moment(e) - 1) < mpf(10)**-20, (job, mp.nstr(I / s.moment(e) - 1, 5))


if __name__ == "__main__":
    jobs = [(given, k, a) for given, radii in SHAPES for k in KS for a in radii]
    jobs += [(LONG[0], k, a) for k in (-0.7, 0.3) for a in LONG[1]]
    with Pool() as pool:
        pool.map(check, jobs[1::5], chunksize=1)
        found = pool.map(contact, jobs, chunksize=1)
    oracle.write("shape.csv", "shape.py", "contacts of shapes with a formula; A r^n; FA: amplitude, first loading",
                 ["kind", "b", "R", "slope", "n1", "A1", "n2", "A2", "n3", "A3", "E1", "nu1", "E2", "nu2", "k",
                  "c0", "mu", "a", "FA"], ["dz", "F", "kn", "g1", "c", "dx", "dW"],
                 [row for rows in found for row in rows])
