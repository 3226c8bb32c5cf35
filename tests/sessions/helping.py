# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests `help` and `apropos`: the example in each help text must give the output that is printed there."""
import re

import harness
import transcripts

# words, and names that apropos must find by them
APROPOS = {"loop": "cycle, plot, dW", "hysteresis": "cycle, dW", "dissipation": "dW, W", "csv": "history, table, follow",
           "export": "history, table, plot", "stress": "p(r), qx(r)", "steel": "material, material steel",
           "Hertz": "press, geometry sphere, a", "unit": "help units, Pa", "Mindlin": "explain, dW",
           "undo": "undo", "Monte": "uncertainty", "transcript": "record, replay", "start-up": "help scripts",
           "animation": "animate", "delete": "reset", "lifetime": "wear, help cracking", "plasticity": "yield", "Matlab": "help programs"}
HELPED = ("sphere", "springs", "flat-rounded", "format", "pager", "GPa", "cm", "%", "steel", "Ti-6Al-4V", "sin", "memory",
          "expressions", "scripts", "files", "theory", "paper", "limits", "prompt", "set model", "geometry cone",
          "material steel", "p(r)", "dW(20 N)", "FN=100 N", "set format")


ERRS = ("reset",)  # commands whose example is about an error


def is_at_work(lines):
    """Does an example print anything but errors, if it prints anything?"""
    begin = next((i for i, line in enumerate(lines) if line.startswith((harness.PROMPT, "$ fret "))), len(lines))
    said = [line for line in lines[begin:] if line.strip() and not line.startswith((harness.PROMPT, "$ ", "  "))]
    return not said or not all("error:" in line for line in said)


def pictures(tests):
    """Drawings and times, which a replay does not compare: they are as printed but for the characters and the times."""
    scene = "material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\nset digits 5; set plot 50x12\n"
    plot, accuracy = (tests.run("-c", "help " + topic).stdout for topic in ("plot", "accuracy"))
    statement, *shown = plot.partition("set plot 50x12\n")[2].partition("\n\n")[0].splitlines()
    drawn = tests.run("-c", scene + statement.strip()[len(harness.PROMPT):]).stdout.splitlines()
    tests.check("help plot shows a plot", len(shown) == len(drawn) and [shown[i][4:] for i in (0, -2, -1)] == [drawn[i] for i in (0, -2, -1)],
                "\n".join(drawn))
    row = re.compile(r"^ *(\S.*?\S) +([\d.]+ +<?\d\S*e-\d+) +\S+ [a-z]+ +\S+$", re.M)
    told, came = (dict(row.findall(text)) for text in (accuracy, tests.run("-c", scene + "accuracy FA=20 N within 0.3").stdout))
    tests.check("help accuracy shows its table", len(told) > 6 and told.items() <= came.items(), "%s\n%s" % (told, came))


def run(tests):
    """Runs the example that ends each help text of a command, topic, setting, geometry or model."""
    def one(topic):
        done = tests.run("-c", "help " + topic)
        tests.check("help " + topic, done.returncode == 0 and done.stdout and not done.stderr, tests.report(done))
        wide = [line for line in done.stdout.splitlines()[1:] if len(line) > 80 and not line.startswith("    ")]
        tests.check("help %s fits a terminal" % topic, not wide, "\n".join(wide))
        tests.check("help %s has its tables" % topic, not re.search(r"^\[\w+\]$", done.stdout, re.M), done.stdout)
        lines = [line[4:] for line in done.stdout.splitlines() if line.startswith("    ")]
        count = transcripts.examples(tests, "help " + topic, lines)
        tests.check("help %s has an example" % topic, count > 0 or topic not in shown, done.stdout)
        tests.check("the example of %s is at work" % topic, is_at_work(lines) or topic in ERRS, done.stdout)

    def words(statement, pattern):
        return re.findall(pattern, tests.run("-c", statement).stdout, re.M)
    topics = words("help", r"^Topics: (.*(?:\n +.*)*)$")[0].replace(",", "").split()
    settings, geometries = words("show settings", r"^set (\w+)"), words("help geometry", r"^    geometry ([\w-]+)")
    tests.check("what has an example", len(topics) >= 9 and len(settings) >= 8 and len(geometries) >= 10,
                "%s\n%s\n%s" % (topics, settings, geometries))
    shown = {*transcripts.command_names(tests), *topics, *settings, *geometries, "closed", "memory", "springs", "quadrature", "blocks",
             "polynomials"}
    text = tests.run("-c", "help quantities").stdout
    quantities = re.findall(r"^    (\w+)(?:\(\w+\))?  ", text, re.M)
    tests.each([lambda t=t: one(t) for t in sorted(shown | set(quantities))])
    tests.check("help lists the quantities", len(quantities) > 30, text)
    inputs, _, rest = text.partition("Results:\n")
    results, _, functions = rest.partition("Functions of the scene:\n")
    tests.check("functions alone have an argument", "(null)" not in text and not re.findall(r"^    \w+\(", inputs + results, re.M) and
                not re.findall(r"^    \w+ ", functions.partition("\n\n")[0], re.M), text)
    presets = words("help material", r"^    (\S+) +E0=\S+ GPa nu=")
    tests.check("help material lists them", {"steel", "Ti-6Al-4V", "Inconel", "bronze", "tungsten-carbide", "silicon-nitride",
                                             "PTFE"} <= set(presets), str(presets))
    for name in presets:
        done = tests.run("-c", "help %s; second %s; material %s" % (name, name, name))
        tests.check("help %s names its source" % name, done.returncode == 0 and re.search(
            r"\n  (EN |Callister|makers|incompressible)", done.stdout), tests.report(done))
    for word, found in APROPOS.items():
        done = tests.run("-c", "apropos " + word)
        tests.check("apropos " + word, all(re.search("^%s( |$)" % re.escape(name), done.stdout, re.M)
                                           for name in found.split(", ")), tests.report(done))
    for word, told in (("deg", "deg: an angle; 1 deg = 0.01745329252 rad\n"), ("rad", "rad: an angle; 1 rad = 1 rad\n"),
                       ("N/mm", "no help on 'N/mm'; try: help\n"), ("%", "%: a number; 1 % = 0.01\n")):
        done = tests.run("-c", "help " + word)
        tests.check("help on " + word, done.stdout == told or told in done.stderr, tests.report(done))
    for name in HELPED:
        done = tests.run("-c", "help " + name)
        tests.check("help on " + name, len(done.stdout) > 10 and not done.stderr, tests.report(done))
    pictures(tests)
    done = tests.run("-c", "help")
    tests.check("help fits a screen", len(done.stdout.splitlines()) <= 24, done.stdout)
