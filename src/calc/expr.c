/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "contact/dd.h"

#include "calc/expr.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DEPTH_LIMIT = 200 }; /* of nesting: the parser and the evaluator recurse */

typedef enum node_kind {
    N_NUMBER,
    N_QUANTITY,
    N_CALL,
    N_VARIABLE,
    N_SWEEP,
    N_NEGATE,
    N_BINARY,
    N_BUILTIN
} node_kind;

struct expr_node {
    node_kind kind;
    char op;
    size_t at, len; /* place in the statement */
    size_t left, right;
    size_t index; /* of a variable, sweep name or builtin */
    bool varies;  /* with the first name of a sweep */
    const quantity *q;
    value v;
};

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

/* ---- elementary functions ---------------------------------------------------------------------- */

/* Functions with the same digits under every mathematical library. */

static long double real_tan(long double x) {
    return fret_sin(x) / fret_cos(x);
}

static long double real_atan(long double x) {
    return fret_atan2(x, 1);
}

static long double real_asin(long double x) {
    return fret_atan2(x, sqrtl((1 - x) * (1 + x)));
}

static long double real_acos(long double x) {
    return fret_atan2(sqrtl((1 - x) * (1 + x)), x);
}

static long double real_beta(long double x, long double y) {
    long double b = x > 0 && y > 0 ? fret_beta(x, y) : 0;
    return (double)b > 0 ? b : (long double)NAN;
}

typedef long double unary(long double);
typedef long double two_place(long double, long double);

static const struct {
    const char *name;
    unary *f;
    two_place *f2; /* one of both */
    const char *summary;
} builtins[] = {
    {"sqrt", sqrtl, NULL, "square root; halves the dimension"},
    {"exp", fret_exp, NULL, "exponential"},
    {"log", fret_log, NULL, "natural logarithm"},
    {"log10", fret_log10, NULL, "decimal logarithm"},
    {"sin", fret_sin, NULL, "sine of an angle"},
    {"cos", fret_cos, NULL, "cosine of an angle"},
    {"tan", real_tan, NULL, "tangent of an angle"},
    {"asin", real_asin, NULL, "arc sine"},
    {"acos", real_acos, NULL, "arc cosine"},
    {"atan", real_atan, NULL, "arc tangent"},
    {"abs", fabsl, NULL, "magnitude; keeps the dimension"},
    {"gamma", fret_gamma, NULL, "gamma function"},
    {"min", NULL, fminl, "the smaller of two"},
    {"max", NULL, fmaxl, "the larger of two"},
    {"beta", NULL, real_beta, "beta function B(x,y), x, y > 0"},
};
enum { BUILTINS = sizeof builtins / sizeof *builtins };

const char *builtin_name(size_t i) {
    return i < BUILTINS ? builtins[i].name : i == BUILTINS ? "pi" : NULL;
}

/* BUILTINS stands for pi. */
static bool find_builtin(const char *name, size_t len, size_t *i) {
    static word_index words = {.name = builtin_name};
    return word_find(&words, name, len, i);
}

const char *builtin_summary(size_t i) {
    return i < BUILTINS ? builtins[i].summary : "3.14159...";
}

const char *name_taken(const char *name, size_t len) {
    unit u;
    if (quantity_find(name, len))
        return "a quantity";
    if (unit_lookup(name, len, &u))
        return "a unit";
    size_t i;
    return find_builtin(name, len, &i) ? i == BUILTINS ? "a constant" : "a function" : NULL;
}

/* ---- parser ------------------------------------------------------------------------------------ */

typedef struct parser {
    const calc *c;
    lexer *lx;
    expr *e;
    int depth;
} parser;

static size_t operands(const expr_node *n) {
    switch (n->kind) {
    case N_BINARY:
        return 2;
    case N_BUILTIN:
        return builtins[n->index].f2 ? 2 : 1;
    case N_CALL:
    case N_NEGATE:
        return 1;
    default:
        return 0;
    }
}

