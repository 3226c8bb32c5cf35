/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The page of a quantity: its formula, the numbers put in, the model that answered, the error, and how far
 * the last digit of each input moves it. Each is said once, to readers and to programs. */
#include "help/explain_page.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "language/trial.h"
#include "text/typeset.h"

bool explain_had(const page *p, bool ok, const calc_error *why) {
    if (!ok && why->stop)
        *p->error = *why;
    return ok;
}

/* ---- lines ------------------------------------------------------------------------------------- */

void explain_value(const page *p, const char *name, size_t len, value v, const char *row) {
    char text[160], unit_text[COLUMN_UNIT], *whole = column_name(name, len);
    if (!whole) {
        calc_raise_memory(p->error);
        return;
    }
    format_row(&p->sh->set, v, row, text, sizeof text);
    dim_unit(v.d, unit_text, sizeof unit_text);
    answer_words(p->out, "    %s = %s\n", whole, text);
    answer_string(p->out, "expression", whole);
    answer_number(p->out, "value", (double)v.v);
    answer_string(p->out, "unit", unit_text);
    free(whole);
}

void explain_title(const page *p, const quantity *q) {
    answer_words(p->out, "%s: %s\n", q->name, q->title);
    answer_string(p->out, "name", q->name);
    answer_string(p->out, "title", q->title);
}

/* As a terminal shows it, where it can. */
static const char *set_in(const char *plain, char *buf, size_t size) {
    if (!typeset_unicode())
        return plain;
    typeset(plain, buf, size);
    return buf;
}

/* With the title. */
static void explain_formula(const page *p, const quantity *q, bool call) {
    const formula *f = quantity_formula(q, p->sh->calc.now, call);
    char set[512], line[600];
    explain_title(p, q);
    snprintf(line, sizeof line, "    %s%s%s", set_in(f->text, set, sizeof set), f->equation ? "  " : "",
             f->equation ? f->equation : "");
    answer_line(p->out, line, 8);
    answer_string(p->out, "formula", f->text);
    if (f->equation)
        answer_string(p->out, "equation", f->equation);
}

/* Where a step mixes force and displacement, its path is a choice. */
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

/* Of the results, those that are taken to the limit of chords. */
static bool is_extrapolated(const quantity *q, bool call) {
    static const char *const names[] = {"Fx", "dx", "W", "U", "dW"};
    for (size_t i = 0; !call && i < sizeof names / sizeof *names; i++)
        if (!strcmp(q->name, names[i]))
            return true;
    return false;
}

/* The value of e where a run of the load stands. */
static bool value_on(const page *p, const expr *e, const runner *run, value *v) {
    const instant now = {.run = run};
    calc_error *why = error_quiet();
    trial *t = trial_open(&p->sh->calc, why);
    if (t)
        t->scene.now = &now;
    const bool ok = t && expr_eval(&p->sh->calc, e, v, why);
    if (t) {
        t->scene.used = 0; /* it has not answered */
        trial_close(t);
    }
    return explain_had(p, ok, why);
}

