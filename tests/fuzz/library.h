/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every function of the library with any numbers. A line of input is a call, a name and numbers as strtod
 * reads them (inf, nan and 0x1p-1074 too); an unknown name stands for some function, a missing number for 1.
 * What the headers ask of an argument that is no number is kept: objects live as long as they are borrowed,
 * and gaps have passed their check. A row a function: the house asks for it. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fret/fret.h"

enum { NUMBERS = 12, ROWS = 20, SPRINGS = 40, CALLS = 60 };

typedef struct world {
    fret_stop stop;
    fret_material material;
    fret_gap gap;
    struct fret_table *table, *old_table; /* of the gap, and of the normal contact */
    fret_normal *normal, *other;
    fret_pressed pressed;
    fret_press press;
    fret_loading loading;
    fret_contact *contact, *other_contact; /* exact, or in double */
    fret_springs *springs;
    fret_field *field;
    fret_slips *slips;
    fret_work *work;
    fret_wear_run *run;
    fret_wear *wear;
    fret_sine sine;
    fret_state state;
    fret_real sink[16]; /* where results go */
    double row[16];
} world;

static bool known_code(fret_status st) {
    char text[200];
    (void)fret_status_text(&st, text, sizeof text);
    if ((unsigned)st.code >= FRET_CODES)
        abort();
    return st.code == FRET_OK;
}

/* ---- numbers ----------------------------------------------------------------------------------- */

static size_t whole(double x, size_t most) {
    return x > 0 ? x < (double)most ? (size_t)x : most : 0;
}

/* ---- objects ----------------------------------------------------------------------------------- */

static void drop_contacts(world *w) {
    fret_field_free(w->field);
    fret_springs_free(w->springs);
    fret_contact_free(w->contact);
    fret_contact_free(w->other_contact);
    fret_slips_free(w->slips);
    fret_work_free(w->work);
    fret_wear_run_free(w->run);
    fret_wear_free(w->wear);
    w->run = NULL;
    w->wear = NULL;
    w->slips = NULL;
    w->work = NULL;
    w->field = NULL;
    w->springs = NULL;
    w->contact = w->other_contact = NULL;
}

static bool same_contact(const world *w) {
    return w->pressed.normal == w->normal && w->pressed.press.F > 0;
}

/* What has none yet is made, of the contact as it is. */
static bool have_normal(world *w) {
    if (!w->normal && known_code(fret_normal_make(&w->material, &w->gap, NULL, w->stop, &w->normal))) {
        fret_normal_stop(w->normal, w->stop);
        w->old_table = w->table;
    }
    return w->normal;
}
static bool have_press(world *w) {
    if (!have_normal(w))
        return false;
    if (!same_contact(w) && known_code(fret_press_by_force(w->normal, 100, &w->press)))
        w->pressed = (fret_pressed){w->normal, 0.4, w->press};
    return same_contact(w);
}
static bool make_contact(world *w, double exactness, double mu, fret_contact **out) {
    return known_code(fret_contact_make(w->normal, mu, exactness > 0 ? FRET_DOUBLE : FRET_EXACT, out));
}
static bool have_contact(world *w) {
    return have_normal(w) && (w->contact || make_contact(w, 0, 0.4, &w->contact));
}
static bool have_two_contacts(world *w) {
    return have_contact(w) && (w->other_contact || make_contact(w, 0, 0.3, &w->other_contact));
}
static bool have_springs(world *w) {
    return have_normal(w) && (w->springs || known_code(fret_springs_make(w->normal, 0.4, SPRINGS, 3e-4,
                                                                         FRET_WEIGHT_CELL, &w->springs)));
}
static bool have_field(world *w) {
    return have_contact(w) && (w->field || known_code(fret_field_make(w->contact, &w->field)));
}

