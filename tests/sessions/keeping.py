# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests save, record, replay and copies of a terminal; and the JSON output of such sessions."""
import json
import math
import os
import random
import re
import resource
import subprocess

import harness

SCENE = "material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"

# a copy of a terminal: reports, carets, hints, times, drawings, continuation lines, an empty last prompt
TERMINAL = """$ fret
fret: partial-slip contact of graded elastic solids; try `demo` or `help`.
fret> material steel; geometry sphere R=10 mm; friction 0.4
fret> press FN=100 N
  FN = 100 N, a = 186.626 um, dz = 3.48291 um
fret> step Fx=50 N
error: Fx = 50 N exceeds mu*FN = 40 N: gross slip; step by displacement (dx=...) to slide
  step Fx=50 N
          ^~~~
fret> step \\
....>   Fx=20 N
  Fx = 20 N, dx = 625.995 nm, c = 148.125 um
fret> 1,5 mm
1 = 1
5 mm = 5 mm
note: the comma in 1,5 parts two values: write 1.5 for one
fret> set timing on
fret> c
c = 148.125 um
time: 0.0214 ms (closed form)
fret> set timing off
time: 0.002 ms
fret> plot loop
 Fx [N]   a picture that depends on the terminal
   |
fret> ?friction
friction MU
  the coefficient of friction

Sets mu, Coulomb's coefficient. `mu = 0.4` does the same. Normal contact needs
no mu; with mu = 0 no Fx can be carried.

    fret> friction 0.4
    fret> mu
    mu = 0.4
fret> explain eta conditioning
eta: ratio of normal to tangential stiffness
    \u03b7 = c_N/c_T  (4),(5)
    nu = 0.3
    model: closed form
    eta = 1.21429
    error: below 3e-16 of the value
    conditioning          last digit    moves eta by  condition number
    nu = 0.3                 1.9e-16         4.7e-17              0.25
    no effect: E0, mu, FN, R, Fx
fret> !ls
a file
fret> history to %s
wrote h.csv (1 B)
fret> a
a = 186.626 um
fret>
"""

SCENES = (
    "",
    "material E0=210.123456789 GPa nu=1/3 k=0.1 c0=1/3 mm; second E0=70 GPa nu=0.33; geometry cone angle=3 deg\n"
    "friction 1/7; press FN=100/3 N; step Fx=1 N steps 3; step dx+=1 nm; cycle dxA=10 nm times 3",
    SCENE + "cycle FA=20 N FNA=10 N phase=90 deg steps 20\nstep FN+=3 N Fx=-5 N",
    SCENE + "FA0 = 0.7*mu*FN\nhalf(x, y) := x/y\nc0 := a0\ncycle FA:=half(FA0, 2)\nk = 0.3",
    SCENE + "set model springs 50; step Fx=20 N",
    "material steel; second rigid; geometry sum 2:50 m^-1, 4:2e6 m^-3; mu = 0.2; press a=0.1 mm; step dz=1 um dx=20 nm",
    "material PTFE; geometry flat-rounded b=1 mm R=10 mm; friction 0.1; press dz=1 um",
    "k = 0.5, c0 = 2 mm",
    "q1 = 4; p1 := 2*q1; r1 := p1 + 1; q1 = 30 m^-1",  # r1 has no value any more
    "nu = 0.3; w = 2; nu := 2*k; k := c0*1 mm",  # nu has no value any more
    "geometry power n=2 A=50 m^-1; r1 := A + 1 m^-1; geometry power n=3 A=50 m^-2",
    "w0 = 1; " + "; ".join("w%d := w%d" % (i + 1, i) for i in range(100)) + "; e = 2; w0 := e",
    "material E0=210 GPa nu=0.3 k=0.2 c0=1 mm; geometry sphere R=5 mm; friction 0.4; press FN=100 N; most = dxmax",  # dxmax has more digits than fit
)
ASKED = "show\nshow variables\nset digits 17\nFN, dz, a\nFx, dx, c, W, U\ndW\nkt, kn\nhistory"

LINES = """material steel; geometry sphere R=10 mm; friction 0.4
press FN=100 N
step Fx=20 N steps 3
cycle FA=20 N times 2
a, c in mm, dW at k=0, 1/3, phase
explain dW
explain c
show
show settings
show units
show commands
show variables
show nothing
set
help
help a
help units
help paper
apropos stick
apropos zzzz
plot loop
plot a for FN = 1 N .. 100 N
plot accuracy within 0.1
demo
history
accuracy within 0.1
table a for FN = 1 N .. 100 N steps 3
table a for FN = 1 N .. 100 N steps 3 to t.json
record r.txt
a
record off
replay r.txt
save s.fret
source s.fret
undo
reset
second rigid; second same
set timing on
a
1,5 mm
foo
"
"""


