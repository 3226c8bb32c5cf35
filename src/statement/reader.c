/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads statements by the grammar of their rows. Uses `language`, `scene` and `text`. */
#include "statement/reader.h"

#include <math.h>
#include <string.h>

#include "text/unit.h"

/* ---- the end of a statement --------------------------------------------------------------------- */

bool at_end(lexer *lx) {
    if (lx->kind == T_END)
        return !lx->error->raised;
    if (lex_is(lx, "to") || lex_is(lx, "as") || lex_is(lx, "into"))
        return lex_fail(lx, "unexpected '%.*s': units are asked for by `in` (a in mm)", LEX_WORD(lx));
    return !expr_stray_unit(lx, argument_word) && lex_fail(lx, "unexpected '%.*s'", LEX_WORD(lx));
}

/* ---- names and clauses ------------------------------------------------------------------------- */

static const char blanks[] = " \t\n\r", word_ends[] = " \t\n\r,="; /* in no word of a table */

/* Number of bytes before the next of `ends`. Words of tables may have hyphens, which the lexer splits. */
static size_t bytes_to(const lexer *lx, const char *ends) {
    size_t end = lx->at;
    while (end < lx->end && !strchr(ends, lx->text[end]))
        end++;
    return end - lx->at;
}

static void step_over(lexer *lx, size_t len) {
    lx->len = len;
    lex_next(lx);
}

static const hole_row *first_hole(const clause *a) {
    return a->holes ? a->hole[0].row : NULL;
}

bool names_show(shell *sh, const lexer *lx, size_t before) {
    own_names *n = &sh->calc.names;
    const char *text = lx->text + lx->at;
    size_t i;
    if (quantity_find(text, lx->len) || name_taken(text, lx->len) || names_find(n, text, lx->len, &i))
        return true;
    if (!names_add(n, text, lx->len, &i))
        return calc_no_memory(lx->error);
    n->row[i].lent = i < before;
    n->row[i].known = true;
    return true;
}

static void names_forget(shell *sh, size_t before) {
    own_names *n = &sh->calc.names;
    names_drop(n, before);
    for (size_t i = 0; i < n->count; i++)
        if (n->row[i].lent)
            n->row[i].known = n->row[i].lent = false;
}

void parsed_drop(shell *sh, parsed *s) {
    for (unsigned i = 0; i < s->count; i++) {
        counted_drop(s->list[i].live);
        s->list[i].live = NULL;
    }
    parsed_hide_names(sh, s);
}

void parsed_hide_names(shell *sh, parsed *s) {
    if (s->shows_names)
        names_forget(sh, s->names);
    s->shows_names = false;
}

bool parsed_show_names(shell *sh, const lexer *lx, parsed *s) {
    s->names = sh->calc.names.count;
    for (const given_clause *h = s->list; h < s->list + s->count; h++) {
        const hole_row *row = first_hole(h->of);
        if (!row || row->kind != HOLE_NAME)
            continue;
        const lexer name = hole_lexer(lx, &h->hole[0]);
        if (name.len >= LEX_NAME)
            continue;
        s->shows_names = true;
        if (!names_show(sh, &name, s->names))
            return false;
    }
    return true;
}

given_clause *parsed_clause(parsed *s, const char *name, size_t i) {
    for (given_clause *h = s->list; h < s->list + s->count; h++)
        if (!strcmp(h->of->name, name) && i-- == 0)
            return h;
    return NULL;
}

lexer hole_lexer(const lexer *lx, const span *part) {
    lexer own = *lx;
    own.end = part->at + part->len;
    size_t next = own.end;
    while (next < lx->end && strchr(blanks, lx->text[next]))
        next++;
    own.part = next < lx->end;
    lex_seek(&own, part->at);
    return own;
}

void hole_word(const lexer *lx, const given_clause *h, char word[LEX_NAME]) {
    const span *part = &h->hole[0];
    snprintf(word, LEX_NAME, "%.*s", part->len < LEX_NAME ? (int)part->len : 0, lx->text + part->at);
}

char *hole_text(const lexer *lx, const span *part) {
    char *text = strndup(lx->text + part->at + 1, part->len - 2);
    if (!text)
        calc_no_memory(lx->error);
    return text;
}

void hole_file(const lexer *lx, const span *part, char name[FILE_NAME]) {
    lexer own = *lx;
    own.at = part->at;
    lex_filename(&own, name, FILE_NAME); /* cannot fail: read_hole has read it */
}

