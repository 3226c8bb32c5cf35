/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The commands help, apropos and cite: one table of everything that has help. Changes nothing. */
#include "help/help.h"

#include <string.h>
#include <strings.h>

#include "commands/figures.h"
#include "help/topics.h"
#include "scene/presets.h"
#include "statement/command.h"
#include "statement/setting_table.h"
#include "statement/text.h"
#include "text/lines.h"

enum { LINE_LABEL = 64, HELP_TEXT = 1024 };

/* A row of any table as lists and searches see it: "geometry sphere  a sphere ...". NULL: none. */
typedef struct entry {
    const char *command;         /* printed before the name: the command that takes it */
    const char *name, *argument; /* argument: printed in parentheses */
    const char *kind;            /* printed before the summary, such as "a unit: " */
    char numbers[LINE_LABEL];    /* printed if summary is NULL */
    const char *summary;
    const char *keywords;            /* searched too */
    const char *text, *const *lines; /* searched only if a search of the rest finds nothing */
} entry;

/* ---- quantities -------------------------------------------------------------------------------- */

static entry quantity_entry(size_t i) {
    const quantity *q = quantity_row(i);
    return (entry){.name = q->name,
                   .argument = quantity_has_value(q) ? NULL : q->argument,
                   .summary = q->title,
                   .keywords = q->keywords,
                   .text = q->formulas[0].text};
}

/* Writes when the formula is used, in words; nothing if always. others: other rows come before it. */
static void when_text(const formula *f, bool others, char *buf, size_t size) {
    static const struct {
        unsigned when;
        const char *text;
    } words[] = {{WHEN_CALL, "as a function"},
                 {WHEN_FIRST, "on first loading"},
                 {WHEN_LATER, "after a reversal"},
                 {WHEN_STEADY, "at constant FN"},
                 {WHEN_POWER, "power-law gap"}};
    *buf = 0;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (f->when & words[i].when)
            list_word(buf, size, ", ", words[i].text);
    if (f->when == WHEN_ALWAYS && others)
        snprintf(buf, size, "else");
}

/* Has an earlier row the same formula? */
static bool is_repeated(const quantity *q, size_t row) {
    for (size_t i = 0; i < row; i++)
        if (!strcmp(q->formulas[i].text, q->formulas[row].text))
            return true;
    return false;
}

/* Has a later, unconditional row the same formula, so that it holds in any case? */
static bool holds_else(const quantity *q, size_t row) {
    for (size_t i = row + 1; i < FORMULAS && q->formulas[i].text; i++)
        if (q->formulas[i].when == WHEN_ALWAYS && !strcmp(q->formulas[i].text, q->formulas[row].text))
            return true;
    return false;
}

/* Writes dimension and unit; nothing for a pure number. row: the unit, or NULL for the SI unit. */
static void dim_line(FILE *to, const char *what, dim d, const char *row) {
    char unit_text[128], described[128];
    if (dim_equal(d, DIM_NONE)) {
        if (d.rad != 0)
            fprintf(to, "    %san angle, in deg or rad\n", what);
        return;
    }
    dim_unit(d, unit_text, sizeof unit_text);
    dim_describe(d, described, sizeof described);
    fprintf(to, "    %s%s, in %s\n", what, described, row ? row : unit_text);
}

static void quantity_help(FILE *to, size_t row) {
    const quantity *q = quantity_row(row);
    char text[HELP_TEXT], when[128];
    fprintf(to, "%s: %s\n", q->name, q->title);
    for (size_t i = 0; i < FORMULAS && q->formulas[i].text; i++) {
        const formula *f = &q->formulas[i];
        if (is_repeated(q, i))
            continue;
        when_text(f, i > 0, when, sizeof when);
        if (holds_else(q, i))
            *when = 0;
        snprintf(text, sizeof text, "%s%s%s%s%s%s", f->text, f->equation ? "  " : "",
                 f->equation ? f->equation : "", *when ? "  [" : "", when, *when ? "]" : "");
        help_wrapped(to, "    ", text, 8);
    }
    dim_line(to, "", quantity_is_input(q) && quantity_input(q) == IN_A ? DIM_NONE : q->d, q->unit);
    if (quantity_is_input(q))
        fprintf(to, "    an input%s: %s = EXPR sets it, %s := EXPR binds it\n",
                q->imposed ? " after a press by it" : "", q->name, q->name);
    if (!quantity_arguments(q))
        return;
    fprintf(to, "    as a function: %s(%s)\n", q->name, q->argument);
    snprintf(when, sizeof when, "%s %s ", q->argument, quantity_arguments(q) == 1 ? "is" : "are each");
    dim_line(to, when, q->argument_d, NULL);
    if (!dim_equal(q->argument_or, DIM_NONE))
        dim_line(to, "or ", q->argument_or, NULL);
}

