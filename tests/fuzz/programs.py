# SPDX-License-Identifier: GPL-3.0-or-later
"""Random scripts. Each must give the same answers as a file, through a pipe and by -c, recorded and replayed, saved and loaded;
a statement that is refused must change nothing; every line under --format=json must be an object. `programs.py FRET SECONDS
[SEED]` runs for so long; the tests run a few."""
import difflib
import json
import math
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor

FORCES = ("20 N", "0.9*mu*FN", "FN/3", "-5 N", "1 kN", "0", "x*1 N", "FA", "39.9 N", "1e-3 N", "mu*FN", "2 lbf")
LENGTHS = ("0.5 um", "1 mm", "dxmax", "-0.3 um", "a", "2*dxmax", "0", "a0", "1e-3 um", "dz/3")
GRADES = ("0.5", "-0.5", "0", "0.99", "x", "1", "-0.9", "1/3")
MODULI = ("210 GPa", "70 GPa", "1 Pa", "-3 GPa", "30e6 psi")
VALUES = """a dz c Fx dx W U dW dW(3_N) dWd(1_um) kt kn eta kappa W1D time p(0_m) qx(0.1_mm) u1D(0.05_mm) s1D(0_m) w1D(0_m)
 qz1D(0.01_mm) qx1D(0.01_mm) cN(0.1_mm) cT E(0.2_mm) f(0.1_mm) g(0.1_mm) a0 dz0 dx0max dxmax x y ff(2) gg(1,2) ans FN FA dxA
 FNA phase c0 k mu n A R slope b Fx(0.3_um) c(2_N) dx(1_N) a(3_N) ux(0.1_mm) uz(1_mm) hN hT beta_k E0 nu E0_2 nu_2 h r0
 Ksec(2_N) Kp(1_um) Kpp(1_um) loss_factor(1_N) p0 pmean Un p0(2_N) FN(1_um) G0 G0_2 Estar pi 1/0 0/0 1e308*10""".split()
VALUES = [value.replace("_m", " m").replace("_N", " N").replace("_um", " um").replace("E0 2", "E0_2") for value in VALUES]
UNITS = ("mm", "um", "N", "uJ", "GPa", "deg", "%", "MPa", "N/m", "nm^2")
SHAPES = ("sphere R=10 mm", "cone slope=0.05", "power n=3 h=1 um r0=1 mm", "power n=2 A=50 m^-1", "flat-rounded b=0.1 mm R=10 mm",
          "exact-sphere R=10 mm", "sum 2:50 m^-1, 4:1e6 m^-3", "flat-cone b=0.05 mm slope=0.05", "flat-paraboloid b=.1 mm R=1 m",
          "file gap.csv", "cone angle=3 deg", "sphere R1=10 mm R2=-20 mm", "sphere R1=9 mm R2=inf", "sphere D=20 mm",
          "flat b=0.1 mm", "cone half_angle=87 deg", "paraboloid R=1 m", "sphere", "file nowhere.csv")
NOISE = "()=,;:+-*/^ .e10\"'#\\~µ\tN"
FILES = {"gap.csv": "r [mm],f [um]\n" + "".join("%g,%g\n" % (i / 50, i * i / 50) for i in range(60)),
         "loads.csv": "FN [N],Fx [N]\n100,0\n120,15\n90,-10\n100,20\n",
         "moves.csv": "dz [um],dx [um]\n2,0\n3,0.4\n2.5,-0.2\n",
         "data.csv": "force [N],depth [um]\n10,0.75\n50,2.2\n100,3.5\n",
         "more.fret": "x = 3\nstep Fx+=0.5 N\n"}


