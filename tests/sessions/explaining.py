# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests `explain` for parts of expressions, definitions, loads and models: lines that must be there, and lines that must not."""
import os
import re

import harness

STEEL = "material E0=210 GPa nu=0.3; geometry sphere R=10 mm; friction 0.4\n"
PRESSED = STEEL + "press FN=100 N\n"
SUM = "material steel; friction 0.4; geometry sum 2:50 m^-1, 4:2e6 m^-3; press FN=10 N; cycle FA=1 N FNA=1 N\n"
WORN = PRESSED + "wear alpha=1e4 um^3/J; cycle FA=10 N; wear cycles 1000\n"
FLAT = "material steel; friction 0.4; geometry flat-rounded b=0.1 mm R=10 mm; press FN=10 N\n"
# a scene, what is explained, lines that must be there (regular expressions), and lines that must not
TOLD = (
    (PRESSED, "2*dW(20 N)", ("dW: energy dissipated per cycle", r"    dW\(20 N\) = 1\.90646 uJ", r"    2\*dW\(20 N\) = 3\.81291 uJ"), ()),
    (PRESSED, "c((10 N)*2)/a", ("c: stick radius", r"    c\(\(10 N\)\*2\) = 148\.125 um|    c\(\(10 N\)\*2\) = ", "a: contact radius"), ()),
    (PRESSED + "z := a*dz; y := a/dz\n", "z*y", ("a: contact radius", "dz: indentation depth", r"    z\*y = 3\.48291e-08 m\^2"), ()),
    (PRESSED + "half(x) := dW(x*1 N)/2\n", "half(20)", ("dW: energy dissipated per cycle", "    model: closed form", r"    half\(20\) = 953\.22\d nJ"),
     (r"    dW\(x",)),
    (PRESSED + "x = 5 N; half(y, x) := dW(x)/y\n", "half(2, 20 N)", ("dW: energy dissipated per cycle", r"    half\(2, 20 N\) = 953\.22\d nJ"), (r"    dW\(x",)),
    (PRESSED + "both(x) := dW(x) + dW(2*x)\n", "both(5 N)", ("dW: energy dissipated per cycle", r"    both\(5 N\) = .* nJ"), (r"    dW\(",)),
    (PRESSED + "x = 5 N; half(y) := dW(x)/y\n", "half(2)", ("dW: energy dissipated per cycle", r"    dW\(x\) = 21\.36\d+ nJ"), ()),
    (PRESSED + "set model springs 50; cycle FA=9 N FNA=10 N times 1000\n", "W", ("    model: 50 springs, by 640 chords a period of the sine and fewer, extrapolated",), ("    cycle: ",)),
    (PRESSED + "cycle dxA=3 um\n", "dW", (r"        gross slip adds 4 mu F_N \(dxA-dxmax\)  \(27\)",), ()),
    (PRESSED + "step dx=3 um\n", "dx", (r"    \|delta_x\| = .*; gross slip goes on from there",), ()),
    (PRESSED + "second aluminium\n", "dW(20 N)", (r"    dW = .*/\(n \(2n\+k\+1\) 2 c_T0 a\^\(k\+1\)\)\]",), ()),
    (PRESSED + "c0 = 1 mm\n", "(dW(5 N) at k=0.2)/dW(20 N)", (r"    dW\(20 N\) = 1\.90646 uJ",), (r"    dW\(5 N\) = ",)),
    (PRESSED + "y := 1 + dW((dW(2 N)/dW(2 N))*20 N)/(1 J)\n", "y", (r"    dW\(2 N\) = .*",), ()),
    (PRESSED, "2*(a at k=0) conditioning", (r"    2\*\(a at k=0\) = 373\.251 um", "    no effect: mu"), ("a: contact radius",)),
    # a load by a definition, a value of 0, and no load
    (STEEL + "c0 = 1 mm; press FN=100 N; k := FN/(1 kN)\n", "kappa conditioning", ("    k = 0.1", "    FN = 100 N .*"), ("    FN now",)),
    (PRESSED, "Fx*dx", ("Fx: tangential force", "    FN now = 100 N", "    Fx = 0 N", "    Fx\\*dx = 0 J"), ()),
    (STEEL, "dz(0 N)", (r"    dz\(0 N\) = 0 m",), ("    FN now",)),
    (STEEL, "f(0 m)", (r"    f\(0 m\) = 0 m",), ("    FN now",)),
    # models
    (PRESSED + "cycle FA=9 N FNA=10 N\n", "qx(0.1 mm)", ("    model: memory diagram, the sine itself, event by event \\(exact\\)",), ()),
    (PRESSED + "cycle dxA=0.3 um FNA=10 N phase=30 deg; at(r) := qx(r*1 mm)*1\n", "at(0.1)",
     ("qx: tangential traction", "    model: memory diagram, by 640 chords a period of the sine"), (r"    qx\(r",)),
    (PRESSED + "rig stiffness=10 N/um; cycle dxA=0.3 um FNA=10 N phase=30 deg\n", "drig", ("    model: memory diagram, converged to .*",), ()),
    (PRESSED + "wear alpha=1e4 um^3/J; cycle dxA=0.3 um FNA=10 N phase=30 deg\n", "dVwear",
     ("    model: memory diagram, converged to 3e-08 .*", "    error: below 3e-08 of the largest value so far"), ()),
    (PRESSED + "cycle FA=9 N FNA=10 N; step dx=0.1 um\n", "c", ("    model: memory diagram, the sine itself, event by event .exact.",), ()),
    (PRESSED + "cycle FA=9 N FNA=10 N\n", "W", ("    model: memory diagram, the sine itself, event by event \\(exact\\)",), ("    cycle: ",)),
    (PRESSED + "step FN=150 N; step FN=120 N\n", "a", ("    FN now = 120 N",), ("    mu = ", "    Fx now")),
    (PRESSED + "step FN=150 N; step FN=120 N\n", "FN*a", ("FN: normal force.*", "    FN = 120 N"), ()),
    ("material steel; k = 0.3; c0 := a0\n", "p", ("    k = 0.3",), ("    c0 = ",)),
    ("geometry power n=2 A=50 m^-1\n", "p", ("    n = 2", "    A = 50 .*"), ("    h = ",)),
    (SUM, "W", ("    law of the gap: polynomials, good to [1-9]e-1[5-9]",), ()),
    (SUM + "W\n", "W", ("    law of the gap: polynomials, good to [1-9]e-1[5-9]",), ()),
    (FLAT + "step FN=12 N Fx=1 N\n", "W", ("    law of the gap: polynomials, good to [1-9]e-1[5-9]",), ()),
    (FLAT + "step Fx=1 N; step dz=2 um\n", "W", ("    law of the gap: polynomials, good to [1-9]e-1[5-9]",), ()),
    (FLAT + "step FN=12 N; step Fx=1 N\n", "W", ("    model: memory diagram.*", "    law of the gap: polynomials, good to [1-9]e-1[5-9]"), ()),
    # the error, always; the conditioning, on request
    (PRESSED, "dW(20 N)", ("    error: below 3e-16 of the value",), ("    conditioning", "    no effect")),
    (PRESSED, "dW(20 N) conditioning", ("    error: below 3e-16 of the value", "    conditioning .*"), ("    argument FA = 20 N .*",)),
    (PRESSED, "2*dW(20 N)/dW(10 N)", ("    error: below 3e-16 of the value",), ("    conditioning", "    no effect")),
    (PRESSED, "2*dW(20 N) at mu=0.5 conditioning", ("    mu = 0.5 .*  \\S+", "    conditioning .*"), ()),
    (PRESSED, "mu", ("    mu = 0.4",), ("    error: ",)),
    # not a bound: for a cone near gross slip with k = -0.7 the value is 1.1e-2 from its limit
    (PRESSED + "cycle FA=10 N; wear alpha=1e4 um^3/J; Nw = 10\n", "Vwear", ("    error: some 1e-03 of the largest value so far",), ("    error: below",)),
    # what wears follows from the cycle, not from the force that it ends at
    (WORN, "Vwear conditioning", ("    FA = 10 N", "    Nw = 1000", r"    alpha_w = 10000 um\^3/J {3}\S+  +\S+  +1", r"    Nw = 1000  +\S+  +\S+  +1"), ("    Fx now",)),
    (WORN, "p0", ("    error: some 1e-03 of the largest value so far",), ()),
    (WORN + "Nw = 1e7\n", "p0", ("    error: not known, p is steeper than the nodes of the worn gap",), ("    error: some",)),
    (WORN, "hwear(0.95*a)", ("    FA = 10 N",), ("    Fx now",)),
    (WORN, "dVwear", ("    FA = 10 N", "    Nw = 1000"), ("    Fx now",)),
    (WORN, "a", ("    mu = 0.4", "    alpha_w = .*", "    FA = 10 N", "    Nw = 1000"), ("    Fx now",)),
    (WORN, "qx(0.1 mm)", ("    FA = 10 N", "    Fx now = 10 N"), ()),
    (PRESSED, "u1D(0.1 mm)", ("    error: below 1e-13 of the largest value",), ()),
    (PRESSED, "E(1 mm)", ("    error: below 3e-16 of the value",), ()),
    (PRESSED + "step Fx=10 N; step Fx=-5 N\n", "W", ("    error: below 3e-16 of the largest value so far",), ()),
    (PRESSED + "cycle FA=9 N FNA=10 N\n", "qx(0.1 mm)", ("    error: below 1e-12 of the largest value",), ()),
    (PRESSED + "geometry exact-sphere R=10 mm\n", "a", ("    error: below 1e-13 of the value",), ()),
    (SUM, "W", ("    error: below 1e-13 of the largest value so far",), ()),
    (PRESSED + "set model springs 50\n", "W", ("    error: 0 J, against the exact value",), ()),
    (PRESSED + "cycle FA=5 N FNA=30 N phase=180 deg\nset model springs 50\n", "dW", (r"    error: \S+ J, against the exact value",), ()),  # exactly 0
    # inputs that were given before, and that the geometry does not have
    (PRESSED + "c0 = 1 mm; geometry cone slope=0.1\n", "a", ("    slope = 0.1",), ("    c0 = ", "    R = ")),
    (PRESSED + "cycle FA=9 N FNA=10 N\n", "dW(5 N) conditioning", ("    FN now = 110 N", "    FNA = 10 N", "    no effect: .*FA.*"), ("    FA = 9 N",)),
)
MANY = ("E0", "nu", "k", "c0", "mu", "R", "FN", "FA", "kappa", "eta", "beta_k", "hN", "hT", "a", "dz", "c", "Fx", "dx", "W", "U", "dW", "a0", "dz0",
        "dx0max", "dxmax", "kt", "kn", "phase", "time", "nu_2", "E0_2", "Ksec(1 N)", "Kp(1 N)", "loss_factor(1 N)", "cN(1 mm)", "cT(1 mm)",
        "dW(1 N)", "c(1 N)", "dx(1 N)", "p(0 m)", "uz(1 mm)")


