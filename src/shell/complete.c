/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Completion by position, from the tables of commands, settings, geometries, quantities and units. Changes
 * nothing. */
#include "shell/complete.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "number/array.h"
#include "shell/command.h"
#include "shell/help.h"
#include "shell/lines.h"
#include "shell/looks.h"

/* ---- candidates -------------------------------------------------------------------------------- */

enum { TOKENS = 256 };

/* The statement before the word at the cursor. */
typedef struct place {
    const calc *c;
    const char *line;
    size_t start, cursor; /* of the word */
    struct {
        token_kind kind;
        size_t at, len;
    } token[TOKENS];
    size_t count;
    const command *command; /* that it begins with, or NULL */
    candidates *out;
} place;

static void add(const place *p, const char *word, const char *ending) {
    candidates *out = p->out;
    const size_t typed = p->cursor - p->start, n = strlen(word), m = strlen(ending);
    if (n < typed || memcmp(word, p->line + p->start, typed) != 0)
        return;
    char **grown = fret_array_for(out->word, &out->room, out->count + 1, sizeof *grown);
    if (!grown)
        return;
    out->word = grown;
    char *whole = malloc(n + m + 1);
    if (!whole)
        return;
    memcpy(whole, word, n);
    memcpy(whole + n, ending, m + 1);
    for (size_t i = 0; i < out->count; i++)
        if (!strcmp(out->word[i], whole)) {
            free(whole);
            return;
        }
    out->word[out->count++] = whole;
}

void candidates_free(candidates *c) {
    for (size_t i = 0; i < c->count; i++)
        free(c->word[i]);
    free(c->word);
    *c = (candidates){.word = NULL};
}

static void add_all(const place *p, const char *(*name)(size_t i)) {
    for (size_t i = 0; name(i); i++)
        add(p, name(i), "");
}

/* What may begin a value. */
static void add_values(const place *p) {
    const quantity *q;
    for (size_t i = 0; (q = quantity_row(i)); i++)
        add(p, q->name, quantity_has_value(q) ? "" : "(");
    add_all(p, builtin_name);
    for (size_t i = 0; i < p->c->names.count; i++) {
        const own_name *own = &p->c->names.row[i];
        const definition *d = (const definition *)own->definition;
        if (own->known)
            add(p, own->text, d && d->parameters ? "(" : "");
    }
    if (p->c->has_ans)
        add(p, "ans", "");
}

/* Inputs that the scene takes, and names of the user's. */
static void add_knobs(const place *p, const char *end) {
    for (input in = 0; in < INPUTS; in++) {
        calc_error ignored;
        error_clear(&ignored);
        if (calc_takes(p->c, in, &ignored))
            add(p, quantity_of_input(in)->name, end);
    }
    for (size_t i = 0; i < p->c->names.count; i++)
        if (p->c->names.row[i].known && !p->c->names.row[i].definition)
            add(p, p->c->names.row[i].text, end);
}

static bool same_dim(dim a, dim b) {
    return dim_equal(a, b) && (a.rad != 0) == (b.rad != 0);
}

/* Units of the dimension; any: of all. Where no unit alone has the dimension, all again. */
static void add_units(const place *p, bool any, dim d) {
    static const char *const prefixes[] = {"", "n", "u", "m", "c", "k", "M", "G"};
    enum { PREFIXES = sizeof prefixes / sizeof *prefixes };
    bool none = true;
    unit u = {.d = DIM_NONE};
    for (size_t i = 0; unit_name(i) && none && !any; i++)
        none = (unit_lookup(unit_name(i), strlen(unit_name(i)), &u), !same_dim(u.d, d));
    for (size_t i = 0; unit_name(i); i++)
        for (size_t j = 0; j < PREFIXES; j++) {
            char word[LEX_NAME];
            snprintf(word, sizeof word, "%s%s", prefixes[j], unit_name(i));
            if (unit_lookup(word, strlen(word), &u) && (any || none || same_dim(u.d, d)))
                add(p, word, "");
        }
}

