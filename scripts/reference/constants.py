# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes src/number/constants.h: constants of the elementary functions and of the quadrature."""
from mpmath import mp, mpf, exp, log, pi, sinh, cosh, bernoulli, factorial, fprod, polyroots

mp.dps = 60


def pair(x):
    hi = float(x)
    return "{%s, %s}" % (hi.hex(), float(x - mpf(hi)).hex())


def table(name, values):
    print("static const dd %s[%d] = {" % (name, len(values)))
    for v in values:
        print("    %s," % pair(v))
    print("};")


def real(x):
    return mp.nstr(x, 25, min_fixed=0, max_fixed=0) + "L"


print('''/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Constants of the elementary functions and of the quadrature: made by scripts/reference/constants.py. Each
 * file that includes this keeps what it reads. Not installed. */
#ifndef FRET_NUMBER_CONSTANTS_H
#define FRET_NUMBER_CONSTANTS_H

#include "fret/base.h"
#include "number/pair.h"

/* clang-format off */''')
print("/* ln(j/128) for j = 90 .. 181 */")
table("log_128", [log(mpf(j) / 128) for j in range(90, 182)])
table("power_of_two", [mpf(2) ** (mpf(j) / 64) for j in range(64)])
ln2_part = log(mpf(2)) / 64
print("static const dd ln2_64 = %s;" % pair(ln2_part))
print("static const double ln2_64_rest = %s;" % float(ln2_part - mpf(float(ln2_part)) - mpf(float(ln2_part - mpf(float(ln2_part))))).hex())
ln = log(mpf(2))
print("static const dd ln2 = %s;" % pair(ln))
print("static const double ln2_rest = %s;" % float(ln - mpf(float(ln)) - mpf(float(ln - mpf(float(ln))))).hex())
print("static const dd half_log_2pi = %s;" % pair(log(2 * pi) / 2))
print("static const dd half_pi = %s;" % pair(pi / 2))
table("inverse_factorial", [1 / factorial(j) for j in range(0, 26)])
table("inverse", [mpf(0)] + [1 / mpf(j) for j in range(1, 14)])
table("stirling", [bernoulli(2 * j) / (2 * j * (2 * j - 1)) for j in range(1, 17)])
print("/* Double-exponential rule, step 1/16: distance from the nearer end, and weight; the nodes of steps 1/8, 1/4 and 1/2 among them. */")
print("static const struct {\n    fret_real small, weight;\n} doubling_rule[73] = {")
for i in range(73):
    u = mpf(i) / 16
    e = exp(-pi * sinh(u))
    print("    {%s, %s}," % (real(e / (1 + e)), real(pi * cosh(u) * e / (1 + e) ** 2 / 16)))
print("};")
nodes = [(1 + x) / 2 for x in sorted(polyroots([6435, 0, -12012, 0, 6930, 0, -1260, 0, 35]))]  # Legendre's
nodes = [x / 2 for x in nodes] + [(1 + x) / 2 for x in nodes]
print("/* The polynomial through the values at eight points of Gauss in either half of 0 .. 1, at 0. */")
print("static const fret_real end_weight[16] = {")
for x in nodes:
    print("    %s," % real(fprod(other / (other - x) for other in nodes if other != x)))
print("};")
print("\n#endif")
