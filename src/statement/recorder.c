/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The streams of a session that is recorded, and its own below them. Writes nothing. */
#include "statement/recorder.h"

bool record_shows(const shell *sh) {
    return sh->record && sh->record->out == stdout;
}

void record_streams(const shell *sh, FILE **out, FILE **err) {
    *out = sh->record ? sh->record->out : sh->out;
    *err = sh->record ? sh->record->err : sh->err;
}

void record_divert(shell *sh, FILE *out, FILE *err) {
    fflush(sh->out);
    fflush(sh->err);
    *(sh->record ? &sh->record->out : &sh->out) = out;
    *(sh->record ? &sh->record->err : &sh->err) = err;
}
