/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Each allocation of the library fails once: the call says so, what it was to change is as it was, nothing
 * leaks. The Makefile links this program so that the library allocates through the functions here. */
#include "histories.h"

#include "failing.h"
#include "unit.h"

enum { ROWS = 40 };
static double r[ROWS], f[ROWS];
static fret_pressed contact;
static double limit, slip;

static fret_status last;

static bool fine(fret_status st) {
    last = st;
    return !st.code;
}

#define EACH(least, call, unchanged) EACH_FAILS(least, fine(call), last.code == FRET_NO_MEMORY && (unchanged))

static void tables_and_contacts(void) {
    struct fret_table *table = NULL;
    fret_normal *normal = NULL;
    fret_memory *memory = NULL;
    fret_springs *springs = NULL;
    fret_swing *swing = NULL;
    const unit_scene s = unit_make_scene(2, 0.3);
    EACH(2, fret_table_make(r, f, ROWS, NULL, &table), table == NULL);
    EACH(1, fret_normal_make(&s.material, &s.gap, NULL, NULL, &normal), normal == NULL);
    EACH(2, fret_memory_make(contact.normal, 0.4, &memory), memory == NULL);
    EACH(3, fret_springs_make(contact.normal, 0.4, 100, 1e-3, FRET_WEIGHT_CELL, &springs), springs == NULL);
    EACH(2, fret_swing_make(memory, &swing), swing == NULL);
    fret_swing_free(swing);
    fret_springs_free(springs);
    fret_memory_free(memory);
    fret_normal_free(normal);
    fret_table_free(table);
}

/* The law of a table; of one like it there is nothing to make, and little of a shape of another size. */
static void laws(void) {
    struct fret_table *table = NULL;
    fret_normal *n = NULL, *other = NULL;
    fret_material m = unit_make_scene(2, -0.99).material;
    CHECK_OK(fret_table_make(r, f, ROWS, NULL, &table));
    const fret_gap gap = {.kind = FRET_GAP_TABLE, .table = table};
    EACH(8, fret_normal_make(&m, &gap, NULL, NULL, &n), n == NULL);
    m.body[0].E0 *= 2;
    EACH(1, fret_normal_make(&m, &gap, n, NULL, &other), other == NULL);
    CHECK(fret_normal_error(n) < 1e-15 && fret_normal_error(other) == fret_normal_error(n));
    fret_normal_free(n);
    fret_normal_free(other);
    fret_table_free(table);
    n = other = NULL;
    fret_gap sphere = {.kind = FRET_GAP_EXACT_SPHERE, .R = 1e-2};
    EACH(8, fret_normal_make(&m, &sphere, NULL, NULL, &n), n == NULL);
    sphere.R *= 2;
    EACH(6, fret_normal_make(&m, &sphere, n, NULL, &other), other == NULL);
    fret_normal_free(n);
    fret_normal_free(other);
}

/* Ever smaller swings: each turning point is kept. */
static void memories(void) {
    fret_memory *m, *copy, *whole;
    fret_state before, now;
    CHECK_OK(fret_memory_make(contact.normal, 0.4, &m));
    CHECK_OK(fret_memory_make(contact.normal, 0.4, &copy));
    CHECK_OK(fret_memory_make(contact.normal, 0.4, &whole));
    CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, 20, 0}));
    CHECK_OK(fret_memory_step(whole, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, 20, 0}));
    int refused = 0;
    for (int i = 0; i < 200; i++) {
        const fret_step step = {FRET_KEEP_NORMAL, FRET_TO_FX, 0, 0.9 * limit * pow(-0.99, i)};
        fret_memory_state(m, &before);
        left = 0;
        fret_status st = fret_memory_step(m, &step);
        left = -1;
        if (st.code) {
            CHECK_CODE(st, FRET_NO_MEMORY);
            fret_memory_state(m, &now);
            CHECK(same_state(&before, &now));
            CHECK_OK(fret_memory_step(m, &step));
            refused++;
        }
        CHECK_OK(fret_memory_step(whole, &step));
    }
    fret_memory_state(m, &now);
    fret_memory_state(whole, &before);
    CHECK(refused > 2 && same_state(&before, &now));
    fret_memory_state(copy, &before);
    EACH(1, fret_memory_copy(copy, m), (fret_memory_state(copy, &now), same_state(&before, &now)));
    fret_memory_state(m, &before);
    fret_memory_state(copy, &now);
    CHECK(same_state(&before, &now));
    fret_memory_free(m);
    fret_memory_free(copy);
    fret_memory_free(whole);
}

