/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steps through a script: a line at a time, and back by undo. */
#include <stdlib.h>
#include <string.h>

#include "live/state.h"
#include "text/characters.h"
#include "text/lines.h"

bool script_open(live *l, const char *const *line, calc_error *error) {
    live_script *s = &l->script;
    s->line = line;
    while (line[s->count])
        s->count++;
    s->before = calloc(s->count + 1, sizeof *s->before);
    return s->before || calc_no_memory(error);
}

bool script_ends(const live *l) {
    return l->script.at == l->script.count;
}

/* Shows the comments before the next statement, which is not run yet. */
static void take_note(live *l) {
    live_script *s = &l->script;
    l->note[0] = 0;
    for (; s->at < s->count && line_is_remark(s->line[s->at]); s->at++) {
        const char *text = s->line[s->at] + strspn(s->line[s->at], "# ");
        char shown[LIVE_LINE];
        characters_shown(text, shown, sizeof shown);
        if (*text)
            list_word(l->note, sizeof l->note, " ", shown);
    }
    if (script_ends(l) && !*l->note)
        snprintf(l->note, sizeof l->note, "the end of the script");
}

void script_on(live *l) {
    live_script *s = &l->script;
    const calc *c = l->host->calc;
    if (script_ends(l) || line_is_remark(s->line[s->at])) {
        take_note(l);
        return;
    }
    const char *line = s->line[s->at];
    const size_t steps = c->scene.end.steps;
    s->before[s->at++] = (struct live_before){c->undo.count, steps};
    take_note(l);
    if (live_statement_line(l, line) && c->scene.end.steps > 1 && c->scene.end.steps > steps)
        live_play_item(l);
}

void script_back(live *l) {
    live_script *s = &l->script;
    const calc *c = l->host->calc;
    size_t to = s->at;
    while (to > 0 && line_is_remark(s->line[to - 1]))
        to--;
    if (to == 0) {
        live_tell(l, false, "the beginning of the script");
        return;
    }
    l->note[0] = 0;
    while (c->undo.count > s->before[to - 1].undo || c->scene.end.steps > s->before[to - 1].steps)
        if (!live_statement(l, "undo"))
            return;
    s->at = to - 1;
    live_tell(l, false, "back before: %s", s->line[s->at]);
}
