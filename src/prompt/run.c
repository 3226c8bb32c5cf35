/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs a statement, a line of them, a stream of lines: dispatch, and the one place that reports errors. */
#include "statement/shell.h"
#include "text/clock.h"

#include <stdlib.h>
#include <string.h>

#include "commands/expressions.h"
#include "commands/figures.h"
#include "help/help.h"
#include "prompt/show.h"
#include "statement/command.h"
#include "statement/progress.h"
#include "statement/record.h"
#include "statement/setting_table.h"
#include "text/characters.h"
#include "text/lines.h"

void shell_init(shell *sh, FILE *out, FILE *err) {
    *sh = (shell){.out = out, .err = err, .set = settings_initial, .write_scene = scene_write};
    calc_init(&sh->calc, &shell_stop);
    sh->calc.keyword = argument_word;
    sh->calc.scene.pulse = progress_pulse;
}

void shell_free(shell *sh) {
    record_end(sh, false);
    typed_forget(sh);
    fit_forget(sh);
    calc_free(&sh->calc);
    for (size_t i = 0; i < EXPRESSIONS; i++)
        expr_free(&sh->list[i]);
}

/* ---- statements -------------------------------------------------------------------------------- */

/* The raise_... functions raise an error for a common mistake, here `a dz`; false: it has not been made. */
static bool raise_no_comma(lexer *lx) {
    return lx->kind == T_NAME && quantity_find(lx->text + lx->at, lx->len) &&
           !lex_fail(lx, "unexpected '%.*s': a product needs *, a list commas", LEX_WORD(lx));
}

static bool print_statement(shell *sh, lexer *lx) {
    column columns[EXPRESSIONS];
    long double si[EXPRESSIONS];
    size_t count = 0;
    bool ok = read_expressions(sh, lx, columns, EXPRESSIONS, &count) && !raise_no_comma(lx) && at_end(lx);
    for (size_t i = 0; i < count && ok; i++) {
        value v;
        ok = expr_eval(&sh->calc, &sh->list[i], &v, lx->error) &&
             column_fits(&sh->list[i], &columns[i], v, lx->error);
        si[i] = v.v;
        if (ok)
            calc_answered(&sh->calc, v);
    }
    if (ok)
        ok = answer_values(&sh->set, sh->out, columns, si, count) || calc_no_memory(lx->error);
    columns_free(columns, count);
    return ok;
}

/* Does the error say that an argument is missing? After a command word alone the whole usage helps more. */
static bool lacks_all(const calc_error *error) {
    static const char missing[] = "expected ";
    return error->raised && error->kind == ERROR_WORDS && !strncmp(error->text, missing, sizeof missing - 1);
}

static bool run_row(shell *sh, lexer *lx, const command *c, parsed *all) {
    scene_mark *before = NULL;
    if (c->changes && !(before = undo_mark(&sh->calc)))
        return calc_no_memory(lx->error);
    bool ok = c->run(sh, lx, all);
    if (c->changes && (ok || c->keeps))
        undo_scene(&sh->calc, before);
    else if (c->changes)
        undo_unmark(&sh->calc, before);
    if (ok && c->changes && shell_stop) { /* Ctrl-C came while the answer was printed */
        undo_pop(&sh->calc, true);
        ok = calc_interrupted(lx->error);
    }
    if (ok && (c->changes || c->returns))
        shell_warn(sh);
    return ok;
}

static bool run_command(shell *sh, lexer *lx, const command *c) {
    const size_t at = lx->at, len = lx->len;
    const grammar *form = command_form(c);
    parsed all;
    lex_next(lx);
    const bool bare = lx->kind == T_END;
    if (lx->error->raised && !grammar_first(form, HOLE_FILE))
        return false;
    parsed_begin(&all, form);
    const bool ok = (c->reads || parsed_read(sh, lx, form, &all)) && run_row(sh, lx, c, &all);
    parsed_drop(sh, &all);
    if (bare && lacks_all(lx->error))
        add_usage(lx->error, form);
    return ok || calc_place(lx->error, at, lx->end > at + len ? lx->end - at : len);
}

