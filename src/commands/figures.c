/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of figures, and those that no sweep can draw. */
#include "commands/figures.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "commands/accuracy_command.h"
#include "commands/range.h"
#include "number/array.h"
#include "statement/command.h"

static bool figure_regimes(shell *sh, lexer *lx, said *all, plot_panel *p, const looks *l);

static const figure figures[] = {
    {.name = "loop",
     .title = "hysteresis loop",
     .summary = "Fx against dx along the load program",
     .statement = "Fx against dx along program"},
    {.name = "pressure",
     .title = "contact pressure",
     .summary = "p(r)",
     .statement = "p(r) for r = 0 m .. 1.25*a"},
    {.name = "traction",
     .title = "tangential traction between its bounds",
     .summary = "qx(r) between mu p(r) and its negative",
     .statement = "qx(r), mu*p(r), -mu*p(r) for r = 0 m .. 1.25*a",
     .roles = "cbb"},
    {.name = "springs",
     .title = "springs between their bounds",
     .summary = "u1D(x) between its bounds, stick and slip told apart",
     .statement = "u1D(x), mu*eta*w1D(x), -mu*eta*w1D(x) for x = -1.25*a .. 1.25*a",
     .roles = "sbb"},
    {.name = "dissipation",
     .title = "energy dissipated per cycle",
     .summary = "dW against the amplitude, up to gross slip",
     .statement = "dW(F_A) for F_A = 0 N .. mu*FN"},
    {.name = "load",
     .title = "load path",
     .summary = "Fx against FN between the limits of friction",
     .statement = "Fx, mu*FN, -mu*FN against FN along program",
     .roles = "ctt"},
    {.name = "gap",
     .title = "gap f and equivalent profile g",
     .summary = "f(r) and g(r)",
     .statement = "f(r), g(r) for r = 0 m .. 1.25*a"},
    {.name = "E",
     .title = "modulus over depth",
     .summary = "E(z)/E0, the depth downward",
     .statement = "z/c0 against E(z)/E0 for z = 0 m .. 2*c0 flip y xrange 0 .. 2.5",
     .without_c0 = "z against E(z)/E0 for z = 0 mm .. 1 mm flip y xrange 0 .. 2.5"},
    {.name = "regimes",
     .title = "running conditions",
     .summary = "stick (of flat ends alone), partial and gross slip: for dxA = .. for FN = ..",
     .takes = "RANGE LOOK [frames N:1000] [to FILE]",
     .build = figure_regimes},
    {.name = "accuracy",
     .title = "error against time",
     .summary = "of every model, for this scene",
     .takes = "[FA=20 N | dxA=0.5 um] [within SECONDS:3600] LOOK [frames N:1000] [to FILE]",
     .build = figure_accuracy},
};
enum { FIGURES = sizeof figures / sizeof *figures };

const figure *figure_row(size_t i) {
    return i < FIGURES ? &figures[i] : NULL;
}

const char *figure_name(size_t i) {
    return i < FIGURES ? figures[i].name : NULL;
}

const char *figure_word(size_t i) {
    return i == FIGURES ? "map" : figure_name(i);
}

const figure *figure_find(const char *name, size_t len) {
    size_t i;
    return word_among(figure_name, name, len, &i) ? &figures[i] : NULL;
}

const grammar *figure_form(size_t i) {
    static grammar forms[FIGURES];
    return grammar_made(&forms[i], "plot", figures[i].name,
                        figures[i].takes ? figures[i].takes : "RANGE LOOK [to FILE]");
}

/* ---- running conditions ------------------------------------------------------------------------- */

/* The amplitude where so much still sticks, over the other name: delta = mu eta (g(a) - g(c)). At c = a a
 * flat end has a jump of g, and so a range where all sticks. */
static const struct {
    const char *amplitude, *title;
    bool thin;
} borders[] = {{"mu*eta*(dz - g(a))", "c = a", false},
               {"mu*eta*(dz - g(a/2))", "c = a/2", true},
               {"dxmax", "c = 0", false}};
enum { STICK, HALF, GROSS, BORDERS };

/* Of a region the left border and the right one; past the last the end of the amplitudes. */
static const struct {
    const char *name;
    int left, right, style; /* blue, yellow and gray, which the colour-blind tell apart */
} regions[] = {{"stick", -1, STICK, 0}, {"partial slip", STICK, GROSS, 4}, {"gross slip", GROSS, BORDERS, 6}};
enum { REGIONS = sizeof regions / sizeof *regions };

typedef struct regimes {
    size_t count, room;
    double (*row)[1 + BORDERS]; /* the other name, then the amplitudes */
    double lo, hi;              /* of amplitudes */
    bool across;                /* these are the ordinate */
    bool log;
} regimes;

