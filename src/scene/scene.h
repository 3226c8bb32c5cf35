/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A scene: inputs, as much of a load program, and a cache of what follows from them. Knows units and names of
 * nothing; live definitions come back to it through one function. */
#ifndef SCENE_SCENE_H
#define SCENE_SCENE_H

#include <signal.h>

#include "scene/run.h"

typedef struct value {
    long double v; /* SI */
    dim d;
} value;

/* What closed forms need to know of the load program after the press, as far as its first `seen` steps. */
typedef struct load_reach {
    load_mark seen;
    load_by by;         /* how all of them push; BY_NONE before the first */
    bool alike;         /* they do, and none is relative */
    double most;        /* largest magnitude so far */
    bool first;         /* the last one ends on the curve of first loading: no larger load is remembered */
    double end;         /* where it ends */
    bool closed;        /* the last period of the last cycle returned to the state that it began in */
    bool normal_varies; /* some step changes F_N */
    bool rig;           /* some goes to a displacement at the rig */
    bool swings;        /* a cycle does */
    size_t last_cycle;  /* its index, or NO_CYCLE */
} load_reach;

/* Friction's work by place: so far, and of the last closed period, if there is one, times how many it stands
 * for; at all levels of the run. */
typedef struct friction_work {
    unsigned levels; /* 0: not made yet */
    fret_work *far[LEVELS], *period[LEVELS];
    unsigned times[LEVELS];
} friction_work;

/* A gap that has worn for Nw cycles. */
typedef struct worn_gap {
    counted base;
    fret_normal *normal; /* that it has worn from */
    fret_wear_held held;
    double Nw;
    fret_wear *wear;
} worn_gap;
typedef struct wear_path wear_path; /* worn.c */
#define WEAR_TOLERANCE 1e-3

/* What follows, valid as far as the flags say. */
typedef struct answers {
    fret_normal *normal, *k0;      /* of the gap as it is given; or NULL: not made yet */
    worn_gap *worn;                /* whose law stands in place of that one, or NULL */
    fret_field *pressed, *dragged; /* of the press, and of the history, as they are now; or NULL */
    fret_field *straight;          /* as dragged, in chords after swinging; or NULL */
    friction_work work;
    bool press_ready, reach_ready, state_ready;
    fret_press press;
    runner run[LEVELS];    /* the memory diagram as far as it has been run */
    fret_contact *chorded; /* room for scene_straight */
    unsigned levels;
    bool chords; /* the swinging load of the program cannot be taken as it is */
    load_reach reach;
    sight end; /* now */
} answers;

typedef struct scene scene;

/* Evaluates the live definition of an input in a scene: the value is of its dimension. */
typedef bool scene_definition(void *context, scene *s, input in, counted *definition, value *out,
                              calc_error *error);

/* An instant on the way of a load: the run as it stands there, or runs at all levels. */
typedef struct instant {
    const runner *run;
    unsigned levels;
    struct beside *beside; /* the same instant in other scenes (beside.h); NULL: it cannot be had */
} instant;

/* The models that have answered (bits USED), and the relative error of polynomials among them. */
typedef struct scene_use {
    unsigned models;
    double pieces_error;
} scene_use;

struct scene {
    inputs in;
    input_set settled, settling; /* inputs whose definitions have been, are being evaluated */
    program *program;            /* or NULL: nothing is pressed */
    load_mark end;
    const instant *now; /* or NULL: the end of the program */
    bool sound;         /* of a scratch scene: a copy of one whose program runs to its end */
    bool before;        /* of one for a definition: the last cycle is still to come, the amplitudes are its */
    bool early;         /* and so are steps that lead to it */
    answers answers;
    model_id model; /* that is to answer */
    unsigned springs;
    /* of a scratch scene: what is prepared for its shape and k, whatever the material; or NULL */
    fret_normal *like;
    wear_path *wears;    /* shared with those it was cloned from; or NULL */
    bool gaps;           /* of a scratch scene: FN(dz) of dz < 0, before contact, is 0 and no error */
    double pieces_error; /* of the polynomials among them, relative */
    unsigned used;       /* what has answered: raised by whatever does, cleared by whoever wants to know */
    const volatile sig_atomic_t *stop; /* never NULL */
    void (*pulse)(void);               /* called now and then by what takes long; or NULL */
    scene_definition *evaluate;
    void *context;
};

