/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command live: starts the full-screen mode, runs its statements and completes its lines. */
#include <stdlib.h>
#include <string.h>

#include "help/complete.h"
#include "live/live.h"
#include "prompt/lesson.h"
#include "statement/command.h"
#include "statement/progress.h"
#include "statement/record.h"
#include "statement/text.h"
#include "text/file.h"

static bool run_for_live(void *self, const char *line, char **answer) {
    static const source from = {NULL, false};
    shell *sh = self;
    file_text told;
    if (!file_text_open(&told))
        return false;
    FILE *out = told.to, *err = told.to;
    record_line(sh, line, strlen(line));
    record_swap(sh, &out, &err);
    const bool interactive = sh->interactive;
    sh->interactive = false; /* errors are one line, a demo does not wait for keys */
    const bool ok = shell_line(sh, &from, line, strlen(line), 1);
    sh->interactive = interactive;
    record_swap(sh, &out, &err); /* a recording may have begun or ended */
    if (file_text_close(&told))
        *answer = told.text;
    return ok && *answer;
}

static void complete_line(void *self, char *line, size_t size, size_t *cursor) {
    shell *sh = self;
    candidates found = {.word = NULL};
    complete(sh, line, *cursor, &found);
    if (found.count > 0) {
        size_t same = strlen(found.word[0]);
        for (size_t i = 1; i < found.count; i++)
            for (size_t j = 0; j < same; j++)
                if (found.word[i][j] != found.word[0][j])
                    same = j;
        const char last = same ? found.word[0][same - 1] : 0;
        const size_t rest = strlen(line + *cursor) + 1, end = found.start + same;
        const bool blank = found.count == 1 && last != '=' && last != '(' && end + 1 + rest <= size;
        if (end + blank + rest <= size) {
            memmove(line + end + blank, line + *cursor, rest);
            memcpy(line + found.start, found.word[0], same);
            if (blank)
                line[end] = ' ';
            *cursor = end + blank;
        }
    }
    candidates_free(&found);
}

/* Prints the last screen of a script played without a terminal. */
static bool show_screen(shell *sh, const char *screen, calc_error *error) {
    text_out t;
    if (!text_begin(&t, sh, TEXT_PICTURE, error))
        return false;
    fputs(screen, t.to);
    return text_end(&t, true);
}

static bool run_live(shell *sh, const char *const *script, calc_error *error) {
    const settings before = sh->set;
    const live_host host = {.self = sh,
                            .calc = &sh->calc,
                            .digits = &sh->set.digits,
                            .quit = &sh->quit,
                            .compared = &sh->compared,
                            .stop = &shell_stop,
                            .run = run_for_live,
                            .complete = complete_line};
    live_work work = {.frames = 0};
    char *screen = NULL;
    fflush(sh->out);
    sh->set.color = sh->set.color_out = false;
    sh->set.pages = false; /* a pager would take the terminal */
    sh->on_screen = true;
    progress_hide();
    bool ok = live_run(&host, script, &work, &screen, error);
    sh->set.color = before.color;
    sh->set.color_out = before.color_out;
    sh->set.pages = before.pages;
    sh->on_screen = false;
    ok = (!screen || show_screen(sh, screen, error)) && ok;
    free(screen);
    if (ok && sh->set.timing && work.frames)
        shell_say(sh, "live: %zu frames, %.3g ms of work each, %.3g ms the longest", work.frames,
                  1e3 * work.total / (double)work.frames, 1e3 * work.worst);
    return ok;
}

bool shell_live(shell *sh, const char *path, calc_error *error) {
    lesson_text script = {.title = NULL};
    if (sh->on_screen)
        return calc_fail(error, 0, 0, "the full-screen mode is on already");
    bool ok = !path || lesson_lines(path, &script, error);
    if (!sh->replaying) /* a transcript holds the statements that were run on the screen after `live` */
        ok = ok && run_live(sh, path ? (const char *const *)script.line : NULL, error);
    lesson_free(&script);
    return ok;
}

bool do_live(shell *sh, lexer *lx, parsed *all) {
    char name[FILE_NAME];
    const bool script = all->count > 0;
    if (script)
        hole_file(lx, &all->list[0].hole[0], name);
    return shell_live(sh, script ? name : NULL, lx->error);
}
