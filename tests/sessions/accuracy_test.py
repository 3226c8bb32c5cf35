# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests `accuracy`: orders of convergence, which models are exact, the advice (times are not checked); and the conditioning of
`explain`, against difference quotients with larger steps."""
import csv
import io
import json
import math
import os
import re
import xml.etree.ElementTree

import harness

GRADED = "material E0=210 GPa nu=0.3 k=%g c0=1 mm; geometry %s; friction 0.3; press FN=100 N\n"
SPHERE, CONE = "sphere R=10 mm", "cone slope=0.01"


def measured(tests, script, command="accuracy within 0.3"):
    """Runs `accuracy`: {model: {parameter: row}}, and the last object."""
    done = tests.run("-c", script + "\nset format json\n" + command)
    lines = harness.told(done.stdout)
    wide = "warning: a/R = 0.7: beyond 0.3 the bodies are no half-spaces"  # one scene is too wide on purpose
    told = [line for line in done.stderr.splitlines() if not line.startswith(wide)]
    if not tests.check("%s; %s" % (script, command), len(lines) > 1 and not told and done.returncode == 0,
                       tests.report(done)):
        return {}, {}
    rows = {}
    for row in lines[:-1]:
        rows.setdefault(row["model"], {})[row["parameter"]] = row
    return rows, lines[-1]


def order(rows):
    """The order of convergence over all sizes; single errors scatter with the place of the slip front within its cell."""
    sizes = sorted(size for size in rows if rows[size]["error"] > 1e-10)
    if len(sizes) < 2:
        return float("nan")
    return math.log(rows[sizes[0]]["error"] / rows[sizes[-1]]["error"]) / math.log(sizes[-1] / sizes[0])


def stepped_area(k, n, t, M):
    """The ratio of (21) to (27): the area of the loop from (17) and (18), sampled at F = FA cos(pi i/M), by the trapezoidal rule."""
    q = n / (n + k + 1)
    first = [1 - (1 - t * (1 - math.cos(math.pi * i / M)) / 2) ** q for i in range(M + 1)]
    F = [t * math.cos(math.pi * i / M) for i in range(M + 1)]
    down = [first[M] - 2 * x for x in first]  # dx over dxmax
    area = sum((a - b) * (f + g) / 2 for a, b, f, g in zip(down, down[1:], F, F[1:])) * -2
    bracket = 1 - (1 - t) ** (1 + q) - (1 + q) / 2 * t * (1 + (1 - t) ** q)
    return area / (8 / (1 + q) * bracket)


def power_law(tests, k, shape, load, springs, midpoint=None, seconds=0.3):
    rows, last = measured(tests, GRADED % (k, shape) + load, "accuracy within %g" % seconds)
    if not rows:
        return
    name = "accuracy at k = %g, %s, %s: " % (k, shape, load)
    for model in ("closed form", "memory diagram"):
        row = rows[model][0]
        tests.check(name + model, row["error"] <= 2e-16 and row["seconds"] > 0 and row["ratio"] >= 1, str(row))
    quadrature = rows["quadrature"][0]
    tests.check(name + "quadrature", abs(quadrature["value"]/last["value"] - 1) <= 2e-16 and quadrature["seconds"] > 0, str(quadrature))
    tests.check(name + "loop area", abs(order(rows["loop area (21)"]) - 2) < 0.1, str(rows["loop area (21)"]))
    if load == "cycle FA=20 N":
        for M in (10, 100):
            got = rows["loop area (21)"][M]["value"] / rows["closed form"][0]["value"]
            want = stepped_area(k, 2 if shape == SPHERE else 1, 20 / 30, M)
            tests.check(name + "loop area at M = %d" % M, abs(got - want) < 1e-12, "%.17g, expected %.17g" % (got, want))
    got = order(rows["springs"])
    tests.check(name + "springs", abs(got - springs) < 0.35, "order %g, expected %g" % (got, springs))
    if k == 0:
        tests.check(name + "the same weights need one row", "springs, midpoint" not in rows)
    elif midpoint:
        got = order(rows["springs, midpoint"])
        tests.check(name + "midpoint", abs(got - midpoint) < 0.1, "order %g, expected %g" % (got, midpoint))
    fastest = min(row["seconds"] for model in rows.values() for row in model.values())
    tests.check(name + "ratios", all(abs(row["ratio"] * fastest / row["seconds"] - 1) < 0.02
                                     for model in rows.values() for row in model.values()))
    tests.check(name + "advice", last["auto"] == "closed form" and "auto picks: closed form" in last["advice"] and
                "springs" in last["advice"] and 0 < last["agreement"] < 2e-16, str(last))


def orders(tests):
    power_law(tests, 0, SPHERE, "cycle FA=20 N", 2)
    power_law(tests, -0.7, SPHERE, "cycle FA=20 N", 2, 0.3, seconds=2)
    power_law(tests, -0.5, CONE, "cycle FA=20 N", 1.5, 0.5)  # n + k + 1
    power_law(tests, -0.3, SPHERE, "cycle dxA=1 um", 2)


def loads(tests):
    scene = GRADED % (0.3, SPHERE)
    for load, says in (("", "FA = 15 N at FN = 100 N, half of mu*FN"), ("step Fx=-12 N", "FA = 12 N"),
                       ("press FN=40 N; step FN=100 N Fx=11 N", "FA = 11 N at FN = 100 N")):
        rows, last = measured(tests, scene + load)
        tests.check("accuracy after %s" % load, rows and last["load"].startswith(says), str(last))
    # gross slip: by a force at the limit, by a displacement beyond it
    for load in ("FA=30 N", "dxA=5 um"):
        rows, last = measured(tests, GRADED % (-0.3, SPHERE), "accuracy %s within 0.1" % load)
        tests.check("accuracy " + load, rows and rows["closed form"][0]["error"] <= 2e-16 and
                    rows["memory diagram"][0]["error"] <= 2e-16, str(rows))
    # all of the contact slides: the reference is exact
    rows, last = measured(tests, "material steel; geometry flat-paraboloid b=1 mm R=10 mm; friction 0.3; "
                          "press FN=1e-30 N; cycle dxA=1 nm", "accuracy within 0.01")
    tests.check("accuracy, all slides", rows and last["agreement"] > 0, str(last))
    # the same number as dW: there is no error
    done = tests.run("-c", scene + "cycle FA=20 N\nset format json\nW\ndW\naccuracy within 0.1\nW\ndW")
    lines = harness.told(done.stdout)
    tests.check("accuracy takes the last cycle", len(lines) > 10 and
                lines[-3]["load"] == "FA = 20 N at FN = 100 N, the last cycle", tests.report(done))
    tests.check("accuracy leaves the scene", lines[:2] == lines[-2:] and len(lines) > 10, tests.report(done))
    closed = [line for line in lines if line.get("model") == "closed form"]
    tests.check("accuracy and dW", closed and closed[0]["value"] == lines[1]["value"], str(closed))


def other_models(tests):
    """Scenes without a closed form."""
    rows, last = measured(tests, GRADED % (0.3, SPHERE) + "cycle FA=12 N FNA=20 N phase=90 deg times 2 steps 40",
                          "accuracy within 1")
    tests.check("accuracy, FN swings", rows and set(rows) == {"memory diagram", "loop area (21)", "springs"} and
                rows["memory diagram"][0]["error"] <= 1e-10 and last["auto"] == "memory diagram" and
                "FN swings" in last["advice"], str(last))
    tests.check("accuracy, FN swings: loop area", rows and abs(order(rows["loop area (21)"]) - 2) < 0.1, str(rows))
    chords = sorted(rows.get("loop area (21)", ()))
    tests.check("each of four times the chords of the last", len(chords) > 1 and all(4 * m == n for m, n in zip(chords, chords[1:])),
                str(chords))
    changed, _ = measured(tests, GRADED % (0.3, SPHERE) + "step FN=110 N; cycle FA=12 N", "accuracy within 1")
    areas = changed.get("loop area (21)", {})
    tests.check("accuracy, FN has changed: loop area", {10, 100, 1000} <= set(areas) and abs(order(areas) - 2) < 0.1, str(areas))
    tests.check("accuracy, FN swings: springs", rows and order(rows["springs"]) > 1.5, str(rows))
    scene = GRADED % (0.3, SPHERE) + "cycle FA=12 N FNA=20 N phase=90 deg times 2 steps 40\n"
    dW = harness.printed_values(tests.run("--format=json", "-c", scene + "dW").stdout)[0]
    tests.check("accuracy, FN swings: dW", rows and rows["memory diagram"][0]["value"] == dW, str(dW))
    with open(os.path.join(harness.ROOT, "tests/reference/swinging.csv"), encoding="ascii") as f:
        exact = list(csv.DictReader(line for line in f if not line.startswith("#")))
    for row in (exact[0], exact[6], exact[11]):
        rows, last = measured(tests, row["setup"] + "\n" + row["cycle"], "accuracy within 0.01")
        dW = float(row["dW"])
        tests.check("accuracy, %s: exact" % row["cycle"], rows and abs(last["value"] / dW - 1) <= 1e-10 and
                    abs(rows["memory diagram"][0]["value"] / dW - 1) <= 1e-10, str(last))
    rows, last = measured(tests, GRADED % (0.3, SPHERE) + "step FN=120 N Fx=10 N; cycle FA=12 N; step FN=90 N")
    tests.check("accuracy, FN has changed", rows and rows["memory diagram"][0]["error"] <= 1e-14 and
                abs(order(rows["springs"]) - 2) < 0.4, str(rows))
    for shape in ("flat-rounded b=0.2 mm R=10 mm", "exact-sphere R=10 mm"):
        rows, last = measured(tests, GRADED % (0, shape), "accuracy FA=15 N within 0.1")
        tests.check("accuracy, " + shape, rows and rows["closed form"][0]["error"] < 1e-14 and
                    rows["memory diagram"][0]["error"] < 1e-14 and rows["quadrature"][0]["error"] < 1e-14 and
                    last["auto"].startswith("closed form, with polynomials") and
                    abs(order(rows["springs"]) - 2) < 0.6, str(rows))


def advice(tests):
    """The advice names the fewest springs with an error of at most 1e-6, and their time as a multiple of auto's choice."""
    for shape, load in ((SPHERE, "FA=28 N"), (SPHERE, "FA=18 N"), (SPHERE, "FA=12 N"), ("flat-rounded b=0.2 mm R=10 mm", "FA=10 N")):
        rows, last = measured(tests, GRADED % (0.3, shape), "accuracy %s within 0.3" % load)
        springs = rows.get("springs", {})
        good = next((n for n in sorted(springs) if springs[n]["error"] <= 1e-6), min(springs, key=lambda n: springs[n]["error"], default=0))
        told = re.match(r"(\d+) springs: error (\S+) in .*, (\S+) times as (long|fast) as auto", last.get("advice", ""))
        if not tests.check("accuracy, %s, %s: advice" % (shape, load), told and int(told.group(1)) == good, str(last) + str(springs)):
            continue
        ratio = springs[good]["seconds"] / rows["closed form"][0]["seconds"]
        tests.check("how many times as long or fast", abs(float(told.group(3)) / max(ratio, 1 / ratio) - 1) < 0.02 and
                    (told.group(4) == "long") == (ratio >= 1), str(last) + str(ratio))


