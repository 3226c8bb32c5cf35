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
    fret_contact contact;
    fret_press press;
    fret_loading loading;
    fret_memory *memory, *memory_copy;
    fret_diagram *diagram, *diagram_copy;
    fret_springs *springs;
    fret_swing *swing, *swing_copy;
    fret_fields *fields;
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
    fret_fields_free(w->fields);
    fret_swing_free(w->swing);
    fret_swing_free(w->swing_copy);
    fret_springs_free(w->springs);
    fret_diagram_free(w->diagram);
    fret_diagram_free(w->diagram_copy);
    fret_memory_free(w->memory);
    fret_memory_free(w->memory_copy);
    w->fields = NULL;
    w->swing = w->swing_copy = NULL;
    w->springs = NULL;
    w->diagram = w->diagram_copy = NULL;
    w->memory = w->memory_copy = NULL;
}

static bool same_contact(const world *w) {
    return w->contact.normal == w->normal && w->contact.press.F > 0;
}

/* What has none yet is made, of the contact as it is. */
static bool have_normal(world *w) {
    if (!w->normal && known_code(fret_normal_make(&w->material, &w->gap, NULL, NULL, &w->normal))) {
        fret_normal_stop(w->normal, w->stop);
        w->old_table = w->table;
    }
    return w->normal;
}
static bool have_press(world *w) {
    if (!have_normal(w))
        return false;
    if (!same_contact(w) && known_code(fret_press_by_force(w->normal, 100, &w->press)))
        w->contact = (fret_contact){w->normal, 0.4, w->press};
    return same_contact(w);
}
static bool have_memory(world *w) {
    return have_normal(w) && (w->memory || known_code(fret_memory_make(w->normal, 0.4, &w->memory)));
}
static bool have_diagram(world *w) {
    return have_normal(w) && (w->diagram || known_code(fret_diagram_make(w->normal, 0.4, 0, &w->diagram)));
}
static bool have_springs(world *w) {
    return have_normal(w) && (w->springs || known_code(fret_springs_make(w->normal, 0.4, SPRINGS, 3e-4,
                                                                         FRET_WEIGHT_CELL, &w->springs)));
}
static bool have_swing(world *w) { /* of a contact that is closed */
    if (!have_memory(w) || w->swing)
        return w->memory && w->swing;
    fret_memory_forces(w->memory, &w->state);
    return (w->state.FN > 0 ||
            known_code(fret_memory_step(w->memory, &(fret_step){FRET_TO_FORCE, FRET_KEEP_DX, 100, 0}))) &&
           known_code(fret_swing_make(w->memory, &w->swing));
}
static bool have_fields(world *w) {
    return have_normal(w) && (w->fields || known_code(fret_fields_make(w->normal, &w->fields)));
}

