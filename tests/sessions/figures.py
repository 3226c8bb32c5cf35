# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests pictures in files and in the terminal: their format, hostile names, and that no temporary files are left."""
import os
import tempfile
import re
import shutil
import signal
import struct
import subprocess
import sys
import time
import xml.etree.ElementTree

SCENE = "material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N; cycle FA=38 N\n"
ENDINGS = ("png", "svg", "pdf", "tex", "html", "gif", "gp")


def read(path):
    with open(path, "rb") as f:
        return f.read()


def folder(tests, name):
    return tempfile.mkdtemp(prefix=name + "-", dir=tests.dir)


def clean(tests, name, where, wanted=()):
    """Checks that only the wanted files are there, and no temporary files."""
    tests.check("%s: files" % name, sorted(os.listdir(where)) == sorted(wanted), str(os.listdir(where)))


def texts(svg):
    return "".join(xml.etree.ElementTree.fromstring(svg).itertext())


def forms(tests):
    where = folder(tests, "forms")
    done = tests.run("-c", SCENE + "".join("plot loop to a.%s\n" % e for e in ENDINGS), cwd=where)
    if not tests.check("pictures of every kind", done.returncode == 0, tests.report(done)):
        return
    clean(tests, "pictures of every kind", where, ["a." + e for e in ENDINGS])
    data = {e: read(os.path.join(where, "a." + e)) for e in ENDINGS}
    tests.check("PNG", data["png"][:8] == b"\x89PNG\r\n\x1a\n" and struct.unpack(">II", data["png"][16:24]) == (900, 675))
    tests.check("GIF", data["gif"][:6] == b"GIF89a" and struct.unpack("<HH", data["gif"][6:10]) == (900, 675))
    tests.check("PDF", data["pdf"][:5] == b"%PDF-" and b"%%EOF" in data["pdf"][-10:])
    for kind, text in (("SVG", data["svg"]), ("HTML", data["html"].replace(b"<!DOCTYPE html>", b"")
                                              .replace(b'<meta charset="utf-8">', b""))):
        words = texts(text)
        tests.check("%s: names of the axes" % kind, all(word in words for word in ("δ", "F", "[N]", "[µm]")), words[-500:])
    tests.check("HTML needs no other file", b"src=" not in data["html"] and b"xlink:href=\"http" not in data["html"])
    tests.check("TeX: names of the axes", b"$\\delta _{x}$" in data["tex"] and b"$F_{x}$" in data["tex"])
    if shutil.which("gnuplot"):
        again = subprocess.run(["gnuplot", "-e", "set terminal dumb", "a.gp"], cwd=where, capture_output=True, text=True)
        tests.check("a kept script runs", again.returncode == 0 and "+---" in again.stdout, again.stdout + again.stderr)
    size = tests.run("-c", "set plot 80x24\n" + SCENE + "plot loop to b.png", cwd=where)
    head = read(os.path.join(where, "b.png"))[16:24] if size.returncode == 0 else b"\0" * 8
    tests.check("a picture's size is not the terminal's", struct.unpack(">II", head) == (900, 675), tests.report(size))
    for paper, want in (("slide", (1280, 720)), ("column", (640, 480)), ("slide; set plot auto", (900, 675))):
        size = tests.run("-c", "set plot %s\n" % paper + SCENE + "plot loop to b.png; plot map x*y for x = 1 .. 2 for y = 1 .. 2 to b.svg", cwd=where)
        head = read(os.path.join(where, "b.png"))[16:24] if size.returncode == 0 else b"\0" * 8
        tests.check("a picture for " + paper, struct.unpack(">II", head) == want, tests.report(size))
        shown = tests.run("-c", "set plot %s; show settings" % paper).stdout
        tests.check("the setting of " + paper, ("set plot %s\n" % paper in shown) == (";" not in paper), shown)
    tex(tests, where)


def captions(tests):
    """The caption below a figure (scene and load), in pictures of all kinds and in the terminal."""
    where = folder(tests, "captions")
    plots = "set plot caption on\nplot loop | pressure to a.%s\nplot map dWd(d) for FN = 1 N .. 2 N for d = 1 um .. 2 um to m.%s\n"
    done = tests.run("-c", SCENE + "".join(plots % (e, e) for e in ENDINGS if e != "gif") + "plot pressure", cwd=where)
    line = re.compile(r"\n *material E0=210 GPa nu=0.3; geometry sphere R=10 mm; friction 0.4\npress FN=100 N; cycle FA=38 N; fret [0-9.]+\n$")
    tests.check("a caption in the terminal", done.returncode == 0 and line.search(done.stdout), tests.report(done))
    for name in ("a", "m"):
        lines = texts(read(os.path.join(where, name + ".svg")))
        tests.check("a caption in " + name, all(word in lines for word in ("geometry sphere R=10 mm", "cycle FA=38 N", "fret 1.")), lines[-400:])
        head = read(os.path.join(where, name + ".png"))[16:24]
        tests.check("room for it in " + name, struct.unpack(">II", head)[1] > 675, str(head))
    done = tests.run("--format=json", "-c", SCENE + "set plot caption on; plot loop", cwd=where)
    tests.check("a caption in JSON", done.returncode == 0 and done.stdout.count("\n") == 3 and "cycle FA=38 N; fret" in done.stdout.splitlines()[-1],
                tests.report(done))


