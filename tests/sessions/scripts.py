# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests the program in scripts: input files, options, output files, pictures, tables, lessons."""
import csv
import glob
import json
import math
import os
import re
import shutil
import subprocess
import xml.etree.ElementTree

import harness

SCENE = "material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"


def says(tests, name, done, out, err="", status=0):
    tests.check(name, harness.same_text(out, done.stdout) and done.stderr == err and done.returncode == status,
                harness.diff(out + err, done.stdout + done.stderr) + "\nexit %d" % done.returncode)


def jobs(tests):
    with tests.file("x = 1\n") as a, tests.file("x + 1\n") as b:
        says(tests, "files share a scene", tests.run(a, b), "x + 1 = 2")
        says(tests, "-f, -c and - in their order", tests.run("-f", a, "-c", "x = x + 1", "-c", "x", "-", input="x*2"),
             "x = 2\nx*2 = 4")
        says(tests, "FILE and -c in their order", tests.run(a, "-c", "x = x + 1", b, "-c", "x", "--", b),
             "x + 1 = 3\nx = 2\nx + 1 = 3")
        says(tests, "- is standard input", tests.run("-", input="3"), "3 = 3")
        says(tests, "source", tests.run("-c", "source %s; x" % a), "x = 1")
        says(tests, "source with quotation marks", tests.run("-c", 'source "%s" # a comment\nx' % a), "x = 1")
        says(tests, "quit ends all", tests.run("-c", "1; quit; 2", b), "1 = 1")
        says(tests, "quit in a script", tests.run("-c", "x = 2\nquit\nfoo", "-c", "bar"), "")
    says(tests, "--format=csv", tests.run("--format=csv", "-c", "1 mm, pi"), "1 mm [m],pi\n0.001,3.1415926535897931")
    says(tests, "--format=json", tests.run("--format=json", "-c", "0.5 MPa"),
         '{"name":"0.5 MPa","value":500000,"unit":"Pa"}')
    says(tests, "--format=text", tests.run("--format=text", "-c", "1 mm"), "1 mm = 1 mm")
    with tests.file("x = 1\nbogus\nx = 2; bogus; x = 3\nx\n") as path:
        for way in (["-c", "source %s; 2+2" % path], ["-c", "bogus; source %s; 2+2" % path]):
            done = tests.run("--keep-going", *way)
            tests.check("--keep-going through a script within a script: %s" % way[1][:6], done.stdout == "x = 3\n2+2 = 4\n" and done.returncode == 1 and
                        done.stderr.count("error:") == way[1].count("bogus") + 2, tests.report(done))
            done = tests.run(*way)
            tests.check("and without: %s" % way[1][:6], done.stdout == "" and done.returncode == 1 and done.stderr.count("error:") == 1, tests.report(done))
    done = tests.run("--keep-going", "-c", "1\nfoo\n2; bar; 3\n")
    tests.check("--keep-going", done.stdout == "1 = 1\n2 = 2\n3 = 3\n" and done.returncode == 1 and
                done.stderr.count("error:") == 2, tests.report(done))
    done = tests.run("-c", "1\nfoo\n2\n", "-c", "3")
    tests.check("the first error ends all", done.stdout == "1 = 1\n" and done.returncode == 1, tests.report(done))
    done = tests.run("--color=always", "-c", "foo")
    tests.check("--color=always", "\033[" in done.stderr, tests.report(done))
    done = tests.run("--color=never", "-c", "foo")
    tests.check("--color=never", "\033" not in done.stderr and "\033" not in tests.run("-c", "foo").stderr)
    done = tests.run("-c", "set timing on\npi")
    times = [float(line.split()[1]) for line in done.stderr.splitlines() if line.startswith("time: ")]
    tests.check("set timing on", done.stdout.startswith("pi = 3.14159") and times and 0 < min(times) <= max(times) < 1e4, tests.report(done))
    rc = os.path.join(tests.dir, "config", "fret")
    os.makedirs(rc)
    with open(os.path.join(rc, "fretrc"), "w", encoding="ascii") as f:
        f.write("set digits 2\n")
    says(tests, "a script does not read the start-up file",
         tests.run("-c", "pi", env={"XDG_CONFIG_HOME": os.path.dirname(rc)}), "pi = 3.14159")
    tests.check("--version", tests.run("--version").stdout.startswith("fret "))
    out = tests.run("-c", "demo").stdout
    tests.check("demo", "a = 300.925 um" in out and "dW = 6.5235 uJ" in out and "dx [um]" in out, out)
    tests.check("the loop in the terminal names its ordinate", "Fx [N]" in out, out)
    done = tests.run("-c", "c0 = 3 mm; k = 0.1; demo; k, c0; undo; k, c0; mu")
    tests.check("the tour begins anew, and undo brings back what was there", done.stdout.endswith(
        "k = 0.5\nc0 = 1 mm\nk = 0.1\nc0 = 3 mm\n") and "mu is not set" in done.stderr, tests.report(done))


def written(tests):
    where = os.path.join(tests.dir, "written")
    os.makedirs(where)
    done = tests.run("-c", SCENE + "step Fx=20 N\nhistory to h.csv\ntable dW(F) in uJ, c(F)/a for F = 10 N .. 30 N "
                     "steps 2 to t.csv\ntable x for x = 1 .. 3 steps 2 to t.txt\n"
                     "set format json; table x^2 for x = 1 .. 3 steps 2 to \"t 2.json\"\nhistory to h.json", cwd=where)
    tests.check("tables to files", done.returncode == 0 and not harness.told(done.stdout) and
                harness.reported(done.stderr, ["h.csv", "t.csv", "t.txt", "t 2.json", "h.json"]), tests.report(done))
    done = tests.run("-c", "table x for x = 1 .. 3 to t.txt", cwd=where)
    tests.check("a table over another", harness.reported(done.stderr, ["t.txt"], "overwrote"), tests.report(done))
    with open(os.path.join(where, "t.txt"), encoding="ascii") as f:
        tests.check("it is the new one", len(f.read().splitlines()) == 22)
    tests.run("-c", "table x for x = 1 .. 3 steps 2 to t.txt", cwd=where)
    done = tests.run("-c", "set report off; table x for x = 1 .. 3 steps 2 to t.txt", cwd=where)
    says(tests, "set report off", done, "")
    tests.check("no other files", sorted(os.listdir(where)) == ["h.csv", "h.json", "t 2.json", "t.csv", "t.txt"],
                str(os.listdir(where)))

    def rows(name):
        with open(os.path.join(where, name), encoding="ascii", newline="") as f:
            return list(csv.reader(f))

    def lines(name):
        with open(os.path.join(where, name), encoding="ascii") as f:
            return harness.told(f.read())

    tests.check("h.csv", rows("h.csv")[0] == ["FN [N]", "dz [m]", "Fx [N]", "dx [m]", "W [J]"] and
                len(rows("h.csv")) == 3 and rows("h.csv")[2][2] == "20", str(rows("h.csv")))
    tests.check("t.csv", rows("t.csv")[0] == ["F [N]", "dW(F) [uJ]", "c(F)/a"] and
                [row[0] for row in rows("t.csv")[1:]] == ["10", "20", "30"], str(rows("t.csv")))
    tests.check("JSON to a file", [row["x^2"] for row in lines("t 2.json")] == [1, 4, 9])
    tests.check("history as JSON", [row["Fx"] for row in lines("h.json")] == [0, 20], str(lines("h.json")))
    with open(os.path.join(where, "t.txt"), encoding="ascii") as f:
        tests.same("t.txt", "            x          x (2)\n            1              1\n            2              2\n"
                   "            3              3\n", f.read())
    done = tests.run("--format=json", "-c", 'x = 1\ntable x, x^2 for x = 1 .. 3 steps 2\n"')
    tests.check("rows are on standard output, errors are not",
                [row["x"] for row in harness.told(done.stdout)] == [1, 2, 3] and "error:" in done.stderr)
    quoted = tests.run("--format=csv", "-c", "max(1 mm, 2 mm), 3").stdout.splitlines()
    tests.check("CSV fields with commas are quoted", next(csv.reader(quoted[:1])) == ["max(1 mm, 2 mm) [m]", "3"],
                str(quoted))


