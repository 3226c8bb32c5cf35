/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The instruction sets that loops over vectors are built for, and whether this processor has them. Not
 * installed. */
#ifndef NUMBER_PROCESSOR_H
#define NUMBER_PROCESSOR_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __x86_64__
#define FRET_AVX2 __attribute__((target("avx2")))
#define FRET_AVX512 __attribute__((target("avx512f,avx512dq,avx512vl")))

static inline bool fret_runs_avx2(void) {
    return __builtin_cpu_supports("avx2");
}

static inline bool fret_runs_avx512(void) {
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl");
}
#endif

static inline bool fret_runs_plain(void) {
    return true;
}

/* Of variants for AVX-512, which comes with AVX2, for AVX2 and for none the first that runs here. */
static inline size_t fret_best_variant(void) {
#ifdef __x86_64__
    return 2U - fret_runs_avx2() - fret_runs_avx512();
#else
    return 0;
#endif
}

#endif
