/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The scene: inputs, load program, and what follows from them, computed when asked. */
#ifndef CALC_SCENE_H
#define CALC_SCENE_H

#include <signal.h>

#include "calc/lex.h"
#include "calc/unit.h"
#include "fret/fret.h"

typedef struct value {
    long double v; /* SI */
    dim d;
} value;

typedef enum input {
    IN_E0,
    IN_NU,
    IN_K,
    IN_C0,
    IN_E0_2,
    IN_NU_2,
    IN_MU,
    IN_FN,
    IN_N,
    IN_A,
    IN_H,
    IN_R0,
    IN_RADIUS,
    IN_B,
    IN_SLOPE,
    INPUTS
} input;

/* One row a geometry: its name, the gap it makes and the parameters it takes. */
typedef struct geometry {
    const char *name;
    fret_gap_kind kind;
    double n;          /* exponent where the name fixes it, else 0 */
    input required[3]; /* ended by INPUTS */
    const char *usage;
    const char *meaning;
} geometry;

const geometry *geometry_find(const char *name, size_t len);
const geometry *geometry_row(size_t i); /* NULL after the last */

typedef enum second_body { SECOND_SAME, SECOND_RIGID, SECOND_GIVEN } second_body;

typedef enum load_kind { LOAD_PRESS, LOAD_STEP, LOAD_CYCLE } load_kind;
typedef enum load_by { BY_NONE, BY_FORCE, BY_DISPLACEMENT, BY_RADIUS } load_by;

/* One command of the load program: 24 bytes, since programs of 1e6 steps are kept for re-running. */
typedef struct load_step {
    unsigned char kind, normal, tangential, relative; /* relative: bit 0 normal, bit 1 tangential */
    unsigned points;                                  /* to record on the way; cycle: chords a period */
    double normal_value;                              /* cycle: amplitude FNA */
    double tangential_value;                          /* cycle: amplitude FA or dxA */
} load_step;

/* What only a cycle has; the i-th cycle of the program owns entry i. */
typedef struct cycle_extra {
    unsigned times;
    double phase;
} cycle_extra;

/* Which model answers: auto takes the closed form where there is one, else the memory diagram. */
typedef enum scene_model { MODEL_AUTO, MODEL_CLOSED, MODEL_MEMORY, MODEL_SPRINGS } scene_model;

/* What has computed the answers: bits of scene.used. */
enum { USED_CLOSED = 1, USED_MEMORY = 2, USED_QUADRATURE = 4, USED_SPRINGS = 8 };

/* A recorded state of the load program. */
typedef void load_observer(const fret_state *state, size_t step, void *context);

/* What closed forms need to know of the load program after the press, as far as its first `seen` steps. */
typedef struct load_reach {
    size_t seen, cycles;
    load_by by;  /* how all of them push; BY_NONE before the first */
    bool alike;  /* they do, and none is relative */
    double most; /* largest magnitude so far */
    bool first;  /* the last one ends on the curve of first loading: no larger load is remembered */
    double end;  /* where it ends */
    bool closed; /* the last period of the last cycle returned to the state that it began in */
} load_reach;

typedef struct scene {
    double in[INPUTS];
    bool set[INPUTS];
    second_body second;
    const geometry *geometry;
    fret_gap sum;               /* terms of `geometry sum` */
    struct shared_table *table; /* of `geometry file`; counted, so that an old scene can come back */

    load_step *program;
    size_t steps, room;
    cycle_extra *cycles;
    size_t cycle_count, cycle_room;
    bool borrowed;      /* a clone: the program belongs to another scene */
    bool normal_varies; /* some step after the press changes F_N */
    load_reach reach;

    /* derived, valid as far as the flags say */
    fret_normal *normal, *k0; /* NULL: to be made */
    bool press_ready;
    fret_press press;
    fret_memory *memory, *spare;
    size_t mark, mark_cycles; /* scene_begin */
    bool mark_varies;
    size_t applied, applied_cycles; /* how far the program has been run on memory */
    fret_state state;
    bool state_ready;
    long double cycle_loss; /* of the last period of the last cycle run on memory */
    scene_model model;
    unsigned springs;         /* how many, for MODEL_SPRINGS */
    long double springs_loss; /* cycle_loss as the springs have it, with state */
    unsigned used;            /* raised by whatever answers, cleared by whoever wants to know */
    const volatile sig_atomic_t *stop;
} scene;

