/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Commands that keep a session: save, record, and replay, which runs a kept one beside it. */
#include <stdlib.h>
#include <string.h>

#include "shell/command.h"
#include "shell/record.h"
#include "shell/show.h"
#include "shell/target.h"

/* ---- save -------------------------------------------------------------------------------------- */

bool do_save(shell *sh, lexer *lx, const command *self) {
    char name[ARG_FILE_NAME];
    file_out file;
    file_report report;
    (void)self;
    const bool history = lex_is(lx, "history") && word_at(lx) == lx->len && lex_peek(lx) != T_END;
    if (history)
        lex_next(lx);
    const size_t at = lx->at;
    if (!lex_filename(lx, name, sizeof name) || !at_end(lx))
        return false;
    const size_t len = lx->last - at;
    if (history && sh->replaying)
        return true;
    if (history && !sh->typed.to)
        return calc_fail(lx->error, at, len, "nothing has been typed here: a script is its own history");
    if (!file_out_open(&file, name, &shell_stop, lx->error))
        return calc_place(lx->error, at, len);
    if (!(history ? typed_write(sh, file.to) : scene_write(&sh->calc, &sh->set, file.to, true)))
        calc_no_memory(lx->error);
    if (!file_out_close(&file, !lx->error->raised, &report, lx->error) || lx->error->raised)
        return calc_place(lx->error, at, len);
    target_report(sh, name, &report);
    return true;
}

/* ---- record and replay ------------------------------------------------------------------------- */

/* The scene as it is, and behind it the settings: in JSON a scene would tell of itself. NULL: out of memory.
 */
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

bool do_record(shell *sh, lexer *lx, const command *self) {
    char name[ARG_FILE_NAME];
    (void)self;
    if (word_at(lx) == lx->len && lex_accept(lx, "off"))
        return at_end(lx) && (record_end(sh, true) || lex_fail(lx, "nothing is being recorded"));
    const size_t at = lx->at;
    if (!lex_filename(lx, name, sizeof name) || !at_end(lx))
        return false;
    char *text = beginning(sh);
    if (!text)
        return calc_no_memory(lx->error);
    const bool ok = record_begin(sh, name, text, lx->error);
    free(text);
    return ok || calc_place(lx->error, at, lx->last - at);
}

bool do_replay(shell *sh, lexer *lx, const command *self) {
    const arg_list list = command_args(self);
    char name[ARG_FILE_NAME];
    arg_value v[ARGS];
    if (!args_read(sh, lx, &list, v, name))
        return false;
    const int status = shell_replay(name, 0, &sh->set, sh->out, lx->error);
    if (status == EXIT_OK)
        return true;
    if (!lx->error->raised)
        calc_fail(lx->error, 0, 0, "%s does not come out again", name);
    return calc_place(lx->error, v[0].value_at, v[0].value_len);
}
