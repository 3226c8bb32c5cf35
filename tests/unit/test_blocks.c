/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a rough table answers of thin slices does not depend on what was asked before, by whom, nor on whether
 * there was memory for it then. The Makefile links this program so that the library allocates through the
 * functions of failing.h. */
#include <pthread.h>

#include "contact/normal.h"
#include "failing.h"
#include "fret/cycle.h"
#include "unit.h"

enum { ROWS = 5000, QUESTIONS = 24, THREADS = 2 };

static const double borne = 1e-9; /* of the law */
static const fret_material steel = {{{210e9, 0.3, false}, {70e9, 0.35, false}}, 0.2, 1e-3};
static struct fret_table *table;

/* A reading of a sphere, off by what an instrument is. */
static void sample(void) {
    static double r[ROWS], f[ROWS];
    unsigned long long seed = 1;
    for (int i = 0; i < ROWS; i++) {
        r[i] = 1e-3 * i / (ROWS - 1);
        f[i] = r[i] * r[i] / 2e-2 + (i ? unit_random(&seed, -1e-13, 1e-13) : 0);
    }
    CHECK_OK(fret_table_make(r, f, ROWS, NULL, &table));
}

static fret_contact prepared_to(double error) {
    const fret_gap gap = {.kind = FRET_GAP_TABLE, .table = table};
    fret_normal *n = NULL;
    fret_contact c = {.mu = 0.4};
    CHECK_OK(fret_normal_make(&steel, &gap, &n));
    CHECK_OK(fret_press_by_radius(n, 0.9e-3, &c.press));
    CHECK_OK(fret_normal_prepare(n, (double)c.press.F, error));
    CHECK(fret_normal_prepared(n) <= 1e-8);
    c.normal = n;
    return c;
}

static fret_contact prepared(void) {
    return prepared_to(borne);
}

static void end(fret_contact *c) {
    fret_normal_free((fret_normal *)c->normal);
}

/* The loss of a cycle of small slip under ever smaller loads: thin slices all over the table. */
static fret_status ask(const fret_contact *c, int i, fret_real *loss) {
    fret_contact there = *c;
    fret_status st = fret_press_by_force(c->normal, (double)c->press.F * pow(0.8, i), &there.press);
    *loss = 0;
    return st.code ? st : fret_cycle_loss_by_force(&there, 3e-4 * c->mu * (double)there.press.F, loss);
}

typedef struct asker {
    const fret_contact *contact;
    pthread_barrier_t *together;
    bool ok;
    fret_real loss[QUESTIONS];
} asker;

static void *ask_all(void *context) {
    asker *a = context;
    a->ok = true;
    for (int i = 0; i < QUESTIONS; i++) {
        pthread_barrier_wait(a->together);
        a->ok = !ask(a->contact, i, &a->loss[i]).code && a->ok;
    }
    return NULL;
}

/* A slice over many rows, which are all made for it: where one of them finds no memory the table answers. */
static void thick_slices(void) {
    fret_contact c = prepared_to(0);
    fret_real want, got;
    int failed = 0;
    CHECK_OK(fret_cycle_loss_by_force(&c, 0.6 * c.mu * (double)c.press.F, &want));
    end(&c);
    for (int k = 0; k < 400; k += k < 8 ? 1 : 29) {
        c = prepared_to(0);
        left = k;
        const fret_status st = fret_cycle_loss_by_force(&c, 0.6 * c.mu * (double)c.press.F, &got);
        failed += left < 0;
        left = -1;
        CHECK(st.code == FRET_NO_MEMORY || !st.code);
        if (!st.code)
            CHECK_REL(got, want, 1e-12L);
        CHECK_OK(fret_cycle_loss_by_force(&c, 0.6 * c.mu * (double)c.press.F, &got));
        CHECK(got == want);
        end(&c);
    }
    CHECK(failed > 3);
}

int main(int argc, char **argv) {
    unit_start("blocks", argc, argv);
    fret_real want[QUESTIONS], got;
    CASE(sample());
    fret_contact c = prepared(), plain = c;
    for (int i = 0; i < QUESTIONS; i++)
        CHECK_OK(ask(&c, i, &want[i]));
    for (int i = QUESTIONS; i-- > 0;) {
        CHECK_OK(ask(&c, i, &got));
        CHECK(got == want[i]);
    }
    CASE(end(&c));

    /* without pieces, row by row */
    const fret_gap gap = {.kind = FRET_GAP_TABLE, .table = table};
    fret_normal *n = NULL;
    CHECK_OK(fret_normal_make(&steel, &gap, &n));
    plain.normal = n;
    for (int i = 0; i < QUESTIONS; i += 6) {
        CHECK_OK(ask(&plain, i, &got));
        CHECK_REL(want[i], got, 1e-12L);
    }
    fret_normal_free(n);

    /* backwards, from another one */
    c = prepared();
    for (int i = QUESTIONS; i-- > 0;) {
        CHECK_OK(ask(&c, i, &got));
        CHECK(got == want[i]);
    }
    CASE(end(&c));

    /* at the same moments */
    pthread_barrier_t together;
    pthread_t thread[THREADS];
    asker asks[THREADS];
    c = prepared();
    CHECK(pthread_barrier_init(&together, NULL, THREADS) == 0);
    for (int i = 0; i < THREADS; i++) {
        asks[i] = (asker){.contact = &c, .together = &together};
        CHECK(pthread_create(&thread[i], NULL, ask_all, &asks[i]) == 0);
    }
    for (int i = 0; i < THREADS; i++) {
        CHECK(pthread_join(thread[i], NULL) == 0);
        CHECK(asks[i].ok);
        for (int j = 0; j < QUESTIONS; j++)
            CHECK(asks[i].loss[j] == want[j]);
    }
    pthread_barrier_destroy(&together);
    CASE(end(&c));

    /* where there is no memory: refused, or had in another way; with memory again as ever */
    int failed = 0;
    c = prepared();
    for (int i = 0; i < QUESTIONS; i += 5) {
        for (int k = 0; k < 40; k++) {
            left = k;
            const fret_status st = ask(&c, i, &got);
            const bool whole = left >= 0;
            failed += !whole;
            left = -1;
            CHECK(st.code == FRET_NO_MEMORY || !st.code);
            if (!st.code)
                CHECK_REL(got, want[i], 1e-8L);
            if (whole)
                break;
        }
        CHECK_OK(ask(&c, i, &got));
        CHECK(got == want[i]);
    }
    CHECK(failed > 3);
    CASE(end(&c));
    if (!unit_skips(1))
        CASE(thick_slices());
    fret_table_free(table);
    return unit_finish();
}
