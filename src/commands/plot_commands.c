/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `plot` and `animate`: reads figures and gives them to gnuplot. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "commands/figures.h"
#include "commands/panel.h"
#include "language/along.h"
#include "number/array.h"
#include "statement/answer.h"
#include "statement/progress.h"
#include "statement/target.h"
#include "statement/text.h"
#include "text/typeset.h"

/* ---- where it goes ----------------------------------------------------------------------------- */

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

/* Braille at terminals that have it, which the console of Linux does not. */
static plot_terminal terminal_kind(const shell *sh, bool on_terminal) {
    const char *term = getenv("TERM");
    if (sh->set.plot_terminal != PLOT_AUTO)
        return (plot_terminal)sh->set.plot_terminal;
    return on_terminal && typeset_unicode() && term && strcmp(term, "linux") != 0 ? PLOT_BLOCK : PLOT_DUMB;
}

/* The target; the text of the terminal begins. */
static bool begin_target(shell *sh, const char *file, text_kind kind, text_out *text, plot_target *to,
                         calc_error *error) {
    if (!text_begin(text, &sh->set, sh->out, kind))
        return calc_no_memory(error);
    const bool data = answer_is_data(&sh->set);
    *to = (plot_target){.file = file,
                        .out = text->to,
                        .terminal = terminal_kind(sh, !data && shell_on_terminal(sh)),
                        .color = sh->set.color_out && !data,
                        .unicode = typeset_unicode(),
                        .moving = kind == TEXT_MOTION && !data && sh->out == stdout &&
                                  shell_on_terminal(sh) && shell_escapes(),
                        .columns = sh->set.plot_width,
                        .rows = sh->set.plot_height,
                        .timeout = sh->set.plot_timeout,
                        .stop = &shell_stop};
    if (!file && !to->columns)
        terminal_size(sh, &to->columns, &to->rows);
    fflush(sh->out);
    return true;
}

static bool end_target(shell *sh, const char *file, text_out *text, const file_report *written, bool ok,
                       calc_error *error) {
    if (!text_end(text, ok))
        return calc_no_memory(error);
    if (ok && file)
        target_report(sh, file, written);
    return ok;
}

static bool draw(shell *sh, lexer *lx, const plot_figure *f, const char *file) {
    if (sh->replaying && !file) {
        fprintf(sh->out, "%c\n", MARK_DRAWING);
        return true;
    }
    file_report written;
    text_out text;
    plot_target to;
    if (!begin_target(sh, file, TEXT_PICTURE, &text, &to, lx->error))
        return false;
    const bool ok = plot_draw(f, &to, &written, lx->error);
    return end_target(sh, file, &text, &written, ok, lx->error);
}

/* ---- figures ----------------------------------------------------------------------------------- */

/* FIGURE [| FIGURE ...] as they have been said. */
typedef struct panels {
    panel *list;
    size_t count, room;
} panels;

static void panels_free(shell *sh, panels *p) {
    while (p->count > 0)
        said_drop(sh, &p->list[--p->count].said);
    free(p->list);
}

static heard *last_said(panels *p, const char *word) {
    return said_of(&p->list[p->count - 1].said, word, 0);
}

static bool read_panels(shell *sh, lexer *lx, const grammar *row, panels *out) {
    do {
        if (out->count)
            lex_next(lx);
        panel *grown = fret_array_for(out->list, &out->room, out->count + 1, sizeof *grown);
        if (!grown)
            return calc_no_memory(lx->error);
        out->list = grown;
        if (!panel_read(sh, lx, row, &out->list[out->count]))
            return false;
        out->count++;
    } while (lx->kind == T_BAR && !last_said(out, "to") && !last_said(out, "frames"));
    return said_end(lx, out->list[out->count - 1].said.by);
}

/* `to FILE` stands behind long work: it is looked at before. file: empty where there is none. */
static bool find_file(const lexer *lx, panels *p, char *file) {
    const heard *to = last_said(p, "to");
    file[0] = 0;
    return !to || (hole_file(lx, &to->hole[0], file) &&
                   (plot_check(file, &shell_stop, lx->error) || heard_place(lx->error, to)));
}

static bool draw_panels(shell *sh, lexer *lx, panels *p, plot_figure *f, motion *m) {
    for (size_t i = 0; i < p->count; i++)
        if (!panel_draw(sh, lx, &p->list[i], f, m))
            return false;
    return true;
}

/* Neither a figure nor a range: a figure may have been misspelt. */
static void fail_figure(const calc *c, lexer *lx) {
    char word[LEX_NAME], all[CALC_ERROR_TEXT / 2] = "";
    const token_kind next = lex_peek(lx);
    size_t own;
    const bool unknown = lx->kind == T_NAME && !name_taken(lx->text + lx->at, lx->len) &&
                         !names_find(&c->names, lx->text + lx->at, lx->len, &own);
    lex_word(lx, word);
    const char *near = unknown ? suggest(word, figure_name) : NULL;
    if (lex_is(lx, "map")) {
        lex_raise(lx, "expected map EXPR for A = LO .. HI for B = LO .. HI");
    } else if (near && !strcmp(near, word)) {
        lex_next(lx);
        lex_raise(lx, "unexpected '%.*s': %s is a figure; | puts another beside it", LEX_WORD(lx), near);
    } else if (unknown && lead_from(word)) {
        lex_raise(lx, "there is no figure '%s': %s", word, lead_from(word));
    } else if (near) {
        lex_raise(lx, "there is no figure '%s': did you mean %s?", word, near);
    } else if (!unknown || (next != T_END && next != T_BAR)) {
        lex_raise(lx, "expected EXPR, ... for VAR = LO .. HI, such as for FN = 1 N .. 9 N");
    } else {
        for (size_t i = 0; figure_name(i); i++)
            snprintf(all + strlen(all), sizeof all - strlen(all), "%s%s", i ? ", " : "", figure_name(i));
        lex_raise(lx, "there is no figure '%s': plot %s, or EXPR, ... for VAR = LO .. HI", word, all);
    }
}

