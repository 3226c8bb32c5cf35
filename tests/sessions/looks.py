# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests figures: their points, their looks, measured points, maps, animations, and figures in the terminal."""
import math
import os
import random
import re
import signal
import subprocess

from harness import at_work

SCENE = ("material E0=210 GPa nu=0.3; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"
         "c0 := a0\ncycle FA=36 N\n")
A, R = 1.8662555784086242e-4, 0.01
LABEL = r"^set label '(\S+)' at first (\S+),first (\S+) "  # of a contour


def script(tests, name, plots, head=SCENE):
    """The gnuplot script of a plot, and its data: a list of points per series, with None for a gap."""
    path = os.path.join(tests.dir, name.replace(" ", "-") + ".gp")
    done = tests.run("-c", head + plots + " to " + path)
    if not tests.check(name, done.returncode == 0, tests.report(done)):
        return "", []
    with open(path, encoding="utf-8") as f:
        text = f.read()
    series = []
    for block in re.findall(r"^\$data\d+_\d+_\d+ << END\n(.*?)^END$", text, re.S | re.M):
        series.append([tuple(map(float, line.split())) if line else None for line in block.split("\n")[:-1]])
    return text, series


def fails(tests, statement, message, head=SCENE):
    done = tests.run("-c", head + statement)
    tests.check("refused: " + statement, done.returncode == 1 and message in done.stderr, tests.report(done))


def points(tests):
    """Curves have enough points where they bend, no more than asked for, and gaps where there is no value."""
    text, (kink,) = script(tests, "a kink", "plot abs(x-1/3) for x = 0 .. 1")
    tests.check("points at a kink", min(abs(x - 1 / 3) for x, _ in kink) < 1e-3 and len(kink) < 300, str(len(kink)))
    text, (line,) = script(tests, "a line", "plot 2*x for x = 0 .. 1")
    tests.check("a straight line needs no more points", len(line) == 101, str(len(line)))
    text, (asked,) = script(tests, "steps", "plot abs(x-1/3) for x = 0 .. 1 steps 7")
    tests.check("steps that are asked for", len(asked) == 8, str(asked))
    text, (noise,) = script(tests, "rounding", "plot 1 + 1e-15*sin(1e6*x) for x = 0 .. 1")
    tests.check("rounding is not refined", len(noise) == 101, str(len(noise)))
    text, (jump,) = script(tests, "a pole", "plot 1/(x-1/3) for x = 0 .. 1")
    tests.check("a pole is not run after", len(jump) < 600 and max(abs(y) for _, y in jump) < 1e4, str(len(jump)))
    text, (plain,) = script(tests, "a homogeneous body", "plot E", "material E0=70 GPa nu=0.3; geometry sphere R=10 mm; ")
    tests.check("its modulus is the same at every depth", len(plain) > 50 and {x for x, _ in plain} == {1} and plain[0][1] == 0, str(plain))
    text, (graded,) = script(tests, "a depth that is given", "plot E", "material E0=70 GPa nu=0.3; c0 = 1 mm; ")
    tests.check("it is drawn over the depth that is given", max(z for _, z in graded) == 2, str(graded))
    for kind in ("k = 0.5; plot E", "plot E with k=0, 0.5", "k := 0; plot E"):
        fails(tests, kind, "c0 is not set", "material E0=70 GPa nu=0.3; ")
    text, (p,) = script(tests, "an edge", "plot p(r) for r = 0 m .. 1.25*a")
    peak = 3 * 100 / (2 * math.pi * A ** 2)
    hertz = lambda r: peak * math.sqrt(max(0.0, 1 - (r / A) ** 2))
    worst = 0
    for (x0, y0), (x1, y1) in zip(p, p[1:]):
        for part in (0.25, 0.5, 0.75):
            x = x0 + (x1 - x0) * part
            worst = max(worst, abs((y0 + (y1 - y0) * part) * 1e9 - hertz(x * 1e-6)) / peak)
    tests.check("lines keep to the pressure at its edge", worst < 3e-3, "%g" % worst)
    done = tests.run("-c", SCENE + "plot c(F) for F = 0 N .. 60 N to %s/gap.gp" % tests.dir)
    tests.check("beyond gross slip is a gap, said once", done.returncode == 0 and done.stderr.count("note: ") == 1 and
                "gross slip" in done.stderr, tests.report(done))
    text, (c,) = script(tests, "a gap", "plot c(F) for F = 0 N .. 60 N")
    tests.check("the curve goes on to gross slip", 39.99 < max(p[0] for p in c if p) <= 40, str(c[-3:]))
    text, curves = script(tests, "own ends", "plot dW(F) for F = 0 N .. mu*FN with mu=0.2,0.4")
    tests.check("each curve has its own ends", [round(s[-1][0], 9) for s in curves] == [20, 40], str(curves)[:300])
    text, loops = script(tests, "own loads", "plot Fx/(mu*FN) against dx/dx0max along cycle FA=0.9*mu*FN with "
                         "k=-0.7,-0.5,0,0.5,0.7")
    tests.check("each curve has its own load", len(loops) == 5 and
                all(abs(max(y for _, y in s) - 0.9) < 1e-9 and abs(min(y for _, y in s) + 0.9) < 1e-9 for s in loops))
    text, (k0,) = script(tests, "definitions", "plot a/a0 for k = -0.5 .. 0.5")
    tests.check("live definitions hold for each value", abs(dict(k0)[0] - 1) < 1e-9 and dict(k0)[0.5] != 1)


def springs(tests):
    text, (stick, slip, band) = script(tests, "springs", "plot springs", SCENE + "step Fx=20 N\n")
    stuck, slid = [p for p in stick if p], [p for p in slip if p]
    tests.check("springs: both are there", len(stuck) > 10 and len(slid) > 10, text[-500:])
    runs = [sum(bool(p) and not (i and s[i - 1]) for i, p in enumerate(s)) for s in (stick, slip)]
    tests.check("springs: one line sticks, one slips on either side, and they meet", runs == [1, 2] and
                {stuck[0], stuck[-1]} < set(slid), "%s %s" % (runs, stuck[-1]))
    rest = [p for p in slid if abs(p[0]) * 1e-6 > A * (1 + 1e-9)]
    tests.check("springs: none slips out of contact", not rest, str(rest[:3]))
    reversed_slip = A * (1 - (36 - 20) / 80) ** (1 / 3)
    edge = min(abs(x) for x, _ in slid) * 1e-6
    tests.check("springs: the slip annulus begins at c", abs(edge / reversed_slip - 1) < 1e-3, "%g %g" % (edge, reversed_slip))


