# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the libFuzzer targets of fuzz.c, starting from the corpus in git. `fuzzing.py FUZZ SECONDS [TARGET...]` runs each for so long,
keeps new inputs in build/fuzz/corpus and writes tests/hard/fuzz.txt; the tests run each for ten seconds. `--minimise` merges
build/fuzz/corpus into the corpus in git: the few inputs that reach all code that both reach."""
import glob
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path.insert(0, os.path.join(ROOT, "tests"))
import harness  # noqa: E402

TARGETS = ("statements", "json", "gap", "follow", "table", "replay", "library")
LONGEST = {"statements": 1200, "json": 1200, "gap": 2000, "follow": 2000, "table": 2000, "replay": 2000, "library": 1000}
# The timer is the target's own, see patience() in fuzz.c.
OPTIONS = ("-timeout=0", "-rss_limit_mb=3000", "-use_value_profile=0", "-print_final_stats=1", "-verbosity=1")


def corpus(target):
    return os.path.join(HERE, "corpus", target + ".txt")


# The corpus is text: a paragraph per input, with unprintable bytes as \xNN and an empty line as a single backslash.
def written(data):
    text = re.sub(r"[\\\x00-\x09\x0b-\x1f\x7f\x80-\x9f\u2028\u2029\ud800-\udfff]", lambda found: "\\\\" if found.group() == "\\" else
                  "".join("\\x%02x" % byte for byte in found.group().encode("utf-8", "surrogateescape")), data.decode("utf-8", "surrogateescape"))
    return "\n".join(line or "\\" for line in text.split("\n"))


def given(paragraph):
    text = "\n".join("" if line == "\\" else line for line in paragraph.split("\n")).encode()
    return re.sub(rb"\\(\\|x[0-9a-f]{2})", lambda found: b"\\" if found.group(1) == b"\\" else bytes([int(found.group(1)[1:], 16)]), text)


def inputs(target):
    """The inputs in git."""
    if not os.path.exists(corpus(target)):
        return []
    with open(corpus(target), encoding="utf-8", newline="\n") as f:
        return [given(paragraph) for paragraph in f.read().rstrip("\n").split("\n\n")]


def unpack(target, folder):
    """Writes each input to a file of its own, as libFuzzer needs."""
    os.makedirs(folder)
    for i, data in enumerate(inputs(target)):
        pathlib.Path(folder, "%04d" % i).write_bytes(data)
    return folder


def environment(target, tmp):
    return {"PATH": os.environ["PATH"], "LC_ALL": "C", "FRET_FUZZ": target, "TMPDIR": tmp,
            "ASAN_OPTIONS": "detect_leaks=1:allocator_may_return_null=1:max_allocation_size_mb=512",
            "UBSAN_OPTIONS": "print_stacktrace=1"}


def seeds(target):
    """Inputs to begin a corpus with, taken from the tests."""
    for path in sorted(glob.glob(os.path.join(ROOT, "tests/sessions/*.txt")) + glob.glob(os.path.join(ROOT, "scripts/demos/*.txt")) +
                       glob.glob(os.path.join(ROOT, "scripts/paper/*.txt"))):
        with open(path, encoding="utf-8") as f:
            text = f.read()
        lines = [statement for statement, _ in harness.read_transcript(text)] or text.splitlines()
        if target == "replay":
            part = re.split(r"(?m)^(?=fret> )", text)
            for i in range(1, len(part), 12):
                yield "".join(part[i:i + 12])
        else:
            for i in range(0, len(lines), 8):
                yield "\n".join(lines[i:i + 8])
    import programs
    for seed in range(40):
        program = programs.Writer(seed).program()
        for name, mine in (("gap.csv", "given.csv"), ("loads.csv", "given-loads.csv"), ("data.csv", "given-data.csv"),
                           ("more.fret", "given.fret")):
            program = [line.replace(name, mine) for line in program]
        if target != "replay":
            yield "\n".join(program)


FILES = ("r [mm],f [um]\n0,0\n0.1,0.5\n0.2,2\n0.4,8\n0.8,32\n1.6,128\n", "r,f\n0,0\n1e-3,5e-5\n2e-3,2e-4\n",
         "FN [N],Fx [N]\n100,0\n120,15\n90,-10\n100,20\n", "dz [um];dx [nm]\n2;0\n3;400\n2,5;-200\n", "FN\tFx\n100\t0\n80\t5\n",
         "force [N],depth [um]\n10,0.75\n50,2.2\n100,3.5\n", "dx [um],Fx [N],FN [N]\n0,0,100\n0.2,10,100\n0.5,18,100\n0,-3,100\n",
         "# a note\nx [N],y [um]\n1,0.1\n\n2,0.2\n3,\n", "\ufeffr [mm],f [um]\r\n0,0\r\n1,50\r\n", "\"r [mm]\",\"f [um]\"\n\"0\",\"0\"\n\"1\",\"2\"\n")


def forms():
    """Tables in all formats that fret reads."""
    return [pathlib.Path(path).read_bytes() for path in sorted(glob.glob(os.path.join(ROOT, "tests/sessions/forms/*")))]


def rows():
    """The functions that the target `library` calls."""
    with open(os.path.join(HERE, "library.h"), encoding="utf-8") as f:
        return re.findall(r"ROW\((fret_\w+)\)", f.read())


def calls():
    """Inputs of the target `library`: calls of all functions in several orders, with usual and unusual numbers."""
    r = random.Random(1)
    for _ in range(60):
        names = r.sample(rows(), 30)
        yield "\n".join(" ".join([name, *(r.choice(("1", "0.3", "2", "100", "1e-3", "0", "-1", "inf", "nan", "1e300", "5e-324")) for _ in range(6))])
                        for name in names)


def start(target, folder):
    """Begins a new corpus from seeds."""
    texts = [*FILES, *forms()] if target in ("gap", "follow", "table") else calls() if target == "library" else seeds(target)
    for i, text in enumerate(texts):
        data = text if isinstance(text, bytes) else text.encode()
        pathlib.Path(folder, "seed-%d" % i).write_bytes(data[:LONGEST[target]])


def dictionary(target, path):
    """Writes libFuzzer's dictionary: words of the language, from the sources, or of the library."""
    words = set(rows() if target == "library" else ())
    for name in () if words else [path for room in ("text", "scene", "language", "prompt") for path in glob.glob(os.path.join(ROOT, "src", room, "*.c"))]:
        with open(name, encoding="utf-8") as f:
            words |= set(re.findall(r'"([A-Za-z][\w.-]{0,14})"', f.read()))
    with open(path, "w", encoding="utf-8") as f:
        f.writelines('"%s"\n' % word for word in sorted(words if target == "library" else words | {":=", "+=", "..", " at ", " in ", " along ", "FN=100 N"}))


