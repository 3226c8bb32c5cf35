/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Times of the library next to a baseline in the same run: lines "what|figure|baseline|ratio|limit", the name
 * of a group before its lines, and sentences on what they show after "= ". */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "fret/fret.h"

/* Of the processor, so that a busy machine does no harm. */
static double seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void need(fret_status st) {
    if (!st.code)
        return;
    char text[200];
    fret_status_text(&st, text, sizeof text);
    fprintf(stderr, "bench: %s\n", text);
    exit(EXIT_FAILURE);
}

static const fret_material material = {{{210e9, 0.3, false}, {210e9, 0.3, false}}, 0.3, 1e-3};
static const fret_gap gap = {.kind = FRET_GAP_POWER, .terms = 1, .power = {{2, 50, 1}}};
static const double mu = 0.4, FN = 100;
static volatile double sink;

/* A load that never repeats: two incommensurate swings. */
static double drive(long i) {
    return 0.55 * sin(0.37 * (double)i) + 0.4 * sin(0.0113 * (double)i);
}

/* The usual discretisation: springs at equal distances, each clipped in every step. */
enum { SPRINGS = 1000 };
static double spring_scheme(const fret_normal *n, const fret_press *p, long steps, bool loss) {
    static double weight[SPRINGS], bound[SPRINGS], u[SPRINGS];
    const fret_foundation *f = fret_normal_foundation(n);
    double k1 = 1 + (double)f->k, a = (double)p->a, dx = (double)(mu * f->eta * p->dz);
    double cT = 2 * (double)(f->cT0 * powl(f->c0, -f->k));
    for (int i = 0; i < SPRINGS; i++) {
        double lo = a * i / (double)SPRINGS, hi = a * (i + 1) / (double)SPRINGS, mid = (lo + hi) / 2;
        weight[i] = cT * (pow(hi, k1) - pow(lo, k1)) / k1;
        bound[i] = dx * (1 - mid * mid / (a * a));
        u[i] = 0;
    }
    double old = 0, W = 0, F = 0, best = INFINITY;
    for (int run = 0; run < 10; run++) {
        double t0 = seconds();
        for (long s = 0; s < steps; s++) {
            double x = dx * drive(s), d = x - old;
            old = x;
            F = 0;
            for (int i = 0; i < SPRINGS; i++) {
                double v = u[i] + d, c = v > bound[i] ? bound[i] : v < -bound[i] ? -bound[i] : v;
                if (loss)
                    W += weight[i] * c * (v - c);
                F += weight[i] * c;
                u[i] = c;
            }
            sink = F + W;
        }
        best = fmin(best, (seconds() - t0) / (double)steps);
    }
    return best;
}

enum { LOADS = 4096 };

/* A step of the memory diagram at constant F_N. */
static double memory_diagram(const fret_normal *n, const fret_press *p, bool loss) {
    static double load[LOADS];
    const double slip = (double)fret_gross_slip(&(fret_pressed){n, mu, *p});
    double best = INFINITY;
    fret_contact *m = NULL;
    need(fret_contact_make(n, mu, FRET_EXACT, &m));
    fret_step step = {FRET_TO_FORCE, FRET_TO_DX, FN, 0};
    need(fret_contact_step(m, &step));
    step.normal_by = FRET_KEEP_NORMAL;
    for (long i = 0; i < LOADS; i++)
        load[i] = slip * drive(i);
    for (int run = 0; run < 100; run++) {
        double t0 = seconds();
        for (long i = 0; i < LOADS; i++) {
            fret_state st;
            step.tangential = load[i];
            need(fret_contact_step(m, &step));
            fret_contact_forces(m, &st);
            sink = (double)(st.Fx + (loss ? fret_contact_last_loss(m) : 0));
        }
        best = fmin(best, (seconds() - t0) / (double)LOADS);
    }
    fret_contact_free(m);
    return best;
}

/* A round of 200 steps in which both directions move, a step: of FRET_EXACT, or of FRET_DOUBLE with the
 * loss or without. */
typedef enum diagram { EXACT, DOUBLE, DOUBLE_LOSS } diagram;
static double moving(const fret_normal *n, const fret_press *p, bool by_force, diagram kind) {
    enum { STEPS = 200, ROUNDS = 10 };
    const double pi = acos(-1), normal = by_force ? FN : (double)p->dz,
                 tangential = by_force ? mu * FN : (double)fret_gross_slip(&(fret_pressed){n, mu, *p});
    static fret_step load[STEPS];
    double best = INFINITY;
    fret_contact *exact = NULL;
    fret_contact *fast = NULL;
    need(fret_contact_make(n, mu, FRET_EXACT, &exact));
    need(fret_contact_make(n, mu, FRET_DOUBLE, &fast));
    fret_contact_count_loss(fast, kind == DOUBLE_LOSS);
    for (int i = 0; i < STEPS; i++)
        load[i] = (fret_step){by_force ? FRET_TO_FORCE : FRET_TO_DEPTH, by_force ? FRET_TO_FX : FRET_TO_DX,
                              normal * (0.7 + 0.2 * sin(2 * pi * i / (double)STEPS)),
                              tangential * 0.4 * cos(2 * pi * i / (double)STEPS)};
    for (int run = 0; run < 40; run++) {
        double t0 = seconds();
        for (int round = 0; round < ROUNDS; round++)
            for (const fret_step *to = load; to < load + STEPS; to++) {
                if (kind == EXACT) {
                    fret_state st;
                    need(fret_contact_step(exact, to));
                    fret_contact_forces(exact, &st);
                    sink = (double)st.Fx;
                } else {
                    fret_state now;
                    if (fret_contact_step(fast, to).code)
                        exit(EXIT_FAILURE);
                    fret_contact_forces(fast, &now);
                    sink = (double)now.Fx;
                }
            }
        best = fmin(best, (seconds() - t0) / (ROUNDS * STEPS));
    }
    fret_contact_free(exact);
    fret_contact_free(fast);
    return best;
}

