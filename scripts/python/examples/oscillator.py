# SPDX-License-Identifier: GPL-3.0-or-later
"""python3 scripts/python/examples/oscillator.py harmonic.csv: the frequency response of a mass on a spring and a frictional
contact, m x'' + k x + F_x = P cos(omega t), by harmonic balance from a table of `export harmonic` and by time integration
through the module. scripts/oscillator.c tells the equations, the table, and is the same in C."""
import sys

import fret
import numpy as np

MASS, STIFFNESS, FORCE = 1.0, 10e6, 4.0  # [kg], [N/m], [N]
STEPS, PERIODS = 200, 60


def integrate(contact, d, omega, psi):
    """Amplitudes of the first and the third harmonic of the motion [m], settled, from its peak d [m] on (velocity Verlet)."""
    dt, x, v, motion = 2 * np.pi / omega / STEPS, d, 0.0, []
    pull = FORCE * np.cos(2 * np.pi * np.arange(PERIODS * STEPS + 1) / STEPS + psi)
    contact.press(FN=25)
    acceleration = (pull[0] - STIFFNESS * x - contact.step(dx=x).forces.Fx) / MASS
    for now in pull[1:]:
        v += dt / 2 * acceleration
        x += dt * v
        acceleration = (now - STIFFNESS * x - contact.step(dx=x).forces.Fx) / MASS
        v += dt / 2 * acceleration
        motion.append(x)
    return 2 * np.abs(np.fft.rfft(motion[-STEPS:]))[[1, 3]] / STEPS


blade = fret.Contact(fret.Material(E0=114e9, nu=0.34, k=0.2, c0=1e-4), fret.sphere(R=20e-3), mu=0.35)
print("frequency [Hz],by harmonic balance [m],by time [m],difference,third harmonic")
for d, Kp, Kpp in np.genfromtxt(sys.argv[1], delimiter=",", skip_header=1):
    for side in (-1, 1):
        rest = side * np.sqrt((FORCE / d)**2 - Kpp**2)
        square = (STIFFNESS + Kp + rest) / MASS
        if square > 0:
            first, third = integrate(blade, d, np.sqrt(square), np.arctan2(Kpp, -rest))
            print("%.9g,%.9g,%.9g,%.3g,%.3g" % (np.sqrt(square) / (2 * np.pi), d, first, first / d - 1, third / first))
