/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command `explain`: a page for each quantity of an expression: formula, inputs, model and error, written
 * once for both readers and programs (statement/answer). Changes nothing. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "help/conditioning.h"
#include "language/trial.h"
#include "number/array.h"
#include "statement/answer.h"
#include "statement/command.h"
#include "statement/text.h"
#include "study/influence.h"
#include "text/typeset.h"

/* What all functions that write pages need. */
typedef struct page {
    shell *sh;
    answer *out;
    bool conditioning; /* the user wants it */
    calc_error *error; /* if raised, nothing is shown */
} page;

/* One occurrence of a quantity in an expression. */
typedef struct part {
    const quantity *q;
    bool call;
    const char *text; /* "dW(20 N)" */
    size_t len;
    bool free;  /* contains a parameter of the definition that it stands in, so that it has no one value */
    bool whole; /* the user asked for this quantity alone */
} part;

/* Returns `ok`. What fails is left out of the page, but no memory and Ctrl-C are errors of the page. */
static bool explain_had(const page *p, bool ok, const calc_error *why) {
    if (!ok && why->stop)
        *p->error = *why;
    return ok;
}

/* ---- lines ------------------------------------------------------------------------------------- */

/* Writes "name = value"; row: the unit for readers, or NULL for the unit that suits the value. */
static void explain_value(const page *p, const char *name, size_t len, value v, const char *row) {
    char text[160], unit_text[COLUMN_UNIT], *whole = column_name(name, len);
    if (!whole) {
        calc_no_memory(p->error);
        return;
    }
    format_column(&(column){.d = v.d, .row = row}, p->sh->set.digits, v.v, text, sizeof text);
    dim_unit(v.d, unit_text, sizeof unit_text);
    answer_words(p->out, "    %s = %s\n", whole, text);
    answer_string(p->out, "expression", whole);
    answer_number(p->out, "value", (double)v.v);
    answer_string(p->out, "unit", unit_text);
    free(whole);
}

/* The formula in Unicode, or as it is where the locale has none. */
static const char *set_in(const char *plain, char *buf, size_t size) {
    if (!typeset_unicode())
        return plain;
    typeset(plain, buf, size);
    return buf;
}

/* Writes title and formula. */
static void explain_formula(const page *p, const quantity *q, bool call) {
    const formula *f = quantity_formula(q, p->sh->calc.now, call);
    char set[512], line[600];
    answer_words(p->out, "%s: %s\n", q->name, q->title);
    answer_string(p->out, "name", q->name);
    answer_string(p->out, "title", q->title);
    snprintf(line, sizeof line, "    %s%s%s", set_in(f->text, set, sizeof set), f->equation ? "  " : "",
             f->equation ? f->equation : "");
    answer_line(p->out, line);
    answer_string(p->out, "formula", f->text);
    if (f->equation)
        answer_string(p->out, "equation", f->equation);
}

/* A step by one force and one displacement leaves its path open: write which one fret takes. */
static void put_paths(const page *p) {
    static const struct {
        load_by normal, tangential;
        const char *step, *plane;
    } paths[] = {{BY_FORCE, BY_DISPLACEMENT, "step FN= dx=", "(delta_z, delta_x)"},
                 {BY_DISPLACEMENT, BY_FORCE, "step dz= Fx=", "(F_N, F_x)"}};
    const scene *s = p->sh->calc.now;
    char plane[64];
    bool any = false;
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++)
        for (size_t j = 1; j < s->end.steps; j++) {
            const load_step *step = &s->program->steps[j];
            if (step->kind != LOAD_STEP || step->normal != paths[i].normal ||
                step->tangential != paths[i].tangential)
                continue;
            answer_words(p->out, "    path: %s goes straight in %s\n", paths[i].step,
                         set_in(paths[i].plane, plane, sizeof plane));
            if (!any)
                answer_group(p->out, "straight paths");
            any = true;
            answer_string(p->out, paths[i].step, paths[i].plane);
            break;
        }
    if (any)
        answer_up(p->out);
}

/* ---- the model --------------------------------------------------------------------------------- */

