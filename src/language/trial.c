/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scratch scenes for expressions, with inputs, names, the load or the instant changed. Uses `scene`. */
#include "language/trial.h"

#include <stdlib.h>
#include <string.h>

#include "number/array.h"

trial *trial_open(calc *c, calc_error *error) {
    trial *t = calloc(1, sizeof *t);
    if (!t) {
        calc_no_memory(error);
        return NULL;
    }
    t->c = c;
    t->outer = c->now;
    scene_clone(&t->scene, c->now);
    t->scene.sound = t->sound = c->now == &c->scene || c->now->sound;
    t->scene.used = 0;
    c->now = &t->scene;
    return t;
}

void trial_reset(trial *t) {
    const scene_use before = scene_answered_by(&t->scene);
    scene_free(&t->scene);
    scene_clone(&t->scene, t->outer);
    t->scene.sound = t->sound;
    t->scene.used = 0;
    scene_also_used(&t->scene, before);
}

void trial_close(trial *t) {
    if (!t)
        return;
    calc *c = t->c;
    scene_also_used(t->outer, scene_answered_by(c->now)); /* may be a scene of beside.c */
    c->now = t->outer;
    scene_take_wear(t->outer, &t->scene);
    scene_free(&t->scene);
    while (t->hidden_count > 0) {
        const struct hidden_name *h = &t->hidden[--t->hidden_count];
        names_restore(&c->names, h->index, &h->old);
    }
    free(t->hidden);
    free(t);
}

/* Saves the value of a name until the trial closes. */
static bool hide(trial *t, size_t name, calc_error *error) {
    for (size_t i = 0; i < t->hidden_count; i++)
        if (t->hidden[i].index == name)
            return true;
    if (!fret_array_room(&t->hidden, &t->hidden_room, t->hidden_count + 1, sizeof *t->hidden))
        return calc_no_memory(error);
    own_name *row = &t->c->names.row[name];
    t->hidden[t->hidden_count++] = (struct hidden_name){name, *row};
    row->definition = NULL; /* owned by the saved row */
    return true;
}

bool trial_set(trial *t, const knob *p, long double v, calc_error *error) {
    scene *s = &t->scene;
    if (!p->is_input) {
        if (!hide(t, p->name, error))
            return false;
        names_put(&t->c->names, p->name, (value){v, p->d}, NULL);
        if (s->in.bindings)
            scene_forget(s);
        return true;
    }
    if (!input_check(p->in, (double)v, error))
        return false;
    scene *outer = t->c->now;
    t->c->now = s;
    const bool takes = calc_takes(t->c, p->in, error); /* in this scene, not that of a definition */
    t->c->now = outer;
    if (!takes)
        return false;
    if (p->in == IN_FN && !s->end.steps) {
        const load_step press = {.kind = LOAD_PRESS, .normal = BY_FORCE, .normal_value = (double)v};
        return scene_append(s, &press, NULL, error);
    }
    scene_put(s, p->in, (double)v);
    return true;
}

bool trial_change(trial *t, const knob_value by[], size_t count, size_t *wrong, calc_error *error) {
    const instant *now = t->scene.now;
    size_t run = count;
    for (*wrong = 0; *wrong < count; ++*wrong) {
        const knob *p = &by[*wrong].p;
        if (!trial_set(t, p, by[*wrong].v, error))
            return false;
        if (run == count && (p->is_input || bindings_mention(t->c, &t->scene.in, p->text)))
            run = *wrong; /* the load depends on it */
    }
    if (!now || run == count)
        return true;
    if (!now->beside)
        return calc_fail(error, 0, 0,
                         "%s cannot be changed at an instant of a load: try along ... with %s = ...",
                         by[run].p.text, by[run].p.text);
    return beside_scene(now->beside, &t->scene, by, count, scene_time(t->outer), &t->c->now, error);
}

/* ---- knobs ------------------------------------------------------------------------------------- */

bool knob_read(calc *c, lexer *lx, knob *out) {
    const size_t at = lx->at, len = lx->len;
    return knob_name(c, lx, out) &&
           (!out->is_input || calc_takes(c, out->in, lx->error) || calc_place(lx->error, at, len));
}