def copies(tests):
    path = os.path.join(tests.dir, "h.csv")
    with tests.file(TERMINAL % path, ".txt") as copy:
        done = tests.run("--replay", copy)
    tests.check("a copy of a terminal replays", done.returncode == 0 and "0 failed" in done.stdout, tests.report(done))
    for old, new in (("c = 148.125 um\ntime", "c = 148.126 um\ntime"), ("a = 186.626 um\nfret>\n", "fret>\n"),
                     ("5 mm = 5 mm\n", "5 mm = 5 mm\nmore\n"), ("gross slip; step by", "gross slip, step by")):
        with tests.file((TERMINAL % path).replace(old, new), ".txt") as copy:
            done = tests.run("--replay", copy)
        tests.check("a copy that is wrong: " + new.strip(), done.returncode == 1 and " 1 failed" in done.stdout,
                    tests.report(done))
    with tests.file("  fret> x = 1 + \\\n  ....> 2; x\nx = 3\n", ".txt") as copy:
        done = tests.run("--replay", copy)
        tests.check("a copy whose prompts are set in", done.returncode == 0 and ": 1 passed, 0 failed" in done.stdout, tests.report(done))
    for statement, answer, right in (("sigma = 1; sigma", "σ = 1", True), ("sigma1 = 1; sigma1", "σ1 = 1", False),
                                     ("x2sigma = 1; x2sigma", "x2σ = 1", False), ("sigma_1 = 1; sigma_1", "σ_1 = 1", True)):
        with tests.file("fret> %s\n%s\n" % (statement, answer), ".txt") as copy:
            done = tests.run("--replay", copy)
        tests.check("typeset in a copy: " + answer, done.returncode == (not right) and "1 passed" * right in done.stdout,
                    tests.report(done))
    dropped = ("fret> x = 3, y = ^C\nfret> step Fx=20 N; x^C\nfret> table a(F), \\\n....> dz(F^C\n\nfret> x^C\nerror: unknown name 'x'\n"
               "fret> C = 2; x = 3; x^C\nx^C = 9\nfret> y = x^C\nfret> y\ny = 9\nfret> ^C\n")
    for text, answer in ((dropped, ": 4 passed, 0 failed"), (dropped + "8\n", ": 4 passed, 1 failed"),
                         (dropped.replace("C = 2", "C = 3"), ": 2 passed, 2 failed")):
        with tests.file(text, ".txt") as copy:
            done = tests.run("--replay", copy)
        tests.check("a copy with lines dropped by Ctrl-C" + answer, done.stdout.endswith(answer + "\n"), tests.report(done))
    with tests.file("fret> 1 + \\\n....> 1,\0\\\n....> \n3\n", ".txt") as copy:
        done = tests.run("--replay", copy)
    tests.check("a copy with a byte 0 before a mark of continuation", done.returncode == 1 and "unexpected byte 0x00" in done.stdout,
                tests.report(done))
    script = "fret> friction 0.4\n  fret> x = 1 + \\\n \t ....> 2\nx\nfret>\n....> \n"
    for way, done in (("file", None), ("pipe", tests.run(input=script)), ("-c", tests.run("-c", script))):
        if way == "file":
            with tests.file(script) as path:
                done = tests.run(path)
        tests.check("a script with prompts as " + way, done.stdout == "x = 3\n" and not done.stderr, tests.report(done))


