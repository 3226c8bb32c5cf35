/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The inputs of a scene as a plain value: material, geometry, friction, and the amplitudes of the load that
 * can be changed afterwards. Knows ranges, no names; touches nothing else of a scene. */
#ifndef SCENE_INPUTS_H
#define SCENE_INPUTS_H

#include "fret/fret.h"
#include "scene/counted.h"
#include "text/error.h"
#include "text/unit.h"

typedef enum input {
    IN_E0,
    IN_NU,
    IN_K,
    IN_C0,
    IN_E0_2,
    IN_NU_2,
    IN_G0, /* G0 to Estar: in place of E0 or E0_2 */
    IN_G0_2,
    IN_ESTAR,
    IN_MU,
    IN_FN, /* FN to pmean: what the press imposes; one of them is set */
    IN_DZ,
    IN_CONTACT,
    IN_P0,
    IN_PMEAN,
    IN_FA,  /* FA to PHASE: of the last cycle */
    IN_DXA, /* one of FA, dxA and drigA is set */
    IN_DRIGA,
    IN_FNA,
    IN_PHASE,
    IN_NW,    /* number of times that the last cycle wears the gap */
    IN_K_RIG, /* K_rig to F0: of the rig */
    IN_D0,
    IN_F0,
    IN_YIELD,
    IN_YIELD_2,
    IN_SB,
    IN_ALPHA_W,
    IN_N, /* from here on: parameters of the geometry */
    IN_A,
    IN_H,
    IN_R0,
    IN_RADIUS,
    IN_B,
    IN_SLOPE,
    INPUTS
} input;

/* A set of inputs, as bits; for tables of dependences. */
typedef unsigned long long input_set;
#define INPUT_BIT(in) ((input_set)1 << (in))
#define INPUT_MODULUS (INPUT_BIT(IN_E0) | INPUT_BIT(IN_G0) | INPUT_BIT(IN_ESTAR)) /* one of them is set */
#define INPUT_MODULUS_2 (INPUT_BIT(IN_E0_2) | INPUT_BIT(IN_G0_2))
#define INPUT_MODULI (INPUT_MODULUS | INPUT_MODULUS_2)
#define INPUT_MATERIAL                                                                                       \
    (INPUT_MODULI | INPUT_BIT(IN_NU) | INPUT_BIT(IN_NU_2) | INPUT_BIT(IN_K)) /* without c0 */
#define INPUT_PRESS                                                                                          \
    (INPUT_BIT(IN_FN) | INPUT_BIT(IN_DZ) | INPUT_BIT(IN_CONTACT) | INPUT_BIT(IN_P0) | INPUT_BIT(IN_PMEAN))
#define INPUT_GEOMETRY (INPUT_BIT(INPUTS) - INPUT_BIT(IN_N))
#define INPUT_AMPLITUDE (INPUT_BIT(IN_FA) | INPUT_BIT(IN_DXA) | INPUT_BIT(IN_DRIGA))
#define INPUT_CYCLE (INPUT_AMPLITUDE | INPUT_BIT(IN_FNA) | INPUT_BIT(IN_PHASE) | INPUT_BIT(IN_NW))
#define INPUT_RIG (INPUT_BIT(IN_K_RIG) | INPUT_BIT(IN_D0) | INPUT_BIT(IN_F0))
#define INPUT_STRESS                                                                                         \
    (INPUT_BIT(IN_YIELD) | INPUT_BIT(IN_YIELD_2) | INPUT_BIT(IN_SB)) /* which no contact depends on */

typedef struct inputs inputs;

/* A row of the table of geometries: its name, the kind of gap it makes and the parameters it takes. */
typedef struct geometry {
    const char *name;
    fret_gap_kind kind;
    double n; /* exponent that the name implies, else 0 */
    input_set required, optional;
    const char *takes; /* grammar of its arguments, as in rows of commands */
    const char *meaning;
    const char *keywords; /* other words to find it by */
    const char *example;  /* example for `help`: a transcript, indented by four */
} geometry;

