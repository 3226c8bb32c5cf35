/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Minimax approximation of the loss by a piecewise linear one. Depends on fret/fret.h and number. */
#include "study/jenkins.h"

#include <float.h>
#include <math.h>

#include "number/root.h"

/* The loss f(d) is convex. From a kink (d_i, f-e) the steepest line that stays below f+e is tangent to f+e;
 * the next kink is where it meets f-e again. Bisection finds the least e for which `count` kinks suffice. */
/* Relative tolerance of the least error; the error that is stated is a bound all the same. */
#define ENOUGH 1e-4
/* Below this part of gross slip the slope of the loss is rounding. */
#define TOO_SMALL 1e-10

typedef struct march {
    const fret_pressed *contact;
    double end; /* largest amplitude that is fitted */
    bool all;   /* `end` is gross slip */
    double e;
    double d, p;  /* latest kink: amplitude and loss */
    double slope; /* of the line from that kink */
    fret_status failed;
    const volatile sig_atomic_t *stop;
    void (*pulse)(void);
} march;

static bool march_stopped(const march *m) {
    return *m->stop;
}

static void note(march *m, fret_status st) {
    if (st.code)
        m->failed = st;
}

static double loss(march *m, double d) {
    fret_real out = 0;
    note(m, fret_cycle_loss_by_displacement(m->contact, d, &out));
    return (double)out;
}

/* f' = 4 (F_x - d dF_x/d delta_x) on the loading curve; taken just below gross slip, where f' may jump. */
static double loss_slope(march *m, double d) {
    fret_loading first = {.Fx = 0};
    d = fmin(d, (double)fret_gross_slip(m->contact) * (1 - 4 * DBL_EPSILON));
    const fret_normal *normal = m->contact->normal;
    note(m, fret_loading_by_displacement(m->contact, d, &first));
    const fret_real stiffness = fret_normal_stiffness(normal, first.c) / fret_normal_foundation(normal)->eta;
    return (double)(4 * (first.Fx - d * stiffness));
}

/* ---- increasing functions of the amplitude, whose zeros are sought -------------------------------- */

static double first_kink(double d, void *context) {
    march *m = context;
    return loss(m, d) - m->e;
}

/* 0 where the line from the kink to f+e at d is tangent there. */
static double tangent(double d, void *context) {
    march *m = context;
    return loss_slope(m, d) * (d - m->d) - (loss(m, d) + m->e - m->p);
}

static double next_kink(double d, void *context) {
    march *m = context;
    return loss(m, d) - m->e - (m->p + m->slope * (d - m->d));
}

/* ---- marching ---------------------------------------------------------------------------------- */

/* Sets m->slope to the tangent from the latest kink; false: m->end comes before it touches. */
static bool touch(march *m, double *at) {
    if (tangent(m->end, m) < 0) {
        *at = m->end;
        m->slope = (loss(m, m->end) + m->e - m->p) / (m->end - m->d);
        return false;
    }
    *at = fret_root_double(tangent, m, m->d, m->end);
    m->slope = loss_slope(m, *at);
    return true;
}

static double sliding_slope(const march *m) {
    return 4 * m->contact->mu * (double)m->contact->press.F;
}

/* Does a line with the slope of gross slip, from the latest kink, stay below f+e at the end? */
static bool slides(march *m) {
    return sliding_slope(m) * (m->end - m->d) <= loss(m, m->end) + m->e - m->p;
}

/* The amplitude where the line that touches at `at` meets f-e again; beyond gross slip f is straight. */
static double kink_after(march *m, double at) {
    const double short_of = -next_kink(m->end, m);
    return short_of > 0 ? m->end + short_of / (sliding_slope(m) - m->slope)
                        : fret_root_double(next_kink, m, at, m->end);
}

/* Do `count` kinks suffice for m->e? Writes the elements unless out is NULL. */
static bool suffices(march *m, size_t count, jenkins_element *out) {
    double slope = 0;
    m->d = fret_root_double(first_kink, m, 0, m->end);
    for (size_t i = 0;; i++) {
        m->pulse();
        const bool last = i + 1 == count;
        double at = m->end;
        bool done;
        m->p = i ? loss(m, m->d) - m->e : 0;
        if (m->all && (last || slides(m))) {
            done = slides(m);
            m->slope = sliding_slope(m);
        } else {
            const bool touches = touch(m, &at);
            done = !m->all && (!touches || next_kink(m->end, m) <= 0);
        }
        if (out) {
            out[i].s = (m->slope - slope) / 4;
            out[i].k = out[i].s / m->d;
        }
        if (done || last || march_stopped(m))
            return done;
        slope = m->slope;
        m->d = kink_after(m, at);
    }
}

/* The part that sticks up to the amplitude: a spring that loses nothing and makes F_x there exact. */
static jenkins_element stuck(march *m, const jenkins_element *slipping, size_t count) {
    fret_loading first = {.Fx = 0};
    double slip = 0;
    for (size_t i = 0; i < count; i++)
        slip += slipping[i].s;
    note(m, fret_loading_by_displacement(m->contact, m->end, &first));
    return (jenkins_element){.k = ((double)first.Fx - slip) / m->end, .s = sliding_slope(m) / 4 - slip};
}

bool jenkins(const fret_pressed *contact, double amplitude, size_t count, const volatile sig_atomic_t *stop,
             void (*pulse)(void), jenkins_element *out, jenkins_error *quality, calc_error *error) {
    const double slip = (double)fret_gross_slip(contact);
    march m = {.contact = contact, .stop = stop, .pulse = pulse, .all = !(amplitude < slip)};
    m.end = m.all ? slip : amplitude;
    const size_t slipping = m.all ? count : count - 1;
    const double scale = loss(&m, m.end);
    double lo = 0, hi = scale;
    if (!(scale <= DBL_MAX))
        note(&m, (fret_status){FRET_OVERFLOW, NULL, 0, 0});
    if (m.failed.code || !(m.end > TOO_SMALL * slip) || scale < DBL_MIN)
        return calc_status(error, m.failed) &&
               calc_fail(error, 0, 0, "the load is too small: its slip is lost in rounding");
    while (!m.failed.code && !march_stopped(&m) && hi - lo > ENOUGH * hi) {
        m.e = lo > 0 ? sqrt(lo) * sqrt(hi) : hi / 16;
        if (suffices(&m, slipping, NULL))
            hi = m.e;
        else
            lo = m.e;
    }
    if (march_stopped(&m))
        return calc_interrupted(error);
    for (size_t i = 0; i < count; i++)
        out[i] = (jenkins_element){0, 0};
    m.e = hi;
    suffices(&m, slipping, out);
    if (!m.all)
        out[slipping] = stuck(&m, out, slipping);
    *quality = (jenkins_error){.worst = hi, .scale = scale, .most = m.end};
    return calc_status(error, m.failed);
}
