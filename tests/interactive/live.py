# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests the full-screen mode on a terminal of its own: screens, keys, sizes, signals, and sessions that are saved and recorded."""
import json
import os
import random
import re
import shutil
import signal
import subprocess
import termios
import time

import pexpect

import harness
from harness import at_work
from screen import Screen

UTF8 = {"LC_ALL": "C.UTF-8", "TERM": "xterm-256color"}
SHOWN = "FN, Fx, dx, dz, a, c, W, U, kt, k, mu"


class Live:
    """`fret --live`, or another command, and its screen."""

    def __init__(self, tests, *args, size=(24, 80), command=None, **env):
        env = {**tests.env, "XDG_CONFIG_HOME": os.path.join(tests.dir, "no-config"),
               "XDG_STATE_HOME": os.path.join(tests.dir, "live-state"), "INPUTRC": "/dev/null", **UTF8, **env}
        program, args = (tests.fret, ["--live", *args]) if command is None else (command[0], list(command[1:]))
        self.screen = Screen(*size)
        self.raw = ""
        self.child = pexpect.spawn(program, args, env=env, encoding="utf-8", timeout=120, cwd=tests.dir, dimensions=size,
                                   codec_errors="replace")
        self.child.delaybeforesend = None

    def read(self, seconds=0.02):
        try:
            text = self.child.read_nonblocking(65536, seconds)
        except pexpect.TIMEOUT:
            return False
        except pexpect.EOF:
            return False
        self.raw += text
        self.screen.feed(text)
        return True

    def wait(self, what, seconds=60):
        """Waits until the screen shows `what`, a regular expression or a function of the screen. False: it does not in time."""
        end = time.time() + seconds
        seen = what if callable(what) else lambda screen: re.search(what, screen.text())
        while not seen(self.screen):
            if time.time() > end:
                return False
            self.read()
        while self.read(0.01):
            pass
        return True

    def key(self, keys, what=None):
        self.child.send(keys)
        return self.wait(what) if what else True

    def status(self):
        return self.screen.row(self.screen.rows - 1)

    def says(self, line):
        """Runs a statement by `:`; returns the screen when it has been run."""
        self.child.send(":" + line + "\r")

    def value(self, name):
        found = re.search(r"(?m)(?:^|\s)%s (-?[0-9.e+-]+|-) ?(\S*)" % re.escape(name.ljust(3)), self.screen.text())
        return (found.group(1), found.group(2)) if found else ("", "")

    def end(self, keys="q"):
        self.child.send(keys)
        return self.gone()

    def gone(self):
        limit = time.time() + 120
        while self.child.isalive() and time.time() < limit:
            if not self.read(0.05) and not self.child.isalive():
                break
        self.read()
        self.child.close()
        return self.child.exitstatus


def beginning(tests):
    for size in ((24, 80), (50, 160), (12, 44)):
        live = Live(tests, size=size)
        ok = live.wait(r"a +186\.626 um")
        text = live.screen.text()
        tests.check("the screen at %dx%d" % size, ok and "loop: Fx over dx" in text and "springs" in text and
                    ("-- contact" in text) == (size[1] >= 60) and ("energy" in text) == (size[0] >= 40) and
                    re.search("[\u2801-\u28ff]", text) and "q quit" in text or size[1] < 80, text)
        tests.check("q leaves at %dx%d" % size, live.end() == 0)
    for name, env, wanted in (("plain characters", {"LC_ALL": "C", "TERM": "vt100"}, "####"),
                              ("eight colours", {"LC_ALL": "C", "TERM": "xterm"}, "####")):
        live = Live(tests, **env)
        ok = live.wait(r"a +186\.626 um")
        text = live.screen.text()
        tests.check(name, ok and wanted in text and text.isascii(), text)
        tests.check("colours: " + name, (re.search(r"\x1b\[(\d+;)*3\dm", live.raw) is not None) == (name == "eight colours"), repr(live.raw[-500:]))
        red = r"\x1b\[(\d+;)*31m[^\x1b]*"
        said = live.key(":foo\r", "unknown name 'foo'") and live.key(" ", "cycle FA=") and live.key(" ", "space again shows its end")
        tests.check("an error is red, a hint is not: " + name, said and (re.search(red + "unknown name", live.raw) is not None) == (name == "eight colours")
                    and not re.search(red + "the last cycle", live.raw), repr(live.raw[-2500:]))
        live.end()
    live = Live(tests, size=(8, 30))
    tests.check("a screen too small", live.wait("too small") and live.end() == 0, live.screen.text())


def refusals(tests):
    done = tests.run("--live")
    tests.check("without a terminal", done.returncode == 1 and "needs a terminal" in done.stderr, tests.report(done))
    done = tests.run("-c", "live")
    tests.check("the command without a terminal", done.returncode == 1 and "needs a terminal" in done.stderr,
                tests.report(done))
    done = tests.run("--live", "a", "b")
    tests.check("two scripts", done.returncode == 2, tests.report(done))
    for args, env, says in ((["--live"], {"TERM": "dumb"}, "TERM=dumb"), (["--live"], {"TERM": "none-such"}, "not know this terminal (TERM=none-such); most are of the kind of xterm, try: TERM=xterm-256color fret --live"),
                            (["--live", "/nonexistent"], {}, "cannot read /nonexistent")):
        live = Live(tests, command=[tests.fret, *args], **env)
        status = live.gone()
        tests.check("refused: " + says, status == 1 and says in live.raw, live.raw)


# key, the status line, and a value afterwards
KEYS = [("\x1b[C", r"step Fx\+=2 N", "Fx", "2"), ("l", r"step Fx\+=2 N", "Fx", "4"),
        ("\x1b[D", r"step Fx\+=-2 N", "Fx", "2"), ("\x1b[1;2C", r"step Fx\+=200 mN", "Fx", "2.2"),
        ("\x1b[1;2D", r"step Fx\+=-200 mN", "Fx", "2"), ("L", r"step Fx\+=200 mN", "Fx", "2.2"),
        ("H", r"step Fx\+=-200 mN", "Fx", "2"), ("h", r"step Fx\+=-2 N", "Fx", "0"),
        ("\x1b[A", r"step FN\+=5 N", "FN", "105"), ("\x1b[B", r"step FN\+=-5 N", "FN", "100"),
        ("\x1b[1;2A", r"step FN\+=500 mN", "FN", "100.5"), ("\x1b[1;2B", r"step FN\+=-500 mN", "FN", "100"),
        ("i", r"step FN\+=5 N", "FN", "105"), ("j", r"step FN\+=-5 N", "FN", "100"),
        ("u", r"undo", "FN", "105"), ("u", r"undo", "FN", "100"),
        ("r", r"press FN=100 N", "Fx", "0"), ("f", "displacements", "FN", "100"), ("l", r"step dx\+=50 nm", "dx", "50"),
        ("i", r"step dz\+=100 nm", "dz", "3.58291"), ("f", "forces", "dx", "50"),
        ("k", "k = 0.05", "a", "198.585"), ("K", "k = 0", "a", "189.286"), ("m", "mu = 0.42", "dx", "50"),
        ("M", "mu = 0.4", "dx", "50"), ("c", "c0 = 1.25 mm", "dx", "50"), ("C", "c0 = 1 mm", "dx", "50"),
        ("g", "geometry cone slope=0.02", "dx", "50"), ("u", "undo", "a", "189.286"),
        ("r", r"press FN=100 N", "a", "186.626"), ("x", "lists the keys", "a", "186.626")]


def keys(tests):
    live = Live(tests)
    live.wait(r"a +186\.626 um")
    for i, (key, says, name, value) in enumerate(KEYS):
        ok = live.key(key, lambda s, says=says: re.search(says, s.row(23)) and live.value(name)[0] == value)
        if not tests.check("key %d, %r" % (i, key), ok, "%s: %s\n%s" % (name, live.value(name), live.screen.text())):
            break
    head = lambda pattern: lambda screen: re.search(pattern, screen.row(0))  # noqa: E731
    for key, pattern in (("+", "FA 22 N"), ("-", "FA 20 N"), ("]", " 1/s"), ("[", r" 0\.5/s"), ("n", "FNA 10 N")):
        tests.check("key " + key, live.key(key, head(pattern)), live.screen.text())
    tests.check("key a", live.key("a", "phase of FN against Fx: 105 deg"), live.screen.text())
    tests.check("key ?", live.key("?", "push tangentially"), live.screen.text())
    tests.check("and back", live.key("x", "loop: Fx over dx"), live.screen.text())
    tests.check("gross slip is told", live.says("step Fx=50 N") or live.wait("exceeds mu"), live.screen.text())
    tests.check("and nothing lost", live.value("Fx")[0] == "0" and live.value("a")[0] == "186.626", live.screen.text())
    live.says("fric")
    tests.check("an error is told", live.wait("error: unknown"), live.screen.text())
    live.child.send(":geometry para\t")
    tests.check("Tab completes", live.wait(":geometry paraboloid"), live.screen.text())
    tests.check("Escape drops the line", live.key("\x1b", lambda s: ":geometry" not in s.text()), live.screen.text())
    live.child.send(":xx\x1b[D\x1b[D\x7fa\x1b[Cb\x05c\x01d")
    tests.check("editing a line", live.wait(":daxbxc"), live.screen.text())
    tests.check("Ctrl-C drops the line only", live.key("\x03", lambda s: "daxbxc" not in s.text()), live.screen.text())
    live.says("table a for k = 0 .. 0.5 steps 60")
    tests.check("a long answer is a page", live.wait(r"a \[um\]"), live.screen.text())
    tests.check("its next page", live.key(" ", r"\b0\.2[0-9]+ +[0-9]"), live.screen.text())
    live.key("x", "loop: Fx")
    tests.check("Ctrl-C leaves", live.end("\x03") == 0)


