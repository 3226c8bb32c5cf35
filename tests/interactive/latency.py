# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures how long Ctrl-C takes, from the key to the next prompt, in the slowest statements: `latency.py FRET [NAME...]` prints a
table for interrupts at random moments. The tests run a short version with generous limits."""
import contextlib
import math
import os
import pty
import random
import select
import shutil
import signal
import sys
import tempfile
import termios
import time

STEEL = "material steel; friction 0.4"
GRADED = "material E0=210 GPa nu=0.3 k=0.3 c0=1 mm; friction 0.4"
PRESSED = STEEL + "; geometry sphere R=10 mm; press FN=100 N"
INTERRUPTS = int(os.environ.get("INTERRUPTS", "25"))  # per statement
LONGEST = float(os.environ.get("LONGEST", "5"))  # the latest interrupt [s]
PATIENCE = 20


def gap(path, rows):
    """Writes a table of a sphere of 10 mm up to r = 1 mm, with roughness of a millionth."""
    with open(path, "w", encoding="ascii") as f:
        f.write("r [mm],f [mm]\n")
        for i in range(rows):
            r = i / (rows - 1)
            f.write("%.17g,%.17g\n" % (r, r * r / 20 * (1 + 1e-6 * math.sin(40 * r))))


def history(path, rows):
    with open(path, "w", encoding="ascii") as f:
        f.write("FN [N],Fx [N]\n")
        for i in range(rows):
            f.write("%.17g,%.17g\n" % (100 + 10 * math.sin(i), 20 * math.cos(1.3 * i)))


def cases(where, size):
    """(name, statements before, the statement); numbers of rows and springs are divided by `size`."""
    springs, rows = 10000000 // size, 100000 // size
    path = {name: os.path.join(where, name) for name in ("gap", "small", "huge", "follow", "line", "sum", "transcript",
                                                      "measured")}
    gap(path["gap"], rows)
    gap(path["small"], 1000)
    gap(path["huge"], 3000000 // size)
    history(path["follow"], 1000000 // size)
    with open(path["line"], "w", encoding="ascii") as f:
        f.write("x = 1 # " + "x" * (200000000 // size) + "\n")
    with open(path["sum"], "w", encoding="ascii") as f:
        f.write("1" + "+1" * (5000000 // size) + "\n")
    with open(path["transcript"], "w", encoding="ascii") as f:
        f.write(PRESSED.replace("; ", "\nfret> ").join(("fret> ", "\n")) + "fret> cycle dxA=0.1 um FNA=30 N\n" * 10000)
    with open(path["measured"], "w", encoding="ascii") as f:
        f.write("time,dx [um],Fx [N]\n" + "".join("%d,%.9g,%.9g\n" % (i, math.sin(i / 9), 30 * math.sin(i / 9 - 0.2))
                                                  for i in range(20000 // size)))
    table = "%s; geometry file %s; press FN=100 N" % (GRADED, path["gap"])
    oblique = "cycle FA=20 N FNA=30 N phase=60 deg"
    model = "; set model springs %d" % springs
    return [
        ("springs, table of %d rows" % rows, table + "; cycle FA=20 N" + model, "Fx"),
        ("/dev/zero as a gap", STEEL, "geometry file /dev/zero"),
        ("/dev/zero as a source", "x = 1", "source /dev/zero"),
        ("springs, sphere", PRESSED + "; cycle FA=20 N" + model, "W"),
        ("springs, sum", STEEL + "; geometry sum 2:50 m^-1, 4:2e6 m^-3; press FN=100 N; cycle FA=20 N" + model, "W"),
        ("geometry file of %d rows" % (3000000 // size), GRADED, "geometry file " + path["huge"]),
        ("a history, oblique, table", table + "; step FN=110 N Fx=10 N", "history to /dev/null"),
        ("table dW(F), table", table, "table dW(F) for F = 1 N .. 39 N steps 2000 to /dev/null"),
        ("a source of one long line", "x = 1", "source " + path["line"]),
        ("follow %d rows" % (1000000 // size),
         "%s; geometry file %s; press FN=100 N" % (GRADED, path["small"]), "follow " + path["follow"]),
        ("a sum of %d terms" % (5000000 // size), "x = 1", "source " + path["sum"]),
        ("accuracy", PRESSED + "; cycle FA=20 N", "accuracy within 60"),
        ("oblique cycles, table", table, oblique + " times 100"),
        ("springs, oblique", PRESSED + "; " + oblique + "; set model springs %d" % (1000000 // size), "W"),
        ("a field, table", table + "; step Fx=20 N", "table p(r), qx(r) for r = 0 mm .. 0.2 mm steps 100000 to /dev/null"),
        ("maximize", PRESSED + "; cycle dxA=0.1 um FNA=30 N times 20", "maximize W over mu = 0.5 .. 1, E0 = 1 GPa .. 300 GPa"),
        ("fit to a loop", PRESSED, "fit mu, E0 along " + path["measured"]),
        ("uncertainty", PRESSED, "uncertainty dWd(1 um) with mu +- 0.01, FN +- 1 N samples 10000000"),
        ("export jenkins", PRESSED.replace("sphere", "flat-rounded b=0.1 mm"), "export jenkins 1000 to x.csv"),
        ("replay", "x = 1", "replay " + path["transcript"]),
        ("a plot, table", table + "; cycle FA=20 N", "plot dW for FA = 1 N .. 30 N with k = 0, 0.1, 0.2, 0.3, 0.4, 0.5"),
        ("a map, table", table, "plot map a for k = 0 .. 0.5 steps 400 for FN = 1 N .. 100 N steps 400"),
        ("animate", PRESSED + "; cycle FA=20 N", "animate springs | loop frames 1000 to x.gif"),
        ("explain, table", table + "; cycle FA=20 N", "explain W"),
        ("a sweep of an input, table", table, "table a for k = 0 .. 0.5 steps 100000 to /dev/null"),
    ]


class Terminal:
    """A prompt on a terminal of its own."""

    def __init__(self, fret, env):
        self.pid, self.fd = pty.fork()
        if self.pid == 0:
            os.execve(fret, [fret, "--quiet", "--no-rc"], env)
        self.read(PATIENCE)

    def read(self, patience):
        """The output up to the next prompt; None: it did not come."""
        text, end = b"", time.monotonic() + patience
        while not text.endswith(b"fret> "):
            left = end - time.monotonic()
            if left <= 0 or not select.select([self.fd], [], [], left)[0]:
                return None
            try:
                text += os.read(self.fd, 1 << 16)
            except OSError:
                return None
        return text.decode("utf-8", "replace")

    def send(self, line):
        os.write(self.fd, line.encode() + b"\r")

    def say(self, line, patience=600):
        self.send(line)
        return self.read(patience)

    def close(self):
        with contextlib.suppress(ProcessLookupError):
            os.kill(self.pid, signal.SIGKILL)
        os.waitpid(self.pid, 0)
        os.close(self.fd)


def busy(pid):
    """Processor seconds of a process: unlike the time that passes, they do not count other processes."""
    with open("/proc/%d/schedstat" % pid, encoding="ascii") as f:
        return int(f.read().split()[0]) * 1e-9


def stolen():
    """Seconds that each processor of a virtual machine was taken away by its host (steal time), to 10 ms."""
    with open("/proc/stat", encoding="ascii") as f:
        return [int(line.split()[8]) / os.sysconf("SC_CLK_TCK") for line in f if line[:3] == "cpu" and line[3].isdigit()]


def interrupted(terminal, statement, delay):
    """Seconds from Ctrl-C to the prompt, processor seconds and stolen seconds among them; None: the statement had ended
    before, infinity: it did not end."""
    terminal.send(statement)
    answer = terminal.read(delay)
    if answer is not None:
        return None
    start, before, away = time.monotonic(), busy(terminal.pid), stolen()
    os.write(terminal.fd, termios.tcgetattr(terminal.fd)[6][termios.VINTR])
    answer = terminal.read(PATIENCE)
    if answer is None:
        return math.inf, math.inf, 0
    took = time.monotonic() - start, busy(terminal.pid) - before, max(now - then for now, then in zip(stolen(), away))
    return took if "interrupted" in answer else None


def measure(fret, env, case, delays):
    """Interrupts after these delays: [(seconds, processor seconds, stolen seconds)], and whether the scene stayed as it was."""
    _, before, statement = case
    terminal = Terminal(fret, env)
    try:
        for part in before.split("; "):
            terminal.say(part)
        took, kept = [], True
        for delay in delays:
            scene = terminal.say("show")
            one = interrupted(terminal, statement, delay)
            if one is None:
                continue
            took.append(one)
            kept = kept and one[0] != math.inf and terminal.say("show") == scene
            if not kept:
                break
        return took, kept
    finally:
        terminal.close()


def lasts(fret, env, case):
    """How long the statement takes [s], at most the longest delay."""
    terminal = Terminal(fret, env)
    try:
        for part in case[1].split("; "):
            terminal.say(part)
        start = time.monotonic()
        terminal.send(case[2])
        terminal.read(LONGEST)
        return time.monotonic() - start
    finally:
        terminal.close()


def main():
    fret = os.path.abspath(sys.argv[1])
    where = tempfile.mkdtemp(prefix="fret-latency-")
    env = {**os.environ, "TERM": "dumb", "HOME": where, "XDG_STATE_HOME": where, "INPUTRC": "/dev/null"}
    rnd = random.Random(1)
    os.chdir(where)
    try:
        print("# make latency INTERRUPTS=%d LONGEST=%g: Ctrl-C to the next prompt, so many interrupts at random moments "
              "of the first so many seconds [ms]" % (INTERRUPTS, LONGEST))
        print("# there: but for what other machines took of the processors of this one, to 10 ms")
        print("# %-38s %8s %8s %11s %20s" % ("", "p50", "p100", "p100 there", "p100 on a processor"))
        for case in cases(where, 1):
            if len(sys.argv) > 2 and case[0] not in sys.argv[2:]:
                continue
            last = lasts(fret, env, case)
            took, kept = measure(fret, env, case, sorted(rnd.uniform(0.01, last) for _ in range(INTERRUPTS)))
            wall = sorted(one[0] for one in took)
            there, own = (max(of(one) for one in took or [(0, 0, 0)]) for of in (lambda x: x[0] - x[2], lambda x: x[1]))
            text = ("%8.0f %8.0f %11.0f %20.0f" % (1e3 * wall[len(wall) // 2], 1e3 * wall[-1], 1e3 * there, 1e3 * own)
                    if wall and wall[-1] < math.inf else "   never" if wall else "   done before")
            print("%-40s %s%s" % (case[0], text, "" if kept else "  scene changed"), flush=True)
    finally:
        shutil.rmtree(where, ignore_errors=True)


if __name__ == "__main__":
    main()
