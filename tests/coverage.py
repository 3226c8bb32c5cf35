# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines and branches of src/ that the rooms of tests reach, by gcov, and those that they do not: tests/hard/coverage.txt."""
import json
import os
import subprocess
import sys

import harness
import runner

B = "build/coverage"
SLOW = ("hard", "packaging", "portable", "programs", "fuzz")  # build of their own, or reach nothing more


def main():
    if not runner.make("B=" + B, "WERROR=", "OPT=-O1 -g --coverage", "LDFLAGS=--coverage", "all", "tests"):
        return 1
    for folder, _, names in os.walk(os.path.join(harness.ROOT, B)):
        for name in names:
            if name.endswith(".gcda"):
                os.unlink(os.path.join(folder, name))
    tests = harness.Tests(B, "coverage", False)
    rooms = sys.argv[1:] or [room for room in runner.ROOMS if room not in SLOW]
    for room in rooms:
        tests.room(room, runner.ROOMS[room])
    tests.close()
    return report(rooms)


def reached():
    """{file: ({line: reached}, {(line, place): taken})} of src/, over all objects that include it."""
    files = {}
    for folder, _, names in os.walk(os.path.join(harness.ROOT, B, "src")):
        data = [os.path.join(folder, name) for name in names if name.endswith(".gcda")]
        done = subprocess.run(["gcov", "-b", "--json-format", "--stdout", *data], cwd=harness.ROOT, capture_output=True,
                              text=True, check=False) if data else None
        for text in done.stdout.splitlines() if done else ():
            for one in json.loads(text)["files"]:
                if not one["file"].startswith("src/"):
                    continue
                lines, branches = files.setdefault(one["file"], ({}, {}))
                for line in one["lines"]:
                    n = line["line_number"]
                    lines[n] = lines.get(n, False) or line["count"] > 0
                    for i, branch in enumerate(line["branches"]):
                        branches[n, i] = branches.get((n, i), False) or branch["count"] > 0
    return files


def report(rooms):
    files = reached()
    text = "# make coverage (gcov, -O1; rooms: %s)\n%-34s %7s %7s %7s %8s %8s %7s\n" % (
        " ".join(rooms), "file", "lines", "reached", "%", "branches", "taken", "%")
    total = [0] * 4
    for name in [*sorted(files), "all"]:
        counts = total
        if name != "all":
            lines, branches = files[name]
            counts = [len(lines), sum(lines.values()), len(branches), sum(branches.values())]
            total = [a + b for a, b in zip(total, counts)]
        text += "%-34s %7d %7d %7.1f %8d %8d %7.1f\n" % (name, *counts[:2], 100 * counts[1] / max(1, counts[0]),
                                                        *counts[2:], 100 * counts[3] / max(1, counts[2]))
    text += "\nLines that no test reaches:\n"
    for name in sorted(files):
        missed = [str(n) for n, yes in sorted(files[name][0].items()) if not yes]
        if missed:
            text += "%s: %s\n" % (name, " ".join(missed))
    if len(rooms) > 20:
        with open(os.path.join(harness.ROOT, "tests/hard/coverage.txt"), "w", encoding="ascii") as f:
            f.write(text)
    print(text, end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
