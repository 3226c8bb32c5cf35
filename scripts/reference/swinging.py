#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""swinging.csv: loss under harmonic normal and tangential forces, event by event and exact.

With P = F_N + F_x/mu and M = F_N - F_x/mu the memory of a contact is a curve rising in both from (0, 0) to
the present (M, P); the slice at load N = (M+P)/2 of it has the slope sigma = (dP-dM)/(dP+dM). When both grow
the curve grows; when M falls below it, the curve is cut at M and goes straight up (slip forward); when P does,
it is cut at P and goes straight across (slip backward). The front is at the cut. With F(y) the normal force
at depth y, D and d the depths of now and of the front, slip forward dissipates
    dW = -dM mu^2 eta [F(D) - F(d) - (D-d) F'(d)] / F'(d),    slip backward the same with dP.
--check follows independent springs in small steps instead, and compares."""

import sys

from mpmath import mp, mpf

import oracle

mp.dps = 64
NOISE = mpf(10)**-50  # relative, of a force
INSTANT = mpf(10)**-22  # phases shorter than this dissipate next to nothing: their slip begins from nothing


class Ramp:
    """M and P on a straight way, s from 0 to 1."""

    def __init__(self, start, end):
        self.start, self.end = start, end
        self.turns = [mpf(0), mpf(1)]

    def at(self, s):
        return [a + (b - a) * s for a, b in zip(self.start, self.end)]

    def fall(self, which, s):
        """-dM/ds or -dP/ds"""
        return self.start[which] - self.end[which]

    def when(self, which, level, lo, hi):
        a, b = self.start[which], self.end[which]
        return (level - a) / (b - a)


class Swing:
    """One period of M and P, each mean + size cos(s - lag)."""

    def __init__(self, FN, FNA, phase, FX, mu):
        self.mean, self.size, self.lag = FN, [], []
        for sign in (-1, 1):
            x, y = FNA * mp.cos(phase) + sign * FX / mu, -FNA * mp.sin(phase)  # of cos s and sin s
            self.size.append(mp.hypot(x, y))
            self.lag.append(mp.atan2(y, x))
        self.turns = [mpf(0), 2 * mp.pi]
        for lag in self.lag:
            self.turns += [lag + j * mp.pi for j in range(-3, 6) if 0 < lag + j * mp.pi < 2 * mp.pi]
        self.turns = apart(self.turns, INSTANT)

    def at(self, s):
        return [self.mean + size * mp.cos(s - lag) for size, lag in zip(self.size, self.lag)]

    def fall(self, which, s):
        return self.size[which] * mp.sin(s - self.lag[which])

    def when(self, which, level, lo, hi):
        angle = mp.acos(max(-1, min(1, (level - self.mean) / self.size[which])))
        best = [self.lag[which] + sign * angle + 2 * j * mp.pi for sign in (1, -1) for j in range(-3, 4)]
        return min(best, key=lambda s: max(lo - s, s - hi, 0))


def apart(values, distance):
    """Sorted, those that coincide taken once."""
    out = []
    for v in sorted(values):
        if not out or v - out[-1] > distance:
            out.append(v)
    return out


class Piece:
    """A part of the memory curve: straight, or the way itself between two instants. Points are [M, P]."""

    def __init__(self, first, last, way=None, lo=None, hi=None):
        self.first, self.last, self.way, self.lo, self.hi = first, last, way, lo, hi

    def other(self, which, level):
        """The other coordinate where coordinate `which` has the level."""
        if self.way:
            return self.way.at(self.way.when(which, level, self.lo, self.hi))[1 - which]
        a, b = self.first[1 - which], self.last[1 - which]
        span = self.last[which] - self.first[which]
        return a if a == b else a + (b - a) * (level - self.first[which]) / span

    def cut(self, which, level):
        """The part below the level."""
        point = [None, None]
        point[which], point[1 - which] = level, self.other(which, level)
        hi = self.way.when(which, level, self.lo, self.hi) if self.way else None
        return Piece(self.first, point, self.way, self.lo, hi)


class Contact:
    def __init__(self, scene, mu):
        self.s, self.mu = scene, mu
        self.curve, self.W, self.scale = [], mpf(0), mpf(1)

    def other(self, which, level):
        """Where the curve crosses the level."""
        for piece in reversed(self.curve):
            if piece.first[which] <= level and piece.first[which] < piece.last[which]:
                return piece.other(which, level)
        return mpf(0)

    def slopeF(self, y):
        return self.s.p * self.s.Kf * y**(self.s.p - 1)

    def rate(self, way, which, s):
        """The bracket of the formula above, of slip with front at the level of M (0) or P (1)."""
        point = way.at(s)
        N = (point[which] + self.other(which, point[which])) / 2
        D, d = self.s.depth(sum(point) / 2), self.s.depth(N)
        if D - d < mpf(10)**-24 * D:
            return mpf(0)
        return (self.s.force(D) - self.s.force(d)) / self.slopeF(d) - (D - d)

    def shrink(self, which, level, end):
        kept = []
        for piece in self.curve:
            if piece.last[which] <= level:
                kept.append(piece)
            elif piece.first[which] < level:
                kept.append(piece.cut(which, level))
        corner = kept[-1].last if kept else [mpf(0), mpf(0)]
        if end[1 - which] - corner[1 - which] > NOISE * self.scale:
            kept.append(Piece(corner, end))
        elif kept:
            kept[-1].last = end
        self.curve = kept

    def crossings(self, way, coordinates, lo, hi):
        """lo, hi and when a falling way meets the levels between which the curve is smooth."""
        begin, end, times = way.at(lo), way.at(hi), [lo, hi]
        for piece in self.curve:
            for which in coordinates:
                for level in (piece.first[which], piece.last[which]):
                    if end[which] + NOISE * self.scale < level < begin[which] - NOISE * self.scale:
                        times.append(way.when(which, level, lo, hi))
        return apart([t for t in times if hi - t > INSTANT], INSTANT) + [hi]

    def slip(self, way, which, lo, hi):
        """Between two instants with the front falling at the level of `which`."""
        end = way.at(hi)
        times = self.crossings(way, [which], lo, hi)
        unit = self.s.depth(self.scale) * self.scale  # quad's tolerance is absolute
        work = sum(mp.quad(lambda s: self.rate(way, which, s) * way.fall(which, s) / unit, [a, b])
                   for a, b in zip(times, times[1:]))
        self.W += unit * self.mu**2 * self.s.eta * work
        self.shrink(which, end[which], end)

    def go(self, way):
        self.scale = max(self.scale, *way.at(way.turns[-1]))
        for lo, hi in zip(way.turns, way.turns[1:]):
            begin, end = way.at(lo), way.at(hi)
            assert min(begin) > 0 or not self.curve, "gross slip"
            assert min(end) > 0, "gross slip"
            rise = [b - a > NOISE * self.scale for a, b in zip(begin, end)]
            fall = [a - b > NOISE * self.scale for a, b in zip(begin, end)]
            if rise == [True, True]:
                self.curve.append(Piece(begin, end, way, lo, hi))
            elif fall == [True, True]:
                self.both_fall(way, lo, hi)
            elif fall[0]:
                self.slip(way, 0, lo, hi)
            elif fall[1]:
                self.slip(way, 1, lo, hi)
            elif rise[0] or rise[1]:
                self.curve.append(Piece(begin, end))

    def both_fall(self, way, lo, hi):
        """Slip is forward while P is above the curve at the level of M, backward below. The instants
        of change are looked for anew after each, since the curve is another then."""
        while hi > lo:
            def above(s):
                M, P = way.at(s)
                return P - self.other(0, M)
            stop = self.crossings(way, (0, 1), lo, hi)[1]
            times = [lo + (stop - lo) * mpf(i) / 40 for i in range(1, 40)]
            values = [above(s) for s in times]
            signs = [0 if abs(v) < mpf(10)**-45 * self.scale else mp.sign(v) for v in values]
            assert all(signs) or not any(signs)
            i = next((i for i in range(1, 39) if signs[i] != signs[0]), None)
            if i is not None:
                stop = bisect(above, times[i - 1], times[i])
            if signs[0] == 0:  # back along the curve: no slip
                M, _ = end = way.at(stop)
                self.shrink(0, M, end)
            else:
                self.slip(way, 0 if signs[0] > 0 else 1, lo, stop)
            lo = stop


def bisect(f, lo, hi):
    sign = mp.sign(f(lo))
    for _ in range(170):
        mid = (lo + hi) / 2
        if mp.sign(f(mid)) == sign:
            lo = mid
        else:
            hi = mid
    return (lo + hi) / 2


# geometry (n, A), E0, k, mu, FN, FA, FNA, phase in degrees
SPHERE, CONE, QUARTIC = (2, "50"), (1, "0.05"), (4, "1e6")
SCENES = [
    (SPHERE, "100e9", "0", "0.5", 100, 20, 30, 90),
    (SPHERE, "100e9", "0", "0.5", 100, 20, 30, 0),
    (SPHERE, "100e9", "0", "0.5", 100, 20, 30, 45),
    (SPHERE, "100e9", "0", "0.5", 100, 20, 30, 180),
    (SPHERE, "100e9", "0", "0.5", 100, 20, 30, 270),
    (SPHERE, "100e9", "-0.4", "0.5", 100, 20, 30, 90),
    (SPHERE, "100e9", "0.5", "0.5", 100, 20, 30, 90),
    (SPHERE, "210e9", "0.5", "0.4", 100, 20, 10, 45),
    (SPHERE, "210e9", "-0.4", "0.4", 100, 25, 1, 0),
    (CONE, "210e9", "0", "0.4", 100, 20, 30, 90),
    (CONE, "210e9", "-0.4", "0.4", 100, 10, 60, 270),
    (CONE, "210e9", "0.5", "0.4", 100, 20, 40, 135),
    (SPHERE, "210e9", "0", "0.4", 100, 5, 85, 45),  # contact nearly lost
    (SPHERE, "210e9", "0", "0.4", 100, 8, 75, 0),
    (SPHERE, "210e9", "-0.4", "0.4", 100, 1, 97, 0),
    (QUARTIC, "210e9", "0.5", "0.4", 100, 12, 50, 225),
    (SPHERE, "210e9", "0", "0.4", 100, 20, "0.001", 90),
    (SPHERE, "210e9", "0", "0.4", 100, 12, 30, 0),
    (SPHERE, "210e9", "0", "0.4", 100, "0.5", 30, 37),  # next to no slip
]
NAMES = {SPHERE: "paraboloid R=10 mm", CONE: "cone slope=0.05", QUARTIC: "power n=4 A=1e6 m^-3"}


def build(given):
    (n, A), E0, k, mu = given[:4]
    return oracle.equal_bodies(E0, "0.3", k, "1e-3", n, A, mu), mpf(mu)


def limit(given):
    """W and dW after one period and after three."""
    FN, FA, FNA, degrees = (mpf(x) for x in given[4:])
    scene, mu = build(given)
    phase = mp.pi * degrees / 180
    contact = Contact(scene, mu)
    start = Swing(FN, FNA, phase, FA, mu)
    contact.go(Ramp([mpf(0), mpf(0)], [FN, FN]))
    contact.go(Ramp([FN, FN], start.at(0)))
    losses = []
    for _ in range(3):
        before = contact.W
        contact.go(start)
        losses.append(contact.W - before)
    assert abs(losses[2] - losses[1]) < mpf(10)**-26 * contact.W, losses  # the third repeats the second
    return contact.W - losses[1] - losses[2], losses[0], contact.W, losses[2]


def main():
    rows = []
    for given in SCENES:
        W1, dW1, W, dW = limit(given)
        if "--check" in sys.argv:
            import brute
            rough = brute.swinging(build(given)[0], given)
            assert abs(rough[0] - W) < 2e-5 * W and abs(rough[1] - dW) < 2e-5 * W, (given, rough)
        rows.append((f"{oracle.material(given[2], given[1][:-2])}; geometry {NAMES[given[0]]}; friction {given[3]}; "
                     f"press FN={given[4]} N", f"cycle FA={given[5]} N times 3 FNA={given[6]} N phase={given[7]} deg", W, dW, W1, dW1))
    oracle.write_cells("swinging.csv", "swinging.py",
                       ["loss under harmonic F_N and F_x, exact (limit of ever finer chords), J: W after three",
                        "periods, dW of the third; W1 and dW1 after the first. From the press straight in (FN, Fx) to Fx = FA, FN + FNA cos(phase), then",
                        "Fx = FA cos s, FN + FNA cos(s + phase). dW = 0 where the way goes back on itself without slip."],
                       ["setup", "cycle", "W", "dW", "W1", "dW1"], rows)


if __name__ == "__main__":
    main()
