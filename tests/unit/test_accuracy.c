/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Models against each other, interrupted on the way: no study then, the scene as it was, and the next study
 * has the rows of an undisturbed one. */
#include "language.h"
#include "study/accuracy.h"

static volatile sig_atomic_t stop;

static int pulses, stop_at; /* at which pulse it stops; -1: none */

static void pulse(void) {
    stop = stop || pulses == stop_at;
    pulses++;
}

static bool study(calc *c, int at, int *count, accuracy_study *out) {
    static const accuracy_load own = {.seconds = 0.001};
    pulses = 0;
    stop_at = at;
    c->now->pulse = pulse;
    const bool ok = accuracy_measure(c->now, &own, out, fresh());
    c->now->pulse = NULL;
    stop = 0;
    *count = pulses;
    return ok;
}

/* What each family has answered first: larger ones of it take time that there may not be. */
static void same_rows(const accuracy_study *a, const accuracy_study *b) {
    CHECK(a->value == b->value && a->by_force == b->by_force && a->amplitude == b->amplitude);
    for (model_family family = 0; family < FAMILIES; family++) {
        size_t i = 0, j = 0;
        while (i < a->count && a->row[i].family != family)
            i++;
        while (j < b->count && b->row[j].family != family)
            j++;
        CHECK((i < a->count) == (j < b->count));
        if (i < a->count && j < b->count)
            CHECK(a->row[i].size == b->row[j].size && a->row[i].value == b->row[j].value);
    }
}

static void interrupted(int rows, load_step then, cycle_extra extra) {
    accuracy_study whole, part;
    const fret_state *state;
    int all, some;
    calc c;
    press_steel(&c, &stop, rows);
    CHECK(load(&c, then, extra));
    CHECK(scene_state(c.now, &state, fresh()));
    const fret_state before = *state;
    if (!CHECK(study(&c, -1, &all, &whole) && whole.count >= 3)) {
        calc_free(&c);
        return;
    }
    for (size_t i = 0; i < whole.count; i++) /* the rough ones are good to some per cent */
        CHECK_REL(whole.row[i].value, whole.value, 0.3L);
    for (int n = 0; n < all; n += 1 + all / 50) {
        if (study(&c, n, &some, &part)) { /* there was no time for so many pulses */
            CHECK(some <= n);
        } else {
            calc_word(&c, &error);
            CHECK(some > n && !strcmp(error.text, "interrupted"));
        }
        CHECK(scene_state(c.now, &state, fresh()) && state->Fx == before.Fx && state->dx == before.dx &&
              state->W == before.W);
    }
    if (CHECK(study(&c, -1, &some, &part)))
        same_rows(&whole, &part);
    calc_free(&c);
}

int main(int argc, char **argv) {
    unit_start("test_accuracy", argc, argv);
    static const load_step constant = {LOAD_CYCLE, .tangential = BY_FORCE, .tangential_value = 20},
                           swinging = {LOAD_CYCLE, .tangential = BY_FORCE, .tangential_value = 12,
                                       .normal_value = 30},
                           chords = {LOAD_CYCLE, .tangential = BY_DISPLACEMENT, .tangential_value = 3e-7,
                                     .normal_value = 10};
    CASE(interrupted(0, constant, (cycle_extra){.times = 1}));
    CASE(interrupted(12, constant, (cycle_extra){.times = 1}));
    CASE(interrupted(0, swinging, (cycle_extra){.times = 1, .phase = 1}));
    CASE(interrupted(0, chords, (cycle_extra){.times = 1, .phase = 1}));
    return unit_finish();
}