/* The diagram in order: places rise from the centre to the edge, slopes are slopes. */
static void check_contact(const fret_contact *m) {
    fret_state now;
    fret_segment s;
    fret_contact_forces(m, &now);
    const fret_real edge = now.dz > 0 ? now.dz : 0;
    fret_real last = 0;
    for (size_t i = 0; fret_contact_segment(m, i, &s); i++) {
        if (!(s.inner >= 0 && s.outer >= s.inner && s.outer <= edge && fabsl(s.sigma) <= 1 &&
              (!i || s.inner == last))) {
            fprintf(stderr, "library: slice %zu of slope %Lg from %Lg to %Lg, after %Lg, of %Lg\n", i,
                    s.sigma, s.inner, s.outer, last, edge);
            abort();
        }
        last = s.outer;
    }
}

static fret_step step_of(const double *x) {
    return (fret_step){(fret_normal_target)whole(x[0], FRET_TO_DEPTH),
                       (fret_tangential_target)whole(x[1], FRET_TO_FX), x[2], x[3]};
}

/* ---- rows -------------------------------------------------------------------------------------- */

#define CALL(name) static void call_##name(world *w, const double *x)

CALL(fret_arrays_loss) {
    const double F[4] = {x[0], x[1], x[2], x[3]};
    if (have_press(w))
        (void)known_code(fret_arrays_loss(&w->pressed, F, w->row, 4));
}
CALL(fret_arrays_loading) {
    const double F[4] = {x[0], x[1], x[2], x[3]};
    if (have_press(w))
        (void)known_code(
            fret_arrays_loading(&w->pressed, F, x[4] > 0 ? w->row : NULL, x[4] >= 0 ? w->row + 4 : NULL, 4));
}
CALL(fret_arrays_press) {
    const double F[4] = {x[0], x[1], x[2], x[3]};
    if (have_normal(w))
        (void)known_code(
            fret_arrays_press(w->normal, F, x[4] > 0 ? w->row : NULL, x[4] >= 0 ? w->row + 4 : NULL, 4));
}
CALL(fret_gross_slip) {
    (void)x;
    if (have_press(w))
        w->sink[0] = fret_gross_slip(&w->pressed);
}
CALL(fret_loading_by_force) {
    if (have_press(w))
        (void)known_code(fret_loading_by_force(&w->pressed, x[0], &w->loading));
}
CALL(fret_loading_by_displacement) {
    if (have_press(w))
        (void)known_code(fret_loading_by_displacement(&w->pressed, x[0], &w->loading));
}
CALL(fret_cycle_loss_by_force) {
    if (have_press(w))
        (void)known_code(fret_cycle_loss_by_force(&w->pressed, x[0], w->sink));
}
CALL(fret_cycle_loss_by_displacement) {
    if (have_press(w))
        (void)known_code(fret_cycle_loss_by_displacement(&w->pressed, x[0], w->sink));
}
CALL(fret_field_make) {
    (void)x;
    fret_field_free(w->field);
    w->field = NULL;
    (void)have_field(w);
}
CALL(fret_field_of_press) {
    fret_field_free(w->field);
    w->field = NULL;
    if (have_normal(w))
        (void)known_code(fret_field_of_press(w->normal, &(fret_press){.dz = x[0]}, &w->field));
}
CALL(fret_field_free) {
    (void)x;
    fret_field_free(w->field);
    w->field = NULL;
}
CALL(fret_field_pressure) {
    if (have_field(w))
        (void)known_code(fret_field_pressure(w->field, x[0], w->sink));
}
CALL(fret_field_peak) {
    (void)x;
    if (have_field(w))
        (void)known_code(fret_field_peak(w->field, w->sink, w->sink + 1));
}
CALL(fret_field_surface) {
    if (have_field(w))
        (void)known_code(fret_field_surface(w->field, x[0], w->sink));
}
CALL(fret_field_traction) {
    if (have_field(w))
        (void)known_code(fret_field_traction(w->field, x[0], w->sink));
}
CALL(fret_field_surface_x) {
    if (have_field(w))
        (void)known_code(fret_field_surface_x(w->field, x[0], w->sink));
}
CALL(fret_field_slip) {
    if (have_field(w))
        (void)known_code(fret_field_slip(w->field, x[0], w->sink));
}
CALL(fret_field_stress) {
    fret_stress s;
    if (have_field(w) && known_code(fret_field_stress(w->field, x[0], x[1], x[2], x[3], &s)))
        w->sink[0] = s.xx;
}
CALL(fret_stress_mises) {
    w->sink[0] = fret_stress_mises(&(fret_stress){x[0], x[1], x[2], x[3], x[4], x[5]});
}
CALL(fret_stress_tresca) {
    w->sink[0] = fret_stress_tresca(&(fret_stress){x[0], x[1], x[2], x[3], x[4], x[5]});
}
CALL(fret_stress_principal) {
    fret_stress_principal(&(fret_stress){x[0], x[1], x[2], x[3], x[4], x[5]}, w->row);
}
CALL(fret_slips_make) {
    (void)x;
    if (have_contact(w) && !w->slips)
        (void)known_code(fret_slips_make(&w->slips));
}
CALL(fret_contact_watch) {
    if (have_contact(w) && w->slips)
        (void)known_code(fret_contact_watch(w->contact, x[0] > 0 ? w->slips : NULL));
}
CALL(fret_slips_clear) {
    (void)x;
    if (w->slips)
        fret_slips_clear(w->slips);
}
CALL(fret_slips_count) {
    (void)x;
    if (w->slips)
        w->sink[0] = (fret_real)fret_slips_count(w->slips);
}
CALL(fret_slips_repeat) {
    if (w->slips)
        fret_slips_repeat(w->slips, whole(x[0], 8), x[1]);
}
CALL(fret_slips_free) {
    (void)x;
    drop_contacts(w);
}
CALL(fret_work_make) {
    fret_work_free(w->work);
    w->work = NULL;
    if (have_contact(w) && w->slips)
        (void)known_code(fret_work_make(fret_contact_normal(w->contact), fret_contact_friction(w->contact),
                                        w->slips, whole(x[0], 8), whole(x[1], 100), &w->work));
}
CALL(fret_work_at) {
    if (w->work)
        (void)known_code(fret_work_at(w->work, x[0], w->sink));
}
CALL(fret_work_edges) {
    fret_real r[FRET_WORK_ENDS];
    if (w->work)
        (void)fret_work_edges(w->work, whole(x[0], 100), r);
}
CALL(fret_work_free) {
    (void)x;
    fret_work_free(w->work);
    w->work = NULL;
}
static fret_wear_held held_of(const double *x) {
    return (fret_wear_held){x[0] > 0, x[1] > 0, x[2], x[3], x[4], x[5]};
}
CALL(fret_wear_run_make) {
    const fret_wear_held held = held_of(x);
    fret_wear_run *run;
    if (have_normal(w) && known_code(fret_wear_run_make(w->normal, &held, 0.1, &run))) {
        fret_wear_run_free(w->run);
        w->run = run;
    }
}
CALL(fret_wear_after) {
    fret_wear *wear;
    if (w->run && known_code(fret_wear_after(w->run, x[0], NULL, NULL, &wear))) {
        fret_wear_free(w->wear);
        w->wear = wear;
    }
}
CALL(fret_wear_run_free) {
    (void)x;
    fret_wear_run_free(w->run);
    w->run = NULL;
}
CALL(fret_wear_limit) {
    const fret_wear_held held = held_of(x);
    fret_wear *limit;
    if (have_normal(w) && known_code(fret_wear_limit(w->normal, &held, &limit))) {
        fret_wear_free(w->wear);
        w->wear = limit;
    }
}
CALL(fret_wear_law) {
    if (w->wear)
        (void)known_code(fret_press_by_force(fret_wear_law(w->wear), x[0], &w->press));
    w->pressed.normal = NULL;
}
CALL(fret_wear_depth) {
    if (w->wear)
        (void)known_code(fret_wear_depth(w->wear, x[0], w->sink));
}
CALL(fret_wear_ring) {
    (void)x;
    if (w->wear)
        fret_wear_ring(w->wear, w->sink, w->sink + 1);
}
CALL(fret_wear_volume) {
    (void)x;
    if (w->wear)
        w->sink[0] = fret_wear_volume(w->wear);
}
CALL(fret_wear_cycles) {
    (void)x;
    if (w->wear)
        w->sink[0] = fret_wear_cycles(w->wear);
}
CALL(fret_wear_work) {
    (void)x;
    if (w->wear)
        w->sink[0] = fret_wear_work(w->wear);
}
CALL(fret_wear_free) {
    (void)x;
    fret_wear_free(w->wear);
    w->wear = NULL;
}
CALL(fret_field_error) {
    (void)x;
    if (have_field(w))
        w->sink[0] = fret_field_error(w->field);
}
CALL(fret_kappa) {
    w->sink[0] = fret_kappa(x[0], x[1]);
}
/* kind, terms, b, R, slope, then n, h, r0 of each: of all others those of the last one */
CALL(fret_gap_check) {
    fret_gap gap = {.kind = (fret_gap_kind)whole(x[0], FRET_GAP_WORN + 1),
                    .terms = (int)whole(x[1], 1000000),
                    .b = x[2],
                    .R = x[3],
                    .slope = x[4],
                    .table = w->table};
    for (int i = 0; i < FRET_GAP_TERMS; i++) {
        const double *power = x + (i ? 8 : 5);
        gap.power[i] = (fret_power){power[0] + i, power[1], power[2]};
    }
    if (known_code(fret_gap_check(&gap)))
        w->gap = gap;
}
CALL(fret_gap_f) {
    (void)known_code(fret_gap_f(&w->gap, x[0], w->sink));
}
CALL(fret_gap_g) {
    (void)known_code(fret_gap_g(&w->gap, x[0], x[1], w->sink, x[2] > 0 ? w->sink + 1 : NULL));
}
/* The table of the contact is borrowed until that is made anew. */
static void take_table(world *w, struct fret_table *made) {
    if (w->table != w->old_table)
        fret_table_free(w->table);
    w->table = made;
    w->gap = (fret_gap){.kind = FRET_GAP_TABLE, .table = made};
}
/* rows, the last radius, curvature, a power, a slope, and one row that is anything */
static size_t rows_of(const double *x, double *r, double *f, double *slope) {
    const size_t count = whole(x[0], ROWS);
    for (size_t i = 0; i < count; i++) {
        r[i] = x[1] * ((double)i / (double)(count > 1 ? count - 1 : 1));
        f[i] = x[2] * pow(r[i], x[3]);
        slope[i] = x[4];
    }
    if (count) {
        const size_t any = whole(x[5], count - 1);
        r[any] += x[6];
        f[any] += x[7];
    }
    return count;
}
CALL(fret_table_make) {
    double r[ROWS], f[ROWS], slope[ROWS];
    struct fret_table *made;
    if (known_code(fret_table_make(r, f, rows_of(x, r, f, slope), w->stop, &made)))
        take_table(w, made);
}
CALL(fret_table_sloped) {
    double r[ROWS], f[ROWS], slope[ROWS];
    struct fret_table *made;
    const size_t count = rows_of(x, r, f, slope);
    if (known_code(fret_table_sloped(r, f, slope, count, w->stop, &made)))
        take_table(w, made);
}
CALL(fret_table_count) {
    (void)x;
    if (w->table)
        w->sink[0] = (fret_real)fret_table_count(w->table);
}
CALL(fret_table_within) {
    (void)x;
    if (w->table)
        w->sink[0] = fret_table_within(w->table);
}
CALL(fret_table_free) {
    (void)w, (void)x;
    fret_table_free(NULL);
}
CALL(fret_foundation_make) {
    fret_foundation made;
    const fret_material material = {{{x[2], x[3], false}, {x[4], x[5], x[6] > 1}}, x[0], x[1]};
    if (known_code(fret_foundation_make(&material, &made)))
        w->material = material;
}
static void forget_normal(world *w) {
    drop_contacts(w);
    fret_normal_free(w->normal);
    w->normal = NULL;
    w->pressed.normal = NULL;
    if (w->old_table != w->table)
        fret_table_free(w->old_table);
    w->old_table = NULL;
}
CALL(fret_normal_make) {
    (void)x;
    forget_normal(w);
    (void)have_normal(w);
}
CALL(fret_normal_free) {
    (void)x;
    forget_normal(w);
}
CALL(fret_normal_stop) {
    (void)x;
    if (have_normal(w)) {
        fret_normal_stop(w->normal, NULL);
        fret_normal_stop(w->normal, w->stop); /* else what takes long would never end */
    }
}
CALL(fret_normal_same) {
    fret_normal *other;
    fret_material material = w->material;
    material.body[0].E0 = x[0];
    if (!have_normal(w) || !known_code(fret_normal_make(&material, &w->gap, w->normal, w->stop, &other)))
        return;
    w->sink[0] = fret_normal_same(w->normal, other);
    fret_normal_free(other);
}
CALL(fret_normal_hold) {
    fret_normal *other;
    fret_material material = w->material;
    material.body[0].E0 = x[0];
    if (!have_normal(w) || !known_code(fret_normal_make(&material, &w->gap, w->normal, w->stop, &other)))
        return;
    fret_normal *held = fret_normal_hold(other);
    if (!fret_normal_same(held, other))
        abort();
    fret_normal_free(other);
    (void)known_code(fret_press_by_force(held, x[1], &w->press));
    fret_normal_free(held);
    w->pressed.normal = NULL;
}
CALL(fret_normal_error) {
    (void)x;
    if (have_normal(w))
        w->sink[0] = fret_normal_error(w->normal);
}
CALL(fret_normal_foundation) {
    (void)x;
    if (have_normal(w))
        w->sink[0] = fret_normal_foundation(w->normal)->eta;
}
CALL(fret_normal_gap) {
    (void)x;
    if (have_normal(w))
        w->sink[0] = fret_normal_gap(w->normal)->R;
}
CALL(fret_normal_is_power) {
    (void)x;
    if (have_normal(w))
        w->sink[0] = fret_normal_is_power(w->normal);
}
CALL(fret_normal_end) {
    (void)x;
    if (have_normal(w))
        w->sink[0] = fret_normal_end(w->normal);
}
CALL(fret_normal_profile) {
    if (have_normal(w))
        w->sink[0] = fret_normal_profile(w->normal, x[0]);
}
static void take_press(world *w, double mu, fret_status st) {
    if (known_code(st))
        w->pressed = (fret_pressed){w->normal, mu, w->press};
    else
        w->pressed.normal = NULL;
}
CALL(fret_press_by_force) {
    if (have_normal(w))
        take_press(w, x[1], fret_press_by_force(w->normal, x[0], &w->press));
}
CALL(fret_press_by_depth) {
    if (have_normal(w))
        take_press(w, x[1], fret_press_by_depth(w->normal, x[0], &w->press));
}
CALL(fret_press_by_radius) {
    if (have_normal(w))
        take_press(w, x[1], fret_press_by_radius(w->normal, x[0], &w->press));
}
CALL(fret_press_by_peak) {
    if (have_normal(w))
        take_press(w, x[1], fret_press_by_peak(w->normal, x[0], &w->press));
}
CALL(fret_press_by_mean) {
    if (have_normal(w))
        take_press(w, x[1], fret_press_by_mean(w->normal, x[0], &w->press));
}
CALL(fret_normal_energy) {
    (void)x;
    if (have_press(w))
        w->sink[0] = fret_normal_energy(w->normal, &w->press);
}
CALL(fret_normal_stiffness) {
    if (have_normal(w))
        w->sink[0] = fret_normal_stiffness(w->normal, x[0]);
}
CALL(fret_cycle_loss_by_definition) {
    (void)x;
    if (have_press(w))
        (void)known_code(fret_cycle_loss_by_definition(&w->pressed, &w->loading, w->sink, w->sink + 1));
}
CALL(fret_springs_make) {
    fret_springs *made;
    if (have_normal(w) &&
        known_code(fret_springs_make(w->normal, x[0], whole(x[1], SPRINGS), x[2],
                                     x[3] > 1 ? FRET_WEIGHT_MIDPOINT : FRET_WEIGHT_CELL, &made))) {
        fret_springs_free(w->springs);
        w->springs = made;
    }
}
CALL(fret_springs_clone) {
    fret_springs *made;
    (void)x;
    if (have_springs(w) && known_code(fret_springs_clone(w->springs, &made))) {
        fret_springs_free(w->springs);
        w->springs = made;
    }
}
CALL(fret_springs_free) {
    (void)x;
    fret_springs_free(w->springs);
    w->springs = NULL;
}
CALL(fret_springs_step) {
    const fret_step step = step_of(x);
    if (have_springs(w))
        (void)known_code(fret_springs_step(w->springs, &step, (unsigned)whole(x[4], 5)));
}
CALL(fret_springs_state) {
    (void)x;
    if (have_springs(w))
        fret_springs_state(w->springs, &w->state);
}
CALL(fret_status_category) {
    (void)w;
    (void)fret_status_category((fret_code)whole(x[0], 100));
}
CALL(fret_status_rule) {
    w->sink[0] = (fret_real)strlen(fret_status_rule((fret_code)whole(x[0], 100)));
}
CALL(fret_status_text) {
    char text[16];
    const fret_status st = {(fret_code)whole(x[0], 100), x[1] > 0 ? "x" : NULL, x[2], x[3]};
    w->sink[0] = fret_status_text(&st, text, whole(x[4], sizeof text));
}