def pictures(tests):
    where = os.path.join(tests.dir, "pictures")
    os.makedirs(where)
    script = SCENE + "cycle FA=20 N FNA=30 N phase=90 deg\n" \
        "plot loop to a.png\nplot loop to a.svg\nplot loop to a.pdf\nplot loop to a.gp\n" \
        "plot dW(F) in uJ for F = 1 N .. 39 N log to \"b b.svg\"\n" \
        "reset; press FN=100 N\nplot a, dz for FN = 1 N .. 100 N with mu = 0.1, 0.2 to 'c.svg\n"
    done = tests.run("-c", script, cwd=where)
    tests.check("plots to files", done.returncode == 0 and not done.stdout and
                harness.reported(done.stderr, ["a.png", "a.svg", "a.pdf", "a.gp", "b b.svg", "'c.svg"]), tests.report(done))
    heads = {"a.png": b"\x89PNG", "a.svg": b"<?xml", "a.pdf": b"%PDF", "a.gp": b"# made by fret", "b b.svg": b"<?xml",
             "'c.svg": b"<?xml"}
    for name, head in heads.items():
        path = os.path.join(where, name)
        data = open(path, "rb").read() if os.path.exists(path) else b""
        tests.check("picture " + name, data.startswith(head) and len(data) > 500, "%d bytes" % len(data))
        if name.endswith(".svg") and data:
            text = "".join(xml.etree.ElementTree.fromstring(data).itertext())
            label = "δx [" if name == "a.svg" else "F [N]" if name == "b b.svg" else "FN [N]"
            tests.check("%s shows its label" % name, label in text, text[:500])
    tests.check("nothing else is left", sorted(os.listdir(where)) == sorted(heads), str(os.listdir(where)))
    if shutil.which("gnuplot"):
        again = subprocess.run(["gnuplot", "-e", "set terminal dumb", "a.gp"], cwd=where, capture_output=True, text=True)
        tests.check("a.gp runs", again.returncode == 0 and "+----" in again.stdout, again.stdout + again.stderr)
    done = tests.run("-c", "set plot 60x20\n" + SCENE + "plot dW(F) in uJ for F = 1 N .. 39 N")
    shown = done.stdout.splitlines()
    tests.check("set plot 60x20", done.returncode == 0 and 15 <= len(shown) <= 20 and
                40 <= max(map(len, shown)) <= 60 and any("F [N]" in line for line in shown), tests.report(done))
    tests.check("a plot in the terminal names its ordinate", "dW(F)" in done.stdout and "[uJ]" in done.stdout,
                tests.report(done))
    done = tests.run("-c", SCENE + "plot c(F)/a, Fx(dx(F))/F for F = 1 N .. 39 N with mu = 0.4, 0.5")
    tests.check("curves are named", done.returncode == 0 and "mu = 0.4" in done.stdout and "mu = 0.5" in done.stdout,
                tests.report(done))
    done = tests.run("-c", "plot x for x = 1 .. 2 with y = 1, 2")
    tests.check("a free second variable", done.returncode == 0 and "y = 2" in done.stdout, tests.report(done))
    done = tests.run("-c", "plot 0*x for x = 1 .. 2")
    tests.check("a flat curve", done.returncode == 0 and not done.stderr, tests.report(done))
    many = SCENE + "cycle FA=20 N times 3 steps 100000\nplot loop to many.svg"
    done = tests.run("-c", many, cwd=where)
    size = os.path.getsize(os.path.join(where, "many.svg")) if not done.returncode else 0
    tests.check("300000 points are thinned", 1000 < size < 400000, "%d bytes\n%s" % (size, tests.report(done)))


