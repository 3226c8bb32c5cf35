/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parses expressions into trees. Uses `scene`, `text` and `number`. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "language/tree.h"
#include "language/trial.h"
#include "number/array.h"
#include "number/real.h"
#include "text/characters.h"
#include "text/unit.h"

enum {
    DEPTH_LIMIT = 200,    /* of nesting, since the parser recurses */
    NODE_LIMIT = 1 << 21, /* 96 bytes each */
    LOOK = 4096           /* nodes between checks of the stop flag */
};

/* The names of the ranges around an expression, as a list. */
typedef struct bound {
    const char *name;
    const struct bound *outer;
} bound;

typedef struct parser {
    calc *c;
    lexer *lx;
    expr *e;
    const definition *within; /* the function whose body is parsed, or NULL */
    int depth;
    const struct bound *bound; /* names of the ranges around */
    size_t plain;              /* no `at` begins before this place */
    bool defer_unit;           /* a unit after the number at the cursor is left to the caller */
} parser;

/* ---- nodes ------------------------------------------------------------------------------------- */

static bool add_node(parser *p, const expr_node *node, size_t *index) {
    expr *e = p->e;
    if (e->count % LOOK == 0 && calc_stopped(p->c->scene.stop, p->lx->error))
        return false;
    if (e->count == e->room) {
        if (e->count >= NODE_LIMIT)
            return lex_fail(p->lx, "the expression has more than %d numbers, names and operators",
                            NODE_LIMIT);
        if (!fret_array_room(&e->nodes, &e->room, e->count + 1, sizeof *e->nodes))
            return calc_no_memory(p->lx->error);
    }
    *index = e->count;
    e->nodes[e->count] = *node;
    e->nodes[e->count++].len = (unsigned)(p->lx->last - node->at);
    return true;
}

static void drop_ats(expr *e) {
    while (e->ats) {
        expr_at *at = e->ats;
        e->ats = at->next;
        expr_free(&at->body);
        for (size_t i = 0; i < at->count; i++)
            expr_free(&at->change[i].value);
        free(at);
    }
}

void expr_free(expr *e) {
    drop_ats(e);
    free(e->nodes);
    free(e->arguments);
    *e = (expr){.nodes = NULL};
}

/* ---- EXPR at NAME = EXPR, ... ------------------------------------------------------------------ */

static bool parse_sum(parser *p, size_t *out);
static bool parse_whole(parser *p);

static bool unknown_name(parser *p) {
    lexer *lx = p->lx;
    char word[LEX_NAME];
    unit u;
    lex_word(lx, word);
    if (unit_lookup(lx->text + lx->at, lx->len, &u))
        return lex_fail(lx, "'%s' is a unit: it must follow a number", word);
    const char *answer = hint_from(word);
    if (answer)
        return lex_fail(lx, "unknown name '%s': %s", word, answer);
    const char *near = suggest(word, quantity_name);
    if (!near)
        near = suggest(word, builtin_name);
    const size_t same = character_before(word, strlen(word)); /* length without the last letter */
    for (size_t i = 0; !near && i < p->c->names.count; i++)
        if (p->c->names.row[i].known && same > 1 && !strncmp(p->c->names.row[i].text, word, same))
            near = p->c->names.row[i].text;
    return lex_fail(lx, near ? "unknown name '%s': did you mean %s?" : "unknown name '%s'", word, near);
}

/* Finds one of two words after an operand within this parenthesis. any: it is there, or in an inner one. */
static bool find_word(const lexer *lx, const char *word, const char *other, lexer *out, bool *any) {
    int depth = 0;
    *any = false;
    *out = *lx;
    out->error = error_quiet();
    for (bool operand = false; out->kind != T_END && depth >= 0; lex_next(out)) {
        const bool is = operand && (lex_is(out, word) || lex_is(out, other));
        depth += (out->kind == T_OPEN) - (out->kind == T_CLOSE);
        *any = *any || is;
        if (is && depth == 0)
            break;
        operand =
            out->kind == T_NAME || out->kind == T_NUMBER || out->kind == T_CLOSE || out->kind == T_PERCENT;
    }
    out->error = lx->error;
    return out->kind != T_END && depth == 0;
}

/* Parses a separate expression within this one. */
static bool parse_inner(const parser *p, expr *e, const bound *names) {
    parser inner = {.c = p->c, .lx = p->lx, .e = e, .within = p->within, .depth = p->depth, .bound = names};
    return parse_whole(&inner);
}

