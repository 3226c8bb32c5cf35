# SPDX-License-Identifier: GPL-3.0-or-later
"""Casts: each line is JSON, and played again they show what the terminal showed; whatever ends the program."""
import json
import os
import re
import resource
import signal
import subprocess
import time


import harness
from live import Live
from screen import Screen

SCENE = "material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N"


class Cast:
    """Of a file: the header, the events, and the screen in the end."""

    def __init__(self, path, until=None):
        with open(path, encoding="utf-8", newline="") as f:
            text = f.read()
        self.whole = text.endswith("\n") and "\r" not in text
        lines = [json.loads(line) for line in text.split("\n")[:-1]]
        self.head, self.events = lines[0], lines[1:]
        self.screen = Screen(self.head["height"], self.head["width"])
        for time_of, kind, data in self.events:
            if until is not None and time_of > until:
                break
            if kind == "o":
                self.screen.feed(data)
            else:
                cols, rows = data.split("x")
                self.screen.resize(int(rows), int(cols))

    def sound(self):
        times = [event[0] for event in self.events]
        return self.whole and set(self.head) >= {"version", "width", "height"} and self.head["version"] == 2 and \
            times == sorted(times) and all(len(e) == 3 and e[1] in "or" and isinstance(e[2], str) for e in self.events)


def lines(screen):
    return [line for line in screen.text().split("\n") if line.strip()]


def scripted(tests):
    """From a script: typed at an even pace, the same in every run, whatever the clock says."""
    where = os.path.join(tests.dir, "casts")
    os.mkdir(where)
    script = "record %s\n# δ, \"quoted\" \\ and\n" + SCENE + "\na + \\\n1 um\nfoo\na; plot Fx against dx along cycle FA=20 N\nrecord off\ndz\n"
    texts = []
    for name in ("one.cast", "two.cast"):
        done = tests.run("--keep-going", input=script % name, cwd=where)
        with open(os.path.join(where, name), encoding="utf-8") as f:
            texts.append(f.read())
    tests.check("a script's cast is the same again", texts[0] == texts[1] and done.returncode == 1, tests.report(done))
    cast = Cast(os.path.join(where, "one.cast"))
    typed = "".join(e[2] for e in cast.events)
    tests.check("its lines are JSON", cast.sound() and cast.head["width"] == 80, texts[0][:400])
    tests.check("it types, and answers", all(part in typed for part in (
        "fret> # δ, \"quoted\" \\ and\r\n", "fret> a +  \\\r\n....> 1 um\r\n", "a + 1 um = 187.626 um\r\n", "error: unknown name",
        "fret> a; plot", "a = 186.626 um\r\n")) and "dz" not in typed, typed)
    ours = [line for line in done.stdout.split("\n") if line.strip()][:-1]
    tests.check("its screen ends as the output", lines(cast.screen)[:-1][-20:] == ours[-20:],
                "%s\n%s" % (cast.screen.text(), done.stdout))
    tests.check("what is typed takes time", cast.events[-1][0] > 0.04 * len(script) / 2, str(cast.events[-1]))
    done = tests.run("-c", "record one.cast; 1", cwd=where)
    tests.check("overwriting a cast is told", "overwriting one.cast" in done.stderr, tests.report(done))
    for name, says in (("/nonexistent/x.cast", "No such file"), ("casts/x.cast/", "directory"), ("/dev/full", "No space left")):
        done = tests.run("-c", "record %s; 1" % name)
        tests.check("no cast at " + name, done.returncode == 1 and "error: cannot write" in done.stderr and says in done.stderr,
                    tests.report(done))
    os.mkfifo(os.path.join(where, "pipe.cast"))
    done = tests.run("-c", "record pipe.cast; 1", cwd=where)
    tests.check("a pipe that nobody reads", done.returncode == 1 and "cannot write pipe.cast: " in done.stderr,
                tests.report(done))


