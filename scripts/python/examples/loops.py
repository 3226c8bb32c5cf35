# SPDX-License-Identifier: GPL-3.0-or-later
"""python3 scripts/python/examples/loops.py FILE.png: Figure 7a of Mathematics 2022, 10, 3641, hysteresis loops of a cone in
graded solids, by matplotlib."""
import sys

import fret
import matplotlib.pyplot as plt
import numpy as np

steel, cone, mu, FN = dict(E0=210e9, nu=0.3), fret.cone(slope=0.05), 0.4, 100
a0 = fret.Contact(fret.Material(**steel), cone, mu).press(FN=FN).state.a  # c0 is the radius at k = 0
dx0max = fret.Contact(fret.Material(**steel), cone, mu).press(FN=FN).dxmax
Fx = 0.9 * mu * FN * np.cos(np.linspace(0, 2 * np.pi, 200))
for k in (-0.7, -0.5, 0, 0.5, 0.7):
    contact = fret.Contact(fret.Material(**steel, k=k, c0=a0), cone, mu).press(FN=FN)
    dx = [contact.step(Fx=force).forces.dx for force in Fx]
    plt.plot(np.array(dx) / dx0max, Fx / (mu * FN), label="k = %g" % k)
plt.xlabel("dx/dx0max")
plt.ylabel("Fx/(mu FN)")
plt.legend()
plt.savefig(sys.argv[1])
