# SPDX-License-Identifier: GPL-3.0-or-later
"""Injects faults: one allocation or one system call fails, or an interrupt comes at one allocation, at every place where it can.
The statement must then give the right answer, or an error that names the fault and leaves the scene and all files as before.
`faults.py FRET TESTS [STATEMENT...]` tries all places and prints a table; the tests try some. TESTS: the folder with faults.so and
calls. `faults.py --leaks FRET TESTS [STATEMENT...]` looks for memory leaked after failed allocations; both built with -fsanitize=leak."""
import contextlib
import difflib
import errno
import math
import fcntl
import os
import pty
import re
import select
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import termios
import time
from concurrent.futures import ThreadPoolExecutor

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "interactive"))
from screen import Screen  # noqa: E402

POWER = "material E0=210 GPa nu=0.3 k=0.5 c0=1 mm; geometry sphere R=10 mm; friction 0.4; x = 3; F(y) := y^2"
LOADED = POWER + "; long := x*dW" + 40 * " + 0*dW" + "; press FN=100 N; step Fx=20 N; cycle FA=20 N"
TABLE = "material steel; friction 0.4; geometry file gap.csv; press FN=10 N; cycle FA=2 N"
SUM = "material steel; friction 0.4; geometry sum 2:50 m^-1, 4:2e6 m^-3; press FN=10 N; step Fx=1 N"
NESTED = POWER + "; press FN=100 N" + "".join("; step Fx=%d N" % ((-1) ** i * (20 - 2 * i)) for i in range(10))
NAMES = "x = 1; y = 2; q = 3; z = 4"
SWUNG = POWER + "; press FN=100 N; cycle FA=9 N FNA=10 N"
MOST = 2000  # allocations of a statement that are made to fail
STEEL = "material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N"

