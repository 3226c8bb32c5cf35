/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The memory curve in (M, P): cuts and extends it along paths of the load, and sums the losses. Allocates its
 * arcs. */
#include "history/swing.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "law/check.h"
#include "number/array.h"
#include "number/real.h"

/* True if two harmonic paths that meet while both coordinates rise are one: then their lags agree too. */
static bool same_path(const load_path *a, const load_path *b) {
    return a->mean == b->mean && a->size[M] == b->size[M] && a->size[P] == b->size[P];
}

/* ---- the curve --------------------------------------------------------------------------------- */

static fret_status reserve(fret_swing *c, size_t count) {
    return fret_array_room(&c->arcs, &c->room, count, sizeof *c->arcs)
               ? fret_ok()
               : fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
}

/* The rounding errors of forces of the present size. */
static fret_real noise(const fret_swing *c) {
    return 512 * LDBL_EPSILON * c->scale;
}

fret_real fret_swing_other(const arc *p, int which, fret_real level) {
    const int other = 1 - which;
    if (p->curved)
        return load_path_at(&p->path, other, load_path_when(&p->path, which, level, p->lo, p->hi));
    const fret_real part = (level - p->first[which]) / (p->last[which] - p->first[which]);
    return p->first[other] + (p->last[other] - p->first[other]) * part;
}

/* The arc that the level of `which` crosses, or NULL. */
static const arc *crossed(const fret_swing *c, int which, fret_real level) {
    for (size_t i = c->count; i-- > 0;) {
        const arc *p = &c->arcs[i];
        if (p->first[which] <= level && p->first[which] < p->last[which])
            return p;
    }
    return NULL;
}

/* The other coordinate of the curve at that level. */
static fret_real curve_other(const fret_swing *c, int which, fret_real level) {
    const arc *p = crossed(c, which, level);
    return p ? fret_swing_other(p, which, fminl(level, p->last[which])) : 0;
}

static fret_status append(fret_swing *c, const arc *p) {
    const fret_status st = reserve(c, c->count + 1);
    if (!st.code)
        c->arcs[c->count++] = *p;
    return st;
}

/* True if two straight arcs form one line, to the rounding of targets; false for very short ones, else a
 * curve in tiny steps would become one line. */
static bool in_line(const fret_swing *c, const arc *a, const arc *b) {
    const fret_real rounding = 4 * DBL_EPSILON * c->scale, least = 1e-7L * c->scale;
    const fret_real m = b->last[M] - a->first[M], p = b->last[P] - a->first[P];
    const fret_real off = m * (a->last[P] - a->first[P]) - p * (a->last[M] - a->first[M]);
    return fabsl(off) <= rounding * fmaxl(m, p) &&
           fmaxl(b->last[M] - b->first[M], b->last[P] - b->first[P]) > least;
}

/* Appends an arc, or extends the last one if it is on the same path or line. */
static fret_status grow(fret_swing *c, const arc *p) {
    if (!c->count)
        return append(c, p);
    arc *top = &c->arcs[c->count - 1];
    if (top->curved != p->curved || fabsl(top->last[M] - p->first[M]) > noise(c) ||
        fabsl(top->last[P] - p->first[P]) > noise(c) ||
        !(p->curved ? top->hi == p->lo && same_path(&top->path, &p->path) : in_line(c, top, p)))
        return append(c, p);
    memcpy(top->last, p->last, sizeof top->last);
    top->hi = p->hi;
    top->known = false;
    return fret_ok();
}

/* Cuts the curve at the level of `which` and goes straight to the end. */
static fret_status cut(fret_swing *c, int which, fret_real level, const fret_real end[2]) {
    while (c->count && c->arcs[c->count - 1].last[which] > level &&
           c->arcs[c->count - 1].first[which] >= level)
        c->count--;
    fret_real corner[2] = {0, 0};
    if (c->count) {
        arc *top = &c->arcs[c->count - 1];
        if (top->last[which] > level) {
            top->last[1 - which] = fret_swing_other(top, which, level);
            top->last[which] = level;
            if (top->curved)
                top->hi = load_path_when(&top->path, which, level, top->lo, top->hi);
            top->known = false;
        }
        memcpy(corner, top->last, sizeof corner);
    }
    if (end[1 - which] - corner[1 - which] > noise(c)) {
        const arc straight = {.first = {corner[0], corner[1]}, .last = {end[0], end[1]}};
        return append(c, &straight);
    }
    if (c->count)
        memcpy(c->arcs[c->count - 1].last, end, sizeof corner);
    return fret_ok();
}

/* ---- slip -------------------------------------------------------------------------------------- */