/* A thousand contacts whose histories lie with a dynamics code, each of some doubles: one contact of the
 * library takes a history, makes a step and gives it back. Without `kept` each has a contact of its own. */
enum { CONTACTS = 1000, ROOM = 256 };
static double thousand(const fret_normal *n, const fret_press *p, fret_exactness exactness, bool kept) {
    enum { STEPS = 40 };
    static double history[CONTACTS][ROOM];
    static size_t size[CONTACTS];
    static fret_contact *own[CONTACTS];
    const double slip = (double)fret_gross_slip(&(fret_pressed){n, mu, *p});
    double best = INFINITY;
    for (int i = 0; i < (kept ? 1 : CONTACTS); i++) {
        need(fret_contact_make(n, mu, exactness, &own[i]));
        need(fret_contact_step(own[i], &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, FN, 0}));
    }
    for (int i = 0; i < CONTACTS && kept; i++)
        need(fret_contact_pack(own[0], history[i], ROOM, &size[i]));
    for (int run = 0; run < 10; run++) {
        double t0 = seconds();
        for (long s = 0; s < STEPS; s++)
            for (int i = 0; i < CONTACTS; i++) {
                fret_contact *at = own[kept ? 0 : i];
                fret_state now;
                if (kept)
                    need(fret_contact_unpack(at, history[i], size[i]));
                need(fret_contact_step(
                    at, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_DX, 0, slip * drive(7 * i + s)}));
                fret_contact_forces(at, &now);
                sink = (double)now.Fx;
                if (kept)
                    need(fret_contact_pack(at, history[i], ROOM, &size[i]));
            }
        best = fmin(best, (seconds() - t0) / (STEPS * CONTACTS));
    }
    for (int i = 0; i < (kept ? 1 : CONTACTS); i++)
        fret_contact_free(own[i]);
    return best;
}

/* Springs of the library, a spring and step: the least of some runs. */
static double library_springs(const fret_normal *n, const fret_press *p, size_t count, long steps,
                              bool by_force) {
    const double slip = (double)(mu * fret_normal_foundation(n)->eta * p->dz);
    double best = INFINITY, load[256];
    fret_springs *s = NULL;
    for (long i = 0; i < 256; i++)
        load[i] = (by_force ? mu * FN : slip) * drive(i);
    fret_step step = {FRET_TO_FORCE, FRET_KEEP_DX, FN, 0};
    need(fret_springs_make(n, mu, count, (double)p->a * (1 + 1e-9), FRET_WEIGHT_CELL, &s));
    need(fret_springs_step(s, &step, 1));
    step.normal_by = FRET_KEEP_NORMAL;
    step.tangential_by = by_force ? FRET_TO_FX : FRET_TO_DX;
    for (int run = 0; run < 5; run++) {
        double t0 = seconds();
        for (long i = 0; i < steps; i++) {
            step.tangential = load[i % 256];
            need(fret_springs_step(s, &step, 1));
        }
        best = fmin(best, (seconds() - t0) / (double)steps / (double)count);
    }
    fret_springs_free(s);
    return best;
}

/* The same under swinging forces, 200 steps a round. */
static double swinging_springs(const fret_normal *n, const fret_press *p, size_t count) {
    enum { STEPS = 200 };
    const double pi = acos(-1);
    double best = INFINITY;
    fret_springs *s = NULL;
    need(fret_springs_make(n, mu, count, 1.1 * (double)p->a, FRET_WEIGHT_CELL, &s));
    for (int run = 0; run < 20; run++) {
        double t0 = seconds();
        for (int i = 0; i < STEPS; i++)
            need(fret_springs_step(s,
                                   &(fret_step){FRET_TO_FORCE, FRET_TO_FX,
                                                FN * (1 + 0.3 * sin(2 * pi * i / (double)STEPS)),
                                                20 * cos(2 * pi * i / (double)STEPS)},
                                   1));
        best = fmin(best, (seconds() - t0) / (double)STEPS / (double)count);
    }
    fret_springs_free(s);
    return best;
}

/* The diagram in double at constant F_N, a step; `nested` turning points are held all the time. */
static fret_contact *pressed(const fret_normal *n) {
    fret_contact *d = NULL;
    need(fret_contact_make(n, mu, FRET_DOUBLE, &d));
    need(fret_contact_step(d, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, FN, 0}));
    return d;
}

static fret_state pushed(fret_contact *d, double dx) {
    fret_state now;
    need(fret_contact_step(d, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_DX, 0, dx}));
    fret_contact_forces(d, &now);
    return now;
}

