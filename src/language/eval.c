/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Evaluates expressions. Uses `scene`, `text` and `number`. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "language/over.h"
#include "language/tree.h"

typedef struct machine {
    calc *c;
    const expr *e;
    calc_error *error;
    const value *arguments; /* arguments of the user's function */
    bool dry;               /* dimensions only: missing values count as 1 */
    const dim *want;        /* wanted dimension of the whole; NULL: any */
    bool unit_in_divisor;   /* 1/2 mm is 1/(2 mm) */
} machine;

static bool run_nodes(machine *m, value *out);

/* ---- errors ------------------------------------------------------------------------------------ */

/* A dry run reports wrong dimensions only. */
#define bad_value(m, n, ...) ((m)->dry || calc_fail((m)->error, (n)->at, (n)->len, __VA_ARGS__))

static bool dims_differ(machine *m, const expr_node *n, const char *verb, const expr_node *a, dim da,
                        const char *link, const expr_node *b, dim db) {
    char first[128], second[128];
    dim_describe(da, first, sizeof first);
    dim_describe(db, second, sizeof second);
    m->error->strange = true;
    return calc_fail(m->error, n->at, n->len, "cannot %s %s (%.*s) %s %s (%.*s)", verb, first,
                     LEX_SHOWN(a->len), m->e->text + a->at, link, second, LEX_SHOWN(b->len),
                     m->e->text + b->at);
}

static bool dim_wrong(machine *m, const expr_node *n, dim d, const char *wants) {
    char phrase[128];
    dim_describe(d, phrase, sizeof phrase);
    m->error->strange = true;
    return calc_fail(m->error, n->at, n->len, "%s, not %s (%.*s)", wants, phrase, LEX_SHOWN(n->len),
                     m->e->text + n->at);
}

/* ---- operators and elementary functions -------------------------------------------------------- */

static bool is_bare_zero(const expr_node *n, value v) {
    return n->kind == N_NUMBER && v.v == 0 && dim_equal(v.d, DIM_NONE);
}

static bool binary(machine *m, const expr_node *n, value *out) {
    const expr_node *l = &m->e->nodes[n->left], *r = &m->e->nodes[n->right];
    value a = l->v, b = r->v;
    switch (n->op) {
    case '+':
    case '-':
        out->v = n->op == '+' ? a.v + b.v : a.v - b.v;
        if (!dim_equal(a.d, b.d)) {
            if (is_bare_zero(r, b))
                b.d = a.d;
            else if (is_bare_zero(l, a))
                a.d = b.d;
            else
                return dims_differ(m, n, n->op == '+' ? "add" : "subtract", r, b.d,
                                   n->op == '+' ? "to" : "from", l, a.d);
        }
        out->d = a.d.rad != 0 ? a.d : b.d;
        break;
    case '*':
        out->v = a.v * b.v;
        out->d = dim_product(a.d, b.d);
        break;
    case 'U':
    case '?':
        if (!dim_equal(a.d, DIM_NONE) || a.d.rad != 0)
            return dim_wrong(m, l, a.d, "a unit must follow a number");
        *out = n->op == '?' && m->unit_in_divisor ? (value){a.v / b.v, dim_power(b.d, -1)}
                                                  : (value){a.v * b.v, b.d};
        break;
    case '/':
        out->v = a.v / b.v;
        if (b.v == 0 && !bad_value(m, r, "division by zero"))
            return false;
        out->d = dim_product(a.d, dim_power(b.d, -1));
        break;
    default:
        if (!dim_equal(b.d, DIM_NONE))
            return dim_wrong(m, r, b.d, "the exponent must be a number");
        out->v = powl(a.v, b.v);
        out->d = dim_power(a.d, (double)b.v);
        if (a.v < 0 && b.v != floorl(b.v))
            return bad_value(m, n, "a negative number has no real power %Lg", b.v);
        if (a.v == 0 && b.v < 0)
            return bad_value(m, l, "division by zero");
        break;
    }
    return true;
}