def narrow_gaps(tests):
    """For k < 0 springs with midpoint weights need a wider contact, which not every gap has."""
    where = os.path.join(tests.dir, "gap.csv")
    with open(where, "w", encoding="ascii") as f:
        f.write("r [mm],f [um]\n" + "".join("%g,%g\n" % (r / 50, r * r / 50) for r in range(51)))
    for scene in ("geometry file %s; press a=0.7 mm" % where, "geometry exact-sphere R=1 mm; press a=0.7 mm",
                  "geometry power n=1e6 h=1 um r0=1 mm; press FN=100 N"):
        rows, _ = measured(tests, "material E0=210 GPa nu=0.3 k=-0.3 c0=1 mm; friction 0.3; " + scene,
                           "accuracy within 0.01")
        tests.check("accuracy, " + scene, set(rows) ==
                    {"closed form", "memory diagram", "quadrature", "loop area (21)", "springs"}, str(rows))


def at_the_ends(tests):
    """A table pressed to its last row, more time, losses below the range of double, and a load that does not slip."""
    where = os.path.join(tests.dir, "end.csv")
    for n in (6, 8, 10):
        with open(where, "w", encoding="ascii") as f:
            f.write("r [mm],f [um]\n" + "".join("%g,%.17g\n" % (i / 7, (i / 7) ** 2 * 3.3) for i in range(n)))
        rows, _ = measured(tests, "material steel; friction 0.3; geometry file %s; press a=%g mm" % (where, (n - 1) / 7),
                           "accuracy within 0.003")
        tests.check("accuracy of a table of %d rows, to its end" % n, rows and rows["memory diagram"][0]["error"] < 1e-14, str(rows))
    for load in ("", "; step FN=110 N; cycle FA=12 N"):
        rows, _ = measured(tests, GRADED % (0.3, SPHERE) + load, "accuracy within %g" % (1 if tests.few else 5))
        tests.check("accuracy with time" + load, rows and all(row["error"] < 100 / size ** 2 + 1e-15
                                                              for size, row in rows["springs"].items()), str(rows))
    rows, _ = measured(tests, (GRADED % (0.3, SPHERE)).replace("FN=100", "FN=1e-200"), "accuracy within 0.003")
    tests.check("accuracy beyond the double", rows and rows["memory diagram"][0]["error"] < 1e-15,
                str(rows))
    for phase in ("0", "180 deg"):
        done = tests.run("-c", GRADED % (0.3, SPHERE) + "cycle FA=1 N FNA=10 N phase=%s times 2; dW; accuracy within 0.01" % phase)
        tests.check("accuracy where nothing slips", done.returncode == 1 and done.stdout.endswith("dW = 0 J\n")
                    and "nothing slips in the last cycle: dW is 0" in done.stderr, tests.report(done))


