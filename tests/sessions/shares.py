# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests fret --part I/N: for every N the output of all shares, one after the other, is the output of the whole run."""
import os
import re
import shutil
import subprocess

import harness

GRADED = "material E0=210 GPa nu=0.3 k=0.3 c0=1 mm; geometry sphere R=10 mm; friction 0.4; press FN=100 N; cycle FA=20 N"
ROWS = (
    "a, dz; table dW(F) in uJ, c(F)/a for F = 10 N .. 40 N steps 6 with k = 0, 0.3; 2*a",
    "table a, dW for k = -0.9 .. 0.9 steps 6 for nu = 0 .. 0.5 steps 4",
    "table a for R = 1 mm .. 1 m log steps 500",
    "table Fx, dx along cycle steps 10",
    "table Fx, dx along cycle FA=30 N steps 9 with k = 0, 0.5; c",
    "table q for q = 1 .. 2 steps 1",
    "table a for FN = 100 N, 3 N, 20 N, 5 N with k = 0, 0.3",
    "table a, c at loads.csv",
    "table dz, a at depths.csv with k = 0, 0.3",
    "2*a; plot map c(F)/a for F = 10 N .. 30 N steps 4 for k = -0.5 .. 0.5 steps 6 title \"stick\"; a",
)
FILES = {"loads.csv": "FN [N],mu\n" + "".join("%d,%g\n" % (70 + i, 0.4 + i / 100) for i in range(17)),
         "depths.csv": "FN [N],depth [um]\n" + "".join("%d,%g\n" % (60 + i, 4 + i / 10) for i in range(11))}
GAPS = "table sqrt(q - 0.4), W at k=q for q = -0.5 .. 0.95 steps 30"
SAMPLES = "uncertainty dW in uJ, a, c/a with k +- 0.01, mu +- 5 %, FN +- 30 N samples 800 seed 3"
COUNTS = (1, 3, 8)


def share(tests, number, of, script, form):
    return tests.run("--format=" + form, "--part", "%d/%d" % (number, of), "-c", script)


def put_together(tests, of, script, form):
    """The output of all shares, joined, if none has failed."""
    done = [share(tests, i + 1, of, script, form) for i in range(of)]
    failed = [one for one in done if one.returncode]
    return tests.report(failed[0]) if failed else "".join(one.stdout for one in done)


def rows_alone(text):
    """The text without the rms of a comparison, which needs all rows."""
    return "".join(line for line in text.splitlines(keepends=True) if "rms" not in line)


def tables(tests):
    for name, text in FILES.items():
        with open(os.path.join(tests.dir, name), "w", encoding="ascii") as f:
            f.write(text)
    for statement in ROWS:
        script = "%s; %s" % (GRADED, statement)
        for form in ("csv", "json"):
            # a map has the values of a table over its ranges
            whole = tests.run("--format=" + form, "-c", re.sub("plot map (.*) title [^;]*", r"table \1", script))
            for of in COUNTS:
                got, want = put_together(tests, of, script, form), rows_alone(whole.stdout) if of > 1 else whole.stdout
                tests.check("%s, %s, by %d" % (statement, form, of), whole.returncode == 0 and got == want, harness.diff(want, got))
    script = "%s; %s" % (GRADED, GAPS)
    whole = tests.run("--format=csv", "-c", script).stdout
    for of in COUNTS:  # some shares have no value
        tests.check("gaps by %d" % of, put_together(tests, of, script, "csv") == whole)
    sizes = [len(share(tests, i, 5, GRADED + "; table a for k = 0 .. 0.5 steps 11", "csv").stdout.splitlines()) for i in range(1, 6)]
    tests.check("shares of a size", sizes == [1 + 3, 3, 2, 2, 2], str(sizes))


