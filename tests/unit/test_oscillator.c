/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A contact as an element of a dynamic model: one mass on a frictional, graded contact.
 *
 *        m x'' = P(t) - F_x,   F_N = F_N(t)
 *
 * The contact takes the displacement of the mass and the normal load of the day, and gives back F_x:
 * two calls a step, fret_contact_step and fret_contact_forces. Time goes by velocity Verlet. The books
 * must balance:
 *
 *        kinetic + stored in the contact + dissipated = work of P
 *
 * for any F_N(t), whose own work goes into the normal contact, and the error shrinks with the square of the
 * time step. */
#include "unit.h"

/* glibc lets a program take the place of malloc and friends: here they count their calls. */
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define SANITIZED 1
#endif
#endif
#ifndef SANITIZED
#define COUNTS_CALLS 1
#endif
#endif

static unsigned long calls;

#ifdef COUNTS_CALLS
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *old, size_t size);

void *malloc(size_t size) {
    calls++;
    return __libc_malloc(size);
}

void *calloc(size_t count, size_t size) {
    calls++;
    return __libc_calloc(count, size);
}

void *realloc(void *old, size_t size) {
    calls++;
    return __libc_realloc(old, size);
}
#endif

static const double pi = 3.14159265358979323846;

/* ---- The model: a mass, its contact, and what drives them. ---- */

typedef struct drive {
    double P, frequency; /* tangential force P sin(2 pi frequency t) [N], [Hz] */
    double FN, swing;    /* normal load FN (1 + swing sin(...)) [N], at 0.37 of the frequency */
} drive;

typedef struct oscillator {
    double mass;  /* [kg] */
    double x, v;  /* displacement [m] and velocity [m/s] of the mass */
    double force; /* F_x, by which the contact holds it back [N] */
    double work;  /* done by P since the start [J] */
    fret_contact *contact;
} oscillator;

static double pull_at(const drive *d, double t) {
    return d->P * sin(2 * pi * d->frequency * t);
}

static double load_at(const drive *d, double t) {
    return d->FN * (1 + d->swing * sin(0.37 * 2 * pi * d->frequency * t));
}

/* Moves the contact to a displacement under a load and returns the force it answers with. Displacement
 * control: the mass may slide away, and the contact then holds back by mu F_N. */
static fret_status contact_force(fret_contact *contact, double FN, double x, double *force) {
    const fret_step step = {FRET_TO_FORCE, FRET_TO_DX, FN, x};
    fret_state now;
    fret_status st = fret_contact_step(contact, &step);
    if (st.code)
        return st;                      /* the contact is as before */
    fret_contact_forces(contact, &now); /* fret_contact_state has energies and stiffness too */
    *force = (double)now.Fx;
    return st;
}

/* One step of velocity Verlet. The contact remembers: it is stepped once per time step. */
static fret_status verlet(oscillator *o, const drive *d, double t, double dt) {
    const double before = pull_at(d, t), after = pull_at(d, t + dt), x = o->x;
    const double half = o->v + dt / 2 * (before - o->force) / o->mass;
    o->x += dt * half;
    fret_status st = contact_force(o->contact, load_at(d, t + dt), o->x, &o->force);
    if (st.code)
        return st;
    o->v = half + dt / 2 * (after - o->force) / o->mass;
    o->work += (before + after) / 2 * (o->x - x);
    return st;
}

/* One implicit step (average acceleration), for a stiff model: guesses the end, asks the contact, and goes
 * back to try again with a better guess until the guess stands. `saved` is a second contact to go back to;
 * a copy allocates only where it holds fewer slices than ever before. */
static fret_status implicit(oscillator *o, fret_contact *saved, const drive *d, double t, double dt,
                            double tolerance, int *tries) {
    const double before = pull_at(d, t), after = pull_at(d, t + dt), x0 = o->x, v0 = o->v;
    const double a0 = (before - o->force) / o->mass;
    double x = x0 + dt * v0 + dt * dt / 2 * a0, force = o->force;
    fret_status st = fret_contact_copy(saved, o->contact);
    for (*tries = 1; !st.code; ++*tries) {
        st = contact_force(o->contact, load_at(d, t + dt), x, &force);
        if (st.code)
            break;
        const double a = (after - force) / o->mass;
        const double miss = x0 + dt * v0 + dt * dt / 4 * (a0 + a) - x;
        if (fabs(miss) <= tolerance || *tries >= 50)
            break;
        fret_state end;
        fret_contact_state(o->contact, &end);
        x += miss / (1 + dt * dt / 4 * (double)end.kt / o->mass); /* Newton with the contact's stiffness */
        st = fret_contact_copy(o->contact, saved);
    }
    if (st.code) /* leaves the model as it was; of equal size, so that this cannot fail */
        return fret_contact_copy(o->contact, saved), st;
    o->work += (before + after) / 2 * (x - x0);
    o->v = v0 + dt / 2 * (a0 + (after - force) / o->mass);
    o->x = x;
    o->force = force;
    return st;
}

