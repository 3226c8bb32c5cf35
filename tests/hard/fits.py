# SPDX-License-Identifier: GPL-3.0-or-later
"""Are the standard errors of fit right? Fits loops with noise in both columns, computed by stepping springs one by one; the table
gives the deviations of the fitted values in standard errors, and how many are within one and two.
    python3 tests/hard/fits.py build/fret 200"""
import concurrent.futures
import json
import math
import os
import random
import subprocess
import sys
import tempfile

SPRINGS, ROWS, CYCLES = 1500, 200, 1.25
MU, E0, FN, R, NU, C0 = 0.62, 210e9, 100.0, 0.01, 0.3, 1e-3
FORCE_NOISE, K_RIG = 0.5, 80e6
REGIMES = (("partial slip", 0.4), ("near gross slip", 0.95), ("sliding", 2.0))


def scene(k, mu, E0):
    return "material E0=%g GPa nu=%g k=%g%s; geometry paraboloid R=10 mm; friction %g; press FN=%g N" % (
        E0 / 1e9, NU, k, " c0=1 mm" if k else "", mu, FN)


def springs_of(fret, k):
    """Bound and tangential stiffness of each spring, and the displacement of gross slip. Only dz and eta come from the program."""
    done = subprocess.run([fret, "--format=json", "-c", scene(k, MU, E0) + "; dz; eta"], capture_output=True, text=True, check=True)
    dz, eta = (json.loads(line)["value"] for line in done.stdout.splitlines() if "name" in line)
    a = math.sqrt(dz * R * (1 + k))  # g = x^2/(R(1+k))
    # F_N = 2 c_N0 c0^-k int_0^a x^k (a^2-x^2)/(R(1+k)) dx
    cN0 = FN * R * (1 + k) * (k + 1) * (k + 3) * C0 ** k / (4 * a ** (k + 3))
    rows, total = [], 0.0
    for i in range(SPRINGS):
        lo, hi = a * i / SPRINGS, a * (i + 1) / SPRINGS
        stiff = 2 * cN0 * (hi ** (k + 1) - lo ** (k + 1)) / (k + 1) / C0 ** k
        moment = 2 * cN0 * (hi ** (k + 3) - lo ** (k + 3)) / (k + 3) / C0 ** k
        normal = (a * a * stiff - moment) / (R * (1 + k))
        rows.append((MU * normal, stiff / eta))
        total += normal
    assert abs(total / FN - 1) < 1e-9
    return rows, MU * eta * dz


def forces(springs, path):
    force, last, out = [0.0] * len(springs), 0.0, []
    for dx in path:
        for i, (bound, stiff) in enumerate(springs):
            force[i] = max(-bound, min(bound, force[i] + stiff * (dx - last)))
        last = dx
        out.append(sum(force))
    return out


def loops():
    """(k, regime, noise, rig stiffness) of each loop; with a rig only the smaller noise."""
    return [(k, regime, noise, rig) for k in (0, 0.3) for regime, _ in REGIMES for noise, rig in ((10e-9, None), (50e-9, None), (10e-9, K_RIG))]


def campaign(fret, count, folder):
    """Fits, four at a time: [(lines of the table, how many errors are not right)] in order."""
    clean = {}
    for k in (0, 0.3):
        springs, most = springs_of(fret, k)
        for regime, part in REGIMES:
            path = [part * most * math.sin(2 * math.pi * i / ROWS) for i in range(int(ROWS * CYCLES) + 1)]
            clean[k, regime] = list(zip(path, forces(springs, path)))

    def one(of):
        own = tempfile.mkdtemp(dir=folder)
        return lines_of(fret, count, own, clean[of[0], of[1]], *of)

    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        yield from pool.map(one, loops())


def lines_of(fret, count, folder, clean, k, regime, noise, rig):
    draw = random.Random("%g %s %g%s" % (k, regime, noise, " rig" if rig else ""))
    script = [scene(k, 0.4, 150e9) + ("; rig stiffness=%g N/um" % (rig / 1e6) if rig else "")]
    for i in range(count):
        name = os.path.join(folder, "%d.csv" % i)
        with open(name, "w", encoding="ascii") as f:
            f.write("%s [um],Fx [N]\n" % ("drig" if rig else "dx"))
            f.writelines("%.8g,%.8g\n" % (1e6 * (dx + (Fx / rig if rig else 0) + draw.gauss(0, noise)), Fx + draw.gauss(0, FORCE_NOISE))
                         for dx, Fx in clean)
        script.append("fit mu, E0 along " + name)
    done = subprocess.run([fret, "--format=json", "--keep-going"], input="\n".join(script), capture_output=True, text=True)
    lines = [json.loads(line) for line in done.stdout.splitlines()]
    events = [line for line in lines if line.get("event") == "fit"]
    out, bad = [], 0
    for name, true in (("mu", MU), ("E0", E0)):
        values = [line["value"] for line in lines if line.get("name") == name]
        stated = [event["deviation"][name] for event in events]
        n = len(events)
        bias = sum((v - true) / s for v, s in zip(values, stated)) / n
        one, two = (sum(abs(v - true) <= m * s for v, s in zip(values, stated)) / n for m in (1, 2))
        # three standard deviations of this fraction in n draws, if the standard error is right
        wrong = (abs(bias) > 0.2 + 3 / math.sqrt(n) or abs(one - 0.683) > 3 * math.sqrt(0.683 * 0.317 / n)
                 or abs(two - 0.954) > 3 * math.sqrt(0.954 * 0.046 / n) or n < count)
        bad += wrong
        out.append("%-5g %-16s %-10g %-4s %-4s %8.3f%% %9.3f %6.3f %6.3f %7d%s" % (
            k, regime, noise * 1e9, "%g" % (rig / 1e6) if rig else "no", name, 100 * sum(stated) / n / true, bias, one, two, count - n, " *" * wrong))
    return out, bad


def main():
    fret, count = sys.argv[1], int(sys.argv[2])
    print("# make fits FITS=%d; error: stated, of the value; bias: mean error in stated errors; rig: its stiffness [N/um]; * beyond what %d draws allow" % (count, count))
    print("%-5s %-16s %-10s %-4s %-4s %9s %9s %6s %6s %7s" % ("k", "regime", "noise [nm]", "rig", "of", "error", "bias", "1 s", "2 s", "failed"))
    bad = 0
    with tempfile.TemporaryDirectory() as folder:
        for lines, wrong in campaign(os.path.abspath(fret), count, folder):
            print("\n".join(lines), flush=True)
            bad += wrong
    print("%d rows do not hold" % bad)
    return bad > 0


if __name__ == "__main__":
    sys.exit(main())
