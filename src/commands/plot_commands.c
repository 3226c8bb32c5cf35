/* SPDX-License-Identifier: GPL-3.0-or-later */
/* plot and animate: read figures, and draw them in files, in the terminal, or on the page being recorded. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "commands/expressions.h"
#include "commands/figures.h"
#include "commands/panel.h"
#include "number/array.h"
#include "statement/answer.h"
#include "statement/progress.h"
#include "statement/record.h"
#include "statement/target.h"
#include "statement/text.h"
#include "text/typeset.h"

/* Sizes of pictures: slide, 16:9 with large text; column of a paper, 8.5 cm wide with text of 9 points. */
static const struct {
    int width, height;
    double text;
} papers[] = {[PAPER_USUAL] = {0, 0, 1}, [PAPER_SLIDE] = {1280, 720, 1.35}, [PAPER_COLUMN] = {640, 480, 1.3}};

/* ---- output ------------------------------------------------------------------------------------- */

static void terminal_size(const shell *sh, int *w, int *h) {
    struct winsize size = {0};
    *w = 79, *h = 24;
    if (shell_on_terminal(sh))
        ioctl(STDOUT_FILENO, TIOCGWINSZ, &size);
    if (size.ws_col >= 20 && size.ws_row >= 8) {
        *w = size.ws_col - 1;
        *h = size.ws_row - 2; /* the prompt and the command stay in sight */
    }
}

/* Braille characters where the terminal has them; the Linux console does not. */
static plot_terminal terminal_kind(const shell *sh, bool on_terminal) {
    const char *term = getenv("TERM");
    if (sh->set.plot_terminal != PLOT_AUTO)
        return (plot_terminal)sh->set.plot_terminal;
    return on_terminal && typeset_unicode() && term && strcmp(term, "linux") != 0 ? PLOT_BLOCK : PLOT_DUMB;
}

/* The scene and the program's version, wrapped at so many columns. To be freed; NULL: out of memory. */
static char *caption_of(shell *sh, int columns) {
    file_text kept, wrapped;
    if (!file_text_open(&kept))
        return NULL;
    const bool ok = sh->write_scene(sh, kept.to, false);
    fputs("fret " FRET_VERSION "\n", kept.to);
    if (!file_text_close(&kept))
        return NULL;
    if (!ok || !file_text_open(&wrapped)) {
        free(kept.text);
        return NULL;
    }
    int at = 0;
    for (const char *p = kept.text, *end; (end = strchr(p, '\n')); p = end + 1) {
        const int n = (int)(end - p);
        if (*p == '#')
            continue;
        fputs(at && at + n + 2 > columns ? "\n" : at ? "; " : "", wrapped.to);
        at = (at && at + n + 2 <= columns ? at + 2 : 0) + n;
        fwrite(p, 1, (size_t)n, wrapped.to);
    }
    fputc('\n', wrapped.to);
    free(kept.text);
    return file_text_close(&wrapped) ? wrapped.text : NULL;
}

/* Draws the figure on the page that is being recorded. */
static bool draw_on_page(shell *sh, plot_figure *f, calc_error *error) {
    file_text svg;
    if (!file_text_open(&svg))
        return calc_no_memory(error);
    const plot_target to = {.out = svg.to, .terminal = PLOT_SVG_INLINE, .stop = &shell_stop};
    const bool ok = plot_draw(f, 1, &to, NULL, error);
    if (!file_text_close(&svg))
        return calc_no_memory(error);
    if (ok)
        record_replace(sh, PAGE_FIGURE, svg.text);
    free(svg.text);
    return ok;
}

