# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests the full-screen mode while it plays or computes: the numbers agree with those of the same statements in a plain session,
nothing jumps, no statement is lost."""
import fcntl
import math
import os
import re
import shutil
import signal
import struct
import subprocess
import termios
import time

from live import SCENE, Live, at_prompt, child_of, works

SWUNG = "cycle FA=20 N FNA=10 N phase=90 deg"


def scene_of(tests, size, statements, *args, **env):
    """The full-screen mode after these statements, on a screen of this size."""
    live = Live(tests, command=[tests.fret, "-c", statements + "; live " + " ".join(args)], size=size, **env)
    live.wait(lambda s: s.modes.get(1049) and "q quit  ? keys" in s.text())
    return live


def plain(tests, statements, name):
    """A value as a plain session prints it."""
    return tuple(tests.run("-c", statements + "; " + name).stdout.split()[2:])


def curve_ends(live):
    """Does the curve of W end at the height of the number, on a scale a little above it?"""
    rows = live.screen.text().splitlines()
    top, bottom = (next((i for i, row in enumerate(rows) if re.search(what, row)), 0) for what in ("-- energy", "^ FN "))
    unit = {"": 1, "m": 1e-3, "u": 1e-6, "n": 1e-9}
    scale, lost = re.match(r" *([\d.]+) (\w?)J", rows[top + 1]), live.value("W")
    if not scale or lost[1][-1:] != "J":
        return False
    part = float(lost[0]) * unit[lost[1][:-1]] / float(scale.group(1)) / unit[scale.group(2)]
    last = live.screen.cols * 2 // 5 - 2
    ends = [i for i in range(top + 1, bottom) if re.search("[\u2801-\u28ff]", rows[i][last - 1:last + 1])]
    high = bottom - top - 1
    return 1 / 1.6 <= part <= 1 / 1.02 and ends and abs(ends[0] - top - 1 - (1 - part) * high) < 1.5


def energies(tests):
    """The curve of W ends at the number's height, also after repeated periods that were skipped, and after playing was cut short."""
    statement = "cycle FA=20 N FNA=10 N times 40"
    want = plain(tests, "%s; %s" % (SCENE, statement), "W")
    for name in ("said", "played"):
        if name == "said":
            live = scene_of(tests, (50, 130), SCENE + "; " + statement)
        else:
            with tests.file("%s\n%s\n" % (SCENE, statement)) as path:
                live = Live(tests, path, size=(50, 130))
                live.wait("q quit|end of the script")
                live.key(" ", "> cycle")
            live.key(" ", lambda s: "> cycle" not in s.row(0))
        tests.check("the energies of forty periods, " + name, live.wait(lambda s: live.value("W") == want and curve_ends(live)),
                    "%s\n%s" % (want, live.screen.text()))
        live.end()


def compared(tests):
    """A comparison that begins while a cycle plays, or after: both sides move together, and end at the values of plain sessions."""
    live = at_prompt(tests, SCENE)
    live.key("]]", " 2/s")
    live.key(" ", "> cycle")
    live.says("compare mu = 0.3, 0.5")
    tests.check("a comparison ends what plays", live.wait(lambda s: "mu = 0.5: " in s.text() and "> cycle" not in s.row(0)), live.screen.text())
    live.key(" ", "> cycle")
    both = lambda: re.findall(r" dx {2}(\S+ \S+)", live.screen.text())  # noqa: E731
    seen, end = set(), time.time() + 60
    while len(seen) < 6 and time.time() < end:
        live.read()
        seen.add(tuple(both()))
    tests.check("both play", len({one[0] for one in seen if len(one) == 2}) > 2 and len({one[-1] for one in seen if len(one) == 2}) > 2, str(seen))
    live.key("  ", lambda s: "> cycle" not in s.row(0))
    times = int((re.search(r"times (\d+)", live.status()) or [0, 1])[1])
    live.says("compare off")
    live.wait(lambda s: "mu = 0.5: " not in s.text())
    tests.check("off again", live.value("Fx") == ("20", "N"), live.screen.text())
    live.says("compare mu = 0.5, 0.01")
    tests.check("one that cannot follow", live.wait("mu = 0.01: .*exceeds"), live.screen.text())
    live.key(" ", r"times \d+")
    tests.check("lets the other one play on", live.wait(lambda s: int((re.search(r"times (\d+)", live.status()) or [0, 0])[1]) > times + 1), live.screen.text())
    live.says("compare mu = 0.01, 0.5")
    live.wait("mu = 0.01: .*exceeds")
    live.key(" ", lambda s: "> cycle" not in s.row(0))
    live.says("compare mu = 0.3, 0.5")
    path = os.path.join(tests.dir, "compared.fret")
    live.says('save "%s"' % path)
    live.wait(lambda s: live.status().startswith('save "'))
    want = [" ".join(plain(tests, "source %s; mu = %g" % (path, mu), "W")) for mu in (0.3, 0.5)]
    losses = lambda: re.findall(r" W {3}(\S+ \S+)", live.screen.text())  # noqa: E731
    tests.check("shown as in plain sessions", live.wait(lambda s: losses() == want), "%s\n%s" % (want, live.screen.text()))
    live.says("quit")
    tests.check("and left", live.gone() == 0)


