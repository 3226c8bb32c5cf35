/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command demo: plays a scripted session, at a terminal a step per key. The scene that it makes stays;
 * undo takes it as one change. */
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <termios.h>
#include <unistd.h>

#include "prompt/lesson.h"
#include "statement/answer.h"
#include "statement/command.h"
#include "statement/progress.h"
#include "statement/record.h"
#include "statement/scripts.h"
#include "statement/target.h"
#include "text/lines.h"
#include "text/words.h"

/* ---- keys -------------------------------------------------------------------------------------- */

static wish read_key(void) {
    struct termios before, raw;
    unsigned char c = 0, rest[32];
    if (tcgetattr(STDIN_FILENO, &before))
        return LEAVE;
    const int guard = file_guard_terminal(&before, "");
    raw = before;
    raw.c_lflag &= ~(tcflag_t)(ICANON | ECHO);
    raw.c_cc[VMIN] = 1;
    raw.c_cc[VTIME] = 0;
    raw.c_cc[VSUSP] = _POSIX_VDISABLE; /* Ctrl-Z is read, and stops the program in its old modes */
    tcsetattr(STDIN_FILENO, TCSADRAIN, &raw);
    const ssize_t n = read(STDIN_FILENO, &c, 1); /* Ctrl-C interrupts it */
    raw.c_cc[VMIN] = 0;
    tcsetattr(STDIN_FILENO, TCSADRAIN, &raw);
    enum { CTRL_D = 4, ESCAPE = 27, ASCII = 128 };
    while ((c == ESCAPE || c >= ASCII) && read(STDIN_FILENO, rest, sizeof rest) > 0) /* of the same key */
        continue;
    tcsetattr(STDIN_FILENO, TCSADRAIN, &before);
    file_unguard(guard);
    if (n == 1 && c && c == before.c_cc[VSUSP])
        return STOP;
    return n != 1 || c == 'q' || c == 'Q' || c == CTRL_D ? LEAVE : c == 'b' || c == 'B' ? GO_BACK : GO_ON;
}

/* Asks on the terminal, not on the session's output: the question must not get into a transcript. */
static wish ask_key(shell *sh, unsigned step) {
    (void)step;
    static const char question[] = "(any key: go on, b: back, q: leave)";
    wish w;
    fflush(sh->out);
    do {
        fputs(question, stdout);
        fflush(stdout);
    } while ((w = read_key()) == STOP && !kill(0, SIGTSTP));
    printf("\r%*s\r", (int)sizeof question - 1, "");
    fflush(stdout);
    return shell_stop ? LEAVE : w;
}

/* ---- playing ----------------------------------------------------------------------------------- */

/* A lesson being played in the user's session. */
typedef struct lesson {
    shell *sh;
    const script *s;
    ask_wish *ask; /* at each step; or NULL */
    unsigned step; /* from 1 */
    settings set;  /* of the user, restored at the end, as are model and springs */
    model_id model;
    unsigned springs;
    unsigned long group; /* number of the user's last change, for undo */
    scene_mark *before;  /* the user's scene; NULL: no statement has been run */
    calc_error *error;
} lesson;

/* Is it an `ask` statement? It prints its question itself; its text, which holds the answer, is not shown. */
static bool is_question(const char *line) {
    return line && !strncmp(line, "ask ", 4);
}

/* Where the statements begin in the step at line i: a step is comments, then statements. */
static size_t statements_of(const script *s, size_t i) {
    while (s->line[i] && line_is_remark(s->line[i]))
        i++;
    return i;
}

static size_t end_of(const script *s, size_t i) {
    i = statements_of(s, i);
    while (s->line[i] && !line_is_remark(s->line[i]))
        i++;
    return i;
}

static void run_in_lesson(lesson *l, const char *line) {
    static const source from = {NULL, true}; /* goes on after an error: the lesson may be about it */
    shell_line(l->sh, &from, line, strlen(line), 1);
}

static void begin_lesson(lesson *l) {
    l->sh->set = l->set;
    l->sh->set.report = REPORT_OFF;
    scene_set_model(&l->sh->calc.scene, MODEL_AUTO, 0);
    run_in_lesson(l, "reset all");
}