def recorded(tests):
    where = os.path.join(tests.dir, "kept")
    os.mkdir(where)
    done = tests.run("--keep-going", "-c", "mu = 0.3\nrecord r.txt\n" + SCENE + "foo\nstep FN=90 N \\\n  un^o\nstep Fx=20 N; dx\na + \\\n1 um\n"
                     "set format json\nc\nbar\nsave new.fret\nset format text\nrecord off\nk", cwd=where)
    tests.check("a script is recorded", done.returncode == 1 and "k = 0" in done.stdout, tests.report(done))
    done = tests.run("--replay", "r.txt", cwd=where)
    tests.check("and replays", done.returncode == 0 and done.stdout.endswith("r.txt: 11 passed, 0 failed\n"), tests.report(done))
    done = tests.run("-c", "material steel; second rigid; geometry sphere R=1 mm; friction 0.3; press FN=9 N; step Fx=1 N\nrecord d.txt\n"
                     "a\nsecond same\nsecond rigid\nrecord off", cwd=where)
    done = tests.run("--replay", "d.txt", cwd=where)
    tests.check("what was warned of before is not missed", done.returncode == 0, tests.report(done))
    with open(os.path.join(where, "d.txt"), encoding="utf-8") as f:
        text = f.read()
    with tests.file(text.replace("fret> second rigid\nwarning", "fret> second rigid\n#"), ".txt") as path:
        done = tests.run("--replay", path)
        tests.check("what is warned of later is", "+ warning:" in done.stdout and done.returncode == 1, tests.report(done))
    steps = "".join("step Fx=%d N\n" % ((-1) ** i * (35 - i)) for i in range(30))
    for model in ("", "set model springs 100\n"):
        done = tests.run("-c", model + SCENE + steps + "record long.txt\nW\nrecord off", cwd=where)
        again = tests.run("--replay", "long.txt", cwd=where)
        tests.check("a long load is recorded whole" + model, done.returncode == again.returncode == 0 and "W = " in done.stdout
                    and again.stdout.endswith(" passed, 0 failed\n"), tests.report(done) + tests.report(again))
    done = tests.run("-c", 'friction 0.2; record line.txt; friction 0.3; 2*mu ; record  off ; 3\nmu', cwd=where)
    with open(os.path.join(where, "line.txt"), encoding="utf-8") as f:
        text = f.read()
    again = tests.run("--replay", "line.txt", cwd=where)
    tests.check("a line that begins and ends a transcript", done.stdout.endswith("3 = 3\nmu = 0.3\n") and again.returncode == 0
                and re.fullmatch(r"# fret [0-9.]+\nfret> friction 0.2 # as it was\nfret> friction 0.3; 2\*mu\n2\*mu = 0.6\n", text), text + tests.report(again))
    done = tests.run("-c", "record r.txt; a = 1 m", cwd=where)
    tests.check("overwriting a transcript is told", "overwriting r.txt" in done.stderr, tests.report(done))
    done = tests.run("-c", "record /nonexistent/r", cwd=where)
    tests.check("where none can be written", "cannot write /nonexistent/r: No such file" in done.stderr and
                done.returncode == 1, tests.report(done))
    with open(os.path.join(where, "self.txt"), "w", encoding="ascii") as f:
        f.write("fret> replay self.txt\nfret> record self.txt\nfret> record off\n")
    done = tests.run("--replay", "self.txt", cwd=where)
    tests.check("a transcript of itself ends", "nested more than" in done.stdout and done.returncode == 1,
                tests.report(done))
    with open(os.path.join(where, "sum.txt"), "w", encoding="ascii") as f:
        f.write("fret> 1 + 1\n1 + 1 = 2\n")
    done = tests.run("-c", "; ".join(9 * ["replay sum.txt"]), cwd=where)
    tests.check("one after another they are not nested", done.stdout.count("1 passed, 0 failed") == 9, tests.report(done))


def quoted(tests):
    """File names that need quotation marks, one that contains some, and the longest name."""
    where = os.path.join(tests.dir, "quoted")
    os.mkdir(where)
    for name, written in (("a b.csv", '"a b.csv"'), ('a"b.csv', 'a"b.csv')):
        with open(os.path.join(where, name), "w", encoding="ascii") as f:
            f.write("r [mm],f [um]\n0,0\n1,50\n")
        done = tests.run("-c", "geometry file %s\nsave s.fret" % written, cwd=where)
        again = tests.run("-c", "source s.fret; f(0.5 mm)", cwd=where)
        tests.check("saved: " + name, done.returncode == again.returncode == 0 and again.stdout.startswith("f(0.5 mm) = "),
                    tests.report(done) + tests.report(again))
    # names are written as they were typed, with ", #, ; and \ in them
    for name in ('a"b;c.csv', 'a"#b.csv', 'a"b\\', "a\\", "a;b.csv"):
        with open(os.path.join(where, name), "w", encoding="ascii") as f:
            f.write("r [mm],f [um]\n" + "".join("%g,%g\n" % (i / 2, 12.5 * i * i) for i in range(8)))
        for smooth in ("", " smooth"):
            written = '"%s"' % name if name == "a;b.csv" else name
            done = tests.run("-c", "geometry file %s%s \nsave s.fret\nshow" % (written, smooth), cwd=where)
            again = tests.run("-c", "source s.fret; f(0.5 mm); show", cwd=where)
            tests.check("saved: %s%s" % (name, smooth), done.returncode == again.returncode == 0 and
                        again.stdout.partition("\n")[2] == done.stdout and done.stdout.count("\n") == 1, tests.report(done) + tests.report(again))
    done = tests.run("-c", "mu = 0.3; save a#b.fret; save c# a comment; mu = 0.4\nsource a#b.fret; mu", cwd=where)
    tests.check("a name with a mark of comments within", done.stdout == "mu = 0.3\n" and {"a#b.fret", "c"} <= set(os.listdir(where)), tests.report(done))
    with open(os.path.join(where, "a \nb.csv"), "w", encoding="ascii") as f:
        f.write("r [mm],f [um]\n0,0\n1,50\n")
    done = tests.run("-c", 'geometry file "a\\\nb.csv"\nf(1 mm)\nshow', cwd=where)
    tests.check("a name of two lines", done.stdout == "f(1 mm) = 50 um\ngeometry file # the name of the file cannot be written in a statement\n",
                tests.report(done))
    with open(os.path.join(where, "ll.fret"), "w", encoding="ascii") as f:
        f.write("x = 3; x\n")
    for name, out, err in (("./" * 2044 + "ll.fret", "x = 3\n", ""), ("./" * 2044 + "lll.fret", "", "1:8: error: the file name is too long")):
        for quote in ("", '"'):
            done = tests.run("-c", "source " + quote + name + quote, cwd=where)
            tests.check("a name of %d bytes%s" % (len(name), quote), 4095 <= len(name) <= 4096 and done.stdout == out and err in done.stderr, done.stderr[:200])


