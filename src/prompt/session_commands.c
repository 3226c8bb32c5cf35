/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Commands on the session itself: scripts, settings, the end. */
#include <string.h>

#include "prompt/show.h"
#include "statement/command.h"
#include "statement/setting_table.h"

bool do_source(shell *sh, lexer *lx, said *all) {
    enum { NESTING = 16 };
    char name[FILE_NAME];
    if (!hole_file(lx, &all->list[0].hole[0], name))
        return false;
    if (sh->nesting == NESTING)
        return calc_fail(lx->error, all->list[0].hole[0].at, 1, "scripts are nested more than %d deep",
                         NESTING);
    file_in in;
    if (!file_in_open(&in, name, &shell_stop, lx->error))
        return heard_place(lx->error, &all->list[0]);
    sh->nesting++;
    const int status = shell_stream(sh, &in);
    sh->nesting--;
    return status == EXIT_OK;
}

bool do_set(shell *sh, lexer *lx, said *all) {
    return all->by->shape ? setting_apply(sh, lx, all) : show_text(sh, show_settings, lx->error);
}

bool do_quit(shell *sh, lexer *lx, said *all) {
    (void)lx, (void)all;
    sh->quit = true;
    return true;
}
