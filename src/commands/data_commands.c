/* SPDX-License-Identifier: GPL-3.0-or-later */
/* fit and uncertainty: values with how sure they are. They leave the scene as it is. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "commands/columns.h"
#include "commands/expressions.h"
#include "commands/range.h"
#include "commands/study_commands.h"
#include "statement/progress.h"
#include "statement/target.h"
#include "study/fit.h"
#include "study/loop.h"
#include "study/uncertainty.h"

const char study_library[] = "";

/* As `ans`. */
static void answered(shell *sh, long double v, dim d) {
    sh->calc.ans = (value){v, d};
    sh->calc.has_ans = true;
}

/* ---- fit: what is read ------------------------------------------------------------------------- */

/* A name that is to be found needs a value to start from. */
static bool read_names(shell *sh, lexer *lx, fit_question *q) {
    for (;;) {
        if (q->count == FIT_NAMES)
            return lex_fail(lx, "more than %d names", FIT_NAMES);
        const size_t at = lx->at;
        if (!knob_known(&sh->calc, lx, &q->name[q->count++]))
            return false;
        if (ask_repeats(q->name, q->count))
            return calc_fail(lx->error, at, lx->last - at, "%s is given twice", q->name[q->count - 1].text);
        if (lx->kind != T_COMMA)
            return at_end(lx);
        lex_next(lx);
    }
}

/* A quantity in the equation that is also a column, whose rows it does not take: one of them was meant. */
static bool ambiguous(const shell *sh, csv *data, const expr *e, calc_error *error) {
    const quantity *of;
    bool call;
    size_t at;
    for (size_t i = 0; (of = expr_quantity(e, i, &call, &at)); i++) {
        const bool is_input = quantity_is_input(of);
        if (call || !csv_has(data, of->name) ||
            (is_input && calc_takes(&sh->calc, quantity_input(of), error_quiet())))
            continue;
        calc_fail(error, e->at, e->len,
                  is_input ? "%s is an input that this scene does not take, and a column of the file: rename "
                             "the column"
                           : "%s is a result of the scene and a column of the file: rename the column",
                  of->name);
        return true;
    }
    return false;
}

static bool read_side(shell *sh, const lexer *lx, const span *part, expr *e) {
    lexer own = hole_lexer(lx, part);
    return expr_parse_at(&sh->calc, &own, e) && at_end(&own);
}

static bool read_equation(shell *sh, lexer *lx, said *all, const choices *chosen, fit_question *q, csv *data,
                          named_columns *columns, size_t names) {
    const heard *sides = said_of(all, "for", 0), *to = said_of(all, "to", 0);
    char layout[CALC_ERROR_TEXT / 2];
    _Static_assert((int)CSV_COLUMNS <= (int)FIT_COLUMNS, "all columns of a file are names");
    if (!to)
        return lex_fail(lx, "expected to FILE.csv");
    if (!columns_read(lx, &to->hole[0], chosen, data) || !columns_wake(sh, data, names, columns, lx->error))
        return false;
    q->left = &sh->list[0];
    q->right = &sh->list[1];
    if (!read_side(sh, lx, &sides->hole[0], &sh->list[0]) ||
        !read_side(sh, lx, &sides->hole[1], &sh->list[1]))
        return columns_missed(sh, lx, data);
    if (ambiguous(sh, data, q->left, lx->error) || ambiguous(sh, data, q->right, lx->error) ||
        !columns_load(sh, data, 2, columns, lx->error))
        return false;
    csv_layout(data, layout, sizeof layout);
    if (!columns->used)
        return calc_fail(lx->error, q->left->at, q->right->at + q->right->len - q->left->at,
                         "no column of %.100s is in the equation: %s", data->path, layout);
    columns_say(sh, data, columns->turned ? TURNED_FN : "");
    q->column = columns->column;
    q->columns = columns->count;
    q->rows = data->rows;
    return true;
}