def told(tests):
    for scene, what, there, not_there in TOLD:
        done = tests.run("-c", scene + "explain " + what)
        missing = [line for line in there if not re.search("^(?:%s)$" % line, done.stdout, re.M)]
        wrong = [line for line in not_there if re.search("^%s" % line, done.stdout, re.M)]
        tests.check("explain " + what, done.returncode == 0 and not missing and not wrong, "%s\n%s\n%s" % (missing, wrong, tests.report(done)))
        pages = re.split(r"^(?=\w+: )", done.stdout, flags=re.M)
        tests.check("each part of %s once" % what, len(pages) == len(set(pages)), done.stdout)


def many(tests):
    """Many quantities, some of them a second time through a definition."""
    known = "c0 = 1 mm; second E0=70 GPa nu=0.3; k = 0.1; cycle FA=9 N\n"
    names = [name for name in MANY if tests.run("-c", PRESSED + known + name).returncode == 0]
    done = tests.run("-c", PRESSED + known + "again := a + dz; explain (%s)*again" % "*".join("(1+%s-%s)" % (n, n) if n in ("phase", "time") else
                                                                                             "(%s/%s)" % (n, n) for n in names))
    heads = re.findall(r"^(\w+): ", done.stdout, re.M)
    tests.check("many quantities on a page", done.returncode == 0 and len(names) > 36 and
                all(name.partition("(")[0] in heads for name in names), "%d\n%s" % (len(names), tests.report(done)))


