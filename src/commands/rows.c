/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the files that ranges go over. Names become known; else touches nothing. */
#include "commands/rows.h"

#include <math.h>
#include <string.h>

bool rows_open(shell *sh, const lexer *lx, said *all, file_rows *out) {
    const heard *at = said_of(all, "at", 0);
    out->given = at != NULL;
    out->data = (csv){.path = NULL};
    if (!columns_placed(all, lx->error) || !at)
        return !lx->error->raised;
    all->wakes = true;
    return (columns_read(lx, all, at, &out->data) &&
            columns_wake(sh, &out->data, all->names, &out->names, lx->error)) ||
           heard_place(lx->error, at);
}

void rows_close(file_rows *r) {
    if (r->given)
        csv_free(&r->data);
    r->given = false;
}

bool rows_range(shell *sh, const lexer *lx, said *all, file_rows *r, size_t count, sweep *out) {
    static const char *const others[] = {"for", "along", "steps", "log"};
    for (const heard *h = all->list; h < all->list + all->count; h++)
        for (size_t i = 0; i < sizeof others / sizeof *others; i++)
            if (!strcmp(h->of->name, others[i]) && !(i == 3 && h->of->holes))
                return calc_fail(lx->error, h->at, h->len,
                                 "the rows of the file are the range: %s does not go with at FILE",
                                 others[i]);
    const span *file = &said_of(all, "at", 0)->hole[0];
    if (!columns_load(sh, &r->data, count, &r->names, lx->error))
        return calc_place(lx->error, file->at, file->len);
    if (r->names.count > SWEEP_NAMES)
        return calc_fail(lx->error, file->at, file->len,
                         "more than %d columns are inputs or names that are used", SWEEP_NAMES);
    if (!r->names.count) {
        char columns[CALC_ERROR_TEXT / 2];
        csv_names(&r->data, columns, sizeof columns);
        return calc_fail(lx->error, file->at, file->len, "no column of %.100s is used: they are %s",
                         r->data.path, columns);
    }
    r->at = (sweep_rows){r->names.count, r->names.column};
    out->at = &r->at;
    out->var = r->at.names == 1 ? r->at.column[0].name : (knob){.text = "row"};
    out->steps = r->data.rows - 1;
    return true;
}

bool rows_over(const lexer *lx, const said *all, const heard *file, sweep *over, file_rows *out) {
    const axis_of axis = {.name = over->var.text, .d = over->var.d};
    out->given = true;
    if (!columns_read(lx, all, file, &out->data))
        return false;
    const csv_values *x = looks_column(&out->data, &axis, true, lx->error);
    if (!x && !lx->error->raised)
        calc_fail(lx->error, 0, 0, "no column of %.200s, or more than one, is as %s", out->data.path,
                  axis.name);
    if (!x || !csv_settle(&out->data, lx->error))
        return heard_place(lx->error, file);
    out->names.column[0] = (column_knob){over->var, x->v};
    out->names.turned = false;
    out->at = (sweep_rows){1, out->names.column};
    over->at = &out->at;
    over->steps = out->data.rows - 1;
    return true;
}

void rows_say(shell *sh, const file_rows *r) {
    columns_say(sh, &r->data, r->names.turned ? TURNED_FN : "");
}

const csv_values *rows_compared(file_rows *r, const axis_of *expression, bool alone, calc_error *error) {
    const csv_values *found = looks_column(&r->data, expression, alone, error);
    for (size_t j = 0; found && j < r->at.names; j++)
        if (found->v == r->at.column[j].v)
            return NULL;
    return found;
}

long double rows_differ(comparison *c, size_t row, long double ours) {
    const long double theirs = c->with->v[row], difference = theirs - ours;
    if (!isfinite(difference))
        return difference;
    c->rows++;
    c->squares += difference * difference;
    c->largest = fmaxl(c->largest, fabsl(theirs));
    if (fabsl(difference) >= fabsl(c->worst)) {
        c->worst = difference;
        c->worst_row = row;
    }
    return difference;
}

long double rows_rms(const comparison *c) {
    return sqrtl(c->squares / (long double)c->rows);
}
