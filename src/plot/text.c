/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Converts texts of figures to the forms that gnuplot's terminals take. All escaping for gnuplot's markup and
 * for TeX is done here. Depends on script.h and text. */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "plot/script.h"
#include "text/characters.h"
#include "text/unit.h"

enum { THIN_SPACE = 0x2009 };

typedef struct writer {
    FILE *to;
    plot_form form;
    bool math; /* within $...$ of TeX */
} writer;

/* ---- characters --------------------------------------------------------------------------------- */

/* Symbols: how they are typed in ASCII and in TeX's math mode. */
static const struct symbol {
    unsigned code;
    const char *ascii, *tex;
} symbols[] = {{0xb0, "deg", "^\\circ"},
               {0xb2, "^2", "^2"},
               {0xb3, "^3", "^3"},
               {0xb5, "u", "\\mu"},
               {0xb7, "*", "\\cdot "},
               {0xd7, "x", "\\times "},
               {0x393, "Gamma", "\\Gamma "},
               {0x394, "d", "\\Delta "},
               {0x3b1, "alpha", "\\alpha "},
               {0x3b2, "beta", "\\beta "},
               {0x3b3, "gamma", "\\gamma "},
               {0x3b4, "d", "\\delta "},
               {0x3b5, "epsilon", "\\varepsilon "},
               {0x3b7, "eta", "\\eta "},
               {0x3b8, "theta", "\\theta "},
               {0x3ba, "kappa", "\\kappa "},
               {0x3bb, "lambda", "\\lambda "},
               {0x3bc, "u", "\\mu "},
               {0x3bd, "nu", "\\nu "},
               {0x3c0, "pi", "\\pi "},
               {0x3c1, "rho", "\\rho "},
               {0x3c3, "sigma", "\\sigma "},
               {0x3c4, "tau", "\\tau "},
               {0x3c6, "phi", "\\varphi "},
               {0x3c9, "omega", "\\omega "},
               {0x2009, " ", "\\,"},
               {0x2032, "'", "'"},
               {0x2033, "''", "''"},
               {0x2212, "-", "-"},
               {0x221a, "sqrt", "\\surd "},
               {0x2026, "...", "\\ldots "}};

static void put_tex(writer *w, unsigned c) {
    static const struct {
        char c;
        const char *tex;
    } special[] = {{'\\', "\\textbackslash{}"}, {'~', "\\textasciitilde{}"}, {'^', "\\textasciicircum{}"},
                   {'<', "\\textless{}"},       {'>', "\\textgreater{}"},    {'|', "\\textbar{}"},
                   {'"', "\\textquotedbl{}"},   {'`', "\\textasciigrave{}"}};
    for (size_t i = 0; i < sizeof special / sizeof *special; i++)
        if (c == (unsigned char)special[i].c) {
            /* \textquotedbl needs a font encoding that may not be loaded: '' is used instead */
            if (w->math && strchr("\\^", (int)c))
                fprintf(w->to, "\\mbox{%s}", special[i].tex);
            else
                fputs(c == '"' ? "''" : w->math ? (char[2]){special[i].c, 0} : special[i].tex, w->to);
            return;
        }
    if (strchr("#$%&_{}", (int)c))
        putc('\\', w->to);
    putc((int)c, w->to);
}

static void put_char(writer *w, const char *p, size_t n, unsigned c) {
    const struct symbol *s = NULL;
    for (size_t i = 0; n > 1 && i < sizeof symbols / sizeof *symbols; i++)
        if (symbols[i].code == c)
            s = &symbols[i];
    switch (w->form) {
    case PLOT_ASCII:
        if (n == 1)
            putc((int)c, w->to);
        else
            fputs(s ? s->ascii : "?", w->to);
        break;
    case PLOT_UNICODE:
        if (c == THIN_SPACE) /* not every terminal shows one */
            putc(' ', w->to);
        else
            fwrite(p, 1, n, w->to);
        break;
    case PLOT_ENHANCED:
        if (n == 1 && strchr("_^{}@&~\\", (int)c))
            putc('\\', w->to);
        fwrite(p, 1, n, w->to);
        break;
    default: /* TeX */
        if (n == 1)
            put_tex(w, c);
        else if (s)
            fprintf(w->to, w->math ? "%s" : "$%s$", s->tex);
        else
            fwrite(p, 1, n, w->to);
        break;
    }
}