class Writer:
    """Writes random statements, most of which make sense."""

    def __init__(self, seed):
        self.r = random.Random(seed)
        self.files = 0

    def pick(self, *of):
        return self.r.choice(of)

    def value(self, depth=0):
        u = self.r.random()
        if depth > 2 or u < .55:
            return self.r.choice(VALUES)
        if u < .65:
            return "(%s at %s)" % (self.value(depth + 1), self.scene())
        if u < .8:
            return "%s%s%s" % (self.value(depth + 1), self.pick(*"+-*/^"), self.pick(self.value(depth + 1), "2", "0.5"))
        if u < .9:
            return "%s(%s)" % (self.pick("sqrt", "abs", "exp", "ln", "sin", "atan", "gamma", "log10"), self.value(depth + 1))
        return "-" + self.value(depth + 1)

    def scene(self):
        kinds = [("k", self.pick(*GRADES)), ("mu", self.pick("0.1", "0.3", "-1")), ("FN", self.pick("50 N", "200 N")),
                 ("x", self.pick("1", "2")), ("FA", self.pick(*FORCES)), ("c0", "2 mm")]
        return ", ".join("%s=%s" % self.r.choice(kinds) for _ in range(self.pick(1, 1, 2)))

    def load(self):
        f, g = self.pick(*FORCES), self.pick(*FORCES)
        return self.pick("step Fx%s%s" % (self.pick("=", "+="), f), "step dx%s%s" % (self.pick("=", "+="), self.pick(*LENGTHS)),
                         "step FN=%s Fx=%s" % (f, g), "step dz=%s dx=%s" % (self.pick(*LENGTHS), self.pick(*LENGTHS)),
                         "step FN=%s" % f, "cycle FA%s%s" % (self.pick("=", ":="), f),
                         "cycle dxA=%s times %d" % (self.pick(*LENGTHS), self.pick(1, 2, 5)),
                         "cycle FA=%s FNA=%s phase=%s deg" % (f, self.pick("10 N", "30 N", "99 N"), self.pick("0", "37", "90", "180")),
                         "step Fx=%s steps 3" % f)

    def range(self):
        return "for %s steps %d%s" % (self.pick("k = -0.5 .. 0.5", "F1 = 1 N .. 50 N", "FN = 10 N .. 100 N", "mu = 0.1 .. 0.5",
                                                "x = 1 .. 2", "FA = 1 N .. 9 N", "c0 = 0.1 mm .. 1 mm", "x = 1 .. 100"),
                                      self.pick(1, 3, 7), self.pick("", "", " log"))

    def along(self):
        return "along %s steps %d" % (self.pick("program", "cycle", self.load().replace(" steps 3", "")), self.pick(1, 4, 9))

    def curves(self):
        return self.pick("", " with mu = 0.2, 0.4", " with k = 0, 0.3", " with x = 1, 2")

    def set(self):
        name, how, text = self.r.choice(
            [("k", self.pick("=", ":="), self.pick(*GRADES)), ("c0", self.pick("=", ":="), self.pick(*LENGTHS)),
             ("mu", self.pick("=", ":="), self.pick("0.3", "x/10", "y")), ("x", "=", self.pick("1", "2", "3")),
             ("y", ":=", self.pick("x/9", "x", "y", "mu", "a/c0")), ("z", ":=", self.value()), ("FN", "=", self.pick("100 N", "50 N")),
             ("FA", self.pick("=", ":="), self.pick(*FORCES)), ("FNA", "=", self.pick("0 N", "10 N")), ("phase", "=", "30 deg"),
             ("n", "=", "2.5"), ("A", "=", "50 m^-1"), ("R", "=", "5 mm"), ("dxA", "=", self.pick(*LENGTHS)),
             ("E0", "=", self.pick(*MODULI)), ("G0", self.pick("=", ":="), self.pick(*MODULI)), ("Estar", "=", self.pick(*MODULI)),
             ("dz", self.pick("=", ":="), "2 um"), ("a", "=", "0.1 mm"), ("p0", self.pick("=", ":="), "x*1 GPa"), ("pmean", "=", "1 GPa"), ("nu", "=", self.pick("0.2", "0.6")), ("slope", "=", "0.1"), ("b", "=", "0.2 mm")])
        return "%s %s %s" % (name, how, text)

    def file(self, *endings):
        self.files += 1
        return "out%d.%s" % (self.files, self.r.choice(endings))

    def question(self):
        return self.pick("solve mu for dW(5 N) = 1 nJ from 0.05 to 1", "solve FN for a = 0.1 mm", "solve x for x^2 = 2",
                         "maximize dWd(1 um) over FN = 1 N .. 100 N", "minimize (x-1)^2 + 1 over x = -3 .. 3",
                         "fit E0 for depth = dz(force) to data.csv", "uncertainty a, dz with E0 +- 5 %, mu +- 0.02 samples 50",
                         "export jenkins 3 to " + self.file("csv", "json", "h"),
                         "export harmonic to %s for dxA = 0 um .. 1 um steps 4" % self.file("csv", "json"),
                         "export loop to " + self.file("csv", "json"))

    def statement(self):
        u = self.r.random()
        if u < .07:
            return "material E0=%s nu=%s k=%s c0%s" % (self.pick(*MODULI), self.pick("0.3", "0.5", "0"), self.pick(*GRADES),
                                                       self.pick("=1 mm", ":=a0", "=0.1 mm"))
        if u < .13:
            return "geometry " + self.pick(*SHAPES)
        if u < .17:
            return self.pick("friction 0.4", "friction x/10", "second steel", "second same", "second rigid",
                             "second E0=70 GPa nu=0.33", "material steel", "friction 0",
                             "second G0=26 GPa nu=0.33", "material G0=80 GPa nu=0.3", "material Estar=100 GPa",
                             "material Estar=100 GPa nu=0.2")
        if u < .23:
            return "press " + self.pick("FN=100 N", "FN=x*1 N", "dz=1 um", "a=0.2 mm", "FN=0.001 N", "p0=1 GPa", "pmean=0.2 GPa")
        if u < .39:
            return self.load()
        if u < .53:
            return ", ".join(self.set() for _ in range(self.pick(1, 1, 1, 2, 3)))
        if u < .59:
            return self.pick("ff(t) := t*x", "gg(t,s) := ff(t)+s", "ff(t) := dW(t*1 N)", "undo", "undo", "reset", "reset all",
                             "undo", "set model springs 50", "set model memory", "set model auto", "set model closed",
                             "follow loads.csv", "follow moves.csv", "source more.fret", "source nowhere.fret")
        if u < .63:
            return "table %s, %s %s%s%s" % (self.value(), self.value(), self.range(), self.curves(),
                                            self.pick("", "", " to " + self.file("csv", "json", "txt")))
        if u < .68:
            return "table %s, %s %s%s" % (self.value(), self.value(), self.along(), self.curves())
        if u < .71:
            return "plot %s%s to %s" % (self.pick("loop", "springs", "pressure", "traction", "load", "dissipation", "gap", "E",
                                                  "%s %s" % (self.value(), self.range()), "%s %s" % (self.value(), self.along())),
                                        self.curves(), self.file("gp"))
        if u < .74:
            return "history" + self.pick("", " to " + self.file("csv", "json", "txt"))
        if u < .77:
            return "explain " + self.value(2)
        if u < .79:
            return self.pick("show", "show variables", "show settings", "set digits 9", "set digits 6", "help a", "apropos stick")
        if u < .82:
            return self.question()
        return ", ".join(self.value() + self.pick("", "", " in " + self.pick(*UNITS)) for _ in range(self.pick(1, 2)))

    def line(self):
        text = self.statement()
        u = self.r.random()
        if u < .04:  # a typing error
            at = self.r.randrange(len(text) + 1)
            text = text[:at] + self.r.choice(NOISE) + text[at + self.pick(0, 1):]
        elif u < .08:
            text += self.pick(";", "; ", " # a note") + self.pick("", self.statement())
        return text

    def program(self):
        lines = ["material E0=210 GPa nu=0.3 k=0.2 c0=1 mm", "geometry sphere R=10 mm", "friction 0.4",
                 "press FN=100 N"] if self.r.random() < .8 else []
        return lines + [self.line() for _ in range(self.pick(10, 25, 40))]


