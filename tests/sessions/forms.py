# SPDX-License-Identifier: GPL-3.0-or-later
"""Files in the formats of rigs, tribometers, indenters, profilometers and programs (in tests/sessions/forms, named by format): they are
read, and what was understood is reported; or refused, with advice. And the results of `loop`, against formulas."""
import csv
import io
import itertools
import math
import os
import random
from fractions import Fraction

import harness

HERE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "forms")
SCENE = "material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N; "
NUMBERS = itertools.count()
NAMED, ONE = "11 rows from line 2", ", 1 cycle"
# other files with the loop of plain.csv, and the messages about them
SAME = {
    "plain.csv": NAMED + ONE, "in-parentheses.csv": NAMED + ONE, "behind-in.csv": NAMED + ONE, "behind-slash.csv": NAMED + ONE,
    "behind-underscore.csv": NAMED + ONE, "unit-row.csv": "11 rows from line 3" + ONE,
    "unit-row-brackets.txt": '11 rows from line 3, dx from "Axial Displacement [um]", Fx from "Axial Force [N]"' + ONE,
    "preamble.csv": "11 rows from line 7" + ONE, "end-of-header.lvm": "11 rows from line 11" + ONE,
    "item-lines.dump": '11 rows from line 6, dx from "v_dx[um]", Fx from "v_Fx[N]"' + ONE,
    "no-header.dat using dx=1 um, Fx=2 N": "11 rows from line 1, dx from column 1, Fx from column 2" + ONE,
    "footer.csv": NAMED + ", 3 lines of words left out (line 14)" + ONE, "comments.csv": "11 rows from line 4" + ONE,
    "header-in-comment.txt": "11 rows from line 3" + ONE, "percent-header.dat": "11 rows from line 3" + ONE,
    "tabs.txt": NAMED + ONE, "blanks.txt": NAMED + ONE, "carriage-returns.csv": NAMED + ONE, "quoted.csv": NAMED + ONE,
    "decimal-commas.csv": NAMED + ', dx from "Weg [um]", Fx from "Kraft [N]"' + ONE,
    "decimal-commas-blanks.txt": NAMED + ', dx from "Weg[um]", Fx from "Kraft[N]"' + ONE,
    "windows-1252.csv": '11 rows from line 3, dx from "Weg [\u00b5m]", Fx from "Kraft [N]"' + ONE,
    "utf-16.txt": NAMED + ONE, "utf-16-no-mark.txt": NAMED + ONE, "mangled-micro.csv": NAMED + ONE,
    "empty-first-field.csv": NAMED + ONE, "comment-column.csv": NAMED + ONE,
    "names-with-blanks.txt": NAMED + ', dx from "Lateral Displacement (um)", Fx from "Load On Sample (kN)"' + ONE,
    'names-with-blanks.txt using dx=2, Fx="Load On Sample"': NAMED + ', dx from "Lateral Displacement (um)", Fx from "Load On Sample (kN)"' + ONE,
    "names-with-blanks.txt using t=1": NAMED + ', t not used, dx from "Lateral Displacement (um)", Fx from "Load On Sample (kN)"' + ONE,
    "names-twice.csv using Fx=2": NAMED + ', Fx from "Fx [N]"' + ONE,
    "other-language.csv": NAMED + ', dx from "Verschiebung [\u00b5m]", Fx from "Querkraft [N]"' + ONE,
    "two-forces.csv using Fx=Querkraft": NAMED + ', dx from "Weg [um]", Fx from "Querkraft [N]"' + ONE,
    "two-lengths.csv using dx=v": NAMED + ', dx from "v [um]"' + ONE,
    "unknown-unit.csv using dx=dx um": NAMED + ', dx from "dx [furlong]"' + ONE,
    "several-cycles.csv": "27 rows from line 2, 2 lines of words left out (line 13), 3 cycles",
    "header-again.csv": "19 rows from line 2, 2 cycles",
    "missing-values.csv": NAMED + ", 4 rows without a value left out" + ONE,
    "members.json": NAMED + ONE,
    "force-turned.csv": NAMED + ONE + ", Fx falls where dx grows: its sign is turned",
}
SHIFT_JIS = ('11 rows from line 2, dx from "\u5909\u4f4d[\u03bcm]", Fx from "\u8377\u91cd[N]", read as Shift-JIS' + ONE,
             "is in Shift-JIS, which this system cannot read: save it as UTF-8\n")
