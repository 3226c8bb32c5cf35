/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Topics of help: one row each. Touches nothing. */
#include "help/topics.h"

#include <string.h>

#include "language/expr.h"
#include "statement/scripts.h"
#include "text/characters.h"
#include "text/lines.h"

/* ---- from tables ------------------------------------------------------------------------------- */

void help_units(FILE *to) {
    fputs("After a number, with or without a space (210 GPa, 0.3N/mm^2), and after `in`.\n"
          "A unit belongs to all of the numbers before it (60*pi N, (1/3) N); behind a\n"
          "division, as in 1/2 inch, that or 1/(2 inch) is meant: the one that fits where\n"
          "it stands, and an error where both would.\n"
          "Those marked * take the prefixes n u \xc2\xb5 m k M G; c goes with m alone.\n",
          to);
    const char *name;
    for (size_t i = 0; (name = unit_name(i)); i++)
        fprintf(to, "    %s%*s%c  %s\n", name, 5 - (int)text_columns(name, strlen(name)), "",
                unit_prefixed(i) ? '*' : ' ', unit_meaning(i));
}

static void functions(FILE *to) {
    for (size_t i = 0; builtin_name(i); i++)
        fprintf(to, "    %-10s  %s\n", builtin_name(i), builtin_summary(i));
}

static void quantity_line(FILE *to, const quantity *q, bool call) {
    char name[LEX_NAME];
    snprintf(name, sizeof name, call ? "%s(%s)" : "%s", q->name, q->argument);
    fprintf(to, "    %-10s  ", name);
    help_wrapped(to, q->title, 16, 16);
}

static void quantities(FILE *to) {
    const quantity *q;
    fputs("Inputs (NAME = EXPR sets them, NAME := EXPR binds them):\n", to);
    for (size_t i = 0; (q = quantity_row(i)); i++)
        if (quantity_is_input(q) && !q->imposed)
            quantity_line(to, q, false);
    fputs("Results:\n", to);
    for (size_t i = 0; (q = quantity_row(i)); i++)
        if ((!quantity_is_input(q) || q->imposed) && quantity_has_value(q))
            quantity_line(to, q, false);
    fputs("Functions of the scene:\n", to);
    for (size_t i = 0; (q = quantity_row(i)); i++)
        if (quantity_arguments(q))
            quantity_line(to, q, true);
}

/* ---- the paper --------------------------------------------------------------------------------- */

/* Its equations are (1) to (28), then (A1) to (A3): of some, what no formula of a quantity says. */
enum { EQUATIONS = 28, APPENDIX = 3 };
static const char *const equations[EQUATIONS + 1] = {
    [2] = "no quantity is computed by it",
    [3] = "g(x) from f(r), an Abel transform; fields by its inverse",
    [19] = "which springs stick in a step: step, cycle, follow",
    [21] = "the area of the hysteresis loop: plot loop, and W over a cycle",
    [24] = "no quantity is computed by it",
    [25] = "the energy dissipated per cycle; agrees with (21), (22), (26) and (27)",
    [28] = "(27) for a sphere and k = 0, by Mindlin and Deresiewicz: dW there"};

static bool quotes(const quantity *q, const char *number) {
    for (size_t j = 0; j < FORMULAS && q->formulas[j].text; j++)
        if (q->formulas[j].equation && strstr(q->formulas[j].equation, number))
            return true;
    return false;
}

/* The first formula of a result with this number alone, else the first that mentions it. */
static const char *formula_of(const char *number) {
    const quantity *q;
    const char *mentions = NULL;
    for (size_t i = 0; (q = quantity_row(i)); i++)
        for (size_t j = 0; j < FORMULAS && q->formulas[j].text; j++) {
            const formula *f = &q->formulas[j];
            if (f->equation && q->of != OF_INPUT && !strcmp(f->equation, number))
                return f->text;
            if (f->equation && !mentions && strstr(f->equation, number))
                mentions = f->text;
        }
    return mentions;
}

