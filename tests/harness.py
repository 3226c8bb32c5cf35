# SPDX-License-Identifier: GPL-3.0-or-later
"""What the rooms of tests share: running the program, comparing its output, counting tests."""
import contextlib
import difflib
import json
import os
import re
import shutil
import signal
import subprocess
import tempfile
import threading
import time
import traceback
from concurrent.futures import ThreadPoolExecutor

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PROMPT = "fret> "
NUMBER = re.compile(r"\d+\.?\d*(?:[eE][-+]?\d+)?|\.\d+(?:[eE][-+]?\d+)?")


def told(text):
    """The rows of JSON output, without messages and heads of tables."""
    return [row for row in map(json.loads, text.splitlines()) if "columns" not in row and next(iter(row)) not in ("note", "warning", "error")]


def printed_values(text):
    """The values of the rows of JSON output that are no events."""
    return [row["value"] for row in told(text) if "event" not in row]


def reported(stderr, names, verb="wrote"):
    """Does standard error report that these files were written, in this order, and nothing else?"""
    found = re.findall(r"^%s (.*) \([\d.]+ k?B\)\n" % verb, stderr, re.M)
    return found == list(names) and len(stderr.splitlines()) == len(found)


def last_place(number):
    """One unit in the last printed place."""
    mantissa, _, exponent = number.lower().partition("e")
    places = len(mantissa.partition(".")[2])
    return 10.0 ** (int(exponent or 0) - places)


def same_line(want, got):
    """Is the text equal, and is each number equal to one unit of its last digit, but at most 1.1e-5 of it, so that short numbers
    (1, 0.5) are exact, and at least 1e-12 of it, for numbers of 17 digits?"""
    want, got = want.rstrip(), got.rstrip()
    if want == got:
        return True
    if NUMBER.sub("0", want) != NUMBER.sub("0", got):
        return False
    return all(abs(float(w) - float(g)) <= max(min(1.000001 * last_place(w), 1.1e-5 * abs(float(w))),
                                                1e-12 * abs(float(w)))
               for w, g in zip(NUMBER.findall(want), NUMBER.findall(got)))


def same_text(want, got):
    want, got = want.rstrip().splitlines(), got.rstrip().splitlines()
    return len(want) == len(got) and all(map(same_line, want, got))


def diff(want, got):
    lines = difflib.unified_diff(want.splitlines(), got.splitlines(), "expected", "got", lineterm="", n=1)
    return "\n".join(line[:300] for line in list(lines)[:40])


def at_work(process):
    """Waits until the process has a handler for SIGINT, and a little longer. False: it has ended."""
    while process.poll() is None:
        with open("/proc/%d/status" % process.pid, encoding="ascii") as f:
            caught = re.search(r"^SigCgt:\s*(\w+)", f.read(), re.M)
        if caught and int(caught.group(1), 16) >> (signal.SIGINT - 1) & 1:
            time.sleep(0.3)
            return process.poll() is None
        time.sleep(0.01)
    return False


def links(compiler, flags, source="int main(void) { return 0; }"):
    """Is the compiler installed, with the libraries that these flags need?"""
    with tempfile.TemporaryDirectory(prefix="fret-links-") as folder:
        return shutil.which(compiler) and subprocess.run(
            [compiler, *flags.split(), "-x", "c", "-", "-o", os.path.join(folder, "out")], input=source, text=True,
            capture_output=True, check=False).returncode == 0


def usual_signals():
    """Undoes what nohup and & do: they have signals ignored, and programs started from here would ignore them too."""
    for number in (signal.SIGHUP, signal.SIGINT, signal.SIGQUIT, signal.SIGTERM):
        if signal.getsignal(number) == signal.SIG_IGN:
            signal.signal(number, signal.SIG_DFL)


class Case:
    """A named test; a loop that draws a million scenes is one case."""

    def __init__(self):
        self.ok, self.draws, self.seconds = True, 0, 0.0