def playing(tests):
    live = Live(tests)
    live.wait(r"a +186\.626 um")
    path = os.path.join(tests.dir, "pressed.png")
    live.child.send("p\x15" + path + "\r")
    tests.check("p before anything is pushed", live.wait("wrote .*pressed.png") and os.path.exists(path), live.screen.text())
    live.key("]]]")
    live.key(" ", "cycle FA=20 N")
    seen = set()
    end = time.time() + 60
    while len(seen) < 8 and time.time() < end:
        live.read()
        seen.add(live.value("Fx"))
    tests.check("a cycle plays", len(seen) >= 8 and "> cycle" in live.screen.row(0), str(seen))
    live.key(" ", "last cycle")
    tests.check("and ends at the peak", live.wait(lambda s: "> cycle" not in s.row(0) and live.value("Fx")[0] == "20"),
                live.screen.text())
    tests.check("it is in the load program", live.value("dW")[0] == "1.90646", live.screen.text())
    live.key("n")
    live.key(" ", r"cycle FA=20 N FNA=10 N phase=90 deg")
    live.key("  ", lambda s: "> cycle" not in s.row(0))
    tests.check("a key ends the play", live.key("h", lambda s: live.value("Fx")[0] == "18"), live.screen.text())
    path = os.path.join(tests.dir, "live.png")
    live.child.send("p\x15" + path + "\r")
    drawn = live.wait("wrote .*live.png") and os.path.exists(path)
    tests.check("p draws a picture", drawn and open(path, "rb").read(4) == b"\x89PNG", live.screen.text())
    path = os.path.join(tests.dir, "live.gp")
    live.child.send("p\x15" + path + "\r")
    text = ""
    if live.wait("wrote .*live.gp"):
        with open(path, encoding="utf-8") as f:
            text = f.read()
    tests.check("of springs, loop and traction", all(part in text for part in ("springs between their bounds", "hysteresis loop", "tangential traction")), text[-2000:])
    live.child.send("p\x15/nonexistent/x.png\r")
    tests.check("a picture that cannot be written", live.wait("error: cannot write /nonexistent/x.png"), live.screen.text())
    live.end()


def repeating(tests):
    """Cycles that repeat are not computed again, and yet the loss grows from frame to frame."""
    live = Live(tests)
    live.wait(r"a +186\.626 um")
    live.key("nnn]]", "FNA 30 N")
    live.key("------", "FA 8 N")
    live.key("++", "FA 12 N")
    live.child.send(" ")
    lost, digits, end = [], [], time.time() + 60
    while (not lost or lost[-1] < 4e-6 or len(set(lost)) <= 20) and time.time() < end:
        live.read()
        number, unit = live.value("W")
        if number not in ("", "-") and unit:
            lost.append(float(number) * {"J": 1, "uJ": 1e-6, "nJ": 1e-9}[unit])
            digits.append(len(number.split("e")[0].replace(".", "").lstrip("0")))
    tests.check("chords are shown to four digits", digits and max(digits) == 4, str(digits))
    live.key("  ", lambda s: "> cycle" not in s.row(0))
    tests.check("losses add up", lost == sorted(lost) and len(set(lost)) > 20 and lost[-1] >= 4e-6, str(lost))
    live.says("dW")
    done = tests.run("-c", "material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N; "
                     "cycle FA=12 N FNA=30 N phase=90 deg times 3; dW")
    tests.check("by what one cycle loses", live.wait(re.escape(done.stdout.strip())), done.stdout + live.screen.text())
    live.end()


def going_on(tests):
    """A cycle that goes on playing is one cycle of many periods, about one normal force; after a change it is a new one."""
    live = Live(tests)
    live.wait(r"a +186\.626 um")
    live.key("nn]]" + 18 * "a", "phase of FN against Fx: 0 deg")
    live.key("-----", "FA 10 N")
    live.key(" ", r"times ([3-9]|\d\d)")
    live.key("  ", lambda s: "> cycle" not in s.row(0))
    tests.check("FN swings about where it was", live.value("FN")[0] == "120", live.screen.text())
    live.key("m", "mu = 0.42")
    live.key("   ", lambda s: "> cycle" not in s.row(0) and live.value("FN")[0] == "140")
    live.key("+", "FA 12 N")
    path = os.path.join(tests.dir, "going-on.fret")
    live.child.send("s\x15" + path + "\r")
    live.wait("wrote ")
    with open(path, encoding="utf-8") as f:
        text = f.read()
    tests.check("one cycle a time", re.search(r"cycle FA=10 N FNA=20 N phase=0 deg times \d+\ncycle FA=10 N FNA=20 N phase=0 deg\n", text)
                and "friction 0.42" in text, text)
    live.key("u", lambda s: live.value("FN")[0] == "120")
    live.key("u", lambda s: "mu 0.4 " in s.row(0))
    tests.check("which undo takes back", live.key("u", lambda s: live.value("FN")[0] == "100"), live.screen.text())
    live.end()


def sizes(tests):
    live = Live(tests)
    live.wait(r"a +186\.626 um")
    for rows, cols in ((50, 160), (24, 80), (10, 40), (30, 100)):
        live.screen.resize(rows, cols)
        live.child.setwinsize(rows, cols)
        ok = live.wait(lambda s: "loop: Fx over dx" in s.text() and re.search(r"Fx +0 N", s.text()) and s.row(rows - 1))
        tests.check("the size becomes %dx%d" % (rows, cols), ok and ("energy" in live.screen.text()) == (rows >= 40) and "q quit  ? keys" in live.screen.text(),
                    live.screen.text())
    live.child.setwinsize(0, 0)
    tests.check("a terminal that does not know its size any more keeps the last", live.key("n", "FNA 10 N") and "q quit  ? keys" in live.screen.text(),
                live.screen.text())
    live.end()
    with tests.file(SCENE + "\n" + "# A long remark\n" * 20) as path:
        live = Live(tests, path, size=(10, 40))
        tests.check("rows that are not there are not drawn", live.wait("A long remark") and re.match(r"sphere .. +cycle FA 20 N", live.screen.row(0)) and
                    re.match(" FN  100 N", live.screen.row(1)), live.screen.text())
        live.end()


def comparing(tests):
    live = Live(tests)
    live.wait(r"a +186\.626 um")
    live.says("compare k = -0.5, 0.5")
    ok = live.wait(lambda s: "106.532 um" in s.text() and "300.925 um" in s.text())
    tests.check("two scenes", ok and "k = -0.5: " in live.screen.text(), live.screen.text())
    live.key("l", r"step Fx\+=2 N")
    tests.check("one hand moves both", len(re.findall(r"Fx +2 N", live.screen.text())) == 2, live.screen.text())
    titles = [re.split(" {2,}", row) for row in live.screen.text().splitlines() if row.startswith("-- ")]
    tests.check("titles that say no half", titles == [["-- k = -0.5: springs", "-- k = 0.5: springs"],
                                                      ["-- k = -0.5: loop: Fx over dx", "-- k = 0.5: loop: Fx over dx"]], str(titles))
    path = os.path.join(tests.dir, "both.gp")
    tests.check("p asks where to", live.key("p", r"save the picture as: live\.png"), live.screen.text())
    live.child.send("\x15" + path + "\r")
    tests.check("p draws both", live.wait("wrote .*both.gp"), live.screen.text())
    with open(path, encoding="utf-8") as f:
        titles = re.findall(r'title "([^"]*)"', f.read())
    tests.check("and says which is which", sum("0.5" in t and "\u2212" not in t for t in titles) == sum("\u22120.5" in t for t in titles) >= 3, str(titles))
    live.says("compare FN = 90 N, 110.5 N")
    live.child.send("p\x15" + path + "\r")
    with open(path, encoding="utf-8") as f:
        tests.check("of a force, too", live.wait(lambda s: "wrote" in live.status() and "110.5" in open(path, encoding="utf-8").read()), live.screen.text())
    live.says("compare mu = 0.01, 0.5")
    tests.check("one that cannot follow says why", live.wait("mu = 0.01: .*exceeds"), live.screen.text())
    live.says("compare k = 1 mm, 2")
    tests.check("a wrong comparison", live.wait("error: "), live.screen.text())
    live.says("compare nix = 1, 2")
    tests.check("an unknown name to compare", live.wait("'nix' is no input"), live.screen.text())
    live.says("compare off")
    tests.check("one again", live.wait(lambda s: "mu = 0.5:" not in s.text() and "-- contact" in s.text()),
                live.screen.text())
    live.end()


