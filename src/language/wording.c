/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Puts errors into words: the one place where names and units meet error codes. Uses `scene` and `text`. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "language/calc.h"

/* Words that newcomers try, for what has another name here or does not exist. */
static const struct {
    const char *word, *answer;
} leads[] = {
    {"bye", "quit leaves, and so does Ctrl-D"},
    {"load", "press, step, cycle and follow do it; `plot load` draws the path"},
    {"push", "step Fx=20 N pushes, cycle FA=20 N pushes to and fro"},
    {"unload", "step FN=... goes back to a smaller force"},
    {"pressure", "p(r) is the local, p0 the largest, pmean the mean one; `plot pressure` draws it"},
    {"traction", "it is qx(r); `plot traction` draws it"},
    {"E*", "the effective modulus, 1/E* = (1-nu^2)/E0 + (1-nu_2^2)/E0_2; try: help Estar"},
    {"E'", "in some books 2 E*, 2/E' = (1-nu^2)/E0 + (1-nu_2^2)/E0_2; try: help Estar"},
    {"stress",
     "p(r) and qx(r) on the surface; inside, k = 0, sxx(x, y, z), mises and others; try: help cracking"},
    {"cylinder",
     "line contact is not axisymmetric and cannot be computed; a flat end is geometry flat b=..."},
    {"torsion", "torsion is not computed: the load is FN and Fx"},
    {"print", "a value is printed by its name or expression: a, dz in um"},
    {"clear", "`reset` forgets the load, `reset all` the inputs too"},
    {"lessons", "`show demos` lists them, `help lessons` tells how to write one"},
    {"redo", "there is no redo; the arrow keys bring statements back"},
    {"adhesion", "it is not computed; try: help limits"},
    {"mismatch", "the warning on dissimilar bodies gives it; try: help limits"},
};
enum { LEADS = sizeof leads / sizeof *leads };

const char *hint_name(size_t i) {
    return i < LEADS ? leads[i].word : NULL;
}

const char *hint_text(size_t i) {
    return leads[i].answer;
}

const char *hint_from(const char *word) {
    for (size_t i = 0; i < LEADS; i++)
        if (!strcmp(word, leads[i].word))
            return leads[i].answer;
    return NULL;
}

/* The dimension of a quantity, perhaps "... within the cycle", or of an argument of a function. */
static dim dimension_of(const calc *c, const char *name) {
    const quantity *q = quantity_find(name, strcspn(name, " "));
    if (q)
        return quantity_dim(q, &c->scene);
    for (size_t i = 0; (q = quantity_row(i)); i++)
        if (q->argument && !strcmp(q->argument, name))
            return q->argument_d;
    return DIM_NONE;
}

void calc_amount(dim d, long double v, int digits, char *text, size_t size) {
    char unit_text[128] = "";
    long double scale = unit_choose(d, v, digits, unit_text, sizeof unit_text);
    snprintf(text, size, "%.*g%s%s", digits, (double)(v / scale), *unit_text ? " " : "", unit_text);
}

void calc_value_text(dim d, double v, char text[CALC_VALUE_TEXT]) {
    calc_amount(d, v, 6, text, CALC_VALUE_TEXT);
}