# a setup, and the statements that are tried after it
STATEMENTS = (
    (POWER, ("y = 3 mm, z = x + 1", "z := x^2", "G(u, v) := u + v*x", "k = 0.3", "c0 := 2 mm*x", "undo", "x, x^2 in %",
             "F(3), (x at x=5), (F(x) at x=5)", "material steel nu=0.2", "second E0=70 GPa nu=0.33", "second aluminium",
             "geometry cone angle=3 deg", "geometry sum 2:50 m^-1, 4:2e6 m^-3", "geometry power n=3 A=50 m^-2",
             "geometry file gap.csv", "geometry file gap.csv smooth",
             "geometry file rough.csv smooth", "geometry file rough.csv smooth 6",
             "geometry file rough.csv smooth 20 um", "geometry file rough.csv smooth using r=1, f=f", "friction 0.3", "press FN=100 N", "press a=0.2 mm", "press dz=1 um", "reset all",
             "set digits 9", "set format json", "set format json; help press; show commands", "show",
             "show variables", "show units", "show settings",
             "show commands", "show demos", "help", "help press", "help units", "apropos contact", "apropos radius",
             "table x^2, y for y = 1 .. 5 steps 4 to out.csv", "table a(y) for y = 1 N .. 9 N steps 300",
             "table y, x for y = 1 .. 9 steps 600", "save ~/out.fret", "table x for y = 1 .. 2 steps 1 to /dev/stdout", "demo", "demo pressing", "1" + "+1" * 300, "explain kappa",
             "0." + "0" * 120 + "1 + 1", "source script.fret", "explain Estar", "set format json; explain Estar",
             "demo ./lesson.txt", "demo ./lesson.txt to out.html", "record log.html", "exit")),
    (LOADED, ("step Fx=5 N", "step Fx+=1 N FN=110 N", "step dx=0.1 um steps 20", "cycle dxA=0.1 um times 2",
              "cycle FA=20 N FNA=10 N phase=90 deg", "cycle FA:=0.5*mu*FN", "follow follow.csv", "FA = 10 N", "mu = 0.3",
              "FA := 0.4*mu*FN", "k = 0.2, x = 5", "undo", "reset", "history", "history to out.csv", "history to out.json", "export loop to out.json steps 3",
              "dW, Fx, W, c, a, kt", "dW at k=0", "explain dW", "explain a", "explain x*dW",
              "table dW for FA = 1 N .. 20 N steps 5", "table dW for FA = 1 N .. 9 N steps 2 with mu = 0.3, 0.4",
              "table dW for FA = 1 N .. 9 N steps 2 for mu = 0.3 .. 0.4 steps 2",
              "table Fx, dx along program steps 10", "table Fx along cycle steps 9 to out.dat",
              "table Fx, W along cycle FA=10 N steps 8", "table Fx, (W at k=0.1), ((c at mu=0.5) at k=0) along program steps 3", "table Fx along step Fx=25 N steps 4",
              "qx(0.1 mm), ux(0.1 mm), p(0), uz(0.5 mm)", "w1D(0), u1D(0), s1D(0)", "accuracy within 0.001",
              "set model springs 100", "plot loop to out.gp", "plot traction to out.gp", "plot springs to out.gp",
              "plot dW for FA = 1 N .. 20 N steps 5 to out.gp", "plot loop", "plot loop | pressure to out.svg",
              'plot loop title "%s" to out.gp' % ("long " * 4000), "plot dW for FA = 1 N .. 9 N with k = 0, 0.5",
              "set plot terminal block; plot loop",
              "plot map dW for FA = 1 N .. 9 N steps 5 for mu = 0.3 .. 0.5 steps 5",
              "plot map dW for FA = 1 N .. 9 N steps 5 for mu = 0.3 .. 0.5 steps 5 to out.gp",
              "plot FN against Fx along program over follow.csv to out.gp",
              "animate loop frames 3 to out.gif", "animate Fx against dx along cycle FA=5 N frames 2 to out.gif",
              "animate loop frames 3",
              "set format json; plot loop", "set format json; animate loop frames 3",
              "plot dW(force) for force = 1 N .. 20 N steps 5 to out.gp", "plot accuracy within 0.001",
              "animate loop along cycle FA:=FN/10 frames 3 to out.gif", "animate Fx/width against dx along program with width = 1 N, 2 N frames 2 to out.gif",
              "explain 2*long", "set digits 9; set plot 70x20; set pager off; record log.txt",
              "save out.fret", "record log.txt", "show", 'ask "a?" = a in mm within 5 % hint "b"', 'ask "Where?" of "here", "there" = 2', "press FN=50 N", "geometry cone slope=0.1",
              "quit")),
    (NESTED + "; set format csv; history to both.csv; set format text; reset", ("follow both.csv",)),
    (NESTED + "; set report off; follow long.csv", ("W, a", "plot Fx along program to out.gp")),
    (STEEL, ("solve FN for a = 0.2 mm", "maximize dWd(0.5 um) over FN = 1 N .. 100 N",
             "minimize dz over FN = 20 N .. 100 N", "fit E0 for depth = dz(force) to measured.csv",
             "fit mu along loop.csv", "loop cycle.csv using dx=Weg um", "loop cycle.csv using dx=2 um to out.csv", "follow loop.csv", "uncertainty a, dWd(1 um) with mu +- 0.02, E0 +- 5 % samples 20",
             "set format csv; uncertainty a, dWd(1 um) with mu +- 0.02, E0 +- 5 % samples 20", "set format csv; fit E0 for depth = dz(force) to measured.csv",
             "solve unknown for unknown^2 = 2 from 1 to 2", "maximize unknown*(2-unknown) over unknown = 0 .. 3", "set format json; replay replay.txt",
             "export jenkins 8 to out.csv", "export jenkins 4 to out.h FA=20 N", "export harmonic to out.csv for dxA = 0 um .. 1 um steps 3",
             "uncertainty a with mu +- 0.02, E0 +- 5 % samples 3 from samples.csv", "replay replay.txt", "accuracy within 0.001",
             "table dz(force), a at measured.csv", "table dz(force) at measured.csv with k = 0, 0.1 to out.csv", "plot dz(force) at measured.csv to out.gp",
             "plot dz(force) for force = 1 N .. 99 N over measured.csv residuals to out.gp", "cite",
             "plot regimes for dxA = 0 um .. 2 um for FN = 1 N .. 9 N to out.gp", "set plot caption on; plot pressure",
             "set plot caption on; plot regimes for FN = 1 N .. 9 N for dxA = 0 um .. 2 um | pressure to out.svg")),
    (TABLE, ("step Fx=1 N", "dW, a, Fx", "cycle FA=2 N FNA=1 N", "geometry file gap.csv", "k = 0.2, c0 = 1 mm",
             "explain dW", "show", "p(0.01 mm)", "accuracy within 0.001")),
    (LOADED + "; set model springs 40", ("Fx, W", "dW", "history", "explain W", "cycle FA=10 N")),
    # searches: all allocations are made by their evaluations, which repeat
    (NAMES, ("minimize ((z-1)^2 at z=x) over x = 0 .. 3", "maximize (z+0*sqrt(1-z) at z=x) over x = 0.2 .. 3",
             "minimize ((z-1)^2+(y-2)^2+z*y/9 at z=x) over x = 0 .. 3, y = 0 .. 3", "minimize (abs(z-1) at z=x) over x = 0 .. 3",
             "minimize (z^2 at z=x) over x = 0 .. 3", "minimize (abs(z-1)+abs(y-1) at z=x) over x = 0 .. 3, y = 0 .. 3",
             "minimize (z+y at z=x) over x = 0 .. 3, y = 0 .. 3",
             "minimize (z+(y-1.3)^2 at z=x) over x = 0 .. 3, y = 0 .. 3",
             "maximize (z+y+0*sqrt(2-z-y) at z=x) over x = 0.1 .. 3, y = 0.1 .. 3",
             "solve x for (z^2 at z=x) = 2", "solve x for (sqrt(z-1.1) at z=x) = 0.05", "solve x for ((z-1.2)^2 at z=x) = 0",
             "solve x for ((z-12.5)^2 at z=x) = 0 from 0 to 24", "solve x for (tan(z*(1 rad)) at z=x) = 0.5 from 1 to 5",
             "fit q for depth/(1 um) = (q*z at z=force/(1 N)) to measured.csv",
             "fit q, y for depth/(1 um) = q*(force/(1 N))^y to measured.csv",
             "minimize (x-1)^2+(y-2)^2+x*y/9 over x = 0 .. 3, y = 0 .. 3",
             "uncertainty (z^2 at z=x) with x +- 0.1 samples 20", "uncertainty (z^2*y at z=x), y with x +- 0.1, y +- 0.2",
             "table (z at z=x) for x = 1 .. 3 steps 5", "table (z*y at z=x) for x = 1 .. 3 steps 2 with y = 1, 2",
             "plot map (z*y at z=x) for x = 1 .. 3 steps 3 for y = 1 .. 2 steps 3 to out.gp")),
    (SWUNG, ("k = 0.2, c0 = 1 mm", "qx(0.1 mm), W", "accuracy within 0.001", "table Fx, W along cycle steps 4",
             "table kn, W1D, dW along program steps 4", "table (W at mu=0.5) along cycle steps 4", "explain W", "step dx=0.1 um",
             "step dx=30 um")),
    (SWUNG.replace("FA=", "dxA:=1e-8 m/N*"), ("k = 0.2, c0 = 1 mm", "qx(0.1 mm), W", "accuracy within 0.001",
                                             "table c, kt along cycle steps 4", "step FN=90 N Fx=1 N")),
    (TABLE.replace("cycle FA=2 N", "step FN=9 N Fx=1 N; cycle FA=1 N"), ("accuracy within 0.001", "w1D(0 m), qz1D(0 m), W",
                                                                       "table c(F) for F = 1 N .. 3 N steps 3")),
    (SUM, ("cycle FA=1 N", "W, dW(1 N)", "FN = 20 N", "explain W", "qx(0.01 mm)", "dW(1 N), dx(1 N)")),
)