static double constant(const fret_normal *n, const fret_press *p, bool loss, long nested) {
    static double load[LOADS];
    const double slip = (double)fret_gross_slip(&(fret_pressed){n, mu, *p});
    double best = INFINITY, size = 1;
    fret_contact *d = pressed(n);
    fret_contact_count_loss(d, loss);
    for (long i = 0; i < nested; i++, size *= 1 - 2 / (double)nested)
        pushed(d, (i % 2 ? -0.99 : 0.99) * size * slip);
    for (long i = 0; i < LOADS; i++)
        load[i] = size * slip * drive(i);
    for (int run = 0; run < 50; run++) {
        double t0 = seconds();
        for (long i = 0; i < LOADS; i++) {
            const fret_state now = pushed(d, load[i]);
            sink = (double)(now.Fx + now.W);
        }
        best = fmin(best, (seconds() - t0) / (double)LOADS);
    }
    fret_contact_free(d);
    return best;
}

/* A cycle of displacement amplitude 0.7 delta_x,max: its loss [J] and the time for one. */
typedef struct cycle {
    double loss, time;
} cycle;

static double amplitude(const fret_normal *n, const fret_press *p) {
    return 0.7 * (double)fret_gross_slip(&(fret_pressed){n, mu, *p});
}

static cycle diagram_cycle(const fret_normal *n, const fret_press *p) {
    const double dA = amplitude(n, p);
    const long cycles = 20000;
    cycle c = {0, INFINITY};
    fret_contact *d = pressed(n);
    for (int run = 0; run < 10; run++) {
        double t0 = seconds();
        for (long i = 0; i < 2 * cycles; i++) {
            (void)pushed(d, i % 2 ? -dA : dA);
            c.loss = 2 * (double)fret_contact_last_loss(d);
        }
        c.time = fmin(c.time, (seconds() - t0) / (double)cycles);
    }
    fret_contact_free(d);
    return c;
}

static cycle memory_cycle(const fret_normal *n, const fret_press *p) {
    const double dA = amplitude(n, p);
    const long cycles = 20000;
    cycle c = {0, INFINITY};
    fret_contact *m = NULL;
    need(fret_contact_make(n, mu, FRET_EXACT, &m));
    fret_step step = {FRET_TO_FORCE, FRET_KEEP_DX, FN, 0};
    need(fret_contact_step(m, &step));
    step = (fret_step){FRET_KEEP_NORMAL, FRET_TO_DX, 0, 0};
    for (int run = 0; run < 5; run++) {
        double t0 = seconds();
        for (long i = 0; i < 2 * cycles; i++) {
            step.tangential = i % 2 ? -dA : dA;
            need(fret_contact_step(m, &step));
            c.loss = 2 * (double)fret_contact_last_loss(m);
        }
        c.time = fmin(c.time, (seconds() - t0) / (double)cycles);
    }
    fret_contact_free(m);
    return c;
}

/* By the friction work of springs, two steps a cycle. */
static cycle springs_cycle(const fret_normal *n, const fret_press *p, size_t count) {
    const double dA = amplitude(n, p);
    const long cycles = count < 100000 ? (long)(1000000 / count) + 2 : 2;
    cycle c = {0, INFINITY};
    fret_springs *s = NULL;
    fret_state before, after;
    fret_step step = {FRET_TO_FORCE, FRET_KEEP_DX, FN, 0};
    need(fret_springs_make(n, mu, count, (double)p->a * (1 + 1e-9), FRET_WEIGHT_CELL, &s));
    need(fret_springs_step(s, &step, 1));
    for (int run = 0; run < 6; run++) {
        fret_springs_state(s, &before);
        double t0 = seconds();
        for (long i = 0; i < 2 * cycles; i++) {
            step = (fret_step){FRET_KEEP_NORMAL, FRET_TO_DX, 0, i % 2 ? -dA : dA};
            need(fret_springs_step(s, &step, 1));
        }
        c.time = fmin(c.time, (seconds() - t0) / (double)cycles);
        fret_springs_state(s, &after);
        c.loss = (double)((after.W - before.W) / (fret_real)cycles);
    }
    fret_springs_free(s);
    return c;
}

/* By the area of the loop (21), the trapezoidal rule over `count` steps of the diagram in double. */
static cycle area_cycle(const fret_normal *n, const fret_press *p, size_t count) {
    const double dA = amplitude(n, p);
    double *load = malloc(count * sizeof *load), x = dA;
    cycle c = {0, INFINITY};
    fret_contact *d = pressed(n);
    if (!load)
        exit(EXIT_FAILURE);
    for (size_t i = 0; i < count; i++)
        load[i] = dA * cos(2 * acos(-1) * (double)(i + 1) / (double)count);
    fret_contact_count_loss(d, false);
    pushed(d, -dA);
    double Fx = (double)pushed(d, dA).Fx;
    for (int run = 0; run < 5; run++) {
        double area = 0, t0 = seconds();
        for (size_t i = 0; i < count; i++) {
            const double Fx1 = (double)pushed(d, load[i]).Fx;
            area += (Fx + Fx1) / 2 * (load[i] - x);
            x = load[i];
            Fx = Fx1;
        }
        c.time = fmin(c.time, seconds() - t0);
        c.loss = area;
    }
    fret_contact_free(d);
    free(load);
    return c;
}

