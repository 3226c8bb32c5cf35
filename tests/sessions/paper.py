# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests the scripts of the paper's figures: their numbers against tests/reference/figures.csv, and the trends that they show."""
import csv
import decimal
import glob
import math
import os
import re

import harness

FOLDER = os.path.join(harness.ROOT, "scripts/paper")
TOLERANCE = 1e-12
RATIO = {"0.5*a0": "0.5", "a0": "1", "2*a0": "2"}


def scripts():
    found = {}
    for path in sorted(glob.glob(os.path.join(FOLDER, "*.txt"))):
        with open(path, encoding="utf-8") as f:
            found[os.path.basename(path)[:-4]] = f.read().splitlines()
    return found


def reference():
    """{panel: {curve: rows of numbers}}"""
    rows = {}
    with open(os.path.join(harness.ROOT, "tests/reference/figures.csv"), encoding="utf-8") as f:
        for row in csv.DictReader(line for line in f if not line.startswith("#")):
            rows.setdefault(row["panel"], {}).setdefault((row["k"], row["c0/a0"]), []).append(
                (float(row["t"] or "nan"), float(row["x"]), float(row["y"])))
    return rows


def objects(done):
    """The JSON objects printed, without the reports of press and cycle."""
    return [row for row in harness.told(done.stdout) if "event" not in row]


def table_of(plot, steps):
    """A table statement with the abscissa and ordinate of the plot, and the values of its curves."""
    if plot.startswith("plot E with"):
        plot = plot.replace("plot E", "plot z/c0 against E(z)/E0 for z = 0 m .. 2*c0")
    found = re.match(r"plot (.*?)(?: against (.*?))? (for|along) (.*?)(?: with (\w+)=(.*?))?(?: xlabel .*)?$", plot)
    y, x, word, over, name, values = found.groups()
    x = x or "time"
    return ("table %s, %s %s %s steps %d%s" % (x, y, word, over, steps, " with %s=%s" % (name, values) if name else ""),
            [v.strip() for v in values.split(",")] if name else [None], name)


def curves_of(tests, panel, lines, steps):
    """The points of each curve of the script's plot."""
    table, values, name = table_of(lines[-1], steps)
    done = tests.run("--format=json", "-c", "\n".join(lines[:-1] + [table]))
    if not tests.check("fig. %s runs" % panel, done.returncode == 0, tests.report(done)):
        return {}
    rows = [list(row.values()) for row in objects(done)]
    each = len(rows) // len(values)
    k = re.search(r" k=(\S+)", lines[1])
    curves = {}
    for i, value in enumerate(values):
        key = (value if name == "k" else k.group(1) if k else "0", RATIO[value] if name == "c0" else "1")
        curves[key] = [row[-2:] for row in rows[i * each:(i + 1) * each]]
    return curves


def near(want, got, scale):
    """Equal to 1e-12 of the number, or, near a zero of the curve, of the curve?"""
    return got is not None and abs(want - got) <= TOLERANCE * max(abs(want), 0.01 * scale)


def panel(tests, name, lines, want):
    steps = {len(points) - 1 for points in want.values()}
    if name == "13":
        steps = {10}
    curves = curves_of(tests, name, lines, steps.pop())
    tests.check("fig. %s: its curves" % name, set(curves) == set(want), "%s\n%s" % (sorted(curves), sorted(want)))
    for key in sorted(set(curves) & set(want)):
        got = [p for p in curves[key] if None not in p] if name == "13" else curves[key]
        scale = [max(abs(p[i]) for p in want[key]) for i in (1, 2)]
        bad = [(p, q) for p, q in zip(want[key], got)
               if not (near(p[1], q[0], scale[0]) and near(p[2], q[1], scale[1]))]
        tests.check("fig. %s, k = %s, c0/a0 = %s: numbers" % (name, *key), len(got) == len(want[key]) and not bad,
                    "%d points of %d\n%s" % (len(got), len(want[key]), bad[:3]))
    return curves


def ordered(tests, name, ends):
    tests.check(name, all(a < b for a, b in zip(ends, ends[1:])), str(ends))


