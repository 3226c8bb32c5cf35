/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Expressions as trees, and the variables they see. */
#include "calc/expr.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "calc/tree.h"
#include "number/real.h"

enum { DEPTH_LIMIT = 200 }; /* of nesting: the parser and the evaluator recurse */

/* ---- variables --------------------------------------------------------------------------------- */

void calc_free(calc *c) {
    for (size_t i = 0; i < c->variable_count; i++)
        free(c->variables[i].name);
    free(c->variables);
    free(c->slots);
    expr_free(&c->scratch);
    scene_free(&c->scene);
    c->variables = NULL;
    c->slots = NULL;
    c->variable_count = c->variable_room = 0;
}

static bool is_word(const char *a, const char *word, size_t len) {
    return strlen(a) == len && !memcmp(a, word, len);
}

/* The place of a name among the slots: its own, or the free one where it belongs. */
static size_t *slot_of(const calc *c, const char *name, size_t len) {
    size_t hash = 0, mask = 2 * c->variable_room - 1; /* a power of two */
    for (size_t i = 0; i < len; i++)
        hash = 31 * hash + (unsigned char)name[i];
    for (hash ^= hash >> 15;; hash++) {
        size_t *slot = &c->slots[hash & mask];
        if (!*slot || is_word(c->variables[*slot - 1].name, name, len))
            return slot;
    }
}

bool calc_find_variable(const calc *c, const char *name, size_t len, size_t *index) {
    size_t slot = c->variable_count ? *slot_of(c, name, len) : 0;
    *index = slot - 1;
    return slot > 0;
}

/* Room for twice as many, at least 16. */
static bool more_variables(calc *c) {
    size_t room = c->variable_room ? 2 * c->variable_room : 16;
    variable *grown = realloc(c->variables, room * sizeof *grown);
    if (!grown)
        return false;
    c->variables = grown;
    size_t *slots = calloc(2 * room, sizeof *slots);
    if (!slots)
        return false;
    free(c->slots);
    c->slots = slots;
    c->variable_room = room;
    for (size_t i = 0; i < c->variable_count; i++)
        *slot_of(c, c->variables[i].name, strlen(c->variables[i].name)) = i + 1;
    return true;
}

bool calc_set_variable(calc *c, const char *name, size_t len, value v) {
    size_t i;
    if (!calc_find_variable(c, name, len, &i)) {
        if (c->variable_count == c->variable_room && !more_variables(c))
            return false;
        char *copy = malloc(len + 1);
        if (!copy)
            return false;
        memcpy(copy, name, len);
        copy[len] = 0;
        i = c->variable_count++;
        c->variables[i].name = copy;
        *slot_of(c, name, len) = i + 1;
    }
    c->variables[i].v = v;
    return true;
}

const char *calc_variable_name(const calc *c, size_t i) {
    return i < c->variable_count ? c->variables[i].name : NULL;
}

const char *name_taken(const char *name, size_t len) {
    unit u;
    if (quantity_find(name, len))
        return "a quantity";
    if (unit_lookup(name, len, &u))
        return "a unit";
    size_t i;
    return !builtin_find(name, len, &i) ? NULL : builtin_row(i) ? "a function" : "a constant";
}

/* ---- parser ------------------------------------------------------------------------------------ */

typedef struct parser {
    const calc *c;
    lexer *lx;
    expr *e;
    int depth;
} parser;

size_t node_operands(const expr_node *n) {
    switch (n->kind) {
    case N_BINARY:
        return 2;
    case N_BUILTIN:
        return builtin_row(n->index)->f2 ? 2 : 1;
    case N_CALL:
    case N_NEGATE:
        return 1;
    default:
        return 0;
    }
}

static bool add(parser *p, expr_node node, size_t *index) {
    expr *e = p->e;
    size_t takes = node_operands(&node);
    node.varies = (node.kind == N_SWEEP && node.index == 0) || (takes && e->nodes[node.left].varies) ||
                  (takes > 1 && e->nodes[node.right].varies);
    if (e->count == e->room) {
        size_t room = e->room ? 2 * e->room : 16;
        expr_node *grown = realloc(e->nodes, room * sizeof *grown);
        if (!grown)
            return lex_fail(p->lx, "out of memory");
        e->nodes = grown;
        e->room = room;
    }
    node.len = p->lx->last - node.at;
    *index = e->count;
    e->nodes[e->count++] = node;
    return true;
}

static bool unit_word(const lexer *lx, unit *u) {
    if (lx->kind == T_PERCENT)
        return unit_lookup("%", 1, u);
    return lx->kind == T_NAME && unit_lookup(lx->text + lx->at, lx->len, u);
}

