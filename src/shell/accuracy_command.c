/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command `accuracy`: its arguments, its progress, and the study as text, CSV or JSON. */
#include "shell/accuracy_command.h"

#include <math.h>
#include <string.h>

#include "shell/output.h"
#include "shell/progress.h"

/* ---- measuring --------------------------------------------------------------------------------- */

static void describe_size(const accuracy_row *row, char *buf, size_t size) {
    buf[0] = 0;
    if (row->size)
        snprintf(buf, size, "%s = %lu", families[row->family].size, row->size);
}

static void show_progress(void *context, const accuracy_row *row) {
    char size[40], words[80];
    describe_size(row, size, sizeof size);
    snprintf(words, sizeof words, "measuring %-17s %-11s", families[row->family].name, size);
    (void)context;
    progress_words(words);
}

bool accuracy_study_run(shell *sh, said *given, accuracy_study *out, calc_error *error) {
    const heard *FA = said_of(given, "FA", 0), *dxA = said_of(given, "dxA", 0), *v = dxA ? dxA : FA,
                *within = said_of(given, "within", 0);
    const accuracy_load load = {.given = v != NULL,
                                .by_force = !dxA,
                                .amplitude = v ? (double)v->v.v : 0,
                                .seconds = within ? (double)within->v.v : 3};
    bool ok = accuracy_measure(sh->calc.now, &load, show_progress, NULL, out, error);
    progress_wipe();
    const char *blamed = error->raised && error->kind == ERROR_STATUS ? error->status.quantity : NULL;
    if (v && blamed && !strcmp(blamed, "FA")) /* a dxA has no bound */
        heard_place(error, v);
    return ok;
}

/* ---- words ------------------------------------------------------------------------------------- */

