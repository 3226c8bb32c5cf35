/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A flag that is set ends long work with its own status, and what was interrupted serves again after a reset.
 */
#include "fret/fret.h"
#include "histories.h"

#include <unistd.h>

#include "places.h"
#include "study/jenkins.h"
#define unit calc_unit /* a name that tests have too */
#include "text/csv.h"
#undef unit
#include "unit.h"

enum { ROWS = 2000 };

static volatile sig_atomic_t stop;

static struct fret_table *sampled(void) {
    static double r[ROWS], f[ROWS];
    struct fret_table *t = NULL;
    for (int i = 0; i < ROWS; i++) {
        r[i] = 1e-3 * i / (ROWS - 1);
        f[i] = r[i] * r[i] / 0.02;
    }
    stop = 1;
    CHECK_CODE(fret_table_make(r, f, ROWS, &stop, &t), FRET_INTERRUPTED);
    CHECK(t == NULL);
    stop = 0;
    CHECK_OK(fret_table_make(r, f, ROWS, &stop, &t));
    return t;
}

static void check_memory(const fret_normal *normal) {
    const fret_step press = {FRET_TO_FORCE, FRET_KEEP_DX, 10, 0}, push = {FRET_TO_FORCE, FRET_TO_FX, 12, 2};
    fret_memory *m;
    fret_state before, after;
    CHECK_OK(fret_memory_make(normal, 0.4, &m));
    CHECK_OK(fret_memory_step(m, &press));
    CHECK_OK(fret_memory_step(m, &push));
    fret_memory_state(m, &before);
    stop = 1;
    CHECK_CODE(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, 11, -2}), FRET_INTERRUPTED);
    stop = 0;
    fret_memory_reset(m);
    CHECK_OK(fret_memory_step(m, &press));
    CHECK_OK(fret_memory_step(m, &push));
    fret_memory_state(m, &after);
    CHECK(before.Fx == after.Fx && before.dx == after.dx && before.W == after.W && before.U == after.U);
    fret_memory_free(m);
}

/* Questions to a state: what they had begun is no answer. */
static void check_questions(const fret_normal *normal, const fret_pressed *contact) {
    fret_memory *m;
    fret_state before, during, after;
    fret_real value = 0, error = 0;
    fret_loading peak;
    CHECK_OK(fret_loading_by_force(contact, 1, &peak));
    CHECK_OK(fret_memory_make(normal, 0.4, &m));
    CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, 10, 1}));
    fret_memory_state(m, &before);
    const fret_real work = fret_memory_slip_work(m);
    CHECK(work < 0);
    stop = 1;
    CHECK(fret_memory_slip_work(m) == 0);
    fret_memory_state(m, &during);
    CHECK(during.FN == before.FN && during.Fx == before.Fx);
    CHECK_CODE(place_traction(CONTACT_OF(m), 1e-5L, &value), FRET_INTERRUPTED);
    CHECK_CODE(place_surface_x(CONTACT_OF(m), 1e-5L, &value), FRET_INTERRUPTED);
    CHECK_CODE(fret_cycle_loss_by_definition(contact, &peak, &value, &error), FRET_INTERRUPTED);
    stop = 0;
    fret_memory_state(m, &after);
    CHECK(before.U == after.U && before.W == after.W && before.dx == after.dx);
    CHECK(fret_memory_slip_work(m) == work);
    CHECK_OK(place_traction(CONTACT_OF(m), 1e-5L, &value));
    CHECK(value > 0);
    CHECK_OK(fret_cycle_loss_by_definition(contact, &peak, &value, &error));
    CHECK(value > 0);
    fret_memory_free(m);
}

static void check_springs(const fret_normal *normal) {
    fret_springs *s = NULL;
    stop = 1;
    CHECK_CODE(fret_springs_make(normal, 0.4, 1000, 1e-4, FRET_WEIGHT_CELL, &s), FRET_INTERRUPTED);
    CHECK(s == NULL);
    stop = 0;
    CHECK_OK(fret_springs_make(normal, 0.4, 1000, 1e-4, FRET_WEIGHT_CELL, &s));
    CHECK_OK(fret_springs_step(s, &(fret_step){FRET_TO_DEPTH, FRET_KEEP_DX, 4e-7, 0}, 1));
    stop = 1;
    CHECK_CODE(fret_springs_step(s, &(fret_step){FRET_TO_DEPTH, FRET_TO_DX, 3e-7, 1e-8}, 10),
               FRET_INTERRUPTED);
    stop = 0;
    fret_springs_free(s);
}

static int pulses;

static void pulse(void) {
    stop = pulses-- == 0;
}

