# SPDX-License-Identifier: GPL-3.0-or-later
"""Rules of the source tree: includes and calls between rooms run one way and in no circle; the library exports exactly what its
headers declare; each public header compiles alone in C and C++; each source file begins with what it is."""
import glob
import os
import re
import shutil
import subprocess
import tempfile

import harness

# The rooms (or files) that the files of a room may include, besides their own room.
BELOW = {
    "fret": set(),
    "number": {"fret/base.h"},
    "law": {"number", "fret"},
    "history": {"law", "number", "fret"},
    "field": {"history", "law", "number", "fret"},
    "wear": {"field", "history", "law", "number", "fret"},
    "arrays": {"number", "fret"},
    "text": {"number", "fret"},
    "measured": {"text", "number", "fret"},
    "scene": {"text", "number", "fret"},
    "language": {"scene", "text", "number", "fret"},
    "study": {"measured", "language", "scene", "text", "number", "fret"},
    "plot": {"text", "number", "fret"},
    "statement": {"language", "scene", "text", "number", "fret"},
    "commands": {"statement", "study", "measured", "plot", "language", "scene", "text", "number", "fret"},
    "help": {"commands", "statement", "study", "language", "scene", "text", "number", "fret"},
    "live": {"plot", "language", "scene", "text", "number", "fret"},
    "prompt": {"live/live.h", "help", "commands", "statement", "study", "plot", "language", "scene", "text", "number", "fret"},
}
INTRODUCED = tuple(sorted(set(BELOW) - {"fret"}))
LIBRARY = ("number", "law", "history", "field", "wear", "arrays", "fret")

INCLUDE = re.compile(r'^\s*#\s*include\s+(?:"([^"]+)"|<(fret/[^>]+)>)', re.M)
SHAPE = re.compile(r"\bFRET_GAP_(?!TERMS\b)[A-Z_]+\b")


def read(path):
    with open(path, encoding="utf-8") as f:
        return f.read()


def sources():
    """{name as in #include: text} of all sources and headers."""
    found = {}
    for top in ("src", "include"):
        for path in glob.glob(os.path.join(harness.ROOT, top, "**", "*.[ch]"), recursive=True):
            found[os.path.relpath(path, os.path.join(harness.ROOT, top))] = read(path)
    return found


def room(name):
    return name.partition("/")[0]


def includes(text):
    return [a or b for a, b in INCLUDE.findall(text)]


def wrong_arrows(files):
    for name, text in sorted(files.items()):
        if room(name) not in BELOW:
            yield "%s: no rule for the room %s" % (name, room(name))
            continue
        allowed = BELOW[room(name)]
        for other in includes(text):
            if other not in files:
                yield '%s includes "%s", which is no file of include/ or src/' % (name, other)
            elif room(other) != room(name) and room(other) not in allowed and other not in allowed:
                yield "%s includes %s" % (name, other)


def circles(files):
    """Circles of includes between modules; a module is a header and its source."""
    graph = {}
    for name, text in files.items():
        module = os.path.splitext(name)[0]
        graph.setdefault(module, set()).update(os.path.splitext(other)[0] for other in includes(text))
    return around(graph)


def calls(build, files):
    """{object: objects whose functions or data it uses} of all rooms, by nm."""
    defined, wanted = {}, {}
    for path in sorted(glob.glob(os.path.join(build, "src", "*", "*.o"))):
        name = os.path.relpath(path, os.path.join(build, "src"))
        if os.path.splitext(name)[0] + ".c" not in files:  # an old object whose source has been removed
            continue
        for line in subprocess.run(["nm", path], capture_output=True, text=True, check=True).stdout.splitlines():
            kind, symbol = line.split()[-2:]
            if kind == "U":
                wanted.setdefault(name, set()).add(symbol)
            elif kind in "BDRT":
                defined[symbol] = name
    return {name: {defined[s] for s in symbols if s in defined} for name, symbols in wanted.items()}


def around(graph):
    found, done = [], set()

    def visit(module, path):
        if module in path:
            found.append(" -> ".join(path[path.index(module):] + [module]))
        elif module not in done:
            for other in sorted(graph.get(module, set()) - {module}):
                visit(other, path + [module])
            done.add(module)
    for module in sorted(graph):
        visit(module, [])
    return found


