/* SPDX-License-Identifier: GPL-3.0-or-later */
/* fit: estimates values and standard errors from measured data; draws the fit. Does not change the scene. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "commands/columns.h"
#include "commands/expressions.h"
#include "commands/figures.h"
#include "commands/tables.h"
#include "measured/loop.h"
#include "number/array.h"
#include "statement/command.h"
#include "study/determined.h"
#include "study/fit.h"

const char study_library[] = "";

/* ---- fit: reading ------------------------------------------------------------------------------ */

/* Reads the names to estimate; the fit starts from their present values. */
static bool read_names(shell *sh, lexer *lx, fit_question *q) {
    for (;;) {
        if (!read_name(sh, lx, true, FIT_NAMES, q->name, &q->count))
            return false;
        if (lx->kind == T_ASSIGN)
            return lex_fail(lx, "unexpected '=': fit starts from the present value of %s",
                            q->name[q->count - 1].text);
        if (lx->kind != T_COMMA)
            return at_end(lx);
        lex_next(lx);
    }
}

/* Raises an error, and is true, if a quantity of the equation hides a column. */
static bool ambiguous(const shell *sh, csv *data, const expr *e, calc_error *error) {
    size_t i = 0;
    const quantity *of = columns_hidden(sh, data, e, &i);
    return of && !calc_fail(error, e->at, e->len,
                            quantity_is_input(of)
                                ? "%s is an input that this scene does not take, and a column of the file: "
                                  "rename the column"
                                : "%s is a result of the scene and a column of the file: rename the column",
                            of->name);
}

static bool read_equation(shell *sh, lexer *lx, parsed *all, fit_question *q, csv *data,
                          named_columns *columns) {
    const given_clause *sides = parsed_clause(all, "for", 0), *to = parsed_clause(all, "to", 0);
    char layout[CALC_ERROR_TEXT / 2];
    _Static_assert((int)CSV_COLUMNS <= (int)FIT_COLUMNS, "all columns of a file are names");
    if (!to)
        return lex_fail(lx, "expected to FILE.csv");
    if (!columns_read(lx, all, to, data) || !columns_show_names(sh, data, all, columns, lx->error))
        return false;
    const expr *left = &sh->list[0], *right = &sh->list[1];
    q->sides = sh->list;
    if (!read_sides(sh, lx, sides))
        return columns_missed(sh, lx, data);
    if (ambiguous(sh, data, left, lx->error) || ambiguous(sh, data, right, lx->error) ||
        !columns_load(sh, data, 2, columns, lx->error))
        return false;
    csv_layout(data, layout, sizeof layout);
    if (!columns->used)
        return calc_fail(lx->error, left->at, right->at + right->len - left->at,
                         "no column of %.100s is in the equation: %s", data->path, layout);
    columns_say(sh, data, columns->turned ? TURNED_FN : "");
    q->column = columns->column;
    q->columns = columns->count;
    q->rows = data->rows;
    return true;
}

static bool read_loop(shell *sh, const lexer *lx, const parsed *all, const given_clause *along,
                      fit_question *q, csv *data) {
    calc_error *error = lx->error;
    if (!columns_read(lx, all, along, data))
        return false;
    const bool force = csv_find(data, "FN"), depth = !force && csv_find(data, "dz");
    q->loop.normal_by = depth ? BY_DISPLACEMENT : BY_FORCE;
    q->loop.rig = columns_at_rig(sh, data);
    csv_values *dx, *Fx, *normal = NULL;
    if (columns_of_loop(data, q->loop.rig, &dx, &Fx, error) && (depth || force))
        normal =
            depth ? columns_take(data, "dz", DIM_LENGTH, error) : columns_take(data, "FN", DIM_FORCE, error);
    if ((!csv_find(data, "dx") && !q->loop.rig) || !csv_find(data, "Fx"))
        calc_append(&sh->calc, error, " (a loop needs dx and Fx, and may have FN or dz)");
    if (error->raised || !csv_settle(data, error))
        return given_place(error, along);
    const bool against = columns_opposed(data, dx, Fx),
               pull = q->loop.normal_by == BY_FORCE && columns_turn_pull(data, normal);
    if (against)
        columns_turn(data, Fx);
    columns_say(sh, data,
                against && pull ? TURNED_FX ", " TURNED_FN
                : against       ? TURNED_FX
                : pull          ? TURNED_FN
                                : "");
    q->rows = data->rows;
    q->loop.dx = dx->v;
    q->loop.Fx = Fx->v;
    q->loop.normal = normal ? normal->v : NULL;
    return true;
}