def looks(tests):
    text, _ = script(tests, "looks", 'plot loop title "a \\"b" xlabel "X" ylabel "Y" xrange -2 um .. 2 um '
                     'yrange 50 N .. -50 N flip x key off points'.replace('\\"', "'"))
    for want in ("set title \"a \\047b\"", 'set xlabel "X"', 'set ylabel "Y"', "set xrange [2:-2]", "set yrange [50:-50]",
                 "unset key", "linespoints"):
        tests.check("looks: " + want, want in text, text[-1500:])
    text, _ = script(tests, "logarithms", "plot dissipation log xy")
    tests.check("log xy", "set logscale x" in text and "set logscale y" in text, text[-1500:])
    text, _ = script(tests, "an axis of a sweep", "plot x^2 for x = 1 .. 100 log")
    tests.check("a logarithmic sweep", "set logscale x" in text and "set logscale y" not in text, text[-1500:])
    text, _ = script(tests, "a unit by decades", "plot a, dz for FN = 1 N .. 1000 N log")
    tests.check("a logarithmic axis in the unit of its middle", "F}_{N} [N]" in text, text[-1500:])
    for plot, lost in (("plot sin(x) for x = 1 .. 10 log y", True), ("plot x for x = 0 .. 1 log x", True),
                       ("plot sin(x) for x = 1 .. 10 log x", False), ("plot exp(x) for x = -1 .. 1 log y", False)):
        done = tests.run("-c", plot + " to " + os.path.join(tests.dir, "lost.gp"))
        tests.check("what a logarithmic axis loses: " + plot, ("leaves out what is not above 0" in done.stderr) == lost,
                    tests.report(done))
    text, series = script(tests, "several", "plot loop | traction | x^2 for x = 0 .. 1 | E with k=-0.5,0.5")
    tests.check("several side by side", text.count("\nplot ") == 4 and "layout 1,4" in text, text[-1500:])
    text, _ = script(tests, "units", "plot dx in nm, dz in nm against Fx in kN along program")
    tests.check("units that are asked for", "[nm]" in text and "[kN]" in text, text[-1500:])
    text, _ = script(tests, "written values", "plot dW(F) for F = 0 N .. 30 N with c0=a0,2*a0")
    tests.check("curves are named as they are written", text.count("title ") >= 2 and "2" in text and "µm" not in
                text.partition("with c0")[2], text[-800:])
    fails(tests, "plot loop | x for x = 0 .. 1 | x for x = 0 .. 1 | x for x = 0 .. 1 | x for x = 0 .. 1 | loop | loop",
          "more than 6 figures")
    fails(tests, "plot Fx, dx along program", "cannot share an axis")
    fails(tests, "plot loop xrange 0 N .. 1 N", "xrange is a length, not a force")
    fails(tests, "plot loop log z", "expected log x, log y or log xy")
    fails(tests, "plot loop title hello", 'expected title "TEXT"')
    fails(tests, "plot x for x = 0 .. 1 for y = 0 .. 1", "two ranges make a map")
    for more in ("with k = 0, 0.5", "steps 9", "along cycle"):
        fails(tests, "plot regimes for dxA = 1 um .. 2 um for FN = 1 N .. 9 N " + more, "regimes needs two ranges")
    fails(tests, "plot loop xrange 1 um .. 1 um", "the limits of the x axis are the same")
    fails(tests, "plot dissipation key", "expected key off")


def parts(tests):
    """Unusual labels of axes, curves and frames, and what they are made of."""
    text, series = script(tests, "springs of two gradings", "plot springs with k = 0, 0.5")
    titles = re.findall(r'title "(.*?)"', text.rpartition("plot ")[2])
    tests.check("stick and slip of each, bounds as lines", [re.sub(r"[{}/:]|Italic ", "", t) for t in titles] ==
                ["k = 0, stick", "k = 0, slip", "k = 0.5, stick", "k = 0.5, slip"] and len(series) == 8 and "filledcurves" not in text, str(titles))
    curves = re.findall(r'with (lines .*?) title "', text.rpartition("plot ")[2])
    tests.check("each of its own look", len(set(curves)) == 4, str(curves))
    fails(tests, "plot springs with k = " + ", ".join("0.%02d" % i for i in range(19)), "more than 64 curves in a figure")
    text, _ = script(tests, "names without room", "plot dW(20 N)*1000000000001, dW(20 N)*1000000000002 for mu = 0.4 .. 0.5")
    tests.check("an axis without room for names has the unit alone", 'set ylabel "[MJ]"' in text, text[:1500])
    for order in ("(1 m)^sqrt(-1-y), y*1 mm", "y*1 mm, (1 m)^sqrt(-1-y)"):
        text, series = script(tests, "a dimension that nobody knows, " + order.replace("/", ""), "plot %s for y = 1 .. 2 steps 1" % order)
        tests.check("the axis is of what is known: " + order, "[mm]\"" in text and [(1, 1), (2, 2)] in series, str(series))
    fails(tests, "plot (1 m)^sqrt(-1-y), y*1 mm, y*1 N for y = 1 .. 2", "y*1 mm and y*1 N cannot share an axis")
    fails(tests, "plot loop title \"t\" steps 0", "steps must be a whole number")
    fails(tests, "plot loop steps 0", "steps must be a whole number")
    _, series = script(tests, "a name taken back is a figure again", "load = 3; undo; plot load along cycle")
    tests.check("with its own title and bounds", len(series) == 3, str(len(series)))
    fails(tests, "plot pressure*2 for y = 1 .. 2", "unknown name 'pressure'")
    text, _ = script(tests, "two logarithms", "plot y for y = 1 .. 2 log x log y")
    tests.check("one axis and then the other", re.findall("set logscale (.)", text) == ["x", "y"], text)
    text, _ = script(tests, "one logarithm twice", "plot y for y = 1 .. 2 log y log y flip x flip x")
    tests.check("once is enough", "set logscale y\n" in text and "set logscale x" not in text)


