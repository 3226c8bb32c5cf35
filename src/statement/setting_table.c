/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of settings; sets and shows them. Changes shell.set and the scene's model. */
#include "statement/setting_table.h"

#include <stddef.h>
#include <string.h>

/* ---- settings that are no int ------------------------------------------------------------------ */

static const char *const papers[] = {
    [PAPER_USUAL] = "auto", [PAPER_SLIDE] = "slide", [PAPER_COLUMN] = "column"};
static const char *const terminals[] = {"auto", "dumb", "block", "sixel"};

const char *terminal_name(size_t i) {
    return i < sizeof terminals / sizeof *terminals ? terminals[i] : NULL;
}

const char *switch_name(size_t i) {
    static const char *const switches[] = {"off", "on"};
    return i < sizeof switches / sizeof *switches ? switches[i] : NULL;
}

static bool set_plot(shell *sh, lexer *lx, const parsed *all) {
    enum { LEAST_WIDTH = 20, LEAST_HEIGHT = 8, SIZE = 30 };
    const given_clause *h = &all->list[0];
    const size_t len = h->hole[0].len;
    char text[SIZE + 1] = "";
    int width = 0, height = 0, used = 0;
    if (!strcmp(h->of->name, "terminal")) {
        sh->set.plot_terminal = (int)h->choice;
        return true;
    }
    if (!strcmp(h->of->name, "caption")) {
        sh->set.plot_caption = (int)h->choice;
        return true;
    }
    for (int paper = PAPER_SLIDE; paper <= PAPER_COLUMN; paper++)
        if (!strcmp(h->of->name, papers[paper])) {
            sh->set.plot_paper = paper;
            return true;
        }
    if (h->of->holes) {
        snprintf(text, sizeof text, "%.*s", (int)(len < SIZE ? len : SIZE), lx->text + h->hole[0].at);
        if (sscanf(text, "%4dx%4d%n", &width, &height, &used) != 2 || (size_t)used != len ||
            width < LEAST_WIDTH || height < LEAST_HEIGHT)
            return calc_fail(
                lx->error, h->hole[0].at, len,
                "expected a size such as 80x24 (at least %dx%d), auto, terminal, caption, slide or column",
                LEAST_WIDTH, LEAST_HEIGHT);
    }
    if (!h->of->holes)
        sh->set.plot_paper = PAPER_USUAL;
    sh->set.plot_width = width;
    sh->set.plot_height = height;
    return true;
}

static void show_plot(const shell *sh, FILE *to) {
    const settings *set = &sh->set;
    if (set->plot_width)
        fprintf(to, "%dx%d", set->plot_width, set->plot_height);
    else
        fputs("auto", to);
    if (set->plot_paper)
        fprintf(to, "\nset plot %s", papers[set->plot_paper]);
    if (set->plot_terminal)
        fprintf(to, "\nset plot terminal %s", terminals[set->plot_terminal]);
    if (set->plot_caption)
        fputs("\nset plot caption on", to);
}

/* The model belongs to the scene. */
static bool set_model(shell *sh, lexer *lx, const parsed *all) {
    const given_clause *h = &all->list[0];
    model_id id = 0;
    (void)lx;
    while (id != MODEL_AUTO && strcmp(models[id].name, h->of->name) != 0)
        id++;
    scene_set_model(&sh->calc.scene, id, h->of->holes ? h->count : 0);
    return true;
}

static void show_model(const shell *sh, FILE *to) {
    const scene *s = &sh->calc.scene;
    fputs(s->model == MODEL_AUTO ? "auto" : models[s->model].name, to);
    if (s->springs)
        fprintf(to, " %u", s->springs);
}

static bool has_plot(const shell *sh) {
    const settings *set = &sh->set;
    return set->plot_width > 0 || set->plot_terminal || set->plot_caption || set->plot_paper;
}

enum { DIGITS = 6 };
const settings settings_initial = {.digits = DIGITS};

/* ---- the table --------------------------------------------------------------------------------- */