/* ---- the statement ----------------------------------------------------------------------------- */

static bool is_word(const place *p, size_t i, const char *word) {
    return p->token[i].kind == T_NAME && strlen(word) == p->token[i].len &&
           !memcmp(p->line + p->token[i].at, word, p->token[i].len);
}

/* The `|` before the figure at the cursor, or 0. */
static size_t figure_begins(const place *p) {
    size_t i = p->count;
    while (i-- > 1)
        if (p->token[i].kind == T_BAR)
            return i;
    return 0;
}

static bool is_given(const place *p, const char *word) {
    for (size_t i = figure_begins(p) + 1; i < p->count; i++)
        if (is_word(p, i, word))
            return true;
    return false;
}

static bool assigns(token_kind kind) {
    return kind == T_ASSIGN || kind == T_INCREMENT || kind == T_DEFINE;
}

/* As an argument, not within a value. */
static bool is_assigned(const place *p, const char *word) {
    for (size_t i = 1; i + 1 < p->count; i++)
        if (is_word(p, i, word) && assigns(p->token[i + 1].kind))
            return true;
    return false;
}

/* The tokens before the word that begins at `start`; what is none, as in names of files, is left out. */
static void read_tokens(place *p, size_t begin, size_t start) {
    calc_error strange;
    lexer lx;
    error_clear(&strange);
    p->start = start;
    p->count = 0;
    for (lex_start(&lx, p->line + begin, start - begin, &strange);
         (lx.kind != T_END || strange.raised) && p->count < TOKENS; lex_next(&lx)) {
        error_clear(&strange);
        if (lx.kind == T_END)
            continue;
        p->token[p->count].kind = lx.kind;
        p->token[p->count].at = begin + lx.at;
        p->token[p->count++].len = lx.len;
    }
    const bool assignment = p->count > 1 && assigns(p->token[1].kind);
    p->command = p->count && !assignment ? command_find(p->line + p->token[0].at, p->token[0].len) : NULL;
}

static const arg *row_of_kind(const command *c, arg_kind kind) {
    const arg *a = c ? c->args : NULL;
    while (a && a->kind && a->kind != kind)
        a++;
    return a && a->kind ? a : NULL;
}

/* Does it take `for`, `along` and what belongs to them? */
static bool has_range(const command *c) {
    return row_of_kind(c, ARG_LIST) && row_of_kind(c, ARG_TO);
}

/* `along cycle ...`: its arguments may follow. */
static const command *load_along(const place *p) {
    for (size_t i = figure_begins(p) + 2; i < p->count; i++)
        if (is_word(p, i - 1, "along"))
            return command_find(p->line + p->token[i].at, p->token[i].len);
    return NULL;
}

/* One of these first. */
static bool takes_names(const command *c, const char *(*names)(size_t i)) {
    const arg *a = row_of_kind(c, ARG_NAME);
    return a && a->words == names;
}

static const geometry *shape_of(const place *p) {
    if (!takes_names(p->command, geometry_name))
        return NULL;
    const char *name = p->line + p->token[1].at;
    return geometry_find(name, strcspn(name, " \t\n;"));
}

/* ---- words that something follows -------------------------------------------------------------- */

typedef enum follows {
    FOLLOWS_KNOB,
    FOLLOWS_NAME, /* of one, without its value */
    FOLLOWS_LOAD,
    FOLLOWS_VALUE,
    FOLLOWS_FILE,
    FOLLOWS_UNIT
} follows;

/* Words of expressions and ranges; those of commands are rows of their arguments. alone: what follows in a
 * command without a range. */