/* ---- commands, settings, models ---------------------------------------------------------------- */

static entry command_entry(size_t i) {
    const command *c = command_row(i);
    return (entry){.name = c->name, .summary = c->summary, .keywords = c->keywords, .text = c->help};
}

/* Writes the usage line of a row, the clauses that its holes such as RANGE stand for, and the summary. */
static void usage_help(FILE *to, const grammar *f) {
    const hole_row *row;
    char usage[GRAMMAR_USAGE], label[LINE_LABEL];
    grammar_usage(f, usage);
    help_wrapped(to, "", usage, 6);
    for (size_t h = 0; (row = hole_at(h)); h++) {
        if (row->kind != HOLE_CLAUSES || !strstr(f->takes, row->name))
            continue;
        grammar_clauses(row, usage);
        snprintf(label, sizeof label, "      %s: ", row->name);
        help_wrapped(to, label, usage, 8);
    }
    help_wrapped(to, "  ", f->summary, 2);
}

/* If the first argument is a word with a grammar of its own (`set`, `export`), writes these usages. */
static void choices_help(FILE *to, const grammar *f) {
    const hole_row *row = grammar_first(f, HOLE_CHOICE);
    char usage[GRAMMAR_USAGE];
    for (size_t i = 0; row && row->form && (f = row->form(i)); i++) {
        grammar_usage(f, usage);
        fprintf(to, "%s    %s\n", i ? "" : "\n", usage);
        help_wrapped(to, "        ", f->summary, 8);
    }
}

/* Usage, then what the command's table prints, then its own text, which ends with the example. */
static void command_help(FILE *to, size_t i) {
    const command *c = command_row(i);
    usage_help(to, command_form(c));
    choices_help(to, command_form(c));
    if (c->print) {
        putc('\n', to);
        c->print(to);
    }
    if (c->help)
        fprintf(to, "\n%s", c->help);
}

static entry setting_entry(size_t i) {
    const setting *row = setting_row(i);
    return (entry){.command = "set ", .name = row->name, .summary = row->summary, .keywords = row->takes};
}

static void setting_help(FILE *to, size_t i) {
    usage_help(to, setting_form(i));
    fprintf(to, "\n%s", setting_row(i)->example);
}

static const char *model_name(size_t i) {
    return i < MODELS ? models[i].name : NULL;
}

/* NULL: `set model` cannot ask for it. */
static const clause *chosen_model(size_t i) {
    return grammar_clause(setting_form(setting_find("model")), models[i].name);
}

static entry model_entry(size_t i) {
    return (entry){.command = chosen_model(i) ? "set model " : NULL,
                   .name = models[i].name,
                   .kind = "a model: ",
                   .summary = models[i].title,
                   .text = model_text(i)};
}

static void model_help(FILE *to, size_t i) {
    const clause *c = chosen_model(i);
    if (c)
        fprintf(to, "set model %s%s\n  answers by: %s\n\n", c->name, c->holes ? " N" : "", models[i].title);
    else
        fprintf(to, "%s\n\n", models[i].title);
    fputs(model_text(i), to);
}

/* ---- geometries, materials, units, functions --------------------------------------------------- */

static entry geometry_entry(size_t i) {
    const geometry *g = geometry_row(i);
    return (entry){.command = "geometry ", .name = g->name, .summary = g->meaning, .keywords = g->keywords};
}

static void geometry_help(FILE *to, size_t i) {
    const geometry *g = geometry_row(i);
    usage_help(to, geometry_form(i));
    for (input in = IN_N; in < INPUTS; in++)
        if (geometry_takes(g, in))
            fprintf(to, "    %-10s  %s\n", quantity_of_input(in)->name, quantity_of_input(in)->title);
    fprintf(to, "\n%s", g->example);
}

