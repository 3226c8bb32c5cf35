# SPDX-License-Identifier: GPL-3.0-or-later
"""python3 scripts/python/examples/beside.py FILE.csv: a loop of somebody's finite elements beside the theory. FILE has a line
of names and the columns dx [m] and Fx [N], steel on a sphere of R = 10 mm under 100 N; dx drives, Fx is compared."""
import sys

import fret
import numpy as np

table = np.genfromtxt(sys.argv[1], delimiter=",", skip_header=1)
contact = fret.Contact(fret.Material(E0=210e9, nu=0.3), fret.sphere(R=10e-3), mu=0.4).press(FN=100)
theory = np.array([contact.step(dx=dx).forces.Fx for dx in table[:, 0]])
off = table[:, 1] - theory
print("%d rows: rms %.3g N, worst %.3g N in row %d" % (len(off), np.sqrt(np.mean(off**2)), np.max(np.abs(off)),
                                                      np.argmax(np.abs(off)) + 1))
print("work of Fx: theirs %.6g J, theory %.6g J" % tuple((F[1:] + F[:-1]) @ np.diff(table[:, 0]) / 2
                                                            for F in (table[:, 1], theory)))
