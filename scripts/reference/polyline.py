# SPDX-License-Identifier: GPL-3.0-or-later
"""A contact under arbitrary histories, by clipping a polyline literally (no stack, no wiping rules).

The coordinate z is the depth y, where steps are straight in (delta_z, delta_x), or the load F, where
they are straight in (F_N, F_x). The line is (z, v): v = u and the bound is mu eta (edge - z), or
v = mu int sigma dF and the bound is mu (F_N - F). Springs follow v_new = clip(v_old + drive)."""

from mpmath import mp, mpf

ZERO = mpf(0)


def at(line, z):
    """v at z by linear interpolation; the line is zero beyond its end."""
    for (z0, v0), (z1, v1) in zip(line, line[1:]):
        if z0 <= z <= z1:
            return v0 + (v1 - v0) * (z - z0) / (z1 - z0) if z1 > z0 else v1
    return ZERO


def clip(line, edge, slope):
    """min(max(v, -B), B) with B = slope (edge - z): crossings become vertices."""
    for sign in (1, -1):
        def over(z, v):
            return sign * v - slope * (edge - z)
        new = []
        for i, (z, v) in enumerate(line):
            if i:
                z0, v0 = line[i - 1]
                o0, o1 = over(z0, v0), over(z, v)
                if o0 * o1 < 0:
                    zc = z0 + (z - z0) * o0 / (o0 - o1)
                    new.append((zc, sign * slope * (edge - zc)))
            new.append((z, sign * slope * (edge - z) if over(z, v) > 0 else v))
        line = new
    return line


def prune(line, edge, slope):
    """Drops vertices that are no corners."""
    tiny = mpf(10)**(20 - mp.dps)
    line = [p for i, p in enumerate(line) if i + 1 == len(line) or line[i + 1][0] - p[0] > tiny * edge]
    if len(line) > 1 and line[0][0] > 0:
        line[0] = (ZERO, line[0][1])
    kept = line[:1]
    for i in range(1, len(line) - 1):
        (z0, v0), (z1, v1), (z2, v2) = kept[-1], line[i], line[i + 1]
        if abs((v1 - v0) / (z1 - z0) - (v2 - v1) / (z2 - z1)) > tiny * slope:
            kept.append(line[i])
    return kept + line[1:][-1:]


def moved(line, edge, slope, dedge, drive):
    """The line after the edge moved by dedge (still > 0 at the end) and the drive by drive."""
    new_edge = edge + dedge
    free = [(z, v + drive) for z, v in line]
    if dedge > 0:
        free.append((new_edge, ZERO))
    elif dedge < 0:
        inside = [(z, v) for z, v in free if z < new_edge]
        free = inside + [(new_edge, at(line, new_edge) + drive)]
    return prune(clip(free, new_edge, slope), new_edge, slope)


def events(line, edge, slope, dedge, drive):
    """Times in (0,1) at which the moved line may change its topology: a vertex meets a bound or the
    edge, or the free line passes zero at a receding edge."""
    times = []

    def root(value, rate):
        if rate != 0:
            t = -value / rate
            if 0 < t < 1:
                times.append(t)
    for z, v in line:
        for sign in (1, -1):
            root(sign * v - slope * (edge - z), sign * drive - slope * dedge)
        root(edge - z, dedge)
    for (z0, v0), (z1, v1) in zip(line, line[1:]):
        m = (v1 - v0) / (z1 - z0)
        root(v0 + m * (edge - z0), m * dedge + drive)
    times = sorted(times)
    tiny = mpf(10)**(20 - mp.dps)
    cuts = [ZERO] + [t for i, t in enumerate(times) if t > tiny and t < 1 - tiny and
                     (i == 0 or t - times[i - 1] > tiny)] + [mpf(1)]
    return cuts


def corners(line):
    """(beta_j, z_j) of v = sum beta_j (z_j - z)_+."""
    slopes = [(v1 - v0) / (z1 - z0) for (z0, v0), (z1, v1) in zip(line, line[1:])] + [ZERO]
    return [(slopes[j + 1] - slopes[j], line[j + 1][0]) for j in range(len(line) - 1)]


def mean_power(z0, z1, p):
    """Mean of z^p over z from z0 to z1."""
    if abs(z1 - z0) < mpf(10)**(20 - mp.dps) * max(z0, z1):
        return ((z0 + z1) / 2)**p
    return (z1**(p + 1) - z0**(p + 1)) / ((p + 1) * (z1 - z0))


def mean_sum(line, edge, slope, dedge, drive, p):
    """Mean over the step of sum beta_j z_j^p. Between events each corner moves linearly and keeps its
    beta; that is checked at a third time."""
    total = ZERO
    cuts = events(line, edge, slope, dedge, drive)
    for t0, t1 in zip(cuts, cuts[1:]):
        def sample(f):
            t = t0 + (t1 - t0) * f
            return corners(moved(line, edge, slope, dedge * t, drive * t))
        first, middle, last = (sample(mpf(f) / 4) for f in (1, 2, 3))
        assert len(first) == len(middle) == len(last), (t0, t1, len(first), len(middle), len(last))
        for (b0, z0), (b1, z1), (b2, z2) in zip(first, middle, last):
            small = mpf(10)**(40 - mp.dps)
            assert abs(b0 - b2) + abs(b1 - b2) < small * slope
            assert abs(z0 + z2 - 2 * z1) < small * max(edge, edge + dedge)
            start, end = z0 - (z2 - z0) / 2, z2 + (z2 - z0) / 2
            total += (t1 - t0) * b1 * mean_power(max(start, ZERO), max(end, ZERO), p)
    return total


