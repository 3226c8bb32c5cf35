/* SPDX-License-Identifier: GPL-3.0-or-later */
/* loop: evaluates a measured hysteresis loop, without a model. Does not use the scene. */
#include <math.h>
#include <stdlib.h>

#include "commands/columns.h"
#include "commands/tables.h"
#include "measured/loop.h"
#include "statement/command.h"

/* The quantities of a cycle, in the order of the table's columns. */
static const struct {
    const char *name;
    dim d;
    size_t at; /* offset of a double in loop_cycle */
} measured[] = {{"dW", {1, 1, 0, 0}, offsetof(loop_cycle, dW)},
                {"dxA", {0, 1, 0, 0}, offsetof(loop_cycle, dxA)},
                {"FA", {1, 0, 0, 0}, offsetof(loop_cycle, FA)},
                {"dx0", {0, 1, 0, 0}, offsetof(loop_cycle, dx0)},
                {"Fx0", {1, 0, 0, 0}, offsetof(loop_cycle, Fx0)},
                {"secant", {1, -1, 0, 0}, offsetof(loop_cycle, secant)},
                {"unloading", {1, -1, 0, 0}, offsetof(loop_cycle, unloading)},
                {"flank", {0, 0, 0, 0}, offsetof(loop_cycle, flank)},
                {"energy_ratio", {0, 0, 0, 0}, offsetof(loop_cycle, ratio)}};
enum { MEASURED = sizeof measured / sizeof *measured, LOOP_COLUMNS = MEASURED + 3 };

static double value_at(const loop_cycle *c, size_t i) {
    return *(const double *)(const void *)((const char *)c + measured[i].at);
}

static bool write_table(shell *sh, si_table *t, const csv *data, const loop_answer *l, calc_error *error) {
    table_column(t, "cycle", DIM_NONE);
    table_column(t, "line", DIM_NONE);
    for (size_t i = 0; i < MEASURED; i++)
        table_column(t, measured[i].name, measured[i].d);
    table_column(t, "slides", DIM_NONE);
    if (!table_begin(sh, t, "loop", error))
        return false;
    for (size_t k = 0; k < l->cycles; k++) {
        const loop_cycle *c = &l->cycle[k];
        long double row[LOOP_COLUMNS] = {(long double)(k + 1), (long double)data->row[c->first].line};
        for (size_t i = 0; i < MEASURED; i++)
            row[2 + i] = value_at(c, i);
        row[LOOP_COLUMNS - 1] = c->slides;
        answer_row(&t->a, row);
    }
    return true;
}

static void report_cycles(const shell *sh, const csv *data, const loop_answer *l) {
    answer out, *a = &out;
    answer_begin(a, &sh->set, sh->out);
    for (size_t k = 0; k < l->cycles; k++) {
        const loop_cycle *c = &l->cycle[k];
        answer_words(a, "cycle %zu, from line %zu\n", k + 1, data->row[c->first].line);
        answer_page(a, "measured");
        answer_number(a, "cycle", (double)(k + 1));
        answer_number(a, "line", (double)data->row[c->first].line);
        for (size_t i = 0; i < MEASURED; i++)
            if (isfinite(value_at(c, i)))
                answer_quantity(a, measured[i].name, (value){value_at(c, i), measured[i].d});
        answer_fact(a, "flanks", c->slides ? "slide" : "do not slide");
        answer_done(a);
    }
    answer_words(a, "all\n");
    answer_page(a, "loop");
    answer_number(a, "rows", (double)data->rows);
    answer_number(a, "cycles", (double)l->cycles);
    answer_quantity(a, "drift_dx", (value){l->drift_dx, DIM_LENGTH});
    answer_quantity(a, "drift_Fx", (value){l->drift_Fx, DIM_FORCE});
    answer_quantity(a, "noise_dx", (value){l->noise_dx, DIM_LENGTH});
    answer_quantity(a, "noise_Fx", (value){l->noise_Fx, DIM_FORCE});
    answer_fact(a, "row_1", l->at_rest ? "at rest" : "not at rest");
    answer_done(a);
    answer_end(a, true);
}

static bool answer_loop(shell *sh, lexer *lx, parsed *all, const csv *data, const loop_answer *l) {
    si_table t;
    if (!table_open(sh, lx, all, &t))
        return false;
    if (t.to.file.to || sh->set.format == FORMAT_CSV)
        return table_close(sh, lx, &t, write_table(sh, &t, data, l, lx->error));
    report_cycles(sh, data, l);
    return true;
}

bool do_loop(shell *sh, lexer *lx, parsed *all) {
    csv data;
    csv_values *dx, *Fx;
    loop_answer l = {.cycle = NULL};
    char more[128];
    bool ok = columns_read(lx, all, &all->list[0], &data) &&
              columns_of_loop(&data, false, &dx, &Fx, lx->error) && csv_settle(&data, lx->error);
    const bool turned = ok && columns_opposed(&data, dx, Fx);
    if (turned)
        columns_turn(&data, Fx);
    ok = ok && loop_find(dx->v, Fx->v, data.rows, &l, lx->error);
    if (ok) {
        snprintf(more, sizeof more, "%zu cycle%s%s", l.cycles, l.cycles == 1 ? "" : "s",
                 turned ? ", " TURNED_FX : "");
        columns_say(sh, &data, more);
        if (l.cycle->ratio < -0.01) /* noise alone makes it slightly negative */
            shell_note(sh, "dW < 0: the loop runs the wrong way round: does one of the readings lag?");
        ok = answer_loop(sh, lx, all, &data, &l);
    }
    loop_free(&l);
    csv_free(&data);
    return ok || given_place(lx->error, &all->list[0]);
}
