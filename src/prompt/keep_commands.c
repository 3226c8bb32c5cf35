/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Commands that keep a session: save, record, and replay, which runs a kept one beside it. */
#include <stdlib.h>
#include <string.h>

#include "prompt/show.h"
#include "statement/command.h"
#include "statement/record.h"
#include "statement/setting_table.h"
#include "statement/target.h"

/* ---- save -------------------------------------------------------------------------------------- */

bool do_save(shell *sh, lexer *lx, said *all) {
    target t;
    const bool history = *all->list[0].of->name;
    const span *name = &all->list[0].hole[0];
    if (history && sh->replaying)
        return true;
    if (history && !sh->typed.to)
        return calc_fail(lx->error, name->at, name->len,
                         "nothing has been typed here: a script is its own history");
    if (!target_file(lx, name, &t))
        return false;
    if (!history)
        fputs("# fret " FRET_VERSION "\n", t.to);
    return target_close(sh, lx, &t,
                        (history ? typed_write(sh, t.to) : scene_write(&sh->calc, &sh->set, t.to, true)) ||
                            calc_no_memory(lx->error));
}

/* ---- record and replay ------------------------------------------------------------------------- */

/* Settings come last: with `set format json` the statements of the scene would print objects. NULL: out of
 * memory. */
static char *beginning(shell *sh) {
    file_text kept;
    if (!file_text_open(&kept))
        return NULL;
    const bool whole = scene_write(&sh->calc, &sh->set, kept.to, true);
    settings_write(&sh->calc, &sh->set, kept.to);
    if (!file_text_close(&kept))
        return NULL;
    if (whole)
        return kept.text;
    free(kept.text);
    return NULL;
}

bool do_record(shell *sh, lexer *lx, said *all) {
    char name[FILE_NAME];
    if (said_of(all, "off", 0))
        return record_end(sh, true) || lex_fail(lx, "nothing is being recorded");
    if (!hole_file(lx, &all->list[0].hole[0], name))
        return false;
    char *text = beginning(sh);
    if (!text)
        return calc_no_memory(lx->error);
    const bool ok = record_begin(sh, name, text, lx->error);
    free(text);
    return ok || heard_place(lx->error, &all->list[0]);
}

bool do_replay(shell *sh, lexer *lx, said *all) {
    char name[FILE_NAME];
    if (!hole_file(lx, &all->list[0].hole[0], name))
        return false;
    const int status = shell_replay(name, 0, &sh->set, sh->out, lx->error);
    if (status == EXIT_OK)
        return true;
    if (!lx->error->raised)
        calc_fail(lx->error, 0, 0, "%s does not come out again", name);
    return heard_place(lx->error, &all->list[0]);
}
