# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the program with independent numbers: a published table at full precision, the formulas of the paper (Mathematics 2022,
10, 3641) programmed again, quadrature of the definitions, and a simple model of many springs."""
import functools
import math
import os
import re
from decimal import Decimal
from math import gamma, pi

import harness

# One sphere R = 10 mm, E0 = 210 GPa, nu = 0.3, c0 = 1 mm, mu = 0.4, FN = 100 N, Fx = FA = 20 N.
TABLE = {0: (1.8662555784086241e-4, 3.4829098839413082e-6, 1.4812480342036853e-4, 6.2599544191009847e-7,
             1.9064562410875217e-6),
         0.5: (3.0092451732927952e-4, 6.0370376753239901e-6, 2.4685902105474113e-4, 1.6644632276036456e-6,
               6.5235001018033792e-6)}
STEEL = dict(E0=210e9, nu=0.3, c0=1e-3, mu=0.4, FN=100.0)


def values(tests, script):
    """The values that the script prints, {name: value in SI units}."""
    done = tests.run("--format=json", "-c", script)
    if done.returncode:
        tests.check("numbers: " + script, False, tests.report(done))
        return {}
    rows = harness.told(done.stdout)
    return {row["name"]: row["value"] for row in rows if "name" in row}


def close(tests, name, want, got, tolerance):
    ok = got is not None and abs(want - got) <= tolerance * abs(want)
    tests.check(name, ok, "expected %.17g, got %r, tolerance %g" % (want, got, tolerance))


def coefficients(k, nu):
    """h_N and h_T by (A1)-(A3), as printed."""
    beta = math.sqrt((1 + k) * (1 - k * nu / (1 - nu)))
    C = 2 ** (1 + k) * gamma((3 + k + beta) / 2) * gamma((3 + k - beta) / 2) / (pi * gamma(2 + k))
    ck, sb, G = math.cos(k * pi / 2), math.sin(beta * pi / 2), gamma(1 + k / 2)
    hN = 2 * (1 + k) * ck * G / (math.sqrt(pi) * C * beta * sb * gamma((1 + k) / 2))
    hT = 2 * beta * ck * G / ((1 - nu ** 2) * math.sqrt(pi) * C * sb * gamma((3 + k) / 2) + (1 + nu) * beta * G)
    return hN, hT


def integral(f, a, b, power=1.0):
    """int_a^b f by tanh-sinh quadrature; f(x, distance to a, distance to b) may be singular at the ends."""
    h, total = 1 / 64, 0.0
    for i in range(-64 * 5, 64 * 5 + 1):
        t = i * h
        s = pi / 2 * math.sinh(t)
        if abs(s) > 340:
            continue
        near_b = (b - a) / (1 + math.exp(2 * s))
        near_a = (b - a) / (1 + math.exp(-2 * s))
        weight = pi / 2 * math.cosh(t) / math.cosh(s) ** 2 * (b - a) / 2
        if near_a > 0 and near_b > 0 and weight > 0:
            total += weight * f(a + near_a if near_a < near_b else b - near_b, near_a, near_b)
    return total * h


def profile(slope, start, k, x):
    """g(x) = x^(1-k) int f'(r) (x^2-r^2)^((k-1)/2) dr (3)."""
    if x <= start:
        return 0.0
    return x ** (1 - k) * integral(lambda r, lo, hi: slope(r, lo) * (hi * (x + r)) ** ((k - 1) / 2), start, x)


SHAPES = {  # command: f'(r, r - start), start
    "cone slope=0.05": (lambda r, d: 0.05, 0.0),
    "sphere R=10 mm": (lambda r, d: r / 1e-2, 0.0),
    "power n=3.5 h=1 um r0=1 mm": (lambda r, d: 3.5e-6 / 1e-3 * (r / 1e-3) ** 2.5, 0.0),
    "sum 2:50 m^-1, 4:2e6 m^-3": (lambda r, d: 100 * r + 8e6 * r ** 3, 0.0),
    "flat-cone b=0.2 mm slope=0.05": (lambda r, d: 0.05, 2e-4),
    "flat-paraboloid b=0.2 mm R=10 mm": (lambda r, d: r / 1e-2, 2e-4),
    "flat-rounded b=0.2 mm R=10 mm": (lambda r, d: d / 1e-2, 2e-4),
    "exact-sphere R=10 mm": (lambda r, d: r / math.sqrt(1e-4 - r * r), 0.0),
}


