# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests `smooth` on noisy profiles: against independent least squares and splines, and against the noise."""
import itertools
import math
import os
import random
import re

import harness

NOISE = 0.05  # um


# ---- independent least squares: f in um over r in mm --------------------------------------------------------------

def solve(A, b):
    """Gaussian elimination with pivots."""
    n = len(b)
    rows = [list(A[i]) + [b[i]] for i in range(n)]
    for i in range(n):
        best = max(range(i, n), key=lambda j: abs(rows[j][i]))
        rows[i], rows[best] = rows[best], rows[i]
        for j in range(i + 1, n):
            q = rows[j][i] / rows[i][i]
            rows[j] = [x - q * y for x, y in zip(rows[j], rows[i])]
    x = [0] * n
    for i in reversed(range(n)):
        x[i] = (rows[i][n] - sum(rows[i][j] * x[j] for j in range(i + 1, n))) / rows[i][i]
    return x


def householder(X, y):
    """Least squares by Householder: solution, sum of squares, inverse of the normal matrix."""
    n, p = len(X), len(X[0])
    columns = [[row[j] for row in X] for j in range(p)] + [list(y)]
    for j in range(p):
        v = columns[j][j:]
        size = math.copysign(math.sqrt(math.fsum(x * x for x in v)), v[0])
        v[0] += size
        norm = math.fsum(x * x for x in v)
        for k in range(j, p + 1):
            q = 2 * math.fsum(a * b for a, b in zip(v, columns[k][j:])) / norm
            for i, a in enumerate(v):
                columns[k][j + i] -= q * a
    R = [[columns[j][i] if j >= i else 0 for j in range(p)] for i in range(p)]
    x = solve(R, columns[p][:p])
    inverse = [solve([[R[j][i] for j in range(p)] for i in range(p)], [float(i == j) for i in range(p)]) for j in range(p)]
    covariance = [[math.fsum(inverse[a][i] * inverse[b][i] for i in range(p)) for b in range(p)] for a in range(p)]
    return x, math.fsum(v * v for v in columns[p][p:n]), covariance


