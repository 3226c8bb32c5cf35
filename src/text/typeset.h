/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Formulas as text: plain ASCII as the tables hold them, or with the letters and signs of Unicode. */
#ifndef TEXT_TYPESET_H
#define TEXT_TYPESET_H

#include <stdbool.h>
#include <stddef.h>

/* Does the locale of the environment have UTF-8? Decided once; no locale is set. */
bool typeset_unicode(void);

/* delta_x, mu, int, ^2, <=, - ... in UTF-8; words only, not inside longer names. Text that is typeset already
 * stays. Cut off, between characters, where buf ends. */
void typeset(const char *plain, char *buf, size_t size);

#endif
