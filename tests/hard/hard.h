/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The hard cases: scenes from the whole domain, judged in units in the last place against the oracle. */
#ifndef HARD_H
#define HARD_H

#include <stdint.h>

#include "fret/fret.h"
#include "oracle.h"

/* What a result rounded to double may be away from the exact one: the promise of fret/status.h. */
#define HARD_ULPS 1.0

/* X(name, heading, what). A scene is in every region that it touches. */
#define HARD_REGIONS(X)                                                                                      \
    X(ALL, "all", "every scene")                                                                             \
    X(INSIDE, "inside", "none of the edges below")                                                           \
    X(K_LOW, "k>-1", "1+k < 1e-3")                                                                           \
    X(K_HIGH, "k>1", "1-k < 1e-3")                                                                           \
    X(NU_LOW, "nu>-1", "1+nu < 1e-3, either body")                                                           \
    X(NU_HIGH, "nu>.5", "1-2nu < 1e-3, either body; nu = 1/2")                                               \
    X(K_NU_HIGH, "k,nu", "k > 1 and nu > 1/2 both")                                                          \
    X(N_LOW, "n>0", "n < 1e-3")                                                                              \
    X(N_HIGH, "n>inf", "n > 1e3")                                                                            \
    X(S_LOW, "n+k+1", "n > 0 and k > -1 both")                                                               \
    X(T_LOW, "t>0", "t < 1e-6 (by displacement: dx/dxmax)")                                                  \
    X(T_HIGH, "t>1", "1-t < 1e-6, not beyond")                                                               \
    X(SLIDES, "slides", "dx > dxmax")                                                                        \
    X(BRINK, "brink", "abs(1-dx/dxmax) < 1e-9: shown here alone and not judged, beyond the promise")         \
    X(SMALL, "small", "a length below 1e-9 m")                                                               \
    X(LARGE, "large", "a length above 1e3 m")                                                                \
    X(TWO, "two", "two different elastic bodies")

typedef enum hard_region {
#define X(name, heading, what) HARD_##name,
    HARD_REGIONS(X)
#undef X
        HARD_REGION_COUNT
} hard_region;

typedef struct hard_worst {
    double ulps;
    unsigned long index; /* of the scene */
    bool seen;           /* false: no scene was there */
} hard_worst;

typedef struct hard_tally {
    unsigned long passed, failed, seen;
    unsigned long scenes[HARD_REGION_COUNT];
    hard_worst worst[ORACLE_COUNT][HARD_REGION_COUNT];
} hard_tally;

/* All inputs of one scene, exact doubles. */
typedef struct hard_scene {
    oracle_contact contact;
    double mu, F, Fx, dz, a, dx;
} hard_scene;

/* The library's arguments. */
void hard_contact(const oracle_contact *contact, fret_material *material, fret_gap *gap);

/* splitmix64: the same numbers everywhere; no libm, which differs from place to place. */
typedef struct hard_random {
    uint64_t state;
} hard_random;

hard_random hard_seed(uint64_t seed);
double hard_uniform(hard_random *r);                    /* [0, 1) */
double hard_scale(hard_random *r, int least, int most); /* 2^least .. 2^most, all scales alike */
unsigned hard_choice(hard_random *r, unsigned count);

/* A case of the tests has been judged; its line is printed at the end. */
void hard_case(const char *kind, const char *name, unsigned long passed, unsigned long failed);

/* Histories: closed loops must come back to the same state, and W must be the sum of the loops. `steps`:
 * length of the longest. Prints its own table; a row is a case. */
void hard_histories(unsigned long steps);

/* The memory diagram in double against the exact one, to what fret/diagram.h promises. Likewise. */
void hard_diagrams(unsigned long steps);

#endif
