/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command `explain`: the quantities that an expression is made of, a page each. Changes nothing. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "help/explain_page.h"
#include "help/texts.h"
#include "language/trial.h"
#include "number/array.h"
#include "statement/command.h"
#include "statement/text.h"

/* ---- the parts of an expression ---------------------------------------------------------------- */

typedef struct parts {
    part *of;
    size_t count, room;
} parts;

/* The i-th quantity of e, as it stands there; a call to its end. */
static bool part_at(const expr *e, size_t i, part *out) {
    bool call;
    size_t at, end;
    int depth = 1;
    const quantity *q = expr_quantity(e, i, &call, &at);
    if (!q)
        return false;
    *out = (part){.q = q, .call = call, .text = call ? e->text + at : q->name, .len = strlen(q->name)};
    if (!call)
        return true;
    out->argument = strcspn(out->text, "(") + 1;
    for (end = out->argument; depth > 0; end++)
        depth += (out->text[end] == '(') - (out->text[end] == ')');
    out->argument_len = end - 1 - out->argument;
    out->len = end;
    return true;
}

static bool same_formula(const part *a, const part *b) {
    return a->q == b->q && a->call == b->call;
}

/* Is there one before with this formula? text: and the same argument. */
static bool is_before(const parts *all, size_t count, const part *of, bool text) {
    for (size_t i = 0; i < count; i++)
        if (same_formula(&all->of[i], of) &&
            (!text || (all->of[i].len == of->len && !strncmp(all->of[i].text, of->text, of->len))))
            return true;
    return false;
}

/* Those of e, which stands in a definition or not, and of the definitions that it names, each once. What has
 * been asked for is none of them where its formula belongs to a call within: it is told at the end. */
static bool add_parts(const page *p, const expr *e, const definition *in, const expr *asked, parts *all) {
    part one;
    const definition *d;
    for (size_t i = 0; part_at(e, i, &one); i++) {
        one.in = in;
        one.whole = e == asked && one.len == e->len;
        if (is_before(all, all->count, &one, !one.whole))
            continue;
        part *grown = fret_array_for(all->of, &all->room, all->count + 1, sizeof *grown);
        if (!grown)
            return calc_no_memory(p->error);
        all->of = grown;
        all->of[all->count++] = one;
    }
    for (size_t i = 0; (d = expr_definition(&p->sh->calc, e, i)); i++)
        if (!add_parts(p, &d->body, d, asked, all))
            return false;
    return true;
}

/* The part of a statement as an expression of its own, and its value. */
static bool text_value(const page *p, const char *text, size_t len, expr *e, value *v) {
    calc *c = &p->sh->calc;
    calc_error *why = error_quiet();
    lexer lx;
    lex_start(&lx, text, len, why);
    return explain_had(p, expr_parse(c, &lx, e) && expr_eval(c, e, v, why), why);
}

/* An input, and F_N as it was given: no formula made the number. */
static bool is_given(const page *p, const quantity *q) {
    scene *s = p->sh->calc.now;
    const load_reach *reach;
    calc_error *why = error_quiet();
    return q->of == OF_INPUT || (quantity_is_input(q) && s->in.set[quantity_input(q)] &&
                                 explain_had(p, scene_reach(s, &reach, why), why) && !reach->normal_varies);
}

/* Does it stand for many values: within a function, of what that is given? */
static bool is_free(const part *of, const definition *in) {
    lexer lx;
    bool found = false;
    for (lex_start(&lx, of->text, of->len, error_quiet()); lx.kind != T_END; lex_next(&lx))
        for (unsigned i = 0; i < in->parameters; i++)
            found |= lex_is(&lx, in->parameter[i]);
    return found;
}

/* The part by itself, where it has a value there. */
static bool part_value(const page *p, const part *of, expr *e, value *v) {
    return !(of->in && is_free(of, of->in)) && text_value(p, of->text, of->len, e, v);
}

/* ---- pages ------------------------------------------------------------------------------------- */