def read_tables(tests):
    """A gap and a history from CSV give the same answers as a formula and typed steps; errors name what is wrong."""
    gap = "r [mm],f [um]\n" + "".join("%.17g,%.17g\n" % (1e-2 * i, (1e-2 * i) ** 2 * 50) for i in range(101))
    names = "a, dz, c, dx, dW(20 N), g(0.5 mm)"
    with tests.file(gap) as path:
        by_table = tests.run("-c", SCENE + "k = 0; step Fx=20 N\ngeometry file %s\n%s" % (path, names))
        by_name = tests.run("-c", SCENE + "step Fx=20 N\n" + names)
        tests.check("geometry file", by_table.stdout == by_name.stdout and by_name.stdout.count("=") == 6 and
                    not by_table.stderr, tests.report(by_table))
        done = tests.run("-c", SCENE + "geometry file %s; press FN=1 MN" % path)
        tests.check("a table too short", "FN = 1 MN cannot be carried: the gap supports contact radii up to 1 mm"
                    in done.stderr and done.returncode == 1, tests.report(done))
    rounded = "r [mm],f [um]\n" + "".join("%.7g,%.6g\n" % (i / 1e4, (i / 1e4) ** 2 * 100 / 3) for i in range(10001))
    rippled = SCENE + "c0 = 1 mm; k = -0.9; geometry file %s" # as the formula's gap is, but for the rounding of its rows
    with tests.file(rounded) as path:
        done = tests.run("-c", rippled % path)
        tests.check("a profile that ripples", "begins to fall" in done.stderr and "it has risen again" in done.stderr and
                    "`geometry file FILE smooth`" in done.stderr and done.returncode == 1, tests.report(done))
        done = tests.run("-c", rippled % path + " smooth; a, dz")
        exact = tests.run("-c", SCENE + "c0 = 1 mm; k = -0.9; geometry sphere R=15 mm; a, dz")
        tests.check("a profile that ripples, smooth", done.stdout == exact.stdout and done.stdout.count("=") == 2,
                    tests.report(done))
    for text, message in (("r [mm],f [um]\n0,0\n1,5\n2,1\n3,9\n", "is where g(x) begins to fall: the contact would not be a disc\n"),
                          ("r [mm],f [um]\n0,0\n2,5\n1,9\n", ":4: r = 1 mm is out of order: radii must start at 0 and grow (smooth"),
                          ("r [mm],f [um]\n0,0\n", " has one row: a gap needs two or more"),
                          ("r,f\n0,0\n2,5\n", "column r is a number: it needs the unit of a length in the header, or here: using r=COLUMN UNIT"),
                          ("r [mm],q [N]\n0,0\n", "has no column f: its columns are r, q"),
                          ("r [mm],f [um]\n0,0\n1,nan\n", " has one row: a gap needs two or more"),
                          ("r [mm],f [um]\n0,0,7\n", ":2: more than 2 fields"),
                          ("r [mm],f [furlong]\n0,0\n", "unknown unit 'furlong'"),
                          ("r [mm],f [um],f/um\n0,1,1\n", " has two columns f: rename one"),
                          ("r [mm],f [um],g/um,g/um\n0,1,1,1\n", "f(0) = 1 um must be 0"),
                          ("12\n", "has no column r: it has no line of names above its rows; say which it is: using r=NUMBER UNIT"),
                          ("r [mm],f [um]\n", "holds no rows of numbers")):
        with tests.file(text) as path:
            done = tests.run("-c", SCENE + "geometry file %s" % path)
            tests.check("geometry file: " + message, message in done.stderr and done.returncode == 1, tests.report(done))
    with tests.file("FN [N],Fx [N]\n120,15\n80,10\n") as path:
        says(tests, "follow", tests.run("-c", SCENE + "follow %s; FN, Fx, W-0.5*W" % path),
             tests.run("-c", SCENE + "step FN=120 N Fx=15 N; step FN=80 N Fx=10 N; FN, Fx, W-0.5*W").stdout)
    with tests.file("dz [um],dx [um]\n4,0.2\n3,-0.1\n") as path:
        says(tests, "follow by displacement", tests.run("-c", SCENE + "follow %s; dz, dx" % path), "dz = 3 um\ndx = -100 nm")
    with tests.file("FN [N],Fx [N]\n120,15\n80,60\n") as path:
        done = tests.run("--keep-going", "-c", SCENE + "follow %s\nFN, Fx" % path)
        tests.check("follow all or nothing", done.stdout == "FN = 100 N\nFx = 0 N\n" and "(row 2 of " in done.stderr,
                    tests.report(done))
    # more rows than are processed together, against single steps
    rows = ["%.6f,%.6f" % (100 + 10*math.sin(0.013*i), 15*math.sin(0.37*i) + 8*math.sin(0.0113*i)) for i in range(9000)]
    steps = "\n".join("step FN=%s N Fx=%s N" % tuple(row.split(",")) for row in rows)
    with tests.file("FN [N],Fx [N]\n" + "\n".join(rows)) as path:
        script = SCENE + "set digits 17\n%s\nFN, dz, Fx, dx, W, c\n"
        with tests.file(script % steps) as one, tests.file(script % ("follow " + path)) as many:
            done = tests.run(many)
            tests.check("follow many rows", done.stdout == tests.run(one).stdout and done.stdout.count("=") == 6, tests.report(done))
    for bad in 4096, 4097, 8999:
        with tests.file("FN [N],Fx [N]\n" + "\n".join(rows[:bad - 1] + ["100,50"] + rows[bad:])) as path:
            done = tests.run("--keep-going", "-c", SCENE + "step Fx=3 N; follow %s\nFN, Fx" % path)
            tests.check("follow many rows, a bad one", done.stdout == "FN = 100 N\nFx = 3 N\n" and
                        "gross slip" in done.stderr and "(row %d of " % bad in done.stderr, tests.report(done))
    bare = SCENE.rsplit(";", 1)[0]
    with tests.file("FN [N],Fx [N]\n100,0\n80,10\n") as path:
        says(tests, "follow presses", tests.run("-c", bare + "\nfollow %s; FN, Fx" % path), "FN = 80 N\nFx = 10 N")
        says(tests, "follow presses, which tells the friction",
             tests.run("-c", bare + "\nmu := 0.4 - FN/(1 kN); follow %s; mu; W/(W at mu=0.3)" % path), "mu = 0.3\nW/(W at mu=0.3) = 1")
    with tests.file("FN [N],Fx [N]\n100,0\n80,60\n") as path:
        done = tests.run("--keep-going", "-c", bare + "\nfollow %s\na" % path)
        tests.check("follow from nothing, all or nothing", "there is no load yet" in done.stderr and not done.stdout,
                    tests.report(done))
    with tests.file("FN [N],Fx [N]\n100,5\n") as path:
        done = tests.run("-c", bare + "\nfollow %s" % path)
        tests.check("follow must begin with a press", "begin with a row that presses (FN > 0, Fx = 0)" in done.stderr,
                    tests.report(done))
    for text, message in (("a,b\n1,2\n", "has no column dx: its columns are a, b, by line 1, \"a,b\"; say which it is: using dx=COLUMN (FN,Fx or dz,dx are followed; dx,Fx or drig,Fx compared)"),
                          ("FN,Fx\n1,2\n", "column FN is a number: it needs the unit of a force in the header, or here: using FN=COLUMN UNIT\n"),
                          ("FN [N],Fx [mm]\n1,2\n", "column Fx is a length: it needs the unit of a force in the header\n"),
                          ("dz [N],dx [um]\n1,2\n", "column dz is a force: it needs the unit of a length in the header\n"),
                          ("dz [um],dx []\n1,2\n", "column dx is a number: it needs the unit of a length in the header, or here: using dx=COLUMN UNIT\n")):
        with tests.file(text) as path:
            done = tests.run("-c", SCENE + "follow %s" % path)
            tests.check("follow: " + message, message in done.stderr and done.returncode == 1, tests.report(done))


