# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests the prompt on a terminal of its own: editing, history, pastes, Ctrl-C, Ctrl-Z, lessons, figures, the pager."""
import io
import os
import re
import shutil
import signal
import stat
import time

import pexpect

from live import child_of
from screen import Screen

PROMPT = r"fret> "
SCENE = "material steel; geometry sphere R=10 mm; friction 0.4"


class Session:
    """A session at the prompt. before: a command, with arguments, that starts the program."""

    def __init__(self, tests, *args, cwd=None, dimensions=(30, 100), before=(), **env):
        self.tests = tests
        self.state = env.get("XDG_STATE_HOME") or os.path.join(tests.dir, "state-%d" % time.monotonic_ns())
        env = {**tests.env, "TERM": "xterm", "INPUTRC": "/dev/null", "XDG_STATE_HOME": self.state,
               "XDG_CONFIG_HOME": os.path.join(tests.dir, "no-config"), **env}
        env = {name: value for name, value in env.items() if value is not None}
        program, *args = [*before, tests.fret, *args]
        self.child = pexpect.spawn(program, args, env=env, encoding="utf-8", timeout=120,
                                   cwd=cwd or tests.dir, dimensions=dimensions, codec_errors="replace")
        self.child.delaybeforesend = 0.02
        self.banner = self.prompt()

    def prompt(self):
        """Waits for the next prompt; returns the output before it."""
        self.child.expect(PROMPT)
        return clean(self.child.before)

    def say(self, line):
        """Types a line; returns the answer."""
        self.child.sendline(line)
        return self.prompt().partition("\n")[2].strip()

    def end(self):
        self.child.expect(pexpect.EOF)
        self.child.wait()
        self.child.close()
        return self.child.exitstatus


def clean(text):
    return re.sub(r"\x1b\[[?0-9;]*[a-zA-Z]", "", text).replace("\r", "")


def dialogue(tests):
    s = Session(tests)
    tests.check("banner", "help" in s.banner and len(s.banner.strip().splitlines()) <= 3, s.banner)
    tests.check("an answer", s.say("1 + 1") == "1 + 1 = 2")
    tests.check("an assignment says nothing", s.say("x = 3 mm") == "")
    tests.check("variables stay", s.say("x") == "x = 3 mm")
    tests.check("an error has no place", s.say("foo").endswith("error: unknown name 'foo'"))
    tests.check("and the session goes on", s.say("x") == "x = 3 mm")
    s.child.sendline("1 + \\")
    s.child.expect(r"\.\.\.\.> ")
    tests.check("a continued line", s.say("2").splitlines()[-1].endswith("= 3"))
    s.say(SCENE)
    report = s.say("press FN=100 N")
    tests.check("a press reports", "a = 186.626 um" in report and "dz = 3.48291 um" in report, report)
    report = s.say("step Fx=20 N")
    tests.check("a step reports", "dx = 625.995 nm" in report, report)
    report = s.say("step Fx=50 N")
    tests.check("gross slip is refused", "gross slip; step by displacement (dx=...) to slide\n  step Fx=50 N\n          ^~~~" in report, report)
    report = s.say("plot loop")
    lines = report.splitlines()
    tests.check("a plot in the terminal", "dx [nm]" in report and len(lines) <= 30 and max(map(len, lines)) <= 100, report)
    tour = play(s, "demo")
    tests.check("demo is a tour that waits", tour[0] > 5 and "fret> plot loop" in tour[1] and
                tour[1].index("The scene is the lesson's now") < tour[1].index("Lessons, such as"), str(tour))
    tests.check("its scene stays", s.say("c0, FA") == "c0 = 1 mm\nFA = 39 N")
    tests.check("till undo", s.say("undo; Fx") == "Fx = 20 N")
    tests.check("help", "Commands" in s.say("help"))
    s.child.sendline("quit")
    tests.check("quit", s.end() == 0)
    path = os.path.join(s.state, "fret", "history")
    mode = stat.S_IMODE(os.stat(path).st_mode) if os.path.exists(path) else 0
    tests.check("the history file is private", mode == 0o600, oct(mode))
    with open(path, encoding="utf-8") as f:
        kept = f.read().splitlines()
    tests.check("the history file holds the lines", "x = 3 mm" in kept and "quit" in kept and "foo" in kept, str(kept))
    s = Session(tests, XDG_STATE_HOME=s.state)
    s.child.send("\x1b[A\x1b[A")
    s.child.expect("help")
    s.child.sendline("")
    tests.check("the arrow up brings back earlier sessions", "Commands" in s.prompt())
    s.child.sendeof()
    tests.check("Ctrl-D leaves", s.end() == 0)


ASKS = re.escape("(any key: go on, b: back, q: leave)")


def to_key(s, guesses=None):
    """Waits until a lesson asks for a key, or ends: (whether it asks, its output). Answers questions by the guesses in turn, then by
    empty lines."""
    text = ""
    while True:
        found = s.child.expect([ASKS, "guess> ", r"2004hfret> $"])
        text += s.child.before
        if found != 1:
            return found == 0, text
        s.child.send((guesses.pop(0) if guesses else "") + "\r")


