/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parsing units. Touches nothing but the lexer. */
#include "text/unit_text.h"

#include <math.h>

#include "number/real.h"

static bool unit_word(const lexer *lx, unit *u) {
    if (lx->kind == T_PERCENT)
        return unit_lookup("%", 1, u);
    if (lx->header && lex_is(lx, "in"))
        return unit_lookup("inch", 4, u);
    return lx->kind == T_NAME && unit_lookup(lx->text + lx->at, lx->len, u);
}

bool unit_at(const lexer *lx) {
    unit unused;
    return unit_word(lx, &unused);
}

/* mm^2^2: the unit or its exponent to the second power? */
static bool power_of_power(lexer *lx, size_t word, size_t at, double n) {
    const size_t len = lx->at - word, name = at - word;
    lex_next(lx);
    if (lx->kind != T_NUMBER)
        return lex_fail(lx, "the exponent of a unit must be a number");
    return calc_fail(lx->error, word, lx->at + lx->len - word,
                     "a unit with two exponents has two readings: write (1 %.*s)^%g, or %.*s^%g", (int)len,
                     lx->text + word, lx->number, (int)name, lx->text + word,
                     copysign(pow(fabs(n), lx->number), n));
}

/* One unit with its exponent. */
static bool unit_factor(lexer *lx, unit *out) {
    if (!unit_word(lx, out))
        return false;
    const size_t word = lx->at;
    lex_next(lx);
    if (lx->kind != T_POWER)
        return true;
    size_t at = lx->at;
    lex_next(lx);
    int sign = 1;
    if (lx->kind == T_MINUS) {
        sign = -1;
        lex_next(lx);
    }
    if (lx->kind != T_NUMBER)
        return calc_fail(lx->error, at, lx->at + lx->len - at, "the exponent of a unit must be a number");
    double n = sign * lx->number;
    lex_next(lx);
    if (lx->kind == T_POWER)
        return power_of_power(lx, word, at, n);
    out->d = dim_power(out->d, n);
    double exp10 = out->exp10 * n;
    out->factor = out->factor == 1 ? 1 : powl(out->factor, n);
    if (fabs(exp10) < 300 && exp10 == floor(exp10)) {
        out->exp10 = (int)exp10;
    } else {
        out->exp10 = 0;
        out->factor *= powl(10, exp10);
    }
    return true;
}

/* After a number, `* m` goes on with the unit only if m is a unit: quantities never are. */
bool unit_parse(lexer *lx, unit *out) {
    if (!unit_factor(lx, out)) {
        char word[LEX_NAME];
        if (lx->error->raised || lx->kind != T_NAME)
            return lx->error->raised ? false : lex_fail(lx, "expected a unit");
        lex_word(lx, word);
        const char *near = unit_suggest(word);
        return lex_fail(lx,
                        near ? "unknown unit '%s': did you mean %s?" : "unknown unit '%s'; try: help units",
                        word, near);
    }
    while (lx->kind == T_TIMES || lx->kind == T_DIVIDE) {
        lexer before = *lx;
        int sign = lx->kind == T_TIMES ? 1 : -1;
        unit u;
        lex_next(lx);
        if (lx->kind != T_NAME || !unit_word(lx, &u)) {
            *lx = before;
            break;
        }
        if (!unit_factor(lx, &u))
            return false;
        out->d = dim_product(out->d, dim_power(u.d, sign));
        out->exp10 += sign * u.exp10;
        out->factor = sign > 0 ? out->factor * u.factor : out->factor / u.factor;
    }
    return true;
}

bool unit_of_header(lexer *lx, unit *out) {
    const double times = lx->kind == T_NUMBER ? lx->number : 1, places = round(log10(times));
    double power = 0;
    lx->header = true;
    if (lx->kind == T_NUMBER)
        lex_next(lx);
    if (!(times > 0) || !unit_parse(lx, out) || lx->error->raised || lx->kind != T_END)
        return false;
    if (fabs(places) < 100)
        lex_decimal("1", 1, '.', (int)places, &power);
    if (times == power) /* numbers in it are rounded once */
        out->exp10 += (int)places;
    else
        out->factor *= times;
    return true;
}

/* The decimal scale of the unit goes into the exponent of the literal. */
size_t unit_number(const char *text, size_t len, char point, const unit *u, double *out) {
    const bool decimal = u->factor == 1;
    const size_t n = lex_decimal(text, len, point, decimal ? u->exp10 : 0, out);
    if (n > 0 && !decimal)
        *out = (double)(*out * unit_scale(u));
    return n;
}