static bool explain_part(const page *p, const part *of) {
    expr e = {0}, unused = {0};
    influence_study study = {.count = 0};
    value v = {0}, argument = {0};
    const bool has = part_value(p, of, &e, &v);
    const quantity *call = of->call && of->q->call ? of->q : NULL; /* of one argument */
    if (has && call)
        text_value(p, of->text + of->argument, of->argument_len, &unused, &argument);
    const bool ok = !has || influences(&p->sh->calc, &e, v.v, call, argument, &study, p->error);
    if (ok)
        explain_quantity(p, of, has ? &e : NULL, v, &study, of->whole && p->conditioning);
    expr_free(&e);
    expr_free(&unused);
    return ok;
}

/* The value of a call whose formula has been told. */
static void explain_call(const page *p, const part *of, bool title) {
    expr e = {0};
    value v;
    if (part_value(p, of, &e, &v)) {
        answer_page(p->out, "explain");
        if (title)
            explain_title(p, of->q);
        explain_value(p, of->text, of->len, v, of->q->unit);
        answer_done(p->out);
    }
    expr_free(&e);
}

/* Calls follow the first of their kind. */
static bool explain_parts(const page *p, parts *all) {
    for (size_t i = 0; i < all->count; i++) {
        const part *one = &all->of[i];
        if (one->told)
            continue;
        if (is_before(all, i, one, false))
            explain_call(p, one, true);
        else if (!one->call && is_given(p, one->q))
            explain_input(p, one->q);
        else if (!explain_part(p, one))
            return false;
        for (size_t j = i + 1; one->call && j < all->count; j++)
            if (same_formula(&all->of[j], one) && all->of[j].in == one->in && !all->of[j].told) {
                explain_call(p, &all->of[j], false);
                all->of[j].told = true;
            }
    }
    return true;
}

static bool explain_whole(const page *p, const expr *e, value v) {
    influence_study study;
    if (p->conditioning && !influences(&p->sh->calc, e, v.v, NULL, (value){0}, &study, p->error))
        return false;
    answer_page(p->out, "explain");
    explain_value(p, e->text + e->at, e->len, v, expr_unit(e));
    if (p->sh->calc.over_error > 0)
        explain_error(p, fmax(p->sh->calc.over_error, DBL_EPSILON), "integral of the magnitude");
    if (p->conditioning)
        explain_conditioning(p, "it", &study);
    answer_done(p->out);
    return true;
}

/* Its parts, and at the end what was asked for, where it is more than one of them. */
static bool explain_expression(const page *p, const expr *e, const expr *asked, value v) {
    parts all = {.count = 0};
    bool ok = add_parts(p, e, NULL, asked, &all) && explain_parts(p, &all), told = false;
    for (size_t i = 0; i < all.count; i++)
        told = told || all.of[i].whole;
    ok = ok && (told || explain_whole(p, asked, v));
    free(all.of);
    return ok;
}

/* ---- the statement ----------------------------------------------------------------------------- */

/* A name that means nothing. */
static bool no_quantity(shell *sh, lexer *lx) {
    char word[LEX_NAME];
    size_t i;
    if (lx->kind != T_NAME) {
        if (lx->kind == T_END)
            lex_fail(lx, "explain which quantity? try: explain dW");
        return lx->kind == T_END;
    }
    lex_word(lx, word); /* as much as is shown */
    if (quantity_find(lx->text + lx->at, lx->len) || lex_is(lx, "ans") ||
        names_find(&sh->calc.names, lx->text + lx->at, lx->len, &i))
        return false;
    i = 0;
    for (const char *name; (name = builtin_name(i)); i++)
        if (lex_is(lx, name))
            return false;
    const char *lead = lead_from(word), *near = lead ? lead : suggest(word, quantity_name);
    lex_fail(lx,
             lead   ? "'%s' is no quantity: %s"
             : near ? "'%s' is no quantity: did you mean %s?"
                    : "'%s' is no quantity; try: explain dW",
             word, near);
    return true;
}