def bare(tests):
    """Every quantity by its name alone, in an empty scene and in a complete one."""
    names = re.findall(r"^    (\w+)(?:\(\w+\))?  ", tests.run("-c", "help quantities").stdout, re.M)
    for page in re.split(r"^(?=\w+: )", tests.run("-c", "\n".join("help " + name for name in names)).stdout, flags=re.M):
        formulas = [re.sub(r"  [(\[].*", "", text) for text in re.findall(r"^    (\S.*)", page, re.M)]
        tests.check("help gives a formula once: " + page[:20].partition(":")[0], len(formulas) == len(set(formulas)), page)
    for scene in ("", "material E0=210 GPa nu=0.3 k=0.3 c0=1 mm; second E0=70 GPa nu=0.2; geometry sphere R=10 mm; friction 0.4\n"
                  "press FN=100 N; cycle FA=10 N FNA=1 N\n"):
        done = tests.run("--keep-going", "-c", scene + "\n".join("explain " + name for name in names))
        heads = re.findall(r"^(\w+): .*\n    \S", done.stdout, re.M)
        failed = re.findall(r"^  explain (\w+)$", done.stderr, re.M)
        tests.check("every quantity has its formula", len(names) > 30 and sorted(heads + failed) == sorted(names) and (not scene or len(failed) < 12),
                    "%s\n%s" % (sorted(set(names) - set(heads)), done.stderr))