def published(tests):
    for k, row in TABLE.items():
        got = values(tests, "material E0=210 GPa nu=0.3 k=%g c0=1 mm; geometry sphere R=10 mm; friction 0.4\n"
                     "press FN=100 N; a, dz; step Fx=20 N; c, dx; dW(20 N); cycle FA=20 N; dW" % k)
        for name, want in zip(("a", "dz", "c", "dx", "dW(20 N)"), row):
            close(tests, "published table, k = %g: %s" % (k, name), want, got.get(name), 1e-14)
        close(tests, "published table, k = %g: dW" % k, row[4], got.get("dW"), 1e-14)
    spheres = "material E0=210 GPa nu=0.3; geometry sphere R=5 mm; friction 0.3; press FN=100 N\n"
    got = values(tests, spheres + "step Fx=15 N; a, dz, c/a, dx; dW(15 N)")
    for name, want in {"a": 0.148125e-3, "dz": 4.38819e-6, "c/a": 0.79370, "dx": 0.591529e-6,
                       "dW(15 N)": 1.35112e-6}.items():
        close(tests, "two spheres: " + name, want, got.get(name), 1e-5)
    # A spring model in 80 steps gives 280.2 and 1319.6 nJ, as published; the exact sine gives these (scripts/reference/swinging.py):
    for phase, want in ((0, 2.7815519029552038301e-7), (90, 1.3565415339292387208e-6)):
        got = values(tests, spheres + "cycle FA=12 N FNA=30 N phase=%d deg times 2 steps 80; dW" % phase)
        close(tests, "two spheres, swinging normal force, phase %d: dW" % phase, want, got.get("dW"), 1e-10)


def corners(tests):
    """The corners of the domain, by statements: every scalar within one unit in the last place."""
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../reference/corners.csv")
    with open(path, encoding="ascii") as f:
        rows = [line.rstrip("\n").split(",") for line in f if not line.startswith("#")]
    script = []
    for row in rows:
        E1, nu1, _, E2, nu2, rigid2, k, c0, n, h, r0, mu, FN, Fx, dz, a, dx = row[:17]
        second = "rigid" if rigid2 == "1" else "E0=%s Pa nu=%s" % (E2, nu2)
        script.append("reset all; material E0=%s Pa nu=%s k=%s c0=%s m; second %s; geometry power n=%s h=%s m r0=%s m"
                      % (E1, nu1, k, c0, second, n, h, r0))
        script.append("friction %s; press FN=%s N; hN, hT, beta_k, cN, cT, eta, kappa, a, dz, kn, dxmax" % (mu, FN))
        script.append("dW(%s N); step Fx=%s N; dx, c" % (Fx, Fx))
        script.append("press dz=%s m; a, FN; press a=%s m; dz, FN" % (dz, a))
    done = tests.run("--format=json", input="\n".join(script) + "\n")
    got = harness.told(done.stdout)
    got = [line for line in got if "name" in line]
    per_row, columns = 18, (0, 1, 2, 6, 7, 8, 9, 10, 11, 12, 17, 21, 18, 19, 13, 14, 15, 16)
    tests.check("corners: all are answered", len(got) == per_row * len(rows), tests.report(done))
    for i, row in enumerate(rows):
        for j, column in enumerate(columns):
            line, want = got[per_row * i + j], row[17 + column]
            error = abs(Decimal(line["value"]) - Decimal(want)) / Decimal(math.ulp(float(want)))
            tests.check("corners, row %d: %s" % (i + 3, line["name"]), error <= 1,
                        "%r, exact %s, %.3g units in the last place" % (line["value"], want, error))


def material(tests):
    for k in (-0.7, -0.3, 0.2, 0.5, 0.8):
        for nu in (0.0, 0.22, 0.3, 0.45):
            hN, hT = coefficients(k, nu)
            got = values(tests, "material E0=210 GPa nu=%g k=%g c0=1 mm; hN, hT, eta, cN, cT, E(3 mm)" % (nu, k))
            for name, want in {"hN": hN, "hT": hT, "eta": hN / ((1 - nu ** 2) * hT),
                               "cN": hN * 210e9 / (2 * (1 - nu ** 2)), "cT": hT * 210e9 / 2,
                               "E(3 mm)": 210e9 * 3 ** k}.items():
                close(tests, "k = %g, nu = %g: %s" % (k, nu, name), want, got.get(name), 1e-12)


