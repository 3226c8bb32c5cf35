/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads and runs maps, and puts their values into a panel as contours. */
#include "commands/map.h"

#include <math.h>
#include <string.h>

enum { MAP_STEPS = 60 };

bool grid_range_read(shell *sh, lexer *lx, parsed *all, grid_range *out, size_t steps_a, size_t steps_b) {
    const given_clause *with = parsed_clause(all, "with", 0), *second = parsed_clause(all, "for", 1),
                       *third = parsed_clause(all, "for", 2);
    if (!range_read(sh, lx, all, 0, &out->a) || !range_options(sh, lx, all, 0, &out->a, steps_a))
        return false;
    if (out->a.sweep.along)
        return lex_fail(lx, "a map needs two ranges: for A = LO .. HI for B = LO .. HI");
    if (with)
        return calc_fail(lx->error, with->at, with->len,
                         "a map has no curves: `with` does not go with two ranges");
    if (!second)
        return lex_fail(lx, "expected for B = LO .. HI");
    if (third)
        return calc_fail(lx->error, third->at, third->len,
                         "a map needs two ranges: for A = LO .. HI for B = LO .. HI");
    if (!range_read(sh, lx, all, 1, &out->b) || !range_options(sh, lx, all, 1, &out->b, steps_b))
        return false;
    if (!knob_apart(&out->a.sweep.var, &out->b.sweep.var, second->at, second->len, lx->error))
        return false;
    sweep *s = &out->a.sweep;
    s->across = &out->b.sweep;
    s->with = s->across->var;
    s->curves = s->across->steps + 1;
    return s->across->range(s->across, &s->ends, lx->error);
}

bool map_at(const lexer *lx) {
    const token_kind next = lex_peek(lx);
    return lex_is(lx, "map") && (next == T_NAME || next == T_NUMBER || next == T_OPEN || next == T_MINUS);
}

static double largest(const long double *v, size_t n) {
    double most = 0;
    for (size_t i = 0; i < n; i++)
        if (isfinite(v[i]))
            most = fmax(most, fabs((double)v[i]));
    return most;
}

static void copy_scaled(double *to, const long double *v, size_t n, long double scale) {
    for (size_t i = 0; i < n; i++)
        to[i] = (double)(v[i] / scale);
}

/* In a map of the stress inside, over x or y and z: draws z downward, and the contact as a line. */
static bool show_body(shell *sh, const sweep *over, plot_panel *p, calc_error *error) {
    const char *x = over->var.text, *z = over->with.text;
    const plot_map *m = &p->map;
    const fret_press *press;
    const quantity *q;
    bool call, inside = false;
    size_t at;
    for (size_t i = 0; (q = expr_quantity(&sh->list[0], i, &call, &at)); i++)
        inside = inside || q->calls == CALL_STRESS;
    if (!inside || strcmp(z, "z") || (strcmp(x, "x") && strcmp(x, "y")))
        return true;
    p->flipy = true;
    if (m->y[0] * m->y[m->ny - 1] > 0 || !scene_press(sh->calc.now, &press, error_quiet()))
        return true;
    const double a = (double)press->a, lo = fmax(-a, fmin(m->x[0], m->x[m->nx - 1])),
                 hi = fmin(a, fmax(m->x[0], m->x[m->nx - 1]));
    plot_series *s = lo < hi ? plot_series_add(p, PLOT_CURVE, NULL, error) : NULL;
    return s ? (plot_point(s, lo, 0) && plot_point(s, hi, 0)) || calc_no_memory(error) : !error->raised;
}

static bool fill_map(shell *sh, lexer *lx, const sweep *s, const grid_values *of, const looks *l,
                     const column *c, dim d, plot_panel *p) {
    plot_map *m = &p->map;
    const axis_of x = {.name = s->var.text, .d = s->var.d}, y = {.name = s->with.text, .d = s->with.d};
    p->logx = p->logx || s->log;
    p->logy = p->logy || s->across->log;
    if (l->files)
        return calc_fail(lx->error, l->over[0]->hole[0].at, l->over[0]->hole[0].len,
                         "points cannot lie over a map");
    const axis_unit z = axis_unit_for(c, d, largest(of->v, m->nx * m->ny));
    copy_scaled(m->x, of->a, m->nx, 1);
    copy_scaled(m->y, of->b, m->ny, 1);
    copy_scaled(m->z, of->v, m->nx * m->ny, z.scale);
    m->label = plot_label(c->name, z.text);
    return (m->label || calc_no_memory(lx->error)) && show_body(sh, s, p, lx->error) &&
           looks_axis(lx, l, p, true, &x) && looks_axis(lx, l, p, false, &y);
}

static bool run_map(shell *sh, lexer *lx, const sweep *s, column *c, const looks *l, plot_panel *p) {
    found f;
    grid_values values;
    sweep_job sweeping = range_job(sh, c, 1, &f, NULL, NULL, lx->error);
    if (!plot_map_make(p, s->steps + 1, s->curves, lx->error))
        return false;
    const bool ok = grid_keep(s, &sweeping, &values) && fill_map(sh, lx, s, &values, l, c, f.d[0], p);
    grid_values_free(&values);
    if (ok)
        note_missing(sh, &sweeping);
    return ok;
}

bool map_read(shell *sh, lexer *lx, parsed *all, column *c, grid_range *r) {
    lexer own = hole_lexer(lx, &all->list[0].hole[0]);
    lex_next(&own);
    return read_one_expression(sh, &own, c) && grid_range_read(sh, lx, all, r, MAP_STEPS, MAP_STEPS);
}

bool map_draw(shell *sh, lexer *lx, parsed *all, plot_panel *p, const looks *l) {
    column c;
    grid_range r;
    const bool ok = map_read(sh, lx, all, &c, &r) && run_map(sh, lx, &r.a.sweep, &c, l, p);
    columns_free(&c, 1);
    return ok;
}