/* ---- errors ------------------------------------------------------------------------------------ */

/* The name of a statement in error messages. */
static const char *statement_name(const grammar *f) {
    return f->shape ? f->shape : f->command;
}

static bool not_taken(lexer *lx, const grammar *f, const char *name, token_kind how) {
    return lex_fail(lx, "%s does not take %s by %s", statement_name(f), name,
                    how == T_DEFINE ? ":=" : "+=") ||
           add_usage(lx->error, f);
}

/* "for EXPR = EXPR" */
static void clause_text(const clause *a, char buf[GRAMMAR_USAGE]) {
    char line[GRAMMAR_USAGE];
    snprintf(line, sizeof line, "%.*s", (int)a->len, a->text);
    takes_text(line, buf, GRAMMAR_USAGE);
}

/* "R1 and R2", or "for EXPR = EXPR to FILE": all clauses of the alternative that `of` belongs to. */
static void alternative_text(const grammar *f, const clause *of, char *buf, size_t size) {
    char text[GRAMMAR_USAGE];
    *buf = 0;
    for (const clause *a = f->clause; a < f->clause + f->count; a++)
        if (a->group == of->group && a->alternative == of->alternative) {
            clause_text(a, text);
            list_word(buf, size, a->argument ? " and " : " ", text);
        }
}

bool parsed_allows(const lexer *lx, const parsed *s, const clause *a) {
    char one[80], other[80];
    for (const given_clause *h = s->list; h < s->list + s->count; h++) {
        if (h->of == a && !a->again)
            return calc_fail(lx->error, lx->at, lx->len, "%s is given twice", a->name);
        if (!a->group || h->of->group != a->group || h->of->alternative == a->alternative)
            continue;
        alternative_text(s->by, h->of, one, sizeof one);
        alternative_text(s->by, a, other, sizeof other);
        const bool in_order = h->of->alternative < a->alternative;
        return calc_fail(lx->error, lx->at, lx->len, "give either %s or %s", in_order ? one : other,
                         in_order ? other : one);
    }
    return true;
}

static given_clause *add_given(const lexer *lx, parsed *s, const clause *a) {
    if (s->count == GIVEN_CLAUSES) {
        calc_raise(lx->error, lx->at, lx->len, "more than %d clauses", GIVEN_CLAUSES);
        return NULL;
    }
    given_clause *h = &s->list[s->count++];
    *h = (given_clause){.of = a, .at = lx->at, .len = lx->len};
    s->open = NULL;
    return h;
}

/* ---- values ------------------------------------------------------------------------------------ */

static bool in_range(lexer *lx, const given_clause *h) {
    const clause *a = h->of;
    if (a->in == 1 + IN_A || (!a->in && a->must == POSITIVE)) {
        char unit_text[128];
        dim_unit(h->v.d, unit_text, sizeof unit_text);
        return h->v.v > 0 ||
               calc_fail(lx->error, h->hole[0].at, h->hole[0].len, "%s = %.6Lg%s%s must be positive", a->name,
                         h->v.v, *unit_text ? " " : "", unit_text);
    }
    if (a->in)
        return input_check((input)(a->in - 1), (double)h->v.v, lx->error) || given_place(lx->error, h);
    if (a->must == CURVED && h->v.v == 0)
        return calc_fail(lx->error, h->hole[0].at, h->hole[0].len, "%s must not be 0", a->name);
    return true;
}

static bool read_operand(shell *sh, lexer *lx, const dim *want, given_clause *h) {
    h->hole[0].at = lx->at;
    const bool ok = expr_value_as(&sh->calc, lx, want, &h->v);
    h->hole[0].len = lx->last - h->hole[0].at;
    return ok;
}

/* Reads a value of dimension d within its range; `name` is for error messages. */
static bool read_value(shell *sh, lexer *lx, const char *name, dim d, given_clause *h) {
    return read_operand(sh, lx, &d, h) && value_dim(lx, name, h->hole[0].at, h->hole[0].len, h->v, d) &&
           in_range(lx, h);
}

