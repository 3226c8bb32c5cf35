# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests fit on noisy data from an independent model, springs stepped one by one: two equal homogeneous bodies, a paraboloid. It shares
only the physics with the program."""
import json
import math
import os
import random
import re
from fractions import Fraction

SPRINGS = 1500
NU, R, FN = 0.3, 0.01, 100.0
SETUP = "material E0=%g GPa nu=0.3; geometry paraboloid R=10 mm; friction %g; press FN=100 N"


def springs_of(E0):
    """Contact radius, depth, and for each spring its place, its normal force and its tangential stiffness."""
    cN = E0 / (2 * (1 - NU ** 2))
    eta = (2 - NU) / (2 * (1 - NU))
    a = (3 * FN * R / (4 * cN)) ** (1 / 3)  # F_N = 2 c_N int_0^a (a^2-x^2)/R dx
    step = a / SPRINGS
    rows = []
    for i in range(SPRINGS):
        x = (i + 0.5) * step
        rows.append((2 * cN * step * (a * a - x * x) / R, 2 * cN / eta * step))
    return rows


def loop(mu, E0, path):
    """F_x at each displacement of a path that starts at rest."""
    rows = springs_of(E0)
    force = [0.0] * len(rows)
    out, last = [], 0.0
    for dx in path:
        total = 0.0
        for i, (normal, stiffness) in enumerate(rows):
            f = force[i] + stiffness * (dx - last)
            bound = mu * normal
            f = bound if f > bound else -bound if f < -bound else f
            force[i] = f
            total += f
        last = dx
        out.append(total)
    return out


def path_of(amplitude, count):
    """A path of displacements: to the amplitude, then through a whole loop."""
    up = [amplitude * i / count for i in range(count + 1)]
    down = [amplitude * (1 - 2 * i / count) for i in range(1, count + 1)]
    return up + down + [-d for d in down]


def write(tests, name, header, rows):
    path = os.path.join(tests.dir, name)
    with open(path, "w", encoding="utf-8") as f:
        f.write(header + "\n")
        for row in rows:
            f.write(",".join("%.10g" % v for v in row) + "\n")
    return path


def answers(tests, script):
    done = tests.run("--format=json", "-c", script)
    values, event = {}, {}
    for line in done.stdout.splitlines():
        row = json.loads(line)
        if "name" in row:
            values[row["name"]] = row["value"]
        elif row.get("event") == "fit":
            event = row
    return values, event, done


def noisy_loops(tests, count):
    """mu and E0 are within two standard errors in at least nine of ten data sets; `make fits` takes more sets."""
    mu, E0 = 0.35, 200e9
    path = path_of(0.8e-6, 25)
    clean = loop(mu, E0, path)
    noise = random.Random(12)
    inside = {"mu": 0, "E0": 0}
    for i in range(count):
        rows = [(d * 1e6, f + noise.gauss(0, 0.3)) for d, f in zip(path, clean)]
        name = write(tests, "loop%d.csv" % i, "dx [um],Fx [N]", rows)
        values, event, done = answers(tests, SETUP % (210, 0.4) + "; fit mu, E0 along " + name)
        if not event:
            tests.check("fit of noisy loop %d" % i, False, tests.report(done))
            return
        inside["mu"] += abs(values["mu"] - mu) <= 2 * event["deviation"]["mu"]
        inside["E0"] += abs(values["E0"] - E0) <= 2 * event["deviation"]["E0"]
        os.remove(name)
    for name, n in inside.items():
        tests.check("fit: %s within two standard errors in %d of %d sets" % (name, n, count), n >= 0.9 * count)


def drifting(tests):
    """A warning if residuals are not noise: with an offset, with a drift; none for noise, or for exact data."""
    mu, E0 = 0.35, 200e9
    path = path_of(0.8e-6, 25)
    clean = loop(mu, E0, path)
    noise = random.Random(5)
    for what, d0, slope, f0, spread in (("noise", 0, 0, 0, 0.3), ("nothing", 0, 0, 0, 0), ("an offset of the force", 0, 0, 3, 0.3),
                                        ("an offset of the displacement", 0.1, 0, 0, 0.3), ("a drift", 0, 0.004, 0, 0.3)):
        rows = [(d * 1e6 + d0 + slope * i, f + f0 + noise.gauss(0, spread)) for i, (d, f) in enumerate(zip(path, clean))]
        name = write(tests, "drift.csv", "dx [um],Fx [N]", rows)
        _, event, done = answers(tests, SETUP % (210, 0.4) + "; fit mu, E0 along " + name)
        wrong = what.startswith("a")
        tests.check("fit: residuals with " + what, event and ("residuals are correlated" in done.stderr) == wrong
                    and (what == "nothing" or (event["neighbours"] > 0.5) == wrong), tests.report(done))
    path = [2e-6 * math.sin(2 * math.pi * i / 200) for i in range(251)]
    for offset in (0, 5e-4):
        name = write(tests, "visible.csv", "dx [um],Fx [N]", [(d * 1e6, f + offset) for d, f in zip(path, loop(0.62, 210e9, path))])
        done = tests.run("-c", SETUP % (210, 0.4) + "; fit mu, E0 along %s noise dx=1 nm Fx=5 N" % name)
        tests.check("fit: an offset of %g N, far below the noise that is stated" % offset, done.returncode == 0 and
                    ("residuals are correlated" in done.stderr) == (offset > 0), tests.report(done))
    name = write(tests, "small.csv", "u,y", [(u, 1e-3 * u + 1e-4) for u in range(1, 9)])
    values, event, done = answers(tests, "s = 1; fit s for y = s*u to " + name)
    rest = [1e-3 * u + 1e-4 - values["s"] * u for u in range(1, 9)]
    tests.check("fit: neighbours of small residuals", event and abs(event["neighbours"] - sum(
        a * b for a, b in zip(rest, rest[1:])) / sum(a * a for a in rest)) < 1e-6, tests.report(done))


def closed_loop(tests):
    """A closed loop whose rows do not begin at a turning point."""
    mu, E0 = 0.35, 200e9
    path = path_of(0.8e-6, 40)
    rows = list(zip(path, loop(mu, E0, path)))[41:]
    rows = [(d * 1e6, f) for d, f in rows[20:] + rows[:21]]
    name = write(tests, "closed.csv", "Fx [N],dx [um]", [(f, d) for d, f in rows])
    values, event, done = answers(tests, SETUP % (210, 0.4) + "; fit mu, E0 along " + name)
    tests.check("fit: a closed loop from its midst", event and abs(values["mu"] / mu - 1) < 1e-3 and abs(values["E0"] / E0 - 1) < 1e-3
                and "run twice" in done.stderr, tests.report(done))
    start = min(range(len(rows)), key=lambda i: abs(rows[i][1]))
    name = write(tests, "unloaded.csv", "dx [um],Fx [N]", rows[start:-1] + rows[:start + 1])
    values, event, done = answers(tests, SETUP % (210, 0.4) + "; fit mu, E0 along " + name)
    tests.check("fit: a closed loop that begins displaced without a force", event and abs(values["mu"] / mu - 1) < 1e-3
                and abs(values["E0"] / E0 - 1) < 1e-3 and "run twice" in done.stderr, tests.report(done))
    path = path_of(0.4e-6, 40)
    rows = [(d * 1e6, f) for d, f in zip(path, loop(mu, E0, path))][1:80]
    last = min(range(20, 79), key=lambda i: abs(rows[i][0]))
    name = write(tests, "rest.csv", "dx [um],Fx [N]", rows[:last + 1])
    values, event, done = answers(tests, SETUP % (210, 0.4) + "; fit mu, E0 along " + name)
    tests.check("fit: a loop that begins next to rest, and ends there", event and abs(values["mu"] / mu - 1) < 1e-3
                and abs(values["E0"] / E0 - 1) < 1e-3 and "twice" not in done.stderr, tests.report(done))


def from_a_turning_point(tests):
    """Closed loops that begin at a turning point and end a row before it: no bias, which the mean of eight draws would show."""
    mu, E0, noise = 0.45, 164e9, random.Random(3)
    path = path_of(0.8e-6, 200)
    rows, off = list(zip(path, loop(mu, E0, path)))[200:600], {"mu": [], "E0": []}
    for _ in range(8):
        name = write(tests, "turn.csv", "dx [um],Fx [N]", [(d * 1e6 + noise.gauss(0, 0.01), f + noise.gauss(0, 0.05)) for d, f in rows])
        values, event, done = answers(tests, SETUP % (205, 0.45) + "; fit mu, E0 along " + name + " noise dx=10 nm Fx=0.05 N")
        for of, true in (("mu", mu), ("E0", E0)):
            off[of].append((values[of] - true) / event["deviation"][of] if event else 99)
    for of, z in off.items():
        tests.check("fit: a loop from its turning point, %s" % of, abs(sum(z)) / 8 < 1.2, "%s %s" % (z, tests.report(done)))


def begun_midway(tests):
    """A path that begins within a steady cycle, at any phase, and need not close; and one that begins at rest: the data tell which."""
    mu, E0 = 0.405, 200e9
    for amplitude, noise in ((1.5e-6, 0), (0.4e-6, 1)):
        path = [amplitude * math.sin(2 * math.pi * i / 100) for i in range(526)]
        clean = loop(mu, E0, path)
        for begin, end in ((227, 330), (235, 345), (235, 395), (255, 485), (255, 335), (250, 350), (0, 100), (5, 130)):
            off = []
            for seed in range(4 if noise else 1):
                draw = random.Random(seed)
                rows = [(path[i] * 1e6 + noise * draw.gauss(0, 0.004), clean[i] + noise * draw.gauss(0, 0.2)) for i in range(begin, end + 1)]
                values, event, done = answers(tests, SETUP % (210, 0.3) + "; fit mu, E0 along " + write(tests, "midway.csv", "dx [um],Fx [N]", rows))
                off.append((values["mu"] - mu) / (event["deviation"]["mu"] if noise else 1e-3 * mu) if event else 99)
                if not noise:  # in a thin loop noise may hide which it is; the answers are close then
                    off[-1] += 99 * (("run twice" in done.stderr) != (begin > 5)) + 99 * (("as reached from rest" in done.stderr) != (begin == 5))
            tests.check("fit: rows %d to %d of cycles of %g um" % (begin, end, amplitude * 1e6), abs(sum(off)) / len(off) < 1, "%s %s" % (off, tests.report(done)))
    rows = [(path[i] * 1e6, clean[i]) for i in range(235, 250)]
    done = tests.run("-c", SETUP % (210, 0.3) + "; fit mu, E0 along " + write(tests, "midway.csv", "dx [um],Fx [N]", rows))
    tests.check("fit: part of a branch", "the first row is taken as reached from rest\n" in done.stderr, tests.report(done))


def noisy_in_both(tests):
    """Noise in the driving column as well: mu within its stated error, from starts that are wrong by orders of magnitude."""
    mu, E0 = 0.62, 210e9
    path = [2e-6 * math.sin(2 * math.pi * i / 200) for i in range(251)]
    clean = loop(mu, E0, path)
    for seed in (1, 2, 3):
        noise = random.Random(seed)
        rows = [(d * 1e6 + noise.gauss(0, 0.01), f + noise.gauss(0, 0.5)) for d, f in zip(path, clean)]
        name = write(tests, "both.csv", "dx [um],Fx [N]", rows)
        for said in ("", " noise dx=10 nm Fx=0.5 N"):
            values, event, done = answers(tests, SETUP % (210, 0.4) + "; fit mu, E0 along " + name + said)
            tests.check("fit: noise in both columns, seed %d%s" % (seed, said), event and abs(values["mu"] - mu) < 2 * event["deviation"]["mu"]
                        and abs(values["E0"] - E0) < 2 * event["deviation"]["E0"] and event["deviation"]["mu"] < 0.004
                        and abs(event["noise_dx"] / 1e-8 - 1) < 0.3 and event["turning_points"] == 2, tests.report(done))
    want = values, event
    for E in (0.21, 2.1, 21, 210, 2100, 21e3, 210e3):
        for start in (0.05, 0.4, 2):
            values, event, done = answers(tests, SETUP % (E, start) + "; fit mu, E0 along " + name + said)
            tests.check("fit: begun at E0 = %g GPa, mu = %g" % (E, start), event and all(
                abs(values[n] - want[0][n]) < 1e-5 * want[1]["deviation"][n] for n in ("mu", "E0")), tests.report(done))
    values, event, done = answers(tests, SETUP % (210, 0.4) + "; fit mu, E0 along " + write(tests, "both-peak.csv", "dx [um],Fx [N]", rows[50:200]))
    tests.check("fit: noise in both columns, from a turning point on", event and abs(values["mu"] - mu) < 2 * event["deviation"]["mu"]
                and abs(values["E0"] - E0) < 2 * event["deviation"]["E0"] and event["turning_points"] == 2, tests.report(done))
    loaded = write(tests, "both-load.csv", "dx [um],Fx [N],FN [N]", [row + (FN + noise.gauss(0, 0.5),) for row in rows])
    values, event, done = answers(tests, SETUP % (210, 0.4) + "; fit mu, E0 along " + loaded)
    tests.check("fit: noise in three columns", event and abs(values["mu"] - mu) < 2 * event["deviation"]["mu"]
                and abs(values["E0"] - E0) < 2 * event["deviation"]["E0"], tests.report(done))
    for said, text in ((" noise", "expected dx=10 nm or Fx=0.5 N behind noise"), (" dx=10 nm", "dx= tells the noise of a measured loop"),
                       (" noise dx=0 nm", "must be positive"), (" noise Fx=1 mm", "Fx is a force, not a length")):
        done = tests.run("-c", SETUP % (210, 0.4) + "; fit mu along " + name + said)
        tests.check("fit refuses:" + said, done.returncode == 1 and text in done.stderr, tests.report(done))


def sharp_drive(tests):
    """Triangular and sinusoidal drives: the sharp or round turning points do not bias the fit, and the errors are about equal."""
    mu, E0, stated = 0.62, 210e9, {}
    for shape in ("corners", "rounds"):
        path = path_of(2e-6, 50)[:-50] if shape == "corners" else [2e-6 * math.sin(2 * math.pi * i / 200) for i in range(251)]
        clean, off = loop(mu, E0, path), []
        for seed in range(12):
            noise = random.Random(seed)
            name = write(tests, "drive.csv", "dx [um],Fx [N]", [(d * 1e6 + noise.gauss(0, 0.05), f + noise.gauss(0, 0.5)) for d, f in zip(path, clean)])
            values, event, done = answers(tests, SETUP % (150, 0.4) + "; fit mu, E0 along " + name)
            if event:
                off.append((values["mu"] - mu) / event["deviation"]["mu"])
                stated[shape] = event["deviation"]["mu"]
        mean = sum(off) / len(off)
        tests.check("fit: %s" % shape, len(off) == 12 and abs(mean) < 0.9 and all(abs(o) < 3.5 for o in off) and stated[shape] < 0.009, str((off, stated)))


def by_cycle(tests):
    """A fit for each cycle, with mu falling from cycle to cycle. The table has the energy of each, and gaps for cycles without result."""
    path = [1.2e-6 * math.sin(2 * math.pi * i / 100) for i in range(126)]
    rows, noise, true = [], random.Random(9), (0.5, 0.45, 0.4)
    for i, mu in enumerate(true):
        part = list(zip(path, loop(mu, 200e9, path)))[25 + (i > 0):]
        rows += [(d * 1e6 + noise.gauss(0, 0.005), f + noise.gauss(0, 0.3)) for d, f in part]
    name = write(tests, "cycles.csv", "dx [um],Fx [N]", rows)
    done = tests.run("--format=csv", "-c", SETUP % (210, 0.4) + "; fit mu, E0 along " + name + " by cycle")
    lines = [line.split(",") for line in done.stdout.splitlines()]
    tests.check("fit: columns of cycles", lines and lines[0] == ["cycle", "line", "mu", "mu deviation", "E0 [Pa]", "E0 deviation [Pa]", "dW [J]", "slides"]
                and len(lines) == 4, tests.report(done))
    for line, mu in zip(lines[1:], true):
        cycle, row, got, stated, E0, off, dW, slides = map(float, line)
        own = [(d * 1e-6, f) for d, f in rows[int(row) - 2:int(row) + 98]]
        area = abs(sum((f + g) / 2 * (e - d) for (d, f), (e, g) in zip(own, own[1:] + own[:1])))
        tests.check("fit: cycle %g" % cycle, abs(got - mu) < 3 * stated and stated < 0.02 and abs(E0 - 200e9) < 3 * off
                    and abs(dW / area - 1) < 0.03 and slides == 0, tests.report(done))
    for said, want in ((" by rows", "by cycle gives a row for each cycle"), ("", None)):
        done = tests.run("-c", SETUP % (210, 0.4) + "; fit mu along " + name + said)
        tests.check("fit:%s" % (said or " all cycles at once"), (want or "") in done.stderr and (done.returncode == 1) == (want is not None), tests.report(done))
    done = tests.run("-c", SETUP % (210, 0.4) + "; k = 0.05, c0 = 1 mm; fit E0, c0 along " + name + " by cycle")
    tests.check("fit: cycles that all fail", done.returncode == 1 and "E0 and c0 apart" in done.stderr, tests.report(done))
    half = write(tests, "no-cycle.csv", "dx [um],Fx [N]", rows[:40])
    done = tests.run("-c", SETUP % (210, 0.4) + "; fit mu along " + half + " by cycle")
    tests.check("fit: no cycle", done.returncode == 1 and "no cycle is closed" in done.stderr, tests.report(done))


def told_apart(tests):
    """Two names that a loop cannot separate: the message says what to measure instead."""
    path = [1.2e-6 * math.sin(2 * math.pi * i / 100) for i in range(126)]
    noise = random.Random(2)
    rows = [(d * 1e6 + noise.gauss(0, 0.005), f + noise.gauss(0, 0.3)) for d, f in zip(path, loop(0.5, 200e9, path))]
    name = write(tests, "apart.csv", "dx [um],Fx [N]", rows)
    for names, want in (("mu, E0, k", "the data hardly tell E0 and k apart: depths at loads decades apart tell k"),
                        ("mu, E0, c0", "E0 and c0 apart: they determine only a combination; a contact shows E0/c0^k alone"),
                        ("mu, E0, nu", "E0 and nu apart: they determine only a combination; give nu"),
                        ("mu, E0, R", "E0 and R apart: they determine only a combination; measure the shape")):
        done = tests.run("-c", "material E0=150 GPa nu=0.3 k=0.05 c0=1 mm; geometry paraboloid R=10 mm; friction 0.4; press FN=100 N; fit %s along %s" % (names, name))
        tests.check("fit: one loop, " + names, want in done.stderr, tests.report(done))


def at_the_rig(tests):
    """Data from a rig of 80 N/um with offsets: exact without noise, within the stated errors with noise."""
    mu, E0, K = 0.4, 210e9, 80e6
    path = [2.6e-6 * math.sin(2 * math.pi * i / 200) for i in range(251)]
    clean = [((d + f / K) * 1e6, f) for d, f in zip(path, loop(mu, E0, path))]
    scene = SETUP % (150, 0.3) + "; rig stiffness=80 N/um; "
    exact = write(tests, "rig-exact.csv", "drig [um],Fx [N]", clean)
    values, event, done = answers(tests, scene + "fit mu, E0 along " + exact)
    tests.check("fit: readings without noise", event and abs(values["mu"] / mu - 1) < 1e-5 and abs(values["E0"] / E0 - 1) < 1e-5, tests.report(done))
    noise = random.Random(5)
    noisy = [(d + 0.05 + noise.gauss(0, 0.01), f + 0.4 + noise.gauss(0, 0.3)) for d, f in clean]
    name = write(tests, "rig-noise.csv", "Weg [um],Kraft [N]", noisy)
    values, event, done = answers(tests, scene + "fit mu, E0, d0, F0 along " + name)
    tests.check("fit: readings with noise", event and all(abs(values[n] - true) < 2 * event["deviation"][n] for n, true in
                (("mu", mu), ("E0", E0), ("d0", 0.05e-6), ("F0", 0.4))), tests.report(done))
    values, event, done = answers(tests, scene + "fit mu, E0, K_rig, d0, F0 along " + name)
    tests.check("fit: the rig and E0 from one loop", event and abs(values["K_rig"] - K) < 2 * event["deviation"]["K_rig"]
                and "hardly tell E0 and K_rig apart: measure K_rig" in done.stderr, tests.report(done))
    # two reversals from a peak, by the Masing rule: a search for starts would end at gross slip, where d0 has no effect
    mu, E0, K, peak = 0.5, 205e9, 60e6, 1.2e-6
    estar = E0 / (2 * (1 - NU ** 2))
    dxmax = mu * (2 - NU) / (2 * (1 - NU)) * (3 * FN / (4 * estar)) ** (2 / 3) / R ** (1 / 3)
    first = lambda d: mu * FN * (1 - (1 - d / dxmax) ** 1.5)
    rows = []
    for i in range(401):
        d, side = peak * math.cos(2 * math.pi * i / 200), 1 if i % 200 <= 100 else -1
        force = side * (first(peak) - 2 * first((peak - side * d) / 2))
        rows.append(((d + force / K + 0.3e-6) * 1e6, force + 2))
    name = write(tests, "rig-turns.csv", "drig [um],Fx [N]", rows)
    scene = SETUP % (210, 0.4) + "; rig stiffness=60 N/um F0=%s N d0=0 m; "
    values, event, done = answers(tests, scene % 2 + "fit mu, E0, d0 along " + name)
    tests.check("fit: an offset that a start does not show", event and abs(values["mu"] / mu - 1) < 1e-6
                and abs(values["d0"] / 0.3e-6 - 1) < 1e-6, tests.report(done))
    _, _, done = answers(tests, scene % 0 + "fit mu, E0, d0, F0 along " + name)
    tests.check("fit: offsets of a closed loop", "cannot tell d0 and F0 apart" in done.stderr, tests.report(done))


def kept_at_the_rig(tests):
    """A file written by `history to FILE` with a rig can be followed again: drig drives, less the offsets."""
    scene = SETUP % (210, 0.4) + "; rig stiffness=80 N/um%s; "
    kept = os.path.join(tests.dir, "kept-rig.csv")
    done = tests.run("--format=json", "-c", scene % "" + "step Fx=20 N; step drig=-0.5 um; cycle drigA=1 um steps 8; history to %s; dx, Fx, W" % kept)
    with open(kept, encoding="ascii") as f:
        head, *rows = [line.strip().split(",") for line in f]
    told = {row["name"]: row["value"] for row in map(json.loads, done.stdout.splitlines()) if "name" in row}
    again, _, other = answers(tests, SETUP.split("press")[0] % (210, 0.4) + "follow %s; dx, Fx, W" % kept)
    tests.check("history with a rig", head[-1] == "drig [m]" and len(rows) == 12 and all(
        abs(float(row[5]) - float(row[3]) - float(row[2]) / 80e6) < 1e-20 for row in rows), str(head))
    tests.check("history with a rig, followed", len(told) == 3 and all(abs(again[n] / v - 1) < 1e-12 for n, v in told.items()), tests.report(other))
    name = write(tests, "readings.csv", "drig [um],Fx [N]", [(1e6 * float(row[5]) + 0.1, float(row[2]) - 2) for row in rows])
    told, _, done = answers(tests, scene % " d0=0.1 um F0=-2 N" + "follow %s; dx, Fx, drig, W" % name)
    compared = [row for row in map(json.loads, done.stdout.splitlines()) if row.get("event") == "compared"]
    tests.check("follow readings", abs(told["drig"] / 1e-6 - 1) < 1e-9 and all(abs(told[n] / again[n] - 1) < 1e-8 for n in ("dx", "Fx"))
                and compared and compared[0]["rms"] < 1e-6, tests.report(done))
    done = tests.run("-c", SETUP % (210, 0.4) + "; follow " + name)
    tests.check("follow readings without a rig", done.returncode == 1 and "there is no rig" in done.stderr, tests.report(done))


def moved_starts(tests):
    """Starts are moved if a row has no value there, or if they are far off."""
    rows = [(q, 1e6 * loss) for q, loss in ((q, dissipated(0.7, 210e9, q)) for q in (10, 20, 30, 40, 50, 60))]
    name = write(tests, "losses-Q.csv", "Q [N],Ed [uJ]", rows)
    for start in (0.05, 0.4, 2):
        values, event, done = answers(tests, SETUP % (210, start) + "; fit mu for Ed = dW(Q) to " + name)
        tests.check("fit: losses from mu = %g" % start, event and abs(values["mu"] / 0.7 - 1) < 1e-6, tests.report(done))
    zeros = write(tests, "zeros.csv", "u,y", ((1, 0), (2, 0), (3, 0)))
    values, event, done = answers(tests, "s = -1; fit s for y = log(s*u) to " + zeros)
    tests.check("fit: a start of the wrong sign", event and abs(values["s"] * 6 ** (1 / 3) - 1) < 1e-6, tests.report(done))
    noise = random.Random(2)
    name = write(tests, "wave.csv", "t,y", [(0.1 * i, 2 * math.sin(0.3 * i) + noise.gauss(0, 0.1)) for i in range(100)])
    for w in (1, 2, 3, 3.3, 6, 10):  # near all but two of these there is a local minimum
        values, event, done = answers(tests, "q = 1; w = %g; fit q, w for y = q*sin(w*t) to %s" % (w, name))
        tests.check("fit: the least of several, from w = %g" % w, event and all(
            abs(values[n] - true) < 2 * event["deviation"][n] for n, true in (("q", 2), ("w", 3))), tests.report(done))
    noise = random.Random(3)
    cN = 210e9 / (2 * (1 - NU ** 2))
    rows = [(h + noise.gauss(0, 0.002), (4 / 3 * cN * math.sqrt(R) * max(h - 0.4, 0) ** 1.5 * 1e-9) + noise.gauss(0, 0.2))
            for h in (0.04 * i for i in range(80))]
    name = write(tests, "indented.csv", "Depth [um],Load [N]", rows)
    first = None
    for h0 in (0, 0.5, 3, -3, 10):
        for E in (0.21, 100, 210e3):
            values, event, done = answers(tests, SETUP % (E, 0.4) + "; h0 = %g um; fit E0, h0 for Load = FN(Depth - h0) to %s" % (h0, name))
            first = first or values
            tests.check("fit: indented, from h0 = %g um, E0 = %g GPa" % (h0, E), event and all(
                abs(values[n] - true) < 2.5 * event["deviation"][n] and abs(values[n] - first[n]) < 1e-4 * event["deviation"][n]
                for n, true in (("E0", 210e9), ("h0", 0.4e-6))), tests.report(done))


def dissipated(mu, E0, FA):
    """Energy dissipated per cycle by a paraboloid (Mindlin and Deresiewicz, for both bodies; tangential stiffness 2 a G*):
    18 mu^2 F_N^2/(5 a G*) {1-l^(5/3) - 5 F_A/(6 mu F_N) (1+l^(2/3))}, l = 1-F_A/(mu F_N)."""
    cN = E0 / (2 * (1 - NU ** 2))
    a = (3 * FN * R / (4 * cN)) ** (1 / 3)
    eta = (2 - NU) / (2 * (1 - NU))
    part = FA / (mu * FN)
    rest = 1 - part
    return 18 * (mu * FN) ** 2 / (5 * a * cN / eta) * (1 - rest ** (5 / 3) - 5 * part / 6 * (1 + rest ** (2 / 3)))


def equations(tests):
    """Fits of equations, such as depth against force; names that cannot be separated."""
    E0 = 180e9
    cN = E0 / (2 * (1 - NU ** 2))
    force = [2.0 * i for i in range(1, 61)]
    noise = random.Random(5)
    rows = [((3 * f / (4 * cN) / math.sqrt(R)) ** (2 / 3) * 1e6 * (1 + noise.gauss(0, 0.003)), f) for f in force]
    name = write(tests, "indent.csv", "depth [um],force [N]", rows)
    setup = SETUP % (210, 0.4)
    values, event, done = answers(tests, setup + "; fit E0 for depth = dz(force) to " + name)
    tests.check("fit: E0 from depth against force", event and abs(values["E0"] - E0) < 3 * event["deviation"]["E0"]
                and event["deviation"]["E0"] < 0.01 * E0, tests.report(done))
    values, event, done = answers(tests, setup + "; offset = 0 um; fit E0, offset for depth = dz(force) + offset to " + name)
    tests.check("fit: a name of one's own, from 0", event and abs(values["E0"] - E0) < 4 * event["deviation"]["E0"]
                and abs(values["offset"]) < 4 * event["deviation"]["offset"], tests.report(done))
    for script, want in (
            ("; k = 0.2, c0 = 1 mm; fit k, E0, c0 for depth = dz(force) to " + name, "the data cannot tell E0 and c0 apart"),
            ("; fit mu for depth = dz(force) to " + name, "the data do not determine mu"),
            ("; fit E0 for dz = dz(60 N) to " + name, "no column of"),
            ("; fit zeta for depth = dz(force) to " + name, "'zeta' is no input and has no value"),
            ("; fit E0 for depth = force to " + name, "the left side is a length, the right side is a force")):
        done = tests.run("-c", setup + script)
        tests.check("fit says: " + want, done.returncode == 1 and want in done.stderr, tests.report(done))


def many_rows(tests):
    """A fit to 10^4 rows."""
    path = path_of(0.8e-6, 50)
    clean = loop(0.35, 200e9, path)
    noise = random.Random(7)
    rows = [(d * 1e6, f + noise.gauss(0, 0.3)) for _ in range(66) for d, f in list(zip(path, clean))[51:]]
    name = write(tests, "many.csv", "dx [um],Fx [N]", [(path[50] * 1e6, clean[50])] + rows)
    values, event, done = answers(tests, SETUP % (210, 0.4) + "; fit mu, E0 along " + name)
    tests.check("fit: many rows", event and abs(values["mu"] - 0.35) < 1e-3 and event["rows"] > 6000, tests.report(done))


STRAIGHT = ((1, 2), (2, 4), (3, 6), (4, 8), (5, 10.5))


def straight_lines(tests):
    """Straight lines against the normal equations: a slope, a slope with an offset from 0, and exact data."""
    name = write(tests, "line.csv", "u,y [mm]", STRAIGHT)
    exact = write(tests, "exact.csv", "u,y", STRAIGHT[:4])
    n, u, y = 5, [row[0] for row in STRAIGHT], [1e-3 * row[1] for row in STRAIGHT]
    uu, uy = sum(a * a for a in u), sum(a * b for a, b in zip(u, y))
    slope = uy / uu
    rest = sum((b - slope * a) ** 2 for a, b in zip(u, y))
    for start in ("1 mm", "0 mm"):
        values, event, done = answers(tests, "s = %s; fit s for y = s*u to %s" % (start, name))
        tests.check("fit: a slope from " + start, event and abs(values["s"] / slope - 1) < 1e-9
                    and abs(event["deviation"]["s"] / math.sqrt(rest / (n - 1) / uu) - 1) < 1e-6
                    and abs(event["rms"] / math.sqrt(rest / n) - 1) < 1e-9, tests.report(done))
    number, _, done = answers(tests, "s = 0; fit s for y = s*u*(1 mm) to " + name)
    tests.check("fit: a number from 0 for a length", abs(1e-3 * number.get("s", 0) / slope - 1) < 1e-9, tests.report(done))
    mean = sum(u) / n
    bent = uu - n * mean * mean
    with_offset = (uy - mean * sum(y)) / bent
    values, event, done = answers(tests, "s = 1 mm; off = 0 mm; fit s, off for y = s*u + off to " + name)
    tests.check("fit: a slope and an offset", event and abs(values["s"] / with_offset - 1) < 1e-8
                and abs(values["off"] - (sum(y) / n - with_offset * mean)) < 1e-11
                and abs(event["correlation"]["s,off"] + mean * math.sqrt(n / uu)) < 1e-6, tests.report(done))
    values, event, done = answers(tests, "s = 2; fit s for y = s*u to " + exact)
    tests.check("fit: begun where it ends", event and values["s"] == 2 and event["rms"] == 0
                and event["deviation"]["s"] == 0, tests.report(done))
    done = tests.run("--format=csv", "-c", "s = 1 mm; fit s for y = s*u to " + name)
    header, row = (done.stdout.splitlines() + ["", ""])[:2]
    tests.check("fit as CSV", header == "s [m],s deviation [m]" and abs(float(row.partition(",")[0]) / slope - 1) < 1e-9,
                tests.report(done))
    done = tests.run("-c", "set timing on; s = 1 mm; fit s for y = s*u to %s" % name)
    tests.check("fit tells its method", "Marquardt's method" in done.stderr and "evaluations of 5 rows" in done.stderr, tests.report(done))


def begun_at_the_end(tests):
    """Residuals of data written by the program are rounding; a fit that starts at its result ends there."""
    name = os.path.join(tests.dir, "own-loop.csv")
    scene = SETUP % (210, 0.4) + "; "
    tests.run("-c", scene + "table dx in um, Fx along cycle FA=30 N steps 60 to " + name)
    for start in ("", "mu = 0.5; E0 = 100 GPa; "):
        values, event, done = answers(tests, scene + start + "fit mu, E0 along " + name)
        tests.check("fit: nothing left but rounding, from '%s'" % start,
                    event and abs(values["mu"] / 0.4 - 1) < 1e-13 and abs(values["E0"] / 210e9 - 1) < 1e-13
                    and event["rms"] < 1e-13, tests.report(done))
    noisy = write(tests, "again.csv", "u,y", [(u, 2 * u + 0.1 * math.sin(7.0 * u)) for u in range(1, 9)])
    slope = sum(u * (2 * u + 0.1 * math.sin(7.0 * u)) for u in range(1, 9)) / sum(u * u for u in range(1, 9))
    first, _, _ = answers(tests, "s = 1; fit s for y = s*u to " + noisy)
    again, event, done = answers(tests, "s = %.17g; fit s for y = s*u to %s" % (first.get("s", 0), noisy))
    tests.check("fit: begun at its own answer", event and abs(again["s"] / first["s"] - 1) < 1e-7
                and abs(again["s"] / slope - 1) < 1e-9, tests.report(done))


def offset_power(rows):
    """s and h0 of y = s (x - h0)^1.5 and their deviations, by the Gauss-Newton method with analytic derivatives."""
    s, h0 = rows[-1][1] / rows[-1][0] ** 1.5, 0.0
    for _ in range(100):
        slopes = [((x - h0) ** 1.5, -1.5 * s * (x - h0) ** 0.5) for x, _ in rows]
        rest = [y - s * (x - h0) ** 1.5 for x, y in rows]
        A, B, C = (sum(j[i] * j[k] for j in slopes) for i, k in ((0, 0), (0, 1), (1, 1)))
        u, v = (sum(j[i] * r for j, r in zip(slopes, rest)) for i in (0, 1))
        det = A * C - B * B
        s, h0 = s + (C * u - B * v) / det, h0 + (A * v - B * u) / det
    variance = sum(r * r for r in rest) / (len(rows) - 2)
    return s, h0, math.sqrt(C / det * variance), math.sqrt(A / det * variance)


def from_zero(tests):
    """A start at 0, or nearly 0, gives no scale for the name; the result must be that of other starts."""
    rows = ((300, 5), (600, 16), (900, 26), (1200, 43), (1500, 57))
    name = write(tests, "indents.csv", "x [nm],y [nN]", rows)
    want = offset_power([(x * 1e-9, y * 1e-9) for x, y in rows])
    for s, h0 in (("1", "0"), ("1", "1e-9"), ("1", "-1e-20"), ("1", "1"), ("1", "50"), ("1", "-30"), ("0", "1"), ("1e-12", "0"), ("0", "0"), ("1e6", "0")):
        values, event, done = answers(tests, "s = %s Pa*m^0.5; h0 = %s nm; fit s, h0 for y = s*(x-h0)^1.5 to %s" % (s, h0, name))
        got = (values["s"], values["h0"], event["deviation"]["s"], event["deviation"]["h0"]) if event else ()
        tests.check("fit: begun at s = %s, h0 = %s nm" % (s, h0), event and all(abs(a / b - 1) < 1e-5 for a, b in zip(got, want)) and
                    "note: the data hardly determine h0\n" in done.stderr, "%s, not %s\n%s" % (got, want, tests.report(done)))
    # names with other dimensions than the data; a row that has a value on one side of 0 only; a result of 0
    rows = [(x, 3.0 * x * (1 + 0.002 * x)) for x in range(100, 1000, 100)]
    name = write(tests, "bent.csv", "x [nm],y [nN]", rows)
    for q in ("0", "1e-30", "1", "1e9"):
        values, event, done = answers(tests, "s = 1 N/m; q = %s m^-1; fit s, q for y = s*x*(1 + q*x) to %s" % (q, name))
        tests.check("fit: a bend from %s" % q, event and abs(values["s"] / 3 - 1) < 1e-6 and abs(values["q"] / 2e6 - 1) < 1e-6, tests.report(done))
    name = write(tests, "edge.csv", "x [nm],y [nN]", [(x, 2e-3 * (x + 7) ** 1.5) for x in range(0, 1000, 100)])
    values, event, done = answers(tests, "s = 1 Pa*m^0.5; h0 = 0 nm; fit s, h0 for y = s*(x-h0)^1.5 to " + name)
    tests.check("fit: begun at the end of what has a value", event and abs(values["h0"] / -7e-9 - 1) < 1e-5, tests.report(done))
    name = write(tests, "none.csv", "x [nm],y [nN]", [(x, 2e-3 * x ** 1.5) for x in range(100, 1000, 100)])
    for h0 in ("0", "1e-6", "50", "-900"):
        values, event, done = answers(tests, "s = 1 Pa*m^0.5; h0 = %s nm; fit s, h0 for y = s*(x-h0)^1.5 to %s" % (h0, name))
        tests.check("fit: an offset of 0 from %s" % h0, event and abs(values["h0"]) < 1e-15 and event["deviation"]["h0"] < 1e-15, tests.report(done))


def least_squares(rows, values):
    """Parameters, their deviations and correlations, by the normal equations in exact fractions."""
    n, m = len(rows), len(rows[0])
    table = [[sum(Fraction(r[i]) * Fraction(r[j]) for r in rows) for j in range(m)] + [Fraction(i == j) for j in range(m)] for i in range(m)]
    for i in range(m):  # the inverse, by Gauss-Jordan elimination
        table[i] = [v / table[i][i] for v in table[i]]
        for j in set(range(m)) - {i}:
            table[j] = [a - table[j][i] * b for a, b in zip(table[j], table[i])]
    inverse = [row[m:] for row in table]
    right = [sum(Fraction(r[i]) * Fraction(v) for r, v in zip(rows, values)) for i in range(m)]
    found = [sum(a * b for a, b in zip(row, right)) for row in inverse]
    rest = sum((v - sum(a * b for a, b in zip(r, found))) ** 2 for r, v in zip(rows, values)) / (n - m)
    deviation = [math.sqrt(rest * inverse[i][i]) for i in range(m)]
    return found, deviation, lambda i, j: inverse[i][j] / math.sqrt(inverse[i][i] * inverse[j][j])


def parabolas(tests):
    """Three names in every order: their deviations, correlations, and warnings if the data hardly determine or separate them."""
    powers = {"off": "off", "s": "s*u", "q": "q*u^2"}
    for what, data in (("near", ((-3, "-5.9"), (-2, "-3.8"), (-1, "-2.1"), (0, "0.1"), (1, "1.9"), (2, "4.2"), (3, "5.9"))),
                       ("far", ((10, "1"), (11, "3"), (12, "3"), (13, "6"), (14, "8")))):
        name = write(tests, what + ".csv", "u,y", [(u, float(y)) for u, y in data])
        for order in (("off", "s", "q"), ("s", "q", "off"), ("q", "off", "s")):
            rows = [[u ** list(powers).index(p) for p in order] for u, _ in data]
            found, deviation, correlation = least_squares(rows, [Fraction(y) for _, y in data])
            script = "off = 1; s = 1; q = 1; fit %s for y = %s to %s" % (", ".join(order), " + ".join(powers.values()), name)
            _, event, done = answers(tests, script)
            tests.check("fit in JSON: %s, %s" % (what, order), list(event["deviation"]) == list(order)
                        and all(abs(event["deviation"][p] / d - 1) < 1e-4 for p, d in zip(order, deviation))
                        and list(event["correlation"]) == ["%s,%s" % (order[i], order[j]) for i, j in ((0, 1), (0, 2), (1, 2))]
                        and all(abs(event["correlation"]["%s,%s" % (order[i], order[j])] - correlation(i, j)) < 1e-5
                                for i, j in ((0, 1), (0, 2), (1, 2))), tests.report(done))
            done = tests.run("-c", script)
            said = dict(re.findall(r"^(\w+) = (\S+) \+-", done.stdout, re.M))
            alike = dict(((a, b), float(c)) for a, b, c in re.findall(r"^correlation of (\w+) and (\w+) = (\S+)$", done.stdout, re.M))
            pairs = [(i, j) for i in range(3) for j in range(i + 1, 3)]
            tests.check("fit: %s, %s" % (what, order), list(said) == list(order) and list(alike) == [(order[i], order[j]) for i, j in pairs]
                        and all(abs(float(said[p]) / v - 1) < 1e-4 for p, v in zip(order, found))
                        and all(abs(alike[order[i], order[j]] - correlation(i, j)) < 0.006 for i, j in pairs), tests.report(done))
            want = ["tell %s and %s apart" % (order[i], order[j]) for i, j in pairs if abs(correlation(i, j)) > 0.99]
            want += ["determine " + p for p, v, d in zip(order, found, deviation) if d > abs(v)]
            tests.check("fit notes: %s, %s" % (what, order), want and re.findall("hardly (.*)", done.stderr) == want, str(want) + tests.report(done))


def loops_with_loads(tests):
    """A loop with a column for the load, which replaces the press: by F_N, or by the depth."""
    rows = ((0, 0), (0.1, 4), (0.5, 15), (0.2, 5))
    bare = write(tests, "bare.csv", "dx [um],Fx [N]", rows)
    force = write(tests, "force.csv", "dx [um],Fx [N],FN [N]", [row + (100,) for row in rows])
    steel = "material steel; geometry sphere R=10 mm; friction 0.4; "
    want, _, done = answers(tests, steel + "press FN=100 N; fit mu along " + bare)
    deep, _, _ = answers(tests, steel + "press FN=100 N; dz")
    depth = write(tests, "depth.csv", "dx [um],Fx [N],dz [m]", [row + (deep.get("dz", 0),) for row in rows])
    same_depth = "press dz=%.17g m; " % deep.get("dz", 0)
    for what, script in (("F_N", "press FN=50 N; fit mu along " + force), ("F_N, nothing pressed", "fit mu along " + force),
                         ("depth", "press FN=50 N; fit mu along " + depth), ("a press by depth", same_depth + "fit mu along " + bare)):
        got, _, other = answers(tests, steel + script)
        tests.check("fit: a loop with its own " + what, "mu" in want and abs(got.get("mu", 0) / want["mu"] - 1) < 1e-8,
                    tests.report(done) + tests.report(other))
        other = tests.run("-c", steel + "second aluminium; " + script)
        tests.check("fit: a loop of dissimilar bodies, " + what, other.stderr.count("elastically dissimilar") == 1, tests.report(other))
    for phase in 0, 60:  # noise in both columns: the load belongs to the branch, and there to the displacement
        name = os.path.join(tests.dir, "swinging-%d.csv" % phase)
        values, event, done = answers(tests, steel + "press FN=100 N; cycle dxA=0.8 um FNA=30 N phase=%d deg times 5\n"
                                      "table dx + 3 nm*sin(2e4*time^2), FN, Fx + 0.1 N*sin(3e4*time^2) along cycle steps 300 to %s\n"
                                      "friction 0.3; press FN=100 N; fit mu, E0 along %s" % (phase, name, name))
        tests.check("fit: a loop whose load swings, %d deg" % phase, event and abs(values["mu"] - 0.4) < 0.005 and
                    abs(values["E0"] / 210e9 - 1) < 0.005, tests.report(done))


def edges(tests):
    """Starts next to the end of the possible scenes, or at it: derivatives are taken to the side that has values."""
    E0, path = 180e9, path_of(0.4e-6, 40)
    rows = [(d * 1e6, f) for d, f in zip(path, loop(0.35, E0, path))]
    name = write(tests, "edge.csv", "dx [um],Fx [N]", rows)
    force = SETUP % (180, 0.35) + "; q = %s; FN := %s; fit q along " + name
    for start, definition, want in (("2.00001", "80 N*sqrt(q - 2)", 3.5625), ("2", "80 N*(1 + sqrt(q - 2))", 2.0625),
                                    ("1.99999", "80 N*sqrt(2 - q)", 0.4375), ("2", "80 N*(1 + sqrt(2 - q))", 1.9375),
                                    ("10", "80 N*sqrt(q - 2)", 3.5625)):  # the last start makes the first step overshoot
        values, event, done = answers(tests, force % (start, definition))
        tests.check("fit: from %s, FN := %s" % (start, definition), event and abs(values["q"] / want - 1) < 1e-5, tests.report(done))
    swung = SETUP % (210, 0.4) + "; cycle FA=15 N FNA=%s N phase=60 deg; "
    values, _, done = answers(tests, swung % 20 + "dW at mu=0.3; dW at mu=0.4; dW at mu=0.5")
    losses = [json.loads(line)["value"] for line in done.stdout.splitlines() if "name" in line]
    name = write(tests, "swung.csv", "mu,y [uJ]", [(m, 1e6 * loss) for m, loss in zip((0.3, 0.4, 0.5), losses)])
    values, event, done = answers(tests, swung % 0 + "fit FNA for y = dW to " + name)
    tests.check("fit: a swing from none", event and abs(values["FNA"] / 20 - 1) < 1e-6, tests.report(done))


def shapes(tests):
    """A sphere given as a sum, or as a table of points, gives the result of a sphere; also with a column for the load."""
    mu, E0, path = 0.35, 180e9, path_of(0.4e-6, 40)
    rows = [(d * 1e6, f) for d, f in zip(path, loop(mu, E0, path))]
    bare = write(tests, "shape-bare.csv", "dx [um],Fx [N]", rows)
    loaded = write(tests, "shape-load.csv", "dx [um],Fx [N],FN [N]", [row + (FN,) for row in rows])
    gap = write(tests, "sphere.csv", "r [mm],f [um]", [(i / 200, 50 * (i / 200) ** 2) for i in range(200)])
    for shape in ("sum 2:50 m^-1, 4:1e-3 m^-3", "file " + gap):
        scene = SETUP % (210, 0.4) + "; geometry " + shape
        done = tests.run("--format=json", "-c", (SETUP % (180, 0.4)) + "; geometry %s; dz; a" % shape)
        values = [json.loads(line)["value"] for line in done.stdout.splitlines() if "name" in line]
        by_depth, by_radius = ("; press %s=%.17g m" % pair for pair in zip(("dz", "a"), values))
        for what, script in (("pressed", "; fit mu, E0 along " + bare), ("loaded", "; fit mu, E0 along " + loaded),
                             ("pressed by depth", by_depth + "; E0 = 180 GPa; fit mu along " + bare),
                             ("pressed by radius", by_radius + "; E0 = 180 GPa; fit mu along " + bare)):
            got, event, done = answers(tests, scene + script)
            tests.check("fit: %s %s" % (shape.split()[0], what), event and abs(got["mu"] / mu - 1) < 3e-4
                        and abs(got.get("E0", E0) / E0 - 1) < 3e-4, tests.report(done))
        for load, want in ((0, "the data do not determine mu"), (-1, "FN = -1 N must not be negative")):
            idle = write(tests, "shape-idle.csv", "dx [um],Fx [N],FN [N]", [row + (load if load == 0 or i else 1,) for i, row in enumerate(rows)])
            done = tests.run("-c", scene + "; fit mu along " + idle)
            tests.check("fit: %s under %d N" % (shape.split()[0], load), done.returncode == 1 and want in done.stderr, tests.report(done))


def not_closed(tests):
    """A path that returns to its first displacement with another force is no closed loop."""
    mu, E0 = 0.35, 180e9
    path = [0.6e-6 * i / 20 for i in range(21)] + [0.6e-6 + 1e-6 * i / 30 for i in range(1, 31)] + [1.6e-6 - 1e-6 * i / 30 for i in range(1, 31)]
    rows = [(d * 1e6, f) for d, f in zip(path, loop(mu, E0, path))][20:]
    name = write(tests, "half.csv", "dx [um],Fx [N]", rows)
    values, event, done = answers(tests, SETUP % (210, 0.4) + "; fit mu, E0 along " + name)
    tests.check("fit: half a loop", event and abs(values["mu"] / mu - 1) < 1e-4 and abs(values["E0"] / E0 - 1) < 1e-4
                and "twice" not in done.stderr, tests.report(done))


def refusals(tests):
    files = {"line": ("u,y [mm]", STRAIGHT), "exact": ("u,y", STRAIGHT[:4]), "two": ("u,y", ((1, 2), (2, 4.1))), "one": ("u,x", ((1, 2),)),
             "zero": ("u,y", ((1, 0), (2, 0), (3, 0))), "neg": ("force [N],depth [um]", ((1, 2), (-3, 6), (4, 8))),
             "fn": ("FN [mm],y", ((1, 2), (2, 4))), "along": ("dx [N],Fx [N]", ((0, 0), (1, 1))),
             "no": ("dx [um],W", ((0, 0), (1, 1))), "down": ("dx [um],Fx [N],FN [N]", ((0, 0, 100), (0.1, 4, -3), (1, 2, 1))),
             "bare": ("dx [um],Fx [N]", ((0, 0), (0.1, 4), (1, 2))), "res": ("dW [uJ],u", ((1, 2), (2, 3))),
             "hF": ("h [nm],F [nN]", ((1, 2), (2, 4))), "waves": ("u,y", tuple((u, 10 + u % 2) for u in range(1, 17)))}
    path = {name: write(tests, "refused-%s.csv" % name, *text) for name, text in files.items()}
    path["bad"] = os.path.join(tests.dir, "refused-bad.csv")
    with open(path["bad"], "w", encoding="ascii") as f:
        f.write("u,y [mm]\n1,2\n2,x\n3,6\n")
    scene = SETUP % (210, 0.4) + "; "
    for script, want in (
            ("s = 1; fit s for y = s to {line}", "the left side is a length, the right side is a number"),
            ("s = 1; q = 1; fit s, q for y = s + q*u to {two}", "2 rows cannot determine 2 parameters"),
            ("s = 1; fit s for u = s*x to {one}", "1 row cannot determine 1 parameter\n"),
            ("s = 1; q = 2; fit s, q for y = s*q*u to {exact}", "the data cannot tell s and q apart"),
            ("s = 1; q = 2; t = 3; fit s, q, t for y + u^2 = s*q*u + s*t*u^2 to {exact}", "the data cannot tell s, q and t apart"),
            ("s = 1; fit s for y = s*u + sqrt(-(s - 1)^2) to {exact}",
             "no value close to s = 1, for the derivative: the square root of a negative number is not real"),
            # the minimum is a kink, which derivatives do not show
            ("s = 1; fit s for y = 15 + max(s - 1, (1 - s)/10) to {exact}", "the fit does not converge"),
            # the largest number of names
            ("; ".join(["s = 1", "w = 22.5 deg"] + ["x%d = 1" % i for i in range(1, 8)]) + "; fit s, x1, x2, x3, x4, x5, x6, x7 "
             "for y = 15 + max(s - 1, (1 - s)/10) + x1*sin(u*w) + x2*cos(u*w) + x3*sin(2*u*w) + x4*cos(2*u*w) + x5*sin(3*u*w) "
             "+ x6*cos(3*u*w) + x7*sin(4*u*w) to {waves}", "the fit does not converge"),
            ("s = 1; fit s for y = u + 0*s to {exact}", "the data do not determine s: nothing in them depends on it"),
            ("s = -1; fit s for y = log(-s^2*u) to {zero}", "log is not defined there (row 1 of the data)"),
            ("s = 1; fit s for y = s*u/(u - 2) to {exact}", "division by zero (row 2 of the data)"),
            ("s = 1; fit s for y/(u - 2) = s to {exact}", "division by zero (row 2 of the data)"),
            (scene + "fit E0 for depth = dz(force) to {neg}", "FN = -3 N must not be negative (row 2 of the data)"),
            (scene + "fit mu along {down}", "FN = -3 N must not be negative (row 2 of the data)"),
            (scene + "fit FN for y = FN/(1 N) to {fn}", "column FN is a length: it needs the unit of a force in the header"),
            (scene + "fit mu along {along}", "column dx is a force: it needs the unit of a length in the header"),
            (scene + "fit mu along {no}", " (a loop needs dx and Fx, and may have FN or dz)\n"),
            (scene + "fit mu along {nowhere}", "cannot read "),
            (scene + "fit E0 for dW = u*(1 uJ) to {res}", "dW is a result of the scene and a column of the file: rename"),
            (scene + "fit E0 for u*(1 uJ) = dW to {res}", "dW is a result of the scene and a column of the file: rename"),
            ("material steel; geometry sphere R=10 mm; friction 0.3; fit mu along {bare}", "there is no load yet: press first"),
            ("material steel; geometry sphere R=10 mm; press FN=1 N; fit E0 along {bare}", "mu is not set"),
            ("friction 0.3; fit mu along {bare}", "E0 is not set"),
            ("s = 1 mm; fit s for y = s*u to {bad}", "refused-bad.csv:3: expected a number as y, not 'x'"),
            ("s = 1 mm; fit s for s*u = y to {bad}", "refused-bad.csv:3: expected a number as y, not 'x'"),
            ("s = 1 mm; fit s for s*u = yy to {bad}", "unknown name 'yy' (the columns of {bad} are u, y)\n"),
            ("s = 1 mm; fit s for s*uu = y to {two}", "unknown name 'uu' (the columns of {two} are u, y)\n"),
            ("s = 1; slope_of_it = 2; fit s for y = s*slope_of_ix to {two}", "unknown name 'slope_of_ix': did you mean slope_of_it? (the columns of {two} are u, y)\n"),
            ("s = 1; fit s for y = s*(u + ) to {two}", "expected a value, not ')'\n"),
            ("s = 1; fit s for F = s*h to {hF}", "h is an input that this scene does not take, and a column of the file: rename the column\n"),
            (scene + "s = 1; fit s for s*h = F to {hF}", "h is an input that this scene does not take, and a column of the file: rename the column\n"),
            ("s = 1; fit s for 3 = 4 to {exact}", "no column of"),
            ("fit FN for y = u to {exact}", "there is no load yet: press first (press FN=100 N)"),
            ("s := 3; fit s for y = s to {exact}", "s has no value of its own to start from (it follows s := 3)"),
            ("s = 1; fit s, s for y = s to {exact}", "s is given twice"),
            ("s = 1; fit s for y to {exact}", "expected = EXPR"), ("s = 1; fit s for y = s {exact}", "expected to FILE.csv"),
            ("s = 1; fit s to {exact}", "expected for EXPR = EXPR to FILE.csv, or along FILE.csv"),
            ("s = 1; fit s for y = s to {exact} wobbly", "unexpected 'wobbly'"),
            ("s = 1; fit s for y = s (3) to {exact}", "unexpected '('"),
            ("; ".join("n%d = 1" % i for i in range(9)) + "; fit " + ", ".join("n%d" % i for i in range(9)) + " for y = n1 to {exact}",
             "more than 8 names"), ("fit 3 for y = u to {exact}", "expected a name")):
        script = script.format(nowhere=os.path.join(tests.dir, "nowhere.csv"), **path)
        want = want.format(**path)
        done = tests.run("-c", script)
        tests.check("fit refuses: " + script, done.returncode == 1 and want in done.stderr, tests.report(done))


def columns(tests):
    """All columns of a file are names, whatever they are called; those that are inputs are set row by row; names that had been undone
    are so again afterwards."""
    wide = ["v%02d" % i for i in range(24)]
    path = write(tests, "wide.csv", ",".join(wide), [[(r + 1) * (i + 1) for i in range(24)] for r in range(4)])
    back = "; ".join("%s = 1" % name for name in wide) + "\n" + "undo\n" * 24
    done = tests.run("--keep-going", "-c", back + "q = 2; fit q for v23 = q*v01 to %s\nv00; v23; show" % path)
    tests.check("fit: 24 columns", done.stdout.startswith("q = 12 +- ") and done.stdout.endswith("rows\nq = 2\n") and
                done.stderr.count("unknown name 'v") == 2, tests.report(done))
    done = tests.run("--keep-going", "-c", back + "plot %s to x.gp\nshow" % " | ".join("%s for %s = 1 .. 2" % (n, n) for n in wide))
    tests.check("names of a refused plot", "more than 6 figures" in done.stderr and done.stdout == "# nothing is set yet; try: demo, or help\n",
                tests.report(done))
    # a column that is an input, and some whose names are no names of the language
    path = os.path.join(tests.dir, "rows.csv")
    depth = tests.run("--format=csv", "-c", SETUP % (190, 0.4) + "\ntable dz for FN = 50 N .. 200 N steps 3").stdout.splitlines()[1:]
    rows = [line.split(",") for line in depth]
    with open(path, "w", encoding="ascii") as f:
        f.write("FN [N],depth [m],sin,5,a'b,dW,k k\n" + "".join("%s,%s,1,2,3,4,5\n" % (FN, dz) for FN, dz in rows))
    values, event, done = answers(tests, SETUP % (210, 0.4) + "; fit E0 for dz = depth to " + path)
    tests.check("fit: a column of an input", event and abs(values["E0"] / 190e9 - 1) < 1e-9 and event["rows"] == len(rows) == 4, tests.report(done))
    values, event, done = answers(tests, SETUP % (210, 0.4) + "; q = 1; fit q for FN = q*(1 N) to " + path)
    tests.check("fit: an input on the left alone", event and abs(values["q"] / 125 - 1) < 1e-9, tests.report(done))


    # inputs of other geometries are ordinary columns
    rows = [(20, 1.21), (50, 2.28), (80, 3.09), (120, 4.09)]
    alone = write(tests, "alone.csv", "force [N],depth [um]", rows)
    beside = write(tests, "beside.csv", "n,A [mm^2],slope,b [mm],h [um],force [N],depth [um]", [(i, 3, 1, 2, 3, *row) for i, row in enumerate(rows)])
    told = [tests.run("-c", SETUP % (210, 0.4) + "; fit E0 for depth = dz(force) to " + name) for name in (alone, beside)]
    tests.check("fit: columns named as inputs of other shapes", told[1].returncode == 0 and told[0].stdout == told[1].stdout, tests.report(told[1]))
    done = tests.run("-c", SETUP % (210, 0.4) + "; fit E0 for depth*slope = dz(force) to " + beside)
    tests.check("fit: such a one that is asked for", done.returncode == 1 and "slope" in done.stderr, tests.report(done))


def wide_ranges(tests):
    """Residuals whose squares leave the range of double; numbers without a value are null in JSON."""
    def told(script):
        done = tests.run("--format=json", "-c", script)
        return [json.loads(line) for line in done.stdout.splitlines() if "event" in line] or [{}], done
    (event,), done = told("x = 3; uncertainty exp(200*x) with x +- 0.0001 samples 4000")
    want = 200 * math.exp(600) * 1e-4  # first order
    tests.check("a deviation beyond 1e154", abs(event["deviation"] / want - 1) < 1e-3 and event["shares"] == {"x": 1} and
                abs(event["Monte Carlo"]["deviation"] / want - 1) < 0.1, tests.report(done))
    (event,), done = told("x = 3; uncertainty sqrt(x - 2.999) with x +- 1 samples 1 seed 2")
    tests.check("no sample has a value", event["Monte Carlo"] == {"mean": None, "deviation": None, "samples": 0, "differs": False} and
                "1 of 1 samples of sqrt(x - 2.999) has no value" in done.stderr, tests.report(done))


def units(tests):
    """The value, its deviation, and their columns in the unit that is asked for."""
    scene = SETUP % (210, 0.4) + "; "
    plain, asked = (tests.run("-c", scene + "uncertainty a%s with E0 +- 5 %%" % unit).stdout.splitlines() for unit in ("", " in mm"))
    tests.check("an estimate in mm", plain[0] == "a = 186.626 um +- 3.11 um" and asked[0] == "a = 0.186626 mm +- 0.00311 mm" and plain[1] == asked[1],
                "%s\n%s" % (plain, asked))
    done = tests.run("--format=csv", "-c", scene + "uncertainty a in mm, dz with E0 +- 5 %, FN +- 1 N")
    head, row = done.stdout.splitlines()
    tests.check("columns in mm", head.split(",") == ["a [mm]", "a deviation [mm]", "a from E0", "a from FN", "dz [m]",
                                                     "dz deviation [m]", "dz from E0", "dz from FN"] and
                abs(float(row.split(",")[0]) - 0.186626) < 1e-6 and abs(float(row.split(",")[2]) + float(row.split(",")[3]) - 1) < 1e-12, tests.report(done))
    sampled = [tests.run("--format=json", "-c", "x = 2; uncertainty x^2 with x +- 0.1 samples 50" + seed).stdout for seed in ("", " seed 1", " seed 2")]
    tests.check("a seed tells which samples", sampled[0] == sampled[1] != sampled[2], str(sampled))
    done = tests.run("-c", "material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N; cycle FA=9 N FNA=10 N; set timing on; uncertainty W with mu +- 0.01")
    tests.check("fewer samples where F_N swings", "differences of sixth order and 200 samples (seed 1)" in done.stderr, tests.report(done))
    done = tests.run("-c", "material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N; wear alpha=1e4 um^3/J; cycle FA=9 N; wear cycles 10\n"
                     "set timing on; uncertainty Vwear with Nw +- 1")
    tests.check("fewer samples of runs of wear", "differences of sixth order and 200 samples (seed 1)" in done.stderr, tests.report(done))
    done = tests.run("-c", "x = 2; uncertainty x^2, x with x +- 0.1 samples 50; fit x for y = x*u to %s" % write(tests, "units.csv", "u,y", STRAIGHT))
    tests.check("no load is needed", done.returncode == 0 and done.stdout.startswith("x^2 = 4 +- 0.4\n"), tests.report(done))


def drawn(path):
    """The panels of a figure in a kept script: lists of series, each a list of points."""
    panels, points = {}, None
    with open(path, encoding="utf-8") as f:
        for line in f:
            begun = re.match(r"\$data0_(\d+)_(\d+) <<", line)
            if begun:
                points = panels.setdefault(int(begun.group(1)), {}).setdefault(int(begun.group(2)), [])
            elif line.startswith("END"):
                points = None
            elif points is not None and line.strip():
                points.append(tuple(map(float, line.split())))
    return [[series for _, series in sorted(panel.items())] for _, panel in sorted(panels.items())]


def figure(tests):
    """The figure of a fit: data, fitted curve, residuals below, and the values with their errors in the key."""
    done = tests.run("-c", "plot fit")
    tests.check("plot fit: none yet", done.returncode == 1 and "there is no fit yet: fit INPUT, ... along FILE.csv" in done.stderr, tests.report(done))
    mu, E0, noise = 0.62, 210e9, random.Random(1)
    path = [2e-6 * math.sin(2 * math.pi * i / 200) for i in range(251)]
    rows = [(d * 1e6 + noise.gauss(0, 0.01), f + noise.gauss(0, 0.5)) for d, f in zip(path, loop(mu, E0, path))]
    name, to = write(tests, "shown.csv", "dx [um],Fx [N]", rows), os.path.join(tests.dir, "shown")
    values, event, done = answers(tests, SETUP % (210, 0.4) + "; fit mu, E0 along %s; material steel; reset; plot fit to %s.gp; plot fit to %s.png" % (name, to, to))
    (points, curve, key), (over,) = drawn(to + ".gp")
    tests.check("plot fit: points and residuals", len(points) == len(over) == event["rows"] == 251 and all(
        abs(p[0] - r[0]) < 1e-6 and abs(p[1] - r[1]) < 1e-6 and p[0] == o[0] for p, r, o in zip(points, rows, over))
                and abs(math.sqrt(sum(o[1] ** 2 for o in over) / 251) / event["rms"] - 1) < 0.02 and not key, tests.report(done))
    ours = loop(values["mu"], values["E0"], [x * 1e-6 for x, _ in curve])
    tests.check("plot fit: the curve", len(curve) > 100 and max(abs(F - f) for (_, F), f in zip(curve, ours)) < 0.05, str(curve[:9]))
    with open(to + ".gp", encoding="utf-8") as f:
        text = f.read()
    tests.check("plot fit: the key", "= %.6g +- %.3g" % (values["mu"], event["deviation"]["mu"]) in text and "of the noise" in text and
                "= %.6g GPa +- %.3g GPa" % (values["E0"] / 1e9, event["deviation"]["E0"] / 1e9) in text, text[-3000:])
    tests.check("plot fit: a picture", os.path.getsize(to + ".png") > 20000, tests.report(done))
    done = tests.run("-c", SETUP % (210, 0.4) + "; fit mu, E0 along %s; plot fit | fit title \"again\"" % name)
    tests.check("plot fit: in the terminal", done.stdout.count("shown.csv") == 2 == done.stdout.count("left over: rms = "), tests.report(done))
    tests.check("plot fit: the sign of the curve stands once in its key", len(re.findall(r"\S (?:mu|μ) = ", done.stdout)) == 2 and
                len(re.findall(r"   E0 = ", done.stdout)) == 2, tests.report(done))
    noisy = write(tests, "depths.csv", "force [N],depth [um]", [(80, 3.09), (20, 1.21), (120, 4.09), (50, 2.28)])
    values, event, done = answers(tests, SETUP % (210, 0.4) + "; fit E0 for depth = dz(force) to %s; plot fit to %s.gp" % (noisy, to))
    (points, curve), (over,) = drawn(to + ".gp")
    cN = values["E0"] / (2 * (1 - NU ** 2))
    tests.check("plot fit: an equation", [p[0] for p in curve] == [20, 50, 80, 120] and all(
        abs(depth - (3 * F / (4 * cN) / math.sqrt(R)) ** (2 / 3) * 1e6) < 1e-6 for F, depth in curve) and
        [p[0] for p in points] == [o[0] for o in over] == [80, 20, 120, 50], str((points, curve, over)))
    several = write(tests, "several.csv", "u,v,w", [(1, 1, 2.1), (2, 1, 2.9), (1, 3, 4.2), (4, 1, 5)])
    done = tests.run("-c", "x = 1; fit x for w = x*(u + v) to %s; plot fit to %s.gp; plot fit" % (several, to))
    (points, curve), _ = drawn(to + ".gp")
    tests.check("plot fit: over rows", [p[0] for p in points] == [1, 2, 3, 4] and "row" in done.stdout, tests.report(done))


def uneven(tests):
    """Asymmetric intervals from the profile of the sum of squares, against an independent computation for y = s (1 - exp(-q u)), whose
    s is linear. Symmetric ones are not changed."""
    def profile(rows, q, s=None):
        g = [1 - math.exp(-q * u) for u, _ in rows]
        s = sum(a * y for a, (_, y) in zip(g, rows)) / sum(a * a for a in g) if s is None else s
        return sum((y - s * a) ** 2 for a, (_, y) in zip(g, rows))

    def reach(rows, q, names, side, s=None):
        least = profile(rows, q, s)
        most = least * (1 + 1 / (len(rows) - names))
        lo, hi = 0.0, 1e-3
        while profile(rows, q + side * hi, s) < most and hi < 1e3:
            hi *= 2
        for _ in range(60):
            lo, hi = ((lo + hi) / 2, hi) if profile(rows, q + side * (lo + hi) / 2, s) < most else (lo, (lo + hi) / 2)
        return hi if hi < 500 else math.inf

    for seed, first, spread, names in ((1, 0.4, 0.2, 1), (2, 0.4, 0.2, 2), (3, 1.5, 0.06, 1), (4, 0.1, 0.01, 1), (5, 0.1, 0.3, 2), (6, 1.5, 0.2, 1), (8, 1.5, 0.2, 2)):
        noise = random.Random(seed)
        rows = [(u, 2 * (1 - math.exp(-1.5 * u)) + noise.gauss(0, spread)) for u in (first * i for i in range(1, 13))]
        name = write(tests, "uneven.csv", "u,y", rows)
        script = "q = 1; s = 2; fit q%s for y = s*(1 - exp(-q*u)) to %s" % (", s" if names == 2 else "", name)
        values, event, done = answers(tests, script)
        if not event:
            tests.check("fit: uneven, %d" % seed, False, tests.report(done))
            continue
        q, stated = values["q"], event["deviation"]["q"]
        want = [reach(rows, q, names, side, 2 if names == 1 else None) for side in (-1, 1)]
        differs = any(abs(w / stated - 1) > 0.3 for w in want)
        if "lower" in event and "q" in event["lower"]:
            top = event["upper"]["q"]
            got = [q - event["lower"]["q"], math.inf if top is None else top - q]
            ok = differs or any(abs(w / stated - 1) > 0.05 for w in want)
            ok = ok and all(g == w or abs(g / w - 1) < 0.03 for g, w in zip(got, want))
        else:
            ok = not differs
        tests.check("fit: interval %d, errors %.3g and %.3g" % (seed, want[0], want[1]), ok, "%s\n%s" % (want, tests.report(done)))
        text = tests.run("-c", script)
        if math.isinf(want[1]):
            tests.check("fit: bounded from below", re.match(r"q = \S+ \(-\S+, \+inf\)\n", text.stdout) and "the data give only a bound of q from below" in text.stderr
                        and event["upper"]["q"] is None, tests.report(text))
            data = tests.run("--format=csv", "-c", script).stdout.splitlines()
            tests.check("fit: its columns", data[0].startswith("q,q deviation,q lower,q upper") and data[1].split(",")[3] == "", str(data))
    noise = random.Random(1)
    name = write(tests, "unbounded.csv", "u,y", [(0.2 * i, noise.gauss(0, 1)) for i in range(20)])
    done = tests.run("-c", "q = 1; fit q for y = 0.001*sin(q*u) to " + name)
    tests.check("fit: bounded from no side", "inf, +inf)" in done.stdout and "the data hardly determine q" in done.stderr and
                "bound of" not in done.stderr and "down and up differ" not in done.stderr, tests.report(done))


def run(tests):
    figure(tests)
    uneven(tests)
    columns(tests)
    wide_ranges(tests)
    units(tests)
    straight_lines(tests)
    begun_at_the_end(tests)
    from_zero(tests)
    parabolas(tests)
    loops_with_loads(tests)
    edges(tests)
    shapes(tests)
    not_closed(tests)
    refusals(tests)
    noisy_loops(tests, 20 if tests.few else 60)
    drifting(tests)
    noisy_in_both(tests)
    sharp_drive(tests)
    moved_starts(tests)
    at_the_rig(tests)
    kept_at_the_rig(tests)
    by_cycle(tests)
    told_apart(tests)
    closed_loop(tests)
    from_a_turning_point(tests)
    begun_midway(tests)
    equations(tests)
    many_rows(tests)
