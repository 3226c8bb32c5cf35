# SPDX-License-Identifier: GPL-3.0-or-later
"""Broken input, missing programs, full disks, interrupts, no memory: each must give a clear message and exit status."""
import contextlib
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import time

from harness import ROOT, at_work

SCENE = "material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"
LONG = SCENE + "table dW(F) for F = 1 N .. 30 N steps 50000000 to %s\n"


def expect(tests, name, done, status, out=None, err=None):
    """Checks the exit status, and that these words are in the output and in the messages."""
    ok = (done.returncode == status and "Sanitizer" not in done.stderr and "runtime error" not in done.stderr
          and (out is None or out in done.stdout) and (err is None or err in done.stderr))
    tests.check(name, ok, "expected exit %s, %r, %r\n%s" % (status, out, err, tests.report(done)))


def manual(tests, page):
    return subprocess.run(["sh", os.path.join(ROOT, "scripts", "manual"), page, tests.fret], capture_output=True, text=True,
                          env=tests.env, timeout=60, check=False)


def usage(tests):
    for args, err in ((["--bogus"], "unknown option --bogus"), (["--bogus", "x", "y"], "unknown option --bogus"), (["-x"], "unknown option -x"),
                      (["-c"], "an argument is missing after -c"), (["--format=xml"], "text, csv or json, not xml"),
                      (["--color=red"], "auto, always or never, not red"), (["--tolerance=x"], "a number, not x"),
                      (["--tolerance=-1"], "a number, not -1"), (["--tolerance=nan"], "a number, not nan"), (["--tolerance=inf"], "a number, not inf"), (["--tolerance="], "a number, not "),
                      (["--tolerance=1x"], "a number, not 1x"), (["--live", "-c", "1"], "--live takes one script"),
                      (["--format"], "an argument is missing after --format"), (["--quiet=1"], "unknown option --quiet=1"),
                      (["-xc"], "unknown option -x"), (["a", "-z", "b"], "unknown option -z")):
        expect(tests, "usage: " + " ".join(args), tests.run(*args), 2, "", err)
    expect(tests, "--version", tests.run("--version"), 0, "fret ")
    expect(tests, "--version and a file", tests.run("--version", "/nonexistent"), 0, "fret ")
    expect(tests, "--help", tests.run("--help"), 0, "usage: fret")
    expect(tests, "-h", tests.run("-h"), 0, "usage: fret")
    for page, parts in (("1", (".TH FRET 1 ", ".SH OPTIONS\n.TP\n.B \\-f FILE\nrun a script (\\- is standard input)\n",
                               "of the\nsamples of uncertainty, as csv or json: cat puts them together\n.TP\n",
                               ".SH COMMANDS\n", "\n.B friction MU\n", ".SH SETTINGS\n", ".SH EXIT STATUS\n", "E0 (z/c0)\\(hak")),
                        ("5", (".TH FRET 5 ", ".SH SCRIPTS AND TRANSCRIPTS\n", ".BR fret (1)\n")),
                        ("bash", ("complete -F _fret fret\n", " --format=text --format=csv --format=json --part --keep-going ",
                                  " --color=auto --color=always --color=never --version --help'\n"))):
        done = manual(tests, page)
        for part in parts:
            expect(tests, "manual %s: %s" % (page, part.strip()), done, 0, part)
        tests.check("manual %s: no line is a request by chance" % page, page == "bash" or not
                    re.findall(r"^(?:'|\.(?!TH|SH|PP|TP|BR?|I|nf|fi)).*", done.stdout, re.M) and
                    done.stdout.count(".nf\n") == done.stdout.count(".fi\n"), done.stdout[-3000:])
    page = re.sub(r"^\.(PP|nf|fi)\n", "", manual(tests, "1").stdout, flags=re.M)
    for roff, plain in ((r"\-", "-"), (r"\(ha", "^"), (r"\(aq", "'"), (r"\(ga", "`"), (r"\(ti", "~"), (r"\&", ""), (r"\e", "\\")):
        page = page.replace(roff, plain)
    for title, topic in (("EXPRESSIONS", "expressions"), ("QUANTITIES", "quantities"), ("UNITS", "units"), ("THE PROMPT", "prompt"),
                         ("SCRIPTS", "scripts"), ("LIMITS", "limits"), ("SETTINGS", "set")):
        section, told = page.partition(".SH %s\n" % title)[2].partition("\n.SH ")[0], tests.run("-c", "help " + topic)
        want = [line for line in told.stdout.split("\n") if line and not (topic == "set" and not line.startswith("    set"))]
        tests.check("manual 1: %s are help %s" % (title, topic), len(want) > 5 and all(line in section for line in want),
                    "\n".join(line for line in want if line not in section))
    expect(tests, "manual 2", manual(tests, "2"), 2, "", "there is no page 2")