def play(s, statement, key=" "):
    """Plays a lesson to its end: (how often it asked for a key, its output)."""
    asked = 0
    s.child.sendline(statement)
    waits, text = to_key(s)
    while waits:
        s.child.send(key)
        asked += 1
        waits, more = to_key(s)
        text += more
    return asked, clean(text)


def guess(s, line):
    """Types a guess; returns the reply."""
    s.child.send(line + "\r")
    s.child.expect(["guess> ", r"2004hfret> $"])
    return clean(s.child.before).replace("\x1b[?", "").partition("\n")[2].strip()


def exercises(tests):
    """`ask`: right and wrong guesses, the hint, no guess; at the prompt, in a lesson, recorded, and in a copy of the terminal."""
    s = Session(tests, "--quiet", "--color=never")
    s.say(SCENE + "; press FN=100 N")
    s.say("record guesses.txt")
    question = 'ask "How wide?" = a in um within 5 % hint "as Hertz has it"'
    begin, copied = "", PROMPT + question + "\n"
    s.child.sendline(question)
    s.child.expect("guess> ")
    begin = clean(s.child.before)
    tests.check("a question", begin.endswith("How wide?\nguess: a value, ? for a hint, or Enter for the answer\n"), begin)
    copied += begin.partition("\n")[2]
    for line, want in (("100 um", "guess: 46 % too small"), ("?", "guess: as Hertz has it"), ("3 N", "guess: a is a length, not a force (3 N)"),
                       ("0.2", "guess: a needs a unit: it is a length, in m"), ("foo", "guess: unknown name 'foo'"), ("2 um +", "guess: expected a value"),
                       ("1 um", "guess: too small, the answer is 187 times as much"), ("1 mm", "guess: too large, 5.36 times the answer"),
                       ("-0.2 mm", "guess: of the wrong sign"), ("200 um", "guess: 7.2 % too large")):
        said = guess(s, line)
        tests.check("a guess of " + line, said.startswith(want), said)
        copied += "guess> " + line + "\n" + said + "\n"
    said = guess(s, "  0.19 mm ")
    tests.check("a right guess", said == "guess: right\na = 186.626 um", said)
    copied += "guess>   0.19 mm\n" + said + "\n"
    s.child.sendline('ask "Where?" of "inside", "at the rim" = 2')
    s.child.expect("guess> ")
    begin = clean(s.child.before)
    tests.check("a choice", begin.endswith("Where?\n    1  inside\n    2  at the rim\nguess: a number, or Enter for the answer\n"), begin)
    for line, want in (("1", "guess: no"), ("?", "guess: there is no hint"), ("1.5", "guess: the number of a choice is wanted"),
                       ("3", "guess: the number of a choice is wanted"), ("1 N", "guess: the number of a choice is wanted"),
                       ("inside", "guess: the number of a choice is wanted"),
                       ("2", "guess: right\nanswer: 2, at the rim")):
        said = guess(s, line)
        tests.check("a choice of " + line, said.startswith(want), said)
    s.say("record off")
    for name, key in (("Enter", "\r"), ("Ctrl-D", "\x04"), ("Ctrl-C", "\x03")):
        s.child.sendline('ask "One?" = 1 within 1 %')
        s.child.expect("guess> ")
        s.child.send(key)
        said = s.prompt()
        tests.check("no guess, by " + name, ("answer = 1" in said) == (key != "\x03") == ("interrupted" not in said), said)
    for name, text in (("recorded", None), ("copied", PROMPT + SCENE + "; press FN=100 N\n" + copied)):
        path = os.path.join(tests.dir, "guesses.txt")
        if text:
            with open(path, "w", encoding="utf-8") as f:
                f.write(text)
        with open(path, encoding="utf-8") as f:
            tests.check("guesses %s" % name, ("guess: 46 % too small" in f.read()) == (text is not None))
        done = tests.run("--replay", path)
        tests.check("a question %s comes out again" % name, done.returncode == 0 and "0 failed" in done.stdout, tests.report(done))
    text, waits = "", True
    s.child.sendline("demo sticking")
    guesses = ["1", "?", "2", "0.9", "0.46", "4", "2.4"]
    while waits:
        waits, more = to_key(s, guesses)
        text += more
        if waits:
            s.child.send(" ")
    text = clean(text)
    tests.check("a lesson with its guesses", text.count("guess: right") == 3 and "guess: no\n" in text and "guess: friction carries up to mu p" in text and
                "guess: 94 % too large" in text and "guess: 68 % too large" in text and "ask " not in text.partition("\n")[2] and
                "Next: demo sliding, Gross slip" in text and text.rfind("dx(36 N)/dx(18 N) = 2.38675") > text.rfind("guess:"), text)
    tests.check("the lesson's scene", s.say("Fx; undo; FN, Fx") == "Fx = 20 N\nFN = 100 N\nFx = 0 N", clean(s.child.before))
    s.child.sendline("demo sticking")
    s.child.expect(ASKS)
    s.child.send(" ")
    s.child.expect("guess> ")
    s.child.send("\x03")
    answer = s.prompt()
    tests.check("a question of a lesson is left by Ctrl-C", answer.count("interrupted") == 1 and s.say("FN") == "FN = 100 N", answer)
    s.child.sendline("quit")
    tests.check("guesses leave", s.end() == 0)