static expr_at *add_changed(parser *p) {
    expr_at *at = calloc(1, sizeof *at);
    if (at) {
        at->next = p->e->ats;
        p->e->ats = at;
    } else {
        calc_no_memory(p->lx->error);
    }
    return at;
}

static bool at_change(const lexer *lx) {
    return lx->kind == T_NAME && lex_peek(lx) == T_ASSIGN;
}

static bool parse_change(parser *p, expr_at *at) {
    lexer *lx = p->lx;
    size_t name;
    if (at->count == CHANGES)
        return lex_fail(lx, "at most %d changes", CHANGES);
    knob *q = &at->change[at->count].p;
    if (!at_change(lx))
        return lex_fail(lx, "expected NAME = EXPR after `at`");
    if (!quantity_find(lx->text + lx->at, lx->len) &&
        !names_find(&p->c->names, lx->text + lx->at, lx->len, &name))
        return unknown_name(p); /* no earlier error fits better */
    at->change[at->count].at = lx->at;
    if (!knob_name(p->c, lx, q)) /* whether the scene takes it is checked later */
        return false;
    for (size_t i = 0; i < at->count; i++)
        if (!knob_apart(&at->change[i].p, q, at->change[at->count].at, strlen(q->text), lx->error))
            return false;
    lex_next(lx);
    return parse_inner(p, &at->change[at->count++].value, p->bound);
}

/* Parses the changes from `at` on; begin: place of the expression that they apply to. */
static bool parse_at(parser *p, expr_at *at, size_t begin, size_t *out) {
    lexer *lx = p->lx, ahead;
    expr_node node = {.kind = N_AT, .at = begin, .changed = at};
    do {
        lex_next(lx);
        if (!parse_change(p, at))
            return false;
        ahead = *lx;
        if (lx->kind == T_COMMA)
            lex_next(&ahead);
    } while (lx->kind == T_COMMA && at_change(&ahead));
    return add_node(p, &node, out);
}

/* Parses a trailing `at ...`: the expression so far becomes its body. */
static bool read_at(parser *p) {
    expr *e = p->e;
    size_t root;
    if (!lex_is(p->lx, "at"))
        return !p->lx->error->raised;
    expr_at *at = calloc(1, sizeof *at);
    if (!at)
        return calc_no_memory(p->lx->error);
    at->body = *e;
    *e = (expr){.ats = at, .text = e->text, .at = e->at, .len = e->len};
    return parse_at(p, at, e->at, &root) && !p->lx->error->raised;
}

/* ---- names ------------------------------------------------------------------------------------- */

/* The error of a wrong number of arguments. */
static bool wrong_count(const parser *p, const char *name, int count, const char *more) {
    lexer *lx = p->lx;
    size_t from, len;
    if (count == 1 && !lex_one_value(lx)) {
        calc_append(p->c, lx->error, "; %s takes 1 argument", name);
        return false;
    }
    const bool comma = lex_decimal_comma(lx, lx->at, &from, &len);
    return lex_fail(lx, "%s takes %d argument%s%s%s", name, count, count > 1 ? "s" : "", more,
                    comma ? "; a decimal comma is a point here" : "");
}

/* Parses arguments from ( on; appends their nodes to e->arguments. */
static bool parse_arguments(parser *p, const char *name, unsigned count, expr_node *node) {
    lexer *lx = p->lx;
    size_t root[PARAMETERS];
    expr *e = p->e;
    for (unsigned j = 0; j < count; j++) {
        lex_next(lx);
        if (!parse_sum(p, &root[j]))
            return false;
        if (node->kind == N_CALL && count == 1 && lx->kind != T_CLOSE)
            return lex_one_value(lx) && lex_fail(lx, "expected ) after the argument of %s", name);
        if (lx->kind != (j + 1 < count ? T_COMMA : T_CLOSE))
            return wrong_count(p, name, (int)count, "");
    }
    lex_next(lx);
    node->left = e->argument_count;
    node->right = count;
    for (unsigned j = 0; j < count; j++) {
        if (!fret_array_room(&e->arguments, &e->argument_room, e->argument_count + 1, sizeof *e->arguments))
            return calc_no_memory(lx->error);
        e->arguments[e->argument_count++] = root[j];
    }
    return true;
}