/* Is it a result that is extrapolated to infinitely many chords per period of a sine: one that follows from
 * the state, other than c and kt? */
static bool is_extrapolated(const quantity *q, bool call) {
    return !call && (q->closed || q->of == OF_STATE) && q->at_state != offsetof(fret_state, c) &&
           q->at_state != offsetof(fret_state, kt);
}

/* Gets the value of e at the instant that `run` has reached, or the limit of `levels` runs there. */
static bool value_on(const page *p, const expr *e, const runner *run, unsigned levels, value *v) {
    const instant now = {.run = run, .levels = levels};
    calc_error *why = error_quiet();
    trial *t = trial_open(&p->sh->calc, why);
    if (t)
        t->scene.now = &now;
    const bool ok = t && expr_eval(&p->sh->calc, e, v, why);
    if (t)
        t->scene.used = 0; /* models used here did not compute the value that the page shows */
    trial_close(t);
    return explain_had(p, ok, why);
}

/* Gets the value for each number of chords; false if these do not tell the whole error. */
static bool by_chords(const page *p, model_id model, const expr *e, long double at[LEVELS]) {
    const answers *a = &p->sh->calc.now->answers;
    bool ok = e && model == MODEL_MEMORY && a->levels == LEVELS;
    for (unsigned i = 0; ok && i < LEVELS; i++) {
        value v = {0, DIM_NONE};
        ok = value_on(p, e, &a->run[i], 1, &v);
        at[i] = v.v;
    }
    return ok;
}

enum { MODEL_TEXT = 240 };

static void name_model(const page *p, model_id model, char text[MODEL_TEXT]) {
    if (model == MODEL_SPRINGS)
        snprintf(text, MODEL_TEXT, "%u %s", p->sh->calc.now->springs, models[model].title);
    else
        snprintf(text, MODEL_TEXT, "%s", models[model].title);
}

/* Adds to `text` how a load whose F_N swings was computed. e: NULL if there is no value. Returns the relative
 * error of the value that this causes; 0 if it is unknown. */
static double describe_sine(const page *p, const quantity *q, bool call, model_id model, const expr *e,
                            char text[MODEL_TEXT]) {
    const answers *a = &p->sh->calc.now->answers;
    const int finest = RUN_CHORDS << (LEVELS - 1);
    const bool limit = is_extrapolated(q, call);
    const double least = 1e-15;
    long double at[LEVELS];
    if (model == MODEL_MEMORY && a->levels == 1) { /* no chords: the sine is followed by its events */
        text_add(text, MODEL_TEXT, ", the sine itself, event by event (exact)");
        return least;
    }
    if (!by_chords(p, model, e, at)) {
        text_add(text, MODEL_TEXT, ", by %d chords a period of the sine%s", finest,
                 limit ? " and fewer, extrapolated" : "");
        return 0;
    }
    const long double last = fabsl(at[LEVELS - 1]), change = fabsl(at[LEVELS - 1] - at[LEVELS - 2]);
    const double unsure = (double)(limit      ? run_unsure(at)
                                   : last > 0 ? 2 * change / last
                                              : 0),
                 good = round_up(fmax(unsure, least));
    if (limit)
        text_add(text, MODEL_TEXT,
                 ", converged to %.0e (the sine itself, by %d chords a period and fewer, extrapolated)", good,
                 finest);
    else
        text_add(text, MODEL_TEXT, ", by %d chords a period of the sine, good to %.0e", finest, good);
    return good;
}

/* Does F_N swing in a cycle of the load? The scene has been run. */
static bool swings(scene *s) {
    const load_reach *reach = &(load_reach){.swings = false};
    scene_reach(s, &reach, error_quiet());
    return reach->swings;
}

static void put_law(const page *p) {
    const scene *s = p->sh->calc.now;
    const struct fret_table *rows = s->answers.normal ? fret_normal_gap(s->answers.normal)->table : NULL;
    char text[MODEL_TEXT];
    if (scene_is_worn(s))
        snprintf(text, sizeof text, "worn by blocks of cycles, good to some %.0e", WEAR_TOLERANCE);
    else
        snprintf(text, sizeof text, "%s, good to %.0e", models[MODEL_PIECES].title, s->pieces_error);
    if (rows && fret_table_within(rows) > 0)
        text_add(text, sizeof text, ", of %zu pieces within %.0e of the gap", fret_table_count(rows) - 1,
                 fret_table_within(rows));
    answer_fact(p->out, "law of the gap", text);
}