def histories(tests):
    """A file written by `history` has forces and displacements. The forces drive, or dx if it is held or the contact slides; rows that
    do not agree are reported."""
    where = os.path.join(tests.dir, "histories")
    os.makedirs(where)
    bare = SCENE.rsplit(";", 1)[0]
    asked = "FN, dz, Fx, dx, W, U"
    loads = ("press FN=100 N; step Fx=20 N; step FN=80 N Fx=10 N; step dx=5 um; step FN=50 N; cycle FA=3 N times 2; step dz=-1 um; "
             "step FN=30 N; step dx+=-1 um", "press FN=100 N", "press a=0.2 mm; cycle dxA=2 um steps 30; step dz+=0.1 um",
             "press dz=3 um; step Fx=10 N; step FN+=20 N; step FN+=-40 N; step Fx=0")
    scenes = ("", "; c0=1 mm; k=0.4", "; geometry exact-sphere R=10 mm", "; geometry flat-cone b=0.1 mm slope=0.01; c0=1 mm; k=-0.3")

    def one(scene, load, form):
        path = os.path.join(where, "%d-%d.%s" % (scenes.index(scene), loads.index(load), form))
        begin = "%s%s; %s" % (bare, scene, "set report off")
        done = tests.run("--format=json", "-c", "%s; %s; %s; history to %s; reset; follow %s; %s" % (begin, load, asked, path, path, asked))
        found = harness.printed_values(done.stdout)
        first, again = found[:6], found[6:]
        near = len(again) == 6 and all(abs(x - y) <= (1e-3 if form == "txt" else 1e-9) * max(abs(x), small)
                                       for x, y, small in zip(first, again, (1, 1e-6, 1, 1e-6, 1e-6, 1e-6)))
        tests.check("history followed: %s; %s, %s" % (scene, load, form), near, "%s\n%s\n%s" % (first, again, tests.report(done)))
        if ";" not in load:
            return
        done = tests.run("--keep-going", "-c", "%s; press FN=3 N; mu = 0.39; E0 = 200 GPa; follow %s; FN" % (begin, path))
        tests.check("a history of another scene: %s; %s" % (scene, load), " of the file differs " in done.stderr and done.returncode == 0, tests.report(done))
    tests.each([lambda s=s, l=l, f=f: one(s, l, f) for s in scenes for l in loads for f in ("csv", "json", "txt")])
    with tests.file("FN [N],Fx [N],dz [um],dx [um]\n100,0,3.4829098839413082,0\n100,50,3.4829098839413082,1\n") as path:
        done = tests.run("--format=json", "-c", bare + "\nfollow %s; Fx(1 um)" % path)
        told = [row for row in harness.told(done.stdout) if row.get("event") == "compared"]
        tests.check("a row that no step leads to", [row["of"] for row in told] == ["Fx"] and
                    abs(told[0]["rms"] - (50 - harness.printed_values(done.stdout)[0])/2**0.5) < 1e-9, tests.report(done))
    oblique = "press FN=100 N; step dz+=0.1 um dx=0.3 um"
    with tests.file("") as path:
        done = tests.run("--format=json", "-c", "%s; %s; W; history to %s.csv; reset; follow %s.csv; W" % (bare, oblique, path, path))
        first, again = harness.printed_values(done.stdout)
        tests.check("a path that no pair tells is close", 0 < abs(again/first - 1) < 0.01, tests.report(done))
        os.remove(path + ".csv")


def table_rows(done):
    """The heads and rows of a CSV table, as text."""
    rows = list(csv.reader(done.stdout.splitlines()))
    return rows[:1], rows[1:]


def alike(a, b):
    return abs(a - b) <= 2e-15 * abs(b)