static bool call_builtin(machine *m, const expr_node *n, value *out) {
    const builtin *function = builtin_row(n->index);
    const expr_node *l = &m->e->nodes[n->left], *r = &m->e->nodes[n->right];
    value a = l->v, b = r->v;
    char wants[64];
    *out = (value){function->f2 ? function->f2(a.v, b.v) : function->f(a.v), DIM_NONE};
    switch (function->d) {
    case DIM_SHARED:
        out->d = a.d;
        if (!dim_equal(a.d, b.d))
            return dims_differ(m, n, "compare", l, a.d, "with", r, b.d);
        return true;
    case DIM_KEPT:
        out->d = a.d;
        return true;
    case DIM_HALVED:
        out->d = dim_power(a.d, 0.5);
        if (a.v < 0)
            return bad_value(m, l, "the square root of a negative number is not real");
        return true;
    default:
        break;
    }
    snprintf(wants, sizeof wants, "%s takes a number", function->name);
    if (!dim_equal(a.d, DIM_NONE))
        return dim_wrong(m, l, a.d, wants);
    if (function->f2 && !dim_equal(b.d, DIM_NONE))
        return dim_wrong(m, r, b.d, wants);
    if (function->d == DIM_TO_ANGLE)
        out->d = DIM_ANGLE;
    if (isnan(out->v) || (a.v == 0 && isinf(out->v)))
        return function->f2 ? bad_value(m, n, "beta needs two positive arguments in range")
                            : bad_value(m, n, "%s is not defined there", function->name);
    return true;
}

/* ---- names and changed scenes ------------------------------------------------------------------ */

/* The error of a circle: the chain of definitions from the one that recurs. */
static bool circle(calc *c, const char *label, calc_error *error) {
    char chain[CALC_ERROR_TEXT - 96] = ""; /* leaves room for the closing name */
    size_t from = c->chain_length - 1, n = 0;
    while (from > 0 && strcmp(c->chain[from]->label, label))
        from--;
    for (size_t i = from; i < c->chain_length; i++)
        n += chain_step(chain + n, sizeof chain - n, c->chain[i]->label, c->chain[i]->text);
    error->circle = true;
    return calc_fail(error, 0, 0, "a circle of definitions: %s%s", chain, label);
}

static bool enter(calc *c, const definition *d, calc_error *error) {
    for (size_t i = 0; i < c->chain_length; i++)
        if (c->chain[i] == d)
            return circle(c, d->label, error);
    error->strange = c->chain_length == CHAIN; /* no other value would help */
    if (error->strange)
        return calc_fail(error, 0, 0, "live definitions are nested more than %d deep", CHAIN);
    c->chain[c->chain_length++] = d;
    return true;
}

static bool evaluate_definition(calc *c, const definition *d, const value *arguments, bool dry, value *out,
                                calc_error *error) {
    calc_error mine;
    error_clear(&mine);
    machine m = {c, &d->body, &mine, arguments, dry, NULL, false};
    if (!enter(c, d, error))
        return false;
    bool ok = run_nodes(&m, out);
    if (!ok && mine.circle && mine.kind == ERROR_MISSING) { /* a circle through inputs */
        mine.raised = false;
        circle(c, quantity_of_input((input)mine.input)->name, &mine);
    }
    c->chain_length--;
    if (!ok) { /* places in the definition are none in the statement */
        *error = mine;
        error->at = error->len = 0;
    }
    return ok;
}

bool definition_value(calc *c, definition *d, value *out, calc_error *error) {
    return evaluate_definition(c, d, NULL, false, out, error);
}

static bool own_value(machine *m, const expr_node *n, value *out) {
    const own_name *row = &m->c->names.row[n->index];
    if (!row->definition) {
        *out = row->v;
        return true;
    }
    const definition *d = (const definition *)row->definition;
    if (d->parameters)
        return calc_fail(m->error, n->at, n->len, "%s is a function: %s(%s%s)", d->label, d->label,
                         d->parameter[0], d->parameters > 1 ? ", ..." : "");
    return evaluate_definition(m->c, d, NULL, m->dry, out, m->error) || calc_place(m->error, n->at, n->len);
}

static bool apply(machine *m, const expr_node *n, value *out) {
    value arguments[PARAMETERS];
    const definition *d = (const definition *)m->c->names.row[n->index].definition;
    if (!d || d->parameters != n->right)
        return calc_fail(m->error, n->at, n->len, "%s is no function of %zu arguments any more",
                         m->c->names.row[n->index].text, n->right);
    for (size_t i = 0; i < n->right; i++)
        arguments[i] = m->e->nodes[m->e->arguments[n->left + i]].v;
    return evaluate_definition(m->c, d, arguments, m->dry, out, m->error) ||
           calc_place(m->error, n->at, n->len);
}

