/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The door to histories: what either exactness takes and refuses, swinging and its chords, histories as
 * arrays of doubles. What contacts answer is tested where it is worked out. */
#include "histories.h"
#include "places.h"
#include "unit.h"

static fret_contact *make(const fret_normal *n, fret_exactness exactness) {
    fret_contact *c = NULL;
    CHECK_OK(fret_contact_make(n, 0.4, exactness, &c));
    return c;
}

static bool same(const fret_contact *a, const fret_contact *b) {
    fret_state s, t;
    fret_contact_state(a, &s);
    fret_contact_state(b, &t);
    return s.FN == t.FN && s.dz == t.dz && s.a == t.a && s.Fx == t.Fx && s.dx == t.dx && s.c == t.c &&
           s.W == t.W && s.U == t.U && s.kt == t.kt && s.slices == t.slices &&
           fret_contact_last_loss(a) == fret_contact_last_loss(b);
}

static fret_step random_step(unsigned long long *seed, double largest) {
    const double FN = unit_random(seed, 0, largest), part = unit_random(seed, -1, 1);
    return (fret_step){FRET_TO_FORCE, FRET_TO_FX, FN, 0.4 * FN * part};
}

static void both(void) {
    const unit_scene s = unit_make_scene(2, 0.3);
    const fret_gap flat = {.kind = FRET_GAP_FLAT_CONE, .b = 1e-3, .slope = 0.01};
    const fret_normal *n = unit_make_normal(&s);
    fret_contact *exact = make(n, FRET_EXACT), *fast = make(n, FRET_DOUBLE), *none = NULL;
    unsigned long long seed = 7;
    fret_real out = 0, max = 0.4L * 100 * 4e-6L;
    CHECK_ERROR(fret_contact_make(unit_keep_normal(&s.material, &flat), 0.4, FRET_DOUBLE, &none),
                FRET_OUTSIDE, "n");
    CHECK_ERROR(fret_contact_make(n, 0, FRET_EXACT, &none), FRET_NOT_POSITIVE, "mu");
    CHECK(!none);
    for (int i = 0; i < 200; i++) {
        const fret_step step = random_step(&seed, 100);
        fret_state a, b;
        CHECK_OK(fret_contact_step(exact, &step));
        CHECK_OK(fret_contact_step(fast, &step));
        fret_contact_forces(exact, &a);
        fret_contact_forces(fast, &b);
        CHECK_REL(b.Fx, a.Fx, 1e-14L);
        CHECK_ABS(b.W, a.W, a.W + max, 1e-13L);
    }
    fret_segment part;
    CHECK(fret_contact_segment(exact, 0, &part) && !fret_contact_segment(fast, 0, &part));
    CHECK(isnan(fret_contact_displacement(fast, 0)) && isnan(fret_contact_bound(fast, 0)) &&
          isnan(fret_contact_slip_work(fast)));
    CHECK_ERROR(fret_contact_copy(fast, exact), FRET_OUTSIDE, "exactness");
    CHECK_ERROR(fret_contact_chords(exact, fast), FRET_OUTSIDE, "exactness");
    CHECK_ERROR(fret_contact_swing(fast, &(fret_sine){1, 1, 0, 10}, 0, 1), FRET_OUTSIDE, "exactness");
    CHECK_ERROR(place_traction(fast, 0, &out), FRET_OUTSIDE, "exactness");
    CHECK_ERROR(place_surface_x(fast, 0, &out), FRET_OUTSIDE, "exactness");
    CHECK(fret_contact_normal(fast) == n && fret_contact_friction(fast) == 0.4);
    fret_contact_count_loss(fast, false);
    CHECK_OK(fret_contact_step(fast, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, 100, 39}));
    CHECK(fret_contact_last_loss(fast) == 0);
    fret_contact_free(exact);
    fret_contact_free(fast);
}