@functools.lru_cache(None)  # once for both builds
def by_quadrature(command, k):
    """A contact of radius 0.3 mm with stick radius c: depth, F_N, c, F_x, delta_x, loss of a closed cycle."""
    slope, start = SHAPES[command]
    hN, hT = coefficients(k, 0.3) if k else (1, 2 / (1.3 * 1.7))
    cN = hN * 210e9 / (2 * (1 - 0.09)) * 1e-3 ** -k
    eta = hN / (0.91 * hT)
    a = 3e-4

    @functools.lru_cache(None)
    def g(x):
        return profile(slope, start, k, x)

    def force(to):
        """2 int_0^to c_N(x) [g(to) - g(x)] dx (10), in two parts at the edge of the flat."""
        part = integral(lambda x, lo, hi: x ** k * (g(to) - g(x)), start, to)
        return 2 * cN * (part + g(to) * start ** (k + 1) / (k + 1))

    FN = force(a)
    c = start + 0.6 * (a - start)
    Fx = 0.4 * (FN - force(c))  # (15)
    loss = 8 * 0.16 * eta * cN * integral(lambda x, lo, hi: x ** k * (g(a) - g(x)) * (g(x) - g(c)), c, a)
    return a, g(a), FN, c, Fx, 0.4 * eta * (g(a) - g(c)), loss


def shapes(tests):
    for command, k in tests.some(((command, k) for k in (-0.4, 0.0, 0.5) for command in SHAPES), 5):
        name = "%s, k = %g: " % (command, k)
        a, depth, FN, c, Fx, dx, loss = by_quadrature(command, k)
        got = values(tests, "material E0=210 GPa nu=0.3 k=%g c0=1 mm; geometry %s; friction 0.4\n"
                     "press a=0.3 mm; dz, FN, g(0.3 mm); step Fx=%.17g N; c, dx; dW(Fx); W, U" % (k, command, Fx))
        for what, want in {"dz": depth, "g(0.3 mm)": depth, "FN": FN, "c": c, "dx": dx,
                           "dW(Fx)": loss, "W": loss / 4}.items():
            close(tests, name + what, want, got.get(what), 1e-9)
        got = values(tests, "material E0=210 GPa nu=0.3 k=%g c0=1 mm; geometry %s; friction 0.4\n"
                     "press FN=%.17g N; a, dz(FN), a(FN)" % (k, command, FN))
        close(tests, name + "a by force", a, got.get("a"), 1e-9)
        close(tests, name + "a(FN)", a, got.get("a(FN)"), 1e-9)


def gap_file(tests):
    """A table of a paraboloid in equal steps, which the interpolation reproduces: f, and the quantities of the contact."""
    where = os.path.join(tests.dir, "paraboloid.csv")
    with open(where, "w", encoding="ascii") as f:
        f.write("r [mm],f [um]\n" + "".join("%d,%d\n" % (r, 50 * r * r) for r in range(9)))
    for k in (-0.6, 0.0, 0.4):
        hN, _ = coefficients(k, 0.3) if k else (1, None)
        cN = hN * 210e9 / (2 * 0.91) * 1e-3 ** -k
        got = values(tests, "material E0=210 GPa nu=0.3 k=%g c0=1 mm; geometry file %s\n" % (k, where) +
                     "f(0 m), f(0.3 mm), f(1 mm), f(4.7 mm), f(8 mm), g(0.3 mm), g(4.7 mm); press a=2 mm; dz, FN, kn")
        for name, want in {"f(0.3 mm)": 0.3e-3 ** 2 / 0.02, "f(1 mm)": 5e-5, "f(4.7 mm)": 4.7e-3 ** 2 / 0.02,
                           "f(8 mm)": 3.2e-3, "g(0.3 mm)": 2 / (k + 1) * 0.3e-3 ** 2 / 0.02,
                           "g(4.7 mm)": 2 / (k + 1) * 4.7e-3 ** 2 / 0.02, "dz": 2 / (k + 1) * 2e-3 ** 2 / 0.02,
                           "FN": 4 * cN * 100 / (k + 1) * 2e-3 ** (k + 3) / ((k + 1) * (k + 3)),
                           "kn": 2 * cN * 2e-3 ** (k + 1) / (k + 1)}.items():
            close(tests, "gap file, k = %g: %s" % (k, name), want, got.get(name), 1e-12)
        tests.check("gap file: f(0)", got.get("f(0 m)") == 0, str(got))


def numbers_of(tests, script):
    done = tests.run("--format=json", "-c", script)
    strange = [line for line in done.stderr.splitlines() if not re.match("note: of .* rows .* pieces are made", line)]
    if done.returncode or strange:
        tests.check("numbers: " + script, False, tests.report(done))
    rows = harness.told(done.stdout)
    return [(" ".join(map(str, row.values())), name, v) for row in rows if "event" not in row
            for name, v in row.items() if isinstance(v, (int, float))]


