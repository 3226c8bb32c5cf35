/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Growing arrays, and the comparison function of qsort. Includes the C library alone. Not installed. */
#ifndef FRET_NUMBER_ARRAY_H
#define FRET_NUMBER_ARRAY_H

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Makes room for `count` > 0 items of `size` bytes in the array that *items points to, at least doubling it
 * if it grows; items may move. False: out of memory, nothing has changed. */
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

/* For qsort: ascending order of doubles, or of structs whose first member is a double. */
static inline int fret_ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

#endif
