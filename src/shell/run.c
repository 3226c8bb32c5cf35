/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Statements, lines and streams of them: dispatch, and the one place that reports errors. */
#include "shell/shell.h"

#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

#include "shell/command.h"
#include "shell/expressions.h"

volatile sig_atomic_t shell_stop;

void shell_init(shell *sh, FILE *out, FILE *err) {
    *sh = (shell){.out = out, .err = err};
    sh->set = (settings){.digits = 6, .plot_timeout = 30};
    calc_init(&sh->calc, &shell_stop);
}

void shell_free(shell *sh) {
    calc_free(&sh->calc);
    for (size_t i = 0; i < EXPRESSIONS; i++)
        expr_free(&sh->list[i]);
}

void shell_note(shell *sh, const char *format, ...) {
    va_list args;
    fflush(sh->out);
    va_start(args, format);
    vfprintf(sh->err, format, args);
    va_end(args);
    fputc('\n', sh->err);
}

/* ---- statements -------------------------------------------------------------------------------- */

static bool print_statement(shell *sh, lexer *lx) {
    column columns[EXPRESSIONS];
    long double si[EXPRESSIONS];
    size_t count;
    bool ok = read_expressions(sh, lx, columns, EXPRESSIONS, &count) && at_end(lx);
    for (size_t i = 0; i < count && ok; i++) {
        value v;
        ok = expr_eval(&sh->calc, &sh->list[i], &v, lx->error) &&
             column_fits(&sh->list[i], &columns[i], v.d, lx->error);
        si[i] = v.v;
        sh->calc.ans = ok ? v : sh->calc.ans;
        sh->calc.has_ans = sh->calc.has_ans || ok;
    }
    if (ok)
        print_values(&sh->set, sh->out, columns, si, count);
    columns_free(columns, count);
    return ok;
}

/* The theory leaves coupling out: said whenever bodies become dissimilar. */
static void warn_dissimilar(shell *sh) {
    const fret_normal *normal;
    calc_error ignored;
    error_clear(&ignored);
    if (!sh->calc.scene.end.steps || !scene_normal(&sh->calc.scene, &normal, &ignored))
        return;
    const fret_foundation *f = fret_normal_foundation(normal);
    if (!f->similar && !sh->dissimilar)
        shell_note(sh,
                   "warning: the bodies are elastically dissimilar (mismatch %.3g): normal and tangential contact "
                   "are coupled, and these results are an approximation",
                   (double)f->mismatch);
    sh->dissimilar = !f->similar;
}

/* Beyond these the bodies are no half-spaces, which the theory takes them for. */
static const double most_radius = 0.3, most_slope = 0.36397023426620236; /* of R; tan 20 deg */

static void warn_half_space(shell *sh) {
    scene *s = &sh->calc.scene;
    const fret_press *press;
    long double R = 0, slope = 0;
    calc_error ignored;
    error_clear(&ignored);
    if (!s->end.steps || !scene_press(s, &press, &ignored))
        return;
    enum { WIDE = 1, STEEP = 2 };
    const bool wide = inputs_take(&s->in, IN_RADIUS) && scene_get(s, IN_RADIUS, &R, &ignored) && press->a > most_radius * R;
    const bool steep = inputs_take(&s->in, IN_SLOPE) && scene_get(s, IN_SLOPE, &slope, &ignored) && slope > most_slope;
    if (wide && !(sh->no_half_space & WIDE))
        shell_note(sh, "warning: a/R = %.3g: beyond 0.3 the bodies are no half-spaces, and these results are an approximation",
                   (double)(press->a / R));
    if (steep && !(sh->no_half_space & STEEP))
        shell_note(sh, "warning: slope = %.3g: flanks steeper than 20 deg leave the half-space, and these results are an "
                       "approximation",
                   (double)slope);
    sh->no_half_space = (wide ? WIDE : 0u) | (steep ? STEEP : 0u);
}