def stopped(tests):
    """While the program is stopped no time passes: a period of four seconds that is stopped for five is not over."""
    live = at_prompt(tests, SCENE)
    live.key("[", " 0.25/s")
    live.key(" ", lambda s: "> cycle" in s.row(0) and live.value("Fx")[0] not in ("0", "20"))
    before = live.value("W")
    os.kill(live.child.pid, signal.SIGSTOP)
    while live.read(0.2):
        pass
    live.raw = ""
    time.sleep(5)
    os.kill(live.child.pid, signal.SIGCONT)
    live.wait(lambda s: "FN" in live.raw)
    tests.check("a cycle goes on where it was stopped", "times" not in live.status() and live.value("dW")[0] == "-" and live.wait(lambda s: live.value("W") != before),
                "%s\n%s" % (before, live.screen.text()))
    live.says("quit")
    live.gone()


def measured(tests, rows):
    """Writes a long measured load, which ends in gross slip."""
    path = os.path.join(tests.dir, "measured-%d.csv" % rows)
    with open(path, "w", encoding="ascii") as f:
        f.write("FN [N],Fx [N]\n" + "".join("%.6g,%.6g\n" % (100 + 20 * math.sin(0.7 * i), 25 * math.sin(0.31 * i) * (0.5 + 0.5 * math.sin(0.001 * i)))
                                            for i in range(rows)))
    return path


def long_ways(tests):
    """Loads of many steps: the end state is not shown before playing has begun; the picture shows the last part of the curve."""
    for rows in (150, 20001):
        statements = "%s; follow %s; step dx=30 um" % (SCENE, measured(tests, rows))
        live = scene_of(tests, (50, 130), statements)
        tests.check("%d rows" % rows, live.wait(lambda s: live.value("W") == plain(tests, statements, "W") and live.value("dx") == ("30", "um")), live.screen.text())
        tests.check("the last of them, %d" % rows, live.wait(lambda s: curve_ends(live)), live.screen.text())
        live.key("[[[", " 0.0625/s")
        live.child.send("k ")
        live.wait("> cycle")
        was = live.value("Fx")
        tests.check("what plays is shown from its beginning, %d" % rows, was == ("40", "N") or was[0] not in ("20", "-", ""), live.screen.text())
        tests.check("and plays, %d" % rows, live.wait(lambda s: live.value("Fx") not in (was, ("20", "N"))), live.screen.text())
        live.key("  ", lambda s: "> cycle" not in s.row(0))
        live.end()