static bool parse_quantity(parser *p, const quantity *q, size_t *out) {
    lexer *lx = p->lx;
    expr_node node = {.kind = N_QUANTITY, .at = lx->at, .q = q};
    const bool call = lex_peek(lx) == T_OPEN;
    if (call && !quantity_arguments(q))
        return lex_fail(lx, "%s is not a function", q->name);
    if (!call && !quantity_has_value(q))
        return lex_fail(lx, "%s is a function: %s(%s)", q->name, q->name, q->argument);
    lex_next(lx);
    if (call) {
        node.kind = N_CALL;
        if (!parse_arguments(p, q->name, quantity_arguments(q), &node))
            return false;
    }
    return add_node(p, &node, out);
}

static bool parse_builtin(parser *p, size_t i, size_t *out) {
    lexer *lx = p->lx;
    const builtin *function = builtin_row(i);
    expr_node node = {.kind = N_BUILTIN, .at = lx->at, .index = i};
    lex_next(lx);
    if (!function) {
        node.kind = N_NUMBER;
        node.index = 0;
        node.v = (value){FRET_PI, DIM_NONE};
        return add_node(p, &node, out);
    }
    if (function->d == DIM_RANGE)
        return calc_fail(lx->error, node.at, strlen(function->name), "write %s", function->summary);
    if (lx->kind != T_OPEN)
        return lex_fail(lx, "expected ( after %s%s", function->name,
                        node.at > 0 && lx->text[node.at - 1] == '/' ? ", a function and not a unit" : "");
    size_t *argument[2] = {&node.left, &node.right};
    const int count = function->f2 ? 2 : 1;
    for (int j = 0; j < count; j++) {
        lex_next(lx);
        if (!parse_sum(p, argument[j]))
            return false;
        const bool more = function->d == DIM_SHARED && j + 1 == count && lx->kind == T_COMMA;
        if (!more && lx->kind != (j + 1 < count ? T_COMMA : T_CLOSE))
            return wrong_count(p, function->name, count, function->d == DIM_SHARED ? " or more" : "");
        if (!more)
            continue;
        size_t first; /* min(a, b, c) is min(min(a, b), c) */
        expr_node two = node;
        two.at = p->e->nodes[node.right].at; /* the text that an error shows */
        if (!add_node(p, &two, &first))
            return false;
        node.left = first;
        j--;
    }
    lex_next(lx);
    return add_node(p, &node, out);
}

static bool parse_own(parser *p, size_t index, size_t *out) {
    lexer *lx = p->lx;
    const definition *d = (const definition *)p->c->names.row[index].definition;
    expr_node node = {.kind = N_NAME, .at = lx->at, .index = index};
    const bool function = d && d->parameters > 0, call = lex_peek(lx) == T_OPEN;
    if (function && !call)
        return lex_fail(lx, "%s is a function: %s(%s%s)", d->label, d->label, d->parameter[0],
                        d->parameters > 1 ? ", ..." : "");
    lex_next(lx);
    if (!function)
        return add_node(p, &node, out);
    node.kind = N_APPLY;
    return parse_arguments(p, d->label, d->parameters, &node) && add_node(p, &node, out);
}

/* Is the word a parameter of the function being defined? */
static bool find_parameter(const parser *p, unsigned *j) {
    const unsigned count = p->within ? p->within->parameters : 0;
    *j = 0;
    while (*j < count && !lex_is(p->lx, p->within->parameter[*j]))
        ++*j;
    return *j < count;
}

static bool parse_name(parser *p, size_t *out) {
    lexer *lx = p->lx;
    const char *word = lx->text + lx->at;
    const size_t len = lx->len;
    size_t i;
    unsigned j;
    const bool parameter = find_parameter(p, &j);
    if (parameter || lex_is(lx, "ans")) {
        const expr_node node = {.kind = parameter ? N_PARAMETER : N_ANS, .at = lx->at, .index = j};
        lex_next(lx);
        return add_node(p, &node, out);
    }
    const quantity *q = quantity_find(word, len);
    if (q)
        return parse_quantity(p, q, out);
    if (builtin_find(word, len, &i))
        return parse_builtin(p, i, out);
    return names_find(&p->c->names, word, len, &i) ? parse_own(p, i, out) : unknown_name(p);
}

/* ---- numbers and units ------------------------------------------------------------------------- */

