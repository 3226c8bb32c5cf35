/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs load programs: legs, periods, harmonic normal forces. Uses the library and `number`. */
#include "scene/run.h"

#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "number/array.h"
#include "number/real.h"
#include "number/root.h"

static const double pi = 3.14159265358979323846;

static const fret_status interrupted = {FRET_INTERRUPTED, NULL, 0, 0};

static fret_status unless_stopped(const runner *r, fret_status st) {
    if (r->load->pulse)
        r->load->pulse();
    return !st.code && *r->load->stop ? interrupted : st;
}

/* ---- looks ------------------------------------------------------------------------------------- */

static double next_point(const watch *w, const leg *l, double after) {
    const unsigned points = l->points ? l->points : w->points;
    if (!l->chord)
        return (floor(after * points + 1e-9) + 1) / points;
    /* chords: points of a period, even in time */
    const double length = l->end - l->begin, here = l->begin + after * length - l->origin;
    const double x = ((floor(here * points + 1e-9) + 1) / points + l->origin - l->begin) / length;
    return x > 1 + 1e-9 ? 2 : x > 1 - 1e-9 ? 1 : x;
}

static double next_time(const watch *w, const leg *l) {
    const double t = w->first + w->every * (double)w->sample, little = 1e-9 * w->every;
    const double end = w->turns && !l->chord ? 1 : 2;
    if (w->sample > w->last || t > l->end + little)
        return end;
    if (t > l->end - little)
        return 1;
    return (t - l->begin) / (l->end - l->begin);
}

static double next_part(const watch *w, const leg *l, double after) {
    return l->chord ? 1 : (floor(after * w->points + 1e-9) + 1) / w->points;
}

/* The part of the leg, 0..1, of the next look after the part `after`; > 1: none. */
static double next_look(const watch *w, const leg *l, double after) {
    return w->kind == WATCH_POINTS  ? next_point(w, l, after)
           : w->kind == WATCH_PATH  ? next_part(w, l, after)
           : w->kind == WATCH_TIMES ? next_time(w, l)
                                    : 2;
}

watch watch_points(unsigned points) {
    return (watch){WATCH_POINTS, .points = points};
}

watch watch_path(unsigned points) {
    return (watch){WATCH_PATH, .points = points};
}

watch watch_times(double first, double every, size_t last, bool turns) {
    return (watch){WATCH_TIMES, .first = first, .every = every, .last = last, .turns = turns};
}

static void look(runner *r, double time, bool turning) {
    watch *w = &r->watch;
    r->time = time;
    r->turning = turning;
    while (w->kind == WATCH_TIMES && w->sample <= w->last &&
           w->first + w->every * (double)w->sample <= time + 1e-9 * w->every)
        w->sample++;
}

/* ---- legs -------------------------------------------------------------------------------------- */

/* The part of the load's travel at the part x of the leg's time. */
static double progress(const leg *l, double x) {
    if (l->even || l->law == LEG_STRAIGHT || (l->law == LEG_HALF && x == 0.5)) /* 0.5: through 0 exactly */
        return x;
    return (double)(l->law == LEG_RISE ? sinl(pi / 2 * x) : (1 - cosl(pi * x)) / 2);
}

/* A step in the coordinates in which it is straight: (delta_z, delta_x) if it goes to a displacement, else
 * (F_N, F_x), whichever way the normal target is given. */
