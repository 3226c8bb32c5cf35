/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Commands that show what follows from the scene and leave it as it is. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "number/real.h"
#include "plot/plot.h"
#include "shell/accuracy.h"
#include "shell/command.h"
#include "shell/output.h"

/* ---- output to a file -------------------------------------------------------------------------- */

/* Written beside its target and renamed when whole. */
typedef struct target {
    FILE *to;
    char name[4000], part[4050];
    bool direct; /* a device or pipe: nothing to rename */
} target;

static bool target_open(shell *sh, lexer *lx, target *t) {
    t->to = sh->out;
    t->name[0] = 0;
    if (!lex_accept(lx, "to"))
        return at_end(lx);
    size_t at = lx->at;
    if (!lex_filename(lx, t->name, sizeof t->name) || !at_end(lx))
        return false;
    struct stat info;
    t->direct = !stat(t->name, &info) && !S_ISREG(info.st_mode);
    snprintf(t->part, sizeof t->part, t->direct ? "%s" : "%s.part", t->name);
    t->to = fopen(t->part, "w");
    if (!t->to)
        return calc_fail(lx->error, at, strlen(t->name), "cannot write %s: %s", t->name, strerror(errno));
    return true;
}

static bool target_close(lexer *lx, target *t, bool ok) {
    if (!t->name[0])
        return ok;
    int code = 0;
    if (fflush(t->to) || ferror(t->to))
        code = errno ? errno : EIO;
    if (fclose(t->to) && !code)
        code = errno;
    if (ok && !code && !t->direct && rename(t->part, t->name))
        code = errno;
    if (!t->direct && (!ok || code))
        unlink(t->part);
    if (ok && code)
        return calc_fail(lx->error, 0, 0, "cannot write %s: %s", t->name, strerror(code));
    return ok;
}

/* ---- history ----------------------------------------------------------------------------------- */

static const char *const history_names[] = {"FN", "dz", "Fx", "dx", "W"};
enum { HISTORY = sizeof history_names / sizeof *history_names };

static void history_row(const fret_state *s, size_t step, void *context) {
    const long double row[HISTORY] = {s->FN, s->dz, s->Fx, s->dx, s->W};
    (void)step;
    table_row(context, row);
}

static void si_column(column *c, const char *name, dim d) {
    snprintf(c->name, sizeof c->name, "%s", name);
    dim_unit(d, c->unit, sizeof c->unit);
    c->scale = 1;
    c->d = d;
    c->chosen = false;
}

bool do_history(shell *sh, lexer *lx) {
    const fret_memory *memory;
    target to;
    if (!scene_memory(&sh->calc.scene, &memory, lx->error) || !target_open(sh, lx, &to))
        return false;
    table t = {.sh = sh, .to = to.to, .count = HISTORY};
    for (size_t i = 0; i < HISTORY; i++) {
        const quantity *q = quantity_find(history_names[i], strlen(history_names[i]));
        si_column(&t.columns[i], q->name, q->d);
    }
    /* into a file that ends in .csv goes CSV, whatever the screen shows */
    format old = sh->set.format;
    size_t n = strlen(to.name);
    if (n > 4 && !strcmp(to.name + n - 4, ".csv"))
        sh->set.format = FORMAT_CSV;
    table_begin(&t);
    bool ok = scene_trace(&sh->calc.scene, 0, history_row, &t, lx->error);
    sh->set.format = old;
    return target_close(lx, &to, ok);
}

/* ---- sweeps ------------------------------------------------------------------------------------ */

enum { WITH_VALUES = 20 };

/* for VAR = LO .. HI [steps N] [log] [with VAR2 = v1, v2, ...] */
typedef struct axis {
    char name[64];
    const quantity *q; /* an input, or NULL for a free name */
    dim d;
} axis;

typedef struct sweep {
    axis var, with;
    long double lo, hi, with_values[WITH_VALUES];
    unsigned steps;
    bool log;
    size_t with_count;
} sweep;

