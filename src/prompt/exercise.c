/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command ask: a question to a learner, guesses at a terminal, the answer. Changes nothing. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "commands/expressions.h"
#include "prompt/prompt.h"
#include "statement/command.h"
#include "statement/progress.h"
#include "statement/record.h"

enum { CHOICES = 9 };

typedef struct exercise {
    shell *sh;
    char *text, *hint; /* hint: NULL if there is none */
    char *choice[CHOICES];
    unsigned choices;   /* 0: the answer is a value */
    unsigned right;     /* number of the right choice, from 1 */
    column column;      /* how the value is printed */
    value value;        /* the answer; of choices its number */
    long double within; /* the largest difference to the value that counts as right; of choices 0 */
} exercise;

/* ---- reading ----------------------------------------------------------------------------------- */

static void exercise_free(exercise *x) {
    free(x->text);
    free(x->hint);
    while (x->choices > 0)
        free(x->choice[--x->choices]);
    columns_free(&x->column, 1);
}

static bool read_choices(exercise *x, const lexer *lx, const given_clause *of) {
    lexer own = hole_lexer(lx, &of->hole[0]);
    do {
        if (x->choices)
            lex_next(&own);
        if (own.kind != T_STRING)
            return lex_fail(&own, "expected a choice in quotation marks");
        if (x->choices == CHOICES)
            return lex_fail(&own, "more than %d choices", CHOICES);
        if (!(x->choice[x->choices] = hole_text(&own, &(span){own.at, own.len})))
            return false;
        x->choices++;
        lex_next(&own);
    } while (own.kind == T_COMMA);
    x->value.v = x->right = of->count;
    if (!at_end(&own))
        return false;
    if (x->choices < 2)
        return calc_fail(lx->error, of->hole[0].at, of->hole[0].len, "expected two or more choices");
    return x->right <= x->choices ||
           calc_fail(lx->error, of->hole[1].at, of->hole[1].len, "there are %u choices", x->choices);
}

/* Reads the tolerance; one that ends in % is relative to the value. */
static bool read_within(exercise *x, const lexer *lx, const span *part) {
    lexer own = hole_lexer(lx, part);
    value v;
    if (!expr_value(&x->sh->calc, &own, &v))
        return false;
    const bool percent = own.text[own.last - 1] == '%';
    if (percent && x->value.v == 0)
        return calc_fail(lx->error, part->at, part->len,
                         "the answer is 0: give `within` as an amount, not in %%");
    if (percent)
        v = (value){v.v * fabsl(x->value.v), x->value.d};
    x->within = v.v;
    return value_dim(&own, x->column.name, part->at, part->len, v, x->value.d) &&
           (v.v > 0 || calc_fail(lx->error, part->at, part->len, "within must be positive")) && at_end(&own);
}

/* Names the answer "answer", where its expression is a mere number. */
static bool name_answer(exercise *x) {
    free(x->column.name);
    x->column.name = column_name("answer", 6);
    return x->column.name != NULL;
}

static bool read_value(exercise *x, const lexer *lx, parsed *all, const given_clause *equals) {
    shell *sh = x->sh;
    const given_clause *within = parsed_clause(all, "within", 0);
    lexer own = hole_lexer(lx, &equals->hole[0]);
    if (!within)
        return calc_fail(lx->error, lx->at, 0, "expected within 5 %%: how far off may a guess be?");
    const bool number = own.kind == T_NUMBER;
    return read_one_expression(sh, &own, &x->column) &&
           expr_eval(&sh->calc, &sh->list[0], &x->value, lx->error) &&
           column_fits(&sh->list[0], &x->column, x->value, lx->error) &&
           read_within(x, lx, &within->hole[0]) &&
           (!number || sh->list[0].count > 1 || name_answer(x) || calc_no_memory(lx->error));
}

static bool read_exercise(exercise *x, lexer *lx, parsed *all) {
    const given_clause *equals = parsed_clause(all, "=", 0), *of = parsed_clause(all, "of", 0),
                       *hint = parsed_clause(all, "hint", 0);
    if (!(x->text = hole_text(lx, &all->list[0].hole[0])) ||
        (hint && !(x->hint = hole_text(lx, &hint->hole[0]))))
        return false;
    if (of)
        return read_choices(x, lx, of);
    return equals ? read_value(x, lx, all, equals)
                  : lex_fail(lx, "what is the answer? = EXPR within 5 %%, or of \"A\", \"B\" = 2");
}

/* ---- guesses ----------------------------------------------------------------------------------- */

/* Replies go to the terminal, past transcripts; replays skip lines that begin so (in a terminal's copy). */
#define REPLY "guess: "
#define NUMBER_WANTED "the number of a choice is wanted"

static void reply(const char *text) {
    fputs(REPLY, stdout);
    print_safe(stdout, text, strlen(text));
    putc('\n', stdout);
}

static void reply_off(const exercise *x, long double guess) {
    static const long double far = 2;
    const long double correct = x->value.v, ratio = correct != 0 ? guess / correct : 0;
    const char *size = fabsl(guess) > fabsl(correct) ? "large" : "small";
    char text[80];
    if (correct == 0)
        snprintf(text, sizeof text, "too %s", guess > 0 ? "large" : "small");
    else if (ratio < 0)
        snprintf(text, sizeof text, "of the wrong sign");
    else if (ratio > far)
        snprintf(text, sizeof text, "too large, %.3Lg times the answer", ratio);
    else if (ratio > 0 && 1 / ratio > far)
        snprintf(text, sizeof text, "too small, the answer is %.3Lg times as much", 1 / ratio);
    else
        snprintf(text, sizeof text, "%.2Lg %% too %s", 100 * fabsl(ratio - 1), size);
    reply(text);
}

