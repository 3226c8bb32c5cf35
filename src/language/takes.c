/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks of assignments: does the scene use the input; has the value its dimension? Changes nothing. */
#include <ctype.h>
#include <string.h>

#include "language/calc.h"

bool calc_takes(const calc *c, input in, calc_error *error) {
    const scene *s = c->now;
    const quantity *q = quantity_of_input(in);
    if (in >= IN_N) {
        if (!s->in.geometry)
            return calc_fail(error, 0, 0,
                             "there is no geometry yet: give one first (geometry sphere R=10 mm)");
        const geometry *g = s->in.geometry;
        if (inputs_take(&s->in, in))
            return true;
        char usage[160];
        takes_text(g->takes, usage, sizeof usage);
        if (geometry_takes(g, in)) /* h and r0 */
            return calc_fail(error, 0, 0, "geometry %s was given by A, not by %s (%s %s)", g->name, q->name,
                             g->name, usage);
        return calc_fail(error, 0, 0, "%s is no parameter of geometry %s (%s %s)", q->name, g->name, g->name,
                         usage);
    }
    if (INPUT_BIT(in) & INPUT_PRESS)
        return (s->end.steps ? press_input((load_by)s->program->steps[0].normal) == in : in == IN_FN) ||
               calc_fail(error, 0, 0,
                         q->imposed ? "%s is a result here: press by it to make it an input (press %s=...)"
                                    : "the press was not given as %s: press again (press %s=...)",
                         q->name, q->name);
    if (in == IN_D0 || in == IN_F0)
        return inputs_any(&s->in, INPUT_BIT(IN_K_RIG)) || calc_missing(error, IN_K_RIG);
    if (in == IN_NW && !inputs_any(&s->in, INPUT_BIT(IN_ALPHA_W)))
        return calc_missing(error, IN_ALPHA_W);
    if (!(INPUT_BIT(in) & INPUT_CYCLE))
        return true;
    if (!s->end.cycles)
        return calc_fail(error, 0, 0, "%s needs a cycle: run one first (cycle FA=20 N)", q->name);
    const load_by by = cycle_by(&s->in);
    return cycle_input(by) == in || !(INPUT_BIT(in) & INPUT_AMPLITUDE) ||
           calc_fail(error, 0, 0, "the last cycle was given by %s: %s, not %s",
                     by == BY_FORCE ? "force"
                     : by == BY_RIG ? "displacement at the rig"
                                    : "displacement",
                     quantity_of_input(cycle_input(by))->name, q->name);
}

bool calc_apart(input one, input other, size_t at, size_t len, calc_error *error) {
    if (!(inputs_replaced(one) & INPUT_BIT(other)))
        return true;
    if (one == IN_A || other == IN_A)
        return calc_fail(error, at, len, "give either A or both h and r0");
    return calc_fail(error, at, len, "give either %s or %s", quantity_of_input(one)->name,
                     quantity_of_input(other)->name);
}

/* Does the text name a unit of angle? atan() returns radians that also count as a number. */
static bool says_angle(const char *text, size_t len) {
    for (size_t i = 0, n; i < len; i += n + !n) {
        for (n = 0; i + n < len && isalpha((unsigned char)text[i + n]); n++)
            ;
        unit u;
        if (n && unit_lookup(text + i, n, &u) && u.d.rad != 0)
            return true;
    }
    return false;
}

bool value_dim(lexer *lx, const char *name, size_t at, size_t len, value v, dim d) {
    if (v.d.N == d.N && v.d.m == d.m && v.d.s == d.s && d.rad == 0 && v.d.rad == 0) /* the common case */
        return true;
    const bool plain = dim_equal(v.d, DIM_NONE) && v.d.rad == 0;
    const bool angle = d.rad != 0, both = angle == (v.d.rad != 0); /* a length may contain an angle */
    const bool apart = angle || (dim_equal(d, DIM_NONE) && len && says_angle(lx->text + at, len));
    if ((dim_equal(v.d, d) && (both || !apart)) || (v.v == 0 && plain))
        return true;
    size_t from, all;
    if (plain && lx->kind == T_COMMA && lx->last == at + len && lex_decimal_comma(lx, lx->at, &from, &all))
        return lex_one_value(lx); /* FN = 1,5 N */
    if (angle && plain)
        return calc_fail(lx->error, at, len, "%s needs a unit: it is an angle, in deg or rad", name);
    char want[128], got[128], unit_text[128];
    dim_describe(d, want, sizeof want);
    dim_describe(v.d, got, sizeof got);
    dim_unit(d, unit_text, sizeof unit_text);
    if (plain)
        return calc_fail(lx->error, at, len, "%s needs a unit: it is %s%s%s", name, want,
                         strstr(want, unit_text) ? "" : ", in ", strstr(want, unit_text) ? "" : unit_text);
    const bool line = dim_equal(d, DIM_FORCE) && dim_equal(v.d, DIM_STIFFNESS);
    return calc_fail(lx->error, at, len, "%s is %s, not %s (%.*s)%s", name, want, got, LEX_SHOWN(len),
                     lx->text + at, line ? ": line contact is not axisymmetric and cannot be computed" : "");
}