typedef struct slip {
    const fret_swing *curve;
    const load_path *path;
    int which;
    fret_real lo, hi, end; /* end: the level at hi */
} slip;

/* [F(D)-F(d)-(D-d) F'(d)]/F'(d) [m], D the depth of the load `edge`, d that of `front` >= 0; zone = edge -
 * front, with all digits. */
static fret_real loss_rate(const fret_normal *n, fret_real edge, fret_real front, fret_real zone) {
    if (!(zone > 0))
        return 0;
    fret_place at[2] = {{0, 0}, {0, 0}};
    const fret_level outer = {fret_law_other(n, true, edge, &at[0]), edge};
    const fret_slice s = fret_law_slice_to(n, &outer, true, zone, front, at);
    return s.K > 0 ? s.G / s.K : 0; /* at the centre K = 0 */
}

/* That times the rate at which the level falls. */
static fret_real slip_rate(fret_real t, fret_real rest, void *context) {
    const slip *l = context;
    const fret_real s = l->lo * rest + l->hi * t;
    /* counted from the end, where the level may be 0 and the rate infinite */
    const fret_real level = l->path->harmonic ? load_path_at(l->path, l->which, s)
                                              : l->end - l->path->span[l->which] * ((l->hi - l->lo) * rest);
    const fret_real other = load_path_at(l->path, 1 - l->which, s),
                    inner = curve_other(l->curve, l->which, level);
    return loss_rate(l->curve->normal, (level + other) / 2, (level + inner) / 2, (other - inner) / 2) *
           load_path_fall(l->path, l->which, s);
}

/* values of s closer than this, relative to the largest, are one */
static const fret_real CLOSE = 16 * LDBL_EPSILON;

/* The first s after lo at which a falling coordinate (bits: 1 M, 2 P) reaches an end of one of `count` arcs,
 * or hi. */
static fret_real next_crossing(const fret_swing *c, size_t count, const load_path *w, int coordinates,
                               fret_real lo, fret_real hi) {
    const fret_real close = CLOSE * fmaxl(1, fabsl(hi));
    fret_real next = hi;
    for (int which = M; which <= P; which++) {
        const fret_real from = load_path_at(w, which, lo), to = load_path_at(w, which, hi);
        if (!(coordinates >> which & 1))
            continue;
        for (size_t i = count; i-- > 0 && c->arcs[i].last[which] > to;) {
            const fret_real level = c->arcs[i].first[which];
            if (!(level > to + noise(c) && level < from - noise(c)))
                continue;
            const fret_real s = load_path_when(w, which, level, lo, hi);
            if (s > lo + close && s < next - close)
                next = s;
        }
    }
    return next;
}

/* The end of the next part of an integral. The rate is a power of the level: if the front is near the centre
 * at hi, its singularity is about as near to hi in the complex plane of s. Parts longer than twice that
 * distance are halved. */
static fret_real part_end(const load_path *w, int which, fret_real lo, fret_real hi) {
    const fret_real level = load_path_at(w, which, hi);
    const fret_real distance = w->harmonic ? sqrtl(2 * level / w->size[which]) : level / -w->span[which];
    return hi - lo > 2 * distance && hi - lo > 1e-6L ? (lo + hi) / 2 : hi;
}

/* Adds a phase to the record of slip. */
static void record(const fret_swing *c, const slip *l) {
    fret_slips *all = c->slips;
    const arc *front = crossed(c, l->which, load_path_at(l->path, l->which, (l->lo + l->hi) / 2));
    if (!all || !front)
        return;
    all->failed |= !fret_array_room(&all->swung, &all->swing_room, all->swings + 1, sizeof *all->swung);
    if (all->failed)
        return;
    all->swung[all->swings] = (swung_phase){*l->path, l->which, l->lo, l->hi, *front};
    fret_slips_add(all, &(slip_phase){.kind = SWUNG, .gain = 1, .swung = all->swings++});
}

/* Slip between two values of s, with the front at the level of `which`, which falls. */
static fret_status slip_between(fret_swing *c, const load_path *w, int which, fret_real lo, fret_real hi) {
    slip l = {.curve = c, .path = w, .which = which, .lo = lo};
    while (l.lo < hi) {
        l.hi = part_end(w, which, l.lo, next_crossing(c, c->count, w, 1 << which, l.lo, hi));
        l.end = load_path_at(w, which, l.hi);
        const fret_real loss = (l.hi - l.lo) * fret_swing_integral(c, slip_rate, &l);
        c->last_loss += loss > 0 ? loss : 0;
        record(c, &l);
        l.lo = l.hi;
    }
    const fret_real end[2] = {load_path_at(w, M, hi), load_path_at(w, P, hi)};
    return cut(c, which, end[which], end);
}