static const setting rows[] = {
    {.name = "format",
     .takes = "text | csv | json",
     .summary = "how answers and tables are written; JSON: an object a line",
     .example = "    fret> set format csv\n"
                "    fret> pi, 1 mm\n"
                "    pi,1 mm [m]\n"
                "    3.1415926535897931,0.001\n"
                "    fret> set format json\n"
                "    fret> 1 mm\n"
                "    {\"name\":\"1 mm\",\"value\":0.001,\"unit\":\"m\"}\n",
     .at = offsetof(shell, set.format)},
    {.name = "digits",
     .takes = "N:17",
     .summary = "significant digits of numbers as text, 1 to 17",
     .example = "    fret> set digits 12\n"
                "    fret> pi\n"
                "    pi = 3.14159265359\n",
     .at = offsetof(shell, set.digits),
     .initial = DIGITS},
    {.name = "report",
     .takes = "auto | off | on",
     .summary = "whether press, step and cycle report; auto: at the prompt only",
     .example = "    fret> set report on\n"
                "    fret> material steel; geometry sphere R=10 mm; press FN=100 N\n"
                "      FN = 100 N, a = 186.626 um, dz = 3.48291 um\n",
     .at = offsetof(shell, set.report)},
    {.name = "timing",
     .takes = "off | on",
     .summary = "print the time of each statement, and the models used",
     .example = "    fret> set timing on\n"
                "    fret> pi\n"
                "    pi = 3.14159\n"
                "    time: 0.000241 ms\n",
     .at = offsetof(shell, set.timing)},
    {.name = "pager",
     .takes = "auto | off | on",
     .summary = "show text with $PAGER; auto: only text longer than the screen",
     .example = "    fret> set pager off\n",
     .at = offsetof(shell, set.pager)},
    {.name = "model",
     .takes = "auto | closed | memory | springs N:10000000",
     .summary = "the model for tangential loads; auto: the cheapest exact one",
     .example = "    fret> material steel; geometry sphere R=10 mm; friction 0.4; press "
                "FN=100 N; cycle FA=20 N\n"
                "    fret> dW\n"
                "    dW = 1.90646 uJ\n"
                "    fret> set model springs 100\n"
                "    fret> dW\n"
                "    dW = 1.90687 uJ\n",
     .apply = set_model,
     .show = show_model},
    {.name = "plot",
     .takes = "SIZE | auto | terminal TERMINAL | caption SWITCH | slide | column",
     .summary = "size of plots in the terminal, such as 80x24, and how they are drawn "
                "there: auto, dumb, block or sixel; caption on: the scene below figures; "
                "pictures for a slide or the column of a paper",
     .example = "    fret> set plot 64x18\n",
     .apply = set_plot,
     .show = show_plot,
     .differs = has_plot},
    {.name = "cores",
     .takes = "N:64 | auto",
     .summary = "number of processes for long tables, maps, fits and samples; auto: one for each core",
     .example = "    fret> set cores 1\n",
     .at = offsetof(shell, calc.cores)},
};
enum { SETTINGS = sizeof rows / sizeof *rows };

const setting *setting_row(size_t i) {
    return i < SETTINGS ? &rows[i] : NULL;
}

const char *setting_name(size_t i) {
    return i < SETTINGS ? rows[i].name : NULL;
}

size_t setting_find(const char *name) {
    size_t i;
    word_among(setting_name, name, strlen(name), &i);
    return i;
}

/* ---- setting and showing ----------------------------------------------------------------------- */

const grammar *setting_form(size_t i) {
    return i < SETTINGS ? grammar_made("set", rows[i].name, rows[i].takes, rows[i].summary) : NULL;
}

static int *value_of(const shell *sh, const setting *row) {
    return (int *)(void *)((char *)sh + row->at);
}

/* Index of the first word among the clauses: 1 behind the hole of a number, where the word means 0. */
static int first_word(const grammar *f) {
    return *f->clause->name ? 0 : 1;
}

bool setting_apply(shell *sh, lexer *lx, const parsed *all) {
    const setting *row = &rows[all->row];
    const given_clause *h = &all->list[0];
    if (row->apply)
        return row->apply(sh, lx, all);
    *value_of(sh, row) = h->of->holes ? (int)h->count : (int)(h->of - all->by->clause) - first_word(all->by);
    return true;
}

bool setting_format(settings *set, const char *word) {
    const grammar *f = setting_form(setting_find("format"));
    const clause *a = grammar_clause(f, word);
    if (a)
        set->format = (int)(a - f->clause);
    return a != NULL;
}

void setting_show(size_t i, const shell *sh, FILE *to) {
    const setting *row = &rows[i];
    const grammar *f = setting_form(i);
    const int is = row->show ? 0 : *value_of(sh, row);
    fprintf(to, "set %s ", row->name);
    if (row->show)
        row->show(sh, to);
    else if (first_word(f) && is)
        fprintf(to, "%d", is);
    else
        fputs(f->clause[is + first_word(f)].name, to);
    fputc('\n', to);
}

void settings_write(const shell *sh, FILE *to) {
    for (size_t i = 0; i < SETTINGS; i++)
        if (rows[i].show ? rows[i].differs && rows[i].differs(sh)
                         : *value_of(sh, &rows[i]) != rows[i].initial)
            setting_show(i, sh, to);
}