CALL(fret_contact_make) {
    fret_contact *made;
    if (have_normal(w) && make_contact(w, x[1], x[0], &made)) {
        fret_contact_free(w->contact);
        w->contact = made;
    }
}
CALL(fret_contact_free) {
    (void)x;
    fret_contact_free(w->contact);
    w->contact = NULL;
}
CALL(fret_contact_copy) {
    (void)x;
    if (have_two_contacts(w)) {
        (void)known_code(fret_contact_copy(w->other_contact, w->contact));
        fret_contact *was = w->contact;
        w->contact = w->other_contact;
        w->other_contact = was;
    }
}
CALL(fret_contact_chords) {
    (void)x;
    if (have_two_contacts(w))
        (void)known_code(fret_contact_chords(w->other_contact, w->contact));
}
CALL(fret_contact_reset) {
    (void)x;
    if (have_contact(w))
        fret_contact_reset(w->contact);
}
CALL(fret_contact_normal) {
    (void)x;
    if (have_contact(w) && fret_contact_normal(w->contact) != w->normal)
        abort();
}
CALL(fret_contact_friction) {
    (void)x;
    if (have_contact(w) && !(fret_contact_friction(w->contact) > 0))
        abort();
}
CALL(fret_contact_step) {
    const fret_step step = step_of(x);
    if (have_contact(w) && known_code(fret_contact_step(w->contact, &step)))
        check_contact(w->contact);
}
CALL(fret_contact_count_loss) {
    if (have_contact(w))
        fret_contact_count_loss(w->contact, x[0] > 0);
}
CALL(fret_contact_swing) {
    w->sine = (fret_sine){x[0], x[1], x[2], x[3]};
    if (have_contact(w))
        (void)known_code(fret_contact_swing(w->contact, &w->sine, x[4], x[5]));
}
CALL(fret_normal_swings) {
    (void)x;
    if (have_normal(w))
        w->sink[0] = fret_normal_swings(w->normal);
}
CALL(fret_contact_curved) {
    (void)x;
    if (have_contact(w))
        w->sink[0] = fret_contact_curved(w->contact);
}
CALL(fret_contact_state) {
    (void)x;
    if (have_contact(w))
        fret_contact_state(w->contact, &w->state);
}
CALL(fret_contact_forces) {
    (void)x;
    if (have_contact(w))
        fret_contact_forces(w->contact, &w->state);
}
CALL(fret_contact_last_loss) {
    (void)x;
    if (have_contact(w) && !(fret_contact_last_loss(w->contact) >= 0))
        abort();
}
CALL(fret_contact_segment) {
    fret_segment s;
    if (have_contact(w))
        (void)fret_contact_segment(w->contact, whole(x[0], 100), &s);
}
CALL(fret_contact_displacement) {
    if (have_contact(w))
        w->sink[0] = fret_contact_displacement(w->contact, x[0]);
}
CALL(fret_contact_bound) {
    if (have_contact(w))
        w->sink[0] = fret_contact_bound(w->contact, x[0]);
}
CALL(fret_contact_slip_work) {
    (void)x;
    if (have_contact(w))
        w->sink[0] = fret_contact_slip_work(w->contact);
}
CALL(fret_contact_pack) {
    static double packed[4000];
    size_t count;
    if (have_contact(w))
        (void)known_code(fret_contact_pack(w->contact, packed, whole(x[0], 4000), &count));
}
/* A history as it is, or with one number that is another. */
CALL(fret_contact_unpack) {
    static double packed[4000];
    size_t count;
    if (!have_contact(w) || !known_code(fret_contact_pack(w->contact, packed, 4000, &count)))
        return;
    if (x[0] >= 0)
        packed[whole(x[0], count - 1)] = x[1];
    if (known_code(fret_contact_unpack(w->contact, packed, count - whole(x[2], count))))
        check_contact(w->contact);
}

