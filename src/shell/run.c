/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "shell/shell.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

#include "shell/command.h"
#include "shell/output.h"

volatile sig_atomic_t shell_stop;

void shell_init(shell *sh, FILE *out, FILE *err) {
    *sh = (shell){.out = out, .err = err};
    sh->set = (settings){.digits = 6, .plot_timeout = 30};
    sh->calc.scene.stop = &shell_stop;
}

void shell_free(shell *sh) {
    calc_free(&sh->calc);
    for (size_t i = 0; i < sizeof sh->list / sizeof *sh->list; i++)
        expr_free(&sh->list[i]);
    if (sh->record)
        fclose(sh->record);
    sh->record = NULL;
}

/* ---- arguments --------------------------------------------------------------------------------- */

bool at_argument(const lexer *lx) {
    if (lx->kind != T_NAME)
        return false;
    token_kind next = lex_peek(lx);
    return next == T_ASSIGN || next == T_INCREMENT;
}

/* A name right after a number was meant as a unit, unless it is a word of the command. */
static bool stray_unit(lexer *lx) {
    static const char *const words[] = {"times", "steps", "to", "for", "in", "log", "with", "from", "within"};
    if (lx->kind != T_NAME || !lx->last || lx->text[lx->last - 1] < '0' || lx->text[lx->last - 1] > '9')
        return false;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (lex_is(lx, words[i]))
            return false;
    char word[64];
    snprintf(word, sizeof word, "%.*s", (int)(lx->len < 60 ? lx->len : 60), lx->text + lx->at);
    if (at_argument(lx) || quantity_find(word, strlen(word)))
        return false;
    const char *near = unit_suggest(word);
    lex_fail(lx, near ? "unknown unit '%s': did you mean %s?" : "unknown unit '%s'; try: help units", word,
             near);
    return true;
}

bool read_argument(shell *sh, lexer *lx, argument *a) {
    *a = (argument){.name = lx->text + lx->at, .len = lx->len, .at = lx->at};
    lex_next(lx);
    a->increment = lx->kind == T_INCREMENT;
    lex_next(lx);
    a->value_at = lx->at;
    bool ok = expr_value(&sh->calc, lx, &a->v) && !stray_unit(lx);
    a->value_len = lx->last - a->value_at;
    return ok;
}

bool argument_is(const argument *a, const char *name) {
    return strlen(name) == a->len && !memcmp(name, a->name, a->len);
}

bool value_dim(lexer *lx, const char *name, size_t at, size_t len, value v, dim d) {
    if (dim_equal(v.d, d) || (v.v == 0 && dim_equal(v.d, DIM_NONE)))
        return true;
    char want[128], got[128], unit_text[128];
    dim_describe(d, want, sizeof want);
    dim_describe(v.d, got, sizeof got);
    dim_unit(d, unit_text, sizeof unit_text);
    if (dim_equal(v.d, DIM_NONE))
        return calc_fail(lx->error, at, len, "%s needs a unit: it is %s, in %s", name, want, unit_text);
    return calc_fail(lx->error, at, len, "%s is %s, not %s (%.*s)", name, want, got,
                     (int)(len < 60 ? len : 60), lx->text + at);
}

bool argument_dim(lexer *lx, const argument *a, dim d) {
    char name[64];
    if (dim_equal(a->v.d, d))
        return true;
    snprintf(name, sizeof name, "%.*s", (int)(a->len < 60 ? a->len : 60), a->name);
    return value_dim(lx, name, a->value_at, a->value_len, a->v, d);
}

bool unknown_argument(lexer *lx, const argument *a, const command *c) {
    return calc_fail(lx->error, a->at, a->len, "%s has no argument '%.*s'; usage: %s %s", c->name,
                     (int)(a->len < 60 ? a->len : 60), a->name, c->name, c->usage);
}

bool at_end(lexer *lx) {
    if (lx->error->raised || lx->kind == T_END)
        return !lx->error->raised;
    return stray_unit(lx)
               ? false
               : lex_fail(lx, "unexpected '%.*s'", (int)(lx->len < 60 ? lx->len : 60), lx->text + lx->at);
}

bool read_count(shell *sh, lexer *lx, const char *what, unsigned limit, unsigned *out) {
    size_t at = lx->at;
    value v;
    if (!expr_value(&sh->calc, lx, &v))
        return false;
    size_t len = lx->last - at;
    if (!dim_equal(v.d, DIM_NONE) || !(v.v >= 1 && v.v <= limit) || v.v != (long double)(unsigned)v.v)
        return calc_fail(lx->error, at, len, "%s must be a whole number from 1 to %u", what, limit);
    *out = (unsigned)v.v;
    return true;
}

