/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inverse questions: solve, maximize, minimize, uncertainty. They do not change the scene. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "commands/columns.h"
#include "commands/expressions.h"
#include "commands/range.h"
#include "commands/tables.h"
#include "statement/command.h"
#include "statement/progress.h"
#include "study/optimise.h"
#include "study/solve.h"
#include "study/uncertainty.h"

/* ---- answers ----------------------------------------------------------------------------------- */

/* Answers with these values; the last becomes `ans`. */
static bool print_answers(shell *sh, column *columns, const long double *si, size_t count,
                          calc_error *error) {
    if (!answer_values(&sh->set, sh->out, columns, si, count))
        return calc_no_memory(error);
    calc_answered(&sh->calc, (value){si[count - 1], columns[count - 1].d});
    return true;
}

/* Sets up the column of a name's value. */
static bool knob_column(column *c, const knob *k, calc_error *error) {
    return column_si(c, k->text, k->d) || calc_no_memory(error);
}

/* ---- solve ------------------------------------------------------------------------------------- */

static bool read_solve(shell *sh, const lexer *lx, parsed *all, solve_question *q) {
    sweep_range ends = {.lo = 0};
    const given_clause *equation = parsed_clause(all, "for", 0), *from = parsed_clause(all, "from", 0);
    lexer own = hole_lexer(lx, &all->list[0].hole[0]);
    if (!knob_read(&sh->calc, &own, &q->name) || !read_sides(sh, lx, equation))
        return false;
    q->c = &sh->calc;
    q->sides = sh->list;
    q->given = from;
    if (!from)
        return true;
    if (!range_read_interval(sh, lx, &from->hole[0], &q->name, "to", &ends))
        return false;
    q->lo = (double)ends.lo;
    q->hi = (double)ends.hi;
    q->name.d = ends.d;
    return true;
}

static void report_solve(shell *sh, const solve_question *q, const solve_answer *a) {
    char lo[CALC_VALUE_TEXT], hi[CALC_VALUE_TEXT];
    answer event;
    answer_begin(&event, &sh->set, sh->out);
    answer_event(&event, "solve");
    answer_string(&event, "method", "secant");
    answer_number(&event, "evaluations", a->evaluations);
    answer_items(&event, "bracket");
    answer_number(&event, NULL, a->lo);
    answer_number(&event, NULL, a->hi);
    answer_up(&event);
    if (a->level) {
        answer_items(&event, "level");
        answer_number(&event, NULL, a->from);
        answer_number(&event, NULL, a->to);
        answer_up(&event);
    }
    if (a->touches)
        answer_flag(&event, "touches", true);
    if (a->jumps)
        answer_flag(&event, "jumps", true);
    answer_done(&event);
    if (a->touches)
        shell_note(sh, "the two sides touch there without crossing: at most 8 digits are certain");
    if (a->level) {
        calc_value_text(q->name.d, a->from, lo);
        calc_value_text(q->name.d, a->to, hi);
        shell_note(sh, "the two sides are equal for every %s from %s to %s", q->name.text, lo, hi);
    }
    if (a->jumps)
        shell_note(sh, "elsewhere the difference of the two sides jumps through 0; a root close to the jump "
                       "may be missed");
    if (!sh->set.timing)
        return;
    calc_value_text(q->name.d, a->lo, lo);
    calc_value_text(q->name.d, a->hi, hi);
    shell_say(sh, "solve: scan and secant, %u evaluations, bracket %s = %s .. %s", a->evaluations,
              q->name.text, lo, hi);
}

bool do_solve(shell *sh, lexer *lx, parsed *all) {
    solve_question q = {.given = false};
    solve_answer a;
    column c = {.name = NULL};
    bool ok = read_solve(sh, lx, all, &q) && solve(&q, &a, lx->error) && knob_column(&c, &q.name, lx->error);
    ok = ok && print_answers(sh, &c, &(long double){a.x}, 1, lx->error);
    if (ok)
        report_solve(sh, &q, &a);
    columns_free(&c, 1);
    return ok;
}

