# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests completion by Tab at every kind of place, pasting, the history of sessions side by side, and recording at the prompt."""
import os
import re
import time

import pexpect

from prompt import SCENE, Session, clean, play

INPUTRC = """$if fret
set show-all-if-ambiguous on
set bell-style none
set completion-query-items 0
set page-completions off
$endif
"""

# text typed, words that must be offered, one that must not (or None)
OFFERED = (
    ("plot l", "loop load", "length"),
    ("plot m", "map max min mu", "material"), ("plot loop | ", "pressure map breadth", "for"),
    ("plot a for FN = 1 N .. 2 N log x | dz ", "for along log title", "Fx"), ("plot Fx along cycle FA=2 N | dz for ", "FN= mu=", "steps"),
    ("material s", "steel silicon-nitride", "sphere"),
    ("cycle FA=2 N ", "times steps FNA= phase=", "dxA="),
    ("second r", "rigid rubber", "reset"),
    ("a in ", "um mm cm inch", "Pa"),
    ("press ", "FN= dz= a=", "Fx="),
    ("set format ", "text csv json", "digits"),
    ("set ", "format digits pager plot model", "steel"),
    ("geometry file gap", "gap1.csv gap2.csv", None),
    ("follow gap", "gap1.csv gap2.csv", None),
    ("history to gap", "gap1.csv gap2.csv", None),
    ("source \"gap", "gap1.csv gap2.csv", None),
    ("table a ", "for along with at in", "against"), ("plot a ", "for along with at in against", "dW"), ("table a for ", "FN= k= wobble=", "n="),
    ("table a for FN = 1 N .. 2 ", "N kN lbf steps log with", "mm"),
    ("table a for k = 0 .. 1 with ", "FN= mu=", "n="),
    ("plot a for FN = 1 N .. 2 N over gap", "gap1.csv gap2.csv", None),
    ("table a along ", "program cycle step", "press"),
    ("help se", "second set", "secant"),
    ("help p", "plot press paper paraboloid psi phase p", "program"),
    ("geometry flat-", "flat-cone flat-paraboloid flat-rounded", "file"),
    ("geometry flat-rounded ", "b= R=", "slope="),
    ("step ", "Fx= dx= FN= dz= steps", "FA="),
    ("2*wob", "wobble wobbly(", None),
    ("set model ", "auto closed memory springs", "off"),
    ("2*", "wobble wobbly( breadth a", "zebra"),  # `zebra` has been undone
    ("dW at ", "FN= wobble=", "zebra="),
    ("dW(3 N) in ", "uJ nJ J", "mm"), ("breadth in ", "um mm", "J"), ("(breadth) in ", "um mm", "J"), ("2*a in ", "um mm", "N"),
    ("dW, breadth in ", "um mm", "J"), ("dW(3 N)*2 in ", "uJ mJ", "um"),
    ("plot Fx against ", "dx W breadth", "table"), 
    ("plot loop log x ", "points title log", "FA="), ('plot loop title "a b" ', "points to", "mu"), ("press FN=20k", "kN kgf", "um"), ("press FN=20", "N kN kgf", "um"), ("press FN=20", "lbf", "steps"),
    ("?", "press plot theory", "fricti"), ("undo ", "", "to"), 
    ("friction 0.4 ", "", "mm"), ("nix in ", "um N", None), ("F_A*breadth in ", "um N", None), ("a, 2*breadth, 2*breadth in ", "um mm", "J"),
    ("1 + 1; ", "press plot breadth", None), ("table 3 ", "um N", None), ("press FN=100 N; ", "step cycle", None), ("2 \u00b5", "", "um"), ("x over ", "", "gap1.csv"), ("reset all ", "", "press"),
    ("?set fo", "format", "fricti"), ("a + breadth in ", "um mm", "N"), ("maximize 2*dW in ", "uJ", "um"), ("table a, breadth in ", "um mm", "J"), ("table breadth in ", "um mm", "J"),
    ("plot a for FN = 1 N .. 2 N log x ", "points title", None),
    ("uncertainty breadth ", "with in at samples seed", "along"), ("uncertainty breadth in ", "um mm", "J"),
    ("uncertainty a with ", "FN mu wobble breadth", "dW"), ("solve ", "FN mu wobble", "dW"), ("solve mu ", "for", "steps"),
    ("solve mu for ", "dW a breadth", "FN="), ("solve mu for breadth = 3 mm ", "from", "with"),
    ("solve mu for breadth = 3 mm from ", "a breadth", "to"), ("maximize dWd(", "a breadth", "over"),
    ("maximize breadth ", "over in at", "for"), ("maximize breadth over ", "FN= wobble=", "gap1.csv"),
    ("plot accuracy ", "FA= dxA= within", "against"), ("table a for k = 0 .. 1 ", "for along with", "press"), ("record ", "gap1.csv", "off"),
    ("solve FN for a = 2 ", "um from", "N"), ("step Fx=3 ", "N steps dz=", "um"), ("cycle FA=2 N times 3 ", "steps FNA=", "um"),
    ("help set ", "format press", None), ("set plot terminal ", "dumb block", "slide"), ("plot a log ", "x xy", "z"),
    ("export jenkins 3 ", "to FA=", "um"), ("plot map ", "breadth dWd(", "against"), ("plot loop | map breadth ", "for in", "breadth"), ("k = 0.5, c0 = 1 ", "mm um", "N"), ("table dW along cycle FA=2 ", "N times log", "um"),
    ("fit mu ", "for along to", "steps"), ("fit mu for ", "a breadth", "FN="),
    ("fit mu along gap", "gap1.csv gap2.csv", None), ("fit mu for breadth = 2*a to gap", "gap1.csv gap2.csv", None),
)
# text typed that has no completion
ENDED = ("undo 3 ", "export jenkins ", "friction 0.4", "friction 0.4 ", "nu = 0.3", "nu = 0.3 ", "set digits 3", "geometry file gap1.csv smooth ", "undo ", "reset all ", "x over ", "friction 0.4 zebr", "2 \u00b5", "# FN", "set digits 3 f")
# text typed, and its only completion
DONE = (
    ("explain a a", "t "), ("explain a at k=0 c", "onditioning "), ("cycle FA=2 N t", "imes "), ("a in u", "m "), ("material st", "eel "), ("table a f", "or "), ("1 + " * 140 + "breadt", "h "), ("geometry file gap1.csv s", "mooth "), ("second ri", "gid "),
    ("step dx=1 u", "m "), ("table a for FN ", "="), ("uncertainty a with mu ", "+- "), ("geometry flat-r", "ounded "), ("record o", "ff "), ("x = 3*kap", "pa "), ("?apr", "opos "),
    ("reset ", "all "), ("geometry file gap1.csv h", "eight "), ("loop gap1.csv us", "ing "),
    ("geometry file gap1.csv smo", "oth "), ("1; fric", "tion "), ("dW at m", "u="), ("wobbl", "e"), ("1;  fric", "tion "),
    ("?the", "ory "), ("wobbly(2) in ", "% "),
)


