/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The values of expressions: of one, or of a block of rows at once. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "calc/tree.h"
#include "number/real.h"

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
        return builtin_row(n->index)->f2 ? builtin_row(n->index)->f2(a, b) : builtin_row(n->index)->f(a);
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

static bool call_builtin(machine *m, const expr_node *n, value *out) {
    const char *name = builtin_row(n->index)->name;
    const expr_node *l = &m->e->nodes[n->left], *r = &m->e->nodes[n->right];
    value a = l->v, b = r->v;
    bool two = builtin_row(n->index)->f2;
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
        if (!call_builtin(m, n, out))
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
        size_t takes = node_operands(n);
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