# scenes and loads; the last ones with other models
SCENES = (SCENE, SCENE + "; step Fx=20 N; step FN=80 N Fx=10 N", SCENE + "; cycle FA=20 N times 3", SCENE + "; " + SWUNG + " times 2",
          "material E0=70 GPa nu=0.33 k=-0.4 c0=2 mm; geometry cone slope=0.03; friction 0.25; press dz=3 um; step dx=1 um; step dx=-0.2 um",
          "material E0=1 MPa nu=0.5 k=0.8 c0=3 mm; second rigid; geometry flat-rounded b=2 mm R=50 mm; friction 1.2; press FN=3 N; cycle dxA=0.3 mm; step FN=1 N",
          "material steel; geometry sum 2:50 m^-1, 4:2e6 m^-3; friction 0.4; press FN=10 N; step Fx=3 N; step Fx=-1 N FN=12 N",
          "material steel; geometry exact-sphere R=1 mm; friction 0.4; press a=0.2 mm; step dx+=1 nm; step FN=0 N",
          "material steel; geometry paraboloid R=1 um; friction 0.1; press FN=1e-30 N; step Fx=1e-32 N",
          SCENE + "; step Fx=20 N; step Fx=-5 N; set model springs 100")
NAMES = ("FN", "Fx", "dx", "dz", "a", "c", "c/a", "W", "U", "dW", "kt")


def digits(tests):
    """The numbers on the screen are those of a plain session, in all digits."""
    for scene in tests.some(SCENES):
        live = scene_of(tests, (42, 150), scene + "; set digits 12")
        told = tests.run("--keep-going", "-c", "%s; set digits 12\n" % scene + "".join("%s\n" % name for name in NAMES))
        want = {name: "-" for name in NAMES}
        want.update(re.findall(r"(?m)^(\S+) = (.*)$", told.stdout))
        want = {name: tuple((value + " ").split(" ")[:2]) for name, value in want.items()}
        ok = live.wait(lambda s, want=want: all(live.value(name) == want[name] for name in NAMES))
        tests.check("as in a plain session: " + scene[-50:], ok, "%s\n%s" % (want, live.screen.text()))
        live.end()


def begins_anew(tests):
    """Space begins a new cycle if the phase has changed or a step has followed the last one."""
    live = at_prompt(tests, SCENE)
    live.key("n]]]", "cycle FA 20 N FNA 10 N 90 deg 4/s")
    done = lambda s: "> cycle" not in s.row(0)  # noqa: E731
    for keys_sent in ("", "a", "l"):
        live.key(keys_sent + " ", lambda s: "> cycle" in s.row(0))
        live.key("  ", done)
    path = os.path.join(tests.dir, "anew.fret")
    live.child.send("s\x15" + path + "\r")
    live.wait("wrote ")
    with open(path, encoding="utf-8") as f:
        said = [re.sub(r" times \d+", "", line) for line in f.read().splitlines() if re.match("cycle|step", line)]
    tests.check("begun anew", said == [SWUNG, SWUNG.replace("90", "105"), "step Fx+=2 N", SWUNG.replace("90", "105")] or
                said[2][:8] == "step Fx=" and len(said) == 4, "\n".join(said))
    live.says("quit")
    live.gone()
    with tests.file(SCENE + "\nstep Fx=20 N\nstep Fx+=0 N\nx = 3\n") as path:
        live = Live(tests, path)
        live.wait("q quit")
        live.key(" ", "> cycle")
        live.key(" ", lambda s: "> cycle" not in s.row(0) or "+=0" in live.status())
        if "+=0" not in live.status():
            live.key(" ", lambda s: "+=0" in live.status())
        tests.check("a step that moves nothing is over at once", live.wait(done) and live.value("Fx") == ("20", "N"), live.screen.text())
        live.end()


def read_alike(tests):
    """Scripts are read as by `fret FILE`: backslashes in comments, prompts of continued lines, long lines, a backslash at the end."""
    for name, text in (("a comment's mark", "# C:\\\nx = 1 + \\\n 2\ny = x\n"), ("a transcript", "A title\nfret> x = 1 + \\\n....> 2\nx = 3\nfret>\nfret> y = x\n"),
                       ("a long line", "x = 3%s\ny = x\n" % (" + 0" * 200)), ("its end", "x = 3\r\ny = 2 \\\r\n + 1 \\"), ("a form feed", "x = 3 \x0c\ny = 3\n")):
        with tests.file(text) as path:
            done = tests.run("--keep-going", "-c", "live %s\nx, y" % path)
            alike = tests.run("--keep-going", "-c", "source %s\nx, y" % path) if not text.startswith("A title") else None
        tests.check("read alike: " + name, done.stdout.endswith("\n" + ("x = 3\ny = 3\n" if alike is None else alike.stdout)), tests.report(done) + (tests.report(alike) if alike else ""))


