# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes tests/hard/coverage.txt: which lines and branches of src/ the rooms of tests and the faults reach, by gcov, and which
they do not. `--short`: only the rooms that `make check` runs. A comment `unreached: REASON` leaves out its line and the lines
indented under it; alone on a line, the next line."""
import collections
import contextlib
import copy
import json
import math
import os
import re
import struct
import subprocess
import sys

import harness
import runner
import units

import faults
import latency

B = "build/coverage"
# left out: rooms with builds of their own, or that reach nothing more
SLOW = ("hard", "packaging", "portable", "programs", "fuzz", "house", "python", "oscillator")
MARK = re.compile(r"/\* unreached: ")
MARKED_LINE = re.compile(r"\s*/\* unreached: .*\*/$")


def every_fault(tests):
    """Makes every allocation and system call fail once, and interrupts each, as `make faults` does."""
    folder = os.path.join(os.path.abspath(tests.build), "tests")
    env = {"PATH": os.environ["PATH"], "LC_ALL": "C", "TERM": "dumb"}
    kinds = (faults.allocations, faults.interrupts, *((faults.calls,) if faults.can_filter(folder) else ()))

    def one(statement, kind):
        ends, wrong = faults.attempt(statement, kind)
        tests.check("%s, %s" % (statement.statement[:60], kind.__name__), not wrong,
                    "\n".join("%s: %s" % (faults.told(fault), what) for fault, what in wrong[:3]))
    tests.each([lambda s=s, k=k: one(s, k) for s in faults.statements(tests.fret, folder, env) for k in kinds])


def some_hard(tests):
    """Runs a few random scenes and histories for what they reach; their results are checked elsewhere."""
    program = os.path.join(tests.build, "tests/hard/hard")
    if os.path.exists(program):
        units.counted(tests, "hard", program, "--scenes", "2000", "--steps", "20000", "--jobs", "2")
        units.counted(tests, "hard, diagrams", program, "--diagrams", "20000")


def leaves(terminal):
    """Ends a terminal of latency.py, which would kill the program, by an exit, which writes the counts."""
    terminal.send("exit")
    with contextlib.suppress(OSError):
        while os.read(terminal.fd, 1 << 16):
            pass
    os.waitpid(terminal.pid, 0)
    os.close(terminal.fd)


def interrupts(tests):
    """Interrupts slow statements after several times; the scene must stay as it was."""
    latency.Terminal.close = leaves
    env = {**tests.env, "XDG_STATE_HOME": tests.dir, "INPUTRC": "/dev/null"}

    def one(case):
        took, kept = latency.measure(tests.fret, env, case, (0.02, 0.06, 0.2, 0.5, 1, 2))
        tests.check("interrupted: " + case[0], kept and all(once[0] < math.inf for once in took), str(took))
    os.chdir(tests.dir)
    tests.each([lambda c=case: one(c) for case in latency.cases(tests.dir, 10)])
    os.chdir(harness.ROOT)


ROOMS = {**{name: run for name, run in runner.ROOMS.items() if name not in SLOW}, "some-hard": some_hard, "interrupts": interrupts, "faults": every_fault}


def build():
    """Builds for gcov, with code that writes the counts also at ends that run no exit handler."""
    flush, program = B + "/tests/coverage.o", os.path.join(harness.ROOT, B, "fret")
    if os.path.exists(program):  # it may have been linked in another way
        os.unlink(program)
    wrapped = "LDFLAGS=--coverage -Wl,--wrap=_exit,--wrap=raise,--wrap=kill,--wrap=fork,--wrap=__gcov_exit " + flush
    apart = "OPT=-O1 -g -fno-inline --coverage '-DFRET_INLINE=static inline'"  # each function counted once
    return runner.make("B=" + B, "WERROR=", "OPT=-O1 -g -fPIC", flush) and \
        runner.make("B=" + B, "WERROR=", apart, wrapped, "all", "tests")


def counts():
    """{file with counts: its bytes}"""
    found = {}
    for folder, _, names in os.walk(os.path.join(harness.ROOT, B)):
        for path in (os.path.join(folder, name) for name in names if name.endswith(".gcda")):
            with open(path, "rb") as f:
                found[path] = f.read()
    return found


def put_back(kept):
    for path in counts():
        os.unlink(path)
    for path, data in kept.items():
        with open(path, "wb") as f:
            f.write(data)


def whole(data):
    """Is the file with counts complete: do its records fill it up to the end mark?"""
    at = 16
    while data[:4] in (b"adcg", b"gcda") and at + 8 <= len(data):
        tag, length = struct.unpack("=Ii", data[at:at + 8])
        at += 8 + max(length, 0)  # negative: all counts are 0, and not written
        if not tag:
            break
    return data[at:] == bytes(4)


def run_room(tests, room):
    """Runs a room. If a process was killed while it wrote its counts, which spoils the file, the room is run again."""
    kept, before = counts(), copy.deepcopy(tests.cases)
    for _ in range(5):
        tests.room(room, ROOMS.get(room) or runner.ROOMS[room])
        if all(whole(data) for data in counts().values()):
            return
        print("%s: counts broke off" % room, flush=True)
        put_back(kept)
        tests.cases = before


def main():
    if not build():
        return 1
    put_back({})
    short, rooms = sys.argv[1:] == ["--short"], [room for room in sys.argv[1:] if room != "--short"]
    rooms = rooms or [name for name in (runner.ROOMS if short else ROOMS) if not short or name not in runner.OTHER + runner.PLAIN]
    tests = harness.Tests(B, "coverage", False, short)
    for room in rooms:
        run_room(tests, room)
    tests.close()
    return report(rooms)


def marked(text):
    """The numbers of the lines that `unreached` comments leave out."""
    found, under = set(), None  # under: the indentation of the line with the comment
    for n, line in enumerate(text.splitlines(), 1):
        depth = len(line) - len(line.lstrip())
        if under is not None and line.strip() and depth <= under[0] and n != under[1]:
            under = None
        if MARK.search(line):
            under = (depth, n + 1 if MARKED_LINE.match(line) else n)
        if under is not None:
            found.add(n)
    return found


def reached():
    """{file: ({line: reached}, {line: [branch taken]})} of src/, over all objects that include it. Branches of a line that is
    compiled several times, inlined or for several processors, are counted once: for the smallest copy; an object that
    has a multiple of its branches has several copies in one place."""
    files = {}
    for folder, _, names in os.walk(os.path.join(harness.ROOT, B)):  # objects of tests count too: they inline headers
        data = [os.path.join(folder, name) for name in names if name.endswith(".gcda")]
        if "/shared/" in folder:  # the same sources again
            continue
        done = subprocess.run(["gcov", "-b", "--json-format", "--stdout", *data], cwd=harness.ROOT, capture_output=True,
                              text=True, check=False) if data else None
        for text in done.stdout.splitlines() if done else ():
            for one in json.loads(text)["files"]:
                if not one["file"].startswith("src/"):
                    continue
                lines, ways = files.setdefault(one["file"], ({}, collections.defaultdict(dict)))
                for line in one["lines"]:
                    n, taken = line["line_number"], [branch["count"] > 0 for branch in line["branches"]]
                    lines[n] = lines.get(n, False) or line["count"] > 0
                    before = ways[n].get(len(taken), [False] * len(taken))
                    ways[n][len(taken)] = [a or b for a, b in zip(before, taken)]
    return {name: (lines, {n: once(name, way) for n, way in ways.items()}) for name, (lines, ways) in files.items()}


def once(name, ways):
    """The branches of a line, merged from its copies, {number of branches: [taken]}."""
    least = min((n for n in ways if n), default=0)
    if not name.endswith(".h") or not least:
        return ways[max(ways)]
    return [any(any(way[i::least]) for n, way in ways.items() if n % least == 0) for i in range(least)]


def numbers(name, what):
    return "%s: %s\n" % (name, " ".join(map(str, what))) if what else ""


def report(rooms):
    row = "%-34s %7s %7s %7s %8s %8s %7s %7s\n"
    text = "# make coverage (gcov, -O1 -fno-inline; rooms: %s)\n" % " ".join(rooms)
    text += row % ("file", "lines", "reached", "%", "branches", "taken", "%", "marked")
    total = [0] * 5
    missed, partly, wrongly = "", "", ""

    def told(name, counts):
        return row % (name, *counts[:2], "%.1f" % (100 * counts[1] / max(1, counts[0])), *counts[2:4],
                      "%.1f" % (100 * counts[3] / max(1, counts[2])), counts[4])
    files = reached()
    for name in sorted(files):
        lines, branches = files[name]
        with open(os.path.join(harness.ROOT, name), encoding="utf-8") as f:
            out = marked(f.read())
        left = {n: yes for n, yes in lines.items() if n not in out}
        flags = [yes for n, way in branches.items() if n not in out for yes in way]
        counts = [len(left), sum(left.values()), len(flags), sum(flags), len(lines) - len(left)]
        total = [a + b for a, b in zip(total, counts)]
        text += told(name, counts)
        missed += numbers(name, sorted(n for n, yes in left.items() if not yes))
        partly += numbers(name, ["%d%s" % (n, "" if way.count(False) == 1 else "(%d)" % way.count(False))
                                 for n, way in sorted(branches.items()) if n not in out and lines[n] and not all(way)])
        wrongly += numbers(name, sorted(n for n in lines if n in out and lines[n] and all(branches[n])))
    text += told("all", total)
    text += "\nLines that no test reaches:\n" + missed
    text += "\nLines with branches that no test takes, and how many where there are more than one:\n" + partly
    text += "\nMarked, and reached with all its branches:\n" + wrongly if wrongly else ""
    if not sys.argv[1:]:
        with open(os.path.join(harness.ROOT, "tests/hard/coverage.txt"), "w", encoding="ascii") as f:
            f.write(text)
    print(text, end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