# the errors with which calls fail; EIO for those not listed
CODES = {"read": ("EIO", "EINTR", "EAGAIN"), "write": ("ENOSPC", "EIO", "EINTR"), "open": ("EMFILE", "EACCES", "EINTR"),
         "close": ("EIO", "EINTR"), "fsync": ("EIO", "ENOSPC"), "rename": ("EIO", "ENOSPC", "EACCES"),
         "unlink": ("EIO", "EACCES"), "mkdir": ("ENOSPC", "EMFILE"), "fork": ("EAGAIN", "ENOMEM"),
         "wait": ("EINTR", "ECHILD"), "mmap": ("ENOMEM",), "exec": ("EACCES", "ENOMEM", "EMFILE"),
         "fcntl": ("EMFILE",), "dup": ("EMFILE", "EINTR"), "pipe": ("EMFILE",), "poll": ("EINTR", "ENOMEM"),
         "getrandom": ("EINTR", "EAGAIN"), "ioctl": ("ENOTTY",), "lseek": ("ESPIPE",)}
# families of system calls that do the same
FAMILIES = {"openat": "open", "pread64": "read", "writev": "write", "renameat": "rename", "renameat2": "rename",
            "unlinkat": "unlink", "rmdir": "unlink", "mkdirat": "mkdir", "clone": "fork", "clone3": "fork",
            "vfork": "fork", "wait4": "wait", "waitid": "wait", "mremap": "mmap", "execve": "exec",
            "dup2": "dup", "dup3": "dup", "pipe2": "pipe", "ppoll": "poll"}
