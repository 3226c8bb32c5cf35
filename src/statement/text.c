/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text on its way out: as it is, as an object for programs, or by the pager, which a recorder is told of. */
#include "statement/text.h"

#include <stdlib.h>
#include <string.h>

#include "statement/answer.h"
#include "statement/pager.h"
#include "statement/progress.h"
#include "statement/record.h"

bool text_begin(text_out *t, const settings *set, FILE *out, text_kind kind) {
    progress_wipe();
    *t = (text_out){.set = set, .out = out, .to = out, .kind = kind};
    const bool paged = set->pages && set->pager != PAGER_OFF && kind != TEXT_MOTION;
    if (kind > TEXT_ANSWERS && !answer_is_data(set) && !paged)
        return true;
    if (!file_text_open(&t->kept))
        return false;
    t->to = t->kept.to;
    return true;
}

/* A recorder has it either way. */
static void show_text(const text_out *t) {
    const bool page = t->set->pages && t->set->pager != PAGER_OFF &&
                      (t->set->pager == PAGER_ON || pager_needed(t->kept.text));
    fflush(t->out);
    if (page && pager_show(t->kept.text))
        record_aside(t->kept.text);
    else
        fputs(t->kept.text, t->out);
}

/* The text with what does not show escaped, in place of it. */
static bool make_safe(text_out *t) {
    file_text safe;
    const bool ok = file_text_open(&safe);
    for (const char *line = t->kept.text; ok && *line;) {
        const size_t n = strcspn(line, "\n");
        print_safe(safe.to, line, n);
        putc('\n', safe.to);
        line += n + (line[n] == '\n');
    }
    free(t->kept.text);
    t->kept.text = NULL;
    if (!ok || !file_text_close(&safe))
        return false;
    t->kept = safe;
    return true;
}

bool text_end(text_out *t, bool keep) {
    progress_wipe();
    if (t->to == t->out)
        return true;
    const bool data = answer_is_data(t->set);
    if (!file_text_close(&t->kept))
        return false;
    const bool ok = data || t->kind > TEXT_ANSWERS || make_safe(t), any = ok && keep && t->kept.size > 0;
    if (any && data && t->kind == TEXT_ANSWERS) {
        fputs(t->kept.text, t->out);
    } else if (any && data) {
        answer a;
        answer_begin(&a, t->set, t->out);
        answer_message(&a, "text", t->kept.text);
        answer_done(&a);
    } else if (any) {
        show_text(t);
    }
    free(t->kept.text);
    return ok;
}
