/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The foundation cut into springs: loops in double over arrays of them, which springs_lanes.h holds once for
 * each instruction set. Allocates the arrays. */
#include "fret/springs.h"

#include <float.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "contact/check.h"
#include "contact/normal.h"
#include "number/bits.h"
#include "number/processor.h"
#include "number/real.h"
#include "number/sum.h"

/* Springs are handled SUMS at a time, each into a sum of its own; those of STRIDE springs go into the total.
 */
enum { SUMS = 8, STRIDE = 512, ALIGNMENT = 8 * SUMS };
/* of a sum of springs, in lanes of STRIDE/SUMS */
#define ROUNDED (DBL_EPSILON / 2 * (STRIDE / SUMS))

typedef struct cells {
    double *g, *w; /* depth of touch, normal stiffness */
    double *b, *u; /* bound at the present depth, displacement */
    double mu_eta;
} cells;

/* A step straight in (delta_z, delta_x), from the present depth to z1 and by ddx. */
typedef struct straight {
    double z1, ddx;
    double hi, inverse; /* the larger depth, 1/|change of depth| */
} straight;

/* Sums, each with the rest that rounding has cut off: of w v, and of w times bound times slip. */
typedef struct partial_sums {
    _Alignas(ALIGNMENT) double force[SUMS];
    double force_rest[SUMS], loss[SUMS], loss_rest[SUMS];
} partial_sums;

#ifdef __x86_64__
#include <immintrin.h>
#define LEAST _mm_min_pd
#define MOST _mm_max_pd
#define ANY(mask) _mm_movemask_pd((__m128d)(mask))
#endif
#define LANES 2
#define NAME(x) x##_2
#define TARGET
#include "fast/springs_lanes.h"

#ifdef __x86_64__
#define LEAST _mm256_min_pd
#define MOST _mm256_max_pd
#define ANY(mask) _mm256_movemask_pd((__m256d)(mask))
#define LANES 4
#define NAME(x) x##_4
#define TARGET FRET_AVX2
#include "fast/springs_lanes.h"

#define LEAST _mm512_min_pd
#define MOST _mm512_max_pd
#define ANY(mask) _mm512_movepi64_mask((__m512i)(mask))
#define LANES 8
#define NAME(x) x##_8
#define TARGET FRET_AVX512
#include "fast/springs_lanes.h"
#endif

typedef struct loops {
    unsigned width;
    void (*shift)(const cells *c, size_t end, double ddx, partial_sums *out);
    void (*deform)(const cells *c, size_t end, const straight *path, partial_sums *out);
} loops;

static const loops of_width[] = {
    {2, shift_2, deform_2},
#ifdef __x86_64__
    {4, shift_4, deform_4},
    {8, shift_8, deform_8},
#endif
};

static bool runs_here(unsigned width) {
#ifdef __x86_64__
    if (width == 4)
        return fret_runs_avx2();
    if (width == 8)
        return fret_runs_avx512();
#endif
    return width == 2;
}

struct fret_springs {
    const fret_normal *normal; /* borrowed */
    double mu;
    fret_real compliance; /* 1/eta */
    double radius, cell;  /* width of a cell [m] */
    fret_real end_dz, end_FN;
    size_t count, padded; /* springs, and up to a multiple of SUMS */
    size_t closed;        /* springs that the present depth touches */
    cells cells;
    const loops *run;
    fret_real *w_sum; /* [i]: stiffness of springs 0..i-1 */
    fret_real *touch; /* [i]: F_N where spring i touches */
    fret_real dz, FN, dx, Fx;
    fret_real goal;   /* F_x as it was asked for, or as it came out of a displacement */
    int direction;    /* of the last tangential motion */
    fret_real astray; /* how far rounding may have moved a spring since all of them slipped */
    fret_real missed; /* by how much steps by force have missed theirs since then, at most */
    fret_sum W;
};

/* Springs after which the stop flag is looked at; where each takes a profile, fewer. */
enum { LOOK = 4096, LOOK_AT_PROFILE = 64 };

static double most(double a, double b) {
    return a > b ? a : b;
}

