/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "unit.h"

#define unit calc_unit /* the other one is at work here */
#include "help/complete.h"
#include "statement/command.h"
#include "statement/setting_table.h"
#undef unit

static shell sh;
static calc_error wrong;
static lexer lx;
static parsed all;

/* The statement by its row. */
static bool reads(const char *text) {
    error_clear(&wrong);
    lex_start(&lx, text, strlen(text), &wrong);
    const command *c = command_find(text, strcspn(text, " "));
    lex_next(&lx);
    return parsed_read(&sh, &lx, command_form(c), &all);
}

static bool fails(const char *text, const char *why) {
    const bool ok = !reads(text) && strstr(wrong.text, why);
    if (!ok)
        printf("%s: %s\n", text, wrong.text);
    return ok;
}

/* Does the i-th clause of this name have these holes? other: NULL where it has one. */
static bool has(const char *name, size_t i, const char *first, const char *other) {
    const char *want[CLAUSE_HOLES] = {first, other};
    const given_clause *h = parsed_clause(&all, name, i);
    for (size_t k = 0; h && k < CLAUSE_HOLES && want[k]; k++) {
        const span *part = &h->hole[k];
        if (strlen(want[k]) != part->len || memcmp(lx.text + part->at, want[k], part->len) != 0) {
            printf("%s: %.*s\n", name, (int)part->len, lx.text + part->at);
            return false;
        }
    }
    return h != NULL;
}

static void cut(void) {
    CHECK(reads("table with*x, log(for) in mm for x = 1 .. log(3) with with = 1, 2 steps 7 to a to b.csv") ==
          false);
    CHECK(reads("table with*x, (x for) in mm for x = 1 .. log(3) with with = 1, 2 steps 7 to a,b.csv"));
    CHECK(has("", 0, "with*x, (x for) in mm", NULL) && has("for", 0, "x", "1 .. log(3)"));
    CHECK(has("with", 0, "with", "1, 2") && has("to", 0, "a,b.csv", NULL));
    CHECK(parsed_clause(&all, "steps", 0)->count == 7 && !parsed_clause(&all, "steps", 1) &&
          !parsed_clause(&all, "along", 0));
    parsed_drop(&sh, &all);
    CHECK(reads("solve mu for dW at k=0, FN = 3 N = 5 uJ from 0.3 to 1"));
    CHECK(has("for", 0, "dW at k=0, FN = 3 N", "5 uJ") && has("from", 0, "0.3 to 1", NULL));
    parsed_drop(&sh, &all);
    CHECK(
        reads("plot Fx along cycle FA=20 N times 3 steps 40 log y log flip xy title \"a | b\" over \"c d\""));
    CHECK(has("along", 0, "cycle FA=20 N times 3", NULL) && has("title", 0, "\"a | b\"", NULL));
    CHECK(parsed_clause(&all, "log", 0)->of->holes == 1 && parsed_clause(&all, "log", 1)->of->holes == 0);
    CHECK(parsed_clause(&all, "log", 0)->choice == 1 && parsed_clause(&all, "flip", 0)->choice == 2);
    CHECK(has("over", 0, "\"c d\"", NULL));
    parsed_drop(&sh, &all);
}

static void lists(void) {
    CHECK(reads("maximize x*y over x = 1 .. 2, y = 3 .. 4"));
    CHECK(has("over", 0, "x", "1 .. 2") && has("over", 1, "y", "3 .. 4") && !parsed_clause(&all, "over", 2));
    parsed_drop(&sh, &all);
    CHECK(reads("uncertainty a, dz with mu +- 0.02, E0 +- 5 % seed 3"));
    CHECK(has("", 0, "a, dz", NULL) && has("with", 0, "mu", "0.02") && has("with", 1, "E0", "5 %"));
    parsed_drop(&sh, &all);
    CHECK(reads("fit E0, mu for a = b to c.csv"));
    CHECK(has("", 0, "E0, mu", NULL) && has("for", 0, "a", "b"));
    parsed_drop(&sh, &all);
}

