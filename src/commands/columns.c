/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Assigns columns of files. Changes their names, units and signs, and which names the session knows. */
#include "commands/columns.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/quantity.h"
#include "text/unit.h"

/* ---- using ------------------------------------------------------------------------------------- */

/* Is it the file of a clause `at` or `over`? A `using` applies to the last such clause before it. */
static bool has_own_using(const given_clause *file) {
    return !strcmp(file->of->name, "at") || !strcmp(file->of->name, "over");
}

/* The file that a `using` applies to, or NULL. */
static const given_clause *file_before(const parsed *all, const given_clause *using) {
    for (const given_clause *h = using; h-- > all->list;)
        if (has_own_using(h))
            return h;
    return NULL;
}

/* Is the clause h a `using` that applies to this file? */
static bool is_using_of(const parsed *all, const given_clause *h, const given_clause *file) {
    return !strcmp(h->of->name, "using") && (!has_own_using(file) || file_before(all, h) == file);
}

bool columns_placed(const parsed *all, calc_error *error) {
    for (const given_clause *h = all->list; h < all->list + all->count; h++)
        if (!strcmp(h->of->name, "using") && !file_before(all, h))
            return calc_fail(error, h->at, h->len, "using follows at FILE.csv or over FILE.csv");
    return true;
}

/* The column at the cursor, as `3`, `Weg`, or `"Load On Sample"`. NULL with an error. */
static csv_values *column_at(csv *c, lexer *lx) {
    char name[CSV_NAME], layout[CALC_ERROR_TEXT / 2];
    const size_t at = lx->at, quoted = lx->kind == T_STRING, word = strcspn(lx->text + at, " \t"),
                 all = lx->end - at < word ? lx->end - at : word,
                 len = quoted || lx->kind == T_NUMBER ? lx->len : all;
    csv_values *column = NULL;
    snprintf(name, sizeof name, "%.*s", (int)(len - 2 * quoted), lx->text + at + quoted);
    char *end;
    const unsigned long number = lx->kind == T_NUMBER ? strtoul(name, &end, 10) : 0;
    if (lx->kind != T_NUMBER)
        column = csv_in_header(c, name);
    else if (*end == 0 && number > 0 && number <= c->columns)
        column = &c->column[number - 1];
    csv_layout(c, layout, sizeof layout);
    if (!column)
        calc_fail(lx->error, at, len, "%.100s has no column %.60s: %s", c->path, name, layout);
    else if (column->given)
        calc_fail(lx->error, at, len, "column %.60s is already used as %.60s", name, column->name);
    else if (column->twice && lx->kind != T_NUMBER)
        calc_fail(lx->error, at, len, "%.200s has two columns %.60s: give the number of one", c->path, name);
    else
        lex_seek(lx, at + len);
    return lx->error->raised ? NULL : column;
}

/* Applies one `using NAME = COLUMN [UNIT]`; the unit is for columns whose header has none that is known. */
static bool apply_using(csv *c, const lexer *lx, const given_clause *h) {
    const span *name = &h->hole[0];
    lexer own = hole_lexer(lx, &h->hole[1]);
    char called[CSV_NAME];
    unit u;
    csv_values *column = column_at(c, &own), *other;
    if (!column)
        return false;
    snprintf(called, sizeof called, "%.*s", (int)name->len, lx->text + name->at);
    if ((other = csv_find(c, called)) && other->given)
        return calc_fail(lx->error, name->at, name->len, "%.60s is given twice", called);
    if (own.kind != T_END) {
        const size_t at = own.at;
        if (!unit_parse(&own, &u)) /* the reader has seen that nothing follows it */
            return false;
        if (column->has_unit && !(same_dim(u.d, column->d) && unit_scale(&u) == unit_scale(&column->u)))
            return calc_fail(own.error, at, own.last - at, "the file has another unit for it: \"%s\"",
                             column->title);
        free(column->trouble);
        column->trouble = NULL;
        column->u = u;
        column->d = u.d;
        column->has_unit = true;
    }
    csv_rename(c, column, called);
    column->given = true;
    return true;
}

bool columns_read(const lexer *lx, const parsed *all, const given_clause *file, csv *out) {
    char name[FILE_NAME];
    *out = (csv){.path = NULL};
    hole_file(lx, &file->hole[0], name);
    if (!csv_read(name, &shell_stop, out, lx->error))
        return given_place(lx->error, file);
    for (const given_clause *h = all->list; h < all->list + all->count; h++)
        if (is_using_of(all, h, file) && !apply_using(out, lx, h))
            return calc_place(lx->error, h->hole[1].at, h->hole[1].len);
    return true;
}

/* ---- columns by dimension ----------------------------------------------------------------------- */

bool same_dim(dim a, dim b) {
    return dim_equal(a, b) && (a.rad != 0) == (b.rad != 0);
}

