/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reference counts of shared objects: gap tables, definitions, load programs. Such an object begins with a
 * `counted`. Both functions accept NULL. */
#ifndef SCENE_COUNTED_H
#define SCENE_COUNTED_H

#include <stddef.h>

typedef struct counted counted;
struct counted {
    size_t users;
    void (*end)(counted *self); /* frees the object */
};

static inline void *counted_hold(void *of) {
    counted *c = of;
    if (c)
        c->users++;
    return c;
}

static inline void counted_drop(void *of) {
    counted *c = of;
    if (c && --c->users == 0)
        c->end(c);
}

#endif
