/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Answers as CSV: a header with units, then rows; reports and pages are as in text. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "number/array.h"
#include "statement/answer.h"
#include "text/lex.h"

/* ---- rows -------------------------------------------------------------------------------------- */

static void put_header(FILE *to, const column *columns, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const column *c = &columns[i];
        const char *quote = strchr(c->name, ',') ? "\"" : ""; /* names have no quotes and no line ends */
        fprintf(to, *c->unit ? "%s%s%s [%s]%s" : "%s%s%s%s%s", i ? "," : "", quote, c->name, c->unit, quote);
    }
    putc('\n', to);
}

static void put_csv_cells(FILE *to, const column *columns, const long double *si, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const double v = (double)(si[i] / columns[i].scale);
        if (i)
            putc(',', to);
        if (isfinite(v))
            print_number(to, 0, 17, v);
    }
    putc('\n', to);
}

static bool put_csv_columns(answer *a, const char *event) {
    (void)event;
    put_header(a->to, a->columns, a->count);
    return true;
}

static void put_csv_row(answer *a, const long double *si) {
    put_csv_cells(a->to, a->columns, si, a->count);
}

static void put_csv_answer_cells(answer *a, const answer_cell *cells) {
    for (size_t i = 0; i < a->count; i++) {
        const answer_cell *c = &cells[i];
        const char *quote = c->words && strchr(c->words, ',') ? "\"" : "";
        if (i)
            putc(',', a->to);
        if (c->kind == CELL_WORDS)
            fprintf(a->to, "%s%s%s", quote, c->words, quote);
        else
            print_number(a->to, 0, c->kind == CELL_FLAG ? 1 : c->digits, (double)c->v.v);
    }
    putc('\n', a->to);
}

/* ---- values: all values of an answer make one row ---------------------------------------------- */

/* Adds a value called "before name" (either may be empty), with the unit of unit_of; NULL: without. */
static void wait_for_row(answer *a, const char *before, const char *name, const column *unit_of,
                         long double si) {
    struct waiting *w = &a->waiting;
    const bool room = fret_array_room(&w->of, &w->room, w->count + 1, sizeof *w->of) &&
                      fret_array_room(&w->si, &w->room_si, w->count + 1, sizeof *w->si);
    const size_t size = strlen(before) + strlen(name) + 2;
    char *whole = room ? malloc(size) : NULL;
    if (!whole) {
        a->lost = true;
        return;
    }
    snprintf(whole, size, "%s%s%s", before, *before && *name ? " " : "", name);
    w->of[w->count] = unit_of ? *unit_of : (column){.scale = 1};
    w->of[w->count].name = whole;
    w->si[w->count++] = si;
}

static void put_csv_value(answer *a, const column *c, long double si) {
    wait_for_row(a, c->name, "", c, si);
}

static void put_csv_estimate(answer *a, const column *c, const estimate *e) {
    a->waiting.estimate = a->waiting.count;
    wait_for_row(a, c->name, "", c, e->v);
    wait_for_row(a, c->name, "deviation", c, e->deviation);
    if (e->uneven) {
        wait_for_row(a, c->name, "lower", c, e->v - e->below);
        wait_for_row(a, c->name, "upper", c, e->v + e->above);
    }
}

static void put_share(answer *a, const char *name, double part) {
    char from[LEX_NAME + 8];
    const struct waiting *w = &a->waiting;
    snprintf(from, sizeof from, "from %s", name);
    if (!a->lost)
        wait_for_row(a, w->of[w->estimate].name, from, NULL, part);
}

static void put_waiting(answer *a, bool ok) {
    struct waiting *w = &a->waiting;
    if (ok && !a->lost && w->count) {
        put_header(a->to, w->of, w->count);
        put_csv_cells(a->to, w->of, w->si, w->count);
    }
    columns_free(w->of, w->count);
    free(w->of);
    free(w->si);
    *w = (struct waiting){.count = 0};
}

const answer_form answer_as_csv = {
    .words = LAYOUT_PAGE, /* in other layouts rows have the same facts */
    .value = put_csv_value,
    .estimate = put_csv_estimate,
    .close = text_close,
    .member = text_member,
    .share = put_share,
    .columns = put_csv_columns,
    .row = put_csv_row,
    .cells = put_csv_answer_cells,
    .end = put_waiting,
};
