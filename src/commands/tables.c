/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Opens, begins and closes tables in SI. Writes the file or the session's output. */
#include "commands/tables.h"

#include "statement/progress.h"

bool table_open(shell *sh, const lexer *lx, parsed *all, si_table *t) {
    t->count = 0;
    t->begun = t->lost = false;
    return target_open(sh, lx, all, &t->to);
}

void table_column(si_table *t, const char *name, dim d) {
    t->lost = !column_si(&t->column[t->count++], name, d) || t->lost;
}

bool table_begin(shell *sh, si_table *t, const char *event, calc_error *error) {
    answer_begin_as(&t->a, &sh->set, t->to.to, t->to.format);
    if (t->lost || !columns_distinct(t->column, t->count))
        return calc_no_memory(error);
    if (target_is_continued(sh, &t->to))
        answer_columns_shared(&t->a, t->column, t->count);
    else if (!answer_columns(&t->a, event, t->column, t->count))
        return calc_no_memory(error);
    return t->begun = true;
}

bool table_end(si_table *t, bool ok) {
    progress_wipe();
    return !t->begun || answer_end(&t->a, ok);
}

bool table_close(shell *sh, lexer *lx, si_table *t, bool ok) {
    if (!table_end(t, ok))
        ok = calc_no_memory(lx->error);
    columns_free(t->column, t->count);
    return target_close(sh, lx, &t->to, ok);
}
