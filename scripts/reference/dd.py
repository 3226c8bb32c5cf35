#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""dd.csv: elementary functions of double-double arguments; each result as the sum of three doubles."""

import os
import random

from mpmath import mp, mpf

mp.dps = 80
rnd = random.Random(7)


def parts(x, count=3):
    out = []
    for _ in range(count):
        d = float(x)
        out.append(d.hex())
        x -= mpf(d)
    return out


def argument(scale):
    hi = rnd.choice((-1, 1)) * scale
    return hi, float(mpf(hi) * rnd.uniform(-0.49, 0.49) * mpf(2)**-53)


rows = []


def add(name, f, hi, lo):
    rows.append(",".join([name, hi.hex(), lo.hex()] + parts(f(mpf(hi) + mpf(lo)))))


for _ in range(120):
    hi, lo = argument(10**rnd.uniform(-30, 2.84))
    add("exp", mp.exp, hi, lo)
    add("expm1", mp.expm1, hi, lo)
    hi, lo = argument(10**rnd.uniform(-290, 290))
    add("log", mp.log, abs(hi), lo)
    hi, lo = argument(10**rnd.uniform(-30, 20))
    add("log1p", mp.log1p, abs(hi), lo)
    hi, lo = argument(rnd.random() * 10**rnd.uniform(-20, 0))
    add("log1p", mp.log1p, -abs(hi), lo)
    add("sin", lambda x: mp.sin(mp.pi * x / 2), abs(hi), lo)
    hi, lo = argument(rnd.uniform(0.5, 3))
    add("gamma", mp.gamma, abs(hi), lo)
    hi, lo = argument(rnd.uniform(3, 150))
    add("gamma", mp.gamma, abs(hi), lo)
for x in (1.0, 1 + 2.0**-52, 1 - 2.0**-53, 0.7071067811865475, 0.7071067811865476, 2.0, 0.5):
    add("log", mp.log, x, 0.0)
for x in (0.0054, 0.00540001, -0.0054, 0.010830424696249145, 0.005415212348124572):
    add("expm1", mp.expm1, x, 0.0)
for x in (2.0**-60, 0.5, 1.0, 1 - 2.0**-53):
    add("sin", lambda x: mp.sin(mp.pi * x / 2), x, 0.0)

path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../tests/reference/dd.csv")
with open(path, "w", encoding="utf-8") as out:
    out.write("# exp, expm1, log, log1p, sin(pi x/2), gamma; made by scripts/reference/dd.py\n"
              "# name, argument hi, lo; result as three parts\n")
    out.write("\n".join(rows) + "\n")
