# SPDX-License-Identifier: GPL-3.0-or-later
"""Mutation testing: changes one token of src/ at a time, builds the program in a copy of the tree, and runs the parts of rooms of
tests that enter the changed function, the most promising for their cost first, until one fails. Which functions each part
enters is recorded once.

    python3 tests/fuzz/mutants.py [--seed 1] [--count 300] [--only DIRECTORY] [--table FILE] [--work FOLDER] [--jobs N]
                                  [--budget SECONDS]

The table lists the mutants that no test noticed, each with its judgement from the table before: write it there by hand, and run
again. `--work` keeps the copies, the record and the log, so that an interrupted run can go on. With a budget (processor
seconds), the parts beyond it are run after all other mutants have been tried."""
import argparse
import collections
import concurrent.futures
import glob
import json
import math
import os
import random
import re
import resource
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
OPT = "OPT=-O1 -fno-tree-slp-vectorize"
LEFT_OUT = ("src/live/none.c", "src/prompt/prompt_plain.c", "src/commands/study_none.c", "src/number/constants.h")
# for each room of the sources, the rooms of tests most likely to notice
NUMBERS, SAID = "unit sessions reference numbers hard accuracy", "sessions errors scripts help keeping trouble interactive completion"
ROOMS = {"number": NUMBERS, "law": NUMBERS, "history": NUMBERS, "field": NUMBERS + " rim", "wear": NUMBERS, "arrays": "unit numbers",
         "text": "unit reading forms sessions errors keeping looks", "measured": "unit fits forms smoothing sessions",
         "scene": "unit sessions errors reference numbers explaining instants backwards",
         "language": "unit sessions errors scripts reading help keeping looks backwards fits smoothing numbers",
         "statement": SAID + " unit answers looks figures", "commands": SAID + " answers looks figures fits backwards accuracy forms following",
         "study": "fits backwards accuracy sessions errors sharing smoothing", "plot": "unit figures looks sessions paper",
         "help": "help explaining completion errors", "prompt": SAID + " readme", "live": "live unit interactive"}
ALL = ("unit sessions errors help readme reference numbers scripts reading keeping looks figures paper completion backwards fits "
       "smoothing sharing shares accuracy explaining instants answers following forms moving trouble rim interactive live hard").split()
COUNTED = ("killed", "late", "lives", "so far")  # outcomes that count; the other mutants change no code

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
    """The numbers that replace a number."""
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
    """[(offset, length, replacements)] of the tokens that may be changed."""
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


# a part of a room: the room's name, and the number of one of the jobs that it runs side by side
Part = collections.namedtuple("Part", "room number")
CHEAP = 20  # processor seconds that less related rooms may use for a mutant
WHOLE, BESIDES = -1, -2  # in place of the number of a job: all of the room; what it does besides its jobs