def outcome(fret, env, lines, way, options=(), before=(), after=()):
    """Runs a script: (exit status, output, messages without the name of the script, files)"""
    where = tempfile.mkdtemp(prefix="fret-programs-", dir=env["TMPDIR"])
    try:
        for name, text in FILES.items():
            with open(os.path.join(where, name), "w", encoding="ascii") as f:
                f.write(text)
        text = "".join(line + "\n" for line in [*before, *lines, *after])
        command, stdin = [fret, "--keep-going", *options], b""
        if way == "file":
            with open(os.path.join(where, "script.fret"), "w", encoding="utf-8") as f:
                f.write(text)
            command.append("script.fret")
        elif way == "-c":
            command += ["-c", text]
        elif way == "replay":
            command += ["--replay", "transcript.txt", "--tolerance", "1e-13"]
            with open(os.path.join(where, "transcript.txt"), "w", encoding="utf-8") as f:
                f.write(text)
        else:
            stdin = text.encode()
        try:
            done = subprocess.run(command, input=stdin, capture_output=True, env=env, cwd=where, timeout=60, check=False)
        except subprocess.TimeoutExpired:
            return "no end within 60 s", "", "", {}
        files = {}
        for name in sorted(os.listdir(where)):
            if name != "script.fret":
                with open(os.path.join(where, name), "rb") as f:
                    files[name] = f.read()
        err = re.sub(r"^(?:script\.fret|stdin|-c):(?=\d+:)", "", done.stderr.decode(errors="replace"), flags=re.M)
        return done.returncode, done.stdout.decode(errors="replace"), err, files
    finally:
        shutil.rmtree(where)


def differ(want, got):
    return "\n".join(list(difflib.unified_diff(want.splitlines(), got.splitlines(), lineterm="", n=0))[:12])


def not_a_number(text):
    raise ValueError(text)


