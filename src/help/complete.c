/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Completion by position, from the tables of commands, settings, geometries, quantities and units. Changes
 * nothing. */
#include "help/complete.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "help/help.h"
#include "number/array.h"
#include "statement/command.h"
#include "text/lines.h"

/* ---- candidates -------------------------------------------------------------------------------- */

enum { TOKENS = 256 };

/* The statement before the word at the cursor. */
typedef struct place {
    calc *c;
    const char *line;
    size_t start, cursor; /* of the word */
    struct {
        token_kind kind;
        size_t at, len;
    } token[TOKENS];
    size_t count;
    const command *command; /* that it begins with, or NULL */
    candidates *out;
} place;

static void add_word(const place *p, const char *word, const char *ending) {
    candidates *out = p->out;
    const size_t typed = p->cursor - p->start, n = strlen(word), m = strlen(ending);
    if (n < typed || memcmp(word, p->line + p->start, typed) != 0)
        return;
    char **grown = fret_array_for(out->word, &out->room, out->count + 1, sizeof *grown);
    if (!grown)
        return;
    out->word = grown;
    char *whole = malloc(n + m + 1);
    if (!whole)
        return;
    memcpy(whole, word, n);
    memcpy(whole + n, ending, m + 1);
    for (size_t i = 0; i < out->count; i++)
        if (!strcmp(out->word[i], whole)) {
            free(whole);
            return;
        }
    out->word[out->count++] = whole;
}

void candidates_free(candidates *c) {
    for (size_t i = 0; i < c->count; i++)
        free(c->word[i]);
    free(c->word);
    *c = (candidates){.word = NULL};
}

static void add_all(const place *p, const char *(*name)(size_t i)) {
    for (size_t i = 0; name(i); i++)
        add_word(p, name(i), "");
}

/* What may begin a value. */
static void add_values(const place *p) {
    const quantity *q;
    for (size_t i = 0; (q = quantity_row(i)); i++)
        add_word(p, q->name, quantity_has_value(q) ? "" : "(");
    add_all(p, builtin_name);
    for (size_t i = 0; i < p->c->names.count; i++) {
        const own_name *own = &p->c->names.row[i];
        const definition *d = (const definition *)own->definition;
        if (own->known)
            add_word(p, own->text, d && d->parameters ? "(" : "");
    }
    if (p->c->has_ans)
        add_word(p, "ans", "");
}

/* Inputs that the scene takes, and names of the user's. */
static void add_knobs(const place *p, const char *end) {
    for (input in = 0; in < INPUTS; in++)
        if (calc_takes(p->c, in, error_quiet()))
            add_word(p, quantity_of_input(in)->name, end);
    for (size_t i = 0; i < p->c->names.count; i++)
        if (p->c->names.row[i].known && !p->c->names.row[i].definition)
            add_word(p, p->c->names.row[i].text, end);
}

static bool same_dim(dim a, dim b) {
    return dim_equal(a, b) && (a.rad != 0) == (b.rad != 0);
}

/* Units of the dimension; any: of all. Where no unit alone has the dimension, all again. */
static void add_units(const place *p, bool any, dim d) {
    static const char *const prefixes[] = {"", "n", "u", "m", "c", "k", "M", "G"};
    enum { PREFIXES = sizeof prefixes / sizeof *prefixes };
    bool none = true;
    unit u = {.d = DIM_NONE};
    for (size_t i = 0; unit_name(i) && none && !any; i++)
        none = (unit_lookup(unit_name(i), strlen(unit_name(i)), &u), !same_dim(u.d, d));
    for (size_t i = 0; unit_name(i); i++)
        for (size_t j = 0; j < PREFIXES; j++) {
            char word[LEX_NAME];
            snprintf(word, sizeof word, "%s%s", prefixes[j], unit_name(i));
            if (unit_lookup(word, strlen(word), &u) && (any || none || same_dim(u.d, d)))
                add_word(p, word, "");
        }
}

/* ---- the statement ----------------------------------------------------------------------------- */