ALLOCATION, INTERRUPT = "allocation", "interrupt"
LIVE = ("log.txt", "log.html")  # files written while the session goes on
LOST_OUTPUT = "error: cannot write to standard output"
INTERRUPTED = 130  # the exit status
LAST_WORD = "without a word to the terminal"
AGAIN = 4  # how many calls in a row fail, of those that only wait
PATIENCE, HUNG = 120, 124  # seconds for a statement, and the exit status if it takes longer


def codes_of(call):
    return [getattr(errno, name) for name in CODES.get(FAMILIES.get(call, call), ("EIO",))]


def prepare(where):
    """Writes the files that the statements read, and one that must stay as it is."""
    texts = {"arm": "", "disarm": "", "script.fret": "x\nx + 1; x + 2\n",
             "gap.csv": "r [mm],f [um]\n" + "".join("%g,%g\n" % (i / 50, i * i / 50) for i in range(40)),
             "rough.csv": "r [mm],f [um],note,more\n" + "".join("%g,%g,a word\n" % (i / 50, max(0, i * i / 50 + 8 * math.sin(2 * i)))
                                                           for i in range(40)),
             "follow.csv": "FN [N],Fx [N],force [N]\n" + "".join("%g,%g,%g\n" % (100 + i / 9, 20 - i / 9, 50 - i / 4)
                                                                 for i in range(180)),
             "long.csv": "FN [N],Fx [N]\n" + "".join("%.9g,%.9g\n" % (100 + 10 * math.sin(i / 7), 20 * math.sin(i / 3)) for i in range(4500)),
             "measured.csv": "force [N],depth [um]\n" + "".join("%g,%g\n" % (10 * i, 0.75 * i ** 0.667)
                                                                for i in range(1, 12)),
             "cycle.csv": "N;Weg;Kraft [N]\n" + "".join("%d;%g;%g\n" % (i, 2 * math.cos(i / 5), 30 * math.cos(i / 5 + 0.4)) for i in range(70)),
             "loop.csv": "dx [um],Fx [N]\n" + "".join("%g,%g\n" % row for row in (
                 (0.1, 3.5), (0.3, 10.2), (0.6, 19.2), (0.3, 9.5), (0, 0), (-0.3, -9.5), (-0.6, -19.2))),
             "samples.csv": "v1 [m],sample\n1e-4,1\n,2\n2e-4,3\n",
             "lesson.fret": "# A lesson\nstep Fx=20 N\n",
             "lesson.txt": "A lesson\n# How wide?\nmaterial steel; geometry sphere R=10 mm; press FN=100 N\nask \"a?\" = a within 5 %\nplot pressure\n",
             "replay.txt": "fret> x = 2\nfret> x + \\\n....> 1\nx + 1 = 3\nfret> set format csv\nfret> table y^2 for y = 1 .. 40 steps 39\ny,y^2\n" +
             "".join("%d,%d\n" % (i, i * i) for i in range(1, 41)) + "fret> 2^C\nerror: unknown name 'C': did you mean c?\nfret> x = 3 \\\n....> + 1\nfret> x\nx\n4\n", "log.txt": "", "log.html": ""}
    for name, text in texts.items():
        with open(os.path.join(where, name), "w", encoding="ascii") as f:
            f.write(text)
    for ending in ("csv", "json", "dat", "gp", "svg", "gif", "fret", "h", "html"):
        with open(os.path.join(where, "out." + ending), "w", encoding="ascii") as f:
            f.write("old\n")


def files(where):
    """{name: content} of the directory."""
    found = {}
    for name in sorted(os.listdir(where)):
        with open(os.path.join(where, name), "rb") as f:
            found[name] = f.read()
    return found


def differ(want, got):
    return "\n".join(line for line in difflib.ndiff(want.splitlines(), got.splitlines()) if line[0] in "+-")


