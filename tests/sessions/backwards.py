# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests solve, maximize and minimize and the damper functions against reference answers of 30 digits; and runs exported models."""
import csv
import json
import math
import os
import re
import subprocess

import harness


def table(name):
    with open(os.path.join(harness.ROOT, "tests/reference", name), encoding="utf-8") as f:
        return list(csv.DictReader(line for line in f if not line.startswith("#")))


def run_json(tests, script):
    done = tests.run("--format=json", input=script)
    rows = harness.told(done.stdout)
    return [r for r in rows if "name" in r], [r for r in rows if "event" in r], done


def questions(tests):
    """Answers are accurate to 1e-12, or to the effect of rounding the inputs."""
    asked = {}
    for row in table("backwards.csv"):
        asked.setdefault((row["setup"], row["question"]), []).append(row)
    for (setup, question), rows in asked.items():
        values, events, done = run_json(tests, setup + "\n" + question + "\n")
        events = [e for e in events if e["event"] == question.split()[0]]
        if not tests.check(question, values and events, tests.report(done)):
            continue
        got = {v["name"]: v["value"] for v in values[:-1] or values}
        got["value"] = values[-1]["value"]
        for row in rows:
            want = float(row["value"])
            bound = max(1e-12, 4 * 2.3e-16 * float(row["condition"]))
            tests.check("%s: %s" % (question, row["name"]), abs(got.get(row["name"], 0) - want) <= bound * abs(want),
                        "%r instead of %r in %s" % (got.get(row["name"]), want, setup))
        if len(rows) <= 2:
            tests.check("%s: evaluations" % question, events[0]["evaluations"] <= 60, str(events))


def edges(tests):
    """The optimum lies at the edge of the possible scenes, and along it."""
    setup = "material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"
    for question, want in (
            ("maximize dW(20 N) over FN = 1 N .. 100 N", {"FN": 50}),
            ("maximize dW(20 N) over FN = 1 N .. 100 N, mu = 0.1 .. 0.8", {"FN": 25, "mu": 0.8}),
            ("maximize dW(F) over F = 1 N .. 60 N", {"F": 40}),
            ("minimize abs(FN - 33 N) over FN = 1 N .. 100 N", {"FN": 33})):
        values, events, done = run_json(tests, setup + question + "\n")
        got = {v["name"]: v["value"] for v in values}
        tests.check(question, all(abs(got.get(name, 0) / v - 1) < 1e-7 for name, v in want.items()), tests.report(done))
        scene = "scene" in events[-1]["ends"].values() if events else False
        tests.check(question + ": tells the edge", scene == ("dW" in question), tests.report(done))