class Tree:
    """A copy of the tree in which mutants are built, and an unchanged one beside it."""

    def __init__(self, top, good=None):
        self.top, self.good = top, good

    def load(self):
        """Imports the tests of this tree, for this process and its children."""
        sys.path[:0] = [os.path.join(self.top, "tests")]
        import runner  # noqa: F401

    def make(self, *targets):
        """Builds; None, or the error."""
        done = subprocess.run(["make", "--no-print-directory", "-s", *(() if any("OPT=" in t for t in targets) else (OPT,)),
                               "WARN=-w", *targets], cwd=self.top, capture_output=True, text=True, errors="replace")
        return None if done.returncode == 0 else done.stderr

    def differing(self):
        """[(unchanged file, file now)] of the files that have been built since."""
        for folder, _, names in os.walk(self.good):
            for name in names:
                good = os.path.join(folder, name)
                now = os.path.join(self.top, os.path.relpath(good, self.good))
                if not os.path.islink(good) and (not os.path.exists(now) or
                                                 os.stat(good).st_mtime_ns != os.stat(now).st_mtime_ns):
                    yield good, now

    def restore(self):
        for good, now in self.differing():
            if os.path.exists(now):
                os.unlink(now)  # it may be running
            shutil.copy2(good, now)

    def changed(self):
        """Does an object file differ? If none does, the mutant changes no code."""
        return any(now.endswith(".o") and open(good, "rb").read() != open(now, "rb").read()
                   for good, now in self.differing())

    def run(self, room, numbers, cpu, wall):
        """Runs parts of a room in a process of their own: (what it wrote last, seconds, processor seconds)"""
        reads, writes = os.pipe()
        start, pid = time.time(), os.fork()
        if pid == 0:
            os.setsid()
            os.close(reads)
            os.chdir(self.top)
            if cpu:
                resource.setrlimit(resource.RLIMIT_CPU, (math.ceil(cpu), math.ceil(cpu) + 5))
            run_parts(room, numbers, writes)
        os.close(writes)
        ended, said = select.select([reads], [], [], wall)[0], b""
        if ended:
            said = os.read(reads, 100)
        try:
            os.killpg(pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        for name in filter(str.isdigit, os.listdir("/proc")):  # processes that have left the group
            try:
                if os.readlink("/proc/%s/exe" % name).startswith(self.top + "/build/"):
                    os.kill(int(name), signal.SIGKILL)
            except OSError:
                pass
        usage = os.wait4(pid, 0)[2]
        os.close(reads)
        return said.decode() if ended else "late", time.time() - start, usage.ru_utime + usage.ru_stime


def run_parts(room, numbers, pipe):
    """Runs parts in this process, which ends at the first failure and writes which part failed; if all pass, how many there are."""
    import harness
    import runner

    class Some(harness.Tests):
        count, inside, at, once = 0, False, threading.local(), threading.Lock()

        def record(self, name, ok, *how, **known):
            if not ok:
                self.end("%s %d" % ("late" if too_long() else "failed", getattr(self.at, "number", min(numbers))))
            return super().record(name, ok, *how, **known)

        def end(self, what):
            self.once.acquire()  # other threads may fail at the same time
            shutil.rmtree(self.top, ignore_errors=True)
            os.write(pipe, what.encode())
            os._exit(0)

        def each(self, jobs):
            jobs = list(jobs)
            if self.inside:
                return super().each(jobs)
            first, self.count, self.inside = self.count, self.count + len(jobs), True
            super().each([lambda n=n, job=job: self.one(n, job) for n, job in enumerate(jobs, first) if n in numbers or WHOLE in numbers])
            self.inside = False
            return None

        def one(self, number, job):
            self.at.number = number
            job()

    def too_long():
        used, limit = resource.getrusage(resource.RUSAGE_CHILDREN), resource.getrlimit(resource.RLIMIT_CPU)[0]
        return limit > 0 and used.ru_utime + used.ru_stime > limit
    null = os.open(os.devnull, os.O_RDWR)
    for fd in (0, 1, 2):
        os.dup2(null, fd)
    tests = Some("build", "mutant", False)
    try:
        runner.ROOMS[room](tests)
    except BaseException:
        tests.check("it breaks off", False)
    tests.end(str(tests.count))


def functions(text):
    """[(first line, last line)] of the functions of a source."""
    found, first = [], 0
    for n, line in enumerate(text.splitlines(), 1):
        if re.match(r"[A-Za-z_](?!\w*:$)", line):
            first = n
        elif line == "}":
            found.append((first, n))
    return found


class Reach:
    """A record of what each part of a room costs, and which functions it enters."""

    def __init__(self, work, names):
        self.file, self.parts, self.lines = os.path.join(work, "reach"), {}, {}
        pid = os.fork()  # a process of its own, to load the tests of this tree
        if pid == 0:
            os._exit(self.record(work, names))
        if os.waitpid(pid, 0)[1]:
            sys.exit("mutants: nothing was recorded")
        for part, known in self.recorded():
            self.parts[part] = known
            if known[2] is not None:
                self.lines[part] = lines = collections.defaultdict(list)
                for name in known[2]:
                    path, _, line = name.partition(":")
                    if line.isdigit():
                        lines[path].append(int(line))

    def recorded(self):
        if os.path.exists(self.file):
            with open(self.file, encoding="utf-8") as f:
                for line in f:
                    for room, number, *known in json.loads(line):
                        yield Part(room, number), known

    def record(self, work, names):
        rooms = {part.room for part, _ in self.recorded()}
        top, marks = os.path.join(work, "recording"), os.path.join(work, "marks")
        tree = Tree(top)
        if not os.path.exists(os.path.join(top, "build/fret")):
            for folder in (top, marks):
                shutil.rmtree(folder, ignore_errors=True)
            copy_sources(names, top)
            os.makedirs(marks)
            subprocess.run(["cc", "-O1", "-DFOLDER=\"%s\"" % marks, "-c", "tests/fuzz/reach.c", "-o", "reach.o"], cwd=top, check=True)
            wrong = tree.make("OPT=-O1 -fno-tree-slp-vectorize -g -finstrument-functions "
                              "-finstrument-functions-exclude-file-list=.h,tests/", "LDFLAGS=-no-pie reach.o", "build/fret", "tests")
            if wrong:
                print("mutants: the recording build fails: " + wrong)
                return 1
        tree.load()
        for room in ALL:
            if room in rooms:
                continue
            count, _, cpu, _ = self.measured(tree, marks, room, BESIDES)
            if count and cpu < 5:
                rows = [[room, n, *self.measured(tree, marks, room, n)[1:]] for n in range(count)]
            else:
                rows = [[room, WHOLE, *self.measured(tree, marks, room, WHOLE)[1:]]]
            for row in rows:
                print("%-12s %4d %8.2f s %8.2f s %s" % (*row[:4], "fails" if row[4] is None else len(row[4])), flush=True)
            with open(self.file, "a", encoding="utf-8") as f:
                f.write(json.dumps(rows) + "\n")
        return 0

    def measured(self, tree, marks, room, number):
        """Measures a part: (parts of the room, seconds, processor seconds, functions entered or None)"""
        for name in os.listdir(marks):
            os.unlink(os.path.join(marks, name))
        said, wall, cpu = tree.run(room, (number,), 0, 600)
        return int(said) if said.isdigit() else 0, wall, cpu, self.entered(tree, marks) if said.isdigit() else None

    def least(self, room):
        """The least time of any part of a room: what the room does besides its jobs."""
        return tuple(min(known[i] for part, known in self.parts.items() if part.room == room) for i in (1, 0))

    known = {}

    def entered(self, tree, marks):
        """[FILE:LINE] of the functions entered, and the test programs that ran."""
        found = set()
        for name in os.listdir(marks):
            path = next(p for p in (os.path.join(tree.top, "build", *way, name) for way in ((), ("tests",), ("tests", "hard")))
                        if os.path.isfile(p))
            if path not in self.known:
                symbols = subprocess.run(["nm", path], capture_output=True, text=True, check=True).stdout
                start = int(re.search(r"^(\w+) \w __executable_start$", symbols, re.M).group(1), 16)
                wanted = [int(m.group(1), 16) for m in re.finditer(r"^(\w+) [tTwWi] ", symbols, re.M)]
                lines = subprocess.run(["addr2line", "-e", path], input="\n".join(map(hex, wanted)), capture_output=True,
                                       text=True, check=True).stdout.split("\n")
                self.known[path] = {address - start: re.sub(r"^.*?/(src/[^ ]*).*|.*", r"\1", line)
                                    for address, line in zip(wanted, lines)}
            with open(os.path.join(marks, name), "rb") as f:
                found.update(self.known[path].get(mark.start(), "") for mark in re.finditer(b"\1", f.read()))
            if name != "fret":
                found.add(os.path.relpath(path, tree.top))
        return sorted(found - {""})

    def order(self, path, line, first, last, kills):
        """The parts that enter a function (all, if the line is in no function), the most promising for their cost first."""
        directory = path.split("/")[1]
        stem = os.path.basename(path).rpartition(".")[0]
        near = [stem, stem.partition("_")[0], {"table": "shape", "law": "normal", "zone": "diagram"}.get(stem, directory)]
        found = []
        for part, (_, cpu, entered) in self.parts.items():
            if entered is not None and last and not any(first <= n <= last for n in self.lines[part].get(path, ())):
                continue
            hope = 0.05 + (part.room in ROOMS[directory]) + kills[directory, part] + 5 * kills[path, part]
            if entered and any("build/tests/test_" + name in entered for name in near):
                hope += 5
            found.append((hope / (cpu + 0.05), part))
        return [part for _, part in sorted(found, reverse=True)]


def copy_sources(names, top):
    for name in names:
        os.makedirs(os.path.dirname(os.path.join(top, name)), exist_ok=True)
        shutil.copy2(os.path.join(ROOT, name), os.path.join(top, name), follow_symlinks=False)


tree = None  # of this process


def begin(work, reach):
    """Starts a worker process, which builds mutants in a tree of its own."""
    global tree
    good = os.path.join(work, "good")
    for n in range(1000):
        try:
            os.mkdir(os.path.join(work, "taken-%d" % n))
            break
        except FileExistsError:
            pass
    top = os.path.join(work, "tree-%d" % n)
    if not os.path.exists(top):
        shutil.copytree(good, top, symlinks=True)
    tree = Tree(top, good)
    tree.load()
    tree.reach = reach
    tree.restore()


def together(parts, reach):
    """The first of the parts and others of its room that can be run with it at little extra time; their processor seconds and
    seconds."""
    room, group = parts[0].room, []
    cpu, wall = least = reach.least(room)
    for part in parts:
        more = [max(0, known - all_) for known, all_ in zip(reach.parts[part][1::-1], least)]
        if part.room == room and (not group or cpu + more[0] + 0.02 < least[0] + 1.5):
            group.append(part)
            cpu, wall = cpu + more[0] + 0.02, wall + more[1]
    return group, cpu, wall


def attempt(path, at, length, other, parts, budget):
    """Tries one mutant: (outcome, where it was noticed, parts not run for lack of time)"""
    name = os.path.join(tree.top, path)
    with open(name, encoding="utf-8") as f:
        text = f.read()
    with open(name, "w", encoding="utf-8") as f:
        f.write(text[:at] + other + text[at + length:])
    try:
        if tree.make("build/fret"):
            return "no program", "", []
        if not tree.changed():
            return "same code", "", []
        spent, known, parts = 0, tree.reach.parts, list(parts)
        while parts:
            group, cpu, wall = together(parts, tree.reach)
            if spent + cpu > CHEAP and group[0].room not in ROOMS[path.split("/")[1]].split():
                parts = [part for part in parts if part not in group]
                continue
            if budget and spent + cpu > budget:
                return "so far", "", parts
            spent += cpu
            parts = [part for part in parts if part not in group]
            room, numbers = group[0].room, [part.number for part in group]
            programs = {name for part in group for name in known[part][2] or ("tests",) if re.match("build/tests/|tests$", name)}
            if programs and tree.make(*programs):
                return "killed", "build", []
            said = tree.run(room, numbers, 20 + 10 * cpu, 120 + 20 * wall)[0]
            if not said.isdigit():
                end, _, number = said.partition(" ")
                return "late" if end == "late" else "killed", "%s %s" % (room, number or numbers[0]), []
        return "lives", "", []
    finally:
        tree.restore()


# words that a judgement begins with
ALIKE, SINCE = ("equivalent", "speed only"), "killed since"


def table(out, done, judged, options):
    """Writes the table: counts by room, and each mutant that lives with its judgement."""
    def kind(one):
        judgement = judged.get(key_of(one), "")
        if one["end"] != "lives":
            return one["end"]
        return "alike" if judgement.startswith(ALIKE) else "since" if judgement.startswith(SINCE) else "lives"
    rows = collections.defaultdict(collections.Counter)
    for one in done:
        for room in (one["path"].split("/")[1], "~"):
            rows[room][kind(one)] += 1
    tree = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, capture_output=True, text=True).stdout.strip()
    out.write("# make mutants MUTANTS=%d SEED=%d, of the tree %s\n" % (options.count, options.seed, tree))
    out.write("# Tokens of src/ changed one at a time, of %d at random those that changed the code of some object file.\n"
              "# Killed: a test fails, or (late) takes ten times as long. Since: killed by a test that was written when it was\n"
              "# seen to live. Alike: judged to be equivalent, or to change the speed only. %%: killed, of those that are not alike.\n"
              % len(done))
    out.write("%-10s %7s %6s %5s %6s %6s %6s %8s\n" % ("room", "mutants", "killed", "late", "since", "lives", "alike", "killed %"))
    for room in sorted(rows):
        r = [rows[room][name] for name in ("killed", "late", "since", "lives", "alike")]
        out.write("%-10s %7d %6d %5d %6d %6d %6d %8.1f\n" % ("all" if room == "~" else room, sum(r), *r,
                                                           100.0 * sum(r[:3]) / max(sum(r[:4]), 1)))
    out.write("\nWhat no test noticed then, and why (equivalent, speed only, beyond the tests, hole), or what kills it since:\n")
    for one in done:
        if one["end"] == "lives":
            key = key_of(one)
            out.write("%s\n    %s\n" % (key, judged.get(key, "not judged")))