/* The least size, by doubling, that gives the loss of a cycle to `error`; 2^23 of them at most. */
static cycle to_error(cycle (*model)(const fret_normal *, const fret_press *, size_t), const fret_normal *n,
                      const fret_press *p, double error, size_t *count) {
    fret_real exact;
    cycle c = {0, 0};
    need(fret_cycle_loss_by_displacement(&(fret_pressed){n, mu, *p}, amplitude(n, p), &exact));
    for (*count = 8; *count <= (size_t)1 << 23; *count *= 2) {
        c = model(n, p, *count);
        if (fabs((double)(c.loss / exact - 1)) <= error)
            break;
    }
    return c;
}

static double least(double (*run)(const fret_normal *, const fret_press *), const fret_normal *n,
                    const fret_press *p) {
    double best = INFINITY;
    for (int i = 0; i < 20; i++)
        best = fmin(best, run(n, p));
    return best;
}

/* From material, gap and load to the loading curve and dW. */
static double scene(const fret_normal *normal, const fret_press *press) {
    const long count = 5000;
    double t0 = seconds();
    for (long i = 0; i < count; i++) {
        fret_normal *n;
        fret_pressed c = {.mu = mu};
        fret_loading f;
        fret_real loss;
        fret_material m = material;
        m.k = (double)fret_normal_foundation(normal)->k + 1e-9 * (double)i;
        need(fret_normal_make(&m, &gap, NULL, NULL, &n));
        c.normal = n;
        need(fret_press_by_force(n, (double)press->F, &c.press));
        need(fret_loading_by_force(&c, 20, &f));
        need(fret_cycle_loss_by_force(&c, 20, &loss));
        fret_normal_free(n);
        sink = (double)(f.c + loss);
    }
    return (seconds() - t0) / (double)count;
}

static double cycle_loss(const fret_normal *n, const fret_press *p) {
    const long count = 50000;
    const fret_pressed c = {n, mu, *p};
    double t0 = seconds();
    for (long i = 0; i < count; i++) {
        fret_real loss;
        need(fret_cycle_loss_by_force(&c, mu * FN * (0.5 + (double)i) / (double)count, &loss));
        sink = (double)loss;
    }
    return (seconds() - t0) / (double)count;
}

static double power(const fret_normal *n, const fret_press *p) {
    const long count = 50000;
    const fret_real q = 2 / (3 + fret_normal_foundation(n)->k); /* n/(n+k+1) */
    double t0 = seconds();
    for (long i = 0; i < count; i++)
        sink = (double)powl((fret_real)(i + 1) * p->F / (fret_real)count, q);
    return (seconds() - t0) / (double)count;
}

/* The same in double, one after the other. */
static double double_power(const fret_normal *n, const fret_press *p) {
    const long count = 50000;
    const double q = 2 / (3 + (double)fret_normal_foundation(n)->k);
    double best = INFINITY;
    for (int run = 0; run < 20; run++) {
        double t0 = seconds(), x = 0.5;
        for (long i = 0; i < count; i++)
            x = pow((double)p->F * (0.5 + x * 1e-9), q) * 1e-3;
        sink = x;
        best = fmin(best, (seconds() - t0) / (double)count);
    }
    return best;
}

/* What a sweep costs a point: the least of several runs over an array that stays in the cache, each long
 * enough for the clock of the processor, which is set right by some microseconds now and then. */
enum { POINTS = 1000, PASSES = 20, RUNS = 100 };
typedef enum sweep { LOG_EXP, LOSS_ALL, RADIUS_ALL, LOADING_ALL, PRESS_ALL } sweep;
static double sweep_point(const fret_normal *n, const fret_press *p, sweep kind) {
    static double F[POINTS], x[POINTS], y[POINTS];
    double best = INFINITY;
    for (int i = 0; i < POINTS; i++)
        F[i] = mu * FN * (0.5 + i) / (double)POINTS;
    const fret_pressed c = {n, mu, *p};
    for (int run = 0; run < RUNS; run++) {
        double t0 = seconds();
        for (int pass = 0; pass < PASSES; pass++) {
            if (kind == LOG_EXP)
                for (int i = 0; i < POINTS; i++)
                    x[i] = exp(0.37 * log(F[i]));
            else if (kind == LOSS_ALL)
                need(fret_arrays_loss(&c, F, x, POINTS));
            else if (kind == RADIUS_ALL)
                need(fret_arrays_loading(&c, F, x, NULL, POINTS));
            else if (kind == LOADING_ALL)
                need(fret_arrays_loading(&c, F, x, y, POINTS));
            else
                need(fret_arrays_press(n, F, x, y, POINTS));
            sink = x[pass];
        }
        best = fmin(best, (seconds() - t0) / (PASSES * POINTS));
    }
    return best;
}

/* A load that swings in F_N and F_x, 90 degrees apart: a chord of 200 a period, and a period of the sine
 * itself. */
