/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sweeps in rows. */
#include "study/grid.h"

#include <stdlib.h>
#include <string.h>

bool grid_run(const grid *g, sweep_job *job) {
    sweep_range ends = {.lo = 0};
    sweep s = g->a;
    if (!g->b.range(&g->b, &ends, job->error))
        return false;
    s.with = g->b.var;
    s.with.d = ends.d;
    s.curves = 1;
    bool ok = sweep_begin(&s, job, (g->a.steps + 1) * (g->b.steps + 1));
    for (size_t j = 0; j <= g->b.steps && ok; j++) {
        s.value[0] = sweep_value(&g->b, &ends, (long double)j / (long double)g->b.steps);
        ok = sweep_part(&s, job);
    }
    return sweep_end(job, ok);
}

static bool keep(void *context, const sweep *s, size_t curve, long double x, const long double *values) {
    grid_values *to = context;
    (void)curve;
    to->a[to->at % to->rows] = x;
    to->b[to->at / to->rows] = s->value[0];
    memcpy(to->v + to->at++ * to->count, values, to->count * sizeof *values);
    return true;
}

bool grid_keep(const grid *g, sweep_job *job, grid_values *out) {
    *out = (grid_values){.rows = g->a.steps + 1, .across = g->b.steps + 1, .count = job->count};
    out->a = calloc(out->rows, sizeof *out->a);
    out->b = calloc(out->across, sizeof *out->b);
    out->v = calloc(out->rows * out->across, out->count * sizeof *out->v);
    if (!out->a || !out->b || !out->v)
        return calc_no_memory(job->error);
    job->row = keep;
    job->context = out;
    return grid_run(g, job);
}

void grid_values_free(grid_values *values) {
    free(values->a);
    free(values->b);
    free(values->v);
}
