# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the transcripts of tests/sessions in every way (replay, file, -c, pipe), and the examples in README.md."""
import glob
import os
import re
import shutil
import subprocess

import harness

HERE = os.path.dirname(os.path.abspath(__file__))


def plots_of(tests, name, steps):
    """The plots of a transcript: each picture must come last in its answer and have its axis labels."""
    for i, (statement, out) in enumerate(steps):
        if not harness.draws(statement) or any("error:" in line for line in out):
            continue
        script = "\n".join(s for s, _ in steps[:i + 1] if s == statement or not harness.draws(s))
        done = tests.run("--keep-going", "-c", script)
        label = "dx [" if statement.startswith("plot loop") else \
            re.search(r"\bfor (\w+)", statement).group(1)
        tail = done.stdout.splitlines()[-20:]
        tests.check("%s: %s" % (name, statement),
                    any(label in line for line in tail) and any("+----" in line for line in tail), tests.report(done))


def parts(lines):
    """The files that a text shows by `$ cat` ({name: text}), its program calls with their answers, and its transcript."""
    files, calls, session, into = {}, [], [], None
    for line in lines:
        if line.startswith("$ cat "):
            into = files.setdefault(line[6:], [])
        elif line.startswith(("$ fret ", "$ cc ", "$ ./")):
            into = [line[2:]]
            calls.append(into)
        elif line.startswith(harness.PROMPT) or into is None:
            into = session
            session.append(line)
        else:
            into.append(line)
    return ({name: "".join((line[4:] if text[0].startswith("    ") else line) + "\n" for line in text) for name, text in files.items()},
            calls, session)


def write(where, files):
    for name, text in files.items():
        with open(os.path.join(where, name), "w", encoding="utf-8") as f:
            f.write(text)


def examples(tests, name, lines):
    """Runs what a text shows in a directory of its own; returns the number of answers."""
    where, (files, calls, session) = os.path.join(tests.dir, name), parts(lines)
    os.mkdir(where)
    write(where, files)
    steps = harness.read_transcript("\n".join(session))
    if steps:
        harness.replay(tests, name, steps, cwd=where)
    path = os.path.dirname(tests.fret) + ":" + tests.env["PATH"]
    for command, *want in calls:
        done = subprocess.run(["sh", "-c", command], capture_output=True, text=True, cwd=where, env={**tests.env, "PATH": path})
        got = (done.stdout + done.stderr).splitlines()[:len(want)]
        tests.same("%s: %s" % (name, command), "\n".join(want), "\n".join(got))
    return len(steps) + len(calls)


def run(tests):
    jobs = []
    for path in sorted(glob.glob(os.path.join(HERE, "*.txt"))):
        name = os.path.relpath(path, harness.ROOT)
        with open(path, encoding="utf-8") as f:
            text = f.read()
        if name.endswith("first_embedder.txt"):  # it needs the installed library
            continue
        if re.search(r"^\$ cat ", text, re.M):  # it needs a directory of its own
            jobs.append(lambda n=os.path.basename(path), t=text: examples(tests, n, t.splitlines()[1:]))
            continue
        steps = harness.read_transcript(text)
        still = [s for s in steps if not harness.draws(s[0]) or s[1]]
        jobs.append(lambda n=name, s=steps: harness.replay(tests, n, s))
        if not tests.sanitized or name.endswith("contract.txt"):  # one is enough to test the ways to read
            jobs.append(lambda n=name, s=still: harness.batch(tests, n, s))
        jobs.append(lambda n=name, s=steps: plots_of(tests, n, s))
    tests.each(jobs)
    others = subprocess.run(["locale", "-a"], capture_output=True, text=True).stdout.split() \
        if shutil.which("locale") else []
    comma = [name for name in others if name.lower().startswith(("de_", "fr_")) and "utf" in name.lower()]
    if comma:
        with open(os.path.join(HERE, "contract.txt"), encoding="utf-8") as f:
            steps = [s for s in harness.read_transcript(f.read()) if not harness.draws(s[0])]
        kept, tests.env = tests.env, {**tests.env, "LC_ALL": comma[0]}
        harness.batch(tests, "contract.txt in " + comma[0], steps)
        tests.env = kept


def fenced(text):
    """The fenced blocks of a Markdown text."""
    return re.findall(r"^```[a-z]*\n(.*?)^```$", text, re.S | re.M)


def command_names(tests):
    done = tests.run("-c", "show commands")
    return sorted({line.split()[0] for line in done.stdout.splitlines() if line and not line.startswith(" ")})


def readme(tests):
    with open(os.path.join(harness.ROOT, "README.md"), encoding="utf-8") as f:
        blocks = fenced(f.read())
    for i, block in enumerate(blocks):
        name = "README.md, block %d" % (i + 1)
        if block.startswith(harness.PROMPT):
            steps = harness.read_transcript(block)
            harness.replay(tests, name, steps)
            plots_of(tests, name, steps)
        elif block.startswith("$ "):
            path = os.path.dirname(tests.fret) + ":" + tests.env["PATH"]
            for part in re.split(r"^\$ ", block, flags=re.M)[1:]:
                command, _, want = part.partition("\n")
                done = subprocess.run(["sh", "-c", command], capture_output=True, text=True, cwd=tests.dir,
                                      env={**tests.env, "PATH": path}, timeout=60)
                tests.same("%s: %s" % (name, command), want, done.stdout + done.stderr)
