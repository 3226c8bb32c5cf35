/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `plot`: reads figures, lets the sweeps fill them, and gives them to gnuplot. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "shell/expressions.h"
#include "shell/figures.h"
#include "shell/range.h"
#include "shell/target.h"

enum { PLOTTED = 8 }; /* expressions of a panel */

/* A panel on its way: expressions of a sweep become curves. */
typedef struct panel_job {
    shell *sh;
    plot_panel *p;
    const figure *figure; /* or NULL */
    const sweep *s;
    size_t count;                /* expressions that are drawn */
    bool against;                /* the one after them is the abscissa */
    const column *columns;
    calc_error *error;
    size_t first; /* series of the panel before this sweep */
} panel_job;

static char role_of(const panel_job *job, size_t i) {
    return job->figure && job->figure->roles ? job->figure->roles[i] : 'c';
}

/* "k = 0.5", the expression, or both: what tells the curves apart. */
static char *title_of(const panel_job *job, size_t curve, size_t i) {
    char text[500] = "", number[160];
    const column *c = &job->columns[i];
    size_t drawn = 0;
    for (size_t j = 0; j < job->count; j++)
        drawn += role_of(job, j) == 'c';
    if (role_of(job, i) != 'c' || (drawn < 2 && !job->s->curves))
        return NULL;
    if (job->s->curves)
        format_value(&job->sh->set, (value){job->s->value[curve], job->s->with.d}, number, sizeof number);
    if (drawn > 1 && job->s->curves)
        snprintf(text, sizeof text, "%.200s, %s = %s", c->name, job->s->with.text, number);
    else if (job->s->curves)
        snprintf(text, sizeof text, "%s = %s", job->s->with.text, number);
    else
        snprintf(text, sizeof text, "%.300s", c->name);
    return plot_label(text, NULL);
}

/* The series of a curve: one an expression, one for both edges of a band. */
static bool add_series(panel_job *job, size_t curve) {
    char error[CALC_ERROR_TEXT - 8];
    for (size_t i = 0; i < job->count; i++) {
        const char role = role_of(job, i);
        plot_series *s = plot_series_add(job->p, role == 'b' ? PLOT_BAND : PLOT_CURVE, title_of(job, curve, i), error,
                                         sizeof error);
        if (!s)
            return calc_fail(job->error, 0, 0, "%s", error);
        s->thin = role != 'c';
        i += role == 'b';
    }
    return true;
}

static bool give_point(void *context, const sweep *s, size_t curve, long double x, const long double *values) {
    panel_job *job = context;
    size_t each = 0;
    (void)s;
    for (size_t i = 0; i < job->count; i++, each++)
        i += role_of(job, i) == 'b';
    const size_t at = job->first + curve * each;
    if (at >= job->p->count && !add_series(job, curve))
        return false;
    const double abscissa = (double)(job->against ? values[job->count] : x);
    for (size_t i = 0, j = at; i < job->count; i++, j++) {
        plot_series *to = job->p->series[j];
        const bool band = role_of(job, i) == 'b';
        if (!(band ? plot_band(to, abscissa, (double)values[i], (double)values[i + 1])
                   : plot_point(to, abscissa, (double)values[i])))
            return calc_no_memory(job->error);
        i += band;
    }
    return true;
}

/* ---- axes -------------------------------------------------------------------------------------- */

static double largest(const plot_panel *p, bool x_axis) {
    double most = 0;
    for (size_t i = 0; i < p->count; i++)
        for (size_t j = 0; j < p->series[i]->count; j++) {
            const double v = fabs(x_axis ? p->series[i]->x[j] : p->series[i]->y[j]);
            if (isfinite(v))
                most = fmax(most, v);
        }
    return most;
}

static void divide(plot_panel *p, bool x_axis, long double scale) {
    for (size_t i = 0; i < p->count; i++) {
        plot_series *s = p->series[i];
        for (size_t j = 0; j < s->count; j++) {
            double *v = x_axis ? &s->x[j] : &s->y[j];
            *v = (double)(*v / scale);
            if (!x_axis && s->y2)
                s->y2[j] = (double)(s->y2[j] / scale);
        }
    }
}

/* In the unit that was asked for, or one with a prefix that fits. */
static char *scale_axis(plot_panel *p, bool x_axis, const column *c, dim d, const char *name) {
    char unit_text[COLUMN_UNIT];
    long double scale;
    if (c && c->chosen) {
        scale = c->scale;
        snprintf(unit_text, sizeof unit_text, "%s", c->unit);
    } else {
        scale = unit_choose(d, largest(p, x_axis), 6, unit_text, sizeof unit_text);
    }
    divide(p, x_axis, scale);
    return plot_label(name, unit_text);
}

