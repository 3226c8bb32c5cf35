/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A scene: inputs, a load program up to a mark, and a cache of results that follow from them. Knows units but
 * no names; live definitions are evaluated through one callback. */
#ifndef SCENE_SCENE_H
#define SCENE_SCENE_H

#include <signal.h>

#include "scene/run.h"

typedef struct value {
    long double v; /* SI */
    dim d;
} value;

/* What closed forms need to know of the load program after the press, for its first `seen` steps. */
typedef struct load_reach {
    load_mark seen;
    load_by by;         /* tangential target of the first step that has one; BY_NONE: none */
    bool alike;         /* all steps have this target, none a relative one */
    double most;        /* largest magnitude of the targets */
    bool first;         /* the last step ends on the first loading curve: no larger load is remembered */
    double end;         /* target of the last step */
    bool closed;        /* the last period of the last cycle ended in the state in which it began */
    bool normal_varies; /* some step changes F_N */
    bool rig;           /* some step goes to a displacement at the rig */
    bool swings;        /* F_N changes within some cycle */
    size_t last_cycle;  /* index of the last cycle, or NO_CYCLE */
} load_reach;

/* Friction's work by radius at all levels of the run: so far, and in the last closed period (NULL: none),
 * which stands for `times` equal ones. */
typedef struct friction_work {
    unsigned levels; /* 0: not made yet */
    fret_work *far[LEVELS], *period[LEVELS];
    unsigned times[LEVELS];
} friction_work;

/* A gap worn by Nw cycles. */
typedef struct worn_gap {
    counted base;
    fret_normal *normal; /* the unworn law */
    fret_wear_held held;
    double Nw;
    fret_wear *wear;
} worn_gap;
typedef struct wear_path wear_path; /* worn.c */
#define WEAR_TOLERANCE 1e-3

/* The cache of results; flags and NULL tell what is valid. */
typedef struct answers {
    fret_normal *normal, *k0;      /* law of the unworn gap, and with k = 0; NULL: not made yet */
    worn_gap *worn;                /* its law replaces `normal`; NULL: not worn */
    fret_field *pressed, *dragged; /* fields of the press and of the history, or NULL */
    fret_field *straight;          /* as dragged, but harmonic loads in chords; or NULL */
    friction_work work;
    bool press_ready, reach_ready, state_ready;
    fret_press press;
    runner run[LEVELS];    /* the memory diagram, as far as it has been run */
    fret_contact *chorded; /* buffer of scene_straight */
    unsigned levels;
    bool chords; /* the program's harmonic load cannot be run as a sine */
    load_reach reach;
    run_view end; /* present state */
} answers;

typedef struct scene scene;

/* Callback: evaluates the live definition of an input in a scene, to a value of its dimension. */
typedef bool scene_definition(void *context, scene *s, input in, counted *definition, value *out,
                              calc_error *error);

/* An instant along a load: one run that has stopped there, or runs at all levels. */
typedef struct instant {
    const runner *run;
    unsigned levels;
    struct beside *beside; /* the same instant in other scenes (beside.h); NULL: not available */
} instant;

/* The models that have answered (bits USED), and the relative error of the polynomials used. */
typedef struct scene_use {
    unsigned models;
    double pieces_error;
} scene_use;

struct scene {
    inputs in;
    input_set settled, settling; /* bound inputs already evaluated; being evaluated */
    program *program;            /* NULL: nothing is pressed */
    load_mark end;
    const instant *now; /* NULL: the end of the program */
    bool sound;         /* scratch scene: its program is known to run to the end */
    bool before;        /* scene of a definition: the last cycle, whose amplitudes are inputs, is to come */
    bool early;         /* the same of steps before that cycle */
    answers answers;
    model_id model; /* the chosen model */
    unsigned springs;
    /* the last law made, and with k = 0, whose preparation fret_normal_make reuses; or NULL */
    fret_normal *like[2];
    wear_path *wears;                  /* shared with clones; or NULL */
    bool gaps;                         /* scratch scene: FN(dz) is 0 for dz < 0, before contact */
    double pieces_error;               /* scene_use.pieces_error */
    unsigned used;                     /* bits USED; the caller clears them */
    const volatile sig_atomic_t *stop; /* never NULL */
    void (*pulse)(void);               /* called repeatedly during long work; or NULL */
    scene_definition *evaluate;
    void *context;
};