/* An input or a function by its name alone may be without a value. */
static const quantity *bare_name(const lexer *lx) {
    const quantity *q = lx->kind == T_NAME ? quantity_find(lx->text + lx->at, lx->len) : NULL;
    return q && (q->of == OF_INPUT || q->of == OF_FUNCTION) ? q : NULL;
}

/* What is to be explained, `e`, in the scene as it is, or as `at` changes it: a trial, then. */
static bool read_explained(shell *sh, lexer *lx, const expr **e, const expr **asked, trial **t, value *v) {
    bool call;
    size_t first;
    const size_t at = lx->at;
    expr *whole = &sh->list[0];
    if (!expr_parse_at(&sh->calc, lx, whole) || !at_end(lx))
        return false;
    const expr *meant = expr_meant(&sh->calc, whole);
    if (!expr_changed(&sh->calc, meant, t, e, lx->error))
        return calc_place(lx->error, at, whole->len);
    *asked = meant == whole ? *e : whole;
    if (!expr_quantity(*e, 0, &call, &first) && !expr_definition(&sh->calc, *e, 0) && !(*e)->ats)
        return calc_fail(lx->error, at, whole->len, "explain which quantity? try: explain dW");
    sh->calc.over_error = 0;
    return expr_eval(&sh->calc, *e, v, lx->error) || calc_place(lx->error, at, whole->len);
}

/* Not a quantity, but a word of the warning on dissimilar bodies. */
static bool explain_mismatch(shell *sh, lexer *lx) {
    const fret_normal *normal;
    text_out text;
    answer out;
    if (!text_begin(&text, &sh->set, sh->out, TEXT_ANSWERS))
        return calc_no_memory(lx->error);
    answer_begin(&out, &sh->set, text.to);
    answer_page(&out, "explain");
    answer_string(&out, "name", "mismatch");
    if (scene_normal(&sh->calc.scene, &normal, error_quiet())) {
        const double mismatch = (double)fret_normal_foundation(normal)->mismatch;
        answer_words(&out, "mismatch = %.3g\n\n", mismatch);
        answer_number(&out, "value", mismatch);
    }
    answer_words(&out, "%s", coupling_text);
    answer_string(&out, "text", coupling_text);
    answer_done(&out);
    return text_end(&text, true) || calc_no_memory(lx->error);
}

static bool explain(shell *sh, const quantity *bare, const expr *e, const expr *asked, value v,
                    bool conditioning, lexer *lx) {
    text_out text;
    answer out;
    if (!text_begin(&text, &sh->set, sh->out, TEXT_ANSWERS))
        return calc_no_memory(lx->error);
    answer_begin(&out, &sh->set, text.to);
    const page p = {sh, &out, conditioning, lx->error};
    bool ok = true;
    if (bare && bare->of == OF_INPUT)
        explain_input(&p, bare);
    else if (bare)
        explain_function(&p, bare);
    else
        ok = explain_expression(&p, e, asked, v);
    ok = ok && !lx->error->raised;
    return (text_end(&text, ok) || calc_no_memory(lx->error)) && ok;
}

bool do_explain(shell *sh, lexer *lx, said *all) {
    const expr *e = NULL, *asked = NULL;
    trial *changed = NULL;
    value v = {0};
    const bool conditioning = said_of(all, "conditioning", 0);
    lexer own = hole_lexer(lx, &all->list[0].hole[0]);
    const bool alone = own.at + own.len == own.end && !conditioning;
    if (lex_is(&own, "mismatch") && alone)
        return explain_mismatch(sh, lx);
    if (no_quantity(sh, &own))
        return false;
    const quantity *bare = alone ? bare_name(&own) : NULL;
    const bool ok = (bare || read_explained(sh, &own, &e, &asked, &changed, &v)) &&
                    explain(sh, bare, e, asked, v, conditioning, lx);
    if (changed)
        trial_close(changed);
    return ok;
}