static bool finish_axes(panel_job *job, const dim *d, const bool *known) {
    const sweep *s = job->s;
    const column *c = job->columns;
    size_t drawn = 0;
    for (size_t i = 0; i < job->count; i++)
        drawn += role_of(job, i) == 'c';
    for (size_t i = 1; i < job->count; i++)
        if (known[i] && known[0] && !dim_equal(d[i], d[0]))
            return calc_fail(job->error, job->sh->list[i].at, job->sh->list[i].len, "%s and %s cannot share an axis",
                             c[0].name, c[i].name);
    const column *x = job->against ? &c[job->count] : NULL;
    const char *xname = x ? x->name : s->along ? "time" : s->var.text;
    job->p->xlabel = scale_axis(job->p, true, x, x ? d[job->count] : s->along ? DIM_NONE : s->var.d, xname);
    job->p->ylabel = scale_axis(job->p, false, &c[0], d[0], drawn > 1 ? "" : c[0].name);
    job->p->logx = job->p->logx || s->log;
    if (!job->p->title)
        job->p->title = job->figure ? strdup(job->figure->title) : drawn == 1 ? plot_label(c[0].name, NULL) : NULL;
    return true;
}

/* ---- figures ----------------------------------------------------------------------------------- */

/* EXPR, ... [against EXPR] RANGE at the cursor. */
static bool draw_sweep(shell *sh, lexer *lx, const figure *f, plot_panel *p) {
    column columns[PLOTTED + 1];
    size_t count = 0, more = 0;
    dim d[PLOTTED + 1] = {DIM_NONE};
    bool known[PLOTTED + 1] = {false};
    range r;
    bool ok = read_expressions(sh, lx, columns, PLOTTED, &count);
    panel_job job = {.sh = sh, .p = p, .figure = f, .count = count, .columns = columns, .error = lx->error};
    if (ok && lex_accept(lx, "against")) {
        ok = read_one_expression(sh, lx, count, &columns[count]);
        job.against = true;
        more = 1;
    }
    ok = ok && range_read(sh, lx, &r, 200);
    if (ok) {
        job.s = &r.sweep;
        r.sweep.turns = true;
        for (size_t i = 0; i < count + more; i++) {
            known[i] = columns[i].chosen;
            d[i] = columns[i].d;
        }
        sweep_job sweeping = {.c = &sh->calc,
                              .expressions = sh->list,
                              .count = count + more,
                              .d = d,
                              .known = known,
                              .row = give_point,
                              .context = &job,
                              .error = lx->error};
        if (r.sweep.along && r.sweep.steps == 200)
            r.sweep.steps = 400;
        if (r.sweep.along && r.sweep.what == ALONG_PROGRAM && sh->calc.scene.end.steps == 1)
            ok = calc_fail(lx->error, 0, 0, "there is no loop yet: use step or cycle first");
        ok = ok && sweep_run(&r.sweep, &sweeping) && finish_axes(&job, d, known);
        if (ok)
            note_missing(sh, &sweeping);
    }
    columns_free(columns, count + more);
    return ok;
}

/* The end of what belongs to this figure: a `|`, `to FILE`, or the end. */
static size_t figure_end(const lexer *lx) {
    calc_error ignored;
    lexer scan = *lx;
    error_clear(&ignored);
    scan.error = &ignored;
    while (scan.kind != T_END && scan.kind != T_BAR && !lex_is(&scan, "to"))
        lex_next(&scan);
    return scan.kind == T_END ? lx->end : scan.at;
}

/* A figure of the table: its statement as if it stood here, what follows the name after it. */
static bool draw_named(shell *sh, lexer *lx, const figure *f, plot_panel *p) {
    p->flipy = f->flipy;
    p->points = f->points;
    lex_next(lx);
    if (f->build)
        return f->build(sh, lx, p);
    const size_t rest = figure_end(lx), length = strlen(f->statement);
    char *text = malloc(length + 1 + (rest - lx->at) + 1);
    if (!text)
        return calc_no_memory(lx->error);
    snprintf(text, length + 1 + (rest - lx->at) + 1, "%s %.*s", f->statement, (int)(rest - lx->at), lx->text + lx->at);
    lexer own;
    lex_start(&own, text, strlen(text), lx->error);
    range_names used;
    bool found;
    bool ok = range_names_find(sh, &own, &used, &found) && draw_sweep(sh, &own, f, p) && at_end(&own);
    range_forget(sh, &used);
    free(text);
    if (!ok && lx->error->len && lx->error->at > length)
        lx->error->at += lx->at - (length + 1);
    else if (!ok)
        lx->error->len = 0;
    lex_seek(lx, rest);
    return ok;
}

