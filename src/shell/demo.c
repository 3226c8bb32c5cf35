/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plays scripted sessions: straight through, or a key per step at a terminal. Touches no scene of the user's.
 */
#include <errno.h>
#include <string.h>
#include <termios.h>
#include <unistd.h>

#include "calc/file.h"
#include "shell/command.h"
#include "shell/scripts.h"
#include "shell/show.h"

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

static wish ask(shell *sh) {
    static const char question[] = "(any key: go on, b: back, q: leave)";
    fputs(question, sh->out);
    fflush(sh->out);
    const wish w = key();
    fprintf(sh->out, "\r%*s\r", (int)sizeof question - 1, "");
    if (w == BACK)
        fputs("(back)\n", sh->out);
    return shell_stop ? LEAVE : w;
}

/* ---- playing ----------------------------------------------------------------------------------- */

static bool is_comment(const char *line) {
    return *line == '#' || !*line;
}

/* A step is what is asked and then what is done: where its statements begin, and where it ends. */
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

static void begin(shell *own, const shell *sh) {
    shell_init(own, sh->out, sh->err);
    own->set = sh->set;
    own->set.report = REPORT_OFF;
    own->replaying = sh->replaying;
}

static void run(shell *own, const char *line) {
    static const source from = {NULL, true}; /* an error may be what the lesson is about */
    shell_line(own, &from, line, strlen(line), 1);
}

/* A new session, as far as before line `to`, unseen. */
static void rewind_to(shell *own, const shell *sh, const script *s, size_t to, FILE *nowhere) {
    shell_free(own);
    begin(own, sh);
    own->out = own->err = nowhere;
    for (size_t i = 0; i < to; i++)
        if (!is_comment(s->line[i]))
            run(own, s->line[i]);
    own->out = sh->out;
    own->err = sh->err;
}

static size_t step_before(const script *s, size_t to) {
    size_t i = 0;
    while (end_of(s, i) < to)
        i = end_of(s, i);
    return i;
}

/* Is there something wrong that no lesson is about? */
static bool ended(const shell *own) {
    return own->stopped || own->refused;
}

/* False: the user leaves. Goes back to an earlier step by *next. */
static bool play_step(shell *own, const shell *sh, const script *s, size_t i, bool keys, size_t *next) {
    const bool shown = sh->set.format == FORMAT_TEXT;
    const size_t statements = statements_of(s, i);
    *next = end_of(s, i);
    if (shown && i < statements)
        fputc('\n', sh->out);
    for (; shown && i < statements; i++)
        fprintf(sh->out, "%s\n", s->line[i]);
    const wish w = keys && s->line[statements] ? ask(own) : ON;
    for (i = statements; w == ON && i < *next && !shell_stop && !ended(own); i++) {
        if (shown)
            fprintf(sh->out, "fret> %s\n", s->line[i]);
        run(own, s->line[i]);
    }
    return w != LEAVE && !shell_stop && !ended(own) && (w == ON || (*next = (size_t)-1));
}

/* False: it could not go on, as has been reported. */
static bool play(shell *sh, const script *s, bool keys, calc_error *error) {
    shell own;
    FILE *nowhere = fopen("/dev/null", "w");
    if (!nowhere)
        return calc_errno(error, errno, "cannot write /dev/null");
    begin(&own, sh);
    if (sh->set.format == FORMAT_TEXT)
        fprintf(sh->out, "%s\n", s->title);
    size_t i = 0, next;
    while (s->line[i] && play_step(&own, sh, s, i, keys, &next)) {
        if (next == (size_t)-1) {
            i = step_before(s, i);
            rewind_to(&own, sh, s, i, nowhere);
        } else {
            i = next;
        }
    }
    scene_also_used(&sh->calc.scene, scene_answered_by(&own.calc.scene));
    const bool ok = !ended(&own);
    shell_free(&own);
    fclose(nowhere);
    return ok;
}

/* In a session of its own: the user's stays as it is. */
bool do_demo(shell *sh, lexer *lx, const command *self) {
    const bool tour = lx->kind == T_END;
    const script *s = tour ? script_find("tour", 4) : script_find(lx->text + lx->at, word_at(lx));
    (void)self;
    if (!s) {
        char word[LEX_NAME];
        snprintf(word, sizeof word, "%.*s", (int)word_at(lx), lx->text + lx->at);
        const char *near = suggest(word, script_name);
        return lex_fail(lx,
                        near ? "there is no demo '%s': did you mean %s?"
                             : "there is no demo '%s': show demos lists them",
                        word, near);
    }
    if (!tour) {
        lex_seek(lx, lx->at + word_at(lx));
        if (!at_end(lx))
            return false;
    }
    const bool keys = !tour && sh->interactive && sh->set.format == FORMAT_TEXT && isatty(STDOUT_FILENO);
    if (!play(sh, s, keys, lx->error) || shell_stop)
        return shell_stop ? calc_interrupted(lx->error) : false;
    if (tour && sh->set.format == FORMAT_TEXT)
        fputs("\nLessons, such as `demo pressing`: `show demos` lists them.\n", sh->out);
    return true;
}