def saved(tests):
    for i, scene in enumerate(SCENES):
        name = os.path.join(tests.dir, "saved%d.fret" % i)
        first = tests.run("--keep-going", "-c", scene + "\nsave %s\n" % name + ASKED)
        again = tests.run("--keep-going", "-c", "mu = 0.9; source %s\n" % name + ASKED if i == 1 else
                          "source %s\n" % name + ASKED)
        tests.check("a scene comes back to the last bit: " + scene[:40], first.stdout == again.stdout and
                    first.stdout.count("\n") > 1, "%s\n%s" % (tests.report(first), tests.report(again)))
        same = tests.run("-c", "source %s\nsave %s.again" % (name, name))
        with open(name, encoding="utf-8") as f, open(name + ".again", encoding="utf-8") as g:
            tests.check("and is saved alike: " + scene[:40], f.read() == g.read(), tests.report(same))
    for name in ("history.fret", "history", "off.txt"):
        command = "record" if name == "off.txt" else "save"
        done = tests.run("-c", "mu = 0.1; %s %s" % (command, name))
        path = os.path.join(tests.dir, name)
        tests.check("%s to %s" % (command, name), done.returncode == 0 and os.path.getsize(path) > 10, tests.report(done))
    name = os.path.join(tests.dir, "saved0.fret")
    done = tests.run("-c", "mu = 0.1; save %s" % name)
    tests.check("overwriting a scene is told", "overwrote %s" % name in done.stderr, tests.report(done))
    done = tests.run("-c", "save history %s" % name)
    tests.check("a script has no history", "a script is its own history" in done.stderr, tests.report(done))


def reordered(tests):
    """The output of `show` makes the same scene again: names after those that they use, angles to the last bit, inputs that are no
    arguments of a command, definitions of several lines."""
    for script, want in (
            ("x := 1; y := 2; x := y + 1", "y := 2\nx := y + 1\n"), ("E0 = 210 GPa", "E0 = 210 GPa\n"), ("nu = 0.3", "nu = 0.3\n"),
            ("z := 1 + \\\n2", "z := 1 +   2\n"), ("z := 1 + \\\r\n2", "z := 1 +   2\n"), ("z := 1 + \\\r\r\n2", "z := 1 +    2\n"), ("z := 1 +\r2", "z := 1 + 2\n"),
            ("z := 3; y := z; x := y; w = 1; z := 2*w", "w = 1\nz := 2*w\ny := z\nx := y\n")):
        done = tests.run(input=script + "\nshow\n")
        again = tests.run(input=done.stdout + "show\n")
        tests.check("shown: " + repr(script), done.stdout == want and again.stdout == done.stdout and done.returncode == again.returncode == 0,
                    tests.report(done) + tests.report(again))
    r = random.Random(3)
    phases = [r.uniform(-7, 7) for _ in range(60)] + [r.random() * 10 ** r.uniform(-300, 0) for _ in range(20)]
    scene = SCENE + "cycle FA=1 N FNA=1 N phase=%r rad\n"
    kinds = {"deg": 0, "rad": 0}
    for phase in phases:
        shown = tests.run("-c", scene % phase + "show").stdout
        again = tests.run("--format=json", "-c", shown + "phase")
        kinds["rad" if " rad" in shown else "deg"] += 1
        tests.check("a phase of %r" % phase, harness.printed_values(again.stdout) == [phase], shown + again.stdout)
    tests.check("in degrees where these can say it", min(kinds.values()) > 5, str(kinds))


PRESSED = "+   FN = 100 N, a = 186.626 um, dz = 3.48291 um"