/* A gap table that scenes share. */
typedef struct shared_table {
    size_t users;
    struct fret_table *table;
    char name[256];
} shared_table;

void scene_free(scene *s);
/* Takes over the table, its name for `show`; on error frees it. */
bool scene_set_table(scene *s, struct fret_table *table, const char *name, calc_error *error);
/* A scratch copy for sweeps: shares the program, owns its results. Free with scene_free. */
void scene_clone(scene *to, const scene *from);
/* Forgets what has been computed. */
void scene_forget(scene *s);
/* Frees the contacts of a scene; hands them over to a copy of it that was made before. */
void scene_drop(scene *s);
void scene_hand_over(scene *s);
/* Forgets the load program; `all`: the inputs too. */
void scene_reset(scene *s, bool all);

/* Sets an input and re-runs the load program; on error the scene is as before. */
bool scene_set(scene *s, input in, double value, calc_error *error);
/* Is the value in the range of the input, whatever the rest of the scene? */
bool scene_check(const scene *s, input in, double value, calc_error *error);
/* scene_set without running anything: for sweeps. */
void scene_put(scene *s, input in, double value);
/* The value of an input of the scene, defaults included; false and an error where it has none. */
bool scene_get(const scene *s, input in, long double *value, calc_error *error);
/* Replaces a group of inputs at once: edit works on the scene, which is restored on error. */
bool scene_edit(scene *s, void (*edit)(scene *s, void *context), void *context, calc_error *error);

/* Appends to the load program and runs it; on error nothing has changed. */
bool scene_load(scene *s, const load_step *step, const cycle_extra *extra, calc_error *error);

/* Marks the place that scene_roll_back returns to: for commands of many steps. */
bool scene_begin(scene *s, calc_error *error);
void scene_roll_back(scene *s);

/* What follows, made ready on demand. */
bool scene_normal(scene *s, const fret_normal **normal, calc_error *error);
bool scene_k0(scene *s, const fret_normal **normal, calc_error *error);
bool scene_friction(const scene *s, double *mu, calc_error *error);
bool scene_press(scene *s, const fret_press **press, calc_error *error);
bool scene_state(scene *s, const fret_state **state, calc_error *error);
bool scene_memory(scene *s, const fret_memory **memory, calc_error *error);
void scene_set_model(scene *s, scene_model model, unsigned springs);
/* May a closed form answer for the tangential state, and for dW? It must be exact for this load program: one
 * press and one tangential step, or a cycle at constant F_N; and the model must allow it. */
bool scene_closed_state(scene *s);
bool scene_closed_loss(scene *s);
/* Notes that a closed form has answered; for gaps other than a power it takes quadrature. */
void scene_used_closed(scene *s);
/* "closed form", "memory diagram", "springs": what answers for the state. */
const char *scene_model_name(const scene *s, bool closed);
bool scene_first_loading(scene *s, fret_loading *out, calc_error *error);
/* The last cycle of the program, or NULL. */
const load_step *scene_last_cycle(const scene *s);
bool scene_cycle_loss(scene *s, long double *loss, calc_error *error);

/* The last cycle of the load program on a contact of its own, period by period, to compare models:
 * `springs` of them, or the memory diagram (0). Opened, the program has run up to the last period. parts:
 * each straight step is cut into so many; 0: none, no loop area. */
typedef struct cycle_run cycle_run;
bool cycle_run_open(scene *s, unsigned springs, unsigned parts, cycle_run **out, calc_error *error);
/* One more period: what it dissipated, by friction work and by the loop area (21); either may be NULL. */
bool cycle_run_period(cycle_run *run, long double *loss, long double *area, calc_error *error);
void cycle_run_close(cycle_run *run);

/* Runs the whole program on a contact of its own, with `points` states a tangential branch where the
 * step names none (0: only those named). */
bool scene_trace(scene *s, unsigned points, load_observer *observe, void *context, calc_error *error);

/* Puts a status of the library into words. */
bool scene_status(const scene *s, calc_error *error, const fret_status *status);

#endif
