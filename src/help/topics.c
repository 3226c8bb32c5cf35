/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Topics of help: one row each. Touches nothing. */
#include "help/topics.h"

#include <string.h>

#include "help/texts.h"
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
    [3] = "g(x) from f(r), an Abel transform, and fields by its inverse",
    [19] = "which springs stick in a step: step, cycle, follow",
    [21] = "the area of the hysteresis loop: plot loop, and W over a cycle",
    [24] = "no quantity is computed by it",
    [25] = "the energy dissipated per cycle, the same as by (21), (22), (26) and (27)",
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
    char own[512]; /* the equation alone */
    if (!text)
        text = formula_of(number);
    snprintf(own, sizeof own, "%.*s", (int)strcspn(text, ";"), text);
    for (size_t i = 0; (q = quantity_row(i)); i++)
        if (quotes(q, number))
            list_word(names, sizeof names, q->name, false);
    enum { INDENT = 6 };
    help_wrapped(to, own, INDENT, INDENT);
    if (*names) {
        fprintf(to, "%*sin: ", INDENT, "");
        help_wrapped(to, names, INDENT + 4, INDENT + 4);
    }
}

#define TITLE                                                                                                \
    "Frictional Energy Dissipation in Partial Slip Contacts of Axisymmetric Power-Law Graded Elastic "       \
    "Solids under Oscillating Tangential Loads: Effect of the Geometry and the In-Depth Grading"
static const char reference[] = "J. Wilhayn, M. He\xc3\x9f: " TITLE
                                ". Mathematics 2022, 10(19), 3641. https://doi.org/10.3390/math10193641";

void help_cite(FILE *to) {
    help_wrapped(to, reference, 0, 4);
    fputs("fret " FRET_VERSION ": an interactive calculator for partial-slip contact.\n\n"
          "@article{math10193641,\n"
          "  author  = {Wilhayn, Josefine and He{\\ss}, Markus},\n"
          "  title   = {",
          to);
    help_wrapped(to, TITLE "},", 13, 13);
    fputs("  journal = {Mathematics},\n"
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
          "  (13),(27)  are for two equal elastic bodies; here they hold for any two\n"
          "  (19)       beyond first loading the test needs the trial displacement of\n"
          "             the spring, u + d(delta_x), not delta_x\n"
          "  (22)       tells the loss on the first branch only; here it is W1D, signed\n"
          "  (26),(27)  come out negative; dW is the positive energy dissipated\n"
          "  Fig. 12    `k = -0.5, 1, 0.5` in its text means k = -0.5, 0, 0.5\n"
          "  Section 3  `exponentially` is a power law: dW ~ FA^3 at small FA\n",
          to);
}