static void put(writer *w, const char *text, size_t n) {
    unsigned c;
    for (size_t i = 0, step; i < n; i += step) {
        step = character_at(text + i, n - i, &c);
        if (!step || !character_shows(c)) {
            step = step ? step : 1;
            putc('?', w->to);
        } else {
            put_char(w, text + i, step, c);
        }
    }
}

static void puts_text(writer *w, const char *text) {
    put(w, text, strlen(text));
}

/* ---- names -------------------------------------------------------------------------------------- */

/* Names with a symbol of their own; others like x1 or F_A are split into letter and index. */
typedef struct glyph {
    const char *name, *base, *sub;
} glyph;

static const glyph glyphs[] = {
    {"FN", "F", "N"},      {"Fx", "F", "x"},          {"FA", "F", "A"},      {"FNA", "F", "N,A"},
    {"dz", "δ", "z"},      {"dx", "δ", "x"},          {"dxA", "δ", "x,A"},   {"dxmax", "δ", "x,max"},
    {"drig", "δ", "rig"},  {"drigA", "δ", "rig,A"},   {"K_rig", "K", "rig"}, {"d0", "δ", "0"},
    {"dz0", "δ", "z,0"},   {"dx0max", "δ", "x,0max"}, {"dW", "ΔW", ""},      {"dWd", "ΔW", ""},
    {"W1D", "W", "1D"},    {"w1D", "w", "1D"},        {"u1D", "u", "1D"},    {"s1D", "s", "1D"},
    {"qz1D", "q", "z,1D"}, {"qx1D", "q", "x,1D"},     {"qx", "q", "x"},      {"uz", "u", "z"},
    {"ux", "u", "x"},      {"cN", "c", "N"},          {"cT", "c", "T"},      {"hN", "h", "N"},
    {"hT", "h", "T"},      {"kn", "k", "n"},          {"kt", "k", "t"},      {"E0_2", "E", "0,2"},
    {"nu", "ν", ""},       {"nu_2", "ν", "2"},        {"mu", "μ", ""},       {"kappa", "κ", ""},
    {"eta", "η", ""},      {"beta_k", "β", "k"},      {"phase", "φ", ""},    {"Ksec", "K", "sec"},
    {"Kp", "K′", ""},      {"Kpp", "K″", ""},         {"pi", "π", ""},       {"time", "t", ""}};

/* Functions and words set upright. */
static const struct {
    const char *name, *shown;
} words[] = {{"sqrt", "√"}, {"gamma", "Γ"}, {"beta", "B"}, {"loss_factor", "loss factor"}};

static void italic(writer *w, const char *text, size_t n) {
    bool enhanced = w->form == PLOT_ENHANCED;
    if (enhanced)
        fputs("{/:Italic ", w->to);
    put(w, text, n);
    if (enhanced)
        putc('}', w->to);
}

static void upright(writer *w, const char *text, size_t n) {
    if (w->math)
        fputs("\\mathrm{", w->to);
    put(w, text, n);
    if (w->math)
        putc('}', w->to);
}

/* A part between commas that is one small letter is a variable, in italics; others are words or numbers. */
static void subscript(writer *w, const char *sub) {
    bool marked = w->form == PLOT_ENHANCED || w->form == PLOT_TEX;
    if (!*sub)
        return;
    if (marked)
        fputs("_{", w->to);
    for (;; sub++) {
        size_t n = strcspn(sub, ",");
        if (n == 1 && islower((unsigned char)*sub))
            italic(w, sub, n);
        else
            upright(w, sub, n);
        sub += n;
        if (!*sub)
            break;
        putc(',', w->to);
    }
    if (marked)
        putc('}', w->to);
}

