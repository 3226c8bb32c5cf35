/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stands in for fret/batch.h: the same functions, one value after the other. */
#ifndef CALC_BATCH_H
#define CALC_BATCH_H

#include "fret/fret.h"

static inline fret_status fret_batch_loss(const fret_normal *normal, double mu, const fret_press *press,
                                          const double FA[], double loss[], size_t count) {
    fret_status st = {FRET_OK, NULL, 0, 0};
    for (size_t i = 0; i < count && !st.code; i++) {
        fret_real v = 0;
        st = fret_cycle_loss(normal, mu, press, FA[i], &v);
        loss[i] = (double)v;
    }
    return st;
}

static inline fret_status fret_batch_loading(const fret_normal *normal, double mu, const fret_press *press,
                                             const double Fx[], double c[], double dx[], size_t count) {
    fret_status st = {FRET_OK, NULL, 0, 0};
    for (size_t i = 0; i < count && !st.code; i++) {
        fret_loading v = {0};
        st = fret_loading_force(normal, mu, press, Fx[i], &v);
        if (c)
            c[i] = (double)v.c;
        if (dx)
            dx[i] = (double)v.dx;
    }
    return st;
}

static inline fret_status fret_batch_press(const fret_normal *normal, const double F[], double a[],
                                           double dz[], size_t count) {
    fret_status st = {FRET_OK, NULL, 0, 0};
    for (size_t i = 0; i < count && !st.code; i++) {
        fret_press v = {0};
        st = fret_press_force(normal, F[i], &v);
        if (a)
            a[i] = (double)v.a;
        if (dz)
            dz[i] = (double)v.dz;
    }
    return st;
}

#endif