def stepping(tests):
    script = ("# A lesson\nmaterial steel; geometry sphere R=10 mm\n\n# What will a be?\nfriction 0.4; press FN=100 N\n"
              "x = 3\nstep Fx=20 N\n# The end" + " of a long remark" * 6 + ", all of it\n")
    transcript = "A title\n\nfret> material steel; geometry sphere R=10 mm; friction 0.4\nfret> press FN=100 N\nfret> a\na = 1 m\n"
    with tests.file(script) as path:
        live = Live(tests, path)
        tests.check("a script begins with its comment", live.wait("A lesson"), live.screen.text())
        live.key(" ", "What will a be")
        live.key(" ", r"a +186\.626 um")
        live.key(" ", "x = 3")
        tests.check("space steps", live.key(" ", r"Fx +20 N") and re.search("The end.*\n.*, all of it", live.screen.text()), live.screen.text())
        tests.check("b goes back", live.key("b", r"Fx +0 N"), live.screen.text())
        live.key("b", "back before: x = 3")
        tests.check("and further", live.key("b", "nothing|no load"), live.screen.text())
        for _ in range(3):
            live.key(" ")
        tests.check("and on again", live.wait(r"Fx +20 N"), live.screen.text())
        tests.check("a script is left", live.end() == 0)
    with tests.file(transcript, ".txt") as path:
        live = Live(tests, path)
        live.key("  ")
        tests.check("a transcript is stepped through", live.wait(r"a +186\.626 um"), live.screen.text())
        tests.check("its answers are its own", live.key(" ", "a = 186.626 um"), live.screen.text())
        live.end()


def mouse(tests):
    live = Live(tests)
    live.wait(r"a +186\.626 um")
    def at(button, x, y):
        live.child.send("\x1b[<%d;%d;%d%s" % (button & ~128, x + 1, y + 1, "m" if button & 128 else "M"))
    at(0, 60, 15)
    tests.check("the mouse pulls the point", live.wait(r"step dx="), live.screen.text())
    at(32, 66, 13)
    tests.check("and drags it", live.wait(lambda s: re.match(r"step dx=\d", live.status()) and
                                          live.value("dx")[1] == "nm" and float(live.value("dx")[0]) > 500),
                live.screen.text())
    before = live.value("dx")
    at(128, 66, 13)
    at(35, 50, 13)
    time.sleep(0.2)
    live.read()
    tests.check("and lets it go", live.value("dx") == before, live.screen.text())
    tests.check("the mouse is given back", live.end() == 0 and not live.screen.modes.get(1002) and
                not live.screen.modes.get(1000), str(live.screen.modes))


def slow_line(tests):
    """After a frame that the line was slow to take, frames are left out as long, but no keys: output does not queue up."""
    live = Live(tests)
    live.wait(r"a +186\.626 um")
    side = os.open(os.readlink("/proc/%d/fd/0" % live.child.pid), os.O_RDWR | os.O_NOCTTY)
    termios.tcflow(side, termios.TCOOFF)
    live.child.send("l")
    time.sleep(1)  # it is drawing now
    termios.tcflow(side, termios.TCOON)
    os.close(side)
    seen = set()
    for _ in range(18):
        live.child.send("l")
        live.read()
        seen.add(live.value("Fx"))
    tests.check("each key acts", live.wait(r"Fx +38 N"), live.screen.text())
    tests.check("not each is drawn", len(seen) < 12, str(seen))
    live.key("n", "FNA 10 N")
    live.key("+", "FA 22 N")
    top = live.screen.row(0)
    tests.check("the top line has all of it", "mu 0.4" in top and "cycle FA 22 N FNA 10 N 90 deg 0.5/s [Fx FN]" in top, top)
    tests.check("and it is left", live.end() == 0)


def undisturbed(tests):
    """The progress of a slow statement is not written onto the screen of `live`."""
    live = Live(tests, command=[tests.fret, "--no-rc", "--quiet"])
    live.wait("fret>")
    live.child.send("material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N; cycle FA=20 N; live\r")
    live.wait(r"a +186\.626 um")
    live.child.send(" ")
    end = time.time() + 1.5
    while time.time() < end:
        live.read()
    live.child.send("q")
    live.wait(lambda s: not s.modes.get(1049))
    tests.check("no progress while the screen is another's", live.screen.text() and "Ctrl-C stops it" not in live.raw,
                live.screen.text())
    live.child.send("\x04")
    live.gone()


def saving(tests):
    """Random keys, saved and run again, give the same numbers to the last digit; at the prompt `history` lists their statements."""
    for seed in (1, 2):
        chosen = random.Random(seed)
        live = Live(tests, command=[tests.fret, "--no-rc", "--quiet"])
        live.wait("fret>")
        live.child.send("live\r")
        live.wait(r"a +186\.626 um")
        live.key("llll", r"Fx  8 N")
        for _ in range(50):
            live.child.send(chosen.choice(["\x1b[C", "\x1b[D", "\x1b[A", "\x1b[B", "\x1b[1;2C", "\x1b[1;2D", "l", "l", "H",
                                           "f", "k", "K", "m", "c", "u"]))
            live.read()
        path = os.path.join(tests.dir, "live-%d.fret" % seed)
        live.child.send("s\x15" + path + "\r")
        tests.check("a session is saved", live.wait("wrote "), live.screen.text())
        live.child.send("q")
        live.wait(lambda s: not s.modes.get(1049))
        live.raw = ""
        live.child.send("set format json\r" + SHOWN + "\r1234\r")
        end = time.time() + 60
        while '"name":"1234"' not in live.raw and time.time() < end:
            live.read()
        by_hand = re.findall(r'\{"name":"(\w+)","value":([^,]*),', live.raw)[:11]
        done = tests.run("--format=json", "-f", path, "-c", SHOWN)
        again = re.findall(r'\{"name":"(\w+)","value":([^,]*),', done.stdout)
        tests.check("a session by hand comes out again (%d)" % seed, len(again) == 11 and by_hand == again,
                    "%s\n%s\n%s" % (by_hand, again, open(path, encoding="utf-8").read()))
        live.child.send("\x04")
        live.gone()


def recording(tests):
    """Statements run by keys are recorded, whether the recording began before `live` or in it, and can be replayed."""
    for within in (False, True):
        path = os.path.join(tests.dir, "by-hand-%d.txt" % within)
        live = Live(tests, command=[tests.fret, "--no-rc", "--quiet"])
        live.wait("fret>")
        live.child.send(("live\r" if within else "record " + path + "\rlive\r"))
        live.wait(r"a +186\.626 um")
        if within:
            live.says("record " + path)
            live.wait("record /")
        live.key("ll", r"Fx +4 N")
        live.says("c/a, dx")
        live.wait(r"dx = 114\.748 nm")
        live.key("x", "loop: Fx")
        live.says("step Fx=50 N")
        tests.check("an error of two rows, whole", live.wait(r"\nerror: Fx = 50 N exceeds mu\*FN = 40 N: gross slip; step by displacement \(dx=...\)\nto slide") and
                    "loop: Fx" in live.screen.text(), live.screen.text())
        live.says("show units")
        tests.check("no pager within", live.wait("any other key: back"), live.screen.text())
        live.key("x", "loop: Fx")
        live.child.send("q")
        live.wait(lambda s: not s.modes.get(1049))
        live.child.send("dz\r")
        live.wait("dz = 3.48291 um")
        live.child.send("record off\rW\r")
        tests.check("the prompt goes on", live.wait("W = 2.68594 nJ"), live.raw[-300:])
        live.child.send("\x04")
        live.gone()
        with open(path, encoding="utf-8") as f:
            text = f.read()
        done = tests.run("--replay", path)
        tests.check("by hand, a transcript (%s)" % within, done.returncode == 0 and text.count("fret> step Fx+=2 N\n") == 2 and
                    "dx = 114.748 nm\n" in text and "exceeds" in text and text.endswith("dz = 3.48291 um\n"),
                    tests.report(done) + text)


def child_of(pid):
    with open("/proc/%d/task/%d/children" % (pid, pid), encoding="ascii") as f:
        found = f.read().split()
    return int(found[0]) if found else 0


def rests(pid):
    """Waits until the process has used no time for a while: it waits for keys."""
    def now():
        with open("/proc/%d/stat" % pid, encoding="ascii") as f:
            row = f.read().rpartition(")")[2].split()
        return row[0], row[11], row[12]
    before, alike, end = None, 0, time.time() + 60
    while alike < 10 and time.time() < end:
        time.sleep(0.01)
        before, last = now(), before
        alike = alike + 1 if before[0] == "S" and before == last else 0


ENDS = [("q", None), ("\x03", None), ("", signal.SIGINT), ("", signal.SIGTERM), ("", signal.SIGHUP), ("", signal.SIGQUIT),
        ("", signal.SIGALRM), ("", signal.SIGUSR1), ("", signal.SIGRTMAX), ("", signal.SIGSEGV), ("", signal.SIGABRT), ("", signal.SIGBUS)]


def endings(tests):
    """However the mode ends, the terminal has its modes, its cursor and its screen back."""
    for i, (keys_sent, number) in enumerate(ENDS):
        name = number.name if number else repr(keys_sent)
        files = [os.path.join(tests.dir, "stty-%d-%s" % (i, when)) for when in "ab"]
        script = 'trap : HUP QUIT INT; stty -a > %s; "$FRET" --live; stty -a > %s' % tuple(files)
        live = Live(tests, command=["/bin/sh", "-c", script], FRET=tests.fret,
                    ASAN_OPTIONS=tests.env["ASAN_OPTIONS"] + ":handle_segv=0:handle_abort=0:handle_sigbus=0")
        tests.check("it begins before " + name, live.wait(r"a +186\.626 um"), live.screen.text())
        before = dict(live.screen.modes)
        rests(child_of(live.child.pid))
        if number:
            os.kill(child_of(live.child.pid), number)
        else:
            live.child.send(keys_sent)
        live.gone()
        texts = [open(path, encoding="ascii").read() if os.path.exists(path) else "" for path in files]
        modes = live.screen.modes
        tests.check("the terminal after " + name, texts[0] and texts[0] == texts[1] and before.get(1049) and
                    not before.get(25) and not modes.get(1049) and modes.get(25, True) and not modes.get(1002),
                    "%s\n%s\n%s\n%r" % (texts[0], texts[1], modes, live.raw[-200:]))


