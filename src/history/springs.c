/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The foundation cut into springs, in double: one loop moves them; for an imposed force one pass from the
 * edge inwards finds the displacement. Of the normal law uses radius and profile alone. Allocates. */
#include "fret/springs.h"

#include <float.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "law/check.h"
#include "law/normal.h"
#include "number/real.h"
#include "number/sum.h"

/* Forces are accurate to this part of mu F_N, which is also the rounding of mu F_N. */
#define ROUNDING 1e-14L
/* A spring counts as slipping if this part of mu F_N more would make it slip, whatever the rounding. */
#define SLIPS 1e-12L

struct fret_springs {
    const fret_normal *normal; /* borrowed */
    double mu, mu_eta;
    fret_real eta, cell; /* width of a cell [m] */
    fret_real end_dz, end_FN;
    size_t count, closed; /* springs, and how many of them, the first ones, are in contact */
    double *g, *w, *u;    /* depth at touch, normal stiffness, displacement */
    fret_real *held;      /* [i]: stiffness of springs 0..i-1 */
    fret_real *touch;     /* [i]: F_N where spring i touches */
    fret_real dz, FN, dx, Fx;
    fret_real goal; /* F_x as imposed, or as it follows from a displacement */
    int direction;  /* of the last tangential motion */
    bool by_depth;  /* F_N follows from an imposed depth */
    fret_sum W;
};

static bool allocate(fret_springs *s, size_t count) {
    if (count > SIZE_MAX / (3 * sizeof(fret_real)))
        return false;
    s->count = count;
    s->g = calloc(3 * count, sizeof *s->g);
    s->held = malloc((2 * count + 1) * sizeof *s->held);
    s->w = s->g ? s->g + count : NULL;
    s->u = s->g ? s->w + count : NULL;
    s->touch = s->held ? s->held + count + 1 : NULL;
    return s->g && s->held;
}

/* int x^k dx over cell i of width 1, (x+^(k+1)-x-^(k+1))/(k+1), without cancellation at large i. */
static fret_real cell_weight(size_t i, fret_real k) {
    const fret_real outer = (fret_real)i + 1, k1 = 1 + k;
    return fret_pow(outer, k1) * -expm1l(k1 * log1pl(-1 / outer)) / k1;
}

/* Computes g, w and the sums; may end early if stopped. */
static void fill(fret_springs *s, fret_weight rule) {
    enum { SPAN = 64 }; /* springs between looks at the stop flag */
    const fret_foundation *f = fret_normal_foundation(s->normal);
    const fret_real scale = 2 * f->cN0 * s->cell * fret_pow(s->cell / f->c0, f->k);
    fret_real stiffness = 0, force = 0;
    for (size_t i = 0; i < s->count && (i % SPAN || !fret_stopped(s->normal)); i++) {
        const fret_real mid = (fret_real)i + 0.5L, last = i ? s->g[i - 1] : 0;
        s->w[i] = (double)(scale * (rule == FRET_WEIGHT_CELL ? cell_weight(i, f->k) : fret_pow(mid, f->k)));
        /* rounding must not undo the order of touch */
        s->g[i] = (double)fmaxl(fret_normal_profile(s->normal, mid * s->cell), last);
        force += stiffness * (s->g[i] - last);
        s->touch[i] = force;
        s->held[i] = stiffness;
        stiffness += s->w[i];
    }
    s->held[s->count] = stiffness;
}

/* The normal contact of the largest radius; for a flat punch, any load. */
static fret_status press_of(const fret_normal *normal, double radius, fret_press *out) {
    if (!fret_normal_punch(normal) || radius != normal->end)
        return fret_press_by_radius(normal, radius, out);
    *out = (fret_press){.F = INFINITY, .dz = INFINITY, .a = radius};
    return fret_ok();
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
        st = press_of(normal, radius, &end);
    if (st.code)
        return st;
    fret_springs *s = calloc(1, sizeof *s);
    if (!s || !allocate(s, count)) {
        fret_springs_free(s);
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    }
    s->normal = normal;
    s->mu = mu;
    s->eta = fret_normal_foundation(normal)->eta;
    s->mu_eta = (double)(mu * s->eta);
    s->cell = (fret_real)radius / (fret_real)count;
    s->end_dz = end.dz;
    s->end_FN = end.F;
    s->direction = 1;
    fill(s, rule);
    if (fret_stopped(normal)) {
        fret_springs_free(s);
        return fret_unless_stopped(normal, fret_ok());
    }
    *out = s;
    return fret_ok();
}