def files(tests):
    expect(tests, "missing file", tests.run("/nonexistent/x"), 1, "", "cannot read /nonexistent/x: No such file")
    expect(tests, "directory", tests.run("/"), 1, "", "cannot read /: Is a directory")
    expect(tests, "missing transcript", tests.run("--replay", "/nonexistent"), 1, "", "cannot read /nonexistent")
    expect(tests, "directory as transcript", tests.run("--replay", "/"), 1, "", "cannot read /")
    with tests.file("no prompt here\n") as path:
        expect(tests, "transcript without prompts", tests.run("--replay", path), 1, "", "holds no lines")
    with tests.file("fret> 1 + 1\n1 + 1 = 3\nfret> 2\n2 = 2\n") as path:
        done = tests.run("--replay", path)
        expect(tests, "replay shows what differs", done, 1, "- 1 + 1 = 3\n+ 1 + 1 = 2\n")
        expect(tests, "replay names the line", done, 1, path + ":1: fret> 1 + 1")
        expect(tests, "replay counts", done, 1, "1 passed, 1 failed")
    with tests.file("fret> 1/3 in %\n1/3 = 33.4 %\n") as path:
        expect(tests, "replay within tolerance", tests.run("--replay", path, "--tolerance", "1e-2"), 0, "1 passed")
        expect(tests, "replay beyond tolerance", tests.run("--replay", path, "--tolerance", "1e-4"), 1, "1 failed")
    expect(tests, "empty file", tests.run("/dev/null"), 0, "", "")
    for name, shown in (("a b.csv", '"a b.csv"'), ("a#b;.csv", '"a#b;.csv"')):
        with open(os.path.join(tests.dir, name), "w", encoding="ascii") as f:
            f.write("r [mm],f [um]\n0,0\n1,1\n2,4\n")
        done = tests.run("-c", "geometry file %s; show" % shown)
        expect(tests, "a file named " + name, done, 0, "geometry file %s\n" % shown, "")
        expect(tests, "and as it is shown", tests.run("-c", done.stdout + "show"), 0, done.stdout, "")
    for line in ("x = -30 deg", "x = 0.1234567890123456 rad", "x = -0.7 rad/m", "x = 1e-3 deg"):
        done = tests.run("-c", line + "; show variables; save angle.fret")
        again = tests.run("-f", "angle.fret", "-c", "show variables")
        tests.check("kept: " + line, done.returncode == 0 and done.stdout == again.stdout and done.stdout.startswith("x = "), tests.report(done) + tests.report(again))
    expect(tests, "empty -c", tests.run("-c", ""), 0)
    expect(tests, "empty pipe", tests.run(), 0)
    with tests.file("x = 1\nx") as path:
        expect(tests, "no line end at the end", tests.run(path), 0, "x = 1")
    with tests.file("x = 1 + \\\r\n 2\r\nx\r\n") as path:
        expect(tests, "DOS line ends", tests.run(path), 0, "x = 3")
    with tests.file("1 + \\") as path:
        expect(tests, "a continuation at the end", tests.run(path), 1, "", "expected a value")
    with tests.file('source "%s"\n') as path:
        with open(path, "w", encoding="ascii") as f:
            f.write('source "%s"\n' % path)
        expect(tests, "a script that runs itself", tests.run(path), 1, "", "nested more than")
    with tests.file("1\n  foo\n2\n") as inner, tests.file('x = 5\nsource %s\nx\n' % inner) as outer:
        expect(tests, "an error in a script of a script", tests.run(outer), 1, "1 = 1\n", inner + ":2:3: error: unknown")