static void put_repeated(const page *p, unsigned periods) {
    char text[MODEL_TEXT];
    snprintf(text, sizeof text, "%u more period%s the last one that was run", periods,
             periods == 1 ? " repeats" : "s repeat");
    answer_fact(p->out, "cycle", text);
}

/* Writes the model. *sine gets the relative error by the chords of a swinging load; 0: none, or unknown. */
static model_id put_model(const page *p, const quantity *q, bool call, const expr *e, double *sine) {
    scene *s = p->sh->calc.now;
    const model_id model = quantity_model(q, s, call);
    const bool stepped = models[model].steps;
    char text[MODEL_TEXT];
    *sine = 0;
    name_model(p, model, text);
    if (stepped && (q->reads & INPUT_BIT(IN_MU)) && swings(s))
        *sine = describe_sine(p, q, call, model, e, text);
    else if (model == MODEL_PIECES)
        snprintf(text, sizeof text, "%s, with %s over the gap", models[MODEL_CLOSED].title,
                 models[MODEL_PIECES].title);
    else if (model == MODEL_MEMORY)
        text_add(text, sizeof text, " (exact)");
    answer_fact(p->out, "model", text);
    if ((model == MODEL_MEMORY || model == MODEL_PIECES) && s->used & USED(MODEL_PIECES))
        put_law(p);
    if (stepped && (q->reads & INPUT_BIT(IN_MU))) {
        if (model == MODEL_MEMORY && s->answers.levels && s->answers.run[0].repeated)
            put_repeated(p, s->answers.run[0].repeated);
        put_paths(p);
    }
    return model;
}

/* ---- the error --------------------------------------------------------------------------------- */

/* Is it a local field under a load? Near the rim a small value is the difference of larger ones. */
static bool is_local(const quantity *q, bool call) {
    return call && q->load && (*q->argument == 'x' || *q->argument == 'r');
}

/* For programs: the error relative to what `of` names. */
static void say_error(const page *p, double error, const char *of) {
    answer_number(p->out, "error", error);
    answer_string(p->out, "error of", of);
}

/* The error of springs: the difference to the memory diagram, which the scene runs as well. */
static void put_difference(const page *p, const expr *e, value v) {
    const answers *a = &p->sh->calc.now->answers;
    char text[160];
    value exact;
    if (!value_on(p, e, a->run, a->levels, &exact))
        return;
    const long double off = fabsl(v.v - exact.v);
    format_value(&p->sh->set, (value){off, v.d}, text, sizeof text);
    if (off > 0 && exact.v != 0) {
        answer_words(p->out, "    error: %.1Le of the value, against the exact one\n", off / fabsl(exact.v));
        say_error(p, (double)(off / fabsl(exact.v)), "value");
    } else {
        answer_words(p->out, "    error: %s, against the exact value\n", text);
        answer_number(p->out, "absolute error", (double)off);
    }
}

/* Writes the bound `good` of the error, relative to what `of` names. */
static void explain_error(const page *p, double good, const char *of) {
    answer_words(p->out, "    error: %s %.0e of the %s\n", scene_is_worn(p->sh->calc.now) ? "some" : "below",
                 round_up(good), of);
    say_error(p, round_up(good), of);
}

/* Writes the error bound that `help exactness` documents. */
static void put_error(const page *p, const quantity *q, bool call, model_id model, double sine) {
    const scene *s = p->sh->calc.now;
    const bool power = scene_is_power(s), local = is_local(q, call);
    const bool before = models[model].steps || scene_is_worn(s); /* dW of a worn gap, say, ends at 0 */
    const char *of = local ? "largest value" : before ? "largest value so far" : "value";
    if (quantity_is_input(q) && quantity_input(q) == IN_P0 && s->used & ASKED_STEEP) {
        answer_words(p->out, "    error: not known, p is steeper than the nodes of the worn gap\n");
        return;
    }
    double good = sine > 0 && local ? 1e-12 : sine > 0 || q->by || !power ? 1e-13 : DBL_EPSILON;
    good = fmax(q->calls == CALL_STRESS ? 1e-12 : good, sine);
    if (scene_is_worn(s))
        good = WEAR_TOLERANCE;
    if (s->used & USED(MODEL_PIECES))
        good = fmax(good, s->pieces_error);
    explain_error(p, good, of);
}

