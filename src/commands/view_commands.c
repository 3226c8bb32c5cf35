/* SPDX-License-Identifier: GPL-3.0-or-later */
/* history and table, which write tables and do not change the scene; compare, for the full-screen mode. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "commands/expressions.h"
#include "commands/map.h"
#include "commands/tables.h"
#include "statement/progress.h"

/* ---- history ----------------------------------------------------------------------------------- */

/* Columns; drig only if there is a rig. */
static const char *const history_names[] = {"FN", "dz", "Fx", "dx", "W", "drig"};
enum { HISTORY = sizeof history_names / sizeof *history_names };

static bool history_rows(scene *s, long double K_rig, answer *a, calc_error *error) {
    scene_trace t;
    run_view now;
    if (!trace_begin(&t, s, watch_points(1), true, error))
        return false;
    while (trace_next(&t, error)) {
        const fret_state *at = &now.state;
        run_view_now(t.run, t.levels, &now);
        answer_row(
            a, (const long double[HISTORY]){at->FN, at->dz, at->Fx, at->dx, at->W, at->dx + at->Fx / K_rig});
    }
    trace_end(&t);
    return !error->raised;
}

bool do_history(shell *sh, lexer *lx, parsed *all) {
    const fret_contact *contact;
    long double K_rig = INFINITY;
    si_table t;
    if (!scene_history(&sh->calc.scene, &contact, lx->error) || !table_open(sh, lx, all, &t))
        return false;
    const size_t count = HISTORY - !scene_get(&sh->calc.scene, IN_K_RIG, &K_rig, error_quiet());
    for (size_t i = 0; i < count; i++)
        table_column(&t, history_names[i], quantity_find(history_names[i], strlen(history_names[i]))->d);
    const bool ok = table_begin(sh, &t, all->by->command, lx->error) &&
                    history_rows(&sh->calc.scene, K_rig, &t.a, lx->error);
    return table_close(sh, lx, &t, ok);
}

/* ---- table ------------------------------------------------------------------------------------- */

typedef struct table_job {
    shell *sh;
    si_table t;   /* columns: the sweep's own, those of the expressions, those of comparisons */
    size_t first; /* column of the first expression */
    size_t count; /* of expressions */
    found found;
    size_t curve;  /* of the last row */
    file_rows *at; /* `at FILE`, or NULL */
    comparison compared[COLUMNS];
    size_t comparisons;
    const char *name;           /* of the destination, for messages */
    bool screen;                /* the rows go to a terminal: they show the progress themselves */
    size_t before, rows, total; /* rows of earlier shares, written so far, of this share */
    calc_error *error;
} table_job;

static void begin_columns(table_job *job) {
    for (size_t i = 0; i < job->count; i++) {
        column *c = &job->t.column[job->first + i];
        c->d = job->found.known[i] ? job->found.d[i] : DIM_NONE;
        if (!c->chosen)
            dim_unit(c->d, c->unit, sizeof c->unit);
    }
}

/* Adds two columns, the file's value and the difference, for each expression that has one in the file. */
static bool compare_columns(table_job *job) {
    for (size_t i = 0; job->at && i < job->count; i++) {
        const column *own = &job->t.column[job->first + i];
        char name[2][400];
        bool alone = true;
        for (size_t j = 0; j < job->count; j++)
            alone = alone && (j == i || !dim_equal(own->d, job->t.column[job->first + j].d));
        const csv_values *with =
            rows_compared(job->at, &(axis_of){.name = own->name, .d = own->d}, alone, job->error);
        if (job->error->raised)
            return false;
        if (!with)
            continue;
        job->compared[job->comparisons++] = (comparison){.with = with, .of = i};
        snprintf(name[0], sizeof name[0], "file %s", with->name);
        snprintf(name[1], sizeof name[1], "file %s - %.200s", with->name, own->name);
        for (int j = 0; j < 2; j++) {
            column *next = &job->t.column[job->t.count++];
            *next = *own;
            next->name = column_name(name[j], strlen(name[j]));
            if (!next->name)
                return calc_no_memory(job->error);
        }
    }
    return true;
}

static bool begin_table(table_job *job) {
    begin_columns(job);
    return compare_columns(job) && table_begin(job->sh, &job->t, "table", job->error);
}

/* Fills in the file's names and comparisons of a row; values: those of the expressions. */
static void put_file_columns(table_job *job, const long double *values, long double *row) {
    const sweep_rows *at = &job->at->at;
    const size_t r = (job->before + job->rows) % job->at->data.rows;
    for (size_t i = 0; i < at->names; i++)
        row[i] = at->column[i].v[r];
    for (size_t i = 0; i < job->comparisons; i++) {
        comparison *c = &job->compared[i];
        long double *to = row + job->first + job->count + 2 * i;
        to[0] = c->with->v[r];
        to[1] = columns_differ(c, r, values[c->of]);
    }
}