static void equation(FILE *to, const char *number, const char *text) {
    char names[512] = "";
    const quantity *q;
    fprintf(to, "%-5s ", number);
    if (!text)
        text = formula_of(number);
    for (size_t i = 0; (q = quantity_row(i)); i++)
        if (quotes(q, number)) {
            const size_t n = strlen(names);
            snprintf(names + n, sizeof names - n, "%s%s", n ? ", " : "in: ", q->name);
        }
    enum { INDENT = 6 };
    help_wrapped(to, text, INDENT, INDENT);
    if (*names) {
        fprintf(to, "%*s", INDENT, "");
        help_wrapped(to, names, INDENT, INDENT + 4);
    }
}

#define TITLE_BEGINS "Frictional Energy Dissipation in Partial Slip Contacts of Axisymmetric Power-Law Graded"
#define TITLE_ENDS                                                                                           \
    "Elastic Solids under Oscillating Tangential Loads: Effect of the Geometry and the In-Depth Grading"
static const char reference[] = "J. Wilhayn, M. He\xc3\x9f: " TITLE_BEGINS " " TITLE_ENDS
                                ". Mathematics 2022, 10(19), 3641. https://doi.org/10.3390/math10193641";

void help_cite(FILE *to) {
    help_wrapped(to, reference, 0, 4);
    fputs("fret " FRET_VERSION ": an interactive calculator for partial-slip contact.\n\n"
          "@article{math10193641,\n"
          "  author  = {Wilhayn, Josefine and He{\\ss}, Markus},\n"
          "  title   = {" TITLE_BEGINS "\n             " TITLE_ENDS "},\n"
          "  journal = {Mathematics},\n"
          "  year    = {2022},\n"
          "  volume  = {10},\n"
          "  number  = {19},\n"
          "  pages   = {3641},\n"
          "  doi     = {10.3390/math10193641}\n"
          "}\n"
          "@misc{fret,\n"
          "  title   = {fret: an interactive calculator for partial-slip contact},\n"
          "  author  = {{The authors of fret}},\n"
          "  note    = {version " FRET_VERSION "}\n"
          "}\n",
          to);
}

static void paper(FILE *to) {
    help_wrapped(to, reference, 0, 4);
    fputs("\nIts equations, and the quantities that they make; `cite` has it as BibTeX.\n"
          "`explain NAME` puts the numbers of the scene in; `demo fig04` to `demo fig13`\n"
          "and `demo s1` to `demo s3` draw the figures and videos.\n\n",
          to);
    for (int i = 1; i <= EQUATIONS + APPENDIX; i++) {
        char number[16];
        snprintf(number, sizeof number, i > EQUATIONS ? "(A%d)" : "(%d)", i > EQUATIONS ? i - EQUATIONS : i);
        equation(to, number, i > EQUATIONS ? NULL : equations[i]);
    }
    fputs("\nSlips of the paper, as this program reads it:\n"
          "  (13)       is for two equal elastic bodies; here it holds for any two\n"
          "  (19)       beyond first loading the test needs the trial displacement of\n"
          "             the spring, u + d(delta_x), not delta_x\n"
          "  (22)       tells the loss on the first branch only; here it is W1D, signed\n"
          "  (26),(27)  come out negative; dW is the positive energy dissipated\n"
          "  Fig. 12    `k = -0.5, 1, 0.5` in its text means k = -0.5, 0, 0.5\n"
          "  Section 3  `exponentially` is a power law: dW ~ FA^3 at small FA\n",
          to);
}

/* ---- lessons ----------------------------------------------------------------------------------- */

static const char lessons_text[] =
    "A lesson is a text file: its title, then lines of words that begin with `#`, and\n"
    "statements. A key leads from the words to the statements behind them, which are\n"
    "shown with their answers; of `ask` the question alone is shown.\n\n"
    "    ask \"TEXT\" = EXPR within 5 % hint \"TEXT\"    the answer is a value\n"
    "    ask \"TEXT\" of \"A\", \"B\" = 2 hint \"TEXT\"    it is the second of these\n\n"
    "A lesson begins without a scene. EXPR is evaluated where the question stands. A\n"
    "statement that is meant to fail ends in `# refused`. A transcript with a title\n"
    "above it is a lesson too: what follows its prompts counts, answers do not.\n\n"
    "    demo ./FILE                a name with a `.` or a `/`. Mistakes are told line\n"
    "                               by line, and a lesson that has some is not played\n"
    "    demo ./FILE to FILE.html   a handout of it; in the sources `make handouts`\n"
    "                               makes those of all lessons here\n";