def forms(tests):
    scene = GRADED % (0.3, SPHERE)
    done = tests.run("-c", scene + "accuracy FA=20 N within 0.1")
    lines = done.stdout.splitlines()
    tests.check("accuracy as text", len(lines) > 10 and lines[0] == "FA = 20 N at FN = 100 N" and
                lines[1].startswith("reference: quadrature") and
                lines[2].split() == ["model", "parameter", "dW", "[uJ]", "error", "time/cycle", "x", "fastest"] and
                lines[3].startswith("closed form ") and lines[-1].startswith("auto picks: closed form (constant FN): error <") and
                re.match(r"\d+ springs: error ", lines[-2]) and not done.stderr and
                all(len(line) < 80 for line in lines), tests.report(done))
    _, last = measured(tests, scene, "accuracy FA=20 N within 0.1")
    told = re.search(r", good to (\d)e-(\d+)$", lines[1])
    bound = int(told.group(1)) * 10.0 ** -int(told.group(2)) if told else 0
    tests.check("accuracy: how good the reference is, rounded up", last and
                last["agreement"] * 0.999 <= bound <= 2 * last["agreement"] and 0 < bound < 1e-16, lines[1] + str(last))
    tests.check("below what the reference tells", "<" in lines[3] and " 0 " not in lines[3], tests.report(done))
    rows = list(csv.reader(io.StringIO(tests.run("--format=csv", "-c", scene + "accuracy FA=20 N within 0.1").stdout)))
    tests.check("accuracy as CSV", rows[0][:4] == ["model", "parameter", "value [J]", "error"] and
                all(len(row) == 7 for row in rows) and rows[1][0] == "closed form" and
                any(row[0] == "springs, midpoint" for row in rows), str(rows))


