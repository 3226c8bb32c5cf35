/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which column is which. Changes the names, units and signs of columns alone. */
#include "commands/columns.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/quantity.h"
#include "text/unit_text.h"

/* ---- using ------------------------------------------------------------------------------------- */

bool choices_add(choices *to, const heard *h, calc_error *error) {
    if (to->count == CHOICES)
        return calc_fail(error, h->at, h->len, "more than %d columns", CHOICES);
    to->name[to->count] = h->hole[0];
    to->column[to->count++] = h->hole[1];
    return true;
}

bool choices_of(said *all, choices *out, calc_error *error) {
    const heard *h;
    out->count = 0;
    for (size_t i = 0; (h = said_of(all, "using", i)); i++)
        if (!choices_add(out, h, error))
            return false;
    return true;
}

/* `3`, `Weg`, `"Load On Sample"`. */
static csv_values *column_at(csv *c, lexer *lx) {
    char name[CSV_NAME], layout[CALC_ERROR_TEXT / 2];
    const size_t at = lx->at, quoted = lx->kind == T_STRING, word = strcspn(lx->text + at, " \t"),
                 all = lx->end - at < word ? lx->end - at : word,
                 len = quoted || lx->kind == T_NUMBER ? lx->len : all;
    csv_values *column = NULL;
    snprintf(name, sizeof name, "%.*s", (int)(len - 2 * quoted), lx->text + at + quoted);
    char *end;
    const unsigned long number = quoted || lx->kind != T_NUMBER ? 0 : strtoul(name, &end, 10);
    if (lx->kind != T_NUMBER || quoted)
        column = csv_find(c, name);
    else if (*end == 0 && number > 0 && number <= c->columns)
        column = &c->column[number - 1];
    csv_layout(c, layout, sizeof layout);
    if (!column)
        calc_fail(lx->error, at, len, "%.100s has no column %.60s: %s", c->path, name, layout);
    else if (column->given)
        calc_fail(lx->error, at, len, "column %.60s is %.60s already", name, column->name);
    else if (column->twice && lx->kind != T_NUMBER)
        calc_fail(lx->error, at, len, "%.200s has two columns %.60s: say which by its number", c->path, name);
    else
        lex_seek(lx, at + len);
    return lx->error->raised ? NULL : column;
}

/* Where the file has no unit, or none that is known, one may stand behind the column. */
static bool read_choice(csv *c, const lexer *lx, const span *name, const span *part) {
    lexer own = hole_lexer(lx, part);
    char called[CSV_NAME];
    unit u;
    csv_values *column = column_at(c, &own);
    if (!column)
        return false;
    if (own.kind != T_END) {
        const size_t at = own.at;
        if (!unit_parse(&own, &u) || !at_end(&own))
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
    snprintf(called, sizeof called, "%.*s", (int)name->len, lx->text + name->at);
    csv_rename(c, column, called);
    column->given = true;
    return true;
}

bool columns_read(const lexer *lx, const span *file, const choices *chosen, csv *out) {
    char name[FILE_NAME];
    *out = (csv){.path = NULL};
    if (!hole_file(lx, file, name) || !csv_read(name, &shell_stop, out, lx->error))
        return calc_place(lx->error, file->at, file->len);
    for (size_t i = 0; i < chosen->count; i++)
        if (!read_choice(out, lx, &chosen->name[i], &chosen->column[i]))
            return calc_place(lx->error, chosen->column[i].at, chosen->column[i].len);
    return true;
}

/* ---- by dimension ------------------------------------------------------------------------------ */

bool same_dim(dim a, dim b) {
    return dim_equal(a, b) && (a.rad != 0) == (b.rad != 0);
}

csv_values *column_of_dim(csv *c, dim d, const csv_values *but, char *names, size_t size, size_t *count) {
    csv_values *one = NULL;
    size_t n = 0;
    *names = 0;
    *count = 0;
    for (csv_values *v = c->column; v < c->column + c->columns; v++) {
        if (v == but || v->v || v->given || !dim_equal(v->d, d) || (v->trouble && !v->has_unit) ||
            quantity_find(v->name, strlen(v->name)))
            continue;
        one = v;
        if (n < size)
            n += (size_t)snprintf(names + n, size - n, "%s%.60s", *count ? ", " : "", v->name);
        ++*count;
    }
    return *count == 1 ? one : NULL;
}

csv_values *columns_take(csv *c, const char *name, dim d, calc_error *error) {
    char wants[128], is[128], names[CALC_ERROR_TEXT / 3];
    csv_values *column = csv_find(c, name);
    size_t count = 0;
    dim_describe(d, wants, sizeof wants);
    if (!column && (column = column_of_dim(c, d, NULL, names, sizeof names, &count)))
        csv_rename(c, column, name);
    if (!column && count) {
        calc_fail(error, 0, 0,
                  "%.100s has no column %s, and %s is each of %s: say which it is: using %s=COLUMN", c->path,
                  name, wants, names, name);
        return NULL;
    }
    if (!column || column->twice) /* which tells what there is */
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

bool columns_opposed(const csv *c, const csv_values *dx, const csv_values *Fx) {
    double sum = 0;
    for (size_t i = 1; i < c->rows; i++)
        sum += (dx->v[i] - dx->v[i - 1]) * (Fx->v[i] - Fx->v[i - 1]);
    return sum < 0;
}

/* ---- what was understood ----------------------------------------------------------------------- */

void columns_say(shell *sh, const csv *c, const char *more) {
    char text[CSV_COLUMNS * 160]; /* each clause is shorter */
    bool plain = c->plain && !c->encoding && !c->without && !c->words && !*more;
    size_t n = (size_t)snprintf(text, sizeof text, "%zu row%s from line %zu", c->rows,
                                c->rows == 1 ? "" : "s", c->row[0].line);
    for (size_t i = 0; i < c->columns; i++) {
        const csv_values *v = &c->column[i];
        if (!v->v || !v->given)
            continue;
        plain = false;
        if (*v->title)
            n += (size_t)snprintf(text + n, sizeof text - n, ", %.60s from \"%.60s\"", v->name, v->title);
        else
            n += (size_t)snprintf(text + n, sizeof text - n, ", %.60s from column %zu", v->name, i + 1);
    }
    if (c->without)
        n += (size_t)snprintf(text + n, sizeof text - n, ", %zu row%s without a value left out", c->without,
                              c->without == 1 ? "" : "s");
    if (c->words)
        n += (size_t)snprintf(text + n, sizeof text - n, ", %zu line%s of words left out (line %zu)",
                              c->words, c->words == 1 ? "" : "s", c->first_word);
    if (c->encoding)
        n += (size_t)snprintf(text + n, sizeof text - n, ", read as %s", c->encoding);
    if (!plain)
        shell_note(sh, "%.200s: %s%s%s", c->path, text, *more ? ", " : "", more);
}
