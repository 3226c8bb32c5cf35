/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The session: its life, and assignments. Uses `scene` and `text`. */
#include "language/calc.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- life -------------------------------------------------------------------------------------- */

/* Has the value of a definition the input's dimension? Names in it may have changed theirs. */
static bool has_dim(scene *s, input in, const definition *d, const value *v, calc_error *error) {
    const quantity *q = quantity_of_input(in);
    long double n;
    lexer text = {.text = d->text, .error = error};
    if (in == IN_A && s->in.bindings & INPUT_BIT(IN_N) && !scene_get(s, IN_N, &n, error))
        return false;
    error->strange = !value_dim(&text, q->name, 0, strlen(d->text), *v, quantity_dim(q, s));
    if (!error->strange)
        return true;
    error->at = error->len = 0; /* places in the definition are none in the statement */
    return false;
}

/* The callback scene_definition: evaluates the definition that an input is bound to. */
static bool evaluate(void *context, scene *s, input in, counted *bound, value *out, calc_error *error) {
    calc *c = context;
    scene *outer = c->now;
    definition *d = (definition *)bound;
    c->now = s;
    const bool ok = definition_value(c, d, out, error) && has_dim(s, in, d, out, error);
    c->now = outer;
    return ok;
}

void calc_init(calc *c, const volatile sig_atomic_t *stop) {
    *c = (calc){.now = &c->scene};
    scene_init(&c->scene, stop, evaluate, c);
}

void calc_free(calc *c) {
    while (c->undo.count > 0)
        undo_pop(c, false);
    free(c->undo.entry);
    names_free(&c->names);
    expr_free(&c->scratch);
    scene_free(&c->scene);
    c->undo = (undo){.entry = NULL};
}

void calc_answered(calc *c, value v) {
    c->ans = v;
    c->has_ans = true;
}

/* ---- assignments ------------------------------------------------------------------------------- */

enum { ASSIGNMENTS = 16 };

/* One of `NAME = EXPR, ...`. */
typedef struct assignment {
    const quantity *q; /* an input; NULL: a user's name */
    bool known;        /* that name exists, with index `own` */
    size_t own;
    size_t at, len; /* of the name */
    size_t value_at, value_len;
    bool increment, live;
    value v;
    definition *d; /* a live definition or a function */
} assignment;

/* Is it NAME(X, ...) = or NAME(X, ...) :=? */
static bool is_function(const lexer *lx) {
    lexer scan = *lx;
    scan.error = error_quiet();
    for (lex_next(&scan); scan.kind == T_OPEN || scan.kind == T_COMMA;) {
        lex_next(&scan);
        if (scan.kind != T_NAME)
            return false;
        lex_next(&scan);
    }
    if (scan.kind != T_CLOSE)
        return false;
    const token_kind then = lex_peek(&scan);
    return then == T_ASSIGN || then == T_DEFINE;
}

bool assign_at(const lexer *lx) {
    return lex_assigns(lx) || (lx->kind == T_NAME && lex_peek(lx) == T_OPEN && is_function(lx));
}

/* The error for an assignment to a result, with the command that imposes it. */
static bool is_result(lexer *lx, const quantity *q) {
    if (!quantity_has_value(q))
        return lex_fail(lx, "%s is a function of the scene: %s", q->name, q->title);
    if (!q->imposed)
        return lex_fail(lx, "%s is a result: it follows from the inputs and the load", q->name);
    return lex_fail(lx, "%s is a result: it follows from the inputs and the load; try: %s %s=...", q->name,
                    q->imposed, q->name);
}

static bool name_allowed(calc *c, lexer *lx, assignment *a) {
    const char *text = lx->text + lx->at;
    a->known = names_find(&c->names, text, lx->len, &a->own);
    if (a->known) /* checked when it was new */
        return true;
    const char *taken = name_taken(text, lx->len);
    a->q = quantity_find(text, lx->len);
    if (a->q && !quantity_is_input(a->q) && !strcmp(a->q->name, "E"))
        return lex_fail(lx, "E(z) is the modulus at a depth; the input is E0");
    if (a->q &&
        (!quantity_is_input(a->q) || (a->q->imposed && !calc_takes(c, quantity_input(a->q), error_quiet()))))
        return is_result(lx, a->q);
    if (!a->q && taken)
        return lex_fail(lx, "'%.*s' is %s: it cannot be a variable", LEX_WORD(lx), taken);
    return !a->q || calc_takes(c, quantity_input(a->q), lx->error); /* read_assignment places the error */
}