static void diagrams(void) {
    fret_diagram *d[2];
    fret_state before, now;
    int refused = 0;
    for (int i = 0; i < 2; i++) {
        CHECK_OK(fret_diagram_make(contact.normal, 0.4, &d[i]));
        CHECK_OK(fret_diagram_step(d[i], &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, 20, 0}));
    }
    for (int i = 0; i < 200; i++) {
        const fret_step step = {FRET_KEEP_NORMAL, FRET_TO_FX, 0, 0.9 * limit * pow(-0.99, i)};
        fret_diagram_forces(d[0], &before);
        left = 0;
        const fret_status st = fret_diagram_step(d[0], &step);
        left = -1;
        if (st.code) {
            CHECK_CODE(st, FRET_NO_MEMORY);
            fret_diagram_forces(d[0], &now);
            CHECK(same_state(&before, &now));
            CHECK_OK(fret_diagram_step(d[0], &step));
            refused++;
        }
        CHECK_OK(fret_diagram_step(d[1], &step));
    }
    fret_diagram_forces(d[0], &now);
    fret_diagram_forces(d[1], &before);
    CHECK(refused > 1 && same_state(&before, &now));
    for (int i = 0; i < 2; i++)
        fret_diagram_free(d[i]);
}

/* One period from the state of `from`: what a failed one leaves is good for a copy only. */
static fret_status period_of(fret_swing *w, const fret_swing *from, const fret_sine *sine) {
    const fret_status st = fret_swing_copy(w, from);
    return st.code ? st : fret_swing_part(w, sine, 0, 1);
}

/* Falling phases that each leave a piece more: the sine's own curve. */
static void swings(void) {
    fret_memory *m, *back;
    fret_swing *w, *copy;
    fret_state before, now;
    const fret_sine sine = {.FN = 20, .FNA = 6, .FA = 3, .phase = 1};
    CHECK_OK(fret_memory_make(contact.normal, 0.4, &m));
    CHECK_OK(fret_memory_make(contact.normal, 0.4, &back));
    CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, 20, 0}));
    CHECK_OK(fret_swing_make(m, &w));
    CHECK_OK(fret_swing_make(m, &copy));
    EACH(0, period_of(w, copy, &sine), true);
    fret_swing_state(copy, &before);
    EACH(0, fret_swing_copy(copy, w), (fret_swing_state(copy, &now), same_state(&before, &now)));
    fret_swing_state(w, &before);
    fret_swing_state(copy, &now);
    CHECK(same_state(&before, &now));
    fret_memory_state(back, &before);
    EACH(0, fret_swing_memory(w, back), (fret_memory_state(back, &now), same_state(&before, &now)));
    fret_swing_free(w);
    fret_swing_free(copy);
    fret_memory_free(m);
    fret_memory_free(back);
}

/* Ever smaller ways back and forth: each leaves a piece. What is refused is tried again from a copy. */
static void smaller_slides(void) {
    fret_memory *m;
    fret_swing *w, *before;
    fret_state exact, now;
    int refused = 0;
    CHECK_OK(fret_memory_make(contact.normal, 0.4, &m));
    CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, 20, 0}));
    CHECK_OK(fret_swing_make(m, &w));
    CHECK_OK(fret_swing_make(m, &before));
    for (int i = 0; i < 60; i++) {
        const fret_step step = {FRET_KEEP_NORMAL, FRET_TO_DX, 0, 0.9 * slip * pow(-0.93, i)};
        CHECK_OK(fret_swing_copy(before, w));
        left = 0;
        const fret_status st = fret_swing_step(w, &step);
        left = -1;
        if (st.code) {
            CHECK_CODE(st, FRET_NO_MEMORY);
            CHECK_OK(fret_swing_copy(w, before));
            CHECK_OK(fret_swing_step(w, &step));
            refused++;
        }
        CHECK_OK(fret_memory_step(m, &step));
    }
    fret_memory_state(m, &exact);
    fret_swing_state(w, &now);
    CHECK(refused > 0 && now.dx == exact.dx);
    CHECK_REL(now.Fx, exact.Fx, 1e-12L);
    CHECK_REL(now.W, exact.W, 1e-12L);
    fret_swing_free(w);
    fret_swing_free(before);
    fret_memory_free(m);
}

/* Ever smaller periods: each leaves pieces of the curve. What is refused is as it was, or good for a copy. */
static void smaller_swings(void) {
    fret_memory *m;
    fret_swing *w, *before, *small;
    fret_state then, now;
    int refused = 0, copies = 0;
    CHECK_OK(fret_memory_make(contact.normal, 0.4, &m));
    CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, 20, 0}));
    CHECK_OK(fret_swing_make(m, &w));
    CHECK_OK(fret_swing_make(m, &before));
    for (int i = 0; i < 60; i++) {
        const double part = pow(0.93, i);
        const fret_sine sine = {.FN = 20, .FNA = 6 * part, .FA = 3 * part, .phase = 1};
        const fret_step step = {FRET_TO_FORCE, FRET_TO_FX, (double)(20 + (fret_real)sine.FNA * cosl(1)),
                                sine.FA};
        for (int period = 0; period < 2; period++) {
            CHECK_OK(fret_swing_copy(before, w));
            left = 0;
            const fret_status st = period ? fret_swing_part(w, &sine, 0, 1) : fret_swing_step(w, &step);
            left = -1;
            if (st.code) {
                CHECK_CODE(st, FRET_NO_MEMORY);
                CHECK_OK(fret_swing_copy(w, before));
                CHECK_OK(period ? fret_swing_part(w, &sine, 0, 1) : fret_swing_step(w, &step));
                refused++;
            }
        }
        CHECK_OK(fret_swing_make(m, &small));
        fret_swing_state(small, &then);
        left = 0;
        const fret_status st = fret_swing_copy(small, w);
        left = -1;
        fret_swing_state(small, &now);
        CHECK(!st.code || same_state(&then, &now));
        copies += st.code == FRET_NO_MEMORY;
        fret_swing_free(small);
    }
    CHECK(refused > 1 && copies > 1);
    fret_swing_free(w);
    fret_swing_free(before);
    fret_memory_free(m);
}