/* Reads `noise dx=10 nm Fx=0.5 N`, or one of the two. */
static bool read_noise(const lexer *lx, parsed *all, fit_loop *loop) {
    const given_clause *word = parsed_clause(all, "noise", 0),
                       *of[2] = {parsed_clause(all, "dx", 0), parsed_clause(all, "Fx", 0)};
    for (size_t i = 0; i < 2; i++) {
        if (!of[i])
            continue;
        if (!word || !parsed_clause(all, "along", 0))
            return calc_fail(lx->error, of[i]->at, of[i]->len,
                             "%s= tells the noise of a measured loop: along FILE.csv noise %s=...",
                             of[i]->of->name, of[i]->of->name);
        *(i ? &loop->noise_Fx : &loop->noise_dx) = (double)of[i]->v.v;
    }
    return !word || of[0] || of[1] ||
           calc_fail(lx->error, word->at, word->len, "expected dx=10 nm or Fx=0.5 N behind noise");
}

static bool read_fit(shell *sh, lexer *lx, parsed *all, fit_question *q, csv *data, named_columns *columns) {
    const given_clause *along = parsed_clause(all, "along", 0);
    lexer own = hole_lexer(lx, &all->list[0].hole[0]);
    q->c = &sh->calc;
    if (!read_names(sh, &own, q) || !read_noise(lx, all, &q->loop))
        return false;
    if (!along && !parsed_clause(all, "for", 0))
        return lex_fail(lx, "expected for EXPR = EXPR to FILE.csv, or along FILE.csv");
    return along ? read_loop(sh, lx, all, along, q, data) : read_equation(sh, lx, all, q, data, columns);
}

/* ---- fit: reporting ---------------------------------------------------------------------------- */

/* The lower (side < 0) or upper ends of the intervals that are uneven, as a group. */
static void report_ends(answer *out, const fit_question *q, const fit_answer *a, const char *name, int side) {
    bool any = false;
    for (size_t i = 0; i < q->count; i++) {
        if (!a->uneven[i])
            continue;
        if (!any)
            answer_group(out, name);
        any = true;
        answer_number(out, q->name[i].text, a->value[i] + (side < 0 ? -a->below[i] : a->above[i]));
    }
    if (any)
        answer_up(out);
}

static void report_fit(answer *out, const fit_question *q, const fit_answer *a) {
    answer_event(out, "fit");
    answer_number(out, "rows", (double)q->rows);
    answer_number(out, "evaluations", a->evaluations);
    answer_number(out, "iterations", a->iterations);
    answer_number(out, "rms", a->rms);
    answer_number(out, "neighbours", a->together);
    if (a->noisy) {
        answer_quantity(out, "noise_dx", (value){a->noise_dx, DIM_LENGTH});
        answer_quantity(out, "noise_Fx", (value){a->noise_Fx, DIM_FORCE});
        answer_number(out, "turning_points", (double)a->turns);
    }
    answer_group(out, "deviation");
    for (size_t i = 0; i < q->count; i++)
        answer_number(out, q->name[i].text, a->deviation[i]);
    answer_up(out);
    report_ends(out, q, a, "lower", -1);
    report_ends(out, q, a, "upper", 1);
    answer_group(out, "correlation");
    for (size_t i = 0; i < q->count; i++)
        for (size_t j = i + 1; j < q->count; j++) {
            char pair[2 * LEX_NAME + 2];
            snprintf(pair, sizeof pair, "%s,%s", q->name[i].text, q->name[j].text);
            answer_number(out, pair, a->correlation[i][j]);
        }
    answer_up(out);
    answer_done(out);
}