static bool assign(shell *sh, lexer *lx) {
    const command *c = command_find(lx->text + lx->at, lx->len);
    if (c) {
        char usage[GRAMMAR_USAGE];
        grammar_usage(command_form(c), usage);
        return lex_fail(lx, "'%s' is a command, not a variable: %s", c->name, usage);
    }
    const bool ok = calc_assign(&sh->calc, lx);
    if (ok)
        shell_warn(sh);
    return ok;
}

/* If help knows the unknown word, raises an error that names its page. after: the next token. */
static bool raise_help_page(lexer *lx, const char *word, token_kind after) {
    if (after != T_NAME && after != T_NUMBER && after != T_END)
        return false;
    const char *where = suggest(word, quantity_name) ? NULL : help_command_for(word);
    return where && !lex_fail(lx, "unknown name '%s'; try: %s %s", word, where, word);
}

/* If the statement begins with an unknown word, looks for what was meant and raises an error that says so. */
static bool raise_misspelt(shell *sh, lexer *lx) {
    char word[LEX_NAME];
    size_t i;
    if (names_find(&sh->calc.names, lx->text + lx->at, lx->len, &i) || name_taken(lx->text + lx->at, lx->len))
        return false;
    lex_word(lx, word);
    if (hint_from(word)) /* the look-up of the name raises a fuller error */
        return false;
    const token_kind after = lex_peek(lx);
    if (after == T_END && lex_is(lx, "q")) /* within an expression it is a name like any other */
        return !lex_fail(lx, "unknown name 'q': quit leaves, and so does Ctrl-D");
    const char *near = suggest(word, command_name);
    if ((after != T_NAME && after != T_NUMBER && after != T_END) || !near ||
        (after == T_END && suggest(word, quantity_name)))
        return raise_help_page(lx, word, after);
    lex_fail(lx, "unknown command '%s': did you mean %s?", word, near);
    return true;
}

static bool dispatch(shell *sh, lexer *lx) {
    if (lx->kind == T_NAME) {
        if (assign_at(lx))
            return assign(sh, lx);
        const command *c = command_find(lx->text + lx->at, lx->len);
        if (c)
            return run_command(sh, lx, c);
        if (raise_misspelt(sh, lx))
            return false;
        const quantity *q = lex_peek(lx) == T_NUMBER ? quantity_find(lx->text + lx->at, lx->len) : NULL;
        if (q && quantity_is_input(q) && !q->imposed) { /* mu 0.3 */
            const char *name = q->name;
            lex_next(lx);
            return lex_fail(lx, "unexpected '%.*s': did you mean %s = %.*s?", LEX_WORD(lx), name,
                            LEX_WORD(lx));
        }
        if (q && quantity_arguments(q) == 1) /* dW 20 N */
            return lex_fail(lx, "expected ( after %s: %s(%s)", q->name, q->name, q->argument);
    }
    return print_statement(sh, lx);
}

bool shell_statement(shell *sh, const char *text, size_t len, calc_error *error) {
    lexer lx;
    error_clear(error);
    lex_start(&lx, text, len, error);
    if (error->raised)
        return false;
    if (lx.kind == T_END)
        return true;
    const size_t began = lx.at;
    undo_begin(&sh->calc);
    progress_begin(sh, text + began, len - began);
    bool ok = dispatch(sh, &lx);
    progress_end();
    if (*sh->calc.note && ok)
        shell_note(sh, "%s", sh->calc.note);
    *sh->calc.note = 0;
    if (ok && sh->calc.scene.used & ASKED_TANGENTIAL)
        shell_warn_dissimilar(sh);
    if (ok && sh->calc.scene.used & ASKED_STEEP)
        shell_note(sh, "p rises to p0 more steeply than the nodes of the worn gap resolve: finer ones would "
                       "tell another p0 (help wear)");
    undo_end(&sh->calc);
    if (shell_stop) { /* results of a run stopped half-way must not be used by the next statement */
        scene_forget(&sh->calc.scene);
        if (!ok && error->raised) {
            error->raised = false;
            calc_interrupted(error);
            calc_put_place(error, began, len - began); /* the whole statement: no single word is wrong */
        }
    }
    return ok;
}