/* ---- inputs ------------------------------------------------------------------------------------ */

static const input_set of_cycle = INPUT_CYCLE & ~INPUT_BIT(IN_NW);

static bool has_effect(const influence_study *study, input in) {
    for (size_t i = 0; i < study->count; i++)
        if (study->cause[i].kind == CAUSE_INPUT && study->cause[i].in == in)
            return study->cause[i].influence != INFLUENCE_NONE;
    return true;
}

/* Writes the inputs that the value depends on. */
static void put_numbers(const page *p, const quantity *q, const influence_study *study) {
    scene *s = p->sh->calc.now;
    const input_set reads = q->reads | (q->reads & INPUT_BIT(IN_NW) && scene_is_worn(s) ? READS_WORN : 0);
    for (input in = 0; in < INPUTS; in++) {
        const quantity *row = quantity_of_input(in);
        value v = {0, quantity_dim(row, s)};
        calc_error *why = error_quiet();
        const bool set = s->in.set[in] || (s->in.bindings & INPUT_BIT(in));
        if (set && row != q && reads & ~INPUT_PRESS & ~of_cycle & INPUT_BIT(in) &&
            !(in == IN_C0 && s->in.v[IN_K] == 0) && has_effect(study, in) &&
            explain_had(p, scene_get(s, in, &v.v, why), why))
            answer_quantity(p->out, row->name, v);
    }
}

/* Does the value depend on the tangential load? */
static bool is_pushed(const influence_study *study) {
    for (size_t i = 0; i < study->count; i++) {
        const cause *c = &study->cause[i];
        const bool pushes = c->kind == CAUSE_INPUT ? INPUT_AMPLITUDE & INPUT_BIT(c->in)
                                                   : c->kind == CAUSE_STEP && c->tangential;
        if (pushes && c->influence != INFLUENCE_NONE)
            return true;
    }
    return false;
}

/* Is the quantity a function of the amplitude of a cycle, such as dW(FA)? */
static bool is_of_cycle(const quantity *q) {
    return q->argument && quantity_find(q->argument, strlen(q->argument));
}

static void put_cycle(const page *p, const influence_study *study) {
    for (size_t i = 0; i < study->count; i++) {
        const cause *c = &study->cause[i];
        if (c->kind == CAUSE_INPUT && (INPUT_BIT(c->in) & of_cycle) && c->influence != INFLUENCE_NONE)
            answer_quantity(p->out, c->name, c->v);
    }
}

/* Writes the load, if the value depends on it. */
static void put_load(const page *p, const quantity *q, const influence_study *study) {
    scene *s = p->sh->calc.now;
    const fret_press *press;
    const fret_state *state;
    calc_error *why = error_quiet();
    bool matters = study->count == 0;
    for (size_t i = 0; i < study->count; i++)
        matters = matters || (cause_is_load(&study->cause[i]) && study->cause[i].influence != INFLUENCE_NONE);
    if (!matters || !q->load || q->in == 1 + IN_FN || !explain_had(p, scene_press(s, &press, why), why))
        return;
    answer_quantity(p->out, "FN now", (value){press->F, DIM_FORCE});
    const bool wears = q->reads & INPUT_BIT(IN_ALPHA_W);
    if (is_of_cycle(q) || wears || scene_is_worn(s))
        put_cycle(p, study);
    if (!is_of_cycle(q) && !wears && q->reads & INPUT_BIT(IN_MU) && is_pushed(study) &&
        strcmp(q->name, "Fx") && explain_had(p, scene_state(s, &state, why), why))
        answer_quantity(p->out, "Fx now", (value){state->Fx, DIM_FORCE});
}

