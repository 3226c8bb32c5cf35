/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of figures, and the map of running conditions, which is drawn as areas. */
#include "commands/figures.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "commands/range.h"
#include "statement/command.h"

static bool figure_regimes(shell *sh, lexer *lx, parsed *all, plot_panel *p, const looks *l);

/* `when` of the figure E: the body is homogeneous, so there is no c0 to scale depth by. */
static bool lacks_c0(const inputs *in, bool compared) {
    const bool graded = !inputs_any(in, INPUT_MODULUS) || in->v[IN_K] != 0 || in->set[IN_C0];
    return !graded && !(in->bindings & (INPUT_BIT(IN_K) | INPUT_BIT(IN_C0))) && !compared;
}

/* `when` of the figure wear: nothing has worn yet (Nw is 0); the last cycle's wear is drawn instead. */
static bool is_unworn(const inputs *in, bool compared) {
    return !inputs_any(in, INPUT_BIT(IN_NW)) && !compared;
}

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
     .summary = "u1D(x) between its bounds, stick and slip marked",
     .statement = "u1D(x), mu*eta*w1D(x), -mu*eta*w1D(x) for x = -1.25*a .. 1.25*a",
     .roles = "sbb"},
    {.name = "slip",
     .title = "local slip",
     .summary = "slip(r), with c and a marked",
     .statement = "slip(r) for r = 0 m .. 1.25*a",
     .marks = "ca"},
    {.name = "wear",
     .title = "worn depth",
     .summary = "hwear(r) of Nw cycles, or dhwear(r) of the last one, with c and a marked",
     .statement = "hwear(r) for r = 0 m .. 1.25*a",
     .instead = "dhwear(r) for r = 0 m .. 1.25*a",
     .when = is_unworn,
     .marks = "ca"},
    {.name = "profile",
     .title = "worn profile",
     .summary = "the gap f(r), worn and unworn",
     .statement = "f(r), f(r)-hwear(r) for r = 0 m .. 1.5*a",
     .roles = "ct",
     .marks = "ca"},
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
     .instead = "z against E(z)/E0 for z = 0 mm .. 1 mm flip y xrange 0 .. 2.5",
     .when = lacks_c0},
    {.name = "regimes",
     .title = "running conditions",
     .summary = "stick (flat ends only), partial and gross slip: for dxA = .. for FN = ..",
     .takes = "RANGE LOOK [frames N:2..1000] [to FILE]",
     .build = figure_regimes},
    {.name = "fit",
     .title = "measured loop and fit",
     .summary = "the last fit: points and curve, residuals below",
     .takes = "LOOK [frames N:2..1000] [to FILE]",
     .build = figure_fit,
     .below = figure_fit_residuals},
    {.name = "accuracy",
     .title = "error against time",
     .summary = "error and time of every model, for this scene",
     .takes = "[FA=20 N | dxA=0.5 um] [within SECONDS:3600] LOOK [frames N:2..1000] [to FILE]",
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
    return i < FIGURES && figures[i].takes
               ? grammar_made("plot", figures[i].name, figures[i].takes, figures[i].title)
               : NULL;
}

/* ---- running conditions ------------------------------------------------------------------------- */

/* The borders are amplitudes of displacement at which the stick radius is c = a, a/2 and 0, as functions of
 * the other name: mu eta (dz - g(c)), and at the rig mu (FN - FN(g(c)))/K_rig more. At c = a that is 0, but
 * for flat ends, where dz > g(a): they stick fully below it. */
enum { STICK, HALF, GROSS, BORDERS, PLACES = 200 };
static const char *const amplitudes[] = {"dxA", "drigA"};
static const char *const borders[][BORDERS] = {{"mu*eta*(dz - g(a))", "mu*eta*(dz - g(a/2))", "dxmax"},
                                               {"mu*eta*(dz - g(a)) + mu*(FN - FN(g(a)))/K_rig",
                                                "mu*eta*(dz - g(a/2)) + mu*(FN - FN(g(a/2)))/K_rig",
                                                "dxmax + mu*FN/K_rig"}};
