/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parses the grammar lines of rows. Uses the table of quantities. */
#include "statement/grammar.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/quantity.h"
#include "text/words.h"

/* Arguments that are not the name of a quantity. */
static const struct {
    const char *name;
    dim d;
    value_must must;
    int in; /* as in `clause` */
} others[] = {{"angle", {0, 0, 1, 0}, ANY, 0},
              {"half_angle", {0, 0, 1, 0}, ANY, 0},
              {"R1", {0, 1, 0, 0}, CURVED, 0},
              {"R2", {0, 1, 0, 0}, CURVED, 0},
              {"D", {0, 1, 0, 0}, POSITIVE, 0},
              {"G", {1, -2, 0, 0}, ANY, 1 + IN_G0},
              {"stiffness", {1, -1, 0, 0}, ANY, 1 + IN_K_RIG},
              {"stress", {1, -2, 0, 0}, ANY, 1 + IN_SB},
              {"alpha", {-1, 2, 0, 0}, ANY, 1 + IN_ALPHA_W},
              {"K", {0, 0, 0, 0}, POSITIVE, 0},
              {"H", {1, -2, 0, 0}, POSITIVE, 0}};

typedef struct parsing {
    grammar *out;
    const hole_row *holes;
    const char *p;
    clause *open;           /* the clause that the next hole belongs to, or NULL */
    bool bracket;           /* within [ ] */
    unsigned groups, first; /* number of the present group, index of its first clause */
    bool after_bar;         /* the next clause begins another alternative */
} parsing;

static bool is_capital(char c) {
    return c >= 'A' && c <= 'Z';
}

static size_t word_length(const char *p) {
    return strcspn(p, " []");
}

static clause *add_clause(parsing *g, const char *name, size_t len) {
    grammar *f = g->out;
    if (f->count == CLAUSES || len >= CLAUSE_NAME)
        return NULL;
    clause *a = &f->clause[f->count++];
    *a = (clause){
        .optional = g->bracket, .alternative = g->after_bar ? a[-1].alternative + 1 : 0, .group = g->groups};
    if (!g->after_bar && f->count - 1 > g->first)
        a->alternative = a[-1].alternative;
    memcpy(a->name, name, len);
    a->text = name;
    a->len = len;
    g->after_bar = false;
    return a;
}

/* NAME=, NAME:= or NAME+=, and the example behind it, up to the next clause. */
static bool parse_argument(parsing *g, size_t n) {
    const char *equals = memchr(g->p, '=', n);
    const bool marked = equals > g->p && strchr(":+", equals[-1]);
    const size_t len = (size_t)(equals - g->p) - marked;
    clause *a = add_clause(g, g->p, len);
    const quantity *q = quantity_find(g->p, len);
    if (!a)
        return false;
    static const hole_row argument = {.kind = HOLE_VALUE};
    a->argument = true;
    a->hole[a->holes++].row = &argument;
    a->live = marked && equals[-1] == ':';
    a->increment = marked && equals[-1] == '+';
    g->open = NULL;
    size_t other = 0;
    while (!q && other < sizeof others / sizeof *others && strcmp(others[other].name, a->name) != 0)
        other++;
    if (!q && other == sizeof others / sizeof *others)
        return false;
    a->d = q ? q->d : others[other].d;
    if (!q) {
        a->must = others[other].must;
        a->in = others[other].in;
    } else if (!a->increment && quantity_is_input(q)) {
        a->in = 1 + (int)quantity_input(q); /* of an increment the load checks the sum */
    } else if (!a->increment) {
        a->must = POSITIVE;
    }
    for (g->p += n; *g->p == ' '; g->p += n) {
        n = word_length(g->p + 1) + 1;
        if (n == 1 || g->p[1] == '|' || memchr(g->p, '=', n))
            break;
    }
    return !a->live || a->in;
}

static bool parse_clauses(parsing *g, const hole_row *row);

static bool parse_hole(parsing *g, size_t n, char before) {
    size_t len = 0;
    const hole_row *row = g->holes;
    while (len < n && (is_capital(g->p[len]) || g->p[len] == '_'))
        len++;
    while (row->name && (strlen(row->name) != len || strncmp(row->name, g->p, len)))
        row++;
    if (!row->name)
        return false;
    if (row->kind == HOLE_CLAUSES) {
        g->p += n;
        g->open = NULL;
        return parse_clauses(g, row);
    }
    clause *a = g->open ? g->open : add_clause(g, g->p, 0);
    if (!a || a->holes == CLAUSE_HOLES)
        return false;
    g->open = a;
    hole *h = &a->hole[a->holes++];
    *h = (hole){.row = row, .least = 1, .before = before};
    if (g->p[len] == ':') {
        char *end;
        h->most = (unsigned)strtoul(g->p + len + 1, &end, 10);
        if (*end == '.') {
            h->least = h->most;
            h->most = (unsigned)strtoul(end + 2, NULL, 10);
        }
    }
    if (row->kind == HOLE_VALUE) {
        const quantity *q = quantity_find(row->noun, strlen(row->noun));
        if (!q || !quantity_is_input(q))
            return false;
        a->d = q->d;
        a->in = 1 + (int)quantity_input(q);
    }
    g->p += n;
    if (row->kind == HOLE_SPAN &&
        (!strncmp(g->p, " .. ", 4) || !strncmp(g->p, " to ", 4))) /* the other end */
        g->p += 4 + word_length(g->p + 4);
    if (g->p[-1] == ',' && !strncmp(g->p, " ...", 4))
        a->list = true;
    if (!strncmp(g->p, " ...", 4)) {
        a->again = row->kind == HOLE_WORD;
        g->p += 4;
    }
    a->len = (size_t)(g->p - a->text);
    return true;
}

