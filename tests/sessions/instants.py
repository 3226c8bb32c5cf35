# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests inputs changed by `at` along a load, as in `(W at k=0)`: the value of the changed scene at the same instant. It is compared
with the same load run in that scene, and with that scene at the end of a load that is cut there."""
import math
import os
import random
import re

import harness  # noqa: F401

MATERIALS = ("material E0=200 GPa nu=0.3; c0 = 1 mm", "material E0=200 GPa nu=0.3 k=0.2 c0=1 mm", "material E0=200 GPa nu=0.3 k=-0.4 c0=1 mm")
# A geometry, and changes that it allows.
GEOMETRIES = (("sphere R=10 mm", "R=12 mm"), ("cone slope=0.02", "slope=0.03"), ("exact-sphere R=10 mm", "R=8 mm"),
              ("flat-paraboloid b=0.2 mm R=10 mm", "b=0.1 mm"), ("power n=3 A=50 m^-2", "A=40 m^-2"),
              ("sum 2:50 m^-1, 4:2e6 m^-3", "nu=0.2"))
PRESSES = ("press FN=100 N", "press FN=100 N", "press dz=3 um", "press a=0.3 mm", "press FN=100 N; c0 := a0")
STEPS = ("step dx=0.3 um", "step dx+=0.2 um", "step FN=120 N dx=0.2 um", "step FN+=10 N", "step dz+=0.1 um", "step dx=-0.2 um",
         "cycle dxA=0.4 um", "cycle dxA=0.4 um times 3")
BY_FORCE = ("step Fx=20 N", "step FN=130 N Fx=10 N", "cycle FA=20 N times 2", "cycle FA=20 N FNA=15 N phase=70 deg",
            "cycle FA=15 N FNA=10 N times 2")
LOADS = ("program", "program", "step dx=0.7 um", "cycle dxA=0.5 um")
LOADS_BY_FORCE = ("cycle", "cycle FA=12 N FNA=20 N phase=90 deg", "step FN=90 N Fx=10 N")
CHANGES = ("k=0.1", "mu=0.5", "mu=0.35", "E0=150 GPa", "nu=0.2")
ASKED = ("Fx", "dx", "W", "a", "c", "U", "dW", "FN", "dz", "kt", "kn", "p(0 m)", "qx(0.1 mm)", "u1D(0.1 mm)", "Fx/(mu*FN)", "c(5 N)",
         "W1D", "dxmax", "time")


def rows(tests, script):
    """The rows of the table at the end of the script, with rounded times, and the run."""
    done = tests.run("--format=json", "-c", script)
    found = harness.told(done.stdout)
    found = [list(row.values()) for row in found if "time" in row and "event" not in row]
    for row in found:
        row[0] = round(row[0], 9)
    return found, done


def alike(one, other):
    """Are two columns equal, but for the rounding of times in a load whose F_N swings?"""
    most = max([abs(v) for v in one if v is not None], default=0)
    return len(one) == len(other) and all(a == b or None not in (a, b) and abs(a - b) <= 1e-13 * most for a, b in zip(one, other))


def changed(rng):
    """A random scene with a load, the load along which it is evaluated, and a change of the scene."""
    geometry, other = rng.choice(GEOMETRIES)
    press = rng.choice(PRESSES)
    force = "FN=" in press
    steps = rng.choices(STEPS + (BY_FORCE if force else ()), k=rng.randrange(5))
    load = rng.choice(LOADS + (LOADS_BY_FORCE if force else ()))
    changes = CHANGES + (other, other) + (("FN=110 N",) if force else ())
    if load in ("program", "cycle") and any("FA=" in step for step in steps[-1:]):
        changes += ("FA=10 N", "FNA=5 N", "phase=10 deg")
    setup = "; ".join([rng.choice(MATERIALS), "geometry " + geometry, "friction 0.4", press, *steps])
    return setup, load, rng.choice(changes), rng.choice(changes)


def against_with(tests):
    """The column of `at` equals that of `with`, also nested and through a definition."""
    rng = random.Random(20)
    compared = []

    def one(setup, load, change, further, x, steps):
        head = "%s; table " % setup
        tail = " along %s steps %d" % (load, steps)
        want, as_with = rows(tests, head + x + tail + " with " + change)
        got, as_at = rows(tests, head + "(%s at %s)" % (x, change) + tail)
        name = setup + ": (%s at %s)%s" % (x, change, tail)
        if as_with.returncode:  # no value there; no table if the load is impossible in the scene itself, too
            tests.check(name + " is refused", as_at.returncode and not any(row[1] is not None for row in got), tests.report(as_at))
            return
        compared.append(name)
        tests.check(name, [row[0] for row in want] == [row[0] for row in got] and alike([row[2] for row in want], [row[1] for row in got]),
                    "%s\n%s" % (want, got))
        if further.partition("=")[0] == change.partition("=")[0]:
            return
        got, done = rows(tests, "%s; Y := (%s at %s); table (%s at %s, %s), ((%s at %s) at %s), (Y at %s), (%s at %s)%s" % (
            setup, x, change, x, change, further, x, change, further, further, x, further, tail))
        columns = list(zip(*got))
        tests.check(name + " nested", bool(got) == (not done.returncode) and all(alike(columns[1], v) for v in columns[2:4]), tests.report(done))

    count = 40 if tests.few else 150
    tests.each([lambda a=changed(rng), x=rng.choice(ASKED), n=rng.choice((1, 3, 7, 10, 40)): one(*a, x, n) for _ in range(count)])
    tests.check("most of them are compared", len(compared) > count / 2, str(len(compared)))


def against_cut(tests):
    """At the end of each step the state is that of a load program that ends there."""
    steps = ["step Fx=20 N", "step FN=130 N Fx=10 N", "step dx+=0.2 um", "step Fx=-15 N", "step FN=90 N"]
    for change in ("k=0", "mu=0.5, k=-0.3", "R=20 mm", "FN=115 N"):
        for setup in ("material E0=210 GPa nu=0.3 k=0.2 c0=1 mm; geometry sphere R=10 mm; friction 0.4; press FN=100 N",
                      "material E0=210 GPa nu=0.3 k=0.2 c0=1 mm; geometry sphere R=10 mm; friction 0.4; press FN=100 N; c0 := a0"):
            asked = ["Fx", "dx", "W", "a", "c", "kt"]
            got, done = rows(tests, "; ".join([setup, *steps, "step dx=0 um", "undo", "table %s along program steps 5" % ", ".join(
                "(%s at %s)" % (x, change) for x in asked)]))
            for i, row in enumerate(got):
                cut = tests.run("--format=json", "-c", "; ".join([setup, *steps[:i], *("%s at %s" % (x, change) for x in asked)]))
                want = harness.printed_values(cut.stdout)[-len(asked):]
                tests.check("%s at %s after %d steps" % (setup, change, i),
                            row[0] == i and all(abs(a - b) <= 4e-16 * abs(b) for a, b in zip(row[1:], want)), "%s\n%s" % (row, want))
            tests.check("%s at %s: rows" % (setup, change), len(got) == 6, tests.report(done))


def many(tests):
    """More instants, and more changed scenes, than are kept at a time; and a change that differs at each instant."""
    scene = "material E0=210 GPa nu=0.3 k=0.2 c0=1 mm; geometry sphere R=10 mm; friction 0.4; press FN=100 N; step Fx=20 N; cycle FA=30 N"
    swings = scene + "; cycle FA=15 N FNA=20 N phase=60 deg"
    for setup, steps in ((scene, 20000), (swings, 1500)):
        want, _ = rows(tests, setup + "; table W, c along program steps %d with mu=0.5" % steps)
        got, done = rows(tests, setup + "; table (W at mu=0.5), (c at mu=0.5) along program steps %d" % steps)
        columns = list(zip(*want))
        tests.check("%d instants" % steps, len(got) > steps and all(alike(a, b) for a, b in zip([columns[0], *columns[2:]], zip(*got))), tests.report(done))
    got, done = rows(tests, swings + "; table W, (W at mu=0.4 + time/50) along program steps 30")
    want = []
    for part in (got[:16], got[16:]):
        values = ", ".join("%.17g" % (0.4 + row[0] / 50) for row in part)
        want += rows(tests, swings + "; table W along program steps 30 with mu=" + values)[0]
    each = {(round(row[1], 9), row[0]): row[2] for row in want}
    tests.check("another friction at each instant", len(got) == 31 and len({row[2] - row[1] for row in got}) > 20 and all(
        abs(row[2] - each[round(0.4 + row[0] / 50, 9), row[0]]) <= 1e-7 * row[1] for row in got), tests.report(done))
    mus = ["%g" % (0.41 + 0.01 * i) for i in range(25)]
    want = [row for part in (mus[:13], mus[13:]) for row in rows(tests, swings + "; table dx along program steps 7 with mu=" + ", ".join(part))[0]]
    got = [rows(tests, swings + "; Y(q) := (dx at mu=q); table %s along program steps 7" % ", ".join("Y(%s)" % m for m in part))[0]
           for part in (mus[:13], mus[13:])]
    told = [a[1:] + b[1:] for a, b in zip(*got)]
    each = {(row[1], row[0]): row[2] for row in want}
    tests.check("scenes by the arguments of a function", len(told) == 8 and all(
        alike([each[float(m), row[0]] for m in mus], values) for row, values in zip(got[0], told)), str(told))


def curves(tests, script, name):
    """The curves that the script's last statement plots: [[(x, y)]]"""
    done = tests.run("-c", script + " to %s.gp" % name)
    if not tests.check("drawn: " + name, done.returncode == 0, tests.report(done)):
        return []
    with open(os.path.join(tests.dir, name + ".gp"), encoding="utf-8") as f:
        return [[tuple(map(float, row.split())) for row in block.splitlines()]
                for block in re.findall(r"^\$data\S+ << END\n(.*?)^END$", f.read(), re.S | re.M)]