static entry preset_entry(size_t i) {
    const preset *p = preset_row(i);
    entry e = {.command = "material ", .name = p->name, .keywords = p->source};
    preset_numbers(p, e.numbers);
    return e;
}

static void preset_help(FILE *to, size_t i) {
    const entry e = preset_entry(i);
    fprintf(to, "%s%s\n  %s\n", e.command, e.name, e.numbers);
    help_wrapped(to, "  ", e.keywords, 2);
}

static entry figure_entry(size_t i) {
    const figure *f = figure_row(i);
    return (entry){.command = "plot ", .name = f->name, .summary = f->title, .keywords = f->summary};
}

static void figure_help(FILE *to, size_t i) {
    const figure *f = figure_row(i);
    char text[HELP_TEXT];
    if (f->takes)
        grammar_usage(figure_form(i), text);
    else
        snprintf(text, sizeof text, "plot %s RANGE LOOK [to FILE]", f->name);
    fprintf(to, "%s\n  %s\n  %s\n", text, f->title, f->summary);
    if (f->statement)
        help_wrapped(to, "  as: plot ", f->statement, 6);
}

static entry unit_entry(size_t i) {
    return (entry){.name = unit_name(i), .kind = "a unit: ", .summary = unit_meaning(i), .keywords = "unit"};
}

/* Help on a unit; the word may have a prefix. */
static void unit_help(FILE *to, const char *word, const unit *u) {
    char si[128], described[128];
    dim_unit(u->d, si, sizeof si);
    if (u->d.rad != 0)
        snprintf(si, sizeof si, "rad");
    dim_describe(u->d, described, sizeof described);
    fprintf(to, "%s: %s; 1 %s = %.10Lg%s%s\n", word, u->d.rad != 0 ? "an angle" : described, word,
            unit_scale(u), *si ? " " : "", si);
}

static entry builtin_entry(size_t i) {
    return (entry){.name = builtin_name(i), .summary = builtin_summary(i), .keywords = "function"};
}

static void builtin_help(FILE *to, size_t i) {
    fprintf(to, "%s: %s\n", builtin_name(i), builtin_summary(i));
}

static entry lead_entry(size_t i) {
    return (entry){.name = hint_name(i), .summary = hint_text(i)};
}

static void lead_help(FILE *to, size_t i) {
    fprintf(to, "%s: %s\n", hint_name(i), hint_text(i));
}

static entry topic_entry(size_t i) {
    const script *t = &topics[i];
    return (entry){.command = "help ",
                   .name = t->name,
                   .summary = t->title,
                   .keywords = t->line[TOPIC_KEYWORDS],
                   .lines = t->line + TOPIC_TEXT};
}

/* ---- the table --------------------------------------------------------------------------------- */

typedef struct subject {
    const char *(*name)(size_t i); /* of row i; NULL after the last */
    entry (*entry)(size_t i);
    void (*help)(FILE *to, size_t i); /* NULL: units, which help_on looks up by the word */
} subject;

/* clang-format off */
static const subject subjects[] = {
    {command_name, command_entry, command_help},
    {topic_name, topic_entry, help_topic},
    {setting_name, setting_entry, setting_help},
    {model_name, model_entry, model_help},
    {geometry_name, geometry_entry, geometry_help},
    {preset_name, preset_entry, preset_help},
    {quantity_name, quantity_entry, quantity_help},
    {builtin_name, builtin_entry, builtin_help},
    {figure_name, figure_entry, figure_help},
    {hint_name, lead_entry, lead_help},
    {unit_name, unit_entry, NULL},
};
/* clang-format on */
enum { SUBJECTS = sizeof subjects / sizeof *subjects };

const char *help_name(size_t i) {
    const char *name = NULL;
    for (size_t s = 0; s < SUBJECTS; s++)
        for (size_t row = 0; (name = subjects[s].name(row)); row++)
            if (i-- == 0)
                return name;
    return NULL;
}

/* ---- help -------------------------------------------------------------------------------------- */

/* Writes the group of commands that begins at row i as one wrapped line; returns where the next begins. */
static size_t group_line(FILE *to, size_t i) {
    char names[HELP_TEXT] = "", label[LINE_LABEL];
    const command *c = command_row(i);
    snprintf(label, sizeof label, "    %-14s", c->group);
    do {
        list_word(names, sizeof names, " ", c->name);
        c = command_row(++i);
    } while (c && !c->group);
    help_wrapped(to, label, names, 18);
    return i;
}

