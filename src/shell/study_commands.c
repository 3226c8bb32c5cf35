/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Questions that go backwards: solve, maximize, minimize. They leave the scene as it is. */
#include "shell/study_commands.h"

#include <string.h>

#include "shell/expressions.h"
#include "shell/range.h"
#include "study/optimise.h"
#include "study/solve.h"

const char study_library[] = "";

/* ---- what they share --------------------------------------------------------------------------- */

/* Answers as printed values are, and remembered as `ans`. */
static bool print_answers(shell *sh, column *columns, const long double *si, size_t count,
                          calc_error *error) {
    if (!answer_values(&sh->set, sh->out, columns, si, count))
        return calc_no_memory(error);
    sh->calc.ans = (value){si[count - 1], columns[count - 1].d};
    sh->calc.has_ans = true;
    return true;
}

/* A knob where it was found, as a column. */
static bool knob_column(column *c, const knob *k, calc_error *error) {
    return column_si(c, k->text, k->d) || calc_no_memory(error);
}

/* ---- solve ------------------------------------------------------------------------------------- */

/* A side of the equation. What no scene moves has no use for `at`, which the other side was meant to have. */
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
        return lex_fail(lx, "%.*s is the same at any %s: `at` goes with the side before it",
                        LEX_SHOWN(e->len), e->text + e->at, q->name);
    return expr_read_at(&sh->calc, lx, e);
}

static bool read_solve(shell *sh, lexer *lx, solve_question *q) {
    sweep_range ends = {.lo = 0};
    if (!knob_read(&sh->calc, lx, &q->name))
        return false;
    if (!lex_accept(lx, "for"))
        return lex_fail(lx, "expected for EXPR = EXPR");
    if (!read_side(sh, lx, &sh->list[0]))
        return false;
    if (lx->kind != T_ASSIGN)
        return lex_fail(lx, "expected = EXPR: what should it be equal to?");
    lex_next(lx);
    if (!read_side(sh, lx, &sh->list[1]))
        return false;
    q->c = &sh->calc;
    q->left = &sh->list[0];
    q->right = &sh->list[1];
    q->given = lex_accept(lx, "from");
    if (q->given && !range_read_interval(&sh->calc, lx, &q->name, "to", &ends))
        return false;
    q->lo = (double)ends.lo;
    q->hi = (double)ends.hi;
    if (q->given)
        q->name.d = ends.d;
    return at_end(lx);
}

static void report_solve(shell *sh, const solve_question *q, const solve_answer *a) {
    char lo[CALC_VALUE_TEXT], hi[CALC_VALUE_TEXT];
    answer event;
    answer_begin(&event, &sh->set, sh->out);
    answer_event(&event, "solve");
    answer_string(&event, "method", "Brent");
    answer_number(&event, "evaluations", a->evaluations);
    answer_list(&event, "bracket", (const double[]){a->lo, a->hi}, 2);
    if (a->touches)
        answer_flag(&event, "touches", true);
    if (a->jumps)
        answer_flag(&event, "jumps", true);
    answer_done(&event);
    if (a->touches)
        shell_note(sh, "the two sides touch there without passing each other, which tells 8 digits at most");
    if (a->jumps)
        shell_note(sh, "elsewhere the two sides jump past each other; a root close to a jump may be hidden");
    if (!sh->set.timing)
        return;
    calc_value_text(q->name.d, a->lo, lo);
    calc_value_text(q->name.d, a->hi, hi);
    shell_say(sh, "solve: scan and Brent's method, %u evaluations, bracket %s = %s .. %s", a->evaluations,
              q->name.text, lo, hi);
}

bool do_solve(shell *sh, lexer *lx, const command *self) {
    range_names names = {.count = sh->calc.names.count};
    solve_question q;
    solve_answer a;
    column c = {.name = NULL};
    (void)self;
    bool ok = (lx->kind != T_NAME || range_wake(sh, lx, &names)) && read_solve(sh, lx, &q) &&
              solve(&q, &a, lx->error) && knob_column(&c, &q.name, lx->error);
    ok = ok && print_answers(sh, &c, &(long double){a.x}, 1, lx->error);
    if (ok)
        report_solve(sh, &q, &a);
    columns_free(&c, 1);
    range_forget(sh, &names);
    return ok;
}

/* ---- maximize, minimize ------------------------------------------------------------------------ */

/* The names stand behind the expression that uses them. */
static bool wake_over(shell *sh, const lexer *lx, range_names *names) {
    calc_error ignored;
    lexer scan = *lx;
    bool over = false, name = false;
    error_clear(&ignored);
    scan.error = &ignored;
    while (scan.kind != T_END) {
        if (name && scan.kind == T_NAME && scan.len < LEX_NAME && !range_wake(sh, &scan, names))
            return calc_no_memory(lx->error);
        name = lex_is(&scan, "over") || (over && scan.kind == T_COMMA);
        over = over || lex_is(&scan, "over");
        lex_next(&scan);
    }
    return true;
}