static bool dim_fits(machine *m, const expr *e, const knob *p, value v, dim want) {
    lexer at = {.text = e->text, .error = m->error};
    if (value_dim(&at, p->text, e->at, e->len, v, want))
        return true;
    m->error->strange = true;
    return false;
}

/* The new value of a name, evaluated outside the change; want: the dimension of an input, or none. */
static bool value_outside(const machine *m, const expr *e, const knob *p, dim *want, value *v) {
    machine outside = *m;
    *want = p->is_input ? quantity_dim(quantity_of_input(p->in), m->c->now) : DIM_NONE;
    outside.e = e;
    outside.want = p->is_input ? want : NULL;
    return run_nodes(&outside, v);
}

/* Opens a trial with the changes of `at`. All values are evaluated before any is set. NULL: an error. */
static trial *open_changed(machine *m, const expr_at *at) {
    knob_value by[CHANGES];
    size_t count = 0, wrong;
    for (size_t i = 0; i < at->count; i++) {
        const knob *p = &at->change[i].p;
        const expr *e = &at->change[i].value;
        dim want;
        value v;
        if (!value_outside(m, e, p, &want, &v))
            return NULL;
        want = p->is_input ? want : v.d;
        if (!dim_fits(m, e, p, v, want))
            return NULL;
        if (m->dry && p->is_input)
            continue;
        if (p->is_input && !calc_takes(m->c, p->in, m->error)) {
            calc_place(m->error, at->change[i].at, strlen(p->text));
            return NULL;
        }
        by[count] = (knob_value){*p, v.v};
        by[count++].p.d = want;
    }
    trial *t = trial_open(m->c, m->error);
    bool ok =
        t &&
        (trial_change(t, by, count, &wrong, m->error) ||
         (wrong < count && calc_place(m->error, at->change[wrong].value.at, at->change[wrong].value.len)));
    if (!ok)
        trial_close(t);
    return ok ? t : NULL;
}

static bool changed_value(machine *m, const expr_node *n, value *out) {
    trial *t = open_changed(m, n->changed);
    machine inside = *m;
    inside.e = &n->changed->body;
    const bool ok = t && run_nodes(&inside, out);
    trial_close(t);
    return ok || calc_place(m->error, n->at, n->len);
}

/* ---- over a range ------------------------------------------------------------------------------ */

/* Context of a range: its expression, in the machine around it. */
typedef struct over_body {
    machine m;
    over o;
} over_body;

static bool body_value(void *context, value *out) {
    over_body *b = context;
    b->m.error = b->o.error;
    return run_nodes(&b->m, out);
}

/* Evaluates both ends, of one dimension: that of the input, if the name is one. */
static bool range_ends(machine *m, const expr_at *at, knob *name, over *o) {
    value end[2];
    dim want;
    for (int i = 0; i < 2; i++)
        if (!value_outside(m, &at->change[i].value, name, &want, &end[i]))
            return false;
    const int tells = end[0].v == 0 && dim_equal(end[0].d, DIM_NONE); /* a bare 0 takes the other's */
    name->d = name->is_input ? want : end[tells].d;
    o->lo = end[0].v;
    o->hi = end[1].v;
    return dim_fits(m, &at->change[0].value, name, end[0], name->d) &&
           dim_fits(m, &at->change[1].value, name, end[1], name->d);
}

static bool over_times(over *o, along_what what) {
    double first, last;
    scene_look(&o->t->scene, NULL);
    const bool ok = trial_along_span(o->t, what, o->t->scene.end, &first, &last, o->error);
    o->lo = first;
    o->hi = last;
    return ok;
}

/* The dimension of the expression by a dry run, since an empty range has no value. */
static bool over_dim(over_body *b, calc_error *error) {
    over *o = &b->o;
    size_t wrong;
    value v;
    const bool dry = b->m.dry;
    b->m.dry = true;
    o->error = error;
    const bool ok = (!o->name || o->name->is_input ||
                     trial_change(o->t, &(knob_value){*o->name, o->lo}, 1, &wrong, error)) &&
                    body_value(b, &v);
    b->m.dry = dry;
    if (ok)
        o->d = v.d;
    return ok;
}

