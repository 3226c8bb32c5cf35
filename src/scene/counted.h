/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What several owners share: gap tables, definitions, load programs. Begins with a `counted`. */
#ifndef SCENE_COUNTED_H
#define SCENE_COUNTED_H

#include <stddef.h>

typedef struct counted counted;
struct counted {
    size_t users;
    void (*end)(counted *self); /* frees it */
};

static inline void *counted_hold(counted *c) {
    if (c)
        c->users++;
    return c;
}

static inline void counted_drop(counted *c) {
    if (c && --c->users == 0)
        c->end(c);
}

#endif
