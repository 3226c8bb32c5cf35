/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which encoding the text of a file has, where nothing in the file says it. Touches nothing but iconv. */
#ifndef TEXT_ENCODING_H
#define TEXT_ENCODING_H

#include "text/error.h"

/* Makes *text, which may be freed, UTF-8, and NUL-terminated: of Windows-1252, or of Shift-JIS where the
 * system's iconv knows it. was: "Shift-JIS", or NULL. An error names the encoding
 * that this program cannot read. */
bool encoding_to_utf8(char **text, size_t *len, const char **was, const char *path, calc_error *error);

#endif
