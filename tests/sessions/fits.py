# SPDX-License-Identifier: GPL-3.0-or-later
"""fit on data from a model of our own: springs, stepped one by one, with noise. It shares nothing with the program but
the physics: two equal homogeneous bodies, a paraboloid."""
import json
import math
import os
import random

SPRINGS = 1500
NU, R, FN = 0.3, 0.01, 100.0
SETUP = "material E0=%g GPa nu=0.3; geometry paraboloid R=10 mm; friction %g; press FN=100 N"


def springs_of(E0):
    """Contact radius, depth, and for each spring its place, normal force bound and tangential stiffness."""
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
    """F_x at each displacement of a path from rest."""
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
    """Up, and through a whole loop."""
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
    """mu and E0 within two standard errors, in at least 90 of 100 sets."""
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


def outliers(tests):
    """Rows far off pull least squares away, the robust fit hardly."""
    mu, E0 = 0.35, 200e9
    path = path_of(0.8e-6, 25)
    noise = random.Random(3)
    rows = [(d * 1e6, f + noise.gauss(0, 0.1) + (15 if i % 12 == 5 else 0)) for i, (d, f) in enumerate(zip(path, loop(mu, E0, path)))]
    name = write(tests, "outliers.csv", "dx [um],Fx [N]", rows)
    plain, _, _ = answers(tests, SETUP % (210, 0.4) + "; fit mu, E0 along " + name)
    robust, event, done = answers(tests, SETUP % (210, 0.4) + "; fit mu, E0 along " + name + " robust")
    off = abs(robust.get("mu", 0) - mu), abs(plain.get("mu", 0) - mu)
    tests.check("fit: robust against rows far off", event and off[0] < 0.01 * mu and off[1] > 5 * off[0],
                "%s\n%s" % (off, tests.report(done)))


def closed_loop(tests):
    """A loop that begins in its midst."""
    mu, E0 = 0.35, 200e9
    path = path_of(0.8e-6, 40)
    rows = list(zip(path, loop(mu, E0, path)))[41:]
    rows = [(d * 1e6, f) for d, f in rows[20:] + rows[:21]]
    name = write(tests, "closed.csv", "Fx [N],dx [um]", [(f, d) for d, f in rows])
    values, event, done = answers(tests, SETUP % (210, 0.4) + "; fit mu, E0 along " + name)
    tests.check("fit: a closed loop from its midst", event and abs(values["mu"] / mu - 1) < 1e-3 and abs(values["E0"] / E0 - 1) < 1e-3
                and "run twice" in done.stderr, tests.report(done))


def equations(tests):
    """Depth against force; what cannot be told apart."""
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
            ("; fit E0 along " + name, "has no column dx"),
            ("; fit zeta for depth = dz(force) to " + name, "'zeta' is no input and has no value to start from"),
            ("; fit E0 for depth = force to " + name, "the left side is a length, the right side is a force")):
        done = tests.run("-c", setup + script)
        tests.check("fit says: " + want, done.returncode == 1 and want in done.stderr, tests.report(done))


def many_rows(tests):
    """10^4 rows."""
    path = path_of(0.8e-6, 50)
    clean = loop(0.35, 200e9, path)
    noise = random.Random(7)
    rows = [(d * 1e6, f + noise.gauss(0, 0.3)) for _ in range(66) for d, f in list(zip(path, clean))[51:]]
    name = write(tests, "many.csv", "dx [um],Fx [N]", [(path[50] * 1e6, clean[50])] + rows)
    values, event, done = answers(tests, SETUP % (210, 0.4) + "; fit mu, E0 along " + name)
    tests.check("fit: many rows", event and abs(values["mu"] - 0.35) < 1e-3 and event["rows"] > 6000, tests.report(done))


def run(tests):
    noisy_loops(tests, 20 if tests.sanitized else 100)
    outliers(tests)
    closed_loop(tests)
    equations(tests)
    many_rows(tests)