def turning_points(tests):
    """A figure has points at the turning points of the load, also for a changed scene that does not turn there."""
    press = "material E0=210 GPa nu=0.3 k=0.2 c0=1 mm; geometry sphere R=10 mm; friction 0.4; press FN=100 N"
    drawn = curves(tests, press + "; cycle FA=20 N FNA=15 N phase=70 deg; plot W, (W at FNA=0 N) along program steps 4", "turns")
    between = [(x, y) for x, y in (drawn[1] if len(drawn) == 2 else ()) if x % 0.3125 > 1e-9]
    tests.check("turning points drawn", len(between) > 0 and len(drawn[0]) == len(drawn[1]), str(drawn))
    for x, y in between:
        turned = "step Fx=20 N; step Fx=-20 N; " if x > 0.75 else "step Fx=20 N; " if x > 0.25 else ""
        done = tests.run("--format=json", "-c", "%s; %sstep Fx=20 N*%s; W in uJ" % (press, turned, "sin(2*pi*%.17g)" % x))
        want = harness.printed_values(done.stdout)[-1]
        tests.check("W at the turn at %g" % x, abs(1e-6 * y - want) <= 1e-8 * want, "%g %g" % (y, want))
    load = press + "; cycle FA=20 N; plot W, (W at FNA=10 N, phase=70 deg) along program steps 4"
    drawn = curves(tests, load, "chords")  # the ends of chords are no turning points
    want, done = rows(tests, press + "; cycle FA=20 N FNA=10 N phase=70 deg; table W along program steps 5")
    want = {at: W for at, W in want}
    found = [(x, y) for x, y in (drawn[1] if len(drawn) == 2 else ()) if x in (0.25, 0.75)]
    tests.check("turns among chords", len(found) == 2 and all(abs(1e-6 * y - want[x]) <= 1e-7 * want[x] for x, y in found),
                "%s %s" % (found, want))


