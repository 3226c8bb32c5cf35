/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What readers of statements ask of the cursor. */
#include "statement/cursor.h"

#include <string.h>

#include "text/unit_text.h"

bool at_argument(const lexer *lx) {
    if (lx->kind != T_NAME)
        return false;
    token_kind next = lex_peek(lx);
    return next == T_ASSIGN || next == T_INCREMENT || next == T_DEFINE;
}

bool stray_unit(lexer *lx) {
    char word[LEX_NAME];
    unit known;
    if (lx->kind != T_NAME || lx->text[lx->last - 1] < '0' || lx->text[lx->last - 1] > '9' ||
        argument_word(lx) || at_argument(lx) || quantity_find(lx->text + lx->at, lx->len) ||
        unit_lookup(lx->text + lx->at, lx->len, &known))
        return false;
    lex_word(lx, word);
    const char *near = unit_suggest(word);
    lex_fail(lx, near ? "unknown unit '%s': did you mean %s?" : "unknown unit '%s'; try: help units", word,
             near);
    return true;
}

bool at_end(lexer *lx) {
    if (lx->kind == T_END)
        return !lx->error->raised;
    if (lex_is(lx, "to") || lex_is(lx, "as") || lex_is(lx, "into"))
        return lex_fail(lx, "unexpected '%.*s': units are asked for by `in` (a in mm)", LEX_WORD(lx));
    return stray_unit(lx) ? false : lex_fail(lx, "unexpected '%.*s'", LEX_WORD(lx));
}