/* Are all nodes from `first` on made of numbers without units? Backwards: others mostly end with a unit. */
static bool numbers_alone(const parser *p, size_t first) {
    const expr_node *n = p->e->nodes + p->e->count;
    while (n-- > p->e->nodes + first)
        if (n->kind == N_NUMBER ? n->index
                                : n->kind != N_NEGATE && n->kind != N_BINARY && n->kind != N_BUILTIN)
            return false;
    return true;
}

/* Refuses `5 N*s` where s is also a name. */
static bool is_free_name(parser *p, size_t from) {
    lexer *lx = p->lx, own = *lx;
    size_t i;
    unsigned j;
    unit u;
    own.end = lx->last;
    for (lex_seek(&own, from); own.kind != T_END; lex_next(&own)) {
        parser of = {.lx = &own, .within = p->within};
        if (own.kind == T_NAME && own.at > from && unit_lookup(own.text + own.at, own.len, &u) &&
            (find_parameter(&of, &j) || names_find(&p->c->names, own.text + own.at, own.len, &i)))
            return !calc_fail(
                lx->error, own.at, own.len,
                "%.*s is a name here, and a unit: write its product with ( ), as (5 N)*%.*s or 5 "
                "N*(1 %.*s)",
                LEX_WORD(&own), LEX_WORD(&own), LEX_WORD(&own));
    }
    return false;
}

static bool read_unit(parser *p, unit *u) {
    const size_t from = p->lx->at;
    return unit_parse(p->lx, u) && (u->d.s == 0 || !is_free_name(p, from));
}

/* Reads the unit at the cursor, and makes the node `*out op unit`. */
static bool add_unit(parser *p, char op, size_t at, size_t *out) {
    expr_node node = {.kind = N_BINARY, .op = op, .at = at, .left = *out, .index = p->lx->at},
              number = {.kind = N_NUMBER, .at = p->lx->at, .index = 1};
    unit u;
    if (!read_unit(p, &u))
        return false;
    number.v = (value){unit_scale(&u), u.d};
    p->e->unclear = p->e->unclear || op == '?';
    return add_node(p, &number, &node.right) && add_node(p, &node, out);
}

/* Adds a unit after a value computed from numbers. */
static bool unit_behind(parser *p, size_t at, size_t *out) {
    return p->defer_unit || !unit_at(p->lx) || add_unit(p, 'U', at, out);
}

/* Is it `0.5 in` without a unit after `in`? */
static bool means_inch(const parser *p) {
    lexer next = *p->lx;
    next.error = error_quiet();
    lex_next(&next);
    return (next.kind != T_NAME && !unit_at(&next)) || lex_is(&next, "in") || lex_is(&next, "at") ||
           lex_peek(&next) == T_ASSIGN || (p->c->keyword && p->c->keyword(&next));
}

/* Is the word after a number a value or a unit, and no keyword or argument of a command? */
static bool at_factor(const parser *p) {
    const lexer *lx = p->lx;
    const char *word = lx->text + lx->at;
    const token_kind next = lex_peek(lx);
    size_t i;
    unsigned j;
    if (next == T_ASSIGN || next == T_DEFINE || next == T_INCREMENT || next == T_NUMBER)
        return false;
    if (builtin_find(word, lx->len, &i))
        return !builtin_row(i) || next == T_OPEN;
    if (quantity_find(word, lx->len) || unit_at(lx) || find_parameter(p, &j))
        return true;
    /* a user's name may also be a word of the command: `to /FILE`, `points` */
    return names_find(&p->c->names, word, lx->len, &i) &&
           (next == T_PLUS || next == T_TIMES || next == T_POWER || next == T_CLOSE ||
            (p->c->keyword && !p->c->keyword(lx)));
}