static fret_step straight_step(const runner *r, const fret_step *to) {
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

static fret_real at_rig(const runner *r, const fret_state *now) {
    return now->dx + now->Fx / r->load->K_rig;
}

/* Records where a leg starts, rounded to double as targets are, so that half of the way back is exactly 0. */
static void start_leg(runner *r) {
    fret_state from;
    engine_forces(&r->engine, &from);
    r->goal = straight_step(r, &r->leg.to);
    r->n = (double)(r->goal.normal_by == FRET_TO_FORCE ? from.FN : from.dz);
    r->t = (double)(r->leg.rig ? at_rig(r, &from) : r->goal.tangential_by == FRET_TO_FX ? from.Fx : from.dx);
}

static fret_status swing_part(runner *r) {
    const load_step *c = &r->item.step;
    const run_place *k = &r->place;
    const fret_sine load = {c->tangential_value, c->normal_value, r->item.extra.phase, k->FN};
    const fret_status st = engine_swing(&r->engine, &load, k->from / (2 * pi), k->end / (2 * pi));
    r->chorded = st.code == FRET_OUTSIDE; /* the run ends; it must start anew, in chords */
    return r->chorded ? interrupted : st;
}

static fret_status step_of(runner *r, const fret_step *to) {
    fret_step step = *to;
    const fret_status st = r->leg.rig ? engine_at_rig(&r->engine, r->load->K_rig, &step) : status_ok;
    return st.code        ? st
           : r->leg.sine  ? swing_part(r)
           : r->leg.chord ? engine_chord(&r->engine, &step)
                          : engine_step(&r->engine, &step);
}

static fret_status take_part(runner *r, double x) {
    const leg *l = &r->leg;
    if (r->part == 0)
        start_leg(r);
    const long double part = (long double)progress(l, x);
    fret_step step = r->goal;
    step.normal = (double)(r->n + (step.normal - r->n) * part);
    step.tangential = (double)(r->t + (step.tangential - r->t) * part);
    r->part = x;
    return step_of(r, &step);
}

/* Closes the period before the look at its end. */
static void close_period(runner *r) {
    r->cycle_loss = engine_spent(&r->engine);
    engine_close(&r->engine);
    r->closed = r->place.closed = true;
    r->place.within = false;
    r->place.period++;
}

/* Moves along the leg, to its end or the next look (true). */
static bool move(runner *r) {
    const leg *l = &r->leg;
    const double x = next_look(&r->watch, l, r->part);
    const bool inside = x < 1 && !l->sine;
    r->status = inside ? take_part(r, x) : step_of(r, &l->to);
    if (r->status.code)
        return false;
    if (inside) {
        look(r, l->begin + (l->end - l->begin) * x, false);
        return true;
    }
    r->moving = false;
    if (l->closes)
        close_period(r);
    if (x <= 1)
        look(r, l->end, !l->chord);
    r->time = l->end;
    return x <= 1;
}

/* A ramp to a displacement at the rig is straight in (delta_z, delta_x): its end is found first. */
static bool set_leg(runner *r, leg l) {
    if (l.rig && !l.chord && l.to.normal_by != FRET_KEEP_NORMAL) {
        r->status = engine_at_rig(&r->engine, r->load->K_rig, &l.to);
        l.rig = false;
    }
    r->leg = l;
    r->part = 0;
    return r->moving = !r->status.code;
}

/* ---- cycles ------------------------------------------------------------------------------------ */

static fret_tangential_target tangential_by(const load_step *c) {
    return c->tangential == BY_FORCE ? FRET_TO_FX : FRET_TO_DX;
}

/* Starts one of the two branches of a period at constant F_N. */
static bool next_branch(runner *r) {
    const load_step *c = &r->item.step;
    const int sign = r->place.part++ ? 1 : -1;
    return set_leg(r, (leg){.to = {FRET_KEEP_NORMAL, tangential_by(c), 0, sign * c->tangential_value},
                            .rig = c->tangential == BY_RIG,
                            .begin = r->time,
                            .end = r->time + 0.5,
                            .law = LEG_HALF,
                            .points = c->points ? (c->points + 1) / 2 : 0,
                            .even = r->watch.kind == WATCH_POINTS,
                            .closes = sign > 0});
}

/* The angle in 0..2 pi. */
static double wrapped(double angle) {
    double turns = angle / (2 * pi);
    return 2 * pi * (turns - floor(turns));
}

/* cos; 0 where it is below the effect of the angle's rounding, as the load passes its mean. */
static double harmonic(long double angle) {
    const double v = (double)cosl(angle);
    return fabs(v) < 4 * DBL_EPSILON ? 0 : v;
}

/* Context of slip_rate: a harmonic period about the mean FN; sign of the bound. */
typedef struct swing {
    const load_view *load;
    const load_item *cycle;
    long double FN;
    int sign;
} swing;

/* d/d(angle) of the tangential load + sign x its bound at gross slip: mu F_N or, for displacements, mu eta
 * delta_z, which changes by d(F_N)/k_n, plus mu F_N/K_rig at the rig. */
static fret_real slip_rate(fret_real angle, fret_real *slope, void *about) {
    const swing *w = about;
    const double A = w->cycle->step.tangential_value, FNA = w->cycle->step.normal_value;
    const double phase = w->cycle->extra.phase;
    double bound = w->load->mu * FNA * (double)sinl(angle + phase);
    (void)slope;
    if (w->cycle->step.tangential != BY_FORCE) {
        fret_press press;
        const double FN = (double)(w->FN + FNA * cosl(angle + phase));
        if (!(FN > 0) || fret_press_by_force(w->load->normal, FN, &press).code)
            return NAN;
        bound *= (double)(fret_normal_foundation(w->load->normal)->eta /
                          fret_normal_stiffness(w->load->normal, press.a)) +
                 (w->cycle->step.tangential == BY_RIG ? 1 / w->load->K_rig : 0);
    }
    return -A * sinl(angle) - w->sign * bound;
}

enum { SCAN = 64 };

/* Appends the angles where slip_rate changes its sign, found by a scan. */
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

/* The angles, in order and with 0 and 2 pi, where F_N, the tangential load, and this load plus or minus its
 * bound turn: between these nodes the error of chords has a clean order. */
static size_t find_nodes(swing *w, double node[RUN_NODES]) {
    const double phase = w->cycle->extra.phase;
    size_t count = 0;
    node[count++] = 0;
    node[count++] = pi;
    node[count++] = wrapped(-phase);
    node[count++] = wrapped(pi - phase);
    for (w->sign = -1; w->sign <= 1; w->sign += 2)
        count = find_turns(w, node, count);
    qsort(node, count, sizeof *node, fret_ascending);
    size_t kept = 1;
    for (size_t i = 1; i < count; i++)
        if (node[i] - node[kept - 1] > 1e-9 && 2 * pi - node[i] > 1e-9)
            node[kept++] = node[i];
    node[kept++] = 2 * pi;
    return kept;
}

/* Sets the next interval of angles, from the end of the last one to the next node or look. */
static void next_interval(runner *r, leg l) {
    run_place *k = &r->place;
    k->from = k->end;
    if (k->from >= k->at[k->node + 1])
        k->node++;
    const double from = k->from, to = k->at[k->node + 1];
    k->end = to;
    if (r->watch.kind == WATCH_NOTHING)
        return;
    l.begin = l.origin + from / (2 * pi);
    l.end = l.origin + to / (2 * pi);
    const double x = next_look(&r->watch, &l, 0), at = from + (to - from) * x;
    if (x < 1 && at - from > 1e-9 && to - at > 1e-9)
        k->end = at;
}

/* Starts the next chord of the harmonic load, counted from the peak of F_x; chords divide each interval
 * evenly. In sine mode the interval is one piece. */
static bool next_chord(runner *r) {
    run_place *k = &r->place;
    const load_item *c = &r->item;
    leg l = {.to = {FRET_TO_FORCE, tangential_by(&c->step), 0, 0},
             .rig = c->step.tangential == BY_RIG,
             .chord = true,
             .sine = r->engine.sine,
             .points = c->step.points ? c->step.points : RUN_CHORDS,
             .origin = k->begin};
    if (k->part == k->parts) {
        next_interval(r, l);
        k->part = 0;
        k->parts =
            l.sine ? 1 : (unsigned)(1 + (double)RUN_CHORDS * (k->end - k->from) / (2 * pi)) << r->level;
    }
    const double angle = k->from + (k->end - k->from) * ++k->part / k->parts;
    l.closes = k->node + 2 == k->nodes && k->part == k->parts && k->end == k->at[k->node + 1];
    l.to.tangential = l.closes ? c->step.tangential_value : c->step.tangential_value * harmonic(angle);
    l.to.normal = (double)(k->FN + c->step.normal_value * harmonic((long double)angle + c->extra.phase));
    l.begin = r->time;
    l.end = k->begin + (l.sine ? k->end : angle) / (2 * pi);
    return set_leg(r, l);
}

/* Do two periods end equally, so that W is exact to 1e-15 if the second stands for `left` more? */
static bool periods_repeat(const run_view *a, const run_view *b, unsigned left) {
    const long double little = 1e-15L, reach = fabsl(b->state.dx) + fabsl(b->state.dz);
    return a->state.slices == b->state.slices && fabsl(a->state.FN - b->state.FN) <= little * b->state.FN &&
           fabsl(a->state.Fx - b->state.Fx) <= little * fabsl(b->state.Fx) &&
           fabsl(a->state.dx - b->state.dx) <= little * reach &&
           left * fabsl(a->loss - b->loss) <= little * (b->state.W + left * b->loss);
}

/* After two equal repeats of a period counts the remaining ones without running them, but the last if it is
 * looked at. */
static void skip_repeats(runner *r) {
    run_place *k = &r->place;
    const unsigned seen = r->watch.once, times = r->item.extra.times;
    if ((r->watch.kind != WATCH_NOTHING && !r->watch.once) || k->period + seen >= times)
        return;
    const unsigned left = times - k->period - seen;
    run_view now = {.loss = r->cycle_loss};
    engine_forces(&r->engine, &now.state);
    k->alike = k->period > 1 && periods_repeat(&k->last, &now, left) ? k->alike + 1 : 0;
    k->last = now;
    if (k->alike < 2)
        return;
    r->repeated = left;
    engine_repeat(&r->engine, left, now.loss);
    r->time += left;
    k->period += left;
}

/* Starts the leg from the present load to the peak of F_x. */
static bool first_leg(runner *r) {
    const load_item *c = &r->item;
    fret_state now;
    engine_forces(&r->engine, &now);
    r->place = (run_place){.FN = now.FN};
    r->repeated = 0;
    leg l = {.to = {FRET_KEEP_NORMAL, tangential_by(&c->step), 0, c->step.tangential_value},
             .begin = r->time,
             .end = r->time + 0.25,
             .rig = c->step.tangential == BY_RIG,
             .law = LEG_RISE,
             .even = r->watch.kind == WATCH_POINTS};
    if (c->step.normal_value != 0) {
        l.to.normal_by = FRET_TO_FORCE;
        l.to.normal = (double)(now.FN + c->step.normal_value * harmonic(c->extra.phase));
        l.law = LEG_STRAIGHT;
    }
    return set_leg(r, l);
}

static void begin_period(runner *r) {
    run_place *k = &r->place;
    k->within = true;
    k->begin = r->time;
    k->end = 0;
    k->part = k->parts = 0;
    k->node = 0;
    engine_mark(&r->engine);
    if (r->engine.sine) {
        k->nodes = 2;
        k->at[0] = 0;
        k->at[1] = 2 * pi;
    } else if (r->item.step.normal_value != 0) {
        swing about = {r->load, &r->item, k->FN, 0};
        k->nodes = find_nodes(&about, k->at);
    }
}

static bool leg_of_cycle(runner *r) {
    run_place *k = &r->place;
    if (k->closed)
        skip_repeats(r);
    k->closed = false;
    if (!k->within) {
        if (k->period == r->item.extra.times)
            return false;
        begin_period(r);
    }
    return r->item.step.normal_value == 0 ? next_branch(r) : next_chord(r);
}

/* ---- steps ------------------------------------------------------------------------------------- */

static bool leg_of_press(runner *r) {
    const load_step *c = &r->item.step;
    const bool depth = c->normal == BY_DISPLACEMENT || c->normal == BY_RADIUS;
    leg l = {.to = {depth ? FRET_TO_DEPTH : FRET_TO_FORCE, FRET_KEEP_DX, c->normal_value, 0},
             .points = 1,
             .begin = r->time,
             .end = r->time};
    if (c->normal > BY_DISPLACEMENT) {
        fret_press p;
        r->status = press_to(r->load->normal, (load_by)c->normal, c->normal_value, &p);
        if (r->status.code)
            return false;
        l.to.normal = (double)(depth ? p.dz : p.F);
    }
    return set_leg(r, l);
}

static bool leg_of_step(runner *r) {
    const load_step *c = &r->item.step;
    leg l = {.to = {FRET_KEEP_NORMAL, FRET_KEEP_DX, c->normal_value, c->tangential_value},
             .points = c->points,
             .begin = r->time,
             .end = r->time + 1,
             .rig = c->tangential == BY_RIG};
    if (!c->normal && (c->relative & RELATIVE_TANGENTIAL) && c->tangential_value == 0) {
        r->time++; /* nothing to do; rounding must not cause a reversal */
        return false;
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
            l.to.tangential = (double)((l.rig                       ? at_rig(r, &now)
                                        : c->tangential == BY_FORCE ? now.Fx
                                                                    : now.dx) +
                                       l.to.tangential);
    }
    return set_leg(r, l);
}

/* Starts the next leg; false: the item is done, or an error is in r->status. */
static bool next_leg(runner *r) {
    const load_kind kind = (load_kind)r->item.step.kind;
    const bool begun = r->within;
    r->within = true;
    if (begun)
        return kind == LOAD_CYCLE && leg_of_cycle(r);
    return kind == LOAD_PRESS ? leg_of_press(r) : kind == LOAD_STEP ? leg_of_step(r) : first_leg(r);
}

static void begin_item(runner *r, load_item item) {
    r->item = item;
    r->within = r->moving = false;
}

bool run_item_next(runner *r) {
    r->status = status_ok;
    while (!r->status.code && (r->moving || next_leg(r))) {
        const bool seen = move(r);
        r->status = unless_stopped(r, r->status);
        if (seen && !r->status.code)
            return true;
    }
    if (r->item.step.kind != LOAD_CYCLE)
        return false;
    if (r->status.code == FRET_GROSS_SLIP)
        r->status.quantity = r->item.step.normal_value == 0 ? "FA" : RUN_FX_OF_CYCLE;
    if (r->status.code == FRET_NEGATIVE) { /* a leg may go beyond the harmonic load */
        r->status.quantity = RUN_FN_OF_CYCLE;
        r->status.value = (double)(r->place.FN - r->item.step.normal_value);
    }
    return false;
}

fret_status run_item(runner *r, const load_item *item) {
    begin_item(r, *item);
    while (run_item_next(r))
        ;
    return r->status;
}

void run_more(runner *r) {
    r->item.extra.times++;
}

/* At constant F_N only turning points matter: is step i a displacement between its neighbours? */
static bool between_neighbours(const load_view *load, size_t i) {
    const load_step *step = &load->program->steps[i];
    if (i + 1 >= load->end.steps || !load_is_slide(step) || !load_is_slide(step + 1) ||
        !load_is_slide(step - 1) || step[1].tangential != step->tangential ||
        step[-1].tangential != step->tangential)
        return false;
    const double here = step->tangential_value, last = step[-1].tangential_value,
                 next = step[1].tangential_value;
    return here == next || (last < here && here < next) || (last > here && here > next);
}

/* May the step be skipped? Not for springs, whose rounding it changes. */
static bool can_skip(const runner *r) {
    return !r->within && r->watch.kind == WATCH_NOTHING && !r->engine.springs &&
           between_neighbours(r->load, r->at.steps);
}

bool run_next(runner *r, load_mark end) {
    const load_view *load = r->load;
    r->status = status_ok;
    while (r->at.steps < end.steps) {
        if (can_skip(r)) {
            r->time++;
            r->status = unless_stopped(r, status_ok);
        } else {
            if (!r->within)
                begin_item(r, program_item(load->program, r->at, load->last_cycle, load->in));
            if (run_item_next(r))
                return true;
        }
        if (r->status.code)
            return false;
        r->within = false;
        r->at.cycles += load->program->steps[r->at.steps].kind == LOAD_CYCLE;
        r->at.steps++;
    }
    return false;
}

fret_status run_to(runner *r, load_mark end) {
    while (run_next(r, end))
        ;
    return r->status;
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

static long double richardson(long double coarse, long double fine) {
    return fine + (fine - coarse) / 3;
}

/* The change relative to the value. */
static long double part_of(long double moved, const long double at[LEVELS]) {
    const long double scale = fmaxl(fabsl(richardson(at[1], at[2])), fabsl(at[2]));
    return scale > 0 ? moved / scale : 0;
}

long double run_limit(const long double at[LEVELS], long double *moved) {
    const long double first = richardson(at[0], at[1]), last = richardson(at[1], at[2]),
                      step = (last - first) / 15;
    *moved = part_of(2 * fabsl(step), at);
    return last + step;
}

long double run_unsure(const long double at[LEVELS]) {
    const long double change = richardson(at[1], at[2]) - richardson(at[0], at[1]);
    return part_of(fmaxl(2 * fabsl(change), fabsl(at[2] - at[1]) / 256), at);
}

/* Writes the limit of one member of the states at all levels. */
static void to_limit(const run_view at[LEVELS], size_t member, fret_state *out) {
    long double v[LEVELS], unused;
    for (unsigned i = 0; i < LEVELS; i++)
        memcpy(&v[i], (const char *)&at[i].state + member, sizeof v[i]);
    v[0] = run_limit(v, &unused);
    memcpy((char *)out + member, &v[0], sizeof v[0]);
}

static void sight_limit(const run_view at[LEVELS], run_view *out) {
    const long double loss[LEVELS] = {at[0].loss, at[1].loss, at[2].loss};
    long double unused;
    out->state = at[LEVELS - 1].state;
    to_limit(at, offsetof(fret_state, W), &out->state);
    to_limit(at, offsetof(fret_state, U), &out->state);
    to_limit(at, offsetof(fret_state, Fx), &out->state);
    to_limit(at, offsetof(fret_state, dx), &out->state);
    out->loss = run_limit(loss, &unused);
}

void run_view_now(const runner run[], unsigned levels, run_view *out) {
    run_view at[LEVELS];
    unsigned i = 0;
    do {
        engine_state(&run[i].engine, &at[i].state);
        at[i].loss = run[i].cycle_loss;
    } while (++i < levels);
    *out = at[0];
    if (levels > 1)
        sight_limit(at, out);
}

void runs_end(runner run[], unsigned *levels) {
    while (*levels)
        engine_end(&run[--*levels].engine);
}
