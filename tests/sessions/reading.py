# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests reading tables in the variants that spreadsheets and instruments write."""

SCENE = "material steel; friction 0.4; "
PLAIN = b"r [mm],f [um]\n0,0\n0.5,12.5\n1,50\n"
# other texts of the gap of PLAIN
SAME = {
    "a byte-order mark, semicolons, decimal commas, CR LF": b"\xef\xbb\xbfr [mm];f [um]\r\n0;0\r\n0,5;12,5\r\n1;50\r\n",
    "quoted fields, the micro sign of Latin-1": b'"r [mm]","f [\xb5m]"\n0,0\n"0,5","12,5"\n1,50\n',
    "both micro signs of Unicode": "r [mm],f [\u00b5m]\n0,0\n0.5,12.5\n1,50\n".encode(),
    "the letter mu": "r [mm],f [\u03bcm]\n0,0\n0.5,12.5\n1,50\n".encode(),
    "other columns, another order, empty rows": "time [s];f (\u00b5m);r/mm;note\n0;0;0;a\n1;12,5;0,5;b 1\n2;50;1;\n;;;\n"
                                                .encode(),
    "blanks, and a stray carriage return": b"r [mm]\r f [um]\r\n0 0\n0.5 12.5\n1 50\n",
    "two carriage returns at each end": b"r [mm],f [um]\r\r\n0,0\r\r\n0.5,12.5\r\r\n1,50\r\r\n",
    "blanks": b"# measured\nr [mm] f [um]\n0 0\n0.5 12.5\n\n1 50\n",
    "tabs": b"r [mm]\tf [um]\n0\t0\n5e-1\t12,5\n1\t+50\n",
    "commas above, blanks below": b"r [mm], f [um]\n0 0\n0.5 12.5\n1 50\n",
    "Excel's Unicode text (UTF-16, tabs, decimal commas)": "\ufeffr [mm]\tf [\u00b5m]\r\n0\t0\r\n0,5\t12,5\r\n1\t50\r\n"
                                                           .encode("utf-16-le"),
    "UTF-16 without its mark": "r [mm]\tf [\u00b5m]\r\n0\t0\r\n0,5\t12,5\r\n1\t50\r\n".encode("utf-16-le"),
    "UTF-16 without its mark, high byte first": "r [mm];f [um]\n0;0\n0,5;12,5\n1;50\n".encode("utf-16-be"),
    "more names than fields, and notes of several words": b"r [mm],f [um],note,more\n0,0,a word\n0.5,12.5,a word\n1,50,a word\n",
    "an empty first field": b",r [mm],f [um]\n0,0,0\n1,0.5,12.5\n2,1,50\n",
    "UTF-16, high byte first": "\ufeffr [mm];f [\u03bcm]\n0;0\n0,5;12,5\n1;50".encode("utf-16-be"),
    "blanks before units": b"r  [mm] ,f   [um]\n0,0\n0.5,12.5\n1,50\n",
    "separators at the end": b"r [mm],f [um],,\n0,0,,\n0.5,12.5,,\n1,50,,\n",
    "separators at the end of the header": b"r [mm],f [um],,\n0,0\n0.5,12.5\n1,50\n",
    "columns of numbers": b"k [-],m [],r [mm],f [um]\n1,2,0,0\n1,2,0.5,12.5\n1,2,1,50\n",
    "many blanks": b"r   [mm]   f   [um]\n0   0\n0.5   12.5\n1 50   \n",
    "a micro sign alone": b"\xb5 [mm],r [mm],f [um]\n0,0,0\n1,0.5,12.5\n1,1,50\n",
    "a column twice that is not asked for": b"n,r [mm],n,f [um]\n0,0,0,0\n1,0.5,7,12.5\n2,1,5,50\n",
    "a column of notes behind blanks": b"r [mm] f [um] note\n0 0 a\n0.5 12.5 b\n1 50 c\n",
    "separators within brackets": b"note (a, b),r [mm],f [um]\nx,0,0\ny,0.5,12.5\nz,1,50\n",
    "separators within square brackets": b"note [a, b],r [mm],f [um]\nx,0,0\ny,0.5,12.5\nz,1,50\n",
    "quotation marks around separators, and around nothing": b'note,r [mm],f [um]\n"",0,0\n"a, b",0.5,12.5\n"",1,50\n',
    "every form of a number": b"r [mm];f [um]\n0,;-.0\n,5;12,5" + 70 * b"0" + b"E0\n" + 70 * b"0" + b"1;+5e+001\n",
    "a bracket that closes nothing": b"a),r [mm],f [um]\nx,0,0\ny,0.5,12.5\nz,1,50\n",
    "blanks, and units in parentheses": b"r (mm) f (um)\n0 0\n0.5 12.5\n1 50\n",
    "a unit that is no power of ten": b"r [mm],f [inch]\n0,0\n0.5,0.00049212598425196850394\n1,0.0019685039370078740157\n",
    "inches as people call them": b"r [mm],f [in]\n0,0\n0.5,0.00049212598425196850394\n1,0.0019685039370078740157\n",
    "a factor before a unit": b"r [0.1 mm],f [1e2 nm]\n0,0\n5,125\n10,500\n",
    "a factor that is no power of ten": b"r [0.5 mm],f [25 um]\n0,0\n1,0.5\n2,2\n",
    "rows of blanks and separators": b"r [mm];f [um]\n ; \t;\n0;0\n 0.5 ;\t12.5\n;\n \n1;50\n",
    "comments behind rows": b"r [mm],f [um] # where\n0,0 # here\n0.5,12.5#0.1, 2\n1,50,# and, so on\n",
    "comments behind rows of blanks": b"r [mm] f [um]\n0 0 # here, 1 2\n0.5 12.5 #\n1 50# end\n",
    "numbers of notes": b"note,r [mm],f [um]\n1#,0,0\n2 #3,0.5,12.5\n3#,1,50\n",
    "decimal commas and decimal points that say which they are": b"r [mm];f [um]\n0;0\n0.500;12,5\n1,0;50.0000\n",
    "three places behind every comma": b"r [mm];f [um];t [s]\n0;0,000;1,250\n0,5;12,500;3,750\n1;50,000;5,000\n",
    "three places behind every point": b"r [mm];f [um];t [s]\n0;0.000;1.250\n0.5;12.500;3.750\n1;50.000;5.000\n",
    "a column of thousands that is not asked for": b"r [mm];f [um];n\n0;0;1.500\n0,5;12,5;2.000\n1;50;3\n",
    "a line of units in brackets, between blanks": b"r f\n[mm] [um]\n0 0\n0.5 12.5\n1 50\n",
    "a line of units, one of a plain number": b"n r f\n- (mm) (um)\n1 0 0\n2 0.5 12.5\n3 1 50\n",
    "a separator named": b"sep=;\nr [mm];f [um]\n0;0\n0,5;12,5\n1;50\n",
}
WRONG = {
    b"r [mm],f [um]\n0,0\n0.5,12,5\n": ":3: more than 2 fields, one for each name of the header",
    b"r [mm];f [um]\n0;0\n1.234,5;12\n": ":3: expected a number as r, not '1.234,5'",
    b"r [mm];f [um]\n0;0\n950,5;5\n1.500;12\n": ":4: r = 1.500 may be 1.5 or 1500, since line 3 has a decimal comma: write it without its point, or with a comma",
    b"r [mm];f [um]\n0;0\n1;1.500\n2;2.500\n950,5;5\n": ":3: f = 1.500 may be 1.5 or 1500, since line 5 has a decimal comma",
    b"r [mm];f [um]\n0;0\n-1.500;1,5\n": ":3: r = -1.500 may be -1.5 or -1500, since line 3 has a decimal comma",
    b"r [mm];f [um]\n0;0\n950.5;5\n1,500;12\n": ":4: r = 1,500 may be 1.5 or 1500, since line 3 has a decimal point: write it without its comma, or with a point",
    b"r [mm],f [um]\n0,0\n0.5,1\n\"1,500\",12\n": ":4: r = 1,500 may be 1.5 or 1500, since line 3 has a decimal point",
    b"r [mm];f [um]\n0;0\n12,500;5\n123.500;12 # far\n": ":3: r = 12,500 may be 12.5 or 12500, since line 4 has a decimal point",
    b"r [mm];f [um]\n0;0\n0,5;5\n1;12.000 # far\n": ":4: f = 12.000 may be 12 or 12000, since line 3 has a decimal comma",
    b"r [um];f [nm]\n0;0\n500,0;12500\n1 000,0;50 000\n": ":4: expected a number as r, not '1 000,0'",
    "r_mm ; f_um\n0,5 ; 1\u202f155,72\n1,5 ; 2\u202f155,25\n2,5 ; 7,25\n".encode(): ":2: expected a number as f, not '1\u202f155,72'",
    b"r [um];f [nm]\n1'000.0;50'000\n0;0\n500.0;12500\n": ":2: expected a number as r, not '1'000.0'",
    "r [um];f [nm]\n0;0\n500.0;12500\n-1\u202f000;50\u00a0000\n".encode(): ":4: expected a number as r, not '-1\u202f000'",
    b"r [mm],f [um]\n0,0\n0.5,12x\n": ":3: expected a number as f, not '12x'",
    b"r [mm],f [um]\n0,0\n0.5#,12\n": ":3: expected a number as r, not '0.5#'",
    b"r [mm],f [um]\n0,0\n0.5,12x # 3\n": ":3: expected a number as f, not '12x # 3'",
    b"r [mm],f [um]\n0,0\n0.5 # 3,12\n": ":3: expected a number as r, not '0.5 # 3'",
    b"r [mm],f [um]\n0,0\n1e,12\n": ":3: expected a number as r, not '1e'",
    b"r [mm],f [um]\n0,0\n1e+,12\n": ":3: expected a number as r, not '1e+'",
    b"r [mm],f [um]\n0,0\n1..,12\n": ":3: expected a number as r, not '1..'",
    b"r [mm],f [um]\n0,0\n.,12\n": ":3: expected a number as r, not '.'",
    b"r [mm],f [um]\n0,0\n-,12\n": ":3: expected a number as r, not '-'",
    b"r [mm];f [um]\n0;0\n1,5,2;12\n": ":3: expected a number as r, not '1,5,2'",
    b"r [mm];f [um]\n0;0\n1,5.2;12\n": ":3: expected a number as r, not '1,5.2'",
    b"r [mm],f [um]\n0,0\n0x5,12\n": ":3: expected a number as r, not '0x5'",
    b"r [mm],f [um]\n0,0\n0.5\n": ":3: expected a number as f, and the line ends",
    b"r [mm],g [N]\n0,0\n": "has no column f: its columns are r, g, by line 1, \"r [mm],g [N]\"; say which it is: using f=COLUMN",
    b"r [mm],f [um mm^]\n0,0\n": ":1: column f: a bad unit 'um mm^'",
    b"r [mm],f [um 3]\n0,0\n": ":1: column f: a bad unit 'um 3'",
    b"r [mm],f [um$]\n0,0\n": ":1: column f: unexpected character '$'",
    b"r [mm],f [0 um]\n0,0\n": ":1: column f: a bad unit '0 um'",
    b"r [mm],f [10]\n0,0\n": ":1: column f: expected a unit",
    b"r [mm],f [um 10]\n0,0\n": ":1: column f: a bad unit 'um 10'",
    b"r [mm],f [$]\n0,0\n": ":1: column f: unexpected character '$'",
    b"r [mm],f [foo]\n0,0\n": ":1: column f: unknown unit 'foo'; try: help units",
    b"r [mm],f um\n0,0\n": "has no column f: its columns are r, f um, by line 1",
    b"r [mm],f [N]\n0,0\n1,5\n": "column f is a force: it needs the unit of a length in the header\n",
    b"r [kN],f [um]\n0,0\n1,5\n": "column r is a force: it needs the unit of a length in the header\n",
    b"r [mm],f\n0,0\n1,5\n": "column f is a number: it needs the unit of a length in the header, or here: using f=COLUMN UNIT\n",
    ",".join("c%d" % i for i in range(65)).encode() + b"\n" + b",".join([b"0"] * 65) + b"\n": ":2: more than 64 columns",
    b"r [mm],f [um]\n": "holds no rows of numbers", b"": "holds no rows of numbers",
    b"," * 63 + b"0,$\n": "holds no rows of numbers",  # number and word in the last of the fields that are told apart
    b"0,0\n1,1\n": "has no column r: it has no line of names above its rows; say which it is: using r=NUMBER UNIT",
    b"r [mm],f [um]\n0,0\n0.5,\"12.5\n": ":3: expected a number as f, not '\"12.5'",
    b"r [mm],f [um]\n0,0\n1e400,5\n": ":3: expected a number as r, not '1e400'",
    b",,\n0,0\n": "has no column r: it has no line of names above its rows",
    b"r [mm f (um)\n0 0\n": ":1: a unit in the header is not closed",
    ("r [mm]," + ",".join("column%d%s" % (i, 50 * "x") for i in range(60)) + "\n0" + 60 * ",0" + "\n").encode(): "has no column f: its columns are r, column0",
    b"r [mm],f [um\n0,0\n": ":1: a unit in the header is not closed",
    b"r [mm],f [um]\n0,0\n1,\0\n": ":3: this is no text, or UTF-16 without its mark: save it as UTF-8",
    b"r [mm],r [mm],f [um]\n0,0,0\n0.5,0.7,12.5\n1,2,50\n": " has two columns r: rename one",
    b"r [mm],f [um]\n0,1\n1,2\n": ":2: f(0) = 1 um must be 0",
}