fret_status fret_springs_clone(const fret_springs *from, fret_springs **out) {
    fret_springs *s = malloc(sizeof *s);
    if (s) {
        *s = *from;
        if (allocate(s, from->count)) {
            memcpy(s->g, from->g, 3 * s->count * sizeof *s->g);
            memcpy(s->held, from->held, (2 * s->count + 1) * sizeof *s->held);
            *out = s;
            return fret_ok();
        }
        fret_springs_free(s);
    }
    return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
}

void fret_springs_free(fret_springs *s) {
    if (s) {
        free(s->g);
        free(s->held);
    }
    free(s);
}

/* ---- the normal law of the cells, piecewise linear --------------------------------------------- */

static double larger(double a, double b) {
    return a > b ? a : b;
}

static size_t springs_below(const fret_springs *s, double dz) {
    size_t lo = 0, hi = s->count;
    while (lo < hi) {
        const size_t mid = lo + (hi - lo) / 2;
        if (s->g[mid] < dz)
            lo = mid + 1;
        else
            hi = mid;
    }
    return lo;
}

/* Sum of w (z - g) over the springs before `end`, all in contact at depth z: positive terms alone. */
static fret_real load_inside(const fret_springs *s, size_t end, fret_real z) {
    return end ? s->touch[end - 1] + s->held[end] * (z - s->g[end - 1]) : 0;
}

static fret_real force_of_depth(const fret_springs *s, fret_real dz) {
    return load_inside(s, springs_below(s, (double)dz), dz);
}

static fret_real depth_of_force(const fret_springs *s, fret_real FN) {
    size_t lo = 0, hi = s->count;
    if (FN <= 0)
        return 0;
    while (lo < hi) {
        const size_t mid = lo + (hi - lo) / 2;
        if (s->touch[mid] < FN)
            lo = mid + 1;
        else
            hi = mid;
    }
    return s->g[lo - 1] + (FN - s->touch[lo - 1]) / s->held[lo];
}

/* ---- steps ------------------------------------------------------------------------------------- */

/* Moves all springs along a straight path in (delta_z, delta_x), each for the part of it during which it is
 * in contact. On a straight path a spring that has begun to slip slips to the end: the bounds at the ends
 * decide. It slips at a constant rate from its onset, while the bound changes linearly. */
static void advance(fret_springs *s, fret_real dz, fret_real dx) {
    const double z0 = (double)s->dz, z1 = (double)dz, ddx = (double)(dx - s->dx), deepest = larger(z0, z1),
                 inverse = z0 == z1 ? DBL_MAX : 1 / fabs(z1 - z0);
    const size_t below = dz == s->dz ? s->closed : springs_below(s, z1), end = z1 > z0 ? below : s->closed;
    fret_sum force = {0, 0}, loss = {0, 0};
    for (size_t i = 0; i < end; i++) {
        const double g = s->g[i], w = s->w[i], b0 = larger(s->mu_eta * (z0 - g), 0),
                     b1 = larger(s->mu_eta * (z1 - g), 0), part = (deepest - g) * inverse,
                     moved = part < 1 ? part * ddx : ddx, trial = s->u[i] + moved,
                     least = trial < b1 ? trial : b1, v = larger(least, -b1), excess = trial - v;
        fret_sum_add(&force, w * v);
        s->u[i] = v;
        if (excess == 0)
            continue;
        const double slip = fabs(excess), along = excess < 0 ? -moved : moved,
                     whole = larger(along + (b0 - b1), slip);
        fret_sum_add(&loss, w * (b1 + (b0 - b1) / 2 * (slip / whole)) * slip);
    }
    s->Fx = fret_sum_value(&force) / s->eta;
    fret_sum_add(&s->W, fret_sum_value(&loss) / s->eta);
    s->closed = below;
    s->dz = dz;
    s->dx = dx;
}

/* The change of delta_x that leads to F_x at depth z, up to rounding. In no history is u steeper in g than
 * the bound, so springs begin to slip one after the other from the edge inwards, all in one direction: one
 * pass over those that slip finds the front. Sums are of w u. */
