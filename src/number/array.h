/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Arrays that grow, and the order of what qsort puts in order. Touches nothing. Not installed. */
#ifndef FRET_NUMBER_ARRAY_H
#define FRET_NUMBER_ARRAY_H

#include <stdlib.h>

/* The items, or where they have moved to, with room for `count` > 0 of them of `size` bytes, and for as many
 * again as there were; NULL: out of memory, nothing has changed. */
static inline void *fret_array_for(void *items, size_t *room, size_t count, size_t size) {
    if (count <= *room)
        return items;
    const size_t more = *room + count + 16;
    void *grown = realloc(items, more * size);
    if (grown)
        *room = more;
    return grown;
}

/* Of doubles, or of what begins with one. */
static inline int fret_ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

#endif