static bool give_row(void *context, const sweep *s, size_t curve, long double x, const long double *values) {
    table_job *job = context;
    long double row[COLUMNS];
    answer *a = &job->t.a;
    const bool first = !job->t.begun;
    if (first && !begin_table(job))
        return false;
    if (job->t.to.blocks && !first && curve != job->curve)
        answer_gap(a);
    job->curve = curve;
    row[0] = x;
    if (s->curves)
        row[job->first - 1] = sweep_with(s, curve);
    if (job->at)
        put_file_columns(job, values, row);
    memcpy(row + job->first, values, job->count * sizeof *row);
    job->rows++;
    if (job->screen && answer_shows_next(a))
        progress_wipe();
    else
        progress_part((double)job->rows / (double)job->total);
    answer_row(a, row);
    /* the reader of a pipe has gone, or the disk is full: stop the sweep */
    return !ferror(a->to) || calc_fail(job->error, 0, 0, "cannot write %s: %s", job->name, strerror(errno));
}

static void own_columns(si_table *t, const sweep *s) {
    if (!s->at)
        table_column(t, s->var.text, s->var.d);
    for (size_t i = 0; s->at && i < s->at->names; i++)
        table_column(t, s->at->column[i].name.text, s->at->column[i].name.d);
    if (s->curves)
        table_column(t, s->with.text, s->with.d);
}

/* Reports each comparison: rms, largest difference, and its row. */
static void report_compared(shell *sh, const table_job *job) {
    answer a;
    answer_begin(&a, &sh->set, sh->out);
    for (const comparison *c = job->compared; c < job->compared + job->comparisons; c++) {
        char text[2][NUMBER_TEXT + COLUMN_UNIT];
        const column *own = &job->t.column[job->first + c->of];
        const long double rms = columns_rms(c);
        const size_t line = job->at->data.row[c->worst_row].line;
        answer_event(&a, "compare");
        answer_string(&a, "name", own->name);
        answer_string(&a, "column", c->with->name);
        answer_number(&a, "rows", (double)c->rows);
        answer_number(&a, "rms", (double)rms);
        answer_number(&a, "worst", (double)c->worst);
        answer_number(&a, "row", (double)c->worst_row + 1);
        answer_number(&a, "line", (double)line);
        answer_done(&a);
        format_value(&sh->set, (value){rms, own->d}, text[0], sizeof text[0]);
        format_value(&sh->set, (value){c->worst, own->d}, text[1], sizeof text[1]);
        answer_words(&a,
                     "file %s - %s: rms = %s (%.3Lg %% of the largest) over %zu row%s, worst = %s in row %zu "
                     "(line %zu)\n",
                     c->with->name, own->name, text[0], c->largest > 0 ? 100 * rms / c->largest : 0, c->rows,
                     c->rows == 1 ? "" : "s", text[1], c->worst_row + 1, line);
    }
    answer_end(&a, true);
}

/* ---- a grid as text: a matrix of each expression ----------------------------------------------- */

/* Writes the matrix of one expression: the first name runs downward, the second across. */
static bool print_matrix(shell *sh, FILE *to, const sweep *s, const grid_values *m, size_t i, column *c) {
    column columns[COLUMNS] = {{.name = NULL}};
    char head[200], number[120];
    bool ok = column_si(&columns[0], s->var.text, s->var.d);
    column_suit(c, m->v + i, m->rows * m->across, m->count, sh->set.digits);
    for (size_t j = 0; ok && j < m->across; j++) {
        format_value(&sh->set, (value){m->b[j], s->with.d}, number, sizeof number);
        snprintf(head, sizeof head, "%s = %s", s->with.text, number);
        ok = column_si(&columns[j + 1], head, DIM_NONE);
        columns[j + 1].scale = c->scale;
        columns[j + 1].chosen = true; /* keep this scale: the heading has the unit */
    }
    answer a;
    answer_begin_as(&a, &sh->set, to, FORMAT_TEXT);
    ok = ok && answer_columns(&a, "table", columns, m->across + 1);
    if (ok) {
        fprintf(to, *c->unit ? "%s%s [%s]\n" : "%s%s\n", i ? "\n" : "", c->name, c->unit);
        for (size_t r = 0; r < m->rows; r++) {
            long double row[COLUMNS] = {m->a[r]};
            for (size_t j = 0; j < m->across; j++)
                row[j + 1] = m->v[(j * m->rows + r) * m->count + i];
            answer_row(&a, row);
        }
        answer_end(&a, true);
    }
    columns_free(columns, m->across + 1);
    return ok;
}

static bool run_matrix(shell *sh, table_job *job, const sweep *s, sweep_job *sweeping) {
    grid_values m;
    if (s->curves > COLUMNS - 1)
        return calc_fail(sweeping->error, 0, 0,
                         "a matrix as text has at most %d columns: use fewer steps, or a file", COLUMNS - 1);
    bool ok = grid_keep(s, sweeping, &m);
    if (ok)
        begin_columns(job);
    for (size_t i = 0; ok && i < job->count; i++)
        ok = print_matrix(sh, job->t.to.to, s, &m, i, &job->t.column[job->first + i]) ||
             calc_no_memory(sweeping->error);
    grid_values_free(&m);
    return ok;
}