def ranges(tests):
    """Figures over another range than their own; a name that has a value is taken as an expression."""
    _, (whole,) = script(tests, "the loop", "plot loop")
    _, (last,) = script(tests, "the last period of it", "plot loop along cycle")
    tests.check("a period begins at its peak", whole[0] == (0, 0) and last[0] == last[-1] == whole[-1], str(last[0]))
    _, (spent,) = script(tests, "up to less", "plot dissipation for F_A = 0 N .. 10 N")
    tests.check("a range of one's own", spent[-1][0] == 10, str(spent[-1]))
    _, (line,) = script(tests, "a name of a figure", "load = 3\nplot load for x = 0 .. 1 steps 1")
    tests.check("is an expression where it has a value", line == [(0, 3), (1, 3)], str(line))
    fails(tests, "plot loop in N along program", "unknown name 'loop'")


def over(tests):
    path = os.path.join(tests.dir, "measured-1.csv")
    with open(path, "w", encoding="ascii") as f:
        f.write("Fx [kN],dx [nm]\n0.01,200\n-0.02,-500\n")
    text, series = script(tests, "measured", "plot loop over %s" % path)
    tests.check("measured points, columns by their names", series[-1:] == [[(0.2, 10), (-0.5, -20)]], str(series[-1:]))
    tests.check("measured points are named", "measured-1.csv" in text)
    text, series = script(tests, "measured beside", "plot pressure | loop over %s" % path)
    tests.check("a file for the second figure", series[-1:] == [[(0.2, 10), (-0.5, -20)]], str(series[-1:]))
    for columns, row, want in (("u [um],t,force [N]", "1,2,3", (1, 3)), ("force [N],t,u [um]", "3,2,1", (1, 3)),
                               ("FN [N],dx [um],Ft [N]", "1,2,3", (2, 3)), ("Fx [N],a [um],u [um]", "1,2,3", (3, 1)),
                               ("F [N],v [um],Fx [N],dx [um]", "1,2,3,4", (4, 3)), ("F [N],t,Fx [N],v [um]", "1,2,3,4", (4, 3)),
                               ("F [N],u [um],dx [um]", "1,2,3", (3, 1))):
        with open(path, "w", encoding="ascii") as f:
            f.write(columns + "\n" + row + "\n")
        text, series = script(tests, "measured: " + columns, "plot loop over %s" % path)
        tests.check("columns by their names, then by their units: " + columns, series[-1:] == [[want]], str(series[-1:]))
    fails(tests, "plot loop over " + path.replace("measured-1", "none"), "cannot read ")
    with open(path, "w", encoding="ascii") as f:
        f.write("Fx [kN],dx [nm]\n0.01,200\n-0.02,-500\n")
    fails(tests, "plot pressure over " + path, " has no column r: its columns are Fx, dx, by line 1, \"Fx [kN],dx [nm]\"; say which it is: using r=COLUMN")
    with open(path, "w", encoding="ascii") as f:
        f.write("Fx [kN],u [nm]\n0.01,200\n-0.02,-500\n")
    fails(tests, "plot pressure over " + path, " has no column p: its columns are Fx, u, ")
    fails(tests, "plot loop over /nonexistent.csv", "cannot read /nonexistent.csv")
    for columns, row, axis in (("Fx [N],t", "1,2", "dx"), ("dx [um],t", "1,2", "Fx")):
        with open(path, "w", encoding="ascii") as f:
            f.write(columns + "\n" + row + "\n")
        fails(tests, "plot loop over " + path, " has no column %s: its columns are " % axis)
    for columns, row, message in (
            ("u [um],v [um],Fx [N]", "1,2,3", " has no column dx, and a length is each of u, v: say which it is: using dx=COLUMN"),
            ("Ft [N],F [N],w [N],dx [um]", "1,2,3,4", " has no column Fx, and a force is each of Ft, F, w: say which it is: using Fx=COLUMN"),
            ("dz [um],FN [N]", "1,2", " has no column dx: its columns are dz, FN, "),
            ("FN [N],dx [um]", "1,2", " has no column Fx: its columns are FN, dx, "),
            ("FN [N],dx [um],Fx", "1,2,3", "column Fx is a number: it needs the unit of a force in the header"),
            ("Ft [N],dx [um],Fx [N]", "1,2,none", "expected a number as Fx, not 'none'"),
            ("dx [um],dx [mm],Fx [N]", "1,2,3", " has two columns dx: rename one")):
        with open(path, "w", encoding="ascii") as f:
            f.write(columns + "\n" + row + "\n")
        fails(tests, "plot loop over " + path, message)
    for axes, columns, row, want in (("dW(F) for F = 10 N .. 20 N", "F [N],dW [uJ],W [uJ]", "1,2,3", (1, 2)),
                                     ("a against dz for FN = 1 N .. 2 N", "u [um],dz [um]", "1,2", (2, 1)),
                                     ("dz against a for FN = 1 N .. 2 N", "u [um],dz [um]", "1,2", (1, 2)),
                                     ("pressure", "r [um],p [GPa],x [um]", "1,2,3", (1, 2))):
        with open(path, "w", encoding="ascii") as f:
            f.write(columns + "\n" + row + "\n")
        _, series = script(tests, "measured: " + columns, "plot %s over %s" % (axes, path))
        tests.check("measured, %s: %s" % (axes, columns), series[-1:] == [[want]], str(series[-1:]))
    with open(path, "w", encoding="ascii") as f:
        f.write("u [um],v [um]\n1,2\n")
    fails(tests, "plot a against dz for FN = 1 N .. 2 N over " + path,
          " has no column dz, and a length is each of u, v: say which it is: using dz=COLUMN")