REFUSED = {
    "loop no-header.dat": "no-header.dat has no column dx: it has no line of names above its rows; say which it is: using dx=NUMBER UNIT\n",
    "loop no-header.dat using dx=1, Fx=2 N": "column dx is a number: it needs the unit of a length in the header, or here: using dx=COLUMN UNIT\n",
    "loop no-header.dat using dx=1 um, Fx=3 N": "no-header.dat has no column 3: it has no line of names above its rows\n",
    "loop no-header.dat using dx=1 um, Fx=1 N": "column 1 is already used as dx\n",
    "loop no-header.dat using dx=1 um, dx=2 um": "dx is given twice\n",
    "loop plain.csv using dx=Fx, Fx=dx": "column dx is a force: it needs the unit of a length in the header\n",
    "loop plain.csv using x=dx, dx=dx": "column dx is already used as x\n",
    "loop no-header.dat using dx=1 lightyear": "unknown unit 'lightyear'; try: help units\n",
    "loop no-header.dat using dx": "expected = after dx\n",
    "loop names-twice.csv": "names-twice.csv has two columns Fx: rename one, or say which by its number: using Fx=2\n",
    "loop names-twice.csv using Fx=Fx": "names-twice.csv has two columns Fx: give the number of one\n",
    "loop names-with-blanks.txt using Fx=Load": 'names-with-blanks.txt has no column Load: its columns are Time, Lateral Displacement, Load On Sample, '
                                                'by line 1, "Time (s)\tLateral Displacement (um)\tLoad On Sample (kN)"\n',
    "loop two-forces.csv": "two-forces.csv has no column Fx, and a force is each of Normalkraft, Querkraft: say which it is: using Fx=COLUMN\n",
    "loop two-lengths.csv": "two-lengths.csv has no column dx, and a length is each of u, v: say which it is: using dx=COLUMN\n",
    "loop two-forces.csv using Fx=Querkraft kN": 'the file has another unit for it: "Querkraft [N]"\n',
    "loop unknown-unit.csv": "unknown-unit.csv:1: column dx: unknown unit 'furlong'; try: help units\n",
    "loop thousands.csv": "thousands.csv:3: Fx = 1.500 may be 1.5 or 1500, since line 3 has a decimal comma: write it without its point, or with a comma\n",
    "loop bare-thousands.csv using dx=dx um, Fx=2 N": "bare-thousands.csv:3: Fx = 1.500 may be 1.5 or 1500, since line 3 has a decimal comma: write it without its point, or with a comma\n",
    "loop decimal-commas-commas.csv": "decimal-commas-commas.csv:3: more than 2 fields, one for each name of the header\n",
    "loop prose.txt": "prose.txt holds no rows of numbers\n",
    "loop profile.csv": 'profile.csv has no column Fx: its columns are r, f, by line 1, "r [mm],f [um]"; say which it is: using Fx=COLUMN\n',
    "loop pull-is-negative.csv": 'pull-is-negative.csv has no column dx: its columns are FN, Fx, by line 1, "FN [N],Fx [N]"; say which it is: using dx=COLUMN\n',
    "loop profile.csv using dx=r, Fx=f N": 'the file has another unit for it: "f [um]"\n',
    "loop nowhere.csv": "cannot read nowhere.csv: No such file or directory\n",
    "loop plain.csv to plain.xyz": "cannot tell the form of a table from 'plain.xyz': use .csv, .json, .txt or .dat\n",
    SCENE + "follow force-turned.csv": "force-turned.csv: Fx falls where dx grows: one of them has the other sign in the file\n",
    "material steel; geometry sphere R=10 mm; friction 0.4; follow plain.csv": "there is no load yet: press first (press FN=100 N)\n",
    SCENE + "step Fx=1 N; plot loop using Fx=Fx to x.gp": "using follows at FILE.csv or over FILE.csv\n",
    "geometry file profile-both-sides.csv": "is below f(0) = 0: f is the gap and grows outward; the sign or the apex may be the cause\n",
    "geometry file profile-apex.csv smooth": "which is no noise: f is the gap and grows outward; the sign or the apex may be the cause\n",
}
# statements, their output and messages
READ = (
    (SCENE + "follow plain.csv; dx, Fx", "dx = 2 um\nFx = 40 N\n", "note: Fx of the file differs from the computed Fx by 10.7737 N (rms)\n"),
    (SCENE + "follow pull-is-negative.csv; FN, Fx, W", "FN = 120 N\nFx = -15 N\nW = 328.223 nJ\n",
     "note: pull-is-negative.csv: 3 rows from line 2, FN is negative throughout, which is compression here: its sign is turned\n"),
    (SCENE + "fit mu along two-forces.csv using Fx=Querkraft", None, 'note: two-forces.csv: 11 rows from line 2, dx from "Weg [um]", Fx from "Querkraft [N]"\n'),
    (SCENE + "fit mu along force-turned.csv", None, "note: force-turned.csv: 11 rows from line 2, Fx falls where dx grows: its sign is turned\n"),
    ("q = 1 um; fit q for d = q*F/(1 N) to plain.csv using d=dx, F=2", None, 'note: plain.csv: 11 rows from line 2, d from "dx [um]", F from "Fx [N]"\n'),
    (SCENE + "step Fx=1 N; plot loop over two-forces.csv using Fx=Querkraft over plain.csv to x.gp", None,
     'note: two-forces.csv: 11 rows from line 2, dx from "Weg [um]", Fx from "Querkraft [N]"\n'),
    ("geometry file profile.csv; f(0.5 mm)", "f(0.5 mm) = 12.5 um\n", ""),
    ("geometry file profile-height.csv height; f(0.5 mm); show", "f(0.5 mm) = 12.5 um\ngeometry file profile-height.csv height\n",
     'note: profile-height.csv: 21 rows from line 2, r from "x [mm]", f from "z [um]", f = -z\n'),
    ("geometry file profile-height.csv height using r=1, f=z; f(0.5 mm); show",
     "f(0.5 mm) = 12.5 um\ngeometry file profile-height.csv height using r=1, f=z\n", None),
    ("geometry file profile-both-sides.csv smooth; f(0.5 mm)", None, "note: smoothed, 1 piece: misfit 20 nm rms"),
    ("geometry file profile-apex.csv smooth height; show", "geometry file profile-apex.csv smooth height\n",
     "note: the apex is at r = 199.957 um: both sides are folded about it\n"),
    ("geometry file profile-tilt.csv smooth", None, "note: the apex is at r = 150.137 um, a tilt of 0.00800767 is taken off: both sides are folded about it\n"),
)