/* What is said of the paper, to the end of the step. */
static void paper_line(FILE *to, const script *s) {
    static const char word[] = "# The paper:";
    char text[512] = "";
    bool found = false;
    for (const char *const *line = s->line; *line; line++) {
        found = **line == '#' && (found || !strncmp(*line, word, sizeof word - 1));
        if (found)
            snprintf(text + strlen(text), sizeof text - strlen(text), "%s%s", *text ? " " : "", *line + 2);
    }
    fputs("    ", to);
    help_wrapped(to, text, 4, 8);
}

static void teaching(FILE *to) {
    enum { QUESTION = 200 };
    char text[QUESTION];
    fputs("The lessons in their order, ten minutes each or less: their questions and the\n"
          "answers. `demo NAME` plays one, `demo NAME to FILE.html` is a handout of it, and\n"
          "`help lessons` tells how to write your own.\n",
          to);
    for (const script *s = scripts; s->name; s++) {
        const char *const *answer = s->answer;
        if (!answer)
            continue;
        fprintf(to, "\n%-10s  ", s->name);
        help_wrapped(to, s->title, 12, 12);
        for (const char *const *line = s->line; *line && *answer; line++)
            if (!strncmp(*line, "ask \"", 5)) {
                snprintf(text, sizeof text, "%.*s", (int)strcspn(*line + 5, "\""), *line + 5);
                fputs("    ", to);
                help_wrapped(to, text, 4, 8);
                fputs("        ", to);
                help_wrapped(to, *answer++, 8, 12);
            }
        paper_line(to, s);
    }
}

/* ---- the table --------------------------------------------------------------------------------- */

static const char expressions_text[] =
    "+ - * / ^ ( ) bind as usual; -2^2 is -4. Every value has a dimension, and a\n"
    "mismatch is an error that names both.\n\n"
    "    NAME = EXPR, ...       sets inputs or names of your own, now\n"
    "    NAME := EXPR           a live definition: evaluated wherever NAME is used\n"
    "    NAME(X, ...) := EXPR   a function of your own\n"
    "    EXPR in UNIT           the value in that unit\n"
    "    EXPR at NAME = EXPR    the value in the scene with that input changed;\n"
    "                           along a load, at the same instant of it\n"
    "    (integral EXPR for x = LO .. HI)   over a free name or an input; ends where EXPR\n"
    "                           is infinite do no harm if the integral is finite\n"
    "    (maximum EXPR along cycle), (minimum EXPR along program), (maximum EXPR for\n"
    "        x = LO .. HI)      the largest, the smallest, also between points\n"
    "    ans                    the last value printed\n\n"
    "`;` parts the statements of a line. `#` begins a comment, but not within a word\n"
    "such as a#b.csv. A line goes on after `\\`.\n\n";

static const char scripts_text[] =
    "    fret FILE ...          runs scripts; so do fret -f FILE and a pipe\n"
    "    fret -c 'STATEMENTS'   runs these\n"
    "    source FILE            runs a script from the prompt or from a script\n"
    "    fret --replay FILE     runs what follows each `fret> ` of a transcript and\n"
    "                           compares the answers: a transcript is a test\n"
    "    fret --part I/N ...    a share of the rows of its table, as CSV or JSON: by N\n"
    "                           machines, and put together by cat\n\n"
    "A script stops at its first error, told as FILE:LINE:COLUMN, with exit status 1;\n"
    "--keep-going goes on. A wrong option exits with 2, an interrupt with 130.\n\n"
    "At a terminal the statements of $XDG_CONFIG_HOME/fret/fretrc, else of\n"
    "~/.config/fret/fretrc, run before the first prompt, such as `set digits 8`;\n"
    "--no-rc leaves them out.\n\n"
    "    save FILE              the scene as a script that makes it again\n"
    "    save history FILE      the lines typed in this session\n"
    "    record FILE            from here on a transcript, until record off\n"
    "    replay FILE            runs a transcript beside the session\n\n"
    "A copy of a terminal is a transcript, too. What depends on who types, on the\n"
    "terminal or on the clock (reports, pictures, times) may be there or not.\n";

