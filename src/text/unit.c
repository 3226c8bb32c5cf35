/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The tables of units, and parsing unit expressions. Depends on text/lex and number/real. */
#include "text/unit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "number/real.h"

/* The one table of units. */
static const struct {
    const char *name;
    bool prefixes;
    unit u;
    const char *meaning;
} units[] = {
    {"N", true, {{1, 0, 0, 0}, 0, 1}, "newton, force"},
    {"lbf", false, {{1, 0, 0, 0}, 0, 4.4482216152605L}, "pound-force"},
    {"kip", false, {{1, 0, 0, 0}, 3, 4.4482216152605L}, "1000 lbf"},
    {"kgf", false, {{1, 0, 0, 0}, 0, 9.80665L}, "kilogram-force"},
    {"gf", false, {{1, 0, 0, 0}, -3, 9.80665L}, "gram-force"},
    {"dyn", false, {{1, 0, 0, 0}, -5, 1}, "dyne, force"},
    {"Pa", true, {{1, -2, 0, 0}, 0, 1}, "pascal, pressure"},
    {"bar", false, {{1, -2, 0, 0}, 5, 1}, "bar, pressure"},
    {"psi", false, {{1, -2, 0, 0}, 0, 4.4482216152605L / (0.0254L * 0.0254L)}, "pound-force per square inch"},
    {"ksi", false, {{1, -2, 0, 0}, 3, 4.4482216152605L / (0.0254L * 0.0254L)}, "1000 psi"},
    {"m", true, {{0, 1, 0, 0}, 0, 1}, "metre, length"},
    {"inch", false, {{0, 1, 0, 0}, -4, 254}, "inch, length"},
    {"\xc3\x85", false, {{0, 1, 0, 0}, -10, 1}, "angstrom, length"},
    {"J", true, {{1, 1, 0, 0}, 0, 1}, "joule, energy"},
    {"kg", false, {{1, -1, 0, 2}, 0, 1}, "kilogram, mass"},
    {"s", true, {{0, 0, 0, 1}, 0, 1}, "second, time; elsewhere the name is free"},
    {"Hz", true, {{0, 0, 0, -1}, 0, 1}, "hertz, frequency"},
    {"rad", false, {{0, 0, 1, 0}, 0, 1}, "radian, angle"},
    {"deg", false, {{0, 0, 1, 0}, 0, FRET_PI / 180}, "degree, angle"},
    {"%", false, {{0, 0, 0, 0}, -2, 1}, "per cent"},
};
enum { UNITS = sizeof units / sizeof *units };

/* The signs for micro come last: they are read, but not offered. */
static const struct {
    const char *name;
    int exp10;
} prefixes[] = {{"", 0},  {"n", -9}, {"u", -6}, {"m", -3},        {"c", -2},
                {"k", 3}, {"M", 6},  {"G", 9},  {"\xc2\xb5", -6}, {"\xce\xbc", -6}};
enum { PREFIXES = sizeof prefixes / sizeof *prefixes, OFFERED = PREFIXES - 2 };

/* The prefix c is allowed for metres alone. */
static bool prefix_allowed(const char *prefix, const char *name) {
    return *prefix != 'c' || !strcmp(name, "m");
}

const char *unit_name(size_t i) {
    return i < UNITS ? units[i].name : NULL;
}

const char *unit_meaning(size_t i) {
    return units[i].meaning;
}

bool unit_prefixed(size_t i) {
    return units[i].prefixes;
}

const char *unit_prefix(size_t i) {
    return i < OFFERED ? prefixes[i].name : NULL;
}

bool unit_lookup(const char *word, size_t len, unit *out) {
    static const char sign[] = "\xe2\x84\xab"; /* U+212B, angstrom sign; the table has the letter U+00C5 */
    if (len == sizeof sign - 1 && !memcmp(word, sign, len))
        return unit_lookup("\xc3\x85", 2, out);
    for (size_t i = 0; i < UNITS; i++) {
        const size_t n = strlen(units[i].name), allowed = units[i].prefixes ? PREFIXES : 1;
        if (n > len || units[i].name[n - 1] != word[len - 1])
            continue;
        for (size_t j = 0; j < allowed; j++) {
            const size_t p = strlen(prefixes[j].name);
            if (p + n == len && !memcmp(prefixes[j].name, word, p) && !memcmp(units[i].name, word + p, n) &&
                prefix_allowed(prefixes[j].name, units[i].name)) {
                *out = units[i].u;
                out->exp10 += prefixes[j].exp10;
                return true;
            }
        }
    }
    return false;
}