static bool add(parser *p, expr_node node, size_t *index) {
    expr *e = p->e;
    size_t takes = operands(&node);
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
    bool own = find_builtin(word, len, &i);
    if (own && i < BUILTINS) {
        lex_next(lx);
        if (lx->kind != T_OPEN)
            return lex_fail(lx, "expected ( after %s", builtins[i].name);
        node.kind = N_BUILTIN;
        node.index = i;
        size_t *argument[2] = {&node.left, &node.right};
        int args = builtins[i].f2 ? 2 : 1;
        for (int j = 0; j < args; j++) {
            lex_next(lx);
            if (!parse_sum(p, argument[j]))
                return false;
            if (lx->kind != (j + 1 < args ? T_COMMA : T_CLOSE))
                return lex_fail(lx, "%s takes %d argument%s", builtins[i].name, args, args > 1 ? "s" : "");
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

/* ---- evaluation -------------------------------------------------------------------------------- */

typedef struct machine {
    calc *c;
    const expr *e;
    calc_error *error;
    bool dry; /* dimensions alone: values that cannot be had count as 1 */
} machine;

/* In a dry run only dimensions can be wrong. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
static bool
bad_value(machine *m, const expr_node *n, const char *format, ...) {
    if (m->dry)
        return true;
    va_list args;
    va_start(args, format);
    char text[256];
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    return calc_fail(m->error, n->at, n->len, "%s", text);
}

/* An error raised without a place gets that of the node. */
static bool placed(machine *m, const expr_node *n) {
    if (m->error->len == 0) {
        m->error->at = n->at;
        m->error->len = n->len;
    }
    return false;
}

static bool dims_differ(machine *m, const expr_node *n, const char *verb, const expr_node *a, dim da,
                        const char *link, const expr_node *b, dim db) {
    char first[128], second[128];
    dim_describe(da, first, sizeof first);
    dim_describe(db, second, sizeof second);
    return calc_fail(m->error, n->at, n->len, "cannot %s %s (%.*s) %s %s (%.*s)", verb, first,
                     (int)(a->len < 60 ? a->len : 60), m->e->text + a->at, link, second,
                     (int)(b->len < 60 ? b->len : 60), m->e->text + b->at);
}

/* The numbers alone; where they are not defined, they are not finite. */
static long double real_value(const expr_node *n, long double a, long double b) {
    if (n->kind == N_NEGATE)
        return -a;
    if (n->kind == N_BUILTIN)
        return builtins[n->index].f2 ? builtins[n->index].f2(a, b) : builtins[n->index].f(a);
    switch (n->op) {
    case '+':
        return a + b;
    case '-':
        return a - b;
    case '*':
        return a * b;
    case '/':
        return a / b;
    default:
        return fret_pow(a, b);
    }
}

static bool binary(machine *m, const expr_node *n, value *out) {
    const expr_node *l = &m->e->nodes[n->left], *r = &m->e->nodes[n->right];
    value a = l->v, b = r->v;
    out->v = real_value(n, a.v, b.v);
    switch (n->op) {
    case '+':
    case '-':
        /* a bare 0 has every dimension */
        if (!dim_equal(a.d, b.d)) {
            if (r->kind == N_NUMBER && b.v == 0 && dim_equal(b.d, DIM_NONE))
                b.d = a.d;
            else if (l->kind == N_NUMBER && a.v == 0 && dim_equal(a.d, DIM_NONE))
                a.d = b.d;
            else
                return dims_differ(m, n, n->op == '+' ? "add" : "subtract", r, b.d,
                                   n->op == '+' ? "to" : "from", l, a.d);
        }
        out->d = a.d;
        break;
    case '*':
        out->d = (dim){a.d.N + b.d.N, a.d.m + b.d.m};
        break;
    case '/':
        if (b.v == 0 && !bad_value(m, r, "division by zero"))
            return false;
        out->d = (dim){a.d.N - b.d.N, a.d.m - b.d.m};
        break;
    default:
        if (!dim_equal(b.d, DIM_NONE)) {
            char phrase[128];
            dim_describe(b.d, phrase, sizeof phrase);
            return calc_fail(m->error, r->at, r->len, "the exponent must be a number, not %s (%.*s)", phrase,
                             (int)(r->len < 60 ? r->len : 60), m->e->text + r->at);
        }
        out->d = (dim){a.d.N * (double)b.v, a.d.m * (double)b.v};
        if (a.v < 0 && b.v != floorl(b.v))
            return bad_value(m, n, "a negative number has no real power %Lg", b.v);
        break;
    }
    return true;
}

static bool builtin(machine *m, const expr_node *n, value *out) {
    const char *name = builtins[n->index].name;
    const expr_node *l = &m->e->nodes[n->left], *r = &m->e->nodes[n->right];
    value a = l->v, b = r->v;
    bool two = builtins[n->index].f2;
    *out = (value){real_value(n, a.v, b.v), DIM_NONE};
    if (!strcmp(name, "min") || !strcmp(name, "max")) {
        out->d = a.d;
        return dim_equal(a.d, b.d) || dims_differ(m, n, "compare", l, a.d, "with", r, b.d);
    }
    if (!strcmp(name, "abs") || !strcmp(name, "sqrt")) {
        double f = *name == 's' ? 0.5 : 1;
        out->d = (dim){a.d.N * f, a.d.m * f};
        return !(*name == 's' && a.v < 0) ||
               bad_value(m, l, "the square root of a negative number is not real");
    }
    for (int j = 0; j < 1 + two; j++) {
        const expr_node *x = j ? r : l;
        dim d = j ? b.d : a.d;
        if (!dim_equal(d, DIM_NONE)) {
            char phrase[128];
            dim_describe(d, phrase, sizeof phrase);
            return calc_fail(m->error, x->at, x->len, "%s takes a number, not %s (%.*s)", name, phrase,
                             (int)(x->len < 60 ? x->len : 60), m->e->text + x->at);
        }
    }
    if (isnan(out->v))
        return two ? bad_value(m, n, "beta needs two positive arguments in range")
                   : bad_value(m, n, "%s is not defined there", name);
    return true;
}

static bool eval(machine *m, const expr_node *n, value *out) {
    switch (n->kind) {
    case N_NUMBER:
        return true;
    case N_VARIABLE:
        *out = m->c->variables[n->index].v;
        return true;
    case N_SWEEP:
        *out = m->c->sweep_value[n->index];
        return true;
    case N_NEGATE:
        out->d = m->e->nodes[n->left].v.d;
        out->v = real_value(n, m->e->nodes[n->left].v.v, 0);
        return true;
    case N_QUANTITY:
        out->d = quantity_dim(n->q, &m->c->scene);
        out->v = 1;
        if (m->dry)
            return true;
        if (n->q->get ? n->q->get(&m->c->scene, &out->v, m->error)
                      : scene_get(&m->c->scene, (input)n->q->in, &out->v, m->error))
            return true;
        return placed(m, n);
    case N_CALL: {
        const expr_node *a = &m->e->nodes[n->left];
        value arg = a->v;
        if (!dim_equal(arg.d, n->q->argument_d) && !(arg.v == 0 && a->kind == N_NUMBER)) {
            char want[128], got[128];
            dim_describe(n->q->argument_d, want, sizeof want);
            dim_describe(arg.d, got, sizeof got);
            return calc_fail(m->error, a->at, a->len, "%s(%s) takes %s, not %s (%.*s)", n->q->name,
                             n->q->argument, want, got, (int)(a->len < 60 ? a->len : 60), m->e->text + a->at);
        }
        out->d = n->q->d;
        out->v = 1;
        return m->dry || n->q->call(&m->c->scene, arg, &out->v, m->error) || placed(m, n);
    }
    case N_BUILTIN:
        if (!builtin(m, n, out))
            return false;
        break;
    case N_BINARY:
        if (!binary(m, n, out))
            return false;
        break;
    }
    return isfinite((double)out->v) || bad_value(m, n, "the result is too large for double precision");
}

/* A mismatch of dimensions is the deeper error: it is reported even where a value is still missing. Not
 * where an exponent is unknown, on which dimensions depend. */
static void prefer_mismatch(calc *c, const expr *e, calc_error *error) {
    calc_error mismatch = {0};
    machine m = {c, e, &mismatch, true};
    for (size_t i = 0; i < e->count; i++) {
        const expr_node *n = &e->nodes[i];
        if (n->kind == N_BINARY && n->op == '^' && e->nodes[n->right].kind != N_NUMBER)
            return;
        if (!eval(&m, n, &e->nodes[i].v)) {
            *error = mismatch;
            return;
        }
    }
}

bool expr_eval(calc *c, const expr *e, value *out, calc_error *error) {
    machine m = {c, e, error, false};
    /* children come before their parents: a loop, so that no input can exhaust the stack */
    for (size_t i = 0; i < e->count; i++)
        if (!eval(&m, &e->nodes[i], &e->nodes[i].v)) {
            if (!error->stop)
                prefer_mismatch(c, e, error);
            return false;
        }
    *out = e->nodes[e->count - 1].v;
    return true;
}

/* ---- a block of rows ---------------------------------------------------------------------------- */

/* A value at every row, or one for all of them: stride 0. */
typedef struct operand {
    const long double *v;
    size_t stride;
} operand;

static bool call_block(calc *c, const quantity *q, operand a, dim d, size_t rows, long double *out) {
    calc_error unused = {0};
    if (q->block) {
        double argument[EXPR_BLOCK], result[EXPR_BLOCK];
        for (size_t i = 0; i < rows; i++)
            argument[i] = (double)a.v[i];
        if (!q->block(&c->scene, argument, result, rows, &unused))
            return false;
        for (size_t i = 0; i < rows; i++)
            out[i] = result[i];
        return true;
    }
    for (size_t i = 0; i < rows; i++)
        if ((c->scene.stop && *c->scene.stop) || !q->call(&c->scene, (value){a.v[i], d}, &out[i], &unused))
            return false;
    return true;
}

/* Children come before their parents, the left before the right: a stack machine. Dimensions, and what does
 * not vary, are those of the first row. */
bool expr_eval_block(calc *c, const expr *e, const long double x[], size_t rows, long double out[], dim *d) {
    enum { DEEPEST = 16 };
    long double column[DEEPEST][EXPR_BLOCK];
    operand stack[DEEPEST] = {{NULL, 0}};
    size_t depth = 0;
    value first;
    calc_error unused = {0};
    c->sweep_value[0].v = x[0];
    if (!expr_eval(c, e, &first, &unused))
        return false;
    for (size_t j = 0; j < e->count; j++) {
        const expr_node *n = &e->nodes[j], *l = &e->nodes[n->left];
        size_t takes = operands(n);
        bool finite = true;
        depth -= takes;
        if (depth == DEEPEST)
            return false;
        operand *top = &stack[depth], a = *top, b = takes > 1 ? top[1] : a;
        long double *to = column[depth++];
        if (!n->varies) {
            *top = (operand){&n->v.v, 0};
            continue;
        }
        if (n->kind == N_SWEEP) {
            *top = (operand){x, 1};
            continue;
        }
        /* the dimension may vary too */
        if (n->op == '^' && e->nodes[n->right].varies && !dim_equal(l->v.d, DIM_NONE))
            return false;
        if (n->kind == N_CALL) {
            if (!call_block(c, n->q, a, l->v.d, rows, to))
                return false;
        } else {
            for (size_t i = 0; i < rows; i++) {
                to[i] = real_value(n, a.v[i * a.stride], b.v[i * b.stride]);
                finite = finite && isfinite((double)to[i]);
            }
        }
        if (!finite)
            return false;
        *top = (operand){to, 1};
    }
    for (size_t i = 0; i < rows; i++)
        out[i] = stack[0].v[i * stack[0].stride];
    *d = first.d;
    return true;
}

bool expr_value(calc *c, lexer *lx, value *out) {
    return expr_parse(c, lx, &c->scratch) && expr_eval(c, &c->scratch, out, lx->error);
}
