# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests the prompt and lessons under adverse conditions: failing system calls and allocations, signals between two keys, terminals
without a size, without room, or gone, a full disk."""
import errno
import fcntl
import os
import re
import resource
import select
import shutil
import signal
import stat
import struct
import subprocess
import termios
import time

import pexpect

from live import Live, child_of
from prompt import PROMPT, SCENE, Session, clean, play, to_key


def started(tests, name, text):
    """A configuration directory with this start-up file."""
    config = os.path.join(tests.dir, name)
    os.makedirs(os.path.join(config, "fret"))
    with open(os.path.join(config, "fret", "fretrc"), "w", encoding="ascii") as f:
        f.write(text)
    return config


def armed(tests):
    """Makes the files arm and disarm: `source arm` makes faults.so begin to count."""
    for name in ("arm", "disarm"):
        with open(os.path.join(tests.dir, name), "w", encoding="ascii"):
            pass


def history_of(tests, name, text, mode=0o600):
    state = os.path.join(tests.dir, name)
    os.makedirs(os.path.join(state, "fret"))
    path = os.path.join(state, "fret", "history")
    with open(path, "w", encoding="ascii") as f:
        f.write(text)
    os.chmod(path, mode)
    return state, path


def leaves(s):
    s.child.sendeof()
    return s.end()


# ---- system calls that fail ---------------------------------------------------------------------

def failing(tests):
    tool = os.path.join(os.path.abspath(tests.build), "tests", "calls")
    if tests.sanitized or not os.path.exists(tool) or subprocess.run(
            [tool, os.devnull, "none", "0", "0", "/bin/true"], check=False, stderr=subprocess.DEVNULL).returncode:
        return
    armed(tests)
    told = iter(range(1000))

    def session(call, number, code, *args, **env):
        path = os.path.join(tests.dir, "told-%d" % next(told))
        before = (tool, path, call, str(number), str(code))
        return path, Session(tests, "--quiet", *args, before=before, **env)

    def failed(path):
        with open(path, encoding="ascii") as f:
            return "FAILED" in f.read()
    # while the program waits for a key, and reads it
    path, s = session("pselect6", 9, errno.ENOMEM)
    s.say("source arm")
    s.child.send("x = 4 + 3")
    tests.check("keys that cannot be waited for are no more keys", s.end() == 0 and failed(path), clean(s.child.before))
    for code in (errno.EINTR, errno.EAGAIN, errno.EIO):
        path, s = session("read", 5, code)
        s.say("source arm")
        if code == errno.EIO:
            s.child.send("x = 45 + 1")
            ended = s.end()
            tests.check("keys that cannot be read are the end", ended == 0 and failed(path), clean(s.child.before))
        else:
            tests.check("a key that is read again", s.say("x = 45; x").endswith("x = 45") and leaves(s) == 0 and failed(path),
                        clean(s.child.before))
    # the history, opened after a start-up file that arms the faults
    config, found = started(tests, "arming", "source arm\n"), []
    for call, code, says in (("fstat", errno.EIO, "no history is kept: .*history is no plain file"), ("newfstatat", errno.EIO, "no history is kept: .*history is no plain file"),
                             ("fchmod", errno.EPERM, "other users can read .*history"),
                             ("openat", errno.EACCES, "no history is kept: cannot write .*history: Permission denied"), ("openat", errno.EROFS, "no history is kept: cannot write .*history: Read-only"), ("read", errno.EIO, "^ *$")):
        state, kept = history_of(tests, "kept-%s-%d" % (call, code), "123 + 1\n", 0o644)
        path, s = session(call, 3 if call == "read" else 1, code, XDG_STATE_HOME=state, XDG_CONFIG_HOME=config)
        if call == "openat":  # a history that cannot be written is still read
            tests.check("a history to read alone", s.say("\x1b[A").endswith("123 + 1 = 124"))
        answer = s.say("\x1b[A\x15\x1b[A4 + 1" if call in ("fstat", "newfstatat", "read") else "4 + 1")
        ended = leaves(s)
        with open(kept, encoding="ascii") as f:
            lines = f.read().splitlines()
        if call in ("fstat", "newfstatat") and not re.search(says, s.banner):  # which of the two a C library calls depends on the file
            tests.check("a start where %s fails for another file" % call, answer.endswith("4 + 1 = 5") and ended == 0, "%s\n%s" % (s.banner, answer))
        elif failed(path):
            found.append(call)
            tests.check("a history where %s fails" % call, re.search(says, s.banner) and answer.endswith("4 + 1 = 5") and ended == 0 and
                        lines == ["123 + 1"] + ([] if "no history" in says else ["4 + 1"]), "%s\n%s\n%s" % (s.banner, answer, lines))
    tests.check("a history's calls fail", set(found) >= {"fchmod", "read", "openat"} and {"fstat", "newfstatat"} & set(found), str(found))
    # failures to start other programs
    for line, says in (("!true", r"^the system's shell fails: No child processes"), ("help pi", "^pi: ")):
        seen = []
        for call, code in (("wait4", errno.ECHILD),) if line == "!true" else (("clone3", errno.ENOMEM), ("clone", errno.ENOMEM), ("vfork", errno.ENOMEM), ("fork", errno.ENOMEM)):
            path, s = session(call, 1, code, PAGER="sed s/^/PAGED:/")
            s.say("set pager on")
            s.say("source arm")
            answer, goes_on = s.say(line), s.say("1 + 1") == "1 + 1 = 2"
            goes_on = leaves(s) == 0 and goes_on
            seen += [(re.search(says, answer), goes_on)] if failed(path) else []
        tests.check("a program of the system's that fails: " + line, seen and all(told and goes_on for told, goes_on in seen), str(seen))
    # failures to set the terminal's modes at the question of a lesson
    reached = 0
    for number in (1, 2, 3, 4):
        path, s = session("ioctl", number, errno.EIO)
        s.say("x = 5")
        s.child.sendline("source arm; demo pressing")
        s.child.expect("demo pressing")
        s.child.send("q\r1234\r")  # a key, or a line if no key is asked for
        s.child.expect("1234 = 1234")
        s.prompt()
        tests.check("a lesson where ioctl %d fails" % number, s.say("x") == "x = 5" and leaves(s) == 0, clean(s.child.before))
        reached += failed(path)
    tests.check("a lesson's calls fail", reached == 4, str(reached))


# ---- allocations that fail ----------------------------------------------------------------------

def memory(tests):
    """Allocations fail at the start and at the prompt: answers that come are right, and what is lost is reported."""
    shim = os.path.join(os.path.abspath(tests.build), "tests", "faults.so")
    if tests.sanitized or not os.path.exists(shim):
        return
    armed(tests)
    where = os.path.join(tests.dir, "counted")
    fault = {"LD_PRELOAD": shim, "FRET_FAULTS": "1"}

    def early(args, told, number=0):
        env = {**fault, "FAULT_EARLY": "1", "FAULT": str(number)}
        return tests.run(*args, env={**env, "FAULT_COUNT": told} if not number else env)

    def batch(i, args):
        right = early(args, where + str(i))
        with open(where + str(i), encoding="ascii") as f:
            count = int(f.read())
        wrong = []
        for number in range(1, count + 1):
            done = early(args, None, number)
            if not (done.returncode == 0 and done.stdout == right.stdout or done.returncode == 1 and "out of memory" in done.stderr):
                wrong.append("%d: %s" % (number, tests.report(done)))
        tests.check("memory for " + " ".join(args), right.returncode == 0 and count > 0 and not wrong, "\n".join(wrong[:3]))
    tests.each([lambda i=i, args=args: batch(i, args) for i, args in enumerate((["-c", "help plot"], ["-c", "help files"], ["--version"], ["-c", "1 + 1"]))])

    def at_prompt(number):
        """Runs a session in which an allocation fails: (did it end well, what it printed)."""
        kept = os.path.join(tests.dir, "kept-%d.fret" % number)
        state, path = history_of(tests, "memory-%d" % number, "1\n")
        s = Session(tests, "--quiet", XDG_STATE_HOME=state, FAULT=str(number), FAULT_COUNT=where, **fault)
        said, lines = "", ("source arm", "# " + 300 * "y", "x = 5", "y = \\\r6", "x + y", "save history %s" % kept, "source disarm")
        try:
            for line in lines:
                s.child.send(line + "\r")
                if "\r" in line:  # the line is continued, or dropped
                    s.child.expect([r"\.\.\.\.> ", PROMPT])
                    said += s.child.before
                said += s.prompt()
            said += s.say("x; y")
            ended = leaves(s)
        except pexpect.EOF:  # readline ends the program itself
            said += s.child.before
            s.child.close()
            ended = s.child.exitstatus
        text = ""
        if os.path.exists(kept):
            with open(kept, encoding="ascii") as f:
                text = f.read()
        whole = "source arm\n# " + 300 * "y" + "\nx = 5\ny =  \\\n6\nx + y\nsave history %s\n" % kept
        fine = ended == 0 and said.count("= 5") and "y = 6" in said and text == whole
        lost = "memory" in said and set(text.splitlines()) <= set(whole.splitlines())  # dropped lines have not been run
        return fine or "virtual memory" in said and ended == 1 or lost and ended == 0, "%d: %s\n%s\n%s" % (number, ended, clean(said), text)
    right = at_prompt(0)
    with open(where, encoding="ascii") as f:
        count = int(f.read())
    results = []
    tests.each([lambda n=n: results.append(at_prompt(n)) for n in range(1, count + 1)])
    wrong = [told for ok, told in results if not ok]
    tests.check("memory at the prompt", right[0] and count > 20 and not wrong, "%s\n%d of %d\n%s" % (right[1], len(wrong), count, "\n".join(wrong[:4])))
    # a line for the history
    def kept_line(number):
        log = os.path.join(tests.dir, "line-%d.txt" % number)
        script = "record %s\nsource arm\n1%s\nsource disarm\n1234 + 1\n" % (log, "+1" * 400)
        done = tests.run("--keep-going", "-c", script, env={**fault, "FAULT": str(number), "FAULT_COUNT": where + ".txt"})
        with open(log, encoding="utf-8") as f:
            return done, f.read()

    right, whole = kept_line(0)
    with open(where + ".txt", encoding="ascii") as f:
        count = int(f.read())
    wrong = []
    for number in range(1, count + 1):
        done, text = kept_line(number)
        refused, unread = "out of memory" in done.stderr, "error: -c:3: out of memory" in done.stderr
        if "1234 + 1 = 1235" not in done.stdout and not unread or done.returncode != refused or not text.endswith("\n") or not refused and text != whole:
            wrong.append("%d: %s%s" % (number, tests.report(done), text[-300:]))
    tests.check("memory for a recorded line", right.returncode == 0 and count > 1 and not wrong, "\n".join(wrong[:3])[:3000])
    # after a start-up file that arms the faults: the history and typed lines
    config = started(tests, "arming-memory", "source arm\n")
    for number in range(1, 24):
        s = pexpect.spawn(tests.fret, ["--quiet"], encoding="utf-8", timeout=120, cwd=tests.dir,
                          env={**tests.env, **fault, "TERM": "xterm", "INPUTRC": "/dev/null", "XDG_CONFIG_HOME": config, "FAULT": str(number),
                               "XDG_STATE_HOME": os.path.join(tests.dir, "memory-0")})
        said = ""
        for typed in ("", "1 + 41\r", "\x04"):  # what is typed between two lines may be lost
            s.send(typed)
            s.expect(["fret> $", pexpect.EOF])
            said += s.before
        s.close()
        tests.check("memory for the beginning of a session, %d" % number, s.exitstatus == 0 and "1 + 41 = 42" in said or
                    s.exitstatus == 1 and "memory" in said, "%s %s" % (s.exitstatus, said))


# ---- signals at unusual moments -----------------------------------------------------------------

def side_of(s):
    return os.open(os.readlink("/proc/%d/fd/0" % s.child.pid), os.O_RDWR | os.O_NOCTTY)


def held_back(s):
    """Ends a line while output to the terminal is stopped: readline has read the line but cannot return it."""
    side = side_of(s)
    termios.tcflow(side, termios.TCOOFF)
    os.write(s.child.child_fd, b"\r")
    end = time.time() + 60
    while struct.unpack("i", fcntl.ioctl(side, termios.FIONREAD, b"\0" * 4))[0] and time.time() < end:
        time.sleep(0.01)
    time.sleep(0.1)
    return side


def let_go(side):
    termios.tcflow(side, termios.TCOON)
    os.close(side)


def moments(tests):
    """Signals after the last key of a line, and a terminal whose modes were changed while the program was stopped."""
    s = Session(tests, "--quiet")
    s.child.send("x = 4711")
    s.child.expect("4711")
    side = held_back(s)
    os.kill(s.child.pid, signal.SIGINT)
    time.sleep(0.1)
    let_go(side)
    s.prompt()
    tests.check("Ctrl-C behind the line drops it", "unknown name 'x'" in s.say("x"))
    s.child.send("1 + 4711")
    s.child.expect("4711")
    side = held_back(s)
    modes = termios.tcgetattr(side)
    os.kill(s.child.pid, signal.SIGTERM)
    time.sleep(0.1)
    let_go(side)
    s.child.expect(pexpect.EOF)
    s.child.close()
    tests.check("an end behind the line is one", s.child.signalstatus == signal.SIGTERM and "4712" not in s.child.before and
                modes[3] & termios.ICANON == 0, "%s %s" % (s.child.signalstatus, clean(s.child.before)))
    s = Session(tests, "--quiet")
    s.child.send("x = 47")
    s.child.expect("x = 47")
    side = side_of(s)
    edits = termios.tcgetattr(side)
    os.kill(s.child.pid, signal.SIGSTOP)
    end = time.time() + 60
    while s.child.ptyproc.isalive() and open("/proc/%d/stat" % s.child.pid, encoding="ascii").read().rpartition(")")[2].split()[0] != "T" and time.time() < end:
        time.sleep(0.01)
    cooked = list(edits)
    cooked[3] |= termios.ICANON | termios.ECHO
    termios.tcsetattr(side, termios.TCSANOW, cooked)
    os.kill(s.child.pid, signal.SIGCONT)
    while termios.tcgetattr(side) != edits and time.time() < end:
        time.sleep(0.01)
    tests.check("continued, the terminal is as for editing", termios.tcgetattr(side) == edits)
    os.close(side)
    s.child.send("11\r")
    s.child.expect("x = 4711")
    s.prompt()
    tests.check("and the line is whole", s.say("x + 0").endswith("x + 0 = 4711") and leaves(s) == 0)


def hang_up(s):
    """Closes the terminal; pexpect must not close the descriptor again."""
    s.child.ptyproc.fileobj.close()
    s.child.ptyproc.closed = s.child.closed = True
    s.child.child_fd = -1


def gone(tests):
    """A terminal that disappears while SIGHUP is ignored."""
    for name, line, shows in (("at the prompt", "", None), ("in a lesson", "demo pressing\r", "q: leave")):
        done = os.path.join(tests.dir, "gone " + name)
        s = Session(tests, "--quiet", before=("/bin/sh", "-c", 'trap "" HUP; "$@"; echo $? > "%s"' % done, "sh"))
        s.child.send(line)
        if shows:
            s.child.expect(shows)
        hang_up(s)
        end = time.time() + 60
        while not (os.path.exists(done) and os.path.getsize(done)) and time.time() < end:
            time.sleep(0.02)
        tests.check("a terminal that is gone " + name, os.path.exists(done) and os.path.getsize(done) > 0, name)


# ---- lines --------------------------------------------------------------------------------------

def pasted(s, text):
    s.child.send("\x1b[200~" + text + "\x1b[201~\r")


def pastes(tests):
    """Pasted transcripts that end with answers; line ends of other systems."""
    s = Session(tests, "--quiet")
    pasted(s, "fret> 1 + 1\n1 + 1 = 2")
    s.child.expect(r"pasted: 1 line without a prompt taken for answers")
    s.prompt()
    pasted(s, "fret> 3 + \\\n4\nfret> 5\n5 = 5\n6 = 6\n\n")
    s.child.expect(r"3 \+ 4 = 7\r")
    s.child.expect(r"pasted: 2 lines without a prompt taken for answers")
    s.prompt()
    s.child.expect(r"5 = 5\r")
    s.prompt()
    tests.check("a transcript's lines that go on need no prompt", s.say("ans") == "ans = 5", clean(s.child.before))
    tests.check("fret>5 is no prompt", "unknown name 'fret'" in s.say("fret>5"), clean(s.child.before))
    s.child.send("1 + \\\x16\r\r")
    s.child.expect(r"\.\.\.\.> ")
    tests.check("a line that goes on before another end of line", s.say("41").splitlines()[-1].endswith("= 42"))
    done = tests.run(input="fret>\r\nfret> 1 + 1\r\nfret>\n")
    tests.check("bare prompts of a script", done.returncode == 0 and done.stdout == "1 + 1 = 2\n", tests.report(done))
    tests.check("a name of other signs", "error" in s.say("x~2,5"))
    tests.check("a comma within brackets or quotes", "write" not in s.say("max(1,5), \"2,5\""))
    s.say("set format json")
    tests.check("a decimal comma in JSON is told of as well", "write 1.5 for one" in s.say("1,5"), clean(s.child.before))
    leaves(s)


def histories(tests):
    """The history on a full disk, with two links, and with no place to keep it."""
    state, path = history_of(tests, "full", "1 + 1\n" * 20)
    s = Session(tests, "--quiet", XDG_STATE_HOME=state)
    before = resource.prlimit(s.child.pid, resource.RLIMIT_FSIZE, (120, resource.RLIM_INFINITY))
    tests.check("a history without room is told of once", "no history is kept any more: File too large" in s.say("2 + 2") and
                s.say("3 + 3") == "3 + 3 = 6", clean(s.child.before))
    s.child.send("\x1b[A\x1b[A\r")
    resource.prlimit(s.child.pid, resource.RLIMIT_FSIZE, before)
    tests.check("and goes on in the session", s.child.expect(["2 \\+ 2 = 4", pexpect.TIMEOUT]) == 0)
    s.prompt()
    leaves(s)
    with open(path, encoding="ascii") as f:
        tests.check("the file is as it was", f.read() == "1 + 1\n" * 20)
    state, path = history_of(tests, "linked", "1 + 1\n", 0o644)
    os.link(path, os.path.join(tests.dir, "other-name"))
    s = Session(tests, "--quiet", XDG_STATE_HOME=state)
    tests.check("a file of two names keeps its mode", "others" not in s.banner and s.say("2") == "2 = 2" and
                stat.S_IMODE(os.stat(path).st_mode) == 0o644, s.banner)
    leaves(s)
    s = Session(tests, before=("/usr/bin/env", "-u", "HOME", "-u", "XDG_STATE_HOME", "-u", "XDG_CONFIG_HOME"))
    tests.check("neither home nor places of one's own", "help" in s.banner and s.say("1 + 1") == "1 + 1 = 2" and leaves(s) == 0, s.banner)
    s = Session(tests, "--quiet", HOME="", XDG_CONFIG_HOME="")
    tests.check("a home without a name", s.say("1 + 1") == "1 + 1 = 2" and leaves(s) == 0)
    child = pexpect.spawn(tests.fret, [], env={**tests.env, "XDG_CONFIG_HOME": started(tests, "quits", "x = 3\nquit\n")}, encoding="utf-8", timeout=120)
    child.expect(pexpect.EOF)
    child.close()
    tests.check("a start-up file that quits", child.exitstatus == 0 and "fret" not in child.before, child.before)


def colors(tests):
    """NO_COLOR turns colours off, unless it is empty."""
    for value, colored in (("1", False), ("", True)):
        s = Session(tests, "--quiet", NO_COLOR=value)
        s.child.sendline("foo")
        s.prompt()
        tests.check("NO_COLOR=%s" % value, ("\x1b[1;31m" in s.child.before) == colored, repr(s.child.before))
        leaves(s)


def elsewhere(tests):
    """Keys from a terminal and output to a file: no full-screen mode, no pager, no questions; and terminals of size 0."""
    for name, lines, wanted in (("a lesson", "demo pressing\n", "The paper: "), ("a transcript", "record there.txt\n1 + 1\nrecord off\n", "1 + 1 = 2")):
        path = os.path.join(tests.dir, "out")
        s = pexpect.spawn("/bin/sh", ["-c", '"$FRET" --no-rc --quiet > out'], encoding="utf-8", timeout=120, cwd=tests.dir,
                          env={**tests.env, "FRET": tests.fret, "TERM": "xterm", "INPUTRC": "/dev/null", "XDG_STATE_HOME": os.path.join(tests.dir, "state-out")})
        for line in lines.splitlines():
            s.sendline(line)
        s.sendline("1234 + 1")
        end = time.time() + 60
        while time.time() < end:
            with open(path, encoding="utf-8") as f:
                text = f.read()
            if "1234 + 1 = 1235" in text:
                break
            time.sleep(0.02)
        s.sendeof()
        s.expect(pexpect.EOF)
        s.close()
        tests.check("answers in a file: " + name, s.exitstatus == 0 and wanted in text and "q: leave" not in text, text[-1000:])
    for rows, cols in ((0, 0), (10, 0), (0, 80)):
        s = Session(tests, "--quiet", dimensions=(rows, cols), PAGER="sed s/^/PAGED:/")
        s.child.sendline("show units")
        s.child.sendline("1234 + 1")
        s.child.expect("1234 \\+ 1 = 1235")
        tests.check("no pages for %dx%d" % (rows, cols), "PAGED" not in s.child.before)
        s.prompt()
        s.child.sendline("quit")
        s.end()


# ---- lessons ------------------------------------------------------------------------------------

def lessons(tests):
    """Lessons: by keys to the end, back over statements, every way to leave; in JSON, without keys."""
    s = Session(tests, "--quiet", "--color=never")
    text, keys = "", 0
    s.child.sendline("demo pressing")
    waits, more = to_key(s)
    while waits:
        text += more
        s.child.send(" ")
        keys += 1
        if keys == 2:  # two steps back, past statements
            for _ in range(2):
                text += to_key(s)[1]
                s.child.send("B")
                s.child.expect(r"\(back at step \d\)")
        waits, more = to_key(s)
    said = re.findall(r"(?m)^(?:a|dz|a/R|k|FN).* = .*", clean(text + more))
    with open(os.path.join(os.path.dirname(__file__), "../../scripts/demos/01-pressing.txt"), encoding="utf-8") as f:
        want = [line for line in f.read().splitlines() if re.match(r"(?:a|dz|a/R|k|FN).* = ", line)]
    tests.check("a lesson to its end, steps gone back to said alike", keys > 3 and set(said) == set(want) and len(said) > len(want),
                "%s\n%s" % (said, want))
    said = play(s, "demo shapes", "\r")[1]
    tests.check("a lesson that ends in words", re.search(r"(?m)^.*The paper: .*\s*Next: .*\s*The scene is the lesson's now: .*`undo`.*$", said), said[-500:])
    s.say("reset all; mu = 0.2; exponent = 7")
    for name, key in (("Q", "Q"), ("Ctrl-D", "\x04"), ("Ctrl-C", "\x03")):
        for steps in (0, 2):
            s.child.sendline("demo energy")
            for _ in range(steps):
                to_key(s)
                s.child.send(" ")
            to_key(s)
            s.child.send(key)
            answer = s.prompt()
            stays = steps > 0 and key != "\x03"
            tests.check("a lesson is left by %s after %d steps" % (name, steps), ("interrupted" in answer) == (key == "\x03") and
                        ("the lesson's now" in answer) == stays and s.say("mu") == "mu = " + ("0.4" if stays else "0.2"), answer)
            tests.check("what was there comes back, %s after %d" % (name, steps), s.say("undo; mu, exponent" if stays else "mu, exponent") ==
                        "mu = 0.2\nexponent = 7", clean(s.child.before))
    s.say("set format json")
    s.child.sendline("demo pressing")
    s.child.sendline("1234 + 1")
    s.child.expect("1234 \\+ 1\",\"value\":1235")
    tests.check("a lesson in JSON asks nothing", "any key" not in s.child.before, clean(s.child.before)[-500:])
    s.prompt()
    tests.check("lessons leave", leaves(s) == 0)


# ---- progress -----------------------------------------------------------------------------------

def wiped(tests):
    """The progress line is wiped at the end of a statement, also of one that prints nothing."""
    live = Live(tests, command=[tests.fret, "--no-rc", "--quiet"])
    live.wait("fret>")
    live.child.send(SCENE + "; press FN=100 N; set report off\r")
    springs, seen = 100000, False
    while not seen and springs <= 100000000:
        live.raw = ""
        live.child.send("set model springs %d; FN = %d N; x = W/1 J # %d\r" % (springs, 100 + springs % 7, springs))
        live.wait(lambda s: re.search(r"# %d\n(.*\n)*fret> *$" % springs, s.text().rstrip("\n") + " "))
        seen = "Ctrl-C stops it" in live.raw
        springs *= 3
    tests.check("progress of what says nothing is seen, and is gone", seen and "Ctrl-C" not in live.screen.text(),
                "%s\n%s" % (seen, live.screen.text()))
    live.child.send("\x04")
    live.gone()


def thought(tests):
    """While a lesson waits for the reader no progress line is shown, and none is left behind."""
    live = Live(tests, command=[tests.fret, "--no-rc", "--quiet", "--color=never"])
    live.wait("fret>")
    live.child.send("demo sliding\r")
    live.wait("q: leave")
    time.sleep(0.7)  # longer than it takes until progress is shown
    live.key(" ", "slide\n")
    told = "error: Fx = 50 N exceeds mu*FN = 40 N: gross slip; step by displacement (dx=...) to slide"
    tests.check("a lesson that was thought about", "Ctrl-C stops it" not in live.raw and told in live.screen.text().replace("\n", "") and
                re.search(r"(?m)^fret> step Fx=50 N # refused$", live.screen.text()), live.screen.text())
    live.child.send("q\x04")
    live.gone()
    path = os.path.join(tests.dir, "lesson.txt")
    with open(os.path.join(tests.dir, "own.txt"), "w", encoding="ascii") as f:  # steps without prompts, and a lesson in a lesson
        f.write("Own\n# One\nask \"1?\" = 1 within 1 %\n# Two\nask \"2?\" = 2 within 1 %\n# Three\nx = 3\n# Four\ndemo pressing\n# Five\nmu = 0.5")
    s = Session(tests, "--quiet")
    s.say("record " + path)
    play(s, "demo sticking")
    s.say("c, mu; undo; show")
    s.say("record off")
    done = tests.run("--replay", path)
    tests.check("a lesson played by keys replays", done.returncode == 0 and done.stdout.endswith(": 2 passed, 0 failed\n"), tests.report(done))
    for keys in ("q", " q", "bq", "  bq", " bb bq", "     bb  bbbq", "   b       b q"):
        s.say("reset all; mu = 0.2; record " + path)
        for lesson in ("demo pressing", "a; demo ./own.txt"):
            s.child.sendline(lesson)
            for key in keys:
                if not to_key(s)[0]:
                    break
                s.child.send(key)
            else:
                s.prompt()
            s.say("mu, FN; Nw; x")
        s.say("record off")
        done = tests.run("--replay", path)
        tests.check("a lesson played by '%s' replays" % keys, done.returncode == 0 and done.stdout.endswith(", 0 failed\n"),
                    tests.report(done) + open(path, encoding="utf-8").read())
    leaves(s)


def run(tests):
    tests.rooms(failing, memory, moments, gone, pastes, histories, colors, elsewhere, lessons, wiped, thought)