def stopping(tests):
    """Ctrl-Z stops the mode, fg continues it."""
    live = Live(tests, command=["/bin/bash", "--norc", "--noprofile", "-i"], PS1="shell> ", FRET=tests.fret)
    live.wait("shell>")
    live.child.send('stty -a > before; "$FRET" --live\r')
    live.wait(r"a +186\.626 um")
    live.key("l", r"step Fx\+=2 N")
    live.child.send("\x1a")
    ok = live.wait(lambda s: not s.modes.get(1049) and "Stopped" in live.raw)
    live.child.send("stty -a > after; cmp before after && echo all sa''me\r")
    tests.check("Ctrl-Z gives the terminal back", ok and live.wait("all same"), live.screen.text())
    live.child.send("fg\r")
    tests.check("fg goes on where it was", live.wait(r"Fx +2 N"), live.screen.text())
    live.key("l", r"Fx +4 N")
    live.child.send("q")
    live.wait(lambda s: not s.modes.get(1049))
    live.child.send("exit\r")
    live.gone()


def lessons(tests):
    """A lesson of `demo` at the prompt, stepped through by keys."""
    live = Live(tests, command=[tests.fret, "--no-rc", "--quiet"], TERM="xterm")
    live.wait("fret>")
    live.child.send("mu = 0.123\rdemo sticking\r")
    tests.check("a lesson asks first", live.wait("Does all of the contact stick") and "c/a = " not in live.raw, live.raw)
    live.child.send(" ")
    tests.check("a key leads to the question", live.wait("guess>") and "c/a = " not in live.raw, live.raw)
    live.child.send("\r")
    tests.check("a key shows the answer", live.wait(r"c/a = 0\.793701") and "c(36 N)/a = " not in live.raw, live.raw)
    live.raw = ""
    live.child.send("b")
    tests.check("b goes back", live.wait(lambda s: "Does all of the contact stick" in live.raw), live.raw)
    live.child.send(" ")
    live.wait(lambda s: "guess> " in live.raw)
    live.child.send("\r")
    live.wait(lambda s: "c/a = 0.793701" in live.raw)
    live.child.send("q")
    live.child.send("mu\r")
    tests.check("q leaves, its scene stays", live.wait(r"mu = 0\.4\n"), live.raw)
    live.child.send("undo; mu\r")
    tests.check("undo brings back the user's", live.wait(r"mu = 0\.123"), live.raw)
    live.child.send("\x04")
    live.gone()


SCENE = "material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N"


def at_prompt(tests, statements):
    """The full-screen mode, started from the prompt after these statements."""
    live = Live(tests, command=[tests.fret, "--no-rc", "--quiet"])
    live.wait("fret>")
    live.child.send(statements + "; live\r")
    live.wait(lambda s: s.modes.get(1049) and "q quit  ? keys" in s.text())
    return live


def works(pid):
    """Waits until the process has computed for a while."""
    def spent():
        with open("/proc/%d/stat" % pid, encoding="ascii") as f:
            return int(f.read().rpartition(")")[2].split()[11]) / os.sysconf("SC_CLK_TCK")
    before = spent()
    while spent() < before + 0.5:
        time.sleep(0.01)


# keys, message in the last row; None: it takes minutes, and is interrupted
SAID = [("c", r"^c0 = 200 um"), (":undo\r", "^undo"), ("k", r"^k = 0\.05, c0 = 200 um"), ("u", "^undo"), ("b", "^undo"), ("m", r"^mu = 0\.42$"), ("M", r"^mu = 0\.4$"),
        ("r", "^press FN=100 N"), ("I", r"step FN\+=500 mN"), ("J", r"step FN\+=-500 mN"),
        ("g", "geometry cone"), ("g", "geometry power n=4"), ("g", "geometry flat-rounded"), ("g", "geometry sphere"),
        (":geometry sum 2:50 m^-1\r", "geometry sum"), ("g", "geometry cone"), (":geometry sphere R=10 mm\r", "sphere"),
        (":press a=0.1 mm\r", "press a=0.1 mm"), ("l", r"step Fx\+="), ("r", r"press a=0\.0001"),
        (":press dz=1 um\r", "press dz=1 um"), ("r", r"press dz=9\.99\d*e-07 m|press dz=1e-06"), ("f", "displacements"), ("f", "forces"),
        (":reset\r", "^reset"), ("l", "nothing is pressed: r presses again"), ("i", "nothing is pressed"),
        ("r", "^press FN=100 N"),
        (":compare\r", "error: expected a name; usage: compare INPUT = VALUES"), (":compare k 1\r", "error: expected = after k"),
        (":compare 3\r", "error: expected a name"), (":compare k = 0.1\r", "error: compare needs two values"),
        (":compare k = 0.1, 0.2, 0.3\r", "error: compare needs two values"),
        (":compare k = nix, 0.2\r", "error: unknown name 'nix'"), (":comparex\r", "error: unknown command 'comparex'"),
        (":  \r", "error: unknown command 'comparex'"), ("\x1bOP", "error: unknown command 'comparex'"), ("x", "error"),
        (":table x for x = 1 .. 2 steps 100000000 to /dev/null\r", None), ("s\x15/nonexistent/x\r", "error: cannot write"),
        ("s\x15" + "x" * 600 + "\r", "the line is too long")]


def corners(tests):
    live = at_prompt(tests, SCENE)
    for i, (keys_sent, says) in enumerate(SAID):
        live.child.send(keys_sent)
        if says is None:
            works(live.child.pid)
            live.screen.cleared = 0
            live.child.send("\x03")
            says = "interrupted"
        if not tests.check("what is said, %d: %r" % (i, keys_sent[:60]),
                           live.wait(lambda s, says=says: re.search(says, live.status())), live.screen.text()):
            break
        if says == "interrupted":
            tests.check("Ctrl-C, and all is drawn anew", live.screen.cleared > 0, live.screen.text())
    head = lambda pattern: lambda screen: re.search(pattern, screen.row(0))  # noqa: E731
    tests.check("the smallest amplitude", live.key("----------", head("FA 2 N")) and live.key("-", None) and
                live.key("[", head(r"FA 2 N.* 0\.25/s")), live.screen.text())
    tests.check("the speed goes from 1/16 to 8 cycles a second", live.key("[" * 6, head(r" 0\.0625/s")) and live.key("]" * 12, head(" 8/s")) and
                live.key("[" * 5, head(r" 0\.25/s")), live.screen.text())
    tests.check("FN swings by up to 40 %", live.key("nnnn", head("FNA 40 N")) and live.key("n", "the cycle holds FN"),
                live.screen.text())
    tests.check("the phase goes round", live.key("a" * 17, "phase of FN against Fx: 345 deg") and
                live.key("a", "phase of FN against Fx: 0 deg"), live.screen.text())
    live.says("quit")
    tests.check("quit leaves the session too", live.gone() == 0)


def typing(tests):
    live = at_prompt(tests, SCENE)
    line = lambda want: lambda s: live.status() == want  # noqa: E731
    for keys_sent, want in ((":so\t", ":so"), ("\x15pr\t", ":press"), ("\x01\x7f\x1b[D", ":press"), ("\x05\x1b[C\x02\x7fssss\x7f\x7f", ":pressss"),
                            ("\x7f\x01\x1b[C\x1b[Cx\x08\x1bOHy\x1bOF z", ":ypresss z"), ("\x15", ":"), ("zzzz\t", ":zzzz"),
                            ("\x15geometry para(\x1b[D\t", ":geometry paraboloid ("), ("\x15\x1b[A", ":"), ("\x1b[B", ":"),
                            ("\u00e4\u20ac\u00fc\x1b[D\x1b[Dx\x1b[C\x7f", ":\u00e4x\u00fc"), ("\x05\x7f\x7f\x7f", ":")):
        tests.check("typed: %r" % keys_sent, live.key(keys_sent, line(want)),
                    "%s\n%s" % (want, live.screen.text()))
    live.key("1 + 1\r", r"1 \+ 1 = 2")
    for i in range(51):
        live.says("%d" % (1000 + i))
    live.wait("1050 = 1050")
    live.child.send(":")
    tests.check("up: the line before", live.key("\x1b[A", line(":1050")), live.screen.text())
    tests.check("and before", live.key("\x1b[A", line(":1049")), live.screen.text())
    tests.check("down again, and empty", live.key("\x1b[B\x1b[B\x1b[B", line(":")), live.screen.text())
    tests.check("fifty are kept", live.key("\x1b[A" * 60, line(":1001")), live.screen.text())
    tests.check("a line longer than the screen", live.key("\x15" + "x" * 90 + "y", lambda s: live.status().endswith("xy") and
                len(live.status()) == 79), live.screen.text())
    tests.check("and than there is room for", live.key("z" * 600 + "\r", "the line is too long|unknown name"), live.screen.text())
    live.says("show commands")
    live.wait("any other key: back")
    top = live.screen.row(1)
    tests.check("a page on, and back", live.key("\x1b[6~", lambda s: s.row(1) != top) and
                live.key("\x1b[5~", lambda s: s.row(1) == top) and live.key("\x1b[B", lambda s: s.row(1) != top) and
                live.key("\x1b[A\x1b[A", lambda s: s.row(1) == top), live.screen.text())
    live.key("q", "loop: Fx")
    live.says("quit")
    live.gone()