static const char *prefixed_name(size_t i) {
    static const char *const common[] = {"N",  "kN",  "mN",  "uN",  "MN",   "lbf", "kgf", "dyn",
                                         "Pa", "kPa", "MPa", "GPa", "bar",  "psi", "ksi", "m",
                                         "mm", "um",  "nm",  "cm",  "inch", "J",   "mJ",  "uJ",
                                         "nJ", "kJ",  "rad", "deg", "kip",  "gf",  "kg",  "Hz"};
    return i < sizeof common / sizeof *common ? common[i] : NULL;
}

const char *unit_suggest(const char *word) {
    static const char *const other_names[][2] = {
        {"in", "inch"},    {"newton", "N"},  {"pascal", "Pa"},         {"metre", "m"},
        {"meter", "m"},    {"joule", "J"},   {"micron", "um"},         {"degree", "deg"},
        {"radian", "rad"}, {"percent", "%"}, {"angstrom", "\xc3\x85"}, {"lb", "lbf"},
        {"lbs", "lbf"},    {"kips", "kip"},  {"kilogram", "kg"},       {"hertz", "Hz"},
        {"second", "s"},   {"sec", "s"},     {"kpsi", "ksi"},          {"Nm", "N*m"},
        {"kNm", "kN*m"},   {"Nmm", "N*mm"},  {"millimetre", "mm"}};
    for (size_t i = 0; i < sizeof other_names / sizeof *other_names; i++) {
        const bool case_counts = strchr(other_names[i][1], '*') != NULL; /* nM is no moment */
        if (case_counts ? !strcmp(word, other_names[i][0]) : same_but_case(word, other_names[i][0]))
            return other_names[i][1];
    }
    return suggest(word, prefixed_name);
}

long double unit_scale(const unit *u) {
    static const long double powers[] = {1e-9L, 1e-8L, 1e-7L, 1e-6L, 1e-5L, 1e-4L, 1e-3L, 1e-2L, 1e-1L, 1,
                                         1e1L,  1e2L,  1e3L,  1e4L,  1e5L,  1e6L,  1e7L,  1e8L,  1e9L};
    if (u->exp10 >= -9 && u->exp10 <= 9)
        return powers[u->exp10 + 9] * u->factor;
    return powl(10, u->exp10) * u->factor;
}

bool dim_equal(dim a, dim b) {
    return fabs(a.N - b.N) < 1e-9 && fabs(a.m - b.m) < 1e-9 && fabs(a.s - b.s) < 1e-9;
}

/* dim_equal alone does not tell an angle from a number. */
static bool dim_is_angle(dim d) {
    return d.rad == 1 && dim_equal(d, DIM_NONE);
}

static const struct named {
    dim d;
    const char *unit, *phrase;
    bool prefixes;
} named[] = {
    {{0, 0, 1, 0}, "rad", "an angle", false}, /* find_named expects it first */
    {{0, 0, 0, 0}, "", "a number", false},
    {{1, 0, 0, 0}, "N", "a force", true},
    {{0, 1, 0, 0}, "m", "a length", true},
    {{1, -2, 0, 0}, "Pa", "a pressure", true},
    {{1, 1, 0, 0}, "J", "an energy", true},
    {{1, -1, 0, 0}, "N/m", "a stiffness", true},
    {{0, 2, 0, 0}, "m^2", "an area", false},
    {{0, -1, 0, 0}, "m^-1", "an inverse length", false},
    {{1, -1, 0, 2}, "kg", "a mass", false},
    {{1, -4, 0, 2}, "kg/m^3", "a density", false},
    {{0, 0, 0, 1}, "s", "a time", true},
    {{0, 0, 0, -1}, "Hz", "a frequency", true},
    {{0, 1, 0, -1}, "m/s", "a speed", true},
    {{0, 1, 0, -2}, "m/s^2", "an acceleration", false},
    {{1, 1, 0, -1}, "J/s", "a power", true},
    {{0, 3, 0, 0}, "m^3", "a volume", false},
    {{-1, 2, 0, 0}, "m^3/J", "a volume for an energy", false},
};
enum { NAMED = sizeof named / sizeof *named };