/* 1 if the point on the path lies above the curve, -1 if below, 0 if on it. */
static int side_of(const fret_swing *c, const load_path *w, fret_real s) {
    const fret_real above = load_path_at(w, P, s) - curve_other(c, M, load_path_at(w, M, s));
    return fabsl(above) <= 4 * noise(c) ? 0 : above > 0 ? 1 : -1;
}

/* Sample points for a change of sides, as a part of the path: denser towards its ends, since a change missed
 * there affects the loss by the third power of its distance. */
enum { SAMPLES = 24, CLOSER = 12, HALVINGS = 64 };

static fret_real sample(int i) {
    const fret_real first = 0.5L / (fret_real)SAMPLES;
    if (i < CLOSER)
        return ldexpl(first, i - CLOSER);
    if (i >= CLOSER + SAMPLES)
        return 1 - ldexpl(first, CLOSER + SAMPLES - 1 - i);
    return first * (1 + 2 * (i - CLOSER));
}

/* Returns the side of the path after lo, and sets *hi to where it leaves that side. If the path begins on the
 * curve, its side is the first one that the first samples find. */
static int side_until(const fret_swing *c, const load_path *w, fret_real lo, fret_real *hi) {
    const fret_real length = *hi - lo;
    fret_real before = lo;
    int side = 0;
    for (int i = 0; i < CLOSER + SAMPLES + CLOSER; i++) {
        fret_real after = lo + length * sample(i);
        const int now = side_of(c, w, after);
        if (side == 0 && i <= CLOSER / 2)
            side = now;
        if (now != side) {
            for (int j = 0; j < HALVINGS; j++) {
                const fret_real middle = (before + after) / 2;
                *(side_of(c, w, middle) == side ? &before : &after) = middle;
            }
            *hi = after;
            break;
        }
        before = after;
    }
    return side;
}

/* True if the arc is straight along this coordinate. */
static bool goes_along(const arc *p, int which) {
    return !p->curved && p->first[1 - which] == p->last[1 - which];
}

/* Both coordinates fall: slip is forward above the curve, backward below; along it there is none. Slip
 * changes the curve. */
static fret_status both_fall(fret_swing *c, const load_path *w, fret_real lo, fret_real hi) {
    fret_status st = fret_ok();
    const fret_real least = 1e-9L * (hi - lo);
    size_t left = 0; /* 1 if the last arc is the one that slip has just made: its end is no event */
    while (lo < hi && !st.code && !fret_stopped(c->normal)) {
        const fret_real crossing = next_crossing(c, c->count - left, w, 1 << M | 1 << P, lo, hi);
        fret_real stop = crossing;
        const int side = side_until(c, w, lo, &stop);
        stop = fminl(fmaxl(stop, lo + least), crossing); /* progress, against rounding */
        if (side == 0) {
            const fret_real end[2] = {load_path_at(w, M, stop), load_path_at(w, P, stop)};
            st = cut(c, M, end[M], end);
        } else {
            st = slip_between(c, w, side > 0 ? M : P, lo, stop);
        }
        left = c->count > 0 && goes_along(&c->arcs[c->count - 1], side < 0 ? M : P);
        lo = stop;
    }
    return st;
}

/* Follows a part of the path in which both coordinates are monotone. */
static fret_status go_between(fret_swing *c, const load_path *w, fret_real lo, fret_real hi) {
    const fret_real begin[2] = {load_path_at(w, M, lo), load_path_at(w, P, lo)},
                    end[2] = {load_path_at(w, M, hi), load_path_at(w, P, hi)};
    bool rises[2], falls[2];
    for (int i = M; i <= P; i++) {
        rises[i] = end[i] - begin[i] > noise(c);
        falls[i] = begin[i] - end[i] > noise(c);
    }
    if (falls[M] && falls[P])
        return both_fall(c, w, lo, hi);
    if (falls[M] || falls[P])
        return slip_between(c, w, falls[M] ? M : P, lo, hi);
    if (!rises[M] && !rises[P])
        return fret_ok();
    const arc grown = {.first = {begin[M], begin[P]},
                       .last = {end[M], end[P]},
                       .curved = w->harmonic && rises[M] && rises[P],
                       .path = *w,
                       .lo = lo,
                       .hi = hi};
    return grow(c, &grown);
}

/* ---- periods and steps ------------------------------------------------------------------------- */

