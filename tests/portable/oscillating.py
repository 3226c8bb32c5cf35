# SPDX-License-Identifier: GPL-3.0-or-later
"""The example of scripts/oscillator.c and its Python twin: an oscillator on a contact by harmonic balance, with an exported
table, and by time integration; the two must agree."""
import os
import re
import subprocess
import sys

import harness
import python_module


def rows(text):
    return [[float(word) for word in line.split(",")] for line in text.splitlines()[1:]]


def run(tests):
    source = os.path.join(harness.ROOT, "scripts/oscillator.c")
    with open(source, encoding="utf-8") as f:
        told = f.read()
    scene = re.search(r"fret -c '(.*?)'", told, re.S).group(1).replace("\n *", "\n")
    done = tests.run("-c", scene)
    tests.check("the table that it tells to make", done.returncode == 0 and harness.reported(done.stderr, ["harmonic.csv"]), tests.report(done))
    flags = re.search(r"cc (-std=c11.*?) -Iinclude", told).group(1)
    made = subprocess.run(["cc", *flags.split(), "-Wall", "-Wextra", "-Werror", "-I" + os.path.join(harness.ROOT, "include"), source,
                           os.path.join(harness.ROOT, tests.build, "libfret.a"), "-lm", "-o", "oscillator"],
                          cwd=tests.dir, capture_output=True, text=True, check=False)
    tests.check("it compiles", made.returncode == 0, made.stderr)
    by_c = subprocess.run(["./oscillator", "harmonic.csv"], cwd=tests.dir, capture_output=True, text=True, check=False)
    response = rows(by_c.stdout)
    off = [abs(row[3]) for row in response]
    # within 1 % below the resonance, where the contact begins to slide; within 0.3 % above it
    tests.check("by time and by one harmonic", len(response) == 28 and max(off) < 0.011 and max(off[1::2]) < 0.003, by_c.stdout + by_c.stderr)
    tests.check("what slips less bends less", off[1::2] == sorted(off[1::2]) and off[1] < 0.0002, by_c.stdout)
    lost = subprocess.run(["./oscillator", "none.csv"], cwd=tests.dir, capture_output=True, text=True, check=False)
    tests.check("no table", lost.returncode == 1 and "a table of export harmonic" in lost.stderr, lost.stderr)
    python = python_module.python_of(tests)
    if not python:
        return
    by_python = python(os.path.join(python_module.MODULE, "examples/oscillator.py"), "harmonic.csv")
    same = rows(by_python.stdout)
    tests.check("the same in Python", len(same) == len(response) and all(abs(a / b - 1) < 1e-7 for mine, its in zip(same, response) for a, b in zip(mine[:3], its)),
                by_python.stdout + by_python.stderr)