class Faults:
    """One statement, which is run once for each fault. A fault is (what fails, its number, error code); None: no fault."""
    given = None  # standard input of the program
    most = 500  # the most system calls and interrupts that are tried

    def __init__(self, fret, tests, env, setup, statement):
        self.fret, self.tests, self.env, self.statement = fret, tests, env, statement
        self.tells_times = "accuracy" in statement
        self.script = "".join(line + "\n" for line in
                              (setup, "show", "source arm", statement, "source disarm", "set format text", "set digits 6",
                               "1234567", "show", "show variables"))

    def run(self, fault, count=None, script=None):
        """Runs the script with a fault: (exit status, output, messages, files, number of places counted)"""
        where = tempfile.mkdtemp(prefix="fret-faults-")
        told = where + ".told"
        tmp = where + ".tmp"
        os.mkdir(tmp)
        env = {**self.env, "TMPDIR": tmp, "HOME": tmp, "FRET_FAULTS": "1"}  # read by tests/coverage.c
        argv = [self.fret, *self.arguments(script or self.script)]
        what, number, code = fault or (count, 0, 0)
        if what in (ALLOCATION, INTERRUPT):
            env.update({"FAULT_INTERRUPT": "1"} if what == INTERRUPT else {}, LD_PRELOAD=os.path.join(self.tests, "faults.so"), FAULT=str(number), FAULT_COUNT=told)
        elif what:
            argv = [os.path.join(self.tests, "calls"), told, what, str(number), str(code), *argv]
        try:
            prepare(where)
            with open(os.path.join(where, "main.fret"), "w", encoding="ascii") as f:
                f.write(script or self.script)
            status, out, err = self.start(argv, where, env)
            os.unlink(os.path.join(where, "main.fret"))
            left = files(where)
            seen = ""
            if os.path.exists(told):
                with open(told, encoding="ascii") as f:
                    seen = f.read()
            if os.listdir(tmp):
                left["left in TMPDIR"] = os.listdir(tmp)
            return status, out, err, left, seen
        finally:
            shutil.rmtree(where)
            shutil.rmtree(tmp, ignore_errors=True)
            if os.path.exists(told):
                os.unlink(told)

    def arguments(self, script):
        return ["--keep-going", "-c", script]

    def start(self, argv, where, env):
        try:
            done = subprocess.run(argv, cwd=where, input=self.given, capture_output=True, env=env, timeout=PATIENCE, check=False)
        except subprocess.TimeoutExpired:
            return HUNG, "", "it did not end within %d s" % PATIENCE
        return done.returncode, done.stdout.decode(), done.stderr.decode()

    def changed(self, wants, left, what):
        """The files that are as in none of `wants`; a file left by a removal that failed does not count."""
        if FAMILIES.get(what, what) == "unlink":
            left = {name: text for name, text in left.items()
                    if name != "left in TMPDIR" and not name.startswith(".fret-")}
        names = {name for some in (left, *wants) for name in some} - {*LIVE}
        return [name for name in sorted(names) if all(want.get(name) != left.get(name) for want in wants)]

    def try_one(self, fault, right):
        """Runs with one fault and judges it: "refused", "harmless", "not reached", or what is wrong."""
        what = fault[0]
        status, out, err, left, seen = self.run(fault)
        if what == INTERRUPT:
            return self.interrupted(status, out, err, left, right)
        if what != ALLOCATION and "FAILED\n" not in seen:
            return "not reached"
        before, final = right[1].partition("\n1234567 = ")[0], out.rpartition("1234567 = ")[2]
        if status == 0:
            changed = self.changed([right[3]], left, what) + [n for n in LIVE if left[n] != right[3][n]]
            if not self.tells_times and (out != right[1] or changed):
                return "ends well with another answer\n%s\n%s" % (differ(right[1], out), " ".join(changed))
            return "harmless"
        if status != 1:
            return "exit %d\n%s" % (status, err)
        if what == ALLOCATION and "memory" not in err and "Cannot allocate" not in err:
            return "a message that does not say so: " + err
        if not err.strip() and what != "write":
            return "an error without a message"
        if LOST_OUTPUT in err and FAMILIES.get(what, what) in ("write", "close"):
            changed = self.changed([self.files, right[3]], left, what)
            return "%s changed\n%s" % (" ".join(changed), err) if changed else "refused"
        started = out.partition("\n")[0]
        if not before.startswith(started):
            return "another beginning"
        first = [line for line in err.splitlines() if "error:" in line][:1]
        if first and first[0].startswith("-c:5:"):  # the fault came in the line after the statement
            return "refused"
        if "1234567 = " in out and final != self.kept:
            return "the scene changed, or what follows fails:\n" + differ(self.kept, final) + "\n" + err
        changed = self.changed([self.files], left, what)
        return "%s changed\n%s" % (" ".join(changed), err) if changed else "refused"

    def interrupted(self, status, out, err, left, right):
        """Judges an interrupt: the script must end at the latest where the next statement begins."""
        if status == 0:
            return "harmless" if self.tells_times or out == right[1] else "ends well with another answer\n" + differ(right[1], out)
        told = re.findall(r"error: (.*)", err)
        silent = self.statement == "a transcript"
        if status != INTERRUPTED or not (told or silent) or not all("nterrupted" in line for line in told):
            return "exit %d\n%s" % (status, err)
        changed = self.changed([self.files, right[3]], left, INTERRUPT)
        return "%s changed\n%s" % (" ".join(changed), err) if changed else "refused"

    def reference(self, count):
        """Runs without a fault, and records the scene and the files before the statement."""
        bare = self.run(None, None, self.script.replace("source arm\n%s\nsource disarm\n" % self.statement, "", 1))
        self.kept, self.files = bare[1].rpartition("1234567 = ")[2], bare[3]
        return self.run(None, count)


