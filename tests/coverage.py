# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines and branches of src/ that the rooms of tests reach, by gcov: tests/hard/coverage.txt. A line or a branch that no
test can reach is marked in the source, GCOVR_EXCL_LINE or GCOVR_EXCL_BR_LINE, with the reason."""
import json
import os
import shutil
import subprocess
import sys
import time

import harness
import runner

B = "build/coverage"
SLOW = ("hard", "packaging", "portable", "programs", "fuzz")  # build of their own, or reach nothing more


def main():
    if not shutil.which("gcovr"):
        print("coverage needs gcovr (Debian: apt-get install gcovr)")
        return 1
    if not runner.make("B=" + B, "OPT=-O0 -g --coverage", "LDFLAGS=--coverage", "all", "tests"):
        return 1
    for folder, _, names in os.walk(os.path.join(harness.ROOT, B)):
        for name in names:
            if name.endswith(".gcda"):
                os.unlink(os.path.join(folder, name))
    tests = harness.Tests(B, "coverage", False)
    rooms = sys.argv[1:] or [room for room in runner.ROOMS if room not in SLOW]
    for room in rooms:
        start = time.time()
        try:
            runner.ROOMS[room](tests)
        except Exception as error:  # what has been reached counts
            print(room, error)
        print("%-12s %6.1f s" % (room, time.time() - start), flush=True)
    tests.close()
    done = subprocess.run(["gcovr", "--root", ".", "--object-directory", B, "--filter", "src/", "--exclude", ".*none.c",
                           "--json-summary", "--json-summary-pretty", "--exclude-unreachable-branches", "-j", "2", B],
                          cwd=harness.ROOT, capture_output=True, text=True, check=False)
    if done.returncode:
        print(done.stderr)
        return 1
    found = json.loads(done.stdout)
    text = "# make coverage (gcov, -O0; rooms: %s)\n%-34s %7s %7s %7s %8s %8s %7s\n" % (
        " ".join(rooms), "file", "lines", "reached", "%", "branches", "reached", "%")
    for row in [*found["files"], {**found, "filename": "all"}]:
        line, branch = [(row[what + "_total"], row[what + "_covered"]) for what in ("line", "branch")]
        text += "%-34s %7d %7d %7.1f %8d %8d %7.1f\n" % (row["filename"], *line, 100 * line[1] / max(1, line[0]), *branch,
                                                      100 * branch[1] / max(1, branch[0]))
    if not sys.argv[1:]:
        with open(os.path.join(harness.ROOT, "tests/hard/coverage.txt"), "w", encoding="ascii") as f:
            f.write(text)
    print(text, end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