/* ---- maximize, minimize ------------------------------------------------------------------------ */

static bool read_over(shell *sh, const lexer *lx, parsed *all, optimise_question *q) {
    const given_clause *h;
    for (size_t i = 0; (h = parsed_clause(all, "over", i)); i++) {
        sweep_range ends = {.lo = 0};
        const span *ends_at = &h->hole[1];
        lexer own = hole_lexer(lx, &h->hole[0]);
        if (!read_name(sh, &own, false, OPTIMISE_NAMES, q->name, &q->count) ||
            !range_read_interval(sh, lx, ends_at, &q->name[i], NULL, &ends))
            return false;
        if (!(ends.lo < ends.hi))
            return calc_fail(lx->error, ends_at->at, ends_at->len, "an empty range: LO must be below HI");
        q->name[i].d = ends.d;
        q->lo[i] = (double)ends.lo;
        q->hi[i] = (double)ends.hi;
    }
    return true;
}

static const char *const end_words[] = {"inner", "low", "high", "scene"};

static void report_optimum(shell *sh, const optimise_question *q, const optimise_answer *a,
                           const char *word) {
    answer event;
    answer_begin(&event, &sh->set, sh->out);
    answer_event(&event, word);
    answer_number(&event, "evaluations", a->evaluations);
    answer_flag(&event, "sharp", a->sharp);
    answer_group(&event, "ends");
    for (size_t i = 0; i < q->count; i++)
        answer_string(&event, q->name[i].text, end_words[a->end[i]]);
    answer_up(&event);
    answer_done(&event);
    bool inner = false, edge = false;
    for (size_t i = 0; i < q->count; i++) {
        char there[KNOB_TEXT];
        knob_text(&q->name[i], a->x[i], there);
        inner = inner || a->end[i] == END_INNER;
        if (a->end[i] == END_SCENE && !edge)
            shell_note(sh, "there is no value beyond %s: %s", there, a->why.text);
        edge |= a->end[i] == END_SCENE;
        if (a->end[i] == END_LOW || a->end[i] == END_HIGH)
            shell_note(sh, "no inner optimum in %s: %s is the %s end of its range", q->name[i].text, there,
                       a->end[i] == END_LOW ? "lower" : "upper");
    }
    if (sh->set.timing)
        shell_say(sh, "%s: grid, golden section%s, %u evaluations", word,
                  a->sharp && inner ? ", Newton's method" : "", a->evaluations);
}

static bool optimum(shell *sh, lexer *lx, parsed *all, bool most) {
    optimise_question q = {.c = &sh->calc, .e = &sh->list[0], .most = most};
    optimise_answer a;
    column columns[OPTIMISE_NAMES + 1] = {{.name = NULL}}, optimised = {.name = NULL};
    long double si[OPTIMISE_NAMES + 1];
    lexer own = hole_lexer(lx, &all->list[0].hole[0]);
    bool ok = read_one_expression(sh, &own, &optimised) && read_over(sh, lx, all, &q) &&
              optimise(&q, &a, lx->error) && column_fits(q.e, &optimised, (value){a.value, a.d}, lx->error);
    for (size_t i = 0; i < q.count && ok; i++) {
        ok = knob_column(&columns[i], &q.name[i], lx->error);
        si[i] = a.x[i];
    }
    columns[q.count] = optimised;
    si[q.count] = ok ? a.value : 0;
    ok = ok && print_answers(sh, columns, si, q.count + 1, lx->error);
    if (ok)
        report_optimum(sh, &q, &a, all->by->command);
    columns_free(columns, q.count + 1);
    return ok;
}

bool do_maximize(shell *sh, lexer *lx, parsed *all) {
    return optimum(sh, lx, all, true);
}

bool do_minimize(shell *sh, lexer *lx, parsed *all) {
    return optimum(sh, lx, all, false);
}

/* ---- uncertainty ------------------------------------------------------------------------------- */