def pictures(tests):
    where = os.path.join(tests.dir, "accuracy")
    os.makedirs(where)
    done = tests.run("-c", GRADED % (-0.3, SPHERE) + "set plot 79x24\nplot accuracy FA=20 N within 0.1\n"
                     "plot accuracy within 0.1 title \"of all models\" to a.svg", cwd=where)
    tests.check("plot accuracy", all(text in done.stdout for text in ("time of a cycle [s]", "relative error",
                "closed form", "springs, midpoint")) and harness.reported(done.stderr, ["a.svg"]), tests.report(done))
    tests.check("files of plot accuracy", os.listdir(where) == ["a.svg"], str(os.listdir(where)))
    text = "".join(xml.etree.ElementTree.parse(os.path.join(where, "a.svg")).getroot().itertext())
    tests.check("a.svg", "of all models" in text and "memory diagram" in text and "relative error" in text, text[:500])


# Scenes as lists of statements; the last one is the load.
CONDITIONED = (
    ("material E0=%(E0)s Pa nu=%(nu)s k=%(k)s c0=%(c0)s m; geometry sphere R=%(R)s m; friction %(mu)s; "
     "press FN=%(FN)s N; step Fx=%(Fx)s N", ("a", "c", "kt"),
     {"E0": 210e9, "nu": 0.3, "k": 0.5, "c0": 1e-3, "mu": 0.3, "FN": 100, "R": 1e-2, "Fx": 25}),
    ("material E0=%(E0)s Pa nu=%(nu)s k=%(k)s c0=%(c0)s m; geometry sphere R=%(R)s m; friction %(mu)s; "
     "press FN=%(FN)s N; cycle FA=%(FA)s N", ("dW", "W"),
     {"E0": 210e9, "nu": 0.3, "k": 0.5, "c0": 1e-3, "mu": 0.3, "FN": 100, "R": 1e-2, "FA": 25}),
    # here the radius and the force are rounded to double
    ("material E0=%(E0)s Pa nu=%(nu)s k=%(k)s c0=%(c0)s m; second E0=%(E0_2)s Pa nu=%(nu_2)s; "
     "geometry power n=%(n)s h=%(h)s m r0=%(r0)s m; friction %(mu)s; press a=%(a)s m; cycle dxA=%(dxA)s m",
     ("a0", "dx0max", "Fx", "c", "U"),
     {"E0": 210e9, "nu": 0.1, "k": 0.2, "c0": 1e-3, "E0_2": 70e9, "nu_2": 0.33, "n": 3.3, "h": 1e-6, "r0": 1e-3,
      "mu": 0.3, "a": 5e-4, "dxA": 2e-8}),
    ("material E0=%(E0)s Pa nu=%(nu)s; geometry sphere R=%(R)s m; friction %(mu)s; press FN=%(FN)s N; "
     "cycle FA=%(FA)s N FNA=%(FNA)s N phase=90 deg times 2 steps 40", ("W",),
     {"E0": 210e9, "nu": 0.3, "mu": 0.3, "FN": 100, "R": 1e-2, "FNA": 20, "FA": 10}),
    ("material E0=%(E0)s Pa nu=%(nu)s; geometry flat-rounded b=%(b)s m R=%(R)s m; friction %(mu)s; press dz=%(dz)s m",
     ("FN", "kn"), {"E0": 210e9, "nu": 0.3, "mu": 0.3, "b": 2e-4, "R": 1e-2, "dz": 1e-6}),
    # an input bound to a name, which is none, and steps of every kind
    ("z = 0.4; material E0=%(E0)s Pa nu=%(nu)s; geometry sphere R=%(R)s m; mu := z; "
     "press FN=%(FN)s N; step FN=%(step FN)s N Fx=%(Fx)s N", ("dx", "W", "qx(0.1 mm)"),
     {"E0": 210e9, "nu": 0.3, "R": 1e-2, "FN": 100, "step FN": 80, "Fx": 10}),
    ("material E0=%(E0)s Pa nu=%(nu)s; geometry sphere R=%(R)s m; friction %(mu)s; press FN=%(FN)s N; "
     "step FN+=%(step FN)s N Fx+=%(Fx)s N", ("dx", "U"),
     {"E0": 210e9, "nu": 0.3, "R": 1e-2, "FN": 100, "step FN": 10, "Fx": 5, "mu": 0.4}),
    ("material E0=%(E0)s Pa nu=%(nu)s; geometry sphere R=%(R)s m; friction %(mu)s; press dz=%(dz)s m; "
     "step dz=%(step dz)s m dx=%(dx)s m", ("Fx", "U"),
     {"E0": 210e9, "nu": 0.3, "R": 1e-2, "dz": 3e-6, "step dz": 2.8e-6, "dx": 1e-7, "mu": 0.4}),
    ("material E0=%(E0)s Pa nu=%(nu)s; geometry sphere R=%(R)s m; friction %(mu)s; press FN=%(FN)s N; "
     "step FN=%(step FN)s N dx=%(dx)s m", ("Fx",),
     {"E0": 210e9, "nu": 0.3, "R": 1e-2, "FN": 100, "step FN": 80, "dx": 1e-7, "mu": 0.4}),
    ("material E0=%(E0)s Pa nu=%(nu)s; geometry sphere R=%(R)s m; friction %(mu)s; press FN=%(FN)s N; "
     "step dz=%(step dz)s m Fx=%(Fx)s N", ("dx",),
     {"E0": 210e9, "nu": 0.3, "R": 1e-2, "FN": 100, "step dz": 3.2e-6, "Fx": 10, "mu": 0.4}),
)