static bool read_axis(shell *sh, lexer *lx, axis *out) {
    if (lx->kind != T_NAME || lx->len >= sizeof out->name)
        return lex_fail(lx, "expected a name");
    snprintf(out->name, sizeof out->name, "%.*s", (int)lx->len, lx->text + lx->at);
    out->q = quantity_find(out->name, lx->len);
    if (out->q && out->q->in < 0)
        return lex_fail(lx, "%s is a result: only inputs and free names can be swept", out->name);
    const char *taken = out->q ? NULL : name_taken(out->name, lx->len);
    if (taken)
        return lex_fail(lx, "'%s' is %s: it cannot be swept", out->name, taken);
    if (out->q && out->q->in == IN_FN && !sh->calc.scene.steps)
        out->q = quantity_find("FN", 2);
    lex_next(lx);
    if (lx->kind != T_ASSIGN)
        return lex_fail(lx, "expected = after %s", out->name);
    lex_next(lx);
    return true;
}

static bool read_bound(shell *sh, lexer *lx, const axis *a, bool first, dim *d, long double *out) {
    value v;
    size_t at = lx->at;
    if (!expr_value(&sh->calc, lx, &v))
        return false;
    if (first)
        *d = a->q ? quantity_dim(a->q, &sh->calc.scene) : v.d;
    if (!first && !a->q && dim_equal(*d, DIM_NONE))
        *d = v.d; /* 0 .. 3 mm */
    *out = v.v;
    return value_dim(lx, a->name, at, lx->last - at, v, *d);
}

static bool read_sweep(shell *sh, lexer *lx, sweep *s, unsigned steps) {
    *s = (sweep){.steps = steps};
    if (!read_axis(sh, lx, &s->var) || !read_bound(sh, lx, &s->var, true, &s->var.d, &s->lo))
        return false;
    if (lx->kind != T_RANGE)
        return lex_fail(lx, "expected .. between the two ends of the sweep");
    lex_next(lx);
    if (!read_bound(sh, lx, &s->var, false, &s->var.d, &s->hi))
        return false;
    size_t at = lx->at;
    for (;;) {
        if (lex_accept(lx, "steps")) {
            if (!read_count(sh, lx, "steps", 100000000, &s->steps))
                return false;
        } else if (lex_accept(lx, "log")) {
            s->log = true;
        } else if (lex_accept(lx, "with")) {
            if (!read_axis(sh, lx, &s->with))
                return false;
            do {
                if (s->with_count == WITH_VALUES)
                    return lex_fail(lx, "more than %d values", WITH_VALUES);
                if (s->with_count)
                    lex_next(lx);
                if (!read_bound(sh, lx, &s->with, s->with_count == 0, &s->with.d,
                                &s->with_values[s->with_count]))
                    return false;
                s->with_count++;
            } while (lx->kind == T_COMMA);
        } else {
            break;
        }
    }
    if (s->log && !(s->lo > 0 && s->hi > 0))
        return calc_fail(lx->error, at, 1, "a logarithmic sweep needs positive ends");
    return true;
}

static long double sweep_at(const sweep *s, unsigned i) {
    if (i == s->steps)
        return s->hi;
    long double t = (long double)i / s->steps;
    return s->log ? s->lo * fret_pow(s->hi / s->lo, t) : s->lo + (s->hi - s->lo) * t;
}

static bool place(shell *sh, scene *s, const axis *a, int slot, long double v, calc_error *error) {
    sh->calc.sweep_value[slot] = (value){v, a->d};
    if (!a->q)
        return true;
    if (a->q->in == IN_FN && s->steps && s->program[0].normal != BY_FORCE)
        return calc_fail(error, 0, 0, "FN cannot be swept: the press was not given as FN");
    scene_put(s, (input)a->q->in, (double)v);
    return true;
}