def dense_file(tests):
    """A table with so many rows that its law is fitted to all of them: the results are those of the formula; with f to nine digits,
    less accurate."""
    statements = """press FN=100 N; dz, a; dW(2 N), dW(10 N), dWd(1 um); step Fx=20 N; c, dx, W
        step FN=90 N Fx=-12 N; c, dx, W; table dW(F), c(F) for F = 5 N .. 35 N steps 40
        press FN=100 N; cycle FA=15 N FNA=20 N phase=60 deg; dW"""
    for digits, close_to, swinging in (17, 1e-12, 1e-9), (9, 1e-5, 1e-6):
        where = os.path.join(tests.dir, "dense%d.csv" % digits)
        with open(where, "w", encoding="ascii") as f:
            f.write("r [mm],f [um]\n")
            for i in range(12000):
                f.write("%.17g,%.*g\n" % (i / 24000, digits, 50 * (i / 24000) ** 2))
        for k in (-0.6, 0.4) if digits == 17 else (0.3,):
            begin = "material E0=210 GPa nu=0.3 k=%g c0=1 mm; friction 0.4; geometry " % k
            got = numbers_of(tests, begin + "file %s; " % where + statements)
            want = numbers_of(tests, begin + "sphere R=10 mm; " + statements)
            tests.check("dense rows: as many numbers", len(got) == len(want) > 90, "%d, %d" % (len(got), len(want)))
            for i, (g, w) in enumerate(zip(got, want)):
                close(tests, "dense rows to %d digits, k = %g: %s of %s" % (digits, k, g[1], g[0]), w[2], g[2],
                      close_to if i < len(got) - 1 else swinging)


def dense_fields(tests):
    """The same for local fields: so many rows are replaced by pieces, whose second derivative matters."""
    where = os.path.join(tests.dir, "dense-sum.csv")
    with open(where, "w", encoding="ascii") as f:
        f.write("r [m],f [m]\n")
        for i in range(12001):
            r = 1e-3 * i / 12000
            f.write("%.17g,%.17g\n" % (r, 50 * r ** 2 + 2e6 * r ** 4))
    asked = """press a=0.95 mm; step Fx=0.2*mu*FN; FN; p(0 mm), p(0.2 mm), p(0.9 mm), qx(0.3 mm), qx(0.94 mm), uz(0 mm), uz(0.4 mm), uz(2 mm), ux(0.4 mm)
        g(0.2 mm), w1D(0.3 mm), u1D(0.9 mm), qz1D(0.5 mm), qx1D(0.5 mm)"""
    for k in (-0.4, 0.5):
        begin = "material E0=210 GPa nu=0.3 k=%g c0=1 mm; friction 0.4; geometry " % k
        got = numbers_of(tests, begin + "file %s; " % where + asked)
        want = numbers_of(tests, begin + "sum 2:50 m^-1, 4:2e6 m^-3; " + asked)
        tests.check("dense fields: as many numbers", len(got) == len(want) == 15, "%d, %d" % (len(got), len(want)))
        for g, w in zip(got, want):
            close(tests, "fields of dense rows, k = %g: %s" % (k, g[1:] + g[:1]), w[2], g[2], 2e-8)


def tip_in_rows(tests):
    """The centre of a contact with a table of a cone: as for the cone."""
    where = os.path.join(tests.dir, "tip.csv")
    with open(where, "w", encoding="ascii") as f:
        f.write("r [m],f [m]\n" + "".join("%.17g,%.17g\n" % (i * 1e-5, i * 2e-7) for i in range(60)))
    asked = "press a=0.3 mm; p(0 mm); step Fx=0.1*mu*FN; qx(0 mm)"
    for k in (0.3, 0.8):
        begin = "material E0=210 GPa nu=0.3 k=%g c0=1 mm; friction 0.4; geometry " % k
        for g, w in zip(numbers_of(tests, begin + "file %s; " % where + asked), numbers_of(tests, begin + "cone slope=0.02; " + asked)):
            close(tests, "at the tip, k = %g: %s" % (k, g[1:] + g[:1]), w[2], g[2], 1e-12)