def answering(tests):
    """What springs have answered says so, whatever the row of the quantity: it is an approximation."""
    setup = PRESSED + "rig stiffness=10 N/um; wear alpha=1e4 um^3/J; cycle FA=10 N FNA=20 N; set model springs 50\n"
    by_springs = []
    for name in re.findall(r"^    (\w+)  ", tests.run("-c", "help quantities").stdout, re.M):
        done = tests.run("--keep-going", "-c", setup + "set timing on\n%s\nset timing off\nexplain %s" % (name, name))
        if re.search(r"^time: .*springs", done.stderr, re.M):
            by_springs.append(name)
            tests.check("springs answer for " + name, "    model: 50 springs" in done.stdout, tests.report(done))
    tests.check("springs answer for some", {"Fx", "W", "dW", "dVwear", "drig"} <= set(by_springs), str(by_springs))


def typeset(tests):
    """Formulas in Unicode, in a UTF-8 locale."""
    script = PRESSED + "step FN=90 N dx=0.1 um\nexplain W"
    for locale, plane in (("C", "(delta_z, delta_x)"), ("C.UTF-8", "(\u03b4_z, \u03b4_x)")):
        done = tests.run("-c", script, env={"LC_ALL": locale})
        tests.check("a path in %s" % locale, "    path: step FN= dx= goes straight in %s\n" % plane in done.stdout, tests.report(done))


def at_length(tests):
    """Many calls of one function: each has its page, but once."""
    calls = ["dW(%d N)" % i for i in range(1, 40)]
    done = tests.run("-c", PRESSED + "explain %s + FN*a + c(1 N)*(1 N)" % " + ".join(calls + calls))
    told_of = re.findall(r"^    (\w+\([^()]*\)) = ", done.stdout, re.M)
    tests.check("each of many calls once", done.returncode == 0 and told_of == calls + ["c(1 N)"] and
                re.findall(r"^(\w+): ", done.stdout, re.M) == len(calls)*["dW"] + ["FN", "a", "c"], tests.report(done))


def repeating(tests):
    """Repeated periods, which are not computed, are reported and counted: W grows by dW in each."""
    swung = PRESSED + "cycle FA=9 N FNA=10 N times %d\nset digits 15\n"
    W = {times: float(tests.run("--format=csv", "-c", swung % times + "W").stdout.split()[-1]) for times in (4, 5, 1000)}
    tests.check("repeated periods", abs(W[1000] - W[4] - 996 * (W[5] - W[4])) < 1e-12 * W[1000], str(W))
    done = tests.run("-c", swung % 1000 + "set timing on\nW\nexplain W")
    tests.check("are told", re.search(r"^    cycle: 99\d more periods repeat the last one that was run$", done.stdout, re.M) and
                re.search(r"\(memory diagram, 99\d periods repeat the last one run\)$", done.stderr, re.M), tests.report(done))
    told = [tests.run("-c", swung % times + "set timing on\nW\nexplain W") for times in range(3, 9)]
    told = [sorted(set(re.findall(r"[12] (?:more )?periods? repeats? the last one", done.stdout + done.stderr))) for done in told]
    tests.check("one, and two", ["1 more period repeats the last one", "1 period repeats the last one"] in told and
                ["2 more periods repeat the last one", "2 periods repeat the last one"] in told, str(told))


