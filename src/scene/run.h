/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs a load program on a model, leg by leg. A look is a stop at which the caller may read the state.
 * Touches no scene. */
#ifndef SCENE_RUN_H
#define SCENE_RUN_H

#include <signal.h>

#include "scene/engine.h"
#include "scene/program.h"

/* A program up to a mark, with the inputs that it takes its values from. */
typedef struct load_view {
    const program *program;
    load_mark end;
    size_t last_cycle;
    const inputs *in;
    const fret_normal *normal;
    double mu, K_rig; /* K_rig: only if a step or cycle goes to a displacement at the rig */
    const volatile sig_atomic_t *stop;
    void (*pulse)(void); /* or NULL */
} load_view;

/* The quantities that errors name when the contact slides or opens within a cycle. */
#define RUN_FX_OF_CYCLE "Fx within the cycle"
#define RUN_FN_OF_CYCLE "FN within the cycle"

/* A leg: a part of the load without a turning point. Time is 0 at the press and grows by 1 a step, by 1/4 to
 * the first peak of a cycle, by 1 a period. */
typedef enum leg_law { LEG_STRAIGHT, LEG_RISE, LEG_HALF } leg_law;
typedef struct leg {
    fret_step to;
    double begin, end; /* time */
    leg_law law;       /* the load in time: straight, a quarter or a half of a sine */
    bool rig;          /* to a displacement at the rig; delta_x follows from it */
    bool chord;        /* a chord of a harmonic load: its ends are no turning points */
    bool sine;         /* a part of the sine itself, between the angles in run_place */
    bool even;         /* divide it evenly in load, not in time */
    bool closes;       /* it ends a period */
    unsigned points;   /* points asked for by `steps` (for a chord: per period); 0: none */
    double origin;     /* for a chord: the time at the beginning of its period */
} leg;

/* Where a run stops for a look; made by the functions below. */
typedef struct watch {
    enum { WATCH_NOTHING, WATCH_POINTS, WATCH_PATH, WATCH_TIMES } kind;
    unsigned points;     /* WATCH_POINTS, WATCH_PATH: points of a leg that names none */
    double first, every; /* WATCH_TIMES: times first + i every */
    size_t sample, last; /* next and last i */
    bool turns;          /* look at turning points too */
    bool once;           /* periods that repeat the one before are skipped, but the last */
} watch;

/* Looks that divide every leg into `points` parts. */
watch watch_points(unsigned points);
/* Looks at the end of every chord, and in other legs at `points` parts even in time. */
watch watch_path(unsigned points);
/* Looks at the times first + i every, i = 0..last; turns: and at turning points. */
watch watch_times(double first, double every, size_t last, bool turns);

/* A harmonic normal force is run at LEVELS numbers of chords a period, each double the last. The error has
 * terms of second and fourth order in the length of a chord; run_limit extrapolates both away. moved: twice
 * the relative change by the last extrapolation, a bound on the error for all losses in
 * tests/reference/swinging.csv. */
enum { RUN_CHORDS = 160, LEVELS = 3 };
long double run_limit(const long double at[LEVELS], long double *moved);
/* An upper estimate of the relative error of the limit, also where a slip front ends within a chord: the
 * larger of twice the change of the first extrapolation between levels, and 1/256 of that of the value. */
long double run_unsure(const long double at[LEVELS]);

/* What a look shows: the state, and the loss of the last period. */
typedef struct run_view {
    fret_state state;
    long double loss;
} run_view;

/* The position of a run within a cycle. */
enum { RUN_NODES = 24 };
typedef struct run_place {
    bool within;          /* within a period, else between two */
    bool closed;          /* a period has ended and is not compared yet */
    unsigned period;      /* periods done */
    unsigned alike;       /* number of the last periods that equal the one before */
    long double FN;       /* the mean normal force of the cycle */
    double begin;         /* time at the beginning of the period */
    double from, end;     /* angles of the present interval, which ends at a node or look */
    unsigned part, parts; /* chords done in it, and all; at constant F_N: branches */
    size_t node, nodes;
    double at[RUN_NODES];
    run_view last; /* at the end of the period before */
} run_place;

typedef struct runner {
    const load_view *load;
    engine engine;
    unsigned level;         /* a harmonic period has RUN_CHORDS 2^level chords */
    watch watch;            /* its own copy, which counts */
    fret_status status;     /* the error that stopped it */
    load_mark at;           /* index of the step it is at, and of its cycle */
    bool within;            /* within the step: its first leg has begun */
    double time;            /* present time */
    bool turning;           /* this look is at the end of a leg */
    long double cycle_loss; /* loss of the last period; 0 without one */
    bool closed;            /* a period has been run */
    bool chorded;           /* it stopped at a harmonic period that only chords can run */
    unsigned repeated;      /* periods of the last cycle that were skipped as repeats */
    load_item item;         /* the step that it is within */
    run_place place;
    leg leg;
    bool moving;       /* within the leg */
    double part, n, t; /* part of the leg done; normal and tangential load at its start */
    fret_step goal;    /* the leg's target in the coordinates in which it is straight */
} runner;

/* The present state of one run, or the limit of runs at all levels at the same instant. */
void run_view_now(const runner run[], unsigned levels, run_view *out);
/* Ends all runs and sets *levels to 0. */
void runs_end(runner run[], unsigned *levels);

/* Runs to the next look. False: the mark is reached, or r->status is an error, maybe FRET_INTERRUPTED. */
bool run_next(runner *r, load_mark end);
fret_status run_to(runner *r, load_mark end);
/* Runs a step or a cycle that need not be in the program. */
fret_status run_item(runner *r, const load_item *item);
/* Adds a period to the cycle of the last run_item. */
void run_more(runner *r);
/* Like run_next, up to the end of the item. */
bool run_item_next(runner *r);

/* The time at a mark of a program. */
double program_time(const program *p, load_mark end);

#endif