/* ---- the page ---------------------------------------------------------------------------------- */

/* The page of an input: a number that was given, not computed. */
static void explain_input(const page *p, const quantity *q) {
    calc *c = &p->sh->calc;
    value v = {0, quantity_dim(q, c->now)};
    calc_error *why = error_quiet();
    answer_page(p->out, "explain");
    explain_formula(p, q, false);
    const bool got = explain_had(p, quantity_get(q, c->now, &v.v, why), why);
    v.d = quantity_dim(q, c->now); /* again: quantity_get may have computed bound inputs that it depends on */
    if (got)
        explain_value(p, q->name, strlen(q->name), v, q->unit);
    answer_done(p->out);
}

/* The page of a function named without an argument: it has no value. */
static void explain_function(const page *p, const quantity *q) {
    answer_page(p->out, "explain");
    explain_formula(p, q, true);
    answer_group(p->out, "numbers");
    put_numbers(p, q, &(influence_study){.count = 0});
    answer_up(p->out);
    answer_done(p->out);
}

/* The page of a result. e: the part as an expression, v its value; NULL: it has no value here. */
static void explain_quantity(const page *p, const part *of, const expr *e, value v,
                             const influence_study *study, bool conditioning) {
    const quantity *q = of->q;
    double sine;
    answer_page(p->out, "explain");
    explain_formula(p, q, of->call);
    answer_group(p->out, "numbers");
    put_numbers(p, q, study);
    if (e)
        put_load(p, q, study);
    answer_up(p->out);
    const model_id model = put_model(p, q, of->call, e, &sine);
    if (e)
        explain_value(p, of->text, of->len, v, of->q->unit);
    if (e && model == MODEL_SPRINGS)
        put_difference(p, e, v);
    else if (e)
        put_error(p, q, of->call, model, sine);
    if (conditioning)
        conditioning_tell(p->out, q->name, study);
    answer_done(p->out);
}

/* ---- the parts of an expression ---------------------------------------------------------------- */

typedef struct parts {
    part *of;
    size_t count, room;
} parts;

/* Gets the i-th quantity of e as it stands in the text, a call with its argument; false after the last. */
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
    for (end = strcspn(out->text, "(") + 1; depth > 0; end++)
        depth += (out->text[end] == '(') - (out->text[end] == ')');
    out->len = end;
    return true;
}

/* Does the part contain a parameter of the definition `in`? */
static bool is_free(const part *of, const definition *in) {
    lexer lx;
    bool found = false;
    for (lex_start(&lx, of->text, of->len, error_quiet()); lx.kind != T_END; lex_next(&lx))
        for (unsigned i = 0; i < in->parameters; i++)
            found |= lex_is(&lx, in->parameter[i]);
    return found;
}

/* Is there a part already whose page tells as much? Without a value a page tells the formula alone. */
static bool is_among(const parts *all, const part *of) {
    for (size_t i = 0; i < all->count; i++) {
        const part *one = &all->of[i];
        if (one->q == of->q && one->call == of->call &&
            (of->free || (one->len == of->len && !strncmp(one->text, of->text, of->len))))
            return true;
    }
    return false;
}

/* Adds the parts of e, the body of `in` (or NULL), and of the definitions that it names, each once. */
static bool add_parts(const page *p, const expr *e, const definition *in, const expr *asked, parts *all) {
    part one;
    const definition *d;
    for (size_t i = 0; part_at(e, i, &one); i++) {
        one.free = in && is_free(&one, in);
        one.whole = e == asked && one.len == e->len;
        if (is_among(all, &one))
            continue;
        if (!fret_array_room(&all->of, &all->room, all->count + 1, sizeof *all->of))
            return calc_no_memory(p->error);
        all->of[all->count++] = one;
    }
    for (size_t i = 0; (d = expr_definition(&p->sh->calc, e, i)); i++)
        if (!add_parts(p, &d->body, d, asked, all))
            return false;
    return true;
}

