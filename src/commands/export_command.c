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

typedef struct export_table {
    answer a;
    size_t rows, all; /* that there have been, that will be */
    const volatile sig_atomic_t *stop;
    calc_error *error;
} export_table;

static bool put_row(export_table *t, const long double *si) {
    answer_row(&t->a, si);
    progress_part((double)++t->rows / (double)t->all);
    return !calc_stopped(t->stop, t->error);
}

static const char *const names[] = {"dxA", "Kp", "Kpp", "branch", "dx", "Fx", "FN"};
enum { HARMONIC = 0, LOOP = 3, NAMES = sizeof names / sizeof *names }; /* the first of each */

/* As `to FILE` has it: columns from one of the names on, the rows by `write`. */
static bool write_table(shell *sh, lexer *lx, said *all, size_t first, size_t count, size_t rows,
                        bool (*write)(export_table *t, void *context), void *context) {
    export_table t = {.all = rows, .stop = sh->calc.scene.stop, .error = lx->error};
    column columns[NAMES] = {{.name = NULL}};
    target to;
    bool ok = true;
    if (!target_open(sh, lx, all, &to))
        return false;
    for (size_t i = 0; i < count; i++) {
        const char *name = names[first + i];
        const quantity *q = quantity_find(name, strlen(name));
        ok = ok && column_si(&columns[i], name, q ? q->d : DIM_NONE);
    }
    answer_begin_as(&t.a, &sh->set, to.to, to.format);
    ok = (ok && answer_columns(&t.a, "export", columns, count)) || calc_no_memory(lx->error);
    if (ok) {
        ok = write(&t, context);
        answer_end(&t.a, ok);
    }
    progress_wipe();
    columns_free(columns, count);
    calc_word(&sh->calc, lx->error);
    return target_close(sh, lx, &to, ok);
}

static size_t steps_of(said *all, size_t usual) {
    const heard *steps = said_of(all, "steps", 0);
    return steps ? steps->count : usual;
}

/* ---- harmonic ---------------------------------------------------------------------------------- */

typedef struct amplitudes {
    scene *scene;
    sweep_range ends;
    size_t steps;
    bool log;
} amplitudes;

static bool read_amplitudes(shell *sh, const lexer *lx, said *all, amplitudes *out) {
    const knob dxA = {.is_input = true, .in = IN_DXA, .d = DIM_LENGTH, .text = "dxA"};
    const span *name = &said_of(all, "for", 0)->hole[0], *ends = name + 1;
    lexer own = hole_lexer(lx, ends);
    *out = (amplitudes){sh->calc.now, {.lo = 0}, steps_of(all, 50), said_of(all, "log", 0)};
    if (name->len != strlen(dxA.text) || strncmp(lx->text + name->at, dxA.text, name->len) != 0)
        return calc_fail(lx->error, name->at, name->len,
                         "K' and K'' are functions of dxA: for dxA = LO .. HI");
    if (!range_read_interval(&sh->calc, &own, &dxA, NULL, &out->ends) || !at_end(&own))
        return false;
    return (out->log ? out->ends.lo > 0 && out->ends.hi > 0 : out->ends.lo >= 0 && out->ends.hi >= 0) ||
           calc_fail(lx->error, ends->at, ends->len,
                     out->log ? "a logarithmic sweep needs positive ends"
                              : "an amplitude cannot be negative");
}

static bool write_harmonic(export_table *t, void *context) {
    const amplitudes *by = context;
    for (size_t i = 0; i < t->all; i++) {
        const long double part = (long double)i / (long double)by->steps;
        long double row[3] = {(double)points_place(by->ends.lo, by->ends.hi, by->log, part)};
        const value d = {row[0], DIM_LENGTH};
        if (!call_Kp(by->scene, d, &row[1], t->error) || !call_Kpp(by->scene, d, &row[2], t->error) ||
            !put_row(t, row))
            return false;
    }
    return true;
}

static bool export_harmonic(shell *sh, lexer *lx, said *all) {
    amplitudes by;
    return read_amplitudes(sh, lx, all, &by) &&
           write_table(sh, lx, all, HARMONIC, 3, by.steps + 1, write_harmonic, &by);
}

/* ---- loop -------------------------------------------------------------------------------------- */

/* The last period goes from one peak to the other and back; where it turns both branches have a row. */
static bool write_loop(export_table *t, void *context) {
    trial_along *a = context;
    const size_t turn = t->all / 2 - 1;
    for (size_t i = 0; trial_along_next(a, t->error); i++) {
        sight now;
        run_sight(trace_now(&a->trace), &now);
        for (int branch = i > turn ? 2 : 1; branch <= (i < turn ? 1 : 2); branch++)
            if (!put_row(t, (const long double[]){branch, now.state.dx, now.state.Fx, now.state.FN}))
                return false;
    }
    return !t->error->raised;
}

static bool export_loop(shell *sh, lexer *lx, said *all) {
    const size_t steps = steps_of(all, 100);
    const scene *s = &sh->calc.scene;
    trial_along a;
    if (program_last_cycle(s->program, s->end) == NO_CYCLE)
        return calc_fail(lx->error, 0, 0, "no cycle has been run yet: cycle first (cycle FA=20 N)");
    trial *t = trial_open(&sh->calc, lx->error);
    bool ok = t && trial_along_begin(&a, t, ALONG_CYCLE, s->end, 2 * steps, false, lx->error);
    if (ok) {
        ok = write_table(sh, lx, all, LOOP, 4, 2 * (steps + 1), write_loop, &a);
        trial_along_end(&a);
    }
    calc_word(&sh->calc, lx->error);
    if (t)
        trial_close(t);
    return ok;
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
    return said_read(sh, lx, command_form(self), &all) && exported[all.row].write(sh, lx, &all);
}