/* The row of the word that stands first; words up to blanks. */
static void heads(void) {
    CHECK(reads("set plot 80x24") && all.row == setting_find("plot") && has("", 0, "80x24", NULL));
    CHECK(reads("set cores 4") && all.row == setting_find("cores") && all.list[0].count == 4);
    CHECK(reads("set") && all.by->shape == NULL && all.count == 0);
    CHECK(reads("geometry flat-cone b=1 mm slope=0.1") && !strcmp(all.by->shape, "flat-cone"));
    CHECK(reads("apropos (x \"y z") && all.count == 3 && has("", 1, "\"y", NULL));
    CHECK(fails("set report of", "did you mean off?") && fails("geometry con", "did you mean cone?"));
    CHECK(fails("set format", "expected text, csv or json") &&
          fails("set timing on off", "give either off or on"));
    CHECK(fails("table a*for x = 1 .. 2 to b.csv", "something is missing") ==
          false); /* its command says it */
    CHECK(parsed_swallowed(&lx, &all, "for") && !parsed_swallowed(&lx, &all, "along"));
    parsed_drop(&sh, &all);
}

/* Names of a range are known while what has been said is, and no longer. */
static void names(void) {
    size_t i;
    CHECK(!names_find(&sh.calc.names, "x", 1, &i));
    CHECK(reads("table x for x = 1 .. 2") && names_find(&sh.calc.names, "x", 1, &i));
    parsed_drop(&sh, &all);
    CHECK(!names_find(&sh.calc.names, "x", 1, &i) && sh.calc.names.count == 0);
    CHECK(fails("table x for x = 1 .. 2 | 3", "unexpected '|'"));
    CHECK(!names_find(&sh.calc.names, "x", 1, &i));
}

static void arguments(void) {
    CHECK(reads("step Fx+=2*3 N FN=1 kN steps 4") && all.count == 3);
    const given_clause *Fx = parsed_clause(&all, "Fx", 0), *FN = parsed_clause(&all, "FN", 0);
    CHECK(Fx->increment && Fx->v.v == 6 && !FN->increment && FN->v.v == 1000);
    CHECK(reads("cycle FA:=0.9*mu*FN") && parsed_clause(&all, "FA", 0)->live);
    parsed_drop(&sh, &all);
    CHECK(!parsed_clause(&all, "FA", 0)->live);
    CHECK(reads("material steel nu=0.28") && parsed_clause(&all, "", 0) && parsed_clause(&all, "nu", 0));
    CHECK(reads("record off") && parsed_clause(&all, "off", 0));
    CHECK(reads("record off.txt") && has("", 0, "off.txt", NULL));
    CHECK(reads("friction mu=0.3") && parsed_clause(&all, "", 0)->v.v == 0.3);
}

static void errors(void) {
    CHECK(fails("step Fx=1 N Fx=2 N", "Fx is given twice"));
    CHECK(fails("step Fx=1 N dx=2 um", "give either Fx or dx"));
    CHECK(fails("step Fx:=1 N", "does not take Fx by :="));
    CHECK(fails("step a=1 m", "step has no argument 'a'"));
    CHECK(fails("step Fx=1 N stps 3", "did you mean steps?"));
    CHECK(fails("maximize a", "expected over NAME = LO .. HI, ..."));
    CHECK(fails("maximize", "expected a value here"));
    CHECK(fails("solve mu for a", "expected = EXPR"));
    CHECK(fails("table a for x 1", "expected = LO .. HI after x"));
    CHECK(fails("table a for x = 1 .. 2 with", "expected a name after with"));
    CHECK(fails("uncertainty a with mu 3", "expected +- after mu"));
    CHECK(fails("plot a for x = 1 .. 2 log z", "expected log x, log y or log xy"));
    CHECK(fails("plot a for x = 1 .. 2 title b", "expected title \"TEXT\""));
    CHECK(fails("material steal", "did you mean steel?"));
    char many[600] = "plot a for x = 1 .. 2";
    for (int i = 0; i < GIVEN_CLAUSES; i++)
        strcat(many, " points");
    CHECK(fails(many, "more than 40 clauses"));
    CHECK(fails("accuracy within 4000", "the seconds must be a positive number"));
}