static bool over_run(machine *m, const expr_node *n, over_body *b, value *out) {
    const char *word = builtin_row(n->index)->name;
    over *o = &b->o;
    long double error = 0;
    *out = (value){1, DIM_NONE};
    if (m->dry)
        return over_dim(b, m->error);
    over_dim(b, error_quiet());
    o->error = m->error;
    if (!o->name && !over_times(o, n->changed->what))
        return false;
    const bool ok =
        *word == 'i' ? over_integral(o, &out->v, &error) : over_extreme(o, word[1] == 'a', &out->v);
    m->c->over_error = fmax(m->c->over_error, (double)error);
    return ok;
}

static bool over_value(machine *m, const expr_node *n, value *out) {
    enum { DEEPEST = 8 }; /* each uses stack, and evaluates the inner one hundreds of times */
    const expr_at *at = n->changed;
    knob name = at->change[0].p;
    over_body b = {
        .m = *m,
        .o = {.name = at->along ? NULL : &name, .context = &b, .value = body_value, .error = m->error}};
    b.m.e = &at->body;
    b.m.want = NULL;
    if (m->c->over_depth == DEEPEST)
        return calc_fail(m->error, n->at, n->len, "ranges are nested more than %d deep", DEEPEST);
    m->c->over_depth++;
    bool ok = at->along || range_ends(m, at, &name, &b.o);
    b.o.t = ok ? trial_open(m->c, m->error) : NULL;
    ok = b.o.t && over_run(m, n, &b, out);
    trial_close(b.o.t);
    m->c->over_depth--;
    out->d = *builtin_row(n->index)->name == 'i' ? dim_product(b.o.d, name.d) : b.o.d;
    return ok || calc_place(m->error, n->at, n->len);
}

/* ---- nodes ------------------------------------------------------------------------------------- */

/* Records that a quantity that depends on friction was asked for. */
static void mark_asked(const calc *c, const quantity *q) {
    if (q->reads & INPUT_BIT(IN_MU) && !quantity_is_input(q))
        c->now->used |= ASKED_TANGENTIAL;
}

static bool takes(const quantity *q, dim d) {
    return dim_equal(d, q->argument_d) ||
           (!dim_equal(q->argument_or, DIM_NONE) && dim_equal(d, q->argument_or));
}

static bool call_quantity(machine *m, const expr_node *n, value *out) {
    value arg[PARAMETERS];
    char wants[192], phrase[128];
    for (size_t i = 0; i < n->right; i++) {
        const expr_node *a = &m->e->nodes[m->e->arguments[n->left + i]];
        arg[i] = a->v;
        if (takes(n->q, a->v.d) || is_bare_zero(a, a->v))
            continue;
        dim_describe(n->q->argument_d, phrase, sizeof phrase);
        snprintf(wants, sizeof wants, "%s(%s) takes %s%s", n->q->name, n->q->argument, phrase,
                 n->right > 1 ? " each" : "");
        return dim_wrong(m, a, a->v.d, wants);
    }
    *out = (value){1, n->q->d};
    if (m->dry)
        return true;
    mark_asked(m->c, n->q);
    return quantity_call(n->q, m->c->now, arg, &out->v, m->error) || calc_place(m->error, n->at, n->len);
}

