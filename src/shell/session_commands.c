/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Commands on the session itself: scripts, the demo, the end. */
#include <string.h>

#include "shell/command.h"

bool do_source(shell *sh, lexer *lx, const command *self) {
    enum { NESTING = 16 };
    char name[ARG_FILE_NAME];
    const arg_list list = command_args(self);
    arg_value v[ARGS];
    if (!args_read(sh, lx, &list, v, name))
        return false;
    if (sh->nesting == NESTING)
        return calc_fail(lx->error, v[0].value_at, 1, "scripts are nested more than %d deep", NESTING);
    file_in in;
    char error[CALC_ERROR_TEXT - 8];
    if (!file_in_open(&in, name, &shell_stop, error, sizeof error))
        return calc_fail(lx->error, v[0].value_at, v[0].value_len, "%s", error);
    sh->nesting++;
    int status = shell_stream(sh, &in, false);
    sh->nesting--;
    return status == EXIT_OK;
}

const char demo_text[] = "# Two steel bodies that grow stiffer with depth, a sphere on a flat, R = 10 mm\n"
                         "material E0=210 GPa nu=0.3 k=0.5 c0=1 mm\n"
                         "geometry sphere R=10 mm\n"
                         "friction 0.4\n"
                         "# Pressed with 100 N: contact radius and indentation depth\n"
                         "press FN=100 N\n"
                         "a, dz\n"
                         "# Pushed sideways with half of what friction holds: rim slips, middle sticks\n"
                         "step Fx=20 N\n"
                         "c, c/a, Fx, dx\n"
                         "# A full cycle: the energy lost, in closed form and along the way\n"
                         "cycle FA=20 N\n"
                         "dW, dW(20 N)\n"
                         "# The same with homogeneous bodies: everything is computed anew\n"
                         "k = 0\n"
                         "a, c, dW\n"
                         "k = 0.5\n"
                         "# Close to gross slip the loop is widest\n"
                         "cycle FA=39 N\n"
                         "dW\n"
                         "plot loop\n";

const char *demo_name(size_t i) {
    return paper_scripts[i].name;
}

/* The session at the cursor, or the one without a name. */
static const char *find_demo(lexer *lx) {
    char word[LEX_NAME];
    if (lx->kind == T_END)
        return demo_text;
    for (const script *s = paper_scripts; s->name; s++)
        if (lex_accept(lx, s->name))
            return s->text;
    lex_word(lx, word);
    const char *near = suggest(word, demo_name);
    lex_fail(lx, near ? "no demo '%s': did you mean %s?" : "no demo '%s'", word, near);
    return NULL;
}

static bool play_line(shell *own, const char *line, size_t n, calc_error *error) {
    for (size_t i = 0, end; i < n; i = end + 1) {
        end = shell_statement_end(line, i, n);
        if (!shell_statement(own, line + i, end - i, error))
            return false;
    }
    return true;
}

/* In a session of its own: the user's stays as it is. */
bool do_demo(shell *sh, lexer *lx, const command *self) {
    (void)self;
    const char *line = find_demo(lx);
    if (!line || !at_end(lx))
        return false;
    shell own;
    shell_init(&own, sh->out, sh->err);
    own.set = sh->set;
    own.set.report = REPORT_OFF;
    bool ok = true;
    for (; *line && ok && !shell_stop; line += strcspn(line, "\n") + 1) {
        const size_t n = strcspn(line, "\n");
        const bool comment = *line == '#';
        if (sh->set.format == FORMAT_TEXT)
            fprintf(sh->out, comment ? "\n%.*s\n" : "fret> %.*s\n", (int)n, line);
        ok = comment || play_line(&own, line, n, lx->error);
    }
    if (!ok) {
        calc_word(&own.calc, lx->error);
        lx->error->at = lx->error->len = 0;
    }
    sh->calc.scene.used |= own.calc.scene.used;
    shell_free(&own);
    return ok;
}

bool do_quit(shell *sh, lexer *lx, const command *self) {
    (void)self;
    if (!at_end(lx))
        return false;
    sh->quit = true;
    return true;
}