static void make_harmonic(const fret_swing *c, const fret_sine *sine, load_path *out) {
    *out = (load_path){.harmonic = true, .mean = sine->FN};
    const fret_real y = -sine->FNA * sinl(sine->phase), normal = sine->FNA * cosl(sine->phase);
    for (int i = M; i <= P; i++) {
        const fret_real x = normal + (i == M ? -1 : 1) * sine->FA / (fret_real)c->mu;
        out->size[i] = sqrtl(x * x + y * y);
        out->lag[i] = atan2l(y, x);
    }
}

bool fret_swing_fits(const fret_swing *c, const fret_sine *sine, double from) {
    load_path w;
    make_harmonic(c, sine, &w);
    /* after another part: to the rounding of the time */
    const fret_real little = (from > 0 ? 16 : 4) * DBL_EPSILON * sine->FN, s = 2 * FRET_PI * from;
    fret_press most;
    if (fret_press_by_force(c->normal, (double)sine->FN + fabs(sine->FNA), &most).code)
        return false;
    const fret_real begin[2] = {c->FN - c->Fx / c->mu, c->FN + c->Fx / c->mu};
    for (int i = M; i <= P; i++)
        if (!(w.size[i] < w.mean * (1 - 1e-12L)) || !(fabsl(load_path_at(&w, i, s) - begin[i]) <= little))
            return false;
    return true;
}

static void set_edge(fret_swing *c, const fret_press *p, fret_real Fx) {
    if (Fx != c->Fx)
        c->direction = Fx < c->Fx ? -1 : 1;
    c->FN = p->F;
    c->dz = p->dz;
    c->a = p->a;
    c->Fx = Fx;
}

static void add_loss(fret_swing *c) {
    c->last_loss *= c->mu * c->mu * c->normal->foundation.eta;
    fret_sum_add(&c->W, c->last_loss);
}

/* Finishes a motion. */
static fret_status finish(fret_swing *c) {
    fret_swing_compute_sums(c);
    return fret_unless_stopped(c->normal, fret_ok());
}

/* cos(angle), with 0 where it is 0 but for the rounding of the time. */
static fret_real cosine(fret_real angle) {
    const fret_real v = cosl(angle);
    return fabsl(v) < 4 * DBL_EPSILON ? 0 : v;
}

fret_status fret_swing_part(fret_swing *c, const fret_sine *sine, double from, double to) {
    const fret_real lo = 2 * FRET_PI * from, hi = 2 * FRET_PI * to, last = to < 1 ? hi : 0;
    fret_real turn[8] = {lo};
    size_t turns = 1;
    fret_press p;
    load_path w;
    if (!(from >= 0 && from < to && to <= 1))
        return fret_fail(FRET_OUTSIDE, from >= 0 && from < 1 ? "to" : "from",
                         from >= 0 && from < 1 ? to : from, 1);
    make_harmonic(c, sine, &w);
    for (int i = M; i <= P; i++)
        for (int half = -2; half <= 3; half++) {
            const fret_real s = w.lag[i] + half * FRET_PI;
            if (w.size[i] > 0 && s > lo && s < hi)
                turn[turns++] = s;
        }
    for (size_t i = 1; i < turns; i++) /* insertion sort */
        for (size_t j = i; j > 1 && turn[j] < turn[j - 1]; j--) {
            const fret_real s = turn[j];
            turn[j] = turn[j - 1];
            turn[j - 1] = s;
        }
    turn[turns++] = hi;
    c->scale = fmaxl(c->scale, w.mean + fmaxl(w.size[M], w.size[P]));
    c->last_loss = 0;
    c->held = false;
    fret_status st = fret_ok();
    for (size_t i = 1; i < turns && !st.code; i++)
        if (turn[i] - turn[i - 1] > CLOSE * 2 * FRET_PI)
            st = go_between(c, &w, turn[i - 1], turn[i]);
    if (!st.code)
        st = fret_press_by_force(c->normal, (double)(sine->FN + sine->FNA * cosine(last + sine->phase)), &p);
    if (st.code)
        return st;
    add_loss(c);
    set_edge(c, &p, sine->FA * cosine(last));
    if (sine->FA != 0)
        c->direction = (to > 0.5) == (sine->FA > 0) ? 1 : -1;
    return finish(c);
}

/* A straight path in forces, to F_x = mu load. */
static fret_status go_straight(fret_swing *c, const fret_press *p, fret_real load) {
    load_path w = {.harmonic = false};
    const fret_real old = c->Fx / c->mu, begin[2] = {c->FN - old, c->FN + old},
                    end[2] = {p->F - load, p->F + load};
    for (int i = M; i <= P; i++) {
        w.start[i] = begin[i];
        w.span[i] = end[i] - begin[i];
        c->scale = fmaxl(c->scale, end[i]);
    }
    return go_between(c, &w, 0, 1);
}

