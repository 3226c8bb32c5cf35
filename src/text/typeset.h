/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Formulas: from plain ASCII to the letters and signs of Unicode. Depends on libc alone. */
#ifndef TEXT_TYPESET_H
#define TEXT_TYPESET_H

#include <stdbool.h>
#include <stddef.h>

/* Does the environment's locale use UTF-8? Decided at the first call; no locale is set. */
bool typeset_unicode(void);

/* Replaces delta, mu, int, ^2, <=, - etc. by UTF-8 signs: whole words, also before an index (delta_x). Text
 * that is typeset already stays. Cut off between characters where buf is full. */
void typeset(const char *plain, char *buf, size_t size);

#endif