def full(tests):
    """No room: told at once, what is there is whole lines, the session goes on."""
    for name in ("full.cast", "full.txt"):
        path = os.path.join(tests.dir, name)
        script = "record %s\n" % path + SCENE + "\n" + "a, dz\n" * 40 + "1234\n"
        done = subprocess.run([tests.fret], input=script, capture_output=True, text=True, env=tests.env, timeout=60,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000)))
        with open(path, encoding="utf-8") as f:
            kept = f.read()
        told = done.stderr.count("cannot write %s: File too large; what follows is not recorded" % path)
        tests.check("no room for " + name, done.returncode == 1 and told == 1 and done.stdout.endswith("1234\n") and
                    kept.endswith("\n") and 500 < len(kept) <= 1000, tests.report(done) + kept)
        if name.endswith(".cast"):
            tests.check("its lines are whole", Cast(path).sound(), kept)


def rough(tests):
    """Bytes that are no characters, characters of four bytes, lines that go on over nothing; and no room at any moment."""
    where = os.path.join(tests.dir, "rough")
    os.mkdir(where)
    tests.run(input=b"record r.cast\n# \xff \xe2 \x7f \xf0\x9f\x98\x80\n1 + 1 \\\n\n3\n", cwd=where)
    cast = Cast(os.path.join(where, "r.cast"))
    told = "".join(e[2] for e in cast.events)
    tests.check("bytes that are no characters", cast.sound() and "# \\xff \\xe2 \\x7f \U0001f600\r\n" in told, told)
    tests.check("a line that goes on over nothing", "fret> 1 + 1  \\\r\n....> \r\n1 + 1 = 2\r\nfret> 3" in told, told)
    hostile = "record r.cast\n# \x1b[2J \u202e \x9b \x07 \u200b\n1 + 1 # \x1b]0;x\x07\nrecord off\n"
    tests.run(input=hostile, cwd=where, env={"LC_ALL": "C.UTF-8"})
    told = "".join(e[2] for e in Cast(os.path.join(where, "r.cast")).events)
    tests.check("what a statement says commands no terminal", not re.search("[\x00-\x09\x0b\x0c\x0e-\x1f\x7f-\x9f\u200b-\u202e]", told) and
                "# \\x1b[2J \\u202e \\u009b \\x07 \\u200b\r\n" in told, repr(told))
    names = ["\U0001f600%s = %d" % ("\U0001f601" * (i % 7), i) for i in range(7)]
    for i in range(4):
        statements = names + ["# " + i * "a", "show variables\n" * 40]
        tests.run(input="record names.cast\n" + "\n".join(statements), cwd=where)
        cast = Cast(os.path.join(where, "names.cast"))
        told = "".join(e[2] for e in cast.events)
        tests.check("many signs of four bytes, %d" % i, cast.sound() and "\ufffd" not in told and told.count("\U0001f600" + 6 * "\U0001f601") == 41, told[-300:])
    done = tests.run(input="record r\n" + "1 + 1 # %s\n1%s\n" % ("x" * 1500, "+1" * 60), cwd=where)
    with open(os.path.join(where, "r"), encoding="ascii") as f:
        text = f.read()
    again = tests.run("--replay", "r", cwd=where)
    tests.check("a transcript of a short name, of long lines", text.startswith("fret> 1 + 1 # %s\n1 + 1 = 2\n" % ("x" * 1500)) and again.returncode == 0,
                text + tests.report(done))
    tool = os.path.join(os.path.abspath(tests.build), "tests", "calls")
    if tests.sanitized or not os.path.exists(tool) or subprocess.run(
            [tool, os.devnull, "none", "0", "0", "/bin/true"], check=False, stderr=subprocess.DEVNULL).returncode:
        return
    for name in ("arm", "disarm"):
        with open(os.path.join(where, name), "w", encoding="ascii"):
            pass
    script = "record full.%s\nsource arm\n1 + 1\nsource disarm\nrecord off\n2\n"
    for ending, before, says in (("cast", 0, "what follows is not recorded"), ("txt", 0, "what follows is not recorded"), ("cast", 1, "cannot write full.cast")):
        given, wrong, count, harmless = script % ending, [], 0, set()
        if before:
            given = "source arm\nrecord full.cast\n1 + 1\nrecord off\n2\n"
        elif ending == "cast":
            given = given.replace("source disarm\n", "")
        whole = None
        while whole is None and count < 200:
            count += 1
            path = os.path.join(where, "told")
            done = subprocess.run([tool, path, "write", str(count), "28", tests.fret, "--keep-going"], input=given, capture_output=True, text=True, cwd=where,
                                  env=tests.env, check=False)
            with open(os.path.join(where, "full." + ending), encoding="utf-8") as f:
                text = f.read()
            with open(path, encoding="ascii") as f:
                whole = text if "FAILED" not in f.read() else None
            lost, silent, none = done.stderr.count(says), "cannot write to standard output" in done.stderr, done.returncode == 0
            if none:
                harmless.add(text)
            elif lost + silent < 1 or lost > 1 or not (text.endswith("\n") or not text) or (done.stdout != "1 + 1 = 2\n2 = 2\n" and not silent) or \
                    (ending == "cast" and text and not Cast(os.path.join(where, "full.cast")).sound()):
                wrong.append("%d: %s" % (count, tests.report(done) + text[-200:]))
        tests.check("no room for a .%s, %d" % (ending, before), (12 if ending == "cast" else 2) < count < 200 and not wrong and harmless == {whole}, "%d\n%s" % (count, "\n".join(wrong[:3])))