def scripted(tests):
    """Scripts: their ends, CRLF line ends, characters of up to four bytes, in a replay; and the report of `set timing on`."""
    with tests.file("") as path:
        live = Live(tests, path)
        tests.check("an empty script", live.wait("the end of the script") and live.key(" ", "cycle FA|error"), live.screen.text())
        live.end()
    with tests.file("x = 1 + \\\r\n 2\r\nx\r\nsystem off\n") as path:
        live = Live(tests, path)
        tests.check("lines that go on", live.key(" ", r"x = 3"), live.screen.text())
        tests.check("back to the beginning", live.key("bb", "back before: x = 1") and
                    live.key("b", "the beginning of the script"), live.screen.text())
        live.end()
    with tests.file("material steel\n# \u07ff \u2265 \uffe6 \U00010000\n") as path:
        done = tests.run("--live", path, env={"LC_ALL": "C.UTF-8"})
    tests.check("signs of two, three and four bytes", done.returncode == 0 and "\u07ff \u2265 \uffe6 \U00010000" in done.stdout, tests.report(done))
    live = at_prompt(tests, "set timing on; set report off; " + SCENE)
    live.key("l", r"Fx +2 N")
    live.child.send("q")
    tests.check("the time of a frame is told", live.wait(r"live: \d+ frames?, [\d.]+ ms of work each, [\d.]+ ms the longest"),
                live.screen.text())
    live.child.send("\x04")
    live.gone()
    for line, status in (("live", 0), ("live " + os.devnull, 0), ("live /nonexistent/x", 1)):
        with tests.file("fret> %s\nfret> 1\n1 = 1\n" % line, ".txt") as path:
            done = tests.run("--replay", path)
            tests.check("replayed: " + line.split("/")[0], done.returncode == status and
                        ("cannot read /nonexistent/x" in done.stdout) == (status == 1), tests.report(done))


def pointing(tests):
    """The mouse does nothing beside the loop, over a page, and while a line is typed."""
    live = Live(tests)
    live.wait(r"a +186\.626 um")
    at = lambda button, x, y, end="M": "\x1b[<%d;%d;%d%s" % (button, x + 1, y + 1, end)  # noqa: E731
    for name, before, after in (("beside the loop", "", ""), ("above it", "", ""), ("over a page", "?", "x"), ("over a line", ":1", "\x1b")):
        live.child.send(before)
        x, y = {"beside the loop": (2, 15), "above it": (60, 1)}.get(name, (60, 15))
        live.child.send(at(0, x, y) + at(32, x + 3, y) + at(0, x + 3, y, "m") + after)
        live.key("f", "displacements dx and dz")
        tests.check("the mouse " + name, live.value("dx")[0] == "0" and "step" not in live.status(), live.screen.text())
        live.key("f", "forces Fx and FN")
    live.end()


def released(tests):
    """Keys after the bodies have separated, and without any scene."""
    live = at_prompt(tests, SCENE)
    live.says("step FN=0 N")
    tests.check("out of contact", live.wait(lambda s: live.value("FN") == ("0", "N") and live.value("c/a") == ("-", "")) and
                live.value("a")[0] == "0", live.screen.text())
    for key, says in (("c", "^c0 = 1 mm"), ("l", "nothing is pressed"), ("r", "^press FN=100 N"), (":reset all\r", "^reset all"),
                      ("+", None), ("g", "^geometry sphere R=10 mm"), (":reset all\r", "^reset all"), (" ", "error: there is no load yet"),
                      ("r", "^material E0=210 GPa")):
        tests.check("then %r" % key, live.key(key, says and (lambda s, says=says: re.search("(?m)" + says, s.text()))), live.screen.text())
    live.says("quit")
    live.gone()


# statements run after a played cycle has been undone: their cycle is another one, which space must not continue
OTHERS = ("cycle FA=15 N FNA=10 N phase=90 deg", "cycle FA=20 N FNA=12 N phase=90 deg", "cycle FA=20 N FNA=10 N phase=60 deg",
          "cycle FA=20 N FNA=10 N phase=90 deg times 2", "cycle dxA=500 nm", "step Fx=2 N")


def gone_on_with(tests):
    """Which cycles space continues, and which it begins anew."""
    live = at_prompt(tests, SCENE + "; cycle FA=5 N")
    live.key("n]]", "FNA 10 N")
    done = lambda s: "> cycle" not in s.row(0)  # noqa: E731
    live.key(" ", r"times 2")
    live.key("  ", done)
    path = os.path.join(tests.dir, "gone-on.fret")
    live.key(" ", r"times [3-9]")
    live.key("  ", done)
    live.child.send("s\x15" + path + "\r")
    live.wait("wrote ")
    with open(path, encoding="utf-8") as f:
        cycles = re.findall("^cycle .*", f.read(), re.M)
    tests.check("as one cycle", len(cycles) == 2 and re.fullmatch(r"cycle FA=20 N FNA=10 N phase=90 deg times \d+", cycles[1]) and
                int(cycles[1].split()[-1]) > 2, str(cycles))
    live.key("u", "undo")
    for other in OTHERS:
        live.key(" ", lambda s: "> cycle" in s.row(0))
        live.key("  ", done)
        live.key("u", "undo")
        live.says(other)
        live.wait(re.escape(other))
        live.key(" ", lambda s: "> cycle" in s.row(0))
        live.key("  ", done)
        live.child.send("s\x15" + path + "\r")
        live.wait("wrote ")
        with open(path, encoding="utf-8") as f:
            said = re.findall("^(?:cycle|step) .*", f.read(), re.M)
        tests.check("begun anew after " + other, len(said) == 3 and said[1].startswith(other) and
                    said[2].startswith("cycle FA=20 N FNA=10 N phase=90 deg"), "\n".join(said))
        live.key("u", "undo")
        live.key("u", "undo")
    live.key(" ", lambda s: "> cycle" in s.row(0))
    live.key("+", lambda s: "FA 22 N" in s.row(0))
    tests.check("an amplitude that changes while it plays is the next cycle's", live.wait("cycle FA=22 N FNA=10 N"), live.screen.text())
    live.wait(r"times [2-9]")
    live.child.send("q")
    live.wait(lambda s: not s.modes.get(1049))
    live.child.send("show\r")
    tests.check("left while it plays, the periods that were seen are said", live.wait(r"cycle FA=22 N FNA=10 N phase=90 deg times \d+"), live.raw[-1500:])
    live.child.send("\x04")
    live.gone()
    # a body on which chords are slow to converge, and a record that tells when a period runs
    live = at_prompt(tests, "material E0=2 MPa nu=0.49 k=-0.3 c0=2 mm; geometry flat-rounded b=0.1 mm R=10 mm; friction 1.3; press FN=1 N")
    record = os.path.join(tests.dir, "periods.txt")
    live.says("record " + record)
    live.key("nn]]]]", "FNA 200 mN .* 8/s")
    live.child.send(" ")
    end = time.time() + 60
    while time.time() < end and not (os.path.exists(record) and "times 2" in open(record, encoding="utf-8").read()):
        live.read()
    tests.check("a period that is interrupted is told of", live.key("\x03", lambda s: live.status() == "error: interrupted"), live.screen.text())
    live.child.send("s\x15" + path + "\r")
    live.wait("wrote ")
    with open(path, encoding="utf-8") as f:
        tests.check("and those before it stay", f.read().splitlines()[-1] == "cycle FA=500 mN FNA=200 mN phase=90 deg")
    live.says("quit")
    live.gone()


def odd_terminals(tests):
    """Terminals with few colours, without mouse, without a name, in another locale; and no terminal."""
    live = Live(tests, command=["/bin/sh", "-c", 'unset TERM; exec "$FRET" --live'], FRET=tests.fret)
    tests.check("a terminal without a name", live.gone() == 1 and "(TERM=)" in live.raw and "try: TERM=xterm" in live.raw, live.raw)
    live = Live(tests, command=["/bin/sh", "-c", '"$FRET" --live > not-a-terminal'], FRET=tests.fret)
    tests.check("a screen that is a file", live.gone() == 1 and "needs a terminal" in live.raw, live.raw)
    with tests.file("# 5 \u00b5m\nmaterial steel\n") as path:
        live = Live(tests, path, LC_ALL="C", TERM="vt100")
        tests.check("signs that the locale does not know", live.wait(r"5 .*m *\n") and live.end() == 0, live.screen.text())
    if shutil.which("tic"):
        with open(os.path.join(tests.dir, "few.ti"), "w", encoding="ascii") as f:
            f.write("few|few colours,\n  colors#8, pairs#4, kmous@, sgr0=\\E[m$<2>, use=xterm,\n")
        where = os.path.join(tests.dir, "terminfo")
        subprocess.run(["tic", "-x", "-o", where, os.path.join(tests.dir, "few.ti")], check=True, capture_output=True)
        live = Live(tests, TERM="few", TERMINFO=where)
        tests.check("a terminal with too few colours for all inks has none", live.wait(r"a +186\.626 um") and
                    not re.search(r"\x1b\[(\d+;)*3\dm", live.raw) and "\x1b[?1002h" not in live.raw, live.screen.text())
        tests.check("and is left", live.end() == 0)