def maps(tests):
    text, _ = script(tests, "a map", "plot map dW(F)/1 J for F = 5 N .. 35 N steps 3 for mu = 0.4 .. 0.5 steps 2 "
                     "title \"m\"")
    rows = [line.split() for line in re.search(r"\$map0_0 << END\n(.*?)END", text, re.S).group(1).splitlines() if line]
    tests.check("a map holds its grid", len(rows) == 12 and float(rows[0][0]) == 5 and float(rows[-1][1]) == 0.5, str(rows))
    for high, margin in (("1e5 .. 9e5", 0.15), ("1e-5 .. 3e-5", 0.0127 * (5.5 + 11))):  # 11 columns: 1.5x10^-05, as wide as it is set
        text, _ = script(tests, "a map from " + high, "plot map x*y for x = 1 .. 2 for y = " + high)
        tests.check("room for the labels of y = " + high, abs(float(re.search("set lmargin at screen ([0-9.]+)", text)[1]) - margin) < 1e-4, text[:600])
    text, _ = script(tests, "contours and their values", "plot map dW(F) for F = 1 N .. 30 N for mu = 0.4 .. 0.8")
    values = [[float(v) for v in spot] for spot in re.findall(LABEL, text, re.M)]
    levels = re.search(r"^set cntrparam levels discrete (.*)$", text, re.M).group(1).split(",")
    there = [float(line.split()[2]) for line in re.search(r"\$map0_0 << END\n(.*?)END", text, re.S).group(1).splitlines() if line]
    tests.check("contours are of what is there", len(levels) > 2 and [float(v) for v in levels] == sorted(set(map(float, levels))) and
                min(there) < float(levels[0]) and float(levels[-1]) < max(there), "%s %g %g" % (levels, min(there), max(there)))
    spots = [((x - 1) / 29, (y - 0.4) / 0.4) for _, x, y in values]
    apart = [max(abs(a[0] - b[0]) / 0.16, abs(a[1] - b[1]) / 0.08) for i, a in enumerate(spots) for b in spots[:i]]
    tests.check("values stand on contours, apart and within the frame", 2 < len(values) <= len(levels) and
                {v[0] for v in values} <= set(map(float, levels)) and min(apart) >= 1 and
                all(0.08 <= u <= 0.92 and 0.04 <= v <= 0.96 for u, v in spots), str(values))
    text, _ = script(tests, "values on contours", "plot map y + 2*z for y = 0 .. 1 for z = 0 .. 1")
    values = [list(map(float, v)) for v in re.findall(LABEL, text, re.M)]
    tests.check("where the contours are", len(values) > 2 and all(abs(y + 2 * z - v) < 2e-3 for v, y, z in values), str(values))
    for look in ("", " flip y"):  # in the coordinates of the axes: gnuplot 5.4 takes parts of a frame linearly, also along logarithms
        text, _ = script(tests, "values along logarithms" + look, "plot map y*z for y = 1 .. 1000 log for z = 1 .. 10 log" + look)
        values = [list(map(float, v)) for v in re.findall(LABEL, text, re.M)]
        tests.check("where these contours are" + look, [v[0] for v in values] == [10, 100, 1000] and
                    all(abs(y * z - v) < 0.01 * v for v, y, z in values), str(values))
    text, _ = script(tests, "contours at an edge bear none", "plot map y^60 + z^60 for y = 0 .. 1 for z = 0 .. 1")
    tests.check("no value beyond the frame", "set contour" in text and "set label '" not in text, text[-1500:])
    text, series = script(tests, "stress below part of a contact",
                          "plot map mises(x, 0 m, z) for x = 0.05 mm .. 0.4 mm steps 4 for z = 0 m .. a steps 4")
    tests.check("the contact is marked as far as the map goes", series == [[(50, 0), (186.625558, 0)]], str(series))
    text, _ = script(tests, "below 0", "plot -x*1 um for x = 100 .. 200")
    tests.check("a unit that fits what is below 0", "[\u00b5m]" in text, text[-1500:])
    text, _ = script(tests, "a map in a unit", "plot map -a in mm for k = 0 .. 0.5 for mu = 0.1 .. 0.2 xlabel \"X\" log y")
    there = [float(line.split()[2]) for line in re.search(r"\$map0_0 << END\n(.*?)END", text, re.S).group(1).splitlines() if line]
    tests.check("a map's unit, label and axis", 'set cblabel' in text and "[mm]\"" in text and 'set xlabel "X"\n' in text and
                "set logscale y\n" in text and "set logscale x\n" not in text and abs(min(there) + 0.23) < 0.1, text[-1500:])
    text, _ = script(tests, "a map along logarithms", "plot map (a/a0) for k = 0.1 .. 0.5 log for mu = 0.1 .. 0.2 log")
    tests.check("a map's axes are those of its ranges", re.findall("set logscale (.)", text) == ["x", "y"], text)
    for look in ("log x", "log y"):
        text, _ = script(tests, "a map with " + look, "plot map 2*a for k = 0.1 .. 0.5 for mu = 0.1 .. 0.2 " + look)
        tests.check(look + " of a map", re.findall("set logscale (.)", text) == [look[-1]])
    _, (line,) = script(tests, "a name map", "map = 3; plot map*y for y = 1 .. 2 steps 1")
    tests.check("is no map", line == [(1, 3), (2, 6)], str(line))
    fails(tests, "plot map", "expected map EXPR for A = LO .. HI")
    text, _ = script(tests, "panels of one height", "plot springs | loop title \"\" | W1D along program")
    tests.check("panels stand on one line", [len(set(re.findall("^set %s .*" % m, text, re.M)))
                                             for m in ("tmargin", "bmargin")] == [1, 1], text[-3000:])
    fails(tests, "plot map a for k = 0 .. 0.5", "expected for B = LO .. HI")
    fails(tests, "plot map a along program", "a map needs two ranges: for A = LO .. HI for B = LO .. HI")
    done = tests.run("-c", SCENE + "table x*y, x+y for x = 1 .. 3 steps 2 for y = 1 .. 2 steps 1")
    tests.check("a matrix", [line.split() for line in done.stdout.splitlines()] ==
                [["x*y"], ["x", "y", "=", "1", "y", "=", "2"], ["1", "1", "2"], ["2", "2", "4"], ["3", "3", "6"], [],
                 ["x+y"], ["x", "y", "=", "1", "y", "=", "2"], ["1", "2", "3"], ["2", "3", "4"], ["3", "4", "5"]],
                tests.report(done))
    done = tests.run("-c", SCENE + "table x^4*1e-12*FN*a0 for x = 1 .. 1000 steps 999")
    tests.check("the prefix suits all rows", done.stdout.split()[:4] == ["x", "x^4*1e-12*FN*a0", "[mJ]", "1"],
                done.stdout[:200])
    done = tests.run("--format=csv", "-c", SCENE + "table x*y for x = 1 .. 2 steps 1 for y = 1 .. 2 steps 1")
    tests.check("a matrix as CSV is long", done.stdout.endswith("x,y,x*y\n1,1,1\n2,1,2\n1,2,2\n2,2,4\n"), tests.report(done))
    fails(tests, "table x*y for x = 1 .. 2 for y = 1 .. 2 steps 100", "a matrix as text has at most")


