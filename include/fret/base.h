/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What every header of the library begins with: the type of its results, and linkage from C and C++. */
#ifndef FRET_BASE_H
#define FRET_BASE_H

/* Results carry guard digits: where long double is wider than double, a result rounded to double
 * is within one unit in the last place. Arguments are exact as given. */
typedef long double fret_real;

/* Around the declarations of a header: C names for C++ too. */
#ifdef __cplusplus
#define FRET_BEGIN extern "C" {
#define FRET_END }
#else
#define FRET_BEGIN
#define FRET_END
#endif

#endif