def scripts(tests):
    """Scripts and transcripts as saved by editors on Windows."""
    for coding in "utf-8", "utf-16-le", "utf-16-be":
        script = "\ufefffret> x = 3 \u00b5m\r\nx # \u20ac\r\nfoo\r\n".encode(coding)
        with tests.file(script) as path:
            for way, name, done in (("file", path, tests.run(path)), ("pipe", "stdin", tests.run(input=script)),
                                    ("source", path, tests.run("-c", "source " + path))):
                tests.check("a script in %s, as %s" % (coding, way), done.stdout == "x = 3 um\n" and done.returncode == 1 and
                            "%s:3:1: error: unknown name 'foo'\n  foo\n  ^~~\n" % name in done.stderr, tests.report(done))
        with tests.file("\ufefffret> 3 \u00b5m\r\n3 \u00b5m = 3 um\r\n".encode(coding), ".txt") as path:
            done = tests.run("--replay", path)
            tests.check("a transcript in " + coding, done.stdout.endswith(": 1 passed, 0 failed\n"), tests.report(done))


def run(tests):
    def answer(data):
        with tests.file(data, ".csv") as path:
            done = tests.run("--format=json", "-c", SCENE + "geometry file %s; press FN=1 N; a, dz, f(0.7 mm)" % path)
        return done

    want = answer(PLAIN)
    tests.check("a gap from a file", want.stdout.count('"name"') == 3 and want.returncode == 0, tests.report(want))
    for name, data in SAME.items():
        done = answer(data)
        tests.check("a gap with " + name, done.stdout == want.stdout and done.returncode == 0, tests.report(done))
    for data, message in WRONG.items():
        done = answer(data)
        tests.check("a gap: " + message, message in done.stderr and done.returncode == 1, tests.report(done))
    scripts(tests)
    with tests.file(b"time [s];Fx [N];FN [kN]\n0;0;0,1\n1;15;0,12\n", ".csv") as path:
        done = tests.run("-c", SCENE + "geometry sphere R=10 mm; follow %s; FN, Fx" % path)
        tests.same("a load with other columns", "FN = 120 N\nFx = 15 N", done.stdout + done.stderr)
    with tests.file(b"# a b\n# x y\n1 2\n3 4\n", ".txt") as path:
        done = tests.run("--format=csv", "-c", "table x*y at %s" % path)
        tests.same("names in the nearer of two comments", "x,y,x*y\n1,2,2\n3,4,12", done.stdout + done.stderr)