/* The dimension of an argument. A, of the gap A r^n, has length^(1-n), so n must come first. */
static bool argument_dim(shell *sh, lexer *lx, parsed *s, const clause *a, dim *d) {
    *d = a->d;
    if (a->in != 1 + IN_A)
        return true;
    given_clause *n = parsed_clause(s, "n", 0);
    if (n && n->live && !definition_value(&sh->calc, (definition *)n->live, &n->v, lx->error))
        return given_place(lx->error, n);
    if (n)
        *d = (dim){0, 1 - (double)n->v.v, 0, 0};
    return n || lex_fail(lx, "give n before A: the dimension of A depends on it");
}

/* Is the cursor on `at NAME =`? It belongs to the expression before it, `at FILE` is a clause. */
static bool is_at_change(const lexer *lx) {
    if (!lex_is(lx, "at"))
        return false;
    lexer next = *lx;
    next.error = error_quiet();
    lex_next(&next);
    return next.kind == T_NAME && lex_peek(&next) == T_ASSIGN;
}

/* The clause that the word at the cursor begins, or NULL. */
static const clause *clause_named(const lexer *lx, const grammar *f) {
    if (is_at_change(lx))
        return NULL;
    for (const clause *a = f->clause; a < f->clause + f->count; a++)
        if (!a->argument && *a->name && (lex_is(lx, a->name) || (lx->kind == T_ASSIGN && *a->name == '=')))
            return a;
    return NULL;
}

/* The argument at the cursor, or NULL. */
static const clause *argument_named(const lexer *lx, const grammar *f) {
    for (const clause *a = f->clause; a < f->clause + f->count; a++)
        if (a->argument && lex_is(lx, a->name))
            return a;
    return NULL;
}

static bool read_hole(shell *sh, lexer *lx, parsed *s, given_clause *h, unsigned i);

static bool read_argument(shell *sh, lexer *lx, parsed *s) {
    const token_kind how = lex_peek(lx);
    const grammar *f = s->by;
    const clause *a = argument_named(lx, f);
    dim d;
    if (!a && clause_named(lx, f))
        return lex_fail(lx, "%.*s takes no '=', only a blank before its value", LEX_WORD(lx)) ||
               add_usage(lx->error, f);
    if (!a)
        return lex_fail(lx, "%s has no %s '%.*s'", statement_name(f), f->shape ? "parameter" : "argument",
                        LEX_WORD(lx)) ||
               add_usage(lx->error, f);
    if (!parsed_allows(lx, s, a))
        return false;
    if ((how == T_INCREMENT && !a->increment) || (how == T_DEFINE && !a->live))
        return not_taken(lx, f, a->name, how);
    given_clause *h = lx->cut || argument_dim(sh, lx, s, a, &d) ? add_given(lx, s, a) : NULL;
    if (!h)
        return false;
    h->increment = how == T_INCREMENT;
    lex_next(lx);
    lex_next(lx);
    if (lx->cut)
        return read_hole(sh, lx, s, h, 0);
    if (a->must == CURVED && lex_is(lx, "inf")) { /* the radius of a plane */
        h->v = (value){INFINITY, d};
        h->hole[0] = (span){lx->at, lx->len};
        lex_next(lx);
        return true;
    }
    if (how != T_DEFINE)
        return read_value(sh, lx, a->name, d, h);
    h->hole[0].at = lx->at;
    const bool ok = calc_bind(&sh->calc, lx, (input)(a->in - 1), &h->live);
    h->hole[0].len = lx->last - h->hole[0].at;
    return ok;
}

static bool read_seconds(shell *sh, lexer *lx, const hole *of, given_clause *h) {
    return read_operand(sh, lx, NULL, h) &&
           ((dim_equal(h->v.d, DIM_NONE) && h->v.v > 0 && h->v.v <= of->most) ||
            calc_fail(lx->error, h->hole[0].at, h->hole[0].len,
                      "the seconds must be a positive number up to %u", of->most));
}