void scene_init(scene *s, const volatile sig_atomic_t *stop, scene_definition *evaluate, void *context);
void scene_free(scene *s);
/* Makes a scratch scene: shares inputs and program, owns its results. Free with scene_free. */
void scene_clone(scene *to, const scene *from);
/* The models that have answered since `used` was cleared. */
scene_use scene_answered_by(const scene *s);
/* Adds models to those that have answered. */
void scene_also_used(scene *s, scene_use also);
/* Adds polynomials, if this law consists of them. */
void scene_used_law(scene *s, const fret_normal *normal);
/* Invalidates press, state and fields. */
void scene_moved(scene *s);
/* Sets the instant that answers are for; NULL: the end of the program. */
void scene_look(scene *s, const instant *now);
/* Forgets all results. */
void scene_forget(scene *s);

/* A saved state of a scene: its inputs and load. */
typedef struct scene_mark {
    inputs in;
    program *program;
    load_mark end;
    answers answers; /* moved here by scene_save */
} scene_mark;
/* move: the mark takes the answers; the scene starts with none. */
void scene_save(scene *s, scene_mark *m, bool move);
void scene_restore(scene *s, scene_mark *m); /* restores the scene, and ends the mark */
void scene_keep(scene_mark *m);              /* ends the mark; the change stays */

/* ---- inputs ---- */

/* The value of an input, defaults and live definitions included. */
bool scene_get(scene *s, input in, long double *value, calc_error *error);
/* Evaluates the live definitions of all bound inputs of a set. */
bool scene_settle(scene *s, input_set set, calc_error *error);
/* Sets an input without a run or a check; for trials. */
void scene_put(scene *s, input in, double value);
/* Calls edit on s->in. Unless all inputs and the program are valid afterwards, restores the scene. */
bool scene_edit(scene *s, void (*edit)(inputs *in, void *context), void *context, calc_error *error);

/* ---- the load program ---- */

/* Appends a step and runs it; on error nothing has changed. A press begins a new program. */
bool scene_load(scene *s, const load_step *step, const cycle_extra *extra, calc_error *error);
/* Appends many steps with the same targets and runs them together. On failure *row is the bad row, and the
 * steps stay: the caller restores the scene. */
bool scene_load_rows(scene *s, load_step step, const double *normal, const double *tangential, size_t count,
                     size_t *row, calc_error *error);
/* Appends to a scratch scene, whose program becomes its own copy; runs nothing. */
bool scene_append(scene *s, const load_step *step, const cycle_extra *extra, calc_error *error);
/* Forgets the load; all: also the inputs. */
void scene_reset(scene *s, bool all);
/* The last cycle with its values; false: there is none. */
bool scene_last_cycle(scene *s, load_item *out, calc_error *error);
/* What closed forms need to know of the program; an error if it is empty. */
bool scene_reach(scene *s, const load_reach **out, calc_error *error);
double scene_time(const scene *s); /* the program must not be empty */

/* ---- results, computed on demand ---- */