def mixed(tests):
    """In JSON a page is one object."""
    done = tests.run("--format=json", "-c", PRESSED + "second E0=70 GPa nu=0.33\nexplain eta; explain dW(20 N)")
    told = [row for row in harness.told(done.stdout) if row.get("event") == "explain"]
    tests.check("pages in JSON", done.returncode == 0 and len(told) == 2 and told[0]["value"] > 0 and
                all(told[1][key] for key in ("formula", "equation", "numbers", "model", "value", "error")), tests.report(done))


def springs(tests):
    """The error that is shown for springs is the difference to the exact value."""
    for count, load, name in ((50, "cycle FA=20 N", "dW"), (1000, "cycle FA=20 N", "c"), (80, "step Fx=20 N; step FN=90 N dx=0.3 um", "Fx"),
                              (300, "cycle FA=9 N FNA=10 N", "dW"), (50, "k = 0.2, c0 = 1 mm; step Fx=-10 N", "dx")):
        scene = PRESSED + load + "\n"
        done = tests.run("--format=json", "-c", scene + "%s; set model springs %d; %s" % (name, count, name))
        exact, got = harness.printed_values(done.stdout)
        page = tests.run("-c", scene + "set model springs %d; explain %s" % (count, name))
        told = re.findall(r"^    error: (\S+) of the value, against the exact one$", page.stdout, re.M)
        tests.check("the error of %d springs, %s of %s" % (count, name, load), got != exact and len(told) == 1 and
                    abs(float(told[0]) / abs(got / exact - 1) - 1) < 0.06, tests.report(done) + tests.report(page))


SWUNG = (  # k, the load
    ("0", "cycle FA=8 N FNA=39 N phase=280 deg; step FN=85 N Fx=1 N"),
    ("0", "cycle FA=19 N FNA=5 N phase=195 deg times 3"),
    ("0", "step Fx=5 N; cycle FA=15 N FNA=54 N phase=212 deg"),
    ("0.3", "cycle FA=19 N FNA=39 N phase=319 deg times 3; step Fx=3 N"),
    ("-0.4", "cycle FA=16 N FNA=50 N phase=259 deg times 3; step FN=85 N Fx=1 N"))
SWINGS = ("dx", "W", "U", "dW", "c", "qx(0.15 mm)")


def swung(tests):
    """The error stated for the chords of a swinging load is right. A gap given as rows on a parabola, which are interpolated
    exactly, needs chords; the same gap as a formula is computed for the sine itself, its fields from 640 straight parts."""
    rows = os.path.join(tests.dir, "parabola.csv")
    with open(rows, "w") as f:
        f.write("r [m],f [m]\n" + "".join("%.17g,%.17g\n" % (1e-5 * i, 50 * (1e-5 * i) ** 2) for i in range(101)))

    def one(k, load):
        scene = "material E0=210 GPa nu=0.3 k=%s c0=1 mm; friction 0.4; geometry %%s; press FN=100 N; %s\n" % (k, load)
        shown = [tests.run("--format=json", "-c", scene % geometry + ", ".join(SWINGS))
                 for geometry in ("power n=2 A=50 m^-1", "file " + rows)]
        exact, got = (harness.printed_values(done.stdout) for done in shown)
        pages = tests.run("-c", scene % ("file " + rows) + "; ".join("explain " + name for name in SWINGS))
        stated = [float(text) for text in re.findall(r"^    model: memory diagram, .*(?:converged|good) to (\S+)", pages.stdout, re.M)]
        if not tests.check("every value of %s says how good it is" % load, len(stated) == len(got) == len(exact) == len(SWINGS), tests.report(pages)):
            return
        told = [float(text) for text in re.findall(r"^    error: below (\S+) of ", pages.stdout, re.M)]
        tests.check("and its error is no less: " + load, len(told) == len(stated) and all(map(float.__ge__, told, stated)), "%s\n%s" % (told, stated))
        for name, x, y, good in zip(SWINGS, exact, got, stated):
            known = 1e-13 if "(" not in name else 2e-5  # accuracy of the fields for the sine itself
            tests.check("%s of %s is as good as is said" % (name, load), abs(x - y) <= max(good, known) * abs(x) and good < 0.05,
                        "%.17g, not %.17g; said %.0e" % (y, x, good))
    tests.each([lambda row=row: one(*row) for row in tests.some(SWUNG)])


def run(tests):
    tests.rooms(told, many, bare, answering, typeset, at_length, repeating, mixed, springs, swung)
