/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The scenes of the full-screen mode: runs statements that change them, updates what is shown, plays cycles.
 * Of the views it uses only status_holds. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "live/state.h"

/* ---- statements -------------------------------------------------------------------------------- */

/* Shows the answer to a line: below the views if there is room, else as a page. Takes over `answer`. */
static void tell_answer(live *l, const char *line, char *answer, bool ok) {
    size_t n = answer ? strlen(answer) : 0;
    while (n > 0 && answer[n - 1] == '\n')
        answer[--n] = 0;
    if (!answer) {
        live_tell(l, true, "out of memory: %s", line);
    } else if (!n) {
        live_tell(l, !ok, "%s", line);
    } else if (!strchr(answer, '\n') && n < sizeof l->status && status_holds(answer)) {
        live_tell(l, !ok, "%s", answer);
    } else {
        live_tell(l, !ok, "%s", line);
        free(l->page);
        l->page = answer;
        l->page_from = 0;
        return;
    }
    free(answer);
}

bool live_statement_line(live *l, const char *line) {
    char *answer = NULL;
    l->playing = false;
    l->periods = 0;
    const bool ok = l->host->run(l->host->self, line, &answer);
    if (!ok && *l->host->stop && !l->unseen) {
        *l->host->stop = 0; /* the statement was interrupted, not the session */
        l->torn = true;
    }
    tell_answer(l, line, answer, ok);
    l->leave = l->leave || *l->host->quit;
    live_update(l);
    return ok;
}

bool live_statement(live *l, const char *format, ...) {
    char line[LIVE_LINE];
    va_list args;
    va_start(args, format);
    const int n = vsnprintf(line, sizeof line, format, args);
    va_end(args);
    if (n < 0 || n >= (int)sizeof line) {
        live_tell(l, true, "the line is too long");
        return false;
    }
    return live_statement_line(l, line);
}

/* ---- what is shown ----------------------------------------------------------------------------- */

/* Shows the error in place of the views. Ctrl-C only ends what is typed, or all: it leaves the side stale. */
static void trouble(live *l, side *s, calc_error *error) {
    calc_word(l->host->calc, error);
    snprintf(s->trouble, sizeof s->trouble, "%.*s", LIVE_TEXT - 1, error->text);
    s->stale = *l->host->stop != 0;
}

/* Takes the numbers of the scene that expressions see, and begins to run its load. */
static bool take_side(live *l, side *s, calc_error *error) {
    calc *c = l->host->calc;
    if (!shot_take(c, &s->now, error))
        return false;
    if (!l->playing)
        s->played = s->now; /* from where the next load plays */
    s->loses = shot_lost(c, s->now.a, s->lost);
    return playback_begin(&s->playback, c, l->playing ? l->play_at : INFINITY, error);
}

static bool take_compared(live *l, side *s, size_t i, calc_error *error) {
    trial *t = trial_open(l->host->calc, error);
    const bool ok = t && trial_set(t, &l->compared.by, l->compared.with[i], error) && take_side(l, s, error);
    trial_close(t);
    return ok;
}

static void refresh_side(live *l, size_t i) {
    side *s = &l->side[i];
    calc_error error = ERROR_NONE;
    s->stale = false;
    s->trouble[0] = 0;
    if (!(l->compared.on ? take_compared(l, s, i, &error) : take_side(l, s, &error))) {
        s->now = (shot){.a = 0}; /* keys start from what is shown, which is nothing now */
        trouble(l, s, &error);
    }
    l->changed = true;
    if (!(l->FA > 0) && s->now.slip > 0) /* at first: half the force of gross slip */
        l->FA = live_nice(s->now.slip / 2);
}

/* Takes over what the command `compare` has set. */
static void update_compared(live *l) {
    const side_by_side *to = l->host->compared;
    if (to->on == l->compared.on && (!to->on || !memcmp(to, &l->compared, sizeof *to)))
        return;
    l->compared = *to;
    for (size_t i = 0; i < COMPARED; i++) {
        side *s = &l->side[i];
        char to_text[40];
        live_amount((double)to->with[i], to->by.d, to_text, sizeof to_text);
        s->title[0] = 0;
        if (to->on)
            snprintf(s->title, sizeof s->title, "%s = %s", to->by.text, to_text);
        playback_end(&s->playback);
    }
}

void live_update(live *l) {
    update_compared(l);
    for (size_t i = 0; i < COMPARED; i++)
        l->side[i].stale = true;
    l->changed = true;
}

void live_refresh(live *l) {
    for (size_t i = 0; i < live_sides(l); i++)
        if (l->side[i].stale)
            refresh_side(l, i);
}