static void put_name(writer *w, const char *name, size_t n) {
    for (size_t i = 0; i < sizeof glyphs / sizeof *glyphs; i++)
        if (strlen(glyphs[i].name) == n && !strncmp(glyphs[i].name, name, n)) {
            italic(w, glyphs[i].base, strlen(glyphs[i].base));
            subscript(w, glyphs[i].sub);
            return;
        }
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strlen(words[i].name) == n && !strncmp(words[i].name, name, n)) {
            upright(w, words[i].shown, strlen(words[i].shown));
            return;
        }
    char index[16];
    const bool line = n > 2 && name[1] == '_'; /* F_A */
    size_t digits = 1;
    while (digits < n && isdigit((unsigned char)name[digits]))
        digits++;
    if ((line || digits == n) && n < sizeof index) { /* x, x1 */
        snprintf(index, sizeof index, "%.*s", (int)(n - 1 - line), name + 1 + line);
        italic(w, name, 1);
        subscript(w, index);
    } else {
        upright(w, name, n);
    }
}

/* ---- expressions -------------------------------------------------------------------------------- */

static bool is_name(char c) {
    return isalpha((unsigned char)c) || c == '_';
}

static size_t name_length(const char *p, const char *end) {
    size_t n = 0;
    while (p + n < end && (is_name(p[n]) || isdigit((unsigned char)p[n])))
        n++;
    return n;
}

/* 12, 0.5, 1e-6 */
static size_t number_length(const char *p, const char *end) {
    double unused;
    return lex_decimal(p, (size_t)(end - p), '.', 0, &unused);
}

