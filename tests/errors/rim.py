# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests the program at its limits: endless lines, failing allocations and system calls, signals at the prompt, control characters
in text, small stacks. Nothing may be lost, and no wrong result may go unreported."""
import errno
import os
import pty
import re
import resource
import select
import shutil
import signal
import stat
import subprocess
import sys
import termios
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "fuzz"))
import harness  # noqa: E402

import faults  # noqa: E402
import latency  # noqa: E402

SCENE = "material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"
ESCAPES = ("\x1b[31m", "\x9b31m", "\u202e", "\u200b", "\u2066", "\ufeff", "\x07")
MB = 1 << 20


def limited(tests, args, kind, limit, cwd=None, env=None, input=b""):
    """Runs the program with a resource limit."""
    done = subprocess.run([tests.fret, *args], input=input, capture_output=True, cwd=cwd or tests.dir, timeout=120,
                          env={**tests.env, **(env or {})}, check=False,
                          preexec_fn=lambda: resource.setrlimit(kind, (limit, limit)))
    done.stdout, done.stderr = done.stdout.decode("utf-8", "replace"), done.stderr.decode("utf-8", "replace")
    return done


def expect(tests, name, done, status, out=None, err=None):
    ok = (done.returncode == status and "Sanitizer" not in done.stderr and "runtime error" not in done.stderr
          and (out is None or out in done.stdout) and (err is None or err in done.stderr))
    tests.check(name, ok, "expected exit %s, %r, %r\n%s" % (status, out, err, tests.report(done)))


def lines_without_end(tests):
    """A line longer than the limit, and no memory while a line is read, are errors, not the end of the input."""
    for name, way in (("a script", lambda path: tests.run(path)),
                      ("a pipe", lambda path: subprocess.run(
                          "'%s' < '%s'" % (tests.fret, path), shell=True, capture_output=True, text=True,
                          env=tests.env, check=False)),
                      ("source", lambda path: tests.run("-c", "source " + path)),
                      ("a table", lambda path: tests.run("-c", "geometry file " + path)),
                      ("a transcript", lambda path: tests.run("--replay", path))):
        with tests.file("fret> x = 1 # " + "x" * (17 * MB) + "\nfret> x\nx = 1\n") as path:
            done = way(path)
            expect(tests, "a line of 17 MB: " + name, done, 1, None, ":1: the line is longer than 16 MB")
            tests.check("nothing behind it has run: " + name, "x = 1" not in done.stdout, done.stdout[:300])
    with tests.file("x = 1 + \\\n" + " " * (17 * MB) + "2\nx\n") as path:
        done = tests.run("--keep-going", path)
        expect(tests, "a continued line of 17 MB does not run its first half", done, 1, "", "longer than 16 MB")
    expect(tests, "source /dev/zero", tests.run("-c", "source /dev/zero"), 1, "", "longer than 16 MB")
    expect(tests, "geometry file /dev/zero", tests.run("-c", "geometry file /dev/zero"), 1, "", "longer than 16 MB")
    if tests.sanitized:  # AddressSanitizer needs all of the address space
        return
    follow = "FN [N],Fx [N]\n100,0\n100,30\n100,20" + " " * (10 * MB) + "\n"
    with tests.file(follow, ".csv") as path:
        done = limited(tests, ["-c", "material steel; geometry sphere R=10 mm; friction 0.4; follow %s; Fx" % path],
                       resource.RLIMIT_AS, 16 * MB)
        expect(tests, "no memory for a row of a history", done, 1, "", "memory")
    with tests.file("fret> 1\n1 = 1\nfret> 2 # " + "x" * (10 * MB) + "\n2 = 3\n") as path:
        done = limited(tests, ["--replay", path], resource.RLIMIT_AS, 16 * MB)
        expect(tests, "no memory for a line of a transcript", done, 1, "", "memory")
        tests.check("and no verdict", "passed" not in done.stdout, done.stdout)


def once(tests):
    """Makes some of the allocations and system calls of each statement fail, and all of those of statements that use every room
    of the program; `make faults` tries all."""
    folder = os.path.join(os.path.abspath(tests.build), "tests")
    if tests.sanitized or not os.path.exists(os.path.join(folder, "faults.so")):
        return
    env = {name: tests.env[name] for name in ("PATH", "LC_ALL", "TERM")}
    whole = {faults.allocations: ("demo", "plot loop", "save out.fret", "record log.txt"),
             faults.calls: ("save out.fret", "record log.txt", "history to out.csv")}

    def one(statement, kind):
        ends, wrong = faults.attempt(statement, kind, 1 if tests.few else 0 if statement.statement in whole[kind] else 2)
        tests.check("%s that fail in: %s" % (kind.__name__, statement.statement[:60]), not wrong and (ends or statement.statement in ("exit", "quit")),
                    "\n".join("%s: %s" % (faults.told(fault), what) for fault, what in wrong) or "nothing was counted")
    statements = faults.statements(tests.fret, folder, env)
    filtered = [s for s in statements if re.search(r"[a-z]\.[a-z]", s.statement)] if faults.can_filter(folder) else []
    tests.each([lambda s=s: one(s, faults.allocations) for s in statements] +
               [lambda s=s: one(s, faults.calls) for s in filtered])


def many_rows(tests):
    """`follow` interrupted at each allocation takes all rows of the file, or none."""
    folder = os.path.join(os.path.abspath(tests.build), "tests")
    if tests.sanitized or not os.path.exists(os.path.join(folder, "faults.so")):
        return
    env = {name: tests.env[name] for name in ("PATH", "LC_ALL", "TERM")}
    ends, wrong = faults.attempt(faults.Faults(tests.fret, folder, env, SCENE + "Fx", "follow follow.csv"), faults.interrupts)
    tests.check("many rows, interrupted", not wrong and ends, "%s\n%s" % (ends, wrong))


def lost_reads(tests):
    """A picture that cannot be read back is an error, not a shorter picture."""
    tool = os.path.join(os.path.abspath(tests.build), "tests", "calls")
    if tests.sanitized or not faults.can_filter(os.path.dirname(tool)):
        return
    where = os.path.join(tests.dir, "lost-reads")
    os.mkdir(where)
    for name in ("arm", "disarm"):
        with open(os.path.join(where, name), "w", encoding="ascii"):
            pass
    for target in ("", " to x.png", " to x.html"):
        script = "source arm\nplot x^2 for x = 0 .. 1%s\nsource disarm" % target
        for entry in os.listdir(where):
            if entry.startswith("x."):
                os.unlink(os.path.join(where, entry))
        refused = 0
        for number in tests.some(range(1, 40), 6):
            done = subprocess.run([tool, "told", "read", str(number), str(errno.EIO), tests.fret, "-c", script],
                                  capture_output=True, text=True, cwd=where, env=tests.env, timeout=60, check=False)
            with open(os.path.join(where, "told"), encoding="ascii") as f:
                if "FAILED" not in f.read():
                    break  # keep the picture of the last run
            left = [entry for entry in os.listdir(where) if entry not in ("arm", "disarm", "told")]
            for entry in left:
                os.unlink(os.path.join(where, entry))
            refused += "cannot read what gnuplot drew: Input/output error" in done.stderr
            tests.check("read %d of a plot%s" % (number, target), done.returncode == 1 and not left or
                        (done.returncode == 0 and left == [target[4:]] * (target != "")), "%s %s" % (left, done.stderr))
        tests.check("a lost read of a picture is told:%s" % target, refused > 0, str(refused))
    shutil.rmtree(where)


def no_more_keys(tests):
    """If waiting for a key fails for good the full-screen mode ends, and leaves the screen."""
    tool = os.path.join(os.path.abspath(tests.build), "tests", "calls")
    if tests.sanitized or not faults.can_filter(os.path.dirname(tool)):
        return
    where, text, end = os.path.join(tests.dir, "no-more-keys"), b"", time.monotonic() + 60
    os.mkdir(where)
    with open(os.path.join(where, "arm"), "w", encoding="ascii"):
        pass
    pid, fd = pty.fork()
    if pid == 0:
        os.chdir(where)
        os.execve(tool, [tool, "told", "pselect6", "1+", str(errno.EBADF), tests.fret, "-c", SCENE + "source arm; live; 1 + 1"],
                  {**tests.env, "TERM": "xterm-256color"})
    while time.monotonic() < end and select.select([fd], [], [], end - time.monotonic())[0]:
        try:
            text += os.read(fd, 1 << 16)
        except OSError:  # the program has ended
            break
    else:
        os.killpg(pid, signal.SIGKILL)
    os.close(fd)
    status = os.waitpid(pid, 0)[1]
    with open(os.path.join(where, "told"), encoding="ascii") as f:
        failed = f.read().count("FAILED")
    tests.check("a terminal that gives no keys", status == 0 and failed > 1 and re.search(rb"\x1b\[\?1049h.*\x1b\[\?1049l.*1 \+ 1 = 2\r?\n", text, re.S),
                "%d, %d calls failed: %r" % (status, failed, text[-500:]))


def transcripts(tests):
    """Bytes of a recording that are lost are reported at once, and at the end."""
    for name, script, out in (("at once", "record /dev/full\nx = 1\nx\n", ""), ("at the end", "record /dev/full\n", None),
                              ("by record off", "record /dev/full; record off\n", None)):
        done = tests.run(input=SCENE + script)
        expect(tests, "a transcript on a full disk, told " + name, done, 1, out, "cannot write /dev/full: No space left")
        tests.check("once: " + name, done.stderr.count("error:") == 1, done.stderr)


def limits(tests):
    """Statements that would take all memory are refused; a small stack is enough."""
    with tests.file("1" + "+1" * (5 * MB) + "\n") as path:
        done = tests.run(path) if tests.sanitized else limited(tests, [path], resource.RLIMIT_AS, 400 * MB)
        expect(tests, "a sum of 5e6 terms", done, 1, "", "more than 2097152 numbers, names and operators")
    if tests.sanitized:  # its stack frames are larger
        return
    script = SCENE + "cycle FA=20 N\n" + "".join("w%d := %s + 1\n" % (i, "w%d" % (i - 1) if i else "1")
                                                 for i in range(90)) + "w89\n"
    script += "(" * 150 + "1" + ")" * 150 + "\n" + "table dW(F), a(F) for F = 1 N .. 30 N steps 600 to /dev/null\n"
    script += "table " + ", ".join("x^%d" % i for i in range(1, 39)) + " for x = 1 .. 2 to /dev/null\n"
    script += "table dW for FA = 1 N .. 20 N steps 5 with mu = 0.3, 0.4\nexplain dW\nhistory to /dev/null\n"
    with tests.file(script) as path:
        expect(tests, "a stack of 256 kB", limited(tests, [path], resource.RLIMIT_STACK, 256 * 1024), 0, "w89 = 91")
        done = limited(tests, ["-c", "plot x, 2*x, x^2, x^3, x/2, x/3 for x = 1 .. 2 steps 1000000 to many.gp"],
                       resource.RLIMIT_AS, 120 * MB)
        expect(tests, "a plot of 6e6 points in 120 MB", done, 0, "", "many.gp")


def hostile(tests):
    """Bytes from files and names are escaped on the terminal, and valid UTF-8 in JSON."""
    where = os.path.join(tests.dir, "hostile")
    os.mkdir(where)
    for i, escape in enumerate(tests.some(ESCAPES, 3)):
        bad = "a%sb" % escape
        name = os.path.join(where, "gap%s.csv" % escape)
        with open(name, "w", encoding="utf-8") as f:
            f.write("r [mm],f [um]\n" + "".join("%g,%g\n" % (j / 50, j * j / 50) for j in range(40)))
        header = os.path.join(where, "header%d.csv" % i)
        with open(header, "w", encoding="utf-8") as f:
            f.write("r%s [mm],f [um]\n0,0\n1,1\n" % escape)
        transcript = os.path.join(where, "%s.txt" % bad)
        with open(transcript, "w", encoding="utf-8") as f:
            f.write("fret> 1 + 1\n1 + 1 = 3 %s\nfret> x = %s\n" % (escape, escape))
        script = os.path.join(where, "%s.fret" % bad)
        with open(script, "w", encoding="utf-8") as f:
            f.write("foo # %s\n" % escape)
        cases = {"statement": "1 + %s" % bad, "name": "%s = 1; %s" % (bad, bad), "comment": "foo # %s" % escape,
                 "help": "help " + bad, "apropos": "apropos " + bad, "file": 'geometry file "%s"; show' % name,
                 "explain": 'material steel; geometry file "%s"; explain f' % name,
                 "no file": 'geometry file "%s"' % bad, "header": "geometry file %s" % header,
                 "source": 'source "%s"' % script, "unit": "1 %s" % bad, "setting": "set %s" % bad,
                 "table": 'table x for x = 1 .. 2 to "%s/%s.csv"' % (where, bad),
                 "replay": 'replay "%s"' % transcript, "save": 'save "%s/%s.fret"' % (where, bad),
                 "record": 'record "%s/%s.log"; %s' % (where, bad, bad), "live": 'live "%s"' % bad,
                 "over": 'plot x in um for x = 1 um .. 2 um over "%s"' % header,
                 "fit": SCENE + 'fit E0 for %s = 1 to "%s"' % (bad, header), "export": 'export jenkins 3 to "%s.csv"' % bad,
                 "picture": 'plot x for x = 1 .. 2 title "%s" to "%s/%s.gp"' % (bad, where, bad),
                 "drawing": 'plot x for x = 1 .. 2 title "%s"' % bad,
                 "argument": "press %s=1" % bad, "show": "show " + bad, "figure": "plot " + bad}
        for case, statement in cases.items():
            for way in ("text", "json"):
                done = subprocess.run([tests.fret, "--keep-going", "--format=" + way, "-c", statement],
                                      capture_output=True, env=tests.env, cwd=where, timeout=60, check=False)
                both = done.stdout + done.stderr
                raw = escape.encode() in both or b"\x1b" in both
                valid = True
                try:
                    both.decode("utf-8")
                except UnicodeDecodeError:
                    valid = False
                tests.check("%s with U+%04X as %s" % (case, ord(escape[0]), way),
                            not raw and valid and done.returncode in (0, 1), repr(both[:600]))
        for args in (["--" + bad], ["--format=" + bad], [bad], ["-f", bad], ["--replay", bad], ["--live", bad],
                     ["--replay", transcript]):
            done = subprocess.run([tests.fret, *args], capture_output=True, env=tests.env, cwd=where, timeout=60,
                                  check=False)
            tests.check("option with U+%04X: %s" % (ord(escape[0]), ascii(args)),
                        escape.encode() not in done.stdout + done.stderr and done.stdout + done.stderr,
                        repr(done.stdout + done.stderr))
    for args in (["-c", b"1 + \xff\xfe"], ["-c", b'geometry file "\xff"'], [b"\xff\xfe"]):
        done = subprocess.run([tests.fret, "--format=json", *args], capture_output=True, env=tests.env, cwd=where,
                              timeout=60, check=False)
        expect_utf8 = done.stdout + done.stderr
        tests.check("bytes that are no UTF-8: %s" % args, b"\xff" not in expect_utf8 and done.returncode == 1,
                    repr(expect_utf8))
    long = "+".join(["1"] * 300)
    done = tests.run("--format=json", "-c", long)
    expect(tests, "a long name in JSON is whole", done, 0, '{"name":"%s",' % long)
    done = tests.run("--format=json", "-c", "table x, x, x^2 for x = 1 .. 2 steps 1")
    expect(tests, "columns that stand twice in JSON", done, 0, '{"x":1,"x (2)":1,"x (3)":1,"x^2":1}')
    done = tests.run("--format=csv", input="table x, \\\n 2*x + \\\n1 for x = 1 .. 2 steps 1\n")
    expect(tests, "a continued line in a header", done, 0, "x,x (2),2*x + 1\n")
    shutil.rmtree(where)


def fake_gnuplot(tests, words):
    where = os.path.join(tests.dir, "fake-gnuplot")
    os.makedirs(where, exist_ok=True)
    path = os.path.join(where, "gnuplot")
    with open(path, "wb") as f:
        f.write(b"#!/bin/sh\n[ \"$1\" = --version ] && { echo gnuplot 5.4; exit 0; }\nprintf '%b' '" + words +
                b"' >&2; exit 1\n")
    os.chmod(path, 0o755)
    return {"PATH": where + ":" + tests.env["PATH"]}


def gnuplot(tests):
    env = fake_gnuplot(tests, rb"line 3: \033]0;gotcha\007 \342\200\256evil \377")
    done = subprocess.run([tests.fret, "-c", "plot x for x = 1 .. 2 to x.png"], capture_output=True,
                          env={**tests.env, **env}, cwd=tests.dir, timeout=60, check=False)
    tests.check("gnuplot's words", b"evil" in done.stderr and not any(
        bad in done.stderr for bad in (b"\x1b", b"\x07", b"\xe2\x80\xae", b"\xff")), repr(done.stderr))
    tab = os.path.join(tests.dir, "tab")
    os.mkdir(tab)
    done = subprocess.run([tests.fret, "-c", "plot x for x = 1 .. 2 to \"a\tb.png\""], capture_output=True, env=tests.env,
                          cwd=tab, timeout=60, check=False)
    tests.check("a tab in a plot's name", done.returncode == 0 and os.listdir(tab) == ["a\tb.png"] and
                b"\t" not in done.stderr, repr((done.stderr, os.listdir(tab))))
    deep = os.path.join(tests.dir, "deep")
    os.mkdir(deep)
    here = os.open(deep, os.O_RDONLY)
    try:
        for _ in range(22):
            os.mkdir("d" * 200, dir_fd=here)
            inner = os.open("d" * 200, os.O_RDONLY, dir_fd=here)
            os.close(here)
            here = inner
        done = subprocess.run([tests.fret, "-c", 'plot x for x = 1 .. 2 to "|touch pwned #.png"'], capture_output=True,
                              env=tests.env, timeout=60, check=False, preexec_fn=lambda: os.fchdir(here))
        left = os.listdir(here)
        tests.check("a name in a deep directory is no command", "pwned" not in left and
                    all("part" not in name for name in left), "%s %s" % (left, done.stderr))
    finally:
        os.close(here)
        subprocess.run(["rm", "-rf", deep], check=False)


# The prompt is a job of a session leader, such as a shell: an orphaned process group cannot be stopped.
LEADER = """
import fcntl, os, signal, sys, termios
fcntl.ioctl(0, termios.TIOCSCTTY, 0)
pid = os.fork()
if pid == 0:
    os.setpgrp()
    signal.signal(signal.SIGTTOU, signal.SIG_IGN)
    os.tcsetpgrp(0, os.getpid())
    signal.signal(signal.SIGTTOU, signal.SIG_DFL)
    os.execv(sys.argv[2], sys.argv[2:])