static bool parse_number(parser *p, size_t *out) {
    lexer *lx = p->lx;
    size_t at = lx->at, len = lx->len;
    expr_node node = {.kind = N_NUMBER, .at = at, .v = {lx->number, DIM_NONE}};
    unit u;
    lex_next(lx);
    if (!p->defer_unit && unit_at(lx)) {
        node.index = 1;
        if (!read_unit(p, &u))
            return false;
        const bool zero = node.v.v == 0;
        double v = 0;
        unit_number(lx->text + at, len, '.', &u, &v);
        node.v = (value){v, u.d};
        if (!isfinite((double)node.v.v) || (node.v.v == 0 && !zero))
            return calc_fail(lx->error, at, lx->last - at, "the number is too %s for double precision",
                             node.v.v == 0 ? "small" : "large");
    }
    if (lx->error->raised)
        return false;
    if (lx->kind == T_NAME && !node.index && lex_is(lx, "in") && means_inch(p))
        return calc_fail(lx->error, lx->at, lx->len,
                         "`in` asks for a unit: an inch is called inch (%.*s inch)", LEX_SHOWN(len),
                         lx->text + at);
    if (lx->kind == T_OPEN || (lx->kind == T_NAME && !(p->defer_unit && unit_at(lx)) && at_factor(p)))
        return lex_fail(lx, "unexpected '%.*s': a product needs *, a list commas", LEX_WORD(lx));
    return add_node(p, &node, out);
}

bool expr_stray_unit(lexer *lx, bool (*keyword)(const lexer *lx)) {
    unit known;
    if (lx->kind != T_NAME || lx->text[lx->last - 1] < '0' || lx->text[lx->last - 1] > '9' || !keyword ||
        keyword(lx) || lex_assigns(lx) || quantity_find(lx->text + lx->at, lx->len) ||
        unit_lookup(lx->text + lx->at, lx->len, &known))
        return false;
    unit_parse(lx, &known); /* sets the error */
    return true;
}

/* ---- (integral EXPR for NAME = LO .. HI) ------------------------------------------------------- */

/* Reads the name of a range, which is known while its expression is parsed. */
static bool read_bound(parser *p, lexer *lx, knob *out) {
    unsigned j;
    parser of = {.lx = lx, .within = p->within};
    if (find_parameter(&of, &j))
        return lex_fail(lx, "%.*s is an argument already", LEX_WORD(lx));
    for (const bound *b = p->bound; b; b = b->outer)
        if (lex_is(lx, b->name))
            return lex_fail(lx, "%s is given twice", b->name);
    return knob_name(p->c, lx, out);
}

static bool parse_body_of(parser *p, expr *e, const bound *names) {
    parser inner = {.c = p->c, .lx = p->lx, .e = e, .within = p->within, .depth = p->depth, .bound = names};
    return parse_whole(&inner) && read_at(&inner);
}

/* Parses EXPR for NAME: the cursor is on EXPR, `range` on `for`. */
static bool parse_varied(parser *p, lexer *range, expr_at *at) {
    lexer *lx = p->lx;
    knob *name = &at->change[0].p;
    size_t i;
    lex_next(range);
    const bool known = names_find(&p->c->names, lx->text + range->at, range->len, &i);
    if (!read_bound(p, range, name))
        return false;
    const bound here = {name->text, p->bound};
    const bool ok = parse_body_of(p, &at->body, &here);
    if (!name->is_input)
        p->c->names.row[name->name].known = known;
    return ok;
}

static bool parse_ends(parser *p, expr_at *at) {
    lexer *lx = p->lx;
    for (token_kind before = T_ASSIGN; at->count < 2; before = T_RANGE) {
        if (lx->kind != before)
            return lex_fail(lx, at->count ? "expected .. between the two ends"
                                          : "expected = LO .. HI after the name");
        lex_next(lx);
        at->change[at->count].at = lx->at;
        if (!parse_inner(p, &at->change[at->count++].value, p->bound))
            return false;
    }
    return true;
}

static bool parse_load(lexer *lx, expr_at *at) {
    at->what = lex_is(lx, "cycle") ? ALONG_CYCLE : ALONG_PROGRAM;
    return lex_accept(lx, "cycle") || lex_accept(lx, "program") ||
           lex_fail(lx, "expected along cycle or along program");
}