static bool read_parameters(lexer *lx, char (*parameter)[LEX_NAME], unsigned *count) {
    *count = 0;
    if (lx->kind != T_OPEN)
        return true;
    do {
        lex_next(lx);
        if (*count == PARAMETERS)
            return lex_fail(lx, "a function takes at most %d arguments", PARAMETERS);
        const char *taken = name_taken(lx->text + lx->at, lx->len);
        if (taken)
            return lex_fail(lx, "'%.*s' is %s: it cannot be an argument's name", LEX_WORD(lx), taken);
        if (!lex_whole(lx, "an argument's name", parameter[(*count)++]))
            return false;
        for (unsigned i = 0; i + 1 < *count; i++)
            if (lex_is(lx, parameter[i]))
                return lex_fail(lx, "%s is given twice", parameter[i]);
        lex_next(lx);
    } while (lx->kind == T_COMMA);
    lex_next(lx); /* the closing parenthesis: assign_at has checked */
    return true;
}

/* The assignment to an input, or NULL. */
static const assignment *of_input(const assignment *all, size_t count, input in) {
    for (; count > 0; all++, count--)
        if (all->q && quantity_input(all->q) == in)
            return all;
    return NULL;
}

/* The dimension that an input must have; that of A depends on n, which may be assigned beside it. */
static dim wanted_dim(const calc *c, const quantity *q, const assignment *all, size_t count) {
    dim d = quantity_dim(q, &c->scene);
    const assignment *n = quantity_input(q) == IN_A ? of_input(all, count, IN_N) : NULL;
    d.m = n ? 1 - (double)n->v.v : d.m;
    return d;
}

static bool read_value(calc *c, lexer *lx, assignment *all, size_t count) {
    assignment *a = &all[count];
    a->value_at = lx->at;
    /* without a geometry the dimension of A is unknown, and name_allowed reports that */
    const bool any = !a->q || (quantity_input(a->q) == IN_A && !c->scene.in.geometry);
    const dim want = any ? DIM_NONE : wanted_dim(c, a->q, all, count);
    if (!expr_parse_at(c, lx, &c->scratch) || expr_stray_unit(lx, c->keyword) ||
        !expr_eval_as(c, &c->scratch, any ? NULL : &want, &a->v, lx->error))
        return false;
    a->value_len = lx->last - a->value_at;
    return any || value_dim(lx, a->q->name, a->value_at, a->value_len, a->v, want);
}

static bool read_assignment(calc *c, lexer *lx, assignment *all, size_t count) {
    assignment *a = &all[count];
    char parameter[PARAMETERS][LEX_NAME];
    unsigned parameters;
    calc_error useless = ERROR_NONE;
    *a = (assignment){.at = lx->at, .len = lx->len};
    if (!name_allowed(c, lx, a)) {
        if (lx->error->len)
            return false;
        useless = *lx->error; /* an error in the value is reported first */
        error_clear(lx->error);
    }
    lex_next(lx);
    if (!read_parameters(lx, parameter, &parameters))
        return false;
    a->increment = lx->kind == T_INCREMENT;
    a->live = lx->kind == T_DEFINE;
    lex_next(lx);
    if (parameters && a->q)
        return calc_fail(lx->error, a->at, a->len, "%s is an input: it takes no arguments", a->q->name);
    a->value_at = lx->at;
    if (a->live || parameters) {
        a->d = definition_parse(c, lx, lx->text + a->at, a->len, parameter, parameters);
        a->value_len = lx->last - a->value_at;
        if (!a->d)
            return false;
    } else if (!read_value(c, lx, all, count)) {
        return false;
    }
    if (!useless.raised)
        return true;
    *lx->error = useless;
    return calc_place(lx->error, a->value_at, a->value_len);
}

static bool read_assignments(calc *c, lexer *lx, assignment *all, size_t *count) {
    for (*count = 0;;) {
        if (*count == ASSIGNMENTS)
            return lex_fail(lx, "at most %d assignments together", ASSIGNMENTS);
        if (!assign_at(lx))
            return lex_fail(lx, lx->kind == T_NUMBER
                                    ? "expected NAME = EXPR after the comma; a decimal comma is a point here"
                                    : "expected NAME = EXPR after the comma");
        for (size_t i = 0; i < *count; i++) /* they are set together, so that there is no last one */
            if (all[i].len == lx->len && !memcmp(lx->text + all[i].at, lx->text + lx->at, lx->len))
                return lex_fail(lx, "%.*s is given twice", LEX_WORD(lx));
        if (!read_assignment(c, lx, all, (*count)++))
            return false;
        if (lx->kind != T_COMMA)
            return !lx->error->raised;
        lex_next(lx);
    }
}