static bool read_choice(lexer *lx, const hole_row *row, given_clause *h) {
    enum { LISTED = 8 };
    char word[LEX_NAME], list[CALC_ERROR_TEXT - 64] = "";
    const size_t len = bytes_to(lx, word_ends);
    h->hole[0] = (span){lx->at, len};
    if (word_among(row->words, lx->text + lx->at, len, &h->choice)) {
        step_over(lx, len);
        return true;
    }
    snprintf(word, sizeof word, "%.*s", LEX_SHOWN(len), lx->text + lx->at);
    lx->len = len;
    if (!row->noun) { /* a table of few words: the message lists all */
        for (size_t i = 0; row->words(i); i++) {
            snprintf(word, sizeof word, "%s %s", h->of->name, row->words(i));
            list_word(list, sizeof list, row->words(i + 1) ? ", " : " or ", word);
        }
        return lex_fail(lx, "expected %s", list);
    }
    for (size_t i = 0; i < LISTED && row->words(i); i++)
        list_word(list, sizeof list, ", ", row->words(i));
    if (row->words(LISTED))
        list_word(list, sizeof list, ", ", "...");
    if (!len)
        return lex_fail(lx, "which %s? one of %s", row->noun, list);
    const char *lead = hint_from(word), *near = lead ? lead : suggest(word, row->words);
    return lex_fail(lx,
                    lead   ? "unknown %s '%s': %s"
                    : near ? "unknown %s '%s': did you mean %s?"
                           : "unknown %s '%s' (%s)",
                    row->noun, word, near ? near : list);
}

/* ---- holes that the command reads --------------------------------------------------------------- */

/* Is the cursor on an `=`, or on what was typed in its place: == (no token), :=, +=? */
static bool is_equals(const lexer *lx) {
    const bool no_token = lx->error->raised && lx->text[lx->at] == '=';
    return no_token || lx->kind == T_ASSIGN || lx->kind == T_DEFINE || lx->kind == T_INCREMENT;
}

/* The clause whose word differs by one letter from the word at the cursor, or NULL. */
static const clause *clause_near(const lexer *lx, const grammar *f) {
    char word[LEX_NAME];
    if (lx->kind != T_NAME || lx->len < 2)
        return NULL;
    lex_word(lx, word);
    for (const clause *a = f->clause; a < f->clause + f->count; a++)
        if (!a->argument && *a->name && one_letter_apart(word, a->name))
            return a;
    return NULL;
}

/* May the name at the cursor be the unit of the number before it, or a misspelt unit? */
static bool is_unit(const lexer *lx, const grammar *f) {
    enum { SHORT = 3 }; /* so short a word may be any unit, misspelt */
    unit known;
    char word[LEX_NAME];
    lex_word(lx, word);
    return lx->len <= SHORT || unit_lookup(word, strlen(word), &known) || unit_suggest(word) ||
           !clause_near(lx, f);
}

/* Finds the end of the expressions in the i-th hole of the clause. Outside parentheses it is, behind an
 * operand, a word that begins a clause, or a name that no expression can have there; it is also a |, a comma
 * that repeats the clause, and an `=` before the next hole, unless that belongs to `at`. */
static void skip_expression(lexer *lx, parsed *s, const clause *a, unsigned i) {
    calc_error *const error = lx->error, *const no_token = error_quiet();
    const grammar *f = s->by;
    const hole_kind kind = a->hole[i].row->kind;
    const bool comma_ends = a->list && *a->name,
               equals_ends = i + 1 < a->holes && a->hole[i + 1].before == '=';
    /* `plot map EXPR` and `plot FIGURE` begin with a word of their own, behind which a name may stand */
    const bool titled = !*a->name && grammar_first(f, HOLE_WORD);
    const size_t title_end = titled ? lx->at + lx->len : 0;
    int depth = 0;               /* of parentheses */
    bool takes_unit = false;     /* a unit may follow as it may a number: (1/3) N, pi N */
    bool clause_operand = false; /* the last token is a clause's word in the place of an operand */
    bool changing = false;       /* there has been an `at` */
    bool at_name = false;        /* the last token is the name behind `at` */
    s->end = PART_VALUE;
    s->changed.len = 0;
    for (lx->error = no_token; lx->kind != T_END || no_token->raised; lex_next(lx)) {
        const bool name = lx->kind == T_NAME, operand = s->end >= PART_NUMBER; /* one precedes the cursor */
        const bool in = operand && lex_is(lx, "in"), at = operand && lex_is(lx, "at"),
                   joins = in || at || (operand && kind == HOLE_SPAN && lex_is(lx, "to"));
        const clause *next = name ? clause_named(lx, f) : NULL;
        const bool behind_title = lx->last == title_end && !(clause_near(lx, f) && lex_peek(lx) != T_END);
        const bool ends = name && operand &&
                          (next ||
                           !(joins || clause_operand || behind_title || kind == HOLE_LOAD ||
                             (s->end == PART_NUMBER && is_unit(lx, f)) || (takes_unit && unit_at(lx))) ||
                           (lx->cut && argument_named(lx, f) && lex_assigns(lx)));
        if (depth == 0 && (lx->kind == T_BAR || (lx->kind == T_COMMA && comma_ends) ||
                           (equals_ends && !at_name && is_equals(lx)) || ends))
            break;
        error_clear(no_token); /* the parser of the expression reports it */
        depth += (lx->kind == T_OPEN) - (lx->kind == T_CLOSE);
        changing = changing || at;
        at_name = name && s->end == PART_NAME;
        clause_operand = next && !operand;
        takes_unit = lx->kind == T_CLOSE || lex_is(lx, "pi");
        if (name)
            s->changed = (span){lx->at, 0};
        else if (lx->kind == T_ASSIGN)
            s->changed.len = lx->last - s->changed.at;
        if (at || (changing && lx->kind == T_COMMA))
            s->end = PART_NAME;
        else if (joins)
            s->end = in ? PART_UNIT : PART_VALUE;
        else if (lx->kind == T_NUMBER)
            s->end = PART_NUMBER;
        else
            s->end =
                name || takes_unit || lx->kind == T_PERCENT || lx->kind == T_STRING ? PART_WHOLE : PART_VALUE;
    }
    lx->error = error;
    if (no_token->raised) /* the text ends there: raise the error again, for the caller */
        lex_seek(lx, lx->at);
}

