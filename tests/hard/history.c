/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Long and lopsided histories. At constant F_N a contact obeys Masing's rules, so that the state after any
 * number of reversals is a sum over branches, and W a sum over closed loops (rainflow counting), each from
 * the oracle. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hard.h"

enum { DEEP = 4096, MEMO = 8, CHECKPOINTS = 16 };

/* A branch of amplitude r: the response and the loss of a whole cycle of that amplitude. */
typedef struct branch {
    double r;
    mpfr_t response, loss, c;
} branch;

typedef struct masing {
    oracle *o; /* pressed, with friction */
    bool by_force;
    double turn[DEEP]; /* turning points not yet forgotten, then the present place */
    int count;
    mpfr_t closed; /* W of what is forgotten */
    branch memo[MEMO];
    unsigned next;
} masing;

static void masing_make(masing *m, oracle *o, bool by_force) {
    *m = (masing){.o = o, .by_force = by_force};
    mpfr_init2(m->closed, 256);
    mpfr_set_zero(m->closed, 1);
    for (int i = 0; i < MEMO; i++)
        mpfr_inits2(256, m->memo[i].response, m->memo[i].loss, m->memo[i].c, (mpfr_ptr)0);
}

static void masing_free(masing *m) {
    mpfr_clear(m->closed);
    for (int i = 0; i < MEMO; i++)
        mpfr_clears(m->memo[i].response, m->memo[i].loss, m->memo[i].c, (mpfr_ptr)0);
}

static const branch *branch_of(masing *m, double r) {
    for (int i = 0; i < MEMO; i++)
        if (m->memo[i].r == r)
            return &m->memo[i];
    branch *b = &m->memo[m->next++ % MEMO];
    b->r = r;
    if (m->by_force)
        oracle_load_force(m->o, r);
    else
        oracle_load_displacement(m->o, r);
    mpfr_set(b->response, oracle_value(m->o, m->by_force ? ORACLE_DX_OF_FX : ORACLE_FX_OF_DX), MPFR_RNDN);
    mpfr_set(b->loss, oracle_value(m->o, m->by_force ? ORACLE_DW_OF_FX : ORACLE_DW_OF_DX), MPFR_RNDN);
    mpfr_set(b->c, oracle_value(m->o, m->by_force ? ORACLE_C_OF_FX : ORACLE_C_OF_DX), MPFR_RNDN);
    return b;
}

/* W += loss of a cycle of amplitude r, over 2^shift. */
static void add_loss(masing *m, mpfr_ptr W, double r, unsigned shift) {
    mpfr_t part;
    mpfr_init2(part, 256);
    mpfr_div_2ui(part, branch_of(m, r)->loss, shift, MPFR_RNDN);
    mpfr_add(W, W, part, MPFR_RNDN);
    mpfr_clear(part);
}

static void masing_go(masing *m, double x) {
    while (m->count) {
        double last = m->turn[m->count - 1], before = m->count > 1 ? m->turn[m->count - 2] : 0;
        double way = x - last, old = last - before;
        if (way == 0)
            return;
        if ((way > 0) == (old > 0)) { /* farther on the same branch */
            m->count--;
        } else if (m->count > 1 && fabs(way) >= fabs(old)) { /* closes a loop */
            add_loss(m, m->closed, fabs(old) / 2, 0);
            m->count -= 2;
        } else if (m->count == 1 &&
                   fabs(x) >= fabs(last)) { /* back to the first loading curve, on the other side */
            add_loss(m, m->closed, fabs(last), 1);
            m->count = 0;
        } else {
            break;
        }
    }
    if (m->count == DEEP)
        abort();
    m->turn[m->count++] = x;
}