static const double FNA = 30, FA = 20;
static double swinging_chord(const fret_normal *n, bool in_phase) {
    const double pi = acos(-1), phase = in_phase ? 0 : pi / 2;
    double best = INFINITY, load[200][2];
    fret_contact *m = NULL;
    for (int i = 0; i < 200; i++) {
        load[i][0] = FN + FNA * cos(2 * pi * i / 200 + phase);
        load[i][1] = FA * cos(2 * pi * i / 200);
    }
    need(fret_contact_make(n, mu, FRET_EXACT, &m));
    for (int run = 0; run < 20; run++) {
        double t0 = seconds();
        for (int i = 0; i < 10 * 200; i++) {
            const double *to = load[i % 200];
            need(fret_contact_step(m, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, to[0], to[1]}));
            sink = (double)fret_contact_last_loss(m);
        }
        best = fmin(best, (seconds() - t0) / (10 * 200));
    }
    fret_contact_free(m);
    return best;
}

static double swinging_period(const fret_normal *n) {
    const fret_sine sine = {FA, FNA, acos(-1) / 2, FN};
    double best = INFINITY;
    fret_contact *m = NULL;
    need(fret_contact_make(n, mu, FRET_EXACT, &m));
    need(fret_contact_step(m, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, FN, 0}));
    need(fret_contact_step(m, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, FN + FNA * cos(sine.phase), FA}));
    for (int run = 0; run < 20; run++) {
        double t0 = seconds();
        need(fret_contact_swing(m, &sine, 0, 1));
        sink = (double)fret_contact_last_loss(m);
        best = fmin(best, seconds() - t0);
    }
    fret_contact_free(m);
    return best;
}

/* The pressure at a place, over the contact. */
static double pressure_value(const fret_normal *n, const fret_press *p) {
    const int count = 200;
    fret_field *field;
    need(fret_field_of_press(n, p, &field));
    double t0 = seconds();
    for (int i = 1; i < count; i++) {
        fret_real value;
        need(fret_field_pressure(field, p->a * i / count, &value));
        sink = (double)value;
    }
    t0 = seconds() - t0;
    fret_field_free(field);
    return t0 / (count - 1);
}

/* The surface up to three radii from the centre. */
static double surface_value(const fret_normal *n, const fret_press *p) {
    const int count = 200;
    fret_field *field;
    need(fret_field_of_press(n, p, &field));
    double t0 = seconds();
    for (int i = 1; i < count; i++) {
        fret_real value;
        need(fret_field_surface(field, p->a * (1 + 2.0 * i / count), &value));
        sink = (double)value;
    }
    t0 = seconds() - t0;
    fret_field_free(field);
    return t0 / (count - 1);
}

/* To make one. */
static double field_made(const fret_normal *n, const fret_press *p) {
    const int count = 100;
    const double t0 = seconds();
    for (int i = 0; i < count; i++) {
        fret_field *field;
        need(fret_field_of_press(n, p, &field));
        fret_field_free(field);
    }
    return (seconds() - t0) / count;
}

static const double ns = 1e9, us = 1e6;

static int places(double value, int digits) { /* so that all digits before the point are there */
    const int before = value > 0 ? (int)floor(log10(value)) + 1 : 1;
    return before < digits ? digits - before : 0;
}

static void line(const char *what, double value, double base, const char *base_name, double unit,
                 const char *limit) {
    const char *name = unit == ns ? "ns" : "us";
    value *= unit;
    base *= unit;
    printf("%s|%.*f %s|%.*f %s, %s|%.3g|%s\n", what, places(value, 3), value, name, places(base, 3), base,
           name, base_name, value / base, limit);
}

enum { ERRORS = 3 };

/* Lines for the loss of a cycle to 1e-3, 1e-6 and 1e-9, by a closed form that takes `time`; how many times as
 * long the other model takes. */
static void equal_error(const fret_normal *n, const fret_press *p, const char *name, double time,
                        cycle (*model)(const fret_normal *, const fret_press *, size_t), const char *size,
                        double times[ERRORS]) {
    for (int i = 0; i < ERRORS; i++) {
        char what[60], base[60];
        size_t count;
        const cycle c = to_error(model, n, p, pow(10, -3 * (i + 1)), &count);
        times[i] = c.time / time;
        snprintf(what, sizeof what, "%s, dW to 1e-%d", name, 3 * (i + 1));
        snprintf(base, sizeof base, "%zu %s", count, size);
        line(what, time, c.time, base, us, "");
    }
}

static void compare(const fret_normal *n, const fret_press *p) {
    const struct {
        const char *name, *words;
        double time;
    } ours[] = {{"FRET_DOUBLE", "contact in double", diagram_cycle(n, p).time},
                {"FRET_EXACT", "exact contact", memory_cycle(n, p).time}};
    for (int i = 0; i < 2; i++) {
        double springs[ERRORS], area[ERRORS];
        equal_error(n, p, ours[i].name, ours[i].time, springs_cycle, "springs", springs);
        equal_error(n, p, ours[i].name, ours[i].time, area_cycle, "steps of loop area", area);
        printf("= To an error of 1e-3, 1e-6, 1e-9 in the loss of a cycle the %s is ", ours[i].words);
        for (int j = 0; j < ERRORS; j++)
            printf("%.*f%s", places(springs[j], 2), springs[j],
                   j < ERRORS - 1 ? ", " : " times as fast as springs");
        for (int j = 0; j < ERRORS; j++)
            printf("%s%.*f", j ? ", " : " and ", places(area[j], 2), area[j]);
        puts(" times as fast as the area of the loop.");
    }
}

/* ---- gaps without a formula --------------------------------------------------------------------- */