static const char *const titles[] = {"c = a", "c = a/2", "c = 0"};

/* Regions between two borders, or a border and an end of the range. Their styles are blue, yellow and grey,
 * which colour-blind readers can tell apart. */
static const struct {
    const char *name;
    int from, to, style; /* from -1: lower end of the range; to BORDERS: upper end */
} regions[] = {{"stick", -1, STICK, 0}, {"partial slip", STICK, GROSS, 4}, {"gross slip", GROSS, BORDERS, 6}};
enum { REGIONS = sizeof regions / sizeof *regions };

typedef struct regimes {
    plot_panel *p;
    sweep_range ends;         /* of the amplitude */
    bool rig, on_y, log;      /* the amplitude is drigA; is the ordinate; its axis is logarithmic */
    size_t count;             /* values of the other name so far */
    double other[PLACES + 1]; /* values of the other name */
    double amplitude[BORDERS][PLACES + 1]; /* the borders there */
    calc_error *error;
} regimes;

static bool take_borders(void *context, const sweep *s, size_t curve, long double x,
                         const long double *values) {
    regimes *r = context;
    (void)s, (void)curve;
    r->other[r->count] = (double)x;
    for (int i = 0; i < BORDERS; i++)
        r->amplitude[i][r->count] = (double)values[i];
    r->count++;
    return true;
}

/* The amplitude at a border or end (see regions), cut off at the ends of the range. */
static double amplitude_at(const regimes *r, int border, size_t i) {
    const double lo = (double)r->ends.lo, hi = (double)r->ends.hi;
    return border < 0 ? lo : border == BORDERS ? hi : fmin(fmax(r->amplitude[border][i], lo), hi);
}

static bool add_point(const regimes *r, plot_series *s, double amplitude, size_t i) {
    return plot_point(s, r->on_y ? r->other[i] : amplitude, r->on_y ? amplitude : r->other[i]) ||
           calc_no_memory(r->error);
}

/* Position of an amplitude along its axis, 0 to 1. */
static double part_of(const regimes *r, double amplitude) {
    const double lo = (double)r->ends.lo, hi = (double)r->ends.hi;
    return r->log ? log(amplitude / lo) / log(hi / lo) : (amplitude - lo) / (hi - lo);
}

/* Adds the area of a region, unless it is narrow, and its name where it is widest. */
static bool add_region(const regimes *r, int region) {
    const int from = regions[region].from, to = regions[region].to;
    double widest = 0.01, at[2] = {0, 0};
    for (size_t i = PLACES / 8; i <= PLACES - PLACES / 8; i++) {
        const double lo = part_of(r, amplitude_at(r, from, i)), hi = part_of(r, amplitude_at(r, to, i));
        if (!(hi - lo > 1.001 * widest))
            continue;
        widest = hi - lo;
        at[r->on_y] = (lo + hi) / 2;
        at[!r->on_y] = (double)i / (double)PLACES;
    }
    if (widest <= 0.01)
        return true;
    plot_series *s = plot_series_add(r->p, PLOT_BAND, NULL, r->error);
    bool ok = s != NULL;
    for (size_t i = 0; ok && i <= 2 * PLACES + 1; i++) /* forth along one border, back along the other */
        ok = i <= PLACES ? add_point(r, s, amplitude_at(r, from, i), i)
                         : add_point(r, s, amplitude_at(r, to, 2 * PLACES + 1 - i), 2 * PLACES + 1 - i);
    if (!ok)
        return false;
    s->style = regions[region].style;
    plot_word *word = &r->p->word[r->p->words++];
    *word =
        (plot_word){regions[region].name, {r->p->flipx ? 1 - at[0] : at[0], r->p->flipy ? 1 - at[1] : at[1]}};
    return true;
}