static const struct named *find_named(dim d) {
    for (size_t i = dim_is_angle(d) ? 0 : 1; i < NAMED; i++)
        if (dim_equal(d, named[i].d))
            return &named[i];
    return NULL;
}

void dim_unit(dim d, char *buf, size_t size) {
    const struct named *row = find_named(d);
    if (row) {
        snprintf(buf, size, "%s", row->unit);
        return;
    }
    const struct {
        const char *name;
        double power;
    } base[] = {{"N", d.N}, {"m", d.m}, {"s", d.s}};
    *buf = 0;
    for (size_t i = 0; i < sizeof base / sizeof *base; i++) {
        const double power = *buf && base[i].power < 0 ? -base[i].power : base[i].power;
        if (!(fabs(power) > 1e-9))
            continue;
        list_word(buf, size, base[i].power < 0 ? "/" : "*", base[i].name);
        if (fabs(power - 1) > 1e-9)
            text_add(buf, size, "^%.10g", power);
    }
}

void dim_describe(dim d, char *buf, size_t size) {
    const struct named *row = find_named(d);
    char unit_text[96];
    if (row) {
        snprintf(buf, size, "%s", row->phrase);
        return;
    }
    dim_unit(d, unit_text, sizeof unit_text);
    snprintf(buf, size, "a quantity in %s", unit_text);
}

long double unit_choose(dim d, long double value, int digits, char *buf, size_t size) {
    static const struct {
        const char *name;
        long double scale;
    } steps[] = {{"G", 1e9L},  {"M", 1e6L},  {"k", 1e3L},  {"", 1},
                 {"m", 1e-3L}, {"u", 1e-6L}, {"n", 1e-9L}, {"", 1e-12L}};
    enum { STEPS = sizeof steps / sizeof *steps - 1 }; /* the last has no prefix */
    if (dim_is_angle(d)) {
        snprintf(buf, size, "deg");
        return FRET_PI / 180;
    }
    dim_unit(d, buf, size);
    const struct named *row = find_named(d);
    if (!row || !row->prefixes || value == 0 || !isfinite(value))
        return 1;
    /* A value that would be printed as 1000 takes the next prefix. What is printed is the quotient as a
     * double; half[n]: half a unit of the n-th digit. */
    static const long double half[] = {0.5L,   5e-2L,  5e-3L,  5e-4L,  5e-5L,  5e-6L,
                                       5e-7L,  5e-8L,  5e-9L,  5e-10L, 5e-11L, 5e-12L,
                                       5e-13L, 5e-14L, 5e-15L, 5e-16L, 5e-17L, 5e-18L};
    long double edge = 1000 - 1000 * half[digits];
    size_t j = 0;
    while (j < STEPS && (double)(fabsl(value) / steps[j + 1].scale) < edge)
        j++;
    if (j == STEPS || fabsl(value) >= 1e12L)
        return 1;
    snprintf(buf, size, "%s%s", steps[j].name, row->unit);
    return steps[j].scale;
}

/* ---- parsing ----------------------------------------------------------------------------------- */

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

/* Parses one unit with its exponent. */
static bool unit_factor(lexer *lx, unit *out) {
    if (!unit_word(lx, out))
        return false;
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
        return lex_fail(lx, "a unit with two exponents is ambiguous: give it one");
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

/* `*` or `/` continues the unit only if a unit follows: in `2 N * F`, `* F` belongs to the expression. */
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
    if (times == power) /* a power of ten: numbers in the unit are rounded once */
        out->exp10 += (int)places;
    else
        out->factor *= times;
    return true;
}

size_t unit_number(const char *text, size_t len, char point, const unit *u, double *out) {
    const bool decimal = u->factor == 1;
    const size_t n = lex_decimal(text, len, point, decimal ? u->exp10 : 0, out);
    if (n > 0 && !decimal)
        *out = (double)(*out * unit_scale(u));
    return n;
}