/* homogeneous: with k = 0. */
bool scene_material(scene *s, bool homogeneous, fret_material *out, calc_error *error);
/* The shape, unchecked. */
bool scene_gap(scene *s, fret_gap *out, calc_error *error);
/* The law of the gap, worn if Nw > 0. */
bool scene_normal(scene *s, const fret_normal **normal, calc_error *error);
/* Makes answers.normal, the law of the unworn gap. */
bool scene_unworn(scene *s, calc_error *error);
/* The gap worn by Nw cycles; *out = NULL: no wear. */
bool scene_worn(scene *s, const fret_wear **out, calc_error *error);
bool scene_is_worn(const scene *s);  /* worn, and answers.worn is made */
bool scene_is_power(const scene *s); /* is the gap a power law? */
/* Moves the wear path of a clone here, unless the scene has its own. */
void scene_take_wear(scene *s, scene *from);
/* The limit of wear, regardless of Nw; free with fret_wear_free. */
bool scene_wear_limit(scene *s, fret_wear **out, calc_error *error);
/* Fields of the press and of the history in the present state. */
bool scene_pressed_field(scene *s, const fret_field **field, calc_error *error);
bool scene_dragged_field(scene *s, const fret_field **field, calc_error *error);
/* The field for stress inside: of the press, or after tangential steps of the history without curved arcs. */
bool scene_stress_field(scene *s, const fret_field **field, calc_error *error);
/* Friction's work per area at r: so far, or in the last closed period. Runs the load again the first time. */
bool scene_work(scene *s, bool period, long double r, long double *out, calc_error *error);
/* The radii where the work so far is not smooth, at most `room`; returns their number. */
size_t scene_work_edges(const scene *s, long double r[], size_t room);
/* Is that work of a load in chords, each of which makes kinks? */
bool scene_work_chords(const scene *s);
void friction_work_end(friction_work *w);
/* The law of the same bodies with k = 0. */
bool scene_k0(scene *s, const fret_normal **normal, calc_error *error);
/* mu; an error if it is 0, or if nu is missing, which tangential results need. */
bool scene_friction(scene *s, double *mu, calc_error *error);
/* The present normal contact. */
bool scene_press(scene *s, const fret_press **press, calc_error *error);
/* F_N now; where F_N was given no contact is solved. */
bool scene_FN(scene *s, long double *FN, calc_error *error);
/* The present normal contact with its friction. */
bool scene_contact(scene *s, fret_pressed *contact, calc_error *error);
/* The present state, by the chosen model. */
bool scene_state(scene *s, const fret_state **state, calc_error *error);
/* The contact after the load: with curved arcs after a harmonic load, or (straight) with chords instead. */
bool scene_history(scene *s, const fret_contact **contact, calc_error *error);
bool scene_straight(scene *s, const fret_contact **contact, calc_error *error);
/* First loading to a force or displacement; loss of a closed cycle of an amplitude. */
bool scene_loading(scene *s, bool by_force, double v, fret_loading *out, calc_error *error);
bool scene_loss(scene *s, bool by_force, double amplitude, long double *out, calc_error *error);
/* The same for the scene's own program. */
bool scene_first_loading(scene *s, fret_loading *out, calc_error *error);
bool scene_cycle_loss(scene *s, long double *loss, calc_error *error);

/* Does a closed form give the tangential state, or dW? It must be exact for this program (one press and one
 * tangential step, or a cycle at constant F_N), and the model must allow it. */
bool scene_closed_state(scene *s);
bool scene_closed_loss(scene *s);
void scene_used_closed(scene *s);
void scene_set_model(scene *s, model_id model, unsigned springs);

/* ---- the load of the scene, for answers and changes ---- */

/* scene_load of a step that is no press. */
bool load_go_on(scene *s, const load_step *step, const cycle_extra *extra, calc_error *error);
/* The press at the beginning of the program. */
bool load_press(scene *s, const fret_normal *normal, fret_press *out, calc_error *error);
/* Can the harmonic load be run as a sine? Not on a table, nor if a later step changes F_N otherwise. */
bool load_takes_sine(const load_view *load);
/* The run that has reached the end of the program, or the instant. */
bool load_run(scene *s, const runner **run, calc_error *error);

/* ---- running the load again ---- */

/* The load of the scene, as a runner takes it. */
bool scene_load_of(scene *s, load_view *out, calc_error *error);
/* Runs the program on contacts of its own, look by look, at one level or all. Must not be moved. */
typedef struct scene_trace {
    load_view load;
    runner run[LEVELS];
    unsigned levels;
} scene_trace;
/* limit: run all levels if a harmonic load needs chords. After false do not call trace_end. */
bool trace_begin(scene_trace *t, scene *s, watch w, bool limit, calc_error *error);
/* Runs to the next look; false: the end, or an error. */
bool trace_next(scene_trace *t, calc_error *error);
const runner *trace_now(const scene_trace *t); /* after trace_begin */
void trace_end(scene_trace *t);
/* The largest contact radius along the program, for springs. */
bool scene_widest(scene *s, double *radius, calc_error *error);
#endif