csv_values *column_of_dim(csv *c, dim d, char *names, size_t size, size_t *count) {
    csv_values *one = NULL;
    *names = 0;
    *count = 0;
    for (csv_values *v = c->column; v < c->column + c->columns; v++) {
        if (v->v || v->given || !dim_equal(v->d, d) || ((v->trouble || !v->numbers) && !v->has_unit) ||
            quantity_find(v->name, strlen(v->name)))
            continue;
        one = v;
        text_add(names, size, "%s%.60s", *count ? ", " : "", v->name);
        ++*count;
    }
    return *count == 1 ? one : NULL;
}

csv_values *columns_take(csv *c, const char *name, dim d, calc_error *error) {
    char wants[128], is[128], names[CALC_ERROR_TEXT / 3];
    csv_values *column = csv_find(c, name);
    size_t count = 0;
    dim_describe(d, wants, sizeof wants);
    if (!column && (column = column_of_dim(c, d, names, sizeof names, &count)))
        csv_rename(c, column, name);
    if (!column && count) {
        calc_fail(error, 0, 0,
                  "%.100s has no column %s, and %s is each of %s: say which it is: using %s=COLUMN", c->path,
                  name, wants, names, name);
        return NULL;
    }
    if (!column || column->twice) /* csv_column raises the error: it lists the columns */
        return csv_column(c, name, error), NULL;
    if (same_dim(column->d, d))
        return csv_load(c, column, error) ? column : NULL;
    dim_describe(column->d, is, sizeof is);
    if (column->trouble)
        calc_fail(error, 0, 0, "%s", column->trouble);
    else
        calc_fail(error, 0, 0, "column %.60s is %s: it needs the unit of %s in the header%s%s%s%.60s", name,
                  is, wants, column->has_unit ? "" : ", or here: using ", column->has_unit ? "" : name,
                  column->has_unit ? "" : "=", column->has_unit ? "" : "COLUMN UNIT");
    return NULL;
}

/* ---- signs ------------------------------------------------------------------------------------- */

void columns_turn(const csv *c, csv_values *column) {
    for (size_t i = 0; i < c->rows; i++)
        column->v[i] = 0 - column->v[i];
}

bool columns_turn_pull(const csv *c, csv_values *FN) {
    size_t i = 0;
    while (FN && i < c->rows && FN->v[i] < 0)
        i++;
    if (!FN || i < c->rows)
        return false;
    columns_turn(c, FN);
    return true;
}

bool columns_at_rig(shell *sh, csv *c) {
    long double K_rig;
    return csv_find(c, "drig") ||
           (!csv_find(c, "dx") && scene_get(&sh->calc.scene, IN_K_RIG, &K_rig, error_quiet()));
}

bool columns_of_loop(csv *c, bool rig, csv_values **dx, csv_values **Fx, calc_error *error) {
    *dx = columns_take(c, loop_column(rig), DIM_LENGTH, error);
    *Fx = *dx ? columns_take(c, "Fx", DIM_FORCE, error) : NULL;
    return *Fx;
}

bool columns_opposed(const csv *c, const csv_values *dx, const csv_values *Fx) {
    double x = 0, F = 0, sum = 0, rounding = 0; /* covariance: noise would decide between neighbouring rows */
    for (size_t i = 0; i < c->rows; i++) {
        x += dx->v[i] / (double)c->rows;
        F += Fx->v[i] / (double)c->rows;
    }
    for (size_t i = 0; i < c->rows; i++) {
        sum += (dx->v[i] - x) * (Fx->v[i] - F);
        rounding += 1e-12 * fabs(dx->v[i] * Fx->v[i]);
    }
    return sum < -rounding;
}

/* ---- comparison with computed values ----------------------------------------------------------- */

long double columns_differ(comparison *c, size_t row, long double computed) {
    const long double measured = c->with->v[row], difference = measured - computed;
    if (!isfinite(difference))
        return difference;
    c->rows++;
    c->squares += difference * difference;
    c->largest = fmaxl(c->largest, fabsl(measured));
    if (fabsl(difference) >= fabsl(c->worst)) {
        c->worst = difference;
        c->worst_row = row;
    }
    return difference;
}

long double columns_rms(const comparison *c) {
    return sqrtl(c->squares / (long double)c->rows);
}

/* ---- columns as names of expressions ----------------------------------------------------------- */

/* Leaves out columns whose title is no name, or is the name of a result; columns_missed explains that to a
 * user whose expression mentions one. */
