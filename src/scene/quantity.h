/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The one table of quantities: assignment, query, explain, help, completion, labels and JSON derive from it.
 */
#ifndef SCENE_QUANTITY_H
#define SCENE_QUANTITY_H

#include "scene/scene.h"

/* What a row reads. */
typedef enum quantity_of {
    OF_FUNCTION,   /* nothing: it is a function only */
    OF_INPUT,      /* the input */
    OF_PRESS,      /* member `at` of fret_press */
    OF_TWIN,       /* the same with k = 0, at this F_N */
    OF_LOADING,    /* member `at` of fret_loading on first loading, `at_state` of fret_state after it */
    OF_STATE,      /* member `at_state` of fret_state */
    OF_FOUNDATION, /* member `at` of fret_foundation */
    OF_GETTER      /* what get says */
} quantity_of;

/* As a function. */
typedef enum quantity_calls {
    CALL_NONE,    /* it is none */
    CALL_PRESS,   /* member `at` of fret_press, under this force or at this depth */
    CALL_LOADING, /* member `at` of fret_loading, by this force or displacement */
    CALL_LOSS,    /* of a cycle of this amplitude */
    CALL_MODULUS, /* member `at` of fret_foundation, at this x */
    CALL_FIELD,   /* what `field` says of the state now */
    CALL_STRESS,  /* of a place x, y, z: member `at` of fret_stress, or `invariant` */
    CALL_OWN      /* what call says */
} quantity_calls;

/* When a formula holds: all of these. */
enum {
    WHEN_ALWAYS = 0,
    WHEN_FIRST = 1,   /* on first loading */
    WHEN_LATER = 2,   /* after a reversal, F_N constant */
    WHEN_HISTORY = 4, /* F_N has changed on the way */
    WHEN_POWER = 8,   /* the gap is a power law */
    WHEN_STEADY = 16, /* of a cycle, at constant F_N */
    WHEN_CALL = 32    /* as a function */
};

typedef struct formula {
    const char *text;     /* plain */
    const char *equation; /* numbers of Mathematics 2022, 10, 3641; NULL: none */
    unsigned when;
} formula;

/* Inputs that results have in common. */
#define READS_MATERIAL (INPUT_MATERIAL | INPUT_BIT(IN_C0))
#define READS_NORMAL (READS_MATERIAL | INPUT_GEOMETRY | INPUT_PRESS | INPUT_BIT(IN_NW))
#define READS_WORN (READS_TANGENTIAL | INPUT_BIT(IN_ALPHA_W))
#define READS_TANGENTIAL (READS_NORMAL | INPUT_BIT(IN_MU) | INPUT_CYCLE | INPUT_BIT(IN_K_RIG))

enum { FORMULAS = 5 };

typedef struct quantity {
    const char *name;
    const char *title;    /* for labels and help */
    const char *keywords; /* other words to find it by, or NULL */
    dim d;                /* of the value; see quantity_dim for A */
    const char *unit;     /* that readers are shown it in; NULL: one that fits */
    quantity_of of;
    size_t at, at_state;
    int in; /* 1 + the input that it is, of a press where it was pressed by it; 0: none */
    bool (*get)(scene *s, long double *out, calc_error *error);
    quantity_calls calls;
    fret_status (*field)(const fret_field *of, fret_real r, fret_real *out);
    double (*invariant)(const fret_stress *of);
    bool (*call)(scene *s, value arg, long double *out, calc_error *error);
    bool (*closed)(scene *s); /* does a closed form answer for the value, else what steps? NULL: `by` tells */
    model_id
        by; /* what answers for the function, or the getter; MODEL_CLOSED: the closed form, or polynomials */
    const char *argument;
    dim argument_d;
    dim argument_or;     /* what the argument may be instead; a number: nothing else */
    input_set reads;     /* inputs that it can depend on */
    bool load;           /* it depends on the load program too */
    const char *imposed; /* the command whose target it may be, or NULL */
    formula formulas[FORMULAS];
} quantity;

const quantity *quantity_find(const char *name, size_t len);
const quantity *quantity_row(size_t i); /* NULL after the last */
const char *quantity_name(size_t i);    /* for suggest() */
/* The row of an input. */
const quantity *quantity_of_input(input in);
/* The row of what a step goes to by this. */
const quantity *quantity_of_step(load_by by);
/* Is it an input that can be set? */
static inline bool quantity_is_input(const quantity *q) {
    return q->in > 0;
}
static inline input quantity_input(const quantity *q) {
    return (input)(q->in - 1);
}
/* How many it takes as a function; 0: it is none. */
static inline unsigned quantity_arguments(const quantity *q) {
    return q->calls == CALL_STRESS ? 3 : q->calls != CALL_NONE;
}
/* Can it be asked for without an argument? */
static inline bool quantity_has_value(const quantity *q) {
    return q->of != OF_FUNCTION;
}

bool quantity_get(const quantity *q, scene *s, long double *out, calc_error *error);
/* As a function of so many arguments. */
bool quantity_call(const quantity *q, scene *s, const value arg[], long double *out, calc_error *error);
/* The dimension in this scene: that of A depends on n. */
dim quantity_dim(const quantity *q, const scene *s);
/* The formula that makes the number in this scene; call: as a function. */
const formula *quantity_formula(const quantity *q, scene *s, bool call);
/* The model that answers for it. */
model_id quantity_model(const quantity *q, scene *s, bool call);

#endif
