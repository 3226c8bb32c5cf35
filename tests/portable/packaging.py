# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests make install and uninstall, the manual, bash completion, the Debian packages, and scripts/install-deps."""
import os
import re
import shutil
import subprocess

import harness
import transcripts


def make(tests, target, root):
    return subprocess.run(["make", "--no-print-directory", "-s", "B=" + tests.build, "DESTDIR=" + root, "PREFIX=/usr",
                           target], cwd=harness.ROOT, capture_output=True, text=True)


def files(root):
    return sorted(os.path.relpath(os.path.join(at, name), root) for at, _, names in os.walk(root) for name in names)


def installed(tests):
    root = os.path.join(tests.dir, "root")
    done = make(tests, "install", root)
    there = files(root)
    tests.check("make install", done.returncode == 0 and {"usr/bin/fret", "usr/lib/libfret.so.1", "usr/include/fret/fret.h",
                                                          "usr/share/man/man1/fret.1", "usr/share/doc/fret/NEWS"} <= set(there),
                done.stdout + done.stderr + "\n".join(there))
    for page in ("man1/fret.1", "man5/fret.5", "man3/libfret.3"):
        path = os.path.join(root, "usr/share/man", page)
        with open(path, encoding="utf-8") as f:
            text = f.read()
        tests.check(page + " has a name and a description", ".SH NAME\n" in text and ".SH DESCRIPTION\n" in text, text[:500])
        if shutil.which("man"):
            shown = subprocess.run(["man", "--warnings", "-l", path], capture_output=True, text=True,
                                   env={**tests.env, "MANPAGER": "cat", "MANWIDTH": "80", "LC_ALL": "C.UTF-8"})
            tests.check("man reads " + page, shown.returncode == 0 and not shown.stderr and len(shown.stdout) > 1000,
                        shown.stderr[:1000])
    for command in ("material", "record", "quit"):
        with open(os.path.join(root, "usr/share/man/man1/fret.1"), encoding="utf-8") as f:
            tests.check("fret(1) names " + command, re.search(r"^\.B %s\b" % command, f.read(), re.M))
    completes(tests, os.path.join(root, "usr/share/bash-completion/completions/fret"))
    if shutil.which("pkg-config"):
        told = {**os.environ, "PKG_CONFIG_SYSROOT_DIR": root, "PKG_CONFIG_PATH": os.path.join(root, "usr/lib/pkgconfig")}
        flags = subprocess.run(["pkg-config", "--cflags", "--libs", "fret"], capture_output=True, text=True, env=told).stdout.split()
        example(tests, "as it is installed", flags, {"LD_LIBRARY_PATH": os.path.join(root, "usr/lib")})
        with open(os.path.join(harness.ROOT, "tests/sessions/first_embedder.txt"), encoding="utf-8") as f:
            kept, tests.env = tests.env, {**tests.env, **told, "LC_ALL": "C", "LD_LIBRARY_PATH": os.path.join(root, "usr/lib")}
            transcripts.examples(tests, "first_embedder.txt", f.read().splitlines()[1:])
            tests.env = kept
    done = make(tests, "uninstall", root)
    tests.check("make uninstall leaves nothing", done.returncode == 0 and not files(root) and
                not any(os.path.exists(os.path.join(root, "usr", d)) for d in ("include/fret", "share/doc/fret")), done.stderr + "\n".join(files(root)))


def completes(tests, path):
    """What bash completion offers; bash splits words at `=`."""
    if not shutil.which("bash"):
        return
    for words, line, want in (("fret --form", "fret --form", "--format=text --format=csv --format=json"),
                              ("fret --format = j", "fret --format=j", "json"),
                              ("fret --format =", "fret --format=", "text csv json"),
                              ("fret --re", "fret --re", "--replay"), ("fret Mak", "fret Mak", "Makefile")):
        script = "source %s; COMP_WORDS=(%s); COMP_CWORD=%d; COMP_LINE='%s'; COMP_POINT=%d; _fret; echo \"${COMPREPLY[*]}\"" % (
            path, words, len(words.split()) - 1, line, len(line))
        done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, cwd=harness.ROOT)
        tests.check("bash completes `%s`" % line, done.stdout.split() == want.split(), done.stdout + done.stderr)


