/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "unit.h"

#define unit calc_unit /* the other one is at work here */
#include "statement/command.h"
#include "statement/setting_table.h"
#undef unit

static grammar row;

static bool parses(const char *takes) {
    const char *at;
    row = (grammar){.command = "test", .takes = takes};
    return grammar_parse(&row, holes, &at);
}

static void all_rows(void) {
    size_t shapes = 0;
    for (const command *c = commands; c->name; c++)
        if (!CHECK(parses(c->takes)))
            printf("%s %s\n", c->name, c->takes);
    for (const geometry *g; (g = geometry_row(shapes)); shapes++)
        if (!CHECK(parses(g->takes)))
            printf("%s %s\n", g->name, g->takes);
    for (size_t i = 0; setting_row(i); i++)
        if (!CHECK(parses(setting_row(i)->takes)))
            printf("%s %s\n", setting_row(i)->name, setting_row(i)->takes);
    for (const hole_row *h = holes; h->name; h++)
        for (size_t i = 0; h->kind == HOLE_CLAUSES && h->words(i); i++)
            CHECK(parses(h->words(i)));
    CHECK(shapes > 0 && parses(""));
    CHECK(row.count == 0);
}

static void malformed(void) {
    static const char *const lines[] = {
        "[steps N", "steps N]",          "[]",          "[[all]]",    "| all",
        "all |",    "all | | off",       "steps NIX",   "nix=1 N",    "Fx:=1 N",
        "=EXPR",    "for NAME = x",      "for NAME +-", "mu=0.3 | ]", "a_word_that_is_far_too_long",
        "?",        "for EXPR EXPR EXPR"};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++)
        if (!CHECK(!parses(lines[i])))
            printf("%s\n", lines[i]);
}

static void arguments(void) {
    CHECK(parses("[Fx+=20 N | dx+=0.5 um] [FN:=120 N steel] dz=1 um [steps N:1000]"));
    CHECK(row.count == 5);
    const clause *Fx = &row.clause[0], *dx = &row.clause[1], *FN = &row.clause[2], *dz = &row.clause[3],
                 *steps = &row.clause[4];
    CHECK(Fx->argument && Fx->increment && !Fx->live && Fx->optional && dim_equal(Fx->d, DIM_FORCE));
    CHECK(Fx->group && Fx->group == dx->group && Fx->alternative != dx->alternative && Fx->in == 0 &&
          Fx->must == ANY);
    CHECK(FN->live && !FN->increment && FN->in == 1 + IN_FN && FN->group == 0);
    CHECK(!dz->optional && dz->in == 1 + IN_DZ);
    CHECK(!steps->argument && steps->holes == 1 && steps->hole[0].most == 1000);
    CHECK(grammar_clause(&row, "steps") == steps && !grammar_clause(&row, "step"));
}

static void ways(void) {
    CHECK(parses("R:=10 mm | R1=20 mm R2=20 mm"));
    CHECK(row.clause[1].alternative == row.clause[2].alternative &&
          row.clause[0].alternative != row.clause[1].alternative);
    CHECK(row.clause[0].group == row.clause[2].group && row.clause[2].must == CURVED);
    CHECK(parses("n:=3 [A:=50 m^-2 | h:=1 um r0:=1 mm] [all]"));
    CHECK(row.clause[0].group == 0 && row.clause[4].group == 0);
    CHECK(row.clause[1].group && row.clause[1].group == row.clause[3].group);
}

static void clauses_with_holes(void) {
    CHECK(parses("EXPR, ... over NAME = LO .. HI, ... [log AXES]*"));
    CHECK(row.count == 3 && row.clause[0].list && !*row.clause[0].name);
    CHECK(row.clause[1].list && row.clause[1].holes == 2 && row.clause[1].hole[1].before == '=');
    CHECK(row.clause[1].hole[1].row->kind == HOLE_SPAN);
    CHECK(row.clause[2].again && !row.clause[1].again);
    CHECK(parses("EXPR RANGE [to FILE.png|svg]"));
    CHECK(grammar_clause(&row, "for")->again && grammar_clause(&row, "to")->optional);
    CHECK(parses("WORD ...") && row.clause[0].again && !row.clause[0].list);
    CHECK(parses("EXPR RANGE [to FILE.png|svg]"));
    CHECK(grammar_first(&row, HOLE_EXPR) && !grammar_first(&row, HOLE_FILE));
}

static void usage(void) {
    char text[GRAMMAR_USAGE];
    CHECK(parses("[Fx+=20 N | dx+=0.5 um] [steps N:1000]"));
    grammar_usage(&row, text);
    CHECK(!strcmp(text, "test [Fx=20 N | dx=0.5 um] [steps N], += for an increment"));
    row = (grammar){.command = "geometry", .shape = "cone", .takes = "slope:=0.05 | angle=3 deg"};
    grammar_usage(&row, text);
    CHECK(!strcmp(text, "geometry cone slope=0.05 | angle=3 deg"));
    row = (grammar){.command = "undo", .takes = ""};
    grammar_usage(&row, text);
    CHECK(!strcmp(text, "undo"));
    struct {
        char text[GRAMMAR_USAGE], behind[2 * GRAMMAR_USAGE];
    } room = {.behind = ""};
    char takes[GRAMMAR_USAGE + 20] = "";
    memset(takes, 'a', sizeof takes - 1);
    row = (grammar){.command = takes + GRAMMAR_USAGE / 2, .takes = takes};
    grammar_usage(&row, room.text);
    CHECK(strlen(room.text) > GRAMMAR_USAGE - 40 && strlen(room.text) < GRAMMAR_USAGE && !*room.behind);
}

int main(int argc, char **argv) {
    unit_start("grammar", argc, argv);
    CASE(all_rows());
    CASE(malformed());
    CASE(arguments());
    CASE(ways());
    CASE(clauses_with_holes());
    CASE(usage());
    return unit_finish();
}
