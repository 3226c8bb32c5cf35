/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reading arguments by the rows that describe them. Changes nothing. */
#include "shell/args.h"

#include <string.h>

#include "calc/unit_text.h"

/* ---- small things ------------------------------------------------------------------------------ */

static bool read_value(calc *c, lexer *lx, arg_value *v) {
    v->value_at = lx->at;
    bool ok = expr_value(c, lx, &v->v) && !stray_unit(lx);
    v->value_len = lx->last - v->value_at;
    return ok;
}

static bool read_number(calc *c, lexer *lx, const arg *a, arg_value *v) {
    return read_value(c, lx, v) && ((dim_equal(v->v.d, DIM_NONE) && v->v.v > 0 && v->v.v <= a->most) ||
                                    calc_fail(lx->error, v->value_at, v->value_len,
                                              "the seconds must be a positive number up to %u", a->most));
}

void args_drop(const arg_list *list, arg_value v[ARGS]) {
    for (const arg *a = list->args; a->kind; a++) {
        counted_drop(v[a - list->args].live);
        v[a - list->args].live = NULL;
    }
}

void args_note_idle(shell *sh, const arg_list *list, const arg_value v[ARGS]) {
    for (const arg *a = list->args; a->kind; a++)
        for (const arg *other = list->args; a->beside && other->kind; other++)
            if (!strcmp(other->name, a->beside) && v[a - list->args].given && !v[other - list->args].given)
                shell_note(sh, "%s does nothing without %s", a->name, a->beside);
}

/* ---- NAME = EXPR ------------------------------------------------------------------------------- */

static bool unknown_argument(lexer *lx, const arg_list *list) {
    return calc_fail(lx->error, lx->at, lx->len, "%s has no %s '%.*s'; usage: %s %s", list->who, list->noun,
                     LEX_WORD(lx), list->command, list->usage);
}

static bool not_taken(lexer *lx, const arg_list *list, const arg *a, token_kind how) {
    return calc_fail(lx->error, lx->at, lx->len, "%s does not take %s by %s; usage: %s %s", list->who,
                     a->name, how == T_DEFINE ? ":=" : "+=", list->command, list->usage);
}

static const arg *find(const lexer *lx, const arg_list *list, arg_kind kind) {
    const arg *a = list->args;
    while (a->kind && !(a->kind == kind && lex_is(lx, a->name)))
        a++;
    return a->kind ? a : NULL;
}

/* Twice the same, or another of its group. */
static bool twice(lexer *lx, const arg_list *list, const arg *a, const arg_value out[ARGS]) {
    if (out[a - list->args].given) {
        calc_fail(lx->error, lx->at, lx->len, "%s is given twice", a->name);
        return true;
    }
    for (const arg *other = list->args; a->group && other->kind; other++)
        if (other->group == a->group && out[other - list->args].given) {
            calc_fail(lx->error, lx->at, lx->len, "two targets in one direction");
            return true;
        }
    return false;
}

static bool in_range(lexer *lx, const arg *a, const arg_value *v) {
    fret_status st = {FRET_NOT_POSITIVE, a->name, (double)v->v.v, 0};
    if (a->flags & ARG_OWN_DIM) {
        char unit_text[128];
        dim_unit(a->d, unit_text, sizeof unit_text);
        return v->v.v > 0 ||
               calc_fail(lx->error, v->value_at, v->value_len, "%s = %.6Lg%s%s must be positive", a->name,
                         v->v.v, *unit_text ? " " : "", unit_text);
    }
    if (a->in && !v->increment) {
        st = input_status((input)(a->in - 1), (double)v->v.v);
        return calc_input_status(lx->error, a->in - 1, &st) || arg_place(lx->error, v);
    }
    if (a->flags & ARG_NONZERO && v->v.v == 0)
        return calc_fail(lx->error, v->value_at, v->value_len, "%s must not be 0", a->name);
    if (!(a->flags & ARG_POSITIVE) || v->v.v > 0)
        return true;
    calc_status(lx->error, &st);
    return arg_place(lx->error, v);
}

static bool read_named(shell *sh, lexer *lx, const arg_list *list, const arg *a, token_kind how,
                       arg_value *v) {
    if (!a)
        return unknown_argument(lx, list);
    if ((how == T_INCREMENT && !(a->flags & ARG_INCREMENT)) || (how == T_DEFINE && !(a->flags & ARG_LIVE)))
        return not_taken(lx, list, a, how);
    const dim d = a->in && !(a->flags & ARG_OWN_DIM) ? quantity_of_input((input)(a->in - 1))->d : a->d;
    v->at = lx->at;
    v->len = lx->len;
    v->increment = how == T_INCREMENT;
    lex_next(lx);
    lex_next(lx);
    if (how == T_DEFINE) {
        v->value_at = lx->at;
        bool ok = calc_bind(&sh->calc, lx, (input)(a->in - 1), &v->live);
        v->value_len = lx->last - v->value_at;
        v->given = ok;
        return ok;
    }
    v->given = read_value(&sh->calc, lx, v) && value_dim(lx, a->name, v->value_at, v->value_len, v->v, d) &&
               in_range(lx, a, v);
    return v->given;
}

