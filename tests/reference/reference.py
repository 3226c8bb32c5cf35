# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the program with tables made by independent code (scripts/reference): springs of the one-dimensional model, points
of the paper's figures, losses under swinging normal forces. Other tables are read by tests/unit and the room numbers."""
import csv
import os
import re

import harness

FIGURE = ("material E0=210 GPa nu=0.3; geometry %s; friction 0.4; press FN=100 N\n"
          "k = %s, c0 := %s*a0\nset format json\n")
CONE, PARABOLOID = "cone slope=0.05", "paraboloid R=10 mm"
# What the figures show: (shape, (expression of x, expression of y)).
LOSS = (None, "dW(%s*mu*FN)*E0*a0/(mu*FN)^2")
FIRST = ("dx(%s*mu*FN)/dx0max", None)
LOOP = ("dx/dx0max", "Fx/(mu*FN)")
WORK = ("time", "W1D*E0*a0/(mu*FN)^2")
PANELS = {"4": (CONE, FIRST), "5a": (CONE, FIRST), "5b": (CONE, FIRST), "6a": (CONE, WORK), "6b": (PARABOLOID, WORK),
          "6a J": (CONE, ("time", "W1D")), "6b J": (PARABOLOID, ("time", "W1D")), "7a": (CONE, LOOP), "7b": (CONE, LOSS),
          "8a": (CONE, LOOP), "8b": (CONE, LOSS), "8c": (CONE, LOOP), "8d": (CONE, LOSS), "9a": (PARABOLOID, LOOP),
          "9b": (PARABOLOID, LOSS), "10a": (PARABOLOID, LOOP), "10b": (PARABOLOID, LOSS), "10c": (PARABOLOID, LOOP),
          "10d": (PARABOLOID, LOSS), "11": (PARABOLOID, ("s1D(0.8*a)", "qx1D(0.8*a)")), "12": (PARABOLOID, LOSS),
          "13": (PARABOLOID, ("E(%s*c0)/E0", None))}
EXACT = 1e-12
SINE = 1e-9  # accuracy that is promised for the limit of infinitely many chords


def rows_of(name):
    with open(os.path.join(harness.ROOT, "tests/reference", name), encoding="ascii") as f:
        return list(csv.DictReader(line for line in f if not line.startswith("#")))


def grouped(rows, *keys):
    groups = {}
    for row in rows:
        groups.setdefault(tuple(row[key] for key in keys), []).append(row)
    return groups


def compared(tests, name, want, got, tolerance, scales=None):
    """Checks each number to within `tolerance` of the larger of itself and its scale."""
    if not tests.check(name + ": all have a value", len(want) == len(got) and None not in got,
                       "%d of %d: %s" % (len(got), len(want), got[:5])):
        return
    scales = scales or [abs(w) for w in want]
    wrong = ["%.17g, expected %.17g" % (g, w) for w, g, scale in zip(want, got, scales)
             if not abs(g - w) <= tolerance * max(abs(w), scale)]
    tests.check(name, not wrong, "%d of %d: %s" % (len(wrong), len(want), "; ".join(wrong[:4])))


def line(tests):
    """Springs of the 1D model: displacements relative to the largest one, line loads to that of the softest bound."""
    for (setup,), rows in grouped(rows_of("line.csv"), "setup").items():
        names = ("w1D", "u1D", "s1D", "qz1D", "qx1D", "cN", "cT")
        asked = [", ".join("%s(%s*a)" % (name, row["x/a"]) for name in names) for row in rows] + ["dz, dx"]
        given = bool(rows[0]["W1D"])
        if given:
            asked.append("W1D")
        done = tests.run("-c", setup + "\nset format json\n" + "\n".join(asked))
        want = [float(row[name]) for row in rows for name in names] + [float(rows[0]["dz"]), float(rows[0]["dx"])]
        scale = [float(row[name]) for row in rows for name in ("dz", "dx", "dx", "qz1D", "qz1D", "cN", "cT")] + \
            [float(rows[0]["dz"]), float(rows[0]["dz"])]
        if given:
            want.append(float(rows[0]["W1D"]))
            scale.append(0)
        compared(tests, "springs, " + setup, want, harness.printed_values(done.stdout), EXACT, list(map(abs, scale)))


def figure(tests, panel, k, ratio, rows):
    shape, (x, y) = PANELS[panel]
    name = "figure %s, k = %s, c0/a0 = %s" % (panel, k, ratio)
    scene = FIGURE % (shape, k, ratio)
    if rows[0]["t"]:
        done = tests.run("-c", scene + "table %s, %s along cycle FA=0.9*mu*FN steps %d" % (x, y, len(rows) - 1))
        table = harness.told(done.stdout)
        compared(tests, name + ": instants", [4 * float(row["t"]) for row in rows],
                 [4 * row["time"] for row in table], EXACT)
        for axis, expression in (("x", x), ("y", y)):
            want = [float(row[axis]) for row in rows]
            compared(tests, "%s: %s" % (name, axis), want, [row[expression] for row in table], EXACT,
                     [max(map(abs, want))] * len(want))
        return
    of, expression, axis = ("y", x, "x") if x else ("x", y, "y")
    done = tests.run("-c", scene + "\n".join(expression % row[of] for row in rows))
    compared(tests, name, [float(row[axis]) for row in rows], harness.printed_values(done.stdout), EXACT)


def swinging(tests, i, row):
    """Losses within 1e-9; W, where the contact is nearly lost, within the error that `explain` states, which takes a while."""
    name = "%s; %s" % (row["setup"], row["cycle"])
    asks = i == 0 or "FNA=85 N" in name or "FNA=75 N" in name
    done = tests.run("-c", "%s\n%s\n%sset format json\nW, dW" % (row["setup"], row["cycle"], "explain dW;" * asks))
    W, dW = float(row["W"]), float(row["dW"])
    got = harness.printed_values("\n".join(done.stdout.splitlines()[-2:]))
    compared(tests, name + ": dW", [dW], got[1:], SINE, [W if dW == 0 else dW])
    bound = SINE
    if asks:
        if "model: memory diagram, the sine itself, event by event (exact)" in done.stdout:
            bound = SINE
        else:
            stated = re.search(r"model: memory diagram, converged to (\S+) ", done.stdout)
            if not tests.check(name + ": states how far", stated and float(stated.group(1)) <= 5e-9, tests.report(done)):
                return
            bound = float(stated.group(1))
    compared(tests, name, [W, dW], got, bound, [W, W if dW == 0 else dW])
    once = row["cycle"].replace(" times 3", "")
    done = tests.run("-c", "%s\n%s\nset format json\nW, dW" % (row["setup"], once))
    compared(tests, "%s; %s" % (row["setup"], once), [float(row["W1"]), float(row["dW1"])],
             harness.printed_values(done.stdout), SINE)


def run(tests):
    panels = grouped(rows_of("figures.csv"), "panel", "k", "c0/a0")
    tests.check("all panels are known", {panel for panel, _, _ in panels} == set(PANELS), str(sorted(panels)))
    tests.each([lambda: line(tests)] +
               [lambda i=i, row=row: swinging(tests, i, row) for i, row in enumerate(rows_of("swinging.csv"))] +
               [lambda key=key, rows=rows: figure(tests, *key, rows) for key, rows in panels.items()])
