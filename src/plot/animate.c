/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Animations: every frame is filled in first, since axes hold for all; then they are drawn together. */
#include <stdlib.h>
#include <string.h>

#include "plot/script.h"

static bool fill_frame(const plot_movie *m, size_t i, plot_figure *f, plot_extents *extent, size_t panels,
                       calc_error *error) {
    if (!m->fill(m->context, i, m->frames, f, error))
        return false;
    if (!f->count || (i && f->count != panels))
        return calc_fail(error, 0, 0,
                         f->count ? "the frames differ in their figures" : "there is nothing to plot");
    for (size_t p = 0; p < f->count; p++) {
        const plot_extents e = plot_settle(f->panel[p]);
        extent[p] = i ? plot_extent_join(extent[p], e) : e;
    }
    return true;
}

bool plot_animate(const plot_movie *m, const plot_target *t, file_report *report, calc_error *error) {
    plot_extents extent[PLOT_PANELS];
    if (t->file && !file_ends(t->file, ".gif"))
        return calc_fail(error, 0, 0, "an animation goes to a .gif file or to the terminal");
    if (m->frames < 1 || m->frames > PLOT_FRAMES)
        return calc_fail(error, 0, 0, "an animation has 1 to %d frames", PLOT_FRAMES);
    plot_figure *frame = calloc(m->frames, sizeof *frame);
    bool ok = frame != NULL || calc_no_memory(error);
    for (size_t i = 0; ok && i < m->frames; i++) {
        if (m->progress)
            m->progress(m->context, i, m->frames);
        ok = fill_frame(m, i, &frame[i], extent, frame[0].count, error);
        if (ok && plot_stopped(t))
            ok = calc_interrupted(error);
    }
    if (ok && m->progress)
        m->progress(m->context, m->frames, m->frames);
    double seconds = m->seconds > 0 ? m->seconds : 0.05;
    ok = ok && plot_draw_reel(&(plot_reel){frame, m->frames, extent, seconds}, t, report, error);
    for (size_t i = 0; frame && i < m->frames; i++)
        plot_figure_free(&frame[i]);
    free(frame);
    return ok;
}