# the optimum, and its place if there is only one; at an edge or a kink to 1e-7 of the range
OPTIMA = (
    # two neighbouring places of the grid have the same value: the optimum is between them
    ("minimize (x - 7.5)^4 over x = 0 .. 16", 0, {"x": 7.5}), ("minimize abs(x - 7.5) over x = 0 .. 16", 0, {"x": 7.5}),
    ("maximize min(x, 15 - x) over x = 0 .. 16", 7.5, {"x": 7.5}),
    ("minimize sqrt(abs(x - 7.5)) + 3 over x = 0 .. 16", 3, {"x": 7.5}),
    ("minimize (x - 7)^2*(x - 8)^2 over x = 0 .. 16", 0, {}), ("minimize max(0.1, abs(x - 0.5)) over x = 0 .. 1", 0.1, {}),
    ("minimize max(3, abs(x - 7.5)) over x = 0 .. 16", 3, {}),
    # a kink that is not in the middle between two places
    ("maximize -abs(x - 1.887186190787368) over x = 0.017359102229627776 .. 3.2916265746644138", 0, {"x": 1.887186190787368}),
    ("minimize abs(x - 0.556692153727782) over x = 0.05874483491451005 .. 2.378731274184922", 0, {"x": 0.556692153727782}),
    ("maximize -abs(4.438321363549356*(x - 1.8665948314259628)) over x = -1.1233740356335473 .. 4.704637117787868", 0, {"x": 1.8665948314259628}),
    # several local optima on the grid
    ("minimize cos(6*x) + 0.05*(x - 1)^2 over x = -3 .. 3", -0.9886835284767844, {"x": 0.5249184603170129}),
    ("minimize cos(60*x) + 0.05*(x - 1)^2 over x = -3 .. 3", -0.9999986675563383, {"x": 0.9948378170307393}),
    ("maximize cos(3*x)*cos(2*y) - 0.05*((x - 0.1)^2 + (y - 0.2)^2) over x = -1.95 .. 1.5, y = -1.5 .. 2.1",
     0.9975542756343451, {"x": 0.001098954794806794, "y": 0.004878150144751366}),
    ("minimize (x - 1.672)^2 + (y - 0.625)^2 + 0.3*sin(4.69*x) over x = -2.6 .. 2.5, y = -2.2 .. 3.8",
     0.037630348416463231, {"x": 1.172931214599732595, "y": 0.625}),
    # the lowest is at the limit of the scene, another place of the scan is lower
    ("minimize cos(2.7*(x + 0.89)) + 0.1*(x + 0.89)^2 + 0*sqrt(x - 0.78) over x = -1.7 .. 2.7",
     0.07690039003102905, {"x": 0.78}),
    # the same with two names, where it rises within the last step only, and only close to the limit
    ("maximize max(1 - 0.5*x, 10*(x - 2.6)) + 0*sqrt(2.74 - x) - y over x = 0 .. 3, y = 0 .. 1", 1.4, {"x": 2.74, "y": 0}),
    ("maximize max(1 - 0.5*x, 100*(x - 2.725)) + 0*sqrt(2.74 - x) - y over x = 0 .. 3, y = 0 .. 1", 1.5, {"x": 2.74, "y": 0}),
    # an optimum close to an end
    ("minimize x + 1e-17/x over x = 0 .. 1", 2 * math.sqrt(1e-17), {"x": math.sqrt(1e-17)}),
    ("minimize (x - 7e-5)^2 + (y - 0.5)^2 over x = 0 .. 1, y = 0 .. 1", 0, {"x": 7e-5, "y": 0.5}),
    # a well that only a step from the end of the range finds
    ("minimize x - max(0, 1 - abs(x - 8e-6)*4e5) + (y - 0.5)^2 over x = 0 .. 1, y = 0 .. 1", 8e-6 - 1, {"x": 8e-6, "y": 0.5}),
    # a bent valley with steep sides
    ("minimize (x + 0.95162134640691609)^2 + 30*(y - 1.9999666292938245 - (x + 0.95162134640691609)^2)^2 + "
     "30*(z - 6.5344410018999959 - (x + 0.95162134640691609)^2)^2 over x = -1 .. -0.9, y = 1 .. 2, z = 0.001 .. 10", 0, {}),
    # the edge of the possible scenes, and the end of a range on it
    ("maximize 10*y + x + 0*sqrt(1.5 - x - y) over x = 0 .. 1, y = 0 .. 1", 10.5, {"x": 0.5, "y": 1}),
    ("maximize 10*x + y + 0*sqrt(1.5 - x - y) over x = 0 .. 1, y = 0 .. 1", 10.5, {"x": 1, "y": 0.5}),
    ("maximize x + y + 0*sqrt(2 - x) over x = 0.1 .. 3, y = 0.1 .. 1", 3, {"x": 2, "y": 1}),  # inner searches find nothing beyond x = 2
    ("minimize x + y + 0*sqrt(x - 1) over x = 0.1 .. 3, y = 0.1 .. 1", 1.1, {"x": 1, "y": 0.1}))


def optima(tests):
    """Optima that are known analytically."""
    for statement, value, place in OPTIMA:
        values, _, done = run_json(tests, statement + "\n")
        got = {v["name"]: v["value"] for v in values}
        tests.check(statement, values and abs(values[-1]["value"] - value) < 1e-7 * max(1, abs(value))
                    and all(abs(got[name] - v) < 1e-7 * max(1, abs(v)) for name, v in place.items()), tests.report(done))


def damper(tests):
    by = {}
    for row in table("damper.csv"):
        by.setdefault(row["setup"], []).append(row)
    for setup, rows in by.items():
        names = ("Ksec", "Kp", "Kpp", "loss_factor")
        lines = [setup]
        for row in rows:
            d = "%r m" % float(row["dxA"])
            lines.append(", ".join("%s(%s)" % (n, d) for n in names) + ", pi*(%s)^2*Kpp(%s)/dWd(%s)" % (d, d, d))
            if row["FA"]:
                lines.append("loss_factor(%s N)" % row["FA"])
        values, _, done = run_json(tests, "\n".join(lines) + "\n")
        values = iter([v["value"] for v in values])
        worst = 0.0
        try:
            for row in rows:
                for n in names:
                    worst = max(worst, abs(next(values) / float(row[n]) - 1))
                worst = max(worst, abs(next(values) - 1))
                if row["FA"]:  # the rounding of F_A matters close to gross slip
                    s = 1 - float(row["FA"]) / 40
                    worst = max(worst, abs(next(values) / float(row["loss_factor"]) - 1) - 1e-15 / max(s, 1e-9))
            tests.check("damper: " + setup, worst < 1e-14, "%.2e" % worst)
        except StopIteration:
            tests.check("damper: " + setup, False, tests.report(done))