bool do_plot(shell *sh, lexer *lx, const command *self) {
    char file[FILE_NAME];
    plot_figure f;
    panels p = {.count = 0};
    lexer begin = *lx;
    plot_figure_init(&f);
    bool ok = read_panels(sh, lx, command_form(self), &p);
    if (ok && !panel_is_whole(sh, lx, &p.list[0])) {
        fail_figure(&sh->calc, &begin);
        ok = false;
    }
    ok = ok && find_file(lx, &p, file) && draw_panels(sh, lx, &p, &f, NULL) &&
         draw(sh, lx, &f, *file ? file : NULL);
    plot_figure_free(&f);
    panels_free(sh, &p);
    return ok;
}

/* ---- motion ------------------------------------------------------------------------------------ */

typedef struct movie {
    shell *sh;
    const lexer *lx;
    panels figures;
    motion motion;
    plot_figure *frame;
    size_t done, frames;
    calc_error *error;
} movie;

/* The figures at an instant. */
static bool take_frame(movie *m, double time) {
    lexer lx = *m->lx;
    lx.error = m->error;
    m->motion.until = time;
    progress_part((double)m->done / (double)m->frames);
    return draw_panels(m->sh, &lx, &m->figures, &m->frame[m->done++], &m->motion);
}

/* Goes along the load on a scratch scene. */
static bool take_frames(movie *m) {
    calc *c = &m->sh->calc;
    load_mark from;
    sweep_range load = {.lo = 0};
    bool ok = true;
    trial_along a;
    trial *t = trial_open(c, m->error);
    if (!t)
        return false;
    from = t->scene.end;
    if (m->motion.load) {
        lexer lx;
        lex_start(&lx, m->motion.load, strlen(m->motion.load), m->error);
        ok = read_load(m->sh, &lx, &load.step, &load.extra, load.bound) &&
             sweep_try_load(t, &load, &from, m->error);
    }
    m->motion.at = t;
    ok = ok && trial_along_begin(&a, t, m->motion.what, from, m->frames - 1, false, m->error);
    if (ok) {
        while (ok && trial_along_next(&a, m->error))
            ok = take_frame(m, scene_time(&t->scene));
        trial_along_end(&a);
    }
    ok = ok && !m->error->raised;
    m->motion.at = NULL;
    for (input in = 0; in < INPUTS; in++)
        counted_drop(load.bound[in]);
    if (!ok)
        calc_word(c, m->error);
    trial_close(t);
    return ok;
}

static bool fill(void *context, size_t i, size_t frames, plot_figure *f, calc_error *error) {
    movie *m = context;
    (void)frames, (void)error;
    *f = m->frame[i];
    m->frame[i].count = 0;
    return true;
}

static void drawing(void *context, size_t done, size_t frames) {
    char words[80];
    (void)context;
    snprintf(words, sizeof words, "animate: gnuplot draws %zu frames (Ctrl-C stops it)", frames);
    if (done == frames)
        progress_words(words);
}

static bool draw_movie(movie *m, lexer *lx, const char *file) {
    file_report written;
    text_out text;
    plot_target to;
    if (!begin_target(m->sh, file, TEXT_MOTION, &text, &to, lx->error))
        return false;
    const plot_movie of = {.frames = m->done, .fill = fill, .progress = drawing, .context = m};
    const bool ok = plot_animate(&of, &to, &written, lx->error);
    progress_wipe();
    return end_target(m->sh, file, &text, &written, ok, lx->error);
}

/* Draws the figures once as they stand, then at every instant, then all of it. */
static bool run_movie(movie *m, lexer *lx, const char *file) {
    plot_figure whole;
    const size_t frames = m->frames;
    plot_figure_init(&whole);
    bool ok = draw_panels(m->sh, lx, &m->figures, &whole, &m->motion);
    plot_figure_free(&whole);
    if (ok && !m->motion.found)
        m->motion.what = ALONG_PROGRAM;
    m->frame = ok ? calloc(frames, sizeof *m->frame) : NULL;
    if (ok && !m->frame)
        ok = calc_no_memory(lx->error);
    if (ok && frames < 2)
        ok = calc_fail(lx->error, 0, 0, "an animation takes 2 frames or more");
    ok = ok && take_frames(m) && draw_movie(m, lx, file);
    for (size_t i = 0; m->frame && i < frames; i++)
        plot_figure_free(&m->frame[i]);
    free(m->frame);
    free(m->motion.load);
    return ok;
}

bool do_animate(shell *sh, lexer *lx, const command *self) {
    enum { FRAMES = 80 };
    char file[FILE_NAME];
    lexer begin = *lx;
    movie *m = calloc(1, sizeof *m);
    if (!m)
        return calc_no_memory(lx->error);
    *m = (movie){.sh = sh, .lx = lx, .frames = FRAMES, .error = lx->error};
    bool ok = read_panels(sh, lx, command_form(self), &m->figures) &&
              (panel_is_whole(sh, lx, &m->figures.list[0]) ||
               lex_fail(&begin, "expected EXPR, ... along program, or a figure"));
    const heard *frames = ok ? last_said(&m->figures, "frames") : NULL;
    if (frames)
        m->frames = frames->count;
    ok = ok && find_file(lx, &m->figures, file) && run_movie(m, lx, *file ? file : NULL);
    panels_free(sh, &m->figures);
    free(m);
    return ok;
}