/* Evaluates the part by itself; false if it has no value. */
static bool part_value(const page *p, const part *of, expr *e, value *v) {
    calc *c = &p->sh->calc;
    calc_error *why = error_quiet();
    lexer lx;
    if (of->free)
        return false;
    lex_start(&lx, of->text, of->len, why);
    return explain_had(p, expr_parse(c, &lx, e) && expr_eval(c, e, v, why), why);
}

/* Was the value given: an input, or an input of the load that no step has changed? */
static bool is_given(const page *p, const quantity *q) {
    scene *s = p->sh->calc.now;
    const load_reach *reach;
    calc_error *why = error_quiet();
    return q->of == OF_INPUT || (quantity_is_input(q) && s->in.set[quantity_input(q)] &&
                                 explain_had(p, scene_reach(s, &reach, why), why) && !reach->normal_varies);
}

/* ---- pages of an expression --------------------------------------------------------------------- */

static void explain_part(const page *p, const part *of) {
    expr e = {0};
    influence_study study = {.count = 0};
    value v = {0};
    const bool has = part_value(p, of, &e, &v);
    if (!has || influences(&p->sh->calc, &e, v.v, &study, p->error))
        explain_quantity(p, of, has ? &e : NULL, v, &study, of->whole && p->conditioning);
    expr_free(&e);
}

static void explain_whole(const page *p, const expr *e, value v) {
    influence_study study;
    if (p->conditioning && !influences(&p->sh->calc, e, v.v, &study, p->error))
        return;
    answer_page(p->out, "explain");
    explain_value(p, e->text + e->at, e->len, v, expr_unit(e));
    if (p->sh->calc.over_error > 0)
        explain_error(p, fmax(p->sh->calc.over_error, DBL_EPSILON), "integral of the magnitude");
    if (p->conditioning)
        conditioning_tell(p->out, "it", &study);
    answer_done(p->out);
}

/* Writes the parts of e, and at the end the value of all of it, unless a part was that. */
static void explain_expression(const page *p, const expr *e, const expr *asked, value v) {
    parts all = {.count = 0};
    bool told = false;
    add_parts(p, e, NULL, asked, &all);
    for (size_t i = 0; i < all.count && !p->error->raised; i++) {
        const part *one = &all.of[i];
        told = told || one->whole;
        if (!one->call && is_given(p, one->q))
            explain_input(p, one->q);
        else
            explain_part(p, one);
    }
    if (!told && !p->error->raised)
        explain_whole(p, asked, v);
    free(all.of);
}

/* ---- the statement ----------------------------------------------------------------------------- */

/* The input or function that is named alone: its page needs no value; else NULL. */
static const quantity *bare_name(const lexer *lx) {
    const quantity *q = lx->kind == T_NAME ? quantity_find(lx->text + lx->at, lx->len) : NULL;
    return q && (q->of == OF_INPUT || q->of == OF_FUNCTION) ? q : NULL;
}

/* Reads the expression `asked`, its value, and `e`, the body of what it names. If `at` changes the scene, *t
 * is a trial with these changes, for the caller to close. */
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

bool do_explain(shell *sh, lexer *lx, parsed *all) {
    const expr *e = NULL, *asked = NULL;
    trial *changed = NULL;
    value v = {0};
    text_out text;
    answer out;
    const page p = {sh, &out, parsed_clause(all, "conditioning", 0), lx->error};
    lexer own = hole_lexer(lx, &all->list[0].hole[0]);
    const bool alone = own.at + own.len == own.end && !p.conditioning;
    if (own.kind == T_END)
        return lex_fail(&own, "explain which quantity? try: explain dW");
    const quantity *bare = alone ? bare_name(&own) : NULL;
    bool ok = (bare || read_explained(sh, &own, &e, &asked, &changed, &v)) &&
              text_begin(&text, sh, TEXT_ANSWERS, lx->error);
    if (ok) {
        answer_begin(&out, &sh->set, text.to);
        if (bare && bare->of == OF_INPUT)
            explain_input(&p, bare);
        else if (bare)
            explain_function(&p, bare);
        else
            explain_expression(&p, e, asked, v);
        ok = text_end(&text, !lx->error->raised) && !lx->error->raised;
    }
    trial_close(changed);
    return ok;
}
