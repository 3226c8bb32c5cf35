# SPDX-License-Identifier: GPL-3.0-or-later
"""Types random keys at a prompt with a random start-up file and a random history. The program must end when told to, without a
sanitizer's report, with the terminal as before and the history whole. `typed.py FRET SECONDS [SEED]` runs for so long."""
import math
import os
import pty
import random
import select
import shutil
import struct
import subprocess
import sys
import tempfile
import termios
import time
import fcntl

import programs

KEYS = ("\x01", "\x02", "\x05", "\x06", "\x08", "\x0b", "\x0c", "\x0e", "\x10", "\x12", "\x14", "\x15", "\x17", "\x19", "\t", "\t\t",
        "\x1b[A", "\x1b[B", "\x1b[C", "\x1b[D", "\x1b[H", "\x1b[F", "\x1b[3~", "\x1b[5~", "\x1bb", "\x1bf", "\x1bd", "\x1b\x7f", "\x1b.",
        "\x7f", "\x7f\x7f\x7f", "\x03", "\r", "\\\r", "\x1b[200~step Fx=1 N\rdW\r\x1b[201~", "é", "µ", "\x1b", "\x16\x01", "?a\r", "ma\t",
        "press F\t", "set \t\t", "geometry file g\t", "source \t\t", "a at k\t", "\x1f", "(", ")", '"')


def text_of(r):
    """Random text: statements, and text that is none."""
    writer = programs.Writer(r.randrange(1 << 30))
    lines = [writer.line() for _ in range(r.choice((0, 3, 12)))]
    noise = bytes(r.randrange(256) for _ in range(r.choice((0, 0, 40, 3000))))
    parts = [("\n".join(lines) + "\n").encode(), noise.replace(b"!", b"?")]
    r.shuffle(parts)
    return b"".join(parts)


def keys_of(r):
    writer, keys = programs.Writer(r.randrange(1 << 30)), []
    for _ in range(r.choice((5, 15, 30))):
        line = writer.line().replace("!", "")
        at = r.randrange(len(line) + 1)
        keys.append(line[:at] + r.choice(KEYS) + line[at:] + r.choice(("\r", "\r", "\r", r.choice(KEYS))))
    return "".join(keys).encode()


def problem(fret, env, seed):
    """What is wrong with a session; None: nothing."""
    r = random.Random(seed)
    where = tempfile.mkdtemp(prefix="fret-typed-", dir=env["TMPDIR"])
    try:
        with open(os.path.join(where, "suppressions"), "w", encoding="ascii") as f:
            f.write("leak:libreadline\n")  # readline's own memory, if a search is interrupted
        for name, text in programs.FILES.items():
            with open(os.path.join(where, name), "w", encoding="ascii") as f:
                f.write(text)
        os.makedirs(os.path.join(where, "config/fret"))
        os.makedirs(os.path.join(where, "state/fret"), mode=0o700)
        history = text_of(r)
        for name, text in (("config/fret/fretrc", text_of(r)), ("state/fret/history", history)):
            if r.random() < .7:
                with open(os.path.join(where, name), "wb") as f:
                    f.write(text)
        return session(fret, {**env, "HOME": where, "XDG_CONFIG_HOME": where + "/config", "XDG_STATE_HOME": where + "/state",
                              "TERM": "xterm", "INPUTRC": "/dev/null", "PAGER": "cat",
                              "LSAN_OPTIONS": "print_suppressions=0:suppressions=%s/suppressions" % where}, where, keys_of(r), r)
    finally:
        shutil.rmtree(where)


def session(fret, env, where, keys, r):
    master, slave = pty.openpty()
    fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", r.choice((24, 5, 50)), r.choice((80, 20, 200)), 0, 0))
    before = termios.tcgetattr(slave)
    job = subprocess.Popen([fret], stdin=slave, stdout=slave, stderr=slave, env=env, cwd=where, start_new_session=True,
                           preexec_fn=lambda: fcntl.ioctl(0, termios.TIOCSCTTY, 0))
    out, sent, end, told = b"", 0, time.time() + 120, 0.0
    try:
        while job.poll() is None and time.time() < end:
            ready, _, _ = select.select([master], [], [], 0.02)
            if ready:
                out += os.read(master, 65536)
            elif b"fret> " not in out:  # wait for the prompt: before it Ctrl-C would end the program
                continue
            elif sent < len(keys):
                sent += os.write(master, keys[sent:sent + r.choice((1, 10, 100, 200))])
            elif time.time() > told + 2:  # an unfinished key, line or search may have swallowed the first try
                os.write(master, b"\x03\x07\r\x03\rquit\r")
                told = time.time()
        while select.select([master], [], [], 0)[0]:
            out += os.read(master, 65536)
        after = termios.tcgetattr(slave)
        if job.poll() is None:
            return "no end: " + out[-1500:].decode(errors="replace")
        text = out.decode(errors="replace")
        if "Sanitizer" in text or "runtime error" in text or job.returncode != 0:
            return "ends with %s: %s" % (job.returncode, text[-3000:])
        if after[:4] != before[:4]:
            return "leaves the terminal otherwise: %s, %s" % (before[:4], after[:4])
        return None
    finally:
        if job.poll() is None:
            job.kill()
            job.wait()
        os.close(master)
        os.close(slave)


def run(tests):
    count, wrong = programs.campaign(problem, tests.fret, {**tests.env, "TMPDIR": tests.tmp}, math.inf, 1000000 if tests.sanitized else 1, 2,
                                     4 if tests.few else 15)
    for seed, what in wrong:
        tests.check("random keys %d" % seed, False, what)
    tests.record("random keys", count > len(wrong), count)


def main():
    fret, seconds, seed = os.path.abspath(sys.argv[1]), float(sys.argv[2]), int(sys.argv[3]) if len(sys.argv) > 3 else 1
    with tempfile.TemporaryDirectory(prefix="fret-typed-") as tmp:
        env = {"PATH": os.environ["PATH"], "TMPDIR": tmp, "LC_ALL": "C.UTF-8", "ASAN_OPTIONS": "detect_leaks=1"}
        count, wrong = programs.campaign(problem, fret, env, seconds, seed, os.cpu_count() or 1)
        for one, what in wrong:
            print("FAILED session %d: %s" % (one, what))
        print("typed: %d passed, %d failed" % (count - len(wrong), len(wrong)))
        return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
