# SPDX-License-Identifier: GPL-3.0-or-later
"""Every build gives the same answers: compilers, optimization levels, instruction sets and C libraries. Printed text is equal; with
all digits, numbers may differ by some units in the last place, since libm differs."""
import collections
import glob
import os
import re
import shutil
import struct
import subprocess
import tempfile

import harness
import prompt
import scenes
import transcripts

HERE = os.path.dirname(os.path.abspath(__file__))
NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


def has_fma():
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as f:
            return {"fma", "avx2", "bmi2"} <= set(f.read().split())
    except OSError:
        return False


def variants():
    """{name: arguments of make} of the builds that this machine can make and run."""
    found = {}
    if shutil.which("gcc") and has_fma():
        found["gcc-O3-fma"] = ["CC=gcc", "OPT=-O3 -march=x86-64-v3"]
    if shutil.which("clang"):
        found["clang-O3"] = ["CC=clang", "OPT=-O3"]
    if shutil.which("musl-gcc"):
        found["musl"] = ["CC=musl-gcc", "LDFLAGS=-static", "LIVE=no"]
    return found


def build(name, args):
    where = "build/portable/" + name
    done = subprocess.run(["make", "--no-print-directory", "-s", "-j%d" % (os.cpu_count() or 1), "B=" + where,
                           "READLINE=no", "GSL=no", *args, where + "/fret"],
                          cwd=harness.ROOT, capture_output=True, text=True)
    return where, done


def backwards(statement):
    """Does the statement need GSL? It is not built with musl, and its version differs between machines."""
    return re.search(r"\b(solve|maximize|minimize|fit|uncertainty)\b", statement)


# Wear advances in blocks of cycles, as long as a tolerance of 1e-3 allows: the last bits of libm may decide whether a block is
# accepted or halved.
TOLERANT = {("musl", "wearing.txt"): 1e-4}


def sessions():
    """{name: (format, script, files, session)}: the statements of each session, as text and with all digits, and the files that it
    reads; and the hard scenes (scenes.py)."""
    found = {}
    for path in sorted(glob.glob(os.path.join(harness.ROOT, "tests/sessions/*.txt"))):
        with open(path, encoding="utf-8") as f:
            files, _, session = transcripts.parts(f.read().splitlines())
        steps = [s for s, _ in harness.read_transcript("\n".join(session)) if not harness.draws(s) and not backwards(s)]
        if not steps:  # a session with calls of the library only
            continue
        name, script = os.path.basename(path), "\n".join(steps) + "\n"
        for form, to in (("text", script), ("json", re.sub(r"\bset (format|digits) \w+", "set format json", script))):
            found[name + (", all digits" if form == "json" else "")] = (form, to, files, name)
    found["scenes"] = ("json", scenes.script(), {"gap.csv": scenes.gap_table(), "history.csv": scenes.history_table()}, "scenes")
    return found


def ordinal(x):
    """The rank of a double among all doubles: differences are units in the last place."""
    bits = struct.unpack("<q", struct.pack("<d", float(x)))[0]
    return bits if bits >= 0 else -(bits & 0x7fffffffffffffff)


def describe(want, got):
    """Says how many numbers differ, of which quantities, and by how much at most."""
    lines, worst, total = [], collections.Counter(), 0
    want, got = want.splitlines(), got.splitlines()
    if len(want) != len(got):
        return "%d lines, expected %d\n%s" % (len(got), len(want), harness.diff("\n".join(want), "\n".join(got)))
    for number, (w, g) in enumerate(zip(want, got), 1):
        if w == g:
            continue
        if NUMBER.sub("#", w) != NUMBER.sub("#", g):
            lines.append("%d: %s\n   %s" % (number, w[:200], g[:200]))
            continue
        named = re.match(r'\{"name":"(.*?)","value"', w)
        fields = [named.group(1)] if named else re.findall(r'"([^"]+)":', w)
        pairs = list(zip(NUMBER.findall(w), NUMBER.findall(g)))
        for i, (a, b) in enumerate(pairs):
            if a != b:
                total += 1
                name = named.group(1) if named else fields[i] if len(fields) == len(pairs) else "column %d" % (i + 1)
                worst[name] = max(worst[name], abs(ordinal(a) - ordinal(b)))
        lines.append("%d: %s\n   %s" % (number, w[:200], g[:200]))
    names = ", ".join("%s %.3g" % item for item in worst.most_common(40))
    return "%d numbers differ; the worst of each, in ulps (huge: noise around 0): %s\n%s" % (
        total, names, "\n".join(lines[:6]))


def alike(form, want, got, tolerance):
    """Do the numbers agree? Differences such as Fx relative to the larger numbers they come from; local fields near an edge to what
    `help exactness` promises."""
    if want == got or (form == "text" and not tolerance) or NUMBER.sub("#", want) != NUMBER.sub("#", got):
        return want == got
    for w, g in zip(want.splitlines(), got.splitlines()):
        pairs = [(float(a), float(b)) for a, b in zip(NUMBER.findall(w), NUMBER.findall(g))]
        own = tolerance or (2e-13 if re.match(r'\{"name":"(p|qx|uz|ux)\(', w) else 1e-15)
        noise = 1e-18 * max((abs(a) for a, _ in pairs), default=0)
        if any(abs(a - b) > max(own * abs(a), noise) for a, b in pairs):
            return False
    return True