def offers(tests):
    with open(os.path.join(tests.dir, "inputrc"), "w", encoding="ascii") as f:
        f.write(INPUTRC)
    here = os.path.join(tests.dir, "tab")
    os.mkdir(here)
    for name in ("gap1.csv", "gap2.csv"):
        with open(os.path.join(here, name), "w", encoding="ascii") as f:
            f.write("r [mm],f [um]\n0,0\n")
    s = Session(tests, INPUTRC=os.path.join(tests.dir, "inputrc"), TERM="dumb", cwd=here)
    for line in (SCENE, "press FN=100 N", "cycle FA=20 N", "wobble = 3", "wobbly(x) = x", "breadth = 3 mm", "zebra = 3", "undo"):
        s.say(line)
    for i, (typed, words, other) in enumerate(OFFERED):
        s.child.send(typed + "\t\x15%d\r" % (7000 + i))  # when this has come the list is complete
        s.child.expect("%d = %d" % (7000 + i, 7000 + i))
        listed = clean(s.child.before).partition("\n")[2].partition("fret> ")[0].split()
        tests.check("Tab after `%s`" % typed, set(words.split()) <= set(listed) and other not in listed,
                    "%s\n%s" % (words, " ".join(listed)))
        s.prompt()
    for typed, rest in DONE:
        s.child.send(typed + "\t")
        try:
            s.child.expect_exact(typed[-20:] + rest, timeout=60)
            ok = True
        except pexpect.TIMEOUT:
            ok = False
        tests.check("Tab completes `%s`" % typed, ok, clean(s.child.before or ""))
        s.child.sendintr()
        s.prompt()
    for typed in ENDED:
        s.child.send(typed + "\t~")
        ok = s.child.expect_exact([typed + "~", "~"], timeout=60) == 0
        tests.check("Tab leaves `%s`" % typed, ok or "\u00b5" in typed, clean(s.child.before or ""))
        s.child.sendintr()
        s.prompt()
    s.child.sendeof()
    tests.check("completion leaves", s.end() == 0)