def beside_numbers(tests):
    """The y label of a map stands beside its numbers, however wide these are, and within the picture."""
    number = re.compile(r'translate\(([\d.]+),[\d.]+\)"[^>]*font-size="([\d.]+)"\s+text-anchor="end">\s*<text>(.*?)</text>')
    label = re.compile(r'translate\(([\d.]+),[\d.]+\) rotate\(270[.0]*\)"[^>]*font-size="([\d.]+)"')
    path = os.path.join(tests.dir, "map.svg")
    for statement, panels in (("x*y for x = 0 .. 1 for y = 0 .. 2", 1), ("x*y for x = 0 .. 1 for y = 1 .. 200", 1),
                              ("x*y for x = 0 .. 1 for y = -1e4 .. 5e4", 1), ("x*y for x = 0 .. 1 for y = 1e-11 .. 3e-11", 1),
                              ("x*y for x = 0 .. 1 for y = 0.999 .. 1.001", 1), ("x*y for x = 0 .. 1 for y = 1e-9 .. 1 log y", 1),
                              ("x*y for x = 0 .. 1 for y = 0.001 .. 0.002 log y", 1), ("x*y for x = 0 .. 1 for y = 0.999 .. 1.001 | x for x = 0 .. 1", 2)):
        done = tests.run("-c", "plot map %s to %s" % (statement, path))
        with open(path, encoding="utf-8") as f:
            text = f.read()
        if not tests.check("there is a label of y: " + statement, label.search(text), tests.report(done)):
            continue
        left, size = map(float, label.search(text).groups())
        ends = [(float(x), sum(0.64 * (float(re.search(r'font-size="([\d.]+)"', span[0]).group(1)) if "size" in span[0] else float(font)) * len(span[1])
                               for span in re.findall(r"<tspan([^>]*)>([^<]*)</tspan>", shown))) for x, font, shown in number.findall(text[:label.search(text).start()])]
        room = min(x - width for x, width in ends) - left
        tests.check("the label of y beside its numbers: " + statement, ends and 0.3 * size < room < 3 * size and left > 0.75 * size,
                    "%g at %g, %s" % (room, left, ends))


def frames_of(path):
    with open(path, "rb") as f:
        return f.read().count(b"\x00\x21\xf9\x04")


def moving(tests):
    path = os.path.join(tests.dir, "a.gif")
    done = tests.run("-c", SCENE + "animate springs | loop | W1D along program frames 9 to " + path)
    tests.check("an animation", done.returncode == 0 and frames_of(path) in (9, 8), tests.report(done))
    done = tests.run("-c", SCENE + "animate loop frames 3\nFx")
    tests.check("in a pipe the last frame stays", done.returncode == 0 and "\033" not in done.stdout and
                "Fx = 36 N" in done.stdout, tests.report(done))
    done = tests.run("-c", "material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"
                     "animate springs | Fx against dx along cycle FA=0.9*mu*FN with k=0 frames 3\nFx")
    tests.check("along a load that is tried", done.returncode == 0 and "Fx = 0 N" in done.stdout, tests.report(done))
    pressed = "material steel; c0 = 1 mm; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"
    for load in ("springs along cycle FA=36 N", "springs along step Fx=20 N", "traction along cycle FA=0.9*mu*FN title \"t\" steps 20",
                 "traction title \"t\" steps 20 along cycle FA=9 N",
                 "springs along cycle FA=9 N | loop along cycle FA=9 N", "Fx along cycle FA=9 N | pressure along cycle FA=9 N"):
        done = tests.run("-c", pressed + "animate %s frames 3 to %s\nFx" % (load, path))
        tests.check("figures over a place, along a load: " + load, done.returncode == 0 and frames_of(path) in (2, 3) and
                    done.stdout.endswith("Fx = 0 N\n"), tests.report(done))
    fails(tests, "animate springs along cycle FA=9 N | loop along cycle FA=8 N", "all figures of an animation need the same load", pressed)
    fails(tests, "animate springs along FA=9 N", "along what? program, cycle, step ... or cycle ...", pressed)
    fails(tests, "plot springs along cycle FA=9 N", "springs goes over x, not along a load: animate springs along ... shows it move", pressed)
    still, moved = (tests.run("-c", pressed + "%sanimate springs %sframes 3" % (before, along)).stdout
                    for before, along in (("cycle FA=36 N; ", ""), ("", "along cycle FA=36 N ")))
    tests.check("as along the same load of the program", still == moved and "stick" in moved, still + moved)
    done = tests.run("-c", SCENE + "animate load frames 3 to " + path)
    tests.check("a load between its bounds", done.returncode == 0 and frames_of(path) in (2, 3), tests.report(done))
    done = tests.run("-c", SCENE + "x = 0.05 mm; animate springs along program frames 3 to " + path)
    tests.check("one spring on its way", done.returncode == 0 and frames_of(path) in (2, 3), tests.report(done))
    for panels in ("springs | u1D(x) for x = 0 m .. a", "pressure | u1D(x) for x = 0 m .. a", "springs along program | u1D(x) for x = 0 m .. a"):
        done = tests.run("-c", SCENE + "x = 1; undo; animate %s frames 3 to %s" % (panels, path))
        tests.check("each figure has its own names: " + panels, done.returncode == 0 and frames_of(path) in (2, 3), tests.report(done))
    fails(tests, "plot x for x = 0 .. 1 | x for y = 0 .. 1", "unknown name 'x'")
    done = tests.run("-c", SCENE + "animate loop | y for y = 0 .. 1 with mu = 0.4, 0.5 | y for y = 0 .. 1 with z = 1, 2 frames 3 to " + path)
    tests.check("what does not move", done.returncode == 0 and frames_of(path) in (2, 3), tests.report(done))
    fails(tests, "animate Fx against dx along cycle FA=10 N | Fx along cycle FA=20 N", "all figures of an animation need the same load")
    done = tests.run("-c", SCENE + "animate Fx against dx along cycle FA=10 N | Fx along cycle FA=10 N frames 3 to " + path)
    tests.check("one load, said twice", done.returncode == 0 and frames_of(path) in (2, 3), tests.report(done))
    fails(tests, "animate loop | W1D along cycle", "all figures of an animation need the same load")
    for figures in ("p(r) for r = 0 mm .. 0.2 mm for FN = 10 N .. 100 N", "p(r) for r = 0 mm .. 0.2 mm title \"t\" for FN = 10 N .. 100 N | springs for FN = 10 N .. 100 N",
                    "profile for R = 5 mm .. 10 mm"):
        done = tests.run("-c", pressed + "animate %s frames 3 to %s\nFN" % (figures, path))
        tests.check("over an input: " + figures, done.returncode == 0 and frames_of(path) in (2, 3) and done.stdout == "FN = 100 N\n", tests.report(done))
    done = tests.run("-c", pressed + "animate p(r) for r = 0 mm .. 0.2 mm for FN = 10 N .. 100 N frames 3")
    tests.check("the title tells of the last", "FN = 100 N" in done.stdout, tests.report(done))
    fails(tests, "animate p(r) for r = 0 m .. a for FN = 1 N .. 2 N | p(r) for r = 0 m .. a for mu = 0.1 .. 0.2",
          "all figures of an animation need the same load or the same input", pressed)
    fails(tests, "animate p(r) for r = 0 mm .. 1 mm for FN = 10 N .. -100 N frames 3", "FN = -45 N must be positive", pressed)
    fails(tests, "animate loop to x.png", "an animation goes to a .gif file or to the terminal")
    fails(tests, "animate loop frames 1", "frames must be a whole number from 2 to 1000")
    fails(tests, "animate springs", "there is no load yet", "material steel; geometry sphere R=10 mm; friction 0.4\n")
    where = os.path.join(tests.dir, "stop.gif")
    job = subprocess.Popen([tests.fret, "-c", SCENE + "animate springs | loop frames 1000 to " + where],
                           stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=tests.env)
    at_work(job)
    job.send_signal(signal.SIGINT)
    out, err = job.communicate(timeout=120)
    tests.check("Ctrl-C stops an animation", job.returncode == 130 and not os.path.exists(where), (out + err).decode())