/* Says in words what report_fit has for programs, and adds notes on how to judge it. */
static void remark_fit(shell *sh, answer *out, const fit_question *q, const fit_answer *a) {
    char rms[COLUMN_UNIT + NUMBER_TEXT];
    for (size_t i = 0; i < q->count; i++)
        for (size_t j = i + 1; j < q->count; j++) {
            answer_words(out, "correlation of %s and %s = %.3g\n", q->name[i].text, q->name[j].text,
                         a->correlation[i][j]);
            if (fabs(a->correlation[i][j]) <= 0.99)
                continue;
            const char *instead = determined_instead(q->name[i].text, q->name[j].text);
            shell_note(sh, "the data hardly tell %s and %s apart%s%s", q->name[i].text, q->name[j].text,
                       instead ? ": " : "", instead ? instead : "");
        }
    format_value(&sh->set, (value){a->rms, a->d}, rms, sizeof rms);
    answer_words(out, "rms = %s%s over %zu rows\n", rms, a->noisy ? " times the noise" : "", q->rows);
    if (a->noisy) {
        char dx[CALC_VALUE_TEXT], Fx[CALC_VALUE_TEXT];
        calc_value_text(DIM_LENGTH, a->noise_dx, dx);
        calc_value_text(DIM_FORCE, a->noise_Fx, Fx);
        answer_words(out, "noise of dx = %s, of Fx = %s; %zu turning point%s fitted as well\n", dx, Fx,
                     a->turns, a->turns == 1 ? "" : "s");
    }
    for (size_t i = 0; i < q->count; i++)
        if (a->uneven[i] && !isinf(a->above[i]) != !isinf(a->below[i]))
            shell_note(sh, "the data give only a bound of %s from %s", q->name[i].text,
                       isinf(a->above[i]) ? "below" : "above");
        else if (a->uneven[i] && !isinf(a->above[i]))
            shell_note(
                sh,
                "the errors of %s down and up differ: each goes to where the least sum of squares with it "
                "fixed there is one variance larger",
                q->name[i].text);
    for (size_t i = 0; i < q->count; i++)
        if (a->deviation[i] > fabs(a->value[i]))
            shell_note(sh, "the data hardly determine %s", q->name[i].text);
    if (a->drifts)
        shell_note(
            sh,
            "residuals are correlated from row to row (coefficient %.2f): a drift, an offset or a model "
            "that does not fit; the standard errors are too small",
            a->together);
    if (a->twice)
        shell_note(sh, "the path begins within a steady cycle, not at rest: it is run twice, and the second "
                       "run compared");
    else if (!q->sides && fabs(q->loop.Fx[0]) > 6 * a->noise_Fx)
        shell_note(sh, "the first row is taken as reached from rest");
    if (sh->set.timing)
        shell_say(sh, "fit: Levenberg and Marquardt's method, %u iterations, %u evaluations of %zu rows",
                  a->iterations, a->evaluations, q->rows);
}

static estimate estimate_of(const fit_answer *a, size_t i) {
    return (estimate){a->value[i], a->deviation[i], a->uneven[i], a->below[i], a->above[i]};
}

static bool print_fit(shell *sh, const fit_question *q, const fit_answer *a, calc_error *error) {
    answer out;
    column c[FIT_NAMES] = {{.name = NULL}};
    bool ok = true;
    answer_begin(&out, &sh->set, sh->out);
    for (size_t i = 0; i < q->count; i++)
        ok &= column_si(&c[i], q->name[i].text, q->name[i].d);
    for (size_t i = 0; i < q->count && ok; i++) {
        const estimate e = estimate_of(a, i);
        answer_estimate(&out, &c[i], &e);
    }
    if (ok)
        report_fit(&out, q, a);
    ok = (answer_end(&out, ok) && ok) || calc_no_memory(error);
    if (ok) {
        calc_answered(&sh->calc, (value){a->value[q->count - 1], q->name[q->count - 1].d});
        remark_fit(sh, &out, q, a);
    }
    columns_free(c, q->count);
    return ok;
}

/* ---- fit: by cycle ----------------------------------------------------------------------------- */

enum { CYCLE_COLUMNS = 2 * FIT_NAMES + 4 };

static void cycle_columns(const fit_question *q, si_table *t) {
    char name[2 * LEX_NAME];
    table_column(t, "cycle", DIM_NONE);
    table_column(t, "line", DIM_NONE);
    for (size_t i = 0; i < q->count; i++) {
        snprintf(name, sizeof name, "%s deviation", q->name[i].text);
        table_column(t, q->name[i].text, q->name[i].d);
        table_column(t, name, q->name[i].d);
    }
    table_column(t, "dW", DIM_ENERGY);
    table_column(t, "slides", DIM_NONE);
}

/* Fits one cycle. from: where the search starts, the result of the cycle before; or NULL. */
static bool fit_cycle(const fit_question *q, const loop_cycle *c, const double *from, fit_answer *a,
                      calc_error *error) {
    fit_question one = *q;
    const bool whole = c->last < c->first;
    const size_t first = whole ? 0 : c->first;
    one.rows = whole ? q->rows : c->last - c->first + 1;
    one.loop.dx += first;
    one.loop.Fx += first;
    if (one.loop.normal)
        one.loop.normal += first;
    one.loop.steady = true;
    one.from = from;
    return fit(&one, a, error);
}