static bool draw_regimes(const regimes *r) {
    for (int i = 0; i < REGIONS; i++)
        if (!add_region(r, i))
            return false;
    const bool sticks = r->p->words && r->p->word[0].text == regions[STICK].name;
    for (int i = sticks ? STICK : HALF; i < BORDERS; i++) {
        plot_series *s = plot_series_add(r->p, PLOT_CURVE, titles[i], r->error);
        if (s)
            s->thin = i == HALF;
        for (size_t j = 0; j <= PLACES; j++)
            if (!s || !add_point(r, s, r->amplitude[i][j], j))
                return false;
    }
    return true;
}

/* Evaluates the borders over the range. An error within their formulas has no place in the statement. */
static bool run_borders(shell *sh, range *over, regimes *r) {
    const column columns[BORDERS] = {{.scale = 1}, {.scale = 1}, {.scale = 1}};
    calc_error mine = ERROR_NONE;
    found f;
    bool ok = true;
    for (int i = 0; i < BORDERS && ok; i++) {
        lexer lx;
        lex_start(&lx, borders[r->rig][i], strlen(borders[r->rig][i]), &mine);
        ok = expr_parse(&sh->calc, &lx, &sh->list[i]);
    }
    over->sweep.steps = PLACES;
    sweep_job job = range_job(sh, columns, BORDERS, &f, take_borders, r, &mine);
    ok = ok && sweep_run(&over->sweep, &job);
    if (ok)
        note_missing(sh, &job);
    if (mine.raised) {
        *r->error = mine;
        r->error->at = r->error->len = 0;
    }
    return ok;
}

/* The map of running conditions: full stick, partial and gross slip over the amplitude and an input. */
static bool figure_regimes(shell *sh, lexer *lx, parsed *all, plot_panel *p, const looks *l) {
    range r[2];
    sweep_range ends[2] = {{.lo = 0}, {.lo = 0}};
    axis_of axis[2];
    bool amplitude[2] = {false, false}, rig = false;
    for (size_t i = 0; i < 2 && parsed_clause(all, "for", i); i++) {
        const lexer name = hole_lexer(lx, &parsed_clause(all, "for", i)->hole[0]);
        rig = rig || lex_is(&name, amplitudes[1]);
        amplitude[i] = lex_is(&name, amplitudes[rig]);
    }
    if (amplitude[0] == amplitude[1] || !parsed_clause(all, "for", 1) || parsed_clause(all, "for", 2) ||
        parsed_clause(all, "with", 0) || parsed_clause(all, "along", 0) || parsed_clause(all, "steps", 0))
        return calc_fail(
            lx->error, 0, 0,
            "regimes needs two ranges: for dxA = LO .. HI for NAME = LO .. HI (for FN = 1 N .. 9 N)");
    for (size_t i = 0; i < 2; i++) {
        sweep *s = &r[i].sweep;
        if (!range_read_name(sh, lx, all, i, !amplitude[i], &r[i]) ||
            !range_options(sh, lx, all, i, &r[i], 0) || !s->range(s, &ends[i], lx->error))
            return false;
        if (r[i].listed || !(ends[i].lo < ends[i].hi))
            return calc_fail(lx->error, r[i].own.at, r[i].own.end - r[i].own.at,
                             "expected LO .. HI, LO below HI");
        axis[i] = (axis_of){.name = s->var.text, .d = s->var.d};
        *(i ? &p->ylo : &p->xlo) = (double)ends[i].lo;
        *(i ? &p->yhi : &p->xhi) = (double)ends[i].hi;
    }
    p->logx = p->logx || r[0].sweep.log;
    p->logy = p->logy || r[1].sweep.log;
    regimes drawn = {
        .rig = rig, .p = p, .ends = ends[amplitude[1]], .on_y = amplitude[1], .error = lx->error};
    drawn.log = drawn.on_y ? p->logy : p->logx;
    p->title = p->title ? p->title : strdup("running conditions");
    if (!p->title)
        return calc_no_memory(lx->error);
    return run_borders(sh, &r[amplitude[0]], &drawn) && draw_regimes(&drawn) &&
           looks_lay_over(lx, l, p, &axis[0], &axis[1]) && looks_axis(lx, l, p, true, &axis[0]) &&
           looks_axis(lx, l, p, false, &axis[1]);
}