def seen(tests, all_curves):
    """Trends: larger k is softer with more loss; larger c0 is softer with more loss for k > 0, stiffer with less for k < 0."""
    ks = ("-0.7", "-0.5", "0", "0.5", "0.7")
    ratios = ("0.5", "1", "2")
    for n in ("7", "9"):
        curves = all_curves[n + "a"]
        ordered(tests, "fig. %sa: softer with k" % n, [max(p[0] for p in curves[(k, "1")]) for k in ks])
        ordered(tests, "fig. %sb: more loss with k" % n, [all_curves[n + "b"][(k, "1")][-1][1] for k in ks])
    for n, k, order in (("8a", "-0.5", -1), ("8c", "0.5", 1), ("10a", "-0.5", -1), ("10c", "0.5", 1)):
        loss = n[:-1] + {"a": "b", "c": "d"}[n[-1]]
        ordered(tests, "fig. %s: with c0" % n,
                [max(p[0] for p in all_curves[n][(k, r)]) for r in ratios][::order])
        ordered(tests, "fig. %s: with c0" % loss, [all_curves[loss][(k, r)][-1][1] for r in ratios][::order])
    ordered(tests, "fig. 4: softer with k", [all_curves["4"][(k, "1")][-1][0] for k in ("-0.5", "0", "0.5")])
    for n in ("6a", "6b"):
        W = [p[1] for p in all_curves[n][("0", "1")]]
        tests.check("fig. %s: monotone at first, not later" % n,
                    all(a > b for a, b in zip(W[:4], W[1:5])) and any(a > b for a, b in zip(W[5:8], W[6:9])) and
                    any(a < b for a, b in zip(W[5:8], W[6:9])), str(W))


def losses(tests, found):
    """(27) against the loop that is run, W1D against (22), and (28), Mindlin and Deresiewicz."""
    for name in ("fig07b", "fig09b"):
        for k in ("-0.7", "-0.5", "0", "0.5", "0.7"):
            script = "\n".join(found[name][:-1] + [
                "k = " + k, "dW(0.9*mu*FN)", "cycle FA=0.9*mu*FN", "set model memory", "dW",
                "-4*(W1D)", "W - dW/4"])
            done = tests.run("--format=json", "-c", script)
            values = [row["value"] for row in objects(done)]
            what = "%s, k = %s" % (name, k)
            if not tests.check(what + " runs", done.returncode == 0 and len(values) == 4, tests.report(done)):
                continue
            closed, loop, work, lost = values
            tests.check(what + ": (27) and the loop", math.isclose(closed, loop, rel_tol=1e-12), str(values))
            tests.check(what + ": 4 max |W1D| is the loss", math.isclose(closed, work, rel_tol=1e-12), str(values))
            tests.check(what + ": the program lost first loading and a cycle", math.isclose(closed, lost, rel_tol=1e-12),
                        str(values))
    E0, nu, mu, FN, R = (decimal.Decimal(x) for x in ("210e9", "0.3", "0.4", "100", "0.01"))
    G, E = E0 / (2 * (1 + nu)), E0 / (2 * (1 - nu ** 2))
    third = 1 / decimal.Decimal(3)
    a = (3 * FN * R / (4 * E)) ** third
    script = "\n".join(found["fig12"][:-1] + ["table dW(t*mu*FN) for t = 0.1 .. 1 steps 9"])
    done = tests.run("--format=json", "-c", script)
    for i, row in enumerate(objects(done), 1):
        t = decimal.Decimal(i) / 10
        s = (1 - t) ** third if t < 1 else decimal.Decimal(0)
        want = 9 * (2 - nu) * (mu * FN) ** 2 / (5 * G * a) * (1 - s ** 5 - 5 * t / 6 * (1 + s ** 2))
        loss = list(row.values())[-1]
        tests.check("fig. 12, k = 0: Mindlin and Deresiewicz at %s" % t, math.isclose(want, loss, rel_tol=1e-12),
                    "%s %r" % (want, loss))
    same = [re.sub(r" for .*", "", found[n][-1]) for n in ("fig09b", "fig12")]
    tests.check("figs. 9b and 12 are of one scene", found["fig09b"][1:-1] == found["fig12"][1:-1] and same[0] == same[1])


def demos(tests, found):
    """`demo` plays each script, in any directory; undo brings back the scene before it."""
    def one(name):
        done = tests.run("-c", "mu = 0.123\ndemo %s\nundo; mu" % name, cwd=tests.dir)
        drawn = found[name][-1].startswith("animate") or "+--" in done.stdout
        tests.check("demo " + name, done.returncode == 0 and drawn and done.stdout.endswith("mu = 0.123\n") and
                    "fret> " + found[name][-1] in done.stdout, tests.report(done))
        tests.check("%s has at most six lines" % name, len(found[name]) <= 6, "\n".join(found[name]))
    tests.each([lambda n=name: one(n) for name in found])
    wrong = tests.run("-c", "demo fig7a")
    tests.check("a demo that is none", "did you mean fig07a?" in wrong.stderr, tests.report(wrong))