def other_shapes(tests):
    """Kp below gross slip against the midpoint rule, which converges fast over a whole period."""
    count = 600
    for shape in ("flat-cone b=0.1 mm slope=0.01", "flat-rounded b=0.1 mm R=10 mm", "exact-sphere R=10 mm",
                  "sum 2:50 m^-1, 4:2e9 m^-3"):
        setup = "material steel; friction 0.4; geometry %s; press FN=100 N\n" % shape
        d = 0.5e-6
        angles = [(i + 0.5) / count * math.pi for i in range(count)]
        script = setup + "\n".join("Fx(%r m)" % (d * math.sin(t / 2) ** 2) for t in angles) + "\nKp(%r m)\n" % d
        values, _, done = run_json(tests, script)
        v = [value["value"] for value in values]
        if tests.check("damper: " + shape, len(v) == count + 1, tests.report(done)):
            want = -4 / (math.pi * d) * math.fsum(f * math.cos(t) for f, t in zip(v, angles)) * math.pi / count
            tests.check("Kp: " + shape, abs(v[-1] / want - 1) < 1e-12, "%r %r" % (v[-1], want))


# six-point Gauss rule
GAUSS = [(0.5 + side * x / 2, w / 2) for x, w in ((0.2386191860831969, 0.467913934572691), (0.6612093864662645, 0.3607615730481386),
                                                  (0.932469514203152, 0.1713244923791703)) for side in (-1, 1)]


def sharp_turns(tests):
    """Kp at the amplitude of gross slip for laws with sharp bends, by quadrature in parts that get short towards ends and bends."""
    rows = "r [mm],f [um]\n" + "".join("%g,%g\n" % (0.1 * i, 10 * max(0, 0.1 * i - 0.25) ** 1.5) for i in range(11))
    with tests.file(rows, ".csv") as path:
        for k, shape, a in ((0.2, "sum 1:0.01, 20:1e55 m^-19", 1), (-0.8, "flat-cone b=0.5 mm slope=0.01", 1), (-0.5, "file " + path, 0.95)):
            setup = "material E0=210 GPa nu=0.3 k=%g c0=1 mm; friction 0.4; geometry %s; press a=%g mm\n" % (k, shape, a)
            [d] = [value["value"] for value in run_json(tests, setup + "dxmax\n")[0]]
            cuts = sorted({x for i in range(30) for x in (0.5 * 2.0 ** -i, 1 - 0.5 * 2.0 ** -i, i / 30)} | {0.0, 1.0})
            nodes = [(lo + (hi - lo) * (j + t) / 3, w * (hi - lo) / 3) for lo, hi in zip(cuts, cuts[1:]) for j in range(3) for t, w in GAUSS]
            script = setup + "\n".join("Fx(%r m)" % (d * math.sin(math.pi / 2 * x) ** 2) for x, _ in nodes) + "\nKp(%r m)\n" % d
            values, _, done = run_json(tests, script)
            v = [value["value"] for value in values]
            if tests.check("damper: " + shape, len(v) == len(nodes) + 1, tests.report(done)):
                want = -4 / d * math.fsum(f * math.cos(math.pi * x) * w for f, (x, w) in zip(v, nodes))
                tests.check("Kp: " + shape, abs(v[-1] / want - 1) < 1e-10, "%r %r" % (v[-1], want))


SHAPES = ("geometry sphere R=10 mm", "geometry flat-cone b=0.1 mm slope=0.01", "geometry cone slope=0.05; k = 0.5, c0 = 1 mm")


def run_elements(elements, path):
    """F_x along a path of displacements, and the work done, of Jenkins elements (spring and slider) in parallel."""
    force, last, work, out = [0.0] * len(elements), 0.0, 0.0, []
    for d in path:
        before = sum(force)
        for i, (k, s) in enumerate(elements):
            force[i] = max(-s, min(s, force[i] + k * (d - last)))
        work += (before + sum(force)) / 2 * (d - last)
        last = d
        out.append(sum(force))
    return out, work