# text typed, with Tabs, and the script that is named: names that need quotation marks get them
QUOTED = (("source pl\t", "plain.fret"), ("source sp\t", "sp ace.fret"), ("source \"sp\t", "sp ace.fret"), ("source ha\t", "ha#sh.fret"),
          ("source ha#s\t", "ha#sh.fret"), ("source se\t", "se;mi.fret"), ("source my\tin\t", "my dir/in ner.fret"), ("source my\tpl\t", "my dir/plain.fret"),
          ("source \"my dir/in\t", "my dir/in ner.fret"), ("source tw\t1\t", "two x1.fret"), ("source \"tw\t2\t", "two x2.fret"), ("source ./sp\t", "sp ace.fret"),
          ("1; source sp\t; 2", "sp ace.fret"), ("source eq=\t", "eq=1,2.fret"), ("source eq=1,\t", "eq=1,2.fret"))


def quotes(tests):
    here = os.path.join(tests.dir, "quotes")
    os.makedirs(os.path.join(here, "my dir"))
    names = sorted({name for _, name in QUOTED})
    for i, name in enumerate(names):
        with open(os.path.join(here, name), "w", encoding="ascii") as f:
            f.write("1 + %d000\n" % (i + 1))
    for term in ("dumb", "xterm"):
        s = Session(tests, "--quiet", TERM=term, cwd=here)
        for typed, name in QUOTED:
            told = s.say(typed)
            tests.check("Tab quotes: `%s` in %s" % (typed, term), re.search(r"^1 \+ %d000 = " % (names.index(name) + 1), told, re.M) and "error" not in told, told)
        s.child.sendeof()
        s.end()


def paste(s, text):
    s.child.send("\x1b[200~" + text + "\x1b[201~\r")


def pasting(tests):
    s = Session(tests)
    paste(s, "material steel\ngeometry sphere R=10 mm\nfriction 0.4\n# a comment\n\npress FN=100 N\na\n")
    s.child.expect(r"a = 186.626 um\r")
    tests.check("lines pasted run one by one", "error" not in s.child.before, clean(s.child.before))
    s.prompt()
    paste(s, "fret> step Fx=20 N\n  Fx = 20 N, dx = 625.995 nm, c = 148.125 um\nfret> dx + \\\n....> 1 um\nfret> c")
    s.child.expect(r"c = 148.125 um\r")
    s.child.expect(r"1.6\d* um")
    s.child.expect(r"c = 148.125 um\r")
    tests.check("prompts pasted are taken off, answers left out", "error" not in s.child.before, clean(s.child.before))
    s.prompt()
    tests.check("and all of it happened", s.say("Fx") == "Fx = 20 N")
    for length in (63, 64, 65):  # readline reads a paste into 64 bytes at first
        s.child.send("\x1b[200~" + "x" * length)
        s.child.sendintr()
        s.prompt()
        tests.check("a paste of %d bytes that is cut off" % length, s.say("1 + 1") == "1 + 1 = 2", clean(s.child.before))
    paste(s, "fret> mu")
    s.child.expect("mu = 0.4")
    s.prompt()
    tests.check("a decimal comma gets a hint", "write 1.5 for one" in s.say("1,5 mm"))
    tests.check("a list does not", "write" not in s.say("a, c, dx"))
    s.child.sendeof()
    tests.check("pasting leaves", s.end() == 0)


def histories(tests):
    one = Session(tests)
    two = Session(tests, XDG_STATE_HOME=one.state)
    for i in range(3):
        one.say("1%d" % i)
        two.say("2%d" % i)
    for s in (one, two):
        s.child.sendeof()
        s.end()
    with open(os.path.join(one.state, "fret", "history"), encoding="utf-8") as f:
        kept = f.read().split()
    tests.check("two sessions keep their lines", kept == ["10", "20", "11", "21", "12", "22"], str(kept))
    s = Session(tests, XDG_STATE_HOME=one.state)
    s.child.send("\x12" + "2")
    time.sleep(0.2)
    s.child.send("1\r")
    s.child.expect("21 = 21")
    tests.check("Ctrl-R finds a line of another session", True)
    s.prompt()
    s.child.sendeof()
    s.end()