/* Draws one figure, or several frames, into a file (or NULL: to the session's output). */
static bool draw_off_page(shell *sh, lexer *lx, plot_figure *frame, size_t frames, const char *file) {
    file_report written;
    text_out text;
    if (!text_begin(&text, sh, frames > 1 ? TEXT_MOTION : TEXT_PICTURE, lx->error))
        return false;
    const bool data = answer_is_data(&sh->set), on_terminal = !data && shell_on_terminal(sh);
    plot_target to = {.file = file,
                      .out = text.to,
                      .terminal = terminal_kind(sh, on_terminal),
                      .color = sh->set.color_out && !data,
                      .unicode = typeset_unicode(),
                      .columns = sh->set.plot_width,
                      .rows = sh->set.plot_height,
                      .width = papers[sh->set.plot_paper].width,
                      .height = papers[sh->set.plot_paper].height,
                      .text = papers[sh->set.plot_paper].text,
                      .stop = &shell_stop};
    int columns, rows;
    terminal_size(sh, &columns, &rows);
    if (frames > 1 && on_terminal && sh->out == stdout && shell_escapes() && to.columns <= columns)
        to.moving = rows;
    if (!file && !to.columns)
        to.columns = columns, to.rows = rows;
    fflush(sh->out);
    char *caption = sh->set.plot_caption ? caption_of(sh, file ? 100 : to.columns) : NULL;
    if (sh->set.plot_caption && !caption)
        return text_end(&text, false), calc_no_memory(lx->error);
    to.caption = caption;
    const bool ok = plot_draw(frame, frames, &to, &written, lx->error);
    progress_wipe();
    if (ok && !file && caption)
        fputs(caption, text.to);
    free(caption);
    if (!text_end(&text, ok) || !ok)
        return false;
    if (file)
        target_report(sh, file, &written);
    return true;
}

/* Draws one figure, or several frames. A page gets the last frame. */
static bool draw(shell *sh, lexer *lx, plot_figure *frame, size_t frames, const char *file) {
    const bool on_page = !file && record_on_page(sh);
    if (on_page && !draw_on_page(sh, &frame[frames - 1], lx->error)) {
        lx->error->refused |= record_alone(sh); /* a lesson ends: its page must not lack a figure */
        return false;
    }
    const bool ok = (on_page && record_alone(sh)) || draw_off_page(sh, lx, frame, frames, file);
    if (on_page)
        record_replaced(sh);
    return ok;
}

/* ---- figures ----------------------------------------------------------------------------------- */

/* FIGURE [| FIGURE ...] of a statement. */
typedef struct panels {
    panel *list;
    size_t count, room;
} panels;

static void panels_free(shell *sh, panels *p) {
    while (p->count > 0)
        parsed_drop(sh, &p->list[--p->count].parsed);
    free(p->list);
}

/* A clause of the last figure, which alone may have `to` and `frames`. */
static given_clause *last_said(panels *p, const char *word) {
    return parsed_clause(&p->list[p->count - 1].parsed, word, 0);
}

static bool read_panels(shell *sh, lexer *lx, const grammar *row, panels *out) {
    do {
        if (out->count)
            lex_next(lx);
        if (!fret_array_room(&out->list, &out->room, out->count + 1, sizeof *out->list))
            return calc_no_memory(lx->error);
        if (!panel_read(sh, lx, row, &out->list[out->count]))
            return false;
        out->count++;
    } while (lx->kind == T_BAR && !last_said(out, "to") && !last_said(out, "frames"));
    return parsed_end(lx, &out->list[out->count - 1].parsed);
}

static bool draw_panels(shell *sh, lexer *lx, panels *p, plot_figure *f, motion *m) {
    for (size_t i = 0; i < p->count; i++)
        if (!panel_draw(sh, lx, &p->list[i], f, m))
            return false;
    return true;
}

