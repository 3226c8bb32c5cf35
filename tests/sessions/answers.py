# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests the JSON output of every command: each line is one object, of the documented kind, and has all that the text output has."""
import json
import os

SCENE = "material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N; cycle FA=20 N"
ROWS = "F [N],loss [uJ]\n5,0.02\n10,0.19\n20,1.95\n30,9.1\n"
GAP = "r [mm],f [um]\n" + "".join("%g,%g\n" % (i / 10, 50.001 * (i / 10) ** 2) for i in range(20))
HISTORY = "FN [N],Fx [N]\n100,5\n100,10\n"
LOOP = "dx [um],Fx [N]\n2,30\n1,-30\n-2,-30\n-1,30\n2,30\n"
TRANSCRIPT = "fret> 1\n1 = 1\n"

# a command, a statement with it, and the kinds of its lines in order; *: one or more
STATEMENTS = (
    ("material", "material steel", ""), ("second", "second rigid; second same", "warning"), ("bulk", "bulk stress=50 MPa; bulk none", "warning"), ("wear", "wear alpha=1e4 um^3/J", ""), ("wear", "wear K=1e-4 H=2 GPa; wear cycles 10", "wear"), ("wear", "wear alpha=1e4 um^3/J; wear limit; wear none", "limit"), ("friction", "friction 0.4", ""), ("rig", "rig stiffness=80 N/um", ""),
    ("geometry", "geometry sphere R=10 mm", ""), ("geometry", "geometry file gap.csv smooth; geometry sphere R=10 mm", "smooth note"),
    ("press", "press FN=100 N", "press"), ("step", "step Fx=20 N", "step"), ("cycle", "cycle FA=20 N", "cycle"), ("follow", "follow h.csv", "follow"),
    ("undo", "undo", ""), ("reset", "x = 1; reset; press FN=100 N; cycle FA=20 N", "press cycle"), ("history", "history", "history row*"),
    ("table", "table a, dW(F) in nJ for F = 1 N .. 3 N steps 2", "table row*"), ("table", "table dW(F) for F = 39 N .. 41 N steps 2", "table row* note"),
    ("table", "table a for FN = 1 N .. 9 N steps 2 for mu = 0.3 .. 0.4 steps 1", "table row*"), ("table", "table a for FN = 1 N .. 9 N to t.json", "note"),
    ("plot", "plot loop", "text"), ("plot", "plot loop to p.gp", "note"), ("animate", "animate loop frames 2", "text"),
    ("solve", "solve mu for dW = 1.5 uJ from 0.31 to 1", "value solve"), ("maximize", "maximize x*(3-x) over x = 0 .. 2", "value value maximize"),
    ("minimize", "minimize x^2 over x = 1 .. 2", "value value minimize note"), ("fit", "fit mu for loss = dW(F) to rows.csv", "value fit"), ("loop", "loop loop.csv", "note measured loop"),
    ("uncertainty", "uncertainty dW(20 N) with mu +- 0.02, E0 +- 5 % samples 50", "value uncertainty"),
    ("export", "export jenkins 5 to m.json", "note value value export"), ("explain", "explain dW", "explain"), ("explain", "explain mu", "explain"),
    ("explain", "explain a/c conditioning", "explain*"),
    ("accuracy", "accuracy within 0.01", "accuracy row* accuracy"), ("show", "show", "text"), ("show", "show settings", "text"), ("set", "set", "text"),
    ("set", "set timing on; 1; set timing off", "value note note"), ("source", "source s.fret", "value"), ("save", "save o.fret", "note"),
    ("record", "record r.txt; record off", "note"), ("replay", "replay t.txt", "text"), ("live", "live", "error"), ("compare", "compare k = 0, 0.5; compare off", "note"), ("demo", "demo sticking", "text* any*"),
    ("ask", 'ask "a?" = a within 5 % hint "Hertz"', "value ask"), ("ask", 'ask "Where?" of "here", "there" = 2', "ask"),
    ("help", "help a", "text"), ("apropos", "apropos stick", "text"), ("cite", "cite", "text"),
    ("table", "table dW(F) at rows.csv", "table row* compare"), (None, "a in mm, c/a", "value value"), (None, "Mu = 3", "note"), (None, "foo", "error"),
    (None, "press FN=1 MN; press FN=100 N", "press warning press"), ("quit", "quit", ""), ("exit", "exit", ""))