/* A contact swings, goes on, swings again; a swing that does not fit leaves it as it was. */
static void swings(void) {
    const unit_scene s = unit_make_scene(2, 0.3);
    const fret_normal *n = unit_make_normal(&s);
    const fret_sine sine = {.FA = 10, .FNA = 30, .phase = 0, .FN = 100};
    fret_contact *c = make(n, FRET_EXACT), *kept = make(n, FRET_EXACT), *chords = make(n, FRET_EXACT);
    fret_state now, then;
    CHECK(fret_normal_swings(n) && !fret_contact_curved(c));
    CHECK_ERROR(fret_contact_swing(c, &sine, 0, 1), FRET_OUTSIDE, "FA"); /* open */
    CHECK_OK(fret_contact_step(c, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, 130, 10}));
    CHECK_OK(fret_contact_copy(kept, c));
    CHECK_ERROR(fret_contact_swing(c, &sine, 0.25, 1), FRET_OUTSIDE, "FA"); /* it is not there */
    CHECK_ERROR(fret_contact_swing(c, &(fret_sine){60, 30, 0, 100}, 0, 1), FRET_OUTSIDE, "FA");
    CHECK(!fret_contact_curved(c) && same(c, kept));
    CHECK_OK(fret_contact_swing(c, &sine, 0, 0.4));
    CHECK(fret_contact_curved(c));
    CHECK_OK(fret_contact_swing(c, &sine, 0.4, 1));
    CHECK_OK(fret_contact_swing(kept, &sine, 0, 1));
    fret_contact_state(c, &now);
    fret_contact_state(kept, &then);
    CHECK_REL(now.W, then.W, 1e-15L);
    CHECK_OK(fret_contact_chords(chords, c));
    fret_contact_state(chords, &then);
    CHECK(!fret_contact_curved(chords) && then.FN == now.FN && then.Fx == now.Fx && then.W == now.W);
    CHECK_REL(then.U, now.U, 1e-5L);
    for (int i = 1; i < 8; i++) {
        const fret_real x = now.a * i / 8;
        CHECK_ABS(fret_contact_displacement(c, x), fret_contact_displacement(chords, x), now.dx, 1e-6L);
        CHECK_REL(fret_contact_bound(c, x), fret_contact_bound(chords, x), 1e-15L);
    }
    CHECK(isnan(fret_contact_slip_work(c)) && isnan(fret_contact_displacement(c, (fret_real)NAN)));
    CHECK_CODE(fret_contact_step(c, &(fret_step){FRET_TO_FORCE, FRET_TO_DX, 90, 0}), FRET_OUTSIDE);
    CHECK_OK(fret_contact_copy(c, chords)); /* straight again: it takes that too */
    CHECK_OK(fret_contact_step(c, &(fret_step){FRET_TO_FORCE, FRET_TO_DX, 90, 0}));
    fret_contact_reset(c);
    fret_contact_state(c, &now);
    CHECK(now.FN == 0 && now.W == 0 && now.slices == 0);
    fret_contact_free(c);
    fret_contact_free(kept);
    fret_contact_free(chords);
    static const double r[] = {0, 1e-3, 2e-3}, f[] = {0, 1e-6, 4e-6};
    struct fret_table *table = NULL;
    CHECK_OK(fret_table_make(r, f, 3, NULL, &table));
    const fret_normal *rows =
        unit_keep_normal(&s.material, &(fret_gap){.kind = FRET_GAP_TABLE, .table = table});
    c = make(rows, FRET_EXACT);
    CHECK(!fret_normal_swings(rows));
    CHECK_OK(fret_contact_step(c, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, 13, 1}));
    CHECK_ERROR(fret_contact_swing(c, &(fret_sine){1, 3, 0, 10}, 0, 1), FRET_OUTSIDE, "gap");
    fret_contact_free(c);
    while (unit.normals)
        fret_normal_free(unit.normal[--unit.normals]);
    fret_table_free(table);
}

enum { ROOM = 4000 };

/* Where it slips within a period, it slips as chords too, and these are packed and unpacked. */
static void slips_as_chords(double part) {
    static double packed[20 * ROOM];
    const unit_scene s = unit_make_scene(2, -0.2);
    const fret_normal *n = unit_make_normal(&s);
    const fret_sine sine = {.FA = 12, .FNA = 20, .phase = 2, .FN = 100};
    fret_contact *c = make(n, FRET_EXACT), *chords = make(n, FRET_EXACT);
    fret_state now, then;
    size_t count;
    CHECK_OK(fret_contact_step(c, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, 100 + 20 * cos(2), 12}));
    CHECK_OK(fret_contact_swing(c, &sine, 0, 1));
    CHECK_OK(fret_contact_swing(c, &sine, 0, part));
    fret_contact_state(c, &now);
    CHECK_OK(fret_contact_pack(c, packed, 20 * ROOM, &count));
    CHECK_OK(fret_contact_chords(chords, c));
    for (int i = 0; i < 2; i++) {
        fret_contact_state(chords, &then);
        CHECK_REL(then.c, now.c, 1e-6L);
        CHECK_REL(then.kt, now.kt, 1e-6L);
        CHECK_OK(fret_contact_unpack(chords, packed, count));
    }
    fret_contact_free(c);
    fret_contact_free(chords);
}