def table(tests, statement, cwd=HERE):
    """The rows that `loop ... to FILE` writes."""
    path = os.path.join(tests.dir, "cycles%d.csv" % next(NUMBERS))
    done = tests.run("-c", "%s to %s" % (statement, path), cwd=cwd)
    if done.returncode:
        return [], done
    with open(path, encoding="utf-8") as f:
        rows = [{k.split(" ")[0]: float(v) for k, v in row.items()} for row in csv.DictReader(io.StringIO(f.read()))]
    os.unlink(path)
    return rows, done


def near(got, want, part=1e-12):
    return abs(got - want) <= part * abs(want)


def forms(tests):
    want, _ = table(tests, "loop plain.csv")
    tests.check("loop plain.csv", near(want[0]["dW"], 110e-6) and want[0]["dxA"] == 2e-6 and want[0]["FA"] == 30, str(want))
    rows, _ = table(tests, "loop several-cycles.csv")
    out = tests.run("--format=csv", "-c", "loop several-cycles.csv", cwd=HERE).stdout
    tests.check("loop as CSV is its table", out.startswith("cycle,line,dW [J],") and
                [float(v) for v in out.splitlines()[-1].split(",")] == list(rows[-1].values()), out)
    for form, words in SAME.items():
        rows, done = table(tests, "loop " + form)
        said = "note: %s: %s\n" % (form.split()[0], words)
        tests.check("read: " + form, rows and all(near(rows[0][k], want[0][k]) for k in want[0] if k != "line") and
                    done.stderr.startswith(said), tests.report(done))
    rows, done = table(tests, "loop shift-jis.csv")
    tests.check("read: shift-jis.csv", (rows and near(rows[0]["dW"], 110e-6) and "shift-jis.csv: " + SHIFT_JIS[0] in done.stderr) or
                SHIFT_JIS[1] in done.stderr, tests.report(done))
    named = {statement.split(".")[0].split()[-1] for statement in (*SAME, *REFUSED, *(row[0] for row in READ))} | {"shift-jis"}
    unused = [name for name in os.listdir(HERE) if not any(name.split(".")[0] in n for n in named)
              and name not in " ".join((*SAME, *REFUSED, *(row[0] for row in READ)))]
    tests.check("each form is asked for", not unused, str(unused))