static const struct {
    const char *word;
    follows what, alone;
    bool of_range, of_figure, of_value;
} words[] = {
    {"in", FOLLOWS_UNIT, FOLLOWS_UNIT, true, true, true},
    {"at", FOLLOWS_KNOB, FOLLOWS_KNOB, true, true, true},
    {"for", FOLLOWS_KNOB, FOLLOWS_VALUE, true, true, false},
    {"along", FOLLOWS_LOAD, FOLLOWS_FILE, true, true, false},
    {"with", FOLLOWS_KNOB, FOLLOWS_NAME, true, true, false},
    {"against", FOLLOWS_VALUE, FOLLOWS_VALUE, false, true, false},
    {"over", FOLLOWS_FILE, FOLLOWS_KNOB, false, true, false},
    {"from", FOLLOWS_VALUE, FOLLOWS_VALUE, false, false, false},
};
enum { WORD_ROWS = sizeof words / sizeof *words };

/* The dimension of what stands before `in`, where a quantity or a name alone does. */
static bool dim_before(const place *p, dim *d) {
    size_t first = p->count - 1, i;
    int depth = 0;
    while (first > 0 && !(depth == 0 && p->token[first - 1].kind == T_COMMA) && !(first == 1 && p->command)) {
        first--;
        depth += p->token[first].kind == T_CLOSE ? 1 : p->token[first].kind == T_OPEN ? -1 : 0;
    }
    if (p->token[first].kind != T_NAME)
        return false;
    depth = 0;
    for (i = first + 1; i + 1 < p->count; i++) {
        depth += p->token[i].kind == T_OPEN ? 1 : p->token[i].kind == T_CLOSE ? -1 : 0;
        if (depth == 0 && i + 2 < p->count)
            return false;
    }
    const char *name = p->line + p->token[first].at;
    const quantity *q = quantity_find(name, p->token[first].len);
    size_t own;
    if (q)
        *d = quantity_dim(q, &p->c->scene);
    else if (names_find(&p->c->names, name, p->token[first].len, &own) && !p->c->names.row[own].definition)
        *d = p->c->names.row[own].v.d;
    else
        return false;
    return true;
}

static bool add_following(const place *p, follows what) {
    dim d = DIM_NONE;
    switch (what) {
    case FOLLOWS_KNOB:
    case FOLLOWS_NAME:
        add_knobs(p, what == FOLLOWS_KNOB ? "=" : "");
        return true;
    case FOLLOWS_LOAD:
        add(p, "program", "");
        add(p, "cycle", "");
        add(p, "step", "");
        return true;
    case FOLLOWS_VALUE:
        add_values(p);
        return true;
    case FOLLOWS_UNIT: {
        const bool known = dim_before(p, &d);
        add_units(p, !known, d);
        return true;
    }
    default:
        return false;
    }
}

/* ---- arguments --------------------------------------------------------------------------------- */

static bool group_given(const place *p, const arg *args, int group) {
    for (const arg *a = args; group && a->kind; a++)
        if (a->group == group && is_assigned(p, a->name))
            return true;
    return false;
}

/* The rows of a command that may still come. first: right after its word. */
static void add_arguments(const place *p, const command *c, bool first) {
    const bool list = row_of_kind(c, ARG_LIST) || row_of_kind(c, ARG_KNOB);
    for (const arg *a = c->args; a && a->kind; a++)
        switch (a->kind) {
        case ARG_VALUE:
            if (!is_assigned(p, a->name) && !group_given(p, c->args, a->group))
                add(p, a->name, "=");
            break;
        case ARG_COUNT:
        case ARG_NUMBER:
        case ARG_WORD:
        case ARG_TO:
            if (!is_given(p, a->name) && !(first && list))
                add(p, a->name, "");
            break;
        case ARG_CHOICE:
        case ARG_NAME:
            if (first)
                add_all(p, a->words);
            break;
        case ARG_EXPR:
        case ARG_LIST:
            if (first)
                add_values(p);
            break;
        case ARG_KNOB:
            if (first)
                add_knobs(p, "");
            break;
        default:
            break;
        }
}

