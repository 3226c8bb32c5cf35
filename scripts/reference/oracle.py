# SPDX-License-Identifier: GPL-3.0-or-later
"""High-precision definitions that the reference tables are made from: literal textbook forms, made
safe by many digits rather than by rearrangement. Equation numbers: Mathematics 2022, 10, 3641."""

import csv
import os

from mpmath import mp, mpf

OUT = os.environ.get(
    "FRET_REFERENCE",
    os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tests", "reference"))


def write(name, script, what, inputs, results, rows):
    """A table: inputs are doubles (17 digits bring back the same double), results have 36 digits."""
    path = os.path.join(OUT, name)
    with open(path, "w", encoding="ascii", newline="\n") as out:
        out.write(f"# {what}; made by scripts/reference/{script}\n")
        out.write("# inputs (exact doubles): %s; results (36 digits): %s\n" %
                  (", ".join(inputs), ", ".join(results)))
        for given, got in rows:
            assert len(given) == len(inputs) and len(got) == len(results)
            cells = [("%d" % x) if isinstance(x, int) else ("%.17g" % x) for x in given]
            cells += [mp.nstr(x, 36, strip_zeros=True, min_fixed=1, max_fixed=0) for x in got]
            out.write(",".join(cells) + "\n")
    print(f"{name}: {len(rows)} rows")


def cell(x):
    """Text and integers as they are, no value as nothing, numbers with 30 digits."""
    if x is None:
        return ""
    if isinstance(x, (str, int)):
        return str(x)
    return mp.nstr(x, 30, strip_zeros=True, min_fixed=1, max_fixed=0)


def write_cells(name, script, notes, columns, rows):
    """A table with text among its cells: notes as comments, then a line of column names. Numbers given
    to it as text are decimals meant exactly as written."""
    with open(os.path.join(OUT, name), "w", encoding="ascii", newline="\n") as out:
        for note in notes + [f"made by scripts/reference/{script}"]:
            out.write(f"# {note}\n")
        table = csv.writer(out, lineterminator="\n")
        table.writerow(columns)
        for row in rows:
            assert len(row) == len(columns), row
            table.writerow([cell(x) for x in row])
    print(f"{name}: {len(rows)} rows")


def half_space(k, nu):
    """h_N, h_T, beta by (A1)-(A3), as printed."""
    k, nu = mpf(k), mpf(nu)
    beta = mp.sqrt((1 + k) * (1 - k * nu / (1 - nu)))
    C = 2**(1 + k) * mp.gamma((3 + k + beta) / 2) * mp.gamma((3 + k - beta) / 2) / (mp.pi * mp.gamma(2 + k))
    ck, sb, g = mp.cos(k * mp.pi / 2), mp.sin(beta * mp.pi / 2), mp.gamma(1 + k / 2)
    root = mp.sqrt(mp.pi)
    hN = 2 * (1 + k) * ck * g / (root * C * beta * sb * mp.gamma((1 + k) / 2))
    hT = 2 * beta * ck * g / ((1 - nu**2) * root * C * sb * mp.gamma((3 + k) / 2) + (1 + nu) * beta * g)
    return hN, hT, beta


def foundation(E1, nu1, rigid1, E2, nu2, rigid2, k):
    """cN0, cT0, eta of two bodies (4),(5)."""
    normal = tangential = mpf(0)
    for E, nu, rigid in ((E1, nu1, rigid1), (E2, nu2, rigid2)):
        if not rigid:
            hN, hT, _ = half_space(k, nu)
            normal += (1 - mpf(nu)**2) / (hN * mpf(E))
            tangential += 1 / (hT * mpf(E))
    return 1 / normal, 1 / tangential, tangential / normal


def kappa(n, k):
    """(n/2) B(n/2,(k+1)/2) (6)-(8)."""
    n, k = mpf(n), mpf(k)
    return n / 2 * mp.beta(n / 2, (k + 1) / 2)


def bracket(q, t):
    """b(t) of (27) as printed: needs three times the digits of 1/t."""
    return 1 - (1 - t)**(1 + q) - (1 + q) / 2 * t * (1 + (1 - t)**q)


def share(q, t):
    """w(t): the loss of a cycle over mu F_N dxmax (27)."""
    return 8 * bracket(q, t) / (1 + q)


def material(k, E0="210"):
    """The statement for equal bodies as the tables here have them; E0 in GPa, both in text."""
    return f"material E0={E0} GPa nu=0.3" + ("" if k == "0" else f" k={k} c0=1 mm")


def equal_bodies(E0, nu, k, c0, n, A, mu):
    """The scene of two equal bodies with the gap A r^n; inputs may be decimals in text."""
    E0, nu, k, c0, n, A, mu = (mpf(x) for x in (E0, nu, k, c0, n, A, mu))
    return Scene(E0, nu, 0, E0, nu, 0, k, c0, n, A, mpf(1), mu)


class Scene:
    """Two bodies and a gap h (r/r0)^n: the normal contact and the law F_N = Kf y^p."""

    names = ["E1", "nu1", "rigid1", "E2", "nu2", "rigid2", "k", "c0", "n", "h", "r0", "mu"]

    def __init__(self, E1, nu1, rigid1, E2, nu2, rigid2, k, c0, n, h, r0, mu):
        self.given = (E1, nu1, rigid1, E2, nu2, rigid2, k, c0, n, h, r0, mu)
        self.cN0, self.cT0, self.eta = foundation(E1, nu1, rigid1, E2, nu2, rigid2, k)
        self.k, self.c0, self.n, self.mu = mpf(k), mpf(c0), mpf(n), mpf(mu)
        self.gA = kappa(n, k) * mpf(h) / mpf(r0)**self.n  # g(x) = gA x^n
        self.s = self.n + self.k + 1
        self.p = self.s / self.n
        # F_N = fA a^s (13)
        self.fA = 2 * self.cN0 * self.c0**-self.k * self.gA * self.n / ((self.k + 1) * self.s)
        self.Kf = self.fA * self.gA**-self.p

    def g(self, x):
        return self.gA * x**self.n

    def radius_of_force(self, F):
        return (F / self.fA)**(1 / self.s)

    def force(self, y):
        return self.Kf * y**self.p

    def slope(self, a):
        """dF_N/d delta_z = 2 int_0^a c_N dx"""
        return 2 * self.cN0 * self.c0**-self.k * a**(self.k + 1) / (self.k + 1)

    def depth(self, F):
        return (F / self.Kf)**(1 / self.p)

    def weighted(self, f, lo, hi):
        """int_lo^hi c_N(x) f(x) dx by quadrature, with x^k dx = d x^(k+1)/(k+1)."""
        e = self.k + 1
        scale = self.cN0 * self.c0**-self.k / e
        return scale * mp.quad(lambda w: f(w**(1 / e)), [lo**e, hi**e])