def refused(lines, out, err):
    """The output shows the scene after each line: finds a line of a single, refused statement after which it has changed."""
    shown = re.split(r"^987654321 = .*\n", out, flags=re.M)
    if len(shown) != len(lines) + 2:
        return "%d pauses for %d lines" % (len(shown) - 2, len(lines))
    failed = {(int(n) - 4) // 5 for n in re.findall(r"^(\d+):\d+: error:", err, re.M)}
    scenes = [shown[0], *(re.split(r"^123456789 = .*\n", part, flags=re.M)[-1] for part in shown[1:-1])]
    for i in sorted(failed):
        if 0 <= i < len(lines) and ";" not in lines[i] and not lines[i].startswith("source") and scenes[i] != scenes[i + 1]:
            return "`%s`, refused, has changed the scene\n%s" % (lines[i], differ(scenes[i], scenes[i + 1]))
    return None


def problem(fret, env, seed):
    """What is wrong with a random script; None: nothing."""
    lines = Writer(seed).program()
    first = outcome(fret, env, lines, "file")
    if first[0] not in (0, 1) or "Sanitizer" in first[2] or "runtime error" in first[2]:
        return "ends with %s\n%s" % (first[0], first[2][-2000:])
    if re.search(r"\bnan\b", first[1]):
        return "prints nan"
    for way in ("stdin", "-c"):
        other = outcome(fret, env, lines, way)
        if other != first:
            return "as file and as %s: %s" % (way, differ(first[1] + first[2], other[1] + other[2]) or "status or files")
    given = outcome(fret, env, lines, "stdin", before=["record kept.txt"], after=["record off", "save kept.fret"])
    kept = [given[3].get(name, b"").decode(errors="replace") for name in ("kept.txt", "kept.fret")]
    again = outcome(fret, env, kept[0].splitlines(), "replay")
    if again[0] != 0 or " 0 failed" not in again[1]:
        return "recorded and replayed: " + again[1][-1500:] + again[2][-500:]
    asked = ["show", "show variables", "set digits 17", "FN, dz, a", "Fx, dx, c, W, U", "dW", "kt, kn", "history"]
    left, right = (outcome(fret, env, [*x, "set format text", "set model auto", "987654321", *asked], "stdin")
                   for x in (lines, kept[1].splitlines()))
    left, right = (re.split(r"^987654321 = .*\n", x[1], flags=re.M)[-1] for x in (left, right))
    if "set model" not in "".join(lines) and left != right:
        return "saved and loaded: " + differ(left, right)
    objects = outcome(fret, env, lines, "stdin", ["--format=json"])
    for line in objects[1].splitlines():
        try:
            if not isinstance(json.loads(line, parse_constant=not_a_number), dict):
                return "no object: " + line[:200]
        except ValueError:
            return "no JSON: " + line[:200]
    if objects[0] != first[0]:
        return "another status under --format=json: %s, %s" % (objects[0], first[0])
    looks = ["show", "show variables", "987654321"]
    shown = outcome(fret, env, [x for line in lines for x in (line + "\n123456789", *looks)], "stdin", before=looks)
    return refused(lines, shown[1], shown[2])


def campaign(problem, fret, env, seconds, seed, workers, most=math.inf):
    """Tries scripts (or typed sessions) for `seconds`, at most `most` per worker: (number tried, [(seed, problem)])"""
    end, wrong, counts = time.time() + seconds, [], [0] * workers

    def work(worker):
        one = seed + worker
        while time.time() < end and len(wrong) < 5 and counts[worker] < most:
            what = problem(fret, env, one)
            if what:
                wrong.append((one, what))
            counts[worker] += 1
            one += workers
    with ThreadPoolExecutor(max_workers=workers) as pool:
        for future in [pool.submit(work, i) for i in range(workers)]:
            future.result()
    return sum(counts), wrong


def run(tests):
    """Runs scripts of fixed seeds; the sanitized build takes other seeds."""
    count, wrong = campaign(problem, tests.fret, {**tests.env, "TMPDIR": tests.tmp}, math.inf, 1000000 if tests.sanitized else 1, 2,
                            1 if tests.sanitized else 4 if tests.few else 10)
    for seed, what in wrong:
        tests.check("random program %d" % seed, False, "%s\n%s" % (what, "\n".join(Writer(seed).program())))
    tests.record("random programs", count > len(wrong), count)


def main():
    fret, seconds, seed = os.path.abspath(sys.argv[1]), float(sys.argv[2]), int(sys.argv[3]) if len(sys.argv) > 3 else 1
    with tempfile.TemporaryDirectory(prefix="fret-programs-") as tmp:
        env = {"PATH": os.environ["PATH"], "HOME": tmp, "TMPDIR": tmp, "LC_ALL": "C", "TERM": "dumb",
               "ASAN_OPTIONS": "detect_leaks=1:allocator_may_return_null=1"}
        if seconds == 0:
            print("\n".join(Writer(seed).program()))
            print("#", problem(fret, env, seed))
            return 0
        count, wrong = campaign(problem, fret, env, seconds, seed, os.cpu_count() or 1)
        for one, what in wrong:
            print("FAILED program %d: %s" % (one, what))
        print("programs: %d passed, %d failed" % (count - len(wrong), len(wrong)))
        return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