const geometry *geometry_row(size_t i); /* NULL after the last */
const char *geometry_name(size_t i);    /* for suggest() */

typedef enum second_body { SECOND_SAME, SECOND_RIGID, SECOND_GIVEN } second_body;

enum { CHOSEN = 256 };

/* How the rows of a file are made into a gap. */
typedef struct smoothing {
    enum { SMOOTH_NOT, SMOOTH_FREELY, SMOOTH_PIECES, SMOOTH_WITHIN } by;
    size_t pieces;
    double within;        /* rms deviation [m] */
    bool height;          /* the rows are heights: f = -z */
    char columns[CHOSEN]; /* the text ` using ...`; empty: columns found by name */
} smoothing;

/* A gap table, reference-counted: scenes and undo share it. */
typedef struct shared_table {
    counted base;
    struct fret_table *table;
    smoothing smoothing;
    char name[]; /* name of its file */
} shared_table;

struct inputs {
    double v[INPUTS];
    bool set[INPUTS];
    counted *bound[INPUTS]; /* the live definition (names.h) that v follows, or NULL */
    input_set bindings;     /* the inputs that are bound */
    second_body second;
    const geometry *geometry;
    double radii[2];     /* R1 and R2 [m] that give R; 0: R was given */
    fret_gap sum;        /* the terms of `geometry sum` */
    shared_table *table; /* the table of `geometry file` */
};

/* Copies inputs, and releases them; every copy must be dropped. */
void inputs_copy(inputs *to, const inputs *from);
void inputs_drop(inputs *in);

/* Are the inputs `which` equal, with the bodies and the shape, and none of them bound? */
bool inputs_same(const inputs *a, const inputs *b, input_set which);

/* The range of an input, maybe infinite. Of its ends only nu = 1/2 and 0 of mu, FNA and Nw belong to it. */
void input_range(input in, double *lo, double *hi);
/* Is the value in the range of the input? */
fret_status input_status(input in, double v);
bool input_check(input in, double v, calc_error *error);

/* Is any input of the set given or bound? */
bool inputs_any(const inputs *in, input_set set);
/* Is Poisson's ratio given? With Estar alone a press does not need it. */
bool inputs_know_nu(const inputs *in);

/* The inputs that one replaces: A and h (r/r0)^n are alternatives, as are the moduli of a body. */
input_set inputs_replaced(input by);
/* Sets a value, unbinds, and unsets what the value replaces, or that the second body is as the first. */
void inputs_put(inputs *in, input which, double v);
void inputs_unset(inputs *in, input_set set);
/* Replaces a binding by `to` (owned from then on; NULL: none); the value stays. */
void inputs_bind(inputs *in, input which, counted *to);
/* Sets the geometry, its terms and its table (owned from then on), and unsets its parameters. */
void inputs_geometry(inputs *in, const geometry *g, const fret_gap *sum, shared_table *table);

/* Is the gap a single power of r? */
static inline bool geometry_is_power(const geometry *g) {
    return g->kind == FRET_GAP_POWER;
}
/* Does a geometry take this parameter, and does the one in use take it now? */
static inline bool geometry_takes(const geometry *g, input which) {
    return (g->required | g->optional) & INPUT_BIT(which);
}
bool inputs_take(const inputs *in, input which);

/* The value, defaults and derived values included; ERROR_MISSING where there is none. */
bool inputs_get(const inputs *in, input which, long double *out, calc_error *error);

/* The material with exponent k (that of the inputs, or 0 for the homogeneous twin), and the gap. */
bool inputs_material(const inputs *in, double k, fret_material *out, calc_error *error);
bool inputs_gap(const inputs *in, fret_gap *out, calc_error *error);

/* Makes a shared table, which owns `table`; NULL: out of memory, and `table` is freed. */
shared_table *shared_table_make(struct fret_table *table, const char *name, smoothing how);

#endif
