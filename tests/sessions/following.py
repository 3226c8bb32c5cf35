# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests inputs bound to definitions: values are the same to the last digits whether what the input depends on is changed in a table,
by `at`, by `with`, or by a statement."""
import random
import re

import harness

GEOMETRIES = ("sphere R=10 mm", "cone slope=0.02", "exact-sphere R=10 mm", "flat-rounded b=0.02 mm R=10 mm", "power n=3 A=50 m^-2")
# A bound input, and the name it depends on with two values.
FOLLOWING = (("c0 := a0", "FN", ("40 N", "70 N")), ("k := 0.1 + FN/(1 kN)", "FN", ("40 N", "70 N")),
             ("E0 := 200 GPa*(1 + mu)", "mu", ("0.3", "0.7")), ("nu := mu/3", "mu", ("0.3", "0.7")),
             ("k := x/10", "x", ("1", "2")), ("mu := 0.3 + FN/(1 kN)", "FN", ("40 N", "70 N")),
             ("E0_2 := 2*E0", "E0", ("100 GPa", "300 GPa")), ("c0 := 1 mm*(1 + mu)", "mu", ("0.3", "0.7")))
ASKED = ("a", "dz", "kt", "kn", "dW(1 N)", "Fx(0.01 um)", "p(0.01 mm)", "uz(1 mm)", "c", "dx", "W")


def values(done):
    """The values reported, or else those of the rows."""
    lines = harness.told(done.stdout)
    told = [line["value"] for line in lines if "name" in line and "value" in line]
    return told or [[row[name] for name in ASKED] for row in lines if "event" not in row]


def shapes(tests):
    """A parameter that changes leaves nothing of the gap before, whatever the row of the geometry."""
    asked, changes = "a, dz, kn, p(a/2), uz(2*a)", 0
    for line in re.findall(r"^    geometry (.*)", tests.run("-c", "help geometry").stdout, re.M):
        shape = re.sub(r"\[[^]|]*\| ([^]]*)\]", r"\1", line).split(" | ")[0]  # with h and r0: A belongs to its n
        for name, number, unit in re.findall(r"(\w+)=([\d.e]+)((?: [^\s=]+(?= |$))?)", shape):
            more = "%s=%r%s" % (name, 1.25 * float(number), unit)
            scene = "material steel k=0.3 c0=1 mm; geometry %s; press FN=100 N; " + asked
            fresh = tests.run("--format=json", "-c", scene % shape.replace("%s=%s%s" % (name, number, unit), more))
            done = tests.run("--format=json", "-c", scene % shape + "; %s; %s" % (more, asked))
            changes += 1
            tests.check("%s of geometry %s" % (more, shape), len(values(fresh)) == 5 and values(done)[5:] == values(fresh) != values(done)[:5],
                        tests.report(fresh) + tests.report(done))
    tests.check("geometries have parameters", changes > 12, str(changes))


def run(tests):
    shapes(tests)
    rng = random.Random(7)

    def one(geometry, follows, name, to, grading):
        setup = "x = 3; material E0=210 GPa nu=0.3 k=%s c0=1 mm; geometry %s; friction 0.4; press FN=100 N; step Fx=2 N; %s" % (
            grading, geometry, follows)
        asked = ", ".join(ASKED)
        wanted = []
        for v in to:
            done = tests.run("--format=json", "-c", "%s; %s = %s; %s" % (setup, name, v, asked))
            wanted.append(values(done))
            tests.check("values of %s" % setup, len(wanted[-1]) == len(ASKED), tests.report(done))
        between = "%s .. %s steps 1" % to
        ways = {"over": "table %s for %s = %s" % (asked, name, between),
                "one after the other": "table %s for %s = %s; table %s for %s = %s" % (asked, name, "%s .. %s steps 7" % to, asked, name, between),
                "at": "; ".join(", ".join("(%s at %s=%s)" % (what, name, v) for what in ASKED) for v in to),
                "and back": "%s = %s; %s = %s; undo; undo; table %s for %s = %s" % (name, to[0], name, to[1], asked, name, between)}
        for cores in ("1", "2"):
            for way, statement in ways.items():
                done = tests.run("--format=json", "-c", "%s; set cores %s; %s" % (setup, cores, statement))
                got = values(done)[-2:] if way != "at" else None
                if way == "at":
                    told = values(done)
                    got = [told[:len(ASKED)], told[len(ASKED):]]
                near = len(got) == 2 and all(len(row) == len(want) and all(abs(x - y) <= 1e-14 * abs(y) for x, y in zip(row, want))
                                             for row, want in zip(got, wanted))
                tests.check("%s, %s cores: %s" % (way, cores, setup), near, "%s\n%s\n%s" % (wanted, got, tests.report(done)))
    tests.each([lambda f=f: one(rng.choice(GEOMETRIES), *f, rng.choice(("0", "0.3", "-0.4"))) for f in FOLLOWING * 2])