static void warn(shell *sh) {
    warn_dissimilar(sh);
    warn_half_space(sh);
}

static bool run_command(shell *sh, lexer *lx, const command *c) {
    const size_t at = lx->at, len = lx->len;
    scene_mark before;
    lex_next(lx);
    if (lx->error->raised && !(c->args && c->args->kind == ARG_FILE))
        return false;
    if (c->changes)
        scene_save(&sh->calc.scene, &before, false);
    bool ok = c->run(sh, lx, c);
    if (c->changes && (ok || c->run == do_source))
        undo_scene(&sh->calc, &before);
    else if (c->changes)
        scene_drop(&before);
    if (ok && (c->changes || c->run == do_undo))
        warn(sh);
    return ok || calc_place(lx->error, at, lx->end > at + len ? lx->end - at : len);
}

static bool assign(shell *sh, lexer *lx) {
    if (command_find(lx->text + lx->at, lx->len))
        return lex_fail(lx, "'%.*s' is a command: it cannot be a variable", LEX_WORD(lx));
    bool ok = calc_assign(&sh->calc, lx);
    if (*sh->calc.note) {
        if (ok)
            shell_note(sh, "note: %s", sh->calc.note);
        *sh->calc.note = 0;
    }
    if (ok)
        warn(sh);
    return ok;
}

/* A misspelt command followed by its arguments. */
static bool misspelt(shell *sh, lexer *lx) {
    char word[LEX_NAME];
    size_t i;
    if (names_find(&sh->calc.names, lx->text + lx->at, lx->len, &i) || name_taken(lx->text + lx->at, lx->len))
        return false;
    lex_word(lx, word);
    const token_kind after = lex_peek(lx);
    const char *near = suggest(word, command_name);
    if ((after != T_NAME && after != T_NUMBER && after != T_END) || !near ||
        (after == T_END && suggest(word, quantity_name)))
        return false;
    lex_fail(lx, "unknown command '%s': did you mean %s?", word, near);
    return true;
}

static bool dispatch(shell *sh, lexer *lx) {
    if (lx->kind == T_NAME) {
        const command *c = command_find(lx->text + lx->at, lx->len);
        const token_kind next = c ? lex_peek(lx) : T_END;
        if (c && next != T_ASSIGN && next != T_INCREMENT && next != T_DEFINE)
            return run_command(sh, lx, c);
        if (assign_at(lx))
            return assign(sh, lx);
        if (!c && misspelt(sh, lx))
            return false;
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
    undo_begin(&sh->calc);
    bool ok = dispatch(sh, &lx);
    undo_end(&sh->calc);
    return ok;
}

/* ---- lines ------------------------------------------------------------------------------------- */

/* End of the statement that begins at i: a `;`, a comment or the end of the line. */
size_t shell_statement_end(const char *text, size_t i, size_t len) {
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
    size_t end = shell_statement_end(text, 0, len);
    while (end < len && text[end] == ';')
        end = shell_statement_end(text, end + 1, len);
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
    fflush(sh->out);
    fprintf(sh->err, "time: %.3g ms", 1e3 * t);
    const char *before = " (";
    for (model_id i = 0; i < MODELS; i++)
        if (sh->calc.scene.used & USED(i)) {
            fprintf(sh->err, "%s%s", before, models[i].title);
            before = ", ";
        }
    fputs(*before == ',' ? ")\n" : "\n", sh->err);
}

bool shell_line(shell *sh, const source *from, const char *text, size_t len, size_t line) {
    bool ok = true;
    for (size_t i = 0; i < len && !sh->quit;) {
        if (text[i] == '#')
            break;
        size_t end = shell_statement_end(text, i, len);
        calc_error error;
        bool timed = sh->set.timing;
        double start = timed ? seconds() : 0;
        sh->calc.scene.used = 0;
        bool done = shell_statement(sh, text + i, end - i, &error);
        if (!done)
            calc_word(&sh->calc, &error);
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