def hung_up(tests):
    """A terminal that disappears without SIGHUP: the mode ends by itself."""
    done = os.path.join(tests.dir, "hung-up")  # the exit status
    live = Live(tests, command=["/bin/sh", "-c", 'trap "" HUP; "$FRET" --live; echo $? > %s' % done], FRET=tests.fret)
    live.wait(r"a +186\.626 um")
    live.child.ptyproc.fileobj.close()  # closes our end once: pexpect must not close the descriptor again
    live.child.ptyproc.closed = live.child.closed = True
    live.child.child_fd = -1
    end = time.time() + 60
    while not (os.path.exists(done) and os.path.getsize(done)) and time.time() < end:
        time.sleep(0.02)
    tests.check("a terminal that is gone", os.path.exists(done), "")


def long_loads(tests):
    """Loads with more points than the curve keeps, and more states than are kept for playing."""
    live = at_prompt(tests, SCENE)
    live.says("cycle FA=20 N FNA=10 N times 9000")
    want = tests.run("-c", SCENE + "; cycle FA=20 N FNA=10 N times 9000; W").stdout.split()
    tests.check("nine thousand periods", live.wait(lambda s: live.value("W") == (want[2], want[3]), 120), live.screen.text())
    live.says("quit")
    live.gone()
    with tests.file(SCENE + "\ncycle FA=20 N FNA=10 N times 12\n") as path:
        live = Live(tests, path)
        live.wait("q quit")
        live.key("]]]]", " 8/s")
        live.key(" ", "> cycle")
        seen, end = set(), time.time() + 60
        while "> cycle" in live.screen.row(0) and time.time() < end:
            live.read()
            seen.add(live.value("W"))
        want = tests.run("-c", SCENE + "; cycle FA=20 N FNA=10 N times 12; W").stdout.split()
        tests.check("twelve periods, played to their end", len(seen) > 1 and live.wait(lambda s: live.value("W") == (want[2], want[3])), "%s\n%s" % (want, live.screen.text()))
        live.end()
    live = at_prompt(tests, SCENE)
    with tests.file("FN [N],Fx [N]\n" + "100,0\n105,9\n" * 150000, ".csv") as path:
        live.says("follow " + path)
        live.wait(r"FN +105 N")
    live.says("step Fx = 5 N")  # its curve is what takes long now
    live.wait(r"step Fx = 5 N")
    live.key(":1 + 1", lambda s: live.status() == ":1 + 1")
    tests.check("a line dropped while the curve is under way", live.key("\x03", lambda s: live.status() == "step Fx = 5 N") and
                live.wait(lambda s: "interrupted" not in s.text() and live.value("Fx")[0] == "5", 5), live.screen.text())
    live.says("quit")
    live.gone()


def in_haste(tests):
    """Two keys at once run two lines of a script: the second line plays, although the screen has not shown the first."""
    with tests.file("# Nothing yet\n" + SCENE + "\nstep Fx=20 N\n") as path:
        live = Live(tests, path)
        live.wait("Nothing yet")
        live.key("[[[", " 0.0625/s")
        tests.check("a step plays", live.key("  ", "> cycle") and live.value("Fx")[0] != "20", live.screen.text())
        tests.check("to its end", live.key(" ", lambda s: "> cycle" not in s.row(0) and live.value("Fx") == ("20", "N")), live.screen.text())
        live.end()
    with tests.file(SCENE + "\ntable sin(x) for x = 1 .. 2 steps 3000000 to /dev/null; step Fx=20 N\n") as path:
        live = Live(tests, path)
        live.wait(r"a +186\.626 um")
        live.key("]]", " 2/s")
        live.child.send(" ")
        tests.check("time that a line takes is not played", live.wait(lambda s: "> cycle" in s.row(0) and 0 < float(live.value("Fx")[0] or 0) < 18, 20),
                    live.screen.text())
        live.end()


def unseen(tests):
    """Scripts played without a terminal: to the end, with `quit` in them, interrupted, without memory, and without a screen."""
    script = "# What will slip?\n" + SCENE + "\nstep Fx=20 N\n# The loop\ncycle FA=30 N\nstep Fx=50 N\n# The end\n"
    with tests.file(script) as path:
        done = [tests.run("-c", "live %s; dW" % path, env=UTF8) for _ in range(2)]
    rows = done[0].stdout.splitlines()
    tests.check("it plays, and the last screen is printed", done[0].returncode == 0 and done[0].stderr == "" and len(rows) == 25 and
                rows[-1] == "dW = 9.01533 uJ" and re.search(r"(?m)^ Fx +30 N", done[0].stdout) and "loop: Fx over dx" in done[0].stdout and
                "The end" in done[0].stdout and re.search("[\u2801-\u28ff]", done[0].stdout), tests.report(done[0]))
    tests.check("the same again", done[0].stdout == done[1].stdout)
    with tests.file(SCENE + "\nstep Fx=2 N; cycle FA=20 N; save json.fret\n") as path:
        told = tests.run("--format=json", "--live", path)
    tests.check("an object for programs", "loop: Fx over dx" in json.loads(told.stdout)["text"], tests.report(told))
    with tests.file(SCENE + "\nstep Fx=50 N\n") as path:
        done = tests.run("--live", path)
    tests.check("what is refused is told there", done.returncode == 0 and "exceeds mu" in done.stdout, tests.report(done))
    tests.check("without a script it needs a terminal", "needs a terminal" in tests.run("-c", "live").stderr)
    with tests.file("press FN=50 N\nstep Fx=2 N; quit\nstep Fx=3 N\n") as path:
        done = tests.run("-c", "%s; live %s\n1 + 1" % (SCENE, path))
    tests.check("quit leaves the script and the program", done.returncode == 0 and "=2 N; quit" in done.stdout and "1 + 1" not in done.stdout, tests.report(done))
    with tests.file("cycle FA=20 N FNA=10 N times 100000\n") as path:
        job = subprocess.Popen([tests.fret, "-c", "%s; live %s\n1 + 1" % (SCENE, path)], stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, env=tests.env, cwd=tests.dir)
        running = at_work(job)
        job.send_signal(signal.SIGINT)
        out, err = job.communicate(timeout=60)
    tests.check("Ctrl-C stops the play", running and job.returncode == 130 and b"1 + 1" not in out, "%s %s %s" % (job.returncode, out, err))
    with tests.file("table x for x = 1 .. 2 steps 100000000 to /dev/null\n2 + 2\n") as path:
        job = subprocess.Popen([tests.fret, "-c", "live %s\n1 + 1" % path], stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=tests.env, cwd=tests.dir)
        running = at_work(job)
        job.send_signal(signal.SIGINT)
        out, err = job.communicate(timeout=60)
    tests.check("and a line of it", running and job.returncode == 130 and b"interrupted" in out and b"1 + 1" not in out and b"2 + 2" not in out,
                "%s %s %s" % (job.returncode, out, err))
    where = os.path.join(tests.dir, "unseen")
    os.mkdir(where)
    for name, text in (("arm", ""), ("disarm", ""), ("s.fret", "step Fx=20 N\n")):
        with open(os.path.join(where, name), "w", encoding="ascii") as f:
            f.write(text)
    script = SCENE + "\nsource arm\nlive s.fret\nsource disarm\nFx\n"
    shim, tool = (os.path.join(os.path.abspath(tests.build), "tests", name) for name in ("faults.so", "calls"))
    if tests.sanitized or not os.path.exists(shim):
        return

    def played(number):
        count = os.path.join(where, "count-%d" % number)
        done = tests.run("--keep-going", "-c", script, cwd=where, env={"LD_PRELOAD": shim, "FAULT": str(number), "FRET_FAULTS": "1", "FAULT_COUNT": count})
        with open(count, encoding="ascii") as f:
            return done, int(f.read())
    right, count = played(0)
    results = []
    tests.each([lambda n=n: results.append((n, played(n)[0])) for n in range(1, count + 1)])
    wrong = ["%d: %s" % (n, tests.report(done)) for n, done in results
             if done.returncode not in (0, 1) or not re.search("memory|no screen", done.stderr + done.stdout) and done.stdout != right.stdout]
    tests.check("a play without memory for all of it", right.returncode == 0 and right.stdout.endswith("Fx = 20 N\n") and count > 50 and not wrong,
                "%d of %d\n%s" % (len(wrong), count, "\n".join(wrong[:3])))
    if not os.path.exists(tool) or subprocess.run([tool, os.devnull, "none", "0", "0", "/bin/true"], check=False, stderr=subprocess.DEVNULL).returncode:
        return
    told = []
    for number in range(1, 9):
        done = subprocess.run([tool, os.path.join(where, "told"), "openat", str(number), "24", tests.fret, "-c", script], cwd=where, env=tests.env,
                              capture_output=True, text=True, check=False)
        told += re.findall(r"(.*): error: no screen can be had to play the script on\n  (.*)\n  (.*)", done.stderr)
    tests.check("no screen to play on", told and set(told) == {("-c:3:1", "live s.fret", "^~~~~~~~~~~")}, str(told))