/* The value after each number of chords, where that tells all that it is good to. */
static bool by_chords(const page *p, model_id model, const expr *e, long double at[LEVELS]) {
    const answers *a = &p->sh->calc.now->answers;
    bool ok = e && model == MODEL_MEMORY && a->levels == LEVELS;
    for (unsigned i = 0; ok && i < LEVELS; i++) {
        value v = {0, DIM_NONE};
        ok = value_on(p, e, &a->run[i], &v);
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

/* How a swinging load has been run is added to `text`. e: what is explained; NULL: it has no value. What that
 * is good to; 0: nobody knows. */
static double describe_sine(const page *p, const quantity *q, bool call, model_id model, const expr *e,
                            char text[MODEL_TEXT]) {
    const answers *a = &p->sh->calc.now->answers;
    const int finest = RUN_CHORDS << (LEVELS - 1);
    const bool limit = is_extrapolated(q, call);
    const double least = 1e-15;
    long double at[LEVELS];
    const size_t n = strlen(text), room = MODEL_TEXT - n;
    if (model == MODEL_MEMORY && a->levels == 1) { /* all that it answers: no function of another load */
        snprintf(text + n, room, ", the sine itself, event by event (exact)");
        return least;
    }
    if (!by_chords(p, model, e, at)) {
        snprintf(text + n, room, ", by %d chords a period of the sine%s", finest,
                 limit ? " and fewer, extrapolated" : "");
        return 0;
    }
    const long double last = fabsl(at[LEVELS - 1]), change = fabsl(at[LEVELS - 1] - at[LEVELS - 2]);
    const double unsure = (double)(limit      ? run_unsure(at)
                                   : last > 0 ? 2 * change / last
                                              : 0),
                 good = round_up(fmax(unsure, least));
    if (limit)
        snprintf(text + n, room,
                 ", converged to %.0e (the sine itself, by %d chords a period and fewer, extrapolated)", good,
                 finest);
    else
        snprintf(text + n, room, ", by %d chords a period of the sine, good to %.0e", finest, good);
    return good;
}

/* Of a scene that has been run. */
static bool swings(scene *s) {
    const load_reach *reach = &(load_reach){.swings = false};
    scene_reach(s, &reach, error_quiet());
    return reach->swings;
}

static void put_law(const page *p) {
    const scene *s = p->sh->calc.now;
    const struct fret_table *rows = s->answers.normal ? fret_normal_gap(s->answers.normal)->table : NULL;
    char text[MODEL_TEXT];
    const int n =
        scene_is_worn(s)
            ? snprintf(text, sizeof text, "worn by blocks of cycles, good to %.0e", WEAR_TOLERANCE)
            : snprintf(text, sizeof text, "%s, good to %.0e", models[MODEL_PIECES].title, s->pieces_error);
    if (rows && fret_table_within(rows) > 0)
        snprintf(text + n, sizeof text - (size_t)n, ", of %zu pieces within %.0e of the gap",
                 fret_table_count(rows) - 1, fret_table_within(rows));
    answer_fact(p->out, "law of the gap", text);
}

static void put_repeated(const page *p, unsigned periods) {
    char text[MODEL_TEXT];
    snprintf(text, sizeof text, "%u more period%s the last one that was run", periods,
             periods == 1 ? " repeats" : "s repeat");
    answer_fact(p->out, "cycle", text);
}

/* Of a load that swings *sine tells what that is good to; 0: nobody knows. */
static model_id put_model(const page *p, const quantity *q, bool call, const expr *e, double *sine) {
    scene *s = p->sh->calc.now;
    const model_id model = quantity_model(q, s, call);
    const bool stepped = models[model].steps;
    char text[MODEL_TEXT];
    *sine = 0;
    name_model(p, model, text);
    const size_t n = strlen(text);
    if (stepped && (q->reads & INPUT_BIT(IN_MU)) && swings(s))
        *sine = describe_sine(p, q, call, model, e, text);
    else if (model == MODEL_PIECES)
        snprintf(text, sizeof text, "%s, with %s over the gap", models[MODEL_CLOSED].title,
                 models[MODEL_PIECES].title);
    else if (model == MODEL_MEMORY)
        snprintf(text + n, sizeof text - n, " (exact)");
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

/* A value at a place under a load: near the rim a small one is a difference of larger ones. */
static bool is_local(const quantity *q, bool call) {
    return call && q->load && (*q->argument == 'x' || *q->argument == 'r');
}

/* The value of e where the memory diagram stands, which the scene has run beside its springs. */
static bool exact_value(const page *p, const expr *e, value *v) {
    const answers *a = &p->sh->calc.now->answers;
    sight coarse[LEVELS - 1];
    runner run = a->run[a->levels - 1];
    for (unsigned i = 0; i + 1 < a->levels; i++)
        run_sight(&a->run[i], &coarse[i]);
    run.coarse = a->levels > 1 ? coarse : NULL;
    return value_on(p, e, &run, v);
}

/* For programs: a part of what. */
static void say_error(const page *p, double error, const char *of) {
    answer_number(p->out, "error", error);
    answer_string(p->out, "error of", of);
}

/* Of springs, which are an approximation. */
static void put_difference(const page *p, const expr *e, value v) {
    char text[160];
    value exact;
    if (!exact_value(p, e, &exact))
        return;
    const long double off = fabsl(v.v - exact.v);
    format_value(&p->sh->set, (value){off, v.d}, text, sizeof text);
    if (off > 0 && exact.v != 0) {
        answer_words(p->out, "    error: %.1Le of the value, beside the exact one\n", off / fabsl(exact.v));
        say_error(p, (double)(off / fabsl(exact.v)), "value");
    } else {
        answer_words(p->out, "    error: %s, beside the exact value\n", text);
        answer_number(p->out, "absolute error", (double)off);
    }
}

void explain_error(const page *p, double good, const char *of) {
    answer_words(p->out, "    error: below %.0e of the %s\n", round_up(good), of);
    say_error(p, round_up(good), of);
}

/* What the value is good to, as `help exactness` says. */
static void put_error(const page *p, const quantity *q, bool call, model_id model, double sine) {
    const scene *s = p->sh->calc.now;
    const bool power = scene_is_power(s), local = is_local(q, call);
    const char *of = local ? "largest value" : models[model].steps ? "largest value so far" : "value";
    double good = sine > 0 && local ? 1e-12 : sine > 0 || q->by || !power ? 1e-13 : DBL_EPSILON;
    good = fmax(q->call_at ? 1e-12 : good, sine);
    if (scene_is_worn(s))
        good = WEAR_TOLERANCE;
    if (s->used & USED(MODEL_PIECES))
        good = fmax(good, s->pieces_error);
    explain_error(p, good, of);
}

/* ---- inputs and conditioning ------------------------------------------------------------------- */

static bool has_effect(const influence_study *study, input in) {
    for (size_t i = 0; i < study->count; i++)
        if (study->cause[i].kind == CAUSE_INPUT && study->cause[i].in == in)
            return study->cause[i].influence != INFLUENCE_NONE;
    return true;
}

/* The inputs that the result was made of. */
static void put_numbers(const page *p, const quantity *q, const influence_study *study) {
    const input_set of_load = INPUT_PRESS | (INPUT_CYCLE & ~INPUT_BIT(IN_NW));
    scene *s = p->sh->calc.now;
    for (input in = 0; in < INPUTS; in++) {
        const quantity *row = quantity_of_input(in);
        value v = {0, quantity_dim(row, s)};
        calc_error *why = error_quiet();
        const bool set = s->in.set[in] || (s->in.bindings & INPUT_BIT(in));
        if (set && row != q && (q->reads & ~of_load & INPUT_BIT(in)) &&
            !(in == IN_C0 && s->in.v[IN_K] == 0) && has_effect(study, in) &&
            explain_had(p, scene_get(s, in, &v.v, why), why))
            answer_quantity(p->out, row->name, v);
    }
}

/* Does it matter what pushes sideways? */
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

/* Is its formula one of the amplitude? */
static bool is_of_cycle(const quantity *q) {
    return q->argument && quantity_find(q->argument, strlen(q->argument));
}

static void put_cycle(const page *p, const influence_study *study) {
    for (size_t i = 0; i < study->count; i++) {
        const cause *c = &study->cause[i];
        if (c->kind == CAUSE_INPUT && (INPUT_BIT(c->in) & INPUT_CYCLE) && c->influence != INFLUENCE_NONE)
            answer_quantity(p->out, c->name, c->v);
    }
}

/* Where the load matters. */
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
    if (is_of_cycle(q))
        put_cycle(p, study);
    else if (is_pushed(study) && strcmp(q->name, "Fx") && explain_had(p, scene_state(s, &state, why), why))
        answer_quantity(p->out, "Fx now", (value){state->Fx, DIM_FORCE});
}

static const char *const not_shown[] = {"no effect", "condition number below 0.01",
                                        "not smooth here, or hidden by rounding", "left out after 3 seconds",
                                        "0 has no last digit"};

static const char *argument_of(const cause *c) {
    return c->kind == CAUSE_ARGUMENT ? "argument " : "";
}

static void put_shown(const page *p, const cause *c, const char *name) {
    char head[400], text[160];
    format_value(&p->sh->set, c->v, text, sizeof text);
    snprintf(head, sizeof head, "%s %s %s", name, c->increment ? "+=" : "=", text);
    answer_words(p->out, "    %-20s  %10.1Le  %14.1Le  %16.2Lg%s\n", head, c->digit, c->change,
                 c->change / c->digit, c->refused ? "  (at the end of its range)" : "");
    answer_number(p->out, "last digit", (double)c->digit);
    answer_number(p->out, "moves", (double)c->change);
    answer_number(p->out, "condition number", (double)(c->change / c->digit));
    answer_flag(p->out, "at the end of its range", c->refused);
}

/* For readers: the causes of a kind in a line. */
static void put_others(const page *p, const influence_study *study, influence kind) {
    const char *before = "";
    for (size_t i = 0; i < study->count; i++) {
        const cause *c = &study->cause[i];
        if (c->influence != kind)
            continue;
        if (*before)
            answer_words(p->out, "%s%s%s", before, argument_of(c), c->name);
        else
            answer_words(p->out, "    %s: %s%s", not_shown[kind], argument_of(c), c->name);
        before = ", ";
    }
    if (*before)
        answer_words(p->out, "\n");
}

void explain_conditioning(const page *p, const char *name, const influence_study *study) {
    char moves[100], of[180];
    bool headed = false;
    snprintf(moves, sizeof moves, "moves %s by", name);
    answer_items(p->out, "conditioning");
    for (size_t i = 0; i < study->count; i++) {
        const cause *c = &study->cause[i];
        const bool shown = c->influence == INFLUENCE_SHOWN;
        snprintf(of, sizeof of, "%s%s", argument_of(c), c->name);
        if (shown && !headed)
            answer_words(p->out, "    %-20s  last digit  %14s  condition number\n", "conditioning", moves);
        headed = headed || shown;
        answer_item(p->out);
        answer_string(p->out, "of", of);
        answer_number(p->out, "value", (double)c->v.v);
        if (shown)
            put_shown(p, c, of);
        else
            answer_string(p->out, "not shown", not_shown[c->influence]);
        answer_up(p->out);
    }
    answer_up(p->out);
    for (influence kind = INFLUENCE_SHOWN; kind-- > INFLUENCE_NONE;)
        put_others(p, study, kind);
}

/* ---- the page ---------------------------------------------------------------------------------- */

void explain_input(const page *p, const quantity *q) {
    calc *c = &p->sh->calc;
    value v = {0, quantity_dim(q, c->now)};
    calc_error *why = error_quiet();
    answer_page(p->out, "explain");
    explain_formula(p, q, false);
    const bool got = explain_had(p, quantity_get(q, c->now, &v.v, why), why);
    v.d = quantity_dim(q, c->now); /* which may follow from what is live */
    if (got)
        explain_value(p, q->name, strlen(q->name), v, q->unit);
    answer_done(p->out);
}

void explain_function(const page *p, const quantity *q) {
    answer_page(p->out, "explain");
    explain_formula(p, q, true);
    answer_group(p->out, "numbers");
    put_numbers(p, q, &(influence_study){.count = 0});
    answer_up(p->out);
    answer_done(p->out);
}

void explain_quantity(const page *p, const part *of, const expr *e, value v, const influence_study *study,
                      bool conditioning) {
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
        explain_conditioning(p, q->name, study);
    answer_done(p->out);
}