def interrupts(tests):
    s = Session(tests)
    s.child.send("1 + 1 + 1")
    time.sleep(0.1)
    s.child.sendintr()
    s.prompt()
    tests.check("Ctrl-C drops the line", s.say("2") == "2 = 2")
    s.child.send("x = \\\r")
    s.child.expect(r"\.\.\.\.> ")
    s.child.sendintr()
    s.prompt()
    tests.check("Ctrl-C drops a continued line", "unknown name 'x'" in s.say("x"))
    s.say(SCENE)
    s.say("press FN=100 N")
    s.say("step Fx=20 N")
    for name, command in (("table", "table dW(F) for F = 1 N .. 30 N steps 50000000 to /dev/null"),
                          ("sweep", "table a for k = 0 .. 0.5 steps 50000000 to /dev/null"),
                          ("accuracy", "plot accuracy within 60"),
                          ("cycle", "set model springs 1000000; cycle dxA=0.1 um FNA=10 N phase=20 deg times 1000000"),
                          ("plain cycle", "cycle FA=20 N times 1000000 steps 10; history to /dev/null")):
        if name == "sweep":
            s.say("c0 = 1 mm")
        s.child.sendline(command)
        time.sleep(0.5 if not tests.sanitized else 1)
        start = time.time()
        s.child.sendintr()
        try:
            answer = s.prompt()
        except pexpect.TIMEOUT:
            tests.check("Ctrl-C stops a long " + name, False, "no prompt in time")
            s.child.close(force=True)
            return
        tests.check("Ctrl-C stops a long " + name, time.time() - start < 10 and "interrupted" in answer, answer)
        tests.check("and blames no word of it: " + name, not re.search(r"(?m)^ *\^\s*$", answer), answer)
        if name != "plain cycle":
            s.say("set model auto")
            got = s.say("Fx, dx, k, FN")
            tests.check("the scene is as before the " + name,
                        got.splitlines() == ["Fx = 20 N", "dx = 625.995 nm", "k = 0", "FN = 100 N"], got)
    s.child.sendintr()
    s.prompt()
    tests.check("Ctrl-C at an empty line", s.say("1") == "1 = 1")
    s.child.sendeof()
    tests.check("Ctrl-D leaves after interrupts", s.end() == 0)


def dropped(tests):
    """Lines dropped by Ctrl-C end in ^C, and a copy of the terminal can be replayed."""
    for name, term in (("xterm", "xterm"), ("a dumb terminal", "dumb")):
        s = Session(tests, TERM=term)
        screen = Screen(30, 100)
        screen.feed(PROMPT)
        s.child.logfile_read = shown = io.StringIO()
        for typed in ("", "x = 3, y = ", "step Fx=20 N; x"):
            s.child.send(typed)
            s.child.expect_exact(typed)
            s.child.sendintr()
            told = s.prompt()
            tests.check("%s: dropped: '%s'" % (name, typed), told.endswith("^C\n") and "\n\n" not in told, repr(told))
        s.child.send("table a(F), \\\r")
        s.child.expect(r"\.\.\.\.> ")
        s.child.send("dz(F")
        s.child.expect_exact("dz(F")
        s.child.sendintr()
        s.prompt()
        s.say("x = 3; x, 2*x")
        s.say("x")
        s.child.sendeof()
        tests.check(name + ": leaves", s.end() == 0)
        screen.feed(shown.getvalue())
        with tests.file(screen.text(), ".txt") as copy:
            done = tests.run("--replay", copy)
        tests.check(name + ": a copy with dropped lines replays", done.stdout.endswith(": 3 passed, 0 failed\n"),
                    tests.report(done) + screen.text())


def dropped_tall(tests):
    """After a dropped line of two rows with the cursor in the first, the next prompt stands below both."""
    s = Session(tests, dimensions=(30, 100))
    screen = Screen(30, 100)
    s.child.logfile_read = shown = io.StringIO()
    s.child.send("x = 4; " * 20 + "9\x01")
    s.child.expect_exact("\x1b[A")  # the cursor is in the first row; Ctrl-C now, for it would drop keys not read yet
    time.sleep(0.05)
    s.child.sendintr()
    s.child.expect_exact("^C")
    s.prompt()
    screen.feed(PROMPT + shown.getvalue())
    rows = [line.rstrip() for line in screen.text().rstrip().split("\n") if line.strip()]
    tests.check("a dropped line of two rows", rows[-1] == "fret>" and rows[-2].endswith("9^C") and rows[-3].startswith("fret> x = 4"),
                "\n".join(rows[-5:]))
    s.child.sendeof()
    s.end()


