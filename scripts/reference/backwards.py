#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""backwards.csv: questions asked backwards of power-law contacts, `solve` and `maximize`, and how sharply
the answers are determined by what is given."""

from mpmath import mp, mpf

import oracle

mp.dps = 120
SMALL = mpf(10)**-30  # relative step of central differences: exact to some 55 digits


class Values:
    """The quantities of a scene from inputs by name; A r^n from R, slope, A or h and r0."""

    def __init__(self, given):
        v = dict(given)
        self.FN, self.FA, self.mu = v["FN"], v.get("FA"), v["mu"]
        n = v.get("n", mpf(1) if "slope" in v else mpf(2))
        if "R" in v:
            A = 1 / (2 * v["R"])
        elif "slope" in v:
            A = v["slope"]
        elif "h" in v:
            A = v["h"] / v["r0"]**n
        else:
            A = v["A"]
        E, nu, k, c0 = v["E0"], v["nu"], v.get("k", mpf(0)), v.get("c0", mpf(1))

        def scene(k):
            return oracle.Scene(E, nu, 0, v.get("E0_2", E), v.get("nu_2", nu), 0, k, c0, n, A, mpf(1), self.mu)
        self.s = scene(k)
        self.a = self.s.radius_of_force(self.FN)
        self.a0 = scene(mpf(0)).radius_of_force(self.FN)
        self.dz = self.s.g(self.a)
        self.dxmax = self.mu * self.s.eta * self.dz
        self.q = 1 / self.s.p
        self.kn = self.s.slope(self.a)

    def dW(self, FA=None):
        t = (self.FA if FA is None else FA) / (self.mu * self.FN)
        assert 0 < t < 1
        return oracle.share(self.q, t) * self.mu * self.FN * self.dxmax

    def dWd(self, d):
        """dW at an amplitude of displacement, gross slip included."""
        u = d / self.dxmax
        t = 1 - (1 - min(u, 1))**(1 / self.q)
        return self.mu * self.FN * (oracle.share(self.q, t) * self.dxmax + 4 * max(d - self.dxmax, 0))

    def dx(self, F):
        return self.dxmax * (1 - (1 - F / (self.mu * self.FN))**self.q)

    def c(self, F):
        return self.s.radius_of_force(self.FN - F / self.mu)


def number(text):
    units = {"GPa": mpf(10)**9, "mm": mpf(10)**-3, "um": mpf(10)**-6, "uJ": mpf(10)**-6, "N": mpf(1),
             "m^-3": mpf(1), "m^-2": mpf(1)}
    value, _, unit = text.partition(" ")
    return mpf(value) * (units[unit] if unit else 1)


def setup(given):
    """Inputs (text) as statements and as numbers."""
    g = given
    line = f"material E0={g['E0']} nu={g['nu']}"
    if "k" in g:
        line += f" k={g['k']} c0={g['c0']}"
    if "E0_2" in g:
        line += f"; second E0={g['E0_2']} nu={g['nu_2']}"
    if "R" in g:
        line += f"; geometry paraboloid R={g['R']}"
    elif "slope" in g:
        line += f"; geometry cone slope={g['slope']}"
    else:
        line += "; geometry power " + " ".join(f"{x}={g[x]}" for x in ("n", "A", "h", "r0") if x in g)
    line += f"; friction {g['mu']}; press FN={g['FN']}"
    if "step" in g:
        line += f"; step Fx={g['step']}"
    for x in ("FA", "dxA"):
        if x in g:
            line += f"; cycle {x}={g[x]}"
    return line, {name: number(x) for name, x in g.items()}


def partial(f, given, *names):
    """Derivative of f by the relative change of each name in turn."""
    if not names:
        return f(given)
    name, rest = names[0], names[1:]
    up, down = ({**given, name: given[name] * (1 + sign * SMALL)} for sign in (1, -1))
    return (partial(f, up, *rest) - partial(f, down, *rest)) / (2 * SMALL)


def grid(lo, hi, n):
    return [lo + (hi - lo) * mpf(i) / n for i in range(n + 1)]


def solve(given, question, name, f, target, lo, hi, rows, unit):
    """The one root between lo and hi; f gives EXPR from the inputs, its wanted value is an input too."""
    line, values = setup(given)
    values["target"] = number(target)

    def miss(g):
        return f(g) / g["target"] - 1
    xs = grid(mpf(lo), mpf(hi), 60)
    signs = [mp.sign(miss({**values, name: x})) for x in xs]
    turns = [i for i in range(60) if signs[i] != signs[i + 1]]
    assert len(turns) == 1, (question, len(turns))
    x = mp.findroot(lambda x: miss({**values, name: x}), (xs[turns[0]], xs[turns[0] + 1]),
                    solver="anderson", tol=mpf(10)**-150)
    at = {**values, name: x}
    own = partial(miss, at, name)
    condition = sum(abs(partial(miss, at, other) / own)
                    for other in values if other != name and values[other] != 0)
    assert abs(miss(at)) < mpf(10)**-60
    rows.append((line, question, name, x, unit, condition, None))


def best(given, question, f, ranges, sign, rows, units, last_unit):
    """The greatest (sign 1) or least value of f over a box, each answer in a row."""
    line, values = setup(given)
    names = list(ranges)
    box = {x: (number(lo), number(hi)) for x, (lo, hi) in ranges.items()}
    n = 300 if len(names) == 1 else 30
    points = [{}]
    for x in names:
        points = [{**p, x: y} for p in points for y in grid(*box[x], n)]
    with mp.workdps(40):
        heights = [sign * f({**values, **p}) for p in points]
    if len(names) == 1:  # one hill
        assert sum(heights[i - 1] < heights[i] >= heights[i + 1] for i in range(1, n)) <= 1
    at = {**values, **points[max(range(len(points)), key=heights.__getitem__)]}
    free = [x for x in names if at[x] not in box[x]]
    for _ in range(40 if free else 0):  # Newton on the gradient in the logarithms
        G = mp.matrix([partial(f, at, x) for x in free])
        H = mp.matrix(len(free))
        for i, x in enumerate(free):
            for j, y in enumerate(free):
                H[i, j] = partial(f, at, x, y)
        step = -(H**-1 * G)
        biggest = max(abs(v) for v in step)
        for i, x in enumerate(free):
            at[x] *= 1 + step[i] * min(1, mpf("0.2") / biggest)
        if biggest < mpf(10)**-36:
            break
    else:
        assert not free, question
    value = f(at)
    if names != free:  # at an edge f goes on rising outwards
        for x in set(names) - set(free):
            outwards = 1 if at[x] == box[x][1] else -1
            assert sign * outwards * partial(f, at, x) > 0
    assert sign * value >= max(heights) * (1 - mpf(10)**-20) if max(heights) > 0 else True
    others = [o for o in values if o not in names and values[o] != 0]
    if free:
        for i in range(len(free)):
            assert sign * H[i, i] < 0
        inverse = H**-1
    for x in names:
        if x in free:
            i = free.index(x)
            moves = [sum(inverse[i, j] * partial(f, at, y, o) for j, y in enumerate(free))
                     for o in others + [e for e in names if e not in free]]
            rows.append((line, question, x, at[x], units[x], sum(abs(m) for m in moves),
                         abs(1 / (inverse[i, i] * value))))
        else:
            rows.append((line, question, x, at[x], units[x], mpf(1), None))
    condition = sum(abs(partial(f, at, o) / value) for o in others + [x for x in names if x not in free])
    rows.append((line, question, "value", value, last_unit, condition, None))


def quantity(name, argument=None):
    """f of the inputs: an attribute of Values, or a function of it of another input."""
    def f(g):
        v = getattr(Values(g), name)
        return v(g.get(argument)) if callable(v) else v
    return f


STEEL = {"E0": "210 GPa", "nu": "0.3", "R": "10 mm", "mu": "0.4", "FN": "100 N"}
GRADED = {**STEEL, "k": "0.2", "c0": "1 mm"}
SOFT = {**STEEL, "k": "0.5", "c0": "1 mm"}
CONE = {"E0": "210 GPa", "nu": "0.3", "slope": "0.05", "mu": "0.4", "FN": "100 N"}
CYCLED = {**STEEL, "FA": "20 N"}

rows = []
for args in (
        (CYCLED, "solve mu for dW = 1 uJ", "mu", quantity("dW"), "1 uJ", "0.2001", "20", ""),
        (STEEL, "solve FN for a = 0.2 mm", "FN", quantity("a"), "0.2 mm", "1", "1000", "N"),
        (CYCLED, "solve FA for dW = 1 uJ", "FA", quantity("dW"), "1 uJ", "0.1", "39.99", "N"),
        (GRADED, "solve k for a/a0 = 1.2", "k", lambda g: Values(g).a / Values(g).a0, "1.2", "-0.9", "0.9", ""),
        (STEEL, "solve R for a = 0.2 mm", "R", quantity("a"), "0.2 mm", "1e-4", "1", "m"),
        (CONE, "solve slope for dz = 5 um", "slope", quantity("dz"), "5 um", "1e-4", "1", ""),
        (SOFT, "solve c0 for a = 0.25 mm", "c0", quantity("a"), "0.25 mm", "1e-5", "1e-1", "m"),
        ({**SOFT, "F": "20 N"}, "solve E0 for dx(20 N) = 1 um", "E0", quantity("dx", "F"), "1 um",
         "1e9", "1e13", "Pa"),
        ({**GRADED, "F": "20 N"}, "solve nu for dW(20 N) = 3 uJ", "nu", quantity("dW", "F"), "3 uJ", "0.001", "0.5",
         ""),
        ({**GRADED, "step": "20 N"}, "solve mu for c/a = 0.5", "mu",
         lambda g: Values(g).c(g["step"]) / Values(g).a, "0.5", "0.2001", "10", ""),
        ({"E0": "210 GPa", "nu": "0.3", "k": "-0.4", "c0": "1 mm", "n": "3", "h": "1 um", "r0": "0.1 mm", "mu": "0.4",
          "FN": "100 N"}, "solve n for a = 0.1 mm from 1 to 8", "n", quantity("a"), "0.1 mm", "1", "8", ""),
        ({**STEEL, "E0_2": "70 GPa", "nu_2": "0.33"}, "solve E0_2 for a = 0.25 mm", "E0_2", quantity("a"), "0.25 mm",
         "1e9", "1e13", "Pa"),
        ({**SOFT, "FA": "20 N"}, "solve FN for dW = 5 uJ", "FN", quantity("dW"), "5 uJ", "50.01", "1000", "N"),
        ({**CONE, "dxA": "10 um"}, "solve dxA for dW = 2 mJ", "dxA", quantity("dWd", "dxA"), "2000 uJ",
         "1e-6", "1e-3", "m")):
    given, question, name, f, target, lo, hi, unit = args
    solve(given, question, name, f, target, lo, hi, rows, unit)

# Constants of a question are inputs too, under names of their own.
SLIDING, SLIDING_SOFT = {**STEEL, "d": "0.5 um"}, {**SOFT, "d": "0.5 um"}
best({**STEEL, "mu": "0.9", "F": "5 N"}, "maximize dW(5 N) over FN = 6 N .. 100 N", quantity("dW", "F"),
     {"FN": ("6 N", "100 N")}, 1, rows, {"FN": "N"}, "J")
best(SLIDING, "maximize dWd(0.5 um) over FN = 1 N .. 100 N", quantity("dWd", "d"),
     {"FN": ("1 N", "100 N")}, 1, rows, {"FN": "N"}, "J")
best(SLIDING_SOFT, "maximize dWd(0.5 um) over mu = 0.01 .. 1", quantity("dWd", "d"), {"mu": ("0.01", "1")}, 1, rows,
     {"mu": ""}, "J")
best(CYCLED, "minimize dW over mu = 0.25 .. 1", quantity("dW"), {"mu": ("0.25", "1")}, -1, rows,
     {"mu": ""}, "J")
best({**GRADED, "c0": "0.2 mm"}, "minimize dz over k = -0.7 .. 0.7", quantity("dz"), {"k": ("-0.7", "0.7")}, -1,
     rows, {"k": ""}, "m")
best({**GRADED, "c0": "0.2 mm"}, "maximize kn over k = 0.01 .. 0.7", quantity("kn"), {"k": ("0.01", "0.7")}, 1,
     rows, {"k": ""}, "N/m")
best({**SLIDING, "middle": "20 mm", "wide": "20 mm"},
     "maximize dWd(0.5 um)*(1 - (R - 20 mm)^2/(20 mm)^2) over mu = 0.05 .. 0.6, R = 5 mm .. 35 mm",
     lambda g: Values(g).dWd(g["d"]) * (1 - (g["R"] - g["middle"])**2 / g["wide"]**2),
     {"mu": ("0.05", "0.6"), "R": ("5 mm", "35 mm")}, 1, rows, {"mu": "", "R": "m"}, "J")
best({**STEEL, "wide": "0.2 mm", "deep": "2 um"},
     "minimize (a/(0.2 mm) - 1)^2 + (dz/(2 um) - 1)^2 + 1 over FN = 20 N .. 200 N, R = 5 mm .. 50 mm",
     lambda g: (Values(g).a / g["wide"] - 1)**2 + (Values(g).dz / g["deep"] - 1)**2 + 1,
     {"FN": ("20 N", "200 N"), "R": ("5 mm", "50 mm")}, -1, rows, {"FN": "N", "R": "m"}, "")
best(SLIDING, "maximize dWd(0.5 um) over FN = 1 N .. 100 N, mu = 0.02 .. 0.4", quantity("dWd", "d"),
     {"FN": ("1 N", "100 N"), "mu": ("0.02", "0.4")}, 1, rows, {"FN": "N", "mu": ""}, "J")
oracle.write_cells(
    "backwards.csv", "backwards.py",
    ["answers of solve, maximize and minimize, SI units. name 'value': the optimum's value. condition: sum over all",
     "inputs (the target included) of relative change of the answer per relative change of the input; curvature, of",
     "a place inside the range: the objective's relative error e leaves the place within sqrt(2 e/curvature), relative"],
    ["setup", "question", "name", "value", "unit", "condition", "curvature"], rows)