static bool cycle_rows(shell *sh, answer *out, const fit_question *q, const csv *data, const loop_answer *l,
                       calc_error *error) {
    double from[FIT_NAMES] = {0};
    size_t fitted = 0;
    calc_error first = ERROR_NONE;
    for (size_t k = 0; k < l->cycles; k++) {
        const loop_cycle *c = &l->cycle[k];
        fit_answer a = {.rms = 0};
        long double row[CYCLE_COLUMNS] = {(long double)(k + 1), (long double)data->row[c->first].line};
        calc_error why = ERROR_NONE;
        const bool ok = fit_cycle(q, c, fitted ? from : NULL, &a, &why);
        if (why.stop)
            return *error = why, false;
        if (!ok && !first.raised)
            first = why;
        for (size_t i = 0; i < q->count; i++) {
            row[2 + 2 * i] = ok ? a.value[i] : (double)NAN;
            row[3 + 2 * i] = ok ? a.deviation[i] : (double)NAN;
            from[i] = ok ? a.value[i] : from[i];
        }
        row[2 + 2 * q->count] = c->dW;
        row[3 + 2 * q->count] = c->slides;
        answer_row(out, row);
        fitted += ok;
    }
    if (!fitted)
        return *error = first, false;
    calc_answered(&sh->calc, (value){from[q->count - 1], q->name[q->count - 1].d});
    if (fitted < l->cycles)
        shell_note(sh, "%zu of %zu cycles have no values: %s", l->cycles - fitted, l->cycles, first.text);
    return true;
}

static bool fit_by_cycle(shell *sh, lexer *lx, parsed *all, const fit_question *q, const csv *data) {
    loop_answer l;
    si_table t;
    bool ok = loop_find(q->loop.dx, q->loop.Fx, q->rows, &l, lx->error) && table_open(sh, lx, all, &t);
    if (ok) {
        cycle_columns(q, &t);
        ok = table_begin(sh, &t, "cycles", lx->error) && cycle_rows(sh, &t.a, q, data, &l, lx->error);
        ok = table_close(sh, lx, &t, ok);
    }
    loop_free(&l);
    return ok;
}

static bool is_by_cycle(const lexer *lx, parsed *all) {
    const given_clause *by = parsed_clause(all, "by", 0);
    char word[LEX_NAME] = "";
    if (by)
        hole_word(lx, by, word);
    if (by && (strcmp(word, "cycle") || !parsed_clause(all, "along", 0)))
        calc_fail(lx->error, by->at, by->len,
                  "by cycle gives a row for each cycle of a measured loop: along FILE.csv by cycle");
    return by != NULL;
}

/* ---- the figure -------------------------------------------------------------------------------- */

/* The last fit, kept for its figure. */
struct fitted {
    fit_question q; /* do not use q.sides but as a flag: the expressions have gone with their statement */
    csv data;
    named_columns columns;
    fit_answer a;
    fit_points points;
    char ordinate[COLUMN_UNIT]; /* name of the ordinate: the left side of the equation, or Fx */
};

static void fitted_free(struct fitted *f) {
    if (f) {
        fit_points_free(&f->points);
        csv_free(&f->data);
    }
    free(f);
}

void fit_forget(shell *sh) {
    fitted_free(sh->fitted);
    sh->fitted = NULL;
}

/* The abscissa of an equation: the only column that is not its left side; NULL if there are several: rows. */
static const column_knob *abscissa(const fit_question *q) {
    const column_knob *found = NULL;
    for (size_t j = 0; j < q->columns; j++) {
        size_t same = 0;
        while (same < q->rows && q->column[j].v[same] == q->points->left[same])
            same++;
        if (same < q->rows && found)
            return NULL;
        found = same < q->rows ? &q->column[j] : found;
    }
    return found;
}

static double abscissa_at(const fit_question *q, const column_knob *over, size_t row) {
    return !q->sides ? q->loop.dx[row] : over ? over->v[row] : (double)(row + 1);
}

static bool add_rows(const struct fitted *f, plot_panel *p, const char *title, const double *y,
                     calc_error *error) {
    const column_knob *over = abscissa(&f->q);
    plot_series *s = plot_series_add(p, PLOT_MEASURED, title, error);
    for (size_t i = 0; s && i < f->q.rows; i++)
        if (!plot_point(s, abscissa_at(&f->q, over, i), y[i]))
            return calc_no_memory(error);
    return s;
}

typedef struct place {
    double x, y;
} place;