static bool token_is(const place *p, size_t i, const char *word) {
    return p->token[i].kind == T_NAME && strlen(word) == p->token[i].len &&
           !memcmp(p->line + p->token[i].at, word, p->token[i].len);
}

/* The `|` before the figure at the cursor, or 0. */
static size_t figure_begins(const place *p) {
    size_t i = p->count;
    while (i-- > 1)
        if (p->token[i].kind == T_BAR)
            return i;
    return 0;
}

static bool assigns(token_kind kind) {
    return kind == T_ASSIGN || kind == T_INCREMENT || kind == T_DEFINE;
}

/* Does the figure, or the statement, have the word; argument: with a value of its own? */
static bool is_said(const place *p, const char *word, bool argument) {
    for (size_t i = figure_begins(p) + 1; i < p->count; i++)
        if (token_is(p, i, word) && (!argument || (i + 1 < p->count && assigns(p->token[i + 1].kind))))
            return true;
    return false;
}

/* The tokens before the word that begins at `start`; what is none, as in names of files, is left out. */
static void read_tokens(place *p, size_t begin, size_t start) {
    calc_error *strange = error_quiet();
    lexer lx;
    p->start = start;
    p->count = 0;
    for (lex_start(&lx, p->line + begin, start - begin, strange);
         (lx.kind != T_END || strange->raised) && p->count < TOKENS; lex_next(&lx)) {
        error_clear(strange);
        if (lx.kind == T_END)
            continue;
        p->token[p->count].kind = lx.kind;
        p->token[p->count].at = begin + lx.at;
        p->token[p->count++].len = lx.len;
    }
    const bool assignment = p->count > 1 && assigns(p->token[1].kind);
    p->command = p->count && !assignment ? command_find(p->line + p->token[0].at, p->token[0].len) : NULL;
}

/* What the command takes, behind a word that has a row of its own what that takes; NULL: there is none. */
static const grammar *form_of(const place *p) {
    const grammar *f = p->command ? command_form(p->command) : NULL;
    const hole_row *first = f ? grammar_first(f, HOLE_CHOICE) : NULL;
    if (!first || !first->form || p->count < 2)
        return f;
    const char *name = p->line + p->token[1].at;
    size_t row;
    return word_among(first->words, name, strcspn(name, " \t\n;"), &row) ? first->form(row) : f;
}

/* `along cycle ...`: its arguments may follow. */
static const command *load_along(const place *p) {
    for (size_t i = figure_begins(p) + 2; i < p->count; i++)
        if (token_is(p, i - 1, "along"))
            return command_find(p->line + p->token[i].at, p->token[i].len);
    return NULL;
}

/* ---- what may follow --------------------------------------------------------------------------- */

/* What may stand in the hole; false: nothing that is known. */
static bool add_hole(const place *p, const hole *h, const char *behind_name) {
    const hole_kind kind = h->row->kind;
    if (h->row->words)
        add_all(p, h->row->words);
    else if (kind == HOLE_NAME || kind == HOLE_INPUT)
        add_knobs(p, behind_name);
    else if (kind == HOLE_EXPR || kind == HOLE_SPAN || kind == HOLE_VALUE)
        add_values(p);
    else
        return false;
    return true;
}

/* The dimension of the expression before `in`. */
static bool dim_before(const place *p, dim *d) {
    size_t first = p->count - 1;
    int depth = 0;
    lexer lx;
    expr e = {0};
    while (first > 0 && !(depth == 0 && p->token[first - 1].kind == T_COMMA) && !(first == 1 && p->command)) {
        first--;
        depth += p->token[first].kind == T_CLOSE ? 1 : p->token[first].kind == T_OPEN ? -1 : 0;
    }
    const char *text = p->line + p->token[first].at;
    lex_start(&lx, text, p->token[p->count - 1].at - p->token[first].at, error_quiet());
    const bool ok = expr_parse(p->c, &lx, &e) && lx.kind == T_END && expr_dim(p->c, &e, d);
    expr_free(&e);
    return ok;
}