def samples(tests):
    """The samples of all shares together are those of the whole run."""
    script = "%s; %s" % (GRADED, SAMPLES)
    whole = tests.run("-c", script)
    drawn = {}
    for of in COUNTS:
        drawn[of] = put_together(tests, of, script, "csv")
        with open(os.path.join(tests.dir, "samples.csv"), "w", encoding="ascii") as f:
            f.write(drawn[of])
        summed = tests.run("-c", script + " from samples.csv")
        tests.check("samples by %d, summed" % of, "Monte Carlo" in whole.stdout and summed.stdout == whole.stdout, harness.diff(whole.stdout, summed.stdout))
    tests.check("the same samples in any share", drawn[1] == drawn[3] == drawn[8] and len(drawn[1].splitlines()) == 801)
    tests.check("gaps among them", "\n,0.000" in drawn[1] and "no value: the file has none" in summed.stderr, summed.stderr)
    rows = [line.split(",") for line in drawn[1].splitlines()[1:]]
    radii = [float(row[1]) for row in rows if row[1]]
    tests.check("no two alike", len(set(radii)) == len(radii))
    # mean and deviation of a linear expression from 1e5 samples: within four standard errors
    done = tests.run("--format=json", "-c", "x = 3; y = 1; uncertainty x + 0*y, y - x with x +- 0.5, y +- 2 samples 100000")
    events = [row for row in harness.told(done.stdout) if "event" in row]
    for event, mean, deviation in zip(events, (3, -2), (0.5, 4.25 ** 0.5)):
        got = event["Monte Carlo"]
        tests.check("mean and deviation of %s" % event["of"], abs(got["mean"] - mean) < 4 * deviation / 1e5 ** 0.5 and
                    abs(got["deviation"] / deviation - 1) < 4 / 2e5 ** 0.5, str(got))
    lines = drawn[1].splitlines(keepends=True)
    for what, text, says in (("a share is missing", "".join(lines[:400] + lines[501:]), r":401: expected sample 400 of 800"),
                             ("the last is missing", "".join(lines[:700]), r":700: expected sample 700 of 800"),
                             ("in another order", "".join(lines[:1] + lines[401:] + lines[1:401]), r":2: expected sample 1 of 800"),
                             ("too many", "".join(lines + ["1,1,1,801\n"]), r":802: expected sample 801 of 800"),
                             ("cut off", "".join(lines)[:-2], r"expected sample 800 of 800|the line ends"),
                             ("cut off within", "".join(lines[:400])[:-9] + "".join(lines[400:]), r"more than 4 fields|expected"),
                             ("of another question", "".join(lines).replace("v2 [m]", "v2 [N]"), "v2 of samples.csv is a force"),
                             ("no number", "".join(lines[:5] + ["x,1,1,5\n"] + lines[6:]), "expected a number as v1"),
                             ("of fewer", "".join(line.split(",", 1)[1] for line in lines), "no samples of 3 values")):
        with open(os.path.join(tests.dir, "samples.csv"), "w", encoding="ascii") as f:
            f.write(text)
        done = tests.run("-c", script + " from samples.csv")
        tests.check("samples: " + what, done.returncode == 1 and not done.stdout and re.search(says, done.stderr), tests.report(done))