def copied(tests):
    """Pastes of several lines look as if they had been typed, and a copy of the terminal can be replayed. Ctrl-C drops the rest of a paste."""
    s = Session(tests, dimensions=(40, 100))
    screen = Screen(40, 100)
    screen.feed(PROMPT)
    s.child.logfile_read = shown = io.StringIO()
    for pasted, last in (("material steel; geometry sphere R=10 mm\n# a comment\n\npress FN=100 N\nfoo\na in mm", "a = 0.186626 mm"),
                         ("fret> friction \\\n....> 0.4\nfret> dW(20 N)\ndW(20 N) = 1 J\nfret> mu\n", "mu = 0.4")):
        s.child.send("\x1b[200~" + pasted + "\x1b[201~\r")
        s.child.expect_exact(last)
        s.prompt()
    s.child.send("x = 1; x\x1b[D\x1b[D\x1b[200~y = 2\ny; \x1b[201~")
    s.child.expect_exact("fret> y;  x")
    s.child.send("\r")
    s.child.expect_exact("x = 1")
    s.prompt()
    screen.feed(shown.getvalue())
    with tests.file(screen.text(), ".txt") as copy:
        done = tests.run("--replay", copy)
    tests.check("a copy with pastes replays", done.stdout.endswith(": 12 passed, 0 failed\n"), tests.report(done) + screen.text())
    s.child.send("\x1b[200~z = 1\ntable sin(x) for x = 0 .. 1 steps 99999999 to /dev/null\nz = 2\n\x1b[201~")
    s.child.expect_exact("table sin(x)")
    s.child.expect_exact("Ctrl-C stops it")
    s.child.sendintr()
    s.prompt()
    tests.check("an interrupt drops the rest of a paste", s.say("z") == "z = 1", clean(s.child.before))
    s.child.sendeof()
    s.end()


def starting(tests):
    s = Session(tests, "--quiet")
    tests.check("--quiet", s.banner.strip() == "", s.banner)
    s.child.sendeof()
    s.end()
    config = os.path.join(tests.dir, "rc-%d" % time.monotonic_ns())
    os.makedirs(os.path.join(config, "fret"))
    with open(os.path.join(config, "fret", "fretrc"), "w", encoding="ascii") as f:
        f.write("set digits 3\n")
    s = Session(tests, XDG_CONFIG_HOME=config)
    tests.check("the start-up file", s.say("pi") == "pi = 3.14")
    s.child.sendline("exit")
    tests.check("exit", s.end() == 0)
    s = Session(tests, "--no-rc", XDG_CONFIG_HOME=config)
    tests.check("--no-rc", s.say("pi") == "pi = 3.14159")
    s.child.sendeof()
    s.end()
    s = Session(tests, XDG_STATE_HOME="/dev/null")
    tests.check("no place for a history file", s.say("1") == "1 = 1")
    s.child.sendeof()
    tests.check("and it ends well", s.end() == 0)
    s = Session(tests, "--color=always")
    s.child.sendline("foo")
    s.child.expect(PROMPT)
    tests.check("errors in colour", "\x1b[1;31merror:" in s.child.before, repr(s.child.before))
    s.child.sendeof()
    s.end()
    s = Session(tests, "--format=json")
    s.say(SCENE)
    tests.check("JSON at the prompt", s.say("press FN=100 N").startswith('{"event":"press"'))
    s.child.sendeof()
    s.end()


def plain(tests):
    """A terminal that knows no escape sequences gets none."""
    for name in ("dumb", "unknown", "", None):
        s = Session(tests, TERM=name, LC_ALL="C.UTF-8")
        s.child.logfile_read = shown = io.StringIO()
        s.say("foo")
        s.say(SCENE + "; press FN=100 N; cycle FA=20 N")
        told = s.say("plot loop")
        moved = s.say("animate loop frames 3")
        tests.check("no escapes where TERM is %s" % name, "\x1b" not in shown.getvalue() and "error: unknown name 'foo'" in shown.getvalue() and
                    "hysteresis loop" in told and moved.count("hysteresis loop") == 1, repr(shown.getvalue()[-3000:]))
        s.child.logfile_read = None
        s.child.sendeof()
        s.end()


def figures(tests):
    """Figures have colours and braille if the terminal has them; frames of a film replace one another."""
    s = Session(tests, LC_ALL="C.UTF-8", TERM="xterm-256color")
    s.say(SCENE)
    s.say("press FN=100 N; cycle FA=20 N")
    s.child.sendline("plot loop")
    s.child.expect(PROMPT)
    shown = s.child.before
    tests.check("a plot in braille and colour", re.search("\x1b\\[38;5;[0-9]+m[\u2801-\u28ff]", shown) and
                "hysteresis loop" in shown, shown)
    s.child.sendline("animate loop frames 5")
    s.child.expect(PROMPT)
    tests.check("an animation goes back up for each frame", len(re.findall("\x1b\\[[0-9]+A", s.child.before)) == 4,
                repr(s.child.before))
    tests.check("nothing stands before its first frame", "gnuplot" not in s.child.before, repr(s.child.before))
    s.child.sendeof()
    s.end()
    s = Session(tests, "--color=never", TERM="linux", LC_ALL="C.UTF-8")
    s.say(SCENE)
    s.say("press FN=100 N; cycle FA=20 N")
    shown = s.say("plot loop")
    tests.check("a console without braille", "****" in shown and not re.search("[\u2800-\u28ff]", shown), shown)
    s.child.sendeof()
    s.end()