/* ---- A graded contact and a mass whose own frequency on it is 1 kHz. ---- */

typedef struct rig {
    oscillator mass;
    fret_contact *saved;
    double slip; /* delta_x,max at the mean load */
    const fret_normal *normal;
    double mu;
} rig;

static rig make_rig(const drive *d) {
    const fret_material graded = {.body = {{.E0 = 210e9, .nu = 0.3}, {.rigid = true}}, .k = 0.4, .c0 = 1e-3};
    const fret_gap sphere = {
        .kind = FRET_GAP_POWER, .terms = 1, .power = {{.n = 2, .h = 1 / (2 * 0.01), .r0 = 1}}};
    rig r = {.normal = unit_keep_normal(&graded, &sphere), .mu = 0.4};
    fret_press press;
    fret_state start;
    CHECK_OK(fret_press_by_force(r.normal, d->FN, &press));
    if (!CHECK(fret_contact_make(r.normal, r.mu, FRET_EXACT, &r.mass.contact).code == FRET_OK) ||
        !CHECK(fret_contact_make(r.normal, r.mu, FRET_EXACT, &r.saved).code == FRET_OK))
        exit(unit_finish());
    r.slip = (double)fret_gross_slip(&(fret_pressed){r.normal, r.mu, press});
    CHECK_OK(contact_force(r.mass.contact, load_at(d, 0), 0, &r.mass.force));
    fret_contact_state(r.mass.contact, &start);
    const double omega = 2 * pi * 1000;
    r.mass.mass = (double)start.kt / (omega * omega);
    return r;
}

static void drop(rig *r) {
    fret_contact_free(r->mass.contact);
    fret_contact_free(r->saved);
}

static double energy(const oscillator *o) {
    fret_state s;
    fret_contact_state(o->contact, &s);
    return o->mass * o->v * o->v / 2 + (double)(s.U + s.W);
}

static const double duration = 20e-3; /* 20 periods of the mass */

/* What is missing in the books, as a root mean square over the run, by the work done. */
static double imbalance(const drive *d, int steps, bool by_implicit) {
    rig r = make_rig(d);
    fret_state s;
    double dt = duration / steps, sum = 0;
    fret_real dissipated = 0;
    int tries, most = 0;
    for (int i = 0; i < steps; i++) {
        if (by_implicit)
            CHECK_OK(implicit(&r.mass, r.saved, d, i * dt, dt, 1e-12 * r.slip, &tries));
        else
            CHECK_OK(verlet(&r.mass, d, i * dt, dt));
        most = by_implicit && tries > most ? tries : most;
        fret_contact_forces(r.mass.contact, &s);
        CHECK(s.W >= dissipated); /* the second law, at every step */
        dissipated = s.W;
        const double miss = energy(&r.mass) - r.mass.work;
        sum += miss * miss;
    }
    CHECK(most < 50);
    const double error = sqrt(sum / steps) / (double)dissipated;
    if (getenv("FRET_UNIT_VERBOSE"))
        printf("%s, P = %g N, %d steps: imbalance %.2e of %.3Le J dissipated, at most %d tries, %zu slices\n",
               by_implicit ? "implicit" : "Verlet", d->P, steps, error, dissipated, most, s.slices);
    drop(&r);
    return error;
}

static void test_ledger(void) {
    /* partial slip, and hard enough to slide */
    static const drive drives[] = {{8, 700, 100, 0}, {30, 900, 100, 0}};
    for (size_t i = 0; i < sizeof drives / sizeof *drives; i++)
        for (int by_implicit = 0; by_implicit < 2; by_implicit++) {
            double coarse = imbalance(&drives[i], 2000, by_implicit),
                   fine = imbalance(&drives[i], 8000, by_implicit);
            CHECK(fine < 1e-3);
            CHECK_ABS(log(coarse / fine) / log(4), 2, 1, 0.3L);
        }
}

/* With F_N changing: springs that part are unstressed by then, new ones begin so; the contact alone keeps
 * int F_x dx = U + W, here by the trapezoid rule, and the whole its books. */