/* Where a line that someone is typing ends. */
static bool stops(const char *text, const char *name, unsigned at, part_end end, const char *changed) {
    error_clear(&wrong);
    lex_start(&lx, text, strlen(text), &wrong);
    lx.cut = true;
    const command *c = command_find(text, strcspn(text, " "));
    lex_next(&lx);
    parsed_read_some(&sh, &lx, command_form(c), &all);
    const bool open = name != NULL,
               ok = parsed_at_cursor(&lx) && (all.open != NULL) == open &&
                    (!open || (!strcmp(all.open->of->name, name) && all.hole == at && all.end == end));
    if (!ok || !changed)
        return ok;
    return all.changed.len == strlen(changed) && !strncmp(text + all.changed.at, changed, all.changed.len);
}

static void typing(void) {
    const size_t names_before = sh.calc.names.count;
    CHECK(stops("step", NULL, 0, PART_EMPTY, NULL) && all.count == 0);
    CHECK(stops("step Fx=", "Fx", 0, PART_EMPTY, NULL) && stops("step Fx=3 ", "Fx", 0, PART_NUMBER, NULL));
    CHECK(stops("step Fx=3 dz=(2 ", "dz", 0, PART_NUMBER, NULL) && all.count == 2);
    CHECK(stops("cycle FA=2 N times 3 FNA=1 N steps", "steps", 0, PART_EMPTY, NULL));
    CHECK(stops("table a, dW at k=0, mu = 0.", "", 0, PART_NUMBER, "mu"));
    CHECK(stops("uncertainty a, dW at", "", 0, PART_NAME, NULL) &&
          stops("table a in ", "", 0, PART_UNIT, NULL));
    CHECK(stops("table nix*", "", 0, PART_VALUE, NULL) && stops("table a log", NULL, 0, PART_EMPTY, NULL));
    CHECK(stops("table a for x", "for", 0, PART_WHOLE, NULL) &&
          stops("table a for x =", "for", 1, PART_EMPTY, NULL));
    CHECK(stops("table a for x = 1 N .. ", "for", 1, PART_VALUE, NULL));
    CHECK(stops("plot a log", "log", 0, PART_EMPTY, NULL) &&
          stops("plot a log x", "log", 0, PART_WHOLE, NULL));
    CHECK(stops("geometry sphere", NULL, 0, PART_EMPTY, NULL) && !strcmp(all.by->shape, "sphere"));
    CHECK(stops("plot accuracy within", "within", 0, PART_EMPTY, NULL));
    CHECK(!stops("step Fx=3 N Fx=", "Fx", 0, PART_EMPTY, NULL) &&
          !stops("friction 0.4 zebra", NULL, 0, PART_EMPTY, NULL));
    CHECK(sh.calc.names.count == names_before); /* nothing has become known */
}

/* Of every place in the examples of help: what is offered goes on with what stands there. */
static void offers(void) {
    const command *c;
    candidates found;
    for (size_t i = 0; (c = command_row(i)); i++)
        for (const char *line = c->help; line && (line = strstr(line, "fret> "));
             line += strcspn(line, "\n")) {
            char text[400];
            line += strlen("fret> ");
            snprintf(text, sizeof text, "%.*s", (int)strcspn(line, "\n"), line);
            for (size_t n = 0; n <= strlen(text); n++) {
                complete(&sh, text, n, &found);
                bool ok = found.start <= n && !(found.files && found.count);
                for (size_t k = 0; k < found.count; k++)
                    ok = ok && !strncmp(found.word[k], text + found.start, n - found.start);
                candidates_free(&found);
                CHECK(ok && !*sh.calc.note);
            }
        }
}

int main(int argc, char **argv) {
    unit_start("reader", argc, argv);
    command_use(commands, holes);
    shell_init(&sh, stdout, stderr);
    CASE(cut());
    CASE(lists());
    CASE(heads());
    CASE(names());
    CASE(arguments());
    CASE(errors());
    CASE(typing());
    CASE(offers());
    shell_free(&sh);
    return unit_finish();
}