def sizes(tests):
    """Plots fit the size of the terminal, if there is room for a plot, and its kind."""
    for rows, columns, wide, high in ((30, 100, 99, 28), (20, 60, 59, 18), (8, 100, 99, 6), (8, 40, 39, 6), (7, 100, 79, 24), (30, 19, 79, 24)):
        s = Session(tests, "--quiet", "--color=never", dimensions=(rows, columns))
        s.say("set pager off")
        s.child.sendline("plot x for x = 0 .. 1; 77*11")
        s.child.expect(r"77\*11 = 847\r\n")
        lines = clean(s.child.before).splitlines()[-high:]
        tests.check("a plot in %d rows of %d" % (rows, columns), max(map(len, lines)) <= wide and
                    (max(map(len, lines)) > wide - 10 and "x" in lines[-1] or high < 8), "\n".join(lines))
        s.prompt()  # a Ctrl-D before readline has the terminal is lost
        s.child.sendeof()
        s.end()
    for term, braille in (("xterm", True), ("linux", False), (None, False)):
        s = Session(tests, "--quiet", TERM=term, LC_ALL="C.UTF-8")
        s.child.sendline("plot x^2 for x = 0 .. 1")
        s.child.expect(PROMPT)
        tests.check("braille where TERM is %s" % term, bool(re.search("[\u2801-\u28ff]", s.child.before)) == braille, s.child.before)
        s.child.sendeof()
        s.end()


def tables(tests):
    """Tables at a terminal have every row, in each format, undamaged by the progress line."""
    s = Session(tests, "--quiet", "--color=never")
    s.child.sendline("table x for x = 0 .. 2999 steps 2999; 77*11")
    s.child.expect(r"77\*11 = 847\r\n")
    rows = re.findall(r"^ +(\d+) +(\d+)$", clean(s.child.before), re.M)
    s.prompt()
    tests.check("a long table", [(str(i), str(i)) for i in range(3000)] == rows, clean(s.child.before)[-500:])
    for form, row in (("csv", "%d,%d"), ("json", '{"x":%d,"x (2)":%d}')):
        s.say("set format " + form)
        told = s.say("table x for x = 1 .. 3 steps 2").splitlines()
        tests.check("a table in " + form, told[-3:] == [row % (i, i) for i in (1, 2, 3)], str(told))
    s.say("set format text")
    slow = s.say(SCENE + "; press FN=100 N; cycle FA=9 N FNA=10 N; geometry sum 2:50 m^-1, 4:2e6 m^-3; table W for mu = 0.3 .. 0.4 steps 400")
    rows = re.findall(r"^ +([\d.]+) +([\d.]+)$", clean(slow).rpartition("W [")[2], re.M)
    tests.check("a table that takes its time", len(rows) == 401 and float(rows[0][0]) == 0.3 and float(rows[-1][0]) == 0.4, slow[-600:])
    s.child.sendeof()
    s.end()


def moving(tests):
    """Frames are drawn in place on the terminal; the recording has no cursor movements."""
    path = os.path.join(tests.dir, "moving.txt")
    s = Session(tests, "--quiet", TERM="xterm-256color")
    s.say(SCENE + "; press FN=100 N; cycle FA=20 N; record " + path)
    s.child.sendline("animate loop frames 3; 77*11")
    s.child.expect(r"77\*11 = 847\r\n")
    shown = s.child.before
    s.prompt()
    s.say("record off")  # keys typed between two lines may be lost
    s.child.sendeof()
    s.end()
    with open(path, encoding="utf-8") as f:
        kept = f.read()
    tests.check("an animation that is recorded", "hysteresis loop" in clean(shown) and "\x1b" not in kept and "77*11 = 847" in kept, shown[-800:] + kept[-800:])
    s = Session(tests, "--quiet", "--format=json", TERM="xterm-256color")
    s.say(SCENE + "; press FN=100 N; cycle FA=20 N")
    told = s.say("animate loop frames 3")
    tests.check("an animation in JSON", told.count('{"text":"') >= 1 and "\x1b" not in told, told[-500:])
    s.say("set format text; set report off")
    for figures, moves in (("springs | loop | pressure", True), ("springs | loop | pressure | slip | load", False)):
        s.child.sendline("animate %s frames 3" % figures)
        told = s.child.before if s.child.expect(PROMPT) == 0 else ""
        tests.check("frames that fit replace each other: " + figures, bool(re.search("\x1b\\[\\d+A", told)) == moves and
                    told.count("hysteresis loop") == (3 if moves else 1), told[-500:])
    s.child.sendline("animate loop frames 300")
    s.child.expect("\x1b\\[[0-9]+A")
    s.child.sendintr()
    told = s.prompt()
    tests.check("Ctrl-C stops an animation", "interrupted" in told and told.count("hysteresis loop") < 299 and s.say("FN, Fx") == "FN = 100 N\nFx = 20 N", told[-500:])
    s.child.sendeof()
    s.end()