/* The sweep's names must be known before the expressions that come first on the line are parsed. */
static bool find_sweep_names(lexer *lx, char names[2][64]) {
    calc_error ignored = {0};
    lexer scan = *lx;
    scan.error = &ignored;
    names[0][0] = names[1][0] = 0;
    int found = 0;
    while (scan.kind != T_END && !ignored.raised) {
        bool is_for = lex_is(&scan, "for"), is_with = lex_is(&scan, "with");
        lex_next(&scan);
        if ((is_for || (is_with && found)) && scan.kind == T_NAME && scan.len < 64) {
            snprintf(names[is_for ? 0 : 1], 64, "%.*s", (int)scan.len, scan.text + scan.at);
            found = 1;
        }
    }
    return found;
}

typedef bool sweep_row(void *context, const sweep *s, size_t with, const long double *values);

static bool fits(const expr *e, column *c, dim d, calc_error *error) {
    if (c->chosen && !dim_equal(c->d, d)) {
        char is[128];
        dim_describe(d, is, sizeof is);
        return calc_fail(error, e->at, e->len, "%s is %s: it cannot be shown in %s", c->name, is, c->unit);
    }
    c->d = d;
    return true;
}

/* Many rows at once, all expressions or none. An input that is swept makes a new scene of every row. */
static bool run_block(shell *sh, const sweep *s, column *columns, size_t count, const long double *x,
                      size_t rows, long double (*out)[EXPR_BLOCK]) {
    calc_error unused = {0};
    dim d;
    sh->calc.sweep_value[0].d = s->var.d;
    for (size_t j = 0; j < count; j++)
        if (s->var.q || !expr_eval_block(&sh->calc, &sh->list[j], x, rows, out[j], &d) ||
            !fits(&sh->list[j], &columns[j], d, &unused))
            return false;
    return true;
}

/* Evaluates `count` expressions of sh->list at every point of the sweep on a scratch scene. */
static bool run_sweep(shell *sh, const sweep *s, column *columns, size_t count, sweep_row *row, void *context,
                      calc_error *error) {
    scene kept = sh->calc.scene;
    scene_clone(&sh->calc.scene, &kept);
    bool ok = true;
    size_t curves = s->with_count ? s->with_count : 1, fixed = 1 + (s->with_count > 0);
    for (size_t w = 0; w < curves && ok; w++) {
        long double x[EXPR_BLOCK], block[COLUMNS][EXPR_BLOCK];
        bool whole = false;
        if (s->with_count)
            ok = place(sh, &sh->calc.scene, &s->with, 1, s->with_values[w], error);
        for (unsigned i = 0; i <= s->steps && ok; i++) {
            unsigned r = i % EXPR_BLOCK;
            if (r == 0) {
                size_t rows = s->steps - i < EXPR_BLOCK ? s->steps - i + 1 : EXPR_BLOCK;
                for (unsigned j = 0; j < rows; j++)
                    x[j] = sweep_at(s, i + j);
                whole = run_block(sh, s, columns, count, x, rows, block);
            }
            long double values[COLUMNS + 2];
            values[0] = x[r];
            if (s->with_count)
                values[1] = s->with_values[w];
            ok = place(sh, &sh->calc.scene, &s->var, 0, values[0], error);
            for (size_t j = 0; j < count && ok; j++) {
                value result;
                if (whole) {
                    values[fixed + j] = block[j][r];
                    continue;
                }
                ok = expr_eval(&sh->calc, &sh->list[j], &result, error) &&
                     fits(&sh->list[j], &columns[j], result.d, error);
                values[fixed + j] = ok ? result.v : 0;
            }
            if (ok && shell_stop) {
                error->stop = true;
                ok = calc_fail(error, 0, 0, "interrupted");
            }
            ok = ok && row(context, s, w, values);
        }
    }
    if (!ok && error->raised && !error->stop) {
        char text[160];
        format_value(sh, (value){sh->calc.sweep_value[0].v, s->var.d}, text, sizeof text);
        size_t n = strlen(error->text);
        snprintf(error->text + n, sizeof error->text - n, " (at %s = %s)", s->var.name, text);
    }
    kept.used |= sh->calc.scene.used;
    scene_free(&sh->calc.scene);
    sh->calc.scene = kept;
    return ok;
}