def histories(tests):
    """Figures of long histories leave out no turning point between the points that were asked for."""
    random.seed(11)
    path = os.path.join(tests.dir, "history.csv")
    forces = [(FN, random.uniform(-0.35, 0.35) * FN) for FN in (random.uniform(60, 140) for _ in range(600))]
    with open(path, "w", encoding="ascii") as f:
        f.write("FN [N],Fx [N]\n" + "".join("%r,%r\n" % row for row in forces))
    scene = "material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\nfollow %s\n" % path
    _, (Fx, W) = script(tests, "a long history", "plot Fx/(1 N), W/(1 uJ) against FN along program steps 41", scene)
    drawn = iter(Fx)
    tests.check("a long history: its points", len(Fx) == len(W) == 641 and
                all(any(abs(x - FN) + abs(y - force) < 1e-6 for x, y in drawn) for FN, force in forces), "%d %d" % (len(Fx), len(W)))


def terminals(tests):
    plain = tests.run("-c", SCENE + "plot loop")
    tests.check("no colours in a pipe", "\033" not in plain.stdout, plain.stdout)
    color = tests.run("--color=always", "-c", SCENE + "plot loop")
    tests.check("colours when asked for", "\033[38;5;" in color.stdout or "\033[3" in color.stdout, color.stdout[:300])
    tests.check("colours change no character", re.sub(r"\033\[[0-9;]*m", "", color.stdout) == plain.stdout,
                color.stdout[:300])
    wide = tests.run("-c", SCENE + "plot loop", env={"LC_ALL": "C.UTF-8"})
    tests.check("Unicode where the locale has it", "δx [µm]" in wide.stdout and "dx [um]" in plain.stdout, wide.stdout)
    sixel = tests.run("-c", SCENE + "set plot terminal sixel\nplot loop")
    tests.check("sixel when asked for", "\033P" in sixel.stdout, tests.report(sixel)[:400])
    tests.check("nothing but the picture", sixel.stdout.startswith("\033P"), sixel.stdout[:40])
    block = tests.run("-c", SCENE + "set plot terminal block\nplot loop", env={"LC_ALL": "C.UTF-8"})
    tests.check("braille when asked for", re.search("[\u2801-\u28ff]{8}", block.stdout) and "*" not in block.stdout and
                [line[:7] for line in block.stdout.splitlines()] == [line[:7] for line in wide.stdout.splitlines()],
                block.stdout)
    panels = tests.run("--color=always", "-c", SCENE + "set plot terminal block; set plot 100x20\nplot springs title \"\u65e5\u672c\" | dissipation",
                       env={"LC_ALL": "C.UTF-8", "PATH": "/nonexistent"})
    head, top, *rows = [re.sub("\033\\[[0-9;]*m", "", line) for line in panels.stdout.splitlines()]
    borders = [i for i, c in enumerate(top) if c == "+"]
    tests.check("dots need no gnuplot, and panels stand side by side in their colours", panels.returncode == 0 and len(borders) == 4 and
                all(row[i] in "|+" or row[i] > "\u2800" for row in rows[:-3] for i in borders[:2]) and
                "\033[38;5;33m" in panels.stdout and "\033[38;5;248m" in panels.stdout, panels.stdout + panels.stderr)
    tests.check("a wide character takes two columns", "\u65e5\u672c" in head and head.index("\u0394W") == 51 - 2, head)
    gnuplots(tests)
    shown = tests.run("-c", "set plot 100x30; set plot terminal dumb; show settings")
    tests.check("settings of plots are shown as they are set", "set plot 100x30\nset plot terminal dumb\n" in shown.stdout,
                shown.stdout)
    fails(tests, "set plot terminal vt100", "unknown terminal 'vt100' (auto, dumb, block, sixel)")
    json = tests.run("--format=json", "--color=always", "-c", SCENE + "plot loop")
    tests.check("no colours in JSON", "\\u001b" not in json.stdout, json.stdout[:300])