def conditioned(tests, scene, quantities, start):
    """Compares each condition number (two digits) with the effect of a relative change of 1e-6. Causes without effect, and with
    condition numbers below 0.01, must be listed as that."""
    def script(values):
        return scene % {name: "%.17g" % value for name, value in values.items()}

    ask = "\n" + ", ".join(quantities)
    near = ["reset all; " + script({**start, name: start[name] * (1 + part)}) + ask
            for name in start for part in (1e-6, -1e-6)]
    done = tests.run("--format=json", "-c", "\n".join([script(start) + ask] + near))
    values = [json.loads(line)["value"] for line in done.stdout.splitlines() if line.startswith('{"name"')]
    width = len(quantities)
    if not tests.check("values near " + script(start), len(values) == width * (1 + 2 * len(start)), tests.report(done)):
        return
    told = tests.run("-c", script(start) + "".join("\nexplain %s conditioning" % name for name in quantities)).stdout
    told = re.split(r"^(?=\w+: )", told, flags=re.M)[1:]
    for i, quantity in enumerate(quantities):
        got = dict(re.findall(r"^    ((?:step )?\w+) \+?= [^ \n]+(?: [^ \n]+)? {2,}\S+ +\S+ +(\S+)$", told[i], re.M))
        none = re.search(r"^    no effect: (.*)$", told[i], re.M)
        none = none.group(1).split(", ") if none else []
        listed = re.findall(r"^    (\w+) = ", told[i].partition("model:")[0], re.M)
        for j, cause in enumerate(start):
            up, down = (values[width * (1 + 2 * j + k) + i] for k in (0, 1))
            want = abs(up - down) / abs(values[i]) / 2e-6
            shown = float(got.get(cause, 0))
            tests.check("explain %s: %s" % (quantity, cause), abs(shown - want) <= 0.012 + 0.06 * want and
                        (cause not in none or up == down), "%g, expected %g\n%s" % (shown, want, told[i]))
            tests.check("explain %s: inputs, %s" % (quantity, cause), (cause in listed) <= (cause not in none), told[i])