bool read_expressions(shell *sh, lexer *lx, column *columns, size_t limit, size_t *count) {
    for (*count = 0;;) {
        if (*count == limit)
            return lex_fail(lx, "more than %zu expressions", limit);
        expr *e = &sh->list[*count];
        column *c = &columns[*count];
        if (!expr_parse(&sh->calc, lx, e))
            return false;
        snprintf(c->name, sizeof c->name, "%.*s",
                 (int)(e->len < sizeof c->name ? e->len : sizeof c->name - 1), lx->text + e->at);
        c->chosen = false;
        if (lex_accept(lx, "in")) {
            size_t at = lx->at;
            unit u;
            if (lx->error->raised || !unit_parse(lx, &u))
                return false;
            c->chosen = true;
            c->scale = unit_scale(&u);
            c->d = u.d;
            size_t len = lx->last - at;
            snprintf(c->unit, sizeof c->unit, "%.*s", (int)(len < sizeof c->unit ? len : sizeof c->unit - 1),
                     lx->text + at);
        }
        ++*count;
        if (lx->kind != T_COMMA)
            return !lx->error->raised;
        lex_next(lx);
    }
}

/* ---- statements -------------------------------------------------------------------------------- */

static bool print_statement(shell *sh, lexer *lx) {
    column columns[COLUMNS];
    long double si[COLUMNS];
    size_t count;
    if (!read_expressions(sh, lx, columns, COLUMNS, &count) || !at_end(lx))
        return false;
    for (size_t i = 0; i < count; i++) {
        value v;
        if (!expr_eval(&sh->calc, &sh->list[i], &v, lx->error))
            return false;
        si[i] = v.v;
        if (columns[i].chosen && !dim_equal(v.d, columns[i].d)) {
            char is[128];
            dim_describe(v.d, is, sizeof is);
            return calc_fail(lx->error, sh->list[i].at, sh->list[i].len, "%s is %s: it cannot be shown in %s",
                             columns[i].name, is, columns[i].unit);
        }
        columns[i].d = v.d;
        if (!columns[i].chosen) {
            dim_unit(v.d, columns[i].unit, sizeof columns[i].unit);
            columns[i].scale = 1;
        }
    }
    print_values(sh, columns, si, count);
    return true;
}

static bool assign(shell *sh, lexer *lx) {
    argument a;
    const quantity *q = quantity_find(lx->text + lx->at, lx->len);
    size_t at = lx->at, len = lx->len;
    const char *taken = name_taken(lx->text + at, len);
    if (command_find(lx->text + at, len))
        return lex_fail(lx, "'%.*s' is a command: it cannot be a variable", (int)len, lx->text + at);
    if (q && q->in < 0)
        return lex_fail(lx, "%s is a result: it follows from the inputs and the load", q->name);
    if (!q && taken)
        return lex_fail(lx, "'%.*s' is %s: it cannot be a variable", (int)(len < 60 ? len : 60),
                        lx->text + at, taken);
    if (!read_argument(sh, lx, &a) || !at_end(lx))
        return false;
    if (!q) {
        if (a.increment)
            return calc_fail(lx->error, at, len, "+= belongs to step; write %.*s = ...",
                             (int)(len < 60 ? len : 60), a.name);
        return calc_set_variable(&sh->calc, a.name, a.len, a.v) ||
               calc_fail(lx->error, at, len, "out of memory");
    }
    long double v = a.v.v;
    if (!argument_dim(lx, &a, quantity_dim(q, &sh->calc.scene)))
        return false;
    if (a.increment) {
        long double old;
        if (!scene_get(&sh->calc.scene, (input)q->in, &old, lx->error))
            return false;
        v += old;
    }
    sh->warned_dissimilar = sh->warned_dissimilar && !(q->in == IN_E0_2 || q->in == IN_NU_2);
    if (scene_set(&sh->calc.scene, (input)q->in, (double)v, lx->error))
        return true;
    if (lx->error->len == 0) {
        lx->error->at = a.value_at;
        lx->error->len = a.value_len;
    }
    return false;
}