/* ---- making assignments ------------------------------------------------------------------------ */

typedef struct assigned {
    const assignment *all;
    size_t count;
    const assignment *but; /* skip this one */
} assigned;

/* Refuses two inputs of which one replaces the other: they are set together, so that there is no last one. */
static bool all_apart(lexer *lx, const assignment *all, size_t count) {
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < i; j++)
            if (all[i].q && all[j].q &&
                !calc_apart(quantity_input(all[j].q), quantity_input(all[i].q), all[i].at, all[i].len,
                            lx->error))
                return false;
    return true;
}

/* Refuses n without A, which would change the meaning of A. */
static bool power_holds(const calc *c, lexer *lx, const assignment *all, size_t count) {
    const assignment *n = of_input(all, count, IN_N);
    return !n || of_input(all, count, IN_A) || !c->scene.in.set[IN_A] ||
           calc_fail(lx->error, n->at, n->len,
                     "A belongs to the n it was given with: set both (n = 3, A = 50 m^-2)");
}

static void put_assigned(inputs *in, void *context) {
    const assigned *job = context;
    for (size_t i = 0; i < job->count; i++) {
        const assignment *a = &job->all[i];
        if (!a->q || a == job->but)
            continue;
        const input which = quantity_input(a->q);
        if (a->d)
            inputs_bind(in, which, counted_hold(&a->d->base));
        else
            inputs_put(in, which, (double)a->v.v);
    }
}

/* Without a load an assignment of F_N presses; the other assignments are made first. A definition of F_N is
 * evaluated for the press, and bound after it. */
static bool press_with(scene *s, assigned job, const assignment *FN, calc_error *error) {
    load_step press = {.kind = LOAD_PRESS, .normal = BY_FORCE};
    long double force = FN->v.v;
    job.but = FN->d ? NULL : FN;
    bool ok = ((job.count == 1 && job.but) || scene_edit(s, put_assigned, &job, error)) &&
              (!FN->d || scene_get(s, IN_FN, &force, error));
    press.normal_value = (double)force;
    ok = ok && scene_load(s, &press, NULL, error);
    if (ok && FN->d) {
        job = (assigned){FN, 1, NULL};
        ok = scene_edit(s, put_assigned, &job, error);
    }
    return ok;
}

/* Is the error gross slip because FA stays while other inputs change? */
static bool amplitude_is_left(const calc_error *error, const assignment *all, size_t count) {
    return !of_input(all, count, IN_FA) && error->kind == ERROR_STATUS &&
           error->status.code == FRET_GROSS_SLIP && !strcmp(error->status.quantity, "FA");
}

/* Notes a definition whose dimensions do not match. It is taken: those of what it uses may change. */
static void note_no_value(calc *c, definition *d) {
    calc_error error = ERROR_NONE;
    value v;
    if (d->parameters || definition_value(c, d, &v, &error) || !error.strange)
        return;
    calc_word(c, &error);
    snprintf(c->note, sizeof c->note, "%s has no value so far: %.*s", d->label, CALC_NOTE / 2, error.text);
}

/* Notes a new name that resembles an input. */
static void note_new_name(calc *c, const char *text, size_t len) {
    static const char *const other_names[][2] = {
        {"angle", "slope"}, {"Fn", "FN"}, {"F", "FN"},  {"P", "FN"},    {"radius", "R"}, {"v", "nu"},
        {"R1", "R"},        {"R2", "R"},  {"E1", "E0"}, {"E2", "E0_2"}, {"E02", "E0_2"}, {"nu2", "nu_2"}};
    char letters[PLAIN_WORD], plain[PLAIN_WORD];
    size_t n = 0;
    plain_letters(text, len, letters);
    for (size_t i = 0; letters[i]; i++)
        if (letters[i] != '_')
            plain[n++] = letters[i];
    plain[n] = 0;
    const char *near = NULL;
    for (size_t i = 0; i < sizeof other_names / sizeof *other_names; i++)
        if (!strcmp(plain, other_names[i][0]))
            near = other_names[i][1];
    if (near && *near == 'R' && !inputs_take(&c->scene.in, IN_RADIUS))
        near = NULL; /* R1 may be meant for a sphere to come */
    for (input in = 0; in < INPUTS && !near; in++) {
        const char *name = quantity_of_input(in)->name;
        if (same_but_case(plain, name) || (n > 2 && one_letter_apart(plain, name)))
            near = name;
    }
    if (near)
        snprintf(c->note, sizeof c->note, "new variable %.*s; did you mean %s?", LEX_SHOWN(len), text, near);
}