static void masing_state(masing *m, mpfr_ptr response, mpfr_ptr W, mpfr_ptr c) {
    mpfr_t part;
    mpfr_init2(part, 256);
    mpfr_set(W, m->closed, MPFR_RNDN);
    mpfr_set_zero(response, 1);
    for (int i = 0; i < m->count; i++) {
        double way = m->turn[i] - (i ? m->turn[i - 1] : 0), r = fabs(way) / (i ? 2 : 1);
        const branch *b = branch_of(m, r);
        mpfr_mul_si(part, b->response, (way < 0 ? -1 : 1) * (i ? 2 : 1), MPFR_RNDN);
        mpfr_add(response, response, part, MPFR_RNDN);
        mpfr_set(c, b->c, MPFR_RNDN);
        add_loss(m, W, r, i ? 1 : 2);
    }
    mpfr_clear(part);
}

/* --- the table --- */

enum { HELD, RESPONSE, STICK, WORK, LAST, COLUMNS };

typedef struct outcome {
    double ulps[COLUMNS];
    unsigned long steps;
    size_t slices;
} outcome;

static void keep(outcome *out, int column, double got, mpfr_srcptr exact) {
    double ulps = oracle_ulps(got, exact);
    if (!(ulps <= out->ulps[column]))
        out->ulps[column] = isnan(ulps) ? INFINITY : ulps;
}

static void row(const char *contact, const char *name, const outcome *out) {
    unsigned long good[2] = {0, 0};
    printf("%-10s %-26s %9lu", contact, name, out->steps);
    for (int i = 0; i < COLUMNS; i++) {
        printf(out->ulps[i] < 100 ? " %8.3f" : " %8.1e", out->ulps[i]);
        if (i != LAST) /* of a step far smaller than the load the loss is lost in the rounding of the load */
            good[out->ulps[i] <= HARD_ULPS]++;
    }
    printf(" %7zu\n", out->slices);
    hard_case(contact, name, good[1], good[0]);
}

/* --- histories at constant F_N --- */

/* Turning points are even multiples of limit 2^-52, so that halves of their differences are exact doubles. */
static double on_grid(double x, double limit) {
    double unit = ldexp(1, ilogb(limit) - 51);
    return unit * nearbyint(x / unit);
}

typedef struct history {
    const char *name;
    bool by_force;
    unsigned shorter; /* steps are divided by this */
    double outer;     /* first turning point and end of the history, over the limit */
    double inner;     /* amplitude of the cycles at the outer point, over the limit; 0: full cycles */
    bool random;      /* random turning points inside, back to both ends now and then */
} history;

static const history histories[] = {
    {"Fx: cycles", true, 1, 0.6, 0, false},
    {"Fx: cycles 1e-12 at 0.7", true, 2, 0.7, 1e-12, false},
    {"Fx: cycles 1e-6 at 0.99", true, 10, 0.99, 1e-6, false},
    {"Fx: to 1-1e-15 of gross", true, 10, 1 - 1e-15, 0, false},
    {"Fx: to gross slip", true, 10, 1, 0, false},
    {"Fx: random, nested", true, 100, 0.9, 0, true},
    {"dx: cycles", false, 1, 0.6, 0, false},
    {"dx: cycles 1e-12 at 0.7", false, 10, 0.7, 1e-12, false},
    {"dx: to 1-1e-9 of gross", false, 10, 1 - 1e-9, 0, false},
    {"dx: slides", false, 2, 3, 0, false},
    {"dx: random, nested", false, 100, 0.9, 0, true},
};

typedef struct specimen {
    const char *name;
    oracle_contact contact;
    double mu, a;
    unsigned shorter;
} specimen;

static const specimen specimens[] = {
    {"Hertz", {{210e9, 210e9}, {0.3, 0.3}, {false, false}, 0, 1e-3, 2, 5e-7, 1e-4}, 0.3, 1.1e-4, 1},
    {"graded", {{210e9, 7e6}, {0.3, 0.5}, {false, false}, 0.5, 1e-3, 1, 5e-7, 1e-4}, 0.7, 7e-5, 10},
    {"k > -1", {{1e9, 1}, {-0.999, 0}, {false, true}, 1e-9 - 1, 1e-6, 3, 1e-9, 1e-6}, 0.1, 1.3e-6, 10},
    {"k > 1", {{1e9, 1}, {0.5, 0}, {false, true}, 1 - 1e-9, 1e-6, 2, 1e-9, 1e-6}, 0.1, 1.3e-6, 10},
    {"n > 0", {{1e9, 1}, {0.2, 0}, {false, true}, -0.5, 1e-6, 1e-3, 1e-9, 1e-6}, 0.1, 1.3e-6, 10},
    {"n > inf", {{1e9, 1}, {0.2, 0}, {false, true}, 0.5, 1e-6, 1e4, 1e-9, 1e-6}, 0.1, 1e-6, 10},
};

