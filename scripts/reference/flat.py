# SPDX-License-Identifier: GPL-3.0-or-later
"""Fields of gaps with a flat end, by quadrature."""

from mpmath import mp

import shape


class Flat(shape.Shape):
    """The same of a gap with a flat end, a = b + e1."""

    def steepness(self, e):
        """g'"""
        k, m, b, a, D, z = self.k, self.m, self.b, *self.span(e)
        if self.kind == shape.CONE:
            return self.g(e) / a + self.slope * b * D**(m - 1) * a**-k
        if self.kind == shape.PARABOLOID:
            return (2 * self.g(e) + b**2 * z**(m - 1) / self.R) / a
        return (2 * self.g(e) + a * b * z**m / (2 * m * self.R) * mp.hyp2f1(0.5, m, m + 1, z)) / a

    def f(self, r):
        x = max(r - self.b, 0)
        return {shape.CONE: self.slope * x, shape.PARABOLOID: x * (r + self.b) / (2 * self.R),
                shape.ROUNDED: x**2 / (2 * self.R)}[self.kind]

    def pressure(self, e1, r):
        b, m = self.b, self.m
        breaks = [e1, *(x for x in (abs(r - b), abs(r - b) / 30) if x < e1)]
        if r <= b:  # e = e1 v^(1/m)
            def p(v):
                e = e1 * v**(1 / m)
                return self.steepness(e) * ((b - r + e) * (b + e + r))**(m - 1) * e / (m * v)
            return mp.quad(p, [0, *sorted((x / e1)**m for x in breaks)])
        D = (b + e1)**2 - r**2

        def q(v):  # x^2 = r^2 + D v^(1/m)
            x = mp.sqrt(r**2 + D * v**(1 / m))
            return self.steepness(x - b) / x
        return D**m / (2 * m) * mp.quad(q, [0, *sorted((x / e1)**m for x in breaks)])

    def surface(self, e1, r):
        b, m, d = self.b, self.m, self.g(e1)

        def below(v):  # x = b v^(1/(2m))
            return (r**2 - b**2 * v**(1 / m))**-m

        def beyond(v):  # x = b + e1 v^(1/m)
            e = e1 * v**(1 / m)
            return (d - self.g(e)) * (b + e)**self.k * ((r - b - e) * (r + b + e))**-m * e / (m * v)
        return 2 * mp.cos(mp.pi * self.k / 2) / mp.pi * (
            d * b**(2 * m) / (2 * m) * mp.quad(below, [0, 0.5, 1]) + mp.quad(beyond, [0, 0.5, 1]))

    def pressure_at_rim(self, e1, r):
        """The same closer to the flat end: linear in the logarithm of the distance from what is singular."""
        b, m = self.b, self.m
        lo = max(r, b)
        first = min(abs(r - b), e1) / 1000

        def rate(e):  # x = lo + e
            return self.steepness(lo - b + e) * ((lo - r + e) * (lo + e + r))**(m - 1)
        near = mp.quad(lambda v: rate(first * v**(1 / m)) * first * v**(1 / m) / (m * v), [0, 0.5, 1])
        ends, last = [mp.log(first)], mp.log(b + e1 - lo)
        while ends[-1] + 2 < last:
            ends.append(ends[-1] + 2)
        return near + mp.quad(lambda t: rate(mp.exp(t)) * mp.exp(t), ends + [last])