def signals(tests):
    """Changes of size and Ctrl-Z while a statement runs take effect at its end; a terminal that disappears while the program is stopped."""
    live = Live(tests, command=["/bin/bash", "--norc", "--noprofile", "-i"], PS1="shell> ", FRET=tests.fret, TERM="vt100", LC_ALL="C")
    live.wait("shell>")
    live.child.send('stty -a > before-vt; "$FRET" --live\r')
    live.wait(r"a +186\.626 um")
    pid = child_of(live.child.pid)
    live.says("table x for x = 1 .. 2 steps 100000000 to /dev/null")
    works(pid)
    live.screen.resize(30, 100)
    live.child.setwinsize(30, 100)
    live.child.send("\x03")
    tests.check("a size that came meanwhile", live.wait(lambda s: "interrupted" in s.row(29) and "loop: Fx over dx" in s.text()), live.screen.text())
    live.says("table x for x = 1 .. 2 steps 100000000 to /dev/null")
    works(pid)
    os.kill(pid, signal.SIGTSTP)
    os.kill(pid, signal.SIGINT)
    tests.check("a stop that came meanwhile", live.wait(lambda s: "Stopped" in live.raw), live.screen.text())
    live.child.send("stty -a > after-vt; cmp before-vt after-vt; fg\r")
    tests.check("goes on without a mouse", live.wait(lambda s: "interrupted" in s.row(29)) and "\x1b[?1002h" not in live.raw, live.screen.text())
    live.child.setwinsize(24, 0)
    tests.check("a size without columns is none", live.key("l", r"Fx +2 N"), live.screen.text())
    live.child.send("q")
    live.child.send("cmp before-vt after-vt || echo diff''ers\rexit\r")
    live.gone()
    live = Live(tests)
    live.wait(r"a +186\.626 um")
    side = os.open(os.readlink("/proc/%d/fd/0" % live.child.pid), os.O_RDWR | os.O_NOCTTY)
    termios.tcflow(side, termios.TCOOFF)
    live.child.send("l")
    time.sleep(0.5)  # it is drawing now
    os.kill(live.child.pid, signal.SIGINT)
    time.sleep(0.1)
    termios.tcflow(side, termios.TCOON)
    os.close(side)
    tests.check("Ctrl-C while it draws", live.gone() == 0 and not live.screen.modes.get(1049), live.screen.text())
    done = os.path.join(tests.dir, "gone-while-stopped")
    live = Live(tests, command=["/bin/sh", "-c", 'trap "" HUP; "$FRET" --live; echo $? > %s' % done], FRET=tests.fret)
    live.wait(r"a +186\.626 um")
    pid = child_of(live.child.pid)
    os.kill(pid, signal.SIGSTOP)
    live.child.ptyproc.fileobj.close()
    live.child.ptyproc.closed = live.child.closed = True
    live.child.child_fd = -1
    os.kill(pid, signal.SIGCONT)
    end = time.time() + 60
    while not (os.path.exists(done) and os.path.getsize(done)) and time.time() < end:
        time.sleep(0.02)
    tests.check("a terminal that went meanwhile", os.path.exists(done) and os.path.getsize(done) > 0)


def halves(tests):
    """Only standard input, or only standard output, is a terminal."""
    live = Live(tests, command=["/bin/sh", "-c", '"$FRET" --live < /dev/null'], FRET=tests.fret)
    tests.check("keys from elsewhere", live.gone() == 1 and "needs a terminal" in live.raw, live.raw)
    with tests.file("step Fx=20 N\n") as path:
        live = Live(tests, command=["/bin/sh", "-c", '"$FRET" -c "%s; live %s; Fx" > half' % (SCENE, path)], FRET=tests.fret)
        status = live.gone()
    with open(os.path.join(tests.dir, "half"), encoding="utf-8") as f:
        text = f.read()
    tests.check("a screen elsewhere: a script plays", status == 0 and "loop: Fx over dx" in text and text.endswith("\nFx = 20 N\n"), "%s\n%s" % (text, live.raw))