class ToTheEnd(Faults):
    """The same for a whole script and the end of the program, by one of the ways to pass it."""
    ways = {"-c": lambda script: ["-c", script], "a file": lambda script: ["main.fret"], "standard input": lambda script: [],
            "a transcript": lambda script: ["--replay", "main.fret"]}

    def __init__(self, fret, tests, env, way):
        super().__init__(fret, tests, env, STEEL, way)
        self.script = "%s\nsource arm\nstep Fx=20 N\nFx, c\nshow\n" % STEEL
        self.arguments = self.ways[way]
        if way == "a transcript":
            self.script = "fret> %s\nfret> source arm\nfret> y = 3\nfret> y\ny = 3\nfret> step Fx=20 N\n" % STEEL
        self.given = self.script.encode() if way == "standard input" else None

    def try_one(self, fault, right):
        status, out, err, left, seen = self.run(fault)
        if fault[0] == INTERRUPT:
            return self.interrupted(status, out, err, left, right)
        if fault[0] != ALLOCATION and "FAILED\n" not in seen:
            return "not reached"
        if self.changed([self.files], left, fault[0]):
            return "files changed"
        if status == 0:
            return "harmless" if out == right[1] else "ends well with another answer\n" + differ(right[1], out)
        told_of = "error:" in err or (not err and fault[0] == "write")
        return "refused" if status == 1 and told_of else "exit %d\n%s" % (status, err)

    def reference(self, count):
        right = self.run(None, count)
        self.files = right[3]
        return right


class OnScreen(Faults):
    """The same for the full-screen mode. It shows an error on its screen and goes on: if the scene differs, an error was shown."""
    played, most = "live lesson.fret", 300

    def __init__(self, fret, tests, env, statement):
        super().__init__(fret, tests, {**env, "LC_ALL": "C.UTF-8"}, STEEL, statement)

    def try_one(self, fault, right):
        status, out, err, left, seen = self.run(fault)
        if fault[0] not in (ALLOCATION, INTERRUPT) and "FAILED\n" not in seen:
            return "not reached"
        if status == LAST_WORD and fault[0] == "write" and "read" not in seen.partition("FAILED\n")[2]:
            return "harmless"  # a fault after the last key, while the screen is left
        if status not in ((0, INTERRUPTED) if fault[0] == INTERRUPT else (0, 1)):
            return "exit %s\n%s" % (status, err)
        if self.changed([self.files, right[3]], left, fault[0]):
            return "files changed"
        if fault[0] == INTERRUPT:  # Ctrl-C is a key that leaves
            return "refused"
        told_of = re.search("error: |out of memory", err + out)
        if status and not told_of:
            return "an error without a message"
        if self.scene(out) == self.scene(right[1]):
            return "refused" if told_of else "harmless"
        return "refused" if told_of else "another scene, and not a word\n" + differ(self.scene(right[1]), self.scene(out))

    def scene(self, out):
        return out.rpartition("1234567 = ")[2]