/* NAME= of a usage line such as `cone slope=0.05 | cone angle=3 deg`. */
static void add_parameters(const place *p, const geometry *shape) {
    const char *usage = shape->usage;
    for (const char *equals = strchr(usage, '='); equals; equals = strchr(equals + 1, '=')) {
        char name[LEX_NAME];
        size_t n = 0;
        while (equals[-1 - (ptrdiff_t)n] != ' ') /* the word of the geometry stands first */
            n++;
        snprintf(name, sizeof name, "%.*s", (int)n, equals - n);
        if (!is_assigned(p, name))
            add(p, name, "=");
    }
    if (shape->by == PARAMETERS_FILE && !is_given(p, "smooth"))
        add(p, "smooth", "");
}

/* The words among what a setting takes: `auto|closed|springs N`. */
static void add_setting_words(const place *p) {
    const setting *row;
    for (size_t i = 0; (row = setting_row(i)); i++) {
        if (!is_word(p, 1, row->name))
            continue;
        for (const char *s = row->usage; *s; s += strspn(s, "| ")) {
            const size_t n = strcspn(s, "| ");
            char word[LEX_NAME];
            snprintf(word, sizeof word, "%.*s", (int)n, s);
            if (strspn(word, "abcdefghijklmnopqrstuvwxyz") == n)
                add(p, word, "");
            s += n;
        }
    }
}

/* After something that may end a value: what goes on. */
static void add_continuation(const place *p) {
    const command *c = p->command;
    const bool range = has_range(c), figure = range && row_of_kind(c, ARG_NAME);
    const geometry *shape = shape_of(p);
    const bool set = takes_names(c, setting_name);
    if (set && p->count > 2)
        return;
    if (set)
        add_setting_words(p);
    else if (shape)
        add_parameters(p, shape);
    else if (c)
        add_arguments(p, c, false);
    if (load_along(p))
        add_arguments(p, load_along(p), false);
    for (size_t i = 0; i < WORD_ROWS; i++)
        if ((figure  ? words[i].of_figure
             : range ? words[i].of_range
                     : !c && words[i].of_value) &&
            !is_given(p, words[i].word))
            add(p, words[i].word, "");
    for (size_t i = 0; figure && looks_word(i); i++)
        if (!is_given(p, looks_word(i)) && strcmp(looks_word(i), "over"))
            add(p, looks_word(i), "");
}

/* The dimension that `NAME = NUMBER` wants at the cursor after the number. */
static bool wanted_dim(const place *p, dim *d) {
    size_t i = p->count - 1; /* the number */
    while (i > 0 &&
           (p->token[i].kind == T_NUMBER || p->token[i].kind == T_MINUS || p->token[i].kind == T_RANGE ||
            (p->token[i].kind == T_NAME && p->token[i - 1].kind == T_NUMBER))) /* 1 N .. 2 */
        i--;
    if (p->command && i == 0 && p->command->args && p->command->args->kind == ARG_EXPR) {
        *d = p->command->args->d;
        return true;
    }
    if (i == 0 || !assigns(p->token[i].kind))
        return false;
    const quantity *q = quantity_find(p->line + p->token[i - 1].at, p->token[i - 1].len);
    if (q)
        *d = quantity_dim(q, &p->c->scene);
    return q != NULL;
}

/* ---- where the cursor is ----------------------------------------------------------------------- */

/* Does a file name follow the tokens? */
static bool wants_file(const place *p) {
    const size_t last = p->count - 1;
    if (!p->command)
        return false;
    if (p->count == 1)
        return row_of_kind(p->command, ARG_FILE) != NULL;
    const geometry *shape = shape_of(p);
    if (shape)
        return p->count == 2 && shape->by == PARAMETERS_FILE;
    for (const arg *a = p->command->args; a && a->kind; a++)
        if (a->kind == ARG_TO && is_word(p, last, a->name))
            return true;
    for (size_t i = 0; i < WORD_ROWS; i++)
        if (words[i].what == FOLLOWS_FILE && is_word(p, last, words[i].word))
            return has_range(p->command);
    return false;
}