def fuzz(program, target, seconds, folder, seed):
    """Runs a target: (executions, coverage, features, inputs, what went wrong)"""
    with tempfile.TemporaryDirectory(prefix="fret-fuzzing-") as tmp:
        dictionary(target, os.path.join(tmp, "words"))
        known = unpack(target, os.path.join(tmp, "known"))
        try:
            done = subprocess.run([program, folder, known, "-max_total_time=%d" % seconds, "-seed=%d" % seed,
                                   "-max_len=%d" % LONGEST[target], "-dict=" + os.path.join(tmp, "words"),
                                   "-artifact_prefix=%s/" % tmp, *OPTIONS], capture_output=True, cwd=tmp,
                                  env=environment(target, tmp), timeout=20 * seconds + 600, check=False)
            text, status = done.stderr.decode(errors="replace"), done.returncode
        except subprocess.TimeoutExpired as error:
            text, status = (error.stderr or b"").decode(errors="replace"), "no end"
        wrong = None
        if status != 0:
            found = [name for name in os.listdir(tmp) if re.match("(crash|leak|oom)-", name)]
            kept = os.path.join(ROOT, "build", "fuzz", "found")
            os.makedirs(kept, exist_ok=True)
            for name in found:
                shutil.copy(os.path.join(tmp, name), os.path.join(kept, target + "-" + name))
            blame = [pathlib.Path(tmp, name).read_bytes() for name in found]
            wrong = "ends with %s, given %s\n%s" % (status, " and ".join(map(repr, blame)), "\n".join(
                line for line in text.splitlines() if not re.match(r"#\d+\s+(NEW|REDUCE|pulse|RELOAD)", line))[-4000:])
        runs = re.findall(r"stat::number_of_executed_units: (\d+)", text) or re.findall(r"^#(\d+)\s", text, re.M) or ["0"]
        reached = re.findall(r"cov: (\d+) ft: (\d+) corp: (\d+)", text) or [("0", "0", "0")]
        return (int(runs[-1]), *map(int, reached[-1]), wrong)


