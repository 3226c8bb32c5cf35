/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of quantities: assignment, query, explain, help, completion, labels and JSON derive from it. */
#ifndef SCENE_QUANTITY_H
#define SCENE_QUANTITY_H

#include "scene/scene.h"

/* What a query of the row reads. */
typedef enum quantity_of {
    OF_FUNCTION,   /* nothing: the row is a function only */
    OF_INPUT,      /* the input `in` */
    OF_PRESS,      /* member `at` of fret_press */
    OF_TWIN,       /* the same of the contact with k = 0 at this F_N */
    OF_LOADING,    /* member `at` of fret_loading on first loading, `at_state` of fret_state after it */
    OF_STATE,      /* member `at_state` of fret_state */
    OF_FOUNDATION, /* member `at` of fret_foundation */
    OF_GETTER      /* get() returns it */
} quantity_of;

/* What a call of the row as a function evaluates. */
typedef enum quantity_calls {
    CALL_NONE,    /* it is no function */
    CALL_PRESS,   /* member `at` of fret_press at a force or depth */
    CALL_LOADING, /* member `at` of fret_loading at a force or displacement */
    CALL_LOSS,    /* loss of a cycle of an amplitude */
    CALL_MODULUS, /* member `at` of fret_foundation at x */
    CALL_FIELD,   /* field() of the present state at r */
    CALL_STRESS,  /* member `at` of fret_stress at x, y, z, or its `invariant` */
    CALL_OWN      /* call() returns it */
} quantity_calls;

/* Conditions under which a formula holds; all bits set must hold. */
enum {
    WHEN_ALWAYS = 0,
    WHEN_FIRST = 1,   /* on first loading */
    WHEN_LATER = 2,   /* after a reversal, F_N constant */
    WHEN_HISTORY = 4, /* F_N has changed along the load */
    WHEN_POWER = 8,   /* the gap is a power law */
    WHEN_STEADY = 16, /* for a cycle at constant F_N */
    WHEN_CALL = 32    /* called as a function */
};

typedef struct formula {
    const char *text;     /* in plain text */
    const char *equation; /* equation numbers of Mathematics 2022, 10, 3641; NULL: none */
    unsigned when;
} formula;

/* Sets of inputs that many results depend on. */
#define READS_MATERIAL (INPUT_MATERIAL | INPUT_BIT(IN_C0))
#define READS_NORMAL (READS_MATERIAL | INPUT_GEOMETRY | INPUT_PRESS | INPUT_BIT(IN_NW))
#define READS_WORN (READS_TANGENTIAL | INPUT_BIT(IN_ALPHA_W))
#define READS_TANGENTIAL (READS_NORMAL | INPUT_BIT(IN_MU) | INPUT_CYCLE | INPUT_BIT(IN_K_RIG))

enum { FORMULAS = 5 };

typedef struct quantity {
    const char *name;
    const char *title;    /* for labels and help */
    const char *keywords; /* other words to find it by, or NULL */
    dim d;                /* dimension of the value; for A see quantity_dim */
    const char *unit;     /* unit in which it is shown; NULL: chosen to fit */
    quantity_of of;
    size_t at, at_state;
    int in; /* 1 + the input that it is or, for a press, may be imposed by; 0: none */
    bool (*get)(scene *s, long double *out, calc_error *error);
    quantity_calls calls;
    fret_status (*field)(const fret_field *of, fret_real r, fret_real *out);
    double (*invariant)(const fret_stress *of);
    bool (*call)(scene *s, value arg, long double *out, calc_error *error);
    bool (*closed)(scene *s); /* does a closed form give the value? NULL: see `by` */
    model_id by;              /* model of the function or getter; MODEL_CLOSED: closed form or polynomials */
    const char *argument;
    dim argument_d;
    dim argument_or;     /* dimension that the argument may have instead; 1: none */
    input_set reads;     /* inputs that it may depend on */
    bool load;           /* depends on the load program too */
    const char *imposed; /* the command that can impose it, or NULL */
    formula formulas[FORMULAS];
} quantity;

const quantity *quantity_find(const char *name, size_t len);
const quantity *quantity_row(size_t i); /* NULL after the last */
const char *quantity_name(size_t i);    /* for suggest() */
/* The row of an input. */
const quantity *quantity_of_input(input in);
/* The row of the tangential target of a step by `by`. */
const quantity *quantity_of_step(load_by by);
/* Is the row an input, which can be set? */
static inline bool quantity_is_input(const quantity *q) {
    return q->in > 0;
}
static inline input quantity_input(const quantity *q) {
    return (input)(q->in - 1);
}
/* The number of arguments as a function; 0: the row is none. */
static inline unsigned quantity_arguments(const quantity *q) {
    return q->calls == CALL_STRESS ? 3 : q->calls != CALL_NONE;
}
/* Does the row have a value without arguments? */
static inline bool quantity_has_value(const quantity *q) {
    return q->of != OF_FUNCTION;
}

bool quantity_get(const quantity *q, scene *s, long double *out, calc_error *error);
/* Calls the row as a function of quantity_arguments() arguments. */
bool quantity_call(const quantity *q, scene *s, const value arg[], long double *out, calc_error *error);
/* The dimension in this scene; that of A depends on n. */
dim quantity_dim(const quantity *q, const scene *s);
/* The formula that holds in this scene, for the value or (call) for the function. */
const formula *quantity_formula(const quantity *q, scene *s, bool call);
/* The model that answers for the value or the function. */
model_id quantity_model(const quantity *q, scene *s, bool call);

#endif