# Equations that `explain` must cite: for a power law on first loading and later, another shape, a history.
PRESSED = "material E0=100 GPa nu=0.3 k=0.2 c0=1 mm; geometry sphere R=10 mm; friction 0.5; press FN=100 N"
SHAPED = PRESSED.replace("sphere", "exact-sphere")
BY_CASE = (
    (PRESSED + "; step Fx=20 N",
     {"dz": "(10)", "a": "(10),(13)", "FN": "(13)", "Fx": "(16),(18)", "dx": "(15),(17)", "c": "(18)", "kt": "(17),(18)",
      "kn": "(10),(13)", "dz0": "(10)", "a0": "(23)", "dxmax": "(17) with c = 0", "dx0max": "(17) with c = 0",
      "dW(20 N)": "(27)", "nu": "(4),(5),(A1),(A2),(A3)", "hN": "(A1)", "hT": "(A2)", "beta_k": "(A3)", "kappa": "(8)",
      "g(0.1 mm)": "(7)", "f(0.1 mm)": "(6)", "E(1 mm)": "(1)", "cN(0.1 mm)": "(4)", "cT(0.1 mm)": "(5)",
      "w1D(0.1 mm)": "(9)", "qz1D(0.1 mm)": "(11)", "qx1D(0.1 mm)": "(14)", "u1D(0.1 mm)": "(19),(20)",
      "s1D(0.1 mm)": "(20)", "W1D": "(22)", "p(0.1 mm)": "inverse of (3)", "U": None, "W": None}),
    # a closed cycle ends on the curve of first loading
    (PRESSED + "; cycle FA=20 N", {"dW": "(27)", "dx": "(15),(17)", "c": "(18)"}),
    (PRESSED + "; step Fx=20 N; step Fx=-5 N", {"dx": None, "c": None, "kt": None}),
    (SHAPED + "; step Fx=20 N",
     {"dz": "(10)", "a": "(10),(12)", "FN": "(12)", "Fx": "(16)", "dx": "(15)", "c": "(16)", "dW(20 N)": "(26)",
      "g(0.1 mm)": "(3)", "kn": "(10),(12)", "kt": "(15),(16)", "dxmax": "(15) with c = 0", "dx0max": "(15) with c = 0"}),
    (PRESSED + "; cycle FA=20 N FNA=30 N phase=90 deg", {"dW": None, "Fx": None, "dx": None, "c": None, "W": None}),
)


def equations(tests):
    """`help paper` lists every equation, and `explain` cites the right one."""
    want = ["(%d)" % i for i in range(1, 29)] + ["(A%d)" % i for i in range(1, 4)]
    listed = tests.run("-c", "help paper").stdout.split("Slips", 1)[0]
    numbers = re.findall(r"^(\(A?\d+\))  +\S", listed, re.M)
    tests.check("help paper: every equation", numbers == want, listed)
    for scene, wanted in BY_CASE:
        done = tests.run("-c", scene + "; " + "; ".join("explain " + name for name in wanted))
        parts = re.split(r"^(?=[A-Za-z_0-9]+(?:\([^)]*\))?: )", done.stdout, flags=re.M)
        named = {}
        for part in parts:
            head = re.split(r"\n    (?=\S)", part)
            if len(head) > 1:
                number = re.search(r"  ((?:inverse of )?\(A?\d+\)\S*(?: with c = 0)?)$", head[1].strip("\n"))
                named[head[0].split(":")[0]] = number.group(1) if number else None
        for name, number in wanted.items():
            short = name.split("(")[0]
            got = named.get(name, named.get(short, "nothing"))
            tests.check("explain %s after %s" % (name, scene.split("N; ")[-1]), got == number,
                        "%s, not %s\n%s" % (got, number, tests.report(done)))


def run(tests):
    equations(tests)
    found, want = scripts(), reference()
    panels = {re.sub(r"^fig0?", "", name): name for name in found if name.startswith("fig")}
    tests.check("a script for each panel", set(panels) == {p for p in want if not p.endswith(" J")} and
                {"s1", "s2", "s3"} <= set(found), str(sorted(panels)))
    curves = {}
    for name in panels:
        if name == "11":
            continue
        curves[name] = panel(tests, name, found[panels[name]], want[name])
    # the spring of figure 11: its force over its bound, and its slip
    lines = found["fig11"][:-1] + ["plot qx1D(x1) against s1D(x1) along cycle FA=0.9*mu*FN"]
    panel(tests, "11", lines, want["11"])
    if all(curves.values()):
        seen(tests, curves)
    losses(tests, found)
    demos(tests, found)