void live_begin(live *l) {
    const inputs *in = &l->host->calc->scene.in;
    char line[LIVE_LINE] = "";
    const struct {
        bool missing;
        const char *statement;
    } first[] = {{!inputs_any(in, INPUT_MODULUS), "material E0=210 GPa nu=0.3 k=0 c0=1 mm"},
                 {!in->geometry, "geometry sphere R=10 mm"},
                 {!inputs_any(in, INPUT_BIT(IN_MU)), "friction 0.4"},
                 {!l->host->calc->scene.end.steps, "press FN=100 N"}};
    for (size_t i = 0; i < sizeof first / sizeof *first; i++)
        if (first[i].missing)
            list_word(line, sizeof line, "; ", first[i].statement);
    if (*line && live_statement(l, "%s", line)) {
        free(l->page); /* an answer, as with `set timing on`, is not worth a page */
        l->page = NULL;
    }
}

/* Have the loads of all sides been run to this time, or their ends? */
static bool all_there(const live *l, double time) {
    for (size_t i = 0; i < live_sides(l); i++) {
        const side *s = &l->side[i];
        if (s->stale || (!*s->trouble && !playback_there(&s->playback, time)))
            return false;
    }
    return true;
}

static void walk_side(live *l, side *s, double time, bool (*late)(void)) {
    calc_error error = ERROR_NONE;
    bool ok = playback_run(&s->playback, time, late, &error);
    if (ok && !playback_there(&s->playback, time))
        return;
    if (ok && l->playing)
        ok = playback_shot(&s->playback, l->host->calc, &s->played, &error);
    if (!ok)
        trouble(l, s, &error);
    l->changed = true;
}

bool live_walk(live *l, bool (*late)(void)) {
    const double time = l->playing ? l->play_at : INFINITY;
    for (size_t i = 0; i < live_sides(l); i++) {
        side *s = &l->side[i];
        if (!*s->trouble && !playback_there(&s->playback, time))
            walk_side(l, s, time, late);
    }
    return all_there(l, time);
}

/* ---- a load that plays ------------------------------------------------------------------------- */

static void start_play(live *l, double from, bool stops) {
    l->playing = true;
    l->stops_at_end = stops;
    l->play_at = from;
}

/* The time at which the load's last item begins. */
static double item_begins(const live *l) {
    const scene *s = &l->host->calc->scene;
    load_mark at = {s->end.steps - 1, s->end.cycles};
    at.cycles -= s->program->steps[at.steps].kind == LOAD_CYCLE;
    return program_time(s->program, at);
}

void live_play_item(live *l) {
    start_play(l, item_begins(l), true);
}

static void cycle_text(const live *l, char text[LIVE_TEXT]) {
    char force[40], swing[40];
    live_amount(l->FA, DIM_FORCE, force, sizeof force);
    live_amount(l->FNA, DIM_FORCE, swing, sizeof swing);
    if (l->FNA > 0)
        snprintf(text, LIVE_TEXT, "cycle FA=%s FNA=%s phase=%g deg", force, swing, l->phase);
    else
        snprintf(text, LIVE_TEXT, "cycle FA=%s", force);
}

/* Replaces the cycle that played by one of so many periods; if that fails, runs it again as it was. */
static bool play_more(live *l, const char *cycle, unsigned periods) {
    char why[LIVE_LINE];
    if (!live_statement_line(l, "undo"))
        return false;
    if (live_statement(l, "%s times %u", cycle, periods))
        return true;
    memcpy(why, l->status, sizeof why);
    live_statement(l, "%s times %u", cycle, periods - 1);
    live_tell(l, true, "%s", why);
    return false;
}

void live_play(live *l) {
    char text[LIVE_TEXT];
    live_refresh(l);
    cycle_text(l, text);
    const unsigned periods = strcmp(text, l->cycle_as) ? 1 : l->periods + 1;
    if (!(periods > 1 ? play_more(l, text, periods) : live_statement_line(l, text)))
        return;
    memcpy(l->cycle_as, text, sizeof text);
    l->periods = periods;
    start_play(l, periods > 1 ? scene_time(&l->host->calc->scene) - 1 : item_begins(l), false);
}

void live_play_end(live *l) {
    l->playing = false;
    for (size_t i = 0; i < COMPARED; i++)
        l->side[i].played = l->side[i].now;
    l->changed = true;
}

void live_play_on(live *l, double seconds) {
    if (!l->playing || !all_there(l, l->play_at))
        return;
    l->changed = true;
    if (!all_there(l, INFINITY))
        l->play_at += seconds * l->speed;
    else if (l->stops_at_end || *side_first(l)->trouble)
        live_play_end(l);
    else
        live_play(l);
}
