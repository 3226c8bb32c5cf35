/* SPDX-License-Identifier: GPL-3.0-or-later */
/* export: the contact for a dynamics code, as the stiffnesses of its first harmonic, or as the branches of
 * its loop. Leaves the scene as it is. */
#include "commands/export_command.h"

#include <string.h>

#include "commands/range.h"
#include "commands/study_commands.h"
#include "language/along.h"
#include "scene/functions.h"
#include "statement/answer.h"
#include "statement/progress.h"
#include "statement/target.h"

/* ---- what tables have in common ---------------------------------------------------------------- */

enum { EXPORT_COLUMNS = 4 };

typedef struct export_table {
    shell *sh;
    target to;
    answer a;
    column columns[EXPORT_COLUMNS];
    size_t count, rows, all;
    bool begun;
    calc_error *error;
} export_table;

static bool begin_table(export_table *t, shell *sh, const lexer *lx, said *all, size_t rows,
                        const char *remark) {
    *t = (export_table){.sh = sh, .all = rows, .error = lx->error};
    if (!target_open(sh, lx, all, &t->to))
        return false;
    if (t->to.format == FORMAT_CSV)
        fputs(remark, t->to.to);
    return true;
}

static bool add_column(export_table *t, const char *name, dim d) {
    return column_si(&t->columns[t->count++], name, d) || calc_no_memory(t->error);
}

static bool head_table(export_table *t) {
    answer_begin_as(&t->a, &t->sh->set, t->to.to, t->to.format);
    t->begun = answer_columns(&t->a, "export", t->columns, t->count);
    return t->begun || calc_no_memory(t->error);
}

static bool put_row(export_table *t, const long double *si) {
    answer_row(&t->a, si);
    progress_part((double)++t->rows / (double)t->all);
    return !calc_stopped(t->sh->calc.scene.stop, t->error);
}

/* model: NULL where it has failed. */
static bool end_table(export_table *t, lexer *lx, const char *model) {
    progress_wipe();
    if (t->begun)
        answer_end(&t->a, model != NULL);
    columns_free(t->columns, t->count);
    if (!target_close(t->sh, lx, &t->to, model != NULL))
        return false;
    answer_begin(&t->a, &t->sh->set, t->sh->out);
    answer_event(&t->a, "export");
    answer_string(&t->a, "model", model);
    answer_number(&t->a, "rows", (double)t->rows);
    answer_done(&t->a);
    return answer_end(&t->a, true) || calc_no_memory(t->error);
}

static size_t steps_of(said *all, size_t usual) {
    const heard *steps = said_of(all, "steps", 0);
    return steps ? steps->count : usual;
}

/* ---- harmonic ---------------------------------------------------------------------------------- */

typedef struct amplitudes {
    sweep_range ends;
    size_t steps;
    bool log;
} amplitudes;

static bool read_amplitudes(shell *sh, lexer *lx, said *all, amplitudes *out) {
    const knob dxA = {.is_input = true, .in = IN_DXA, .d = DIM_LENGTH, .text = "dxA"};
    const heard *by = said_of(all, "for", 0);
    if (!by)
        return lex_fail(lx, "expected for dxA = LO .. HI");
    const span *name = &by->hole[0], *ends = &by->hole[1];
    if (name->len != strlen(dxA.text) || strncmp(lx->text + name->at, dxA.text, name->len) != 0)
        return calc_fail(lx->error, name->at, name->len,
                         "K' and K'' are functions of dxA: for dxA = LO .. HI");
    lexer own = hole_lexer(lx, ends);
    out->steps = steps_of(all, 50);
    out->log = said_of(all, "log", 0);
    if (!range_read_interval(&sh->calc, &own, &dxA, NULL, &out->ends) || !at_end(&own))
        return false;
    if (out->ends.lo < 0 || out->ends.hi < 0)
        return calc_fail(lx->error, ends->at, ends->len, "an amplitude cannot be negative");
    return !out->log || (out->ends.lo > 0 && out->ends.hi > 0) ||
           calc_fail(lx->error, ends->at, ends->len, "a logarithmic sweep needs positive ends");
}

static bool harmonic_rows(export_table *t, scene *s, const amplitudes *by) {
    for (size_t i = 0; i <= by->steps; i++) {
        const long double part = (long double)i / (long double)by->steps,
                          d = (double)points_place(by->ends.lo, by->ends.hi, by->log, part);
        const value at = {d, DIM_LENGTH};
        long double Kp, Kpp;
        if (!call_Kp(s, at, &Kp, t->error) || !call_Kpp(s, at, &Kpp, t->error) ||
            !put_row(t, (const long double[]){d, Kp, Kpp}))
            return false;
    }
    return true;
}