static const char files_text[] =
    "Read, by `follow`, `fit`, `loop`, `table at`, `plot over` and `geometry file`\n"
    "alike: tables as people, spreadsheets, instruments and programs write them. The\n"
    "rows are lines with numbers in the same columns, the header is the last line of\n"
    "names above them: a preamble of any length, a footer, labels between the rows\n"
    "and `#` comments do not matter. Units stand behind the names, `dx [um]`,\n"
    "`dx (um)`, `dx/um`, `dx in um`, `dx_um`, or all in a line below them.\n"
    "Semicolons, tabs, commas or blanks part the columns; where it is no comma, a\n"
    "comma within a number is a decimal one. `1.500` in a file with `950,5` is\n"
    "refused: it may be 1.5 or 1500. UTF-8, UTF-16, Windows-1252 and, where the\n"
    "system knows it, Shift-JIS are told by their bytes.\n\n"
    "Columns are found by name; one that has another name by its dimension, where it\n"
    "is the only one; else `using` tells: `using dx=Weg, Fx=\"Load On Sample\"`, or by\n"
    "number, with a unit where the file has none: `using dx=1 um, Fx=2 N`. Rows\n"
    "without a value (empty, NaN, No Data, #DIV/0!) in a column that is used are\n"
    "left out. A note tells what was understood. A normal force that is negative\n"
    "throughout is compression; an Fx that falls where dx grows is turned, but not\n"
    "by `follow`.\n\n"
    "`geometry file GAP.csv` wants r and f, of two other lengths the first is r;\n"
    "`height` says that f = -z. `follow LOAD.csv` wants FN and Fx, or dz and dx; dx\n"
    "and Fx: then dx drives at constant FN, and how far Fx is from the computed one\n"
    "is told (rms).\n\n"
    "A measured profile is noisy, and a contact on its bumps is no disc. `geometry\n"
    "file GAP.csv smooth` takes the cubic spline nearest to the rows (least squares)\n"
    "that begins with f = 0 and f' = 0: `smooth 8` of 8 pieces, `smooth 0.1 um` of\n"
    "as few as come within that misfit (rms), `smooth` alone of as many as predict\n"
    "left out rows best (generalised cross-validation). The misfit is told, and the\n"
    "height at r = 0 that is taken off. Rows may then be in any order and on both\n"
    "sides: the apex is found where one side mirrors the other, a tilt is taken off,\n"
    "both are told. Where noise would make it fall it is the nearest convex profile;\n"
    "one that falls by more than noise is refused.\n\n"
    "Written: `history to FILE`, `table ... to FILE`. FILE.csv is in SI or the units\n"
    "asked for, FILE.json has an object a line in SI, the first with the units of\n"
    "the columns, FILE.txt and FILE.dat are as shown, with blank lines between\n"
    "curves. `plot ... to FILE`: the ending tells the kind of picture. A file is\n"
    "written whole or not at all; that one was there before is said. ~ is the home\n"
    "directory; a name with blanks goes into quotation marks.\n\n"
    "`plot ... over FILE.csv` lays points on top: columns with the names of the\n"
    "axes, else the only one of the dimension without the name of another quantity.\n"
    "`animate ... to FILE.gif` writes a moving picture.\n\n"
    "What is typed at the prompt is kept in $XDG_STATE_HOME/fret/history, else in\n"
    "~/.local/state/fret/history, for you alone to read.\n";

