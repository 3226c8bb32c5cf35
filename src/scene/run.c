/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Running a load program: legs, periods, swinging normal forces. */
#include "scene/run.h"

#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "number/real.h"
#include "number/root.h"

static const double pi = 3.14159265358979323846;

static const fret_status fine = {FRET_OK, NULL, 0, 0};
static const fret_status interrupted = {FRET_INTERRUPTED, NULL, 0, 0};

static fret_status unless_stopped(const runner *r, fret_status st) {
    if (r->load->pulse)
        r->load->pulse();
    return !st.code && *r->load->stop ? interrupted : st;
}

/* ---- looking on -------------------------------------------------------------------------------- */

static double next_point(const watch *w, const leg *l, double after) {
    const unsigned points = l->points ? l->points : w->points;
    if (!l->chord)
        return (floor(after * points + 1e-9) + 1) / points;
    /* chords are many: points of a period, evenly in time */
    const double length = l->end - l->begin, here = l->begin + after * length - l->origin;
    const double x = ((floor(here * points + 1e-9) + 1) / points + l->origin - l->begin) / length;
    return x > 1 + 1e-9 ? 2 : x > 1 - 1e-9 ? 1 : x;
}

static double next_time(const watch *w, const leg *l, double after) {
    const double t = w->first + w->every * (double)w->sample, little = 1e-9 * w->every;
    const double end = w->turns && !l->chord ? 1 : 2;
    (void)after;
    if (w->sample > w->last || t > l->end + little)
        return end;
    if (t > l->end - little)
        return 1;
    return (t - l->begin) / (l->end - l->begin);
}

watch watch_points(unsigned points) {
    return (watch){.next = next_point, .points = points};
}

static double next_end(const watch *w, const leg *l, double after) {
    (void)w, (void)l, (void)after;
    return 1;
}

watch watch_ends(void) {
    return (watch){.next = next_end};
}

static double next_part(const watch *w, const leg *l, double after) {
    return l->chord ? 1 : (floor(after * w->points + 1e-9) + 1) / w->points;
}

watch watch_way(unsigned points) {
    return (watch){.next = next_part, .points = points};
}

watch watch_times(double first, double every, size_t last, bool turns) {
    return (watch){.next = next_time, .first = first, .every = every, .last = last, .turns = turns};
}

static void sum_area(runner *r) {
    fret_state now;
    engine_forces(&r->engine, &now);
    r->area += (now.dx - r->dx) * (now.Fx + r->Fx) / 2;
    r->Fx = now.Fx;
    r->dx = now.dx;
}

static fret_status look(runner *r, double time, bool turning) {
    watch *w = r->watch;
    r->time = time;
    r->turning = turning;
    if (r->area_wanted)
        sum_area(r);
    if (w->see && !w->see(r, w->context)) {
        r->halted = true;
        return interrupted;
    }
    while (w->next == next_time && w->sample <= w->last &&
           w->first + w->every * (double)w->sample <= time + 1e-9 * w->every)
        w->sample++;
    return unless_stopped(r, fine);
}

/* Does the watch want the run to wait here? */
static bool must_wait(runner *r) {
    r->waits = r->watch && r->watch->wait;
    return r->waits;
}

/* Where the load is at the part x of a leg, as a part of the way. */
static double way(const leg *l, double x) {
    if (l->even || l->law == LEG_STRAIGHT || (l->law == LEG_HALF && x == 0.5)) /* through 0 exactly */
        return x;
    return (double)(l->law == LEG_RISE ? sinl(pi / 2 * x) : (1 - cosl(pi * x)) / 2);
}

static fret_status step_of(runner *r, const leg *l, const fret_step *step) {
    return l->chord ? engine_chord(&r->engine, step) : engine_step(&r->engine, step);
}

static void close_period(runner *r) {
    r->cycle_loss = engine_spent(&r->engine);
    r->closed = true;
}

/* The rest of a leg: whoever looks at the end of a period sees it closed. */
static fret_status step_to_end(runner *r, const leg *l) {
    const fret_status st = step_of(r, l, &l->to);
    if (!st.code && l->closes)
        close_period(r);
    return st;
}

