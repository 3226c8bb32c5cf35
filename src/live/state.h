/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The state of the full-screen mode: what the keys change and the views draw. */
#ifndef LIVE_STATE_H
#define LIVE_STATE_H

#include "live/canvas.h"
#include "live/live.h"
#include "live/way.h"

enum { LIVE_TEXT = 256, LIVE_LINE = 512, KEPT_LINES = 50 };

/* One scene on the screen: the user's, or the user's with an input changed. */
typedef struct side {
    char title[LIVE_TEXT];   /* of two scenes, else empty */
    char trouble[LIVE_TEXT]; /* why there is nothing to show; empty: there is */
    bool stale;              /* what is shown is of an earlier scene */
    shot now, before;        /* before: of what is to be played */
    bool loses;              /* in a cycle, at r = now.a i/SHOT_SAMPLES: */
    double lost[SHOT_SAMPLES + 1];
    load_way way;
} side;

/* A script that is stepped through. */
typedef struct live_script {
    const char *const *line; /* NULL: there is none */
    struct live_before {
        size_t undo, steps; /* of the session before a line */
    } * before;
    size_t count, at;
} live_script;

typedef struct live {
    const live_host *host;
    bool leave;
    bool by_displacement; /* what the arrows push */
    /* the cycle that space plays */
    double FA, FNA, phase, speed; /* [N], [N], [deg], periods a second */
    bool playing, last_cycle;
    bool follow;    /* what is said now is to be played */
    bool moves;     /* what plays has begun to move */
    double play_at; /* time of the load */
    /* the cycle that was said last, and the statement that did it; periods played of it, which are said when
     * it ends */
    load_item said;
    char said_as[LIVE_TEXT];
    size_t said_changes; /* that undo knows of, then */
    unsigned periods;
    side_by_side compared; /* what the sides show */
    side side[COMPARED];
    /* what is told */
    char status[LIVE_LINE]; /* nothing in it that does not show; nor in the note */
    bool bad;
    char note[LIVE_LINE]; /* a comment of the script */
    char *page;           /* a text over all views, or NULL */
    int page_from;
    /* the line being typed */
    bool typing;
    const char *prompt;
    char line[LIVE_LINE];
    size_t cursor;
    void (*entered)(struct live *l, const char *line);
    char *kept[KEPT_LINES];
    size_t kept_count, kept_at;
    live_script script;
    /* where the loop is, for the mouse */
    rect loop;
    double loop_dx; /* half its width */
    bool dragging;
    int last_key;
    bool changed; /* something is to be drawn */
    bool torn;    /* and all of it: at Ctrl-C a terminal drops what was on its way */
} live;

/* ---- state.c ---- */
/* 1, 2 or 5 times a power of ten, near v. */
double live_nice(double v);
/* A number for a statement, in a unit that suits it. */
void live_amount(double v, dim d, char *text, size_t size);
LIKE_PRINTF(3, 4)
void live_tell(live *l, bool bad, const char *format, ...);
/* How many scenes are shown. */
size_t live_sides(const live *l);
/* The state that is shown: on the way of a cycle, or the present one. */
const shot *side_shown(const live *l, const side *s);

/* ---- scenes.c: what the keys do, statements most of them ---- */

/* Runs a line and tells what it says; false: an error. */
LIKE_PRINTF(2, 3)
bool live_say(live *l, const char *format, ...);
bool live_say_line(live *l, const char *line);
/* After a change: what is shown must follow; and does, before it is drawn or asked. */
void live_update(live *l);
void live_refresh(live *l);
/* The first that is of an earlier scene; false: none is. */
bool live_refresh_next(live *l);
/* Nothing set yet: a scene to begin with. */
void live_begin(live *l);
void live_play(live *l);
/* Goes on by so many seconds; stops: shows the end at once. */
void live_play_on(live *l, double seconds);
void live_play_end(live *l);
/* The way of the load's last item, step or cycle, once. */
void live_play_item(live *l);
/* Walks the ways until it is late; NULL: to their ends. */
void live_walk(live *l, bool (*late)(void));

/* ---- script.c ---- */
bool script_open(live *l, const char *const *line, calc_error *error);
void script_close(live *l);
void script_on(live *l);
void script_back(live *l);
bool script_ends(const live *l);

/* ---- views.c ---- */
void live_draw(live *l);
/* Is there room for the text below the views? Else it is a page. */
bool status_holds(const char *text);
/* Rows of a page on this screen. */
int page_rows(const char *page);

/* ---- keys.c ---- */
void live_key(live *l, int key);

#endif