/* ---- the rest ---------------------------------------------------------------------------------- */

static bool read_choice(lexer *lx, const arg *a, arg_value *v) {
    char word[LEX_NAME];
    const char *name;
    const size_t len = choice_at(lx);
    snprintf(word, sizeof word, "%.*s", LEX_SHOWN(len), lx->text + lx->at);
    for (v->choice = 0; (name = a->words(v->choice)); v->choice++)
        if (!strcmp(name, word)) {
            v->at = lx->at;
            v->len = len;
            lex_seek(lx, lx->at + len);
            return v->given = true;
        }
    lx->len = len;
    const char *near = suggest(word, a->words);
    char list[CALC_ERROR_TEXT - 64] = "";
    for (size_t i = 0; i < 7; i++)
        snprintf(list + strlen(list), sizeof list - strlen(list), "%s%s", i ? ", " : "", a->words(i));
    if (a->words(7))
        snprintf(list + strlen(list), sizeof list - strlen(list), ", ...");
    return lex_fail(lx, near ? "unknown %s '%s': did you mean %s?" : "unknown %s '%s' (%s)", a->name, word,
                    near ? near : list);
}

/* What may only come first. */
static bool read_first(shell *sh, lexer *lx, const arg_list *list, arg_value out[ARGS], char *file) {
    const arg *a = list->args;
    arg_value *v = &out[0];
    const bool named = at_argument(lx);
    switch (a->kind) {
    case ARG_CHOICE:
        return lx->kind != T_NAME || named || read_choice(lx, a, v);
    case ARG_EXPR:
        if (named && lex_is(lx, a->name)) {
            if (lex_peek(lx) != T_ASSIGN)
                return not_taken(lx, list, a, lex_peek(lx));
            lex_next(lx);
            lex_next(lx);
        }
        v->given = read_value(&sh->calc, lx, v) &&
                   value_dim(lx, a->name, v->value_at, v->value_len, v->v, a->d) && in_range(lx, a, v);
        return v->given;
    case ARG_FILE:
        v->value_at = lx->at;
        v->given = lex_filename(lx, file, ARG_FILE_NAME);
        v->value_len = lx->last - v->value_at;
        return v->given;
    default:
        return true;
    }
}

static bool read_keyword(shell *sh, lexer *lx, const arg_list *list, arg_value out[ARGS], bool *found) {
    const arg *a = list->args;
    *found = false;
    for (; a->kind; a++)
        if ((a->kind == ARG_COUNT || a->kind == ARG_NUMBER || a->kind == ARG_WORD) && lex_is(lx, a->name))
            break;
    if (!a->kind)
        return true;
    arg_value *v = &out[a - list->args];
    *found = true;
    if (twice(lx, list, a, out))
        return false;
    v->at = lx->at;
    v->len = lx->len;
    lex_next(lx);
    v->value_at = lx->at;
    switch (a->kind) {
    case ARG_COUNT:
        v->given = read_count(&sh->calc, lx, a->name, a->most, &v->count);
        break;
    case ARG_NUMBER:
        v->given = read_number(&sh->calc, lx, a, v);
        break;
    default:
        v->given = true;
        break;
    }
    v->value_len = lx->last - v->value_at;
    return v->given;
}

bool args_read_some(shell *sh, lexer *lx, const arg_list *list, arg_value out[ARGS], char *file) {
    for (const arg *a = list->args; a->kind; a++) { /* the rest is for those that are given */
        arg_value *v = &out[a - list->args];
        v->given = v->increment = false;
        v->live = NULL;
    }
    if (!read_first(sh, lx, list, out, file))
        return false;
    for (bool found = true; found && lx->kind == T_NAME;) {
        const token_kind how = lex_peek(lx);
        if (how == T_ASSIGN || how == T_INCREMENT || how == T_DEFINE) {
            const arg *a = find(lx, list, ARG_VALUE);
            if (a && twice(lx, list, a, out))
                return false;
            if (!read_named(sh, lx, list, a, how, &out[a ? a - list->args : 0]))
                return false;
        } else if (!read_keyword(sh, lx, list, out, &found)) {
            return false;
        }
    }
    return !lx->error->raised;
}

bool args_end(lexer *lx, const arg_list *list) {
    char word[LEX_NAME];
    if (lx->kind == T_COMMA)
        return lex_fail(lx, "unexpected ',': blanks part the arguments of %s", list->command);
    if (lx->kind != T_NAME)
        return at_end(lx);
    lex_word(lx, word);
    for (const arg *a = list->args; a->kind; a++)
        if ((a->kind == ARG_COUNT || a->kind == ARG_NUMBER || a->kind == ARG_WORD) &&
            one_letter_apart(word, a->name))
            return lex_fail(lx, "unexpected '%s': did you mean %s?", word, a->name);
    return at_end(lx);
}

bool args_read(shell *sh, lexer *lx, const arg_list *list, arg_value out[ARGS], char *file) {
    return (args_read_some(sh, lx, list, out, file) && args_end(lx, list)) || (args_drop(list, out), false);
}