static bool take_borders(void *context, const sweep *s, size_t curve, long double x,
                         const long double *values) {
    regimes *r = context;
    double(*grown)[1 + BORDERS] = fret_array_for(r->row, &r->room, r->count + 1, sizeof *r->row);
    (void)s, (void)curve;
    if (!grown)
        return false;
    r->row = grown;
    r->row[r->count][0] = (double)x;
    for (int i = 0; i < BORDERS; i++)
        r->row[r->count][1 + i] = (double)values[i];
    r->count++;
    return true;
}

static double amplitude_at(const regimes *r, size_t i, int border) {
    const double at = border < 0 ? r->lo : border == BORDERS ? r->hi : r->row[i][1 + border];
    return fmin(fmax(at, r->lo), r->hi);
}

static bool add_place(const regimes *r, plot_series *s, size_t i, double amplitude) {
    const double other = r->row[i][0];
    return plot_point(s, r->across ? other : amplitude, r->across ? amplitude : other);
}

static double part_of(const regimes *r, double amplitude) {
    return r->log ? log(amplitude / r->lo) / log(r->hi / r->lo) : (amplitude - r->lo) / (r->hi - r->lo);
}

/* The area, and its name where it is widest. */
static bool add_region(const regimes *r, plot_panel *p, int region, calc_error *error) {
    const int left = regions[region].left, right = regions[region].right;
    double widest = 0.01, at[2] = {0, 0};
    for (size_t i = r->count / 8; i < r->count - r->count / 8; i++) {
        const double from = part_of(r, amplitude_at(r, i, left)), to = part_of(r, amplitude_at(r, i, right));
        if (to - from > 1.001 * widest) {
            widest = to - from;
            at[0] = (from + to) / 2;
            at[1] = (double)i / (double)(r->count - 1);
        }
    }
    if (widest <= 0.01)
        return true;
    plot_series *s = plot_series_add(p, PLOT_BAND, NULL, error);
    bool ok = s != NULL;
    for (size_t i = 0; ok && i < r->count; i++)
        ok = add_place(r, s, i, amplitude_at(r, i, left));
    for (size_t i = r->count; ok && i > 0; i--)
        ok = add_place(r, s, i - 1, amplitude_at(r, i - 1, right));
    if (!ok)
        return calc_no_memory(error);
    s->style = regions[region].style;
    p->word[p->words].text = regions[region].name;
    for (int axis = 0; axis < 2; axis++) {
        const double part = at[r->across ? !axis : axis];
        p->word[p->words].at[axis] = (axis ? p->flipy : p->flipx) ? 1 - part : part;
    }
    p->words++;
    return true;
}

static bool add_border(const regimes *r, plot_panel *p, int border, calc_error *error) {
    plot_series *s = plot_series_add(p, PLOT_CURVE, borders[border].title, error);
    if (!s)
        return false;
    s->thin = borders[border].thin;
    for (size_t i = 0; i < r->count; i++)
        if (!add_place(r, s, i, r->row[i][1 + border]))
            return calc_no_memory(error);
    return true;
}

/* Places in the formulas mean nothing in the statement. */
static bool run_borders(shell *sh, range *over, regimes *r, calc_error *error) {
    column columns[BORDERS];
    calc_error mine;
    found f;
    bool ok = true;
    error_clear(&mine);
    for (int i = 0; i < BORDERS && ok; i++) {
        lexer lx;
        lex_start(&lx, borders[i].amplitude, strlen(borders[i].amplitude), &mine);
        columns[i] = (column){.scale = 1};
        ok = expr_parse(&sh->calc, &lx, &sh->list[i]);
    }
    over->sweep.refine = !over->sweep.steps;
    over->sweep.steps = over->sweep.steps ? over->sweep.steps : 100;
    sweep_job job = range_job(sh, columns, BORDERS, &f, take_borders, r, &mine);
    ok = ok && sweep_run(&over->sweep, &job);
    if (ok)
        note_missing(sh, &job);
    if (mine.raised)
        calc_fail(error, 0, 0, "%s", mine.text);
    return ok || calc_no_memory(error);
}

static bool is_amplitude(const lexer *lx, const heard *by) {
    const lexer name = hole_lexer(lx, &by->hole[0]);
    return lex_is(&name, "dxA");
}

