/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Opens, shares and closes the destinations of tables. Writes files by text/file.h. */
#include "statement/target.h"

#include <string.h>

/* Forms by name extension. */
static const struct {
    const char *ending;
    int format;
    bool blocks;
} forms[] = {{".csv", FORMAT_CSV, false},
             {".json", FORMAT_JSON, false},
             {".txt", FORMAT_TEXT, true},
             {".dat", FORMAT_TEXT, true}};

static bool choose_form(const lexer *lx, const span *part, target *t) {
    char name[FILE_NAME];
    hole_file(lx, part, name);
    if (!strncmp(name, "/dev/", 5))
        return true;
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++)
        if (file_ends(name, forms[i].ending)) {
            t->format = forms[i].format;
            t->blocks = forms[i].blocks;
            return true;
        }
    return calc_fail(lx->error, part->at, part->len,
                     "cannot tell the form of a table from '%s': use .csv, .json, .txt or .dat", name);
}

bool target_file(const lexer *lx, const span *part, target *t) {
    char name[FILE_NAME];
    t->name = *part;
    t->shared = false;
    hole_file(lx, part, name);
    if (!file_out_open(&t->file, name, &shell_stop, lx->error))
        return calc_place(lx->error, part->at, part->len);
    t->to = t->file.to;
    return true;
}

bool target_open(shell *sh, const lexer *lx, parsed *all, target *t) {
    const given_clause *to = parsed_clause(all, "to", 0);
    *t = (target){.to = sh->out, .format = sh->set.format};
    return !to || (choose_form(lx, &to->hole[0], t) && target_file(lx, &to->hole[0], t));
}

/* ---- shares ------------------------------------------------------------------------------------ */

/* The index of the first row after `shares` shares. Earlier shares get the rows left over by the division. */
static size_t row_after(const run_share *p, size_t rows, unsigned shares) {
    const size_t each = rows / p->of, more = rows % p->of;
    return each * shares + (shares < more ? shares : more);
}

bool target_share(shell *sh, target *t, size_t rows, size_t *from, size_t *to, calc_error *error) {
    run_share *p = &sh->share;
    *from = 0;
    *to = rows;
    if (!p->of)
        return true;
    if (p->met)
        return calc_fail(error, 0, 0,
                         "--part shares the rows of one table or map, or the samples of one uncertainty: "
                         "this would be a second");
    if (t->file.to)
        return calc_fail(error, t->name.at, t->name.len,
                         "a share of the rows goes to standard output, to be put together with the others");
    if (t->format == FORMAT_TEXT)
        return calc_fail(error, 0, 0, "a share of the rows needs --format=csv or json");
    *from = row_after(p, rows, p->number - 1);
    *to = row_after(p, rows, p->number);
    p->met = t->shared = true;
    sh->out = t->to = p->out;
    return true;
}

/* ---- closing ------------------------------------------------------------------------------------ */

void target_report(shell *sh, const char *name, const file_report *r) {
    char size[16];
    if (r->direct || sh->set.report == REPORT_OFF || (sh->set.report == REPORT_AUTO && sh->on_screen))
        return;
    file_size_text(r->size, size);
    shell_say(sh, "%s %s (%s)", r->overwrote ? "overwrote" : "wrote", name, size);
}

bool target_close(shell *sh, lexer *lx, target *t, bool ok) {
    char name[FILE_NAME];
    file_report report;
    if (t->shared)
        sh->out = sh->share.number == sh->share.of ? sh->share.out : shell_nowhere(lx->error);
    if (!t->file.to)
        return ok;
    snprintf(name, sizeof name, "%s", t->file.name);
    if (!file_out_close(&t->file, ok, &report, lx->error))
        return calc_place(lx->error, t->name.at, t->name.len);
    if (ok)
        target_report(sh, name, &report);
    return ok;
}