def judged(tests):
    """Differences that make a replay fail, and others: places of errors, long lines, tables, times, files, a missing last answer."""
    long = "set digits 17; table x, " + ", ".join("x^%d" % i for i in range(2, 12)) + " for x = 1 .. 3 steps 2"
    table = tests.run("-c", long).stdout
    accuracy = tests.run("-c", SCENE + "accuracy within 0.001").stdout
    where = os.path.join(tests.dir, "judged")
    os.mkdir(where)
    press = "fret> " + SCENE[:-1]
    for text, passed, failed in (
            ("fret> foo\nx.fret:3:1: error: unknown name 'foo'\n", 1, 0), ("fret> foo\nabc: error: unknown name 'foo'\n", 0, 1),
            ("fret> foo\nx.fret:3: error: unknown name 'foo'\n", 0, 1), ("fret> foo\n: error: unknown name 'foo'\n", 0, 1),
            ("fret> %s\n%s" % (long, table), 1, 0), ("fret> %s\n%s" % (long, table.replace("x^11", "x^12")), 0, 1),
            ("fret> %s\nx\n" % long, 0, 1), ("fret> 1 + \\\r\r\n....> 1\n1 + 1 = 2\n", 1, 0), ("fret> x = 2\n....> x\nx = 2\n", 2, 0),
            ("fret> 1\n1 = 1%s\n" % (" 1" * 150), 0, 1), ("fret> 1\n\n  \n1 = 1\n", 0, 1), ("fret> 1\n1 = 1\n\n  \n", 1, 0), ("fret> 1\n", 0, 1),
            ("fret> x = 1\nmore\n", 0, 1), ("fret> 1 + \\\n....> 1 + \\\n....> 1\n1 + 1 + 1 = 3\n", 1, 0),
            # a continued line takes the next line, with any prompt; at the end of the transcript it is run as it is
            ("fret> 1 + \\\nfret> 2\n1 + 2 = 3\n", 1, 0), ("fret> 1 + \\\n2\n1 + 2 = 3\n", 1, 0), ("fret> x = 2\nfret> x + 1 \\\n", 1, 1), ("fret> x = 2\nfret> y = x + 1 \\\n", 2, 0),
            (press + "\nfret> accuracy within 0.001\n" + accuracy + "fret> 1\n1 = 1\n", 3, 0),
            (press + "\nfret> accuracy within 0.001\nanything\nfret> 1\n1 = 2\n", 2, 1),
            (press + "\nfret> cycle FA=20 N\nfret> plot loop to loop.gp\nwrote loop.gp (9 B)\nfret> Fx\nFx = 20 N\n", 4, 0)):
        done = tests.run("--replay", "-", input=text, cwd=where)
        tests.check("judged: " + repr(text[:300]), done.stdout.endswith("-: %d passed, %d failed\n" % (passed, failed)) and not done.stderr and
                    done.returncode == (failed > 0), tests.report(done))
    tests.check("a replay writes files", os.path.getsize(os.path.join(where, "loop.gp")) > 100)
    with open(os.path.join(where, "in.txt"), "w", encoding="ascii") as f:
        f.write("fret> 1\n1 = 1\n")
    done = tests.run("--format=json", "-c", "replay in.txt; set format text; replay in.txt", cwd=where)
    tests.check("a replay in JSON", done.stdout == '{"text":"in.txt: 1 passed, 0 failed\\u000a"}\nin.txt: 1 passed, 0 failed\n', tests.report(done))
    scene = "fret> material steel; geometry sphere R=10 mm; friction 0.4\n"
    for lines, now in (  # of a failed answer the terminal's reports are shown only if the transcript has some
            ("fret> press FN=100 N\n  FN = 100 N, a = 188 um, dz = 3.48291 um\n", [PRESSED]),
            ("fret> press FN=100 N; cycle FA=20 N\n" + PRESSED[2:] + "\n  dW = 3 uJ, dx = 625.995 nm, c = 148.125 um\n",
             [PRESSED, "+   dW = 1.90646 uJ, Fx = 20 N, dx = 625.995 nm, c = 148.125 um"]),
            ("fret> press FN=100 N; a\n" + PRESSED[2:] + "\na = 188 um\n", [PRESSED, "+ a = 186.626 um"]),
            ("fret> press FN=100 N; a\na = 188 um\n", ["+ a = 186.626 um"]),
            ("fret> press FN=-100 N\nerror: FN is negative\n", ["+ error: FN = -100 N must be positive"]),
            ("fret> press FN=-100 N\nerror: FN is negative\n  press FN=-100 N\n           ^~~~~~\n",
             ["+ error: FN = -100 N must be positive", "+   press FN=-100 N", "+            ^~~~~~"])):
        done = tests.run("--replay", "-", input=scene + lines, cwd=where)
        told = [line for line in done.stdout.splitlines() if line.startswith("+")]
        tests.check("what comes now in place of " + lines, told == now and done.returncode == 1 and "\x01" not in done.stdout, tests.report(done))
    with open(os.path.join(where, "out.txt"), "w", encoding="ascii") as f:
        f.write("fret> 2\n2 = 3\n")
    right, wrong = "in.txt: 1 passed, 0 failed\n", "out.txt:1: fret> 2\n- 2 = 3\n+ 2 = 2\nout.txt: 0 passed, 1 failed\n"
    for files, out, status in ((("in.txt", "in.txt"), right + right, 0), (("in.txt", "out.txt"), right + wrong, 1),
                               (("out.txt", "in.txt"), wrong + right, 1), (("none.txt", "in.txt"), right, 1)):
        done = tests.run("--replay", *files, cwd=where)
        tests.check("several transcripts: %s, %s" % files, (done.stdout, done.returncode) == (out, status), tests.report(done))
    done = tests.run("--replay", "in.txt", "-c", "1", cwd=where)
    tests.check("a transcript and statements", done.returncode == 2 and "not -c" in done.stderr and not done.stdout, tests.report(done))