/* One unit with its exponent. */
static bool unit_factor(lexer *lx, unit *out) {
    if (!unit_word(lx, out))
        return false;
    lex_next(lx);
    if (lx->kind != T_POWER)
        return true;
    size_t at = lx->at;
    lex_next(lx);
    int sign = 1;
    if (lx->kind == T_MINUS) {
        sign = -1;
        lex_next(lx);
    }
    if (lx->kind != T_NUMBER)
        return calc_fail(lx->error, at, lx->at + lx->len - at, "the exponent of a unit must be a number");
    double n = sign * lx->number;
    lex_next(lx);
    out->d.N *= n;
    out->d.m *= n;
    double exp10 = out->exp10 * n;
    out->factor = out->factor == 1 ? 1 : fret_pow(out->factor, n);
    if (fabs(exp10) < 300 && exp10 == floor(exp10)) {
        out->exp10 = (int)exp10;
    } else {
        out->exp10 = 0;
        out->factor *= fret_pow(10, exp10);
    }
    return true;
}

/* After a number, `* m` goes on with the unit only if m is a unit: quantities never are. */
bool unit_parse(lexer *lx, unit *out) {
    if (!unit_factor(lx, out)) {
        if (lx->error->raised || lx->kind != T_NAME)
            return lx->error->raised ? false : lex_fail(lx, "expected a unit");
        char word[64];
        snprintf(word, sizeof word, "%.*s", (int)(lx->len < 60 ? lx->len : 60), lx->text + lx->at);
        const char *near = unit_suggest(word);
        return lex_fail(lx, near ? "unknown unit '%s': did you mean %s?" : "unknown unit '%s'", word, near);
    }
    while (lx->kind == T_TIMES || lx->kind == T_DIVIDE) {
        lexer before = *lx;
        int sign = lx->kind == T_TIMES ? 1 : -1;
        unit u;
        lex_next(lx);
        if (lx->kind != T_NAME || !unit_word(lx, &u)) {
            *lx = before;
            break;
        }
        if (!unit_factor(lx, &u))
            return false;
        out->d.N += sign * u.d.N;
        out->d.m += sign * u.d.m;
        out->exp10 += sign * u.exp10;
        out->factor = sign > 0 ? out->factor * u.factor : out->factor / u.factor;
    }
    return true;
}

/* A literal is rounded once: the decimal scale of its unit goes into its exponent. */
static long double scaled(const lexer *lx, size_t at, size_t len, const unit *u) {
    if (u->factor == 1)
        return lex_decimal(lx->text + at, len, u->exp10);
    return (double)(lex_decimal(lx->text + at, len, 0) * unit_scale(u));
}

static bool parse_sum(parser *p, size_t *out);

static bool unknown_name(parser *p) {
    lexer *lx = p->lx;
    char word[64];
    snprintf(word, sizeof word, "%.*s", (int)(lx->len < 60 ? lx->len : 60), lx->text + lx->at);
    unit u;
    if (unit_lookup(lx->text + lx->at, lx->len, &u))
        return lex_fail(lx, "'%s' is a unit: it must follow a number", word);
    const char *near = suggest(word, quantity_name);
    if (!near)
        near = suggest(word, builtin_name);
    for (size_t i = 0; !near && i < p->c->variable_count; i++)
        if (strlen(word) > 2 && !strncmp(p->c->variables[i].name, word, strlen(word) - 1))
            near = p->c->variables[i].name;
    return lex_fail(lx, near ? "unknown name '%s': did you mean %s?" : "unknown name '%s'", word, near);
}

static bool parse_name(parser *p, size_t *out) {
    lexer *lx = p->lx;
    const char *word = lx->text + lx->at;
    expr_node node = {.at = lx->at};
    size_t len = lx->len;
    for (size_t i = 0; i < 2; i++)
        if (p->c->sweep_name[i] && is_word(p->c->sweep_name[i], word, len)) {
            node.kind = N_SWEEP;
            node.index = i;
            lex_next(lx);
            return add(p, node, out);
        }
    bool call = lex_peek(lx) == T_OPEN;
    node.q = quantity_find(word, len);
    if (node.q && !(call && !node.q->call)) {
        lex_next(lx);
        if (!call && !node.q->get && node.q->in < 0)
            return calc_fail(lx->error, node.at, len, "%s is a function: %s(%s)", node.q->name, node.q->name,
                             node.q->argument);
        node.kind = call ? N_CALL : N_QUANTITY;
        if (call) {
            lex_next(lx);
            if (!parse_sum(p, &node.left))
                return false;
            if (lx->kind != T_CLOSE)
                return lex_fail(lx, "expected ) after the argument of %s", node.q->name);
            lex_next(lx);
        }
        return add(p, node, out);
    }
    if (node.q)
        return lex_fail(lx, "%s is not a function", node.q->name);
    size_t i;
    bool own = builtin_find(word, len, &i);
    const builtin *function = own ? builtin_row(i) : NULL; /* else pi */
    if (function) {
        lex_next(lx);
        if (lx->kind != T_OPEN)
            return lex_fail(lx, "expected ( after %s", function->name);
        node.kind = N_BUILTIN;
        node.index = i;
        size_t *argument[2] = {&node.left, &node.right};
        int args = function->f2 ? 2 : 1;
        for (int j = 0; j < args; j++) {
            lex_next(lx);
            if (!parse_sum(p, argument[j]))
                return false;
            if (lx->kind != (j + 1 < args ? T_COMMA : T_CLOSE))
                return lex_fail(lx, "%s takes %d argument%s", function->name, args, args > 1 ? "s" : "");
        }
        lex_next(lx);
        return add(p, node, out);
    }
    if (own) {
        node.kind = N_NUMBER;
        node.v = (value){3.14159265358979323846264338327950288L, DIM_NONE};
        lex_next(lx);
        return add(p, node, out);
    }
    if (calc_find_variable(p->c, word, len, &node.index)) {
        node.kind = N_VARIABLE;
        lex_next(lx);
        return add(p, node, out);
    }
    return unknown_name(p);
}

