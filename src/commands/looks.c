/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of looks, measured points from files, and the units of axes. Changes the panel given. */
#include "commands/looks.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Arguments of a function that applies one look. */
typedef struct reading {
    shell *sh;
    const lexer *lx;
    const parsed *all;
    const given_clause *given; /* the clause */
    plot_panel *p;
    size_t at; /* offset in *p of the member to set */
    looks *out;
} reading;

static void *member(const reading *r) {
    return (char *)r->p + r->at;
}

static bool read_text(const reading *r) {
    char **text = member(r);
    free(*text);
    *text = hole_text(r->lx, &r->given->hole[0]);
    return *text;
}

static bool read_flag(const reading *r) {
    *(bool *)member(r) = true;
    return true;
}

static bool read_limits(const reading *r) {
    limits *l = *r->given->of->name == 'x' ? &r->out->x : &r->out->y;
    lexer own = hole_lexer(r->lx, &r->given->hole[0]);
    l->at = own.at;
    if (!expr_value(&r->sh->calc, &own, &l->end[0]))
        return false;
    if (own.kind != T_RANGE)
        return lex_fail(&own, "expected %s LO .. HI", r->given->of->name);
    lex_next(&own);
    if (!expr_value(&r->sh->calc, &own, &l->end[1]))
        return false;
    l->len = own.last - l->at;
    l->given = true;
    return at_end(&own);
}

enum { AXIS_X, AXIS_Y, AXIS_BOTH };

const char *axes_name(size_t i) {
    static const char *const names[] = {"x", "y", "xy"};
    return i <= AXIS_BOTH ? names[i] : NULL;
}

static bool read_log(const reading *r) {
    r->p->logx = r->p->logx || r->given->choice != AXIS_Y;
    r->p->logy = r->p->logy || r->given->choice != AXIS_X;
    return true;
}

static bool read_flip(const reading *r) {
    r->p->flipx = r->p->flipx || r->given->choice != AXIS_Y;
    r->p->flipy = r->p->flipy || r->given->choice != AXIS_X;
    return true;
}

static bool read_over(const reading *r) {
    const span *name = &r->given->hole[0];
    looks *l = r->out;
    if (l->files == OVER)
        return calc_fail(r->lx->error, name->at, name->len, "more than %d files", OVER);
    l->over[l->files++] = r->given;
    return true;
}

static bool read_residuals(const reading *r) {
    r->out->residuals = true;
    return true;
}

/* Only checked here: columns_read applies it with its file. */
static bool read_using(const reading *r) {
    return columns_placed(r->all, r->lx->error);
}

static const struct {
    const char *line; /* grammar, see grammar.h */
    bool (*read)(const reading *r);
    size_t at; /* offset in plot_panel of the member that it sets */
} rows[] = {{"[title TEXT]*", read_text, offsetof(plot_panel, title)},
            {"[xlabel TEXT]*", read_text, offsetof(plot_panel, xlabel)},
            {"[ylabel TEXT]*", read_text, offsetof(plot_panel, ylabel)},
            {"[xrange LO .. HI]*", read_limits, 0},
            {"[yrange LO .. HI]*", read_limits, 0},
            {"[log AXES]*", read_log, 0},
            {"[flip AXES]*", read_flip, 0},
            {"[key OFF]*", read_flag, offsetof(plot_panel, key_off)},
            {"[points]*", read_flag, offsetof(plot_panel, points)},
            {"[over FILE]*", read_over, 0},
            {"[residuals]*", read_residuals, 0},
            {"[using NAME = COLUMN, ...]*", read_using, 0}};
enum { ROWS = sizeof rows / sizeof *rows };

const char *look_line(size_t i) {
    return i < ROWS ? rows[i].line : NULL;
}

bool looks_read(shell *sh, const lexer *lx, const parsed *all, plot_panel *p, looks *out) {
    out->sh = sh;
    out->all = all;
    for (const given_clause *h = all->list; h < all->list + all->count; h++)
        for (size_t i = 0; i < ROWS; i++)
            if (h->of->text == rows[i].line + 1 &&
                !rows[i].read(&(reading){sh, lx, all, h, p, rows[i].at, out}))
                return false;
    return true;
}

/* ---- measured points --------------------------------------------------------------------------- */

/* Has the column the name of one of the axis' expressions: `dW` for dW(F), `c` for "a, c"? */
static bool is_named(const csv_values *v, const axis_of *axis) {
    const size_t n = strlen(v->name);
    const char *next;
    for (const char *at = axis->name; n && at; at = next ? next + 2 : NULL) {
        const char *end = at + n;
        next = strstr(at, ", ");
        if (strncmp(at, v->name, n))
            continue;
        if (*end == '(')
            end += strcspn(end, ")") + 1;
        if (!*end || *end == ',')
            return true;
    }
    return false;
}

static csv_values *column_named(csv *c, const axis_of *axis) {
    for (size_t i = 0; i < c->columns; i++)
        if (is_named(&c->column[i], axis))
            return &c->column[i];
    return NULL;
}

/* The column for an axis, read: the one of its name, else of its dimension, see columns_take. */
static csv_values *take_column(csv *c, const axis_of *axis, calc_error *error) {
    const csv_values *named = column_named(c, axis);
    char name[CSV_NAME];
    const size_t word = strcspn(axis->name, "(,"); /* `dW` of dW(F) */
    snprintf(name, sizeof name, "%.*s", (int)word, axis->name);
    return columns_take(c, named ? named->name : name, axis->d, error);
}

