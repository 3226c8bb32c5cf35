# SPDX-License-Identifier: GPL-3.0-or-later
"""Memory that runs out once, at every allocation of a statement: it ends with the right answer, or with an error that
says so and the scene and its files as before. `faults.py FRET FAULTS.SO` tries them all, the tests some."""
import difflib
import os
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

POWER = "material E0=210 GPa nu=0.3 k=0.5 c0=1 mm; geometry sphere R=10 mm; friction 0.4; x = 3; F(y) := y^2"
LOADED = POWER + "; press FN=100 N; step Fx=20 N; cycle FA=20 N"
TABLE = "material steel; friction 0.4; geometry file gap.csv; press FN=10 N; cycle FA=2 N"
SUM = "material steel; friction 0.4; geometry sum 2:50 m^-1, 4:2e6 m^-3; press FN=10 N; step Fx=1 N"

# a setup, and statements that are tried after it
STATEMENTS = (
    (POWER, ("y = 3 mm, z = x + 1", "z := x^2", "G(u, v) := u + v*x", "k = 0.3", "c0 := 2 mm*x", "undo", "x, x^2 in %",
             "F(3), (x at x=5)", "material steel nu=0.2", "second E0=70 GPa nu=0.33", "second aluminium",
             "geometry cone angle=3 deg", "geometry sum 2:50 m^-1, 4:2e6 m^-3", "geometry power n=3 A=50 m^-2",
             "geometry file gap.csv", "geometry file gap.csv smooth", "friction 0.3", "press FN=100 N", "press a=0.2 mm", "press dz=1 um", "reset all",
             "set digits 9", "set format json", "set format json; help press; show commands", "show", "show variables", "show units", "show settings",
             "show commands", "help", "help press", "help units", "apropos contact", "apropos radius",
             "table x^2, y for y = 1 .. 5 steps 4 to out.csv", "table a(y) for y = 1 N .. 9 N steps 300",
             "table y, x for y = 1 .. 9 steps 600", "demo", "1" + "+1" * 300, "explain kappa",
             "0." + "0" * 120 + "1 + 1")),
    (LOADED, ("step Fx=5 N", "step Fx+=1 N FN=110 N", "step dx=0.1 um steps 20", "cycle dxA=0.1 um times 2",
              "cycle FA=20 N FNA=10 N phase=90 deg", "cycle FA:=0.5*mu*FN", "follow follow.csv", "FA = 10 N", "mu = 0.3",
              "FA := 0.4*mu*FN", "k = 0.2, x = 5", "undo", "reset", "history", "history to out.csv", "history to out.json",
              "dW, Fx, W, c, a, kt", "dW at k=0", "explain dW", "explain a", "explain x*dW",
              "table dW for FA = 1 N .. 20 N steps 5", "table dW for FA = 1 N .. 9 N steps 2 with mu = 0.3, 0.4",
              "table Fx, dx along program steps 10", "table Fx along cycle steps 9 to out.dat",
              "table Fx, W along cycle FA=10 N steps 8", "table Fx along step Fx=25 N steps 4",
              "qx(0.1 mm), ux(0.1 mm), p(0), uz(0.5 mm)", "w1D(0), u1D(0), s1D(0)", "accuracy within 0.001",
              "set model springs 100", "plot loop to out.gp", "plot traction to out.gp",
              "plot dW for FA = 1 N .. 20 N steps 5 to out.gp", "plot loop", "plot loop | pressure to out.svg",
              'plot loop title "%s" to out.gp' % ("long " * 4000), "plot dW for FA = 1 N .. 9 N with k = 0, 0.5",
              "plot map dW for FA = 1 N .. 9 N steps 5 for mu = 0.3 .. 0.5 steps 5 to out.gp",
              "plot FN against Fx along program over follow.csv to out.gp",
              "show", "press FN=50 N", "geometry cone slope=0.1", "quit")),
    (TABLE, ("step Fx=1 N", "dW, a, Fx", "cycle FA=2 N FNA=1 N", "geometry file gap.csv", "k = 0.2, c0 = 1 mm",
             "explain dW", "show", "p(0.01 mm)")),
    (LOADED + "; set model springs 40", ("Fx, W", "dW", "history", "explain W", "cycle FA=10 N")),
    (SUM, ("cycle FA=1 N", "W, dW(1 N)", "FN = 20 N", "explain W", "qx(0.01 mm)", "dW(1 N), dx(1 N)")),
)


def prepare(where):
    """Files that the statements read, and one that must survive."""
    texts = {"arm": "", "disarm": "", "script.fret": "x = 7\nstep_ = 2; y = x\nx + y\n",
             "gap.csv": "r [mm],f [um]\n" + "".join("%g,%g\n" % (i / 50, i * i / 50) for i in range(40)),
             "follow.csv": "FN [N],Fx [N]\n" + "".join("%g,%g\n" % (100 + i, 20 - i) for i in range(20))}
    for name, text in texts.items():
        with open(os.path.join(where, name), "w", encoding="ascii") as f:
            f.write(text)
    for ending in ("csv", "json", "dat", "gp", "svg"):
        with open(os.path.join(where, "out." + ending), "w", encoding="ascii") as f:
            f.write("old\n")