/* `help` alone: fits on a screen of 80 x 24. */
static void overview(FILE *to) {
    char names[HELP_TEXT] = "";
    fputs("fret: partial-slip contact of power-law graded elastic solids.\n\n"
          "    NAME = EXPR, ...        set inputs (k = 0.5) or variables of your own\n"
          "    NAME := EXPR            a live definition, followed wherever NAME is used\n"
          "    EXPR [in UNIT], ...     print values: a, c/a, dW in uJ, dW at k=0\n\n"
          "Commands (help COMMAND tells more):\n",
          to);
    for (size_t i = 0; command_row(i);)
        i = group_line(to, i);
    for (size_t i = 0; topic_name(i); i++)
        list_word(names, sizeof names, ", ", topic_name(i));
    help_wrapped(to, "Topics: ", names, 8);
    fputs("help NAME explains any quantity, unit, geometry, setting or model, such as\n"
          "`help dW`; apropos WORD searches all help for a subject.\n\n"
          "Begin with `demo`, or:\n"
          "    material steel; geometry sphere R=10 mm; friction 0.4\n"
          "    press FN=100 N; cycle FA=20 N; dW\n",
          to);
}

/* Writes the help of everything with this name and returns how many there are. to: NULL only counts. */
static size_t help_on(FILE *to, const char *word) {
    size_t count = 0;
    const char *name;
    unit u;
    for (size_t s = 0; s < SUBJECTS; s++)
        for (size_t i = 0; subjects[s].help && (name = subjects[s].name(i)); i++)
            if (!strcmp(name, word)) {
                if (to && count > 0)
                    putc('\n', to);
                if (to)
                    subjects[s].help(to, i);
                count++;
            }
    if (*word && unit_lookup(word, strlen(word), &u)) {
        if (to)
            unit_help(to, word, &u);
        count++;
    }
    return count;
}

/* ---- search ------------------------------------------------------------------------------------ */

static bool contains(const char *text, const char *word) {
    const size_t n = strlen(word);
    while (text && *text && strncasecmp(text, word, n) != 0)
        text++;
    return text && *text;
}

/* Does the help text itself contain the word? */
static bool is_within(const entry *e, const char *word) {
    const char *const *line = e->lines;
    while (line && *line && !contains(*line, word))
        line++;
    return contains(e->text, word) || (line && *line);
}

static bool is_about(const entry *e, const char *word, bool deep) {
    return contains(e->name, word) || contains(e->kind, word) || contains(e->numbers, word) ||
           contains(e->summary, word) || contains(e->keywords, word) || (deep && is_within(e, word));
}

/* Does the entry match every word of the list, which ends with an empty one? */
static bool is_about_all(const entry *e, char (*words)[LEX_NAME], bool deep) {
    while (**words && is_about(e, *words, deep))
        words++;
    return !**words;
}

/* Writes a line for each match, and counts them. to: NULL only counts; deep: searches the texts, too. */
static size_t list_about(FILE *to, char (*words)[LEX_NAME], bool deep) {
    enum { LABELS = 10 };
    size_t count = 0;
    for (size_t s = 0; s < SUBJECTS; s++)
        for (size_t i = 0; subjects[s].name(i); i++) {
            const entry e = subjects[s].entry(i);
            char label[LINE_LABEL];
            if (!is_about_all(&e, words, deep))
                continue;
            snprintf(label, sizeof label, "%s%s%s%s%s", e.command ? e.command : "", e.name,
                     e.argument ? "(" : "", e.argument ? e.argument : "", e.argument ? ")" : "");
            if (to)
                fprintf(to, "%-*s  %s%s\n", LABELS, label, e.kind ? e.kind : "",
                        e.summary ? e.summary : e.numbers);
            count++;
        }
    return count;
}

const char *help_command_for(const char *word) {
    enum { LEAST = 3 }; /* letters: one or two are found in nearly every entry */
    char words[2][LEX_NAME] = {"", ""};
    snprintf(words[0], LEX_NAME, "%s", word);
    if (!figure_find(word, strlen(word)) && help_on(NULL, word)) /* figures are found by `plot` */
        return "help";
    return strlen(word) >= LEAST && list_about(NULL, words, false) ? "apropos" : NULL;
}

