/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs a load program on a model, leg by leg, and shows states on the way. Touches no scene. */
#ifndef SCENE_RUN_H
#define SCENE_RUN_H

#include <signal.h>

#include "scene/engine.h"
#include "scene/program.h"

/* What is run: a program as far as a mark, with the inputs that it takes its values from. */
typedef struct load_view {
    const program *program;
    load_mark end;
    size_t last_cycle;
    const inputs *in;
    const fret_normal *normal;
    double mu, K_rig; /* of a rig that some step or cycle goes by */
    const volatile sig_atomic_t *stop;
    void (*pulse)(void); /* or NULL */
} load_view;

/* What slides or parts under a swinging normal force, in errors. */
#define RUN_FX_OF_CYCLE "Fx within the cycle"
#define RUN_FN_OF_CYCLE "FN within the cycle"

/* A part of the load without a corner. Time is 0 at the press, 1 more each step, a quarter to the first peak
 * of a cycle, 1 more each period. */
typedef enum leg_law { LEG_STRAIGHT, LEG_RISE, LEG_HALF } leg_law;
typedef struct leg {
    fret_step to;
    double begin, end; /* time */
    leg_law law;       /* how the load goes in time: evenly, as a quarter or a half of a sine */
    bool rig;          /* to a displacement at the rig, of which delta_x follows */
    bool chord;        /* of a swinging normal force: its ends are no turning points */
    bool sine;         /* a part of the sine itself, as the place in the cycle says */
    bool even;         /* part it evenly in load, not in time */
    bool closes;       /* its end is that of a period */
    unsigned points;   /* asked for by `steps`, of a chord: a period; 0: none */
    double origin;     /* of a chord: time at the beginning of its period */
} leg;

/* Where a run is to be looked at: as the functions below say. */
typedef struct watch {
    enum { WATCH_NOTHING, WATCH_POINTS, WATCH_WAY, WATCH_TIMES } kind;
    unsigned points;     /* of WATCH_POINTS: of a tangential leg that names none */
    double first, every; /* of WATCH_TIMES */
    size_t sample, last; /* next and last of them */
    bool turns;          /* turning points too */
    bool once;           /* a period that repeats the one before need not be seen again */
} watch;

/* Every leg in so many parts. */
watch watch_points(unsigned points);
/* The end of every chord, other legs in so many parts evenly in time. */
watch watch_way(unsigned points);
/* At the times first + i*every, i = 0..last; turns: at turning points too. */
watch watch_times(double first, double every, size_t last, bool turns);

/* A swinging normal force is run at several numbers of chords, each double the last. Their error goes with
 * the square of the length of a chord, then with its fourth power: the limit, extrapolated twice. moved:
 * twice how far the last extrapolation moved it, relative to the value; of the losses in
 * tests/reference/swinging.csv it is a bound. */
enum { RUN_CHORDS = 160, LEVELS = 3 };
long double run_limit(const long double at[LEVELS], long double *moved);
/* What the limit is good to, relative, also where a slip front ends within a chord and the orders are not
 * clean: twice how far the first extrapolation moves between levels, and 1/256 of how far the value does. */
long double run_unsure(const long double at[LEVELS]);

/* What a run shows: the state, and the loss of the last period. */
typedef struct sight {
    fret_state state;
    long double loss;
} sight;

/* Where in a cycle a run is. */
enum { RUN_NODES = 24 };
typedef struct run_place {
    bool within;          /* a period, else between two */
    bool closed;          /* a period that has not been compared yet */
    unsigned period;      /* those done */
    unsigned alike;       /* the last of them, each with the one before */
    long double FN;       /* that it turns about */
    double begin;         /* time at the beginning of the period */
    double from, end;     /* angles of a swinging period: to the next node or look */
    unsigned part, parts; /* done between these; of a constant F_N: branches */
    size_t node, nodes;
    double at[RUN_NODES];
    sight last; /* of the period before */
} run_place;

typedef struct runner {
    const load_view *load;
    engine engine;
    unsigned level;         /* a swinging period in RUN_CHORDS 2^level chords */
    watch watch;            /* its own: it counts */
    fret_status status;     /* why it does not go on */
    load_mark at;           /* next step of the program, and next of its cycles, or those that it is within */
    bool within;            /* the item: its first leg has begun */
    double time;            /* now */
    bool turning;           /* this look: the end of a leg */
    long double cycle_loss; /* of the last period run; of a program without one 0 */
    bool closed;            /* a period has been run */
    bool chorded;           /* the run ended at a swinging period that only chords can take */
    unsigned repeated;      /* periods of the last cycle that were not run, since they repeat those before */
    load_item item;         /* that it is within */
    run_place place;
    leg leg;
    bool moving;       /* on the leg */
    double part, n, t; /* how far; where it began */
    fret_step way;     /* where its points lie */
} runner;

/* Now: of one run, or the limit of runs at all levels that are at the same instant. What lies at the end of
 * the path needs no limit. */
void run_sight(const runner run[], unsigned levels, sight *out);
/* Of so many side by side none is left. */
void runs_end(runner run[], unsigned *levels);

/* On to the next look; false: it is at the end, or the status tells why it does not get there. The stop flag
 * is looked at wherever it is. */
bool run_next(runner *r, load_mark end);
fret_status run_to(runner *r, load_mark end);
/* A step, or `times` periods of a cycle, that need not be in the program. */
fret_status run_item(runner *r, const load_item *item);
/* One more period of the cycle that has just been run, or is. */
void run_more(runner *r);
/* As run_next, to the end of the item. */
bool run_item_next(runner *r);

/* The time at the end of the program, and after a step of it. */
double program_time(const program *p, load_mark end);

#endif
