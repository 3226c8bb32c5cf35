/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Included by every header of the library: the type of results, and C linkage for C++. */
#ifndef FRET_BASE_H
#define FRET_BASE_H

/* Results carry guard digits: where long double is wider than double, a result rounded to double is within
 * one unit in the last place. Arguments are taken as exact. */
typedef long double fret_real;

/* Enclose the declarations of a header: C linkage when included from C++. */
#ifdef __cplusplus
#define FRET_BEGIN extern "C" {
#define FRET_END }
#else
#define FRET_BEGIN
#define FRET_END
#endif

#endif