MESSAGES = ("note", "warning", "error")
FIELDS = {"explain": {"name", "title", "formula", "model", "numbers", "value", "error"}, "solve": {"method", "evaluations", "bracket"},
          "fit": {"rows", "rms", "deviation", "correlation"}, "uncertainty": {"of", "deviation", "shares", "Monte Carlo"},
          "ask": {"question"}, "press": {"FN", "a", "dz"}, "measured": {"cycle", "line", "dW", "dxA", "FA", "secant", "unloading", "flank", "energy_ratio", "flanks"}, "step": {"Fx", "dx", "c"}, "cycle": {"dW", "Fx", "dx", "c"}}


def one_name_each(pairs):
    names = [name for name, _ in pairs]
    if len(set(names)) != len(names):
        raise ValueError("a name stands twice: %s" % names)
    return dict(pairs)


def kind(row):
    first = next(iter(row))
    if first in MESSAGES or first == "text":
        assert isinstance(row[first], str) and row[first].strip()
        return first
    if first == "event":
        return row["event"]
    if first == "name" and set(row) == {"name", "value", "unit"}:
        assert isinstance(row["value"], (int, float)) and isinstance(row["unit"], str)
        return "value"
    return "row"


def matches(kinds, pattern):
    left = list(kinds)
    for want in pattern.split():
        many, want = want.endswith("*"), want.rstrip("*")
        taken = 0
        while left and (left[0] == want or want == "any") and (many or not taken):
            left.pop(0)
            taken += 1
        if not taken:
            return False
    return not left


def rows_fit_columns(rows):
    """Do the rows have the columns that the event before them names?"""
    columns = None
    for row in rows:
        columns = row.get("columns", columns)
        if kind(row) == "row" and (columns is None or list(row) != list(columns)):
            return False
    return True


def run(tests):
    for name, text in (("rows.csv", ROWS), ("gap.csv", GAP), ("h.csv", HISTORY), ("loop.csv", LOOP), ("t.txt", TRANSCRIPT), ("s.fret", "a\n")):
        with open(os.path.join(tests.dir, name), "w", encoding="ascii") as f:
            f.write(text)
    listed = json.loads(tests.run("--format=json", "-c", "show commands").stdout)["text"]
    missed = {line.split()[0] for line in listed.splitlines()} - {command for command, _, _ in STATEMENTS}
    tests.check("every command is told of in JSON", not missed, str(missed))

    def one(command, statement, pattern):
        done = tests.run("--format=csv", "-c", SCENE, "-c", "set format json\n" + statement)
        name = "JSON: " + statement
        try:
            rows = [json.loads(line, object_pairs_hook=one_name_each) for line in done.stdout.splitlines()]
            kinds = [kind(row) for row in rows]
        except (ValueError, AssertionError, AttributeError, StopIteration) as error:
            tests.check(name, False, "%s\n%s" % (error, tests.report(done)))
            return
        tests.check(name, matches(kinds, pattern) and rows_fit_columns(rows), "%s\n%s" % (kinds, tests.report(done)))
        for row in rows:
            wanted = FIELDS.get(row.get("event"), set()) if command == row.get("event") else set()
            if command == "explain" and statement != "explain dW":
                wanted = set()  # an input has no model, an expression no formula
            tests.check(name + ": fields", wanted <= set(row), str(row))
        # messages beside the answers are among the objects, word for word
        said = [row[key] for row in rows for key in MESSAGES if next(iter(row)) == key]
        tests.check(name + ": on standard error too", all(text in done.stderr for text in said) and
                    bool(said) == bool(done.stderr), tests.report(done))
    tests.each([lambda s=s: one(*s) for s in STATEMENTS])
