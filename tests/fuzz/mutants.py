# SPDX-License-Identifier: GPL-3.0-or-later
"""Does a test notice? One token of src/ is changed at a time, the program built in a copy of the tree, and the rooms of
tests run that have to do with it, those first that are likely to notice, until one fails.

    python3 tests/fuzz/mutants.py [--seed 1] [--count 300] [--only DIRECTORY] [--table FILE] [--work FOLDER]

The table lists what no test noticed, with the judgement that the table of before has of it: write it there by hand.
`--work` keeps the copy and its log, so that a run that was ended goes on."""
import argparse
import collections
import glob
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
OPT = "OPT=-O1 -fno-tree-slp-vectorize"
LEFT_OUT = ("src/live/none.c", "src/shell/prompt_plain.c", "src/shell/study_none.c", "src/number/constants.h",
            "src/contact/tables.h")
TIMEOUT = 120  # of a room, in seconds of an idle machine
ROOMS = {"number": "unit sessions reference numbers hard accuracy", "contact": "unit sessions reference numbers hard accuracy",
         "fast": "unit sessions accuracy numbers hard",
         "calc": "sessions errors unit scripts reading help keeping reference looks backwards fits smoothing numbers",
         "study": "fits backwards accuracy sessions errors sharing smoothing", "plot": "unit figures looks sessions paper",
         "shell": "sessions errors scripts help readme keeping looks completion figures fits accuracy interactive trouble",
         "live": "live casts unit interactive"}

TOKEN = re.compile(r"""(?P<skip>//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\])*"|'(?:\\.|[^'\\])*'|^[ \t]*\#(?:\\\n|[^\n])*)
                     |(?P<number>(?:0x[\da-fA-F]+|(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)[uUlLfF]*)
                     |(?P<word>[A-Za-z_]\w*)
                     |(?P<sign><<=|>>=|->|\+\+|--|<<|>>|<=|>=|==|!=|&&|\|\||[-+*/%&|^]=|[-+*/%<>=!&|^~?:;,.(){}\[\]])
                  """, re.S | re.M | re.X)
SIGNS = {"<": ("<=", ">="), ">": (">=", "<="), "<=": ("<", ">"), ">=": (">", "<"), "==": ("!=",), "!=": ("==",),
         "&&": ("||",), "||": ("&&",), "+": ("-",), "-": ("+",), "*": ("/",), "/": ("*",), "%": ("/",), "+=": ("-=",),
         "-=": ("+=",), "*=": ("/=",), "/=": ("*=",), "++": ("--",), "--": ("++",), "!": ("",), "&": ("|",), "|": ("&",),
         "<<": (">>",), ">>": ("<<",), "|=": ("&=",), "&=": ("|=",)}
WORDS = {"true": "false", "false": "true", "break": "continue", "continue": "break", "fmin": "fmax", "fmax": "fmin",
         "fminl": "fmaxl", "fmaxl": "fminl", "floor": "ceil", "ceil": "floor", "floorl": "ceill", "ceill": "floorl",
         "fabs": "", "fabsl": "", "NULL": None, "while": "if"}


def numbers(text):
    """What a number may become."""
    digits = re.match(r"(0x[\da-fA-F]+|[\d.]+(?:[eE][-+]?\d+)?)(.*)$", text)
    body, suffix = digits.groups()
    if re.fullmatch(r"\d+", body):
        n = int(body)
        return ["%d%s" % (m, suffix) for m in ({0: [1], 1: [0, 2]}.get(n, [n + 1, n - 1]))]
    if body.startswith("0x"):
        return ["%#x%s" % (int(body, 16) + 1, suffix)]
    if not float(body):
        return ["1.0" + suffix]
    other = repr(float(body) * (2 if len(re.sub(r"[eE].*|\.", "", body).strip("0")) < 3 else 1.01))
    return [other + suffix]


def places(path, text):
    """[(offset, length, replacements)] of what may change."""
    found, before = [], ""
    for token in TOKEN.finditer(text):
        kind, now = token.lastgroup, token.group()
        if kind == "skip":
            continue
        others = []
        if kind == "number":
            others = numbers(now)
        elif kind == "word" and WORDS.get(now) is not None:
            others = [WORDS[now]]
        elif kind == "sign" and now in SIGNS:
            unary = not re.match(r"[\w)\]]", before) or before in ("return", "case")
            pointer = now in "*&" and (unary or re.search(r"(?:\b(?:char|int|void|double|bool|FILE|const|size_t)|_t|struct \w+|\w+_\w+) $",
                                                          text[max(0, token.start() - 40):token.start()]))
            if now == "-" and unary:
                others = [""]
            elif not pointer and not (unary and now in "+*&"):
                others = SIGNS[now]
        if others:
            found.append((token.start(), len(now), list(others)))
        before = now
    return found