void scene_init(scene *s, const volatile sig_atomic_t *stop, scene_definition *evaluate, void *context);
void scene_free(scene *s);
/* A scratch scene: shares inputs and program, owns its results. Free with scene_free. */
void scene_clone(scene *to, const scene *from);
scene_use scene_answered_by(const scene *s);
/* These have answered too. */
void scene_also_used(scene *s, scene_use also);
void scene_used_law(scene *s, const fret_normal *normal);
/* Press and state are found anew. */
void scene_moved(scene *s);
/* They are those of this instant; NULL: of the end of the program. */
void scene_look(scene *s, const instant *now);
/* Forgets what has been computed; keep: the normal contact still stands. */
void scene_forget(scene *s, bool keep);
/* Are the contacts of these inputs the same? */
bool scene_same_contact(const inputs *a, const inputs *b);
/* Only where they are. */
void answers_pass_contact(answers *to, answers *from);
/* Takes the contact of another scene, where it is the same: that one is to be asked nothing any more. */
void scene_take_contact(scene *s, scene *from);

/* The one way back: inputs and load as they are now. */
typedef struct scene_mark {
    inputs in;
    program *program;
    load_mark end;
    answers answers; /* that have moved here */
} scene_mark;
/* move: takes the answers along; the scene begins with none. */
void scene_save(scene *s, scene_mark *m, bool move);
void scene_back(scene *s, scene_mark *m); /* ends the mark */
void scene_drop(scene_mark *m);           /* the change stands */

/* ---- inputs ---- */

/* The value of an input, defaults and live definitions included. */
bool scene_get(scene *s, input in, long double *value, calc_error *error);
/* Sets an input without running or checking anything: for trials. */
void scene_put(scene *s, input in, double value);
/* Changes of inputs: edit works on s->in. All that the scene claims must hold afterwards, or nothing has
 * changed. */
bool scene_edit(scene *s, void (*edit)(inputs *in, void *context), void *context, calc_error *error);

/* ---- the load program ---- */

/* Appends and runs; on error nothing has changed. A press begins a new program. */
bool scene_load(scene *s, const load_step *step, const cycle_extra *extra, calc_error *error);
/* Many steps by the same targets, run together. Of a failure *row tells where; the scene is to be brought
 * back then: the steps are there. */
bool scene_load_rows(scene *s, load_step step, const double *normal, const double *tangential, size_t count,
                     size_t *row, calc_error *error);
/* Appends to a scratch scene, whose program becomes its own; runs nothing. */
bool scene_append(scene *s, const load_step *step, const cycle_extra *extra, calc_error *error);
/* Forgets the load; all: the inputs too. */
void scene_reset(scene *s, bool all);
/* The last cycle as it runs; false: there is none. */
bool scene_last_cycle(scene *s, load_item *out, calc_error *error);
/* The reach of the load program; it is pressed. */
bool scene_reach(scene *s, const load_reach **out, calc_error *error);
double scene_time(const scene *s); /* it is pressed, too */

/* ---- what follows, made ready on demand ---- */

/* homogeneous: with k = 0. */
bool scene_material(scene *s, bool homogeneous, fret_material *out, calc_error *error);
/* The shape alone, unchecked. */
bool scene_gap(scene *s, fret_gap *out, calc_error *error);
bool scene_normal(scene *s, const fret_normal **normal, calc_error *error);
/* That of the gap as it is given is in answers.normal. */
bool scene_unworn(scene *s, calc_error *error);
/* The wear of Nw cycles; NULL: none. */
bool scene_worn(scene *s, const fret_wear **out, calc_error *error);
bool scene_is_worn(const scene *s);  /* and has been asked for */
bool scene_is_power(const scene *s); /* is the gap, as far as it is known? */
/* How others wear that was cloned from it, where it does not know that of its own. */
void scene_take_wear(scene *s, scene *from);
/* What infinitely many leave, whatever Nw; to be freed. */
bool scene_wear_limit(scene *s, fret_wear **out, calc_error *error);
/* Fields of the press and of the history as they are now. */
bool scene_pressed_field(scene *s, const fret_field **field, calc_error *error);
bool scene_dragged_field(scene *s, const fret_field **field, calc_error *error);
/* Of which stress inside is asked: of the press alone where nothing tangential has been, else without curves.
 */