/* ---- lines ------------------------------------------------------------------------------------- */

enum { SHOWN = 100 }; /* columns shown of a long line, around the place of the error */

/* Which bytes of a line to show; `before` gets the number of columns shown before the place `at`. */
static void find_part(const char *text, size_t len, size_t at, size_t *begin, size_t *end, size_t *before) {
    *begin = 0;
    *end = len;
    *before = text_columns(text, at);
    if (text_columns(text, len) <= SHOWN)
        return;
    if (*before > SHOWN / 2)
        *begin = text_fit(text, at, *before - SHOWN / 2);
    *before -= text_columns(text, *begin);
    *end = *begin + text_fit(text + *begin, len - *begin, SHOWN);
}

/* Shows the line and marks the place with ^~~. aside: marked for replays as lines a transcript may lack. */
static void show_place(const shell *sh, bool aside, const char *text, size_t len, size_t at, size_t width) {
    FILE *to = sh->err;
    size_t begin, end, before;
    find_part(text, len, at, &begin, &end, &before);
    if (aside)
        shell_aside(sh, to);
    fprintf(to, "  %s", begin ? "..." : "");
    for (size_t i = begin; i < end;) {
        unsigned code;
        const size_t n = character_at(text + i, end - i, &code);
        if (n && character_shows(code))
            fwrite(text + i, 1, n, to);
        else
            putc(n && code == '\t' ? ' ' : '?', to);
        i += n ? n : 1;
    }
    fprintf(to, "%s\n", end < len ? "..." : "");
    if (aside)
        shell_aside(sh, to);
    fprintf(to, "  %s%*s^", begin ? "   " : "", (int)before, "");
    const size_t last = at + width < end ? at + width : end;
    for (size_t marks = last > at ? text_columns(text + at, last - at) : 0; marks > 1; marks--)
        putc('~', to);
    putc('\n', to);
}

void shell_report(shell *sh, const source *from, const char *text, size_t len, size_t line, size_t at,
                  const calc_error *error) {
    fflush(sh->out);
    if (output_closed()) /* not reported: the reader of the pipe has gone */
        return;
    /* the physical line within a continued one */
    size_t begin = 0;
    for (size_t i = 0; i < at && i < len; i++)
        if (text[i] == '\n') {
            begin = i + 1;
            line++;
        }
    size_t end = begin;
    while (end < len && text[end] != '\n')
        end++;
    const size_t place = character_count(text + begin, at - begin) + 1;
    while (begin < at && text[begin] == ' ') /* indented, or behind a prompt in a transcript */
        begin++;
    answer a;
    answer_begin(&a, &sh->set, sh->out);
    answer_message(&a, "error", error->text);
    if (from->name) {
        answer_string(&a, "file", from->name);
        answer_number(&a, "line", (double)line);
    }
    answer_number(&a, "column", (double)place);
    answer_done(&a);
    fflush(sh->out);
    if (from->name) {
        print_safe(sh->err, from->name, strlen(from->name));
        fprintf(sh->err, ":%zu:%zu: ", line, place);
    }
    shell_print_error(sh, error->text);
    const size_t width = error->len ? error->len : 1;
    if (from->name || sh->replaying || (sh->interactive && width < end - begin))
        show_place(sh, !from->name, text + begin, end - begin, at - begin, width);
    fflush(sh->err);
}