TYPED = ("friction 0.4", "material steel; geometry sphere R=10 mm", "press FN=100 N", "foo",
         "step Fx=50 N", "step Fx=20 N", "?c", "1,5 mm", "cycle FA=20 N", "plot loop", "set timing on", "dW",
         "set timing off", "!echo past the session", "table Fx along cycle steps 4", "set format json", "a", "help a",
         "press FN=3", "set format text", "1 + ; 2", "explain dW", "demo", "a, dz", "k =")


def recorded(tests):
    """A session with errors, continuation lines and a paste can be replayed, both its recording and a copy of the terminal."""
    path = os.path.join(tests.dir, "session.txt")
    s = Session(tests, "--color=always", LC_ALL="C.UTF-8", dimensions=(60, 120))
    s.say("mu = 0.3")
    s.child.logfile_read = shown = open(os.path.join(tests.dir, "shown"), "w", encoding="utf-8")
    s.say("record " + path)
    for line in TYPED:
        if line == "demo":
            play(s, line)
        else:
            s.child.sendline(line)
        s.child.sendline("4321 + %d" % len(line))
        s.child.expect(r"4321 \+ %d(?: =|\",).*\r" % len(line))
        s.prompt()
    s.child.send("dx + \\\r")
    s.child.expect(r"\.\.\.\.> ")
    s.say("1 um")
    paste(s, "fret> a\na = 186.626 um\nfret> step \\\n....> Fx=-5 N\nfret> Fx")
    s.child.expect(r"Fx = -5 N\r")
    s.prompt()
    for line in ("save history " + os.path.join(tests.dir, "typed.fret"), "save " + os.path.join(tests.dir, "scene.fret")):
        s.say(line)
    s.say("record off")
    shown.close()
    s.child.logfile_read = None
    done = tests.run("--replay", path)
    tests.check("a recorded session replays", done.returncode == 0, tests.report(done))
    tests.check("it begins with the scene", re.match(r"# fret [0-9.]+\nfret> friction 0.3 # as it was\n", open(path, encoding="utf-8").read()))
    report = s.say("replay " + path)
    tests.check("replay in a session", report.endswith("0 failed"), report)
    tests.check("leaves the scene", s.say("Fx") == "Fx = -5 N")
    s.child.sendeof()
    s.end()
    done = tests.run("-c", "source %s; Fx, dx, mu" % os.path.join(tests.dir, "scene.fret"))
    tests.check("a saved scene", done.stdout.startswith("Fx = -5 N\n") and done.stdout.endswith("mu = 0.4\n"),
                tests.report(done))
    with open(os.path.join(tests.dir, "typed.fret"), encoding="utf-8") as f:
        typed = f.read()
    tests.check("save history", typed.startswith("mu = 0.3\nrecord ") and "dx +  \\\n1 um\n" in typed, typed)


def slowly(tests, s):
    """A slow statement shows its progress, and wipes it at the end."""
    for name, rows in (("load", ["FN [N],Fx [N]"] + ["%d,%d" % (100 + i % 7, i % 11) for i in range(60000)]),
                       ("depth", ["force [N],depth [um]"] + ["%d,%d" % (1 + i % 997, 2 + i % 997) for i in range(100000)])):
        with open(os.path.join(tests.dir, name + ".csv"), "w", encoding="ascii") as f:
            f.write("\n".join(rows))
    s.say("reset; press FN=100 N; cycle FA=20 N")
    for statement, shown, setup in (
            ("animate springs | loop frames 500 to a.gif", r"animate: \d+ %|gnuplot draws 500 frames", ""),
            ("cycle FA=20 N times 10000", r"cycle: \d+ s", "set model springs 5000000"),
            ("follow load.csv", r"follow: \d+ (%|s)", "reset; press FN=100 N"),
            ("step Fx=15 N", r"step: \d+ s", "reset; press FN=100 N; set report off; cycle FA=10 N times 100000; set report auto"),
            ("fit E0 for depth = dz(force) to depth.csv", r"fit: \d+ s",
             "reset; set model auto; geometry flat-rounded b=1 mm R=10 mm; press FN=100 N; set cores 1"),
            ("export jenkins 1000 to a.csv", r"export: \d+ s", "set model auto"),
            ("accuracy within 60", r"accuracy: \d+ s", "set model auto"))[:2 if tests.few else None]:
        s.say(setup)
        scene = s.say("set pager off; show")
        s.child.sendline(statement)
        try:
            s.child.expect("(" + shown + r").*\(Ctrl-C stops it\)", timeout=120)
            ok = True
        except pexpect.TIMEOUT:
            ok = False
        s.child.sendintr()
        tests.check("progress of " + statement, ok and "interrupted" in s.prompt(), clean(s.child.before))
        tests.check("interrupted, it changes nothing: " + statement, s.say("show") == scene, scene + clean(s.child.before))
    s.say("set model auto")


