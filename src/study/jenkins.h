/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The contact as parallel Jenkins elements, each a spring k in line with a slider of the force s: what a
 * dynamics code steps. Knows no text and needs no GSL. */
#ifndef STUDY_JENKINS_H
#define STUDY_JENKINS_H

#include <signal.h>

#include "fret/fret.h"
#include "text/error.h"

typedef struct jenkins_element {
    double k; /* stiffness [N/m] */
    double s; /* slip force [N] */
} jenkins_element;

typedef struct jenkins_error {
    double worst; /* |error| of the loss per cycle [J], over all amplitudes up to `reach` */
    double scale; /* the loss [J] at `most` */
    double most;  /* displacement amplitude [m] up to which it is fitted: gross slip, beyond which the error
                     stays, or what was asked for */
} jenkins_error;

/* First loading of the elements is sum min(k d, s), their loss sum 4 s max(d - s/k, 0): piecewise linear in
 * d. It is the one of `count` kinks with the least worst error: the error is +worst at the kinks and -worst
 * between them. Its order in 1/count is 2. The slip forces add up to mu F_N. In the order of slipping.
 * amplitude: the largest displacement amplitude [m]; infinite, or beyond gross slip: all. Short of gross slip
 * the last element stands for what still sticks there (F_x at the amplitude is exact) and makes no kink:
 * count > 1. pulse: called at times. Errors: what the loss says; stopped. */
bool jenkins(const fret_pressed *contact, double amplitude, size_t count, const volatile sig_atomic_t *stop,
             void (*pulse)(void), jenkins_element *out, jenkins_error *quality, calc_error *error);

#endif
