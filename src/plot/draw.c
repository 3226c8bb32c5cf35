/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From a figure to its target: writes the script, runs gnuplot and copies its output. Depends on script.h. */
#include <errno.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>

#include "plot/script.h"

/* ---- files -------------------------------------------------------------------------------------- */

/* Kinds of pictures that are printed, not stored in a file. */
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

/* Copies gnuplot's output from kind->begin on. The caller checks `to` for write errors. */
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

typedef struct scripted {
    const plot_reel *reel;
    const plot_target *target;
    const plot_kind *kind;
    const plot_pages *pages; /* NULL: a picture */
} scripted;

static bool write_script(FILE *to, const scripted *s, calc_error *error) {
    return s->pages ? plot_write_pages(to, s->reel, s->target, s->pages, error)
                    : plot_write_picture(to, s->reel, s->kind, s->target, error);
}

/* Writes the script and runs gnuplot on it. */
static bool draw_script(const plot_run *r, const scripted *s, calc_error *error) {
    const bool ok = write_script(r->script, s, error);
    if (fflush(r->script) || ferror(r->script))
        return calc_errno(error, errno, "cannot write a script for gnuplot");
    return ok && plot_run_gnuplot(r, s->target, error);
}

static bool to_file(const scripted *s, file_report *report, calc_error *error) {
    file_out out;
    plot_run r;
    const plot_target *t = s->target;
    if (!file_out_open(&out, t->file, t->stop, error))
        return false;
    bool ok;
    if (s->kind->terminal) {
        ok = plot_run_open(&r, error);
        if (ok) {
            ok = draw_script(&r, s, error) && copy(&r, out.to, s->kind, error);
            plot_run_close(&r);
        }
    } else {
        ok = write_script(out.to, s, error);
    }
    return file_out_close(&out, ok, report, error) && ok;
}

/* ---- text --------------------------------------------------------------------------------------- */

/* Prints the next page of gnuplot's output, in which form feeds separate pages, without blanks at the ends of
 * lines, and returns the number of its lines. The text behind the last line resets the colours. */
static size_t print_page(FILE *from, FILE *out, const char *end) {
    char *page = NULL;
    size_t room = 0, lines = 0;
    if (getdelim(&page, &room, '\f', from) > 0) {
        char *line = page;
        for (char *stop; (stop = strchr(line, '\n')); line = stop + 1) {
            const char *last = stop;
            while (last > line && last[-1] == ' ')
                last--;
            fwrite(line, 1, (size_t)(last - line), out);
            fputs(end, out);
            lines++;
        }
        fwrite(line, 1, strcspn(line, "\f"), out);
    }
    free(page);
    return lines;
}

/* Raises the error that a page is missing; returns 0. */
static size_t no_page(const plot_run *r, calc_error *error) {
    if (!feof(r->out)) /* an error, or no memory for a page */
        calc_raise_errno(error, ferror(r->out) ? EIO : ENOMEM, "cannot read what gnuplot drew");
    calc_raise(error, 0, 0, "gnuplot drew nothing"); /* the first error stays */
    return 0;
}

/* Prints a frame from gnuplot's output; r NULL: draws it in braille. Returns the lines; 0 with the error. */
static size_t print_frame(const plot_run *r, const scripted *w, size_t n, const char *end,
                          calc_error *error) {
    if (!r)
        return plot_print_frame(w->reel, n, w->target, w->pages, end, error);
    size_t lines = 0;
    for (size_t i = 0; i < (w->pages->beside ? 1 : w->reel->frame[n].count); i++) {
        const size_t more = print_page(r->out, w->target->out, end);
        lines += more;
        if (!more)
            return no_page(r, error);
    }
    return lines;
}

/* Prints the frames in place: the cursor goes up again, and each line is overwritten. */
static bool play(const plot_run *r, const scripted *w, calc_error *error) {
    const plot_target *t = w->target;
    const size_t frames = w->reel->count;
    size_t lines = 0;
    for (size_t n = 0; n < frames; n++) {
        if (lines)
            fprintf(t->out, "\033[%zuA", lines);
        lines = print_frame(r, w, n, t->moving ? "\033[K\n" : "\n", error);
        if (!lines)
            return false;
        if (fflush(t->out))
            return calc_errno(error, errno, "cannot write");
        for (int ms = (int)(1000 * w->reel->seconds); ms > 0 && n + 1 < frames; ms -= 10) {
            if (plot_stopped(t))
                return calc_interrupted(error);
            poll(NULL, 0, ms < 10 ? ms : 10);
        }
    }
    return true;
}

/* Prints gnuplot's output to the terminal. */
static bool show_drawn(const plot_run *r, const scripted *s, calc_error *error) {
    if (s->kind) {
        const bool ok = copy(r, s->target->out, s->kind, error);
        fputc('\n', s->target->out);
        return ok;
    }
    for (int c; (c = getc(r->out)) != '\f' && c != EOF;) /* a form feed precedes the first page */
        continue;
    return play(r, s, error);
}

static bool to_terminal(const plot_reel *reel, const plot_target *t, calc_error *error) {
    plot_run r;
    const plot_reel last = {reel->frame + reel->count - 1, 1, reel->extent, 0};
    plot_pages pages = plot_pages_for(t, &reel->frame[0], t->moving);
    if (pages.rows * (pages.beside ? 1 : (int)reel->frame[0].count) > t->moving) /* it would scroll */
        reel = &last;
    scripted s = {.reel = reel, .target = t, .pages = &pages};
    if (pages.braille)
        return play(NULL, &s, error);
    if (reel->count == 1) /* not for several: pictures cannot replace each other and would scroll */
        s.kind = t->terminal == PLOT_SIXEL ? &sixel : t->terminal == PLOT_SVG_INLINE ? &in_page : NULL;
    if (s.kind)
        s.pages = NULL;
    if (!plot_run_open(&r, error))
        return false;
    const bool ok = draw_script(&r, &s, error) && show_drawn(&r, &s, error);
    plot_run_close(&r);
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

/* Thins all series, and sets extent[] to the ranges of each panel over all frames. */
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
    static const double SECONDS = 0.05; /* duration of a frame */
    plot_extents extent[PLOT_PANELS];
    if (frames < 1 || frames > PLOT_FRAMES)
        return calc_fail(error, 0, 0, "an animation has 1 to %d frames", PLOT_FRAMES);
    if (t->width < 0 || t->height < 0 || t->width > PLOT_PIXELS || t->height > PLOT_PIXELS)
        return calc_fail(error, 0, 0, "a picture has at most %d pixels along an axis", PLOT_PIXELS);
    if (!settle(frame, frames, extent, error))
        return false;
    const plot_reel reel = {frame, frames, extent, frames > 1 ? SECONDS : 0};
    if (!t->file)
        return to_terminal(&reel, t, error);
    scripted s = {.reel = &reel, .target = t};
    s.kind = plot_kind_of(t->file, error);
    return s.kind && to_file(&s, report, error);
}
