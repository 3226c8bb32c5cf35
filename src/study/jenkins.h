/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The contact as parallel Jenkins elements, each a spring k in series with a slider of slip force s, for use
 * in a dynamics code. Depends on fret/fret.h and number, not on GSL. */
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
    double worst; /* largest |error| of the loss per cycle [J] for amplitudes up to `most` */
    double scale; /* the loss [J] at `most` */
    double most;  /* displacement amplitude [m] up to which the elements are fitted: gross slip, beyond which
                     the  error stays constant, or the given amplitude */
} jenkins_error;

/* Finds `count` elements in the order of slipping. Their loading curve is sum min(k d, s), their loss per
 * cycle sum 4 s max(d - s/k, 0), piecewise linear in the amplitude d. It is the minimax approximation with
 * `count` kinks: the error is +worst at the kinks and -worst between them, and falls as 1/count^2. The slip
 * forces add up to mu F_N. amplitude: the largest displacement amplitude [m]; infinite or beyond gross slip:
 * all. Below gross slip the last element is the part that sticks: it makes F_x at the amplitude exact and
 * gives no kink, so that count > 1. pulse: called from time to time. Errors: of the loss; load too small;
 * interrupted. */
bool jenkins(const fret_pressed *contact, double amplitude, size_t count, const volatile sig_atomic_t *stop,
             void (*pulse)(void), jenkins_element *out, jenkins_error *quality, calc_error *error);

#endif