/* ---- lessons ----------------------------------------------------------------------------------- */

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
                "    fret> material steel; geometry file gap.csv; friction 0.4\n"
                "    fret> press FN=120 N; step Fx=15 N; step Fx=-15 N; W\n"
                "    W = 394.215 nJ\n"
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
    {.name = "damper",
     .summary = "asked backwards: the friction damper of a turbine blade",
     .keywords = "blade optimum preload design damping uncertainty vibration",
     .text = damper_text,
     .example = "    fret> material E0=114 GPa nu=0.34 k=0.2 c0=0.1 mm\n"
                "    fret> geometry sphere R=20 mm; friction 0.35; press FN=200 N\n"
                "    fret> dxmax, dWd(1 um), loss_factor(1 um)\n"
                "    dxmax = 3.05041 um\n"
                "    dWd(1 um) = 5.1833 uJ\n"
                "    loss_factor(1 um) = 0.0500898\n"
                "    fret> maximize dWd(1 um) over FN = 1 N .. 400 N\n"
                "    FN = 23.4964 N\n"
                "    dWd(1 um) = 12.6519 uJ\n"
                "    fret> FN = 25 N\n"
                "    fret> dWd(1 um), Kp(1 um), loss_factor(1 um)\n"
                "    dWd(1 um) = 12.6102 uJ\n"
                "    Kp(1 um) = 8.90877 MN/m\n"
                "    loss_factor(1 um) = 0.45056\n"
                "    fret> uncertainty dWd(1 um) with mu +- 0.05, E0 +- 10 %, FN +- 10 %\n"
                "    dWd(1 um) = 12.6102 uJ +- 1.98 uJ\n"
                "        from mu 49.7 %, E0 49.8 %, FN 0.487 %\n"
                "        Monte Carlo = 12.0474 uJ +- 1.96 uJ\n"
                "    fret> solve mu for dWd(1 um) = 12 uJ from 0.05 to 0.3\n"
                "    mu = 0.177743\n"
                "    fret> export jenkins 6 to damper.h\n"
                "    wrote damper.h (824 B)\n"
                "    error of dW = 40.039 nJ\n"
                "    relative = 0.00596088\n"},
    {.name = "cracking",
     .summary = "tension and slip over a cycle: where cracks may begin",
     .keywords = "crack fatigue fretting Ruiz SWT Smith Watson Topper tension yield stress tensor",
     .text = cracking_text,
     .example = "    fret> material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"
                "    fret> cycle FA=20 N\n"
                "    fret> maximize (maximum sxx(x, 0 m, 0 m) along cycle) over x = 0 m .. 1.5*a\n"
                "    x = 186.626 um\n"
                "    (maximum sxx(x, 0 m, 0 m) along cycle) = 827.851 MPa\n"
                "    fret> Ruiz(x) := (maximum qx(abs(x))*slip(abs(x)) along cycle)\n"
                "    fret> Ruiz(0.9*a)\n"
                "    Ruiz(0.9*a) = 14.9162 N/m\n"},
    {.name = "parts",
     .summary = "one study in shares, over many cores or machines",
     .keywords = "parallel cluster SLURM --part share array job uncertainty samples",
     .text = parts_text,
     .example = "    $ fret --format=csv --part 2/3 -c 'table x^2 for x = 1 .. 3 steps 2'\n"
                "    2,4\n"},
    {.name = "programs",
     .summary = "from C, C++, Python, other programs, dynamics codes",
     .keywords = "library libfret embed numpy JSON CSV harmonic balance Jenkins export oscillator",
     .text = programs_text,
     .example =
         "    $ fret --format=json -c 'material steel; geometry sphere R=10 mm; press FN=100 N; a'\n"
         "    {\"event\":\"press\",\"FN\":100,\"a\":0.00018662555784086242,\"dz\":3.4829098839413082e-06}\n"
         "    {\"name\":\"a\",\"value\":0.00018662555784086242,\"unit\":\"m\"}\n"},
    {.name = "exactness",
     .summary = "how exact the numbers are, and how that is known",
     .keywords = "accuracy error digits ulp precision verification published boundary elements speed",
     .text = exactness_text,
     .example = "    fret> material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"
                "    fret> set digits 15; a\n"
                "    a = 186.625557840862 um\n"},
    {.name = "news",
     .summary = "what you may rely on, and what is new",
     .keywords = "version release changes stability compatibility promise",
     .text = news_text,
     .example = "    $ fret --version\n"
                "    fret 1.0.0\n"},
    {.name = "limits",
     .summary = "what the theory leaves out",
     .keywords = "assumption coupling dissimilar mismatch half-space error accuracy validity",
     .text = limits_text,
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
        [MODEL_PIECES] = "The law FN(dz) of a gap without a formula is polynomials in the square of the\n"
                         "radius, cell by cell, with the powers that a kink of the gap adds: a dozen cells\n"
                         "for a shape, one or more for each row of a table. Made once, of a shape in 1 ms,\n"
                         "of a table in 0.1 ms a row, and scaled for another R, b, slope or E0, to 1e-15:\n"
                         "force, loss and slip take microseconds, and so does any step. Up to 2000 rows\n"
                         "each is taken as it is; of more, as few as do within 1e-14 to 1e-6 of the gap.\n"
                         "Local fields are sums over the same cells (`help exactness`).\n\n" EXAMPLE
                         "geometry exact-sphere R=10 mm\n    fret> cycle FA=20 N FNA=20 N phase=90 deg; dW\n"
                         "    dW = 2.53755 uJ\n",
        [MODEL_SPRINGS] = "N independent springs, stepped one by one: an approximation, for comparison.\n"
                          "`accuracy` tells its error against its time.\n\n" EXAMPLE "cycle FA=20 N\n"
                          "    fret> set model springs 100\n    fret> dW\n    dW = 1.90687 uJ\n",
        [MODEL_BLOCKS] = "Wear of many cycles, in blocks: each wears by the slip and the pressure of the\n"
                         "gap that those before leave, and is as long as an error of 1e-3 of volume and\n"
                         "largest depth lets it be.\n\n" EXAMPLE "cycle FA=20 N\n"
                         "    fret> wear alpha=1e4 um^3/J; wear cycles 10000; Vwear\n"
                         "    Vwear = 192.42 um^3\n",
    };
    return texts[id];
}
