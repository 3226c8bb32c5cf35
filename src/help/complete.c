/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Completion: parses the statement up to the cursor and offers the words that the tables of commands,
 * settings, geometries, quantities and units allow there. Changes nothing. */
#include "help/complete.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands/columns.h"
#include "commands/expressions.h"
#include "help/help.h"
#include "number/array.h"
#include "statement/command.h"
#include "text/lines.h"

/* ---- candidates -------------------------------------------------------------------------------- */

/* One attempt to complete a word. */
typedef struct attempt {
    shell *sh;
    const char *line;
    size_t start, cursor; /* beginning and end of the word */
    candidates *out;
    bool whole; /* back to the last blank it is one word, such as exact-sphere or a file name */
} attempt;

static void add_word(attempt *p, const char *word, const char *ending) {
    candidates *out = p->out;
    const size_t typed = p->cursor - p->start, n = strlen(word), m = strlen(ending);
    if (n < typed || memcmp(word, p->line + p->start, typed) != 0)
        return;
    if (!fret_array_room(&out->word, &out->room, out->count + 1, sizeof *out->word))
        return;
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

static void candidates_none(candidates *c) {
    while (c->count > 0)
        free(c->word[--c->count]);
}

void candidates_free(candidates *c) {
    candidates_none(c);
    free(c->word);
    *c = (candidates){.word = NULL};
}

static void add_all(attempt *p, const char *(*name)(size_t i)) {
    for (size_t i = 0; name(i); i++)
        add_word(p, name(i), "");
}

/* Adds the names that may begin an expression. */
static void add_values(attempt *p) {
    const quantity *q;
    for (size_t i = 0; (q = quantity_row(i)); i++)
        add_word(p, q->name, quantity_has_value(q) ? "" : "(");
    add_all(p, builtin_name);
    for (size_t i = 0; i < p->sh->calc.names.count; i++) {
        const own_name *own = &p->sh->calc.names.row[i];
        const definition *d = (const definition *)own->definition;
        if (own->known)
            add_word(p, own->text, d && d->parameters ? "(" : "");
    }
    if (p->sh->calc.has_ans)
        add_word(p, "ans", "");
}

/* Adds the inputs that the scene takes and the user's variables, each followed by `end`. */
static void add_knobs(attempt *p, const char *end) {
    for (input in = 0; in < INPUTS; in++)
        if (calc_takes(&p->sh->calc, in, error_quiet()))
            add_word(p, quantity_of_input(in)->name, end);
    for (size_t i = 0; i < p->sh->calc.names.count; i++)
        if (p->sh->calc.names.row[i].known && !p->sh->calc.names.row[i].definition)
            add_word(p, p->sh->calc.names.row[i].text, end);
}

/* Adds the units of dimension d; all units if `any`, or if no single unit has that dimension. */
static void add_units(attempt *p, bool any, dim d) {
    bool none = true;
    unit u = {.d = DIM_NONE};
    for (size_t i = 0; unit_name(i) && none && !any; i++)
        none = (unit_lookup(unit_name(i), strlen(unit_name(i)), &u), !same_dim(u.d, d));
    for (size_t i = 0; unit_name(i); i++)
        for (size_t j = 0; unit_prefix(j); j++) {
            char word[LEX_NAME];
            snprintf(word, sizeof word, "%s%s", unit_prefix(j), unit_name(i));
            if (unit_lookup(word, strlen(word), &u) && (any || none || same_dim(u.d, d)))
                add_word(p, word, "");
        }
}

/* ---- what the grammar allows ------------------------------------------------------------------- */

/* Adds what may stand in the hole; files beside words only once a `.` or `/` has been typed. */
static void add_hole(attempt *p, const clause *a, unsigned i) {
    const hole_row *row = a->hole[i].row;
    const hole_kind kind = row->kind;
    const bool other = a->hole[0].row->words;
    p->whole = p->whole || kind == HOLE_FILE || kind == HOLE_CHOICE || kind == HOLE_WORD;
    if (row->words)
        add_all(p, row->words);
    else if (kind == HOLE_NAME || kind == HOLE_INPUT)
        add_knobs(p, i + 1 < a->holes && a->hole[i + 1].before == '=' ? "=" : "");
    else if (kind == HOLE_EXPR || kind == HOLE_SPAN || kind == HOLE_VALUE)
        add_values(p);
    else if (kind == HOLE_FILE && (!other || strcspn(p->line + p->start, "./") < p->cursor - p->start))
        p->out->files = true;
}

/* Adds the clauses and arguments that may still follow; first: the row's nameless leading holes as well. */
static void add_clauses(attempt *p, const lexer *lx, const parsed *s, bool first) {
    const grammar *f = s->by;
    const clause *awaited = NULL; /* a leading hole that must not be left out */
    for (const clause *a = f->clause; a < f->clause + f->count; a++) {
        lexer quiet = *lx;
        quiet.error = error_quiet();
        if (!*a->name && first) {
            add_hole(p, a, 0);
            awaited = a->optional ? awaited : a;
        } else if (*a->name && (!awaited || (a->group && a->group == awaited->group)) &&
                   parsed_allows(&quiet, s, a)) {
            add_word(p, a->name, a->argument ? "=" : "");
        }
    }
}

static hole_kind kind_of(const parsed *s) {
    return s->open->of->hole[s->hole].row->kind;
}

/* Gets the dimension of the last expression of a list. */
static bool dim_in(attempt *p, lexer own, dim *d) {
    column columns[EXPRESSIONS];
    size_t count = 0;
    own.error = error_quiet();
    const bool ok = read_expressions(p->sh, &own, columns, EXPRESSIONS, &count) && own.kind == T_END &&
                    expr_dim(&p->sh->calc, &p->sh->list[count - 1], d);
    columns_free(columns, count);
    *p->sh->calc.note = 0;
    return ok;
}

/* Gets the dimension of the number before the cursor: of what it is assigned to, or of what `=` follows. */
static bool wanted_dim(attempt *p, const lexer *lx, const parsed *s, dim *d) {
    const clause *a = s->open->of;
    const bool own = kind_of(s) == HOLE_VALUE && !s->changed.len;
    const quantity *q = own ? quantity_find(a->name, strlen(a->name))
                            : quantity_find(lx->text + s->changed.at, s->changed.len);
    *d = q ? quantity_dim(q, &p->sh->calc.scene) : a->d;
    return q || own ||
           (!s->changed.len && a->hole[s->hole].before == '=' &&
            dim_in(p, hole_lexer(lx, &s->open->hole[s->hole - 1]), d));
}

/* Adds the units for the number before the cursor. Without a blank between them a single candidate is
 * dropped, for the editor would insert it unasked. */
static void add_units_of_number(attempt *p, const lexer *lx, const parsed *s) {
    dim d = DIM_NONE;
    const bool known = wanted_dim(p, lx, s, &d);
    add_units(p, !known, d);
    if (p->cursor == p->start && p->out->count == 1)
        candidates_none(p->out);
}

static void add_next(attempt *p, const lexer *lx, const parsed *s);

/* In `along cycle ...`, adds the arguments of the load command; false if there is no such command. */
static bool add_load(attempt *p, lexer own) {
    parsed load;
    const command *c = command_find(own.text + own.at, own.len);
    own.error = error_quiet();
    lex_next(&own);
    if (!c)
        return false;
    parsed_read_some(p->sh, &own, command_form(c), &load);
    if (parsed_at_cursor(&own))
        add_next(p, &own, &load);
    return true;
}

/* Adds what may follow a part that is complete. */
static void add_further(attempt *p, const lexer *lx, const parsed *s) {
    const clause *a = s->open->of;
    const hole_kind kind = kind_of(s);
    const char before = s->hole + 1 < a->holes ? a->hole[s->hole + 1].before : 0;
    const bool loaded = kind == HOLE_LOAD && add_load(p, hole_lexer(lx, &s->open->hole[s->hole]));
    if (s->end == PART_NUMBER && !loaded && kind != HOLE_COUNT && kind != HOLE_SECONDS)
        add_units_of_number(p, lx, s);
    if (!strchr(" \t\n", p->line[p->start - 1])) /* no blank after the number: only its unit may follow */
        return;
    if (a->again && !*a->name)
        add_hole(p, a, 0);
    if (before)
        add_word(p, before == '=' ? "=" : "+-", "");
    else
        add_clauses(p, lx, s, false);
    if (kind == HOLE_EXPR) {
        add_word(p, "in", "");
        add_word(p, "at", "");
    }
}

/* Adds what may come at the point where the statement was cut off. */
static void add_next(attempt *p, const lexer *lx, const parsed *s) {
    if (!s->open) {
        add_clauses(p, lx, s, s->count == 0);
    } else if (s->end == PART_EMPTY) {
        add_hole(p, s->open->of, s->hole);
    } else if (s->end == PART_VALUE) {
        add_values(p);
    } else if (s->end == PART_NAME) {
        add_knobs(p, "=");
        if (lx->text[lx->at - 1] == ',') /* another change, or the next expression of the list */
            add_values(p);
    } else if (s->end == PART_UNIT) {
        dim d = DIM_NONE;
        lexer own = hole_lexer(lx, &s->open->hole[s->hole]);
        own.end -= strlen("in");
        const bool known = dim_in(p, own, &d);
        add_units(p, !known, d);
    } else {
        add_further(p, lx, s);
    }
}

/* ---- where the cursor is ----------------------------------------------------------------------- */

/* Parses the statement from `begin` up to the word that begins at `start`, and adds what may stand there. */
static void complete_at(attempt *p, size_t begin, size_t start) {
    calc_error error = ERROR_NONE;
    static const char values[] = "EXPR, ..."; /* a statement without a command: a print or an assignment */
    parsed s = {.by = grammar_made("", NULL, values, "")};
    lexer lx;
    lex_start(&lx, p->line + begin, start - begin, &error);
    lx.cut = true;
    p->start = p->out->start = start;
    if (parsed_at_cursor(&lx)) {
        add_all(p, command_name);
        add_values(p);
        return;
    }
    const command *c = lx.kind == T_NAME ? command_find(lx.text + lx.at, lx.len) : NULL;
    const grammar *row = c ? command_form(c) : s.by;
    do { /* figures separated by | have arguments of their own */
        if (c)
            lex_next(&lx);
        if (c && lex_is(&lx, "map")) /* an expression follows */
            lex_next(&lx);
        error_clear(&error);
        parsed_read_some(p->sh, &lx, row, &s);
    } while (c && lx.kind == T_BAR);
    if (parsed_at_cursor(&lx))
        add_next(p, &lx, &s);
}

/* Finds the statement at the cursor and its open quotation mark (none: `cursor`); false in a comment. */
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

void complete(shell *sh, const char *line, size_t cursor, candidates *out) {
    attempt p = {.sh = sh, .line = line, .cursor = cursor, .out = out};
    size_t begin, quote, start = cursor;
    *out = (candidates){.start = cursor};
    if (!find_statement(line, cursor, &begin, &quote))
        return;
    while (start > begin && !strchr(" \t\n", line[start - 1]))
        start--;
    if (begin < cursor && line[begin] == '?') { /* ?WORD at the prompt is help */
        p.start = out->start = start > begin ? start : begin + 1;
        add_all(&p, help_name);
        return;
    }
    const bool quoted = quote < cursor;
    complete_at(&p, begin, quoted ? quote : start);
    p.start = out->start += quoted;
    /* words that replace all back to the last blank: only where `whole`; and words or files, not both */
    if (!p.whole || quoted || (out->files && cursor == p.start))
        candidates_none(out);
    out->files = out->files && out->count == 0;
    if (out->files || out->count > 0 || quoted)
        return;
    for (start = cursor; start > begin && lex_in_name(line[start - 1]);)
        start--;
    while (start < cursor && line[start] >= '0' && line[start] <= '9') /* 20N */
        start++;
    complete_at(&p, begin, start);
}
