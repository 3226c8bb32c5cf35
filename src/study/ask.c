/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Present values, steps, places and words of knobs. */
#include "study/ask.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

bool ask_present(calc *c, const knob *k, double *v) {
    long double now;
    if (!k->is_input) {
        const own_name *row = &c->names.row[k->name];
        *v = (double)row->v.v;
        return row->known && !row->definition;
    }
    if (!scene_get(c->now, k->in, &now, error_quiet()))
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

const long double ask_slope[ASK_SLOPES] = {3 / 4.0L, -3 / 20.0L, 1 / 60.0L};

bool ask_in_ratios(double lo, double hi) {
    return lo > 0 && hi > 0 && (hi >= 10 * lo || lo >= 10 * hi);
}

void ask_text(const knob *k, double v, char text[ASK_TEXT]) {
    char number[CALC_VALUE_TEXT];
    calc_value_text(k->d, v, number);
    snprintf(text, ASK_TEXT, "%s = %s", k->text, number);
}
