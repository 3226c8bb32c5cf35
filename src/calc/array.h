/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Arrays that grow. Touches nothing. */
#ifndef CALC_ARRAY_H
#define CALC_ARRAY_H

#include <stdbool.h>
#include <stdlib.h>

/* Room for one more item of `size` bytes; false: out of memory, nothing has changed. */
static inline bool array_room(void **items, size_t *room, size_t count, size_t size) {
    if (count < *room)
        return true;
    size_t more = *room ? 2 * *room : 16;
    void *grown = realloc(*items, more * size);
    if (!grown)
        return false;
    *items = grown;
    *room = more;
    return true;
}

#endif