def jenkins(tests):
    """The error stated for a Jenkins model is the error of the elements when they are run, and of order 2."""
    for shape in SHAPES:
        setup = "material steel; friction 0.4; %s; press FN=100 N" % shape
        errors = {}
        for count in (1, 4, 8, 16):
            name = os.path.join(tests.dir, "jenkins.csv")
            values, events, done = run_json(tests, "%s; export jenkins %d to %s; dxmax\n" % (setup, count, name))
            if not tests.check("jenkins: " + shape, len(values) == 3 and events, tests.report(done)):
                return
            stated, most = values[0]["value"], values[2]["value"]
            with open(name, encoding="utf-8") as f:
                elements = [tuple(map(float, line.split(","))) for line in f if line[0] not in "#k"]
            amplitudes = [most * i / 40 for i in range(1, 60)]
            losses, _, done = run_json(tests, setup + "\n" + "\n".join("dWd(%r m)" % d for d in amplitudes) + "\n")
            seen = max(abs(sum(4 * s * max(d - s / k, 0) for k, s in elements) - loss["value"])
                       for d, loss in zip(amplitudes, losses))
            errors[count] = stated
            tests.check("jenkins: %d elements err as stated (%s)" % (count, shape), 0.5 * stated < seen <= stated * (1 + 1e-9),
                        "%g, stated %g" % (seen, stated))
            tests.check("jenkins: the elements slide at mu FN", abs(sum(s for _, s in elements) - 40) < 1e-9, str(elements))
        tests.check("jenkins: order 2 (%s)" % shape, 3.5 < errors[8] / errors[16] < 4.6, str(errors))
        # a loop, step by step, with steps at which each element begins to slide
        d = 0.7 * most
        steps = sorted({s / k for k, s in elements} | {2 * s / k for k, s in elements} | {d * i / 200 for i in range(401)})
        up = [x for x in steps if x <= d] + [d]
        down = [d - x for x in steps if x <= 2 * d] + [-d]
        back = [-x for x in down]
        _, before = run_elements(elements, up)
        _, after = run_elements(elements, up + down + back)
        (loss,), _, done = run_json(tests, "%s; dWd(%r m)\n" % (setup, d))
        tests.check("jenkins: a loop of the elements (%s)" % shape, abs(after - before - loss["value"]) <= 1.01 * errors[16],
                    "%g %g" % (after - before, loss["value"]))


def to_an_amplitude(tests):
    """A model up to FA: the energy has the stated error, the force what follows from it, and none at FA; the last element only sticks."""
    name = os.path.join(tests.dir, "amplitude.csv")
    for shape in SHAPES:
        setup = "material steel; friction 0.4; %s; press FN=100 N" % shape
        for load in ("1 N", "20 N", "39.9 N"):
            for count in (2, 5, 12):
                values, _, done = run_json(tests, "%s; export jenkins %d to %s FA=%s; dx(%s)\n" % (setup, count, name, load, load))
                title = "jenkins: %d elements up to %s (%s): " % (count, load, shape)
                if not tests.check(title + "runs", len(values) == 3, tests.report(done)):
                    return
                stated, most = values[0]["value"], values[2]["value"]
                with open(name, encoding="utf-8") as f:
                    elements = [tuple(map(float, line.split(","))) for line in f if line[0] not in "#k"]
                tests.check(title + "they slide at mu FN", len(elements) == count and abs(sum(s for _, s in elements) - 40) < 1e-9
                            and min(k for k, _ in elements) > 0 and elements[-1][1] / elements[-1][0] >= most, str(elements))
                amplitudes = [most * i / 40 for i in range(1, 41)]
                values, _, done = run_json(tests, setup + "\n" + "\n".join("dWd(%r m); Fx(%r m)" % (d, d) for d in amplitudes) + "\n")
                answers = [v["value"] for v in values]
                energy = force = 0.0
                for i, d in enumerate(amplitudes):
                    energy = max(energy, abs(sum(4 * s * max(d - s / k, 0) for k, s in elements) - answers[2 * i]))
                    off = abs(sum(min(k * d, s) for k, s in elements) - answers[2 * i + 1])
                    force = max(force, off * 2 * d)
                tests.check(title + "energy", 0.5 * stated < energy <= stated * (1 + 1e-9), "%g, stated %g" % (energy, stated))
                tests.check(title + "force", force <= stated * (1 + 1e-9), "%g, of %g" % (force, stated))
                tests.check(title + "force at FA", off < 1e-12 * 40, "%g" % off)