def whole_gap(tests):
    """A contact that reaches the last row of its table is possible when pressed again by its own depth or load."""
    where = os.path.join(tests.dir, "whole.csv")
    with open(where, "w", encoding="ascii") as f:
        f.write("r [mm],f [um]\n" + "".join("%.17g,%.17g\n" % (i / 7, 50 * (i / 7) ** 2) for i in range(8)))
    statements = """press a=1 mm; dz, FN; step FN=0.8*FN; step FN=FN/0.8 Fx=0.1*mu*FN; a, Fx, dx, U
        press a=1 mm; cycle FA=0.3*mu*FN; dW, a, c; press a=1 mm; cycle dxA=1.5*dxmax; dW, a
        press a=1 mm; table dW(F), dx(F) for F = FN/100 .. mu*FN/2 steps 20; a; step FN=0.8*FN; cycle FNA=FN/4 FA=FN/100; dW"""
    for k in (-0.4, 0.0, 0.3):
        begin = "material E0=210 GPa nu=0.3 k=%g c0=1 mm; friction 0.4; geometry " % k
        got = numbers_of(tests, begin + "file %s; " % where + statements)
        want = numbers_of(tests, begin + "sphere R=10 mm; " + statements)
        tests.check("whole gap: as many numbers", len(got) == len(want) > 70, "%d, %d" % (len(got), len(want)))
        for i, (g, w) in enumerate(zip(got, want)):
            close(tests, "whole gap, k = %g: %s of %s" % (k, g[1], g[0]), w[2], g[2], 1e-12 if i < len(got) - 1 else 1e-9)


def swinging_rows(tests):
    """A table with six digits, with both forces swinging a little: the slip annulus is thinner than the digits of a load resolve. The
    results are close to those of the power law that was rounded."""
    where = os.path.join(tests.dir, "rounded.csv")
    with open(where, "w", encoding="ascii") as f:
        f.write("r [mm],f [um]\n" + "".join("%.6g,%.6g\n" % (i / 25, 30 * (i / 25) ** 1.5) for i in range(51)))
    for little in (0.1, 1e-5, 1e-10):
        load = "press a=1.8 mm; step FN=0.8*FN; cycle FNA=%g*FN FA=%g*mu*FN; dW" % (little, little)
        begin = "material E0=210 GPa nu=0.3 k=-0.4 c0=1 mm; friction 0.4; geometry "
        got = values(tests, begin + "file %s; " % where + load)
        want = values(tests, begin + "power n=1.5 h=30 um r0=1 mm; " + load)
        close(tests, "swinging rows, %g" % little, want.get("dW"), got.get("dW"), 1e-2)


def hardly_moved_rows(tests):
    """A contact edge that moves by little more than the rounding of its position dissipates as one that does not move."""
    where = os.path.join(tests.dir, "hardly.csv")
    with open(where, "w", encoding="ascii") as f:
        f.write("r [m],f [m]\n0,0\n1e-4,1e-8\n2e-4,7e-8\n5e-4,6e-7\n")
    for k in (-0.8, 0.5):
        begin = "material E0=210 GPa nu=0.3 k=%g c0=0.1 mm; geometry file %s; friction 0.5; press a=0.2 mm; P = FN\n" % (k, where)
        for end in ("FN=P%s Fx=0.45*mu*P", "dz=dz%s dx=0.45*dxmax"):
            want = values(tests, begin + "press FN=P; step %s; W" % (end % "").split()[-1])
            for moved in ("3e-16", "1e-14", "1e-13"):
                for sign in "+-":
                    got = values(tests, begin + "press FN=P; step %s; W" % end % ("*(1 %s %s)" % (sign, moved)).replace(" ", ""))
                    close(tests, "hardly moved rows, k = %g: %s, %s%s" % (k, end, sign, moved), want.get("W"), got.get("W"), 3e-11)