static void word_status(const calc *c, calc_error *error) {
    const fret_status *st = &error->status;
    const char *name = error->input >= 0 ? quantity_of_input((input)error->input)->name : st->quantity;
    const char *rule = fret_status_rule(st->code);
    char given[CALC_VALUE_TEXT], limit[CALC_VALUE_TEXT], *text = error->text;
    const size_t size = sizeof error->text;
    if (!name) {
        snprintf(text, size, "%s", rule);
        return;
    }
    const dim d = dimension_of(c, name);
    for (int digits = 6; digits <= 17; digits++) { /* as many digits as distinguish the two */
        calc_amount(d, st->value, digits, given, sizeof given);
        calc_amount(st->code == FRET_TABLE_SHORT ? DIM_LENGTH : d, st->limit, digits, limit, sizeof limit);
        if (strcmp(given, limit) || st->value == st->limit)
            break;
    }
    if (st->code == FRET_GROSS_SLIP)
        snprintf(text, size, "%s = %s exceeds mu*FN = %s: gross slip; %s to slide", name, given, limit,
                 strcmp(name, "FA") && strcmp(name, RUN_FX_OF_CYCLE) ? "step by displacement (dx=...)"
                                                                     : "cycle by displacement (dxA=...)");
    else if (st->code == FRET_TABLE_SHORT)
        snprintf(text, size, "%s = %s cannot be carried: the gap supports contact radii up to %s", name,
                 given, limit);
    else if (st->code == FRET_OUTSIDE && st->limit > 0)
        snprintf(text, size, "%s = %s %s (limit %s)", name, given, rule, limit);
    else if (st->code == FRET_NOT_MONOTONE && st->limit > 0)
        snprintf(text, size,
                 "%s = %s %s; at %s it has risen again, as by noise or rounding of rows: try "
                 "`geometry file FILE smooth`",
                 name, given, rule, limit);
    else
        snprintf(text, size, "%s = %s%s %s", name, given,
                 fret_status_category(st->code) >= FRET_CAT_NUMERIC ? ":" : "", rule);
}

static void word_missing(const calc *c, calc_error *error) {
    const input in = (input)error->input;
    const char *name = quantity_of_input(in)->name;
    const geometry *g = c->now->in.geometry;
    char *text = error->text;
    const size_t size = sizeof error->text;
    if (in == IN_E0_2 || in == IN_NU_2 || in == IN_G0_2) /* else as body 1 */
        snprintf(text, size, "the second body is rigid");
    else if (in == IN_NU && c->now->in.set[IN_ESTAR])
        snprintf(text, size, "nu is not set: Estar alone is enough for the normal contact only (nu = 0.3)");
    else if (in <= IN_NU || in == IN_G0)
        snprintf(text, size, "%s is not set: give the material first (material E0=210 GPa nu=0.3)", name);
    else if (in == IN_MU)
        snprintf(text, size, "mu is not set: give the friction first (friction 0.4)");
    else if (in == IN_C0)
        snprintf(text, size, "c0 is not set: E(z) = E0 (z/c0)^k needs it (c0 = 1 mm)");
    else if (in == IN_FN)
        snprintf(text, size, "there is no load yet: press first (press FN=100 N)");
    else if (INPUT_BIT(in) & INPUT_RIG)
        snprintf(text, size, "%s is not set: there is no rig (rig stiffness=80 N/um)", name);
    else if (in == IN_ALPHA_W)
        snprintf(text, size, "alpha_w is not set: give a wear law first (wear alpha=1e4 um^3/J)");
    else if (INPUT_BIT(in) & INPUT_STRESS)
        snprintf(text, size, "%s is not set (%s = 500 MPa)", name, name);
    else if (INPUT_BIT(in) & INPUT_CYCLE && c->now->end.cycles)
        snprintf(text, size, "%s is no amplitude of the last cycle, which was given by %s", name,
                 quantity_of_input(cycle_input(cycle_by(&c->now->in)))->name);
    else if (INPUT_BIT(in) & INPUT_CYCLE)
        snprintf(text, size, "%s: no cycle has been run yet (cycle FA=...)", name);
    else if (!g)
        snprintf(text, size, "%s is not set: give the geometry first (geometry sphere R=10 mm)", name);
    else if (geometry_takes(g, in))
        snprintf(text, size, "geometry %s was given by A, not by %s", g->name, name);
    else
        snprintf(text, size, "%s is no parameter of geometry %s", name, g->name);
}

void calc_word(const calc *c, calc_error *error) {
    if (!error->raised || error->worded)
        return;
    if (error->kind == ERROR_STATUS)
        word_status(c, error);
    else if (error->kind == ERROR_MISSING)
        word_missing(c, error);
    error->worded = true;
}

void calc_append(const calc *c, calc_error *error, const char *format, ...) {
    va_list args;
    calc_word(c, error);
    const size_t n = strlen(error->text);
    va_start(args, format);
    vsnprintf(error->text + n, sizeof error->text - n, format, args);
    va_end(args);
}