def mice(tests):
    """The mouse in the loop of the second scene does nothing; events that come together."""
    at = lambda button, x, y, end="M": "\x1b[<%d;%d;%d%s" % (button, x + 1, y + 1, end)  # noqa: E731
    live = at_prompt(tests, SCENE)
    pulled = lambda: re.findall(r" dx {2}(\S+ \S+)", live.screen.text())  # noqa: E731
    live.says("compare mu = 0.4, 0.5")
    live.wait("mu = 0.5: ")
    live.child.send(at(0, 60, 12) + at(32, 66, 12) + at(0, 66, 12, "m"))
    live.key("f", "displacements dx and dz")
    tests.check("the loop of the second scene is not pulled", re.findall(r" dx {2}(\S+ \S+)", live.screen.text()) == ["0 m", "0 m"], live.screen.text())
    live.child.send(at(0, 24, 12))
    tests.check("that of the first is", live.wait(r"step dx="), live.screen.text())
    first = pulled()
    live.child.send(at(32, 26, 12) + at(32, 28, 12) + at(32, 30, 12) + at(0, 30, 12, "m") + at(0, 30, 12, "m"))
    live.child.send(at(0, 24, 12) + at(32, 30, 12, "m") + at(0, 26, 12) + at(0, 32, 12, "m"))
    live.wait(lambda s: pulled() != first, 5)
    live.child.send(at(0, 24, 12))
    live.wait(lambda s: pulled() == first, 5)
    live.child.send(at(32, 26, 12) + at(32, 28, 12) + at(32, 32, 12))
    live.wait(lambda s: pulled() != first, 5)
    live.child.send(at(32, 30, 12) + at(0, 30, 12, "m"))
    tests.check("several events at a time", live.wait(lambda s: pulled() != first and pulled()[0].endswith("um")), live.screen.text())
    live.key("f", "forces Fx and FN")  # so that all events before it have been read
    before = pulled()
    live.child.send(at(35, 20, 12))
    live.key("f", "displacements dx and dz")
    tests.check("let go", pulled() == before, live.screen.text())
    live.says("quit")
    live.gone()


def taken(live):
    """Waits until the program has read all that was sent."""
    time.sleep(0.2)
    side, end = os.open(os.readlink("/proc/%d/fd/0" % live.child.pid), os.O_RDWR | os.O_NOCTTY), time.time() + 60
    while struct.unpack("i", fcntl.ioctl(side, termios.FIONREAD, b"\0" * 4))[0] and time.time() < end:
        time.sleep(0.01)
    os.close(side)


def little_room(tests):
    """A page on four rows; numbers reduced to one digit for lack of room."""
    live = at_prompt(tests, SCENE)
    live.key("?", "push tangentially")
    top = live.screen.row(3)
    live.raw = ""
    live.screen.resize(4, 80)
    live.child.setwinsize(4, 80)
    live.wait(lambda s: "too small" in live.raw)
    live.child.send("  \x1b[B\x1b[A")
    taken(live)
    live.screen.resize(24, 80)
    live.child.setwinsize(24, 80)
    tests.check("pages of a row each", live.wait(lambda s: s.row(1) == top), "%s\n%s" % (top, live.screen.text()))
    live.key("x", "loop: Fx over dx")
    live.screen.resize(24, 64)
    live.child.setwinsize(24, 64)
    live.says("compare k = 0, 0")
    live.says("set digits 1")
    tests.check("one digit, cut off where it has no room", live.wait(lambda s: len(re.findall(r"kt +4e\+0", s.text())) == 2), live.screen.text())
    live.says("quit")
    live.gone()