def answers(tests, form, script, files, env):
    """Runs a script in a directory of its own, with the files that it reads; so the files that it writes are always new."""
    with tempfile.TemporaryDirectory(dir=tests.dir) as cwd:
        transcripts.write(cwd, files)
        done = tests.run("--format=" + form, "--keep-going", input=script, env=env, timeout=300, cwd=cwd)
    return done.stdout, done.returncode


def plain_prompt(tests):
    """Tests the prompt of a build with READLINE=no."""
    s = prompt.Session(tests)
    tests.check("plain prompt: an answer", s.say("1 + 1") == "1 + 1 = 2")
    s.child.sendline("1 + \\")
    s.child.expect(r"\.\.\.\.> ")
    tests.check("plain prompt: a continued line", s.say("2").splitlines()[-1].endswith("= 3"))
    s.child.send("1 + 1")
    s.child.expect_exact("1 + 1")
    s.child.sendintr()
    s.prompt()
    tests.check("plain prompt: Ctrl-C drops the line", s.say("2") == "2 = 2")
    s.child.sendeof()
    tests.check("plain prompt: Ctrl-D leaves", s.end() == 0)


def without_library(tests):
    """With GSL=no, statements that need GSL say so."""
    transcripts.write(tests.dir, {"gap.csv": scenes.gap_table()})
    for statement, name in (("maximize x*(1-x) over x = 0 .. 1", "maximize"), ("geometry file gap.csv smooth", "smooth")):
        done = tests.run("-c", statement, cwd=tests.dir)
        tests.check(name + " without GSL", "error: %s needs GSL, which this program was built without" % name in done.stderr and
                    done.returncode == 1, tests.report(done))
    done = tests.run("-c", "solve x for x^2 = 4 from 1 to 3")
    tests.check("solve does without GSL", done.stdout == "x = 2\n", tests.report(done))


def without_screen(tests):
    """With LIVE=no, `live` says so."""
    done = tests.run("-c", "live\n1 + 1")
    tests.check("without the full-screen mode", done.returncode == 1 and not done.stdout and
                "built without the full-screen mode (LIVE=no)" in done.stderr, tests.report(done))


def threads(tests):
    """Threads share only data that they read: the thread test, with ThreadSanitizer on all of the library."""
    program = os.path.join(harness.ROOT, "build/portable/threads")
    os.makedirs(os.path.dirname(program), exist_ok=True)
    sources = [path for name in ("number", "law", "history", "field", "arrays")
               for path in sorted(glob.glob(os.path.join(harness.ROOT, "src", name, "*.c")))]
    done = subprocess.run(["gcc", "-std=c11", "-D_POSIX_C_SOURCE=200809L", "-D_DEFAULT_SOURCE", "-O1", "-g", "-fsanitize=thread",
                           "-ffp-contract=off", "-Iinclude", "-Isrc", "-o", program, "tests/unit/test_threads.c", *sources, "-lm", "-pthread"],
                          cwd=harness.ROOT, capture_output=True, text=True)
    if tests.check("build for threads", done.returncode == 0, done.stderr):
        done = subprocess.run([program], capture_output=True, text=True, timeout=300)
        tests.check("threads share laws and fields", done.returncode == 0 and " 0 failed" in done.stdout, done.stdout + done.stderr)


def run(tests):
    if shutil.which("gcc"):
        threads(tests)
    builds = {}
    for name, args in variants().items():
        where, done = build(name, args)
        if tests.check("build " + name, done.returncode == 0, done.stdout + done.stderr):
            builds[name] = harness.Tests(where, name, False)
    tests.check("variants to compare", builds, "gcc, clang and musl-gcc are all missing")
    programs = {"this build": (tests, {}), **{name: (b, {}) for name, b in builds.items()},
                # libm chooses its functions by the processor
                "this build, no FMA": (tests, {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2"})}
    try:
        said, scripts = {}, sessions()

        def ask(variant, script):
            program, env = programs[variant]
            said[variant, script] = answers(program, *scripts[script][:3], env)
        # how numbers are printed is up to the C library
        asked = {s: [v for v in programs if scripts[s][0] == "json" or v in ("this build", "musl")] for s in scripts}
        tests.each([lambda v=v, s=s: ask(v, s) for s in reversed(scripts) for v in asked[s]])
        numbers = 0
        for script in scripts:
            want, status = said["this build", script]
            count = len(NUMBER.findall(want))
            numbers += count
            tests.check(script + " answers", count > 0, want)
            for variant in asked[script][1:]:
                got, code = said[variant, script]
                tolerance = TOLERANT.get((variant, scripts[script][3]))
                tests.check("%s: %s as by this build" % (variant, script), code == status and alike(scripts[script][0], want, got, tolerance),
                            "exit %d, expected %d\n%s" % (code, status, describe(want, got)))
        print("portable: %d numbers by %s" % (numbers, "; ".join(programs)), flush=True)
        if "musl" in builds:
            without_screen(builds["musl"])
        for variant in builds.values():
            plain_prompt(variant)
            without_library(variant)
            for name, case in variant.cases.items():
                tests.record("%s: %s" % (variant.label, name), case.ok, case.draws, case.seconds)
    finally:
        for variant in builds.values():
            variant.close()