/* Runs the lesson again, without output, from its beginning to before line `to`. */
static void rewind_to(lesson *l, size_t to) {
    FILE *out = l->sh->out, *err = l->sh->err, *nowhere = shell_nowhere(l->error);
    if (!nowhere)
        return;
    l->sh->out = l->sh->err = nowhere;
    l->sh->waits = false;
    begin_lesson(l);
    for (size_t i = 0; i < to; i++)
        if (!line_is_remark(l->s->line[i]))
            run_in_lesson(l, l->s->line[i]);
    l->sh->out = out;
    l->sh->err = err;
    l->sh->waits = l->ask == ask_key;
}

static size_t step_before(const script *s, size_t to) {
    size_t i = 0;
    while (end_of(s, i) < to)
        i = end_of(s, i);
    return i;
}

/* Must the lesson end: Ctrl-C, no memory, a refused file, an error in l? Other errors are part of it. */
static bool ended(const lesson *l) {
    return l->sh->stopped || l->sh->refused || l->error->raised || shell_stop;
}

/* Writes a line of the lesson as text, to the page, or as a JSON object; CSV leaves it out. */
static void tell_line(const lesson *l, page_part part, const char *line) {
    enum { LINE = 420 }; /* bytes: LESSON_LINE of lesson.c, and a prompt */
    answer a;
    char text[LINE], on_page[LINE + 1];
    snprintf(text, sizeof text, "%s%s", part == PAGE_STATEMENT ? "fret> " : "", line);
    snprintf(on_page, sizeof on_page, "%s\n", text + (part == PAGE_WORDS ? strspn(text, "# ") : 0));
    record_replace(l->sh, part, part == PAGE_TITLE ? text : on_page);
    answer_begin(&a, &l->set, l->sh->out);
    answer_words(&a, "%s\n", text);
    if (*text) {
        answer_message(&a, "text", text);
        answer_done(&a);
    }
    record_replaced(l->sh);
}

static void tell_remark(const lesson *l, const char *line) {
    tell_line(l, *line ? PAGE_WORDS : PAGE_GAP, line);
}

static void run_step(lesson *l, size_t i, size_t end) {
    if (!l->before && i < end) {
        if (!(l->before = undo_mark(&l->sh->calc))) {
            calc_no_memory(l->error);
            return;
        }
        begin_lesson(l);
    }
    for (; i < end && !ended(l); i++) {
        if (!is_question(l->s->line[i]))
            tell_line(l, PAGE_STATEMENT, l->s->line[i]);
        run_in_lesson(l, l->s->line[i]);
    }
}

/* Plays the step at line *i, then moves *i to the next step or the one before; false: the lesson is over. */
static bool play_step(lesson *l, size_t *i) {
    const script *s = l->s;
    const size_t statements = statements_of(s, *i), end = end_of(s, *i);
    if (*i < statements)
        tell_remark(l, "");
    for (size_t j = *i; j < statements; j++)
        tell_remark(l, s->line[j]);
    const wish w = l->ask && s->line[statements] ? l->ask(l->sh, l->step) : GO_ON;
    if (w != GO_ON && !shell_stop) /* a replay needs to know it */
        fprintf(l->sh->out, "(%s at step %u)\n", w == GO_BACK ? "back" : "left", l->step);
    if (w == GO_ON) {
        run_step(l, statements, end);
        *i = end;
        l->step++;
    } else if (w == GO_BACK && l->before) {
        l->step -= *i > 0;
        *i = step_before(s, *i);
        rewind_to(l, *i);
    }
    return w != LEAVE && !ended(l);
}

/* After a lesson, names the next one. */
static void tell_next(const lesson *l) {
    enum { NEXT = 200 };
    char text[NEXT];
    const script *s = l->s, *next = s + 1;
    if (!s->answer)
        return;
    while (next->name && !next->answer)
        next++;
    snprintf(text, sizeof text,
             next->name ? "Next: demo %s, %s" : "The last of the lessons: show demos lists all.", next->name,
             next->title);
    tell_remark(l, "");
    tell_remark(l, text);
}