void accuracy_load_text(const shell *sh, const accuracy_study *study, char *buf, size_t size) {
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

static void format_seconds(double t, char *buf, size_t size) {
    static const char *const units[] = {"s", "ms", "us", "ns"};
    int i = 0;
    for (; i < 3 && t < 0.9995; i++)
        t *= 1e3;
    snprintf(buf, size, "%.3g %s", t, units[i]);
}

/* A bound is rounded up. */
static void format_error(const accuracy_row *row, char *buf, size_t size) {
    const double e = (double)row->error;
    if (row->below) {
        const double place = pow(10, floor(log10(e)));
        snprintf(buf, size, "<%.0e", ceil(e / place * (1 - 1e-9)) * place);
    } else {
        snprintf(buf, size, "%.1e", e);
    }
}

/* The first of the springs that err by 1e-6 at most, or the best. */
static const accuracy_row *good_springs(const accuracy_study *study) {
    const accuracy_row *best = NULL;
    for (size_t i = 0; i < study->count; i++)
        if (study->row[i].family == FAMILY_SPRINGS &&
            (!best || (best->error > 1e-6L && study->row[i].error < best->error)))
            best = &study->row[i];
    return best;
}

/* What the springs pay, a separator, and what auto picks and why. */
static void advise(const accuracy_study *study, const char *separator, char *buf, size_t size) {
    const accuracy_row *row = &study->row[0], *springs = good_springs(study); /* auto's choice comes first */
    char error[40], t[40], ratio[40];
    int n = 0;
    if (springs) {
        format_error(springs, error, sizeof error);
        format_seconds(springs->seconds, t, sizeof t);
        const bool slower = springs->seconds >= row->seconds;
        format_ratio(slower ? springs->seconds / row->seconds : row->seconds / springs->seconds, ratio,
                     sizeof ratio);
        n = snprintf(buf, size, "%lu springs: error %s in %s, %s times as %s as auto%s", springs->size, error,
                     t, ratio, slower ? "long" : "fast", separator);
    }
    format_error(row, error, sizeof error);
    format_seconds(row->seconds, t, sizeof t);
    snprintf(buf + n, size - (size_t)n, "auto picks: %s (%s): error %s in %s", study->automatic, study->why,
             error, t);
}

/* ---- printing ---------------------------------------------------------------------------------- */

static void print_text(shell *sh, const accuracy_study *study, const char *load, const char *advice) {
    char unit_text[COLUMN_UNIT], head[COLUMN_UNIT + 8];
    const long double scale =
        unit_choose(DIM_ENERGY, study->value, sh->set.digits, unit_text, sizeof unit_text);
    const int width = sh->set.digits + 7;
    const accuracy_row bound = {.error = study->agreement, .below = true};
    char error[40], parameter[40], t[40], ratio[40];
    if (sh->replaying) { /* times, and what follows from them */
        fprintf(sh->out, "%c\n", MARK_DRAWING);
        return;
    }
    format_error(&bound, error, sizeof error);
    fprintf(sh->out, "%s\nreference: %s, %.*g %s, good to %s\n", load, study->reference, sh->set.digits,
            (double)(study->value / scale), unit_text, error + 1);
    snprintf(head, sizeof head, "dW [%s]", unit_text);
    fprintf(sh->out, "%-18s %12s %*s %9s %10s %10s\n", "model", "parameter", width, head, "error",
            "time/cycle", "x fastest");
    for (size_t i = 0; i < study->count; i++) {
        const accuracy_row *row = &study->row[i];
        describe_size(row, parameter, sizeof parameter);
        format_error(row, error, sizeof error);
        format_seconds(row->seconds, t, sizeof t);
        format_ratio(row->seconds / fastest(study), ratio, sizeof ratio);
        fprintf(sh->out, "%-18s %12s %*.*g %9s %10s %10s\n", families[row->family].name, parameter, width,
                sh->set.digits, (double)(row->value / scale), error, t, ratio);
    }
    fprintf(sh->out, "%s\n", advice);
}

static void print_csv(shell *sh, const accuracy_study *study) {
    fputs("model,parameter,value [J],error,error is a bound,seconds,ratio\n", sh->out);
    for (size_t i = 0; i < study->count; i++) {
        const accuracy_row *row = &study->row[i];
        const char *name = families[row->family].name, *quote = strchr(name, ',') ? "\"" : "";
        fprintf(sh->out, "%s%s%s,%lu,%.17g,%.3g,%d,%.3g,%.3g\n", quote, name, quote, row->size,
                (double)row->value, (double)row->error, row->below, row->seconds,
                row->seconds / fastest(study));
    }
}

static void print_text_member(FILE *to, const char *name, const char *text) {
    fprintf(to, "\"%s\":", name);
    print_json_string(to, text);
    fputc(',', to);
}

static void print_json(shell *sh, const accuracy_study *study, const char *load, const char *advice) {
    for (size_t i = 0; i < study->count; i++) {
        const accuracy_row *row = &study->row[i];
        fputc('{', sh->out);
        print_text_member(sh->out, "model", families[row->family].name);
        fprintf(sh->out,
                "\"parameter\":%lu,\"value\":%.17g,\"error\":%.3g,\"bound\":%s,\"seconds\":%.3g,\"ratio\":%."
                "3g}\n",
                row->size, (double)row->value, (double)row->error, row->below ? "true" : "false",
                row->seconds, row->seconds / fastest(study));
    }
    fputc('{', sh->out);
    print_text_member(sh->out, "advice", advice);
    print_text_member(sh->out, "auto", study->automatic);
    print_text_member(sh->out, "load", load);
    print_text_member(sh->out, "reference", study->reference);
    fprintf(sh->out, "\"value\":%.17g,\"agreement\":%.3g}\n", (double)study->value, (double)study->agreement);
}

bool do_accuracy(shell *sh, lexer *lx, const command *self) {
    accuracy_study study;
    said given;
    char advice[ACCURACY_TEXT], load[ACCURACY_TEXT];
    if (!said_read(sh, lx, command_form(self), &given) || !accuracy_study_run(sh, &given, &study, lx->error))
        return false;
    advise(&study, sh->set.format == FORMAT_TEXT ? "\n" : "; ", advice, sizeof advice);
    accuracy_load_text(sh, &study, load, sizeof load);
    if (sh->set.format == FORMAT_CSV)
        print_csv(sh, &study);
    else if (sh->set.format == FORMAT_JSON)
        print_json(sh, &study, load, advice);
    else
        print_text(sh, &study, load, advice);
    return true;
}