bool columns_show_names(shell *sh, csv *data, parsed *all, named_columns *out, calc_error *error) {
    out->count = 0;
    all->shows_names = true;
    for (size_t i = 0; i < data->columns; i++) {
        csv_values *of_file = &data->column[i];
        calc_error *no_name = error_quiet();
        lexer lx;
        knob *k = &out->column[out->count].name;
        lex_start(&lx, of_file->name, strlen(of_file->name), no_name);
        if (no_name->raised || lx.kind != T_NAME || lex_peek(&lx) != T_END || of_file->trouble ||
            of_file->twice)
            continue;
        const quantity *known = quantity_find(of_file->name, strlen(of_file->name));
        if ((known && !quantity_is_input(known)) ||
            (!known && name_taken(of_file->name, strlen(of_file->name))))
            continue;
        if (!names_show(sh, &lx, all->names))
            return calc_no_memory(error);
        knob_name(&sh->calc, &lx, k); /* cannot fail: the name is known now */
        if (k->is_input && !calc_takes(&sh->calc, k->in, error_quiet()))
            continue;
        if (k->is_input && !same_dim(k->d, of_file->d))
            return columns_take(data, of_file->name, k->d, error) != NULL;
        k->d = of_file->d;
        out->of[out->count++] = of_file;
    }
    return true;
}

static bool is_mentioned(const shell *sh, const knob *k, size_t expressions) {
    const quantity *of = k->is_input ? quantity_of_input(k->in) : NULL;
    for (size_t i = 0; i < expressions; i++)
        if (expr_mentions(&sh->calc, &sh->list[i], of, of ? NULL : k->text))
            return true;
    return false;
}

bool columns_load(const shell *sh, csv *data, size_t expressions, named_columns *out, calc_error *error) {
    size_t kept = 0;
    csv_values *FN = NULL;
    out->used = false;
    for (size_t i = 0; i < out->count; i++) {
        const knob k = out->column[i].name;
        csv_values *of_file = out->of[i];
        const bool mentioned = is_mentioned(sh, &k, expressions);
        if (!mentioned && !(k.is_input && csv_load(data, of_file, error_quiet())))
            continue;
        if (!csv_load(data, of_file, error))
            return false;
        out->used = out->used || mentioned;
        FN = k.is_input && k.in == IN_FN ? of_file : FN;
        out->of[kept] = of_file;
        out->column[kept++] = (column_knob){k, of_file->v};
    }
    out->count = kept;
    if (!csv_settle(data, error))
        return false;
    out->turned = columns_turn_pull(data, FN);
    return true;
}

const quantity *columns_hidden(const shell *sh, csv *data, const expr *e, size_t *i) {
    const quantity *of;
    bool call;
    size_t at;
    while ((of = expr_quantity(e, (*i)++, &call, &at)))
        if (!call && csv_find(data, of->name) &&
            !(quantity_is_input(of) && calc_takes(&sh->calc, quantity_input(of), error_quiet())))
            break;
    return of;
}

bool columns_missed(const shell *sh, const lexer *lx, csv *data) {
    char name[CSV_NAME];
    calc_error wrong = ERROR_NONE, *error = lx->error;
    snprintf(name, sizeof name, "%.*s", (int)(error->len < sizeof name ? error->len : 0),
             lx->text + error->at);
    if (csv_find(data, name) && !csv_column(data, name, &wrong)) {
        calc_place(&wrong, error->at, error->len);
        *error = wrong;
    } else if (!strncmp(error->text, "unknown name", 12)) {
        char names[CALC_ERROR_TEXT / 2];
        csv_names(data, names, sizeof names);
        calc_append(&sh->calc, error, " (the columns of %.100s are %s)", data->path, names);
    }
    return false;
}

/* ---- the note ---------------------------------------------------------------------------------- */

void columns_say(shell *sh, const csv *c, const char *more) {
    char text[CSV_COLUMNS * 160]; /* no column takes more */
    bool plain = c->plain && !c->encoding && !c->without && !c->words && !*more;
    snprintf(text, sizeof text, "%zu row%s from line %zu", c->rows, c->rows == 1 ? "" : "s", c->row[0].line);
    for (size_t i = 0; i < c->columns; i++) {
        const csv_values *v = &c->column[i];
        if (!v->given)
            continue;
        plain = false;
        if (!v->v)
            text_add(text, sizeof text, ", %.60s not used", v->name);
        else if (*v->title)
            text_add(text, sizeof text, ", %.60s from \"%.60s\"", v->name, v->title);
        else
            text_add(text, sizeof text, ", %.60s from column %zu", v->name, i + 1);
    }
    if (c->without)
        text_add(text, sizeof text, ", %zu row%s without a value left out", c->without,
                 c->without == 1 ? "" : "s");
    if (c->words)
        text_add(text, sizeof text, ", %zu line%s of words left out (line %zu)", c->words,
                 c->words == 1 ? "" : "s", c->first_word);
    if (c->encoding)
        text_add(text, sizeof text, ", read as %s", c->encoding);
    if (!plain)
        shell_note(sh, "%.200s: %s%s%s", c->path, text, *more ? ", " : "", more);
}