/* One name; where a list of names stands first, all of it. */
static bool skip_names(lexer *lx, parsed *s, const clause *a) {
    if (lx->kind != T_NAME)
        return *a->name ? lex_fail(lx, "expected a name after %s", a->name) : lex_fail(lx, "expected a name");
    if (a->list && !*a->name) {
        skip_expression(lx, s, a, 0);
        return true;
    }
    lex_next(lx);
    return !lx->error->raised;
}

/* `3 um`, `"Load On Sample"`: a column and perhaps a unit. Its name may contain what is no token. */
static bool skip_column(lexer *lx, const parsed *s, span *part) {
    unit unused;
    error_clear(lx->error);
    part->len = lx->kind == T_STRING || lx->kind == T_NUMBER ? lx->len : bytes_to(lx, word_ends);
    step_over(lx, part->len);
    if (!unit_at(lx) && (lx->kind != T_NAME || clause_named(lx, s->by)))
        return part->len > 0 || lex_fail(lx, "expected a column: its name, or its number");
    const bool ok = unit_parse(lx, &unused);
    part->len = lx->last - part->at;
    return ok;
}

static bool skip_load(lexer *lx, parsed *s, const clause *a) {
    size_t load;
    if (!word_among(a->hole[0].row->words, lx->text + lx->at, lx->len, &load))
        return lex_fail(lx, "along what? program, cycle, step ... or cycle ...");
    skip_expression(lx, s, a, 0);
    return true;
}

/* Reports `for X = 1 N to 2 N`, where `to` has been taken for the clause `to FILE`. */
static bool lacks_dots(lexer *lx, const clause *a, const span *part) {
    if (!lex_is(lx, "to") || strcmp(a->name, "for") != 0)
        return false;
    for (size_t i = part->at; i + 1 < lx->at; i++)
        if (lx->text[i] == ',' || (lx->text[i] == '.' && lx->text[i + 1] == '.'))
            return false;
    return !lex_fail(lx, "expected .. between the two ends of the sweep");
}

/* ---- holes ------------------------------------------------------------------------------------- */

/* Skips the `mu=` of `mu=0.3`. */
static bool skip_quantity_name(lexer *lx, const grammar *f, const hole_row *row) {
    if (!lex_assigns(lx) || !lex_is(lx, row->noun))
        return true;
    if (lex_peek(lx) != T_ASSIGN)
        return not_taken(lx, f, row->noun, lex_peek(lx));
    lex_next(lx);
    lex_next(lx);
    return true;
}

static bool read_count(calc *c, lexer *lx, const char *what, const hole *of, unsigned *out) {
    value v;
    size_t at = lx->at;
    if (lx->kind == T_END)
        return lex_fail(lx, "expected a whole number from %u to %u after %s", of->least, of->most, what);
    if (!expr_value(c, lx, &v))
        return false;
    if (!dim_equal(v.d, DIM_NONE) || !(v.v >= of->least && v.v <= of->most) ||
        v.v != (long double)(unsigned)v.v)
        return calc_fail(lx->error, at, lx->last - at, "%s must be a whole number from %u to %u", what,
                         of->least, of->most);
    *out = (unsigned)v.v;
    return true;
}

