/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of the user's names. Uses `number`. */
#include "language/names.h"

#include <stdlib.h>
#include <string.h>

#include "number/array.h"

void names_free(own_names *n) {
    names_drop(n, 0);
    free(n->row);
    *n = (own_names){.row = NULL};
}

/* Linear search: names are few. */
static bool find_row(const own_names *n, const char *text, size_t len, size_t *index) {
    for (size_t i = 0; i < n->count; i++)
        if (!strncmp(n->row[i].text, text, len) && !n->row[i].text[len]) {
            *index = i;
            return true;
        }
    return false;
}

bool names_find(const own_names *n, const char *text, size_t len, size_t *index) {
    return find_row(n, text, len, index) && n->row[*index].known;
}

bool names_add(own_names *n, const char *text, size_t len, size_t *index) {
    if (find_row(n, text, len, index))
        return true;
    if (!fret_array_room(&n->row, &n->room, n->count + 1, sizeof *n->row))
        return false;
    char *copy = strndup(text, len);
    if (!copy)
        return false;
    *index = n->count++;
    n->row[*index] = (own_name){.text = copy};
    return true;
}

void names_put(own_names *n, size_t index, value v, counted *definition) {
    own_name *row = &n->row[index];
    counted_drop(row->definition);
    row->v = v;
    row->definition = definition;
    row->known = true;
}

void names_restore(own_names *n, size_t index, const own_name *old) {
    own_name *row = &n->row[index];
    char *text = row->text;
    counted_drop(row->definition);
    *row = *old;
    row->text = text;
}

void names_drop(own_names *n, size_t count) {
    while (n->count > count) {
        const own_name *row = &n->row[--n->count];
        counted_drop(row->definition);
        free(row->text);
    }
}