/* Points on the way lie where the step goes: to a displacement straight in (delta_z, delta_x), to a force in
 * (F_N, F_x), whatever the normal target is given by. */
static fret_step as_it_goes(const runner *r, const fret_step *to) {
    fret_step step = *to;
    fret_press press;
    if (to->tangential_by == FRET_TO_DX && to->normal_by == FRET_TO_FORCE && to->normal > 0 &&
        !fret_press_by_force(r->load->normal, to->normal, &press).code) {
        step.normal_by = FRET_TO_DEPTH;
        step.normal = (double)press.dz;
    } else if (to->tangential_by == FRET_TO_FX && to->normal_by == FRET_TO_DEPTH && to->normal > 0 &&
               !fret_press_by_depth(r->load->normal, to->normal, &press).code) {
        step.normal_by = FRET_TO_FORCE;
        step.normal = (double)press.F;
    }
    return step;
}

static fret_status take_watched(runner *r, const leg *l) {
    fret_state from;
    fret_status st = fine;
    double x = r->watch->next(r->watch, l, 0);
    engine_forces(&r->engine, &from);
    const fret_step way_to = x < 1 ? as_it_goes(r, &l->to) : l->to, *to = &way_to;
    /* in double, as targets are: what was asked for is where it begins, and half of the way back is 0 */
    const double n0 = (double)(to->normal_by == FRET_TO_FORCE ? from.FN : from.dz);
    const double t0 = (double)(to->tangential_by == FRET_TO_FX ? from.Fx : from.dx);
    for (; x < 1; x = r->watch->next(r->watch, l, x)) {
        const long double part = (long double)way(l, x);
        fret_step step = *to;
        step.normal = (double)(n0 + (to->normal - n0) * part);
        step.tangential = (double)(t0 + (to->tangential - t0) * part);
        st = step_of(r, l, &step);
        if (!st.code)
            st = look(r, l->begin + (l->end - l->begin) * x, false);
        if (st.code)
            return st;
    }
    st = step_to_end(r, l);
    if (!st.code && x <= 1)
        return look(r, l->end, !l->chord);
    return st;
}

static fret_status take(runner *r, const leg *l) {
    fret_status st = r->watch ? take_watched(r, l) : step_to_end(r, l);
    r->time = l->end;
    return st;
}

/* ---- cycles ------------------------------------------------------------------------------------ */

static fret_tangential_target tangential_by(const load_step *c) {
    return c->tangential == BY_FORCE ? FRET_TO_FX : FRET_TO_DX;
}