def key_of(one):
    return "%s: %s: `%s` -> `%s`" % (one["path"], one["text"], one["old"], one["new"])


def judgements(path):
    """{mutant that lives: judgement} of an existing table."""
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
    p.add_argument("--budget", type=float, default=0)
    p.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    options = p.parse_args()
    work = os.path.abspath(options.work) if options.work else tempfile.mkdtemp(prefix="fret-mutants-")
    names = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split("\n")[:-1]
    os.makedirs(work, exist_ok=True)
    for name in glob.glob(os.path.join(work, "taken-*")):
        os.rmdir(name)
    good = os.path.join(work, "good")
    if not os.path.exists(good):
        shutil.rmtree(good + ".part", ignore_errors=True)
        copy_sources(names, good + ".part")
        if Tree(good + ".part").make("build/fret", "tests"):
            sys.exit("mutants: the program itself does not build")
        os.rename(good + ".part", good)
    reach = Reach(work, names)
    all_, texts, chooser = [], {}, random.Random(options.seed)
    for path in sorted(os.path.relpath(name, good) for name in glob.glob(os.path.join(good, "src/*/*.[ch]"))):
        if path not in LEFT_OUT:
            with open(os.path.join(good, path), encoding="utf-8") as f:
                texts[path] = f.read()
            all_ += [(path, *place) for place in places(path, texts[path])]
    random.Random(options.seed).shuffle(all_)
    all_ = [(path, at, length, chooser.choice(others)) for path, at, length, others in all_]
    all_ = [one for one in all_ if one[0].startswith("src/" + options.only)]
    log, ends, kills = os.path.join(work, "log"), {}, collections.Counter()

    def note(one):
        ends[one["path"], one["at"]] = one
        room, _, number = one["where"].partition(" ")
        if number:
            part = Part(room, int(number))
            kills[one["path"].split("/")[1], part] += 1
            kills[one["path"], part] += 1
    if os.path.exists(log):
        with open(log, encoding="utf-8") as f:
            for line in f:
                note(json.loads(line))

    def done():
        """The mutants tried so far, up to the first gap and the number wanted."""
        found, count = [], 0
        for path, at, *_ in all_:
            one = ends.get((path, at))
            if one is None or count == options.count:
                break
            found.append(one)
            count += one["end"] in COUNTED
        return found

    def start(pool, path, at, length, other):
        line = texts[path].count("\n", 0, at) + 1
        span = next((span for span in functions(texts[path]) if span[0] <= line <= span[1]), (0, 0))
        if path.endswith(".h"):
            span = (0, 0)
        before = ends.get((path, at))
        parts = [Part(*part) for part in before["left"]] if before else reach.order(path, line, *span, kills)
        one = {"path": path, "at": at, "line": line, "text": texts[path].splitlines()[line - 1].strip()[:90],
               "old": texts[path][at:at + length], "new": other}
        return pool.submit(attempt, path, at, length, other, parts, 0 if before else options.budget), one, time.time()

    with concurrent.futures.ProcessPoolExecutor(options.jobs, initializer=begin, initargs=(work, reach)) as pool:
        running = []

        def step(most):
            """Waits until at most `most` workers are busy."""
            while len(running) > most:
                concurrent.futures.wait([r[0] for r in running], return_when=concurrent.futures.FIRST_COMPLETED)
                for r in [r for r in running if r[0].done()]:
                    running.remove(r)
                    future, one, began = r
                    one["end"], one["where"], one["left"] = future.result()
                    note(one)
                    with open(log, "a", encoding="utf-8") as f:
                        f.write(json.dumps(one) + "\n")
                    print("%5.1f s %-10s %-14s %s:%d `%s` -> `%s`  # %s" % (time.time() - began, one["end"], one["where"], one["path"],
                                                                 one["line"], one["old"], one["new"], one["text"]), flush=True)
        for place in all_:
            if sum(one["end"] in COUNTED for one in done()) >= options.count:
                break
            if place[:2] not in ends:
                running.append(start(pool, *place))
                step(options.jobs - 1)
        step(0)
        tried = {(one["path"], one["at"]) for one in done()}
        for place in all_:
            if place[:2] in tried and ends[place[:2]]["end"] == "so far":
                running.append(start(pool, *place))
                step(options.jobs - 1)
        step(0)
    judged = judgements(options.table)
    with open(options.table + ".part", "w", encoding="utf-8") as out:
        table(out, done(), judged, options)
    os.rename(options.table + ".part", options.table)
    if not options.work:
        shutil.rmtree(work)


if __name__ == "__main__":
    main()
