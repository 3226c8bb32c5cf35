/* SPDX-License-Identifier: GPL-3.0-or-later */
/* fit and uncertainty: values with how sure they are. They leave the scene as it is. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "calc/csv.h"
#include "shell/expressions.h"
#include "shell/range.h"
#include "shell/study_commands.h"
#include "study/fit.h"
#include "study/uncertainty.h"

/* ---- a value and its deviation ----------------------------------------------------------------- */

typedef struct estimate {
    column c;
    long double v, deviation;
    const double *share; /* of its variance, by input, or NULL */
} estimate;

/* `mu = 0.4 +- 0.002`, both in the unit of the value. */
static void print_estimate(shell *sh, const char *name, const estimate *e) {
    char unit_text[COLUMN_UNIT], value_text[NUMBER_TEXT], deviation[NUMBER_TEXT];
    long double scale = e->c.scale;
    if (e->c.chosen)
        snprintf(unit_text, sizeof unit_text, "%s", e->c.unit);
    else
        scale = unit_choose(e->c.d, e->v, sh->set.digits, unit_text, sizeof unit_text);
    number_text(value_text, sh->set.digits, (double)(e->v / scale));
    number_text(deviation, 3, (double)(e->deviation / scale));
    if (*unit_text)
        fprintf(sh->out, "%s = %s %s +- %s %s\n", name, value_text, unit_text, deviation, unit_text);
    else
        fprintf(sh->out, "%s = %s +- %s\n", name, value_text, deviation);
}

/* One more column of a row. like: its unit, or NULL. */
static bool add_column(column *c, const char *name, const column *like) {
    *c = like ? *like : (column){.scale = 1};
    c->name = column_name(name, strlen(name));
    if (like && !like->chosen)
        dim_unit(like->d, c->unit, sizeof c->unit);
    return c->name != NULL;
}

/* CSV: a row of values, deviations and, of what is uncertain, the shares of its inputs. */
static bool print_row(shell *sh, const estimate *e, size_t count, const uncertainty_question *q,
                      calc_error *error) {
    const size_t shares = q ? q->count : 0, most = count * (2 + shares);
    column *columns = calloc(most, sizeof *columns);
    long double *si = calloc(most, sizeof *si);
    size_t n = 0;
    bool ok = columns && si;
    for (size_t i = 0; i < count && ok; i++) {
        char name[FILE_NAME];
        si[n] = e[i].v;
        ok = add_column(&columns[n++], e[i].c.name, &e[i].c);
        snprintf(name, sizeof name, "%s deviation", e[i].c.name);
        si[n] = e[i].deviation;
        ok &= add_column(&columns[n++], name, &e[i].c);
        for (size_t k = 0; k < shares && ok; k++) {
            snprintf(name, sizeof name, "%s from %s", e[i].c.name, q->name[k].text);
            si[n] = e[i].share[k];
            ok = add_column(&columns[n++], name, NULL);
        }
    }
    if (ok)
        print_values(&sh->set, sh->out, columns, si, n);
    for (size_t i = 0; columns && i < n; i++)
        free(columns[i].name);
    free(columns);
    free(si);
    return ok || calc_no_memory(error);
}

static bool print_estimates(shell *sh, const estimate *e, size_t count, const uncertainty_question *q,
                            calc_error *error) {
    sh->calc.ans = (value){e[count - 1].v, e[count - 1].c.d};
    sh->calc.has_ans = true;
    if (sh->set.format == FORMAT_CSV)
        return print_row(sh, e, count, q, error);
    for (size_t i = 0; i < count; i++)
        if (sh->set.format == FORMAT_JSON)
            print_json_value(sh->out, e[i].c.name, e[i].v, e[i].c.d);
        else
            print_estimate(sh, e[i].c.name, &e[i]);
    return true;
}

static void json_number_of(shell *sh, bool first, const char *name, double v) {
    fputs(first ? "" : ",", sh->out);
    print_json_string(sh->out, name);
    if (isfinite(v))
        fprintf(sh->out, ":%.17g", v);
    else
        fputs(":null", sh->out);
}

/* ---- fit: what is read ------------------------------------------------------------------------- */