static bool run_command(shell *sh, lexer *lx, const command *c) {
    size_t at = lx->at, len = lx->len;
    lex_next(lx);
    if (lx->error->raised && c->complete != COMPLETE_FILE)
        return false;
    if (c->run(sh, lx))
        return true;
    if (lx->error->len == 0) { /* the whole statement is at fault */
        lx->error->at = at;
        lx->error->len = lx->end > at + len ? lx->end - at : len;
    }
    return false;
}

bool shell_statement(shell *sh, const char *text, size_t len, calc_error *error) {
    lexer lx;
    error->raised = error->stop = false; /* its text need not be cleared a million times */
    error->at = error->len = 0;
    lex_start(&lx, text, len, error);
    if (error->raised)
        return false;
    if (lx.kind == T_END)
        return true;
    if (lx.kind == T_NAME) {
        const command *c = command_find(lx.text + lx.at, lx.len);
        token_kind next = c && lx.text[lx.at + lx.len - 1] != 0 ? lex_peek(&lx) : T_END;
        if (c && next != T_ASSIGN && next != T_INCREMENT)
            return run_command(sh, &lx, c);
        if (at_argument(&lx))
            return assign(sh, &lx);
        size_t i;
        /* a misspelt command followed by its arguments */
        if (!c && !calc_find_variable(&sh->calc, lx.text + lx.at, lx.len, &i) &&
            !name_taken(lx.text + lx.at, lx.len)) {
            char word[64];
            snprintf(word, sizeof word, "%.*s", (int)(lx.len < 60 ? lx.len : 60), lx.text + lx.at);
            token_kind after = lex_peek(&lx);
            const char *near = suggest(word, command_name);
            if ((after == T_NAME || after == T_NUMBER || after == T_END) && near &&
                !(after == T_END && suggest(word, quantity_name)))
                return lex_fail(&lx, "unknown command '%s': did you mean %s?", word, near);
        }
    }
    return print_statement(sh, &lx);
}

/* ---- lines ------------------------------------------------------------------------------------- */

/* End of the statement that begins at i: a `;`, a comment or the end of the line. */
static size_t statement_end(const char *text, size_t i, size_t len) {
    bool quoted = false;
    for (; i < len; i++) {
        char c = text[i];
        if (c > ';') /* most of them */
            continue;
        if (c == '"')
            quoted = !quoted;
        else if (c == '\n')
            quoted = false;
        else if (!quoted && (c == ';' || c == '#'))
            break;
    }
    return i;
}

bool shell_continues(const char *text, size_t len) {
    while (len && (text[len - 1] == '\n' || text[len - 1] == '\r'))
        len--;
    if (!len || text[len - 1] != '\\')
        return false;
    size_t end = statement_end(text, 0, len);
    while (end < len && text[end] == ';')
        end = statement_end(text, end + 1, len);
    return end == len; /* not within a comment */
}

enum { SHOWN = 100 }; /* of a long line, around the place */

static void show_place(FILE *to, const char *text, size_t len, size_t at, size_t width) {
    size_t begin = 0, end = len;
    if (len > SHOWN) {
        begin = at > SHOWN / 2 ? at - SHOWN / 2 : 0;
        end = begin + SHOWN < len ? begin + SHOWN : len;
    }
    while (begin < at && ((unsigned char)text[begin] & 0xc0) == 0x80)
        begin++;
    fprintf(to, "  %s", begin ? "..." : "");
    for (size_t i = begin; i < end; i++) {
        unsigned char c = (unsigned char)text[i];
        fputc(c == '\t' || c < 0x20 || c == 0x7f ? (c == '\t' ? ' ' : '?') : c, to);
    }
    fprintf(to, "%s\n  %s", end < len ? "..." : "", begin ? "   " : "");
    for (size_t i = begin; i < at && i < end; i++)
        if (((unsigned char)text[i] & 0xc0) != 0x80)
            fputc(' ', to);
    fputc('^', to);
    for (size_t i = at + 1; i < at + width && i < end; i++)
        if (((unsigned char)text[i] & 0xc0) != 0x80)
            fputc('~', to);
    fputc('\n', to);
}

static void report_error(shell *sh, const source *from, const char *text, size_t len, size_t line, size_t at,
                         const calc_error *error) {
    fflush(sh->out);
    const char *red = sh->set.color ? "\033[1;31m" : "", *plain = sh->set.color ? "\033[0m" : "";
    if (!from->name) {
        fprintf(sh->err, "%serror:%s %s\n", red, plain, error->text);
        fflush(sh->err);
        return;
    }
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
    fprintf(sh->err, "%s:%zu:%zu: %serror:%s %s\n", from->name, line, at - begin + 1, red, plain,
            error->text);
    show_place(sh->err, text + begin, end - begin, at - begin, error->len ? error->len : 1);
    fflush(sh->err);
}