static bool add_curve(const struct fitted *f, plot_series *s, calc_error *error) {
    const fit_points *k = &f->points;
    const column_knob *over = abscissa(&f->q);
    const size_t n = k->nodes ? k->nodes : f->q.rows;
    place *at = malloc(n * sizeof *at);
    bool ok = at;
    for (size_t i = 0; ok && i < n; i++)
        at[i] = k->nodes ? (place){k->x[i], k->y[i]} : (place){abscissa_at(&f->q, over, i), k->right[i]};
    if (ok && f->q.sides)
        qsort(at, n, sizeof *at, fret_ascending);
    for (size_t i = 0; ok && i < n; i++)
        ok = plot_point(s, at[i].x, at[i].y);
    free(at);
    return ok || calc_no_memory(error);
}

static bool finish_axes(lexer *lx, const struct fitted *f, const looks *l, plot_panel *p,
                        const axis_of *ordinate) {
    const column_knob *over = abscissa(&f->q);
    const axis_of x = {.name = !f->q.sides ? loop_column(f->q.loop.rig)
                               : over      ? over->name.text
                                           : "row",
                       .d = !f->q.sides ? DIM_LENGTH
                            : over      ? over->name.d
                                        : DIM_NONE};
    return looks_axis(lx, l, p, true, &x) && looks_axis(lx, l, p, false, ordinate);
}

/* One entry of the key for each name, all in the style of the curve; only the first has its points. */
bool figure_fit(shell *sh, lexer *lx, parsed *all, plot_panel *p, const looks *l) {
    const struct fitted *f = sh->fitted;
    (void)all;
    if (!f)
        return calc_fail(lx->error, 0, 0, "there is no fit yet: fit INPUT, ... along FILE.csv");
    bool ok = add_rows(f, p, columns_file(&f->data), f->points.left, lx->error);
    for (size_t i = 0; i < f->q.count && ok; i++) {
        const knob *k = &f->q.name[i];
        const estimate e = estimate_of(&f->a, i);
        char text[ESTIMATE_TEXT], words[LEX_NAME + ESTIMATE_TEXT];
        format_estimate(&(column){.d = k->d}, sh->set.digits, &e, text);
        snprintf(words, sizeof words, PLOT_EXPR "%s" PLOT_END " = %s", k->text, text);
        plot_series *s = plot_series_add(p, PLOT_CURVE, words, lx->error);
        if (s)
            s->style = 0;
        ok = s && (i || add_curve(f, s, lx->error));
    }
    p->airy = true;
    return ok &&
           finish_axes(lx, f, l, p, &(axis_of){.name = f->ordinate, .d = f->q.sides ? f->a.d : DIM_FORCE});
}

bool figure_fit_residuals(shell *sh, lexer *lx, parsed *all, plot_panel *p, const looks *l) {
    const struct fitted *f = sh->fitted;
    const looks plain = {.sh = l->sh};
    char title[COLUMN_UNIT + NUMBER_TEXT + 60], rms[COLUMN_UNIT + NUMBER_TEXT];
    const bool noisy = f->a.noisy;
    (void)all;
    format_value(&sh->set, (value){f->a.rms, f->a.d}, rms, sizeof rms);
    snprintf(title, sizeof title, "left over: rms = %s%s", rms, noisy ? " of the noise" : "");
    p->title = strdup(title);
    p->ylabel = noisy ? strdup("distance/noise") : NULL;
    if (!p->title || (noisy && !p->ylabel))
        return calc_no_memory(lx->error);
    p->airy = true;
    return add_rows(f, p, NULL, f->points.residual, lx->error) &&
           finish_axes(lx, f, &plain, p, &(axis_of){.name = "residual", .d = f->a.d});
}

/* ---- the command ------------------------------------------------------------------------------- */

bool do_fit(shell *sh, lexer *lx, parsed *all) {
    struct fitted *f = calloc(1, sizeof *f);
    bool ok = (f || calc_no_memory(lx->error)) && read_fit(sh, lx, all, &f->q, &f->data, &f->columns);
    if (ok && is_by_cycle(lx, all)) {
        ok = !lx->error->raised && fit_by_cycle(sh, lx, all, &f->q, &f->data);
    } else if (ok) {
        const expr *left = f->q.sides;
        snprintf(f->ordinate, sizeof f->ordinate, "%.*s", left ? LEX_SHOWN(left->len) : 2,
                 left ? left->text + left->at : "Fx");
        f->q.points = &f->points;
        ok = fit(&f->q, &f->a, lx->error) && print_fit(sh, &f->q, &f->a, lx->error);
        if (ok) {
            fit_forget(sh);
            sh->fitted = f;
            file_in_close(&f->data.in); /* of another statement the file may be the target */
        }
    }
    if (sh->fitted != f)
        fitted_free(f);
    return ok;
}
