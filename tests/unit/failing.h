/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Allocations that fail, one after the other. The Makefile links programs that include this so that what they
 * test allocates through the functions here. */
#ifndef FAILING_H
#define FAILING_H

#include <stdbool.h>
#include <stddef.h>

static int left = -1; /* allocations that succeed before one fails; -1: all do */

static bool fails(void) {
    return left >= 0 && left-- == 0;
}

#define WRAPPED(name, parameters, arguments)                                                                 \
    void *__real_##name parameters;                                                                          \
    void *__wrap_##name parameters;                                                                          \
    void *__wrap_##name parameters {                                                                         \
        return fails() ? NULL : __real_##name arguments;                                                     \
    }
WRAPPED(malloc, (size_t size), (size))
WRAPPED(calloc, (size_t count, size_t size), (count, size))
WRAPPED(realloc, (void *old, size_t size), (old, size))
WRAPPED(aligned_alloc, (size_t alignment, size_t size), (alignment, size))

/* A call, tried until none of its allocations is left to fail, which takes more than `least` tries: each time
 * it is refused, as is checked, or does without. */
#define EACH_FAILS(least, call, refused)                                                                     \
    do {                                                                                                     \
        int n_ = 0;                                                                                          \
        for (bool whole_ = false; !whole_ && n_ < 2000; n_ = unit_next(n_)) {                                \
            left = n_;                                                                                       \
            const bool ok_ = (call);                                                                         \
            whole_ = left >= 0;                                                                              \
            left = -1;                                                                                       \
            CHECK(ok_ || (!whole_ && (refused)));                                                            \
        }                                                                                                    \
        CHECK(n_ > (least) && n_ < 2000);                                                                    \
    } while (0)

#endif
