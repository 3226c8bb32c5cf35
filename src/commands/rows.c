/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the files of `at FILE` and of fits. Names become known; else touches nothing. */
#include "commands/rows.h"

#include <math.h>
#include <string.h>

/* ---- columns ----------------------------------------------------------------------------------- */

/* An angle needs its unit as lengths do. */
static bool same_dim(dim a, dim b) {
    return dim_equal(a, b) && (a.rad != 0) == (b.rad != 0);
}

const double *columns_find(const csv *data, const char *name, dim d, calc_error *error) {
    char wants[128], is[128];
    if (!csv_has(data, name))
        return NULL;
    const csv_values *of_file = csv_column(data, name, error);
    if (!of_file || same_dim(of_file->d, d))
        return of_file ? of_file->v : NULL;
    dim_describe(d, wants, sizeof wants);
    dim_describe(of_file->d, is, sizeof is);
    calc_fail(error, 0, 0, "column %s is %s: it needs the unit of %s in the header", name, is, wants);
    return NULL;
}

/* Those that are results, or no names, have no say, and are missed if they are asked for; one that is named
 * in vain is no matter. */
bool columns_wake(shell *sh, const csv *data, size_t names, column_knob *out, size_t *count,
                  calc_error *error) {
    *count = 0;
    for (size_t i = 0; i < data->columns; i++) {
        const csv_values *of_file = &data->column[i];
        calc_error *useless = error_quiet();
        lexer lx;
        knob *k = &out[*count].name;
        lex_start(&lx, of_file->name, strlen(of_file->name), useless);
        if (useless->raised || lx.kind != T_NAME || lex_peek(&lx) != T_END || of_file->trouble ||
            of_file->twice)
            continue;
        const quantity *of = quantity_find(of_file->name, strlen(of_file->name));
        if ((of && !quantity_is_input(of)) || (!of && name_taken(of_file->name, strlen(of_file->name))))
            continue;
        if (!names_wake(sh, &lx, names))
            return calc_no_memory(error);
        knob_name(&sh->calc, &lx, k); /* there is one */
        if (k->is_input && !calc_takes(&sh->calc, k->in, error_quiet()))
            continue;
        if (k->is_input && !same_dim(k->d, of_file->d))
            return columns_find(data, of_file->name, k->d, error) != NULL;
        k->d = of_file->d;
        out[(*count)++].v = of_file->v;
    }
    return true;
}

bool columns_used(const shell *sh, const column_knob *of_file, const expr *e) {
    const knob *k = &of_file->name;
    const quantity *of = k->is_input ? quantity_of_input(k->in) : NULL;
    return expr_mentions(&sh->calc, e, of, of ? NULL : k->text);
}

bool columns_missed(const shell *sh, const lexer *lx, const csv *data) {
    char name[CSV_NAME];
    calc_error wrong, *error = lx->error;
    error_clear(&wrong);
    snprintf(name, sizeof name, "%.*s", (int)(error->len < sizeof name ? error->len : 0),
             lx->text + error->at);
    if (csv_has(data, name) && !csv_column(data, name, &wrong)) {
        calc_place(&wrong, error->at, error->len);
        *error = wrong;
    } else if (!strncmp(error->text, "unknown name", 12)) {
        char names[CALC_ERROR_TEXT / 2];
        csv_names(data, names, sizeof names);
        calc_append(&sh->calc, error, " (the columns of %.100s are %s)", data->path, names);
    }
    return false;
}

/* ---- rows as a range --------------------------------------------------------------------------- */

bool rows_open(shell *sh, const lexer *lx, said *all, file_rows *out) {
    const heard *at = said_of(all, "at", 0);
    char name[FILE_NAME];
    out->given = at != NULL;
    out->data = (csv){.path = NULL};
    if (!at)
        return true;
    all->wakes = true;
    return (hole_file(lx, &at->hole[0], name) && csv_read(name, &shell_stop, &out->data, lx->error) &&
            columns_wake(sh, &out->data, all->names, out->column, &out->count, lx->error)) ||
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
    r->at.names = 0;
    for (const column_knob *c = r->column; c < r->column + r->count; c++) {
        bool used = c->name.is_input;
        for (size_t i = 0; i < count && !used; i++)
            used = columns_used(sh, c, &sh->list[i]);
        if (used && r->at.names == SWEEP_NAMES)
            return calc_fail(lx->error, 0, 0, "more than %d columns are inputs or names that are used",
                             SWEEP_NAMES);
        if (used)
            r->at.column[r->at.names++] = *c;
    }
    if (!r->at.names) {
        char columns[CALC_ERROR_TEXT / 2];
        const span *file = &said_of(all, "at", 0)->hole[0];
        csv_names(&r->data, columns, sizeof columns);
        return calc_fail(lx->error, file->at, file->len, "no column of %.100s is used: they are %s",
                         r->data.path, columns);
    }
    out->at = &r->at;
    out->var = r->at.names == 1 ? r->at.column[0].name : (knob){.text = "row"};
    out->steps = r->data.rows - 1;
    return true;
}

bool rows_over(const lexer *lx, const span *file, sweep *over, file_rows *out) {
    char name[FILE_NAME];
    const bool taken[CSV_COLUMNS] = {false};
    const axis_of axis = {over->var.text, over->var.d};
    out->given = true;
    out->data = (csv){.path = NULL};
    if (!hole_file(lx, file, name) || !csv_read(name, &shell_stop, &out->data, lx->error))
        return calc_place(lx->error, file->at, file->len);
    const csv_values *x = looks_column(&out->data, &axis, taken, lx->error);
    if (!x)
        return lx->error->raised
                   ? calc_place(lx->error, file->at, file->len)
                   : calc_fail(lx->error, file->at, file->len,
                               "no column of %.200s, or more than one, is as %s", name, axis.name);
    out->at.names = 1;
    out->at.column[0] = (column_knob){over->var, x->v};
    over->at = &out->at;
    over->steps = out->data.rows - 1;
    return true;
}

const csv_values *rows_compared(const file_rows *r, const axis_of *expression, bool alone,
                                calc_error *error) {
    bool used[CSV_COLUMNS] = {false}, all[CSV_COLUMNS];
    memset(all, true, sizeof all);
    for (size_t i = 0; i < r->data.columns; i++)
        for (size_t j = 0; j < r->at.names; j++)
            used[i] = used[i] || r->data.column[i].v == r->at.column[j].v;
    const csv_values *found = looks_column(&r->data, expression, alone ? used : all, error);
    return found && !used[found - r->data.column] ? found : NULL;
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