enum { GAP_ROWS = 400, MANY_ROWS = 100000, GAP_CHORDS = 200 };

/* dW at one load after the other, and a chord of a swinging load. */
static double gap_losses(const fret_normal *n, long count) {
    fret_pressed c = {.normal = n, .mu = mu};
    fret_real loss;
    need(fret_press_by_force(n, FN, &c.press));
    const double t0 = seconds();
    for (long i = 0; i < count; i++) {
        need(fret_cycle_loss_by_force(&c, mu * FN * (double)(i + 1) / (double)(count + 1), &loss));
        sink = (double)loss;
    }
    return (seconds() - t0) / (double)count;
}

static double gap_chord(const fret_normal *n, long count) {
    fret_contact *m = NULL;
    fret_step step = {FRET_TO_FORCE, FRET_KEEP_DX, FN, 0};
    need(fret_contact_make(n, mu, FRET_EXACT, &m));
    need(fret_contact_step(m, &step));
    step.tangential_by = FRET_TO_FX;
    const double t0 = seconds();
    for (long i = 1; i <= count; i++) {
        const double angle = 2 * 3.14159265358979 * (double)i / (double)GAP_CHORDS;
        step.normal = FN * (0.9 + 0.1 * cos(angle));
        step.tangential = mu * FN / 2 * sin(angle);
        need(fret_contact_step(m, &step));
    }
    const double t = (seconds() - t0) / (double)count;
    fret_contact_free(m);
    return t;
}

/* Large steps of depth and displacement at random: edge and front cross whatever the gap has. */
static double gap_steps(const fret_normal *n, long count) {
    fret_contact *m = NULL;
    fret_press most;
    unsigned long long state = 1;
    need(fret_press_by_force(n, FN, &most));
    need(fret_contact_make(n, mu, FRET_EXACT, &m));
    const double dz = (double)most.dz, dx = mu * dz * (double)fret_normal_foundation(n)->eta;
    const double t0 = seconds();
    for (long i = 0; i < count; i++) {
        double part[2];
        for (int j = 0; j < 2; j++) {
            state = state * 6364136223846793005ull + 1442695040888963407ull;
            part[j] = (double)(state >> 11) / 9007199254740992.0;
        }
        need(fret_contact_step(m, &(fret_step){FRET_TO_DEPTH, FRET_TO_DX, dz * (0.05 + 0.95 * part[0]),
                                               dx * (2 * part[1] - 1)}));
    }
    const double t = (seconds() - t0) / (double)count;
    fret_contact_free(m);
    return t;
}

/* Laws like one, each of another R. */
static double like_laws(const fret_normal *n, fret_gap gap_of_R, long count) {
    const double t0 = seconds();
    for (long i = 0; i < count; i++) {
        fret_normal *other;
        gap_of_R.R *= 1.001;
        need(fret_normal_make(&material, &gap_of_R, n, NULL, &other));
        fret_normal_free(other);
    }
    return (seconds() - t0) / (double)count;
}

static double reference_losses(const fret_normal *n, long count) {
    fret_pressed c = {.normal = n, .mu = mu};
    fret_loading peak;
    fret_real loss, unused;
    need(fret_press_by_force(n, FN, &c.press));
    const double t0 = seconds();
    for (long i = 0; i < count; i++) {
        need(fret_loading_by_force(&c, mu * FN * (double)(i + 1) / (double)(count + 1), &peak));
        need(fret_cycle_loss_by_definition(&c, &peak, &loss, &unused));
        sink = (double)loss;
    }
    return (seconds() - t0) / (double)count;
}

/* few: losses for the baseline. */
static void other_gap(const char *name, const fret_gap *of, const fret_normal *hertz, long few) {
    char what[80];
    fret_normal *n;
    const double t0 = seconds();
    need(fret_normal_make(&material, of, NULL, NULL, &n));
    const double setting_up = seconds() - t0, one = reference_losses(n, few);
    double loss = INFINITY, chord[2] = {INFINITY, INFINITY}, step[2] = {INFINITY, INFINITY};
    for (int run = 0; run < 5; run++) {
        loss = fmin(loss, gap_losses(n, 2000));
        for (int i = 0; i < 2; i++) {
            chord[i] = fmin(chord[i], gap_chord(i ? hertz : n, GAP_CHORDS));
            step[i] = fmin(step[i], gap_steps(i ? hertz : n, 1000));
        }
    }
    snprintf(what, sizeof what, "%s: dW", name);
    line(what, loss, one, "quadrature of its definition", us, of->table ? "4 us" : "2 us");
    snprintf(what, sizeof what, "%s: a swinging chord", name);
    line(what, chord[0], chord[1], "Hertz", us, "10 us");
    snprintf(what, sizeof what, "%s: a large step of dz and dx", name);
    line(what, step[0], step[1], "Hertz", us, "10 us");
    snprintf(what, sizeof what, "%s: to set up", name);
    line(what, setting_up, one, "one dW by its definition", us, of->table ? "" : "4 ms");
    snprintf(what, sizeof what, "%s: of another R", name);
    if (!of->table)
        line(what, like_laws(n, *of, 1000), setting_up, "to set up", us, "20 us");
    fret_normal_free(n);
}

