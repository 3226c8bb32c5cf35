/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Help topics with the tables inserted into them, citations, and help on models. Changes nothing. */
#include "help/topics.h"

#include <string.h>

#include "language/expr.h"
#include "text/characters.h"
#include "text/lines.h"

/* ---- tables ------------------------------------------------------------------------------------ */

void help_units(FILE *to) {
    fputs("After a number, with or without a space (210 GPa, 0.3N/mm^2), and after `in`.\n"
          "A unit belongs to the whole product before it (60*pi N, (1/3) N). After a\n"
          "division, 1/2 inch may be (1/2) inch or 1/(2 inch): the one whose dimension fits\n"
          "is taken; if both fit, it is an error.\n"
          "Units marked * take the prefixes n u \xc2\xb5 m k M G; c goes with m alone.\n",
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
    char name[LEX_NAME], label[LEX_NAME + 6];
    snprintf(name, sizeof name, call ? "%s(%s)" : "%s", q->name, q->argument);
    snprintf(label, sizeof label, "    %-10s  ", name);
    help_wrapped(to, label, q->title, 16);
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

/* The paper's equations are (1) to (28) and (A1) to (A3); text for those that no quantity's formula cites. */
enum { EQUATIONS = 28, APPENDIX = 3 };
static const char *const equations[EQUATIONS + 1] = {
    [2] = "no quantity is computed by it",
    [3] = "g(x) from f(r), an Abel transform, and fields by its inverse",
    [19] = "which springs stick in a step: step, cycle, follow",
    [21] = "the area of the hysteresis loop: plot loop, and W over a cycle",
    [24] = "no quantity is computed by it",
    [25] = "the energy dissipated per cycle, the same as by (21), (22), (26) and (27)",
    [28] = "(27) for a sphere and k = 0, by Mindlin and Deresiewicz: dW there"};

/* Does a formula of q cite this equation? */
static bool quotes(const quantity *q, const char *number) {
    for (size_t j = 0; j < FORMULAS && q->formulas[j].text; j++)
        if (q->formulas[j].equation && strstr(q->formulas[j].equation, number))
            return true;
    return false;
}

/* The formula of an equation: of the first result that cites it alone, else of the first that cites it. */
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

/* Writes one equation and the quantities that cite it. text: NULL takes it from the quantities. */
static void equation(FILE *to, const char *number, const char *text) {
    char names[512] = "", label[16];
    const quantity *q;
    char own[512]; /* text up to the first `;` */
    if (!text)
        text = formula_of(number);
    snprintf(own, sizeof own, "%.*s", (int)strcspn(text, ";"), text);
    snprintf(label, sizeof label, "%-5s ", number);
    for (size_t i = 0; (q = quantity_row(i)); i++)
        if (quotes(q, number))
            list_word(names, sizeof names, ", ", q->name);
    help_wrapped(to, label, own, 6);
    if (*names)
        help_wrapped(to, "      in: ", names, 10);
}

#define TITLE                                                                                                \
    "Frictional Energy Dissipation in Partial Slip Contacts of Axisymmetric Power-Law Graded Elastic "       \
    "Solids under Oscillating Tangential Loads: Effect of the Geometry and the In-Depth Grading"
static const char reference[] = "J. Wilhayn, M. He\xc3\x9f: " TITLE
                                ". Mathematics 2022, 10(19), 3641. https://doi.org/10.3390/math10193641";

void help_cite(FILE *to) {
    help_wrapped(to, "", reference, 4);
    fputs("fret " FRET_VERSION ": an interactive calculator for partial-slip contact.\n\n"
          "@article{math10193641,\n"
          "  author  = {Wilhayn, Josefine and He{\\ss}, Markus},\n",
          to);
    help_wrapped(to, "  title   = {", TITLE "},", 13);
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

static void reference_line(FILE *to) {
    help_wrapped(to, "", reference, 4);
}

static void equation_lines(FILE *to) {
    for (int i = 1; i <= EQUATIONS + APPENDIX; i++) {
        char number[16];
        snprintf(number, sizeof number, i > EQUATIONS ? "(A%d)" : "(%d)", i > EQUATIONS ? i - EQUATIONS : i);
        equation(to, number, i > EQUATIONS ? NULL : equations[i]);
    }
}

/* ---- lessons ----------------------------------------------------------------------------------- */

/* Writes the lesson's remark that begins "The paper:". */
static void paper_line(FILE *to, const script *s) {
    static const char word[] = "# The paper:";
    char text[512] = "";
    bool found = false;
    for (const char *const *line = s->line; *line; line++) {
        found = **line == '#' && (found || !strncmp(*line, word, sizeof word - 1));
        if (found)
            list_word(text, sizeof text, " ", *line + 2);
    }
    help_wrapped(to, "    ", text, 8);
}

static void lessons(FILE *to) {
    enum { QUESTION = 200 };
    char text[QUESTION], label[QUESTION];
    bool any = false;
    for (const script *s = scripts; s->name; s++) {
        const char *const *answer = s->answer;
        if (!answer)
            continue;
        fputs(any ? "\n" : "", to);
        any = true;
        snprintf(label, sizeof label, "%-10s  ", s->name);
        help_wrapped(to, label, s->title, 12);
        for (const char *const *line = s->line; *line && *answer; line++)
            if (!strncmp(*line, "ask \"", 5)) {
                snprintf(text, sizeof text, "%.*s", (int)strcspn(*line + 5, "\""), *line + 5);
                help_wrapped(to, "    ", text, 8);
                help_wrapped(to, "        ", *answer++, 12);
            }
        paper_line(to, s);
    }
}

/* ---- topics ------------------------------------------------------------------------------------ */

static const struct {
    const char *line; /* a line of a topic in whose place the table is printed */
    void (*print)(FILE *to);
} tables[] = {{"[functions]", functions},      {"[units]", help_units},         {"[quantities]", quantities},
              {"[reference]", reference_line}, {"[equations]", equation_lines}, {"[lessons]", lessons}};

const char *topic_name(size_t i) {
    return topics[i].name;
}

void help_topic(FILE *to, size_t i) {
    for (const char *const *line = topics[i].line + TOPIC_TEXT; *line; line++) {
        size_t t = 0;
        while (t < sizeof tables / sizeof *tables && strcmp(tables[t].line, *line) != 0)
            t++;
        if (t < sizeof tables / sizeof *tables)
            tables[t].print(to);
        else
            fprintf(to, "%s\n", *line);
    }
}

/* ---- models ------------------------------------------------------------------------------------ */

/* How each example begins. */
#define EXAMPLE "    fret> material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N; "

const char *model_text(size_t id) {
    static const char *const texts[MODELS] = {
        [MODEL_CLOSED] = "Formulas of the paper, for loads that have one: a press and a tangential step,\n"
                         "or cycles at constant FN.\n\n" EXAMPLE "cycle FA=20 N\n"
                         "    fret> set model closed\n    fret> dW\n    dW = 1.90646 uJ\n",
        [MODEL_MEMORY] = "Follows any history exactly, without springs or step sizes: the state is a\n"
                         "polyline over the depth y = g(x). `help theory` tells more.\n\n" EXAMPLE
                         "step Fx=20 N; step FN=80 N Fx=10 N\n    fret> set model memory\n    fret> W\n"
                         "    W = 477.51 nJ\n",
        [MODEL_QUADRATURE] =
            "Integrals over the contact, for local fields and for the stiffness of loops.\n\n" EXAMPLE
            "step Fx=20 N\n    fret> qx(0.1 mm)\n    qx(0.1 mm) = 141.911 MPa\n",
        [MODEL_PIECES] = "For a gap without a formula the law FN(dz) is made of polynomials in the square\n"
                         "of the radius, cell by cell, and of powers at kinks of the gap: a dozen cells\n"
                         "for a shape, one or more for each row of a table. It is made once, in 1 ms for a\n"
                         "shape, 0.1 ms for a row of a table, to 1e-15, and scaled for another R, b, slope\n"
                         "or E0; force, loss, slip and any step then take microseconds. Tables of up to\n"
                         "2000 rows are taken as they are, longer ones with as few rows as stay within\n"
                         "1e-14 to 1e-6 of the gap. Local fields are sums over the same cells.\n\n" EXAMPLE
                         "geometry exact-sphere R=10 mm\n    fret> cycle FA=20 N FNA=20 N phase=90 deg; dW\n"
                         "    dW = 2.53755 uJ\n",
        [MODEL_SPRINGS] = "N independent springs, stepped one by one: an approximation, for comparison.\n"
                          "`accuracy` tells its error against its time.\n\n" EXAMPLE "cycle FA=20 N\n"
                          "    fret> set model springs 100\n    fret> dW\n    dW = 1.90687 uJ\n",
        [MODEL_BLOCKS] = "Wear of many cycles, in blocks: each wears by the slip and the pressure in the\n"
                         "gap that those before leave. Blocks are as long as an error of 1e-3 of the\n"
                         "volume and of the largest depth allows.\n\n" EXAMPLE "cycle FA=20 N\n"
                         "    fret> wear alpha=1e4 um^3/J; wear cycles 10000; Vwear\n"
                         "    Vwear = 192.42 um^3\n",
    };
    return texts[id];
}