def own(tests):
    """What only the prompt does: `!COMMAND`, a shortened list of a long load, a start-up file."""
    home = os.path.join(tests.dir, "at-home")
    os.makedirs(os.path.join(home, ".config", "fret"))
    with open(os.path.join(home, ".config", "fret", "fretrc"), "w", encoding="ascii") as f:
        f.write("x = 17\n")
    s = Session(tests, "--quiet", HOME=home, XDG_CONFIG_HOME="")
    tests.check("the start-up file at home", s.say("x") == "x = 17")
    tests.check("a command of the system", s.say("!echo a && echo b") == "a\nb")
    tests.check("its status is told", s.say("!exit 3") == "the command ended with status 3")
    tests.check("and by what it was killed", s.say("!kill -9 $$") == "the command ended with status 9")
    s.say(SCENE + "; press FN=100 N")
    for i in range(1, 24):
        s.say("step Fx=%d N" % i)
    lines = s.say("show").splitlines()
    tests.check("a long load is shown by its ends", lines[3:13] == ["press FN=100 N"] + ["step Fx=%d N" % i for i in range(1, 10)] and
                lines[13] == "# ... 4 more steps, not shown" and lines[14:24] == ["step Fx=%d N" % i for i in range(14, 24)],
                "\n".join(lines))
    path = os.path.join(home, "long.fret")
    s.say("save " + path)
    with open(path, encoding="ascii") as f:
        tests.check("and saved whole", f.read().count("step Fx=") == 23)
    s.child.sendline("quit")
    tests.check("quit", s.end() == 0)


def strangers(tests):
    """Nothing in the current directory is read at the start: relative paths in environment variables are ignored."""
    where, home = os.path.join(tests.dir, "stranger"), os.path.join(tests.dir, "stranger-home")
    for at, x in ((os.path.join(where, "fret"), 1), (os.path.join(where, ".config", "fret"), 2), (os.path.join(where, "config", "fret"), 3), (os.path.join(home, ".config", "fret"), 17)):
        os.makedirs(at)
        with open(os.path.join(at, "fretrc"), "w", encoding="ascii") as f:
            f.write("x = %d\n" % x)
    with open(os.path.join(where, ".inputrc"), "w", encoding="ascii") as f:
        f.write('"x": "666"\n')
    files = sorted(os.listdir(where))
    none = "error: unknown name 'x'"
    for env, answer in (({"XDG_CONFIG_HOME": "."}, "x = 17"), ({"XDG_CONFIG_HOME": "config"}, "x = 17"), ({"XDG_CONFIG_HOME": ""}, "x = 17"),
                        ({"XDG_CONFIG_HOME": "", "HOME": "."}, none), ({"XDG_CONFIG_HOME": "", "HOME": ""}, none), ({"XDG_CONFIG_HOME": ".", "HOME": ".."}, none),
                        ({"XDG_CONFIG_HOME": "", "HOME": "./"}, none), ({"XDG_CONFIG_HOME": "", "HOME": "../stranger"}, none)):
        s = Session(tests, "--quiet", cwd=where, **{"HOME": home, "XDG_STATE_HOME": "state", "INPUTRC": None, **env})
        told = s.say("x")
        tests.check("a stranger's settings: %s" % env, told == answer and sorted(os.listdir(where)) == files, told)
        s.child.sendeof()
        s.end()
    os.unlink(os.path.join(home, ".config", "fret", "fretrc"))
    os.symlink("fretrc", os.path.join(home, ".config", "fret", "fretrc"))
    s = Session(tests, "--quiet", HOME=home, XDG_CONFIG_HOME="")
    tests.check("a start-up file that cannot be read is told", "error: cannot read %s/.config/fret/fretrc: Too many levels" % home in s.banner, s.banner)
    s.child.sendeof()
    s.end()


def narrow(tests):
    """The progress line stays within one row of a narrow terminal."""
    for columns in (20, 58):
        s = Session(tests, "--quiet", dimensions=(24, columns))
        s.child.sendline("table x for x = 1 .. 2 steps 100000000 to /dev/null")
        found = s.child.expect([r"\r(table: \d[^\r\n]*)\r", pexpect.TIMEOUT], timeout=120)
        told = s.child.match.group(1) if not found else ""
        tests.check("progress in %d columns" % columns, len(told) == columns - 3, repr(told))
        s.child.sendintr()
        s.prompt()
        s.child.sendline("quit")
        tests.check("and the session goes on", s.end() == 0)