/* Reads a guess: an expression with the dimension of the answer. Else says why not, and returns false. */
static bool read_guess(exercise *x, const char *line, long double *guess) {
    calc_error *const error = error_quiet();
    lexer lx;
    value v;
    lex_start(&lx, line, strlen(line), error);
    const bool ok = !error->raised && expr_value(&x->sh->calc, &lx, &v) && at_end(&lx) &&
                    value_dim(&lx, x->choices ? "" : x->column.name, 0, strlen(line), v, x->value.d);
    if (!ok) {
        calc_word(&x->sh->calc, error);
        reply(x->choices ? NUMBER_WANTED : error->text);
    }
    *guess = ok ? v.v : 0;
    return ok;
}

/* Replies to a line; false: no further guess is wanted. */
static bool take_guess(exercise *x, const char *line) {
    long double guess;
    if (!*line)
        return false;
    if (!strcmp(line, "?")) {
        reply(x->hint ? x->hint : "there is no hint");
        return true;
    }
    if (!read_guess(x, line, &guess))
        return true;
    if (fabsl(guess - x->value.v) <= x->within * (1 + 1e-12L)) { /* so that rounding excludes no end */
        reply("right");
        return false;
    }
    if (!x->choices)
        reply_off(x, guess);
    else if (guess >= 1 && guess <= x->choices && guess == floorl(guess))
        reply("no");
    else
        reply(NUMBER_WANTED);
    return true;
}

/* Takes guesses until one is right, or an empty line, the end of the input or Ctrl-C. */
static void take_guesses(exercise *x) {
    const int depth = progress_suspend();
    bool more = true;
    fflush(x->sh->out);
    printf(REPLY "%s%s, or Enter for the answer\n", x->choices ? "a number" : "a value",
           x->hint ? ", ? for a hint" : "");
    while (more && !shell_stop) {
        char *line = prompt_line("guess> ", false);
        more = line && !shell_stop && take_guess(x, line + strspn(line, " \t"));
        free(line);
    }
    fflush(stdout);
    progress_resume(depth);
}

/* ---- answers ----------------------------------------------------------------------------------- */

static void tell(exercise *x, page_part part, const char *before, const char *text) {
    record_replace(x->sh, part, text);
    answer a;
    answer_begin(&a, &x->sh->set, x->sh->out);
    answer_words(&a, "%s%s\n", before, text);
    record_replaced(x->sh);
}

static void tell_question(exercise *x) {
    char number[16];
    tell(x, PAGE_QUESTION, "", x->text);
    for (unsigned i = 0; i < x->choices; i++) {
        snprintf(number, sizeof number, "    %u  ", i + 1);
        tell(x, PAGE_CHOICE, number, x->choice[i]);
    }
    if (!x->choices)
        record_replace(x->sh, PAGE_ROOM, "");
    record_replaced(x->sh);
}

static bool write_answer(exercise *x, const settings *set, FILE *to) {
    answer a;
    if (!x->choices && !answer_values(set, to, &x->column, &x->value.v, 1))
        return false;
    answer_begin(&a, set, to);
    if (x->choices)
        answer_words(&a, "answer: %u, %s\n", x->right, x->choice[x->right - 1]);
    answer_event(&a, "ask");
    answer_string(&a, "question", x->text);
    if (x->choices) {
        answer_items(&a, "of");
        for (unsigned i = 0; i < x->choices; i++)
            answer_string(&a, NULL, x->choice[i]);
        answer_up(&a);
        answer_number(&a, "answer", x->right);
    } else {
        answer_number(&a, "within", (double)x->within);
    }
    if (x->hint)
        answer_string(&a, "hint", x->hint);
    answer_done(&a);
    return true;
}

static bool tell_answer(exercise *x) {
    file_text text;
    if (!record_on_page(x->sh))
        return write_answer(x, &x->sh->set, x->sh->out);
    settings set = x->sh->set;
    set.format = FORMAT_TEXT;
    if (!file_text_open(&text))
        return false;
    bool ok = write_answer(x, &set, text.to);
    ok = file_text_close(&text) && ok;
    if (!ok)
        return false;
    text.text[strcspn(text.text, "\n")] = 0;
    record_replace(x->sh, PAGE_SOLUTION, text.text);
    ok = write_answer(x, &x->sh->set, x->sh->out);
    record_replaced(x->sh);
    free(text.text);
    return ok;
}

bool do_ask(shell *sh, lexer *lx, parsed *all) {
    exercise x = {.sh = sh};
    bool ok = read_exercise(&x, lx, all);
    if (ok) {
        tell_question(&x);
        if ((sh->interactive || sh->waits) && !answer_is_data(&sh->set) && isatty(STDOUT_FILENO) &&
            isatty(STDIN_FILENO))
            take_guesses(&x);
        ok = shell_stop ? calc_interrupted(lx->error) : tell_answer(&x) || calc_no_memory(lx->error);
    }
    exercise_free(&x);
    return ok;
}