/* Parses a range; the cursor is on its word, a row of the builtins. */
static bool parse_over(parser *p, size_t word, size_t *out) {
    lexer *lx = p->lx, range;
    expr_node node = {.kind = N_OVER, .at = lx->at, .index = word};
    expr_at *at = node.changed = add_changed(p);
    const char *usage = builtin_row(word)->summary;
    bool inner;
    if (!at)
        return false;
    if (!find_word(lx, "for", "along", &range, &inner))
        return calc_fail(lx->error, lx->at, lx->len, "expected a range behind the expression: %s", usage);
    const size_t begins = range.at;
    at->along = lex_is(&range, "along");
    if (at->along && lex_is(lx, "integral"))
        return lex_fail(&range, "an integral needs a range over a name: %s", usage);
    lex_next(lx);
    if (!(at->along ? parse_body_of(p, &at->body, p->bound) : parse_varied(p, &range, at)))
        return false;
    if (lx->at != begins)
        return lex_fail(lx, "unexpected '%.*s': %s", LEX_WORD(lx), usage);
    if (at->along)
        lex_next(lx);
    else
        lex_seek(lx, range.at);
    if (!(at->along ? parse_load(lx, at) : parse_ends(p, at)))
        return false;
    if (lx->kind != T_CLOSE)
        return lex_fail(lx, "expected ) after the range");
    lex_next(lx);
    return add_node(p, &node, out);
}

/* ---- parentheses ------------------------------------------------------------------------------- */

static bool parse_parenthesis(parser *p, size_t *out) {
    lexer *lx = p->lx, ahead;
    size_t word;
    lex_next(lx);
    if (lx->kind == T_NAME && builtin_find(lx->text + lx->at, lx->len, &word) && builtin_row(word) &&
        builtin_row(word)->d == DIM_RANGE)
        return parse_over(p, word, out);
    const size_t begin = lx->at;
    bool changes = false;
    const bool changed = begin >= p->plain && find_word(lx, "at", "at", &ahead, &changes);
    if (begin >= p->plain && !changes)
        p->plain = ahead.at;
    if (changed) {
        expr_at *at = add_changed(p);
        if (!at || !parse_inner(p, &at->body, p->bound) || (lex_is(lx, "at") && !parse_at(p, at, begin, out)))
            return false;
    } else if (!parse_sum(p, out)) {
        return false;
    }
    if (lx->kind != T_CLOSE)
        return lex_one_value(lx) && lex_fail(lx, "expected )");
    lex_next(lx);
    return true;
}

/* Refuses a unit after a value that is no number. */
static bool no_unit(lexer *lx) {
    if (lx->error->raised)
        return false;
    return lx->kind != T_NAME || !unit_at(lx) ||
           lex_fail(lx, "'%.*s' is a unit: it must follow a number, or `in`", LEX_WORD(lx));
}

static bool parse_primary(parser *p, size_t *out) {
    lexer *lx = p->lx;
    const size_t at = lx->at, first = p->e->count;
    if (lx->error->raised)
        return false;
    switch (lx->kind) {
    case T_NUMBER:
        return parse_number(p, out);
    case T_OPEN:
        return parse_parenthesis(p, out) && unit_behind(p, at, out);
    case T_NAME:
        return parse_name(p, out) && (numbers_alone(p, first) ? unit_behind(p, at, out) : no_unit(lx));
    case T_END:
        return lex_fail(lx, "expected a value here");
    default:
        return lex_fail(lx, "expected a value, not '%.*s'", LEX_WORD(lx));
    }
}

static bool parse_unary(parser *p, size_t *out);

static bool parse_power(parser *p, size_t *out) {
    const size_t at = p->lx->at, first = p->e->count;
    const bool defer_unit = p->defer_unit;
    unit u;
    if (!parse_primary(p, out))
        return false;
    if (p->lx->kind != T_POWER)
        return true;
    expr_node node = {.kind = N_BINARY, .op = '^', .at = at, .left = *out};
    lex_next(p->lx);
    const size_t exponent = p->lx->at;
    p->defer_unit = true;
    bool ok = parse_unary(p, &node.right);
    p->defer_unit = defer_unit;
    lexer ahead = *p->lx;
    ahead.error = error_quiet();
    if (ok && unit_at(&ahead) && unit_parse(&ahead, &u) && dim_equal(u.d, DIM_NONE)) /* 2^50 % */
        ok = add_unit(p, 'U', exponent, &node.right);
    return ok && add_node(p, &node, out) &&
           (numbers_alone(p, first) ? unit_behind(p, at, out) : no_unit(p->lx));
}

static bool parse_unary(parser *p, size_t *out) {
    bool ok;
    if (++p->depth > DEPTH_LIMIT)
        return lex_fail(p->lx, "the expression is nested too deeply");
    if (p->lx->kind == T_MINUS || p->lx->kind == T_PLUS) {
        bool minus = p->lx->kind == T_MINUS;
        const size_t at = p->lx->at;
        lex_next(p->lx);
        ok = parse_unary(p, out);
        if (ok && minus)
            ok = add_node(p, &(expr_node){.kind = N_NEGATE, .at = at, .left = *out}, out);
    } else {
        ok = parse_power(p, out);
    }
    p->depth--;
    return ok;
}

