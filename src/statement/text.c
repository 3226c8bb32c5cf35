/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text on its way out: as it is, as an object for programs, or by the pager, a program that is started at the
 * user's terminal, of which a recorder is told. */
#include "statement/text.h"

#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "statement/answer.h"
#include "statement/progress.h"
#include "statement/record.h"
#include "text/characters.h"

/* ---- the pager: $PAGER, else less or more ------------------------------------------------------- */

/* Columns that a line takes, without colours. */
static size_t columns(const char *line, size_t n) {
    size_t count = 0;
    for (size_t i = 0, plain; i < n; i += plain) {
        plain = line[i] == '\033' ? strcspn(line + i, "m") + 1 : strcspn(line + i, "\033\n");
        count += line[i] == '\033' ? 0 : text_columns(line + i, plain);
    }
    return count;
}

/* Does the text have more lines than the terminal of standard output? False where that is none. */
static bool pager_needed(const char *text) {
    struct winsize size = {.ws_row = 0};
    size_t rows = 1; /* the prompt */
    ioctl(STDOUT_FILENO, TIOCGWINSZ, &size);
    if (size.ws_row == 0 || size.ws_col == 0)
        return false;
    while (*text) {
        const size_t n = strcspn(text, "\n"), wide = columns(text, n);
        rows += wide > 0 ? (wide - 1) / size.ws_col + 1 : 1;
        text += n + (text[n] == '\n');
    }
    return rows > size.ws_row;
}

/* A command of the shell. */
static const char *pager_program(void) {
    const char *wanted = getenv("PAGER");
    if (wanted)
        return *wanted && strcmp(wanted, "cat") ? wanted : NULL;
    return "for i in less more; do command -v $i >/dev/null 2>&1 && exec $i; done; exit 1";
}

/* Shows it; false: there is no pager, or it failed. */
static bool pager_show(const char *text) {
    const char *name = pager_program();
    struct sigaction ignore = {.sa_handler = SIG_IGN}, before;
    if (!name)
        return false;
    setenv("LESS", "FRX", 0); /* ends by itself where all fits, and leaves the text on the screen */
    fflush(stdout);
    sigaction(SIGINT, &ignore, &before); /* Ctrl-C is the pager's, which asks for its own */
    FILE *to = popen(name, "w");
    if (to)
        fputs(text, to);
    const bool shown = to && pclose(to) == 0;
    sigaction(SIGINT, &before, NULL);
    return shown;
}

/* ---- the text ---------------------------------------------------------------------------------- */

bool text_begin(text_out *t, const shell *sh, text_kind kind, calc_error *error) {
    const settings *set = &sh->set;
    progress_wipe();
    *t = (text_out){.set = set, .out = sh->out, .to = sh->out, .kind = kind, .error = error};
    const bool paged = set->pages && set->pager != PAGER_OFF && kind != TEXT_MOTION;
    if (kind > TEXT_ANSWERS && !answer_is_data(set) && !paged)
        return true;
    if (!file_text_open(&t->kept))
        return calc_no_memory(error);
    t->to = t->kept.to;
    return true;
}

/* A recorder has it either way. */
static void show_text(const text_out *t) {
    const bool page = t->set->pages && t->set->pager != PAGER_OFF &&
                      (t->set->pager == PAGER_ON || pager_needed(t->kept.text));
    fflush(t->out);
    if (page && pager_show(t->kept.text))
        record_aside(t->kept.text);
    else
        fputs(t->kept.text, t->out);
}

/* The text with what does not show escaped, in place of it. */
static bool make_safe(text_out *t) {
    file_text safe;
    const bool ok = file_text_open(&safe);
    for (const char *line = t->kept.text; ok && *line;) {
        const size_t n = strcspn(line, "\n");
        print_safe(safe.to, line, n);
        putc('\n', safe.to);
        line += n + (line[n] == '\n');
    }
    free(t->kept.text);
    t->kept.text = NULL;
    if (!ok || !file_text_close(&safe))
        return false;
    t->kept = safe;
    return true;
}

bool text_end(text_out *t, bool keep) {
    progress_wipe();
    if (t->to == t->out)
        return true;
    const bool data = answer_is_data(t->set);
    if (!file_text_close(&t->kept))
        return calc_no_memory(t->error);
    const bool ok = data || t->kind > TEXT_ANSWERS || make_safe(t), any = ok && keep && t->kept.size > 0;
    if (any && data && t->kind == TEXT_ANSWERS) {
        fputs(t->kept.text, t->out);
    } else if (any && data) {
        answer a;
        answer_begin(&a, t->set, t->out);
        answer_message(&a, "text", t->kept.text);
        answer_done(&a);
    } else if (any) {
        show_text(t);
    }
    free(t->kept.text);
    return ok || calc_no_memory(t->error);
}