class Springs:
    """A simple model: many springs, each of which slides when its force would exceed mu times its normal force."""

    def __init__(self, count, k=0.0, eta=1.0):
        self.eta, self.count = eta, count
        edge = 4e-4
        self.x = [(i + 0.5) * edge / count for i in range(count)]
        hN, hT = coefficients(k, 0.3) if k else (1, 2 / (1.3 * 1.7))
        self.weight = [2 * 210e9 / 2 * 1e3 ** k * ((i + 1) ** (k + 1) - i ** (k + 1)) * (edge / count) ** (k + 1) / (k + 1)
                       for i in range(count)]
        self.cN, self.cT = hN / 0.91, hT
        self.g = [2 / (k + 1) * x * x / 2e-2 for x in self.x]
        self.u = [0.0] * count
        self.dz = self.dx = self.W = 0.0

    def to(self, dz, dx, steps):
        z0, x0 = self.dz, self.dx
        for i in range(1, steps + 1):
            z, x = z0 + (dz - z0) * i / steps, x0 + (dx - x0) * i / steps
            step = x - self.dx
            for j, g in enumerate(self.g):
                if g > z:
                    self.u[j] = 0.0
                    continue
                bound = 0.4 * self.cN / self.cT * (z - g)
                u = min(max(self.u[j] + step, -bound), bound)
                self.W += self.cT * self.weight[j] * u * (step - (u - self.u[j]))
                self.u[j] = u
            self.dz, self.dx = z, x

    def to_rig(self, dz, d, K):
        """Goes to delta_x + F_x/K = d in one step, found by the secant method on copies."""
        before, last = (self.u[:], self.dz, self.dx, self.W), (self.dx, d)
        for _ in range(12):
            off = []
            for x in last:
                self.u, self.dz, self.dx, self.W = before[0][:], *before[1:]
                self.to(dz, x, 1)
                off.append(x + self.force() / K - d)
            if abs(off[1]) < 1e-15 or last[0] == last[1]:
                return
            last = last[1], last[1] - off[1] * (last[1] - last[0]) / (off[1] - off[0])

    def force(self):
        return self.cT * sum(w * u for w, u in zip(self.weight, self.u))

    def normal(self):
        return self.cN * sum(w * max(self.dz - g, 0) for w, g in zip(self.weight, self.g))


PATH = [(3, 0.5), (4, 0.9), (4, -0.2), (3.2, 0.1), (3.6, 0.7), (2.4, 0.3), (3, 2.5), (3, -2.5)]  # dz, dx in um


@functools.lru_cache(None)
def by_springs(k):
    springs, states = Springs(500, k), []
    springs.to(3e-6, 0, 1)
    for z, x in PATH:
        springs.to(z * 1e-6, x * 1e-6, 120)
        states.append((springs.normal(), springs.force(), springs.W))
    return states


def histories(tests):
    """Oblique histories by displacements, against springs."""
    for k in tests.some((0.5, 0.0, -0.3)):
        script = "material E0=210 GPa nu=0.3 k=%g c0=1 mm; geometry sphere R=10 mm; friction 0.4; press dz=3 um\n" % k
        for i, ((z, x), (FN, Fx, W)) in enumerate(zip(PATH, by_springs(k))):
            script += "step dz=%g um dx=%g um\n" % (z, x)
            got = values(tests, script + "FN, Fx, W, dz, dx")
            name = "springs, k = %g, step %d: " % (k, i + 1)
            close(tests, name + "FN", FN, got.get("FN"), 2e-4)
            ok = bool(got) and abs(got["Fx"] - Fx) < 7e-3 * 0.4 * FN
            tests.check(name + "Fx", ok, "expected %g, got %r" % (Fx, got.get("Fx")))
            close(tests, name + "W", W, got.get("W"), 2.5e-2)
            close(tests, name + "dz", z * 1e-6, got.get("dz"), 1e-14)
            close(tests, name + "dx", x * 1e-6, got.get("dx"), 1e-14)