static bool put_name(calc *c, lexer *lx, const assignment *a) {
    size_t i = a->own;
    char chain[CALC_ERROR_TEXT / 2];
    const char *text = lx->text + a->at;
    if (a->increment)
        return calc_fail(lx->error, a->at, a->len, "+= belongs to step; write %.*s = ...", LEX_SHOWN(a->len),
                         text);
    if (!a->known && !names_find(&c->names, text, a->len, &i)) {
        note_new_name(c, text, a->len);
        if (!names_add(&c->names, text, a->len, &i))
            return calc_no_memory(lx->error);
    }
    if (a->d && expr_chain(c, &a->d->body, a->d->label, chain, sizeof chain))
        return calc_fail(lx->error, a->value_at, a->value_len, "a circle of definitions: %s -> %s%s",
                         a->d->label, chain, a->d->label);
    if (!undo_name(c, i))
        return calc_no_memory(lx->error);
    names_put(&c->names, i, a->v, a->d ? counted_hold(&a->d->base) : NULL);
    if (a->d)
        note_no_value(c, a->d);
    return true;
}

/* of_scene: some are of inputs. */
static bool put_all(calc *c, lexer *lx, assignment *all, size_t count, bool of_scene) {
    if (!all_apart(lx, all, count) || !power_holds(c, lx, all, count))
        return false;
    for (size_t i = 0; i < count; i++) { /* += of inputs */
        long double old;
        if (!all[i].increment || !all[i].q)
            continue;
        if (!scene_get(&c->scene, quantity_input(all[i].q), &old, lx->error))
            return false;
        all[i].v.v += old;
    }
    for (size_t i = 0; i < count; i++)
        if (!all[i].q && !put_name(c, lx, &all[i]))
            return false;
    assigned job = {all, count, NULL};
    scene *s = &c->scene;
    if (!of_scene && !s->in.bindings) /* bound inputs may depend on the names */
        return true;
    const assignment *FN = s->end.steps ? NULL : of_input(all, count, IN_FN);
    if (FN)
        return press_with(s, job, FN, lx->error);
    if (scene_edit(s, put_assigned, &job, lx->error))
        return true;
    if (amplitude_is_left(lx->error, all, count))
        calc_append(c, lx->error, ", or let FA follow (FA := 0.9*mu*FN)");
    return false;
}

/* Makes all assignments or none, as one undo entry. */
static bool put_undoable(calc *c, lexer *lx, assignment *all, size_t count) {
    const size_t entries = c->undo.count;
    bool of_scene = false;
    for (size_t i = 0; i < count; i++)
        of_scene = of_scene || all[i].q;
    scene_mark *before = of_scene ? undo_mark(c) : NULL;
    if (of_scene && !before)
        return calc_no_memory(lx->error);
    bool ok = put_all(c, lx, all, count, of_scene);
    if (of_scene && ok)
        undo_scene(c, before);
    else if (of_scene)
        undo_unmark(c, before);
    while (!ok && c->undo.count > entries) /* restore names set before the failure */
        undo_pop(c, true);
    return ok;
}

bool calc_assign(calc *c, lexer *lx) {
    assignment all[ASSIGNMENTS];
    size_t count = 0;
    bool ok = read_assignments(c, lx, all, &count);
    if (ok && lx->kind != T_END)
        ok = !expr_stray_unit(lx, c->keyword) && lex_fail(lx, "unexpected '%.*s'", LEX_WORD(lx));
    for (size_t i = 0; i < count && ok; i++) {
        if (!all[i].q || all[i].d || all[i].increment)
            continue;
        ok = input_check(quantity_input(all[i].q), (double)all[i].v.v, lx->error) ||
             calc_place(lx->error, all[i].value_at, all[i].value_len);
    }
    ok = ok && put_undoable(c, lx, all, count);
    if (!ok) {
        const assignment *a = of_input(all, count, (input)lx->error->input);
        a = a ? a : &all[count - 1];
        calc_place(lx->error, a->value_at, a->value_len);
    }
    for (size_t i = 0; i < count; i++)
        counted_drop(all[i].d ? &all[i].d->base : NULL);
    return ok;
}

bool calc_bind(calc *c, lexer *lx, input in, counted **out) {
    const char *name = quantity_of_input(in)->name;
    definition *d = definition_parse(c, lx, name, strlen(name), NULL, 0);
    *out = d ? &d->base : NULL;
    return d != NULL;
}