def exported(tests, setup, what, name):
    """Exports a model; the rows of the file in SI units."""
    done = tests.run("-c", "%s; export %s" % (setup, what))
    tests.check("export %s, %s" % (what, setup), done.returncode == 0, tests.report(done))
    with open(os.path.join(tests.dir, name), encoding="utf-8") as f:
        head, *rows = f.read().splitlines()
    return head, [[float(word) for word in row.split(",")] for row in rows]


def harmonics(tests):
    """The exported table of K' and K'' against the first harmonic of exported loops, and against its own loss."""
    for shape in SHAPES:
        setup = "material steel; friction 0.4; %s; press FN=100 N" % shape
        (most,), _, _ = run_json(tests, setup + "; dxmax\n")
        span = "for dxA = 0 .. %r m" % (1.5 * most["value"])
        head, rows = exported(tests, setup, "harmonic to harmonic.csv %s steps 5" % span, "harmonic.csv")
        values, _, _ = run_json(tests, setup + "; " + "; ".join("Kp(%r m), Kpp(%r m), dWd(%r m)" % (3 * (row[0],)) for row in rows[1:]) + "; Kp(0 m)\n")
        values = [v["value"] for v in values]
        tests.check("harmonic: as asked one by one (%s)" % shape, head == "dxA [m],Kp [N/m],Kpp [N/m]" and
                    rows[0] == [0, values[-1], 0] and [row[1:] for row in rows[1:]] == [values[i:i + 2] for i in range(0, 15, 3)], str(rows))
        tests.check("harmonic: the loss (%s)" % shape, all(abs(math.pi * d * d * Kpp / dW - 1) < 1e-14 for (d, _, Kpp), dW in zip(rows[1:], values[2::3])))
        for d, Kp, Kpp in rows[1:]:
            head, loop = exported(tests, "%s; cycle dxA=%r m" % (setup, d), "loop to loop.csv steps 400", "loop.csv")
            down, up = [row[1:] for row in loop if row[0] == 1], [row[1:] for row in loop if row[0] == 2]
            tests.check("loop: branches (%s)" % shape, head == "branch,dx [m],Fx [N],FN [N]" and len(down) == len(up) == 401 and
                        down[-1] == up[0] and down[0][0] == d and down[-1][0] == -d and all(a[0] > b[0] for a, b in zip(down, down[1:])) and
                        all(a[0] < b[0] for a, b in zip(up, up[1:])) and all(abs(row[2] - 100) < 1e-12 for row in down + up), str(loop[:3]))
            tests.check("loop: it turns over (%s)" % shape, all(abs(a[1] + b[1]) < 1e-9 for a, b in zip(down, up)))
            forces = [row[1] for row in down[:-1] + up[:-1]]
            harmonic = [2 / d / 800 * sum(F * f(2 * math.pi * i / 800) for i, F in enumerate(forces)) for f in (math.cos, math.sin)]
            tests.check("harmonic: that of the loop (%s)" % shape, abs(harmonic[0] / Kp - 1) < 2e-4 and abs(-harmonic[1] / Kpp - 1) < 2e-4,
                        "%s of %g, %g" % (harmonic, Kp, Kpp))
    rows = exported(tests, setup, "harmonic to harmonic.csv for dxA = 1 nm .. 100 nm log steps 2", "harmonic.csv")[1]
    tests.check("harmonic: in ratios", [round(row[0] * 1e9, 9) for row in rows] == [1, 10, 100], str(rows))
    swinging = "material steel; friction 0.4; geometry sphere R=10 mm; press FN=100 N; cycle FA=20 N FNA=30 N phase=60 deg times 3"
    loop = exported(tests, swinging, "loop to loop.csv steps 800", "loop.csv")[1]
    area = sum((a[2] + b[2]) / 2 * (b[1] - a[1]) for a, b in zip(loop, loop[1:]))
    (dW,), _, _ = run_json(tests, swinging + "; dW\n")
    tests.check("loop: a swinging one", abs(area / dW["value"] - 1) < 1e-4 and abs(min(row[3] for row in loop) - 70) < 1e-3, "%g" % area)
    done = tests.run("-c", swinging + "; export loop to loop.json steps 1")
    with open(os.path.join(tests.dir, "loop.json"), encoding="utf-8") as f:
        event, *rows = map(json.loads, f)
    tests.check("loop: as JSON", event == {"event": "export", "columns": {"branch": "", "dx": "m", "Fx": "N", "FN": "N"}} and
                [row["branch"] for row in rows] == [1, 1, 2, 2], tests.report(done))