def writes(tests):
    with open("/dev/full", "wb") as full:
        for name, args in (("a value", ["-c", "1"]), ("a table", ["-c", "table x for x = 1 .. 2 steps 100000"]),
                           ("help", ["--help"]), ("version", ["--version"]), ("replay", ["--replay", "/dev/stdin"])):
            done = subprocess.run([tests.fret, *args], input=b"fret> 1\n1 = 1\n", stdout=full, stderr=subprocess.PIPE,
                                  env=tests.env, timeout=120)
            done.stderr, done.stdout = done.stderr.decode(), ""
            expect(tests, "full disk, " + name, done, 1, None, "cannot write to standard output: No space left")
    expect(tests, "table to a full disk", tests.run("-c", "table x for x = 1 .. 2 to /dev/full"), 1, "",
           "cannot write /dev/full: No space left")
    expect(tests, "history to a full disk", tests.run("-c", SCENE + "history to /dev/full"), 1, "", "No space left")
    reader = subprocess.run("'%s' -c 'table x for x = 1 .. 2 steps 1000000'; echo $? >status" % tests.fret, shell=True,
                            stdout=subprocess.DEVNULL, env=tests.env, cwd=tests.dir, timeout=120)
    tests.check("a million rows", reader.returncode == 0)
    for way, statements in (("--format=text", "table x for x = 1 .. 2 steps 50000000"), ("--format=csv", "table x for x = 1 .. 2 steps 50000000"),
                            ("--format=json", "table x for x = 1 .. 2 steps 50000000"), ("--color=always", "x = 1; " + 20000 * "x;"),
                            ("--keep-going", 1000 * "help;"), ("--help", "")):
        read, write = os.pipe()
        os.close(read)
        done = subprocess.run([tests.fret, way, *(("-c", statements) if statements else ())], stdout=write, stderr=subprocess.PIPE,
                              env=tests.env, cwd=tests.dir, timeout=120, check=False)
        os.close(write)
        tests.check("a reader that leaves: " + way, done.returncode == -signal.SIGPIPE and not done.stderr, "%d\n%s" % (done.returncode, done.stderr))
    where = os.path.join(tests.dir, "out")
    os.makedirs(where)
    old = os.path.join(where, "x.csv")
    with open(old, "w", encoding="ascii") as f:
        f.write("old\n")
    tests.run("-c", "table (2 m)^x in m for x = 1 .. 2 to " + old)
    with open(old, encoding="ascii") as f:
        tests.check("a table that fails leaves the old file", f.read() == "old\n")
    tests.check("and nothing beside it", os.listdir(where) == ["x.csv"], str(os.listdir(where)))


def junk(tests):
    rnd = random.Random(1)
    for i in range(8):
        data = bytes(rnd.randrange(256) for _ in range(3000))
        for name, done in (("pipe", tests.run(input=data)), ("keep going", tests.run("--keep-going", input=data))):
            expect(tests, "random bytes %d, %s" % (i, name), done, 1, None, "stdin:1:")
        with tests.file(data) as path:
            expect(tests, "random bytes %d, file" % i, tests.run(path), 1, None, ":1:")
            done = tests.run("--replay", path)
            expect(tests, "random bytes %d, replay" % i, done, 1, None, "holds no lines")
    words = ("material steel geometry sphere cone R=10 mm slope=0.1 friction 0.4 press FN=100 N step Fx=20 cycle FA=5 "
             "times 3 table for a = 1 .. 2 in um ; , ( ) + - * / ^ = += plot loop set digits show k dW c0 \\ # \" 1e9 "
             "help explain history reset all with log steps 0.5 % µm GPa").split()
    for i in range(60):
        script = "\n".join(" ".join(rnd.choice(words) for _ in range(rnd.randrange(1, 12))) for _ in range(100))
        done = tests.run("--keep-going", input=script.replace(" to ", " ").replace("plot", "plot x"))
        expect(tests, "random words %d" % i, done, 1, None, "error:")
    expect(tests, "a NUL", tests.run(input=b"x = 1\0\n"), 1, "", "unexpected byte 0x00")
    expect(tests, "a NUL after a name", tests.run(input=b"pi\0pi\n"), 1, "", "0x00")
    expect(tests, "bytes that are no UTF-8", tests.run(input=b"\xff\xff\n"), 1, "", "unexpected byte 0xff")


