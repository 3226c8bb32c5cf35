/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reading ranges. */
#include "shell/range.h"

#include <string.h>

/* ---- names ------------------------------------------------------------------------------------- */

bool range_wake(shell *sh, const lexer *lx, range_names *out) {
    own_names *n = &sh->calc.names;
    size_t i;
    const char *text = lx->text + lx->at;
    if (quantity_find(text, lx->len) || name_taken(text, lx->len) || names_find(n, text, lx->len, &i))
        return true;
    if (!names_add(n, text, lx->len, &i))
        return calc_no_memory(lx->error);
    n->row[i].woken = i < out->count;
    n->row[i].known = true;
    return true;
}

bool range_names_find(shell *sh, lexer *lx, range_names *out, bool *found) {
    calc_error ignored;
    lexer scan = *lx;
    error_clear(&ignored);
    scan.error = &ignored;
    *out = (range_names){.count = sh->calc.names.count};
    *found = false;
    while (scan.kind != T_END) {
        const bool by_name = lex_is(&scan, "for"), along = lex_is(&scan, "along"),
                   with = lex_is(&scan, "with");
        lex_next(&scan);
        *found = *found || ((by_name || along) && scan.kind == T_NAME);
        if ((by_name || with) && scan.kind == T_NAME && scan.len < LEX_NAME && !range_wake(sh, &scan, out))
            return calc_no_memory(lx->error);
    }
    return true;
}

void range_forget(shell *sh, const range_names *names) {
    own_names *n = &sh->calc.names;
    names_drop(n, names->count);
    for (size_t i = 0; i < n->count; i++)
        if (n->row[i].woken)
            n->row[i].known = n->row[i].woken = false;
}

/* ---- for NAME = LO .. HI ----------------------------------------------------------------------- */

/* What the ends of a range, or the values of a list, have in common. A bare 0 is of any dimension. */
typedef struct bounds {
    dim d;
    bool known; /* the dimension: of an input, or of a value before that is no bare 0 */
    value v;    /* that one */
    size_t at, len;
} bounds;

static bool is_plain(dim d) {
    return dim_equal(d, DIM_NONE) && d.rad == 0;
}

static bool read_bound(calc *c, lexer *lx, const knob *var, bounds *b, long double *out) {
    value v;
    const size_t at = lx->at;
    if (!expr_value(c, lx, &v))
        return false;
    const size_t len = lx->last - at;
    *out = v.v;
    if (var->is_input)
        b->d = quantity_dim(quantity_of_input(var->in), c->now);
    else if (b->known && is_plain(b->d) && !is_plain(v.d))
        return value_dim(lx, var->text, b->at, b->len, b->v, v.d); /* 1 .. 3 mm */
    else if (!b->known)
        *b = (bounds){v.d, v.v != 0 || !is_plain(v.d), v, at, len};
    return value_dim(lx, var->text, at, len, v, b->d);
}

bool range_read_interval(calc *c, lexer *lx, const knob *var, const char *word, sweep_range *out) {
    bounds b = {.known = false};
    if (!read_bound(c, lx, var, &b, &out->lo))
        return false;
    if (word ? !lex_is(lx, word) : lx->kind != T_RANGE)
        return word ? lex_fail(lx, "expected %s and the other end of the range", word)
                    : lex_fail(lx, "expected .. between the two ends of the sweep");
    lex_next(lx);
    const bool ok = read_bound(c, lx, var, &b, &out->hi);
    out->d = b.d;
    return ok;
}

/* The range where a curve sees it. */
static bool evaluate_range(const sweep *s, sweep_range *out, calc_error *error) {
    const range *r = s->context;
    lexer lx = *r->statement;
    lx.error = error;
    lex_seek(&lx, r->at);
    if (!s->along)
        return range_read_interval(&r->sh->calc, &lx, &s->var, NULL, out);
    return s->what != ALONG_LOAD || read_load(r->sh, &lx, &out->step, &out->extra, out->bound);
}

static bool read_name(calc *c, lexer *lx, knob *out) {
    if (!knob_read(c, lx, out))
        return false;
    if (lx->kind != T_ASSIGN)
        return lex_fail(lx, "expected = after %s", out->text);
    lex_next(lx);
    return true;
}

static void begin(shell *sh, const lexer *lx, range *out) {
    *out = (range){.sweep = {.range = evaluate_range}, .sh = sh, .statement = lx};
    out->sweep.context = out;
}

