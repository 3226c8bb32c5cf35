# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes whose last digits are hard to get: every gap, gradings up to the ends of the range, loads close to gross slip,
thin slices, fields close to the edge. A scene that is not allowed is an error, and the script goes on."""
import math
import random

GRADINGS = (0.3, -0.9, 0, 0.97, -0.4, 0.75, 1e-9, -0.999)
# statement, range of its number, number of gradings (few where quadratures are slow)
GAPS = (("sphere R=%r mm", 0.3, 50, 8), ("cone slope=%r", 0.001, 0.2, 8), ("power n=%r A=30 m^-1.5", 2.5, 2.5, 8),
        ("power n=%r h=1 um r0=1 mm", 0.3, 12, 8), ("sum 2:%r m^-1, 4:2e6 m^-3, 1.5:3 m^-0.5", 1, 100, 4),
        ("flat-cone b=%r mm slope=0.05", 0.01, 2, 2), ("flat-paraboloid b=%r mm R=10 mm", 0.01, 2, 2),
        ("flat-rounded b=%r mm R=10 mm", 0.01, 2, 3), ("exact-sphere R=%r mm", 5, 50, 3),
        ("file gap.csv # %r", 1, 1, 2))
SECONDS = ("same", "rigid", "E0=70 GPa nu=0.33", "E0=3 GPa nu=0.49")
STATE = "FN, dz, a; Fx, dx, c; W, U; kn"
COEFFICIENTS = "eta; hN, hT; beta_k; cN, cT; kappa; n, A; a0; dz0; dx0max; dxmax"
FIELDS = ("p(%s)", "qx(%s)", "uz(%s)", "ux(%s)")


def gap_table():
    """A table of a gap between that of a sphere and that of a cone."""
    rows = ["%r,%r" % (i / 10, 0.05 * (i / 10) ** 2 * 1e3 / (1 + i / 40)) for i in range(31)]
    return "r [mm],f [um]\n" + "\n".join(rows) + "\n"


def history_table():
    rows = ["%r,%r" % (100 + 30 * math.floor(10 * math.sin(i)) / 10, 2 * math.floor(10 * math.sin(2.7 * i)) / 10)
            for i in range(1, 40)]
    return "FN [N],Fx [N]\n100,0\n" + "\n".join(rows) + "\n"


def digits(rng, lo, hi):
    """A random number, uniform in its logarithm, with few digits, so that the script is easy to read."""
    return float("%.4g" % (lo * (hi / lo) ** rng.random()))


def scene(rng, gap, k, quick):
    """The statements of one scene: a load program with questions between its steps."""
    lines = ["reset all", "material E0=%r GPa nu=%r k=%r c0=%r mm" %
             (digits(rng, 1, 400), digits(rng, 0.05, 0.45), k, digits(rng, 0.05, 20)),
             "second " + rng.choice(SECONDS), "geometry " + gap, "friction %r" % digits(rng, 0.05, 1),
             "press FN=%r N" % digits(rng, 1, 300), STATE, COEFFICIENTS,
             "x = %r" % digits(rng, 1e-3, 0.999),
             "a(x*FN), dz(x*FN), c(x*mu*FN), dx(x*mu*FN), Fx(x*dxmax), dW(x*mu*FN)",
             "step Fx=x*mu*FN", STATE, "step Fx=(1 - 1e-9)*mu*FN", STATE, "step Fx=-0.3*x*mu*FN", STATE, "kt"]
    for place in ("0 m", "x*a", "(1 - 1e-6)*a", "(1 + 1e-4)*a", "2.5*a"):
        lines.append("; ".join(field % place for field in FIELDS))
    lines += ["E(x*a), f(x*a), g(x*a)", "step FN=1.3*FN; " + STATE]
    if quick:
        lines += ["step FN=0.8*FN Fx=0.1*mu*FN; " + STATE, "step dz=1.01*dz dx=1.02*dx; " + STATE, "history"]
    ways = (("FN=50 N", "FA=x*mu*FN times 3"), ("dz=1.1 um", "dxA=x*dxmax times 2 steps 7"),
            ("a=0.33 mm", "dxA=1.7*dxmax"), ("FN=120 N", "FA=0.3*mu*FN FNA=0.4*FN phase=70 deg times 2 steps 40"))
    press, cycle = rng.choice(ways if quick else ways[:2])
    lines += ["reset; press " + press, "cycle " + cycle, "dW; " + STATE, "history", "qx(0.5*a), ux(0.9*a)",
              "nu = 0.21; " + STATE, "k = k/2; dW; " + STATE]
    return lines + (["kt"] if quick else [])


def script():
    rng = random.Random(20)
    lines = []
    for form, lo, hi, count in GAPS:
        for k in GRADINGS[:count]:
            lines += scene(rng, form % digits(rng, lo, hi), k, count == len(GRADINGS))
    lines += ["reset all", "material E0=210 GPa nu=0.3 k=0.37 c0=1 mm; geometry sphere R=10 mm; friction 0.3",
              "press FN=100 N; follow history.csv; " + STATE, "history",
              "set model springs 500; " + STATE, "set model auto",
              "reset; press FN=100 N; cycle FA=12 N", "set format csv",
              "table a, dz, c(0.4*mu*FN), dW(0.7*mu*FN), kn, eta for FN = 0.01 N .. 1e4 N steps 200 log",
              "table a, dz, dx(5 N), dW(3 N), cN, hT, beta_k for k = -0.99 .. 0.99 steps 200",
              "table dW(t*mu*FN), c(t*mu*FN), dx(t*mu*FN), Fx(t*dxmax) for t = 1e-9 .. 1 steps 120 log "
              "with k = -0.5, 0, 0.6",
              "table p(t*a), qx(t*a), uz(t*a), ux(t*a) for t = 0.01 .. 3 steps 60",
              "table f(t), g(t), E(t) for t = 1 um .. 2 mm steps 100 log with n = 1, 2, 3.3",
              "table exp(t), log(t), log10(t), sqrt(t), t^0.37, t^7, t^-1.5, 2^-t for t = 1e-5 .. 30 steps 400 log",
              "table sin(t), cos(t), tan(t), atan(t), asin(t/40), acos(t/40), gamma(t), beta(t, 1/t) "
              "for t = 0.01 .. 40 steps 400"]
    return "\n".join(lines) + "\n"
