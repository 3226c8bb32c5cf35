/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fret/springs.h"

#include <float.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "gap.h"
#include "special.h"

/* No trap is ever set here; gcc needs to be told before it turns choices into vector code. */
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC optimize("no-trapping-math")
#endif

/* Springs are handled LANES at a time in loops of fixed length, which compilers turn into vector code
 * without licence to reorder sums; double sums of STRIDE springs go into the total. */
enum { LANES = 8, STRIDE = 256 };

struct fret_springs {
    fret_normal normal;
    double mu, mu_eta;
    double radius, cell; /* width of a cell [m] */
    fret_real end_dz, end_FN;
    size_t count, padded; /* springs, and up to a multiple of LANES */
    double *g, *w, *u;    /* depth of touch, normal stiffness, displacement */
    fret_real *w_sum;     /* [i]: stiffness of springs 0..i-1 */
    fret_real *touch;     /* [i]: F_N where spring i touches */
    fret_real dz, FN, dx, Fx;
    int direction; /* of the last tangential motion */
    fret_sum W;
};

static double least(double a, double b) {
    return a < b ? a : b;
}

static double most(double a, double b) {
    return a > b ? a : b;
}

static fret_real depth_at(const fret_normal *n, fret_real x) {
    if (n->p > 0)
        return n->rule.kappa[0] * n->gap.power[0].h *
               fret_ratio_pow(x, n->gap.power[0].r0, n->gap.power[0].n);
    return x > fret_gap_start(&n->gap) ? fret_gap_profile(&n->gap, &n->rule, x - fret_gap_start(&n->gap)).g
                                       : 0;
}

static bool allocate(fret_springs *s, size_t count) {
    if (count > SIZE_MAX / (4 * sizeof(fret_real)) - LANES)
        return false;
    s->count = count;
    s->padded = (count + LANES - 1) / LANES * LANES;
    s->g = malloc(3 * s->padded * sizeof *s->g);
    s->w_sum = malloc((2 * count + 1) * sizeof *s->w_sum);
    if (!s->g || !s->w_sum) {
        free(s->g);
        free(s->w_sum);
        return false;
    }
    s->w = s->g + s->padded;
    s->u = s->w + s->padded;
    s->touch = s->w_sum + count + 1;
    return true;
}

/* int of x^k over cell i of width 1: x+^(k+1)-x-^(k+1) without the cancellation at large i. */
static fret_real cell_weight(size_t i, fret_real k) {
    fret_real outer = (fret_real)i + 1, k1 = 1 + k;
    return fret_pow(outer, k1) * -fret_expm1(k1 * fret_log1p(-1 / outer)) / k1;
}

static void fill(fret_springs *s, fret_weight rule) {
    const fret_foundation *f = &s->normal.foundation;
    fret_real h = (fret_real)s->radius / (fret_real)s->count;
    fret_real scale = 2 * f->cN0 * h * fret_pow(h / f->c0, f->k), stiffness = 0, force = 0, last = 0;
    for (size_t i = 0; i < s->count; i++) {
        fret_real mid = (fret_real)i + 0.5L;
        s->w[i] = (double)(scale * (rule == FRET_WEIGHT_CELL ? cell_weight(i, f->k) : fret_pow(mid, f->k)));
        /* rounding must not undo the order of touch */
        s->g[i] = most((double)depth_at(&s->normal, mid * h), (double)last);
        force += stiffness * (s->g[i] - last);
        last = s->g[i];
        s->touch[i] = force;
        s->w_sum[i] = stiffness;
        stiffness += s->w[i];
    }
    s->w_sum[s->count] = stiffness;
    for (size_t i = s->count; i < s->padded; i++) { /* never touched */
        s->w[i] = 0;
        s->g[i] = DBL_MAX;
    }
}