/* Periods whose first piece, or a later one, finds no room: from copies, which have less of it. */
static void periods_without_room(void) {
    fret_memory *m;
    fret_swing *w, *before, *small;
    fret_state whole, now;
    int refused = 0;
    CHECK_OK(fret_memory_make(contact.normal, 0.4, &m));
    CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, 20, 0}));
    for (double phase = 0.25; phase < 6.2; phase += 0.5) {
        CHECK_OK(fret_swing_make(m, &w));
        CHECK_OK(fret_swing_make(m, &before));
        for (int i = 0; i < 20; i++) {
            const double part = pow(0.93, i);
            const fret_sine sine = {.FN = 20, .FNA = 6 * part, .FA = 3 * part, .phase = phase};
            CHECK_OK(
                fret_swing_step(w, &(fret_step){FRET_TO_FORCE, FRET_TO_FX,
                                                (double)(20 + (fret_real)sine.FNA * cosl(phase)), sine.FA}));
            CHECK_OK(fret_swing_make(m, &small));
            CHECK_OK(fret_swing_copy(small, w));
            CHECK_OK(fret_swing_copy(before, w));
            CHECK_OK(fret_swing_part(w, &sine, 0, 1));
            left = 0;
            fret_status st = fret_swing_part(small, &sine, 0, 1);
            left = -1;
            if (st.code) {
                CHECK_CODE(st, FRET_NO_MEMORY);
                CHECK_OK(period_of(small, before, &sine));
                refused++;
            }
            fret_swing_state(w, &whole);
            fret_swing_state(small, &now);
            CHECK(same_state(&whole, &now));
            fret_swing_free(small);
        }
        fret_swing_free(w);
        fret_swing_free(before);
    }
    CHECK(refused > 3);
    fret_memory_free(m);
}

/* A field is there, or nothing is. */
static void fields(void) {
    const unit_scene s = unit_make_scene(2, 0.3);
    fret_gap gap = {.kind = FRET_GAP_TABLE};
    struct fret_table *table = NULL;
    fret_normal *normal = NULL;
    fret_memory *m = NULL;
    fret_field *field = NULL;
    fret_real q = 0;
    CHECK_OK(fret_table_make(r, f, ROWS, NULL, &table));
    gap.table = table;
    CHECK_OK(fret_normal_make(&s.material, &gap, NULL, NULL, &normal));
    CHECK_OK(fret_memory_make(normal, 0.4, &m));
    CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, 20, 0}));
    CHECK_OK(fret_memory_step(m, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_FX, 0, 5}));
    EACH(8, fret_field_make(CONTACT_OF(m), &field), field == NULL);
    CHECK_OK(fret_field_traction(field, 1e-5L, &q));
    CHECK(q > 0 && fret_field_error(field) < 1e-14);
    fret_field_free(field);
    fret_memory_free(m);
    fret_normal_free(normal);
    fret_table_free(table);
    gap = (fret_gap){.kind = FRET_GAP_FLAT_ROUNDED, .b = 1e-4, .R = 1e-2};
    CHECK_OK(fret_normal_make(&s.material, &gap, NULL, NULL, &normal));
    /* beyond eight times the flat end's radius cells are made of powers */
    EACH(10, fret_field_of_press(normal, &(fret_press){.dz = fret_normal_profile(normal, 3e-3L)}, &field),
         field == NULL);
    CHECK_OK(fret_field_pressure(field, 1.5e-4L, &q));
    CHECK(q > 0 && fret_field_error(field) < 1e-14);
    fret_field_free(field);
    fret_normal_free(normal);
}

int main(int argc, char **argv) {
    unit_start("allocation", argc, argv);
    const unit_scene s = unit_make_scene(2, 0.3);
    for (int i = 0; i < ROWS; i++) {
        r[i] = i * 1e-4;
        f[i] = r[i] * r[i] / 0.02;
    }
    contact = unit_make_contact(&s, 20);
    limit = contact.mu * 20;
    slip = (double)fret_gross_slip(&contact);
    CASE(tables_and_contacts());
    CASE(laws());
    CASE(memories());
    CASE(diagrams());
    CASE(swings());
    CASE(smaller_slides());
    CASE(smaller_swings());
    CASE(periods_without_room());
    CASE(fields());
    return unit_finish();
}
