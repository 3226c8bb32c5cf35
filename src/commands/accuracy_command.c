/* SPDX-License-Identifier: GPL-3.0-or-later */
/* accuracy: runs the study of errors and times of all models, answers with it, and draws it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "commands/figures.h"
#include "statement/answer.h"
#include "statement/command.h"
#include "study/accuracy.h"

/* Columns of the answer. */
enum { HEAD_MODEL, HEAD_PARAMETER, HEAD_VALUE, HEAD_ERROR, HEAD_BOUND, HEAD_SECONDS, HEAD_RATIO, HEADS };

/* ---- measuring --------------------------------------------------------------------------------- */

/* Runs the study of the cycle given by FA or dxA, or of the last one. */
static bool run_study(shell *sh, parsed *given, accuracy_study *out, calc_error *error) {
    const given_clause *FA = parsed_clause(given, "FA", 0), *dxA = parsed_clause(given, "dxA", 0),
                       *v = dxA ? dxA : FA, *within = parsed_clause(given, "within", 0);
    const accuracy_load load = {.given = v != NULL,
                                .by_force = !dxA,
                                .amplitude = v ? (double)v->v.v : 0,
                                .seconds = within ? (double)within->v.v : 3};
    bool ok = accuracy_measure(sh->calc.now, &load, out, error);
    const char *blamed = error->raised && error->kind == ERROR_STATUS ? error->status.quantity : NULL;
    if (v && blamed && !strcmp(blamed, "FA")) /* a dxA has no limit to exceed */
        given_place(error, v);
    return ok;
}

/* ---- texts -------------------------------------------------------------------------------------- */

/* The cycle in words: "FA = 20 N at FN = 100 N, the last cycle". */
static void load_text(const shell *sh, const accuracy_study *study, char *buf, size_t size) {
    static const char *const from[] = {[FROM_USER] = "",
                                       [FROM_CYCLE] = ", the last cycle",
                                       [FROM_STEP] = ", that of the last step: no cycle has been run",
                                       [FROM_LIMIT] = ", half of mu*FN: no cycle has been run"};
    char amplitude[160], FN[160];
    const char *name = study->by_force ? "FA" : "dxA";
    format_value(&sh->set, (value){study->amplitude, study->by_force ? DIM_FORCE : DIM_LENGTH}, amplitude,
                 sizeof amplitude);
    format_value(&sh->set, (value){study->FN, DIM_FORCE}, FN, sizeof FN);
    if (study->program)
        snprintf(buf, size, "%s = %s%s of the load program", name, amplitude, from[study->from]);
    else
        snprintf(buf, size, "%s = %s at FN = %s%s", name, amplitude, FN, from[study->from]);
}

static double fastest(const accuracy_study *study) {
    double least = study->row[0].seconds;
    for (size_t i = 1; i < study->count; i++)
        least = fmin(least, study->row[i].seconds);
    return least;
}

static void format_ratio(double ratio, char *buf, size_t size) {
    snprintf(buf, size, ratio < 999.5 ? "%.3g" : "%.0f", ratio);
}

/* "1.2e-05", or "<2e-16" where only a bound is known, which is rounded up. */
static void format_error(const accuracy_row *row, char *buf, size_t size) {
    const double e = (double)row->error;
    if (row->below)
        snprintf(buf, size, "<%.0e", round_up(e));
    else
        snprintf(buf, size, "%.1e", e);
}

/* The first row of springs with an error of 1e-6 at most, or else the one with the smallest error. */
static const accuracy_row *good_springs(const accuracy_study *study) {
    const accuracy_row *best = NULL;
    for (size_t i = 0; i < study->count; i++)
        if (study->row[i].family == FAMILY_SPRINGS &&
            (!best || (best->error > 1e-6L && study->row[i].error < best->error)))
            best = &study->row[i];
    return best;
}

/* What springs cost, a separator, and what `set model auto` picks and why. */
static void advise(const accuracy_study *study, const char *separator, char *buf, size_t size) {
    const accuracy_row *row = &study->row[0], *springs = good_springs(study); /* row 0: what auto picks */
    char error[40], t[40], ratio[40];
    *buf = 0;
    if (springs) {
        format_error(springs, error, sizeof error);
        calc_amount(DIM_TIME, springs->seconds, 3, t, sizeof t);
        const bool slower = springs->seconds >= row->seconds;
        format_ratio(slower ? springs->seconds / row->seconds : row->seconds / springs->seconds, ratio,
                     sizeof ratio);
        snprintf(buf, size, "%lu springs: error %s in %s, %s times as %s as auto%s", springs->size, error, t,
                 ratio, slower ? "long" : "fast", separator);
    }
    format_error(row, error, sizeof error);
    calc_amount(DIM_TIME, row->seconds, 3, t, sizeof t);
    text_add(buf, size, "auto picks: %s (%s): error %s in %s", study->automatic, study->why, error, t);
}

/* ---- printing ---------------------------------------------------------------------------------- */

enum { SHORT = 40 };

/* A row of the table in text. */
#define WORDS_OF_ROW "%-18s %12s %*s %9s %10s %10s\n"