fret_status fret_springs_make(const fret_normal *normal, double mu, size_t count, double radius,
                              fret_weight rule, fret_springs **out) {
    fret_press end;
    fret_status st = fret_check_positive("mu", mu);
    if (!st.code && count == 0)
        st = fret_fail(FRET_NOT_POSITIVE, "count", 0, 0);
    if (!st.code)
        st = fret_check_positive("radius", radius);
    if (!st.code && rule != FRET_WEIGHT_CELL && rule != FRET_WEIGHT_MIDPOINT)
        st = fret_fail(FRET_OUTSIDE, "rule", (double)rule, FRET_WEIGHT_MIDPOINT);
    if (!st.code)
        st = fret_press_radius(normal, radius, &end);
    if (st.code)
        return st;
    fret_springs *s = calloc(1, sizeof *s);
    if (!s || !allocate(s, count)) {
        free(s);
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    }
    s->normal = *normal;
    s->mu = mu;
    s->mu_eta = (double)(mu * normal->foundation.eta);
    s->radius = radius;
    s->cell = radius / (double)count;
    s->end_dz = end.dz;
    s->end_FN = end.F;
    fill(s, rule);
    fret_springs_reset(s);
    *out = s;
    return fret_ok();
}

void fret_springs_free(fret_springs *s) {
    if (s) {
        free(s->g);
        free(s->w_sum);
    }
    free(s);
}

void fret_springs_reset(fret_springs *s) {
    for (size_t i = 0; i < s->padded; i++)
        s->u[i] = 0;
    s->dz = s->FN = s->dx = s->Fx = 0;
    s->direction = 1;
    s->W = (fret_sum){0, 0};
}

fret_status fret_springs_copy(fret_springs *to, const fret_springs *from) {
    if (to == from)
        return fret_ok();
    fret_springs made = *from;
    if (to->count == from->count) {
        made.g = to->g;
        made.w = to->w;
        made.u = to->u;
        made.w_sum = to->w_sum;
        made.touch = to->touch;
    } else {
        if (!allocate(&made, from->count))
            return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
        free(to->g);
        free(to->w_sum);
    }
    *to = made;
    memcpy(to->g, from->g, 3 * from->padded * sizeof *to->g);
    memcpy(to->w_sum, from->w_sum, (2 * from->count + 1) * sizeof *to->w_sum);
    return fret_ok();
}

/* Springs whose key lies below the value: keys are in order. */
static size_t springs_below(const double *g, size_t count, double dz) {
    size_t lo = 0, hi = count;
    while (lo < hi) {
        size_t mid = lo + (hi - lo) / 2;
        if (g[mid] < dz)
            lo = mid + 1;
        else
            hi = mid;
    }
    return lo;
}

/* The normal law of the cells, piecewise linear, and its inverse: sums of positive terms. */
static fret_real force_of_depth(const fret_springs *s, fret_real dz) {
    size_t i = springs_below(s->g, s->count, (double)dz);
    return i ? s->touch[i - 1] + s->w_sum[i] * (dz - s->g[i - 1]) : 0;
}

static fret_real depth_of_force(const fret_springs *s, fret_real FN) {
    size_t lo = 0, hi = s->count;
    if (FN <= 0)
        return 0;
    while (lo < hi) {
        size_t mid = lo + (hi - lo) / 2;
        if (s->touch[mid] < FN)
            lo = mid + 1;
        else
            hi = mid;
    }
    return s->g[lo - 1] + (FN - s->touch[lo - 1]) / s->w_sum[lo];
}

/* What a straight step does: sums of w u, of w over springs that stick, of w times bound times slip. */
typedef struct response {
    fret_real force, stick, loss;
} response;

/* A step straight in (delta_z, delta_x), z0 -> z1 and by ddx, for springs below the larger depth. On a
 * straight path a spring that has begun to slip goes on to the end, so the bound at both ends decides.
 * touched: the part of the step during which a spring is in contact. keep: stores the new u. */
