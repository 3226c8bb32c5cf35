/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inputs of a scene as a plain value: material, geometry, friction, and the amplitudes of the load that can
 * be changed afterwards. Knows ranges, no names; touches nothing else of a scene. */
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
    IN_G0, /* these three: in place of E0 or E0_2 */
    IN_G0_2,
    IN_ESTAR,
    IN_MU,
    IN_FN, /* these five: of the press, one of them is set */
    IN_DZ,
    IN_CONTACT,
    IN_P0,
    IN_PMEAN,
    IN_FA,  /* these five: of the last cycle */
    IN_DXA, /* one of FA, dxA and drigA is set */
    IN_DRIGA,
    IN_FNA,
    IN_PHASE,
    IN_NW,    /* cycles of wear, of the last cycle too */
    IN_K_RIG, /* these three: of the rig */
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

/* The inputs as a set, for tables that say what depends on what. */
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
#define INPUT_STRESS (INPUT_BIT(IN_YIELD) | INPUT_BIT(IN_YIELD_2) | INPUT_BIT(IN_SB)) /* no contact's */

typedef struct inputs inputs;

/* One row a geometry: its name, the kind of gap it makes and the parameters it takes. */
typedef struct geometry {
    const char *name;
    fret_gap_kind kind;
    double n; /* exponent of a power whose name fixes it, else 0 */
    input_set required, optional;
    const char *takes; /* behind its name, as rows of commands do */
    const char *meaning;
    const char *keywords; /* other words to find it by */
    const char *example;  /* of `help`: a transcript, indented by four */
} geometry;

const geometry *geometry_row(size_t i); /* NULL after the last */
const char *geometry_name(size_t i);    /* for suggest() */

typedef enum second_body { SECOND_SAME, SECOND_RIGID, SECOND_GIVEN } second_body;

enum { CHOSEN = 256 };

/* How the rows of a file become a gap. */
typedef struct smoothing {
    enum { SMOOTH_NOT, SMOOTH_FREELY, SMOOTH_PIECES, SMOOTH_WITHIN } by;
    size_t pieces;
    double within;        /* rms [m] */
    bool height;          /* the rows are heights: f = -z */
    char columns[CHOSEN]; /* as they were chosen, ` using ...`; empty: by name */
} smoothing;

/* A gap table: scenes share it, and an old one can come back. */
typedef struct shared_table {
    counted base;
    struct fret_table *table;
    smoothing smoothing;
    char name[]; /* of its file */
} shared_table;

struct inputs {
    double v[INPUTS];
    bool set[INPUTS];
    counted *bound[INPUTS]; /* NAME := EXPR, a definition (names.h): v follows it */
    input_set bindings;     /* which are bound */
    second_body second;
    const geometry *geometry;
    double radii[2];     /* R1 and R2 [m], of which R has been made; 0: R was given */
    fret_gap sum;        /* terms of `geometry sum` */
    shared_table *table; /* of `geometry file` */
};

/* A second copy; both are to be dropped. */
void inputs_copy(inputs *to, const inputs *from);
void inputs_drop(inputs *in);

/* Are these inputs the same, the bodies and the shape, and no definitions among them? */
bool inputs_same(const inputs *a, const inputs *b, input_set which);

/* Between what an input lies, whatever the rest; may be infinite. Of these ends only nu = 1/2, and 0 of mu,
 * FNA and Nw belong. */
void input_range(input in, double *lo, double *hi);
/* Is the value in the range of the input, whatever the rest? */
fret_status input_status(input in, double v);
bool input_check(input in, double v, calc_error *error);

/* Is one of them set? */
bool inputs_any(const inputs *in, input_set set);
/* Is Poisson's ratio given? Where Estar stands alone pressing needs none. */
bool inputs_know_nu(const inputs *in);

/* Puts a value in and unsets what it replaces: A and h, r0; another modulus; a second body that was the same.
 * Unbinds. */
void inputs_put(inputs *in, input which, double v);
void inputs_unset(inputs *in, input_set set);
/* Ends a binding, the value stays; takes over `to` (NULL: none). */
void inputs_bind(inputs *in, input which, counted *to);
/* Geometry and its parameters, table and terms as given. Takes over the table. */
void inputs_geometry(inputs *in, const geometry *g, const fret_gap *sum, shared_table *table);

/* Is it one power of r? */
static inline bool geometry_is_power(const geometry *g) {
    return g->kind == FRET_GAP_POWER;
}
/* Does it take this parameter, and does the one in use, as things are? */
static inline bool geometry_takes(const geometry *g, input which) {
    return (g->required | g->optional) & INPUT_BIT(which);
}
bool inputs_take(const inputs *in, input which);

/* The value, defaults included; ERROR_MISSING where there is none. */
bool inputs_get(const inputs *in, input which, long double *out, calc_error *error);

/* Material with exponent k (that of the inputs, or 0 for the homogeneous twin) and c0; gap. */
bool inputs_material(const inputs *in, double k, fret_material *out, calc_error *error);
bool inputs_gap(const inputs *in, fret_gap *out, calc_error *error);

/* Takes over the table; NULL: out of memory, the table is freed. */
shared_table *shared_table_make(struct fret_table *table, const char *name, smoothing how);

#endif
