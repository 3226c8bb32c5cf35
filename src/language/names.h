/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Names of the user's own: variables, live definitions, functions, and free names of a sweep while it lasts.
 */
#ifndef LANGUAGE_NAMES_H
#define LANGUAGE_NAMES_H

#include "scene/scene.h"

typedef struct own_name {
    char *text;
    value v;
    counted *definition; /* NULL: a value */
    bool known;          /* it has been given, and not taken back */
    bool woken;          /* it had been taken back: a range knows it for a while */
    bool seen;           /* while definitions that lead into each other are looked through */
} own_name;

typedef struct own_names {
    own_name *row;
    size_t count, room;
} own_names;

void names_free(own_names *n);
/* A name that is known. */
bool names_find(const own_names *n, const char *text, size_t len, size_t *index);
/* The same, or a new one, not known yet; false: out of memory. */
bool names_add(own_names *n, const char *text, size_t len, size_t *index);
/* Takes over the definition (NULL: v is the value). */
void names_put(own_names *n, size_t index, value v, counted *definition);
/* Its old value comes back; the text stays. */
void names_restore(own_names *n, size_t index, const own_name *old);
/* The latest names, down to `count`, go. */
void names_drop(own_names *n, size_t count);

#endif
