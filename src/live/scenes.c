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

/* The same as live_statement_line, but what plays goes on. */
static bool run_line(live *l, const char *line) {
    char *answer = NULL;
    const bool ok = l->host->run(l->host->self, line, &answer);
    if (!ok && *l->host->stop) {
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

bool live_statement_line(live *l, const char *line) {
    live_play_end(l);
    return run_line(l, line);
}

/* ---- what is shown ----------------------------------------------------------------------------- */

static void trouble(live *l, side *s, calc_error *error) {
    calc_word(l->host->calc, error);
    snprintf(s->trouble, sizeof s->trouble, "%.*s", LIVE_TEXT - 1, error->text);
}

/* Takes the numbers of the scene that expressions see; along: also the states of its last item, to play. */
static bool take_side(live *l, side *s, bool along, calc_error *error) {
    calc *c = l->host->calc;
    const size_t items = c->now->end.steps;
    s->trouble[0] = 0;
    if (along)
        s->before = s->now;
    if (!shot_take(c, &s->now, error)) {
        s->now = (shot){.time = 0}; /* keys start from what is shown, which is nothing now */
        return false;
    }
    s->loses = shot_lost(c, s->now.a, s->lost);
    return playback_follow(&s->playback, c, along && items ? items - 1 : NO_ITEM, error);
}

static bool take_compared(live *l, side *s, size_t i, bool along, calc_error *error) {
    trial *t = trial_open(l->host->calc, error);
    const bool ok =
        t && trial_set(t, &l->compared.by, l->compared.with[i], error) && take_side(l, s, along, error);
    trial_close(t);
    return ok;
}

static void refresh_side(live *l, size_t i) {
    side *s = &l->side[i];
    calc_error error = ERROR_NONE;
    if (!(l->compared.on ? take_compared(l, s, i, l->play_next, &error)
                         : take_side(l, s, l->play_next, &error)))
        trouble(l, s, &error);
    s->stale = false;
    l->changed = true;
    if (i == 0 && !(l->FA > 0) && s->now.slip > 0) /* at first: half the force of gross slip */
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

bool live_refresh_next(live *l) {
    for (size_t i = 0; i < live_sides(l); i++)
        if (l->side[i].stale) {
            refresh_side(l, i);
            return true;
        }
    l->play_next = false;
    return false;
}

void live_refresh(live *l) {
    while (live_refresh_next(l))
        ;
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
    if (!*line) {
        live_update(l);
    } else if (live_statement(l, "%s", line)) { /* an answer, as with `set timing on`, is not worth a page */
        free(l->page);
        l->page = NULL;
    }
}

static void walk_side(live *l, side *s, bool (*late)(void)) {
    calc_error error = ERROR_NONE;
    if (*s->trouble || playback_idle(&s->playback))
        return;
    l->changed = true;
    if (!playback_go_on(&s->playback, l->host->calc, late, &error))
        trouble(l, s, &error);
}

void live_walk(live *l, bool (*late)(void)) {
    for (size_t i = 0; i < live_sides(l); i++) {
        if (l->playing)
            playback_drop_before(&l->side[i].playback, l->play_at);
        walk_side(l, &l->side[i], late);
    }
}

/* ---- a cycle that plays ------------------------------------------------------------------------ */

/* Plays from where the last item of the load begins to move. */
static void start_play(live *l) {
    l->playing = true;
    l->moves = false;
    l->play_at = 0;
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

/* Gets the load's last item, if it is a cycle. */
static bool last_cycle(const live *l, load_item *out) {
    scene *s = &l->host->calc->scene;
    if (!s->end.cycles || s->program->steps[s->end.steps - 1].kind != LOAD_CYCLE)
        return false;
    return scene_last_cycle(s, out, error_quiet());
}

static void remember_cycle(live *l) {
    l->cycle_undo = l->host->calc->undo.count;
    last_cycle(l, &l->cycle_item);
}

/* Is the cycle that is set the load's last item already? Then another period needs no new statement. */
static bool goes_on(const live *l) {
    char text[LIVE_TEXT];
    load_item now;
    cycle_text(l, text);
    return !strcmp(text, l->cycle_as) && l->host->calc->undo.count == l->cycle_undo && last_cycle(l, &now) &&
           walk_same_item(&l->cycle_item, &now);
}

static void one_more(live *l) {
    for (size_t i = 0; i < live_sides(l); i++)
        if (!*l->side[i].trouble)
            playback_add_period(&l->side[i].playback);
    l->periods++;
    live_tell(l, false, "%s times %u", l->cycle_as, l->periods);
}

static void start_cycle(live *l) {
    char text[LIVE_TEXT];
    cycle_text(l, text);
    if (!live_statement_line(l, text))
        return;
    remember_cycle(l);
    memcpy(l->cycle_as, text, sizeof text);
    l->play_next = true;
    l->periods = 1;
    start_play(l);
}

void live_play(live *l) {
    l->stops_at_end = false;
    live_refresh(l);
    if (goes_on(l)) {
        one_more(l);
        start_play(l);
    } else {
        start_cycle(l);
    }
}

void live_play_item(live *l) {
    l->stops_at_end = true;
    l->periods = 0;
    live_update(l);
    l->play_next = true;
    start_play(l);
}

/* Runs one statement with all periods played, in place of the one that has been undone. */
static void run_periods(live *l) {
    char line[LIVE_LINE], why[LIVE_LINE];
    snprintf(line, sizeof line, "%s times %u", l->cycle_as, l->periods);
    if (!run_line(l, line)) { /* interrupted, perhaps: run the cycle as it was before */
        memcpy(why, l->status, sizeof why);
        snprintf(line, sizeof line, "%s times %u", l->cycle_as, l->cycle_item.extra.times);
        run_line(l, line);
        live_tell(l, true, "%s", why);
    }
    remember_cycle(l);
}

void live_play_end(live *l) {
    const bool more = l->playing && l->periods > l->cycle_item.extra.times;
    l->playing = false;
    l->changed = true;
    for (size_t i = 0; i < live_sides(l); i++)
        playback_drop_states(&l->side[i].playback);
    if (more && run_line(l, "undo"))
        run_periods(l);
}

/* The time up to which all sides have states to play. */
static double ahead(const live *l) {
    double time = INFINITY;
    for (size_t i = 0; i < live_sides(l); i++) {
        const playback *w = &l->side[i].playback;
        if (!*l->side[i].trouble)
            time = fmin(time, w->play[w->shots - 1].time);
    }
    return time;
}

/* Have all sides two states or their end, so that they can begin to move together? */
static bool ready(const live *l) {
    for (size_t i = 0; i < live_sides(l); i++) {
        const side *s = &l->side[i];
        if (s->stale || (!*s->trouble && s->playback.shots + playback_done(&s->playback) < 2))
            return false;
    }
    return true;
}

void live_play_on(live *l, double seconds) {
    const playback *w = &l->side[0].playback;
    if (!l->playing || (!l->moves && !ready(l)))
        return;
    if (*l->side[0].trouble) {
        live_play_end(l);
        return;
    }
    l->changed = true;
    if (!l->moves)
        l->play_at = w->play[0].time;
    l->moves = true;
    l->play_at = fmin(l->play_at + seconds * l->speed, ahead(l));
    if (!playback_done(w) || l->play_at < w->play[w->shots - 1].time)
        return;
    if (l->stops_at_end) {
        live_play_end(l);
    } else if (goes_on(l)) {
        one_more(l);
    } else {
        live_play_end(l);
        start_cycle(l);
    }
}