def tiny(tests):
    """Loads whose loss is nearly too small for a double; above that the relative error is constant, since the loss goes with F^3."""
    setup = "material steel; friction 0.4; geometry sphere R=10 mm; press FN=100 N; "
    name = os.path.join(tests.dir, "tiny.csv")
    for load in ("1e-3", "1e-6", "1e-8"):
        values, events, done = run_json(tests, setup + "export jenkins 5 to %s FA=%s N; dW(%s N)\n" % (name, load, load))
        tests.check("jenkins up to %s N" % load, len(values) == 3 and abs(values[1]["value"] - 0.008622) < 1e-5
                    and abs(values[0]["value"] / values[2]["value"] - 0.008622) < 1e-5, tests.report(done))
        os.remove(name)
    for load in ("FA=1e-12 N", "FA=1e-110 N", "FA=1e-190 N; "):
        done = tests.run("-c", setup + ("FN = 1e-189 N; " if load[-2] == ";" else "") + "export jenkins 4 to %s %s" % (name, load))
        tests.check("jenkins up to %s" % load, done.returncode == 1 and "the load is too small" in done.stderr
                    and not os.path.exists(name), tests.report(done))


def header(tests):
    """The exported C table compiles, and its values add up."""
    name = os.path.join(tests.dir, "elements.h")
    done = tests.run("-c", "material steel; friction 0.4; geometry sphere R=10 mm; press FN=100 N; export jenkins 5 to %s; "
                     "export jenkins 5 to %s.json FA=20 N" % (name, name))
    source = os.path.join(tests.dir, "elements.c")
    with open(source, "w", encoding="utf-8") as f:
        f.write('#include <stdio.h>\n#include "elements.h"\nint main(void) {\n    double s = 0;\n'
                '    for (int i = 0; i < JENKINS_ELEMENTS; i++)\n        s += jenkins_element[i].slip;\n'
                '    printf("%.6f", s);\n    return 0;\n}\n')
    made = subprocess.run(["cc", "-std=c11", "-Wall", "-Wextra", "-Werror", "-o", source[:-2], source], capture_output=True, text=True)
    ran = subprocess.run([source[:-2]], capture_output=True, text=True).stdout if made.returncode == 0 else made.stderr
    tests.check("jenkins: the C table", done.returncode == 0 and ran == "40.000000", done.stderr + ran)
    with open(name + ".json", encoding="utf-8") as f:
        model = json.load(f)
    tests.check("jenkins: JSON up to an amplitude", len(model["elements"]) == 5 and abs(sum(e["slip"] for e in model["elements"]) - 40) < 1e-9,
                str(model))


def bent(tests):
    """Uncertainties where the first order vanishes, or holds only close to the present value."""
    for script, deviation, spread in (("x = 0; uncertainty 2*x + 1 with x +- 0.1", 0.2, None),
                                      ("x = 0; uncertainty x^3 with x +- 0.1", 0, math.sqrt(15) * 1e-3),
                                      ("x = 0; uncertainty sin(3*x) with x +- 1", 3, None),
                                      ("x = 1e-25; uncertainty sin(1 + x) with x +- 1e-9", 1e-9 * math.cos(1), None),
                                      ("x = -1e-12 m; uncertainty sin((1 m + x)/(1 m)) with x +- 1 nm", 1e-9 * math.cos(1), None),
                                      ("x = 1e-3; uncertainty sqrt(x) with x +- 0.1", 0.05 / math.sqrt(1e-3), None),
                                      ("x = 1; uncertainty sqrt(x - 0.9995) with x +- 0.1", 0.05 / math.sqrt(0.0005), None)):
        values, events, done = run_json(tests, script + "\n")
        events = [e for e in events if e["event"] == "uncertainty"]
        tests.check(script, events and abs(events[0]["deviation"] - deviation) < 1e-9 * max(deviation, 1e-6)
                    and (spread is None or (events[0]["Monte Carlo"]["differs"]
                                            and abs(events[0]["Monte Carlo"]["deviation"] / spread - 1) < 0.05)), tests.report(done))


