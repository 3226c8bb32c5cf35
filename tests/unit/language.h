/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tests of the language: its names beside those of unit.h, one error for all, a scene to begin with. */
#ifndef LANGUAGE_H
#define LANGUAGE_H

#include "unit.h"

#define unit calc_unit /* names that calc has too */
#define value calc_value
#define quantity calc_quantity
#include "language/calc.h"
#include "language/trial.h"
#include "scene/functions.h"
#include "text/characters.h"
#include "text/words.h"
#undef unit
#undef value
#undef quantity

static inline const geometry *geometry_find(const char *name) {
    size_t i;
    return word_among(geometry_name, name, strlen(name), &i) ? geometry_row(i) : NULL;
}

static calc_error error;

static inline calc_error *fresh(void) {
    error_clear(&error);
    return &error;
}

static inline bool out_of_memory(calc *c) {
    calc_word(c, &error);
    return strstr(error.text, "out of memory") != NULL;
}

static inline bool assign(calc *c, const char *text) {
    lexer lx;
    lex_start(&lx, text, strlen(text), fresh());
    return calc_assign(c, &lx);
}

static inline bool load(calc *c, load_step step, cycle_extra extra) {
    return scene_load(c->now, &step, step.kind == LOAD_CYCLE ? &extra : NULL, fresh());
}

/* The paraboloid of R = 10 mm, measured. */
static inline shared_table *rows_of_sphere(int rows) {
    double r[100], f[100];
    struct fret_table *t = NULL;
    for (int i = 0; i < rows; i++) {
        r[i] = 1e-3 * i / (rows - 1);
        f[i] = r[i] * r[i] / 0.02;
    }
    CHECK_OK(fret_table_make(r, f, (size_t)rows, NULL, &t));
    return shared_table_make(t, "rows", (smoothing){0});
}

/* Steel; a sphere, or its rows; pressed. */
static inline void press_steel(calc *c, const volatile sig_atomic_t *stop, int rows) {
    static const load_step press = {.kind = LOAD_PRESS, .normal = BY_FORCE, .normal_value = 100};
    calc_init(c, stop);
    inputs *in = &c->now->in;
    inputs_put(in, IN_E0, 210e9);
    inputs_put(in, IN_NU, 0.3);
    inputs_put(in, IN_MU, 0.4);
    inputs_geometry(in, geometry_find(rows ? "file" : "sphere"), NULL, rows ? rows_of_sphere(rows) : NULL);
    if (!rows)
        inputs_put(in, IN_RADIUS, 0.01);
    CHECK(load(c, press, (cycle_extra){0}));
}

#endif
