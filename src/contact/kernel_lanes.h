/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The functions of kernel_body.h, and of the file KERNEL_ALSO where that is defined, for groups of LANES = 1,
 * 2, 4 or 8 numbers, each named lanes1_..., lanes2_... Wanted at the width of the registers: compilers split
 * wider groups badly. No guard: included once for each width. */
#include "kernel.h"

#define KERNEL_PASTE(count, name) lanes##count##_##name
#define KERNEL_NAMED(count, name) KERNEL_PASTE(count, name)
#define NAMED(name) KERNEL_NAMED(LANES, name)

#if LANES == 1
#define V double
#define U uint64_t
#define M int
#define BITS kernel_bits
#define VALUE kernel_value
#define SELECT(mask, yes, no) ((mask) ? (yes) : (no))
#define ANY(mask) (mask)
#else
typedef double NAMED(numbers) __attribute__((vector_size(LANES * sizeof(double))));
typedef uint64_t NAMED(words) __attribute__((vector_size(LANES * sizeof(double))));
typedef int64_t NAMED(mask) __attribute__((vector_size(LANES * sizeof(double))));
#define V NAMED(numbers)
#define U NAMED(words)
#define M NAMED(mask)
#define BITS(x) ((U)(x))
#define VALUE(u) ((V)(u))
#define SELECT(mask, yes, no) VALUE((BITS(yes) & (U)(mask)) | (BITS(no) & ~(U)(mask)))
#define ANY(mask) kernel_any(&(mask), LANES)
#endif

#include "kernel_body.h"
#ifdef KERNEL_ALSO
#include KERNEL_ALSO
#endif

#undef V
#undef U
#undef M
#undef BITS
#undef VALUE
#undef SELECT
#undef ANY
#undef NAMED
#undef KERNEL_NAMED
#undef KERNEL_PASTE
#undef LANES