/* The clauses since the last bracket are a group, if | has parted them into alternatives. */
static void close_group(parsing *g) {
    grammar *f = g->out;
    const bool several = f->count > g->first && f->clause[f->count - 1].alternative > 0;
    for (unsigned i = g->first; i < f->count; i++)
        f->clause[i].group = several ? g->groups : 0;
    g->groups++;
    g->first = f->count;
    g->open = NULL;
}

static bool parse_word(parsing *g) {
    const size_t n = word_length(g->p);
    char before = 0;
    if (g->open && !strncmp(g->p, "= ", 2))
        before = '=';
    else if (g->open && !strncmp(g->p, "+- ", 3))
        before = '+';
    if (before) {
        g->p += n + 1;
        return is_capital(*g->p) && parse_hole(g, word_length(g->p), before);
    }
    const bool equals = !strncmp(g->p, "= ", 2);
    if (!equals && memchr(g->p, '=', n))
        return parse_argument(g, n);
    if (is_capital(*g->p))
        return parse_hole(g, n, 0);
    if ((!equals && (*g->p < 'a' || *g->p > 'z')) || !(g->open = add_clause(g, g->p, n)))
        return false;
    g->p += n;
    return true;
}

static bool parse_all(parsing *g) {
    while (*g->p) {
        const char c = *g->p;
        if (c == ' ') {
            g->p++;
        } else if (c == '[' && !g->bracket) {
            close_group(g);
            g->bracket = true;
            g->p++;
        } else if (c == ']' && g->bracket && g->out->count > g->first && !g->after_bar) {
            const bool again = *++g->p == '*';
            for (unsigned i = g->first; i < g->out->count; i++)
                g->out->clause[i].again = again;
            g->p += again;
            close_group(g);
            g->bracket = false;
        } else if (c == '|' && g->p[1] == ' ' && g->out->count > g->first && !g->after_bar) {
            g->after_bar = true;
            g->open = NULL;
            g->p++;
        } else if (!parse_word(g)) {
            return false;
        }
    }
    if (g->bracket || g->after_bar)
        return false;
    close_group(g);
    return true;
}

static bool parse_clauses(parsing *g, const hole_row *row) {
    parsing inner = *g;
    close_group(&inner);
    inner.bracket = false;
    for (size_t i = 0; (inner.p = row->words(i)); i++)
        if (!parse_all(&inner))
            return false;
    g->groups = inner.groups;
    g->first = inner.first;
    g->open = NULL;
    return true;
}

bool grammar_parse(grammar *out, const hole_row *holes, const char **at) {
    parsing g = {.out = out, .holes = holes, .p = out->takes, .groups = 1};
    out->count = 0;
    const bool ok = parse_all(&g);
    *at = g.p;
    return ok;
}

const clause *grammar_clause(const grammar *f, const char *name) {
    for (const clause *a = f->clause; a < f->clause + f->count; a++)
        if (!strcmp(a->name, name))
            return a;
    return NULL;
}

const hole_row *grammar_first(const grammar *f, hole_kind kind) {
    for (const clause *a = f->clause; a < f->clause + f->count && !*a->name; a++)
        if (a->hole[0].row->kind == kind)
            return a->hole[0].row;
    return NULL;
}

void grammar_usage(const grammar *f, char buf[GRAMMAR_USAGE]) {
    int n = snprintf(buf, GRAMMAR_USAGE, "%s%s%s%s", f->command, f->shape ? " " : "",
                     f->shape ? f->shape : "", *f->takes ? " " : "");
    takes_text(f->takes, buf + n, GRAMMAR_USAGE - (size_t)n);
}

bool add_usage(calc_error *error, const grammar *f) {
    char usage[GRAMMAR_USAGE];
    const bool asks = error->text[strlen(error->text) - 1] == '?';
    grammar_usage(f, usage);
    text_add(error->text, sizeof error->text, "%susage: %s", asks ? " " : "; ", usage);
    return false;
}

void grammar_clauses(const hole_row *row, char buf[GRAMMAR_USAGE]) {
    char one[GRAMMAR_USAGE];
    const char *line;
    *buf = 0;
    for (size_t i = 0; (line = row->words(i)); i++) {
        takes_text(line, one, sizeof one);
        list_word(buf, GRAMMAR_USAGE, " ", one);
    }
}