static const char theory_text[] =
    "Two bodies, pressed together with F_N and pushed sideways with F_x, touch in a\n"
    "disc of radius a. Its rim slips, its middle r < c sticks: partial slip. At\n"
    "F_x = mu F_N all of it slips: gross slip. A cycle of F_x dissipates dW, the area\n"
    "of the hysteresis loop.\n\n"
    "The modulus grows or falls with depth, E(z) = E0 (z/c0)^k. The method of\n"
    "dimensionality reduction (MDR) replaces the bodies by independent springs of\n"
    "stiffness c_N(x) and c_T(x) under the profile g(x), exactly within the theory\n"
    "of Cattaneo and Mindlin. In the depth y = g(x), k and the shape vanish from the\n"
    "rule of stick and slip: the memory diagram follows any history of F_N and F_x\n"
    "without discretisation. `help paper` lists the equations, `explain NAME` puts\n"
    "numbers in.\n";

const char coupling_text[] =
    "The theory neglects what couples normal and tangential contact. That is exact\n"
    "for equal bodies, for nu = 1/(2+k), and without friction. Else a warning, where\n"
    "something tangential is asked, tells the mismatch: how far a pressure displaces\n"
    "the two surfaces sideways against each other, as a part of how far it presses\n"
    "them in; 0: not at all; for k = 0 it is Dundurs' second constant. What it costs,\n"
    "for steel on aluminium (0.117, k = 0): a coupled solution gave 1.39, 1.05, 1.03,\n"
    "1.02 and 1.01 times the dW of here in the first five cycles: the first is badly\n"
    "off, then the contact shakes down. While it is pressed, k = 0: where friction\n"
    "holds all of it, kn at a radius is artanh(beta)/beta times that of here, with\n"
    "beta the mismatch (Spence 1968), and between the two where some slips. For other\n"
    "k the size is not known.\n";

static const char cracking_text[] =
    "Cracks begin where the surface is pulled and where it slips. Indicators of both\n"
    "are definitions over the last cycle, along the line y = 0 of the surface:\n\n"
    "    Sxx(x) := (maximum sxx(x, 0 m, 0 m) along cycle)     the largest tension\n"
    "    Ruiz1(x) := (maximum qx(abs(x))*slip(abs(x)) along cycle)\n"
    "    Ruiz2(x) := Sxx(x)*Ruiz1(x)\n"
    "    SWT(x) := Sxx(x)*(Sxx(x) - (minimum sxx(x, 0 m, 0 m) along cycle))/(2*E0)\n\n"
    "Ruiz' parameters (Ruiz, Boddington, Chen, Exp. Mech. 24, 1984) are friction's\n"
    "traction times slip, and that times tension; they rank places and scenes of one\n"
    "material, and are no strength. Smith, Watson and Topper's (J. Mater. 5, 1970) is\n"
    "the largest stress times the amplitude of strain, here of sxx/E0 alone, that of\n"
    "a bar: other planes, and how stress falls off below, it does not know.\n"
    "`maximize Sxx(x) over x = -1.5*a .. 1.5*a` tells the place.\n\n"
    "Stress inside: with the line loads q_z = qz1D(t), q_x = qx1D(t) on the imaginary\n"
    "axis, zeta = z + i t, rho^2 = x^2+y^2+zeta^2, V = 1/rho, L = ln(rho+zeta),\n"
    "chi = zeta L - rho, and subscripts for derivatives,\n\n"
    "    P_xx = 2nu V_zeta - (1-2nu) L_xx - z V_xx, P_yy alike\n"
    "    P_zz = V_zeta - z V_zeta,zeta, P_xy = -(1-2nu) L_xy - z V_xy\n"
    "    P_xz = -z V_x,zeta, P_yz = -z V_y,zeta\n"
    "    Q_xx = 2(1+nu) V_x + 2nu chi_xxx - z L_xxx\n"
    "    Q_yy = 2nu V_x + 2nu chi_xyy - z L_xyy, Q_zz = -z V_x,zeta\n"
    "    Q_xy = V_y + 2nu chi_xxy - z L_xxy\n"
    "    Q_xz = V_zeta - z V_xx, Q_yz = -z V_xy\n\n"
    "of Boussinesq's and Cerruti's point loads, to 1e-12 of p0, and 1e-6 after FN has\n"
    "swung. x is along Fx, z > 0 in the first body, z < 0 in the second; tension is\n"
    "positive. All for k = 0 and as long as it is elastic: after `yield = 500 MPa` a\n"
    "note tells where mises exceeds it. slip(r) is the mean over the angle.\n";

