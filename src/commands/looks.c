/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of looks, and measured points from files. Touches the panel only. */
#include "commands/looks.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "text/csv.h"

typedef bool look_read(shell *sh, const lexer *lx, const heard *h, plot_panel *p, looks *out);

static bool read_text(const lexer *lx, const heard *h, char **text) {
    free(*text);
    *text = strndup(lx->text + h->hole[0].at + 1, h->hole[0].len - 2);
    return *text || calc_no_memory(lx->error);
}

static bool read_title(shell *sh, const lexer *lx, const heard *h, plot_panel *p, looks *out) {
    (void)sh, (void)out;
    return read_text(lx, h, &p->title);
}

static bool read_xlabel(shell *sh, const lexer *lx, const heard *h, plot_panel *p, looks *out) {
    (void)sh, (void)out;
    return read_text(lx, h, &p->xlabel);
}

static bool read_ylabel(shell *sh, const lexer *lx, const heard *h, plot_panel *p, looks *out) {
    (void)sh, (void)out;
    return read_text(lx, h, &p->ylabel);
}

static bool read_limits(shell *sh, const lexer *lx, const heard *h, plot_panel *p, looks *out) {
    limits *l = *h->of->name == 'x' ? &out->x : &out->y;
    lexer own = hole_lexer(lx, &h->hole[0]);
    (void)p;
    l->at = own.at;
    if (!expr_value(&sh->calc, &own, &l->end[0]))
        return false;
    if (own.kind != T_RANGE)
        return lex_fail(&own, "expected %s LO .. HI", h->of->name);
    lex_next(&own);
    if (!expr_value(&sh->calc, &own, &l->end[1]))
        return false;
    l->len = own.last - l->at;
    l->given = true;
    return at_end(&own);
}

/* x, y or both, as its choice is. */
enum { AXIS_X, AXIS_Y, AXIS_BOTH };

static bool read_log(shell *sh, const lexer *lx, const heard *h, plot_panel *p, looks *out) {
    (void)sh, (void)lx, (void)out;
    p->logx = p->logx || (h->of->holes && h->choice != AXIS_Y); /* without an axis it is of the range */
    p->logy = p->logy || (h->of->holes && h->choice != AXIS_X);
    return true;
}

static bool read_flip(shell *sh, const lexer *lx, const heard *h, plot_panel *p, looks *out) {
    (void)sh, (void)lx, (void)out;
    p->flipx = p->flipx || h->choice != AXIS_Y;
    p->flipy = p->flipy || h->choice != AXIS_X;
    return true;
}

static bool read_key(shell *sh, const lexer *lx, const heard *h, plot_panel *p, looks *out) {
    (void)sh, (void)lx, (void)h, (void)out;
    p->key_off = true;
    return true;
}

static bool read_points(shell *sh, const lexer *lx, const heard *h, plot_panel *p, looks *out) {
    (void)sh, (void)lx, (void)h, (void)out;
    p->points = true;
    return true;
}

static bool read_over(shell *sh, const lexer *lx, const heard *h, plot_panel *p, looks *out) {
    (void)sh, (void)p;
    if (out->files == OVER)
        return calc_fail(lx->error, h->hole[0].at, h->hole[0].len, "more than %d files", OVER);
    const size_t i = out->files++;
    out->over_at[i] = h->hole[0].at;
    out->over_len[i] = h->hole[0].len;
    return hole_file(lx, &h->hole[0], out->over[i]);
}

static const struct {
    const char *name;
    look_read *read;
} rows[] = {{"title", read_title},   {"xlabel", read_xlabel}, {"ylabel", read_ylabel},
            {"xrange", read_limits}, {"yrange", read_limits}, {"log", read_log},
            {"flip", read_flip},     {"key", read_key},       {"points", read_points},
            {"over", read_over}};
enum { ROWS = sizeof rows / sizeof *rows };

bool looks_read(shell *sh, const lexer *lx, const said *all, plot_panel *p, looks *out) {
    for (const heard *h = all->list; h < all->list + all->count; h++)
        for (size_t i = 0; i < ROWS; i++)
            if (!strcmp(h->of->name, rows[i].name) && !rows[i].read(sh, lx, h, p, out))
                return false;
    return true;
}

/* ---- measured points --------------------------------------------------------------------------- */

/* Does the column bear a name of the axis: `dW` of dW(F), `c` of a, c? */
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

static const csv_values *column_named(const csv *c, const axis_of *axis) {
    for (size_t i = 0; i < c->columns; i++)
        if (is_named(&c->column[i], axis))
            return &c->column[i];
    return NULL;
}

