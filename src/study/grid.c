/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sweeps in rows. */
#include "study/grid.h"

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