/* As a file of so many digits has them. */
static struct fret_table *sphere_rows(int count, int digits) {
    static double r[MANY_ROWS], f[MANY_ROWS];
    struct fret_table *rows = NULL;
    for (int i = 0; i < count; i++) {
        r[i] = 0.3e-3 * i / (count - 1);
        f[i] = r[i] * r[i] / (10e-3 + sqrt(1e-4 - r[i] * r[i]));
        char text[40];
        snprintf(text, sizeof text, "%.*g", digits, f[i]);
        f[i] = strtod(text, NULL);
    }
    need(fret_table_make(r, f, (size_t)count, NULL, &rows));
    return rows;
}

static void gap_rows(const char *name, int count, int digits, const fret_normal *hertz) {
    const fret_gap table = {.kind = FRET_GAP_TABLE, .table = sphere_rows(count, digits)};
    other_gap(name, &table, hertz, 2);
    fret_table_free((struct fret_table *)table.table);
}

static void other_gaps(const fret_normal *hertz) {
    const fret_gap sphere = {.kind = FRET_GAP_EXACT_SPHERE, .R = 10e-3},
                   rounded = {.kind = FRET_GAP_FLAT_ROUNDED, .b = 0.1e-3, .R = 10e-3};
    other_gap("exact-sphere", &sphere, hertz, 20);
    other_gap("flat-rounded", &rounded, hertz, 20);
    gap_rows("400 rows", GAP_ROWS, 17, hertz);
    gap_rows("1e5 rows", MANY_ROWS, 17, hertz);
    gap_rows("1e5 rows of nine digits", MANY_ROWS, 9, hertz);
}

/* Fields of a state of three slices: inside up to the edge, outside up to three radii. */
enum field { FIELD_P, FIELD_QX, FIELD_UZ, FIELD_UX, FIELDS };

static double field_values(enum field what, const fret_field *f, const fret_contact *m, int count) {
    fret_state now;
    fret_contact_state(m, &now);
    const double t0 = seconds();
    for (int i = 1; i <= count; i++) {
        const fret_real part = (i - 0.5L) / count, in = now.a * part, out = now.a * (1 + 2 * part);
        fret_real value = 0;
        if (what == FIELD_P)
            need(fret_field_pressure(f, in, &value));
        else if (what == FIELD_QX)
            need(fret_field_traction(f, in, &value));
        else if (what == FIELD_UZ)
            need(fret_field_surface(f, out, &value));
        else
            need(fret_field_surface_x(f, out, &value));
        sink = (double)value;
    }
    return (seconds() - t0) / count;
}

static void gap_fields(const char *name, const fret_gap *of, double one_power) {
    static const char *const words[] = {"p(r)", "qx(r)", "uz(r) outside", "ux(r) outside"};
    const double push[] = {0.6, 0.1};
    fret_normal *n;
    fret_contact *m;
    fret_field *field = NULL;
    char what[80];
    need(fret_normal_make(&material, of, NULL, NULL, &n));
    need(fret_contact_make(n, mu, FRET_EXACT, &m));
    need(fret_contact_step(m, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, FN, 0}));
    for (int i = 0; i < 2; i++)
        need(fret_contact_step(m, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_FX, 0, push[i] * mu * FN}));
    double making = INFINITY;
    for (int run = 0; run < 5; run++) {
        fret_field_free(field);
        const double t0 = seconds();
        need(fret_field_make(m, &field));
        making = fmin(making, seconds() - t0);
    }
    for (enum field f = FIELD_P; f < FIELDS; f++) {
        double best = INFINITY;
        for (int run = 0; run < 5; run++)
            best = fmin(best, field_values(f, field, m, 200));
        snprintf(what, sizeof what, "%s: %s", name, words[f]);
        line(what, best, one_power, "one powl", us, "5 us");
    }
    snprintf(what, sizeof what, "%s: to make it", name);
    line(what, making, one_power, "one powl", us, "");
    fret_field_free(field);
    fret_contact_free(m);
    fret_normal_free(n);
}

static void fields_of_gaps(double one_power) {
    const fret_gap cone = {.kind = FRET_GAP_FLAT_CONE, .b = 0.1e-3, .slope = 0.02},
                   paraboloid = {.kind = FRET_GAP_FLAT_PARABOLOID, .b = 0.1e-3, .R = 10e-3},
                   rounded = {.kind = FRET_GAP_FLAT_ROUNDED, .b = 0.1e-3, .R = 10e-3};
    fret_gap few = {.kind = FRET_GAP_TABLE, .table = sphere_rows(GAP_ROWS, 17)},
             many = {.kind = FRET_GAP_TABLE, .table = sphere_rows(MANY_ROWS, 17)};
    gap_fields("flat-cone", &cone, one_power);
    gap_fields("flat-paraboloid", &paraboloid, one_power);
    gap_fields("flat-rounded", &rounded, one_power);
    gap_fields("400 rows", &few, one_power);
    gap_fields("1e5 rows", &many, one_power);
    fret_table_free((struct fret_table *)few.table);
    fret_table_free((struct fret_table *)many.table);
}