def refused(tests):
    for part in ("0/3", "4/3", "1", "1/", "/3", "1/3/5", "a/b", "-1/3", "1/-3", " 1/3", "1/ 3", "1/99999999999"):
        done = tests.run("--format=csv", "--part", part, "-c", "table q for q = 1 .. 2")
        tests.check("--part " + part, done.returncode == 2 and not done.stdout and "--part is I/N" in done.stderr, tests.report(done))
    for words, script, says in ((("--format=text",), "table q for q = 1 .. 2", "needs --format=csv or json"),
                                (("--format=csv",), "table q for q = 1 .. 2 to rows.csv", "standard output"),
                                (("--format=csv",), "table q for q = 1 .. 2; table q for q = 1 .. 2", "a second"),
                                (("--format=csv",), "1 + 1", "there was no table"),
                                (("--format=csv",), "plot q for q = 1 .. 2 to share.svg", "no table, map or"),
                                (("--format=csv",), "plot map q + s for q = 1 .. 2 for s = 1 .. 2 to share.svg", "not a picture"),
                                (("--format=csv",), "table q for q = 1 .. foo", "unknown name 'foo'")):
        done = tests.run(*words, "--part", "2/3", "-c", script)
        tests.check("a share of " + script, done.returncode == 1 and says in done.stderr and "1 + 1" not in done.stdout, tests.report(done))
    tests.check("no file of a share", not os.path.exists(os.path.join(tests.dir, "rows.csv")))
    for words in (("--replay", "x"), ("--live",)):
        done = tests.run("--part", "1/2", *words)
        tests.check("--part with " + words[0], done.returncode == 2 and "goes with a script" in done.stderr, tests.report(done))
    done = tests.run("--format=csv", "--part", "1/2", input="table q for q = 1 .. 2 steps 1")
    tests.check("a share by a pipe", done.stdout == "q,q (2)\n1,1\n", tests.report(done))
    with open("/dev/full", "w", encoding="ascii") as full:
        done = subprocess.run([tests.fret, "--format=csv", "--part", "2/2", "-c", "table q for q = 1 .. 2"], stdout=full,
                              stderr=subprocess.PIPE, text=True, env=tests.env, check=False)
    tests.check("a share and a full disk", done.returncode == 1 and "No space left" in done.stderr, done.stderr)


# At the first attempt share 2 fails after half of its output.
FAILING = """#!/bin/sh
case " $* " in *" --part 2/"*)
    if mkdir failed 2> /dev/null; then "$FRET" "$@" | head -c 100; exit 1; fi ;;
esac
exec "$FRET" "$@"
"""


def by_others(tests):
    """Shares run by GNU parallel, as in README.md, and as a SLURM array, as in help."""
    with open(os.path.join(harness.ROOT, "README.md"), encoding="utf-8") as f:
        readme = f.read()
    parallel = re.search(r"^    (seq 8 \| parallel .*)$", readme, re.M).group(1)
    array = re.search(r"^    #!/bin/sh\n    #SBATCH --array=1-64\n((?:    .*\n)+)\n.*\n\n    (cat .*)$", tests.run("-c", "help parts").stdout, re.M)
    bin = os.path.join(tests.dir, "bin")
    os.mkdir(bin)
    with open(os.path.join(bin, "fret"), "w", encoding="ascii") as f:
        f.write(FAILING)
    os.chmod(os.path.join(bin, "fret"), 0o755)
    with open(os.path.join(tests.dir, "study.fret"), "w", encoding="ascii") as f:
        f.write("%s\n%s\n" % (GRADED, "table a, dW for k = -0.9 .. 0.9 steps 130"))
    whole = tests.run("--format=csv", "study.fret").stdout
    env = dict(tests.env, PATH=bin + ":" + tests.env["PATH"], FRET=tests.fret)

    def shell(command, **more):
        return subprocess.run(["sh", "-c", command], capture_output=True, text=True, cwd=tests.dir, env=dict(env, **more), timeout=120, check=False)

    def rows():
        with open(os.path.join(tests.dir, "rows.csv"), encoding="ascii") as f:
            return f.read()

    tried = [shell(array.group(1), SLURM_ARRAY_TASK_ID=str(i)).returncode for i in range(1, 65)]
    tests.check("an array: one share fails", tried == [0, 1] + 62 * [0], str(tried))
    shell(array.group(2))
    tests.check("an array: something is missing then", rows() != whole)
    again = shell(array.group(1), SLURM_ARRAY_TASK_ID="2")
    shell("rm rows.csv; " + array.group(2))
    tests.check("an array, one share run again", again.returncode == 0 and rows() == whole, harness.diff(whole, rows()))
    if not shutil.which("parallel") or "GNU" not in shell("parallel --version").stdout:
        print("left out: shares by the real parallel need GNU parallel")
        return
    shell("rmdir failed; rm rows.*")
    done = shell(parallel)
    tests.check("by parallel, a share that fails run again", done.returncode == 0 and os.path.exists(os.path.join(tests.dir, "failed")) and
                rows() == whole, done.stderr + harness.diff(whole, rows()))


def run(tests):
    tables(tests)
    samples(tests)
    refused(tests)
    by_others(tests)