/* An axis with its ends: the points come in SI. */
static bool finish_axis(lexer *lx, const looks *l, plot_panel *p, bool x_axis, const knob *k,
                        const sweep_range *ends) {
    const axis_of axis = {k->text, k->d};
    const axis_unit u = axis_unit_for(NULL, k->d, fmax(fabs((double)ends->lo), fabs((double)ends->hi)));
    looks_divide(p, x_axis, u.scale);
    *(x_axis ? &p->xlo : &p->ylo) = (double)(ends->lo / u.scale);
    *(x_axis ? &p->xhi : &p->yhi) = (double)(ends->hi / u.scale);
    return looks_axis(lx, l, p, x_axis, &axis, &u);
}

/* Where all sticks, its rim slips, or all slips, over the amplitude of displacement and an input. */
static bool figure_regimes(shell *sh, lexer *lx, said *all, plot_panel *p, const looks *l) {
    range r[2];
    sweep_range ends[2] = {{.lo = 0}, {.lo = 0}};
    const heard *first = said_of(all, "for", 0), *second = said_of(all, "for", 1);
    if (!first || !second || said_of(all, "for", 2) || said_of(all, "with", 0) || said_of(all, "along", 0) ||
        is_amplitude(lx, first) == is_amplitude(lx, second))
        return calc_fail(lx->error, 0, 0,
                         "regimes go for dxA = LO .. HI for NAME = LO .. HI, such as for FN = 1 N .. 9 N");
    const bool across = is_amplitude(lx, second);
    for (size_t i = 0; i < 2; i++)
        if (!range_read_name(sh, lx, all, i, i != across, &r[i]) ||
            !range_options(sh, lx, all, i, &r[i], 0) || !r[i].sweep.range(&r[i].sweep, &ends[i], lx->error))
            return false;
    for (size_t i = 0; i < 2; i++)
        if (!(ends[i].lo < ends[i].hi))
            return calc_fail(lx->error, r[i].own.at, r[i].own.end - r[i].own.at,
                             "an empty range: LO must be below HI");
    p->logx = p->logx || r[0].sweep.log;
    p->logy = p->logy || r[1].sweep.log;
    regimes drawn = {.across = across,
                     .lo = (double)ends[across].lo,
                     .hi = (double)ends[across].hi,
                     .log = across ? p->logy : p->logx};
    bool ok = run_borders(sh, &r[!across], &drawn, lx->error);
    for (int i = 0; ok && i < REGIONS; i++)
        ok = add_region(&drawn, p, i, lx->error);
    const bool sticks = p->words && !strcmp(p->word[0].text, regions[STICK].name);
    for (int i = sticks ? STICK : HALF; ok && i < BORDERS; i++)
        ok = add_border(&drawn, p, i, lx->error);
    free(drawn.row);
    const axis_of x = {r[0].sweep.var.text, r[0].sweep.var.d}, y = {r[1].sweep.var.text, r[1].sweep.var.d};
    p->title = p->title ? p->title : strdup("running conditions");
    if (ok && !p->title)
        return calc_no_memory(lx->error);
    return ok && looks_lay_over(lx, l, p, &x, &y) && finish_axis(lx, l, p, true, &r[0].sweep.var, &ends[0]) &&
           finish_axis(lx, l, p, false, &r[1].sweep.var, &ends[1]);
}

/* Error against time, one curve a model. */
bool figure_accuracy(shell *sh, lexer *lx, said *all, plot_panel *p, const looks *l) {
    static const axis_of time = {.name = "time of a cycle [s]"}, loss = {.name = "relative error"};
    static const axis_unit plain = {.scale = 1};
    accuracy_study study;
    char text[400], load[360];
    plot_series *series = NULL;
    if (!accuracy_study_run(sh, all, &study, lx->error))
        return false;
    for (size_t i = 0; i < study.count; i++) {
        const accuracy_row *row = &study.row[i];
        if (i == 0 || row->family != row[-1].family)
            series = plot_series_add(p, PLOT_CURVE, families[row->family].name, lx->error);
        if (!series)
            return false;
        if (!plot_point(series, row->seconds, (double)row->error))
            return calc_no_memory(lx->error);
    }
    accuracy_load_text(sh, &study, load, sizeof load);
    snprintf(text, sizeof text, PLOT_EXPR "dW, %s" PLOT_END, load);
    p->title = p->title ? p->title : strdup(text);
    p->xlabel = p->xlabel ? p->xlabel : strdup(time.name);
    p->ylabel = p->ylabel ? p->ylabel : strdup(loss.name);
    if (!p->title || !p->xlabel || !p->ylabel)
        return calc_no_memory(lx->error);
    p->logx = p->logy = p->points = p->airy = true;
    return looks_lay_over(lx, l, p, &time, &loss) && looks_axis(lx, l, p, true, &time, &plain) &&
           looks_axis(lx, l, p, false, &loss, &plain);
}