def unmade(tests):
    """A film of a script: where there is no memory for a part of it, it says so, and is not another film; where there is no screen,
    the message stands at the statement."""
    where = os.path.join(tests.dir, "unmade")
    os.mkdir(where)
    for name, text in (("arm", ""), ("disarm", ""), ("s.fret", "step Fx=20 N\n")):
        with open(os.path.join(where, name), "w", encoding="ascii") as f:
            f.write(text)
    script = SCENE + "\nrecord s.cast\nsource arm\nlive s.fret\nsource disarm\nrecord off\nFx\n"
    shim, tool = (os.path.join(os.path.abspath(tests.build), "tests", name) for name in ("faults.so", "calls"))
    if tests.sanitized or not os.path.exists(shim):
        return

    def filmed(number):
        here = os.path.join(where, str(number))
        os.mkdir(here)
        for name in ("arm", "disarm", "s.fret"):
            os.link(os.path.join(where, name), os.path.join(here, name))
        done = tests.run("--keep-going", "-c", script, cwd=here, env={"LD_PRELOAD": shim, "FAULT": str(number), "FRET_FAULTS": "1",
                                                                     "FAULT_COUNT": os.path.join(here, "count")})
        with open(os.path.join(here, "s.cast"), encoding="utf-8") as f:
            return done, "".join(json.loads(line)[2] for line in f.read().split("\n")[1:-1])
    right, whole = filmed(0)
    with open(os.path.join(where, "0", "count"), encoding="ascii") as f:
        count = int(f.read())
    results = []
    tests.each([lambda n=n: results.append((n, *filmed(n))) for n in range(1, count + 1)])
    wrong = ["%d: %s%s" % (n, tests.report(done), text[-300:]) for n, done, text in results
             if done.returncode not in (0, 1) or not re.search("memory|no screen", done.stderr + text) and (text != whole or done.stdout != right.stdout)]
    tests.check("a film without memory for all of it", right.returncode == 0 and right.stdout.endswith("Fx = 20 N\n") and count > 50 and not wrong,
                "%d of %d\n%s" % (len(wrong), count, "\n".join(wrong[:3])))
    if not os.path.exists(tool) or subprocess.run([tool, os.devnull, "none", "0", "0", "/bin/true"], check=False, stderr=subprocess.DEVNULL).returncode:
        return
    told = []
    for number in range(1, 9):
        done = subprocess.run([tool, os.path.join(where, "told"), "openat", str(number), "24", tests.fret, "-c", script], cwd=where, env=tests.env,
                              capture_output=True, text=True, check=False)
        told += re.findall(r"(.*): error: no screen can be had to record\n  (.*)\n  (.*)", done.stderr)
    tests.check("no screen for a film", told and set(told) == {("-c:4:1", "live s.fret", "^~~~~~~~~~~")}, str(told))