static fret_real displacement_of_front(const fret_springs *s, fret_real z, fret_real Fx) {
    const fret_real z0 = fmaxl(s->dz, 0), z1 = fmaxl(z, 0), deeper = fmaxl(z1 - z0, 0);
    size_t inside = s->closed;
    fret_real missing = (Fx - s->Fx) * s->eta, slipping = 0, left = 0; /* left: to the bound */
    for (; inside > 0 && !(s->g[inside - 1] < (double)z1); inside--)   /* parted */
        missing += (fret_real)s->w[inside - 1] * s->u[inside - 1];
    /* springs touched on the path add this stiffness, until they slip */
    const fret_real touching = deeper > 0 ? (load_inside(s, springs_below(s, (double)z1), z1) -
                                             load_inside(s, inside, z1)) /
                                                deeper
                                          : 0,
                    all = s->held[inside] + touching, x = all > 0 ? missing / all : 0;
    if (deeper > 0 && fabsl(x) <= s->mu_eta * deeper)
        return x;
    const fret_real load_path = deeper > 0 || inside == 0 ? x : s->u[inside - 1] + x,
                    sign = load_path < 0 ? -1 : 1, want = sign * missing;
    slipping = touching * (s->mu_eta * deeper);
    for (size_t i = inside; i-- > 0;) {
        const fret_real sticks = s->held[i + 1];
        left = s->mu_eta * (z1 - s->g[i]) - sign * s->u[i];
        if (slipping + sticks * left >= want)
            return sign * (want - slipping) / sticks;
        slipping += s->w[i] * left;
    }
    return sign * left;
}

/* Moves to a load, its depth and a force; a second pass corrects the rounding of many springs. */
static void follow(fret_springs *s, fret_real load, fret_real depth, fret_real force) {
    const fret_real limit = s->mu * load, to = fminl(fmaxl(force, -limit), limit);
    for (int pass = 0; pass < 2 && (pass == 0 || fabsl(to - s->Fx) > ROUNDING * limit); pass++)
        advance(s, depth, s->dx + displacement_of_front(s, depth, to));
}

/* The last part of an unloading to F_N = 0, where displacements follow a power of the load: in ever smaller
 * parts, down to a single spring, which parts when its force is 0. */
static void release(fret_springs *s, fret_real load, fret_real force, unsigned parts) {
    const fret_real least = load * 1e-20L;
    while (s->closed > 1 && load > least && !fret_stopped(s->normal)) {
        for (unsigned j = parts - 1; j >= 1; j--) {
            const fret_real t = (fret_real)j / parts;
            follow(s, load * t, depth_of_force(s, load * t), force * t);
        }
        load /= parts;
        force /= parts;
    }
    if (s->closed > 0)
        advance(s, s->g[0], s->dx - s->u[0]);
    advance(s, 0, s->dx);
}

static void step_by_force(fret_springs *s, fret_real FN, fret_real dz, fret_real Fx, unsigned substeps) {
    enum { FEWEST = 8 };
    const fret_real FN0 = s->FN, Fx0 = s->Fx;
    const bool opens = FN == 0 && FN0 > 0;
    s->dz = fmaxl(s->dz, 0); /* an open contact closes first */
    for (unsigned j = 1; j < substeps + !opens && !fret_stopped(s->normal); j++) {
        const fret_real t = (fret_real)j / substeps, rest = (fret_real)(substeps - j) / substeps,
                        load = FN0 * rest + FN * t;
        fret_real depth = j == substeps ? fmaxl(dz, 0) : depth_of_force(s, load);
        if (FN == FN0)
            depth = s->dz; /* else rounding would change the depth */
        follow(s, load, depth, Fx0 * rest + Fx * t);
    }
    if (opens)
        release(s, FN0 / substeps, Fx0 / substeps, substeps > FEWEST ? substeps : FEWEST);
}

static void step_by_displacement(fret_springs *s, fret_real dz, fret_real dx, unsigned substeps) {
    const fret_real dz0 = s->dz, dx0 = s->dx;
    for (unsigned j = 1; j < substeps && !fret_stopped(s->normal); j++) {
        const fret_real t = (fret_real)j / substeps, rest = (fret_real)(substeps - j) / substeps;
        advance(s, dz == dz0 ? dz : dz0 * rest + dz * t, dx == dx0 ? dx : dx0 * rest + dx * t);
    }
    advance(s, dz, dx);
}

static void set_direction(fret_springs *s, fret_real before, fret_real after) {
    if (after != before)
        s->direction = after < before ? -1 : 1;
}

