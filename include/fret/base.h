/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What every header of the library begins with: the type of its results, and linkage from C and C++. */
#ifndef FRET_BASE_H
#define FRET_BASE_H

/* Results carry guard digits: where long double is wider than double, a result rounded to double
 * is within one unit in the last place. Arguments are exact as given. */
typedef long double fret_real;

/* Around the declarations of a header: C names, visible in the shared library. */
#ifdef __cplusplus
#define FRET_BEGIN                                                                                           \
    extern "C" {                                                                                             \
    _Pragma("GCC visibility push(default)")
#define FRET_END                                                                                             \
    _Pragma("GCC visibility pop")                                                                            \
    }
#else
#define FRET_BEGIN _Pragma("GCC visibility push(default)")
#define FRET_END _Pragma("GCC visibility pop")
#endif

#endif