def unsaid(files):
    """Files without the licence line, or without a comment below it that says what they are."""
    for name, text in sorted(files.items()):
        lines = text.splitlines() + ["", ""]
        if lines[0] != "/* SPDX-License-Identifier: GPL-3.0-or-later */":
            yield name + ": the first line is not the licence"
        elif room(name) != "fret" and not lines[1].startswith("/* "):
            yield name + ": no comment says what the file is"


def told_apart(files):
    for name, text in sorted(files.items()):
        if room(name) in LIBRARY and name not in ("law/gap.c", "fret/gap.h", "fret/fret.h"):
            for shape in SHAPE.findall(text):
                yield "%s: %s" % (name, shape)


SCREEN = 45  # lines


def unintroduced(files):
    """Rooms without a README.md of at most SCREEN lines that names all their .c files."""
    for name in sorted({room(f) for f in files} & set(INTRODUCED)):
        path = os.path.join(harness.ROOT, "src", name, "README.md")
        text = read(path) if os.path.exists(path) else ""
        if not text or text.count("\n") > SCREEN:
            yield "src/%s/README.md: %d lines" % (name, text.count("\n"))
        for stem in sorted({os.path.splitext(f.partition("/")[2])[0] for f in files if room(f) == name and f.endswith(".c")}):
            if not re.search(r"\b%s\b" % stem, text):
                yield "src/%s/README.md does not name %s" % (name, stem)


def unreasoned(files):
    """Comments `unreached` without a reason of at least three words."""
    for name, text in sorted(files.items()):
        for n, line in enumerate(text.splitlines(), 1):
            if "unreached" in line and not re.search(r"/\* unreached: \S+ \S+ \S.* \*/$", line):
                yield "%s:%d: %s" % (name, n, line.strip())


def declared(files):
    """{header: functions that it declares}"""
    found = {}
    for name, text in files.items():
        if room(name) == "fret":
            bare = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
            found[name] = re.findall(r"^[^#\n]*?\b(fret_\w+)\(", bare, re.M)
    return found


def uncalled(names, rows):
    """Functions that have no row in the fuzz target of the library, or two, and rows of functions that do not exist."""
    called = re.findall(r"^ *ROW\((\w+)\)", rows, re.M)
    for name in sorted(names ^ set(called)):
        yield name
    for name in sorted(set(called)):
        if called.count(name) > 1:
            yield name + " twice"


def exported(path):
    dynamic = ["-D"] if path.endswith(".so") else []
    done = subprocess.run(["nm", "-g", "--defined-only", *dynamic, path], capture_output=True, text=True, cwd=harness.ROOT)
    return {line.split()[2] for line in done.stdout.splitlines() if len(line.split()) == 3}


def library(tests, names):
    for path in (tests.build + "/libfret.a", tests.build + "/libfret.so"):
        shown = exported(path)
        tests.check(path + " exports functions", len(shown) > 50, str(sorted(shown)))
        for name in sorted(shown - names):
            tests.check("%s exports %s, which no public header declares" % (path, name), False)
        for name in sorted(names - shown):
            tests.check("%s lacks %s, which a public header declares" % (path, name), False)
    done = subprocess.run(["readelf", "-d", tests.build + "/libfret.so"], capture_output=True, text=True, cwd=harness.ROOT)
    tests.check("libfret.so has a soname", "[libfret.so.1]" in done.stdout, done.stdout)


def compilers():
    c = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
    cpp = shutil.which("g++") or shutil.which("clang++") or shutil.which("c++")
    return c, cpp


def compile_text(compiler, text, suffix, *args):
    """Compiles a file with this text."""
    with tempfile.TemporaryDirectory() as where:
        path = os.path.join(where, "one" + suffix)
        with open(path, "w", encoding="ascii") as f:
            f.write(text)
        command = [compiler, "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-I" + os.path.join(harness.ROOT, "include"),
                   path, *args, "-o", os.path.join(where, "out")]
        return subprocess.run(command, capture_output=True, text=True, cwd=harness.ROOT)


