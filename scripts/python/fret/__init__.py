# SPDX-License-Identifier: GPL-3.0-or-later
"""Partial-slip (fretting) contact of axisymmetric solids with E(z) = E0 (z/c0)^k, by libfret. SI units throughout.

Contact is a contact with a memory: press, step, cycle, and ask for forces, fields, stress and work; arrays of loads at once. session() runs statements of the
program `fret`, with its units, `solve` and `fit`. Arguments out of range raise Error, a force beyond the friction limit
GrossSlip, memory that is out MemoryError; a contact is then as before. Equation numbers are those of Mathematics 2022, 10,
3641, by whose method (dimensionality reduction) all is computed; accuracies are what the tests of the library hold it to."""
from typing import Optional

from ._library import Error, GrossSlip
from ._contact import (Body, Contact, Material, Shape, State, Stress, cone, exact_sphere, flat, flat_cone,
                      flat_paraboloid, flat_rounded, power, powers, rigid, sphere, table)
from ._session import Session, SessionError


def session(program: Optional[str] = None) -> Session:
    """A session of the program: see Session.

    >>> import fret
    >>> with fret.session() as s:
    ...     pad = s.run("material E0=114 GPa nu=0.34 k=0.2 c0=0.1 mm; geometry sphere R=20 mm; friction 0.35; press FN=25 N")
    ...     root, how = s.run("solve mu for dWd(1 um) = 12 uJ from 0.05 to 0.3")
    ...     print("%s = %.6f by %s" % (root["name"], root["value"], how["method"]))
    ...     best = s.run("maximize dWd(1 um) over FN = 1 N .. 400 N")
    ...     print("%.4f %s" % (best[0]["value"], best[0]["unit"]))
    ...     print("%.6g uJ" % s.value("dWd(1 um)/(1 uJ)"))
    mu = 0.177743 by secant
    23.4964 N
    12.6102 uJ
    """
    return Session(program)


__all__ = ["Body", "Contact", "Error", "GrossSlip", "Material", "Session", "SessionError", "Shape", "State", "Stress",
           "cone", "exact_sphere", "flat", "flat_cone", "flat_paraboloid", "flat_rounded", "power", "powers", "rigid", "session",
           "sphere", "table"]