/* Tells the time and the models that computed the answer. */
static void report_time(shell *sh, double t) {
    char by[240] = "";
    const scene *s = &sh->calc.scene;
    if (sh->replaying) /* times differ from run to run */
        return;
    for (model_id i = 0; i < MODELS; i++)
        if (s->used & USED(i)) {
            text_add(by, sizeof by, "%s%s", *by ? ", " : " (", models[i].title);
            if (i == MODEL_PIECES)
                text_add(by, sizeof by, " to %.0e", s->pieces_error);
        }
    const unsigned repeated = s->answers.levels ? s->answers.run[0].repeated : 0;
    if (s->used & USED(MODEL_MEMORY) && repeated)
        text_add(by, sizeof by, ", %u period%s the last one run", repeated,
                 repeated == 1 ? " repeats" : "s repeat");
    shell_say(sh, "time: %.3g ms%s%s", 1e3 * t, by, *by ? ")" : "");
}

bool shell_line(shell *sh, const source *from, const char *text, size_t len, size_t line) {
    bool ok = true;
    for (size_t i = 0; i < len && !sh->quit;) {
        if (text[i] == '#')
            break;
        size_t end = shell_statement_end(text, i, len);
        calc_error error;
        bool timed = sh->set.timing;
        double start = timed ? clock_wall() : 0;
        const struct recorder *recorder = sh->record;
        sh->calc.scene.used = 0;
        bool done = shell_statement(sh, text + i, end - i, &error);
        if (!done)
            calc_word(&sh->calc, &error);
        if (!done && error.raised) { /* not raised: a nested `source` has reported it */
            shell_report(sh, from, text, len, line, i + error.at, &error);
            sh->stopped |= error.stop;
            sh->refused |= error.refused;
            if (error.stop || error.refused)
                record_tell(sh, error.text);
        }
        if (!done) {
            ok = false;
            if (!from->keep_going || shell_stop)
                return false;
        } else if (timed) {
            report_time(sh, clock_wall() - start);
        }
        i = end < len && text[end] == ';' ? end + 1 : len;
        while (i < len && text[i] == ' ')
            i++;
        if (sh->record && sh->record != recorder && i < len) /* a recording began: it gets the rest */
            record_line(sh, text + i, len - i);
    }
    return ok;
}

/* ---- streams ----------------------------------------------------------------------------------- */

int shell_stream(shell *sh, file_in *in) {
    const source from = {in->name, sh->keep_going};
    calc_error error = ERROR_NONE;
    file_got got = FILE_GOT_END;
    bool ok = true, last = true; /* did all lines so far succeed, and the last one? */
    while (!sh->quit && !shell_stop && !ferror(sh->out) && (ok || sh->keep_going) &&
           (got = file_in_logical(in, &error)) == FILE_GOT_LINE) {
        if (sh->nesting == 0)
            record_line(sh, in->line, in->length);
        last = shell_line(sh, &from, in->line, in->length, (size_t)in->number);
        ok = ok && last;
        if (in->waits && in->at == in->have) /* a program at the other end may be waiting for the answer */
            fflush(sh->out);
    }
    if (got == FILE_GOT_ERROR)
        shell_error(sh, error.text);
    sh->stopped |= error.stop;
    sh->refused |= error.refused;
    if (shell_stop && last)
        shell_error(sh, "interrupted");
    const int status = shell_stop ? EXIT_INTERRUPTED : ok && got != FILE_GOT_ERROR ? EXIT_OK : EXIT_ERROR;
    file_in_close(in);
    return status;
}

int shell_run(shell *sh, const char *path, const char *text) {
    calc_error error = ERROR_NONE;
    file_in in;
    if (text ? file_in_text(&in, text, path, &shell_stop, &error)
             : file_in_script(&in, path, &shell_stop, &error))
        return shell_stream(sh, &in);
    shell_error(sh, error.text);
    return EXIT_ERROR;
}
