/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of settings, and reading and showing them. Touches the settings and the scene's choice of a
 * model. */
#include "statement/settings.h"

#include <stdlib.h>
#include <string.h>

#include "statement/cursor.h"
#include "text/lines.h"

/* ---- neither a word nor a number --------------------------------------------------------------- */

static const char *const terminals[] = {"auto", "dumb", "block", "sixel", NULL};

static bool read_word(const char *const *words, lexer *lx, int *out);

static bool parse_terminal(settings *set, lexer *lx) {
    int choice;
    if (!read_word(terminals, lx, &choice) || !at_end(lx))
        return false;
    set->plot_terminal = choice;
    return true;
}

/* 80x24 reads as the number 80 and the name x24. */
static bool parse_plot(calc *c, settings *set, lexer *lx) {
    enum { LEAST_WIDTH = 20, LEAST_HEIGHT = 8, SIZE = 30 };
    char text[SIZE + 1];
    int width = 0, height = 0, used = 0;
    (void)c;
    if (lex_accept(lx, "terminal"))
        return parse_terminal(set, lx);
    if (!lex_accept(lx, "auto")) {
        const size_t left = lx->end - lx->at;
        snprintf(text, sizeof text, "%.*s", (int)(left < SIZE ? left : SIZE), lx->text + lx->at);
        if (sscanf(text, "%4dx%4d%n", &width, &height, &used) != 2 || width < LEAST_WIDTH ||
            height < LEAST_HEIGHT)
            return lex_fail(lx, "expected a size such as 80x24 (at least %dx%d), auto or terminal",
                            LEAST_WIDTH, LEAST_HEIGHT);
        lx->len = (size_t)used;
        lex_next(lx);
    }
    if (!at_end(lx))
        return false;
    set->plot_width = width;
    set->plot_height = height;
    return true;
}

static void show_plot(const calc *c, const settings *set, FILE *to) {
    (void)c;
    if (set->plot_width)
        fprintf(to, "%dx%d", set->plot_width, set->plot_height);
    else
        fputs("auto", to);
    if (set->plot_terminal)
        fprintf(to, "\nset plot terminal %s", terminals[set->plot_terminal]);
}

static bool parse_model(calc *c, settings *set, lexer *lx) {
    enum { MOST_SPRINGS = 10000000 };
    model_id id = 0, last = 0;
    unsigned count = 0;
    (void)set;
    const bool automatic = lex_accept(lx, "auto");
    for (id = 0; !automatic && id < MODELS; id++)
        if (models[id].chosen && lex_accept(lx, models[id].name))
            break;
    if (!automatic && id == MODELS) {
        char list[CALC_ERROR_TEXT / 2] = "auto";
        for (id = 0; id < MODELS; id++)
            if (models[id].chosen)
                last = id;
        for (id = 0; id < MODELS; id++)
            if (models[id].chosen)
                list_word(list, sizeof list, models[id].name, id == last);
        return lex_fail(lx, "expected %s", list);
    }
    if (!automatic && models[id].count && !read_count(c, lx, models[id].count, MOST_SPRINGS, &count))
        return false;
    if (!at_end(lx))
        return false;
    scene_set_model(&c->scene, automatic, automatic ? MODEL_CLOSED : id, count);
    return true;
}

static void show_model(const calc *c, const settings *set, FILE *to) {
    const scene *s = &c->scene;
    (void)set;
    fputs(s->automatic ? "auto" : models[s->model].name, to);
    if (!s->automatic && models[s->model].count)
        fprintf(to, " %u", s->springs);
}

/* A number of cores is the calculator's. */
static bool parse_cores(calc *c, settings *set, lexer *lx) {
    enum { MOST_CORES = 64 };
    unsigned count = 0;
    (void)set;
    if (!lex_accept(lx, "auto") && !read_count(c, lx, "the number of cores", MOST_CORES, &count))
        return false;
    if (!at_end(lx))
        return false;
    c->cores = count;
    return true;
}

static void show_cores(const calc *c, const settings *set, FILE *to) {
    (void)set;
    if (c->cores)
        fprintf(to, "%u", c->cores);
    else
        fputs("auto", to);
}

static bool has_cores(const calc *c, const settings *set) {
    (void)set;
    return c->cores > 0;
}

static bool has_plot(const calc *c, const settings *set) {
    (void)c;
    return set->plot_width > 0;
}

const settings settings_initial = {.digits = 6};

/* ---- the table --------------------------------------------------------------------------------- */

const char *const format_names[] = {
    [FORMAT_TEXT] = "text", [FORMAT_CSV] = "csv", [FORMAT_JSON] = "json", NULL};
static const char *const reports[] = {"auto", "off", "on", NULL}, *const switches[] = {"off", "on", NULL};