/* Depth and load at the end of a step. */
static fret_status normal_end(const fret_springs *s, const fret_step *step, fret_real *dz, fret_real *FN) {
    const fret_real slack = 1 + 1e-12L; /* rounding of radius */
    fret_status st = fret_ok();
    *dz = s->dz;
    *FN = s->FN;
    if (step->normal_by == FRET_TO_FORCE) {
        st = fret_check_not_negative("FN", step->normal);
        if (!st.code && step->normal > s->end_FN * slack)
            st = fret_fail(FRET_OUTSIDE, "FN", step->normal, (double)s->end_FN);
        if (!st.code && (step->normal != s->FN || s->dz < 0)) {
            *FN = step->normal;
            *dz = depth_of_force(s, *FN);
        }
    } else if (step->normal_by == FRET_TO_DEPTH) {
        if (!isfinite(step->normal))
            st = fret_fail(FRET_NOT_FINITE, "dz", step->normal, 0);
        else if (step->normal > s->end_dz * slack)
            st = fret_fail(FRET_OUTSIDE, "dz", step->normal, (double)s->end_dz);
        if (!st.code && step->normal != s->dz) {
            *dz = step->normal;
            *FN = force_of_depth(s, *dz);
        }
    }
    return st;
}

/* mu F_N [N] of the continuum, from which the sum over cells differs by the error of the cells. */
static fret_real limit_of(const fret_springs *s, fret_real dz, fret_real FN, bool by_depth) {
    fret_press press;
    const bool known = by_depth && dz > 0 && !fret_press_by_depth(s->normal, (double)dz, &press).code;
    return s->mu * (known ? press.F : FN);
}

fret_status fret_springs_step(fret_springs *s, const fret_step *step, unsigned substeps) {
    fret_real dz, FN;
    if (substeps == 0)
        return fret_fail(FRET_NOT_POSITIVE, "substeps", 0, 0);
    const fret_status st = normal_end(s, step, &dz, &FN);
    if (st.code)
        return st;
    const bool by_force = step->tangential_by == FRET_TO_FX,
               by_depth =
                   step->normal_by == FRET_KEEP_NORMAL ? s->by_depth : step->normal_by == FRET_TO_DEPTH;
    if (step->tangential_by != FRET_KEEP_DX && !isfinite(step->tangential))
        return fret_fail(FRET_NOT_FINITE, by_force ? "Fx" : "dx", step->tangential, 0);
    if (by_force) {
        const fret_real limit = limit_of(s, dz, FN, by_depth), own = s->mu * FN,
                        size = fabs(step->tangential);
        if (size > fmaxl(limit, own) * (1 + ROUNDING))
            return fret_fail(FRET_GROSS_SLIP, "Fx", step->tangential, (double)fmaxl(limit, own));
        const fret_real Fx =
            copysignl(size >= limit * (1 - ROUNDING) ? own : fminl(size, own), step->tangential);
        set_direction(s, s->goal, Fx); /* compared with the imposed F_x: no reversal by rounding */
        step_by_force(s, FN, dz, Fx, substeps);
        s->goal = Fx;
    } else {
        const fret_real dx = step->tangential_by == FRET_TO_DX ? (fret_real)step->tangential : s->dx;
        set_direction(s, s->dx, dx);
        step_by_displacement(s, dz, dx, substeps);
        s->goal = s->Fx;
    }
    s->dz = dz;
    s->FN = FN;
    s->by_depth = by_depth;
    return fret_unless_stopped(s->normal, fret_ok());
}

void fret_springs_state(const fret_springs *s, fret_state *out) {
    const fret_real little = SLIPS * s->eta * s->mu * s->FN;
    fret_real stored = 0, going = 0;
    size_t sticking = s->closed;
    for (size_t i = s->closed; i-- > 0;) {
        const double bound = s->mu_eta * ((double)s->dz - s->g[i]), u = s->u[i];
        /* while all springs outside slip, a force moves this one and those inside */
        if (sticking == i + 1 && s->held[i + 1] * (bound - fabs(u)) <= little)
            sticking = i;
        if (s->held[i + 1] * (bound - s->direction * u) > little)
            going += s->w[i];
        stored += (fret_real)s->w[i] * u * u;
    }
    *out = (fret_state){
        .FN = s->FN,
        .dz = s->dz,
        .a = s->dz > 0 ? fret_law_radius(s->normal, s->dz) : 0,
        .Fx = s->Fx,
        .dx = s->dx,
        .W = fret_sum_value(&s->W),
        .U = stored / (2 * s->eta),
        .kn = s->held[s->closed],
        .kt = going / s->eta,
        .slices = s->closed,
    };
    out->c = sticking < s->closed ? s->cell * (fret_real)sticking : out->a;
}