static const char limits_text[] =
    "\nSlip across the direction of F_x is neglected too, as by Cattaneo and Mindlin:\n"
    "0.4 % of dW in a comparison with boundary elements.\n\n"
    "    -1 < k < 1, -1 < nu <= 1/2; both bodies share k and c0\n"
    "    bodies are half-spaces: a warning where a > 0.3 R (of R1 and R2 the smaller one) or\n"
    "        a slope exceeds 20 deg\n"
    "    the contact is a disc: g(x) must not fall\n"
    "    quasi-static, no adhesion, one coefficient of friction\n"
    "    slip and friction's work at a radius are means over the angle, along F_x\n\n"
    "`accuracy` tells the numerical error of every model in your scene, `explain`\n"
    "that of an answer, and `explain EXPR conditioning` what the last digit of each\n"
    "input does to it.\n";

static const char prompt_text[] =
    "    Tab            completes: commands, arguments, units, names, files\n"
    "    Up, Ctrl-R     earlier lines, of earlier sessions too\n"
    "    Ctrl-C         drops the line, or stops what runs; the scene stays\n"
    "    Ctrl-D         leaves\n"
    "    ?WORD          the same as help WORD\n"
    "    !COMMAND       runs a command of the system's shell\n\n"
    "Pasted lines run one after the other, their prompts are taken off. Keys are\n"
    "those of readline; in ~/.inputrc `$if fret` begins what is for this program.\n";

static void limits(FILE *to) {
    fputs(coupling_text, to);
    fputs(limits_text, to);
}