def words(tests):
    path = os.path.join(tests.dir, "picture.png")
    with open(path, "wb") as f:
        f.write(bytes.fromhex("89504e470d0a1a0a0000000d4948445200000010"))
    done = tests.run("-c", "loop " + path)
    with tests.file("dx [m],Fx [N]\n" + 20 * "1e-7,3\n", ".csv") as hold:
        held = tests.run("-c", SCENE + "follow " + hold)
    tests.check("followed: one place for 20 rows", held.returncode == 0 and "note: Fx of the file differs" in held.stderr, tests.report(held))
    tests.check("refused: a picture", done.returncode == 1 and "picture.png:3: this is no text, or UTF-16 without its mark: save it as UTF-8\n" in
                done.stderr, tests.report(done))
    for statement, message in REFUSED.items():
        done = tests.run("-c", statement, cwd=HERE)
        tests.check("refused: " + statement, "error: " in done.stderr and message.replace("\t", " ") in done.stderr.replace("\t", " ")
                    and done.returncode == 1, tests.report(done))
    for statement, out, said in READ:
        done = tests.run("-c", statement.replace("to x.gp", "to " + os.path.join(tests.dir, "x.gp")), cwd=HERE)
        tests.check("read: " + statement, done.returncode == 0 and (out is None or harness.same_text(out, done.stdout)) and
                    (said is None or (said in done.stderr if said else not done.stderr)), tests.report(done))


def write(tests, name, rows, head="dx [um],Fx [N]\n"):
    path = os.path.join(tests.dir, "%d-%s" % (next(NUMBERS), name))
    with open(path, "w", encoding="ascii") as f:
        f.write(head + "".join("%r,%r\n" % row for row in rows))
    return path