/* `record off`, where it has been begun: the editor completes either words or files. */
static void add_words_beside_file(const place *p) {
    const arg *a = p->cursor > p->start && p->count == 1 ? p->command->args : NULL;
    for (; a && a->kind; a++)
        if (a->kind == ARG_WORD)
            add(p, a->name, "");
}

static void complete_word(const place *p) {
    if (p->count == 0) {
        add_all(p, command_name);
        add_values(p);
        return;
    }
    const token_kind last = p->token[p->count - 1].kind;
    const bool ranges = !p->command || has_range(p->command);
    dim d = DIM_NONE;
    if (p->command && (p->count == 1 || last == T_BAR)) {
        add_arguments(p, p->command, true);
        return;
    }
    for (size_t i = 0; i < WORD_ROWS; i++)
        if (is_word(p, p->count - 1, words[i].word) &&
            add_following(p, ranges ? words[i].what : words[i].alone))
            return;
    if (last == T_NUMBER) {
        const bool known = wanted_dim(p, &d);
        const bool begun = p->cursor > p->start;
        add_units(p, !known, d);
        if (!begun && p->out->count == 1) /* the number stays what it is */
            free(p->out->word[--p->out->count]);
        if (begun || p->token[p->count - 1].at + p->token[p->count - 1].len < p->start)
            add_continuation(p);
    } else if (last == T_NAME || last == T_CLOSE || last == T_PERCENT || last == T_STRING) {
        add_continuation(p);
    } else {
        add_values(p);
    }
}

/* Of the statement at the cursor; quote: of an open one, else the cursor. False: it is a comment. */
static bool find_statement(const char *line, size_t cursor, size_t *begin, size_t *quote) {
    *begin = 0;
    *quote = cursor;
    for (size_t end; (end = shell_statement_end(line, *begin, cursor)) < cursor; *begin = end + 1)
        if (line[end] == '#')
            return false;
    for (size_t i = *begin; i < cursor; i++)
        if (line[i] == '"')
            *quote = *quote < cursor ? cursor : i;
    while (*begin < cursor && strchr(" \t\n", line[*begin]))
        ++*begin;
    return true;
}

static bool word_byte(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           (unsigned char)c >= 0x80;
}

/* Behind the last of these bytes. */
static size_t word_start(const char *line, size_t begin, size_t cursor, const char *parting) {
    while (cursor > begin && !strchr(parting, line[cursor - 1]))
        cursor--;
    return cursor;
}

void complete(const calc *c, const char *line, size_t cursor, candidates *out) {
    place p = {.c = c, .line = line, .cursor = cursor, .out = out};
    size_t begin, quote, start = cursor;
    *out = (candidates){.start = cursor};
    if (!find_statement(line, cursor, &begin, &quote))
        return;
    const bool quoted = quote < cursor;
    /* names of files and of some tables hold what elsewhere parts words */
    start = quoted ? quote : word_start(line, begin, cursor, " \t\n");
    read_tokens(&p, begin, start);
    if (!quoted && !wants_file(&p))
        read_tokens(&p, begin, start = word_start(line, begin, cursor, " \t\n,="));
    p.start = out->start = start + quoted;
    out->files = wants_file(&p);
    if (out->files && !quoted)
        add_words_beside_file(&p);
    out->files = out->files && out->count == 0;
    if (out->files || out->count > 0 || quoted)
        return;
    if (begin < cursor && line[begin] == '?') { /* of the prompt: help */
        p.start = out->start = start > begin ? start : begin + 1;
        add_all(&p, help_name);
        return;
    }
    if (p.count == 1 && p.command)
        complete_word(&p);
    if (out->count > 0)
        return;
    for (start = cursor; start > begin && word_byte(line[start - 1]);)
        start--;
    while (start < cursor && line[start] >= '0' && line[start] <= '9') /* 20N */
        start++;
    read_tokens(&p, begin, start);
    out->start = start;
    complete_word(&p);
}