def kept_lines(tests):
    """The history file: where it is, which files are refused, what is read from it, and its permissions."""
    def session(line=None, **env):
        s = Session(tests, "--quiet", **env)
        answer = s.say(line) if line else None
        s.child.sendline("quit")
        s.end()
        return s.banner, answer
    home = os.path.join(tests.dir, "home-of-history")
    for name, env in (("at home", {"XDG_STATE_HOME": ""}), ("at home, the state's place is no path", {"XDG_STATE_HOME": "state"})):
        os.mkdir(home)
        session("1 + 41", HOME=home, **env)
        with open(os.path.join(home, ".local/state/fret/history"), encoding="ascii") as f:
            tests.check(name, f.read() == "1 + 41\nquit\n", name)
        shutil.rmtree(home)
    banner, answer = session("1 + 1", XDG_STATE_HOME="/dev/null")
    tests.check("where none can be made", answer == "1 + 1 = 2" and "no history is kept: cannot write /dev/null/fret/history: Not a directory" in banner, banner)
    for name, env in (("no home", {"XDG_STATE_HOME": "", "HOME": ""}), ("a long way", {"XDG_STATE_HOME": "/" + 5000 * "x"})):
        tests.check(name, session("1 + 1", **env)[1] == "1 + 1 = 2")
    nowhere = os.path.join(tests.dir, "no-home-of-history")
    tests.check("a home that is not there is not made", session("1 + 1", XDG_STATE_HOME="", HOME=nowhere)[1] == "1 + 1 = 2" and
                not os.path.exists(nowhere), nowhere)
    state = os.path.join(tests.dir, "strange-history")
    path = os.path.join(state, "fret", "history")
    for name, make in (("a link", lambda: os.symlink("elsewhere", path)), ("a pipe", lambda: os.mkfifo(path)), ("a folder", lambda: os.mkdir(path))):
        os.makedirs(os.path.dirname(path))
        make()
        banner, answer = session("1 + 1", XDG_STATE_HOME=state)
        tests.check("no history in " + name, answer == "1 + 1 = 2" and ("no history is kept: %s is no plain file" % path in banner) == (name != "a folder") and
                    not os.path.exists(os.path.join(state, "fret", "elsewhere")), banner)
        shutil.rmtree(state)
    os.makedirs(os.path.dirname(path))
    with open(path, "w", encoding="ascii") as f:
        f.write("".join("%d + 1\n" % i for i in range(200000, 400000)))
    os.chmod(path, 0o644)
    s = Session(tests, "--quiet", XDG_STATE_HOME=state)
    tests.check("a history that others could read", stat.S_IMODE(os.stat(path).st_mode) == 0o600, oct(os.stat(path).st_mode))
    s.child.send("\x1b[A\x1b[A\r")
    tests.check("its last lines", s.child.expect([r"399998 \+ 1 = 399999\r", pexpect.TIMEOUT]) == 0, clean(s.child.before))
    s.child.send("\x1b<\r")
    s.child.expect(r"(\d+) \+ 1 = (\d+)\r")
    first, after = map(int, s.child.match.groups())
    tests.check("and no part of a line", 200000 < first < 399000 and after == first + 1, "%d %d" % (first, after))
    s.child.sendline("quit")
    s.end()


def odd_lines(tests):
    """A history file with NUL bytes, as after a crash, and with a very long line: such lines are not kept."""
    state = os.path.join(tests.dir, "odd-history")
    path = os.path.join(state, "fret", "history")
    os.makedirs(os.path.dirname(path))
    with open(path, "wb") as f:
        f.write(b"1 + 11\n\0\0\0002 + 22\n3 +\0 33\n" + b"1" + 2250000 * b"+1" + b"\n4 + 44\n")
    s = Session(tests, "--quiet", XDG_STATE_HOME=state)
    for i in range(4):
        told = s.say("\x1b[A" * 4)
        tests.check("an odd history, line %d" % i, told == "%d + %d = %d" % (i + 1, 11 * (i + 1), 12 * (i + 1)), told)
    s.child.send("\x1b[200~5 + 55; x = 1%s\x1b[201~\r" % (40000 * "+1"))
    s.child.expect(r"5 \+ 55 = 60\r")
    s.prompt()
    tests.check("a long line is not recalled", s.say("\x1b[A").endswith("4 + 44 = 48"))
    told = s.say("save " + path)
    tests.check("the history is no target", "error: cannot write %s: this session is using it" % path in told, told)
    s.say("x")
    s.child.sendline("quit")
    s.end()
    with open(path, "rb") as f:
        lines = f.read().decode().splitlines()
    tests.check("nor kept", lines[-2:] == ["x", "quit"] and [line for line in lines if len(line) > 1000] == [lines[3]], str([line[:80] for line in lines]))