def polygons(tests):
    """Loops that are polygons, given by their corners: area, amplitudes, stiffness and centre are those of the polygon, also where a
    rig rests at its turning points (rows held)."""
    dice = random.Random(4)
    for many, held in (1, 1), (5, 1), (40, 1), (1, 3), (5, 3), (40, 3):
        A, F, K, x0, F0 = dice.uniform(1, 9), dice.uniform(5, 90), dice.uniform(20, 90), dice.uniform(-1, 1), dice.uniform(-3, 3)
        back = 2 * F / K
        corners = [(A, F), (A - back, -F), (-A, -F), (back - A, F), (A, F)]
        rows = []
        for (xa, Fa), (xb, Fb) in zip(corners, corners[1:]):
            rows += [(x0 + xa + (xb - xa) * i / many, F0 + Fa + (Fb - Fa) * i / many) for i in range(many)]
            rows[-many:-many] = (held - 1) * [rows[-many]] if abs(xa) == A else []
        rows.append(rows[0])
        exact = [(Fraction(x), Fraction(f)) for x, f in rows]
        dW = abs(float(sum((a[1] + b[1]) * (b[0] - a[0]) for a, b in zip(exact, exact[1:])) / 2)) * 1e-6
        path = write(tests, "polygon.csv", rows)
        got, done = table(tests, "loop " + path)
        tests.check("loop of a polygon of %d rows, turning points held for %d" % (len(rows), held), len(got) == 1 and near(got[0]["dW"], dW) and near(got[0]["dxA"], A * 1e-6) and
                    near(got[0]["FA"], F) and near(got[0]["unloading"], K * 1e6, 1e-11) and near(got[0]["secant"], F / A * 1e6)
                    and near(got[0]["dx0"], x0 * 1e-6, 1e-11) and near(got[0]["Fx0"], F0, 1e-11) and got[0]["slides"] == 1
                    and abs(got[0]["flank"]) < 1e-12, tests.report(done) + str(got))


def sampled(tests):
    """Loops computed by the program, M rows per cycle: dW is too small by a part of (2 pi/M)^2/6 at most, the rest is exact."""
    for FA, M in (15, 40), (30, 100), (38, 400):
        path = os.path.join(tests.dir, "own.csv")
        done = tests.run("--format=json", "-c", SCENE + "cycle FA=%d N times 3 steps %d; history to %s; dW, dx, Ksec(%d N), kn*(2-nu)^-1*2*(1-nu)"
                         % (FA, M, path, FA))
        dW, dx, Ksec, kt = harness.printed_values(done.stdout)
        rows, done = table(tests, "loop " + path)
        tests.check("loop of %d rows a cycle" % M, len(rows) == 3 and all(
            0 <= 1 - r["dW"] / dW <= (2 * math.pi / M) ** 2 / 6 and near(r["dxA"], dx, 1e-9) and near(r["FA"], FA, 1e-9) and
            near(r["secant"], Ksec, 1e-9) and near(r["unloading"], kt, 0.01) and r["slides"] == 0 and abs(r["dx0"]) < 1e-15
            for r in rows), "%s %s %s" % (tests.report(done), (dW, dx, Ksec, kt), rows))


def drifting(tests):
    """A drift of either reading does not change dW, whichever turning point the cycles begin at."""
    for begins, turned in ((1, ""), (-1, "-")):
        for drift in (0.0, 0.0), (6.0, 0.0), (0.0, 0.2), (-4.0, 0.3):
            path = os.path.join(tests.dir, "drifting.csv")
            done = tests.run("--format=json", "-c", SCENE + "cycle FA=10 N times 4; dW; table %sdx + %g nm*time, %sFx + %g N*time along program "
                             "steps 2000 to %s" % (turned, drift[0], turned, drift[1], path))
            dW = harness.printed_values(done.stdout)[0]
            rows, done = table(tests, "loop " + path)
            tests.check("loop that drifts %g nm, %g N a cycle, begins %+d" % (*drift, begins), len(rows) == 4 and
                        all(near(r["dW"], dW, 0.003) for r in rows), "%s %g %s" % (tests.report(done), dW, rows))


def loop_of(phase, slip=0.6, K=40.0, F=30.0):
    """F_x at a phase of a loop of a spring and a slider: d_x = A cos(phase), A in um."""
    A = F / K * (1 + slip)
    x = A * math.cos(phase)
    way = A - x if 0 <= phase % (2 * math.pi) < math.pi else x + A
    f = max(F - K * way, -F) if 0 <= phase % (2 * math.pi) < math.pi else min(K * way - F, F)
    return x, f