def linear(tests):
    """First order and Monte Carlo agree for a linear expression."""
    values, events, done = run_json(
        tests, "x = 3 N, y = 4 N, z = 5\nuncertainty 2*x - 3*y + 0*x*z with x +- 0.3 N, y +- 10 %, z +- 1\n")
    events = [e for e in events if e["event"] == "uncertainty"]
    if not tests.check("uncertainty: a linear sum", events, tests.report(done)):
        return
    (e,) = events
    want = (0.6 ** 2 + 1.2 ** 2) ** 0.5
    mc = e["Monte Carlo"]
    tests.check("uncertainty: first order", abs(e["deviation"] / want - 1) < 1e-12 and abs(e["shares"]["y"] - 0.8) < 1e-12
                and e["shares"]["z"] == 0, str(e))
    tests.check("uncertainty: Monte Carlo agrees", not mc["differs"] and abs(mc["deviation"] / want - 1) < 0.03
                and abs(mc["mean"] + 6) < 0.05 and mc["samples"] == 10000, str(e))
    again = tests.run("--format=json", "-c", "x = 3 N; uncertainty x^2 with x +- 0.3 N").stdout
    tests.check("uncertainty: the same seed, the same answer",
                again == tests.run("--format=json", "-c", "x = 3 N; uncertainty x^2 with x +- 0.3 N").stdout)


def stays(tests):
    """The questions change neither the scene nor the names."""
    setup = "material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N; cycle FA=20 N; v = 3 N; FNA = 0 N; "
    asked = ("solve mu for dW = 1 uJ; solve v for dW(v) = 1 uJ; solve Q for dW(Q) = 1 uJ from 1 N to 30 N; "
             "maximize dW(Q) over Q = 1 N .. 30 N; maximize dW(v) over v = 1 N .. 30 N; uncertainty dW, v with mu +- 0.01, v +- 1 N; "
             "solve mu for dW = 1 J; maximize dW over mu = 0.01 .. 0.02; ")
    plain = tests.run("--keep-going", "-c", setup + "show; v; Q")
    after = tests.run("--keep-going", "-c", setup + asked + "show; v; Q")
    tests.check("questions leave the scene as it is", after.stdout.endswith(plain.stdout) and "unknown name 'Q'" in after.stderr,
                plain.stdout + tests.report(after))


def told(tests):
    """`set timing on` reports how the answer was found."""
    done = tests.run("-c", "material steel; geometry sphere R=10 mm; press FN=100 N; set timing on; solve FN for a = 0.2 mm; "
                     "minimize dz over FN = 20 N .. 100 N")
    tests.check("timing tells method, evaluations and bracket",
                re.search(r"solve: scan and secant, \d+ evaluations, bracket FN = [\d.]+ N \.\. [\d.]+ N", done.stderr)
                and re.search(r"minimize: grid, golden section, \d+ evaluations", done.stderr), tests.report(done))


    for question, want in (
            ("maximize sqrt(1-x) + x over x = 0 .. 5", "grid, golden section, Newton's method"), ("minimize x over x = -3 .. 3", "grid, golden section"),
            ("minimize (x-1)^2 + y over x = -3 .. 3, y = 0 .. 1", "grid, golden section, Newton's method"),
            ("minimize x + y over x = -3 .. 3, y = 0 .. 1", "grid, golden section"),
            ("maximize x + y + 0*sqrt(2-x-y) over x = 0.1 .. 3, y = 0.1 .. 3", "grid, golden section")):
        done = tests.run("-c", "set timing on; " + question)
        tests.check("timing of " + question, ": %s, " % want in done.stderr and " evaluations\n" in done.stderr, tests.report(done))
    for sides, key in (("(x-1)^2 = 0", "touches"), ("1/(x-1) = 3 from 0 to 5", "jumps"), ("x^3 = 8", None)):
        values, events, done = run_json(tests, "x = 2; solve x for %s\n" % sides)
        tests.check("solve tells of %s: %s" % (key, sides), [name for name in ("touches", "jumps") if events[0].get(name)] == [key] * bool(key) and
                    done.stderr.count("note: ") == bool(key), tests.report(done))
    values, events, done = run_json(tests, "solve unknown for unknown^3 = 8 from 1 to 5\nunknown\n")
    tests.check("a name is known for its question alone", abs(values[0]["value"] - 2) < 1e-15 and "unknown name 'unknown'" in done.stderr, tests.report(done))