static response deform(fret_springs *s, double z0, double z1, double ddx, bool keep) {
    const double hi = most(z0, z1), span = hi - least(z0, z1),
                 inverse = span > 0 ? 1 / span : (double)INFINITY;
    const double m = s->mu_eta;
    const size_t end = (springs_below(s->g, s->count, hi) + LANES - 1) / LANES * LANES;
    response out = {0, 0, 0};
    for (size_t from = 0; from < end; from += STRIDE) {
        double force[LANES] = {0}, stick[LANES] = {0}, loss[LANES] = {0};
        const size_t to = end - from > STRIDE ? from + STRIDE : end;
        for (size_t i = from; i < to; i += LANES) {
            const double *restrict g = s->g + i, *restrict w = s->w + i;
            double *restrict u = s->u + i;
            double moved[LANES];
            for (int l = 0; l < LANES; l++) {
                double b0 = most(m * (z0 - g[l]), 0), b1 = most(m * (z1 - g[l]), 0);
                double touched = most(least((hi - g[l]) * inverse, 1), 0);
                double trial = u[l] + touched * ddx;
                double v = most(least(trial, b1), -b1), excess = trial - v;
                double yields = w[l] * touched; /* outside the choice: no branch */
                double slip = fabs(excess), along = excess < 0 ? -ddx : ddx;
                /* slip at a steady rate since its onset, while the bound went linearly to b1 */
                double whole = most(most(touched * along + (b0 - b1), slip), DBL_MIN);
                double bound = b1 + 0.5 * (b0 - b1) * (slip / whole);
                force[l] += w[l] * v;
                stick[l] += slip > 0 ? 0 : yields;
                loss[l] += w[l] * bound * slip;
                moved[l] = v;
            }
            if (keep)
                memcpy(u, moved, sizeof moved);
        }
        for (int l = 0; l < LANES; l++) {
            out.force += force[l];
            out.stick += stick[l];
            out.loss += loss[l];
        }
    }
    return out;
}

static void advance(fret_springs *s, fret_real dz, fret_real dx) {
    const fret_real eta = s->normal.foundation.eta;
    response r = deform(s, (double)s->dz, (double)dz, (double)(dx - s->dx), true);
    s->Fx = r.force / eta;
    fret_sum_add(&s->W, r.loss / eta);
    s->dz = dz;
    s->dx = dx;
}

/* The displacement nearest to the present one that makes F_x: Newton on a monotone piecewise linear
 * function, kept in a bracket that is wide enough for every spring to slip either way. */
static fret_real displacement_for(fret_springs *s, fret_real dz, fret_real Fx, fret_real tolerance) {
    const fret_real eta = s->normal.foundation.eta, reach = 2.0L * s->mu_eta * fmaxl(s->dz, dz);
    fret_real lo = -reach, hi = reach, x = 0;
    for (int i = 0; i < 200 && hi - lo > 4 * DBL_EPSILON * fabsl(x); i++) {
        response r = deform(s, (double)s->dz, (double)dz, (double)x, false);
        fret_real missing = Fx - r.force / eta;
        if (fabsl(missing) <= tolerance)
            break;
        if (missing > 0)
            lo = x;
        else
            hi = x;
        x += r.stick > 0 ? missing * eta / r.stick : 0;
        if (!(x > lo && x < hi) || i >= 50) /* Newton may cycle between two pieces */
            x = (lo + hi) / 2;
    }
    return s->dx + x;
}

static void walk_forces(fret_springs *s, fret_real FN, fret_real dz, fret_real Fx, unsigned substeps) {
    const fret_real FN0 = s->FN, Fx0 = s->Fx;
    s->dz = fmaxl(s->dz, 0); /* an open contact closes without load */
    for (unsigned j = 1; j <= substeps; j++) {
        fret_real t = (fret_real)j / substeps, rest = (fret_real)(substeps - j) / substeps;
        fret_real load = FN0 * rest + FN * t, depth = j == substeps ? fmaxl(dz, 0) : depth_of_force(s, load);
        if (FN == FN0)
            depth = s->dz; /* rounding must not make it breathe */
        fret_real limit = s->mu * load, force = fminl(fmaxl(Fx0 * rest + Fx * t, -limit), limit);
        advance(s, depth, displacement_for(s, depth, force, 1e-14L * limit));
    }
}