def long_lines(tests):
    big = 1 << 20
    cases = {"name": ("a" * big, "unknown name"), "parentheses": ("(" * big + "1" + ")" * big, "nested too deeply"),
             "minus signs": ("-" * big + "1", "nested too deeply"), "powers": ("2^" * (big // 2) + "1", "nested too"),
             "calls": ("sqrt(" * (big // 5) + "1", "nested too deeply"), "blanks": (" " * big + "foo", "unknown name"),
             "quotation": ('"' + "x" * big, "not closed"), "digits": ("9" * big, "too large"),
             "commas": ("1," * (big // 2) + "1", "more than"), "file name": ("source " + "x" * big, "too long"),
             "geometry": ("geometry " + "x" * big, "unknown geometry"), "help": ("help " + "x" * big, "no help"),
             "unit": ("1 " + "u" * big, "unknown unit"), "argument": ("press " + "x" * big + "=1", "no argument"),
             "unit product": ("1 m" + "*m" * (big // 2), "")}
    for name, (line, err) in cases.items():
        done = tests.run(input=line + "\n")
        if name == "unit product":
            tests.check("a long unit product", done.returncode in (0, 1), tests.report(done))
            continue
        expect(tests, "1 MB of " + name, done, 1, None, err)
        tests.check("1 MB of %s: a short message" % name, len(done.stderr) < 6000, "%d bytes" % len(done.stderr))
    expect(tests, "a sum of 1 MB", tests.run("--format=json", input="1+" * (big // 2) + "1\n"), 0, '"value":524289')
    expect(tests, "1 MB of statements", tests.run(input="x=1;" * (big // 4) + "x\n"), 0, "x = 1")
    expect(tests, "1 MB of zeros", tests.run(input="0." + "0" * big + "1\n"), 1, "", "too small")
    expect(tests, "1 MB of comment", tests.run(input="x = 2 # " + "x" * big + "\nx\n"), 0, "x = 2")
    expect(tests, "100000 continued lines", tests.run(input="x = 1" + "+ \\\n1" * 100000 + "\nx\n"), 0, "x = 100001")


@contextlib.contextmanager
def fake_gnuplot(tests, script):
    path = os.path.join(tests.dir, "fake-%d" % random.randrange(1 << 60))
    os.mkdir(path)
    with open(os.path.join(path, "gnuplot"), "w", encoding="ascii") as f:
        f.write("#!/bin/sh\n" + script)
    os.chmod(os.path.join(path, "gnuplot"), 0o755)
    yield path
    shutil.rmtree(path)


def gnuplot(tests):
    plot = SCENE + "step Fx=20 N\nplot loop"
    empty = os.path.join(tests.dir, "empty")
    os.makedirs(empty, exist_ok=True)
    expect(tests, "no gnuplot", tests.run("-c", plot, env={"PATH": empty}), 1, "",
           "-c:3:1: error: plots need gnuplot, which is not installed")
    png = os.path.join(tests.dir, "x.png")
    expect(tests, "no gnuplot, to a file", tests.run("-c", plot + " to " + png, env={"PATH": empty}), 1, "",
           "plots need gnuplot")
    expect(tests, "no gnuplot is needed for a script", tests.run("-c", plot + " to x.gp", env={"PATH": empty}), 0)
    path = tests.env["PATH"]
    for name, script, err in (("fails", "echo 'something is wrong' >&2; exit 1", "something is wrong"),
                              ("fails in silence", "exit 3", "gnuplot failed: no message"),
                              ("is killed", "kill -9 $$", "gnuplot failed"), ("draws nothing", "exit 0", "gnuplot drew nothing"),
                              ("fails with a place", "echo 'some line 7: something is wrong' >&2; exit 1", "something is wrong"),
                              ("fails at the beginning of a line", "echo 'line 7: \t^ it is wrong' >&2; echo >&2; exit 1", "it is wrong"),
                              ("fails with words", "echo 'an underline of a line without place' >&2; exit 1", "an underline of a line without place"),
                              ("fails with words and a colon", "echo 'an outline of: it' >&2; exit 1", "an outline of: it"),
                              ("fails with words of a place", "echo 'a line without place' >&2; exit 1", "gnuplot failed: a line without place"),
                              ("is found too late", "exit 127", "plots need gnuplot, which is not installed"),
                              ("fails with bytes", "printf '\\033[31m\\377' >&2; exit 1", "\\x1b[31m\\xff")):
        with fake_gnuplot(tests, script) as fake:
            env = {"PATH": fake + ":" + path}
            expect(tests, "gnuplot %s, to a file" % name, tests.run("-c", plot + " to " + png, env=env), 1, "", err)
            expect(tests, "gnuplot " + name, tests.run("-c", plot, env=env), 1, "", err)
    with fake_gnuplot(tests, r"printf '\fa\nb\n'") as fake:
        done = tests.run("-c", SCENE + "step Fx=20 N\nset plot 60x18; plot loop | pressure", env={"PATH": fake + ":" + path})
        tests.check("gnuplot draws one page of two", done.returncode == 1 and done.stdout == "a\nb\n" and "gnuplot drew nothing" in done.stderr,
                    tests.report(done))
    html = os.path.join(tests.dir, "x.html")
    with fake_gnuplot(tests, "echo hello") as fake:
        done = tests.run("-c", plot + " to " + html, env={"PATH": fake + ":" + path})
        with open(html, encoding="utf-8") as f:
            tests.check("a page without a prologue is kept whole", "<body>\nhello\n</body>" in f.read() and done.returncode == 0, tests.report(done))
    os.unlink(html)
    for env in ({"TMPDIR": ""}, {}):
        bare = {name: value for name, value in tests.env.items() if name != "TMPDIR"}
        done = subprocess.run([tests.fret, "-c", plot], capture_output=True, text=True, env={**bare, **env}, cwd=tests.dir, timeout=120, check=False)
        tests.check("a picture without TMPDIR", done.returncode == 0 and "hysteresis loop" in done.stdout, done.stdout + done.stderr)
    with fake_gnuplot(tests, "echo $$ >'%s/started'\nexec sleep 300\n" % tests.dir) as fake:
        for where in ("", " to " + png):
            started = os.path.join(tests.dir, "started")
            job = subprocess.Popen([tests.fret, "-c", plot + where], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   env={**tests.env, "PATH": fake + ":" + path}, start_new_session=True)
            for _ in range(1000):
                if os.path.exists(started) and os.path.getsize(started):
                    break
                time.sleep(0.01)
            job.send_signal(signal.SIGINT)
            finish(tests, "gnuplot hangs%s, interrupted" % where, job)
            with open(started, encoding="ascii") as f:
                pid = int(f.read())
            os.unlink(started)
            time.sleep(0.05)
            tests.check("the hanging gnuplot is gone", not os.path.exists("/proc/%d" % pid) or
                        "Z" in open("/proc/%d/stat" % pid, encoding="ascii").read())
    expect(tests, "no place for temporary files", tests.run("-c", plot, env={"TMPDIR": "/nonexistent"}), 1, "",
           "cannot make a temporary file in /nonexistent")
    left = [name for name in os.listdir(tests.dir) if name.startswith("x.png") or ".part" in name]
    tests.check("no half-written pictures", not left, " ".join(left))


def finish(tests, name, job):
    """Waits for an interrupted job: it must end soon with status 130, and print no message but that it was interrupted."""
    try:
        out, err = job.communicate(timeout=60)
    except subprocess.TimeoutExpired:
        job.kill()
        out, err = job.communicate()
    tests.check(name, job.returncode == 130 and b"Sanitizer" not in err,
                "exit %s\n%s%s" % (job.returncode, (out or b"")[-500:].decode(), err[-500:].decode()))


def interrupts(tests):
    csv, loop = os.path.join(tests.dir, "long.csv"), os.path.join(tests.dir, "loop.csv")
    with open(loop, "w", encoding="ascii") as f:
        f.write("dx [um],Fx [N],r [mm],f [um]\n" + "".join("%g,%g,%.9g,%.9g\n" % (i % 9 / 10, i % 7, i / 1e5, i * i / 1e9 + i % 3)
                                                        for i in range(200000)))
    scripts = {"table": LONG % "/dev/null", "table to a file": LONG % csv,
               "cycle": SCENE + "set model springs 1000000; cycle dxA=0.1 um FNA=30 N phase=20 deg times 1000000; dW\n",
               "step": SCENE + "cycle FA=20 N times 1000000 steps 1000000\nhistory to /dev/null\n",
               "script": SCENE + "cycle dxA=0.1 um FNA=30 N times 2\n" * 20000,
               "sweep": SCENE + "cycle FA=20 N FNA=30 N times 20\ntable W for k = 0 .. 0.5 steps 1000000 to /dev/null\n",
               "uncertainty": SCENE + "uncertainty dWd(1 um) with mu +- 0.01, FN +- 1 N samples 10000000\n",
               "maximize": SCENE + "cycle dxA=0.1 um FNA=30 N times 20\nmaximize W over mu = 0.5 .. 1, E0 = 1 GPa .. 300 GPa\n",
               "fit": SCENE + "fit mu, E0, nu along %s\n" % loop, "accuracy": SCENE + "accuracy within 60\n",
               "explain": SCENE + "cycle FA=15 N FNA=20 N phase=60 deg times 300; set model springs 20000; explain dW\n",
               "smooth": "geometry file %s smooth\n" % loop,
               "export": SCENE + "geometry flat-rounded b=0.1 mm R=10 mm\nexport jenkins 1000 to " + csv + ".h\n"}
    for name, script in scripts.items():
        with tests.file(script) as path:
            job = subprocess.Popen([tests.fret, path], stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=tests.env,
                                   start_new_session=True)
            running = at_work(job)
            job.send_signal(signal.SIGINT)
            if running:
                finish(tests, "interrupted: " + name, job)
            else:
                out, err = job.communicate()
                tests.check("interrupted: " + name, False, "was over before\n" + (out + err)[-500:].decode())
    with tests.file("fret> " + LONG.replace("\n", "\nfret> ") % "/dev/null") as path:
        job = subprocess.Popen([tests.fret, "--replay", path], stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=tests.env,
                               start_new_session=True)
        running = at_work(job)
        job.send_signal(signal.SIGINT)
        out, err = job.communicate()
        tests.check("an interrupted replay says so", running and job.returncode == 130 and (out, err) == (b"", b"error: interrupted\n"),
                    "exit %s\n%s%s" % (job.returncode, out.decode(), err.decode()))
    tests.check("an interrupted table leaves no file", not os.path.exists(csv) and not os.path.exists(csv + ".part"))
    out = os.path.join(tests.dir, "long.txt")
    with open(out, "wb") as f:
        job = subprocess.Popen([tests.fret, "-c", LONG.replace(" to %s", "")], stdout=f, stderr=subprocess.PIPE,
                               env=tests.env, start_new_session=True)
        at_work(job)
        job.send_signal(signal.SIGINT)
        finish(tests, "interrupted: table on standard output", job)
    with open(out, encoding="ascii") as f:
        lines = f.read().splitlines(True)
    tests.check("an interrupted table ends with a whole row", len(lines) > 2 and "F [N]" in lines[0] and
                len(lines[-1]) == len(lines[1]), repr(lines[-1:]))
    os.unlink(out)


def memory(tests):
    if tests.sanitized:  # AddressSanitizer reserves terabytes
        return
    line = "1+" * (1 << 21) + "1\n"
    job = subprocess.run([tests.fret], input=line.encode(), capture_output=True, env=tests.env, timeout=60,
                         preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (80 << 20, 80 << 20)))
    tests.check("no memory", job.returncode == 1 and b"out of memory" in job.stderr and len(job.stderr) < 2000,
                "exit %d\n%s" % (job.returncode, job.stderr[-1000:].decode()))
    script = SCENE + "step Fx=1 N; step Fx=2 N\n" * 1000000
    job = subprocess.run([tests.fret], input=script.encode(), capture_output=True, env=tests.env, timeout=60,
                         preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (24 << 20, 24 << 20)))
    tests.check("no memory for steps", job.returncode == 1 and b"out of memory" in job.stderr,
                "exit %d\n%s" % (job.returncode, job.stderr[-1000:].decode()))


def run(tests):
    tests.each([lambda room=room: room(tests) for room in
                (usage, files, writes, junk, long_lines, gnuplot, memory)])
    interrupts(tests)