def valleys(tests):
    """The minimum in a bent valley whose bottom is a kink."""
    for steep, x_range, y_range in ((100, "-1.3 .. 3.1", "-2.2 .. 6.3"), (10, "-0.7 .. 2.9", "-1.1 .. 8.4"), (3, "0.2 .. 2.3", "-1.4 .. 5.7")):
        question = "minimize abs(x-1.2345) + %d*abs(y-x^2) over x = %s, y = %s" % (steep, x_range, y_range)
        values, _, done = run_json(tests, question + "\n")
        tests.check(question, abs(values[0]["value"] - 1.2345) < 1e-6 and abs(values[1]["value"] - 1.2345**2) < 1e-6, tests.report(done))
    values, _, done = run_json(tests, "minimize abs(x-1.2345) + 100*abs(y-x^2) + 10*abs(z-y) over x = 0 .. 3, y = 0 .. 4, z = 0 .. 4\n")
    tests.check("a valley in three names", all(abs(v["value"] - w) < 1e-6 for v, w in zip(values, (1.2345, 1.2345**2, 1.2345**2))), tests.report(done))


def poles(tests):
    """All roots beside poles, in order, without the poles; and pairs of roots between two places of the scan."""
    def tangent(L, lo, hi):
        return [x for x in (math.atan(L) + n * math.pi for n in range(20)) if lo < x < hi]
    asked = [("tan(x) = %r from %r to %r" % at, tangent(*at)) for at in
             ((10, 1, 8), (100, 1, 8), (10, 1.4, 8), (10, 1, 30), (-30, 2, 9), (1e4, 1, 11), (0.5, 0.1, 16))]
    for pole, strength, L in ((2, 1, 50), (2, 1, -50), (2.3, 1e-3, 1), (2, 1e-4, -3), (2, -5, 8), (3.97, 0.1, 20)):
        asked += [("%r/(x-%r) = %r from %r to %r" % (strength, pole, L, lo, hi), [pole + strength / L])
                  for lo, hi in ((0, 4), (0.1, 4))]
    half = [2.991456, 6.620579, 8.960238, 13.293424, 14.869697]
    swinging = [-x for x in reversed(half)] + [0] + half
    asked += [("sin(x) = 0.99 from 0 to 20", [x + 2 * n * math.pi for n in range(3) for x in (math.asin(0.99), math.pi - math.asin(0.99))]),
              ("(x-1)*(x-1.01)*(x-2) = 0 from 0.1 to 3", [1, 1.01, 2]), ("(x-0.81211)^2*(x-1.0236)^2 = 0 from 0 to 3", [0.81211, 1.0236]),
              ("(x-6.51)^2*(x-8.30705)^2*(x-7.1332) = 0 from 0 to 10", [6.51, 7.1332, 8.30705]), ("(x-8.55)^3*(x-6.24777)^2 = 0 from 0.10202683 to 8", [6.24777]), ("1/(x-2)^2 = 50 from 0.1 to 4", [2 - 50**-0.5, 2 + 50**-0.5]),
              # the cubic (x-1)(x-2)(x-3) = 1/1000
              ("1/((x-1)*(x-2)*(x-3)) = 1000 from 0 to 4", [1.000500375703, 1.998999998999994, 3.000499625297]),
              ("sin(x) = 0 from 1 to 37", [n * math.pi for n in range(1, 12)]), ("sin(x) = x/20 from -30 to 30", swinging),
              ("abs(x-1)/(x-1) = 0.5 from 0.1 to 3", []), ("tan(x) = 0 from 1 to 2", [])]
    for sides, want in asked:
        values, _, done = run_json(tests, "solve x for %s\n" % sides)
        listed = re.search(r"several roots, x = (.*): choose", done.stderr)
        got = [float(x) for x in listed.group(1).split(", ")] if listed else [v["value"] for v in values]
        tests.check("solve x for " + sides, len(got) == len(want) and all(abs(a - b) <= 1e-5 * abs(b) for a, b in zip(got, want)),
                    "%s\n%s" % (want, tests.report(done)))
    done = tests.run("-c", "solve x for sin(x) = 0 from 20 to 80")
    tests.check("no more roots are listed than one can read", done.stderr.count("...: choose one with") == 1 and done.stderr.count(", ") == 13,
                tests.report(done))


def run(tests):
    questions(tests)
    poles(tests)
    valleys(tests)
    edges(tests)
    optima(tests)
    damper(tests)
    other_shapes(tests)
    sharp_turns(tests)
    jenkins(tests)
    to_an_amplitude(tests)
    harmonics(tests)
    tiny(tests)
    header(tests)
    linear(tests)
    bent(tests)
    stays(tests)
    told(tests)