/* Writes an exponent, by markup or in superscript digits. */
static void superscript(writer *w, const char *p, size_t n) {
    static const char *const small[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    if (w->form == PLOT_UNICODE) {
        for (size_t i = 0; i < n; i++)
            fputs(p[i] == '-' ? "⁻" : small[p[i] - '0'], w->to);
        return;
    }
    bool tex = w->form == PLOT_TEX && !w->math;
    fputs(tex ? "$^{" : "^{", w->to);
    for (size_t i = 0; i < n; i++)
        if (p[i] == '-')
            puts_text(w, "−");
        else
            putc(p[i], w->to);
    fputs(tex ? "}$" : "}", w->to);
}

/* Bytes of an exponent that superscript() can show: nothing but a number, and in Unicode an integer only. */
static size_t exponent_length(const writer *w, const char *p, const char *end) {
    size_t sign = p < end && *p == '-', n = sign;
    while (p + n < end && (isdigit((unsigned char)p[n]) || (p[n] == '.' && w->form != PLOT_UNICODE)))
        n++;
    bool cut = p + n < end && strchr(".^eE", p[n]);
    return n > sign && !cut ? n : 0;
}

/* Writes the name of a unit: µ for the prefix u, ° for deg, in for inch. */
static void put_unit_name(writer *w, const char *p, size_t n) {
    if (n == 3 && !strncmp(p, "deg", 3)) {
        puts_text(w, "°");
    } else if (n == 4 && !strncmp(p, "inch", 4)) {
        upright(w, "in", 2);
    } else if (n > 1 && *p == 'u') {
        puts_text(w, "µ");
        upright(w, p + 1, n - 1);
    } else {
        upright(w, p, n);
    }
}

static void put_unit(writer *w, const char *p, const char *end) {
    while (p < end) {
        size_t n = name_length(p, end), e = *p == '^' ? exponent_length(w, p + 1, end) : 0;
        if (n) {
            put_unit_name(w, p, n);
        } else if (e) {
            superscript(w, p + 1, e);
            n = 1 + e;
        } else if (*p == '*') {
            puts_text(w, "·");
            n = 1;
        } else {
            n = character_at(p, (size_t)(end - p), NULL);
            n = n ? n : 1;
            put(w, p, n);
        }
        p += n;
    }
}

/* Bytes of a unit such as N/mm^2 that follows a number. */
static size_t unit_length(const char *p, const char *end) {
    lexer lx;
    unit unused;
    lex_start(&lx, p, (size_t)(end - p), error_quiet());
    return unit_parse(&lx, &unused) ? lx.last : 0;
}

/* Would the product at p read as another one without a sign, as in x*-1, 2*3 and a/b*c? */
static bool needs_sign(const char *begin, const char *p, const char *end) {
    const char *next = p + 1 + strspn(p + 1, " ");
    size_t i = (size_t)(p - begin);
    int depth = 0;
    if (next < end && strchr("0123456789+-.", *next))
        return true;
    while (i > 0 && depth >= 0 && (depth || !strchr("/+-,", begin[i - 1])))
        depth += begin[--i] == ')' ? 1 : begin[i] == '(' ? -1 : 0;
    return i > 0 && !depth && begin[i - 1] == '/';
}

static void put_operator(writer *w, const char *begin, const char *p, const char *end) {
    if (*p == '*')
        puts_text(w, needs_sign(begin, p, end) ? "·" : "\u2009");
    else if (*p == '-')
        puts_text(w, "−");
    else if (*p == ' ' && w->math)
        fputs("\\ ", w->to);
    else
        put(w, p, 1);
}

static void put_expression(writer *w, const char *p, const char *end) {
    const char *begin = p;
    bool after_number = false;
    w->math = w->form == PLOT_TEX;
    if (w->math)
        putc('$', w->to);
    while (p < end) {
        size_t number = number_length(p, end), name = name_length(p, end);
        size_t measure = after_number && name ? unit_length(p, end) : 0;
        size_t e = *p == '^' ? exponent_length(w, p + 1, end) : 0, n = 1;
        if (number) {
            put(w, p, n = number);
        } else if (measure) {
            put_unit(w, p, p + (n = measure));
        } else if (name) {
            put_name(w, p, n = name);
        } else if (e) {
            superscript(w, p + 1, e);
            n = 1 + e;
        } else if ((unsigned char)*p < 0x80) {
            put_operator(w, begin, p, end);
        } else {
            n = character_at(p, (size_t)(end - p), NULL);
            n = n ? n : 1;
            put(w, p, n);
        }
        after_number = number || (after_number && *p == ' ');
        p += n;
    }
    if (w->math)
        putc('$', w->to);
    w->math = false;
}

/* ---- texts -------------------------------------------------------------------------------------- */

char *plot_text(const char *text, plot_form form) {
    file_text made;
    if (!file_text_open(&made))
        return NULL;
    writer w = {.to = made.to, .form = form};
    /* some of gnuplot's TeX terminals take a bracket at the beginning as an option */
    if (form == PLOT_TEX && *text)
        fputs("\\relax ", w.to);
    while (*text) {
        char mark = *text == *PLOT_EXPR || *text == *PLOT_UNIT ? *text : 0;
        size_t n = strcspn(text + (mark != 0), PLOT_EXPR PLOT_UNIT PLOT_END);
        text += mark != 0;
        if (!mark || form == PLOT_ASCII) /* as typed */
            put(&w, text, n);
        else if (mark == *PLOT_EXPR)
            put_expression(&w, text, text + n);
        else
            put_unit(&w, text, text + n);
        text += n + (text[n] == *PLOT_END);
    }
    return file_text_close(&made) ? made.text : NULL;
}

char *plot_label(const char *expression, const char *of) {
    const bool has = of && *of;
    file_text made;
    if (!file_text_open(&made))
        return NULL;
    if (*expression)
        fprintf(made.to, PLOT_EXPR "%s" PLOT_END "%s", expression, has ? " " : "");
    if (has)
        fprintf(made.to, "[" PLOT_UNIT "%s" PLOT_END "]", of);
    return file_text_close(&made) ? made.text : NULL;
}
