/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plays scripted sessions: straight through, or a key per step at a terminal. A scene that one makes stays;
 * it is one change, for undo. */
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <termios.h>
#include <unistd.h>

#include "prompt/show.h"
#include "statement/answer.h"
#include "statement/command.h"
#include "statement/progress.h"
#include "statement/scripts.h"
#include "text/file.h"

const char *script_name(size_t i) {
    return scripts[i].name;
}

static const script *script_find(const char *name, size_t len) {
    const script *s = scripts;
    while (s->name && (strlen(s->name) != len || memcmp(s->name, name, len)))
        s++;
    return s->name ? s : NULL;
}

bool show_demos(shell *sh, FILE *to) {
    (void)sh;
    for (const script *s = scripts; s->name; s++)
        fprintf(to, "%-11s %s\n", s->name, s->title);
    return true;
}

/* ---- keys -------------------------------------------------------------------------------------- */

typedef enum wish { ON, BACK, LEAVE } wish;

/* One key, as it is typed. */
static wish key(void) {
    struct termios before, raw;
    unsigned char c = 0;
    if (tcgetattr(STDIN_FILENO, &before))
        return LEAVE;
    const int guard = file_guard_terminal(STDIN_FILENO, &before, "");
    raw = before;
    raw.c_lflag &= ~(tcflag_t)(ICANON | ECHO);
    raw.c_cc[VMIN] = 1;
    raw.c_cc[VTIME] = 0;
    tcsetattr(STDIN_FILENO, TCSADRAIN, &raw);
    const ssize_t n = read(STDIN_FILENO, &c, 1); /* Ctrl-C ends it */
    tcsetattr(STDIN_FILENO, TCSADRAIN, &before);
    file_unguard(guard);
    enum { CTRL_D = 4 };
    return n != 1 || c == 'q' || c == 'Q' || c == CTRL_D ? LEAVE : c == 'b' || c == 'B' ? BACK : ON;
}

/* The question goes past the session's output: a transcript must not have it. */
static wish ask_key(const shell *sh) {
    static const char question[] = "(any key: go on, b: back, q: leave)";
    fflush(sh->out);
    fputs(question, stdout);
    fflush(stdout);
    const wish w = key();
    printf("\r%*s\r", (int)sizeof question - 1, "");
    fflush(stdout);
    if (w == BACK)
        fputs("(back)\n", sh->out);
    return shell_stop ? LEAVE : w;
}

/* ---- playing ----------------------------------------------------------------------------------- */

/* In the user's session, whose settings come back when it ends. */
typedef struct lesson {
    shell *sh;
    const script *s;
    bool keys;
    settings set; /* the user's, and the model */
    bool automatic;
    model_id model;
    unsigned springs;
    unsigned long group; /* of what was done before, for undo */
    scene_mark *before;  /* the user's scene; NULL: nothing has been run */
    calc_error *error;
} lesson;

static bool is_comment(const char *line) {
    return *line == '#' || !*line;
}

/* A step is comments, then statements. Where the statements begin: */
static size_t statements_of(const script *s, size_t i) {
    while (s->line[i] && is_comment(s->line[i]))
        i++;
    return i;
}

static size_t end_of(const script *s, size_t i) {
    i = statements_of(s, i);
    while (s->line[i] && !is_comment(s->line[i]))
        i++;
    return i;
}

static void run_in_lesson(lesson *l, const char *line) {
    static const source from = {NULL, true}; /* an error may be what the lesson is about */
    shell_line(l->sh, &from, line, strlen(line), 1);
}

/* From an empty scene. */
static void begin_lesson(lesson *l) {
    l->sh->set = l->set;
    l->sh->set.report = REPORT_OFF;
    scene_set_model(&l->sh->calc.scene, true, MODEL_CLOSED, 0);
    run_in_lesson(l, "reset all");
}

/* Again from the beginning as far as before line `to`, unseen. */
static bool rewind_to(lesson *l, size_t to) {
    FILE *out = l->sh->out, *err = l->sh->err, *nowhere = fopen("/dev/null", "w");
    if (!nowhere)
        return calc_errno(l->error, errno, "cannot write /dev/null");
    l->sh->out = l->sh->err = nowhere;
    begin_lesson(l);
    for (size_t i = 0; i < to; i++)
        if (!is_comment(l->s->line[i]))
            run_in_lesson(l, l->s->line[i]);
    l->sh->out = out;
    l->sh->err = err;
    fclose(nowhere);
    return true;
}