def pure(tests):
    where = os.path.join(tests.dir, "pure")
    os.mkdir(where)
    done = tests.run("--format=json", "--keep-going", "-c", LINES, cwd=where)
    kinds = set()
    for line in done.stdout.splitlines():
        try:
            kinds |= set(json.loads(line))
        except (ValueError, TypeError):
            tests.check("JSON: " + line[:80], False)
    tests.check("every line is one object", {"name", "text", "event", "model", "FN", "a"} <= kinds, str(kinds))
    transcript = os.path.join(where, "r.txt")
    done = tests.run("--format=json", "--replay", transcript)
    tests.check("a replay too", "text" in json.loads(done.stdout) and done.returncode == 0, tests.report(done))


def bytes_in_json(tests):
    """A file name may hold any bytes, but JSON only valid characters."""
    name = b"g\xff\xf0\x9f\x98\x80\x7f.csv"
    with open(os.path.join(os.fsencode(tests.dir), name), "wb") as f:
        f.write(b"r [mm],f [um]\n0,0\n1,50\n")
    done = tests.run("--format=json", input=b"geometry file " + name + b"\nshow\n")
    tests.check("a name of any bytes in JSON", done.returncode == 0 and json.loads(done.stdout)["text"] == "geometry file g\ufffd\U0001f600\x7f.csv\n" and
                "\\u007f" in done.stdout, tests.report(done))
    done = tests.run(input=b"geometry file " + name + b"\nshow\n")
    tests.check("and as text", done.stdout == "geometry file g\\xff\U0001f600\\x7f.csv\n", tests.report(done))


def targets(tests):
    where = os.path.join(tests.dir, "targets")
    os.mkdir(where)
    table = "table x, x^2 for x = 1 mm .. 2 mm steps 1 with y = 1, 2 to "
    done = tests.run("-c", "".join(table + "t." + ending + "\n" for ending in ("csv", "json", "txt", "dat")), cwd=where)
    tests.check("tables in every form", done.returncode == 0 and done.stderr.count("wrote t.") == 4, tests.report(done))

    def text(name):
        with open(os.path.join(where, name), encoding="utf-8") as f:
            return f.read()
    tests.check(".csv", text("t.csv").startswith("x [m],y,x (2) [m],x^2 [m^2]\n0.001,1,0.001,"), text("t.csv"))
    tests.check(".json", [row["x"] for row in harness.told(text("t.json"))] == [.001, .002] * 2,
                text("t.json"))
    tests.check(".txt", "x [mm]" in text("t.txt").splitlines()[0] and text("t.txt").count("\n\n") == 1, text("t.txt"))
    tests.check(".dat", text("t.dat") == text("t.txt"), text("t.dat"))
    # a table over two names: a block for each value of the second, upwards and downwards; a value may come again
    for way, second in (("upwards", "1 .. 3"), ("downwards", "3 .. 1"), ("in one place", "2 .. 2")):
        done = tests.run("-c", "table x*y for x = 1 .. 2 steps 1 for y = %s steps 2 to g.dat" % second, cwd=where)
        blocks = [[list(map(float, row.split())) for row in block.splitlines()] for block in text("g.dat").partition("\n")[2].split("\n\n")]
        low, high = map(float, second.split(" .. "))
        want = [[[x, y, x * y] for x in (1, 2)] for y in (low, (low + high) / 2, high)]
        tests.check("blocks of a grid " + way, done.returncode == 0 and (blocks == want if low != high else sum(blocks, []) == sum(want, [])),
                    text("g.dat") + tests.report(done))
    done = tests.run("-c", "table x for x = 1 .. 2 steps 1 to g.dat", cwd=where)
    tests.check("one block of a table", "\n\n" not in text("g.dat"), text("g.dat"))
    for name in ("t.xlsx", "t", "t.CSV.old"):
        done = tests.run("-c", table + name, cwd=where)
        tests.check("no table goes to " + name, "cannot tell the form of a table from '%s': use .csv, .json, .txt or .dat"
                    % name in done.stderr and done.returncode == 1, tests.report(done))
    home = {"HOME": where}
    done = tests.run("-c", table + "~/h.csv\nsave ~/s.fret\nsource ~/s.fret", cwd="/", env=home)
    tests.check("~ is the home directory", done.returncode == 0 and os.path.exists(os.path.join(where, "h.csv")),
                tests.report(done))
    with open(os.path.join(where, "gap.csv"), "w", encoding="ascii") as f:
        f.write("r [mm],f [um]\n0,0\n1,50\n")
    done = tests.run("-c", "material steel; geometry file ~/gap.csv; f(1 mm)", cwd="/", env=home)
    tests.check("a gap at home", done.stdout == "f(1 mm) = 50 um\n", tests.report(done))