def descriptions(tests):
    """Odd terminal descriptions: the bytes that end the mode are cut to the room for them, and sent without padding."""
    if not shutil.which("tic"):
        return
    where = os.path.join(tests.dir, "odd-terminfo")
    source = os.path.join(tests.dir, "odd.ti")
    with open(source, "w", encoding="ascii") as f:
        f.write("odd|odd ends,\n  rmkx=\\E[?1l$<5>\\E>, cnorm=\\E]0;$5 $<$x\\007\\E[?25h, rmcup=\\E]0;%s\\007\\E[?1049l, use=xterm,\n" % ("x" * 300))
    subprocess.run(["tic", "-x", "-o", where, source], check=True, capture_output=True)
    live = Live(tests, TERM="odd", TERMINFO=where, ASAN_OPTIONS=tests.env["ASAN_OPTIONS"] + ":handle_segv=0")
    live.wait(r"a +186\.626 um")
    raw = len(live.raw)
    os.kill(live.child.pid, signal.SIGTERM)
    live.child.expect(["\x1b\\[\\?25h", "no such thing"], timeout=60)
    tests.check("what an end sends", "$<5>" not in live.child.before and "\x1b[?1l\x1b>" in live.child.before, repr((live.raw[raw:], live.child.before)))
    live.child.close()


def memory(tests):
    """Memory runs out while a cycle plays on, or a long load is run: an error, and the scene is the one that is shown."""
    shim = os.path.join(os.path.abspath(tests.build), "tests", "faults.so")
    if tests.sanitized or not os.path.exists(shim):
        return
    for name in ("arm", "disarm"):
        with open(os.path.join(tests.dir, name), "w", encoding="ascii"):
            pass
    fault = {"LD_PRELOAD": shim, "FRET_FAULTS": "1"}
    answer = 256 + 16  # the first allocation for the answer of a statement
    seen = []
    for number in range(1, 6):
        live = Live(tests, FAULT_SIZE=str(answer), FAULT=str(number), **fault)
        live.wait(r"a +186\.626 um")
        live.key("]]]", " 4/s")
        live.says("source arm")
        live.wait("source arm")
        live.key(" ", r"FA=20 N times 3|out of memory")
        told = live.status()
        if "memory" not in told:
            live.key("  ", lambda s: "> cycle" not in s.row(0))
        shown = live.value("Fx")
        live.says("source disarm")
        live.says("Fx")
        tests.check("memory for a cycle that is played, %d" % number, live.wait(" ".join(("Fx =",) + shown)), "%s\n%s\n%s" % (told, shown, live.screen.text()))
        seen.append(re.sub(r"\d+$", "", told))
        live.end()
    # pictures and curves: allocations of exactly their sizes
    live = Live(tests, size=(50, 130))
    live.wait(r"a +186\.626 um")
    rows = live.screen.text().splitlines()
    high = next(i for i, row in enumerate(rows) if row.startswith(" FN ")) - next(i for i, row in enumerate(rows) if "-- energy" in row) - 1
    live.end()
    live = Live(tests, size=(50, 130), FAULT_SIZE=str(14 * (high * (130 * 2 // 5 - 1) + 1)), FAULT="1", **fault)
    live.wait(r"a +186\.626 um")
    live.says("source arm")
    tests.check("memory for a picture", live.wait(r"-- energy.*\nout of memory") and live.key("f", "displacements dx and dz") and
                live.wait(lambda s: "out of memory" not in s.text()), live.screen.text())
    live.end()
    points = 0
    while points < 500:
        points += points + 1 + 16  # as arrays grow
    grown = str(points * 40)  # the points of a curve
    live = Live(tests, FAULT_SIZE=grown, FAULT="1", **fault)
    live.wait(r"a +186\.626 um")
    live.says("source arm; follow " + measured(tests, 200))
    tests.check("memory for a way", live.wait("out of memory"), live.screen.text())
    live.says("step Fx=5 N")
    tests.check("which is gone again", live.wait(r"Fx +5 N") and "out of memory" not in live.screen.text(), live.screen.text())
    live.end()
    tests.check("memory for what is said of it", {"out of memory: undo", "out of memory: cycle FA=20 N times "} <= set(seen), str(seen))


def run(tests):
    tests.rooms(stopped, digits, long_ways, energies, compared, begins_anew, read_alike, signals, halves, mice, little_room, descriptions, memory)
