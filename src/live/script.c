/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A script stepped through: a line at a time, and back by undo. */
#include <stdlib.h>
#include <string.h>

#include "live/state.h"
#include "text/characters.h"
#include "text/file.h"
#include "text/lines.h"

static void drop_lines(live_script *s) {
    for (size_t i = 0; i < s->count; i++)
        free(s->line[i].text);
    s->count = 0;
}

/* A logical line becomes one line. */
static bool add_script_line(live *l, const char *line) {
    live_script *s = &l->script;
    struct live_line *grown = realloc(s->line, (s->count + 1) * sizeof *grown);
    char *kept = strdup(line + strspn(line, " \t"));
    s->line = grown ? grown : s->line;
    if (!grown || !kept) {
        free(kept);
        return false;
    }
    s->line[s->count++] = (struct live_line){.text = kept};
    for (char *end = kept; (end = strchr(end, '\n')) != NULL;)
        *end = ' ';
    return true;
}

bool script_open(live *l, const char *path, calc_error *error) {
    live_script *s = &l->script;
    file_in in;
    if (!file_in_open(&in, path, l->host->stop, error))
        return false;
    file_got got = FILE_GOT_LINE;
    bool ok = true, transcript = false; /* of which the statements count alone */
    while (ok && (got = file_in_line(&in, error)) == FILE_GOT_LINE) {
        const bool prompt = begins_with_prompt(in.line, in.length);
        if (prompt && !transcript)
            drop_lines(s);
        transcript = transcript || prompt;
        if (prompt || !transcript)
            ok = file_in_rest(&in, error) == FILE_GOT_LINE && add_script_line(l, in.line);
    }
    file_in_close(&in);
    return ok ? got == FILE_GOT_END : calc_no_memory(error);
}

void script_close(live *l) {
    live_script *s = &l->script;
    drop_lines(s);
    free(s->line);
    *s = (live_script){.line = NULL};
}

static bool is_comment(const char *line) {
    return *line == '#' || !*line;
}

/* The comments before the next statement are shown with it still to come. */
static void take_note(live *l) {
    live_script *s = &l->script;
    l->note[0] = 0;
    for (; s->at < s->count && is_comment(s->line[s->at].text); s->at++) {
        const char *text = s->line[s->at].text + strspn(s->line[s->at].text, "# ");
        char shown[LIVE_LINE];
        const size_t n = strlen(l->note);
        characters_shown(text, shown, sizeof shown);
        if (*text)
            snprintf(l->note + n, sizeof l->note - n, "%s%s", n ? " " : "", shown);
    }
    if (s->at == s->count && !*l->note)
        snprintf(l->note, sizeof l->note, "the end of the script");
}

void script_on(live *l) {
    live_script *s = &l->script;
    const calc *c = l->host->calc;
    if (s->at == s->count) {
        live_tell(l, false, "the end of the script");
        take_note(l);
        live_update(l);
        return;
    }
    if (is_comment(s->line[s->at].text)) {
        take_note(l);
        live_update(l);
        return;
    }
    struct live_line *line = &s->line[s->at++];
    const size_t steps = line->steps = c->scene.end.steps;
    line->undo = c->undo.count;
    take_note(l);
    if (live_say_line(l, line->text) && c->scene.end.steps > 1 && c->scene.end.steps > steps)
        live_play_item(l);
}

bool script_ends(const live *l) {
    return l->script.at == l->script.count;
}

void script_back(live *l) {
    live_script *s = &l->script;
    const calc *c = l->host->calc;
    size_t to = s->at;
    while (to > 0 && is_comment(s->line[to - 1].text))
        to--;
    if (to == 0) {
        live_tell(l, false, "the beginning of the script");
        return;
    }
    l->note[0] = 0;
    while (c->undo.count > s->line[to - 1].undo || c->scene.end.steps > s->line[to - 1].steps)
        if (!live_say(l, "undo"))
            return;
    s->at = to - 1;
    live_tell(l, false, "back before: %s", s->line[s->at].text);
    live_update(l);
}