def no_room(tests):
    """A full disk while recording: an error at once, the file has only whole lines, the session goes on; long lines; at any moment."""
    where = os.path.join(tests.dir, "no-room")
    os.mkdir(where)
    path = os.path.join(where, "full.txt")
    script = "record %s\n" % path + SCENE + "\n" + "a, dz\n" * 40 + "1234\n"
    done = subprocess.run([tests.fret], input=script, capture_output=True, text=True, env=tests.env, timeout=60, check=False,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000)))
    with open(path, encoding="utf-8") as f:
        kept = f.read()
    told = done.stderr.count("cannot write %s: File too large; what follows is not recorded" % path)
    tests.check("no room for a transcript", done.returncode == 1 and told == 1 and done.stdout.endswith("1234\n") and
                kept.endswith("\n") and 500 < len(kept) <= 1000, tests.report(done) + kept)
    done = tests.run(input="record r\n" + "1 + 1 # %s\n1%s\nmu = 0.3\n" % ("x" * 1500, "+1" * 60), cwd=where)
    with open(os.path.join(where, "r"), encoding="ascii") as f:
        text = f.read()
    again = tests.run("--replay", "r", cwd=where)
    tests.check("long lines, and a last one without an answer", text.partition("\n")[2].startswith("fret> 1 + 1 # %s\n1 + 1 = 2\n" % ("x" * 1500)) and
                text.endswith("\nfret> mu = 0.3\n") and again.returncode == 0, text + tests.report(done))
    os.mkfifo(os.path.join(where, "pipe"))
    done = tests.run("-c", "record pipe; 1", cwd=where)
    tests.check("a pipe that nobody reads", done.returncode == 1 and "cannot write pipe: " in done.stderr, tests.report(done))
    tool = os.path.join(os.path.abspath(tests.build), "tests", "calls")
    if tests.sanitized or not os.path.exists(tool) or subprocess.run(
            [tool, os.devnull, "none", "0", "0", "/bin/true"], check=False, stderr=subprocess.DEVNULL).returncode:
        return
    for name in ("arm", "disarm"):
        with open(os.path.join(where, name), "w", encoding="ascii"):
            pass
    wrong, count, harmless, whole = [], 0, set(), None
    while whole is None and count < 200:
        count += 1
        path = os.path.join(where, "told")
        done = subprocess.run([tool, path, "write", str(count), "28", tests.fret, "--keep-going"], capture_output=True, text=True, cwd=where,
                              input="record full.txt\nsource arm\n1 + 1\nsource disarm\nrecord off\n2\n", env=tests.env, check=False)
        with open(os.path.join(where, "full.txt"), encoding="utf-8") as f:
            text = f.read()
        with open(path, encoding="ascii") as f:
            whole = text if "FAILED" not in f.read() else None
        lost, silent = done.stderr.count("what follows is not recorded"), "cannot write to standard output" in done.stderr
        if done.returncode == 0:
            harmless.add(text)
        elif lost + silent < 1 or lost > 1 or not (text.endswith("\n") or not text) or (done.stdout != "1 + 1 = 2\n2 = 2\n" and not silent):
            wrong.append("%d: %s" % (count, tests.report(done) + text[-200:]))
    tests.check("no room at any moment", 2 < count < 200 and not wrong and harmless == {whole}, "%d\n%s" % (count, "\n".join(wrong[:3])))