/* What error messages call a number: `steps` of `steps 7`, `digits` of `set digits 7`, `N` of `jenkins N`. */
static const char *count_name(const grammar *f, const clause *a) {
    return !*a->name ? statement_name(f) : a->optional || a->group ? a->name : a->hole[0].row->name;
}

static bool read_hole(shell *sh, lexer *lx, parsed *s, given_clause *h, unsigned i) {
    const clause *a = h->of;
    const hole *of = &a->hole[i];
    const hole_row *row = of->row;
    const bool evaluated = row->kind == HOLE_VALUE || row->kind == HOLE_SECONDS || row->kind == HOLE_COUNT;
    bool ok = true;
    h->hole[i] = (span){lx->at, 0};
    s->open = h;
    s->hole = i;
    s->end = parsed_at_cursor(lx) ? PART_EMPTY : PART_WHOLE;
    if (s->end == PART_EMPTY)
        return false;
    switch (evaluated && lx->cut ? HOLE_EXPR : row->kind) {
    case HOLE_VALUE:
        return skip_quantity_name(lx, s->by, row) && read_value(sh, lx, row->noun, h->of->d, h);
    case HOLE_SECONDS:
        return read_seconds(sh, lx, of, h);
    case HOLE_CHOICE:
        return read_choice(lx, row, h);
    case HOLE_COUNT:
        ok = read_count(&sh->calc, lx, count_name(s->by, a), of, &h->count);
        break;
    case HOLE_FILE: {
        char name[FILE_NAME];
        ok = lex_filename(lx, name, sizeof name);
        break;
    }
    case HOLE_COLUMN:
        return skip_column(lx, s, &h->hole[i]);
    case HOLE_NAME:
    case HOLE_INPUT:
        ok = skip_names(lx, s, a);
        break;
    case HOLE_LOAD:
        ok = skip_load(lx, s, a);
        break;
    case HOLE_TEXT:
        if (lx->kind != T_STRING)
            return lex_fail(lx, "expected %s%s\"TEXT\"", a->name, *a->name ? " " : "");
        lex_next(lx);
        break;
    case HOLE_WORD: /* may contain what is no token */
        error_clear(lx->error);
        h->hole[i].len = bytes_to(lx, blanks);
        step_over(lx, h->hole[i].len);
        return true;
    default:
        if (row->kind == HOLE_MAYBE && lx->kind == T_NAME && clause_named(lx, s->by))
            break;
        skip_expression(lx, s, a, i);
        ok = row->kind != HOLE_SPAN || !lacks_dots(lx, a, &h->hole[i]);
        break;
    }
    h->hole[i].len = lx->last > h->hole[i].at ? lx->last - h->hole[i].at : 0;
    return ok &&
           (h->hole[i].len || !*a->name || row->kind == HOLE_MAYBE || lex_fail(lx, "expected a value here"));
}

/* Skips the `=` or `+-` between a hole and the one before. */
static bool read_between(lexer *lx, const given_clause *h, unsigned i) {
    const char before = h->of->hole[i].before;
    const span *name = &h->hole[i - 1];
    const bool named = h->of->hole[i - 1].row->kind != HOLE_EXPR;
    if (before == '=' && lx->kind != T_ASSIGN)
        return named ? lex_fail(lx, "expected =%s after %.*s",
                                h->of->hole[i].row->kind == HOLE_SPAN ? " LO .. HI" : "",
                                LEX_SHOWN(name->len), lx->text + name->at)
                     : lex_fail(lx, "expected = EXPR: what should it be equal to?");
    if (before == '+') {
        const size_t sign = lx->at;
        if (lx->kind != T_PLUS || lex_peek(lx) != T_MINUS)
            return lex_fail(lx, "expected +- after %.*s", LEX_SHOWN(name->len), lx->text + name->at);
        lex_next(lx);
        if (lx->at != sign + 1)
            return lex_fail(lx, "expected +-");
    }
    if (before)
        lex_next(lx);
    return !lx->error->raised;
}

static bool read_holes(shell *sh, lexer *lx, parsed *s, given_clause *h) {
    for (unsigned i = 0; i < h->of->holes; i++)
        if ((i && !read_between(lx, h, i)) || !read_hole(sh, lx, s, h, i))
            return false;
    return true;
}

/* ---- the statement ----------------------------------------------------------------------------- */

