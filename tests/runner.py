# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the program plainly and with sanitizers, and runs every room of tests with both."""
import glob
import os
import re
import shutil
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor

HERE = os.path.dirname(os.path.abspath(__file__))
sys.dont_write_bytecode = True
for room in ("", "sessions", "errors", "interactive", "portable", "house", "reference", "fuzz"):
    sys.path.insert(0, os.path.join(HERE, room))

import accuracy_test  # noqa: E402
import backwards  # noqa: E402
import casts  # noqa: E402
import completion  # noqa: E402
import explaining  # noqa: E402
import figures  # noqa: E402
import fits  # noqa: E402
import following  # noqa: E402
import fuzzing  # noqa: E402
import harness  # noqa: E402
import house  # noqa: E402
import instants  # noqa: E402
import keeping  # noqa: E402
import live  # noqa: E402
import looks  # noqa: E402
import moving  # noqa: E402
import numbers_of_the_physics  # noqa: E402
import packaging  # noqa: E402
import paper  # noqa: E402
import portable  # noqa: E402
import programs  # noqa: E402
import prompt  # noqa: E402
import reading  # noqa: E402
import reference  # noqa: E402
import rim  # noqa: E402
import rough  # noqa: E402
import scripts  # noqa: E402
import sharing  # noqa: E402
import smoothing  # noqa: E402
import table  # noqa: E402
import trouble  # noqa: E402
import typed  # noqa: E402

SANITIZE = "-O1 -g -fsanitize=address,undefined -fno-sanitize-recover=all"


def make(*args):
    jobs = "-j%d" % (os.cpu_count() or 1)
    command = ["make", "--no-print-directory", "-s", jobs, "WERROR=-Werror", *args]
    done = subprocess.run(command, cwd=harness.ROOT, capture_output=True, text=True)
    if done.returncode:
        print("FAILED %s\n%s%s" % (" ".join(command), done.stdout, done.stderr), flush=True)
    return done.returncode == 0


def counted(tests, name, *command):
    """A program that ends with `NAME: N passed, N failed`."""
    try:
        done = subprocess.run(command, cwd=harness.ROOT, capture_output=True, text=True, errors="replace", timeout=300,
                              env=tests.env)
    except (OSError, subprocess.TimeoutExpired) as error:
        tests.check(name, False, str(error))
        return
    last = (done.stdout.splitlines() or [""])[-1]
    found = re.match(r".*: (\d+) passed, (\d+) failed$", last)
    if not found or (done.returncode != 0) != (int(found.group(2)) > 0):
        tests.check(name, False, tests.report(done))
        return
    with tests.lock:
        tests.passed += int(found.group(1))
        tests.failed += int(found.group(2))
        if int(found.group(2)):
            print("FAILED (%s) %s\n%s" % (tests.label, name, done.stdout[-24000:] + done.stderr[-3000:]))


# these take longest, and begin
LONG = ("test_pieces", "test_fields", "test_allocation", "test_swing", "test_swing_field", "test_answers", "test_edges")


def unit(tests):
    names = [os.path.basename(path)[:-2] for path in
             sorted(glob.glob(os.path.join(harness.ROOT, "tests/unit/test_*.c")))]
    names.sort(key=lambda name: name not in LONG)
    tests.env["FRET_UNIT_FEW"] = "1" if tests.sanitized else ""
    tests.each([lambda n=name: counted(tests, "unit " + n, os.path.join(tests.build, "tests", n)) for name in names])