static bool eval(machine *m, const expr_node *n, value *out) {
    switch ((node_kind)n->kind) {
    case N_NUMBER:
        return true;
    case N_NAME:
        return own_value(m, n, out);
    case N_PARAMETER:
        *out = m->arguments[n->index];
        return true;
    case N_ANS:
        *out = m->c->ans;
        return m->c->has_ans || calc_fail(m->error, n->at, n->len, "nothing has been printed yet");
    case N_NEGATE:
        out->d = m->e->nodes[n->left].v.d;
        out->v = -m->e->nodes[n->left].v.v;
        return true;
    case N_QUANTITY:
        *out = (value){1, quantity_dim(n->q, m->c->now)};
        if (!m->dry)
            mark_asked(m->c, n->q);
        if (!m->dry && !quantity_get(n->q, m->c->now, &out->v, m->error))
            return calc_place(m->error, n->at, n->len);
        out->d = quantity_dim(n->q, m->c->now); /* again: that of A may follow a live n */
        break;
    case N_CALL:
        if (!call_quantity(m, n, out))
            return false;
        break;
    case N_APPLY:
        return apply(m, n, out);
    case N_AT:
        return changed_value(m, n, out);
    case N_OVER:
        if (!over_value(m, n, out))
            return false;
        break;
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

/* Replaces an error of values by a mismatch of dimensions, unless an exponent decides them but is unknown. */
static void prefer_mismatch(const machine *m) {
    calc_error mismatch;
    error_clear(&mismatch);
    machine dry = *m;
    dry.error = &mismatch;
    dry.dry = true;
    for (size_t i = 0; i < m->e->count; i++) {
        const expr_node *n = &m->e->nodes[i];
        if (n->kind == N_BINARY && n->op == '^' && m->e->nodes[n->right].kind != N_NUMBER)
            return;
        if (!eval(&dry, n, &m->e->nodes[i].v)) {
            if (mismatch.strange)
                *m->error = mismatch;
            return;
        }
    }
}

/* A loop, since children come before their parents: no input can exhaust the stack. */
static bool run_read(machine *m, value *out) {
    for (size_t i = 0; i < m->e->count; i++)
        if (!eval(m, &m->e->nodes[i], &m->e->nodes[i].v)) {
            if (!m->dry && !m->error->stop && !m->error->circle)
                prefer_mismatch(m);
            return false;
        }
    *out = m->e->nodes[m->e->count - 1].v;
    return true;
}

static bool two_readings(machine *m, const expr_node *n) {
    const char *text = m->e->text + n->at;
    const size_t divisor = m->e->nodes[n->left].index + 1 - n->at, len = n->len;
    size_t numbers = n->index - n->at;
    while (text[numbers - 1] == ' ')
        numbers--;
    m->error->strange = true;
    return calc_fail(m->error, n->at, len, "%.*s is ambiguous: write (%.*s) %.*s, or %.*s(%.*s)",
                     LEX_SHOWN(len), text, LEX_SHOWN(numbers), text, LEX_SHOWN(len - (n->index - n->at)),
                     m->e->text + n->index, LEX_SHOWN(divisor), text, LEX_SHOWN(len - divisor),
                     text + divisor);
}

/* Chooses between the two readings of a number divided by a number with a unit by their dimensions. */
static bool choose_reading(machine *m) {
    const expr_node *n = m->e->nodes, *end = n + m->e->count;
    bool holds[2] = {false, false};
    while (n < end && !(n->kind == N_BINARY && n->op == '?'))
        n++;
    for (int i = 0; i < 2 && n < end; i++) {
        machine probe = *m;
        value v;
        probe.error = error_quiet();
        probe.dry = true;
        probe.unit_in_divisor = i;
        holds[i] =
            run_read(&probe, &v) && (!m->want || (dim_equal(v.d, *m->want) && v.d.rad == m->want->rad));
    }
    m->unit_in_divisor = holds[1];
    return !(holds[0] && holds[1]) || two_readings(m, n);
}

static bool run_nodes(machine *m, value *out) {
    return (!m->e->unclear || choose_reading(m)) && run_read(m, out);
}

bool expr_eval(calc *c, const expr *e, value *out, calc_error *error) {
    return expr_eval_as(c, e, NULL, out, error);
}

bool expr_eval_as(calc *c, const expr *e, const dim *want, value *out, calc_error *error) {
    machine m = {c, e, error, NULL, false, want, false};
    const bool ok = run_nodes(&m, out);
    return !calc_stopped(c->scene.stop, error) && ok;
}

bool expr_changed(calc *c, const expr *e, trial **t, const expr **body, calc_error *error) {
    const expr_node *root = &e->nodes[e->count - 1];
    machine m = {c, e, error, NULL, false, NULL, false};
    *t = NULL;
    *body = e;
    if (root->kind != N_AT)
        return true;
    *t = open_changed(&m, root->changed);
    *body = &root->changed->body;
    return *t || calc_place(error, root->at, root->len);
}

bool expr_dim(calc *c, const expr *e, dim *d) {
    value v;
    machine m = {c, e, error_quiet(), NULL, true, NULL, false};
    if (!run_nodes(&m, &v) || isnan(v.d.N + v.d.m + v.d.s)) /* a power with an exponent without a value */
        return false;
    *d = v.d;
    return true;
}

bool expr_value(calc *c, lexer *lx, value *out) {
    return expr_value_as(c, lx, NULL, out);
}

bool expr_value_as(calc *c, lexer *lx, const dim *want, value *out) {
    return expr_parse(c, lx, &c->scratch) && !expr_stray_unit(lx, c->keyword) &&
           expr_eval_as(c, &c->scratch, want, out, lx->error);
}