static const topic topics[] = {
    {.name = "expressions",
     .summary = "arithmetic, names of your own, functions",
     .keywords = "variable definition function operator live what-if",
     .text = expressions_text,
     .print = functions,
     .example = "    fret> x = 3 mm; half(u) := u/2\n"
                "    fret> half(x) + 20 um in mm, sqrt(2)^-2\n"
                "    half(x) + 20 um = 1.52 mm\n"
                "    sqrt(2)^-2 = 0.5\n"
                "    fret> material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"
                "    fret> a, (a at FN=200 N)/a\n"
                "    a = 186.626 um\n"
                "    (a at FN=200 N)/a = 1.25992\n"
                "    fret> (integral 2*pi*r*p(r) for r = 0 m .. a)\n"
                "    (integral 2*pi*r*p(r) for r = 0 m .. a) = 100 N\n"
                "    fret> cycle FA=20 N\n"
                "    fret> (maximum qx(0.15 mm) along cycle) in MPa\n"
                "    (maximum qx(0.15 mm) along cycle) = 326.252 MPa\n"},
    {.name = "units",
     .summary = "units and their prefixes",
     .keywords = "dimension SI prefix",
     .print = help_units,
     .example = "    fret> geometry sphere R=1/2 inch; R\n"
                "    R = 12.7 mm\n"
                "    fret> 3 kg*(2 m/(1 s))^2/2, 60*pi N\n"
                "    3 kg*(2 m/(1 s))^2/2 = 6 J\n"
                "    60*pi N = 188.496 N\n"
                "    fret> 1 ksi in MPa, 0.3N/mm^2, 90 deg, 5 %\n"
                "    1 ksi = 6.89476 MPa\n"
                "    0.3N/mm^2 = 300 kPa\n"
                "    90 deg = 90 deg\n"
                "    5 % = 0.05\n"},
    {.name = "quantities",
     .summary = "inputs, results and functions of the scene",
     .keywords = "input result variable stress loop",
     .print = quantities,
     .example = "    fret> material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"
                "    fret> a, c(20 N), dW(20 N), p(0.1 mm)\n"
                "    a = 186.626 um\n"
                "    c(20 N) = 148.125 um\n"
                "    dW(20 N) = 1.90646 uJ\n"
                "    p(0.1 mm) = 1.15747 GPa\n"},
    {.name = "prompt",
     .summary = "keys, completion, history, pasting",
     .keywords = "readline history completion Tab inputrc paste shell",
     .text = prompt_text,
     .example = "    fret> ?pi\n"
                "    pi: 3.14159...\n"},
    {.name = "scripts",
     .summary = "files of statements, options, the start-up file",
     .keywords = "batch pipe start-up fretrc config replay transcript save",
     .text = scripts_text,
     .example = "    fret> friction 0.4; save friction.fret\n"
                "    wrote friction.fret (26 B)\n"
                "    fret> mu = 0.3; source friction.fret\n"
                "    fret> mu\n"
                "    mu = 0.4\n"},
    {.name = "files",
     .summary = "tables and figures that are read and written",
     .keywords = "csv json export import Excel data png svg pdf save write history",
     .text = files_text,
     .example = "    $ cat gap.csv\n"
                "    r [mm],f [um]\n"
                "    0,0\n"
                "    0.5,12.5\n"
                "    1,50\n"
                "    $ cat load.csv\n"
                "    FN [N],Fx [N]\n"
                "    100,0\n"
                "    120,15\n"
                "    120,-15\n"
                "    fret> material steel; geometry file gap.csv; friction 0.4\n"
                "    fret> follow load.csv\n"
                "    fret> FN, Fx, W\n"
                "    FN = 120 N\n"
                "    Fx = -15 N\n"
                "    W = 328.223 nJ\n"
                "    fret> history to loop.csv\n"
                "    wrote loop.csv (221 B)\n"},
    {.name = "lessons",
     .summary = "how to write one: its questions, its file, a handout of it",
     .keywords = "teach exercise ask demo handout class student quiz",
     .text = lessons_text,
     .example = "    $ cat ball.txt\n"
                "    A ball on a flat\n"
                "    # 100 N press it. How wide is the contact?\n"
                "    material steel; geometry sphere R=10 mm; press FN=100 N\n"
                "    ask \"Its radius a?\" = a in mm within 20 % hint \"a^2 = R dz\"\n"
                "    fret> demo ./ball.txt\n"
                "    A ball on a flat\n"
                "    \n"
                "    # 100 N press it. How wide is the contact?\n"
                "    fret> material steel; geometry sphere R=10 mm; press FN=100 N\n"
                "    Its radius a?\n"
                "    a = 0.186626 mm\n"},
    {.name = "teaching",
     .summary = "the lessons in their order, their questions and answers",
     .keywords = "teacher class course exercise solution handout lesson",
     .print = teaching,
     .example = "    $ fret -c 'demo pressing' | grep 'the radius'\n"
                "    How large is the radius a of the contact?\n"
                "    How many times the radius a?\n"},
    {.name = "theory",
     .summary = "what is computed, in a few words",
     .keywords = "MDR Mindlin Cattaneo Hertz springs hysteresis loop dissipation partial slip memory diagram",
     .text = theory_text,
     .example = "    fret> material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"
                "    fret> step Fx=20 N\n"
                "    fret> a, c, dx, dxmax\n"
                "    a = 186.626 um\n"
                "    c = 148.125 um\n"
                "    dx = 625.995 nm\n"
                "    dxmax = 1.6917 um\n"
                "    fret> cycle FA=20 N\n"
                "    fret> dW\n"
                "    dW = 1.90646 uJ\n"},
    {.name = "paper",
     .summary = "every equation of the paper, and where it is here",
     .keywords = "equation formula reference literature slip misprint",
     .print = paper,
     .example = "    fret> material E0=210 GPa nu=0.3; geometry sphere R=10 mm\n"
                "    fret> kappa\n"
                "    kappa = 2\n"},
    {.name = "cracking",
     .summary = "tension and slip over a cycle: where cracks may begin",
     .keywords = "crack fatigue fretting Ruiz SWT Smith Watson Topper tension yield stress tensor",
     .text = cracking_text,
     .example = "    fret> material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"
                "    fret> cycle FA=20 N\n"
                "    fret> maximize (maximum sxx(x, 0 m, 0 m) along cycle) over x = 0 m .. 1.5*a\n"
                "    x = 186.626 um\n"
                "    (maximum sxx(x, 0 m, 0 m) along cycle) = 827.73 MPa\n"
                "    fret> Ruiz(x) := (maximum qx(abs(x))*slip(abs(x)) along cycle)\n"
                "    fret> Ruiz(0.9*a)\n"
                "    Ruiz(0.9*a) = 14.9162 N/m\n"},
    {.name = "limits",
     .summary = "what the theory leaves out",
     .keywords = "assumption coupling dissimilar mismatch half-space error accuracy validity",
     .print = limits,
     .example = "    fret> material steel; second aluminium; geometry sphere R=10 mm; friction 0.4\n"
                "    fret> press FN=100 N; step Fx=10 N\n"
                "    warning: the bodies are elastically dissimilar (mismatch 0.117): normal and tangential "
                "contact are coupled, and these results are an approximation, kn up to 0.46 % too small "
                "(help limits "
                "tells of dW)\n"},
};
enum { TOPICS = sizeof topics / sizeof *topics };