def hard(tests):
    """Scenes from the whole domain against the oracle; `make hard` runs more of them."""
    scenes, steps = (2000, 20000) if tests.sanitized else (100000, 1000000)
    program = os.path.join(tests.build, "tests/hard/hard")
    if not os.path.exists(program):  # the build, which must succeed, leaves it out without MPFR
        print("hard: not run, MPFR is not installed")
        return
    counted(tests, "hard", program, "--scenes", str(scenes), "--steps", str(steps),
            "--jobs", str(os.cpu_count() or 1))
    counted(tests, "hard, diagrams", program, "--diagrams", str(steps // 10))


def plots_of(tests, name, steps):
    """A transcript's plots: the picture must come last and bear its axis labels."""
    for i, (statement, out) in enumerate(steps):
        if not harness.draws(statement) or any("error:" in line for line in out):
            continue
        script = "\n".join(s for s, _ in steps[:i + 1] if s == statement or not harness.draws(s))
        done = tests.run("--keep-going", "-c", script)
        label = "dx [" if statement.startswith("plot loop") else \
            re.search(r"\bfor (\w+)", statement).group(1)
        tail = done.stdout.splitlines()[-20:]
        tests.check("%s: %s" % (name, statement),
                    any(label in line for line in tail) and any("+----" in line for line in tail), tests.report(done))


def sessions(tests):
    jobs = []
    for path in sorted(glob.glob(os.path.join(HERE, "sessions", "*.txt"))):
        name = os.path.relpath(path, harness.ROOT)
        with open(path, encoding="utf-8") as f:
            steps = harness.read_transcript(f.read())
        still = [s for s in steps if not harness.draws(s[0]) or s[1]]
        jobs.append(lambda n=name, s=steps: harness.replay(tests, n, s))
        jobs.append(lambda n=name, s=still: harness.batch(tests, n, s))
        jobs.append(lambda n=name, s=steps: plots_of(tests, n, s))
    tests.each(jobs)
    others = subprocess.run(["locale", "-a"], capture_output=True, text=True).stdout.split() \
        if shutil.which("locale") else []
    comma = [name for name in others if name.lower().startswith(("de_", "fr_")) and "utf" in name.lower()]
    if comma:
        with open(os.path.join(HERE, "sessions", "contract.txt"), encoding="utf-8") as f:
            steps = [s for s in harness.read_transcript(f.read()) if not harness.draws(s[0])]
        kept, tests.env = tests.env, {**tests.env, "LC_ALL": comma[0]}
        harness.batch(tests, "contract.txt in " + comma[0], steps)
        tests.env = kept


def fenced(text):
    """The fenced blocks of a Markdown text."""
    return re.findall(r"^```[a-z]*\n(.*?)^```$", text, re.S | re.M)


def readme(tests):
    with open(os.path.join(harness.ROOT, "README.md"), encoding="utf-8") as f:
        blocks = fenced(f.read())
    for i, block in enumerate(blocks):
        name = "README.md, block %d" % (i + 1)
        if block.startswith(harness.PROMPT):
            steps = harness.read_transcript(block)
            harness.replay(tests, name, steps)
            plots_of(tests, name, steps)
        elif block.startswith("$ "):
            path = os.path.dirname(tests.fret) + ":" + tests.env["PATH"]
            for part in re.split(r"^\$ ", block, flags=re.M)[1:]:
                command, _, want = part.partition("\n")
                done = subprocess.run(["sh", "-c", command], capture_output=True, text=True, cwd=tests.dir,
                                      env={**tests.env, "PATH": path}, timeout=60)
                tests.same("%s: %s" % (name, command), want, done.stdout + done.stderr)
    with open(os.path.join(harness.ROOT, "README.md"), encoding="utf-8") as f:
        listed = set(re.findall(r"`(\w+)`", f.read().partition("## Commands")[2].partition("\n## ")[0]))
    for command in command_names(tests):
        tests.check("README.md names " + command, command in listed or command == "exit", str(sorted(listed)))


def command_names(tests):
    done = tests.run("-c", "show commands")
    return sorted({line.split()[0] for line in done.stdout.splitlines() if line and not line.startswith(" ")})


# what apropos must find
APROPOS = {"loop": "cycle, plot, dW", "hysteresis": "cycle, dW", "dissipation": "dW, W", "csv": "history, table, follow",
           "export": "history, table, plot", "stress": "p(r), qx(r)", "steel": "material, material steel",
           "Hertz": "press, geometry sphere, a", "unit": "help units, Pa", "Mindlin": "explain, dW",
           "undo": "undo", "Huber": "fit", "Monte": "uncertainty", "transcript": "record, replay", "start-up": "help scripts"}
HELPED = ("sphere", "springs", "flat-rounded", "format", "pager", "GPa", "cm", "%", "steel", "Ti-6Al-4V", "sin", "memory",
          "expressions", "scripts", "files", "theory", "paper", "limits", "prompt", "set model", "geometry cone",
          "material steel", "p(r)", "dW(20 N)", "FN=100 N", "set format")


def examples(tests, topic, lines):
    """The files that a help text shows by `$ cat`, its calls of the program and its transcript; how many answers."""
    where, files, calls, session, into = os.path.join(tests.dir, "help " + topic), {}, [], [], None
    for line in lines:
        if line.startswith("$ cat "):
            into = files.setdefault(line[6:], [])
        elif line.startswith("$ fret "):
            into = [line[2:]]
            calls.append(into)
        elif line.startswith(harness.PROMPT) or into is None:
            into = session
            session.append(line)
        else:
            into.append(line)
    os.mkdir(where)
    for name, text in files.items():
        with open(os.path.join(where, name), "w", encoding="utf-8") as f:
            f.write("".join((line[4:] if text[0].startswith("    ") else line) + "\n" for line in text))
    steps = harness.read_transcript("\n".join(session))
    if steps:
        harness.replay(tests, "help " + topic, steps, cwd=where)
    path = os.path.dirname(tests.fret) + ":" + tests.env["PATH"]
    for command, *want in calls:
        done = subprocess.run(["sh", "-c", command], capture_output=True, text=True, cwd=where, env={**tests.env, "PATH": path})
        got = (done.stdout + done.stderr).splitlines()[:len(want)]
        tests.same("help %s: %s" % (topic, command), "\n".join(want), "\n".join(got))
    return len(steps) + len(calls)


def help_examples(tests):
    """Each help text of a command, a topic, a setting, a geometry or a model ends with an example; it must come out so."""
    def one(topic):
        done = tests.run("-c", "help " + topic)
        tests.check("help " + topic, done.returncode == 0 and done.stdout and not done.stderr, tests.report(done))
        wide = [line for line in done.stdout.splitlines()[1:] if len(line) > 80 and not line.startswith("    ")]
        tests.check("help %s fits a terminal" % topic, not wide, "\n".join(wide))
        lines = [line[4:] for line in done.stdout.splitlines() if line.startswith("    ")]
        count = examples(tests, topic, lines)
        tests.check("help %s has an example" % topic, count > 0 or topic not in shown, done.stdout)

    def words(statement, pattern):
        return re.findall(pattern, tests.run("-c", statement).stdout, re.M)
    topics = " ".join(words("help", r"^Topics: (.*)\n +(.*)$")[0]).replace(",", "").split()
    settings, geometries = words("show settings", r"^set (\w+)"), words("help geometry", r"^    geometry ([\w-]+)")
    tests.check("what has an example", len(topics) >= 9 and len(settings) >= 8 and len(geometries) >= 10,
                "%s\n%s\n%s" % (topics, settings, geometries))
    shown = {*command_names(tests), *topics, *settings, *geometries, "closed", "memory", "springs", "quadrature", "double",
             "polynomials", "vectors"}
    text = tests.run("-c", "help quantities").stdout
    quantities = re.findall(r"^    (\w+)(?:\(\w+\))?  ", text, re.M)
    tests.each([lambda t=t: one(t) for t in sorted(shown | set(quantities))])
    tests.check("help lists the quantities", len(quantities) > 30, text)
    inputs, _, rest = text.partition("Results:\n")
    results, _, functions = rest.partition("Functions of the scene:\n")
    tests.check("functions alone have an argument", "(null)" not in text and not re.findall(r"^    \w+\(", inputs + results, re.M) and
                not re.findall(r"^    \w+ ", functions.partition("\n\n")[0], re.M), text)
    presets = words("help material", r"^    (\S+) +E0=\S+ GPa nu=")
    tests.check("help material lists them", {"steel", "Ti-6Al-4V", "Inconel", "bronze", "tungsten-carbide", "silicon-nitride",
                                             "PTFE"} <= set(presets), str(presets))
    for name in presets:
        done = tests.run("-c", "help %s; second %s; material %s" % (name, name, name))
        tests.check("help %s names its source" % name, done.returncode == 0 and re.search(
            r"\n  (EN |Callister|makers|incompressible)", done.stdout), tests.report(done))
    for word, found in APROPOS.items():
        done = tests.run("-c", "apropos " + word)
        tests.check("apropos " + word, all(re.search("^%s( |$)" % re.escape(name), done.stdout, re.M)
                                           for name in found.split(", ")), tests.report(done))
    for word, told in (("deg", "deg: an angle; 1 deg = 0.01745329252 rad\n"), ("rad", "rad: an angle; 1 rad = 1 rad\n"),
                       ("N/mm", "no help on 'N/mm'; try: help\n"), ("%", "%: a number; 1 % = 0.01\n")):
        done = tests.run("-c", "help " + word)
        tests.check("help on " + word, done.stdout == told or told in done.stderr, tests.report(done))
    for name in HELPED:
        done = tests.run("-c", "help " + name)
        tests.check("help on " + name, len(done.stdout) > 10 and not done.stderr, tests.report(done))
    done = tests.run("-c", "help")
    tests.check("help fits a screen", len(done.stdout.splitlines()) <= 24, done.stdout)


ROOMS = {"unit": unit, "hard": hard, "sessions": sessions, "numbers": numbers_of_the_physics.run,
         "reference": reference.run, "scripts": scripts.run, "reading": reading.run, "smoothing": smoothing.run, "explaining": explaining.run,
         "instants": instants.run,
         "keeping": keeping.run,
         "figures": figures.run, "looks": looks.run, "paper": paper.run, "accuracy": accuracy_test.run,
         "fits": fits.run, "following": following.run, "sharing": sharing.run, "backwards": backwards.run, "errors": table.run,
         "trouble": trouble.run, "rim": rim.run, "programs": programs.run, "typed": typed.run, "fuzz": fuzzing.run,
         "interactive": prompt.run, "rough": rough.run, "live": live.run, "moving": moving.run, "casts": casts.run, "completion": completion.run, "readme": readme, "help": help_examples,
         "portable": portable.run, "packaging": packaging.run,
         "house": house.run}


# two rooms run side by side, since many leave a core idle: those that do so longest begin
SLOW = ("rim", "numbers", "sharing", "unit")
# these wait for a terminal most of their time: two of them run beside those that build
WAITING = ("moving", "completion", "rough", "typed", "live", "interactive", "casts")
BUILDING = ("fuzz", "portable")


def run_room(build, label, name):
    """(passed, failed)"""
    tests = harness.Tests(build, label, label == "sanitized")
    try:
        tests.room(name, ROOMS[name])
        left = os.listdir(tests.tmp)
        tests.check("no temporary files are left", not left, " ".join(left))
    finally:
        tests.close()
    return tests.passed, tests.failed


def run_builds(built, name):
    """One after the other: what a room has worked out for one, it knows for the next."""
    return [run_room(*one, name) for one in built]


def main():
    wanted = sys.argv[1:] or list(ROOMS)
    for name in wanted:
        if name not in ROOMS:
            sys.exit("tests/run: no room '%s': %s" % (name, " ".join(ROOMS)))
    passed = failed = 0
    sanitized = ["B=build/asan", "OPT=" + SANITIZE]
    if harness.links("clang", SANITIZE):  # sees more than gcc's
        sanitized.append("CC=clang")
    variants = [("build", "plain", []), ("build/asan", "sanitized", sanitized)]
    if "CC=clang" not in sanitized and shutil.which("clang"):  # else that is how it is seen to build with clang
        if make("B=build/clang", "CC=clang", "all", "tests"):
            passed += 1
        else:
            failed += 1
    built = []
    for build, label, args in variants:
        if make(*args, *(("all",) if label == "plain" else ("build/asan/fret",)), "tests"):
            passed += 1
            built.append((build, label))
        else:
            failed += 1
    wanted.sort(key=lambda name: SLOW.index(name) if name in SLOW else len(SLOW))
    with ProcessPoolExecutor(2) as pool:  # threads would wait for each other's turn at Python
        working = [pool.submit(run_builds, built, name) for name in wanted if name not in WAITING + BUILDING]
        counts = [count for room in working for count in room.result()]
        waiting = [pool.submit(run_room, *one, name) for name in WAITING if name in wanted for one in built]
        counts += [run_room(*one, name) for one in built for name in BUILDING if name in wanted]
        counts += [one.result() for one in waiting]
    passed += sum(count[0] for count in counts)
    failed += sum(count[1] for count in counts)
    print("%d passed, %d failed" % (passed, failed))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