def causes(tests):
    """Which causes are listed: inputs and the last step, but not one that ends at 0, nor names of the user or arguments."""
    scene = GRADED % (0.3, SPHERE)
    for script, there, absent in (
            (scene + "x = 0; y = 2; z := 3; table a(u) for u = 1 N .. 2 N; explain a*y + x*(1 m) + z*a", ("FN",), ("x", "y", "z", "u")),
            (scene + "step Fx=20 N; step Fx=0 N; explain dx", ("FN", "mu"), ("Fx",)),
            (scene + "step Fx=20 N; step FN=110 N; explain W", ("FN",), ("Fx",)),
            (scene + "explain p(0 m)", ("FN",), ("r",)),
            (scene + "mu = 0.5; explain a*(1 + 1e10*(mu - 0.5)^2)", ("FN",), ("mu",))):
        done = tests.run("-c", script + " conditioning")
        found = re.findall(r"^    ((?:step )?\w+) \+?= \S+(?: [^ \n]+)? {2,}\S", done.stdout, re.M)
        tests.check("explain: causes of " + script.rpartition("; ")[2], done.returncode == 0 and all(name in found for name in there)
                    and not any(name in found for name in absent), str(found) + tests.report(done))


def slow_causes(tests):
    """Causes that would take too long are left out, and named."""
    done = tests.run("-c", GRADED % (0, SPHERE) + "cycle FA=15 N FNA=20 N phase=60 deg times 300; set model springs 3000; explain dW conditioning")
    found = re.findall(r"^    (\w+) \+?= \S+(?: [^ \n]+)? {2,}\S", done.stdout, re.M)
    left = re.findall(r"^    left out after 3 seconds: (.*)$", done.stdout, re.M)
    named = found + [name for line in left + re.findall(r"^    no effect: (.*)$", done.stdout, re.M) for name in line.split(", ")]
    tests.check("explain: all causes are named", done.returncode == 0 and "E0" in found
                and {"E0", "nu", "mu", "FN", "R", "FNA", "phase", "FA"} <= set(named), tests.report(done))