static bool parse_primary(parser *p, size_t *out) {
    lexer *lx = p->lx;
    if (lx->error->raised)
        return false;
    if (lx->kind == T_NUMBER) {
        expr_node node = {.kind = N_NUMBER, .at = lx->at, .v = {lx->number, DIM_NONE}};
        size_t at = lx->at, len = lx->len;
        unit u;
        lex_next(lx);
        if (unit_word(lx, &u)) {
            if (!unit_parse(lx, &u))
                return false;
            node.v = (value){scaled(lx, at, len, &u), u.d};
            if (!isfinite((double)node.v.v))
                return calc_fail(lx->error, at, lx->last - at,
                                 "the number is too large for double precision");
        }
        return !lx->error->raised && add(p, node, out);
    }
    if (lx->kind == T_OPEN) {
        lex_next(lx);
        if (!parse_sum(p, out))
            return false;
        if (lx->kind != T_CLOSE)
            return lx->error->raised ? false : lex_fail(lx, "expected )");
        lex_next(lx);
        return !lx->error->raised;
    }
    if (lx->kind == T_NAME)
        return parse_name(p, out) && !lx->error->raised;
    if (lx->kind == T_END)
        return lex_fail(lx, "expected a value here");
    return lex_fail(lx, "expected a value, not '%.*s'", (int)(lx->len < 40 ? lx->len : 40),
                    lx->text + lx->at);
}

static bool parse_unary(parser *p, size_t *out);

static bool parse_power(parser *p, size_t *out) {
    expr_node node = {.kind = N_BINARY, .op = '^', .at = p->lx->at};
    if (!parse_primary(p, &node.left))
        return false;
    *out = node.left;
    if (p->lx->kind != T_POWER)
        return true;
    lex_next(p->lx);
    return parse_unary(p, &node.right) && add(p, node, out);
}

static bool parse_unary(parser *p, size_t *out) {
    bool ok;
    if (++p->depth > DEPTH_LIMIT)
        return lex_fail(p->lx, "the expression is nested too deeply");
    if (p->lx->kind == T_MINUS || p->lx->kind == T_PLUS) {
        bool minus = p->lx->kind == T_MINUS;
        expr_node node = {.kind = N_NEGATE, .at = p->lx->at};
        lex_next(p->lx);
        ok = parse_unary(p, &node.left);
        *out = node.left;
        if (ok && minus)
            ok = add(p, node, out);
    } else {
        ok = parse_power(p, out);
    }
    p->depth--;
    return ok;
}

static bool parse_product(parser *p, size_t *out) {
    size_t at = p->lx->at;
    if (!parse_unary(p, out))
        return false;
    while (p->lx->kind == T_TIMES || p->lx->kind == T_DIVIDE) {
        expr_node node = {.kind = N_BINARY, .op = (char)p->lx->kind, .at = at, .left = *out};
        lex_next(p->lx);
        if (!parse_unary(p, &node.right) || !add(p, node, out))
            return false;
    }
    return true;
}

static bool parse_sum(parser *p, size_t *out) {
    size_t at = p->lx->at;
    if (!parse_product(p, out))
        return false;
    while (p->lx->kind == T_PLUS || p->lx->kind == T_MINUS) {
        expr_node node = {.kind = N_BINARY, .op = (char)p->lx->kind, .at = at, .left = *out};
        lex_next(p->lx);
        if (!parse_product(p, &node.right) || !add(p, node, out))
            return false;
    }
    return true;
}

bool expr_parse(const calc *c, lexer *lx, expr *e) {
    parser p = {.c = c, .lx = lx, .e = e};
    size_t root;
    e->count = 0;
    e->text = lx->text;
    e->at = lx->at;
    if (!parse_sum(&p, &root) || lx->error->raised)
        return false;
    /* the root must be last: a parenthesised expression adds no node of its own, and need not */
    e->len = lx->last - e->at;
    return true;
}

void expr_free(expr *e) {
    free(e->nodes);
    *e = (expr){0};
}