def stopped(tests):
    """Ctrl-Z at the prompt, and fg; a signal that the parent ignores."""
    shell = pexpect.spawn("/bin/bash", ["--norc", "--noprofile", "-i"], env={**tests.env, "PS1": "shell> ", "TERM": "xterm", "FRET": tests.fret,
                          "XDG_STATE_HOME": os.path.join(tests.dir, "state-stopped"), "INPUTRC": "/dev/null"}, encoding="utf-8", timeout=60, cwd=tests.dir)
    shell.expect("shell> ")
    shell.sendline('stty -a > before; "$FRET" --no-rc --quiet')
    shell.expect(PROMPT)
    shell.send("1 + 2")
    shell.expect(r"1 \+ 2")
    os.kill(child_of(shell.pid), signal.SIGTSTP)
    shell.expect("Stopped")
    shell.sendline("stty -a > after; cmp before after && echo all sa''me")
    shell.expect("all same")
    shell.sendline("fg")
    shell.expect(r"fret> 1 \+ 2")
    shell.send("00\r")
    tests.check("the line is there again", shell.expect([r"1 \+ 200 = 201", pexpect.TIMEOUT]) == 0, clean(shell.before))
    shell.sendline("demo sticking")
    shell.expect("q: leave")
    shell.send("\x1a")
    shell.expect("Stopped")
    shell.sendline("fg")
    shell.expect("q: leave")
    shell.send("\x1b[C")
    tests.check("a lesson goes on by any key", shell.expect(["fret> material steel", pexpect.TIMEOUT], timeout=10) == 0, clean(shell.before))
    shell.expect("guess> ")
    shell.sendline("2")
    tests.check("which is one key", shell.expect(["guess: right", pexpect.TIMEOUT], timeout=10) == 0, clean(shell.before))
    shell.expect("q: leave")
    shell.send("q")
    shell.expect(PROMPT)
    shell.sendline("quit")
    shell.expect("shell> ")
    shell.sendline("trap '' TSTP; \"$FRET\" --no-rc --quiet")
    shell.expect(PROMPT)
    os.kill(child_of(shell.pid), signal.SIGTSTP)
    shell.sendline("2 + 3")
    tests.check("what its starter ignores, it ignores", shell.expect([r"2 \+ 3 = 5", pexpect.TIMEOUT, pexpect.EOF]) == 0, clean(shell.before or ""))
    shell.sendline("quit")
    shell.sendline("exit")
    shell.expect(pexpect.EOF)
    shell.close()


def paging(tests):
    """Text too long for the terminal goes to $PAGER, less or more; without a pager it is printed."""
    where = os.path.join(tests.dir, "pagers")
    os.mkdir(where)
    for tool in ("sh", "cat", "head"):
        os.symlink(shutil.which(tool), os.path.join(where, tool))

    def shown(pager, *there):
        for name in ("less", "more"):
            path = os.path.join(where, name)
            if name in there:
                with open(path, "w", encoding="ascii") as f:
                    f.write("#!/bin/sh\necho by-%s\nhead -n 2\n" % name)
                os.chmod(path, 0o755)
            elif os.path.exists(path):
                os.unlink(path)
        command = 'PATH=%s; %s; exec "$FRET" --no-rc --quiet' % (where, "unset PAGER" if pager is None else "PAGER='%s'; export PAGER" % pager)
        child = pexpect.spawn("/bin/sh", ["-c", command], env={**tests.env, "TERM": "xterm", "INPUTRC": "/dev/null", "FRET": tests.fret,
                              "XDG_STATE_HOME": where}, encoding="utf-8", timeout=60, cwd=tests.dir, dimensions=(12, 80))
        child.expect(PROMPT)
        child.sendline("show units")
        child.expect(PROMPT)
        text = clean(child.before)
        child.sendline("quit")
        child.expect(pexpect.EOF)
        child.close()
        return text
    for name, pager, there, by in (("less", None, ("less", "more"), "by-less"), ("more", None, ("more",), "by-more"), ("none", None, (), None),
                                   ("what PAGER says", "head -n 1", ("less",), "1"), ("PAGER of nothing", "", ("less",), None), ("cat", "cat", ("less",), None),
                                   ("one that is not there", "nothing-there -x", ("less",), None), ("one that cannot be run", where, ("less",), None),
                                   ("one that fails", "exit 1 #", ("less",), None), ("one that is killed", "kill -9 $$ #", ("less",), None)):
        text = shown(pager, *there)
        lines = text.strip().splitlines()
        tests.check("a pager: " + name, (by in text and len(lines) == 4 if by and by != "1" else len(lines) == 2 if by else len(lines) > 12), text)


def letters(tests):
    """Non-ASCII characters, also as the first of a line, and cursor moves over them, in every locale."""
    for name, env in (("C", {}), ("POSIX", {"LC_ALL": "POSIX"}), ("none", {"LC_ALL": None}), ("none that is there", {"LC_ALL": "xx_YY.ISO-8859-1"}),
                      ("of the characters alone", {"LC_ALL": None, "LANG": "C.UTF-8", "LC_CTYPE": "C"}), ("UTF-8", {"LC_ALL": "C.UTF-8"})):
        s = Session(tests, "--quiet", TERM="xterm", **env)
        for again in ("first", "second"):  # readline reads the locale before every line
            told = s.say("\u2212 3")
            tests.check("locale %s: a minus sign, %s" % (name, again), "error: '\u2212' (U+2212) is no character of the language" in told, told)
        told = s.say("\u00fc = 4")
        tests.check("locale %s: an assignment" % name, told == "" and s.say("\u00fc*1").endswith("\u00fc*1 = 4"), told)
        # two characters back, insert one, delete the last
        told = s.say("\u00e4\u20ac\u00fc\x02\x02x\x05\x7f = 6")
        tests.check("locale %s: editing" % name, told == "" and s.say("\u00e4x\u20ac*1").endswith("\u00e4x\u20ac*1 = 6"), told)
        s.child.sendeof()
        tests.check("locale %s: it ends" % name, s.end() == 0)


def run(tests):
    tests.rooms(letters, plain, exercises, kept_lines, odd_lines, stopped, paging, dialogue, interrupts, dropped, dropped_tall, copied, starting, own, strangers, narrow, figures, sizes, tables, moving)