/* What takes seconds where numbers are wild: thirteen powers, k next to 1, gross slip through a kink. */
static void check_wild(struct fret_table *rows) {
    fret_material graded = {
        .body = {{.E0 = 210e9, .nu = 0.3}, {.E0 = 210e9, .nu = 0.3}}, .k = 1 - 1e-6, .c0 = 1e-3};
    fret_gap sum = {.kind = FRET_GAP_SUM, .terms = 13};
    for (int i = 0; i < 13; i++)
        sum.power[i] = (fret_power){2 + 5 * i, 1e-6, 1e-3};
    const fret_gap gaps[] = {
        {.kind = FRET_GAP_FLAT_CONE, .b = 1e-4, .slope = 0.05}, sum, {.kind = FRET_GAP_TABLE, .table = rows}};
    for (int i = 0; i < 3; i++) {
        fret_normal *n = unit_keep_normal(&graded, &gaps[i]);
        fret_press p;
        fret_real value;
        fret_memory *m;
        fret_swing *s;
        CHECK_OK(fret_press_by_radius(n, 2e-4, &p));
        fret_normal_stop(n, &stop);
        CHECK_OK(fret_memory_make(n, 0.4, &m));
        stop = 1;
        CHECK_CODE(place_pressure(n, p.a, p.a / 2, &value), FRET_INTERRUPTED);
        CHECK_CODE(place_surface(n, p.a, 1.1L * p.a, &value), FRET_INTERRUPTED);
        CHECK_CODE(place_of_press(n, &p, fret_field_pressure, p.a / 2, &value), FRET_INTERRUPTED);
        CHECK_CODE(place_of_press(n, &p, fret_field_surface, 1.1L * p.a, &value), FRET_INTERRUPTED);
        stop = 0;
        CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_DEPTH, FRET_KEEP_DX, (double)p.dz / 2, 0}));
        stop = 1; /* gross slip while the edge moves */
        CHECK_CODE(fret_memory_step(m, &(fret_step){FRET_TO_DEPTH, FRET_TO_DX, (double)p.dz, 1}),
                   FRET_INTERRUPTED);
        stop = 0;
        fret_memory_reset(m);
        CHECK_OK(fret_memory_step(m, &(fret_step){FRET_TO_FORCE, FRET_TO_FX, (double)p.F / 2, 0}));
        if (fret_normal_swings(n)) {
            const double F = (double)p.F;
            CHECK_OK(fret_swing_make(m, &s));
            stop = 1;
            CHECK_CODE(fret_swing_step(s, &(fret_step){FRET_KEEP_NORMAL, FRET_TO_FX, 0, 0.1 * F}),
                       FRET_INTERRUPTED);
            CHECK_CODE(place_traction(SWUNG(s), p.a / 9, &value), FRET_INTERRUPTED);
            CHECK_CODE(place_surface_x(SWUNG(s), p.a, &value), FRET_INTERRUPTED);
            stop = 0;
            fret_swing_free(s);
        }
        fret_memory_free(m);
    }
}

/* Elements that stand for a contact, stopped at any moment: none, or those that come out undisturbed. */
static void check_elements(const fret_material *material) {
    enum { ELEMENTS = 3 };
    const fret_gap gap = {.kind = FRET_GAP_FLAT_CONE, .b = 1e-4, .slope = 0.02};
    fret_normal *normal = unit_keep_normal(material, &gap);
    fret_press p;
    CHECK_OK(fret_press_by_force(normal, 10, &p));
    fret_normal_stop(normal, &stop);
    const fret_pressed contact = {normal, 0.4, p};
    const double part = 0.5 * (double)fret_gross_slip(&contact);
    jenkins_element whole[ELEMENTS], out[ELEMENTS];
    jenkins_error quality, unused;
    calc_error error;
    error_clear(&error);
    pulses = -1;
    stop = 0;
    CHECK(jenkins(&contact, part, ELEMENTS, &stop, pulse, whole, &quality, &error) && quality.worst > 0);
    stop = 1;
    CHECK(!jenkins(&contact, part, ELEMENTS, &stop, pulse, out, &unused, &error) && error.stop);
    bool done = false;
    for (int n = 0; !done && CHECK(n < 1000); n++) {
        error_clear(&error);
        pulses = n;
        stop = 0;
        done = jenkins(&contact, part, ELEMENTS, &stop, pulse, out, &unused, &error);
        CHECK(done ? unused.worst == quality.worst && !memcmp(out, whole, sizeof out) : error.stop);
    }
    stop = 0;
}

/* A column that is read: none, then all of it. */
static void check_column(void) {
    char name[] = "/tmp/fret-unit-XXXXXX";
    const int fd = mkstemp(name);
    static const char text[] = "r [mm],f [um]\n1,2\n3,4\n";
    csv c;
    calc_error error;
    error_clear(&error);
    CHECK(fd >= 0 && write(fd, text, sizeof text - 1) == (ssize_t)(sizeof text - 1) && !close(fd));
    CHECK(csv_read(name, &stop, &c, &error) && c.rows == 2);
    stop = 1;
    CHECK(!csv_column(&c, "f", &error) && error.stop);
    stop = 0;
    error_clear(&error);
    const csv_values *values = csv_column(&c, "f", &error);
    CHECK(values && values->v[1] == 4e-6);
    csv_free(&c);
    CHECK(!unlink(name));
}

int main(int argc, char **argv) {
    unit_start("stop", argc, argv);
    const fret_material steel = {.body = {{.E0 = 210e9, .nu = 0.3}, {.E0 = 210e9, .nu = 0.3}}, .c0 = 1};
    struct fret_table *table = sampled();
    const fret_gap gap = {.kind = FRET_GAP_TABLE, .table = table};
    fret_normal *normal;
    fret_press press;
    fret_real loss;
    CHECK_OK(fret_normal_make(&steel, &gap, NULL, NULL, &normal));
    fret_normal_stop(normal, &stop);
    CHECK_OK(fret_press_by_force(normal, 10, &press));
    const fret_pressed contact = {normal, 0.4, press};
    stop = 1;
    CHECK_CODE(fret_cycle_loss_by_force(&contact, 1, &loss), FRET_INTERRUPTED);
    stop = 0;
    CHECK_OK(fret_cycle_loss_by_force(&contact, 1, &loss));
    CHECK(loss > 0);
    CASE(check_column());
    CASE(check_memory(normal));
    CASE(check_questions(normal, &contact));
    CASE(check_springs(normal));
    CASE(check_elements(&steel));
    CASE(check_wild(table));
    stop = 1;
    fret_normal_stop(normal, NULL);
    CHECK_OK(fret_press_by_force(normal, 10, &press));
    fret_normal_free(normal);
    fret_table_free(table);
    return unit_finish();
}
