/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes long texts: as they are, as a JSON object, or through the pager. Starts the pager's program on the
 * terminal, and gives the recorder what that shows. */
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

/* Width of a line on the terminal, without escape sequences. */
static size_t line_width(const char *line, size_t n) {
    size_t count = 0;
    for (size_t i = 0, plain; i < n; i += plain) {
        plain = line[i] == '\033' ? strcspn(line + i, "m") + 1 : strcspn(line + i, "\033\n");
        count += line[i] == '\033' ? 0 : text_columns(line + i, plain);
    }
    return count;
}

/* Does the text need more lines than the terminal has? False if standard output is no terminal. */
static bool pager_needed(const char *text) {
    struct winsize size = {.ws_row = 0};
    size_t rows = 1; /* the prompt */
    ioctl(STDOUT_FILENO, TIOCGWINSZ, &size);
    if (size.ws_row == 0 || size.ws_col == 0)
        return false;
    while (*text) {
        const size_t n = strcspn(text, "\n"), wide = line_width(text, n);
        rows += wide > 0 ? (wide - 1) / size.ws_col + 1 : 1;
        text += n + (text[n] == '\n');
    }
    return rows > size.ws_row;
}

/* A command for /bin/sh; NULL: $PAGER says that there is to be no pager. */
static const char *pager_program(void) {
    const char *wanted = getenv("PAGER");
    if (wanted)
        return *wanted && strcmp(wanted, "cat") ? wanted : NULL;
    return "for i in less more; do command -v $i >/dev/null 2>&1 && exec $i; done; exit 1";
}

/* Shows the text by the pager; false: there is none, or it failed. */
static bool pager_show(const char *text) {
    const char *name = pager_program();
    struct sigaction ignore = {.sa_handler = SIG_IGN}, before;
    if (!name)
        return false;
    setenv("LESS", "FRX", 0); /* F: quit if all fits on the screen; R: colours; X: leave the text there */
    fflush(stdout);
    sigaction(SIGINT, &ignore, &before); /* Ctrl-C is for the pager alone */
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

/* Shows the text by the pager or on the output stream; either way it is recorded. */
static void show_text(const text_out *t) {
    const bool page = t->set->pages && t->set->pager != PAGER_OFF &&
                      (t->set->pager == PAGER_ON || pager_needed(t->kept.text));
    fflush(t->out);
    if (page && pager_show(t->kept.text))
        record_aside(t->kept.text);
    else
        fputs(t->kept.text, t->out);
}

/* Replaces the text by one in which characters that do not print are escaped. False: out of memory. */
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