/* Reads `0.02` or `5 %` behind +-; a percentage is one of the present value. */
static bool read_deviation(shell *sh, const lexer *of, const span *part, const knob *k, double *out) {
    lexer own = hole_lexer(of, part), *lx = &own;
    value v;
    double now = 0;
    const size_t at = lx->at;
    if (!expr_value_as(&sh->calc, lx, &k->d, &v))
        return false;
    if (lx->text[lx->last - 1] == '%') {
        if (!knob_present(&sh->calc, k, &now))
            return knob_lacks(&sh->calc, k, "", "", lx->error) || calc_place(lx->error, at, lx->last - at);
        v = (value){v.v * fabs(now), k->d};
    }
    *out = (double)v.v;
    return value_dim(lx, k->text, at, lx->last - at, v, k->d) &&
           (v.v > 0 || calc_fail(lx->error, at, lx->last - at, "a deviation must be positive")) && at_end(lx);
}

static bool count_sample(void *context, size_t sample, const value v[]) {
    const uncertainty_question *q = context;
    (void)v;
    progress_part((double)(sample + 1) / (double)q->to);
    return true;
}

static bool read_uncertain(shell *sh, const lexer *lx, parsed *all, uncertainty_question *q) {
    const given_clause *h, *samples = parsed_clause(all, "samples", 0), *seed = parsed_clause(all, "seed", 0);
    for (size_t i = 0; (h = parsed_clause(all, "with", i)); i++) {
        lexer own = hole_lexer(lx, &h->hole[0]);
        if (!read_name(sh, &own, true, UNCERTAIN_NAMES, q->name, &q->count) ||
            !read_deviation(sh, lx, &h->hole[1], &q->name[i], &q->deviation[i]))
            return false;
    }
    if (samples)
        q->samples = samples->count;
    if (seed)
        q->seed = seed->count;
    q->to = q->samples;
    q->take = count_sample;
    q->context = q;
    return true;
}

/* ---- uncertainty: writing the samples of a share, reading those of all shares ------------------ */

enum { SAMPLES_COLUMNS = UNCERTAIN_VALUES + 1 };

typedef struct samples_job {
    shell *sh;
    si_table t;
    const uncertainty_answer *of;
    size_t count, rows, total;
    calc_error *error;
} samples_job;

/* Values are in SI, so that they are read back the same; columns are called v1, v2, ..., which a file may
 * have; the number of the sample comes last, so that a row cut off lacks it. */
static bool begin_samples(samples_job *job) {
    char name[CSV_NAME];
    for (size_t k = 0; k < job->count; k++) {
        snprintf(name, sizeof name, "v%zu", k + 1);
        table_column(&job->t, name, job->of->value[k].d);
    }
    table_column(&job->t, "sample", DIM_NONE);
    return table_begin(job->sh, &job->t, "samples", job->error);
}

static bool give_sample(void *context, size_t sample, const value v[]) {
    samples_job *job = context;
    long double row[SAMPLES_COLUMNS];
    if (!job->t.begun && !begin_samples(job))
        return false;
    for (size_t k = 0; k < job->count; k++)
        row[k] = v[k].v;
    row[job->count] = (long double)(sample + 1);
    answer_row(&job->t.a, row);
    progress_part((double)++job->rows / (double)job->total);
    return !ferror(job->t.to.to); /* table_close reports it */
}

static bool share_samples(shell *sh, lexer *lx, parsed *all, uncertainty_question *q, uncertainty_answer *a) {
    samples_job job = {.sh = sh, .of = a, .count = q->expressions, .error = lx->error};
    if (!table_open(sh, lx, all, &job.t) ||
        !target_share(sh, &job.t.to, q->samples, &q->from, &q->to, lx->error))
        return false;
    q->take = give_sample;
    q->context = &job;
    job.total = q->to - q->from;
    const bool ok = uncertainty(q, a, lx->error) && !lx->error->raised;
    if (ok && a->missing.raised)
        shell_note(sh, "some samples lack a value: %s", a->missing.text);
    return table_close(sh, lx, &job.t, ok);
}