/* The two branches at constant F_N. */
static fret_status constant_period(runner *r, const load_step *c) {
    leg l = {.to = {FRET_KEEP_NORMAL, tangential_by(c), 0, 0},
             .law = LEG_HALF,
             .points = c->points ? (c->points + 1) / 2 : 0,
             .even = r->watch && r->watch->next == next_point};
    fret_status st = fine;
    for (int sign = -1; sign <= 1 && !st.code; sign += 2) {
        l.to.tangential = sign * c->tangential_value;
        l.closes = sign > 0;
        l.begin = r->time;
        l.end = r->time + 0.5;
        st = take(r, &l);
    }
    return st;
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* An angle in 0..2 pi. */
static double wrapped(double angle) {
    double turns = angle / (2 * pi);
    return 2 * pi * (turns - floor(turns));
}

/* cos at a rounded angle: 0 where it is below what the rounding moves it by, as the load passes through its
 * mean. */
static double harmonic(long double angle) {
    const double v = (double)cosl(angle);
    return fabs(v) < 4 * DBL_EPSILON ? 0 : v;
}

/* What a swinging period turns about. */
typedef struct swing {
    const load_view *load;
    const load_item *cycle;
    long double FN;
    int sign;
} swing;

/* d/d(angle) of the tangential load + sign x its bound at gross slip; by displacement the bound is mu eta
 * delta_z, which moves with d(F_N)/k_n. */
static fret_real slip_rate(fret_real angle, fret_real *slope, void *about) {
    const swing *w = about;
    const double A = w->cycle->step.tangential_value, FNA = w->cycle->step.normal_value;
    const double phase = w->cycle->extra.phase;
    double bound = w->load->mu * FNA * (double)sinl(angle + phase);
    (void)slope;
    if (w->cycle->step.tangential == BY_DISPLACEMENT) {
        fret_press press;
        const double FN = (double)(w->FN + FNA * cosl(angle + phase));
        if (!(FN > 0) || fret_press_by_force(w->load->normal, FN, &press).code)
            return NAN;
        bound *= (double)(fret_normal_foundation(w->load->normal)->eta /
                          fret_normal_stiffness(w->load->normal, press.a));
    }
    return -A * sinl(angle) - w->sign * bound;
}

enum { SCAN = 64 };

/* Where slip_rate changes its sign: few places, found by a scan. */
static size_t find_turns(swing *w, double node[RUN_NODES], size_t count) {
    fret_real before = slip_rate(0, NULL, w);
    for (int i = 1; i <= SCAN && count < RUN_NODES - 2; i++) {
        const fret_real lo = 2 * pi * (i - 1) / (fret_real)SCAN, hi = 2 * pi * i / (fret_real)SCAN,
                        after = slip_rate(hi, NULL, w);
        if (before * after < 0)
            node[count++] = (double)fret_root(slip_rate, w, lo, hi, lo);
        before = after;
    }
    return count;
}

/* Where F_N, the tangential load, and it + and - its bound turn, in order, 0 and 2 pi among them: between
 * these places the error of chords is clean. */
static size_t find_nodes(swing *w, double node[RUN_NODES]) {
    const double phase = w->cycle->extra.phase;
    size_t count = 0;
    node[count++] = 0;
    node[count++] = pi;
    node[count++] = wrapped(-phase);
    node[count++] = wrapped(pi - phase);
    for (w->sign = -1; w->sign <= 1; w->sign += 2)
        count = find_turns(w, node, count);
    qsort(node, count, sizeof *node, ascending);
    size_t kept = 1;
    for (size_t i = 1; i < count; i++)
        if (node[i] - node[kept - 1] > 1e-9 && 2 * pi - node[i] > 1e-9)
            node[kept++] = node[i];
    node[kept++] = 2 * pi;
    return kept;
}

/* Where whoever looks on looks next, between two angles: a chord ends there, on the sine. */
static double next_look(const runner *r, const leg *period, double from, double to) {
    leg l = *period;
    if (!r->watch)
        return to;
    l.begin = l.origin + from / (2 * pi);
    l.end = l.origin + to / (2 * pi);
    const double x = r->watch->next(r->watch, &l, 0), at = from + (to - from) * x;
    return x < 1 && at - from > 1e-9 && to - at > 1e-9 ? at : to;
}

/* Chords of the harmonic path, from the top of F_x, cut evenly between the nodes and between looks. */
static fret_status chords_period(runner *r, const load_item *c, long double FN) {
    run_place here = {.nodes = 0}, *k = r->watch ? &r->watch->place : &here;
    if (!k->nodes) {
        swing about = {r->load, c, FN, 0};
        k->nodes = find_nodes(&about, k->at);
        k->begin = r->time;
        k->node = k->chord = 0;
        k->from = k->at[0];
    }
    leg l = {.to = {FRET_TO_FORCE, tangential_by(&c->step), 0, 0},
             .chord = true,
             .points = c->step.points ? c->step.points : RUN_CHORDS,
             .origin = k->begin};
    fret_status st = fine;
    for (; k->node + 1 < k->nodes && !st.code; k->node++) {
        const double to = k->at[k->node + 1];
        while (k->from < to && !st.code) {
            const double end = next_look(r, &l, k->from, to), length = end - k->from;
            const unsigned count = (unsigned)(1 + (double)RUN_CHORDS * length / (2 * pi)) << r->level;
            while (k->chord < count && !st.code) {
                if (must_wait(r))
                    return interrupted;
                const double angle = k->from + length * ++k->chord / count;
                l.closes = k->node + 2 == k->nodes && k->chord == count && end == to;
                l.to.tangential =
                    l.closes ? c->step.tangential_value : c->step.tangential_value * harmonic(angle);
                l.to.normal =
                    (double)(FN + c->step.normal_value * harmonic((long double)angle + c->extra.phase));
                l.begin = r->time;
                l.end = k->begin + angle / (2 * pi);
                st = unless_stopped(r, take(r, &l));
            }
            k->from = end;
            k->chord = 0;
        }
    }
    k->nodes = 0;
    return st;
}

/* The sine itself, as far as whoever looks on looks next. */
static fret_status sine_parts(runner *r, const load_item *c, const fret_sine *load, bool *taken) {
    leg l = {.chord = true, .points = c->step.points ? c->step.points : RUN_CHORDS, .origin = r->time};
    double from = 0;
    fret_status st = fine;
    while (from < 2 * pi && !st.code) {
        const double end = next_look(r, &l, from, 2 * pi);
        l.begin = r->time;
        l.end = l.origin + end / (2 * pi);
        st = engine_swing(&r->engine, load, from / (2 * pi), end / (2 * pi), taken);
        if (st.code || !*taken)
            return st;
        if (end == 2 * pi)
            close_period(r);
        r->time = l.end;
        if (r->watch->next(r->watch, &l, 0) <= 1)
            st = look(r, l.end, false);
        from = end;
    }
    return unless_stopped(r, st);
}

static fret_status swinging_period(runner *r, const load_item *c, long double FN) {
    const fret_sine load = {c->step.tangential_value, c->step.normal_value, c->extra.phase, FN};
    const bool sine = r->engine.sine;
    bool taken = false;
    fret_status st = fine;
    if (sine && r->watch)
        st = sine_parts(r, c, &load, &taken);
    else if (sine)
        st = engine_swing(&r->engine, &load, 0, 1, &taken);
    if (taken && !r->watch)
        r->time++;
    if (taken || st.code)
        return st;
    r->chorded = sine; /* this run ends: it must be run in chords from its beginning */
    return sine ? interrupted : chords_period(r, c, FN);
}

fret_status run_period(runner *r, const load_item *c, long double FN) {
    return c->step.normal_value == 0 ? constant_period(r, &c->step) : swinging_period(r, c, FN);
}

/* A state at the end of a period, and what the period dissipated. */
typedef struct lap {
    fret_state state;
    long double loss;
} lap;

/* Do two periods end alike, so that W stays right to 1e-15 where the second stands for `left` more? */
static bool laps_repeat(const lap *a, const lap *b, unsigned left) {
    const long double little = 1e-15L, reach = fabsl(b->state.dx) + fabsl(b->state.dz);
    return a->state.slices == b->state.slices && fabsl(a->state.FN - b->state.FN) <= little * b->state.FN &&
           fabsl(a->state.Fx - b->state.Fx) <= little * fabsl(b->state.Fx) &&
           fabsl(a->state.dx - b->state.dx) <= little * reach &&
           left * fabsl(a->loss - b->loss) <= little * (b->state.W + left * b->loss);
}

/* Until it is done, or one period has repeated the one before twice: the others repeat it too. */
static fret_status run_periods(runner *r, const load_item *c, long double FN) {
    const unsigned times = c->extra.times;
    const bool seen = r->watch && !r->watch->once;
    lap last = {.loss = -1};
    unsigned alike = 0;
    fret_status st = fine;
    r->repeated = 0;
    for (unsigned i = r->watch ? r->watch->place.period : 0; i < times && !st.code; i++) {
        if (r->watch && !r->watch->place.nodes) {
            r->watch->place.period = i;
            if (must_wait(r))
                return interrupted;
        }
        if (!(r->watch && r->watch->place.nodes)) /* else in its midst */
            engine_mark(&r->engine);
        st = unless_stopped(r, run_period(r, c, FN));
        if (r->waits)
            return st;
        close_period(r); /* the sine's, too */
        lap now = {.loss = r->cycle_loss};
        engine_forces(&r->engine, &now.state);
        alike = i > 0 && laps_repeat(&last, &now, times - 1 - i) ? alike + 1 : 0;
        last = now;
        if (!st.code && !seen && alike == 2 && i + 1 < times) {
            r->repeated = times - 1 - i;
            engine_repeat(&r->engine, r->repeated, now.loss);
            r->time += r->repeated;
            break;
        }
    }
    return st;
}

/* From where the load is now to the top of F_x. */
static fret_status first_leg(runner *r, const load_item *c, long double FN) {
    leg l = {.to = {FRET_KEEP_NORMAL, tangential_by(&c->step), 0, c->step.tangential_value},
             .begin = r->time,
             .end = r->time + 0.25,
             .law = LEG_RISE,
             .even = r->watch && r->watch->next == next_point};
    if (c->step.normal_value != 0) {
        l.to.normal_by = FRET_TO_FORCE;
        l.to.normal = (double)(FN + c->step.normal_value * harmonic(c->extra.phase));
        l.law = LEG_STRAIGHT;
    }
    return take(r, &l);
}

static fret_status run_cycle(runner *r, const load_item *c) {
    run_place here = {.within = false}, *k = r->watch ? &r->watch->place : &here;
    fret_status st = fine;
    if (!k->within) {
        fret_state state;
        engine_forces(&r->engine, &state);
        *k = (run_place){.FN = state.FN};
        st = first_leg(r, c, k->FN);
        k->within = !st.code;
    }
    if (!st.code)
        st = run_periods(r, c, k->FN);
    k->within = r->waits;
    if (st.code == FRET_GROSS_SLIP)
        st.quantity = c->step.normal_value == 0 ? "FA" : RUN_FX_OF_CYCLE;
    return st;
}

/* ---- steps ------------------------------------------------------------------------------------- */

static fret_status run_press(runner *r, const load_step *c) {
    leg l = {.to = {c->normal == BY_FORCE ? FRET_TO_FORCE : FRET_TO_DEPTH, FRET_KEEP_DX, c->normal_value, 0},
             .points = 1,
             .begin = r->time,
             .end = r->time};
    if (c->normal == BY_RADIUS) {
        fret_press p;
        fret_status st = fret_press_by_radius(r->load->normal, c->normal_value, &p);
        if (st.code)
            return st;
        l.to.normal = (double)p.dz;
    }
    return take(r, &l);
}

static fret_status run_step(runner *r, const load_step *c) {
    leg l = {.to = {FRET_KEEP_NORMAL, FRET_KEEP_DX, c->normal_value, c->tangential_value},
             .points = c->points,
             .begin = r->time,
             .end = r->time + 1};
    if (!c->normal && (c->relative & RELATIVE_TANGENTIAL) && c->tangential_value == 0) {
        r->time++; /* nothing to do, and rounding must not make it a reversal */
        return fine;
    }
    if (c->normal)
        l.to.normal_by = c->normal == BY_FORCE ? FRET_TO_FORCE : FRET_TO_DEPTH;
    if (c->tangential)
        l.to.tangential_by = c->tangential == BY_FORCE ? FRET_TO_FX : FRET_TO_DX;
    if (c->relative) {
        fret_state now;
        engine_forces(&r->engine, &now);
        if (c->relative & RELATIVE_NORMAL)
            l.to.normal = (double)((c->normal == BY_FORCE ? now.FN : now.dz) + l.to.normal);
        if (c->relative & RELATIVE_TANGENTIAL)
            l.to.tangential = (double)((c->tangential == BY_FORCE ? now.Fx : now.dx) + l.to.tangential);
    }
    return take(r, &l);
}

fret_status run_item(runner *r, const load_item *item) {
    switch ((load_kind)item->step.kind) {
    case LOAD_PRESS:
        return run_press(r, &item->step);
    case LOAD_STEP:
        return run_step(r, &item->step);
    default:
        return run_cycle(r, item);
    }
}

/* At constant F_N only turning points count: a displacement on the way to the next one need not be taken. */
static bool on_the_way(const load_view *load, size_t i) {
    const load_step *step = &load->program->steps[i];
    if (i + 1 >= load->end.steps || !load_is_slide(step) || !load_is_slide(step + 1) ||
        !load_is_slide(step - 1))
        return false;
    const double here = step->tangential_value, last = step[-1].tangential_value,
                 next = step[1].tangential_value;
    return here == next || (last < here && here < next) || (last > here && here > next);
}

fret_status run_to(runner *r, load_mark end) {
    const load_view *load = r->load;
    const bool every = r->watch || r->engine.springs; /* springs round otherwise */
    fret_status st = fine;
    r->waits = false;
    while (r->at.steps < end.steps) {
        if (!(r->watch && r->watch->place.within) && must_wait(r))
            return interrupted;
        const load_step *step = &load->program->steps[r->at.steps];
        const bool passed = !every && on_the_way(load, r->at.steps);
        if (passed) {
            r->time++;
        } else if (step->kind == LOAD_STEP) { /* most of them, and as they are */
            st = run_step(r, step);
        } else {
            load_item item = program_item(load->program, r->at, load->last_cycle, load->in);
            st = run_item(r, &item);
        }
        if (r->waits)
            break;
        st = unless_stopped(r, st);
        if (st.code)
            break;
        r->at.steps++;
        r->at.cycles += step->kind == LOAD_CYCLE;
    }
    return st;
}

double program_time(const program *p, load_mark end) {
    double time = 0;
    size_t cycle = 0;
    for (size_t i = 0; i < end.steps; i++)
        if (p->steps[i].kind == LOAD_STEP)
            time += 1;
        else if (p->steps[i].kind == LOAD_CYCLE)
            time += 0.25 + p->cycles[cycle++].times;
    return time;
}

static long double once(long double coarse, long double fine_one) {
    return fine_one + (fine_one - coarse) / 3;
}

static long double part_of(long double moved, const long double at[LEVELS]) {
    const long double scale = fmaxl(fabsl(once(at[1], at[2])), fabsl(at[2]));
    return scale > 0 ? moved / scale : 0;
}

long double run_limit(const long double at[LEVELS], long double *moved) {
    const long double first = once(at[0], at[1]), last = once(at[1], at[2]), step = (last - first) / 15;
    *moved = part_of(2 * fabsl(step), at);
    return last + step;
}

long double run_unsure(const long double at[LEVELS]) {
    const long double change = once(at[1], at[2]) - once(at[0], at[1]);
    return part_of(fmaxl(2 * fabsl(change), fabsl(at[2] - at[1]) / 256), at);
}

/* A member of the states of all levels, and its limit. Where they differ by rounding of `scale` alone it was
 * asked for: so it stays, 0 above all. */
static void to_limit(const sight at[LEVELS], size_t member, long double scale, fret_state *out) {
    long double v[LEVELS], unused;
    for (unsigned i = 0; i < LEVELS; i++)
        memcpy(&v[i], (const char *)&at[i].state + member, sizeof v[i]);
    v[0] = run_limit(v, &unused);
    if (fabsl(v[LEVELS - 1] - v[LEVELS - 2]) <= 16 * LDBL_EPSILON * scale)
        return;
    memcpy((char *)out + member, &v[0], sizeof v[0]);
}

void sight_limit(const sight at[LEVELS], sight *out) {
    const long double loss[LEVELS] = {at[0].loss, at[1].loss, at[2].loss};
    long double unused;
    out->state = at[LEVELS - 1].state;
    to_limit(at, offsetof(fret_state, W), 0, &out->state);
    to_limit(at, offsetof(fret_state, U), 0, &out->state);
    to_limit(at, offsetof(fret_state, Fx), out->state.FN, &out->state);
    to_limit(at, offsetof(fret_state, dx), out->state.dz, &out->state);
    out->loss = run_limit(loss, &unused);
}

void run_sight(const runner *r, sight *out) {
    sight at[LEVELS] = {{.loss = r->cycle_loss}};
    engine_state(&r->engine, &at[0].state);
    *out = at[0];
    if (!r->coarse)
        return;
    at[LEVELS - 1] = *out;
    memcpy(at, r->coarse, (LEVELS - 1) * sizeof *at);
    sight_limit(at, out);
}
