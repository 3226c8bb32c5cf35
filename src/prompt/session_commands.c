/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Commands on the session itself: source, set, quit, save, record and replay. */
#include <stdlib.h>

#include "plot/script.h"
#include "prompt/show.h"
#include "statement/command.h"
#include "statement/record.h"
#include "statement/setting_table.h"
#include "statement/target.h"

bool do_source(shell *sh, lexer *lx, parsed *all) {
    enum { NESTING = 16 };
    char name[FILE_NAME];
    hole_file(lx, &all->list[0].hole[0], name);
    if (sh->nesting == NESTING)
        return calc_fail(lx->error, all->list[0].hole[0].at, 1, "scripts are nested more than %d deep",
                         NESTING);
    file_in in;
    if (!file_in_open(&in, name, &shell_stop, lx->error))
        return given_place(lx->error, &all->list[0]);
    sh->nesting++;
    const int status = shell_stream(sh, &in);
    sh->nesting--;
    return status == EXIT_OK;
}

bool do_set(shell *sh, lexer *lx, parsed *all) {
    return all->by->shape ? setting_apply(sh, lx, all) : show_text(sh, show_settings, lx->error);
}

bool do_quit(shell *sh, lexer *lx, parsed *all) {
    (void)lx, (void)all;
    sh->quit = true;
    return true;
}

/* ---- save -------------------------------------------------------------------------------------- */

/* Refuses the name of a picture as the name of a file of statements. */
static bool is_statements(const lexer *lx, const span *part) {
    char name[FILE_NAME];
    hole_file(lx, part, name);
    return !plot_kind_of(name, error_quiet()) ||
           calc_fail(lx->error, part->at, part->len,
                     "'%s' is the name of a picture, which plot ... to FILE writes: statements go to one "
                     "such as scene.fret",
                     name);
}

bool do_save(shell *sh, lexer *lx, parsed *all) {
    target t;
    const bool history = *all->list[0].of->name;
    const span *name = &all->list[0].hole[0];
    if (history && sh->replaying)
        return true;
    if (history && !sh->typed.to)
        return calc_fail(lx->error, name->at, name->len,
                         "nothing has been typed here: a script is its own history");
    if (!is_statements(lx, name) || !target_file(lx, name, &t))
        return false;
    if (!history)
        fputs("# fret " FRET_VERSION "\n", t.to);
    return target_close(sh, lx, &t,
                        (history ? typed_write(sh, t.to) : scene_write(sh, t.to, true)) ||
                            calc_no_memory(lx->error));
}

/* ---- record and replay ------------------------------------------------------------------------- */

/* The statements that a recording begins with, to be freed; NULL: out of memory. Settings come last: after
 * `set format json` the statements of the scene would print objects. */
static char *beginning(shell *sh) {
    file_text kept;
    if (!file_text_open(&kept))
        return NULL;
    const bool whole = scene_write(sh, kept.to, true);
    settings_write(sh, kept.to);
    if (!file_text_close(&kept))
        return NULL;
    if (whole)
        return kept.text;
    free(kept.text);
    return NULL;
}

bool do_record(shell *sh, lexer *lx, parsed *all) {
    char name[FILE_NAME];
    if (parsed_clause(all, "off", 0))
        return record_end(sh, true) || lex_fail(lx, "nothing is being recorded");
    hole_file(lx, &all->list[0].hole[0], name);
    if (!record_as_page(name) && !is_statements(lx, &all->list[0].hole[0]))
        return false;
    char *text = beginning(sh);
    if (!text)
        return calc_no_memory(lx->error);
    const bool ok = record_begin(sh, name, text, lx->error);
    free(text);
    return ok || given_place(lx->error, &all->list[0]);
}

bool do_replay(shell *sh, lexer *lx, parsed *all) {
    char name[FILE_NAME];
    hole_file(lx, &all->list[0].hole[0], name);
    const int status = shell_replay(sh, name, 0, lx->error);
    if (status == EXIT_OK)
        return true;
    if (!lx->error->raised)
        calc_fail(lx->error, 0, 0, "%s: answers differ", name);
    return given_place(lx->error, &all->list[0]);
}