/* False: broken off, and the scene is as before; l->error, or a statement's report, says why. */
static bool play_lesson(lesson *l) {
    shell *sh = l->sh;
    const bool stopped = sh->stopped, refused = sh->refused, interactive = sh->interactive, waits = sh->waits;
    ask_wish *const replayed = sh->replayed;
    const int depth = progress_suspend();
    sh->stopped = sh->refused = sh->interactive = false; /* not interactive: an error is one line */
    sh->waits = l->ask == ask_key;
    sh->replayed = NULL; /* a lesson within this one asks nothing */
    tell_line(l, PAGE_TITLE, l->s->title);
    for (size_t i = 0; l->s->line[i] && play_step(l, &i);)
        ;
    const bool ok = !ended(l);
    if (shell_stop && !sh->stopped)
        calc_interrupted(l->error);
    sh->set = l->set;
    scene_set_model(&sh->calc.scene, l->model, l->springs);
    sh->stopped |= stopped;
    sh->refused |= refused;
    sh->interactive = interactive;
    sh->waits = waits;
    sh->replayed = replayed;
    progress_resume(depth);
    if (ok)
        tell_next(l);
    if (l->before)
        undo_scene(&sh->calc, l->before);
    if (!ok || record_alone(sh))
        undo_since(&sh->calc, l->group);
    return ok;
}

/* Plays the lesson onto an HTML page, without keys; the scene stays as it was. */
static bool write_lesson(lesson *l, FILE *to) {
    shell *sh = l->sh;
    const settings set = sh->set;
    l->ask = NULL;
    l->set.format = FORMAT_TEXT;
    l->set.pages = l->set.color = l->set.color_out = false;
    if (!record_page(sh, to, l->s->title, l->error))
        return false;
    const bool played = play_lesson(l), whole = record_page_end(sh, l->error);
    sh->set = set;
    return played && whole;
}

/* Finds a built-in lesson; NULL with an error that points at its name in the statement. */
static const script *built_in(const char *name, const span *at, calc_error *error) {
    size_t row;
    if (word_among(script_name, name, strlen(name), &row))
        return &scripts[row];
    const char *near = suggest(name, script_name);
    calc_raise(error, at->at, at->len,
               near ? "there is no demo '%s': did you mean %s?"
                    : "there is no demo '%s': show demos lists them",
               name, near);
    return NULL;
}

/* Opens the page before the lesson is played, so that a bad name is known at once. */
static bool open_page(const lexer *lx, const given_clause *to, target *t) {
    char name[FILE_NAME];
    hole_file(lx, &to->hole[0], name);
    if (!file_ends(name, ".html"))
        return calc_fail(lx->error, to->hole[0].at, to->hole[0].len, "a handout goes to a page: FILE.html");
    return target_file(lx, &to->hole[0], t);
}

static bool play(shell *sh, lexer *lx, const script *s, bool tour, target *page) {
    const scene *now = &sh->calc.scene;
    const bool text = sh->set.format == FORMAT_TEXT;
    lesson l = {.sh = sh,
                .s = s,
                .ask = sh->interactive && text && isatty(STDOUT_FILENO) ? ask_key : sh->replayed,
                .step = 1,
                .set = sh->set,
                .model = now->model,
                .springs = now->springs,
                .group = sh->calc.undo.group,
                .error = lx->error};
    if (page->to)
        return write_lesson(&l, page->to);
    if (!play_lesson(&l))
        return false;
    if (text && l.before && shell_aside(sh, sh->out))
        fputs("The scene is the lesson's now: go on with it. `undo` brings back yours.\n", sh->out);
    if (tour) {
        tell_remark(&l, "");
        tell_remark(&l, "Lessons, such as `demo pressing`: `show demos` lists them.");
    }
    return true;
}

/* A name with a `.` or a `/` is a file, others are built-in lessons. */
bool do_demo(shell *sh, lexer *lx, parsed *all) {
    lesson_text own = {.title = NULL};
    target page = {.to = NULL};
    char name[FILE_NAME] = "tour";
    const given_clause *named = parsed_clause(all, "", 0), *to = parsed_clause(all, "to", 0);
    if (named)
        hole_file(lx, &named->hole[0], name);
    const bool file = strpbrk(name, "./") != NULL;
    const script *s = file ? NULL : built_in(name, &all->list[0].hole[0], lx->error);
    bool ok = file ? lesson_read(sh, name, &own, lx->error) || given_place(lx->error, named) : s != NULL;
    const script taught = {.title = own.title, .line = (const char *const *)own.line};
    ok = ok && (!to || open_page(lx, to, &page)) && play(sh, lx, s ? s : &taught, !named, &page);
    ok = target_close(sh, lx, &page, ok);
    lesson_free(&own);
    return ok;
}