class ByKeys(OnScreen):
    """The same with keys at a terminal, which must be as before in the end."""
    most = 100
    keys = ("l", "f", ":x = 3\r", "?", "x", ":compare k = 0, 0.2\r", "l", ":compare\r", "u", ":\x1b[A\x15pr\t\x1b", ":show commands\r", "x",
            ":table x for x = 1 .. 2 to out.csv\r", "c", "b", "q")

    steps = " ", "b", " ", "q"  # keys that step through a script

    def __init__(self, fret, tests, env, statement="live"):
        super().__init__(fret, tests, {**env, "TERM": "xterm-256color"}, statement)
        self.keys = self.keys if statement == "live" else self.steps

    def start(self, argv, where, env):
        terminal, ours = pty.openpty()
        fcntl.ioctl(ours, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 80, 0, 0))
        modes, screen, seen, shown = termios.tcgetattr(ours), Screen(24, 80), "", ""

        def read(seconds):
            """Output until none comes for `seconds`."""
            text = ""
            while select.select([terminal], [], [], seconds)[0]:
                text += os.read(terminal, 1 << 16).decode(errors="replace")
                seconds = min(seconds, 0.02)
            screen.feed(text)
            return text
        with subprocess.Popen(argv, cwd=where, stdin=ours, stdout=ours, stderr=subprocess.PIPE, env=env, start_new_session=True) as job:
            end = time.time() + 120
            while job.poll() is None and time.time() < end:
                now = read(0.05)
                shown += now
                raw = not termios.tcgetattr(ours)[3] & termios.ICANON
                if "\x1b[?1049h" in shown or (raw and not now):  # the message may have been lost itself
                    break
            for key in self.keys if job.poll() is None else ():
                os.write(terminal, key.encode())
                shown += read(0.5)
                seen += screen.text()
            while job.poll() is None and time.time() < end:
                shown += read(0.05)
            with contextlib.suppress(ProcessLookupError):
                os.killpg(job.pid, signal.SIGKILL)  # `calls` and the program that it runs
            shown += read(0)
            err = job.stderr.read().decode()
        restored = termios.tcgetattr(ours) == modes
        left = shown.rfind("\x1b[?1049l") >= shown.rfind("\x1b[?1049h")
        os.close(terminal)
        os.close(ours)
        return job.returncode if restored and left else LAST_WORD if restored else "with another terminal", shown.replace("\r\n", "\n"), err + seen


def statements(fret, tests, env):
    return ([Faults(fret, tests, env, setup, statement) for setup, list_ in STATEMENTS for statement in list_] +
            [ToTheEnd(fret, tests, env, way) for way in ToTheEnd.ways] +
            [OnScreen(fret, tests, env, OnScreen.played), ByKeys(fret, tests, env),
             ByKeys(fret, tests, env, "live lesson.fret")])


def allocations(seen):
    return [(ALLOCATION, number + 1, 0) for number in range(int(seen or 0))]


def interrupts(seen):
    return [(INTERRUPT, number, 0) for _, number, _ in allocations(seen)]


def calls(seen):
    """The faults for the calls that were seen: each with each code; only the first of the calls that wait for gnuplot, whose
    number varies."""
    found, numbers = [], {}
    for call in seen.split():
        numbers[call] = numbers.get(call, 0) + 1
        if FAMILIES.get(call, call) not in ("wait", "poll") or numbers[call] <= AGAIN:
            found += [(call, numbers[call], code) for code in codes_of(call)]
    return found


def attempt(one, kind, most=0):
    """Tries at most `most` faults, evenly spread: {how it ended: number of faults}, [(fault, what is wrong)]"""
    right = one.reference("all" if kind is calls else ALLOCATION)
    if right[0] != 0:
        return {}, [(None, "does not run: " + right[2])]
    ends, wrong = {}, []
    for fault in spread(kind(right[4]), most or (MOST if kind is allocations else one.most)):
        how = one.try_one(fault, right)
        if how in ("refused", "harmless", "not reached"):
            ends[how] = ends.get(how, 0) + 1
        else:
            wrong.append((fault, how))
    return ends, wrong