def rig(tests):
    """A history driven at the rig is the same history; a loop over drig has the same area; a swinging F_N, against springs."""
    K, names = 80e6, ("Fx", "dx", "dz", "W", "U", "c")
    for k in tests.some((0.5, 0.0, -0.3)):
        scene = "material E0=210 GPa nu=0.3 k=%g c0=1 mm; geometry sphere R=10 mm; friction 0.4; rig stiffness=80 N/um\n" % k
        own = by_rig = scene + "press dz=3 um\n"
        for i, (z, x) in enumerate(PATH):
            own += "step dz=%g um dx=%g um\n" % (z, x)
            want = values(tests, own + "drig, " + ", ".join(names))
            by_rig += "step dz=%g um drig=%.17g m\n" % (z, want["drig"])
            got = values(tests, by_rig + ", ".join(names))
            for name in names:
                close(tests, "rig, k = %g, step %d: %s" % (k, i + 1, name), want[name], got.get(name), 1e-13 if name != "W" else 1e-12)
            close(tests, "rig, k = %g, step %d: drig" % (k, i + 1), want["dx"] + want["Fx"] / K, want["drig"], 1e-15)
        for amplitude in ("1.3 um", "4 um"):  # partial slip; gross slip
            M = 400
            done = tests.run("--format=json", "-c", scene + "press dz=3 um; cycle drigA=%s\ntable drig, dx, Fx, dW along cycle steps %d" % (amplitude, M))
            rows = [row for row in harness.told(done.stdout) if "time" in row]
            if not tests.check("rig, k = %g: the loop of %s" % (k, amplitude), len(rows) == M + 1, tests.report(done)):
                continue
            area = [sum((a["Fx"] + b["Fx"]) / 2 * (b[x] - a[x]) for a, b in zip(rows, rows[1:])) for x in ("drig", "dx")]
            close(tests, "rig, k = %g, %s: the area is that over dx" % (k, amplitude), area[1], area[0], 1e-12)
            close(tests, "rig, k = %g, %s: and dW" % (k, amplitude), rows[-1]["dW"], area[0], (2 * pi / M) ** 2)
            at = max(abs(row["drig"] - rows[0]["drig"] * math.cos(2 * pi * (row["time"] - rows[0]["time"]))) for row in rows)
            tests.check("rig, k = %g, %s: a sine in time" % (k, amplitude), at < 1e-14 * 1e-6, "%g" % at)
    cN = 210e9 / 0.91 / 2
    springs = Springs(400)
    to = lambda s: springs.to_rig((0.75 * (100 + 30 * math.cos(s + pi / 2)) / cN / 0.1) ** (2 / 3), 1.5e-6 * math.cos(s), K)
    springs.to((75 / cN / 0.1) ** (2 / 3), 0, 1)
    to(0)
    for i in range(1, 257):
        if i == 129:
            W = springs.W
        to(2 * pi * i / 128)
    got = values(tests, "material E0=210 GPa nu=0.3; geometry sphere R=10 mm; friction 0.4; rig stiffness=80 N/um; press FN=100 N\n"
                 "cycle drigA=1.5 um FNA=30 N phase=90 deg times 2; dW, Fx, dx, drig; 1*dW at K_rig = 1e15 N/um\n"
                 "press FN=100 N; cycle dxA=1.5 um FNA=30 N phase=90 deg times 2; 2*dW")
    close(tests, "rig, swinging: dW against springs", springs.W - W, got.get("dW"), 1e-2)
    close(tests, "rig, swinging: a stiff one is none", got["2*dW"] / 2, got.get("1*dW"), 1e-7)
    close(tests, "rig, swinging: Fx against springs", springs.force(), got.get("Fx"), 1e-2)
    close(tests, "rig, swinging: drig", 1.5e-6, got.get("drig"), 1e-15)


RAMPS = ("FN=180 N dx=-0.3 um", "dz=2 um Fx=8 N", "FN=60 N dx+=0.5 um", "dz=6 um Fx=-20 N", "FN=90 N Fx=10 N", "dz=3 um dx=0.1 um",
         "FN=50 N")


def on_the_way(tests):
    """Intermediate points do not change the end state, and between them the work of F_x is what is stored and dissipated."""
    scene = "material E0=210 GPa nu=0.3 k=0.3 c0=1 mm; geometry %s; friction 0.35; press FN=100 N\n"
    for shape in tests.some(("flat-rounded b=0.1 mm R=10 mm", "sphere R=10 mm", "exact-sphere R=10 mm")):
        before = scene % shape
        for ramp in RAMPS:
            name = "%s, %s: " % (shape, ramp)
            want = values(tests, before + "step %s; FN, dz, Fx, dx, W, U" % ramp)
            start = values(tests, before + "W, U")
            for model in ("auto", "memory"):
                done = tests.run("--format=json", "-c", "set model %s\n%stable FN, dz, Fx, dx, W, U along step %s steps 500"
                                 % (model, before, ramp))
                rows = [row for row in harness.told(done.stdout) if "time" in row]
                if not want or not start or not tests.check(name + model, len(rows) == 501, tests.report(done)):
                    return
                off = max(abs(rows[-1][n] - want[n]) / (abs(want[n]) + 1e-3 * abs(want["W"] + want["U"])) for n in want)
                tests.check(name + "the end, " + model, off < 1e-11, "%g" % off)
                work = math.fsum((a["Fx"] + b["Fx"]) / 2 * (b["dx"] - a["dx"]) for a, b in zip(rows, rows[1:]))
                close(tests, name + "the work, " + model, want["W"] + want["U"] - start["W"] - start["U"], work,
                      2e-5 if "dx" in ramp or "Fx" in ramp else 1)
            before += "step %s\n" % ramp