/* At constant F_N to delta_x; what remains once all springs slip is gross slip. */
static fret_status slide(fret_swing *c, double dx) {
    if (!isfinite(dx))
        return fret_fail(FRET_NOT_FINITE, "dx", dx, 0);
    c->last_loss = 0;
    if (c->held && c->goal == dx)
        return fret_ok();
    const fret_real mu_eta = c->mu * c->normal->foundation.eta,
                    drive = ((fret_real)dx - fret_swing_dx(c)) / mu_eta;
    const int sign = drive < 0 ? -1 : 1;
    fret_real left = fabsl(drive);
    const fret_press here = {.F = c->FN, .dz = c->dz, .a = c->a};
    const fret_real level = fret_swing_front(c, sign > 0 ? M : P, &left), load = sign * (c->FN - level);
    const fret_status st = go_straight(c, &here, load);
    if (st.code)
        return st;
    c->last_loss += c->FN * left;
    if (left > 0)
        fret_slips_add(c->slips, &(slip_phase){.kind = GROSS, .edge = {c->dz, c->dz}, .gain = left});
    c->slid += sign * mu_eta * left;
    add_loss(c);
    c->Fx = c->mu * load;
    c->direction = sign;
    c->held = true;
    c->goal = dx;
    return finish(c);
}

fret_status fret_swing_step(fret_swing *c, const fret_step *step) {
    fret_press p = {.F = c->FN, .dz = c->dz, .a = c->a};
    fret_status st = fret_ok();
    if (step->tangential_by == FRET_TO_DX && step->normal_by == FRET_KEEP_NORMAL)
        return slide(c, step->tangential);
    if (step->tangential_by != FRET_TO_FX)
        return fret_fail(FRET_OUTSIDE, "dx", step->tangential, 0);
    if (step->normal_by == FRET_TO_FORCE)
        st = fret_press_by_force(c->normal, step->normal, &p);
    else if (step->normal_by == FRET_TO_DEPTH)
        st = fret_press_by_depth(c->normal, step->normal < 0 ? 0 : step->normal, &p);
    fret_real load = 0;
    if (!st.code)
        st = fret_step_load(c->mu, step, p.F, &load);
    if (st.code)
        return st;
    c->last_loss = 0;
    st = go_straight(c, &p, load);
    if (st.code)
        return st;
    add_loss(c);
    c->held = false;
    set_edge(c, &p, step->tangential);
    return finish(c);
}

/* ---- life -------------------------------------------------------------------------------------- */

fret_status fret_swing_make(const fret_memory *m, fret_swing **out) {
    if (!fret_normal_swings(m->normal))
        return fret_fail(FRET_OUTSIDE, "gap", 0, 0);
    fret_swing *c = calloc(1, sizeof *c);
    fret_status st = c ? reserve(c, m->count + 8) : fret_fail(FRET_NO_MEMORY, NULL, 0, 0);
    if (st.code) {
        free(c);
        return st;
    }
    c->normal = m->normal;
    c->mu = m->mu;
    c->slips = m->slips;
    c->FN = m->edge.y[LOAD];
    const fret_press edge = fret_memory_pressed(m);
    c->dz = edge.dz;
    c->a = edge.a;
    c->Fx = m->Fx;
    c->slid = m->slid;
    c->goal = (double)m->dx;
    c->held = c->goal == m->dx;
    c->direction = m->direction;
    c->W = (fret_sum){m->W, m->W_rest};
    fret_real at[2] = {0, 0};
    for (size_t i = 0; i < m->count; i++) {
        arc *p = &c->arcs[c->count++];
        const fret_real h = layer_thickness(&m->layers[i], outer_of(m, &m->layers[i]), LOAD),
                        sigma = m->layers[i].sigma;
        *p = (arc){.first = {at[M], at[P]}};
        at[M] += (1 - sigma) * h;
        at[P] += (1 + sigma) * h;
        memcpy(p->last, at, sizeof at);
    }
    c->scale = fmaxl(at[M], at[P]);
    *out = c;
    return st;
}

void fret_swing_free(fret_swing *c) {
    if (c)
        free(c->arcs);
    free(c);
}

fret_status fret_swing_copy(fret_swing *to, const fret_swing *from) {
    if (to == from)
        return fret_ok();
    const fret_status st = reserve(to, from->count);
    if (st.code)
        return st;
    arc *arcs = to->arcs;
    const size_t room = to->room;
    fret_slips *slips = to->slips;
    *to = *from;
    to->slips = slips;
    to->arcs = arcs;
    to->room = room;
    memcpy(arcs, from->arcs, from->count * sizeof *arcs);
    return st;
}