/* Of two clauses with the same word, `log` and `log AXES`, the second if a choice follows at the cursor. */
static const clause *with_choice(const lexer *lx, const grammar *f, const clause *a) {
    for (const clause *b = a + 1; b < f->clause + f->count; b++)
        if (!strcmp(a->name, b->name) &&
            (parsed_at_cursor(lx) || (lx->kind == T_NAME && !clause_named(lx, f))))
            return b;
    return a;
}

static bool read_clause(shell *sh, lexer *lx, parsed *s, const clause *a) {
    const lexer word = *lx;
    lex_next(lx);
    a = with_choice(lx, s->by, a);
    given_clause *h = parsed_allows(&word, s, a) ? add_given(&word, s, a) : NULL;
    const hole_row *row = first_hole(a);
    if (!h)
        return false;
    if (row && row->kind == HOLE_FILE) /* its name may contain what is no token */
        error_clear(lx->error);
    if (lx->error->raised || !read_holes(sh, lx, s, h))
        return false;
    while (a->list && lx->kind == T_COMMA) {
        lex_next(lx);
        h = add_given(lx, s, a);
        if (!h || !read_holes(sh, lx, s, h))
            return false;
    }
    return !lx->error->raised;
}

/* Reads a first word that has a grammar of its own, such as the shape of a geometry, and switches to that. */
static bool read_head(lexer *lx, parsed *s) {
    const clause *a = s->by->clause;
    const hole_row *row = s->by->count && !*a->name ? first_hole(a) : NULL;
    given_clause h = {.of = a};
    if (!row || !row->form || parsed_at_cursor(lx) ||
        (a->optional && lx->kind == T_END && !lx->error->raised))
        return true;
    if (row->kind == HOLE_WORD) { /* or an expression, whose first name is none of the words */
        size_t i;
        if (lx->kind != T_NAME || !word_among(row->words, lx->text + lx->at, lx->len, &i) || !row->form(i))
            return true;
    }
    if (!read_choice(lx, row, &h))
        return false;
    s->row = h.choice;
    s->by = row->form(h.choice);
    return true;
}

/* Does the word at the cursor begin the clause `a`, rather than fill the first hole? `off` does so in
 * `record off`, but not in `record off.txt`. */
static bool begins_clause(const lexer *lx, const clause *a, hole_kind first) {
    const bool whole = first == HOLE_COUNT || bytes_to(lx, blanks) == lx->len;
    return a && first != HOLE_EXPR && whole && (a->holes == 0 || first != HOLE_FILE || lex_peek(lx) != T_END);
}

/* Reads the holes that stand first, without a word before them. */
static bool read_first(shell *sh, lexer *lx, parsed *s) {
    const clause *a = s->by->clause, *end = a + s->by->count;
    while (a + 1 < end && !*a[1].name) /* the last of these alternatives: EXPR takes any WORD, too */
        a++;
    const hole_row *row = a < end && !*a->name ? first_hole(a) : NULL;
    if (!row || parsed_at_cursor(lx) || begins_clause(lx, clause_named(lx, s->by), row->kind) ||
        (a->optional && lx->kind == T_END && !lx->error->raised))
        return true;
    if (row->kind == HOLE_CHOICE && (lx->kind != T_NAME || lex_assigns(lx)))
        return true;
    do {
        given_clause *h = add_given(lx, s, a);
        if (!h || !read_holes(sh, lx, s, h))
            return false;
    } while (a->again && (lx->kind != T_END || lx->error->raised));
    return true;
}

/* Is it `with = 0.3`, a clause whose name is missing, rather than an argument? */
static bool lacks_name(const lexer *lx, const grammar *f) {
    const clause *a = clause_named(lx, f);
    return a && a->holes && (a->hole[0].row->kind == HOLE_NAME || a->hole[0].row->kind == HOLE_INPUT);
}

bool parsed_read_some(shell *sh, lexer *lx, const grammar *f, parsed *out) {
    parsed_begin(out, f);
    if (!read_head(lx, out) || !read_first(sh, lx, out))
        return false;
    f = out->by;
    while (lx->kind == T_NAME || clause_named(lx, f)) {
        const clause *a;
        if (lex_assigns(lx) && !lacks_name(lx, f)) {
            if (!read_argument(sh, lx, out))
                return false;
        } else if (!(a = clause_named(lx, f))) {
            break;
        } else if (!read_clause(sh, lx, out, a)) {
            return false;
        }
    }
    return !lx->error->raised && (lx->cut || parsed_show_names(sh, lx, out));
}