def formulas(tests):
    """Unicode signs in formulas if the locale has them; a transcript of one locale can be replayed in another."""
    done = tests.run("-c", SCENE + "explain W; explain cN", env={"LC_ALL": "C.UTF-8"})
    plain = tests.run("-c", SCENE + "explain W; explain cN")
    tests.check("signs of sums and integrals", "W = \u222b |c_T u|" in done.stdout and "W = int |c_T u|" in plain.stdout and
                "1/c_N0 = \u03a3 (1\u2212\u03bd\u00b2)/" in done.stdout and "1/c_N0 = sum (1-nu^2)/" in plain.stdout, tests.report(done))
    for one, other, same in (("2 m^3 = 2 m^3", "2 m\u00b3 = 2 m\u00b3", True), ("2 m^2 = 2 m^2", "2 m\u00b2 = 2 m\u00b2", True),
                             ("2 m^2.5 = 2 m^2.5", "2 m\u00b2.5 = 2 m\u00b2.5", False), ("2 m^-1 = 2 m^-1", "2 m^\u22121 = 2 m^\u22121", True),
                             ("2 m^4 = 2 m^4", "2 m\u00b3 = 2 m\u00b3", False)):
        with tests.file("fret> %s\n%s\n" % (one.partition(" =")[0], other), ".txt") as transcript:
            done = tests.run("--replay", transcript)
        tests.check("replayed in another locale: " + one, (done.returncode == 0) == same, tests.report(done))


def gnuplots(tests):
    """What some versions of gnuplot add to a picture: a cursor movement, colours that extend over lines."""
    where = os.path.join(tests.dir, "gnuplots")
    os.mkdir(where)
    path = os.path.join(where, "gnuplot")
    with open(path, "w", encoding="ascii") as f:
        f.write("#!/bin/sh\ncat \"$0.out\"\n")
    os.chmod(path, 0o755)

    def shown(output, *statements):
        with open(path + ".out", "w", encoding="ascii") as f:
            f.write(output)
        return tests.run("--color=always", "-c", SCENE + "\n".join(statements),
                         env={"PATH": where + ":" + os.environ["PATH"]}).stdout
    sixel = shown("\033[H\033Pq#1~-\033\\", "set plot terminal sixel", "plot loop")
    tests.check("the cursor stays where it is", sixel == "\033Pq#1~-\033\\\n", repr(sixel))
    page = "\f\033[0;39m\n a\033[38;5;33mb  \nc \033[22;39md\n\033[0;39;49m"
    lines = shown(page, "plot loop").splitlines()[-3:]
    tests.check("what sets colours back stays, blanks at the ends of lines do not", lines ==
                [" a\033[38;5;33mb", "c \033[22;39md", "\033[0;39;49m"], repr(lines))


def bodies(tests):
    """A warning, once each time, if a contact is too wide for half-spaces."""
    head = "material steel; geometry sphere R=10 mm; friction 0.4\n"
    for statements, count in (("press a=2 mm", 0), ("press a=4 mm", 1), ("press a=4 mm; press a=5 mm", 1),
                              ("press a=4 mm; press a=1 mm; R = 2 mm", 2), ("geometry cone angle=19 deg; press FN=1 N", 0),
                              ("geometry cone angle=21 deg; press FN=1 N; slope = 0.4; slope = 0.1; slope = 0.5", 2),
                              ("geometry cone angle=21 deg", 0), ("geometry exact-sphere R=1 mm; press a=0.4 mm", 1)):
        done = tests.run("-c", head + statements)
        tests.check("half-space: " + statements, done.returncode == 0 and done.stderr.count("warning: ") == count,
                    tests.report(done))


def pages(tests):
    """Figures in the terminal: a map over falling ranges, tics up to the end of a tall page, lines that leave the frame, limits below 0."""
    rising, falling = (tests.run("-c", "set plot 60x20; plot map x^2 + 1.37*y + 0.123 for x = %s for y = %s" % ranges).stdout
                       for ranges in (("1 .. 3", "0 .. 5"), ("3 .. 1", "5 .. 0")))
    tests.check("a map of falling ranges is that of rising ones", rising == falling and re.search("4.*5.*6", rising), rising + falling)
    done = tests.run("-c", "set plot 79x200; plot x for x = 0 .. 1 yrange 0 .. 1")
    tests.check("tics up to the end of a tall page", re.findall(r"^ (\d\.\d+) [+|*]", done.stdout, re.M) ==
                ["%.2f" % (1 - i / 20) for i in range(21)], done.stdout[:3000])
    for plot in ("plot x for x = 0 .. 10 yrange 2 .. 5", "plot x - 3 for x = 0 .. 10 yrange -1 .. 2"):
        done = tests.run("-c", "set plot 60x20; %s xrange 0 .. 10" % plot)
        lines = [line[line.index("|"):] for line in done.stdout.splitlines() if line.count("|") == 2]
        width = max(map(len, lines), default=1) - 1
        places = [line.index("*") / width for line in lines if "*" in line]
        tests.check("what leaves the frame is cut off: " + plot, len(places) == len(lines) > 10 and 0.19 < min(places) < 0.25
                    and 0.45 < max(places) < 0.51 and not done.stderr, tests.report(done))
    done = tests.run("-c", "set plot terminal block; set plot 50x12; plot x for x = 0 .. 1 title \"One\" | x for x = 1 .. 2 title \"Two\"", env={"LC_ALL": "C.UTF-8"})
    tests.check("two figures by braille, one below the other", re.search(r"One\n(.*\n){10,}.*Two\n(.*\n){10,}", done.stdout), tests.report(done))
    done = tests.run("-c", "plot -x - 5 against x for x = 1 .. 2 to below.gp; plot x against x for x = 1 .. 2 xrange 10 .. -1 log x")
    with open(os.path.join(tests.dir, "below.gp"), encoding="utf-8") as f:
        text = f.read()
    other = tests.run("-c", 'plot x*1e-5 for x = 0 .. 9 | x for x = 1 .. 2 title "Two" to small.gp; plot x for x = 1 .. 2 xrange 5 .. 6 to no.gp')
    with open(os.path.join(tests.dir, "small.gp"), encoding="utf-8") as f:
        small = f.read()
    tests.check("numbers far from 1 have their powers of ten, and titles their room", small.count("set format y '%h'") == 1
                and small.count("set tmargin 3") == 2 and not os.path.exists(os.path.join(tests.dir, "no.gp"))
                and "there is nothing to plot along y" in other.stderr, small[-900:] + other.stderr)
    tests.check("what lies below 0 has room above", "set yrange [-7.05:-5.95]" in text and
                "a logarithmic x axis needs limits above 0" in done.stderr, text + done.stderr)
    turned = {}
    for name, look in ("left", "xrange 4 .. 2"), ("flip", "xrange 2 .. 4 flip x"):
        done = tests.run("-c", "plot x^2 for x = 1 .. 9 steps 8 %s to %s.gp" % (look, name))
        with open(os.path.join(tests.dir, name + ".gp"), encoding="utf-8") as f:
            turned[name] = f.read()
    tests.check("limits from right to left", turned["left"].replace("left.gp", "flip.gp") == turned["flip"] and "set xrange [4:2]" in turned["left"],
                turned["left"][-600:] + turned["flip"][-600:])