/* The name of a figure is an expression where one goes on behind it. */
static const figure *figure_at(const lexer *lx) {
    static const char *const goes_on[] = {"for", "along", "in", "at", "against"};
    const figure *f = lx->kind == T_NAME ? figure_find(lx->text + lx->at, lx->len) : NULL;
    lexer next = *lx;
    calc_error ignored;
    error_clear(&ignored);
    next.error = &ignored;
    lex_next(&next);
    for (size_t i = 0; i < sizeof goes_on / sizeof *goes_on; i++)
        if (lex_is(&next, goes_on[i]))
            return NULL;
    return next.kind == T_END || next.kind == T_NAME || next.kind == T_BAR ? f : NULL;
}

static bool draw_panel(shell *sh, lexer *lx, plot_figure *f) {
    char error[CALC_ERROR_TEXT - 8];
    plot_panel *p = plot_panel_add(f, error, sizeof error);
    if (!p)
        return lex_fail(lx, "%s", error);
    const figure *named = figure_at(lx);
    return named ? draw_named(sh, lx, named, p) : draw_sweep(sh, lx, NULL, p);
}

/* ---- where it goes ----------------------------------------------------------------------------- */

static void terminal_size(const shell *sh, int *w, int *h) {
    struct winsize size;
    *w = 79, *h = 24;
    if (sh->out == stdout && isatty(STDOUT_FILENO) && !ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) &&
        size.ws_col >= 20 && size.ws_row >= 8) {
        *w = size.ws_col - 1;
        *h = size.ws_row - 2; /* the prompt and the command stay in sight */
    }
}

static bool draw(shell *sh, lexer *lx, const plot_figure *f, const char *file) {
    char error[CALC_ERROR_TEXT - 8];
    file_report written;
    text_out text;
    if (!text_begin(&text, &sh->set, sh->out))
        return calc_no_memory(lx->error);
    plot_target to = {.file = file,
                      .out = text.to,
                      .columns = sh->set.plot_width,
                      .rows = sh->set.plot_height,
                      .timeout = sh->set.plot_timeout,
                      .stop = &shell_stop};
    if (!file && !to.columns)
        terminal_size(sh, &to.columns, &to.rows);
    fflush(sh->out);
    bool ok = plot_draw(f, &to, &written, error, sizeof error);
    text_end(&text);
    if (!ok) {
        lx->error->stop = shell_stop;
        return calc_fail(lx->error, 0, 0, "%s", error);
    }
    if (file)
        target_report(sh, file, &written);
    return true;
}

/* `to FILE` may stand behind long work: it is asked for before. */
static bool find_file(lexer *lx, char *file) {
    calc_error ignored;
    char error[CALC_ERROR_TEXT - 8];
    lexer scan = *lx;
    error_clear(&ignored);
    scan.error = &ignored;
    while (scan.kind != T_END && !lex_is(&scan, "to"))
        lex_next(&scan);
    file[0] = 0;
    if (scan.kind == T_END)
        return true;
    lex_next(&scan);
    const size_t at = scan.at;
    if (!lex_filename(&scan, file, ARG_FILE_NAME))
        return true; /* said when it is read */
    return plot_check(file, &shell_stop, error, sizeof error) || calc_fail(lx->error, at, scan.last - at, "%s", error);
}

bool do_plot(shell *sh, lexer *lx, const command *self) {
    char file[ARG_FILE_NAME], again[ARG_FILE_NAME];
    plot_figure f;
    range_names used;
    bool found, ok = true;
    (void)self;
    if (!range_names_find(sh, lx, &used, &found))
        return false;
    plot_figure_init(&f);
    if (!found && !figure_at(lx))
        ok = lex_fail(lx, "expected EXPR, ... for VAR = LO .. HI");
    ok = ok && find_file(lx, file);
    while (ok && (ok = draw_panel(sh, lx, &f)) && lx->kind == T_BAR)
        lex_next(lx);
    if (ok && lex_accept(lx, "to"))
        ok = lex_filename(lx, again, sizeof again);
    ok = ok && at_end(lx) && draw(sh, lx, &f, *file ? file : NULL);
    plot_figure_free(&f);
    range_forget(sh, &used);
    return ok;
}
