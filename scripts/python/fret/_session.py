# SPDX-License-Identifier: GPL-3.0-or-later
"""The program `fret` as a session: statements in, objects out. For those who want units, `solve`, `fit`, `uncertainty`."""
import json
import os
import subprocess
from typing import Dict, List, Optional

import numpy


class SessionError(ValueError):
    """What the program refuses, in its words."""
    __module__ = "fret"


class Session:
    """A running `fret --format=json`, whose scene lasts from call to call. `program` is its path; else that of FRET_PROGRAM,
    of this checkout, or the one that is found. Raises OSError where there is none, SessionError for what it refuses.

    >>> import fret
    >>> with fret.session() as s:
    ...     done = s.run("material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N")
    ...     print("%.6g J" % s.value("dW(20 N)"))
    ...     print(s.table("c(F) for F = 10 N .. 30 N steps 2")["c(F)"].round(7))
    1.90646e-06 J
    [0.0001696 0.0001481 0.0001176]
    >>> fret.session().value("FN")
    Traceback (most recent call last):
        ...
    fret.SessionError: there is no load yet: press first (press FN=100 N)
    """

    # An expression that nobody asks: its value ends the answers to a line.
    _END = "271828182845904"

    def __init__(self, program: Optional[str] = None):
        built = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../build/fret")
        program = program or os.environ.get("FRET_PROGRAM") or (built if os.path.exists(built) else "fret")
        self._process = subprocess.Popen([program, "--format=json", "--keep-going", "--no-rc"], stdin=subprocess.PIPE,
                                         stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, encoding="utf-8")

    def run(self, statements: str) -> List[Dict]:
        """What the statements answer: a dict for each value, row, event, note or warning, in SI units. Raises SessionError
        at the first line that is refused; the lines before it have been run."""
        answers = []
        for line in statements.replace("\\\n", " ").splitlines():
            answers += self._line(line)
        return answers

    def value(self, expression: str) -> Optional[float]:
        """The value of an expression in SI units; None where it has none. Raises SessionError where it is refused."""
        return self.run(expression)[-1]["value"]

    def table(self, what: str) -> Dict[str, numpy.ndarray]:
        """The columns of `table WHAT`, in SI units; NaN where there is no value. Raises SessionError where it is refused."""
        answers = self.run("table " + what)
        names = next(answer["columns"] for answer in answers if answer.get("event") == "table")
        rows = [answer for answer in answers if names.keys() <= answer.keys()]
        return {name: numpy.array([row[name] for row in rows], dtype=float) for name in names}

    def _line(self, line: str) -> List[Dict]:
        try:
            self._process.stdin.write("%s\n%s\n" % (line, self._END))
            self._process.stdin.flush()
        except BrokenPipeError:
            raise SessionError("the session has ended") from None
        answers, refused = [], None
        for text in self._process.stdout:
            answer = json.loads(text)
            if answer.get("name") == self._END:
                break
            refused = refused or answer.get("error")
            answers.append(answer)
        else:
            refused = refused or "the session has ended"
        if refused:
            raise SessionError(refused)
        return answers

    def close(self) -> None:
        """Ends the program; nothing can be asked then."""
        self._process.communicate()

    def __enter__(self) -> "Session":
        return self

    def __exit__(self, *raised) -> None:
        self.close()