/* Parses `EXPR, ... for SWEEP` at the cursor. */
static bool read_swept(shell *sh, lexer *lx, column *columns, size_t limit, size_t *count, sweep *s,
                       unsigned steps) {
    static const char usage[] = "for VAR = LO .. HI";
    char names[2][64];
    if (!find_sweep_names(lx, names))
        return lex_fail(lx, "expected EXPR, ... %s", usage);
    for (int i = 0; i < 2; i++) /* a swept input is looked up as the quantity it is */
        if (names[i][0] && !quantity_find(names[i], strlen(names[i])))
            sh->calc.sweep_name[i] = names[i];
    bool ok = read_expressions(sh, lx, columns, limit, count);
    sh->calc.sweep_name[0] = sh->calc.sweep_name[1] = NULL;
    if (!ok)
        return false;
    if (!lex_accept(lx, "for"))
        return lex_fail(lx, "expected %s", usage);
    return read_sweep(sh, lx, s, steps);
}

typedef struct table_job {
    table t;
    const column *columns; /* of the expressions: their dimensions come with the first row */
    size_t count;
    bool begun;
    calc_error *error;
} table_job;

static bool table_job_row(void *context, const sweep *s, size_t with, const long double *values) {
    table_job *job = context;
    (void)with;
    if (!job->begun) {
        job->begun = true;
        size_t first = 1 + (s->with_count > 0);
        si_column(&job->t.columns[0], s->var.name, s->var.d);
        if (s->with_count)
            si_column(&job->t.columns[1], s->with.name, s->with.d);
        for (size_t i = 0; i < job->count; i++) {
            column *c = &job->t.columns[first + i];
            if (job->columns[i].chosen)
                *c = job->columns[i];
            else
                si_column(c, job->columns[i].name, job->columns[i].d);
        }
        job->t.count = first + job->count;
        table_begin(&job->t);
    }
    table_row(&job->t, values);
    /* a reader that has gone, or a full disk: no use in going on */
    return !ferror(job->t.to) ||
           calc_fail(job->error, 0, 0, "cannot write to %s: %s",
                     job->t.to == job->t.sh->out ? "standard output" : "the file", strerror(errno));
}

bool do_table(shell *sh, lexer *lx) {
    column columns[COLUMNS - 2];
    size_t count;
    sweep s;
    target to;
    if (!read_swept(sh, lx, columns, COLUMNS - 2, &count, &s, 20) || !target_open(sh, lx, &to))
        return false;
    format old = sh->set.format;
    size_t n = strlen(to.name);
    if (n > 4 && !strcmp(to.name + n - 4, ".csv"))
        sh->set.format = FORMAT_CSV;
    table_job job = {.t = {.sh = sh, .to = to.to}, .columns = columns, .count = count, .error = lx->error};
    bool ok = run_sweep(sh, &s, columns, count, table_job_row, &job, lx->error);
    sh->set.format = old;
    return target_close(lx, &to, ok);
}

/* ---- plots ------------------------------------------------------------------------------------- */

static void terminal_size(const shell *sh, int *w, int *h) {
    struct winsize size;
    *w = 79, *h = 24;
    if (sh->out == stdout && isatty(STDOUT_FILENO) && !ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) &&
        size.ws_col >= 20 && size.ws_row >= 8) {
        *w = size.ws_col - 1;
        *h = size.ws_row - 2; /* the prompt and the command stay in sight */
    }
}