def in_use(tests):
    """Files that are open for writing are refused as targets under any name: the recording, and standard output."""
    where = os.path.join(tests.dir, "in-use")
    os.mkdir(where)
    data = "FN [N],Fx [N]\n100,0\n100,10\n"
    with open(os.path.join(where, "h.csv"), "w", encoding="ascii") as f:
        f.write(data)
    kept = "rs.txt"
    for ending in ("txt", "csv", "svg", "gif"):
        os.symlink(kept, os.path.join(where, "link." + ending))
    scene = SCENE + "cycle FA=20 N\n"
    for ending, statement in (
            ("txt", "save %s"), ("txt", "table x for x = 1 .. 2 to %s"), ("csv", "history to %s"), ("csv", "table Fx along cycle to %s"),
            ("svg", "plot loop to %s"), ("gif", "animate loop frames 2 to %s"), ("csv", "export jenkins 3 to %s"),
            ("txt", "record %s")):
        for name in ("link." + ending, "../in-use/link." + ending, *([kept, "../in-use/" + kept] if ending == "txt" else ())):
            said = statement % name
            done = tests.run("--keep-going", "-c", "record %s\n1+1\n%s%s\n77+1\nrecord off" % (kept, scene, said), cwd=where)
            with open(os.path.join(where, kept), encoding="utf-8") as f:
                text = f.read()
            tests.check("recorded, no target: " + said, "error: cannot write %s: this session is using it\n" % name in done.stderr and done.returncode == 1 and
                        "1+1 = 2" in text and "77+1 = 78" in text, tests.report(done) + text[-300:])
    done = tests.run("-c", "record a.txt; 1\nrecord b.txt\n2\nrecord off\ntable x for x = 1 .. 2 to a.txt", cwd=where)
    tests.check("recorded no more, a target again", done.returncode == 0 and "\noverwrote a.txt (" in done.stderr, tests.report(done))
    done = tests.run("--keep-going", "-c", "record a.txt\n1\nrecord /nonexistent/x\n2\nrecord off", cwd=where)
    with open(os.path.join(where, "a.txt"), encoding="utf-8") as f:
        text = f.read()
    tests.check("a recording that cannot begin ends none", done.returncode == 1 and text.endswith("fret> 2\n2 = 2\n"), tests.report(done) + text)
    done = tests.run("-c", "record one.txt\n1\nrecord two.txt\n2\nrecord off", cwd=where)
    told = re.findall(r"^wrote (.*) \((\d+) B\)$", done.stderr, re.M)
    sizes = [(name, str(os.path.getsize(os.path.join(where, name)))) for name in ("one.txt", "two.txt")]
    tests.check("the end of a recording tells what it wrote", told == sizes and done.returncode == 0, tests.report(done))
    done = tests.run("-c", "set report off; record one.txt; 1; record off", cwd=where)
    tests.check("not where reports are off", done.returncode == 0 and "wrote one" not in done.stderr, tests.report(done))
    tests.run("--keep-going", "-c", "record again.txt\nmu = 0.3\nsave again.txt\nmu\nrecord off", cwd=where)
    with open(os.path.join(where, "again.txt"), encoding="utf-8") as f:
        text = f.read()
    for way in (("--replay", "again.txt"), ("-c", "replay again.txt")):
        done = tests.run(*way, cwd=where)
        with open(os.path.join(where, "again.txt"), encoding="utf-8") as f:
            tests.check("a transcript that is replayed is no target: %s %s" % way, f.read() == text, text)
        tests.check("and comes out again: %s %s" % way, done.stdout.endswith(": 3 passed, 0 failed\n"), tests.report(done))
    for statement in ("save out.txt", "table x for x = 1 .. 2 to out.txt", "record out.txt", "record /dev/stdout"):
        with open(os.path.join(where, "out.txt"), "wb") as out:
            done = subprocess.run([tests.fret, "--keep-going", "-c", "mu = 0.3; 1+1\n%s\n77+1" % statement], stdout=out, stderr=subprocess.PIPE, env=tests.env, cwd=where,
                                  timeout=60, check=False)
        with open(os.path.join(where, "out.txt"), encoding="utf-8") as f:
            text = f.read()
        tests.check("standard output, no target: " + statement, done.returncode == 1 and b": this session is using it\n" in done.stderr and
                    text == "1+1 = 2\n77+1 = 78\n", "%s%s" % (done.stderr, text))
    rows = "dx [um],Fx [N],force [N],sample,v1\n" + "".join("%.12g,%.12g,%d,%d,1\n" % (math.sin(i / 4), 10 * math.sin(i / 4 + 0.3), i + 1, i + 1) for i in range(60))
    os.symlink("read.csv", os.path.join(where, "other.csv"))
    os.symlink("by.fret", os.path.join(where, "link.fret"))
    for statement in ("loop %s to %s", "table dz(force) at %s to %s", "table dz(force) at other.csv to read.csv", "source by.fret", "loop ./%s to ../in-use/%s"):
        for read, written in (("read.csv", "read.csv"), ("other.csv", "read.csv"), ("read.csv", "other.csv")):
            for name, text in (("read.csv", rows), ("by.fret", "1 + 1\nsave link.fret\n2 + 2")):
                with open(os.path.join(where, name), "w", encoding="ascii") as f:
                    f.write(text)
            said = statement % (read, written) if "%" in statement else statement
            done = tests.run("-c", SCENE + said, cwd=where)
            with open(os.path.join(where, "read.csv"), encoding="ascii") as f, open(os.path.join(where, "by.fret"), encoding="ascii") as script:
                tests.check("read, no target: %s" % said, done.returncode == 1 and ": this session is using it\n" in done.stderr and f.read() == rows and
                            script.read() == text, tests.report(done))
    done = tests.run("-c", SCENE + "loop read.csv; table dz(force) at read.csv; table dz(x) for x = 1 N .. 2 N to read.csv", cwd=where)
    tests.check("read before, a target", done.returncode == 0 and "\noverwrote read.csv (" in done.stderr, tests.report(done))
    done = tests.run("-c", "record /dev/null\ntable x for x = 1 .. 2 to /dev/null\nrecord off\ntable x for x = 1 .. 2 to /dev/stdout")
    tests.check("a device is one for all", done.returncode == 0 and done.stdout.count("\n") == 22 and not done.stderr, tests.report(done))


def run(tests):
    for room in (copies, recorded, no_room, in_use, quoted, saved, reordered, judged, pure, bytes_in_json, targets):
        room(tests)
