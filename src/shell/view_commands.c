/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Commands that show what follows from the scene as a table, and leave it as it is. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "shell/expressions.h"
#include "shell/range.h"
#include "shell/target.h"

/* ---- history ----------------------------------------------------------------------------------- */

static const char *const history_names[] = {"FN", "dz", "Fx", "dx", "W"};
enum { HISTORY = sizeof history_names / sizeof *history_names };

static bool history_row(const runner *r, void *context) {
    fret_state s;
    engine_state(&r->engine, &s);
    table_row(context, (const long double[HISTORY]){s.FN, s.dz, s.Fx, s.dx, s.W});
    return true;
}

bool do_history(shell *sh, lexer *lx, const command *self) {
    const fret_memory *memory;
    column columns[HISTORY] = {{.name = NULL}};
    watch w = watch_points(1);
    target to;
    (void)self;
    if (!scene_memory(&sh->calc.scene, &memory, lx->error) || !target_open(sh, lx, &to))
        return false;
    table t = {.set = &sh->set, .to = to.to, .format = to.format, .count = HISTORY, .columns = columns};
    bool ok = true;
    for (size_t i = 0; i < HISTORY; i++)
        ok = ok && column_si(&columns[i], history_names[i],
                             quantity_find(history_names[i], strlen(history_names[i]))->d);
    if (ok) {
        table_begin(&t);
        w.see = history_row;
        w.context = &t;
        ok = scene_trace(&sh->calc.scene, &w, lx->error);
    } else {
        calc_no_memory(lx->error);
    }
    columns_free(columns, HISTORY);
    return target_close(sh, lx, &to, ok);
}

/* ---- table ------------------------------------------------------------------------------------- */

typedef struct table_job {
    table t;
    column columns[COLUMNS]; /* the sweep's own, then those of the expressions */
    size_t first;            /* of the expressions */
    size_t count;
    dim d[COLUMNS];
    bool known[COLUMNS];
    const char *units[COLUMNS];
    size_t curve;
    bool begun, blocks;
    const char *name; /* where it goes, for messages */
    calc_error *error;
} table_job;

static bool begin(table_job *job) {
    for (size_t i = 0; i < job->count; i++) {
        column *c = &job->columns[job->first + i];
        if (!c->chosen)
            dim_unit(job->known[i] ? job->d[i] : DIM_NONE, c->unit, sizeof c->unit);
    }
    job->begun = true;
    table_begin(&job->t);
    return true;
}

static bool give_row(void *context, const sweep *s, size_t curve, long double x, const long double *values) {
    table_job *job = context;
    long double row[COLUMNS];
    if (!job->begun && !begin(job))
        return false;
    if (job->blocks && curve != job->curve)
        putc('\n', job->t.to);
    job->curve = curve;
    row[0] = x;
    if (s->curves)
        row[1] = s->value[curve];
    memcpy(row + job->first, values, job->count * sizeof *row);
    table_row(&job->t, row);
    /* a reader that has gone, or a full disk: no use in going on */
    return !ferror(job->t.to) || calc_fail(job->error, 0, 0, "cannot write %s: %s", job->name, strerror(errno));
}

/* A dimension that the user asked for must come out. */
static void wanted(table_job *job) {
    for (size_t i = 0; i < job->count; i++) {
        job->known[i] = job->columns[job->first + i].chosen;
        job->d[i] = job->columns[job->first + i].d;
        job->units[i] = job->known[i] ? job->columns[job->first + i].unit : NULL;
    }
}

static bool own_columns(table_job *job, const sweep *s) {
    const char *name = s->along ? "time" : s->var.text;
    column *own = job->columns;
    return column_si(&own[0], name, s->along ? DIM_NONE : s->var.d) &&
           (!s->curves || column_si(&own[1], s->with.text, s->with.d));
}

void note_missing(shell *sh, const sweep_job *job) {
    if (job->missing.raised && job->values)
        shell_note(sh, "note: some values are missing: %s (%s)", job->missing.text, job->where);
}

static bool run_table(shell *sh, lexer *lx, const sweep *s, column *columns, size_t count) {
    table_job *job = calloc(1, sizeof *job);
    target to;
    if (!job)
        return calc_no_memory(lx->error);
    if (!target_open(sh, lx, &to)) {
        free(job);
        return false;
    }
    job->first = 1 + (s->curves > 0);
    job->count = count;
    job->blocks = to.blocks;
    job->name = to.file.to ? to.file.name : "to standard output";
    job->error = lx->error;
    memcpy(job->columns + job->first, columns, count * sizeof *columns);
    job->t = (table){.set = &sh->set,
                     .to = to.to,
                     .format = to.format,
                     .count = job->first + count,
                     .columns = job->columns};
    wanted(job);
    sweep_job sweeping = {.c = &sh->calc,
                          .expressions = sh->list,
                          .count = count,
                          .d = job->d,
                          .known = job->known,
                          .units = job->units,
                          .row = give_row,
                          .context = job,
                          .error = lx->error};
    bool ok = own_columns(job, s) || calc_no_memory(lx->error);
    ok = ok && sweep_run(s, &sweeping);
    if (ok)
        note_missing(sh, &sweeping);
    columns_free(job->columns, job->first);
    free(job);
    return target_close(sh, lx, &to, ok);
}

bool do_table(shell *sh, lexer *lx, const command *self) {
    column columns[COLUMNS - 2];
    size_t count = 0;
    range_names names;
    range r;
    bool found;
    (void)self;
    if (!range_names_find(sh, lx, &names, &found))
        return false;
    bool ok = found || lex_fail(lx, "expected EXPR, ... for VAR = LO .. HI");
    ok = ok && read_expressions(sh, lx, columns, COLUMNS - 2, &count) && range_read(sh, lx, &r, 20) &&
         run_table(sh, lx, &r.sweep, columns, count);
    columns_free(columns, count);
    range_forget(sh, &names);
    return ok;
}