static bool read_loop(shell *sh, const lexer *lx, const heard *along, const choices *chosen, fit_question *q,
                      csv *data) {
    calc_error *error = lx->error;
    if (!columns_read(lx, &along->hole[0], chosen, data))
        return false;
    const char *by = csv_has(data, "FN") ? "FN" : csv_has(data, "dz") ? "dz" : NULL;
    q->loop.normal_by = by && by[0] == 'd' ? BY_DISPLACEMENT : BY_FORCE;
    long double K_rig;
    const bool contact = csv_has(data, "dx") || !scene_get(&sh->calc.scene, IN_K_RIG, &K_rig, error_quiet());
    q->loop.rig = csv_has(data, "drig") || !contact;
    csv_values *dx = columns_take(data, q->loop.rig ? "drig" : "dx", DIM_LENGTH, error),
               *Fx = dx ? columns_take(data, "Fx", DIM_FORCE, error) : NULL,
               *normal =
                   Fx && by ? columns_take(data, by, by[0] == 'd' ? DIM_LENGTH : DIM_FORCE, error) : NULL;
    if ((!csv_has(data, "dx") && !q->loop.rig) || !csv_has(data, "Fx"))
        calc_append(&sh->calc, error, " (a loop needs dx and Fx, and may have FN or dz)");
    if (error->raised || !csv_settle(data, error))
        return heard_place(error, along);
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

/* `noise dx=10 nm Fx=0.5 N`, or one of them. */
static bool read_noise(const lexer *lx, said *all, fit_loop *loop) {
    const heard *word = said_of(all, "noise", 0), *of[2] = {said_of(all, "dx", 0), said_of(all, "Fx", 0)};
    for (size_t i = 0; i < 2; i++) {
        if (!of[i])
            continue;
        if (!word || !said_of(all, "along", 0))
            return calc_fail(lx->error, of[i]->at, of[i]->len,
                             "%s= tells the noise of a measured loop: along FILE.csv noise %s=...",
                             of[i]->of->name, of[i]->of->name);
        *(i ? &loop->noise_Fx : &loop->noise_dx) = (double)of[i]->v.v;
    }
    return !word || of[0] || of[1] ||
           calc_fail(lx->error, word->at, word->len, "expected dx=10 nm or Fx=0.5 N behind noise");
}

static bool read_fit(shell *sh, lexer *lx, said *all, fit_question *q, csv *data, named_columns *columns,
                     size_t names) {
    const heard *along = said_of(all, "along", 0);
    lexer own = hole_lexer(lx, &all->list[0].hole[0]);
    choices chosen;
    q->c = &sh->calc;
    if (!read_names(sh, &own, q) || !choices_of(all, NULL, &chosen, lx->error) ||
        !read_noise(lx, all, &q->loop))
        return false;
    if (!along && !said_of(all, "for", 0))
        return lex_fail(lx, "expected for EXPR = EXPR to FILE.csv, or along FILE.csv");
    return along ? read_loop(sh, lx, along, &chosen, q, data)
                 : read_equation(sh, lx, all, &chosen, q, data, columns, names);
}

/* ---- fit: what is said ------------------------------------------------------------------------- */

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

/* What the event has is said in words to readers; what to think of it, to all. */
static void remark_fit(shell *sh, answer *out, const fit_question *q, const fit_answer *a) {
    char rms[COLUMN_UNIT + NUMBER_TEXT];
    for (size_t i = 0; i < q->count; i++)
        for (size_t j = i + 1; j < q->count; j++) {
            answer_words(out, "correlation of %s and %s = %.3g\n", q->name[i].text, q->name[j].text,
                         a->correlation[i][j]);
            if (fabs(a->correlation[i][j]) <= 0.99)
                continue;
            const char *instead = fit_instead(q->name[i].text, q->name[j].text);
            shell_note(sh, "the data hardly tell %s and %s apart%s%s", q->name[i].text, q->name[j].text,
                       instead ? ": " : "", instead ? instead : "");
        }
    format_value(&sh->set, (value){a->rms, a->d}, rms, sizeof rms);
    answer_words(out, "rms = %s%s over %zu rows\n", rms, a->noisy ? " of the noise" : "", q->rows);
    if (a->noisy) {
        char dx[CALC_VALUE_TEXT], Fx[CALC_VALUE_TEXT];
        calc_value_text(DIM_LENGTH, a->noise_dx, dx);
        calc_value_text(DIM_FORCE, a->noise_Fx, Fx);
        answer_words(out, "noise of dx = %s, of Fx = %s; %zu turning point%s found with them\n", dx, Fx,
                     a->turns, a->turns == 1 ? "" : "s");
    }
    for (size_t i = 0; i < q->count; i++)
        if (a->deviation[i] > fabs(a->value[i]))
            shell_note(sh, "the data hardly determine %s", q->name[i].text);
    if (a->drifts)
        shell_note(sh,
                   "residuals go together from row to row (correlation %.2f): a drift, an offset or a model "
                   "that does not fit; the standard errors are too small",
                   a->together);
    if (a->twice)
        shell_note(sh, "the loop is closed and does not begin at rest: run twice, the second time compared");
    if (sh->set.timing)
        shell_say(sh, "fit: Levenberg and Marquardt's method, %u iterations, %u evaluations of %zu rows",
                  a->iterations, a->evaluations, q->rows);
}

static bool print_fit(shell *sh, const fit_question *q, const fit_answer *a, calc_error *error) {
    answer out;
    column c[FIT_NAMES] = {{.name = NULL}};
    bool ok = true;
    answer_begin(&out, &sh->set, sh->out);
    for (size_t i = 0; i < q->count; i++)
        ok &= column_si(&c[i], q->name[i].text, q->name[i].d);
    for (size_t i = 0; i < q->count && ok; i++)
        answer_estimate(&out, &c[i], a->value[i], a->deviation[i]);
    if (ok)
        report_fit(&out, q, a);
    ok = (answer_end(&out, ok) && ok) || calc_no_memory(error);
    if (ok) {
        answered(sh, a->value[q->count - 1], q->name[q->count - 1].d);
        remark_fit(sh, &out, q, a);
    }
    columns_free(c, q->count);
    return ok;
}

/* ---- fit: by cycle ----------------------------------------------------------------------------- */

enum { CYCLE_COLUMNS = 2 * FIT_NAMES + 4 };

static bool cycle_columns(const fit_question *q, column *c) {
    char name[2 * LEX_NAME];
    bool ok = column_si(&c[0], "cycle", DIM_NONE) && column_si(&c[1], "line", DIM_NONE);
    for (size_t i = 0; i < q->count && ok; i++) {
        snprintf(name, sizeof name, "%s deviation", q->name[i].text);
        ok = column_si(&c[2 + 2 * i], q->name[i].text, q->name[i].d) &&
             column_si(&c[3 + 2 * i], name, q->name[i].d);
    }
    return ok && column_si(&c[2 + 2 * q->count], "dW", DIM_ENERGY) &&
           column_si(&c[3 + 2 * q->count], "slides", DIM_NONE);
}

/* Rows of one cycle, begun where the one before has ended. */
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
    one.loop.closed = true;
    one.from = from;
    return fit(&one, a, error);
}