/* Packed and unpacked into a new contact, it goes on as the old one, to the last bit. */
static void packed(double n, double k, fret_exactness exactness) {
    static double to[ROOM], again[ROOM];
    const unit_scene s = unit_make_scene(n, k);
    const fret_normal *law = unit_make_normal(&s);
    fret_contact *c = make(law, exactness), *other = make(law, exactness);
    unsigned long long seed = 3, aside = 4;
    size_t count = 0, more = 0;
    for (int i = 0; i < 200; i++) {
        const fret_step step = random_step(&seed, i % 40 ? 100 : 1e7);
        CHECK_OK(fret_contact_step(c, &step));
        CHECK_OK(fret_contact_pack(c, to, ROOM, &count));
        /* whatever the other has carried before */
        const fret_step away = random_step(&aside, i % 2 ? 1e-5 : 1e9);
        CHECK_OK(fret_contact_step(other, &away));
        CHECK_OK(fret_contact_unpack(other, to, count));
        CHECK(same(c, other));
        CHECK_OK(fret_contact_pack(other, again, ROOM, &more));
        CHECK(more == count && memcmp(to, again, count * sizeof *to) == 0);
        const fret_step next = random_step(&seed, 100);
        CHECK_OK(fret_contact_step(c, &next));
        CHECK_OK(fret_contact_step(other, &next));
        CHECK(same(c, other));
    }
    CHECK_ERROR(fret_contact_pack(c, to, 3, &more), FRET_OUTSIDE, "room");
    CHECK(fret_contact_pack(c, to, 0, &more).limit == (double)more);
    CHECK_OK(fret_contact_pack(c, to, ROOM, &count));
    fret_contact *old = make(law, exactness);
    CHECK_OK(fret_contact_copy(old, c));
    for (size_t i = 0; i < count; i++) { /* what is no history is refused, and leaves no trace */
        const double was = to[i];
        to[i] = i % 2 ? (double)INFINITY : (double)NAN;
        CHECK_CODE(fret_contact_unpack(c, to, count), FRET_OUTSIDE);
        to[i] = was;
    }
    for (size_t i = 0; i < 3 * count; i++) { /* what may pass for one goes on as one */
        const double was = to[i / 3], another[] = {-1e290, 1e290, 1.01 * was};
        const fret_step next = random_step(&seed, 100);
        fret_state now;
        fret_segment s1;
        to[i / 3] = another[i % 3];
        const bool passes = !fret_contact_unpack(other, to, count).code;
        fret_contact_forces(other, &now);
        for (size_t j = 0; passes && fret_contact_segment(other, j, &s1); j++)
            CHECK(s1.inner >= 0 && s1.outer >= s1.inner && s1.outer <= now.dz);
        if (passes && !fret_contact_step(other, &next).code) {
            fret_contact_forces(other, &now);
            CHECK(fret_contact_last_loss(other) >= 0 && now.W >= 0 && isfinite(now.dx));
        }
        to[i / 3] = was;
    }
    for (size_t i = 0; i < count; i += 7)
        CHECK(fret_contact_unpack(c, to, i).code == FRET_OUTSIDE || (i > 0 && i < count));
    CHECK_OK(fret_contact_copy(c, old));
    fret_contact_reset(c);
    CHECK_OK(fret_contact_pack(c, to, ROOM, &count));
    CHECK_OK(fret_contact_unpack(other, to, count));
    CHECK(same(c, other));
    fret_contact_free(old);
    fret_contact_free(c);
    fret_contact_free(other);
}

/* Only into its like; what has swung is packed as chords. */
static void packed_otherwise(void) {
    static double to[40000];
    const unit_scene s = unit_make_scene(2, 0);
    const fret_normal *n = unit_make_normal(&s);
    fret_contact *c = make(n, FRET_EXACT), *fast = make(n, FRET_DOUBLE), *chords = make(n, FRET_EXACT);
    size_t count = 0;
    CHECK_OK(fret_contact_step(c, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, 130, 10}));
    CHECK_OK(fret_contact_pack(c, to, 40000, &count));
    CHECK_ERROR(fret_contact_unpack(fast, to, count), FRET_OUTSIDE, "history");
    CHECK_OK(fret_contact_swing(c, &(fret_sine){10, 30, 0, 100}, 0, 0.75));
    CHECK_OK(fret_contact_chords(chords, c));
    CHECK_OK(fret_contact_pack(c, to, 40000, &count));
    CHECK_OK(fret_contact_unpack(c, to, count));
    CHECK(!fret_contact_curved(c) && same(c, chords));
    fret_contact_free(c);
    fret_contact_free(fast);
    fret_contact_free(chords);
}

/* After a load beside which the present one is rounding, no layer is left. */
static void after_a_blow(void) {
    const unit_scene s = unit_make_scene(2, 0);
    const fret_sine sine = {.FA = 10, .FNA = 30, .phase = 0, .FN = 100};
    fret_contact *c = make(unit_make_normal(&s), FRET_EXACT);
    for (int i = 0; i < 2; i++) {
        CHECK_OK(fret_contact_step(c, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, i ? 1e60 : 130, 10}));
        CHECK_OK(fret_contact_step(c, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, 130, 10}));
        CHECK_OK(fret_contact_swing(c, &sine, 0, 0.5));
    }
    CHECK_OK(fret_contact_chords(c, c));
    CHECK(isfinite(fret_contact_displacement(c, 1e-5L)));
    fret_contact_free(c);
}

int main(int argc, char **argv) {
    unit_start("contact", argc, argv);
    CASE(both());
    CASE(swings());
    for (int i = 1; i < 20; i++)
        CASE(slips_as_chords(i / 20.0));
    CASE(after_a_blow());
    CASE(packed(2, 0, FRET_EXACT));
    CASE(packed(1.3, -0.4, FRET_EXACT));
    CASE(packed(2, 0, FRET_DOUBLE));
    CASE(packed(1.3, -0.4, FRET_DOUBLE));
    CASE(packed_otherwise());
    return unit_finish();
}