static bool allocate(fret_springs *s, size_t count) {
    if (count > SIZE_MAX / (4 * sizeof(fret_real)) - SUMS)
        return false;
    s->count = count;
    s->padded = (count + SUMS - 1) / SUMS * SUMS;
    cells *c = &s->cells;
    c->g = aligned_alloc(ALIGNMENT, 4 * s->padded * sizeof *c->g);
    s->w_sum = malloc((2 * count + 1) * sizeof *s->w_sum);
    if (!c->g || !s->w_sum) {
        free(c->g);
        free(s->w_sum);
        return false;
    }
    c->w = c->g + s->padded;
    c->b = c->w + s->padded;
    c->u = c->b + s->padded;
    s->touch = s->w_sum + count + 1;
    return true;
}

/* int of x^k over cell i of width 1: x+^(k+1)-x-^(k+1) without the cancellation at large i. */
static fret_real cell_weight(size_t i, fret_real k) {
    fret_real outer = (fret_real)i + 1, k1 = 1 + k;
    return fret_pow(outer, k1) * -expm1l(k1 * log1pl(-1 / outer)) / k1;
}

/* Unfinished where it is stopped. */
static void fill(fret_springs *s, fret_weight rule) {
    const fret_foundation *f = &s->normal->foundation;
    cells *c = &s->cells;
    fret_real h = (fret_real)s->radius / (fret_real)s->count;
    fret_real scale = 2 * f->cN0 * h * fret_pow(h / f->c0, f->k), stiffness = 0, force = 0, last = 0;
    for (size_t i = 0; i < s->count; i++) {
        if (i % LOOK_AT_PROFILE == 0 && fret_stopped(s->normal))
            return;
        fret_real mid = (fret_real)i + 0.5L;
        c->w[i] = (double)(scale * (rule == FRET_WEIGHT_CELL ? cell_weight(i, f->k) : fret_pow(mid, f->k)));
        /* rounding must not undo the order of touch */
        c->g[i] = most((double)fret_normal_profile(s->normal, mid * h), (double)last);
        force += stiffness * (c->g[i] - last);
        last = c->g[i];
        s->touch[i] = force;
        s->w_sum[i] = stiffness;
        stiffness += c->w[i];
    }
    s->w_sum[s->count] = stiffness;
    for (size_t i = s->count; i < s->padded; i++) { /* never touched */
        c->w[i] = 0;
        c->g[i] = DBL_MAX;
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
        st = fret_press_by_radius(normal, radius, &end);
    if (st.code)
        return st;
    fret_springs *s = calloc(1, sizeof *s);
    if (!s || !allocate(s, count)) {
        free(s);
        return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    }
    s->normal = normal;
    s->mu = mu;
    s->compliance = 1 / normal->foundation.eta;
    s->cells.mu_eta = (double)(mu * normal->foundation.eta);
    for (unsigned width = 2; width <= SUMS; width *= 2)
        fret_springs_use(s, width);
    s->radius = radius;
    s->cell = radius / (double)count;
    s->end_dz = end.dz;
    s->end_FN = end.F;
    fill(s, rule);
    if (fret_stopped(normal)) {
        fret_springs_free(s);
        return fret_unless_stopped(normal, fret_ok());
    }
    fret_springs_reset(s);
    *out = s;
    return fret_ok();
}

void fret_springs_free(fret_springs *s) {
    if (s) {
        free(s->cells.g);
        free(s->w_sum);
    }
    free(s);
}

int fret_springs_use(fret_springs *s, unsigned width) {
    for (size_t i = 0; i < sizeof of_width / sizeof *of_width; i++)
        if (of_width[i].width == width && runs_here(width)) {
            s->run = &of_width[i];
            return 1;
        }
    return 0;
}

void fret_springs_reset(fret_springs *s) {
    for (size_t i = 0; i < s->padded; i++)
        s->cells.b[i] = s->cells.u[i] = 0;
    s->dz = s->FN = s->dx = s->Fx = s->goal = s->astray = s->missed = 0;
    s->closed = 0;
    s->direction = 1;
    s->W = (fret_sum){0, 0};
}

fret_status fret_springs_copy(fret_springs *to, const fret_springs *from) {
    if (to == from)
        return fret_ok();
    fret_springs made = *from;
    if (to->count == from->count) {
        made.cells = to->cells;
        made.cells.mu_eta = from->cells.mu_eta;
        made.w_sum = to->w_sum;
        made.touch = to->touch;
    } else {
        if (!allocate(&made, from->count))
            return fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
        free(to->cells.g);
        free(to->w_sum);
    }
    *to = made;
    memcpy(to->cells.g, from->cells.g, 4 * from->padded * sizeof *to->cells.g);
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
    size_t i = springs_below(s->cells.g, s->count, (double)dz);
    return i ? s->touch[i - 1] + s->w_sum[i] * (dz - s->cells.g[i - 1]) : 0;
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
    return s->cells.g[lo - 1] + (FN - s->touch[lo - 1]) / s->w_sum[lo];
}

static inline fret_real total(const double *sum, const double *rest) {
    fret_real half[2];
    for (int l = 0; l < 2; l++) {
        const double *x = sum + 4 * l, *y = rest + 4 * l;
        half[l] = ((fret_real)x[0] + x[1]) + ((fret_real)x[2] + x[3]);
        half[l] += (y[0] + y[1]) + (y[2] + y[3]);
    }
    return half[0] + half[1];
}

static size_t groups(size_t springs) { /* up to whole SUMS */
    return (springs + SUMS - 1) / SUMS * SUMS;
}

/* A step by ddx below the depth z rounds ddx, touched, moved, trial and the bounds: together less than 10
 * half units in the last place of the largest bound, as springs that keep their memory do not move farther
 * than twice that. A step that takes all springs to their bounds ends all memory. */
static void go_astray(fret_springs *s, double z, double ddx) {
    const double bound = s->cells.mu_eta * z;
    if (!(fabs(ddx) < 2 * bound))
        s->astray = s->missed = 0;
    else
        s->astray += 5 * DBL_EPSILON * bound;
}

/* A straight step of all springs that it touches. */
static void advance(fret_springs *s, fret_real dz, fret_real dx) {
    const double z0 = (double)s->dz, z1 = (double)dz, ddx = (double)(dx - s->dx);
    const size_t end = groups(z1 > z0 ? springs_below(s->cells.g, s->count, z1) : s->closed);
    partial_sums sums;
    if (z0 == z1) {
        s->run->shift(&s->cells, end, ddx, &sums);
    } else {
        const straight path = {z1, ddx, most(z0, z1), 1 / fabs(z1 - z0)};
        s->run->deform(&s->cells, end, &path, &sums);
    }
    go_astray(s, most(z0, z1), ddx);
    s->Fx = total(sums.force, sums.force_rest) * s->compliance;
    fret_sum_add(&s->W, total(sums.loss, sums.loss_rest) * s->compliance);
    if (dz != s->dz)
        s->closed = springs_below(s->cells.g, s->count, (double)dz);
    s->dz = dz;
    s->dx = dx;
}

static void turn(fret_springs *s, fret_real before, fret_real after) {
    if (after != before)
        s->direction = after < before ? -1 : 1;
}

/* The same at constant depth: most steps are of this kind, and what goes round the loop over springs would
 * cost as much as 200 of them. */
static void step_at_depth(fret_springs *s, fret_real dx) {
    const double ddx = (double)(dx - s->dx);
    partial_sums sums;
    s->run->shift(&s->cells, groups(s->closed), ddx, &sums);
    go_astray(s, (double)s->dz, ddx);
    turn(s, s->dx, dx);
    s->dx = dx;
    s->Fx = s->goal = total(sums.force, sums.force_rest) * s->compliance;
    fret_sum_add(&s->W, total(sums.loss, sums.loss_rest) * s->compliance);
}

/* Sum of w (z - g) over the springs before `end`, which all touch at depth z. */
static fret_real load_inside(const fret_springs *s, size_t end, fret_real z) {
    return end ? s->touch[end - 1] + s->w_sum[end] * (z - s->cells.g[end - 1]) : 0;
}

/* How far a spring goes to the side `sign` until it slips at depth z. */
static inline double room_of(const cells *c, size_t i, double z, double sign) {
    return c->mu_eta * (z - c->g[i]) - sign * c->u[i];
}

/* From the first `inside` springs inwards, groups of them that all slip before the sum is what is wanted:
 * what is left, their force in *slipping, and the room of the last of them. */
static size_t slip_groups(const fret_springs *s, size_t inside, double z, double sign, double want,
                          double *slipping, double *left) {
    enum { GROUP = 8 };
    const cells *c = &s->cells;
    while (inside >= GROUP && !fret_stopped(s->normal)) {
        const size_t first = inside - GROUP;
        double force[GROUP];
        for (size_t i = 0; i < GROUP; i++)
            force[i] = c->w[first + i] * room_of(c, first + i, z, sign);
        const double room = room_of(c, first, z, sign),
                     sum = ((force[0] + force[1]) + (force[2] + force[3])) +
                           ((force[4] + force[5]) + (force[6] + force[7]));
        if (*slipping + sum + (double)s->w_sum[first] * room >= want)
            break;
        *slipping += sum;
        *left = room;
        inside = first;
    }
    return inside;
}

/* The change of delta_x that brings F_x on the way to depth z, up to rounding. No history makes u steeper in
 * g than the bound is, so springs begin to slip one after the other from the edge inwards, all to one side,
 * and the front is found in one pass over those that slip. Sums are of w u. */
static double displacement_of_front(const fret_springs *s, fret_real z, fret_real Fx) {
    const cells *c = &s->cells;
    const fret_real z0 = s->dz > 0 ? s->dz : 0, z1 = z > 0 ? z : 0, deeper = z1 - z0;
    size_t inside = s->closed;
    fret_real missing = (Fx - s->Fx) * s->normal->foundation.eta;
    double touching = 0; /* what springs touched on the way add per displacement, up to that of their bound */
    if (deeper > 0) {
        const size_t end = springs_below(c->g, s->count, (double)z1);
        touching = (double)((load_inside(s, end, z1) - load_inside(s, inside, z1)) / deeper);
    }
    while (inside > 0 && !(c->g[inside - 1] < (double)z1)) { /* parted on the way */
        inside--;
        missing += (fret_real)c->w[inside] * c->u[inside];
    }
    const double all = (double)s->w_sum[inside] + touching, x = all > 0 ? (double)missing / all : 0,
                 bound = inside ? c->mu_eta * ((double)z1 - c->g[inside - 1]) : 0;
    double u = inside ? c->u[inside - 1] : 0, slipping = 0,
           left = 0; /* force of those that slip; room of the next */
    if (deeper > 0 ? fabs(x) <= c->mu_eta * (double)deeper : fabs(u + x) <= bound)
        return x;
    const double sign = (deeper > 0 ? x : u + x) < 0 ? -1 : 1, want = sign * (double)missing;
    slipping = touching * (c->mu_eta * (double)deeper);
    size_t i = slip_groups(s, inside, (double)z1, sign, want, &slipping, &left);
    while (i-- > 0 && (i % LOOK || !fret_stopped(s->normal))) {
        const double sticks = (double)s->w_sum[i + 1];
        left = room_of(c, i, (double)z1, sign);
        if (slipping + sticks * left >= want)
            return sign * (want - slipping) / sticks;
        slipping += c->w[i] * left;
    }
    return sign * left;
}

/* To a load, at its depth, and a force. */
static void follow(fret_springs *s, fret_real load, fret_real depth, fret_real force) {
    const fret_real limit = s->mu * load, to = fminl(fmaxl(force, -limit), limit);
    advance(s, depth, s->dx + displacement_of_front(s, depth, to));
    const fret_real miss = fabsl(to - s->Fx);
    s->missed = fmaxl(s->missed, miss); /* also where it is to go back by that */
    if (miss > 1e-14L * limit) {        /* the rounding of many springs */
        advance(s, depth, s->dx + displacement_of_front(s, depth, to));
        s->missed = fmaxl(s->missed, fabsl(to - s->Fx));
    }
}

/* The last part of a way to no load, where displacements go with a power of it: in parts ever smaller, down
 * to a single spring, which parts where its force ends. */
static void let_go(fret_springs *s, fret_real load, fret_real force, unsigned parts) {
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
        advance(s, s->cells.g[0], s->dx - s->cells.u[0]);
    advance(s, 0, s->dx);
}

static void walk_forces(fret_springs *s, fret_real FN, fret_real dz, fret_real Fx, unsigned substeps) {
    enum { FEWEST = 8 };
    const fret_real FN0 = s->FN, Fx0 = s->Fx;
    const bool opens = FN == 0 && FN0 > 0;
    s->dz = fmaxl(s->dz, 0); /* an open contact closes without load */
    for (unsigned j = 1; j < substeps + !opens && !fret_stopped(s->normal); j++) {
        fret_real t = (fret_real)j / substeps, rest = (fret_real)(substeps - j) / substeps;
        fret_real load = FN0 * rest + FN * t, depth = j == substeps ? fmaxl(dz, 0) : depth_of_force(s, load);
        if (FN == FN0)
            depth = s->dz; /* rounding must not make it breathe */
        follow(s, load, depth, Fx0 * rest + Fx * t);
    }
    if (opens)
        let_go(s, FN0 / substeps, Fx0 / substeps, substeps > FEWEST ? substeps : FEWEST);
}

static void walk_displacements(fret_springs *s, fret_real dz, fret_real dx, unsigned substeps) {
    const fret_real dz0 = s->dz, dx0 = s->dx;
    for (unsigned j = 1; j < substeps && !fret_stopped(s->normal); j++) {
        fret_real t = (fret_real)j / substeps, rest = (fret_real)(substeps - j) / substeps;
        advance(s, dz == dz0 ? dz : dz0 * rest + dz * t, dx == dx0 ? dx : dx0 * rest + dx * t);
    }
    advance(s, dz, dx);
}

/* Depth and load at the end of a step. */
static fret_status normal_end(const fret_springs *s, const fret_step *step, fret_real *dz, fret_real *FN) {
    const fret_real slack = 1 + 1e-12L; /* radius was rounded */
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

fret_status fret_springs_step(fret_springs *s, const fret_step *step, unsigned substeps) {
    fret_real dz, FN;
    if (substeps == 0)
        return fret_fail(FRET_NOT_POSITIVE, "substeps", 0, 0);
    if (step->normal_by == FRET_KEEP_NORMAL && step->tangential_by == FRET_TO_DX && substeps == 1 &&
        isfinite(step->tangential)) {
        step_at_depth(s, step->tangential);
        return fret_ok();
    }
    const fret_status st = normal_end(s, step, &dz, &FN);
    if (st.code)
        return st;
    const bool by_force = step->tangential_by == FRET_TO_FX;
    if (step->tangential_by != FRET_KEEP_DX && !isfinite(step->tangential))
        return fret_fail(FRET_NOT_FINITE, by_force ? "Fx" : "dx", step->tangential, 0);
    const double most = (double)(s->mu * FN);
    if (by_force && fabs(step->tangential) > most * (1 + ROUNDED))
        return fret_fail(FRET_GROSS_SLIP, "Fx", step->tangential, most);
    if (by_force) {
        const double Fx = copysign(fmin(fabs(step->tangential), most), step->tangential);
        turn(s, s->goal, Fx); /* which rounding must not make a reversal */
        walk_forces(s, FN, dz, Fx, substeps);
        s->goal = Fx;
    } else {
        const fret_real dx = step->tangential_by == FRET_TO_DX ? (fret_real)step->tangential : s->dx;
        turn(s, s->dx, dx);
        walk_displacements(s, dz, dx, substeps);
        s->goal = s->Fx;
    }
    s->dz = dz;
    s->FN = FN;
    return fret_unless_stopped(s->normal, fret_ok());
}

/* How far all springs together may be from where a load makes them come back to, as a force: that by which
 * two visits missed it, or what rounds their sum. */
static double force_astray(const fret_springs *s) {
    const fret_real rounding = ROUNDED * s->mu * s->FN;
    return (double)(2 * s->normal->foundation.eta * (s->missed + rounding));
}

void fret_springs_state(const fret_springs *s, fret_state *out) {
    const fret_real eta = s->normal->foundation.eta;
    const size_t closed = s->closed;
    const double astray = (double)s->astray, force = force_astray(s);
    fret_real stored = 0, going = 0;
    size_t slipping = 0; /* outermost run of them */
    bool run = true;
    for (size_t i = closed; i-- > 0 && (i % LOOK || !fret_stopped(s->normal));) {
        double bound = s->cells.b[i], u = s->cells.u[i], w = s->cells.w[i];
        /* as long as those outside slip, the force moves this one and those within */
        const double held = (double)s->w_sum[i + 1], slack = held * astray + force;
        run = run && held * (bound - fabs(u)) <= slack;
        slipping += run;
        stored += (fret_real)w * u * u;
        going += held * (bound - s->direction * u) <= slack ? 0 : w;
    }
    *out = (fret_state){
        .FN = s->FN,
        .dz = s->dz,
        .a = s->dz > 0 ? fret_law_radius(s->normal, s->dz) : 0,
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