static bool draw(shell *sh, lexer *lx, plot_figure *f, const char *file) {
    plot_target to = {.file = *file ? file : NULL,
                      .out = sh->out,
                      .terminal = PLOT_DUMB,
                      .columns = sh->set.plot_width,
                      .rows = sh->set.plot_height,
                      .timeout = sh->set.plot_timeout,
                      .stop = &shell_stop};
    char error[CALC_ERROR_TEXT - 8];
    if (!to.file && !to.columns)
        terminal_size(sh, &to.columns, &to.rows);
    fflush(sh->out);
    bool ok = plot_draw(f, &to, NULL, error, sizeof error);
    if (!ok) {
        lx->error->stop = shell_stop;
        return calc_fail(lx->error, 0, 0, "%s", error);
    }
    return true;
}

/* Scales a panel's points to a unit that suits them, and labels the axis. */
static char *scale_axis(plot_panel *p, bool x_axis, dim d, const char *name) {
    long double most = 0;
    for (size_t i = 0; i < p->count; i++)
        for (size_t j = 0; j < p->series[i]->count; j++)
            most = fmaxl(most, fabsl((long double)(x_axis ? p->series[i]->x[j] : p->series[i]->y[j])));
    char unit_text[COLUMN_UNIT];
    long double scale = unit_choose(d, most, 6, unit_text, sizeof unit_text);
    for (size_t i = 0; i < p->count; i++)
        for (size_t j = 0; j < p->series[i]->count; j++) {
            double *v = x_axis ? &p->series[i]->x[j] : &p->series[i]->y[j];
            *v = (double)(*v / scale);
        }
    return plot_label(name, unit_text);
}

typedef struct loop_job {
    plot_series *series;
    bool memory;
} loop_job;

static void loop_point(const fret_state *s, size_t step, void *context) {
    loop_job *job = context;
    (void)step;
    job->memory = job->memory && plot_point(job->series, (double)s->dx, (double)s->Fx);
}

static bool plot_loop(shell *sh, lexer *lx, const char *file) {
    char error[100];
    plot_figure f;
    plot_figure_init(&f);
    plot_panel *p = plot_panel_add(&f, error, sizeof error);
    loop_job job = {p ? plot_series_add(p, PLOT_CURVE, NULL, error, sizeof error) : NULL, true};
    bool ok = job.series ? scene_trace(&sh->calc.scene, 100, loop_point, &job, lx->error)
                         : lex_fail(lx, "%s", error);
    if (ok && !job.memory)
        ok = lex_fail(lx, "out of memory");
    if (ok && job.series->count < 2)
        ok = lex_fail(lx, "there is no loop yet: use step or cycle first");
    if (ok) {
        p->title = strdup("hysteresis loop");
        p->xlabel = scale_axis(p, true, DIM_LENGTH, "dx");
        p->ylabel = scale_axis(p, false, DIM_FORCE, "Fx");
        ok = draw(sh, lx, &f, file);
    }
    plot_figure_free(&f);
    return ok;
}

typedef struct plot_job {
    plot_panel *p;
    size_t count; /* expressions */
    const column *columns;
    const shell *sh;
    bool memory;
} plot_job;

static bool plot_row(void *context, const sweep *s, size_t with, const long double *values) {
    plot_job *job = context;
    const long double *v = values + 1 + (s->with_count > 0);
    for (size_t i = 0; i < job->count; i++) {
        size_t at = with * job->count + i;
        const column *c = &job->columns[i];
        if (at >= job->p->count) {
            char title[COLUMN_NAME + 100], value_text[160], error[100];
            snprintf(title, sizeof title, "%s", c->name);
            if (s->with_count) {
                format_value(job->sh, (value){values[1], s->with.d}, value_text, sizeof value_text);
                snprintf(title, sizeof title, job->count > 1 ? "%s, %s = %s" : "%.0s%s = %s", c->name,
                         s->with.name, value_text);
            }
            char *shown = job->count > 1 || s->with_count ? plot_label(title, NULL) : NULL;
            if (!plot_series_add(job->p, PLOT_CURVE, shown, error, sizeof error))
                return job->memory = false;
        }
        plot_series *series = job->p->series[at];
        if (!plot_point(series, (double)values[0], (double)(c->chosen ? v[i] / c->scale : v[i])))
            return job->memory = false;
    }
    return true;
}