static const setting rows[] = {
    {.name = "format",
     .usage = "text|csv|json",
     .summary = "how answers and tables are written; JSON: an object a line",
     .example = "    fret> set format csv\n"
                "    fret> pi, 1 mm\n"
                "    pi,1 mm [m]\n"
                "    3.1415926535897931,0.001\n"
                "    fret> set format json\n"
                "    fret> 1 mm\n"
                "    {\"name\":\"1 mm\",\"value\":0.001,\"unit\":\"m\"}\n",
     .words = format_names,
     .at = offsetof(settings, format)},
    {.name = "digits",
     .usage = "N",
     .summary = "significant digits of numbers as text, 1 to 17",
     .example = "    fret> set digits 12\n"
                "    fret> pi\n"
                "    pi = 3.14159265359\n",
     .most = 17,
     .at = offsetof(settings, digits)},
    {.name = "report",
     .usage = "auto|on|off",
     .summary = "what press, step and cycle tell of themselves; auto: at the prompt",
     .example = "    fret> set report on\n"
                "    fret> material steel; geometry sphere R=10 mm; press FN=100 N\n"
                "      FN = 100 N, a = 186.626 um, dz = 3.48291 um\n",
     .words = reports,
     .at = offsetof(settings, report)},
    {.name = "timing",
     .usage = "on|off",
     .summary = "the time of each statement, and the models that answered",
     .example = "    fret> set timing on\n"
                "    fret> pi\n"
                "    pi = 3.14159\n"
                "    time: 0.000241 ms\n",
     .words = switches,
     .at = offsetof(settings, timing)},
    {.name = "pager",
     .usage = "auto|on|off",
     .summary = "show text by $PAGER; auto: what the terminal is too low for",
     .example = "    fret> set pager off\n",
     .words = reports,
     .at = offsetof(settings, pager)},
    {.name = "model",
     .usage = "auto|closed|memory|springs N",
     .summary = "what answers for tangential loads; auto: the cheapest exact one",
     .example =
         "    fret> material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N; cycle FA=20 N\n"
         "    fret> dW\n"
         "    dW = 1.90646 uJ\n"
         "    fret> set model springs 100\n"
         "    fret> dW\n"
         "    dW = 1.90687 uJ\n",
     .parse = parse_model,
     .show = show_model},
    {.name = "plot",
     .usage = "WxH|auto|terminal auto|dumb|block|sixel",
     .summary = "size of plots in the terminal, in characters, and how they are drawn there",
     .example = "    fret> set plot 64x18\n",
     .parse = parse_plot,
     .show = show_plot,
     .differs = has_plot},
    {.name = "cores",
     .usage = "auto|N",
     .summary =
         "processes that long tables, maps, fits and samples are shared among; auto: one for each core",
     .example = "    fret> set cores 1\n",
     .parse = parse_cores,
     .show = show_cores,
     .differs = has_cores},
};
enum { SETTINGS = sizeof rows / sizeof *rows };

const setting *setting_row(size_t i) {
    return i < SETTINGS ? &rows[i] : NULL;
}

const char *setting_name(size_t i) {
    return i < SETTINGS ? rows[i].name : NULL;
}

/* ---- by the table ------------------------------------------------------------------------------ */

static bool read_word(const char *const *words, lexer *lx, int *out) {
    char list[CALC_ERROR_TEXT / 2] = "";
    for (int i = 0; words[i]; i++)
        if (lex_accept(lx, words[i])) {
            *out = i;
            return true;
        }
    for (int i = 0; words[i]; i++)
        list_word(list, sizeof list, words[i], !words[i + 1]);
    return lex_fail(lx, "expected %s", list);
}

bool setting_read(calc *c, settings *set, lexer *lx) {
    const setting *row = rows;
    while (row < rows + SETTINGS && !lex_is(lx, row->name))
        row++;
    if (row == rows + SETTINGS) {
        char list[CALC_ERROR_TEXT / 2] = "";
        for (size_t i = 0; i < SETTINGS; i++)
            list_word(list, sizeof list, rows[i].name, i + 1 == SETTINGS);
        return lex_fail(lx, "expected %s", list);
    }
    lex_next(lx);
    if (row->parse)
        return row->parse(c, set, lx);
    int choice = 0;
    unsigned count = 0;
    if (row->words ? !read_word(row->words, lx, &choice)
                   : !read_count(c, lx, row->name, (unsigned)row->most, &count))
        return false;
    if (!at_end(lx))
        return false;
    choice = row->words ? choice : (int)count;
    memcpy((char *)set + row->at, &choice, sizeof choice);
    return true;
}

void setting_show(const setting *row, const calc *c, const settings *set, FILE *to) {
    int v = 0;
    fprintf(to, "set %s ", row->name);
    if (!row->show)
        memcpy(&v, (const char *)set + row->at, sizeof v);
    if (row->show)
        row->show(c, set, to);
    else if (row->words)
        fputs(row->words[v], to);
    else
        fprintf(to, "%d", v);
    fputc('\n', to);
}

void settings_write(const calc *c, const settings *set, FILE *to) {
    for (const setting *row = rows; row < rows + SETTINGS; row++)
        if (row->show ? row->differs && row->differs(c, set)
                      : memcmp((const char *)set + row->at, (const char *)&settings_initial + row->at,
                               sizeof(int)) != 0)
            setting_show(row, c, set, to);
}