/* A name that is to be found needs a value to start from. */
static bool read_names(shell *sh, lexer *lx, fit_question *q) {
    for (;;) {
        size_t unused;
        if (q->count == FIT_NAMES)
            return lex_fail(lx, "more than %d names", FIT_NAMES);
        if (lx->kind == T_NAME && lx->len < LEX_NAME && !quantity_find(lx->text + lx->at, lx->len) &&
            !name_taken(lx->text + lx->at, lx->len) &&
            !names_find(&sh->calc.names, lx->text + lx->at, lx->len, &unused))
            return lex_fail(lx, "'%.*s' is no input and has no value to start from", LEX_WORD(lx));
        const size_t at = lx->at;
        if (!knob_read(&sh->calc, lx, &q->name[q->count++]))
            return false;
        if (ask_repeats(q->name, q->count))
            return calc_fail(lx->error, at, lx->last - at, "%s is given twice", q->name[q->count - 1].text);
        if (lx->kind != T_COMMA)
            return !lx->error->raised;
        lex_next(lx);
    }
}

/* The file stands behind the expressions that use its columns. */
static bool file_ahead(const lexer *lx, char name[FILE_NAME]) {
    calc_error ignored;
    lexer scan = *lx;
    error_clear(&ignored);
    scan.error = &ignored;
    while (scan.kind != T_END) {
        if (lex_is(&scan, "to")) {
            lex_next(&scan);
            error_clear(&ignored);
            return lex_filename(&scan, name, FILE_NAME);
        }
        lex_next(&scan);
    }
    return false;
}

/* An angle needs its unit as lengths do. */
static bool same_dim(dim a, dim b) {
    return dim_equal(a, b) && (a.rad != 0) == (b.rad != 0);
}

/* Column `name` of this dimension; NULL: there is none, or with an error it is not of it. */
static const double *column_of(const csv *data, const char *name, dim d, calc_error *error) {
    char wants[128], is[128];
    if (!csv_has(data, name))
        return NULL;
    const csv_values *of_file = csv_column(data, name, error);
    if (!of_file || same_dim(of_file->d, d))
        return of_file ? of_file->v : NULL;
    dim_describe(d, wants, sizeof wants);
    dim_describe(of_file->d, is, sizeof is);
    calc_fail(error, 0, 0, "column %s is %s: it needs the unit of %s in the header", name, is, wants);
    return NULL;
}

/* Columns as names: of inputs that the scene takes, or free ones. Those that are results, or no names, have
 * no say, and are missed if they are asked for; one that is named in vain is no matter. */
static bool read_columns(shell *sh, const csv *data, fit_question *q, size_t names, calc_error *error) {
    _Static_assert((int)CSV_COLUMNS <= (int)FIT_COLUMNS, "all columns of a file are names");
    for (size_t i = 0; i < data->columns; i++) {
        const csv_values *of_file = &data->column[i];
        calc_error useless;
        lexer lx;
        knob *k = &q->column[q->columns].name;
        error_clear(&useless);
        lex_start(&lx, of_file->name, strlen(of_file->name), &useless);
        if (useless.raised || lx.kind != T_NAME || lex_peek(&lx) != T_END || of_file->trouble ||
            of_file->twice)
            continue;
        const quantity *of = quantity_find(of_file->name, strlen(of_file->name));
        if ((of && !quantity_is_input(of)) || (!of && name_taken(of_file->name, strlen(of_file->name))))
            continue;
        if (!names_wake(sh, &lx, names))
            return calc_no_memory(error);
        knob_name(&sh->calc, &lx, k); /* there is one */
        if (k->is_input && !calc_takes(&sh->calc, k->in, &useless))
            continue;
        if (k->is_input && !same_dim(k->d, of_file->d))
            return column_of(data, of_file->name, k->d, error) != NULL;
        k->d = of_file->d;
        q->column[q->columns++].v = of_file->v;
    }
    return true;
}

