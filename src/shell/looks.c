/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of looks, and measured points from files. Touches the panel only. */
#include "shell/looks.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "calc/csv.h"

typedef struct look look;
struct look {
    const char *name;
    bool (*read)(shell *sh, lexer *lx, const look *self, plot_panel *p,
                 looks *out); /* the cursor behind the word */
    size_t at;                /* of the panel's text */
};

static bool read_text(shell *sh, lexer *lx, const look *self, plot_panel *p, looks *out) {
    (void)sh, (void)out;
    if (lx->kind != T_STRING)
        return lex_fail(lx, "expected %s \"TEXT\"", self->name);
    char **text = (char **)(void *)((char *)p + self->at);
    free(*text);
    *text = strndup(lx->text + lx->at + 1, lx->len - 2);
    lex_next(lx);
    return *text || calc_no_memory(lx->error);
}

static bool read_limits(shell *sh, lexer *lx, const look *self, plot_panel *p, looks *out) {
    (void)p;
    limits *l = *self->name == 'x' ? &out->x : &out->y;
    l->at = lx->at;
    if (!expr_value(&sh->calc, lx, &l->end[0]))
        return false;
    if (lx->kind != T_RANGE)
        return lex_fail(lx, "expected %s LO .. HI", self->name);
    lex_next(lx);
    if (!expr_value(&sh->calc, lx, &l->end[1]))
        return false;
    l->len = lx->last - l->at;
    l->given = true;
    return true;
}

/* x, y or both. */
static bool read_axes(lexer *lx, const look *self, bool *x, bool *y) {
    const bool both = lex_is(lx, "xy");
    if (!both && !lex_is(lx, "x") && !lex_is(lx, "y"))
        return lex_fail(lx, "expected %s x, %s y or %s xy", self->name, self->name, self->name);
    *x = *x || both || lex_is(lx, "x");
    *y = *y || both || lex_is(lx, "y");
    lex_next(lx);
    return true;
}

static bool read_log(shell *sh, lexer *lx, const look *self, plot_panel *p, looks *out) {
    (void)sh, (void)out;
    return read_axes(lx, self, &p->logx, &p->logy);
}

static bool read_flip(shell *sh, lexer *lx, const look *self, plot_panel *p, looks *out) {
    (void)sh, (void)out;
    return read_axes(lx, self, &p->flipx, &p->flipy);
}

static bool read_key(shell *sh, lexer *lx, const look *self, plot_panel *p, looks *out) {
    (void)sh, (void)out;
    p->key_off = lex_accept(lx, "off");
    return p->key_off || lex_fail(lx, "expected %s off", self->name);
}

static bool read_points(shell *sh, lexer *lx, const look *self, plot_panel *p, looks *out) {
    (void)sh, (void)out, (void)self;
    p->points = true;
    return !lx->error->raised;
}

static bool read_over(shell *sh, lexer *lx, const look *self, plot_panel *p, looks *out) {
    (void)sh, (void)self, (void)p;
    if (out->files == OVER)
        return lex_fail(lx, "more than %d files", OVER);
    const size_t i = out->files++;
    out->over_at[i] = lx->at;
    if (!lex_filename(lx, out->over[i], FILE_NAME))
        return false;
    out->over_len[i] = lx->last - out->over_at[i];
    return true;
}

static const look rows[] = {{"title", read_text, offsetof(plot_panel, title)},
                            {"xlabel", read_text, offsetof(plot_panel, xlabel)},
                            {"ylabel", read_text, offsetof(plot_panel, ylabel)},
                            {"xrange", read_limits, 0},
                            {"yrange", read_limits, 0},
                            {"log", read_log, 0},
                            {"flip", read_flip, 0},
                            {"key", read_key, 0},
                            {"points", read_points, 0},
                            {"over", read_over, 0}};
enum { ROWS = sizeof rows / sizeof *rows };

const char *looks_word(size_t i) {
    return i < ROWS ? rows[i].name : NULL;
}

bool looks_read(shell *sh, lexer *lx, plot_panel *p, looks *out, bool *found) {
    const look *row = rows;
    while (row < rows + ROWS && !lex_is(lx, row->name))
        row++;
    *found = row < rows + ROWS;
    if (!*found)
        return true;
    if (row->read != read_over) /* a file's name is not made of tokens */
        lex_next(lx);
    else
        lx->error->raised = (lex_next(lx), false);
    return !lx->error->raised && row->read(sh, lx, row, p, out);
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