def run(tests):
    """Runs each target for ten seconds, and types the lines of a session."""
    program = os.path.join(ROOT, "build/asan/fuzz")
    if not harness.links("clang", "-fsanitize=fuzzer", "int LLVMFuzzerTestOneInput(void); int LLVMFuzzerTestOneInput(void) { return 0; }"):
        print("fuzz: not run, clang with libFuzzer is not installed")
        return
    done = subprocess.run(["make", "--no-print-directory", "-s", "-j%d" % (os.cpu_count() or 1), "fuzz-build"], cwd=ROOT,
                          capture_output=True, text=True, check=False)
    if not tests.check("the targets build", done.returncode == 0, done.stdout[-1000:] + done.stderr[-2000:]):
        return

    def one(target):
        with tempfile.TemporaryDirectory(prefix="corpus-", dir=tests.dir) as folder:
            runs, *_, wrong = fuzz(program, target, 10, folder, 1)
        tests.check("fuzz: " + target, not wrong and runs > len(inputs(target)), wrong or "%d runs" % runs)
    tests.each([lambda target=target: one(target) for target in TARGETS])


def minimise(program):
    for target in TARGETS:
        found = os.path.join(ROOT, "build/fuzz/corpus", target)
        with tempfile.TemporaryDirectory(prefix="fret-fuzzing-") as tmp:
            new = os.path.join(tmp, "new")
            os.mkdir(new)
            folders = [unpack(target, os.path.join(tmp, "known")), *([found] if os.path.isdir(found) else [])]
            subprocess.run([program, "-merge=1", "-use_counters=0", "-max_len=%d" % LONGEST[target], new, *folders, "-timeout=0", "-rss_limit_mb=3000"],
                           cwd=tmp, env=environment(target, tmp), capture_output=True, check=False)
            text = "\n\n".join(sorted(written(path.read_bytes()) for path in pathlib.Path(new).iterdir())) + "\n"
            with open(corpus(target), "w", encoding="utf-8", newline="\n") as f:
                f.write(text)
            print("%s: %d inputs, %d bytes" % (target, len(inputs(target)), len(text)), flush=True)


def main():
    program = os.path.abspath(sys.argv[1])
    if sys.argv[2] == "--minimise":
        minimise(program)
        return 0
    seconds, chosen, failed = int(sys.argv[2]), sys.argv[3:] or TARGETS, 0

    def one(target):
        folder = os.path.join(ROOT, "build/fuzz/corpus", target)
        os.makedirs(folder, exist_ok=True)
        if not inputs(target) and not os.listdir(folder):
            start(target, folder)
        return fuzz(program, target, seconds, folder, int.from_bytes(os.urandom(3), "big") + 1)
    text = "# make fuzz FUZZ=%d: each target for so many seconds, ASan and UBSan\n%-12s %12s %10s %10s %8s\n" % (
        seconds, "target", "executions", "edges", "features", "inputs")
    with ThreadPoolExecutor(max_workers=os.cpu_count() or 1) as pool:
        for target, (runs, edges, features, kept, wrong) in zip(chosen, pool.map(one, chosen)):
            text += "%-12s %12d %10d %10d %8d\n" % (target, runs, edges, features, kept)
            if wrong:
                print("FAILED %s: %s" % (target, wrong), flush=True)
                failed += 1
    print(text, end="")
    if not failed and len(chosen) == len(TARGETS):
        with open(os.path.join(ROOT, "tests/hard/fuzz.txt"), "w", encoding="ascii") as f:
            f.write(text)
    print("fuzz: %d passed, %d failed" % (len(chosen) - failed, failed))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