def ends(rows, pieces):
    at = sorted({abs(r) for r, _ in rows})
    return [0] + [at[i * (len(at) - 1) // pieces] for i in range(1, pieces + 1)]


def powers(r, knots):
    """Truncated powers: cubics with f = f' = 0 at r = 0 and jumps of f''' at the knots; the offset last."""
    return [r ** 2, r ** 3] + [max(r - t, 0) ** 3 for t in knots[1:-1]] + [1]


def bases(r, knots):
    """B-splines by de Boor's recursion."""
    t = [knots[0]] * 3 + knots + [knots[-1]] * 3
    last = len(t) - 5
    B = [float(t[i] <= r < t[i + 1] or (i == last and r == knots[-1])) for i in range(len(t) - 1)]
    for k in range(1, 4):
        B = [((r - t[i]) / (t[i + k] - t[i]) * B[i] if t[i + k] > t[i] else 0) +
             ((t[i + k + 1] - r) / (t[i + k + 1] - t[i + 1]) * B[i + 1] if t[i + k + 1] > t[i + 1] else 0)
             for i in range(len(B) - 1)]
    return B


def greville(knots):
    t = [knots[0]] * 3 + knots + [knots[-1]] * 3
    return [sum(t[i + 1:i + 4]) / 3 for i in range(len(t) - 4)]


# ---- profiles -----------------------------------------------------------------------------------------------------

def profile(f, noise=NOISE, n=200, both=False, seed=1):
    dice = random.Random(seed)
    at = [(2 * i - n + 1) / (n - 1) if both else i / (n - 1) for i in range(n)]
    return [(r, f(abs(r)) + dice.gauss(0, noise)) for r in at]


def sphere(r):
    return 50 * r ** 2


def text_of(rows):
    return "r [mm],f [um]\n" + "".join("%.17g,%.17g\n" % row for row in rows)


AT = (0.05, 0.2, 0.31, 0.5, 0.77, 0.99)


def smooth(tests, rows, how=""):
    """Smooths rows: the event of `geometry`, and f in um at AT."""
    with tests.file(text_of(rows), ".csv") as path:
        done = tests.run("--format=json", "-c", "geometry file %s smooth %s\n%s" %
                         (path, how, ", ".join("f(%g mm)" % r for r in AT)))
    lines = harness.told(done.stdout)
    if done.returncode or len(done.stderr.splitlines()) > 1 or len(lines) != 1 + len(AT):
        tests.check("smooth %s answers" % how, False, tests.report(done))
        return {}, [math.nan] * len(AT)
    return lines[0], [1e6 * line["value"] for line in lines[1:]]


def close(a, b, tolerance):
    return all(abs(x - y) <= tolerance for x, y in zip(a, b))


def squares(tests):
    """The least-squares spline, by another basis and another method."""
    hollow = [(i / 100, 13.523 * (i / 100) ** 2 / (1 + (i / 100) ** 2) + 0.1 * (i / 100) ** 4) for i in range(150)]
    sphere_rows = profile(sphere)
    # f is concave there, but r f' still grows: this is no noise, and stays
    for rows, pieces in (*((sphere_rows, n) for n in (1, 2, 5, 9)), (hollow, 2), (hollow, 4)):
        event, got = smooth(tests, rows, str(pieces))
        knots = ends(rows, pieces)
        x, left, _ = householder([powers(r, knots) for r, _ in rows], [f for _, f in rows])
        want = [sum(c * v for c, v in zip(x[:-1], powers(r, knots))) for r in AT]
        tests.check("%d pieces are those of least squares" % pieces, close(want, got, 1e-8), "%s\n%s" % (want, got))
        rests = [abs(f - sum(c * v for c, v in zip(x, powers(r, knots)))) for r, f in rows]
        worst = max(range(len(rows)), key=lambda i: rests[i])
        tests.check("and so is their misfit", event.get("pieces") == pieces and close(
            [1e6 * event["rms"], 1e6 * event["worst"], 1e3 * event["at"], 1e6 * event["offset"]],
            [math.sqrt(left / len(rows)), rests[worst], rows[worst][0], x[-1]], 1e-8), str(event))


def hollows(tests):
    """If r f' falls within a piece, the piece is made convex, as far as the noise allows."""
    rows = [(i / 100, 18.688 * (i / 100) ** 2 / (1 + 5 * (i / 100) ** 2) + 20 * (i / 100) ** 4) for i in range(150)]
    event, got = smooth(tests, rows, "2")
    slopes = [(b - a) / (s - r) for a, b, r, s in zip(got, got[1:], AT, AT[1:])]
    _, left, _ = householder([powers(r, ends(rows, 2)) for r, _ in rows], [f for _, f in rows])
    tests.check("a hollow piece is made convex", all(a <= b for a, b in zip(slopes, slopes[1:]))
                and 1 < 1e6 * event["rms"] / math.sqrt(left / len(rows)) < 1.1, "%s %s" % (slopes, event))


    rows = profile(lambda r: 50 * r ** 2 - 16.8 * r ** 3)  # f' falls near r = 1, r f' does not
    (A, B, offset), _, _ = householder([powers(r, [0, 1]) for r, _ in rows], [f for _, f in rows])
    _, got = smooth(tests, rows, "1")
    tests.check("a piece is kept whose r f' grows", A + 3 * B < 0 < 4 * A + 9 * B and
                close(got, [A * r ** 2 + B * r ** 3 for r in AT], 1e-9), "%g %g %s" % (A, B, got))
    rows = profile(lambda r: 50 * r ** 2 - 23 * r ** 3, noise=2, n=40, seed=6)
    (A, B, _), _, _ = householder([powers(r, [0, 1]) for r, _ in rows], [f for _, f in rows])
    (C, _), _, _ = householder([[r ** 2 - r ** 3 / 3, 1] for r, _ in rows], [f for _, f in rows])
    _, got = smooth(tests, rows, "1")  # f'' vanishes at the rim, where the nearest one is hollow
    tests.check("a piece whose r f' falls becomes the nearest convex one", 4 * A + 9 * B < 0 and
                close(got, [C * (r ** 2 - r ** 3 / 3) for r in AT], 1e-7), "%g %g %g %s" % (A, B, C, got))


def noise(tests):
    """A known sphere with known noise is found within its standard error, and the misfit is the noise."""
    for seed in range(2, 7):
        rows = profile(sphere, seed=seed)
        n = len(rows)
        event, got = smooth(tests, rows, "1")
        _, _, covariance = householder([powers(r, [0, 1]) for r, _ in rows], [f for _, f in rows])
        A, _ = solve([[AT[0] ** 2, AT[0] ** 3], [AT[-1] ** 2, AT[-1] ** 3]], [got[0], got[-1]])
        error = NOISE * math.sqrt(covariance[0][0])
        tests.check("R within three standard errors, profile %d" % seed, abs(A - 50) < 3 * error and error < 0.5,
                    "%g +- %g" % (A, error))
        left = 1e6 * event.get("rms", 0) * math.sqrt(n / (n - 3))
        tests.check("the misfit is the noise, profile %d" % seed, abs(left - NOISE) < 4 * NOISE / math.sqrt(2 * n), str(left))
        event, got = smooth(tests, rows)
        left = 1e6 * event.get("rms", 0) * math.sqrt(n / (n - 2 - event.get("pieces", 0)))
        tests.check("freely too, profile %d" % seed, abs(left - NOISE) < 4 * NOISE / math.sqrt(2 * n) and
                    close(got, [sphere(r) for r in AT], 4 * NOISE * math.sqrt((event["pieces"] + 2) / n)),
                    "%s %s" % (event, got))
    bowl, cone = profile(lambda r: 50 * r ** 2 * (1 - 0.3 * r ** 2 + 0.3 * r ** 6)), profile(lambda r: 40 * abs(r))
    for tolerance, rows in (1.5, bowl), (0.1, bowl), (0.055, bowl), (0.1, cone), (0.085, cone), (0.07, cone):
        event, _ = smooth(tests, rows, "%g um" % tolerance)
        misfit = 1e6 * event.get("rms", 1)
        fewer = []
        for pieces in range(1, event.get("pieces", 1)):
            _, left, _ = householder([powers(r, ends(rows, pieces)) for r, _ in rows], [f for _, f in rows])
            fewer.append(math.sqrt(left / len(rows)))
        tests.check("smooth %g um: the fewest pieces that come within" % tolerance,
                    misfit <= tolerance and all(m > tolerance for m in fewer), "%s %s" % (event, fewer))


def convex(tests):
    """If the least-squares spline falls within the noise: the nearest convex one, found by trying all sets of vanishing bends."""
    rows = profile(lambda r: 50 * max(r - 0.5, 0) ** 2, n=80, seed=3)
    for pieces in 2, 4, 5:
        event, got = smooth(tests, rows, str(pieces))
        knots = ends(rows, pieces)
        at, lines = greville(knots), [bases(abs(r), knots) for r, _ in rows]
        count = len(at) - 2

        def spline(line, at=at, count=count):  # parameters: the bends, then the offset
            return [sum((at[i + 2] - at[j + 1]) * line[i + 2] for i in range(j, count)) for j in range(count)]
        X = [spline(line) + [1] for line in lines]
        y = [f for _, f in rows]
        gram = [[math.fsum(a[i] * a[j] for a in X) for j in range(count + 1)] for i in range(count + 1)]
        right = [math.fsum(a[i] * f for a, f in zip(X, y)) for i in range(count + 1)]
        best = None
        for used in itertools.product((False, True), repeat=count):
            which = [i for i in range(count) if used[i]] + [count]
            part = solve([[gram[i][j] for j in which] for i in which], [right[i] for i in which])
            if all(v >= 0 for v in part[:-1]):
                e = [0.0] * (count + 1)
                for i, v in zip(which, part):
                    e[i] = v
                left = math.fsum((f - sum(a * b for a, b in zip(row, e))) ** 2 for row, f in zip(X, y))
                best = min(best, (left, e)) if best else (left, e)
        want = [sum(a * b for a, b in zip(spline(bases(r, knots)), best[1])) for r in AT]
        tests.check("%d convex pieces" % pieces, close(want, got, 1e-7) and min(best[1][:-1]) == 0 and
                    abs(1e6 * event.get("rms", 0) - math.sqrt(best[0] / len(rows))) < 1e-8, "%s\n%s\n%s" % (want, got, event))
    with tests.file(text_of(rows), ".csv") as path:
        done = tests.run("-c", "material steel; geometry file %s smooth; press FN=10 N; f(0.3 mm), a" % path)
        tests.check("a pad that begins flat can be pressed", done.returncode == 0 and "misfit" in done.stderr, tests.report(done))


def contacts(tests):
    """Rows of a spline without noise give that spline: the contact is that of the formula."""
    rows = [(r, 50 * r ** 2 + 20 * r ** 3) for r in (i / 300 for i in range(301))]
    ask = "friction 0.3; press FN=50 N; step Fx=5 N; FN, dz, a, dx, c, kt, W, p(0.1 mm), dW(3 N)\nk = 0.4, c0 = 1 mm; dz, a, c"
    want = harness.printed_values(tests.run("--format=json", "-c", "material steel; geometry sum 2:50 m^-1, 3:2e4 m^-2; " + ask).stdout)
    for how in "1", "7", "30", "":
        with tests.file(text_of(rows), ".csv") as path:
            done = tests.run("--format=json", "-c", "material steel; geometry file %s smooth %s; " % (path, how) + ask)
        got = harness.printed_values(done.stdout)
        tests.check("a contact of rows without noise, smooth " + how, len(got) == 12 and
                    all(abs(g - w) < 2e-9 * abs(w) for g, w in zip(got, want)), "%s\n%s" % (want, got))
    rows = profile(sphere, n=101)
    first = smooth(tests, rows, "4")
    lifted = [(r, f + 7) for r, f in rows]
    random.Random(5).shuffle(lifted)
    second = smooth(tests, lifted, "4")
    tests.check("neither order nor height matter", close(first[1], second[1], 1e-7) and
                abs(1e6 * (second[0]["offset"] - first[0]["offset"]) - 7) < 1e-7, "%s %s" % (first, second))
    mirrored = smooth(tests, [(-r, f) for r, f in rows[::2]] + rows[1::2], "4")
    tests.check("nor on which side they are", close(first[1], mirrored[1], 1e-9), "%s %s" % (first, mirrored))
    both = smooth(tests, profile(sphere, n=401, both=True), "3")
    tests.check("both sides count", close(both[1], [sphere(r) for r in AT], 5 * NOISE / 20), str(both))


def apexes(tests):
    """A profile of both sides: apex and tilt are reported if they are there, but not if only noise or rounding suggests them."""
    def told(f, n, noise, seed=1):
        rows = [(r, f(r) + error) for r, error in profile(lambda r: 0, noise, n, both=True, seed=seed)]
        with tests.file(text_of(rows), ".csv") as path:
            return tests.run("-c", "geometry file %s smooth" % path).stderr
    for n in (11, 21, 41):
        for noise in (0, 0.02):
            tilts = sum("tilt" in told(lambda r: 50 * r ** 2, n, noise, seed) for seed in range(20 if noise else 1))
            tests.check("a tilt of a paraboloid, %d rows, noise %g um" % (n, noise), tilts <= 6 * (noise > 0), "%d of 20" % tilts)
        for noise in (0, 0.02):
            out = told(lambda r: 25 * abs(r - 0.07) + 10 * (r - 0.07), n, noise)
            tilt = re.search(r"apex is at r = ([0-9.]+) um, a tilt of ([0-9.]+) is taken off", out)
            tests.check("a tilted cone, %d rows, noise %g um" % (n, noise), tilt and abs(float(tilt[1]) - 70) < 120 / (n - 1) and
                        abs(float(tilt[2]) - 0.01) < 2e-3, out)


def kept(tests):
    """show, save, record and undo restore the smoothed gap to the last bit."""
    where = os.path.join(tests.dir, "smoothed")
    os.mkdir(where)
    with open(os.path.join(where, "p.csv"), "w", encoding="ascii") as f:
        f.write(text_of(profile(sphere)))
    for how, shown in ((" smooth", " smooth"), (" smooth 6", " smooth 6"), (" smooth 0.14285714285714285 um", " smooth 1.4285714285714285e-07 m")):
        scene = "material steel; friction 0.3; geometry file p.csv%s; press FN=10 N; step Fx=1 N\n" % how
        ask = "set digits 17\nf(0.37 mm), dz, dx, c, W, p(0.05 mm)\n"
        first = tests.run("-c", scene + "save s.fret\nshow\n" + ask, cwd=where)
        tests.check("show of p.csv" + how, "geometry file p.csv" + shown in first.stdout and first.returncode == 0,
                    tests.report(first))
        for way, script in (("save", "source s.fret\nshow\n"), ("undo", scene + "geometry sphere R=1 m; undo\nshow\n"),
                            ("assignment", scene + "k = 0.5, c0 = 1 mm; k = 0; reset; undo; undo; undo; show\n")):
            again = tests.run("-c", script + ask, cwd=where)
            tests.check("p.csv%s by %s" % (how, way), again.stdout == first.stdout, tests.report(again) + first.stdout)
        done = tests.run("-c", scene + "record r.txt\nf(0.5 mm)\ngeometry file p.csv smooth 3\nrecord off", cwd=where)
        done = tests.run("--replay", "r.txt", cwd=where)
        tests.check("p.csv%s recorded" % how, done.returncode == 0 and " 0 failed" in done.stdout, tests.report(done))


WRONG = (
    (sphere, "smoth", "-c:1:%d: error: unexpected 'smoth': did you mean smooth?"),
    (sphere, "smooth 3 N", "smooth takes a misfit (smooth 0.1 um) or a number of pieces (smooth 8)"),
    (sphere, "smooth 0", "smooth takes a misfit"), (sphere, "smooth 2.5", "smooth takes a misfit"),
    (sphere, "smooth -1 um", "smooth takes a misfit"), (sphere, "smooth 3 4", "unexpected '4'"),
    (sphere, "smooth 51", "200 different r allow at most 50 pieces"),
    (sphere, "smooth 1 nm", "no profile of up to 50 pieces comes within 1 nm (rms): the nearest is 4"),
    (lambda r: 50 * r ** 2 - 30 * r ** 4, "smooth", "falls from r = 91"),
    (lambda r: 50 * r ** 2 - 30 * r ** 4, "smooth 6", " nm, which is no noise: leave out what lies beyond, or take fewer"),
    (lambda r: -50 * r ** 2, "smooth 3", "the profile of 3 pieces falls from r = 0 m on, by ",
     " um, which is no noise: f is the gap and grows outward; the sign or the apex may be the cause\n"),
    (lambda r: 50 - 50 * (r - 0.2) ** 2, "smooth", " um, which is no noise: f is the gap and grows outward; the sign or the apex may"),
    (lambda r: -50 * r ** 2, "smooth 1 um", "the profile of 1 piece falls from r = 0 m on, by ",
     " um, which is no noise: f is the gap and grows outward; the sign or the apex may be the cause\n"),
)


def refused(tests):
    with tests.file(text_of([(i, i * i) for i in range(900)]), ".csv") as path:
        done = tests.run("-c", "geometry file %s smooth 200\ngeometry file %s smooth 201" % (path, path))
        tests.check("200 pieces are the most", "note: smoothed, 200 pieces" in done.stderr and "-c:2:" in done.stderr
                    and "error: smooth takes a misfit" in done.stderr, tests.report(done))
    for f, how, message, *more in WRONG:
        with tests.file(text_of(profile(f)), ".csv") as path:
            start = "mu = 0.3; geometry sphere R=1 m; geometry file %s " % path
            done = tests.run("--keep-going", "-c", start + how + "\nshow")
            message = message % (1 + len(start)) if "%" in message else message
        tests.check("smooth: " + message + "".join(more), all(text in done.stderr for text in (message, *more)) and
                    "sphere R=1 m" in done.stdout and done.returncode == 1,
                    tests.report(done))
    for rows, message in (([(0, 0), (1, 1), (2, 4)], "3 different r are too few to smooth"),
                          ([(0, 0)] * 9, "the rows are all at r = 0"), ([(i, 0) for i in range(9)], "the rows are all at f = 0")):
        with tests.file(text_of(rows), ".csv") as path:
            done = tests.run("-c", "geometry file %s smooth" % path)
        tests.check("smooth: " + message, message in done.stderr and done.returncode == 1, tests.report(done))
    # r^2 (1 - r) has its maximum at 2/3; it is a single cubic
    with tests.file(text_of([(i / 40, 50 * (i / 40) ** 2 * (1 - i / 40)) for i in range(41)]), ".csv") as path:
        for how in ("1", "1 mm"):
            done = tests.run("-c", "geometry file %s smooth %s" % (path, how))
            tests.check("smooth: a cubic that falls", "error: the profile of 1 piece falls from r = 666.667 um on, by 7.40741 um, which is "
                        "no noise: leave out what lies beyond\n" in done.stderr and done.returncode == 1, tests.report(done))
    with tests.file(text_of([(0, 1), (1, 2)]), ".csv") as path:
        done = tests.run("-c", "geometry file %s" % path)
        tests.check("f(0) that is not 0 points to it", "(smooth takes it off)" in done.stderr, tests.report(done))
    with tests.file(text_of([(0, 0), (1, 1), (2, -1)]), ".csv") as path:
        done = tests.run("-c", "geometry file %s" % path)
        tests.check("a gap below 0", path + ":4: f = -1 um is below f(0) = 0: f is the gap and grows outward; the sign or the apex may be "
                    "the cause\n" in done.stderr and done.returncode == 1, tests.report(done))


def run(tests):
    tests.each([lambda room=room: room(tests) for room in (squares, hollows, noise, convex, contacts, apexes, kept, refused)])