int main(void) {
    fret_normal *n;
    fret_press p;
    need(fret_normal_make(&material, &gap, NULL, NULL, &n));
    need(fret_press_by_force(n, FN, &p));
    const double plain = spring_scheme(n, &p, 2000, true), one = plain / (double)SPRINGS;
    puts("A step of the memory diagram");
    line("F_x", memory_diagram(n, &p, false), spring_scheme(n, &p, 2000, false), "1000 springs", ns, "");
    line("F_x and loss", memory_diagram(n, &p, true), plain, "1000 springs", ns, "");
    puts("A step of the diagram in double at constant F_N");
    line("F_x", constant(n, &p, false, 0), plain, "1000 springs", ns, "40 ns");
    line("F_x and loss", constant(n, &p, true, 0), plain, "1000 springs", ns, "120 ns");
    line("F_x, 10^4 turning points", constant(n, &p, false, 10000), plain, "1000 springs", ns, "40 ns");
    line("F_x and loss, 10^4 turning points", constant(n, &p, true, 10000), plain, "1000 springs", ns,
         "120 ns");
    puts("A step of the diagram in double, both directions moving");
    fret_material even = material;
    fret_normal *hertz;
    fret_press q;
    even.k = 0;
    need(fret_normal_make(&even, &gap, NULL, NULL, &hertz));
    need(fret_press_by_force(hertz, FN, &q));
    const double exact = moving(n, &p, false, EXACT), exact_hertz = moving(hertz, &q, false, EXACT),
                 by_force = moving(n, &p, true, EXACT);
    line("dz and dx: F_x", moving(n, &p, false, DOUBLE), exact, "FRET_EXACT", ns, "60 ns");
    line("dz and dx: F_x and loss", moving(n, &p, false, DOUBLE_LOSS), exact, "FRET_EXACT", ns, "120 ns");
    line("dz and dx, Hertz: F_x", moving(hertz, &q, false, DOUBLE), exact_hertz, "FRET_EXACT", ns, "25 ns");
    line("dz and dx, Hertz: F_x and loss", moving(hertz, &q, false, DOUBLE_LOSS), exact_hertz, "FRET_EXACT",
         ns, "60 ns");
    line("FN and Fx: dx and loss", moving(n, &p, true, DOUBLE_LOSS), by_force, "FRET_EXACT", ns, "300 ns");
    line("two powers, the least that F_x takes", 2 * double_power(n, &p), double_power(n, &p), "libm pow", ns,
         "");
    fret_normal_free(hertz);
    puts("A spring and step of fret_springs");
    line("1000 springs", library_springs(n, &p, SPRINGS, 2000, false), one, "plain loop in double", ns,
         "10 ns");
    line("1000 springs, by force", library_springs(n, &p, SPRINGS, 2000, true), one,
         "plain loop by displacement", ns, "");
    line("10^4 springs, FN and Fx swing", swinging_springs(n, &p, 10000), one, "plain loop by displacement",
         ns, "");
    puts("A thousand contacts, a step of one");
    for (int i = 0; i < 2; i++) {
        const fret_exactness exactness = i ? FRET_EXACT : FRET_DOUBLE;
        line(i ? "packed histories, exact" : "packed histories, double", thousand(n, &p, exactness, true),
             thousand(n, &p, exactness, false), "a contact each", ns, "");
    }
    puts("The loss of a cycle at equal error");
    compare(n, &p);
    puts("Closed forms");
    const double one_power = least(power, n, &p), closed = least(cycle_loss, n, &p);
    line("scene, material to dW", least(scene, n, &p), one_power, "one powl", us, "5 us");
    line("fret_cycle_loss", closed, one_power, "one powl", ns, "");
    puts("A load of a sweep");
    const double pair = sweep_point(n, &p, LOG_EXP);
    const char *libm = "libm log and exp";
    line("dW, an array", sweep_point(n, &p, LOSS_ALL), pair, libm, ns, "10 ns");
    line("c, an array", sweep_point(n, &p, RADIUS_ALL), pair, libm, ns, "");
    line("c and dx, an array", sweep_point(n, &p, LOADING_ALL), pair, libm, ns, "");
    line("a and dz, an array", sweep_point(n, &p, PRESS_ALL), pair, libm, ns, "");
    puts("A gap without a formula");
    other_gaps(n);
    puts("A swinging normal force");
    const double chord = swinging_chord(n, false);
    line("a chord of 200", chord, one_power, "one powl", us, "0.3 us");
    line("a chord of 200, in phase", swinging_chord(n, true), one_power, "one powl", us, "0.3 us");
    line("a period of the sine itself", swinging_period(n), 200 * chord, "200 chords", us, "2000 us");
    puts("A local field");
    line("p(r)", least(pressure_value, n, &p), one_power, "one powl", us, "5 us");
    line("uz(r) outside", least(surface_value, n, &p), one_power, "one powl", us, "5 us");
    line("to make it", least(field_made, n, &p), one_power, "one powl", us, "");
    const fret_gap sphere = {.kind = FRET_GAP_EXACT_SPHERE, .R = 10e-3};
    fret_normal *ball;
    need(fret_normal_make(&material, &sphere, NULL, NULL, &ball));
    need(fret_press_by_force(ball, FN, &q));
    line("exact-sphere: p(r)", least(pressure_value, ball, &q), one_power, "one powl", us, "5 us");
    line("exact-sphere: uz(r) outside", least(surface_value, ball, &q), one_power, "one powl", us, "5 us");
    fields_of_gaps(one_power);
    fret_normal_free(ball);
    fret_normal_free(n);
    return EXIT_SUCCESS;
}
