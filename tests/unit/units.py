# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the test programs in C, of tests/unit and tests/hard. Each prints a line per case and `NAME: N passed, N failed`."""
import glob
import os
import re
import subprocess

import harness

CASE = re.compile(r"  (.+): (ok|FAILED), (\d+) checked(?:, ([\d.]+) s)?$")


def counted(tests, name, *command):
    try:
        done = subprocess.run(command, cwd=harness.ROOT, capture_output=True, text=True, errors="replace", timeout=300,
                              env=tests.env, check=False)
    except (OSError, subprocess.TimeoutExpired) as error:
        tests.check(name, False, str(error))
        return
    lines = done.stdout.splitlines()
    last = re.match(r".*: (\d+) passed, (\d+) failed$", lines[-1] if lines else "")
    cases = [found.groups() for found in map(CASE.match, lines) if found]
    if not last or (done.returncode != 0) != (int(last.group(2)) > 0) or len(cases) != int(last.group(1)) + int(last.group(2)):
        tests.check(name, False, tests.report(done))
        return
    if done.returncode:
        print("%s\n%s" % (done.stdout[-24000:], done.stderr[-3000:]))
    for case, ok, draws, seconds in cases:
        tests.record("%s, %s" % (name, case), ok == "ok", int(draws), float(seconds or 0))


# these take longest and so come first
LONG = ("test_work", "test_wear", "test_fields", "test_allocation", "test_swing", "test_swing_field", "test_answers")


def run(tests):
    names = [os.path.basename(path)[:-2] for path in
             sorted(glob.glob(os.path.join(harness.ROOT, "tests/unit/test_*.c")))]
    names.sort(key=lambda name: name not in LONG)
    tests.each([lambda n=name: counted(tests, n, os.path.join(tests.build, "tests", n)) for name in names])


def hard(tests):
    """Random scenes of the whole domain against the MPFR oracle; `make hard` runs many more."""
    scenes, steps = (2000, 20000) if tests.few else (100000, 1000000)
    program = os.path.join(tests.build, "tests/hard/hard")
    if not os.path.exists(program):  # without MPFR it is not built
        print("hard: not run, MPFR is not installed")
        return
    counted(tests, "hard", program, "--scenes", str(scenes), "--steps", str(steps),
            "--jobs", str(os.cpu_count() or 1))
    counted(tests, "hard, diagrams", program, "--diagrams", str(steps // 10))
