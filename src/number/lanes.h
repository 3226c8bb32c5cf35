/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elementary functions in double of LANES = 2 numbers at once, each named lanes2_...: those of lanes_body.h.
 * Not installed. */
#include "number/bits.h"

#define LANES_PASTE(count, name) lanes##count##_##name
#define LANES_NAMED(count, name) LANES_PASTE(count, name)
#define NAMED(name) LANES_NAMED(LANES, name)

typedef double NAMED(numbers) __attribute__((vector_size(LANES * sizeof(double))));
typedef uint64_t NAMED(words) __attribute__((vector_size(LANES * sizeof(double))));
typedef int64_t NAMED(mask) __attribute__((vector_size(LANES * sizeof(double))));
#define V NAMED(numbers)
#define U NAMED(words)
#define M NAMED(mask)
#define BITS(x) ((U)(x))
#define VALUE(u) ((V)(u))
#define SELECT(mask, yes, no) VALUE((BITS(yes) & (U)(mask)) | (BITS(no) & ~(U)(mask)))

#include "number/lanes_body.h"

#undef V
#undef U
#undef M
#undef BITS
#undef VALUE
#undef SELECT
#undef NAMED
#undef LANES_NAMED
#undef LANES_PASTE
#undef LANES
