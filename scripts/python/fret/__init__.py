# SPDX-License-Identifier: GPL-3.0-or-later
"""Partial-slip (fretting) contact of axisymmetric solids with E(z) = E0 (z/c0)^k, by libfret. SI units throughout.

Contact is a contact with a memory: press, step, cycle, and ask; arrays of loads at once. session() runs statements of the
program `fret`, with its units, `solve` and `fit`. Theory: Mathematics 2022, 10, 3641."""
from ._library import Error, GrossSlip
from ._contact import (Body, Contact, Material, Shape, State, cone, exact_sphere, flat_cone, flat_paraboloid, flat_rounded,
                      power, powers, rigid, sphere, table)
from ._session import Session, SessionError


def session(program=None):
    """A session of the program: see Session."""
    return Session(program)


__all__ = ["Body", "Contact", "Error", "GrossSlip", "Material", "Session", "SessionError", "Shape", "State", "cone",
           "exact_sphere", "flat_cone", "flat_paraboloid", "flat_rounded", "power", "powers", "rigid", "session", "sphere",
           "table"]