bool scene_stress_field(scene *s, const fret_field **field, calc_error *error);
/* Friction's work by place up to now, and of the last closed period; the load is run again for it. */
bool scene_work(scene *s, bool period, long double r, long double *out, calc_error *error);
/* Where those of the work that has been asked for are not smooth, as far as there is room: how many. */
size_t scene_work_edges(const scene *s, long double r[], size_t room);
/* Is it that of a load in chords, each of which makes kinks of its own? */
bool scene_work_chords(const scene *s);
void friction_work_end(friction_work *w);
/* The same bodies with k = 0. */
bool scene_k0(scene *s, const fret_normal **normal, calc_error *error);
bool scene_friction(scene *s, double *mu, calc_error *error);
bool scene_press(scene *s, const fret_press **press, calc_error *error);
/* F_N now; does not ask for the contact where it was given. */
bool scene_FN(scene *s, long double *FN, calc_error *error);
bool scene_contact(scene *s, fret_pressed *contact, calc_error *error);
bool scene_state(scene *s, const fret_state **state, calc_error *error);
/* Of it only F_N, dz, F_x, dx and W: at an instant on the way of a load far cheaper. */
bool scene_forces(scene *s, const fret_state **state, calc_error *error);
/* What the load has left: as it is, after a swinging load curved; and with that in chords. */
bool scene_history(scene *s, const fret_contact **contact, calc_error *error);
bool scene_straight(scene *s, const fret_contact **contact, calc_error *error);
/* On first loading under this force, or at this displacement; of a closed cycle of such an amplitude. */
bool scene_loading(scene *s, bool by_force, double v, fret_loading *out, calc_error *error);
bool scene_loss(scene *s, bool by_force, double amplitude, long double *out, calc_error *error);
/* As the program has gone. */
bool scene_first_loading(scene *s, fret_loading *out, calc_error *error);
bool scene_cycle_loss(scene *s, long double *loss, calc_error *error);

/* May a closed form answer for the tangential state, and for dW? It must be exact for this load program: one
 * press and one tangential step, or a cycle at constant F_N; and the model must allow it. */
bool scene_closed_state(scene *s);
bool scene_closed_loss(scene *s);
void scene_used_closed(scene *s);
void scene_set_model(scene *s, model_id model, unsigned springs);

/* ---- the load of the scene, for answers and changes ---- */

/* scene_load of a step that is no press. */
bool load_go_on(scene *s, const load_step *step, const cycle_extra *extra, calc_error *error);
/* The press at the beginning of the program. */
bool load_press(scene *s, const fret_normal *normal, fret_press *out, calc_error *error);
/* Can a swinging load be taken as it is? On no table of rows. */
bool load_takes_sine(const load_view *load);
/* The run that has come to the end of the program, or to now. */
bool load_run(scene *s, const runner **run, calc_error *error);

/* ---- running it again ---- */

/* The load of the scene as a runner takes it. */
bool scene_load_of(scene *s, load_view *out, calc_error *error);
/* The program run on contacts of its own, look by look: one, or all levels side by side. Stays where it is.
 */
typedef struct scene_trace {
    load_view load;
    runner run[LEVELS];
    unsigned levels;
} scene_trace;
/* limit: that of swinging periods is wanted. False: there is nothing to end. */
bool trace_begin(scene_trace *t, scene *s, watch w, bool limit, calc_error *error);
/* On to the next look; false: the end, or the error. */
bool trace_next(scene_trace *t, calc_error *error);
const runner *trace_now(const scene_trace *t); /* it has begun */
void trace_end(scene_trace *t);
/* The radius of the largest contact of the program: springs are to be as wide. */
bool scene_widest(scene *s, double *radius, calc_error *error);
#endif