def files(where):
    """What the directory holds."""
    found = {}
    for name in sorted(os.listdir(where)):
        with open(os.path.join(where, name), "rb") as f:
            found[name] = f.read()
    return found


def differ(want, got):
    return "\n".join(line for line in difflib.ndiff(want.splitlines(), got.splitlines()) if line[0] in "+-")


class Faults:
    """One statement, run again and again."""

    def __init__(self, fret, shim, env, setup, statement):
        self.fret, self.shim, self.env, self.statement = fret, shim, env, statement
        self.script = "".join(line + "\n" for line in
                              (setup, "show", "source arm", statement, "source disarm", "set format text", "set digits 6",
                               "1234567", "show", "show variables"))

    def run(self, fault):
        """(exit status, output, messages, files, allocations seen)"""
        where = tempfile.mkdtemp(prefix="fret-faults-")
        count = where + ".count"
        tmp = where + ".tmp"
        os.mkdir(tmp)
        try:
            prepare(where)
            done = subprocess.run([self.fret, "--keep-going", "-c", self.script], cwd=where, capture_output=True,
                                  env={**self.env, "LD_PRELOAD": self.shim, "FAULT": str(fault), "FAULT_COUNT": count,
                                       "TMPDIR": tmp, "HOME": tmp}, timeout=120, check=False)
            left = files(where)
            seen = 0
            if os.path.exists(count):
                with open(count, encoding="ascii") as f:
                    seen = int(f.read())
            if os.listdir(tmp):
                left["left in TMPDIR"] = os.listdir(tmp)
            return done.returncode, done.stdout.decode(), done.stderr.decode(), left, seen
        finally:
            shutil.rmtree(where)
            shutil.rmtree(tmp, ignore_errors=True)
            if os.path.exists(count):
                os.unlink(count)

    def problem(self, fault, right):
        """What is wrong with a run whose allocation `fault` failed; None: nothing."""
        status, out, err, left, _ = self.run(fault)
        before, final = right[1].partition("\n1234567 = ")[0], out.rpartition("1234567 = ")[2]
        timing = self.statement.startswith("accuracy")
        if status == 0:
            if (out != right[1] and not timing) or left.keys() != right[3].keys():
                return "ends well with another answer\n" + differ(right[1], out)
            return None
        if status != 1:
            return "exit %d" % status
        if "memory" not in err and "Cannot allocate" not in err:
            return "a message that does not say so: " + err
        started = out.partition("\n")[0]
        if not before.startswith(started):
            return "another beginning"
        first = [line for line in err.splitlines() if "error:" in line][:1]
        if first and first[0].startswith("-c:5:"):  # what follows the statement
            return None
        want = self.kept
        if "1234567 = " in out and final != want:
            return "the scene changed, or what follows fails:\n" + differ(want, final) + "\n" + err
        for name, text in left.items():
            if text != self.files.get(name):
                return "%s changed" % name
        return None

    def unchanged(self):
        return self.kept

    def reference(self):
        """The run without a fault; what the scene and the files are before the statement."""
        whole = self.script
        self.script = whole.replace("source arm\n%s\nsource disarm\n" % self.statement, "", 1)
        bare = self.run(0)
        self.kept, self.files = bare[1].rpartition("1234567 = ")[2], bare[3]
        self.script = whole
        return self.run(0)


def statements(fret, shim, env):
    return [Faults(fret, shim, env, setup, statement) for setup, list_ in STATEMENTS for statement in list_]


def attempt(one, most):
    """[(statement, fault, what is wrong)] of at most so many faults, evenly chosen; and how many were tried."""
    right = one.reference()
    if right[0] != 0:
        return [(one.statement, 0, "does not run: " + right[2])], 0
    count = right[4]
    tried = sorted({1 + i * count // most for i in range(most)} if most and count > most else range(1, count + 1))
    wrong = [(one.statement, fault, one.problem(fault, right)) for fault in tried if fault <= count]
    return [row for row in wrong if row[2]], len(tried)


def main():
    fret, shim = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
    env = {"PATH": os.environ["PATH"], "LC_ALL": "C", "TERM": "dumb"}
    only = sys.argv[3:]
    tried = failed = 0
    chosen = [one for one in statements(fret, shim, env) if not only or one.statement in only]
    with ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
        for one, (wrong, count) in zip(chosen, pool.map(lambda one: attempt(one, 0), chosen)):
            tried += count
            failed += len(wrong)
            for statement, fault, what in wrong[:3]:
                print("FAILED %s: allocation %d: %s" % (statement[:60], fault, what), flush=True)
            if len(wrong) > 3:
                print("  and %d more" % (len(wrong) - 3))
    print("faults: %d passed, %d failed" % (tried - failed, failed))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
