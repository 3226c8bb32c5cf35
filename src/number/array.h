/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Arrays that grow, and the order of what qsort puts in order. Touches nothing. Not installed. */
#ifndef FRET_NUMBER_ARRAY_H
#define FRET_NUMBER_ARRAY_H

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Room for `count` > 0 items of `size` bytes, and for as many again as there were, where the pointer at
 * `items` points to; they may move. False: out of memory, nothing has changed. */
static inline bool fret_array_room(void *items, size_t *room, size_t count, size_t size) {
    void *grown;
    if (count <= *room)
        return true;
    memcpy(&grown, items, sizeof grown);
    const size_t more = *room + count + 16;
    grown = realloc(grown, more * size);
    if (!grown)
        return false;
    memcpy(items, &grown, sizeof grown);
    *room = more;
    return true;
}

/* Of doubles, or of what begins with one. */
static inline int fret_ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

#endif