/* The error of a statement with neither a figure nor a range. wants: what is expected. False. */
static bool fail_figure(const calc *c, lexer *lx, const grammar *row, const char *wants) {
    char word[LEX_NAME], all[CALC_ERROR_TEXT / 2] = "";
    const token_kind next = lex_peek(lx);
    size_t own;
    const bool unknown = lx->kind == T_NAME && !name_taken(lx->text + lx->at, lx->len) &&
                         !names_find(&c->names, lx->text + lx->at, lx->len, &own);
    lex_word(lx, word);
    const char *near = unknown ? suggest(word, figure_name) : NULL;
    if (lex_is(lx, "map"))
        return lex_fail(lx, "expected map EXPR for A = LO .. HI for B = LO .. HI");
    if (near && !strcmp(near, word)) {
        lex_next(lx);
        return lex_fail(lx, "unexpected '%.*s': %s is a figure; | puts another beside it", LEX_WORD(lx),
                        near);
    }
    if (unknown && hint_from(word))
        return lex_fail(lx, "there is no figure '%s': %s", word, hint_from(word));
    if (near)
        return lex_fail(lx, "there is no figure '%s': did you mean %s?", word, near);
    if (!unknown || (next != T_END && next != T_BAR))
        return lex_fail(lx, "expected %s", wants);
    for (size_t i = 0; figure_name(i); i++)
        list_word(all, sizeof all, ", ", figure_name(i));
    return lex_fail(lx, "there is no figure '%s': %s %s, or EXPR, ... for NAME = LO .. HI", word,
                    row->command, all);
}

/* Reads all figures and the file's name ("": none); checks before long work that it can be written. */
static bool read_figures(shell *sh, lexer *lx, const grammar *row, const char *wants, panels *out,
                         char *file) {
    lexer begin = *lx;
    file[0] = 0;
    if (!read_panels(sh, lx, row, out))
        return false;
    if (!panel_is_whole(&out->list[0]))
        return !range_hides(lx, &out->list[0].parsed) && fail_figure(&sh->calc, &begin, row, wants);
    const given_clause *to = last_said(out, "to");
    if (to)
        hole_file(lx, &to->hole[0], file);
    return !to || plot_check(file, &shell_stop, lx->error) || given_place(lx->error, to);
}

/* A map under --part: writes its values as the rows of a table. */
static bool share_map(shell *sh, lexer *lx, panels *p) {
    const given_clause *to = last_said(p, "to");
    if (to)
        return calc_fail(lx->error, to->at, to->len,
                         "a share of a map is rows, not a picture: they go to standard output, without `to`");
    return panel_list(sh, lx, &p->list[0]);
}

/* Draws, but in a replay only into files: drawings in the terminal are not compared. */
static bool draw_plot(shell *sh, lexer *lx, plot_figure *f, const char *file) {
    if (!sh->replaying || file)
        return draw(sh, lx, f, 1, file);
    fprintf(sh->out, "%c\n", MARK_DRAWING);
    return true;
}

bool do_plot(shell *sh, lexer *lx, parsed *all) {
    static const char wants[] = "EXPR, ... for NAME = LO .. HI, such as for FN = 1 N .. 9 N";
    char file[FILE_NAME];
    plot_figure f = {.count = 0};
    panels p = {.count = 0};
    bool ok = read_figures(sh, lx, all->by, wants, &p, file);
    if (ok && sh->share.of && p.count == 1 && panel_is_map(lx, &p.list[0]))
        ok = share_map(sh, lx, &p);
    else if (ok)
        ok = draw_panels(sh, lx, &p, &f, NULL) && draw_plot(sh, lx, &f, *file ? file : NULL);
    plot_figure_free(&f);
    panels_free(sh, &p);
    return ok;
}

/* ---- animations --------------------------------------------------------------------------------- */

typedef struct movie {
    shell *sh;
    const lexer *lx;
    panels figures;
    motion motion;
    sweep_job over; /* the sweep over the frames */
    plot_figure *frame;
    size_t done, frames; /* drawn so far, in all */
    calc_error *error;
} movie;

