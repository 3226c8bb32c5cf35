/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of the user's names. */
#include "language/names.h"

#include <stdlib.h>
#include <string.h>

void names_free(own_names *n) {
    names_drop(n, 0);
    free(n->row);
    free(n->slots);
    *n = (own_names){.row = NULL};
}

static bool same_name(const char *a, const char *word, size_t len) {
    return !strncmp(a, word, len) && !a[len];
}

/* The place of a name among the slots: its own, or the free one where it belongs. */
static size_t *slot_of(const own_names *n, const char *text, size_t len) {
    size_t hash = 0, mask = 2 * n->room - 1; /* a power of two */
    for (size_t i = 0; i < len; i++)
        hash = 31 * hash + (unsigned char)text[i];
    for (hash ^= hash >> 15;; hash++) {
        size_t *slot = &n->slots[hash & mask];
        if (!*slot || same_name(n->row[*slot - 1].text, text, len))
            return slot;
    }
}

static bool find_row(const own_names *n, const char *text, size_t len, size_t *index) {
    size_t slot = n->count ? *slot_of(n, text, len) : 0;
    *index = slot - 1;
    return slot > 0;
}

bool names_find(const own_names *n, const char *text, size_t len, size_t *index) {
    return find_row(n, text, len, index) && n->row[*index].known;
}

/* Room for twice as many, at least 16. */
static bool grow_names(own_names *n) {
    size_t room = n->room ? 2 * n->room : 16;
    own_name *rows = realloc(n->row, room * sizeof *rows);
    if (!rows)
        return false;
    n->row = rows;
    size_t *slots = calloc(2 * room, sizeof *slots);
    if (!slots)
        return false;
    free(n->slots);
    n->slots = slots;
    n->room = room;
    for (size_t i = 0; i < n->count; i++)
        *slot_of(n, n->row[i].text, strlen(n->row[i].text)) = i + 1;
    return true;
}

bool names_add(own_names *n, const char *text, size_t len, size_t *index) {
    if (find_row(n, text, len, index))
        return true;
    if (n->count == n->room && !grow_names(n))
        return false;
    char *copy = malloc(len + 1);
    if (!copy)
        return false;
    memcpy(copy, text, len);
    copy[len] = 0;
    *index = n->count++;
    n->row[*index] = (own_name){.text = copy};
    *slot_of(n, text, len) = *index + 1;
    return true;
}

void names_put(own_names *n, size_t index, value v, counted *definition) {
    own_name *row = &n->row[index];
    counted_drop(row->definition);
    row->v = v;
    row->definition = definition;
    row->known = true;
}

/* The latest lies at the end of its chain of slots: no other is lost with it. */
void names_drop(own_names *n, size_t count) {
    while (n->count > count) {
        own_name *row = &n->row[n->count - 1];
        *slot_of(n, row->text, strlen(row->text)) = 0;
        counted_drop(row->definition);
        free(row->text);
        n->count--;
    }
}
