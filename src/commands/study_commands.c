/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Questions that go backwards: solve, maximize, minimize. They leave the scene as it is. */
#include "commands/study_commands.h"

#include <string.h>

#include "commands/expressions.h"
#include "commands/range.h"
#include "study/optimise.h"
#include "study/solve.h"

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

/* All of the hole. */
static bool read_side_in(shell *sh, const lexer *lx, const span *part, expr *e) {
    lexer own = hole_lexer(lx, part);
    return read_side(sh, &own, e) && at_end(&own);
}

static bool read_solve(shell *sh, const lexer *lx, said *all, solve_question *q) {
    sweep_range ends = {.lo = 0};
    const heard *equation = said_of(all, "for", 0), *from = said_of(all, "from", 0);
    lexer own = hole_lexer(lx, &all->list[0].hole[0]);
    if (!knob_read(&sh->calc, &own, &q->name) || !read_side_in(sh, lx, &equation->hole[0], &sh->list[0]) ||
        !read_side_in(sh, lx, &equation->hole[1], &sh->list[1]))
        return false;
    q->c = &sh->calc;
    q->left = &sh->list[0];
    q->right = &sh->list[1];
    q->given = from;
    if (!from)
        return true;
    own = hole_lexer(lx, &from->hole[0]);
    if (!range_read_interval(&sh->calc, &own, &q->name, "to", &ends) || !at_end(&own))
        return false;
    q->lo = (double)ends.lo;
    q->hi = (double)ends.hi;
    q->name.d = ends.d;
    return true;
}

static void report_solve(shell *sh, const solve_question *q, const solve_answer *a) {
    char lo[CALC_VALUE_TEXT], hi[CALC_VALUE_TEXT];
    answer event;
    answer_begin(&event, &sh->set, sh->out);
    answer_event(&event, "solve");
    answer_string(&event, "method", "secant");
    answer_number(&event, "evaluations", a->evaluations);
    answer_items(&event, "bracket");
    answer_number(&event, NULL, a->lo);
    answer_number(&event, NULL, a->hi);
    answer_up(&event);
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
    shell_say(sh, "solve: scan and secant, %u evaluations, bracket %s = %s .. %s", a->evaluations,
              q->name.text, lo, hi);
}

bool do_solve(shell *sh, lexer *lx, const command *self) {
    said all;
    solve_question q = {.given = false};
    solve_answer a;
    column c = {.name = NULL};
    if (!said_read(sh, lx, command_form(self), &all))
        return false;
    bool ok = read_solve(sh, lx, &all, &q) && solve(&q, &a, lx->error) && knob_column(&c, &q.name, lx->error);
    ok = ok && print_answers(sh, &c, &(long double){a.x}, 1, lx->error);
    if (ok)
        report_solve(sh, &q, &a);
    columns_free(&c, 1);
    said_drop(sh, &all);
    return ok;
}

/* ---- maximize, minimize ------------------------------------------------------------------------ */

static bool read_over(shell *sh, const lexer *lx, said *all, optimise_question *q) {
    const heard *h;
    for (size_t i = 0; (h = said_of(all, "over", i)); i++) {
        sweep_range ends = {.lo = 0};
        knob *k = &q->name[q->count];
        const span *name = &h->hole[0], *ends_at = &h->hole[1];
        lexer own = hole_lexer(lx, name);
        if (q->count == OPTIMISE_NAMES)
            return lex_fail(&own, "more than %d names", OPTIMISE_NAMES);
        if (!knob_read(&sh->calc, &own, k))
            return false;
        if (ask_repeats(q->name, q->count + 1))
            return calc_fail(lx->error, name->at, name->len, "%s is given twice", k->text);
        own = hole_lexer(lx, ends_at);
        if (!range_read_interval(&sh->calc, &own, k, NULL, &ends) || !at_end(&own))
            return false;
        if (!(ends.lo < ends.hi))
            return calc_fail(lx->error, ends_at->at, ends_at->len, "an empty range: LO must be below HI");
        k->d = ends.d;
        q->lo[q->count] = (double)ends.lo;
        q->hi[q->count++] = (double)ends.hi;
    }
    return true;
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
                  q->count == 1 ? "golden section" : "simplex of Nelder and Mead",
                  a->sharp && inner ? ", Newton's method" : "", a->evaluations);
}

static bool optimum(shell *sh, lexer *lx, const command *self, bool most) {
    said all;
    optimise_question q = {.c = &sh->calc, .e = &sh->list[0], .most = most};
    optimise_answer a;
    column columns[OPTIMISE_NAMES + 1] = {{.name = NULL}}, optimised = {.name = NULL};
    long double si[OPTIMISE_NAMES + 1];
    if (!said_read(sh, lx, command_form(self), &all))
        return false;
    lexer own = hole_lexer(lx, &all.list[0].hole[0]);
    bool ok = read_one_expression(sh, &own, 0, &optimised) && read_over(sh, lx, &all, &q) &&
              optimise(&q, &a, lx->error) && column_fits(q.e, &optimised, (value){a.value, a.d}, lx->error);
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
    said_drop(sh, &all);
    return ok;
}

bool do_maximize(shell *sh, lexer *lx, const command *self) {
    return optimum(sh, lx, self, true);
}

bool do_minimize(shell *sh, lexer *lx, const command *self) {
    return optimum(sh, lx, self, false);
}