def regimes(tests):
    """`plot regimes` against Hertz and Mindlin: delta_max = mu (2-nu)/(2 (1-nu)) a^2/R, a^3 = 3 F R/(4 E*); c = a/2 at 3/4 delta_max, and
    at 7/8 mu F; a rig adds the force over its stiffness."""
    for i, ranges in enumerate(("for dxA = 0 um .. 3 um for FN = 1 N .. 200 N", "for FN = 1 N .. 200 N for dxA = 0 um .. 3 um",
                                "for drigA = 0 um .. 4 um for FN = 1 N .. 200 N")):
        across, per_K = i % 2, 1e6 / 80e6 if "drigA" in ranges else 0
        text, (partial, gross, half, border) = script(tests, "regimes %d" % i, "plot regimes " + ranges, SCENE + "rig stiffness=80 N/um\n")
        pairs = [[(y, x) if across else (x, y) for x, y in points] for points in (half, border)]
        for name, part, of_force, points_ in (("c = a/2", 0.75, 0.875, pairs[0]), ("c = 0", 1, 1, pairs[1])):
            law = [part * 0.4 * 1.7 / 1.4 * (3 * f * R * 2 * (1 - 0.3**2) / (4 * 210e9)) ** (2 / 3) / R * 1e6 +
                   of_force * 0.4 * f * per_K for _, f in points_]
            tests.check("%s, %s" % (ranges, name), len(points_) > 20 and points_[0][1] == 1 and points_[-1][1] == 200 and
                        all(abs(d - want) < 1e-6 * want for (d, _), want in zip(points_, law)), str(points_[:3]))
        inside = [max(p[across] for p in points_) for points_ in (partial, gross)]
        tests.check("areas of " + ranges, inside[0] < inside[1] == (4 if per_K else 3) and "filledcurves closed" in text and
                    all('"%s" at graph' % word in text for word in ("partial slip", "gross slip")), str(inside))
    text, series = script(tests, "regimes of a punch", "plot regimes for dxA = 0 um .. 2 um for FN = 10 N .. 200 N",
                          SCENE.split("geometry")[0] + "geometry flat b=0.2 mm; friction 0.4; press FN=100 N\n")
    borders = [points_ for points_ in series if len(points_) < 300]
    law = 0.4 * 1.7 / 1.4 * 200 / (2 * 0.2e-3 * 210e9 / (2 * (1 - 0.3**2))) * 1e6  # mu eta F/(2 E* b)
    tests.check("a punch sticks up to gross slip", len(borders) == 3 and borders[0] == borders[2] and abs(borders[0][-1][0] - law) < 1e-6 * law and
                all('"%s" at graph' % word in text for word in ("stick", "gross slip")) and "partial" not in text, str(borders)[:300])
    at = [[[float(v) for v in spot] for spot in re.findall(r'slip" at graph ([0-9.]+),([0-9.]+)', script(
        tests, "regimes" + flip, "plot regimes for dxA = 0 um .. 3 um for FN = 1 N .. 200 N" + flip)[0])] for flip in ("", " flip x", " flip y")]
    tests.check("names go with flipped axes", len(at[0]) == 2 and all(abs(x + x1 - 1) < 2e-4 and y == y1 and x == x2 and abs(y + y2 - 1) < 2e-4
                                                                      for (x, y), (x1, y1), (x2, y2) in zip(*at)), str(at))
    fails(tests, "plot regimes", "regimes needs two ranges")
    fails(tests, "plot regimes for dxA = 2 um .. 1 um for FN = 1 N .. 2 N", "expected LO .. HI, LO below HI")
    fails(tests, "plot regimes for dxA = 1 um .. 2 um for dz = 1 um .. 2 um", "dz")


def residuals(tests):
    with open(os.path.join(tests.dir, "rest.csv"), "w", encoding="utf-8") as f:
        f.write("y,x\n4.5,2\n0.75,1\n")
    text, (rest,) = script(tests, "residuals", "plot x^2 for x = 0 .. 3 over %s/rest.csv residuals" % tests.dir)
    tests.check("residuals", rest == [(2, 0.5), (1, -0.25)] and "rms = 0.395285 over 2 rows" in text, str(rest))


def run(tests):
    tests.each([lambda one=one: one(tests) for one in (points, parts, ranges, springs, looks, over, maps, beside_numbers, pages, moving, histories, terminals,
                                                       formulas, bodies, regimes, residuals)])