typedef struct fixture {
    const specimen *specimen;
    oracle *o;
    double F;
    fret_normal *normal;
} fixture;

static fixture fixture_make(const specimen *b) {
    fixture f = {.specimen = b, .o = oracle_new()};
    fret_material material;
    fret_gap gap;
    hard_contact(&b->contact, &material, &gap);
    if (fret_normal_make(&material, &gap, NULL, NULL, &f.normal).code)
        abort();
    oracle_set_contact(f.o, &b->contact);
    oracle_press_radius(f.o, b->a);
    f.F = mpfr_get_d(oracle_value(f.o, ORACLE_F_OF_A), MPFR_RNDN);
    oracle_press_force(f.o, f.F);
    oracle_friction(f.o, b->mu);
    return f;
}

static fret_contact *pressed(const fixture *f) {
    fret_contact *m;
    if (fret_contact_make(f->normal, f->specimen->mu, FRET_EXACT, &m).code ||
        fret_contact_step(m, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, f->F, 0}).code)
        abort();
    return m;
}

/* Turning point number i: even ones are the outer end, where states are compared. */
static double place(const history *h, unsigned long i, double outer, double inner, double limit,
                    hard_random *r) {
    enum { SPAN = 64 };
    if (h->random) {
        unsigned long j = i % SPAN;
        return j == 0              ? outer
               : j == 1            ? -outer
               : hard_choice(r, 4) ? on_grid((2 * hard_uniform(r) - 1) * outer, limit)
                                   : on_grid((1 - hard_scale(r, -30, 0)) * outer, limit);
    }
    return i % 2 == 0 ? outer : h->inner > 0 ? outer - 2 * inner : -outer;
}

static void run_history(const fixture *f, const history *h, unsigned long steps) {
    double limit =
        h->by_force ? f->specimen->mu * f->F : mpfr_get_d(oracle_value(f->o, ORACLE_DX_MAX), MPFR_RNDN);
    double outer = h->outer == 1 ? limit : on_grid(h->outer * limit, limit);
    double inner = on_grid(h->inner * limit, limit);
    masing *exact = malloc(sizeof *exact);
    if (!exact)
        abort();
    masing_make(exact, f->o, h->by_force);
    mpfr_t response, W, old_W, c, held;
    mpfr_inits2(256, response, W, old_W, c, held, (mpfr_ptr)0);
    fret_contact *m = pressed(f);
    hard_random r = hard_seed(steps);
    outcome out = {.steps = steps};
    bool refused = false;
    unsigned long check = 0, every = (steps + CHECKPOINTS - 1) / CHECKPOINTS;
    for (unsigned long i = 0; i <= steps; i++) {
        double x = place(h, i, outer, inner, limit, &r);
        bool compare = x == outer && (i >= check || i + 64 > steps);
        if (compare)
            masing_state(exact, response, old_W, c);
        masing_go(exact, x);
        if (fret_contact_step(m, &(fret_step){FRET_KEEP_NORMAL, h->by_force ? FRET_TO_FX : FRET_TO_DX, 0, x})
                .code)
            refused = true;
        if (!compare)
            continue;
        check = i + every;
        fret_state s;
        fret_contact_state(m, &s);
        masing_state(exact, response, W, c);
        mpfr_sub(old_W, W, old_W, MPFR_RNDN);
        mpfr_set_d(held, x, MPFR_RNDN);
        keep(&out, HELD, (double)(h->by_force ? s.Fx : s.dx), held);
        keep(&out, RESPONSE, (double)(h->by_force ? s.dx : s.Fx), response);
        keep(&out, STICK, (double)s.c, c);
        keep(&out, WORK, (double)s.W, W);
        keep(&out, LAST, (double)fret_contact_last_loss(m), old_W);
        out.slices = s.slices > out.slices ? s.slices : out.slices;
    }
    if (refused)
        out.ulps[HELD] = INFINITY;
    row(f->specimen->name, h->name, &out);
    fret_contact_free(m);
    masing_free(exact);
    free(exact);
    mpfr_clears(response, W, old_W, c, held, (mpfr_ptr)0);
}