def example(tests, where, flags, env=None):
    """Builds the example of fret.h with the installed library; it must print the program's values."""
    with open(os.path.join(harness.ROOT, "include/fret/fret.h"), encoding="utf-8") as f:
        lines = f.read().splitlines()
    first = next(i for i, line in enumerate(lines) if "#include <fret/fret.h>" in line)
    last = next(i for i in range(first, len(lines)) if lines[i] == " *   }")
    path, program = os.path.join(tests.dir, "example.c"), os.path.join(tests.dir, "example")
    with open(path, "w", encoding="utf-8") as f:
        f.write("".join(line[5:] + "\n" for line in lines[first:last + 1]))
    done = subprocess.run([os.environ.get("CC", "cc"), "-std=c11", "-Wall", "-Wextra", "-Wpedantic", path, *flags, "-o", program],
                          capture_output=True, text=True)
    tests.check("the example of fret.h is C without warnings, " + where, done.returncode == 0 and not done.stderr, done.stderr)
    shown = subprocess.run([program], capture_output=True, text=True, env={**os.environ, **(env or {})}).stdout if not done.returncode else ""
    want = tests.run("-c", "material steel E0=210 GPa nu=0.3; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"
                     "step Fx=20 N; step Fx=-20 N; step Fx=20 N; dx in m; c in m; W in J").stdout
    tests.check("and tells what the program tells, " + where, shown == want and want.count("\n") == 3, shown + want)


def embedded(tests):
    example(tests, "in the sources", ["-I" + os.path.join(harness.ROOT, "include"),
                                      os.path.join(harness.ROOT, tests.build, "libfret.a"), "-lm"])


def elsewhere(tests):
    for manager, words in (("dnf", "dnf install .*readline-devel"), ("pacman", "pacman -S .*readline"),
                           ("zypper", "zypper install .*readline-devel"), ("apk", "apk add .*readline-dev"),
                           ("brew", "brew install .*readline"), (None, "this system's package manager")):
        where = os.path.join(tests.dir, "bin-%s" % manager)
        os.mkdir(where)
        for tool in ("sh", "awk", "sort", "tr", "cat", "id"):
            os.symlink(shutil.which(tool), os.path.join(where, tool))
        if manager:
            os.symlink(shutil.which("true"), os.path.join(where, manager))
        done = subprocess.run([shutil.which("sh"), os.path.join(harness.ROOT, "scripts/install-deps"), "run"],
                              capture_output=True, text=True, env={"PATH": where})
        tests.check("package names for %s" % manager, done.returncode == 1 and re.search(words, done.stderr), done.stderr)


def numbered(tests):
    """The Python module has the library's version, and loads the library of that version."""
    version = tests.run("--version").stdout.split()[1]
    for path, words in (("pyproject.toml", 'version = "%s"' % version), ("fret/_library.py", '"libfret.so.%s"' % version.split(".")[0])):
        with open(os.path.join(harness.ROOT, "scripts/python", path), encoding="utf-8") as f:
            tests.check("the version in " + path, words in f.read(), words)


def debian(tests):
    """The Debian package build-depends on every library that the program links; its maintainer is taken from the environment."""
    with open(os.path.join(harness.ROOT, "scripts/debian/control.in"), encoding="utf-8") as f:
        control = f.read()
    tests.check("what the Debian package is built with", all(name in control for name in (
        "libreadline-dev", "libgsl-dev", "libncurses-dev")), control)
    tests.check("who maintains it", "Maintainer: @MAINTAINER@\n" in control and control.count("@") == 2, control)


def begins(tests):
    """`make run` ends by saying what to type next."""
    done = subprocess.run(["make", "--no-print-directory", "-n", "B=" + tests.build, "run"], cwd=harness.ROOT,
                          capture_output=True, text=True)
    tests.check("the last words of make run", re.search(r"Now type +%s/fret .*help +there; Ctrl-D leaves" % tests.build,
                                                        done.stdout.strip().splitlines()[-1]), done.stdout + done.stderr)


def run(tests):
    """Installs the normal build."""
    for room in (installed, embedded, elsewhere, numbered, debian, begins):
        room(tests)