class Recorded(Live):
    def __init__(self, tests, name, *args, **more):
        super().__init__(tests, command=[tests.fret, "--no-rc", "--quiet", *args], **more)
        self.tests, self.path = tests, os.path.join(tests.dir, name)
        self.wait("fret>")

    def line(self, text, what=None):
        """Typed at the prompt; until what comes, and the next prompt."""
        self.child.send(text + "\r")
        came = self.wait(lambda s: (not what or re.search(what, s.text())) and
                         re.search(r"fret> *$", s.text().rstrip("\n") + " "))
        self.tests.check("what is typed is answered: " + text.partition(" /")[0][:40], came, self.screen.text())


def typed(tests):
    """A session at the prompt: its screen, edited lines, colours, a lesson by keys, a change of size."""
    s = Recorded(tests, "typed.cast", "--color=always", size=(40, 80))
    s.line("set pager off")
    began = time.monotonic()
    s.line("record " + s.path)
    s.line(SCENE + "\x01\x05", "a = 186")
    s.line("cycle FA=20 N", "dW = ")
    s.line("a, c/a, \"", "error")
    s.child.send("geom\tpara\t")
    s.wait("geometry paraboloid")
    s.child.send("\x03")
    s.line("# µ δ", "δ")
    s.line("plot loop", "δx|dx \\[")
    s.child.send("demo pressing\r")
    s.wait("q: leave")
    s.key(" ", "Eight times")
    s.key("b", "back")
    s.wait("q: leave")
    s.child.send("q")
    s.line("undo")
    s.line("1234", "1234 = 1234")
    s.screen.resize(30, 100)
    s.child.setwinsize(30, 100)
    s.line("\x0ca", "a = 186.626 um")
    s.line("#" + "µ" * 3000 + "\x01", "µ" * 80)
    s.line("4321", "4321 = 4321")
    cast = Cast(s.path)
    shown, replayed, elapsed = lines(s.screen), lines(cast.screen), time.monotonic() - began
    tests.check("its times are within those of the session", 0 <= cast.events[0][0] < cast.events[-1][0] <= elapsed,
                "%s %s %g" % (cast.events[0], cast.events[-1], elapsed))
    tests.check("a session's cast is sound", cast.sound() and cast.head == {"version": 2, "width": 80, "height": 40},
                str(cast.head))
    tests.check("it shows what the terminal shows", shown[-28:] == replayed[-28:], "%s\n\n%s" % (s.screen.text(), cast.screen.text()))
    tests.check("it knows of the size", [e[2] for e in cast.events if e[1] == "r"] == ["100x30"],
                str([e for e in cast.events if e[1] == "r"]))
    told = "".join(e[2] for e in cast.events)
    tests.check("it has all that was written", told.count("µ") == 3001 and "\ufffd" not in told and
                "\x1b[1;31merror:\x1b[0m " in told and "geometry paraboloid" in told, told[-300:])
    s.line("record off", "record off")
    before = os.path.getsize(s.path)
    s.line("8765", "8765 = 8765")
    tests.check("off ends it", os.path.getsize(s.path) == before and Cast(s.path).sound())
    s.child.send("\x04")
    tests.check("and the session goes on", s.gone() == 0)


def screens(tests):
    """The full-screen mode in a cast, as it shows; by the prompt before, or from within."""
    for within, env in ((False, {}), (True, {}), (False, {"LC_ALL": "C", "TERM": "vt100"})):
        s = Recorded(tests, "screens.cast", **env)
        if not within:
            s.line("record " + s.path)
        s.child.send("live\r")
        s.wait(r"a +186\.626 um")
        if within:
            s.says("record " + s.path)
            s.wait("record |overwriting ")
        s.key("ll", r"Fx +4 N")
        s.key("]]] ", "> cycle")
        s.key("  ", lambda screen: "> cycle" not in screen.row(0))
        s.child.send(":compare k")
        s.wait(":compare k")
        time.sleep(0.1)
        s.read()
        cast = Cast(s.path)
        tests.check("the screen in a cast, %s, %s" % (within, env), cast.sound() and lines(cast.screen) == lines(s.screen) and
                    cast.screen.modes.get(1049) and cast.screen.modes.get(25), "%s\n%s" % (s.screen.text(), cast.screen.text()))
        s.screen.resize(30, 90)
        s.child.setwinsize(30, 90)
        s.key("\x1b", lambda screen: screen.row(29) and "compare" not in screen.row(29))
        time.sleep(0.1)
        s.read()
        cast = Cast(s.path)
        tests.check("another size in a cast", lines(cast.screen) == lines(s.screen), "%s\n%s" % (s.screen.text(), cast.screen.text()))
        s.child.send("q")
        s.wait(lambda screen: not screen.modes.get(1049))
        s.line("dz", "dz = 3.48291 um")
        s.line("record off")
        cast = Cast(s.path)
        tests.check("and the prompt again", cast.sound() and not cast.screen.modes.get(1049) and
                    "dz = 3.48291 um" in cast.screen.text(), cast.screen.text())
        s.child.send("\x04")
        tests.check("left", s.gone() == 0)