/* ---- table: the command ------------------------------------------------------------------------- */

/* Runs the sweep and writes its table. at: the sweep goes over the rows of this file; or NULL. */
static bool run_table(shell *sh, lexer *lx, parsed *all, const sweep *s, file_rows *at, column *columns,
                      size_t count) {
    const size_t first = (at ? at->at.names : 1) + (s->curves > 0);
    if (first + (at ? 3 : 1) * count > COLUMNS)
        return calc_fail(lx->error, 0, 0, "more than %d columns", COLUMNS);
    table_job *job = calloc(1, sizeof *job);
    if (!job)
        return calc_no_memory(lx->error);
    si_table *t = &job->t;
    if (!table_open(sh, lx, all, t)) {
        free(job);
        return false;
    }
    job->sh = sh;
    job->first = first;
    job->count = count;
    job->at = at;
    job->name = t->to.file.to ? t->to.file.name : "to standard output";
    job->error = lx->error;
    own_columns(t, s);
    memcpy(t->column + t->count, columns, count * sizeof *columns); /* with their names */
    t->count += count;
    for (size_t i = 0; i < count; i++)
        columns[i].name = NULL;
    sweep_job sweeping = range_job(sh, t->column + job->first, count, &job->found, give_row, job, lx->error);
    const size_t rows = sweep_length(s);
    bool ok = (!t->lost || calc_no_memory(lx->error)) &&
              target_share(sh, &t->to, rows, &sweeping.from, &sweeping.to, lx->error);
    job->before = sweeping.from;
    job->total = sweeping.to - sweeping.from;
    job->screen = t->to.to == sh->out && shell_on_terminal(sh);
    const bool square = s->across && t->to.format == FORMAT_TEXT && !t->to.blocks;
    ok = ok && (square ? run_matrix(sh, job, s, &sweeping) : sweep_run(s, &sweeping));
    table_end(t, sweeping.values > 0);
    if (ok)
        note_missing(sh, &sweeping);
    ok = target_close(sh, lx, &t->to, ok);
    if (ok && job->total == rows) /* a share has not seen all of them */
        report_compared(sh, job);
    if (ok && at)
        rows_say(sh, at);
    columns_free(t->column, t->count);
    free(job);
    return ok;
}

bool table_map(shell *sh, lexer *lx, parsed *all) {
    column c;
    grid_range r;
    const bool ok = map_read(sh, lx, all, &c, &r) && run_table(sh, lx, all, &r.a.sweep, NULL, &c, 1);
    columns_free(&c, 1);
    return ok;
}

bool do_table(shell *sh, lexer *lx, parsed *all) {
    enum { ROWS = 20, ACROSS = 5 };
    column columns[COLUMNS - 2];
    size_t count = 0;
    range r;
    grid_range two;
    file_rows at;
    const span *first = &all->list[0].hole[0];
    bool ok = rows_open(sh, lx, all, &at);
    const bool ranged = at.given || parsed_clause(all, "for", 0) || parsed_clause(all, "along", 0);
    ok = ok && (ranged || (!range_hides(lx, all) &&
                           calc_fail(lx->error, first->at, first->len,
                                     "expected EXPR, ... for NAME = LO .. HI, such as for FN = 1 N .. 9 N")));
    ok = ok && read_expressions_in(sh, lx, first, columns, COLUMNS - 2, &count);
    if (!ok && at.given)
        columns_missed(sh, lx, &at.data);
    else if (ok && at.given)
        ok = range_read_rows(sh, lx, all, &at, count, &r) &&
             run_table(sh, lx, all, &r.sweep, &at, columns, count);
    else if (ok && parsed_clause(all, "for", 1))
        ok = grid_range_read(sh, lx, all, &two, ROWS, ACROSS) &&
             run_table(sh, lx, all, &two.a.sweep, NULL, columns, count);
    else
        ok = ok && range_read(sh, lx, all, 0, &r) && range_options(sh, lx, all, 0, &r, ROWS) &&
             run_table(sh, lx, all, &r.sweep, NULL, columns, count);
    columns_free(columns, count);
    rows_close(&at);
    return ok;
}

/* ---- compare ------------------------------------------------------------------------------------ */

bool do_compare(shell *sh, lexer *lx, parsed *all) {
    sweep two = {.along = true};
    bool ok = true;
    const given_clause *by = parsed_clause(all, "", 0);
    if (by) {
        lexer name = hole_lexer(lx, &by->hole[0]);
        ok = knob_known(&sh->calc, &name, &two.with) && range_read_values(sh, lx, &by->hole[1], &two) &&
             (two.curves == COMPARED ||
              calc_fail(lx->error, by->hole[1].at, by->hole[1].len, "compare needs two values"));
    }
    if (ok) {
        sh->compared = (side_by_side){.on = by != NULL, .by = two.with};
        for (size_t i = 0; i < two.curves; i++)
            sh->compared.with[i] = two.value[i];
    }
    if (ok && by)
        shell_note(sh, "live shows both; compare off ends it");
    return ok;
}