bool knob_known(calc *c, lexer *lx, knob *out) {
    const char *name = lx->text + lx->at;
    size_t unused;
    if (lx->kind == T_NAME && lx->len < LEX_NAME && !quantity_find(name, lx->len) &&
        !name_taken(name, lx->len) && !names_find(&c->names, name, lx->len, &unused))
        return lex_fail(lx, "'%.*s' is no input and has no value", LEX_WORD(lx));
    return knob_read(c, lx, out);
}

bool knob_name(calc *c, lexer *lx, knob *out) {
    *out = (knob){.is_input = false};
    if (lx->kind != T_NAME)
        return lex_fail(lx, "expected a name");
    if (!lex_whole(lx, "a name that is changed", out->text))
        return false;
    const quantity *q = quantity_find(out->text, lx->len);
    if (q && !quantity_is_input(q))
        return lex_fail(lx, "%s is a result: only inputs and free names can be varied", out->text);
    if (q) {
        out->is_input = true;
        out->in = quantity_input(q);
        out->d = quantity_dim(q, c->now);
    } else {
        const char *taken = name_taken(out->text, lx->len);
        if (taken)
            return lex_fail(lx, "'%s' is %s: it cannot be varied", out->text, taken);
        if (!names_add(&c->names, out->text, lx->len, &out->name))
            return calc_no_memory(lx->error);
        if (c->names.row[out->name].known)
            out->d = c->names.row[out->name].v.d;
        c->names.row[out->name].known = true;
    }
    lex_next(lx);
    return true;
}

bool knob_apart(const knob *a, const knob *b, size_t at, size_t len, calc_error *error) {
    if (!strcmp(a->text, b->text))
        return calc_fail(error, at, len, "%s is given twice", b->text);
    return !a->is_input || !b->is_input || calc_apart(a->in, b->in, at, len, error);
}

/* ---- along a load ------------------------------------------------------------------------------ */

bool trial_along_span(trial *t, along_what what, load_mark from, double *first, double *last,
                      calc_error *error) {
    const scene *s = &t->scene;
    if (!s->end.steps)
        return calc_fail(error, 0, 0, "there is no load yet: press first (press FN=100 N)");
    *first = what == ALONG_LOAD ? program_time(s->program, from) : 0;
    *last = program_time(s->program, s->end);
    if (what != ALONG_CYCLE)
        return true;
    const size_t cycle = program_last_cycle(s->program, s->end);
    if (cycle == NO_CYCLE)
        return calc_fail(error, 0, 0, "no cycle has been run yet: cycle first (cycle FA=20 N)");
    *last = program_time(s->program, (load_mark){cycle + 1, s->end.cycles});
    *first = *last - 1;
    return true;
}

bool trial_along_between(trial_along *a, trial *t, double first, double last, size_t points, bool turns,
                         calc_error *error) {
    const bool lasts = last > first;
    *a = (trial_along){.t = t, .first = first, .last = last};
    const watch looks =
        watch_times(first, lasts ? (last - first) / (double)points : 1, lasts ? points : 0, turns);
    return trace_begin(&a->trace, &t->scene, looks, true, error);
}

bool trial_along_begin(trial_along *a, trial *t, along_what what, load_mark from, size_t points, bool turns,
                       calc_error *error) {
    double first, last;
    *a = (trial_along){.t = t};
    return trial_along_span(t, what, from, &first, &last, error) &&
           trial_along_between(a, t, first, last, points, turns, error);
}

bool trial_along_next(trial_along *a, calc_error *error) {
    do {
        if (!trace_next(&a->trace, error))
            return false;
        a->now = (instant){a->trace.run, a->trace.levels, &a->beside};
    } while (a->now.run->time < a->first || a->now.run->time > a->last);
    scene_look(&a->t->scene, &a->now);
    return true;
}

void trial_along_end(trial_along *a) {
    scene_look(&a->t->scene, NULL);
    trace_end(&a->trace);
    beside_end(&a->beside);
}