/* ---- arguments --------------------------------------------------------------------------------- */

/* Has another way been gone? */
static bool is_barred(const place *p, const grammar *f, const clause *of) {
    for (const clause *a = f->clause; of->group && a < f->clause + f->count; a++)
        if (a->group == of->group && a->way != of->way && is_said(p, a->name, true))
            return true;
    return false;
}

/* What may still come. first: right behind the command's word, or that of a figure. */
static void add_items(const place *p, const grammar *f, bool first) {
    bool awaited = false; /* something must stand first */
    for (const clause *a = f->clause; a < f->clause + f->count; a++) {
        if (!*a->name && first) {
            add_hole(p, &a->hole[0], "");
            awaited = awaited || !a->optional;
        } else if (a->argument && !is_said(p, a->name, true) && !is_barred(p, f, a)) {
            add_word(p, a->name, "=");
        } else if (*a->name && !a->argument && !awaited && !is_said(p, a->name, false)) {
            add_word(p, a->name, "");
        }
    }
}

static bool has_expression(const grammar *f) {
    for (const clause *a = f->clause; a < f->clause + f->count; a++)
        if (a->holes && a->hole[0].row->kind == HOLE_EXPR)
            return true;
    return false;
}

/* After something that may end a value: what goes on. */
static void add_continuation(const place *p) {
    const grammar *f = form_of(p);
    if (f)
        add_items(p, f, false);
    if (load_along(p))
        add_items(p, command_form(load_along(p)), false);
    if (f && !has_expression(f))
        return;
    if (!is_said(p, "in", false))
        add_word(p, "in", "");
    if (!is_said(p, "at", false))
        add_word(p, "at", "");
}

/* The dimension that `NAME = NUMBER` wants at the cursor after the number. */
static bool wanted_dim(const place *p, dim *d) {
    size_t i = p->count - 1; /* the number */
    while (i > 0 &&
           (p->token[i].kind == T_NUMBER || p->token[i].kind == T_MINUS || p->token[i].kind == T_RANGE ||
            (p->token[i].kind == T_NAME && p->token[i - 1].kind == T_NUMBER))) /* 1 N .. 2 */
        i--;
    const hole_row *number =
        p->command && i == 0 ? grammar_first(command_form(p->command), HOLE_VALUE) : NULL;
    if (number) {
        *d = quantity_find(number->noun, strlen(number->noun))->d;
        return true;
    }
    if (i == 0 || !assigns(p->token[i].kind))
        return false;
    const quantity *q = quantity_find(p->line + p->token[i - 1].at, p->token[i - 1].len);
    if (q)
        *d = quantity_dim(q, &p->c->scene);
    return q != NULL;
}

/* ---- where the cursor is ----------------------------------------------------------------------- */

/* The clause whose word the last token is; NULL: none, or the statement's first word. */
static const clause *last_clause(const place *p, const grammar *f) {
    for (const clause *a = f ? f->clause : NULL; a && a < f->clause + f->count && p->count > 1; a++)
        if (!a->argument && *a->name && a->holes && token_is(p, p->count - 1, a->name))
            return a;
    return NULL;
}

/* Does a file name follow the tokens? Where a word of a table may stand too, only what has begun as one. */
static bool wants_file(const place *p) {
    const grammar *f = form_of(p);
    const clause *a = last_clause(p, f);
    if (!f || p->count == (f->shape ? 2 : 1))
        return f && grammar_first(f, HOLE_FILE) &&
               (!f->clause->hole->row->words || strcspn(p->line + p->start, "./") < p->cursor - p->start);
    return a && a->hole[0].row->kind == HOLE_FILE;
}

/* `record off`, where it has been begun: the editor completes either words or files. */
static void add_words_beside_file(const place *p) {
    const grammar *f = p->cursor > p->start && p->count == 1 ? command_form(p->command) : NULL;
    for (const clause *a = f ? f->clause : NULL; a && a < f->clause + f->count; a++)
        if (*a->name && !a->argument)
            add_word(p, a->name, "");
}

