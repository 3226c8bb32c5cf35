/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The user's names: variables, live definitions, functions, and the free names of a sweep. */
#ifndef LANGUAGE_NAMES_H
#define LANGUAGE_NAMES_H

#include "scene/scene.h"

typedef struct own_name {
    char *text;
    value v;
    counted *definition; /* NULL: a value */
    bool known;          /* it has a value */
    bool lent;           /* it had no value until a range lent it one */
    bool seen;           /* mark of a search through definitions */
} own_name;

typedef struct own_names {
    own_name *row;
    size_t count, room;
} own_names;

void names_free(own_names *n);
/* Finds a name that has a value. */
bool names_find(const own_names *n, const char *text, size_t len, size_t *index);
/* Finds a name, or adds it without a value; false: out of memory. */
bool names_add(own_names *n, const char *text, size_t len, size_t *index);
/* Sets a value, or a definition, which is owned from then on. */
void names_put(own_names *n, size_t index, value v, counted *definition);
/* Restores an old value; the text stays. */
void names_restore(own_names *n, size_t index, const own_name *old);
/* Removes the latest names, down to `count`. */
void names_drop(own_names *n, size_t count);

#endif