#define ROW(name)                                                                                            \
    { #name, call_##name }
static const struct row {
    const char *name;
    void (*call)(world *w, const double *x);
} rows[] = {
    ROW(fret_contact_make),
    ROW(fret_contact_free),
    ROW(fret_contact_copy),
    ROW(fret_contact_chords),
    ROW(fret_contact_reset),
    ROW(fret_contact_normal),
    ROW(fret_contact_friction),
    ROW(fret_contact_step),
    ROW(fret_contact_count_loss),
    ROW(fret_contact_swing),
    ROW(fret_normal_swings),
    ROW(fret_contact_curved),
    ROW(fret_contact_state),
    ROW(fret_contact_forces),
    ROW(fret_contact_last_loss),
    ROW(fret_contact_segment),
    ROW(fret_contact_displacement),
    ROW(fret_contact_bound),
    ROW(fret_contact_slip_work),
    ROW(fret_contact_pack),
    ROW(fret_contact_unpack),
    ROW(fret_arrays_loss),
    ROW(fret_arrays_loading),
    ROW(fret_arrays_press),
    ROW(fret_gross_slip),
    ROW(fret_loading_by_force),
    ROW(fret_loading_by_displacement),
    ROW(fret_cycle_loss_by_force),
    ROW(fret_cycle_loss_by_displacement),
    ROW(fret_field_make),
    ROW(fret_field_of_press),
    ROW(fret_field_free),
    ROW(fret_field_pressure),
    ROW(fret_field_peak),
    ROW(fret_field_surface),
    ROW(fret_field_traction),
    ROW(fret_field_surface_x),
    ROW(fret_field_slip),
    ROW(fret_field_stress),
    ROW(fret_stress_mises),
    ROW(fret_stress_tresca),
    ROW(fret_stress_principal),
    ROW(fret_slips_make),
    ROW(fret_contact_watch),
    ROW(fret_slips_clear),
    ROW(fret_slips_count),
    ROW(fret_slips_repeat),
    ROW(fret_slips_free),
    ROW(fret_work_make),
    ROW(fret_work_at),
    ROW(fret_work_edges),
    ROW(fret_work_free),
    ROW(fret_wear_run_make),
    ROW(fret_wear_after),
    ROW(fret_wear_run_free),
    ROW(fret_wear_limit),
    ROW(fret_wear_law),
    ROW(fret_wear_depth),
    ROW(fret_wear_ring),
    ROW(fret_wear_volume),
    ROW(fret_wear_cycles),
    ROW(fret_wear_work),
    ROW(fret_wear_free),
    ROW(fret_field_error),
    ROW(fret_kappa),
    ROW(fret_gap_check),
    ROW(fret_gap_f),
    ROW(fret_gap_g),
    ROW(fret_table_make),
    ROW(fret_table_sloped),
    ROW(fret_table_count),
    ROW(fret_table_within),
    ROW(fret_table_free),
    ROW(fret_foundation_make),
    ROW(fret_normal_make),
    ROW(fret_normal_same),
    ROW(fret_normal_hold),
    ROW(fret_normal_error),
    ROW(fret_normal_free),
    ROW(fret_normal_stop),
    ROW(fret_normal_foundation),
    ROW(fret_normal_gap),
    ROW(fret_normal_is_power),
    ROW(fret_normal_end),
    ROW(fret_normal_profile),
    ROW(fret_press_by_force),
    ROW(fret_press_by_depth),
    ROW(fret_press_by_radius),
    ROW(fret_press_by_peak),
    ROW(fret_press_by_mean),
    ROW(fret_normal_energy),
    ROW(fret_normal_stiffness),
    ROW(fret_cycle_loss_by_definition),
    ROW(fret_springs_make),
    ROW(fret_springs_free),
    ROW(fret_springs_clone),
    ROW(fret_springs_step),
    ROW(fret_springs_state),
    ROW(fret_status_category),
    ROW(fret_status_rule),
    ROW(fret_status_text),
};

/* ---- lines ------------------------------------------------------------------------------------- */

static const struct row *row_of(const char *word, size_t n) {
    const size_t count = sizeof rows / sizeof *rows;
    size_t any = 0;
    for (size_t i = 0; i < count; i++)
        if (strlen(rows[i].name) == n && !memcmp(rows[i].name, word, n))
            return &rows[i];
    for (size_t i = 0; i < n; i++)
        any = 31 * any + (unsigned char)word[i];
    return &rows[any % count];
}

/* The numbers after the name. What is none stands for one of the wild ones. */
static void numbers_of(const char *p, double x[NUMBERS]) {
    static const double wild[] = {0,     -0.0,   1,        -1,        0.5, 2,    1e-300, -1e300,
                                  1e300, 5e-324, HUGE_VAL, -HUGE_VAL, NAN, 1e-9, 1e9};
    int count = 0;
    while (count < NUMBERS && *(p += strspn(p, " \t\r"))) {
        char *end;
        x[count] = strtod(p, &end);
        if (end == p) {
            x[count] = wild[(unsigned char)*p % (sizeof wild / sizeof *wild)];
            end += strcspn(p, " \t\r");
        }
        count++;
        p = end;
    }
    while (count < NUMBERS)
        x[count++] = 1;
}

static void library_calls(const char *text, fret_stop stop) {
    world w = {.stop = stop,
               .material = {{{210e9, 0.3, false}, {210e9, 0.3, false}}, 0, 1e-3},
               .gap = {.kind = FRET_GAP_POWER, .terms = 1, .power = {{2, 50, 1}}}};
    for (int i = 0; i < CALLS && *text && !*stop; i++) {
        char line[400];
        double x[NUMBERS];
        const size_t n = strcspn(text, "\n"), kept = n < sizeof line ? n : sizeof line - 1;
        memcpy(line, text, kept);
        line[kept] = 0;
        text += n + (text[n] == '\n');
        const size_t name = strcspn(line, " \t\r");
        numbers_of(line + name, x);
        row_of(line, name)->call(&w, x);
    }
    forget_normal(&w);
    fret_table_free(w.table);
}