/* A unit after a quotient of numbers may belong to the divisor or to the quotient. */
static bool parse_product(parser *p, size_t *out) {
    size_t at = p->lx->at, seen = p->e->count;
    bool numbers = true; /* are the nodes before `seen` numbers? */
    if (!parse_unary(p, out))
        return false;
    while (p->lx->kind == T_TIMES || p->lx->kind == T_DIVIDE) {
        expr_node node = {
            .kind = N_BINARY, .op = (char)p->lx->kind, .at = at, .left = *out, .index = p->lx->at};
        if (node.op == '/') {
            p->defer_unit = numbers = numbers && numbers_alone(p, seen);
            seen = p->e->count;
        }
        lex_next(p->lx);
        bool ok = parse_unary(p, &node.right) && add_node(p, &node, out);
        if (ok && p->defer_unit && unit_at(p->lx))
            ok = add_unit(p, '?', at, out);
        p->defer_unit = false;
        if (!ok)
            return false;
    }
    return true;
}

static bool parse_sum(parser *p, size_t *out) {
    size_t at = p->lx->at;
    const bool defer_unit = p->defer_unit;
    p->defer_unit = false;
    if (!parse_product(p, out))
        return false;
    while (p->lx->kind == T_PLUS || p->lx->kind == T_MINUS) {
        expr_node node = {.kind = N_BINARY, .op = (char)p->lx->kind, .at = at, .left = *out};
        lex_next(p->lx);
        if (!parse_product(p, &node.right) || !add_node(p, &node, out))
            return false;
    }
    p->defer_unit = defer_unit;
    return true;
}

/* ---- whole expressions ------------------------------------------------------------------------- */

static bool parse_whole(parser *p) {
    size_t root;
    expr *e = p->e;
    drop_ats(e);
    e->count = e->argument_count = 0;
    e->unclear = false;
    e->text = p->lx->text;
    e->at = p->lx->at;
    if (!parse_sum(p, &root))
        return false;
    /* the root is last, also of a parenthesised expression, which adds no node */
    e->len = p->lx->last - e->at;
    return p->lx->list || lex_one_value(p->lx);
}

bool expr_parse(calc *c, lexer *lx, expr *e) {
    parser p = {.c = c, .lx = lx, .e = e};
    return parse_whole(&p);
}

bool expr_read_at(calc *c, lexer *lx, expr *e) {
    parser p = {.c = c, .lx = lx, .e = e};
    return read_at(&p);
}

bool expr_parse_at(calc *c, lexer *lx, expr *e) {
    return expr_parse(c, lx, e) && expr_read_at(c, lx, e);
}

static void definition_end(counted *self) {
    definition *d = (definition *)self;
    expr_free(&d->body);
    free(d->label);
    free(d->text);
    free(d);
}

/* Parses the body of a definition at the cursor. */
static bool parse_body(calc *c, lexer *lx, definition *d) {
    parser p = {.c = c, .lx = lx, .within = d};
    return parse_body_of(&p, &d->body, NULL);
}

/* Parses twice: in the statement, for errors and length, then from the definition's own copy. */
definition *definition_parse(calc *c, lexer *lx, const char *label, size_t len, char (*parameter)[LEX_NAME],
                             unsigned parameters) {
    definition *d = calloc(1, sizeof *d);
    if (!d) {
        calc_no_memory(lx->error);
        return NULL;
    }
    d->base = (counted){1, definition_end};
    d->parameters = parameters;
    for (unsigned i = 0; i < parameters; i++)
        memcpy(d->parameter[i], parameter[i], LEX_NAME);
    const size_t at = lx->at;
    bool ok = parse_body(c, lx, d);
    if (ok) {
        d->label = strndup(label, len);
        d->text = strndup(lx->text + at, lx->last - at);
        ok = (d->label && d->text) || calc_no_memory(lx->error);
    }
    if (ok) {
        lexer own;
        lex_start(&own, d->text, strlen(d->text), lx->error);
        ok = parse_body(c, &own, d);
    }
    if (ok)
        return d;
    counted_drop(d);
    return NULL;
}