def integrals(tests):
    """The integral of the pressure is the force, for every shape; for k < 0 the pressure is infinite at the edge of a flat end."""
    shapes = list(SHAPES) + ["flat-cone b=0.2 mm slope=0.001", "flat-paraboloid b=0.2 mm R=500 mm"]
    for command, k in tests.some(((command, k) for k in (-0.9, -0.5, -0.2, 0.0, 0.3, 0.8) for command in shapes), 12):
        if k < -0.5 and "flat-" in command and "0.001" not in command and "500" not in command:
            continue  # the contact ends at the flat end, to the last digit
        got = values(tests, "material E0=210 GPa nu=0.3 k=%g c0=1 mm; geometry %s; friction 0.4; press FN=100 N\nstep Fx=25 N\n"
                     "(integral 2*pi*r*p(r) for r = 0 m .. a), (integral pi*abs(r)*p(abs(r)) for r = -2*a .. a), "
                     "(integral 2*pi*r*qx(r) for r = 0 m .. a)" % (k, command))
        force, wide, traction = got.values() if len(got) == 3 else (None,) * 3
        close(tests, "%s, k = %g: integral of p" % (command, k), 100, force, 1e-12)
        close(tests, "%s, k = %g: integral of p from beyond the contact" % (command, k), 100, wide, 1e-12)
        close(tests, "%s, k = %g: integral of q_x" % (command, k), 25, traction, 1e-12)


def slivers(tests):
    """A contact that reaches only a little beyond a flat end: p follows another law within that distance. Its integral is right as long
    as a double resolves the distance; below, within the error that `explain` states, or it is refused."""
    steep = ("flat-cone b=0.2 mm slope=0.05", "flat-cone b=0.2 mm slope=1", "flat-paraboloid b=0.2 mm R=1 mm",
             "flat-paraboloid b=0.2 mm R=10 mm", "flat-paraboloid b=0.2 mm R=100 mm", "flat-rounded b=0.2 mm R=0.1 mm")
    told = 0
    for k, command in tests.some(((k, command) for k in (-0.9, -0.7, -0.5, -0.3, -0.1) for command in steep), 5):
        name = "%s, k = %g: integral of p over a hair" % (command, k)
        force = "(integral 2*pi*r*p(r) for r = 0 m .. a)"
        scene = "material E0=210 GPa nu=0.3 k=%g c0=1 mm; geometry %s; press FN=100 N\n" % (k, command)
        hair = values(tests, scene + "a/b - 1").get("a/b - 1")
        done = tests.run("--format=json", "--quiet", "-c", scene + force)
        if done.returncode:
            tests.check(name, re.search("does not converge|is a singularity", done.stderr) and 0 < hair < 1e-13, tests.report(done))
            continue
        told += 1
        explained = tests.run("-c", scene + "explain " + force).stdout
        error = re.search(r"error: below (\S+) of the integral", explained)
        if not tests.check(name + ": its error is told", error, explained):
            continue
        got = [row["value"] for row in harness.told(done.stdout) if "value" in row]
        close(tests, name, 100, got[0] if got else None, 1e-12 if hair > 1e-11 or hair == 0 else float(error.group(1)))
    tests.check("integrals over a hair", told)


def stiffened(tests):
    """The warning for dissimilar bodies: without slip a rigid punch is (1-nu) ln(3-4nu)/(1-2nu) times as stiff (Mossakovskii; Handbook
    of Contact Mechanics, (2.141); any shape, Spence 1968). No warning where this does not apply."""
    for nu in (-0.3, 0.0, 0.1, 0.2, 1 / 3, 0.4, 0.45):
        part = 100 * ((1 - nu) * math.log(3 - 4 * nu) / (1 - 2 * nu) - 1)
        done = tests.run("-c", "material E0=1 GPa nu=%.17g; second rigid; geometry sphere R=10 mm; friction 0.4; press FN=1 N; step Fx=0.1 N" % nu)
        tests.check("stiffened, nu = %g" % nu, "kn is up to %.2g %% too small" % part in done.stderr, tests.report(done))
    done = tests.run("-c", "material E0=1 GPa nu=0.5; second rigid; geometry sphere R=10 mm; friction 0.4; press FN=1 N; step Fx=0.1 N")
    tests.check("stiffened, nu = 0.5", done.returncode == 0 and not done.stderr, tests.report(done))


def run(tests):
    tests.each([lambda: integrals(tests), lambda: slivers(tests), lambda: stiffened(tests), lambda: published(tests), lambda: corners(tests), lambda: material(tests), lambda: shapes(tests),
                lambda: gap_file(tests), lambda: dense_file(tests), lambda: dense_fields(tests), lambda: tip_in_rows(tests), lambda: whole_gap(tests),
                lambda: swinging_rows(tests), lambda: hardly_moved_rows(tests),
                lambda: histories(tests), lambda: rig(tests), lambda: on_the_way(tests)])
