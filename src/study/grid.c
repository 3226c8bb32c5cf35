/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sweeps in rows. */
#include "study/grid.h"

static bool run_sweeps(const grid *g, sweep_job *job) {
    sweep_range ends = {.lo = 0};
    if (!g->b.range(&g->b, &ends, job->error))
        return false;
    for (size_t j = 0; j <= g->b.steps; j++) {
        sweep s = g->a;
        s.with = g->b.var;
        s.with.d = ends.d;
        s.curves = 1;
        s.value[0] = sweep_value(&g->b, &ends, (long double)j / (long double)g->b.steps);
        if (!sweep_run(&s, job))
            return false;
    }
    return true;
}

bool grid_run(const grid *g, sweep_job *job) {
    sweep_begin(job, (g->a.steps + 1) * (g->b.steps + 1));
    job->part = true;
    const bool ok = run_sweeps(g, job);
    sweep_end(job);
    return ok && sweep_has_values(job);
}
