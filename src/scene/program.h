/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The load program: presses, steps and cycles in the order they were given. It only grows, so that a length
 * marks a state of it and scenes can share it. Touches no scene. */
#ifndef SCENE_PROGRAM_H
#define SCENE_PROGRAM_H

#include "scene/counted.h"
#include "scene/inputs.h"

typedef enum load_kind { LOAD_PRESS, LOAD_STEP, LOAD_CYCLE } load_kind;
typedef enum load_by {
    BY_NONE,
    BY_FORCE,
    BY_DISPLACEMENT,
    BY_RADIUS,
    BY_PEAK,
    BY_MEAN,
    BY_RIG
} load_by; /* a press: FORCE to MEAN; tangentially: NONE, FORCE, DISPLACEMENT, RIG */
enum { RELATIVE_NORMAL = 1, RELATIVE_TANGENTIAL = 2 };

/* One command of the load program: 24 bytes, since programs of 1e6 steps are kept for re-running. */
typedef struct load_step {
    unsigned char kind, normal, tangential, relative;
    unsigned points;         /* number of points to record on the way */
    double normal_value;     /* cycle: amplitude FNA */
    double tangential_value; /* cycle: amplitude FA, dxA or drigA */
} load_step;

/* The extra data of cycles; the i-th cycle of the program owns entry i. */
typedef struct cycle_extra {
    unsigned times;
    double phase;
} cycle_extra;

typedef struct program {
    counted base;
    load_step *steps;
    cycle_extra *cycles;
    size_t room, cycle_room;
} program;

/* A state of a program: its first `steps` steps, `cycles` of them cycles. */
typedef struct load_mark {
    size_t steps, cycles;
} load_mark;

program *program_make(void); /* NULL: out of memory */
/* A separate copy up to the mark, which may be changed. */
program *program_copy(const program *from, load_mark mark);
/* Appends at the mark and moves it; drops what lies beyond. False: out of memory, nothing has changed. */
bool program_append(program *p, load_mark *mark, const load_step *step, const cycle_extra *extra);

/* Index of the last cycle before the mark, or NO_CYCLE. */
#define NO_CYCLE ((size_t)-1)
size_t program_last_cycle(const program *p, load_mark mark);

/* The input that a press by `by` imposes, and the inverse; BY_NONE: the input imposes no press. */
input press_input(load_by by);
load_by press_by(input in);
/* The input that is the amplitude of a cycle by `by`, and the `by` of the last cycle in the inputs. */
input cycle_input(load_by by);
load_by cycle_by(const inputs *in);
fret_status press_to(const fret_normal *normal, load_by by, double value, fret_press *out);

/* A step with its values; those of the press and of the last cycle come from the inputs. */
typedef struct load_item {
    load_step step;
    cycle_extra extra;
} load_item;
load_item program_item(const program *p, load_mark here, size_t last_cycle, const inputs *in);

/* Copies what an appended step imposes, a press or the amplitudes of a cycle, into the inputs. */
void program_to_inputs(const load_step *step, const cycle_extra *extra, inputs *in);
/* Copies the amplitudes in the inputs back into the cycle, before another cycle follows. */
void program_freeze(program *p, size_t last_cycle, size_t cycle, const inputs *in);

/* Does F_N change in this step or cycle? */
static inline bool load_moves_normal(const load_step *step) {
    return step->kind == LOAD_STEP ? step->normal != BY_NONE : step->normal_value != 0;
}

/* Is the step one to a displacement, of the contact or at the rig, with the normal force kept? */
static inline bool load_is_slide(const load_step *step) {
    return step->kind == LOAD_STEP && !step->normal && step->tangential > BY_FORCE && !step->relative;
}

#endif
