/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Trials that count, and tell that they are at work. Reads and prints nothing. */
#include "study/ask.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "number/real.h"

bool ask_open(ask *q, calc *c, const knob *knobs, size_t count, calc_error *error) {
    *q = (ask){.c = c, .knobs = knobs, .count = count, .error = error};
    q->t = trial_open(c, error);
    return q->t != NULL;
}

void ask_close(ask *q) {
    calc_word(q->c, q->error);
    trial_close(q->t);
    q->t = NULL;
}

bool ask_failed(ask *q, const calc_error *error) {
    if (error->stop || error->strange || error->circle) {
        *q->error = *error;
        return false;
    }
    q->none = *error;
    calc_word(q->c, &q->none);
    return false;
}

bool ask_set(ask *q, const double x[]) {
    calc_error error;
    error_clear(&error);
    if (q->error->raised || calc_stopped(q->c->scene.stop, q->error))
        return false;
    q->evaluations++;
    error_clear(&q->none);
    for (size_t i = 0; i < q->count; i++)
        if (!trial_set(q->t, &q->knobs[i], x[i], &error))
            return ask_failed(q, &error);
    return true;
}

bool ask_value(ask *q, const expr *e, dim *d, bool *known, long double *out) {
    calc_error error;
    value v;
    error_clear(&error);
    if (q->error->raised)
        return false;
    if (q->c->scene.pulse)
        q->c->scene.pulse();
    if (!expr_eval(q->c, e, &v, &error))
        return ask_failed(q, &error);
    if (*known && !dim_equal(v.d, *d)) {
        q->error->strange = true;
        return calc_fail(q->error, e->at, e->len, "%.*s has no dimension of its own: it changes on the way",
                         LEX_SHOWN(e->len), e->text + e->at);
    }
    *known = true;
    *d = v.d;
    *out = v.v;
    return true;
}

bool ask_repeats(const knob *knobs, size_t count) {
    for (size_t i = 0; i + 1 < count; i++)
        if (!strcmp(knobs[i].text, knobs[count - 1].text))
            return true;
    return false;
}

bool ask_present(calc *c, const knob *k, double *v) {
    long double now;
    calc_error ignored;
    error_clear(&ignored);
    if (!k->is_input) {
        const own_name *row = &c->names.row[k->name];
        *v = (double)row->v.v;
        return row->known && !row->definition;
    }
    if (!scene_get(c->now, k->in, &now, &ignored))
        return false;
    *v = (double)now;
    return true;
}

bool ask_lacks(const calc *c, const knob *k, const char *what_for, const char *advice, calc_error *error) {
    const definition *d = k->is_input ? NULL : (const definition *)c->names.row[k->name].definition;
    if (!d)
        return calc_fail(error, 0, 0, "%s has no value%s%s", k->text, what_for, advice);
    if (d->parameters)
        return calc_fail(error, 0, 0, "%s is a function: it has no value%s%s", k->text, what_for, advice);
    return calc_fail(error, 0, 0, "%s has no value of its own%s (it follows %s := %.*s)%s", k->text, what_for,
                     k->text, LEX_SHOWN(strlen(d->text)), d->text, advice);
}

double ask_step(double part, double x, double scale) {
    return part * fmax(fabs(x), scale);
}

double ask_grid(double lo, double hi, bool log, unsigned i, unsigned last) {
    const long double part = (long double)i / last;
    if (i == 0 || i == last)
        return i ? hi : lo;
    return (double)(log ? lo * fret_pow((long double)hi / lo, part) : lo + ((long double)hi - lo) * part);
}

bool ask_in_ratios(double lo, double hi) {
    return lo > 0 && hi > 0 && (hi >= 10 * lo || lo >= 10 * hi);
}

void ask_text(const knob *k, double v, char text[ASK_TEXT]) {
    char number[CALC_VALUE_TEXT];
    calc_value_text(k->d, v, number);
    snprintf(text, ASK_TEXT, "%s = %s", k->text, number);
}