/* ---- the commands ------------------------------------------------------------------------------- */

/* Is the word part of the grammar: a clause without an argument, or a word of a table? */
static bool has_word(const grammar *f, const char *word) {
    const clause *known = grammar_clause(f, word);
    size_t row;
    for (const clause *a = f->clause; a < f->clause + f->count; a++)
        if (a->holes && a->hole[0].row->words && word_among(a->hole[0].row->words, word, strlen(word), &row))
            return true;
    return known && !known->argument;
}

/* The name of the help page that explains a word used inside statements, or NULL. */
static const char *told_in(const char *word) {
    static const char *const words[][2] = {{"at", "expressions"},
                                           {"in", "expressions"},
                                           {"ans", "expressions"},
                                           {"to", "files"},
                                           {"smooth", "files"}};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (!strcmp(word, words[i][0]))
            return words[i][1];
    for (size_t i = 0; *word && command_row(i); i++)
        if (has_word(command_form(command_row(i)), word))
            return command_name(i);
    return NULL;
}

static bool no_help(lexer *lx, const char *word) {
    const char *told = told_in(word), *near = *word ? suggest(word, help_name) : NULL;
    const bool about = help_command_for(word) != NULL;
    if (told)
        return lex_fail(lx, "no help on '%s' alone; try: help %s", word, told);
    if (near)
        return lex_fail(lx, "no help on '%s': did you mean %s?%s%s", word, near,
                        about ? " Try also: apropos " : "", about ? word : "");
    return lex_fail(lx, "no help on '%.*s'; try: %s%s", LEX_WORD(lx), about ? "apropos " : "help",
                    about ? word : "");
}

/* Gets the word that help is wanted on: the second of `geometry cone`, the name in p(r) and FN=100 N. */
static bool read_word(lexer *lx, const parsed *all, char word[LEX_NAME]) {
    unsigned i = 0;
    hole_word(lx, &all->list[0], word);
    if (all->count > 1 && command_find(word, strlen(word)))
        hole_word(lx, &all->list[++i], word);
    lx->at = all->list[i].at;
    lx->len = all->list[i].hole[0].len;
    if (!help_on(NULL, word) && strpbrk(word, "(=")) {
        word[strcspn(word, "(=")] = 0;
        lx->len = lx->end - lx->at;
        i = all->count - 1;
    }
    if (!help_on(NULL, word))
        return no_help(lx, word);
    if (i + 1 == all->count)
        return true;
    lex_seek(lx, all->list[i + 1].at);
    return at_end(lx);
}

bool do_help(shell *sh, lexer *lx, parsed *all) {
    char word[LEX_NAME] = "";
    text_out t;
    if (all->count && !read_word(lx, all, word))
        return false;
    if (!text_begin(&t, sh, TEXT_WORDS, lx->error))
        return false;
    if (all->count)
        help_on(t.to, word);
    else
        overview(t.to);
    return text_end(&t, true);
}

bool do_cite(shell *sh, lexer *lx, parsed *all) {
    text_out t;
    (void)all;
    if (!text_begin(&t, sh, TEXT_WORDS, lx->error))
        return false;
    help_cite(t.to);
    return text_end(&t, true);
}

bool do_apropos(shell *sh, lexer *lx, parsed *all) {
    char words[GIVEN_CLAUSES + 1][LEX_NAME] = {""};
    bool known = true; /* false: a word is too long to be in the name buffers, and so is nothing's name */
    text_out t;
    if (!all->list[0].hole[0].len)
        return lex_fail(lx, "apropos what? such as: apropos radius");
    for (unsigned i = 0; i < all->count; i++) {
        hole_word(lx, &all->list[i], words[i]);
        known = known && *words[i];
    }
    const span *last = &all->list[all->count - 1].hole[0];
    const size_t at = all->list[0].at, len = last->at + last->len - at;
    if (!text_begin(&t, sh, TEXT_WORDS, lx->error))
        return false;
    if (!known || (!list_about(t.to, words, false) && !list_about(t.to, words, true)))
        fprintf(t.to, "nothing on '%.*s'%s\n", LEX_SHOWN(len), lx->text + at,
                all->count > 1 ? "; try one word" : "");
    return text_end(&t, true);
}