def dots(rows):
    """The dots of braille signs, as places from the left and from the top."""
    places = ((0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (1, 2), (0, 3), (1, 3))
    return {(2 * x + dx, 4 * y + dy) for y, row in enumerate(rows) for x, sign in enumerate(row) if 0x2800 <= ord(sign) < 0x2900
            for bit, (dx, dy) in enumerate(places) if ord(sign) - 0x2800 >> bit & 1}


def drawn(tests):
    """The energies and the lost energy, dot by dot; the curve of a load that is too long for it; more rings than are kept."""
    def screen(load, rows=50, **env):
        with tests.file("# Drawn\n") as path:
            done = tests.run("-c", "%s\nlive %s" % (load, path), env={**UTF8, "LINES": str(rows), "COLUMNS": "160", **env})
        return done.stdout.splitlines()

    def height(number, scale, high):
        return round((high - 1) * (1 - number / scale))

    def energies(rows):
        first = next(i for i, row in enumerate(rows) if row.startswith("-- energy")) + 1
        last = next(i for i, row in enumerate(rows) if row.startswith(" FN "))
        return dots(row[:63] for row in rows[first:last]), 4 * (last - first), float(re.match(r" *([\d.]+) uJ", rows[first]).group(1))

    cycle = SCENE + "; cycle FA=30 N"
    rows = screen(cycle)
    seen, high, scale = energies(rows)
    ends = [height(v, scale, high) for v in (11.2692, 14.1783)]  # W, U [uJ]
    tests.check("W and U at the end", all(any(abs(y - end) <= 1 for x, y in seen if x > 121) for end in ends) and (0, high - 1) in seen and len(seen) < 400, "%d\n%s" % (len(seen), "\n".join(rows)))
    first = next(i for i, row in enumerate(rows) if "-- lost" in row) + 1
    seen, high = dots(row[64:] for row in rows[first:48]), 4 * (48 - first)
    top = min(y for _, y in seen)
    tests.check("what a cycle loses where", rows[first][64:].startswith("300 J/m^2") and max(x for x, _ in seen) == round(191 * 186.626 / 200) and
                abs(top - height(216.176, 300, high)) <= 1 and any(y == top and abs(x - 191 * 170.035 / 200) <= 1 for x, y in seen), "\n".join(rows))
    rows = screen(cycle + " FNA=10 N phase=90 deg")
    tests.check("not as FN swings", "of a cycle at constant FN" in "\n".join(rows), "\n".join(rows))
    with tests.file("FN [N],Fx [N]\n" + "100,0\n105,9\n" * 6000, ".csv") as path:
        rows = screen(SCENE + "; follow " + path)
        lost = float(tests.run("-c", SCENE + "; follow %s; W/1 uJ" % path).stdout.split()[-1])
    seen, high, scale = energies(rows)
    tests.check("of a long load the end is kept", any(x == 0 and abs(y - height(5 / 12 * lost, scale, high)) <= 1 for x, y in seen) and
                any(x == 125 and abs(y - height(lost, scale, high)) <= 1 for x, y in seen), "%g\n%s" % (lost, "\n".join(rows)))
    rows = screen(SCENE + "".join("; step Fx=%d N" % (i * (-1) ** i) for i in range(36, 0, -1)), 24, LC_ALL="C")
    disc = [row[:63] for row in rows[2:15]]
    tests.check("rings within rings have all slipped", sum(row.count("+") for row in disc) > 50 and not any("#" in row for row in disc), "\n".join(rows))


def stills(tests):
    """The pictures in README.md are what `make figures` makes."""
    where = os.path.join(harness.ROOT, "scripts", "paper")
    for name in ("session", "live"):
        again = os.path.join(tests.dir, name + ".svg")
        with open(os.path.join(where, name + ".svg"), encoding="utf-8") as f:
            want, got = f.read(), None
        for quiet in ("0.7", "6"):  # on a busy machine answers take longer
            if got != want:
                with open(os.path.join(where, name + ".keys"), encoding="utf-8") as f:
                    done = subprocess.run([os.path.join(harness.ROOT, "scripts", "still"), again, "80x32", tests.fret, "--no-rc", "--quiet"], stdin=f,
                                          env={**os.environ, "QUIET": quiet}, capture_output=True, text=True, timeout=120, check=False)
                with open(again, encoding="utf-8") as f:
                    got = f.read()
        tests.check(name + ".svg comes out again", got == want, done.stderr)


def shapes(tests):
    """Screens of other shapes, and views that have too little room."""
    live = at_prompt(tests, SCENE)
    for rows, cols in ((24, 70), (20, 70)):  # first only the columns change, then only the rows
        live.screen.resize(rows, cols)
        live.child.setwinsize(rows, cols)
        live.wait(lambda s: "loop: Fx over dx" in s.text() and "arrows push" in s.row(rows - 2))
    tests.check("a size after the other", live.value("a")[0] == "186.626", live.screen.text())
    live.child.setwinsize(0, 0)
    tests.check("a size of nothing is none", live.key("l", r"Fx +2 N"), live.screen.text())
    for rows, cols in ((12, 44), (24, 30), (4, 60)):
        live.screen.resize(rows, cols)
        live.child.setwinsize(rows, cols)
        if (rows, cols) == (12, 44):
            live.key("n", lambda s: re.fullmatch("cycle FA 20 N FNA 10 N 90 deg 0.5/s .Fx FN.", s.row(0).strip()))
            tests.check("the head without room for what is set", "mu" not in live.screen.row(0) and "sphere" not in live.screen.row(0), live.screen.text())
            live.says("compare mu = 0.3, 0.5")
            tests.check("numbers in one column", live.wait(lambda s: all(len(re.findall(r"(?m)(?:^|\s)%s +\d" % name, s.text())) == 2
                                                                         for name in ("FN", "dz", "c"))), live.screen.text())
            live.says("compare off")
        else:
            tests.check("too small: %dx%d" % (rows, cols), live.wait("too small"), live.screen.text())
    live.key("?", None)
    live.key(" ", None)
    live.key(" ", None)
    live.screen.resize(50, 160)
    live.child.setwinsize(50, 160)
    live.key("n" * 4 + "]]", None)
    live.says("set digits 3")
    tests.check("energies are drawn as they grow", live.key(" ", lambda s: "> cycle" in s.row(0)) and
                live.wait(lambda s: "energy" in s.text() and live.value("W")[0] not in ("", "0", "-") and len(live.value("W")[0]) <= 4), live.screen.text())
    live.says("quit")
    live.gone()
    with tests.file("#\n# One line\n# and another" + " of a long remark" * 14 + ", cut off here\nmaterial steel\n") as path:
        live = Live(tests, path, size=(12, 44))
        tests.check("a note of many rows", live.wait("One line and another") and "cut off here" not in live.screen.text(), live.screen.text())
        live.key("?", "push tangentially")
        tests.check("a page hides the note", "One line" not in live.screen.text() and live.key("x", "One line"), live.screen.text())
        live.end()


def pages(tests):
    live = at_prompt(tests, SCENE)
    live.says("table x for x = 1 .. 100 steps 99")
    top = lambda number: lambda s: s.row(1).split()[:1] == [number]  # noqa: E731
    live.wait("any other key: back")
    tests.check("two pages on and back", live.key(" ", top("21")) and live.key(" ", top("42")) and live.key("\x1b[5~", top("21")) and
                live.key("\x1b[5~", top("x")), live.screen.text())
    tests.check("behind the last page is the screen", live.key(" " * 12, "loop: Fx over dx"), live.screen.text())
    live.says("quit")
    live.gone()


def readable(tests):
    """Long text is wrapped, in the status and on a page; a text too long for the status becomes a page."""
    live = at_prompt(tests, SCENE)
    rows = lambda s: [s.row(i) for i in range(24)]  # noqa: E731
    live.key("?", "push tangentially")
    live.key(" ", "drags the point")
    tests.check("the keys, whole", live.wait(r"All of it is statements: `history`,\n`save` and `undo` know them\."), live.screen.text())
    live.key("x", "loop: Fx")
    live.says("step Fx=50 N")
    tests.check("a message of two rows", live.wait(lambda s: rows(s)[21:] == [
        "q quit  ? keys  arrows push and press  space plays  u undo  r reset  : statement",
        "error: Fx = 50 N exceeds mu*FN = 40 N: gross slip; step by displacement (dx=...)", "to slide"]), live.screen.text())
    live.says("plot traction")
    tests.check("a figure is a page, without the codes of colours", live.wait("any other key: back") and "traction between its bounds" in live.screen.text() and
                "x1b" not in live.screen.text(), live.screen.text())
    live.key("x", "loop: Fx")
    live.says("(%s)" % "+".join(["FN"] * 90))
    tests.check("a message of many is a page", live.wait(lambda s: "any other key: back" in s.row(22) and s.row(4).endswith("= 9 kN")), live.screen.text())
    live.key("x", "loop: Fx")
    live.says("; ".join("x%d = %d" % (i, i) for i in range(12)) + "; explain dW(10 N)")
    live.wait("any other key: back")
    live.screen.resize(24, 44)
    live.child.setwinsize(24, 44)
    words = tests.run("-c", SCENE + "; explain dW(10 N)", env={"LC_ALL": "C.UTF-8"}).stdout.split()
    live.wait(lambda s: s.row(1) and len(s.row(22)) <= 44)
    tests.check("no word of a page is lost", live.wait(lambda s: "\n".join(rows(s)[1:22]).split() == words), live.screen.text())
    live.key("x", "loop: Fx")
    live.says("quit")
    live.gone()


def begun(tests):
    """At the start only inputs that the scene lacks are set; errors of the scene are shown."""
    live = at_prompt(tests, "x = 100 GPa; E0 := 2*x; nu = 0.3; q = 0.15; mu := 2*q")
    tests.check("what follows a definition stays", live.wait(r"a +\d") and "mu 0.3" in live.screen.row(0), live.screen.text())
    live.says("E0, nu, mu")
    tests.check("as it was", live.wait("E0 = 200 GPa") and "mu = 0.3" in live.screen.text(), live.screen.text())
    live.key("x", "loop: Fx")
    live.says("quit")
    live.gone()
    live = at_prompt(tests, "E0 = 200 GPa")
    tests.check("what is missing is told", live.wait("nu is not set|nu is missing|needs nu"), live.screen.text())
    live.says("quit")
    live.gone()


def hostile(tests):
    """Control characters and characters that reverse text are shown escaped: in a script, in answers, and in a typed line."""
    signs = "\u202e \x9b\x1b[2J \u200b"
    shown = "\\u202e \\u009b\\x1b[2J \\u200b"
    with tests.file("# A note %s end\n%s # %s end\n" % (signs, SCENE, signs)) as path:
        live = Live(tests, path)
        tests.check("in a note", live.wait(re.escape("A note %s end" % shown)), live.screen.text())
        tests.check("in a statement", live.key(" ", r"# \\u202e\s+" + re.escape(shown[7:] + " end")), live.screen.text())
        live.child.send(":1 + 1 # \u202e \u00b5 \u200b")
        tests.check("in a line", live.wait(r":1 \+ 1 # \\u202e \u00b5 \\u200b"), live.screen.text())
        tests.check("its cursor", (live.screen.y, live.screen.x) == (23, len(r":1 + 1 # \u202e u \u200b")), "%d %d" % (live.screen.y, live.screen.x))
        tests.check("whose characters are one each", live.key("\x7f\x1b[D\x7f\x1b[D\x1b[Dx", r":1 \+ 1 # x\\u202e *$"), live.screen.text())
        live.key("\r", r"1 \+ 1 = 2")
        live.says("1; 2 # \u202e")
        tests.check("below a page", live.wait(r"any other key: back *\n1; 2 # \\u202e"), live.screen.text())
        live.key("x", "loop: Fx")
        hidden = re.findall("[\u0080-\u00a0\u200b-\u202e]", live.raw)
        tests.check("none reaches the terminal", not hidden, repr(hidden))
        live.end()


def little(tests):
    """Forces below 1 N: the amplitude is half the force of gross slip, and the normal force swings by tenths of itself."""
    live = Live(tests, command=[tests.fret, "-c", "material steel; geometry sphere R=10 mm; friction 0.4; press FN=1 N; live"])
    live.wait(r"FN +1 N")
    tests.check("FN swings, by little", live.key("n", "the cycle swings FN too"), live.screen.text())
    for _ in range(3):
        live.key("n", "the cycle swings FN too")
    tests.check("and is held again", live.key("n", "the cycle holds FN"), live.screen.text())
    tests.check("half of what slides", live.key(" ", r"cycle FA=200 mN"), live.screen.text())
    tests.check("a larger amplitude, by mN", live.key("+", "FA 220 mN"), live.screen.text())
    live.end()


def energies(tests):
    """The scale of the energies is a little above the largest one; the places of the views."""
    scene = "material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N; cycle FA=30 N; "
    rows = tests.run("--format=csv", "-c", scene + "table W, U along program").stdout.split()
    most = max(float(cell) for row in rows[1:] if row[0].isdigit() for cell in row.split(",")[1:])
    live = Live(tests, size=(50, 160), command=[tests.fret, "-c", scene + "live"])
    live.wait(r"Fx +30 N")
    text = live.screen.text()
    scale = re.search(r"-- energy.*\n *([\d.]+) uJ", text)
    tests.check("the scale of the energies", scale and 1.02 * most <= 1e-6 * float(scale.group(1)) <= 1.6 * most, "%g\n%s" % (most, text))
    row = {name: next(i for i, line in enumerate(text.splitlines()) if re.search(name, line)) for name in ("-- contact", "-- energy", r"^ *FN +100")}
    high = [row["-- energy"] - row["-- contact"], row[r"^ *FN +100"] - row["-- energy"]]
    tests.check("the contact has five rows where the energies have four", high[0] == sum(high) * 5 // 9, "%s\n%s" % (high, text))
    live.end()


def completed(tests):
    """Tab in a typed line: candidates with no common beginning, no blank after a word that goes on, a line that is full."""
    live = at_prompt(tests, SCENE)
    for keys_sent, want in ((":\t", ":"), ("\x15press F\t", ":press FN="), ("\x15loss_f\t", ":loss_factor("), ("\x15record of\t", ":record off")):
        tests.check("Tab: %r" % keys_sent, live.key(keys_sent, lambda s, want=want: live.status() == want), live.screen.text())
    live.key("\x151;" + 500 * " " + "geomet\t", lambda s: live.status().endswith("  geometry"))
    tests.check("Tab at the end of what a line holds", live.key("xyz\x1b[D", lambda s: live.status().endswith("  geometryxy") or
                                                                live.status().endswith("  geometry")), live.screen.text())
    live.key("\x151;" + 501 * " " + "geomet\t", lambda s: live.status().endswith("  geometry"))
    tests.check("Tab beyond it", live.key("\x7f", lambda s: live.status().endswith("  geometr")), live.screen.text())
    tests.check("Tab before much else", live.key("\x15geomet " + 300 * "x" + "y\x01" + 6 * "\x1b[C" + "\t\x05", lambda s: live.status().endswith("xy")) and
                live.key("\x01", lambda s: live.status().startswith(":geometry  x")), live.screen.text())
    live.key("\x15live\r", lambda s: "full-screen mode is on already" in live.status())
    tests.check("no screen within the screen", live.key("u", lambda s: "undo" in live.status()), live.screen.text())
    for word in ("on", "off"):
        live.key(":set report %s\r" % word, "set report " + word)
        live.child.send("q")
        live.wait(lambda s: not s.modes.get(1049))
        live.child.send("show settings\r")
        tests.check("what is set there stays set: " + word, live.wait(r"set timing \w+") and
                    "set report %s\n" % word in live.screen.text(), live.screen.text())
        live.child.send("live\r")
        live.wait(lambda s: s.modes.get(1049))
    live.key("q", lambda s: not s.modes.get(1049))
    live.end("\x04")


def dragged(tests):
    """Mouse events that come together, events beside the loop on every side, and another button."""
    live = Live(tests)
    live.wait(r"a +186\.626 um")
    at = lambda button, x, y, end="M": "\x1b[<%d;%d;%d%s" % (button, x + 1, y + 1, end)  # noqa: E731
    for x, y in ((79, 15), (60, 22), (40, 23)):
        live.child.send(at(0, 20, y) + at(32, x, y) + at(0, x, y, "m"))
        live.key("f", "displacements dx and dz")
        live.key("f", "forces Fx and FN")
    tests.check("beside it nothing is pulled", live.value("dx")[0] == "0", live.screen.text())
    live.child.send(at(0, 55, 15) + at(32, 60, 15) + at(0, 66, 15, "m") + at(35, 45, 15))
    tests.check("pressed, dragged and let go at once", live.wait(lambda s: live.value("dx")[1] == "nm" and float(live.value("dx")[0]) > 500), live.screen.text())
    live.child.send(at(0, 60, 15))
    live.wait(lambda s: re.match("step dx=", live.status()) and float(live.value("dx")[0]) < 400)
    before = live.value("dx")
    live.child.send(at(2, 50, 15) + at(2, 50, 15, "m"))
    live.child.send(at(64, 50, 15))
    live.key("f", "displacements dx and dz")
    tests.check("other buttons pull nothing", live.value("dx") == before, "%s\n%s" % (before, live.screen.text()))
    live.child.send(at(0, 60, 15, "m"))
    live.end()


def refused_beside(tests):
    """A comparison with one scene that is not possible."""
    live = at_prompt(tests, SCENE)
    live.says("compare nu = 0.3, 0.7")
    tests.check("a value that no body has", live.wait("nu = 0.7: ") and live.wait(r"a +186\.626 um"), live.screen.text())
    live.says("cycle FA=20 N")
    live.key("]]]] ", lambda s: "> cycle" in s.row(0))
    tests.check("the other plays on", live.key("  ", lambda s: "> cycle" not in s.row(0)) and live.value("Fx")[0] == "20", live.screen.text())
    live.says("compare mu = 0.01, 0.4")
    live.key("l", r"step Fx\+=2 N")
    tests.check("keys go by the other", live.wait(lambda s: live.value("Fx")[0] == "22"), live.screen.text())
    live.child.send("\x1b[<0;41;15M\x1b[<0;41;15m")
    tests.check("and the mouse by its loop", live.wait(r"step dx=-\d") and live.wait(lambda s: float(live.value("dx")[0]) < 0), live.screen.text())
    live.key(" ", r"times [2-9]")
    live.key("  ", lambda s: "> cycle" not in s.row(0))
    live.says("compare off")
    live.says("mu = 0.1")
    tests.check("a load that cannot be any more is told", live.wait("error|exceeds"), live.screen.text())
    live.says("quit")
    live.gone()


def run(tests):
    tests.rooms(completed, hostile, readable, dragged, refused_beside, beginning, refusals, keys, playing, repeating, going_on, sizes, comparing, stepping, mouse, slow_line, undisturbed, saving,
                recording, endings, stopping, lessons, corners, typing, scripted, pointing,
                little, energies, released, gone_on_with, in_haste, odd_terminals, hung_up, long_loads, unseen, drawn, stills, shapes, pages, begun)