/* A quantity in the equation that is also a column, whose rows it does not take: one of them was meant. */
static bool ambiguous(const shell *sh, const csv *data, const expr *e, calc_error *error) {
    const quantity *of;
    bool call;
    size_t at;
    for (size_t i = 0; (of = expr_quantity(e, i, &call, &at)); i++) {
        calc_error useless;
        error_clear(&useless);
        const bool is_input = quantity_is_input(of);
        if (call || !csv_has(data, of->name) ||
            (is_input && calc_takes(&sh->calc, quantity_input(of), &useless)))
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

static bool uses_columns(const shell *sh, const fit_question *q) {
    for (size_t i = 0; i < q->columns; i++) {
        const knob *k = &q->column[i].name;
        const quantity *of = NULL;
        const char *own = k->text;
        if (k->is_input) {
            of = quantity_of_input(k->in);
            own = NULL;
        }
        if (expr_mentions(&sh->calc, q->left, of, own) || expr_mentions(&sh->calc, q->right, of, own))
            return true;
    }
    return false;
}

/* A name that is unknown because something is wrong in its column. */
static bool read_side(shell *sh, lexer *lx, const csv *data, expr *e) {
    char name[CSV_NAME];
    calc_error wrong, *error = lx->error;
    if (expr_parse_at(&sh->calc, lx, e))
        return true;
    error_clear(&wrong);
    snprintf(name, sizeof name, "%.*s", (int)(error->len < sizeof name ? error->len : 0),
             lx->text + error->at);
    if (csv_has(data, name) && !csv_column(data, name, &wrong)) {
        calc_place(&wrong, error->at, error->len);
        *error = wrong;
    } else if (!strncmp(error->text, "unknown name", 12)) {
        char names[CALC_ERROR_TEXT / 2];
        csv_names(data, names, sizeof names);
        calc_append(&sh->calc, error, " (the columns of %.100s are %s)", data->path, names);
    }
    return false;
}

static bool read_equation(shell *sh, lexer *lx, fit_question *q, csv *data, size_t names) {
    char name[FILE_NAME];
    if (!file_ahead(lx, name))
        return lex_fail(lx, "expected EXPR = EXPR to FILE.csv");
    if (!csv_read(name, &shell_stop, data, lx->error) || !read_columns(sh, data, q, names, lx->error) ||
        !read_side(sh, lx, data, &sh->list[0]))
        return false;
    if (lx->kind != T_ASSIGN)
        return lex_fail(lx, "expected = EXPR");
    lex_next(lx);
    if (!read_side(sh, lx, data, &sh->list[1]))
        return false;
    q->left = &sh->list[0];
    q->right = &sh->list[1];
    q->rows = data->rows;
    if (!lex_is(lx, "to"))
        return lex_fail(lx, "expected to FILE.csv");
    if (ambiguous(sh, data, q->left, lx->error) || ambiguous(sh, data, q->right, lx->error))
        return false;
    if (!uses_columns(sh, q)) {
        char columns[CALC_ERROR_TEXT / 2];
        csv_names(data, columns, sizeof columns);
        return calc_fail(lx->error, q->left->at, lx->last - q->left->at,
                         "no column of %.100s is in the equation: they are %s", name, columns);
    }
    lex_next(lx);
    return lex_filename(lx, name, sizeof name);
}

static void no_loop(const csv *data, const char *misses, calc_error *error) {
    char names[CALC_ERROR_TEXT / 2];
    csv_names(data, names, sizeof names);
    calc_fail(error, 0, 0,
              "%.200s has no column %s: a loop needs dx and Fx, and may have FN or dz; its columns are %s",
              data->path, misses, names);
}

static bool read_loop(lexer *lx, fit_question *q, csv *data) {
    char name[FILE_NAME];
    const size_t at = lx->at;
    calc_error *error = lx->error;
    if (!lex_filename(lx, name, sizeof name) || !csv_read(name, &shell_stop, data, error))
        return calc_place(error, at, lx->last - at);
    q->rows = data->rows;
    q->loop.dx = column_of(data, "dx", DIM_LENGTH, error);
    q->loop.Fx = column_of(data, "Fx", DIM_FORCE, error);
    q->loop.normal = column_of(data, "FN", DIM_FORCE, error);
    q->loop.normal_by = BY_FORCE;
    if (!q->loop.normal) {
        q->loop.normal = column_of(data, "dz", DIM_LENGTH, error);
        q->loop.normal_by = BY_DISPLACEMENT;
    }
    if (!error->raised && (!q->loop.dx || !q->loop.Fx))
        no_loop(data, q->loop.dx ? "Fx" : "dx", error);
    return !error->raised || calc_place(error, at, lx->last - at);
}

static bool read_fit(shell *sh, lexer *lx, fit_question *q, csv *data, size_t names) {
    q->c = &sh->calc;
    if (!read_names(sh, lx, q))
        return false;
    if (lex_is(lx, "along")) {
        lex_next(lx);
        error_clear(lx->error); /* a file name need not be made of tokens */
        if (!read_loop(lx, q, data))
            return false;
    } else if (!lex_accept(lx, "for")) {
        return lex_fail(lx, "expected for EXPR = EXPR to FILE.csv, or along FILE.csv");
    } else if (!read_equation(sh, lx, q, data, names)) {
        return false;
    }
    return at_end(lx);
}

/* ---- fit: what is said ------------------------------------------------------------------------- */

static void json_fit(shell *sh, const fit_question *q, const fit_answer *a) {
    fprintf(sh->out, "{\"event\":\"fit\",\"rows\":%zu,\"evaluations\":%u,\"iterations\":%u", q->rows,
            a->evaluations, a->iterations);
    json_number_of(sh, false, "rms", a->rms);
    json_number_of(sh, false, "neighbours", a->together);
    fputs(",\"deviation\":{", sh->out);
    for (size_t i = 0; i < q->count; i++)
        json_number_of(sh, i == 0, q->name[i].text, a->deviation[i]);
    fputs("},\"correlation\":{", sh->out);
    for (size_t i = 0, n = 0; i < q->count; i++)
        for (size_t j = i + 1; j < q->count; j++) {
            char pair[2 * LEX_NAME + 2];
            snprintf(pair, sizeof pair, "%s,%s", q->name[i].text, q->name[j].text);
            json_number_of(sh, n++ == 0, pair, a->correlation[i][j]);
        }
    fputs("}}\n", sh->out);
}

static void report_fit(shell *sh, const fit_question *q, const fit_answer *a) {
    char text[COLUMN_UNIT + NUMBER_TEXT];
    const bool plain = sh->set.format == FORMAT_TEXT;
    if (sh->set.format == FORMAT_JSON)
        json_fit(sh, q, a);
    for (size_t i = 0; i < q->count; i++)
        for (size_t j = i + 1; j < q->count; j++) {
            if (plain)
                fprintf(sh->out, "correlation of %s and %s = %.3g\n", q->name[i].text, q->name[j].text,
                        a->correlation[i][j]);
            if (fabs(a->correlation[i][j]) > 0.99)
                shell_note(sh, "note: the data hardly tell %s and %s apart", q->name[i].text,
                           q->name[j].text);
        }
    format_value(&sh->set, (value){a->rms, a->d}, text, sizeof text);
    if (plain)
        fprintf(sh->out, "rms = %s over %zu rows\n", text, q->rows);
    for (size_t i = 0; i < q->count; i++)
        if (a->deviation[i] > fabs(a->value[i]))
            shell_note(sh, "note: the data hardly determine %s", q->name[i].text);
    if (a->drifts)
        shell_note(
            sh,
            "note: residuals go together from row to row (correlation %.2f): a drift, an offset or a model "
            "that does not fit; the standard errors are too small",
            a->together);
    if (a->twice)
        shell_note(
            sh, "note: the loop is closed and does not begin at rest: run twice, the second time compared");
    if (sh->set.timing)
        shell_note(sh, "fit: Levenberg and Marquardt's method, %u iterations, %u evaluations of %zu rows",
                   a->iterations, a->evaluations, q->rows);
}

static bool print_fit(shell *sh, const fit_question *q, const fit_answer *a, calc_error *error) {
    estimate e[FIT_NAMES] = {{.v = 0}};
    bool ok = true;
    for (size_t i = 0; i < q->count; i++) {
        e[i].v = a->value[i];
        e[i].deviation = a->deviation[i];
        ok &= column_si(&e[i].c, q->name[i].text, q->name[i].d);
    }
    ok = ok ? print_estimates(sh, e, q->count, NULL, error) : calc_no_memory(error);
    if (ok)
        report_fit(sh, q, a);
    for (size_t i = 0; i < q->count; i++)
        columns_free(&e[i].c, 1);
    return ok;
}

bool do_fit(shell *sh, lexer *lx, const command *self) {
    const size_t names = sh->calc.names.count;
    fit_question *q = calloc(1, sizeof *q);
    csv data = {0};
    fit_answer a;
    (void)self;
    bool ok = (q || calc_no_memory(lx->error)) && read_fit(sh, lx, q, &data, names) &&
              fit(q, &a, lx->error) && print_fit(sh, q, &a, lx->error);
    names_forget(sh, names);
    csv_free(&data);
    free(q);
    return ok;
}

/* ---- uncertainty ------------------------------------------------------------------------------- */

/* `+- 0.02`, `+- 5 %`: a percentage is a part of the value. */
static bool read_deviation(shell *sh, lexer *lx, const knob *k, double *out) {
    const size_t sign = lx->at;
    value v;
    double now = 0;
    if (lx->kind != T_PLUS || lex_peek(lx) != T_MINUS)
        return lex_fail(lx, "expected +- after %s", k->text);
    lex_next(lx);
    if (lx->at != sign + 1)
        return lex_fail(lx, "expected +-");
    lex_next(lx);
    const size_t at = lx->at;
    if (!expr_value(&sh->calc, lx, &v))
        return false;
    if (lx->text[lx->last - 1] == '%') {
        if (!ask_present(&sh->calc, k, &now))
            return ask_lacks(&sh->calc, k, "", "", lx->error) || calc_place(lx->error, at, lx->last - at);
        v = (value){v.v * fabs(now), k->d};
    }
    *out = (double)v.v;
    return value_dim(lx, k->text, at, lx->last - at, v, k->d) &&
           (v.v > 0 || calc_fail(lx->error, at, lx->last - at, "a deviation must be positive"));
}

static bool read_uncertain(shell *sh, lexer *lx, uncertainty_question *q) {
    for (;;) {
        size_t unused;
        knob *k = &q->name[q->count];
        if (q->count == UNCERTAIN_NAMES)
            return lex_fail(lx, "more than %d inputs", UNCERTAIN_NAMES);
        if (lx->kind == T_NAME && !quantity_find(lx->text + lx->at, lx->len) &&
            !names_find(&sh->calc.names, lx->text + lx->at, lx->len, &unused))
            return lex_fail(lx, "'%.*s' is no input and has no value", LEX_WORD(lx));
        const size_t at = lx->at;
        if (!knob_read(&sh->calc, lx, k))
            return false;
        if (ask_repeats(q->name, q->count + 1))
            return calc_fail(lx->error, at, lx->last - at, "%s is given twice", k->text);
        if (!read_deviation(sh, lx, k, &q->deviation[q->count++]))
            return false;
        if (lx->kind != T_COMMA)
            return !lx->error->raised;
        lex_next(lx);
    }
}

static bool read_sampling(shell *sh, lexer *lx, uncertainty_question *q) {
    for (;;)
        if (lex_accept(lx, "samples")) {
            if (!read_count(&sh->calc, lx, "samples", 10000000, &q->samples))
                return false;
        } else if (lex_accept(lx, "seed")) {
            if (!read_count(&sh->calc, lx, "seed", 1000000000, &q->seed))
                return false;
        } else {
            return at_end(lx);
        }
}

static void json_uncertain(shell *sh, const uncertainty_question *q, const uncertainty_answer *a,
                           const estimate *e) {
    for (size_t k = 0; k < q->expressions; k++) {
        const uncertain *u = &a->value[k];
        fputs("{\"event\":\"uncertainty\",\"of\":", sh->out);
        print_json_string(sh->out, e[k].c.name);
        json_number_of(sh, false, "deviation", u->deviation);
        fputs(",\"shares\":{", sh->out);
        for (size_t i = 0; i < q->count; i++)
            json_number_of(sh, i == 0, q->name[i].text, u->share[i]);
        fputs("},\"Monte Carlo\":{", sh->out);
        json_number_of(sh, true, "mean", u->mean);
        json_number_of(sh, false, "deviation", u->spread);
        fprintf(sh->out, ",\"samples\":%u,\"differs\":%s}}\n", u->samples, u->differs ? "true" : "false");
    }
}

static void text_uncertain(shell *sh, const uncertainty_question *q, const uncertain *u, const estimate *e) {
    const char *before = "    from ";
    for (size_t i = 0; i < q->count; i++, before = ", ")
        fprintf(sh->out, "%s%s %.3g %%", before, q->name[i].text, 100 * u->share[i]);
    putc('\n', sh->out);
    if (!u->differs)
        return;
    estimate sampled = *e;
    fputs("    ", sh->out);
    sampled.v = u->mean;
    sampled.deviation = u->spread;
    print_estimate(sh, "Monte Carlo", &sampled);
}

static bool print_uncertain(shell *sh, const uncertainty_question *q, const uncertainty_answer *a,
                            estimate *e, calc_error *error) {
    for (size_t k = 0; k < q->expressions; k++) {
        const uncertain *u = &a->value[k];
        if (!column_fits(&q->e[k], &e[k].c, (value){u->v, u->d}, error) ||
            !column_fits(&q->e[k], &e[k].c, (value){u->deviation, u->d}, error))
            return false;
        e[k].v = a->value[k].v;
        e[k].deviation = a->value[k].deviation;
        e[k].share = a->value[k].share;
    }
    if (sh->set.format != FORMAT_TEXT && !print_estimates(sh, e, q->expressions, q, error))
        return false;
    if (sh->set.format == FORMAT_JSON)
        json_uncertain(sh, q, a, e);
    for (size_t k = 0; k < q->expressions; k++) {
        const uncertain *u = &a->value[k];
        if (sh->set.format == FORMAT_TEXT) {
            print_estimates(sh, &e[k], 1, q, error); /* text: of no memory */
            text_uncertain(sh, q, u, &e[k]);
        }
        if (u->differs && sh->set.format == FORMAT_CSV) {
            char mean[CALC_VALUE_TEXT], spread[CALC_VALUE_TEXT];
            calc_value_text(u->d, u->mean, mean);
            calc_value_text(u->d, u->spread, spread);
            shell_note(sh, "note: the Monte Carlo says something else of %s: mean %s, deviation %s",
                       e[k].c.name, mean, spread);
        }
        if (u->samples < q->samples)
            shell_note(sh, "note: %u of %u samples of %s %s no value: %s", q->samples - u->samples,
                       q->samples, e[k].c.name, q->samples - u->samples > 1 ? "have" : "has",
                       a->missing.text);
    }
    if (sh->set.timing)
        shell_note(sh, "uncertainty: differences of sixth order and %u samples (seed %u), %u evaluations",
                   q->samples, q->seed, a->evaluations);
    return true;
}

/* A swinging normal force takes a thousand times as long. */
static unsigned usual_samples(shell *sh) {
    const load_reach *reach = &(load_reach){.swings = false};
    calc_error ignored;
    error_clear(&ignored);
    scene_reach(&sh->calc.scene, &reach, &ignored);
    return reach->swings ? 200 : 10000;
}

bool do_uncertainty(shell *sh, lexer *lx, const command *self) {
    uncertainty_question q = {.c = &sh->calc, .e = sh->list, .samples = usual_samples(sh), .seed = 1};
    uncertainty_answer *a = calloc(1, sizeof *a);
    column columns[UNCERTAIN_VALUES];
    estimate *e = calloc(UNCERTAIN_VALUES, sizeof *e);
    (void)self;
    bool ok = (a && e) || calc_no_memory(lx->error);
    ok = ok && read_expressions(sh, lx, columns, UNCERTAIN_VALUES, &q.expressions);
    for (size_t k = 0; k < q.expressions; k++)
        e[k].c = columns[k];
    ok = ok && (lex_accept(lx, "with") || lex_fail(lx, "expected with NAME +- DEVIATION, ..."));
    ok = ok && read_uncertain(sh, lx, &q) && read_sampling(sh, lx, &q) && uncertainty(&q, a, lx->error) &&
         print_uncertain(sh, &q, a, e, lx->error);
    columns_free(columns, q.expressions);
    free(a);
    free(e);
    return ok;
}