static bool cycle_rows(shell *sh, answer *out, const fit_question *q, const csv *data, const loop_answer *l,
                       calc_error *error) {
    double from[FIT_NAMES] = {0};
    size_t fitted = 0;
    calc_error first, why;
    error_clear(&first);
    for (size_t k = 0; k < l->cycles; k++) {
        const loop_cycle *c = &l->cycle[k];
        fit_answer a = {.rms = 0};
        long double row[CYCLE_COLUMNS] = {(long double)(k + 1), (long double)data->row[c->first].line};
        error_clear(&why);
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
    answered(sh, from[q->count - 1], q->name[q->count - 1].d);
    if (fitted < l->cycles)
        shell_note(sh, "%zu of %zu cycles have no values: %s", l->cycles - fitted, l->cycles, first.text);
    return true;
}

static bool fit_by_cycle(shell *sh, const fit_question *q, const csv *data, calc_error *error) {
    loop_answer l;
    answer out;
    column columns[CYCLE_COLUMNS] = {{.name = NULL}};
    bool ok = loop_find(q->loop.dx, q->loop.Fx, q->rows, &l, error);
    if (ok) {
        answer_begin(&out, &sh->set, sh->out);
        ok = cycle_columns(q, columns) && answer_columns(&out, "cycles", columns, 4 + 2 * q->count);
        const bool rows = ok && cycle_rows(sh, &out, q, data, &l, error);
        ok = (answer_end(&out, rows) && ok) || calc_no_memory(error);
        ok = ok && rows;
    }
    columns_free(columns, CYCLE_COLUMNS);
    loop_free(&l);
    return ok;
}

static bool is_by_cycle(const lexer *lx, said *all) {
    const heard *by = said_of(all, "by", 0);
    char word[LEX_NAME] = "";
    if (by)
        hole_word(lx, by, word);
    if (by && (strcmp(word, "cycle") || !said_of(all, "along", 0)))
        calc_fail(lx->error, by->at, by->len,
                  "by cycle gives a row for each cycle of a measured loop: along FILE.csv by cycle");
    return by != NULL;
}

bool do_fit(shell *sh, lexer *lx, const command *self) {
    const size_t names = sh->calc.names.count;
    fit_question *q = calloc(1, sizeof *q);
    csv data = {0};
    named_columns columns;
    fit_answer a;
    said all;
    bool ok = (q || calc_no_memory(lx->error)) && said_read(sh, lx, command_form(self), &all) &&
              read_fit(sh, lx, &all, q, &data, &columns, names);
    if (ok && is_by_cycle(lx, &all))
        ok = !lx->error->raised && fit_by_cycle(sh, q, &data, lx->error);
    else
        ok = ok && fit(q, &a, lx->error) && print_fit(sh, q, &a, lx->error);
    names_forget(sh, names);
    csv_free(&data);
    free(q);
    return ok;
}

/* ---- uncertainty ------------------------------------------------------------------------------- */

/* `+- 0.02`, `+- 5 %`: a percentage is a part of the value. */
static bool read_deviation(shell *sh, const lexer *of, const span *part, const knob *k, double *out) {
    lexer own = hole_lexer(of, part), *lx = &own;
    value v;
    double now = 0;
    const size_t at = lx->at;
    if (!expr_value_as(&sh->calc, lx, &k->d, &v))
        return false;
    if (lx->text[lx->last - 1] == '%') {
        if (!ask_present(&sh->calc, k, &now))
            return ask_lacks(&sh->calc, k, "", "", lx->error) || calc_place(lx->error, at, lx->last - at);
        v = (value){v.v * fabs(now), k->d};
    }
    *out = (double)v.v;
    return value_dim(lx, k->text, at, lx->last - at, v, k->d) &&
           (v.v > 0 || calc_fail(lx->error, at, lx->last - at, "a deviation must be positive")) && at_end(lx);
}

static bool read_uncertain(shell *sh, const lexer *lx, said *all, uncertainty_question *q) {
    const heard *h, *samples = said_of(all, "samples", 0), *seed = said_of(all, "seed", 0);
    for (size_t i = 0; (h = said_of(all, "with", i)); i++) {
        knob *k = &q->name[q->count];
        const span *name = &h->hole[0];
        lexer own = hole_lexer(lx, name);
        if (q->count == UNCERTAIN_NAMES)
            return lex_fail(&own, "more than %d inputs", UNCERTAIN_NAMES);
        if (!knob_known(&sh->calc, &own, k))
            return false;
        if (ask_repeats(q->name, q->count + 1))
            return calc_fail(lx->error, name->at, name->len, "%s is given twice", k->text);
        if (!read_deviation(sh, lx, &h->hole[1], k, &q->deviation[q->count++]))
            return false;
    }
    if (samples)
        q->samples = samples->count;
    if (seed)
        q->seed = seed->count;
    return true;
}

/* ---- uncertainty: samples of a share, and of a file that has them all -------------------------- */

enum { SAMPLES_COLUMNS = UNCERTAIN_VALUES + 1 };

typedef struct samples_job {
    answer a;
    bool begun, goes_on;
    const uncertainty_answer *of;
    column columns[SAMPLES_COLUMNS];
    size_t count, rows, all;
} samples_job;

/* Values are in SI, whatever unit they are asked in: what is read again is the same. Their names are of a
 * kind that a file of columns can have, and their number comes last: what has been cut off lacks it. */
static bool begin_samples(samples_job *job) {
    char name[CSV_NAME];
    bool ok = true;
    for (size_t k = 0; k < job->count && ok; k++) {
        snprintf(name, sizeof name, "v%zu", k + 1);
        ok = column_si(&job->columns[k], name, job->of->value[k].d);
    }
    ok = ok && column_si(&job->columns[job->count], "sample", DIM_NONE);
    if (job->goes_on)
        answer_goes_on(&job->a, job->columns, job->count + 1);
    return ok && (job->goes_on || answer_columns(&job->a, "samples", job->columns, job->count + 1));
}

static bool give_sample(void *context, size_t sample, const value v[]) {
    samples_job *job = context;
    long double row[SAMPLES_COLUMNS];
    job->a.lost = job->a.lost || (!job->begun && !begin_samples(job));
    job->begun = true;
    if (job->a.lost)
        return false;
    for (size_t k = 0; k < job->count; k++)
        row[k] = v[k].v;
    row[job->count] = (long double)(sample + 1);
    answer_row(&job->a, row);
    progress_part((double)++job->rows / (double)job->all);
    return !ferror(job->a.to); /* the end tells of it */
}

static bool share_samples(shell *sh, uncertainty_question *q, uncertainty_answer *a, calc_error *error) {
    target to = {.to = sh->out, .format = sh->set.format};
    samples_job job = {.of = a, .count = q->expressions};
    if (!target_share(sh, &to, q->samples, &q->from, &q->to, error))
        return false;
    q->take = give_sample;
    q->context = &job;
    job.all = q->to - q->from;
    job.goes_on = target_goes_on(sh, &to);
    answer_begin_as(&job.a, &sh->set, to.to, to.format);
    const bool ok = uncertainty(q, a, error);
    progress_wipe();
    if (!answer_end(&job.a, ok))
        calc_no_memory(error);
    if (ok && a->missing.raised)
        shell_note(sh, "some samples lack a value: %s", a->missing.text);
    columns_free(job.columns, SAMPLES_COLUMNS);
    return target_close(sh, NULL, &to, ok && !error->raised);
}

/* All samples are there, in their order, and every value, or that there is none. */
static bool take_given(csv *file, uncertainty_question *q, const csv_values *given[], const double *values[],
                       calc_error *error) {
    const csv_values *number = csv_column(file, "sample", error);
    if (!number)
        return false;
    if (file->columns != q->expressions + 1)
        return calc_fail(error, 0, 0, "%.200s holds no samples of %zu values", file->path, q->expressions);
    for (size_t i = 0; i < file->rows || i < q->samples; i++)
        if (i >= file->rows || i >= q->samples || number->v[i] != (double)(i + 1))
            return calc_fail(
                error, 0, 0,
                "%.200s:%zu: expected sample %zu of %u: the file takes all shares, in their order",
                file->path, file->row[i < file->rows ? i : file->rows - 1].line, i + 1, q->samples);
    for (size_t k = 0; k < q->expressions; k++) {
        char name[CSV_NAME];
        snprintf(name, sizeof name, "v%zu", k + 1);
        given[k] = csv_column(file, name, error);
        if (!given[k])
            return false;
        values[k] = given[k]->v;
    }
    q->given = values;
    return true;
}

static bool sum_given(const lexer *lx, uncertainty_question *q, uncertainty_answer *a, const heard *from) {
    const csv_values *given[UNCERTAIN_VALUES];
    const double *values[UNCERTAIN_VALUES];
    char name[FILE_NAME], is[128], has[128];
    csv file = {0};
    bool ok =
        hole_file(lx, &from->hole[0], name) &&
        ((csv_read(name, &shell_stop, &file, lx->error) && take_given(&file, q, given, values, lx->error)) ||
         heard_place(lx->error, from)) &&
        uncertainty(q, a, lx->error);
    for (size_t k = 0; k < q->expressions && ok; k++) {
        dim_describe(a->value[k].d, is, sizeof is);
        dim_describe(given[k]->d, has, sizeof has);
        ok = dim_equal(a->value[k].d, given[k]->d) ||
             calc_fail(lx->error, q->e[k].at, q->e[k].len, "this is %s, and %s of %.200s is %s", is,
                       given[k]->name, name, has);
    }
    csv_free(&file);
    return ok;
}

/* ---- uncertainty: what is said ----------------------------------------------------------------- */

static void report_uncertain(answer *out, const uncertainty_question *q, const uncertain *u,
                             const column *c) {
    answer_estimate(out, c, u->v, u->deviation);
    answer_event(out, "uncertainty");
    answer_string(out, "of", c->name);
    answer_number(out, "deviation", u->deviation);
    answer_group(out, "shares");
    for (size_t i = 0; i < q->count; i++)
        answer_share(out, q->name[i].text, u->share[i]);
    answer_up(out);
    answer_group(out, "Monte Carlo");
    answer_number(out, "mean", u->mean);
    answer_number(out, "deviation", u->spread);
    answer_number(out, "samples", u->samples);
    answer_flag(out, "differs", u->differs);
    answer_up(out);
    answer_done(out);
}

/* Where samples say something else, and where they say nothing. */
static void remark_uncertain(shell *sh, answer *out, const uncertainty_question *q, const uncertain *u,
                             const column *c, const char *missing) {
    column sampled = *c;
    char name[] = "Monte Carlo";
    sampled.name = name;
    if (u->differs && !answer_beside(out, &sampled, u->mean, u->spread)) {
        char mean[CALC_VALUE_TEXT], spread[CALC_VALUE_TEXT];
        calc_value_text(u->d, u->mean, mean);
        calc_value_text(u->d, u->spread, spread);
        shell_note(sh, "the Monte Carlo says something else of %s: mean %s, deviation %s", c->name, mean,
                   spread);
    }
    if (u->samples < q->samples)
        shell_note(sh, "%u of %u samples of %s %s no value: %s", q->samples - u->samples, q->samples, c->name,
                   q->samples - u->samples > 1 ? "have" : "has", q->given ? "the file has none" : missing);
}

static bool print_uncertain(shell *sh, const uncertainty_question *q, const uncertainty_answer *a,
                            column *columns, calc_error *error) {
    const uncertain *last = &a->value[q->expressions - 1];
    answer out;
    for (size_t k = 0; k < q->expressions; k++) {
        const uncertain *u = &a->value[k];
        if (!column_fits(&q->e[k], &columns[k], (value){u->v, u->d}, error) ||
            !column_fits(&q->e[k], &columns[k], (value){u->deviation, u->d}, error))
            return false;
    }
    answer_begin(&out, &sh->set, sh->out);
    for (size_t k = 0; k < q->expressions; k++) {
        report_uncertain(&out, q, &a->value[k], &columns[k]);
        remark_uncertain(sh, &out, q, &a->value[k], &columns[k], a->missing.text);
    }
    if (!answer_end(&out, true))
        return calc_no_memory(error);
    answered(sh, last->v, last->d);
    if (sh->set.timing)
        shell_say(sh, "uncertainty: differences of sixth order and %u samples (seed %u), %u evaluations",
                  q->samples, q->seed, a->evaluations);
    return true;
}

/* A swinging normal force takes a thousand times as long. */
static unsigned usual_samples(shell *sh) {
    const load_reach *reach = &(load_reach){.swings = false};
    scene_reach(&sh->calc.scene, &reach, error_quiet());
    return reach->swings ? 200 : 10000;
}

bool do_uncertainty(shell *sh, lexer *lx, const command *self) {
    uncertainty_question q = {.c = &sh->calc, .e = sh->list, .samples = usual_samples(sh), .seed = 1};
    uncertainty_answer *a = calloc(1, sizeof *a);
    column columns[UNCERTAIN_VALUES];
    said all;
    bool ok = (a || calc_no_memory(lx->error)) && said_read(sh, lx, command_form(self), &all);
    ok = ok && read_expressions_in(sh, lx, &all.list[0].hole[0], columns, UNCERTAIN_VALUES, &q.expressions);
    ok = ok && read_uncertain(sh, lx, &all, &q);
    const heard *from = ok ? said_of(&all, "from", 0) : NULL;
    if (ok && sh->share.of && !from)
        ok = share_samples(sh, &q, a, lx->error);
    else
        ok = ok && (from ? sum_given(lx, &q, a, from) : uncertainty(&q, a, lx->error)) &&
             print_uncertain(sh, &q, a, columns, lx->error);
    columns_free(columns, q.expressions);
    free(a);
    return ok;
}
