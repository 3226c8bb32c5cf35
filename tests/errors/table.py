# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs errors.txt: each entry as a file, by -c and through a pipe, or in one of these ways in turn. The caret must stand below
the column that the message names."""
import os
import re
import unicodedata

import harness

SCENE = "material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N"


# files that the entries read
FILES = {"gap.csv": "r [mm],f [um]\n0,0\n1,1\n2,4\n", "loop.csv": "dx [um],Fx [N]\n0,0\n0.1,5\n0.2,8\n0.3,11\n",
         "loss.csv": "F [N],y [uJ]\n5,0.01\n10,0.08\n15,0.25\n", "ambiguous.csv": "F [N],dW [uJ]\n5,0.01\n10,0.08\n",
         "modulus.csv": "F [N],E0\n1,2\n2,3\n3,4\n",
         "unitless.csv": "FN [N],Fx\n100,0\n100,5\n", "dx.csv": "dx,Fx [N]\n0,0\n1,5\n",
         "twice.csv": "dx [um],dx [mm],Fx [N],Fx [kN]\n0,0,0,0\n1,1,5,5\n", "double.csv": "u [um],v,u [mm]\n0,1,0\n1,2,5\n", "zero.csv": "FN [N],Fx [N]\n0,0\n100,5\n", "slide.csv": "FN [N],Fx [N]\n100,0\n100,50\n",
         "word.csv": "FN [N],Fx [N]\n100,0\n100,xx\n", "words.csv": "FN [N],Fx [N]\n100,0\nx,5\n",
         "far.csv": "r [mm],f [um]\n0.1,1\n1,50\n", "half.csv": "dz [um],Fx [N]\n1,0\n", "lone.csv": "FN [N],dx [um]\n1,0\n",
         "three.csv": "FN [N],dz [um],dx [um]\n1,2,0\n2,3,0.1\n", "sine.csv": "sin,x [N],y [um]\n1,2,3\n2,3,4\n",
         "phase.csv": "phase,y [uJ]\n0,2.1\n45,2.4\n90,2.5\n", "p.csv": "p,y\n1,2\n2,3\n", "deep.csv": "FN [N],Fx [N]\n1e9,0\n"}


def entries(text):
    for block in text.split("\n\n"):
        lines = [line for line in block.splitlines() if not line.startswith("#")]
        statements = [line[2:] for line in lines if line.startswith("> ") or line == ">"]
        if statements:
            yield ([SCENE if s == "@scene" else s for s in statements],
                   [line[2:] for line in lines if line.startswith("| ")],
                   [line for line in lines if line and line[0] not in ">|"])


def wide(text):
    """How many columns of a terminal the text takes."""
    return sum(0 if unicodedata.combining(c) else 2 if unicodedata.east_asian_width(c) in "WF" else 1 for c in text)


def part_of(source, column, shown, caret):
    """Is this the part of a long line that may be shown, with dots where it is cut, and the caret below the column?"""
    before, after = shown.startswith("  ..."), shown.endswith("...") and not source.endswith("...")
    text, behind = shown[5 if before else 2:-3 if after else None], source[column - 1:]
    left = next((n for n in range(len(text) + 1) if wide(text[:n]) == caret - (5 if before else 2)), None)
    begin = column - 1 - left if left is not None else -1
    return (begin >= 0 and source[begin:begin + len(text)] == text and wide(text) <= 100 and before == (begin > 0) and
            after == (begin + len(text) < len(source)) and behind.startswith(text[left:]))


def carets(messages, lasts, script):
    """Each message with a place is followed by its line, and by a caret below the column, which counts characters; ~ marks
    follow up to the last column, if it is known."""
    lines, lasts, script = messages.splitlines(), list(lasts), script.splitlines()
    for i, line in enumerate(lines):
        found = re.match(r"\S+:(\d+):(\d+): error: ", line)
        if not found:
            continue
        last, column = lasts.pop(0) if lasts else None, int(found.group(2))
        if i + 2 >= len(lines) or "^" not in lines[i + 2]:
            return False
        row, shown, caret = int(found.group(1)) - 1, lines[i + 1], lines[i + 2].index("^")
        source = script[row]
        if row and script[row - 1].rstrip().endswith("\\"):  # a continuation line is shown without its indentation
            blanks = min(len(source) - len(source.lstrip(" ")), column - 1)
            source, column, last = source[blanks:], column - blanks, int(last) - blanks if last else None
        plain = source.isprintable()  # other lines are shown escaped
        if "..." not in shown and (wide(source[:column - 1]) if plain else column - 1) != caret - 2:
            return False
        if wide(source) > 100 and plain and not part_of(source, column, shown, caret):
            return False
        if last and lines[i + 2].count("~") != wide(source[column - 1:int(last)]) - 1:
            return False
    return True


def check(tests, number, statements, out, errors):
    script = "\n".join(statements) + "\n"
    status = 1 if any("error:" in line for line in errors) else 0
    lasts = [found.group(2) for found in (re.match(r"\d+:\d+(-(\d+))?: error:", line) for line in errors) if found]
    errors = [re.sub(r"^(\d+:\d+)-\d+: error:", r"\1: error:", line) for line in errors]
    with tests.file(script) as path:
        ways = {path: lambda: tests.run(path), "-c": lambda: tests.run("-c", script), "stdin": lambda: tests.run(input=script)}
        runs = {name: way() for i, (name, way) in enumerate(ways.items()) if not tests.few or i == number % 3}
    for name, done in runs.items():
        messages = [line for line in done.stderr.splitlines() if "error:" in line or line.startswith(("warning:", "note:"))]
        want = [line if line.startswith(("warning:", "note:")) else name + ":" + line for line in errors]
        ok = (messages == want and harness.same_text("\n".join(out), done.stdout) and done.returncode == status
              and carets(done.stderr, lasts, script))
        way = "file" if name == path else name
        tests.check("errors, %s: %s" % (way, " \\n ".join(statements)), ok,
                    harness.diff("\n".join(out + want), done.stdout + done.stderr) + "\nexit %d" % done.returncode)


def run(tests):
    for name, text in FILES.items():
        with open(os.path.join(tests.dir, name), "w", encoding="ascii") as f:
            f.write(text)
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "errors.txt")
    with open(path, encoding="utf-8") as f:
        tests.each([lambda n=n, e=entry: check(tests, n, *e) for n, entry in enumerate(entries(f.read()))])