static double seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void report_time(shell *sh, double t) {
    static const char *const models[] = {"closed form", "memory diagram", "quadrature", "springs"};
    fflush(sh->out);
    fprintf(sh->err, "time: %.3g ms", 1e3 * t);
    const char *before = " (";
    for (unsigned i = 0; i < sizeof models / sizeof *models; i++)
        if (sh->calc.scene.used & 1u << i) {
            fprintf(sh->err, "%s%s", before, models[i]);
            before = ", ";
        }
    fputs(*before == ',' ? ")\n" : "\n", sh->err);
}

bool shell_line(shell *sh, const source *from, const char *text, size_t len, size_t line) {
    bool ok = true;
    for (size_t i = 0; i < len && !sh->quit;) {
        if (text[i] == '#')
            break;
        size_t end = statement_end(text, i, len);
        calc_error error;
        bool timed = sh->set.timing;
        double start = timed ? seconds() : 0;
        sh->calc.scene.used = 0;
        bool done = shell_statement(sh, text + i, end - i, &error);
        if (!done && !error.raised) /* already reported: a nested source */
            return false;
        if (!done) {
            report_error(sh, from, text, len, line, i + error.at, &error);
            sh->failed = true;
            ok = false;
            if (!from->keep_going)
                return false;
        } else if (timed) {
            report_time(sh, seconds() - start);
        }
        i = end < len && text[end] == ';' ? end + 1 : len;
    }
    return ok;
}

/* A `\` at the end of a line becomes a blank; the line break stays, to count lines by. */
static bool read_logical(FILE *in, char **buf, size_t *room, size_t *len, size_t *lines) {
    *len = 0;
    *lines = 0;
    char *part = NULL;
    size_t part_room = 0;
    for (;;) {
        char **into = *lines ? &part : buf;
        ssize_t n = getline(into, *lines ? &part_room : room, in);
        if (n < 0)
            break;
        ++*lines;
        if (*lines == 1) {
            *len = (size_t)n;
        } else {
            if (*len + (size_t)n + 1 > *room) {
                char *grown = realloc(*buf, *len + (size_t)n + 1);
                if (!grown)
                    break;
                *buf = grown;
                *room = *len + (size_t)n + 1;
            }
            memcpy(*buf + *len, part, (size_t)n + 1);
            *len += (size_t)n;
        }
        if (!shell_continues(*buf + (*len - (size_t)n), (size_t)n))
            break;
        for (size_t i = *len; i-- > 0;)
            if ((*buf)[i] == '\\') {
                (*buf)[i] = ' ';
                break;
            }
    }
    free(part);
    return *lines > 0;
}

int shell_stream(shell *sh, FILE *in, const char *name, bool keep_going) {
    source from = {name, keep_going};
    char *buf = NULL;
    size_t room = 0, len, lines, line = 1;
    int status = EXIT_OK;
    while (!sh->quit && read_logical(in, &buf, &room, &len, &lines)) {
        size_t mark =
            line == 1 && len >= 3 && !memcmp(buf, "\xef\xbb\xbf", 3) ? 3 : 0; /* editors' byte-order mark */
        if (!shell_line(sh, &from, buf + mark, len - mark, line))
            status = EXIT_ERROR;
        if (shell_stop || (status && !keep_going) || ferror(sh->out))
            break;
        line += lines;
    }
    if (shell_stop) {
        status = EXIT_INTERRUPTED;
    } else if (ferror(in)) {
        fprintf(sh->err, "error: cannot read %s: %s\n", name, strerror(errno));
        status = EXIT_ERROR;
    }
    free(buf);
    return status;
}

/* fopen succeeds on a directory; reading it then fails late. */
FILE *shell_open(const char *path) {
    FILE *in = fopen(path, "r");
    struct stat info;
    if (in && !fstat(fileno(in), &info) && S_ISDIR(info.st_mode)) {
        fclose(in);
        errno = EISDIR;
        return NULL;
    }
    return in;
}

int shell_file(shell *sh, const char *path, bool keep_going) {
    FILE *in = shell_open(path);
    if (!in) {
        fflush(sh->out);
        fprintf(sh->err, "error: cannot read %s: %s\n", path, strerror(errno));
        return EXIT_ERROR;
    }
    int status = shell_stream(sh, in, path, keep_going);
    fclose(in);
    return status;
}
