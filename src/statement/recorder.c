/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The streams of a session that is recorded, and its own below them. Writes nothing. */
#include "statement/recorder.h"

bool record_shows(const shell *sh) {
    return sh->record && sh->record->out == stdout;
}

static void swap(FILE **a, FILE **b) {
    FILE *kept = *a;
    *a = *b;
    *b = kept;
}

void record_swap(shell *sh, FILE **out, FILE **err) {
    fflush(sh->out);
    fflush(sh->err);
    swap(sh->record ? &sh->record->out : &sh->out, out);
    swap(sh->record ? &sh->record->err : &sh->err, err);
}
