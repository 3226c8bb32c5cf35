/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From a figure to its target: what gnuplot draws to where it belongs, the rest to the terminal. */
#include <errno.h>
#include <string.h>

#include "plot/script.h"

/* ---- files -------------------------------------------------------------------------------------- */

/* What is no file. */
static const plot_kind sixel = {.form = PLOT_ENHANCED,
                                .terminal = "sixelgd size %.0f,%.0f font 'Sans,%.3g' enhanced truecolor",
                                .per_pixel = 1,
                                .font = 14,
                                .line = 3,
                                .begin = "\033P"};
static const plot_kind in_page = {
    .form = PLOT_ENHANCED,
    .terminal = "svg size %.0f,%.0f font 'Helvetica,%.3g' enhanced background rgb 'white'",
    .per_pixel = 1,
    .font = 19,
    .line = 3,
    .begin = "<svg"};

/* Copies what gnuplot drew; every error of reading or writing is one. */
static bool copy(const plot_run *r, FILE *to, const plot_kind *kind, calc_error *error) {
    char block[1 << 14];
    FILE *const from = r->out;
    bool any = false;
    fputs(kind->head ? kind->head : "", to);
    for (size_t n; (n = fread(block, 1, sizeof block - 1, from)) > 0 && !ferror(to);) {
        block[n] = 0;
        const char *here = kind->begin && !any ? strstr(block, kind->begin) : NULL;
        here = here ? here : block;
        fwrite(here, 1, n - (size_t)(here - block), to);
        any = true;
    }
    int code = errno;
    bool bad = ferror(from) != 0;
    fputs(kind->foot ? kind->foot : "", to);
    if (bad)
        return calc_errno(error, code, "cannot read what gnuplot drew");
    return any || calc_fail(error, 0, 0, "gnuplot drew nothing");
}

/* Has gnuplot draw it. */
static bool draw_picture(FILE *to, const plot_reel *reel, const plot_kind *kind, const plot_target *target,
                         calc_error *error) {
    plot_run r;
    if (!plot_run_open(&r, error))
        return false;
    bool ok = plot_write_picture(r.script, reel, kind, target, error);
    if (fflush(r.script) || ferror(r.script))
        ok = calc_errno(error, errno, "cannot write a script for gnuplot");
    ok = ok && plot_run_gnuplot(&r, target, error) && copy(&r, to, kind, error);
    plot_run_close(&r);
    return ok;
}

static bool to_file(const plot_reel *reel, const plot_target *t, file_report *report, calc_error *error) {
    const plot_kind *kind = plot_kind_of(t->file, error);
    file_out out;
    if (!kind || !file_out_open(&out, t->file, t->stop, error))
        return false;
    const bool ok = (kind->terminal ? draw_picture : plot_write_picture)(out.to, reel, kind, t, error);
    return file_out_close(&out, ok, report, error) && ok;
}

/* ---- the terminal ------------------------------------------------------------------------------- */

static bool to_terminal(const plot_reel *reel, const plot_target *t, calc_error *error) {
    const plot_reel last = {reel->frame + reel->count - 1, 1, reel->extent, 0};
    const plot_kind *kind = NULL;
    reel = t->moving ? reel : &last;
    if (reel->count == 1) /* pictures that follow each other would scroll away */
        kind = t->terminal == PLOT_SIXEL ? &sixel : t->terminal == PLOT_PAGE ? &in_page : NULL;
    if (!kind)
        return plot_print(reel, t, error);
    const bool ok = draw_picture(t->out, reel, kind, t, error);
    if (ok)
        fputc('\n', t->out);
    return ok;
}

/* ---- figures ------------------------------------------------------------------------------------ */

bool plot_check(const char *file, file_stop stop, calc_error *error) {
    file_out probe;
    if (!plot_kind_of(file, error) || !file_out_open(&probe, file, stop, error))
        return false;
    file_out_close(&probe, false, NULL, error);
    return true;
}

/* What the panels of all frames span. */
static bool settle(plot_figure *frame, size_t frames, plot_extents *extent, calc_error *error) {
    for (size_t i = 0; i < frames; i++) {
        if (!frame[i].count)
            return calc_fail(error, 0, 0, "there is nothing to plot");
        if (frame[i].count != frame[0].count)
            return calc_fail(error, 0, 0, "the frames differ in their figures");
        for (size_t p = 0; p < frame[i].count; p++) {
            const plot_extents e = plot_settle(frame[i].panel[p]);
            extent[p] = i ? plot_extent_join(extent[p], e) : e;
        }
    }
    return true;
}

bool plot_draw(plot_figure *frame, size_t frames, const plot_target *t, file_report *report,
               calc_error *error) {
    static const double SECONDS = 0.05; /* a frame lasts */
    plot_extents extent[PLOT_PANELS];
    if (frames < 1 || frames > PLOT_FRAMES)
        return calc_fail(error, 0, 0, "an animation has 1 to %d frames", PLOT_FRAMES);
    if (t->width < 0 || t->height < 0 || t->width > PLOT_PIXELS || t->height > PLOT_PIXELS)
        return calc_fail(error, 0, 0, "a picture has at most %d pixels along an axis", PLOT_PIXELS);
    if (!settle(frame, frames, extent, error))
        return false;
    const plot_reel reel = {frame, frames, extent, frames > 1 ? SECONDS : 0};
    return t->file ? to_file(&reel, t, report, error) : to_terminal(&reel, t, error);
}