/* The diagram in order: places rise from the centre to the edge, slopes are slopes. */
static void check_memory(const fret_memory *m) {
    fret_state now;
    fret_segment s;
    fret_memory_forces(m, &now);
    const fret_real edge = now.dz > 0 ? now.dz : 0;
    fret_real last = 0;
    for (size_t i = 0; fret_memory_segment(m, i, &s); i++) {
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
        (void)known_code(fret_arrays_loss(&w->contact, F, w->row, 4));
}
CALL(fret_arrays_loading) {
    const double F[4] = {x[0], x[1], x[2], x[3]};
    if (have_press(w))
        (void)known_code(
            fret_arrays_loading(&w->contact, F, x[4] > 0 ? w->row : NULL, x[4] >= 0 ? w->row + 4 : NULL, 4));
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
        w->sink[0] = fret_gross_slip(&w->contact);
}
CALL(fret_loading_by_force) {
    if (have_press(w))
        (void)known_code(fret_loading_by_force(&w->contact, x[0], &w->loading));
}
CALL(fret_loading_by_displacement) {
    if (have_press(w))
        (void)known_code(fret_loading_by_displacement(&w->contact, x[0], &w->loading));
}
CALL(fret_cycle_loss_by_force) {
    if (have_press(w))
        (void)known_code(fret_cycle_loss_by_force(&w->contact, x[0], w->sink));
}
CALL(fret_cycle_loss_by_displacement) {
    if (have_press(w))
        (void)known_code(fret_cycle_loss_by_displacement(&w->contact, x[0], w->sink));
}
CALL(fret_loss_shape) {
    w->sink[0] = fret_loss_shape(x[0], x[1], x[2], x[3]);
}
CALL(fret_diagram_make) {
    fret_diagram *made;
    if (have_normal(w) && known_code(fret_diagram_make(w->normal, x[0], whole(x[1], 30), &made))) {
        fret_diagram_free(w->diagram);
        w->diagram = made;
    }
}
CALL(fret_diagram_free) {
    (void)x;
    fret_diagram_free(w->diagram);
    w->diagram = NULL;
}
CALL(fret_diagram_count_loss) {
    if (have_diagram(w))
        fret_diagram_count_loss(w->diagram, x[0] > 0);
}
CALL(fret_diagram_reset) {
    (void)x;
    if (have_diagram(w))
        fret_diagram_reset(w->diagram);
}
CALL(fret_diagram_copy) {
    (void)x;
    if (have_diagram(w) &&
        (w->diagram_copy || known_code(fret_diagram_make(w->normal, 0.3, 0, &w->diagram_copy)))) {
        (void)known_code(fret_diagram_copy(w->diagram_copy, w->diagram));
        fret_diagram *was = w->diagram;
        w->diagram = w->diagram_copy;
        w->diagram_copy = was;
    }
}
CALL(fret_diagram_step) {
    const fret_step step = step_of(x);
    if (have_diagram(w))
        (void)known_code(fret_diagram_step(w->diagram, &step));
}
CALL(fret_diagram_forces) {
    fret_diagram_now now;
    (void)x;
    if (have_diagram(w)) {
        fret_diagram_forces(w->diagram, &now);
        w->sink[0] = now.Fx;
    }
}
CALL(fret_diagram_state) {
    (void)x;
    if (have_diagram(w))
        fret_diagram_state(w->diagram, &w->state);
}
CALL(fret_pressure) {
    if (have_normal(w))
        (void)known_code(fret_pressure(w->normal, x[0], x[1], w->sink));
}
CALL(fret_surface) {
    if (have_normal(w))
        (void)known_code(fret_surface(w->normal, x[0], x[1], w->sink));
}
CALL(fret_pressure_of) {
    if (have_press(w))
        (void)known_code(fret_pressure_of(w->normal, &w->press, x[0], w->sink));
}
CALL(fret_surface_of) {
    if (have_press(w))
        (void)known_code(fret_surface_of(w->normal, &w->press, x[0], w->sink));
}
CALL(fret_traction) {
    if (have_memory(w))
        (void)known_code(fret_traction(w->memory, x[0], w->sink));
}
CALL(fret_surface_x) {
    if (have_memory(w))
        (void)known_code(fret_surface_x(w->memory, x[0], w->sink));
}
CALL(fret_fields_make) {
    (void)x;
    (void)have_fields(w);
}
CALL(fret_fields_free) {
    (void)x;
    fret_fields_free(w->fields);
    w->fields = NULL;
}
CALL(fret_fields_pressure) {
    if (have_fields(w))
        (void)known_code(fret_fields_pressure(w->fields, x[0], x[1], w->sink));
}
CALL(fret_fields_surface) {
    if (have_fields(w))
        (void)known_code(fret_fields_surface(w->fields, x[0], x[1], w->sink));
}
CALL(fret_fields_pressure_of) {
    if (have_press(w) && have_fields(w))
        (void)known_code(fret_fields_pressure_of(w->fields, &w->press, x[0], w->sink));
}
CALL(fret_fields_surface_of) {
    if (have_press(w) && have_fields(w))
        (void)known_code(fret_fields_surface_of(w->fields, &w->press, x[0], w->sink));
}
CALL(fret_fields_traction) {
    if (have_memory(w) && have_fields(w))
        (void)known_code(fret_fields_traction(w->fields, w->memory, x[0], w->sink));
}
CALL(fret_fields_surface_x) {
    if (have_memory(w) && have_fields(w))
        (void)known_code(fret_fields_surface_x(w->fields, w->memory, x[0], w->sink));
}
CALL(fret_fields_error) {
    (void)x;
    if (have_fields(w))
        w->sink[0] = fret_fields_error(w->fields);
}
CALL(fret_kappa) {
    w->sink[0] = fret_kappa(x[0], x[1]);
}
/* kind, terms, b, R, slope, then n, h, r0 of each: of all others those of the last one */
CALL(fret_gap_check) {
    fret_gap gap = {.kind = (fret_gap_kind)whole(x[0], FRET_GAP_TABLE + 1),
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
CALL(fret_half_space) {
    (void)known_code(fret_half_space(x[0], x[1], w->sink, w->sink + 1, w->sink + 2));
}
CALL(fret_foundation_make) {
    fret_foundation made;
    const fret_material material = {{{x[2], x[3], false}, {x[4], x[5], x[6] > 1}}, x[0], x[1]};
    if (known_code(fret_foundation_make(&material, &made)))
        w->material = material;
}
CALL(fret_memory_make) {
    fret_memory *made;
    if (have_normal(w) && known_code(fret_memory_make(w->normal, x[0], &made))) {
        fret_memory_free(w->memory);
        w->memory = made;
    }
}
CALL(fret_memory_free) {
    (void)x;
    fret_memory_free(w->memory);
    w->memory = NULL;
}
CALL(fret_memory_copy) {
    (void)x;
    if (have_memory(w) && (w->memory_copy || known_code(fret_memory_make(w->normal, 0.3, &w->memory_copy)))) {
        (void)known_code(fret_memory_copy(w->memory_copy, w->memory));
        fret_memory *was = w->memory;
        w->memory = w->memory_copy;
        w->memory_copy = was;
    }
}
CALL(fret_memory_normal) {
    (void)x;
    if (have_memory(w) && fret_memory_normal(w->memory) != w->normal)
        abort();
}
CALL(fret_memory_friction) {
    (void)x;
    if (have_memory(w) && !(fret_memory_friction(w->memory) > 0))
        abort();
}
CALL(fret_memory_reset) {
    (void)x;
    if (have_memory(w))
        fret_memory_reset(w->memory);
}
CALL(fret_memory_step) {
    const fret_step step = step_of(x);
    if (have_memory(w) && known_code(fret_memory_step(w->memory, &step)))
        check_memory(w->memory);
}
CALL(fret_memory_state) {
    (void)x;
    if (have_memory(w))
        fret_memory_state(w->memory, &w->state);
}
CALL(fret_memory_forces) {
    (void)x;
    if (have_memory(w))
        fret_memory_forces(w->memory, &w->state);
}
CALL(fret_memory_last_loss) {
    (void)x;
    if (have_memory(w) && !(fret_memory_last_loss(w->memory) >= 0))
        abort();
}
CALL(fret_memory_segment) {
    fret_segment s;
    if (have_memory(w))
        (void)fret_memory_segment(w->memory, whole(x[0], 100), &s);
}
CALL(fret_memory_displacement) {
    if (have_memory(w))
        w->sink[0] = fret_memory_displacement(w->memory, x[0]);
}
CALL(fret_memory_bound) {
    if (have_memory(w))
        w->sink[0] = fret_memory_bound(w->memory, x[0]);
}
CALL(fret_memory_slip_work) {
    (void)x;
    if (have_memory(w))
        w->sink[0] = fret_memory_slip_work(w->memory);
}
static void forget_normal(world *w) {
    drop_contacts(w);
    fret_normal_free(w->normal);
    w->normal = NULL;
    w->contact.normal = NULL;
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
    if (have_normal(w))
        fret_normal_stop(w->normal, x[0] > 0 ? w->stop : NULL);
}
CALL(fret_normal_hold) {
    fret_normal *other;
    fret_material material = w->material;
    material.body[0].E0 = x[0];
    if (!have_normal(w) || !known_code(fret_normal_make(&material, &w->gap, w->normal, w->stop, &other)))
        return;
    fret_normal *held = fret_normal_hold(other);
    fret_normal_free(other);
    (void)known_code(fret_press_by_force(held, x[1], &w->press));
    fret_normal_free(held);
    w->contact.normal = NULL;
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
        w->contact = (fret_contact){w->normal, mu, w->press};
    else
        w->contact.normal = NULL;
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
CALL(fret_normal_stiffness) {
    if (have_normal(w))
        w->sink[0] = fret_normal_stiffness(w->normal, x[0]);
}
CALL(fret_cycle_loss_by_definition) {
    (void)x;
    if (have_press(w))
        (void)known_code(fret_cycle_loss_by_definition(&w->contact, &w->loading, w->sink, w->sink + 1));
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
CALL(fret_swing_takes) {
    (void)x;
    if (have_normal(w))
        w->sink[0] = fret_swing_takes(w->normal);
}
CALL(fret_swing_make) {
    (void)x;
    fret_swing_free(w->swing);
    w->swing = NULL;
    (void)have_swing(w);
}
CALL(fret_swing_free) {
    (void)x;
    fret_swing_free(w->swing);
    w->swing = NULL;
}
CALL(fret_swing_copy) {
    (void)x;
    if (have_swing(w) && (w->swing_copy || known_code(fret_swing_make(w->memory, &w->swing_copy)))) {
        (void)known_code(fret_swing_copy(w->swing_copy, w->swing));
        fret_swing *was = w->swing;
        w->swing = w->swing_copy;
        w->swing_copy = was;
    }
}
CALL(fret_swing_fits) {
    w->sine = (fret_sine){x[0], x[1], x[2], x[3]};
    if (have_swing(w))
        (void)fret_swing_fits(w->swing, &w->sine);
}
CALL(fret_swing_period) {
    w->sine = (fret_sine){x[0], x[1], x[2], x[3]};
    if (have_swing(w) && fret_swing_fits(w->swing, &w->sine))
        (void)known_code(fret_swing_period(w->swing, &w->sine));
}
CALL(fret_swing_part) {
    w->sine = (fret_sine){x[0], x[1], x[2], x[3]};
    if (have_swing(w) && fret_swing_fits(w->swing, &w->sine))
        (void)known_code(fret_swing_part(w->swing, &w->sine, x[4], x[5]));
}
CALL(fret_swing_step) {
    const fret_step step = step_of(x);
    if (have_swing(w))
        (void)known_code(fret_swing_step(w->swing, &step));
}
CALL(fret_swing_state) {
    (void)x;
    if (have_swing(w))
        fret_swing_state(w->swing, &w->state);
}
CALL(fret_swing_last_loss) {
    (void)x;
    if (have_swing(w))
        w->sink[0] = fret_swing_last_loss(w->swing);
}
CALL(fret_swing_traction) {
    if (have_swing(w))
        (void)known_code(fret_swing_traction(w->swing, x[0], w->sink));
}
CALL(fret_swing_surface_x) {
    if (have_swing(w))
        (void)known_code(fret_swing_surface_x(w->swing, x[0], w->sink));
}
CALL(fret_swing_displacement) {
    if (have_swing(w))
        w->sink[0] = fret_swing_displacement(w->swing, x[0]);
}
CALL(fret_swing_memory) {
    (void)x;
    if (have_swing(w) && (w->memory_copy || known_code(fret_memory_make(w->normal, 0.4, &w->memory_copy))))
        (void)known_code(fret_swing_memory(w->swing, w->memory_copy));
}

#define ROW(name)                                                                                            \
    { #name, call_##name }
static const struct row {
    const char *name;
    void (*call)(world *w, const double *x);
} rows[] = {
    ROW(fret_arrays_loss),
    ROW(fret_arrays_loading),
    ROW(fret_arrays_press),
    ROW(fret_gross_slip),
    ROW(fret_loading_by_force),
    ROW(fret_loading_by_displacement),
    ROW(fret_cycle_loss_by_force),
    ROW(fret_cycle_loss_by_displacement),
    ROW(fret_loss_shape),
    ROW(fret_diagram_make),
    ROW(fret_diagram_free),
    ROW(fret_diagram_count_loss),
    ROW(fret_diagram_reset),
    ROW(fret_diagram_copy),
    ROW(fret_diagram_step),
    ROW(fret_diagram_forces),
    ROW(fret_diagram_state),
    ROW(fret_pressure),
    ROW(fret_surface),
    ROW(fret_pressure_of),
    ROW(fret_surface_of),
    ROW(fret_traction),
    ROW(fret_surface_x),
    ROW(fret_fields_make),
    ROW(fret_fields_free),
    ROW(fret_fields_pressure),
    ROW(fret_fields_surface),
    ROW(fret_fields_pressure_of),
    ROW(fret_fields_surface_of),
    ROW(fret_fields_traction),
    ROW(fret_fields_surface_x),
    ROW(fret_fields_error),
    ROW(fret_kappa),
    ROW(fret_gap_check),
    ROW(fret_gap_f),
    ROW(fret_gap_g),
    ROW(fret_table_make),
    ROW(fret_table_sloped),
    ROW(fret_table_count),
    ROW(fret_table_within),
    ROW(fret_table_free),
    ROW(fret_half_space),
    ROW(fret_foundation_make),
    ROW(fret_memory_make),
    ROW(fret_memory_free),
    ROW(fret_memory_copy),
    ROW(fret_memory_normal),
    ROW(fret_memory_friction),
    ROW(fret_memory_reset),
    ROW(fret_memory_step),
    ROW(fret_memory_state),
    ROW(fret_memory_forces),
    ROW(fret_memory_last_loss),
    ROW(fret_memory_segment),
    ROW(fret_memory_displacement),
    ROW(fret_memory_bound),
    ROW(fret_memory_slip_work),
    ROW(fret_normal_make),
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
    ROW(fret_normal_stiffness),
    ROW(fret_cycle_loss_by_definition),
    ROW(fret_springs_make),
    ROW(fret_springs_free),
    ROW(fret_springs_step),
    ROW(fret_springs_state),
    ROW(fret_status_category),
    ROW(fret_status_rule),
    ROW(fret_status_text),
    ROW(fret_swing_takes),
    ROW(fret_swing_make),
    ROW(fret_swing_free),
    ROW(fret_swing_copy),
    ROW(fret_swing_fits),
    ROW(fret_swing_period),
    ROW(fret_swing_part),
    ROW(fret_swing_step),
    ROW(fret_swing_state),
    ROW(fret_swing_last_loss),
    ROW(fret_swing_traction),
    ROW(fret_swing_surface_x),
    ROW(fret_swing_displacement),
    ROW(fret_swing_memory),
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