class Tests:
    """One run of rooms with one build of the program. `few`: make few random draws, for there is little time."""

    def __init__(self, build, label, sanitized, few=False):
        self.fret = os.path.join(ROOT, build, "fret")
        self.build, self.label, self.sanitized, self.few = build, label, sanitized, few
        self.cases = {}
        self.lock = threading.Lock()
        self.since = threading.local()  # when this thread recorded its last case, or started
        self.top = self.dir = tempfile.mkdtemp(prefix="fret-tests-")
        self.tmp = os.path.join(self.top, "tmp")  # where the program may keep temporary files
        os.makedirs(os.path.join(self.top, "home"))
        os.mkdir(self.tmp)
        usual_signals()
        self.env = {"PATH": os.environ["PATH"], "HOME": os.path.join(self.top, "home"), "TMPDIR": self.tmp,
                    "LC_ALL": "C", "TERM": "dumb", "FRET_FEW": "1" if few else "",
                    "ASAN_OPTIONS": "detect_leaks=1:allocator_may_return_null=1"}
        for name in ("LD_LIBRARY_PATH", "FRET_REFERENCE"):
            if name in os.environ:
                self.env[name] = os.environ[name]

    def close(self):
        shutil.rmtree(self.top, ignore_errors=True)

    @property
    def passed(self):
        return sum(case.ok for case in self.cases.values())

    @property
    def failed(self):
        return len(self.cases) - self.passed

    def room(self, name, run):
        """Runs a room of tests in a directory of its own."""
        self.dir = tempfile.mkdtemp(prefix=name + "-", dir=self.top)
        self.guarded(name, run)

    def guarded(self, name, run):
        """Runs `run`; an exception is a failed test."""
        self.since.time = time.monotonic()
        try:
            run(self)
        except Exception as error:
            self.check(name + " stopped", False, "%s\n%s" % (re.sub(r"\x1b\[[?0-9;]*[a-zA-Z]", "", str(error))[:3000],
                                                            traceback.format_exc()[-1500:]))

    def run(self, *args, input="", env=None, timeout=120, cwd=None):
        """Runs the program. Bytes in `input` are passed as they are; output is decoded to text."""
        data = input if isinstance(input, bytes) else input.encode()
        try:
            done = subprocess.run([self.fret, *args], input=data, capture_output=True,
                                  env={**self.env, **(env or {})}, timeout=timeout, cwd=cwd or self.dir)
        except subprocess.TimeoutExpired:
            return subprocess.CompletedProcess(args, -1, "", "no end within %g s" % timeout)
        done.stdout = done.stdout.decode("utf-8", "replace")
        done.stderr = done.stderr.decode("utf-8", "replace")
        return done

    def record(self, name, ok, draws=1, seconds=None, detail=""):
        """Records a case, or further draws of one. Its seconds, if not given: since this thread recorded the last one."""
        now = time.monotonic()
        with self.lock:
            case = self.cases.setdefault(name, Case())
            case.ok = case.ok and bool(ok)
            case.draws += draws
            case.seconds += now - getattr(self.since, "time", now) if seconds is None else seconds
            if not ok:
                print("FAILED (%s) %s\n%s" % (self.label, name, detail), flush=True)
        self.since.time = now
        return ok

    def check(self, name, ok, detail=""):
        return self.record(name, ok, detail=detail)

    def same(self, name, want, got):
        return self.check(name, same_text(want, got), diff(want, got))

    def report(self, done):
        return "exit %d\n%s%s" % (done.returncode, done.stdout[-3000:], done.stderr[-3000:])

    def some(self, many, step=4):
        """All of them, or with `few` every step-th."""
        return list(many)[::step if self.few else 1]

    def each(self, jobs):
        """Runs callables in threads side by side."""
        def timed(job):
            self.since.time = time.monotonic()
            job()
        with ThreadPoolExecutor(max_workers=2 * (os.cpu_count() or 1)) as pool:
            for future in [pool.submit(timed, job) for job in jobs]:
                future.result()
        self.since.time = time.monotonic()

    def rooms(self, *runs):
        """Runs the parts of a room side by side."""
        self.each([lambda run=run: self.guarded(run.__name__, run) for run in runs])

    @contextlib.contextmanager
    def file(self, text, suffix=".fret"):
        fd, path = tempfile.mkstemp(dir=self.dir, suffix=suffix)
        with os.fdopen(fd, "wb") as out:
            out.write(text if isinstance(text, bytes) else text.encode())
        try:
            yield path
        finally:
            os.unlink(path)


def read_transcript(text):
    """[[statement, expected output]]; lines before the first prompt are comments."""
    steps = []
    for line in text.splitlines():
        if line.startswith(PROMPT):
            steps.append([line[len(PROMPT):], []])
        elif steps:
            steps[-1][1].append(line.rstrip())
    for step in steps:
        while step[1] and not step[1][-1]:
            step[1].pop()
    return steps


def draws(statement):
    """Does the statement plot in the terminal? What gnuplot draws there is not compared."""
    return re.search(r"(^|;)\s*plot\b", statement) and " to " not in statement and not statement.startswith("set")


def replay(tests, name, steps, cwd=None):
    """Runs the transcript by --replay, without plots in the terminal."""
    text = ""
    for statement, out in steps:
        if not (draws(statement) and not any("error:" in line for line in out)):
            text += PROMPT + statement + "\n" + "".join(line + "\n" for line in out)
    with tests.file(text, ".txt") as path:
        done = tests.run("--replay", path, "--tolerance", "1e-12", cwd=cwd)
    last = done.stdout.splitlines()[-1] if done.stdout else ""
    found = re.match(r".*: (\d+) passed, (\d+) failed$", last)
    told = found and (done.returncode != 0) == (int(found.group(2)) > 0) and not done.stderr
    tests.record(name + " by replay", told and done.returncode == 0, len(steps),
                 detail=done.stdout.replace(path, name) if told else tests.report(done))


def is_message(line):
    return line.startswith(("error:", "warning:", "note:"))


def batch(tests, name, steps):
    """Runs the statements as a file, by -c and through a pipe: the answers are the same, messages go to standard error."""
    script = "".join(statement + "\n" for statement, _ in steps)
    out = [line for _, lines in steps for line in lines]
    want = "\n".join(line for line in out if not is_message(line))
    errors = [line for line in out if is_message(line)]
    fails = any(line.startswith("error:") for line in errors)
    with tests.file(script) as path:
        runs = {"file": tests.run("--keep-going", path), "-c": tests.run("--keep-going", "-c", script),
                "pipe": tests.run("--keep-going", input=script)}
    for way, done in runs.items():
        messages = [line[re.search("(error|warning|note): ", line).start():] for line in done.stderr.splitlines()
                    if re.match(r"(\S+:\d+:\d+: )?(error|warning|note): ", line)]
        ok = (same_text(want, done.stdout) and messages == errors and done.returncode == (1 if fails else 0))
        tests.check("%s as %s" % (name, way), ok,
                    diff(want + "\n" + "\n".join(errors), done.stdout + "\n" + "\n".join(messages)) +
                    "\nexit %d" % done.returncode)