os.write(int(sys.argv[1]), b"%d\\n" % pid)
status = os.waitpid(pid, 0)[1]
os.write(int(sys.argv[1]), b"%d\\n" % (-os.WTERMSIG(status) if os.WIFSIGNALED(status) else os.WEXITSTATUS(status)))
"""


class Prompt:
    """The prompt on a terminal whose modes are compared."""

    def __init__(self, tests, **env):
        self.tests = tests
        self.main, self.side = pty.openpty()
        self.before = termios.tcgetattr(self.side)
        told, tell = os.pipe()
        self.leader = subprocess.Popen([sys.executable, "-c", LEADER, str(tell), tests.fret, "--quiet", "--no-rc"],
                                       stdin=self.side, stdout=self.side, stderr=self.side, cwd=tests.dir,
                                       start_new_session=True, pass_fds=[tell],
                                       env={**tests.env, "TERM": "xterm", "INPUTRC": "/dev/null", **env})
        os.close(tell)
        self.told = os.fdopen(told)
        self.pid = int(self.told.readline())
        self.read()

    def read(self, seconds=60, end=b"fret> "):
        text, limit = b"", time.monotonic() + seconds
        while end not in text and b"virtual memory" not in text and select.select([self.main], [], [], max(0, limit - time.monotonic()))[0]:
            try:
                text += os.read(self.main, 65536)
            except OSError:
                break
        return text.decode("utf-8", "replace")

    def say(self, line):
        os.write(self.main, line.encode() + b"\r")
        return self.read()

    def restored(self):
        """Are the modes as before, after some seconds at most?"""
        for _ in range(100):
            if termios.tcgetattr(self.side) == self.before:
                return True
            time.sleep(0.05)
        return False

    def signal(self, number):
        os.kill(self.pid, number)

    def status(self):
        """The exit status; None: it has not ended."""
        return int(self.told.readline()) if select.select([self.told], [], [], 60)[0] else None

    def stopped(self):
        for _ in range(2000):
            with open("/proc/%d/stat" % self.pid, encoding="ascii") as f:
                if f.read().rpartition(")")[2].split()[0] == "T":
                    return True
            time.sleep(0.02)
        return False

    def close(self):
        try:
            self.signal(signal.SIGKILL)
        except ProcessLookupError:
            pass
        self.leader.wait()
        self.told.close()
        os.close(self.main)
        os.close(self.side)


def inherited(tests):
    """Signals that the parent has ignored: nohup(1) is obeyed; an ignored SIGCHLD does not prevent waiting for children."""
    for number in (signal.SIGHUP, signal.SIGINT):
        child = subprocess.Popen([tests.fret, "-c", "x = 1; source /dev/stdin; x + 1"], stdin=subprocess.PIPE,
                                 stdout=subprocess.PIPE, env=tests.env,
                                 preexec_fn=lambda n=number: signal.signal(n, signal.SIG_IGN))
        time.sleep(0.3)
        child.send_signal(number)
        out = child.communicate(b"x\n", timeout=30)[0]
        tests.check("%s ignored from the start" % number.name, child.returncode == 0 and b"x + 1 = 2" in out,
                    "%s %s" % (child.returncode, out))
    done = subprocess.run([tests.fret, "-c", "plot x for x = 1 .. 2"], env=tests.env, capture_output=True, text=True,
                          preexec_fn=lambda: signal.signal(signal.SIGCHLD, signal.SIG_IGN), timeout=60, check=False)
    expect(tests, "a plot where ended children are not kept", done, 0, "1.5", "")
    done = subprocess.run([tests.fret, "-c", "plot x for x = 1 .. 2"], capture_output=True, text=True, timeout=60, check=False,
                          env={**tests.env, **fake_gnuplot(tests, b"broken")},
                          preexec_fn=lambda: signal.signal(signal.SIGCHLD, signal.SIG_IGN))
    expect(tests, "and gnuplot's failure is seen", done, 1, None, "broken")
    where = os.path.join(tests.dir, "closed")
    os.mkdir(where)
    with open(os.path.join(where, "h.csv"), "w", encoding="ascii") as f:
        f.write("FN [N],Fx [N]\n100,0\n100,30\n")
    kept = []
    for closed in ((), (0,), (1,), (2,), (0, 1, 2)):
        subprocess.run([tests.fret, "--keep-going", "-c", SCENE + "follow h.csv\nrecord kept.txt\na, Fx\nfoo\nrecord off"],
                       cwd=where, env=tests.env, capture_output=True, timeout=60, check=False,
                       preexec_fn=lambda fds=closed: [os.close(fd) for fd in fds])
        with open(os.path.join(where, "kept.txt"), encoding="ascii") as f:
            kept.append(f.read())
        os.unlink(os.path.join(where, "kept.txt"))
        tests.check("a file is no standard stream, closed: %s" % (closed,), kept[-1] == kept[0] and "Fx = 30 N\n" in kept[0]
                    and kept[0].count("error:") == 1, kept[-1])


def signals(tests):
    for number in (signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT, signal.SIGUSR1):
        p = Prompt(tests)
        os.write(p.main, b"1 + 1")
        p.read(0.5, b"1 + 1")
        edits = termios.tcgetattr(p.side) != p.before
        resource.setrlimit(resource.RLIMIT_CORE, (0, resource.getrlimit(resource.RLIMIT_CORE)[1]))
        p.signal(number)
        status = p.status()
        tests.check("%s at the prompt ends with its status" % number.name, status == -number and edits, str(status))
        tests.check("%s at the prompt restores the terminal" % number.name, p.restored())
        p.close()
    p = Prompt(tests)
    os.write(p.main, b"x = 4")
    p.read(0.5, b"x = 4")
    raw = termios.tcgetattr(p.side)
    p.signal(signal.SIGTSTP)
    tests.check("SIGTSTP stops", p.stopped())
    tests.check("SIGTSTP restores the terminal", raw != p.before and p.restored())
    p.signal(signal.SIGCONT)
    p.read(5)
    for _ in range(100):
        if termios.tcgetattr(p.side) == raw:
            break
        time.sleep(0.05)
    tests.check("SIGCONT prepares it again", termios.tcgetattr(p.side) == raw)
    os.write(p.main, b"\r")
    p.read()
    tests.check("and the line goes on", "x = 4" in p.say("x"))
    p.close()


def prompt_memory(tests):
    """Allocations fail while a line is edited: the terminal is restored, and if the program ends its status is not 0."""
    shim = os.path.join(os.path.abspath(tests.build), "tests", "faults.so")
    if tests.sanitized or not os.path.exists(shim):
        return
    with open(os.path.join(tests.dir, "arm"), "w", encoding="ascii"):
        pass
    for number in tests.some(range(1, 62, 12)):
        p = Prompt(tests, LD_PRELOAD=shim, FAULT=str(number))
        text = p.say("source arm")
        for line in ("x = 5", "x", "x + 1", "\x04"):
            if "virtual memory" not in text:  # readline's message: it ends the program
                os.write(p.main, line.encode() + (b"" if line == "\x04" else b"\r"))
                text += p.read(0.7 if line == "\x04" else 2)
        status = p.status()
        tests.check("allocation %d at the prompt" % number, p.restored() and
                    (status == 1 if "virtual memory" in text else status == 0 and "x + 1 = 6" in text or "memory" in text),
                    "%s %s" % (status, text))
        p.close()


def ended_at_work(tests):
    """When a signal ends the program, half-written files, gnuplot and its directory are removed."""
    where = os.path.join(tests.dir, "ended")
    tmp = os.path.join(where, "tmp")
    os.makedirs(tmp)
    env = fake_gnuplot(tests, b"")
    with open(os.path.join(tests.dir, "fake-gnuplot", "gnuplot"), "w", encoding="ascii") as f:
        f.write("#!/bin/sh\n[ \"$1\" = --version ] && { echo gnuplot 5.4; exit 0; }\necho $$ >%s/pid\nexec sleep 60\n"
                % where)
    for number in tests.some((signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT)):
        for name, statement, begun in (
                ("a table", "table x for x = 1 .. 2 steps 100000000 to out.csv", lambda: len(os.listdir(where)) > 1),
                ("a plot", "plot x for x = 1 .. 2 to out.png", lambda: os.path.exists(where + "/pid"))):
            child = subprocess.Popen([tests.fret, "-c", statement], cwd=where, stderr=subprocess.DEVNULL,
                                     stdout=subprocess.DEVNULL, env={**tests.env, **env, "TMPDIR": tmp})
            limit = time.monotonic() + 60
            while not begun() and time.monotonic() < limit:
                time.sleep(0.02)
            child.send_signal(number)
            status = child.wait(60)
            left = [entry for entry in os.listdir(where) if entry not in ("tmp", "pid")] + os.listdir(tmp)
            tests.check("%s during %s" % (number.name, name), status == -number and not left, "%s %s" % (status, left))
            if os.path.exists(where + "/pid"):
                with open(where + "/pid", encoding="ascii") as f:
                    pid = f.read().strip()
                for _ in range(100):
                    if not pid or not os.path.exists("/proc/" + pid) or gone(pid):
                        break
                    time.sleep(0.05)
                tests.check("%s ends gnuplot" % number.name, not pid or gone(pid))
                os.unlink(where + "/pid")
    done = limited(tests, ["-c", "table x for x = 1 .. 2 steps 1000000 to big.csv"], resource.RLIMIT_FSIZE, 65536,
                   cwd=where)
    expect(tests, "a file beyond the limit", done, 1, "", "cannot write")
    tests.check("leaves nothing", not [entry for entry in os.listdir(where) if entry != "tmp"], str(os.listdir(where)))
    shutil.rmtree(where)


def gone(pid):
    """Has the process ended, or is it a zombie?"""
    try:
        with open("/proc/%s/stat" % pid, encoding="ascii") as f:
            return f.read().rpartition(")")[2].split()[0] == "Z"
    except OSError:
        return True


def interrupts(tests):
    """Ctrl-C in the slowest statements, on smaller cases: it takes effect soon, and the scene is as before."""
    where = os.path.join(tests.dir, "latency")
    os.mkdir(where)
    env = {**tests.env, "TERM": "dumb", "INPUTRC": "/dev/null", "XDG_STATE_HOME": where}
    size = 50 if tests.sanitized else 10
    for case in tests.some(latency.cases(where, size), 3):
        took, kept = latency.measure(tests.fret, env, case, (0.05, 0.4))
        tests.check("Ctrl-C: " + case[0], kept and all(one[0] < 2 for one in took), "%s, scene kept: %s" % (took, kept))
    p = Prompt(tests)
    with tests.file(SCENE.replace("; ", "\nfret> ").join(("fret> ", "")) +
                    "fret> cycle dxA=0.1 um FNA=30 N times 20\n" * 1000) as path:
        os.write(p.main, b"replay " + path.encode() + b"\r")
        p.read(0.5, b"nothing")
        os.write(p.main, b"\x03")
        text = p.read(20, b"\x1b[?2004h")
        tests.check("an interrupted replay judges nothing", "interrupted" in text and "failed" not in text, text[:2000])
    p.close()
    p = Prompt(tests)
    fifo = os.path.join(where, "fifo")
    os.mkfifo(fifo)
    os.write(p.main, b"source " + fifo.encode() + b"\r")
    p.read(0.5, b"nothing")
    os.write(p.main, b"\x03")
    tests.check("an interrupted source says so", "interrupted" in p.read())
    p.close()
    shutil.rmtree(where)


def history(tests):
    """The history file: no home directory is made, no link followed, no pipe waited for."""
    home = os.path.join(tests.dir, "no-home")
    p = Prompt(tests, HOME=home)
    p.say("1")
    p.close()
    tests.check("a missing home stays missing", not os.path.exists(home))
    state = os.path.join(tests.dir, "state-rim")
    os.makedirs(os.path.join(state, "fret"))
    path, victim = os.path.join(state, "fret", "history"), os.path.join(tests.dir, "victim")
    with open(victim, "w", encoding="ascii") as f:
        f.write("mine\n")
    os.chmod(victim, 0o644)
    os.symlink(victim, path)
    p = Prompt(tests, XDG_STATE_HOME=state)
    p.say("1 + 2")
    p.close()
    with open(victim, encoding="ascii") as f:
        text = f.read()
    tests.check("a link as history is not followed", text == "mine\n" and
                stat.S_IMODE(os.stat(victim).st_mode) == 0o644, text)
    os.unlink(path)
    os.mkfifo(path)
    p = Prompt(tests, XDG_STATE_HOME=state)
    tests.check("a pipe as history does not block", "1 + 2 = 3" in p.say("1 + 2"))
    p.close()


# each input as a function of s, and another input that it needs
FOLLOWS = {"E0": "210 GPa*%s", "nu": "0.3*%s", "k": "0.3*%s", "c0": "1 mm*%s", "E0_2": "70 GPa*%s", "mu": "0.4*%s",
           "FN": "100 N*%s", "FA": "20 N*%s", "dxA": "0.5 um*%s"}
# geometry, what belongs to it and follows it; load; model
NEEDING = (("sphere R=10 mm", {"R": "10 mm*%s"}, "cycle FA=20 N", "auto"),
           ("sphere R=10 mm", {"R": "10 mm*%s"}, "step Fx=20 N", "memory"),
           ("sphere R=10 mm", {}, "step FN=80 N Fx=20 N; cycle dxA=0.5 um", "auto"),
           ("power n=3 A=50 m^-2", {"A": "50 m^-2*%s"}, "cycle FA=20 N", "auto"),
           ("power n=4 h=1 um r0=1 mm", {"n": "4*%s", "h": "1 um*%s", "r0": "1 mm*%s"}, "cycle dxA=0.1 um times 2", "springs 50"),
           ("flat-rounded b=0.2 mm R=10 mm", {"b": "0.2 mm*%s"}, "cycle FA=20 N", "closed"),
           ("cone slope=0.05", {"slope": "0.05*%s"}, "cycle FA=12 N FNA=9 N", "auto"),
           ("exact-sphere R=10 mm", {"R": "10 mm*%s"}, "step Fx=20 N", "auto"),
           ("file %s", {}, "cycle FA=20 N", "auto"), ("file %s", {}, "cycle FA=12 N FNA=9 N", "auto"))
CALLS = {"E": "1 mm", "loss_factor": "10 N", "c": "10 N", "F": "10 N", "d": "0.1 um", "FA": "10 N", "dxA": "0.1 um", "x": "0.1 mm",
         "r": "0.1 mm"}


def quantities(tests):
    """All quantities; functions as calls."""
    listed = tests.run("-c", "help quantities").stdout.partition("Results:")[2].partition("fret>")[0]
    asked = ["%s(%s)" % (name, CALLS.get(name) or CALLS[argument]) if argument else name
             for name, argument in re.findall(r"^    (\w+)(?:\((\w+)\))?  ", listed, re.M)]
    tests.check("quantities", len(asked) > 40, listed)
    return asked


def needs(tests):
    """At an impossible value of an input, quantities that depend on it are errors, and the others keep their value."""
    asked = quantities(tests)
    with tests.file("r [mm],f [um]\n" + "".join("%g,%g\n" % (i / 50, i * i / 50) for i in range(51)), ".csv") as path:
        tests.each([lambda s=scene, n=name: needed(tests, asked, s, n, path) for scene in tests.some(NEEDING, 3)
                    for name in {**FOLLOWS, **scene[1]} if name not in ("FA", "dxA") or name + "=" in scene[2]])


def needed(tests, asked, scene, name, path):
    geometry, own, load, model = scene
    told = "%s of %s, %s, %s" % (name, geometry, load, model)
    lines = ["s = 1; material E0=210 GPa nu=0.3 k=0.3 c0=1 mm; second E0=70 GPa nu=0.2; friction 0.4",
             "geometry " + (geometry % path if "%" in geometry else geometry), "press FN=100 N; " + load,
             "%s := %s" % (name, {**FOLLOWS, **own}[name] % "sqrt(s)"), "set model " + model, "set format json"]
    first = len(lines) + 1
    for one in asked:
        lines += [one, "(%s at s=1.001)" % one, "(%s at s=-1)" % one]
    with tests.file("\n".join(lines) + "\n") as script:
        done = tests.run("--keep-going", script)
    failed = {int(line): words for line, words in re.findall(r":(\d+):\d+: error: (.*)", done.stderr)}
    values = iter([line for line in done.stdout.splitlines() if line.startswith('{"name":')])
    value = {line: None if line in failed else next(values, "") for line in range(first, len(lines) + 1)}
    tests.check(told, not any(line < first for line in failed) and next(values, None) is None, tests.report(done))
    value = {line: re.sub(r'"name":"[^"]*",', "", text or "") for line, text in value.items()}
    moved = 0
    for i, one in enumerate(asked):
        here, near, there = range(first + 3 * i, first + 3 * i + 3)
        moves = here not in failed and value[here] != value[near]
        moved += moves
        if there in failed:
            ok = here in failed or "square root of a negative" in failed[there]
        else:
            ok = value[here] == value[near] == value[there] and not moves
        tests.check("%s, %s" % (one, told), ok, "%s\n%s\n%s %s" % (value[here], value[near], value[there], failed.get(there)))
    tests.check("what moves with " + told, moved > 0, str(moved))


# scenes, and inputs over which tables are made
TABLED = (("material E0=210 GPa nu=0.3 k=0.3 c0=1 mm; geometry sphere R=10 mm; friction 0.4; press FN=100 N; cycle FA=20 N",
           ("E0 = 100 GPa .. 200 GPa", "nu = 0.1 .. 0.3", "k = -0.2 .. 0.2", "mu = 0.3 .. 0.5", "FN = 80 N .. 120 N", "R = 5 mm .. 9 mm",
            "FA = 10 N .. 30 N", "FN = 20 N .. 60 N", "nu = 0.4 .. 0.6")),
          ("material E0=210 GPa nu=0.3 k=0.3 c0=1 mm; geometry sphere R=10 mm; press FN=100 N", ("E0 = 100 GPa .. 200 GPa", "mu = 0.3 .. 0.5")),
          ("material E0=210 GPa nu=0.3; geometry cone slope=0.1; friction 0.4", ("E0 = 100 GPa .. 200 GPa", "slope = 0.1 .. 0.2")),
          ("E0 = 210 GPa; friction 0.4", ("E0 = 100 GPa .. 200 GPa", "nu = 0.1 .. 0.3", "mu = 0.1 .. 0.2")),
          ("material steel; second E0=70 GPa nu=0.2; geometry sphere R=10 mm; friction 0.4; press dz=1 um; step dx=0.1 um",
           ("E0_2 = 50 GPa .. 90 GPa", "nu_2 = 0.1 .. 0.4", "mu = 0.3 .. 0.5")),
          ("material steel; second rigid; geometry power n=3 A=50 m^-2; friction 0.4; press FN=9 N; step Fx=-2 N",
           ("E0 = 100 GPa .. 200 GPa", "mu = 0.3 .. 0.5", "A = 40 m^-2 .. 90 m^-2")),
          ("material steel; geometry power n=4 h=1 um r0=1 mm; friction 0.4; press FN=9 N; step Fx=2 N; step Fx=0 N",
           ("E0 = 100 GPa .. 200 GPa", "h = 1 um .. 2 um", "FN = 8 N .. 9 N")),
          ("material steel; geometry sphere R=10 mm; friction 0.4; press FN=9 N; step Fx=2 N; step FN=8 N", ("R = 5 mm .. 9 mm",)),
          ("material steel; geometry sphere R=10 mm; friction 0.4; press FN=9 N; cycle dxA=0.1 um; set model memory", ("R = 5 mm .. 9 mm",)),
          ("material steel; geometry sphere R=10 mm; friction 0.4; press FN=9 N; cycle FA=1 N FNA=1 N", ("R = 5 mm .. 9 mm",)))


def tabled(tests):
    """Each row of a table over an input has the value of the scene with that input, whether rows are computed together or one by one."""
    asked = quantities(tests) + ["E0", "nu", "k", "c0", "mu", "R", "A", "FN", "FA", "2*a+0 m", "a/a0"]
    tests.each([lambda s=scene, r=span: columns(tests, asked, s, r) for scene, spans in tests.some(TABLED, 3) for span in spans])


def columns(tests, asked, scene, span):
    name, lo, hi = re.fullmatch(r"(\w+) = (.*) \.\. (.*)", span).groups()
    places, asked = [lo, "(%s+%s)/2" % (lo, hi), hi], [one for one in asked if one != name]
    lines = [scene, "set format json"]
    for one in asked:
        lines += ["table %s for %s steps 2" % (one, span)] + ["(%s at %s=%s)" % (one, name, place) for place in places]
    with tests.file("\n".join(lines) + "\n") as script:
        done = tests.run("--keep-going", script)
    failed = {int(line) for line in re.findall(r":(\d+):\d+: error: ", done.stderr)}
    told = harness.told(done.stdout)
    rows = {}
    for row in told:
        rows.setdefault(list(row)[-1], []).append(list(row.values())[-1])
    values = iter([row["value"] for row in told if "name" in row])
    for i, one in enumerate(asked):
        line = 3 + 4 * i
        got = rows.get(one, [None] * 3)
        want = [None if line + 1 + j in failed else next(values, None) for j in range(3)]
        ok = len(got) == 3 and all(a == b or (None not in (a, b) and abs(a - b) <= 1e-13 * abs(b)) for a, b in zip(got, want))
        tests.check("table %s for %s: %s" % (one, span, scene), ok, "%s\n%s\n%s" % (got, want, done.stderr[-1500:]))
    tests.check("nothing more for %s: %s" % (span, scene), next(values, None) is None and not {1, 2} & failed,
                tests.report(done))


def along(tests):
    """In the last row of a table along the load every quantity has the value that it has at the end of the load."""
    asked = [one for one in quantities(tests) if one != "time"]
    loads = ("press FN=100 N", "step Fx=20 N", "step FN=80 N Fx=20 N", "step Fx=20 N; step dx=-0.1 um", "cycle FA=20 N times 2",
             "cycle dxA=0.3 um; step FN=90 N", "cycle FA=12 N FNA=9 N", "cycle dxA=0.3 um FNA=9 N")
    with tests.file("r [mm],f [um]\n" + "".join("%g,%g\n" % (i / 50, i * i / 50) for i in range(51)), ".csv") as path:
        tests.each([lambda g=shape, l=load: ends(tests, asked, "geometry " + (g % path if "%" in g else g), l)
                    for shape in tests.some(("sphere R=10 mm", "flat-rounded b=0.2 mm R=10 mm", "file %s"), 2) for load in tests.some(loads, 3)])


def ends(tests, asked, shape, load):
    lines = ["material E0=210 GPa nu=0.3 k=0.3 c0=1 mm; friction 0.4; %s; press FN=100 N; %s" % (shape, load), "set format json"]
    for one in asked:
        lines += ["table %s along program steps 2" % one, one]
    with tests.file("\n".join(lines) + "\n") as script:
        done = tests.run("--keep-going", script)
    failed = {int(line) for line in re.findall(r":(\d+):\d+: error: ", done.stderr)}
    told = harness.told(done.stdout)
    rows = {list(row)[-1]: list(row.values())[-1] for row in told if "name" not in row}
    values = {row["name"]: row["value"] for row in told if "name" in row}
    tests.check("along " + load, not {1, 2} & failed and len(values) > 40, tests.report(done))
    for one in asked:
        a, b = rows.get(one), values.get(one)
        near = 1e-7 if "FNA" in load else 1e-11  # one value is by chords, the other by the sine itself
        tests.check("%s along %s, %s" % (one, load, shape), a == b or (None not in (a, b) and abs(a - b) <= near * abs(b)),
                    "%s, expected %s" % (a, b))


ROOM = (many_rows, needs, tabled, along, lines_without_end, once, lost_reads, no_more_keys, transcripts, limits, hostile, gnuplot, inherited, signals, prompt_memory, ended_at_work, interrupts, history)


def run(tests):
    for room in ROOM:
        room(tests)