const csv_values *looks_column(csv *c, const axis_of *axis, bool alone, calc_error *error) {
    char names[CSV_NAME];
    size_t count;
    if (column_named(c, axis))
        return take_column(c, axis, error);
    csv_values *one = alone ? column_of_dim(c, axis->d, names, sizeof names, &count) : NULL;
    return one && *one->name && csv_load(c, one, error) ? one : NULL;
}

/* The columns of both axes: first the one found by name, so that dimension can tell the other. */
static bool find_columns(csv *c, const axis_of *x, const axis_of *y, csv_values **of_x, csv_values **of_y,
                         calc_error *error) {
    const bool y_first = column_named(c, y);
    csv_values **first = y_first ? of_y : of_x, **second = y_first ? of_x : of_y;
    *first = take_column(c, y_first ? y : x, error);
    *second = *first ? take_column(c, y_first ? x : y, error) : NULL;
    return *second && csv_settle(c, error);
}

static bool lay_file(lexer *lx, const looks *l, size_t file, plot_panel *p, const axis_of *x,
                     const axis_of *y) {
    const given_clause *of = l->over[file];
    csv c;
    csv_values *of_x, *of_y;
    bool ok = columns_read(lx, l->all, of, &c) && find_columns(&c, x, y, &of_x, &of_y, lx->error);
    if (!ok)
        given_place(lx->error, of);
    plot_series *s = ok ? plot_series_add(p, PLOT_MEASURED, columns_file(&c), lx->error) : NULL;
    for (size_t j = 0; s && ok && j < c.rows; j++)
        ok = plot_point(s, of_x->v[j], of_y->v[j]) || calc_no_memory(lx->error);
    if (ok && s)
        columns_say(l->sh, &c, "");
    csv_free(&c);
    return ok && s;
}

bool looks_lay_over(lexer *lx, const looks *l, plot_panel *p, const axis_of *x, const axis_of *y) {
    for (size_t i = 0; i < l->files; i++)
        if (!lay_file(lx, l, i, p, x, y))
            return false;
    return true;
}

/* ---- axes -------------------------------------------------------------------------------------- */

/* Calls `visit` with each number drawn along an axis. */
static void for_each(const plot_panel *p, bool x_axis, void (*visit)(double *v, void *context),
                     void *context) {
    for (size_t i = 0; i < p->count; i++) {
        const plot_series *s = p->series[i];
        for (size_t j = 0; j < s->count; j++) {
            visit(x_axis ? &s->x[j] : &s->y[j], context);
            if (!x_axis && s->y2)
                visit(&s->y2[j], context);
        }
    }
    for (size_t i = 0; i < (x_axis ? p->map.nx : p->map.ny); i++)
        visit(x_axis ? &p->map.x[i] : &p->map.y[i], context);
}

static void extend(double *v, void *context) {
    axis_extent *e = context;
    if (!isfinite(*v))
        return;
    e->lo = fmin(e->lo, *v);
    e->hi = fmax(e->hi, *v);
    e->least = *v > 0 ? fmin(e->least, *v) : e->least;
}

axis_extent looks_extent(const plot_panel *p, bool x_axis) {
    axis_extent e = {INFINITY, -INFINITY, INFINITY};
    for_each(p, x_axis, extend, &e);
    return e;
}

static void divide(double *v, void *context) {
    *v = (double)(*v / *(const long double *)context);
}

/* The value that the unit should suit: the largest, on a logarithmic axis the geometric mean of the ends. */
static double typical(const plot_panel *p, bool x_axis) {
    const double lo = fabs(x_axis ? p->xlo : p->ylo), hi = fabs(x_axis ? p->xhi : p->yhi);
    const bool given = isfinite(lo) && isfinite(hi);
    const axis_extent e = looks_extent(p, x_axis);
    const double most = given         ? fmax(lo, hi)
                        : e.lo > e.hi ? 0
                                      : fmax(fabs(e.lo), fabs(e.hi)),
                 least = given ? fmin(lo, hi) : e.least;
    return (x_axis ? p->logx : p->logy) && least > 0 && least < most ? sqrt(least) * sqrt(most) : most;
}

axis_unit axis_unit_for(const column *c, dim d, double size) {
    axis_unit u;
    column own = c ? *c : (column){.row = NULL};
    own.d = d;
    u.scale = column_unit(&own, size, 6, u.text);
    return u;
}

bool looks_axis(lexer *lx, const looks *l, plot_panel *p, bool x_axis, const axis_of *axis) {
    const limits *given = x_axis ? &l->x : &l->y;
    char **label = x_axis ? &p->xlabel : &p->ylabel;
    double *end[] = {x_axis ? &p->xlo : &p->ylo, x_axis ? &p->xhi : &p->yhi};
    axis_unit own = {.scale = 0}, *u = axis->unit ? axis->unit : &own;
    for (int i = 0; given->given && i < 2; i++) {
        if (!value_dim(lx, x_axis ? "xrange" : "yrange", given->at, given->len, given->end[i], axis->d))
            return false;
        *end[i] = (double)given->end[i].v;
    }
    if (u->scale == 0)
        *u = axis_unit_for(axis->like, axis->d, typical(p, x_axis));
    for_each(p, x_axis, divide, &u->scale);
    for (int i = 0; i < 2; i++)
        divide(end[i], &u->scale);
    if (!*label)
        *label = plot_label(axis->name, u->text);
    return *label || calc_no_memory(lx->error);
}