def headers(tests, by_header):
    """Compiles each header alone, and links every function that it declares, from C and from C++."""
    c, cpp = compilers()
    languages = [(c, ".c", "-std=c11")]
    if cpp:
        languages.append((cpp, ".cpp", "-std=c++11"))
    else:
        print("house: headers are not tried from C++, there is no compiler for it")
    jobs = []

    def one(name, names, compiler, suffix, standard, library_path):
        calls = "".join("    count += (void (*)(void))%s != 0;\n" % f for f in names)
        text = '#include "%s"\nint main(void) {\n    int count = 0;\n%s    return count == %d ? 0 : 1;\n}\n' % (
            name, calls, len(names))
        # addresses of functions are compared on purpose
        done = compile_text(compiler, text, suffix, standard, "-Wno-address", "-Wno-cast-function-type", library_path, "-lm")
        tests.check("%s as %s with %s" % (name, suffix[1:], os.path.basename(library_path)), done.returncode == 0,
                    done.stderr)
    for name, names in sorted(by_header.items()):
        for compiler, suffix, standard in languages:
            for path in ("libfret.a", "libfret.so"):
                jobs.append(lambda a=(name, names, compiler, suffix, standard, tests.build + "/" + path): one(*a))
    tests.each(jobs)


def selftest(tests):
    """Tests the rules on files that break them."""
    line = "/* SPDX-License-Identifier: GPL-3.0-or-later */\n"
    bad = {"law/a.h": '#include "law/b.h"\n', "law/b.c": line + "int x;\n", "fret/base.h": line,
           "law/b.h": line + '/* b */\n#include "field/c.h"\n', "field/c.h": line + '/* c */\n#include "law/a.h"\n',
           "number/d.c": line + "/* d */\n#include <fret/e.h>\n", "fret/e.h": line, "attic/f.c": line,
           "number/g.c": line + '/* g */\n#include "fret/base.h"\n#include "h.h"\nint y = FRET_GAP_POWER;\n'}
    arrows = list(wrong_arrows(bad))
    tests.check("wrong arrows are seen", len(arrows) == 4, str(arrows))
    tests.check("circles are seen", len(circles(bad)) == 1, str(circles(bad)))
    tests.check("circles of calls are seen", around({"a": {"b"}, "b": {"c", "b"}, "c": {"a"}, "d": {"a"}}) == ["a -> b -> c -> a"])
    tests.check("missing comments are seen", len(list(unsaid(bad))) == 3, str(list(unsaid(bad))))
    marks = {"number/i.c": "x(); /* unreached */\ny(); /* unreached: who knows */\nz(); /* unreached: no double is that small */\n"}
    tests.check("marks without a reason are seen", len(list(unreasoned(marks))) == 2, str(list(unreasoned(marks))))
    tests.check("functions without a row are seen", list(uncalled({"f", "g", "h"}, "    ROW(g),\n    ROW(h),\n    ROW(h),\n    ROW(i),\n")) ==
                ["f", "i", "h twice"])
    tests.check("shapes are seen", list(told_apart(bad)) == ["number/g.c: FRET_GAP_POWER"])


def kept(tests):
    """The top level of the repository holds nothing that a session or a test left behind."""
    if not os.path.exists(os.path.join(harness.ROOT, ".git")) or not shutil.which("git"):
        return
    listed = subprocess.run(["git", "-c", "safe.directory=*", "ls-files"], cwd=harness.ROOT, capture_output=True, text=True).stdout.splitlines()
    top = {path.split("/")[0] for path in listed if not path.startswith(".")}
    tests.check("the top level", not listed or top == {"Makefile", "README.md", "LICENSE", "src", "include", "scripts", "tests"}, str(sorted(top)))


def run(tests):
    selftest(tests)
    kept(tests)
    files = sources()
    for what, rule in (("arrows run one way", wrong_arrows), ("no circle of includes", circles),
                       ("files say what they are", unsaid), ("gap.c alone tells shapes apart", told_apart),
                       ("rooms are introduced", unintroduced),
                       ("what no test reaches has a reason", unreasoned)):
        found = list(rule(files))
        tests.check(what, not found, "\n".join(found))
    graph = calls(tests.build, files)
    seen = {room(name) for name, used in graph.items() if used}
    tests.check("the objects of all rooms are read", len(graph) > 100 and seen == set(BELOW) - {"fret"}, str(graph))
    found = around(graph)
    tests.check("no circle of calls", not found, "\n".join(found))
    by_header = declared(files)
    names = {name for names in by_header.values() for name in names}
    library(tests, names)
    found = list(uncalled(names, read(os.path.join(harness.ROOT, "tests/fuzz/library.h"))))
    tests.check("each function of the library has a row in tests/fuzz/library.h", not found, "\n".join(found))
    headers(tests, by_header)