def tex(tests, where):
    if not shutil.which("pdflatex"):
        return
    found = subprocess.run(["kpsewhich", "tikz.sty"], capture_output=True)
    if found.returncode:
        return
    with open(os.path.join(where, "paper.tex"), "w", encoding="utf-8") as f:
        f.write("\\documentclass{article}\\usepackage{tikz}\\usetikzlibrary{plotmarks}\n"
                "\\begin{document}\\input{a}\\input{a}\\end{document}\n")
    done = subprocess.run(["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "paper"], cwd=where,
                          capture_output=True, text=True, errors="replace", timeout=120)
    tests.check("TeX takes the figure", done.returncode == 0, done.stdout[-2000:])


def keys(tests):
    """The key of a panel stands below the name of its axis; with larger texts the numbers along the axis stay apart."""
    where = folder(tests, "keys")
    for paper in ("auto", "slide", "column"):
        for name in ("x", "x+1000000", "x+1000000000", "x+10000000000000000000", "x" + "+100000" * 6):
            curves = ", ".join(name + "+%d" % i for i in range(6))
            done = tests.run("-c", "set plot %s; plot %s for x = -700 .. 700 | x for x = 0 .. 1 to a.svg" % (paper, curves), cwd=where)
            at = re.findall(r'translate\([\d.]+,([\d.]+)\)[^>]*>\s*<text>(.*?)</text>', read(where + "/a.svg").decode()) if not done.returncode else []
            at = [(float(y), re.sub("<.*?>|\\s", "", text)) for y, text in at]
            label, key = [y for y, text in at if text == "x"], [y for y, text in at if re.match(r"x\+[^,]*\d$", text)]
            tests.check("a key on paper %s, %d long" % (paper, len(name)), len(key) == 6 and label and min(key) - label[0] > 12,
                        tests.report(done) + str(at))
            numbers = [text for y, text in at if y == max(v for v, t in at if t == "0") and text.endswith("00")]
            tests.check("numbers on paper " + paper, (len(numbers) <= 4) == (paper != "auto"), str(numbers))


def points_of(path):
    """The blocks of points in a gnuplot script that was kept."""
    blocks = re.findall(r"^\$data\S+ << END\n(.*?)^END$", read(path).decode(), re.S | re.M)
    return [[tuple(map(float, line.split())) for line in block.splitlines()] for block in blocks]


def points(tests):
    """Figures have as many points as were asked for, at the right places."""
    where = folder(tests, "points")
    done = tests.run("-c", "plot x^2 for x = 0 .. 1 steps 4 to a.gp; plot x, 2*x for x = 0 .. 2 to b.gp\n" + SCENE +
                     "plot loop to c.gp; set format json; dx in um, Fx", cwd=where)
    if not tests.check("points", done.returncode == 0, tests.report(done)):
        return
    tests.check("five points", points_of(where + "/a.gp") == [[(i / 4, i * i / 16) for i in range(5)]])
    one, two = points_of(where + "/b.gp")
    tests.check("101 points", len(one) == len(two) == 101 and all(
        abs(x - i / 50) < 1e-8 and abs(y - x) < 1e-8 and abs(z - 2 * x) < 1e-8
        for i, ((x, y), (_, z)) in enumerate(zip(one, two))), str(one[:3] + two[-3:]))
    own = tests.run("-c", "plot x, 3*x against x^2, x^3 against 2*x for x = 1, 2, 5 to d.gp", cwd=where)
    curves = [[(x * x, x) for x in (1, 2, 5)], [(x * x, 3 * x) for x in (1, 2, 5)], [(2 * x, x ** 3) for x in (1, 2, 5)]]
    if tests.check("curves against expressions of their own", own.returncode == 0, tests.report(own)):
        tests.check("each over its own", points_of(where + "/d.gp") == curves, str(points_of(where + "/d.gp")))
        os.remove(where + "/d.gp")
    own = tests.run("-c", "set plot 60x12\n" + SCENE + "plot Fx against dx, Fx against Fx/kt along program")
    tests.check("each is told by its own", own.stdout.splitlines()[0].split() == ["Fx", "[N]"] and "against Fx/kt" in own.stdout and
                "Fx against " in own.stdout, tests.report(own))
    (loop,) = points_of(where + "/c.gp")
    dx, Fx = (float(value) for value in re.findall(r'"value":([^,]*),', done.stdout))
    tests.check("a loop begins and ends", len(loop) > 200 and loop[0] == (0, 0) and abs(loop[-1][0] / 1e6 - dx) < 1e-7 * dx
                and abs(loop[-1][1] - Fx) < 1e-7 * Fx, str(loop[:2] + loop[-2:]))
    done = tests.run("-c", "set plot 40x12\nplot x for x = 0 .. 1 steps 1")
    rows = [line.rstrip() for line in done.stdout.splitlines()]
    marks = [line.find("*") for line in rows[1:10]]
    tests.check("a line in the terminal, from the first column to the last", rows[9].startswith(" 0.0 **---") and
                rows[1].endswith("--**") and marks == sorted(marks, reverse=True) and marks[-1] == 5, done.stdout)
    rows = tests.run("-c", "set plot 60x12\nplot x^2 for x = 1 .. 1e6 log log xy").stdout.splitlines()
    tests.check("decades along the axes in the terminal", [rows[i].split()[0] for i in (1, 4, 6, 9)] == ["1e+12", "1e+08", "10000", "1"]
                and rows[10].split() == ["1", "100", "10000", "1e+06"], "\n".join(rows))
    for kind in ("dumb", "block"):
        rows = tests.run("-c", SCENE + "set plot terminal %s; set plot 30x20; plot springs" % kind).stdout.splitlines()
        tests.check("numbers below a narrow page, " + kind, ["-500", "0", "500"] in [row.split() for row in rows], "\n".join(rows))
    for lo in (1, 10, 100, 10000):
        rows = tests.run("-c", "set plot 60x12; plot x for x = %d .. %d log; plot x^2 for x = %d .. %d log to l.svg" % (2 * (lo, 10 * lo)),
                         cwd=where).stdout.splitlines()
        numbers = [re.sub("<.*?>", "", text) for text in re.findall("<text>(.*?)</text>", read(where + "/l.svg").decode())]
        tests.check("numbers at both ends of a logarithmic axis from %d" % lo, rows[10].split() == [str(lo), str(10 * lo)] and
                    [str(n * lo) in numbers for n in (1, 2, 5, 10)] == 4 * [True], str(rows[10:]) + str(numbers))
        os.remove(where + "/l.svg")
    done = tests.run("-c", SCENE + "plot loop to x.png", cwd=where, env={"TMPDIR": "/nonexistent"})
    tests.check("no folder for gnuplot", done.returncode == 1 and "cannot make a temporary file in /nonexistent"
                in done.stderr, tests.report(done))
    clean(tests, "no folder for gnuplot", where, ["a.gp", "b.gp", "c.gp"])


def names(tests):
    """File names that a shell or gnuplot would execute, also in a directory with a path longer than any fixed buffer."""
    where = folder(tests, "names")
    wanted = ["|touch pwned #.png", "`touch pwned`.svg", "$(touch pwned).png", "a'b.png", "%s.png", "-x.svg", "é µ.svg"]
    for name in wanted:
        done = tests.run("-c", SCENE + 'plot loop to "%s"' % name, cwd=where)
        tests.check("a picture named " + name, done.returncode == 0, tests.report(done))
    clean(tests, "hostile names", where, wanted)
    deep = """
import os, subprocess, sys
os.chdir(sys.argv[1])
for i in range(22):
    os.mkdir('d' * 200)
    os.chdir('d' * 200)
done = subprocess.run([sys.argv[2], '-c', sys.argv[3] + 'plot loop to "|touch pwned #.png"'], capture_output=True)
print(done.returncode, done.stderr.decode(), sorted(os.listdir('.')))
for name in os.listdir('.'):
    os.unlink(name)
for i in range(22):
    os.chdir('..')
    os.rmdir('d' * 200)
"""
    done = subprocess.run([sys.executable, "-c", deep, where, tests.fret, SCENE], capture_output=True, text=True,
                          env=tests.env, timeout=120)
    tests.check("a hostile name in a deep directory", re.match(r"0 wrote \|touch pwned #\.png \([\d.]+ kB\)\n "
                r"\['\|touch pwned #\.png'\]$", done.stdout),
                done.stdout + done.stderr)


def targets(tests):
    where = folder(tests, "targets")
    for name in ("real.svg", "old.svg"):
        with open(os.path.join(where, name), "w", encoding="ascii") as f:
            f.write("old")
    os.chmod(os.path.join(where, "old.svg"), 0o640)
    os.symlink("real.svg", os.path.join(where, "link.svg"))
    done = tests.run("-c", SCENE + "plot loop to link.svg\nplot loop to old.svg", cwd=where)
    tests.check("pictures over others", done.returncode == 0, tests.report(done))
    tests.check("a link stays a link", os.path.islink(os.path.join(where, "link.svg")) and
                read(os.path.join(where, "real.svg")).startswith(b"<?xml"))
    tests.check("a mode stays", os.stat(os.path.join(where, "old.svg")).st_mode & 0o777 == 0o640)
    clean(tests, "pictures over others", where, ["real.svg", "old.svg", "link.svg"])
    done = tests.run("-c", SCENE + "cycle FA=38 N times 3 steps 400000\nplot loop to big.svg", cwd=where)
    size = os.path.getsize(os.path.join(where, "big.svg")) if done.returncode == 0 else 0
    tests.check("a million points are thinned", 1000 < size < 300000, "%d bytes\n%s" % (size, tests.report(done)))


def stopped(tests):
    """gnuplot hangs: a signal ends the program and gnuplot, and all files are removed."""
    where = folder(tests, "stopped")
    fake = folder(tests, "stopped-bin")
    with open(os.path.join(fake, "gnuplot"), "w", encoding="ascii") as f:
        f.write("#!/bin/sh\nsleep 300 & echo $$ >'%s/pid'; wait\n" % fake)
    os.chmod(os.path.join(fake, "gnuplot"), 0o755)
    pid_file = os.path.join(fake, "pid")
    for sent, status in ((signal.SIGINT, 130), (signal.SIGTERM, -signal.SIGTERM), (signal.SIGHUP, -signal.SIGHUP),
                         (signal.SIGQUIT, -signal.SIGQUIT)):
        tmp = os.path.join(fake, "tmp-%d" % sent)
        os.mkdir(tmp)
        job = subprocess.Popen([tests.fret, "-c", SCENE + "plot loop to x.png"], cwd=where, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, start_new_session=True,
                               env={**tests.env, "PATH": fake + ":" + tests.env["PATH"], "TMPDIR": tmp})
        for _ in range(3000):
            if os.path.exists(pid_file) and os.path.getsize(pid_file):
                break
            time.sleep(0.01)
        group = int(read(pid_file))
        os.unlink(pid_file)
        job.send_signal(sent)
        out, err = job.communicate(timeout=60)
        name = "stopped by %s" % sent.name
        tests.check(name, job.returncode == status, "%d\n%s" % (job.returncode, (out + err).decode()))
        clean(tests, name, where)
        clean(tests, name + ": temporary", tmp)
        for _ in range(1000):  # killed processes take a moment to end
            if not alive(group):
                break
            time.sleep(0.01)
        tests.check(name + ": gnuplot is gone", not alive(group))


def alive(group):
    for name in os.listdir("/proc"):
        if name.isdigit():
            try:
                with open("/proc/%s/stat" % name, encoding="ascii", errors="replace") as f:
                    fields = f.read().rpartition(")")[2].split()
            except OSError:
                continue
            if fields[0] != "Z" and int(fields[2]) == group:
                return True
    return False


def messages(tests):
    """Messages of gnuplot are shown with control characters escaped."""
    fake = folder(tests, "messages-bin")
    with open(os.path.join(fake, "gnuplot"), "w", encoding="ascii") as f:
        f.write("#!/bin/sh\nprintf 'line 3: \\033[31mred\\007 \\342\\200\\256back\\n' >&2; exit 1\n")
    os.chmod(os.path.join(fake, "gnuplot"), 0o755)
    done = tests.run("-c", SCENE + "plot loop", env={"PATH": fake + ":" + tests.env["PATH"]})
    tests.check("gnuplot's message", done.returncode == 1 and "gnuplot failed: \\x1b[31mred\\x07 \\u202eback" in done.stderr and
                not re.search("[\033\007\u202e]", done.stderr), tests.report(done))


def foreign_terminal(tests):
    """The user's setting of gnuplot's terminal (GNUTERM), which may not exist, is not used for plots."""
    want = tests.run("-c", SCENE + "plot loop")
    for terminal in ("qt", "nonsense", "png"):
        done = tests.run("-c", SCENE + "plot loop", env={"GNUTERM": terminal})
        tests.check("GNUTERM=" + terminal, done.returncode == 0 and done.stdout == want.stdout and len(done.stdout) > 500, tests.report(done))


def run(tests):
    tests.each([lambda one=one: one(tests) for one in (forms, keys, captions, points, names, targets, stopped, messages, foreign_terminal)])