def kept_instants(tests):
    """A figure of a load with many steps has the same curves with another scene beside it."""
    with tests.file("FN [N],Fx [N]\n" + "".join("%.17g,%.17g\n" % (100 + i % 3, 15 * math.sin(0.37 * i)) for i in range(400)), ".csv") as path:
        followed = "material steel; geometry sphere R=10 mm; friction %s; press FN=100 N; follow " + path + "; plot %s along program steps 20"
        both = curves(tests, followed % ("0.4", "W, (W at mu=0.5)"), "both")
        times = curves(tests, followed % ("0.4", "W*time"), "times")
        each = curves(tests, followed % ("0.4", "W, U"), "kept") + curves(tests, followed % ("0.5", "W, U"), "other")
    tests.check("many steps, two frictions", len(both) == 2 and len(each) == 4 and all(len(curve) > 390 for curve in both + each),
                str([len(curve) for curve in both + each]))
    for one, other in zip(both, each[::2]):
        other = dict(other)
        tests.check("many steps: the same curve", all(abs(y - other.get(x, -1)) <= 1e-8 * max(map(abs, other.values())) for x, y in one),
                    "%s\n%s" % (one[:9], list(other.items())[:9]))
    tests.check("many steps: their times", [len(curve) for curve in times] == [len(each[0])] and all(
        x == at and abs(y / times[0][-1][1] - W * at / math.prod(each[0][-1])) <= 1e-8
        for (x, y), (at, W) in zip(times[0], each[0])), str(times)[:300])


def by_definitions(tests):
    """Changing a name that an input is bound to has the effect of changing the input."""
    got, done = rows(tests, "material steel; geometry sphere R=10 mm; press FN=100 N; y = 0.4; mu := y; step FN=90 N Fx=10 N; cycle FA=10 N; "
                     "table W, (W at y=0.5), (W at mu=0.5) along program steps 6")
    tests.check("what mu is made of", len(got) == 7 and all(row[2] == row[3] for row in got) and got[-1][1] > got[-1][2] > 0, tests.report(done))


