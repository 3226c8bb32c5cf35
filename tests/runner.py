# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the program and runs rooms of tests. `make check` runs each room once, with the normal build and few random draws;
`make check-all` goes on with sanitizers, with many draws, and with other compilers and libraries."""
import argparse
import collections
import os
import resource
import shutil
import subprocess
import sys
import time
from concurrent.futures import ProcessPoolExecutor

HERE = os.path.dirname(os.path.abspath(__file__))
sys.dont_write_bytecode = True
for folder in ("", "unit", "sessions", "errors", "interactive", "portable", "house", "reference", "fuzz"):
    sys.path.insert(0, os.path.join(HERE, folder))

import accuracy_test  # noqa: E402
import answers  # noqa: E402
import backwards  # noqa: E402
import completion  # noqa: E402
import explaining  # noqa: E402
import figures  # noqa: E402
import fits  # noqa: E402
import following  # noqa: E402
import forms  # noqa: E402
import fuzzing  # noqa: E402
import harness  # noqa: E402
import helping  # noqa: E402
import house  # noqa: E402
import instants  # noqa: E402
import keeping  # noqa: E402
import live  # noqa: E402
import looks  # noqa: E402
import moving  # noqa: E402
import numbers_of_the_physics  # noqa: E402
import oscillating  # noqa: E402
import packaging  # noqa: E402
import paper  # noqa: E402
import portable  # noqa: E402
import programs  # noqa: E402
import prompt  # noqa: E402
import python_module  # noqa: E402
import reading  # noqa: E402
import reference  # noqa: E402
import rim  # noqa: E402
import rough  # noqa: E402
import scripts  # noqa: E402
import shares  # noqa: E402
import sharing  # noqa: E402
import smoothing  # noqa: E402
import table  # noqa: E402
import transcripts  # noqa: E402
import trouble  # noqa: E402
import typed  # noqa: E402
import units  # noqa: E402

# the rooms that take longest come first
ROOMS = {"rim": rim.run, "unit": units.run, "numbers": numbers_of_the_physics.run, "sharing": sharing.run, "shares": shares.run, "hard": units.hard,
         "accuracy": accuracy_test.run, "explaining": explaining.run, "errors": table.run, "programs": programs.run,
         "scripts": scripts.run, "trouble": trouble.run, "fits": fits.run, "instants": instants.run, "keeping": keeping.run,
         "backwards": backwards.run, "looks": looks.run, "paper": paper.run, "packaging": packaging.run, "house": house.run,
         "figures": figures.run, "sessions": transcripts.run, "help": helping.run, "reference": reference.run, "reading": reading.run,
         "smoothing": smoothing.run, "answers": answers.run, "following": following.run, "forms": forms.run, "readme": transcripts.readme, "fuzz": fuzzing.run,
         "portable": portable.run, "python": python_module.run, "oscillator": oscillating.run, "moving": moving.run, "completion": completion.run, "rough": rough.run, "typed": typed.run,
         "live": live.run, "interactive": prompt.run}
DRAWING = ("unit", "hard", "numbers", "errors", "fits", "instants", "accuracy", "programs", "typed", "rim", "sharing", "explaining", "completion", "moving")  # check-all
PLAIN = ("house", "packaging")  # not sanitized: they look at the sources, or at what is installed
OTHER = ("fuzz", "portable", "python", "oscillator")  # only in check-all: they build other programs
WAITING = ("moving", "completion", "rough", "typed", "live", "interactive")  # they mostly wait for a terminal

Result = collections.namedtuple("Result", "label room cases seconds processor")


def make(*args):
    """Warnings are errors only if CI is set: those of an unknown compiler must not stop `make check`."""
    command = ["make", "--no-print-directory", "-s", "-j%d" % (os.cpu_count() or 1),
               *(["WERROR=-Werror"] if os.environ.get("CI") else []), *args]
    done = subprocess.run(command, cwd=harness.ROOT, capture_output=True, text=True, check=False)
    if done.returncode:
        print("FAILED %s\n%s%s" % (" ".join(command), done.stdout, done.stderr), flush=True)
    return done.returncode == 0


def processor():
    """Processor seconds that this process and its children have used."""
    return sum(used.ru_utime + used.ru_stime for used in map(resource.getrusage, (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)))


def run_room(build, label, name, few=False):
    start, before = time.monotonic(), processor()
    tests = harness.Tests(build, label, label == "sanitized", few)
    try:
        tests.room(name, ROOMS[name])
        left = os.listdir(tests.tmp)
        tests.check("no temporary files are left", not left, " ".join(left))
    finally:
        tests.close()
    result = Result(label, name, tests.cases, time.monotonic() - start, processor() - before)
    print("%-10s %-12s %5d passed %3d failed  %5.1f s" % (label, name, tests.passed, tests.failed, result.seconds), flush=True)
    return result


def run_rooms(jobs):
    """Two side by side, since many leave a core idle, and besides them one that waits for a terminal."""
    with ProcessPoolExecutor(2) as pool, ProcessPoolExecutor(1) as aside:  # threads would share one interpreter lock
        running = [(aside if job[2] in WAITING else pool).submit(run_room, *job) for job in jobs]
        return [one.result() for one in running]


def builds(variants):
    """([labels of the builds that succeeded], Result): each build is a case of the room `build`."""
    cases, good, start, before = {}, [], time.monotonic(), processor()
    for label, args in variants:
        case = cases["builds " + label] = harness.Case()
        case.draws, began = 1, time.monotonic()
        case.ok = make(*args)
        case.seconds = time.monotonic() - began
        good += [label] * case.ok
    result = Result("", "build", cases, time.monotonic() - start, processor() - before)
    print("%-10s %-12s %5d passed %3d failed  %5.1f s" % ("", "build", len(good), len(variants) - len(good), result.seconds), flush=True)
    return good, result


def short(wanted):
    good, built = builds([("plain", ["all", "tests"])])
    return [built, *run_rooms([("build", label, name, True) for label in good for name in wanted if name not in OTHER])]


def rest(wanted):
    args = ["sanitized"]
    if harness.links("clang", "-fsanitize=address,undefined"):  # its sanitizers see more than gcc's
        args.append("CC=clang")
    variants = [("plain", ["all", "tests"]), ("sanitized", args)]
    if "CC=clang" not in args and shutil.which("clang"):  # only to see that it builds with clang
        variants.append(("by clang", ["B=build/clang", "CC=clang", "all", "tests"]))
    good, built = builds(variants)
    jobs = [("build", "plain", name) for name in wanted if name in OTHER]
    jobs += [("build/asan", "sanitized", name, True) for name in wanted if name not in PLAIN + OTHER]
    jobs += [("build", "plain", name) for name in wanted if name in DRAWING]
    return [built, *run_rooms([job for job in jobs if job[1] in good])]


def told(results):
    """Prints the seconds by room, and the tests that take longest."""
    print("\n%-10s %-12s %7s %9s %7s %10s" % ("", "room", "seconds", "processor", "cases", "draws"))
    for r in sorted(results, key=lambda r: -r.processor):
        print("%-10s %-12s %7.1f %9.1f %7d %10d" % (r.label, r.room, r.seconds, r.processor, len(r.cases),
                                                    sum(case.draws for case in r.cases.values())))
    print("%-10s %-12s %7s %9.1f\n\nThe slowest tests:" % ("", "all", "", sum(r.processor for r in results)))
    slowest = sorted(((case.seconds, r, name) for r in results for name, case in r.cases.items()), key=lambda row: -row[0])
    for seconds, r, name in slowest[:20]:
        print("%6.1f s  %s %s: %s" % (seconds, r.label, r.room, name[:90].replace("\n", " ")))
    print()


def main():
    parser = argparse.ArgumentParser(prog="tests/run")
    parser.add_argument("--rest", action="store_true", help="what make check-all runs beyond make check")
    parser.add_argument("--times", action="store_true", help="seconds by room, and the tests that take longest")
    parser.add_argument("rooms", nargs="*", metavar="ROOM", help="only these: " + " ".join(sorted(ROOMS)))
    args = parser.parse_args()
    for name in args.rooms:
        if name not in ROOMS:
            parser.error("no room '%s': %s" % (name, " ".join(sorted(ROOMS))))
    wanted = [name for name in ROOMS if not args.rooms or name in args.rooms]
    results = (rest if args.rest else short)(wanted)
    os.makedirs(os.path.join(harness.ROOT, "build"), exist_ok=True)
    with open(os.path.join(harness.ROOT, "build", "cases.txt"), "w", encoding="utf-8") as f:
        for r in results:
            for name, case in r.cases.items():
                f.write("%s %s: %s: %s, %d drawn, %.2f s\n" % (r.label, r.room, name, "ok" if case.ok else "FAILED", case.draws, case.seconds))
    if args.times:
        told(results)
    passed = sum(case.ok for r in results for case in r.cases.values())
    failed = sum(len(r.cases) for r in results) - passed
    print("%d passed, %d failed" % (passed, failed))
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main())