/* Adds the value of the input to the titles. */
static bool title_frame(movie *m, plot_figure *f, long double v) {
    const knob *by = &m->motion.over.sweep.var;
    char number[160], title[600];
    format_value(&m->sh->set, (value){v, by->d}, number, sizeof number);
    for (size_t i = 0; i < f->count; i++) {
        char **own = &f->panel[i]->title;
        snprintf(title, sizeof title, "%.400s%s" PLOT_EXPR "%s = %s" PLOT_END, *own ? *own : "",
                 *own ? ", " : "", by->text, number);
        free(*own);
        *own = strdup(title);
        if (!*own)
            return calc_no_memory(m->error);
    }
    return true;
}

/* Makes a frame, of the scratch scene, which is at an instant of the load or a value of the input. */
static bool give_frame(void *context, const sweep *s, size_t curve, long double x,
                       const long double *values) {
    movie *m = context;
    lexer lx = *m->lx;
    plot_figure *frame = &m->frame[m->done];
    (void)curve, (void)values;
    if (m->over.missing.raised) { /* there is no such scene */
        *m->error = m->over.missing;
        return false;
    }
    lx.error = m->error;
    m->motion.trial = m->over.p.t;
    m->motion.until = s->along ? (double)x : INFINITY;
    progress_part((double)m->done++ / (double)m->frames);
    return draw_panels(m->sh, &lx, &m->figures, frame, &m->motion) && (s->along || title_frame(m, frame, x));
}

/* Makes all frames: values of an input, or instants of a load, the program if the figures follow none. */
static bool take_frames(movie *m) {
    static const char load[] = "program";
    sweep *s = &m->motion.over.sweep;
    lexer lx;
    lex_start(&lx, load, strlen(load), m->error);
    if (!m->motion.found && !range_read_along(m->sh, &lx, &(span){0, strlen(load)}, &m->motion.over))
        return false;
    s->context = &m->motion.over;
    s->steps = m->frames - 1;
    s->curves = 0;
    m->over = (sweep_job){.c = &m->sh->calc, .row = give_frame, .context = m, .error = m->error};
    return sweep_run(s, &m->over);
}

/* Draws the figures once as a whole, see `motion`, then all frames, and plays or writes these. */
static bool run_movie(movie *m, lexer *lx, const char *file) {
    plot_figure whole = {.count = 0};
    const size_t frames = m->frames;
    if (file && !file_ends(file, ".gif"))
        return calc_fail(lx->error, 0, 0, "an animation goes to a .gif file or to the terminal");
    bool ok = draw_panels(m->sh, lx, &m->figures, &whole, &m->motion);
    plot_figure_free(&whole);
    m->frame = ok ? calloc(frames, sizeof *m->frame) : NULL;
    if (ok && !m->frame)
        ok = calc_no_memory(lx->error);
    ok = ok && take_frames(m);
    progress_wipe();
    if (ok && file) { /* in the terminal the line would stand in the frames */
        char words[80];
        snprintf(words, sizeof words, "animate: gnuplot draws %zu frames (Ctrl-C stops it)", m->done);
        progress_words(words);
    }
    ok = ok && draw(m->sh, lx, m->frame, m->done, file);
    for (size_t i = 0; m->frame && i < frames; i++)
        plot_figure_free(&m->frame[i]);
    free(m->frame);
    return ok;
}

bool do_animate(shell *sh, lexer *lx, parsed *all) {
    enum { FRAMES = 80 };
    char file[FILE_NAME];
    movie *m = calloc(1, sizeof *m);
    if (!m)
        return calc_no_memory(lx->error);
    *m = (movie){.sh = sh, .lx = lx, .frames = FRAMES, .error = lx->error};
    bool ok = read_figures(sh, lx, all->by, "EXPR, ... along program, or a figure", &m->figures, file);
    const given_clause *frames = ok ? last_said(&m->figures, "frames") : NULL;
    if (frames)
        m->frames = frames->count;
    ok = ok && run_movie(m, lx, *file ? file : NULL);
    panels_free(sh, &m->figures);
    free(m);
    return ok;
}