static bool is_quantity(const csv_values *v) {
    return quantity_find(v->name, strlen(v->name)) != NULL;
}

/* The only column but one of the axis' dimension that is not called after something else. */
static const csv_values *column_for(const csv *c, const axis_of *axis, const csv_values *but,
                                    calc_error *error) {
    const csv_values *one = NULL, *other = NULL;
    char wants[128], names[CALC_ERROR_TEXT / 2] = "";
    size_t n = 0, fit = 0;
    for (size_t i = 0; i < c->columns; i++) {
        const csv_values *v = &c->column[i];
        if (v == but || !dim_equal(v->d, axis->d) || (v->trouble && !v->has_unit))
            continue;
        if (is_quantity(v)) {
            other = v;
            continue;
        }
        one = v;
        if (n < sizeof names)
            n += (size_t)snprintf(names + n, sizeof names - n, "%s%s", fit ? ", " : "", v->name);
        fit++;
    }
    if (fit == 1)
        return one;
    dim_describe(axis->d, wants, sizeof wants);
    if (fit) {
        calc_fail(error, 0, 0,
                  "several columns fit the axis %.60s, which is %s: %s; give one of them its name",
                  axis->name, wants, names);
        return NULL;
    }
    csv_names(c, names, sizeof names);
    calc_fail(
        error, 0, 0,
        "no column fits the axis %.60s, which is %s: there are %s; their units stand in the header%s%s%s",
        axis->name, wants, names, other ? ", and " : "", other ? other->name : "",
        other ? " is the name of another quantity" : "");
    return NULL;
}

/* Is it whole, and of the axis' dimension? */
static bool is_fit(const csv *c, const csv_values *v, const axis_of *axis, calc_error *error) {
    char wants[128], is[128];
    if (!v || !csv_column(c, v->name, error) || dim_equal(v->d, axis->d))
        return !error->raised;
    dim_describe(axis->d, wants, sizeof wants);
    dim_describe(v->d, is, sizeof is);
    return calc_fail(error, 0, 0, "column %s is %s: it needs the unit of %s in the header", v->name, is,
                     wants);
}

/* Names come first. */
static bool find_columns(const csv *c, const axis_of *x, const axis_of *y, const csv_values **of_x,
                         const csv_values **of_y, calc_error *error) {
    *of_x = column_named(c, x);
    *of_y = column_named(c, y);
    *of_x = *of_x ? *of_x : column_for(c, x, *of_y, error);
    *of_y = *of_y || !*of_x ? *of_y : column_for(c, y, *of_x, error);
    return !error->raised && is_fit(c, *of_x, x, error) && is_fit(c, *of_y, y, error);
}

static bool lay_file(lexer *lx, const looks *l, size_t i, plot_panel *p, const axis_of *x, const axis_of *y) {
    csv c;
    const csv_values *of_x, *of_y;
    const char *slash = strrchr(l->over[i], '/');
    bool ok =
        csv_read(l->over[i], &shell_stop, &c, lx->error) && find_columns(&c, x, y, &of_x, &of_y, lx->error);
    if (!ok)
        calc_place(lx->error, l->over_at[i], l->over_len[i]);
    plot_series *s = ok ? plot_series_add(p, PLOT_MEASURED, slash ? slash + 1 : l->over[i], lx->error) : NULL;
    for (size_t j = 0; s && ok && j < c.rows; j++)
        ok = plot_point(s, of_x->v[j], of_y->v[j]) || calc_no_memory(lx->error);
    csv_free(&c);
    return ok && s;
}

bool looks_lay_over(lexer *lx, const looks *l, plot_panel *p, const axis_of *x, const axis_of *y) {
    for (size_t i = 0; i < l->files; i++)
        if (!lay_file(lx, l, i, p, x, y))
            return false;
    return true;
}

/* ---- limits ------------------------------------------------------------------------------------ */

bool looks_limit(lexer *lx, const looks *l, plot_panel *p, bool x_axis, const axis_of *axis,
                 long double scale) {
    const limits *given = x_axis ? &l->x : &l->y;
    for (int i = 0; given->given && i < 2; i++) {
        if (!value_dim(lx, x_axis ? "xrange" : "yrange", given->at, given->len, given->end[i], axis->d))
            return false;
        const double v = (double)(given->end[i].v / scale);
        *(x_axis ? i ? &p->xhi : &p->xlo : i ? &p->yhi : &p->ylo) = v;
    }
    return true;
}