/* A swinging normal force has no closed form: the loop has settled after its second round, and then every
 * round must bring the same state and add the same loss. Compared where F_x is largest: nothing cancels in
 * dx. */
static void run_swing(const fixture *f, unsigned long steps) {
    static const double turn[4][2] = {{0.8, 0}, {0.6, -0.2}, {0.9, 0}, {1, 0.3}}; /* FN/F, Fx/(mu F) */
    enum { SETTLED = 4 };
    fret_contact *m = pressed(f);
    fret_state s, first = {0};
    outcome out = {.steps = steps};
    mpfr_t want, loss;
    mpfr_inits2(256, want, loss, (mpfr_ptr)0);
    bool refused = false;
    fret_real W = 0;
    for (unsigned long round = 0; round < steps / 4; round++) {
        fret_real last = 0;
        for (int i = 0; i < 4; i++) {
            if (fret_contact_step(m, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, turn[i][0] * f->F,
                                                  turn[i][1] * f->specimen->mu * f->F})
                    .code)
                refused = true;
            last += fret_contact_last_loss(m);
        }
        if (round < SETTLED)
            continue;
        fret_contact_state(m, &s);
        out.slices = s.slices > out.slices ? s.slices : out.slices;
        if (round == SETTLED) {
            first = s;
            W = last;
        }
        mpfr_set_ld(want, first.Fx, MPFR_RNDN);
        keep(&out, HELD, (double)s.Fx, want);
        mpfr_set_ld(want, first.dx, MPFR_RNDN);
        keep(&out, RESPONSE, (double)s.dx, want);
        mpfr_set_ld(want, first.c, MPFR_RNDN);
        keep(&out, STICK, (double)s.c, want);
        mpfr_set_ld(loss, W, MPFR_RNDN);
        keep(&out, LAST, (double)last, loss);
        mpfr_mul_ui(loss, loss, round - SETTLED, MPFR_RNDN);
        mpfr_set_ld(want, first.W, MPFR_RNDN);
        mpfr_add(want, want, loss, MPFR_RNDN);
        keep(&out, WORK, (double)s.W, want);
    }
    if (refused)
        out.ulps[HELD] = INFINITY;
    row(f->specimen->name, "FN and Fx swing", &out);
    mpfr_clears(want, loss, (mpfr_ptr)0);
    fret_contact_free(m);
}

void hard_histories(unsigned long steps) {
    enum { LEAST = 200, MOST_RANDOM = 100000 };
    printf("%-10s %-26s %9s %8s %8s %8s %8s %8s %7s\n", "contact", "history, worst ulp of", "steps", "held",
           "other", "c", "W", "last dW", "slices");
    for (size_t i = 0; i < sizeof specimens / sizeof *specimens; i++) {
        fixture f = fixture_make(&specimens[i]);
        for (size_t j = 0; j < sizeof histories / sizeof *histories; j++) {
            unsigned long count = steps / specimens[i].shorter / histories[j].shorter / 64 * 64;
            if (histories[j].random && count > MOST_RANDOM)
                count = MOST_RANDOM / 64 * 64;
            run_history(&f, &histories[j], count > LEAST ? count : 256);
        }
        unsigned long count = steps / specimens[i].shorter / 100;
        run_swing(&f, count > LEAST ? count : LEAST);
        oracle_free(f.o);
        fret_normal_free(f.normal);
    }
    printf("\n");
}