class Copy:
    """The tree in which mutants are built, and what it was like before."""

    def __init__(self, work):
        self.top, self.good = os.path.join(work, "tree"), os.path.join(work, "good")
        self.log = os.path.join(work, "log")
        if not os.path.exists(self.good):
            shutil.rmtree(self.top, ignore_errors=True)
            os.makedirs(self.top)
            names = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split("\n")
            for name in filter(None, names):
                os.makedirs(os.path.dirname(os.path.join(self.top, name)), exist_ok=True)
                shutil.copy2(os.path.join(ROOT, name), os.path.join(self.top, name), follow_symlinks=False)
            if self.make("build/fret", "tests") is not None:
                sys.exit("mutants: the program itself does not build")
            for room in sorted(set(" ".join(ROOMS.values()).split())):
                how = self.room(room, 10)
                if how:  # perhaps for want of time
                    print("the room %s fails without a mutant (%s) and is left out" % (room, how), flush=True)
                    open(os.path.join(self.top, "without-" + room), "w").close()
            shutil.copytree(self.top, self.good, symlinks=True)

    def make(self, *targets):
        """None, or what is wrong."""
        done = subprocess.run(["make", "--no-print-directory", "-s", OPT, "WARN=-w", *targets], cwd=self.top,
                              capture_output=True, text=True, errors="replace")
        return None if done.returncode == 0 else done.stderr

    def restore(self):
        """Files that are not as they were; returns the object files among them."""
        back = []
        for folder, _, names in os.walk(self.good):
            for name in names:
                good = os.path.join(folder, name)
                now = os.path.join(self.top, os.path.relpath(good, self.good))
                if not os.path.islink(good) and (not os.path.exists(now) or
                                                 os.stat(good).st_mtime_ns != os.stat(now).st_mtime_ns):
                    shutil.copy2(good, now)
                    back.append(now)
        return back

    def changed(self):
        """Does some object differ? Only then can the program."""
        for folder, _, names in os.walk(os.path.join(self.top, "build")):
            for name in names:
                if name.endswith(".o"):
                    now = os.path.join(folder, name)
                    with open(now, "rb") as a, open(os.path.join(self.good, os.path.relpath(now, self.top)), "rb") as b:
                        if a.read() != b.read():
                            return True
        return False

    def room(self, name, factor):
        """How a room of tests ends: None when all passed."""
        start = time.time()
        job = subprocess.Popen([sys.executable, os.path.join(self.top, "tests/fuzz/mutants.py"), "--room", name], cwd=self.top,
                               stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, start_new_session=True)
        try:
            out, _ = job.communicate(timeout=TIMEOUT * factor)
            how = None if job.returncode == 0 else out.decode(errors="replace").strip()[-120:] or "ended by %d" % job.returncode
        except subprocess.TimeoutExpired:
            how = "no end within %.0f s" % (time.time() - start)
        try:
            os.killpg(job.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        job.wait()
        return how


def run_room(name):
    """In the copy: ends at the first failure."""
    sys.path.insert(0, os.path.join(ROOT, "tests"))
    import harness
    import runner

    class Stops(harness.Tests):
        @property
        def failed(self):
            return 0

        @failed.setter
        def failed(self, value):
            if value:
                sys.__stdout__.write("noticed\n")
                sys.__stdout__.flush()
                shutil.rmtree(self.top, ignore_errors=True)
                os._exit(1)

    tests = Stops("build", "mutant", False)
    sys.stdout = open(os.devnull, "w")
    try:
        runner.ROOMS[name](tests)
    except BaseException:
        tests.failed = 1
    tests.close()
    os._exit(0)


def nearest(top, path):
    """The programs of tests/unit that are about a file."""
    stem = os.path.basename(path).rpartition(".")[0]
    names = [stem, stem.partition("_")[0], {"table": "shape", "law": "normal", "zone": "diagram"}.get(stem, path.split("/")[1])]
    return [name for name in dict.fromkeys("test_" + name for name in names)
            if os.path.exists(os.path.join(top, "tests/unit", name + ".c"))]


def order(path, first):
    """Rooms, those first that are likely to notice."""
    directory = path.split("/")[1]
    return list(dict.fromkeys(first[path][-3:][::-1] + ROOMS[directory].split()))


def attempt(copy, path, at, length, other, first, factor):
    """(what became of it, where)."""
    name = os.path.join(copy.top, path)
    with open(name, encoding="utf-8") as f:
        text = f.read()
    with open(name, "w", encoding="utf-8") as f:
        f.write(text[:at] + other + text[at + length:])
    try:
        if copy.make("build/fret"):
            return "no program", ""
        if not copy.changed():
            return "same code", ""
        for test in nearest(copy.top, path):
            if copy.make("build/tests/" + test):
                return "killed", "build"
            try:
                ended = subprocess.run([os.path.join(copy.top, "build/tests", test)], cwd=copy.top, capture_output=True,
                                       timeout=TIMEOUT * factor, check=False)
            except subprocess.TimeoutExpired:
                return "late", test
            if ended.returncode:
                return "killed", test
        if copy.make("tests"):
            return "killed", "build"
        for room in order(path, first):
            if os.path.exists(os.path.join(copy.good, "without-" + room)):
                continue
            how = copy.room(room, factor)
            if how:
                first[path].append(room)
                return ("late" if how.startswith("no end") else "killed"), room
        return "lives", ""
    finally:
        copy.restore()


def table(out, done, judged, options, head):
    rows = collections.defaultdict(collections.Counter)
    for one in done:
        rows[one["path"].split("/")[1]][one["end"]] += 1
    out.write(head)
    out.write("# Tokens of src/ changed one at a time: %d at random, seed %d. Killed: a test fails, or (late) does not end.\n"
              "# Of those that changed the code of some object file.\n" % (len(done), options.seed))
    out.write("%-10s %7s %6s %5s %6s %8s\n" % ("room", "mutants", "killed", "late", "lives", "killed %"))
    total = collections.Counter()
    for room in sorted(rows) + ["all"]:
        r = rows[room] if room != "all" else total
        if room != "all":
            total.update(r)
        n = r["killed"] + r["late"] + r["lives"]
        out.write("%-10s %7d %6d %5d %6d %8.1f\n" % (room, n, r["killed"], r["late"], r["lives"],
                                                     100.0 * (r["killed"] + r["late"]) / max(n, 1)))
    out.write("\nWhat lives, and why (equivalent, speed only, beyond the tests, hole):\n")
    for one in done:
        if one["end"] == "lives":
            key = key_of(one)
            out.write("%s\n    %s\n" % (key, judged.get(key, "not judged")))


def key_of(one):
    return "%s: %s: `%s` -> `%s`" % (one["path"], one["text"], one["old"], one["new"])


def judgements(path):
    """{what lives: judgement} of a table."""
    found, key = {}, None
    if os.path.exists(path):
        with open(path, encoding="utf-8") as f:
            for line in f:
                if line.startswith("src/"):
                    key = line.rstrip("\n")
                elif key and line.startswith("    "):
                    found[key] = line.strip()
                    key = None
    return found


def main():
    p = argparse.ArgumentParser()
    p.add_argument("--seed", type=int, default=1)
    p.add_argument("--count", type=int, default=300)
    p.add_argument("--only", default="")
    p.add_argument("--table", default=os.path.join(ROOT, "tests/hard/mutants.txt"))
    p.add_argument("--work", default="")
    p.add_argument("--factor", type=float, default=4)
    p.add_argument("--room", default="", help=argparse.SUPPRESS)
    options = p.parse_args()
    if options.room:
        run_room(options.room)
    work = os.path.abspath(options.work) if options.work else tempfile.mkdtemp(prefix="fret-mutants-")
    copy = Copy(work)
    copy.restore()
    all_, texts = [], {}
    for path in sorted(os.path.relpath(name, copy.good) for name in glob.glob(os.path.join(copy.good, "src/*/*.[ch]"))):
        if path not in LEFT_OUT:
            with open(os.path.join(copy.good, path), encoding="utf-8") as f:
                texts[path] = f.read()
            all_ += [(path, *place) for place in places(path, texts[path])]
    random.Random(options.seed).shuffle(all_)
    chooser = random.Random(options.seed)
    done, first = [], collections.defaultdict(list)
    if os.path.exists(copy.log):
        with open(copy.log, encoding="utf-8") as f:
            done = [json.loads(line) for line in f]
    known = {(one["path"], one["at"]): one for one in done}
    done = []
    for path, at, length, others in all_:
        other = chooser.choice(others)
        if not path.startswith("src/" + options.only):
            continue
        if sum(one["end"] in ("killed", "late", "lives") for one in done) >= options.count:
            break
        if (path, at) in known:
            one = known[path, at]
            if one["where"] in ROOMS[path.split("/")[1]].split():
                first[path].append(one["where"])
            done.append(one)
            continue
        start = time.time()
        end, where = attempt(copy, path, at, length, other, first, options.factor)
        line = texts[path].count("\n", 0, at) + 1
        one = {"path": path, "at": at, "line": line, "text": texts[path].splitlines()[line - 1].strip()[:90],
               "old": texts[path][at:at + length], "new": other, "end": end, "where": where}
        done.append(one)
        with open(copy.log, "a", encoding="utf-8") as f:
            f.write(json.dumps(one) + "\n")
        print("%5.1f s %-10s %-10s %s:%d `%s` -> `%s`" % (time.time() - start, end, where, path, line, one["old"], other),
              flush=True)
    judged = judgements(options.table)
    with open(options.table + ".part", "w", encoding="utf-8") as out:
        table(out, done, judged, options, "# make mutants MUTANTS=%d SEED=%d\n" % (options.count, options.seed))
    os.rename(options.table + ".part", options.table)
    if not options.work:
        shutil.rmtree(work)


if __name__ == "__main__":
    main()