def screens(tests):
    """Tests what depends on the terminal: the pager, progress, carets."""
    s = Session(tests, PAGER="sed s/^/PAGED:/", dimensions=(10, 100))
    tests.check("a pager for what does not fit", s.say("help").splitlines()[0].startswith("PAGED:fret: partial"))
    tests.check("none for what does", s.say("help pi").startswith("pi: "))
    lines = tests.run("-c", "help solve").stdout.splitlines()
    for wide in (max(map(len, lines)), max(map(len, lines)) - 1, 30):
        rows = 1 + sum(max(1, -(-len(line) // wide)) for line in lines)
        for high in (rows, rows - 1):
            small = Session(tests, PAGER="sed s/^/PAGED:/", dimensions=(high, wide))
            small.child.sendline("help solve")
            small.child.sendline("7123")
            small.child.expect("7123 = 7123")
            said = clean(small.child.before)
            small.prompt()
            tests.check("a pager where lines wrap: %dx%d" % (wide, high), ("PAGED:" in said) == (high < rows), said)
            small.child.sendeof()
            small.end()
    s.say("set pager off")
    tests.check("none when it is off", s.say("help").startswith("fret: partial"))
    s.say("set pager on")
    tests.check("always when it is on", s.say("help pi").startswith("PAGED:pi: "))
    s.say("set format json")
    tests.check("none for JSON", s.say("help").startswith('{"text":"fret: partial'))
    s.say("set format text; set pager auto")
    path = os.path.join(tests.dir, "paged.txt")
    s.say("record " + path)
    s.say("help")
    s.say("record off")
    with open(path, encoding="utf-8") as f:
        tests.check("what is paged is recorded", "fret> help\nfret: partial" in f.read())
    s.say(SCENE)
    s.say("press FN=100 N; cycle FA=20 N")
    s.child.sendline("table qx(0.1 mm) for mu = 0.3 .. 0.5 steps 1000000 to t.csv")
    s.child.expect(r"table: \d+ %(, \d+ s to go)? \(Ctrl-C stops it\)", timeout=120)
    s.child.sendintr()
    tests.check("a long table shows progress", "interrupted" in s.prompt())
    s.child.sendline("uncertainty qx(0.1 mm) with mu +- 0.02 samples 100000")
    s.child.expect(r"uncertainty: \d+ %(, \d+ s to go)? \(Ctrl-C stops it\)", timeout=120)
    s.prompt()
    tests.check("an answer begins on a clean line", re.search(r"\r +\rqx\(0.1 mm\) = ", s.child.before), repr(s.child.before[-300:]))
    s.child.sendline("set model springs 1000000; cycle dxA=0.1 um FNA=10 N phase=20 deg times 1000000")
    s.child.expect(r"cycle: \d+ s \(Ctrl-C stops it\)", timeout=120)
    s.child.sendintr()
    tests.check("a long cycle shows progress", "interrupted" in s.prompt())
    s.say("set model auto")
    slowly(tests, s)
    tests.check("an error points into the line", "  1 + foo\n      ^~~" in s.say("1 + foo"))
    tests.check("not where it is all of it", "^" not in s.say("foo"))
    s.child.sendeof()
    tests.check("screens leave", s.end() == 0)


def run(tests):
    tests.rooms(offers, quotes, pasting, histories, recorded, screens)
