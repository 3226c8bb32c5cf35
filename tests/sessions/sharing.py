# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests work shared among processes (`set cores`): the output is the same for any number of processes, also if some die, and no process
is left behind."""
import errno
import os
import re
import resource
import signal
import subprocess
import time

import faults

GRADED = "material E0=210 GPa nu=0.3 k=0.3 c0=1 mm; geometry sphere R=10 mm; friction 0.4; press FN=100 N; cycle FA=20 N"
STEEL = "material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N"
OBLIQUE = STEEL + "; cycle FA=15 N FNA=20 N phase=60 deg; set model springs 300"
SLOW = STEEL + "; cycle FA=15 N FNA=20 N phase=60 deg times 50; set model springs 3000"
ROWS = "material steel; geometry file rows.csv; friction 0.4; press FN=100 N"
ROUGH = "material steel; geometry file rough.csv; friction 0.4; press FN=100 N"
HISTORY = "; step Fx=20 N; step FN=90 N Fx=5 N; step FN=110 N Fx=20 N"

# Statements long enough to be shared, among them a table of gaps, one whose dimension changes, a map, a fit and samples.
STATEMENTS = (
    (GRADED, "table a, dW, hN for k = -0.9 .. 0.9 steps 6000"),
    (GRADED, "table a, c for E0 = 1 GPa .. 500 GPa log steps 5000 with k=-0.3,0,0.3"),
    (GRADED, "table dW, a for FN = 40 N .. 60 N steps 9000"),
    (GRADED, "table (1 m)^max(k, 0.5), a for k = 0 .. 0.9 steps 9000"),
    (GRADED, "table W at k=q, a at k=q for q = -0.5 .. 0.95 steps 3000"),
    (GRADED, "table a, dW for k = 0 .. 0.9 steps 70 for nu = 0 .. 0.5 steps 60"),
    (GRADED, "q = 2; y(x) := q*x*a; table y(x), y(2*x) at k=x for x = 0.1 .. 0.9 steps 3000; q; k"),
    (STEEL + HISTORY, "table qx(r), ux(r) for r = 0 mm .. 0.2 mm steps 300"),
    (ROWS + HISTORY, "table uz(r) for r = 0 mm .. 1.5 mm steps 1000"),
    (ROUGH, "table dW(F), c(F) for F = 1 N .. 39 N steps 500"),
    (ROUGH, "table dW(F), a for F = 39 N .. 41 N steps 500"),
    (STEEL + HISTORY, "table W for mu = 0.1 .. 0.9 steps 4000"),
    (OBLIQUE, "table dW for phase = 0 deg .. 60 deg steps 11"),
    (OBLIQUE, "maximize dW/FN over phase = 1 deg .. 170 deg"),
    (OBLIQUE, "maximize dW over phase = 1 deg .. 170 deg, mu = 0.3 .. 0.4"),
    (GRADED, "uncertainty dW, a with k +- 0.01, mu +- 5 %, FN +- 30 N samples 8000"),
    (GRADED, "fit E0, k for depth = dz(force) to indent.csv"),
    # values that begin or end after the work is shared; and a dimension that each process must find by itself
    (GRADED, "table sqrt(q - 0.4), W at k=q for q = -0.5 .. 0.95 steps 3000"),
    (GRADED, "table W at k=q, sqrt(0.4 - q) for q = -0.5 .. 0.95 steps 3000"),
    (GRADED, "table (1 m)^(2 + 0*sqrt(q - 0.4)), W at k=q for q = -0.5 .. 0.95 steps 3000"),
    (GRADED, "table (1 m)^(2 + min(1, max(0, 1e9*(q - 0.7))) + 0*sqrt(q - 0.4)), W at k=q for q = -0.5 .. 0.95 steps 3000"),
    (OBLIQUE, "maximize dW*sqrt(phase/(1 deg) - 120) over phase = 1 deg .. 170 deg"),
    (OBLIQUE, "maximize dW*(1 m)^(min(1, max(0, phase/(1 deg) - 140)) + 0*sqrt(phase/(1 deg) - 120)) over phase = 1 deg .. 170 deg"),
    (GRADED, "uncertainty dW*sqrt(mu - 0.38), sqrt(mu - 0.38) with mu +- 0.03, k +- 0.01 samples 8000"),
    (GRADED + "; E0 = 180 GPa; q = 10", "fit q for depth = dz(force)*sqrt(q - 2) to indent.csv"),
)


def alone(tests):
    """If the system gives no socket or no further process, one process does all."""
    calls = os.path.join(os.path.abspath(tests.build), "tests/calls")
    can_fail = faults.can_filter(os.path.dirname(calls))
    def one(setup, statement):
        script = "%s; source arm; set timing on; %s" % (setup, statement)
        want = shown(tests.run("-c", "set cores 1", "-c", script))
        done = subprocess.run([tests.fret, "-c", "set cores 5", "-c", script], capture_output=True, text=True, env=tests.env, cwd=tests.dir,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (4, 4)), timeout=120, check=False)
        tests.check(statement + ": without sockets", want[0] and shown(done) == want, str(shown(done))[-1500:])
        told = os.path.join(tests.dir, "told-%d" % hash(statement))
        if can_fail:
            done = subprocess.run([calls, told, "clone", "1", str(errno.EAGAIN), tests.fret, "-c", "set cores 5", "-c", script],
                                  capture_output=True, text=True, env=tests.env, cwd=tests.dir, timeout=120, check=False)
            tests.check(statement + ": without processes", shown(done) == want, str(shown(done))[-1500:])
    with open(os.path.join(tests.dir, "arm"), "w", encoding="ascii"):
        pass
    kinds = ("table W at", "maximize", "uncertainty", "fit")
    tests.each([lambda a=next(a for a in STATEMENTS if a[1].startswith(kind)): one(*a) for kind in kinds])


def past_a_range(tests):
    """A table that goes beyond the range of an input has, up to there, the rows of a table that ends there."""
    ends, far = [], []
    for end, steps, to in (("0.5", 3000, ends), ("0.6", 6000, far)):
        done = tests.run("--format=csv", "-c", GRADED.partition("; cycle")[0] + "; table a, dz for nu = 0.4 .. %s steps %d" % (end, steps))
        to += [line.split(",") for line in done.stdout.splitlines() if not line.startswith("nu")]
    values = [(float(row[0]), row[1:]) for row in far]
    tests.check("a table past the range of nu", len(ends) > 2900 and len(values) == 6001 and all(row == ["", ""] for nu, row in values if nu > 0.5000001) and
                all("" not in row for nu, row in values if nu < 0.4999999) and "nu = 0.5" in done.stderr, tests.report(done))
    want = {round(float(row[0]), 9): list(map(float, row[1:])) for row in ends[-3001:]}
    off = max((abs(float(a) / b - 1) for nu, row in values if nu < 0.4999999 for a, b in zip(row, want.get(round(nu, 9), [1, 1]))), default=1)
    tests.check("and the same values", off < 1e-14, "%g" % off)


def shown(done):
    """The output without times."""
    return done.stdout, re.sub(r"(?m)^time: .*?ms", "", done.stderr), done.returncode


def children(pid):
    """The living children of a process."""
    with open("/proc/%d/task/%d/children" % (pid, pid), encoding="ascii") as f:
        return [int(word) for word in f.read().split()]


def data(tests):
    with open(os.path.join(tests.dir, "rows.csv"), "w", encoding="ascii") as f:
        f.write("r [mm],f [um]\n" + "".join("%.17g,%.17g\n" % (x, 50 * x * x + 3 * x ** 3) for x in (i / 200 for i in range(600))))
    with open(os.path.join(tests.dir, "rough.csv"), "w", encoding="ascii") as f:
        f.write("r [mm],f [um]\n" + "".join("%.17g,%.17g\n" % (i / 8000, 50 * (i / 8000) ** 2 * (1 + 1e-7 * (i * i % 13 - 6)))
                                            for i in range(5000)))
    with open(os.path.join(tests.dir, "indent.csv"), "w", encoding="ascii") as f:
        f.write("depth [um],force [N]\n")
        for i in range(1, 4001):
            f.write("%.8g,%.8g\n" % (3.4829 * (i / 4e3) ** (2 / 3) * (1 + 0.01 * (i * i % 7 - 3)), i / 40))


def same(tests):
    """The output with one, two and five processes."""
    def one(setup, statement):
        script = "%s; set timing on; %s" % (setup, statement)
        want, *results = [shown(tests.run("--format=csv", "-c", "set cores %d" % n, "-c", script)) for n in (1, 2, 5)]
        tests.check(statement + ": answers", want[0] or want[2] == 1, str(want)[-1500:])
        for n, got in zip((2, 5), results):
            tests.check("%s by %d" % (statement, n), got == want,
                        "%s\ninstead of\n%s" % (str(got)[-1500:], str(want)[-1500:]))
    tests.each([lambda a=a: one(*a) for a in tests.some(STATEMENTS, 3)])


class Running:
    """A table to a file that takes a minute, running, and shared."""

    def __init__(self, tests, cores):
        self.out = os.path.join(tests.dir, "shared.csv")
        self.process = subprocess.Popen(
            [tests.fret, "-c", "%s; set cores %d; table dW for phase = 0 deg .. 60 deg steps 400 to %s" %
             (SLOW, cores, self.out)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=tests.env, cwd=tests.dir)
        self.workers = []
        end = time.monotonic() + 120
        while len(self.workers) < cores and time.monotonic() < end and self.process.poll() is None:
            time.sleep(0.01)
            self.workers = children(self.process.pid)

    def all_gone(self):
        end = time.monotonic() + 60
        while time.monotonic() < end:
            if not any(os.path.exists("/proc/%d" % pid) for pid in self.workers):
                return True
            time.sleep(0.01)
        return False


def signals(tests):
    """Ctrl-C ends all processes, and so does any signal that ends the program."""
    for number, status in ((signal.SIGINT, 130), (signal.SIGTERM, -signal.SIGTERM), (signal.SIGKILL, -signal.SIGKILL)):
        r = Running(tests, 3)
        name = signal.Signals(number).name
        tests.check(name + ": shared by three", len(r.workers) == 3, str(r.workers))
        r.process.send_signal(number)
        _, err = r.process.communicate(timeout=120)
        tests.check("%s: ends with %d" % (name, status), r.process.returncode == status,
                    "exit %d\n%s" % (r.process.returncode, err.decode()))
        tests.check(name + ": nobody stays", r.all_gone(), str(r.workers))
        tests.check(name + ": no half file", not os.path.exists(r.out))


def losses(tests):
    """If a process is killed, no row is missing."""
    script = OBLIQUE + "; set cores %d; table dW for phase = 0 deg .. 60 deg steps 40"
    want = shown(tests.run("-c", script % 1))
    process = subprocess.Popen([tests.fret, "-c", script % 2], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                               env=tests.env, cwd=tests.dir)
    end = time.monotonic() + 120
    killed = []
    while not killed and time.monotonic() < end and process.poll() is None:
        time.sleep(0.01)
        killed = children(process.pid)[:1]
    for pid in killed:
        os.kill(pid, signal.SIGKILL)
    out, err = process.communicate(timeout=120)
    tests.check("a killed worker: there was one", killed)
    tests.check("a killed worker: all rows", (out, err, process.returncode) == want, out[-1000:] + err)


def settings(tests):
    for bad in ("0", "65", "two", "1.5", "-1"):
        done = tests.run("-c", "set cores " + bad)
        tests.check("set cores " + bad, done.returncode == 1 and "error:" in done.stderr, tests.report(done))
    done = tests.run("-c", "set cores 3; set")
    tests.check("set cores 3", "set cores 3\n" in done.stdout, tests.report(done))
    done = tests.run("-c", "set cores 3; record cores.txt; record off")
    with open(os.path.join(tests.dir, "cores.txt"), encoding="utf-8") as f:
        tests.check("a record begins with them", "set cores 3" in f.read(), tests.report(done))


def run(tests):
    past_a_range(tests)
    data(tests)
    settings(tests)
    same(tests)
    alone(tests)
    signals(tests)
    losses(tests)