static void say_row(answer *out, const accuracy_study *study, const accuracy_row *row, long double scale) {
    const double ratio = row->seconds / fastest(study);
    char parameter[SHORT] = "", number[NUMBER_TEXT], error[SHORT], t[SHORT], times[SHORT];
    if (row->size)
        snprintf(parameter, sizeof parameter, "%s = %lu", families[row->family].size, row->size);
    number_text(number, out->set->digits, (double)(row->value / scale));
    format_error(row, error, sizeof error);
    calc_amount(DIM_TIME, row->seconds, 3, t, sizeof t);
    format_ratio(ratio, times, sizeof times);
    const answer_cell cells[HEADS] = {
        [HEAD_MODEL] = {.kind = CELL_WORDS, .words = families[row->family].name},
        [HEAD_PARAMETER] = {CELL_NUMBER, .v = {.v = row->size}, .digits = 17},
        [HEAD_VALUE] = {CELL_NUMBER, .v = {.v = row->value}, .digits = 17},
        [HEAD_ERROR] = {CELL_NUMBER, .v = {.v = row->error}, .digits = 3},
        [HEAD_BOUND] = {CELL_FLAG, .v = {.v = row->below}},
        [HEAD_SECONDS] = {CELL_NUMBER, .v = {.v = row->seconds}, .digits = 3},
        [HEAD_RATIO] = {CELL_NUMBER, .v = {.v = ratio}, .digits = 3}};
    answer_cells(out, cells);
    answer_words(out, WORDS_OF_ROW, families[row->family].name, parameter, out->set->digits + 7, number,
                 error, t, times);
}

static void say_table(answer *out, const accuracy_study *study, long double scale, const char *unit_text) {
    char dW[COLUMN_UNIT + 8];
    snprintf(dW, sizeof dW, "dW [%s]", unit_text);
    const int format = out->set->format;
    const column columns[HEADS] = {
        [HEAD_MODEL] = {.name = "model"},
        [HEAD_PARAMETER] = {.name = "parameter"},
        [HEAD_VALUE] = {.name = "value", .unit = "J", .d = DIM_ENERGY},
        [HEAD_ERROR] = {.name = "error"},
        [HEAD_BOUND] = {.name = format == FORMAT_CSV ? "error is a bound" : "bound"},
        [HEAD_SECONDS] = {.name = "seconds", .d = DIM_TIME},
        [HEAD_RATIO] = {.name = "ratio"}};
    if (format != FORMAT_TEXT)
        answer_columns(out, "accuracy", columns, HEADS);
    answer_words(out, WORDS_OF_ROW, "model", "parameter", out->set->digits + 7, dW, "error", "time/cycle",
                 "x fastest");
    for (size_t i = 0; i < study->count; i++)
        say_row(out, study, &study->row[i], scale);
}

static void say_study(shell *sh, const accuracy_study *study) {
    char unit_text[COLUMN_UNIT], load[ACCURACY_TEXT], advice[ACCURACY_TEXT], error[SHORT];
    const long double scale =
        unit_choose(DIM_ENERGY, study->value, sh->set.digits, unit_text, sizeof unit_text);
    const accuracy_row bound = {.error = study->agreement, .below = true};
    answer out;
    answer_begin(&out, &sh->set, sh->out);
    load_text(sh, study, load, sizeof load);
    format_error(&bound, error, sizeof error);
    answer_words(&out, "%s\nreference: %s, %.*g %s, good to %s\n", load, study->reference, sh->set.digits,
                 (double)(study->value / scale), unit_text, error + 1);
    say_table(&out, study, scale, unit_text);
    advise(study, "; ", advice, sizeof advice);
    answer_event(&out, "accuracy");
    answer_string(&out, "advice", advice);
    answer_string(&out, "auto", study->automatic);
    answer_string(&out, "load", load);
    answer_string(&out, "reference", study->reference);
    answer_number(&out, "value", (double)study->value);
    answer_number(&out, "agreement", (double)study->agreement);
    answer_done(&out);
    advise(study, "\n", advice, sizeof advice);
    answer_words(&out, "%s\n", advice);
    answer_end(&out, true);
}

/* Error against time, one curve a model. */
bool figure_accuracy(shell *sh, lexer *lx, parsed *all, plot_panel *p, const looks *l) {
    static const axis_of time = {.name = "time of a cycle [s]"}, loss = {.name = "relative error"};
    accuracy_study study;
    char text[400], load[360];
    plot_series *series = NULL;
    if (!run_study(sh, all, &study, lx->error))
        return false;
    for (size_t i = 0; i < study.count; i++) {
        const accuracy_row *row = &study.row[i];
        if (i == 0 || row->family != row[-1].family)
            series = plot_series_add(p, PLOT_CURVE, families[row->family].name, lx->error);
        if (!series)
            return false;
        if (!plot_point(series, row->seconds, (double)row->error))
            return calc_no_memory(lx->error);
    }
    load_text(sh, &study, load, sizeof load);
    snprintf(text, sizeof text, PLOT_EXPR "dW, %s" PLOT_END, load);
    p->title = p->title ? p->title : strdup(text);
    p->xlabel = p->xlabel ? p->xlabel : strdup(time.name);
    p->ylabel = p->ylabel ? p->ylabel : strdup(loss.name);
    if (!p->title || !p->xlabel || !p->ylabel)
        return calc_no_memory(lx->error);
    p->logx = p->logy = p->points = p->airy = true;
    return looks_lay_over(lx, l, p, &time, &loss) && looks_axis(lx, l, p, true, &time) &&
           looks_axis(lx, l, p, false, &loss);
}

bool do_accuracy(shell *sh, lexer *lx, parsed *all) {
    accuracy_study study;
    if (!run_study(sh, all, &study, lx->error))
        return false;
    if (sh->replaying) /* times differ from run to run */
        fprintf(sh->out, "%c\n", MARK_DRAWING);
    else
        say_study(sh, &study);
    return true;
}