def same_but_for_a_dimension(tests):
    """Scenes that differ only in the dimension of a name, not in its number, have values of their own."""
    got, done = rows(tests, "x = 1; material steel; geometry sphere R=10 mm; press FN=100 N; mu := 0.4 + 0.1*atan(x/x - 1 + (x - x)/x); step Fx=10 N; "
                     "step Fx=-5 N; table (W at x=3), (x at x=3 N)/(1 N), (W at x=3 N), W along program steps 4")
    tests.check("3 and 3 N", len(got) == 5 and all(row[1] == row[3] == row[4] and row[2] == 3 for row in got), tests.report(done))


def periods(tests):
    """A power law under a swinging load: at the end of each period the table has the values of a load that ends there."""
    asked = "Fx, dx, W, U, dW, c, kt, FN, dz, a, u1D(0.05 mm), qx(0.12 mm)"
    rng = random.Random(11)

    def one(setup, cycle, steps):
        got, done = rows(tests, "%s; %s times 3; table %s along program steps %d" % (setup, cycle, asked, steps))
        end = got[-1][0] if got else 0
        for times in (1, 2, 3):
            plain = tests.run("--format=json", "-c", "%s; %s times %d; %s" % (setup, cycle, times, asked))
            want = [line["value"] for line in harness.told(plain.stdout) if "value" in line]
            row = [row[1:] for row in got if abs(row[0] - (end - 3 + times)) < 1e-9]
            tests.check("period %d of %s; %s" % (times, setup, cycle), len(row) == 1 and len(want) == 12 and all(
                abs(x - y) <= 1e-12 * max(abs(y), want[2] if i == 4 else 0) for i, (x, y) in enumerate(zip(row[0], want))), "%s\n%s\n%s" % (row, want, tests.report(done)))
    jobs = []
    for _ in range(16):
        setup = "%s; geometry %s; friction 0.4; press FN=100 N; step Fx=2 N" % (
            rng.choice(MATERIALS), rng.choice(("sphere R=10 mm", "cone slope=0.02", "power n=3 A=50 m^-2")))
        cycle = "cycle FA=%d N FNA=%d N phase=%d deg" % (rng.randint(2, 12), rng.randint(5, 60), rng.choice((0, 40, 90, 200)))
        jobs.append(lambda s=setup, c=cycle, n=17 * rng.choice((2, 4, 8)): one(s, c, n))
    tests.each(jobs)


def told_apart(tests):
    """Changes with the same number at one instant are told apart by their names and units."""
    got, done = rows(tests, "%s; geometry sphere R=10 mm; friction 0.4; press FN=100 N; x = 1 m; y = 2 m; cycle FA=10 N; table W, (W*x at x=3 m), "
                     "(W*x at x=3 N), (W*y at y=3 m), (W*x at y=3 m), (W*x at mu=0.5), (W*x at x=0.5 m) along program steps 5" % MATERIALS[0])
    wrong = [row for row in got if not all(math.isclose(v, by * row[1], rel_tol=1e-15) for v, by in zip(row[2:6], (3, 3, 3, 1))) or
             not math.isclose(row[7], 0.5 * row[1]) or row[6] > row[1] or (row[1] > 0) != (row[6] > 0)]
    tests.check("changed names and units are told apart", len(got) > 5 and got[-1][1] > 0 and not wrong, tests.report(done))


def beyond(tests):
    """Along a load that leaves the table of the gap: refused at once, or where it leaves it; the scene stays as it was."""
    path = os.path.join(tests.dir, "short.csv")
    with open(path, "w", encoding="ascii") as f:
        f.write("r [mm],f [um]\n" + "".join("%g,%g\n" % (0.02 * i, 0.02 * i * i) for i in range(26)))
    setup = "material steel; geometry file %s; friction 0.4; press a=0.499 mm; step Fx=1 N; " % path
    for load in ("step FN=1 MN dx=1 um", "step dz=1 mm Fx=2 N", "cycle dxA=0.1 um FNA=50 N", "cycle FA=1 N FNA=50 N", "step dz=1 mm dx=1 um"):
        done = tests.run("--keep-going", "-c", setup + "table W along %s steps 3\nFx, a" % load)
        tests.check("along a load that leaves the table: " + load, done.returncode == 1 and done.stdout == "Fx = 1 N\na = 499 um\n" and
                    done.stderr.count("error:") == 1 and "cannot be carried: the gap supports contact radii up to 500 um" in done.stderr, tests.report(done))


def run(tests):
    tests.rooms(periods, same_but_for_a_dimension, by_definitions, against_with, against_cut, many, turning_points, kept_instants, told_apart, beyond)