bool range_read_along(shell *sh, lexer *lx, range *out) {
    sweep *s = &out->sweep;
    sweep_range load = {.lo = 0};
    begin(sh, lx, out);
    lex_next(lx);
    s->along = true;
    out->at = lx->at;
    if (lex_accept(lx, "program")) {
        s->what = ALONG_PROGRAM;
        return true;
    }
    if (lex_is(lx, "cycle") && lex_peek(lx) != T_NAME) {
        s->what = ALONG_CYCLE;
        lex_next(lx);
        return true;
    }
    if (lex_is(lx, "cycle")) {
        /* `along cycle steps 40` is the last period, `along cycle FA=..` a load */
        lexer ahead = *lx;
        lex_next(&ahead);
        s->what = at_argument(&ahead) ? ALONG_LOAD : ALONG_CYCLE;
        if (s->what == ALONG_CYCLE) {
            lex_next(lx);
            return true;
        }
    } else if (lex_is(lx, "step")) {
        s->what = ALONG_LOAD;
    } else {
        return lex_fail(lx, "along what? program, cycle, step ... or cycle ...");
    }
    bool ok = read_load(sh, lx, &load.step, &load.extra, load.bound);
    if (ok && load.step.points)
        s->steps = load.step.points;
    for (input in = 0; in < INPUTS; in++)
        counted_drop(load.bound[in]);
    return ok;
}

static bool read_with(shell *sh, lexer *lx, sweep *s) {
    if (s->curves)
        return lex_fail(lx, "with is given twice");
    lex_next(lx);
    const size_t at = lx->at, len = lx->len;
    if (!read_name(&sh->calc, lx, &s->with))
        return false;
    if (!strcmp(s->with.text, s->var.text))
        return calc_fail(lx->error, at, len, "%s is given twice", s->with.text);
    bounds b = {.known = false};
    do {
        if (s->curves == SWEEP_VALUES)
            return lex_fail(lx, "more than %d values", SWEEP_VALUES);
        if (s->curves)
            lex_next(lx);
        s->value_at[s->curves] = lx->at;
        lx->list = true;
        const bool ok = read_bound(&sh->calc, lx, &s->with, &b, &s->value[s->curves]);
        lx->list = false;
        if (!ok)
            return false;
        s->with.d = b.d;
        s->value_len[s->curves] = lx->last - s->value_at[s->curves];
        s->curves++;
    } while (lx->kind == T_COMMA);
    return !lx->error->raised;
}

/* `log x` is of the axes. */
static bool accept_log(lexer *lx) {
    lexer ahead = *lx;
    if (!lex_accept(&ahead, "log") || lex_is(&ahead, "x") || lex_is(&ahead, "y") || lex_is(&ahead, "xy"))
        return false;
    *lx = ahead;
    return true;
}

bool range_read_options(shell *sh, lexer *lx, sweep *s) {
    for (bool given = false;;) {
        unsigned steps;
        if (given && lex_is(lx, "steps")) {
            return lex_fail(lx, "steps is given twice");
        } else if (lex_accept(lx, "steps")) {
            if (!read_count(&sh->calc, lx, "steps", RANGE_STEPS, &steps))
                return false;
            s->steps = steps;
            s->refine = false;
            given = true;
        } else if (!s->along && accept_log(lx)) {
            s->log = true;
        } else if (lex_is(lx, "with")) {
            if (!read_with(sh, lx, s))
                return false;
        } else {
            return !lx->error->raised;
        }
    }
}

bool range_read(shell *sh, lexer *lx, range *out, size_t steps) {
    sweep *s = &out->sweep;
    sweep_range ends = {.lo = 0};
    if (lex_is(lx, "along")) {
        const bool ok = range_read_along(sh, lx, out);
        s->steps = s->steps ? s->steps : steps;
        return ok && range_read_options(sh, lx, s);
    }
    begin(sh, lx, out);
    s->steps = steps;
    if (!lex_accept(lx, "for"))
        return lex_fail(lx, "expected for VAR = LO .. HI");
    if (!read_name(&sh->calc, lx, &s->var))
        return false;
    out->at = lx->at;
    if (!range_read_interval(&sh->calc, lx, &s->var, NULL, &ends))
        return false;
    s->var.d = ends.d;
    const size_t at = lx->at;
    if (!range_read_options(sh, lx, s))
        return false;
    return !s->log || (ends.lo > 0 && ends.hi > 0) ||
           calc_fail(lx->error, at, 1, "a logarithmic sweep needs positive ends");
}

void note_missing(shell *sh, const sweep_job *job) {
    if (job->missing.raised)
        shell_note(sh, "some values are missing: %s (%s)", job->missing.text, job->where);
}