/* Takes the samples from the file, which must have all of them in order; values may be missing. */
static bool take_given(csv *file, uncertainty_question *q, const csv_values *given[], const double *values[],
                       calc_error *error) {
    const csv_values *number = csv_column(file, "sample", error);
    if (!number)
        return false;
    if (file->columns != q->expressions + 1)
        return calc_fail(error, 0, 0, "%.200s holds no samples of %zu value%s", file->path, q->expressions,
                         q->expressions == 1 ? "" : "s");
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

static bool sum_given(const lexer *lx, const parsed *all, uncertainty_question *q, uncertainty_answer *a,
                      const given_clause *from) {
    const csv_values *given[UNCERTAIN_VALUES];
    const double *values[UNCERTAIN_VALUES];
    char is[128], has[128];
    csv file;
    bool ok = columns_read(lx, all, from, &file) &&
              (take_given(&file, q, given, values, lx->error) || given_place(lx->error, from)) &&
              uncertainty(q, a, lx->error);
    for (size_t k = 0; k < q->expressions && ok; k++) {
        dim_describe(a->value[k].d, is, sizeof is);
        dim_describe(given[k]->d, has, sizeof has);
        ok = dim_equal(a->value[k].d, given[k]->d) ||
             calc_fail(lx->error, q->e[k].at, q->e[k].len, "this is %s, and %s of %.200s is %s", is,
                       given[k]->name, file.path, has);
    }
    csv_free(&file);
    return ok;
}

/* ---- uncertainty: reporting -------------------------------------------------------------------- */

static void report_uncertain(answer *out, const uncertainty_question *q, const uncertain *u,
                             const column *c) {
    answer_estimate(out, c, &(estimate){.v = u->v, .deviation = u->deviation});
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

/* Notes that the Monte Carlo differs from the linear estimate, and that samples have no value. */
static void remark_uncertain(shell *sh, answer *out, const uncertainty_question *q, const uncertain *u,
                             const column *c, const char *missing) {
    column sampled = *c;
    char name[] = "Monte Carlo";
    sampled.name = name;
    if (u->differs && !answer_beside(out, &sampled, &(estimate){.v = u->mean, .deviation = u->spread})) {
        char mean[CALC_VALUE_TEXT], spread[CALC_VALUE_TEXT];
        calc_value_text(u->d, u->mean, mean);
        calc_value_text(u->d, u->spread, spread);
        shell_note(sh, "the Monte Carlo result for %s differs: mean %s, deviation %s", c->name, mean, spread);
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
    calc_answered(&sh->calc, (value){last->v, last->d});
    if (sh->set.timing)
        shell_say(sh, "uncertainty: differences of sixth order and %u samples (seed %u), %u evaluations",
                  q->samples, q->seed, a->evaluations);
    return true;
}

/* The number of samples by default: a run with a swinging normal force, or of wear, takes a thousand times as
 * long. */
static unsigned usual_samples(shell *sh) {
    const load_reach *reach = &(load_reach){.swings = false};
    scene_reach(&sh->calc.scene, &reach, error_quiet());
    return reach->swings || inputs_any(&sh->calc.scene.in, INPUT_BIT(IN_NW)) ? 200 : 10000;
}

bool do_uncertainty(shell *sh, lexer *lx, parsed *all) {
    uncertainty_question q = {.c = &sh->calc, .e = sh->list, .samples = usual_samples(sh), .seed = 1};
    uncertainty_answer *a = calloc(1, sizeof *a);
    column columns[UNCERTAIN_VALUES];
    bool ok = a || calc_no_memory(lx->error);
    ok = ok && read_expressions_in(sh, lx, &all->list[0].hole[0], columns, UNCERTAIN_VALUES, &q.expressions);
    ok = ok && read_uncertain(sh, lx, all, &q);
    const given_clause *from = ok ? parsed_clause(all, "from", 0) : NULL;
    if (ok && sh->share.of && !from)
        ok = share_samples(sh, lx, all, &q, a);
    else
        ok = ok && (from ? sum_given(lx, all, &q, a, from) : uncertainty(&q, a, lx->error)) &&
             print_uncertain(sh, &q, a, columns, lx->error);
    columns_free(columns, q.expressions);
    free(a);
    return ok;
}