def quad_sum(line, edge, slope, dedge, drive, p):
    """The same by quadrature between the events (check). Scaled: quad's tolerance is absolute."""
    total, scale = ZERO, max(edge, edge + dedge)
    cuts = events(line, edge, slope, dedge, drive)
    for t0, t1 in zip(cuts, cuts[1:]):
        total += mp.quad(lambda t: sum((b / slope * (z / scale)**p for b, z in corners(
            moved(line, edge, slope, dedge * t, drive * t))), ZERO), [t0, t1])
    return total * slope * scale**p


class Contact:
    """Force, energies and state of a scene; both kinds of step."""

    def __init__(self, scene):
        self.s = scene
        self.dz = self.dx = self.W = ZERO
        self.line = []  # (y, u)

    def FN(self):
        return self.s.force(self.dz) if self.dz > 0 else ZERO

    def Fx(self):
        return sum((b * self.s.force(y) for b, y in corners(self.line)), ZERO) / self.s.eta

    def U(self):
        """1/(2 eta) int u^2 dK, u linear piece by piece."""
        p, Kf, total = self.s.p, self.s.Kf, ZERO
        for (y0, u0), (y1, u1) in zip(self.line, self.line[1:]):
            m = (u1 - u0) / (y1 - y0)
            c = u0 - m * y0

            def moment(e):
                return p * (p - 1) * Kf * (y1**(e + p - 1) - y0**(e + p - 1)) / (e + p - 1)
            total += c * c * moment(0) + 2 * c * m * moment(1) + m * m * moment(2)
        return total / (2 * self.s.eta)

    def by_displacement(self, dz, dx, check=False):
        """Straight to (dz, dx)."""
        dz, dx = mpf(dz), mpf(dx)
        D, V = dz - self.dz, dx - self.dx
        lo, hi = ZERO, mpf(1)  # the part of the step in contact
        if self.dz <= 0 and dz <= 0:
            self.dz, self.dx = dz, dx
            return
        if self.dz <= 0:
            lo = -self.dz / D
        if dz <= 0:
            hi = -self.dz / D
        slope, edge = self.s.mu * self.s.eta, max(self.dz, ZERO)
        line = self.line if edge > 0 else [(ZERO, ZERO)]
        D, V, before, p = D * (hi - lo), V * (hi - lo), self.U(), self.s.p
        if dz <= 0:
            D = -edge
        mean = mean_sum(line, edge, slope, D, V, p)
        if check:
            with mp.workdps(45):
                again = quad_sum(line, edge, slope, D, V, p)
                assert abs(again - mean) < mpf(10)**-22 * max(edge, dz)**p * slope
        self.line = moved(line, edge, slope, D, V) if dz > 0 else []
        self.dz, self.dx = dz, dx
        self.W += V * mean * self.s.Kf / self.s.eta - (self.U() - before)

    def by_force(self, FN, Fx, check=False):
        """Straight to (FN, Fx), |Fx| < mu FN or both 0. The centre sticks: delta_x moves with u(0)."""
        FN, Fx = mpf(FN), mpf(Fx)
        s, eta, q = self.s, self.s.eta, 1 / self.s.p
        F0, X0, before = self.FN(), self.Fx(), self.U()
        line, total, k = [], ZERO, corners(self.line)
        if F0 > 0:
            zs = [ZERO] + [s.force(y) for _, y in k]
            line = [(z, sum((b / eta * max(s.force(y) - z, ZERO) for b, y in k), ZERO)) for z in zs]
        else:
            line = [(ZERO, ZERO)]
        if FN == F0 == 0:
            return
        mean = mean_sum(line, F0, s.mu, FN - F0, Fx - X0, q)
        if check:
            with mp.workdps(45):
                again = quad_sum(line, F0, s.mu, FN - F0, Fx - X0, q)
                assert abs(again - mean) < mpf(10)**-22 * max(F0, FN)**q * s.mu
        new = moved(line, F0, s.mu, FN - F0, Fx - X0) if FN > 0 else []
        u0 = self.line[0][1] if self.line else ZERO
        k = [(b * eta, s.depth(F)) for b, F in corners(new)]
        self.line = [(z, sum((b * max(y - z, ZERO) for b, y in k), ZERO)) for z in [ZERO] + [y for _, y in k]]
        if FN == 0:
            self.line = []
        self.dz = s.depth(FN) if FN > 0 else ZERO
        u1 = self.line[0][1] if self.line else ZERO
        # int F_x d(u0) = [F_x u0] - dF_x int u0 dt, u0 = eta sum beta_j y(F_j)
        work = Fx * u1 - X0 * u0 - (Fx - X0) * eta * mean * s.Kf**-q
        self.dx += u1 - u0
        self.W += work - (self.U() - before)
        assert abs(self.Fx() - Fx) < mpf(10)**(40 - mp.dps) * s.mu * max(FN, F0)