def conditioning(tests):
    for case in CONDITIONED:
        conditioned(tests, *case)
    scene = GRADED % (0.5, SPHERE)
    # c/a = (1 - t)^(1/(n+k+1)): the condition number is t/(1-t)/(n+k+1), with two digits printed
    for distance in (1e-3, 1e-9, 1e-13):
        FA = 30 * (1 - distance)
        done = tests.run("-c", scene + "step Fx=%.17g N; explain c conditioning" % FA)
        found = re.search(r"^    Fx = \S+ N .* (\S+)$", done.stdout, re.M)
        tests.check("ill-conditioned at 1 - t = %g" % distance, found and
                    abs(float(found.group(1)) * (30 - FA) / FA * 3.5 - 1) < 0.06, tests.report(done))
    done = tests.run("-c", scene + "cycle FA=25 N; set model memory; explain c")
    tests.check("explain with the memory diagram", "model: memory diagram (exact)" in done.stdout and
                "condition" not in done.stdout and "no effect" not in done.stdout, tests.report(done))
    done = tests.run("-c", scene + "cycle FA=25 N; explain W; W; show; explain FN; explain E0")
    again = tests.run("-c", scene + "cycle FA=25 N; W; show; explain FN; explain E0")
    for script, line in (
            ("step FN=80 N dx=0.1 um; explain Fx", "path: step FN= dx= goes straight in (delta_z, delta_x)"),
            ("step dz=3 um Fx=5 N; explain dx", "path: step dz= Fx= goes straight in (F_N, F_x)"),
            ("cycle FA=10 N FNA=10 N; explain Fx", "F_x = mu int sigma dF_N"),
            ("cycle FA=10 N FNA=10 N; explain dx", "delta_x = mu eta int sigma dy"),
            ("cycle FA=10 N FNA=10 N; explain W", "the sine itself, event by event (exact)"),
            ("cycle dxA=0.1 um FNA=10 N; explain W", "chords a period and fewer, extrapolated)"),
            ("cycle dxA=0.1 um FNA=10 N; explain kt", "chords a period of the sine"),
            ("set model springs 100; cycle FA=10 N FNA=10 N; explain W", "model: 100 springs, by")):
        shown = tests.run("-c", scene + script)
        tests.check("explain: " + script, line in shown.stdout, tests.report(shown))
    tests.check("explain leaves the scene", done.stdout.endswith(again.stdout), tests.report(done))


