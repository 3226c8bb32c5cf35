/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The state of the full-screen mode: what the keys change and the views draw; and the functions on it. */
#ifndef LIVE_STATE_H
#define LIVE_STATE_H

#include "live/canvas.h"
#include "live/live.h"
#include "live/playback.h"

enum { LIVE_TEXT = 256, LIVE_LINE = 512, KEPT_LINES = 50 };

/* One scene on the screen: the user's, or after `compare` the user's with one input changed. */
typedef struct side {
    char title[LIVE_TEXT];         /* "k = 0.5" if two scenes are shown, else empty */
    char trouble[LIVE_TEXT];       /* the error shown in place of the views, or empty */
    bool stale;                    /* the scene has changed since the numbers below were taken */
    shot now, played;              /* the present state, and the one that is shown while the load plays */
    bool loses;                    /* lost holds the work of friction in a cycle [J/m^2] */
    double lost[SHOT_SAMPLES + 1]; /* at r = now.a i/SHOT_SAMPLES */
    playback playback;
} side;

/* A script that is stepped through. */
typedef struct live_script {
    const char *const *line; /* NULL: there is none */
    struct live_before {
        size_t undo, steps; /* how many undo levels and load steps there were before a line was run */
    } * before;
    size_t count, at; /* lines, and the next one */
} live_script;

typedef struct live {
    const live_host *host;
    bool leave;           /* the loop is to end */
    bool unseen;          /* a script plays without a terminal */
    bool by_displacement; /* arrows change displacements, else forces */
    /* the cycle that space plays */
    double FA, FNA, phase, speed; /* [N], [N], [deg], periods per second */
    bool playing;
    bool stops_at_end;        /* stop at the end of the period that plays */
    double play_at;           /* time along the load that is shown */
    char cycle_as[LIVE_TEXT]; /* the last cycle run for playing */
    unsigned periods;         /* periods of it, if it is the last statement that was run; else 0 */
    side_by_side compared;    /* what the sides show */
    side side[COMPARED];
    /* messages */
    char status[LIVE_LINE]; /* the last one, without control characters */
    bool bad;               /* it is an error */
    char note[LIVE_LINE];   /* comments of the script, without control characters */
    char *page;             /* a text over all views, or NULL */
    int page_from;          /* its first row on the screen */
    /* the line being typed */
    bool typing;
    const char *prompt;
    char line[LIVE_LINE];
    size_t cursor;
    void (*entered)(struct live *l, const char *line);
    char *kept[KEPT_LINES]; /* history of lines */
    size_t kept_count, kept_at;
    live_script script;
    /* where the views have drawn the hysteresis loop of side_first, for the mouse; empty if they have not */
    rect loop;
    double loop_dx; /* displacement at its right edge [m] */
    bool dragging;
    int last_key;
    bool changed; /* the screen is to be drawn */
    bool torn;    /* all of it: at Ctrl-C the terminal drops output that is under way */
} live;

/* ---- state.c ---- */
/* 1, 2 or 5 times a power of ten, near v. */
double live_nice(double v);
/* Writes a value as a statement takes it, 3 digits and a unit that suits it. */
void live_amount(double v, dim d, char *text, size_t size);
/* Shows a message below the views; bad: an error. */
LIKE_PRINTF(3, 4)
void live_tell(live *l, bool bad, const char *format, ...);
/* How many scenes are shown: 1 or 2. */
size_t live_sides(const live *l);
/* The side that keys and the mouse go by: the first that is not in trouble. */
const side *side_first(const live *l);

/* ---- scenes.c ---- */

/* Both end what plays, run a line of statements and show its answer; false: an error. */
LIKE_PRINTF(2, 3)
bool live_statement(live *l, const char *format, ...);
bool live_statement_line(live *l, const char *line);
/* Call after a change of the scene: marks the sides as stale. live_refresh brings them up to date. */
void live_update(live *l);
void live_refresh(live *l);
/* Runs statements that set what the scene lacks. */
void live_begin(live *l);
/* Runs the cycle that is set, and plays it; if it has just been run, runs it with one more period in its
 * place, about the same FN, and plays that. */
void live_play(live *l);
/* Goes on playing for `seconds`; live_play_end stops and shows the end at once. */
void live_play_on(live *l, double seconds);
void live_play_end(live *l);
/* Plays the load's last item, step or cycle, once. */
void live_play_item(live *l);
/* Runs the loads of the sides on, to what is shown of them, until late() is true (NULL: never). Are they
 * there? */
bool live_walk(live *l, bool (*late)(void));

/* ---- script.c ---- */
bool script_open(live *l, const char *const *line, calc_error *error);
/* Shows the comments that come next, or runs the next statement and plays its load. */
void script_on(live *l);
/* Undoes the last statement of the script. */
void script_back(live *l);
bool script_ends(const live *l);

/* ---- views.c ---- */
void live_draw(live *l);
/* Is there room for the text below the views? If not, it is shown as a page. */
bool status_holds(const char *text);
/* How many rows a page takes on this screen. */
int page_rows(const char *page);

/* ---- keys.c ---- */
void live_key(live *l, int key);

#endif