static void walk_displacements(fret_springs *s, fret_real dz, fret_real dx, unsigned substeps) {
    const fret_real dz0 = s->dz, dx0 = s->dx;
    for (unsigned j = 1; j <= substeps; j++) {
        fret_real t = (fret_real)j / substeps, rest = (fret_real)(substeps - j) / substeps;
        advance(s, dz == dz0 ? dz : dz0 * rest + dz * t, dx == dx0 ? dx : dx0 * rest + dx * t);
    }
}

fret_status fret_springs_step(fret_springs *s, const fret_step *step, unsigned substeps) {
    const fret_real slack = 1 + 1e-12L; /* radius was rounded */
    fret_real dz = s->dz, FN = s->FN, dx = s->dx;
    fret_status st = fret_ok();
    if (substeps == 0)
        return fret_fail(FRET_NOT_POSITIVE, "substeps", 0, 0);
    if (step->normal_by == FRET_TO_FORCE) {
        st = fret_check_not_negative("FN", step->normal);
        if (!st.code && step->normal > s->end_FN * slack)
            st = fret_fail(FRET_OUTSIDE, "FN", step->normal, (double)s->end_FN);
        if (!st.code && (step->normal != FN || dz < 0)) {
            FN = step->normal;
            dz = depth_of_force(s, FN);
        }
    } else if (step->normal_by == FRET_TO_DEPTH) {
        if (!isfinite(step->normal))
            st = fret_fail(FRET_NOT_FINITE, "dz", step->normal, 0);
        else if (step->normal > s->end_dz * slack)
            st = fret_fail(FRET_OUTSIDE, "dz", step->normal, (double)s->end_dz);
        if (!st.code && step->normal != dz) {
            dz = step->normal;
            FN = force_of_depth(s, dz);
        }
    }
    if (st.code)
        return st;
    const bool by_force = step->tangential_by == FRET_TO_FX;
    if (step->tangential_by != FRET_KEEP_DX && !isfinite(step->tangential))
        return fret_fail(FRET_NOT_FINITE, by_force ? "Fx" : "dx", step->tangential, 0);
    if (by_force && fabs(step->tangential) > s->mu * FN)
        return fret_fail(FRET_GROSS_SLIP, "Fx", step->tangential, (double)(s->mu * FN));
    if (step->tangential_by == FRET_TO_DX)
        dx = step->tangential;

    const fret_real before = by_force ? s->Fx : s->dx, after = by_force ? (fret_real)step->tangential : dx;
    if (after != before)
        s->direction = after < before ? -1 : 1;
    if (by_force)
        walk_forces(s, FN, dz, after, substeps);
    else
        walk_displacements(s, dz, dx, substeps);
    s->dz = dz;
    s->FN = FN;
    return fret_ok();
}

void fret_springs_state(const fret_springs *s, fret_state *out) {
    const fret_real eta = s->normal.foundation.eta;
    const double dz = (double)s->dz;
    const size_t closed = springs_below(s->g, s->count, dz);
    fret_real stored = 0, going = 0;
    size_t slipping = 0; /* outermost run of them */
    bool run = true;
    for (size_t i = closed; i-- > 0;) {
        double bound = s->mu_eta * (dz - s->g[i]), u = s->u[i];
        run = run && fabs(u) >= bound;
        slipping += run;
        stored += (fret_real)s->w[i] * u * u;
        going += s->direction * u >= bound ? 0 : s->w[i];
    }
    *out = (fret_state){
        .FN = s->FN,
        .dz = s->dz,
        .a = dz > 0 ? fret_law_radius(&s->normal, s->dz) : 0,
        .Fx = s->Fx,
        .dx = s->dx,
        .W = fret_sum_value(&s->W),
        .U = stored / (2 * eta),
        .kn = s->w_sum[closed],
        .kt = going / eta,
        .slices = closed,
    };
    out->c = slipping ? (fret_real)s->cell * (fret_real)(closed - slipping) : out->a;
}