static double contact_imbalance(int steps, double *final) {
    const drive d = {12, 800, 100, 0.3};
    rig r = make_rig(&d);
    double dt = duration / steps, through = 0;
    fret_state s;
    for (int i = 0; i < steps; i++) {
        const double x = r.mass.x, force = r.mass.force;
        CHECK_OK(verlet(&r.mass, &d, i * dt, dt));
        through += (force + r.mass.force) / 2 * (r.mass.x - x);
        CHECK(fabs(r.mass.force) <= r.mu * load_at(&d, (i + 1) * dt) * (1 + 1e-12));
    }
    fret_contact_state(r.mass.contact, &s);
    *final = energy(&r.mass) - r.mass.work;
    const double error = (through - (double)(s.U + s.W)) / (double)s.W;
    if (getenv("FRET_UNIT_VERBOSE"))
        printf("F_N varies, %d steps: contact off by %.2e, whole by %.2e of %.3Le J dissipated\n", steps,
               error, *final / (double)s.W, s.W);
    *final /= (double)s.W;
    drop(&r);
    return error;
}

static void test_varying_load(void) {
    double whole[3], contact[3];
    for (int i = 0; i < 3; i++)
        contact[i] = contact_imbalance(1000 << (2 * i), &whole[i]);
    CHECK_ABS(log(fabs(contact[0] / contact[2])) / log(16), 2, 1, 0.4L);
    CHECK_ABS(log(fabs(whole[0] / whole[2])) / log(16), 2, 1, 0.4L);
    CHECK(fabs(whole[2]) < 1e-4);
}

/* Both integrators follow the same motion. */
static void test_agree(void) {
    const drive d = {10, 600, 100, 0.2};
    rig a = make_rig(&d), b = make_rig(&d);
    const int steps = 4000;
    const double dt = duration / steps;
    int tries;
    for (int i = 0; i < steps; i++) {
        CHECK_OK(verlet(&a.mass, &d, i * dt, dt));
        CHECK_OK(implicit(&b.mass, b.saved, &d, i * dt, dt, 1e-12 * b.slip, &tries));
    }
    CHECK_ABS(a.mass.x, b.mass.x, a.slip, 1e-3L);
    CHECK_ABS(a.mass.work, b.mass.work, a.mass.work, 2e-3L);
    drop(&a);
    drop(&b);
}

/* Once a contact has seen its largest number of slices, steps and copies allocate nothing. */
static void test_no_allocation(void) {
    const drive d = {10, 600, 100, 0.2};
    rig r = make_rig(&d);
    const int steps = 2000;
    const double dt = duration / steps;
    int tries, failed = 0;
    for (int run = 0; run < 2; run++) {
        calls = 0;
        fret_contact_reset(r.mass.contact);
        failed += contact_force(r.mass.contact, load_at(&d, 0), 0, &r.mass.force).code != FRET_OK;
        r.mass.x = r.mass.v = r.mass.work = 0;
        for (int i = 0; i < steps; i++)
            failed += implicit(&r.mass, r.saved, &d, i * dt, dt, 1e-12 * r.slip, &tries).code != FRET_OK;
    }
    CHECK(calls == 0); /* in the second run; nothing is counted where calls cannot be */
    CHECK(failed == 0);
#ifdef COUNTS_CALLS
    void *volatile one = malloc(1);
    free(one);
    CHECK(calls > 0); /* the counter counts */
#endif
    drop(&r);
}

/* A step that cannot be made leaves the contact usable. */
static void test_rollback(void) {
    const drive d = {10, 600, 100, 0};
    rig r = make_rig(&d);
    const double dt = duration / 2000;
    fret_state a, b;
    for (int i = 0; i < 100; i++)
        CHECK_OK(verlet(&r.mass, &d, i * dt, dt));
    CHECK_OK(fret_contact_copy(r.saved, r.mass.contact));
    fret_contact_state(r.mass.contact, &a);
    double force = r.mass.force;
    CHECK_CODE(contact_force(r.mass.contact, -1, r.mass.x, &force), FRET_NEGATIVE);
    CHECK_CODE(contact_force(r.mass.contact, 100, (double)NAN, &force), FRET_NOT_FINITE);
    CHECK(force == r.mass.force);
    CHECK_OK(contact_force(r.mass.contact, 50, 3 * r.slip, &force)); /* a wrong guess ... */
    CHECK_OK(fret_contact_copy(r.mass.contact, r.saved));            /* ... taken back */
    fret_contact_state(r.mass.contact, &b);
    CHECK(a.FN == b.FN && a.dz == b.dz && a.a == b.a && a.Fx == b.Fx && a.dx == b.dx && a.c == b.c &&
          a.W == b.W && a.U == b.U && a.kn == b.kn && a.kt == b.kt && a.slices == b.slices);
    drop(&r);
}

int main(int argc, char **argv) {
    unit_start("oscillator", argc, argv);
    CASE(test_ledger());
    CASE(test_varying_load());
    CASE(test_agree());
    CASE(test_no_allocation());
    CASE(test_rollback());
    return unit_finish();
}
