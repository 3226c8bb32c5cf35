/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads lists of expressions, names and equations into the session's storage. */
#include "commands/expressions.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "language/trial.h"
#include "text/unit.h"

static bool read_unit(lexer *lx, column *c) {
    const size_t at = lx->at;
    unit u;
    if (c->chosen)
        return lex_fail(lx, "the unit is given twice");
    if (lx->error->raised || !unit_parse(lx, &u))
        return false;
    const size_t len = lx->last - at;
    c->chosen = true;
    c->scale = unit_scale(&u);
    c->d = u.d;
    snprintf(c->unit, sizeof c->unit, "%.*s", (int)(len < sizeof c->unit ? len : sizeof c->unit - 1),
             lx->text + at);
    return true;
}

static bool read_column(shell *sh, lexer *lx, expr *e, column *c) {
    *c = (column){.scale = 1};
    if (!expr_parse(&sh->calc, lx, e))
        return false;
    c->name = column_name(lx->text + e->at, e->len);
    c->row = expr_unit(e);
    if (!c->name)
        return calc_no_memory(lx->error);
    for (;;) {
        if (lex_is(lx, "at")) {
            if (!expr_read_at(&sh->calc, lx, e))
                return false;
        } else if (!lex_accept(lx, "in")) {
            return !lx->error->raised;
        } else if (!read_unit(lx, c)) {
            return false;
        }
    }
}

bool read_expression(shell *sh, lexer *lx, size_t i, column *c) {
    lx->list = true; /* a comma may follow */
    const bool ok = read_column(sh, lx, &sh->list[i], c);
    lx->list = false;
    return ok;
}

bool read_one_expression(shell *sh, lexer *lx, column *c) {
    return read_column(sh, lx, &sh->list[0], c) && at_end(lx);
}

/* Notes that `1,5 mm` is two values, since a decimal comma may have been meant. */
static void note_comma(shell *sh, const lexer *lx) {
    const char *comma = lx->text + lx->at;
    size_t from, len;
    if (*sh->calc.note || !lex_decimal_comma(lx, lx->at, &from, &len) || memchr(lx->text + from, '.', len))
        return;
    const int before = (int)(lx->at - from), behind = (int)strspn(comma + 1, "0123456789");
    snprintf(sh->calc.note, sizeof sh->calc.note,
             "the comma in %.*s,%.*s parts two values: write %.*s.%.*s for one", before, comma - before,
             behind, comma + 1, before, comma - before, behind, comma + 1);
}

bool read_expressions(shell *sh, lexer *lx, column *columns, size_t limit, size_t *count) {
    for (;;) {
        if (*count == limit)
            return lex_fail(lx, "more than %zu expressions", limit);
        const size_t i = (*count)++;
        if (!read_expression(sh, lx, i, &columns[i]))
            return false;
        if (lx->kind != T_COMMA)
            return !lx->error->raised;
        note_comma(sh, lx);
        lex_next(lx);
    }
}

bool read_expressions_in(shell *sh, const lexer *lx, const span *part, column *columns, size_t limit,
                         size_t *count) {
    lexer own = hole_lexer(lx, part);
    *count = 0;
    return read_expressions(sh, &own, columns, limit, count) && at_end(&own);
}

bool read_name(shell *sh, lexer *lx, bool known, size_t most, knob *names, size_t *count) {
    knob *k = &names[*count];
    const size_t at = lx->at;
    if (*count == most)
        return lex_fail(lx, "more than %zu names", most);
    if (!(known ? knob_known : knob_read)(&sh->calc, lx, k))
        return false;
    for (size_t i = 0; i < *count; i++)
        if (!knob_apart(&names[i], k, at, lx->last - at, lx->error))
            return false;
    ++*count;
    return true;
}

/* Reads a side of the equation. An `at` behind a constant is an error: it was meant for the other side. */
static bool read_side(shell *sh, lexer *lx, expr *e) {
    bool call;
    size_t at;
    if (!expr_parse(&sh->calc, lx, e))
        return false;
    if (!lex_is(lx, "at"))
        return !lx->error->raised;
    lexer next = *lx;
    lex_next(&next);
    const quantity *q = quantity_find(next.text + next.at, next.len);
    if (q && !expr_quantity(e, 0, &call, &at) && !expr_definition(&sh->calc, e, 0))
        return lex_fail(lx, "%.*s is the same at any %s: put `at` behind the side that does",
                        LEX_SHOWN(e->len), e->text + e->at, q->name);
    return expr_read_at(&sh->calc, lx, e);
}

bool read_sides(shell *sh, const lexer *lx, const given_clause *equation) {
    for (int i = 0; i < 2; i++) {
        lexer own = hole_lexer(lx, &equation->hole[i]);
        if (!read_side(sh, &own, &sh->list[i]) || !at_end(&own))
            return false;
    }
    return true;
}

bool column_fits(const expr *e, column *c, value v, calc_error *error) {
    if (c->chosen && !dim_equal(c->d, v.d)) {
        char is[128];
        dim_describe(v.d, is, sizeof is);
        error->strange = true;
        return calc_fail(error, e->at, e->len, "%s is %s: it cannot be shown in %s", c->name, is, c->unit);
    }
    if (c->chosen && fabsl(v.v / c->scale) > DBL_MAX)
        return calc_fail(error, e->at, e->len, "%s is too large for double precision in %s", c->name,
                         c->unit);
    c->d = v.d;
    if (!c->chosen)
        dim_unit(v.d, c->unit, sizeof c->unit);
    return true;
}