def wrong_way(tests):
    """A loop that would supply energy is no contact's: the message says that one reading lags."""
    rows = [loop_of(2 * math.pi * i / 60) for i in range(61)]
    for name, some, wrong in (("as it is", rows, False), ("the wrong way round", rows[::-1], True)):
        done = tests.run("-c", "loop " + write(tests, "way.csv", some))
        tests.check("loop " + name, done.returncode == 0 and ("the wrong way round" in done.stderr) == wrong, tests.report(done))


def noisy(tests):
    """Noisy loops: results within the noise for each draw; turning points are told from noise, and cycles begin where they should."""
    M, cycles, sx, sF = 200, 5, 0.01, 0.5
    K, F, slip = 40.0, 30.0, 0.6
    A, dW = F / K * (1 + slip), 4 * F * (F / K) * slip
    for seed in range(1, 9):
        dice = random.Random(seed)
        rows = []
        for i in range(-M // 4, M * cycles + 1):
            x, f = loop_of(2 * math.pi * i / M, slip, K, F) if i > 0 else (A * (1 + 4 * i / M), min(F, K * A * (1 + 4 * i / M)))
            rows.append((x + 0.05 * i / M + dice.gauss(0, sx), f + 0.3 * i / M + dice.gauss(0, sF)))
        path = write(tests, "noisy.csv", rows)
        got, done = table(tests, "loop " + path)
        # noise of the area of M rows, sum of F dx: each factor times the noise of the other
        spread = math.hypot(sF * math.sqrt(2) * A * math.pi / math.sqrt(M), 2 * sx * F * math.sqrt(2 * 2 / M) * 4 + sx * sF * math.sqrt(M))
        ok = len(got) == cycles and all(
            abs(r["dW"] * 1e6 - dW) < 5 * spread and abs(r["dxA"] * 1e6 - A) < 3 * sx and abs(r["FA"] - F) < 3 * sF and
            near(r["unloading"], K * 1e6, 0.15) and r["slides"] == 1 for r in got)
        event = [row for row in harness.told(tests.run("--format=json", "-c", "loop " + path).stdout) if row.get("event") == "loop"]
        ok = ok and event and near(event[0]["noise_dx"], sx * 1e-6, 0.2) and near(event[0]["noise_Fx"], sF, 0.2)
        ok = ok and abs(event[0]["drift_dx"] - 0.05e-6) < sx * 1e-6 and abs(event[0]["drift_Fx"] - 0.3) < sF and event[0]["row_1"] == "at rest"
        tests.check("loop of noise, %d" % seed, ok, "%s %s %s" % (done.stderr, got, event))


def much_noise(tests):
    """Noise of a twentieth of the amplitude, and the last turning point just before the end: no row beyond the end is read."""
    M, s = 400, 0.05
    for seed in range(6):
        dice = random.Random(seed)
        rows = [(math.sin(2 * math.pi * i / M) + dice.gauss(0, s), 30 * math.sin(2 * math.pi * i / M + 0.3) + dice.gauss(0, 0.1))
                for i in range(750 + seed)]
        got, done = table(tests, "loop " + write(tests, "much.csv", rows))
        tests.check("loop of much noise, %d" % seed, len(got) == 1 and abs(got[0]["dxA"] * 1e6 - 1) < 3 * s, tests.report(done) + str(got))


def where_cycles_begin(tests):
    """Files that begin at a turning point or between two, with or without the first loading; loops that do not close are reported."""
    M = 60
    turn = [loop_of(2 * math.pi * i / M) for i in range(M + 1)]
    ways = {"from a turning point": turn, "from its midst": turn[20:-1] + turn[:21], "from its other turning point": turn[30:-1] + turn[:31],
            "and a half": turn + turn[1:31], "backwards in sign": [(-x, f) for x, f in turn], "two": turn + turn[1:],
            "from its midst, not closed by a row": turn[20:-1] + turn[:20]}
    for name, rows in ways.items():
        got, done = table(tests, "loop " + write(tests, "way.csv", rows))
        tests.check("loop " + name, len(got) == (2 if name == "two" else 1) and all(near(r["dW"], 54e-6, 0.005) and r["slides"] == 1 for r in got),
                    tests.report(done) + str(got))
    some = [loop_of(2 * math.pi * i / M) for i in range(4 * M)]
    for begin, end, cycles in ((0, 55, 0), (0, 115, 1), (0, 119, 2), (57, 118, 1), (15, 81, 1), (15, 95, 1), (45, 111, 1)):  # ends before its turning point, or behind its beginning
        got, done = table(tests, "loop " + write(tests, "way.csv", some[begin:end + 1]))
        tests.check("loop from row %d to %d" % (begin, end), len(got) == cycles and all(
            near(r["dW"], 54e-6, 0.005) and near(r["dxA"], 1.2e-6, 0.012) and near(r["FA"], 30) for r in got), tests.report(done) + str(got))
    tests.run("-c", SCENE + "table dx, Fx along cycle FA=30 N steps 100 to rest.csv", cwd=tests.dir)  # 80 rows a period
    with open(os.path.join(tests.dir, "rest.csv"), encoding="ascii") as f:
        lines = f.read().splitlines(True)
    with open(os.path.join(tests.dir, "rest.csv"), "w", encoding="ascii") as f:
        f.writelines(lines[:90])
    done = tests.run("-c", "loop %s/rest.csv" % tests.dir)
    tests.check("loop from rest, not closed", done.returncode == 1 and "no cycle is closed" in done.stderr, tests.report(done))
    for begin in [i for i in range(24) if i not in (10, 22)]:  # a triangular drive, 24 rows a cycle, which may end behind a turning point: a loop with F = 20 + 5 dx on its flanks
        x = [4 * abs(((begin + i) / 24) % 1 - 0.5) - 1 for i in range(62)]
        F, stick = [], 0.0
        for now, before in zip(x, x[:1] + x):
            stick = max(-20.0, min(20.0, stick + 200 * (now - before)))
            F.append(stick + 5 * now)
        got, done = table(tests, "loop " + write(tests, "way.csv", list(zip(x, F))[10:]))
        tests.check("loop of a triangular drive, from row %d" % begin, len(got) in (1, 2) and
                    all(near(r["dxA"], 1e-6) and near(r["FA"], 25) for r in got), tests.report(done) + str(got))
    for name, rows, words in (("half a loop", turn[:31], "no cycle is closed: dx turns 0 times in 31 rows"),
                              ("three quarters", turn[:46], "no cycle is closed: dx turns "), ("one row", turn[:1], "no cycle is closed: dx turns 0 times in 1 row\n"),
                              ("rest", [(0, 0)] * 9, "no cycle is closed: dx turns 0 times in 9 rows")):
        done = tests.run("-c", "loop " + write(tests, "way.csv", rows))
        tests.check("loop of " + name, words in done.stderr and done.returncode == 1, tests.report(done))


def rows_compared(tests):
    """Rows of a file as a range: a row without a value is left out, and the others keep their line numbers."""
    path = os.path.join(tests.dir, "compared.csv")
    with open(path, "w", encoding="utf-8") as f:
        f.write("measured today\nLast [N];Tiefe [um];gut\n-20;1,21;ja\n;2;nein\n-80;3,09;ja\n-90;;nein\n-100;3,6;ja\n")
    told = harness.told(tests.run("--format=json", "-c", SCENE + "table dz for FN = 20 N, 80 N, 90 N, 100 N").stdout)
    computed = {row["FN"]: row["dz"] for row in told if "FN" in row}
    measured = {20: 1.21e-6, 80: 3.09e-6, 90: None, 100: 3.6e-6}
    rest = {k: v - computed[k] for k, v in measured.items() if v is not None}
    rms = math.sqrt(sum(v * v for v in rest.values()) / len(rest))
    for how, column in (("using FN=Last", "Tiefe"), ("using FN=1, dz=Tiefe", "dz")):
        done = tests.run("--format=json", "-c", SCENE + "table dz at %s %s" % (path, how))
        told = harness.told(done.stdout)
        rows = {row["FN"]: row for row in told if "FN" in row}
        compared = [row for row in told if row.get("event") == "compare"]
        ok = set(rows) == set(computed) and all(near(rows[k]["dz"], computed[k], 1e-12) for k in rows)
        ok = ok and all(rows[k].get("file " + column) is None if v is None else near(rows[k]["file " + column], v, 1e-12) for k, v in measured.items())
        ok = ok and len(compared) == 1 and compared[0]["rows"] == 3 and near(compared[0]["rms"], rms, 1e-9)
        ok = ok and near(compared[0]["worst"], rest[100], 1e-9) and compared[0]["line"] == 7 and compared[0]["row"] == 4
        ok = ok and "4 rows from line 3" in done.stderr and "1 row without a value left out" in done.stderr and "its sign is turned" in done.stderr
        tests.check("table at, " + how, ok, tests.report(done))
    with open(path, encoding="utf-8") as f:
        text = f.read().replace("-", "")
    with open(path, "w", encoding="utf-8") as f:
        f.write(text)
    done = tests.run("-c", "set format csv; " + SCENE + "plot dz for FN = 1 N .. 9 N over %s residuals using FN=Last to %s/rest.gp" % (path, tests.dir))
    with open(os.path.join(tests.dir, "rest.gp"), encoding="utf-8") as f:
        drawn = f.read()
    tests.check("residuals, using", done.returncode == 0 and "rms = %.6g nm over 3 rows" % (rms * 1e9) in drawn, tests.report(done) + drawn[:800])
    with open(path, "w", encoding="utf-8") as f:
        f.write("FN [N],dz [um]\n20,1.21\n")
    done = tests.run("-c", SCENE + "table dz at %s; plot dz for FN = 1 N .. 9 N over %s residuals to %s/rest.gp" % (path, path, tests.dir))
    with open(os.path.join(tests.dir, "rest.gp"), encoding="utf-8") as f:
        tests.check("over one row", " over 1 row, worst" in done.stdout and " over 1 row" in f.read().replace("over 1 rows", ""), tests.report(done))


def results_as_columns(tests):
    """A column named as a result is no range: an expression of that name takes the scene's, and a note says so."""
    path = write(tests, "results.csv", [], "FN [N],Fx [N],dz [um]\n20,3,1.2\n80,4,3\n")
    for what, notes in ("c(Fx)", ["Fx"]), ("dz", []), ("dz in nm, a", []), ("dz/a, 2*dz + c(Fx)*dz/a", ["dz", "dz", "Fx"]), ("c(FN/9)", []):
        done = tests.run("-c", SCENE + "table %s at %s" % (what, path))
        said = [line.split()[1] for line in done.stderr.splitlines() if "is the scene's here, not the column of" in line]
        tests.check("table at: notes on " + what, done.returncode == 0 and said == notes, tests.report(done))


def many_rows(tests):
    """A long file: the time per row does not grow with the number of rows."""
    path = write(tests, "long.csv", [(2 * math.sin(i / 60), 30 * math.sin(i / 60 + 0.3)) for i in range(100000)])
    rows, done = table(tests, "loop " + path)
    tests.check("loop of 100000 rows", len(rows) == 265 and all(near(r["dW"], math.pi * 60e-6 * math.sin(0.3), 1e-3) for r in rows), done.stderr)
    done = tests.run("--format=json", "-c", SCENE + "follow %s; dx" % path, timeout=20)
    tests.check("follow of 100000 rows", done.returncode == 0 and '"event":"compared"' in done.stdout, tests.report(done)[-500:])


def run(tests):
    tests.each([lambda room=room: room(tests) for room in (forms, words, polygons, sampled, drifting, wrong_way, noisy, much_noise, where_cycles_begin, rows_compared, results_as_columns, many_rows)])