def long_tables(tests):
    """Tables longer than the 256 rows that are evaluated at once."""
    power = "material E0=210 GPa nu=0.3 k=0.3 c0=1 mm; geometry power n=2.5 A=50 m^-1.5; friction 0.4; press FN=100 N\n"
    for name, scene in (("sphere", SCENE), ("graded", power)):
        functions = "dW(F), c(F), dx(F), a(F), dz(F), Fx(F*1e-8 m/N), f(F*1 mm/N)"
        done = tests.run("--format=csv", "-c", scene + "table %s for F = 1 N .. 39 N steps 699" % functions)
        rows = table_rows(done)[1]
        singly = tests.run("--format=json", input=scene + "\n".join(
            ", ".join(f.strip().replace("F*", row[0] + " N*").replace("(F)", "(%s N)" % row[0])
                      for f in functions.split(", ")) for row in rows))
        values = harness.printed_values(singly.stdout)
        got = [float(cell) for row in rows for cell in row[1:]]
        worst = [(g, v) for g, v in zip(got, values) if not alike(g, v)]
        tests.check("700 rows as one by one, " + name, len(rows) == 700 and len(got) == len(values) == 4900 and not worst,
                    str(worst[:5]) + tests.report(done)[:500])
    sums = "x^2, -x/3, min(x,300)+max(x,2), sqrt(abs(x-500)), 2^-x*x, FN/x in mN, 7, 1+(2-(3*(x-(4-x)))), pi*dW(20 N)*x"
    done = tests.run("--format=csv", "-c", SCENE + "table %s for x = 1 .. 1025 steps 1024" % sums)
    loss = harness.printed_values(tests.run("--format=json", "-c", SCENE + "dW(20 N)").stdout)[0]
    rows = [[float(cell) for cell in row] for row in table_rows(done)[1]]
    wrong = [row for row in rows if not all(map(alike, row[1:], (
        row[0] ** 2, -row[0] / 3, min(row[0], 300) + max(row[0], 2), abs(row[0] - 500) ** 0.5, 2.0 ** -row[0] * row[0],
        1e5 / row[0], 7, 15 - 6 * row[0], 3.141592653589793 * loss * row[0])))]
    tests.check("1025 rows of expressions", len(rows) == 1025 and rows[1024][0] == 1025 and not wrong, str(wrong[:3]))
    deep = "x+(" * 49 + "x" + ")" * 49
    done = tests.run("--format=csv", "-c", "table %s, 1 for x = 1 .. 600 steps 599" % deep)
    tests.check("a deeply nested expression", [float(row[1]) for row in table_rows(done)[1]] ==
                [50.0 * (i + 1) for i in range(600)], tests.report(done)[:300])
    done = tests.run("--format=csv", "-c", SCENE + "table x*F/(1 N), a(F)/x for x = 1 .. 600 steps 599 with F = 1 N, 2 N")
    rows = table_rows(done)[1]
    tests.check("curves of 600 rows", len(rows) == 1200 and
                all(float(row[2]) == (1 + i // 600) * (1 + i % 600) and row[1] == str(1 + i // 600) for i, row in
                    enumerate(rows)) and alike(float(rows[1199][3]), float(rows[600][3]) / 600), tests.report(done)[-300:])
    done = tests.run("--format=csv", "-c", SCENE + "table a(F) for F = 1 N .. 600 N steps 599 with k = 0, 0.5")
    rows = table_rows(done)[1]
    tests.check("a curve that is a gap", len(rows) == 1200 and all((row[2] == "") == (row[1] == "0.5") for row in rows) and
                done.returncode == 0 and done.stderr.startswith("note: some values are missing: c0 is not set") and
                done.stderr.endswith("(at F = 1 N, k = 0.5)\n"), tests.report(done)[-500:])


def gaps_in_tables(tests):
    """A value that does not exist is a gap, also in the middle of a block, and one note says why."""
    for expression, sweep, gap, why in (
            ("dW(F)", "F = 1 N .. 71 N steps 1400", lambda i: i > 780, "gross slip"),
            ("F, c(F)", "F = 0.05 N .. 60.05 N steps 1200", lambda i: i >= 800, "gross slip"),
            ("a(100 N-F)", "F = 1 N .. 1001 N steps 1000", lambda i: i >= 100, "(at F = "),
            ("1/(x-699)", "x = 0 .. 1000 steps 1000", lambda i: i == 699, "division by zero (at x = 699)"),
            ("x, sqrt(511.5-x)", "x = 0 .. 1000 steps 1000", lambda i: i >= 512,
             "square root of a negative number is not real (at x = 512)"),
            ("(256-x)^0.5", "x = 0 .. 1000 steps 1000", lambda i: i >= 257, "no real power 0.5 (at x = 257)"),
            ("exp(x)", "x = 0 .. 1000 steps 1000", lambda i: i >= 710, "too large for double precision (at x = 710)"),
            ("log(700-x)", "x = 0 .. 1000 steps 1000", lambda i: i >= 700, "log is not defined there (at x = 700)"),
            ("beta(300-x,2)", "x = 0 .. 1000 steps 1000", lambda i: i >= 300,
             "beta needs two positive arguments in range (at x = 300)")):
        done = tests.run("--format=csv", "-c", SCENE + "table %s for %s" % (expression, sweep))
        rows = done.stdout.splitlines()[1:]
        steps = int(sweep.split()[-1])
        wrong = [i for i, row in enumerate(rows) if (row.split(",")[-1] == "") != gap(i)]
        tests.check("table %s for %s" % (expression, sweep),
                    len(rows) == steps + 1 and not wrong and why in done.stderr and done.returncode == 0 and
                    len([line for line in done.stderr.splitlines() if line.startswith("note:")]) == 1,
                    "%d rows, wrong at %s\n%s" % (len(rows), wrong[:5], tests.report(done)[-600:]))


def failing_tables(tests):
    """A wrong dimension ends a table: the rows before are written, and the message names the row."""
    for expression, sweep, rows, where in (
            ("(2 m)^x in m", "x = 1 .. 2 steps 1000", 1, "cannot be shown in m (at x = 1.001)"),
            ("x + 1 mm", "x = 0 .. 1 N steps 1000", 0, "cannot add a length (1 mm) to a force (x) (at x = "),
            ("x in mm", "x = 0 .. 1 N steps 1000", 0, "x is a force: it cannot be shown in mm"),
            ("c(x)", "x = 0 .. 1 m steps 1000", 0, "c(F) takes a force, not a length (x)")):
        done = tests.run("--format=csv", "-c", SCENE + "table %s for %s" % (expression, sweep))
        got = max(len(done.stdout.splitlines()) - 1, 0)
        tests.check("table %s for %s" % (expression, sweep), got == rows and where in done.stderr and done.returncode == 1,
                    "%d rows\n%s" % (got, tests.report(done)[-600:]))


def digits(tests):
    """Numbers in tables are those of printf."""
    sweeps = ("x, -x for x = 1e-30 .. 1e30 steps 3000 log", "x for x = -2 .. 2 steps 1000", "x for x = 0 .. 1e17 steps 997",
              "x+0.5, x*1e5+0.5 for x = 0 .. 700 steps 700", "10^x, 10^x-10^(x-17) for x = -40 .. 40 steps 80",
              "x for x = 1e-308 .. 1e-300 steps 300", "x for x = 0.99999949 .. 0.99999951 steps 400")
    for sweep in sweeps:
        exact = [row for row in table_rows(tests.run("--format=csv", "-c", "table " + sweep))[1]]
        wrong = [cell for row in exact for cell in row if cell != "%.17g" % float(cell)]
        tests.check("17 digits: " + sweep, len(exact) > 80 and not wrong, str(wrong[:5]))
        for n in (1, 2, 6, 15, 16):
            shown = tests.run("-c", "set digits %d; table %s" % (n, sweep)).stdout.splitlines()[1:]
            want = [["%.*g" % (n, float(cell)) for cell in row] for row in exact]
            wrong = [pair for pair in zip(want, map(str.split, shown)) if pair[0] != pair[1]]
            tests.check("%d digits: %s" % (n, sweep), len(shown) == len(exact) and not wrong, str(wrong[:5]))


def shown_scenes(tests):
    """The output of `show` makes the same scene again, to the last digit."""
    scene = ("material E0=210.123456789 GPa nu=1/3 k=-0.1 c0=1.1 um; second E0=1e11/3*1 Pa nu=0; friction 1/3\n"
             "geometry sum 2:50.00000001 m^-1, 4.5:2e6/7*1 m^-3.5; press FN=100/3*1 N; x = -1/3*1 m\n"
             "step Fx+=-1/7*1 N dz+=1 nm; cycle FA=1.23456789 N FNA=1 N phase=33.3 deg times 3\n")
    ask = "\nset format json\na, dz, W, Fx, x, mu, E0_2\nshow"
    shown = tests.run("-c", scene + "show").stdout
    first, second = tests.run("-c", scene + ask), tests.run("-c", shown + ask)
    tests.check("show keeps every digit", first.stdout and first.stdout == second.stdout and "E0=210.123456789 GPa" in shown,
                shown + first.stdout + second.stdout)


def waiting_steps(tests):
    """Steps that are run only when a question comes give the answers of steps run one by one."""
    steps = ["step dx=1 um", "step dx=-0.3 um", "step dx=0.4 um", "step Fx=3 N", "step dx=0.2 um", "step dx+=0.1 um",
             "step FN=80 N", "step dx=-3 um", "k = 0.2; c0 = 1 mm", "c0 = 1 mm; k = 0.2", "step dx=0.5 um",
             "cycle dxA=0.4 um", "step dx=1 um", "press FN=50 N", "step dx=1 um", "step dx=-1 um", "mu = 0.2",
             "step dx=0", "mu = -1", "step Fx=1000 N", "step dx=0.1 um steps 3"]
    ask = "Fx, dx, c, W, U, kt, FN"
    asked = tests.run("--keep-going", "-c", SCENE + "\n".join(s + "\n" + ask for s in steps) + "\nhistory")
    waited = tests.run("--keep-going", "-c", SCENE + "\n".join(steps) + "\n" + ask + "\nhistory")
    n = len(waited.stdout.splitlines())
    tests.check("steps that wait", n > 10 and asked.stdout.splitlines()[-n:] == waited.stdout.splitlines(),
                harness.diff("\n".join(asked.stdout.splitlines()[-n:]), waited.stdout))
    errors = [line for line in waited.stderr.splitlines() if "error:" in line]
    tests.check("errors come at their lines", [line.split(":")[1] for line in errors] ==
                ["10", "20", "21"], waited.stderr)
    done = tests.run("-c", SCENE.replace("friction 0.4; ", "") + "Fx\nstep dx=1 um")
    tests.check("a step needs friction at once", done.stdout == "Fx = 0 N\n" and done.returncode == 1 and
                done.stderr.startswith("-c:3:9: error: mu is not set"), tests.report(done))


def taken_back(tests):
    """For undo a script (`source`) or a history (`follow`) is one change; a script that fails has made the changes before its error."""
    with tests.file("k = 0.3, c0 = 1 mm\nx = 5\nmu = 0.2\npress FN=30 N\nundo\nx = 6\n") as script, \
            tests.file("foo = 1\nmu = 7 N\n") as bad, tests.file("FN [N],Fx [N]\n100,0\n100,10\n90,5\n") as rows:
        done = tests.run("-c", SCENE + "source %s\nk, x, mu, FN\nundo\nk, mu, FN\nx" % script)
        tests.check("undo takes a script back", done.stdout == "k = 0.3\nx = 6\nmu = 0.2\nFN = 100 N\nk = 0\nmu = 0.4\n"
                    "FN = 100 N\n" and "unknown name 'x'" in done.stderr, tests.report(done))
        done = tests.run("--keep-going", "-c", "friction 0.4\nsource %s\nfoo\nmu\nundo\nmu\nfoo" % bad)
        tests.check("undo takes a failed script back", done.stdout == "foo = 1\nmu = 0.4\nmu = 0.4\n" and
                    "unknown name 'foo'" in done.stderr, tests.report(done))
        done = tests.run("-c", SCENE + "step Fx=20 N\nfollow %s\nFN, Fx\nundo\nFN, Fx\nundo\nFx" % rows)
        says(tests, "undo takes a history back", done, "FN = 90 N\nFx = 5 N\nFN = 100 N\nFx = 20 N\nFx = 0 N")
    many = 300
    done = tests.run("-c", SCENE + "".join("step Fx=%d N\nx = %d\n" % (i % 30, i) for i in range(many)) +
                     "undo\n" * (2 * many - 7) + "Fx, x")
    says(tests, "many levels of undo", done, "Fx = 3 N\nx = 2")
    done = tests.run("-c", SCENE + "x = 1\n" + "".join("mu = 0.3\nmu = 0.4\n" for i in range(1000)) + "undo\n" * 700 +
                     "mu, x")
    says(tests, "700 levels of undo", done, "mu = 0.4\nx = 1")


def many_variables(tests):
    count = 3000
    script = "".join("v%d = %d\n" % (i, i) for i in range(count)) + "v7 = v7 + 1\n"
    says(tests, "3000 variables", tests.run("-c", script + "v0, v7, v%d, v1234 - v1233" % (count - 1)),
         "v0 = 0\nv7 = 8\nv%d = %d\nv1234 - v1233 = 1" % (count - 1, count - 1))


def demos(tests):
    """Each lesson is a transcript that `demo` plays, drawings included; the scene stays, but settings and names are the user's."""
    paths = sorted(glob.glob(os.path.join(harness.ROOT, "scripts", "demos", "*.txt")))
    tests.check("there are demos", len(paths) > 10)
    listed = tests.run("-c", "show demos").stdout.splitlines()
    figures_of_paper = glob.glob(os.path.join(harness.ROOT, "scripts", "paper", "*.txt"))
    tests.check("show demos fits a terminal", max(map(len, listed)) <= 80, max(listed, key=len))
    tests.check("show demos", len(listed) == len(paths) + len(figures_of_paper), "\n".join(listed))
    jobs = [lambda p=path, row=row, after=after: lesson(tests, p, row, after.split()[0])
            for path, row, after in zip(paths, listed, [*listed[1:len(paths)], "-"])]
    tests.each(jobs + [lambda: lessons_aside(tests), lambda: path_of_lessons(tests, listed), lambda: own_lessons(tests)])


def path_of_lessons(tests, listed):
    """`help teaching` lists all lessons."""
    names = [row.split()[0] for row in listed]
    order = ["pressing", "sticking", "sliding", "loop", "memory", "energy", "grading", "shapes", "swinging", "damper"]
    tests.check("the lessons' order", names[1:11] == order, str(names))
    lessons_of = names[1:names.index("fig04")]
    page = tests.run("-c", "help teaching").stdout
    titles = re.findall(r"(?m)^(\w+)  +\S", page)
    tests.check("the teacher's page", titles == lessons_of and page.count("\n    The paper: (") == len(titles) and
                "    How large is c/a at 36 N?\n        c(36 N)/a = 0.464159\n" in page, page)


MISTAKEN = """# A lesson with mistakes
# which are told
materal steel
material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N
ask "How wide?" = b within 5 %
ask "How wide?" = a
ask "Where?" of "here", "there" = 3
step Fx=20 N # refused
step Fx=99 N; Fx
step Fx=99 N # refused
# bell \a
plot presure
quit
"""
MISTAKES = ((3, "unknown command 'materal'"), (5, "b is no parameter"), (6, "expected within 5 %"), (7, "there are 2 choices"), (8, "this is not refused, as `# refused` says"),
            (9, "Fx = 99 N exceeds mu*FN = 40 N"), (11, "a character that cannot be shown"), (12, "there is no figure 'presure'"), (13, "a lesson does not end the session"))


def own_lessons(tests):
    """A lesson in a file of the user: played, or refused with the mistakes of each line; and written to a page."""
    ball = "A ball\n\n# How wide?\nmaterial steel; geometry sphere R=10 mm; friction 0.4\npress FN=100 N\nask \"a?\" = a within 5 % hint \"Hertz <&>\"\nplot pressure\nstep Fx=50 N # refused\n"
    as_transcript = "A ball\n\n" + "".join("fret> %s\n%s" % (line, "a = 3 um\n" if line == "press FN=100 N" else "") for line in ball.split("\n")[2:-1])
    said = []
    for text in (ball, as_transcript, ball.replace("\n", "\r\n"), "\ufeff" + ball, ball.replace("press ", "press \\\n   ")):
        with tests.file(text, ".txt") as path:
            done = tests.run("-c", "mu = 0.1; demo %s; undo; mu" % path)
            said.append(re.sub("press +", "press ", done.stdout))
            tests.check("a lesson from a file", done.returncode == 0 and "a?\na = 186.626 um\n" in done.stdout and done.stdout.endswith("mu = 0.1\n") and
                        "exceeds mu*FN" in done.stderr and said[-1] == said[0], tests.report(done))
    with tests.file(MISTAKEN, ".txt") as path:
        done = tests.run("-c", "mu = 0.1; demo %s" % path)
        found = re.findall(r"(?m)^%s:(\d+):\d+: error: (.*)$" % re.escape(path), done.stderr)
        tests.check("mistakes of a lesson, line by line", done.returncode == 1 and not done.stdout and len(found) == len(MISTAKES) and
                    all(int(n) == line and told.startswith(words) for (n, told), (line, words) in zip(found, MISTAKES)) and
                    "9 mistakes in %s: it is not played" % path in done.stderr and
                    ":13:1: error: a lesson does not end" in done.stderr, tests.report(done))
        done = tests.run("--format=json", "-c", "demo " + path)
        rows = [row for row in map(json.loads, done.stdout.splitlines()) if row.get("file") == path]
        tests.check("mistakes in JSON", [row["line"] for row in rows] == [line for line, _ in MISTAKES], tests.report(done))
    for name, text, want in (("empty", "", "holds no statement"), ("words alone", "A title\n# words\n", "holds no statement"), ("no title", "fret> 1 + 1\n", "begins with its title"),
                             ("bytes", bytes(range(256)) * 40, "mistakes"), ("a long line", "T\n# %s\n1\n" % ("x" * 500), "at most 400 bytes"),
                             ("a long statement", "T\n%s\n" % ("x" * 500), "error: 1 mistake in"),
                             ("many mistakes", "T\n" + "foo(\n" * 1000, "20 mistakes or more")):
        with tests.file(text, ".txt") as path:
            done = tests.run("-c", "demo " + path)
            tests.check("a lesson of %s is refused" % name, done.returncode == 1 and want in done.stderr and not done.stdout, tests.report(done))
    for name, want in (("./none.txt", "No such file"), (".", "Is a directory"), ("pressing.x", "No such file")):
        done = tests.run("-c", "demo " + name)
        tests.check("a lesson at " + name, done.returncode == 1 and want in done.stderr, tests.report(done))
    picture = os.path.join(tests.dir, "captioned.gp")
    with tests.file("A picture\n%s\nset plot caption on\nplot pressure to %s\n" % (ball.split("\n")[3] + "; press FN=100 N", picture), ".txt") as path:
        done = tests.run("-c", "demo " + path)
        tests.check("a lesson that draws a picture with a caption", done.returncode == 0 and os.path.exists(picture), tests.report(done))
    circle = os.path.join(tests.dir, "circle.txt")
    with open(circle, "w", encoding="ascii") as f:
        f.write("A circle\ndemo %s\n" % circle)
    done = tests.run("-c", "demo " + circle)
    tests.check("a lesson that plays itself", done.returncode == 1 and "1 mistake in" in done.stderr, tests.report(done))
    with tests.file(ball, ".txt") as path:
        page = os.path.join(tests.dir, "ball.html")
        done = tests.run("-c", "mu = 0.1; demo %s to %s; mu; demo %s to ball.pdf" % (path, page, path))
        tests.check("a lesson to a page leaves the scene", done.stdout == "mu = 0.1\n" and "a handout goes to a page: FILE.html" in done.stderr, tests.report(done))
        text = handout(tests, "a lesson from a file", page, 1, 1)
        tests.check("what a page shows", "# How" not in text and "fret> press FN=100 N" in text and "error: Fx = 50 N exceeds" in text and "+----" not in text and
                    text.index("a?") < text.index("Answers") < text.index("a = 186.626 um"), text)
    for path in sorted(glob.glob(os.path.join(harness.ROOT, "scripts", "demos", "*.txt"))):
        name = re.sub(r"^\d+-", "", os.path.basename(path)[:-4])
        page = os.path.join(tests.dir, name + ".html")
        tests.run("-c", "demo %s to %s" % (name, page))
        with open(path, encoding="utf-8") as f:
            statements = [s for s, _ in harness.read_transcript(f.read())]
        handout(tests, name, page, sum(s.startswith("ask ") for s in statements), sum(s.count("plot ") for s in statements if not s.startswith(("ask ", "#"))))
    page = os.path.join(tests.dir, "session.html")
    done = tests.run("-c", "material steel; geometry sphere R=10 mm\nrecord %s\n# How <wide>?\npress FN=100 N; a\nplot pressure\nfoo\nask \"b & c\" = a within 5 %%\nrecord off" % page, "--keep-going")
    text = handout(tests, "a session", page, 1, 1)
    tests.check("a session on a page", "How <wide>?" in text and "geometry sphere R=10 mm" in text and "a = 186.626 um" in text and "unknown name 'foo'" in text and
                "+----" not in text and "+----" in done.stdout and "wrote " in done.stderr, text)


def handout(tests, name, path, questions, figures):
    """A lesson as an HTML page: one well-formed file that loads nothing, and its text."""
    with open(path, encoding="utf-8") as f:
        text = f.read()
    root = xml.etree.ElementTree.fromstring(text)
    xhtml = "{http://www.w3.org/1999/xhtml}"
    asked = [e for e in root.iter(xhtml + "p") if e.get("class") == "question"]
    ids = re.findall(r"<[^>]*\sid=['\"]([^'\"]*)", text)
    tests.check("a handout of %s: no id twice" % name, len(set(ids)) == len(ids) >= figures and
                {at for at in re.findall(r"<[^>]*(?:href=['\"]|url\(['\"]?)#([^'\")]*)", text)} <= set(ids),
                str(sorted(id for id in set(ids) if ids.count(id) > 1)))
    fetched = re.findall(r"(?:src|href)\s*=\s*['\"](?!#)[^'\"]*|url\((?!['\"]?#)[^)]*|@import|<script|<link", text)
    tests.check("a handout of " + name, root.tag == xhtml + "html" and len(asked) == questions == len(list(root.iter(xhtml + "li"))) and not fetched and
                len(list(root.iter("{http://www.w3.org/2000/svg}svg"))) == figures, "%d questions, %d figures, %s" % (len(asked), text.count("<svg"), fetched))
    body = root.find(xhtml + "body")
    return "\n".join(t for e in body if e.tag != xhtml + "figure" for t in e.itertext())


def lesson(tests, path, row, after):
    with open(path, encoding="utf-8") as f:
        text = f.read()
    name = re.sub(r"^\d+-", "", os.path.basename(path)[:-4])
    steps = harness.read_transcript(text)
    harness.replay(tests, os.path.relpath(path, harness.ROOT), steps)
    questions = [step for step in steps if step[0].startswith("ask ")]
    steps = [step for step in steps if step not in questions]
    tests.check("show demos on " + name, row.split(None, 1) == [name, text.splitlines()[0]], row)
    statements = [s for s, _ in steps if not s.startswith("#")]
    remarks = [s for s, _ in steps if s.startswith("#")]
    if name != "tour":
        tests.check("%s asks first, and names the paper" % name,
                    steps[0][0].startswith("#") and any("?" in s for s in remarks) and
                    any(s.startswith("# The paper: (") for s in remarks) and any(map(harness.draws, statements)), text)
        tests.check("%s has questions" % name, len(questions) > 1 and all(" hint " in s for s, _ in questions), text)
        minutes = sum(len(s.split()) for s in remarks) / 200 + 0.25 * len(statements) + len(questions)  # time to read, to look, to guess
        tests.check("%s takes ten minutes" % name, minutes < 10, "%.1f" % minutes)
    tests.check("%s fits 80 columns" % name, all(len(s) <= 78 for s in remarks), "\n".join(remarks))
    done = tests.run("-c", "demo " + name)
    shown = [line for line in done.stdout.splitlines() if line.startswith(harness.PROMPT)]
    tests.check("demo " + name, done.returncode == 0 and [harness.PROMPT + s for s in statements] == shown,
                tests.report(done))
    said = done.stdout.rstrip().splitlines()[-1]
    tests.check("%s leads on" % name, name == "tour" or said.startswith("Next: demo %s, " % after if after != "-" else "The last of the lessons"), said)
    lines = (done.stdout + done.stderr).splitlines()
    tests.check("demo %s shows its remarks, and no statement without a prompt" % name, "(null)" not in lines and
                [line for line in lines if line.startswith("#")] == remarks and not set(statements) & set(lines), tests.report(done))
    missing = [line for s, out in steps + questions if not harness.draws(s) for line in out
               if not any(harness.same_line(line, got) for got in lines)]
    tests.check("demo %s answers as its transcript" % name, not missing, "\n".join(missing))


def lessons_aside(tests):
    scene = "material steel; geometry sphere R=10 mm; friction 0.3; press FN=100 N; step Fx=20 N; x = 3; "
    done = tests.run("-c", scene + "demo sliding; mu, Fx, x; step dx=1 um; undo; undo; Fx, mu; undo; step Fx=25 N; Fx")
    tests.check("a lesson's scene stays, and is one change", done.returncode == 0 and
                done.stdout.endswith("mu = 0.4\nFx = 40 N\nx = 3\nFx = 20 N\nmu = 0.3\nFx = 25 N\n") and
                "the lesson's now" not in done.stdout + done.stderr, tests.report(done))
    done = tests.run("-c", scene + "set model springs 50; set digits 4; exponent = 7; demo energy; exponent(4 N); show settings; undo; exponent, Fx")
    tests.check("a lesson's names stay till then; settings do not", done.returncode == 0 and re.search(
        r"(?s)exponent\(4 N\) = 3\.072\nset format.*set digits 4\n.*set model springs 50\n.*exponent = 7\nFx = 20 N\n$", done.stdout), tests.report(done))
    done = tests.run("-c", "demo accuracy; show settings; pi; mu")
    tests.check("nor those of its own", done.returncode == 0 and "set digits 6\n" in done.stdout and "set model auto\n" in done.stdout and
                done.stdout.endswith("pi = 3.14159\nmu = 0.4\n"), tests.report(done))
    done = tests.run("--format=json", "-c", "demo loop")
    rows = harness.told(done.stdout)
    tests.check("a lesson in JSON", done.returncode == 0 and any(row.get("name") == "dW" for row in rows),
                tests.report(done))


def own_words(tests):
    """A word of a command after a number is that word, even if it is a variable, too."""
    where = os.path.join(tests.dir, "own words.csv")
    for word, statement, row in (("to", 'table x^2 for x = 1 .. 2 steps 1 to "%s"' % where, "2,4"),
                                 ("with", 'table x^2 for x = 1 .. 2 steps 1 with y = 1 to "%s"' % where, "2,1,4"),
                                 ("to", 'table x^2 for x = 1 .. 2 steps 1 to %s' % where.replace(" ", "-"), "2,4")):
        done = tests.run("-c", "%s = 3; %s; 2*%s" % (word, statement, word))
        path = where if '"' in statement else where.replace(" ", "-")
        with open(path, encoding="ascii") as f:
            tests.check("own word " + word, f.read().endswith(row + "\n") and done.stdout.endswith("= 6\n") and
                        not done.returncode, tests.report(done))


def published(tests):
    """scripts/published: published numbers agree, and a wrong one is noticed."""
    env = {**tests.env, "FRET": tests.fret}
    path = os.path.join(harness.ROOT, "scripts", "published")
    done = subprocess.run(["sh", path], capture_output=True, text=True, env=env)
    sources = {line[:22].strip() for line in done.stdout.splitlines()[1:]}
    tests.check("published numbers", done.returncode == 0 and len(sources) >= 9 and "WRONG" not in done.stdout, tests.report(done))
    where = os.path.join(tests.dir, "published")
    os.mkdir(where)
    shutil.copy(path, where)
    with open(os.path.join(where, "published.txt"), "w", encoding="ascii") as f:
        f.write("a | b | friction 0.4 | 2*mu | 0.81 | 1e-3\na | b | friction 0.4 | 2*mu in m | 0.8 | 1e-3\na | b | friction 0.4 | 2*mu | 0.8 | 1e-3\n")
    done = subprocess.run(["sh", os.path.join(where, "published")], capture_output=True, text=True, env=env)
    tests.check("one that is wrong, one without an answer", done.returncode == 1 and done.stdout.count("WRONG") == 1 and
                len(done.stdout.splitlines()) == 3, tests.report(done))


def run(tests):
    tests.each([lambda room=room: room(tests) for room in
                (jobs, written, long_tables, gaps_in_tables, failing_tables, digits, shown_scenes, waiting_steps, taken_back, many_variables,
                 read_tables, histories, pictures, own_words, demos, published)])