const topic *topic_row(size_t i) {
    return i < TOPICS ? &topics[i] : NULL;
}

const char *topic_name(size_t i) {
    return i < TOPICS ? topics[i].name : NULL;
}

/* Begins a transcript. */
#define EXAMPLE "    fret> material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N; "

const char *model_text(size_t id) {
    static const char *const texts[MODELS] = {
        [MODEL_CLOSED] = "Formulas of the paper, where the load program has one: a press and a tangential\n"
                         "step, or cycles at constant FN.\n\n" EXAMPLE "cycle FA=20 N\n"
                         "    fret> set model closed\n    fret> dW\n    dW = 1.90646 uJ\n",
        [MODEL_MEMORY] = "Follows any history exactly, without springs or step sizes: the state is a\n"
                         "polyline over the depth y = g(x). `help theory` tells more.\n\n" EXAMPLE
                         "step Fx=20 N; step FN=80 N Fx=10 N\n    fret> set model memory\n    fret> W\n"
                         "    W = 477.51 nJ\n",
        [MODEL_QUADRATURE] =
            "Integrals over the contact, for local fields and for the stiffness of loops.\n\n" EXAMPLE
            "step Fx=20 N\n    fret> qx(0.1 mm)\n    qx(0.1 mm) = 141.911 MPa\n",
        [MODEL_PIECES] =
            "The law FN(dz) of a gap without a formula is polynomials in the square of the\n"
            "radius, cell by cell, with the powers that a kink of the gap adds: a dozen cells\n"
            "for a shape, one or more for each row of a table. They are made once, in a\n"
            "millisecond, of a table in some 0.1 ms a row, and are good to 1e-15; then depth,\n"
            "force, loss and slip take microseconds, and so does any step. Up to 2000 rows\n"
            "each is taken as it is; of more, as few as do within 1e-14 to 1e-6 of the gap.\n"
            "Local fields are sums over the same cells, good to 1e-15 of the largest value.\n\n" EXAMPLE
            "geometry exact-sphere R=10 mm\n    fret> cycle FA=20 N FNA=20 N phase=90 deg; dW\n"
            "    dW = 2.53755 uJ\n",
        [MODEL_SPRINGS] = "N independent springs, stepped one by one: an approximation, for comparison.\n"
                          "`accuracy` tells its error against its time.\n\n" EXAMPLE "cycle FA=20 N\n"
                          "    fret> set model springs 100\n    fret> dW\n    dW = 1.90687 uJ\n",
    };
    return texts[id];
}