static bool read_over(shell *sh, lexer *lx, optimise_question *q) {
    if (!lex_accept(lx, "over"))
        return lex_fail(lx, "expected over NAME = LO .. HI");
    for (;;) {
        sweep_range ends = {.lo = 0};
        knob *k = &q->name[q->count];
        if (q->count == OPTIMISE_NAMES)
            return lex_fail(lx, "more than %d names", OPTIMISE_NAMES);
        const size_t at = lx->at;
        if (!knob_read(&sh->calc, lx, k))
            return false;
        if (ask_repeats(q->name, q->count + 1))
            return calc_fail(lx->error, at, lx->last - at, "%s is given twice", k->text);
        if (lx->kind != T_ASSIGN)
            return lex_fail(lx, "expected = LO .. HI after %s", k->text);
        lex_next(lx);
        const size_t from = lx->at;
        if (!range_read_interval(&sh->calc, lx, k, NULL, &ends))
            return false;
        if (!(ends.lo < ends.hi))
            return calc_fail(lx->error, from, lx->last - from, "an empty range: LO must be below HI");
        k->d = ends.d;
        q->lo[q->count] = (double)ends.lo;
        q->hi[q->count++] = (double)ends.hi;
        if (lx->kind != T_COMMA)
            return !lx->error->raised;
        lex_next(lx);
    }
}

static const char *const end_words[] = {"inner", "low", "high", "scene"};

static void report_optimum(shell *sh, const optimise_question *q, const optimise_answer *a,
                           const char *word) {
    answer event;
    answer_begin(&event, &sh->set, sh->out);
    answer_event(&event, word);
    answer_number(&event, "evaluations", a->evaluations);
    answer_flag(&event, "sharp", a->sharp);
    answer_group(&event, "ends");
    for (size_t i = 0; i < q->count; i++)
        answer_string(&event, q->name[i].text, end_words[a->end[i]]);
    answer_up(&event);
    answer_done(&event);
    bool inner = false, edge = false;
    for (size_t i = 0; i < q->count; i++) {
        char there[ASK_TEXT];
        ask_text(&q->name[i], a->x[i], there);
        inner = inner || a->end[i] == END_INNER;
        if (a->end[i] == END_SCENE && !edge)
            shell_note(sh, "the scene ends at %s: %s", there, a->why.text);
        edge |= a->end[i] == END_SCENE;
        if (a->end[i] == END_LOW || a->end[i] == END_HIGH)
            shell_note(sh, "no inner optimum in %s: %s is the %s end of its range", q->name[i].text, there,
                       a->end[i] == END_LOW ? "lower" : "upper");
    }
    if (sh->set.timing)
        shell_say(sh, "%s: grid, %s%s, %u evaluations", word,
                  q->count == 1 ? "Brent's method" : "simplex of Nelder and Mead",
                  a->sharp && inner ? ", Newton's method" : "", a->evaluations);
}

static bool optimum(shell *sh, lexer *lx, const command *self, bool most) {
    range_names names = {.count = sh->calc.names.count};
    optimise_question q = {.c = &sh->calc, .e = &sh->list[0], .most = most};
    optimise_answer a;
    column columns[OPTIMISE_NAMES + 1] = {{.name = NULL}}, optimised = {.name = NULL};
    long double si[OPTIMISE_NAMES + 1];
    bool ok = wake_over(sh, lx, &names) && read_one_expression(sh, lx, 0, &optimised) &&
              read_over(sh, lx, &q) && at_end(lx) && optimise(&q, &a, lx->error) &&
              column_fits(q.e, &optimised, (value){a.value, a.d}, lx->error);
    for (size_t i = 0; i < q.count && ok; i++) {
        ok = knob_column(&columns[i], &q.name[i], lx->error);
        si[i] = a.x[i];
    }
    columns[q.count] = optimised;
    si[q.count] = ok ? a.value : 0;
    ok = ok && print_answers(sh, columns, si, q.count + 1, lx->error);
    if (ok)
        report_optimum(sh, &q, &a, self->name);
    columns_free(columns, q.count + 1);
    range_forget(sh, &names);
    return ok;
}

bool do_maximize(shell *sh, lexer *lx, const command *self) {
    return optimum(sh, lx, self, true);
}

bool do_minimize(shell *sh, lexer *lx, const command *self) {
    return optimum(sh, lx, self, false);
}