def models(tests):
    """`set timing on` names the model that computed the answer."""
    scene = GRADED % (0.3, SPHERE) + "set timing on\n"
    for script, names in (("a", " (closed form)"), ("friction 0.2", " (closed form)"),
                          ("step Fx=10 N; friction 0.2", " (closed form, memory diagram)"), ("step Fx=10 N; W", " (memory diagram)"), ("1+1", ""),
                          ("cycle FA=10 N; dW", " (closed form)"), ("p(0 m)", " (closed form, quadrature)"),
                          ("cycle FA=10 N; set model springs 100; dW", " (springs)"),
                          ("table dW(F) for F = 1 N .. 2 N steps 1", " (closed form)"),
                          ("table a for R = 1 mm .. 2 mm steps 1", " (closed form)"),
                          ("geometry exact-sphere R=10 mm; a", " (polynomials to 1e-17)")):
        done = tests.run("-c", scene + script)
        last = (done.stderr.splitlines() or [""])[-1]
        tests.check("set timing on; %s" % script, re.fullmatch(r"time: [\d.]+(?:e[-+]\d+)? ms" + re.escape(names), last),
                    tests.report(done))


def curves(tests):
    """A law prepared for one curve is used for the next curve of the same contact, and of no other."""
    where = os.path.join(tests.dir, "rows.csv")
    with open(where, "w", encoding="ascii") as f:
        f.write("r [mm],f [um]\n")
        for i in range(60):
            f.write("%d,%.17g\n" % (i, 0.1 * i * i / (1 + i / 100)))
    scene = (GRADED % (0.3, "file " + where) + "press FN=50 N\n")
    rows = "table dW(F), a for F = 1 N .. 8 N steps 39"
    for name, values in (("mu", ("0.4", "0.5", "0.6")), ("k", ("0.1", "0.3", "0.1")), ("FN", ("50 N", "90 N", "40 N"))):
        done = [tests.run("--format=json", "-c", scene + rows + " with %s = %s" % (name, which)) for which in (", ".join(values), *values)]
        together, *apart = [re.findall(r'^{"F".*$', one.stdout, re.M) for one in done]
        tests.check("curves of one table and of several, " + name, len(apart[0]) == 40 and together == sum(apart, []),
                    tests.report(done[0]) + "\n".join(sum(apart, [])))
    matrix = tests.run("--format=csv", "-c", scene + rows.replace(", a", "") + " for mu = 0.4 .. 0.6 steps 2")
    apart = [tests.run("--format=csv", "-c", scene + "mu = %s; " % mu + rows.replace(", a", "")).stdout.splitlines()[1:] for mu in (0.4, 0.5, 0.6)]
    tests.check("and the columns of a matrix", len(apart[0]) == 40 and set(matrix.stdout.replace("\n", ",").split(",")) >=
                {row.split(",")[1] for one in apart for row in one}, tests.report(matrix))


def run(tests):
    tests.each([lambda f=f: f(tests) for f in (orders, loads, other_models, advice, narrow_gaps, at_the_ends, forms, pictures, causes, slow_causes, conditioning, models,
                                                 curves)])