def ended(tests):
    """Signals, and a crash: what is there is whole."""
    for number in (signal.SIGTERM, signal.SIGHUP, signal.SIGKILL, signal.SIGSEGV):
        s = Recorded(tests, "ended-%d.cast" % number, ASAN_OPTIONS=tests.env["ASAN_OPTIONS"] + ":handle_segv=0")
        s.line("record " + s.path)
        s.child.send("live\r")
        s.wait(r"a +186\.626 um")
        s.key("]]] ", "> cycle")
        os.kill(s.child.pid, number)
        s.gone()
        cast = Cast(s.path)
        tests.check("a cast after " + number.name, cast.sound() and "186.626 um" in cast.screen.text(), cast.screen.text())


def played(tests):
    """A script in the full-screen mode, played where no terminal is."""
    where = os.path.join(tests.dir, "played")
    os.mkdir(where)
    with open(os.path.join(where, "s.fret"), "w", encoding="utf-8") as f:
        f.write("# What will slip: \u07ff \u0800 \uffe6 \U00010000?\n" + SCENE + "\nstep Fx=20 N\n# The loop\ncycle FA=30 N\nstep Fx=50 N\n# The end\n")
    texts = []
    for name in ("a.cast", "b.cast"):
        done = tests.run("-c", "record %s\nlive s.fret\ndW\n" % name, cwd=where, env={**tests.env, "LC_ALL": "C.UTF-8"})
        with open(os.path.join(where, name), encoding="utf-8") as f:
            texts.append(f.read())
    tests.check("it plays", done.returncode == 0 and done.stdout == "dW = 9.01533 uJ\n", tests.report(done))
    tests.check("the same again", texts[0] == texts[1])
    tests.check("signs of two, three and four bytes", any("slip: \u07ff \u0800 \uffe6 \U00010000?" in e[2] for e in Cast(os.path.join(where, "a.cast")).events), texts[0][:2000])
    cast = Cast(os.path.join(where, "a.cast"))
    moving = {found for e in cast.events[3:60:4]
              for found in re.findall(r"Fx +(-?[0-9]\S* \S+)", Cast(os.path.join(where, "a.cast"), e[0]).screen.text())}
    tests.check("what moves is seen to", cast.sound() and len(moving) > 8, str(moving))
    tests.check("what is refused is told", any("exceeds mu" in e[2] for e in cast.events))
    done = tests.run("-c", "record a.cast\nlive\n", cwd=where)
    tests.check("without a script it needs a terminal", "needs a terminal" in done.stderr, tests.report(done))


def kept(tests):
    """Those of README are what `make figures` makes."""
    where = os.path.join(harness.ROOT, "scripts", "casts")
    for name in ("tour", "live"):
        path = os.path.join(where, name + ".cast")
        cast = Cast(path)
        tests.check(name + ".cast is sound", cast.sound() and cast.head["width"] == 80 and 20 < cast.events[-1][0] < 120,
                    str(cast.events[-1]))
        again = os.path.join(tests.dir, name + "-again.cast")
        with open(os.path.join(where, name + ".fret"), encoding="utf-8") as f:
            done = tests.run(input="record %s\n%s" % (again, f.read()), cwd=harness.ROOT, env={**tests.env, "LC_ALL": "C.UTF-8"})
        with open(path, encoding="utf-8") as one, open(again, encoding="utf-8") as two:
            tests.check(name + ".cast comes out again", one.read() == two.read(), tests.report(done))


def run(tests):
    tests.rooms(scripted, full, rough, unmade, typed, screens, ended, played, kept)