static size_t step_before(const script *s, size_t to) {
    size_t i = 0;
    while (end_of(s, i) < to)
        i = end_of(s, i);
    return i;
}

/* An error of a statement may be what the lesson shows; these are not. */
static bool ended(const lesson *l) {
    return l->sh->stopped || l->sh->refused || l->error->raised || shell_stop;
}

/* A line of the lesson, as text or as an object of JSON; CSV has no place for it. */
static void tell_line(const lesson *l, const char *prompt, const char *line) {
    enum { LINE = 400 }; /* bytes: a line of a script is one of a terminal */
    answer a;
    char text[LINE];
    snprintf(text, sizeof text, "%s%s", prompt, line);
    answer_begin(&a, &l->set, l->sh->out);
    answer_words(&a, "%s\n", text);
    if (!*text)
        return;
    answer_message(&a, "text", text);
    answer_done(&a);
}

static void run_step(lesson *l, size_t i, size_t end) {
    if (!l->before && i < end) {
        if (!(l->before = undo_mark(&l->sh->calc))) {
            calc_raise_memory(l->error);
            return;
        }
        begin_lesson(l);
    }
    for (; i < end && !ended(l); i++) {
        tell_line(l, "fret> ", l->s->line[i]);
        run_in_lesson(l, l->s->line[i]);
    }
}

/* False: it is over. *i: on to the next step, or back to one before. */
static bool play_step(lesson *l, size_t *i) {
    const script *s = l->s;
    const size_t statements = statements_of(s, *i), end = end_of(s, *i);
    if (*i < statements)
        tell_line(l, "", "");
    for (size_t j = *i; j < statements; j++)
        tell_line(l, "", s->line[j]);
    const wish w = l->keys && s->line[statements] ? ask_key(l->sh) : ON;
    if (w == ON) {
        run_step(l, statements, end);
        *i = end;
    } else if (w == BACK && l->before) {
        *i = step_before(s, *i);
        rewind_to(l, *i);
    }
    return w != LEAVE && !ended(l);
}

/* False: it could not go on, and the scene is as before. Without an error a statement has reported why. */
static bool play_lesson(lesson *l) {
    shell *sh = l->sh;
    const bool stopped = sh->stopped, refused = sh->refused, interactive = sh->interactive;
    const int depth = progress_apart();
    sh->stopped = sh->refused = sh->interactive = false; /* an error is one line */
    tell_line(l, "", l->s->title);
    for (size_t i = 0; l->s->line[i] && play_step(l, &i);)
        ;
    const bool ok = !ended(l);
    sh->set = l->set;
    scene_set_model(&sh->calc.scene, l->automatic, l->model, l->springs);
    sh->stopped |= stopped;
    sh->refused |= refused;
    sh->interactive = interactive;
    progress_together(depth);
    if (l->before)
        undo_scene(&sh->calc, l->before);
    if (!ok)
        undo_since(&sh->calc, l->group);
    return ok;
}

bool do_demo(shell *sh, lexer *lx, const command *self) {
    said all;
    if (!said_read(sh, lx, command_form(self), &all))
        return false;
    const bool tour = all.count == 0, text = sh->set.format == FORMAT_TEXT;
    const span *name = &all.list[0].hole[0];
    const script *s = tour ? script_find("tour", 4) : script_find(lx->text + name->at, name->len);
    const scene *now = &sh->calc.scene;
    if (!s) {
        char word[LEX_NAME];
        snprintf(word, sizeof word, "%.*s", LEX_SHOWN(name->len), lx->text + name->at);
        const char *near = suggest(word, script_name);
        return calc_fail(lx->error, name->at, name->len,
                         near ? "there is no demo '%s': did you mean %s?"
                              : "there is no demo '%s': show demos lists them",
                         word, near);
    }
    lesson l = {.sh = sh,
                .s = s,
                .keys = sh->interactive && text && isatty(STDOUT_FILENO),
                .set = sh->set,
                .automatic = now->automatic,
                .model = now->model,
                .springs = now->springs,
                .group = sh->calc.undo.group,
                .error = lx->error};
    if (!play_lesson(&l))
        return shell_stop ? calc_interrupted(lx->error) : false;
    if (text && l.before && shell_aside(sh, sh->out))
        fputs("The scene is the lesson's now: go on with it. `undo` brings back yours.\n", sh->out);
    if (tour) {
        tell_line(&l, "", "");
        tell_line(&l, "", "Lessons, such as `demo pressing`: `show demos` lists them.");
    }
    return true;
}