def spread(every, most):
    """At most `most` of them, evenly spread."""
    return [every[(2 * i + 1) * len(every) // (2 * most)] for i in range(most)] if len(every) > most else every


def leaks(one):
    """Looks for leaks: [faults injected, without leak, leaks of libraries], [(fault, report)]"""
    right, counts, wrong = one.reference(ALLOCATION), [0, 0, 0], []
    for fault in [(None, 0, 0), *spread(allocations(right[4]), MOST)]:
        status, _, told_of = one.run(fault)[:3]
        report = told_of if status == HUNG else told_of.partition("LeakSanitizer: ")[2]
        counts[0] += 1
        if not report:
            counts[1] += 1
        elif all(map(left_by_library, re.split(r"(?=^\w+ leak of )", report, flags=re.M)[1:])):
            counts[2] += 1
        else:
            wrong.append((fault, report))
    return counts, wrong


def left_by_library(leak):
    """Is the leak one of a library? GSL's constructors leak what they have allocated when a later allocation fails, and so does
    newlocale of glibc."""
    if leak.startswith("Direct leak of 5 byte(s) in 1 object") and " in __newlocale " in leak:
        return True
    makers = set(re.findall(r" in (gsl_\w+_c?alloc) ", leak))
    return (not makers <= {"gsl_%s_%s" % (what, how) for what in ("block", "vector", "matrix") for how in ("alloc", "calloc")}
            or ("gsl_matrix_alloc" in makers and leak.startswith("Direct leak of 48 byte(s) in 1 object")))


def leak_campaign(fret, tests, only):
    env = {"PATH": os.environ["PATH"], "LC_ALL": "C", "TERM": "dumb", "LSAN_OPTIONS": "fast_unwind_on_malloc=0"}
    chosen = [one for one in statements(fret, tests, env) if not isinstance(one, OnScreen) and (not only or one.statement in only)]
    total, failed = [0, 0, 0], 0
    with ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
        for one, (counts, wrong) in zip(chosen, pool.map(leaks, chosen)):
            total = [a + b for a, b in zip(total, counts)]
            failed += len(wrong)
            for fault, report in wrong[:3]:
                print("FAILED %s: %s: %s" % (one.statement[:60], told(fault), report), file=sys.stderr, flush=True)
    print("# %d allocations failed under a leak detector: %d left nothing behind, %d what GSL's constructors and newlocale leave, %d more"
          % (*total, failed))
    return 1 if failed else 0


def can_filter(tests):
    """Does this system allow seccomp filters?"""
    tool = os.path.join(tests, "calls")
    return os.path.exists(tool) and subprocess.run([tool, os.devnull, "none", "0", "0", "/bin/true"], check=False,
                                                   stderr=subprocess.DEVNULL).returncode == 0


def told(fault):
    what, number, code = fault or ("nothing", 0, 0)
    return "%s %d%s" % (what, number, " " + errno.errorcode[code] if code else "")


def campaign(fret, tests, only):
    env = {"PATH": os.environ["PATH"], "LC_ALL": "C", "TERM": "dumb"}
    chosen = [one for one in statements(fret, tests, env) if not only or one.statement in only]
    kinds = (allocations, calls, interrupts)
    jobs = [(one, kind) for one in chosen for kind in kinds]
    sums = {kind: [0, 0, 0, 0] for kind in kinds}
    print("# %-52s %27s  %27s  %27s" % ("make faults", "allocations", "system calls", "interrupts"))
    print("# %-52s %9s%9s%9s  %9s%9s%9s  %9s%9s%9s" % (("statement",) + 3 * ("injected", "refused", "harmless")))
    row, failed = "", 0
    with ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
        for (one, kind), (ends, wrong) in zip(jobs, pool.map(lambda job: attempt(*job), jobs)):
            refused, harmless = ends.get("refused", 0), ends.get("harmless", 0)
            numbers = (refused + harmless + len(wrong), refused, harmless, len(wrong))
            sums[kind] = [a + b for a, b in zip(sums[kind], numbers)]
            row = ("%-54s " % one.statement[:54] if kind is allocations else row + " ") + "%9d%9d%9d" % numbers[:3]
            if kind is kinds[-1]:
                print(row.rstrip(), flush=True)
            failed += len(wrong)
            for fault, what in wrong[:5]:
                print("FAILED %s: %s: %s" % (one.statement[:60], told(fault), what), file=sys.stderr, flush=True)
            if len(wrong) > 5:
                print("  and %d more" % (len(wrong) - 5), file=sys.stderr)
    print("%-54s " % "all" + "  ".join("%9d%9d%9d" % tuple(sums[kind][:3]) for kind in kinds))
    print("# %d neither refused nor harmless" % failed)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
    import harness
    harness.usual_signals()
    if sys.argv[1] == "--leaks":
        sys.exit(leak_campaign(os.path.abspath(sys.argv[2]), os.path.abspath(sys.argv[3]), sys.argv[4:]))
    sys.exit(campaign(os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), sys.argv[3:]))