static bool read_plot_target(lexer *lx, char *file, size_t size) {
    char error[CALC_ERROR_TEXT - 8];
    file[0] = 0;
    if (!lex_accept(lx, "to"))
        return at_end(lx);
    size_t at = lx->at;
    if (!lex_filename(lx, file, size) || !at_end(lx))
        return false;
    return plot_check(file, &shell_stop, error, sizeof error) || calc_fail(lx->error, at, strlen(file), "%s", error);
}

static bool plot_expressions(shell *sh, lexer *lx) {
    column columns[8];
    size_t count;
    sweep s;
    char file[4000];
    if (!read_swept(sh, lx, columns, 8, &count, &s, 200) || !read_plot_target(lx, file, sizeof file))
        return false;
    if (count * (s.with_count ? s.with_count : 1) > PLOT_CURVES)
        return lex_fail(lx, "more than %d curves", PLOT_CURVES);
    char error[100];
    plot_figure f;
    plot_figure_init(&f);
    plot_panel *p = plot_panel_add(&f, error, sizeof error);
    if (!p)
        return lex_fail(lx, "out of memory");
    plot_job job = {p, count, columns, sh, true};
    bool ok = run_sweep(sh, &s, columns, count, plot_row, &job, lx->error);
    if (!job.memory)
        ok = lex_fail(lx, "out of memory");
    for (size_t i = 1; i < count && ok; i++)
        if (!dim_equal(columns[i].d, columns[0].d))
            ok = calc_fail(lx->error, sh->list[i].at, sh->list[i].len, "%s and %s cannot share an axis",
                           columns[0].name, columns[i].name);
    if (ok) {
        p->xlabel = scale_axis(p, true, s.var.d, s.var.name);
        const char *name = count > 1 ? "" : columns[0].name;
        p->ylabel =
            columns[0].chosen ? plot_label(name, columns[0].unit) : scale_axis(p, false, columns[0].d, name);
        p->logx = s.log;
        ok = draw(sh, lx, &f, file);
    }
    plot_figure_free(&f);
    return ok;
}

/* Error against time, one curve a model. */
static bool plot_accuracy(shell *sh, lexer *lx) {
    char file[4000];
    accuracy_load load;
    accuracy_study study;
    if (!accuracy_read(sh, lx, &load) || !read_plot_target(lx, file, sizeof file) ||
        !accuracy_measure(sh, &load, &study, lx->error))
        return false;
    char error[100];
    plot_figure f;
    plot_figure_init(&f);
    plot_panel *p = plot_panel_add(&f, error, sizeof error);
    bool ok = p != NULL;
    for (size_t i = 0; i < study.count && ok; i++) {
        const accuracy_row *row = &study.row[i];
        if (i == 0 || row->family != row[-1].family)
            ok = plot_series_add(p, PLOT_CURVE, strdup(family_names[row->family]), error, sizeof error) !=
                 NULL;
        ok = ok && plot_point(p->series[p->count - 1], row->seconds, (double)row->error);
    }
    if (ok) {
        char title[200];
        snprintf(title, sizeof title, "dW, %.140s", study.load);
        p->title = strdup(title);
        p->xlabel = plot_label("time of a cycle", "s");
        p->ylabel = plot_label("relative error", NULL);
        p->logx = p->logy = p->points = true;
        ok = draw(sh, lx, &f, file);
    } else {
        ok = lex_fail(lx, "out of memory");
    }
    plot_figure_free(&f);
    return ok;
}

bool do_plot(shell *sh, lexer *lx) {
    char file[4000];
    if (lex_is(lx, "accuracy")) {
        lex_next(lx);
        return plot_accuracy(sh, lx);
    }
    if (lex_is(lx, "loop")) {
        lex_next(lx);
        return read_plot_target(lx, file, sizeof file) && plot_loop(sh, lx, file);
    }
    return plot_expressions(sh, lx);
}