static bool export_harmonic(shell *sh, lexer *lx, said *all) {
    export_table t;
    amplitudes by;
    if (!read_amplitudes(sh, lx, all, &by) ||
        !begin_table(
            &t, sh, lx, all, by.steps + 1,
            "# delta_x = dxA cos(theta) takes F_x = Kp dxA cos(theta) - Kpp dxA sin(theta), to the first "
            "harmonic, at constant F_N\n"))
        return false;
    const bool ok = add_column(&t, "dxA", DIM_LENGTH) && add_column(&t, "Kp", DIM_STIFFNESS) &&
                    add_column(&t, "Kpp", DIM_STIFFNESS) && head_table(&t) &&
                    harmonic_rows(&t, sh->calc.now, &by);
    calc_word(&sh->calc, lx->error);
    return end_table(&t, lx, ok ? "harmonic" : NULL);
}

/* ---- loop -------------------------------------------------------------------------------------- */

/* The last period goes from one peak to the other and back; where it turns both branches have a row. */
static bool loop_rows(export_table *t, trial_along *a) {
    const size_t turn = t->all / 2 - 1;
    for (size_t i = 0; trial_along_next(a, t->error); i++) {
        sight now;
        run_sight(trace_now(&a->trace), &now);
        long double row[] = {i > turn ? 2 : 1, now.state.dx, now.state.Fx, now.state.FN};
        if (!put_row(t, row))
            return false;
        row[0] = 2;
        if (i == turn && !put_row(t, row))
            return false;
    }
    return !t->error->raised;
}

static bool export_loop(shell *sh, lexer *lx, said *all) {
    const size_t steps = steps_of(all, 100);
    calc_error *error = lx->error;
    export_table t;
    trial_along a;
    const scene *s = &sh->calc.scene;
    if (program_last_cycle(s->program, s->end) == NO_CYCLE)
        return calc_fail(error, 0, 0, "no cycle has been run yet: cycle first (cycle FA=20 N)");
    trial *copy = trial_open(&sh->calc, error);
    if (!copy || !trial_along_begin(&a, copy, ALONG_CYCLE, copy->scene.end, 2 * steps, false, error)) {
        calc_word(&sh->calc, error);
        if (copy)
            trial_close(copy);
        return false;
    }
    const bool begun =
        begin_table(&t, sh, lx, all, 2 * (steps + 1), "# branch 1 from the peak down, branch 2 back up\n");
    const bool ok = begun && add_column(&t, "branch", DIM_NONE) && add_column(&t, "dx", DIM_LENGTH) &&
                    add_column(&t, "Fx", DIM_FORCE) && add_column(&t, "FN", DIM_FORCE) && head_table(&t) &&
                    loop_rows(&t, &a);
    trial_along_end(&a);
    calc_word(&sh->calc, error);
    trial_close(copy);
    return begun && end_table(&t, lx, ok ? "loop" : NULL);
}

/* ---- the command ------------------------------------------------------------------------------- */

static const export_model exported[] = {
    {"jenkins", "N:1000 to FILE.csv|json|h [FA=20 N]", "parallel springs in line with sliders",
     export_jenkins},
    {"harmonic", "to FILE.csv|json for NAME = LO .. HI [steps N:1000000] [log]",
     "K'(dxA) and K''(dxA), stiffness and loss stiffness of the first harmonic", export_harmonic},
    {"loop", "to FILE.csv|json [steps N:1000000]", "both branches of the last cycle, so many steps each",
     export_loop},
};
enum { EXPORTED = sizeof exported / sizeof *exported };

const export_model *export_row(size_t i) {
    return i < EXPORTED ? &exported[i] : NULL;
}

const char *export_name(size_t i) {
    return i < EXPORTED ? exported[i].name : NULL;
}

const grammar *export_form(size_t i) {
    static grammar forms[EXPORTED];
    return grammar_made(&forms[i], "export", exported[i].name, exported[i].takes);
}

bool do_export(shell *sh, lexer *lx, const command *self) {
    said all;
    if (!said_read(sh, lx, command_form(self), &all))
        return false;
    const bool ok = exported[all.row].write(sh, lx, &all);
    said_drop(sh, &all);
    return ok;
}