bool parsed_at_cursor(const lexer *lx) {
    return lx->cut && lx->kind == T_END && (lx->at == lx->end || strchr(blanks, lx->text[lx->at]));
}

static bool misspelt(lexer *lx, const parsed *s) {
    const clause *meant = clause_near(lx, s->by);
    return meant && !lex_fail(lx, "unexpected '%.*s': did you mean %s?", LEX_WORD(lx), meant->name);
}

/* Reports `sphere 10 mm` or `nu 0.3`: an argument without its name or its `=`. */
static bool half_named(lexer *lx, const parsed *s) {
    const clause *a = s->by->clause, *end = a + s->by->count;
    const bool bare = lx->kind == T_NUMBER || lx->kind == T_MINUS || lx->kind == T_OPEN;
    while (a < end && !(a->argument && (bare || lex_is(lx, a->name))))
        a++;
    return a < end &&
           !(lex_fail(lx, bare ? "unexpected '%.*s': a value needs its name" : "expected = after %.*s",
                      LEX_WORD(lx)) ||
             add_usage(lx->error, s->by));
}

/* Reports `to my loop.png`. */
static bool has_blank_in_file(lexer *lx, const parsed *s) {
    const given_clause *h = s->count ? s->list + s->count - 1 : NULL;
    const hole_row *row = h ? first_hole(h->of) : NULL;
    return row && row->kind == HOLE_FILE && (lx->kind == T_NAME || lx->kind == T_NUMBER) &&
           lx->text[h->hole[0].at] != '"' &&
           !lex_fail(lx, "unexpected '%.*s': a file whose name has blanks goes into \"quotation marks\"",
                     LEX_WORD(lx));
}

bool parsed_end(lexer *lx, const parsed *s) {
    if (lx->kind == T_COMMA)
        return lex_fail(lx, "unexpected ',': blanks separate the arguments of %s", s->by->command);
    if (misspelt(lx, s) || half_named(lx, s) || has_blank_in_file(lx, s))
        return false;
    return at_end(lx) || (lx->kind != T_END && !s->count && *s->by->takes && add_usage(lx->error, s->by));
}

bool parsed_swallowed(const lexer *lx, const parsed *s, const char *word) {
    for (const given_clause *h = s->list; h < s->list + s->count; h++) {
        if (!first_hole(h->of) || first_hole(h->of)->kind != HOLE_EXPR)
            continue;
        lexer own = hole_lexer(lx, &h->hole[0]);
        own.error = error_quiet();
        while (own.kind != T_END && !(own.at > h->hole[0].at && lex_is(&own, word)))
            lex_next(&own);
        if (own.kind != T_END && lex_peek(&own) == T_NAME)
            return !calc_fail(lx->error, own.at, own.len, "something is missing before %s", word);
    }
    return false;
}

/* Of alternatives that are not optional one must be given: `auto | off | on`. */
static bool has_alternative(lexer *lx, const parsed *s) {
    const clause *a = s->by->clause, *end = a + s->by->count;
    char list[CALC_ERROR_TEXT / 2] = "";
    if (a == end || s->count || a->optional || a->argument || !a->group)
        return true;
    for (; a < end; a++)
        list_word(list, sizeof list, a + 1 == end ? " or " : ", ", a->name);
    return lex_fail(lx, "expected %s", list);
}

/* Are all clauses given that are not optional? Else an error. */
static bool is_whole(lexer *lx, parsed *s) {
    char text[GRAMMAR_USAGE];
    for (const clause *a = s->by->clause; a < s->by->clause + s->by->count; a++) {
        if (a->argument || a->optional || a->group || !*a->name || parsed_clause(s, a->name, 0))
            continue;
        if (s->count && !*s->list[0].of->name && !s->list[0].hole[0].len)
            return lex_fail(lx, "expected a value here");
        if (parsed_swallowed(lx, s, a->name))
            return false;
        clause_text(a, text);
        return lex_fail(lx, "expected %s", text);
    }
    return has_alternative(lx, s);
}

bool parsed_read(shell *sh, lexer *lx, const grammar *f, parsed *out) {
    return (parsed_read_some(sh, lx, f, out) && !misspelt(lx, out) && is_whole(lx, out) &&
            parsed_end(lx, out)) ||
           (parsed_drop(sh, out), false);
}