/* Behind `in` and `at` of an expression, and behind the word of a clause. */
static bool add_behind_word(const place *p) {
    const clause *a = last_clause(p, form_of(p));
    dim d = DIM_NONE;
    if (a)
        return add_hole(p, &a->hole[0], a->holes > 1 && a->hole[1].before == '=' ? "=" : "");
    if (token_is(p, p->count - 1, "at")) {
        add_knobs(p, "=");
        return true;
    }
    if (!token_is(p, p->count - 1, "in"))
        return false;
    const bool known = dim_before(p, &d);
    add_units(p, !known, d);
    return true;
}

static void complete_word(const place *p) {
    if (p->count == 0) {
        add_all(p, command_name);
        add_values(p);
        return;
    }
    const token_kind last = p->token[p->count - 1].kind;
    dim d = DIM_NONE;
    if (p->command && (p->count == 1 || last == T_BAR)) {
        add_items(p, command_form(p->command), true);
        return;
    }
    if (add_behind_word(p))
        return;
    if (last == T_NUMBER) {
        const bool known = wanted_dim(p, &d);
        const bool begun = p->cursor > p->start;
        add_units(p, !known, d);
        if (!begun && p->out->count == 1) /* the number stays what it is */
            free(p->out->word[--p->out->count]);
        if (begun || p->token[p->count - 1].at + p->token[p->count - 1].len < p->start)
            add_continuation(p);
    } else if (last == T_NAME || last == T_CLOSE || last == T_PERCENT || last == T_STRING) {
        add_continuation(p);
    } else {
        add_values(p);
    }
}

/* Of the statement at the cursor; quote: of an open one, else the cursor. False: it is a comment. */
static bool find_statement(const char *line, size_t cursor, size_t *begin, size_t *quote) {
    *begin = 0;
    *quote = cursor;
    for (size_t end; (end = shell_statement_end(line, *begin, cursor)) < cursor; *begin = end + 1)
        if (line[end] == '#')
            return false;
    for (size_t i = *begin; i < cursor; i++)
        if (line[i] == '"')
            *quote = *quote < cursor ? cursor : i;
    while (*begin < cursor && strchr(" \t\n", line[*begin]))
        ++*begin;
    return true;
}

static bool word_byte(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           (unsigned char)c >= 0x80;
}

/* Behind the last of these bytes. */
static size_t word_start(const char *line, size_t begin, size_t cursor, const char *parting) {
    while (cursor > begin && !strchr(parting, line[cursor - 1]))
        cursor--;
    return cursor;
}

void complete(calc *c, const char *line, size_t cursor, candidates *out) {
    place p = {.c = c, .line = line, .cursor = cursor, .out = out};
    size_t begin, quote, start = cursor;
    *out = (candidates){.start = cursor};
    if (!find_statement(line, cursor, &begin, &quote))
        return;
    const bool quoted = quote < cursor;
    /* names of files and of some tables hold what elsewhere parts words */
    start = quoted ? quote : word_start(line, begin, cursor, " \t\n");
    read_tokens(&p, begin, start);
    if (!quoted && !wants_file(&p))
        read_tokens(&p, begin, start = word_start(line, begin, cursor, " \t\n,="));
    p.start = out->start = start + quoted;
    out->files = wants_file(&p);
    if (out->files && !quoted)
        add_words_beside_file(&p);
    out->files = out->files && out->count == 0;
    if (out->files || out->count > 0 || quoted)
        return;
    if (begin < cursor && line[begin] == '?') { /* of the prompt: help */
        p.start = out->start = start > begin ? start : begin + 1;
        add_all(&p, help_name);
        return;
    }
    if (p.count == 1 && p.command)
        complete_word(&p);
    if (out->count > 0)
        return;
    for (start = cursor; start > begin && word_byte(line[start - 1]);)
        start--;
    while (start < cursor && line[start] >= '0' && line[start] <= '9') /* 20N */
        start++;
    read_tokens(&p, begin, start);
    out->start = start;
    complete_word(&p);
}
